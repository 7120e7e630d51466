// Plates of cold rock that drift on glowing lava. A texture of a scene is one function, `color`; this file has a helper of its
// own, and `plates`, `glow` and `rock` are parameters that the scene gives.

// Distance to the nearest crack between two plates, bent by noise.
float crack(vec3 p, float width)
{
    vec3 bend = vec3(fbm_noise(p, width, 5u), fbm_noise(p + 17.0, width, 5u), fbm_noise(p - 31.0, width, 5u));
    return worley_difference(worley_euclidean(p + 0.35 * bend));
}

vec4 color(TextureContext context)
{
    vec3 p = plates * context.object_position;
    float width = plates * context.object_footprint;
    float depth = crack(p, width) + 0.06 * fbm_noise(6.0 * p, 6.0 * width, 4u);
    float heat = exp(-14.0 * max(depth, 0.0));
    float grain = 0.6 + 0.4 * turbulence_noise(9.0 * p, 9.0 * width, 4u);
    return vec4(rock * grain * (1.0 - heat) + glow * heat * heat, 1.0);
}
