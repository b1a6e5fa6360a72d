//! One asperity pressed into a flat: its curve, changes of regime, and decreases of area or load.

pub use crate::contact::LARGEST_SLOPE;
use crate::contact::{Contact, Regime};
use crate::interface::MicroContact;
use crate::named_enum;
use crate::shape::Shape;

/// Points of the trace between two breakpoints.
const PER_PIECE: usize = 160;

/// Relative distance from a boundary at which both of its sides are evaluated.
const OFFSET: f64 = 1e-12;

/// Relative threshold of a decrease or jump of area or load.
const ROUNDING: f64 = 1e-9;

/// The contact at one indentation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// w, m.
    pub indentation: f64,
    /// The contact there.
    pub contact: Contact,
}

/// A change of regime.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegimeChange {
    /// w, m.
    pub indentation: f64,
    /// P just below it, N.
    pub load: f64,
    /// A just below it, m^2.
    pub area: f64,
    /// Regime below.
    pub from: Regime,
    /// Regime above.
    pub to: Regime,
}

/// A boundary between two formulas of a law, with or without a change of regime; area or load may jump there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Boundary {
    /// w, m.
    pub indentation: f64,
    /// The contact just below.
    pub below: Contact,
    /// The contact just above.
    pub above: Contact,
}

impl Boundary {
    /// The relative jump of the load, (above - below)/below; 0 if it is continuous.
    pub fn load_jump(&self) -> f64 {
        jump(self.below.load, self.above.load)
    }

    /// The relative jump of the area, (above - below)/below; 0 if it is continuous.
    pub fn area_jump(&self) -> f64 {
        jump(self.below.area, self.above.area)
    }

    /// Whether the load or the area jumps.
    pub fn is_jump(&self) -> bool {
        self.load_jump() != 0.0 || self.area_jump() != 0.0
    }
}

/// A change below the threshold is due to the slope of the curve.
fn jump(below: f64, above: f64) -> f64 {
    let jump = above / below - 1.0;
    if jump.abs() > ROUNDING { jump } else { 0.0 }
}

/// All boundaries of an asperity, by ascending indentation.
pub fn boundaries(contact: &dyn MicroContact, shape: Shape) -> Vec<Boundary> {
    let mut at = contact.regime_changes(shape);
    at.dedup();
    let side = |w: f64| contact.contact(w, shape);
    let boundary = |w: f64| Boundary {
        indentation: w,
        below: side(w * (1.0 - OFFSET)),
        above: side(w * (1.0 + OFFSET)),
    };
    at.into_iter().map(boundary).collect()
}

/// A range in which the area or load decreases with increasing indentation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decrease {
    /// The decreasing quantity.
    pub of: DecreasingQuantity,
    /// The first point.
    pub from: Point,
    /// The last point.
    pub to: Point,
}

named_enum! {
    /// The quantity that decreases.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum DecreasingQuantity {
        /// Real contact area.
        Area = "area",
        /// Load.
        Load = "load",
    }
}

impl DecreasingQuantity {
    /// Its value, m^2 or N.
    pub fn value(self, contact: &Contact) -> f64 {
        match self {
            Self::Area => contact.area,
            Self::Load => contact.load,
        }
    }
}

/// The curve of one asperity on one flat under one law.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Contacts at the requested indentations.
    pub points: Vec<Point>,
    /// Closely spaced points over the range of the requested indentations, including all breakpoints.
    pub trace: Vec<Point>,
    /// All changes of regime, also outside the requested indentations; ascending.
    pub changes: Vec<RegimeChange>,
    /// Decreases of area or load along the trace.
    pub decreases: Vec<Decrease>,
}

impl Curve {
    /// The curve of an asperity at `indentations` (m), which must be ascending.
    pub fn new(contact: &dyn MicroContact, shape: Shape, indentations: &[f64]) -> Self {
        let at = |w: f64| Point { indentation: w, contact: contact.contact(w, shape) };
        let trace: Vec<Point> = match indentations {
            [] => Vec::new(),
            [first, .., last] => places(contact, shape, *first, *last).into_iter().map(at).collect(),
            [only] => vec![at(*only)],
        };
        Self {
            points: indentations.iter().copied().map(at).collect(),
            changes: changes(contact, shape),
            decreases: DecreasingQuantity::ALL.into_iter().flat_map(|of| decreases(&trace, of)).collect(),
            trace,
        }
    }

