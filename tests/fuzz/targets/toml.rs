#![no_main]

/// Most levels of a subdivision that are tried: a scene may ask for millions of triangles, which takes seconds and is no find.
const MOST_LEVELS: u32 = 5;

fn levels(text: &str) -> impl Iterator<Item = u32> {
    text.split("levels").skip(1).filter_map(|rest| {
        let digits = rest.trim_start_matches(['"', '\'', ' ', '\t', '=', '+', '0', '_', 'x', 'o', 'b']);
        let end = digits.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(digits.len());
        u32::from_str_radix(&digits[..end], 16).ok()
    })
}

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    if !levels(&String::from_utf8_lossy(bytes)).any(|levels| levels > MOST_LEVELS) {
        dapple_fuzz::scene("scene.toml", bytes);
    }
});
