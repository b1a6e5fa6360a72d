//! The page of `[solver-validation]`: a summary, then each problem with its figure and table.

mod figures;
mod summary;

use super::findings::{AreaOf, Deviation, LOWEST_ORDER, MOST_SAMPLING, fitted_order};
use super::run::SolverResults;
use crate::solver::ensemble::EnsembleFindings;
use crate::solver::published::{ENSEMBLE, RMS_HEIGHT, WAVE_NUMBERS, published};
use crate::solver::work::POINTS_PER_WAVE;
use crate::solver::{DUAL_GAP, Measured, Problem, Quantity};
use asperity_framework::report::format::{
    input_number, input_quantity, listed, mean_and_deviation, number, percent, quantity, ratio,
};
use asperity_framework::report::page::Page;
use asperity_framework::report::sections;
use summary::{area_name, at_finest, pixels, rounding};

pub fn page(results: &SolverResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    sections::findings(&mut page, summary::lines(results));
    sections::warnings(&mut page, &results.warnings());
    hertz(&mut page, results);
    sinusoid(&mut page, results);
    layered(&mut page, results);
    if let Some(found) = &results.ensemble {
        ensemble(&mut page, results, found);
    }
    work(&mut page, results);
    page.heading(2, "Method");
    page.bullets(method(results));
    sections::notes(&mut page, &results.metadata);
    page.paragraph(&sections::provenance(&results.metadata));
    sections::run_again(&mut page, &results.metadata, None);
    sections::sources(&mut page, &results.metadata);
    page
}

fn of_problem(results: &SolverResults, problem: Problem) -> Vec<&Measured> {
    results.measured.iter().filter(|one| one.problem == problem).collect()
}

/// Resolutions by quantities: the largest error over the cases.
fn errors(page: &mut Page, all: &[&Measured], resolution: &str) {
    let mut points: Vec<usize> = all.iter().map(|one| one.points).collect();
    points.sort_unstable();
    points.dedup();
    let mut quantities: Vec<Quantity> = Vec::new();
    for one in all {
        if !quantities.contains(&one.quantity) {
            quantities.push(one.quantity);
        }
    }
    let mut header = vec![resolution];
    header.extend(quantities.iter().map(|quantity| quantity.words()));
    page.table(
        header,
        points.into_iter().map(|points| {
            let largest = |quantity: &Quantity| {
                let errors = all
                    .iter()
                    .filter(|one| one.points == points && one.quantity == *quantity)
                    .map(|one| one.error);
                errors.max_by(|a, b| a.abs().total_cmp(&b.abs())).map_or_else(String::new, number)
            };
            [points.to_string()].into_iter().chain(quantities.iter().map(largest)).collect::<Vec<_>>()
        }),
    );
}

fn hertz(page: &mut Page, results: &SolverResults) {
    let all = of_problem(results, Problem::Hertz);
    let Some(profile) = &results.hertz_profile else { return };
    page.heading(2, "Hertz");
    page.paragraph(
        "A paraboloid on a half-space, its tip between the points of the grid; nothing repeats (`finite`). Relative errors; of the \
         pressures the r.m.s. error over the r.m.s. pressure.",
    );
    let order = match results.findings.order {
        Some(order) if order >= LOWEST_ORDER => {
            format!("The indentation converges with order {}", ratio(order))
        }
        Some(order) => format!("The indentation converges with order {} only", ratio(order)),
        None => "Errors of Hertz's contact".to_owned(),
    };
    let caption = format!(
        "{order}. Left: pressure of each pixel ({}) over Hertz's peak p₀. Right: errors against resolution, with lines of orders 1 \
         and 2.",
        profile.case
    );
    page.figure("hertz.svg", figures::hertz(&results.measured, profile), &caption);
    errors(page, &all, "pixels per contact radius");
}

