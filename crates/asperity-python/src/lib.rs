//! The Python package: arrays in without a copy, tables out; the models, surfaces and specs are those of the other
//! crates.
#![warn(missing_docs)]

mod array;
mod asperities;
mod interface;
mod models;
mod quantity;
mod spec;
mod surface;
mod table;
mod watch;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A `ValueError` with the library's message.
fn refuse(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

#[pymodule]
mod _asperity {
    #[pymodule_export]
    use crate::asperities::{Asperities, Population};
    #[pymodule_export]
    use crate::interface::{Interface, Law, Material};
    #[pymodule_export]
    use crate::models::{deterministic, statistical};
    #[pymodule_export]
    use crate::quantity::si_of_kind;
    #[pymodule_export]
    use crate::spec::{
        Run, in_arguments, key, read_spec, register_bits, results_of_tasks, run, run_task, tasks, variations,
    };
    #[pymodule_export]
    use crate::surface::{Map, Surface, length_unit, make_surface};
    #[pymodule_export]
    use crate::table::Table;

    #[pymodule_export]
    #[allow(non_upper_case_globals)]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
