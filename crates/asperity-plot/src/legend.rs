//! The names of the layers, each with a sample of how it is drawn.

use super::Colour;
use super::canvas::{Align, Canvas, Rect, Spot, Type};
use super::layer::Layer;
use super::marks::draw_key;
use super::style::{INK, MOST_KEYS, PAPER, TICK};
use super::text::{fit, width};

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
