//! Run time against error: names resolved, sizes checked.

use std::fmt;
use std::ops::RangeInclusive;

use super::spec::{self, PrecisionSpec};
use crate::kind::boundary_elements::{PIXELS, check_range, whole};
use crate::precision::Case;
use crate::precision::sum::POINTS;
use crate::precision::surface::{SurfaceTask, side};
use crate::solver::sphere_points;
use crate::stability;
use asperity::study::LawContact;
use asperity::{ContactLaw, Flat, Heights, Population};
use asperity_contact_framework::contact::Bodies;
use asperity_contact_framework::input::quantity::Pure;
use asperity_contact_framework::input::sweep::LogSweep;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};

/// d/sigma within which rules and reference keep their digits.
const SEPARATIONS: RangeInclusive<f64> = -10.0..=35.0;

/// Run time against error of integrals, sums, surfaces and boundary elements.
pub struct PrecisionPlan {
    /// Names of the two bodies.
    pub bodies: Bodies,
    pub law: LawContact,
    /// Law and bodies for the reference of the integrals.
    pub exact: stability::Bodies,
    pub cases: Vec<Case>,
    /// d/sigma of the integrals; empty unless the spec requests them.
    pub separations: Vec<f64>,
    /// Sizes of the sets that are summed; empty unless the spec requests them.
    pub counts: Vec<usize>,
    pub surface: Option<SurfaceTask>,
    /// Pixels per contact radius of boundary elements; empty unless the spec requests them.
    pub pixels: Vec<usize>,
    /// Whether the largest sizes are included (`--huge`).
    pub huge: bool,
}

impl PrecisionPlan {
    /// Points of each kind of map.
    pub fn maps(&self) -> impl Iterator<Item = u128> {
        self.surface.iter().flat_map(SurfaceTask::kinds).map(|(_, size)| (side(size) as u128).pow(2))
    }

    /// Points along a side of each map of Hertz's contact, which is 2.5 contact radii.
    pub fn hertz(&self) -> impl Iterator<Item = usize> {
        self.pixels.iter().map(|&pixels| sphere_points(pixels))
    }

    /// Steps of its progress: pieces of work of very different size.
    pub fn steps(&self) -> u64 {
        let per_case = usize::from(!self.separations.is_empty()) + self.counts.len();
        let maps = self.surface.as_ref().map_or(0, |task| task.kinds().count() * task.realisations);
        (per_case * self.cases.len() + maps + usize::from(!self.pixels.is_empty())) as u64
    }
}

impl fmt::Display for PrecisionPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { bodies, law, counts, pixels, .. } = self;
        let names: Vec<&str> = self.cases.iter().map(|case| case.name.as_str()).collect();
        writeln!(f, "  {} on {}, law {}, {}", bodies.rough, bodies.flat, law.label, names.join(", "))?;
        if !self.separations.is_empty() {
            writeln!(f, "  quadrature rules at {} separations", self.separations.len())?;
        }
        if !counts.is_empty() {
            writeln!(f, "  sums of {counts:?} asperities at {POINTS} separations")?;
        }
        if let Some(SurfaceTask { per_length, lengths, realisations }) = &self.surface {
            writeln!(
                f,
                "  {realisations} maps of each size: {per_length:?} points per correlation length, {lengths:?} correlation lengths per side"
            )?;
        }
        if !pixels.is_empty() {
            writeln!(f, "  boundary elements at {pixels:?} pixels per contact radius")?;
        }
        Ok(())
    }
}

