//! The palette: safe for colour-blind readers (Okabe and Ito 2008), with fixed roles.

use plotters::style::RGBColor;

/// The colour of a layer, by its role.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// The statistical model: blue.
    Statistical,
    /// The deterministic model: vermillion.
    Deterministic,
    /// Elastic contacts: light blue.
    Elastic,
    /// Elastic-plastic contacts: orange.
    ElasticPlastic,
    /// Fully plastic contacts: dark purple.
    Plastic,
    /// References and notes: grey.
    Neutral,
    /// One of several series that have no order; repeats after eight.
    Series(usize),
    /// Number `index` of `of` series that have an order (such as layer thickness), dark to light.
    Ordered {
        /// Place in the order, from 0.
        index: usize,
        /// Number of series.
        of: usize,
    },
}

const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xb2);
const VERMILLION: RGBColor = RGBColor(0xd5, 0x5e, 0x00);
const ORANGE: RGBColor = RGBColor(0xe6, 0x9f, 0x00);

const SERIES: [RGBColor; 8] = [
    BLUE,
    VERMILLION,
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    ORANGE,
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0x22, 0x22, 0x22),
    RGBColor(0x8c, 0x6d, 0x1f),
];

/// Steps of falling darkness, so that an order shows without colour too; none too light for white.
const ORDERED: [(f64, f64, f64); 5] =
    [(68.0, 1.0, 84.0), (59.0, 82.0, 139.0), (33.0, 144.0, 141.0), (74.0, 182.0, 96.0), (190.0, 200.0, 30.0)];

impl Colour {
    pub(super) fn rgb(self) -> RGBColor {
        match self {
            Self::Statistical => BLUE,
            Self::Deterministic => VERMILLION,
            Self::Elastic => RGBColor(0x9a, 0xd0, 0xf0),
            Self::ElasticPlastic => ORANGE,
            Self::Plastic => RGBColor(0x88, 0x22, 0x55),
            Self::Neutral => RGBColor(0x66, 0x66, 0x66),
            Self::Series(index) => SERIES[index % SERIES.len()],
            Self::Ordered { index, of } => ordered(index, of),
        }
    }
}

fn ordered(index: usize, of: usize) -> RGBColor {
    let last = of.saturating_sub(1).max(1);
    let place = index.min(last) as f64 / last as f64 * (ORDERED.len() - 1) as f64;
    let step = (place as usize).min(ORDERED.len() - 2);
    let (from, to, part) = (ORDERED[step], ORDERED[step + 1], place - step as f64);
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

    #[test]
    fn regimes_differ_in_lightness_too() {
        let lightness = |colour: Colour| {
            let RGBColor(r, g, b) = colour.rgb();
            0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b)
        };
        assert!(lightness(Colour::Elastic) > lightness(Colour::ElasticPlastic) + 25.0);
        assert!(lightness(Colour::ElasticPlastic) > lightness(Colour::Plastic) + 25.0);
    }
}
