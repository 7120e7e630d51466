// Whether light reaches the paths in the shadow queue; what reaches them is added to their radiance.
#include "stages/wave.glsl"
#define ANY_HIT
#include "geometry/traverse.glsl"

void main()
{
    uint turn = counters[COUNTER_TURN];
    uint count = counters[COUNTER_SHADOWS + turn];
    uint i = interleaved_group((count + WORKGROUP - 1u) / WORKGROUP) * WORKGROUP + gl_LocalInvocationIndex;
    if (i >= count) return;
    uint slot = queue[shadow_queue(turn, i)];
    uvec4 a = fetch_shadows(slot * SHADOW_WORDS);
    uvec4 b = fetch_shadows(slot * SHADOW_WORDS + 1u);
    uvec4 c = fetch_shadows(slot * SHADOW_WORDS + 2u);
    bool resumed = c.w != 0u;
    Hit blocker = Hit(uintBitsToFloat(a.w), NONE, NONE);
    bool finished = traverse(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), resumed, 2u * slot + 1u, blocker);
    if (finished) {
        if (blocker.triangle == NONE && blocker.instance == NONE) {
            uvec4 radiance = fetch_paths(slot * PATH_WORDS + 1u);
            vec3 sum = uintBitsToFloat(radiance.xyz) + uintBitsToFloat(c.xyz);
            store_paths(slot * PATH_WORDS + 1u, uvec4(floatBitsToUint(sum), radiance.w));
        }
        if (resumed) store_shadows(slot * SHADOW_WORDS + 2u, uvec4(c.xyz, 0u));
        return;
    }
    // The rest waits in the other half; the path waits for it in shade.comp.
    store_shadows(slot * SHADOW_WORDS + 2u, uvec4(c.xyz, 1u));
    shadow_append(1u - turn, slot);
}
