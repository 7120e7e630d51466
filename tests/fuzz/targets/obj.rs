#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| dapple_fuzz::read("mesh.obj", bytes, dapple::import::read_obj));
