//! The frame of a plot: its grid, ticks and labels, and its colour bar.

use crate::Axis;
use crate::canvas::{Align, Canvas, Rect, Spot, Stroke, Type};
use crate::colour::order_palette;
use crate::layer::Direction;
use crate::raster::{Raster, encode, palette};
use crate::style::{FINE_GRID, GRID, INK, LABEL, TICK};
use crate::text::{shrunk, width};
use crate::ticks::{Scale, Tick, ticks};

/// Length of a tick.
const MARK: f64 = 5.0;
/// Below the frame: ticks, their labels, the axis label.
pub(super) const FOOT: f64 = 50.0;

/// Places farther away, in frames, are as good as this far.
const FAR: f64 = 1e6;

/// Both scales, laid on a rectangle of the page.
pub(super) struct Frame {
    pub(super) x: Scale,
    pub(super) y: Scale,
    pub(super) rect: Rect,
}

impl Frame {
    /// The place of a value along an axis.
    pub(super) fn on(&self, axis: Direction, value: f64) -> Option<f64> {
        match axis {
            Direction::X => self.x(value),
            Direction::Y => self.y(value),
        }
    }

    /// Where an axis begins.
    pub(super) fn start(&self, axis: Direction) -> f64 {
        match axis {
            Direction::X => self.rect.left,
            Direction::Y => self.rect.bottom,
        }
    }

    pub(super) fn x(&self, value: f64) -> Option<f64> {
        self.x.place(value).map(|place| self.rect.left + place.clamp(-FAR, FAR) * self.rect.width())
    }

    pub(super) fn y(&self, value: f64) -> Option<f64> {
        self.y.place(value).map(|place| self.rect.bottom - place.clamp(-FAR, FAR) * self.rect.height())
    }

    pub(super) fn spot(&self, point: (f64, f64)) -> Option<Spot> {
        Some((self.x(point.0)?, self.y(point.1)?))
    }
}

/// Ticks of the x axis with labels that do not overlap.
pub(super) fn x_ticks(scale: &Scale, length: f64) -> Vec<Tick> {
    x_ticks_up_to((length / 45.0) as usize, scale, length)
}

/// As [`x_ticks`], with a number of labels not to exceed.
pub(super) fn x_ticks_up_to(most: usize, scale: &Scale, length: f64) -> Vec<Tick> {
    ticks(scale, most, |ticks| {
        let mut spans: Vec<(f64, f64)> = labelled(ticks)
            .map(|(place, label)| (place * length, width(label, TICK) / 2.0))
            .map(|(middle, half)| (middle - half, middle + half))
            .collect();
        spans.sort_by(|a, b| a.0.total_cmp(&b.0));
        spans.windows(2).all(|pair| pair[1].0 - pair[0].1 > 12.0)
    })
}

/// Ticks of a scale along y with labels that do not overlap.
pub(super) fn y_ticks(scale: &Scale, length: f64) -> Vec<Tick> {
    y_ticks_up_to((length / 36.0) as usize, scale, length)
}

/// Ticks of the y axis: those of its scale, or its named places.
pub(super) fn ticks_of_y(axis: &Axis, scale: &Scale, length: f64) -> Vec<Tick> {
    if axis.names.is_empty() { y_ticks(scale, length) } else { named_ticks(axis, scale) }
}

/// The same of the x axis, with as many of the names as do not touch.
pub(super) fn ticks_of_x(axis: &Axis, scale: &Scale, length: f64) -> Vec<Tick> {
    if axis.names.is_empty() {
        return x_ticks(scale, length);
    }
    let widest = axis.names.iter().map(|name| width(name, TICK)).fold(0.0, f64::max) + 8.0;
    let every = (widest * axis.names.len() as f64 / length).ceil().max(1.0) as usize;
    let mut ticks = named_ticks(axis, scale);
    ticks.iter_mut().enumerate().filter(|(k, _)| k % every > 0).for_each(|(_, tick)| tick.label = None);
    ticks
}

fn named_ticks(axis: &Axis, scale: &Scale) -> Vec<Tick> {
    let tick = |(index, name): (usize, &String)| Tick {
        place: scale.place_measured(index as f64),
        label: Some(name.clone()),
    };
    axis.names.iter().enumerate().map(tick).collect()
}

/// As [`y_ticks`], with a number of labels not to exceed.
pub(super) fn y_ticks_up_to(most: usize, scale: &Scale, length: f64) -> Vec<Tick> {
    ticks(scale, most, |ticks| {
        let mut places: Vec<f64> = labelled(ticks).map(|(place, _)| place * length).collect();
        places.sort_by(f64::total_cmp);
        places.windows(2).all(|pair| pair[1] - pair[0] > 1.4 * TICK)
    })
}

