//! Why a measured surface is not read, in the keys of a spec.

use std::path::Path;

use asperity::ListError;
use asperity::topography::read::{ReadError, ReadOptionsError};
use asperity_contact_framework::report::format::input_quantity;

use super::options::quoted;

/// What is wrong with a file, and the keys that correct it.
pub fn spec_message(error: &ReadError) -> String {
    match error {
        ReadError::Options(error) => options_message(error),
        ReadError::TooTall { .. } => {
            format!(
                "{error} (`unit = \"um\"` means that the numbers of the file are micrometres, `unit = {{ xy = \"mm\", z = \"um\" }}` that \
                 coordinates are millimetres and heights micrometres)"
            )
        }
        ReadError::Mark { value, .. } => {
            // As large a whole number is none of TOML.
            let mark = if value.abs() < 1e15 { value.to_string() } else { format!("{value:e}") };
            format!("{error} Write `missing = {mark}`; `missing = []` where these are heights")
        }
        ReadError::Word { word, .. } => {
            format!("{error}; `missing = {}` means that it marks missing points", quoted(word))
        }
        ReadError::Crop { axis, ends, side, pixel } => {
            let why = match *ends {
                [from, to] if from >= to => "ends before it begins",
                [from, to] if to - from < 3.0 * pixel && to <= *side => "leaves fewer than three points",
                _ => "is not within it",
            };
            let [from, to, side, pixel] =
                [ends[0], ends[1], *side, *pixel].map(|length| input_quantity(length, "m"));
            format!(
                "is {side} long along {axis}, with points every {pixel}: `crop` from {from} to {to} {why}; allowed: from 0 m to its length, three \
                 points at least"
            )
        }
        ReadError::Channel { .. } => format!("{error} (`channel`)"),
        _ => error.to_string(),
    }
}

/// What is wrong with a list of asperities.
pub fn list_message(path: &Path, error: &ListError) -> String {
    let unit = match error {
        ListError::Column { .. } | ListError::NoHeader { .. } => {
            "; other units stand there, as in height [um], or as unit = \"um\" next to file"
        }
        _ => "",
    };
    let text = error.to_string();
    // A place within the file, or what the file is or has.
    let comma = if ["line ", "row "].iter().any(|place| text.starts_with(place)) { "," } else { "" };
    format!("{}{comma} {text}{unit}", path.display())
}

/// What is wrong with the keys of a file.
pub fn options_message(error: &ReadOptionsError) -> String {
    match error {
        ReadOptionsError::NoPixel => {
            "holds no pixel size; allowed: `pixel = \"0.8 um\"`, or `pixel = [\"0.8 um\", \"0.5 um\"]`"
                .to_owned()
        }
        ReadOptionsError::NoUnit { .. } => {
            format!("{error}; allowed: the unit of its numbers, such as `unit = \"um\"`")
        }
        ReadOptionsError::UnitsInColumns { .. } => {
            format!("{error}: `unit = {{ xy = \"um\", z = \"nm\" }}`")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_named_where_they_help() {
        let tall = spec_message(&ReadError::TooTall { tallest: 20.0 });
        assert!(
            tall.starts_with("holds a height of 2e1 m; allowed: at most 10 m (`unit = \"um\"` means"),
            "{tall}"
        );
        assert!(spec_message(&ReadOptionsError::NoPixel.into()).contains("allowed: `pixel = "));
        let columns = ReadOptionsError::UnitsInColumns { line: 3, found: "x [px]".to_owned() };
        let message = spec_message(&columns.into());
        assert!(message.contains("in line 3: \"x [px]\"; allowed: ") && message.contains("`unit = { xy = "));
        let word = ReadError::Word { line: 1, column: 2, word: "***".to_owned() };
        assert!(spec_message(&word).ends_with("; `missing = \"***\"` means that it marks missing points"));
        let mark = ReadError::Mark { value: -9999.0, count: 1329, low: -3.0, high: 5.0 };
        let message = spec_message(&mark);
        assert!(message.starts_with("holds the height -9999 at 1329 points, far from all other heights"));
        assert!(message.contains("missing points? Write `missing = -9999`;"), "{message}");
    }
}
