//! `causes.csv` and `leads.csv`, and what is counted for them: which cause leads where, and which model is nearer.

use asperity::compare::{Cause, ComparedQuantity, Contribution, Contributions, Estimate, ModelKind, Verdict};
use asperity_contact_framework::report::format::input_number;
use asperity_contact_framework::report::table::Table;
use asperity_contact_framework::rows;

use super::results::{CausesResults, GridPoint, QUANTITIES, QuantityAtLoad, Reached};
use crate::model_tables::limits;

/// One point of the grid, load and quantity.
pub struct CauseRow<'a> {
    results: &'a CausesResults,
    point: &'a GridPoint,
    condition: [usize; 2],
    quantity: ComparedQuantity,
}

impl CauseRow<'_> {
    fn parts(&self) -> Option<&Contributions> {
        self.point.parts(self.condition, self.quantity)
    }

    fn reached(&self, of: fn(&Reached) -> f64) -> Option<f64> {
        Some(of(&self.point.surfaces.as_ref().ok()?.reached))
    }

    fn at(&self) -> Option<&QuantityAtLoad> {
        self.point.quantity(self.condition, self.quantity)
    }

    fn difference(&self) -> Option<(Estimate, Option<Verdict>)> {
        self.at()?.difference
    }

    /// Of statistical and deterministic model less the reference, and of their magnitudes.
    fn against(&self, index: usize) -> Option<Estimate> {
        Some(self.at()?.against.as_ref()?[index])
    }

    fn mean(&self, cause: Cause) -> Option<f64> {
        Some(self.parts()?.part(cause))
    }

    fn end(&self, of: fn(&Contributions) -> &Contribution, index: usize) -> Option<f64> {
        Some(of(self.parts()?).interval()?[index])
    }
}

fn heights(parts: &Contributions) -> &Contribution {
    parts.of_cause(Cause::Heights)
}

fn spread(parts: &Contributions) -> &Contribution {
    parts.of_cause(Cause::Radii)
}

fn correlation(parts: &Contributions) -> &Contribution {
    parts.of_cause(Cause::Correlation)
}

fn radii(parts: &Contributions) -> &Contribution {
    &parts.radii
}

