//! Running the reference on one realisation of a surface: each contact in the terms of the models, with bounds of its errors.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::time::Instant;

use asperity::HeightMap;
use asperity::bem::{
    Boundary, Contact, ElasticPair, GridError, MOST_MISSING, Options, Solver, SolverError, Tangent, refined,
};
use asperity::compare::{
    BlockShare, ByQuantity, ComparedQuantity, Control, ModelKind, ReferenceCurve, ReferencePoint,
};
use asperity::progress::{Progress, Share};
use asperity::spot::{SpotQuantity, SpotValues};
use asperity::study::{CaseResults, LawContact};
use asperity::surface::{Independence, PreparedMap, Surface};
use asperity::topography::Blocks;
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::Timing;
use asperity_contact_framework::report::format::{listed, percent};

use super::super::contact_map::{Covered, covered};
use super::super::results::CompareResults;
use super::super::rows::SurfaceCase;
use super::super::spec::ComparePlan;
use super::ElasticCase;
use super::plan::{ReferencePlan, Solution, spread_over};
use super::spots::{SolvedSpots, SpotSolver};
use super::view::{ContactView, SumAtLoad};
use crate::layer::thickness_words;
use crate::surface::SurfacePlan;

/// A surface whose prepared map is solved.
pub struct ReferenceRun<'a> {
    pub reference: &'a ReferencePlan,
    pub compare: &'a ComparePlan,
    pub plan: &'a SurfacePlan,
    pub surface: &'a Surface,
    pub prepared: &'a PreparedMap,
    /// Whether views of a contact are wanted.
    pub is_viewed: bool,
}

