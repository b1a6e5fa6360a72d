//! One plot: its scales and margins first, then its place and its marks.

use crate::axes::{FOOT, Frame};
use crate::canvas::{Align, Canvas, Rect, Spot, Type};
use crate::label::{Taken, draw_corner_note, draw_label};
use crate::layer::{Direction, Layer, Shape};
use crate::marks::draw_key;
use crate::style::{BAND_ROOM, INK, LABEL, MOST_KEYS, PAPER, TICK, TITLE};
use crate::text::{fit, width, wrap};
use crate::ticks::{Scale, Tick, measure};
use crate::{Axis, Colour, Plot, Spread, axes, marks};

/// Bold letters of the widest font over its others.
const BOLD: f64 = 1.14;
/// No frame is narrower or lower.
const LEAST: f64 = 60.0;

/// A plot whose axes are known, but not yet its place.
pub(super) struct Layout<'a> {
    pub(super) plot: &'a Plot,
    pub(super) width: f64,
    pub(super) x: Scale,
    pub(super) y: Scale,
    y_ticks: Vec<Tick>,
    /// Left and right of the frame.
    pub(super) margins: (f64, f64),
    title: Vec<String>,
    /// What the frame says that is shown, below the title.
    frame_name: Option<&'a str>,
    /// Height between the axes, unless the units of both axes are to be equally long.
    height: f64,
    nothing: bool,
    /// Whether a line or a band goes on beyond the range of its axis.
    is_cut: bool,
}

impl<'a> Layout<'a> {
    pub(super) fn new(plot: &'a Plot, (width, height): (f64, f64)) -> Self {
        // Only a point that both axes can show counts for either.
        let can_show =
            |p: &(f64, f64)| measure(plot.x.spread, p.0).is_some() && measure(plot.y.spread, p.1).is_some();
        let reach = |is_band: bool| -> Vec<(f64, f64)> {
            let shown = plot.layers.iter().filter(|layer| {
                layer.is_interval() == is_band
                    && (plot.is_linear() || !matches!(layer.shape, Shape::Raster(_)))
            });
            shown.flat_map(Layer::reach).filter(can_show).collect()
        };
        let mut shown = reach(false);
        shown.extend(within_reach(plot, &shown, reach(true)));
        let raster = plot.raster();
        // Bars stand on the axis along which they lie.
        let stand = |along: Direction| {
            plot.layers.iter().any(|layer| matches!(layer.shape, Shape::Bars(_, d) if d == along))
        };
        let scale = |axis: &Axis, values: &[f64], stands: bool| match raster {
            // An image reaches to the frame.
            Some(_) => Scale::new(&axis.ending_with(values), values.iter().copied(), stands),
            None => Scale::new(axis, values.iter().copied(), stands),
        };
        let x = scale(&plot.x, &shown.iter().map(|p| p.0).collect::<Vec<_>>(), stand(Direction::Y));
        let y = scale(&plot.y, &shown.iter().map(|p| p.1).collect::<Vec<_>>(), stand(Direction::X));
        let y_ticks = axes::ticks_of_y(&plot.y, &y, height);
        let bar = plot.bar(height).map_or(0.0, |bar| bar.room());
        let right = axes::right_margin(&axes::ticks_of_x(&plot.x, &x, 0.8 * width));
        let margins = (axes::left_margin(&plot.y, &y_ticks), right.max(bar));
        let title = wrap(&plot.title, BOLD * TITLE, width - 30.0, 3);
        let frame_name = plot.layers.iter().find_map(|layer| match &layer.shape {
            Shape::Frames(frames) => frames.names.get(frames.shown).map(String::as_str),
            _ => None,
        });
        let goes_on = |layer: &Layer| {
            matches!(layer.shape, Shape::Line(_) | Shape::Band(..))
                && layer.reach().iter().filter(|point| can_show(point)).any(|point| {
                    let inside = -1e-6..=1.0 + 1e-6;
                    let [across, up] = [x.place(point.0), y.place(point.1)];
                    across.is_some_and(|at| inside.contains(&at))
                        && up.is_some_and(|at| !inside.contains(&at))
                })
        };
        let is_cut = plot.layers.iter().any(goes_on);
        let nothing = shown.is_empty();
        Self { plot, width, x, y, y_ticks, margins, title, frame_name, height, nothing, is_cut }
    }

    /// Height of the title.
    pub(super) fn head(&self) -> f64 {
        (self.title.len() + usize::from(self.frame_name.is_some())) as f64 * (TITLE + 6.0)
    }

