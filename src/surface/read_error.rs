//! Why a measured surface is not read, in the keys of a spec.

use std::path::Path;

use asperity::ListError;
use asperity::topography::read::{ReadError, ReadOptionsError};
use asperity_contact_framework::report::format::input_quantity;

/// What is wrong with a file, and the keys that correct it.
pub fn spec_message(error: &ReadError) -> String {
    match error {
        ReadError::Options(error) => options_message(error),
        ReadError::TooTall { has_unit: false, .. } => {
            format!("{error} (unit = \"um\" next to path, or --unit um on the command line, sets the unit)")
        }
        ReadError::Mark { value, .. } => format!(
            "{error} Write missing = {value} next to path (--missing {value} on the command line); missing = [] (--missing none) where \
             these are heights"
        ),
        ReadError::Heading { .. } => format!(
            "{error}. Delete these lines or put # before each (three columns are x, y and the height, in this order); a pixel and a unit that they state go to pixel = \"0.8 um\" and \
             unit = \"um\" next to path (--pixel and --unit on the command line)"
        ),
        ReadError::Crop { axis, ends, side, pixel } => {
            let [from, to] = ends.map(|length| input_quantity(length, "m"));
            format!(
                "is {} long along {axis}, with points every {}: `crop` from {from} to {to} is not within it or leaves fewer than three points; \
                 allowed: from 0 m to its length",
                input_quantity(*side, "m"),
                input_quantity(*pixel, "m")
            )
        }
        ReadError::Channel { .. } => format!("{error} (--channel on the command line)"),
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
            "holds no pixel size; allowed: pixel = \"0.8 um\", or [\"0.8 um\", \"0.5 um\"], next to \
                                path (--pixel \"0.8 um\" on the command line)"
                .to_owned()
        }
        ReadOptionsError::UnitsInColumns { .. } => {
            format!(
                "{error}: unit = {{ xy = \"um\", z = \"nm\" }} next to path (--unit \"xy=um, z=nm\" on the command line)"
            )
        }
        ReadOptionsError::PixelHeld { .. }
        | ReadOptionsError::UnitHeld { .. }
        | ReadOptionsError::UnitNamed { .. } => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_named_where_they_help() {
        let tall = |has_unit| spec_message(&ReadError::TooTall { tallest: 20.0, has_unit });
        assert_eq!(tall(true), "holds a height of 2e1 m; allowed: at most 10 m");
        assert!(tall(false).ends_with(
            "at most 10 m (unit = \"um\" next to path, or --unit um on the command line, sets the unit)"
        ));
        assert!(spec_message(&ReadOptionsError::NoPixel.into()).contains("allowed: pixel = "));
        let columns = ReadOptionsError::UnitsInColumns { line: 3, found: "x [px]".to_owned() };
        let message = spec_message(&columns.into());
        assert!(message.contains("in line 3: \"x [px]\"; allowed: ") && message.contains("unit = { xy = "));
        let heading = ReadError::Heading { line: 1, found: "Date: now".to_owned(), begin: 4 };
        let message = spec_message(&heading);
        assert!(message.starts_with(
            "begins with 3 lines that hold no row of the table (line 1: \"Date: now\"), the table begins in line 4"
        ));
        assert!(
            message.contains("put # before each (three columns are x, y and the height, in this order); a pixel and a unit that they"),
            "{message}"
        );
        let mark = ReadError::Mark { value: -9999.0, count: 1329, low: -3.0, high: 5.0 };
        let message = spec_message(&mark);
        assert!(message.starts_with("holds the height -9999 at 1329 points, far from all other heights"));
        assert!(message.contains("missing points? Write missing = -9999 next to path"), "{message}");
    }
}
