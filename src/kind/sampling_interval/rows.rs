//! `sampling_interval.csv`, `sampling_interval_gaps.csv`, `sampling_interval_limits.csv` and `sampling_interval_leads.csv`.

use asperity::Response;
use asperity::compare::{Cause, ComparedQuantity, Contributions, Difference, Estimate, Pair};
use asperity_contact_framework::report::table::{Column, Schema, Table};
use asperity_contact_framework::{columns, rows};

use super::results::{Gap, IntervalResults, QUANTITIES, Scale, ScaleResults, Series, gaps, sign};
use super::run::Trend;
use crate::model_tables::limits;
use crate::surface::rows::{self as surface, SurfaceRow};

/// The columns of what a row belongs to.
fn series_columns<R>(series: impl Fn(&R) -> &Series + Copy + 'static) -> Vec<Column<R>> {
    columns! { row: R =>
        surface["text"] = series(row).surface.as_str(), "Name of the surface.";
        variation["text"] = series(row).variation.name(), "What is varied: `interval` (every n-th point of the map) or `s-filter` (Gaussian S filter on the map, ISO 16610-61).";
    }
}

pub struct ScaleRow<'a> {
    series: &'a Series,
    scale: &'a Scale,
}

impl ScaleRow<'_> {
    fn value<T>(&self, value: impl Fn(&ScaleResults) -> T) -> Option<T> {
        self.scale.results.as_ref().ok().map(value)
    }
}

rows! { ScaleRow<'_> => "sampling_interval.csv";
    "One row for each surface and each of its sampling intervals and S filters: its asperities.";
    ..series_columns(|row: &Self| row.series);
    row =>
    multiple["1"] = row.scale.multiple, "Sampling interval in pixels of the map; nesting index in units of the smallest one asked for.";
    length_m["m"] = row.scale.length, "Sampling interval, the longer one of x and y, or nesting index of the S filter.";
    asperities["count"] = row.value(|results| results.count), "Number of asperities; this and the next columns are empty where none is found.";
    density_per_m2["1/m²"] = row.value(|results| results.asperities.density), "Asperities per nominal area.";
    mean_radius_m["m"] = row.value(|results| results.asperities.statistics.mean_radius), "Arithmetic mean of the radii.";
    radius_of_mean_curvature_m["m", label("1/(mean curvature)")] = row.value(|results| results.asperities.statistics.radius_of_mean_curvature), "Reciprocal of the mean curvature.";
    asperity_sigma_m["m", label("σ of asperities")] = row.value(|results| results.asperities.statistics.sigma), "Standard deviation of the heights of the asperities.";
    nayak_alpha["1", label("Nayak's α")] = row.value(|results| results.asperities.alpha).flatten(), "Nayak's bandwidth parameter m0 m4/m2^2 of the map, by differences over one sampling interval.";
    radius_cv["1"] = row.value(|results| results.asperities.statistics.radius_cv), "Standard deviation of the radii over their mean.";
    height_radius_correlation["1"] = row.value(|results| results.asperities.statistics.height_radius_correlation).flatten(), "Correlation of heights and radii.";
    plasticity_index["1"] = row.value(|results| results.asperities.plasticity_index).flatten(), "Plasticity index (E*/H)(sigma/R)^0.5 of Greenwood and Williamson (1966); empty where nothing yields.";
    failure["text"] = row.scale.results.as_ref().err().cloned(), "Why the models did not run; empty where they did.";
}

/// Both models on a surface at one scale and load, in one quantity.
pub struct GapRow<'a> {
    series: &'a Series,
    scale: &'a Scale,
    results: &'a ScaleResults,
    load: usize,
    quantity: ComparedQuantity,
}

impl GapRow<'_> {
    fn at_load(&self) -> &Difference {
        &self.results.case.differences[self.load]
    }

    fn pair(&self) -> &Pair {
        &self.results.case.comparison.pairs[self.load]
    }

    fn difference(&self) -> Option<Estimate> {
        self.results.difference(self.load, self.quantity)
    }

    fn end(&self, index: usize) -> Option<f64> {
        Some(self.quantity.reported(self.difference()?.interval()?[index]))
    }

    fn parts(&self) -> Option<&Contributions> {
        self.results.parts(self.load, self.quantity)
    }

    fn end_of(&self, cause: Cause, index: usize) -> Option<f64> {
        Some(self.parts()?.of_cause(cause).interval()?[index])
    }

    fn value(&self, response: &Response) -> f64 {
        if self.quantity == ComparedQuantity::Separation {
            response.separation_over_sigma
        } else {
            response.area_ratio.total()
        }
    }
}

