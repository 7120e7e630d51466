// The model of glTF 2.0 (appendix B) with its extensions ior, specular, transmission, volume, clearcoat and sheen: a mix of metal
// and a dielectric over a diffuse or clear base, below sheen, below a coat. Where glTF's layers make energy, the base gets what
// the layer leaves in both directions (Kelemen and Szirmay-Kalos 2001). Switches: HAS_TRANSMISSION, HAS_CLEARCOAT, HAS_SHEEN.
#include "base/sampling.glsl"
#include "material/albedo.glsl"
#include "material/dielectric.glsl"
#include "material/sheen.glsl"

// What the coat reflects head-on: an index of 1.5.
const float COAT_F0 = 0.04;

// Both sides of what has no inside are alike: -1 turns a direction below it up.
float principled_turn(Bsdf b, vec3 wo) { return b.mode == DIELECTRIC_THIN && wo.z < 0.0 ? -1.0 : 1.0; }

// Coat, sheen and diffuse base are outside.
bool principled_outside(Bsdf b, vec3 w) { return b.mode == DIELECTRIC_THIN || w.z > 0.0; }

float principled_eta(Bsdf b, vec3 wo) { return b.mode == DIELECTRIC_THIN ? b.ior : dielectric_eta(b, wo); }

// Amplitude of what an index reflects head-on.
float principled_head_on(Bsdf b) { return (b.ior - 1.0) / (b.ior + 1.0); }

vec3 principled_f0(Bsdf b) { return min(sqr(principled_head_on(b)) * b.specular, vec3(1.0)); }

// The exact rise of what a facet reflects, from 0 head-on to 1 where it is grazed.
float principled_rise(Bsdf b, float cos_o, float eta)
{
    float head_on = sqr(principled_head_on(b));
    return clamp((fresnel_dielectric(cos_o, eta) - head_on) / (1.0 - head_on), 0.0, 1.0);
}

// What a facet of the dielectric reflects.
vec3 principled_fresnel(Bsdf b, float cos_o, float eta)
{
    return b.weight * mix(principled_f0(b), vec3(1.0), principled_rise(b, cos_o, eta));
}

vec3 principled_reflected(Bsdf b, float cos_o, float eta)
{
    return mix(principled_fresnel(b, cos_o, eta), fresnel_schlick(cos_o, b.color), b.metallic);
}

// What goes through a facet: all that is left with a weight of 1, and nothing where it is grazed.
vec3 principled_through(Bsdf b, float cos_o, float eta)
{
    float left = (1.0 - b.weight * max_component(principled_f0(b))) * (1.0 - principled_rise(b, cos_o, eta));
    return (1.0 - b.metallic) * b.transmission * left * b.color;
}

// What the dielectric layer leaves to the diffuse base in a direction, and on average.
vec2 principled_base(Bsdf b, vec3 w)
{
    vec2 shape = layer_shape(sqrt(b.alpha.x * b.alpha.y));
    // Exactly, between head-on and grazing, up to a tenth more is reflected than by Schlick's rise, and less where the index is
    // almost 1
    float f0 = min(1.1 * max_component(principled_f0(b)), 1.0);
    shape.x *= min(12.0 * principled_head_on(b), 1.0);
    return 1.0 - b.weight * vec2(layer_albedo(layer_grazing(abs(w.z), shape), f0), layer_albedo(layer_grazing_mean(shape), f0));
}

// Part of the diffuse base.
float principled_diffuse(Bsdf b, vec3 w)
{
    return principled_outside(b, w) ? (1.0 - b.metallic) * (1.0 - b.transmission) : 0.0;
}

// What the coat reflects, seen from a direction.
float principled_coat(Bsdf b, vec3 w)
{
#ifdef HAS_CLEARCOAT
    if (principled_outside(b, w)) return b.coat * layer_albedo(layer_grazing(abs(w.z), layer_shape(b.coat_alpha.x)), COAT_F0);
#endif
    return 0.0;
}

// What the sheen reflects, seen from a direction.
float principled_sheen(Bsdf b, vec3 w)
{
#ifdef HAS_SHEEN
    if (principled_outside(b, w)) return max_component(b.sheen) * sheen_albedo(abs(w.z), b.sheen_roughness);
#endif
    return 0.0;
}

// Chances of sampling by a cosine (diffuse base, sheen), the coat, and the facets.
vec3 principled_chances(Bsdf b, vec3 wo)
{
    float cos_o = abs(wo.z);
    float eta = principled_eta(b, wo);
    float diffuse = principled_diffuse(b, wo) * mean_component(b.color) * principled_base(b, wo).x;
    // A little more than what is reflected head-on: other facets reflect more
    float facets = mean_component(principled_reflected(b, cos_o, eta) + principled_through(b, cos_o, eta));
    facets += 0.01 * mix(b.weight, 1.0, b.metallic);
    float coat = principled_coat(b, wo);
    vec3 chances = vec3((diffuse + principled_sheen(b, wo)) * (1.0 - coat), coat, facets * (1.0 - coat));
    float sum = chances.x + chances.y + chances.z;
    return sum > 0.0 ? chances / sum : vec3(1.0, 0.0, 0.0);
}

// Chance that light is reflected by a facet and does not go through.
float principled_facet_chance(Bsdf b, float cos_o, float eta)
{
#ifdef HAS_TRANSMISSION
    float reflected = mean_component(principled_reflected(b, cos_o, eta));
    float through = mean_component(principled_through(b, cos_o, eta));
    return reflected + through > 0.0 ? reflected / (reflected + through) : 1.0;
#else
    return 1.0;
#endif
}
