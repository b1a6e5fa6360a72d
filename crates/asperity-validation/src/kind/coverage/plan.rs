//! Windows and processes, resolved and checked.

use std::fmt;

use super::spec::{AgainstSpec, CaseSpec, CoverageSpec, Intervals, PlateauSpec, SpikesSpec};
use crate::coverage::{EndlessProcess, Patches, PlantedSpikes, Roughness, SecondBody, WINDOWS_PER_MAP};
use asperity::spot::{Conduction, SpotProperties};
use asperity::study::LawContact;
use asperity::topography::generate::{Plateau, Process, SpectrumOf};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumError, SpectrumShape};
use asperity::{Flat, Heights, MicroContact, WithSpots};
use asperity_contact_framework::contact::Bodies;
use asperity_contact_framework::report::format::input_quantity;

use asperity_contact_framework::input::quantity::Pure;
use asperity_contact_framework::input::sweep::LogSweep;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile, Whole};

/// Points along a side: fewer hold no 16 blocks with summits, and of more the program examines every other one for the
/// correlation length.
const POINTS: [u64; 2] = [64, 1024];
/// Windows of a case.
const WINDOWS: [u64; 2] = [8, 100_000];
/// Windows with spikes, and how many of them.
const SPIKED_WINDOWS: [u64; 2] = [4, 100_000];
const SPIKES: [u64; 2] = [1, 10_000];
/// Heights of spikes in robust standard deviations.
const DEVIATIONS: [f64; 2] = [1.0, 1000.0];
/// Standard deviations of the logarithm of an amplitude.
const MODULATIONS: [f64; 2] = [0.0, 1.0];
/// Relative positions of two bodies.
const SHIFTS: [u64; 2] = [1, 1000];
/// Effective contacts of a load.
const CONTACTS: [f64; 2] = [1.0, 1e6];

/// Coverage of intervals over windows of random processes.
pub struct CoveragePlan {
    /// Names of the two bodies.
    pub bodies: Bodies,
    pub law: LawContact,
    /// The same micro-contact between bodies that conduct.
    pub conducting: Box<dyn MicroContact>,
    pub windows: WindowPlan,
    /// Which intervals are claimed.
    pub intervals: Intervals,
    pub cases: Vec<CasePlan>,
    pub spikes: Option<SpikesPlan>,
    /// The seed of the spec.
    pub seed: u64,
}

/// Spikes planted in windows of a case.
pub struct SpikesPlan {
    /// Index of the case.
    pub case: usize,
    /// Every number with every height.
    pub planted: Vec<PlantedSpikes>,
    /// Maps, of which each gives [`WINDOWS_PER_MAP`] windows.
    pub maps: usize,
}

/// The windows of every case.
#[derive(Debug, Clone, Copy)]
pub struct WindowPlan {
    /// Points along a side.
    pub points: usize,
    /// Their distance, m.
    pub pixel: f64,
    /// Standard deviation of the surface heights, m.
    pub sigma: f64,
    /// Hurst exponent.
    pub hurst: f64,
    /// Shortest wavelength, m.
    pub cut_off: f64,
    /// Number of maps of each case whose windows are studied under other treatments.
    pub studied_maps: usize,
}

impl WindowPlan {
    /// Side of a window, m.
    pub fn side(&self) -> f64 {
        self.points as f64 * self.pixel
    }
}

/// A random process.
pub struct CasePlan {
    /// Name in the spec.
    pub name: String,
    /// Longest wavelength of the power law, m.
    pub roll_off: f64,
    /// Wavelengths along x over those along y.
    pub elongation: f64,
    /// Distribution of the heights.
    pub heights: Heights,
    /// Whether a finer roughness truncates the summits.
    pub has_plateau: bool,
    /// How the amplitude varies from place to place.
    pub patches: Option<Patches>,
    /// Number of maps, of which each gives [`WINDOWS_PER_MAP`] windows.
    pub maps: usize,
    /// Number of maps whose windows are checked for spikes and line offsets.
    pub checked_maps: usize,
    /// Effective contacts of the loads.
    pub contacts: Vec<f64>,
    /// The case whose process is that of a second rough body, and the relative positions.
    pub second: Option<(String, usize)>,
    /// The process.
    pub process: EndlessProcess,
}

