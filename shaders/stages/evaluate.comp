// Texture values at points that the host names: for heights, power tables and baking.
// Point: reference and three spare lanes; position, footprint; uv and time; normal: four words. Value: one word.
#include "stages/wave.glsl"
#include "texture/context.glsl"
#include "generated/textures.glsl"

const uint POINT_WORDS = 4u;

void main()
{
    uint i = interleaved_group() * WORKGROUP + gl_LocalInvocationIndex;
    if (i >= frame.point_count) return;
    uint reference = fetch_points(i * POINT_WORDS).x;
    vec4 position = uintBitsToFloat(fetch_points(i * POINT_WORDS + 1u));
    vec4 uv_time = uintBitsToFloat(fetch_points(i * POINT_WORDS + 2u));
    vec3 normal = uintBitsToFloat(fetch_points(i * POINT_WORDS + 3u).xyz);
    TextureContext context = TextureContext(position.xyz, position.xyz, uv_time.xy, normal, position.w, uv_time.z);
    store_values(i, floatBitsToUint(texture_evaluate(reference, context)));
}
