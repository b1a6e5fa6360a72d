//! The page of a sweep: the answer over its variations, the verdict map, what was looked for; all else is folded.

use asperity::compare::ComparedQuantity;
use asperity_contact_framework::Outcome;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{Prefix, capitalised, input_quantity, listed};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Legend, Plot};
use serde_json::{Map, Value, json};

use super::results::{ChangeRow, CrossingRow, Point, SweepResults};
use super::spec::{FoundModel, SweptKey};
use crate::kind::compare::main_figure::{MARKS, Mark, named};
use crate::presentation::quantity_name;

impl Outcome for SweepResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    fn tables(&self) -> Vec<Table> {
        let mut tables = vec![self.table.clone()];
        if !self.points.is_empty() {
            tables.push(Table::new(self.changes.iter().cloned()));
        }
        if self.asked > 0 {
            tables.push(Table::new(self.crossings.iter().cloned()));
        }
        tables
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        page.lead(&self.sentence());
        if let Some(figure) = verdict_map(self) {
            page.figure("verdicts.svg", figure, &self.caption_of_map());
        }
        if self.asked > 0 {
            page.heading(2, "What was looked for");
            page.view(
                &tables
                    .view::<CrossingRow>()
                    .columns(&[
                        "key",
                        "value",
                        "with",
                        "surface",
                        "quantity",
                        "target",
                        "model",
                        "pressure_pa",
                        "limits",
                    ])
                    .without_constant(&["surface", "with"]),
            );
        }
        sections::warnings(&mut page, &self.warnings);
        if let Some(figure) = against_key(self) {
            page.figure(
                "against-key.svg",
                figure,
                &format!(
                    "Both models{}; solid: sum, dashed: integral{}.",
                    self.at_load_words(),
                    self.colours()
                ),
            );
        }
        if let Some(figure) = curves(self) {
            page.figure(
                "curves.svg",
                figure,
                "Both models by load for all variations; solid: sum, dashed: integral.",
            );
        }
        if !self.changes.is_empty() {
            page.details(2, "Where verdicts change", |page| {
                page.view(&tables.view::<ChangeRow>().without_constant(&["surface", "law", "with", "key"]));
            });
        }
        page.details(2, "Variations", |page| self.variations_table(page));
        sections::notes(&mut page, &self.metadata);
        page.details(2, "Set-up", |page| {
            page.paragraph(&format!(
                "{} variations of `[{}]`; `sweep.csv` has all their rows, with a column for each key. {}",
                self.variations.len(),
                self.kind,
                sections::provenance(&self.metadata),
            ));
        });
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        let keys: Vec<&str> = self.keys.iter().map(|key| key.name.as_str()).collect();
        let mut facts = Map::new();
        facts.insert("swept_kind".to_owned(), json!(self.kind));
        facts.insert("swept_keys".to_owned(), json!(keys));
        facts.insert("variations".to_owned(), json!(self.variations.len()));
        facts.insert("compared_at_pa".to_owned(), json!(self.load));
        Ok(facts)
    }

    fn terminal(&self) -> Option<String> {
        Some(self.sentence().replace('`', ""))
    }
}

impl SweepResults {
    /// " at 1 MPa".
    fn at_load_words(&self) -> String {
        self.load.map_or_else(
            || " at the load of each".to_owned(),
            |load| format!(" at {}", input_quantity(load, "Pa")),
        )
    }

