//! Properties of a surface as a table of two columns.

use crate::surface::fitness::blocked_by;
use crate::surface::found::{MapFacts, Surface};
use asperity::topography::Quantisation;
use asperity_framework::report::format::{count, input_quantity, number, quantity};

/// A property and its value.
pub type Row = [String; 2];

/// A number, or a dash where there is none.
pub fn or_dash(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), number)
}

/// A surface in a sentence: its roughness, its asperities, and whether its map may carry a verdict.
pub fn sentence(surface: &Surface) -> String {
    let statistics = &surface.reported_statistics();
    let roughness = surface.map.as_ref().map_or_else(String::new, |map| {
        let moments = &map.roughness.moments;
        let shape = moments.ssk.zip(moments.sku).map_or_else(String::new, |(skewness, kurtosis)| {
            format!(", skewness {}, kurtosis {}", number(skewness), number(kurtosis))
        });
        format!("Sq = {}{shape}; ", quantity(moments.sq, "m"))
    });
    let fitness = match (surface.map.is_some(), blocked_by(surface)) {
        (false, _) => String::new(),
        (true, None) => " No check of the map blocks a verdict.".to_owned(),
        (true, Some(faults)) => format!(" The map carries no verdict until it is fit: {faults}."),
    };
    format!(
        "{roughness}{} asperities ({} /m²) of mean radius {}, their heights with σ = {}.{fitness}",
        count(surface.set.count()),
        number(surface.set.density()),
        quantity(statistics.mean_radius, "m"),
        quantity(statistics.sigma, "m")
    )
}

/// All numerical properties of a surface.
pub fn properties(surface: &Surface) -> Vec<Row> {
    let statistics = &surface.reported_statistics();
    let mut rows = Rows(Vec::new());
    rows.add("asperities", count(surface.set.count()));
    rows.add("nominal area", format!("{} m²", number(surface.set.nominal_area())));
    rows.add("density η", format!("{} /m²", number(surface.set.density())));
    rows.add("mean asperity height", quantity(statistics.mean_height, "m"));
    rows.add("σ of asperity heights", quantity(statistics.sigma, "m"));
    rows.add(
        "skewness, kurtosis",
        format!("{}, {}", or_dash(statistics.skewness), or_dash(statistics.kurtosis)),
    );
    rows.add("mean radius", quantity(statistics.mean_radius, "m"));
    rows.add("1/(mean curvature)", quantity(statistics.radius_of_mean_curvature, "m"));
    rows.add("scatter of radii over mean", number(statistics.radius_cv));
    rows.add("correlation of height and radius", or_dash(statistics.height_radius_correlation));
    rows.add("η β σ", number(surface.set.density() * statistics.mean_radius * statistics.sigma));
    if let Some(offset) = surface.offset_to_mean_plane() {
        rows.add("mean asperity height above the mean plane, ys", quantity(offset, "m"));
    }
    if let Some(map) = &surface.map {
        rows.map(map);
    }
    rows.0
}

struct Rows(Vec<Row>);

impl Rows {
    fn add(&mut self, property: &str, value: String) {
        self.0.push([property.to_owned(), value]);
    }

    fn map(&mut self, map: &MapFacts) {
        let pair = |values: [f64; 2]| {
            if values[0] == values[1] {
                input_quantity(values[0], "m")
            } else {
                format!("{} × {}", input_quantity(values[0], "m"), input_quantity(values[1], "m"))
            }
        };
        let roughness = &map.roughness;
        let moments = &roughness.moments;
        self.add("map", format!("{} × {} points of {}", map.points[0], map.points[1], pair(map.pixel)));
        self.add("missing points", count(roughness.missing));
        if let Some(spikes) = map.spikes.as_ref().filter(|spikes| spikes.removed > 0) {
            self.add("points removed as spikes", count(spikes.removed));
        }
        if let Some(lines) = map.aligned {
            self.add("lines set to equal mean height, along", lines.name().to_owned());
        }
        self.add("levelled by", map.level.name().to_owned());
        if let Some(filter) = &map.filter {
            self.add("Gaussian filter (ISO 16610-61)", filter.to_string());
        }
        self.add("Sa, Sq", format!("{}, {}", quantity(moments.sa, "m"), quantity(moments.sq, "m")));
        self.add("Ssk, Sku", format!("{}, {}", or_dash(moments.ssk), or_dash(moments.sku)));
        let [m0, m2, m4] = roughness.spectral_moments();
        self.add(
            "spectral moments m0, m2, m4",
            format!("{} m², {}, {} /m²", number(m0), number(m2), number(m4)),
        );
        self.add("m2 along x, y", format!("{}, {}", number(roughness.m2[0]), number(roughness.m2[1])));
        self.add("Nayak's α", or_dash(roughness.alpha()));
        self.add("r.m.s. slope", number(roughness.rms_slope()));
        if let Some(correlation) = &map.whole.autocorrelation {
            let length = correlation.length.map_or_else(|| "-".to_owned(), |length| quantity(length, "m"));
            self.add("autocorrelation length Sal", length);
            self.add("texture aspect ratio Str", or_dash(correlation.aspect));
        }
        let tested = format!("{} of {}", count(map.summits), count(map.tested));
        self.add(&format!("{} summits, of points tested", map.neighbours.name()), tested);
        self.add("summits whose smaller principal curvature is not positive", count(map.saddles));
        if map.plateaus > 0 {
            self.add("plateaus, of which dropped", format!("{}, {}", map.plateaus, map.dropped));
        }
        if let Some(steps) = &map.quantisation {
            self.steps(steps);
        }
    }

    fn steps(&mut self, steps: &Quantisation) {
        let step = steps.step.map_or_else(|| "none found".to_owned(), |step| quantity(step, "m"));
        self.add("height step of the instrument", step);
        self.add(
            "height levels, distinct curvatures",
            format!("{}, {}", count(steps.levels), count(steps.distinct_curvatures)),
        );
        self.add("median drop from a summit to its neighbours", quantity(steps.median_drop, "m"));
    }
}

/// A table as lines of text: the first column left-aligned, the others right-aligned.
pub fn columns(header: &[&str], rows: &[Vec<String>]) -> String {
    let length = |cell: &str| cell.chars().count();
    let width = |k: usize| {
        let cells = rows.iter().filter_map(|row| row.get(k)).map(|cell| length(cell));
        cells.chain([length(header[k])]).max().unwrap_or(0)
    };
    let line = |cells: &[&str]| {
        let cells = cells.iter().enumerate().map(|(k, cell)| {
            let room = " ".repeat(width(k) - length(cell));
            if k == 0 { format!("  {cell}{room}") } else { format!("  {room}{cell}") }
        });
        cells.collect::<String>().trim_end().to_owned() + "\n"
    };
    let rows = rows.iter().map(|row| line(&row.iter().map(String::as_str).collect::<Vec<_>>()));
    line(header) + &rows.collect::<String>()
}

/// Properties as lines of text with aligned values.
pub fn table(rows: Vec<Row>) -> String {
    let width = rows.iter().map(|row| row[0].chars().count()).max().unwrap_or(0);
    rows.iter().map(|[property, value]| format!("  {property:<width$}  {value}\n")).collect()
}
