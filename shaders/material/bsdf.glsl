// What a material is at one point: the numbers that all lobes draw from, in the frame of the shading normal.
#include "base/math.glsl"
#include "shared/layout.glsl"

struct Bsdf {
    uint kind;       // MATERIAL_…
    uint mode;       // FRESNEL_…, or DIELECTRIC_…
    vec3 color;      // reflectance, base colour, or first colour of a BSDF of the table
    vec3 specular;   // second colour of a BSDF of the table, factor on what a dielectric reflects head-on, or η of a conductor
    vec3 k;          // k of a conductor
    float ior;       // index behind the geometric surface over index in front of it
    vec2 numbers;    // numbers of a BSDF of the table
    vec2 alpha;      // GGX widths; both 0 = smooth
    // The rest is of the principled model
    float metallic;
    float weight;    // of what the dielectric reflects
    float transmission;
    float coat;
    vec2 coat_alpha; // both the same; or those of an interface
    vec3 sheen;
    float sheen_roughness;
    // And of an interface
    uint through_table; // word of the table of what it lets through
    uint inner_table;   // word of that of what leaves metal under it
    float through_mean; // what it lets through, when smooth, of light from everywhere
    // And of glass with dispersion
    vec3 indices;       // index of refraction of red, green and blue
    vec3 chances;       // of following each colour
    bool disperses;     // they differ; `ior` is that of the d line
};

// Where a channel of both colours of a BSDF together is above 1, both are scaled down, so that no energy is made.
void bsdf_normalise(inout Bsdf b)
{
    float most = max_component(b.color + b.specular);
    float scale = most > 1.0 ? 1.0 / most : 1.0;
    b.color *= scale;
    b.specular *= scale;
}

struct BsdfSample {
    vec3 wi;         // local
    vec3 weight;     // f · |cos θ| / pdf; 0 = absorbed
    float pdf;       // solid angle; 0 = a mirror direction
    float eta;       // index ratio when light went through, else 1
    bool through;    // wi is on the other side
};

const BsdfSample BSDF_ABSORBED = BsdfSample(vec3(0.0, 0.0, 1.0), vec3(0.0), 1.0, 1.0, false);

// Rougher than this is a microfacet lobe, smoother a mirror (as in pbrt-v4).
const float BSDF_SMOOTH = 1e-3;

bool bsdf_is_smooth(Bsdf b) { return max(b.alpha.x, b.alpha.y) < BSDF_SMOOTH; }

// Switch: HAS_COATED_CONDUCTOR.
bool bsdf_is_specular(Bsdf b)
{
#ifdef HAS_COATED_CONDUCTOR
    // Under a rough interface metal is rough
    if (b.kind == MATERIAL_COATED_CONDUCTOR) return bsdf_is_smooth(b);
#endif
    return (b.kind == MATERIAL_CONDUCTOR || b.kind == MATERIAL_DIELECTRIC) && bsdf_is_smooth(b);
}
