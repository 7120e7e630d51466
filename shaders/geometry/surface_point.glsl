// A point on a surface as shading sees it. Switches of the variant: HAS_VERTEX_COLOR, HAS_UV1, HAS_FRONT_ONLY.

struct Surface {
    vec3 position;        // world space
    float reach;          // largest of the coordinates that position was computed from
    vec3 object_position; // object space of its instance
    vec3 geometric;       // unit normal of the geometry, outward
    vec3 normal;          // unit shading normal, on the side of `geometric`
    vec3 object_normal;   // the same in object space, not of unit length
    vec3 base_normal;     // the same without bumps and normal maps
    bool softened;        // the light at the edge of bumps is softened
#ifdef HAS_FRONT_ONLY
    bool front_only;      // it is not there from behind
#endif
    vec3 dpdu;            // ∂p/∂u in world space, not of unit length; 0 where u has no direction
    vec3 dpdv;            // ∂p/∂v
    vec3 object_dpdu;     // ∂p/∂u in object space
    vec3 object_dpdv;
    vec3 dndu;            // ∂normal/∂u
    vec3 dndv;            // ∂normal/∂v
    vec4 tangent;         // of the vertices, in world space, and the side of the bitangent; 0 = there is none
    vec2 uv;
    vec2 uv_rate;         // what u and v grow by in a unit of length of the world
    float object_rate;    // units of object space in a unit of length of the world
    uint material;
    uint light;           // its light, or NONE
    uint instance;
    uint primitive;       // number of the triangle within its mesh, else 0
#ifdef HAS_VERTEX_COLOR
    vec4 vertex_color;    // white where there is none
#endif
#ifdef HAS_UV1
    vec2 uv1;             // the second set, or the first where there is none
    mat2 uv_by_uv1;       // ∂uv/∂u₁ and ∂uv/∂v₁; 0 where they have no direction
#endif
};

#ifdef HAS_UV1
// The derivatives by the second uv of what has these by the first.
mat2x3 by_uv1(Surface s, vec3 by_u, vec3 by_v) { return mat2x3(by_u, by_v) * s.uv_by_uv1; }
#endif

// What textures find where there are no corners, or where these have no colours and no second uv.
void plain_corners(inout Surface s)
{
#ifdef HAS_VERTEX_COLOR
    s.vertex_color = vec4(1.0);
#endif
#ifdef HAS_UV1
    s.uv1 = s.uv;
    s.uv_by_uv1 = mat2(1.0);
#endif
}

// The derivative of a unit normal, from a normal of any length that it is the direction of, and its derivative.
vec3 unit_derivative(vec3 normal, vec3 derivative)
{
    float l = length(normal);
    vec3 n = normal / l;
    return (derivative - n * dot(n, derivative)) / l;
}
