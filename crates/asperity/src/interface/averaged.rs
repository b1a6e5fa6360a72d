//! The mean contact over a distribution of radii that are independent of the heights.

use super::batch::{self, LaneContacts};
use super::{LoadBounds, MicroContact, Shapes, accumulate_weighted_each, jumps};
use crate::accumulator::Accumulator;
use crate::asperity::Asperities;
use crate::contact::{Contact, ContactColumns, Contacts, Regime};
use crate::literature::Paper;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::{MOST, Real};
use crate::numeric::parallel;
use crate::shape::Shape;
use crate::spot::{SpotProperties, SpotValues};

/// The smallest tabulated indentation over the largest; below it, the table continues as a power of w.
const SMALLEST: f64 = 1e-5;

/// A radius, m, with its share: the number of its spheres over that of all asperities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RadiusShare {
    pub(crate) radius: f64,
    pub(crate) share: f64,
}

/// The contact at an indentation, averaged over a sample of radii: where these are independent of heights, both models
/// evaluate it in place of the contact of one asperity. The radius passed to it is ignored.
///
/// Many radii are tabulated: load, area and stiffness over ln w, each divided by its elastic power of w, and interpolated
/// by cubics, and so are the values of spots; the steps of a law whose load jumps are added exactly. The relative error of a load summed over many
/// heights is below 1e-7 for a homogeneous flat and a law whose load jumps by less than a tenth, below 1e-6 for other
/// laws and under a layer, and below 1e-4 under a layer with a law that jumps.
pub(crate) struct AveragedContact<'a> {
    contact: &'a dyn MicroContact,
    /// Heights, which are zero, radii and shares.
    nodes: [Vec<f64>; 3],
    /// Mean number of spheres per asperity.
    spheres: f64,
    steps: Vec<Step>,
    table: Option<Table>,
}

/// Load (N), area (m^2) and stiffness (N/m), and the values of a spot.
type Sums = [f64; 7];

fn sums_of([load, area, stiffness]: [f64; 3], [a, b, c, d]: SpotValues) -> Sums {
    [load, area, stiffness, a, b, c, d]
}

/// The elastic powers of w of [`Sums`].
const POWERS: Sums = [1.5, 1.0, 0.5, 0.5, 0.5, 1.0, 0.5];

impl<'a> AveragedContact<'a> {
    /// The mean over `radii`, evaluated radius by radius.
    pub(crate) fn exact(contact: &'a dyn MicroContact, radii: Vec<RadiusShare>) -> Self {
        let column = |of: fn(&RadiusShare) -> f64| radii.iter().map(of).collect::<Vec<f64>>();
        let shares = column(|one| one.share);
        let spheres = shares.iter().sum();
        let nodes = [vec![0.0; radii.len()], column(|one| one.radius), shares];
        Self { contact, nodes, spheres, steps: Vec::new(), table: None }
    }

    /// The mean over ascending `nodes`, tabulated in steps of `step` in ln w up to the indentation `deepest` (m). The steps of a law
    /// that jumps are those of `all` radii, ascending, for which the nodes stand.
    pub(crate) fn tabulated(
        contact: &'a dyn MicroContact,
        nodes: Vec<RadiusShare>,
        all: impl FnOnce() -> Vec<RadiusShare>,
        step: f64,
        deepest: f64,
    ) -> Self {
        // Without their own steps the nodes have a smooth mean.
        let own_steps = Step::all(contact, || nodes.clone());
        let direct = Self::exact(contact, nodes);
        let table = Table::new(deepest, step, |w| {
            let mut sums = direct.direct(w);
            let steps = at_steps(&own_steps, w);
            sums[0] -= steps[0];
            sums[1] -= steps[1];
            sums
        });
        Self { steps: Step::all(contact, all), table: Some(table), ..direct }
    }

