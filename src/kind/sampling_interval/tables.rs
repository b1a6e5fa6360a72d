//! `sampling_interval.csv`, `sampling_interval_gaps.csv` and `sampling_interval_limits.csv`: pure writers, results to bytes.

use asperity::compare::{Cause, ComparedQuantity, Difference, Estimate, Pair};
use asperity_framework::columns;
use asperity_framework::report::table::{Column, Row, Schema, Table};

use super::results::{Found, IntervalResults, Scale, Series, SurfaceResults};
use super::trend::Trend;
use crate::kind::compare::tables::limits;

/// What a row belongs to.
#[derive(Clone, Copy)]
struct Place<'a> {
    surface: &'a SurfaceResults,
    series: &'a Series,
}

impl<'a> Place<'a> {
    /// The surfaces, varied in each way.
    fn all(results: &'a IntervalResults) -> impl Iterator<Item = Self> {
        let of =
            |surface: &'a SurfaceResults| surface.series.iter().map(move |series| Self { surface, series });
        results.surfaces.iter().flat_map(of)
    }

    fn columns<R>(place: impl for<'b> Fn(&'b R) -> Place<'b> + Copy + 'static) -> Vec<Column<R>> {
        columns! { row: R =>
            surface["text"] = place(row).surface.surface.name.as_str(), "Name of the surface.";
            variation["text"] = place(row).series.variation.name(), "What is varied: `interval` (every so many points of the map) or `s-filter` (Gaussian S filter on the map, ISO 16610-61).";
        }
    }
}

/// A surface at one scale.
struct ScaleRow<'a> {
    place: Place<'a>,
    scale: &'a Scale,
}

impl ScaleRow<'_> {
    fn found<T>(&self, of: impl Fn(&Found) -> T) -> Option<T> {
        self.scale.found.as_ref().ok().map(of)
    }
}

impl Row for ScaleRow<'_> {
    const FILE: &'static str = "sampling_interval.csv";
    const ROWS: &'static str =
        "One row for each surface and each of its sampling intervals and S filters: its asperities.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = Place::columns(|row: &Self| row.place);
        columns.extend(columns! { row: Self =>
            multiple["1"] = row.scale.multiple, "Sampling interval in pixels of the map; nesting index in units of the smallest one asked for.";
            length_m["m"] = row.scale.length, "Sampling interval, the longer one of x and y, or nesting index of the S filter.";
            asperities["count"] = row.found(|found| found.asperities), "Number of asperities; this and the next columns are empty where none is found.";
            density_per_m2["1/m²"] = row.found(|found| found.density), "Asperities per nominal area.";
            mean_radius_m["m"] = row.found(|found| found.statistics.mean_radius), "Arithmetic mean of the radii.";
            radius_of_mean_curvature_m["m"] = row.found(|found| found.statistics.radius_of_mean_curvature), "Reciprocal of the mean curvature.";
            asperity_sigma_m["m"] = row.found(|found| found.statistics.sigma), "Standard deviation of the heights of the asperities.";
            nayak_alpha["1"] = row.found(|found| found.alpha).flatten(), "Nayak's bandwidth parameter m0 m4/m2^2 of the map, by differences over one sampling interval.";
            radius_cv["1"] = row.found(|found| found.statistics.radius_cv), "Standard deviation of the radii over their mean.";
            height_radius_correlation["1"] = row.found(|found| found.statistics.height_radius_correlation).flatten(), "Correlation of heights and radii.";
            plasticity_index["1"] = row.found(|found| found.plasticity_index).flatten(), "Plasticity index (E*/H)(sigma/R)^0.5 of Greenwood and Williamson (1966); empty where nothing yields.";
        });
        columns
    }
}

/// Both models on a surface at one scale and load, in one quantity.
struct GapRow<'a> {
    place: Place<'a>,
    scale: &'a Scale,
    found: &'a Found,
    pair: &'a Pair,
    at: &'a Difference,
    load: usize,
    quantity: ComparedQuantity,
}

impl GapRow<'_> {
    /// `None` beyond the valid range.
    fn estimate(&self) -> Option<Estimate> {
        self.at.estimates[self.quantity as usize].filter(|_| self.at.exceeded().is_none())
    }

    fn end(&self, index: usize) -> Option<f64> {
        Some(self.quantity.reported(self.estimate()?.interval()?[index]))
    }

    fn part(&self, cause: Cause) -> Option<Estimate> {
        self.estimate()?;
        Some(self.found.parts(self.load, self.quantity)?.estimates[cause as usize])
    }

    fn half_width(&self, cause: Cause) -> Option<f64> {
        self.part(cause)?.half_width()
    }

    fn difference_in_m(&self) -> Option<f64> {
        (self.quantity == ComparedQuantity::Separation)
            .then_some(self.estimate()?.contrast * self.found.sigma)
    }
}

