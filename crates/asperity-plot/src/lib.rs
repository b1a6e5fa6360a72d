//! Figures as SVG text from a description of their content.
//!
//! A [`Figure`] is one [`Plot`] or several in a row or a column; a plot is two [`Axis`] and a list
//! of [`Layer`]s. Drawing is pure and depends on nothing but the description, so the same figure
//! gives the same bytes. It never fails: what cannot be shown (NaN, infinities, non-positive values
//! on a logarithmic axis) is left out and breaks the line, and a plot with nothing to show says so.

mod axes;
mod canvas;
mod colour;
mod data;
mod draw;
mod frames;
mod label;
mod layer;
mod layout;
mod marks;
mod raster;
mod style;
mod text;
mod ticks;

use axes::Bar;
pub use colour::{Colour, ColourMap, series_colours};
pub use data::FigureData;
pub use frames::{Frames, Patches};
pub use layer::{Dash, Layer, Marker};
use layer::{Direction, Shape};
pub use layout::Legend;
pub use raster::Raster;
pub use style::{DARK_COLOURS, Size, dark_rules};
use ticks::Scale;

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// Equal differences take equal lengths.
    Linear,
    /// Equal ratios take equal lengths; only positive values can be shown.
    Log,
}

#[derive(Clone, Debug)]
pub struct Axis {
    label: String,
    spread: Spread,
    range: Option<(f64, f64)>,
    /// Whether the range of the data is widened to hold zero.
    zero: bool,
    /// Other units, each with its label and its number to one of the axis.
    units: Vec<(String, f64)>,
    /// Names of the places 0, 1, ... instead of numbers.
    names: Vec<String>,
}

impl Axis {
    /// A linear axis; the label names the quantity and its unit, e.g. "separation d (µm)".
    pub fn linear(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            spread: Spread::Linear,
            range: None,
            zero: false,
            units: Vec::new(),
            names: Vec::new(),
        }
    }

    /// An axis of named places 0, 1, ..., each from half before it to half after it; along y the first is at the top. Along x a range
    /// from -0.5 puts it at the left.
    pub fn named(names: impl IntoIterator<Item = String>) -> Self {
        let names: Vec<String> = names.into_iter().collect();
        let last = names.len() as f64 - 0.5;
        Self { names, ..Self::linear("").range(last, -0.5) }
    }

    pub fn labelled(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }

    /// A logarithmic axis.
    pub fn log(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            spread: Spread::Log,
            range: None,
            zero: false,
            units: Vec::new(),
            names: Vec::new(),
        }
    }

    /// Shows exactly this range instead of the range of the data; the first value stands left (or
    /// at the bottom), so that a decreasing range reverses the axis. A range that the axis cannot
    /// show is ignored.
    pub fn range(mut self, from: f64, to: f64) -> Self {
        self.range = Some((from, to));
        self
    }

    /// Names another quantity in which a reader may want the axis, and its value where the axis is at 1. Drawings use the first
    /// one; [`Figure::data`] has all.
    pub fn or_in(mut self, label: impl Into<String>, factor: f64) -> Self {
        self.units.push((label.into(), factor));
        self
    }

    /// With the range of some values, unless it has one.
    fn ending_with(&self, values: &[f64]) -> Self {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self { range: self.range.or(Some((low, high))), ..self.clone() }
    }
}

/// One pair of axes and what is drawn between them.
#[derive(Clone, Debug)]
pub struct Plot {
    title: String,
    x: Axis,
    y: Axis,
    layers: Vec<Layer>,
    legend: Legend,
    height: f64,
    equal: bool,
    /// What the colours of ordered lines mean.
    order: Option<Axis>,
}