rows! { CauseRow<'_> => "causes.csv";
    "One row for each point of the grid, law, load and quantity: what each cause contributes to the difference between the models at equal load, and how far both are from the reference; means over the surfaces. The contributions are empty where the load is not admissible on one of them.";
    row =>
    skewness["1", input] = row.point.skewness, "Skewness of the surface heights asked for.";
    kurtosis["1", input] = row.point.kurtosis, "Kurtosis asked for; without a list in the spec that of a gamma distribution of the skewness.";
    wavelengths["1", input] = row.point.wavelengths, "Longest over shortest wavelength of the self-affine spectrum; empty where it follows from the summits.";
    surfaces["count"] = row.results.realisations, "Number of surfaces.";
    pixel_m["m"] = row.reached(|reached| reached.pixel), "Sampling interval of the first surface; this and what follows are empty where no surface has what is asked for.";
    asperities["1"] = row.reached(|reached| reached.asperities), "Number of asperities; this and what follows are means over the surfaces.";
    surface_skewness["1"] = row.reached(|reached| reached.skewness), "Skewness of the surface heights that was reached.";
    surface_kurtosis["1"] = row.reached(|reached| reached.kurtosis), "Kurtosis of the surface heights that was reached.";
    nayak_alpha["1", label("Nayak's α")] = row.reached(|reached| reached.alpha), "Nayak's bandwidth parameter m0 m4/m2^2.";
    gradient["1"] = row.reached(|reached| reached.gradient), "Root mean square gradient.";
    asperity_skewness["1"] = row.reached(|reached| reached.asperity_skewness), "Skewness of the heights of the asperities.";
    radius_cv["1"] = row.reached(|reached| reached.radius_cv), "Standard deviation of the radii over their mean.";
    height_radius_correlation["1"] = row.reached(|reached| reached.height_radius_correlation), "Correlation of heights and radii.";
    plasticity_index["1"] = row.reached(|reached| reached.plasticity_index), "Plasticity index (E*/H)(sigma/R)^0.5 of Greenwood and Williamson (1966); 0 where nothing yields.";
    law["text"] = &*row.results.laws[row.condition[0]], "Contact law.";
    pressure_pa["Pa", prefix("M"), input] = row.results.loads[row.condition[1]], "Nominal pressure.";
    quantity["text"] = row.quantity.name(), "What is compared: `separation` or `area` (real contact area).";
    difference["1", signed, scale(1.0)] = row.difference().map(|(estimate, _)| estimate.contrast), "Statistical minus deterministic: of the separation in sigma of the asperities; of the area the logarithm of the ratio of both. Also at loads that are not admissible (`limits`).";
    from_heights["1", signed, scale(1.0)] = row.mean(Cause::Heights), "Part of the difference from the height distribution, mean over the orders of replacement. The parts add up to the difference.";
    from_radii["1", signed, scale(1.0)] = row.mean(Cause::Radii), "Part from the spread of radii.";
    from_correlation["1", signed, scale(1.0)] = row.mean(Cause::Correlation), "Part from the correlation of heights and radii.";
    from_radii_and_correlation["1", signed, scale(1.0)] = row.parts().map(|parts| parts.radii.mean.contrast), "Part of the radii: their spread and their correlation with the heights together.";
    from_radii_with_other_mean_radius["1", signed, scale(1.0)] = row.parts().and_then(|parts| parts.with_other_radius).map(|parts| parts[Cause::Radii as usize]), "Part from the spread of radii if the statistical model took 1/(mean curvature) as its radius.";
    from_heights_low["1", signed, scale(1.0)] = row.end(heights, 0), "Lower end of the 95 % interval of the part from the height distribution, from the scatter of the surfaces; it holds the intervals of all orders.";
    from_heights_high["1", signed, scale(1.0)] = row.end(heights, 1), "Upper end of that interval.";
    from_radii_low["1", signed, scale(1.0)] = row.end(spread, 0), "The same of the spread of radii.";
    from_radii_high["1", signed, scale(1.0)] = row.end(spread, 1), "Upper end of that interval.";
    from_correlation_low["1", signed, scale(1.0)] = row.end(correlation, 0), "The same of the correlation.";
    from_correlation_high["1", signed, scale(1.0)] = row.end(correlation, 1), "Upper end of that interval.";
    from_radii_and_correlation_low["1", signed, scale(1.0)] = row.end(radii, 0), "The same of both together.";
    from_radii_and_correlation_high["1", signed, scale(1.0)] = row.end(radii, 1), "Upper end of that interval.";
    limits["text"] = row.point.at(row.condition).map(|at| limits(at.exceeded)), "Limits of admissible loads that are exceeded on some of the surfaces, as in `curves.csv`.";
    leading_cause["text"] = row.point.unaccepted(row.condition, row.quantity).map(|parts| parts.leading().map_or("none", Cause::name)), "The leading cause: `heights`, `radii`, `correlation`, or `none`; empty where the difference is within what is accepted.";
    low["1", signed, scale(1.0)] = row.difference().and_then(|(estimate, _)| estimate.interval()).map(|ends| ends[0]), "Lower end of the 95 % interval of the difference, from the scatter of the surfaces.";
    high["1", signed, scale(1.0)] = row.difference().and_then(|(estimate, _)| estimate.interval()).map(|ends| ends[1]), "Upper end of that interval.";
    verdict["text", verdict] = row.difference().and_then(|(_, verdict)| verdict).map(Verdict::name), "Whether the difference is `within` what is accepted, `beyond` it, or `cannot-tell`; empty where the load is not admissible.";
    statistical_from_reference["1", signed, scale(1.0)] = row.against(0).map(|estimate| estimate.contrast), "Statistical model less the reference, in the unit of `difference`; with what follows empty where no reference was run.";
    deterministic_from_reference["1", signed, scale(1.0)] = row.against(1).map(|estimate| estimate.contrast), "Deterministic model less the reference.";
    farther["1", signed, scale(1.0), label("statistical farther by")] = row.against(2).map(|estimate| estimate.contrast), "How much farther the statistical model is from the reference than the deterministic one: the difference of the magnitudes. The intervals hold point by point, not for all points together.";
    farther_low["1", signed, scale(1.0)] = row.against(2).and_then(|estimate| estimate.interval()).map(|ends| ends[0]), "Lower end of its 95 % interval, with the bound of the error of the reference.";
    farther_high["1", signed, scale(1.0)] = row.against(2).and_then(|estimate| estimate.interval()).map(|ends| ends[1]), "Upper end of that interval.";
    nearer["text", label("nearer to the reference")] = row.at().and_then(QuantityAtLoad::nearer_model).map(ModelKind::name), "The model that is nearer to the reference by more than a tenth of what is accepted; empty where it cannot be told or both are as near.";
    is_homogeneous["true/false", label("beyond small strains")] = row.at().and_then(|at| at.nearer.as_ref()).map(|stretch| stretch.beyond.is_some()), "Whether the load exceeds the limit of large strains alone and the comparison, of elastic contacts, is homogeneous in the heights: it holds for lower surfaces of the same shape.";
    without_surface["text"] = row.point.surfaces.as_ref().err().map(String::as_str), "Why the point has no surface; empty of others.";
}

