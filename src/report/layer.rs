//! A comparison under a layer in several thicknesses: Fig. 6 of Pasaribu and Schipper (2005), and thickness as an axis.

use super::compare::{CONDITION, is_significant, verdict};
use super::figures::curve;
use super::format::{number, percent, quantity};
use super::page::{Page, escape};
use super::plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};
use crate::compare::{CurvePoint, GOOD_RATIO, Gap, Kind};
use crate::contact::Regime;
use crate::experiment::results::{CaseResults, CompareResults, LayerHead, SurfaceResults, Threshold};
use crate::interface::Fall;
use crate::model::{INTERACTION, Response};

/// One surface under one law: a case for each thickness.
pub struct Series<'a> {
    layer: &'a LayerHead,
    found: &'a SurfaceResults,
    subject: String,
    stem: String,
    cases: Vec<&'a CaseResults>,
    thresholds: Vec<&'a Threshold>,
    modulus: f64,
}

/// How a thickness is named.
pub fn thickness(value: f64) -> String {
    match value {
        0.0 => "no layer".to_owned(),
        f64::INFINITY => "all layer".to_owned(),
        value => quantity(value, "m"),
    }
}

/// A list as a sentence has it.
fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [others @ .., last] => format!("{} and {last}", others.join(", ")),
    }
}

/// How good the rules are, beside the exact solution.
pub fn rule_section(page: &mut Page, layer: &LayerHead) {
    let Some(check) = &layer.check else { return };
    page.heading(2, "How good is the rule?");
    let verdict = if check.is_good() {
        format!("within the {} to {} where the paper's rule is good", GOOD_RATIO[0], GOOD_RATIO[1])
    } else {
        format!("outside the {} to {} where the paper's rule is good", GOOD_RATIO[0], GOOD_RATIO[1])
    };
    page.paragraph(&format!(
        "E of the layer is {} of that of the substrate, {verdict} (Perriot and Barthel 2004). This is the elastic load by both rules over \
         that of the exact solution at equal indentation, a the exact contact radius; this experiment uses `{}`. Where contacts \
         are plastic the modulus does not enter the load, and the error is smaller.",
        number(check.modulus_ratio),
        layer.rule.name(),
    ));
    page.table(
        ["a/t", "load by rule gao / exact", "load by rule series / exact"],
        check
            .rows
            .iter()
            .map(|[gao, series]| vec![number(gao.contact_ratio), number(gao.ratio), number(series.ratio)]),
    );
}

/// Every surface under every law; nothing without a layer.
pub fn all(results: &CompareResults) -> Vec<Series<'_>> {
    let Some(layer) = &results.contact.layer else { return Vec::new() };
    let series = |found, law: &str| Series {
        layer,
        found,
        subject: super::compare::subject(results, found, law),
        stem: super::compare::stem(found, law),
        cases: found.first.cases.iter().filter(|case| case.law == law).collect(),
        thresholds: found.thresholds.iter().filter(|threshold| threshold.law == law).collect(),
        modulus: results.contact.reduced_modulus,
    };
    let of = |found| super::compare::laws(found).into_iter().map(move |law| series(found, law));
    results.surfaces.iter().flat_map(of).collect()
}

