// The one place that moves a ray off the surface that it starts on.

// Part of the largest coordinate by which a ray is moved: 16 roundings of a float.
const float OFFSET = 1.0 / 1048576.0; // 2^-20

// Moves `p` to the side of the unit normal `n`, beyond the rounding errors of p and of the test of a ray from there against
// the surface that p is on. Both are a few roundings of the largest number that went into them, whatever p itself is
// (pbrt-v4, section 6.8): `reach` is a bound of the coordinates of the surface.
vec3 offset_ray_origin(vec3 p, vec3 n, float reach) { return p + n * (reach * OFFSET); }