    /// The answer: how often the integral will do, and what was looked for.
    fn sentence(&self) -> String {
        let mut sentences: Vec<String> = Vec::new();
        /// More are in the table alone.
        const MOST_CROSSINGS: usize = 3;
        if let Some(first) = self.crossings.first() {
            let found = first.crossing();
            let alike: Vec<&CrossingRow> =
                self.crossings.iter().filter(|row| row.question() == first.question()).collect();
            let values = if alike.iter().all(|row| row.with() == first.with()) {
                let mut shown: Vec<String> =
                    alike.iter().take(MOST_CROSSINGS).map(|row| row.value()).collect();
                let more = alike.len().saturating_sub(MOST_CROSSINGS);
                shown.extend((more > 0).then(|| format!("{more} more values")));
                listed(&shown)
            } else {
                let by_value =
                    |a: &&&CrossingRow, b: &&&CrossingRow| a.crossing().at().total_cmp(&b.crossing().at());
                let ends = [alike.iter().min_by(by_value), alike.iter().max_by(by_value)];
                let [from, to] = ends.map(|row| row.map_or_else(String::new, |row| row.value()));
                format!("{from} to {to}, depending on the other keys")
            };
            let (quantity, load) = (quantity_name(found.quantity), input_quantity(found.pressure, "Pa"));
            let what = match found.model {
                _ if first.is_of_verdict() => {
                    format!("The verdict on the {quantity} changes from {}", found.target)
                }
                FoundModel::Deterministic => {
                    format!("By the sum the {quantity} is {}", found.target)
                }
                FoundModel::Statistical => {
                    format!("By the integral the {quantity} is {}", found.target)
                }
                FoundModel::Reference => {
                    format!("By boundary elements the {quantity} is {}", found.target)
                }
                FoundModel::Difference => {
                    format!("The difference in {quantity} is {}", found.target)
                }
            };
            let is_beyond = |row: &&&CrossingRow| !row.crossing().limits.is_empty();
            let beyond = match alike.iter().filter(is_beyond).count() {
                0 => String::new(),
                count if count == alike.len() => "; the load is not admissible there".to_owned(),
                count => format!("; the load is not admissible at {count} of them"),
            };
            sentences.push(format!("{what} at {load} and `{}` = {values}{beyond}.", first.key().name));
            if !first.is_of_verdict() {
                sentences.push("This holds on the compared surface, without an interval.".to_owned());
            }
        }
        let verdicts = self.counted();
        sentences.extend((!verdicts.is_empty()).then_some(verdicts));
        if sentences.is_empty() {
            sentences.push(format!("{} variations of `[{}]` were run.", self.variations.len(), self.kind));
        }
        sentences.join(" ")
    }

    /// "At 1 MPa the contact area of the integral is within what is accepted in 5 of 12 variations, beyond it in 4."
    fn counted(&self) -> String {
        let at_load = (0..self.variations.len()).flat_map(|variation| self.at_load(variation));
        let verdicts: Vec<&str> =
            at_load.map(|point| point.of(ComparedQuantity::Area).verdict.as_str()).collect();
        let of = verdicts.len();
        if of == 0 {
            return String::new();
        }
        let count = |is_it: fn(&str) -> bool| verdicts.iter().filter(|verdict| is_it(verdict)).count();
        let counts = [
            (count(|verdict| verdict.ends_with("within")), "within what is accepted"),
            (count(|verdict| verdict.ends_with("beyond")), "beyond it"),
            (count(|verdict| verdict == "cannot-tell"), "undecided"),
            (count(|verdict| verdict == "blocked"), "not told of an unfit map"),
            (count(str::is_empty), "outside admissible loads"),
        ];
        let words: Vec<String> = counts
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, words)| format!("{words} in {count}"))
            .collect();
        let load = self.load.map_or_else(
            || "At the load of each".to_owned(),
            |load| format!("At {}", input_quantity(load, "Pa")),
        );
        format!("{load} the area of the integral is, of {of} cases, {}.", listed(&words))
    }

    /// "; colours: material.lead.hardness" of lines that differ in other keys.
    fn colours(&self) -> String {
        if self.is_one_line() { String::new() } else { format!("; colours: {}", self.other_keys()) }
    }

    fn caption_of_map(&self) -> String {
        let rows = self.other_keys();
        if self.is_one_line() {
            format!(
                "Verdicts by {} and load; blank where the load is not admissible.",
                self.keys[self.main_key()].name
            )
        } else {
            format!("Verdicts{}, {rows} down; blank where the load is not admissible.", self.at_load_words())
        }
    }

    /// The keys but the one with most values.
    fn other_keys(&self) -> String {
        let others = self.keys.iter().enumerate().filter(|(key, _)| *key != self.main_key());
        let names: Vec<String> = others.map(|(_, key)| key.name.clone()).collect();
        listed(&names)
    }

    /// The variations with their verdicts on the area at the load.
    fn variations_table(&self, page: &mut Page) {
        let row = |(variation, choice): (usize, &super::results::Choice)| {
            let mut cells = vec![(variation + 1).to_string()];
            cells.extend(self.keys.iter().zip(&choice.places).map(|(key, &place)| key.words(place)));
            if !self.points.is_empty() {
                let verdicts: Vec<&str> = self
                    .at_load(variation)
                    .map(|point| super::find::verdict_in_words(&point.of(ComparedQuantity::Area).verdict))
                    .collect();
                cells.push(if choice.failure.is_some() { "failed".to_owned() } else { verdicts.join("; ") });
            }
            cells
        };
        let mut header = vec!["variation".to_owned()];
        header.extend(self.keys.iter().map(|key| key.name.clone()));
        header.extend(
            (!self.points.is_empty()).then(|| format!("verdict on the area{}", self.at_load_words())),
        );
        page.table(&header, self.variations.iter().enumerate().map(row));
    }
}

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
