//! Two rough bodies: planned from two surfaces of the spec, and made one at each relative position.

use std::ops::Range;
use std::sync::Arc;

use asperity::numeric::stream_seed;
use asperity::surface::{BodyAsperities, Surface};
use asperity::topography::fitness::Finding;
use asperity::topography::summits::Neighbours;
use asperity::topography::{HeightMap, Placement, RoughPair};
use asperity::{
    GreenwoodTrippError, Heights, MeanRadius, Population, ReferencePlane, SurfaceHeights, meeting_pairs,
};
use asperity_contact_framework::input::{InputError, Source, Spanned, SpecFile};
use asperity_contact_framework::report::format::quantity;

use super::files::Files;
use super::fitness;
use super::plan::{Origin, SurfacePlan, Surfaces, named_surface};
use super::spec::{DrawSpec, PairSpec, PopulationSpec, SurfaceSpec};

/// A pair that can be made.
#[derive(Debug)]
pub(super) struct PairPlan {
    pub(super) bodies: [SurfacePlan; 2],
    /// Whether the second is rotated at random.
    rotates: bool,
    /// Nesting index of the S filter of the coarser map, m; 0 without one.
    s: f64,
    /// Position of the names in the spec.
    keys: Range<usize>,
    /// What a summit is: as on the first body.
    pub(super) neighbours: Neighbours,
}

/// Both bodies, prepared, with what keeps one of them from carrying a verdict.
pub(super) struct PreparedPair {
    pub(super) maps: RoughPair,
    pub(super) bodies: [BodyAsperities; 2],
    pub(super) faults: Vec<Finding>,
    pub(super) warnings: Vec<String>,
}

/// Why no integral of Greenwood and Tripp stands beside two bodies, where it does not describe them.
pub(super) fn greenwood_tripp_caveat(bodies: &[BodyAsperities; 2]) -> Option<String> {
    let populations = bodies.each_ref().map(|body| body.population(MeanRadius::Arithmetic));
    let error = GreenwoodTrippError::of(&populations)?;
    Some(format!("no integral of Greenwood and Tripp (1971): {error}."))
}

/// Relative positions where none are given.
pub(super) const SHIFTS: u64 = 16;

impl PairPlan {
    /// Of two of `all` surfaces of a spec.
    pub(super) fn new(
        file: &SpecFile,
        raw: &PairSpec,
        all: &Surfaces,
        as_ellipses: bool,
    ) -> Result<Self, InputError> {
        let source = &file.source;
        let body = |name: &Spanned<String>| {
            let refuse = |message: String| source.error_at(name.span(), message);
            let wanted = name.get_ref();
            let (name, spec) = named_surface(source, all, name, |spec| !spec.is_pair())?;
            let plan = SurfacePlan::new(file, name, spec, all, as_ellipses)?;
            if plan.has_given_asperities() {
                return Err(refuse(format!(
                    "found \"{wanted}\", whose asperities have no height map; allowed: [surface.{wanted}.file] or [surface.{wanted}.generate], or \
                     two populations, whose composite is taken"
                )));
            }
            if plan.realisations > 1 {
                return Err(refuse(format!(
                    "found {} realisations of \"{wanted}\"; allowed: one",
                    plan.realisations
                )));
            }
            if plan.pixel().is_none() {
                return Err(refuse(format!(
                    "found \"{wanted}\", whose pixel follows from `summits`; allowed: a generated surface with `pixel` and `sigma`"
                )));
            }
            Ok(plan)
        };
        let bodies = [body(&raw.a)?, body(&raw.b)?];
        if raw.a.get_ref() == raw.b.get_ref() {
            let message = format!(
                "found \"{}\" as both bodies, whose heights would not be independent; allowed: two surfaces, such as a second [surface.NAME] with the same keys, \
                 whose generated heights are others",
                raw.b.get_ref()
            );
            return Err(source.error_at(raw.b.span(), message));
        }
        if let ([Some(first), Some(second)], [Some(pixel), Some(other)]) =
            (bodies.each_ref().map(SurfacePlan::map_points), bodies.each_ref().map(SurfacePlan::pixel))
        {
            let repeat = bodies.iter().all(SurfacePlan::is_periodic);
            RoughPair::check([first, second], [pixel, other], repeat, raw.rotations).map_err(|error| {
                source.error_at(raw.b.span(), format!("{} and {}: {error}", raw.a.get_ref(), raw.b.get_ref()))
            })?;
        }
        let coarser = |plan: &SurfacePlan| plan.pixel().map_or(0.0, |[dx, dy]| dx.max(dy));
        let is_first_coarser = coarser(&bodies[0]) >= coarser(&bodies[1]);
        let s = bodies[usize::from(!is_first_coarser)].short_cut_off().unwrap_or(0.0);
        let neighbours = bodies[0].neighbours();
        Ok(Self { bodies, rotates: raw.rotations, s, keys: raw.a.span().start..raw.b.span().end, neighbours })
    }

