//! The generated file `generated/textures.glsl`: a function for each shape of texture tree that a scene has.

use super::shape::{Input, NoiseShape, Place, Shape};
use super::user;
use crate::layout::{NodeNumber, NoiseSum as NoiseRecord, Pattern, Ramp, Record as _, TextureInput, Wall};
use crate::scene::{
    Channel, Coordinates, GlslTexture, Gradient, Metric, NoiseSum, Perlin, PerlinVariant, VeinKind,
    WorleyFeature,
};
use std::fmt::Write as _;

/// Word of the record of a noise in that of a pattern that has a number.
const NOISE_AFTER_NUMBER: u32 = Pattern::WORDS + NodeNumber::WORDS;

impl Shape {
    /// Words of its record before those of its inputs.
    fn own_words(self) -> u32 {
        match self {
            Self::Checker(..) | Self::Gradient(..) | Self::Worley(..) => Pattern::WORDS,
            Self::Ramp(..) | Self::Spline(..) | Self::Curve(..) => Ramp::WORDS,
            Self::Noise(NoiseShape { sum: NoiseSum::Windy, .. }, ..) => {
                Pattern::WORDS + 2 * NoiseRecord::WORDS
            }
            Self::Noise(..) | Self::ValueNoise(..) => Pattern::WORDS + NoiseRecord::WORDS,
            Self::Brick(..) => Pattern::WORDS + Wall::WORDS + NodeNumber::WORDS,
            Self::Dots(..) => Pattern::WORDS + NodeNumber::WORDS,
            Self::WarpBy(..) => NodeNumber::WORDS,
            Self::DirectionMix(..) => TextureInput::WORDS,
            Self::WarpNoise(..) => NOISE_AFTER_NUMBER + NoiseRecord::WORDS,
            _ => 0,
        }
    }

    /// An input as an expression, seen from a context.
    fn seen(self, inputs: &[Input], i: u32, context: &str) -> String {
        let word = self.own_words() + i * TextureInput::WORDS;
        match inputs[i as usize] {
            Input::Constant => format!("texture_constant(at + {word}u)"),
            Input::Texture(shape) => format!("texture_{shape}(texture_input(at + {word}u), {context})"),
        }
    }

