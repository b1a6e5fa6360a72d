//! Differences between the models against the nesting index of the S filter.

use asperity::compare::{ComparedQuantity, Difference};
use asperity::study::{CaseStudy, Treatment};
use asperity_contact_framework::report::format::{capitalised, input_quantity};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Marker, Plot};

use crate::kind::compare::results::SurfaceResults;
use crate::presentation::quantity_name;

/// How much of the axis is shown at least, in accepted differences.
const VIEW: f64 = 1.5;

/// Differences of area and separation against the nesting index; `None` where fewer than two filters gave an answer.
pub fn against_filter(case: &CaseStudy, surface: &SurfaceResults) -> Option<Figure> {
    let own_cut_off = surface.own_cut_off?;
    let verdicts = &case.verdicts;
    let map = surface.surface.map.as_ref()?;
    let pixel = map.pixel[0].max(map.pixel[1]);
    let (unit, scale) = if pixel < 1e-7 { ("nm", 1e9) } else { ("µm", 1e6) };
    let pixel = scale * pixel;
    let mut filtered: Vec<(f64, &[Difference])> = case
        .treated
        .iter()
        .filter_map(|one| match one.treatment {
            Treatment::ShortWaves(s) => Some((s.map_or(pixel, |s| scale * s), &one.differences[..])),
            _ => None,
        })
        .filter(|(_, differences)| !differences.is_empty())
        .collect();
    let has_none =
        own_cut_off.is_none() || case.treated.iter().any(|one| one.treatment == Treatment::ShortWaves(None));
    filtered.push((own_cut_off.map_or(pixel, |s| scale * s), &verdicts.differences));
    filtered.sort_by(|a, b| a.0.total_cmp(&b.0));
    if filtered.len() < 2 {
        return None;
    }
    let examined = case.treated_loads();
    if examined.is_empty() {
        return None;
    }
    let mut shown = vec![examined[0], examined[examined.len() / 2], examined[examined.len() - 1]];
    shown.dedup();
    let ends = [filtered[0].0 / 1.2, filtered[filtered.len() - 1].0 * 1.2];
    let panels = [
        (ComparedQuantity::Area, "difference (%)", 100.0),
        (ComparedQuantity::Separation, "difference (σ)", 1.0),
        (ComparedQuantity::Stiffness, "difference (%)", 100.0),
    ];
    let is_compared = |compared: ComparedQuantity| {
        verdicts.differences.iter().any(|at| at.estimates[compared as usize].is_some())
    };
    let panels = panels.into_iter().filter(|(compared, ..)| is_compared(*compared));
    let along = format!("S filter ({unit})");
    let plots = panels.map(|(compared, label, unit)| {
        let accepted = unit * verdicts.accepted.limit(compared);
        let axis = Axis::log(along.as_str()).range(ends[0], ends[1]);
        let values = filtered.iter().flat_map(|(_, differences)| differences.iter());
        let values = values.filter(|at| shown.contains(&at.load));
        let values =
            values.filter_map(|at| Some(unit * compared.reported(at.estimates[compared as usize]?.contrast)));
        let [low, high] = values.fold([-VIEW * accepted, VIEW * accepted], |[low, high], value| {
            [low.min(value), high.max(value)]
        });
        let room = 0.05 * (high - low);
        let mut plot = Plot::new(
            capitalised(quantity_name(compared)),
            axis,
            Axis::linear(label).range(low - room, high + room),
        )
        .height(210.0)
        .with(Layer::region_y(-accepted, accepted, "accepted").coloured(Colour::Series(2)))
        .with_zero();
        if has_none {
            plot = plot.with(Layer::at_x(pixel, "no filter"));
        }
        for ((place, load), dash) in shown.iter().enumerate().zip([Dash::Solid, Dash::Dashed, Dash::Dotted]) {
            let points = filtered.iter().filter_map(|(s, differences)| {
                let at = differences.iter().find(|at| at.load == *load)?;
                Some((*s, unit * compared.reported(at.estimates[compared as usize]?.contrast)))
            });
            let points: Vec<(f64, f64)> = points.collect();
            let colour = Colour::Series(place);
            plot = plot
                .with(
                    Layer::line(points.clone())
                        .coloured(colour)
                        .dashed(dash)
                        .named(input_quantity(*load, "Pa")),
                )
                .with(Layer::points(points, Marker::Circle).coloured(colour));
        }
        plot
    });
    let title =
        format!("{}: statistical − deterministic model at equal load, by S filter", surface.surface.name);
    Some(Figure::row(title.clone(), plots.collect()).headed(title))
}