impl ReferenceRun<'_> {
    /// Adds the reference to the results of the models, and gives a view of the contact of each solution, and what is in contact at
    /// each load of the only solution, where they are wanted.
    pub fn run(
        &self,
        context: &RunContext,
        cases: &mut [CaseResults],
        timing: &mut Timing,
    ) -> Result<(Vec<ContactView>, Vec<Covered>), InputError> {
        let start = Instant::now();
        let reference = self.reference;
        let area = self.compare.setup(context).load_area(self.surface);
        let loads: Vec<Vec<Load>> = cases.iter().map(|case| Load::all(self, case, area)).collect();
        let of_solution = |index: usize| -> Vec<f64> {
            let served = loads.iter().zip(&reference.serves).filter(|(_, serves)| **serves == index);
            let pressures = served.flat_map(|(loads, _)| loads.iter().map(|load| load.pressure));
            let mut pressures: Vec<f64> = pressures.collect();
            pressures.sort_by(f64::total_cmp);
            pressures.dedup();
            pressures
        };
        let all: Vec<Vec<f64>> = (0..reference.solutions.len()).map(of_solution).collect();
        context.progress.stage("boundary elements", all.iter().map(Vec::len).sum::<usize>() as f64);
        let boundary = reference.boundary(self.plan);
        let map = self.map(boundary).map_err(|error| self.refuse(context, None, &error))?;
        context.progress.advance(0.0);
        let (mut views, mut all_covered) = (Vec::new(), Vec::new());
        for (index, (solution, pressures)) in reference.solutions.iter().zip(&all).enumerate() {
            let served: Vec<usize> =
                (0..cases.len()).filter(|&case| reference.serves[case] == index).collect();
            let sum_at =
                |pressure: f64| served.iter().find_map(|&case| SumAtLoad::new(&cases[case], pressure));
            let (mut solved, view) = self.solve(context, &map, solution, pressures, &sum_at)?;
            views.extend(view);
            all_covered.append(&mut solved.covered);
            for case in served {
                let mut curve = solved.curve(boundary, solution.cap, &loads[case]);
                let law = &self.compare.study.laws[case];
                curve.clusters = self.clusters(law, &cases[case], boundary, &curve.points);
                cases[case].reference = Some(curve);
            }
        }
        timing.reference += start.elapsed();
        Ok((views, all_covered))
    }

    fn map(&self, boundary: Boundary) -> Result<Cow<'_, HeightMap>, SolverError> {
        let map = &self.prepared.map;
        let (missing, points) = (missing(map), map.heights().len());
        if missing as f64 > MOST_MISSING * points as f64 {
            return Err(SolverError::Missing { missing, points });
        }
        Ok(match self.reference.refine {
            1 => Cow::Borrowed(map),
            factor => Cow::Owned(refined(map, boundary, factor)),
        })
    }

    fn refuse(&self, context: &RunContext, thickness: Option<f64>, error: &SolverError) -> InputError {
        let layer = thickness.map_or_else(String::new, |t| format!(", thickness {}", thickness_words(t)));
        let message = format!("surface {}{layer}: reference: {error}", self.surface.name);
        context.source.error_at(self.reference.key.clone(), message)
    }

    /// The bodies of a contact, and how it is solved.
    fn problem(&self, solution: &Solution) -> (ElasticPair, Options) {
        let boundary = self.reference.boundary(self.plan);
        let [bare, coated] = self.compare.study.bare_and_coated();
        let layer =
            self.compare.study.layer.as_ref().map(|layer| &layer.coating.material).zip(solution.thickness);
        let options = Options { boundary, error: self.reference.error, cap: solution.cap };
        (ElasticPair::new(bare, coated, layer), options)
    }

    /// Calls `take` with the map that is solved and one contact on it at each of the nominal `pressures` (Pa).
    pub fn each_contact<E: From<InputError>>(
        &self,
        context: &RunContext,
        solution: &Solution,
        pressures: &[f64],
        mut take: impl FnMut(&HeightMap, f64, &Contact) -> Result<(), E>,
    ) -> Result<(), E> {
        let refuse = |error: SolverError| self.refuse(context, solution.thickness, &error);
        let (pair, options) = self.problem(solution);
        let map = self.map(options.boundary).map_err(refuse)?;
        let solver = Solver::new(&map, &pair, &options).map_err(refuse)?;
        context.progress.stage("boundary elements", pressures.len() as f64);
        pressures.iter().try_for_each(|&pressure| {
            take(&map, pressure, &solver.at_pressure(pressure, context.progress).map_err(refuse)?)
        })
    }

    /// Solves one contact at ascending pressures (Pa).
    fn solve(
        &self,
        context: &RunContext,
        map: &HeightMap,
        solution: &Solution,
        pressures: &[f64],
        sum_at: &dyn Fn(f64) -> Option<SumAtLoad>,
    ) -> Result<(Solved, Option<ContactView>), InputError> {
        let refuse = |error: &SolverError| self.refuse(context, solution.thickness, error);
        let (pair, options) = self.problem(solution);
        let boundary = options.boundary;
        let solver = Solver::new(map, &pair, &options).map_err(|error| refuse(&error))?;
        let of_thickness =
            |law: &&LawContact| law.thickness.unwrap_or(0.0) == solution.thickness.unwrap_or(0.0);
        let law = self.compare.study.laws.iter().find(of_thickness);
        let asked = law.and_then(|law| law.contact.spot_properties());
        // Of the map that is solved, and of the map as it is.
        let spots = [(); 2].map(|()| SpotSolver::new(asked, boundary));
        let error = self.reference.error;
        // The map as it is, where another resolution is solved: the difference bounds the error of both.
        let own = (self.reference.refine > 1).then(|| Solver::new(&self.prepared.map, &pair, &options));
        let own = own.transpose().map_err(|error| refuse(&error))?;
        let blocks = match &self.surface.independence {
            Independence::Blocks(blocks) => Some(Blocks { points: map.points(), counts: blocks.counts }),
            _ => None,
        };
        let mut solved = Solved { interpolated: missing(&self.prepared.map), ..Solved::default() };
        let mut view: Option<ContactView> = None;
        let goes_on = &Share { progress: context.progress, units: 0.0 };
        goes_on.advance(0.0);
        for &pressure in pressures {
            if solution.cap.is_some_and(|cap| pressure >= cap) {
                solved.unreached.push(pressure);
                context.progress.advance(1.0);
                continue;
            }
            let found = SolvedContact::new(&solver, &spots[0], pressure, error, context.progress)
                .map_err(|error| refuse(&error))?;
            let at_own =
                own.as_ref().map(|solver| SolvedContact::new(solver, &spots[1], pressure, error, goes_on));
            let at_own = at_own.transpose();
            let at_own = at_own.map_err(|error| refuse(&error))?;
            let bits = pressure.to_bits();
            goes_on.advance(0.0);
            solved.points.insert(bits, found.point(pressure, at_own.as_ref(), self.surface));
            goes_on.advance(0.0);
            let shares = blocks.as_ref().map(|blocks| found.block_shares(blocks));
            solved.blocks.insert(bits, shares.unwrap_or_default());
            goes_on.advance(0.0);
            let contact = &found.contact;
            if self.is_viewed && self.reference.solutions.len() == 1 {
                let (cells, shares) = covered(contact.pressures(), contact.points());
                solved.covered.push((pressure, cells, shares));
            }
            let is_nearer = |view: &ContactView| ContactView::distance(contact) < view.distance;
            if self.is_viewed && view.as_ref().is_none_or(is_nearer) {
                view = Some(ContactView::new(self, solution, pressure, contact, sum_at(pressure)));
            }
        }
        Ok((solved, view))
    }
}

