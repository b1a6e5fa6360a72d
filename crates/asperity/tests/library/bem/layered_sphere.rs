//! A rigid sphere on a bonded layer: the independent solutions of `tests/reference/layered_sphere.csv`.

use std::f64::consts::PI;

use asperity::Material;
use asperity::bem::{Boundary, ElasticPair, Solver};
use asperity::progress::Silent;

use super::{options, paraboloid};
use crate::common::rows;

#[test]
fn all_rows_at_102_pixels_per_contact_radius() {
    let rows = rows("layered_sphere");
    assert_eq!(rows.len(), 10);
    // Its compliance is below rounding.
    let rigid = Material::new(1e30, 0.3, None, None).unwrap();
    for row in &rows {
        let body = |young: &str, poisson: &str| {
            Material::new(row.number(young), row.number(poisson), None, None).unwrap()
        };
        let layer = body("layer_young", "layer_poisson");
        let pair =
            ElasticPair::new(&rigid, &body("substrate_young", "substrate_poisson"), Some((&layer, 1.0)));
        let a = row.number("contact_radius");
        let (count, pixel) = (255, a / 102.0);
        let (map, _) = paraboloid(count, pixel);
        let nominal = (count as f64 * pixel).powi(2);
        let modulus = layer.young() / (1.0 - layer.poisson().powi(2));
        let load = row.number("load") * modulus;
        let solver = Solver::new(&map, &pair, &options(Boundary::Finite, 1e-9, None)).unwrap();
        let contact = solver.at_pressure(load / nominal, &Silent).unwrap();
        let indentation = contact.approach() / row.number("indentation") - 1.0;
        assert!(indentation.abs() < 1e-5, "{:?} a = {a}: {indentation:e}", row.number("layer_young"));
        let area = contact.area_ratio() * nominal / (PI * a * a) - 1.0;
        assert!(area.abs() < 3e-3, "a = {a}: {area:e}");
    }
}
