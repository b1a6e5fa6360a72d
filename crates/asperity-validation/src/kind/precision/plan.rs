//! Run time against error: names resolved, sizes checked.

use std::fmt;

use super::spec::{self, PrecisionSpec};
use crate::precision::attribution::{AttributionTask, MULTIPLIED};
use crate::precision::curve::CurveTask;
use crate::precision::grid::{GridTask, side};
use crate::precision::list::ListTask;
use crate::precision::sampling::SamplingTask;
use crate::precision::sum::{POINTS, SumTask};
use crate::stability;
use asperity::{ContactLaw, Flat, Heights, Population};
use asperity_framework::contact::Bodies;
use asperity_framework::contact::LawPlan;
use asperity_framework::input::InputError;
use asperity_framework::input::Spanned;
use asperity_framework::input::SpecFile;
use asperity_framework::input::Whole;
use asperity_framework::input::quantity::Pure;
use asperity_framework::input::sweep::LogSweep;
use asperity_framework::input::tolerance::TOLERANCES;
use asperity_framework::set_memory;

/// Of one curve.
const MOST_SEPARATIONS: u64 = 100_000;

/// Of one set: what memory holds is looked at besides.
const MOST_ASPERITIES: u64 = 1_000_000_000_000;

/// Run time against error of integrals, sums and surfaces.
pub struct PrecisionPlan {
    /// Names of the two bodies.
    pub bodies: Bodies,
    pub law: LawPlan,
    /// Law and bodies for the reference.
    pub exact: stability::Bodies,
    /// Populations by name.
    pub cases: Vec<(String, Population)>,
    /// d/sigma of the integrals; empty unless the spec requests them.
    pub separations: Vec<f64>,
    pub sum: Option<SumTask>,
    /// Curves within a tolerance.
    pub curve: Option<CurveTask>,
    /// Lists in files.
    pub list: Option<ListTask>,
    /// Differences divided among their causes.
    pub attribution: Option<AttributionTask>,
    pub sampling: Option<SamplingTask>,
    pub grid: Option<GridTask>,
    /// Whether the largest sizes are included (`--full`).
    pub full: bool,
}

impl PrecisionPlan {
    /// Bytes at the peak.
    pub fn memory(&self) -> u128 {
        /// The map, its half spectrum, and what finding summits takes.
        const BYTES_PER_POINT: u128 = 32;
        let sets = [
            self.sum.as_ref().map(|task| &task.counts),
            self.list.as_ref().map(|task| &task.counts),
            self.attribution.as_ref().map(|task| &task.counts),
            self.sampling.as_ref().map(|task| &task.counts),
        ];
        let asperities = sets.into_iter().flatten().flatten();
        let curve = self.curve.iter().map(|task| &task.asperities);
        let asperities = asperities.chain(curve).max().copied().unwrap_or(0);
        let points = self.grid.iter().flat_map(maps).max().unwrap_or(0);
        set_memory(asperities as u128).max(points * BYTES_PER_POINT)
    }

    /// Contacts evaluated in one pass over everything.
    pub fn work(&self) -> u128 {
        let sums = self.sum.iter().map(|task| task.counts.iter().sum::<usize>() * POINTS);
        let sets = self
            .sampling
            .iter()
            .map(|task| task.counts.iter().sum::<usize>() * task.separations.len() * task.draws);
        let lists = self.list.iter().map(|task| task.counts.iter().sum::<usize>() * task.separations);
        let curves =
            self.curve.iter().map(|task| task.asperities * task.separations * (1 + task.tolerances.len()));
        let attributions = self
            .attribution
            .iter()
            .map(|task| task.counts.iter().sum::<usize>() * task.loads + MULTIPLIED * MULTIPLIED);
        sums.chain(curves)
            .chain(lists)
            .chain(attributions)
            .chain(sets)
            .map(|contacts| (contacts * self.cases.len()) as u128)
            .sum()
    }

