//! Textures that a scene brings as GLSL of its own, and what must be known of such a text.

use glam::Vec3;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// A function of the user's own: `vec4 color(TextureContext context)`.
#[derive(Debug, Clone, PartialEq)]
pub struct GlslTexture {
    /// The text, with `#line` where another file begins.
    pub source: String,
    /// The file that its first line is in.
    pub file: PathBuf,
    /// The number of that line, from 1.
    pub line: u32,
    /// Names that the text may use, and their values.
    pub parameters: Vec<(String, Parameter)>,
    /// Colours are cut off at this and at its negative.
    pub max: f32,
}

/// The value of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Parameter {
    /// A `float`.
    Number(f32),
    /// A `vec3`.
    Color(Vec3),
}

/// The function that gives the value.
pub const ENTRY: &str = "color";

/// Words that a texture has no use for: it only reads.
const REFUSED: &[&str] = &["layout", "buffer", "uniform", "shared", "barrier", "imageStore", "main"];
/// Beginnings of such words.
const REFUSED_STARTS: &[&str] =
    &["store_", "atomic", "imageAtomic", "memoryBarrier", "groupMemoryBarrier", "gl_"];
/// Arrays of the kernels, which look like variables.
const ARRAYS: &[&str] = &["queue", "counters", "film", "parked"];
/// Directives that mean the same in a text that is a part of a kernel.
const DIRECTIVES: &[&str] =
    &["define", "undef", "if", "ifdef", "ifndef", "elif", "else", "endif", "include", "error", ""];

/// A piece of GLSL: a word, a number, a sign, or what lies between.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Token<'a> {
    Word(&'a str),
    Sign(&'a str),
    Other(&'a str),
}

impl<'a> Token<'a> {
    fn text(self) -> &'a str {
        match self {
            Self::Word(text) | Self::Sign(text) | Self::Other(text) => text,
        }
    }
}

/// The tokens of a text. Joined they are the text again.
fn tokens<'a>(text: &'a str) -> Vec<Token<'a>> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let until = |end: Option<usize>| end.unwrap_or(rest.len());
        let while_ = |holds: fn(char) -> bool| until(rest.find(|c| !holds(c)));
        let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let (length, kind): (usize, fn(&'a str) -> Token<'a>) = if rest.starts_with("//") {
            (until(rest.find('\n')), Token::Other)
        } else if let Some(comment) = rest.strip_prefix("/*") {
            (until(comment.find("*/").map(|at| at + 4)), Token::Other)
        } else if c.is_ascii_digit() {
            (while_(|c| c.is_ascii_alphanumeric() || c == '_' || c == '.'), Token::Other)
        } else if word(c) {
            (while_(|c| c.is_ascii_alphanumeric() || c == '_'), Token::Word)
        } else if c.is_whitespace() {
            (while_(char::is_whitespace), Token::Other)
        } else if c == '#' {
            // With the name of the directive; #include and #line name a file
            let name = rest[1..].trim_start_matches([' ', '\t']);
            let start = rest.len() - name.len();
            let length = name.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(name.len());
            let whole = if name.starts_with("include") || name.starts_with("line") {
                until(rest.find('\n'))
            } else {
                start + length
            };
            (whole, Token::Sign)
        } else {
            (c.len_utf8(), Token::Sign)
        };
        let (token, after) = rest.split_at(length);
        tokens.push(kind(token));
        rest = after;
    }
    tokens
}

/// What is wrong with the text of a file: the line, counted from 0, and why.
pub fn problem(text: &str) -> Option<(u32, String)> {
    let mut line = 0;
    let mut open = Vec::new();
    let tokens = tokens(text);
    for (i, token) in tokens.iter().enumerate() {
        match token {
            Token::Word(word) => {
                let index = tokens[i + 1..].iter().find(|next| !matches!(next, Token::Other(_)));
                let array = ARRAYS.contains(word) && index == Some(&Token::Sign("["));
                if array
                    || REFUSED.contains(word)
                    || REFUSED_STARTS.iter().any(|start| word.starts_with(start))
                {
                    return Some((line, format!("`{word}` has no place in a texture, which only reads")));
                }
            }
            Token::Sign(sign) if sign.starts_with('#') => {
                let name = sign[1..].split_whitespace().next().unwrap_or("");
                if !DIRECTIVES.contains(&name) {
                    return Some((line, format!("a texture must not have a line #{name}")));
                }
            }
            Token::Sign("{") => open.push(line),
            Token::Sign("}") if open.pop().is_none() => {
                return Some((line, "`}` closes nothing".to_owned()));
            }
            Token::Other(comment) if comment.starts_with("/*") && !comment.ends_with("*/") => {
                return Some((line, "the comment does not end".to_owned()));
            }
            _ => {}
        }
        line += token.text().matches('\n').count() as u32;
    }
    open.pop().map(|line| (line, "`{` is not closed".to_owned()))
}

