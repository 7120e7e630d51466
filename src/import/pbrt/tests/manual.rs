//! `scenes/pbrt.md` has the table of what is not supported, row by row.

use super::super::unsupported::Unsupported;

const MANUAL: &str = include_str!("../../../../scenes/pbrt.md");

#[test]
fn the_manual_lists_what_is_not_supported_and_nothing_else() {
    let rows = Unsupported::ALL.iter().map(|one| format!("| `{}` | {} |", one.written(), one.instead()));
    let mut wanted: Vec<_> = rows.collect();
    let start = MANUAL.find("\n## What is not supported\n").unwrap();
    let table = MANUAL[start..].lines().filter(|line| line.starts_with("| `"));
    let mut found: Vec<_> = table.map(str::to_owned).collect();
    wanted.sort();
    found.sort();
    assert_eq!(wanted, found, "write scenes/pbrt.md anew");
}
