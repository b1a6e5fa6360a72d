//! Labels of reference lines, regions and points, and places away from the data for them and the legend.

use plotters::style::RGBColor;

use crate::axes::Frame;
use crate::canvas::{Align, Canvas, Rect, Spot, Type};
use crate::layer::{Direction, Layer, Shape};
use crate::marks;
use crate::style::{NOTE_INK, ON_DARK, ON_LIGHT, PAPER, TICK};
use crate::text::{fit, shrunk, width};

/// Writes the label of a region, reference or note where it covers least.
pub(super) fn draw_label(canvas: &mut Canvas, frame: &Frame, layer: &Layer, taken: &mut Taken) {
    if layer.label.is_empty() {
        return;
    }
    if let Some(rect) = marks::tile(frame, layer) {
        write_in(canvas, &rect, layer);
        return;
    }
    let length = match layer.shape {
        Shape::Level(Direction::X, _) => frame.rect.height(),
        Shape::Region(Direction::X, ..) => frame.rect.height().min(frame.rect.width()),
        _ => frame.rect.width(),
    };
    let label = fit(&layer.label, TICK, length - 24.0);
    let size = (width(&label, TICK) + 4.0, TICK + 4.0);
    let candidates: Vec<(Rect, bool)> = match &layer.shape {
        Shape::Region(direction, ..) => match marks::region(frame, layer) {
            Some(area) => in_region(&area, *direction, size),
            None => return,
        },
        Shape::Level(direction, _) => marks::reference(frame, layer)
            .iter()
            .flat_map(|line| beside_level(frame, line[0], *direction, size))
            .collect(),
        Shape::Slope { .. } => marks::reference(frame, layer)
            .iter()
            .flat_map(|line| along(frame, line[0], line[1], size))
            .collect(),
        Shape::Note(at) => match frame.spot(*at) {
            Some(spot) => around(spot, size),
            None => return,
        },
        _ => return,
    };
    let page = frame.rect.grown(-2.0);
    let inside = |rect: &Rect| page.holds((rect.left, rect.top)) && page.holds((rect.right, rect.bottom));
    let mut fitting: Vec<(Rect, bool)> =
        candidates.iter().filter(|(rect, _)| inside(rect)).copied().collect();
    if fitting.is_empty() && !matches!(layer.shape, Shape::Slope { .. }) {
        fitting = candidates.into_iter().map(|(rect, upright)| (rect.moved_into(&page), upright)).collect();
    }
    let Some((rect, upright)) = taken.clearest(fitting) else {
        return;
    };
    if taken.under(&rect) > 0 {
        canvas.rect(&rect, PAPER, 0.75);
    }
    let middle = ((rect.left + rect.right) / 2.0, (rect.top + rect.bottom) / 2.0);
    let set = Type { size: TICK, colour: NOTE_INK, align: Align::Centre, bold: false, upright };
    canvas.texts([(label.as_str(), middle)], set);
    taken.text(rect);
}

/// Writes a note into the corner of a frame where it covers least.
pub(super) fn draw_corner_note(canvas: &mut Canvas, frame: &Rect, text: &str, taken: &mut Taken) {
    let size = (width(text, TICK) + 4.0, TICK + 4.0);
    let corners = in_region(frame, Direction::Y, size);
    let Some((rect, _)) = taken.clearest(corners) else { return };
    canvas.rect(&rect, PAPER, 0.75);
    let middle = ((rect.left + rect.right) / 2.0, (rect.top + rect.bottom) / 2.0);
    let set = Type { size: TICK, colour: NOTE_INK, align: Align::Centre, bold: false, upright: false };
    canvas.texts([(text, middle)], set);
    taken.text(rect);
}

/// Writes the label of a tile into its middle, dark or light as the tile is light or dark.
fn write_in(canvas: &mut Canvas, tile: &Rect, layer: &Layer) {
    let (label, size) = shrunk(&layer.label, TICK, tile.width() - 4.0);
    let RGBColor(red, green, blue) = layer.colour.rgb();
    let luminance = 0.299 * f64::from(red) + 0.587 * f64::from(green) + 0.114 * f64::from(blue);
    let colour = if luminance > 140.0 { ON_LIGHT } else { ON_DARK };
    let middle = ((tile.left + tile.right) / 2.0, (tile.top + tile.bottom) / 2.0);
    let set = Type { size, colour, align: Align::Centre, bold: false, upright: false };
    canvas.texts([(label.as_str(), middle)], set);
}

/// In the corners of a region; upright too where it is narrow.
fn in_region(area: &Rect, direction: Direction, size: (f64, f64)) -> Vec<(Rect, bool)> {
    let inner = area.grown(-6.0);
    let corners = |size: (f64, f64), upright: bool| {
        let (right, bottom) = (inner.right - size.0, inner.bottom - size.1);
        let middle = (inner.left + inner.right - size.0) / 2.0;
        [
            (inner.left, inner.top),
            (right, inner.top),
            (middle, inner.top),
            (inner.left, bottom),
            (right, bottom),
            (middle, bottom),
        ]
        .map(|(left, top)| (Rect::new(left, top, size.0, size.1), upright))
    };
    // Text stays inside its region if it can.
    if direction == Direction::X && size.0 > inner.width() {
        return corners((size.1, size.0), true).into();
    }
    corners(size, false).into()
}

