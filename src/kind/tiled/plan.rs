//! `[tiled]` resolved: laws, separations, one surface and its tiles.

use std::fmt;

use asperity::compare::Controls;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};

use super::spec::TiledSpec;
use crate::study_plan::{SpotKeys, StudyKeys, StudyPlan};
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
