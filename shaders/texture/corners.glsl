// What only textures ask of the corners of a triangle: colours, and a second set of uv. Switches of the variant: HAS_VERTEX_COLOR, HAS_UV1.
#include "shared/bindings.glsl"

#ifdef HAS_VERTEX_COLOR
// Between the corners whose words begin at `extra`; `bary` belongs to the second and the third.
vec4 corner_color(uint extra, vec2 bary)
{
    CornerColors of = corner_colors_unpack(fetch_faces(extra), fetch_faces(extra + 1u), fetch_faces(extra + 2u));
    return of.a + bary.x * (of.b - of.a) + bary.y * (of.c - of.a);
}
#endif

#ifdef HAS_UV1
CornerUvs corner_uvs(uint extra)
{
#ifdef HAS_VERTEX_COLOR
    extra += CORNER_COLORS_WORDS;
#endif
    return corner_uvs_unpack(fetch_faces(extra), fetch_faces(extra + 1u));
}

vec2 corner_uv(CornerUvs of, vec2 bary) { return of.a + bary.x * (of.b - of.a) + bary.y * (of.c - of.a); }
#endif
