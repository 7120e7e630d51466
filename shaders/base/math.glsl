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

// The unit vector along v, however short v is; `otherwise` when it is 0.
vec3 normalize_or(vec3 v, vec3 otherwise)
{
    float most = max_component(abs(v));
    return most > 0.0 ? normalize(v / most) : otherwise;
}

bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

// asin for 0 <= x <= 1, good to 2e-7 (Cephes, asinf). GLSL's own may be off by 4e-4, and is on Mesa.
float asin_positive(float x)
{
    bool steep = x > 0.5;
    float z = steep ? 0.5 * (1.0 - x) : x * x;
    float s = steep ? sqrt(z) : x;
    float series = (((4.2163199048e-2 * z + 2.4181311049e-2) * z + 4.5470025998e-2) * z + 7.4953002686e-2) * z + 1.6666752422e-1;
    float angle = s + s * z * series;
    return steep ? 0.5 * PI - 2.0 * angle : angle;
}

// Arc sine and cosine for solid angles and for places in pictures; arguments beyond ±1 count as ±1.
float asin_exact(float x)
{
    float angle = asin_positive(min(abs(x), 1.0));
    return x < 0.0 ? -angle : angle;
}

float acos_exact(float x) { return 0.5 * PI - asin_exact(x); }

// The point of the unit circle at an angle, cosine and sine, good to 1e-7 (Cephes, sinf and cosf). Vulkan lets GLSL's own be off by
// 5e-4, and on SwiftShader they are by 5e-5: directions of other lengths than 1, and points of lamps that are inside of them.
vec2 circle_point(float angle)
{
    float quarters = floor(angle * (2.0 * INV_PI) + 0.5);
    float x = ((angle - quarters * 1.5703125) - quarters * 4.837512969970703e-4) - quarters * 7.549789954891882e-8;
    float z = x * x;
    float s = x + x * z * ((-1.9515295891e-4 * z + 8.3321608736e-3) * z - 1.6666654611e-1);
    float c = 1.0 - 0.5 * z + z * z * ((2.443315711809948e-5 * z - 1.388731625493765e-3) * z + 4.166664568298827e-2);
    int turns = int(quarters);
    vec2 p = (turns & 1) != 0 ? vec2(-s, c) : vec2(c, s);
    return (turns & 2) != 0 ? -p : p;
}

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
    // By the direction of `along`: the square of its length may be beyond a float
    along /= max(max_component(abs(along)), 1e-37);
    vec3 x = along - z * dot(z, along);
    float l = dot(x, x);
    if (l < 1e-12) return basis_around(z);
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

// Balance of two sampling strategies, power heuristic with exponent 2 (Veach 1997, section 9.2.4).
float power_heuristic(float own, float other)
{
    // By the ratio: the square of a density may be beyond a float
    float ratio = other / own;
    return own > 0.0 ? 1.0 / (1.0 + ratio * ratio) : 0.0;
}
