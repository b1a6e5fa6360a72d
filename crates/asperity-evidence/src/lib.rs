//! Programs that prove what the library claims, each with its constants at the top: `[evidence]` of a spec names one.
//!
//! | module | what it proves |
//! |---|---|
//! | [`coverage`] | how often 95 % intervals hold the truth, of large maps and of small ones |
//! | [`solver`] | boundary elements against known solutions, and the bounds of their errors by the grid |
//! | [`stability`] | `f64` against an evaluation of 32 digits ([`exact`], in the arithmetic of [`wide`]) |
//! | [`precision`] | run time against error |
#![deny(unsafe_code)]

pub mod coverage;
pub mod exact;
pub mod precision;
pub mod solver;
pub mod stability;
pub mod wide;

use std::error::Error;
use std::fmt;
use std::time::Instant;

use asperity::Paper;
use asperity::numeric::stream_seed;
use asperity::progress::Progress;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::metadata::{Metadata, Timing};
use asperity_contact_framework::report::Page;
use asperity_contact_framework::report::format::capitalised;
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Schema, Table, Tables};
use asperity_contact_framework::{Group, Kind, Memory, Outcome, Plan, Reads, RunContext};
use asperity_plot::Figure;
use schemars::JsonSchema;
use serde::Deserialize;

pub const PROGRAMS: [Program; 6] = [
    coverage::COVERAGE,
    coverage::COVERAGE_OF_SMALL_MAPS,
    solver::GRID_BOUNDS,
    precision::PRECISION,
    solver::SOLVER_VALIDATION,
    stability::STABILITY,
];

/// What keeps a program from its end.
pub type Failed = Box<dyn Error + Send + Sync>;

/// A program that `[evidence]` names.
#[derive(Debug, Clone, Copy)]
pub struct Program {
    pub name: &'static str,
    /// The short one, and the full one.
    pub forms: [Form; 2],
    pub tables: fn() -> Vec<Schema>,
    pub run: fn(&Task) -> Result<Evidence, Failed>,
}

/// What one form of a program does, and about what it needs.
#[derive(Debug, Clone, Copy)]
pub struct Form {
    pub about: &'static str,
    /// Memory at its peak.
    pub bytes: f64,
    /// Micro-contacts that take about as long.
    pub contacts: f64,
}

impl Form {
    pub const fn new(about: &'static str, bytes: f64, contacts: f64) -> Self {
        Self { about, bytes, contacts }
    }
}

pub struct Task<'a> {
    pub is_full: bool,
    pub seed: u64,
    pub progress: &'a dyn Progress,
}

impl Task<'_> {
    pub fn stream_seed(&self, what: &str) -> [u8; 32] {
        stream_seed(self.seed, what)
    }
}

#[derive(Debug, Default)]
pub struct Evidence {
    /// The first sentences of the page.
    pub claim: String,
    pub warnings: Vec<String>,
    /// The first is that of the claim.
    pub drawings: Vec<Drawing>,
    pub tables: Vec<Table>,
    /// A file that the page does not show.
    pub hidden: &'static str,
    /// Paragraphs on what was run.
    pub set_up: Vec<String>,
    pub papers: Vec<Paper>,
}

#[derive(Debug)]
pub struct Drawing {
    pub file: &'static str,
    pub figure: Figure,
    pub caption: String,
}

pub struct EvidenceKind;

/// A program that proves what Asperity claims of itself.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EvidenceSpec {
    /// The program: coverage, coverage-of-small-maps, grid-bounds, precision, solver-validation or stability.
    #[schemars(extend("examples" = ["stability"]))]
    pub name: Spanned<String>,
    /// Whether it runs in full or in its short form.
    pub full: bool,
}

/// A program in one of its forms.
#[derive(Debug, Clone, Copy)]
pub struct EvidencePlan {
    program: Program,
    form: Form,
    is_full: bool,
}

impl fmt::Display for EvidencePlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "  {}: {}", self.program.name, self.form.about)
    }
}

impl Kind for EvidenceKind {
    const NAME: &'static str = "evidence";
    const GROUP: Option<Group> = Some(Group::Trust);
    const READS: Reads = Reads { materials: false, surfaces: false };
    type Spec = EvidenceSpec;
    type Plan = EvidencePlan;

    fn plan(file: &SpecFile, table: &Spanned<EvidenceSpec>) -> Result<EvidencePlan, InputError> {
        let EvidenceSpec { name, full } = table.get_ref();
        let program = PROGRAMS.into_iter().find(|program| program.name == name.get_ref());
        let program = program.ok_or_else(|| {
            let allowed = PROGRAMS.map(|program| program.name).join(", ");
            file.source.error_at(name.span(), format!("found \"{}\"; allowed: {allowed}", name.get_ref()))
        })?;
        Ok(EvidencePlan { program, form: program.forms[usize::from(*full)], is_full: *full })
    }

    fn tables() -> Vec<Schema> {
        let mut tables: Vec<Schema> = Vec::new();
        for schema in PROGRAMS.iter().flat_map(|program| (program.tables)()) {
            if tables.iter().all(|table| table.file != schema.file) {
                tables.push(schema);
            }
        }
        tables
    }
}

impl Plan for EvidencePlan {
    fn memory(&self) -> Memory {
        Memory { bytes: self.form.bytes as u128, key: None }
    }

    fn work(&self) -> u128 {
        self.form.contacts as u128
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        let start = Instant::now();
        let task = Task { is_full: self.is_full, seed: context.seed, progress: context.progress };
        let evidence =
            (self.program.run)(&task).map_err(|error| InputError::file(&context.source.path, error))?;
        let timing = Timing { total: start.elapsed(), ..Timing::default() };
        let metadata = context.metadata(evidence.papers.clone(), timing, None);
        Ok(Box::new(EvidenceResults { metadata, evidence }))
    }
}

/// What a program has found, as a report.
#[derive(Debug)]
pub struct EvidenceResults {
    metadata: Metadata,
    evidence: Evidence,
}

impl Outcome for EvidenceResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.evidence.warnings.clone()
    }

    fn tables(&self) -> Vec<Table> {
        self.evidence.tables.iter().filter(|table| table.rows() > 0).cloned().collect()
    }

    fn page(&self, tables: &Tables) -> Page {
        let Evidence { claim, warnings, drawings, hidden, set_up, .. } = &self.evidence;
        let mut page = Page::new(&self.metadata.title);
        page.lead(claim);
        for Drawing { file, figure, caption } in drawings {
            page.figure(file, figure.clone(), caption);
        }
        sections::warnings(&mut page, warnings);
        for table in tables.iter().filter(|table| table.schema.file != *hidden && !table.schema.is_long) {
            let title = table.schema.file.trim_end_matches(".csv").replace(['-', '_'], " ");
            page.details(2, &capitalised(&title), |page| {
                page.view(&table.view());
            });
        }
        sections::notes(&mut page, &self.metadata);
        page.details(2, "Set-up", |page| {
            for paragraph in set_up.iter().chain([&sections::provenance(&self.metadata)]) {
                page.paragraph(paragraph);
            }
        });
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }
}