fn sinusoid(page: &mut Page, results: &SolverResults) {
    let all = of_problem(results, Problem::Sinusoid);
    if all.is_empty() {
        return;
    }
    page.heading(2, "Wavy surface");
    page.paragraph(
        "Heights h cos(2π x/λ), periodic. Exact: sin²(π a/λ) = p/p*, with the half width a of the contact and p* = π E* h/λ, which closes \
         the gap; p(x) = 2 p cos ψ (sin²ψₐ − sin²ψ)^½/sin²ψₐ, ψ = π x/λ; mean gap h (cos²ψₐ + 2 sin²ψₐ ln sin ψₐ). The table has the largest \
         error over the loads: of the width over the wavelength (mean over places of the crest between two points), of the gap over h, \
         of the pressures r.m.s. over r.m.s.",
    );
    let orders = [
        (Quantity::Area, "the width"),
        (Quantity::Pressures, "the pressures"),
        (Quantity::MeanGap, "the mean gap"),
    ];
    let orders: Vec<String> = orders
        .into_iter()
        .filter_map(|(quantity, name)| {
            let order = fitted_order(&results.measured, Problem::Sinusoid, quantity)?;
            Some(format!("{name} with order {}", ratio(order)))
        })
        .collect();
    let finding = match orders.as_slice() {
        [] => "Errors on a wave.".to_owned(),
        orders => format!("Convergence: {}.", listed(orders)),
    };
    let caption = format!(
        "{finding} Left: pressures (points) and the exact ones (lines) over their maximum in full contact. Right: the largest errors \
         over the loads, with lines of orders 1 and 2."
    );
    page.figure("sinusoid.svg", figures::sinusoid(&results.measured, &results.wave_profiles), &caption);
    errors(page, &all, "points per wavelength");
    let full = of_problem(results, Problem::FullContact);
    page.paragraph(
        "Full contact of a product of waves: the pressure has the amplitude of the height over the compliance of the wave. Largest error \
         over this amplitude:",
    );
    page.table(["flat", "error"], full.iter().map(|one| vec![one.case.clone(), rounding(one.error)]));
}

fn layered(page: &mut Page, results: &SolverResults) {
    let all = of_problem(results, Problem::LayeredSphere);
    let Some(worst) = at_finest(&all, Quantity::Indentation) else { return };
    page.heading(2, "Sphere on a bonded layer");
    page.paragraph(&format!(
        "A rigid sphere on a layer bonded to a half-space, against the exact solution of the library (relative error 1e-12), at {} pixels \
         per contact radius under the exact load.",
        worst.points
    ));
    let caption = format!(
        "Indentations are within {} of the exact ones. By Young's modulus of the layer on that of the substrate (any one unit; lead on \
         steel: 18 on 210).",
        number(worst.error.abs())
    );
    page.figure("layered-sphere.svg", figures::layered(&results.measured), &caption);
    let of = |case: &str, quantity: Quantity| {
        let found = all.iter().find(|one| one.case == case && one.quantity == quantity);
        found.map_or_else(String::new, |one| number(one.error))
    };
    let cases = all.iter().filter(|one| one.quantity == Quantity::Indentation).map(|one| one.case.as_str());
    page.table(
        ["E of layer on E of substrate", "indentation", "area by counting points", "corrected area"],
        cases.map(|case| {
            let quantities = [Quantity::Indentation, Quantity::RawArea, Quantity::Area];
            [case.to_owned()]
                .into_iter()
                .chain(quantities.map(|quantity| of(case, quantity)))
                .collect::<Vec<_>>()
        }),
    );
}

