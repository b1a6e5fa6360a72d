//! What it costs to divide the difference between the models among its causes, and how exact the product of heights and radii is.

use std::hint::black_box;

use rayon::prelude::*;

use super::timing::{Candidate, medians};
use asperity::compare::{Attribution, Inputs, Pair, Rearranged, pairs_at};
use asperity::contact_law::registry;
use asperity::numeric::Sum;
use asperity::{
    AsperitySet, Deterministic, Draw, Flat, Heights, Material, MicroContact, Model, Population,
    ReferencePlane, SetError, Shape, Statistical, Statistics,
};

/// Settings of the attribution benchmark.
#[derive(Debug, Clone, PartialEq)]
pub struct AttributionTask {
    /// Asperities in the sets, ascending.
    pub counts: Vec<usize>,
    /// Loads at which each difference is divided.
    pub loads: usize,
}

/// A set of one size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AttributionPoint {
    /// Asperities.
    pub asperities: usize,
    /// Loads.
    pub loads: usize,
    /// Loads whose difference has parts.
    pub divided: usize,
    /// Seconds of both models at the loads.
    pub model_seconds: f64,
    /// Seconds to rearrange the asperities, and for the states at the loads.
    pub attribution_seconds: f64,
}

impl AttributionPoint {
    /// Time over that of both models.
    pub fn time_ratio(&self) -> f64 {
        self.attribution_seconds / self.model_seconds
    }
}

/// Own heights and own radii, independent of each other, under one law.
#[derive(Debug, Clone, PartialEq)]
pub struct ProductPoint {
    /// Name of the law.
    pub law: String,
    /// Asperities.
    pub asperities: usize,
    /// The largest relative error of the pressure against the sum over every height with every radius.
    pub error: f64,
    /// Seconds of that sum over those of the condensed one, on as many threads.
    pub speedup: f64,
}

/// Run time and errors.
#[derive(Debug, Clone, PartialEq)]
pub struct AttributionFindings {
    /// By size.
    pub points: Vec<AttributionPoint>,
    /// By law.
    pub products: Vec<ProductPoint>,
}

/// Asperities whose heights and radii are multiplied out; their pairs take seconds in all.
pub const MULTIPLIED: usize = 10_000;

/// d/sigma of the products.
pub const SEPARATIONS: [f64; 2] = [0.5, 2.0];

/// Sets with the numbers of `population`, but skewed heights and log-normal radii, of which sharper ones belong to higher
/// asperities; `seed(what)` seeds them, `done` is called after each size.
///
/// # Errors
/// A population that makes no set.
pub fn attributions_on(
    contact: &dyn MicroContact,
    bodies: (&Material, &Material),
    population: &Population,
    task: &AttributionTask,
    seed: impl Fn(&str) -> [u8; 32],
    done: impl Fn(),
) -> Result<AttributionFindings, SetError> {
    let set = |count: usize| {
        correlated(population, count, ["heights", "radii"].map(|what| seed(&format!("{what} {count}"))))
    };
    let mut points = Vec::new();
    for &count in &task.counts {
        points.push(point(contact, &set(count)?, task.loads));
        done();
    }
    let set = set(MULTIPLIED)?;
    let laws = registry().iter().filter(|law| !law.is_elliptic());
    let products = laws.filter_map(|law| {
        // A law whose properties the materials lack is left out.
        let contact = law.interface(bodies.0, &Flat::Bare(*bodies.1)).ok()?;
        Some(product(&*contact, &law.name(), &set))
    });
    Ok(AttributionFindings { products: products.collect(), points })
}

/// Skewness 0.6 of the heights, radii of a coefficient of variation of 0.66 with the correlation -0.5 of their logarithms.
fn correlated(population: &Population, count: usize, seeds: [[u8; 32]; 2]) -> Result<AsperitySet, SetError> {
    const BEND: f64 = 0.1;
    const SPREAD: f64 = 0.6;
    const CORRELATION: f64 = -0.5;
    let normal = Population { sigma: 1.0, radius: 1.0, density: 1.0, heights: Heights::GAUSSIAN };
    let [first, second] = seeds.map(|seed| normal.set(count, Draw::Random(seed)));
    let (first, second) = (first?, second?);
    let (heights, radii) = first
        .heights()
        .iter()
        .zip(second.heights())
        .map(|(&a, &b)| {
            let along = CORRELATION * a + (1.0 - CORRELATION * CORRELATION).sqrt() * b;
            (population.sigma * (a + BEND * a * a), population.radius * (SPREAD * along).exp())
        })
        .unzip();
    AsperitySet::new(heights, radii, count as f64 / population.density)
}

