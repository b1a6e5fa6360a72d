//! The tables of surfaces: their asperities, height maps, fitness checks, theory, and how random ones were generated.

use asperity::surface::{GenerationFacts, MapFacts, Remedy, Surface};
use asperity::topography::Moments;
use asperity::topography::fitness::{Finding, Measure};
use asperity::topography::generate::{Process, SigmaOf, SpectrumOf};
use asperity::topography::spectrum::SpectrumShape;
use asperity::topography::theory::Expected;
use asperity::{Population, Statistics};
use asperity_contact_framework::input::heights::written;
use asperity_contact_framework::report::table::{Column, Row, Schema, Table};
use asperity_contact_framework::{columns, rows};
use indexmap::IndexMap;
use serde_json::{Map, Value};

use super::fit::FitStepRow;
use super::fitness;

/// The statistics of asperities: each is a column here, and a field of [`Statistics`].
pub fn statistics_columns<R>(
    statistics: impl for<'r> Fn(&'r R) -> &'r Statistics + Copy + 'static,
) -> Vec<Column<R>> {
    columns! { row: R =>
        mean_height_m["m", label("mean asperity height")] = statistics(row).mean_height, "Mean height of the asperities.";
        sigma_m["m", label("σ of asperity heights")] = statistics(row).sigma, "Standard deviation of the heights of the asperities.";
        skewness["1", scale(1.0)] = statistics(row).skewness, "Skewness of the heights; empty where all are equal.";
        kurtosis["1"] = statistics(row).kurtosis, "Kurtosis of the heights, 3 if Gaussian; empty where all are equal.";
        mean_radius_m["m"] = statistics(row).mean_radius, "Arithmetic mean of the radii.";
        radius_of_mean_curvature_m["m", label("1/(mean curvature)")] = statistics(row).radius_of_mean_curvature, "Reciprocal of the mean curvature.";
        radius_cv["1", label("scatter of radii over mean")] = statistics(row).radius_cv, "Standard deviation of the radii over their mean.";
        height_radius_correlation["1", label("correlation of height and radius"), scale(1.0)] = statistics(row).height_radius_correlation, "Correlation of heights and radii; empty where all heights or all radii are equal.";
    }
}

pub struct SurfaceRow<'a> {
    pub name: &'a str,
    /// From 1.
    pub realisation: usize,
    pub asperities: usize,
    /// Nominal area, m^2.
    pub nominal_area: f64,
    pub statistics: Statistics,
    /// Of the map that they were found on.
    pub moments: Option<Moments>,
    /// The surface itself, of the first realisation.
    pub surface: Option<&'a Surface>,
    /// Greenwood and Williamson's plasticity index under the first law of a comparison.
    pub plasticity_index: Option<f64>,
    /// Inputs of the statistical model of a comparison.
    pub population: Option<&'a Population>,
}

impl<'a> SurfaceRow<'a> {
    /// The first realisation of a surface, without any contact.
    pub fn new(surface: &'a Surface) -> Self {
        Self {
            name: &surface.name,
            realisation: 1,
            asperities: surface.set.count(),
            nominal_area: surface.set.nominal_area(),
            statistics: surface.reported_statistics(),
            moments: surface.map.as_ref().map(|map| map.roughness.moments),
            surface: Some(surface),
            plasticity_index: None,
            population: None,
        }
    }

    fn density(&self) -> f64 {
        self.asperities as f64 / self.nominal_area
    }

    /// The plane that separations are measured from, where that is known.
    fn separations_from(&self) -> Option<&'static str> {
        Some(match self.surface?.separations_of() {
            SigmaOf::Surface => "mean plane of the surface",
            SigmaOf::Summits => "mean asperity height",
        })
    }
}