/// How often a cause leads at one load in one quantity.
pub struct LeadRow<'a> {
    results: &'a CausesResults,
    findings: &'a Findings,
    lead: &'a Lead,
}

rows! { LeadRow<'_> => "leads.csv";
    "One row for each law, load, quantity and cause that leads somewhere on the grid; `none` for points where no cause leads.";
    row =>
    law["text"] = &*row.results.laws[row.findings.condition[0]], "Contact law.";
    pressure_pa["Pa", label("nominal pressure"), prefix("M"), input] = row.results.loads[row.findings.condition[1]], "Nominal pressure.";
    quantity["text"] = row.findings.quantity.name(), "What is compared: `separation` or `area` (real contact area).";
    cause["text", label("leading cause")] = row.lead.cause.map_or("none", Cause::name), "The cause: `heights`, `radii`, `correlation`, or `none`.";
    points["count"] = row.lead.points, "Points of the grid at which it leads.";
    points_divided["count", label("of")] = row.findings.divided, "Points whose difference is divided (the load is admissible on all surfaces) and not within what is accepted.";
    skewness_in_every_row["text", label("in every row for a skewness of")] = row.lead.in_every_row.iter().map(|&skewness| input_number(skewness)).collect::<Vec<_>>(), "Skewnesses at which it leads in every row of the grid, none of which is left out.";
    smallest_share_of_radii["1", percent] = row.findings.share_of_radii.map(|[low, _]| low), "Smallest share of the spread of radii in the contributions, taken by magnitude, over the points.";
    largest_share_of_radii["1", percent] = row.findings.share_of_radii.map(|[_, high]| high), "Largest such share.";
    radii_larger_points["count", label("radii together larger than heights")] = row.findings.radii_larger, "Points at which spread and correlation of the radii together contribute more than the heights, by magnitude of the means.";
    radii_exceed_points["count", label("with intervals apart")] = row.findings.radii_exceed, "Points at which they do so with 95 % intervals apart.";
    heights_exceed_points["count", label("heights larger with intervals apart")] = row.findings.heights_exceed, "Points at which the heights contribute more than the radii together, with 95 % intervals apart.";
}

pub fn tables(results: &CausesResults) -> Vec<Table> {
    let rows = results.points.iter().flat_map(|point| {
        results.conditions().flat_map(move |condition| {
            QUANTITIES.map(|quantity| CauseRow { results, point, condition, quantity })
        })
    });
    let findings = Findings::all(results);
    let leads = findings
        .iter()
        .flat_map(|findings| findings.leads.iter().map(move |lead| LeadRow { results, findings, lead }));
    vec![Table::new(leads), Table::new(rows)]
}

#[derive(Debug)]
pub struct Findings {
    pub quantity: ComparedQuantity,
    /// Indices of law and load.
    pub condition: [usize; 2],
    /// Points of the grid whose difference is divided, unless it is known to be within what is accepted.
    pub divided: usize,
    /// Causes that lead somewhere, the most frequent first, and last `None` for points where none does.
    pub leads: Vec<Lead>,
    /// Smallest and largest share of the spread of radii in the contributions, taken by magnitude; `None` without points.
    pub share_of_radii: Option<[f64; 2]>,
    /// Points at which spread and correlation of the radii together contribute more than the heights, by magnitude of the means.
    pub radii_larger: usize,
    /// Points at which they do so with 95 % intervals apart.
    pub radii_exceed: usize,
    /// Points at which the heights contribute more with 95 % intervals apart.
    pub heights_exceed: usize,
}

/// A cause and where it leads.
#[derive(Debug, PartialEq)]
pub struct Lead {
    /// `None`: no cause leads.
    pub cause: Option<Cause>,
    pub points: usize,
    /// Skewnesses at which it leads in every row of the grid.
    pub in_every_row: Vec<f64>,
}

impl Findings {
    /// Law by law, load by load, quantity by quantity.
    pub fn all(results: &CausesResults) -> Vec<Self> {
        let quantities = |condition| QUANTITIES.map(|quantity| Self::new(results, quantity, condition));
        results.conditions().flat_map(quantities).collect()
    }

