//! The page of a comparison: the card of one case, or the verdict map of several, then the main figure; all else is folded.

mod case;

use asperity::compare::{ComparedQuantity, ModelKind};
use asperity::law::Body;
use asperity::study::{FilmFriction, Shortcut};
use asperity_contact_framework::Outcome;
use asperity_contact_framework::metadata::{ContactSummary, Metadata};
use asperity_contact_framework::report::answer::Answer;
use asperity_contact_framework::report::format::{
    capitalised, input_quantity, listed, number, signed, thickness,
};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections as common;
use asperity_contact_framework::report::table::{Reading, Table, Tables};
use asperity_contact_framework::report::view::View;
use serde_json::{Map, Value, json};

use super::card::{Card, CaseAnswer, Counts};
use super::figures::{layers, main_figure};
use super::results::{CompareResults, SurfaceResults};
use super::rows;
use super::rows::{
    AnswerRow, CaseRow, DecreaseRow, FrictionRow, GreenwoodTrippRow, NearerRow, ReadingRow,
    ReferenceCurveRow, ResultRow, RuleRow, Simplification, StandingRow, SurfaceCase, ThresholdRow,
    TwoBodiesRow, VerdictRow, tables,
};
use super::series::Series;
use crate::model_tables::{REFERENCE, of_asked_spots};
use crate::presentation::quantity_name;
use crate::surface::{rows as surface_rows, section};

impl Outcome for CompareResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.warnings()
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn swept(&self) -> Option<Table> {
        let table = of_asked_spots(Table::new(rows::swept(self)), &self.spots);
        Some(if self.reference.is_none() { table.without_part(REFERENCE) } else { table })
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        let series = Series::all(self);
        let cases: Vec<SurfaceCase> = SurfaceCase::all(self).collect();
        match &cases[..] {
            [only] => {
                page.card(Card::new(*only).lines());
                main_figure::of_case_or_paper(&mut page, self, *only, &series);
            }
            several => {
                let (counts, least) = (count(several.iter().copied()), sole_friction(&series));
                let first = two_bodies_in_words(self).or(least).unwrap_or_default();
                page.lead(&format!("{first}{counts}"));
                main_figure::of_paper(&mut page, self, &series);
                friction(&mut page, tables, &series);
                page.view(&answers(tables));
                main_figure::verdict_maps(&mut page, self, &series);
            }
        }
        for series in &series {
            page.details(2, &format!("{}: by layer thickness", series.subject), |page| {
                case::figures(series, page);
                case::table(series, page, tables);
            });
        }
        common::warnings(&mut page, &self.page_warnings());
        two_bodies(&mut page, tables);
        results(&mut page, tables);
        verdicts(&mut page, tables);
        reference(&mut page, tables);
        models(&mut page, tables);
        layer(&mut page, tables);
        if series.is_empty() {
            cases.iter().for_each(|case| case::section(&mut page, self, tables, *case));
        }
        for surface in &self.surfaces {
            let which = match surface.realisations.len() {
                1 => String::new(),
                count => format!(", the first of {count} {}", surface.surface.repeats.name()),
            };
            page.details(2, &format!("Surface {}{which}", surface.surface.name), |page| {
                section::section(page, tables, &surface.surface, Some(&surface.realisations[0].population));
                case::statistical_model(page, surface);
                case::contacts(page, self, surface);
            });
        }
        readings(&mut page, tables);
        common::notes(&mut page, &self.metadata);
        common::what_was_run(&mut page, &self.metadata, &self.contact, |_| {});
        let spec = self.described.as_ref().map(|described| described.spec.as_str());
        common::run_again(&mut page, &self.metadata, spec);
        common::sources(&mut page, &self.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        let mut facts = asperity_contact_framework::fields(&ContactSummary::new(&self.contact))?;
        let mut add = |key: &str, value: Value| facts.insert(key.to_owned(), value);
        if let Some(described) = &self.described {
            add("looked_at", json!(described.file));
        }
        if let Some(layer) = &self.contact.layer {
            let finite = |t: &f64| if t.is_finite() { json!(t) } else { json!("inf") };
            let mut fields = json!({
                "material": layer.name,
                "rule": layer.rule.name(),
                "thicknesses_m": layer.thicknesses.iter().map(finite).collect::<Vec<_>>(),
                "modulus_ratio": layer.check.as_ref().map(|check| check.modulus_ratio),
                "rule_errors": Table::new(RuleRow::all(self)).records(),
            });
            if layer.on == Body::Rough {
                fields["on"] = json!(layer.on.name());
            }
            add("layer", fields);
        }
        add("surfaces", surface_rows::records(self.surface_rows()));
        Ok(facts)
    }

    fn terminal(&self) -> Option<String> {
        if self.described.is_none() {
            return Some(self.for_terminal(SurfaceCase::all(self).collect()));
        }
        let text = |surface: &SurfaceResults| {
            let cases = SurfaceCase::on_surface(surface).collect();
            format!(
                "\n{}\n\n{}",
                section::for_terminal(&surface.surface).trim_end(),
                self.for_terminal(cases)
            )
        };
        Some(self.surfaces.iter().map(text).collect::<Vec<_>>().join("\n"))
    }
}