impl Row for SurfaceRow<'_> {
    const FILE: &'static str = "surfaces.csv";
    const ROWS: &'static str = "One row for each surface and realisation: its asperities.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = columns! { row: Self =>
            surface["text"] = row.name, "Name of the surface.";
            realisation["count"] = row.realisation, "Number of the realisation of the surface, from 1.";
            asperities["count"] = row.asperities, "Number of asperities.";
            nominal_area_m2["m²"] = row.nominal_area, "Nominal area.";
            density_per_m2["1/m²", label("density η")] = row.density(), "Asperities per nominal area.";
        };
        columns.extend(statistics_columns(|row: &Self| &row.statistics));
        columns.extend(columns! { row: Self =>
            density_radius_sigma["1", label("η β σ")] = row.density() * row.statistics.mean_radius * row.statistics.sigma, "Density times mean radius times sigma.";
            offset_to_mean_plane_m["m", label("mean asperity height above the mean plane, ys")] = row.surface.and_then(Surface::offset_to_mean_plane), "Height of the mean asperity above the mean plane of the surface; empty where that is not known, and of all realisations but the first.";
            separations_from["text", label("separations from")] = row.separations_from(), "Where separations are measured from: `mean asperity height` or `mean plane of the surface`; empty of all realisations but the first.";
            plasticity_index["1"] = row.plasticity_index, "Plasticity index (E*/H)(sigma/R)^0.5 of Greenwood and Williamson (1966) under the first law; empty where nothing yields.";
            mean_curvature_per_m["1/m"] = row.surface.and_then(|surface| Some(surface.ellipticity?.mean_curvature)), "Mean curvature of asperities that a law treats as ellipses.";
            mean_smaller_over_larger_curvature["1", label("smaller over larger curvature")] = row.surface.and_then(|surface| Some(surface.ellipticity?.mean_ratio)), "Mean ratio of the smaller to the larger principal curvature.";
            sq_m["m", label("Sq")] = row.moments.map(|moments| moments.sq), "Root mean square height of the map; this and the next columns are empty of a surface without a map.";
            ssk["1", label("Ssk"), scale(1.0)] = row.moments.and_then(|moments| moments.ssk), "Skewness of the heights of the map.";
            sku["1", label("Sku")] = row.moments.and_then(|moments| moments.sku), "Kurtosis of the heights of the map.";
            model_heights["text", label("heights of the statistical model")] = row.population.map(|population| written(&population.heights)), "Height distribution of the statistical model, as in a spec; this and the next columns are empty without one.";
            model_radius_m["m", label("its radius")] = row.population.map(|population| population.radius), "Radius of the statistical model.";
            model_sigma_m["m", label("its σ")] = row.population.map(|population| population.sigma), "Standard deviation of the heights of the statistical model.";
            model_density_per_m2["1/m²", label("its density")] = row.population.map(|population| population.density), "Asperities per nominal area of the statistical model.";
        });
        columns
    }
}

/// The height map of a surface.
pub struct MapRow<'a> {
    name: &'a str,
    map: &'a MapFacts,
}

impl<'a> MapRow<'a> {
    /// `None` of a surface without a map.
    pub fn new(surface: &'a Surface) -> Option<Self> {
        Some(Self { name: &surface.name, map: surface.map.as_ref()? })
    }

    fn moments(&self) -> &Moments {
        &self.map.roughness.moments
    }

    fn spectral_moment(&self, index: usize) -> f64 {
        self.map.roughness.spectral_moments()[index]
    }
}

