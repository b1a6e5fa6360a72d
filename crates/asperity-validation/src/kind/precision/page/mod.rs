//! The page of `[precision]`: time and error of integrals, sums and surfaces, and the fastest methods.
//!
//! | module | contents |
//! |---|---|
//! | `figures` | time against error |
//! | `attribution` | the difference between the models divided among its causes |
//! | `scale` | curves of many separations, lists of many asperities |
//! | `physics` | effect of more asperities, points, surface |

mod attribution;
mod figures;
mod physics;
mod scale;

use crate::kind::precision::findings::{FOUR_ULP, Of, Ordering, Speedup, Winner, largest_sums};
use crate::kind::precision::names::{candidate_name, rule_name};
use crate::kind::precision::run::{CasePrecision, PrecisionResults};
use crate::precision::integral::IntegralFindings;
use crate::precision::sum::{ASPERITIES, POINTS, SEPARATIONS, Sweep, Way};
use asperity_framework::report::format::{count, input_number, input_quantity, number, quantity};
use asperity_framework::report::page::{Page, escape};
use asperity_framework::report::sections;

pub fn page(results: &PrecisionResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    let mut short: Vec<String> = results.cases.iter().flat_map(summary_lines).collect();
    short.extend(results.cases.iter().filter_map(|case| attribution::summary_line(case, &results.law)));
    short.extend(physics::summary_lines(results));
    sections::findings(&mut page, short);
    if results.cases.iter().any(|case| case.integral.is_some()) {
        integrals(&mut page, results);
    }
    if results.cases.iter().any(|case| !case.sums.is_empty()) {
        sums(&mut page, results);
    }
    scale::curves(&mut page, results);
    scale::lists(&mut page, results);
    attribution::section(&mut page, results);
    physics::sections(&mut page, results);
    sections::notes(&mut page, &results.metadata);
    sections::what_was_run(&mut page, &results.metadata, &results.contact);
    populations(&mut page, results);
    page.paragraph(
        "Times were measured on the machine that wrote this report: each is the median of interleaved runs of all \
         candidates, with at least 1 ms per measurement. They vary between machines and between runs; ratios are \
         significant beyond about 10 %.",
    );
    sections::run_again(&mut page, &results.metadata, None);
    sections::sources(&mut page, &results.metadata);
    page
}

fn populations(page: &mut Page, results: &PrecisionResults) {
    page.table(
        ["case", "radius", "σ", "η [1/m²]", "plasticity index"],
        results.cases.iter().map(|case| {
            vec![
                case.name.clone(),
                input_quantity(case.population.radius, "m"),
                input_quantity(case.population.sigma, "m"),
                input_number(case.population.density),
                case.plasticity_index.map_or_else(|| "-".to_owned(), number),
            ]
        }),
    );
    page.paragraph(&format!(
        "Law {}; {} unless stated otherwise.",
        escape(&results.law),
        thread_count(results.threads)
    ));
}

fn thread_count(threads: usize) -> String {
    if threads == 1 { "one thread".to_owned() } else { format!("{threads} threads") }
}

/// A time in seconds with a suitable prefix.
fn time(seconds: f64) -> String {
    quantity(seconds, "s")
}

/// The fastest methods for one population.
fn summary_lines(case: &CasePrecision) -> Vec<String> {
    let of = |what: Of| case.findings.winners.iter().filter(move |winner| winner.of == what);
    let mut lines = Vec::new();
    let integral: Vec<String> = of(Of::Integral).map(winner_text).collect();
    if !integral.is_empty() {
        lines.push(format!("**The integral, {}**: {}.", escape(&case.name), integral.join("; ")));
    }
    if let Some(winner) = of(Of::Sum).find(|winner| winner.level == FOUR_ULP) {
        let size = winner.asperities.map_or_else(String::new, count);
        lines.push(format!(
            "**The sum, {}**: of {size} asperities at {POINTS} separations on one thread, {}.",
            escape(&case.name),
            winner_text(winner)
        ));
    }
    lines.extend(case.findings.ordering.map(|found| ordering_line(case, found)));
    lines.extend(case.findings.speedup.map(|found| threads_line(case, found)));
    lines.extend(scale::summary_lines(case));
    lines
}

fn winner_text(winner: &Winner) -> String {
    let level = level(winner);
    let Some((fastest, cost)) = &winner.fastest else {
        return format!("none of the methods tested is within {level}");
    };
    let (name, time) = (candidate_name(fastest), time(cost.seconds));
    match winner.shipped_over_fastest {
        _ if winner.is_shipped() => {
            format!("within {level} the shipped method is the fastest ({time} per separation)")
        }
        Some(ratio) => format!(
            "within {level} the fastest is {name} ({time} per separation), and the shipped method takes {} times that",
            number(two_digits(ratio))
        ),
        None => format!(
            "within {level} the fastest is {name} ({time} per separation), and the shipped method exceeds this error"
        ),
    }
}

