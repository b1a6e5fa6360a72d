//! Results of a sweep: one tidy table, where verdicts change from value to value, and what was looked for.

use std::collections::BTreeSet;

use asperity::compare::ComparedQuantity;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::table::{Heading, Table, Value as Cell};
use asperity_contact_framework::rows;
use indexmap::IndexMap;

use super::Found;
use super::find::{Crossing, verdict_in_words};
use super::plan::SweepPlan;
use super::spec::SweptKey;
use crate::kind::compare::swept_name;

pub const FILE: &str = "sweep.csv";
pub const ROWS: &str = "One row for each variation and each row of what the kind has in a sweep: of `[compare]` each surface, law, layer thickness and load, of other kinds the first table of a report. `variation` and a column for each swept key (SI, or as in the spec) come first.";

pub struct SweepResults {
    pub metadata: Metadata,
    pub kind: &'static str,
    pub keys: Vec<SweptKey>,
    pub variations: Vec<Choice>,
    pub table: Table,
    /// Of comparisons, the rows of the table in numbers.
    pub points: Vec<Point>,
    /// The load at which variations are compared, Pa; `None` where they have none in common.
    pub load: Option<f64>,
    pub changes: Vec<ChangeRow>,
    pub crossings: Vec<CrossingRow>,
    /// How many questions were asked.
    pub asked: usize,
    pub warnings: Vec<String>,
}

/// A variation of which something is known.
pub struct Choice {
    pub places: Vec<usize>,
    pub words: String,
    /// Why it could not be run.
    pub failure: Option<String>,
}

/// One load of one case of a variation.
#[derive(Debug, Clone)]
pub struct Point {
    pub variation: usize,
    /// Which case of its variation it is.
    pub case: usize,
    pub surface: String,
    pub law: String,
    /// Of the layer, m; `None` where the spec has none.
    pub thickness: Option<f64>,
    /// Pa
    pub pressure: f64,
    pub is_reported: bool,
    /// In the order of [`ComparedQuantity::ALL`].
    pub quantities: Vec<Compared>,
}

#[derive(Debug, Clone, Default)]
pub struct Compared {
    pub statistical: Option<f64>,
    pub deterministic: Option<f64>,
    pub difference: Option<f64>,
    pub interval: Option<[f64; 2]>,
    /// Empty where the load is not admissible.
    pub verdict: String,
}

impl Point {
    pub fn of(&self, quantity: ComparedQuantity) -> &Compared {
        &self.quantities[quantity as usize]
    }
}

/// Neighbouring values of a key between which a verdict changes.
#[derive(Debug, Clone)]
pub struct ChangeRow {
    pub key: String,
    pub values: [String; 2],
    pub with: String,
    pub surface: String,
    pub law: String,
    pub quantity: ComparedQuantity,
    pub pressure: f64,
    pub verdicts: [String; 2],
}

rows! { ChangeRow => "changes.csv";
    "One row for each pair of neighbouring values of a swept key between which a verdict of `[compare]` changes, at the load at which variations are compared.";
    row =>
    key["text"] = row.key.as_str(), "The swept key.";
    from["text"] = row.values[0].as_str(), "Its first value.";
    to["text"] = row.values[1].as_str(), "Its next value.";
    with["text"] = row.with.as_str(), "The values of the other keys.";
    surface["text"] = row.surface.as_str(), "Name of the surface.";
    law["text"] = row.law.as_str(), "Contact law of an asperity.";
    quantity["text"] = row.quantity.name(), "The quantity whose verdict changes.";
    pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.pressure, "Nominal pressure.";
    verdict["text", verdict] = verdict_in_words(&row.verdicts[0]), "The verdict at the first value; `not admissible` where the load is not.";
    next_verdict["text", verdict, label("then")] = verdict_in_words(&row.verdicts[1]), "The verdict at the next value.";
}

/// A value of a key that was looked for.
#[derive(Debug, Clone)]
pub struct CrossingRow {
    crossing: Crossing,
    key: SweptKey,
    with: String,
}

impl CrossingRow {
    pub fn value(&self) -> String {
        self.key.in_words(self.crossing.at())
    }