/// The least load of a separation sweep over E*: far below it not a single point of a map would be in contact.
const LEAST_CARRIED: f64 = 1e-9;

/// A load that is prescribed, or that a model carries at a prescribed separation.
struct Load {
    control: Control,
    target: f64,
    /// Nominal pressure, Pa.
    pressure: f64,
}

impl Load {
    /// The loads of a case; forces act on an area (m^2).
    fn all(run: &ReferenceRun, case: &CaseResults, area: f64) -> Vec<Self> {
        let reference = run.reference;
        let prescribed = reference.prescribed.iter().map(|&(control, target)| {
            let pressure = if control == Control::Force { target / area } else { target };
            Self { control, target, pressure }
        });
        let comparison = &case.comparison;
        let models = &run.compare.models;
        let kind = if models.contains(&ModelKind::Deterministic) {
            ModelKind::Deterministic
        } else {
            ModelKind::Statistical
        };
        let least = LEAST_CARRIED * run.compare.study.laws[0].contact.reference_modulus();
        let points = comparison.curves.iter().filter(|point| point.kind == kind);
        let carried: Vec<f64> = points
            .filter(|point| point.control == Control::Separation)
            .map(|point| point.response.pressure.total())
            .filter(|pressure| *pressure >= least && !comparison.unpaired.contains(pressure))
            .collect();
        let own = run
            .surface
            .map
            .as_ref()
            .filter(|_| run.surface.unscattered.is_some() && reference.prescribed.is_empty());
        let carried = match own {
            // No model says what separations carry; E* times the r.m.s. slope is about full contact.
            Some(map) => {
                let full = map.roughness.rms_slope() * least / LEAST_CARRIED;
                let last = reference.loads.saturating_sub(1).max(1) as f64;
                (0..reference.loads).map(|k| full * 100f64.powf(k as f64 / last - 1.0)).collect()
            }
            None => spread_over(&carried, reference.loads),
        };
        let carried = carried.into_iter();
        prescribed
            .chain(carried.map(|pressure| Self { control: Control::Pressure, target: pressure, pressure }))
            .collect()
    }
}

fn missing(map: &HeightMap) -> usize {
    map.heights().iter().filter(|z| z.is_nan()).count()
}

/// The results of one solution by pressure (bits of the f64, whose order is that of positive numbers).
#[derive(Default)]
struct Solved {
    interpolated: usize,
    points: BTreeMap<u64, ReferencePoint>,
    blocks: BTreeMap<u64, Vec<BlockShare>>,
    unreached: Vec<f64>,
    /// What is in contact, by growing load.
    covered: Vec<Covered>,
}

