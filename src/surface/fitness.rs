//! Fitness checks of a map in words: what was measured, what is allowed, and the remedy in the keys of a spec.

use asperity::compare::Repeats;
use asperity::numeric::two_digits_up;
use asperity::surface::{Fit, MOST_SPIKE_POINTS, MapFacts, NoAsperities, NotApplied, Remedy, Surface};
use asperity::topography::fitness::{Check, Finding, LARGEST_FLANKS, Measure};
use asperity::topography::generate::FEWEST_LENGTHS;
use asperity::topography::{Filter, HeightPlace};
use asperity_contact_framework::report::format::{count, input_quantity, number, percent, quantity};

use super::fit::reason;
use super::memory;

pub fn warnings(map: &MapFacts) -> Vec<String> {
    /// Largest plausible point spacing, m.
    const WIDE: f64 = 1e-3;
    /// R.m.s. slopes below those of polished optics; still smaller ones fail the check of slopes.
    const FLAT: std::ops::Range<f64> = 1e-5..1e-4;
    /// Share of missing points from which it matters which ones are missing.
    const MANY: f64 = 0.1;
    let mut warnings = Vec::new();
    let widest = map.pixel[0].max(map.pixel[1]);
    let slope = map.roughness.rms_slope();
    // The check says more.
    let has_failed = map.blocking().any(|finding| finding.check == Check::Slope);
    if widest >= WIDE && !has_failed {
        warnings.push(format!(
            "its points are {} apart: `pixel` or `unit` is probably wrong (a number without a unit is in metres).",
            quantity(widest, "m"),
        ));
    } else if FLAT.contains(&slope) && map.generation.is_none() {
        warnings.push(format!(
            "the r.m.s. slope is {}, less than that of polished optics: heights and pixel size are probably in different units.",
            number(slope),
        ));
    }
    let missing = map.roughness.missing as f64 / (map.points[0] * map.points[1]) as f64;
    if missing > MANY {
        warnings.push(format!(
            "{} of its points are missing: where an instrument loses valleys or steep flanks rather than points at random, σ \
             and the separation are too small.",
            percent(missing),
        ));
    }
    warnings
}

/// Why neither model applies to a map, without what is allowed in its place.
pub fn without_advice(reason: &NoAsperities) -> String {
    reason.to_string().split([':', ';']).next().unwrap_or_default().to_owned()
}

/// What keeps a map from carrying a verdict, and the remedy: a sentence for each such check.
pub fn failures(surface: &Surface) -> Vec<String> {
    let Some(map) = &surface.map else { return Vec::new() };
    let sentence = |finding: &Finding| {
        let remedy = remedy_of(finding, map, surface);
        format!("{}: {}. Remedy: {remedy}.", finding.check.name(), fault(finding, map))
    };
    map.blocking_in_order().into_iter().map(sentence).collect()
}

/// The remedy of a fault of the map of a surface; of a pair, which has no keys of a preparation, where it is.
fn remedy_of(finding: &Finding, map: &MapFacts, surface: &Surface) -> String {
    match surface.repeats {
        Repeats::Realisations => remedy_left(finding, map, surface.fit.as_deref()),
        Repeats::Shifts => "larger maps of both bodies, or the keys of their preparation".to_owned(),
    }
}

/// The first fault of a map that may not carry a verdict, as a card says it, with the remedy and without: "No conclusion until the map is fit: 6 spikes;
/// `outliers = \"remove\"`." Where `--fit` may find the preparation, it is named.
pub fn in_short(surface: &Surface) -> Vec<String> {
    let unfit = "No conclusion until the map is fit";
    let Some((map, first)) =
        surface.map.as_ref().and_then(|map| Some((map, *map.blocking_in_order().first()?)))
    else {
        return vec![format!("{unfit}.")];
    };
    let fault = short_fault(first);
    let remedy = remedy_of(first, map, surface);
    let is_remedied = surface.fit.is_none()
        && surface.repeats == Repeats::Realisations
        && Remedy::new(first, map).is_some()
        && !has_too_many_spikes(first, map);
    let others = match map.blocking_in_order().len() {
        1 => String::new(),
        count => format!(" (the first of {count} faults)"),
    };
    let with = |others: &str, remedy: &str| format!("{unfit}: {fault}{others}{remedy}.");
    let fit = if is_remedied { "; try `fit = \"auto\"`" } else { "" };
    vec![
        with(&others, &format!("; {remedy}{fit}")),
        with(&others, &format!("; {remedy}")),
        with(&others, fit),
        with("", fit),
    ]
}

