//! Parts of an experiment: run one at a time, in any order and on any machine, then merged.

use std::path::{Path, PathBuf};

use asperity_contact_framework::Outcome;
use asperity_contact_framework::digest::KnownFiles;
use asperity_contact_framework::divided::{AnyDivided, Part, TileResult};
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::parts::{Parts, PartsError};
use asperity_contact_framework::progress::Progress;

use crate::experiment::Experiment;

/// What was done of a part.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PartRun {
    /// Files written, pass by pass; none where all were there.
    pub written: Vec<PathBuf>,
    /// Number of passes of the experiment.
    pub passes: usize,
    /// What the next pass still needs from other parts; `None` where this part is complete.
    pub waits_for: Option<String>,
}

/// What parts merge to.
pub struct Merged {
    /// The results.
    pub outcome: Box<dyn Outcome>,
    /// What they depend on: [`Experiment::key`].
    pub key: String,
}

/// Why a part was not run, or parts were not merged.
#[derive(Debug, thiserror::Error)]
pub enum PartError {
    /// A spec or an input file.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The files of the parts.
    #[error(transparent)]
    Parts(#[from] PartsError),
}

impl Experiment {
    /// Runs as many passes of a part as the files in `folder` allow, and writes what it finds there. A pass needs the earlier passes
    /// of all parts.
    ///
    /// # Errors
    /// An experiment without parts, more parts than tiles, a part that does not belong to this input and program, and what a
    /// run would refuse.
    pub fn run_part(&self, part: Part, folder: &Path, progress: &dyn Progress) -> Result<PartRun, PartError> {
        let divided = self.divided()?;
        let tiles = divided.tiles();
        if part.of > tiles {
            let message =
                format!("found --part {part} of a run of {tiles} tiles; allowed: at most {tiles} parts");
            return Err(InputError::file(self.path(), message).into());
        }
        let before = self.modified();
        let input = self.input_by(|path| KnownFiles { folder }.sha256(path))?;
        let parts = Parts::new(folder, self.stem(), &self.key_of(&input), tiles);
        let mut done = PartRun { written: Vec::new(), passes: divided.passes(), waits_for: None };
        let mut earlier: Vec<Vec<TileResult>> = Vec::new();
        for pass in 0..divided.passes() {
            if !parts.is_written(part, pass)? {
                let results = divided.pass(
                    &self.context(&|| Ok(input.clone()), progress),
                    part.tiles(tiles),
                    &earlier,
                )?;
                self.check_unchanged(&before)?;
                done.written.push(parts.write(part, pass, results)?);
            }
            if pass + 1 < divided.passes() {
                match parts.read(pass) {
                    Ok(results) => earlier.push(results),
                    Err(missing @ PartsError::Missing { .. }) => {
                        done.waits_for = Some(missing.to_string());
                        break;
                    }
                    Err(error) => return Err(error.into()),
                }
            }
        }
        Ok(done)
    }

    /// What its tile `tile` (from 0) of one pass finds, as JSON, for a program that divides the work itself.
    ///
    /// # Errors
    /// An experiment without parts or with several passes, and what a run would refuse.
    pub fn run_tile(&self, tile: usize, progress: &dyn Progress) -> Result<String, InputError> {
        let divided = self.in_one_pass()?;
        if tile >= divided.tiles() {
            let message = format!("found tile {tile} of {}; allowed: below", divided.tiles());
            return Err(InputError::file(self.path(), message));
        }
        let input = self.watched_input(progress)?;
        let found = divided.pass(&self.context(&|| Ok(input.clone()), progress), tile..tile + 1, &[])?;
        serde_json::to_string(&found).map_err(|error| InputError::file(self.path(), error))
    }

    /// The number of its tiles.
    ///
    /// # Errors
    /// As [`Self::run_tile`].
    pub fn tiles(&self) -> Result<usize, InputError> {
        Ok(self.in_one_pass()?.tiles())
    }

    /// The results of a run, from what all its tiles have found, in their order.
    ///
    /// # Errors
    /// As [`Self::run_tile`], and what is no result of a tile.
    pub fn merge_tiles(
        &self,
        found: &[String],
        progress: &dyn Progress,
    ) -> Result<Box<dyn Outcome>, InputError> {
        let refuse = |error: &dyn std::fmt::Display| InputError::file(self.path(), error);
        let divided = self.in_one_pass()?;
        let tiles: Vec<Vec<TileResult>> = found
            .iter()
            .map(|text| serde_json::from_str(text))
            .collect::<Result<_, _>>()
            .map_err(|error| refuse(&error))?;
        let tiles: Vec<TileResult> = tiles.into_iter().flatten().collect();
        if tiles.len() != divided.tiles() {
            return Err(refuse(&format!("found {} tiles; allowed: all {}", tiles.len(), divided.tiles())));
        }
        let input = self.watched_input(progress)?;
        divided.merge(&self.context(&|| Ok(input.clone()), progress), &[tiles])
    }

    fn in_one_pass(&self) -> Result<&dyn AnyDivided, InputError> {
        let divided = self.divided()?;
        if divided.passes() == 1 {
            return Ok(divided);
        }
        let message =
            format!("found {} passes; allowed: a sweep, or [tiled] of a population", divided.passes());
        Err(InputError::file(self.path(), message))
    }

    /// The results of a run, from the parts in `folder`: the same to the bit as those of [`Self::run`].
    ///
    /// # Errors
    /// Parts that are missing or do not belong to this input and program.
    pub fn merge(&self, folder: &Path, progress: &dyn Progress) -> Result<Merged, PartError> {
        let divided = self.divided()?;
        let input = self.input_by(|path| KnownFiles { folder }.sha256(path))?;
        let key = self.key_of(&input);
        let parts = Parts::new(folder, self.stem(), &key, divided.tiles());
        let passes: Result<Vec<_>, _> = (0..divided.passes()).map(|pass| parts.read(pass)).collect();
        Ok(Merged { outcome: divided.merge(&self.context(&|| Ok(input.clone()), progress), &passes?)?, key })
    }
}
