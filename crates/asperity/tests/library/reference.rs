//! The models against vectors computed at 40 digits from the published equations alone
//! (`tests/reference/README.md`). Every published claim of accuracy is one of these tests.

use crate::common::{Row, Worst, bare_contact, rows};
use asperity::distribution::gaussian_moment;
use asperity::numeric::Interval;
use asperity::spot::{
    Conduction, Correlation, Joint, SpotProperties, SpotQuantity, Tangential, cluster_conductance,
};
use asperity::{
    Ceb, Contact, Flat, Heights, Hertz, JacksonGreen, KogutEtsion, Law, LoadBounds, Material, MicroContact,
    Model, Pair, Paper, Population, Regime, ScalableLaw, Shape, Shapes, Statistical, WithSpots, YieldLimits,
    Zmc,
};

/// The worst error of a law over zmc.csv, given how it is made from a row's transition ratio, and the number of wrong regimes.
fn zmc_error(law: impl Fn(f64) -> Zmc) -> (Worst, usize) {
    let (mut worst, mut wrong_regimes) = (Worst::default(), 0);
    for (k, row) in rows("zmc").iter().enumerate() {
        let law = law(row.number("transition_ratio"));
        let yield_limits = law.limits_at(row.number("hardness"), 0.3);
        let pair = Pair { reduced_modulus: row.number("reduced_modulus"), yield_limits };
        let found = law.contact(row.number("indentation"), row.number("radius"), &pair);
        worst.see(found.area, row.number("area"), || format!("area of row {k}"));
        worst.see(found.load, row.number("load"), || format!("load of row {k}"));
        let ratio = row.number("indentation") / row.number("radius");
        // Away from a boundary by more than its rounding the regime is exact too.
        let is_sure = law.critical_ratios(&pair).iter().all(|c| (ratio / c - 1.0).abs() > 1e-15);
        wrong_regimes += usize::from(is_sure && found.regime.name() != row.text("regime"));
    }
    (worst, wrong_regimes)
}

#[test]
fn zmc_contact() {
    let (worst, wrong_regimes) = zmc_error(|ratio| Zmc::new(Zmc::ONSET, ratio).unwrap());
    worst.assert_within(1e-14, 480);
    assert_eq!(wrong_regimes, 0);
}

/// The worst error of one law over its rows of laws.csv, given what it makes of a pair and what a row's body sets against
/// yielding.
fn law_error<L: Law>(
    law: impl Fn(&Pair) -> L,
    name: &str,
    yield_limits: impl Fn(&Material) -> YieldLimits,
) -> Worst {
    let mut worst = Worst::default();
    for (k, row) in rows("laws").iter().enumerate().filter(|(_, row)| row.text("law") == name) {
        let known = |column: &str| (!row.text(column).is_empty()).then(|| row.number(column));
        let poisson = row.number("poisson");
        let body = Material::new(1e11, poisson, known("hardness"), known("yield_strength")).unwrap();
        let pair = Pair { reduced_modulus: row.number("reduced_modulus"), yield_limits: yield_limits(&body) };
        let found = law(&pair).contact(row.number("indentation"), row.number("radius"), &pair);
        worst.see(found.area, row.number("area"), || format!("area of row {k}"));
        worst.see(found.load, row.number("load"), || format!("load of row {k}"));
    }
    worst
}

#[test]
fn other_laws() {
    let jackson_green = JacksonGreen::default;
    let of_strength = |body: &Material| jackson_green().yield_limits(body).unwrap();
    law_error(|_| Ceb, "ceb", |body| Ceb.yield_limits_by_hardness(body)).assert_within(1e-13, 480);
    law_error(|_| KogutEtsion, "kogut_etsion", |body| KogutEtsion.yield_limits_by_hardness(body))
        .assert_within(1e-13, 480);
    law_error(|_| jackson_green(), "jackson_green", of_strength).assert_within(1e-13, 350);
    law_error(|pair| jackson_green().tuned(pair), "jackson_green", of_strength).assert_within(1e-13, 350);
}

/// A micro-contact whose area is w^n: the integrator alone.
struct Power(f64);

