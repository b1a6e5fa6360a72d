//! Figures by thickness of the layer.

use asperity::compare::{ComparedQuantity, CurvePoint, ModelKind, ReferencePoint};
use asperity::study::{CaseResults, FilmFriction};
use asperity::{INTERACTION, Regime, Response};
use asperity_contact_framework::report::format::{input_quantity, number, thickness};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

use super::curves::{curve, has_regimes, is_seen, reference_line, shares_of_load};
use crate::kind::compare::series::{Series, is_valid_at};

/// Separation and real area against load, by thickness.
pub fn by_load(series: &Series) -> Figure {
    let title = format!("{}: separation and real contact area by layer thickness", series.subject);
    Figure::row(title.clone(), panels_by_load(series).into()).headed(title)
}

pub fn panels_by_load(series: &Series) -> [Plot; 2] {
    let (modulus, units) = (series.modulus, series.units);
    let mut separation = Plot::new("Separation", units.load_ratio(), units.separation());
    let mut area = Plot::new("Real contact area", units.load_ratio(), Axis::log("area ratio A/A_nom"))
        .with(Layer::region_y(INTERACTION, f64::INFINITY, "asperities interact"));
    for (index, (case, valid)) in series.cases.iter().zip(series.valid()).enumerate() {
        let colour = Colour::Ordered { index, of: series.cases.len() };
        let kinds = &series.findings.models;
        for &kind in kinds {
            let points = curve(&case.comparison, kind);
            // Beyond the admissible range a line is thin.
            let lines = |value: fn(&Response) -> f64| {
                let shown = |p: &&CurvePoint| (p.response.pressure.total() / modulus, value(&p.response));
                let is_admissible = |p: &&&CurvePoint| {
                    // The load that was found is above the prescribed one by rounding.
                    let load = p.prescribed_pressure.unwrap_or(p.response.pressure.total());
                    valid.stretches.iter().any(|[from, to]| (*from..=*to).contains(&load))
                };
                let all = Layer::line(points.iter().map(shown).collect::<Vec<_>>()).coloured(colour).thin();
                let inside = points.iter().filter(is_admissible).map(shown).collect::<Vec<_>>();
                let inside = Layer::line(inside).coloured(colour);
                [all, inside].map(|line| {
                    if kind == ModelKind::Statistical && kinds.len() > 1 {
                        line.dashed(Dash::Dashed)
                    } else {
                        line.named(thickness(case.thickness.unwrap_or(0.0)))
                    }
                })
            };
            for line in lines(|r| r.separation_over_sigma) {
                separation = separation.with(line);
            }
            for line in lines(|r| r.area_ratio.total()) {
                area = area.with(line);
            }
        }
        let reference = |value: fn(&ReferencePoint) -> Option<f64>| {
            let line = Layer::line(
                reference_line(case, value).into_iter().map(|(load, value)| (load / modulus, value)),
            );
            let line = line.coloured(colour).dashed(Dash::DashDot);
            if kinds.is_empty() { line.named(thickness(case.thickness.unwrap_or(0.0))) } else { line }
        };
        if case.reference.is_some() {
            separation = separation.with(reference(|point| point.separation_over_sigma));
            area = area.with(reference(|point| Some(point.area_ratio)));
        }
    }
    [separation, area].map(|plot| with_styles(plot, series))
}

/// The line styles in the legend, where there is more than one.
fn with_styles(plot: Plot, series: &Series) -> Plot {
    let kinds = &series.findings.models;
    let has_reference = series.cases.iter().any(|case| case.reference.is_some());
    if kinds.len() + usize::from(has_reference) < 2 {
        return plot;
    }
    let style = |kind: ModelKind| match kind {
        ModelKind::Deterministic => Dash::Solid,
        ModelKind::Statistical if kinds.len() > 1 => Dash::Dashed,
        ModelKind::Statistical => Dash::Solid,
    };
    let plot = kinds.iter().rev().fold(plot, |plot, &kind| plot.with_key(kind.name(), style(kind)));
    if has_reference { plot.with_key("reference", Dash::DashDot) } else { plot }
}

