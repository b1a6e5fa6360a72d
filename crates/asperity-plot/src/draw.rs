//! Puts a figure together.

use super::canvas::Canvas;
use super::joint;
use super::layer::Layer;
use super::layout::Layout;
use super::legend::{self, Legend};
use super::style::{NARROWEST, STEEPEST, Size, WIDTH, dark_rules};
use super::{Arrangement, Plot};

/// The SVG text of a figure, `print` wide or as wide as a page. A `file` has its own rules for a dark environment.
pub(super) fn figure(
    title: &str,
    plots: &[&Plot],
    arrangement: Arrangement,
    print: Option<Size>,
    file: bool,
) -> String {
    let mut canvas = Canvas::default();
    let width = print.map_or(WIDTH, |size| size.layout_width());
    let height = match (arrangement, plots) {
        (Arrangement::Joint, [main, top, right]) => joint::draw(&mut canvas, [main, top, right], width),
        (Arrangement::Row, _) => row(&mut canvas, plots, width),
        _ => column(&mut canvas, plots, width),
    };
    let rules = file.then(dark_rules);
    canvas.finish(title, (width, height.max(1.0)), print, rules.as_deref())
}

/// Height of a frame that would be `height` high in a figure of the usual width.
pub(super) fn scaled(height: f64, width: f64) -> f64 {
    height * (width / WIDTH).clamp(0.5, 1.25)
}

fn column(canvas: &mut Canvas, plots: &[&Plot], width: f64) -> f64 {
    let sketches: Vec<Layout<'_>> =
        plots.iter().map(|plot| Layout::new(plot, (width, scaled(plot.height, width)))).collect();
    let left = sketches.iter().map(|layout| layout.margins.0).fold(0.0, f64::max);
    let right = sketches.iter().map(|layout| layout.margins.1).fold(0.0, f64::max);
    let is_shared = shares_names(plots);
    let mut height = 0.0;
    for layout in &sketches {
        height = layout.draw(canvas, (0.0, height), (left, right), layout.head(), !is_shared);
    }
    if is_shared { height + shared_legend(canvas, plots, height, width) } else { height }
}

/// Plots side by side, in several rows where they would be too narrow.
fn row(canvas: &mut Canvas, plots: &[&Plot], width: f64) -> f64 {
    let count = plots.len().max(1);
    let columns = ((width / NARROWEST) as usize).clamp(1, count);
    // As many in each row.
    let columns = count.div_ceil(count.div_ceil(columns));
    let each = width / columns as f64;
    let is_shared = shares_names(plots);
    let mut height = 0.0;
    for plots in plots.chunks(columns) {
        let lower = |plot: &Plot| plot.height.min(STEEPEST * each);
        let sketches: Vec<Layout<'_>> =
            plots.iter().map(|plot| Layout::new(plot, (each, lower(plot)))).collect();
        let head = sketches.iter().map(Layout::head).fold(0.0, f64::max);
        let ends = sketches.iter().enumerate().map(|(k, layout)| {
            layout.draw(canvas, (each * k as f64, height), layout.margins, head, !is_shared)
        });
        height = ends.fold(height, f64::max);
    }
    if is_shared { height + shared_legend(canvas, plots, height, width) } else { height }
}

/// Whether several plots name the same layers, so that one legend does for all.
fn shares_names(plots: &[&Plot]) -> bool {
    let names = |plot: &Plot| -> Vec<String> {
        let mut names: Vec<String> = plot.layers.iter().filter_map(|layer| layer.name.clone()).collect();
        names.sort_unstable();
        names.dedup();
        names
    };
    let Some((first, rest)) = plots.split_first() else { return false };
    let first = names(first);
    !rest.is_empty()
        && !first.is_empty()
        && plots.iter().all(|plot| matches!(plot.legend, Legend::Auto | Legend::Below))
        && rest.iter().all(|plot| names(plot) == first)
}

fn shared_legend(canvas: &mut Canvas, plots: &[&Plot], top: f64, width: f64) -> f64 {
    let layers: Vec<&Layer> = plots.iter().flat_map(|plot| &plot.layers).collect();
    legend::draw_below(canvas, layers, (16.0, top), width - 32.0) + 6.0
}
