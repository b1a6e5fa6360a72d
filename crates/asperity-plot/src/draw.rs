//! Puts a figure together.

use super::canvas::Canvas;
use super::joint;
use super::sketch::{Sketch, WIDTH};
use super::{Arrangement, Plot};

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
        Arrangement::Joint => {
            if let [main, top, right] = plots {
                height = joint::draw(&mut canvas, main, top, right);
            }
        }
    }
    canvas.finish(title, width, height.max(1.0))
}
