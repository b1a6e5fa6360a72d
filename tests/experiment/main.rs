//! Tests of the program: specs in, reports out, and the command line. One program, so that it is linked once.

/// Tables of specs that many tests share, as literals for `concat!`.
macro_rules! steel {
    () => {
        "[material.steel]\nyoung = \"210 GPa\"\npoisson = 0.3\nhardness = \"7.6 GPa\"\n"
    };
}
macro_rules! lead {
    () => {
        "[material.lead]\nyoung = \"18 GPa\"\npoisson = 0.35\nhardness = \"0.17 GPa\"\n"
    };
}
/// Both with what they conduct.
macro_rules! conducting {
    () => {
        concat!(
            steel!(),
            "resistivity = \"143 nohm m\"\nthermal-conductivity = \"50 W/(m K)\"\n",
            lead!(),
            "resistivity = \"206 nohm m\"\nthermal-conductivity = \"35 W/(m K)\"\n"
        )
    };
}
/// The population of the paper's case 1.
macro_rules! case_1 {
    () => {
        "radius = \"20 um\"\nsigma = \"48 nm\"\ndensity = \"6e10 /m^2\"\n"
    };
}

/// A generated surface of self-affine waves down from a roll-off to a cut-off.
macro_rules! generated {
    ($name:literal, $points:literal, $pixel:literal, $sigma:literal, $roll_off:literal to $cut_off:literal) => {
        concat!(
            concat!("[surface.", $name, ".generate]\npoints = ", $points, "\npixel = \"", $pixel, "\"\n"),
            concat!("sigma = \"", $sigma, "\"\nspectrum.self-affine = { hurst = 0.8, "),
            concat!("roll-off = \"", $roll_off, "\", cut-off = \"", $cut_off, "\" }\n")
        )
    };
}

mod attribution;
mod bad_specs;
mod causes;
mod caveats;
mod cli;
mod columns;
#[path = "../../crates/asperity/tests/library/common.rs"]
mod common;
mod figures;
mod fitness;
mod in_memory;
mod indentation;
mod keys;
mod layer_on_rough;
mod layers;
mod limit;
mod lists;
mod main_figure;
mod materials;
mod pairs;
mod progress;
mod ranking;
mod readings;
mod reference;
mod registry;
mod remedies;
mod results;
mod sampling_interval;
mod single_load;
mod spots;
mod sweep;
mod tiled;
mod tip;
mod tutorial;
mod verdicts;
mod work;

/// Results of a run, which is a `T`.
fn downcast<T: std::any::Any>(outcome: Box<dyn asperity_contact_framework::Outcome>) -> T {
    *(outcome as Box<dyn std::any::Any>).downcast().expect("the results of this kind")
}

/// A report before it is written.
trait Report {
    /// The page.
    fn outline(&self) -> asperity_contact_framework::report::Page;

    /// `summary.json`.
    fn records(&self) -> serde_json::Map<String, serde_json::Value>;

    /// Names and contents of the tables.
    fn files(&self) -> Vec<(&'static str, Vec<u8>)>;
}

impl Report for dyn asperity_contact_framework::Outcome {
    fn outline(&self) -> asperity_contact_framework::report::Page {
        self.page(&asperity_contact_framework::report::table::Tables::new(self.tables()))
    }

    fn records(&self) -> serde_json::Map<String, serde_json::Value> {
        let tables = asperity_contact_framework::report::table::Tables::new(self.tables());
        let summary =
            asperity_contact_framework::summary_json(self, &tables).expect("results have a summary");
        serde_json::from_slice(&summary).expect("a summary is an object")
    }

    fn files(&self) -> Vec<(&'static str, Vec<u8>)> {
        let tables = self.tables();
        tables.iter().map(|table| (table.schema.file, table.csv().expect("cells are CSV"))).collect()
    }
}
