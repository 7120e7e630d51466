// Cloth: the "Charlie" distribution of fibres (Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF"), as in
// KHR_materials_sheen.
#include "base/math.glsl"

// Smoother than this, grazed fibres would reflect more than they get.
const float SHEEN_LEAST_ROUGHNESS = 0.3;

float sheen_curve(float x, float alpha)
{
    float t = sqr(1.0 - alpha);
    float a = mix(21.5473, 25.3245, t);
    float b = mix(3.82987, 3.32435, t);
    float c = mix(0.19823, 0.16801, t);
    float d = mix(-1.97760, -1.27393, t);
    float e = mix(-4.32054, -4.85967, t);
    return a / (1.0 + b * pow(x, c)) + d * x + e;
}

float sheen_lambda(float cos_theta, float alpha)
{
    float x = cos_theta < 0.5 ? sheen_curve(cos_theta, alpha) : 2.0 * sheen_curve(0.5, alpha) - sheen_curve(1.0 - cos_theta, alpha);
    return exp(x);
}

// Distribution, masking and shadowing over 4 cos cos; both directions are above the surface.
float sheen_value(vec3 wo, vec3 wi, float roughness)
{
    float alpha = sqr(roughness);
    vec3 m = normalize(wo + wi);
    float sin_m = safe_sqrt(1.0 - sqr(m.z));
    float distribution = (2.0 + 1.0 / alpha) * pow(sin_m, 1.0 / alpha) * INV_TWO_PI;
    return distribution / ((1.0 + sheen_lambda(wo.z, alpha) + sheen_lambda(wi.z, alpha)) * 4.0 * wo.z * wi.z);
}

// An upper bound of what it reflects in all, seen from a direction: a fit to the integral of sheen_value, up to 0.17 above it.
float sheen_albedo(float cos_o, float roughness)
{
    vec3 powers = vec3(1.0, roughness, sqr(roughness));
    float a = dot(powers, vec3(0.3, -1.239, 1.068));
    float b = dot(powers, vec3(-5.524, 7.568, -3.058));
    float c = dot(powers, vec3(-1.639, 3.71, -2.955));
    return min(exp(a + b * cos_o + c * sqrt(cos_o)), 1.0);
}
