//! `dapple shaders`: the shaders of the program as files, and the errors in those of the user.

use super::args::{CheckShadersArgs, ExportShadersArgs, ShadersArgs, ShadersVerb};
use super::console::Console;
use super::devices::bytes_text;
use super::event::Event;
use dapple::render::{Checked, check_kernels};
use dapple::shader::{CacheOptions, Sources, embedded_files};
use dapple::{Error, Result, whole_file};
use std::fs;
use std::path::Path;
use std::time::Instant;

/// Does what the verb says.
pub fn run(args: &ShadersArgs, console: &mut Console) -> Result<()> {
    match &args.verb {
        ShadersVerb::Export(args) => export(args, console),
        ShadersVerb::Check(args) => check(args, console),
    }
}

/// Writes all files, or none when one is there that may not be replaced.
fn export(args: &ExportShadersArgs, console: &mut Console) -> Result<()> {
    let folder = &args.folder;
    let there = embedded_files().map(|(name, _)| folder.join(name)).find(|path| path.exists());
    if let Some(path) = there.filter(|_| !args.force) {
        let error = Error::output("this is there already and is not replaced");
        return Err(error.help("name another folder, or give --force").in_file(&path));
    }
    let (mut files, mut bytes) = (0, 0);
    for (name, text) in embedded_files() {
        let path = folder.join(name);
        let parent = path.parent().unwrap_or(folder);
        fs::create_dir_all(parent)
            .map_err(|e| Error::output(format!("cannot make the folder: {e}")).in_file(parent))?;
        whole_file::write(&path, text, args.force).map_err(|e| {
            Error::output(format!("cannot write the file: {}", whole_file::reason(&e))).in_file(&path)
        })?;
        files += 1;
        bytes += text.len() as u64;
    }
    let (size, folder) = (bytes_text(bytes), folder.display());
    console.note(&format!(
        "wrote {files} files into {folder}, {size}\nchange them, and render with --shaders {folder}; \
         `dapple shaders check {folder}` finds errors"
    ));
    Ok(())
}

/// Prints what is wrong; an error when anything is.
fn check(args: &CheckShadersArgs, console: &mut Console) -> Result<()> {
    let start = Instant::now();
    let checked = check_kernels(&Sources::folder(&args.folder)?, &CacheOptions::from_environment())?;
    let problems = problems(&checked, &args.folder);
    for problem in &problems {
        match console.json() {
            true => console.event(problem),
            false => console.result(&line(problem)),
        }
    }
    let (errors, warnings) = (checked.errors.len(), checked.unused.len());
    let Checked { kernels, variants, .. } = checked;
    let seconds = start.elapsed().as_secs_f64();
    console.event(&Event::Checked { kernels, variants, errors, warnings, seconds });
    let s = if errors == 1 { "" } else { "s" };
    let summary = format!("{kernels} kernels, {variants} variants, {errors} error{s}, {seconds:.1} s");
    if errors > 0 {
        return Err(Error::device(summary).in_file(&args.folder));
    }
    if !console.json() {
        console.note(&summary);
    }
    Ok(())
}

/// Errors, then warnings.
fn problems(checked: &Checked, folder: &Path) -> Vec<Event> {
    let errors = checked.errors.iter().map(|(error, kernel)| {
        let place = error.place.clone().unwrap_or_default();
        let own = folder.join(&place.file);
        let is_own = own.is_file();
        let file = if is_own { own } else { place.file };
        Event::Problem {
            severity: "error",
            file: file.display().to_string(),
            line: place.line.max(1),
            column: place.column.max(1),
            message: error.message.replace('\n', " "),
            help: error.help.clone().or_else(|| (!is_own).then(|| NOT_OWN.to_owned())),
            kernel: Some(kernel.to_string()),
        }
    });
    let warnings = checked.unused.iter().map(|(name, near)| Event::Problem {
        severity: "warning",
        file: folder.join(name).display().to_string(),
        line: 1,
        column: 1,
        message: "no kernel reads this file".to_owned(),
        help: near.as_ref().map(|near| format!("did you mean `{near}`?")),
        kernel: None,
    });
    errors.chain(warnings).collect()
}

/// What is to be done about an error in a file that is not in the folder.
const NOT_OWN: &str = "this file is the program's: those of the folder must fit it";

/// The line of a problem, as editors read it.
fn line(problem: &Event) -> String {
    match problem {
        Event::Problem { severity, file, line, column, message, help, .. } => {
            let help = help.as_ref().map_or_else(String::new, |help| format!("; {help}"));
            format!("{file}:{line}:{column}: {severity}: {message}{help}")
        }
        _ => String::new(),
    }
}
