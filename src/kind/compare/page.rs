//! The page of a comparison: how far apart the two models are, why, and which to trust.

use super::figures;
use super::{decreasing, layer_page};
use crate::kind::compare::results::{CaseResults, CompareResults, SurfaceResults};
use crate::surface::section as surface_section;
use asperity::compare::{
    Comparison, Control, Gap, Kind, Pair, Realisation, Scatter, Spread, of_each_decade, spread,
};
use asperity_framework::report::format::{count, number, quantity};
use asperity_framework::report::page::Page;
use asperity_framework::report::page::escape;
use asperity_framework::report::sections;

/// A gap of fewer standard errors than this may be chance.
const SIGNIFICANT: f64 = 3.0;

/// The page.
pub fn page(results: &CompareResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    sections::notes(&mut page, &results.metadata);
    for warning in results.warnings() {
        page.warning(&escape(&warning));
    }
    page.heading(2, "In short");
    let layered = layer_page::all(results);
    for series in &layered {
        page.bullets(series.in_short());
    }
    // A single thickness is shown as closely as no layer.
    let in_full = layered.iter().all(|series| !series.has_several());
    for found in results.surfaces.iter().filter(|_| in_full) {
        for index in 0..found.first.cases.len() {
            page.bullets(in_short(results, found, index));
        }
    }
    for found in &results.surfaces {
        for law in laws(found) {
            let layer = results.contact.layer.as_ref();
            let lines = decreasing::lines(&subject(results, found, law), found, law, layer);
            if !lines.is_empty() {
                page.bullets(lines);
            }
        }
    }
    if results.surfaces.iter().any(|found| laws(found).len() > 1) {
        page.paragraph(
            "An experiment of the kind `[laws]` sets laws beside each other, and against the adding-up.",
        );
    }
    sections::what_was_run(&mut page, &results.metadata, &results.contact);
    if let Some(layer) = &results.contact.layer {
        layer_page::rule_section(&mut page, layer);
    }
    for found in &results.surfaces {
        surface(&mut page, found);
        for series in layered.iter().filter(|series| !in_full && std::ptr::eq(series.found(), found)) {
            series.answers(&mut page);
        }
        for index in (0..found.first.cases.len()).filter(|_| in_full) {
            answers(&mut page, results, found, index);
        }
    }
    limits(&mut page, results);
    sections::sources(&mut page, &results.metadata);
    page
}

/// The finding in a few sentences.
fn in_short(results: &CompareResults, found: &SurfaceResults, index: usize) -> Vec<String> {
    let case = &found.first.cases[index];
    let subject = subject(results, found, &case.law);
    if !found.others.is_empty()
        && let Some(lines) = in_short_over_all(&subject, found, index)
    {
        return lines;
    }
    if case.gaps.largest.is_empty() {
        return vec![format!(
            "**{subject}**: no pair of answers rests on at least 30 contacts within 5 % real area, so nothing is said \
             about the gap between the models."
        )];
    }
    let mut lines: Vec<String> =
        case.gaps.largest.iter().map(|gap| format!("**{subject}**: {}", sentence(gap))).collect();
    lines.push(format!(
        "**{subject}, which to trust**: {}",
        verdict(found, is_significant(&case.gaps.largest))
    ));
    lines
}