impl CasePlan {
    /// What the roughness is, besides its heights, in words; empty where it is isotropic and homogeneous.
    pub fn roughness(&self) -> String {
        let elongation = (self.elongation != 1.0).then(|| format!("elongated {}:1", self.elongation));
        let plateau = self.has_plateau.then(|| "truncated by a finer roughness".to_owned());
        let patches = self.patches.as_ref();
        let patches = patches.map(|of| {
            format!("patchy, modulation {} over {}", of.modulation, input_quantity(of.length, "m"))
        });
        let second =
            self.second.as_ref().map(|(name, shifts)| format!("against {name} at {shifts} positions"));
        [elongation, plateau, patches, second].into_iter().flatten().collect::<Vec<String>>().join(", ")
    }
}

impl fmt::Display for CoveragePlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let names: Vec<&str> = self.cases.iter().map(|case| case.name.as_str()).collect();
        let Bodies { rough, flat } = &self.bodies;
        writeln!(f, "  {rough} on {flat}, law {}, {}", self.law.label, names.join(", "))?;
        let WindowPlan { points, .. } = self.windows;
        let maps: usize = self.cases.iter().map(|case| case.maps).sum();
        writeln!(f, "  {} windows of {points} x {points} points", maps * WINDOWS_PER_MAP)
    }
}

/// Reads `[coverage]`.
pub(super) fn plan(file: &SpecFile, table: &Spanned<CoverageSpec>) -> Result<CoveragePlan, InputError> {
    let raw = table.get_ref();
    let (rough, flat) = (raw.rough.get_ref(), raw.flat.get_ref());
    let pair = [file.body(rough, raw.rough.span())?, file.body(flat, raw.flat.span())?];
    let laws = &raw.law.get_ref().0;
    if laws.len() != 1 {
        let message = format!("found {} laws; allowed: one", laws.len());
        return Err(file.source.error_at(raw.law.span(), message));
    }
    file.spheres_only(&raw.law, "the asperities of [coverage] are taken as spheres")?;
    file.check_laws(&raw.law, (rough, &pair[0]), &[(flat, &pair[1])])?;
    let flats = [(None, Flat::Bare(pair[1]))];
    let law = || Ok::<_, InputError>(file.law_plans(&raw.law, (rough, &pair[0]), &flats, flat)?.remove(0));
    // Bodies of unit conductivity: differences of conductances do not depend on it.
    let thermal = Conduction::new([1.0; 2]).map_err(|error| file.source.error_at(raw.law.span(), error))?;
    let spots = SpotProperties { thermal: Some(thermal), ..SpotProperties::default() };
    let conducting = Box::new(WithSpots::new(law()?.contact, spots));
    let law = law()?;
    if raw.case.get_ref().is_empty() {
        let message =
            "found no case; allowed: at least one [coverage.case.NAME] with roll-off, heights and contacts";
        return Err(file.source.error_at(raw.case.span(), message));
    }
    let windows = WindowPlan {
        points: file.whole_within(&raw.points, POINTS, "points")? as usize,
        pixel: raw.pixel.value(),
        sigma: raw.sigma.value(),
        hurst: raw.hurst.get_ref().value(),
        cut_off: raw.cut_off.get_ref().value(),
        studied_maps: optional_maps(file, raw.robustness.as_ref())?,
    };
    let cases = raw.case.get_ref().iter();
    let cases = cases.map(|(name, case)| case_plan(file, raw, &windows, name.get_ref(), case));
    let mut cases = cases.collect::<Result<Vec<CasePlan>, _>>()?;
    for (place, case) in raw.case.get_ref().values().enumerate() {
        if let Some(against) = &case.against {
            let second = second_body(file, raw, against, &cases)?;
            cases[place].second = Some((against.get_ref().case.get_ref().clone(), second.shifts));
            cases[place].process = cases[place].process.clone().against(second);
        }
    }
    let spikes = raw.spikes.as_ref().map(|spikes| spikes_plan(file, spikes.get_ref(), &cases)).transpose()?;
    Ok(CoveragePlan {
        bodies: Bodies { rough: rough.clone(), flat: flat.clone() },
        law,
        conducting,
        windows,
        intervals: raw.intervals,
        cases,
        spikes,
        seed: file.seed,
    })
}

