//! Fields of values on a regular grid, and their images as small PNG files in data URIs.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use png::{BitDepth, ColorType, Compression, Encoder, Filter};

use crate::ticks::{Scale, measure};
use crate::{Axis, ColourMap};

/// A field of values on a regular grid, shown as an image below the axes' ticks. Both axes must be
/// linear: between others the field is not shown.
#[derive(Clone, Debug)]
pub struct Raster {
    /// Where the field begins and ends along x, in the unit of the axis: outer edges of the outermost
    /// cells. Axes without a range of their own end where the field does.
    pub x: (f64, f64),
    /// Where the field begins and ends along y; the first row lies at the first value.
    pub y: (f64, f64),
    /// Cells along x.
    pub columns: usize,
    /// Cells along y.
    pub rows: usize,
    /// A value for each cell, x fastest; NaN is transparent. A list of another length than
    /// `columns * rows` is not shown.
    pub values: Vec<f64>,
    pub map: ColourMap,
    /// The values at the two ends of the map; values beyond have the colour of the nearer end. Unless
    /// given, the values' own range: from zero where none is negative, symmetric about zero for
    /// [`ColourMap::Diverging`].
    pub limits: Option<(f64, f64)>,
    /// What the values are, with their unit: the label of the colour bar.
    pub label: String,
}

/// Counts are binned into at most so many columns, and rows.
const MOST_BINS: usize = 2000;
/// Smallest cell size in pixels of the page.
const FINE: f64 = 2.0;
/// Pixels of an image along a cell.
const MOST_PER_CELL: usize = 3;
/// Colours besides the transparent one: all that a byte can name.
const COLOURS: u8 = 255;
/// Steps of greys: files are half as large as with all colours.
const GREYS: f64 = 24.0;

impl Raster {
    /// How many points lie in each cell of a grid over `x` and `y`, coloured by equal ratios; cells
    /// without any are NaN. A point on the outer edge counts, one outside or not finite does not. At
    /// most 2,000 columns and rows.
    pub fn of_points(
        points: impl IntoIterator<Item = (f64, f64)>,
        x: (f64, f64),
        y: (f64, f64),
        columns: usize,
        rows: usize,
    ) -> Self {
        let (columns, rows) = (columns.clamp(1, MOST_BINS), rows.clamp(1, MOST_BINS));
        let cell = |value: f64, (from, to): (f64, f64), cells: usize| {
            let part = (value - from) / (to - from);
            (0.0..=1.0).contains(&part).then(|| ((part * cells as f64) as usize).min(cells - 1))
        };
        let mut values = vec![f64::NAN; columns * rows];
        let mut most = 0.0_f64;
        for point in points {
            let (Some(column), Some(row)) = (cell(point.0, x, columns), cell(point.1, y, rows)) else {
                continue;
            };
            let count = &mut values[row * columns + column];
            *count = if count.is_nan() { 1.0 } else { *count + 1.0 };
            most = most.max(*count);
        }
        // A decade at least, so that the bar has whole numbers to show.
        let limits = Some((1.0, most.max(10.0)));
        let label = "points per cell".into();
        Self { x, y, columns, rows, values, map: ColourMap::Counts, limits, label }
    }

    /// The same field on at most so many columns and rows: each new cell has the mean of what it covers, by
    /// area, NaN left out.
    pub(super) fn reduced_to(&self, columns: usize, rows: usize) -> Self {
        let (columns, rows) = (columns.clamp(1, self.columns.max(1)), rows.clamp(1, self.rows.max(1)));
        if !self.is_whole() || (columns, rows) == (self.columns, self.rows) {
            return self.clone();
        }
        let (across, along) = (shares(self.columns, columns), shares(self.rows, rows));
        let mut sums = vec![(0.0, 0.0); columns * rows];
        for (line, along) in self.values.chunks_exact(self.columns).zip(&along) {
            for (value, across) in line.iter().zip(&across).filter(|(value, _)| value.is_finite()) {
                for (row, height) in along {
                    for (column, width) in across {
                        let (sum, area) = &mut sums[row * columns + column];
                        *sum += value * width * height;
                        *area += width * height;
                    }
                }
            }
        }
        let mean = |(sum, area): (f64, f64)| if area > 0.0 { sum / area } else { f64::NAN };
        Self {
            columns,
            rows,
            values: sums.into_iter().map(mean).collect(),
            label: self.label.clone(),
            ..*self
        }
    }

