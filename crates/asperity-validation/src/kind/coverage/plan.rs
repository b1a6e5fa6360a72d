//! Windows and processes, resolved and checked.

use std::fmt;

use super::spec::{CaseSpec, CoverageSpec};
use crate::coverage::{EndlessProcess, WINDOWS_PER_MAP};
use asperity::study::LawContact;
use asperity::topography::generate::{Process, SpectrumOf};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumError, SpectrumShape};
use asperity::{Flat, Heights};
use asperity_contact_framework::contact::Bodies;

use asperity_contact_framework::input::quantity::Pure;
use asperity_contact_framework::input::sweep::LogSweep;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};

/// Points along a side: fewer hold no 16 blocks with summits, and of more the program examines every other one for the
/// correlation length.
const POINTS: [u64; 2] = [64, 1024];
/// Windows of a case.
const WINDOWS: [u64; 2] = [8, 100_000];
/// Effective contacts of a load.
const CONTACTS: [f64; 2] = [1.0, 1e6];

/// Coverage of intervals over windows of random processes.
pub struct CoveragePlan {
    /// Names of the two bodies.
    pub bodies: Bodies,
    pub law: LawContact,
    pub windows: WindowPlan,
    pub cases: Vec<CasePlan>,
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
    /// Number of maps, of which each gives [`WINDOWS_PER_MAP`].
    pub maps: usize,
}

impl WindowPlan {
    /// Side of a window, m.
    pub fn side(&self) -> f64 {
        self.points as f64 * self.pixel
    }

    /// Windows of each case.
    pub fn count(&self) -> usize {
        self.maps * WINDOWS_PER_MAP
    }
}

/// A random process.
pub struct CasePlan {
    /// Name in the spec.
    pub name: String,
    /// Longest wavelength of the power law, m.
    pub roll_off: f64,
    /// Distribution of the heights.
    pub heights: Heights,
    /// Effective contacts of the loads.
    pub contacts: Vec<f64>,
    /// The process.
    pub process: EndlessProcess,
}

impl fmt::Display for CoveragePlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let names: Vec<&str> = self.cases.iter().map(|case| case.name.as_str()).collect();
        let Bodies { rough, flat } = &self.bodies;
        writeln!(f, "  {rough} on {flat}, law {}, {}", self.law.label, names.join(", "))?;
        let WindowPlan { points, .. } = self.windows;
        writeln!(f, "  {} windows of {points} x {points} points of each", self.windows.count())
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
    let law = file.law_plans(&raw.law, (rough, &pair[0]), &flats, flat)?.remove(0);
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
        maps: (file.whole_within(&raw.windows, WINDOWS, "windows")? as usize).div_ceil(WINDOWS_PER_MAP),
    };
    let cases = raw.case.get_ref().iter();
    let cases = cases.map(|(name, case)| case_plan(file, raw, &windows, name.get_ref(), case));
    Ok(CoveragePlan {
        bodies: Bodies { rough: rough.clone(), flat: flat.clone() },
        law,
        windows,
        cases: cases.collect::<Result<_, _>>()?,
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
    let shape = SpectrumShape::SelfAffine { hurst, roll_off, cut_off };
    let process = Spectrum::new(shape, Lay::default()).and_then(|spectrum| {
        let process = Process { spectrum, of: SpectrumOf::Gaussian, sigma, heights: heights.clone() };
        EndlessProcess::new(name, process, points, pixel, file.seed)
    });
    let process = process.map_err(|error| {
        let span = match error {
            SpectrumError::Hurst(_) => raw.hurst.span(),
            SpectrumError::BelowPixel { .. } => raw.cut_off.span(),
            _ => case.roll_off.span(),
        };
        file.source.error_at(span, error)
    })?;
    let contacts = contacts(file, &case.contacts)?;
    Ok(CasePlan { name: name.to_owned(), roll_off, heights, contacts, process })
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
