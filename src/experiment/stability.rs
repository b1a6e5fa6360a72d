//! Running `[stability]`: scenes judged by an evaluation of about 32 digits.

use std::time::Instant;

use super::plan::{Plan, StabilityPlan};
use super::progress::Progress;
use super::results::{Head, Timing};
use super::run::head;
use super::stream_seed;
use crate::stability::{Family, FamilyFindings, Map, family, maps};
use asperity::literature::{self, Paper};

/// What became of the scenes.
#[derive(Debug)]
pub struct StabilityResults {
    /// What every experiment has.
    pub head: Head,
    /// What was judged.
    pub plan: StabilityPlan,
    /// Family by family.
    pub families: Vec<FamilyFindings>,
    /// Errors over planes.
    pub maps: Vec<Map>,
}

impl StabilityResults {
    /// Scenes that were judged.
    pub fn scenes(&self) -> u64 {
        self.families.iter().map(|findings| findings.scenes).sum()
    }

    /// Families with a quantity beyond its bound.
    pub fn beyond(&self) -> impl Iterator<Item = &FamilyFindings> {
        self.families.iter().filter(|findings| !findings.holds())
    }

    /// What went wrong, a line each.
    pub fn warnings(&self) -> Vec<String> {
        let beyond = self.beyond().map(|findings| {
            format!("{} ({}): beyond its bound", findings.family.name(), findings.family.kind().name())
        });
        let faults = self.families.iter().flat_map(|findings| {
            let told = findings.faults.first();
            told.map(|(scene, fault)| {
                let others = findings.faults.len() - 1;
                format!(
                    "{}, scene {}: {fault}{}",
                    findings.family.name(),
                    scene.index,
                    if others > 0 { format!(", and {others} more") } else { String::new() }
                )
            })
        });
        beyond.chain(faults).collect()
    }
}

/// Those of all laws and of the layer.
const PAPERS: [Paper; 12] = [
    literature::GREENWOOD_WILLIAMSON_1966,
    literature::ZHAO_MAIETTA_CHANG_2000,
    literature::PASARIBU_SCHIPPER_2005,
    literature::CHANG_ETSION_BOGY_1987,
    literature::KOGUT_ETSION_2002,
    literature::JACKSON_GREEN_2005,
    literature::ABBOTT_FIRESTONE_1933,
    literature::JOHNSON_1985,
    literature::GAO_CHIU_LEE_1992,
    literature::SWAIN_MENCIK_1994,
    literature::SONG_PHARR_1999,
    literature::BHATTACHARYA_NIX_1988,
];

pub(super) fn run(plan: &Plan, stability: &StabilityPlan, progress: &dyn Progress) -> StabilityResults {
    let start = Instant::now();
    progress.stage(&plan.title, Family::ALL.len() as u64 + 1);
    let seed = stream_seed(plan.seed, "stability");
    let judge = |of: Family| {
        let findings = family(of, stability.counts.of(of), seed, &stability.ranges);
        progress.advance(1);
        findings
    };
    let families = Family::ALL.map(judge).to_vec();
    let maps = maps(&stability.ranges, stability.cells);
    progress.advance(1);
    let timing = Timing { total: start.elapsed(), ..Timing::default() };
    StabilityResults { head: head(plan, PAPERS.to_vec(), timing, None), plan: *stability, families, maps }
}
