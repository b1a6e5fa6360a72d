//! Puts a figure together.

use super::canvas::Canvas;
use super::joint;
use super::layout::{Layout, WIDTH};
use super::{Arrangement, Plot};

pub(super) fn figure(title: &str, plots: &[&Plot], arrangement: Arrangement) -> String {
    let mut canvas = Canvas::default();
    let (mut width, mut height) = (WIDTH, 0.0_f64);
    match arrangement {
        Arrangement::Column => {
            let sketches: Vec<Layout<'_>> = plots.iter().map(|plot| Layout::new(plot, WIDTH)).collect();
            let left = sketches.iter().map(|layout| layout.margins.0).fold(0.0, f64::max);
            let right = sketches.iter().map(|layout| layout.margins.1).fold(0.0, f64::max);
            for layout in &sketches {
                height = layout.draw(&mut canvas, (0.0, height), (left, right), layout.head());
            }
        }
        Arrangement::Row => {
            width = 1.5 * WIDTH;
            let each = width / plots.len().max(1) as f64;
            let sketches: Vec<Layout<'_>> = plots.iter().map(|plot| Layout::new(plot, each)).collect();
            let head = sketches.iter().map(Layout::head).fold(0.0, f64::max);
            for (k, layout) in sketches.iter().enumerate() {
                height = height.max(layout.draw(&mut canvas, (each * k as f64, 0.0), layout.margins, head));
            }
        }
        Arrangement::Joint => {
            if let [main, top, right] = plots {
                height = joint::draw(&mut canvas, main, top, right);
            }
        }
    }
    canvas.finish(title, width, height.max(1.0))
}
