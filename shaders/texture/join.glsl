// What joins textures, and colour maps.
#include "shared/bindings.glsl"
#include "base/math.glsl"
#include "texture/context.glsl"

// A constant input, and the word of the record of one that is a texture.
vec4 texture_constant(uint w) { return vec4(texture_input_unpack(fetch_textures(w)).value, 1.0); }
uint texture_input(uint w) { return texture_input_unpack(fetch_textures(w)).at; }

vec4 texture_mix(vec4 a, vec4 b, vec4 amount) { return mix(a, b, clamp(mean_component(amount.rgb), 0.0, 1.0)); }
vec4 texture_direction_mix(vec3 direction, vec3 normal, vec4 a, vec4 b)
{
    return mix(b, a, min(abs(dot(direction, normal)), 1.0));
}

vec4 texture_add(vec4 a, vec4 b) { return vec4(a.rgb + b.rgb, 1.0); }
vec4 texture_multiply(vec4 a, vec4 b) { return vec4(a.rgb * b.rgb, a.a * b.a); }
vec4 texture_scale(vec4 value, vec4 factor) { return vec4(value.rgb * mean_component(factor.rgb), value.a); }
vec4 texture_invert(vec4 value) { return vec4(1.0 - value.rgb, value.a); }

// The colour map at word w. A stop that is passed covers those before it.
vec4 texture_ramp(uint w, vec4 value)
{
    Ramp ramp = ramp_unpack(fetch_textures(w));
    uint first = w + RAMP_WORDS + TEXTURE_INPUT_WORDS;
    RampStop last = ramp_stop_unpack(fetch_textures(first));
    vec3 color = last.color;
    float x = mean_component(value.rgb);
    for (uint i = 1u; i < ramp.count; ++i) {
        RampStop stop = ramp_stop_unpack(fetch_textures(first + i * RAMP_STOP_WORDS));
        // Two stops at one place are a step
        float t = clamp((x - last.place) / max(stop.place - last.place, 1e-20), 0.0, 1.0);
        if (ramp.smooth_stops != 0u) t = t * t * (3.0 - 2.0 * t);
        color = mix(color, stop.color, t);
        last = stop;
    }
    return vec4(color, 1.0);
}

// The same for each channel by itself.
vec4 texture_curve(uint w, vec4 value)
{
    Ramp ramp = ramp_unpack(fetch_textures(w));
    uint first = w + RAMP_WORDS + TEXTURE_INPUT_WORDS;
    RampStop last = ramp_stop_unpack(fetch_textures(first));
    vec3 color = last.color;
    for (uint i = 1u; i < ramp.count; ++i) {
        RampStop stop = ramp_stop_unpack(fetch_textures(first + i * RAMP_STOP_WORDS));
        vec3 t = clamp((value.rgb - last.place) / max(stop.place - last.place, 1e-20), 0.0, 1.0);
        if (ramp.smooth_stops != 0u) t = t * t * (3.0 - 2.0 * t);
        color = mix(color, stop.color, t);
        last = stop;
    }
    return vec4(color, value.a);
}

// Uniform cubic Bézier segments through the colours at word w, which overlap by three of four (pbrt, MarbleTexture).
vec4 texture_spline(uint w, vec4 value)
{
    uint segments = ramp_unpack(fetch_textures(w)).count - 3u;
    float place = clamp(mean_component(value.rgb), 0.0, 1.0) * float(segments);
    uint i = min(uint(place), segments - 1u);
    float t = place - float(i);
    uint first = w + RAMP_WORDS + TEXTURE_INPUT_WORDS + i * RAMP_STOP_WORDS;
    vec3 c0 = ramp_stop_unpack(fetch_textures(first)).color;
    vec3 c1 = ramp_stop_unpack(fetch_textures(first + RAMP_STOP_WORDS)).color;
    vec3 c2 = ramp_stop_unpack(fetch_textures(first + 2u * RAMP_STOP_WORDS)).color;
    vec3 c3 = ramp_stop_unpack(fetch_textures(first + 3u * RAMP_STOP_WORDS)).color;
    // De Casteljau
    vec3 a = mix(mix(c0, c1, t), mix(c1, c2, t), t);
    vec3 b = mix(mix(c1, c2, t), mix(c2, c3, t), t);
    return vec4(mix(a, b, t), 1.0);
}

// A context at a point that is moved in every space by the number at word w times a vector.
TextureContext warped(TextureContext context, uint w, vec3 direction)
{
    vec3 by = node_number_unpack(fetch_textures(w)).number * direction;
    context.position += by;
    context.object_position += by;
    context.uv += by.xy;
    return context;
}
