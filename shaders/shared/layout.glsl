// Written by src/layout; do not edit. Records are whole numbers of uvec4 words.

const uint NONE = 4294967295u; // No object.
const uint WORKGROUP = 64u; // Invocations of a workgroup: `local_size_x`, the only size in use.
const uint TILE = 8u; // Side of a square tile of pixels: a workgroup takes one.
const uint STACK_ENTRIES = 160u; // Most entries that the traversal stack of a kernel may have. `prepare` proves that every tree fits.
const uint FILM_PLANES = 9u; // Planes of the film: word w of pixel p is lane w % 4 of word p of plane w / 4. Sums have the lowest word first.
const uint FILM_RADIANCE = 0u; // Film: sums of radiance, signed, two words a channel.
const uint FILM_SAMPLES = 6u; // Film: number of samples.
const uint FILM_COVERED = 7u; // Film: samples whose camera ray hit something.
const uint FILM_SQUARES = 8u; // Film: sums of squares of radiance, unsigned, three words of every four a channel.
const uint FILM_LEFT_OUT = 11u; // Film: samples left out because they were not finite.
const uint FILM_CLAMPED = 15u; // Film: samples clamped to what the sums can hold.
const uint FILM_ALBEDO = 20u; // Film: sums of albedo, signed, two words a channel.
const uint FILM_DEPTH = 26u; // Film: sum of depths, signed, two words.
const uint FILM_NORMAL = 28u; // Film: sums of normals, signed, two words a coordinate.
const uint FILM_DEPTH_HITS = 34u; // Film: samples that have a depth.
const uint AOV_BITS = 20u; // Bits behind the point of the sums of albedo and normal.
const uint NUMBER_FACTOR = 10368889u; // What a number is multiplied by, in 24 bits, to be the three bytes of a colour; odd, so that there is a way back.
const uint RAY_WORDS = 2u; // Words of the ray of a slot.
const uint HIT_WORDS = 1u; // Words of what the ray of a slot met.
const uint PATH_WORDS = 3u; // Words of the path of a slot.
const uint PATH_DEPTH_BITS = 12u; // Bits of each of the two depths of a path.
const uint SHADOW_WORDS = 3u; // Words of the shadow ray of a slot.
const uint AOV_WORDS = 2u; // Words of albedo, depth and normal of a slot.
const uint PARKED_HEAD = 9u; // Numbers that a parked ray keeps beside its stack.
const uint ROUNDS_A_STEP = 4u; // Most rounds of loops that a step of a traversal takes: its own, and one for each child that waits.
const uint QUEUE_BINS = 8u; // Parts of a queue, one for each octant of directions.
const uint COUNTER_TURN = 0u; // Counter: the half of the queues that is read, 0 or 1; the other half is filled.
const uint COUNTER_WAITING_PATHS = 1u; // Counter: paths that wait.
const uint COUNTER_WAITING_SHADOWS = 2u; // Counter: shadow rays that wait.
const uint COUNTER_PATH_GROUPS = 4u; // Three counters: size of the dispatch over paths.
const uint COUNTER_SHADOW_GROUPS = 8u; // Three counters: size of the dispatch over shadow rays.
const uint COUNTER_PATHS = 16u; // Counters: lengths of the parts of the path queue, of both halves.
const uint COUNTER_SHADOWS = 32u; // Counters: lengths of the parts of the shadow queue, of both halves.
const uint COUNTERS = 48u; // Number of counters.
const uint SCHEDULE_WORDS = 5u; // Words of what a kernel knows of a queue: where the workgroups of its parts begin, their lengths, half and groups.
const uint ITEM_WORDS = 3u; // Words of an item of the tree: a Node, a Triangle, or the number of an instance and nothing else.
const uint LEAF = 2147483648u; // Bit of a reference: a leaf. Its other bits are the number of its primitives less one, and the first item of them.
const uint LEAF_INSTANCE = 1073741824u; // Bit of a leaf reference: it is an instance.
const uint LEAF_COUNT_SHIFT = 28u; // Where the number of primitives begins in a leaf reference.
const uint LEAF_COUNT_MASK = 805306368u; // Bits of a leaf reference: the number of its primitives less one.
const uint LEAF_FIRST_MASK = 268435455u; // Bits of a reference: the item of the tree.
const uint CHILD_NONE = 255u; // Byte of a node where it has no child.
const uint CHILD_OFFSET_MASK = 15u; // Bits of the byte of a child: its first item, counted from the first item of all children.
const uint CHILD_MARK_SHIFT = 24u; // Places that the other bits of that byte move up to become those of a reference.
const uint PRIMITIVE_LETS_THROUGH = 2147483648u; // Bit of the number of a triangle within its mesh: rays may go through it.
const uint PRIMITIVE_FRONT_ONLY = 1073741824u; // Bit of the number of a triangle within its mesh: it is not there from behind.
const uint INSTANCE_MESH = 0u; // Instance kind: triangles in object space.
const uint INSTANCE_SOUP = 1u; // Instance kind: all triangles that are placed once, in world space.
const uint INSTANCE_SPHERE = 2u; // Instance kind: unit sphere.
const uint INSTANCE_DISK = 3u; // Instance kind: unit disk.
const uint INSTANCE_SPHERE_PART = 4u; // Instance kind: part of the unit sphere; its root is the first word of its QuadricPart.
const uint INSTANCE_DISK_PART = 5u; // Instance kind: part of the unit disk.
const uint INSTANCE_CYLINDER = 6u; // Instance kind: tube of radius 1 about z from 0 to 1, or a part of it.
const uint INSTANCE_PATCH = 7u; // Instance kind: bilinear patch; its root is the first word of its BilinearPatch.
const uint INSTANCE_DEFAULT_UV = 1u; // Instance flag: the mesh has no uv, so that it is (0,0), (1,0), (1,1) on every triangle.
const uint INSTANCE_TRIANGLE_LIGHTS = 2u; // Instance flag: each triangle is a light of its own; else they are one light together.
const uint MATERIAL_UNLIT = 0u; // Material kind: colour is radiance.
const uint MATERIAL_CONDUCTOR = 1u; // Material kind: mirror or GGX metal.
const uint MATERIAL_DIELECTRIC = 2u; // Material kind: smooth or GGX glass.
const uint MATERIAL_PRINCIPLED = 3u; // Material kind: the model of glTF.
const uint MATERIAL_MIX = 4u; // Material kind: one of two materials at each event.
const uint MATERIAL_COATED_DIFFUSE = 5u; // Material kind: a dielectric interface over a Lambertian base.
const uint MATERIAL_COATED_CONDUCTOR = 6u; // Material kind: a dielectric interface over metal.
const uint MATERIAL_BSDFS = 7u; // Material kind: the first BSDF of the table; the others follow in its order.
const uint MATERIAL_WORDS = 12u; // Words of a material: a MaterialHead, then its inputs. Their places are the INPUT_… constants.
const uint MATERIAL_TWO_SIDED = 1u; // Material flag: it sends light out on both sides.
const uint MATERIAL_SQUARED = 2u; // Material flag: what its roughness inputs give are roughnesses, to be squared.
const uint MATERIAL_INTERFACE_SQUARED = 4u; // Material flag: what its interface inputs give are roughnesses, to be squared.
const uint MATERIAL_FRONT_ONLY = 8u; // Material flag: its surfaces are there from the front alone.
const uint INPUT_EMISSION = 1u; // ColorInput of all materials: radiance sent out.
const uint INPUT_COLOR = 2u; // ColorInput: radiance, reflectance, diffuse coefficient or base colour.
const uint INPUT_ROUGHNESS = 3u; // NumberInputs: GGX widths along ∂p/∂u and across it.
const uint INPUT_SPECULAR = 4u; // ColorInput: specular coefficient of Phong, transmittance, η of a conductor, specular colour.
const uint INPUT_ABSORPTION = 5u; // ColorInput: k of a conductor; absorption inside of glass, which takes no texture.
const uint INPUT_INDEX = 6u; // NumberInputs: index of refraction of a dielectric, or exponent of Phong; weight of what a dielectric reflects.
const uint INPUT_METALLIC = 7u; // NumberInputs: metallic, transmission.
const uint INPUT_CLEARCOAT = 8u; // NumberInputs: clearcoat, its roughness; GGX widths of an interface over metal.
const uint INPUT_SHEEN = 9u; // ColorInput: sheen.
const uint INPUT_SHEEN_ROUGHNESS = 10u; // NumberInputs: roughness of the sheen.
const uint INPUT_INTERFACE = 10u; // InterfaceInput, where there is no sheen.
const uint INTERFACE_COLUMNS = 32u; // Cells of a table of an interface along the cosine.
const uint INTERFACE_ROWS = 16u; // Cells of a table of an interface along the width.
const uint INPUT_MIX = 11u; // MixInput.
const uint DETAIL_CURVATURE = 1u; // Detail flag: the bend of the surface itself, times the height, counts in a bump map.
const uint DETAIL_SOFT_TERMINATOR = 2u; // Detail flag: the light at the edge of bumps is softened.
const uint DETAIL_VISIBLE = 4u; // Detail flag: a normal that is turned away from the viewer is turned back.
const uint DETAIL_VERTEX_TANGENTS = 8u; // Detail flag: tangents of a normal map are those of the vertices.
const uint DETAIL_GREEN_DOWN = 16u; // Detail flag: green in a normal map is down.
const uint DETAIL_FRONT_ONLY = 32u; // Detail flag: the surface is there from its front alone.
const uint DETAIL_HEIGHT_UV1 = 64u; // Detail flag: the picture of a bump map is placed by the second uv.
const uint DETAIL_NORMAL_UV1 = 128u; // Detail flag: the picture of a normal map is placed by the second uv.
const uint DERIVATIVE_FORWARD = 0u; // Rule of a derivative: forward differences.
const uint DERIVATIVE_KERNEL = 1u; // Rule of a derivative: the 3 × 3 kernel over texels.
const uint DERIVATIVE_BILINEAR = 2u; // Rule of a derivative: that of the bilinear surface between texels.
const uint DERIVATIVE_CENTRAL = 3u; // Rule of a derivative: central differences.
const uint DIELECTRIC_SOLID = 0u; // Dielectric mode: a boundary with an inside.
const uint DIELECTRIC_THIN = 1u; // Dielectric mode: a sheet without an inside.
const uint FRESNEL_INDEX = 0u; // Conductor rule: conductor with eta and k.
const uint FRESNEL_EXACT = 1u; // Conductor rule: conductor with eta 1 and the k of its reflectance.
const uint FRESNEL_SCHLICK = 2u; // Conductor rule: Schlick's approximation.
const uint FRESNEL_NONE = 3u; // Conductor rule: the same at every angle.
const uint PUPIL_INTERVALS = 64u; // Intervals of the distance from the middle of the film that have bounds of the exit pupil of their own.
const uint FILTER_CELLS = 128u; // Cells of a pixel filter from its middle to its radius, a power of two.
const uint LIGHT_POINT = 0u; // Light kind: point light.
const uint LIGHT_PROJECTION = 1u; // Light kind: picture thrown from a point.
const uint LIGHT_SPHERE = 2u; // Light kind: sphere or ellipsoid.
const uint LIGHT_QUAD = 3u; // Light kind: rectangle or parallelogram.
const uint LIGHT_DISK = 4u; // Light kind: disk; edges are its radii.
const uint LIGHT_TRIANGLE = 5u; // Light kind: triangle of a mesh.
const uint LIGHT_TURNED = 2147483648u; // Bit of the word of the corners of a triangle that is a light: its second and third corner changed places.
const uint LIGHT_SPHERE_PART = 6u; // Light kind: part of a sphere.
const uint LIGHT_DISK_PART = 7u; // Light kind: part of a disk.
const uint LIGHT_CYLINDER = 8u; // Light kind: tube, or a part of it.
const uint LIGHT_PATCH = 9u; // Light kind: bilinear patch.
const uint LIGHT_PUNCTUAL = 10u; // Light kind: the first light of the table; the others follow in its order.
const uint TEXELS_RGBA8 = 0u; // Texel format: a word holds 2×2 texels of 8 bits a channel.
const uint TEXELS_RGBA8_SRGB = 1u; // Texel format: the same; colour is decoded before it is filtered.
const uint TEXELS_RGBA16F = 2u; // Texel format: a word holds 2×1 texels of halves.
const uint TEXELS_RGBA32F = 3u; // Texel format: a word holds 1 texel of floats.
const uint WRAP_REPEAT = 0u; // Wrap mode: the picture again.
const uint WRAP_CLAMP = 1u; // Wrap mode: the texel at the edge.
const uint WRAP_MIRROR = 2u; // Wrap mode: the picture and its mirror image.
const uint WRAP_BLACK = 3u; // Wrap mode: zero.
const uint WRAP_MASK = 3u; // Bits of the flags of an image texture: its wrap mode along u, from bit 0.
const uint WRAP_V_SHIFT = 2u; // Position of the wrap mode along v in the flags of an image texture.
const uint WRAP_W_SHIFT = 6u; // Position of the wrap mode across the slices in the flags of a stack.
const uint FLAG_NEAREST = 16u; // Flag of an image texture: the nearest texel in place of bilinear filtering.
const uint FLAG_INVERT = 32u; // Flag of an image texture: 1 less the colour.
const uint FLAG_OCTAHEDRAL = 4096u; // Flag of an image texture: an octahedral map, beyond whose edges its sphere goes on; in place of the wrap modes.
const uint CHANNEL_SHIFT = 8u; // Position of the channel in the flags of an image texture.
const uint CHANNEL_MASK = 15u; // Bits of the channel in the flags of an image texture, moved down to bit 0.
const uint LEVELS_SHIFT = 16u; // Position of the number of levels in the flags of an image texture; nothing is above it.
const uint CHANNEL_RGB = 0u; // Channel: all as they are.
const uint CHANNEL_R = 1u; // Channel: red in all.
const uint CHANNEL_G = 2u; // Channel: green in all.
const uint CHANNEL_B = 3u; // Channel: blue in all.
const uint CHANNEL_A = 4u; // Channel: alpha in all.

