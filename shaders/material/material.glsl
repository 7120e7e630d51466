// What a material does with light, and what it is at one point. The menu of its kinds is generated: `bsdf_eval`, `bsdf_pdf` and
// `bsdf_sample`.
#include "material/generated/menu.glsl"
#include "material/interface.glsl"
#include "material/point.glsl"

// Whether some of its samples are mirror directions.
bool bsdf_may_mirror(Bsdf b)
{
#ifdef HAS_COATED_DIFFUSE
    if (b.kind == MATERIAL_COATED_DIFFUSE) return interface_is_smooth(b);
#endif
    return bsdf_is_specular(b);
}
