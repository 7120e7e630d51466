//! Rays near the axis, at the d line: a lens as a product of matrices.
//!
//! A ray is its height and slope (y, u) where it crosses a plane across the axis. A boundary of radius R and media n, n′ takes
//! u to (n u − y (n′ − n) / R) / n′, a distance t takes y to y + t u (Hecht, Optics, section 6.2). Lengths are in millimetres.

use super::{LensSystem, Stop};
use crate::{Error, Result};

/// Takes (y, u) to (a y + b u, c y + d u).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Matrix {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
}

impl Matrix {
    const IDENTITY: Self = Self { a: 1.0, b: 0.0, c: 0.0, d: 1.0 };

    /// A boundary from a medium of index `before` to one of index `behind`.
    fn boundary(radius: f64, before: f64, behind: f64) -> Self {
        let bend = if radius == 0.0 { 0.0 } else { (before - behind) / (radius * behind) };
        Self { a: 1.0, b: 0.0, c: bend, d: before / behind }
    }

    fn distance(length: f64) -> Self {
        Self { b: length, ..Self::IDENTITY }
    }

    /// This, and then `next`.
    fn then(self, next: Self) -> Self {
        Self {
            a: next.a * self.a + next.b * self.c,
            b: next.a * self.b + next.b * self.d,
            c: next.c * self.a + next.d * self.c,
            d: next.c * self.b + next.d * self.d,
        }
    }
}

/// An image of the stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pupil {
    /// Where it is on the axis, positive towards the film: the entrance pupil from the first vertex, the exit pupil from the last.
    pub position: f64,
    /// Its diameter.
    pub diameter: f64,
}

/// What a lens does to rays near its axis. Lengths are in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paraxial {
    /// Focal length.
    pub focal_length: f64,
    /// From the last vertex to the focus of light from infinity.
    pub back_focal_distance: f64,
    /// The front principal plane, from the first vertex towards the film.
    pub front_principal: f64,
    /// The rear principal plane, from the last vertex towards the film.
    pub rear_principal: f64,
    /// From the first vertex to the last.
    pub length: f64,
    /// The stop.
    pub stop: Stop,
    /// Diameter of the stop.
    pub stop_diameter: f64,
    /// From the first vertex to the stop, and from the stop to the last vertex.
    to_stop: Matrix,
    from_stop: Matrix,
    stop_index: f64,
}

impl Paraxial {
    /// The wide open lens.
    ///
    /// # Errors
    /// A lens that does not gather light.
    pub fn of(system: &LensSystem) -> Result<Self> {
        let whole = system_matrix(system, 0..system.interfaces.len());
        let focal_length = -1.0 / whole.c;
        if !(focal_length > 0.0 && focal_length.is_finite()) {
            let message = match whole.c > 0.0 {
                true => format!("the lens spreads light: its focal length is {focal_length:.4} mm"),
                false => "the lens has no focal length".to_owned(),
            };
            return Err(Error::scene(message).help("check the signs of the radii, and the order of the rows"));
        }
        let stop = stop_of(system);
        let interface = system.interfaces[stop.interface];
        Ok(Self {
            focal_length,
            back_focal_distance: -whole.a / whole.c,
            front_principal: (whole.d - 1.0) / whole.c,
            rear_principal: (1.0 - whole.a) / whole.c,
            length: system.length(),
            stop,
            stop_diameter: interface.aperture,
            to_stop: system_matrix(system, 0..stop.interface),
            from_stop: system_matrix(system, stop.interface..system.interfaces.len()),
            stop_index: system.index_before(stop.interface),
        })
    }

    /// Makes the stop smaller or larger.
    pub fn stop_down(&mut self, diameter: f64) {
        self.stop_diameter = diameter;
    }

    /// Diameter of the stop that gives an f-number.
    pub fn stop_for(&self, f_number: f64) -> f64 {
        self.stop_diameter * (self.f_number() / f_number)
    }

    /// Focal length divided by the diameter of the entrance pupil.
    pub fn f_number(&self) -> f64 {
        self.focal_length / self.entrance_pupil().diameter
    }

    /// The stop as it is seen from the front.
    pub fn entrance_pupil(&self) -> Pupil {
        let Matrix { a, b, .. } = self.to_stop;
        Pupil { position: b / a, diameter: self.stop_diameter / a.abs() }
    }

    /// The stop as it is seen from the film.
    pub fn exit_pupil(&self) -> Pupil {
        let Matrix { b, d, .. } = self.from_stop;
        Pupil { position: -b / d, diameter: self.stop_diameter * self.stop_index / d.abs() }
    }

    /// Tangent of the angle at the axis under which the radius of the exit pupil is seen from a film at a distance behind the
    /// last vertex. Finite also where the pupil is at infinity.
    pub fn tan_image_angle(&self, film_distance: f64) -> f64 {
        let Matrix { b, d, .. } = self.from_stop;
        (0.5 * self.stop_diameter * self.stop_index / (b + film_distance * d)).abs()
    }