impl Plot {
    /// An empty plot; an empty title takes no room.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        let title = title.into();
        Self {
            title,
            x,
            y,
            layers: Vec::new(),
            legend: Legend::Auto,
            height: 380.0,
            equal: false,
            order: None,
        }
    }

    /// A cell of a [`Figure::grid`] that stays empty.
    pub fn blank() -> Self {
        Self { height: 0.0, ..Self::new("", Axis::linear(""), Axis::linear("")) }
    }

    /// The same plot with another title.
    pub fn titled(self, title: impl Into<String>) -> Self {
        Self { title: title.into(), ..self }
    }

    /// Adds a layer on top of those before it.
    pub fn with(mut self, layer: Layer) -> Self {
        self.layers.push(layer);
        self
    }

    /// Adds shares that are stacked on each other: per share its name, its colour and one value for
    /// each `x`. A point at which some share is missing (NaN) is a gap in all of them.
    pub fn with_stacked<'a>(
        mut self,
        x: &[f64],
        shares: impl IntoIterator<Item = (&'a str, Colour, &'a [f64])>,
    ) -> Self {
        let mut base = vec![0.0; x.len()];
        let first = self.layers.len();
        for (name, colour, share) in shares {
            let top: Vec<f64> = base.iter().zip(share).map(|(below, part)| below + part).collect();
            let band = x.iter().zip(base.iter().zip(&top)).map(|(x, (low, high))| (*x, *low, *high));
            self.layers.push(Layer::band(band).named(name).coloured(colour).opaque());
            base = top;
        }
        // The sum of a point holds NaN if one of its shares does.
        for layer in &mut self.layers[first..] {
            layer.keep_where(|place| base.get(place).is_some_and(|sum| sum.is_finite()));
        }
        self
    }

    /// Adds contributions of either sign that are stacked from zero, positive ones upwards and negative ones downwards: per
    /// contribution its name, its colour and one value for each `x`. A missing value (NaN) is a gap in all of them.
    pub fn with_contributions<'a>(
        mut self,
        x: &[f64],
        parts: impl IntoIterator<Item = (&'a str, Colour, &'a [f64])>,
    ) -> Self {
        let parts: Vec<(&str, Colour, &[f64])> = parts.into_iter().collect();
        let values: Vec<&[f64]> = parts.iter().map(|(_, _, part)| *part).collect();
        let (x, values) = with_changes_of_sign(self.x.spread, x, &values);
        let mut ends = vec![[0.0; 2]; x.len()];
        let first = self.layers.len();
        for ((name, colour, _), part) in parts.iter().zip(&values) {
            let mut band = Vec::with_capacity(x.len());
            for ((x, [low, high]), part) in x.iter().zip(&mut ends).zip(part) {
                let end = if part.is_sign_negative() { low } else { high };
                let from = *end;
                *end += part;
                band.push((*x, from.min(*end), from.max(*end)));
            }
            self.layers.push(Layer::band(band).named(*name).coloured(*colour).opaque());
        }
        for layer in &mut self.layers[first..] {
            layer.keep_where(|place| ends.get(place).is_some_and(|ends| (ends[0] + ends[1]).is_finite()));
        }
        self
    }

    /// Where the names of the layers stand; [`Legend::Auto`] by default.
    pub fn legend(mut self, legend: Legend) -> Self {
        self.legend = legend;
        self
    }

    /// Height between the axes in CSS pixels, from 60 to 2000; 380 by default.
    pub fn height(mut self, pixels: f64) -> Self {
        self.height = pixels.clamp(60.0, 2000.0);
        self
    }

    /// Makes one unit of x as long as one of y, as on a map: the frame is as large as the width of the
    /// figure and [`Plot::height`] allow. Logarithmic axes stay as they are.
    pub fn equal_aspect(mut self) -> Self {
        self.equal = true;
        self
    }

    /// Adds a colour bar: the lines of [`Plot::colour_at`] have the colours of their places along an axis, which has a range.
    pub fn with_order(mut self, axis: Axis) -> Self {
        self.order = Some(axis);
        self
    }

    /// The colour of a value along an axis with a range, for [`Plot::with_order`].
    pub fn colour_at(axis: &Axis, value: f64) -> Colour {
        const OF: usize = 255;
        let (from, to) = axis.range.unwrap_or((0.0, 1.0));
        let place = Scale::new(axis, [from, to].into_iter(), false).place(value).unwrap_or(0.0);
        Colour::Ordered { index: (place.clamp(0.0, 1.0) * (OF - 1) as f64).round() as usize, of: OF }
    }

    fn bar(&self, length: f64) -> Option<Bar<'_>> {
        let of_field = self.raster().and_then(|raster| Bar::of_field(raster, length));
        of_field.or_else(|| self.order.as_ref().map(|axis| Bar::of_order(axis, length)))
    }

    /// Marks zero along y, which a linear axis without a range of its own then holds: for differences.
    pub fn with_zero(mut self) -> Self {
        self.y.zero = true;
        self.with(Layer::at_y(0.0, ""))
    }

    /// The same with x and y exchanged.
    fn sideways(mut self) -> Self {
        std::mem::swap(&mut self.x, &mut self.y);
        self.layers = self.layers.into_iter().map(Layer::sideways).collect();
        self
    }

    fn without_fields(mut self) -> Self {
        self.layers.retain(|layer| !matches!(layer.shape, Shape::Raster(_)));
        self
    }

    fn is_linear(&self) -> bool {
        [self.x.spread, self.y.spread] == [Spread::Linear; 2]
    }

    /// The field to which the colour bar belongs.
    fn raster(&self) -> Option<&Raster> {
        self.layers.iter().find_map(|layer| match &layer.shape {
            Shape::Raster(raster) if self.is_linear() && raster.scale().is_some() => Some(raster),
            _ => None,
        })
    }

    /// The names of its layers, each once, sorted.
    fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.layers.iter().filter_map(|layer| layer.name.as_deref()).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    /// As many names as layers: adds a key to the legend that shows a way to draw lines, such as dashes for a model.
    pub fn with_key(self, name: &str, dash: Dash) -> Self {
        self.with(Layer::line([]).coloured(Colour::Neutral).dashed(dash).named(name))
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Arrangement {
    Column,
    Row,
    /// In so many columns, where there is room for them.
    Grid(usize),
    /// The main plot, the one above it, the one at its right on its side.
    Joint,
}

/// Several plots in one picture.
#[derive(Clone, Debug)]
pub struct Figure {
    title: String,
    /// Above all plots; empty where these say all.
    heading: String,
    plots: Vec<Plot>,
    arrangement: Arrangement,
}

impl Figure {
    fn arranged(title: String, plots: Vec<Plot>, arrangement: Arrangement) -> Self {
        Self { title, heading: String::new(), plots, arrangement }
    }

    /// Titles the figure, and names its subject above all plots.
    pub fn titled(self, title: impl Into<String>) -> Self {
        let title = title.into();
        Self { title: title.clone(), ..self.headed(title) }
    }

    /// Names the subject of all plots above them, for a picture that is seen without its page: the surface, the case.
    pub fn headed(mut self, heading: impl Into<String>) -> Self {
        self.heading = heading.into();
        self
    }

    /// Plots below each other with their left and right edges in line, e.g. a difference below its
    /// curves. The title is for readers that cannot see the picture; the plots show their own.
    pub fn column(title: impl Into<String>, plots: Vec<Plot>) -> Self {
        Self::arranged(title.into(), plots, Arrangement::Column)
    }

    /// Plots side by side, each narrower; in several rows where they would be too narrow. Plots that name the same layers share
    /// their legend.
    pub fn row(title: impl Into<String>, plots: Vec<Plot>) -> Self {
        Self::arranged(title.into(), plots, Arrangement::Row)
    }

    /// Plots in rows of `columns`, with the edges of each column in line and one legend for each row: quantities side by side, and
    /// below each its difference on the same axis. Like [`Figure::row`] where the columns would be too narrow.
    pub fn grid(title: impl Into<String>, columns: usize, plots: Vec<Plot>) -> Self {
        Self::arranged(title.into(), plots, Arrangement::Grid(columns))
    }

    /// A main plot with a low one above it that shares its x axis exactly, and a narrow one at its right
    /// that shares its y axis exactly. Both are given as they would stand alone, with the shared quantity
    /// along x; the right one is laid on its side. Their x axes, titles and heights do not count.
    /// They hold bars and lines, bands and references; fields belong in the main plot.
    pub fn joint(title: impl Into<String>, main: Plot, top: Plot, right: Plot) -> Self {
        let plots = vec![main, top.without_fields(), right.without_fields().sideways()];
        Self::arranged(title.into(), plots, Arrangement::Joint)
    }

    /// Draws the figure as the text of an SVG file, as wide as a page (720 CSS pixels) or sized for print. In a dark environment
    /// a viewer that applies style sheets shows it light on dark.
    pub fn file(&self, size: Option<Size>) -> String {
        self.draw(size, true)
    }

    /// Draws the figure as part of a page that has the [`dark_rules`].
    pub fn part_of_page(&self) -> String {
        self.draw(None, false)
    }

    /// Draws the first plot as the text of an SVG file for a card: narrow, with letters as large as on a page; names that would take more room
    /// than the plot are left out, and upright labels of regions.
    pub fn card(&self) -> String {
        const MOST_NAMES: usize = 4;
        let Some(plot) = self.plots.first() else { return String::new() };
        let mut plot = plot.clone();
        if plot.names().len() > MOST_NAMES {
            plot.legend = Legend::Hidden;
        }
        let upright = |layer: &&mut Layer| matches!(layer.shape, Shape::Region(Direction::X, ..));
        plot.layers.iter_mut().filter(upright).for_each(|layer| layer.label.clear());
        draw::card(&self.title, &plot)
    }

    /// What the figure shows as numbers; `None` of a figure that is more than lines, points, bands and references.
    pub fn data(&self) -> Option<FigureData> {
        let has_bar = self.plots.iter().any(|plot| plot.order.is_some());
        (self.arrangement != Arrangement::Joint && !has_bar).then(|| data::of(&self.plots)).flatten()
    }

    /// What it shows, for readers that cannot see it.
    pub fn title(&self) -> &str {
        &self.title
    }

    fn draw(&self, size: Option<Size>, file: bool) -> String {
        let plots: Vec<&Plot> = self.plots.iter().collect();
        draw::figure([&self.title, &self.heading], &plots, self.arrangement, size, file)
    }
}

impl From<Plot> for Figure {
    fn from(plot: Plot) -> Self {
        Self::arranged(plot.title.clone(), vec![plot], Arrangement::Column)
    }
}

#[cfg(test)]
mod tests;

/// The parts with two points added where one of them is zero between two values of either sign: zero from above and zero from
/// below. Between them its band changes sides, which elsewhere would cross the bands of the others.
fn with_changes_of_sign(spread: Spread, x: &[f64], parts: &[&[f64]]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut places = Vec::with_capacity(x.len());
    let mut values = vec![Vec::with_capacity(x.len()); parts.len()];
    for end in 0..x.len() {
        if let Some(start) = end.checked_sub(1) {
            let crossing = |part: &&[f64]| part[start] / (part[start] - part[end]);
            let mut crossings: Vec<(usize, f64)> = parts
                .iter()
                .enumerate()
                .filter(|(_, part)| part[start].is_sign_negative() != part[end].is_sign_negative())
                .map(|(which, part)| (which, crossing(part)))
                .filter(|(_, share)| share.is_finite())
                .collect();
            crossings.sort_by(|a, b| a.1.total_cmp(&b.1));
            for (which, share) in crossings {
                let between = |from: f64, to: f64| from + share * (to - from);
                let place = match spread {
                    Spread::Linear => between(x[start], x[end]),
                    Spread::Log => between(x[start].ln(), x[end].ln()).exp(),
                };
                for side in [start, end] {
                    places.push(place);
                    for (index, (part, values)) in parts.iter().zip(&mut values).enumerate() {
                        let zero = 0f64.copysign(part[side]);
                        values.push(if index == which { zero } else { between(part[start], part[end]) });
                    }
                }
            }
        }
        places.push(x[end]);
        for (part, values) in parts.iter().zip(&mut values) {
            values.push(part[end]);
        }
    }
    (places, values)
}
