//! Twins of `base/math.glsl` and `base/offset.glsl`.

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

pub fn normalize(a: [f64; 3]) -> [f64; 3] {
    let l = length(a);
    a.map(|c| c / l)
}

pub fn wide(a: [f32; 3]) -> [f64; 3] {
    a.map(f64::from)
}

/// From one point to another, in the floats that a kernel is given.
pub fn towards(origin: [f32; 3], target: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|i| target[i] - origin[i])
}

/// One coordinate of `offset_ray_origin`.
pub fn offset(p: f32, n: f32, reach: f32) -> f64 {
    f64::from(p) + f64::from(n) * f64::from(reach) * 2f64.powi(-20)
}
