//! Puts a figure together, a plot with the distributions of its two quantities too.

use crate::axes::{FOOT, Frame};
use crate::canvas::{Align, Canvas, Rect, Type};
use crate::layer::Layer;
use crate::layout::{Layout, Legend};
use crate::style::{CARD, LABEL, NARROWEST, NOTE_INK, STEEPEST, Size, TICK, WIDTH};
use crate::text::wrap;
use crate::ticks::Tick;
use crate::{Arrangement, Plot, axes, layout, text};

/// The SVG text of a figure, `print` wide or as wide as a page. A `file` has its own rules for a dark environment.
pub(super) fn figure(
    [title, heading]: [&str; 2],
    plots: &[&Plot],
    arrangement: Arrangement,
    print: Option<Size>,
    file: bool,
) -> String {
    let mut canvas = Canvas::default();
    let width = print.map_or(WIDTH, |size| size.layout_width());
    let top = headed(&mut canvas, heading, width);
    let height = match (arrangement, plots) {
        (Arrangement::Joint, [main, above, right]) => draw(&mut canvas, [main, above, right], width),
        (Arrangement::Row, _) => row(&mut canvas, plots, None, width, top),
        (Arrangement::Grid(columns), _) => row(&mut canvas, plots, Some(columns), width, top),
        _ => column(&mut canvas, plots, width, top),
    };
    canvas.finish(title, (width, height.max(1.0)), print, file)
}

/// The SVG text of a plot as wide as a card.
pub(super) fn card(title: &str, plot: &Plot) -> String {
    /// Height of a named place, so that names do not overlap.
    const ROW: f64 = 17.0;
    let (width, height) = CARD;
    let mut canvas = Canvas::default();
    let layout = Layout::new(plot, (width, height.max(ROW * plot.y.names.len() as f64)));
    let bottom = layout.draw(&mut canvas, (0.0, 0.0), layout.margins, layout.head(), true);
    canvas.finish(title, (width, bottom), None, true)
}

/// Writes the heading of a figure and returns where its plots begin.
fn headed(canvas: &mut Canvas, heading: &str, width: f64) -> f64 {
    let lines = wrap(heading, LABEL, width - 32.0, 2);
    let set = Type { size: LABEL, colour: NOTE_INK, align: Align::Left, bold: false, upright: false };
    let spot = |k: usize| (16.0, 10.0 + LABEL / 2.0 + k as f64 * (LABEL + 5.0));
    canvas.texts(lines.iter().enumerate().map(|(k, line)| (line.as_str(), spot(k))), set);
    if lines.is_empty() { 0.0 } else { 8.0 + lines.len() as f64 * (LABEL + 5.0) }
}

/// Height of a frame that would be `height` high in a figure of the usual width.
pub(super) fn scaled(height: f64, width: f64) -> f64 {
    height * (width / WIDTH).clamp(0.7, 1.25)
}

fn column(canvas: &mut Canvas, plots: &[&Plot], width: f64, top: f64) -> f64 {
    let sketches: Vec<Layout<'_>> =
        plots.iter().map(|plot| Layout::new(plot, (width, scaled(plot.height, width)))).collect();
    let left = sketches.iter().map(|layout| layout.margins.0).fold(0.0, f64::max);
    let right = sketches.iter().map(|layout| layout.margins.1).fold(0.0, f64::max);
    let is_shared = shares_names(plots);
    let mut height = top;
    for layout in &sketches {
        height = layout.draw(canvas, (0.0, height), (left, right), layout.head(), !is_shared);
    }
    if is_shared { height + shared_legend(canvas, plots, height, width) } else { height }
}

/// Plots side by side, in several rows where they would be too narrow; of a grid in `columns`, with one legend for each row.
fn row(canvas: &mut Canvas, plots: &[&Plot], columns: Option<usize>, width: f64, top: f64) -> f64 {
    let count = plots.len().max(1);
    let most = ((width / NARROWEST) as usize).clamp(1, count);
    let grid = columns.filter(|columns| *columns <= most);
    // As many in each row.
    let columns = grid.unwrap_or(count.div_ceil(count.div_ceil(most)));
    let each = width / columns as f64;
    let is_shared = shares_names(plots);
    // Named places need the height that they were given.
    let lower =
        |plot: &Plot| if plot.y.names.is_empty() { plot.height.min(STEEPEST * each) } else { plot.height };
    let sketches: Vec<Layout<'_>> = plots.iter().map(|plot| Layout::new(plot, (each, lower(plot)))).collect();
    let in_column = |column: usize| {
        let margins = sketches.iter().skip(column).step_by(columns).map(|layout| layout.margins);
        margins.fold((0.0, 0.0), |a: (f64, f64), b| (a.0.max(b.0), a.1.max(b.1)))
    };
    let margins: Vec<(f64, f64)> = (0..columns).map(in_column).collect();
    let mut height = top;
    for (plots, sketches) in plots.chunks(columns).zip(sketches.chunks(columns)) {
        let head = sketches.iter().map(Layout::head).fold(0.0, f64::max);
        let has_legend = !is_shared && grid.is_none();
        let cells = sketches.iter().zip(&margins).enumerate();
        let ends = cells
            .filter(|(_, (layout, _))| layout.plot.height != 0.0 || !layout.plot.layers.is_empty())
            .map(|(k, (layout, &margins))| {
                layout.draw(canvas, (each * k as f64, height), margins, head, has_legend)
            });
        height = ends.fold(height, f64::max);
        if grid.is_some() && !is_shared {
            height += shared_legend(canvas, plots, height, width);
        }
    }
    if is_shared { height + shared_legend(canvas, plots, height, width) } else { height }
}

/// Whether several plots name the same layers, so that one legend does for all.
fn shares_names(plots: &[&Plot]) -> bool {
    let Some((first, rest)) = plots.split_first() else { return false };
    let first = first.names();
    !rest.is_empty()
        && !first.is_empty()
        && plots.iter().all(|plot| matches!(plot.legend, Legend::Auto | Legend::Below))
        && rest.iter().all(|plot| plot.names() == first)
}

fn shared_legend(canvas: &mut Canvas, plots: &[&Plot], top: f64, width: f64) -> f64 {
    let layers: Vec<&Layer> = plots.iter().flat_map(|plot| &plot.layers).collect();
    layout::draw_below(canvas, layers, (16.0, top), width - 32.0) + 6.0
}

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