/// A ratio of times to two significant digits.
fn two_digits(ratio: f64) -> f64 {
    format!("{ratio:.1e}").parse().unwrap_or(ratio)
}

/// The number of separations beyond which ordering saves time.
fn ordering_line(case: &CasePrecision, found: Ordering) -> String {
    format!(
        "**Ordering, {}**: for {} asperities, sorting by height first {}.",
        escape(&case.name),
        count(found.asperities),
        match found.paid_back_by {
            Some(1) => "saves time from the first separation".to_owned(),
            Some(separations) => format!("saves time from at most {} separations on", count(separations)),
            None => "saves no time at any number of separations tested".to_owned(),
        }
    )
}

/// The effect of more threads.
fn threads_line(case: &CasePrecision, found: Speedup) -> String {
    format!(
        "**Threads, {}**: on {} the shipped sum of {} asperities takes {} times as long as on {}.",
        escape(&case.name),
        thread_count(found.to),
        count(found.asperities),
        number(two_digits(found.time)),
        thread_count(found.from),
    )
}

fn winner_table(page: &mut Page, results: &PrecisionResults, of: Of) {
    let of_case = |case: &'_ CasePrecision| {
        let winners = case.findings.winners.iter().filter(move |winner| winner.of == of);
        winners.map(|winner| winner_row(&case.name, winner)).collect::<Vec<_>>()
    };
    page.table(
        ["case", "error at most", "fastest", "its error", "time per separation", "shipped over fastest"],
        results.cases.iter().flat_map(of_case),
    );
}

fn winner_row(case: &str, winner: &Winner) -> Vec<String> {
    let (name, error, seconds) = match &winner.fastest {
        Some((fastest, cost)) => (candidate_name(fastest), number(cost.error), time(cost.seconds)),
        None => ("none".to_owned(), String::new(), String::new()),
    };
    let ratio = winner
        .shipped_over_fastest
        .map_or_else(|| "not within".to_owned(), |ratio| number(two_digits(ratio)));
    vec![case.to_owned(), level(winner), name, error, seconds, ratio]
}

/// The permitted error.
fn level(winner: &Winner) -> String {
    if winner.level == FOUR_ULP { "4 ulp".to_owned() } else { input_number(winner.level) }
}

fn integrals(page: &mut Page, results: &PrecisionResults) {
    page.heading(2, "The integral");
    let separations: Vec<String> = results.separations.iter().map(|&h| input_number(h)).collect();
    page.paragraph(&format!(
        "Area and load at d/σ = {}. Error: the largest over these separations, of area and load. Time: per separation. \
         Reference: a tanh-sinh rule in 32 digits, from the equations of the law only. Errors below 3e-17 are shown at \
         3e-17.",
        separations.join(", ")
    ));
    page.bullets([
        "All rules evaluate area and load of the same contact at their nodes, and nothing else; nodes and weights are \
         computed beforehand. **The shipped rule** is timed as in production and also returns regimes, contacts and \
         stiffness. Its nodes are those of Gauss-Legendre in panels, order 24.",
        "*Split*: at the indentations where the law changes, w1 and w2. *Substituted*: s = w^½ is the variable, which \
         removes the square root of the load at w = 0. *In panels*: the density decreases by at most exp(-20) over each.",
        "Rules of a finite domain (Legendre, Chebyshev, midpoint, trapezoid, Simpson, Gauss-Kronrod) end where the density \
         has decreased by exp(-40). \
         Chebyshev's rules are divided by their weights.",
        "Gauss-Jacobi has the weight w^½ for the load of the segment that begins at w = 0, and none for its area, hence \
         two sets of nodes. It needs no substitution.",
        "Gauss-Laguerre covers all heights above the flat, or only those beyond w2, with Gauss-Legendre below; its scale \
         is the mean indentation. Gauss-Hermite covers all heights and omits those below the flat, where the integrand has \
         a kink.",
        "Gauss-Kronrod (quad-rs) uses a relative tolerance of area and load together, after division by the density at the \
         flat.",
    ]);
    for case in &results.cases {
        let Some(found) = &case.integral else { continue };
        page.heading(3, &case.name);
        page.figure(
            &format!("{}-legendre.svg", file(&case.name)),
            figures::legendre(found),
            "Gauss-Legendre by order: effect of splitting and substitution. Vertical lines: the errors at which the \
             fastest rule is determined. \
             Cross and dotted line: the shipped rule.",
        );
        page.figure(
            &format!("{}-rules.svg", file(&case.name)),
            figures::rules(found),
            "All other rules, each in its best form. Left: Gauss rules by order; right: equal steps by their number, and adaptive \
             Gauss-Kronrod by tolerance. Cross and dotted line: the shipped rule.",
        );
        same_nodes(page, found);
    }
    winner_table(page, results, Of::Integral);
}

