// Radiance from infinity: a constant, or a texture by direction, of which a picture is sampled in proportion to its brightness.
// Switches: HAS_ENVIRONMENT, ENVIRONMENT_IMAGE, ENVIRONMENT_EQUAL_AREA.
#include "light/sample.glsl"
#include "light/direction.glsl"

#ifdef ENVIRONMENT_EQUAL_AREA
#define ENVIRONMENT_UV(d) equal_area_uv(d)
#define ENVIRONMENT_DIRECTION(uv) equal_area_direction(uv)
#define ENVIRONMENT_UV_PDF(uv) INV_FOUR_PI
#else
#define ENVIRONMENT_UV(d) equirectangular_uv(d)
#define ENVIRONMENT_DIRECTION(uv) equirectangular_direction(uv)
#define ENVIRONMENT_UV_PDF(uv) equirectangular_pdf(uv)
#endif

// A world direction in the space of the environment.
vec3 environment_local(vec3 direction)
{
    return vec3(dot(frame.environment_row0, direction), dot(frame.environment_row1, direction),
                dot(frame.environment_row2, direction));
}

vec3 environment_direction(vec2 uv)
{
    vec3 d = ENVIRONMENT_DIRECTION(uv);
    return frame.environment_row0 * d.x + frame.environment_row1 * d.y + frame.environment_row2 * d.z;
}

vec3 environment_radiance(vec3 direction)
{
#ifdef ENVIRONMENT_IMAGE
    vec3 local = environment_local(direction);
    TextureContext context = direction_context(direction, local, ENVIRONMENT_UV(local));
    return max(texture_evaluate(frame.environment_texture, context).rgb, vec3(0.0)) * frame.environment_scale;
#else
    return frame.environment_radiance;
#endif
}

EnvironmentCell environment_cell(uint i) { return environment_cell_unpack(fetch_environment(i)); }

// Density over solid angle of a cell, the solid angle taken where the direction is.
float environment_cell_density(float chance, vec2 uv)
{
    float cells = float(frame.environment_size.x * frame.environment_size.y);
    return chance * cells * ENVIRONMENT_UV_PDF(uv);
}

float environment_pdf(vec3 direction)
{
#ifdef ENVIRONMENT_IMAGE
    vec2 uv = ENVIRONMENT_UV(environment_local(direction));
    uvec2 at = min(uvec2(uv * vec2(frame.environment_size)), frame.environment_size - 1u);
    return environment_cell_density(environment_cell(at.y * frame.environment_size.x + at.x).chance, uv);
#else
    return INV_FOUR_PI;
#endif
}

// `pick` chooses a slot of the alias table; u01.x first decides who owns it, and what is left of it is used again.
LightSample environment_sample(float pick, vec2 u01)
{
#ifdef ENVIRONMENT_IMAGE
    uint cells = frame.environment_size.x * frame.environment_size.y;
    uint slot = min(uint(pick * float(cells)), cells - 1u);
    EnvironmentCell cell = environment_cell(slot);
    bool own = u01.x < cell.accept;
    uint index = own ? slot : cell.alias;
    float rest = own ? u01.x / cell.accept : (u01.x - cell.accept) / (1.0 - cell.accept);
    float chance = own ? cell.chance : environment_cell(cell.alias).chance;
    vec2 corner = vec2(index % frame.environment_size.x, index / frame.environment_size.x);
    vec2 uv = (corner + vec2(rest, u01.y)) / vec2(frame.environment_size);
    vec3 wi = environment_direction(uv);
    float pdf = environment_cell_density(chance, uv);
#else
    vec3 wi = sphere_sample(u01);
    float pdf = INV_FOUR_PI;
#endif
    return LightSample(wi, vec3(0.0), vec3(0.0), 0.0, environment_radiance(wi), pdf, false, true);
}
