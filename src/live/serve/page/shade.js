// The shader that makes colours of the screen of the numbers of a picture.

/** What the shader calls the planes and the curves: places in these lists. */
export const AOVS = ["color", "albedo", "normal", "depth", "alpha", "variance"];
export const CURVES = ["srgb", "linear", "aces", "agx"];

export const VERTEX = `#version 300 es
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);
}`;

/** The curves of src/film/tone.rs, with the same numbers. */
const TONE = `
vec3 srgb(vec3 v) {
    return mix(12.92 * v, 1.055 * pow(max(v, 0.0), vec3(1.0 / 2.4)) - 0.055, greaterThan(v, vec3(0.0031308)));
}

vec3 aces(vec3 v) {
    // Columns are rows here: vectors are multiplied from the left
    const mat3 INPUT = mat3(0.59719, 0.35458, 0.04823, 0.076, 0.90834, 0.01566, 0.0284, 0.13383, 0.83777);
    const mat3 OUTPUT = mat3(1.60475, -0.53108, -0.07367, -0.10208, 1.10813, -0.00605, -0.00327, -0.07276, 1.07602);
    v = v * INPUT;
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.432951) + 0.238081);
    return v * OUTPUT;
}

vec3 agx(vec3 v) {
    const mat3 INSET = mat3(0.842479062253094, 0.0784335999999992, 0.0792237451477643,
                            0.0423282422610123, 0.878468636469772, 0.0791661274605434,
                            0.0423756549057051, 0.0784336, 0.879142973793104);
    const mat3 OUTSET = mat3(1.19687900512017, -0.0980208811401368, -0.0990297440797205,
                             -0.0528968517574562, 1.15190312990417, -0.0989611768448433,
                             -0.0529716355144438, -0.0980434501171241, 1.15107367264116);
    const vec2 STOPS = vec2(-12.47393, 4.026069);
    // What is darker than the first stop is black, and 0 has no logarithm
    v = (clamp(log2(max(v * INSET, 1e-10)), STOPS.x, STOPS.y) - STOPS.x) / (STOPS.y - STOPS.x);
    v = (((((15.5 * v - 40.14) * v + 31.96) * v - 6.868) * v + 0.4298) * v + 0.1191) * v - 0.00232;
    return v * OUTSET;
}

vec3 tone(int curve, vec3 v) {
    if (curve == 0) return srgb(v);
    if (curve == 1) return v;
    v = clamp(v, 0.0, 1e12);
    return curve == 2 ? srgb(aces(v)) : agx(v);
}
`;

export const FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2DArray;

struct Side {
    vec4 window;   // what is rendered: x, y, width, height in pixels of the picture
    vec2 size;     // of the whole picture
    vec2 stretch;  // pixels of it to one of the picture that the zoom is about
    float texel;   // pixels of the picture to one texel
    float gain;
    int curve;
    bool there;
};

uniform sampler2DArray u_now;
uniform sampler2DArray u_before;
uniform Side u_side[2];
uniform int u_aov;
uniform vec2 u_range;    // nearest and farthest
uniform vec3 u_place;    // pan and zoom, in pixels of the screen
uniform float u_height;  // of the canvas
uniform float u_wipe;    // left of it is the generation before
uniform vec3 u_around;
out vec4 color;
${TONE}
const int MOST_TAPS = 8;

vec3 fetch(bool before, ivec2 at) {
    if (u_aov == 3 || u_aov == 4) {
        return vec3(before ? texelFetch(u_before, ivec3(at, 0), 0).r : texelFetch(u_now, ivec3(at, 0), 0).r);
    }
    vec3 v;
    for (int i = 0; i < 3; i++) {
        v[i] = before ? texelFetch(u_before, ivec3(at, i), 0).r : texelFetch(u_now, ivec3(at, i), 0).r;
    }
    return v;
}

/// The numbers as they are shown, of one texel.
vec3 linear(vec3 v) {
    if (u_aov == 2) return 0.5 * v + 0.5;
    if (u_aov == 3) {
        // The farthest is not quite black: that is what is nowhere
        bool somewhere = v.r >= u_range.x && v.r <= u_range.y;
        return somewhere ? vec3(1.0 - 0.9 * (v.r - u_range.x) / max(u_range.y - u_range.x, 1e-20)) : vec3(0.0);
    }
    return v;
}

vec3 shown(Side side, vec3 v) {
    if (u_aov == 0) return tone(side.curve, v * side.gain);
    if (u_aov == 1) return srgb(v);
    if (u_aov == 5) return srgb(v * side.gain * side.gain);
    return v;
}

void main() {
    vec2 screen = vec2(gl_FragCoord.x, u_height - gl_FragCoord.y);
    bool before = screen.x < u_wipe;
    Side side = u_side[before ? 1 : 0];
    vec2 point = (screen - u_place.xy) / u_place.z * side.stretch;
    color = vec4(u_around, 1.0);
    if (!side.there || any(lessThan(point, vec2(0.0))) || any(greaterThanEqual(point, side.size))) return;
    color.rgb = vec3(0.0);
    point -= side.window.xy;
    if (any(lessThan(point, vec2(0.0))) || any(greaterThanEqual(point, side.window.zw))) return;
    // The mean of the texels under a pixel of the screen
    vec2 width = side.stretch / (u_place.z * side.texel);
    ivec2 taps = clamp(ivec2(ceil(width - 0.01)), 1, MOST_TAPS);
    ivec2 last = ivec2(ceil(side.window.zw / side.texel)) - 1;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < taps.y; y++) {
        for (int x = 0; x < taps.x; x++) {
            vec2 offset = ((vec2(x, y) + 0.5) / vec2(taps) - 0.5) * width * vec2(greaterThan(taps, ivec2(1)));
            sum += linear(fetch(before, clamp(ivec2(floor(point / side.texel + offset)), ivec2(0), last)));
        }
    }
    color.rgb = clamp(shown(side, sum / float(taps.x * taps.y)), 0.0, 1.0);
}`;
