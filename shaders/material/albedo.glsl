// How much a rough layer reflects in all. Seen from one direction, a GGX layer whose facets reflect f0 + (f90 − f0) t, with t from 0
// head-on to 1 where they are grazed, reflects f0 A + f90 B (Karis 2013, "Real Shading in Unreal Engine 4"). Here B is an upper
// bound, within 0.1 of its integral and at most 0.002 below it, and A is 1 − B, so that what a base below is left makes no energy.
#include "base/math.glsl"

// B is (1 − cos)³ or (1 − cos)⁵ times a factor: the factor, and the part of the cube.
vec2 layer_shape(float alpha) { return vec2(1.0 / (1.0 + 20.0 * pow(alpha, 1.2)), min(25.0 * alpha, 1.0)); }

float layer_grazing(float cos_o, vec2 shape)
{
    float m = clamp(1.0 - cos_o, 0.0, 1.0);
    float m2 = m * m;
    return shape.x * m2 * m * mix(m2, 1.0, shape.y);
}

// The mean of layer_grazing over directions by their cosine: 2 / ((n + 1)(n + 2)) of a power n.
float layer_grazing_mean(vec2 shape) { return shape.x * mix(1.0 / 21.0, 1.0 / 10.0, shape.y); }

// What the layer reflects, where its facets reflect f0 head-on and 1 where they are grazed.
float layer_albedo(float grazing, float f0) { return f0 + (1.0 - f0) * grazing; }
