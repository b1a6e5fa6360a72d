//! How a file of heights was read, where a reader should know, or why it was not, in the keys of a spec.

use std::path::Path;

use asperity::ListError;
use asperity::topography::read::{
    ChannelName, Crop, LeftOut, MapFile, Metadata, ReadError, ReadOptions, ReadOptionsError,
};
use asperity_contact_framework::report::format::{count, input_number, input_quantity};

use super::options::quoted;

/// Caveats of a file that was read as `metadata` with this pixel, m.
pub fn caveats(metadata: &Metadata, pixel: [f64; 2], file: &MapFile) -> Vec<String> {
    let mut caveats: Vec<String> = metadata.notes.iter().map(|note| format!("its file {note}.")).collect();
    caveats.extend(left_out(metadata.left_out));
    caveats.extend(replaced(metadata, &file.options));
    if !file.crop.is_whole() {
        caveats.push(format!("only a part of its file is used{}.", part(&file.crop)));
    }
    if let (Some(channel), None) = (&metadata.channel, &file.channel) {
        caveats.extend(others(channel));
    }
    if metadata.pixel.is_none() && differ(pixel, 0.01) {
        caveats.push(axes(metadata, pixel, file.transpose));
    }
    caveats
}

/// The part of a map that is used, after a comma; nothing of a whole map.
pub fn part(crop: &Crop) -> String {
    let along = |(axis, ends): (&str, Option<[f64; 2]>)| {
        let [from, to] = ends?.map(|length| input_quantity(length, "m"));
        Some(format!(", {axis} from {from} to {to}"))
    };
    [("x", crop.x), ("y", crop.y)].into_iter().filter_map(along).collect()
}

/// What the file states and the options replace by something else.
fn replaced(metadata: &Metadata, options: &ReadOptions) -> Vec<String> {
    let mut all = Vec::new();
    if let (Some(stated), Some(given)) = (metadata.replaced_units(options), options.unit) {
        all.push(format!("its file states lengths in {stated}; {given}, as `unit` says, is used instead."));
    }
    let own = metadata.pixel.and_then(|_| metadata.pixel(&ReadOptions { pixel: None, ..*options }).ok());
    if let (Some(stated), Some(given)) = (own, options.pixel)
        && differ([stated[0], given[0]], 1e-9) | differ([stated[1], given[1]], 1e-9)
    {
        let shown = |[x, y]: [f64; 2]| {
            let [x, y] = [x, y].map(|size| input_quantity(size, "m"));
            if x == y { x } else { format!("{x} x {y}") }
        };
        let (stated, given) = (shown(stated), shown(given));
        all.push(format!("its file states a pixel of {stated}; {given}, as `pixel` says, is used instead."));
    }
    all
}

/// The channel that was read, where others hold lengths, too.
fn others(ChannelName { name, others }: &ChannelName) -> Option<String> {
    let unmasked = format!("{name}, less its mask");
    if others.iter().any(|other| other.name == unmasked) {
        return Some(format!(
            "the channel \"{name}\" of its file is read with the points under its mask; `channel = \"{unmasked}\"` leaves them out."
        ));
    }
    let lengths: Vec<_> = others.iter().filter(|other| other.unit.as_deref() == Some("m")).collect();
    let another = &lengths.first()?.name;
    let more = if lengths.len() > 1 { format!(" (of {})", lengths.len()) } else { String::new() };
    Some(format!(
        "the channel \"{name}\" of its file is read; `channel = \"{another}\"` reads another{more}."
    ))
}

fn left_out(LeftOut { header, index_column, spacing }: LeftOut) -> Option<String> {
    let coordinates =
        |of: &str, step: f64| format!("holds coordinates of the {of}, {} apart", input_number(step));
    let [of_columns, of_lines] = [("columns", spacing[0]), ("lines", spacing[1])]
        .map(|(of, step)| step.map(|step| coordinates(of, step)));
    let line = header.map(|line| {
        format!("line {line} of its file {}", of_columns.as_deref().unwrap_or("names or numbers the columns"))
    });
    let column = index_column.then(|| {
        format!(
            "the first column of its file {}",
            of_lines.as_deref().unwrap_or("numbers or names the lines")
        )
    });
    Some(match (line, column) {
        (Some(line), Some(column)) => format!("{line}, and {column}: both hold no heights and are left out."),
        (Some(line), None) => format!("{line}: it holds no heights and is left out."),
        (None, Some(column)) => format!("{column}: it holds no heights and is left out."),
        (None, None) => return None,
    })
}

/// Whether two lengths differ by more than this part of them.
fn differ([x, y]: [f64; 2], rounding: f64) -> bool {
    (x / y - 1.0).abs() > rounding
}

/// Which axis of the file is x.
fn axes(metadata: &Metadata, pixel: [f64; 2], transpose: bool) -> String {
    let mut along = if metadata.has_x_first() {
        ["along the first index of the array", "along the second"]
    } else {
        ["along the lines of its file", "from line to line"]
    };
    if transpose {
        along.reverse();
    }
    let [x, y] = [0, 1].map(|axis| {
        format!("{} points of {}", count(metadata.points[axis]), input_quantity(pixel[axis], "m"))
    });
    let exchange =
        if transpose { "without `transpose`" } else { "`transpose = true` next to `path` means that" };
    format!(
        "its pixel differs along x and y: x runs {} ({x}), y {} ({y}); {exchange} they are exchanged.",
        along[0], along[1]
    )
}

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
    use asperity::topography::read::OtherChannel;

    use super::*;

    #[test]
    fn what_is_left_out_is_named() {
        let words = |header, index_column, spacing| left_out(LeftOut { header, index_column, spacing });
        assert!(words(Some(1), true, [None; 2]).unwrap().ends_with("both hold no heights and are left out."));
        assert!(words(None, true, [None; 2]).unwrap().starts_with("the first column"));
        let coordinates = words(Some(1), true, [Some(0.8), Some(1e-3)]).unwrap();
        assert!(
            coordinates.contains("of the columns, 0.8 apart")
                && coordinates.contains("of the lines, 0.001 apart"),
            "{coordinates}"
        );
    }

    /// Of a file that holds heights in others, too.
    #[test]
    fn channels_of_heights_are_named() {
        let of = |units: &[&str]| {
            let other =
                |unit: &&str| OtherChannel { name: "Sensor".to_owned(), unit: Some((*unit).to_owned()) };
            let channel =
                ChannelName { name: "Height".to_owned(), others: units.iter().map(other).collect() };
            others(&channel)
        };
        assert_eq!((of(&[]), of(&["deg"])), (None, None));
        let read = of(&["deg", "m", "m"]).unwrap();
        assert!(read.ends_with("`channel = \"Sensor\"` reads another (of 2)."), "{read}");
    }
}