    /// Width and height of the frame in a space.
    pub(super) fn fitted(&self, width: f64, height: f64) -> (f64, f64) {
        let (along, up) = ((self.x.to - self.x.from).abs(), (self.y.to - self.y.from).abs());
        let unit = (width / along).min(height / up);
        if self.plot.equal && self.plot.is_linear() && unit.is_normal() {
            ((along * unit).max(LEAST), (up * unit).max(LEAST))
        } else {
            (width, height)
        }
    }

    /// Draws the plot with its upper left corner at a place and the frame below `head`; returns the
    /// y of its lower end.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        corner: (f64, f64),
        margins: (f64, f64),
        head: f64,
        has_legend: bool,
    ) -> f64 {
        let plot = self.plot;
        let room = (self.width - margins.0 - margins.1).max(LEAST);
        let (frame_width, frame_height) = self.fitted(room, self.height);
        let start = corner.0 + (room - frame_width) / 2.0;
        let rect = Rect::new(start + margins.0, corner.1 + 10.0 + head + 2.0, frame_width, frame_height);
        self.draw_title(canvas, corner.0, &rect);
        let frame = Frame { x: self.x, y: self.y, rect };
        let x_ticks = axes::ticks_of_x(&plot.x, &self.x, frame_width);
        let lower =
            (frame_height != self.height).then(|| axes::ticks_of_y(&self.plot.y, &self.y, frame_height));
        let y_ticks = lower.as_ref().unwrap_or(&self.y_ticks);
        let label_x = start + 6.0 + LABEL / 2.0;
        let taken = self.draw_panel(canvas, &frame, &x_ticks, y_ticks, |canvas| {
            let named = (Some(&plot.x), Some(&plot.y));
            axes::draw_axes(canvas, &frame, &x_ticks, y_ticks, named, label_x);
        });
        if let Some(bar) = plot.bar(frame_height) {
            bar.draw(canvas, &rect);
        }
        let bottom = rect.bottom + if plot.x.label.is_empty() { FOOT - LABEL - 8.0 } else { FOOT };
        if !has_legend {
            return bottom + 6.0;
        }
        self.draw_legend(canvas, &plot.layers, &rect, &taken, (corner.0, bottom))
    }

    /// Writes the title above the frame, or above all of a panel that begins at `left`.
    pub(super) fn draw_title(&self, canvas: &mut Canvas, left: f64, rect: &Rect) {
        // A title longer than the frame starts at the edge of the page.
        let longest = self.title.iter().map(|line| width(line, BOLD * TITLE)).fold(0.0, f64::max);
        let x = if longest > rect.width() { left + 12.0 } else { rect.left };
        let first = rect.top - 2.0 - self.head() + TITLE / 2.0;
        let lines = self.title.iter().enumerate();
        let lines = lines.map(|(k, line)| (line.as_str(), (x, first + k as f64 * (TITLE + 6.0))));
        let set = Type { size: TITLE, colour: INK, align: Align::Left, bold: true, upright: false };
        canvas.texts(lines, set);
        if let Some(name) = self.frame_name {
            let spot = (x, first + self.title.len() as f64 * (TITLE + 6.0));
            canvas.marked("frame-name", |canvas| {
                canvas.texts([(name, spot)], Type { size: TICK, bold: false, ..set });
            });
        }
    }

    /// Draws the layers in their frame, and its axes as `draw_axes` does; says what is taken.
    pub(super) fn draw_panel(
        &self,
        canvas: &mut Canvas,
        frame: &Frame,
        x_ticks: &[Tick],
        y_ticks: &[Tick],
        draw_axes: impl FnOnce(&mut Canvas),
    ) -> Taken {
        let (layers, rect) = (&self.plot.layers, &frame.rect);
        axes::draw_grid(canvas, frame, x_ticks, y_ticks);
        let mut taken = Taken::default();
        for layer in layers {
            marks::draw_region(canvas, frame, layer);
        }
        canvas.clipped(rect, |canvas| {
            for layer in layers {
                marks::draw(canvas, frame, layer, &mut taken);
            }
        });
        draw_axes(canvas);
        for layer in layers {
            marks::draw_markers(canvas, frame, layer, &mut taken);
        }
        if self.nothing {
            let set = Type { size: 16.0, colour: INK, align: Align::Centre, bold: false, upright: false };
            let middle = ((rect.left + rect.right) / 2.0, (rect.top + rect.bottom) / 2.0);
            canvas.texts([("no data", middle)], set);
            taken.text(Rect::new(middle.0 - 40.0, middle.1 - 12.0, 80.0, 24.0));
        }
        for layer in layers {
            draw_label(canvas, frame, layer, &mut taken);
        }
        if self.is_cut {
            draw_corner_note(canvas, rect, "cut at the frame", &mut taken);
        }
        taken
    }

    /// Names layers in the frame, or from `foot` on downwards; returns the y of the lower end.
    pub(super) fn draw_legend<'l>(
        &self,
        canvas: &mut Canvas,
        layers: impl IntoIterator<Item = &'l Layer> + Clone,
        rect: &Rect,
        taken: &Taken,
        foot: (f64, f64),
    ) -> f64 {
        let end = foot.1 + 6.0;
        if self.plot.legend == Legend::Hidden {
            return end;
        }
        let inside = entries(layers.clone(), 0.7 * rect.width());
        if inside.is_empty() {
            return end;
        }
        let (width, height) = inside_size(&inside);
        let inner = rect.grown(-9.0);
        let right = inner.right - width;
        let bottom = inner.bottom - height;
        let corners = [
            (Legend::TopRight, right, inner.top),
            (Legend::TopLeft, inner.left, inner.top),
            (Legend::BottomLeft, inner.left, bottom),
            (Legend::BottomRight, right, bottom),
        ]
        .map(|(name, left, top)| (Rect::new(left, top, width, height), name));
        let chosen = match self.plot.legend {
            _ if needs_scale(&inside) => None,
            Legend::Auto => taken.clearest(corners).filter(|(place, _)| {
                taken.under(place) == 0 && rect.holds((place.left, place.top)) && bottom > rect.top
            }),
            named => corners.into_iter().find(|(_, name)| *name == named),
        };
        if let Some((place, _)) = chosen {
            draw_inside(canvas, &inside, &place);
            return end;
        }
        end + draw_below(canvas, layers, (foot.0 + 16.0, foot.1), self.width - 32.0)
    }
}

