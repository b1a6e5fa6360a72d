//! The palette: safe for colour-blind readers (Okabe and Ito 2008), with fixed roles.

use plotters::style::RGBColor;

use super::Spread;

/// The colour of a layer, by its role.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// The statistical model: blue.
    Statistical,
    /// The deterministic model: vermillion.
    Deterministic,
    /// The boundary element reference: green.
    Reference,
    /// Elastic contacts: light blue.
    Elastic,
    /// Elastic-plastic contacts: orange.
    ElasticPlastic,
    /// Fully plastic contacts: dark purple.
    Plastic,
    /// What the height distribution contributes to a difference: medium blue.
    Heights,
    /// What the spread of radii contributes: pale blue.
    Radii,
    /// What the correlation of heights and radii contributes: orange.
    Correlation,
    /// The sum of contributions: black.
    Sum,
    /// Other realisations of the deterministic model: pale vermillion.
    Others,
    /// References and notes: grey.
    Neutral,
    /// One of several series that have no order; repeats after eight.
    Series(usize),
    /// Number `index` of `of` series that have an order (such as layer thickness), dark to light.
    Ordered {
        /// Place in the order, from 0.
        index: usize,
        of: usize,
    },
}

const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xb2);
const VERMILLION: RGBColor = RGBColor(0xd5, 0x5e, 0x00);
const GREEN: RGBColor = RGBColor(0x00, 0x9e, 0x73);
const ORANGE: RGBColor = RGBColor(0xe6, 0x9f, 0x00);

const SERIES: [RGBColor; 8] = [
    BLUE,
    VERMILLION,
    GREEN,
    RGBColor(0xcc, 0x79, 0xa7),
    ORANGE,
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0x22, 0x22, 0x22),
    RGBColor(0x8c, 0x6d, 0x1f),
];

/// Steps of decreasing darkness, so that an order shows without colour too; none too light for white.
const ORDERED: [(f64, f64, f64); 5] =
    [(68.0, 1.0, 84.0), (59.0, 82.0, 139.0), (33.0, 144.0, 141.0), (74.0, 182.0, 96.0), (190.0, 200.0, 30.0)];

impl Colour {
    pub(super) fn rgb(self) -> RGBColor {
        match self {
            Self::Statistical => BLUE,
            Self::Deterministic => VERMILLION,
            Self::Reference => GREEN,
            Self::Elastic => RGBColor(0x9a, 0xd0, 0xf0),
            Self::ElasticPlastic => ORANGE,
            Self::Plastic => RGBColor(0x88, 0x22, 0x55),
            Self::Heights => RGBColor(0x56, 0x6f, 0xb8),
            Self::Radii => RGBColor(0xc4, 0xdd, 0xf0),
            Self::Correlation => ORANGE,
            Self::Sum => RGBColor(0x11, 0x11, 0x11),
            Self::Others => RGBColor(0xe8, 0xb0, 0x88),
            Self::Neutral => RGBColor(0x66, 0x66, 0x66),
            Self::Series(index) => SERIES[index % SERIES.len()],
            Self::Ordered { index, of } => ordered(index, of),
        }
    }
}

/// The colours of the first curves of a figure as "#RRGGBB".
pub fn series_colours() -> [String; 8] {
    std::array::from_fn(|index| Colour::Series(index).hex())
}

impl Colour {
    pub(super) fn hex(self) -> String {
        let RGBColor(red, green, blue) = self.rgb();
        format!("#{red:02X}{green:02X}{blue:02X}")
    }
}

/// The colours of an order behind a transparent one, as many as a byte can name.
pub(super) fn order_palette() -> Vec<[u8; 3]> {
    let colours = (0..255).map(|index| ordered(index, 255));
    std::iter::once([255; 3]).chain(colours.map(|RGBColor(red, green, blue)| [red, green, blue])).collect()
}

fn ordered(index: usize, of: usize) -> RGBColor {
    let last = of.saturating_sub(1).max(1);
    ramp(&ORDERED, index.min(last) as f64 / last as f64)
}

/// The colours of a field of values. Their lightness changes in equal steps, so that they tell the
/// order of values without colour too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColourMap {
    /// White to dark blue, for densities: zero is the background.
    Sequential,
    /// Dark blue over light grey to dark red, for what lies on both sides of zero.
    Diverging,
    /// Grey to white in few steps, for heights below coloured patches.
    Relief,
    /// Light to dark blue in equal ratios, for counts: one stands out from the background, and what
    /// is not positive is not shown.
    Counts,
}