fn ensemble(page: &mut Page, results: &SolverResults, found: &EnsembleFindings) {
    page.heading(2, "Published ensemble");
    let [longest, shortest] = [ENSEMBLE.roll_off, ENSEMBLE.cut_off].map(|length| quantity(length, "m"));
    page.paragraph(&format!(
        "Self-affine surfaces of wave numbers {} to {} rad/m (wavelengths {longest} to {shortest}), Hurst exponent {}, on a periodic square \
         of one longest wavelength. Waves have random phases and Gaussian random amplitudes; each surface is then scaled to the r.m.s. \
         gradient g = {} of the publication, computed from its waves. The r.m.s. height becomes {} ± {} (standard error over {} surfaces; \
         published: {}). The published amplitudes seem not to be random, and domain, grid and number of surfaces are not published.",
        number(WAVE_NUMBERS[0]),
        number(WAVE_NUMBERS[1]),
        ENSEMBLE.hurst,
        ENSEMBLE.gradient,
        quantity(found.height.mean, "m"),
        quantity(found.height.error, "m"),
        found.realisations,
        input_quantity(RMS_HEIGHT, "m"),
    ));
    let farthest = results.findings.farthest().map_or_else(
        || "Areas of the ensemble beside the published ones.".to_owned(),
        |one| {
            format!(
                "Extrapolated areas are within {} of the published ones.",
                percent(one.difference.mean.abs())
            )
        },
    );
    let apart = finest_apart(found).map_or_else(String::new, |[raw, corrected]| {
        format!(
            " On the finest grid raw areas differ by up to {} from the extrapolated ones, corrected areas by up to {}.",
            percent(raw),
            percent(corrected)
        )
    });
    let caption =
        format!("{farthest}{apart} Above: area against pressure. Below: difference from the published area.");
    page.figure("ensemble.svg", figures::ensemble(found), &caption);
    areas(page, found);
    deviations(page, results);
    if results.findings.kappa.is_empty() {
        return;
    }
    page.heading(3, "Proportionality at light loads");
    page.figure(
        "kappa.svg",
        figures::kappa(found, &results.findings),
        "κ, the area over the reduced pressure, beside two theories: each gives a constant at vanishing load, Persson's also a curve for all \
         loads.",
    );
    page.table(
        ["p/(E* g)", "κ", "standard error"],
        results
            .findings
            .kappa
            .iter()
            .map(|(at, kappa)| vec![number(*at), ratio(kappa.mean), number(kappa.error)]),
    );
}

/// The largest relative differences of raw and corrected areas on the finest grid from the extrapolated ones.
fn finest_apart(found: &EnsembleFindings) -> Option<[f64; 2]> {
    let finest = found.points.iter().map(|point| point.points).max()?;
    let of_finest = found.points.iter().filter(|point| point.points == finest);
    of_finest.zip(&found.extrapolated).fold(None, |largest, (point, limit)| {
        let apart = [point.raw_area, point.area].map(|area| (area.mean / limit.raw_area.mean - 1.0).abs());
        let [raw, corrected] = largest.unwrap_or([0.0; 2]);
        Some([apart[0].max(raw), apart[1].max(corrected)])
    })
}

/// Grids by pressure.
fn areas(page: &mut Page, found: &EnsembleFindings) {
    let mut grids: Vec<usize> = found.points.iter().map(|point| point.points).collect();
    grids.dedup();
    let mut pressures: Vec<f64> = found.points.iter().map(|point| point.pressure).collect();
    pressures.sort_by(f64::total_cmp);
    pressures.dedup();
    let mut header = vec!["p/E*".to_owned()];
    header.extend(grids.iter().flat_map(|grid| [format!("raw, {grid}"), format!("corrected, {grid}")]));
    header.extend(["extrapolated", "published", "earlier file", "mean gap/r.m.s. height"].map(str::to_owned));
    let at = |grid: usize, pressure: f64| {
        found.points.iter().find(move |point| point.points == grid && point.pressure == pressure)
    };
    let row = |pressure: f64| {
        let mut row = vec![input_number(pressure)];
        for &grid in &grids {
            let point = at(grid, pressure);
            row.push(point.map_or_else(String::new, |point| number(point.raw_area.mean)));
            row.push(point.map_or_else(String::new, |point| number(point.area.mean)));
        }
        let limit = found.extrapolated.iter().find(|at| at.pressure == pressure);
        row.push(
            limit.map_or_else(String::new, |at| mean_and_deviation(at.raw_area.mean, at.raw_area.error)),
        );
        let listed = published(pressure);
        row.push(listed.map_or_else(String::new, |row| mean_and_deviation(row.area, row.deviation)));
        row.push(listed.and_then(|row| row.earlier).map_or_else(String::new, number));
        let gap = grids.last().and_then(|&grid| at(grid, pressure));
        row.push(gap.map_or_else(String::new, |point| mean_and_deviation(point.gap.mean, point.gap.error)));
        row
    };
    page.paragraph(
        "Area ratios by points along a side; ± is the standard error over the surfaces, of the published areas their standard deviation:",
    );
    page.table(header, pressures.into_iter().map(row));
}

