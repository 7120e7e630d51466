// What lights without extent share; a point, and a picture thrown from one; and the textures that drive them all.
// Switches: TEXTURED_LIGHTS, EQUAL_AREA_LIGHTS, HAS_LIGHT_PROJECTION.
#include "light/generated/inputs.glsl"
#include "light/direction.glsl"

// A world direction in the space of the light, which shines along −z.
vec3 punctual_local(Light light, vec3 direction)
{
    return vec3(dot(cross(light.edge_u, light.edge_v), direction), dot(light.edge_v, direction), -dot(light.edge_u, direction));
}

LightSample point_sample(Light light, vec3 from)
{
    vec3 to = light.position - from;
    float d2 = dot(to, to);
    if (d2 == 0.0) return LIGHT_NOTHING;
    return LightSample(to * inversesqrt(d2), light.position, vec3(0.0), 0.0, light.radiance / d2, 1.0, true, false);
}

// Place in the picture of a direction that goes forward: (0, 0) to (1, 1) is what the light fills.
vec2 projection_uv(Light light, vec3 local) { return 0.5 - 0.5 * local.xy / (local.z * vec2(light.a, light.b)); }

// Whole inside a rectangle, nothing outside (pbrt-v4, section 12.2.3).
LightSample projection_sample(Light light, vec3 from)
{
    LightSample s = point_sample(light, from);
    vec3 local = punctual_local(light, -s.wi);
    bool inside = local.z < 0.0 && abs(local.x) <= -local.z * light.a && abs(local.y) <= -local.z * light.b;
    return inside ? s : LIGHT_NOTHING;
}

#ifdef TEXTURED_LIGHTS
// Factor that the texture of a light puts on what arrives from direction wi.
vec3 punctual_texture(Light light, vec3 from, vec3 wi)
{
    vec3 local = punctual_local(light, -wi);
    vec2 uv = equirectangular_uv(local);
#ifdef EQUAL_AREA_LIGHTS
    if (light.extra != 0u) uv = equal_area_uv(local);
#endif
#ifdef HAS_LIGHT_PROJECTION
    if (light.kind == LIGHT_PROJECTION) uv = projection_uv(light, local);
#endif
    TextureContext context = direction_context(-wi, local, uv);
    if (punctual_is_far(light.kind)) context = context_at(from, punctual_local(light, from).xy, light.edge_u);
    return max(texture_evaluate(light.texture, context).rgb, vec3(0.0));
}
#endif
