// Directions in the space of a light or of the environment, y up, and their places in pictures; and what a texture is told of one.
#include "base/math.glsl"
#include "texture/context.glsl"

// Longitude and latitude: v = 1 at +y; the middle column looks along −z and u grows towards +x there.
vec2 equirectangular_uv(vec3 d)
{
    return vec2(0.5 + atan(d.x, -d.z) * INV_TWO_PI, latitude_v(d.y, length(d.xz)));
}

vec3 equirectangular_direction(vec2 uv)
{
    vec2 longitude = circle_point((uv.x - 0.5) * 2.0 * PI);
    vec2 latitude = circle_point((uv.y - 0.5) * PI);
    return vec3(longitude.y * latitude.x, latitude.y, -longitude.x * latitude.x);
}

// Density over solid angle of a uniform choice of uv.
float equirectangular_pdf(vec2 uv) { return 1.0 / (2.0 * PI * PI * max(circle_point((uv.y - 0.5) * PI).x, 1e-6)); }

// The octahedral square of equal areas (Clarberg 2008; pbrt-v4, section 3.8.3, whose z is y here and whose y is −z): the middle is
// +y, the middles of the right and upper edges are +x and +z, and the corners are −y. The density of a uniform choice is 1 / 4π.
vec2 equal_area_uv(vec3 d)
{
    // √(1 − |y|), which keeps its digits at the poles, and the share of the quarter turn
    float r = min(length(d.xz) * inversesqrt(1.0 + abs(d.y)), 1.0);
    float turn = r > 0.0 ? atan(abs(d.z), abs(d.x)) * (2.0 * INV_PI) : 0.0;
    vec2 p = vec2(r - r * turn, r * turn);
    if (d.y < 0.0) p = 1.0 - p.yx;
    return 0.5 + 0.5 * vec2(d.x < 0.0 ? -p.x : p.x, d.z < 0.0 ? -p.y : p.y);
}

vec3 equal_area_direction(vec2 uv)
{
    vec2 p = 2.0 * uv - 1.0;
    float above = 1.0 - (abs(p.x) + abs(p.y));
    float r = 1.0 - abs(above);
    float phi = r > 0.0 ? ((abs(p.y) - abs(p.x)) / r + 1.0) * (0.25 * PI) : 0.0;
    float y = 1.0 - r * r;
    float across = r * safe_sqrt(2.0 - r * r);
    vec2 turned = circle_point(phi) * across;
    return vec3(p.x < 0.0 ? -turned.x : turned.x, 0.0, p.y < 0.0 ? -turned.y : turned.y)
        + vec3(0.0, above < 0.0 ? -y : y, 0.0);
}

// A direction in the world and in the space of its light, as the position and the object position of a texture.
TextureContext direction_context(vec3 world, vec3 local, vec2 uv)
{
    TextureContext context = context_at(world, uv, world);
    context.object_position = local;
    context.object_normal = local;
    return context;
}
