//! Runs a foreign compiler where it can do no harm: deep recursion and panics stay inside.

use std::any::Any;

use crate::{Error, Result};

/// Stack of a thread that compiles. glslang and naga walk expressions by recursion, and a sum of ten thousand
/// terms is a tree ten thousand levels deep. The pages are only reserved until they are touched.
const STACK_BYTES: usize = 256 << 20;

/// Runs `work` on a thread of its own with a large stack. A panic in it becomes an error.
///
/// Catching a panic is an exception in this program: naga panics on some SPIR-V instead of returning an error
/// (`atomicAdd` on a component of a vector is one case), and a kernel under edit must not end the program.
pub(super) fn run<T: Send>(name: &str, work: impl FnOnce() -> T + Send) -> Result<T> {
    std::thread::scope(|scope| {
        std::thread::Builder::new()
            .name(name.to_owned())
            .stack_size(STACK_BYTES)
            .spawn_scoped(scope, work)
            .map_err(|e| Error::device(format!("cannot start a thread for {name}: {e}")))?
            .join()
            .map_err(|panic| Error::device(format!("{name} panicked: {}", text_of(panic.as_ref()))))
    })
}

fn text_of(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a message")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_an_error() {
        assert_eq!(run("test", || 7).unwrap(), 7);
        let error = run("test", || -> () { panic!("number {}", 3) }).unwrap_err();
        assert_eq!(error.to_string(), "test panicked: number 3");
    }
}
