//! `dapple lens`: what a lens file is, in numbers and as a drawing.

mod svg;

use super::args::LensArgs;
use super::console::Console;
use dapple::import::{Spacing, read_lens};
use dapple::scene::{LensSystem, Paraxial, Pupil};
use dapple::{Error, Result};
use serde::Serialize;
use std::fmt::Write;

/// A lens in numbers; lengths in millimetres. What is at infinity is `null`.
#[derive(Debug, Serialize)]
struct Report {
    notes: Vec<String>,
    interfaces: usize,
    /// Whether any medium has an Abbe number.
    dispersion: bool,
    focal_length: f64,
    f_number: f64,
    back_focal_distance: f64,
    /// From the first vertex towards the film.
    front_principal_plane: f64,
    /// From the last vertex towards the film.
    rear_principal_plane: f64,
    /// From the first vertex to the last.
    length: f64,
    /// Row of the stop, counted from 1, and whether the file names it.
    stop_row: usize,
    stop_named: bool,
    stop_diameter: f64,
    /// From the first vertex towards the film.
    entrance_pupil: f64,
    entrance_pupil_diameter: f64,
    /// From the last vertex towards the film.
    exit_pupil: f64,
    exit_pupil_diameter: f64,
    /// Least distance from the film that it can focus on.
    nearest_focus: f64,
    focus: Option<Focus>,
}

/// Focused on a distance.
#[derive(Debug, Serialize)]
struct Focus {
    /// From the film.
    distance: f64,
    /// From the last vertex to the film.
    film: f64,
    /// From the last vertex to the film that is focused on infinity, and from there on.
    extension: f64,
}

/// Reads, prints, draws.
pub fn run(args: &LensArgs, console: &mut Console) -> Result<()> {
    let spacing = args.spacing.map_or(Spacing::Detect, Into::into);
    let system = read_lens(&args.file, spacing)?;
    let mut lens = Paraxial::of(&system).map_err(|error| error.in_file(&args.file))?;
    if let Some(f_number) = args.f_number {
        let open = lens.f_number();
        if f_number < open * (1.0 - 1e-6) {
            return Err(Error::scene(format!("the lens opens to f/{open:.3}, not to f/{f_number}"))
                .help("ask for a larger f-number"));
        }
        lens.stop_down(lens.stop_for(f_number));
    }
    let focus = args.focus.map(|distance| focus(&lens, distance)).transpose()?;
    let film = focus.as_ref().map_or(lens.back_focal_distance, |focus| focus.film);
    if let Some(path) = &args.svg {
        let drawing = svg::drawing(&system, &lens, film);
        std::fs::write(path, drawing).map_err(|error| {
            Error::output(format!("the drawing cannot be written: {error}")).in_file(path)
        })?;
    }
    let report = Report::of(&system, &lens, focus);
    if args.json {
        console.event(&report);
    } else {
        console.result(&report.words());
    }
    Ok(())
}

fn focus(lens: &Paraxial, distance: f64) -> Result<Focus> {
    let film = lens.focus(distance).ok_or_else(|| {
        let nearest = lens.nearest_focus();
        Error::scene(format!(
            "the lens cannot focus on {distance} mm in front of the film, only from {nearest:.2} mm on"
        ))
    })?;
    Ok(Focus { distance, film, extension: film - lens.back_focal_distance })
}

impl Report {
    fn of(system: &LensSystem, lens: &Paraxial, focus: Option<Focus>) -> Self {
        let (entrance, exit) = (lens.entrance_pupil(), lens.exit_pupil());
        Self {
            notes: system.notes.clone(),
            interfaces: system.interfaces.len(),
            dispersion: system.disperses(),
            focal_length: lens.focal_length,
            f_number: lens.f_number(),
            back_focal_distance: lens.back_focal_distance,
            front_principal_plane: lens.front_principal,
            rear_principal_plane: lens.rear_principal,
            length: lens.length,
            stop_row: lens.stop.interface + 1,
            stop_named: lens.stop.named,
            stop_diameter: lens.stop_diameter,
            entrance_pupil: entrance.position,
            entrance_pupil_diameter: entrance.diameter,
            exit_pupil: exit.position,
            exit_pupil_diameter: exit.diameter,
            nearest_focus: lens.nearest_focus(),
            focus,
        }
    }

    fn words(&self) -> String {
        let mm = |value: f64| format!("{value:.4} mm");
        let pupil = |position, diameter, from: &str| {
            let Pupil { position, diameter } = Pupil { position, diameter };
            format!("{} from the {from} vertex, diameter {}", mm(position), mm(diameter))
        };
        let stop = if self.stop_named { "" } else { ", the rim that limits a beam along the axis" };
        let mut rows = vec![
            ("surfaces", self.interfaces.to_string()),
            ("dispersion", if self.dispersion { "yes" } else { "no Abbe numbers" }.to_owned()),
            ("focal length", mm(self.focal_length)),
            ("f-number", format!("{:.4}", self.f_number)),
            ("back focal distance", mm(self.back_focal_distance)),
            ("front principal plane", format!("{} from the first vertex", mm(self.front_principal_plane))),
            ("rear principal plane", format!("{} from the last vertex", mm(self.rear_principal_plane))),
            ("length", mm(self.length)),
            ("stop", format!("row {}, diameter {}{stop}", self.stop_row, mm(self.stop_diameter))),
            ("entrance pupil", pupil(self.entrance_pupil, self.entrance_pupil_diameter, "first")),
            ("exit pupil", pupil(self.exit_pupil, self.exit_pupil_diameter, "last")),
            ("nearest focus", format!("{} from the film", mm(self.nearest_focus))),
        ];
        if let Some(focus) = &self.focus {
            rows.push(("focused on", format!("{} from the film", mm(focus.distance))));
            rows.push((
                "film",
                format!(
                    "{} from the last vertex, {} more than at infinity",
                    mm(focus.film),
                    mm(focus.extension)
                ),
            ));
        }
        let mut out = String::new();
        for note in &self.notes {
            _ = writeln!(out, "# {note}");
        }
        for (name, value) in rows {
            _ = writeln!(out, "{name:<22} {value}");
        }
        _ = writeln!(out, "Distances along the axis are positive towards the film.");
        out.trim_end().to_owned()
    }
}
