// Whether a ray goes on where its surface is not there, coloured by it: no event of the path.
#include "stages/wave.glsl"
#include "geometry/passing.glsl"

bool passes_through(inout Path path, Surface surface, vec3 direction)
{
    Detail detail = detail_fetch(surface.material);
    TextureContext context = surface_context(surface, surface.normal);
    if (opacity_stops(path_opacity_key(path), surface, opacity_at(detail, context), direction)) return false;
    path.throughput *= filter_at(detail, context);
    return true;
}
