// A cone with a soft edge: smooth from 0 at the outer cone to 1 at the inner (pbrt-v4, section 12.2.1).
#include "light/punctual.glsl"

LightSample spot_sample(Light light, Spot spot, vec3 from, vec2 u01)
{
    LightSample s = point_sample(light, from);
    float outer = circle_point(radians(spot.cone_angle)).x;
    float inner = circle_point(radians(max(spot.cone_angle - spot.falloff_angle, 0.0))).x;
    float t = clamp((-dot(s.wi, light.edge_u) - outer) / max(inner - outer, 1e-7), 0.0, 1.0);
    s.radiance *= t * t * (3.0 - 2.0 * t);
    return s;
}
