// Cellular noise (Worley 1996): distances to points that are scattered one in each unit cube.

// Three numbers of 32 bits from three (PCG3D: Jarzynski and Olano 2020, Hash Functions for GPU Rendering).
uvec3 pcg3d(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

float metric_euclidean(vec3 d) { return length(d); }
float metric_manhattan(vec3 d) { return abs(d.x) + abs(d.y) + abs(d.z); }
float metric_chebyshev(vec3 d) { return max(abs(d.x), max(abs(d.y), abs(d.z))); }

// The point of a cell, from its lower corner: 24 bits of each number.
vec3 worley_point(ivec3 cell) { return vec3(pcg3d(uvec3(cell)) >> 8u) * (1.0 / 16777216.0); }

// Distances to the nearest two of the points in the 27 cells around p. A float whose cell is no int is in the cell of 0.
#define WORLEY(name, metric) \
    vec2 name(vec3 p) \
    { \
        vec3 corner = floor(p); \
        bool known = max(abs(corner.x), max(abs(corner.y), abs(corner.z))) < 1e9; \
        ivec3 cell = known ? ivec3(corner) : ivec3(0); \
        vec3 inside = p - corner; \
        vec2 nearest = vec2(1e9); \
        for (int i = 0; i < 27; ++i) { \
            ivec3 step = ivec3(i % 3, (i / 3) % 3, i / 9) - 1; \
            float d = metric(vec3(step) + worley_point(cell + step) - inside); \
            nearest = d < nearest.x ? vec2(d, nearest.x) : vec2(nearest.x, min(d, nearest.y)); \
        } \
        return nearest; \
    }
WORLEY(worley_euclidean, metric_euclidean)
WORLEY(worley_manhattan, metric_manhattan)
WORLEY(worley_chebyshev, metric_chebyshev)

float worley_f1(vec2 nearest) { return nearest.x; }
float worley_f2(vec2 nearest) { return nearest.y; }
float worley_difference(vec2 nearest) { return nearest.y - nearest.x; }

// Distance to the nearest plane between the nearest point and another (Quilez, Voronoi borders).
float worley_edge(vec3 p)
{
    vec3 corner = floor(p);
    bool known = max(abs(corner.x), max(abs(corner.y), abs(corner.z))) < 1e9;
    ivec3 cell = known ? ivec3(corner) : ivec3(0);
    vec3 inside = p - corner;
    vec3 nearest = vec3(1e4);
    for (int i = 0; i < 27; ++i) {
        ivec3 step = ivec3(i % 3, (i / 3) % 3, i / 9) - 1;
        vec3 to = vec3(step) + worley_point(cell + step) - inside;
        if (dot(to, to) < dot(nearest, nearest)) nearest = to;
    }
    float edge = 1e9;
    for (int i = 0; i < 27; ++i) {
        ivec3 step = ivec3(i % 3, (i / 3) % 3, i / 9) - 1;
        vec3 to = vec3(step) + worley_point(cell + step) - inside;
        vec3 across = to - nearest;
        float apart = dot(across, across);
        if (apart > 1e-12) edge = min(edge, 0.5 * dot(to + nearest, across) * inversesqrt(apart));
    }
    return edge;
}
