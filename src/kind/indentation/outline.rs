//! The page of a sphere on layers: load, changes of regime, accuracy of the effective-modulus models.

use asperity::ModulusModel;
use asperity::sphere::{LARGEST_SLOPE, Point};
use asperity_contact_framework::Outcome;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{count, input_quantity, number, quantity};
use asperity_contact_framework::report::page::{Page, escape};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Row, Table, Tables};

use super::figures;
use super::rows::{ChangeRow, DecreaseRow, LawRow, LayerRow, OverlayRow, RuleRow, tables};
use super::run::{IndentationResults, LawCurves, LayerResults};
use crate::layer::{rule_warning, thickness_words};

impl Outcome for IndentationResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        let of_layer = |layer: &LayerResults| {
            let name = format!("{} of {}", layer.name, thickness_words(layer.thickness));
            let slope = layer.largest_slope(self.radius);
            let large = (slope > LARGEST_SLOPE).then(|| {
                format!(
                    "layer {name}: the contact radius reaches {slope:.2} of the ball's; beyond {LARGEST_SLOPE} the ball is no \
                     paraboloid and strains are not small"
                )
            });
            rule_warning(&layer.check, &name, layer.rule).into_iter().chain(large)
        };
        self.layers.iter().flat_map(of_layer).collect()
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        let loads = self.layers.iter().flat_map(|layer| layer.laws.iter().map(|law| loads(layer, law)));
        let errors = self.layers.iter().map(error_of_rule);
        // Several layers are compared in the errors of their models.
        if self.layers.len() > 1 {
            sections::findings(&mut page, errors.chain(loads));
        } else {
            sections::findings(&mut page, loads.chain(errors));
        }
        sections::warnings(&mut page, &self.warnings());
        if self.layers.len() > 1 {
            accuracy(&mut page, self, tables);
        }
        for (k, layer) in self.layers.iter().enumerate() {
            for law in &layer.laws {
                curves(&mut page, self, k, law);
            }
        }
        if self.layers.len() == 1 {
            accuracy(&mut page, self, tables);
        }
        page.heading(2, "Loads and changes of regime");
        view::<LawRow>(&mut page, tables);
        view::<ChangeRow>(&mut page, tables);
        view::<DecreaseRow>(&mut page, tables);
        view::<OverlayRow>(&mut page, tables);
        sections::notes(&mut page, &self.metadata);
        set_up(&mut page, self);
        page.heading(2, "Limits of validity").note(include_str!("notes/limits.md"));
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }
}

/// Regime and loads at the largest indentation.
fn loads(layer: &LayerResults, law: &LawCurves) -> String {
    let [coated, uncoated, all_layer] = law.curves().map(|(_, curve)| curve.points.last());
    let load =
        |point: Option<&Point>| point.map_or_else(String::new, |point| quantity(point.contact.load, "N"));
    format!(
        "**{}, {}, law {}**: at w = {} the contact is {} and carries {} (uncoated {}, bulk layer material {}).",
        escape(&layer.label()),
        layer.rule.name(),
        escape(&law.law),
        coated.map_or_else(String::new, |point| input_quantity(point.indentation, "m")),
        coated.map_or("", |point| point.contact.regime.name()),
        load(coated),
        load(uncoated),
        load(all_layer),
    )
}

/// The largest error of the layer's effective-modulus model.
fn error_of_rule(layer: &LayerResults) -> String {
    let Some(worst) = layer.check.worst_of(layer.rule) else {
        return format!("**{}**: no contact is small enough for the exact solution.", escape(&layer.label()));
    };
    format!(
        "**{}**: without yielding, `{}` {} the load by a factor of up to {} (at a/t = {}).",
        escape(&layer.label()),
        layer.rule.name(),
        if worst.ratio > 1.0 { "overestimates" } else { "underestimates" },
        number(worst.factor()),
        number(worst.contact_ratio),
    )
}

const RULES: &str = "Elastic load by each model over the exact elastic load at equal indentation, against the exact contact radius \
                     over the layer thickness. One panel per model, one line per layer.";

/// The largest errors of both models, and those at round contact radii.
fn accuracy(page: &mut Page, results: &IndentationResults, tables: &Tables) {
    page.heading(2, "Accuracy of the effective-modulus models");
    let layers = results.distinct_layers();
    let is_solved = layers.iter().any(|layer| !layer.errors.concat().is_empty());
    if is_solved {
        page.figure("rules.svg", figures::rules(&layers), RULES);
    }
    page.view(&tables.view::<LayerRow>().without(&["gao_indentation_ratio", "series_indentation_ratio"]));
    if !is_solved {
        return;
    }
    page.details(3, "Errors against a/t", |page| {
        page.note(include_str!("notes/accuracy.md"));
        for layer in layers {
            for model in ModulusModel::ALL {
                page.heading(4, &format!("{}, model {}", layer.label(), model.name()));
                let view = tables.view::<RuleRow>().only("layer", layer.name.as_str());
                let view = view.only("layer_thickness_m", layer.thickness).only("rule", model.name());
                page.view(
                    &view.without(&["indentation_m"]).each_decade("contact_radius_over_thickness", 3.0),
                );
            }
        }
    });
}

