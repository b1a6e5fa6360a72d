//! The page of `[stability]`: the largest errors, error maps, and the errors of every group and quantity.

use asperity_contact_framework::Outcome;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{capitalised, count, listed, one_digit};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};

use super::figures::{caption, error_map};
use super::results::StabilityResults;
use super::rows::{WorstRow, tables};
use crate::stability::{CheckKind, CoveredLaw, GroupResults, uncovered_heights};

impl Outcome for StabilityResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.groups.iter().filter_map(warning).collect()
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        page.lead(&answer(&self.groups));
        for map in &self.maps {
            page.figure(&format!("{}-errors.svg", map.name), error_map(map), caption(map));
        }
        sections::warnings(&mut page, &self.warnings());
        for kind in CheckKind::ALL.map(CheckKind::name) {
            page.details(2, &format!("{}: largest errors", capitalised(kind)), |page| {
                let groups = tables.view::<&GroupResults>().only("kind", kind);
                page.view(&groups.without(&["description", "not_finite", "within_bounds"]));
            });
        }
        page.details(2, "Groups of cases", |page| {
            page.view(&tables.view::<&GroupResults>().columns(&["kind", "group", "description"]));
        });
        page.details(2, "Sum: errors including the rounding of the separation", |page| {
            let sums = tables.view::<WorstRow>().only("kind", CheckKind::Sum.name());
            page.view(&sums.columns(&["group", "quantity", "worst_error", "plain_error"]));
        });
        sections::notes(&mut page, &self.metadata);
        page.heading(2, "Set-up");
        let [_, laws] = CoveredLaw::coverage();
        let method = "Method: [stability](../../docs/stability.md).".to_owned();
        let provenance = sections::provenance(&self.metadata);
        not_covered(laws, &uncovered_heights()).into_iter().chain([method, provenance]).for_each(
            |sentence| {
                page.paragraph(&sentence);
            },
        );
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }
}

/// The number of cases, whether all are within their bounds, and the largest error.
fn answer(groups: &[GroupResults]) -> String {
    let cases: u64 = groups.iter().map(|group| group.cases).sum();
    let cases = count(cases as usize);
    let verdict = match groups.iter().filter(|group| !group.is_within_bounds()).count() {
        0 => format!("All {cases} cases are within their error bounds"),
        beyond => format!("{beyond} of {} groups of cases are not within their error bounds", groups.len()),
    };
    let errors = groups
        .iter()
        .flat_map(|group| group.worst.iter().map(move |worst| (worst.largest, group.group.kind())));
    let largest = errors.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(error, kind)| {
        format!(" The largest relative error against 32 digits is {} ({}).", one_digit(error), kind.name())
    });
    format!("{verdict}.{}", largest.unwrap_or_default())
}

/// What is wrong first in a group.
fn warning(group: &GroupResults) -> Option<String> {
    let violations: Vec<_> = group.violations().collect();
    let (violation, case) = violations.first()?;
    let others = match violations.len() - 1 {
        0 => String::new(),
        others => format!(", and {others} more"),
    };
    Some(format!("{}, case {}: {violation}{others}", group.group.name(), case.index))
}

/// Laws and heights without an evaluation in 32 digits; `None` if there are none.
fn not_covered(laws: Vec<String>, heights: &[&str]) -> Option<String> {
    let heights = heights.iter().map(|name| format!("integrals over {name} heights"));
    let names: Vec<String> = laws.into_iter().map(|law| format!("law {law}")).chain(heights).collect();
    (!names.is_empty())
        .then(|| format!("Not covered, because there is no evaluation in 32 digits: {}.", listed(&names)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::{Group, Ranges, check_group};
    use asperity::progress::Silent;

    #[test]
    fn errors_beyond_a_bound_are_reported() {
        let group = |group| check_group(group, 3, [1; 32], &Ranges::default(), &Silent);
        let mut groups = [group(Group::Contacts), group(Group::Integrals)];
        let lead = answer(&groups);
        assert!(
            lead.starts_with("All 6 cases are within their error bounds. The largest relative error against"),
            "{lead}"
        );
        assert_eq!(groups.iter().find_map(warning), None);
        groups[1].worst[0].checked = 0.02;
        groups[1].worst[0].largest = 0.03;
        let lead = answer(&groups);
        assert!(lead.starts_with("1 of 2 groups of cases are not within their error bounds."), "{lead}");
        assert!(lead.ends_with("32 digits is 3e-2 (integral)."), "{lead}");
        let warning = warning(&groups[1]).unwrap();
        assert!(warning.starts_with("any integral, case "), "{warning}");
        assert!(warning.ends_with(": error of 2.0e-2 in area, beyond the bound of 1.0e-13"), "{warning}");
    }

    #[test]
    fn what_has_no_reference_is_named() {
        assert_eq!(not_covered(Vec::new(), &[]), None);
        let names = not_covered(vec!["x".into()], &["weibull"]).unwrap();
        assert!(names.ends_with("32 digits: law x and integrals over weibull heights."), "{names}");
    }
}