    pub fn crossing(&self) -> &Crossing {
        &self.crossing
    }

    /// What was asked, which several values may answer.
    pub fn question(&self) -> impl PartialEq {
        let Crossing { key, quantity, model, target, pressure, .. } = &self.crossing;
        (*key, *quantity, *model, target.clone(), *pressure)
    }

    pub fn key(&self) -> &SweptKey {
        &self.key
    }

    pub fn with(&self) -> &str {
        &self.with
    }

    fn unit(&self) -> &'static str {
        self.key.dimension.map_or("", asperity::units::Dimension::si_unit)
    }

    pub fn is_of_verdict(&self) -> bool {
        self.crossing.is_of_verdict
    }
}

rows! { CrossingRow => "crossings.csv";
    "One row for each value of a swept key at which what `find` asks for holds, found by bisection between its values: on the compared surface, without an interval.";
    row =>
    key["text"] = row.key.name.as_str(), "The swept key.";
    value["text"] = row.value(), "Its value where it holds, for people.";
    at["SI"] = row.crossing.at(), "The same in SI: the middle of what follows.";
    low["SI", scale_of("at")] = row.crossing.between[0], "It holds above this value.";
    high["SI", scale_of("at")] = row.crossing.between[1], "It holds below this value.";
    unit["text"] = row.unit(), "The unit of these; empty of pure numbers.";
    with["text"] = row.with.as_str(), "The values of the other keys.";
    surface["text"] = row.crossing.surface.as_str(), "Name of the surface.";
    law["text"] = row.crossing.law.as_str(), "Contact law of an asperity.";
    quantity["text"] = row.crossing.quantity.name(), "The quantity, or that of the verdict.";
    target["text"] = row.crossing.target.as_str(), "What was looked for: its value, its ratio to another case, or the change of its verdict towards larger values.";
    model["text"] = (!row.is_of_verdict()).then(|| row.crossing.model.name()), "By which model; empty of a verdict.";
    pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.crossing.pressure, "Nominal pressure.";
    limits["text", label("exceeds")] = row.crossing.limits.as_str(), "Limits of admissible loads that are exceeded there, as in `curves.csv`; empty where the load is admissible.";
}

impl SweepResults {
    /// The results of a sweep from what was found in its variations, in their order.
    pub fn new(metadata: Metadata, plan: &SweepPlan, found: &[Found], crossings: Vec<Crossing>) -> Self {
        let tables: Vec<Option<Table>> = found.iter().map(|one| one.table(plan)).collect();
        let variations: Vec<Choice> = plan
            .variations
            .iter()
            .zip(found)
            .map(|(variation, found)| Choice {
                places: variation.places.clone(),
                words: plan.words(&variation.places),
                failure: found.failure.clone(),
            })
            .collect();
        let points: Vec<Point> = tables
            .iter()
            .enumerate()
            .filter_map(|(variation, table)| Some(points(variation, table.as_ref()?)))
            .flatten()
            .collect();
        let load = common_load(&points, variations.iter().filter(|one| one.failure.is_none()).count());
        let of_crossing = |crossing: Crossing| CrossingRow {
            key: plan.keys[crossing.key].clone(),
            with: words_without(&plan.keys, &crossing.places, crossing.key),
            crossing,
        };
        let mut results = Self {
            metadata,
            kind: plan.kind,
            keys: plan.keys.clone(),
            variations,
            table: one_table(plan, &tables),
            points,
            load,
            changes: Vec::new(),
            crossings: crossings.into_iter().map(of_crossing).collect(),
            asked: plan.finds.len(),
            warnings: Vec::new(),
        };
        results.changes = results.find_changes();
        results.warnings = results.collect_warnings(found);
        results
    }

    /// What is known of each case of a variation at the load at which variations are compared.
    pub fn at_load(&self, variation: usize) -> impl Iterator<Item = &Point> {
        self.points.iter().filter(move |point| {
            point.variation == variation && self.load.map_or(point.is_reported, |load| point.pressure == load)
        })
    }

