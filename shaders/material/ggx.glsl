// The anisotropic GGX distribution of microfacet normals (Trowbridge and Reitz 1975; Walter et al. 2007; Heitz 2014),
// in a frame whose z is the shading normal. Visible normals are sampled (Heitz 2018).
#include "base/sampling.glsl"

float ggx_distribution(vec3 m, vec2 alpha)
{
    vec3 s = vec3(m.xy / alpha, m.z);
    float d = dot(s, s);
    return 1.0 / (PI * alpha.x * alpha.y * d * d);
}

float ggx_lambda(vec3 w, vec2 alpha)
{
    vec2 s = w.xy * alpha;
    float tan2 = dot(s, s) / max(w.z * w.z, 1e-20);
    return 0.5 * (sqrt(1.0 + tan2) - 1.0);
}

float ggx_masking(vec3 w, vec2 alpha) { return 1.0 / (1.0 + ggx_lambda(w, alpha)); }

// Height-correlated masking and shadowing.
float ggx_masking_shadowing(vec3 wo, vec3 wi, vec2 alpha)
{
    return 1.0 / (1.0 + ggx_lambda(wo, alpha) + ggx_lambda(wi, alpha));
}

// Density of the normals that `wo` sees, wo.z > 0.
float ggx_visible_pdf(vec3 wo, vec3 m, vec2 alpha)
{
    return ggx_masking(wo, alpha) / max(abs(wo.z), 1e-20) * ggx_distribution(m, alpha) * max(dot(wo, m), 0.0);
}

vec3 ggx_visible_sample(vec3 wo, vec2 alpha, vec2 u01)
{
    vec3 v = normalize(vec3(alpha * wo.xy, wo.z));
    float l = dot(v.xy, v.xy);
    vec3 t1 = l > 0.0 ? vec3(-v.y, v.x, 0.0) * inversesqrt(l) : vec3(1.0, 0.0, 0.0);
    vec3 t2 = cross(v, t1);
    vec2 p = disk_sample(u01);
    float s = 0.5 * (1.0 + v.z);
    p.y = mix(safe_sqrt(1.0 - p.x * p.x), p.y, s);
    vec3 n = p.x * t1 + p.y * t2 + safe_sqrt(1.0 - dot(p, p)) * v;
    return normalize(vec3(alpha * n.xy, max(n.z, 1e-6)));
}