/// The points of bands that count for the axes, given those of all else: a band may widen the axis by part of its range only,
/// so that it does not flatten its lines.
fn within_reach(plot: &Plot, others: &[(f64, f64)], bands: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let measured = others.iter().filter_map(|point| measure(plot.y.spread, point.1));
    let (low, high) = measured
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if high <= low {
        return bands;
    }
    let room = BAND_ROOM * (high - low);
    let back = |value: f64| if plot.y.spread == Spread::Log { 10f64.powf(value) } else { value };
    let limited = |(x, y): (f64, f64)| {
        let value = measure(plot.y.spread, y)?;
        let nearest = value.clamp(low - room, high + room);
        Some((x, if nearest == value { y } else { back(nearest) }))
    };
    bands.into_iter().filter_map(limited).collect()
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Legend {
    /// In a corner that is clear of the data, else below the plot.
    Auto,
    TopLeft,
    TopRight,
    BottomLeft,
    BottomRight,
    Below,
    Hidden,
}

/// Height of a row.
const ROW: f64 = 19.0;
/// Length of a key, and the gap to its name.
const KEY: (f64, f64) = (28.0, 7.0);
const PADDING: f64 = 7.0;
const BETWEEN: f64 = 22.0;

/// One name and the layers that bear it.
pub(super) struct Entry<'a> {
    name: String,
    layers: Vec<&'a Layer>,
    /// Key, gap and name.
    width: f64,
}

/// Entries in the order of the layers, none wider than `room`.
pub(super) fn entries<'a>(layers: impl IntoIterator<Item = &'a Layer>, room: f64) -> Vec<Entry<'a>> {
    let mut entries: Vec<(&str, Vec<&Layer>)> = Vec::new();
    for layer in layers {
        let Some(name) = layer.name.as_deref() else {
            continue;
        };
        match entries.iter_mut().find(|(known, _)| *known == name) {
            Some((_, group)) => group.push(layer),
            None => entries.push((name, vec![layer])),
        }
    }
    entries
        .into_iter()
        .map(|(name, layers)| {
            let name = fit(name, TICK, room - KEY.0 - KEY.1);
            let width = KEY.0 + KEY.1 + width(&name, TICK);
            Entry { name, layers, width }
        })
        .collect()
}