/// The finding over all realisations; `None` where they have no load in common that counts.
fn in_short_over_all(subject: &str, found: &SurfaceResults, index: usize) -> Option<Vec<String>> {
    let all = realisations_of(found, index);
    let spread = spread(&all);
    let counting = || spread.iter().filter(|at| at.counts());
    let by_mean = |a: &&Spread, b: &&Spread| a.difference.mean.abs().total_cmp(&b.difference.mean.abs());
    let largest = counting().max_by(by_mean)?;
    let errors = |at: &Spread| at.standard_errors(all.len());
    let surest = counting().max_by(|a, b| errors(a).total_cmp(&errors(b)))?;
    let finding = format!(
        "**{subject}**, over {} realisations: at equal load the separations differ by up to {} ± {} σ (mean ± standard deviation of one \
         realisation) at {}, {} standard errors of the mean: {} σ statistical, {} σ deterministic. {CONDITION}",
        all.len(),
        number(largest.difference.mean.abs()),
        number(largest.difference.deviation),
        quantity(largest.target, "Pa"),
        number(errors(largest)),
        number(largest.statistical_separation.mean),
        number(largest.deterministic_separation.mean),
    );
    let ratios = || counting().map(|at| (at, at.statistical_area.mean / at.deterministic_area.mean));
    let (at, ratio) = ratios().max_by(|a, b| a.1.ln().abs().total_cmp(&b.1.ln().abs()))?;
    let area = format!(
        "**{subject}**: at equal load, where the real areas are furthest apart in the mean, the statistical one is {} times the \
         deterministic one, at {}.",
        number(ratio),
        quantity(at.target, "Pa")
    );
    let trust = format!("**{subject}, which to trust**: {}", verdict(found, errors(surest) > SIGNIFICANT));
    Some(vec![finding, area, trust])
}

/// Whether one of the gaps is more than chance.
pub fn is_significant<'a>(gaps: impl IntoIterator<Item = &'a Gap>) -> bool {
    gaps.into_iter().any(|gap| gap.over_sampling_error.is_none_or(|errors| errors > SIGNIFICANT))
}

/// What a finding rests on.
pub const CONDITION: &str = "Only loads that at least 30 asperities carry within A/A_nom = 0.05 count.";

/// All realisations under one law.
fn realisations_of(found: &SurfaceResults, index: usize) -> Vec<Realisation<'_>> {
    found
        .realisations()
        .map(|(_, answered)| {
            (&answered.cases[index].comparison.pairs[..], answered.sigma, answered.nominal_area)
        })
        .collect()
}

/// The laws of a surface, in file order.
pub fn laws(found: &SurfaceResults) -> Vec<&str> {
    let mut laws: Vec<&str> = found.first.cases.iter().map(|case| case.law.as_str()).collect();
    laws.dedup();
    laws
}

/// What a finding is about: the surface, and the law where there are several.
pub fn subject(results: &CompareResults, found: &SurfaceResults, law: &str) -> String {
    let one_law = results.surfaces.iter().all(|found| laws(found).len() == 1);
    if one_law { found.surface.name.clone() } else { format!("{}, law {law}", found.surface.name) }
}

/// The same as the beginning of a file's name.
pub fn stem(found: &SurfaceResults, law: &str) -> String {
    let name = &found.surface.name;
    if laws(found).len() == 1 { name.clone() } else { format!("{name}-{}", slug(law)) }
}

fn sentence(gap: &Gap) -> String {
    let errors = match gap.over_sampling_error {
        Some(errors) => format!(" ({} standard errors of the sum)", number(errors)),
        None => String::new(),
    };
    match (gap.quantity, gap.pairing) {
        ("separation_over_sigma", _) => format!(
            "at equal load the separations differ by up to {} σ: {} σ statistical, {} σ deterministic at {}{errors}. {CONDITION}",
            number(gap.difference().abs()),
            number(gap.statistical),
            number(gap.deterministic),
            quantity(gap.target, "Pa"),
        ),
        ("area_ratio", _) => format!(
            "at equal load, where the real areas are furthest apart, the statistical one is {} times the deterministic one, at {}{errors}.",
            number(gap.ratio()),
            quantity(gap.target, "Pa"),
        ),
        _ => format!(
            "at equal separation, where the loads are furthest apart, the statistical one is {} times the deterministic one, at d/σ = {}{errors}.",
            number(gap.ratio()),
            number(gap.target),
        ),
    }
}