    /// Its value as an expression of `at` and `context`.
    fn expression(self) -> String {
        let inputs = |inputs: &[Input]| {
            let one = |i| self.seen(inputs, i as u32, "context");
            (0..inputs.len()).map(one).collect::<Vec<_>>().join(", ")
        };
        match &self {
            Self::Image(format, false) => format!("image_texture(at, {}u, context)", format.number()),
            Self::Image(format, true) => {
                format!("image_texture_trilinear(at, {}u, context)", format.number())
            }
            Self::Stack(format, space) => {
                let point = Place { coordinates: *space, filtered: false }.point();
                format!("stack_texture(at + {}u, {}u, {point})", Pattern::WORDS, format.number())
            }
            Self::Constant => "texture_constant(at)".to_owned(),
            Self::VertexColor(channel) => {
                let lanes = match channel {
                    Channel::Rgb => "rgb",
                    Channel::R => "rrr",
                    Channel::G => "ggg",
                    Channel::B => "bbb",
                    Channel::A => "aaa",
                };
                format!("vec4(context.vertex_color.{lanes}, context.vertex_color.a)")
            }
            Self::Checker(place, dimensions, of) => {
                let (point, of) = (place.point(), inputs(of));
                match place.filtered {
                    true => {
                        format!("texture_checker_filtered({point}, {}, {dimensions}u, {of})", place.widths())
                    }
                    false => format!("texture_checker({point}, {dimensions}u, {of})"),
                }
            }
            Self::Noise(noise, place, of) => {
                let value = if noise.normalized { noise.range() } else { "texture_raw" };
                format!("{value}({}, {})", noise.sum_at(place), inputs(of))
            }
            Self::ValueNoise(dimensions, place, of) => {
                let (word, point, width) = (Pattern::WORDS, place.point(), place.width());
                format!(
                    "texture_raw(0.5 + 0.5 * value_noise(at + {word}u, {point}, {width}, {dimensions}u), {})",
                    inputs(of)
                )
            }
            Self::Brick(place, of) => tiles("texture_brick", place, &inputs(of)),
            Self::Dots(place, of) => tiles("texture_dots", place, &inputs(of)),
            Self::Veins(kind, place) => veins(*kind, place),
            Self::Gradient(shape, place, of) => {
                let distance = match shape {
                    Gradient::Linear => "gradient_linear",
                    Gradient::Cylindrical => "gradient_cylindrical",
                    Gradient::Spherical => "gradient_spherical",
                };
                format!("texture_gradient({distance}({}), {})", place.point(), inputs(of))
            }
            Self::Worley(feature, metric, place, of) => {
                format!("texture_gradient({}, {})", worley(*feature, *metric, &place.point()), inputs(of))
            }
            Self::Ramp(of) => format!("texture_ramp(at, {})", inputs(of)),
            Self::Spline(of) => format!("texture_spline(at, {})", inputs(of)),
            Self::Curve(of) => format!("texture_curve(at, {})", inputs(of)),
            Self::Mix(of) => format!("texture_mix({})", inputs(of)),
            Self::DirectionMix(of) => {
                format!("texture_direction_mix(texture_constant(at).xyz, context.normal, {})", inputs(of))
            }
            Self::Add(of) => format!("texture_add({})", inputs(of)),
            Self::Multiply(of) => format!("texture_multiply({})", inputs(of)),
            Self::Scale(of) => format!("texture_scale({})", inputs(of)),
            Self::Invert(of) => format!("texture_invert({})", inputs(of)),
            Self::WarpBy(of) => {
                let by = self.seen(of, 1, "context");
                self.seen(of, 0, &format!("warped(context, at, 2.0 * {by}.rgb - 1.0)"))
            }
            Self::WarpNoise(place, of) => {
                // Points that share no cell of the lattice: three numbers that do not depend on one another
                let noise = |offset: &str| {
                    SUM.call(NOISE_AFTER_NUMBER, &format!("{} + {offset}", place.point()), &place.width())
                };
                let [x, y, z] = ["vec3(0.0)", "vec3(31.4, 7.7, 59.3)", "vec3(-17.2, 43.9, -71.5)"].map(noise);
                let word = Pattern::WORDS;
                self.seen(of, 0, &format!("warped(context, at + {word}u, vec3({x}, {y}, {z}))"))
            }
            Self::Mapped(..) | Self::User(_) => String::new(),
        }
    }

    /// The body of its function.
    fn body(self, users: &[&GlslTexture]) -> String {
        match self {
            Self::Mapped(mapping, [input]) => mapping.body(input),
            Self::User(user) => user::body(user as usize, users[user as usize]),
            _ => format!("return {};", self.expression()),
        }
    }

    /// Functions that sum its noise.
    fn sum(self) -> Option<NoiseShape> {
        match self {
            Self::Noise(noise, ..) => Some(noise),
            Self::Veins(VeinKind::Granite, _) => Some(NoiseShape { sum: NoiseSum::Turbulence, ..SUM }),
            Self::Veins(VeinKind::Marble, _) => Some(PBRT_SUM),
            Self::Veins(..) | Self::WarpNoise(..) => Some(SUM),
            _ => None,
        }
    }
}

/// The sum that bends marble.
const PBRT_SUM: NoiseShape =
    NoiseShape { perlin: Perlin { variant: PerlinVariant::Pbrt, ..SUM.perlin }, ..SUM };
/// The sum that bends wood and the input of a warp.
const SUM: NoiseShape = NoiseShape {
    sum: NoiseSum::Fbm,
    perlin: Perlin { variant: PerlinVariant::Improved, dimensions: 3 },
    normalized: false,
};

