//! Twins of `material/fresnel.glsl`.

/// Unpolarised reflectance of a dielectric from Snell's angles and Fresnel's sine and tangent laws in their cosine form.
pub fn fresnel_dielectric(cos_i: f64, eta: f64) -> f64 {
    let [parallel, perpendicular] = fresnel_dielectric_parts(cos_i, eta);
    0.5 * (parallel + perpendicular)
}

/// Reflectance of the two polarisations.
pub fn fresnel_dielectric_parts(cos_i: f64, eta: f64) -> [f64; 2] {
    let sin_t = (1.0 - cos_i * cos_i).sqrt() / eta;
    if sin_t >= 1.0 {
        return [1.0, 1.0];
    }
    let cos_t = sin_t.asin().cos();
    let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    [parallel * parallel, perpendicular * perpendicular]
}

/// Unpolarised reflectance of a conductor with index η + i k, in complex numbers (pbrt-v4, section 9.3.6).
pub fn fresnel_conductor(cos_i: f64, eta: f64, k: f64) -> f64 {
    type Complex = (f64, f64);
    let sub = |a: Complex, b: Complex| (a.0 - b.0, a.1 - b.1);
    let add = |a: Complex, b: Complex| (a.0 + b.0, a.1 + b.1);
    let mul = |a: Complex, b: Complex| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
    let div = |a: Complex, b: Complex| {
        let d = b.0 * b.0 + b.1 * b.1;
        ((a.0 * b.0 + a.1 * b.1) / d, (a.1 * b.0 - a.0 * b.1) / d)
    };
    let norm = |a: Complex| a.0 * a.0 + a.1 * a.1;
    let sqrt = |a: Complex| {
        let r = norm(a).sqrt();
        let re = ((r + a.0) / 2.0).max(0.0).sqrt();
        let im = ((r - a.0) / 2.0).max(0.0).sqrt();
        (re, if a.1 < 0.0 { -im } else { im })
    };
    let n = (eta, k);
    let c = (cos_i, 0.0);
    let sin2_t = div((1.0 - cos_i * cos_i, 0.0), mul(n, n));
    let cos_t = sqrt(sub((1.0, 0.0), sin2_t));
    let parallel = div(sub(mul(n, c), cos_t), add(mul(n, c), cos_t));
    let perpendicular = div(sub(c, mul(n, cos_t)), add(c, mul(n, cos_t)));
    0.5 * (norm(parallel) + norm(perpendicular))
}

pub fn fresnel_schlick(cos_i: f64, at_normal: f64) -> f64 {
    at_normal + (1.0 - at_normal) * (1.0 - cos_i).powi(5)
}