rows! { MapRow<'_> => "height_maps.csv";
    "One row for each surface with a height map: the map as its summits are found on it, of the first realisation.";
    row =>
    surface["text"] = row.name, "Name of the surface.";
    points_x["count", label("points along x")] = row.map.points[0], "Points along x.";
    points_y["count", label("points along y")] = row.map.points[1], "Points along y.";
    pixel_x_m["m", label("pixel along x"), input] = row.map.pixel[0], "Distance of neighbouring points along x.";
    pixel_y_m["m", label("pixel along y"), input] = row.map.pixel[1], "Distance of neighbouring points along y.";
    missing_points["count"] = row.map.roughness.missing, "Points without a height.";
    removed_spikes["count", label("points removed as spikes")] = row.map.spikes.as_ref().map(|spikes| spikes.removed).filter(|&removed| removed > 0), "Points that were removed as spikes.";
    aligned_lines["text", label("lines set to equal mean height, along")] = row.map.aligned.map(|lines| lines.name()), "The axis along which lines were set to equal mean height.";
    tip_radius_m["m", label("eroded by a tip of radius"), input] = row.map.tip.map(|tip| tip.reach.radius), "Radius of the stylus or tip that the map was eroded by; this and the next columns are empty without one.";
    tip_unreached_share["1", label("points that it did not touch alone"), percent] = row.map.tip.map(|tip| tip.reach.unreached), "Share of the points at which the tip touched the surface elsewhere from the same place: the surface may lie lower there.";
    tip_untraced_share["1", label("points higher than it can trace"), percent] = row.map.tip.map(|tip| tip.reach.untraced), "Share of the points that lie higher than this tip can have traced any surface, by more than the grid and 1 % of Sq.";
    tip_largest_correction_m["m", label("largest height taken off")] = row.map.tip.map(|tip| tip.reach.largest), "The largest height that the erosion took off.";
    level["text", label("levelled by")] = row.map.level.name(), "The form that was removed.";
    filter["text", label("Gaussian filter (ISO 16610-61)")] = row.map.filter.map(|filter| filter.to_string()), "Gaussian filter (ISO 16610-61) with its nesting indices.";
    sa_m["m", label("Sa")] = row.moments().sa, "Arithmetic mean height.";
    sq_m["m", label("Sq")] = row.moments().sq, "Root mean square height.";
    ssk["1", label("Ssk"), scale(1.0)] = row.moments().ssk, "Skewness of the heights.";
    sku["1", label("Sku")] = row.moments().sku, "Kurtosis of the heights.";
    m0_m2["m²", label("m0")] = row.spectral_moment(0), "Spectral moment m0, the variance of the heights.";
    m2["1", label("m2")] = row.spectral_moment(1), "Spectral moment m2, the variance of the slope, by differences between neighbours.";
    m4_per_m2["1/m²", label("m4")] = row.spectral_moment(2), "Spectral moment m4, the variance of the curvature, by differences between neighbours.";
    m2_along_x["1", label("m2 along x")] = row.map.roughness.m2[0], "Spectral moment m2 along x.";
    m2_along_y["1", label("m2 along y")] = row.map.roughness.m2[1], "Spectral moment m2 along y.";
    m4_along_x_per_m2["1/m²", label("m4 along x")] = row.map.roughness.m4[0], "Spectral moment m4 along x.";
    m4_along_y_per_m2["1/m²", label("m4 along y")] = row.map.roughness.m4[1], "Spectral moment m4 along y.";
    nayak_alpha["1", label("Nayak's α")] = row.map.roughness.alpha(), "Nayak's bandwidth parameter m0 m4/m2^2.";
    rms_slope["1", label("r.m.s. slope")] = row.map.roughness.rms_slope(), "Root mean square slope.";
    autocorrelation_length_m["m", label("autocorrelation length Sal")] = row.map.whole.autocorrelation.as_ref().and_then(|correlation| correlation.length), "Shortest lag at which the autocorrelation decreases to 0.2; this and the next are empty where they were not computed.";
    texture_aspect_ratio["1", label("texture aspect ratio Str")] = row.map.whole.autocorrelation.as_ref().and_then(|correlation| correlation.aspect), "Shortest over longest such lag.";
    summit_definition["text"] = row.map.neighbours.name(), "What a summit is: `five-point` or `eight-neighbour`.";
    summits["count"] = row.map.summits, "Number of summits.";
    tested_points["count"] = row.map.tested, "Points tested for a summit.";
    summits_with_a_saddle["count", label("summits whose smaller principal curvature is not positive")] = row.map.saddles, "Summits whose smaller principal curvature is not positive.";
    plateaus["count"] = row.map.plateaus, "Plateaus among the summits, dropped ones included.";
    dropped_plateaus["count"] = row.map.dropped, "Plateaus dropped for a curvature that is not positive.";
    height_step_m["m", label("height step of the instrument")] = row.map.quantisation.and_then(|steps| steps.step), "Height step of the instrument; empty where none is found.";
    height_levels["count"] = row.map.quantisation.map(|steps| steps.levels), "Number of height levels.";
    distinct_curvatures["count"] = row.map.quantisation.map(|steps| steps.distinct_curvatures), "Number of distinct curvatures of the summits.";
    median_summit_drop_m["m", label("median drop from a summit to its neighbours")] = row.map.quantisation.map(|steps| steps.median_drop), "Median drop from a summit to its neighbours.";
}