    /// The trace divided by regime; neighbouring parts share a point.
    pub fn stretches(&self) -> Vec<(Regime, &[Point])> {
        let is_change = |point: &Point| self.changes.iter().any(|at| at.indentation == point.indentation);
        let inner = 1..self.trace.len().saturating_sub(1);
        let mut ends = vec![0];
        ends.extend(inner.filter(|&k| is_change(&self.trace[k])));
        ends.push(self.trace.len().saturating_sub(1));
        let stretch = |pair: &[usize]| {
            let points = &self.trace[pair[0]..=pair[1]];
            // The end points may have either regime.
            points.get(points.len() / 2).map(|middle| (middle.contact.regime, points))
        };
        ends.windows(2).filter(|pair| pair[1] > pair[0]).filter_map(stretch).collect()
    }

    /// The changes within the requested indentations.
    pub fn changes_within(&self) -> impl Iterator<Item = &RegimeChange> {
        self.changes.iter().filter(|change| self.is_within(change))
    }

    /// Whether a change lies within the requested indentations.
    pub fn is_within(&self, change: &RegimeChange) -> bool {
        match &self.points[..] {
            [first, .., last] => (first.indentation..=last.indentation).contains(&change.indentation),
            _ => false,
        }
    }

    /// The regimes from w = 0 on, in order.
    pub fn sequence(&self) -> Vec<Regime> {
        let first = self.changes.first().map(|change| change.from);
        let first = first.or_else(|| self.points.first().map(|point| point.contact.regime));
        first.into_iter().chain(self.changes.iter().map(|change| change.to)).collect()
    }
}

/// Indentations from `first` to `last`, equally spaced in ln w between breakpoints, which are included.
fn places(contact: &dyn MicroContact, shape: Shape, first: f64, last: f64) -> Vec<f64> {
    let bends = contact.breakpoints(shape).into_iter();
    let sides =
        contact.regime_changes(shape).into_iter().flat_map(|w| [w * (1.0 - OFFSET), w * (1.0 + OFFSET)]);
    let bends = bends.chain(sides).filter(|&w| w > first && w < last);
    let mut ends: Vec<f64> = [first, last].into_iter().chain(bends).collect();
    ends.sort_unstable_by(f64::total_cmp);
    ends.dedup();
    let piece = |pair: &[f64]| {
        let [from, ratio] = [pair[0], pair[1] / pair[0]];
        let count = if ratio < 1.0 + 4.0 * OFFSET { 1 } else { PER_PIECE };
        (0..count).map(move |k| from * ratio.powf(k as f64 / PER_PIECE as f64))
    };
    let mut places: Vec<f64> = ends.windows(2).flat_map(piece).chain([last]).collect();
    // Points of a piece as short as rounding may coincide.
    places.dedup_by(|next, previous| *next <= *previous);
    places
}

fn changes(contact: &dyn MicroContact, shape: Shape) -> Vec<RegimeChange> {
    let mut at = contact.regime_changes(shape);
    at.dedup();
    let regime = |w: f64| contact.contact(w, shape).regime;
    let between = |k: usize| match (k.checked_sub(1).map(|k| at[k]), at.get(k)) {
        (Some(low), Some(&high)) => (low * high).sqrt(),
        (None, Some(&high)) => 0.5 * high,
        (Some(low), None) => 2.0 * low,
        (None, None) => shape.radius,
    };
    let change = |(k, &w): (usize, &f64)| {
        let Contact { load, area, .. } = contact.contact(w * (1.0 - OFFSET), shape);
        RegimeChange { indentation: w, load, area, from: regime(between(k)), to: regime(between(k + 1)) }
    };
    at.iter().enumerate().map(change).filter(|change| change.from != change.to).collect()
}

fn decreases(trace: &[Point], of: DecreasingQuantity) -> Vec<Decrease> {
    let value = |point: &Point| of.value(&point.contact);
    let mut decreases: Vec<Decrease> = Vec::new();
    for pair in trace.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        if value(&to) >= value(&from) * (1.0 - ROUNDING) {
            continue;
        }
        match decreases.last_mut() {
            Some(fall) if fall.to.indentation == from.indentation => fall.to = to,
            _ => decreases.push(Decrease { of, from, to }),
        }
    }
    decreases
}

impl Decrease {
    /// The relative decrease of area or load.
    pub fn loss(&self) -> f64 {
        1.0 - self.of.value(&self.to.contact) / self.of.value(&self.from.contact)
    }