/// A fault in a few words.
fn short_fault(finding: &Finding) -> String {
    let found = value(finding.measure, finding.value);
    match finding.measure {
        Measure::SharedHeight => format!("{found} of the points have one height"),
        Measure::Spikes if finding.value == 1.0 => "1 spike".to_owned(),
        Measure::Spikes => format!("{found} spikes"),
        Measure::FormShare => "form is left".to_owned(),
        Measure::SlopeCorrelation => "its lay lies at an angle to the grid".to_owned(),
        Measure::AspectRatio => "its lay is strong".to_owned(),
        Measure::LineOffsets => "lines are offset".to_owned(),
        Measure::StepOverDrop => "height steps make the summits".to_owned(),
        Measure::CurvatureGrowth | Measure::DensityOverTheory | Measure::CurvatureOverTheory => {
            "the pixel makes the summits".to_owned()
        }
        Measure::NoiseGrowth | Measure::GrowthRise => "noise makes the summits".to_owned(),
        Measure::RadiusOverTip | Measure::Untraced => "the tip makes the summits".to_owned(),
        Measure::LengthOverSide => "it is too small for its long waves".to_owned(),
        Measure::Slope if finding.is_of_units() => "heights and pixel are in different units".to_owned(),
        Measure::Slope => "its slopes are too steep".to_owned(),
        Measure::LeastSlope => "its slopes are implausibly small".to_owned(),
        Measure::NominalArea => "its area is implausible".to_owned(),
    }
}

/// What to do about a failed check, where `fit` may have refused the remedy.
pub fn remedy_left(finding: &Finding, map: &MapFacts, fit: Option<&Fit>) -> String {
    let mut steps = fit.into_iter().flat_map(|fit| &fit.steps);
    let refused = steps.find_map(|step| {
        let is_refused = step.before.check == finding.check && step.not_applied.is_some();
        is_refused.then(|| Some((step, step.remedy?, reason(step)?))).flatten()
    });
    let Some((step, refused, why)) = refused else { return remedy(finding, map) };
    if step.not_applied == Some(NotApplied::Kept) {
        return format!("{}, which `fit` did not apply because {why}", remedy(finding, map));
    }
    let instead = match finding.measure {
        Measure::LengthOverSide => larger_map(finding, map),
        Measure::StepOverDrop => "a measurement with finer height steps".to_owned(),
        Measure::NoiseGrowth | Measure::GrowthRise => "a measurement with less noise".to_owned(),
        _ => "a part of the map without it (`crop`), or another measurement".to_owned(),
    };
    format!("{instead}: `fit` refused `{}`, because {why}", written(refused))
}

/// A map of the same surface that would hold enough patches, its sides rounded up to two digits.
fn larger_map(finding: &Finding, map: &MapFacts) -> String {
    let [x, y] = [0, 1].map(|axis| {
        let side = map.points[axis] as f64 * map.pixel[axis] * finding.value / finding.threshold();
        input_quantity(two_digits_up(side), "m")
    });
    format!("a larger map, at least {x} along x and {y} along y ({FEWEST_LENGTHS} correlation lengths)")
}

/// Whether an L filter that leaves as many waves as a map needs is long enough for its pixel and its S filter.
fn leaves_waves(finding: &Finding, map: &MapFacts) -> bool {
    let Some(Remedy::LongWaves(l)) = Remedy::new(finding, map) else { return false };
    let made = Filter::new(map.filter.and_then(|filter| filter.s()), Some(l));
    made.is_ok_and(|filter| memory::check_long(filter, map.points, map.pixel).is_ok())
}