    /// The mean over the nodes, one by one.
    fn direct(&self, w: f64) -> Sums {
        let [heights, radii, shares] = &self.nodes;
        if self.contact.is_layered() {
            // Load and area are not proportional to the number of spheres: that of the mean asperity stands for all.
            let mut sums = Sums::default();
            for (&radius, &share) in radii.iter().zip(shares) {
                let shape = Shape { radius, spheres: self.spheres };
                let Contact { load, area, stiffness, .. } = self.contact.contact(w, shape);
                let spots = self.contact.spot_values(w, shape).unwrap_or_default();
                let all = sums_of([load, area, stiffness], spots);
                sums.iter_mut().zip(all).for_each(|(sum, one)| *sum += share / self.spheres * one);
            }
            return sums;
        }
        let mut accumulator = Accumulator::empty(true);
        self.contact.accumulate(Asperities::new(heights, radii, Some(shares), 1.0), -w, &mut accumulator);
        let total = accumulator.total();
        let of_contacts = [total.load().total(), total.area().total(), total.stiffness()];
        sums_of(of_contacts, total.spots().unwrap_or_default())
    }

    fn radius_range(&self) -> Interval {
        Interval::new(&self.nodes[1])
    }

    /// The table where it is all: without steps.
    fn smooth(&self) -> Option<&Table> {
        self.table.as_ref().filter(|_| self.steps.is_empty())
    }

    /// The first K of [`Sums`]: the values of spots are left out where nobody asks for them.
    fn sums<const K: usize>(&self, w: f64) -> [f64; K] {
        let Some(table) = &self.table else {
            let all = self.direct(w);
            return std::array::from_fn(|q| all[q]);
        };
        let mut sums = table.at(w);
        let steps = at_steps(&self.steps, w);
        sums[0] += steps[0];
        sums[1] += steps[1];
        sums
    }
}

impl MicroContact for AveragedContact<'_> {
    forward! { contact:
        fn spot_properties(&self) -> Option<&SpotProperties>;
        fn reference_modulus(&self) -> f64;
        fn reference_hardness(&self) -> f64;
        fn papers(&self) -> Vec<Paper>;
    }

    fn contact(&self, w: f64, shape: Shape) -> Contact {
        let [load, area, stiffness] = self.sums(w).map(|sum| sum * shape.spheres);
        Contact { area, load, stiffness, regime: Regime::Elastic }
    }

    fn spot_values(&self, w: f64, shape: Shape) -> Option<SpotValues> {
        self.spot_properties()?;
        let [_, _, _, spots @ ..]: Sums = self.sums(w).map(|sum| sum * shape.spheres);
        Some(spots)
    }

    fn contacts(&self, indentations: &[f64], shape: Shape) -> ContactColumns {
        match self.smooth() {
            Some(table) => batch::contacts(table, indentations, shape),
            None => indentations.iter().map(|&w| self.contact(w, shape)).collect(),
        }
    }

    fn accumulate_weighted(
        &self,
        indentations: &[f64],
        weights: &[f64],
        shape: Shape,
        accumulator: &mut Accumulator,
    ) {
        match self.smooth().filter(|_| !accumulator.wants_spots()) {
            Some(table) => batch::accumulate_weighted(table, indentations, weights, shape, accumulator),
            None => accumulate_weighted_each(self, indentations, weights, shape, accumulator),
        }
    }

    /// One by one they are evaluated in parallel, since a sample of heights is one block of a sum, and added in their order.
    fn accumulate(&self, asperities: Asperities<'_>, separation: f64, accumulator: &mut Accumulator) {
        /// Contacts per task.
        const TASK: usize = 1024;
        let wants_spots = accumulator.wants_spots();
        if let Some(table) = self.smooth().filter(|_| !wants_spots) {
            return batch::accumulate(table, asperities, separation, accumulator);
        }
        let count = asperities.count();
        let of_task = |task: usize| {
            let some = asperities.part(task * TASK..count.min((task + 1) * TASK));
            let at = |(z, shape)| {
                let w = z - separation;
                let spots = if wants_spots { self.spot_values(w, shape) } else { None };
                (self.contact(w, shape), spots)
            };
            some.each().map(at).collect::<Vec<_>>()
        };
        let contacts = parallel::map(count.div_ceil(TASK), of_task);
        for ((_, shape), (contact, spots)) in asperities.each().zip(contacts.into_iter().flatten()) {
            accumulator.add(&contact, shape);
            if let Some(values) = spots {
                accumulator.add_spot(values, 1.0);
            }
        }
    }

    fn regime_changes(&self, _: Shape) -> Vec<f64> {
        Vec::new()
    }

    /// Every factor of 2 between the first and the last change of regime: the mean is smooth on the scale of w.
    fn breakpoints(&self, _: Shape) -> Vec<f64> {
        let radii = self.radius_range();
        let of = |radius: f64| self.contact.breakpoints(Shape::sphere(radius));
        let all = [of(radii.low), of(radii.high)].concat();
        let ends = Interval::new(&all);
        let next = |w: &f64| Some(2.0 * w).filter(|w| *w < 2.0 * ends.high);
        if all.is_empty() { Vec::new() } else { std::iter::successors(Some(ends.low), next).collect() }
    }

    fn may_decrease(&self, _: Shapes) -> Vec<Interval> {
        match &self.table {
            Some(table) => table.decreasing_loads(),
            None => {
                let spheres = Interval::point(self.spheres);
                self.contact.may_decrease(Shapes { radii: self.radius_range(), spheres })
            }
        }
    }

    fn load_over(&self, from: f64, to: f64, shape: Shape) -> LoadBounds {
        let highest: f64 = match &self.table {
            Some(table) => table.highest_load(from, to) + at_steps(&self.steps, to)[0],
            None => {
                let [_, radii, shares] = &self.nodes;
                let highest = |radius| self.contact.load_over(from, to, Shape::sphere(radius)).highest;
                radii.iter().zip(shares).map(|(&radius, share)| share * highest(radius)).sum()
            }
        };
        LoadBounds::any(highest * shape.spheres)
    }
}