/// A property of the summits of a map, found and expected.
pub struct TheoryRow<'a> {
    name: &'a str,
    property: &'static str,
    found: f64,
    five_point: Option<f64>,
    nayak: Option<f64>,
}

impl<'a> TheoryRow<'a> {
    /// None without a theory.
    fn all(surface: &'a Surface) -> Vec<Self> {
        let has_theory = |map: &&MapFacts| {
            surface.unscattered.is_none() && (map.expected.is_some() || map.nayak.is_some())
        };
        let Some(map) = surface.map.as_ref().filter(has_theory) else { return Vec::new() };
        let (statistics, sq) = (&surface.statistics, map.roughness.moments.sq);
        let plane = surface.mean_plane.unwrap_or_default();
        let row = |property, found, expected: &dyn Fn(&Expected) -> f64| Self {
            name: &surface.name,
            property,
            found,
            five_point: map.expected.as_ref().map(expected),
            nayak: map.nayak.as_ref().map(expected),
        };
        vec![
            row("density, 1/m²", surface.set.density(), &|expected| expected.density),
            row("mean curvature, 1/m", statistics.radius_of_mean_curvature.recip(), &|expected| {
                expected.curvature
            }),
            row(
                "mean height above the mean plane / Sq",
                (statistics.mean_height - plane) / sq,
                &|expected| expected.height / sq,
            ),
            row("variance of heights / Sq²", (statistics.sigma / sq).powi(2), &|expected| {
                expected.height_variance / (sq * sq)
            }),
        ]
    }
}

rows! { TheoryRow<'_> => "summit_theory.csv";
    "One row for each surface with a height map and property of its summits: found, and expected of a Gaussian surface; in SI units.";
    row =>
    surface["text"] = row.name, "Name of the surface.";
    summits["text"] = row.property, "The property of the summits.";
    found["SI"] = row.found, "Found on the map.";
    five_point["SI", label("five-point theory")] = row.five_point, "Expected by five-point theory; empty of other summits.";
    found_over_five_point["1", label("found / theory")] = row.five_point.map(|expected| row.found / expected), "Found over expected.";
    nayak["SI", label("Nayak")] = row.nayak, "Expected by Nayak (1971).";
    found_over_nayak["1", label("found / Nayak")] = row.nayak.map(|expected| row.found / expected), "Found over expected.";
}

/// A random process that a surface was generated by.
pub struct ProcessRow<'a> {
    name: &'a str,
    process: &'a Process,
    /// Height of its mean plane above that of the coarser process; `None` of the coarser one.
    height: Option<f64>,
    generation: &'a GenerationFacts,
}

impl<'a> ProcessRow<'a> {
    fn all(surface: &'a Surface) -> Vec<Self> {
        let Some(generation) = surface.map.as_ref().and_then(|map| map.generation.as_ref()) else {
            return Vec::new();
        };
        let generator = &generation.generator;
        let row = |process, height| Self { name: &surface.name, process, height, generation };
        let plateau = generator.plateau.as_ref().map(|plateau| row(&plateau.process, Some(plateau.height)));
        std::iter::once(row(&generator.process, None)).chain(plateau).collect()
    }