impl CompareResults {
    /// The cards of few cases, or a sentence and a table of many.
    fn for_terminal(&self, cases: Vec<SurfaceCase>) -> String {
        /// The most cases of which each has its card.
        const FEW: usize = 3;
        let card = |case: &SurfaceCase| Answer { lines: Card::new(*case).lines(), ..Answer::default() };
        match &cases[..] {
            [only] => card(only).to_string(),
            few if few.len() <= FEW => {
                let each = few.iter().map(|case| format!("{}\n{}", case.name(self), card(case)));
                each.collect::<Vec<_>>().join("\n\n")
            }
            many => {
                let table = Tables::new(vec![Table::new(rows::answers(self))]);
                format!("{}\n{}", count(many.iter().copied()), answers(&table).text().lines())
            }
        }
    }
}

/// What simplifications of two rough bodies do to the contact area: "Taking liner smooth gives +38.5 % contact area, ring +62.2 %, adding the variances
/// -24.8 % (against the sum, 10 MPa). " Of one pair under one law.
fn two_bodies_in_words(results: &CompareResults) -> Option<String> {
    let rows = rows::two_bodies(results);
    let of_sum: Vec<&TwoBodiesRow> =
        rows.iter().filter(|row| row.model() == Some(ModelKind::Deterministic)).collect();
    let error = |row: &TwoBodiesRow| Some(signed(100.0 * row.error(ComparedQuantity::Area)?));
    let smooth = |row: &&TwoBodiesRow| match row.simplification() {
        Simplification::Smooth(body) => Some((body.to_owned(), error(row)?)),
        Simplification::Shortcut(_) => None,
    };
    let [(one, first), (other, second)] = &of_sum.iter().filter_map(smooth).collect::<Vec<_>>()[..] else {
        return None;
    };
    let added = Simplification::Shortcut(Shortcut::VariancesAdded);
    let added = of_sum.iter().find(|row| row.simplification() == added).and_then(|row| error(row));
    let added = added.map_or_else(String::new, |error| format!(", adding the variances {error} %"));
    Some(format!(
        "Taking {one} smooth gives {first} % contact area, {other} {second} %{added} (against the sum, {}). ",
        input_quantity(of_sum[0].pressure(), "Pa")
    ))
}

/// [`least_friction`] where one surface has it under one law.
fn sole_friction(series: &[Series]) -> Option<String> {
    let mut with_friction = series.iter().filter(|series| !series.friction.is_empty());
    let sole = with_friction.next()?;
    if with_friction.next().is_some() { None } else { least_friction(sole) }
}

