//! Files of the parts of a divided run: each is written whole or not at all, and belongs to one input and one program.

use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use asperity::numeric::lanes::register_bits;
use serde::{Deserialize, Serialize};

use crate::disk::advice;
use crate::divided::{Part, TileResult};

/// The folder of the parts of one run.
#[derive(Debug)]
pub struct Parts {
    folder: PathBuf,
    stem: String,
    key: String,
    tiles: usize,
}

/// What keeps parts from being written or merged.
#[derive(Debug, thiserror::Error)]
pub enum PartsError {
    /// The operating system refused.
    #[error("cannot {operation} {}: {source}{}", path.display(), advice(source))]
    Io {
        /// What was tried, as in "cannot write".
        operation: &'static str,
        /// What it was tried on.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// Another process writes the same part.
    #[error("{}: another process writes this part; wait for it to end", .0.display())]
    Busy(PathBuf),
    /// A file whose content is not what its name says.
    #[error("{}: {reason}; remove it and run the part again", path.display())]
    Invalid {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// A part was computed in registers of another width.
    #[error(
        "{} was computed in vector registers of {found} bits, this process uses {own}: sums are the same to the bit only in equal \
         registers; run the part again on a machine like this one, or all parts and the merge with the environment variable \
         ASPERITY_LANES=4 (256 bits)",
        path.display()
    )]
    Registers {
        /// The file.
        path: PathBuf,
        /// Its width, bits.
        found: usize,
        /// That of this process, bits.
        own: usize,
    },
    /// Some tiles of a pass have no result yet.
    #[error("{}", missing_words(*pass, missing, *others, folder))]
    Missing {
        /// The pass, from 0.
        pass: usize,
        /// What has to be run, or where no part is there, all tiles.
        missing: Vec<Missing>,
        /// Number of files of the same spec that belong to another input or program.
        others: usize,
        /// Where they were looked for.
        folder: PathBuf,
    },
}

/// Tiles without a result.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Missing {
    /// The part that has them, where the other files say into how many parts the run is divided.
    pub part: Option<Part>,
    /// The tiles.
    pub tiles: Range<usize>,
}

fn missing_words(pass: usize, missing: &[Missing], others: usize, folder: &Path) -> String {
    let one = |missing: &Missing| {
        let tiles = format!("tiles {} to {}", missing.tiles.start + 1, missing.tiles.end);
        missing.part.map_or_else(|| tiles.clone(), |part| format!("part {part} ({tiles})"))
    };
    let list: Vec<String> = missing.iter().map(one).collect();
    let next = missing.iter().find_map(|missing| missing.part);
    let next = next.map_or_else(|| "1/N to N/N, for any N".to_owned(), |part| part.to_string());
    let mut words = format!(
        "{}: pass {} is missing {}; to run it: `experiment run --part {next}`",
        folder.display(),
        pass + 1,
        list.join(", ")
    );
    if others > 0 {
        words += &format!(
            "; {others} files of the same spec are there that belong to another version of the spec, its input files or the program"
        );
    }
    words
}

/// A part of one pass, as its file holds it.
#[derive(Serialize, Deserialize)]
struct PartFile {
    key: String,
    register_bits: usize,
    pass: usize,
    /// The first tile, and the one after the last.
    tiles: [usize; 2],
    of_tiles: usize,
    results: Vec<TileResult>,
}

/// A file of a pass, by its name.
struct Named {
    path: PathBuf,
    part: Part,
}

impl Parts {
    /// The parts in `folder` of the run called `stem` on the input and with the program of `key`, which has `tiles` tiles;
    /// touches nothing.
    pub fn new(folder: &Path, stem: &str, key: &str, tiles: usize) -> Self {
        Self { folder: folder.to_owned(), stem: stem.to_owned(), key: key.to_owned(), tiles }
    }

    /// The file of a part of pass `pass` (from 0). Its name holds the hash of spec, input files and program.
    pub fn path(&self, part: Part, pass: usize) -> PathBuf {
        self.folder.join(format!("{}part-{}-of-{}.json", self.prefix(pass), part.index, part.of))
    }

    fn prefix(&self, pass: usize) -> String {
        /// Digits of the hash in names; files hold all of it.
        const DIGITS: usize = 16;
        format!("{}-{}-pass-{}-", self.stem, &self.key[..DIGITS.min(self.key.len())], pass + 1)
    }

    /// Whether a valid file of the part is there.
    ///
    /// # Errors
    /// A file that cannot be read or does not belong here.
    pub fn is_written(&self, part: Part, pass: usize) -> Result<bool, PartsError> {
        let path = self.path(part, pass);
        if !path.exists() {
            return Ok(false);
        }
        self.read_file(&path, part, pass).map(|_| true)
    }