struct Frame {
    vec3 camera_right; // camera space x in world space
    float half_x; // half of the width of the picture: tangent, scene units of parallel rays, radii of a fisheye circle, or mm of film
    vec3 camera_up; // camera space y in world space
    float half_y; // half of the height of the picture, in the same unit
    vec3 camera_back; // camera space z in world space: the camera looks along its negative
    float lens_radius; // radius of the lens, scene units; 0 = pinhole
    vec3 camera_position; // position of the camera
    float focus_distance; // distance of the plane of focus, scene units
    vec3 focus_plane; // plane of focus n · p = d of a thin lens, as n / d; n and p to the right, up and along the view
    float cat_eye; // distance of the second opening of a thin lens, radii
    vec2 opening_half; // half of the width and height of the opening, radii
    uvec2 opening_size; // columns and rows of the picture of the opening
    uint opening_cells; // first word of `lens` with its cells
    uint lens_count; // interfaces of the lens
    uint lens_stop; // the one that is the stop
    float stop_radius; // radius of the stop, millimetres
    float lens_rear; // from the film to the last vertex, millimetres
    float lens_weight; // factor on cos⁴ θ · area, which gives the weight of a ray; one over square millimetres
    float lens_unit; // scene units in a millimetre
    float lens_spread; // angle of a millimetre of film, radians
    uint pupil_bounds; // first word of `lens` with bounds of the exit pupil
    float pupil_scale; // intervals of these in a millimetre of film
    float fisheye_scale; // half the angle of a fisheye in radians; equisolid: the sine of half of that
    uint camera_motion; // first word of `instances` with the motion of the camera, whose own fields are then those of camera space
    uint blades; // corners of the aperture; 0 = circle
    float blade_rotation; // rotation of the aperture, radians
    float filter_radius; // half-width of the pixel filter, pixels
    uint seed; // seed of all random numbers
    uvec2 film_size; // size of the whole picture, pixels
    uvec2 window_min; // first column and row that is rendered
    uvec2 window_max; // one past the last column and row that is rendered
    uint tiles_x; // tiles in a row of the window
    uint threads; // threads that share a dispatch in contiguous parts; 1 on a GPU
    uint first_tile; // first tile of the slice, row by row
    uint tile_count; // tiles of the slice
    uint first_sample; // first sample of the slice
    uint sample_count; // samples a pixel in the slice
    uvec2 strata; // strata of a pixel in x and y
    uint max_depth; // most scattering events on a path
    uint diffuse_bounces; // most scattering events that are neither mirror nor clear glass
    uint slot_count; // slots of the slice: WORKGROUP · tile_count · sample_count
    uint root; // entry of the tree that rays start at
    uint step_limit; // most steps of a ray in one dispatch, before it is parked
    uint light_count; // lights in the table, the environment left out
    float environment_chance; // chance of choosing the environment when a light is chosen
    float firefly_clamp; // largest component that indirect light of one sample may have; 0 = no limit
    float radiance_scale; // 1 / unit of the sums of radiance
    float depth_scale; // 1 / unit of the sums of depth
    vec3 environment_row0; // row 0 of the rotation from world directions to those of the environment
    float environment_scale; // factor on the radiance of the environment
    vec3 environment_row1; // row 1 of that rotation
    uint environment_texture; // texture of the environment, or NONE
    vec3 environment_row2; // row 2 of that rotation
    uint film_first_tile; // first tile of the film band that is resident
    vec3 environment_radiance; // constant radiance of the environment
    uint film_tile_count; // tiles of the film band that is resident
    uvec2 environment_size; // columns and rows of the importance table of the environment
    uint parked_stack; // entries of the stack of a parked ray
    uint point_count; // points of the evaluate and probe kernels
    uint filter_cells; // first word of `lens` with the cells of the pixel filter
    float filter_weight; // magnitude of the pixel filter over its whole, by which samples are weighted
    uint spare; // room
    uint camera_medium; // material of the glass around the camera, or NONE
};

