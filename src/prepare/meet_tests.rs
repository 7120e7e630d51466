//! Lines meet patches and parts of quadrics where they were aimed.

use super::*;
use crate::scene::Quadric;
use glam::Vec3;
use proptest::prelude::*;

fn point() -> impl Strategy<Value = Vec3> {
    [-2.0_f32..2.0, -2.0_f32..2.0, -2.0_f32..2.0].prop_map(Vec3::from)
}

fn nearest(kind: &ShapeKind, o: DVec3, d: DVec3) -> f64 {
    meet(kind, o, d).iter().map(|meeting| (meeting.t - 1.0).abs()).fold(f64::INFINITY, f64::min)
}

proptest! {
    #[test]
    fn a_line_to_a_point_of_a_patch_meets_it_there(
        corners in [point(), point(), point(), point()],
        u in 0.001_f64..0.999,
        v in 0.001_f64..0.999,
        from in point(),
    ) {
        let [a, b, c, d] = corners.map(|corner| corner.as_dvec3());
        let p = a.lerp(b, u).lerp(c.lerp(d, u), v);
        let normal = (b - a).lerp(d - c, v).cross((c - a).lerp(d - b, u));
        let along = p - from.as_dvec3();
        // Not along the surface, where two meetings become one
        prop_assume!(normal.dot(along).abs() > 0.05 * normal.length() * along.length() && normal.length() > 0.05);
        let off = nearest(&ShapeKind::Patch(Patch::new(corners)), from.as_dvec3(), along);
        prop_assert!(off < 1e-6, "{off}");
    }

    #[test]
    fn a_line_to_a_point_of_a_tube_meets_it_there(z in 0.0_f64..1.0, turn in 0.0_f64..1.0, from in point()) {
        let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
        let p = DVec3::new(cos, sin, z);
        let along = p - from.as_dvec3();
        prop_assume!(along.truncate().dot(p.truncate()).abs() > 0.05);
        let quadric = Quadric {
            extent: Extent::Cylinder { z_min: -1.0, z_max: 3.0 },
            center: Vec3::ZERO,
            radius: 2.0,
            axis: Vec3::Y,
            meridian: Vec3::X,
            phi_max: 240.0,
        };
        let off = nearest(&ShapeKind::Quadric(quadric), from.as_dvec3(), along);
        let there = turn < 240.0 / 360.0;
        // It may meet another part of it elsewhere, but not there
        prop_assert!(if (turn - 240.0 / 360.0).abs() < 1e-6 { true } else { (off < 1e-6) == there }, "{off} {there}");
    }
}