rows! { GapRow<'_> => "sampling_interval_gaps.csv";
    "One row for each surface, sampling interval or S filter, load and quantity: both models at equal load, their difference and its parts.";
    ..series_columns(|row: &Self| row.series);
    row =>
    multiple["1"] = row.scale.multiple, "Sampling interval or nesting index, as in `sampling_interval.csv`.";
    length_m["m"] = row.scale.length, "The same as a length.";
    pressure_pa["Pa", input] = row.at_load().load, "Nominal pressure.";
    quantity["text"] = row.quantity.name(), "What is compared: `separation` or `area` (real contact area).";
    statistical["1"] = row.value(&row.pair().statistical), "Statistical model: separation over sigma, or real contact area over nominal area.";
    deterministic["1"] = row.value(&row.pair().deterministic), "Deterministic model: the same.";
    difference["1", signed] = row.difference().map(|difference| row.quantity.reported(difference.contrast)), "Statistical minus deterministic: of the separation in sigma, of the area relative to the deterministic one; empty where the load is not admissible.";
    low["1", signed] = row.end(0), "Lower end of the pointwise 95 % interval of the difference; empty where none is claimed.";
    high["1", signed] = row.end(1), "Upper end of the interval.";
    difference_m["m", signed] = row.difference().filter(|_| row.quantity == ComparedQuantity::Separation).map(|difference| difference.contrast * row.results.sigma), "Difference in separation as a length; empty for areas.";
    from_heights["1", signed] = row.parts().map(|parts| parts.part(Cause::Heights)), "Part of the difference from the height distribution, mean over the orders of replacement; of the area of the logarithm of the ratio. The parts add up to the difference; empty where too few contacts carry the load.";
    from_radii["1", signed] = row.parts().map(|parts| parts.part(Cause::Radii)), "Part from the spread of radii.";
    from_correlation["1", signed] = row.parts().map(|parts| parts.part(Cause::Correlation)), "Part from the correlation of heights and radii.";
    from_heights_low["1", signed] = row.end_of(Cause::Heights, 0), "Lower end of the 95 % interval of the part from the height distribution, which holds the intervals of all orders; empty where none is claimed.";
    from_heights_high["1", signed] = row.end_of(Cause::Heights, 1), "Upper end of that interval.";
    from_radii_low["1", signed] = row.end_of(Cause::Radii, 0), "The same of the spread of radii.";
    from_radii_high["1", signed] = row.end_of(Cause::Radii, 1), "Upper end of that interval.";
    from_correlation_low["1", signed] = row.end_of(Cause::Correlation, 0), "The same of the correlation.";
    from_correlation_high["1", signed] = row.end_of(Cause::Correlation, 1), "Upper end of that interval.";
    effective_contacts["1"] = row.at_load().sharing.map(|sharing| sharing.effective_contacts), "Effective contacts of the deterministic model.";
    limits["text"] = limits(row.at_load().exceeded()), "Limits of admissible loads that are exceeded, as in `curves.csv`.";
}

/// A quantity towards the finest scale.
pub struct LimitRow<'a> {
    series: &'a Series,
    trend: &'a Trend,
}

rows! { LimitRow<'_> => "sampling_interval_limits.csv";
    "One row for each surface, variation and quantity, at each load where it depends on one: whether it has a limit as the sampling interval or the nesting index shrinks. Changes are of the logarithm of positive quantities and of the ratio of areas, else of the quantity itself.";
    ..series_columns(|row: &Self| row.series);
    row =>
    quantity["text"] = row.trend.quantity.name(), "The quantity: `density`, `mean-radius`, `radius-of-mean-curvature`, `sigma`, `nayak-alpha`, `radius-cv`, `height-radius-correlation`, `plasticity-index` of the asperities; `deterministic-area`, `statistical-area`, `separation-gap`, `area-gap` at a load.";
    pressure_pa["Pa", input] = row.trend.load, "Nominal pressure; empty for quantities of the asperities.";
    change["1", label("last change"), signed] = row.trend.change, "Change from the second finest to the finest interval or nesting index.";
    half_width["1", label("±")] = row.trend.half_width, "Half-width of its 95 % interval, from blocks of the map left out at both; empty where none is claimed.";
    previous_change["1", label("change before"), signed] = row.trend.previous, "Change from the third finest to the second finest, over the same ratio of lengths as the last change.";
    remainder["1", label("left to the limit"), signed] = row.trend.remainder(), "What is left of the change to the limit if changes shrink on as the last one did; empty where it did not shrink.";
    relative_change["1", label("last change, relative"), signed_percent] = row.trend.quantity.relative(row.trend.change), "The last change relative to the value at the second finest interval or nesting index; empty of the correlation and the gap in separation.";
    exponent["1", label("exponent"), signed] = row.trend.exponent.map(|fit| fit.slope), "Exponent of the power law of the length through all values; empty of quantities that may be negative.";
    exponent_standard_error["1", label("± s.e.")] = row.trend.exponent.map(|fit| fit.standard_error), "Standard error of the fit.";
    tolerance["1"] = row.trend.tolerance, "The largest change that does not matter.";
    outcome["text", verdict] = row.trend.outcome.name(), "What the three finest lengths tell: `limit` (the finest value is within the tolerance of its limit), `approaching` (changes shrink, but more than the tolerance may be left), `no-limit` (the last change exceeds the tolerance and does not shrink) or `cannot-tell`.";
}

