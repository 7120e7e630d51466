//! Which file needs which.

use std::collections::{BTreeMap, BTreeSet};

use super::compile::KernelKey;
use super::include::directive;

/// Which files went into which kernel.
#[derive(Debug, Clone, Default)]
pub(super) struct IncludeGraph {
    files: BTreeMap<KernelKey, BTreeSet<String>>,
}

impl IncludeGraph {
    pub(super) fn record(&mut self, key: &KernelKey, files: BTreeSet<String>) {
        self.files.insert(key.clone(), files);
    }

    pub(super) fn dependents(&self, file: &str) -> Vec<KernelKey> {
        let needs = self.files.iter().filter(|(_, files)| files.contains(file));
        needs.map(|(key, _)| key.clone()).collect()
    }
}

/// The names in the `#include "name"` lines of a text. Lines that a macro, a comment or an `#if` hides are
/// found too: the caller wants at least those that the compiler will find.
pub(super) fn included_names(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| match directive(line)? {
        ("include", rest) => rest.trim_start().strip_prefix('"')?.split_once('"').map(|(name, _)| name),
        _ => None,
    })
}

/// Every file that can be reached from `root` through `#include` lines, with what `read` returned for it.
pub(super) fn reachable<T>(
    root: &str,
    read: impl Fn(&str) -> T,
    text: impl Fn(&T) -> Option<&str>,
) -> BTreeMap<String, T> {
    let mut found = BTreeMap::new();
    let mut open = vec![root.to_owned()];
    while let Some(name) = open.pop() {
        if found.contains_key(&name) {
            continue;
        }
        let file = read(&name);
        open.extend(text(&file).into_iter().flat_map(included_names).map(str::to_owned));
        found.insert(name, file);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn include_lines_are_found() {
        let text = "#include \"a\"\n  # include\t\"b/c.glsl\" // why\n//#include \"d\"\n#include <e>\n#includes\n#include \"f";
        assert_eq!(included_names(text).collect::<Vec<_>>(), ["a", "b/c.glsl"]);
    }

    #[test]
    fn reachable_files_end_with_a_circle() {
        let read = |name: &str| match name {
            "a" => Some("#include \"b\"\n#include \"gone\""),
            "b" => Some("#include \"a\""),
            _ => None,
        };
        let found = reachable("a", read, |text| *text);
        assert_eq!(found.keys().collect::<Vec<_>>(), ["a", "b", "gone"]);
    }

    #[test]
    fn dependents_are_the_kernels_that_a_file_went_into() {
        let mut graph = IncludeGraph::default();
        let files = |names: &[&str]| names.iter().map(|n| (*n).to_owned()).collect();
        graph.record(&KernelKey::new("x.comp"), files(&["x.comp", "a"]));
        graph.record(&KernelKey::new("y.comp"), files(&["y.comp", "a", "b"]));
        assert_eq!(graph.dependents("a"), [KernelKey::new("x.comp"), KernelKey::new("y.comp")]);
        assert_eq!(graph.dependents("b"), [KernelKey::new("y.comp")]);
        assert!(graph.dependents("c").is_empty());
    }
}
