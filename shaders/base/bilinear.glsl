// Bilinear patches, p(u, v) = p00 + u · along_u + v · along_v + u v · twist, and rays against them (Reshetov 2019, «Cool
// Patches»; pbrt-v4, section 6.6).
#include "base/math.glsl"

struct Bilinear { vec3 p00; vec3 along_u; vec3 along_v; vec3 twist; };

Bilinear bilinear_patch(vec3 p00, vec3 p10, vec3 p01, vec3 p11)
{
    vec3 along_v = p01 - p00;
    return Bilinear(p00, p10 - p00, along_v, (p11 - p10) - along_v);
}

vec3 bilinear_du(Bilinear b, vec2 uv) { return b.along_u + uv.y * b.twist; }
vec3 bilinear_dv(Bilinear b, vec2 uv) { return b.along_v + uv.x * b.twist; }
vec3 bilinear_point(Bilinear b, vec2 uv) { return b.p00 + uv.x * b.along_u + uv.y * bilinear_dv(b, uv); }

// The values of four corners at uv.
vec3 bilinear_mix(vec3 c00, vec3 c10, vec3 c01, vec3 c11, vec2 uv) { return mix(mix(c00, c10, uv.x), mix(c01, c11, uv.x), uv.y); }

// Where a ray meets a patch; t = -1: not at all.
struct BilinearHit { float t; vec2 uv; };

// Where the ray from the origin comes nearest to the line of the patch at u: v by its angle, and t by the plane that touches
// the patch there, so that an error of u and v counts as its square and a ray that leaves the patch does not meet it again.
BilinearHit bilinear_at(Bilinear b, vec3 direction, float u, vec2 margin)
{
    vec3 line = b.along_v + u * b.twist;
    vec3 from = b.p00 + u * b.along_u;
    vec3 across = cross(line, direction);
    float size = dot(across, across);
    float v = size > 0.0 ? -dot(cross(from, direction), across) / size : -1.0;
    vec3 along_u = b.along_u + v * b.twist;
    vec3 normal = cross(along_u, line);
    float cosine = dot(normal, direction);
    vec2 edge = min(margin / abs(cosine), vec2(1e-3));
    bool inside = abs(u - 0.5) <= 0.5 + edge.x && abs(v - 0.5) <= 0.5 + edge.y && cosine != 0.0;
    return BilinearHit(inside ? dot(normal, from + v * line) / cosine : -1.0, clamp(vec2(u, v), 0.0, 1.0));
}

// Both meetings of a ray from the origin. A line of constant u meets it where (from(u) × line(u)) · direction = 0, which is
// quadratic in u; solved without cancellation, also where the patch is flat and it is linear.
struct BilinearHits { BilinearHit first; BilinearHit second; };

BilinearHits bilinear_hits(Bilinear b, vec3 direction)
{
    vec3 v_across = cross(b.along_v, direction);
    vec3 twist_across = cross(b.twist, direction);
    float c = dot(b.p00, v_across);
    float linear = dot(b.along_u, v_across) + dot(b.p00, twist_across);
    float quadratic = dot(b.along_u, twist_across);
    float discriminant = linear * linear - 4.0 * quadratic * c;
    float root = safe_sqrt(discriminant);
    float k = -0.5 * (linear < 0.0 ? linear - root : linear + root);
    // What rounding of the corners about the origin moves u and v by, times the cosine: so far beyond its edges a patch is
    // hit, that no ray slips between neighbours
    vec3 reach = max(abs(b.p00), max(abs(b.along_u), abs(b.along_v)));
    vec2 across = vec2(length(v_across), length(cross(b.along_u, direction))) + length(twist_across);
    vec2 margin = 1e-6 * max_component(reach) * across;
    BilinearHit first = bilinear_at(b, direction, k != 0.0 ? c / k : -1.0, margin);
    BilinearHit second = bilinear_at(b, direction, quadratic != 0.0 ? k / quadratic : -1.0, margin);
    if (discriminant < 0.0) {
        first.t = -1.0;
        second.t = -1.0;
    }
    return BilinearHits(first, second);
}

// The meeting nearest to a point of a ray that is known to meet the patch there, but for rounding.
BilinearHit bilinear_nearest(Bilinear b, vec3 direction, float t)
{
    BilinearHits hits = bilinear_hits(b, direction);
    vec3 off_first = bilinear_point(b, hits.first.uv) - t * direction;
    vec3 off_second = bilinear_point(b, hits.second.uv) - t * direction;
    if (dot(off_second, off_second) < dot(off_first, off_first)) return hits.second;
    return hits.first;
}
