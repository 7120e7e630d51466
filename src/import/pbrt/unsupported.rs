//! What pbrt has and dapple has not: the one table of it, which the manual repeats.

use super::place::Spot;
use crate::import::Warning;
use std::collections::BTreeMap;

/// Names what is missing, how it is written, and what is done instead.
macro_rules! unsupported {
    ($($name:ident: $written:literal, $instead:literal;)+) => {
        /// Something that a scene may have and dapple cannot show.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub(super) enum Unsupported { $($name,)+ }

        impl Unsupported {
            /// All of them.
            #[cfg(test)]
            pub const ALL: &[Self] = &[$(Self::$name,)+];

            /// As scenes write it.
            pub fn written(self) -> &'static str {
                match self { $(Self::$name => $written,)+ }
            }

            /// What is done instead.
            pub fn instead(self) -> &'static str {
                match self { $(Self::$name => $instead,)+ }
            }
        }
    };
}

unsupported! {
    AcesSpace: "ColorSpace \"aces2065-1\"", "taken as \"srgb\"";
    Interval: "TransformTimes", "what moves does so while the shutter is open";
    MovingLight: "a light that moves", "it stands where it is when the shutter opens";
    Medium: "MediumInterface", "there is no medium";
    NamedMedium: "MakeNamedMedium", "there is no medium";
    CameraMedium: "MediumInterface of the camera", "there is no medium";
    Sheared: "a camera that is stretched or sheared", "its axes are taken without their lengths and at right angles";
    Frame: "frameaspectratio", "pixels are square";
    Window: "screenwindow that is not in the middle or has another shape than the film", "it is as high as said, in the middle";
    OrthographicLens: "lensradius of an orthographic camera", "all is sharp";
    EqualAreaCamera: "Camera \"spherical\" with mapping \"equalarea\"", "the mapping is \"equirectangular\"";
    ApertureShape: "aperture \"gaussian\", \"square\" or \"star\"", "a circle";
    Sensor: "sensor other than \"cie1931\"", "the sensor sees as the eye does";
    WhiteBalance: "whitebalance", "colours stay as they are";
    MaxComponent: "maxcomponentvalue", "nothing is cut off";
    SpectralFilm: "Film \"spectral\"", "the film is \"rgb\"";
    FilterSize: "a filter that is not as wide as high", "it is as wide as high";
    FilterSigma: "sigma that is not a third of the radius", "sigma is a third of the radius";
    PixelJitter: "Option \"disablepixeljitter\"", "samples are spread over the pixel";
    ForceDiffuse: "Option \"forcediffuse\"", "materials stay as they are";
    Integrator: "Integrator \"ambientocclusion\" and \"function\"", "paths are traced";
    Regularize: "regularize", "nothing is made rougher";
    Curve: "Shape \"curve\"", "left out";
    InsideOut: "a sphere, cylinder or disk whose front is turned inside", "a mesh";
    ManyPatches: "Shape \"bilinearmesh\" of more than 65,536 patches", "triangles";
    DisplacedInstance: "displacement of a plymesh in an object", "its edges and heights are those of the smallest place";
    Ptex: "Texture \"ptex\"", "a constant of 0.5";
    LayerMedium: "albedo of \"coateddiffuse\" or \"coatedconductor\"", "nothing is between the layers";
    LargeIndex: "an index of refraction above 100", "it is 100";
    Hair: "Material \"hair\"", "a \"diffuse\" one of 0.5";
    Measured: "Material \"measured\"", "a \"diffuse\" one of 0.5";
    Subsurface: "Material \"subsurface\"", "a \"diffuse\" one of 0.5";
    ShiningInterface: "an area light on Material \"interface\"", "the light is a black surface";
    ShearedLight: "a light with an image that is sheared", "its axes are taken as they are";
    SecondEnvironment: "a second LightSource \"infinite\" beside an image", "the image alone shines";
    Portal: "portal", "the light shines from everywhere";
    InstancedLamp: "an area light in an object", "it does not shine, as in pbrt";
}

/// What was found, and how often.
#[derive(Debug, Default)]
pub(super) struct Missing {
    found: BTreeMap<Unsupported, (Spot, usize)>,
}

impl Missing {
    /// Notes that something is there which dapple cannot show.
    pub fn note(&mut self, what: Unsupported, spot: &Spot) {
        self.found.entry(what).or_insert_with(|| (spot.clone(), 0)).1 += 1;
    }

    /// A warning for each, at its first place.
    pub fn warnings(&self) -> Vec<Warning> {
        let warning = |(what, (spot, count)): (&Unsupported, &(Spot, usize))| {
            let times = if *count > 1 { format!(", {count} times") } else { String::new() };
            let message = format!("not supported: {}{times}: {}", what.written(), what.instead());
            Warning { place: spot.place(), message }
        };
        self.found.iter().map(warning).collect()
    }
}
