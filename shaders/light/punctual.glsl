// Lights without extent: point, spot, distant.
#include "light/sample.glsl"

LightSample point_sample(Light light, vec3 from)
{
    vec3 to = light.position - from;
    float d2 = dot(to, to);
    if (d2 == 0.0) return LIGHT_NOTHING;
    return LightSample(to * inversesqrt(d2), light.position, vec3(0.0), 0.0, light.radiance / d2, 1.0, true, false);
}

// Smooth from 0 at the outer cone to 1 at the inner (pbrt-v4, section 12.2.1).
LightSample spot_sample(Light light, vec3 from)
{
    LightSample s = point_sample(light, from);
    float cos_theta = -dot(s.wi, light.edge_u);
    float t = clamp((cos_theta - light.b) / max(light.a - light.b, 1e-7), 0.0, 1.0);
    s.radiance *= t * t * (3.0 - 2.0 * t);
    return s;
}

LightSample distant_sample(Light light)
{
    return LightSample(-light.edge_u, vec3(0.0), vec3(0.0), 0.0, light.radiance, 1.0, true, true);
}
