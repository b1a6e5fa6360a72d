//! `[tiled]` resolved: laws, separations, one surface and its tiles.

use std::fmt;

use asperity::compare::Controls;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::sweep::LinearSweep;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::layer::LayerSpec;
use crate::study_plan::{RoughBody, SpotKeys, StudyKeys, StudyPlan};
use crate::surface::{SurfacePlan, SurfaceTiles};

/// Both models on a surface in tiles.
pub struct TiledPlan {
    pub study: StudyPlan,
    pub tiles: SurfaceTiles,
}

impl TiledPlan {
    pub fn surface(&self) -> &SurfacePlan {
        &self.study.surfaces[0]
    }

    /// d/sigma.
    pub fn separations(&self) -> &[f64] {
        &self.study.controls.separations
    }
}

impl fmt::Display for TiledPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.study)?;
        let count = self.tiles.count;
        let passes = if self.surface().nominal().is_some() { "one pass" } else { "two passes" };
        writeln!(f, "  {count} tiles, {passes}")
    }
}

pub(super) fn plan(file: &SpecFile, table: &Spanned<TiledSpec>) -> Result<TiledPlan, InputError> {
    let (raw, span) = (table.get_ref(), table.span());
    let elliptic = raw.law.get_ref().0.iter().find(|law| law.is_elliptic());
    if let Some(law) = elliptic {
        let message =
            format!("found {}, a law of ellipses; allowed in [tiled]: laws of spheres", law.label());
        return Err(file.source.error_at(raw.law.span(), message));
    }
    raw.layer.iter().try_for_each(|layer| layer.refuse_shear(&file.source))?;
    let surfaces = raw.surface.clone().map(|surface| vec![surface]);
    let study = StudyPlan::new(
        file,
        StudyKeys {
            table: span.clone(),
            rough: &raw.rough,
            flat: &raw.flat,
            law: &raw.law,
            layer: raw.layer.as_ref(),
            spots: SpotKeys::default(),
            statistical: None,
            accept: AcceptSpec::default(),
            surfaces: surfaces.as_deref(),
            controls: Controls { separations: raw.separation.get_ref().0.clone(), ..Controls::default() },
            nominal_area: None,
            load_keys: [None, None],
        },
    )?;
    study.check_summed(file, None)?;
    let [surface] = &study.surfaces[..] else {
        let names: Vec<&str> = study.surfaces.iter().map(|surface| surface.name.as_str()).collect();
        let message = format!(
            "found {} surfaces ({}); allowed: surface = \"NAME\" of one of them",
            names.len(),
            names.join(", ")
        );
        return Err(file.source.error_at(span, message));
    };
    let tiles = SurfaceTiles::new(surface, &file.source)?;
    Ok(TiledPlan { study, tiles })
}

/// Both models on one surface that may be larger than memory: it is summed tile by tile, in one process or on many machines (docs/clusters.md).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TiledSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<RoughBody>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact laws, of spheres.
    pub law: Spanned<Laws>,
    /// A layer on the flat or on the rough body, of one thickness or several.
    #[schemars(extend("x-default" = "none: both bodies are bare", "examples" = [{ "material": "lead", "thickness": [0, "50 nm", "1 um", "inf"] }]))]
    pub layer: Option<LayerSpec>,
    /// Separations at which the sum runs, d/sigma from the mean asperity height; the integral runs there and at the pressures of the sum.
    pub separation: Spanned<LinearSweep>,
    /// The surface, by name.
    #[schemars(extend("x-default" = "the only one of the file", "examples" = ["ground"]))]
    pub surface: Option<Spanned<String>>,
}
