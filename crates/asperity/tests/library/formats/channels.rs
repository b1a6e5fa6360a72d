//! The channel of a file that is read, by its name or by what it holds.

use super::nid::{Set, nid};
use super::{AS_IT_IS, channels, file};
use asperity::topography::read::{MapFile, ReadError};

/// The channel read of a file with channels of these frames, names and units.
fn chosen(sets: &[[&'static str; 3]], wanted: Option<&str>) -> Result<String, ReadError> {
    let sets = sets.iter().map(|&[frame, name, unit]| Set::named(frame, name, unit, 0.0)).collect();
    let (_folder, path) = file(nid(&[sets]));
    let file = MapFile { channel: wanted.map(str::to_owned), ..MapFile::new(&path, AS_IT_IS) };
    let head = file.metadata()?;
    Ok(head.channel.unwrap().name)
}

#[test]
fn the_channel_of_the_heights_is_read() {
    for sets in [
        // A length before others, forward before backward, heights by name before other lengths, the first of equal ones.
        &[["Scan", "Phase", "\u{b0}"], ["Scan", "Current", "A"], ["Scan", "X", "nm"]][..],
        &[["Scan backward", "X", "m"], ["Scan forward", "X", "m"]],
        &[["Retrace", "Height", "m"], ["Trace", "Height", "m"]],
        &[["Scan", "Deflection", "m"], ["Scan", "Lateral", "m"]],
        &[["Scan", "Amplitude", "m"], ["Scan", "Error", "m"], ["Scan", "Z Axis", "m"]],
        &[["Scan", "Lateral", "m"], ["Scan", "Topography", "um"]],
        &[["Scan", "Error", "m"], ["Scan backward", "Height", "m"]],
    ] {
        let [frame, name, _] = sets.last().unwrap();
        assert_eq!(chosen(sets, None).unwrap(), format!("{frame} ({name})"));
    }
    assert_eq!(chosen(&[["Scan", "X", "m"], ["Scan", "Y", "m"]], None).unwrap(), "Scan (X)");
}

#[test]
fn a_channel_is_read_by_its_name() {
    let sets = [
        ["Up", "Z", "m"],
        ["Up", "Z", "nm"],
        ["Up", "Phase", "V"],
        ["up", "z", "m"],
        ["Up", "Z", "V"],
        ["Down", "Z", "m"],
    ];
    let read = |name: &str| chosen(&sets, Some(name));
    assert_eq!(chosen(&sets, None).unwrap(), "Up (Z)");
    // Equal names are numbered; letters count where names differ by them only.
    for name in ["Up (Z)", "Up (Z) (2)", "up (z)", "Down (Z)"] {
        assert_eq!(read(name).unwrap(), name);
    }
    assert_eq!(read(" down (Z)\n").unwrap(), "Down (Z)");
    assert_eq!(read("UP (Z)").unwrap(), "Up (Z)");
    let all = r#""Up (Z)", "Up (Z) (2)", "Up (Phase)" (V), "up (z)", "Up (Z) (3)" (V), "Down (Z)""#;
    let error = read("Up").unwrap_err();
    assert!(matches!(error, ReadError::Channel { .. }), "{error:?}");
    assert_eq!(error.to_string(), format!("holds no channel \"Up\"; allowed: {all}"));
    for (name, unit) in [("Up (Phase)", "V"), ("Up (Z) (3)", "V")] {
        let error = read(name).unwrap_err();
        assert!(matches!(error, ReadError::Channel { .. }), "{error:?}");
        let words = format!("holds \"{name}\" in {unit}, which is no height; allowed: {all}");
        assert_eq!(error.to_string(), words);
    }
}

#[test]
fn names_that_are_numbered_stay_apart() {
    let sets = [["Up", "Z", "m"], ["Up", "Z", "m"], ["Up", "Z) (2", "m"]];
    let sets = sets.map(|[frame, name, unit]| Set::named(frame, name, unit, 0.0));
    assert_eq!(channels(nid(&[sets.into()])), ["Up (Z)", "\"Up (Z) (2)\"", "\"Up (Z) (2) (2)\""]);
}

#[test]
fn a_file_without_a_channel_of_heights_says_what_there_is() {
    let error = chosen(&[["Scan", "Phase", "V"], ["Scan", "Force", "N"]], None).unwrap_err();
    assert_eq!(
        error.to_string(),
        "holds no channel of heights; found: \"Scan (Phase)\" (V), \"Scan (Force)\" (N)"
    );
    assert_eq!(chosen(&[], Some("Z")).unwrap_err().to_string(), "holds no map of heights");
    // One without a unit may hold heights, if no other does.
    assert_eq!(chosen(&[["Scan", "Z", ""], ["Scan", "Y", "m"]], None).unwrap(), "Scan (Y)");
    assert_eq!(chosen(&[["Scan", "Phase", "V"], ["Scan", "Z", ""]], None).unwrap(), "Scan (Z)");
}

#[test]
fn a_file_of_one_map_has_no_channels() {
    let (_folder, path) = file("1 2\n3 4\n");
    let file = MapFile { channel: Some("Z".to_owned()), ..MapFile::new(&path, AS_IT_IS) };
    let error = file.height_map().unwrap_err();
    assert!(matches!(error, ReadError::NoChannels { .. }), "{error:?}");
    assert!(error.to_string().contains("holds one map; allowed: leave channel out"), "{error}");
}
