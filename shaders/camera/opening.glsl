// The shape of an opening, within the unit circle or, for a picture, the square around it.
// OPENING is a switch of the variant; its values are those of src/prepare/variant.rs.
#include "base/sampling.glsl"
#include "shared/bindings.glsl"

// A point of the opening. `pick` is used where the opening is a picture.
vec2 opening_sample(vec2 u01, vec2 pick)
{
#if OPENING == OPENING_PICTURE
    // A cell by the alias method, then a point in it; row 0 is the top
    uint count = frame.opening_size.x * frame.opening_size.y;
    uint cell = min(uint(pick.x * float(count)), count - 1u);
    OpeningCell own = opening_cell_unpack(fetch_lens(frame.opening_cells + cell));
    if (pick.y >= own.accept) cell = own.alias;
    vec2 corner = vec2(cell % frame.opening_size.x, cell / frame.opening_size.x);
    vec2 p = 2.0 * (corner + u01) / vec2(frame.opening_size) - 1.0;
    p.y = -p.y;
#elif OPENING == OPENING_POLYGON
    vec2 p = polygon_sample(u01, frame.blades, frame.blade_rotation);
#else
    vec2 p = disk_sample(u01);
#endif
    return p * frame.opening_half;
}

// What passes at a point, with a mean over the opening that makes it as bright as a round one.
float opening_weight(vec2 at)
{
    vec2 p = at / frame.opening_half;
#if OPENING == OPENING_PICTURE
    vec2 place = 0.5 * vec2(p.x + 1.0, 1.0 - p.y) * vec2(frame.opening_size);
    if (any(lessThan(place, vec2(0.0))) || any(greaterThanEqual(place, vec2(frame.opening_size)))) return 0.0;
    uvec2 cell = min(uvec2(place), frame.opening_size - 1u);
    return opening_cell_unpack(fetch_lens(frame.opening_cells + cell.y * frame.opening_size.x + cell.x)).weight;
#elif OPENING == OPENING_POLYGON
    // Turned until the middle of a side is at angle 0
    float sector = 2.0 * PI / float(frame.blades);
    float angle = atan(p.y, p.x) - frame.blade_rotation;
    float off = angle - (floor(angle / sector) + 0.5) * sector;
    return length(p) * circle_point(off).x <= circle_point(0.5 * sector).x ? 1.0 : 0.0;
#else
    return dot(p, p) <= 1.0 ? 1.0 : 0.0;
#endif
}