pub(super) fn labelled(ticks: &[Tick]) -> impl Iterator<Item = (f64, &str)> {
    ticks.iter().filter_map(|tick| tick.label.as_deref().map(|label| (tick.place, label)))
}

/// Width of the y axis left of the frame.
pub(super) fn left_margin(y: &Axis, ticks: &[Tick]) -> f64 {
    let widest = labelled(ticks).map(|(_, label)| width(label, TICK)).fold(0.0, f64::max);
    let label = if y.label.is_empty() { 0.0 } else { LABEL + 8.0 };
    8.0 + label + widest + MARK + 5.0
}

/// Margin right of the frame: half of the last x label may extend beyond it.
pub(super) fn right_margin(x_ticks: &[Tick]) -> f64 {
    let out = labelled(x_ticks).filter(|(place, _)| *place > 0.9).map(|(_, label)| width(label, TICK) / 2.0);
    out.fold(14.0, f64::max) + 4.0
}

/// Grid lines, to lie below the data.
pub(super) fn draw_grid(canvas: &mut Canvas, frame: &Frame, x_ticks: &[Tick], y_ticks: &[Tick]) {
    let r = &frame.rect;
    for (fine, colour) in [(true, FINE_GRID), (false, GRID)] {
        let chosen = |tick: &&Tick| tick.label.is_none() == fine;
        let upright = x_ticks.iter().filter(chosen).map(|tick| {
            let x = r.left + tick.place * r.width();
            [(x, r.top), (x, r.bottom)]
        });
        let level = y_ticks.iter().filter(chosen).map(|tick| {
            let y = r.bottom - tick.place * r.height();
            [(r.left, y), (r.right, y)]
        });
        let lines: Vec<[Spot; 2]> = upright.chain(level).collect();
        canvas.lines(lines.iter().map(|line| line.as_slice()), Stroke::solid(colour, 0.7));
    }
}

/// Frame, ticks and labels, to lie above the data. An axis that is not `named` shows its ticks only.
pub(super) fn draw_axes(
    canvas: &mut Canvas,
    frame: &Frame,
    x_ticks: &[Tick],
    y_ticks: &[Tick],
    named: (Option<&Axis>, Option<&Axis>),
    label_x: f64,
) {
    let r = &frame.rect;
    let mut lines: Vec<Vec<Spot>> = vec![r.outline().to_vec()];
    // Ticks point inwards on all four sides, as in print.
    let length = |tick: &Tick| {
        if tick.label.is_some() { MARK } else { 0.55 * MARK }
    };
    for tick in x_ticks {
        let x = r.left + tick.place * r.width();
        lines.push(vec![(x, r.bottom), (x, r.bottom - length(tick))]);
        lines.push(vec![(x, r.top), (x, r.top + length(tick))]);
    }
    for tick in y_ticks {
        let y = r.bottom - tick.place * r.height();
        lines.push(vec![(r.left, y), (r.left + length(tick), y)]);
        lines.push(vec![(r.right, y), (r.right - length(tick), y)]);
    }
    canvas.lines(lines.iter().map(Vec::as_slice), Stroke::solid(INK, 1.0));

    let set = Type { size: TICK, colour: INK, align: Align::Centre, bold: false, upright: false };
    if named.0.is_some() {
        let below = r.bottom + 8.0 + TICK / 2.0;
        let texts = labelled(x_ticks).map(|(place, label)| (label, (r.left + place * r.width(), below)));
        canvas.texts(texts, set);
    }
    if named.1.is_some() {
        let place = |place: f64| (r.left - 6.0, r.bottom - place * r.height());
        let texts = labelled(y_ticks).map(|(at, label)| (label, place(at)));
        canvas.texts(texts, Type { align: Align::Right, ..set });
    }

    let set = Type { size: LABEL, ..set };
    // A label may be as long as the frame and what stands beside it.
    if let Some(x) = named.0 {
        let (label, size) = shrunk(&x.label, LABEL, r.width() + 80.0);
        let spot = ((r.left + r.right) / 2.0, r.bottom + FOOT - 12.0);
        canvas.texts([(label.as_str(), spot)], Type { size, ..set });
    }
    if let Some(y) = named.1 {
        let (label, size) = shrunk(&y.label, LABEL, r.height() + 30.0);
        let spot = (label_x, (r.top + r.bottom) / 2.0);
        canvas.texts([(label.as_str(), spot)], Type { upright: true, size, ..set });
    }
}

/// From the frame to the bar.
const GAP: f64 = 16.0;
const WIDTH: f64 = 14.0;
const BAR_MARK: f64 = 4.0;

pub(super) struct Bar<'a> {
    label: &'a str,
    /// Those behind a transparent one.
    colours: Vec<[u8; 3]>,
    ticks: Vec<Tick>,
}

