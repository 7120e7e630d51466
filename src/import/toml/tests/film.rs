//! `[film]`: exposure and filters.

use super::{read, read_set};
use crate::scene::{Exposure, Meter, Shot, ToneCurve};

fn exposure(text: &str) -> Exposure {
    read(text).unwrap_or_else(|error| panic!("{error}")).0.film.exposure
}

const LENS: &str = "f_number = 4\nfocus_distance = 1\n";

#[test]
fn the_film_the_camera_or_the_picture_decides() {
    let shot = |iso| Meter::Shot(Shot { shutter: 0.5, iso, f_number: Some(4.0) });
    for (text, meter, stops) in [
        (String::new(), Meter::Fixed, 0.0),
        ("[film]\nexposure = 2".into(), Meter::Fixed, 2.0),
        ("[film]\nexposure = 'auto'".into(), Meter::Auto, 0.0),
        // An f-number alone is one of depth of field
        (format!("[camera]\n{LENS}"), Meter::Fixed, 0.0),
        (format!("[camera]\n{LENS}shutter = 0.5"), shot(100.0), 0.0),
        (format!("[camera]\n{LENS}shutter = 0.5\niso = 800\n[film]\nexposure = 1"), shot(800.0), 1.0),
        (format!("[camera]\n{LENS}shutter = 0.5\n[film]\nexposure = 'auto'"), Meter::Auto, 0.0),
    ] {
        assert_eq!(exposure(&text), Exposure { meter, stops }, "{text}");
    }
    let (scene, _) = read_set("", &[("film.exposure", "auto"), ("film.tone_curve", "aces")]).unwrap();
    assert_eq!((scene.film.exposure.meter, scene.film.tone_curve), (Meter::Auto, ToneCurve::Aces));
}

#[test]
fn a_lens_of_several_elements_has_its_own_f_number() {
    let lens = "[camera]\nkind = 'lens'\nfile = 'a.dat'\nfocus_distance = 3\nshutter = 1\n";
    let f_number = |more: &str| match exposure(&format!("{lens}{more}")).meter {
        Meter::Shot(shot) => shot.f_number,
        other => panic!("{other:?}"),
    };
    assert!((f_number("f_number = 8").unwrap() - 8.0).abs() < 1e-5);
    // Wide open: focal length 50.6757 mm
    assert!((4.0..6.0).contains(&f_number("").unwrap()));
    assert_eq!(f_number("measure = 'irradiance'"), None);
}

#[test]
fn filters_have_radii_of_their_own() {
    let radius = |name: &str| read(&format!("[film]\nfilter = \"{name}\"")).unwrap().0.film.filter.radius;
    let names = ["box", "tent", "gaussian", "blackman_harris", "mitchell", "sinc"];
    assert_eq!(names.map(radius), [0.5, 1.0, 1.5, 1.5, 2.0, 4.0]);
    let error = read("[film]\nfilter = 'sinc'\nfilter_b = 0.5").unwrap_err().to_string();
    assert!(error.contains("3:12: `filter_b` needs `filter = \"mitchell\"`"), "{error}");
}