impl Solved {
    fn curve(&self, boundary: Boundary, cap: Option<f64>, loads: &[Load]) -> ReferenceCurve {
        let point = |load: &Load| {
            let point = self.points.get(&load.pressure.to_bits())?;
            Some(ReferencePoint { control: load.control, target: load.target, ..*point })
        };
        let blocks = |load: &Load| self.blocks.get(&load.pressure.to_bits()).cloned();
        let blocks: Vec<Vec<BlockShare>> = loads.iter().filter_map(blocks).collect();
        let is_unreached = |load: &&Load| self.unreached.contains(&load.pressure);
        ReferenceCurve {
            boundary,
            cap,
            interpolated: self.interpolated,
            points: loads.iter().filter_map(point).collect(),
            blocks: if blocks.iter().any(Vec::is_empty) { Vec::new() } else { blocks },
            clusters: Vec::new(),
            unreached: loads.iter().filter(is_unreached).map(|load| load.pressure).collect(),
        }
    }
}

/// Where a smaller share of the load is in contacts that yield, an elastic reference stands for the law.
pub const SMALL_YIELDING: f64 = 0.01;

impl CompareResults {
    /// Why the reference of a case is elastic although its law yields; `None` where it is not, and where no reference was run.
    pub(crate) fn elastic_reference(&self, case: SurfaceCase) -> Option<&ElasticCase> {
        let CaseResults { law, thickness, reference, .. } = case.first();
        reference.as_ref()?;
        let elastic = &self.reference.as_ref()?.elastic;
        elastic.iter().find(|elastic| elastic.law == *law && elastic.thickness == *thickness)
    }

    /// A warning on all cases in which both models were compared with an elastic reference while contacts of the sum yielded.
    pub(crate) fn elastic_reference_note(&self) -> Option<String> {
        let yielding = |case: SurfaceCase| {
            self.elastic_reference(case)?;
            Some((case.first().law.clone(), yielding_share(case.first())?))
        };
        let cases: Vec<(String, f64)> = SurfaceCase::all(self)
            .filter_map(yielding)
            .filter(|(_, share)| *share >= SMALL_YIELDING)
            .collect();
        let largest = cases.iter().map(|(_, share)| *share).reduce(f64::max)?;
        let mut laws: Vec<String> = cases.into_iter().map(|(law, _)| law).collect();
        laws.sort();
        laws.dedup();
        Some(format!(
            "reference: it stays elastic although contacts yield under law {} (up to {} of the load in the sum); which model is nearer leaves yielding out",
            listed(&laws),
            percent(largest)
        ))
    }
}

/// The largest share of the load that contacts of the sum carry which are not elastic, over the loads of the reference; `None` where both
/// models were not run at one of these.
fn yielding_share(case: &CaseResults) -> Option<f64> {
    let at_load = case.comparison.pairs_at_load();
    let compared = at_load.filter(|pair| case.reference_of(pair).is_some());
    compared.filter_map(|pair| Some(1.0 - pair.deterministic.pressure.shares()?[0])).reduce(f64::max)
}

/// A contact, how it changes with the load, and what its spots conduct.
pub struct SolvedContact {
    pub contact: Contact,
    /// `None` where no point may change its pressure.
    pub tangent: Option<Tangent>,
    spots: SolvedSpots,
}

impl SolvedContact {
    /// At a nominal pressure (Pa), with its spots to the relative `error`.
    pub fn new(
        solver: &Solver,
        spots: &SpotSolver,
        pressure: f64,
        error: f64,
        progress: &dyn Progress,
    ) -> Result<Self, SolverError> {
        let contact = solver.at_pressure(pressure, progress)?;
        let tangent = solver.tangent(&contact, progress);
        let spots = spots.solve(solver, &contact, tangent.as_ref(), error, progress)?;
        Ok(Self { contact, tangent, spots })
    }

    pub fn block_shares(&self, blocks: &Blocks) -> Vec<BlockShare> {
        let sums = self.contact.block_sums(blocks);
        let shares = self.tangent.as_ref().map(|tangent| tangent.block_shares(blocks));
        let spots = self.spots.of_blocks(blocks, &sums);
        let of_block =
            |(block, ([pressure, area_ratio], spots)): (usize, ([f64; 2], SpotValues))| BlockShare {
                pressure,
                area_ratio,
                stiffness_share: shares.as_ref().map_or(0.0, |shares| shares[block]),
                spots,
            };
        sums.into_iter().zip(spots).enumerate().map(of_block).collect()
    }

