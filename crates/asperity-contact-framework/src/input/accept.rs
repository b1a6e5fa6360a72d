//! The largest difference between the models that the user accepts, and the size of figures in print.

use std::fmt;

use asperity::compare::Accepted;
use asperity_plot::Size;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};
use serde_json::json;

use super::Forms;
use super::quantity::{Length, Quantity};
use super::schema::{RANGE, TYPE, UNIT};

/// `accept = { area = "10 %", separation = 0.1, stiffness = "20 %" }`; each key may be left out.
#[derive(Debug, Clone, Copy, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table such as { area = \"10 %\", separation = 0.1, stiffness = \"20 %\" }"
)]
pub struct AcceptSpec {
    /// Accepted difference of the real contact area, relative to the sum.
    #[serde(default)]
    #[schemars(extend("default" = "10 %", "examples" = ["5 %"]))]
    area: Option<RelativeDifference>,
    /// Accepted difference of the separation: in sigma, or as a length.
    #[serde(default)]
    #[schemars(extend("default" = 0.1, "examples" = ["20 nm"]))]
    separation: Option<AcceptedSeparation>,
    /// Accepted difference of the stiffness, relative to the sum.
    #[serde(default)]
    #[schemars(extend("default" = "20 %", "examples" = [0.1]))]
    stiffness: Option<RelativeDifference>,
    /// Accepted difference of the electrical and the thermal conductance, relative to the sum.
    #[serde(default)]
    #[schemars(extend("default" = "20 %", "examples" = ["10 %"]))]
    conductance: Option<RelativeDifference>,
    /// Accepted difference of the coefficient of friction, relative to the sum.
    #[serde(default)]
    #[schemars(extend("default" = "10 %", "examples" = ["5 %"]))]
    friction: Option<RelativeDifference>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AcceptedSeparation {
    /// In standard deviations of the asperity heights.
    Sigma(f64),
    /// In m.
    Length(f64),
}

impl AcceptSpec {
    pub fn separation(&self) -> AcceptedSeparation {
        self.separation.unwrap_or(AcceptedSeparation::Sigma(Accepted::DEFAULT.separation))
    }

    /// On a surface whose separations are measured in `sigma` (m).
    pub fn on(&self, sigma: f64) -> Accepted {
        let relative =
            |given: Option<RelativeDifference>, otherwise| given.map_or(otherwise, |given| given.0);
        Accepted {
            separation: match self.separation() {
                AcceptedSeparation::Sigma(accepted) => accepted,
                AcceptedSeparation::Length(accepted) => accepted / sigma,
            },
            area: relative(self.area, Accepted::DEFAULT.area),
            stiffness: relative(self.stiffness, Accepted::DEFAULT.stiffness),
            conductance: relative(self.conductance, Accepted::DEFAULT.conductance),
            friction: relative(self.friction, Accepted::DEFAULT.friction),
        }
    }
}

/// A positive part of the deterministic result: a number, or percent as text.
#[derive(Debug, Clone, Copy)]
struct RelativeDifference(f64);

crate::written_schema!(RelativeDifference, |_| json!({
    "anyOf": [{ "type": "number", "exclusiveMinimum": 0, "maximum": 1 }, { "type": "string", "pattern": "%" }],
    TYPE: "share, as a number up to 1 or in percent", RANGE: "above 0",
}));

crate::written_schema!(AcceptedSeparation, |_| json!({
    "anyOf": [{ "type": "number", "exclusiveMinimum": 0 }, { "type": "string" }],
    TYPE: "number or length", UNIT: "m, mm, um, nm; a bare number is in sigma", RANGE: "above 0",
}));

fn positive(value: f64, found: &dyn fmt::Display, allowed: &str) -> Result<f64, String> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(format!("found {found}; allowed: {allowed}"))
    }
}

impl<'de> Deserialize<'de> for RelativeDifference {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        const ALLOWED: &str = "a positive share such as \"10 %\" or 0.1";
        Forms::new(ALLOWED)
            .number(|share, _| {
                // 10 is rarely meant as 1000 %.
                if share > 1.0 && share.is_finite() {
                    let percent = 100.0 * share;
                    return Err(format!(
                        "found {share}, which is {percent} %; allowed: {ALLOWED}; above 1 in percent"
                    ));
                }
                positive(share, &share, ALLOWED).map(Self)
            })
            .text(|text| {
                let percent =
                    text.trim().strip_suffix('%').and_then(|number| number.trim().parse::<f64>().ok());
                let share = percent.map_or(f64::NAN, |percent| percent / 100.0);
                positive(share, &format_args!("\"{text}\""), ALLOWED).map(Self)
            })
            .read(deserializer)
    }
}

