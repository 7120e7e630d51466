#![no_main]

// The format is told by the content: PNG, JPEG, WebP, HDR and EXR are all here.
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| dapple_fuzz::read("picture", bytes, dapple::import::read_image));
