//! Comparison of both models on one surface under one law: their curves, paired at equal load and at equal separation,
//! and the differences.

mod attribution;
mod difference;
mod dominance;
mod gap;
mod influence;
mod limit;
mod modulus_check;
mod nearness;
mod on_map;
mod reference;
mod sampling;
mod spread;
#[cfg(test)]
pub(crate) mod tests;
mod threshold;
mod validity;
mod verdict;

pub use attribution::{
    Attribution, Cause, Contribution, Contributions, GroupsLeftOut, Inputs, Order, Rearranged, StatesAtLoads,
    largest, leading,
};
pub use difference::{
    ByQuantity, CONTACTS_PER_GROUP, CaseSampling, ComparedQuantity, ContactResult, Difference, Estimate,
    LeftOut, Repeats, State, Support, error_over_positions,
};
pub use dominance::{Dominance, Dominant};
pub use gap::{Gap, GapQuantity, Gaps};
pub use influence::{AtLoad, DETECTABLE, Effect, Group, Influence, Measure, UnderLaw};
pub use limit::{Exact, HeightSampling, LimitCase, LimitPoint, LimitQuantity, LimitSets, convergence};
pub use modulus_check::{GOOD_RATIO, ModulusCheck, ModulusError, ModulusFindings, apart};
pub use nearness::{AgainstReference, NEARER, NearerStretch};
pub use on_map::OnMap;
pub use reference::{BlockShare, ReferenceCurve, ReferencePoint};
pub use sampling::{
    Division, GROUPS, Generated, NotModelled, OneStep, jackknife_error, jackknife_quantile, student_quantile,
};
pub use spread::{ErrorSlope, Realisation, Scatter, SlopeFit, Spread, spread};
pub use threshold::threshold;
pub use validity::{AdmissibleRange, PointCounts};
pub use verdict::{Accepted, Stretch, Verdict};

use std::time::{Duration, Instant};

use crate::model::{Exceeded, Model, Reached, Response, Unreachable, at_pressures, reached_at};
use crate::named_enum;

named_enum! {
    /// The summation method.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", derive(serde::Deserialize))]
    #[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
    #[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
    pub enum ModelKind {
        /// The integral over a height density.
        Statistical = "statistical",
        /// The sum over the asperities.
        Deterministic = "deterministic",
    }
}

named_enum! {
    /// What is prescribed at a point of a curve.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Control {
        /// d/sigma.
        Separation = "separation",
        /// Nominal pressure, Pa.
        Pressure = "pressure",
        /// Force on the nominal area, N.
        Force = "force",
    }
}

/// The separations and loads at which a surface is evaluated.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Controls {
    /// d/sigma.
    pub separations: Vec<f64>,
    /// Nominal pressures, Pa.
    pub pressures: Vec<f64>,
    /// Forces on the nominal area, N.
    pub forces: Vec<f64>,
}

impl Controls {
    /// Nominal pressures (Pa) alone.
    pub fn at_pressures(pressures: Vec<f64>) -> Self {
        Self { pressures, ..Self::default() }
    }

    /// Number of points per model.
    pub fn points(&self) -> usize {
        self.separations.len() + self.pressures.len() + self.forces.len()
    }
}

/// One point of a model's curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// The model.
    pub kind: ModelKind,
    /// The prescribed value.
    pub control: Control,
    /// Its value: d/sigma, Pa or N.
    pub target: f64,
    /// The prescribed nominal pressure, Pa; `None` under separation control.
    pub prescribed_pressure: Option<f64>,
    /// The response there.
    pub response: Response,
    /// Whether the load lies in a jump of the law; see [`Reached::in_jump`].
    pub in_jump: bool,
}

impl CurvePoint {
    /// A response at its own separation.
    pub fn at_separation(kind: ModelKind, response: Response) -> Self {
        let (control, target) = (Control::Separation, response.separation_over_sigma);
        Self { kind, control, target, prescribed_pressure: None, response, in_jump: false }
    }
}

named_enum! {
    /// The quantity that is equal in a pair.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Pairing {
        /// The nominal pressure, Pa.
        Load = "load",
        /// d/sigma.
        Separation = "separation",
    }
}

/// Both models at equal load or at equal separation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// The quantity that is equal.
    pub pairing: Pairing,
    /// Its value, Pa or d/sigma.
    pub target: f64,
    /// Response of the statistical model.
    pub statistical: Response,
    /// Response of the deterministic model.
    pub deterministic: Response,
}