/// The gap between the models in one quantity and at one load over the scales.
pub struct LeadRow<'a> {
    series: &'a Series,
    pressure: f64,
    quantity: ComparedQuantity,
    gaps: Vec<Gap<'a>>,
}

impl LeadRow<'_> {
    fn differences(&self) -> impl Iterator<Item = f64> {
        self.gaps.iter().map(|gap| self.quantity.reported(gap.difference.contrast))
    }

    fn leading_causes(&self) -> Vec<String> {
        let leading = |gap: &Gap| gap.parts.and_then(Contributions::leading).map_or("none", Cause::name);
        self.gaps.iter().map(|gap| leading(gap).to_owned()).collect()
    }
}

rows! { LeadRow<'_> => "sampling_interval_leads.csv";
    "One row for each surface, variation, load and quantity: whether the difference between the models keeps its sign over the lengths, and which causes lead.";
    ..series_columns(|row: &Self| row.series);
    row =>
    pressure_pa["Pa", input] = row.pressure, "Nominal pressure.";
    quantity["text", label("gap in")] = row.quantity.name(), "What is compared: `separation` or `area` (real contact area).";
    lengths["count"] = row.gaps.len(), "Sampling intervals or nesting indices at which the load is admissible.";
    smallest_difference["1", label("from"), signed, scale(1.0)] = row.differences().fold(f64::INFINITY, f64::min), "Smallest difference over the lengths, as in `sampling_interval_gaps.csv`.";
    largest_difference["1", label("to"), signed, scale(1.0)] = row.differences().fold(f64::NEG_INFINITY, f64::max), "Largest such difference.";
    sign["text", verdict] = sign(&row.gaps), "Whether the difference is of the same sign at all lengths: `kept`, `changes` (two intervals lie on either side of zero) or `cannot-tell` (an interval holds zero); empty of a single length.";
    leading_causes["text"] = row.leading_causes(), "The leading cause at each of the lengths, from the finest: `heights`, `radii`, `correlation`, or `none`.";
}

/// Those of the variation, and those of the surfaces.
pub fn schemas() -> Vec<Schema> {
    let mut schemas = vec![
        Schema::of::<ScaleRow>(),
        Schema::of::<GapRow>(),
        Schema::of::<LimitRow>(),
        Schema::of::<LeadRow>(),
    ];
    schemas.extend(surface::schemas());
    schemas
}

pub fn tables(results: &IntervalResults) -> Vec<Table> {
    let (mut scale_rows, mut gap_rows, mut limit_rows, mut lead_rows) = (vec![], vec![], vec![], vec![]);
    for series in results.surfaces.iter().flat_map(|surface| &surface.series) {
        scale_rows.extend(series.scales.iter().map(|scale| ScaleRow { series, scale }));
        limit_rows.extend(series.trends.iter().map(|trend| LimitRow { series, trend }));
        for (scale, results) in series.results() {
            for load in 0..results.case.differences.len() {
                gap_rows.extend(QUANTITIES.map(|quantity| GapRow { series, scale, results, load, quantity }));
            }
        }
        for (load, &pressure) in results.loads.iter().enumerate() {
            let row = |quantity| LeadRow { series, pressure, quantity, gaps: gaps(series, load, quantity) };
            lead_rows.extend(QUANTITIES.map(row).into_iter().filter(|row| !row.gaps.is_empty()));
        }
    }
    let mut tables =
        vec![Table::new(scale_rows), Table::new(gap_rows), Table::new(limit_rows), Table::new(lead_rows)];
    tables.extend(surface::tables(results.surfaces.iter().map(|results| SurfaceRow::new(&results.surface))));
    tables
}
