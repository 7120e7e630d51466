// A triangle: uniform over the solid angle that it fills (Arvo 1995; the part of it by a half vector, Peters 2021,
// section 3). One too small for that to be exact, or nearly a hemisphere: uniform over its area.
// Switches of the variant: HAS_VERTEX_COLOR, HAS_UV1.
#include "light/sample.glsl"
#include "texture/corners.glsl"

struct SphericalTriangle {
    vec3 a; vec3 b; vec3 c;           // directions to its vertices
    float g0; float g1; float g2;     // tan of half the solid angle is g0 / (g1 + g2)
    float solid_angle;                // 0 = not to be used
};

// Steradians between which the solid angle is known to 1e-4 of itself.
const float SPHERICAL_TRIANGLE_LEAST = 3e-4;
const float SPHERICAL_TRIANGLE_MOST = 6.22;

SphericalTriangle spherical_triangle(Light light, vec3 from)
{
    SphericalTriangle t;
    vec3 to = light.position - from;
    t.a = normalize(to);
    t.b = normalize(to + light.edge_u);
    t.c = normalize(to + light.edge_v);
    // Of a small triangle the differences keep their digits
    t.g0 = abs(dot(t.a, cross(t.b - t.a, t.c - t.a)));
    t.g1 = dot(t.a, t.c) + dot(t.b, t.c);
    t.g2 = 1.0 + dot(t.a, t.b);
    float solid_angle = 2.0 * atan(t.g0, t.g1 + t.g2);
    t.solid_angle = solid_angle > SPHERICAL_TRIANGLE_LEAST && solid_angle < SPHERICAL_TRIANGLE_MOST ? solid_angle : 0.0;
    return t;
}

// A direction: u01.x chooses the corner c' on the edge from a to c so that a, b and c' fill its share of the solid angle,
// u01.y a point of the arc from b to c' so that caps about b are uniform.
vec3 spherical_triangle_sample(SphericalTriangle t, vec2 u01)
{
    vec2 half_angle = circle_point(0.5 * u01.x * t.solid_angle);
    vec3 between = (t.g0 * half_angle.x - t.g1 * half_angle.y) * t.a + t.g2 * half_angle.y * t.c;
    vec3 corner = normalize(2.0 * dot(t.a, between) / dot(between, between) * between - t.a);
    // 1 − cos of the whole arc, and of its part
    vec3 chord = corner - t.b;
    float whole = 0.5 * dot(chord, chord);
    float part = u01.y * whole;
    vec3 across = normalize_or(chord + whole * t.b, vec3(0.0));
    return (1.0 - part) * t.b + safe_sqrt(part * (2.0 - part)) * across;
}

// Barycentric coordinates of the second and third vertex where a direction meets the triangle.
vec2 triangle_meeting(Light light, vec3 from, vec3 direction)
{
    vec3 to = from - light.position;
    vec3 p = cross(direction, light.edge_v);
    vec3 q = cross(to, light.edge_u);
    vec2 at = max(vec2(dot(to, p), dot(direction, q)) / dot(light.edge_u, p), vec2(0.0));
    return at / max(at.x + at.y, 1.0);
}

#if defined(HAS_VERTEX_COLOR) || defined(HAS_UV1)
// What the corners of a triangle have for textures alone.
void light_corners(uint extra, vec2 bary, inout TextureContext context)
{
    if ((extra & LIGHT_TURNED) != 0u) bary = bary.yx;
    extra &= ~LIGHT_TURNED;
#ifdef HAS_VERTEX_COLOR
    context.vertex_color = corner_color(extra, bary);
#endif
#ifdef HAS_UV1
    context.uv1 = corner_uv(corner_uvs(extra), bary);
#endif
}
#endif

LightSample triangle_sample_light(Light light, vec3 from, vec2 u01)
{
    SphericalTriangle t = spherical_triangle(light, from);
    bool spherical = t.solid_angle > 0.0;
    vec2 at = spherical ? triangle_meeting(light, from, spherical_triangle_sample(t, u01)) : triangle_sample(u01);
    vec3 point = light.position + at.x * light.edge_u + at.y * light.edge_v;
    vec3 normal = light_plane_normal(light);
    vec2 uv = light.uv0 + at.x * light.uv1 + at.y * light.uv2;
    float pdf = spherical ? 1.0 / t.solid_angle : area_to_solid_angle(light.b, from, point, normal);
    TextureContext context = context_at(point, uv, normal);
#if defined(HAS_VERTEX_COLOR) || defined(HAS_UV1)
    if (light.extra != NONE) light_corners(light.extra, at, context);
#endif
    return light_surface_point(light, from, pdf, context);
}

float triangle_light_pdf(Light light, vec3 from, vec3 point, vec3 normal)
{
    SphericalTriangle t = spherical_triangle(light, from);
    return t.solid_angle > 0.0 ? 1.0 / t.solid_angle : area_to_solid_angle(light.b, from, point, normal);
}