/// Reads `[precision]`.
pub(super) fn plan(
    file: &SpecFile,
    table: &Spanned<PrecisionSpec>,
    huge: bool,
) -> Result<PrecisionPlan, InputError> {
    let raw = table.get_ref();
    let (rough, flat) = (raw.rough.get_ref(), raw.flat.get_ref());
    let pair = [file.body(rough, raw.rough.span())?, file.body(flat, raw.flat.span())?];
    let (spec, law) = single_law(file, raw)?;
    file.check_laws(&raw.law, (rough, &pair[0]), &[(flat, &pair[1])])?;
    let contact = spec
        .interface(&pair[0], &Flat::Bare(pair[1]))
        .map_err(|error| file.inapplicable(&raw.law, &error, rough, flat))?;
    if raw.case.get_ref().is_empty() {
        let message =
            "found no case; allowed: at least one [precision.case.NAME] with radius, sigma and density";
        return Err(file.source.error_at(raw.case.span(), message));
    }
    let case = |(name, raw): (&Spanned<String>, &spec::CaseSpec)| Case {
        name: name.get_ref().clone(),
        population: Population {
            radius: raw.radius.value(),
            sigma: raw.sigma.value(),
            density: raw.density.value(),
            heights: Heights::GAUSSIAN,
        },
    };
    let separations = raw.integral.as_ref().map(|raw| separations(file, raw));
    let pixels = raw.reference.as_ref().map(|raw| pixels(file, &raw.pixels));
    let plan = PrecisionPlan {
        bodies: Bodies { rough: rough.clone(), flat: flat.clone() },
        exact: stability::Bodies { law, rough: pair[0], flat: pair[1], layer: None },
        law: LawContact { label: spec.label(), thickness: None, contact, spec },
        cases: raw.case.get_ref().iter().map(case).collect(),
        separations: separations.transpose()?.unwrap_or_default(),
        counts: raw.sum.as_ref().map(|raw| counts(file, raw, huge)).transpose()?.unwrap_or_default(),
        surface: raw.surface.as_ref().map(|raw| surface(file, raw)).transpose()?,
        pixels: pixels.transpose()?.unwrap_or_default(),
        huge,
    };
    if plan.steps() == 0 {
        let message = "found nothing to measure; allowed: at least one of [precision.integral], [precision.sum], \
                       [precision.surface], [precision.reference]";
        return Err(file.source.error_at(table.span(), message));
    }
    Ok(plan)
}

/// The law, and the same with its reference.
fn single_law(
    file: &SpecFile,
    raw: &PrecisionSpec,
) -> Result<(ContactLaw, stability::CoveredLaw), InputError> {
    let [law] = &raw.law.get_ref().0[..] else {
        let message = format!("found {} laws; allowed: one", raw.law.get_ref().0.len());
        return Err(file.source.error_at(raw.law.span(), message));
    };
    file.spheres_only(&raw.law, "the asperities of [precision] are spheres of equal radius")?;
    let covered = stability::CoveredLaw::new(law).ok_or_else(|| {
        let [covered, _] = stability::CoveredLaw::coverage();
        let message = format!(
            "found \"{}\", whose equations are not known in extended precision, which the reference needs; allowed: {}",
            law.name(),
            covered.join(", ")
        );
        file.source.error_at(raw.law.span(), message)
    })?;
    Ok((law.clone(), covered))
}

fn separations(file: &SpecFile, raw: &spec::IntegralSpec) -> Result<Vec<f64>, InputError> {
    let separations = &raw.separation.get_ref().0;
    check_range(file, raw.separation.span(), separations, &SEPARATIONS, "separations of {} sigma")?;
    Ok(separations.clone())
}

/// Sizes, ascending: the largest only where they are asked for.
fn counts(file: &SpecFile, raw: &spec::SumSpec, huge: bool) -> Result<Vec<usize>, InputError> {
    let mut counts = file.counts(&raw.count)?;
    let further = raw.huge_count.as_ref().map(|further| file.counts(further)).transpose()?;
    counts.extend(further.filter(|_| huge).into_iter().flatten());
    counts.sort_unstable();
    counts.dedup();
    Ok(counts)
}

fn pixels(file: &SpecFile, raw: &Spanned<LogSweep<Pure>>) -> Result<Vec<usize>, InputError> {
    let values = ascending(raw);
    check_range(file, raw.span(), &values, &PIXELS, "{} pixels per contact radius")?;
    Ok(whole(&values))
}

fn ascending(raw: &Spanned<LogSweep<Pure>>) -> Vec<f64> {
    let mut values = raw.get_ref().values.clone();
    values.sort_by(f64::total_cmp);
    values
}

fn surface(file: &SpecFile, raw: &spec::SurfaceSpec) -> Result<SurfaceTask, InputError> {
    /// Points along a side.
    const MOST: usize = 1 << 14;
    let (per_length, lengths) = (ascending(&raw.points_per_length), ascending(&raw.lengths));
    if per_length[0] < 1.0 {
        let message = format!("found {}; allowed: at least one point per correlation length", per_length[0]);
        return Err(file.source.error_at(raw.points_per_length.span(), message));
    }
    if lengths[0] < 10.0 {
        let message = format!("found {}; allowed: sides of at least 10 correlation lengths", lengths[0]);
        return Err(file.source.error_at(raw.lengths.span(), message));
    }
    let realisations = file.several(&raw.realisations, "maps of each size")?;
    let task = SurfaceTask { per_length, lengths, realisations };
    let largest = task.kinds().map(|(_, size)| side(size)).max().unwrap_or(0);
    if largest > MOST {
        let message = format!(
            "found maps of up to {largest} x {largest} points; allowed: at most {MOST} points along a side, which is lengths \
             times points-per-length"
        );
        return Err(file.source.error_at(raw.lengths.span(), message));
    }
    Ok(task)
}
