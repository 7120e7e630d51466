//! Two pictures of one scene: how far they are apart, and whether noise explains it.

mod flip;
mod panel;
mod picture;
mod statistic;
mod student;

pub use flip::{ErrorMap, flip};
pub use panel::write_panel;
pub use picture::{Estimate, Reading, read, read_variance};
pub use statistic::{Measured, Verdict, compare, relative_mse};
pub use student::{critical_value, level_of_each, two_sided_tail};
