//! Alicona `.al3d`: tags of text, then a depth image of single precision in metres.

use super::channel::{Channel, Numbers, Stored};
use super::error::{ReadError, shortened};
use super::source::{Fields, Source};
use super::{Format, Reader};
use crate::numeric::stored::NumberType::F32;

pub(super) const FORMAT: Format = Format {
    name: "an Alicona AL3D file",
    endings: &["al3d"],
    is: |source| source.begin().starts_with(MAGIC),
    read: Reader::Channels(channels),
};

const MAGIC: &[u8; 17] = b"AliconaImaging\x00\r\n";
/// Bytes of a tag: a key of 20, a value of 30, the end of a line.
const TAG: usize = 52;

struct Tags(Fields);

impl Tags {
    /// The value of a key.
    fn text(&self, key: &str) -> Result<String, ReadError> {
        let mut places = (0..self.0.bytes.len() / TAG).map(|k| k * TAG);
        let found = places.find(|&at| self.0.text(at, 20).is_ok_and(|found| found == key));
        let at = found.ok_or_else(|| corrupt!("has no tag {key}"))?;
        self.0.text(at + 20, 30)
    }

    fn number<T: std::str::FromStr>(&self, key: &str) -> Result<T, ReadError> {
        let text = self.text(key)?;
        text.parse().map_err(|_| corrupt!("has the tag {key} = \"{}\"; allowed: a number", shortened(&text)))
    }
}

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let begin = MAGIC.len() as u64;
    // Version and number of tags stand first.
    let count: u64 = Tags(source.fields(begin, 2 * TAG as u64)?).number("TagCount")?;
    let bytes = count.saturating_add(2).saturating_mul(TAG as u64);
    let tags = Tags(source.fields(begin, bytes)?);
    let start: u64 = tags.number("DepthImageOffset")?;
    if start == 0 {
        return Err(unsupported!("holds no depth image"));
    }
    let points: [u64; 2] = [tags.number("Cols")?, tags.number("Rows")?];
    // Lines begin at multiples of eight bytes, unless what follows the image says that they do not.
    let end = points[0].saturating_mul(points[1]).saturating_mul(4).saturating_add(start);
    let is_packed =
        end == source.length() || tags.number("TextureImageOffset").is_ok_and(|next: u64| next == end);
    let stride = points[0].saturating_mul(4).checked_next_multiple_of(8).filter(|_| !is_packed);
    let mark: f64 = tags.number("InvalidPixelValue").unwrap_or(f64::NAN);
    /// The mark is rounded as it is written.
    const ROUNDING: f64 = 1.5e-7;
    Ok(vec![Channel {
        pixel: Some([tags.number("PixelSizeXMeter")?, tags.number("PixelSizeYMeter")?]),
        missing: Box::new(move |value| (value - mark).abs() <= ROUNDING * mark.abs()),
        ..Channel::new("Depth", points, Numbers::Stored(Stored { stride, ..Stored::new(start, F32) }))
    }])
}
