//! The measurements as a table for people.

use super::{Report, Row};
use std::fmt::Write as _;

/// One column a scene, one line a figure.
pub(super) fn text(report: &Report) -> String {
    let mut out = format!(
        "dapple {} on {} ({}), reads by {}\n\n",
        report.version, report.device, report.driver, report.fetch
    );
    let mut line = |name: &str, value: &dyn Fn(&Row) -> String| {
        _ = write!(out, "{name:<34}");
        for row in &report.rows {
            _ = write!(out, " {:>14}", value(row));
        }
        out.push('\n');
    };
    line("", &|row| row.scene.chars().rev().take(14).collect::<Vec<_>>().into_iter().rev().collect());
    line("triangles", &|row| row.triangles.to_string());
    line("samples a pixel", &|row| row.spp.to_string());
    line("mean radiance", &|row| format!("{:.5}", row.mean_radiance));
    line("Msamples/s", &|row| format!("{:.3}", row.msamples_per_second));
    line("Mray/s camera", &|row| format!("{:.2}", row.camera_mrays_per_second));
    line("Mray/s bounce", &|row| format!("{:.2}", row.bounce_mrays_per_second));
    line("Mray/s shadow", &|row| format!("{:.2}", row.shadow_mrays_per_second));
    let stages: Vec<&str> =
        report.rows.first().map_or(Vec::new(), |row| row.stage_seconds.iter().map(|s| s.0).collect());
    for (i, stage) in stages.iter().enumerate() {
        line(&format!("stage {stage}, s"), &|row| {
            row.stage_seconds.get(i).map_or(String::new(), |s| format!("{:.3}", s.1))
        });
    }
    line("BVH build, Mtriangles/s", &|row| format!("{:.2}", row.bvh_mtriangles_per_second));
    line("BVH SAH cost", &|row| row.bvh_sah_cost.map_or("-".to_owned(), |cost| format!("{cost:.2}")));
    line("kernels, cold caches, s", &|row| format!("{:.3}", row.compile_cold_seconds));
    line("kernels, warm caches, s", &|row| format!("{:.3}", row.compile_warm_seconds));
    line("start to end of first slice, s", &|row| format!("{:.3}", row.first_slice_seconds));
    let mib = |bytes: u64| format!("{:.1}", bytes as f64 / f64::from(1 << 20));
    line("device memory, MiB", &|row| mib(row.device_bytes));
    line("peak memory of the process, MiB", &|row| row.peak_memory_bytes.map_or("unknown".to_owned(), mib));
    out.trim_end().to_owned()
}
