//! The figures of a sweep: the verdict map, quantities against a key, and curves by load.

use asperity::compare::ComparedQuantity;
use asperity_contact_framework::report::format::{Prefix, capitalised};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Plot};

use super::results::{Point, SweepResults};
use super::spec::SweptKey;
use crate::kind::compare::main_figure::{MARKS, Mark, named};
use crate::presentation::quantity_name;

/// Room beside the outermost loads.
const MARGIN: f64 = 1.15;

fn megapascals(load: f64) -> f64 {
    1e-6 * load
}

struct KeyAxis {
    axis: Axis,
    /// SI over the unit of the axis.
    unit: f64,
    key: usize,
}

impl KeyAxis {
    /// That of a key whose values are at least two different finite quantities; by ratios where all are positive.
    fn new(key: usize, swept: &SweptKey) -> Option<Self> {
        let mut finite: Vec<f64> =
            swept.numbers.as_ref()?.iter().copied().filter(|one| one.is_finite()).collect();
        finite.sort_by(f64::total_cmp);
        let (from, to) = (*finite.first()?, *finite.last()?);
        if from == to {
            return None;
        }
        let si = swept.dimension.map_or("", asperity::units::Dimension::si_unit);
        let Prefix { name, size } = Prefix::for_value(if from > 0.0 { (from * to).sqrt() } else { to }, si);
        let label = if name.is_empty() { swept.name.clone() } else { format!("{} ({name})", swept.name) };
        let axis = if from > 0.0 { Axis::log(label) } else { Axis::linear(label) };
        Some(Self { axis: axis.range(from / size, to / size), unit: size, key })
    }

    fn value(&self, results: &SweepResults, variation: usize) -> f64 {
        let key = &results.keys[self.key];
        let place = results.variations[variation].places[self.key];
        key.numbers.as_ref().map_or(f64::NAN, |numbers| numbers[place] / self.unit)
    }
}

impl SweepResults {
    /// The key with most values; the first of several.
    pub fn main_key(&self) -> usize {
        (0..self.keys.len()).rev().max_by_key(|&key| self.keys[key].values.len()).unwrap_or(0)
    }

    /// Whether there is one value for each variation along the main key: one key, or zipped keys.
    pub fn is_one_line(&self) -> bool {
        self.variations.len() == self.keys[self.main_key()].values.len()
    }

    fn cases(&self) -> usize {
        self.points.iter().map(|point| point.case + 1).max().unwrap_or(0)
    }

    /// The values of all keys but `without`, and the surface where there are several cases: what a line or a row is called.
    fn name_without(&self, without: Option<usize>, point: &Point) -> String {
        let places = &self.variations[point.variation].places;
        let keys = self
            .keys
            .iter()
            .enumerate()
            .filter(|(key, _)| Some(*key) != without && !(self.is_one_line() && *key != self.main_key()));
        let mut words: Vec<String> = keys.map(|(key, swept)| swept.words(places[key])).collect();
        if self.cases() > 1 {
            words.push(if self.has_one_law() {
                point.surface.clone()
            } else {
                format!("{}, {}", point.surface, point.law)
            });
        }
        words.join(", ")
    }

    fn has_one_law(&self) -> bool {
        self.points.iter().all(|point| point.law == self.points[0].law)
    }
}

/// A tile: row, where it begins and ends along the other axis, what it says.
type Tile = (usize, [f64; 2], Mark);

