//! The camera: where it stands, and how rays leave it.

mod lens;
mod paraxial;

pub(crate) use lens::LINES;
pub use lens::{LensCamera, LensInterface, LensSystem, Measure, Stop};
pub use paraxial::{Paraxial, Pupil};

use super::{Handle, Image};
use glam::{Affine3A, Vec3};

/// The side of the picture that the field of view spans.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FovAxis {
    /// Bottom to top.
    Vertical,
    /// Left to right.
    Horizontal,
    /// The shorter side, as pbrt does.
    Smaller,
}

/// How wide the lens is open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Aperture {
    /// Radius of the lens in scene units.
    Radius(f32),
    /// Focal length divided by the diameter. The focal length follows from the field of view and the height of
    /// the sensor: radius = sensor_height / (2 tan(fov/2)) / (2 N).
    FNumber {
        /// The f-number N.
        number: f32,
        /// Height of the sensor in scene units (0.024 for full frame in metres).
        sensor_height: f32,
    },
}

/// The shape of the opening, within a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opening {
    /// Blades of the aperture; 0 = a circle, else at least 3 corners on that circle.
    pub blades: u32,
    /// Rotation of the blades in degrees, counter-clockwise seen from behind the camera.
    pub blade_rotation: f32,
    /// Height divided by width: 2 gives the upright ovals of anamorphic lenses. Half of the height is the radius of the
    /// circle when this is above 1, half of the width when it is below.
    pub anamorphic: f32,
    /// A picture of the opening in the square around the circle, seen from behind the camera: the brighter, the more light
    /// passes there. In place of blades.
    pub image: Option<Handle<Image>>,
}

impl Default for Opening {
    fn default() -> Self {
        Self { blades: 0, blade_rotation: 0.0, anamorphic: 1.0, image: None }
    }
}

impl Opening {
    /// Half of its width and of its height, in radii.
    pub fn half_size(&self) -> [f32; 2] {
        [(1.0 / self.anamorphic).min(1.0), self.anamorphic.min(1.0)]
    }
}

/// What is sharp through a thin lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Focus {
    /// The plane across the view at this distance along it, in scene units.
    Distance(f32),
    /// The plane through a point, across this direction; both in world space. It must not go through the camera.
    Plane {
        /// A point that is sharp.
        point: Vec3,
        /// Across the plane; of unit length.
        normal: Vec3,
    },
}

/// A thin lens. What is on the plane of focus is sharp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lens {
    /// How wide it is open.
    pub aperture: Aperture,
    /// What is sharp.
    pub focus: Focus,
    /// Shape of the opening.
    pub opening: Opening,
    /// Distance of a second, round opening of the same radius in front of the lens, in radii; 0 = there is none. What it
    /// stops is black: towards the corners the opening looks like the eye of a cat.
    pub cat_eye: f32,
}

impl Lens {
    /// A round opening and a plane of focus across the view.
    pub fn new(aperture: Aperture, focus_distance: f32) -> Self {
        let focus = Focus::Distance(focus_distance);
        Self { aperture, focus, opening: Opening::default(), cat_eye: 0.0 }
    }
}

/// A perspective view through a pinhole or a thin lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Perspective {
    /// Field of view in degrees, in (0, 180).
    pub fov: f32,
    /// The side that `fov` spans.
    pub fov_axis: FovAxis,
    /// The lens; none = a pinhole.
    pub lens: Option<Lens>,
}

/// How far from the middle of a fisheye picture a direction is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FisheyeMapping {
    /// In proportion to the angle from the view, θ.
    Equidistant,
    /// In proportion to sin(θ/2): equal areas are equal solid angles.
    Equisolid,
}

/// How points of the film become rays.
#[derive(Debug, Clone, PartialEq)]
pub enum Projection {
    /// Straight lines stay straight, near things are large.
    Perspective(Perspective),
    /// All rays are parallel.
    Orthographic {
        /// What a side of the picture shows, in scene units.
        size: f32,
        /// The side that `size` spans.
        axis: FovAxis,
    },
    /// All directions: longitude to the right, latitude up. The middle of the picture looks at the target.
    Equirectangular,
    /// A circle of directions about the view; black outside of it.
    Fisheye {
        /// Where directions are.
        mapping: FisheyeMapping,
        /// Angle that the circle spans, in degrees, in (0, 360].
        fov: f32,
        /// The side that the circle spans.
        axis: FovAxis,
    },
    /// Through the elements of a lens. The position of the camera is the middle of the film.
    Lens(Box<LensCamera>),
}

