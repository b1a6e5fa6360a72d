//! Measured points next to the spec.

use std::path::{Path, PathBuf};

use asperity::numeric::is_positive;
use asperity_contact_framework::input::{InputError, Source, Spanned};

use crate::surface::beside;

pub struct OverlayPlan {
    pub path: PathBuf,
    /// Indentation (m) and load (N), in file order.
    pub points: Vec<(f64, f64)>,
}

impl OverlayPlan {
    /// Reads a file next to the spec.
    pub(super) fn new(source: &Source, file: &Spanned<PathBuf>) -> Result<Self, InputError> {
        let path = beside(source, file)?;
        let points = points(&path)
            .map_err(|message| source.error_at(file.span(), format!("{}: {message}", path.display())))?;
        Ok(Self { path, points })
    }

    /// The largest indentation, m.
    pub fn deepest(&self) -> f64 {
        self.points.iter().map(|(w, _)| *w).fold(0.0, f64::max)
    }
}

/// Indentation (m) and load (N) from a CSV; lines that begin with `#` are comments, further columns are passed over.
fn points(path: &Path) -> Result<Vec<(f64, f64)>, String> {
    let reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_path(path);
    let mut reader = reader.map_err(|error| error.to_string())?;
    let header = reader.headers().map_err(|error| error.to_string())?.clone();
    let column = |name: &str| {
        header.iter().position(|found| found == name).ok_or_else(|| {
            let found = header.iter().collect::<Vec<_>>().join(", ");
            format!(
                "no column `{name}` (found: {found}); allowed: a header line with the columns indentation in m and load in N"
            )
        })
    };
    let columns = [("indentation", column("indentation")?), ("load", column("load")?)];
    let mut points = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| error.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let [w, load] = columns.map(|(name, index)| {
            let text = record.get(index).unwrap_or_default();
            text.parse().ok().filter(|value| is_positive(*value)).ok_or_else(|| {
                format!("line {line}, column `{name}`: found `{text}`; allowed: a positive finite number")
            })
        });
        points.push((w?, load?));
    }
    if points.is_empty() {
        return Err("no points: the table has no rows".to_owned());
    }
    Ok(points)
}