    /// Points along x and y that both have in common at most, and their distance (m).
    pub(super) fn grid(&self) -> ([usize; 2], [f64; 2]) {
        let of = |body: &SurfacePlan| (body.map_points().unwrap_or([3; 2]), body.pixel().unwrap_or([1.0; 2]));
        let [first, second] = [of(&self.bodies[0]), of(&self.bodies[1])];
        let pixel = [0, 1].map(|axis| first.1[axis].max(second.1[axis]));
        let count = |(points, own): ([usize; 2], [f64; 2]), axis: usize| {
            ((points[axis] - 1) as f64 * own[axis] / pixel[axis]).round() as usize + 1
        };
        ([0, 1].map(|axis| count(first, axis).min(count(second, axis))), pixel)
    }

    pub(super) fn is_periodic(&self) -> bool {
        self.bodies.iter().all(SurfacePlan::is_periodic)
    }

    /// What it is, for a plan that a person reads.
    pub(super) fn describe(&self) -> String {
        let rotated = if self.rotates { " and rotations" } else { "" };
        format!("sum of {} and {} at random shifts{rotated}", self.bodies[0].name, self.bodies[1].name)
    }

    /// Both bodies from their prepared maps, made by `make`.
    pub(super) fn make(
        &self,
        source: &Source,
        files: &mut Files,
        mut make: impl FnMut(&SurfacePlan, &mut Files) -> Result<Surface, InputError>,
    ) -> Result<PreparedPair, InputError> {
        let (mut faults, mut warnings) = (Vec::new(), Vec::new());
        let mut map = |body: &SurfacePlan| -> Result<(HeightMap, BodyAsperities), InputError> {
            let surface = make(body, files)?;
            let asperities = BodyAsperities::of(&surface);
            faults.extend(surface.fitness().iter().filter(|finding| finding.is_blocking()).cloned());
            warnings
                .extend(fitness::failures(&surface).iter().map(|fault| format!("{}: {fault}", body.name)));
            let prepared = surface.prepared.map(|prepared| Arc::unwrap_or_clone(prepared.map));
            let map = prepared.ok_or_else(|| {
                source.error_at(self.keys.clone(), format!("{} has no height map", body.name))
            })?;
            Ok((map, asperities))
        };
        let [first, second] = &self.bodies;
        let ((of_first, asperities), (of_second, others)) = (map(first)?, map(second)?);
        let maps = RoughPair::new(of_first, of_second, self.s, self.rotates).map_err(|error| {
            source.error_at(self.keys.clone(), format!("{} and {}: {error}", first.name, second.name))
        })?;
        Ok(PreparedPair { maps, bodies: [asperities, others], faults, warnings })
    }

    /// Where the second body lies at a repeat of the pair `name`.
    pub(super) fn placement(pair: &RoughPair, seed: u64, name: &str, number: usize) -> Placement {
        pair.place(stream_seed(seed, &format!("pair {name} shift {number}")))
    }

    /// How far the second body is shifted in `shifts` positions, and what of the area is lost at most.
    pub(super) fn caveat(&self, pair: &RoughPair, seed: u64, name: &str, shifts: usize) -> String {
        let all: Vec<Placement> =
            (1..=shifts).map(|number| Self::placement(pair, seed, name, number)).collect();
        let positions = match shifts {
            1 => "a random relative position".to_owned(),
            _ => format!("{shifts} random relative positions"),
        };
        let rotated = if self.rotates { ", rotated by 0, 90, 180 or 270 degrees" } else { "" };
        if self.is_periodic() {
            return format!(
                "two rough bodies at {positions} around the border{rotated}; the x axis of `{}` is mirrored",
                self.bodies[1].name
            );
        }
        let least = all.iter().map(|&at| pair.overlap(at).into_iter().product::<usize>()).min().unwrap_or(0);
        let lost = 1.0 - least as f64 / pair.fewest_points() as f64;
        let pixel = pair.pixel();
        let off_centre = |at: &Placement| {
            let from_middle = |axis: usize| {
                let [low, high] = pair.range(at.turns, axis);
                (at.shift[axis] as f64 - 0.5 * (low + high) as f64) * pixel[axis]
            };
            from_middle(0).hypot(from_middle(1))
        };
        let longest = all.iter().map(off_centre).fold(0.0, f64::max);
        format!(
            "two rough bodies at {positions}{rotated}, up to {} from the middle; only the overlap counts, which loses up \
             to {:.0} % of the smaller map; the x axis of `{}` is mirrored",
            quantity(longest, "m"),
            100.0 * lost.max(0.0),
            self.bodies[1].name
        )
    }
}

