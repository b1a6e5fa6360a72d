//! Running `[stability]`: cases checked by an evaluation of about 32 digits.

use std::time::Instant;

use super::findings::KindFindings;
use super::plan::StabilityPlan;
use crate::stability::{CoveredLaw, Failure, Group, GroupFindings, Map, group, maps};
use asperity::contact_law::registry;
use asperity::{ContactLaw, Paper, literature};
use asperity_framework::RunContext;
use asperity_framework::metadata::{Metadata, Timing};

/// What became of the cases.
#[derive(Debug)]
pub struct StabilityResults {
    /// What every experiment has.
    pub metadata: Metadata,
    pub groups: Vec<GroupFindings>,
    /// Laws that no case is under: their equations are not known in extended precision.
    pub not_covered: Vec<String>,
    /// Errors over planes.
    pub maps: Vec<Map>,
    /// Kind by kind, of those that have cases.
    pub kinds: Vec<KindFindings>,
}

impl StabilityResults {
    /// Scenes that were checked.
    pub fn cases(&self) -> u64 {
        self.groups.iter().map(|findings| findings.cases).sum()
    }

    /// Cases that are not right, or not checked.
    pub fn failures(&self) -> usize {
        self.groups.iter().map(|findings| findings.failures.len()).sum()
    }

    /// Of these, cases with a NaN or an infinity.
    pub fn not_finite(&self) -> usize {
        let failures = self.groups.iter().flat_map(|findings| &findings.failures);
        failures.filter(|(_, failure)| matches!(failure, Failure::NotFinite(_))).count()
    }

    /// Groups with a quantity beyond its bound.
    pub fn beyond(&self) -> impl Iterator<Item = &GroupFindings> {
        self.groups.iter().filter(|findings| !findings.holds())
    }

    /// What went wrong, a line each.
    pub fn warnings(&self) -> Vec<String> {
        let beyond = self.beyond().map(|findings| {
            format!("{} ({}): beyond its bound", findings.group.name(), findings.group.kind().name())
        });
        let failures = self.groups.iter().flat_map(|findings| {
            let told = findings.failures.first();
            told.map(|(case, failure)| {
                let others = findings.failures.len() - 1;
                format!(
                    "{}, case {}: {failure}{}",
                    findings.group.name(),
                    case.index,
                    if others > 0 { format!(", and {others} more") } else { String::new() }
                )
            })
        });
        beyond.chain(failures).collect()
    }
}

/// Those of the layer.
const PAPERS: [Paper; 5] = [
    literature::PASARIBU_SCHIPPER_2005,
    literature::GAO_CHIU_LEE_1992,
    literature::SWAIN_MENCIK_1994,
    literature::SONG_PHARR_1999,
    literature::BHATTACHARYA_NIX_1988,
];

pub(super) fn run(context: &RunContext, stability: &StabilityPlan) -> StabilityResults {
    let start = Instant::now();
    context.progress.steps(Group::ALL.len() as u64 + 1);
    let seed = context.stream_seed("stability");
    let judge = |of: Group| {
        let count = stability.counts.of(of);
        context.progress.stage(of.name(), count as f64);
        let findings = group(of, count, seed, &stability.ranges, context.progress);
        context.progress.step();
        findings
    };
    let groups = Group::ALL.map(judge).to_vec();
    let kinds = KindFindings::of_all(&groups);
    context.progress.stage("maps of the error", 1.0);
    let maps = maps(&stability.ranges, stability.cells, context.progress);
    context.progress.step();
    let papers = registry().iter().flat_map(ContactLaw::papers).chain(PAPERS);
    let timing = Timing { total: start.elapsed(), ..Timing::default() };
    let [_, not_covered] = CoveredLaw::coverage();
    let metadata = context.metadata(papers.collect(), timing, None);
    StabilityResults { metadata, not_covered, groups, maps, kinds }
}