    /// Name of the spectrum; Hurst exponent, roll-off, cut-off and correlation length.
    fn spectrum(&self) -> (&'static str, [Option<f64>; 4]) {
        match self.process.spectrum.shape() {
            SpectrumShape::SelfAffine { hurst, roll_off, cut_off }
            | SpectrumShape::Between { hurst, roll_offs: [roll_off, _], cut_off, .. } => {
                ("self-affine", [Some(hurst), Some(roll_off), Some(cut_off), None])
            }
            SpectrumShape::Gaussian(length) => ("gaussian", [None, None, None, Some(length)]),
            SpectrumShape::Exponential(length) => ("exponential", [None, None, None, Some(length)]),
        }
    }

    /// A second roll-off and its weight.
    fn second(&self) -> [Option<f64>; 2] {
        match self.process.spectrum.shape() {
            SpectrumShape::Between { roll_offs: [_, second], weight, .. } => [Some(second), Some(weight)],
            _ => [None; 2],
        }
    }

    fn spectrum_of(&self) -> &'static str {
        match self.process.of {
            SpectrumOf::Heights => "heights",
            SpectrumOf::Gaussian => "gaussian",
        }
    }
}

rows! { ProcessRow<'_> => "generation_processes.csv";
    "One row for each random process of a generated surface: one, or a second, finer one that truncates it.";
    row =>
    surface["text"] = row.name, "Name of the surface.";
    spectrum["text"] = row.spectrum().0, "Its spectrum: `self-affine`, `gaussian` or `exponential`.";
    spectrum_of["text"] = row.spectrum_of(), "Whose spectrum is prescribed: that of the `heights`, or of the `gaussian` field before its transform.";
    hurst["1", label("Hurst exponent"), input] = row.spectrum().1[0], "Hurst exponent.";
    roll_off_m["m", label("roll-off")] = row.spectrum().1[1], "Longest wavelength of the self-affine range; of two, the shorter.";
    second_roll_off_m["m"] = row.second()[0], "The longer of two whose amplitudes are added, equal along the power law; empty of one.";
    second_weight["1"] = row.second()[1], "Weight of the amplitudes of the longer one, that of the other being 1 less it; empty of one.";
    cut_off_m["m", label("cut-off")] = row.spectrum().1[2], "Shortest wavelength.";
    correlation_length_m["m"] = row.spectrum().1[3], "Correlation length across the lay.";
    elongation["1"] = row.process.spectrum.lay().elongation, "Lengths along the lay over lengths across it.";
    angle_rad["rad"] = row.process.spectrum.lay().angle, "Angle of the lay to the x axis.";
    sigma_m["m", label("σ")] = row.process.sigma, "Standard deviation of the heights.";
    heights["text"] = row.process.heights.to_string(), "Distribution of the heights.";
    skewness["1", scale(1.0)] = row.process.heights.skewness(), "Skewness of that distribution.";
    kurtosis["1"] = row.process.heights.kurtosis(), "Kurtosis of that distribution.";
    plateau_height_m["m", label("mean plane")] = row.height, "Height of its mean plane above that of the coarser process; empty of that.";
    truncated_share["1", label("truncated points"), percent] = row.generation.cut, "Share of the points that the finer process truncates; empty of a single process.";
    surfaces_tried["count"] = row.generation.target.map(|(_, tried)| tried), "Fields generated to meet a target of the summits, of which the surface is a weighted sum of two; empty without one.";
}

/// A property of a generated surface: target and obtained.
pub struct TargetRow<'a> {
    name: &'a str,
    property: &'static str,
    target: f64,
    obtained: Option<f64>,
    is_relative: bool,
}

