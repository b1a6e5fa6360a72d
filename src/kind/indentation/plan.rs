//! A sphere on layers: names resolved, measured points read.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::kind::indentation::spec::{IndentationSpec, Show};
use crate::layer::{LayerPlan, layer};
use crate::surface::beside;
use asperity::numeric::is_positive;
use asperity::{ContactLaw, Inapplicable, Material};
use asperity_framework::input::Spanned;
use asperity_framework::input::SpecFile;
use asperity_framework::input::{InputError, Source};

/// One sphere on layered flats.
pub struct IndentationPlan {
    /// Name of the ball's material, and the material.
    pub ball: (String, Material),
    /// Of the ball, m.
    pub radius: f64,
    /// Name of the substrate's material, and the material.
    pub flat: (String, Material),
    /// The layers, each in thicknesses that are positive and finite.
    pub layers: Vec<LayerPlan>,
    pub laws: Vec<ContactLaw>,
    /// m, ascending, at least two, none beyond the radius.
    pub indentations: Vec<f64>,
    /// Measured points, where there are some.
    pub overlay: Option<OverlayPlan>,
    /// Axes of the load figure.
    pub show: Show,
}

pub struct OverlayPlan {
    /// The file that they are from, as the spec names it.
    pub name: String,
    /// Where it is.
    pub path: PathBuf,
    /// Indentation (m) and load (N), in file order.
    pub points: Vec<(f64, f64)>,
}

impl IndentationPlan {
    /// Number of layers, each thickness by itself.
    pub fn cases(&self) -> usize {
        self.layers.iter().map(|layer| layer.thicknesses.len()).sum()
    }

    /// Micro-contacts that are evaluated, each exact one counted as one.
    pub fn work(&self) -> u128 {
        /// Uncoated, coated, all layer; plus the exact contact and both effective-modulus models.
        const CURVES: usize = 3;
        let a_case = CURVES * (self.laws.len() + 1) * self.indentations.len();
        a_case as u128 * self.cases() as u128
    }

    /// What the points of all curves need, bytes.
    pub fn memory(&self) -> u128 {
        const BYTES: u128 = 64;
        self.work() * BYTES
    }
}

impl fmt::Display for IndentationPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let laws: Vec<String> = self.laws.iter().map(ContactLaw::label).collect();
        writeln!(
            f,
            "  a ball of {}, radius {:e} m, on {}, law {}",
            self.ball.0,
            self.radius,
            self.flat.0,
            laws.join(", ")
        )?;
        for layer in &self.layers {
            let thicknesses: Vec<String> = layer.thicknesses.iter().map(|t| format!("{t:e}")).collect();
            writeln!(f, "  layer {}: {} m, rule {}", layer.name, thicknesses.join(", "), layer.rule.name())?;
        }
        let count = self.indentations.len();
        writeln!(
            f,
            "  {count} indentations from {:e} to {:e} m",
            self.indentations[0],
            self.indentations[count - 1]
        )?;
        match &self.overlay {
            Some(overlay) => {
                writeln!(f, "  {} measured points in {}", overlay.points.len(), overlay.path.display())
            }
            None => Ok(()),
        }
    }
}

