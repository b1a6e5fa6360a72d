//! Windows of an endless rough surface, treated as measured maps.

use asperity::numeric::stream_seed;
use asperity::topography::generate::{Seeds, SurfaceGenerator, gaussian};
use asperity::topography::spectrum::Spectrum;
use asperity::topography::{Level, RoughPair};
use asperity::{Deterministic, HeightMap, MicroContact, Model};

use super::window::summits;
use crate::Failed;

/// Windows of one map.
pub const WINDOWS_PER_MAP: usize = 4;

/// A random process of which square windows are seen, as a measurement sees a part of a surface: cut from periodic maps of twice the
/// side, so that a window does not show the period.
#[derive(Debug, Clone)]
pub struct EndlessProcess {
    pub name: &'static str,
    /// Of the periodic maps.
    pub generator: SurfaceGenerator,
    /// Standard deviation c of the logarithm of an amplitude exp(c f - c^2) of the heights, and the spectrum of the Gaussian field f of unit
    /// variance: the mean square of the heights stays as it is.
    pub patches: Option<(f64, Spectrum)>,
    /// A second body, and the number of random relative positions of windows on it.
    pub second: Option<(Box<EndlessProcess>, usize)>,
    pub seed: u64,
}

impl EndlessProcess {
    /// The seed of one stream of random numbers of this process.
    fn seed(&self, what: &str) -> [u8; 32] {
        stream_seed(self.seed, &format!("coverage {} {what}", self.name))
    }

    /// Each of the four windows of the periodic map called `map`, levelled by a plane, with open boundaries; of two bodies at all their
    /// relative positions.
    pub fn windows(&self, map: &str) -> Result<Vec<Vec<HeightMap>>, Failed> {
        let own = self.windows_of_body(map)?;
        let Some((second, positions)) = &self.second else {
            return Ok(own.into_iter().map(|window| vec![window]).collect());
        };
        let sums = |(index, (first, second))| {
            let pair = RoughPair::new(first, second, 0.0, false)?;
            let seed = |number| self.seed(&format!("position {number} of window {index} of {map}"));
            Ok((0..*positions).map(|number| pair.sum(pair.place(seed(number)))).collect())
        };
        own.into_iter().zip(second.windows_of_body(map)?).enumerate().map(sums).collect()
    }

    fn windows_of_body(&self, map: &str) -> Result<Vec<HeightMap>, Failed> {
        self.generator.check()?;
        let stream = |of: &str| self.seed(&format!("{of} of {map}"));
        let (map, _) =
            self.generator.surface(Seeds { process: self.seed(map), plateau: stream("plateau") })?;
        let pixel = map.pixel();
        let mut heights = map.into_heights();
        if let Some((c, spectrum)) = &self.patches {
            spectrum.check(self.generator.points, pixel)?;
            let field = gaussian(&spectrum.on_grid(self.generator.points, pixel), 1.0, stream("patches"));
            heights.iter_mut().zip(field).for_each(|(z, f)| *z *= (c * f - c * c).exp());
        }
        let side = self.generator.points[0];
        let points = side / 2;
        let window = |index: usize| {
            let (first_x, first_y) = (index / 2 * points, index % 2 * points);
            let row = |x: usize| &heights[(first_x + x) * side + first_y..][..points];
            let heights = (0..points).flat_map(row).copied().collect();
            Ok(Level::Plane.apply(&HeightMap::new([points; 2], pixel, heights, f64::EPSILON)?)?)
        };
        (0..WINDOWS_PER_MAP).map(window).collect()
    }

    /// Loads (Pa) at which the sums over the windows of a pilot map, which is used for nothing else, have `contacts` effective contacts in
    /// the mean.
    pub fn loads(&self, contact: &dyn MicroContact, contacts: &[f64]) -> Result<Vec<f64>, Failed> {
        /// Separations tried per sigma.
        const PER_SIGMA: usize = 50;
        let grid: Vec<f64> = (0..=4 * PER_SIGMA).map(|k| 4.0 - k as f64 / PER_SIGMA as f64).collect();
        let mut sums = vec![[0.0; 2]; grid.len()];
        for positions in self.windows("pilot")? {
            let surface = summits(&positions[0])?;
            let curve = Deterministic::new(contact, surface.set.spheres(), surface.plane).respond_all(&grid);
            for ([contacts, pressure], response) in sums.iter_mut().zip(curve) {
                *contacts += response.sharing.map_or(0.0, |sharing| sharing.effective_contacts);
                *pressure += response.pressure.total();
            }
        }
        let mean = |sum: f64| sum / WINDOWS_PER_MAP as f64;
        let load = |&wanted: &f64| {
            let first = sums.iter().find(|[contacts, _]| mean(*contacts) >= wanted);
            let found = first.map(|[_, pressure]| mean(*pressure));
            found.ok_or_else(|| format!("{wanted} effective contacts are not reached").into())
        };
        contacts.iter().map(load).collect()
    }
}
