//! Patterns of the scene of all keys, defaults, and keys that do not go together.

use super::{all, read};
use crate::scene::*;
use glam::{Vec2, Vec3};

const OBJECT: Coordinates = Coordinates::Object;

fn grey(value: f32) -> Value<Vec3> {
    Value::Constant(Vec3::splat(value))
}

/// The one texture of a file.
fn texture(text: &str) -> Texture {
    let (scene, _) = read(&format!("[texture.t]\n{text}")).unwrap_or_else(|error| panic!("{error}"));
    scene.textures.iter().next().unwrap().2.clone()
}

fn refused(text: &str) -> String {
    read(&format!("[texture.t]\n{text}")).unwrap_err().to_string()
}

#[test]
fn patterns_take_every_key() {
    let scene = all();
    let find = |name: &str| scene.textures.iter().find(|(_, other, _)| *other == name).unwrap();
    let of = |name: &str| Value::Texture(find(name).0);
    let space = PatternSpace::new(OBJECT);
    let bent = Warp::By { value: of("wall"), by: of("spots"), amount: 0.25 };
    assert_eq!(*find("bent").2, Texture::Warp(bent));
    let wall = Brick {
        brick: of("toned"),
        mortar: of("lattice"),
        size: Vec2::new(2.0, 0.5),
        joint: 0.0625,
        offset: 0.25,
        variation: 0.75,
        space,
    };
    assert_eq!(*find("wall").2, Texture::Brick(wall));
    let points = vec![(0.0, 0.25), (1.0, 0.5)];
    assert_eq!(*find("toned").2, Texture::Curve { value: of("dimmed"), points, smooth: true });
    let Value::Texture(crags) = of("crags") else { panic!() };
    let dimmed = Texture::Scale { value: of("stone"), factor: Value::Texture(crags) };
    assert_eq!(*find("dimmed").2, dimmed);
    let stone = Veins {
        kind: VeinKind::Marble,
        octaves: 4,
        gain: 0.25,
        lacunarity: 3.0,
        variation: 2.0,
        colors: Spread::Stops(vec![(0.0, Vec3::ZERO), (1.0, Vec3::ONE)]),
        space: PatternSpace { filter_width: 0.0, ..space },
    };
    assert_eq!(*find("stone").2, Texture::Veins(stone));
    let lattice = ValueNoise {
        dimensions: 1,
        length: 8,
        amplitude: 3.0,
        frequency: 7.0,
        octaves: 2,
        low: grey(0.25),
        high: grey(0.5),
        space,
    };
    assert_eq!(*find("lattice").2, Texture::ValueNoise(lattice));
    let spots = Dots { inside: of("bark"), outside: of("rock"), radius: 0.25, space };
    assert_eq!(*find("spots").2, Texture::Dots(spots));
}

#[test]
fn patterns_have_defaults() {
    let space = PatternSpace::new(OBJECT);
    let value = Texture::ValueNoise(ValueNoise {
        dimensions: 3,
        length: 256,
        amplitude: 1.0,
        frequency: 1.0,
        octaves: 1,
        low: grey(0.0),
        high: grey(1.0),
        space,
    });
    assert_eq!(texture("kind = \"value_noise\""), value);
    let dots = Dots { inside: grey(1.0), outside: grey(0.0), radius: 0.35, space };
    assert_eq!(texture("kind = \"dots\""), Texture::Dots(dots));
    let Texture::Noise(windy) = texture("kind = \"windy\"") else { panic!() };
    assert_eq!((windy.sum, windy.octaves, windy.lacunarity), (NoiseSum::Windy, 6, 1.99));
    let Texture::Noise(ridged) = texture("kind = \"ridged\"") else { panic!() };
    assert_eq!((ridged.sum, ridged.normalize), (NoiseSum::Ridged, true));
    let kinds = [("marble", VeinKind::Marble), ("wood", VeinKind::Wood), ("granite", VeinKind::Granite)];
    for (name, kind) in kinds {
        let Texture::Veins(veins) = texture(&format!("kind = \"{name}\"")) else { panic!() };
        assert_eq!((veins.kind, veins.space), (kind, space));
        assert_eq!(matches!(veins.colors, Spread::Spline(_)), kind == VeinKind::Marble);
    }
    let warp = Warp::Noise { value: grey(1.0), amount: 1.0, octaves: 6, gain: 0.5, lacunarity: 2.0, space };
    assert_eq!(texture("kind = \"warp\"\nvalue = 1"), Texture::Warp(warp));
}

#[test]
fn keys_that_do_not_go_together_are_refused() {
    let w = refused("kind = \"noise\"\nw = 1");
    assert!(w.contains("3:5") && w.contains("`w` is for noise in 4 dimensions"), "{w}");
    let pbrt = refused("kind = \"fbm\"\nvariant = \"pbrt\"\ndimensions = 2");
    assert!(pbrt.contains("4:14") && pbrt.contains("must be 3"), "{pbrt}");
    let by = refused("kind = \"warp\"\nvalue = 1\nby = 1\ngain = 0.5");
    assert!(by.contains("5:8") && by.contains("`gain` is of the noise that `by` replaces"), "{by}");
    let edge = refused("kind = \"worley\"\nfeature = \"edge\"\nmetric = \"manhattan\"");
    assert!(edge.contains("4:10") && edge.contains("euclidean"), "{edge}");
    let points = refused("kind = \"curve\"\nvalue = 1\npoints = []");
    assert!(points.contains("from 1 to 64 points"), "{points}");
    let falling = refused("kind = \"curve\"\nvalue = 1\npoints = [[1, 0], [0, 0]]");
    assert!(falling.contains("less than the place before it"), "{falling}");
}
