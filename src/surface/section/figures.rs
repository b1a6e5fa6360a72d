//! Figures of a surface.

use asperity::surface::{MapOverview, Surface};
use asperity::topography::{Autocorrelation, RadialSpectrum};
use asperity::{HeightMap, Heights, Population};
use asperity_plot::{Axis, Colour, ColourMap, Dash, Figure, Layer, Marker, Plot, Raster};

/// Range of normalised heights on the axis.
const HEIGHTS: (f64, f64) = (-5.0, 5.0);
/// Range of radius ratios on the axis.
const RATIOS: (f64, f64) = (0.0, 5.0);

/// Radius ratio against normalised height (Pasaribu and Schipper 2005, Fig. 3) with both distributions, and
/// which part of the asperities lies outside. Where all radii are equal, the heights alone.
pub fn asperities(surface: &Surface, assumed: Option<&Population>) -> (Figure, f64) {
    let (name, statistics) = (&surface.name, &surface.statistics);
    let points = normalised(surface);
    let is_outside = |point: &(f64, f64)| {
        !(HEIGHTS.0..=HEIGHTS.1).contains(&point.0) || !(RATIOS.0..=RATIOS.1).contains(&point.1)
    };
    let count = points.len() as f64;
    let ((edges, density), outside) = rayon::join(
        || histogram(points.clone().map(|point| point.0), HEIGHTS),
        || points.clone().filter(is_outside).count() as f64 / count,
    );
    let mut top = Plot::new(
        format!("{name}: height distribution of the asperities"),
        height_axis(),
        Axis::linear("density"),
    )
    .with(Layer::bars(&edges, &density).coloured(Colour::Deterministic).named("asperities"));
    if let Some(population) = assumed {
        let curve = (0..=200).map(|k| {
            let x = HEIGHTS.0 + 0.05 * f64::from(k);
            (x, population.heights.density(x))
        });
        top = top.with(
            Layer::line(curve.collect::<Vec<_>>())
                .coloured(Colour::Statistical)
                .named(format!("{} heights (statistical model)", population.heights.label())),
        );
    }
    if statistics.radius_cv == 0.0 {
        return (top.into(), outside);
    }
    let title = format!("{name}: radius ratio against normalised height");
    let (main, (edges, density)) = rayon::join(
        || radii_against_heights(surface, assumed, &title),
        || histogram(points.clone().map(|point| point.1), RATIOS),
    );
    let right = Plot::new("", ratio_axis(), Axis::linear("density"))
        .with(Layer::bars(&edges, &density).coloured(Colour::Deterministic).named("asperities"));
    (Figure::joint(format!("{name}: radii against heights of the asperities"), main, top, right), outside)
}

/// Normalised height and radius ratio of each asperity.
fn normalised(surface: &Surface) -> impl ExactSizeIterator<Item = (f64, f64)> + Clone {
    let statistics = &surface.statistics;
    let heights = surface.set.heights().iter().map(|z| (z - statistics.mean_height) / statistics.sigma);
    heights.zip(surface.set.radii().iter().map(|b| b / statistics.mean_radius))
}

fn height_axis() -> Axis {
    Axis::linear("height (z − mean)/σ").range(HEIGHTS.0, HEIGHTS.1)
}

fn ratio_axis() -> Axis {
    Axis::linear("radius ratio β/β_avg").range(RATIOS.0, RATIOS.1)
}

/// Radius ratio against normalised height, as number of asperities per cell.
pub fn radii_against_heights(surface: &Surface, assumed: Option<&Population>, title: &str) -> Plot {
    let points = normalised(surface);
    // Cells hold some points each where there are enough.
    let cells = ((points.len() as f64).sqrt() as usize).clamp(30, 120);
    let field = Raster {
        label: "asperities per cell".to_owned(),
        ..Raster::of_points(points, HEIGHTS, RATIOS, cells, cells)
    };
    let plot = Plot::new(title, height_axis(), ratio_axis()).with(Layer::raster(field));
    let Some(population) = assumed else { return plot };
    let ratio = population.radius / surface.statistics.mean_radius;
    let line = Layer::line([(HEIGHTS.0, ratio), (HEIGHTS.1, ratio)]).coloured(Colour::Statistical);
    plot.with(line.dashed(Dash::Dashed).named("radius of the statistical model"))
}

/// Counts in equal bins as a probability density of all values; bins as wide as Scott (1979) has
/// them for a Gaussian of the range's scale, at least 20.
fn histogram(values: impl ExactSizeIterator<Item = f64>, (from, to): (f64, f64)) -> (Vec<f64>, Vec<f64>) {
    let count = values.len() as f64;
    let width = 3.49 / count.cbrt();
    let bins = (((to - from) / width).round() as usize).clamp(20, 100);
    let step = (to - from) / bins as f64;
    let edges = (0..=bins).map(|k| from + step * k as f64).collect();
    let mut counts = vec![0_u64; bins];
    for value in values.filter(|value| (from..to).contains(value)) {
        let bin = ((value - from) / step) as usize;
        counts[bin.min(bins - 1)] += 1;
    }
    let unit = count * step;
    (edges, counts.into_iter().map(|count| count as f64 / unit).collect())
}