impl<'a> TargetRow<'a> {
    /// None of a surface that a finer process truncates, which has no target.
    fn all(surface: &'a Surface) -> Vec<Self> {
        let generated = surface.map.as_ref().and_then(|map| Some((map, map.generation.as_ref()?)));
        let Some((map, made)) = generated.filter(|(_, made)| made.cut.is_none()) else { return Vec::new() };
        let row = |property, target, obtained| Self {
            name: &surface.name,
            property,
            target,
            obtained: Some(obtained),
            is_relative: true,
        };
        let shape =
            |property, target, obtained| Self { obtained, is_relative: false, ..row(property, target, 0.0) };
        let (statistics, moments) = (&surface.statistics, &map.roughness.moments);
        let process = &made.generator.process;
        let sq = row("Sq, m", process.sigma, moments.sq);
        let mut rows = Vec::new();
        if let Some((target, _)) = &made.target {
            rows.push(row("mean radius of the summits, m", target.radius, statistics.mean_radius));
            rows.push(match target.sigma_of {
                SigmaOf::Summits => row("σ of the summit heights, m", target.sigma, statistics.sigma),
                SigmaOf::Surface => row("σ of the surface heights, Sq, m", target.sigma, moments.sq),
            });
            rows.push(row("density of the summits, 1/m²", target.density, surface.set.density()));
            rows.extend((target.sigma_of == SigmaOf::Summits).then_some(sq));
        } else {
            rows.push(sq);
        }
        rows.push(shape("Ssk", process.heights.skewness(), moments.ssk));
        rows.push(shape("Sku", process.heights.kurtosis(), moments.sku));
        if let (Some(target), Some(obtained)) = (&map.whole.target, &map.whole.spectrum) {
            let [low, high] = target.quartiles_of(obtained);
            rows.push(row("lower quartile of the rings of the spectrum", 1.0, low));
            rows.push(row("upper quartile", 1.0, high));
        }
        rows
    }

    fn deviation(&self) -> Option<f64> {
        /// Smaller relative deviations are rounding.
        const ROUNDING: f64 = 1e-12;
        let apart = self.obtained? - self.target;
        let deviation = if self.is_relative { apart / self.target } else { apart };
        Some(if deviation.abs() > ROUNDING { deviation } else { 0.0 })
    }
}

rows! { TargetRow<'_> => "generation.csv";
    "One row for each generated surface and property that is prescribed: target and obtained, in SI units.";
    row =>
    surface["text"] = row.name, "Name of the surface.";
    quantity["text"] = row.property, "The property.";
    target["SI", input, scale(1.0)] = row.target, "Target.";
    obtained["SI", scale(1.0)] = row.obtained, "Obtained.";
    deviation["1", signed, scale(1.0)] = row.deviation(), "Obtained minus target, over the target except for skewness and kurtosis.";
}

/// A fitness check of a map.
pub struct FitnessRow<'a> {
    surface: &'a Surface,
    map: &'a MapFacts,
    finding: &'a Finding,
}

impl<'a> FitnessRow<'a> {
    /// None of a surface that is not checked.
    fn all(surface: &'a Surface) -> impl Iterator<Item = Self> {
        let map = surface.map.iter();
        map.flat_map(move |map| map.fitness.iter().map(move |finding| Self { surface, map, finding }))
    }

    fn result(&self) -> &'static str {
        match (self.finding.has_passed(), self.finding.is_blocking()) {
            (true, _) => "passed",
            (false, true) => "failed",
            (false, false) => "caution",
        }
    }

    fn remedy(&self) -> Option<String> {
        let fit = self.surface.fit.as_deref();
        if self.finding.measure == Measure::AspectRatio && self.surface.set.ellipses().is_some() {
            return None;
        }
        (!self.finding.has_passed()).then(|| fitness::remedy_left(self.finding, self.map, fit))
    }

    fn setting(&self) -> Option<String> {
        let remedy = Remedy::new(self.finding, self.map).filter(|_| !self.finding.has_passed())?;
        let key = format!("`{}`", fitness::written(remedy));
        let words = self.remedy()?;
        // One that `fit` refused is no remedy.
        (words.contains(&key) && !words.contains("`fit` refused")).then_some(key)
    }
}

