// How kernels read 16-byte words, in two back ends from one source: texel buffers (TEXEL_FETCH, fastest on
// lavapipe) and storage buffers (fastest on GPUs, and the variant that naga reads). Used by bindings.glsl only.

#ifdef TEXEL_FETCH
#define READ_WORDS(number, view, block, words, texels, fetch) \
    layout(set = 0, binding = view) uniform usamplerBuffer texels; \
    uvec4 fetch(uint i) { return texelFetch(texels, int(i)); }
#define READ_WRITE_WORDS(number, view, block, words, texels, fetch, store) \
    layout(std430, set = 0, binding = number) writeonly buffer block { uvec4 words[]; }; \
    layout(set = 0, binding = view) uniform usamplerBuffer texels; \
    uvec4 fetch(uint i) { return texelFetch(texels, int(i)); } \
    void store(uint i, uvec4 word) { words[i] = word; }
#else
#define READ_WORDS(number, view, block, words, texels, fetch) \
    layout(std430, set = 0, binding = number) readonly buffer block { uvec4 words[]; }; \
    uvec4 fetch(uint i) { return words[i]; }
#define READ_WRITE_WORDS(number, view, block, words, texels, fetch, store) \
    layout(std430, set = 0, binding = number) buffer block { uvec4 words[]; }; \
    uvec4 fetch(uint i) { return words[i]; } \
    void store(uint i, uvec4 word) { words[i] = word; }
#endif