/// The second body of a case, which is the process of another one of `cases`.
fn second_body(
    file: &SpecFile,
    raw: &CoverageSpec,
    against: &Spanned<AgainstSpec>,
    cases: &[CasePlan],
) -> Result<SecondBody, InputError> {
    let AgainstSpec { case, shifts } = against.get_ref();
    if raw.intervals == Intervals::ModelBased {
        let message = "found a second rough body with model-based intervals, which pairs have not; allowed: intervals = \"blocks\"";
        return Err(file.source.error_at(against.span(), message));
    }
    let shifts = file.whole_within(shifts, SHIFTS, "relative positions")? as usize;
    let alone = || {
        let named = raw.case.get_ref().iter().zip(cases);
        named.filter(|((_, raw), _)| raw.against.is_none()).map(|(_, case)| case)
    };
    let found = alone().find(|plan| plan.name == *case.get_ref()).ok_or_else(|| {
        let names: Vec<&str> = alone().map(|case| case.name.as_str()).collect();
        let message =
            format!("found \"{}\"; allowed: a case of one body ({})", case.get_ref(), names.join(", "));
        file.source.error_at(case.span(), message)
    })?;
    Ok(SecondBody { process: found.process.clone(), shifts })
}

/// The maps that give so many windows.
fn maps(windows: u64) -> usize {
    (windows as usize).div_ceil(WINDOWS_PER_MAP)
}

fn optional_maps(file: &SpecFile, windows: Option<&Spanned<Whole>>) -> Result<usize, InputError> {
    windows.map_or(Ok(0), |count| Ok(maps(file.whole_within(count, [0, WINDOWS[1]], "windows")?)))
}

fn spikes_plan(file: &SpecFile, raw: &SpikesSpec, cases: &[CasePlan]) -> Result<SpikesPlan, InputError> {
    let named = cases.iter().position(|case| case.name == *raw.case.get_ref());
    let case = named.ok_or_else(|| {
        let names: Vec<&str> = cases.iter().map(|case| case.name.as_str()).collect();
        let message = format!("found \"{}\"; allowed: {}", raw.case.get_ref(), names.join(", "));
        file.source.error_at(raw.case.span(), message)
    })?;
    let counts = raw.counts.get_ref().iter().map(|&Whole(count)| count);
    let deviations = raw.deviations.get_ref().iter().map(|of| of.value());
    if let Some(count) = counts.clone().find(|count| !(SPIKES[0]..=SPIKES[1]).contains(count)) {
        let message = format!("found {count}; allowed: {} to {} spikes", SPIKES[0], SPIKES[1]);
        return Err(file.source.error_at(raw.counts.span(), message));
    }
    if let Some(of) = deviations.clone().find(|of| !(DEVIATIONS[0]..=DEVIATIONS[1]).contains(of)) {
        let [least, most] = DEVIATIONS;
        let message = format!("found {of}; allowed: {least} to {most} robust standard deviations");
        return Err(file.source.error_at(raw.deviations.span(), message));
    }
    let with = |count: u64| {
        deviations.clone().map(move |deviations| PlantedSpikes { count: count as usize, deviations })
    };
    Ok(SpikesPlan {
        case,
        planted: counts.flat_map(with).collect(),
        maps: maps(file.whole_within(&raw.windows, SPIKED_WINDOWS, "windows")?),
    })
}