/// A table without the columns of the layer and the law where there is only one.
fn view<R: Row>(page: &mut Page, tables: &Tables) {
    let view = tables.view::<R>().without_constant(&["layer", "layer_thickness_m", "rule", "law"]);
    page.view(&view);
}

/// The figures of layer `k` under a law.
fn curves(page: &mut Page, results: &IndentationResults, k: usize, law: &LawCurves) {
    let layer = &results.layers[k];
    page.heading(2, &format!("{}, {}, law {}", layer.label(), layer.rule.name(), law.law));
    let file = |what: &str| {
        let name = format!("{}-{}-{}-{what}", k + 1, layer.name, law.law);
        let plain = |c: char| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
        name.chars().map(plain).collect::<String>() + ".svg"
    };
    page.figure(
        &file("load"),
        figures::load(results, layer, law),
        "Load and indentation: coated (coloured by regime), uncoated, bulk layer material, and the exact elastic solution \
         for ball, layer and substrate. Left: logarithmic axes; right: linear axes.",
    );
    page.figure(
        &file("ratios"),
        figures::ratios(results, layer, law),
        "The same curves normalised by Hertz without a layer: load over (4/3) E* R^½ w^(3/2) with E* of the uncoated pair, \
         and real contact area over π R w.",
    );
}

fn set_up(page: &mut Page, results: &IndentationResults) {
    let IndentationResults { metadata, materials, ball, radius, flat, indentations, layers, .. } = results;
    page.heading(2, "Set-up");
    sections::materials(page, metadata, materials, |name| {
        let is_layer = layers.iter().any(|layer| layer.name == name);
        let roles = [("ball", name == ball), ("flat", name == flat), ("layer", is_layer)];
        let roles: Vec<&str> = roles.into_iter().filter(|role| role.1).map(|role| role.0).collect();
        if roles.is_empty() { "not used".to_owned() } else { roles.join(", ") }
    });
    page.paragraph(&format!(
        "Ball of radius {} on a flat of {}; {} indentations from {} to {}. {}",
        input_quantity(*radius, "m"),
        escape(flat),
        count(indentations.len()),
        input_quantity(indentations[0], "m"),
        input_quantity(indentations[indentations.len() - 1], "m"),
        sections::provenance(metadata),
    ));
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::compare::{ModulusError, ModulusFindings};
    use asperity::sphere::Curve;
    use asperity::{Contact, Regime};

    fn layer(worst: Option<f64>) -> LayerResults {
        let error = |ratio| ModulusError { contact_ratio: 0.71, indentation_ratio: 0.5, ratio };
        let check = ModulusFindings {
            modulus_ratio: 0.1,
            range: [0.1, 10.0],
            reported: Default::default(),
            worst: [worst.map(error), None],
        };
        let curve = |load| {
            let contact = Contact { area: 1e-12, load, stiffness: 1.0, regime: Regime::Plastic };
            let points = vec![Point { indentation: 4e-7, contact }];
            Curve { points, trace: Vec::new(), changes: Vec::new(), decreases: Vec::new() }
        };
        let law = LawCurves {
            law: "zmc".to_owned(),
            coated: curve(2.0),
            uncoated: curve(3.0),
            all_layer: curve(0.25),
            at_overlay: Vec::new(),
        };
        LayerResults {
            name: "lead".to_owned(),
            thickness: 1e-6,
            rule: ModulusModel::Gao,
            laws: vec![law],
            exact: Vec::new(),
            check,
            errors: Default::default(),
        }
    }

    #[test]
    fn the_loads_are_those_at_the_largest_indentation() {
        let layer = layer(None);
        assert_eq!(
            loads(&layer, &layer.laws[0]),
            "**lead 1 µm, gao, law zmc**: at w = 400 nm the contact is plastic and carries 2 N (uncoated 3 N, bulk layer material 250 mN)."
        );
    }

    #[test]
    fn the_error_of_the_rule_has_a_direction_and_is_unknown_without_an_exact_contact() {
        let error = |worst| error_of_rule(&layer(worst));
        assert_eq!(
            error(Some(0.5)),
            "**lead 1 µm**: without yielding, `gao` underestimates the load by a factor of up to 2 (at a/t = 0.71)."
        );
        assert!(error(Some(2.0)).contains("`gao` overestimates the load by a factor of up to 2"));
        assert!(error(None).ends_with("no contact is small enough for the exact solution."));
    }
}
