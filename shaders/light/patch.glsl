// Bilinear patches: uniform over u and v.
#include "light/sample.glsl"
#include "base/bilinear.glsl"

// The patch as seen from a point, in units of its size, whose square may be beyond a float.
struct PatchLight { Bilinear seen; float size; };

PatchLight patch_light(Light light, vec3 from)
{
    vec3 twist = vec3(light.uv0, light.uv1.x);
    float size = max_component(max(abs(light.edge_u), max(abs(light.edge_v), abs(twist))));
    vec3 corner = light.position - from;
    return PatchLight(Bilinear(corner / size, light.edge_u / size, light.edge_v / size, twist / size), size);
}

vec2 patch_light_uv(Light light, vec2 uv)
{
    vec4 first = uintBitsToFloat(fetch_instances(light.extra + 4u));
    vec4 second = uintBitsToFloat(fetch_instances(light.extra + 5u));
    return mix(mix(first.xy, first.zw, uv.x), mix(second.xy, second.zw, uv.x), uv.y);
}

// Normal and growth of the area at some u and v, in units of the size.
vec3 patch_across(PatchLight p, vec2 uv) { return cross(bilinear_du(p.seen, uv), bilinear_dv(p.seen, uv)); }

LightSample patch_sample_light(Light light, vec3 from, vec2 u01)
{
    PatchLight p = patch_light(light, from);
    vec3 across = patch_across(p, u01);
    vec3 normal = light.a * normalize_or(across, vec3(0.0));
    float pdf = area_to_solid_angle(length(across), vec3(0.0), bilinear_point(p.seen, u01), normal);
    vec3 point = light.position + u01.x * light.edge_u + u01.y * (light.edge_v + u01.x * vec3(light.uv0, light.uv1.x));
    return light_surface_point(light, from, pdf, context_at(point, patch_light_uv(light, u01), normal));
}

// The cosine is that of the normal at the point: where a ray grazes the patch, u and v are known to few digits.
float patch_light_pdf(Light light, vec3 from, vec3 point, vec3 normal)
{
    PatchLight p = patch_light(light, from);
    vec3 to = point - from;
    vec2 uv = bilinear_nearest(p.seen, normalize(to), length(to) / p.size).uv;
    return area_to_solid_angle(length(patch_across(p, uv)), vec3(0.0), to / p.size, normal);
}
