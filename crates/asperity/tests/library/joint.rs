//! Joint densities of height and curvature against sums over the summits of generated Gaussian surfaces.

use asperity::contact_law::named;
use asperity::topography::Drops;
use asperity::topography::generate::{Process, Seeds, SpectrumOf, SurfaceGenerator};
use asperity::topography::joint::JointDensity;
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumShape};
use asperity::topography::summits::{Detail, Neighbours, find};
use asperity::{
    AsperitySet, Deterministic, Flat, Heights, Material, Model, Population, ReferencePlane, Statistical,
    Statistics, SummitShape, joint_model,
};

const SIGMA: f64 = 2.5e-7;
const PIXEL: f64 = 1e-6;
const POINTS: usize = 512;
/// Correlation length in pixels: finely sampled.
const LENGTH: f64 = 12.0;
const REALISATIONS: u8 = 16;
/// Separations above the mean plane, in sigma of the surface.
const SEPARATIONS: [f64; 3] = [0.5, 1.0, 2.0];

/// Summits of each realisation as spheres of radius 2/(k1 + k2).
fn sets(neighbours: Neighbours) -> Vec<AsperitySet> {
    let spectrum = Spectrum::new(SpectrumShape::Gaussian(LENGTH * PIXEL), Lay::default()).unwrap();
    let process = Process { spectrum, of: SpectrumOf::Heights, sigma: SIGMA, heights: Heights::GAUSSIAN };
    let generator = SurfaceGenerator { points: [POINTS; 2], pixel: [PIXEL; 2], process, plateau: None };
    let set = |seed| {
        let seeds = Seeds { process: [seed; 32], plateau: [0; 32] };
        let map = generator.surface(seeds).unwrap().0;
        let summits = find(&map, neighbours, Detail::default());
        let radii = summits.curvatures.iter().map(|curvature| curvature.recip()).collect();
        AsperitySet::new(summits.heights, radii, (POINTS as f64 * PIXEL).powi(2)).unwrap()
    };
    (1..=REALISATIONS).map(set).collect()
}

/// Pressures and area ratios of a model at all separations.
fn results(model: &dyn Model) -> Vec<[f64; 2]> {
    let all = model.respond_all(&SEPARATIONS);
    all.iter().map(|one| [one.pressure.total(), one.area_ratio.total()]).collect()
}

/// The largest distance of the results of a joint density and of Gaussian heights with the mean radius from the mean of the sums, in
/// standard errors of the latter.
fn distances(sets: &[AsperitySet], joint: &JointDensity) -> [f64; 2] {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
    let contact = named("zmc").unwrap().interface(&steel, &Flat::Bare(steel)).unwrap();
    let plane = ReferencePlane { mean: 0.0, sigma: SIGMA };
    let sums: Vec<_> =
        sets.iter().map(|set| results(&Deterministic::new(&*contact, set.spheres(), plane))).collect();
    let statistics: Vec<Statistics> = sets.iter().map(Statistics::new).collect();
    let mean = |of: fn(&Statistics) -> f64| statistics.iter().map(of).sum::<f64>() / statistics.len() as f64;
    let population = Population {
        radius: mean(|one| one.mean_radius),
        sigma: mean(|one| one.sigma),
        density: sets.iter().map(AsperitySet::density).sum::<f64>() / sets.len() as f64,
        heights: Heights::GAUSSIAN,
    };
    let plane_of_mean = ReferencePlane { mean: -mean(|one| one.mean_height), sigma: SIGMA };
    let zhao = Statistical::new(&*contact, population).reported_from(plane_of_mean);
    let joint = joint_model(&*contact, joint, SummitShape::ArithmeticMean, plane);
    let models: [&dyn Model; 2] = [&joint, &zhao];
    models.map(|model| {
        let expected = results(model);
        let mut farthest = 0.0f64;
        for (at, expected) in expected.iter().enumerate() {
            for (quantity, expected) in expected.iter().enumerate() {
                let each: Vec<f64> = sums.iter().map(|sum| sum[at][quantity]).collect();
                let count = each.len() as f64;
                let mean = each.iter().sum::<f64>() / count;
                let variance = each.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / (count - 1.0);
                farthest = farthest.max(((mean - expected) / (variance / count).sqrt()).abs());
            }
        }
        farthest
    })
}

/// The five-point density is that of the summits the sum is fed with: exact on any grid.
#[test]
fn the_five_point_density_agrees_with_the_sum_and_one_mean_radius_does_not() {
    let of_unit_variance = Drops::from_correlation(|i, j| (-(i * i + j * j) / (LENGTH * LENGTH)).exp());
    let scaled = |value: f64| value * SIGMA * SIGMA;
    let drops = Drops {
        first: of_unit_variance.first.map(scaled),
        second: of_unit_variance.second.map(scaled),
        mixed: scaled(of_unit_variance.mixed),
        skew: scaled(of_unit_variance.skew),
    };
    let joint = JointDensity::five_point(&drops, SIGMA, [PIXEL; 2]).unwrap();
    let [joint, zhao] = distances(&sets(Neighbours::Four), &joint);
    assert!(joint < 3.5, "{joint}");
    assert!(zhao > 7.0, "{zhao}");
}

/// Nayak's density is that of a continuous surface, to which the summits above eight neighbours tend.
#[test]
fn nayak_s_density_agrees_with_the_sum_over_summits_above_eight_neighbours() {
    let length = LENGTH * PIXEL;
    let [m0, m2, m4] = [SIGMA.powi(2), 2.0 * (SIGMA / length).powi(2), 12.0 * SIGMA.powi(2) / length.powi(4)];
    let joint = JointDensity::nayak([m0, m2, m4]).unwrap();
    let [joint, zhao] = distances(&sets(Neighbours::Eight), &joint);
    assert!(joint < 3.5, "{joint}");
    assert!(zhao > 7.0, "{zhao}");
}