impl Projection {
    /// A pinhole with a vertical field of view in degrees.
    pub fn pinhole(fov: f32) -> Self {
        Self::Perspective(Perspective { fov, fov_axis: FovAxis::Vertical, lens: None })
    }

    /// A thin lens with a vertical field of view in degrees.
    pub fn thin_lens(fov: f32, lens: Lens) -> Self {
        Self::Perspective(Perspective { fov, fov_axis: FovAxis::Vertical, lens: Some(lens) })
    }
}

/// Where a camera stands and looks when the shutter closes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stand {
    /// Position of the camera.
    pub position: Vec3,
    /// Point that it looks at; must differ from `position`.
    pub target: Vec3,
    /// Direction that is up in the picture; must not be parallel to the view.
    pub up: Vec3,
}

/// A camera. In camera space it looks along −z, with x to the right and y up.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// Position of the camera. When the shutter opens, if it moves; so are target and up.
    pub position: Vec3,
    /// Point that the camera looks at; must differ from `position`.
    pub target: Vec3,
    /// Direction that is up in the picture; must not be parallel to the view.
    pub up: Vec3,
    /// Swap left and right, as a left-handed camera space does.
    pub mirrored: bool,
    /// How points of the film become rays.
    pub projection: Projection,
    /// Where it is when the shutter closes; none = it does not move.
    pub at_close: Option<Stand>,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            position: Vec3::new(0.0, 0.0, 5.0),
            target: Vec3::ZERO,
            up: Vec3::Y,
            mirrored: false,
            projection: Projection::pinhole(40.0),
            at_close: None,
        }
    }
}

impl Camera {
    /// The map from camera space to world space: columns right, up, back, position.
    pub fn world_from_camera(&self) -> Affine3A {
        self.world_from(&Stand { position: self.position, target: self.target, up: self.up })
    }

    /// The same map when the shutter closes, if the camera moves.
    pub fn world_from_camera_at_close(&self) -> Option<Affine3A> {
        self.at_close.map(|stand| self.world_from(&stand))
    }

    fn world_from(&self, stand: &Stand) -> Affine3A {
        let back = (stand.position - stand.target).normalize();
        let right = stand.up.cross(back).normalize();
        let up = back.cross(right);
        let right = if self.mirrored { -right } else { right };
        Affine3A::from_cols(right.into(), up.into(), back.into(), stand.position.into())
    }

    /// The thin lens, if it has one.
    pub fn thin_lens(&self) -> Option<Lens> {
        match &self.projection {
            Projection::Perspective(perspective) => perspective.lens,
            _ => None,
        }
    }

    /// The lens of several elements, if it has one.
    pub fn lens_system(&self) -> Option<&LensCamera> {
        match &self.projection {
            Projection::Lens(lens) => Some(lens),
            _ => None,
        }
    }

    /// Width of a pixel at a point in the world, in scene units; `width` and `height` are those of the picture in pixels.
    pub fn pixel_width(&self, point: Vec3, width: u32, height: u32) -> f32 {
        let (rows, aspect) = (height as f32, width as f32 / height as f32);
        let distance = self.position.distance(point);
        match &self.projection {
            Projection::Perspective(view) => distance * 2.0 * view.tan_half_vertical_fov(aspect) / rows,
            Projection::Orthographic { size, axis } => half_height(*axis, *size, aspect) / rows,
            Projection::Equirectangular => distance * std::f32::consts::PI / rows,
            Projection::Fisheye { fov, axis, .. } => {
                distance * half_height(*axis, fov.to_radians(), aspect) / rows
            }
            Projection::Lens(lens) => {
                let sensor_height = lens.sensor_diagonal * lens.unit / (1.0 + aspect * aspect).sqrt();
                let focal_length =
                    lens.paraxial().map_or(sensor_height, |paraxial| paraxial.focal_length as f32);
                distance * sensor_height / (focal_length * rows)
            }
        }
    }

