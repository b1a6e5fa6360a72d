//! Windows of an endless rough surface, treated as measured maps.

use asperity::numeric::stream_seed;
use asperity::study::StudyError;
use asperity::surface::NoAsperities;
use asperity::topography::generate::{Plateau, Process, Seeds, SurfaceGenerator};
use asperity::topography::spectrum::SpectrumError;
use asperity::topography::summits::{Detail, Neighbours, find};
use asperity::topography::{Level, PairError, RoughPair, Undetermined};
use asperity::{
    AsperitySet, Deterministic, HeightMap, MapError, MicroContact, Model, ReferencePlane, SetError,
    Statistics,
};

use super::WINDOWS_PER_MAP;
use super::patches::Patches;

/// The roughness of an endless surface.
#[derive(Debug, Clone)]
pub struct Roughness {
    /// The process.
    pub process: Process,
    /// A finer one that truncates its summits.
    pub plateau: Option<Plateau>,
    /// How its amplitude varies from place to place.
    pub patches: Option<Patches>,
}

/// A random process of which square windows are seen, as a measurement sees a part of a surface.
#[derive(Debug, Clone)]
pub struct EndlessProcess {
    name: String,
    generator: SurfaceGenerator,
    patches: Option<Patches>,
    second: Option<Box<SecondBody>>,
    seed: u64,
}

/// The process of a second body, on which windows of the first lie at several random relative positions.
#[derive(Debug, Clone)]
pub struct SecondBody {
    /// Its process, with windows of the same size.
    pub process: EndlessProcess,
    /// Relative positions of each pair of windows.
    pub shifts: usize,
}

