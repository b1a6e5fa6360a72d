//! The models against vectors computed at 40 digits from the published equations alone
//! (`tests/reference/README.md`). Every published claim of accuracy is one of these tests.

mod common;

use asperity::asperity::{AsperitySet, HeightDensity, Ordered, Population};
use asperity::contact::{Contact, Regime, Tally};
use asperity::interface::{Interface, MicroContact};
use asperity::law::{Hertz, Law, Pair, Zmc};
use asperity::literature::Paper;
use asperity::material::Material;
use asperity::model::{Datum, Deterministic, Model, Statistical};
use common::{Worst, rows};

#[test]
fn zmc_contact() {
    let mut worst = Worst::default();
    for (k, row) in rows("zmc").iter().enumerate() {
        let law = Zmc::new(Zmc::ONSET, row.number("transition_ratio")).unwrap();
        let pair = Pair { reduced_modulus: row.number("reduced_modulus"), hardness: row.number("hardness") };
        let found = law.contact(row.number("indentation"), row.number("radius"), &pair);
        worst.see(found.area, row.number("area"), || format!("area of row {k}"));
        worst.see(found.load, row.number("load"), || format!("load of row {k}"));
        let critical = law.critical_ratios(&pair);
        let ratio = row.number("indentation") / row.number("radius");
        if critical.iter().all(|c| (ratio / c - 1.0).abs() > 1e-15) {
            assert_eq!(found.regime.name(), row.text("regime"), "row {k}");
        }
    }
    worst.assert_within(1e-14, 480);
}

/// A micro-contact whose area is w^n: the integrator alone.
struct Power(f64);

impl MicroContact for Power {
    fn contact(&self, w: f64, _: f64) -> Contact {
        Contact { area: w.powf(self.0), load: 0.0, stiffness: 0.0, regime: Regime::Elastic }
    }
    fn breakpoints(&self, _: f64) -> Vec<f64> {
        Vec::new()
    }
    fn load_falls(&self) -> bool {
        false
    }
    fn reference_modulus(&self) -> f64 {
        1.0
    }
    fn reference_hardness(&self) -> f64 {
        f64::INFINITY
    }
    fn papers(&self) -> Vec<Paper> {
        Vec::new()
    }
}

const UNIT: Population =
    Population { radius: 1.0, sigma: 1.0, density: 1.0, heights: HeightDensity::Gaussian };

#[test]
fn moments_of_the_gaussian_tail() {
    // E* = 1: two bodies of E = 2, nu = 0.
    let body = Material::new(2.0, 0.0, None, None).unwrap();
    let hertz = Interface::bare(Hertz, &body, &body);
    let model = Statistical::new(&hertz, UNIT);
    let mut worst = Worst::default();
    for row in rows("gw_integrals") {
        let (n, h) = (row.number("n"), row.number("h"));
        let found = match n {
            0.0 => model.respond(h).contact_density,
            1.0 => model.respond(h).area_ratio.total() / std::f64::consts::PI,
            1.5 => model.respond(h).pressure.total() * 0.75,
            _ => Statistical::new(&Power(n), UNIT).respond(h).area_ratio.total(),
        };
        worst.see(found, row.number("F_n"), || format!("n = {n}, h = {h}"));
    }
    worst.assert_within(1e-13, 150);
}

#[test]
fn statistical_zmc() {
    let (mut near, mut far) = (Worst::default(), Worst::default());
    for row in rows("statistical") {
        let body =
            Material::new(row.number("young"), row.number("poisson"), Some(row.number("hardness")), None)
                .unwrap();
        let zmc = Interface::bare(Zmc::default(), &body, &body);
        let population = Population {
            radius: row.number("radius"),
            sigma: row.number("sigma"),
            density: row.number("density"),
            heights: HeightDensity::Gaussian,
        };
        let h = row.number("separation_over_sigma");
        let found = Statistical::new(&zmc, population).respond(h);
        let worst = if h <= 20.0 { &mut near } else { &mut far };
        worst.see(found.area_ratio.total(), row.number("area_ratio"), || format!("area at h = {h}"));
        worst.see(found.pressure.total(), row.number("pressure"), || format!("pressure at h = {h}"));
    }
    near.assert_within(1e-13, 120);
    far.assert_within(2e-13, 16);
}

/// The bare rows: lead of thickness 0 on steel, and lead all through.
#[test]
fn sums_over_bare_asperities() {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
    let lead = Material::new(18e9, 0.35, Some(0.17e9), None).unwrap();
    let asperities = rows("asperities");
    let mut worst = Worst::default();
    for row in rows("asperity_sums") {
        let flat = match row.text("lead_thickness") {
            "0.0" => steel,
            "inf" => lead,
            _ => continue,
        };
        let members = || asperities.iter().filter(|a| a.text("set") == row.text("set"));
        let heights = members().map(|a| a.number("height")).collect();
        let radii = members().map(|a| a.number("radius")).collect();
        let set = Ordered::new(&AsperitySet::new(heights, radii, 1.0).unwrap());
        let zmc = Interface::bare(Zmc::default(), &steel, &flat);
        let d = row.number("separation");
        let found: Tally = Deterministic::new(&zmc, &set, Datum { mean: 0.0, sigma: 1.0 }).tally(d);
        let place = || format!("set {} at {d:e}", row.text("set"));
        assert_eq!(found.contacts(), row.number("contacts"), "{}", place());
        worst.see(found.area().total(), row.number("total_area"), place);
        worst.see(found.load().total(), row.number("total_load"), place);
    }
    worst.assert_within(1e-13, 60);
}