struct Node {
    vec3 origin; // least corner of all children
    uint exponents; // exponents of the steps along x, y and z, a byte each
    uvec3 low; // least corners along x, y and z; a byte for each child
    uint base; // first item of the children
    uvec3 high; // greatest corners along x, y and z; a byte for each child
    uint children; // a byte for each child: CHILD_NONE, or its first item counted from `base`, and the upper bits of its reference
};
const uint NODE_WORDS = 3u;
Node node_unpack(uvec4 w0, uvec4 w1, uvec4 w2)
{
    Node r;
    r.origin = uintBitsToFloat(uvec3(w0.x, w0.y, w0.z));
    r.exponents = w0.w;
    r.low = uvec3(w1.x, w1.y, w1.z);
    r.base = w1.w;
    r.high = uvec3(w2.x, w2.y, w2.z);
    r.children = w2.w;
    return r;
}

struct Triangle {
    vec3 a; // first vertex, in the space of its tree
    uint instance; // instance, when the tree is in world space; else NONE
    vec3 b; // second vertex
    uint material; // its material, or NONE for that of the instance
    vec3 c; // third vertex
    uint primitive; // number of the triangle within its mesh, and one of the bits PRIMITIVE_LETS_THROUGH and PRIMITIVE_FRONT_ONLY
};
const uint TRIANGLE_WORDS = 3u;
Triangle triangle_unpack(uvec4 w0, uvec4 w1, uvec4 w2)
{
    Triangle r;
    r.a = uintBitsToFloat(uvec3(w0.x, w0.y, w0.z));
    r.instance = w0.w;
    r.b = uintBitsToFloat(uvec3(w1.x, w1.y, w1.z));
    r.material = w1.w;
    r.c = uintBitsToFloat(uvec3(w2.x, w2.y, w2.z));
    r.primitive = w2.w;
    return r;
}