    /// Distance from the last vertex to the film that focuses on a plane so far in front of the film. Between the principal
    /// planes the distances s and s′ to object and image have a known sum, and 1/s + 1/s′ = 1/f. None where there is no such place.
    pub fn focus(&self, from_film: f64) -> Option<f64> {
        let sum = from_film - self.length + self.front_principal - self.rear_principal;
        let root = (1.0 - 4.0 * self.focal_length / sum).sqrt();
        let film = 2.0 * self.focal_length / (1.0 + root) + self.rear_principal;
        let object_in_front = from_film - self.length - film;
        (sum > 0.0 && root >= 0.0 && film > 0.0 && object_in_front > 0.0).then_some(film)
    }

    /// The least distance from the film that [`Self::focus`] takes, as far as the focal length decides it.
    pub fn nearest_focus(&self) -> f64 {
        4.0 * self.focal_length + self.length - self.front_principal + self.rear_principal
    }
}

/// From the vertex of the first interface of a range, before it, to the last vertex of the lens or to the vertex of the next.
fn system_matrix(system: &LensSystem, range: std::ops::Range<usize>) -> Matrix {
    let last = system.interfaces.len() - 1;
    range.fold(Matrix::IDENTITY, |matrix, i| {
        let interface = system.interfaces[i];
        let boundary = Matrix::boundary(interface.radius, system.index_before(i), interface.index);
        let there = matrix.then(boundary);
        if i == last { there } else { there.then(Matrix::distance(interface.thickness)) }
    })
}

/// The stop that the file names, or the rim that a beam along the axis meets first when it grows.
fn stop_of(system: &LensSystem) -> Stop {
    if let Some(interface) = system.stops().next() {
        return Stop { interface, named: true };
    }
    let room = |i: usize| system.interfaces[i].aperture / system_matrix(system, 0..i).a.abs();
    let interface = (0..system.interfaces.len()).min_by(|&a, &b| room(a).total_cmp(&room(b))).unwrap_or(0);
    Stop { interface, named: false }
}

#[cfg(test)]
mod tests {
    use super::super::LensInterface;
    use super::*;

    fn singlet(front: f64, rear: f64, thickness: f64, index: f64) -> LensSystem {
        let interface =
            |radius, index| LensInterface { radius, thickness, index, abbe: None, aperture: 10.0 };
        LensSystem { notes: Vec::new(), interfaces: vec![interface(front, index), interface(rear, 1.0)] }
    }

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-12 * b.abs().max(1.0), "{a}, expected {b}");
    }

    #[test]
    fn a_thick_lens_obeys_the_formula_of_lensmakers() {
        for (front, rear, d, n) in
            [(50.0, -80.0, 8.0, 1.5), (30.0, 60.0, 5.0, 1.7), (-90.0, -25.0, 12.0, 1.62)]
        {
            let lens = Paraxial::of(&singlet(front, rear, d, n)).unwrap();
            let power = (n - 1.0) * (1.0 / front - 1.0 / rear + (n - 1.0) * d / (n * front * rear));
            close(lens.focal_length, 1.0 / power);
            // Principal planes (Hecht, section 6.1): h1 = −f (n − 1) d / (n R2), h2 = −f (n − 1) d / (n R1)
            close(lens.front_principal, -(n - 1.0) * d / (power * n * rear));
            close(lens.rear_principal, -(n - 1.0) * d / (power * n * front));
            close(lens.back_focal_distance, lens.focal_length + lens.rear_principal);
        }
        assert!(Paraxial::of(&singlet(-50.0, 50.0, 2.0, 1.5)).unwrap_err().message.contains("spreads"));
        assert!(Paraxial::of(&singlet(0.0, 0.0, 2.0, 1.5)).unwrap_err().message.contains("no focal length"));
    }

    #[test]
    fn focus_keeps_the_law_of_a_thin_lens_between_the_principal_planes() {
        let lens = Paraxial::of(&singlet(50.0, -80.0, 8.0, 1.5)).unwrap();
        for distance in [300.0, 1e3, 1e6] {
            let film = lens.focus(distance).unwrap();
            let image = film - lens.rear_principal;
            let object = distance - lens.length - film + lens.front_principal;
            close(1.0 / object + 1.0 / image, 1.0 / lens.focal_length);
        }
        assert_eq!(lens.focus(0.99 * lens.nearest_focus()), None);
        assert!(lens.focus(1.01 * lens.nearest_focus()).is_some());
    }

    #[test]
    fn pupils_of_a_stop_in_front_and_behind() {
        let thin = singlet(50.0, -50.0, 0.0, 1.5);
        let stop = LensInterface { radius: 0.0, thickness: 20.0, index: 1.0, abbe: None, aperture: 4.0 };
        let mut front = thin.clone();
        front.interfaces.insert(0, stop);
        let front = Paraxial::of(&front).unwrap();
        assert_eq!((front.stop.interface, front.stop.named), (0, true));
        assert_eq!(front.entrance_pupil(), Pupil { position: 0.0, diameter: 4.0 });
        // 20 mm in front of a lens of f = 50 mm: the image is at 1 / (1/50 − 1/20) = −33.33 mm, 5/3 as large
        close(front.exit_pupil().position, -100.0 / 3.0);
        close(front.exit_pupil().diameter, 20.0 / 3.0);
        close(front.f_number(), 12.5);
        close(front.tan_image_angle(50.0), (10.0 / 3.0) / (50.0 + 100.0 / 3.0));
        close(front.stop_for(25.0), 2.0);
        let open = Paraxial::of(&thin).unwrap();
        assert!(!open.stop.named);
        close(open.f_number(), 5.0);
    }
}