    fn is_whole(&self) -> bool {
        !self.values.is_empty() && self.columns.checked_mul(self.rows) == Some(self.values.len())
    }

    /// From values to places in the map; none if there is nothing to show.
    pub(super) fn scale(&self) -> Option<Scale> {
        let spread = self.map.spread();
        let shown = self.values.iter().filter(|value| self.is_whole() && measure(spread, **value).is_some());
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in shown {
            low = low.min(*value);
            high = high.max(*value);
        }
        if low > high {
            return None;
        }
        let own = match self.map {
            ColourMap::Sequential if low >= 0.0 => (0.0, if high > 0.0 { high } else { 1.0 }),
            ColourMap::Diverging => (-high.max(-low), high.max(-low)),
            ColourMap::Sequential | ColourMap::Counts | ColourMap::Relief => (low, high),
        };
        // Limits that cannot be used give way to the values.
        let usable = |ends: &(f64, f64)| [ends.0, ends.1].iter().all(|end| measure(spread, *end).is_some());
        let (from, to) = self.limits.filter(usable).unwrap_or(own);
        let axis = Axis { spread, ..Axis::linear("").range(from.min(to), from.max(to)) };
        Some(Scale::new(&axis, [own.0, own.1].into_iter(), false))
    }

    /// The image as a PNG in a data URI, for a place of `size` pixels. `reversed` says which axis
    /// the field begins at the right, and at the top.
    pub(super) fn image(&self, scale: &Scale, reversed: (bool, bool), size: (f64, f64)) -> Option<String> {
        // Viewers that blend neighbouring pixels keep the edges of cells that are made of several.
        let pixels = |length: f64, cells: usize| {
            let cell = length / cells as f64;
            if cell < FINE { 1 } else { (cell.ceil() as usize).min(MOST_PER_CELL) }
        };
        let (wide, high) = (pixels(size.0, self.columns), pixels(size.1, self.rows));
        let index = |column: usize, row: usize| {
            let column = if reversed.0 { self.columns - 1 - column } else { column };
            let row = if reversed.1 { row } else { self.rows - 1 - row };
            let place = scale.place(self.values[row * self.columns + column])?.clamp(0.0, 1.0);
            let place = if self.map == ColourMap::Relief { (place * GREYS).round() / GREYS } else { place };
            Some(1 + (place * f64::from(COLOURS - 1)).round() as u8)
        };
        let mut indices = Vec::with_capacity(self.values.len() * wide * high);
        for row in 0..self.rows {
            let cells = (0..self.columns).map(|column| index(column, row).unwrap_or(0));
            let line: Vec<u8> = cells.flat_map(|cell| std::iter::repeat_n(cell, wide)).collect();
            (0..high).for_each(|_| indices.extend_from_slice(&line));
        }
        encode(&indices, [self.columns * wide, self.rows * high], &palette(self.map), &[0])
    }
}

/// The colours of a map behind the transparent one.
pub(super) fn palette(map: ColourMap) -> Vec<[u8; 3]> {
    let colours = (0..COLOURS).map(|k| map.rgb(f64::from(k) / f64::from(COLOURS - 1)));
    std::iter::once([255; 3]).chain(colours.map(|colour| [colour.0, colour.1, colour.2])).collect()
}

