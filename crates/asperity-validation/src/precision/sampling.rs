//! How far random sets are from the population that they are drawn from, and what a larger set costs.

use std::hint::black_box;

use super::timing::{Candidate, medians};
use asperity::compare::{Exact, LimitCase, LimitPoint, Quantity, SlopeFit, convergence};
use asperity::{
    Deterministic, Draw, MicroContact, Model, Population, ReferencePlane, Response, SetError, Statistical,
};

/// The input.
#[derive(Debug, Clone, PartialEq)]
pub struct SamplingTask {
    /// Sizes of the sets, ascending.
    pub counts: Vec<usize>,
    /// d/sigma.
    pub separations: Vec<f64>,
    /// Random sets of each size.
    pub draws: usize,
}

/// Random sets of one population.
#[derive(Debug, Clone, PartialEq)]
pub struct SamplingFindings {
    /// Size by size, separation by separation.
    pub points: Vec<LimitPoint>,
    /// Of each size: asperities, and seconds for drawing a set and adding it up at all separations.
    pub seconds: Vec<(usize, f64)>,
}

/// The mean of the sampling errors that the sums state for themselves, over the limit.
pub fn stated(point: &LimitPoint, quantity: Quantity) -> f64 {
    let of = |response: &Response| {
        let sampling = response.sampling?;
        Some(match quantity {
            Quantity::Area => sampling.area_ratio / point.exact.area_ratio,
            Quantity::Load => sampling.pressure / point.exact.pressure,
        })
    };
    point.random.iter().filter_map(of).sum::<f64>() / point.random.len() as f64
}

/// What ten times the asperities do: to the time, and to the error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tenfold {
    /// Times longer.
    pub time: f64,
    /// Times smaller error of the load.
    pub error: f64,
}

impl SamplingFindings {
    /// The smallest d/sigma.
    pub fn least_separation(&self) -> f64 {
        self.points.iter().map(separation).fold(f64::INFINITY, f64::min)
    }

    /// Asperities that it takes for a load within the relative `error` at the smallest separation, in the mean of the
    /// sizes where enough contacts are expected.
    pub fn needed(&self, error: f64) -> f64 {
        let least = self.least_separation();
        let fitted = self.points.iter().filter(|point| point.is_fitted() && separation(point) == least);
        let needed =
            |point: &LimitPoint| point.count as f64 * (point.scatter(Quantity::Load).1 / error).powi(2);
        let needed: Vec<f64> = fitted.map(needed).collect();
        needed.iter().sum::<f64>() / needed.len() as f64
    }

    /// What ten times the asperities do, by least squares: to the time of sets of 10^4 and more, and to the scatter of
    /// the load in the mean of the separations, where enough contacts are expected. `None` with too few sizes.
    pub fn tenfold(&self) -> Option<Tenfold> {
        /// In smaller sets the calls themselves count.
        const LARGE: usize = 10_000;
        let times = self.seconds.iter().filter(|(count, _)| *count >= LARGE);
        let time = SlopeFit::through(times.map(|&(count, seconds)| (count as f64, seconds)))?;
        let mut separations: Vec<f64> = self.points.iter().map(separation).collect();
        separations.sort_by(f64::total_cmp);
        separations.dedup();
        let slope = |h: &f64| {
            let points = self.points.iter().filter(|point| separation(point) == *h && point.is_fitted());
            let errors = points.map(|point| (point.count as f64, point.scatter(Quantity::Load).1));
            Some(SlopeFit::through(errors)?.slope)
        };
        let slopes: Vec<f64> = separations.iter().filter_map(slope).collect();
        let slope = slopes.iter().sum::<f64>() / slopes.len() as f64;
        slope.is_finite().then(|| Tenfold { time: 10f64.powf(time.slope), error: 10f64.powf(-slope) })
    }
}

/// d/sigma of a point.
pub fn separation(point: &LimitPoint) -> f64 {
    point.exact.statistical.separation_over_sigma
}

/// Draws and sums sets of increasing size; `seed(count, draw)` seeds a set, `done` is called after each.
///
/// # Errors
/// A population or count that makes no set.
pub fn sets_of(
    contact: &dyn MicroContact,
    population: &Population,
    task: &SamplingTask,
    seed: impl Fn(usize, usize) -> [u8; 32],
    done: impl Fn(usize),
) -> Result<SamplingFindings, SetError> {
    let limit = Statistical::new(contact, population.clone());
    let responses = limit.respond_all(&task.separations);
    let exact = responses.into_iter().map(|response| Exact::of_integral(response, population.density));
    let case = LimitCase { law: String::new(), contact, exact: exact.collect() };
    let points = convergence(&[case], population, &task.counts, task.draws, &seed, done)?;
    let plane = ReferencePlane { mean: 0.0, sigma: population.sigma };
    let mut candidates: Vec<Candidate> = task
        .counts
        .iter()
        .map(|&count| -> Candidate {
            let seed = seed(count, 0);
            Box::new(move || {
                // A size that makes no set was refused above.
                let Ok(set) = population.set(count, Draw::Random(seed)) else { return };
                let model = Deterministic::new(contact, set.spheres(), plane);
                black_box(model.respond_all(&task.separations));
            })
        })
        .collect();
    let seconds = task.counts.iter().copied().zip(medians(&mut candidates)).collect();
    Ok(SamplingFindings { points, seconds })
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::{Heights, Hertz, Interface, Material};

    #[test]
    fn sets_scatter_as_their_sums_say() {
        let steel = Material::new(210e9, 0.3, None, None).unwrap();
        let contact = Interface::bare(Hertz, &steel, &steel).unwrap();
        let case = Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN };
        let task =
            SamplingTask { counts: vec![10_000, 30_000, 100_000], separations: vec![0.0, 1.0], draws: 64 };
        let seed = |count: usize, draw: usize| {
            let mut seed = [9; 32];
            seed[..8].copy_from_slice(&count.to_le_bytes());
            seed[8..16].copy_from_slice(&draw.to_le_bytes());
            seed
        };
        let found = sets_of(&contact, &case, &task, seed, |_| ()).unwrap();
        assert_eq!((found.points.len(), found.seconds.len()), (6, 3));
        for point in &found.points {
            for quantity in Quantity::ALL {
                let ratio = point.scatter(quantity).1 / stated(point, quantity);
                assert!((0.7..1.4).contains(&ratio), "{ratio}");
            }
        }
        let seconds = vec![(1000, 9.0), (10_000, 1.0), (30_000, 2.0), (90_000, 4.0)];
        let tenfold = SamplingFindings { seconds, ..found }.tenfold().unwrap();
        // Twice the time for three times as many, from 10^4 on.
        assert!((tenfold.time / 10f64.powf(2f64.log(3.0)) - 1.0).abs() < 1e-12, "{tenfold:?}");
        assert!((2.2..4.5).contains(&tenfold.error), "{tenfold:?}");
    }
}