    /// Steps of its progress: pieces of work of very different size.
    pub fn steps(&self) -> u64 {
        let of_case = u64::from(!self.separations.is_empty())
            + self.sum.as_ref().map_or(0, |task| task.counts.len() as u64)
            + u64::from(self.curve.is_some())
            + self.list.as_ref().map_or(0, |task| task.counts.len() as u64)
            + self.attribution.as_ref().map_or(0, |task| task.counts.len() as u64)
            + self.sampling.as_ref().map_or(0, |task| (task.counts.len() * (task.draws + 1)) as u64);
        let maps = self.grid.as_ref().map_or(0, |task| maps(task).count() * task.realisations);
        of_case * self.cases.len() as u64 + maps as u64
    }
}

/// Points of each kind of map.
fn maps(task: &GridTask) -> impl Iterator<Item = u128> {
    let sides = task.per_length.iter().flat_map(|&p| task.lengths.iter().map(move |&l| side(p, l) as u128));
    sides.map(|side| side * side)
}

impl fmt::Display for PrecisionPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let names: Vec<&str> = self.cases.iter().map(|(name, _)| name.as_str()).collect();
        writeln!(
            f,
            "  {} on {}, law {}, {}",
            self.bodies.rough,
            self.bodies.flat,
            self.law.label,
            names.join(", ")
        )?;
        if !self.separations.is_empty() {
            writeln!(f, "  quadrature rules at {} separations", self.separations.len())?;
        }
        if let Some(task) = &self.sum {
            writeln!(
                f,
                "  sums of {:?} asperities, at {:?} separations, on {:?} threads",
                task.counts, task.separations, task.threads
            )?;
        }
        if let Some(task) = &self.curve {
            writeln!(
                f,
                "  curves of {} separations, the sum of {} asperities, exactly and within {} tolerances",
                task.separations,
                task.asperities,
                task.tolerances.len()
            )?;
        }
        if let Some(task) = &self.list {
            writeln!(
                f,
                "  lists of {:?} asperities, written to {} and read, at {} separations",
                task.counts,
                std::env::temp_dir().display(),
                task.separations
            )?;
        }
        if let Some(task) = &self.attribution {
            writeln!(
                f,
                "  causes of the difference of {:?} asperities at {} loads",
                task.counts, task.loads
            )?;
        }
        if let Some(task) = &self.sampling {
            writeln!(f, "  {} random sets for each size, {:?} asperities", task.draws, task.counts)?;
        }
        if let Some(task) = &self.grid {
            writeln!(
                f,
                "  {} maps of each size: {:?} points per correlation length, {:?} correlation lengths per side",
                task.realisations, task.per_length, task.lengths
            )?;
        }
        Ok(())
    }
}