/// Reads `[indentation]`.
pub(super) fn plan(file: &SpecFile, table: &Spanned<IndentationSpec>) -> Result<IndentationPlan, InputError> {
    let raw = table.get_ref();
    let body = |name: &Spanned<String>| Ok((name.get_ref().clone(), file.body(name.get_ref(), name.span())?));
    let (ball, flat) = (body(&raw.ball)?, body(&raw.flat)?);
    let radius = raw.radius.value();
    let layers = raw.layer.get_ref().0.iter().map(|raw| layer(file, raw, &flat.1));
    let layers = layers.collect::<Result<Vec<_>, _>>()?;
    check_layers(file, raw, &layers)?;
    let indentations = file.growing(&raw.indentation)?;
    let last = indentations[indentations.len() - 1];
    if last > radius {
        let message =
            format!("found an indentation of {last:e} m; allowed: at most the radius, {radius:e} m");
        return Err(file.source.error_at(raw.indentation.span(), message));
    }
    file.spheres_only(&raw.law, "a ball is a sphere")?;
    let flat_materials = layers.iter().map(|layer| (layer.name.as_str(), &layer.coating.material));
    let flat_materials: Vec<_> = std::iter::once((flat.0.as_str(), &flat.1)).chain(flat_materials).collect();
    file.check_laws(&raw.law, (&ball.0, &ball.1), &flat_materials)?;
    // Each layer is of finite thickness.
    let coated = layers[0].coating.flat(layers[0].thicknesses[0]);
    let coated = coated.map_err(|error| InputError::file(&file.source.path, error))?;
    for law in &raw.law.get_ref().0 {
        law.interface(&ball.1, &coated).map_err(|error| match error {
            Inapplicable::Layer { law } => {
                let message = format!(
                    "found law {law}, which is not defined under a layer; allowed: a law that is ([laws] shows one asperity without \
                     a layer)"
                );
                file.source.error_at(raw.law.span(), message)
            }
            _ => file.inapplicable(&raw.law, &error, &ball.0, &flat.0),
        })?;
    }
    let plan = IndentationPlan {
        ball,
        radius,
        flat,
        layers,
        laws: raw.law.get_ref().0.clone(),
        indentations,
        overlay: raw.overlay.as_ref().map(|measured| overlay(&file.source, measured)).transpose()?,
        show: raw.show,
    };
    let deepest =
        plan.overlay.iter().flat_map(|overlay| &overlay.points).map(|(w, _)| *w).fold(0.0, f64::max);
    match &raw.overlay {
        Some(measured) if deepest > radius => {
            let message = format!(
                "found a measured indentation of {deepest:e} m; allowed: at most the radius, {radius:e} m (the columns are in m and N)"
            );
            Err(file.source.error_at(measured.span(), message))
        }
        Some(measured) if plan.cases() > 1 => {
            let message = format!(
                "found measured points with {} layers; allowed: a single layer of one thickness",
                plan.cases()
            );
            Err(file.source.error_at(measured.span(), message))
        }
        _ => Ok(plan),
    }
}

/// The uncoated flat and the bulk layer material are always included.
fn check_layers(file: &SpecFile, raw: &IndentationSpec, layers: &[LayerPlan]) -> Result<(), InputError> {
    let refuse = |message: String| Err(file.source.error_at(raw.layer.span(), message));
    for (k, layer) in layers.iter().enumerate() {
        if let Some(t) = layer.thicknesses.iter().find(|t| !is_positive(**t)) {
            return refuse(format!(
                "layer {}: found a thickness of {t}; allowed: positive and finite (the uncoated flat and the bulk layer \
                 material are always shown too)",
                layer.name
            ));
        }
        let same = |other: &LayerPlan| {
            (&other.name, other.rule) == (&layer.name, layer.rule)
                && other.thicknesses.iter().any(|t| layer.thicknesses.contains(t))
        };
        if layers[..k].iter().any(same) {
            return refuse(format!(
                "found layer {} twice with the same thickness; allowed: once",
                layer.name
            ));
        }
    }
    Ok(())
}

/// Reads measured points from a file next to the spec.
fn overlay(source: &Source, file: &Spanned<PathBuf>) -> Result<OverlayPlan, InputError> {
    let path = beside(source, file)?;
    let points = read_points(&path)
        .map_err(|message| source.error_at(file.span(), format!("{}: {message}", path.display())))?;
    Ok(OverlayPlan { name: file.get_ref().to_string_lossy().into_owned(), path, points })
}

/// Indentation (m) and load (N) from a CSV; lines that begin with `#` are comments, further columns are passed over.
fn read_points(path: &Path) -> Result<Vec<(f64, f64)>, String> {
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