impl<'a> Bar<'a> {
    /// A bar of a length for a field; none if it shows nothing.
    pub(super) fn of_field(raster: &'a Raster, length: f64) -> Option<Self> {
        let scale = raster.scale()?;
        Some(Self { label: &raster.label, colours: palette(raster.map), ticks: y_ticks(&scale, length) })
    }

    /// The same for lines whose colours follow the values of an axis, which has a range.
    pub(super) fn of_order(axis: &'a Axis, length: f64) -> Self {
        let (from, to) = axis.range.unwrap_or((0.0, 1.0));
        let scale = Scale::new(axis, [from, to].into_iter(), false);
        Self { label: &axis.label, colours: order_palette(), ticks: y_ticks(&scale, length) }
    }

    /// Its width right of the frame.
    pub(super) fn room(&self) -> f64 {
        GAP + WIDTH + self.numbers() + if self.label.is_empty() { 0.0 } else { LABEL + 6.0 } + 6.0
    }

    /// Room for the numbers and their ticks.
    fn numbers(&self) -> f64 {
        let widest = labelled(&self.ticks).map(|(_, label)| width(label, TICK)).fold(0.0, f64::max);
        BAR_MARK + 4.0 + widest
    }

    /// Draws the bar right of a frame and as high.
    pub(super) fn draw(&self, canvas: &mut Canvas, frame: &Rect) {
        let bar = Rect::new(frame.right + GAP, frame.top, WIDTH, frame.height());
        let indices: Vec<u8> = (1..=255).rev().collect();
        if let Some(image) = encode(&indices, [1, indices.len()], &self.colours, &[0]) {
            canvas.image(&bar, &image);
        }
        let mut lines: Vec<Vec<Spot>> = vec![bar.outline().to_vec()];
        let place = |tick: &Tick| bar.bottom - tick.place * bar.height();
        for tick in &self.ticks {
            let mark = if tick.label.is_some() { BAR_MARK } else { 0.5 * BAR_MARK };
            lines.push(vec![(bar.right, place(tick)), (bar.right + mark, place(tick))]);
        }
        canvas.lines(lines.iter().map(Vec::as_slice), Stroke::solid(INK, 1.0));
        let set = Type { size: TICK, colour: INK, align: Align::Left, bold: false, upright: false };
        let numbers = labelled(&self.ticks)
            .map(|(at, label)| (label, (bar.right + BAR_MARK + 4.0, bar.bottom - at * bar.height())));
        canvas.texts(numbers, set);
        if self.label.is_empty() {
            return;
        }
        let (label, size) = shrunk(self.label, LABEL, bar.height() + 30.0);
        let spot = (bar.right + self.numbers() + 6.0 + LABEL / 2.0, (bar.top + bar.bottom) / 2.0);
        let set = Type { size, align: Align::Centre, upright: true, ..set };
        canvas.texts([(label.as_str(), spot)], set);
    }
}

#[cfg(test)]
mod tests {
    use crate::{Axis, Colour, Figure, Layer, Plot};

    #[test]
    fn named_places_along_x_have_as_many_names_as_fit() {
        let names = |count: usize| {
            let axis = Axis::named((0..count).map(|k| format!("place {k}"))).range(-0.5, count as f64 - 0.5);
            let tile = Layer::tile((-0.4, -0.4), (0.4, 0.4), "=");
            let svg =
                Figure::from(Plot::new("", axis.labelled("where"), Axis::named(["a".to_owned()])).with(tile))
                    .file(None);
            assert!(svg.contains("where"), "{svg}");
            svg.matches("place ").count()
        };
        assert_eq!(names(4), 4);
        assert!((5..15).contains(&names(40)));
    }

    #[test]
    fn lines_of_an_order_have_a_bar_in_the_colours_of_its_ends() {
        let axis = Axis::log("thickness (nm)").range(1.0, 100.0);
        assert_eq!(Plot::colour_at(&axis, 1.0), Colour::Ordered { index: 0, of: 255 });
        assert_eq!(Plot::colour_at(&axis, 10.0), Colour::Ordered { index: 127, of: 255 });
        assert_eq!(Plot::colour_at(&axis, 1000.0), Colour::Ordered { index: 254, of: 255 });
        let line = Layer::line([(1.0, 1.0), (2.0, 3.0)]).coloured(Plot::colour_at(&axis, 10.0));
        let plot = Plot::new("", Axis::linear("x"), Axis::linear("y")).with(line);
        let with_bar = Figure::from(plot.clone().with_order(axis));
        let svg = with_bar.file(None);
        assert!(svg.contains("thickness (nm)") && svg.contains("data:image/png"), "{svg}");
        // A chart without its bar would not say what its colours mean.
        assert!(with_bar.data().is_none() && Figure::from(plot).data().is_some());
    }
}