impl<'a> Series<'a> {
    /// The surface that it is about.
    pub fn found(&self) -> &'a SurfaceResults {
        self.found
    }

    /// Whether there is more than one thickness to compare.
    pub fn has_several(&self) -> bool {
        self.cases.len() > 1
    }

    /// The findings, a line each.
    pub fn in_short(&self) -> Vec<String> {
        let mut lines = Vec::new();
        lines.extend(self.threshold_finding());
        if self.has_several() {
            lines.extend(self.gap_finding());
        }
        lines.extend(self.fall_finding("area", |case| case.falls.area, ""));
        lines.extend(self.fall_finding(
            "load",
            |case| case.falls.load,
            " A pressure may then be reached more than once on approach; the answers are the first.",
        ));
        lines
    }

    /// Loads that the thresholds were sought at, Pa, ascending.
    fn loads(&self) -> Vec<f64> {
        let mut loads: Vec<f64> = self.thresholds.iter().map(|threshold| threshold.pressure).collect();
        loads.sort_unstable_by(f64::total_cmp);
        loads.dedup();
        loads
    }

    fn kinds(&self) -> Vec<Kind> {
        let has = |kind: &Kind| {
            self.cases.iter().any(|case| case.comparison.curves.iter().any(|p| p.kind == *kind))
        };
        [Kind::Statistical, Kind::Deterministic].into_iter().filter(has).collect()
    }

    fn threshold_finding(&self) -> Option<String> {
        let at_load = |load: f64| {
            let each = self.thresholds.iter().filter(|threshold| threshold.pressure == load);
            let each: Vec<String> = each
                .map(|threshold| format!("{} ({})", depth(threshold.thickness), threshold.kind.name()))
                .collect();
            format!("at {} {}", quantity(load, "Pa"), each.join(" or "))
        };
        let parts: Vec<String> = self.loads().into_iter().map(at_load).collect();
        (!parts.is_empty()).then(|| {
            format!(
                "**{}**: the thickness of {} below which it no longer matters, the real area within 5 % of that without a layer, is {}.",
                escape(&self.subject),
                escape(&self.layer.name),
                listed(&parts)
            )
        })
    }

    /// Where the models are furthest apart, over all thicknesses, and which to trust.
    fn gap_finding(&self) -> Vec<String> {
        let separation = |case: &&CaseResults| {
            case.gaps.largest.iter().find(|gap| gap.quantity == "separation_over_sigma").copied()
        };
        let all: Vec<(f64, Gap)> =
            self.cases.iter().filter_map(|case| Some((case.thickness?, separation(case)?))).collect();
        let size = |(_, gap): &(f64, Gap)| gap.difference().abs();
        let most = all.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
        let least = all.iter().min_by(|a, b| size(a).total_cmp(&size(b)));
        let (Some(most), Some(least)) = (most, least) else { return Vec::new() };
        let subject = escape(&self.subject);
        let gaps = self.cases.iter().flat_map(|case| &case.gaps.largest);
        vec![
            format!(
                "**{subject}**: the two models' separations at equal load differ by up to {} σ {}, where they differ most, and by up \
                 to {} σ {}, where they differ least. {CONDITION}",
                number(size(most)),
                self.under(most.0),
                number(size(least)),
                self.under(least.0),
            ),
            format!("**{subject}, which to trust**: {}", verdict(self.found, is_significant(gaps))),
        ]
    }

    /// "under 50 nm of lead".
    fn under(&self, t: f64) -> String {
        let name = escape(&self.layer.name);
        match t {
            0.0 => "without a layer".to_owned(),
            f64::INFINITY => format!("on nothing but {name}"),
            t => format!("under {} of {name}", quantity(t, "m")),
        }
    }

    fn fall_finding(
        &self,
        what: &str,
        of: fn(&CaseResults) -> Option<Fall>,
        consequence: &str,
    ) -> Option<String> {
        let falling: Vec<(f64, Fall)> =
            self.cases.iter().filter_map(|case| Some((case.thickness?, of(case)?))).collect();
        let worst = falling.iter().max_by(|a, b| a.1.loss.total_cmp(&b.1.loss))?;
        let names: Vec<String> = falling.iter().map(|(t, _)| thickness(*t)).collect();
        Some(format!(
            "**{}**: the {what} of an asperity of mean radius falls somewhere as it is pressed deeper, with {} of {}; by up to {} ({}, between {} and {}).{consequence}",
            escape(&self.subject),
            escape(&self.layer.name),
            listed(&names),
            percent(worst.1.loss),
            self.under(worst.0),
            quantity(worst.1.from, "m"),
            quantity(worst.1.to, "m"),
        ))
    }

    /// The pictures and tables.
    pub fn answers(&self, page: &mut Page) {
        page.heading(2, &format!("{}: the answers", self.subject));
        page.figure(
            &format!("{}-layers.svg", self.stem),
            self.figure_6(),
            "Separation and real area against load, by thickness of the layer. Solid: the deterministic sum, as in the paper's Fig. 6; dashed: the statistical integral.",
        );
        let loads = self.loads();
        if loads.is_empty() {
            return;
        }
        if self.finite().count() > 1 {
            page.figure(
                &format!("{}-thickness.svg", self.stem),
                self.by_thickness(),
                "Real area, mean real pressure and plastic share of the load against thickness, by nominal pressure. Solid: deterministic; dashed: statistical. Squares at the edges: no layer (left), all layer (right).",
            );
            page.figure(
                &format!("{}-regimes.svg", self.stem),
                self.regimes(),
                "How the load is shared by the regimes, by thickness (deterministic, or statistical where that was not asked for).",
            );
        }
        self.threshold_table(page);
        page.paragraph("All thicknesses at these loads; shares are those of the load, elastic / elastic-plastic / plastic:");
        let rows = loads.iter().flat_map(|&load| self.cases.iter().map(move |case| (load, case)));
        page.table(
            [
                "p",
                "layer",
                "d/σ stat.",
                "d/σ det.",
                "A/A_nom stat.",
                "A/A_nom det.",
                "mean real p stat.",
                "mean real p det.",
                "shares stat.",
                "shares det.",
            ],
            rows.map(|(load, case)| {
                let [s, d] =
                    [Kind::Statistical, Kind::Deterministic].map(|kind| case.comparison.at_load(kind, load));
                let text = |point: Option<&CurvePoint>, value: fn(&Response) -> String| {
                    point.map_or_else(|| "–".to_owned(), |point| value(&point.response))
                };
                let pair = |value: fn(&Response) -> String| [text(s, value), text(d, value)];
                let mut row = vec![quantity(load, "Pa"), thickness(case.thickness.unwrap_or(0.0))];
                row.extend(pair(|r| number(r.separation_over_sigma)));
                row.extend(pair(|r| {
                    let mark = if r.is_beyond_model() { " *" } else { "" };
                    format!("{}{mark}", number(r.area_ratio.total()))
                }));
                row.extend(pair(|r| {
                    r.mean_real_pressure().map_or_else(|| "–".to_owned(), |p| quantity(p, "Pa"))
                }));
                row.extend(pair(shares));
                row
            }),
        );
        page.paragraph(&format!("\\* beyond A/A_nom = {INTERACTION}, where asperities interact."));
    }

    fn threshold_table(&self, page: &mut Page) {
        page.paragraph(
            "The thickness below which the layer no longer matters: the real area at the same load is within 5 % of the one without a \
             layer. Sought between the listed thicknesses, to 1 %.",
        );
        let loads = self.loads();
        let kinds = self.kinds();
        let header = std::iter::once("p").chain(kinds.iter().map(|kind| kind.name()));
        page.table(
            header.collect::<Vec<_>>(),
            loads.iter().map(|&load| {
                let of = |kind: &Kind| {
                    let found = self.thresholds.iter().find(|t| t.pressure == load && t.kind == *kind);
                    found.map_or_else(|| "–".to_owned(), |threshold| depth(threshold.thickness))
                };
                std::iter::once(quantity(load, "Pa")).chain(kinds.iter().map(of)).collect::<Vec<_>>()
            }),
        );
    }

    /// Cases with a layer of finite thickness.
    fn finite(&self) -> impl Iterator<Item = (f64, &'a CaseResults)> {
        let finite =
            |case: &&'a CaseResults| case.thickness.filter(|t| *t > 0.0 && t.is_finite()).map(|t| (t, *case));
        self.cases.iter().filter_map(finite)
    }

    fn figure_6(&self) -> String {
        let modulus = self.modulus;
        let axis = || Axis::log("load ratio P/(A_nom E* without layer)");
        let mut separation = Plot::new("Separation", axis(), Axis::linear("separation d/σ"));
        let mut area = Plot::new("Real contact area", axis(), Axis::log("area ratio A/A_nom"))
            .with(Layer::region_y(INTERACTION, f64::INFINITY, "asperities interact"));
        for (index, case) in self.cases.iter().enumerate() {
            let colour = Colour::Ordered { index, of: self.cases.len() };
            let kinds = self.kinds();
            for &kind in &kinds {
                let points = curve(&case.comparison, kind);
                let line = |value: fn(&Response) -> f64| {
                    let points =
                        points.iter().map(|p| (p.response.pressure.total() / modulus, value(&p.response)));
                    let line = Layer::line(points.collect::<Vec<_>>()).coloured(colour);
                    if kind == Kind::Statistical && kinds.len() > 1 {
                        line.dashed(Dash::Dashed)
                    } else {
                        line.named(thickness(case.thickness.unwrap_or(0.0)))
                    }
                };
                separation = separation.with(line(|r| r.separation_over_sigma));
                area = area.with(line(|r| r.area_ratio.total()));
            }
        }
        Figure::row("Separation and real area by thickness", vec![separation, area]).svg()
    }

    fn by_thickness(&self) -> String {
        type Value = fn(&Response) -> Option<f64>;
        let panels: [(&str, Axis, Value); 3] = [
            ("Real contact area", Axis::log("area ratio A/A_nom"), |r| Some(r.area_ratio.total())),
            ("Mean real pressure", Axis::log("mean real pressure (GPa)"), |r| {
                r.mean_real_pressure().map(|p| p * 1e-9)
            }),
            ("Plastic share", Axis::linear("plastic share of the load").range(0.0, 1.0), |r| {
                r.pressure.shares().map(|shares| shares[Regime::Plastic as usize])
            }),
        ];
        let plots = panels.map(|(title, axis, value)| self.against_thickness(title, axis, value));
        Figure::column("Real area, mean real pressure and plastic share against thickness", plots.to_vec())
            .svg()
    }

    fn against_thickness(&self, title: &str, axis: Axis, value: fn(&Response) -> Option<f64>) -> Plot {
        /// Room beside the finite thicknesses for the two limits, as a ratio.
        const ROOM: f64 = 1.6;
        let all: Vec<f64> = self.finite().map(|(t, _)| t).collect();
        let (thin, thick) = (all[0], all[all.len() - 1]);
        let place = |t: f64| nanometres(t.clamp(thin / ROOM, thick * ROOM));
        let x = thickness_axis().range(nanometres(thin / ROOM / 1.1), nanometres(thick * ROOM * 1.1));
        let mut plot = Plot::new(title, x, axis).height(230.0);
        let loads = self.loads();
        for (index, &load) in loads.iter().enumerate() {
            let colour = Colour::Ordered { index, of: loads.len() };
            for kind in self.kinds() {
                let found = |case: &CaseResults| {
                    case.comparison.at_load(kind, load).and_then(|point| value(&point.response))
                };
                let line = self.finite().filter_map(|(t, case)| Some((nanometres(t), found(case)?)));
                let dash = if kind == Kind::Statistical { Dash::Dashed } else { Dash::Solid };
                let mut line = Layer::line(line.collect::<Vec<_>>()).coloured(colour).dashed(dash);
                if kind == Kind::Deterministic || self.kinds().len() == 1 {
                    line = line.named(quantity(load, "Pa"));
                }
                let is_limit =
                    |case: &&&CaseResults| case.thickness.is_some_and(|t| t == 0.0 || t == f64::INFINITY);
                let limits = self.cases.iter().filter(is_limit);
                let limits = limits.filter_map(|case| Some((place(case.thickness?), found(case)?)));
                let limits = Layer::points(limits.collect::<Vec<_>>(), Marker::Square).coloured(colour);
                plot = plot.with(line);
                if kind == Kind::Deterministic || self.kinds().len() == 1 {
                    plot = plot.with(limits);
                }
            }
        }
        plot
    }

    fn regimes(&self) -> String {
        /// Panels beside each other.
        const PANELS: usize = 3;
        let kind =
            if self.kinds().contains(&Kind::Deterministic) { Kind::Deterministic } else { Kind::Statistical };
        let loads = self.loads();
        let chosen = match loads.len() {
            0..=PANELS => loads,
            count => vec![loads[0], loads[count / 2], loads[count - 1]],
        };
        let panel = |load: f64| {
            let shares: Vec<(f64, [f64; 3])> = self
                .finite()
                .filter_map(|(t, case)| {
                    Some((t, case.comparison.at_load(kind, load)?.response.pressure.shares()?))
                })
                .collect();
            let thicknesses: Vec<f64> = shares.iter().map(|(t, _)| nanometres(*t)).collect();
            let share = |regime: Regime| shares.iter().map(|(_, s)| s[regime as usize]).collect::<Vec<f64>>();
            let [elastic, middle, plastic] = Regime::ALL.map(share);
            Plot::new(
                quantity(load, "Pa"),
                thickness_axis(),
                Axis::linear("share of the load").range(0.0, 1.0),
            )
            .with_stacked(
                &thicknesses,
                [
                    ("elastic", Colour::Elastic, &elastic[..]),
                    ("elastic-plastic", Colour::ElasticPlastic, &middle[..]),
                    ("plastic", Colour::Plastic, &plastic[..]),
                ],
            )
        };
        Figure::row("Regimes by thickness", chosen.into_iter().map(panel).collect()).svg()
    }
}

fn thickness_axis() -> Axis {
    Axis::log("thickness of the layer (nm)")
}

fn nanometres(t: f64) -> f64 {
    t * 1e9
}

fn shares(response: &Response) -> String {
    let whole = |share: f64| format!("{:.0} %", 100.0 * share);
    response.pressure.shares().map_or_else(|| "–".to_owned(), |shares| shares.map(whole).join(" / "))
}

/// A threshold in words.
fn depth(thickness: Option<f64>) -> String {
    match thickness {
        None => "less than 1 pm".to_owned(),
        Some(f64::INFINITY) => "any thickness".to_owned(),
        // It is known to 1 %.
        Some(t) => quantity(format!("{t:.1e}").parse().unwrap_or(t), "m"),
    }
}