/// Load and area of all steps at an indentation.
fn at_steps(steps: &[Step], w: f64) -> [f64; 2] {
    steps.iter().map(|step| step.at(w)).fold([0.0; 2], |[p, a], [load, area]| [p + load, a + area])
}

/// A jump of load and area at w = `ratio` b of asperities of radius b, without a length scale of its own: both jumps are
/// proportional to b^2.
struct Step {
    ratio: f64,
    /// Ascending radii, m, and the load and area of the jumps of all up to each.
    radii: Vec<f64>,
    sums: Vec<[f64; 2]>,
}

impl Step {
    /// The steps of a homogeneous flat under a law whose load jumps up; empty for other laws, and under a layer, whose
    /// thickness is a scale.
    fn all(contact: &dyn MicroContact, radii: impl FnOnce() -> Vec<RadiusShare>) -> Vec<Self> {
        if contact.is_layered() {
            return Vec::new();
        }
        // Any radius serves.
        const UNIT: f64 = 1e-6;
        let sphere = Shape::sphere(UNIT);
        let jumps = contact.regime_changes(sphere).into_iter().map(|w| (w / UNIT, jumps(contact, sphere, w)));
        let jumps: Vec<(f64, [f64; 2])> = jumps.filter(|(_, jump)| *jump != [0.0; 2]).collect();
        if jumps.is_empty() || jumps.iter().any(|(_, [load, _])| *load < 0.0) {
            return Vec::new();
        }
        let radii = radii();
        let step = |(ratio, jump): (f64, [f64; 2])| {
            let mut sum = [0.0; 2];
            let sums = radii.iter().map(|one| {
                let square = one.share * (one.radius / UNIT).powi(2);
                sum = [sum[0] + square * jump[0], sum[1] + square * jump[1]];
                sum
            });
            Self { ratio, sums: sums.collect(), radii: radii.iter().map(|one| one.radius).collect() }
        };
        jumps.into_iter().map(step).collect()
    }

