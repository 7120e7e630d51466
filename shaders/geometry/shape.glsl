// The menu of instances that are no meshes. Switches of the variant: HAS_SPHERES, HAS_DISKS, HAS_PARTS (tubes, and parts of spheres
// and disks), HAS_PATCHES.
#include "geometry/instance.glsl"
#include "geometry/quadric.glsl"
#ifdef HAS_PARTS
#include "geometry/part.glsl"
#endif
#ifdef HAS_PATCHES
#include "geometry/patch.glsl"
#endif

#if defined(HAS_SPHERES) || defined(HAS_DISKS) || defined(HAS_PARTS) || defined(HAS_PATCHES)
#define HAS_SHAPES
#endif

// Whether a ray may meet a shape twice.
#if defined(HAS_SPHERES) || defined(HAS_PARTS) || defined(HAS_PATCHES)
#define HAS_ROUND_SHAPES
#endif

bool is_part(Instance shape) { return shape.kind >= INSTANCE_SPHERE_PART && shape.kind <= INSTANCE_CYLINDER; }

// Nearest t_min < t < t_max of a ray in the object space of a shape; false for a mesh.
bool shape_hit(Instance shape, vec3 o, vec3 d, float t_min, float t_max, out float t)
{
    bool found = false;
    t = 0.0;
#ifdef HAS_SPHERES
    if (shape.kind == INSTANCE_SPHERE) found = sphere_hit(o, d, t_min, t_max, t);
#endif
#ifdef HAS_DISKS
    if (shape.kind == INSTANCE_DISK) found = disk_hit(o, d, t_min, t_max, t);
#endif
#ifdef HAS_PARTS
    if (is_part(shape)) found = part_hit(part_fetch(shape.root), shape.kind, o, d, t_min, t_max, t);
#endif
#ifdef HAS_PATCHES
    if (shape.kind == INSTANCE_PATCH) found = patch_hit(patch_fetch(shape.root), o, d, t_min, t_max, t);
#endif
    return found;
}