/// Which model to use on this surface, from what the gaps and the surface say.
pub fn verdict(found: &SurfaceResults, is_significant: bool) -> String {
    if !found.surface.warnings.is_empty() {
        return "neither, before the warning above is dealt with: the numbers are not those of the surface."
            .to_owned();
    }
    if !is_significant {
        return "either. The models differ by less than three standard errors of the sum: another sample of the \
                same surface would move the sum as much."
            .to_owned();
    }
    let statistics = &found.surface.statistics;
    let mut causes = Vec::new();
    if let (Some(skewness), Some(kurtosis)) = (statistics.skewness, statistics.kurtosis)
        && (skewness.abs() > 0.1 || (kurtosis - 3.0).abs() > 0.2)
    {
        causes.push(format!(
            "its heights have skewness {} and kurtosis {} (0 and 3 if Gaussian)",
            number(skewness),
            number(kurtosis)
        ));
    }
    if statistics.radius_cv > 0.1 {
        causes.push(format!("its radii scatter by {} % of their mean", number(100.0 * statistics.radius_cv)));
    }
    if let Some(correlation) = statistics.height_radius_correlation.filter(|c| c.abs() > 0.1) {
        causes.push(format!("heights and radii correlate ({})", number(correlation)));
    }
    let why = if causes.is_empty() {
        String::new()
    } else {
        format!(" The surface is not what the integral assumes: {}.", causes.join("; "))
    };
    format!("the deterministic sum. The gap exceeds its sampling error.{why}")
}

/// What the surface is, and what the statistical model makes of it.
pub fn surface(page: &mut Page, found: &SurfaceResults) {
    let surface = &found.surface;
    let population = &found.first.population;
    page.heading(2, &format!("Surface {}", surface.name));
    if !found.others.is_empty() {
        page.paragraph(&format!(
            "This is the first of {} realisations; all are in `summary.json` and the tables.",
            found.others.len() + 1
        ));
    }
    surface_section(page, surface, Some(population));
    if surface.is_quoted_as_surface() {
        page.paragraph(
            "Separations are measured from the mean plane of the surface, in the standard deviation of the surface heights; \
             asperity heights follow from Nayak (1971).",
        );
    }
    page.paragraph(&format!(
        "The statistical model stands on {} heights with σ = {}, one radius of {} and η = {} /m².",
        population.heights.label(),
        quantity(population.sigma, "m"),
        quantity(population.radius, "m"),
        number(population.density),
    ));
    if let Some(mean) = &surface.ellipticity {
        let spheres = surface.map.as_ref().filter(|map| map.saddles > 0).map(|map| {
            format!(
                " {} of {} summits are no ellipses, since one of their principal curvatures is not positive: elliptic laws \
                 take them as spheres of their mean curvature.",
                count(map.saddles),
                count(map.summits)
            )
        });
        page.paragraph(&format!(
            "Under an elliptic law it stands on asperities of the mean curvature {} /m (a radius of {}) and the mean ratio \
             of the smaller to the larger principal curvature, {}.{}",
            number(mean.mean_curvature),
            quantity(mean.mean_curvature.recip(), "m"),
            number(mean.mean_ratio),
            spheres.unwrap_or_default()
        ));
    }
}

/// Both models' answers under one law.
fn answers(page: &mut Page, results: &CompareResults, found: &SurfaceResults, index: usize) {
    let case = &found.first.cases[index];
    let (modulus, comparison) = (results.contact.reduced_modulus, &case.comparison);
    let stem = stem(found, &case.law);
    page.heading(2, &format!("{}: the answers", subject(results, found, &case.law)));
    if let Some(index) = case.plasticity_index {
        page.paragraph(&format!("Plasticity index ψ = (E*/H)(σ/R)^½ = {}.", number(index)));
    }
    let mut figure = |name: &str, caption: &str, svg: String| {
        page.figure(&format!("{stem}-{name}.svg"), svg, caption);
    };
    let others: Vec<&Comparison> =
        found.others.iter().map(|answered| &answered.cases[index].comparison).collect();
    figure(
        "separation",
        "Separation against load ratio, and the difference at equal load. Bands: 95 % of other samples of the same \
         surface would lie within, if asperities were independent draws.",
        figures::separation(comparison, &others, modulus, found.surface.plane.sigma),
    );
    figure("area", "Real contact area against load ratio.", figures::area(comparison, modulus));
    figure("regimes", "How the load is shared by the regimes.", figures::regimes(comparison, modulus));
    realisations(page, found, index);
    let pairs = of_each_decade(figures::at_equal_load(comparison), |pair| pair.target, STEPS);
    if !pairs.is_empty() {
        page.paragraph(if found.others.is_empty() {
            "Both models at equal load:"
        } else {
            "Both models at equal load, in full, on the first realisation:"
        });
        let area = found.surface.set.nominal_area();
        page.table(LOAD_TABLE, pairs.iter().map(|pair| load_row(pair)));
        page.table(CONTACT_TABLE, pairs.iter().map(|pair| contact_row(pair, area)));
    }
}

