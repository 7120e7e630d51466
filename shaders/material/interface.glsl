// A dielectric interface over an opaque base, seen from outside: b.ior is its index and b.coat_alpha its GGX widths. Tables of what a
// rough one lets through, and of what leaves rough metal under one, are behind the materials. Switch: HAS_INTERFACE_TABLES.
#include "shared/bindings.glsl"
#include "material/bsdf.glsl"
#include "material/fresnel.glsl"
#include "material/ggx.glsl"

// Value and density of all lobes together.
struct CoatedValue { vec3 f; float pdf; };

bool interface_is_smooth(Bsdf b) { return max(b.coat_alpha.x, b.coat_alpha.y) < BSDF_SMOOTH; }

#ifdef HAS_INTERFACE_TABLES
// A cell of a table has the values at its four corners. Its axes are the square roots of the cosine and of the width.
float interface_table(uint table, float cos_o, float alpha)
{
    vec2 at = sqrt(clamp(vec2(cos_o, alpha), 0.0, 1.0)) * vec2(INTERFACE_COLUMNS, INTERFACE_ROWS);
    uvec2 cell = min(uvec2(at), uvec2(INTERFACE_COLUMNS - 1u, INTERFACE_ROWS - 1u));
    vec2 part = at - vec2(cell);
    vec4 corners = uintBitsToFloat(fetch_materials(table + cell.y * INTERFACE_COLUMNS + cell.x));
    vec2 sides = mix(corners.xy, corners.zw, part.y);
    return mix(sides.x, sides.y, part.x);
}

float interface_table_mean(uint table, float alpha)
{
    float at = sqrt(clamp(alpha, 0.0, 1.0)) * float(INTERFACE_ROWS);
    uint cell = min(uint(at), INTERFACE_ROWS - 1u);
    vec2 ends = uintBitsToFloat(fetch_materials(table + INTERFACE_ROWS * INTERFACE_COLUMNS + cell).xy);
    return mix(ends.x, ends.y, at - float(cell));
}

// One width for two.
float interface_width(vec2 alpha) { return sqrt(alpha.x * alpha.y); }
#endif

// What it lets through to the base of light from a direction.
float interface_through(Bsdf b, float cos_o)
{
#ifdef HAS_INTERFACE_TABLES
    if (!interface_is_smooth(b)) return interface_table(b.through_table, cos_o, interface_width(b.coat_alpha));
#endif
    return 1.0 - fresnel_dielectric(cos_o, b.ior);
}

// The same of light from everywhere: 2 ∫ T(μ) μ dμ.
float interface_mean(Bsdf b)
{
#ifdef HAS_INTERFACE_TABLES
    if (!interface_is_smooth(b)) return interface_table_mean(b.through_table, interface_width(b.coat_alpha));
#endif
    return b.through_mean;
}

// A direction as it goes on below, bent by a smooth interface.
vec3 interface_below(Bsdf b, vec3 w)
{
    vec2 across = w.xy / b.ior;
    return vec3(across, safe_sqrt(1.0 - dot(across, across)));
}

// What facets reflect, and the density with which they are sampled. Both directions are outside.
CoatedValue interface_reflected(Bsdf b, vec3 wo, vec3 wi)
{
    if (interface_is_smooth(b)) return CoatedValue(vec3(0.0), 0.0);
    vec3 m = normalize(wo + wi);
    float cos_o = dot(wo, m);
    float f = ggx_distribution(m, b.coat_alpha) * ggx_masking_shadowing(wo, wi, b.coat_alpha) / (4.0 * wo.z * wi.z);
    return CoatedValue(vec3(f * fresnel_dielectric(cos_o, b.ior)), ggx_visible_pdf(wo, m, b.coat_alpha) / (4.0 * cos_o));
}