/// Whether so many points stand out that they are no single wrong ones.
fn has_too_many_spikes(finding: &Finding, map: &MapFacts) -> bool {
    let points = (map.points[0] * map.points[1]) as f64;
    let share = map.spikes.as_ref().map_or(0.0, |spikes| spikes.left.points.len() as f64 / points);
    finding.measure == Measure::Spikes && share > MOST_SPIKE_POINTS
}

pub fn written(remedy: Remedy) -> String {
    let filter = |key: &str, index: f64| format!("filter = {{ {key} = \"{}\" }}", input_quantity(index, "m"));
    match remedy {
        Remedy::RemoveSpikes => "outliers = \"remove\"".to_owned(),
        Remedy::AlignLines(lines) => format!("align-lines = \"{}\"", lines.name()),
        Remedy::Level(level) => format!("level = \"{}\"", level.name()),
        Remedy::ShortWaves(s) => filter("s", s),
        Remedy::LongWaves(l) => filter("l", l),
    }
}

pub fn measured(measure: Measure) -> &'static str {
    match measure {
        Measure::SharedHeight => "share of points of one height",
        Measure::Spikes => "number of spikes",
        Measure::FormShare => "variance share of the next higher polynomial",
        Measure::SlopeCorrelation => "correlation of slopes along x and y",
        Measure::AspectRatio => "texture aspect ratio Str",
        Measure::LineOffsets => "line offsets in second differences across lines",
        Measure::StepOverDrop => "height step over median drop from summits",
        Measure::CurvatureGrowth | Measure::NoiseGrowth => "growth of the curvature at the pixel, log₂",
        Measure::DensityOverTheory => "density of summits over five-point theory",
        Measure::CurvatureOverTheory => "curvature of summits over five-point theory",
        Measure::GrowthRise => "rise of that growth towards the pixel",
        Measure::RadiusOverTip => "mean summit radius over tip radius",
        Measure::Untraced => "share of points that the tip cannot trace",
        Measure::LengthOverSide => "correlation length over side of the map",
        Measure::Slope | Measure::LeastSlope => "r.m.s. slope",
        Measure::NominalArea => "nominal area, m²",
    }
}

fn value(measure: Measure, value: f64) -> String {
    match measure {
        Measure::Spikes => count(value as usize),
        Measure::SharedHeight | Measure::FormShare | Measure::LineOffsets | Measure::Untraced => {
            percent(value)
        }
        _ => number(value),
    }
}

/// The values that pass, shares as fractions of one like [`Finding::value`].
pub fn allowed(finding: &Finding) -> String {
    let threshold = number(finding.threshold());
    match (finding.is_least(), finding.measure) {
        (_, Measure::Spikes) => "none".to_owned(),
        (_, Measure::DensityOverTheory | Measure::CurvatureOverTheory) => {
            let factor = finding.threshold().max(finding.threshold().recip());
            format!("{} to {}", number(factor.recip()), number(factor))
        }
        (true, _) => format!("at least {threshold}"),
        (false, _) => format!("at most {threshold}"),
    }
}

