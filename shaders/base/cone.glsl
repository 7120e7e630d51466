// The cone around a ray that its pixel sees (Amanatides 1984; Akenine-Möller et al. 2021), through surfaces that bend it.
// It is as wide as the square root of the area across it.

struct Cone {
    float width;  // scene units, never below 0
    float spread; // what the width grows by in a unit of length; below 0 before a focus
};

// The cone further along its ray: behind a focus it opens again.
Cone cone_after(Cone cone, float way)
{
    float width = cone.width + cone.spread * way;
    return Cone(abs(width), width < 0.0 ? -cone.spread : cone.spread);
}

// A mirror turns a ray by twice what its normal turns. Where the surface is met at an angle θ that is 2 k width / cos θ in the plane
// of the ray and 2 k width cos θ across it (Coddington's equations), 2 k width in the mean. k: curvature of the surface,
// above 0 where it bulges towards the ray.
Cone cone_reflected(Cone cone, float k) { return Cone(cone.width, cone.spread + 2.0 * k * cone.width); }

// Refraction to an index that is `eta` times as large. The differential of Snell's law (Igehy 1999, section 3.2.3) is, across the plane of
// the ray, spread' = spread / eta - k width (cos θ' - cos θ / eta). In the plane both terms are larger by cos θ / cos θ' and 1 / (cos θ cos θ'),
// and the width grows by cos θ' / cos θ; these are the geometric means, which keep width · spread · index.
Cone cone_refracted(Cone cone, float k, float eta, float cos_i, float cos_t)
{
    float turn = k * cone.width * (cos_t - cos_i / eta);
    return Cone(cone.width * sqrt(cos_t / cos_i), (cone.spread * cos_i / eta - turn) * inversesqrt(cos_i * cos_t));
}

// Mean curvature of a surface by the derivatives of its points and of its unit normals: half the trace of its shape operator, above 0 where it
// bulges towards the normals. Where u has no direction, as at the pole of a sphere, the curvature along v.
float mean_curvature(vec3 dpdu, vec3 dpdv, vec3 dndu, vec3 dndv)
{
    float along_u = length(dpdu);
    bool has_u = along_u > 0.0;
    vec3 x = has_u ? dpdu / along_u : vec3(0.0);
    vec3 n_x = has_u ? dndu / along_u : vec3(0.0);
    float shear = dot(x, dpdv);
    vec3 y = dpdv - shear * x;
    float across = length(y);
    if (!(across > 0.0)) return 0.0;
    float k_y = dot((dndv - shear * n_x) / across, y / across);
    return has_u ? 0.5 * (dot(n_x, x) + k_y) : k_y;
}
