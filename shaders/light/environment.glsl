// Radiance from infinity: a constant, or an equirectangular picture sampled in proportion to its brightness.
// Switches: HAS_ENVIRONMENT, ENVIRONMENT_IMAGE.
#include "light/sample.glsl"

// World direction to uv: v = 1 at +y; the middle column looks along −z and u grows towards +x there.
vec2 environment_uv(vec3 direction)
{
    vec3 d = vec3(dot(frame.environment_row0, direction), dot(frame.environment_row1, direction),
                  dot(frame.environment_row2, direction));
    float u = 0.5 + atan(d.x, -d.z) * INV_TWO_PI;
    return vec2(u, latitude_v(d.y, length(d.xz)));
}

vec3 environment_direction(vec2 uv)
{
    float phi = (uv.x - 0.5) * 2.0 * PI;
    float theta = (uv.y - 0.5) * PI;
    vec3 d = vec3(sin(phi) * cos(theta), sin(theta), -cos(phi) * cos(theta));
    return frame.environment_row0 * d.x + frame.environment_row1 * d.y + frame.environment_row2 * d.z;
}

vec3 environment_radiance(vec3 direction)
{
#ifdef ENVIRONMENT_IMAGE
    vec2 uv = environment_uv(direction);
    TextureContext context = context_at(direction, uv, direction);
    return max(texture_evaluate(frame.environment_texture, context).rgb, vec3(0.0)) * frame.environment_scale;
#else
    return frame.environment_radiance;
#endif
}

EnvironmentCell environment_cell(uint i) { return environment_cell_unpack(fetch_environment(i)); }

// Density over solid angle of a cell, the solid angle taken where the direction is.
float environment_cell_density(float chance, float v)
{
    float cells = float(frame.environment_size.x * frame.environment_size.y);
    return chance * cells / (2.0 * PI * PI * max(cos((v - 0.5) * PI), 1e-6));
}

float environment_pdf(vec3 direction)
{
#ifdef ENVIRONMENT_IMAGE
    vec2 uv = environment_uv(direction);
    uvec2 at = min(uvec2(uv * vec2(frame.environment_size)), frame.environment_size - 1u);
    return environment_cell_density(environment_cell(at.y * frame.environment_size.x + at.x).chance, uv.y);
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
    float pdf = environment_cell_density(chance, uv.y);
#else
    vec3 wi = sphere_sample(u01);
    float pdf = INV_FOUR_PI;
#endif
    return LightSample(wi, vec3(0.0), vec3(0.0), 0.0, environment_radiance(wi), pdf, false, true);
}