impl MicroContact for Power {
    fn contact(&self, w: f64, _: Shape) -> Contact {
        Contact { area: w.powf(self.0), load: 0.0, stiffness: 0.0, regime: Regime::Elastic }
    }
    fn regime_changes(&self, _: Shape) -> Vec<f64> {
        Vec::new()
    }
    fn breakpoints(&self, _: Shape) -> Vec<f64> {
        Vec::new()
    }
    fn may_decrease(&self, _: Shapes) -> Vec<Interval> {
        Vec::new()
    }
    fn load_over(&self, _: f64, _: f64, _: Shape) -> LoadBounds {
        LoadBounds { highest: 0.0, slopes: Interval::point(0.0) }
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

const UNIT: Population = Population { radius: 1.0, sigma: 1.0, density: 1.0, heights: Heights::GAUSSIAN };

#[test]
fn moments_of_the_gaussian_tail() {
    // E* = 1: two bodies of E = 2, nu = 0.
    let body = Material::new(2.0, 0.0, None, None).unwrap();
    let hertz = bare_contact("hertz", &[], &body);
    let model = Statistical::new(&*hertz, UNIT);
    let mut worst = Worst::default();
    for row in rows("gw_integrals") {
        let (n, h) = (row.number("n"), row.number("h"));
        let found = match n {
            0.0 => model.respond(h).contact_density,
            1.0 => model.respond(h).area_ratio.total() / std::f64::consts::PI,
            1.5 => model.respond(h).pressure.total() * 0.75,
            _ => Statistical::new(&Power(n), UNIT).respond(h).area_ratio.total(),
        };
        for found in [found, gaussian_moment(n, h)] {
            worst.see(found, row.number("F_n"), || format!("n = {n}, h = {h}"));
        }
    }
    worst.assert_within(1e-13, 300);
}

/// The worst errors of the model over statistical.csv, up to 20 sigma and beyond, given how the
/// micro-contact is made of two equal bodies.
fn statistical_error(contact: impl Fn(&Material) -> Box<dyn MicroContact>) -> [Worst; 2] {
    let mut worst = [Worst::default(), Worst::default()];
    for row in rows("statistical") {
        let hardness = Some(row.number("hardness"));
        let body = Material::new(row.number("young"), row.number("poisson"), hardness, None).unwrap();
        let contact = contact(&body);
        let population = Population {
            radius: row.number("radius"),
            sigma: row.number("sigma"),
            density: row.number("density"),
            heights: Heights::GAUSSIAN,
        };
        let h = row.number("separation_over_sigma");
        let found = Statistical::new(&*contact, population).respond(h);
        let worst = &mut worst[usize::from(h > 20.0)];
        worst.see(found.area_ratio.total(), row.number("area_ratio"), || format!("area at h = {h}"));
        worst.see(found.pressure.total(), row.number("pressure"), || format!("pressure at h = {h}"));
    }
    worst
}

fn zmc(onset: f64, ratio: f64) -> impl Fn(&Material) -> Box<dyn MicroContact> {
    move |body| bare_contact("zmc", &[("onset", onset), ("transition-ratio", ratio)], body)
}

#[test]
fn statistical_zmc() {
    let [near, far] = statistical_error(zmc(Zmc::ONSET, 54.0));
    near.assert_within(1e-13, 192);
    far.assert_within(2e-13, 16);
}

/// A micro-contact that does not report one of its breakpoints.
struct Forgetful {
    contact: Box<dyn MicroContact>,
    forgotten: usize,
}

impl MicroContact for Forgetful {
    fn contact(&self, w: f64, shape: Shape) -> Contact {
        self.contact.contact(w, shape)
    }
    fn breakpoints(&self, shape: Shape) -> Vec<f64> {
        let mut all = self.contact.breakpoints(shape);
        all.remove(self.forgotten);
        all
    }
    fn regime_changes(&self, shape: Shape) -> Vec<f64> {
        self.contact.regime_changes(shape)
    }
    fn may_decrease(&self, shapes: Shapes) -> Vec<Interval> {
        self.contact.may_decrease(shapes)
    }
    fn load_over(&self, from: f64, to: f64, shape: Shape) -> LoadBounds {
        self.contact.load_over(from, to, shape)
    }
    fn reference_modulus(&self) -> f64 {
        self.contact.reference_modulus()
    }
    fn reference_hardness(&self) -> f64 {
        self.contact.reference_hardness()
    }
    fn papers(&self) -> Vec<Paper> {
        self.contact.papers()
    }
}

/// Plausible mistakes give errors far outside the bounds above. (A divisor of n - 1 is caught by the exact tests of the
/// statistics.)
#[test]
fn the_references_bite() {
    let rounded = |ratio| Zmc::new(0.89, ratio).unwrap();
    let early = |ratio: f64| Zmc::new(Zmc::ONSET, ratio * 53.0 / 54.0).unwrap();
    for (mutant, _) in [zmc_error(rounded), zmc_error(early)] {
        assert!(mutant.error() > 1e-10, "{:e}", mutant.error());
    }
    for mutant in [zmc(0.89, 54.0), zmc(Zmc::ONSET, 53.0)] {
        let [near, far] = statistical_error(mutant);
        assert!(near.error() > 1e-10 && far.error() > 1e-10);
    }
    let nearly = |onset: f64, strength: f64| YieldLimits { onset, strength };
    let limits_at = |body: &Material| {
        let hardness = body.hardness().unwrap();
        nearly((0.454 + 0.4101 * body.poisson()) * hardness, hardness)
    };
    let of_strength = |body: &Material| {
        let strength = body.yield_strength().unwrap();
        nearly(1.2951 * (0.736 * body.poisson()).exp() * strength, strength)
    };
    let mutants = [
        law_error(|_| Ceb, "ceb", limits_at),
        law_error(|_| KogutEtsion, "kogut_etsion", limits_at),
        law_error(|_| JacksonGreen::default(), "jackson_green", of_strength),
    ];
    for mutant in mutants {
        assert!(mutant.error() > 1e-6, "{:e}", mutant.error());
    }
    for forgotten in [0, 1] {
        let contact = |body: &Material| -> Box<dyn MicroContact> {
            Box::new(Forgetful { contact: bare_contact("zmc", &[], body), forgotten })
        };
        let [near, _] = statistical_error(contact);
        assert!(near.error() > 1e-10, "breakpoint {forgotten}: {:e}", near.error());
    }
}

/// The worst error over the rows of conductance.csv of one kind.
fn conductance_error(what: &str, value: impl Fn(&Row) -> f64) -> Worst {
    let mut worst = Worst::default();
    for (k, row) in rows("conductance").iter().enumerate().filter(|(_, row)| row.text("what") == what) {
        worst.see(value(row), row.number("value"), || format!("{what} of row {k}"));
    }
    worst
}

#[test]
fn conductances_and_tangential_stiffness() {
    let of =
        |row: &Row| Conduction::new(["resistivity_1", "resistivity_2"].map(|key| row.number(key))).unwrap();
    let filmed = |row: &Row| of(row).with_film(row.number("film")).unwrap();
    conductance_error("circle", |row| filmed(row).conductance(row.number("area"), 1.0))
        .assert_within(1e-15, 40);
    let ellipse = |row: &Row| {
        let shape = Shape::ellipse(1.0, row.number("curvature_ratio"));
        filmed(row).conductance(row.number("area"), shape.spheres)
    };
    conductance_error("ellipse", ellipse).assert_within(1e-13, 40);
    let integral = |row: &Row| {
        let [radius, sigma, density] = ["radius", "sigma", "density"].map(|key| row.number(key));
        let steel = Material::new(210e9, 0.3, None, None).unwrap();
        let properties = SpotProperties { electrical: Some(of(row)), ..SpotProperties::default() };
        let contact = WithSpots::new(Flat::Bare(steel).under(Hertz, &steel).unwrap(), properties);
        let population = Population { radius, sigma, density, heights: Heights::GAUSSIAN };
        let response = Statistical::new(&contact, population).respond(row.number("separation"));
        response.spots[SpotQuantity::ElectricalConductance as usize]
    };
    conductance_error("greenwood-williamson", integral).assert_within(1e-13, 12);
    let tangential = |row: &Row| {
        let body =
            |young, poisson| Material::new(row.number(young), row.number(poisson), None, None).unwrap();
        let pair = Tangential::new(&body("young_1", "poisson_1"), &body("young_2", "poisson_2"));
        pair.stiffness(row.number("area"), 1.0)
    };
    conductance_error("tangential", tangential).assert_within(1e-15, 20);
    let two_spots = |row: &Row| {
        let [a, b, distance] = ["radius", "radius_2", "distance"].map(|key| row.number(key));
        cluster_conductance(&[(a, [0.0; 2]), (b, [0.0, distance])])
    };
    conductance_error("two-spots", two_spots).assert_within(1e-15, 20);
    let correlation = |row: &Row| {
        let [sigma, slope, hardness] = ["sigma", "slope", "hardness"].map(|key| row.number(key));
        let joint = Joint { sigma, slope, modulus: 1e11, hardness };
        let found = Correlation::CooperMikicYovanovich.conductance(&joint, row.number("pressure")).unwrap();
        found / of(row).resistivity()
    };
    conductance_error("cooper-mikic-yovanovich", correlation).assert_within(2e-15, 20);
}
