// The pixel filter, sampled in proportion to its magnitude.
// FILTER is a switch of the variant; its values are those of src/prepare/variant.rs.
#include "base/sampling.glsl"
#include "shared/bindings.glsl"

struct FilterSample {
    vec2 offset;   // from the middle of the pixel, radii of the filter
    bool negative; // the filter is below 0 there: the sample counts against the others
};

#if FILTER == FILTER_TABLE
// A place on one axis, -1 to 1, and the sign of the filter there. The cells are those of one side.
vec2 filter_table_sample(float u)
{
    float side = abs(2.0 * u - 1.0);
    uint cell = 0u;
    for (uint step = FILTER_CELLS / 2u; step > 0u; step /= 2u) {
        if (filter_cell_unpack(fetch_lens(frame.filter_cells + cell + step)).below <= side) cell += step;
    }
    FilterCell own = filter_cell_unpack(fetch_lens(frame.filter_cells + cell));
    float at = (float(cell) + clamp((side - own.below) / max(own.share, 1e-20), 0.0, 1.0)) / float(FILTER_CELLS);
    return vec2(u < 0.5 ? -at : at, own.sign);
}
#endif

FilterSample filter_sample(vec2 u01)
{
#if FILTER == FILTER_BOX
    return FilterSample(2.0 * u01 - 1.0, false);
#elif FILTER == FILTER_TENT
    return FilterSample(vec2(tent_sample(u01.x), tent_sample(u01.y)), false);
#elif FILTER == FILTER_GAUSSIAN
    return FilterSample(vec2(gaussian_sample(u01.x), gaussian_sample(u01.y)), false);
#elif FILTER == FILTER_BLACKMAN_HARRIS
    return FilterSample(vec2(blackman_harris_sample(u01.x), blackman_harris_sample(u01.y)), false);
#else
    vec2 x = filter_table_sample(u01.x);
    vec2 y = filter_table_sample(u01.y);
    return FilterSample(vec2(x.x, y.x), x.y * y.y < 0.0);
#endif
}
