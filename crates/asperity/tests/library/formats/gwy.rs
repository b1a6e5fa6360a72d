//! Gwyddion's own files.

use super::instrument::assert_heights;
use super::refused::Good;
use super::*;

const HIDDEN: f64 = 7.25;

fn named(name: &str, kind: u8, value: &[u8]) -> Vec<u8> {
    [name.as_bytes(), &[0, kind], value].concat()
}

fn object(name: &str, content: &[u8]) -> Vec<u8> {
    [name.as_bytes(), &[0], &(content.len() as u32).to_le_bytes(), content].concat()
}

fn unit(name: &str, unit: &str) -> Vec<u8> {
    named(name, b'o', &object("GwySIUnit", &named("unitstr", b's', &[unit.as_bytes(), &[0]].concat())))
}

/// A data field of 10 x 12 units with numbers in lines.
fn field(units: [&str; 2], numbers: impl Iterator<Item = f64>) -> Vec<u8> {
    let numbers: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
    let content = [
        named("xres", b'i', &(NX as u32).to_le_bytes()),
        named("yres", b'i', &(NY as u32).to_le_bytes()),
        named("xreal", b'd', &(NX as f64 * PIXEL[0]).to_le_bytes()),
        named("yreal", b'd', &(NY as f64 * PIXEL[1]).to_le_bytes()),
        named("xoff", b'd', &1.0f64.to_le_bytes()),
        unit("si_unit_xy", units[0]),
        unit("si_unit_z", units[1]),
        named("data", b'D', &[&((numbers.len() / 8) as u32).to_le_bytes()[..], &numbers].concat()),
    ];
    object("GwyDataField", &content.concat())
}

fn titled(number: u32, title: &str, field: &[u8]) -> Vec<u8> {
    let title = named(&format!("/{number}/data/title"), b's', &[title.as_bytes(), &[0]].concat());
    [title, named(&format!("/{number}/data"), b'o', field)].concat()
}

fn heights(units: [&str; 2]) -> Vec<u8> {
    field(units, in_lines().map(|z| if z.is_nan() { HIDDEN } else { z }))
}

fn mask() -> Vec<u8> {
    field(["m", ""], in_lines().map(|z| f64::from(u8::from(z.is_nan()))))
}

fn container(content: &[u8]) -> Vec<u8> {
    [b"GWYP".to_vec(), object("GwyContainer", content)].concat()
}

/// Components of every type, and two channels, the second with a mask.
fn every() -> Vec<u8> {
    let two = 2u32.to_le_bytes();
    let objects = [&two[..], &object("", &[]), &object("GwySelection", &[1, 2])].concat();
    let content = [
        named("/0/select", b'O', &objects),
        named("names", b'S', &[&two[..], b"one\0two\0"].concat()),
        named("/12/mask", b'o', &mask()),
        titled(12, "Height", &heights(["m", "nm"])),
        titled(3, "Phase", &heights(["m", "deg"])),
        named("/12/base/range-type", b'i', &two),
        named("/12/data/visible", b'b', &[1]),
        named("letter", b'c', b"x"),
        named("long", b'q', &[0; 8]),
        named("real", b'd', &[0; 8]),
        named("/bad", b's', b"text\0"),
        named("/x/data", b'o', &object("GwyDataField", &[])),
        named("/0/meta", b'o', &object("GwyContainer", &[0; 30])),
        named("letters", b'C', &[&two[..], b"xy"].concat()),
        named("integers", b'I', &[&two[..], &[0; 8]].concat()),
        named("longs", b'Q', &[&two[..], &[0; 16]].concat()),
    ];
    container(&content.concat())
}

pub fn good() -> Vec<Good> {
    vec![Good::whole("gwy", container(&titled(0, "I", &heights(["m", "nm"]))))]
}

#[test]
fn gwy_heights_and_what_a_mask_hides() {
    let bytes = every();
    assert_eq!(channels(&bytes), ["Height", "\"Phase\" (deg)", "\"Height, less its mask\""]);
    let seen = read_map(&bytes, AS_IT_IS);
    assert_eq!(seen.heights()[3 * NY + 1], HIDDEN * 1e-9);
    let head = assert_heights(&bytes, Some("height, less its MASK"), PIXEL, |ix, iy| 1e-9 * z(ix, iy));
    assert!(head.has_unit);
    // A number that is none, as other programs write it.
    assert_map(
        container(&titled(0, "", &field(["m", "m"], in_lines().map(|z| z * 1e-9)))),
        AS_IT_IS,
        1e-9,
        PIXEL,
    );
    let unnamed = container(&named("/7/data", b'o', &field(["", ""], in_lines())));
    let head = assert_map(unnamed, IN_NM, 1e-9, PIXEL);
    assert_eq!((head.pixel, head.has_unit), (None, false));
    assert_eq!(head.channel.unwrap().name, "Channel 7");
    // A unit that is given is that of the heights: the pixel is in metres.
    let without = container(&named("/7/data", b'o', &field(["m", ""], in_lines())));
    let in_nm = ReadOptions { pixel: None, ..IN_NM };
    let head = assert_map(without, in_nm, 1e-9, PIXEL);
    assert_eq!((head.pixel, head.has_unit), (Some(PIXEL), false));
}

#[test]
fn the_mask_of_another_map_hides_nothing() {
    let whole = heights(["m", "nm"]);
    let mut other = mask();
    let at = other.windows(4).position(|name| name == b"xres").unwrap() + 6;
    (other[at], other[at + 10]) = (10, 2);
    let (_folder, path) = file(container(&[titled(0, "a", &whole), named("/0/mask", b'o', &other)].concat()));
    let masked = MapFile { channel: Some("a, less its mask".to_owned()), ..MapFile::new(&path, AS_IT_IS) };
    let error = masked.height_map().unwrap_err();
    assert!(error.to_string().contains("a mask of 10 x 2 points on a map of 5 x 4"), "{error}");
    assert_eq!(height_map(&path, AS_IT_IS).unwrap().points(), [NX, NY]);
}
