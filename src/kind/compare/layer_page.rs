//! A comparison under a layer in several thicknesses: Fig. 6 of Pasaribu and Schipper (2005), and thickness as an axis.

use super::figures::{curve, shares_of_load};
use super::page::{CONDITION, is_significant, laws, stem, subject, verdict};
use crate::kind::compare::results::{CaseResults, CompareResults, SurfaceResults, Threshold};
use asperity::compare::{GOOD_RATIO, Gap, Kind};
use asperity::contact::Regime;
use asperity::model::{INTERACTION, Response};
use asperity_framework::contact::LayerMetadata;
use asperity_framework::report::format::{listed, number, percent, quantity, thickness};
use asperity_framework::report::page::{Page, escape};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

/// One surface under one law: a case for each thickness.
pub struct Series<'a> {
    layer: &'a LayerMetadata,
    found: &'a SurfaceResults,
    subject: String,
    stem: String,
    cases: Vec<&'a CaseResults>,
    thresholds: Vec<&'a Threshold>,
    modulus: f64,
}

/// "under 50 nm of lead".
pub fn under(layer: &LayerMetadata, t: f64) -> String {
    let name = escape(&layer.name);
    match t {
        0.0 => "without a layer".to_owned(),
        f64::INFINITY => format!("on nothing but {name}"),
        t => format!("under {} of {name}", quantity(t, "m")),
    }
}

/// How good the rules are, beside the exact solution; nothing where no contact asks for one.
pub fn rule_section(page: &mut Page, layer: &LayerMetadata) {
    let Some(check) = &layer.check else { return };
    page.heading(2, "How good is the rule?");
    let place = if check.is_good() { "within" } else { "outside" };
    page.paragraph(&format!(
        "E of the layer is {} of that of the substrate, {place} the {} to {} where the paper's rule (`gao`) is good (Perriot and Barthel 2004). \
         This is the elastic load by both rules over that of the exact solution at equal indentation, a the exact contact radius; this \
         experiment uses `{}`. The tables below say which a/t its contacts have. The ball of the exact solution is as elastic as the rough \
         body. Where a contact is plastic the modulus does not enter its load.",
        number(check.modulus_ratio),
        GOOD_RATIO[0],
        GOOD_RATIO[1],
        layer.rule.name(),
    ));
    let [gao, series] = &check.told;
    page.table(
        ["a/t", "load by rule gao / exact", "load by rule series / exact"],
        gao.iter().zip(series).map(|(gao, series)| {
            vec![number(gao.contact_ratio), format!("{:.3}", gao.ratio), format!("{:.3}", series.ratio)]
        }),
    );
}