    /// The shape of the opening of the lens, if it has one.
    pub fn opening(&self) -> Option<Opening> {
        self.lens_system().map(|lens| lens.opening).or(self.thin_lens().map(|lens| lens.opening))
    }

    /// The plane of focus of a thin lens where it need not be across the view: n / d of the plane n · p = d, with p measured
    /// from the camera to the right, up and along the view.
    pub fn focus_plane(&self) -> Option<Vec3> {
        let Focus::Plane { point, normal } = self.thin_lens()?.focus else { return None };
        let m = self.world_from_camera().matrix3;
        let across =
            Vec3::new(m.x_axis.dot(normal.into()), m.y_axis.dot(normal.into()), -m.z_axis.dot(normal.into()));
        Some(across / (point - self.position).dot(normal))
    }
}

/// Half of the height of a picture of `aspect` = width / height whose side `axis` has half the length `half`.
pub fn half_height(axis: FovAxis, half: f32, aspect: f32) -> f32 {
    match axis {
        FovAxis::Vertical => half,
        FovAxis::Horizontal => half / aspect,
        FovAxis::Smaller => half / aspect.min(1.0),
    }
}

impl Perspective {
    /// Tangent of half the vertical field of view in a picture of `aspect` = width / height.
    pub fn tan_half_vertical_fov(&self, aspect: f32) -> f32 {
        half_height(self.fov_axis, (0.5 * self.fov.to_radians()).tan(), aspect)
    }

    /// Radius of the lens in scene units; 0 for a pinhole.
    pub fn lens_radius(&self, aspect: f32) -> f32 {
        match self.lens.map(|lens| lens.aperture) {
            None => 0.0,
            Some(Aperture::Radius(radius)) => radius,
            Some(Aperture::FNumber { number, sensor_height }) => {
                sensor_height / (2.0 * self.tan_half_vertical_fov(aspect)) / (2.0 * number)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_along_minus_z_with_x_right() {
        let camera = Camera::default();
        let m = camera.world_from_camera();
        assert_eq!(m.transform_vector3(-Vec3::Z), -Vec3::Z);
        assert_eq!(m.transform_vector3(Vec3::X), Vec3::X);
        assert_eq!(
            Camera { mirrored: true, ..camera }.world_from_camera().transform_vector3(Vec3::X),
            -Vec3::X
        );
    }

    #[test]
    fn field_of_view_spans_the_side_it_names() {
        let view = |fov_axis| Perspective { fov: 90.0, fov_axis, lens: None };
        let close = |a: f32, b: f32| (a - b).abs() < 1e-6;
        assert!(close(view(FovAxis::Vertical).tan_half_vertical_fov(2.0), 1.0));
        assert!(close(view(FovAxis::Horizontal).tan_half_vertical_fov(2.0), 0.5));
        assert!(close(view(FovAxis::Smaller).tan_half_vertical_fov(2.0), 1.0));
        assert!(close(view(FovAxis::Smaller).tan_half_vertical_fov(0.5), 2.0));
    }

    #[test]
    fn f_number_gives_the_radius_of_a_real_lens() {
        // 50 mm on full frame at f/2: the lens is 12.5 mm in radius.
        let fov = 2.0 * (12.0_f32 / 50.0).atan().to_degrees();
        let aperture = Aperture::FNumber { number: 2.0, sensor_height: 0.024 };
        let lens = Some(Lens::new(aperture, 1.0));
        let view = Perspective { fov, fov_axis: FovAxis::Vertical, lens };
        assert!((view.lens_radius(1.5) - 0.0125).abs() < 1e-6);
    }

    #[test]
    fn an_anamorphic_opening_stays_within_the_circle() {
        let half = |anamorphic| Opening { anamorphic, ..Opening::default() }.half_size();
        assert_eq!([half(1.0), half(2.0), half(0.5)], [[1.0, 1.0], [0.5, 1.0], [1.0, 0.5]]);
    }
}
