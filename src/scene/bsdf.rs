//! The table of BSDFs: those that are nothing but inputs and a file of shaders.

use super::{Handle, InputColor, InputNumber, Surface, Texture, Value};
use glam::Vec3;

/// A row of [`BSDFS`].
#[derive(Debug, PartialEq)]
pub struct BsdfKind {
    /// Its kind in a scene: `shaders/material/NAME.glsl` has its verbs `NAME_eval`, `NAME_pdf` and `NAME_sample`.
    pub name: &'static str,
    /// Its colours, at most [`Self::MOST_COLORS`].
    pub colors: &'static [InputColor],
    /// Its numbers, at most [`Self::MOST_NUMBERS`].
    pub numbers: &'static [InputNumber],
}

impl BsdfKind {
    /// As many colours as a material has room for.
    pub const MOST_COLORS: usize = 2;
    /// As many numbers as a material has room for.
    pub const MOST_NUMBERS: usize = 2;

    /// The row of a name.
    pub fn named(name: &str) -> Option<&'static Self> {
        BSDFS.iter().find(|kind| kind.name == name).copied()
    }

    /// Its place in [`BSDFS`].
    pub fn index(&self) -> usize {
        BSDFS.iter().position(|kind| kind.name == self.name).unwrap_or(BSDFS.len())
    }
}

/// What a surface does with light by a BSDF of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Bsdf {
    /// Its row.
    pub kind: &'static BsdfKind,
    /// Its colours, as many as the row has.
    pub colors: Vec<Value<Vec3>>,
    /// Its numbers, as many as the row has.
    pub numbers: Vec<Value<f32>>,
}

impl Bsdf {
    /// The textures that drive it.
    pub(super) fn textures(&self) -> Vec<Option<Handle<Texture>>> {
        self.colors.iter().map(Value::texture).chain(self.numbers.iter().map(Value::texture)).collect()
    }
}

/// Declares them: `name(color = default, …; number = default in least..=most, …)`. Each gets a row of [`BSDFS`] and a constructor.
macro_rules! bsdfs {
    ($( $(#[doc = $doc:literal])* $name:ident(
        $($color:ident = $grey:literal),*; $($number:ident = $usual:literal in $least:literal..=$most:literal),*
    ); )*) => {
        #[allow(non_upper_case_globals)] // Named as in scenes
        mod rows {
            use super::{InputColor, BsdfKind, InputNumber};
            $( pub(super) static $name: BsdfKind = BsdfKind {
                name: stringify!($name),
                colors: &[$( InputColor { key: stringify!($color), default: $grey } ),*],
                numbers: &[$( InputNumber {
                    key: stringify!($number), default: $usual, least: $least, most: $most,
                } ),*],
            }; )*
        }

        /// Every row.
        pub static BSDFS: &[&BsdfKind] = &[$( &rows::$name ),*];

        impl Surface {
            $(
                $(#[doc = $doc])*
                pub fn $name($($color: Value<Vec3>,)* $($number: Value<f32>,)*) -> Self {
                    Self::Bsdf(Bsdf {
                        kind: &rows::$name, colors: vec![$($color),*], numbers: vec![$($number),*],
                    })
                }
            )*
        }
    };
}

// The keys of scene files, their export, the records of materials, the constructors and all GLSL but the verbs follow from a line here.
bsdfs! {
    /// Lambertian (the lecture's third use).
    diffuse(color = 0.5;);
    /// Lambertian on both sides: the part that goes back to the side from which light comes, and the part that goes on.
    diffuse_transmission(color = 0.25, transmittance = 0.25;);
    /// Modified Phong: kd/π + ks (n+2)/(2π) cosⁿ (Lafortune and Willems 1994), of the coefficients kd and ks and the exponent n. Larger
    /// exponents cannot be told from a mirror, and 32-bit powers of them fail.
    phong(diffuse = 0.5, specular = 0.0; exponent = 50.0 in 0.0..=1e6);
}

const _: () = {
    let mut i = 0;
    while i < BSDFS.len() {
        assert!(BSDFS[i].colors.len() <= BsdfKind::MOST_COLORS, "a material has room for two colours");
        assert!(BSDFS[i].numbers.len() <= BsdfKind::MOST_NUMBERS, "a material has room for two numbers");
        assert!(BSDFS[i].colors.len() + BSDFS[i].numbers.len() > 0, "a BSDF reads something");
        i += 1;
    }
};