/// Every surface under every law; nothing without a layer.
pub fn all(results: &CompareResults) -> Vec<Series<'_>> {
    let Some(layer) = &results.contact.layer else { return Vec::new() };
    let series = |found, law: &str| Series {
        layer,
        found,
        subject: subject(results, found, law),
        stem: stem(found, law),
        cases: found.first.cases.iter().filter(|case| case.law == law).collect(),
        thresholds: found.thresholds.iter().filter(|threshold| threshold.law == law).collect(),
        modulus: results.contact.reduced_modulus,
    };
    let of = |found| laws(found).into_iter().map(move |law| series(found, law));
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
        lines.extend(self.plastic_finding());
        if self.has_several() {
            lines.extend(self.gap_finding());
        }
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

    /// How the plastic share of the load changes with the thickness, at the highest load.
    fn plastic_finding(&self) -> Option<String> {
        let load = *self.loads().last()?;
        let kind = self.foremost();
        let share = |case: &&&CaseResults| {
            let response = &case.comparison.at_load(kind, load)?.response;
            Some((case.thickness?, response.pressure.shares()?[Regime::Plastic as usize]))
        };
        let all: Vec<(f64, f64)> = self.cases.iter().filter_map(|case| share(&case)).collect();
        let most = all.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let least = all.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
        (self.has_several() && most.1 > 0.0).then(|| {
            format!(
                "**{}**: the plastic share of the load at {} ({}) is largest {}, {}, and smallest {}, {}.",
                escape(&self.subject),
                quantity(load, "Pa"),
                kind.name(),
                under(self.layer, most.0),
                percent(most.1),
                under(self.layer, least.0),
                percent(least.1),
            )
        })
    }

    /// The model that is drawn solid: the sum, or the integral where it stands alone.
    fn foremost(&self) -> Kind {
        if self.kinds().contains(&Kind::Deterministic) { Kind::Deterministic } else { Kind::Statistical }
    }

    /// What the lines of a picture are.
    fn lines_are(&self) -> &'static str {
        match self.kinds()[..] {
            [Kind::Statistical] => "Lines: the statistical integral.",
            [Kind::Deterministic] => "Lines: the deterministic sum.",
            _ => "Solid: the deterministic sum, as in the paper's Fig. 6; dashed: the statistical integral.",
        }
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
        let least = if size(most) > size(least) {
            format!(
                ", and by up to {} σ {}, where they differ least",
                number(size(least)),
                under(self.layer, least.0)
            )
        } else {
            String::new()
        };
        let gaps = self.cases.iter().flat_map(|case| &case.gaps.largest);
        vec![
            format!(
                "**{subject}**: the two models' separations at equal load differ by up to {} σ {}, where they differ most{least}. {CONDITION}",
                number(size(most)),
                under(self.layer, most.0),
            ),
            format!("**{subject}, which to trust**: {}", verdict(self.found, is_significant(gaps))),
        ]
    }

    /// The pictures and tables.
    pub fn answers(&self, page: &mut Page) {
        page.heading(2, &format!("{}: the answers", self.subject));
        page.figure(
            &format!("{}-layers.svg", self.stem),
            self.figure_6(),
            &format!(
                "Separation and real area against load, by thickness of the layer. {}",
                self.lines_are()
            ),
        );
        let loads = self.loads();
        if !self.found.others.is_empty() {
            page.paragraph("Pictures, tables and findings by thickness are of the first realisation; the others are in `curves.csv`.");
        }
        if loads.is_empty() {
            page.paragraph(
                "No pressure or force is asked for: nothing can be said at equal load, by thickness. With `pressure = ...` this report has the \
                 real area, the mean real pressure and the regimes against the thickness.",
            );
            return;
        }
        if self.finite().count() > 1 {
            page.figure(
                &format!("{}-thickness.svg", self.stem),
                self.by_thickness(),
                &format!(
                    "Real area, mean real pressure and plastic share of the load against thickness, by nominal pressure. {} At the edges: no \
                     layer (left), all layer (right).",
                    self.lines_are()
                ),
            );
            page.figure(
                &format!("{}-regimes.svg", self.stem),
                self.regimes(),
                &format!(
                    "How the load is shared by the regimes, by thickness, at the least, a middle and the highest load ({}).",
                    self.foremost().name()
                ),
            );
        }
        self.threshold_table(page);
        page.paragraph(
            "All thicknesses at these loads; a/t is that of the mean contact, shares are those of the load, elastic / elastic-plastic / plastic:",
        );
        type Column = (&'static str, fn(&Response) -> String);
        let columns: [Column; 4] = [
            ("d/σ", |r| number(r.separation_over_sigma)),
            ("A/A_nom", |r| {
                let mark = if r.is_beyond_model() { " *" } else { "" };
                format!("{}{mark}", number(r.area_ratio.total()))
            }),
            ("mean real p", |r| r.mean_real_pressure().map_or_else(|| "–".to_owned(), |p| quantity(p, "Pa"))),
            ("shares", shares),
        ];
        let kinds = self.kinds();
        let short = |kind: Kind| if kind == Kind::Statistical { "stat." } else { "det." };
        let mut header = vec!["p".to_owned(), "layer".to_owned(), "a/t".to_owned()];
        for (name, _) in columns {
            header.extend(kinds.iter().map(|&kind| format!("{name} {}", short(kind))));
        }
        let rows = loads.iter().flat_map(|&load| self.cases.iter().map(move |case| (load, case)));
        page.table(
            header,
            rows.map(|(load, case)| {
                let response = |kind| case.comparison.at_load(kind, load).map(|point| &point.response);
                let t = case.thickness.unwrap_or(0.0);
                let radius = response(self.foremost()).and_then(mean_contact_radius);
                let ratio = radius.filter(|_| t > 0.0 && t.is_finite()).map(|a| number(a / t));
                let mut row =
                    vec![quantity(load, "Pa"), thickness(t), ratio.unwrap_or_else(|| "–".to_owned())];
                for (_, value) in columns {
                    row.extend(
                        kinds.iter().map(|&kind| response(kind).map_or_else(|| "–".to_owned(), value)),
                    );
                }
                row
            }),
        );
        page.paragraph(&format!("\\* beyond A/A_nom = {INTERACTION}, where asperities interact."));
    }

    fn threshold_table(&self, page: &mut Page) {
        page.paragraph(
            "The thickness below which the layer no longer matters: the real area at the same load is within 5 % of the one without a \
             layer. Sought to 1 % between the thinnest listed one that matters and the one before it, and beyond the list where none does.",
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
                let is_foremost = kind == self.foremost();
                let line: Vec<(f64, f64)> = line.collect();
                let places = Layer::points(line.clone(), Marker::Circle).coloured(colour);
                let is_limit =
                    |case: &&&CaseResults| case.thickness.is_some_and(|t| t == 0.0 || t == f64::INFINITY);
                let limits = self.cases.iter().filter(is_limit);
                let limits = limits.filter_map(|case| Some((place(case.thickness?), found(case)?)));
                let marker = if is_foremost { Marker::Square } else { Marker::Triangle };
                let limits = Layer::points(limits.collect::<Vec<_>>(), marker).coloured(colour);
                let line = Layer::line(line).coloured(colour);
                plot = plot.with(limits).with(if is_foremost {
                    line.named(quantity(load, "Pa"))
                } else {
                    line.dashed(Dash::Dashed)
                });
                if is_foremost {
                    plot = plot.with(places);
                }
            }
        }
        plot
    }

    fn regimes(&self) -> String {
        /// Panels beside each other.
        const PANELS: usize = 3;
        let kind = self.foremost();
        let loads = self.loads();
        let chosen = match loads.len() {
            0..=PANELS => loads,
            count => vec![loads[0], loads[count / 2], loads[count - 1]],
        };
        let panel = |load: f64| {
            let shares = self.finite().filter_map(|(t, case)| {
                Some((nanometres(t), case.comparison.at_load(kind, load)?.response.pressure.shares()?))
            });
            shares_of_load(&quantity(load, "Pa"), thickness_axis(), shares)
        };
        Figure::row("Regimes by thickness", chosen.into_iter().map(panel).collect()).svg()
    }
}

/// Radius of a contact of the mean area, m; `None` where nothing touches.
fn mean_contact_radius(response: &Response) -> Option<f64> {
    let area = response.area_ratio.total() / response.contact_density;
    area.is_finite().then(|| (area / std::f64::consts::PI).sqrt())
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
        Some(f64::INFINITY) => "none up to 1 m matters".to_owned(),
        // It is known to 1 %.
        Some(t) => quantity(format!("{t:.1e}").parse().unwrap_or(t), "m"),
    }
}
