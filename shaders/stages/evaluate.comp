// Texture values at points that the host names: for heights, power tables and baking. A value is one word. Switches of the variant:
// HAS_VERTEX_COLOR, HAS_UV1.
#include "stages/wave.glsl"
#include "texture/context.glsl"
#include "generated/textures.glsl"

void main()
{
    uint i = interleaved_group() * WORKGROUP + gl_LocalInvocationIndex;
    if (i >= frame.point_count) return;
    uint w = i * TEXTURE_POINT_WORDS;
    TexturePoint p = texture_point_unpack(fetch_points(w), fetch_points(w + 1u), fetch_points(w + 2u), fetch_points(w + 3u), fetch_points(w + 4u),
                                          fetch_points(w + 5u), fetch_points(w + 6u));
    TextureContext context = TextureContext(p.position, p.object_position, p.uv, p.normal, p.object_normal, p.footprint,
                                            p.object_footprint, p.uv_footprint, p.time
#ifdef HAS_VERTEX_COLOR
                                            , p.vertex_color
#endif
#ifdef HAS_UV1
                                            , p.uv1, p.uv1_footprint
#endif
                                            );
    store_values(i, floatBitsToUint(texture_evaluate(p.reference, context)));
}