struct Face {
    uvec3 vertices; // three Vertex records
    uint extra; // word of `faces` with what only textures ask of its corners, or NONE: CornerColors, then CornerUvs, those that the scene uses
};
const uint FACE_WORDS = 1u;
Face face_unpack(uvec4 w0)
{
    Face r;
    r.vertices = uvec3(w0.x, w0.y, w0.z);
    r.extra = w0.w;
    return r;
}

struct CornerColors {
    vec4 a; // of the first
    vec4 b; // of the second
    vec4 c; // of the third
};
const uint CORNER_COLORS_WORDS = 3u;
CornerColors corner_colors_unpack(uvec4 w0, uvec4 w1, uvec4 w2)
{
    CornerColors r;
    r.a = uintBitsToFloat(uvec4(w0.x, w0.y, w0.z, w0.w));
    r.b = uintBitsToFloat(uvec4(w1.x, w1.y, w1.z, w1.w));
    r.c = uintBitsToFloat(uvec4(w2.x, w2.y, w2.z, w2.w));
    return r;
}

struct CornerUvs {
    vec2 a; // of the first
    vec2 b; // of the second
    vec2 c; // of the third
    vec2 spare; // room
};
const uint CORNER_UVS_WORDS = 2u;
CornerUvs corner_uvs_unpack(uvec4 w0, uvec4 w1)
{
    CornerUvs r;
    r.a = uintBitsToFloat(uvec2(w0.x, w0.y));
    r.b = uintBitsToFloat(uvec2(w0.z, w0.w));
    r.c = uintBitsToFloat(uvec2(w1.x, w1.y));
    r.spare = uintBitsToFloat(uvec2(w1.z, w1.w));
    return r;
}

struct Vertex {
    vec3 normal; // normal of any length, or 0 when the mesh is flat
    float u; // texture coordinate, rightward
    float v; // texture coordinate, upward
    vec3 tangent; // tangent in the space of the normal: 1 long, or 2 when its bitangent is on the other side; 0 = there is none
};
const uint VERTEX_WORDS = 2u;
Vertex vertex_unpack(uvec4 w0, uvec4 w1)
{
    Vertex r;
    r.normal = uintBitsToFloat(uvec3(w0.x, w0.y, w0.z));
    r.u = uintBitsToFloat(w0.w);
    r.v = uintBitsToFloat(w1.x);
    r.tangent = uintBitsToFloat(uvec3(w1.y, w1.z, w1.w));
    return r;
}

struct Instance {
    uint kind; // INSTANCE_… kind
    uint root; // root of its tree, for meshes; first word of `instances` with what else there is to know of a shape; or NONE
    uint light; // first light of its surface, or NONE
    uint material; // material of what has none of its own
    vec4 object_row0; // row 0 of object from world
    vec4 object_row1; // row 1 of object from world
    vec4 object_row2; // row 2 of object from world
    vec4 world_row0; // row 0 of world from object
    vec4 world_row1; // row 1 of world from object
    vec4 world_row2; // row 2 of world from object
    float handedness; // 1, or -1 when the map to the world mirrors
    uint motion; // first word of `instances` with its Motion, or NONE
    uint first_face; // Face of its first triangle, or NONE for flat triangles without uv
    uint flags; // INSTANCE_… flags
};
const uint INSTANCE_WORDS = 8u;
Instance instance_unpack(uvec4 w0, uvec4 w1, uvec4 w2, uvec4 w3, uvec4 w4, uvec4 w5, uvec4 w6, uvec4 w7)
{
    Instance r;
    r.kind = w0.x;
    r.root = w0.y;
    r.light = w0.z;
    r.material = w0.w;
    r.object_row0 = uintBitsToFloat(uvec4(w1.x, w1.y, w1.z, w1.w));
    r.object_row1 = uintBitsToFloat(uvec4(w2.x, w2.y, w2.z, w2.w));
    r.object_row2 = uintBitsToFloat(uvec4(w3.x, w3.y, w3.z, w3.w));
    r.world_row0 = uintBitsToFloat(uvec4(w4.x, w4.y, w4.z, w4.w));
    r.world_row1 = uintBitsToFloat(uvec4(w5.x, w5.y, w5.z, w5.w));
    r.world_row2 = uintBitsToFloat(uvec4(w6.x, w6.y, w6.z, w6.w));
    r.handedness = uintBitsToFloat(w7.x);
    r.motion = w7.y;
    r.first_face = w7.z;
    r.flags = w7.w;
    return r;
}

struct MaterialHead {
    uint kind; // MATERIAL_… kind
    uint mode; // FRESNEL_… rule of a conductor, or DIELECTRIC_… mode
    uint flags; // MATERIAL_… flags
    float dispersion; // 1 / Abbe number of glass; 0 = all colours have one index
};
const uint MATERIAL_HEAD_WORDS = 1u;
MaterialHead material_head_unpack(uvec4 w0)
{
    MaterialHead r;
    r.kind = w0.x;
    r.mode = w0.y;
    r.flags = w0.z;
    r.dispersion = uintBitsToFloat(w0.w);
    return r;
}