    /// Whether the decrease is a jump of the law: at one indentation, to rounding.
    pub fn is_jump(&self) -> bool {
        self.to.indentation <= self.from.indentation * (1.0 + ROUNDING)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interface::Flat;
    use crate::law::{Ceb, Hertz, KogutEtsion, Zmc};
    use crate::layer::ModulusModel;
    use crate::material::Material;
    use crate::material::tests::steel;

    fn under_lead(thickness: f64) -> Box<dyn MicroContact> {
        let lead = Material::new(18e9, 0.35, Some(0.17e9), None).unwrap();
        Flat::with_layer(&lead, &steel(), thickness, ModulusModel::Gao)
            .unwrap()
            .under(Zmc::default(), &steel())
            .unwrap()
    }

    #[test]
    fn a_stretch_begins_where_another_ends_and_has_one_regime() {
        let curve = Curve::new(&*under_lead(100e-9), Shape::sphere(20e-6), &[1e-10, 1e-8, 1e-6]);
        let names: String = curve.sequence().iter().map(|regime| (*regime as u8).to_string()).collect();
        assert_eq!(names, "01212");
        let stretches = curve.stretches();
        assert_eq!(stretches.len(), curve.changes_within().count() + 1);
        for pair in stretches.windows(2) {
            assert_eq!(pair[0].1.last(), pair[1].1.first());
            assert_ne!(pair[0].0, pair[1].0);
        }
        for (regime, points) in stretches {
            assert!(points[1..points.len() - 1].iter().all(|point| point.contact.regime == regime));
        }
    }

    #[test]
    fn area_falls_where_the_contact_turns_from_plastic_to_elastic_plastic() {
        let curve = Curve::new(&*under_lead(100e-9), Shape::sphere(20e-6), &[1e-10, 1e-6]);
        let [fall] = curve.decreases[..] else { panic!("{:?}", curve.decreases) };
        assert_eq!(fall.of, DecreasingQuantity::Area);
        assert!(
            fall.from.contact.area > fall.to.contact.area && fall.from.contact.load < fall.to.contact.load
        );
    }

    /// The rounded onset of yield causes a drop of 0.0976 %, with or without a layer.
    #[test]
    fn a_fall_at_a_jump_is_seen() {
        let lead = Material::new(18e9, 0.35, Some(0.17e9), None).unwrap();
        for thickness in [0.0, 1e-9, f64::INFINITY] {
            let flat = Flat::with_layer(&lead, &steel(), thickness, ModulusModel::Gao).unwrap();
            let contact = flat.under(Zmc::new(0.89, 54.0).unwrap(), &steel()).unwrap();
            let curve = Curve::new(&*contact, Shape::sphere(20e-6), &[1e-12, 1e-6]);
            let of_load = |fall: &&Decrease| {
                fall.of == DecreasingQuantity::Load && (fall.loss() - 9.76e-4).abs() < 1e-6
            };
            assert!(curve.decreases.iter().any(|fall| of_load(&fall)), "{thickness}: {:?}", curve.decreases);
        }
    }

    #[test]
    fn boundaries_have_both_sides_and_need_no_change_of_regime() {
        let of = |flat: Result<Box<dyn MicroContact>, _>| boundaries(&*flat.unwrap(), Shape::sphere(1e-5));
        let flat = Flat::Bare(steel());
        let ceb = of(flat.under(Ceb, &steel()));
        let [at] = &ceb[..] else { panic!("one boundary") };
        assert!((at.load_jump() - 0.5).abs() < 1e-9 && at.area_jump().abs() < 1e-9);
        assert_eq!((at.below.regime, at.above.regime), (Regime::Elastic, Regime::ElasticPlastic));
        let kogut_etsion = of(flat.under(KogutEtsion, &steel()));
        let [first, inner, last] = &kogut_etsion[..] else { panic!("three boundaries") };
        assert_eq!(inner.below.regime, inner.above.regime);
        assert!((inner.indentation / first.indentation - 6.0).abs() < 1e-12);
        assert!((first.area_jump() + 0.07).abs() < 1e-9 && (last.load_jump() - 0.0788).abs() < 1e-4);
        let smooth = of(flat.under(Zmc::default(), &steel()));
        assert!(smooth.iter().all(|at| at.load_jump().abs() < 1e-9 && at.area_jump().abs() < 1e-9));
        assert_eq!(of(flat.under(Hertz, &steel())), []);
    }

    #[test]
    fn a_curve_of_one_regime() {
        let contact = Flat::Bare(steel()).under(Hertz, &steel()).unwrap();
        let curve = Curve::new(&*contact, Shape::sphere(1e-5), &[1e-9, 1e-8]);
        assert!(curve.changes.is_empty() && curve.decreases.is_empty());
        assert_eq!((curve.sequence(), curve.stretches().len()), (vec![Regime::Elastic], 1));
        assert_eq!(Curve::new(&*contact, Shape::sphere(1e-5), &[1e-9]).stretches().len(), 0);
    }
}
