//! The style guide: what all figures have in common.
//!
//! - Solid lines are deterministic, dashed ones statistical, dash-dot ones the reference; every line style stands in the
//!   legend.
//! - Text of all figures has the same size on the page; panels get fewer columns rather than smaller text.
//! - Up to [`MOST_KEYS`] curves are named one by one; more that have an order share a colour scale.
//! - A band widens the axis of its lines by [`BAND_ROOM`] of their range at most; what is cut is said to be.
//! - Colours differ in lightness or come with a line style, so that a figure can be read in greyscale.
//! - In a dark environment ink and paper are exchanged by the figure's own style sheet; print is always light.

use plotters::style::RGBColor;

/// Width of a figure on a page, CSS pixels; all sizes below are in the same unit.
pub(super) const WIDTH: f64 = 720.0;
/// Width of a figure on a card, and the height between its axes.
pub(super) const CARD: (f64, f64) = (340.0, 170.0);
/// Titles of plots.
pub(super) const TITLE: f64 = 15.0;
/// Labels of axes.
pub(super) const LABEL: f64 = 14.0;
/// Numbers at ticks, names in legends, labels in plots.
pub(super) const TICK: f64 = 12.5;
/// Lines of data, and the thinner ones of references.
pub(super) const LINE: f64 = 2.0;
pub(super) const REFERENCE: f64 = 1.2;
/// A plot in a row of several is no narrower.
pub(super) const NARROWEST: f64 = 235.0;
/// Height over width of a plot in a row of several, at most.
pub(super) const STEEPEST: f64 = 0.8;

/// Curves that are named one by one.
pub(super) const MOST_KEYS: usize = 8;
/// How far a band may widen the axis at either end, over the range of what is no band.
pub(super) const BAND_ROOM: f64 = 0.5;

pub(super) const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
pub(super) const NOTE_INK: RGBColor = RGBColor(0x44, 0x44, 0x44);
pub(super) const PAPER: RGBColor = RGBColor(0xff, 0xff, 0xff);
pub(super) const GRID: RGBColor = RGBColor(0xe2, 0xe2, 0xe2);
pub(super) const FINE_GRID: RGBColor = RGBColor(0xf1, 0xf1, 0xf1);
/// Text on a coloured tile keeps its colour in a dark environment, so these differ from ink and paper.
pub(super) const ON_LIGHT: RGBColor = RGBColor(0x23, 0x23, 0x23);
pub(super) const ON_DARK: RGBColor = RGBColor(0xfe, 0xfe, 0xfe);

/// Colours, "#RRGGBB", and what replaces them in a dark environment.
pub const DARK_COLOURS: [(&str, &str); 9] = [
    ("#222222", "#E3E6EA"),
    ("#444444", "#C3C8CE"),
    ("#FFFFFF", "#15181C"),
    ("#E2E2E2", "#333940"),
    ("#F1F1F1", "#23282E"),
    // Black and dark purple data, and the grey of references.
    ("#111111", "#F4F4F4"),
    ("#882255", "#C4588A"),
    ("#666666", "#9AA2AB"),
    ("#0072B2", "#3D9BD9"),
];

/// The rules for a dark environment, for pages that hold figures; a figure file has its own.
pub fn dark_rules() -> String {
    rules(|_| true)
}

/// The rules that a figure of these elements needs in a dark environment.
pub(super) fn dark_rules_of(elements: &str) -> String {
    rules(|attribute| elements.contains(attribute))
}

fn rules(is_needed: impl Fn(&str) -> bool) -> String {
    let mut rules = String::new();
    for (light, dark) in DARK_COLOURS {
        for key in ["fill", "stroke"] {
            let attribute = format!("{key}=\"{light}\"");
            if is_needed(&attribute) {
                rules.push_str(&format!("svg [{attribute}]{{{key}:{dark}}}"));
            }
        }
    }
    format!("@media screen and (prefers-color-scheme:dark){{{rules}}}")
}

/// The size of a figure in print: how wide it is and how high its smallest text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Millimetres.
    width: f64,
    /// Points.
    font: f64,
}

impl Size {
    /// Least and largest width, mm.
    pub const WIDTHS: [f64; 2] = [40.0, 500.0];
    /// Smallest and largest font, pt.
    pub const FONTS: [f64; 2] = [4.0, 24.0];

    /// A width in mm from 40 to 500 and a font size in pt from 4 to 24; others are moved to the nearest of these.
    pub fn new(width: f64, font: f64) -> Self {
        let within = |value: f64, [least, most]: [f64; 2]| value.clamp(least, most);
        Self { width: within(width, Self::WIDTHS), font: within(font, Self::FONTS) }
    }

    /// Millimetres.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Width in the unit of the sizes above.
    pub(super) fn layout_width(&self) -> f64 {
        const POINTS_PER_MM: f64 = 72.0 / 25.4;
        self.width * POINTS_PER_MM / self.font * TICK
    }
}