/// A length unit suited to numbers up to `largest` (m), and its name.
pub fn unit(largest: f64) -> (f64, &'static str) {
    let units = [(1e-9, "nm"), (1e-6, "µm"), (1e-3, "mm"), (1.0, "m")];
    units.into_iter().rev().find(|(size, _)| largest >= *size).unwrap_or(units[0])
}

/// The limit of the colour scale (m): the 99.5 % quantile, so that a few pits do not dominate it.
fn colour_limit(map: &HeightMap) -> f64 {
    let mut sizes: Vec<f64> = map.heights().iter().filter(|z| !z.is_nan()).map(|z| z.abs()).collect();
    let place = sizes.len() * 199 / 200;
    nth(&mut sizes, place).unwrap_or(0.0)
}

/// The value at a place in ascending order, which is not made for the others; `None` beyond the last.
pub fn nth(values: &mut [f64], place: usize) -> Option<f64> {
    (place < values.len()).then(|| *values.select_nth_unstable_by(place, f64::total_cmp).1)
}

/// The heights as an image, with a circle around each of the places `marked` (m).
pub fn heights(name: &str, map: &HeightMap, marked: &[[f64; 2]]) -> Figure {
    let [nx, ny] = map.points();
    let size = [nx as f64 * map.pixel()[0], ny as f64 * map.pixel()[1]];
    let (length, length_name) = unit(size[0].max(size[1]));
    let largest = colour_limit(map);
    let (height, height_name) = unit(largest);
    // An image has x fastest, a map y.
    let values = (0..ny).flat_map(|iy| (0..nx).map(move |ix| map.heights()[ix * ny + iy] / height)).collect();
    let axis =
        |axis: &str, size: f64| Axis::linear(format!("{axis} ({length_name})")).range(0.0, size / length);
    let plot = Plot::new(format!("{name}: heights"), axis("x", size[0]), axis("y", size[1]))
        .height(420.0)
        .equal_aspect()
        .with(Layer::raster(Raster {
            x: (0.0, size[0] / length),
            y: (0.0, size[1] / length),
            columns: nx,
            rows: ny,
            values,
            map: ColourMap::Diverging,
            limits: Some((-largest / height, largest / height)),
            label: format!("height ({height_name})"),
        }));
    if marked.is_empty() {
        return plot.into();
    }
    let places: Vec<(f64, f64)> = marked.iter().map(|[x, y]| (x / length, y / length)).collect();
    plot.with(Layer::points(places, Marker::Ring).coloured(Colour::Neutral).named("spikes")).into()
}

/// Heights of all points, by counts over 5 Sq on both sides of the mean.
pub fn distribution(name: &str, counts: &[usize]) -> Figure {
    let step = (HEIGHTS.1 - HEIGHTS.0) / counts.len() as f64;
    let edges: Vec<f64> = (0..=counts.len()).map(|k| HEIGHTS.0 + step * k as f64).collect();
    let total = counts.iter().sum::<usize>().max(1) as f64;
    let density: Vec<f64> = counts.iter().map(|&count| count as f64 / (total * step)).collect();
    let gaussian = (0..=200).map(|k| {
        let x = HEIGHTS.0 + 0.05 * f64::from(k);
        (x, Heights::GAUSSIAN.density(x))
    });
    Plot::new(
        format!("{name}: height distribution of the points"),
        Axis::linear("height (z − mean)/Sq").range(HEIGHTS.0, HEIGHTS.1),
        Axis::linear("density"),
    )
    .height(260.0)
    .with(Layer::bars(&edges, &density).coloured(Colour::Deterministic).named("points"))
    .with(
        Layer::line(gaussian.collect::<Vec<_>>())
            .coloured(Colour::Neutral)
            .dashed(Dash::Dashed)
            .named("Gaussian"),
    )
    .into()
}

/// The radial spectrum, obtained and target; `None` where it was not computed.
pub fn spectrum(name: &str, whole: &MapOverview) -> Option<Figure> {
    let found = whole.spectrum.as_ref()?;
    let line = |spectrum: &RadialSpectrum| {
        // Beyond a cut-off only rounding errors are left.
        let most = spectrum.rings.iter().fold(0.0f64, |a, ring| a.max(ring.1));
        let rings = spectrum.rings.iter().filter(move |ring| ring.1 > 1e-14 * most);
        rings.copied().collect::<Vec<_>>()
    };
    let points = Layer::points(line(found), Marker::Circle).coloured(Colour::Deterministic);
    let mut plot = Plot::new(
        format!("{name}: power spectral density"),
        Axis::log("wave number q (rad/m)"),
        Axis::log("C(q) (m⁴)"),
    )
    .with(Layer::line(line(found)).coloured(Colour::Deterministic).named("obtained"))
    .with(points);
    if let Some(target) = &whole.target {
        let line = Layer::line(line(target)).coloured(Colour::Statistical).dashed(Dash::Dashed);
        plot = plot.with(line.named(if whole.is_target_of_gaussian {
            "target of the Gaussian field"
        } else {
            "target"
        }));
    }
    Some(plot.into())
}

