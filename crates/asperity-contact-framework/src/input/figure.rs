//! `figure = { width = "85 mm", font = "8 pt" }`: figures in the size of a journal.

use std::fmt;

use asperity_plot::Size;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};
use serde_json::json;

use super::Forms;
use super::quantity::{Length, Quantity};
use super::schema::{RANGE, TYPE, UNIT};

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
