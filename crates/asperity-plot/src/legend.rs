//! The names of the layers, each with a sample of how it is drawn.

use super::axes::{INK, TICK};
use super::canvas::{Align, Canvas, Rect, Spot, Type};
use super::layer::Layer;
use super::marks::draw_key;
use super::text::{fit, width};
use plotters::style::RGBColor;

/// Position of the legend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Legend {
    /// In a corner that is clear of the data, else below the plot.
    Auto,
    /// Inside, at the top left.
    TopLeft,
    /// Inside, at the top right.
    TopRight,
    /// Inside, at the bottom left.
    BottomLeft,
    /// Inside, at the bottom right.
    BottomRight,
    /// Below the plot.
    Below,
    /// Nowhere.
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
    canvas.rect(rect, RGBColor(255, 255, 255), 0.85);
    let middle = |row: usize| rect.top + PADDING / 2.0 + ROW * (row as f64 + 0.5);
    draw(canvas, entries, |row| (rect.left + PADDING, middle(row)));
}

/// Rows of entries that fit a width: the places of the entries, and the height of all.
pub(super) fn rows_below(entries: &[Entry<'_>], room: f64) -> (Vec<Spot>, f64) {
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

pub(super) fn draw_below(canvas: &mut Canvas, entries: &[Entry<'_>], places: &[Spot], corner: Spot) {
    draw(canvas, entries, |k| places.get(k).map_or(corner, |place| (corner.0 + place.0, corner.1 + place.1)));
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
