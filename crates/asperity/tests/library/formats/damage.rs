//! Damaged files: read or refused, never a panic.

use super::{PIXEL, file};
use asperity::topography::Rows;
use asperity::topography::read::{ReadOptions, height_map, metadata};
use std::path::Path;

/// How often each sample is damaged.
const DAMAGES: usize = 300;

/// Asserts that every beginning of a file, and the file with some bytes replaced, is read or refused without a panic.
pub(super) fn assert_no_panic(sample: &[u8]) {
    cut(sample, 0..sample.len());
    damage(sample);
}

/// The same of a file that ends at these lengths.
pub(super) fn cut(sample: &[u8], lengths: impl DoubleEndedIterator<Item = usize>) {
    let (_folder, path) = file(sample);
    for length in lengths.rev() {
        std::fs::OpenOptions::new().write(true).open(&path).unwrap().set_len(length as u64).unwrap();
        read_or_refuse(&path);
    }
}

/// The same of a file with some bytes replaced, added or cut off.
pub(super) fn damage(sample: &[u8]) {
    let (_folder, path) = file(sample);
    let mut state = 1u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    for _ in 0..DAMAGES {
        let mut bytes = sample.to_vec();
        for _ in 0..=random(3) {
            let place = random(bytes.len());
            match random(5) {
                0 => bytes[place] = random(256) as u8,
                1 => bytes[place] = b"0;,.-eE9 \n\t*#"[random(13)],
                2 => bytes[place] = [0, 0x7f, 0x80, 0xff][random(4)],
                3 => bytes.truncate(place + 1),
                _ => drop(bytes.splice(place..place, [bytes[place], b'9'])),
            }
        }
        std::fs::write(&path, &bytes).unwrap();
        read_or_refuse(&path);
    }
}

/// Reads a file, with a pixel where it states none; its header and its map have the same size.
fn read_or_refuse(path: &Path) {
    let Ok(head) = metadata(path) else { return };
    let pixel = head.pixel.is_none().then_some(PIXEL);
    if let Ok(map) = height_map(path, ReadOptions { pixel, unit: None }) {
        assert_eq!(head.points, map.points());
        assert!(map.offset().is_finite());
    }
}
