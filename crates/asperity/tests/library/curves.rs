//! The sum over asperities far from the flat.

use crate::common::bare_contact;
use asperity::{
    AsperitySet, Deterministic, Draw, Heights, Material, Model, Population, ReferencePlane, Response, Shape,
};

/// At a large separation few asperities are touched: the response is that of these only.
#[test]
fn far_separations_are_those_of_the_asperities_that_stand_out() {
    let case = Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN };
    let steel = Material::new(210e9, 0.3, Some(7.6e9), Some(2.7e9)).unwrap();
    let zmc = bare_contact("zmc", &[], &steel);
    let set = case.set(300_000, Draw::Random([4; 32])).unwrap();
    let plane = ReferencePlane { mean: 0.0, sigma: case.sigma };
    let highest = |z: &f64| *z > 2.5 * plane.sigma;
    let heights: Vec<f64> = set.heights().iter().copied().filter(highest).collect();
    let radii = vec![case.radius; heights.len()];
    let few = AsperitySet::new(heights, radii, set.nominal_area()).unwrap();
    let [all, few] = [&set, &few].map(|set| Deterministic::new(&*zmc, set.spheres(), plane));
    let far: Vec<f64> = (0..40).map(|k| 2.6 + 0.05 * f64::from(k)).collect();
    let (found, expected) = (all.respond_all(&far), few.respond_all(&far));
    for (found, expected) in found.iter().zip(&expected) {
        assert_eq!(found.contact_density, expected.contact_density);
        for part in [|response: &Response| response.pressure, |response: &Response| response.area_ratio] {
            let [found, expected] = [found, expected].map(|response| part(response).total());
            assert!((found - expected).abs() <= 1e-14 * expected, "{found} {expected}");
        }
        // Those that touch nothing count.
        let touching = set.heights().iter().map(|z| z - found.separation).filter(|w| *w > 0.0);
        let loads: Vec<f64> = touching.map(|w| zmc.contact(w, Shape::sphere(case.radius)).load).collect();
        let [sum, squares] = [1, 2].map(|power| loads.iter().map(|load| load.powi(power)).sum::<f64>());
        let error = (squares - sum * sum / set.count() as f64).sqrt() / set.nominal_area();
        let stated = found.sampling.unwrap().pressure;
        assert!((stated - error).abs() <= 1e-5 * error, "{stated} {error}");
    }
}