/// The names that a text declares at the top: functions, constants, variables, structs and macros.
pub fn declared(text: &str) -> BTreeSet<String> {
    let tokens: Vec<_> = tokens(text).into_iter().filter(|token| !matches!(token, Token::Other(_))).collect();
    let mut names = BTreeSet::new();
    let mut depth = 0_u32;
    for (i, token) in tokens.iter().enumerate() {
        let before = i.checked_sub(1).map(|i| tokens[i]);
        match token {
            Token::Sign("{" | "(" | "[") => depth += 1,
            Token::Sign("}" | ")" | "]") => depth = depth.saturating_sub(1),
            Token::Sign(sign) if sign.starts_with('#') => {
                if let (true, Some(Token::Word(name))) = (sign.ends_with("define"), tokens.get(i + 1)) {
                    names.insert((*name).to_owned());
                }
            }
            Token::Word(word) if depth == 0 => {
                let after = tokens.get(i + 1);
                let typed = matches!(before, Some(Token::Word(_) | Token::Sign("]" | ",")));
                let declares = matches!(after, Some(Token::Sign("(" | "=" | ";" | "," | "[")));
                if before == Some(Token::Word("struct")) || typed && declares {
                    names.insert((*word).to_owned());
                }
            }
            _ => {}
        }
    }
    names
}

/// The text with a prefix before each of some names. Fields of structs, where they are declared and after a dot, stay.
pub fn renamed(text: &str, prefix: &str, names: &BTreeSet<String>) -> String {
    let tokens = tokens(text);
    let mut out = String::with_capacity(text.len() + text.len() / 8);
    let (mut before, mut in_struct) = (None, false);
    for (i, &token) in tokens.iter().enumerate() {
        let after = tokens[i + 1..].iter().find(|next| !matches!(next, Token::Other(_)));
        let declared_field = in_struct && matches!(after, Some(Token::Sign(";" | "," | "[")));
        if let Token::Word(word) = token
            && before != Some(Token::Sign("."))
            && !declared_field
            && names.contains(word)
        {
            out.push_str(prefix);
        }
        out.push_str(token.text());
        if !matches!(token, Token::Other(_)) {
            // A struct has no braces inside
            in_struct = token == Token::Word("struct") || in_struct && token != Token::Sign("}");
            before = Some(token);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// color of lava\n#define HOT2 1.5\nconst float size = 2.0, other = 1e3;\n\
        struct Crust { float size; };\nfloat[2] pair() { float inner = 1.0; return float[2](inner, 2.); }\n\
        /* not(here) */ float crack(vec3 p, float depth) { return p.x * size; }\n\
        vec4 color(TextureContext context)\n{\n    Crust c = Crust(HOT2);\n    \
        return vec4(crack(context . position, 1.0) * c.size);\n}\n";

    #[test]
    fn what_is_declared_at_the_top_is_found() {
        let names = declared(TEXT);
        let expected = ["Crust", "HOT2", "color", "crack", "other", "pair", "size"];
        assert_eq!(names.iter().map(String::as_str).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn names_get_a_prefix_and_fields_do_not() {
        let text = renamed(TEXT, "u0_", &declared(TEXT));
        assert!(
            text.starts_with("// color of lava\n#define u0_HOT2 1.5\nconst float u0_size = 2.0, u0_other")
        );
        assert!(text.contains("return p.x * u0_size;"), "{text}");
        assert!(text.contains("struct u0_Crust { float size; };"), "{text}");
        assert!(text.contains("u0_crack(context . position, 1.0) * c.size"), "{text}");
        assert!(text.contains("/* not(here) */"));
        assert_eq!(text.lines().count(), TEXT.lines().count());
        assert_eq!(renamed("#line 3 \"color\"\nsize", "x_", &declared(TEXT)), "#line 3 \"color\"\nx_size");
        assert_eq!(
            renamed("#include \"a/color.glsl\"\ncolor", "x_", &declared(TEXT)),
            "#include \"a/color.glsl\"\nx_color"
        );
    }

    #[test]
    fn what_a_texture_may_not_do_is_refused_with_its_line() {
        assert_eq!(problem(TEXT), None);
        assert_eq!(problem("float film = 1.0;\nfloat x = film;"), None);
        let line = |text: &str| problem(text).map(|(line, _)| line);
        assert_eq!(line("a\nlayout(binding = 1)"), Some(1));
        assert_eq!(line("a\n\nvoid f() { film [3] = 1u; }"), Some(2));
        assert_eq!(line("void f() { store_values(1u, x); }"), Some(0));
        assert_eq!(line("/*\n*/ # version 450"), Some(1));
        assert_eq!(line("#pragma once"), Some(0));
        assert_eq!(line("f() {\n"), Some(0));
        assert_eq!(line("f() {\n}\n}"), Some(2));
        assert_eq!(line("a\n/* b"), Some(1));
        assert_eq!(line("é€ 1e5 .5 0x1fu"), None);
    }
}