/// A window on which the models cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum Unusable {
    /// Heights that form no map.
    #[error(transparent)]
    Map(#[from] MapError),
    /// A window that cannot be levelled.
    #[error("a window {0}")]
    Level(#[from] Undetermined),
    /// A window without asperities.
    #[error("a window {0}")]
    Search(#[from] NoAsperities),
    /// Windows of two bodies that make no pair.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// Models that cannot be compared on a window.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// Asperities that form no set.
    #[error(transparent)]
    Set(#[from] SetError),
    /// Too few asperities for groups of them.
    #[error("a window has {0} summits; allowed: at least {FEWEST}, by more points or shorter waves")]
    FewSummits(usize),
    /// The pilot map does not reach a number of contacts.
    #[error("{wanted} effective contacts are not reached; the windows of the pilot map have up to {most:.0}")]
    FewContacts {
        /// The number.
        wanted: f64,
        /// The largest mean number from 4 to 0 sigma.
        most: f64,
    },
}

/// The fewest summits of a window.
const FEWEST: usize = 64;

/// Where the windows of a process are examined.
#[derive(Debug, Clone, PartialEq)]
pub struct Controls {
    /// Loads, Pa.
    pub loads: Vec<f64>,
    /// For each load a fixed d/sigma near it.
    pub separations: Vec<f64>,
}

/// The asperities of a window.
#[derive(Debug, Clone)]
pub struct WindowAsperities {
    /// The asperities.
    pub set: AsperitySet,
    /// The points on which they are.
    pub positions: Vec<usize>,
}

impl WindowAsperities {
    /// The five-point summits of a window.
    ///
    /// # Errors
    /// Too few of them.
    pub fn from_summits(window: &HeightMap) -> Result<Self, Unusable> {
        let detail = Detail { positions: true, principal: false, drops: false };
        let summits = find(window, Neighbours::Four, detail);
        if summits.heights.len() < FEWEST {
            return Err(Unusable::FewSummits(summits.heights.len()));
        }
        let [dx, dy] = window.pixel();
        let radii = summits.curvatures.iter().map(|curvature| curvature.recip()).collect();
        let set = AsperitySet::new(summits.heights, radii, dx * dy * summits.tested as f64)?;
        Ok(Self { set, positions: summits.positions })
    }
}

impl EndlessProcess {
    /// A surface called `name` of which windows of `points` x `points` with `pixel` (m) are seen. They are cut from periodic
    /// maps of twice the side, so that a window does not show the period.
    ///
    /// # Errors
    /// A spectrum that the maps do not resolve.
    pub fn new(
        name: &str,
        roughness: Roughness,
        points: usize,
        pixel: f64,
        seed: u64,
    ) -> Result<Self, SpectrumError> {
        let Roughness { process, plateau, patches } = roughness;
        let generator = SurfaceGenerator { points: [2 * points; 2], pixel: [pixel; 2], process, plateau };
        generator.check()?;
        if let Some(patches) = &patches {
            patches.check(generator.points, generator.pixel)?;
        }
        Ok(Self { name: name.to_owned(), generator, patches, second: None, seed })
    }

    /// The same against a rough body.
    pub fn against(self, second: SecondBody) -> Self {
        Self { second: Some(Box::new(second)), ..self }
    }

    /// The seed of one stream of random numbers of this process.
    pub fn seed(&self, what: &str) -> [u8; 32] {
        stream_seed(self.seed, &format!("coverage {} {what}", self.name))
    }

    /// The four windows of the periodic map called `map`, levelled by a plane, with open boundaries; of two bodies at their first relative
    /// position.
    ///
    /// # Errors
    /// See [`Unusable`].
    pub fn windows(&self, map: &str) -> Result<Vec<HeightMap>, Unusable> {
        let each = self.positions(map, 1)?;
        Ok(each.into_iter().flatten().collect())
    }

    /// Each of the four windows of a map at all relative positions of the bodies; one of a single body.
    ///
    /// # Errors
    /// See [`Unusable`].
    pub fn windows_at_positions(&self, map: &str) -> Result<Vec<Vec<HeightMap>>, Unusable> {
        self.positions(map, self.second.as_ref().map_or(1, |second| second.shifts))
    }

    fn positions(&self, map: &str, count: usize) -> Result<Vec<Vec<HeightMap>>, Unusable> {
        let own = self.windows_of_body(map)?;
        let Some(second) = &self.second else {
            return Ok(own.into_iter().map(|window| vec![window]).collect());
        };
        let other = second.process.windows_of_body(map)?;
        let sums = |(index, (first, second))| {
            let pair = RoughPair::new(first, second, 0.0, false)?;
            let seed = |number| self.seed(&format!("position {number} of window {index} of {map}"));
            Ok((0..count).map(|number| pair.sum(pair.place(seed(number)))).collect())
        };
        own.into_iter().zip(other).enumerate().map(sums).collect()
    }

    fn windows_of_body(&self, map: &str) -> Result<Vec<HeightMap>, Unusable> {
        let stream = |of: &str| self.seed(&format!("{of} of {map}"));
        let (map, _) =
            self.generator.surface(Seeds { process: self.seed(map), plateau: stream("plateau") })?;
        let pixel = map.pixel();
        let mut heights = map.into_heights();
        if let Some(patches) = &self.patches {
            patches.modulate(&mut heights, self.generator.points, pixel, stream("patches"));
        }
        let side = self.generator.points[0];
        let points = side / 2;
        let window = |index: usize| {
            let (first_x, first_y) = (index / 2 * points, index % 2 * points);
            let row = |x: usize| {
                let start = (first_x + x) * side + first_y;
                &heights[start..start + points]
            };
            let heights = (0..points).flat_map(row).copied().collect();
            let window = HeightMap::new([points; 2], pixel, heights, f64::EPSILON)?;
            Ok(Level::Plane.apply(&window)?)
        };
        (0..WINDOWS_PER_MAP).map(window).collect()
    }

    /// Loads and separations at which the sums over the windows of a pilot map, which is used for nothing else, have
    /// `contacts` effective contacts in the mean.
    ///
    /// # Errors
    /// A number that is not reached from 4 to 0 sigma.
    pub fn controls(&self, contact: &dyn MicroContact, contacts: &[f64]) -> Result<Controls, Unusable> {
        /// Separations tried per sigma.
        const PER_SIGMA: usize = 50;
        let grid: Vec<f64> = (0..=4 * PER_SIGMA).map(|k| 4.0 - k as f64 / PER_SIGMA as f64).collect();
        let mut sums = vec![[0.0; 2]; grid.len()];
        for window in self.windows("pilot")? {
            let set = WindowAsperities::from_summits(&window)?.set;
            let plane = ReferencePlane::from(&Statistics::new(&set));
            let curve = Deterministic::new(contact, set.spheres(), plane).respond_all(&grid);
            for ([contacts, pressure], response) in sums.iter_mut().zip(curve) {
                *contacts += response.sharing.map_or(0.0, |sharing| sharing.effective_contacts);
                *pressure += response.pressure.total();
            }
        }
        let count = WINDOWS_PER_MAP as f64;
        let mut controls = Controls { loads: Vec::new(), separations: Vec::new() };
        for &wanted in contacts {
            let first = sums.iter().position(|[contacts, _]| contacts / count >= wanted);
            let most = sums.iter().map(|[contacts, _]| contacts / count).fold(0.0, f64::max);
            let first = first.ok_or(Unusable::FewContacts { wanted, most })?;
            controls.loads.push(sums[first][1] / count);
            controls.separations.push(grid[first]);
        }
        Ok(controls)
    }
}
