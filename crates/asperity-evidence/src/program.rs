//! What every program has: two forms, and what it hands to the report.

use std::error::Error;

use asperity::Paper;
use asperity::numeric::stream_seed;
use asperity::progress::Progress;
use asperity_contact_framework::report::table::{Schema, Table};
use asperity_plot::Figure;

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

/// What a program is run with.
pub struct Task<'a> {
    pub is_full: bool,
    pub seed: u64,
    pub progress: &'a dyn Progress,
}

impl Task<'_> {
    /// The seed of one stream of random numbers.
    pub fn stream_seed(&self, what: &str) -> [u8; 32] {
        stream_seed(self.seed, what)
    }
}

/// What a program has found.
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