    /// The variations by pairs that differ by one step in one key only (zipped keys step together), with the key.
    fn neighbours(&self) -> Vec<(usize, [usize; 2])> {
        let mut pairs = Vec::new();
        let is_step = |a: &[usize], b: &[usize]| -> Option<usize> {
            let moved: Vec<usize> = (0..a.len()).filter(|&k| a[k] != b[k]).collect();
            let together =
                moved.len() == a.len() && moved.iter().all(|&k| b[k] == a[k] + 1) && self.is_zipped();
            (together || matches!(moved[..], [k] if b[k] == a[k] + 1)).then(|| moved[0])
        };
        for (first, a) in self.variations.iter().enumerate() {
            for (second, b) in self.variations.iter().enumerate() {
                pairs.extend(is_step(&a.places, &b.places).map(|key| (key, [first, second])));
            }
        }
        pairs.sort_by_key(|(key, pair)| (*key, *pair));
        pairs
    }

    fn is_zipped(&self) -> bool {
        self.keys.len() > 1
            && self.variations.iter().all(|one| one.places.windows(2).all(|pair| pair[0] == pair[1]))
    }

    fn find_changes(&self) -> Vec<ChangeRow> {
        let mut rows = Vec::new();
        for (key, [first, second]) in self.neighbours() {
            for a in self.at_load(first) {
                let Some(b) = self.at_load(second).find(|b| b.case == a.case) else { continue };
                for quantity in ComparedQuantity::REPORTED {
                    let verdicts = [a, b].map(|point| point.of(quantity).verdict.clone());
                    let is_compared = a.of(quantity).difference.or(b.of(quantity).difference).is_some();
                    if verdicts[0] == verdicts[1] || !is_compared {
                        continue;
                    }
                    let places = &self.variations[first].places;
                    let zipped = self.is_zipped();
                    let words =
                        |variation: usize| self.keys[key].words(self.variations[variation].places[key]);
                    rows.push(ChangeRow {
                        key: self.keys[key].name.clone(),
                        values: [words(first), words(second)],
                        with: if zipped { String::new() } else { words_without(&self.keys, places, key) },
                        surface: a.surface.clone(),
                        law: a.law.clone(),
                        quantity,
                        pressure: a.pressure,
                        verdicts,
                    });
                }
            }
        }
        rows
    }

    /// Warnings, each once, with the number of variations that have it.
    fn collect_warnings(&self, found: &[Found]) -> Vec<String> {
        let mut warnings: Vec<String> = self
            .variations
            .iter()
            .enumerate()
            .filter_map(|(k, one)| {
                Some(format!(
                    "variation {} ({}) could not be run: {}",
                    k + 1,
                    one.words,
                    one.failure.as_ref()?
                ))
            })
            .collect();
        // Those that differ by their numbers only are one, shown as the first has it.
        let mut counted: IndexMap<String, (&str, BTreeSet<usize>)> = IndexMap::new();
        for (variation, warning) in
            found.iter().enumerate().flat_map(|(k, one)| one.warnings.iter().map(move |warning| (k, warning)))
        {
            let without_numbers =
                warning.chars().filter(|letter| !letter.is_ascii_digit() && *letter != '.').collect();
            counted.entry(without_numbers).or_insert_with(|| (warning, BTreeSet::new())).1.insert(variation);
        }
        warnings.extend(counted.into_values().map(|(warning, variations)| match variations.len() {
            count if count == found.len() => warning.to_owned(),
            count => format!("{count} of {} variations: {warning}", found.len()),
        }));
        let looked_for = self.asked > 0 && self.crossings.is_empty();
        warnings.extend(
            looked_for
                .then(|| "what `find` asks for holds at no value between those that were swept".to_owned()),
        );
        warnings
    }
}

/// The values of all keys but one, in words.
fn words_without(keys: &[SweptKey], places: &[usize], without: usize) -> String {
    let others = keys.iter().zip(places).enumerate().filter(|(k, _)| *k != without);
    others
        .map(|(_, (key, &place))| format!("{} = {}", key.name, key.words(place)))
        .collect::<Vec<_>>()
        .join(", ")
}

