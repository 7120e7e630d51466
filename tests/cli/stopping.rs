//! Renders that end early: by the time limit, a signal, or two.

use crate::{Planes, Ran, Room, png_size};
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

#[test]
fn the_time_limit_leaves_at_least_one_whole_pass() {
    let room = Room::new();
    let ran = room.run("render scene.toml --time-limit 0 --spp 100000 -o a.exr --json").code(0);
    check_stopped(&room, &ran, "time_limit");
    room.run("render scene.toml --time-limit 0 --spp 100000")
        .code(0)
        .err_has("stopped by the time limit after");
    // A limit that is not reached changes nothing.
    let ran = room.run("render scene.toml --time-limit 1000 --json").code(0);
    assert!(ran.event("done")["stopped_by"].is_null());
}

#[test]
#[cfg(unix)]
fn a_signal_writes_the_picture() {
    for signal in ["-INT", "-TERM"] {
        let room = Room::new();
        let (child, first) = started(&room, "render scene.toml --spp 1000000 --size 64x64 -o a.exr --json");
        send(&child, signal);
        let mut ran = Ran::from(child.wait_with_output().unwrap()).code(0);
        ran.out.insert_str(0, &first);
        check_stopped(&room, &ran, "signal");
    }
}

/// The picture has as many samples in each pixel as the last event says, and not all of them.
fn check_stopped(room: &Room, ran: &Ran, reason: &str) {
    let (start, done) = (ran.event("start"), ran.event("done"));
    assert_eq!(done["stopped_by"], reason);
    let spp = done["spp"].as_u64().unwrap();
    assert!(spp >= 1 && spp < start["spp"].as_u64().unwrap(), "{spp} samples a pixel");
    let exr = Planes::read(&room.path("a.exr"));
    assert!(exr.plane("samples").iter().all(|&n| n == spp as f32), "not a whole pass");
    assert_eq!(room.names(), ["a.exr", "scene.toml"]);
}

#[test]
#[cfg(unix)]
fn a_second_interrupt_quits_at_once() {
    let room = Room::new();
    // A pass over so many pixels takes a software driver long enough for two signals.
    let (child, _) = started(&room, "render scene.toml --spp 1000 --size 1024x1024 --json");
    send(&child, "-INT");
    std::thread::sleep(Duration::from_millis(50));
    send(&child, "-INT");
    Ran::from(child.wait_with_output().unwrap()).code(130);
    assert_eq!(room.names(), ["scene.toml"]);
}

#[test]
#[cfg(unix)]
fn a_picture_of_the_same_name_stays_until_the_new_one_is_whole() {
    let room = Room::new();
    room.run("render scene.toml --quiet").code(0);
    let (mut child, _) = started(&room, "render scene.toml --spp 1000000 --size 64x64 --json");
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(png_size(&room.path("scene.png")), (16, 12));
    assert_eq!(room.names(), ["scene.png", "scene.toml"]);
}

/// A program that has begun to render: its first event of progress has come. Gives the lines up to it.
fn started(room: &Room, arguments: &str) -> (Child, String) {
    let mut command = room.program(arguments);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // One byte at a time, so that the rest stays for `wait_with_output`.
    let mut out = BufReader::with_capacity(1, child.stdout.take().unwrap());
    let mut lines = String::new();
    loop {
        let mut line = String::new();
        assert_ne!(out.read_line(&mut line).unwrap(), 0, "ended after: {lines}");
        lines.push_str(&line);
        let event: Value = serde_json::from_str(&line).unwrap();
        if event["event"] == "progress" {
            break;
        }
    }
    child.stdout = Some(out.into_inner());
    (child, lines)
}

/// Sends a signal with the system's `kill`.
fn send(child: &Child, signal: &str) {
    assert!(Command::new("kill").arg(signal).arg(child.id().to_string()).status().unwrap().success());
}