    fn at(&self, w: f64) -> [f64; 2] {
        let reached = self.radii.partition_point(|radius| radius * self.ratio <= w);
        if reached == 0 { [0.0; 2] } else { self.sums[reached - 1] }
    }
}

/// [`Sums`] over ln w.
struct Table {
    /// ln of the first indentation.
    start: f64,
    /// Of ln w, between rows.
    step: f64,
    /// Divided by the elastic powers of w.
    rows: Vec<Sums>,
    /// Between the second and third of each four rows the cubics through these.
    cells: Vec<Cell>,
}

/// The coefficients of the cubic of each of [`Sums`] in the part of the step, the lowest power first.
type Cell = [[f64; 4]; 7];

/// The cubics through four rows.
fn cell(rows: &[Sums]) -> Cell {
    std::array::from_fn(|q| {
        let [before, low, high, after] = std::array::from_fn(|k| rows[k][q]);
        [
            low,
            high - before / 3.0 - low / 2.0 - after / 6.0,
            (before + high) / 2.0 - low,
            (after - before) / 6.0 + (low - high) / 2.0,
        ]
    })
}

/// In registers.
impl LaneContacts for &Table {
    type Local<N: Real> = ();

    #[inline(always)]
    fn local<N: Real>(&self, _: N, _: N, _: N) {}

    #[inline(always)]
    fn contacts<N: Real>(&self, w: N, _: N, spheres: N, (): &()) -> Contacts<N> {
        let place = (w.ln() - self.start) / self.step;
        let last = w.splat(self.last());
        let zero = w.splat(0.0);
        let place = N::select(place.lt(zero), zero, place).min(last);
        let mut places = [0.0; MOST];
        place.store(&mut places);
        let mut cells = [&self.cells[0]; MOST];
        let mut starts = [0.0; MOST];
        for lane in 0..N::LANES {
            let cell = places[lane] as usize;
            cells[lane] = &self.cells[cell];
            starts[lane] = cell as f64;
        }
        let t = place - zero.load(&starts);
        let root = w.sqrt();
        let all = w.all_true();
        Contacts {
            load: spheres * (w * root) * cubic(t, cells, 0),
            area: spheres * w * cubic(t, cells, 1),
            stiffness: spheres * root * cubic(t, cells, 2),
            elastic: all,
            plastic: !all,
        }
    }
}

/// The cubic of one of [`Sums`] in the cell of each lane.
#[inline(always)]
fn cubic<N: Real>(t: N, cells: [&Cell; MOST], q: usize) -> N {
    let mut rows = [&cells[0][q]; MOST];
    for (row, cell) in rows.iter_mut().zip(cells) {
        *row = &cell[q];
    }
    let [c0, c1, c2, c3] = t.columns(rows);
    c3.mul_add(t, c2).mul_add(t, c1).mul_add(t, c0)
}

impl Table {
    fn new(deepest: f64, step: f64, sums: impl Fn(f64) -> Sums + Sync) -> Self {
        let start = (SMALLEST * deepest).ln();
        // Cubics need a row beyond each end.
        let count = (-SMALLEST.ln() / step).ceil() as usize + 3;
        let row = |k: usize| {
            let x = start + step * (k as f64 - 1.0);
            let w = x.exp();
            let sums = sums(w);
            std::array::from_fn(|q| sums[q] / w.powf(POWERS[q]))
        };
        let rows: Vec<Sums> = parallel::map(count, row);
        let cells = rows.windows(4).map(cell).collect();
        Self { start, step, rows, cells }
    }

    /// The last place: beyond both ends the ratio to the elastic power is that at the end.
    fn last(&self) -> f64 {
        (self.cells.len() - 1) as f64
    }