    /// Of one quantity under a law at a load.
    pub fn new<'a>(results: &'a CausesResults, quantity: ComparedQuantity, condition: [usize; 2]) -> Self {
        let divided = |point: &'a GridPoint| Some((point.skewness, point.unaccepted(condition, quantity)?));
        let divided: Vec<(f64, &Contributions)> = results.points.iter().filter_map(divided).collect();
        let lead = |cause: Option<Cause>| {
            let with_it: Vec<f64> =
                divided.iter().filter(|(_, parts)| parts.leading() == cause).map(|(at, _)| *at).collect();
            let rows =
                |skewness: f64| results.points.iter().filter(|point| point.skewness == skewness).count();
            let mut in_every_row = with_it.clone();
            in_every_row.sort_by(f64::total_cmp);
            in_every_row.dedup();
            in_every_row
                .retain(|&skewness| with_it.iter().filter(|at| **at == skewness).count() == rows(skewness));
            Lead { cause, points: with_it.len(), in_every_row }
        };
        let mut leads: Vec<Lead> = Cause::ALL.into_iter().map(|cause| lead(Some(cause))).collect();
        leads.sort_by_key(|lead| std::cmp::Reverse(lead.points));
        leads.push(lead(None));
        leads.retain(|lead| lead.points > 0);
        let shares = || divided.iter().map(|(_, parts)| parts.share(Cause::Radii));
        let share_of_radii = (!divided.is_empty())
            .then(|| [shares().fold(f64::INFINITY, f64::min), shares().fold(0.0, f64::max)]);
        let count =
            |holds: &dyn Fn(&Contributions) -> bool| divided.iter().filter(|(_, parts)| holds(parts)).count();
        let heights = |parts: &Contributions| *parts.of_cause(Cause::Heights);
        let size = |part: &Contribution| part.mean.contrast.abs();
        Self {
            quantity,
            condition,
            divided: divided.len(),
            leads,
            share_of_radii,
            radii_larger: count(&|parts| size(&parts.radii) > size(&heights(parts))),
            radii_exceed: count(&|parts| parts.radii.exceeds(&heights(parts))),
            heights_exceed: count(&|parts| heights(parts).exceeds(&parts.radii)),
        }
    }
}

/// How often each model is nearer to the reference in one quantity, over all laws, loads and points.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct NearerCounts {
    /// Points at which it can be compared.
    pub compared: usize,
    /// Of these, points beyond small strains, which stand for lower surfaces of the same shape.
    pub beyond_small_strains: usize,
    /// Where the statistical model is nearer.
    pub statistical: usize,
    /// Where the deterministic model is nearer.
    pub deterministic: usize,
}

impl NearerCounts {
    pub fn new(results: &CausesResults, quantity: ComparedQuantity) -> Self {
        let mut counts = Self::default();
        for condition in results.conditions() {
            for point in &results.points {
                let Some(stretch) = point.quantity(condition, quantity).and_then(|at| at.nearer.as_ref())
                else {
                    continue;
                };
                counts.compared += 1;
                counts.beyond_small_strains += usize::from(stretch.beyond.is_some());
                counts.statistical += usize::from(stretch.nearer == Some(ModelKind::Statistical));
                counts.deterministic += usize::from(stretch.nearer == Some(ModelKind::Deterministic));
            }
        }
        counts
    }
}

/// How often the integral may replace the sum in one quantity, over all laws, loads and points.
#[derive(Debug, Default, PartialEq)]
pub struct VerdictCounts {
    /// Points and loads at which the models are compared.
    pub compared: usize,
    /// Where they agree within what is accepted.
    pub within: usize,
    /// Where they differ by more.
    pub beyond: usize,
    /// The smallest and the largest difference, as a contrast; `None` without points.
    pub range: Option<[f64; 2]>,
}

impl VerdictCounts {
    pub fn new(results: &CausesResults, quantity: ComparedQuantity) -> Self {
        let mut counts = Self::default();
        let verdicts = results.conditions().flat_map(|condition| {
            let at = results.points.iter().filter_map(move |point| point.quantity(condition, quantity));
            let with_verdict = |at: &QuantityAtLoad| {
                let (estimate, verdict) = at.difference?;
                Some((estimate.contrast, verdict?))
            };
            at.filter_map(with_verdict).collect::<Vec<_>>()
        });
        for (contrast, verdict) in verdicts {
            let [low, high] = counts.range.unwrap_or([contrast; 2]);
            counts.range = Some([low.min(contrast), high.max(contrast)]);
            counts.compared += 1;
            counts.within += usize::from(verdict == Verdict::Within);
            counts.beyond += usize::from(verdict == Verdict::Beyond);
        }
        counts
    }
}
