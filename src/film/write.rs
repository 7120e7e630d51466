//! A picture becomes a file: the format by the extension, and the file whole or not at all.

use std::io::{self, ErrorKind};
use std::path::Path;

use super::{Film, Frame, Picture, exr, png};
use crate::{Error, Result, scene, whole_file};

/// File formats of pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// sRGB with 8 or 16 bits a channel: what a screen shows.
    Png,
    /// Linear radiance and all other planes in 32-bit floats.
    Exr,
}

/// What a file says about how it was made; a PNG says no units.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Meta {
    /// Seed of all random numbers.
    pub seed: u32,
    /// Samples of a pixel.
    pub samples_per_pixel: u32,
    /// The unit of radiance sums was 2 to this power.
    pub radiance_exponent: i32,
    /// The unit of depth sums was 2 to this power.
    pub depth_exponent: i32,
}

impl Film {
    /// What a file of this film says about how it was made.
    pub fn meta(&self) -> Meta {
        Meta::of(self.frame(), self.samples_per_pixel())
    }
}

impl Meta {
    /// What is said of a film with so many samples a pixel.
    pub fn of(frame: &Frame, samples_per_pixel: u32) -> Self {
        Self {
            seed: frame.seed,
            samples_per_pixel,
            radiance_exponent: frame.radiance_exponent,
            depth_exponent: frame.depth_exponent,
        }
    }
}

/// The format that the extension of `path` asks for, in letters of either case.
///
/// # Errors
///
/// When it is neither `png` nor `exr`.
pub fn format_of(path: &Path) -> Result<Format> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    let message = match extension.as_deref() {
        Some("png") => return Ok(Format::Png),
        Some("exr") => return Ok(Format::Exr),
        Some(other) => format!("no picture format has the extension `{other}`"),
        None => "the name of the picture has no extension".to_string(),
    };
    Err(Error::scene(message).in_file(path).help("end the name in .png or .exr"))
}

/// Tells before the work whether `path` names a known format in a folder that can be written to.
///
/// # Errors
///
/// As [`format_of`], or when no file can be made in the folder.
pub fn check_target(path: &Path) -> Result<Format> {
    let format = format_of(path)?;
    if path.is_dir() {
        return Err(refusal(path, &io::Error::from(ErrorKind::IsADirectory)));
    }
    whole_file::new_beside(path).map_err(|error| refusal(path, &error))?;
    Ok(format)
}

/// Writes the picture in the format that the extension of `path` asks for. The file appears whole or not at
/// all: it is written under another name in the same folder and renamed when it is safe on the disk.
///
/// # Errors
///
/// As [`format_of`], or when the file cannot be written; a file of that name is then as before.
pub fn write(path: &Path, picture: &Picture, film: &scene::Film, meta: &Meta) -> Result<()> {
    write_file(path, encode(format_of(path)?, picture, film, meta))
}

/// The bytes of the file of a picture.
///
/// # Errors
///
/// When the picture is too large for the format.
pub fn encode(format: Format, picture: &Picture, film: &scene::Film, meta: &Meta) -> io::Result<Vec<u8>> {
    match format {
        Format::Png => png::encode(picture, film, meta),
        Format::Exr => exr::encode(picture, film, meta),
    }
}

/// Writes a file whole or not at all.
///
/// # Errors
///
/// When it cannot be written; a file of that name is then as before.
pub fn write_bytes(path: &Path, bytes: Vec<u8>) -> Result<()> {
    write_file(path, Ok(bytes))
}

/// Writes an encoded file whole or not at all.
pub(super) fn write_file(path: &Path, bytes: io::Result<Vec<u8>>) -> Result<()> {
    bytes.and_then(|bytes| whole_file::write(path, &bytes, true)).map_err(|error| refusal(path, &error))
}

