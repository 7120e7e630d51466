#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| dapple_fuzz::read("mesh.ply", bytes, dapple::import::read_ply));
