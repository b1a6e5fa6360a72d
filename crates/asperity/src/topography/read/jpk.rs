//! JPK `.jpk` and `.jpk-qi-image`: a TIFF of a thumbnail and one picture a channel, with tags that scale it.
//!
//! A channel has several scales ("slots"), such as volts and a calibrated height, one of which is its default. Lines are stored
//! from the bottom, unless a tag says that the grid is reflected.

use super::channel::{Channel, Numbers, Order, Quantity};
use super::error::ReadError;
use super::source::Source;
use super::tags::{Tags, has, image};
use super::{Format, Reader};

pub(super) const FORMAT: Format = Format {
    name: "a JPK image",
    endings: &["jpk", "jpk-qi-image"],
    is: |source| has(source, &WIDTHS),
    read: Reader::Channels(channels),
};

/// Lengths of the grid along x and y, m.
const WIDTHS: [u16; 2] = [0x8042, 0x8043];
const REFLECTED: u16 = 0x8045;
const NAME: u16 = 0x8050;
const RETRACE: u16 = 0x8051;
const FULL_NAME: u16 = 0x8052;
const SLOTS: u16 = 0x8080;
const DEFAULT_SLOT: u16 = 0x8081;
/// The tags of the first slot, and how far those of the next are from them.
const SLOT_NAME: u16 = 0x8090;
const ENCODER: u16 = 0x80a1;
const UNIT: u16 = 0x80a2;
const SCALING: u16 = 0x80a3;
const FACTOR: u16 = 0x80a4;
const OFFSET: u16 = 0x80a5;
const NEXT_SLOT: u16 = 0x30;

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let tags = Tags::open(source)?;
    let width = |tag: u16| Ok::<_, ReadError>(tags.number(0, tag)?.unwrap_or(0.0).abs());
    let widths = [width(WIDTHS[0])?, width(WIDTHS[1])?];
    let is_reflected = tags.number(0, REFLECTED)?.is_some_and(|value| value != 0.0);
    let mut channels = Vec::new();
    for picture in 0..tags.count() {
        // The thumbnail has colours.
        let Some(([nx, ny], kind)) = tags.grey(picture)? else { continue };
        let most = tags.most_bytes(picture)?;
        if nx.saturating_mul(ny).saturating_mul(kind.bytes()) > most {
            return Err(corrupt!("claims a picture of {nx} x {ny} points, more than its TIFF can hold"));
        }
        let Some(mut name) = tags.text(picture, FULL_NAME)?.or(tags.text(picture, NAME)?) else { continue };
        let scale = Scale::of(&tags, picture, &name)?;
        if tags.number(picture, RETRACE)?.is_some_and(|value| value != 0.0) {
            name += " (retrace)";
        }
        let numbers = Numbers::Packed(kind, Box::new(move |source| image(source, picture, most)));
        let mut channel = Channel::new(name, [nx, ny], numbers);
        channel.pixel = Some([widths[0] / nx as f64, widths[1] / ny as f64]);
        channel.order = if is_reflected { Order::Lines } else { Order::LinesUpwards };
        channel.quantity = Quantity::Length;
        (channel.factor, channel.offset) = (scale.factor, scale.offset);
        if scale.marks_missing {
            let [_, largest] = kind.range();
            channel.missing = Box::new(move |value| value == largest);
        }
        channels.push(channel.in_unit(&scale.unit));
    }
    Ok(channels)
}

/// The default scale of a channel.
struct Scale {
    factor: f64,
    offset: f64,
    unit: String,
    /// Whether the largest number of the type marks points that were not measured.
    marks_missing: bool,
}

impl Scale {
    fn of(tags: &Tags, picture: usize, name: &str) -> Result<Self, ReadError> {
        let wanted = tags.text(picture, DEFAULT_SLOT)?.unwrap_or_default();
        let count = tags.number(picture, SLOTS)?.unwrap_or(0.0) as u16;
        for slot in 0..count {
            // Beyond the largest tag there are no slots.
            let Some(shift) = slot.checked_mul(NEXT_SLOT).filter(|shift| shift.checked_add(OFFSET).is_some())
            else {
                break;
            };
            if tags.text(picture, SLOT_NAME + shift)?.as_ref() != Some(&wanted) {
                continue;
            }
            let encoder = tags.text(picture, ENCODER + shift)?.unwrap_or_default();
            let unit = tags.text(picture, UNIT + shift)?.unwrap_or_default();
            let number = |tag: u16| tags.number(picture, tag + shift);
            let (factor, offset) = (number(FACTOR)?, number(OFFSET)?);
            let [factor, offset] = match tags.text(picture, SCALING + shift)?.as_deref() {
                Some("LinearScaling") => [factor.unwrap_or(1.0), offset.unwrap_or(0.0)],
                Some("NullScaling") | None => [1.0, 0.0],
                Some(other) => {
                    return Err(unsupported!(
                        "scales its channel \"{name}\" by {other}; allowed: LinearScaling, NullScaling"
                    ));
                }
            };
            return Ok(Self { factor, offset, unit, marks_missing: encoder.ends_with("WithValidity") });
        }
        Err(corrupt!("has no scale \"{wanted}\" of its channel \"{name}\", which it says to be the default"))
    }
}
