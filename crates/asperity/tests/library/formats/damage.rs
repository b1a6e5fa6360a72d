//! Damaged files of instruments.

use super::{DAMAGES, file};
use asperity::HeightMap;
use asperity::topography::read::{ReadOptions, height_map, metadata};
use std::path::Path;

/// The map of a file that states all that is needed.
pub(super) fn read(path: &Path) -> HeightMap {
    height_map(path, ReadOptions::default()).unwrap()
}

/// Asserts that a file cut at these lengths, or with some bytes replaced, is read or refused without a panic,
/// and that its header and its map have the same size.
pub(super) fn assert_no_panic(sample: &[u8], lengths: impl Iterator<Item = usize>) {
    let (_folder, path) = file(sample);
    let mut state = 1u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    let cut = lengths.filter_map(|length| Some(sample.get(..length)?.to_vec()));
    let mut samples: Vec<Vec<u8>> = cut.collect();
    for _ in 0..DAMAGES {
        let mut bytes = sample.to_vec();
        for _ in 0..=random(3) {
            let place = random(bytes.len());
            match random(4) {
                0 => bytes[place] = random(256) as u8,
                1 => bytes[place] = b"0;,.-eE9 \n\t*#"[random(13)],
                2 => bytes[place] = [0, 0x7f, 0x80, 0xff][random(4)],
                _ => drop(bytes.splice(place..place, [bytes[place], b'9'])),
            }
        }
        samples.push(bytes);
    }
    for bytes in samples {
        std::fs::write(&path, &bytes).unwrap();
        let given = ReadOptions { pixel: None, unit: None };
        if let (Ok(head), Ok(map)) = (metadata(&path), height_map(&path, given)) {
            assert_eq!(head.points, map.points());
        }
    }
}