/// How far several realisations lie apart, and whether the sums' own sampling errors tell so.
fn realisations(page: &mut Page, found: &SurfaceResults, index: usize) {
    let all = realisations_of(found, index);
    let spread = spread(&all);
    if spread.is_empty() {
        return;
    }
    let generation = found.surface.map.as_ref().and_then(|map| map.generation.as_ref());
    let is_targeted = generation.is_some_and(|made| made.target.is_some());
    page.paragraph(&format!(
        "Both models at equal load over {} realisations, each pressed to the same loads: mean ± standard deviation of one \
         realisation, and beside it the sampling error that the sums state for themselves.{}",
        all.len(),
        if is_targeted {
            " All realisations are scaled to the same radius, σ and density, which takes out a part of the scatter."
        } else {
            ""
        }
    ));
    let with_scatter =
        |scatter: &Scatter| format!("{} ± {}", number(scatter.mean), number(scatter.deviation));
    page.table(
        ["p", "d/σ stat.", "d/σ det.", "stated error", "difference", "A/A_nom stat.", "A/A_nom det."],
        of_each_decade(&spread, |at| at.target, STEPS).into_iter().map(|at| {
            vec![
                quantity(at.target, "Pa"),
                number(at.statistical_separation.mean),
                with_scatter(&at.deterministic_separation),
                number(at.sampling_error),
                with_scatter(&at.difference),
                number(at.statistical_area.mean),
                with_scatter(&at.deterministic_area),
            ]
        }),
    );
}

/// Steps of a decade that tables show: loads nearest to one and three.
const STEPS: f64 = 2.0;

const LOAD_TABLE: [&str; 8] = [
    "p",
    "d/σ stat.",
    "d/σ det.",
    "difference",
    "A/A_nom stat.",
    "A/A_nom det.",
    "± s.e.",
    "beyond the models",
];

fn load_row(pair: &Pair) -> Vec<String> {
    let (s, d) = (&pair.statistical, &pair.deterministic);
    vec![
        quantity(pair.target, "Pa"),
        number(s.separation_over_sigma),
        number(d.separation_over_sigma),
        number(s.separation_over_sigma - d.separation_over_sigma),
        number(s.area_ratio.total()),
        number(d.area_ratio.total()),
        d.sampling.map_or_else(|| "-".to_owned(), |error| number(error.area_ratio)),
        if pair.is_beyond_model() { "asperities interact".to_owned() } else { String::new() },
    ]
}

const CONTACT_TABLE: [&str; 7] = [
    "p",
    "contacts stat.",
    "contacts det.",
    "mean real p stat.",
    "mean real p det.",
    "−dp/dd stat. [Pa/m]",
    "−dp/dd det. [Pa/m]",
];

fn contact_row(pair: &Pair, area: f64) -> Vec<String> {
    let (s, d) = (&pair.statistical, &pair.deterministic);
    let real = |pressure: Option<f64>| pressure.map_or_else(|| "-".to_owned(), |p| quantity(p, "Pa"));
    vec![
        quantity(pair.target, "Pa"),
        number(s.contact_density * area),
        count((d.contact_density * area).round() as usize),
        real(s.mean_real_pressure()),
        real(d.mean_real_pressure()),
        number(s.stiffness),
        number(d.stiffness),
    ]
}