struct ColorInput {
    vec3 value; // the colour, or a factor on that of the texture
    uint texture; // its texture
};
const uint COLOR_INPUT_WORDS = 1u;
ColorInput color_input_unpack(uvec4 w0)
{
    ColorInput r;
    r.value = uintBitsToFloat(uvec3(w0.x, w0.y, w0.z));
    r.texture = w0.w;
    return r;
}

struct NumberInputs {
    float first; // the first number, or a factor on that of its texture
    uint first_texture; // its texture
    float second; // the second number, or a factor on that of its texture
    uint second_texture; // its texture
};
const uint NUMBER_INPUTS_WORDS = 1u;
NumberInputs number_inputs_unpack(uvec4 w0)
{
    NumberInputs r;
    r.first = uintBitsToFloat(w0.x);
    r.first_texture = w0.y;
    r.second = uintBitsToFloat(w0.z);
    r.second_texture = w0.w;
    return r;
}

struct InterfaceInput {
    uint through_table; // word of `materials` with the table of what it lets through when rough, or NONE
    uint inner_table; // word with the table of what leaves rough metal below it, or NONE
    float through_mean; // what it lets through when smooth of light from everywhere: 2 ∫ T(μ) μ dμ
    uint spare; // room
};
const uint INTERFACE_INPUT_WORDS = 1u;
InterfaceInput interface_input_unpack(uvec4 w0)
{
    InterfaceInput r;
    r.through_table = w0.x;
    r.inner_table = w0.y;
    r.through_mean = uintBitsToFloat(w0.z);
    r.spare = w0.w;
    return r;
}

struct MixInput {
    float amount; // chance of the second material, or a factor on that of its texture
    uint amount_texture; // its texture
    uint first; // material for an amount of 0
    uint second; // material for an amount of 1
};
const uint MIX_INPUT_WORDS = 1u;
MixInput mix_input_unpack(uvec4 w0)
{
    MixInput r;
    r.amount = uintBitsToFloat(w0.x);
    r.amount_texture = w0.y;
    r.first = w0.z;
    r.second = w0.w;
    return r;
}

struct Detail {
    float opacity; // how much of the surface is there, 0 to 1
    uint opacity_texture; // texture of opacity, a factor on it
    float cutoff; // opacity from which a point is there, or less than 0: each point is there to a part
    uint filter_texture; // texture of the filter, a factor on it
    vec3 filter_color; // colour of light that goes straight through
    uint flags; // DETAIL_… flags
    uint height_texture; // texture of the height of a bump map, or NONE
    float height; // factor on the height, scene units
    uint derivative; // DERIVATIVE_… rule of the height
    uint normal_texture; // texture of a normal map, or NONE
    vec2 step_x; // what one step of the derivative along its first axis adds to uv
    vec2 step_y; // the same along its second axis
    vec2 steps_at_zero; // steps, whole at texel centres, of the uv (0, 0)
    float strength; // factor on the tilt of a normal map
    uint spare; // room
};
const uint DETAIL_WORDS = 5u;
Detail detail_unpack(uvec4 w0, uvec4 w1, uvec4 w2, uvec4 w3, uvec4 w4)
{
    Detail r;
    r.opacity = uintBitsToFloat(w0.x);
    r.opacity_texture = w0.y;
    r.cutoff = uintBitsToFloat(w0.z);
    r.filter_texture = w0.w;
    r.filter_color = uintBitsToFloat(uvec3(w1.x, w1.y, w1.z));
    r.flags = w1.w;
    r.height_texture = w2.x;
    r.height = uintBitsToFloat(w2.y);
    r.derivative = w2.z;
    r.normal_texture = w2.w;
    r.step_x = uintBitsToFloat(uvec2(w3.x, w3.y));
    r.step_y = uintBitsToFloat(uvec2(w3.z, w3.w));
    r.steps_at_zero = uintBitsToFloat(uvec2(w4.x, w4.y));
    r.strength = uintBitsToFloat(w4.z);
    r.spare = w4.w;
    return r;
}

struct Light {
    uint kind; // LIGHT_… kind
    float chance; // chance of choosing it
    float accept; // share of its slot of the alias table that is its own
    uint alias; // the light that has the rest of the slot
    vec3 position; // position, centre, corner or first vertex
    float a; // radius (0: ellipsoid); -1 if a flat light faces against u × v; half-width of a projection at distance 1; first number of a light of the table
    vec3 edge_u; // first edge, second vertex less the first, or direction of a light without extent
    float b; // area of a surface; half-height of a projection at distance 1; second number of a light of the table
    vec3 edge_v; // second edge, third vertex less the first, or what is up for the texture of a light without extent
    uint two_sided; // 1 when it shines on both sides
    vec3 radiance; // radiance, intensity or irradiance, or a factor on that of its texture
    uint texture; // its texture, or NONE
    vec2 uv0; // uv of the first vertex of a triangle; x and y of the third axis of a quadric, or of the twist of a patch; third and fourth number of a light of the table
    vec2 uv1; // uv of the second vertex less the first; z of that axis or twist, and the turn of a part
    vec2 uv2; // uv of the third vertex less the first; least and greatest z of a part of a sphere; radius of the hole of a disk
    uint material; // material of a surface
    uint extra; // triangle: that of its Face, or NONE; LIGHT_TURNED: two corners changed places. point light: 1 for an equal-area map; patch: first word of `instances` with its BilinearPatch
};
const uint LIGHT_WORDS = 7u;
Light light_unpack(uvec4 w0, uvec4 w1, uvec4 w2, uvec4 w3, uvec4 w4, uvec4 w5, uvec4 w6)
{
    Light r;
    r.kind = w0.x;
    r.chance = uintBitsToFloat(w0.y);
    r.accept = uintBitsToFloat(w0.z);
    r.alias = w0.w;
    r.position = uintBitsToFloat(uvec3(w1.x, w1.y, w1.z));
    r.a = uintBitsToFloat(w1.w);
    r.edge_u = uintBitsToFloat(uvec3(w2.x, w2.y, w2.z));
    r.b = uintBitsToFloat(w2.w);
    r.edge_v = uintBitsToFloat(uvec3(w3.x, w3.y, w3.z));
    r.two_sided = w3.w;
    r.radiance = uintBitsToFloat(uvec3(w4.x, w4.y, w4.z));
    r.texture = w4.w;
    r.uv0 = uintBitsToFloat(uvec2(w5.x, w5.y));
    r.uv1 = uintBitsToFloat(uvec2(w5.z, w5.w));
    r.uv2 = uintBitsToFloat(uvec2(w6.x, w6.y));
    r.material = w6.z;
    r.extra = w6.w;
    return r;
}

