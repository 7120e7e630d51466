// Light from a disk infinitely far away, evenly bright: parallel where its angle is 0. Directions are chosen evenly over what the disk fills
// of the plane across its axis, so that a surface that faces it gets its irradiance whatever the angle.
#include "base/sampling.glsl"
#include "light/punctual.glsl"

LightSample distant_sample(Light light, Distant distant, vec3 from, vec2 u01)
{
    vec2 across = circle_point(radians(0.5 * distant.angle)).y * disk_sample(u01);
    float along = safe_sqrt(1.0 - dot(across, across));
    vec3 right = cross(light.edge_u, light.edge_v);
    vec3 wi = across.x * right + across.y * light.edge_v - along * light.edge_u;
    return LightSample(wi, vec3(0.0), vec3(0.0), 0.0, light.radiance / along, 1.0, true, true);
}
