// Constants and small pure functions.

const float PI = 3.14159265358979;
const float INV_PI = 0.318309886183791;
const float INV_TWO_PI = 0.159154943091895;
const float INV_FOUR_PI = 0.0795774715459477;
const float FAR = 3.0e38;                 // beyond every hit: the largest round float, because WGSL has no infinity
const float ONE_MINUS_EPSILON = 0.99999994; // the largest float below 1

float sqr(float x) { return x * x; }

float safe_sqrt(float x) { return sqrt(max(x, 0.0)); }

float max_component(vec3 v) { return max(v.x, max(v.y, v.z)); }

float mean_component(vec3 v) { return (v.x + v.y + v.z) * (1.0 / 3.0); }

bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

// An orthonormal basis around a unit vector (Duff et al. 2017).
struct Basis { vec3 x; vec3 y; vec3 z; };

Basis basis_around(vec3 z)
{
    float s = z.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + z.z);
    float b = z.x * z.y * a;
    return Basis(vec3(1.0 + s * z.x * z.x * a, s * b, -s * z.x), vec3(b, s + z.y * z.y * a, -z.y), z);
}

// A basis around z whose x is as near to `along` as can be.
Basis basis_along(vec3 z, vec3 along)
{
    vec3 x = along - z * dot(z, along);
    float l = dot(x, x);
    if (l < 1e-20) return basis_around(z);
    x *= inversesqrt(l);
    return Basis(x, cross(z, x), z);
}

vec3 basis_to_world(Basis b, vec3 v) { return b.x * v.x + b.y * v.y + b.z * v.z; }

vec3 basis_to_local(Basis b, vec3 v) { return vec3(dot(b.x, v), dot(b.y, v), dot(b.z, v)); }

// Angle about the origin from +x in turns, in [0, 1); 0 at the origin.
float turns(vec2 p)
{
    float u = p == vec2(0.0) ? 0.0 : atan(p.y, p.x) * INV_TWO_PI;
    return u < 0.0 ? u + 1.0 : u;
}

// v of a direction, in [0, 1): its height over its distance from the axis, as latitude. By atan, since asin of Mesa is
// off by 2e-4; below 1 at the pole, which would be the other pole of a picture that is repeated.
float latitude_v(float height, float from_axis)
{
    return min(0.5 + atan(height, from_axis) * INV_PI, ONE_MINUS_EPSILON);
}

// uv of a point on the unit sphere: longitude about +z from +x, and latitude. The length of p may be off by rounding.
vec2 sphere_uv(vec3 p) { return vec2(turns(p.xy), latitude_v(p.z, length(p.xy))); }

// uv of a point in the unit disk: angle from +x, and 1 at the centre down to 0 at the rim.
vec2 disk_uv(vec2 p) { return vec2(turns(p), 1.0 - length(p)); }

// Arc cosine to 2e-8 and rounding (Abramowitz and Stegun 4.4.46); acos of Mesa is off by 1e-4.
float arc_cosine(float x)
{
    float a = abs(x);
    float series = 1.5707963050 + a * (-0.2145988016 + a * (0.0889789874 + a * (-0.0501743046 + a * (0.0308918810
        + a * (-0.0170881256 + a * (0.0066700901 - a * 0.0012624911))))));
    float angle = safe_sqrt(1.0 - a) * series;
    return x < 0.0 ? PI - angle : angle;
}

// Balance of two sampling strategies, power heuristic with exponent 2 (Veach 1997, section 9.2.4).
float power_heuristic(float own, float other)
{
    float a = own * own;
    float b = other * other;
    return a > 0.0 ? a / (a + b) : 0.0;
}