/// Where the answers should not be trusted, with numbers.
fn limits(page: &mut Page, results: &CompareResults) {
    page.heading(2, "Where not to trust this");
    let mut lines = Vec::new();
    for found in &results.surfaces {
        for law in laws(found) {
            let cases: Vec<&CaseResults> = found.first.cases.iter().filter(|case| case.law == law).collect();
            limits_of(&mut lines, &subject(results, found, law), found, &cases);
        }
    }
    lines.extend(tolerance(results));
    lines.extend(assumptions(results));
    page.bullets(lines);
}

/// How far curves are off that were not asked everywhere.
fn tolerance(results: &CompareResults) -> Option<String> {
    let of = |kind: Kind| {
        let tolerance = results.tolerances.of(kind)?;
        Some(format!("of the {} model within {tolerance:e} of its own answer", kind.name()))
    };
    let held: Vec<String> = [Kind::Statistical, Kind::Deterministic].into_iter().filter_map(of).collect();
    (!held.is_empty()).then(|| {
        format!(
            "Over d/σ the models were asked at some of the points, the rest is interpolated and checked: load and area are \
             {}; shares of the regimes, stiffness and sampling errors are interpolated alike.",
            held.join(", ")
        )
    })
}

/// What all answers take for granted.
pub fn assumptions(results: &CompareResults) -> [String; 2] {
    let flat = if results.contact.layer.is_some() {
        ", its layer bonded everywhere and free of cracks and residual stress"
    } else {
        " and homogeneous"
    };
    let sees_ellipses = results.surfaces.iter().any(|found| found.surface.ellipticity.is_some());
    let asperities = if sees_ellipses { "spheres, or ellipses under elliptic laws," } else { "spheres" };
    [
        format!(
            "The flat is smooth{flat}; asperities are {asperities} that do not touch each other; there is no adhesion, friction or \
             hardening.",
        ),
        "Standard errors take the asperities as independent draws; those of a real surface are neighbours, and a surface with long \
         waves scatters more."
            .to_owned(),
    ]
}

/// The same of one surface under one law, all thicknesses together.
pub fn limits_of(lines: &mut Vec<String>, subject: &str, found: &SurfaceResults, cases: &[&CaseResults]) {
    let curves = || cases.iter().flat_map(|case| &case.comparison.curves);
    let beyond = curves().filter(|point| point.response.is_beyond_model()).count();
    let sum = || curves().filter(|point| point.kind == Kind::Deterministic);
    let few = sum().filter(|point| {
        let contacts = point.response.contact_density * found.surface.set.nominal_area();
        contacts > 0.0 && contacts < asperity::compare::FEWEST_CONTACTS
    });
    let few = few.count();
    let pressed = || curves().filter(|point| point.control != Control::Separation);
    let jumps = pressed().filter(|point| point.in_jump).count();
    let unpaired: usize = cases.iter().map(|case| case.comparison.unpaired.len()).sum();
    if beyond > 0 {
        lines.push(format!(
            "{subject}: {beyond} of {} points lie beyond A/A_nom = 0.05, where neighbouring asperities interact and \
             no asperity model holds. They are marked `beyond_model` in the tables.",
            curves().count()
        ));
    }
    if few > 0 {
        lines.push(format!(
            "{subject}: at {few} of {} points fewer than 30 asperities carry the sum; they tell of the highest few.",
            sum().count()
        ));
    }
    if jumps > 0 {
        lines.push(format!(
            "{subject}: at {jumps} of {} points the load asked for lies in a jump of the law; the answer is the largest \
             separation that carries at least as much, and `pressure_pa` exceeds `target`.",
            pressed().count()
        ));
    }
    if unpaired > 0 {
        lines.push(format!(
            "{subject}: {unpaired} deterministic pressures have no pair at equal load: one of the models does not reach \
             them above −10 σ."
        ));
    }
}

/// A law's label as part of a file name.
fn slug(label: &str) -> String {
    let kept: String = label.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    kept.trim_matches('-').to_owned()
}