impl SurfacePlan {
    /// Nesting index of the S filter of a measured map, m.
    fn short_cut_off(&self) -> Option<f64> {
        match &self.origin {
            Origin::Map(map) => map.preparation.filter.and_then(|filter| filter.s()),
            _ => None,
        }
    }

    /// Which neighbours a summit is higher than.
    fn neighbours(&self) -> Neighbours {
        match &self.origin {
            Origin::Map(map) => map.preparation.neighbours,
            Origin::Generated(generation) => generation.neighbours,
            Origin::Pair(pair) => pair.neighbours,
            Origin::List { .. } | Origin::Population { .. } => Neighbours::default(),
        }
    }
}

/// Asperities of the composite, of which the integral takes no notice.
const COUNT: usize = 1 << 16;

/// The composite of a pair of populations; `None` of other surfaces.
pub(super) fn of_populations(
    source: &Source,
    raw: &PairSpec,
    all: &Surfaces,
) -> Result<Option<Origin>, InputError> {
    let body = |name: &Spanned<String>| {
        let (_, spec) = named_surface(source, all, name, |spec| !spec.is_pair())?;
        Ok::<_, InputError>(match spec.get_ref() {
            SurfaceSpec::Population(population) => Some((spec, population)),
            _ => None,
        })
    };
    let (Some(first), Some(second)) = (body(&raw.a)?, body(&raw.b)?) else { return Ok(None) };
    if let Some(shifts) = &raw.shifts {
        let message =
            "found `shifts` of two populations, whose asperities have no positions; allowed: no `shifts`";
        return Err(source.error_at(shifts.span(), message));
    }
    if raw.rotations {
        let message = "found `rotations` of two populations, whose asperities have no positions; allowed: no `rotations`";
        return Err(source.error_at(raw.b.span(), message));
    }
    let gaussian = |name: &Spanned<String>, (spec, raw): (&Spanned<SurfaceSpec>, &PopulationSpec)| {
        let refuse = |message: String| source.error_at(name.span(), message);
        let Origin::Population { population, ratio, .. } =
            SurfacePlan::population(source, spec.span(), raw, false)?
        else {
            return Err(refuse(format!("found \"{}\"; allowed: a population", name.get_ref())));
        };
        if ratio.is_some() || population.heights != Heights::GAUSSIAN {
            let what = if ratio.is_some() { "elliptic asperities" } else { "heights that are not Gaussian" };
            return Err(refuse(format!(
                "found {what} of \"{}\", whose composite is not known; allowed: spheres of Gaussian heights",
                name.get_ref()
            )));
        }
        Ok::<Population, InputError>(population)
    };
    let both = [gaussian(&raw.a, first)?, gaussian(&raw.b, second)?];
    let surface = |name: &Spanned<String>, population: &Population| {
        SurfaceHeights::of_asperities(population).map_err(|error| format!("{}: {error}", name.get_ref()))
    };
    let surfaces = surface(&raw.a, &both[0]).and_then(|a| Ok([a, surface(&raw.b, &both[1])?]));
    let composite = surfaces.and_then(|surfaces| {
        SurfaceHeights::composite(surfaces).population().map_err(|error| error.to_string())
    });
    let (population, no_composite) = match composite {
        Ok(composite) => (composite, None),
        Err(reason) => match meeting_pairs(&both) {
            Ok(pairs) => (pairs, Some(reason)),
            Err(error) => {
                let message = format!(
                    "{reason}; the integral of Greenwood and Tripp (1971), which needs no such surface, is not possible either: {error}"
                );
                return Err(source.error_at(raw.b.span(), message));
            }
        },
    };
    let bodies = [(&raw.a, &both[0]), (&raw.b, &both[1])]
        .map(|(name, population)| BodyAsperities::nominal(name.get_ref(), population));
    Ok(Some(Origin::Population {
        plane: ReferencePlane { mean: 0.0, sigma: population.sigma },
        population,
        ratio: None,
        count: COUNT,
        draw: DrawSpec::Quantiles,
        bodies: Some(Box::new(bodies)),
        no_composite,
    }))
}