/// Reads `[precision]`.
pub(super) fn plan(
    file: &SpecFile,
    table: &Spanned<PrecisionSpec>,
    full: bool,
) -> Result<PrecisionPlan, InputError> {
    let (raw, span) = (table.get_ref(), table.span());
    let (rough, flat) = (raw.rough.get_ref(), raw.flat.get_ref());
    let pair = [file.body(rough, raw.rough.span())?, file.body(flat, raw.flat.span())?];
    let (spec, law) = one_law(file, raw)?;
    file.check_laws(&raw.law, (rough, &pair[0]), &[(flat, &pair[1])])?;
    let contact = spec
        .interface(&pair[0], &Flat::Bare(pair[1]))
        .map_err(|error| file.inapplicable(&raw.law, &error, rough, flat))?;
    if raw.case.get_ref().is_empty() {
        let message =
            "found no case; allowed: at least one [precision.case.NAME] with radius, sigma and density";
        return Err(file.source.error_at(raw.case.span(), message));
    }
    let case = |(name, raw): (&Spanned<String>, &spec::CaseSpec)| {
        let population = Population {
            radius: raw.radius.value(),
            sigma: raw.sigma.value(),
            density: raw.density.value(),
            heights: Heights::GAUSSIAN,
        };
        (name.get_ref().clone(), population)
    };
    let plan = PrecisionPlan {
        bodies: Bodies { rough: rough.clone(), flat: flat.clone() },
        exact: stability::Bodies { law, rough: pair[0], flat: pair[1], layer: None },
        law: LawPlan { label: spec.label(), thickness: None, contact, spec },
        cases: raw.case.get_ref().iter().map(case).collect(),
        separations: raw.integral.as_ref().map(|raw| separations(file, raw)).transpose()?.unwrap_or_default(),
        sum: raw.sum.as_ref().map(|raw| sum(file, raw, full)).transpose()?,
        curve: raw.curve.as_ref().map(|raw| curve(file, raw)).transpose()?,
        list: raw.list.as_ref().map(|raw| lists(file, raw, full)).transpose()?,
        attribution: raw.attribution.as_ref().map(|raw| attribution(file, raw)).transpose()?,
        sampling: raw.sampling.as_ref().map(|raw| sampling(file, raw)).transpose()?,
        grid: raw.grid.as_ref().map(|raw| grid(file, raw)).transpose()?,
        full,
    };
    if plan.steps() == 0 {
        let message = "found nothing to measure; allowed: at least one of [precision.integral], [precision.sum], \
                       [precision.curve], [precision.list], [precision.attribution], [precision.sampling], \
                       [precision.grid]";
        return Err(file.source.error_at(span, message));
    }
    Ok(plan)
}