rows! { FitnessRow<'_> => "fitness.csv", records "fitness";
    "One row for each measured surface and check of its map.";
    row =>
    surface["text"] = row.surface.name.as_str(), "Name of the surface.";
    check["text"] = row.finding.check.name(), "The check.";
    measure["text"] = row.finding.measure.name(), "What is measured.";
    measured["text"] = fitness::measured(row.finding.measure), "The same in words.";
    value["1"] = row.finding.value, "Its value.";
    threshold["1"] = row.finding.threshold(), "The threshold that the value is compared with.";
    allowed["text"] = fitness::allowed(row.finding), "The values that pass.";
    passed["true/false"] = row.finding.has_passed(), "Whether the map passes.";
    blocks["true/false"] = row.finding.is_blocking(), "Whether it fails so that no verdict may rest on the map.";
    result["text"] = row.result(), "The result: `passed`, `caution` (verdicts stand) or `failed` (no verdict may rest on the map).";
    remedy["text"] = row.remedy(), "What to do about it, in the keys of a spec.";
    setting["text", label("remedy")] = row.setting(), "The key of a spec that remedies it, where there is one.";
}

pub fn schemas() -> Vec<Schema> {
    vec![
        Schema::of::<SurfaceRow>(),
        Schema::of::<MapRow>(),
        Schema::of::<FitnessRow>(),
        Schema::of::<FitStepRow>(),
        Schema::of::<TheoryRow>(),
        Schema::of::<ProcessRow>(),
        Schema::of::<TargetRow>(),
    ]
}

/// The tables of surfaces and their realisations that have rows.
pub fn tables<'a>(rows: impl IntoIterator<Item = SurfaceRow<'a>>) -> Vec<Table> {
    let rows: Vec<SurfaceRow> = rows.into_iter().collect();
    let surfaces: Vec<&Surface> = rows.iter().filter_map(|row| row.surface).collect();
    let surfaces = || surfaces.iter().copied();
    let described = [
        Table::new(surfaces().filter_map(MapRow::new)),
        Table::new(surfaces().flat_map(FitnessRow::all)),
        Table::new(surfaces().flat_map(FitStepRow::all)),
        Table::new(surfaces().flat_map(TheoryRow::all)),
        Table::new(surfaces().flat_map(ProcessRow::all)),
        Table::new(surfaces().flat_map(TargetRow::all)),
    ];
    std::iter::once(Table::new(rows)).chain(described).filter(|table| table.rows() > 0).collect()
}

/// The checks of the map of a surface.
#[cfg(feature = "serve")]
pub fn fitness(surface: &Surface) -> impl Iterator<Item = FitnessRow<'_>> {
    FitnessRow::all(surface)
}

/// Surfaces by name, as `summary.json` has them: the rows of `surfaces.csv` and `height_maps.csv`, and warnings.
pub fn records<'a>(rows: impl IntoIterator<Item = SurfaceRow<'a>>) -> Value {
    let rows: Vec<SurfaceRow> = rows.into_iter().collect();
    let keys: Vec<_> = rows.iter().map(|row| (row.name.to_owned(), row.surface)).collect();
    let mut surfaces: IndexMap<String, Vec<(Value, Option<&Surface>)>> = IndexMap::new();
    let mut records = Table::new(rows).records();
    for (k, (name, surface)) in keys.into_iter().enumerate() {
        surfaces.entry(name).or_default().push((records[k].take(), surface));
    }
    let record = |realisations: Vec<(Value, Option<&Surface>)>| {
        let (mut first, surface) = realisations[0].clone();
        if let Some(surface) = surface {
            first["height_map"] = map_record(surface);
            first["warnings"] = surface.warnings.as_slice().into();
        }
        if realisations.len() > 1 {
            first["realisations"] = realisations.into_iter().map(|(record, _)| record).collect();
        }
        first
    };
    surfaces
        .into_iter()
        .map(|(name, realisations)| (name, record(realisations)))
        .collect::<Map<_, _>>()
        .into()
}

/// The height map of a surface as in `summary.json`; null without one.
pub fn map_record(surface: &Surface) -> Value {
    MapRow::new(surface).map_or(Value::Null, |row| Table::new([row]).records()[0].take())
}

/// The checks of a map as in `summary.json`.
pub fn fitness_records(surface: &Surface) -> Value {
    Table::new(FitnessRow::all(surface)).records()
}
