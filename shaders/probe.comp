// Tests only: evaluates leaf functions over an array. The virtual file `generated/probe.glsl` defines
// `void probe(uint i)`, which reads with fetch_points(...) and writes with store_values(...).
#include "shared/bindings.glsl"
#include "generated/probe.glsl"

layout(local_size_x = WORKGROUP) in;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < frame.point_count) probe(i);
}
