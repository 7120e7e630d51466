//! glslang as the rest of the program sees it: includes, places of errors, and what must not crash.

use proptest::prelude::*;

use super::compile::{COMPILER_ID, SPIRV_MAGIC, Until, compile_with};
use super::reflect::VALIDATOR_ID;
use super::{KernelKey, Sources, Spirv, compile};
use crate::{ErrorKind, Result};

const HEAD: &str =
    "layout(local_size_x = 64) in;\nlayout(std430, set = 0, binding = 0) buffer Out { float g_out[]; };\n";

fn compile_files(files: &[(&str, &str)]) -> Result<Spirv> {
    compile(&Sources::from_map(files.iter().copied())?, &KernelKey::new("a.comp"))
}

fn text_of(result: Result<Spirv>) -> String {
    result.map(|spirv| spirv.includes).unwrap_err().to_string()
}

fn kernel(body: &str) -> String {
    format!("{HEAD}void main() {{ {body} }}\n")
}

#[test]
fn the_ids_of_compiler_and_validator_are_the_locked_versions() {
    let lock: toml::Table = include_str!("../../Cargo.lock").parse().unwrap();
    let packages = lock["package"].as_array().unwrap();
    let version = |name: &str| {
        let package = packages.iter().find(|p| p["name"].as_str() == Some(name)).unwrap();
        package["version"].as_str().unwrap()
    };
    let locked = format!("glslang {}, glslang-sys {}", version("glslang"), version("glslang-sys"));
    assert_eq!(COMPILER_ID, locked);
    assert_eq!(VALIDATOR_ID, format!("naga {}", version("naga")));
}

#[test]
fn a_kernel_becomes_spirv_1_3() {
    let spirv = compile_files(&[("a.comp", &kernel("g_out[gl_GlobalInvocationID.x] = 1.0;"))]).unwrap();
    assert_eq!(spirv.words[..2], [SPIRV_MAGIC, 0x0001_0300]);
    assert_eq!(spirv.includes, ["a.comp".to_owned()].into());
}

#[test]
fn includes_are_relative_to_the_root_and_go_in_once() {
    let spirv = compile_files(&[
        (
            "a.comp",
            &format!(
                "#include \"base/b.glsl\"\n#include \"room/c.glsl\"\n{}",
                kernel("g_out[0] = b() + c();")
            ),
        ),
        ("base/b.glsl", "float b() { return 1.0; }\n"),
        ("room/c.glsl", "#include \"base/b.glsl\"\n#include \"a.comp\"\nfloat c() { return b(); }"),
        ("unused.glsl", "nonsense"),
    ])
    .unwrap();
    let names: Vec<_> = spirv.includes.iter().map(String::as_str).collect();
    assert_eq!(names, ["a.comp", "base/b.glsl", "room/c.glsl"]);
}

#[test]
fn an_include_behind_a_condition_goes_in_only_when_the_condition_holds() {
    let a = format!("#if WITH == 1\n#include \"b.glsl\"\n#endif\n{}", kernel("g_out[0] = 1.0;"));
    let sources =
        Sources::from_map([("a.comp", a.as_str()), ("b.glsl", "float b() { return 1.0; }")]).unwrap();
    let count =
        |with: u32| compile(&sources, &KernelKey::new("a.comp").define("WITH", with)).unwrap().includes.len();
    assert_eq!((count(0), count(1)), (1, 2));
}

#[test]
fn lines_count_from_one_in_every_file_and_go_on_after_an_include() {
    let b = "#include \"c.glsl\"\n#include \"c.glsl\"\n\nfloat b() { return in_b; }\n";
    let c = "// two\n// lines\n";
    let a = |body: &str| format!("#include \"b.glsl\"\n\n{}", kernel(body));
    let with =
        |a: &str, b: &str, c: &str| text_of(compile_files(&[("a.comp", a), ("b.glsl", b), ("c.glsl", c)]));
    assert_eq!(with(&a(""), b, c), "b.glsl:4: 'in_b': undeclared identifier");
    assert!(with(&a("g_out[0] = in_a;"), "\n", c).starts_with("a.comp:5: 'in_a': undeclared identifier"));
    assert!(with(&a(""), b, "\n\nint f() { return in_c; }").starts_with("c.glsl:3: 'in_c': undeclared"));
}

