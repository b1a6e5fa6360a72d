//! Running `[stability]`: cases checked by an evaluation of about 32 digits.

use std::time::Instant;

use super::plan::StabilityPlan;
use super::results::StabilityResults;
use crate::stability::{Group, check_group, maps};
use asperity::contact_law::registry;
use asperity::{ContactLaw, Paper, literature};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::metadata::Timing;

/// Papers on the layer.
const PAPERS: [Paper; 5] = [
    literature::PASARIBU_SCHIPPER_2005,
    literature::GAO_CHIU_LEE_1992,
    literature::SWAIN_MENCIK_1994,
    literature::SONG_PHARR_1999,
    literature::BHATTACHARYA_NIX_1988,
];

pub(super) fn run(context: &RunContext, plan: &StabilityPlan) -> StabilityResults {
    let start = Instant::now();
    context.progress.steps(Group::ALL.len() as u64 + 1);
    let seed = context.stream_seed("stability");
    let check = |group: Group| {
        let count = plan.counts.in_group(group);
        context.progress.stage(group.name(), count as f64);
        let results = check_group(group, count, seed, &plan.ranges, context.progress);
        context.progress.step();
        results
    };
    let groups = Group::ALL.map(check).to_vec();
    context.progress.stage("maps of the error", 1.0);
    let maps = maps(&plan.ranges, plan.cells, context.progress);
    context.progress.step();
    let papers = registry().iter().flat_map(ContactLaw::papers).chain(PAPERS).collect();
    let timing = Timing { total: start.elapsed(), ..Timing::default() };
    StabilityResults { metadata: context.metadata(papers, timing, None), groups, maps }
}