/// For each of `from` equal cells the one or two of `to` larger cells over the same length that it
/// reaches into, and how much of its length lies in each.
fn shares(from: usize, to: usize) -> Vec<Vec<(usize, f64)>> {
    let share = |k: usize| {
        // In units that divide both: a small cell is `to` long, a large one `from`.
        let (start, end) = (k * to, (k + 1) * to);
        let (first, last) = (start / from, (end - 1) / from);
        if first == last {
            return vec![(first, 1.0)];
        }
        let border = last * from;
        [(first, border - start), (last, end - border)]
            .map(|(cell, part)| (cell, part as f64 / to as f64))
            .into()
    };
    (0..from).map(share).collect()
}

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
    used.clone().zip(0..=u8::MAX).for_each(|(colour, place)| places[colour] = place);
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

    fn raster(columns: usize, rows: usize, values: Vec<f64>) -> Raster {
        let (map, label) = (ColourMap::Sequential, String::new());
        Raster { x: (0.0, 1.0), y: (0.0, 1.0), columns, rows, values, map, limits: None, label }
    }

    #[test]
    fn a_reduced_field_keeps_its_mean() {
        let field = raster(7, 5, (0..35).map(|k| f64::from(k * k)).collect());
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let small = field.reduced_to(3, 3);
        assert_eq!((small.columns, small.rows, small.values.len()), (3, 3, 9));
        assert!((mean(&small.values) - mean(&field.values)).abs() < 1e-9);
        assert_eq!(field.reduced_to(100, 100).values, field.values);
        assert_eq!(raster(4, 1, vec![1.0, 3.0, 5.0, 9.0]).reduced_to(2, 2).values, [2.0, 7.0]);
        assert_eq!(raster(3, 1, vec![1.0, 4.0, 7.0]).reduced_to(2, 2).values, [2.0, 6.0]);
    }

    #[test]
    fn holes_do_not_count_and_stay_where_nothing_is() {
        let field = raster(4, 1, vec![1.0, f64::NAN, f64::NAN, f64::NAN]).reduced_to(2, 2);
        assert_eq!(field.values[0], 1.0);
        assert!(field.values[1].is_nan());
    }

    #[test]
    fn each_point_inside_is_counted_once() {
        let points = [(0.0, 0.0), (1.0, 1.0), (0.9, 0.9), (0.4, 0.6), (1.1, 0.5), (f64::NAN, 0.5)];
        let field = Raster::of_points(points, (0.0, 1.0), (0.0, 1.0), 2, 2);
        assert_eq!((field.values[0], field.values[2], field.values[3]), (1.0, 1.0, 2.0));
        assert!(field.values[1].is_nan());
        assert!(Raster::of_points(points, (1.0, 1.0), (0.0, 1.0), 2, 2).scale().is_none());
    }

    #[test]
    fn the_map_begins_at_zero_or_lies_about_it() {
        let ends = |map: ColourMap, values: Vec<f64>, limits: Option<(f64, f64)>| {
            let scale = Raster { map, limits, ..raster(values.len(), 1, values) }.scale();
            scale.map(|scale| (scale.from, scale.to))
        };
        assert_eq!(ends(ColourMap::Sequential, vec![2.0, 5.0], None), Some((0.0, 5.0)));
        assert_eq!(ends(ColourMap::Sequential, vec![0.0, 0.0], None), Some((0.0, 1.0)));
        assert_eq!(ends(ColourMap::Diverging, vec![-1.0, 5.0, f64::NAN], None), Some((-5.0, 5.0)));
        assert_eq!(ends(ColourMap::Diverging, vec![1.0], Some((3.0, -2.0))), Some((-2.0, 3.0)));
        assert_eq!(ends(ColourMap::Diverging, vec![1.0, 2.0], Some((3.0, f64::NAN))), Some((-2.0, 2.0)));
        assert_eq!(ends(ColourMap::Counts, vec![0.0, 1.0, 100.0], None), Some((0.0, 2.0)));
        assert_eq!(ends(ColourMap::Counts, vec![0.0, -1.0], None), None);
    }

    /// Of an image, the first row of pixels is the upper one.
    #[test]
    fn the_first_cell_stands_at_the_lower_left() {
        let field = raster(2, 3, vec![5.0, 1.0, 2.0, 2.0, 3.0, 4.0]);
        let corners = |reversed| {
            let uri = field.image(&field.scale().unwrap(), reversed, (2.0, 3.0)).unwrap();
            let (pixels, info) = decoded(&uri, png::Transformations::IDENTITY);
            let (wide, high) = (info.width as usize, info.height as usize);
            // Upper left, upper right, lower left, lower right: values in ascending order, from 1.
            [0, wide - 1, (high - 1) * wide, high * wide - 1].map(|at| pixels[at] + 1)
        };
        assert_eq!(corners((false, false)), [3, 4, 5, 1]);
        assert_eq!(corners((true, false)), [4, 3, 1, 5]);
        assert_eq!(corners((false, true)), [5, 1, 3, 4]);
    }

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
    fn all_colours_may_be_there() {
        let palette: Vec<[u8; 3]> = (0..=u8::MAX).map(|colour| [colour; 3]).collect();
        let indices: Vec<u8> = (0..=u8::MAX).collect();
        let (pixels, _) =
            decoded(&encode(&indices, [16, 16], &palette, &[0]).unwrap(), png::Transformations::IDENTITY);
        assert_eq!(pixels, indices);
    }

    #[test]
    fn no_pixels_no_file() {
        assert_eq!(encode(&[], [0, 2], &[[0; 3]], &[0]), None);
        assert_eq!(encode(&[1], [2, 2], &[[0; 3]; 2], &[0]), None);
    }
}