/// "Friction at 5 MPa is least at 80 to 150 nm by the sum (0.066, uncoated 0.124) and at 80 nm by the integral (0.0705, uncoated 0.156). Assumed: a film
/// breaks at an indentation of 1 thickness (sum: least at 5 nm for 0.5, 60 nm for 2). ", at the middle one of the loads that are admissible under all.
fn least_friction(series: &Series) -> Option<String> {
    let first = series.friction.first()?;
    let mut loads: Vec<f64> = series.friction.iter().map(|friction| friction.pressure).collect();
    loads.dedup();
    let admissible: Vec<f64> = loads.iter().copied().filter(|&load| series.is_admissible(load)).collect();
    let among = if admissible.is_empty() { &loads } else { &admissible };
    let load = among[among.len() / 2];
    let curve = |kind: ModelKind, breakdown: f64| {
        let is_it = |friction: &&&FilmFriction| {
            (friction.pressure, friction.breakdown, friction.kind) == (load, breakdown, kind)
        };
        series.friction.iter().find(is_it).copied()
    };
    let by_model = |kind: ModelKind, name: &str| {
        let friction = curve(kind, first.breakdown)?;
        let (_, least) = friction.least()?;
        let uncoated =
            friction.at(0.0).map_or_else(String::new, |bare| format!(", uncoated {}", number(bare)));
        Some(format!("{} by {name} ({}{uncoated})", series.least_friction_at(friction)?, number(least)))
    };
    let models =
        [by_model(ModelKind::Deterministic, "the sum"), by_model(ModelKind::Statistical, "the integral")];
    let models: Vec<String> = models.into_iter().flatten().collect();
    let mut breakdowns: Vec<f64> = series.friction.iter().map(|friction| friction.breakdown).collect();
    breakdowns.sort_by(f64::total_cmp);
    breakdowns.dedup();
    let other = |&breakdown: &f64| {
        let (at, _) = curve(ModelKind::Deterministic, breakdown)?.least()?;
        Some(format!("{} for {}", thickness(at), number(breakdown)))
    };
    let others: Vec<String> =
        breakdowns.iter().filter(|breakdown| **breakdown != first.breakdown).filter_map(other).collect();
    let others =
        if others.is_empty() { String::new() } else { format!(" (sum: least at {})", others.join(", ")) };
    Some(format!(
        "Friction at {}{} is least {}. Assumed: a film breaks at an indentation of {} times its thickness{others}. ",
        input_quantity(load, "Pa"),
        if admissible.is_empty() { ", which is not admissible," } else { "" },
        listed(&models),
        number(first.breakdown),
    ))
}

/// How many cases have which answer, in one or two sentences.
fn count<'a>(cases: impl IntoIterator<Item = SurfaceCase<'a>>) -> String {
    let answers: Vec<CaseAnswer> = cases.into_iter().filter_map(CaseAnswer::new).collect();
    if answers.is_empty() {
        return "The models are not compared at equal load in any case.".to_owned();
    }
    Counts::new(&answers).sentences()
}

/// Columns that name a case, which are left out where there is one.
const CASE: [&str; 3] = ["surface", "law", "layer_thickness_m"];

/// More rows are folded.
const MOST_OPEN: usize = 12;

/// May the integral replace the sum, case by case.
pub fn answers<'t>(tables: &'t Tables) -> View<'t> {
    tables.view::<AnswerRow>().without_constant(&CASE)
}

/// The answer at the one load or separation of a spec.
pub fn results(page: &mut Page, tables: &Tables) {
    let view = tables.view::<ResultRow>();
    if view.is_empty() {
        return;
    }
    let view = view.without_constant(&CASE);
    if view.len() > MOST_OPEN {
        page.details(2, "Results at one load", |page| {
            page.view(&view);
        });
    } else {
        page.heading(2, "Results").view(&view);
    }
}

/// What simplifications of two rough bodies do to the results.
pub fn two_bodies(page: &mut Page, tables: &Tables) {
    let view = tables.view::<TwoBodiesRow>().without_constant(&CASE);
    if !view.is_empty() {
        page.heading(2, "What if the two rough bodies are simplified?").view(&view);
    }
    let curve = tables.view::<GreenwoodTrippRow>().without_constant(&CASE);
    if !curve.is_empty() {
        page.details(2, "Pressure over separation by Greenwood and Tripp", |page| {
            page.view(&curve);
        });
    }
}

/// The friction of layers by their thickness: where it is least, and by which model.
pub fn friction(page: &mut Page, tables: &Tables, series: &[Series]) {
    let view = tables.view::<FrictionRow>();
    if view.is_empty() {
        return;
    }
    page.heading(2, "Boundary friction by layer thickness");
    for series in series {
        if let Some(figure) = layers::friction_by_thickness(series) {
            page.figure(
                &format!("{}-friction.svg", series.stem),
                figure,
                &format!(
                    "{}: coefficient of boundary friction against layer thickness. Thin layers are broken through, thick ones have more \
                     contact area. No ploughing, no growth of junctions.",
                    series.subject
                ),
            );
        }
    }
    let view = view.without_constant(&CASE[..2]);
    if view.len() > MOST_OPEN {
        page.details(3, "Least friction by load, breakdown and model", |page| {
            page.view(&view);
        });
    } else {
        page.view(&view);
    }
}

