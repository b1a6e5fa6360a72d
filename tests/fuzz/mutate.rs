//! Random changes to inputs, of the kinds that libFuzzer makes.

use std::path::PathBuf;

use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;

/// The most changes to an input.
const CHANGES: usize = 5;
/// Longer inputs are seldom changed, which takes time.
const LONG: usize = 8192;
/// Numbers that sizes are often compared with.
const NUMBERS: [u64; 12] =
    [0, 1, 2, 0x7f, 0x80, 0xff, 0x7fff, 0xffff, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff, u64::MAX];
/// Letters of numbers, keys and tables.
const LETTERS: &[u8] = b"0123456789.,;:-+eE \t\n\r\"'#=[]{}()<>/\\_axNn\0\xff";

/// One of the inputs, changed in one to five places.
pub fn changed(inputs: &[(PathBuf, Vec<u8>)], rng: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = picked(inputs, rng).to_vec();
    for _ in 0..rng.random_range(1..=CHANGES) {
        change(&mut bytes, picked(inputs, rng), rng);
    }
    bytes
}

fn picked<'a>(inputs: &'a [(PathBuf, Vec<u8>)], rng: &mut ChaCha8Rng) -> &'a [u8] {
    let mut pick = || &inputs[rng.random_range(0..inputs.len())].1;
    let first = pick();
    if first.len() > LONG { pick() } else { first }
}

/// A range of bytes of at most `most`.
fn part(length: usize, most: usize, rng: &mut ChaCha8Rng) -> std::ops::Range<usize> {
    let start = rng.random_range(0..=length);
    start..start + rng.random_range(0..=most.min(length - start))
}

fn change(bytes: &mut Vec<u8>, other: &[u8], rng: &mut ChaCha8Rng) {
    if bytes.is_empty() {
        bytes.extend(other);
        return;
    }
    let place = rng.random_range(0..bytes.len());
    match rng.random_range(0..9) {
        0 => bytes[place] ^= 1 << rng.random_range(0..8),
        1 => bytes[place] = rng.random(),
        2 => bytes[place] = LETTERS[rng.random_range(0..LETTERS.len())],
        3 => number(&mut bytes[place..], rng),
        4 => drop(bytes.drain(part(bytes.len(), 64, rng))),
        5 => {
            let copied = bytes[part(bytes.len(), 64, rng)].to_vec();
            let times = if rng.random_range(0..8) == 0 { 100 } else { 1 };
            bytes.splice(place..place, copied.repeat(times));
        }
        6 => {
            let taken = other[part(other.len(), 256, rng)].to_vec();
            let end = bytes.len().min(place + if rng.random() { taken.len() } else { 0 });
            bytes.splice(place..end, taken);
        }
        7 => digits(bytes, place, rng),
        _ => bytes.truncate(place),
    }
}

/// Writes a number of one to eight bytes in either order: one of the usual, or what stands there and one more or less.
fn number(bytes: &mut [u8], rng: &mut ChaCha8Rng) {
    let width = [1, 2, 4, 8][rng.random_range(0..4)].min(bytes.len());
    let mut value = [0; 8];
    value[..width].copy_from_slice(&bytes[..width]);
    let value = match rng.random_range(0..3) {
        0 => NUMBERS[rng.random_range(0..NUMBERS.len())],
        1 => u64::from_le_bytes(value).wrapping_add(1),
        _ => u64::from_le_bytes(value).wrapping_sub(1),
    };
    bytes[..width].copy_from_slice(&value.to_le_bytes()[..width]);
    if rng.random() {
        bytes[..width].reverse();
    }
}

/// Replaces the digits around a place by another number.
fn digits(bytes: &mut Vec<u8>, place: usize, rng: &mut ChaCha8Rng) {
    let Some(start) = (place..bytes.len()).find(|&k| bytes[k].is_ascii_digit()) else { return };
    let end = (start..bytes.len()).find(|&k| !bytes[k].is_ascii_digit()).unwrap_or(bytes.len());
    let value = match rng.random_range(0..3) {
        0 => NUMBERS[rng.random_range(0..NUMBERS.len())],
        1 => rng.next_u64() >> rng.random_range(0..64),
        _ => rng.random_range(0..20),
    };
    bytes.splice(start..end, value.to_string().into_bytes());
}