    /// Writes a part: under its name only once it is complete on the disk.
    ///
    /// # Errors
    /// A disk that refuses, or another process that writes the same part.
    pub fn write(&self, part: Part, pass: usize, results: Vec<TileResult>) -> Result<PathBuf, PartsError> {
        fs::create_dir_all(&self.folder).map_err(failed("create folder", &self.folder))?;
        let path = self.path(part, pass);
        let tiles = part.tiles(self.tiles);
        let content = PartFile {
            key: self.key.clone(),
            register_bits: register_bits(),
            pass,
            tiles: [tiles.start, tiles.end],
            of_tiles: self.tiles,
            results,
        };
        let mut bytes = serde_json::to_vec(&content)
            .map_err(|error| PartsError::Invalid { path: path.clone(), reason: error.to_string() })?;
        bytes.push(b'\n');
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let new = self.folder.join(format!(".{name}.new"));
        let mut file = File::options()
            .create(true)
            .truncate(false)
            .write(true)
            .open(&new)
            .map_err(failed("create", &new))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(PartsError::Busy(path)),
            // A file system without locks: two processes that write the same part write the same bytes.
            Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {}
            Err(TryLockError::Error(error)) => return Err(failed("lock", &new)(error)),
        }
        file.set_len(0)
            .and_then(|()| file.write_all(&bytes))
            .and_then(|()| file.sync_all())
            .map_err(failed("write", &new))?;
        fs::rename(&new, &path).map_err(failed("write", &path))?;
        Ok(path)
    }

    /// The results of all tiles in a pass, in their order.
    ///
    /// # Errors
    /// Tiles without a result, and a file that does not belong here.
    pub fn read(&self, pass: usize) -> Result<Vec<TileResult>, PartsError> {
        let (mut files, others) = self.files(pass)?;
        files.sort_by_key(|file| (file.part.of, file.part.index));
        let mut found: Vec<Option<TileResult>> = vec![None; self.tiles];
        for Named { path, part } in &files {
            let tiles = part.tiles(self.tiles);
            // Another division of the same tiles may have given them already.
            if found[tiles.clone()].iter().any(Option::is_none) {
                let results = self.read_file(path, *part, pass)?;
                found[tiles].iter_mut().zip(results).for_each(|(place, result)| *place = Some(result));
            }
        }
        let missing = self.missing(&found, &files);
        if missing.is_empty() {
            return Ok(found.into_iter().flatten().collect());
        }
        Err(PartsError::Missing { pass, missing, others, folder: self.folder.clone() })
    }

    /// The files of a pass, and the number of files of the same spec with another hash.
    fn files(&self, pass: usize) -> Result<(Vec<Named>, usize), PartsError> {
        let entries = match fs::read_dir(&self.folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok((Vec::new(), 0)),
            Err(error) => return Err(failed("read folder", &self.folder)(error)),
        };
        let (prefix, stem) = (self.prefix(pass), format!("{}-", self.stem));
        let middle = format!("-pass-{}-part-", pass + 1);
        let (mut files, mut others) = (Vec::new(), 0);
        for entry in entries {
            let path = entry.map_err(failed("read folder", &self.folder))?.path();
            let Some(name) = path.file_name().and_then(|name| name.to_str()) else { continue };
            let part = name.strip_prefix(&prefix).and_then(part_of);
            match part {
                // More parts than tiles are not written.
                Some(part) if part.of <= self.tiles => files.push(Named { path, part }),
                _ if name.starts_with(&stem) && name.contains(&middle) => others += 1,
                _ => {}
            }
        }
        Ok((files, others))
    }

    fn missing(&self, found: &[Option<TileResult>], files: &[Named]) -> Vec<Missing> {
        let is_missing = |tiles: Range<usize>| found[tiles].iter().any(Option::is_none);
        if !is_missing(0..self.tiles) {
            return Vec::new();
        }
        // The division that most tiles came in.
        let of = files.iter().map(|file| file.part.of).max_by_key(|of| {
            files
                .iter()
                .filter(|file| file.part.of == *of)
                .map(|file| file.part.tiles(self.tiles).len())
                .sum::<usize>()
        });
        let Some(of) = of else { return vec![Missing { part: None, tiles: 0..self.tiles }] };
        let parts = (1..=of).map(|index| Part { index, of });
        let missing = parts.filter(|part| is_missing(part.tiles(self.tiles)));
        missing.map(|part| Missing { part: Some(part), tiles: part.tiles(self.tiles) }).collect()
    }

    fn read_file(&self, path: &Path, part: Part, pass: usize) -> Result<Vec<TileResult>, PartsError> {
        let invalid = |reason: String| PartsError::Invalid { path: path.to_owned(), reason };
        let bytes = fs::read(path).map_err(failed("read", path))?;
        let file: PartFile = serde_json::from_slice(&bytes)
            .map_err(|error| invalid(format!("is no part of a run ({error})")))?;
        let tiles = part.tiles(self.tiles);
        if file.key != self.key || file.pass != pass || file.of_tiles != self.tiles {
            return Err(invalid(
                "belongs to another spec, input file, program or pass than its name says".to_owned(),
            ));
        }
        if file.tiles != [tiles.start, tiles.end] || file.results.len() != tiles.len() {
            return Err(invalid(format!("holds other tiles than {} to {}", tiles.start + 1, tiles.end)));
        }
        let own = register_bits();
        if file.register_bits != own {
            return Err(PartsError::Registers { path: path.to_owned(), found: file.register_bits, own });
        }
        Ok(file.results)
    }
}

