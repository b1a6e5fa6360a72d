//! The colour bar: what the colours of a field, or of ordered lines, mean.

use super::canvas::{Align, Canvas, Rect, Spot, Stroke, Type};
use super::colour::order_palette;
use super::png::encode;
use super::raster::{Raster, palette};
use super::scale::Scale;
use super::style::{INK, LABEL, TICK};
use super::text::{shrunk, width};
use super::ticks::Tick;
use super::{Axis, axes};

/// From the frame to the bar.
const GAP: f64 = 16.0;
const WIDTH: f64 = 14.0;
const MARK: f64 = 4.0;

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
        Some(Self {
            label: &raster.label,
            colours: palette(raster.map),
            ticks: axes::y_ticks(&scale, length),
        })
    }

    /// The same for lines whose colours follow the values of an axis, which has a range.
    pub(super) fn of_order(axis: &'a Axis, length: f64) -> Self {
        let (from, to) = axis.range.unwrap_or((0.0, 1.0));
        let scale = Scale::new(axis, [from, to].into_iter(), false);
        Self { label: &axis.label, colours: order_palette(), ticks: axes::y_ticks(&scale, length) }
    }

    /// Its width right of the frame.
    pub(super) fn room(&self) -> f64 {
        GAP + WIDTH + self.numbers() + if self.label.is_empty() { 0.0 } else { LABEL + 6.0 } + 6.0
    }

    /// Room for the numbers and their ticks.
    fn numbers(&self) -> f64 {
        let widest = axes::labelled(&self.ticks).map(|(_, label)| width(label, TICK)).fold(0.0, f64::max);
        MARK + 4.0 + widest
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
            let mark = if tick.label.is_some() { MARK } else { 0.5 * MARK };
            lines.push(vec![(bar.right, place(tick)), (bar.right + mark, place(tick))]);
        }
        canvas.lines(lines.iter().map(Vec::as_slice), Stroke::solid(INK, 1.0));
        let set = Type { size: TICK, colour: INK, align: Align::Left, bold: false, upright: false };
        let numbers = axes::labelled(&self.ticks)
            .map(|(at, label)| (label, (bar.right + MARK + 4.0, bar.bottom - at * bar.height())));
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
    use super::super::{Axis, Colour, Figure, Layer, Plot};

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
