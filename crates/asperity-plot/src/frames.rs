//! Patches on a map that change with something, such as contacts with the load.

use std::fmt::Write;

use serde::Serialize;

use super::axes::Frame as Axes;
use super::canvas::Canvas;
use super::layer::Layer;
use crate::raster::encode;

/// Patches at several values of something, a frame for each. A drawing shows one frame, [`FigureData`](crate::FigureData) has all.
#[derive(Clone, Debug)]
pub struct Frames {
    /// What a reader chooses by, such as "load".
    pub label: String,
    /// What each frame shows, such as "1.25 MPa: 180 contacts".
    pub names: Vec<String>,
    /// The frame that a drawing shows.
    pub shown: usize,
    /// Those of all frames.
    pub patches: Patches,
}

/// Patches in the units of both axes, which must be linear and of one unit.
#[derive(Clone, Debug)]
pub enum Patches {
    Circles {
        centres: Vec<(f64, f64)>,
        /// For each frame the radii about the first centres.
        radii: Vec<Vec<f64>>,
    },
    /// Cells of a regular grid that are covered in part.
    Cells {
        /// Where the grid begins and ends along x.
        x: (f64, f64),
        /// Where it begins and ends along y; the first row lies at the first value.
        y: (f64, f64),
        /// Numbers of cells along x and y.
        cells: [usize; 2],
        /// For each frame how much of each cell is covered, of 255, x fastest.
        covered: Vec<Vec<u8>>,
    },
}

/// What a page needs to show another frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct FramesData {
    label: String,
    names: Vec<String>,
    shown: usize,
    #[serde(flatten)]
    patches: PatchesData,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum PatchesData {
    /// x, y of the centres, and the radii of each frame.
    Circles(Vec<[f64; 2]>, Vec<Vec<f64>>),
    Images(Vec<String>),
}

/// A length with as many decimals as a map of `side` shows.
fn rounded(value: f64, side: f64) -> f64 {
    let power = 10f64.powi(4 - side.log10().ceil() as i32);
    (value * power).round() / power
}

impl Frames {
    /// The places that the axes must include.
    pub(super) fn reach(&self) -> Vec<(f64, f64)> {
        match &self.patches {
            Patches::Circles { centres, .. } => centres.clone(),
            Patches::Cells { x, y, .. } => vec![(x.0, y.0), (x.1, y.1)],
        }
    }

    /// The longest side of what they cover.
    fn side(&self) -> f64 {
        let longest = |sizes: &mut dyn Iterator<Item = f64>| sizes.fold(f64::MIN_POSITIVE, f64::max);
        longest(&mut self.reach().iter().flat_map(|(x, y)| [x.abs(), y.abs()]))
    }

    pub(super) fn data(&self, layer: &Layer) -> FramesData {
        let side = self.side();
        let patches = match &self.patches {
            Patches::Circles { centres, radii } => PatchesData::Circles(
                centres.iter().map(|&(x, y)| [x, y].map(|at| rounded(at, side))).collect(),
                radii
                    .iter()
                    .map(|radii| radii.iter().map(|&radius| rounded(radius, side)).collect())
                    .collect(),
            ),
            Patches::Cells { cells, covered, .. } => {
                PatchesData::Images(covered.iter().filter_map(|one| image(one, *cells, layer)).collect())
            }
        };
        FramesData { label: self.label.clone(), names: self.names.clone(), shown: self.shown, patches }
    }

