//! The files of the page, as they are in the program.

use include_dir::{Dir, include_dir};

static PAGE: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/src/live/serve/page");

/// A file by its name, with its type. Nothing is looked for on the disk.
pub(super) fn file(name: &str) -> Option<(&'static str, &'static [u8])> {
    let name = if name.is_empty() { "page.html" } else { name };
    let file = PAGE.get_file(name)?;
    let kind = match name.rsplit_once('.')?.1 {
        "html" => "text/html; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "svg" => "image/svg+xml",
        _ => return None,
    };
    Some((kind, file.contents()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_by_their_names_alone() {
        assert!(file("").is_some_and(|(kind, text)| kind.starts_with("text/html") && !text.is_empty()));
        assert_eq!(file(""), file("page.html"));
        for name in [
            "../page.rs",
            "page/../page.html",
            "/etc/passwd",
            "Cargo.toml",
            "..",
            "page.html/",
            "./page.html",
        ] {
            assert!(file(name).is_none(), "{name}");
        }
    }

    #[test]
    fn the_page_needs_nothing_from_elsewhere() {
        for entry in PAGE.files() {
            let text = entry.contents_utf8().unwrap();
            for address in ["http://", "https://", "//cdn"] {
                // The names of XML namespaces are no addresses
                let found = text.lines().find(|line| line.contains(address) && !line.contains("www.w3.org"));
                assert_eq!(found, None, "{}", entry.path().display());
            }
        }
    }
}