/// Both models minus the reference against load, by thickness, at admissible loads: area and separation. Nothing where no load was
/// compared.
pub fn against_reference(series: &Series) -> Option<Figure> {
    let panel = |quantity: ComparedQuantity, title: &str, label: &str, unit: f64| {
        let axis = series.units.pressure();
        let accepted = series.verdicts().next().map(|(_, verdicts)| unit * verdicts.accepted.limit(quantity));
        let mut plot = Plot::new(title, axis, Axis::linear(label)).with_zero();
        plot = accepted.into_iter().fold(plot, |plot, accepted| {
            plot.with(Layer::region_y(-accepted, accepted, "accepted").coloured(Colour::Series(2)))
        });
        for (index, (t, verdicts)) in series.verdicts().enumerate() {
            let Some(reference) = &verdicts.reference else { continue };
            let colour = Colour::Ordered { index, of: series.cases.len() };
            let lines = reference.against.models.each_ref().map(|differences| {
                let valid = differences.iter().filter(|at| at.exceeded().is_none());
                let shown = valid.filter_map(|at| {
                    let contrast = at.estimates[quantity as usize]?.contrast;
                    Some((1e-6 * at.load, unit * quantity.reported(contrast)))
                });
                Layer::line(shown.collect::<Vec<_>>()).coloured(colour)
            });
            let [statistical, sum] = lines;
            plot = plot.with(statistical.dashed(Dash::Dashed)).with(sum.named(thickness(t)));
        }
        plot.with_key("deterministic − reference", Dash::Solid)
            .with_key("statistical − reference", Dash::Dashed)
    };
    let has_reference = series.verdicts().any(|(_, verdicts)| verdicts.reference.is_some());
    has_reference.then(|| {
        let panels = vec![
            panel(ComparedQuantity::Area, "Real contact area", "area minus reference (%)", 100.0),
            panel(ComparedQuantity::Separation, "Separation", "separation minus reference (σ)", 1.0),
        ];
        let title =
            format!("{}: both models minus the reference at equal load, by layer thickness", series.subject);
        Figure::row(title.clone(), panels).headed(title)
    })
}

/// Real contact area, mean contact pressure and the share of the load in plastic contacts, or of elastic-plastic ones where none is,
/// against layer thickness, by load.
pub fn by_thickness(series: &Series) -> Figure {
    let area = against_thickness(series, "real contact area", Axis::log("area ratio A/A_nom"), |response| {
        Some(response.area_ratio.total())
    });
    let pressure = Axis::log("mean contact pressure (GPa)");
    let pressure = against_thickness(series, "mean contact pressure", pressure, |response| {
        response.mean_real_pressure().map(|p| p * 1e-9)
    });
    let shares: Vec<[f64; 3]> = series.cases.iter().flat_map(|case| shares_at_loads(series, case)).collect();
    let yielding = [Regime::Plastic, Regime::ElasticPlastic];
    let yielding = yielding.into_iter().find(|&regime| is_seen(regime, shares.iter()));
    let share = yielding.map(|regime| {
        let axis = Axis::linear(format!("{} share of the load", regime.name())).range(0.0, 1.0);
        against_thickness(series, &format!("{} share", regime.name()), axis, move |response| {
            response.pressure.shares().map(|shares| shares[regime as usize])
        })
    });
    let plots = [area, pressure].into_iter().chain(share).map(|plot| with_styles(plot, series));
    let title = "real contact area, mean contact pressure and yielding share against layer thickness";
    Figure::column(format!("{}: {title}", series.subject), plots.collect())
}

/// Shares of the regimes in both models at the loads at which thicknesses are compared.
fn shares_at_loads<'a>(series: &'a Series, case: &'a CaseResults) -> impl Iterator<Item = [f64; 3]> + 'a {
    let kinds = series.findings.models.iter();
    let points = kinds.flat_map(move |&kind| {
        series.findings.loads.iter().filter_map(move |&load| case.comparison.at_load(kind, load))
    });
    points.filter_map(|point| point.response.pressure.shares())
}

/// Circles on the curves.
const VALID: &str = "admissible";

/// Markers at the ends of the thickness axis.
const LIMITS: &str = "uncoated (left), bulk layer material (right)";