struct EnvironmentCell {
    float accept; // share of the slot that is its own
    uint alias; // the cell that has the rest
    float chance; // chance of the cell
    uint spare; // room
};
const uint ENVIRONMENT_CELL_WORDS = 1u;
EnvironmentCell environment_cell_unpack(uvec4 w0)
{
    EnvironmentCell r;
    r.accept = uintBitsToFloat(w0.x);
    r.alias = w0.y;
    r.chance = uintBitsToFloat(w0.z);
    r.spare = w0.w;
    return r;
}

struct ImageTexture {
    uint base; // word of its first block of texels
    uint pitch; // words from a row of blocks to the next
    uvec2 size; // columns and rows of texels
    vec2 uv_column0; // uv to picture, column 0
    vec2 uv_column1; // uv to picture, column 1
    vec2 uv_offset; // uv to picture, offset
    float scale; // factor on the value
    uint flags; // FLAG_… bits, WRAP_… modes, CHANNEL_…, and the number of levels where it is filtered trilinearly
};
const uint IMAGE_TEXTURE_WORDS = 3u;
ImageTexture image_texture_unpack(uvec4 w0, uvec4 w1, uvec4 w2)
{
    ImageTexture r;
    r.base = w0.x;
    r.pitch = w0.y;
    r.size = uvec2(w0.z, w0.w);
    r.uv_column0 = uintBitsToFloat(uvec2(w1.x, w1.y));
    r.uv_column1 = uintBitsToFloat(uvec2(w1.z, w1.w));
    r.uv_offset = uintBitsToFloat(uvec2(w2.x, w2.y));
    r.scale = uintBitsToFloat(w2.z);
    r.flags = w2.w;
    return r;
}

struct ImageLevel {
    uint base; // word of its first block of texels
    uint pitch; // words from a row of blocks to the next
    uvec2 size; // columns and rows of texels
};
const uint IMAGE_LEVEL_WORDS = 1u;
ImageLevel image_level_unpack(uvec4 w0)
{
    ImageLevel r;
    r.base = w0.x;
    r.pitch = w0.y;
    r.size = uvec2(w0.z, w0.w);
    return r;
}

struct Stack {
    uint base; // word of its first block of texels
    uint pitch; // words from a row of blocks to the next
    uint slice_words; // words from a slice to the next
    uint flags; // as in ImageTexture
    uvec3 size; // columns, rows and slices
    float scale; // factor on the value
};
const uint STACK_WORDS = 2u;
Stack stack_unpack(uvec4 w0, uvec4 w1)
{
    Stack r;
    r.base = w0.x;
    r.pitch = w0.y;
    r.slice_words = w0.z;
    r.flags = w0.w;
    r.size = uvec3(w1.x, w1.y, w1.z);
    r.scale = uintBitsToFloat(w1.w);
    return r;
}

struct Mapping {
    vec4 row0; // row 0 of mapping from space
    vec4 row1; // row 1 of mapping from space
    vec4 row2; // row 2 of mapping from space
    float pole_u; // u on the axis
    float seam_blend; // share of a turn over which the seam is faded
    float sharpness; // exponent of triplanar weights
    uint spare; // room
};
const uint MAPPING_WORDS = 4u;
Mapping mapping_unpack(uvec4 w0, uvec4 w1, uvec4 w2, uvec4 w3)
{
    Mapping r;
    r.row0 = uintBitsToFloat(uvec4(w0.x, w0.y, w0.z, w0.w));
    r.row1 = uintBitsToFloat(uvec4(w1.x, w1.y, w1.z, w1.w));
    r.row2 = uintBitsToFloat(uvec4(w2.x, w2.y, w2.z, w2.w));
    r.pole_u = uintBitsToFloat(w3.x);
    r.seam_blend = uintBitsToFloat(w3.y);
    r.sharpness = uintBitsToFloat(w3.z);
    r.spare = w3.w;
    return r;
}

struct TextureInput {
    vec3 value; // the constant
    uint at; // word of the record of the texture
};
const uint TEXTURE_INPUT_WORDS = 1u;
TextureInput texture_input_unpack(uvec4 w0)
{
    TextureInput r;
    r.value = uintBitsToFloat(uvec3(w0.x, w0.y, w0.z));
    r.at = w0.w;
    return r;
}

struct TexturePoint {
    vec3 position; // position in the world
    float footprint; // width of what the value stands for, in the world; 0 = a point
    vec3 object_position; // position in object space
    float object_footprint; // the width there
    vec2 uv; // texture coordinates
    vec2 uv_footprint; // the widths in u and in v
    vec3 normal; // normal in the world
    float time; // time in the shutter interval, 0..1
    vec3 object_normal; // normal in object space
    uint reference; // the texture
    vec2 uv1; // second texture coordinates
    vec2 uv1_footprint; // the widths in these
    vec4 vertex_color; // colour of the vertices, linear, with alpha
};
const uint TEXTURE_POINT_WORDS = 7u;
TexturePoint texture_point_unpack(uvec4 w0, uvec4 w1, uvec4 w2, uvec4 w3, uvec4 w4, uvec4 w5, uvec4 w6)
{
    TexturePoint r;
    r.position = uintBitsToFloat(uvec3(w0.x, w0.y, w0.z));
    r.footprint = uintBitsToFloat(w0.w);
    r.object_position = uintBitsToFloat(uvec3(w1.x, w1.y, w1.z));
    r.object_footprint = uintBitsToFloat(w1.w);
    r.uv = uintBitsToFloat(uvec2(w2.x, w2.y));
    r.uv_footprint = uintBitsToFloat(uvec2(w2.z, w2.w));
    r.normal = uintBitsToFloat(uvec3(w3.x, w3.y, w3.z));
    r.time = uintBitsToFloat(w3.w);
    r.object_normal = uintBitsToFloat(uvec3(w4.x, w4.y, w4.z));
    r.reference = w4.w;
    r.uv1 = uintBitsToFloat(uvec2(w5.x, w5.y));
    r.uv1_footprint = uintBitsToFloat(uvec2(w5.z, w5.w));
    r.vertex_color = uintBitsToFloat(uvec4(w6.x, w6.y, w6.z, w6.w));
    return r;
}