/// Width and height of a legend that stands inside the frame, one entry a row.
pub(super) fn inside_size(entries: &[Entry<'_>]) -> (f64, f64) {
    let widest = entries.iter().map(|entry| entry.width).fold(0.0, f64::max);
    (widest + 2.0 * PADDING, ROW * entries.len() as f64 + PADDING)
}

pub(super) fn draw_inside(canvas: &mut Canvas, entries: &[Entry<'_>], rect: &Rect) {
    canvas.rect(rect, PAPER, 0.85);
    let middle = |row: usize| rect.top + PADDING / 2.0 + ROW * (row as f64 + 0.5);
    draw(canvas, entries, |row| (rect.left + PADDING, middle(row)));
}

/// Whether curves that have an order are too many to be named one by one.
pub(super) fn needs_scale(entries: &[Entry<'_>]) -> bool {
    entries.iter().filter(|entry| entry.is_ordered()).count() > MOST_KEYS
}

impl Entry<'_> {
    fn is_ordered(&self) -> bool {
        self.layers.iter().all(|layer| matches!(layer.colour, Colour::Ordered { .. }))
    }
}

/// Names layers below a plot, from a corner on, in `room`: one by one, and those with an order on a colour scale where there
/// are too many. Returns the height.
pub(super) fn draw_below<'a>(
    canvas: &mut Canvas,
    layers: impl IntoIterator<Item = &'a Layer>,
    corner: Spot,
    room: f64,
) -> f64 {
    let entries = entries(layers, room);
    let has_scale = needs_scale(&entries);
    let (scale, single): (Vec<Entry<'_>>, Vec<Entry<'_>>) =
        entries.into_iter().partition(|entry| has_scale && entry.is_ordered());
    let mut height = 0.0;
    if !single.is_empty() {
        let (places, rows) = rows_below(&single, room);
        draw(canvas, &single, |k| places.get(k).map_or(corner, |at| (corner.0 + at.0, corner.1 + at.1)));
        height += rows;
    }
    if !scale.is_empty() {
        height += draw_scale(canvas, &scale, (corner.0, corner.1 + height), room);
    }
    height
}

/// A row of coloured cells with the names below, or several where they do not fit; returns the height.
fn draw_scale(canvas: &mut Canvas, entries: &[Entry<'_>], corner: Spot, room: f64) -> f64 {
    const CELL: f64 = 11.0;
    const GAP: f64 = 4.0;
    let widest = entries.iter().map(|entry| entry.width - KEY.0 - KEY.1).fold(0.0, f64::max) + 8.0;
    let columns = ((room / widest).floor().max(1.0) as usize).min(entries.len());
    let rows = entries.len().div_ceil(columns);
    let columns = entries.len().div_ceil(rows);
    let width = (room / columns as f64).min(72.0);
    let left = corner.0 + (room - width * columns as f64) / 2.0;
    let step = CELL + GAP + ROW;
    let place =
        |k: usize| (left + width * (k % columns) as f64, corner.1 + GAP + step * (k / columns) as f64);
    for (k, entry) in entries.iter().enumerate() {
        let (x, y) = place(k);
        if let Some(layer) = entry.layers.first() {
            canvas.rect(&Rect::new(x, y, width, CELL), layer.colour.rgb(), 1.0);
        }
    }
    let set = Type { size: TICK, colour: INK, align: Align::Centre, bold: false, upright: false };
    let names = entries.iter().enumerate().map(|(k, entry)| {
        let (x, y) = place(k);
        (entry.name.as_str(), (x + width / 2.0, y + CELL + GAP + ROW / 2.0))
    });
    canvas.texts(names, set);
    step * rows as f64 + GAP
}

/// Rows of entries that fit a width: the places of the entries, and the height of all.
fn rows_below(entries: &[Entry<'_>], room: f64) -> (Vec<Spot>, f64) {
    let all: f64 = entries.iter().map(|entry| entry.width + BETWEEN).sum::<f64>() - BETWEEN;
    if all <= room {
        let mut left = (room - all) / 2.0;
        let step = |entry: &Entry<'_>| {
            let place = (left, 0.5 * ROW);
            left += entry.width + BETWEEN;
            place
        };
        return (entries.iter().map(step).collect(), ROW);
    }
    // Over several rows, columns of one width look tidier.
    let widest = entries.iter().map(|entry| entry.width).fold(0.0, f64::max);
    let columns = ((room + BETWEEN) / (widest + BETWEEN)).floor().max(1.0) as usize;
    let columns = columns.min(entries.len().max(1));
    let rows = entries.len().div_ceil(columns);
    // No more columns than the rows need.
    let columns = entries.len().div_ceil(rows.max(1)).max(1);
    let step = widest + BETWEEN;
    let left = (room - (step * columns as f64 - BETWEEN)).max(0.0) / 2.0;
    let places = (0..entries.len())
        .map(|k| (left + step * (k % columns) as f64, ROW * ((k / columns) as f64 + 0.5)))
        .collect();
    (places, ROW * rows as f64)
}

fn draw(canvas: &mut Canvas, entries: &[Entry<'_>], place: impl Fn(usize) -> Spot) {
    for (k, entry) in entries.iter().enumerate() {
        let (x, y) = place(k);
        let key = Rect { left: x, top: y - 5.0, right: x + KEY.0, bottom: y + 5.0 };
        for layer in &entry.layers {
            draw_key(canvas, layer, &key);
        }
    }
    let set = Type { size: TICK, colour: INK, align: Align::Left, bold: false, upright: false };
    let texts = entries.iter().enumerate().map(|(k, entry)| {
        let (x, y) = place(k);
        (entry.name.as_str(), (x + KEY.0 + KEY.1, y))
    });
    canvas.texts(texts, set);
}