/// The one law, and the same with its reference.
fn one_law(file: &SpecFile, raw: &PrecisionSpec) -> Result<(ContactLaw, stability::CoveredLaw), InputError> {
    let [law] = &raw.law.get_ref().0[..] else {
        let message = format!("found {} laws; allowed: one", raw.law.get_ref().0.len());
        return Err(file.source.error_at(raw.law.span(), message));
    };
    file.spheres_only(&raw.law, "the asperities of [precision] are spheres of equal radius")?;
    let covered = stability::CoveredLaw::of(law).ok_or_else(|| {
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
    /// Of d/sigma: within them rules and reference keep their digits.
    const WITHIN: [f64; 2] = [-10.0, 35.0];
    let separations = &raw.separation.get_ref().0;
    match separations.iter().find(|h| !(WITHIN[0]..=WITHIN[1]).contains(*h)) {
        Some(h) => {
            let message = format!("found {h}; allowed: separations of {} to {} sigma", WITHIN[0], WITHIN[1]);
            Err(file.source.error_at(raw.separation.span(), message))
        }
        None => Ok(separations.clone()),
    }
}

/// Sizes, ascending: the largest only in full.
fn sizes(
    file: &SpecFile,
    always: &Spanned<LogSweep<Pure>>,
    in_full: Option<&Spanned<LogSweep<Pure>>>,
    full: bool,
) -> Result<Vec<usize>, InputError> {
    let mut counts = file.counts(always)?;
    if let Some(more) = in_full {
        let more = file.counts(more)?;
        if full {
            counts.extend(more);
        }
    }
    counts.sort_unstable();
    counts.dedup();
    Ok(counts)
}

/// One whole number from `least` to `most`.
fn one_of(
    file: &SpecFile,
    raw: &Spanned<Whole>,
    what: &str,
    [least, most]: [u64; 2],
) -> Result<usize, InputError> {
    let Whole(found) = *raw.get_ref();
    let is_allowed = (least..=most).contains(&found);
    let value = usize::try_from(found).ok().filter(|_| is_allowed);
    value.ok_or_else(|| {
        let message = format!("found {found}; allowed: {least} to {most} {what}");
        file.source.error_at(raw.span(), message)
    })
}

fn curve(file: &SpecFile, raw: &spec::CurveSpec) -> Result<CurveTask, InputError> {
    let mut tolerances = raw.tolerance.get_ref().values.clone();
    tolerances.sort_by(f64::total_cmp);
    let [least, most] = TOLERANCES;
    if let Some(tolerance) = tolerances.iter().find(|tolerance| !(least..=most).contains(*tolerance)) {
        let message = format!("found the tolerance {tolerance:e}; allowed: {least:e} to {most}");
        return Err(file.source.error_at(raw.tolerance.span(), message));
    }
    Ok(CurveTask {
        asperities: one_of(file, &raw.asperities, "asperities", [1, MOST_ASPERITIES])?,
        separations: one_of(file, &raw.separations, "separations", [2, MOST_SEPARATIONS])?,
        tolerances,
    })
}

fn lists(file: &SpecFile, raw: &spec::ListsSpec, full: bool) -> Result<ListTask, InputError> {
    Ok(ListTask {
        counts: sizes(file, &raw.count, raw.full_count.as_ref(), full)?,
        separations: one_of(file, &raw.separations, "separations", [1, MOST_SEPARATIONS])?,
    })
}

fn attribution(file: &SpecFile, raw: &spec::AttributionSpec) -> Result<AttributionTask, InputError> {
    /// Fewer do not hold 30 contacts at all loads.
    const FEWEST: usize = 2000;
    const MOST_LOADS: u64 = 1000;
    let counts = sizes(file, &raw.count, None, false)?;
    if let Some(count) = counts.iter().find(|&&count| count < FEWEST) {
        let message = format!(
            "found {count}; allowed: at least {FEWEST} asperities, whose contacts can be divided at every load"
        );
        return Err(file.source.error_at(raw.count.span(), message));
    }
    Ok(AttributionTask { counts, loads: one_of(file, &raw.loads, "loads", [2, MOST_LOADS])? })
}

fn sum(file: &SpecFile, raw: &spec::SumSpec, full: bool) -> Result<SumTask, InputError> {
    const MOST_THREADS: f64 = 1024.0;
    let most_for_threads = file.counts(&raw.count)?.into_iter().max().unwrap_or(0);
    Ok(SumTask {
        counts: sizes(file, &raw.count, raw.full_count.as_ref(), full)?,
        separations: file.whole(&raw.separations, "separations", MOST_SEPARATIONS as f64)?,
        threads: file.whole(&raw.threads, "threads", MOST_THREADS)?,
        most_for_threads,
    })
}

fn sampling(file: &SpecFile, raw: &spec::SamplingSpec) -> Result<SamplingTask, InputError> {
    let mut counts = file.counts(&raw.count)?;
    counts.sort_unstable();
    Ok(SamplingTask {
        counts,
        separations: raw.separation.0.clone(),
        draws: file.several(&raw.draws, "random sets of each size")?,
    })
}

fn grid(file: &SpecFile, raw: &spec::GridSpec) -> Result<GridTask, InputError> {
    /// Points along a side.
    const MOST: usize = 1 << 14;
    let sorted = |sweep: &Spanned<LogSweep<_>>| {
        let mut values = sweep.get_ref().values.clone();
        values.sort_by(f64::total_cmp);
        values
    };
    let (per_length, lengths) = (sorted(&raw.points_per_length), sorted(&raw.lengths));
    if per_length[0] < 1.0 {
        let message = format!("found {}; allowed: at least one point per correlation length", per_length[0]);
        return Err(file.source.error_at(raw.points_per_length.span(), message));
    }
    if lengths[0] < 10.0 {
        let message = format!("found {}; allowed: sides of at least 10 correlation lengths", lengths[0]);
        return Err(file.source.error_at(raw.lengths.span(), message));
    }
    let largest = side(per_length[per_length.len() - 1], lengths[lengths.len() - 1]);
    if largest > MOST {
        let message = format!(
            "found maps of up to {largest} x {largest} points; allowed: at most {MOST} points along a side, which is lengths \
             times points-per-length"
        );
        return Err(file.source.error_at(raw.lengths.span(), message));
    }
    let realisations = file.several(&raw.realisations, "maps of each size")?;
    Ok(GridTask { per_length, lengths, realisations })
}