struct Pattern {
    vec4 row0; // row 0 of pattern from space
    vec4 row1; // row 1 of pattern from space
    vec4 row2; // row 2 of pattern from space
    float filter_width; // width of what a value stands for, in widths of the pixel
    float w; // w of noise in four dimensions, when the shutter opens
    float w_rate; // by how much w grows until it closes
    uint spare; // room
};
const uint PATTERN_WORDS = 4u;
Pattern pattern_unpack(uvec4 w0, uvec4 w1, uvec4 w2, uvec4 w3)
{
    Pattern r;
    r.row0 = uintBitsToFloat(uvec4(w0.x, w0.y, w0.z, w0.w));
    r.row1 = uintBitsToFloat(uvec4(w1.x, w1.y, w1.z, w1.w));
    r.row2 = uintBitsToFloat(uvec4(w2.x, w2.y, w2.z, w2.w));
    r.filter_width = uintBitsToFloat(w3.x);
    r.w = uintBitsToFloat(w3.y);
    r.w_rate = uintBitsToFloat(w3.z);
    r.spare = w3.w;
    return r;
}

struct ValueLattice {
    uint points; // points along each axis, after which it begins again
    float amplitude; // amplitude of the first octave
    float frequency; // points in a unit, in the first octave
    uint octaves; // number of octaves
};
const uint VALUE_LATTICE_WORDS = 1u;
ValueLattice value_lattice_unpack(uvec4 w0)
{
    ValueLattice r;
    r.points = w0.x;
    r.amplitude = uintBitsToFloat(w0.y);
    r.frequency = uintBitsToFloat(w0.z);
    r.octaves = w0.w;
    return r;
}

struct Wall {
    vec2 size; // length and height of a brick with its mortar
    float joint; // width of the mortar
    float offset; // how far a row is moved against the one below, in parts of the length
};
const uint WALL_WORDS = 1u;
Wall wall_unpack(uvec4 w0)
{
    Wall r;
    r.size = uintBitsToFloat(uvec2(w0.x, w0.y));
    r.joint = uintBitsToFloat(w0.z);
    r.offset = uintBitsToFloat(w0.w);
    return r;
}

struct NodeNumber {
    float number; // variation of bricks, marble, wood and granite; radius of dots; amount of a warp
    uvec3 spare; // room
};
const uint NODE_NUMBER_WORDS = 1u;
NodeNumber node_number_unpack(uvec4 w0)
{
    NodeNumber r;
    r.number = uintBitsToFloat(w0.x);
    r.spare = uvec3(w0.y, w0.z, w0.w);
    return r;
}

struct NoiseSum {
    uint octaves; // number of octaves
    float gain; // factor on the amplitude from one octave to the next
    float lacunarity; // factor on the frequency from one octave to the next
    float scale; // 1 / sum of the amplitudes
};
const uint NOISE_SUM_WORDS = 1u;
NoiseSum noise_sum_unpack(uvec4 w0)
{
    NoiseSum r;
    r.octaves = w0.x;
    r.gain = uintBitsToFloat(w0.y);
    r.lacunarity = uintBitsToFloat(w0.z);
    r.scale = uintBitsToFloat(w0.w);
    return r;
}

struct Ramp {
    uint count; // number of stops
    uint smooth_stops; // 1 when what is between stops follows 3t² − 2t³
    uvec2 spare; // room
};
const uint RAMP_WORDS = 1u;
Ramp ramp_unpack(uvec4 w0)
{
    Ramp r;
    r.count = w0.x;
    r.smooth_stops = w0.y;
    r.spare = uvec2(w0.z, w0.w);
    return r;
}

struct RampStop {
    vec3 color; // its colour
    float place; // its place
};
const uint RAMP_STOP_WORDS = 1u;
RampStop ramp_stop_unpack(uvec4 w0)
{
    RampStop r;
    r.color = uintBitsToFloat(uvec3(w0.x, w0.y, w0.z));
    r.place = uintBitsToFloat(w0.w);
    return r;
}

struct LensInterface {
    float position; // z of its vertex
    float curvature; // 1 / radius, positive when the centre is on the side of the scene; 0 = flat
    float aperture_squared; // square of the radius of what is let through
    float index; // index of the medium towards the scene, at the d line
    vec2 cauchy; // A and B of that index at other wavelengths: A + B / λ², λ in micrometres
    vec2 spare; // room
};
const uint LENS_INTERFACE_WORDS = 2u;
LensInterface lens_interface_unpack(uvec4 w0, uvec4 w1)
{
    LensInterface r;
    r.position = uintBitsToFloat(w0.x);
    r.curvature = uintBitsToFloat(w0.y);
    r.aperture_squared = uintBitsToFloat(w0.z);
    r.index = uintBitsToFloat(w0.w);
    r.cauchy = uintBitsToFloat(uvec2(w1.x, w1.y));
    r.spare = uintBitsToFloat(uvec2(w1.z, w1.w));
    return r;
}

struct PupilBounds {
    vec2 low; // least x and y
    vec2 high; // greatest x and y
};
const uint PUPIL_BOUNDS_WORDS = 1u;
PupilBounds pupil_bounds_unpack(uvec4 w0)
{
    PupilBounds r;
    r.low = uintBitsToFloat(uvec2(w0.x, w0.y));
    r.high = uintBitsToFloat(uvec2(w0.z, w0.w));
    return r;
}

struct FilterCell {
    float below; // share of the magnitude in the cells before
    float share; // share of the magnitude in this one
    float sign; // 1, or -1 where the filter is negative
    uint spare; // room
};
const uint FILTER_CELL_WORDS = 1u;
FilterCell filter_cell_unpack(uvec4 w0)
{
    FilterCell r;
    r.below = uintBitsToFloat(w0.x);
    r.share = uintBitsToFloat(w0.y);
    r.sign = uintBitsToFloat(w0.z);
    r.spare = w0.w;
    return r;
}

struct OpeningCell {
    float accept; // share of the slot that is its own
    uint alias; // the cell that has the rest
    float weight; // what passes there, with a mean of π / 4
    uint spare; // room
};
const uint OPENING_CELL_WORDS = 1u;
OpeningCell opening_cell_unpack(uvec4 w0)
{
    OpeningCell r;
    r.accept = uintBitsToFloat(w0.x);
    r.alias = w0.y;
    r.weight = uintBitsToFloat(w0.z);
    r.spare = w0.w;
    return r;
}

