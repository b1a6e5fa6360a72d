//! Arrays of NumPy, read where they lie.

use std::sync::Arc;

use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::refuse;

/// Numbers of a NumPy array of f64 in C order. An array that is one is not copied: its owner keeps it alive, also without
/// the interpreter's lock.
#[derive(Clone)]
pub struct Array {
    owner: Arc<Py<PyArrayDyn<f64>>>,
    start: *const f64,
    count: usize,
    shape: Vec<usize>,
}

// SAFETY: the numbers belong to `owner`, which lives as long, and no Rust code writes to them. As in NumPy itself, whoever
// writes to an array in another thread during a call gets results of some mixture of its numbers.
unsafe impl Send for Array {}
// SAFETY: as above.
unsafe impl Sync for Array {}

impl Array {
    /// The numbers of an array, or of whatever NumPy makes one from, with a number of dimensions; `name` is for messages.
    pub fn new(values: &Bound<PyAny>, dimensions: usize, name: &str) -> PyResult<Self> {
        let array = match values.cast::<PyArrayDyn<f64>>() {
            Ok(array) if array.is_c_contiguous() => array.clone(),
            _ => converted(values, name)?,
        };
        let shape = array.shape().to_vec();
        if shape.len() != dimensions {
            let found = shape.len();
            return Err(refuse(format!(
                "{name}: found an array of {found} dimensions; allowed: {dimensions}"
            )));
        }
        // SAFETY: the array is contiguous, and nobody writes to it while the lock is held here.
        let (start, count) =
            unsafe { array.as_slice().map(|values| (values.as_ptr(), values.len())) }.map_err(refuse)?;
        Ok(Self { owner: Arc::new(array.unbind()), start, count, shape })
    }

    /// The numbers.
    pub fn values(&self) -> &[f64] {
        if self.count == 0 {
            return &[];
        }
        // SAFETY: see `Send`; `start` and `count` are those of the array that `owner` keeps.
        unsafe { std::slice::from_raw_parts(self.start, self.count) }
    }

    /// Numbers along each dimension.
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// The array itself.
    pub fn object(&self, py: Python) -> Py<PyArrayDyn<f64>> {
        self.owner.clone_ref(py)
    }
}

/// What NumPy makes of it: a copy.
fn converted<'py>(values: &Bound<'py, PyAny>, name: &str) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let py = values.py();
    let keywords = PyDict::new(py);
    keywords.set_item("dtype", "float64")?;
    let made = py.import("numpy")?.call_method("ascontiguousarray", (values,), Some(&keywords));
    let made = made.map_err(|error| {
        if error.is_instance_of::<pyo3::exceptions::PyValueError>(py)
            || error.is_instance_of::<PyTypeError>(py)
        {
            refuse(format!("{name}: found no numbers ({}); allowed: an array of numbers", error.value(py)))
        } else {
            error
        }
    })?;
    made.cast_into::<PyArrayDyn<f64>>().map_err(|error| refuse(format!("{name}: {error}")))
}
