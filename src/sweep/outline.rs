//! The page of a sweep: the answer over its variations, the verdict map, what was looked for; all else is folded.

use asperity::compare::ComparedQuantity;
use asperity_contact_framework::Outcome;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{input_quantity, listed};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use serde_json::{Map, Value, json};

use super::figures;
use super::results::{ChangeRow, CrossingRow, SweepResults};
use super::spec::FoundModel;
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
        if let Some(figure) = figures::verdict_map(self) {
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
        if let Some(figure) = figures::against_key(self) {
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
        if let Some(figure) = figures::curves(self) {
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
