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
    /// Words a pixel of the film.
    FILM_PLANES = 9;
    /// Words of the ray of a slot.
    RAY_WORDS = 2;
    /// Words of what the ray of a slot met.
    HIT_WORDS = 1;
    /// Words of the path of a slot.
    PATH_WORDS = 3;
    /// Words of the shadow ray of a slot.
    SHADOW_WORDS = 3;
    /// Words of albedo, depth and normal of a slot.
    AOV_WORDS = 2;
    /// Numbers that a parked ray keeps beside its stack.
    PARKED_HEAD = 6;
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
    /// Instance kind: triangles in object space.
    INSTANCE_MESH = 0;
    /// Instance kind: all triangles that are placed once, in world space.
    INSTANCE_SOUP = 1;
    /// Instance kind: unit sphere.
    INSTANCE_SPHERE = 2;
    /// Instance kind: unit disk.
    INSTANCE_DISK = 3;
    /// Material kind: colour is radiance.
    MATERIAL_UNLIT = 0;
    /// Material kind: Lambertian.
    MATERIAL_DIFFUSE = 1;
    /// Material kind: modified Phong.
    MATERIAL_PHONG = 2;
    /// Material kind: mirror or GGX metal.
    MATERIAL_CONDUCTOR = 3;
    /// Material kind: smooth or GGX glass.
    MATERIAL_DIELECTRIC = 4;
    /// Conductor rule: conductor with eta and k.
    FRESNEL_INDEX = 0;
    /// Conductor rule: conductor with eta 1 and the k of its reflectance.
    FRESNEL_EXACT = 1;
    /// Conductor rule: Schlick's approximation.
    FRESNEL_SCHLICK = 2;
    /// Conductor rule: the same at every angle.
    FRESNEL_NONE = 3;
    /// Light kind: point light.
    LIGHT_POINT = 0;
    /// Light kind: spot light.
    LIGHT_SPOT = 1;
    /// Light kind: parallel light.
    LIGHT_DISTANT = 2;
    /// Light kind: sphere.
    LIGHT_SPHERE = 3;
    /// Light kind: rectangle or parallelogram.
    LIGHT_QUAD = 4;
    /// Light kind: disk; edges are its radii.
    LIGHT_DISK = 5;
    /// Light kind: triangle of a mesh.
    LIGHT_TRIANGLE = 6;
    /// Wrap mode: the picture again. Bits 0..2 and 2..4 of the flags of an image texture.
    WRAP_REPEAT = 0;
    /// Wrap mode: the texel at the edge.
    WRAP_CLAMP = 1;
    /// Wrap mode: the picture and its mirror image.
    WRAP_MIRROR = 2;
    /// Wrap mode: zero.
    WRAP_BLACK = 3;
    /// Flag of an image texture.
    FLAG_NEAREST = 16;
    /// Flag of an image texture.
    FLAG_INVERT = 32;
    /// Position of the channel in the flags of an image texture.
    CHANNEL_SHIFT = 8;
}