fn deviations(page: &mut Page, results: &SolverResults) {
    if results.findings.deviations.is_empty() {
        return;
    }
    page.paragraph(&format!(
        "R.m.s. relative difference from the published areas and from those of the earlier file, over the loads at which the standard \
         error of the area is at most {} on every grid, the smallest first; the last column counts all loads. At lighter loads the \
         scatter of the surfaces is as large as the effect of the grid.",
        percent(MOST_SAMPLING)
    ));
    let row = |deviation: &Deviation| {
        let per_wave = match deviation.of {
            AreaOf::Raw(points) | AreaOf::Corrected(points) => number(pixels(points)),
            AreaOf::Extrapolated => "∞".to_owned(),
        };
        vec![
            area_name(deviation.of),
            per_wave,
            percent(deviation.published),
            deviation.earlier.map_or_else(String::new, percent),
            percent(deviation.at_all_loads),
        ]
    };
    page.table(
        ["area", "points per shortest wave", "published", "earlier file", "published, all loads"],
        results.findings.deviations.iter().map(row),
    );
}

fn work(page: &mut Page, results: &SolverResults) {
    if results.work.is_empty() {
        return;
    }
    page.heading(2, "Work");
    page.paragraph(&format!(
        "Periodic self-affine surfaces with waves from the side of the map to {} points, solved to a dual gap of {} from the solution on a \
         grid of half the points. Convolutions take nearly all of the time; they are counted on the finest grid.",
        number(POINTS_PER_WAVE),
        number(results.work_error.unwrap_or(DUAL_GAP))
    ));
    let growth: Vec<String> = results
        .findings
        .growth
        .iter()
        .map(|(pressure, fit)| format!("{} at p/(E* g) = {}", ratio(fit.slope), number(*pressure)))
        .collect();
    let caption = if growth.is_empty() {
        "Convolutions against points.".to_owned()
    } else {
        format!("Convolutions grow with the points along a side to the power {}.", growth.join(", "))
    };
    page.figure("work.svg", figures::work(&results.work), &caption);
    page.table(
        ["points", "p/(E* g)", "corrected area", "steps", "convolutions", "dual gap"],
        results.work.iter().map(|point| {
            vec![
                format!("{} x {}", point.points, point.points),
                number(point.pressure),
                percent(point.area),
                point.steps.to_string(),
                point.convolutions.to_string(),
                number(point.error),
            ]
        }),
    );
}

fn method(results: &SolverResults) -> Vec<String> {
    let mut lines = vec![
        format!(
            "Contacts with a known solution are solved to a relative dual gap of {DUAL_GAP:e}: their errors are those of the discretisation."
        ),
        "Areas are corrected by (π − 1 + ln 2)/24 of a pixel for each side of a pixel on the border of the contact (Yastrebov, Anciaux and \
         Molinari 2017)."
            .to_owned(),
    ];
    if results.ensemble.is_some() {
        lines.push(
            "Areas are extrapolated linearly in the pixel from the two finest grids, surface by surface: all grids hold the same surfaces."
                .to_owned(),
        );
        lines.push(
            "Pressures of the publication are over E* = 1, not over E* g: κ at the lightest published load is then 2.4; over E* g it \
             would be 8.6, which no theory gives."
                .to_owned(),
        );
        lines.push(
            "Three further publications are not compared with, since of them only abstracts and introductions could be read, without figures: Yastrebov, Anciaux and \
             Molinari (J. Mech. Phys. Solids 107, 2017, 469; arXiv 1704.05650), by which the area at a given p/(E* g) decreases with \
             the logarithm of Nayak's α; Prodanov, Dapp and Müser (Tribol. Lett. 53, 2014, 433), by which it hardly depends on the Hurst \
             exponent; and the contact-mechanics challenge (Müser et al. 2017; problem: arXiv 1512.02403), whose surfaces adhere."
                .to_owned(),
        );
    }
    lines
}
