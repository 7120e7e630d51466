// The colours that a path may have alone, and their wavelengths.

const uint COLOR_RED = 0u; // green and blue follow

// Dominant wavelengths of the primaries of Rec. 709, in µm.
const vec3 COLOR_WAVELENGTHS = vec3(0.6114, 0.5491, 0.4643);

// 1 in the channel of one colour.
vec3 color_mask(uint color) { return vec3(equal(uvec3(color), COLOR_RED + uvec3(0u, 1u, 2u))); }
