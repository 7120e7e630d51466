//! The generated file `generated/textures.glsl`: a function for each shape of texture tree that a scene has.

use crate::layout::{NoiseSum as NoiseRecord, Pattern, Ramp, Record as _, TextureInput};
use crate::prepare::atlas::Format;
use crate::scene::{Coordinates, Gradient, Metric, NoiseSum, WorleyFeature};
use std::fmt::Write as _;

/// What a texture tree is, but for its numbers. Its inputs are shapes with smaller numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Image(Format),
    Constant,
    Checker(Coordinates, [Input; 2]),
    Noise(NoiseSum, Coordinates, [Input; 2]),
    Gradient(Gradient, Coordinates, [Input; 2]),
    Worley(WorleyFeature, Metric, Coordinates, [Input; 2]),
    Ramp([Input; 1]),
    Mix([Input; 3]),
    Add([Input; 2]),
    Multiply([Input; 2]),
    Invert([Input; 1]),
}

/// An input of a tree: a constant in its record, or a tree of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Input {
    Constant,
    Texture(u32),
}

impl Shape {
    /// Words of its record before those of its inputs.
    fn own_words(self) -> u32 {
        match self {
            Self::Checker(..) | Self::Gradient(..) | Self::Worley(..) => Pattern::WORDS,
            Self::Ramp(..) => Ramp::WORDS,
            Self::Noise(..) => Pattern::WORDS + NoiseRecord::WORDS,
            _ => 0,
        }
    }

    /// Its value as an expression of `at` and `context`.
    fn expression(self) -> String {
        let inputs = |inputs: &[Input]| {
            let one = |(i, input): (usize, &Input)| {
                let word = self.own_words() + i as u32 * TextureInput::WORDS;
                match input {
                    Input::Constant => format!("texture_constant(at + {word}u)"),
                    Input::Texture(shape) => format!("texture_{shape}(texture_input(at + {word}u), context)"),
                }
            };
            inputs.iter().enumerate().map(one).collect::<Vec<_>>().join(", ")
        };
        match &self {
            Self::Image(format) => format!("image_texture(at, {}u, context)", format.number()),
            Self::Constant => "texture_constant(at)".to_owned(),
            Self::Checker(space, of) => format!("texture_checker({}, {})", point(*space), inputs(of)),
            Self::Noise(sum, space, of) => {
                let creased = *sum == NoiseSum::Turbulence;
                let (word, point) = (Pattern::WORDS, point(*space));
                format!("texture_noise(at + {word}u, {point}, {creased}, {})", inputs(of))
            }
            Self::Gradient(shape, space, of) => {
                let distance = match shape {
                    Gradient::Linear => "gradient_linear",
                    Gradient::Cylindrical => "gradient_cylindrical",
                    Gradient::Spherical => "gradient_spherical",
                };
                format!("texture_gradient({distance}({}), {})", point(*space), inputs(of))
            }
            Self::Worley(feature, metric, space, of) => {
                let feature = match feature {
                    WorleyFeature::F1 => "worley_f1",
                    WorleyFeature::F2 => "worley_f2",
                    WorleyFeature::Difference => "worley_difference",
                };
                let cells = match metric {
                    Metric::Euclidean => "worley_euclidean",
                    Metric::Manhattan => "worley_manhattan",
                    Metric::Chebyshev => "worley_chebyshev",
                };
                format!("texture_gradient({feature}({cells}({})), {})", point(*space), inputs(of))
            }
            Self::Ramp(of) => format!("texture_ramp(at, {})", inputs(of)),
            Self::Mix(of) => format!("texture_mix({})", inputs(of)),
            Self::Add(of) => format!("texture_add({})", inputs(of)),
            Self::Multiply(of) => format!("texture_multiply({})", inputs(of)),
            Self::Invert(of) => format!("texture_invert({})", inputs(of)),
        }
    }
}

fn point(space: Coordinates) -> &'static str {
    match space {
        Coordinates::Uv => "pattern_point(at, vec3(context.uv, 0.0))",
        Coordinates::Object => "pattern_point(at, context.object_position)",
        Coordinates::World => "pattern_point(at, context.position)",
    }
}

/// The file, with a function for each use of textures and the shapes that it may meet. A shape that is only ever an input of
/// others has no case: on Mesa before 24.3 a case that no lane takes costs as much as any.
pub(super) fn glsl(shapes: &[Shape], uses: &[(&str, Vec<bool>)]) -> String {
    let mut text = String::from(
        "// Generated from the textures of the scene.\n#include \"texture/image.glsl\"\n#include \"texture/pattern.glsl\"\n\n",
    );
    for (i, shape) in shapes.iter().enumerate() {
        let value = shape.expression();
        _ = writeln!(text, "vec4 texture_{i}(uint at, TextureContext context) {{ return {value}; }}");
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