/// What a failed check found, in a few words.
fn fault(finding: &Finding, map: &MapFacts) -> String {
    let found = value(finding.measure, finding.value);
    match finding.measure {
        Measure::SharedHeight => shared_height(&found, map),
        Measure::Spikes => {
            let largest = map.spikes.as_ref().map_or(0.0, |spikes| spikes.left.largest);
            let spikes = if finding.value == 1.0 { "spike" } else { "spikes" };
            format!("{found} {spikes} of up to {}", quantity(largest, "m"))
        }
        Measure::FormShare => format!("{found} of the variance of heights is form that levelling left"),
        Measure::SlopeCorrelation => format!(
            "the lay lies at an angle to the grid (slopes along x and y correlate by {found}), so that five-point summits are found \
             in rows along the ridges where the surface has none"
        ),
        Measure::AspectRatio => {
            format!("strong lay (Str = {found}): asperities are ridges rather than spheres")
        }
        Measure::LineOffsets => {
            format!("{found} of the variance of second differences are offsets between lines")
        }
        Measure::StepOverDrop => {
            let Some(steps) = &map.quantisation else { return "height steps make the summits".to_owned() };
            let step = steps.step.map_or_else(String::new, |step| format!(" of {}", quantity(step, "m")));
            format!(
                "height steps{step} make the summits: the median drop to their neighbours is {}, and {} summits have {} distinct \
                 curvatures",
                quantity(steps.median_drop, "m"),
                count(map.summits),
                count(steps.distinct_curvatures)
            )
        }
        Measure::CurvatureGrowth => {
            format!(
                "the pixel cuts the roughness off: curvatures still grow as wavelength to the power −{found}"
            )
        }
        Measure::NoiseGrowth | Measure::GrowthRise => {
            "curvatures rise towards the pixel faster than on a rough surface: noise makes the summits"
                .to_owned()
        }
        Measure::DensityOverTheory => {
            format!(
                "the density of summits is {found} times that of a Gaussian surface with the same differences between neighbours"
            )
        }
        Measure::CurvatureOverTheory => {
            format!(
                "the curvature of summits is {found} times that of a Gaussian surface with the same differences between neighbours"
            )
        }
        Measure::RadiusOverTip => format!(
            "the summits are nearly as sharp as the tip (mean radius {found} times that of the tip), so that their radii depend on it"
        ),
        Measure::Untraced => format!("{found} of the points lie higher than a tip of this radius can trace"),
        Measure::LengthOverSide => {
            format!(
                "the map holds few independent patches: the heights stay correlated over {found} of its side (geometric mean over x \
                 and y)"
            )
        }
        Measure::Slope if finding.is_of_units() || !finding.is_blocking() => {
            format!("the r.m.s. slope is {found}")
        }
        Measure::Slope => format!("slopes of {found} (r.m.s.): steep flanks"),
        Measure::LeastSlope => format!("the r.m.s. slope is {found}, less than that of any polished surface"),
        Measure::NominalArea => format!(
            "the map is {} wide along x and {} along y",
            quantity(map.points[0] as f64 * map.pixel[0], "m"),
            quantity(map.points[1] as f64 * map.pixel[1], "m")
        ),
    }
}

/// What heights are equal, and probably why.
fn shared_height(share: &str, map: &MapFacts) -> String {
    let Some(shared) = map.quantisation.and_then(|steps| steps.shared) else {
        return format!("{share} of the points have one height exactly");
    };
    let points = count(shared.points);
    let height = quantity(shared.height + map.offset, "m");
    let (which, why) = match shared.place {
        HeightPlace::Highest => {
            (", the largest", "the instrument was saturated there, or the tops were cut off")
        }
        HeightPlace::Lowest => (
            ", the smallest",
            "the instrument was saturated there, or missing points were written as this number",
        ),
        HeightPlace::Between => ("", "missing points were written as this number"),
    };
    format!("{points} points ({share}) have exactly the height {height}{which}: {why}")
}

