//! Writing height maps: one module per format.
//!
//! | module | format | what it holds besides heights |
//! |---|---|---|
//! | `npy`, here | NumPy array of float64, the first index is x | |
//! | `x3p` | ISO 25178-72 | pixel, unit, offset, notes |
//! | [`gwy`] | Gwyddion | pixel, unit, notes; several fields of any unit |
//! | `xyz`, here | columns x y z as text, in metres, x fastest; missing points are left out | pixel, unit, notes |
//!
//! Read back by [`read`](super::read) a map has the same heights, missing points and pixel, to the bit. Heights are those of [`Rows`], in
//! metres: an [offset](Rows::offset) that is kept apart is lost in all formats but X3P. The first y is the first line of an X3P and a `.gwy`
//! file, which programs show at the top, as they do with the file of the instrument that it was read from. All writers go through a map row
//! by row, and take 64 MB at most; to write it is a unit of work for whoever watches the map.

mod gwy;
mod x3p;

use std::fs::File;
use std::io::{self, BufWriter, Seek, Write};
use std::path::Path;

use super::Rows;
use crate::memory::zeros;
use crate::npy;
pub use gwy::{GwyField, gwy};

/// What is said of a map: a name, such as "Preparation", and a text.
pub type Note = (&'static str, String);

/// A format that maps are written in.
pub struct MapFormat {
    /// How its files end.
    pub ending: &'static str,
    /// Whether it holds pixel, unit and notes; otherwise it holds numbers only.
    pub holds_notes: bool,
    write: fn(&mut dyn Out, &dyn Rows, &[Note]) -> io::Result<()>,
}

/// Where a file is written to.
pub trait Out: Write + Seek {}

impl<T: Write + Seek> Out for T {}

/// All formats.
pub static FORMATS: [&MapFormat; 4] = [&NPY, &x3p::FORMAT, &gwy::FORMAT, &XYZ];

impl MapFormat {
    /// The format whose files end in `ending`, in any case.
    pub fn of_ending(ending: &str) -> Option<&'static Self> {
        FORMATS.iter().copied().find(|format| format.ending.eq_ignore_ascii_case(ending))
    }

    /// Writes a map with what is said of it.
    ///
    /// # Errors
    /// A file that cannot be written; a map that the format cannot hold ([`io::ErrorKind::InvalidInput`]).
    pub fn write(&self, mut out: impl Out, map: &dyn Rows, notes: &[Note]) -> io::Result<()> {
        (self.write)(&mut out, map, notes)
    }

    /// The same to a file that is written whole or not at all.
    ///
    /// # Errors
    /// As [`Self::write`].
    pub fn write_file(&self, path: &Path, map: &dyn Rows, notes: &[Note]) -> io::Result<()> {
        whole_file(path, |out| self.write(out, map, notes))
    }
}

/// Writes a file beside its place and moves it there, so that a reader finds the old file or the whole new one. What killed
/// processes have left of the same file goes.
///
/// # Errors
/// Those of `write`, and a file that cannot be written.
pub fn whole_file(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<()> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let beginning = format!(".{name}.");
    clear_leftovers(path, &beginning);
    let beside = path.with_file_name(format!("{beginning}{}", std::process::id()));
    let mut out = BufWriter::new(File::create_new(&beside)?);
    let mut unfinished = Unfinished(Some(&beside));
    // Says that it is no leftover; where files have no locks, two processes that write the same file are in each other's way.
    let _ = out.get_ref().try_lock();
    let written = write(&mut out)
        .and_then(|()| out.flush())
        .and_then(|()| out.get_ref().sync_all())
        .and_then(|()| std::fs::rename(&beside, path));
    if written.is_ok() {
        unfinished.0 = None;
    }
    written
}

/// A file that goes unless it is finished: where it cannot be written, and where nobody wants it any more.
struct Unfinished<'a>(Option<&'a Path>);

impl Drop for Unfinished<'_> {
    fn drop(&mut self) {
        if let Some(path) = self.0 {
            // Why it is not finished says more than an error of the removal.
            let _ = std::fs::remove_file(path);
        }
    }
}

/// Removes files beside a path whose names are a beginning and a number, and which nobody writes.
fn clear_leftovers(path: &Path, beginning: &str) {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let is_ours = |entry: &std::fs::DirEntry| {
        let name = entry.file_name();
        let number = name.to_str().and_then(|name| name.strip_prefix(beginning));
        number.is_some_and(|number| number.parse::<u32>().is_ok())
    };
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten().filter(is_ours) {
        if File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// Calls `take` with the heights of each line along x, from the first y on: a unit of work.
fn each_line(map: &dyn Rows, mut take: impl FnMut(&[f64]) -> io::Result<()>) -> io::Result<()> {
    /// Of the lines that are held at a time.
    const HEIGHTS: usize = (64 << 20) / 8;
    let [nx, ny] = map.points();
    let most = (HEIGHTS / nx).clamp(1, ny);
    let (mut lines, mut own) = (zeros(nx * most), zeros(ny));
    for first in (0..ny).step_by(most) {
        let count = most.min(ny - first);
        for ix in 0..nx {
            let row = match map.block(ix..ix + 1) {
                Some(row) => row,
                None => {
                    map.read(ix, &mut own);
                    &own
                }
            };
            for (k, z) in row[first..first + count].iter().enumerate() {
                lines[k * nx + ix] = *z;
            }
        }
        lines.chunks(nx).take(count).try_for_each(|line| {
            map.progress().advance((ny as f64).recip());
            take(line)
        })?;
    }
    Ok(())
}

/// The bytes of a line of doubles, the least significant first; missing points are one and the same NaN.
fn bytes_of(line: &[f64], bytes: &mut Vec<u8>) {
    bytes.clear();
    bytes.extend(line.iter().flat_map(|z| if z.is_nan() { f64::NAN } else { *z }.to_le_bytes()));
}

/// A text on one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn too_large(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, what.to_owned())
}

const NPY: MapFormat = MapFormat { ending: "npy", holds_notes: false, write: write_npy };

fn write_npy(out: &mut dyn Out, map: &dyn Rows, _: &[Note]) -> io::Result<()> {
    let [nx, ny] = map.points();
    let row = |ix| {
        let mut row = zeros(ny);
        map.read(ix, &mut row);
        map.progress().advance((nx as f64).recip());
        row
    };
    npy::write(out, [nx, ny], (0..nx).flat_map(row))
}

const XYZ: MapFormat = MapFormat { ending: "xyz", holds_notes: true, write: write_xyz };

fn write_xyz(out: &mut dyn Out, map: &dyn Rows, notes: &[Note]) -> io::Result<()> {
    let ([nx, ny], [dx, dy]) = (map.points(), map.pixel());
    for (name, text) in notes {
        writeln!(out, "# {name}: {}", one_line(text))?;
    }
    // The reader takes the grid from this line: coordinates are multiples of the pixel, rounded.
    writeln!(out, "# Grid: {nx} x {ny} points, {dx:e} x {dy:e}")?;
    writeln!(out, "# x [m] y [m] z [m]")?;
    let mut iy = 0;
    each_line(map, |line| {
        let y = iy as f64 * dy;
        iy += 1;
        let mut present = line.iter().enumerate().filter(|(_, z)| !z.is_nan());
        present.try_for_each(|(ix, z)| writeln!(out, "{:e} {y:e} {z:e}", ix as f64 * dx))
    })
}