impl<'de> Deserialize<'de> for AcceptedSeparation {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        const ALLOWED: &str = "a positive number (in sigma), or a length such as \"20 nm\"";

        Forms::new(ALLOWED)
            .number(|sigma, _| positive(sigma, &sigma, ALLOWED).map(Self::Sigma))
            .text(|text| {
                let length = Quantity::<Length>::parse(text).map_or(f64::NAN, |length| length.value());
                positive(length, &format_args!("\"{text}\""), ALLOWED).map(Self::Length)
            })
            .read(deserializer)
    }
}

/// Figures in print: in this size.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table such as { width = \"85 mm\", font = \"8 pt\" }")]
pub struct FigureSpec {
    /// Width of a figure, as of one column of a journal.
    #[schemars(extend("x-range" = "40 mm to 500 mm", "examples" = ["85 mm", "170 mm"]))]
    width: Width,
    /// Size of the numbers at ticks; labels are slightly larger.
    #[serde(default)]
    #[schemars(extend("default" = "8 pt", "examples" = ["8 pt"]))]
    font: FontSize,
}

impl FigureSpec {
    pub fn size(&self) -> Size {
        Size::new(self.width.0, self.font.0)
    }
}

/// A width in mm.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "Quantity<Length>")]
struct Width(f64);

impl TryFrom<Quantity<Length>> for Width {
    type Error = String;

    fn try_from(width: Quantity<Length>) -> Result<Self, String> {
        let mm = width.value() * 1e3;
        let [least, most] = Size::WIDTHS;
        if (least..=most).contains(&mm) {
            return Ok(Self(mm));
        }
        Err(format!("found a width of {mm} mm; allowed: {least} mm to {most} mm"))
    }
}

crate::written_schema!(Width, |generator| Quantity::<Length>::json_schema(generator));

#[derive(Debug, Clone, Copy)]
struct FontSize(f64);

impl Default for FontSize {
    fn default() -> Self {
        Self(8.0)
    }
}

impl FontSize {
    fn allowed() -> String {
        let [least, most] = Size::FONTS;
        format!("a size of {least} to {most} points such as \"8 pt\"")
    }

    fn new(points: Option<f64>, found: &dyn fmt::Display) -> Result<Self, String> {
        let [least, most] = Size::FONTS;
        let points = points.filter(|points| (least..=most).contains(points));
        points.map(Self).ok_or_else(|| format!("found {found}; allowed: {}", Self::allowed()))
    }
}

crate::written_schema!(FontSize, |_| json!({
    "anyOf": [
        { "type": "number", "minimum": Size::FONTS[0], "maximum": Size::FONTS[1] },
        { "type": "string", "pattern": r"^\s*[0-9.]+\s*pt\s*$" },
    ],
    TYPE: "size of a font",
    UNIT: "pt; a bare number is in pt",
    RANGE: "4 to 24",
}));

impl<'de> Deserialize<'de> for FontSize {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Forms::new(&Self::allowed())
            .text(|text| {
                let points = text.trim().strip_suffix("pt").and_then(|number| number.trim().parse().ok());
                Self::new(points, &format_args!("\"{text}\""))
            })
            .number(|points, _| Self::new(Some(points), &points))
            .read(deserializer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<AcceptSpec, String> {
        toml::from_str(text).map_err(|error| error.message().to_owned())
    }

    #[test]
    fn what_is_left_out_has_its_default() {
        assert_eq!(read("").unwrap().on(1e-8), Accepted::DEFAULT);
        let given = read("area = \"5 %\"\nseparation = \"2 nm\"").unwrap().on(1e-8);
        assert_eq!(given, Accepted { separation: 0.2, area: 0.05, ..Accepted::DEFAULT });
        let given = read("conductance = \"50 %\"\nfriction = 0.05").unwrap().on(1e-8);
        assert_eq!(given, Accepted { conductance: 0.5, friction: 0.05, ..Accepted::DEFAULT });
        assert_eq!(read("separation = 1").unwrap().on(1e-8).separation, 1.0);
        assert_eq!(read("area = \"150 %\"\nstiffness = 1").unwrap().on(1e-8).area, 1.5);
    }
}
