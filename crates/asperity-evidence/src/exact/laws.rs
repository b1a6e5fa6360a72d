//! Areas and loads of laws in extended precision (docs/theory.md, section 1), by name: a law of the registry that is not in
//! [`TWINS`] is not covered.

use crate::wide::{PI, Wide};
use asperity::contact_law::{named, registry};
use asperity::law::OptionError;
use asperity::{ContactLaw, Regime, Zmc};

/// A law with its equations in extended precision.
#[derive(Debug, Clone)]
pub struct CoveredLaw {
    chosen: ContactLaw,
    pub(crate) twin: &'static Twin,
}

impl CoveredLaw {
    /// `None` of a law without such equations.
    pub fn new(law: &ContactLaw) -> Option<Self> {
        let twin = TWINS.iter().find(|twin| twin.name == law.law().name())?;
        Some(Self { chosen: law.clone(), twin })
    }

    /// The law of a name with its default options, if it is covered.
    pub fn named(name: &str) -> Option<Self> {
        Self::new(&named(name)?)
    }

    pub fn zmc() -> Self {
        Self { chosen: ContactLaw::scalable(Zmc::default()), twin: &ZMC }
    }

    /// The same law with options set by name.
    pub fn with_options(&self, options: &[(&str, f64)]) -> Result<Self, OptionError> {
        Ok(Self { chosen: self.chosen.with_options(options)?, ..*self })
    }

    pub fn chosen(&self) -> &ContactLaw {
        &self.chosen
    }

    /// Names of the laws of the registry that are covered, and of those that are not.
    pub fn coverage() -> [Vec<String>; 2] {
        let (covered, others): (Vec<_>, Vec<_>) = registry().iter().partition(|law| Self::new(law).is_some());
        [covered, others].map(|laws| laws.into_iter().map(ContactLaw::name).collect())
    }

    /// Critical indentations over b (onset/E*)^2, ascending.
    pub(super) fn boundaries(&self) -> Vec<Wide> {
        (self.twin.boundaries)(&self.chosen)
    }

    /// Area, load and regime of a sphere of radius `b` at indentation `w` in the range of the law that begins at its
    /// `range`th boundary.
    pub(super) fn answer(
        &self,
        range: usize,
        w: Wide,
        b: Wide,
        modulus: Wide,
        yield_limits: Option<YieldLimits>,
    ) -> Answer {
        match yield_limits {
            None => elastic(w, b, modulus),
            Some(YieldLimits { onset, strength }) => {
                (self.twin.answer)(&Sphere { law: &self.chosen, range, w, b, modulus, onset, strength })
            }
        }
    }
}

/// What a body sets against yielding: the onset and the strength of the law, Pa.
#[derive(Debug, Clone, Copy)]
pub(super) struct YieldLimits {
    pub(super) onset: Wide,
    pub(super) strength: Wide,
}

pub(super) type Answer = (Wide, Wide, Regime);

/// The equations of one law, and what random cases of it are.
#[derive(Debug)]
pub(crate) struct Twin {
    pub(crate) name: &'static str,
    /// How many of the random cases are under it, as a weight.
    pub(crate) weight: usize,
    /// Of a body of some Poisson's ratio, hardness and yield strength; `None` if it never yields.
    pub(super) yield_limits: fn(Wide, Option<Wide>, Option<Wide>) -> Option<YieldLimits>,
    boundaries: fn(&ContactLaw) -> Vec<Wide>,
    answer: fn(&Sphere) -> Answer,
    /// Accepted error at its boundaries, in roundings.
    pub(crate) steepness: fn(&ContactLaw) -> f64,
    /// Whether the law uses tables, whose slopes have fewer digits.
    pub(crate) has_tables: bool,
}

/// Elastic throughout, and the defaults of the others.
const HERTZ: Twin = Twin {
    name: "hertz",
    weight: 2,
    yield_limits: |_, _, _| None,
    boundaries: |_| Vec::new(),
    answer: |sphere| sphere.elastic(),
    steepness: |_| 1.0,
    has_tables: false,
};

const ZMC: Twin = Twin {
    name: "zmc",
    weight: 3,
    yield_limits: by_hardness,
    boundaries: |law| zmc_boundaries(law).to_vec(),
    answer: zmc,
    // Between w1 and c w1 the area doubles: w1 is rounded.
    steepness: |law| transition_ratio(law) / (transition_ratio(law) - 1.0),
    ..HERTZ
};

pub(crate) const TWINS: &[Twin] = &[
    HERTZ,
    Twin {
        name: "ceb",
        yield_limits: by_critical_pressure,
        boundaries: |_| vec![critical()],
        answer: chang_etsion_bogy,
        ..HERTZ
    },
    Twin {
        name: "kogut-etsion",
        yield_limits: by_critical_pressure,
        boundaries: |_| [1.0, 6.0, 110.0].map(|u| critical() * u).to_vec(),
        answer: kogut_etsion,
        ..HERTZ
    },
    Twin { name: "fully-plastic", yield_limits: by_hardness, answer: |sphere| sphere.plastic(), ..HERTZ },
    Twin {
        name: "jackson-green",
        weight: 1,
        yield_limits: |nu, _, strength| {
            let factor = decimal(1295.0, 1000.0) * (decimal(736.0, 1000.0) * nu).exp();
            strength.map(|strength| YieldLimits { onset: factor * strength, strength })
        },
        boundaries: |_| vec![critical() * 19.0 / 10.0],
        answer: jackson_green,
        has_tables: true,
        ..HERTZ
    },
    ZMC,
];

