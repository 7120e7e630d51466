//! What the program says while it works: words and a bar for people, events for programs, or nothing.

use dapple::{Error, Result};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;
use std::io::{self, ErrorKind, Write};
use std::time::Duration;

/// How a command speaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Voice {
    Words,
    Events,
    Quiet,
}

/// Both output streams. A reader that goes away is no error; a full disk is one, told at the end.
pub struct Console {
    voice: Voice,
    bar: ProgressBar,
    failed: Option<io::Error>,
}

/// How far a render is.
pub struct Step {
    /// Samples a pixel that are done.
    pub spp: u32,
    /// Samples a pixel that were asked for.
    pub of: u32,
    /// Share that is done, 0..=1.
    pub done: f64,
    /// Samples a second.
    pub rate: f64,
    /// Time left, when it can be told.
    pub left: Option<Duration>,
    /// Whether the render ends at the next whole pass.
    pub stopping: bool,
}

const BAR_STEPS: u64 = 1000;

impl Console {
    pub fn new(json: bool, quiet: bool) -> Self {
        let voice = match (json, quiet) {
            (true, _) => Voice::Events,
            (_, true) => Voice::Quiet,
            _ => Voice::Words,
        };
        Self { voice, bar: ProgressBar::hidden(), failed: None }
    }

    /// Whether events are asked for.
    pub fn json(&self) -> bool {
        self.voice == Voice::Events
    }

    /// A result, on stdout in every voice.
    pub fn result(&mut self, text: &str) {
        let mut out = io::stdout().lock();
        let written = writeln!(out, "{text}").and_then(|()| out.flush());
        if let Err(error) = written
            && error.kind() != ErrorKind::BrokenPipe
        {
            self.failed.get_or_insert(error);
        }
    }

    /// An event, on stdout, for those who asked for events.
    pub fn event(&mut self, event: &impl Serialize) {
        if !self.json() {
            return;
        }
        match serde_json::to_string(event) {
            Ok(line) => self.result(&line),
            Err(error) => _ = self.failed.get_or_insert(io::Error::from(error)),
        }
    }

    /// A line on stderr, unless all should be quiet.
    pub fn note(&self, text: &str) {
        if self.voice != Voice::Quiet {
            self.bar.suspend(|| say(text));
        }
    }

    /// Moves the bar, which is there when stderr is a terminal and people are spoken to.
    pub fn bar(&mut self, step: &Step) {
        if self.voice != Voice::Words {
            return;
        }
        if self.bar.is_hidden() && self.bar.length().is_none() {
            let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}");
            self.bar = ProgressBar::with_draw_target(Some(BAR_STEPS), ProgressDrawTarget::stderr());
            self.bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        }
        self.bar.set_message(step.words());
        self.bar.set_position((step.done.clamp(0.0, 1.0) * BAR_STEPS as f64) as u64);
    }

    /// Takes the bar away.
    pub fn clear_bar(&self) {
        self.bar.finish_and_clear();
    }

    /// Whether everything could be said.
    pub fn finish(&mut self) -> Result<()> {
        match self.failed.take() {
            None => Ok(()),
            Some(error) => Err(Error::output(format!("cannot write to the standard output: {error}"))),
        }
    }
}

impl Step {
    fn words(&self) -> String {
        let rate = if self.rate >= 1e6 {
            format!("{:.2} Msamples/s", self.rate * 1e-6)
        } else {
            format!("{:.1} ksamples/s", self.rate * 1e-3)
        };
        let end = match self.left {
            _ if self.stopping => "stopping at the end of this pass; Ctrl-C quits at once".to_owned(),
            Some(left) => format!("{} left", clock(left)),
            None => String::new(),
        };
        format!("{}/{} samples a pixel  {rate}  {end}", self.spp, self.of)
    }
}

/// Hours, minutes and seconds.
fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    let (h, m, s) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    if h > 0 { format!("{h}:{m:02}:{s:02}") } else { format!("{m}:{s:02}") }
}

/// A line on stderr. Nobody can be told when that fails.
pub fn say(text: &str) {
    _ = writeln!(io::stderr().lock(), "{}", text.trim_end());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_told_in_words() {
        let step = Step {
            spp: 3,
            of: 64,
            done: 0.05,
            rate: 1_530_000.0,
            left: Some(Duration::from_secs(3723)),
            stopping: false,
        };
        assert_eq!(step.words(), "3/64 samples a pixel  1.53 Msamples/s  1:02:03 left");
        let step = Step { rate: 900.0, left: Some(Duration::from_secs(62)), ..step };
        assert_eq!(step.words(), "3/64 samples a pixel  0.9 ksamples/s  1:02 left");
        assert!(Step { stopping: true, ..step }.words().contains("stopping"));
    }
}
