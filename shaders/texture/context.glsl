// What a texture may depend on.

struct TextureContext {
    vec3 position;        // in world space
    vec3 object_position; // in the object space of the instance
    vec2 uv;              // of the surface, v upward
    vec3 normal;          // shading normal, world space
    float footprint;      // width of the pixel on the surface, scene units; 0 = a point
    float time;           // in the shutter interval, 0..1
};