/// Verdicts over the swept keys: of one key against load, of several against the key with most values at the load at which variations are compared.
/// `None` where nothing is admissible.
pub fn verdict_map(results: &SweepResults) -> Option<Figure> {
    let mut rows: Vec<String> = Vec::new();
    let (key, by_load) = (results.main_key(), results.is_one_line());
    let without = (!by_load).then_some(key);
    let mut row_of = |point: &Point| {
        let name = results.name_without(without, point);
        rows.iter().position(|row| *row == name).unwrap_or_else(|| {
            rows.push(name);
            rows.len() - 1
        })
    };
    let shown: Vec<(usize, &Point)> = if by_load {
        results.points.iter().map(|point| (row_of(point), point)).collect()
    } else {
        let all = (0..results.variations.len()).flat_map(|variation| results.at_load(variation));
        all.map(|point| (row_of(point), point)).collect()
    };
    let panels: Vec<(ComparedQuantity, Vec<Tile>)> = ComparedQuantity::REPORTED
        .into_iter()
        .map(|quantity| (quantity, tiles(results, &shown, quantity, by_load)))
        .filter(|(_, tiles)| !tiles.is_empty())
        .collect();
    let marks: Vec<Mark> = MARKS
        .into_iter()
        .filter(|mark| panels.iter().flat_map(|(_, tiles)| tiles).any(|(_, _, shown)| shown == mark))
        .collect();
    let loads: Vec<f64> = shown.iter().map(|(_, point)| megapascals(point.pressure)).collect();
    let low = loads.iter().copied().fold(f64::INFINITY, f64::min);
    let high = loads.iter().copied().fold(0.0, f64::max);
    let last = results.keys[key].values.len() as f64 - 0.5;
    let panel = |(quantity, tiles): &(ComparedQuantity, Vec<Tile>)| {
        const ROW: f64 = 24.0;
        let across = if by_load {
            Axis::log("nominal pressure (MPa)").range(low / MARGIN, high * MARGIN)
        } else {
            let names = (0..results.keys[key].values.len()).map(|place| results.keys[key].words(place));
            Axis::named(names).range(-0.5, last).labelled(results.keys[key].name.as_str())
        };
        let mut plot =
            Plot::new(capitalised(quantity_name(*quantity)), across, Axis::named(rows.iter().cloned()))
                .height(ROW * rows.len() as f64)
                .legend(Legend::Below);
        for (colour, name, _) in &marks {
            plot = plot.with(Layer::key().coloured(*colour).named(*name));
        }
        for (row, [from, to], (colour, _, sign)) in tiles {
            let row = *row as f64;
            plot = plot.with(Layer::tile((*from, row - 0.42), (*to, row + 0.42), *sign).coloured(*colour));
        }
        plot
    };
    let plots: Vec<Plot> = panels.iter().map(panel).collect();
    (!plots.is_empty()).then(|| Figure::column("Verdicts over the swept keys", plots))
}

fn tiles(
    results: &SweepResults,
    shown: &[(usize, &Point)],
    quantity: ComparedQuantity,
    by_load: bool,
) -> Vec<Tile> {
    let mark = |point: &Point| {
        let compared = point.of(quantity);
        named(&compared.verdict, compared.difference?)
    };
    if !by_load {
        let key = results.main_key();
        let tile = |(row, point): &(usize, &Point)| {
            let place = results.variations[point.variation].places[key] as f64;
            Some((*row, [place - 0.42, place + 0.42], mark(point)?))
        };
        return shown.iter().filter_map(tile).collect();
    }
    let mut tiles: Vec<Tile> = Vec::new();
    for (place, (row, point)) in shown.iter().enumerate() {
        let Some(mark) = mark(point) else { continue };
        let at = megapascals(point.pressure);
        let beside = |other: Option<&(usize, &Point)>| {
            let of_row = other.filter(|(next, _)| next == row);
            of_row.map(|(_, next)| (at * megapascals(next.pressure)).sqrt())
        };
        let from =
            beside(place.checked_sub(1).and_then(|before| shown.get(before))).unwrap_or(at / MARGIN.sqrt());
        let to = beside(shown.get(place + 1)).unwrap_or(at * MARGIN.sqrt());
        match tiles.last_mut() {
            Some((last, ends, same)) if last == row && *same == mark && ends[1] == from => ends[1] = to,
            _ => tiles.push((*row, [from, to], mark)),
        }
    }
    tiles
}