/// The part that the end of a file name says.
fn part_of(end: &str) -> Option<Part> {
    let numbers = end.strip_prefix("part-")?.strip_suffix(".json")?;
    numbers.replacen("-of-", "/", 1).parse().ok()
}

fn failed(operation: &'static str, path: &Path) -> impl Fn(io::Error) -> PartsError {
    let path = path.to_owned();
    move |source| PartsError::Io { operation, path: path.clone(), source }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn results(tiles: Range<usize>) -> Vec<TileResult> {
        tiles.map(|tile| TileResult::from_value(&tile).unwrap()).collect()
    }

    fn parts(folder: &Path, key: &str) -> Parts {
        Parts::new(folder, "large", key, 10)
    }

    fn write(parts: &Parts, index: usize, of: usize) {
        let part = Part { index, of };
        parts.write(part, 0, results(part.tiles(10))).unwrap();
    }

    fn values(parts: &Parts) -> Vec<usize> {
        parts.read(0).unwrap().iter().map(|result| result.value().unwrap()).collect()
    }

    #[test]
    fn parts_of_any_division_make_up_a_pass() {
        let folder = tempfile::tempdir().unwrap();
        let all = parts(folder.path(), "0123456789abcdef0123");
        write(&all, 1, 2);
        write(&all, 3, 3);
        let PartsError::Missing { missing, others, .. } = all.read(0).unwrap_err() else { panic!() };
        assert_eq!(
            (missing, others),
            (vec![Missing { part: Some(Part { index: 2, of: 2 }), tiles: 5..10 }], 0)
        );
        write(&all, 2, 3);
        assert_eq!(values(&all), (0..10).collect::<Vec<_>>());
        assert!(all.is_written(Part { index: 2, of: 3 }, 0).unwrap());
        assert!(!all.is_written(Part { index: 2, of: 3 }, 1).unwrap());
    }

    #[test]
    fn what_belongs_elsewhere_is_not_merged() {
        let folder = tempfile::tempdir().unwrap();
        let (all, other) =
            (parts(folder.path(), "0123456789abcdef0"), parts(folder.path(), "f123456789abcdef0"));
        assert!(all.read(0).unwrap_err().to_string().contains("pass 1 is missing tiles 1 to 10"));
        write(&all, 1, 2);
        write(&other, 2, 2);
        let message = all.read(0).unwrap_err().to_string();
        assert!(message.contains("part 2/2 (tiles 6 to 10)") && message.contains("1 files"), "{message}");
        // Under a false name, cut short, and of other registers.
        let (first, second) = (all.path(Part { index: 1, of: 2 }, 0), all.path(Part { index: 2, of: 2 }, 0));
        fs::copy(other.path(Part { index: 2, of: 2 }, 0), &second).unwrap();
        assert!(all.read(0).unwrap_err().to_string().contains("belongs to another spec"));
        fs::copy(&first, &second).unwrap();
        assert!(all.read(0).unwrap_err().to_string().contains("other tiles than 6 to 10"));
        fs::write(&second, &fs::read(&first).unwrap()[..40]).unwrap();
        assert!(all.read(0).unwrap_err().to_string().contains("is no part of a run"));
        write(&all, 2, 2);
        assert_eq!(values(&all).len(), 10);
        let text = fs::read_to_string(&first).unwrap();
        let own = format!("\"register_bits\":{}", register_bits());
        fs::write(&first, text.replace(&own, "\"register_bits\":192")).unwrap();
        assert!(matches!(all.read(0), Err(PartsError::Registers { found: 192, .. })));
    }

    /// What a killed process left behind is written over.
    #[test]
    fn an_unfinished_file_is_no_part() {
        let folder = tempfile::tempdir().unwrap();
        let all = parts(folder.path(), "0123456789abcdef0");
        write(&all, 1, 2);
        fs::write(folder.path().join(".large-0123456789abcdef-pass-1-part-2-of-2.json.new"), "{\"key")
            .unwrap();
        assert!(matches!(all.read(0), Err(PartsError::Missing { others: 0, .. })));
        write(&all, 2, 2);
        assert_eq!(values(&all), (0..10).collect::<Vec<_>>());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}
