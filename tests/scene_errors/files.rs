//! Several files, `--set`, and deep nesting.

use super::{MATERIAL, message};

#[test]
fn includes() {
    let cases: [(&[(&'static str, &str)], &str); 4] = [
        (
            &[("scene.toml", "\n include = ['a.toml', 'missing.toml']"), ("a.toml", "")],
            "scene.toml:2:23: there is no file missing.toml",
        ),
        (
            &[("scene.toml", "include = ['d/a.toml']"), ("d/a.toml", "include = ['../scene.toml']")],
            "d/a.toml:1:12: the files include one another: scene.toml → d/a.toml → d/../scene.toml",
        ),
        (
            &[("scene.toml", "include = ['d/a.toml']"), ("d/a.toml", "[film]\nsise = 1")],
            "d/a.toml:2:1: unknown key `sise` in [film]; did you mean `size`?",
        ),
        (
            &[("scene.toml", "include = ['a.toml']\n[material.red]\nkind = 'diffuse'"), ("a.toml", MATERIAL)],
            "scene.toml:2:11: material `red` is there twice, first at a.toml:1:11; rename one of them",
        ),
    ];
    for (files, expected) in cases {
        let files: Vec<_> = files.iter().map(|(name, text)| (*name, text.to_string())).collect();
        assert_eq!(message(&files, &[]), expected);
    }
    let names: Vec<&'static str> = (0..17).map(|i| &*format!("{i}.toml").leak()).collect();
    let mut files: Vec<_> = (0..16).map(|i| (names[i], format!("include = ['{}']", names[i + 1]))).collect();
    files.push(("scene.toml", "include = ['0.toml']".into()));
    let chain = "scene.toml → 0.toml → 1.toml → 2.toml → 3.toml → 4.toml → 5.toml → 6.toml → 7.toml → 8.toml → \
                 9.toml → 10.toml → 11.toml → 12.toml → 13.toml → 14.toml → 15.toml";
    let expected = format!("14.toml:1:12: the files include one another more than 16 deep: {chain}");
    assert_eq!(message(&files, &[]), expected);
}

#[test]
fn settings() {
    let scene =
        || ("scene.toml", format!("{MATERIAL}[[shape]]\nkind = 'sphere'\nradius = 1\nmaterial = 'red'"));
    let cases = [
        ("render.sp", "3", "--set render.sp=3: unknown key `sp` in [render]; did you mean `spp`?"),
        ("render.spp", "many", "--set render.spp=many: `spp` must be a whole number, found a string"),
        ("render.spp", "[1", "--set render.spp=[1: unclosed array, expected `]`"),
        (
            "render",
            "3",
            "--set render=3: `render` as a whole cannot be set; name a key in it, such as render.KEY",
        ),
        (
            "rendr.spp",
            "3",
            "--set rendr.spp=3: unknown key `rendr` at the top of the scene; did you mean `render`?",
        ),
        (
            "spp",
            "3",
            "--set spp=3: unknown key `spp` at the top of the scene; its keys are `include`, `film`, `render`, `camera`, `texture`, `material`, `mesh`, `shape`, `instance`, `light`, `environment`",
        ),
        ("", "3", "--set =3: `` is no key; write names with dots between them, such as render.spp"),
        (
            "render..spp",
            "3",
            "--set render..spp=3: `render..spp` is no key; write names with dots between them, such as render.spp",
        ),
        (
            "render.spp = 3\nx",
            "3",
            "--set render.spp = 3\\nx=3: `render.spp = 3\\nx` is no key; write names with dots between them, such as render.spp",
        ),
        ("include", "['a']", "--set include=['a']: `include` cannot be set"),
        (
            "material.rad.color",
            "1",
            "--set material.rad.color=1: no material is named `rad`; did you mean `red`?",
        ),
        (
            "material.red",
            "1",
            "--set material.red=1: `material.red` as a whole cannot be set; name a key in it, such as material.red.KEY",
        ),
        (
            "material.red.color.x",
            "1",
            "--set material.red.color.x=1: unknown key `x` in `color`; its keys are `texture`",
        ),
        ("material.red.kind.x", "1", "--set material.red.kind.x=1: there is no `x` in a string"),
        ("mesh.a.file", "a", "--set mesh.a.file=a: the scene has no mesh; add a mesh to the scene file"),
        (
            "shape.0.radius",
            "1",
            "--set shape.0.radius=1: there is no shape 0; the scene has 1, counted from 1",
        ),
        (
            "shape.2.radius",
            "1",
            "--set shape.2.radius=1: there is no shape 2; the scene has 1, counted from 1",
        ),
        ("shape.1.radius", "-1", "--set shape.1.radius=-1: `radius` is -1, must be above 0"),
        (
            "light.1.radius",
            "-1",
            "--set light.1.radius=-1: the scene has no light; add a light to the scene file",
        ),
    ];
    let mut wrong = String::new();
    for (key, value, expected) in cases {
        let found = message(&[scene()], &[(key, value)]);
        if found != expected {
            wrong += &format!("\n{key}={value}\n  expected {expected}\n  found    {found}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn deep_nesting_is_an_error() {
    let path = vec!["a"; 79].join(".");
    let tables = format!("a = {}1{}", format!("{{ {path} = ").repeat(78), "}".repeat(78));
    for text in ["[".repeat(100_000), format!("{} = 1", vec!["a"; 100_000].join(".")), tables] {
        let found = message(&[("scene.toml", text)], &[]);
        assert!(found.starts_with("scene.toml:1:"), "{found}");
    }
}