    /// The first K of [`Sums`].
    fn at<const K: usize>(&self, w: f64) -> [f64; K] {
        let place = ((w.ln() - self.start) / self.step).clamp(0.0, self.last());
        let cell = &self.cells[place as usize];
        let t = place.fract();
        let root = w.sqrt();
        let powers = [w * root, w, root, root, root, w, root];
        std::array::from_fn(|q| {
            let [c0, c1, c2, c3] = cell[q];
            powers[q] * (((c3 * t + c2) * t + c1) * t + c0)
        })
    }

    /// Indentation and load of each row.
    fn loads(&self) -> impl Iterator<Item = [f64; 2]> {
        self.rows.iter().enumerate().map(|(k, row)| {
            let w = (self.start + self.step * (k as f64 - 1.0)).exp();
            [w, row[0] * w.powf(POWERS[0])]
        })
    }

    /// Where the load decreases from a row to the next.
    fn decreasing_loads(&self) -> Vec<Interval> {
        let all: Vec<[f64; 2]> = self.loads().collect();
        let decreasing = all.windows(2).filter(|pair| pair[1][1] < pair[0][1]);
        // The extremum lies up to a row before or after.
        let wide = |pair: &[[f64; 2]]| Interval {
            low: pair[0][0] * (-self.step).exp(),
            high: pair[1][0] * self.step.exp(),
        };
        Interval::union(decreasing.map(wide))
    }

    /// A bound of the load between two indentations: the highest of the rows around them, with a margin for what cubics
    /// rise above their rows.
    fn highest_load(&self, from: f64, to: f64) -> f64 {
        let within = |[w, _]: &[f64; 2]| (from * (-self.step).exp()..=to * self.step.exp()).contains(w);
        let ends = [from, to].map(|w| self.at::<1>(w)[0]);
        (1.0 + self.step * self.step)
            * self.loads().filter(within).map(|[_, load]| load).fold(ends[0].max(ends[1]), f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interface::Interface;
    use crate::law::Zmc;
    use crate::material::Material;

    /// In registers and contact by contact, also at indentations below and above the table.
    #[test]
    fn contacts_in_registers_are_those_one_by_one() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let contact = Interface::bare(Zmc::default(), &steel, &steel).unwrap();
        let radii = (0..40).map(|k| RadiusShare { radius: 1e-5 * (1.0 + 0.05 * f64::from(k)), share: 0.025 });
        let nodes: Vec<RadiusShare> = radii.collect();
        let averaged = AveragedContact::tabulated(&contact, nodes, || unreachable!("no jumps"), 0.01, 4e-7);
        assert!(averaged.smooth().is_some());
        let heights: Vec<f64> = (1..1003).map(|k| 1e-13 * f64::from(k).powf(2.3)).collect();
        let (radii, spheres) = (vec![1.5e-5; heights.len()], vec![0.7; heights.len()]);
        let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-13 * b.abs(), "{a} {b}");
        let compare = |a: &Accumulator, b: &Accumulator| {
            let (a, b) = (a.total(), b.total());
            close(a.load().total(), b.load().total());
            close(a.area().total(), b.area().total());
            close(a.stiffness(), b.stiffness());
            close(a.contacts(), b.contacts());
            close(a.load_squared(), b.load_squared());
        };
        let empty = || [Accumulator::empty(false), Accumulator::empty(false)];
        for spheres in [None, Some(&spheres[..])] {
            let asperities = Asperities::new(&heights, &radii, spheres, 1.0);
            let [mut lanes, mut each] = empty();
            averaged.accumulate(asperities, 0.0, &mut lanes);
            for (z, shape) in asperities.each() {
                each.add(&averaged.contact(z, shape), shape);
            }
            compare(&lanes, &each);
        }
        let shape = Shape { radius: 1.5e-5, spheres: 2.0 };
        let [mut lanes, mut each] = empty();
        averaged.accumulate_weighted(&heights, &spheres, shape, &mut lanes);
        accumulate_weighted_each(&averaged, &heights, &spheres, shape, &mut each);
        compare(&lanes, &each);
    }
}
