// What sampling a light gives, and what every light draws from.
#include "shared/bindings.glsl"
#include "base/sampling.glsl"
#include "texture/context.glsl"
#include "generated/textures.glsl"
#ifdef HAS_OPACITY
#include "detail/opacity.glsl"
#endif

struct LightSample {
    vec3 wi;          // unit direction to the light
    vec3 point;       // point on the light; unused when infinite
    vec3 normal;      // normal there, towards the receiver; 0 for a light without surface
    float reach;      // largest of the coordinates that point was computed from
    vec3 radiance;    // arriving, before visibility; intensity / d² or irradiance for a light without extent
    float pdf;        // solid angle; 1 for a light without extent; 0 = no light arrives
    bool delta;       // without extent: the BSDF cannot find it
    bool infinite;
};

const LightSample LIGHT_NOTHING = LightSample(vec3(0, 0, 1), vec3(0), vec3(0), 0.0, vec3(0), 0.0, true, false);

Light light_fetch(uint i)
{
    uint w = i * LIGHT_WORDS;
    return light_unpack(fetch_lights(w), fetch_lights(w + 1u), fetch_lights(w + 2u), fetch_lights(w + 3u),
                        fetch_lights(w + 4u), fetch_lights(w + 5u), fetch_lights(w + 6u));
}

// Unit normal of a flat light by the turn from edge_u to edge_v, however long they are.
vec3 light_plane_normal(Light light)
{
    return normalize(cross(normalize_or(light.edge_u, vec3(0.0)), normalize_or(light.edge_v, vec3(0.0))));
}

// A point on a surface light, chosen with the solid-angle density `pdf`: what textures are told of it has its place.
LightSample light_surface_point(Light light, vec3 from, float pdf, TextureContext context)
{
    vec3 point = context.position;
    vec3 normal = context.normal;
    vec3 wi = normalize(point - from);
    float facing = -dot(wi, normal);
    if (!(pdf > 0.0) || (facing <= 0.0 && light.two_sided == 0u) || facing == 0.0) return LIGHT_NOTHING;
    vec3 radiance = light.radiance;
#ifdef TEXTURED_EMISSION
    if (light.texture != NONE) radiance *= max(texture_evaluate(light.texture, context).rgb, vec3(0.0));
#endif
#ifdef HAS_OPACITY
    radiance *= opacity_at(detail_fetch(light.material), context);
#endif
    vec3 reach = abs(light.position) + abs(light.edge_u) + abs(light.edge_v);
    if (light.kind == LIGHT_SPHERE) reach += abs(vec3(light.uv0, light.uv1.x));
    return LightSample(wi, point, facing < 0.0 ? -normal : normal, max_component(reach), radiance, pdf, false, false);
}

// Density over solid angle of a uniform choice over `area`.
float area_to_solid_angle(float area, vec3 from, vec3 point, vec3 normal)
{
    vec3 to = point - from;
    float d2 = dot(to, to);
    float facing = abs(dot(to, normal)) * inversesqrt(d2);
    return facing > 0.0 ? d2 / (facing * area) : 0.0;
}