/// On both sides of a level line, near its ends.
fn beside_level(
    frame: &Frame,
    start: (f64, f64),
    direction: Direction,
    size: (f64, f64),
) -> Vec<(Rect, bool)> {
    let r = frame.rect.grown(-5.0);
    match direction {
        Direction::Y => [start.1 - size.1 - 2.0, start.1 + 2.0]
            .into_iter()
            .flat_map(|top| {
                [r.left + 4.0, r.right - size.0 - 4.0, (r.left + r.right - size.0) / 2.0].map(|x| (x, top))
            })
            .map(|(left, top)| (Rect::new(left, top, size.0, size.1), false))
            .collect(),
        Direction::X => {
            let size = (size.1, size.0);
            [start.0 + 2.0, start.0 - size.0 - 2.0]
                .into_iter()
                .flat_map(|left| [r.top + 4.0, r.bottom - size.1 - 4.0].map(|top| (left, top)))
                .map(|(left, top)| (Rect::new(left, top, size.0, size.1), true))
                .collect()
        }
    }
}

/// Above and below a slope at some places along it.
fn along(frame: &Frame, from: (f64, f64), to: (f64, f64), size: (f64, f64)) -> Vec<(Rect, bool)> {
    let slope = (to.1 - from.1) / (to.0 - from.0);
    // A box clears the line if its nearer corner does.
    let clear = slope.abs() * size.0 / 2.0 + 3.0;
    (1..20)
        .map(|k| frame.rect.left + frame.rect.width() * f64::from(k) / 20.0)
        .map(|x| (x, from.1 + slope * (x - from.0)))
        .flat_map(|(x, y)| [(x, y - clear - size.1), (x, y + clear)])
        .map(|(x, top)| (Rect::new(x - size.0 / 2.0, top, size.0, size.1), false))
        .collect()
}

/// On the four sides of a point.
fn around(spot: (f64, f64), size: (f64, f64)) -> Vec<(Rect, bool)> {
    let (x, y) = spot;
    let level = y - size.1 / 2.0;
    let centred = x - size.0 / 2.0;
    [(x + 8.0, level), (x - size.0 - 8.0, level), (centred, y - size.1 - 7.0), (centred, y + 7.0)]
        .into_iter()
        .map(|(left, top)| (Rect::new(left, top, size.0, size.1), false))
        .collect()
}

/// Distance between the dots that stand for a line, in CSS pixels.
pub(super) const PITCH: f64 = 5.0;

/// What is already on the page: data as dots, texts as boxes.
#[derive(Default)]
pub(super) struct Taken {
    dots: Vec<Spot>,
    boxes: Vec<Rect>,
}

impl Taken {
    pub(super) fn dot(&mut self, spot: Spot) {
        self.dots.push(spot);
    }

    pub(super) fn line(&mut self, line: &[Spot], page: &Rect) {
        for pair in line.windows(2) {
            let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
            // The count is bounded for lines that leave the page by far.
            let steps = (dx.hypot(dy) / PITCH).ceil().clamp(1.0, 2000.0) as usize;
            let dots = (0..=steps).map(|k| {
                let part = k as f64 / steps as f64;
                (pair[0].0 + part * dx, pair[0].1 + part * dy)
            });
            self.dots.extend(dots.filter(|dot| page.holds(*dot)));
        }
    }

    /// The whole area between two edges of as many spots, each pair one above the other.
    pub(super) fn area(&mut self, lower: &[Spot], upper: &[Spot], page: &Rect) {
        for (low, high) in lower.windows(2).zip(upper.windows(2)) {
            let steps = ((low[1].0 - low[0].0).abs() / PITCH).ceil().clamp(1.0, 500.0) as usize;
            for step in 0..=steps {
                let part = step as f64 / steps as f64;
                let at = |pair: &[Spot]| pair[0].1 + part * (pair[1].1 - pair[0].1);
                let x = low[0].0 + part * (low[1].0 - low[0].0);
                let (top, bottom) = (at(low).min(at(high)), at(low).max(at(high)));
                self.line(&[(x, top.max(page.top)), (x, bottom.min(page.bottom))], page);
            }
        }
    }

    pub(super) fn text(&mut self, rect: Rect) {
        self.boxes.push(rect);
    }

    /// How much a box would cover; nothing if 0.
    pub(super) fn under(&self, rect: &Rect) -> usize {
        let rect = rect.grown(3.0);
        let dots = self.dots.iter().filter(|dot| rect.holds(**dot)).count();
        let boxes = self.boxes.iter().filter(|other| other.meets(&rect)).count();
        dots + 30 * boxes
    }

    /// The first of the boxes that cover least.
    pub(super) fn clearest<T>(&self, places: impl IntoIterator<Item = (Rect, T)>) -> Option<(Rect, T)> {
        places.into_iter().min_by_key(|(rect, _)| self.under(rect))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_area_is_taken_between_its_corners_too() {
        let page = Rect::new(0.0, 0.0, 300.0, 100.0);
        let mut taken = Taken::default();
        taken.area(&[(0.0, 500.0), (300.0, 500.0)], &[(0.0, 50.0), (300.0, 50.0)], &page);
        assert!(taken.under(&Rect::new(140.0, 70.0, 20.0, 10.0)) > 0);
        assert_eq!(taken.under(&Rect::new(140.0, 20.0, 20.0, 10.0)), 0);
    }

    #[test]
    fn the_box_beside_the_line_is_chosen() {
        let page = Rect::new(0.0, 0.0, 100.0, 100.0);
        let mut taken = Taken::default();
        taken.line(&[(0.0, 0.0), (100.0, 100.0)], &page);
        let on = Rect::new(10.0, 10.0, 20.0, 20.0);
        let beside = Rect::new(70.0, 5.0, 20.0, 20.0);
        assert!(taken.under(&on) > 0);
        assert_eq!(taken.clearest([(on, 1), (beside, 2)]), Some((beside, 2)));
        taken.text(beside);
        assert_eq!(taken.clearest([(on, 1), (beside, 2)]), Some((on, 1)));
    }
}