/// The shipped rule compared with its own nodes in the common loop.
fn same_nodes(page: &mut Page, found: &IntegralFindings) {
    let Some((shipped, nodes)) = found.shipped().zip(found.shipped_nodes()) else { return };
    page.paragraph(&format!(
        "The shipped rule takes {} per separation with an error of {}; the same nodes in the loop used for all \
         rules ({}) take {} with an error of {}.",
        time(shipped.cost.seconds),
        number(shipped.cost.error),
        rule_name(&nodes.rule),
        time(nodes.cost.seconds),
        number(nodes.cost.error),
    ));
}

fn sums(page: &mut Page, results: &PrecisionResults) {
    page.heading(2, "The sum");
    let [from, to] = SEPARATIONS;
    page.paragraph(&format!(
        "Random sets of equal radii. Separations are spread evenly from {from} to {to} σ, {POINTS} of them on one thread \
         unless these are varied. Error: relative to the sum of the same terms in 32 digits, the largest over the \
         separations, of area and load. Times include ordering.",
    ));
    page.bullets([
        "*Naive*: one term after the other. *Chunks*: 4,096 terms at a time, then the chunks, so that threads can share \
         the work and the order is fixed. *Compensated*: the same with compensated summation. All evaluate the law \
         asperity by asperity.",
        "*Ordered*: asperities are sorted by height first, so that those below the flat are skipped; otherwise each \
         separation visits all of them.",
        "*Vectorised*: the deterministic model, compensated sums in vector registers, one separation at a time. \
         **Shipped**: the same for all separations at once, with blocks of asperities ordered by the separation of first \
         contact. Both also return regimes, contacts, stiffness and sampling errors.",
    ]);
    for case in results.cases.iter().filter(|case| !case.sums.is_empty()) {
        page.heading(3, &case.name);
        page.figure(
            &format!("{}-sums.svg", file(&case.name)),
            figures::sums(case),
            "Time per asperity and separation against the error (left; the number of asperities increases along each line) \
             and against the number of asperities (right). Dashed: all asperities are visited; solid: asperities are \
             ordered first.",
        );
        if case.sums.iter().any(|point| point.sweep == Sweep::Separations) {
            page.figure(
                &format!("{}-separations.svg", file(&case.name)),
                figures::separations(case),
                &format!(
                    "{} asperities: time per separation against the number of separations evaluated together, which share \
                     the ordering. A single separation is at 2 σ.",
                    count(ASPERITIES)
                ),
            );
        }
        let largest = largest_sums(&case.sums);
        let asperities = largest.first().map_or(0, |point| point.asperities);
        page.paragraph(&format!("{} asperities, one thread:", count(asperities)));
        page.table(
            ["method", "error", "in ulp", "time per separation", "per asperity"],
            largest.iter().map(|point| {
                vec![
                    point.way.name().to_owned(),
                    number(point.cost.error),
                    number(point.cost.error / f64::EPSILON),
                    time(point.cost.seconds),
                    time(point.cost.seconds / asperities as f64),
                ]
            }),
        );
        threads(page, case);
    }
    winner_table(page, results, Of::Sum);
}

fn threads(page: &mut Page, case: &CasePrecision) {
    let of_sweep = || case.sums.iter().filter(|point| point.sweep == Sweep::Threads);
    let Some(first) = of_sweep().next() else { return };
    let mut numbers: Vec<usize> = of_sweep().map(|point| point.threads).collect();
    numbers.dedup();
    page.paragraph(&format!(
        "{} asperities on several threads, time per separation:",
        count(first.asperities)
    ));
    let header = ["method".to_owned()].into_iter().chain(numbers.iter().map(|&n| thread_count(n)));
    page.table(
        header,
        Way::ALL.into_iter().filter(|way| of_sweep().any(|point| point.way == *way)).map(|way| {
            let at = |threads: &usize| {
                let point = of_sweep().find(|point| point.way == way && point.threads == *threads);
                point.map_or_else(String::new, |point| time(point.cost.seconds))
            };
            [way.name().to_owned()].into_iter().chain(numbers.iter().map(at)).collect::<Vec<_>>()
        }),
    );
}

/// A name of a case as part of a file name.
fn file(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '-' }).collect()
}
