//! Messages, each with file, line, column and the next step.

use super::read;

fn message(text: &str) -> String {
    match read(text) {
        Ok(_) => panic!("{text} is a scene"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn words_that_are_no_scene() {
    for (text, expected) in [
        (
            "\"film\"",
            "scene.pbrt:1:1: \"film\" is where a directive should be; write a directive such as Shape before it",
        ),
        (
            "[",
            "scene.pbrt:1:1: `[` is where a directive should be; write a directive such as Shape before it",
        ),
        ("WorldBegin\n  Shap \"sphere\"", "scene.pbrt:2:3: unknown directive `Shap`; did you mean `Shape`?"),
        ("Film \"rgb", "scene.pbrt:1:6: the string has no end on its line; add a closing \""),
        ("# é\n Film \"rgb\n\"", "scene.pbrt:2:7: the string has no end on its line; add a closing \""),
        ("Film \"a\\b\"", "scene.pbrt:1:8: the string has a backslash; write / in file names"),
        (
            "WorldEnd",
            "scene.pbrt:1:1: unknown directive `WorldEnd`; leave it out: the world ends with the file",
        ),
        (
            "",
            "scene.pbrt: the scene has no WorldBegin; write it after the camera and the film, before what is in the scene",
        ),
        ("WorldBegin WorldBegin", "scene.pbrt:1:12: WorldBegin is there twice; keep one of them"),
        ("Shape \"sphere\"", "scene.pbrt:1:1: Shape is before WorldBegin; write WorldBegin before it"),
        ("WorldBegin\nFilm \"rgb\"", "scene.pbrt:2:1: Film is after WorldBegin; write it before WorldBegin"),
        (
            "WorldBegin AttributeBegin",
            "scene.pbrt:1:12: AttributeBegin has no AttributeEnd; add AttributeEnd",
        ),
        ("WorldBegin AttributeEnd", "scene.pbrt:1:12: AttributeEnd has no AttributeBegin; leave it out"),
        (
            "WorldBegin\nObjectBegin \"a\"\nAttributeEnd",
            "scene.pbrt:3:1: AttributeEnd is inside ObjectBegin of line 2; add ObjectEnd before it",
        ),
    ] {
        assert_eq!(message(text), expected);
    }
}

#[test]
fn parameters_of_wrong_types_names_and_values() {
    let sphere = |parameters: &str| message(&format!("WorldBegin\nShape \"sphere\" {parameters}"));
    for (parameters, expected) in [
        (
            "\"float radios\" 1",
            "2:16: \"float radios\" is no parameter of Shape \"sphere\"; did you mean `radius`?",
        ),
        (
            "\"integer radius\" 1",
            "2:16: \"integer radius\" is no parameter of Shape \"sphere\"; `radius` is of type float",
        ),
        ("\"color radius\" 1", "2:16: unknown type `color` of a parameter; write `rgb`"),
        ("\"flot radius\" 1", "2:16: unknown type `flot` of a parameter; did you mean `float`?"),
        ("\"radius\" 1", "2:16: \"radius\" is no type and name of a parameter; write it as \"float radius\""),
        ("\"float radius\" -1", "2:16: \"float radius\" of Shape \"sphere\" is -1, must be above 0"),
        (
            "\"float radius\" [1 2]",
            "2:16: \"float radius\" of Shape \"sphere\" has 2 values, must have 1; write 1 value",
        ),
        (
            "\"float radius\" x",
            "2:31: `x` is no finite number; write one such as 0.5, -3 or 1e-4, below 3.4e38",
        ),
        (
            "\"float radius\" 1e39",
            "2:31: `1e39` is no finite number; write one such as 0.5, -3 or 1e-4, below 3.4e38",
        ),
        ("\"float radius\" \"1\"", "2:31: \"1\" is no number; write it without quotes"),
        ("\"float radius\" [1", "2:31: the list has no end; add a closing ] before the end of the file"),
        ("\"float radius\"", "2:16: the parameter has no value; add one, or a list in [ ]"),
        ("\"float radius\" 1 \"float radius\" 2", "2:33: \"float radius\" is there twice; keep one of them"),
        ("\"point3 P\" [1 2]", "2:16: \"point3 P\" has 2 numbers, must have 3 for each value"),
        ("\"bool a\" \"true\"", "2:25: \"true\" is no truth value; write true or false without quotes"),
        (
            "\"integer a\" 1.5",
            "2:28: `1.5` is no whole number; write a number from -2147483648 to 2147483647 without a point",
        ),
        ("\"texture alpha\" \"a\"", "2:16: no float texture is named \"a\"; there are no float textures"),
        ("\"rgb Kd\" [1 1 1]", "2:16: \"rgb Kd\" is no parameter of Shape \"sphere\"; write `reflectance`"),
    ] {
        assert_eq!(sphere(parameters), format!("scene.pbrt:{expected}"));
    }
}

#[test]
fn things_that_are_not_known() {
    for (text, expected) in [
        ("Shape \"cone\"", "there is no Shape \"cone\"; write a \"trianglemesh\""),
        ("Shape \"sphre\"", "there is no Shape \"sphre\"; did you mean `sphere`?"),
        ("Material \"matte\"", "there is no Material \"matte\"; write \"diffuse\""),
        ("NamedMaterial \"a\"", "no material is named \"a\"; there are no named materials"),
        (
            "CoordSysTransform \"camra\"",
            "no coordinate system is named \"camra\"; coordinate systems are `world`",
        ),
        ("ObjectInstance \"a\"", "no object is named \"a\"; there are no objects"),
        (
            "Texture \"t\" \"color\" \"fbm\"",
            "the type of texture \"t\" is \"color\"; write \"float\" or \"spectrum\"",
        ),
        (
            "Texture \"t\" \"spectrum\" \"fbm\"",
            "Texture \"t\" of class \"fbm\" is for float textures alone; change its type to \"float\"",
        ),
        (
            "Scale 1 0 1 Shape \"sphere\"",
            "the transform of the sphere cannot be inverted; give every axis a size in Scale and Transform",
        ),
        ("Rotate 1 0 0 0", "the axis of Rotate is the zero vector; write Rotate ANGLE X Y Z"),
        ("LookAt 0 0 0 0 0 1 0 0 1", "the up vector of LookAt is parallel to the view, or zero; turn it"),
        ("Translate 1 2", "Translate has 2 numbers, must have 3; add the rest"),
        (
            "Transform [1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1]",
            "the matrix of Transform is a projection; its fourth, eighth and twelfth numbers must be 0 and its last 1",
        ),
    ] {
        let found = message(&format!("WorldBegin\n{text}"));
        let (place, found) = found.split_once(": ").unwrap();
        assert_eq!(found, expected);
        assert!(place.starts_with("scene.pbrt:2:"), "{place}");
    }
}

#[test]
fn a_mix_of_itself_is_refused() {
    let mix = |name: &str, of: &str| {
        format!(
            "MakeNamedMaterial \"{name}\" \"string type\" \"mix\" \"string materials\" [\"{of}\" \"{of}\"] "
        )
    };
    let error = message(&format!("WorldBegin {} {}", mix("a", "b"), mix("b", "a")));
    assert!(error.contains("is a mix of itself"), "{error}");
}

#[test]
fn what_is_not_supported_is_a_warning_with_its_first_place() {
    let (_, warnings) = read("WorldBegin\nShape \"curve\"\nShape \"curve\" \"float width\" 2").unwrap();
    let [warning] = warnings.as_slice() else { panic!("{warnings:?}") };
    assert_eq!(warning.to_string(), "scene.pbrt:2:1: not supported: Shape \"curve\", 2 times: left out");
    let (_, warnings) = read("WorldBegin\n MediumInterface \"fog\" \"\"").unwrap();
    assert_eq!(warnings[0].to_string(), "scene.pbrt:2:2: not supported: MediumInterface: there is no medium");
}
