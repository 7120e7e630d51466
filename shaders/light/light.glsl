// The menu of lights, and the choice among them. Kinds that the scene does not use are left out by switches of the
// variant: HAS_LIGHTS, HAS_ENVIRONMENT, and HAS_LIGHT_… for each kind in the table.
#include "light/generated/menu.glsl"
#include "light/punctual.glsl"
#include "light/sphere.glsl"
#include "light/quad.glsl"
#include "light/disk.glsl"
#include "light/triangle.glsl"
#include "light/part.glsl"
#include "light/patch.glsl"
#include "light/environment.glsl"

LightSample light_sample_one(Light light, vec3 from, vec2 u01)
{
    switch (light.kind) {
#ifdef HAS_LIGHT_POINT
    case LIGHT_POINT: return point_sample(light, from);
#endif
#ifdef HAS_LIGHT_PROJECTION
    case LIGHT_PROJECTION: return projection_sample(light, from);
#endif
#ifdef HAS_LIGHT_SPHERE
    case LIGHT_SPHERE: return sphere_sample_light(light, from, u01);
#endif
#ifdef HAS_LIGHT_QUAD
    case LIGHT_QUAD: return quad_sample_light(light, from, u01);
#endif
#ifdef HAS_LIGHT_DISK
    case LIGHT_DISK: return disk_sample_light(light, from, u01);
#endif
#ifdef HAS_LIGHT_TRIANGLE
    case LIGHT_TRIANGLE: return triangle_sample_light(light, from, u01);
#endif
#ifdef HAS_LIGHT_PART
    case LIGHT_SPHERE_PART:
    case LIGHT_DISK_PART:
    case LIGHT_CYLINDER: return part_sample_light(light, from, u01);
#endif
#ifdef HAS_LIGHT_PATCH
    case LIGHT_PATCH: return patch_sample_light(light, from, u01);
#endif
    default: return punctual_sample(light, from, u01);
    }
}

// Chooses a light: the environment with its chance, else one of the table in proportion to its power. `pick` chooses
// a slot of the alias table; u01.x first decides who owns it, and what is left of it is used again.
LightSample light_sample(vec3 from, float pick, vec2 u01)
{
#ifdef HAS_ENVIRONMENT
    if (pick < frame.environment_chance) {
        LightSample s = environment_sample(pick / frame.environment_chance, u01);
        s.pdf *= frame.environment_chance;
        return s;
    }
    pick = (pick - frame.environment_chance) / (1.0 - frame.environment_chance);
#endif
#ifdef HAS_LIGHTS
    uint slot = min(uint(pick * float(frame.light_count)), frame.light_count - 1u);
    Light light = light_fetch(slot);
    bool own = u01.x < light.accept;
    u01.x = own ? u01.x / light.accept : (u01.x - light.accept) / (1.0 - light.accept);
    if (!own) light = light_fetch(light.alias);
    LightSample s = light_sample_one(light, from, u01);
    s.pdf *= light.chance;
#ifdef TEXTURED_LIGHTS
    if (s.delta && s.pdf > 0.0 && light.texture != NONE) s.radiance *= punctual_texture(light, from, s.wi);
#endif
    return s;
#else
    return LIGHT_NOTHING;
#endif
}

// Density over solid angle with which light_sample_one would have chosen a point of a light.
float light_pdf_one(Light light, vec3 from, vec3 point, vec3 normal)
{
    switch (light.kind) {
#ifdef HAS_LIGHT_SPHERE
    case LIGHT_SPHERE: return sphere_light_pdf(light, from, point, normal);
#endif
#ifdef HAS_LIGHT_QUAD
    case LIGHT_QUAD: return quad_light_pdf(light, from, point, normal);
#endif
#ifdef HAS_LIGHT_TRIANGLE
    case LIGHT_TRIANGLE: return triangle_light_pdf(light, from, point, normal);
#endif
#ifdef HAS_LIGHT_PART
    case LIGHT_SPHERE_PART:
    case LIGHT_DISK_PART:
    case LIGHT_CYLINDER: return part_light_pdf(light, from, point, normal);
#endif
#ifdef HAS_LIGHT_PATCH
    case LIGHT_PATCH: return patch_light_pdf(light, from, point, normal);
#endif
    default: return area_to_solid_angle(light.b, from, point, normal);
    }
}

// Density with which light_sample would have chosen a point on light `index`.
float light_pdf(uint index, vec3 from, vec3 point, vec3 normal)
{
#ifdef HAS_LIGHTS
    Light light = light_fetch(index);
    return light_pdf_one(light, from, point, normal) * light.chance;
#else
    return 0.0;
#endif
}

float environment_light_pdf(vec3 direction)
{
#ifdef HAS_ENVIRONMENT
    return environment_pdf(direction) * frame.environment_chance;
#else
    return 0.0;
#endif
}
