//! A plot with the distributions of its two quantities along its sides.

use super::axes::{self, FOOT, Frame};
use super::canvas::{Canvas, Rect};
use super::draw::scaled;
use super::layer::Layer;
use super::layout::Layout;
use super::style::{LABEL, TICK};
use super::ticks::Tick;
use super::{Plot, text};

/// Height of the upper panel, width of the one at the right.
const MARGINAL: f64 = 100.0;
const GAP: f64 = 10.0;
/// Most numbers on a marginal axis.
const LABELS: usize = 4;

/// Draws the main plot, one above that shares its x axis and one at its right that shares its y axis,
/// lying on its side already, on a page of some width; returns the y of the lower end.
pub(super) fn draw(canvas: &mut Canvas, [main, top, right]: [&Plot; 3], page: f64) -> f64 {
    let height = scaled(main.height, page);
    let main = Layout::new(main, (page, height));
    let (mut top, mut right) = (Layout::new(top, (page, MARGINAL)), Layout::new(right, (page, height)));
    (top.x, right.y) = (main.x, main.y);
    let top_ticks = axes::y_ticks_up_to(LABELS, &top.y, MARGINAL);
    let right_ticks = axes::x_ticks_up_to(LABELS, &right.x, MARGINAL);

    let left = main.margins.0.max(axes::left_margin(&top.plot.y, &top_ticks));
    let bar = |height: f64| main.plot.bar(height);
    let bar_room = bar(height).map_or(0.0, |bar| bar.room());
    let end = axes::right_margin(&right_ticks).max(bar_room);
    let room = page - left - GAP - MARGINAL - end;
    let (width, height) = main.fitted(room, height);
    let start = (room - width) / 2.0;
    let upper = Rect::new(start + left, 12.0 + main.head(), width, MARGINAL);
    let rect = Rect::new(upper.left, upper.bottom + GAP, width, height);
    let beside = Rect::new(rect.right + GAP, rect.top, MARGINAL, height);

    main.draw_title(canvas, 0.0, &upper);
    let label_x = start + 6.0 + LABEL / 2.0;
    let x_ticks = axes::x_ticks(&main.x, width);
    let y_ticks = axes::y_ticks(&main.y, height);
    let top_ticks = clear_of(&y_ticks, height, top_ticks, |_, _| 1.4 * TICK);
    let half = |number: &str| text::width(number, TICK) / 2.0;
    let right_ticks = clear_of(&x_ticks, width, right_ticks, |a, b| half(a) + half(b) + 6.0);
    let frame = Frame { x: main.x, y: top.y, rect: upper };
    top.draw_panel(canvas, &frame, &x_ticks, &top_ticks, |canvas| {
        axes::draw_axes(canvas, &frame, &x_ticks, &top_ticks, (None, Some(&top.plot.y)), label_x);
    });
    let frame = Frame { x: right.x, y: main.y, rect: beside };
    right.draw_panel(canvas, &frame, &right_ticks, &y_ticks, |canvas| {
        axes::draw_axes(canvas, &frame, &right_ticks, &y_ticks, (Some(&right.plot.x), None), label_x);
    });
    let frame = Frame { x: main.x, y: main.y, rect };
    let taken = main.draw_panel(canvas, &frame, &x_ticks, &y_ticks, |canvas| {
        let named = (Some(&main.plot.x), Some(&main.plot.y));
        axes::draw_axes(canvas, &frame, &x_ticks, &y_ticks, named, label_x);
    });
    if let Some(bar) = bar(height) {
        bar.draw(canvas, &beside);
    }

    // What both marginal plots show is named once.
    let named = |layer: &&Layer| !top.plot.layers.iter().any(|other| other.name == layer.name);
    let others = top.plot.layers.iter().chain(right.plot.layers.iter().filter(named));
    let layers: Vec<&Layer> = main.plot.layers.iter().chain(others).collect();
    main.draw_legend(canvas, layers.iter().copied(), &rect, &taken, (0.0, rect.bottom + FOOT))
}

/// The ticks of a marginal axis without those whose number would touch one of the main axis, `length`
/// long, that ends where it begins; `room` is what two numbers need from middle to middle.
fn clear_of(main: &[Tick], length: f64, mut ticks: Vec<Tick>, room: impl Fn(&str, &str) -> f64) -> Vec<Tick> {
    let clear = |tick: &Tick, number: &str| {
        let from = GAP + tick.place * MARGINAL + length;
        axes::labelled(main).all(|(place, other)| from - place * length >= room(number, other))
    };
    ticks.retain(|tick| tick.label.as_ref().is_none_or(|number| clear(tick, number)));
    ticks
}
