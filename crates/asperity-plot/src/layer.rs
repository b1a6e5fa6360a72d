//! What can be shown between two axes.

use super::{Colour, Frames, Raster};

/// How a line is broken up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    Solid,
    Dashed,
    Dotted,
    /// Dashes and dots in turn.
    DashDot,
}

/// The shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    Circle,
    Square,
    Triangle,
    Cross,
    /// An open circle, larger than the others, that leaves what it marks visible.
    Ring,
}

/// An interval on one axis or the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    X,
    Y,
}

impl Direction {
    pub(super) fn other(self) -> Self {
        match self {
            Self::X => Self::Y,
            Self::Y => Self::X,
        }
    }

    /// From along and across this axis to x and y, and back.
    pub(super) fn turn(self, point: (f64, f64)) -> (f64, f64) {
        match self {
            Self::X => point,
            Self::Y => (point.1, point.0),
        }
    }
}

#[derive(Clone, Debug)]
pub(super) enum Shape {
    Line(Vec<(f64, f64)>),
    Points(Vec<(f64, f64)>, Marker),
    /// Place along the axis, lower, upper.
    Band(Vec<(f64, f64, f64)>, Direction),
    /// Lower edge and upper edge along the axis, height.
    Bars(Vec<(f64, f64, f64)>, Direction),
    Region(Direction, f64, f64),
    /// At a value of x (a vertical line) or of y.
    Level(Direction, f64),
    Slope {
        through: (f64, f64),
        slope: f64,
    },
    Note((f64, f64)),
    /// Two opposite corners.
    Tile((f64, f64), (f64, f64)),
    Raster(Raster),
    Frames(Frames),
}

/// One thing to show. A layer with a name stands in the legend; layers of one name share its key,
/// so that a line and the band around it are named once.
#[derive(Clone, Debug)]
pub struct Layer {
    pub(super) shape: Shape,
    pub(super) name: Option<String>,
    /// Label at the layer itself.
    pub(super) label: String,
    pub(super) colour: Colour,
    pub(super) dash: Dash,
    pub(super) opacity: f64,
    /// Width of a line over the usual one.
    pub(super) weight: f64,
}

impl Layer {
    fn new(shape: Shape) -> Self {
        Self {
            shape,
            name: None,
            label: String::new(),
            colour: Colour::Series(0),
            dash: Dash::Solid,
            opacity: 1.0,
            weight: 1.0,
        }
    }

    fn reference(shape: Shape, label: impl Into<String>) -> Self {
        Self { label: label.into(), colour: Colour::Neutral, dash: Dash::Dashed, ..Self::new(shape) }
    }

    /// A line through (x, y) points in their order; it breaks where a point cannot be shown.
    pub fn line(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(Shape::Line(points.into_iter().collect()))
    }

    /// A marker at each (x, y). Markers that would hide each other are drawn once, and of a cloud
    /// at most 1,000 are drawn.
    pub fn points(points: impl IntoIterator<Item = (f64, f64)>, marker: Marker) -> Self {
        Self::new(Shape::Points(points.into_iter().collect(), marker))
    }

    /// The translucent area between two curves, from (x, lower, upper). On a logarithmic axis a
    /// lower value that is not positive reaches down to the edge of the plot.
    pub fn band(points: impl IntoIterator<Item = (f64, f64, f64)>) -> Self {
        Self { opacity: 0.22, ..Self::new(Shape::Band(points.into_iter().collect(), Direction::X)) }
    }

    /// Bars over n bins from their n + 1 edges and n heights; bins beyond the shorter list are left
    /// out.
    pub fn bars(edges: &[f64], heights: &[f64]) -> Self {
        let bins = edges.windows(2).zip(heights).map(|(edge, height)| (edge[0], edge[1], *height));
        Self { opacity: 0.45, ..Self::new(Shape::Bars(bins.collect(), Direction::X)) }
    }

    /// Shades an interval of x and writes a label into it; an infinite bound reaches the edge.
    pub fn region_x(from: f64, to: f64, label: impl Into<String>) -> Self {
        Self { opacity: 0.10, ..Self::reference(Shape::Region(Direction::X, from, to), label) }
    }

    /// Shades an interval of y and writes a label into it; an infinite bound reaches the edge.
    pub fn region_y(from: f64, to: f64, label: impl Into<String>) -> Self {
        Self { opacity: 0.10, ..Self::reference(Shape::Region(Direction::Y, from, to), label) }
    }

    /// A vertical line at `x` with a label beside it.
    pub fn at_x(x: f64, label: impl Into<String>) -> Self {
        Self::reference(Shape::Level(Direction::X, x), label)
    }

    /// A horizontal line at `y` with a label beside it.
    pub fn at_y(y: f64, label: impl Into<String>) -> Self {
        Self::reference(Shape::Level(Direction::Y, y), label)
    }

