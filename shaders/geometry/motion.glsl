// Where things that move are at a time: src/prepare/motion.rs takes their maps apart.
#include "base/math.glsl"
#include "shared/bindings.glsl"

// Rows of a map to the world, and of its inverse.
struct Place { vec4 row0; vec4 row1; vec4 row2; };

Motion motion_fetch(uint w)
{
    return motion_unpack(fetch_instances(w), fetch_instances(w + 1u), fetch_instances(w + 2u), fetch_instances(w + 3u),
                         fetch_instances(w + 4u), fetch_instances(w + 5u), fetch_instances(w + 6u),
                         fetch_instances(w + 7u), fetch_instances(w + 8u), fetch_instances(w + 9u));
}

// World from object. A difference times the time, so that what is the same at both ends stays what it is.
Place motion_place(Motion m, float time)
{
    // The rotation turns steadily along the great arc (Shoemake 1985)
    vec2 part = circle_point(m.angle * time);
    vec4 q = normalize(m.turn * part.x + m.turn_across * part.y);
    vec3 v = q.xyz;
    vec3 twice = 2.0 * v;
    vec3 turn0 = vec3(1.0 - twice.y * v.y - twice.z * v.z, twice.x * v.y - twice.z * q.w, twice.x * v.z + twice.y * q.w);
    vec3 turn1 = vec3(twice.x * v.y + twice.z * q.w, 1.0 - twice.x * v.x - twice.z * v.z, twice.y * v.z - twice.x * q.w);
    vec3 turn2 = vec3(twice.x * v.z - twice.y * q.w, twice.y * v.z + twice.x * q.w, 1.0 - twice.x * v.x - twice.y * v.y);
    vec4 a = m.open_row0 + time * (m.close_row0 - m.open_row0);
    vec4 b = m.open_row1 + time * (m.close_row1 - m.open_row1);
    vec4 c = m.open_row2 + time * (m.close_row2 - m.open_row2);
    vec3 at = m.open_position + time * (m.close_position - m.open_position);
    return Place(turn0.x * a + turn0.y * b + turn0.z * c + vec4(0.0, 0.0, 0.0, at.x),
                 turn1.x * a + turn1.y * b + turn1.z * c + vec4(0.0, 0.0, 0.0, at.y),
                 turn2.x * a + turn2.y * b + turn2.z * c + vec4(0.0, 0.0, 0.0, at.z));
}

// Object from world. Columns of unit length first: a float may not hold the product of three lengths.
Place motion_inverse(Place place)
{
    vec3 x = vec3(place.row0.x, place.row1.x, place.row2.x);
    vec3 y = vec3(place.row0.y, place.row1.y, place.row2.y);
    vec3 z = vec3(place.row0.z, place.row1.z, place.row2.z);
    vec3 sizes = vec3(length(x), length(y), length(z));
    x /= sizes.x;
    y /= sizes.y;
    z /= sizes.z;
    vec3 yz = cross(y, z);
    float volume = dot(x, yz);
    vec3 row0 = yz / volume / sizes.x;
    vec3 row1 = cross(z, x) / volume / sizes.y;
    vec3 row2 = cross(x, y) / volume / sizes.z;
    vec3 at = vec3(place.row0.w, place.row1.w, place.row2.w);
    return Place(vec4(row0, -dot(row0, at)), vec4(row1, -dot(row1, at)), vec4(row2, -dot(row2, at)));
}
