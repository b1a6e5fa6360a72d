//! The measured files of a run: each is read once, however many surfaces are found in it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use asperity::npy::NpyError;
use asperity::progress::Progress;
use asperity::topography::Rows;
use asperity::topography::read::{LengthUnits, MapFile, Marks, ReadError};
use asperity::units::Dimension;
use asperity::work::{Counter, Item};
use asperity::{AsperityList, HeightMap, ListError, ListOptions};
use asperity_contact_framework::input::{Forms, schema};
use asperity_contact_framework::written_schema;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};
use serde_json::json;

use super::spec::UnitSpec;

/// What a surface is found in.
#[derive(Debug, Clone, PartialEq)]
pub enum Reading {
    /// A list of asperities.
    List(PathBuf, ListOptions),
    Map(MapFile),
}

impl Reading {
    pub fn list(path: &Path, given: ListOptions) -> Self {
        Self::List(whole(path), given)
    }

    pub fn map(file: &MapFile) -> Self {
        Self::Map(MapFile { path: whole(&file.path), ..file.clone() })
    }
}

/// Whether a map of so many points along x and y is copied into memory even where it could be read row by row: each treatment reads it
/// several times.
pub fn is_copied([nx, ny]: [usize; 2]) -> bool {
    const MOST: usize = 1 << 21;
    nx * ny <= MOST
}

/// A path that is the same for all ways to a file.
fn whole(path: &Path) -> PathBuf {
    std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}

/// What was read, as long as a surface that is yet to be made needs it again.
pub struct Files<'a> {
    awaited: Vec<Reading>,
    lists: Vec<(Reading, Arc<AsperityList>)>,
    maps: Vec<(Reading, Arc<dyn Rows>)>,
    counter: &'a Counter,
}

impl<'a> Files<'a> {
    /// The files of surfaces that will be made of `awaited`.
    pub fn new(awaited: Vec<Reading>, counter: &'a Counter) -> Self {
        Self { awaited, lists: Vec::new(), maps: Vec::new(), counter }
    }

    /// The list at `path`.
    pub fn list(
        &mut self,
        path: &Path,
        given: ListOptions,
        progress: &dyn Progress,
    ) -> Result<AsperityList, ListError> {
        let reading = Reading::list(path, given);
        let is_needed_again = self.take(&reading);
        let read = || {
            self.counter.add(Item::Files, 1);
            AsperityList::read(path, given, progress).map(Arc::new)
        };
        let list = once(&mut self.lists, reading, is_needed_again, read)?;
        Ok(Arc::unwrap_or_clone(list))
    }

    pub fn map(&mut self, file: &MapFile, progress: &dyn Progress) -> Result<Arc<dyn Rows>, ReadError> {
        let reading = Reading::map(file);
        let is_needed_again = self.take(&reading);
        let read = || -> Result<Arc<dyn Rows>, ReadError> {
            self.counter.add(Item::Files, 1);
            let map = file.rows(progress)?;
            if !is_copied(map.points()) || map.block(0..1).is_some() {
                return Ok(Arc::from(map));
            }
            let copy = HeightMap::from_rows(&*map);
            if map.is_whole() { Ok(Arc::new(copy)) } else { Err(ReadError::from(NpyError::Shortened)) }
        };
        once(&mut self.maps, reading, is_needed_again, read)
    }

    /// Awaits a reading once less, and says whether it is still awaited.
    fn take(&mut self, reading: &Reading) -> bool {
        if let Some(place) = self.awaited.iter().position(|awaited| awaited == reading) {
            self.awaited.swap_remove(place);
        }
        self.awaited.contains(reading)
    }
}

/// What `kept` holds of a reading, else what `read` finds; it is kept where it `is_needed_again`.
fn once<T: ?Sized, E>(
    kept: &mut Vec<(Reading, Arc<T>)>,
    reading: Reading,
    is_needed_again: bool,
    read: impl FnOnce() -> Result<Arc<T>, E>,
) -> Result<Arc<T>, E> {
    let content = match kept.iter().position(|(known, _)| *known == reading) {
        Some(place) => kept.swap_remove(place).1,
        None => read()?,
    };
    if is_needed_again {
        kept.push((reading, Arc::clone(&content)));
    }
    Ok(content)
}

/// `unit` of a map: one of all lengths, or one of coordinates and one of heights.
#[derive(Debug, Clone, Copy)]
pub struct MapUnitSpec(pub LengthUnits);

/// Units of coordinates and heights.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { xy, z }")]
struct Both {
    /// Unit of x and y.
    xy: UnitSpec,
    /// Unit of heights.
    z: UnitSpec,
}

written_schema!(MapUnitSpec, |generator| {
    let one = UnitSpec::json_schema(generator);
    let both = Both::json_schema(generator);
    json!({
        "anyOf": [one, both],
        schema::TYPE: "unit of length, or a table of two: xy and z",
        schema::RANGE: Dimension::Length.documented().join(", "),
    })
});

impl<'de> Deserialize<'de> for MapUnitSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Forms::new("a unit of length such as \"um\", or { xy = \"um\", z = \"nm\" }")
            .text(|text| UnitSpec::try_from(text.to_owned()).map(|unit| Self(LengthUnits::same(unit.0))))
            .table(|Both { xy, z }| Ok(Self(LengthUnits { xy: xy.0, z: z.0 })))
            .read(deserializer)
    }
}

/// `missing`: heights that mark missing points, in the unit of the file, and words of a text that do.
#[derive(Debug, Clone)]
pub struct MissingSpec(pub Marks);

written_schema!(MissingSpec, |_| {
    let one = json!({ "type": ["number", "string"] });
    let kind = "number or word, or a list of them";
    json!({ "anyOf": [one, { "type": "array", "items": one }], schema::TYPE: kind })
});

/// A height or a word.
#[derive(Deserialize)]
#[serde(untagged, expecting = "a number or a word")]
enum Mark {
    Height(f64),
    Word(String),
}

impl<'de> Deserialize<'de> for MissingSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a number such as -9999, a word such as \"***\", or a list of them; [] where every number is a height";
        let found = Forms::new(expected)
            .number(|value, _| Ok(vec![Mark::Height(value)]))
            .text(|word| Ok(vec![Mark::Word(word.to_owned())]))
            .list(Ok)
            .read(deserializer)?;
        let mut marks = Marks::default();
        for mark in found {
            match mark {
                Mark::Height(height) if height.is_finite() => marks.heights.push(height),
                Mark::Word(word) if !word.trim().is_empty() => marks.words.push(word.trim().to_owned()),
                _ => {
                    return Err(serde::de::Error::custom(
                        "found NaN, an infinite height or an empty word, which are missing points in any case; allowed: finite numbers and words",
                    ));
                }
            }
        }
        Ok(Self(marks))
    }
}
