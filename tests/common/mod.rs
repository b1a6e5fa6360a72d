//! Reading the reference vectors. Each test program uses a part of this.
#![allow(dead_code)]

use std::collections::HashMap;

/// One row of a reference file, by column name.
pub struct Row(HashMap<String, String>);

impl Row {
    pub fn text(&self, column: &str) -> &str {
        &self.0[column]
    }

    pub fn number(&self, column: &str) -> f64 {
        self.text(column).parse().unwrap_or_else(|_| panic!("{column} = {:?}", self.text(column)))
    }
}

/// All rows of `tests/reference/{name}.csv`.
pub fn rows(name: &str) -> Vec<Row> {
    let path = format!("{}/tests/reference/{name}.csv", env!("CARGO_MANIFEST_DIR"));
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path).unwrap();
    reader.deserialize().map(|row| Row(row.unwrap())).collect()
}

/// |found/exact - 1|, and 0 where both are 0.
pub fn relative_error(found: f64, exact: f64) -> f64 {
    if found == exact { 0.0 } else { ((found - exact) / exact).abs() }
}

/// Keeps the worst error seen and where it was.
#[derive(Default)]
pub struct Worst {
    error: f64,
    place: String,
    count: usize,
}

impl Worst {
    pub fn see(&mut self, found: f64, exact: f64, place: impl FnOnce() -> String) {
        let error = relative_error(found, exact);
        self.count += 1;
        if error.is_nan() || error > self.error {
            (self.error, self.place) = (error, format!("{}: found {found:e}, exact {exact:e}", place()));
        }
    }

    /// The worst relative error seen.
    pub fn error(&self) -> f64 {
        self.error
    }

    pub fn assert_within(&self, bound: f64, at_least: usize) {
        assert!(self.count >= at_least, "only {} comparisons", self.count);
        assert!(self.error <= bound, "relative error {:e} > {bound:e} at {}", self.error, self.place);
        println!("worst of {}: {:e} at {}", self.count, self.error, self.place);
    }
}