/// The error for a file that could not be written, with the next step.
fn refusal(path: &Path, error: &io::Error) -> Error {
    let help = match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => "make the folder first, or name another with -o",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "name a file with -o in a folder that you may write to"
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            "make room on the disk, or name a file on another one with -o"
        }
        ErrorKind::IsADirectory => "name a file with -o, not a folder",
        _ => "name another file with -o",
    };
    let reason = whole_file::reason(error);
    Error::output(format!("the picture cannot be written: {reason}")).in_file(path).help(help)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind as Kind;
    use crate::film::tests::picture_of;
    use crate::scene::Rect;
    use crate::whole_file::{fill, write_with};
    use std::fs::{self, File};
    use std::io::Write;

    const META: Meta = Meta { seed: 1, samples_per_pixel: 2, radiance_exponent: -24, depth_exponent: -12 };

    fn one_pixel() -> Picture {
        picture_of(1, 1, Rect { x0: 0, y0: 0, x1: 1, y1: 1 })
    }

    fn names(folder: &Path) -> Vec<String> {
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn extension_decides() {
        assert_eq!(format_of(Path::new("a/b.png")).unwrap(), Format::Png);
        assert_eq!(format_of(Path::new("B.EXR")).unwrap(), Format::Exr);
        let error = format_of(Path::new("a.jpg")).unwrap_err();
        assert_eq!(error.kind, Kind::Scene);
        assert_eq!(
            error.to_string(),
            "a.jpg: no picture format has the extension `jpg`; end the name in .png or .exr"
        );
        let error = format_of(Path::new("png")).unwrap_err();
        assert_eq!(
            error.to_string(),
            "png: the name of the picture has no extension; end the name in .png or .exr"
        );
    }

    #[test]
    fn writes_both_formats_and_replaces() {
        let folder = tempfile::tempdir().unwrap();
        for (name, magic) in [("a.png", *b"\x89PNG"), ("a.exr", [0x76, 0x2f, 0x31, 0x01])] {
            let path = folder.path().join(name);
            fs::write(&path, "before").unwrap();
            check_target(&path).unwrap();
            write(&path, &one_pixel(), &scene::Film::default(), &META).unwrap();
            assert_eq!(fs::read(&path).unwrap()[..4], magic);
        }
        assert_eq!(names(folder.path()).len(), 2);
    }

    #[cfg(unix)]
    #[test]
    fn permissions_are_those_of_any_new_file() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let mode = |name: &str| fs::metadata(folder.path().join(name)).unwrap().permissions().mode();
        fs::write(folder.path().join("plain"), "").unwrap();
        write(&folder.path().join("a.png"), &one_pixel(), &scene::Film::default(), &META).unwrap();
        assert_eq!(mode("a.png"), mode("plain"));
    }

    #[test]
    fn failure_leaves_the_folder_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let half = |file: &mut File| {
            file.write_all(b"half")?;
            Err(io::Error::from(ErrorKind::StorageFull))
        };
        let error = write_with(&path, true, half).unwrap_err();
        assert!(refusal(&path, &error).to_string().contains("make room on the disk"));
        assert!(names(folder.path()).is_empty());
        fs::write(&path, "before").unwrap();
        write_with(&path, true, half).unwrap_err();
        assert_eq!(fs::read(&path).unwrap(), b"before");
        assert_eq!(names(folder.path()), ["a.png"]);
        // A picture that cannot be encoded
        let film = scene::Film { png_bits: 12, ..Default::default() };
        write(&path, &one_pixel(), &film, &META).unwrap_err();
        assert_eq!(names(folder.path()), ["a.png"]);
    }

    #[test]
    fn targets_that_cannot_be_written_are_named() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("missing/a.png");
        for error in [
            check_target(&missing).unwrap_err(),
            write(&missing, &one_pixel(), &scene::Film::default(), &META).unwrap_err(),
        ] {
            assert_eq!(error.kind, Kind::Output);
            let text = error.to_string();
            assert!(text.starts_with(&format!("{}: the picture cannot", missing.display())), "{text}");
            assert!(text.ends_with("; make the folder first, or name another with -o"), "{text}");
            assert!(!text.contains(".dapple-"), "{text}");
        }
        let taken = folder.path().join("folder.exr");
        fs::create_dir(&taken).unwrap();
        for error in [
            check_target(&taken).unwrap_err(),
            write(&taken, &one_pixel(), &scene::Film::default(), &META).unwrap_err(),
        ] {
            assert!(error.to_string().ends_with("; name a file with -o, not a folder"), "{error}");
        }
        assert_eq!(names(folder.path()), ["folder.exr"]);
        // A file where a folder is needed
        fs::write(folder.path().join("file"), "").unwrap();
        let error = check_target(&folder.path().join("file/a.png")).unwrap_err();
        assert!(error.to_string().contains("make the folder first"), "{error}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn full_disk_is_an_error() {
        let mut full = File::options().write(true).open("/dev/full").unwrap();
        let error = fill(&mut full, b"picture").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::StorageFull);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn folder_that_takes_no_files_is_an_error() {
        // Not even root can make a file in /proc
        let error = check_target(Path::new("/proc/a.png")).unwrap_err();
        assert_eq!(error.kind, Kind::Output);
    }
}