/// All rows of all variations, with the number of the variation and the values of its keys.
fn one_table(plan: &SweepPlan, tables: &[Option<Table>]) -> Table {
    let shown =
        |heading: &&Heading| tables.iter().flatten().any(|table| table.column(&heading.name).is_some());
    let headings: Vec<&Heading> = plan.schema.columns.iter().filter(shown).collect();
    let mut own: Vec<Vec<Cell>> = vec![Vec::new(); 1 + plan.keys.len()];
    let mut cells: Vec<Vec<Cell>> = vec![Vec::new(); headings.len()];
    for (number, (variation, table)) in plan.variations.iter().zip(tables).enumerate() {
        let Some(table) = table else { continue };
        let rows = table.rows();
        own[0].extend(std::iter::repeat_n(Cell::from(number + 1), rows));
        for ((key, &place), column) in plan.keys.iter().zip(&variation.places).zip(&mut own[1..]) {
            column.extend(std::iter::repeat_n(key.cell(place), rows));
        }
        for (heading, column) in headings.iter().zip(&mut cells) {
            match table.column(&heading.name) {
                Some((_, values)) => column.extend_from_slice(values),
                None => column.extend(std::iter::repeat_n(Cell::Empty, rows)),
            }
        }
    }
    let variation = Heading {
        meaning: "Number of the variation, from 1.".to_owned(),
        ..Heading::of_key("variation", "count")
    };
    let before = std::iter::once(variation).chain(plan.keys.iter().map(SweptKey::heading)).zip(own);
    Table::from_columns(FILE, ROWS, before.chain(headings.into_iter().cloned().zip(cells)))
}

/// The rows of a comparison in numbers, without those on the uncoated flat that stand beside a layer; none of another kind.
fn points(variation: usize, table: &Table) -> Vec<Point> {
    let column = |name: &str| table.column(name).map_or(&[][..], |(_, cells)| cells);
    let number = |name: &str, row: usize| column(name).get(row).and_then(Cell::number);
    let text = |name: &str, row: usize| column(name).get(row).map_or("", Cell::text).to_owned();
    if table.column("area_verdict").is_none() {
        return Vec::new();
    }
    let mut case = 0;
    let mut points: Vec<Point> = Vec::with_capacity(table.rows());
    for row in 0..table.rows() {
        let pressure = number("pressure_pa", row).unwrap_or(f64::NAN);
        let (surface, law) = (text("surface", row), text("law", row));
        let thickness = number("layer_thickness_m", row);
        if thickness == Some(0.0) && column("layer_thickness_m").iter().any(|cell| cell.number() > thickness)
        {
            continue;
        }
        let is_next = points
            .last()
            .is_some_and(|last| (&last.surface, &last.law, last.thickness) != (&surface, &law, thickness));
        case += usize::from(is_next);
        let quantity = |quantity: ComparedQuantity| {
            let of = |what: &str| number(&swept_name(quantity, what), row);
            Compared {
                statistical: of("statistical"),
                deterministic: of("deterministic"),
                difference: of("difference"),
                interval: of("low").zip(of("high")).map(|(low, high)| [low, high]),
                verdict: text(&swept_name(quantity, "verdict"), row),
            }
        };
        points.push(Point {
            variation,
            case,
            surface,
            law,
            thickness,
            pressure,
            is_reported: column("reported").get(row) == Some(&Cell::Flag(true)),
            quantities: ComparedQuantity::ALL.map(quantity).to_vec(),
        });
    }
    points
}

/// Of the loads that all `of` variations have, that at which most are admissible; of several the middle one.
fn common_load(points: &[Point], of: usize) -> Option<f64> {
    let mut loads: Vec<f64> =
        points.iter().map(|point| point.pressure).filter(|load| load.is_finite()).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    let at = |load: f64| points.iter().filter(move |point| point.pressure == load);
    let of_all = |load: &f64| {
        let mut variations: Vec<usize> = at(*load).map(|point| point.variation).collect();
        variations.dedup();
        variations.len() == of
    };
    loads.retain(of_all);
    let admissible = |load: f64| {
        at(load).filter(|point| point.quantities.iter().any(|one| !one.verdict.is_empty())).count()
    };
    let most = loads.iter().map(|&load| admissible(load)).max()?;
    loads.retain(|&load| admissible(load) == most);
    loads.get(loads.len() / 2).copied()
}