fn inputs(set: &AsperitySet) -> Inputs<'_> {
    let statistics = Statistics::of(set);
    let plane = ReferencePlane::from(&statistics);
    Inputs {
        asperities: set.spheres(),
        plane,
        population: Population {
            radius: statistics.mean_radius,
            sigma: statistics.sigma,
            density: set.density(),
            heights: Heights::GAUSSIAN,
        },
        mean_shape: Shape::sphere(statistics.mean_radius),
        reporting_plane: ReferencePlane { mean: 0.0, sigma: plane.sigma },
    }
}

fn point(contact: &dyn MicroContact, set: &AsperitySet, loads: usize) -> AttributionPoint {
    /// d/sigma of the lightest and of the heaviest load.
    const ENDS: [f64; 2] = [1.5, 0.0];
    let Inputs { plane, population, .. } = inputs(set);
    let statistical = Statistical::new(contact, population);
    let deterministic = Deterministic::new(contact, set.spheres(), plane);
    let [light, heavy] = ENDS.map(|h| deterministic.respond(h).pressure.total());
    let load = |k: usize| light * (heavy / light).powf(k as f64 / (loads - 1) as f64);
    let loads: Vec<f64> = (0..loads).map(load).collect();
    let pairs = || pairs_at(&statistical, &deterministic, black_box(&loads));
    let found: Vec<Pair> = pairs().into_iter().flatten().collect();
    let attribution = || -> Vec<Attribution> {
        Rearranged::new(inputs(set)).at_loads(contact, black_box(&found)).attributions(None)
    };
    let divided = attribution().iter().filter(|at| at.quantities.iter().any(Option::is_some)).count();
    let mut candidates: [Candidate; 2] =
        [Box::new(|| drop(black_box(pairs()))), Box::new(|| drop(black_box(attribution())))];
    let times = medians(&mut candidates);
    AttributionPoint {
        asperities: set.count(),
        loads: loads.len(),
        divided,
        model_seconds: times[0],
        attribution_seconds: times[1],
    }
}

fn product(contact: &dyn MicroContact, law: &str, set: &AsperitySet) -> ProductPoint {
    let rearranged = Rearranged::new(inputs(set));
    let plane = inputs(set).plane;
    let condensed = || SEPARATIONS.map(|h| rearranged.independent_pressure(contact, h));
    let all = || SEPARATIONS.map(|h| of_all_pairs(contact, set, plane.mean + h * plane.sigma));
    let [found, exact] = [condensed(), all()];
    let errors = found.iter().zip(&exact).map(|(found, exact)| (found / exact - 1.0).abs());
    let mut candidates: [Candidate; 2] =
        [Box::new(|| _ = black_box(condensed())), Box::new(|| _ = black_box(all()))];
    let times = medians(&mut candidates);
    ProductPoint {
        law: law.to_owned(),
        asperities: set.count(),
        error: errors.fold(0.0, f64::max),
        speedup: times[1] / times[0],
    }
}

/// The pressure of every height with every radius, Pa, at `separation` (m): the simple version.
fn of_all_pairs(contact: &dyn MicroContact, set: &AsperitySet, separation: f64) -> f64 {
    let above: Vec<f64> = set.heights().iter().copied().filter(|&z| z > separation).collect();
    let of_height = |&z: &f64| {
        let mut sum = Sum::default();
        for &b in set.radii() {
            sum += contact.contact(z - separation, Shape::sphere(b)).load;
        }
        sum.value()
    };
    let each: Vec<f64> = above.par_iter().map(of_height).collect();
    let mut sum = Sum::default();
    for load in each {
        sum += load;
    }
    sum.value() / set.count() as f64 / set.nominal_area()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_within_what_is_stated() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), Some(2.5e9)).unwrap();
        let population = Population { radius: 2e-5, sigma: 48e-9, density: 6e10, heights: Heights::GAUSSIAN };
        let contact =
            asperity::contact_law::named("zmc").unwrap().interface(&steel, &Flat::Bare(steel)).unwrap();
        let task = AttributionTask { counts: vec![2000, 20_000], loads: 5 };
        let seed = |what: &str| [what.len() as u8; 32];
        let found = attributions_on(&*contact, (&steel, &steel), &population, &task, seed, || ()).unwrap();
        assert_eq!(found.points.iter().map(|point| point.asperities).collect::<Vec<_>>(), task.counts);
        assert!(found.points.iter().all(|point| point.divided == 5 && point.attribution_seconds > 0.0));
        assert!(found.products.len() > 5);
        for product in &found.products {
            let bound = match product.law.as_str() {
                "hertz" | "zmc" => 1e-7,
                "ceb" => 1e-6,
                _ => 2e-7,
            };
            assert!(product.error < bound && product.error > 0.0, "{product:?}");
        }
    }
}