    /// A line of the given slope through a point, with a label along it. A logarithmic axis counts in
    /// decades, so that between two of them the slope is the exponent of a power law.
    pub fn slope(through: (f64, f64), slope: f64, label: impl Into<String>) -> Self {
        Self::reference(Shape::Slope { through, slope }, label)
    }

    /// A text near a point.
    pub fn note(at: (f64, f64), text: impl Into<String>) -> Self {
        Self::reference(Shape::Note(at), text)
    }

    /// A filled rectangle between two opposite corners with a text in its middle.
    pub fn tile(from: (f64, f64), to: (f64, f64), text: impl Into<String>) -> Self {
        Self { label: text.into(), ..Self::new(Shape::Tile(from, to)) }
    }

    /// Nothing but a filled key in the legend.
    pub fn key() -> Self {
        Self::tile((f64::NAN, f64::NAN), (f64::NAN, f64::NAN), "")
    }

    /// A field of values as an image, with a colour bar beside the plot; of several, the first has the
    /// bar. Both axes must be linear, else it is not shown.
    pub fn raster(raster: Raster) -> Self {
        Self::new(Shape::Raster(raster))
    }

    /// Patches that change with something. Both axes must be linear, else they are not shown.
    pub fn frames(frames: Frames) -> Self {
        Self::new(Shape::Frames(frames))
    }

    /// Names the layer in the legend.
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    pub fn coloured(mut self, colour: Colour) -> Self {
        self.colour = colour;
        self
    }

    /// Breaks the line into dashes or dots.
    pub fn dashed(mut self, dash: Dash) -> Self {
        self.dash = dash;
        self
    }

    /// Draws a line that stands out from many.
    pub fn thick(mut self) -> Self {
        self.weight = 1.8;
        self
    }

    /// Draws a line that is one of many.
    pub fn thin(mut self) -> Self {
        self.weight = 0.7;
        self
    }

    /// Fills an area in its full colour.
    pub(super) fn opaque(mut self) -> Self {
        self.opacity = 1.0;
        self
    }

    /// The same with x and y exchanged.
    pub(super) fn sideways(mut self) -> Self {
        let turned = |points: Vec<(f64, f64)>| points.into_iter().map(|(x, y)| (y, x)).collect();
        self.shape = match self.shape {
            Shape::Line(points) => Shape::Line(turned(points)),
            Shape::Points(points, marker) => Shape::Points(turned(points), marker),
            Shape::Band(points, along) => Shape::Band(points, along.other()),
            Shape::Bars(bins, along) => Shape::Bars(bins, along.other()),
            Shape::Region(direction, from, to) => Shape::Region(direction.other(), from, to),
            Shape::Level(direction, at) => Shape::Level(direction.other(), at),
            Shape::Slope { through: (x, y), slope } => Shape::Slope { through: (y, x), slope: 1.0 / slope },
            Shape::Note((x, y)) => Shape::Note((y, x)),
            Shape::Tile(from, to) => Shape::Tile((from.1, from.0), (to.1, to.0)),
            field @ (Shape::Raster(_) | Shape::Frames(_)) => field,
        };
        self
    }

    /// A band around a line, as against a share of a whole.
    pub(super) fn is_interval(&self) -> bool {
        matches!(self.shape, Shape::Band(_, Direction::X)) && self.opacity < 1.0
    }

    /// Turns the points of a band into gaps where `keep` says no.
    pub(super) fn keep_where(&mut self, keep: impl Fn(usize) -> bool) {
        if let Shape::Band(points, _) = &mut self.shape {
            for (place, point) in points.iter_mut().enumerate() {
                if !keep(place) {
                    point.2 = f64::NAN;
                }
            }
        }
    }

    /// The points that the axes must include; none for references and regions.
    pub(super) fn reach(&self) -> Vec<(f64, f64)> {
        match &self.shape {
            Shape::Line(points) | Shape::Points(points, _) => points.clone(),
            Shape::Band(points, along) => {
                points.iter().flat_map(|p| [(p.0, p.1), (p.0, p.2)]).map(|p| along.turn(p)).collect()
            }
            Shape::Bars(bins, along) => {
                let corners = bins.iter().flat_map(|b| [(b.0, 0.0), (b.0, b.2), (b.1, b.2)]);
                corners.map(|p| along.turn(p)).collect()
            }
            Shape::Tile(from, to) => vec![*from, *to],
            Shape::Frames(frames) => frames.reach(),
            Shape::Raster(raster) if raster.scale().is_some() => {
                vec![(raster.x.0, raster.y.0), (raster.x.1, raster.y.1)]
            }
            Shape::Raster(_)
            | Shape::Region(..)
            | Shape::Level(..)
            | Shape::Slope { .. }
            | Shape::Note(_) => Vec::new(),
        }
    }
}
