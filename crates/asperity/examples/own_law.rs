//! A user-defined law: Thornton's elastic, perfectly plastic sphere, common in granular mechanics. It is used in both
//! models like the laws of this crate.
//!
//! `cargo run --release -p asperity --example own_law`

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};

use asperity::law::Property;
use asperity::numeric::lanes::Real;
use asperity::{
    Contacts, Deterministic, Draw, Heights, Hertz, Interface, Law, Material, Model, Pair, Pairs, Paper,
    Population, Statistical, YieldLimits,
};

/// Hertz up to w_y, where the pressure at the centre of the contact reaches the limit p_y; beyond it the pressure is
/// limited to p_y, which every increment of area carries:
///
/// ```text
/// A = pi b w
/// P = (4/3) E* b^.5 w^1.5                    w < w_y = b (pi p_y/(2 E*))^2
/// P = P(w_y) + pi p_y b (w - w_y)            w > w_y      (Thornton 1997)
/// ```
///
/// Load and stiffness are continuous. The limit is the hardness of the softer body here. Equations and reference have
/// not been checked against the paper; they only show how to add a law.
#[derive(Debug, Clone, Copy)]
struct Thornton;

impl Law for Thornton {
    fn name(&self) -> &'static str {
        "thornton"
    }

    fn about(&self) -> &'static str {
        "Elastic, then plastic where the Hertzian pressure exceeds a limit."
    }

    fn papers(&self) -> &'static [Paper] {
        &[Paper {
            short: "Thornton 1997",
            full: "Thornton, C. (1997). Coefficient of restitution for collinear collisions of elastic-perfectly plastic \
                   spheres. ASME Journal of Applied Mechanics 64(2), 383-386. doi:10.1115/1.2787319",
        }]
    }

    fn yields_by(&self) -> Option<Property> {
        Some(Property::Hardness)
    }

    fn yield_limits(&self, body: &Material) -> Result<YieldLimits, Property> {
        let limit = |hardness| YieldLimits { onset: hardness, strength: hardness };
        Ok(body.hardness().map_or(YieldLimits::NEVER_YIELDS, limit))
    }

    // One formula for scalars and vector registers: no branches, but a selection between both sides of w_y.
    #[inline(always)]
    fn contacts<N: Real>(&self, w: N, b: N, pair: &Pairs<N>) -> Contacts<N> {
        let limit = pair.yield_limits.onset;
        let strain = limit / pair.reduced_modulus * FRAC_PI_2;
        let w_y = b * strain * strain;
        let is_elastic = w.lt(w_y);
        // Hertz at min(w, w_y).
        let hertz = N::select(is_elastic, w, w_y);
        let slope = pair.reduced_modulus * 2.0 * (b * hertz).sqrt();
        Contacts {
            area: b * w * PI,
            load: slope * (hertz * (2.0 / 3.0) + (w - hertz)),
            stiffness: slope,
            elastic: is_elastic,
            plastic: !w.all_true(),
        }
    }

    fn critical_ratios(&self, pair: &Pair) -> Vec<f64> {
        if pair.yield_limits.onset.is_finite() { vec![pair.ratio(FRAC_PI_2 * FRAC_PI_2)] } else { Vec::new() }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None)?;
    let contact = Interface::bare(Thornton, &steel, &steel)?;
    let hertz = Interface::bare(Hertz, &steel, &steel)?;
    let population = Population { radius: 5e-6, sigma: 100e-9, density: 9e10, heights: Heights::GAUSSIAN };
    let set = population.set(100_000, Draw::Random([3; 32]))?;
    let sum = Deterministic::new(&contact, set.spheres(), (&population).into());
    let integral = Statistical::new(&contact, population.clone());
    let elastic = Statistical::new(&hertz, population);

    println!(
        "{:>9} {:>14} {:>12} {:>9} {:>18}",
        "d [sigma]", "Hertz p [MPa]", "Thornton p", "its sum", "elastic share [%]"
    );
    for d in [4.0, 3.0, 2.0, 1.0, 0.0] {
        let at = integral.respond(d);
        let [share, ..] = at.pressure.shares().ok_or("nothing touches")?;
        println!(
            "{d:9.1} {:14.4} {:12.4} {:9.4} {:18.2}",
            1e-6 * elastic.respond(d).pressure.total(),
            1e-6 * at.pressure.total(),
            1e-6 * sum.respond(d).pressure.total(),
            1e2 * share,
        );
    }
    Ok(())
}