pub fn autocorrelation(name: &str, found: &Autocorrelation) -> Figure {
    let longest = [&found.along_x, &found.along_y].map(|lags| lags.last().map_or(0.0, |lag| lag.0));
    let (length, unit) = unit(longest[0].max(longest[1]));
    let mut plot = Plot::new(
        format!("{name}: autocorrelation"),
        Axis::linear(format!("lag ({unit})")),
        Axis::linear("autocorrelation"),
    )
    .with(Layer::at_y(0.2, ""));
    for (series, (axis, lags)) in
        [("along x", &found.along_x), ("along y", &found.along_y)].into_iter().enumerate()
    {
        let line = lags.iter().map(|(lag, rho)| (lag / length, *rho));
        plot = plot.with(Layer::line(line.collect::<Vec<_>>()).coloured(Colour::Series(series)).named(axis));
    }
    if let Some(sal) = found.length {
        plot = plot.with(Layer::at_x(sal / length, "Sal"));
    }
    plot.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_histogram_has_the_area_of_the_values_that_it_shows() {
        let values: Vec<f64> = (0..1000).map(|k| 0.012 * f64::from(k) - 6.0).collect();
        let (edges, density) = histogram(values.iter().copied(), HEIGHTS);
        let area: f64 =
            edges.windows(2).zip(&density).map(|(edge, density)| (edge[1] - edge[0]) * density).sum();
        let inside = values.iter().filter(|value| (HEIGHTS.0..HEIGHTS.1).contains(value)).count();
        assert!((area - inside as f64 / 1000.0).abs() < 1e-12, "{area}");
    }

    #[test]
    fn one_height_in_two_hundred_lies_beyond_the_colours() {
        let heights = (0..1000).map(|k| if k % 2 == 0 { -0.001 } else { 0.001 } * f64::from(k)).collect();
        let map = HeightMap::new([40, 25], [1e-6; 2], heights, 0.0).unwrap();
        assert_eq!(colour_limit(&map), 0.995);
    }

    #[test]
    fn spikes_are_circled_where_they_are() {
        let map = HeightMap::new([40, 30], [1e-6; 2], (0..1200).map(f64::from).collect(), 0.0).unwrap();
        assert!(!super::heights("m", &map, &[]).part_of_page().contains("<circle"));
        let rings = |places: &[[f64; 2]]| {
            let svg = super::heights("m", &map, places).part_of_page();
            let number = |element: &str, key: &str| {
                let (_, rest) = element.split_once(&format!(" {key}=\"")).unwrap();
                rest.split_once('"').unwrap().0.parse::<f64>().unwrap()
            };
            let circles = svg.split("<circle").skip(1);
            circles.map(|circle| [number(circle, "cx"), number(circle, "cy")]).collect::<Vec<_>>()
        };
        let found = rings(&[[10e-6, 10e-6], [30e-6, 10e-6], [10e-6, 20e-6]]);
        let [first, right, above] = [found[0], found[1], found[2]];
        assert!(right[0] > first[0] && right[1] == first[1]);
        assert!(above[0] == first[0] && above[1] < first[1]);
        // One pixel is as long along x as along y.
        assert!((right[0] - first[0] - 2.0 * (first[1] - above[1])).abs() <= 20.0, "{found:?}");
    }

    /// The first index of a map is x, which runs to the right; y runs upwards.
    #[test]
    fn the_picture_of_a_map_is_not_turned() {
        use base64::Engine;
        // The highest point has the largest x and the smallest y.
        let heights = (0..12).map(|k| if k == 9 { 1e-6 } else { -1e-6 }).collect();
        let map = HeightMap::new([4, 3], [1e-6; 2], heights, 0.0).unwrap();
        let svg = super::heights("m", &map, &[]).part_of_page();
        let file = svg.split_once("base64,").unwrap().1.split_once('"').unwrap().0;
        let file = base64::engine::general_purpose::STANDARD.decode(file).unwrap();
        let mut decoder = png::Decoder::new(std::io::Cursor::new(file));
        decoder.set_transformations(png::Transformations::IDENTITY);
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        let (wide, high) = (info.width as usize, info.height as usize);
        for row in 0..3 {
            for column in 0..4 {
                let pixel = pixels[(2 * row + 1) * high / 6 * wide + (2 * column + 1) * wide / 8];
                assert_eq!(pixel, if (column, row) == (3, 2) { 255 } else { 1 }, "{column} {row}");
            }
        }
    }
}