#[test]
fn an_error_in_the_generated_file_is_an_error_of_the_scene() {
    let files = [
        ("a.comp", "#include \"generated/textures.glsl\"\nvoid main() {}"),
        ("generated/textures.glsl", "float f() {\n  return wood;\n}"),
    ];
    let error = compile_files(&files).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Scene);
    assert!(
        error.to_string().starts_with("generated/textures.glsl:2: 'wood': undeclared identifier"),
        "{error}"
    );
}

#[test]
fn generated_text_may_name_the_lines_of_the_user() {
    let generated = "float f() {\n#line 12 \"scenes/my wood.glsl\"\n  return wood;\n}";
    let files = [("a.comp", "#include \"g.glsl\"\nvoid main() {}"), ("g.glsl", generated)];
    let error = compile_files(&files).unwrap_err();
    assert!(error.to_string().starts_with("scenes/my wood.glsl:12: 'wood': undeclared"), "{error}");
    assert_eq!(error.kind, ErrorKind::Scene);
}

#[test]
fn an_include_that_fails_names_the_line_and_the_file() {
    let including = |line: &str| {
        let b = format!("\n{line}\n");
        text_of(compile_files(&[("a.comp", "#include \"b.glsl\"\nvoid main() {}"), ("b.glsl", &b)]))
    };
    assert_eq!(
        including("#include \"base/gone.glsl\""),
        "b.glsl:2: cannot include `base/gone.glsl`: there is no shader file `base/gone.glsl`; \
         names are relative to the root of the shader tree"
    );
    assert!(
        including("#include \"../b.glsl\"")
            .starts_with("b.glsl:2: cannot include `../b.glsl`: `../b.glsl` cannot")
    );
    assert!(
        including("#include <b.glsl>")
            .ends_with("is not a file of the shader tree; write #include \"b.glsl\"")
    );
    assert!(including("#include b").starts_with("b.glsl:2: '#include': must be followed by a header name"));
}

#[test]
fn includes_end_at_a_depth() {
    let files: Vec<_> =
        (0..40).map(|n| (format!("{n}.glsl"), format!("#include \"{}.glsl\"\n", n + 1))).collect();
    let mut sources = Sources::from_map(files).unwrap();
    sources.set_virtual("a.comp", "#include \"0.glsl\"\nvoid main() {}").unwrap();
    let error = compile(&sources, &KernelKey::new("a.comp")).unwrap_err();
    assert_eq!(error.to_string(), "31.glsl:1: cannot include `32.glsl`: includes are nested deeper than 32");
}

#[test]
fn version_and_extension_lines_are_refused() {
    let text = text_of(compile_files(&[("a.comp", "\n # version 450\nvoid main() {}")]));
    assert!(text.starts_with("a.comp:2: a shader file must not have a line #version"), "{text}");
}

#[test]
fn functions_that_nothing_calls_are_fine() {
    let a = format!("float unused() {{ return g_out[3]; }}\n{HEAD}", HEAD = "");
    let a = format!("{HEAD}{a}void main() {{ g_out[0] = 1.0; }}");
    compile_files(&[("a.comp", &a)]).unwrap();
}

#[test]
fn warnings_are_errors() {
    let text = text_of(compile_files(&[("a.comp", &kernel("int a__b = 1; g_out[0] = float(a__b);"))]));
    assert!(text.starts_with("a.comp:3: "), "{text}");
}

#[test]
fn a_kernel_without_main_says_so() {
    let text = text_of(compile_files(&[("a.comp", "layout(local_size_x = 64) in;")]));
    assert!(text.starts_with("a.comp: ") && text.contains("entry point"), "{text}");
    let text = text_of(compile_files(&[("b.comp", "")]));
    assert!(text.starts_with("there is no shader file `a.comp`"), "{text}");
}

#[test]
fn other_letters_are_fine_in_comments_and_reported_in_code() {
    compile_files(&[("a.comp", &kernel("g_out[0] = 1.0; // größer €\n"))]).unwrap();
    let text = text_of(compile_files(&[("a.comp", &kernel("float größe = 1.0;"))]));
    assert!(text.starts_with("a.comp:3: "), "{text}");
}

