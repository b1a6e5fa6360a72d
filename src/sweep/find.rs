//! Where a quantity is a given one, or a verdict changes, between the values of a key.

use asperity::compare::ComparedQuantity;
use asperity_contact_framework::Kind;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::report::format::input_number;
use asperity_contact_framework::report::table::{Table as Rows, Value as Cell};
use toml::{Table, Value};

use super::Run;
use super::plan::without_what_is_not_shown;
use super::spec::{Combine, FindSpec, FoundModel, SweptKey, as_text, set};
use crate::kind::compare::{Compare, Extent, swept_name};

/// A crossing is known to this part of its value.
const TOLERANCE: f64 = 1e-4;

/// The same of a change of verdict.
const OF_VERDICT: f64 = 1e-2;

pub struct Find {
    spec: FindSpec,
    /// The place of its key among those of the sweep.
    key: usize,
    target: Target,
}

enum Target {
    /// The quantity itself.
    Value(f64),
    /// The quantity over that of another case.
    Ratio(f64, To),
    /// Where the verdict changes.
    Verdict,
}

enum To {
    Uncoated,
    Value(Value),
}

#[derive(Debug, Clone, PartialEq)]
pub struct Crossing {
    pub key: usize,
    /// The values of the other keys; that of the key itself does not count.
    pub places: Vec<usize>,
    /// Between which values it lies, SI; equal where it is one of the values.
    pub between: [f64; 2],
    pub quantity: ComparedQuantity,
    pub model: FoundModel,
    /// What was looked for, in words.
    pub target: String,
    /// Whether that is a change of verdict.
    pub is_of_verdict: bool,
    /// Pa
    pub pressure: f64,
    pub surface: String,
    pub law: String,
    /// Limits of admissible loads that are exceeded at its lower end.
    pub limits: String,
}

impl Crossing {
    /// The value of the key: the middle, by ratio where both ends are positive.
    pub fn at(&self) -> f64 {
        middle(self.between)
    }
}

fn middle([low, high]: [f64; 2]) -> f64 {
    if low > 0.0 { (low * high).sqrt() } else { 0.5 * (low + high) }
}

/// One case of a variation at the load.
#[derive(Clone)]
struct Point {
    surface: String,
    law: String,
    value: Option<f64>,
    verdict: String,
    limits: String,
}

impl Find {
    pub fn new(spec: FindSpec, keys: &[SweptKey], combine: Combine, kind: &str) -> Result<Self, String> {
        if kind != Compare::NAME {
            return Err(format!("found [{kind}]; allowed: `find` with [compare]"));
        }
        let names = || keys.iter().map(|key| key.name.as_str()).collect::<Vec<_>>().join(", ");
        let key = keys.iter().position(|key| key.name == spec.key);
        let key = key
            .ok_or_else(|| format!("found the key {}, which is not swept; allowed: {}", spec.key, names()))?;
        if keys[key].numbers.is_none() {
            return Err(format!(
                "found the key {}, whose values are no quantities; allowed: a key of quantities",
                spec.key
            ));
        }
        if combine == Combine::Zip && keys.len() > 1 {
            return Err("found combine = \"zip\", with which all keys change together; allowed: combine = \"all\", or one key".to_owned());
        }
        let target = match (spec.verdict, spec.quantity, spec.ratio, &spec.to, spec.value) {
            (Some(_), None, None, None, None) => Target::Verdict,
            (None, Some(_), None, None, Some(value)) => Target::Value(value),
            (None, Some(_), Some(ratio), Some(to), None) if spec.model != FoundModel::Difference => {
                let to = match to.as_str() {
                    Some("uncoated") => To::Uncoated,
                    _ if keys[key].number_of(to).is_some() => To::Value(to.clone()),
                    _ => {
                        return Err(format!(
                            "found to = {to}; allowed: \"uncoated\", or a value of {}",
                            spec.key
                        ));
                    }
                };
                Target::Ratio(ratio, to)
            }
            _ => {
                return Err(
                    "found no complete question; allowed: `quantity` with `value`, `quantity` with `ratio` and `to` (of a model), or `verdict`"
                        .to_owned(),
                );
            }
        };
        Ok(Self { spec, key, target })
    }

