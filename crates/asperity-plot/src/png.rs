//! Small PNG files as data URIs.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use png::{BitDepth, ColorType, Compression, Encoder, Filter};

/// Rows of indices into a palette of at most 256 colours, the first row at the top; the first colours have these opacities, of 255,
/// the others are opaque. Colours that no pixel has are left out. None for an image without pixels.
pub(super) fn encode(
    indices: &[u8],
    [width, height]: [usize; 2],
    palette: &[[u8; 3]],
    opacities: &[u8],
) -> Option<String> {
    let mut is_used = [false; 256];
    indices.iter().for_each(|&index| is_used[usize::from(index)] = true);
    let used = (0..palette.len()).filter(|&colour| is_used[colour]);
    let mut places = [0; 256];
    used.clone().zip(0..).for_each(|(colour, place)| places[colour] = place);
    let indices: Vec<_> = indices.iter().map(|&index| places[usize::from(index)]).collect();
    let opacities: Vec<_> = used.clone().map_while(|colour| opacities.get(colour).copied()).collect();
    let palette: Vec<_> = used.map(|colour| palette[colour]).collect();
    // Neighbours are alike in a smooth field, and in a rough one their differences are noise.
    let with = |filter| file(&indices, [width, height], &palette, &opacities, filter);
    let files: [_; 2] = rayon::join(|| with(Filter::NoFilter), || with(Filter::Adaptive)).into();
    let smallest = files.into_iter().flatten().min_by_key(Vec::len)?;
    Some(format!("data:image/png;base64,{}", STANDARD.encode(smallest)))
}

fn file(
    indices: &[u8],
    [width, height]: [usize; 2],
    palette: &[[u8; 3]],
    opacities: &[u8],
    filter: Filter,
) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width.try_into().ok()?, height.try_into().ok()?);
    encoder.set_color(ColorType::Indexed);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_palette(palette.as_flattened());
    if !opacities.is_empty() {
        encoder.set_trns(opacities);
    }
    encoder.set_compression(Compression::Balanced);
    encoder.set_filter(filter);
    let mut writer = encoder.write_header().ok()?;
    writer.write_image_data(indices).ok()?;
    writer.finish().ok()?;
    Some(bytes)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// The pixels of a file, and what it says of them.
    pub fn decoded(uri: &str, transformations: png::Transformations) -> (Vec<u8>, png::Info<'static>) {
        let bytes = STANDARD.decode(uri.strip_prefix("data:image/png;base64,").unwrap()).unwrap();
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(transformations);
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        (pixels, reader.info().clone())
    }

    #[test]
    fn the_file_holds_what_was_written() {
        let palette = [[255, 255, 255], [10, 20, 30], [40, 50, 60]];
        let uri = encode(&[0, 1, 2, 1, 0, 2], [3, 2], &palette, &[0, 128]).unwrap();
        let (pixels, info) = decoded(&uri, png::Transformations::IDENTITY);
        assert_eq!((info.width, info.height, pixels.as_slice()), (3, 2, [0, 1, 2, 1, 0, 2].as_slice()));
        assert_eq!(info.palette.as_deref(), Some(palette.as_flattened()));
        assert_eq!(info.trns.as_deref(), Some([0, 128].as_slice()));
    }

    #[test]
    fn colours_without_pixels_are_left_out() {
        let palette = [[255, 255, 255], [10, 20, 30], [40, 50, 60], [70, 80, 90]];
        let uri = encode(&[3, 1], [2, 1], &palette, &[0, 128, 64]).unwrap();
        let (pixels, info) = decoded(&uri, png::Transformations::IDENTITY);
        assert_eq!(pixels, [1, 0]);
        assert_eq!(info.palette.as_deref(), Some([palette[1], palette[3]].as_flattened()));
        assert_eq!(info.trns.as_deref(), Some([128].as_slice()));
    }

    #[test]
    fn no_pixels_no_file() {
        assert_eq!(encode(&[], [0, 2], &[[0; 3]], &[0]), None);
        assert_eq!(encode(&[1], [2, 2], &[[0; 3]; 2], &[0]), None);
    }
}