/// The area, and its difference between the models, against the key with most values, at the load at which variations are compared. `None` of a key
/// without numbers.
pub fn against_key(results: &SweepResults) -> Option<Figure> {
    /// With more lines a legend tells nothing.
    const MOST_NAMED: usize = 6;
    let along = KeyAxis::new(results.main_key(), &results.keys[results.main_key()])?;
    let mut lines: Vec<(String, Vec<&Point>)> = Vec::new();
    for point in (0..results.variations.len()).flat_map(|variation| results.at_load(variation)) {
        let name = results.name_without(Some(along.key), point);
        match lines.iter_mut().find(|(other, _)| *other == name) {
            Some((_, points)) => points.push(point),
            None => lines.push((name, vec![point])),
        }
    }
    if lines.iter().all(|(_, points)| points.len() < 2) {
        return None;
    }
    let of = lines.len();
    let place = |point: &Point| along.value(results, point.variation);
    let panel = |title: &str, y: Axis, values: &dyn Fn(&Point) -> [Option<f64>; 2]| {
        let mut plot = Plot::new(title, along.axis.clone(), y)
            .with_key("sum", Dash::Solid)
            .with_key("integral", Dash::Dashed);
        for (index, (name, points)) in lines.iter().enumerate() {
            for (which, dash) in [Dash::Solid, Dash::Dashed].into_iter().enumerate() {
                let line =
                    points.iter().map(|point| (place(point), values(point)[which].unwrap_or(f64::NAN)));
                let line = Layer::line(line).coloured(Colour::Ordered { index, of }).dashed(dash);
                let is_named = which == 0 && of > 1 && of <= MOST_NAMED;
                plot = plot.with(if is_named { line.named(name.clone()) } else { line });
            }
        }
        plot
    };
    let of_models = |quantity: ComparedQuantity| {
        move |point: &Point| [point.of(quantity).deterministic, point.of(quantity).statistical]
    };
    // Wide intervals are cut where they say no more than that nothing is known.
    const WIDEST: [f64; 2] = [-60.0, 150.0];
    let ends = lines
        .iter()
        .flat_map(|(_, points)| points)
        .filter_map(|point| point.of(ComparedQuantity::Area).interval);
    let [low, high] = ends.fold([0.0, 0.0], |[low, high]: [f64; 2], ends| {
        [low.min(100.0 * ends[0]), high.max(100.0 * ends[1])]
    });
    let percent = Axis::linear("integral over sum − 1 (%)");
    let percent = if low < high { percent.range(low.max(WIDEST[0]), high.min(WIDEST[1])) } else { percent };
    let mut difference = Plot::new("Difference, 95 % interval", along.axis.clone(), percent);
    for (index, (name, points)) in lines.iter().enumerate() {
        let area = |point: &Point| point.of(ComparedQuantity::Area).clone();
        let colour = Colour::Ordered { index, of };
        let band = points.iter().filter_map(|point| {
            let [low, high] = area(point).interval?;
            Some((place(point), 100.0 * low, 100.0 * high))
        });
        let line = points.iter().filter_map(|point| Some((place(point), 100.0 * area(point).difference?)));
        let line = Layer::line(line).coloured(colour);
        let line = if of > 1 && of <= MOST_NAMED { line.named(name.clone()) } else { line };
        difference = difference.with(Layer::band(band).coloured(colour)).with(line);
    }
    let plots = vec![
        panel("Real contact area", Axis::log("area ratio A/A_nom"), &of_models(ComparedQuantity::Area)),
        difference.with_zero(),
    ];
    Some(Figure::row("Both models against the key with most values", plots))
}

/// Real contact area and separation against load for all variations, in the colours of the key with most values. `None` where there are less than three
/// loads, or the key has no numbers.
pub fn curves(results: &SweepResults) -> Option<Figure> {
    let key = KeyAxis::new(results.main_key(), &results.keys[results.main_key()])?;
    let mut loads: Vec<f64> = results.points.iter().map(|point| point.pressure).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    if loads.len() < 3 {
        return None;
    }
    let panel = |title: &str, y: Axis, quantity: ComparedQuantity| {
        let mut plot = Plot::new(title, Axis::log("nominal pressure (MPa)"), y)
            .with_key("sum", Dash::Solid)
            .with_key("integral", Dash::Dashed);
        for points in results.points.chunk_by(|a, b| (a.variation, a.case) == (b.variation, b.case)) {
            let colour = Plot::colour_at(&key.axis, key.value(results, points[0].variation));
            for (which, dash) in [Dash::Solid, Dash::Dashed].into_iter().enumerate() {
                let line = points.iter().filter_map(|point| {
                    let of = point.of(quantity);
                    Some((megapascals(point.pressure), [of.deterministic, of.statistical][which]?))
                });
                plot = plot.with(Layer::line(line).coloured(colour).dashed(dash).thin());
            }
        }
        plot.with_order(key.axis.clone())
    };
    let plots = vec![
        panel("Real contact area", Axis::log("area ratio A/A_nom"), ComparedQuantity::Area),
        panel("Separation", Axis::linear("separation (σ)"), ComparedQuantity::Separation),
    ];
    Some(Figure::column("Both models by load, in the colours of the swept key", plots))
}