fn against_thickness(
    series: &Series,
    title: &str,
    axis: Axis,
    value: impl Fn(&Response) -> Option<f64>,
) -> Plot {
    /// Margin for the two limiting cases at the ends of the thickness axis, as a ratio.
    const ROOM: f64 = 1.6;
    let all: Vec<f64> = series.finite().map(|(t, _)| t).collect();
    let (thin, thick) = (all[0], all[all.len() - 1]);
    let place = |t: f64| nanometres(t.clamp(thin / ROOM, thick * ROOM));
    let x = thickness_axis().range(nanometres(thin / ROOM / 1.1), nanometres(thick * ROOM * 1.1));
    let mut plot = Plot::new(format!("{}: {title}", series.subject), x, axis).height(230.0);
    let loads = &series.findings.loads;
    for (index, &load) in loads.iter().enumerate() {
        let colour = Colour::Ordered { index, of: loads.len() };
        for kind in series.findings.models.iter().copied() {
            let found = |case: &CaseResults| {
                case.comparison.at_load(kind, load).and_then(|point| value(&point.response))
            };
            let line = series.finite().filter_map(|(t, case)| Some((nanometres(t), found(case)?)));
            let is_foremost = kind == series.findings.main_model();
            let line: Vec<(f64, f64)> = line.collect();
            let places = series.finite().filter(|(_, case)| is_valid_at(case, load));
            let places = places.filter_map(|(t, case)| Some((nanometres(t), found(case)?)));
            let places =
                Layer::points(places.collect::<Vec<_>>(), Marker::Circle).coloured(colour).named(VALID);
            let is_limit =
                |case: &&&CaseResults| case.thickness.is_some_and(|t| t == 0.0 || t == f64::INFINITY);
            let limits = series.cases.iter().filter(is_limit);
            let limits = limits.filter_map(|case| Some((place(case.thickness?), found(case)?)));
            let marker = if is_foremost { Marker::Square } else { Marker::Triangle };
            let limits = Layer::points(limits.collect::<Vec<_>>(), marker).coloured(colour).named(LIMITS);
            let line = Layer::line(line).coloured(colour);
            plot = plot.with(limits).with(if is_foremost {
                line.named(input_quantity(load, "Pa"))
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

/// Shares of the regimes against thickness, at the lowest, a middle and the highest load. Nothing where one regime carries all.
pub fn regimes(series: &Series) -> Option<Figure> {
    let shares: Vec<[f64; 3]> = series.finite().flat_map(|(_, case)| shares_at_loads(series, case)).collect();
    if !has_regimes(shares.iter()) {
        return None;
    }
    const PANELS: usize = 3;
    let kind = series.findings.main_model();
    let loads = &series.findings.loads;
    let chosen = match loads.len() {
        0..=PANELS => loads.clone(),
        count => vec![loads[0], loads[count / 2], loads[count - 1]],
    };
    let panel = |load: f64| {
        let shares = series.finite().filter_map(|(t, case)| {
            Some((nanometres(t), case.comparison.at_load(kind, load)?.response.pressure.shares()?))
        });
        let mark = if series.cases.iter().all(|case| is_valid_at(case, load)) { "" } else { " *" };
        shares_of_load(&format!("{}{mark}", input_quantity(load, "Pa")), thickness_axis(), shares)
    };
    let title = format!("{}: share of the load by contact regime, against layer thickness", series.subject);
    Some(Figure::row(title.clone(), chosen.into_iter().map(panel).collect()).headed(title))
}

fn thickness_axis() -> Axis {
    Axis::log("layer thickness (nm)")
}

fn nanometres(t: f64) -> f64 {
    t * 1e9
}

/// The coefficient of both models, a panel for each load and a colour for each breakdown; nothing where friction is not asked for.
pub fn friction_by_thickness(series: &Series) -> Option<Figure> {
    /// The most loads.
    const MOST: usize = 3;
    let mut loads: Vec<f64> = series.friction.iter().map(|found| found.pressure).collect();
    loads.dedup();
    if loads.is_empty() {
        return None;
    }
    // The ends and the middle.
    let step = (loads.len() - 1).max(1) as f64 / (MOST - 1) as f64;
    let shown: Vec<f64> = if loads.len() <= MOST {
        loads
    } else {
        (0..MOST).map(|k| loads[(step * k as f64).round() as usize]).collect()
    };
    let panels = shown.iter().map(|&load| panel(series, load)).collect();
    Some(Figure::row(format!("{}: coefficient of friction against layer thickness", series.subject), panels))
}

fn panel(series: &Series, load: f64) -> Plot {
    let at_load: Vec<&FilmFriction> =
        series.friction.iter().copied().filter(|found| found.pressure == load).collect();
    let mut breakdowns: Vec<f64> = at_load.iter().map(|found| found.breakdown).collect();
    breakdowns.sort_by(f64::total_cmp);
    breakdowns.dedup();
    let axis = Axis::log("layer thickness (nm)");
    let mut plot = Plot::new(input_quantity(load, "Pa"), axis, Axis::linear("coefficient of friction"));
    for found in at_load {
        let index = breakdowns.iter().position(|one| *one == found.breakdown).unwrap_or(0);
        let colour = Colour::Ordered { index, of: breakdowns.len() };
        let finite = found.points.iter().filter(|(t, _)| *t > 0.0 && t.is_finite());
        let line = Layer::line(finite.map(|&(t, coefficient)| (1e9 * t, coefficient))).coloured(colour);
        plot = if found.kind == ModelKind::Deterministic {
            let least = found.least().filter(|(t, _)| *t > 0.0 && t.is_finite());
            let least: Vec<(f64, f64)> = least.map(|(t, at)| (1e9 * t, at)).into_iter().collect();
            plot.with(line.named(format!("sum, breakdown at w = {} t", number(found.breakdown))))
                .with(Layer::points(least, Marker::Circle).coloured(colour).named("least of the sum"))
        } else {
            let name = format!("integral, w = {} t", number(found.breakdown));
            plot.with(line.dashed(Dash::Dashed).named(name))
        };
    }
    plot
}