impl Pair {
    /// Responses at equal separation.
    pub fn at_separation(statistical: Response, deterministic: Response) -> Self {
        let target = deterministic.separation_over_sigma;
        Self { pairing: Pairing::Separation, target, statistical, deterministic }
    }

    /// The states of the statistical and of the deterministic model; `None` where one has no contact.
    pub fn states(&self) -> Option<[State; 2]> {
        Some([sampling::state(&self.statistical)?.0, sampling::state(&self.deterministic)?.0])
    }

    /// The limits of admissible loads that either model exceeds.
    pub fn exceeded(&self) -> Exceeded {
        self.statistical.exceeded().union(self.deterministic.exceeded())
    }

    /// Whether asperities interact in either model.
    pub fn is_beyond_model(&self) -> bool {
        self.statistical.is_beyond_model() || self.deterministic.is_beyond_model()
    }

    /// Whether a finding may rest on it: its load is admissible for both models.
    pub fn is_admissible(&self) -> bool {
        self.exceeded().is_none()
    }
}

/// A model does not reach a prescribed pressure.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{} model: {unreachable}", kind.name())]
pub struct NotReached {
    /// The model.
    pub kind: ModelKind,
    /// Whether a pressure or a force was prescribed.
    pub control: Control,
    /// The prescribed pressure and the largest that can be reached.
    pub unreachable: Unreachable,
}

/// The models to run on one surface.
#[derive(Clone, Copy)]
pub struct Models<'a> {
    /// The integral.
    pub statistical: Option<&'a dyn Model>,
    /// The sum.
    pub deterministic: Option<&'a dyn Model>,
}

/// Curves and pairs on one surface under one law.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Comparison {
    /// The points of all curves, in the order of the controls.
    pub curves: Vec<CurvePoint>,
    /// Pairs at equal separation, then at equal load.
    pub pairs: Vec<Pair>,
    /// Pressures (Pa) of the deterministic separation sweep without a pair, since one of the models does not reach
    /// them.
    pub unpaired: Vec<f64>,
    /// Time spent in the statistical model.
    pub statistical_time: Duration,
    /// Time spent in the deterministic sums.
    pub deterministic_time: Duration,
}

/// Selects, from items of ascending load, those nearest to `steps` equal logarithmic steps per decade.
pub fn of_each_decade<T>(items: impl IntoIterator<Item = T>, load: impl Fn(&T) -> f64, steps: f64) -> Vec<T> {
    let step = |item: &T| (steps * load(item).log10()).round();
    let away = |item: &T| (steps * load(item).log10() - step(item)).abs();
    let mut chosen: Vec<T> = Vec::new();
    for item in items {
        match chosen.last_mut() {
            Some(last) if step(last) == step(&item) => {
                if away(&item) < away(last) {
                    *last = item;
                }
            }
            _ => chosen.push(item),
        }
    }
    chosen
}

impl Comparison {
    /// The pairs at equal load.
    pub fn pairs_at_load(&self) -> impl Iterator<Item = &Pair> {
        self.pairs.iter().filter(|pair| pair.pairing == Pairing::Load)
    }

    /// The limits of admissible loads that are exceeded at each point of the curves: by either model, where both were run.
    pub fn exceeded(&self) -> impl Iterator<Item = Exceeded> {
        let of_both = self.curves.len() / 2;
        let is_paired =
            self.curves.first().map(|point| point.kind) != self.curves.last().map(|point| point.kind);
        self.curves.iter().enumerate().map(move |(index, point)| {
            let own = point.response.exceeded();
            // The curves of both models follow each other.
            let other = if index < of_both { index + of_both } else { index - of_both };
            if is_paired { own.union(self.curves[other].response.exceeded()) } else { own }
        })
    }

    /// The point of a model at the prescribed nominal pressure `pressure` (Pa).
    pub fn at_load(&self, kind: ModelKind, pressure: f64) -> Option<&CurvePoint> {
        self.curves.iter().find(|point| point.kind == kind && point.prescribed_pressure == Some(pressure))
    }
}

/// Runs `models` through `controls` on the nominal area `area` (m^2) and pairs their responses.
///
/// # Errors
/// A pressure or force that one of the models does not reach.
pub fn compare(models: Models, controls: &Controls, area: f64) -> Result<Comparison, NotReached> {
    let mut result = Comparison::default();
    let statistical =
        run(ModelKind::Statistical, models.statistical, controls, area, &mut result.statistical_time)?;
    let deterministic =
        run(ModelKind::Deterministic, models.deterministic, controls, area, &mut result.deterministic_time)?;
    if models.statistical.is_some() && models.deterministic.is_some() {
        result.pairs = statistical.iter().zip(&deterministic).map(|(s, d)| pair(s, d)).collect();
        pair_at_loads(models, &deterministic, &mut result);
    }
    result.curves = statistical;
    result.curves.extend(deterministic);
    Ok(result)
}

