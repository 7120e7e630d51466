//! How records are declared.

macro_rules! glsl_type {
    (f32) => {
        "float"
    };
    (u32) => {
        "uint"
    };
    ([f32; 2]) => {
        "vec2"
    };
    ([f32; 3]) => {
        "vec3"
    };
    ([f32; 4]) => {
        "vec4"
    };
    ([u32; 2]) => {
        "uvec2"
    };
    ([u32; 3]) => {
        "uvec3"
    };
    ([u32; 4]) => {
        "uvec4"
    };
}

/// Declares records: the Rust struct, its place in GLSL, and the list `ALL` of the file.
macro_rules! records {
    ($( $(#[doc = $about:literal])* struct $name:ident { $( #[doc = $doc:literal] $field:ident: $ty:tt, )* } )*) => {
        $(
            $(#[doc = $about])*
            #[repr(C)]
            #[derive(Debug, Clone, Copy, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
            pub struct $name { $( #[doc = $doc] pub $field: $ty, )* }

            impl Record for $name {
                const NAME: &'static str = stringify!($name);
                const FIELDS: &'static [Field] = &[ $( Field {
                    name: stringify!($field),
                    doc: $doc.trim_ascii(),
                    glsl_type: glsl_type!($ty),
                    offset: (std::mem::offset_of!($name, $field) / 4) as u32,
                }, )* ];
                const WORDS: u32 = {
                    assert!(std::mem::size_of::<$name>() % 16 == 0, "a record is a whole number of words");
                    (std::mem::size_of::<$name>() / 16) as u32
                };
            }
        )*

        /// The records of this file.
        pub(super) const ALL: &[RecordInfo] = &[ $( RecordInfo::of::<$name>(), )* ];
    };
}
