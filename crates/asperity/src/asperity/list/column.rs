//! The columns of a list and their units.

use crate::numeric::{LARGEST, is_positive};
use crate::units::Dimension;

/// A column of a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ListColumn {
    /// Height, m.
    Height,
    /// Radius, m.
    Radius,
    /// One principal curvature, 1/m.
    Kx,
    /// The other one, 1/m.
    Ky,
    /// Place along x, m.
    X,
    /// Place along y, m.
    Y,
}

impl ListColumn {
    /// The columns of an array in their order; the first two suffice for spheres.
    pub(super) const OF_ARRAY: &'static [Self] = &[Self::Height, Self::Radius, Self::Kx, Self::Ky];

    /// Those that a text may have besides, both or neither.
    pub(super) const PLACES: [Self; 2] = [Self::X, Self::Y];

    /// Number of all columns.
    pub(super) const COUNT: usize = 6;

    /// The name in a header.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Height => "height",
            Self::Radius => "radius",
            Self::Kx => "kx",
            Self::Ky => "ky",
            Self::X => "x",
            Self::Y => "y",
        }
    }

    /// The column of this name, in any case.
    pub(super) fn named(name: &str) -> Option<Self> {
        let mut all = Self::OF_ARRAY.iter().copied().chain(Self::PLACES);
        all.find(|column| column.name().eq_ignore_ascii_case(name))
    }

    const fn is_length(self) -> bool {
        !matches!(self, Self::Kx | Self::Ky)
    }

    const fn si_unit(self) -> &'static str {
        if self.is_length() { "m" } else { "1/m" }
    }

    /// Names and SI units of columns, for a message.
    pub(super) fn names(columns: &[Self]) -> String {
        let named: Vec<String> =
            columns.iter().map(|column| format!("{} [{}]", column.name(), column.si_unit())).collect();
        named.join(", ")
    }

    /// How many of the unit of length that `unit` names, or is the reciprocal of, are a metre; `None` of another unit.
    pub(super) fn per_metre(self, unit: &str) -> Option<f64> {
        let unit = unit.trim();
        let length = if self.is_length() {
            unit
        } else {
            let before = unit.strip_prefix("1/").or_else(|| unit.strip_prefix('/'));
            before.or_else(|| unit.strip_suffix("^-1")).or_else(|| unit.strip_suffix("⁻¹"))?
        };
        Dimension::Length.documented_factor(length.trim()).map(per_metre)
    }

    /// The units that a header may name.
    pub(super) fn allowed_units(self) -> String {
        let reciprocal = if self.is_length() { "" } else { "1/" };
        let units = Dimension::Length.documented().iter().map(|unit| format!("{reciprocal}{unit}"));
        units.collect::<Vec<_>>().join(", ")
    }

    /// A value in SI, given in units of which `per_metre` are a metre.
    pub(super) fn si(self, value: f64, per_metre: f64) -> f64 {
        if self.is_length() { value / per_metre } else { value * per_metre }
    }

    /// Whether an SI value is valid.
    pub(super) fn allows(self, value: f64) -> bool {
        match self {
            Self::Height | Self::X | Self::Y => value.abs() <= LARGEST,
            Self::Radius | Self::Kx | Self::Ky => is_positive(value),
        }
    }

    pub(super) const fn allowed(self) -> &'static str {
        match self {
            Self::Height | Self::X | Self::Y => "a finite number (at most 1e30 m)",
            Self::Radius => "a positive finite number (1e-30 to 1e30 m)",
            Self::Kx | Self::Ky => "a positive finite number (1e-30 to 1e30 per metre)",
        }
    }
}

/// How many of a unit of length (m) are a metre. Of a power of ten the result is exact, so that 50 nm, divided by it, is
/// 5e-8 m to the bit.
pub(super) fn per_metre(unit: f64) -> f64 {
    let (exact, whole) = (unit.recip(), unit.recip().round());
    if (exact / whole - 1.0).abs() < 1e-12 { whole } else { exact }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_every_unit_are_those_in_metres() {
        for unit in Dimension::Length.documented() {
            let per_metre = ListColumn::Height.per_metre(unit).unwrap();
            assert_eq!(ListColumn::Height.si(per_metre, per_metre), 1.0, "{unit}");
            assert_eq!(ListColumn::Kx.per_metre(&format!("1/{unit}")), Some(per_metre));
            assert_eq!(ListColumn::Kx.per_metre(&format!("{unit}^-1")), Some(per_metre));
        }
        assert_eq!(ListColumn::Height.si(50.0, per_metre(1e-9)), 5e-8);
        assert_eq!(ListColumn::Ky.si(0.5, per_metre(1e-6)), 5e5);
        assert_eq!(ListColumn::Kx.per_metre("um"), None);
        assert_eq!(ListColumn::Radius.per_metre("1/um"), None);
        assert_eq!(per_metre(0.0254), 0.0254f64.recip());
    }
}