fn case_plan(
    file: &SpecFile,
    raw: &CoverageSpec,
    windows: &WindowPlan,
    name: &str,
    case: &CaseSpec,
) -> Result<CasePlan, InputError> {
    let roll_off = case.roll_off.get_ref().value();
    if roll_off > windows.side() {
        let message = format!(
            "found a roll-off of {roll_off:.3e} m; allowed: at most the side of a window, {:.3e} m",
            windows.side()
        );
        return Err(file.source.error_at(case.roll_off.span(), message));
    }
    let &WindowPlan { hurst, cut_off, sigma, points, pixel, .. } = windows;
    let heights = case.heights.as_ref().map_or(Heights::GAUSSIAN, |heights| heights.0.clone());
    let elongation = case.elongation.as_ref().map_or(1.0, |elongation| elongation.get_ref().value());
    let process = |roll_off: f64, sigma: f64, heights: &Heights, lay: Lay| {
        let spectrum = Spectrum::new(SpectrumShape::SelfAffine { hurst, roll_off, cut_off }, lay)?;
        Ok(Process { spectrum, of: SpectrumOf::Gaussian, sigma, heights: heights.clone() })
    };
    let plateau = case.plateau.as_ref().map(|plateau| {
        let PlateauSpec { sigma, roll_off, height } = plateau.get_ref();
        let (length, sigma) = (roll_off.get_ref().value(), sigma.value());
        let process = process(length, sigma, &Heights::GAUSSIAN, Lay::default())
            .and_then(|process| process.spectrum.check([2 * points; 2], [pixel; 2]).map(|()| process))
            .map_err(|error| file.source.error_at(roll_off.span(), error))?;
        Ok::<_, InputError>(Plateau { process, height: height.value() })
    });
    let (plateau, patches) = (plateau.transpose()?, patches(file, case, windows)?);
    let make = || {
        let lay = Lay { elongation, angle: 0.0 };
        let process = process(roll_off, sigma, &heights, lay)?;
        let roughness = Roughness { process, plateau, patches };
        EndlessProcess::new(name, roughness, points, pixel, file.seed)
    };
    let process = make().map_err(|error: SpectrumError| {
        let span = match error {
            SpectrumError::Hurst(_) => raw.hurst.span(),
            SpectrumError::BelowPixel { .. } => raw.cut_off.span(),
            _ => case.roll_off.span(),
        };
        file.source.error_at(span, error)
    })?;
    Ok(CasePlan {
        name: name.to_owned(),
        roll_off,
        elongation,
        heights,
        has_plateau: case.plateau.is_some(),
        patches,
        maps: maps(file.whole_within(case.windows.as_ref().unwrap_or(&raw.windows), WINDOWS, "windows")?),
        checked_maps: optional_maps(file, case.checked.as_ref().or(raw.checked.as_ref()))?,
        contacts: contacts(file, &case.contacts)?,
        second: None,
        process,
    })
}

fn patches(file: &SpecFile, case: &CaseSpec, windows: &WindowPlan) -> Result<Option<Patches>, InputError> {
    let Some(table) = &case.patches else { return Ok(None) };
    let raw = table.get_ref();
    let &WindowPlan { points, pixel, .. } = windows;
    let modulation = raw.modulation.get_ref().value();
    if !(MODULATIONS[0]..=MODULATIONS[1]).contains(&modulation) {
        let [least, most] = MODULATIONS;
        let message = format!("found {modulation}; allowed: {least} to {most}");
        return Err(file.source.error_at(raw.modulation.span(), message));
    }
    let patches = Patches::new(modulation, raw.length.get_ref().value())
        .and_then(|patches| patches.check([2 * points; 2], [pixel; 2]).map(|()| patches));
    patches.map(Some).map_err(|error| file.source.error_at(raw.length.span(), error))
}

fn contacts(file: &SpecFile, raw: &Spanned<LogSweep<Pure>>) -> Result<Vec<f64>, InputError> {
    let contacts = &raw.get_ref().values;
    match contacts.iter().find(|count| !(CONTACTS[0]..=CONTACTS[1]).contains(*count)) {
        Some(count) => {
            let [least, most] = CONTACTS;
            let message = format!("found {count}; allowed: {least} to {most:e} effective contacts");
            Err(file.source.error_at(raw.span(), message))
        }
        None => Ok(contacts.clone()),
    }
}
