// What a texture may depend on. Switches of the variant: HAS_VERTEX_COLOR, HAS_UV1.
#include "base/time.glsl"

struct TextureContext {
    vec3 position;          // in world space
    vec3 object_position;   // in the object space of the instance
    vec2 uv;                // of the surface, v upward
    vec3 normal;            // shading normal, world space
    vec3 object_normal;     // shading normal on the outside, object space; not of unit length
    float footprint;        // width of the pixel on the surface, scene units; 0 = a point
    float object_footprint; // the same in units of object space
    vec2 uv_footprint;      // the same in u and in v
    float time;             // in the shutter interval, 0..1
#ifdef HAS_VERTEX_COLOR
    vec4 vertex_color;      // linear; white where there is none
#endif
#ifdef HAS_UV1
    vec2 uv1;               // the second set, or the first where there is none
    vec2 uv1_footprint;     // width of the pixel there
#endif
};

// A point without a size at the time of the path, where world and object space are one.
TextureContext context_at(vec3 position, vec2 uv, vec3 normal)
{
    return TextureContext(position, position, uv, normal, normal, 0.0, 0.0, vec2(0.0), path_time
#ifdef HAS_VERTEX_COLOR
                          , vec4(1.0)
#endif
#ifdef HAS_UV1
                          , uv, vec2(0.0)
#endif
                          );
}