impl NoiseShape {
    /// From sum to colour, for a sum of amplitudes of 1.
    fn range(&self) -> &'static str {
        if self.sum == NoiseSum::Fbm { "texture_signed" } else { "texture_positive" }
    }

    fn basis(&self) -> String {
        let variant = match self.perlin.variant {
            PerlinVariant::Classic => "classic",
            PerlinVariant::Pbrt if self.perlin.dimensions == 3 => "pbrt",
            PerlinVariant::Improved | PerlinVariant::Pbrt => "improved",
        };
        format!("noise_{variant}_{}", self.perlin.dimensions)
    }

    /// Name of the function that sums it.
    fn name(&self) -> String {
        let sum = match self.sum {
            NoiseSum::Fbm | NoiseSum::Windy => "fbm",
            NoiseSum::Turbulence => "turbulence",
            NoiseSum::Ridged => "ridged",
        };
        format!("{sum}_{}", self.basis())
    }

    /// That function: the terms and their mean.
    fn function(&self) -> String {
        let (shaped, mean) = match self.sum {
            NoiseSum::Fbm | NoiseSum::Windy => ("octave_plain", "0.0"),
            NoiseSum::Turbulence => ("octave_creased", "0.2"),
            NoiseSum::Ridged => ("octave_ridged", "0.63"),
        };
        format!("NOISE_SUM({}, {}, {shaped}, {mean})", self.name(), self.basis())
    }

    /// The sum at a point, with the record at a word after the first.
    fn call(&self, word: u32, point: &str, width: &str) -> String {
        format!("{}(at + {word}u, vec4({point}, 0.0), {width})", self.name())
    }

    /// Its sum in a pattern.
    fn sum_at(&self, place: &Place) -> String {
        let (name, word, point, width) = (self.name(), Pattern::WORDS, place.point(), place.width());
        let w = if self.perlin.dimensions == 4 { "pattern_w(at, context.time)" } else { "0.0" };
        if self.sum == NoiseSum::Windy {
            let strength = format!("{name}(at + {word}u, 0.1 * vec4({point}, {w}), 0.1 * {width})");
            let next = word + NoiseRecord::WORDS;
            return format!("abs({strength}) * {name}(at + {next}u, vec4({point}, {w}), {width})");
        }
        format!("{name}(at + {word}u, vec4({point}, {w}), {width})")
    }
}

impl Place {
    /// The point in the space of the pattern.
    fn point(&self) -> String {
        let point = match self.coordinates {
            Coordinates::Uv => "vec3(context.uv, 0.0)",
            Coordinates::Object => "context.object_position",
            Coordinates::World => "context.position",
        };
        format!("pattern_point(at, {point})")
    }

    /// Widths of the pixel along the axes of the pattern.
    fn widths(&self) -> String {
        let widths = match self.coordinates {
            _ if !self.filtered => return "vec3(0.0)".to_owned(),
            Coordinates::Uv => "vec3(context.uv_footprint, 0.0)",
            Coordinates::Object => "vec3(context.object_footprint)",
            Coordinates::World => "vec3(context.footprint)",
        };
        format!("pattern_widths(at, {widths})")
    }

    /// The largest of them.
    fn width(&self) -> String {
        if self.filtered { format!("widest({})", self.widths()) } else { "0.0".to_owned() }
    }
}

fn tiles(function: &str, place: &Place, inputs: &str) -> String {
    format!("{function}(at + {}u, {}, {}, {inputs})", Pattern::WORDS, place.point(), place.widths())
}