/// One sphere that yields in one range of a law.
struct Sphere<'a> {
    law: &'a ContactLaw,
    range: usize,
    w: Wide,
    b: Wide,
    modulus: Wide,
    onset: Wide,
    strength: Wide,
}

impl Sphere<'_> {
    fn elastic_area(&self) -> Wide {
        PI * self.b * self.w
    }

    fn elastic(&self) -> Answer {
        elastic(self.w, self.b, self.modulus)
    }

    fn plastic(&self) -> Answer {
        (self.elastic_area() * 2.0, self.strength * self.elastic_area() * 2.0, Regime::Plastic)
    }

    /// wc of Chang, Etsion and Bogy.
    fn critical(&self) -> Wide {
        let strain = self.onset / self.modulus;
        critical() * self.b * strain * strain
    }
}

fn elastic(w: Wide, b: Wide, modulus: Wide) -> Answer {
    (PI * b * w, modulus * (b * w).sqrt() * w * 4.0 / 3.0, Regime::Elastic)
}

/// `numerator`/`denominator`: a decimal to all digits.
fn decimal(numerator: f64, denominator: f64) -> Wide {
    Wide::new(numerator) / denominator
}

fn power(base: Wide, exponent: Wide) -> Wide {
    (exponent * base.ln()).exp()
}

/// wc of Chang, Etsion and Bogy over b (onset/E*)^2.
fn critical() -> Wide {
    PI * PI / 4.0
}

fn by_hardness(_: Wide, hardness: Option<Wide>, _: Option<Wide>) -> Option<YieldLimits> {
    hardness.map(|strength| YieldLimits { onset: Wide::ONE * strength, strength })
}

fn by_critical_pressure(nu: Wide, hardness: Option<Wide>, _: Option<Wide>) -> Option<YieldLimits> {
    let factor = decimal(454.0, 1000.0) + decimal(41.0, 100.0) * nu;
    hardness.map(|strength| YieldLimits { onset: factor * strength, strength })
}

fn transition_ratio(law: &ContactLaw) -> f64 {
    law.given("transition-ratio").unwrap_or(54.0)
}

fn zmc_boundaries(law: &ContactLaw) -> [Wide; 2] {
    let onset = law.given("onset").map_or(PI * PI * 9.0 / 100.0, Wide::new);
    [onset, onset * transition_ratio(law)]
}

fn zmc(sphere: &Sphere) -> Answer {
    let Sphere { w, b, modulus, onset, strength, .. } = *sphere;
    match sphere.range {
        0 => return sphere.elastic(),
        1 => {}
        _ => return sphere.plastic(),
    }
    let strain = onset / modulus;
    let [first, second] = zmc_boundaries(sphere.law).map(|boundary| boundary * b * strain * strain);
    let x = (w - first) / (second - first);
    let area = sphere.elastic_area() * (Wide::ONE + x * x * 3.0 - x * x * x * 2.0);
    let share = (second / w).ln() / (second / first).ln();
    (area, strength * (Wide::ONE - decimal(6.0, 10.0) * share) * area, Regime::ElasticPlastic)
}

fn chang_etsion_bogy(sphere: &Sphere) -> Answer {
    if sphere.range == 0 {
        return sphere.elastic();
    }
    let area = sphere.elastic_area() * (Wide::new(2.0) - sphere.critical() / sphere.w);
    (area, sphere.onset * area, Regime::ElasticPlastic)
}

fn kogut_etsion(sphere: &Sphere) -> Answer {
    let thousandths = match sphere.range {
        0 => return sphere.elastic(),
        1 => [930.0, 1136.0, 1030.0, 1425.0],
        2 => [940.0, 1146.0, 1400.0, 1263.0],
        _ => return sphere.plastic(),
    };
    let u = sphere.w / sphere.critical();
    let [area, of_area, load, of_load] = thousandths.map(|value| decimal(value, 1000.0));
    let unit = PI * sphere.b * sphere.critical();
    (
        unit * area * power(u, of_area),
        sphere.onset * unit * 2.0 / 3.0 * load * power(u, of_load),
        Regime::ElasticPlastic,
    )
}

fn jackson_green(sphere: &Sphere) -> Answer {
    let Sphere { w, b, modulus, onset, strength, .. } = *sphere;
    if sphere.range == 0 {
        return sphere.elastic();
    }
    let u = w / sphere.critical();
    let exponent = decimal(14.0, 100.0) * (strength / modulus * 23.0).exp();
    let area = sphere.elastic_area() * power(u * 10.0 / 19.0, exponent);
    let width = (area / PI).sqrt() / b;
    let limit = decimal(284.0, 100.0)
        * (Wide::ONE - (-(decimal(82.0, 100.0) * power(width, decimal(-7.0, 10.0)))).exp());
    let half = PI * onset / 2.0;
    let unit = b / modulus * (b / modulus) * half * half * half * 4.0 / 3.0;
    let elastic = (-(power(u, decimal(5.0, 12.0)) / 4.0)).exp() * u * u.sqrt();
    let spread = power(u, decimal(5.0, 9.0)) / 25.0;
    let plastic = limit * strength / onset * 4.0 * (Wide::ONE - (-spread).exp()) * u;
    (area, unit * (elastic + plastic), Regime::ElasticPlastic)
}
