//! Nothing is left behind by edits.

use super::{Room, gpu};
use dapple::render::Next;
use dapple::shader::CacheOptions;

#[test]
fn a_thousand_edits_of_a_kernel_leave_as_many_objects_as_one() {
    let room = Room::new();
    room.edit("scene.toml", "size = [16, 12]", "size = [8, 8]");
    let gpu = gpu();
    let nothing = gpu.alive();
    // Without a disk cache: each good edit is compiled
    let mut studio = room.studio(&gpu, CacheOptions::Off);
    let mut shown = studio.generation().unwrap();
    let alive = gpu.alive();
    assert_eq!(alive.modules, 0);
    let kernel = room.path("shaders/stages/advance.comp");
    let text = std::fs::read_to_string(&kernel).unwrap();
    for edit in 0..1000 {
        let good = edit % 2 == 0;
        // A number in the code, so that the driver cannot take it for what it has
        let change =
            if good { format!("if (gl_WorkGroupID.y == {}u) return;\n", edit + 9) } else { "no".to_owned() };
        std::fs::write(&kernel, text.replacen("void main()\n{\n", &format!("void main()\n{{\n{change}"), 1))
            .unwrap();
        match studio.generation() {
            Ok(generation) => {
                assert!(good);
                assert_eq!(generation.opened.kernels, 1);
                shown = generation;
            }
            Err(error) => assert!(!good, "{error}"),
        }
        assert_eq!(gpu.alive(), alive, "after edit {edit}");
    }
    assert_eq!(shown.number, 501);
    shown.renderer.render(0, 1, &mut |_| Next::Continue).unwrap();
    assert_eq!(gpu.alive(), alive);
    drop((shown, studio));
    assert_eq!(gpu.alive(), nothing);
}