    /// In the terms of the models, with the same load on `other` points.
    pub fn point(&self, pressure: f64, other: Option<&Self>, surface: &Surface) -> ReferencePoint {
        let contact = &self.contact;
        let (mean_gap, sigma) = (contact.mean_gap(), surface.plane.sigma);
        let area_ratio = self.area_ratio(surface);
        let is_comparable = contact.boundary() != Boundary::Finite;
        let offset = surface.plane_above_mean_plane().filter(|_| is_comparable);
        let separation = offset.map(|offset| mean_gap - offset);
        let stiffness = self.stiffness().filter(|_| separation.is_some());
        let point = ReferencePoint {
            control: Control::Pressure,
            target: pressure,
            pressure,
            mean_gap,
            undeformed_gap: contact.undeformed_gap(),
            separation,
            separation_over_sigma: separation.map(|d| d / sigma).filter(|h| !h.is_nan()),
            area_ratio,
            raw_area_ratio: contact.raw_area_ratio(),
            capped_area_ratio: contact.capped_area_ratio(),
            stiffness,
            spots: self.spots.values(area_ratio, pressure),
            of_cluster: self.spots.of_cluster(),
            bounds: ByQuantity::default(),
            error: contact.error,
            steps: contact.steps,
            convolutions: contact.convolutions,
        };
        ReferencePoint { bounds: self.bounds(&point, other, surface), ..point }
    }

    /// Bounds of the errors of solver and grid, of d/sigma and the logarithms of the others: where `other` points were solved too, no
    /// less than the differences between both.
    fn bounds(&self, point: &ReferencePoint, other: Option<&Self>, surface: &Surface) -> ByQuantity<f64> {
        let (contact, sigma, pressure) = (&self.contact, surface.plane.sigma, point.pressure);
        let grid = GridError::new(contact);
        // How far the flat moves while the load grows by its logarithm; without a stiffness less than down to the mean plane.
        let reach = self.stiffness().map_or(contact.mean_gap(), |stiffness| pressure / stiffness);
        let apart = |of: &dyn Fn(&Self) -> Option<f64>| -> f64 {
            let [own, other] = [Some(self), other].map(|solved| solved.and_then(of));
            own.zip(other).map_or(0.0, |(own, other)| (own - other).abs())
        };
        let gap = apart(&|solved| Some(solved.contact.mean_gap())).max(grid.load * reach);
        let area = apart(&|solved| Some(solved.area_ratio(surface).ln())).max(grid.area);
        let stiffness = apart(&|solved| solved.stiffness().map(f64::ln)).max(grid.stiffness);
        // The dual gap is relative to the standard deviation of the heights.
        let roughness = surface.map.as_ref().map_or(sigma, |map| map.roughness.moments.sq);
        let of_tangent = self.tangent.as_ref().map_or(0.0, |tangent| tangent.error);
        let conductance = |quantity: SpotQuantity| {
            let value = |solved: &Self| solved.spots.conductance(quantity).map(f64::ln);
            let of_grid = grid.stiffness + SolvedSpots::border_error(contact);
            apart(&value).max(of_grid) + contact.error + self.spots.error(quantity)
        };
        ComparedQuantity::ALL.map(|quantity| match quantity {
            ComparedQuantity::Separation => (gap + contact.error * roughness) / sigma,
            ComparedQuantity::Area => area + contact.error,
            ComparedQuantity::Stiffness => stiffness + contact.error + of_tangent,
            ComparedQuantity::ElectricalConductance => conductance(SpotQuantity::ElectricalConductance),
            ComparedQuantity::ThermalConductance => conductance(SpotQuantity::ThermalConductance),
            // Its part that grows with the area is all of it, or less.
            ComparedQuantity::Friction => area + contact.error,
        })
    }

    /// Real over nominal contact area: corrected for the perimeter of the contacts, as measured on rough surfaces; raw where no summits scatter.
    fn area_ratio(&self, surface: &Surface) -> f64 {
        if surface.unscattered.is_some() { self.contact.raw_area_ratio() } else { self.contact.area_ratio() }
    }

    /// -dp/dd, Pa/m.
    fn stiffness(&self) -> Option<f64> {
        self.tangent.as_ref().map(Tangent::stiffness).filter(|stiffness| *stiffness > 0.0)
    }
}
