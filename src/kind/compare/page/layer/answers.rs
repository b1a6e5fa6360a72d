//! Results by thickness: figures and tables.

use super::super::single_load::is_single;
use super::{Series, depth, figures, is_valid_at};
use asperity::Response;
use asperity::compare::Kind;
use asperity_framework::report::format::{input_quantity, number, quantity, thickness};
use asperity_framework::report::page::Page;

impl Series<'_> {
    /// The figures and tables.
    pub fn answers(&self, page: &mut Page) {
        let is_single = self.cases.iter().all(|case| is_single(case));
        if self.findings.models.is_empty() && is_single {
            return;
        }
        page.details(2, &format!("{}: curves and tables by thickness", self.subject), |page| {
            self.write(page, is_single)
        });
    }

    fn write(&self, page: &mut Page, is_single: bool) {
        // A figure of one load shows less than the tables.
        if !is_single {
            page.figure(
                &format!("{}-layers.svg", self.stem),
                figures::by_load(self),
                &format!(
                    "Separation and real contact area against load, by layer thickness. {}{} Thin: beyond the valid range.",
                    self.lines_are(),
                    self.reference_is()
                ),
            );
        }
        let loads = &self.findings.loads;
        if !self.found.others.is_empty() {
            page.paragraph("Figures, tables and conclusions by thickness are for the first realisation; the others are in `curves.csv`.");
        }
        if self.findings.models.is_empty() {
            return;
        }
        if loads.is_empty() {
            page.paragraph(
                "The spec gives no pressure or force, so that thicknesses cannot be compared at equal load. Add `pressure \
                 = ...` to obtain real contact area, mean contact pressure and regimes against thickness.",
            );
            return;
        }
        if self.finite().count() > 1 {
            page.figure(
                &format!("{}-thickness.svg", self.stem),
                figures::by_thickness(self),
                &format!(
                    "Real contact area, mean contact pressure and plastic share of the load against layer thickness, by \
                     nominal pressure. {} Circles: within the valid range. Separate markers at the edges: uncoated (left) and bulk layer material (right).",
                    self.lines_are()
                ),
            );
            page.figure(
                &format!("{}-regimes.svg", self.stem),
                figures::regimes(self),
                &format!(
                    "Share of the load carried by elastic, elastic-plastic and plastic contacts against layer thickness, \
                     at the lowest, a middle and the highest load ({} model); an asterisk marks a load beyond the valid range of \
                     some thickness.",
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
            "All thicknesses by load. a/t: mean contact radius over layer thickness; shares: load carried by elastic / \
             elastic-plastic / plastic contacts:",
        );
        type Column = (&'static str, fn(&Response) -> String);
        let columns: [Column; 4] = [
            ("d/σ", |r| number(r.separation_over_sigma)),
            ("A/A_nom", |r| number(r.area_ratio.total())),
            ("mean contact p", |r| {
                r.mean_real_pressure().map_or_else(|| "–".to_owned(), |p| quantity(p, "Pa"))
            }),
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
                let mark = if is_valid_at(case, load) { "" } else { " *" };
                let radius = response(self.findings.main_model()).and_then(Response::mean_contact_radius);
                let ratio = radius.filter(|_| t > 0.0 && t.is_finite()).map(|a| number(a / t));
                let mut row = vec![
                    input_quantity(load, "Pa"),
                    thickness(t) + mark,
                    ratio.unwrap_or_else(|| "–".to_owned()),
                ];
                for (_, value) in columns {
                    row.extend(
                        kinds.iter().map(|&kind| response(kind).map_or_else(|| "–".to_owned(), value)),
                    );
                }
                row
            }),
        );
        page.paragraph("\\* Beyond the valid range.");
    }

    /// Thicknesses below which the layer has no effect.
    fn threshold_table(&self, page: &mut Page) {
        page.paragraph(
            "Thickness below which the layer has no effect: at equal load the real contact area is within 5 % of the \
             uncoated one. Found to within 1 % between the thinnest listed thickness that has an effect and the one before \
             it, or outside the list if none has.",
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
                std::iter::once(input_quantity(load, "Pa")).chain(kinds.iter().map(of)).collect::<Vec<_>>()
            }),
        );
    }

    /// Line styles of a figure.
    fn lines_are(&self) -> &'static str {
        match self.findings.models[..] {
            [] => "Lines: reference.",
            [Kind::Statistical] => "Lines: statistical model.",
            [Kind::Deterministic] => "Lines: deterministic model.",
            _ => {
                "Solid: deterministic model; dashed: statistical model (as in Fig. 6 of Pasaribu and Schipper 2005)."
            }
        }
    }

    /// The line style of the reference beside models.
    fn reference_is(&self) -> &'static str {
        let has_both =
            !self.findings.models.is_empty() && self.cases.iter().any(|case| case.reference.is_some());
        if has_both { " Dash-dot: reference." } else { "" }
    }
}

fn shares(response: &Response) -> String {
    let whole = |share: f64| format!("{:.0} %", 100.0 * share);
    response.pressure.shares().map_or_else(|| "–".to_owned(), |shares| shares.map(whole).join(" / "))
}
