//! The command line: what the user typed ([`args`]) → the checked job ([`job`]) → the library.
//!
//! Results go to stdout, words about them to stderr. Exit codes: 0 done, 1 the work failed, 2 bad usage or scene,
//! 130 a second Ctrl-C.

mod args;
mod bake;
mod bench;
mod check;
mod console;
mod convert;
mod devices;
mod diff;
mod display;
mod event;
mod job;
mod lens;
mod live;
mod parse;
mod pixel;
mod render;
mod repeat;
mod report;
mod stop;
mod version;

use args::{Args, Command};
use clap::{CommandFactory, Parser};
use console::Console;
use dapple::{Error, ErrorKind};
use std::process::ExitCode;

/// What a command failed with.
struct Failure {
    error: Error,
    /// The command that shows the failure again, when there is a shorter one than the user's.
    repeat: Option<String>,
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self { error, repeat: None }
    }
}

/// Reads the arguments, does what they say, and tells how it went.
pub fn run() -> ExitCode {
    let args = Args::parse();
    let (mut console, outcome) = match args.command {
        _ if args.version => with(Console::new(false, false), |c| Ok(version::run(c)?)),
        Some(Command::Render(args)) => with(Console::new(args.json, args.quiet), |c| render::run(&args, c)),
        Some(Command::Live(args)) => with(Console::new(args.json, false), |c| Ok(live::run(&args, c)?)),
        Some(Command::Devices(args)) => {
            with(Console::new(args.json, false), |c| Ok(devices::run(args.json, c)?))
        }
        Some(Command::Check(args)) => with(Console::new(args.json, false), |c| Ok(check::run(&args, c)?)),
        Some(Command::Convert(args)) => {
            with(Console::new(args.json, args.quiet), |c| Ok(convert::run(&args, c)?))
        }
        Some(Command::Bench(args)) => with(Console::new(args.json, false), |c| Ok(bench::run(&args, c)?)),
        Some(Command::Bake(args)) => with(Console::new(args.json, args.quiet), |c| Ok(bake::run(&args, c)?)),
        Some(Command::Diff(args)) => with(Console::new(args.json, false), |c| Ok(diff::run(&args, c)?)),
        Some(Command::Lens(args)) => with(Console::new(args.json, false), |c| Ok(lens::run(&args, c)?)),
        None => {
            console::say(&Args::command().render_help().to_string());
            return ExitCode::from(USAGE);
        }
    };
    match outcome.and_then(|()| Ok(console.finish()?)).and_then(|()| Ok(nothing_late()?)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            let code = exit_code(&failure.error);
            report::print(&failure, &mut console);
            code
        }
    }
}

/// An error when the validation layer had something to say after all work was done.
fn nothing_late() -> Result<(), Error> {
    match dapple::gpu::late_messages() {
        0 => Ok(()),
        n => Err(Error::device(format!("{n} messages of the validation layer came after the work was done"))
            .help("they are printed above")),
    }
}

/// Exit code of wrong arguments, and of wrong scenes.
const USAGE: u8 = 2;

/// How the message about a `--device` begins that no device has: the argument is wrong, not the machine.
const UNKNOWN_DEVICE: &str = "no device `";

fn exit_code(error: &Error) -> ExitCode {
    match error.kind {
        ErrorKind::Device if error.message.starts_with(UNKNOWN_DEVICE) => ExitCode::from(USAGE),
        ErrorKind::Scene => ExitCode::from(USAGE),
        ErrorKind::Device | ErrorKind::Output => ExitCode::from(1),
    }
}

/// Runs a command with its console and keeps both ends.
fn with(
    mut console: Console,
    command: impl FnOnce(&mut Console) -> Result<(), Failure>,
) -> (Console, Result<(), Failure>) {
    let outcome = command(&mut console);
    (console, outcome)
}