#[test]
fn defines_are_checked() {
    let with = |name: &str, value: &str| {
        let sources = Sources::from_map([("a.comp", kernel("g_out[0] = 1.0;"))]).unwrap();
        compile(&sources, &KernelKey::new("a.comp").define(name, value))
    };
    for (name, value) in [("A", ""), ("A", "1"), ("FETCH(b, i)", "1"), ("_a9", "vec3(1.0, 2.0, 3.0)")] {
        assert_eq!(with(name, value).is_ok(), name != "FETCH(b, i)", "{name}");
    }
    for (name, value) in [("", "1"), ("1a", "1"), ("a b", "1"), ("GL_x", "1"), ("a__b", "1")] {
        assert!(text_of(with(name, value)).contains("name of a macro"), "{name}");
    }
    for value in ["1\n2", "1 /*", "1 // 2", "\\", "\0", "é", "\""] {
        assert!(text_of(with("A", value)).contains("value of macro A"), "{value:?}");
    }
}

#[test]
fn zero_bytes_are_an_error() {
    assert_eq!(
        text_of(compile_files(&[("a.comp", "void\nmain\0")])),
        "a.comp:2: there is a zero byte in the text"
    );
    let included = text_of(compile_files(&[("a.comp", "#include \"b\"\nvoid main() {}"), ("b", "\0")]));
    assert_eq!(included, "b:1: there is a zero byte in the text");
}

#[test]
fn a_sum_of_many_terms_does_not_overflow_the_stack() {
    let sum = |terms: usize| {
        let sum = vec!["x"; terms].join("+");
        compile_files(&[("a.comp", &kernel(&format!("float x = g_out[1];\ng_out[0] = {sum};")))])
    };
    sum(99_000).unwrap();
    assert_eq!(
        text_of(sum(101_000)),
        "a.comp:4: one statement has more than 100000 operators; \
         split it, or give a large table as a buffer or a texture"
    );
}

#[test]
fn threads_compile_the_same_words_at_once() {
    let sources = Sources::from_map([
        ("a.comp", format!("#include \"b.glsl\"\n{}", kernel("g_out[0] = b(g_out[1], N);")).as_str()),
        ("b.glsl", "float b(float x, int n) { for (int i = 0; i < n; i++) x = sin(x) * 3.0; return x; }"),
        ("bad.comp", "void main() { x }"),
    ])
    .unwrap();
    let key = |n: usize| KernelKey::new("a.comp").define("N", n);
    let alone: Vec<_> = (0..8).map(|n| compile(&sources, &key(n)).unwrap()).collect();
    std::thread::scope(|scope| {
        for (n, alone) in alone.iter().enumerate() {
            let (sources, key) = (&sources, &key);
            scope.spawn(move || {
                for _ in 0..20 {
                    assert_eq!(&compile(sources, &key(n)).unwrap(), alone);
                    assert!(
                        text_of(compile(sources, &KernelKey::new("bad.comp"))).starts_with("bad.comp:1: ")
                    );
                }
            });
        }
    });
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn no_text_makes_it_panic(
        words in proptest::collection::vec(
            prop_oneof![
                proptest::sample::select(vec![
                    "#", "define", "A", "A(x)", "#if", "#ifdef A", "#else", "#endif", "#include \"b\"", "#line", "7",
                    "\n", "\n", "(", ")", "{", "}", "[", "]", ";", ",", "+", "=", "\"", "/*", "*/", "//", "\\\n", "void",
                    "main", "float", "x", "const", "in", "layout", "buffer", "struct", "1.0", "0xg", "##", "@", "'", "\r",
                    "vec3", ".xyz", "for", "while", "return", "%", "\0", "é", "#error", "#pragma", "defined", "sampler2D",
                ]).prop_map(str::to_owned),
                "\\PC{0,6}",
            ],
            0..60,
        ),
        separator in proptest::sample::select(vec!["", " "]),
    ) {
        let text = words.join(separator);
        let whole = format!("{HEAD}void main() {{}}\n{text}\n");
        for files in [[("a.comp", text.as_str()), ("b", "float b;")], [("a.comp", "#include \"b\"\n"), ("b", whole.as_str())]] {
            let sources = Sources::from_map(files).unwrap();
            let read = |name: &str| sources.read(name);
            let all = compile_with(&read, &|_| false, &KernelKey::new("a.comp"), Until::TheEnd);
            prop_assert_eq!(all.is_err(), compile_files(&files).is_err());
            if let Err(error) = compile_files(&files) {
                prop_assert!(error.place.is_some(), "{}", error);
                prop_assert!(!error.message.contains("panicked"), "{}", error);
            }
        }
    }
}
