//! The page.

use super::results::IntervalResults;
use asperity_framework::report::page::Page;

pub fn page(results: &IntervalResults) -> Page {
    Page::new(&results.metadata.title)
}