/// Both models at the pressures (Pa); `None` where one of them does not reach it.
pub fn pairs_at(statistical: &dyn Model, deterministic: &dyn Model, pressures: &[f64]) -> Vec<Option<Pair>> {
    let [integrals, sums] = [statistical, deterministic].map(|model| reached_at(model, pressures));
    let pair = |(&target, (s, d)): (&f64, (&Option<Reached>, &Option<Reached>))| {
        let (statistical, deterministic) = (s.as_ref()?.response, d.as_ref()?.response);
        Some(Pair { pairing: Pairing::Load, target, statistical, deterministic })
    };
    pressures.iter().zip(integrals.iter().zip(&sums)).map(pair).collect()
}

fn run(
    kind: ModelKind,
    model: Option<&dyn Model>,
    controls: &Controls,
    area: f64,
    time: &mut Duration,
) -> Result<Vec<CurvePoint>, NotReached> {
    let Some(model) = model else { return Ok(Vec::new()) };
    let start = Instant::now();
    let mut curve = Vec::with_capacity(controls.points());
    let answers = model.respond_all(&controls.separations);
    curve.extend(controls.separations.iter().zip(answers).map(|(&target, response)| CurvePoint {
        kind,
        control: Control::Separation,
        target,
        prescribed_pressure: None,
        response,
        in_jump: false,
    }));
    // Pressures and forces are searched together.
    let pressures = controls.pressures.iter().map(|&pressure| (Control::Pressure, pressure, pressure));
    let forces = controls.forces.iter().map(|&force| (Control::Force, force, force / area));
    let loads: Vec<(Control, f64, f64)> = pressures.chain(forces).collect();
    let prescribed_pressure: Vec<f64> = loads.iter().map(|&(_, _, pressure)| pressure).collect();
    for ((control, target, pressure), answer) in
        loads.into_iter().zip(at_pressures(model, &prescribed_pressure))
    {
        let Reached { response, in_jump } =
            answer.map_err(|unreachable| NotReached { kind, control, unreachable })?;
        curve.push(CurvePoint {
            kind,
            control,
            target,
            prescribed_pressure: Some(pressure),
            response,
            in_jump,
        });
    }
    *time += start.elapsed();
    Ok(curve)
}

fn pair(statistical: &CurvePoint, deterministic: &CurvePoint) -> Pair {
    let (pairing, target) = match statistical.prescribed_pressure {
        None => (Pairing::Separation, statistical.target),
        Some(pressure) => (Pairing::Load, pressure),
    };
    Pair { pairing, target, statistical: statistical.response, deterministic: deterministic.response }
}

/// A separation sweep also gives pairs at the deterministic pressures of its points, except zero.
fn pair_at_loads(models: Models, deterministic: &[CurvePoint], result: &mut Comparison) {
    let (Some(statistical), Some(sum)) = (models.statistical, models.deterministic) else { return };
    let points: Vec<Response> = deterministic
        .iter()
        .filter(|point| point.control == Control::Separation && point.response.pressure.total() > 0.0)
        .map(|point| point.response)
        .collect();
    let pressures: Vec<f64> = points.iter().map(|response| response.pressure.total()).collect();
    let respond = |model: &dyn Model, time: &mut Duration| {
        let start = Instant::now();
        let answers = reached_at(model, &pressures);
        *time += start.elapsed();
        answers
    };
    let integrals = respond(statistical, &mut result.statistical_time);
    // A load that never decreases on approach is not reached at a separation larger than that of its point.
    let sums: Vec<Option<Response>> = if sum.may_decrease() {
        let reached = respond(sum, &mut result.deterministic_time);
        reached.into_iter().map(|reached| reached.map(|reached| reached.response)).collect()
    } else {
        points.into_iter().map(Some).collect()
    };
    for (pressure, answers) in pressures.into_iter().zip(integrals.into_iter().zip(sums)) {
        match answers {
            (Some(integral), Some(deterministic)) => result.pairs.push(Pair {
                pairing: Pairing::Load,
                target: pressure,
                statistical: integral.response,
                deterministic,
            }),
            _ => result.unpaired.push(pressure),
        }
    }
}