struct Motion {
    vec3 open_position; // translation when it opens
    float angle; // half of the angle of the rotation until it closes, radians
    vec3 close_position; // translation when it closes
    float spare; // room
    vec4 turn; // rotation when it opens, as a quaternion x, y, z, w
    vec4 turn_across; // unit quaternion at a right angle to it, on the way to the rotation when it closes; 0 = the same rotation
    vec4 open_row0; // row 0 of the stretch from object when it opens
    vec4 open_row1; // row 1 of it
    vec4 open_row2; // row 2 of it
    vec4 close_row0; // row 0 of the stretch from object when it closes
    vec4 close_row1; // row 1 of it
    vec4 close_row2; // row 2 of it
};
const uint MOTION_WORDS = 10u;
Motion motion_unpack(uvec4 w0, uvec4 w1, uvec4 w2, uvec4 w3, uvec4 w4, uvec4 w5, uvec4 w6, uvec4 w7, uvec4 w8, uvec4 w9)
{
    Motion r;
    r.open_position = uintBitsToFloat(uvec3(w0.x, w0.y, w0.z));
    r.angle = uintBitsToFloat(w0.w);
    r.close_position = uintBitsToFloat(uvec3(w1.x, w1.y, w1.z));
    r.spare = uintBitsToFloat(w1.w);
    r.turn = uintBitsToFloat(uvec4(w2.x, w2.y, w2.z, w2.w));
    r.turn_across = uintBitsToFloat(uvec4(w3.x, w3.y, w3.z, w3.w));
    r.open_row0 = uintBitsToFloat(uvec4(w4.x, w4.y, w4.z, w4.w));
    r.open_row1 = uintBitsToFloat(uvec4(w5.x, w5.y, w5.z, w5.w));
    r.open_row2 = uintBitsToFloat(uvec4(w6.x, w6.y, w6.z, w6.w));
    r.close_row0 = uintBitsToFloat(uvec4(w7.x, w7.y, w7.z, w7.w));
    r.close_row1 = uintBitsToFloat(uvec4(w8.x, w8.y, w8.z, w8.w));
    r.close_row2 = uintBitsToFloat(uvec4(w9.x, w9.y, w9.z, w9.w));
    return r;
}

struct QuadricPart {
    float z_min; // least z; beyond the sphere when it is not cut there
    float z_max; // greatest z
    float inner_radius; // radius of the hole of a disk
    float turn; // angle about z from +x up to which it is there, turns
    float v_min; // v of the whole shape where v is 0
    float v_range; // v of the whole shape where v is 1, less that
    vec2 spare; // room
};
const uint QUADRIC_PART_WORDS = 2u;
QuadricPart quadric_part_unpack(uvec4 w0, uvec4 w1)
{
    QuadricPart r;
    r.z_min = uintBitsToFloat(w0.x);
    r.z_max = uintBitsToFloat(w0.y);
    r.inner_radius = uintBitsToFloat(w0.z);
    r.turn = uintBitsToFloat(w0.w);
    r.v_min = uintBitsToFloat(w1.x);
    r.v_range = uintBitsToFloat(w1.y);
    r.spare = uintBitsToFloat(uvec2(w1.z, w1.w));
    return r;
}

struct BilinearPatch {
    vec3 p00; // corner u = 0, v = 0, divided by `size`
    float size; // largest coordinate of a corner, up to a factor of 2: a power of two
    vec3 p10; // corner u = 1, v = 0, divided by `size`
    uint has_normals; // 1 when it has normals
    vec3 p01; // corner u = 0, v = 1, divided by `size`
    float spare01; // room
    vec3 p11; // corner u = 1, v = 1, divided by `size`
    float spare11; // room
    vec2 uv00; // texture coordinates of p00
    vec2 uv10; // texture coordinates of p10
    vec2 uv01; // texture coordinates of p01
    vec2 uv11; // texture coordinates of p11
};
const uint BILINEAR_PATCH_WORDS = 6u;
BilinearPatch bilinear_patch_unpack(uvec4 w0, uvec4 w1, uvec4 w2, uvec4 w3, uvec4 w4, uvec4 w5)
{
    BilinearPatch r;
    r.p00 = uintBitsToFloat(uvec3(w0.x, w0.y, w0.z));
    r.size = uintBitsToFloat(w0.w);
    r.p10 = uintBitsToFloat(uvec3(w1.x, w1.y, w1.z));
    r.has_normals = w1.w;
    r.p01 = uintBitsToFloat(uvec3(w2.x, w2.y, w2.z));
    r.spare01 = uintBitsToFloat(w2.w);
    r.p11 = uintBitsToFloat(uvec3(w3.x, w3.y, w3.z));
    r.spare11 = uintBitsToFloat(w3.w);
    r.uv00 = uintBitsToFloat(uvec2(w4.x, w4.y));
    r.uv10 = uintBitsToFloat(uvec2(w4.z, w4.w));
    r.uv01 = uintBitsToFloat(uvec2(w5.x, w5.y));
    r.uv11 = uintBitsToFloat(uvec2(w5.z, w5.w));
    return r;
}

struct PatchNormals {
    vec3 n00; // of p00
    float spare00; // room
    vec3 n10; // of p10
    float spare10; // room
    vec3 n01; // of p01
    float spare01; // room
    vec3 n11; // of p11
    float spare11; // room
};
const uint PATCH_NORMALS_WORDS = 4u;
PatchNormals patch_normals_unpack(uvec4 w0, uvec4 w1, uvec4 w2, uvec4 w3)
{
    PatchNormals r;
    r.n00 = uintBitsToFloat(uvec3(w0.x, w0.y, w0.z));
    r.spare00 = uintBitsToFloat(w0.w);
    r.n10 = uintBitsToFloat(uvec3(w1.x, w1.y, w1.z));
    r.spare10 = uintBitsToFloat(w1.w);
    r.n01 = uintBitsToFloat(uvec3(w2.x, w2.y, w2.z));
    r.spare01 = uintBitsToFloat(w2.w);
    r.n11 = uintBitsToFloat(uvec3(w3.x, w3.y, w3.z));
    r.spare11 = uintBitsToFloat(w3.w);
    return r;
}
