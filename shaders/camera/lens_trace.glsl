// A ray from the film through the interfaces of a lens. Lens space is in millimetres: x to the right, y up, z from the film
// towards the scene.
// Switches of the variant: LENS_DISPERSION, LENS_SHAPE.
#include "base/math.glsl"
#include "camera/opening.glsl"

struct LensRay {
    vec3 origin;
    vec3 direction;
    float weight; // what its stop lets through; 0 = it does not get through
};

// `inverse_square` is 1 / λ², in 1 / µm². Skew rays are traced from vertex to vertex (Welford 1986, section 4.2): flat and
// curved boundaries are one case, and the root is that near the vertex.
LensRay lens_trace(vec3 origin, vec3 direction, float inverse_square)
{
    bool passes = true;
    float weight = 1.0;
    float index = 1.0;
    for (uint i = 0u; i < frame.lens_count; ++i) {
        vec4 a = uintBitsToFloat(fetch_lens(2u * i));
        float position = a.x;
        float curvature = a.y;
        // To the plane of the vertex, then to the surface
        float along = (position - origin.z) / direction.z;
        vec2 p = origin.xy + along * direction.xy;
        float f = curvature * dot(p, p);
        float g = direction.z - curvature * dot(p, direction.xy);
        float cosine_squared = g * g - curvature * f;
        float cosine = safe_sqrt(cosine_squared);
        float rest = f / (g + cosine);
        p += rest * direction.xy;
        float sag = rest * direction.z;
        passes = passes && cosine_squared >= 0.0 && along + rest >= 0.0 && dot(p, p) <= a.z;
#ifdef LENS_SHAPE
        if (i == frame.lens_stop) weight = opening_weight(p / frame.stop_radius);
#endif
        // Snell's law
#ifdef LENS_DISPERSION
        vec4 b = uintBitsToFloat(fetch_lens(2u * i + 1u));
        float next = b.x + b.y * inverse_square;
#else
        float next = a.w;
#endif
        float eta = index / next;
        float bent_squared = 1.0 - eta * eta * (1.0 - cosine * cosine);
        passes = passes && bent_squared > 0.0;
        float k = safe_sqrt(bent_squared) - eta * cosine;
        direction = eta * direction + k * vec3(-curvature * p, 1.0 - curvature * sag);
        origin = vec3(p, position + sag);
        index = next;
    }
    return LensRay(origin, direction, passes ? weight : 0.0);
}
