//! The answers by thickness: figures and tables.

use super::{Series, depth, figures};
use asperity::compare::Kind;
use asperity::{INTERACTION, Response};
use asperity_framework::report::format::{number, quantity, thickness};
use asperity_framework::report::page::Page;

impl Series<'_> {
    /// The pictures and tables.
    pub fn answers(&self, page: &mut Page) {
        page.heading(2, &format!("{}: the answers", self.subject));
        page.figure(
            &format!("{}-layers.svg", self.stem),
            figures::by_load(self),
            &format!(
                "Separation and real area against load, by thickness of the layer. {}",
                self.lines_are()
            ),
        );
        let loads = &self.findings.loads;
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
                figures::by_thickness(self),
                &format!(
                    "Real area, mean real pressure and plastic share of the load against thickness, by nominal pressure. {} At the edges: no \
                     layer (left), all layer (right).",
                    self.lines_are()
                ),
            );
            page.figure(
                &format!("{}-regimes.svg", self.stem),
                figures::regimes(self),
                &format!(
                    "How the load is shared by the regimes, by thickness, at the least, a middle and the highest load ({}).",
                    self.findings.main_model().name()
                ),
            );
        }
        self.threshold_table(page);
        self.load_table(page);
    }

    /// All thicknesses at all loads.
    fn load_table(&self, page: &mut Page) {
        let (loads, kinds) = (&self.findings.loads, &self.findings.models);
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
                let radius = response(self.findings.main_model()).and_then(Response::mean_contact_radius);
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

    /// Thicknesses below which the layer no longer matters.
    fn threshold_table(&self, page: &mut Page) {
        page.paragraph(
            "The thickness below which the layer no longer matters: the real area at the same load is within 5 % of the one without a \
             layer. Sought to 1 % between the thinnest listed one that matters and the one before it, and beyond the list where none does.",
        );
        let loads = &self.findings.loads;
        let kinds = &self.findings.models;
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

    /// What the lines of a picture are.
    fn lines_are(&self) -> &'static str {
        match self.findings.models[..] {
            [Kind::Statistical] => "Lines: the statistical integral.",
            [Kind::Deterministic] => "Lines: the deterministic sum.",
            _ => "Solid: the deterministic sum, as in the paper's Fig. 6; dashed: the statistical integral.",
        }
    }
}

fn shares(response: &Response) -> String {
    let whole = |share: f64| format!("{:.0} %", 100.0 * share);
    response.pressure.shares().map_or_else(|| "–".to_owned(), |shares| shares.map(whole).join(" / "))
}
