//! The camera: a perspective view through a pinhole or a thin lens.

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

/// A thin lens. Everything on the plane at `focus_distance` along the view axis is sharp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lens {
    /// Opening.
    pub aperture: Aperture,
    /// Distance of the plane of focus from the camera along the view axis, in scene units.
    pub focus_distance: f32,
    /// Blades of the aperture; 0 = a circle, else at least 3 corners on that circle.
    pub blades: u32,
    /// Rotation of the blades in degrees, counter-clockwise seen from behind the camera.
    pub blade_rotation: f32,
}

/// A perspective camera. In camera space it looks along −z, with x to the right and y up.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// Position of the camera.
    pub position: Vec3,
    /// Point that the camera looks at; must differ from `position`.
    pub target: Vec3,
    /// Direction that is up in the picture; must not be parallel to the view.
    pub up: Vec3,
    /// Field of view in degrees, in (0, 180).
    pub fov: f32,
    /// The side that `fov` spans.
    pub fov_axis: FovAxis,
    /// Swap left and right, as a left-handed camera space does.
    pub mirrored: bool,
    /// The lens; none = a pinhole.
    pub lens: Option<Lens>,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            position: Vec3::new(0.0, 0.0, 5.0),
            target: Vec3::ZERO,
            up: Vec3::Y,
            fov: 40.0,
            fov_axis: FovAxis::Vertical,
            mirrored: false,
            lens: None,
        }
    }
}

impl Camera {
    /// The map from camera space to world space: columns right, up, back, position.
    pub fn world_from_camera(&self) -> Affine3A {
        let back = (self.position - self.target).normalize();
        let right = self.up.cross(back).normalize();
        let up = back.cross(right);
        let right = if self.mirrored { -right } else { right };
        Affine3A::from_cols(right.into(), up.into(), back.into(), self.position.into())
    }

    /// Tangent of half the vertical field of view in a picture of `aspect` = width / height.
    pub fn tan_half_vertical_fov(&self, aspect: f32) -> f32 {
        let tan = (0.5 * self.fov.to_radians()).tan();
        match self.fov_axis {
            FovAxis::Vertical => tan,
            FovAxis::Horizontal => tan / aspect,
            FovAxis::Smaller => tan / aspect.min(1.0),
        }
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
        let camera = |fov_axis| Camera { fov: 90.0, fov_axis, ..Camera::default() };
        let close = |a: f32, b: f32| (a - b).abs() < 1e-6;
        assert!(close(camera(FovAxis::Vertical).tan_half_vertical_fov(2.0), 1.0));
        assert!(close(camera(FovAxis::Horizontal).tan_half_vertical_fov(2.0), 0.5));
        assert!(close(camera(FovAxis::Smaller).tan_half_vertical_fov(2.0), 1.0));
        assert!(close(camera(FovAxis::Smaller).tan_half_vertical_fov(0.5), 2.0));
    }

    #[test]
    fn f_number_gives_the_radius_of_a_real_lens() {
        // 50 mm on full frame at f/2: the lens is 12.5 mm in radius.
        let fov = 2.0 * (12.0_f32 / 50.0).atan().to_degrees();
        let aperture = Aperture::FNumber { number: 2.0, sensor_height: 0.024 };
        let lens = Lens { aperture, focus_distance: 1.0, blades: 0, blade_rotation: 0.0 };
        let camera = Camera { fov, lens: Some(lens), ..Camera::default() };
        assert!((camera.lens_radius(1.5) - 0.0125).abs() < 1e-6);
    }
}