/// The verdicts on the statistical model against the sum, and how sure they are.
pub fn verdicts(page: &mut Page, tables: &Tables) {
    let view = tables.view::<VerdictRow>().only("against", "deterministic").without(&["model"]);
    if view.is_empty() {
        return;
    }
    page.heading(2, "May the integral replace the sum?");
    by_quantity(page, &view);
    page.details(3, "How sure are the verdicts?", |page| {
        page.view(&tables.view::<CaseRow>().without_constant(&CASE));
    });
}

/// A view of each quantity, whose differences have a unit of their own.
fn by_quantity(page: &mut Page, view: &View) {
    for quantity in ComparedQuantity::REPORTED {
        let view = view.clone().only("quantity", quantity.name()).without_constant(&CASE);
        let view = ["difference", "low", "high"].into_iter().fold(view, |view, column| match quantity {
            ComparedQuantity::Separation => view,
            _ => view.read_as(column, Reading::SignedPercent),
        });
        let view = match quantity {
            ComparedQuantity::Separation => view.label("difference", "largest difference (σ)"),
            _ => view.read_as("accepted", Reading::Percent),
        };
        if !view.is_empty() {
            let title = capitalised(quantity_name(quantity));
            if view.len() > MOST_OPEN {
                page.details(3, &title, |page| {
                    page.view(&view);
                });
            } else {
                page.heading(3, &title).view(&view);
            }
        }
    }
}

pub fn reference(page: &mut Page, tables: &Tables) {
    let solved = tables.view::<ReferenceCurveRow>();
    if solved.is_empty() {
        return;
    }
    page.heading(2, "Which model is nearer to the reference?");
    let nearer = tables.view::<NearerRow>().without_constant(&CASE);
    page.view(&nearer.clone().only("quantity", ComparedQuantity::Area.name()));
    page.details(3, "Separation, stiffness, and both models against the reference", |page| {
        page.view(&nearer.filter("quantity", |cell| cell.text() != ComparedQuantity::Area.name()));
        by_quantity(page, &tables.view::<VerdictRow>().only("against", REFERENCE));
        page.view(&solved.without_constant(&CASE));
    });
}

/// Which statistical models are within what is accepted.
pub fn models(page: &mut Page, tables: &Tables) {
    let view = tables.view::<StandingRow>().without(&["inapplicable", "within_in_sample"]);
    if view.is_empty() {
        return;
    }
    page.details(2, "Which statistical models are within what is accepted on this surface?", |page| {
        by_quantity_of_models(page, &view);
    });
}

fn by_quantity_of_models(page: &mut Page, view: &View) {
    for quantity in ComparedQuantity::REPORTED {
        let view =
            view.clone().only("quantity", quantity.name()).without_constant(&CASE).without(&["within"]);
        let view = match quantity {
            ComparedQuantity::Separation => view.label("nearest_difference", "its difference (σ)"),
            _ => view
                .read_as("nearest_difference", Reading::SignedPercent)
                .read_as("accepted", Reading::Percent),
        };
        if !view.is_empty() {
            page.heading(3, &capitalised(quantity_name(quantity))).view(&view);
        }
    }
}

/// What the layer changes, and how good its effective modulus is.
pub fn layer(page: &mut Page, tables: &Tables) {
    let thresholds = tables.view::<ThresholdRow>().without_constant(&CASE[..2]);
    if !thresholds.is_empty() {
        page.heading(2, "Up to which thickness does the layer change the model's area by at most 5 %?")
            .view(&thresholds);
    }
    let rules = tables.view::<RuleRow>();
    if !rules.is_empty() {
        page.details(2, "Accuracy of the effective-modulus models", |page| {
            page.view(&rules);
        });
    }
    let decreases = tables.view::<DecreaseRow>().without_constant(&CASE);
    if !decreases.is_empty() {
        page.details(2, "Asperities whose area or load decreases as they are pressed deeper", |page| {
            page.view(&decreases);
        });
    }
}

/// σ and d read as those of the asperities, or of the surface.
pub fn readings(page: &mut Page, tables: &Tables) {
    let view = tables.view::<ReadingRow>();
    if !view.is_empty() {
        page.heading(2, "Two readings of σ and d").view(&view);
    }
}
