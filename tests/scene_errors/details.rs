//! What materials do to the surface itself.

use super::check;

#[test]
fn opacity() {
    check(&[
        (
            "[material.m]\nkind = 'diffuse'\nfilter_color = 0.5",
            "3:16: `filter_color` needs `opacity`; add `opacity`",
        ),
        ("[material.m]\nkind = 'diffuse'\nopacity = 2", "3:11: `opacity` is 2, must be from 0 to 1"),
    ]);
}
