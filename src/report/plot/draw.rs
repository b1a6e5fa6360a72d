//! Puts a figure together.

use super::axes::{self, FOOT, Frame, INK, LABEL};
use super::canvas::{Align, Canvas, Rect, Type};
use super::layer::{Direction, Layer, Shape};
use super::legend::{self, Entry, Legend};
use super::marks;
use super::place::Taken;
use super::scale::{Scale, measure};
use super::text::{fit, width, wrap};
use super::ticks::Tick;
use super::{Arrangement, Plot};
use plotters::style::RGBColor;

const WIDTH: f64 = 720.0;
const TITLE: f64 = 15.0;
/// Bold letters are wider, in some fonts much.
const BOLD: f64 = 1.25;
const NOTE: f64 = 12.5;

pub(super) fn figure(title: &str, plots: &[&Plot], arrangement: Arrangement) -> String {
    let mut canvas = Canvas::default();
    let (mut width, mut height) = (WIDTH, 0.0_f64);
    match arrangement {
        Arrangement::Column => {
            let sketches: Vec<Sketch<'_>> = plots.iter().map(|plot| Sketch::new(plot, WIDTH)).collect();
            let left = sketches.iter().map(|sketch| sketch.margins.0).fold(0.0, f64::max);
            let right = sketches.iter().map(|sketch| sketch.margins.1).fold(0.0, f64::max);
            for sketch in &sketches {
                height = sketch.draw(&mut canvas, (0.0, height), (left, right), sketch.head());
            }
        }
        Arrangement::Row => {
            width = 1.5 * WIDTH;
            let each = width / plots.len().max(1) as f64;
            let sketches: Vec<Sketch<'_>> = plots.iter().map(|plot| Sketch::new(plot, each)).collect();
            let head = sketches.iter().map(Sketch::head).fold(0.0, f64::max);
            for (k, sketch) in sketches.iter().enumerate() {
                height = height.max(sketch.draw(&mut canvas, (each * k as f64, 0.0), sketch.margins, head));
            }
        }
    }
    canvas.finish(title, width, height.max(1.0))
}

/// A plot whose axes are known, but not yet its place.
struct Sketch<'a> {
    plot: &'a Plot,
    width: f64,
    x: Scale,
    y: Scale,
    y_ticks: Vec<Tick>,
    /// Left and right of the frame.
    margins: (f64, f64),
    title: Vec<String>,
    nothing: bool,
}

impl<'a> Sketch<'a> {
    fn new(plot: &'a Plot, width: f64) -> Self {
        // Only a point that both axes can show counts for either.
        let shown: Vec<(f64, f64)> = plot
            .layers
            .iter()
            .flat_map(Layer::reach)
            .filter(|p| measure(plot.x.spread, p.0).is_some() && measure(plot.y.spread, p.1).is_some())
            .collect();
        let x = Scale::new(&plot.x, shown.iter().map(|p| p.0), false);
        let stands = plot.layers.iter().any(|layer| matches!(layer.shape, Shape::Bars(_)));
        let y = Scale::new(&plot.y, shown.iter().map(|p| p.1), stands);
        let y_ticks = axes::y_ticks(&y, plot.height);
        let margins =
            (axes::left_margin(&plot.y, &y_ticks), axes::right_margin(&axes::x_ticks(&x, 0.8 * width)));
        let title = wrap(&plot.title, BOLD * TITLE, width - 30.0, 3);
        Self { plot, width, x, y, y_ticks, margins, title, nothing: shown.is_empty() }
    }

    /// Height of the title.
    fn head(&self) -> f64 {
        self.title.len() as f64 * (TITLE + 6.0)
    }