    fn quantity(&self) -> ComparedQuantity {
        let found = self.spec.verdict.or(self.spec.quantity);
        found.map_or(ComparedQuantity::Area, ComparedQuantity::from)
    }

    /// All places where it holds, for all values of the other keys.
    pub fn run(&self, run: &Run) -> Result<Vec<Crossing>, InputError> {
        let keys = &run.plan().keys;
        let numbers = keys[self.key].numbers.as_deref().unwrap_or_default();
        let mut grid: Vec<f64> = numbers.iter().copied().filter(|number| number.is_finite()).collect();
        grid.sort_by(f64::total_cmp);
        grid.dedup();
        let mut crossings = Vec::new();
        let starts = run.plan().variations.iter().filter(|variation| variation.places[self.key] == 0);
        for places in starts.map(|variation| &variation.places) {
            let goals = self.goals(run, places)?;
            let at_grid: Vec<Vec<Point>> =
                grid.iter().map(|&number| self.points_at(run, places, number)).collect::<Result<_, _>>()?;
            let cases = at_grid.iter().map(Vec::len).max().unwrap_or(0);
            for case in 0..cases {
                let goal = match self.target {
                    Target::Value(value) => Some(value),
                    Target::Ratio(..) | Target::Verdict => goals.get(case).copied().flatten(),
                };
                // None where a variation could not be run.
                let end =
                    |k: usize| at_grid[k].get(case).map(|point| End { at: grid[k], point: point.clone() });
                for upper in 1..grid.len() {
                    let (Some(low), Some(high)) = (end(upper - 1), end(upper)) else { continue };
                    let found = self.between(run, places, case, goal, [low, high])?;
                    crossings.extend(found.map(|(ends, target)| Crossing {
                        key: self.key,
                        places: places.clone(),
                        between: ends.each_ref().map(|end| end.at),
                        limits: ends[0].point.limits.clone(),
                        quantity: self.quantity(),
                        model: self.spec.model,
                        target,
                        is_of_verdict: matches!(self.target, Target::Verdict),
                        pressure: self.spec.at.value(),
                        surface: ends[0].point.surface.clone(),
                        law: ends[0].point.law.clone(),
                    }));
                }
            }
        }
        Ok(crossings)
    }

    /// The value of the quantity that a ratio refers to times the ratio, case by case.
    fn goals(&self, run: &Run, places: &[usize]) -> Result<Vec<Option<f64>>, InputError> {
        let Target::Ratio(ratio, to) = &self.target else { return Ok(Vec::new()) };
        let points = self.points(run, places, |table| match to {
            To::Uncoated => {
                if let Some(compare) = table.get_mut(Compare::NAME).and_then(Value::as_table_mut) {
                    compare.remove("layer");
                }
                Ok(())
            }
            To::Value(value) => set(table, &self.spec.key, value.clone()),
        })?;
        Ok(points.iter().map(|point| Some(ratio * point.value?)).collect())
    }

    /// Where it holds between two values, narrowed down by bisection; with what was looked for.
    fn between(
        &self,
        run: &Run,
        places: &[usize],
        case: usize,
        goal: Option<f64>,
        mut ends: [End; 2],
    ) -> Result<Option<([End; 2], String)>, InputError> {
        let is_verdict = matches!(self.target, Target::Verdict);
        if !self.changes(&ends, goal) {
            return Ok(None);
        }
        let tolerance = if is_verdict { OF_VERDICT } else { TOLERANCE };
        while !is_narrow(ends.each_ref().map(|end| end.at), tolerance) {
            let at = middle(ends.each_ref().map(|end| end.at));
            let points = self.points_at(run, places, at)?;
            let Some(point) = points.get(case).cloned() else { return Ok(None) };
            let between = End { at, point };
            let [low, high] = ends;
            let lower = [low, between.clone()];
            ends = if self.changes(&lower, goal) { lower } else { [between, high] };
            if !self.changes(&ends, goal) {
                // A value that could not be computed lies between.
                return Ok(None);
            }
        }
        let words = match &self.target {
            Target::Verdict => {
                let [low, high] = ends.each_ref().map(|end| verdict_in_words(&end.point.verdict));
                format!("{low} to {high}").replace('-', " ")
            }
            Target::Value(value) => input_number(*value),
            Target::Ratio(ratio, To::Uncoated) => {
                format!("{} times that without the layer", input_number(*ratio))
            }
            Target::Ratio(ratio, To::Value(value)) => {
                format!("{} times that at {}", input_number(*ratio), as_text(value))
            }
        };
        Ok(Some((ends, words)))
    }

