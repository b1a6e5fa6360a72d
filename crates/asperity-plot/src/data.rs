//! The content of a figure as numbers, for pages that draw it anew.

use serde::Serialize;

use super::frames::FramesData;
use super::layer::{Dash, Direction, Layer, Marker, Shape};
use super::{Axis, Plot, Spread};

/// Numbers are rounded to so many significant digits.
const DIGITS: i32 = 6;

/// Lines, points, bands and references of each plot of a figure; or the frames of a map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureData {
    /// One for each plot; none of a map.
    panels: Vec<Panel>,
    #[serde(skip_serializing_if = "Option::is_none")]
    frames: Option<FramesData>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Panel {
    title: String,
    height: f64,
    x: AxisData,
    y: AxisData,
    /// Places along x; series that share them refer to one list.
    places: Vec<Vec<Option<f64>>>,
    series: Vec<Series>,
    marks: Vec<Mark>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct AxisData {
    log: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    range: Option<(f64, f64)>,
    /// Whether the range of the data is widened to hold zero.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    zero: bool,
    /// The quantities in which it can be read; the first is that of the data.
    units: Vec<Unit>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Unit {
    label: String,
    factor: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Series {
    /// Empty of one that the legend does not name.
    name: String,
    kind: &'static str,
    colour: String,
    dash: &'static str,
    width: f64,
    opacity: f64,
    /// Index into the places.
    x: usize,
    /// Values; of a band its lower edge.
    y: Vec<Option<f64>>,
    /// The upper edge of a band.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    top: Vec<Option<f64>>,
}

/// A region or a level across the whole plot; an end that is missing lies at infinity.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Mark {
    axis: &'static str,
    from: Option<f64>,
    to: Option<f64>,
    label: String,
    colour: String,
    opacity: f64,
}

/// The data of plots; `None` where one of them holds something else.
pub(super) fn of(plots: &[Plot]) -> Option<FigureData> {
    let frames = plots.iter().flat_map(|plot| &plot.layers).find_map(|layer| match &layer.shape {
        Shape::Frames(frames) => Some(frames.data(layer)),
        _ => None,
    });
    if frames.is_some() {
        return Some(FigureData { panels: Vec::new(), frames });
    }
    let panels: Vec<Panel> = plots.iter().map(panel).collect::<Option<_>>()?;
    let has_data = panels.iter().any(|panel| !panel.series.is_empty());
    has_data.then_some(FigureData { panels, frames })
}

fn panel(plot: &Plot) -> Option<Panel> {
    let mut panel = Panel {
        title: plot.title.clone(),
        height: plot.height,
        x: axis(&plot.x),
        y: axis(&plot.y),
        places: Vec::new(),
        series: Vec::new(),
        marks: Vec::new(),
    };
    for layer in &plot.layers {
        match &layer.shape {
            // A chart reads its values along x: there is none of a line that turns back.
            Shape::Line(points) if !is_monotone(points) => return None,
            Shape::Line(points) => {
                let dash = match layer.dash {
                    Dash::Solid => "solid",
                    Dash::Dashed => "dashed",
                    Dash::Dotted => "dotted",
                    Dash::DashDot => "dash-dot",
                };
                let y = points.iter().map(|point| point.1);
                panel.add(layer, "line", dash, points.iter().map(|point| point.0), y, None);
            }
            Shape::Points(points, marker) => {
                let kind = match marker {
                    Marker::Circle => "circle",
                    Marker::Square => "square",
                    Marker::Triangle => "triangle",
                    Marker::Cross => "cross",
                    Marker::Ring => "ring",
                };
                let y = points.iter().map(|point| point.1);
                panel.add(layer, kind, "solid", points.iter().map(|point| point.0), y, None);
            }
            Shape::Band(points, Direction::X) => {
                let (x, low) = (points.iter().map(|point| point.0), points.iter().map(|point| point.1));
                let top = points.iter().map(|point| number(point.2)).collect();
                panel.add(layer, "band", "solid", x, low, Some(top));
            }
            Shape::Region(direction, from, to) => panel.mark(layer, *direction, *from, *to),
            Shape::Level(direction, at) => panel.mark(layer, *direction, *at, *at),
            Shape::Slope { .. } | Shape::Note(_) => {}
            Shape::Band(..) | Shape::Bars(..) | Shape::Tile(..) | Shape::Raster(_) | Shape::Frames(_) => {
                return None;
            }
        }
    }
    Some(panel)
}

/// Whether the places of a line only grow or only fall.
fn is_monotone(points: &[(f64, f64)]) -> bool {
    let places: Vec<f64> = points.iter().map(|point| point.0).filter(|x| x.is_finite()).collect();
    places.is_sorted() || places.is_sorted_by(|a, b| a >= b)
}

impl Panel {
    fn add(
        &mut self,
        layer: &Layer,
        kind: &'static str,
        dash: &'static str,
        x: impl Iterator<Item = f64>,
        y: impl Iterator<Item = f64>,
        top: Option<Vec<Option<f64>>>,
    ) {
        let x: Vec<Option<f64>> = x.map(number).collect();
        if x.is_empty() {
            return;
        }
        let known = self.places.iter().position(|places| *places == x);
        let place = known.unwrap_or_else(|| {
            self.places.push(x);
            self.places.len() - 1
        });
        self.series.push(Series {
            name: layer.name.clone().unwrap_or_default(),
            kind,
            colour: layer.colour.hex(),
            dash,
            width: layer.weight,
            opacity: layer.opacity,
            x: place,
            y: y.map(number).collect(),
            top: top.unwrap_or_default(),
        });
    }

    fn mark(&mut self, layer: &Layer, direction: Direction, from: f64, to: f64) {
        self.marks.push(Mark {
            axis: if direction == Direction::X { "x" } else { "y" },
            from: number(from),
            to: number(to),
            label: layer.label.clone(),
            colour: layer.colour.hex(),
            opacity: layer.opacity,
        });
    }
}

fn axis(axis: &Axis) -> AxisData {
    let own = Unit { label: axis.label.clone(), factor: 1.0 };
    let others = axis.units.iter().map(|(label, factor)| Unit { label: label.clone(), factor: *factor });
    AxisData {
        log: axis.spread == Spread::Log,
        range: axis.range.filter(|(from, to)| from.is_finite() && to.is_finite()),
        zero: axis.zero,
        units: std::iter::once(own).chain(others).collect(),
    }
}

/// A value with as many digits as a reader may want; `None` of what is not finite.
fn number(value: f64) -> Option<f64> {
    if value == 0.0 || !value.is_finite() {
        return value.is_finite().then_some(value);
    }
    /// Powers of ten up to this are exact, and so are the quotients and products with them after rounding.
    const EXACT: i32 = 22;
    let places = DIGITS - 1 - value.abs().log10().floor() as i32;
    let power = 10f64.powi(places.abs());
    match places {
        0..=EXACT => Some((value * power).round() / power),
        places if (-EXACT..0).contains(&places) => Some((value / power).round() * power),
        _ => format!("{value:.0$e}", (DIGITS - 1) as usize).parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Colour, Figure, Raster};

    fn plot() -> Plot {
        let axis = Axis::log("load ratio").or_in("nominal pressure (MPa)", 1.15e5);
        Plot::new("Area", axis, Axis::linear("area"))
            .with(Layer::band([(1.0, 0.0, 2.0), (2.0, 1.0, f64::NAN)]).named("sum"))
            .with(Layer::line([(1.0, 1.000000049), (2.0, 1.5)]).named("sum").coloured(Colour::Deterministic))
            .with(Layer::at_y(0.0, "none"))
            .with(Layer::region_x(3.0, f64::INFINITY, "not admissible"))
    }

    #[test]
    fn numbers_are_those_of_the_layers() {
        let data = Figure::from(plot()).data().unwrap();
        let panel = &data.panels[0];
        assert_eq!(panel.places, [[Some(1.0), Some(2.0)]]);
        assert_eq!((panel.series[0].kind, &panel.series[0].top[..]), ("band", &[Some(2.0), None][..]));
        assert_eq!((panel.series[1].x, &panel.series[1].y[..]), (0, &[Some(1.0), Some(1.5)][..]));
        assert_eq!(panel.series[1].colour, "#D55E00");
        assert_eq!(
            (panel.marks[0].axis, panel.marks[0].from, panel.marks[0].to),
            ("y", Some(0.0), Some(0.0))
        );
        assert_eq!((panel.marks[1].axis, panel.marks[1].from, panel.marks[1].to), ("x", Some(3.0), None));
        assert_eq!(panel.x.units[1], Unit { label: "nominal pressure (MPa)".to_owned(), factor: 1.15e5 });
    }

    #[test]
    fn numbers_are_rounded_as_their_decimals_are() {
        let mut value = 1.234_567_89e-30_f64;
        while value < 1e30 {
            for number in [value, -value] {
                let decimal: f64 = format!("{number:.5e}").parse().unwrap();
                assert_eq!(super::number(number), Some(decimal), "{number:e}");
            }
            value *= 7.3;
        }
        assert_eq!((super::number(0.0), super::number(f64::NAN)), (Some(0.0), None));
    }

    #[test]
    fn only_figures_of_lines_points_and_bands_have_data() {
        let field = Raster::of_points([(0.5, 0.5)], (0.0, 1.0), (0.0, 1.0), 2, 2);
        assert_eq!(Figure::from(plot().with(Layer::raster(field))).data(), None);
        assert_eq!(Figure::from(plot().with(Layer::bars(&[0.0, 1.0], &[1.0]))).data(), None);
        assert_eq!(Figure::joint("t", plot(), plot(), plot()).data(), None);
        assert_eq!(Figure::from(Plot::new("", Axis::linear(""), Axis::linear(""))).data(), None);
        assert!(Figure::row("t", vec![plot(), plot()]).data().is_some());
        assert!(Figure::from(plot().with(Layer::line([(2.0, 1.0), (1.0, 2.0)]))).data().is_some());
        let turning = Layer::line([(1.0, 1.0), (2.0, 2.0), (1.5, 3.0)]);
        assert_eq!(Figure::from(plot().with(turning)).data(), None);
    }
}