/// White to dark blue.
const SEQUENTIAL: [(f64, f64, f64); 9] = [
    (255.0, 255.0, 255.0),
    (194.0, 232.0, 236.0),
    (134.0, 207.0, 223.0),
    (71.0, 180.0, 212.0),
    (2.0, 151.0, 196.0),
    (2.0, 120.0, 170.0),
    (0.0, 91.0, 144.0),
    (1.0, 63.0, 118.0),
    (16.0, 37.0, 86.0),
];

/// The middle differs from white, which holes in the field show.
const DIVERGING: [(f64, f64, f64); 9] = [
    (1.0, 68.0, 120.0),
    (2.0, 110.0, 171.0),
    (29.0, 156.0, 218.0),
    (140.0, 199.0, 233.0),
    (238.0, 238.0, 238.0),
    (226.0, 183.0, 150.0),
    (203.0, 130.0, 87.0),
    (170.0, 78.0, 48.0),
    (127.0, 29.0, 24.0),
];

/// Summits are white: a patch on one stands out, in greyscale too.
const RELIEF: [(f64, f64, f64); 2] = [(96.0, 96.0, 96.0), (255.0, 255.0, 255.0)];

/// Where counts begin in the map of densities: a single one must be seen.
const ONE: f64 = 0.3;

impl ColourMap {
    /// The colour at a place from 0 to 1 of the map.
    pub(super) fn rgb(self, place: f64) -> RGBColor {
        match self {
            Self::Sequential => ramp(&SEQUENTIAL, place),
            Self::Diverging => ramp(&DIVERGING, place),
            Self::Relief => ramp(&RELIEF, place),
            Self::Counts => ramp(&SEQUENTIAL, ONE + (1.0 - ONE) * place),
        }
    }

    /// How values are spread over the map.
    pub(super) fn spread(self) -> Spread {
        match self {
            Self::Sequential | Self::Diverging | Self::Relief => Spread::Linear,
            Self::Counts => Spread::Log,
        }
    }
}

/// The colour at a place from 0 to 1 between evenly spread anchors.
fn ramp<const N: usize>(anchors: &[(f64, f64, f64); N], place: f64) -> RGBColor {
    let place = place * (N - 1) as f64;
    let step = (place as usize).min(N - 2);
    let (from, to, part) = (anchors[step], anchors[step + 1], place - step as f64);
    let mix = |from: f64, to: f64| (from + part * (to - from)).round() as u8;
    RGBColor(mix(from.0, to.0), mix(from.1, to.1), mix(from.2, to.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_ends_at_the_ends_of_the_ramp() {
        assert_eq!(ordered(0, 5), RGBColor(68, 1, 84));
        assert_eq!(ordered(4, 5), RGBColor(190, 200, 30));
        assert_eq!(ordered(0, 1), RGBColor(68, 1, 84));
        assert_eq!(ordered(0, 0), RGBColor(68, 1, 84));
        assert_eq!(ordered(9, 3), ordered(2, 3));
    }

    /// CIE lightness, from 0 to 100.
    fn lightness(RGBColor(r, g, b): RGBColor) -> f64 {
        let linear = |part: u8| {
            let part = f64::from(part) / 255.0;
            if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
        };
        let light = 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
        116.0 * light.cbrt() - 16.0
    }

    #[test]
    fn regimes_differ_in_lightness_too() {
        let [elastic, mixed, plastic] =
            [Colour::Elastic, Colour::ElasticPlastic, Colour::Plastic].map(|colour| lightness(colour.rgb()));
        assert!(elastic > mixed + 10.0 && mixed > plastic + 10.0);
    }

    #[test]
    fn lightness_falls_evenly_along_the_maps() {
        let even = |map: ColourMap, from: f64, to: f64| {
            let steps: Vec<f64> =
                (0..=16).map(|k| lightness(map.rgb(from + (to - from) * f64::from(k) / 16.0))).collect();
            let mean = (steps[0] - steps[16]) / 16.0;
            assert!(mean > 2.0, "{mean}");
            for pair in steps.windows(2) {
                assert!((pair[0] - pair[1] - mean).abs() < 0.4 * mean, "{map:?} {steps:?}");
            }
        };
        even(ColourMap::Sequential, 0.0, 1.0);
        even(ColourMap::Counts, 0.0, 1.0);
        even(ColourMap::Diverging, 0.5, 0.0);
        even(ColourMap::Diverging, 0.5, 1.0);
        let balance = |part: f64| {
            lightness(ColourMap::Diverging.rgb(part)) - lightness(ColourMap::Diverging.rgb(1.0 - part))
        };
        assert!((0..8).all(|k| balance(f64::from(k) / 16.0).abs() < 2.0));
    }
}
