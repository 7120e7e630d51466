// What the parts of a scattering event share. Switches of the variant: HAS_FOOTPRINT, HAS_UV1, HAS_FRONT_ONLY.
#include "stages/wave.glsl"
#include "base/cone.glsl"
#include "base/offset.glsl"
#include "geometry/surface.glsl"
#include "texture/context.glsl"

// Indirect light of a sample may be limited (firefly_clamp); direct light is not.
vec3 limited(vec3 radiance, uint depth)
{
    float most = max_component(radiance);
    bool clamped = frame.firefly_clamp > 0.0 && depth > 1u && most > frame.firefly_clamp;
    return clamped ? radiance * (frame.firefly_clamp / most) : radiance;
}

// Where a ray leaves a surface; `side` is its cosine with the geometric normal.
vec3 ray_origin(Surface surface, float side)
{
    return offset_ray_origin(surface.position, side < 0.0 ? -surface.geometric : surface.geometric, surface.reach);
}

// Whether what is reflected goes on where the surface is; `side` as above. By vertex normals a direction may be above a coarse surface that
// is below its triangles: there is no surface to stop it where that is not there from behind.
bool may_reflect(Surface surface, float side)
{
#ifdef HAS_FRONT_ONLY
    return !surface.front_only || side > 0.0;
#else
    return true;
#endif
}

// A direction that was chosen with density p stands for the light of a cone of solid angle 1 / (64 p): its spread times √(πp).
const float SAMPLE_SPREAD = 0.25;
// A cone that is wider sees nearly all directions.
const float MOST_SPREAD = 8.0;
// Cosine below which a slanted pixel is not made longer.
const float LEAST_SLANT = 0.05;

// The same point without a size.
TextureContext sharp(TextureContext context)
{
    context.footprint = 0.0;
    context.object_footprint = 0.0;
    context.uv_footprint = vec2(0.0);
#ifdef HAS_UV1
    context.uv1_footprint = vec2(0.0);
#endif
    return context;
}

// The same with the width of the pixel there. Where the ray is slanted the pixel is longer than wide:
// the width is the side of a square of its area.
TextureContext context_of(Surface surface, WaveRay ray, vec3 facing_normal)
{
    TextureContext context = surface_context(surface, facing_normal);
#ifdef HAS_FOOTPRINT
    float width = cone_after(Cone(ray.width, ray.spread), distance(ray.origin, surface.position)).width;
    context.footprint = width * inversesqrt(max(abs(dot(ray.direction, surface.geometric)), LEAST_SLANT));
    context.object_footprint = context.footprint * surface.object_rate;
    context.uv_footprint = context.footprint * surface.uv_rate;
#ifdef HAS_UV1
    mat2x3 along = by_uv1(surface, surface.dpdu, surface.dpdv);
    vec2 lengths = vec2(length(along[0]), length(along[1]));
    context.uv1_footprint = context.footprint * mix(vec2(0.0), 1.0 / lengths, greaterThan(lengths, vec2(0.0)));
#endif
#endif
    return context;
}
