// A rectangle: uniform over the solid angle that it fills (Ureña, Fajardo and King 2013). A parallelogram that is no
// rectangle, and one too small or too far for that to be exact: uniform over its area.
#include "light/sample.glsl"

struct SphericalRectangle {
    vec3 x; vec3 y; vec3 z;           // frame of the rectangle, seen from `from`; lengths are in units of its edges' sum
    float x0; float x1; float y0; float y1; float z0;
    float b0; float b1; float k;
    float solid_angle;                // 0 = not to be used
};

const float SPHERICAL_RECTANGLE_LEAST = 2e-3; // steradians, known to about 1e-6; below it, uniform area is as good

SphericalRectangle spherical_rectangle(Light light, vec3 from)
{
    SphericalRectangle r;
    float lx = length(light.edge_u);
    float ly = length(light.edge_v);
    r.x = light.edge_u / lx;
    r.y = light.edge_v / ly;
    r.z = cross(r.x, r.y);
    float unit = lx + ly;
    lx /= unit;
    ly /= unit;
    vec3 d = (light.position - from) / unit;
    r.z0 = dot(d, r.z);
    if (r.z0 > 0.0) {
        r.z = -r.z;
        r.z0 = -r.z0;
    }
    r.x0 = dot(d, r.x);
    r.y0 = dot(d, r.y);
    r.x1 = r.x0 + lx;
    r.y1 = r.y0 + ly;
    vec4 nz = vec4(r.y0, r.x1, r.y1, r.x0) * vec4(-1.0, 1.0, 1.0, -1.0);
    vec4 other = vec4(r.y0, r.x1, r.y1, r.x0);
    nz = nz * inversesqrt(max(r.z0 * r.z0 + other * other, 1e-30));
    float g0 = acos_exact(-nz.x * nz.y);
    float g1 = acos_exact(-nz.y * nz.z);
    float g2 = acos_exact(-nz.z * nz.w);
    float g3 = acos_exact(-nz.w * nz.x);
    r.b0 = nz.x;
    r.b1 = nz.z;
    r.k = 2.0 * PI - g2 - g3;
    float solid_angle = g0 + g1 - r.k;
    bool rectangle = abs(dot(r.x, r.y)) < 1e-4 && abs(r.z0) > 1e-6;
    r.solid_angle = rectangle && solid_angle > SPHERICAL_RECTANGLE_LEAST && solid_angle < 6.22 ? solid_angle : 0.0;
    return r;
}

// Position on the rectangle, in units of its edges.
vec2 spherical_rectangle_sample(SphericalRectangle r, vec2 u01)
{
    float au = u01.x * r.solid_angle + r.k;
    vec2 turned = circle_point(au);
    float fu = (turned.x * r.b0 - r.b1) / turned.y;
    float cu = clamp(inversesqrt(fu * fu + r.b0 * r.b0) * (fu > 0.0 ? 1.0 : -1.0), -1.0, 1.0);
    float xu = -(cu * r.z0) * inversesqrt(max(1.0 - cu * cu, 1e-12));
    xu = clamp(xu, r.x0, r.x1);
    float d2 = xu * xu + r.z0 * r.z0;
    float h0 = r.y0 * inversesqrt(d2 + r.y0 * r.y0);
    float h1 = r.y1 * inversesqrt(d2 + r.y1 * r.y1);
    float hv = h0 + u01.y * (h1 - h0);
    float hv2 = hv * hv;
    float yv = hv2 < 0.99999 ? hv * sqrt(d2) * inversesqrt(1.0 - hv2) : r.y1;
    return vec2((xu - r.x0) / (r.x1 - r.x0), clamp((yv - r.y0) / (r.y1 - r.y0), 0.0, 1.0));
}

LightSample quad_sample_light(Light light, vec3 from, vec2 u01)
{
    SphericalRectangle r = spherical_rectangle(light, from);
    bool spherical = r.solid_angle > 0.0;
    vec2 at = spherical ? spherical_rectangle_sample(r, u01) : u01;
    vec3 point = light.position + at.x * light.edge_u + at.y * light.edge_v;
    vec3 normal = light.a * light_plane_normal(light);
    float pdf = spherical ? 1.0 / r.solid_angle : area_to_solid_angle(light.b, from, point, normal);
    return light_surface_point(light, from, pdf, context_at(point, at, normal));
}

float quad_light_pdf(Light light, vec3 from, vec3 point, vec3 normal)
{
    SphericalRectangle r = spherical_rectangle(light, from);
    return r.solid_angle > 0.0 ? 1.0 / r.solid_angle : area_to_solid_angle(light.b, from, point, normal);
}