    /// Draws the plot with its upper left corner at a place and the frame below `head`; returns the
    /// y of its lower end.
    fn draw(&self, canvas: &mut Canvas, corner: (f64, f64), margins: (f64, f64), head: f64) -> f64 {
        let plot = self.plot;
        let frame_width = (self.width - margins.0 - margins.1).max(60.0);
        let left = corner.0 + margins.0;
        let top = corner.1 + 10.0 + head;
        // A title longer than the frame starts at the edge of the page.
        let longest = self.title.iter().map(|line| width(line, BOLD * TITLE)).fold(0.0, f64::max);
        let x = if longest > frame_width { corner.0 + 12.0 } else { left };
        let first = top - self.head() + TITLE / 2.0;
        let lines = self.title.iter().enumerate();
        let lines = lines.map(|(k, line)| (line.as_str(), (x, first + k as f64 * (TITLE + 6.0))));
        canvas
            .texts(lines, Type { size: TITLE, colour: INK, align: Align::Left, bold: true, upright: false });

        let rect = Rect::new(left, top + 2.0, frame_width, plot.height);
        let frame = Frame { x: self.x, y: self.y, rect };
        let x_ticks = axes::x_ticks(&self.x, frame_width);

        axes::draw_grid(canvas, &frame, &x_ticks, &self.y_ticks);
        let mut taken = Taken::default();
        for layer in &plot.layers {
            marks::draw_region(canvas, &frame, layer);
        }
        canvas.clipped(&rect, |canvas| {
            for layer in &plot.layers {
                marks::draw(canvas, &frame, layer, &mut taken);
            }
        });
        axes::draw_axes(canvas, plot, &frame, &x_ticks, &self.y_ticks, corner.0 + 6.0 + LABEL / 2.0);
        for layer in &plot.layers {
            marks::draw_markers(canvas, &frame, layer, &mut taken);
        }
        if self.nothing {
            let set = Type { size: 16.0, colour: INK, align: Align::Centre, bold: false, upright: false };
            let middle = ((rect.left + rect.right) / 2.0, (rect.top + rect.bottom) / 2.0);
            canvas.texts([("no data", middle)], set);
            taken.text(Rect::new(middle.0 - 40.0, middle.1 - 12.0, 80.0, 24.0));
        }
        for layer in &plot.layers {
            draw_label(canvas, &frame, layer, &mut taken);
        }
        let bottom = rect.bottom + if plot.x.label.is_empty() { FOOT - LABEL - 8.0 } else { FOOT };
        self.draw_legend(canvas, &rect, &taken, (corner.0, bottom))
    }

    fn draw_legend(&self, canvas: &mut Canvas, rect: &Rect, taken: &Taken, foot: (f64, f64)) -> f64 {
        let inside = legend::entries(&self.plot.layers, 0.7 * rect.width());
        let end = foot.1 + 6.0;
        if inside.is_empty() || self.plot.legend == Legend::Hidden {
            return end;
        }
        let (width, height) = legend::inside_size(&inside);
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
            Legend::Auto => taken.clearest(corners).filter(|(place, _)| {
                taken.under(place) == 0 && rect.holds((place.left, place.top)) && bottom > rect.top
            }),
            named => corners.into_iter().find(|(_, name)| *name == named),
        };
        if let Some((place, _)) = chosen {
            legend::draw_inside(canvas, &inside, &place);
            return end;
        }
        let room = self.width - 32.0;
        let entries: Vec<Entry<'_>> = legend::entries(&self.plot.layers, room);
        let (places, height) = legend::rows_below(&entries, room);
        legend::draw_below(canvas, &entries, &places, (foot.0 + 16.0, foot.1));
        end + height
    }
}

/// Writes the label of a region, reference or note where it covers least.
fn draw_label(canvas: &mut Canvas, frame: &Frame, layer: &Layer, taken: &mut Taken) {
    if layer.label.is_empty() {
        return;
    }
    let length = match layer.shape {
        Shape::Level(Direction::X, _) => frame.rect.height(),
        Shape::Region(Direction::X, ..) => frame.rect.height().min(frame.rect.width()),
        _ => frame.rect.width(),
    };
    let label = fit(&layer.label, NOTE, length - 24.0);
    let size = (width(&label, NOTE) + 4.0, NOTE + 4.0);
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
        canvas.rect(&rect, RGBColor(255, 255, 255), 0.75);
    }
    let middle = ((rect.left + rect.right) / 2.0, (rect.top + rect.bottom) / 2.0);
    let set =
        Type { size: NOTE, colour: RGBColor(0x44, 0x44, 0x44), align: Align::Centre, bold: false, upright };
    canvas.texts([(label.as_str(), middle)], set);
    taken.text(rect);
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