fn veins(kind: VeinKind, place: &Place) -> String {
    let (word, point, width) = (Pattern::WORDS, place.point(), place.width());
    let number = match kind {
        VeinKind::Marble => {
            let sum = PBRT_SUM.call(NOISE_AFTER_NUMBER, &point, &width);
            format!("veins_marble(at + {word}u, {point}, {width}, {sum})")
        }
        VeinKind::Wood => {
            // A tree bends over several rings, and slowly along its axis
            let slow = |offset: &str| {
                let (point, width) =
                    (format!("{point} * WOOD_BEND + {offset}"), format!("WOOD_BEND.x * {width}"));
                SUM.call(NOISE_AFTER_NUMBER, &point, &width)
            };
            let (x, y) = (slow("0.0"), slow("vec3(31.4, 7.7, 59.3)"));
            format!("veins_wood(at + {word}u, {point}, {width}, vec2({x}, {y}))")
        }
        VeinKind::Granite => {
            let sum = NoiseShape { sum: NoiseSum::Turbulence, ..SUM };
            sum.call(NOISE_AFTER_NUMBER, &point, &width)
        }
    };
    format!("vec4(vec3({number}), 1.0)")
}

fn worley(feature: WorleyFeature, metric: Metric, point: &str) -> String {
    let feature = match feature {
        WorleyFeature::F1 => "worley_f1",
        WorleyFeature::F2 => "worley_f2",
        WorleyFeature::Difference => "worley_difference",
        WorleyFeature::Edge => return format!("worley_edge({point})"),
    };
    let cells = match metric {
        Metric::Euclidean => "worley_euclidean",
        Metric::Manhattan => "worley_manhattan",
        Metric::Chebyshev => "worley_chebyshev",
    };
    format!("{feature}({cells}({point}))")
}

const HEAD: &str = "// Generated from the textures of the scene.
#include \"texture/image.glsl\"
#include \"texture/join.glsl\"
#include \"texture/tiles.glsl\"
#include \"texture/value_noise.glsl\"
#include \"texture/veins.glsl\"

";

/// The file, with a function for each use of textures and the shapes that it may meet. A shape that is only ever an input of
/// others has no case: on Mesa before 24.3 a case that no lane takes costs as much as any.
pub(super) fn glsl(
    shapes: &[Shape],
    uses: &[(&str, Vec<bool>)],
    users: &[&GlslTexture],
    octahedral: bool,
) -> String {
    let mut text = String::new();
    if octahedral {
        text.push_str("#define OCTAHEDRAL_PICTURES\n");
    }
    text.push_str(HEAD);
    let any = |is: fn(&Shape) -> bool| shapes.iter().any(is);
    for (file, used) in [
        ("pyramid", any(|shape| matches!(shape, Shape::Image(_, true)))),
        ("stack", any(|shape| matches!(shape, Shape::Stack(..)))),
        ("mapping", any(|shape| matches!(shape, Shape::Mapped(..)))),
        ("library", !users.is_empty()),
    ] {
        if used {
            _ = writeln!(text, "#include \"texture/{file}.glsl\"");
        }
    }
    let mut sums: Vec<String> =
        shapes.iter().filter_map(|shape| shape.sum()).map(|sum| sum.function()).collect();
    sums.sort();
    sums.dedup();
    for sum in sums {
        _ = writeln!(text, "{sum}");
    }
    for (i, user) in users.iter().enumerate() {
        user::write_text(&mut text, i, user);
    }
    for (i, shape) in shapes.iter().enumerate() {
        let body = shape.body(users);
        _ = writeln!(text, "vec4 texture_{i}(uint at, TextureContext context) {{ {body} }}");
    }
    for (name, roots) in uses {
        _ = write!(
            text,
            "\nvec4 {name}(uint reference, TextureContext context)\n{{\n    uint at = reference & 0xffffffu;\n    \
             switch (reference >> 24) {{\n",
        );
        for (i, _) in roots.iter().enumerate().filter(|(_, root)| **root) {
            _ = writeln!(text, "    case {i}u: return texture_{i}(at, context);");
        }
        text.push_str("    default: return vec4(0.0);\n    }\n}\n");
    }
    text
}
