#![no_main]

// JSON and binary files have extensions of their own.
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let name = if bytes.starts_with(b"glTF") { "model.glb" } else { "model.gltf" };
    dapple_fuzz::scene(name, bytes);
});
