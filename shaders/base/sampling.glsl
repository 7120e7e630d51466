// Random numbers to points and directions, each with its density.
#include "base/math.glsl"

// The unit disk from the unit square, keeping strata together (Shirley and Chiu 1997).
vec2 disk_sample(vec2 u01)
{
    vec2 p = 2.0 * u01 - 1.0;
    if (p.x == 0.0 && p.y == 0.0) return vec2(0.0);
    bool wide = abs(p.x) > abs(p.y);
    float r = wide ? p.x : p.y;
    float phi = wide ? 0.25 * PI * (p.y / p.x) : 0.5 * PI - 0.25 * PI * (p.x / p.y);
    return r * circle_point(phi);
}

// A regular polygon with its corners on the unit circle, the first at angle `rotation`.
vec2 polygon_sample(vec2 u01, uint corners, float rotation)
{
    // A triangle between the centre and one side, then a point in it.
    float n = float(corners);
    float side = min(floor(u01.x * n), n - 1.0);
    float s = sqrt(u01.x * n - side);
    float a = 2.0 * PI * side / n + rotation;
    return s * mix(circle_point(a), circle_point(a + 2.0 * PI / n), u01.y);
}

// Directions about +z, density cos θ / π.
vec3 cosine_hemisphere_sample(vec2 u01)
{
    vec2 d = disk_sample(u01);
    return vec3(d, safe_sqrt(1.0 - dot(d, d)));
}

float cosine_hemisphere_pdf(float cos_theta) { return max(cos_theta, 0.0) * INV_PI; }

// Directions, density 1 / 4π.
vec3 sphere_sample(vec2 u01)
{
    float z = 1.0 - 2.0 * u01.x;
    float r = safe_sqrt(1.0 - z * z);
    return vec3(r * circle_point(2.0 * PI * u01.y), z);
}

// Barycentric coordinates of the second and third vertex, uniform over a triangle (Heitz 2019).
vec2 triangle_sample(vec2 u01)
{
    if (u01.y > u01.x) {
        float x = 0.5 * u01.x;
        return vec2(x, u01.y - x);
    }
    float y = 0.5 * u01.y;
    return vec2(u01.x - y, y);
}

// Offsets of filters, in units of their radius, in proportion to their value.
float tent_sample(float u) { return u < 0.5 ? sqrt(2.0 * u) - 1.0 : 1.0 - sqrt(2.0 - 2.0 * u); }

// Inverts an increasing function on [-1, 1] by bisection: CDF is a macro of one argument.
#define INVERT_BY_BISECTION(CDF, u, result) \
    float low = -1.0; \
    float high = 1.0; \
    for (int i = 0; i < 20; ++i) { \
        float middle = 0.5 * (low + high); \
        if (CDF(middle) < u) low = middle; else high = middle; \
    } \
    float result = 0.5 * (low + high);

// Error function, absolute error below 1.5e-7 (Abramowitz and Stegun 7.1.26).
float error_function(float x)
{
    float t = 1.0 / (1.0 + 0.3275911 * abs(x));
    float series = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
    float y = 1.0 - series * exp(-x * x);
    return x < 0.0 ? -y : y;
}

// Gaussian with σ = radius / 3, less its value at the radius: exp(−4.5 x²) − exp(−4.5).
float gaussian_cdf(float x)
{
    float edge = exp(-4.5);
    float half_width = 0.417771379105; // √(π / 4.5) / 2
    float whole = 2.0 * (half_width * error_function(2.12132034) - edge);
    return (half_width * (error_function(2.12132034 * x) + error_function(2.12132034)) - edge * (x + 1.0)) / whole;
}

float gaussian_sample(float u)
{
    INVERT_BY_BISECTION(gaussian_cdf, u, x)
    return x;
}

// Blackman-Harris window (Harris 1978, four terms, 92 dB).
float blackman_harris_cdf(float x)
{
    float t = 0.5 * (x + 1.0);
    vec3 sines = vec3(circle_point(2.0 * PI * t).y, circle_point(4.0 * PI * t).y, circle_point(6.0 * PI * t).y);
    return (0.35875 * t + dot(vec3(-0.48829, 0.14128 / 2.0, -0.01168 / 3.0) * INV_TWO_PI, sines)) / 0.35875;
}

float blackman_harris_sample(float u)
{
    INVERT_BY_BISECTION(blackman_harris_cdf, u, x)
    return x;
}
