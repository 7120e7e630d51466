//! The constants and enum numbers that host and kernels share.

/// Declares constants: the Rust item, and its row in [`CONSTANTS`].
macro_rules! constants {
    ($( #[doc = $doc:literal] $name:ident = $value:expr; )*) => {
        $( #[doc = $doc] pub const $name: u32 = $value; )*

        /// Constants of `layout.glsl`: name, value, meaning.
        pub const CONSTANTS: &[(&str, u32, &str)] = &[ $( (stringify!($name), $name, $doc.trim_ascii()), )* ];
    };
}

constants! {
    /// No object.
    NONE = u32::MAX;
    /// Invocations of a workgroup: `local_size_x`, the only size in use.
    WORKGROUP = 64;
    /// Side of a square tile of pixels: a workgroup takes one.
    TILE = 8;
    /// Most entries that the traversal stack of a kernel may have. `prepare` proves that every tree fits.
    STACK_ENTRIES = 160;
    /// Planes of the film: word w of pixel p is lane w % 4 of word p of plane w / 4. Sums have the lowest word first.
    FILM_PLANES = 9;
    /// Film: sums of radiance, signed, two words a channel.
    FILM_RADIANCE = 0;
    /// Film: number of samples.
    FILM_SAMPLES = 6;
    /// Film: samples whose camera ray hit something.
    FILM_COVERED = 7;
    /// Film: sums of squares of radiance, unsigned, three words of every four a channel.
    FILM_SQUARES = 8;
    /// Film: samples left out because they were not finite.
    FILM_LEFT_OUT = 11;
    /// Film: samples clamped to what the sums can hold.
    FILM_CLAMPED = 15;
    /// Film: sums of albedo, signed, two words a channel.
    FILM_ALBEDO = 20;
    /// Film: sum of depths, signed, two words.
    FILM_DEPTH = 26;
    /// Film: sums of normals, signed, two words a coordinate.
    FILM_NORMAL = 28;
    /// Film: samples that have a depth.
    FILM_DEPTH_HITS = 34;
    /// Bits behind the point of the sums of albedo and normal.
    AOV_BITS = 20;
    /// What a number is multiplied by, in 24 bits, to be the three bytes of a colour; odd, so that there is a way back.
    NUMBER_FACTOR = 0x009E_3779;
    /// Words of the ray of a slot.
    RAY_WORDS = 2;
    /// Words of what the ray of a slot met.
    HIT_WORDS = 1;
    /// Words of the path of a slot.
    PATH_WORDS = 3;
    /// Bits of each of the two depths of a path.
    PATH_DEPTH_BITS = 12;
    /// Words of the shadow ray of a slot.
    SHADOW_WORDS = 3;
    /// Words of albedo, depth and normal of a slot.
    AOV_WORDS = 2;
    /// Numbers that a parked ray keeps beside its stack.
    PARKED_HEAD = 9;
    /// Most rounds of loops that a step of a traversal takes: its own, and one for each child that waits.
    ROUNDS_A_STEP = 4;
    /// Parts of a queue, one for each octant of directions.
    QUEUE_BINS = 8;
    /// Counter: the half of the queues that is read, 0 or 1; the other half is filled.
    COUNTER_TURN = 0;
    /// Counter: paths that wait.
    COUNTER_WAITING_PATHS = 1;
    /// Counter: shadow rays that wait.
    COUNTER_WAITING_SHADOWS = 2;
    /// Three counters: size of the dispatch over paths.
    COUNTER_PATH_GROUPS = 4;
    /// Three counters: size of the dispatch over shadow rays.
    COUNTER_SHADOW_GROUPS = 8;
    /// Counters: lengths of the parts of the path queue, of both halves.
    COUNTER_PATHS = 16;
    /// Counters: lengths of the parts of the shadow queue, of both halves.
    COUNTER_SHADOWS = 32;
    /// Number of counters.
    COUNTERS = 48;
    /// Words of what a kernel knows of a queue: where the workgroups of its parts begin, their lengths, half and groups.
    SCHEDULE_WORDS = 5;
    /// Words of an item of the tree: a Node, a Triangle, or the number of an instance and nothing else.
    ITEM_WORDS = 3;
    /// Bit of a reference: a leaf. Its other bits are the number of its primitives less one, and the first item of them.
    LEAF = 1 << 31;
    /// Bit of a leaf reference: it is an instance.
    LEAF_INSTANCE = 1 << 30;
    /// Where the number of primitives begins in a leaf reference.
    LEAF_COUNT_SHIFT = 28;
    /// Bits of a leaf reference: the number of its primitives less one.
    LEAF_COUNT_MASK = 3 << LEAF_COUNT_SHIFT;
    /// Bits of a reference: the item of the tree.
    LEAF_FIRST_MASK = (1 << LEAF_COUNT_SHIFT) - 1;
    /// Byte of a node where it has no child.
    CHILD_NONE = 255;
    /// Bits of the byte of a child: its first item, counted from the first item of all children.
    CHILD_OFFSET_MASK = 15;
    /// Places that the other bits of that byte move up to become those of a reference.
    CHILD_MARK_SHIFT = 24;
    /// Bit of the number of a triangle within its mesh: rays may go through it.
    PRIMITIVE_LETS_THROUGH = 1 << 31;
    /// Bit of the number of a triangle within its mesh: it is not there from behind.
    PRIMITIVE_FRONT_ONLY = 1 << 30;
    /// Instance kind: triangles in object space.
    INSTANCE_MESH = 0;
    /// Instance kind: all triangles that are placed once, in world space.
    INSTANCE_SOUP = 1;
    /// Instance kind: unit sphere.
    INSTANCE_SPHERE = 2;
    /// Instance kind: unit disk.
    INSTANCE_DISK = 3;
    /// Instance kind: part of the unit sphere; its root is the first word of its QuadricPart.
    INSTANCE_SPHERE_PART = 4;
    /// Instance kind: part of the unit disk.
    INSTANCE_DISK_PART = 5;
    /// Instance kind: tube of radius 1 about z from 0 to 1, or a part of it.
    INSTANCE_CYLINDER = 6;
    /// Instance kind: bilinear patch; its root is the first word of its BilinearPatch.
    INSTANCE_PATCH = 7;
    /// Instance flag: the mesh has no uv, so that it is (0,0), (1,0), (1,1) on every triangle.
    INSTANCE_DEFAULT_UV = 1;
    /// Instance flag: each triangle is a light of its own; else they are one light together.
    INSTANCE_TRIANGLE_LIGHTS = 2;
    /// Material kind: colour is radiance.
    MATERIAL_UNLIT = 0;
    /// Material kind: mirror or GGX metal.
    MATERIAL_CONDUCTOR = 1;
    /// Material kind: smooth or GGX glass.
    MATERIAL_DIELECTRIC = 2;
    /// Material kind: the model of glTF.
    MATERIAL_PRINCIPLED = 3;
    /// Material kind: one of two materials at each event.
    MATERIAL_MIX = 4;
    /// Material kind: a dielectric interface over a Lambertian base.
    MATERIAL_COATED_DIFFUSE = 5;
    /// Material kind: a dielectric interface over metal.
    MATERIAL_COATED_CONDUCTOR = 6;
    /// Material kind: the first BSDF of the table; the others follow in its order.
    MATERIAL_BSDFS = 7;
    /// Words of a material: a MaterialHead, then its inputs. Their places are the INPUT_… constants.
    MATERIAL_WORDS = 12;
    /// Material flag: it sends light out on both sides.
    MATERIAL_TWO_SIDED = 1;
    /// Material flag: what its roughness inputs give are roughnesses, to be squared.
    MATERIAL_SQUARED = 2;
    /// Material flag: what its interface inputs give are roughnesses, to be squared.
    MATERIAL_INTERFACE_SQUARED = 4;
    /// Material flag: its surfaces are there from the front alone.
    MATERIAL_FRONT_ONLY = 8;
    /// ColorInput of all materials: radiance sent out.
    INPUT_EMISSION = 1;
    /// ColorInput: radiance, reflectance, diffuse coefficient or base colour.
    INPUT_COLOR = 2;
    /// NumberInputs: GGX widths along ∂p/∂u and across it.
    INPUT_ROUGHNESS = 3;
    /// ColorInput: specular coefficient of Phong, transmittance, η of a conductor, specular colour.
    INPUT_SPECULAR = 4;
    /// ColorInput: k of a conductor; absorption inside of glass, which takes no texture.
    INPUT_ABSORPTION = 5;
    /// NumberInputs: index of refraction of a dielectric, or exponent of Phong; weight of what a dielectric reflects.
    INPUT_INDEX = 6;
    /// NumberInputs: metallic, transmission.
    INPUT_METALLIC = 7;
    /// NumberInputs: clearcoat, its roughness; GGX widths of an interface over metal.
    INPUT_CLEARCOAT = 8;
    /// ColorInput: sheen.
    INPUT_SHEEN = 9;
    /// NumberInputs: roughness of the sheen.
    INPUT_SHEEN_ROUGHNESS = 10;
    /// InterfaceInput, where there is no sheen.
    INPUT_INTERFACE = 10;
    /// Cells of a table of an interface along the cosine.
    INTERFACE_COLUMNS = 32;
    /// Cells of a table of an interface along the width.
    INTERFACE_ROWS = 16;
    /// MixInput.
    INPUT_MIX = 11;
    /// Detail flag: the bend of the surface itself, times the height, counts in a bump map.
    DETAIL_CURVATURE = 1;
    /// Detail flag: the light at the edge of bumps is softened.
    DETAIL_SOFT_TERMINATOR = 2;
    /// Detail flag: a normal that is turned away from the viewer is turned back.
    DETAIL_VISIBLE = 4;
    /// Detail flag: tangents of a normal map are those of the vertices.
    DETAIL_VERTEX_TANGENTS = 8;
    /// Detail flag: green in a normal map is down.
    DETAIL_GREEN_DOWN = 16;
    /// Detail flag: the surface is there from its front alone.
    DETAIL_FRONT_ONLY = 32;
    /// Detail flag: the picture of a bump map is placed by the second uv.
    DETAIL_HEIGHT_UV1 = 64;
    /// Detail flag: the picture of a normal map is placed by the second uv.
    DETAIL_NORMAL_UV1 = 128;
    /// Rule of a derivative: forward differences.
    DERIVATIVE_FORWARD = 0;
    /// Rule of a derivative: the 3 × 3 kernel over texels.
    DERIVATIVE_KERNEL = 1;
    /// Rule of a derivative: that of the bilinear surface between texels.
    DERIVATIVE_BILINEAR = 2;
    /// Rule of a derivative: central differences.
    DERIVATIVE_CENTRAL = 3;
    /// Dielectric mode: a boundary with an inside.
    DIELECTRIC_SOLID = 0;
    /// Dielectric mode: a sheet without an inside.
    DIELECTRIC_THIN = 1;
    /// Conductor rule: conductor with eta and k.
    FRESNEL_INDEX = 0;
    /// Conductor rule: conductor with eta 1 and the k of its reflectance.
    FRESNEL_EXACT = 1;
    /// Conductor rule: Schlick's approximation.
    FRESNEL_SCHLICK = 2;
    /// Conductor rule: the same at every angle.
    FRESNEL_NONE = 3;
    /// Intervals of the distance from the middle of the film that have bounds of the exit pupil of their own.
    PUPIL_INTERVALS = 64;
    /// Cells of a pixel filter from its middle to its radius, a power of two.
    FILTER_CELLS = 128;
    /// Light kind: point light.
    LIGHT_POINT = 0;
    /// Light kind: picture thrown from a point.
    LIGHT_PROJECTION = 1;
    /// Light kind: sphere or ellipsoid.
    LIGHT_SPHERE = 2;
    /// Light kind: rectangle or parallelogram.
    LIGHT_QUAD = 3;
    /// Light kind: disk; edges are its radii.
    LIGHT_DISK = 4;
    /// Light kind: triangle of a mesh.
    LIGHT_TRIANGLE = 5;
    /// Bit of the word of the corners of a triangle that is a light: its second and third corner changed places.
    LIGHT_TURNED = 1 << 31;
    /// Light kind: part of a sphere.
    LIGHT_SPHERE_PART = 6;
    /// Light kind: part of a disk.
    LIGHT_DISK_PART = 7;
    /// Light kind: tube, or a part of it.
    LIGHT_CYLINDER = 8;
    /// Light kind: bilinear patch.
    LIGHT_PATCH = 9;
    /// Light kind: the first light of the table; the others follow in its order.
    LIGHT_PUNCTUAL = 10;
    /// Texel format: a word holds 2×2 texels of 8 bits a channel.
    TEXELS_RGBA8 = 0;
    /// Texel format: the same; colour is decoded before it is filtered.
    TEXELS_RGBA8_SRGB = 1;
    /// Texel format: a word holds 2×1 texels of halves.
    TEXELS_RGBA16F = 2;
    /// Texel format: a word holds 1 texel of floats.
    TEXELS_RGBA32F = 3;
    /// Wrap mode: the picture again.
    WRAP_REPEAT = 0;
    /// Wrap mode: the texel at the edge.
    WRAP_CLAMP = 1;
    /// Wrap mode: the picture and its mirror image.
    WRAP_MIRROR = 2;
    /// Wrap mode: zero.
    WRAP_BLACK = 3;
    /// Bits of the flags of an image texture: its wrap mode along u, from bit 0.
    WRAP_MASK = 3;
    /// Position of the wrap mode along v in the flags of an image texture.
    WRAP_V_SHIFT = 2;
    /// Position of the wrap mode across the slices in the flags of a stack.
    WRAP_W_SHIFT = 6;
    /// Flag of an image texture: the nearest texel in place of bilinear filtering.
    FLAG_NEAREST = 16;
    /// Flag of an image texture: 1 less the colour.
    FLAG_INVERT = 32;
    /// Flag of an image texture: an octahedral map, beyond whose edges its sphere goes on; in place of the wrap modes.
    FLAG_OCTAHEDRAL = 4096;
    /// Position of the channel in the flags of an image texture.
    CHANNEL_SHIFT = 8;
    /// Bits of the channel in the flags of an image texture, moved down to bit 0.
    CHANNEL_MASK = 15;
    /// Position of the number of levels in the flags of an image texture; nothing is above it.
    LEVELS_SHIFT = 16;
    /// Channel: all as they are.
    CHANNEL_RGB = 0;
    /// Channel: red in all.
    CHANNEL_R = 1;
    /// Channel: green in all.
    CHANNEL_G = 2;
    /// Channel: blue in all.
    CHANNEL_B = 3;
    /// Channel: alpha in all.
    CHANNEL_A = 4;
}