    /// Whether what is looked for lies between two values; a value that is the goal itself belongs to the stretch above it.
    fn changes(&self, ends: &[End; 2], goal: Option<f64>) -> bool {
        let [low, high] = ends;
        match goal {
            None if matches!(self.target, Target::Verdict) => low.point.verdict != high.point.verdict,
            None => false,
            Some(goal) => match (low.point.value, high.point.value) {
                (Some(low), Some(high)) => (low < goal) != (high < goal),
                _ => false,
            },
        }
    }

    /// The cases of a variation at a value of the key, at the load alone.
    fn points_at(&self, run: &Run, places: &[usize], number: f64) -> Result<Vec<Point>, InputError> {
        let key = &run.plan().keys[self.key];
        self.points(run, places, |table| set(table, &key.name, key.written(number)))
    }

    /// The cases of a variation, at the load alone.
    fn points(
        &self,
        run: &Run,
        places: &[usize],
        change: impl FnOnce(&mut Table) -> Result<(), String>,
    ) -> Result<Vec<Point>, InputError> {
        let case = run.plan().varied(run.progress(), places, |table| {
            change(table)?;
            without_what_is_not_shown(table);
            if let Some(compare) = table.get_mut(Compare::NAME).and_then(Value::as_table_mut) {
                self.at_the_load(compare);
            }
            Ok(())
        });
        // A value between two that run may not; it is no crossing.
        let Ok(case) = case else { return Ok(Vec::new()) };
        // Intervals, and what else a value does not need, are left out.
        let is_value = !matches!(self.target, Target::Verdict) && self.spec.model != FoundModel::Reference;
        let extent = if is_value && case.has_single_surfaces() { Extent::Models } else { Extent::Everything };
        let found = run.one(&case, extent)?;
        Ok(found.table(run.plan()).map_or_else(Vec::new, |table| self.read(&table)))
    }

    /// Leaves out of a comparison what the value at the load does not need.
    fn at_the_load(&self, compare: &mut Table) {
        for key in ["separation", "force", "nominal-area", "lines"] {
            compare.remove(key);
        }
        let pressure = format!("{:e} Pa", self.spec.at.value());
        compare.insert("pressure".to_owned(), Value::String(pressure));
        if self.spec.model != FoundModel::Reference {
            compare.remove("reference");
            let models = ["statistical", "deterministic"].map(|name| Value::String(name.to_owned()));
            compare.insert("models".to_owned(), Value::Array(models.to_vec()));
        }
    }

    /// The cases of a table, without those on the uncoated flat that stand beside a layer.
    fn read(&self, table: &Rows) -> Vec<Point> {
        let column = |name: &str| table.column(name).map_or(&[][..], |(_, cells)| cells);
        let text = |name: &str, row: usize| column(name).get(row).map_or("", Cell::text).to_owned();
        let value = column(&swept_name(self.quantity(), self.spec.model.name()));
        let verdict = swept_name(self.quantity(), "verdict");
        let point = |row: usize| Point {
            surface: text("surface", row),
            law: text("law", row),
            value: value.get(row).and_then(Cell::number),
            verdict: text(&verdict, row),
            limits: text("limits", row),
        };
        let thickness = |row: usize| column("layer_thickness_m").get(row).and_then(Cell::number);
        let has_layer = (0..table.rows()).any(|row| thickness(row) > Some(0.0));
        (0..table.rows()).filter(|&row| !has_layer || thickness(row) != Some(0.0)).map(point).collect()
    }
}

/// A value of the key with what was found there.
#[derive(Clone)]
struct End {
    at: f64,
    point: Point,
}

fn is_narrow([low, high]: [f64; 2], tolerance: f64) -> bool {
    high - low <= tolerance * high.abs().max(low.abs())
}

/// A verdict, or that there is none.
pub fn verdict_in_words(verdict: &str) -> &str {
    if verdict.is_empty() { "not admissible" } else { verdict }
}