/// The keys that say in which units a map is; `both` where its file holds neither, or both.
fn unit_keys(map: &MapFacts, both: &'static str) -> &'static str {
    match map.is_held {
        [true, false] => "`unit` (of coordinates and heights, as in `unit = { xy = \"mm\", z = \"um\" }`)",
        [false, false] | [_, true] => both,
    }
}

/// What to do about a failed check, in the keys of a spec where there is one.
pub fn remedy(finding: &Finding, map: &MapFacts) -> String {
    let key = Remedy::new(finding, map).map(|remedy| format!("`{}`", written(remedy)));
    let key = || key.clone().unwrap_or_default();
    match finding.measure {
        Measure::SharedHeight => shared_height_remedy(map),
        Measure::Spikes if map.spikes.as_ref().is_some_and(|spikes| spikes.removed > 0) => {
            "a part of the map without them (`crop`), or a new measurement: with those that are removed already, they are more than single \
             wrong points"
                .to_owned()
        }
        Measure::Spikes if has_too_many_spikes(finding, map) => format!(
            "a part of the map without them (`crop`), or another measurement: more than {} of the points stand out, as steep walls and noise do",
            percent(MOST_SPIKE_POINTS)
        ),
        Measure::Spikes => key(),
        Measure::FormShare if map.level.next().is_some() => key(),
        Measure::FormShare => format!("an L filter such as {}", key()),
        Measure::SlopeCorrelation => "a map turned so that the lay is along x or y".to_owned(),
        Measure::AspectRatio => "`law = \"elliptic-zmc\"` or `\"elliptic-hertz\"` describes ridges".to_owned(),
        Measure::LineOffsets if map.aligned.is_some() => {
            "a new measurement, or a part without such lines (`crop`): aligning whole lines leaves offsets of parts".to_owned()
        }
        Measure::LineOffsets if !map.offsets.unwrap_or_default().can_be_aligned() => format!(
            "remove the form first, or measure again; do not align the lines, which would take out {} of the variance: they look like grooves \
             or form rather than offsets",
            percent(map.offsets.unwrap_or_default().aligned_variance())
        ),
        Measure::LineOffsets => key(),
        Measure::StepOverDrop => {
            format!("an S filter such as {}, or a measurement with finer steps", key())
        }
        Measure::NoiseGrowth | Measure::GrowthRise => format!("an S filter such as {}", key()),
        Measure::CurvatureGrowth => {
            format!("an S filter at the shortest wave that matters to your contact, such as {}", key())
        }
        Measure::DensityOverTheory | Measure::CurvatureOverTheory => {
            "look at the height map: strongly skewed heights have such summits, and so do faults, several textures or smoothing by \
             the instrument"
                .to_owned()
        }
        Measure::RadiusOverTip => "a sharper tip, or its radius measured to a tenth".to_owned(),
        Measure::Untraced => "`tip`: it is sharper than stated, or noise stands out, which an S filter removes".to_owned(),
        Measure::LengthOverSide => {
            let larger = larger_map(finding, map);
            if !leaves_waves(finding, map) {
                return larger;
            }
            format!("{larger}, or an L filter ({}) where the longest waves are form and do not matter to your contact", key())
        }
        Measure::NominalArea => match map.is_held {
            [_, true] => "`pixel` or `unit`, as in `pixel = \"0.8 um\"`, in place of what the file states".to_owned(),
            [true, false] => "`unit`: without one lengths in the file are in metres, as in `unit = \"um\"`".to_owned(),
            [false, false] => {
                "`pixel` or `unit`: a number without a unit is in metres, as in `pixel = \"0.8 um\"`".to_owned()
            }
        },
        Measure::LeastSlope => format!(
            "{}: heights and pixel size are probably in different units (a number without a unit is in metres)",
            unit_keys(map, "`pixel` or `unit`")
        ),
        Measure::Slope if finding.is_of_units() => format!(
            "{}: heights and pixel size are probably in different units (no surface has slopes above {})",
            unit_keys(map, "`unit` or `pixel`"),
            number(LARGEST_FLANKS)
        ),
        Measure::Slope if finding.is_blocking() => {
            "none by preparation: asperity contact assumes small slopes. An S filter at the shortest wave that matters to your contact \
             lowers them"
                .to_owned()
        }
        Measure::Slope => "the models and boundary elements leave out terms of second order in the slope".to_owned(),
    }
}

/// What to do about heights that are equal.
fn shared_height_remedy(map: &MapFacts) -> String {
    let shared = map.quantisation.and_then(|steps| steps.shared);
    // With all digits: marks are compared exactly.
    let mark = match shared.map(|shared| shared.height + map.offset) {
        Some(0.0) | None => "`missing = 0`".to_owned(),
        Some(height) => {
            format!("`missing = {height:e}` (of heights in metres; else this height in the unit of the file)")
        }
    };
    match shared.map(|shared| shared.place) {
        Some(HeightPlace::Highest) => format!(
            "a measurement whose range holds the highest points, which carry the load, or {mark}, if these points are missing ones"
        ),
        Some(HeightPlace::Lowest) => format!("{mark}, or a measurement whose range holds the deepest points"),
        Some(HeightPlace::Between) | None => mark,
    }
}
