// Maps between the world and the object space of an instance. Switch of the variant: HAS_MOTION (some instances move).
#include "shared/bindings.glsl"
#include "base/math.glsl"
#ifdef HAS_MOTION
#include "base/time.glsl"
#include "geometry/motion.glsl"
#endif

Instance instance_fetch(uint i)
{
    uint w = i * INSTANCE_WORDS;
    Instance instance = instance_unpack(fetch_instances(w), fetch_instances(w + 1u), fetch_instances(w + 2u),
                                        fetch_instances(w + 3u), fetch_instances(w + 4u), fetch_instances(w + 5u),
                                        fetch_instances(w + 6u), fetch_instances(w + 7u));
#ifdef HAS_MOTION
    // Where it is at the time of the path
    if (instance.motion != NONE) {
        Place place = motion_place(motion_fetch(instance.motion), path_time);
        Place inverse = motion_inverse(place);
        instance.world_row0 = place.row0;
        instance.world_row1 = place.row1;
        instance.world_row2 = place.row2;
        instance.object_row0 = inverse.row0;
        instance.object_row1 = inverse.row1;
        instance.object_row2 = inverse.row2;
    }
#endif
    return instance;
}

vec3 affine_point(vec4 row0, vec4 row1, vec4 row2, vec3 p)
{
    return vec3(dot(row0.xyz, p) + row0.w, dot(row1.xyz, p) + row1.w, dot(row2.xyz, p) + row2.w);
}

vec3 affine_vector(vec4 row0, vec4 row1, vec4 row2, vec3 v)
{
    return vec3(dot(row0.xyz, v), dot(row1.xyz, v), dot(row2.xyz, v));
}

vec3 object_point(Instance i, vec3 p) { return affine_point(i.object_row0, i.object_row1, i.object_row2, p); }
vec3 object_vector(Instance i, vec3 v) { return affine_vector(i.object_row0, i.object_row1, i.object_row2, v); }
vec3 world_point(Instance i, vec3 p) { return affine_point(i.world_row0, i.world_row1, i.world_row2, p); }
vec3 world_vector(Instance i, vec3 v) { return affine_vector(i.world_row0, i.world_row1, i.world_row2, v); }

// A bound of all numbers that are added to map a point without a coordinate above `reach` to the world.
float world_reach(Instance i, float reach)
{
    vec3 far = abs(vec3(i.world_row0.w, i.world_row1.w, i.world_row2.w));
    vec3 sums = affine_vector(abs(i.world_row0), abs(i.world_row1), abs(i.world_row2), vec3(reach));
    return max_component(far + sums);
}

// Normals go by the inverse transpose; not of unit length.
vec3 world_normal(Instance i, vec3 n) { return i.object_row0.xyz * n.x + i.object_row1.xyz * n.y + i.object_row2.xyz * n.z; }
vec3 object_normal(Instance i, vec3 n) { return i.world_row0.xyz * n.x + i.world_row1.xyz * n.y + i.world_row2.xyz * n.z; }