    /// Draws the frame that is shown in a group with the units of the axes, so that a page can put another in its place.
    pub(super) fn draw(&self, canvas: &mut Canvas, axes: &Axes, layer: &Layer) {
        let (Some(origin), Some(unit)) = (axes.spot((0.0, 0.0)), axes.spot((1.0, 1.0))) else { return };
        let side = self.side();
        let mut content = String::new();
        match &self.patches {
            Patches::Circles { centres, radii } => {
                let shown = radii.get(self.shown).into_iter().flatten();
                for (&(x, y), &radius) in centres.iter().zip(shown) {
                    let [x, y, r] = [x, y, radius].map(|at| rounded(at, side));
                    // Writing into a String cannot fail.
                    write!(content, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>").ok();
                }
            }
            Patches::Cells { x, y, cells, covered } => {
                let Some(uri) = covered.get(self.shown).and_then(|one| image(one, *cells, layer)) else {
                    return;
                };
                let [width, height] = [x.1 - x.0, y.1 - y.0];
                content = format!(
                    "<image x=\"{}\" y=\"{}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
                     style=\"image-rendering:pixelated\" href=\"{uri}\"/>",
                    x.0, y.0
                );
            }
        }
        canvas.scaled_group("patches", origin, unit, layer.colour.rgb(), &content);
    }
}

/// The image of one frame, its first row first.
fn image(covered: &[u8], cells: [usize; 2], layer: &Layer) -> Option<String> {
    /// Opacities of the steps of cover, more than in proportion: a cell that is hardly covered is seen. Files are smaller than with 255.
    const OPACITIES: [u8; 5] = [0, 128, 170, 213, 255];
    const STEPS: u8 = OPACITIES.len() as u8 - 1;
    let step = |cover: &u8| cover.div_ceil(u8::MAX / STEPS + 1);
    let indices: Vec<u8> = covered.iter().map(step).collect();
    let colour = layer.colour.rgb();
    let palette = [[colour.0, colour.1, colour.2]; OPACITIES.len()];
    encode(&indices, cells, &palette, &OPACITIES)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Axis, Colour, Figure, Plot};

    fn figure(patches: Patches) -> Figure {
        let names = vec!["1 N: a few".to_owned(), "2 N: more".to_owned()];
        let frames = Frames { label: "load".to_owned(), names, shown: 1, patches };
        let axis = |name: &str| Axis::linear(name).range(0.0, 10.0);
        let layer = Layer::frames(frames).coloured(Colour::Deterministic).named("contacts");
        Figure::from(Plot::new("Map", axis("x"), axis("y")).equal_aspect().with(layer))
    }

    fn circles() -> Figure {
        let centres = vec![(1.0, 2.0), (3.000_04, 4.0), (5.0, 6.0)];
        figure(Patches::Circles { centres, radii: vec![vec![0.5], vec![0.7, 0.25]] })
    }

    #[test]
    fn a_drawing_has_the_circles_of_the_shown_frame() {
        let svg = circles().part_of_page();
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(
            svg.contains("<circle cx=\"1\" cy=\"2\" r=\"0.7\"/><circle cx=\"3\" cy=\"4\" r=\"0.25\"/>"),
            "{svg}"
        );
        assert!(svg.contains("2 N: more") && !svg.contains("1 N"));
        assert!(svg.contains("<g class=\"patches\""));
    }

    #[test]
    fn the_data_have_all_frames() {
        let data = serde_json::to_value(circles().data().unwrap()).unwrap();
        assert_eq!(data["frames"]["names"][0], "1 N: a few");
        assert_eq!(data["frames"]["shown"], 1);
        assert_eq!(data["frames"]["circles"][0][1], serde_json::json!([3.0, 4.0]));
        assert_eq!(data["frames"]["circles"][1], serde_json::json!([[0.5], [0.7, 0.25]]));
    }

    #[test]
    fn cells_are_the_more_opaque_the_more_they_are_covered() {
        let covered = vec![vec![0; 6], vec![0, 255, 1, 64, 128, 192]];
        let drawn = figure(Patches::Cells { x: (0.0, 10.0), y: (0.0, 10.0), cells: [3, 2], covered });
        let data = serde_json::to_value(drawn.data().unwrap()).unwrap();
        let uri = data["frames"]["images"][1].as_str().unwrap();
        assert!(drawn.part_of_page().contains(uri));
        let (pixels, _) = crate::raster::tests::decoded(uri, png::Transformations::EXPAND);
        let opacities: Vec<u8> = pixels.chunks(4).map(|pixel| pixel[3]).collect();
        assert_eq!(opacities, [0, 255, 128, 128, 170, 213]);
    }
}