impl Row for GapRow<'_> {
    const FILE: &'static str = "sampling_interval_gaps.csv";
    const ROWS: &'static str = "One row for each surface, sampling interval or S filter, load and quantity: both models at equal load, their difference and its parts.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = Place::columns(|row: &Self| row.place);
        columns.extend(columns! { row: Self =>
            multiple["1"] = row.scale.multiple, "Sampling interval or nesting index, as in `sampling_interval.csv`.";
            length_m["m"] = row.scale.length, "The same as a length.";
            pressure_pa["Pa"] = row.at.load, "Nominal pressure.";
            quantity["text"] = row.quantity.name(), "What is compared: `separation` or `area` (real contact area).";
            statistical["1"] = value(row.quantity, &row.pair.statistical), "Statistical model: separation over sigma, or real contact area over nominal area.";
            deterministic["1"] = value(row.quantity, &row.pair.deterministic), "Deterministic model: the same.";
            difference["1"] = row.estimate().map(|estimate| row.quantity.reported(estimate.contrast)), "Statistical minus deterministic: of the separation in sigma, of the area relative to the deterministic one; empty beyond the valid range.";
            low["1"] = row.end(0), "Lower end of the pointwise 95 % interval of the difference; empty where none is claimed.";
            high["1"] = row.end(1), "Upper end of the interval.";
            difference_m["m"] = row.difference_in_m(), "Difference in separation as a length; empty for areas.";
            from_heights["1"] = row.part(Cause::Heights).map(|part| part.contrast), "Part of the difference from the height distribution, mean over the orders of replacement; of the area of the logarithm of the ratio. The parts add up to the difference; empty where too few contacts carry the load.";
            from_radii["1"] = row.part(Cause::Radii).map(|part| part.contrast), "Part from the spread of radii.";
            from_correlation["1"] = row.part(Cause::Correlation).map(|part| part.contrast), "Part from the correlation of heights and radii.";
            from_heights_half_width["1"] = row.half_width(Cause::Heights), "Half-width of the 95 % interval of the part from the height distribution; empty where none is claimed.";
            from_radii_half_width["1"] = row.half_width(Cause::Radii), "The same of the spread of radii.";
            from_correlation_half_width["1"] = row.half_width(Cause::Correlation), "The same of the correlation.";
            effective_contacts["1"] = row.at.sharing.map(|sharing| sharing.effective_contacts), "Effective contacts of the deterministic model.";
            limits["text"] = limits(row.at.exceeded()), "Limits of the valid range that are exceeded, as in `curves.csv`.";
        });
        columns
    }
}

fn value(quantity: ComparedQuantity, response: &asperity::Response) -> f64 {
    match quantity {
        ComparedQuantity::Separation => response.separation_over_sigma,
        ComparedQuantity::Area => response.area_ratio.total(),
        ComparedQuantity::Stiffness => response.stiffness,
    }
}

/// A quantity towards the finest scale.
struct LimitRow<'a> {
    place: Place<'a>,
    trend: &'a Trend,
}

impl Row for LimitRow<'_> {
    const FILE: &'static str = "sampling_interval_limits.csv";
    const ROWS: &'static str = "One row for each surface, variation and quantity, at each load where it depends on one: whether it has a limit as the sampling interval or the nesting index shrinks. Changes are of the logarithm of positive quantities and of the ratio of areas, else of the quantity itself.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = Place::columns(|row: &Self| row.place);
        columns.extend(columns! { row: Self =>
            quantity["text"] = row.trend.quantity.name(), "The quantity: `density`, `mean-radius`, `radius-of-mean-curvature`, `sigma`, `nayak-alpha`, `radius-cv`, `height-radius-correlation`, `plasticity-index` of the asperities; `deterministic-area`, `statistical-area`, `separation-gap`, `area-gap` at a load.";
            pressure_pa["Pa"] = row.trend.load.map(|load| row.place.surface.loads[load]), "Nominal pressure; empty for quantities of the asperities.";
            change["1"] = row.trend.change, "Change from the second finest to the finest interval or nesting index.";
            half_width["1"] = row.trend.half_width, "Half-width of its 95 % interval, from blocks of the map left out at both; empty where none is claimed.";
            previous_change["1"] = row.trend.previous, "Change from the third finest to the second finest, over the same ratio of lengths as the last change.";
            remainder["1"] = row.trend.remainder(), "What is left of the change to the limit if changes shrink on as the last one did; empty where it did not shrink.";
            exponent["1"] = row.trend.exponent.map(|fit| fit.slope), "Exponent of the power law of the length through all values; empty of quantities that may be negative.";
            exponent_standard_error["1"] = row.trend.exponent.map(|fit| fit.standard_error), "Standard error of the fit.";
            tolerance["1"] = row.trend.tolerance, "The largest change that does not matter.";
            outcome["text"] = row.trend.outcome.name(), "What the three finest lengths tell: `limit` (the finest value is within the tolerance of its limit), `approaching` (changes shrink, but more than the tolerance may be left), `no-limit` (the last change exceeds the tolerance and does not shrink) or `cannot-tell`.";
        });
        columns
    }
}

/// The three tables.
pub(super) fn schemas() -> Vec<Schema> {
    vec![Schema::of::<ScaleRow>(), Schema::of::<GapRow>(), Schema::of::<LimitRow>()]
}

/// The files of [`schemas`].
pub(super) fn tables(results: &IntervalResults) -> Vec<Table> {
    let scales = Place::all(results)
        .flat_map(|place| place.series.scales.iter().map(move |scale| ScaleRow { place, scale }));
    let gaps = Place::all(results).flat_map(|place| {
        place.series.found().flat_map(move |(scale, found)| {
            found.pairs.iter().zip(&found.differences).enumerate().flat_map(move |(load, (pair, at))| {
                let row = move |quantity| GapRow { place, scale, found, pair, at, load, quantity };
                [ComparedQuantity::Separation, ComparedQuantity::Area].map(row)
            })
        })
    });
    let limits = Place::all(results)
        .flat_map(|place| place.series.trends.iter().map(move |trend| LimitRow { place, trend }));
    vec![Table::new(scales), Table::new(gaps), Table::new(limits)]
}
