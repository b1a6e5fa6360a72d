//! Tables as mappings of column names to NumPy arrays, which are made when they are asked for.

use asperity_contact_framework::report::table::{Column, Heading, Row, Table as Cells, Value};
use asperity_experiment::model_tables::CurveRow;
use numpy::PyArray1;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::sync::Arc;

thread_local! {
    /// The columns of `curves.csv` from the model on, as far as models alone have them: those before are of a spec with several surfaces.
    static CURVES: Vec<Column<CurveRow>> = {
        let columns = CurveRow::columns().into_iter();
        let of_models = columns.skip_while(|column| column.heading.name != "model");
        of_models.filter(|column| column.heading.part.is_none()).collect()
    };
}

enum Content {
    Curves(Vec<CurveRow>),
    Cells(Arc<Cells>),
}

impl Content {
    fn headings(&self) -> Vec<Heading> {
        match self {
            Self::Curves(_) => CURVES.with(|all| all.iter().map(|column| column.heading.clone()).collect()),
            Self::Cells(table) => table.schema.columns.clone(),
        }
    }

    fn rows(&self) -> usize {
        match self {
            Self::Curves(rows) => rows.len(),
            Self::Cells(table) => table.rows(),
        }
    }

    /// Unit and values of a column.
    fn column(&self, name: &str) -> Option<(&'static str, Vec<Value>)> {
        match self {
            Self::Curves(rows) => CURVES.with(|all| {
                let column = all.iter().find(|column| column.heading.name == name)?;
                Some((column.heading.unit, rows.iter().map(|row| column.value(row)).collect()))
            }),
            Self::Cells(table) => {
                let (heading, cells) = table.column(name)?;
                Some((heading.unit, cells.to_vec()))
            }
        }
    }
}

/// A table: a mapping of column names to arrays, with the names, units and order of the program's CSV files.
///
/// Numbers are float64 with NaN for empty cells, counts int64, flags bool, names texts. The result of a model has the columns of
/// ``curves.csv`` from ``model`` on.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> steel = asperity.Material(210e9, 0.3, hardness=7.6e9)
/// >>> population = asperity.Population(20e-6, 48e-9, 6e10)
/// >>> curve = asperity.statistical(asperity.Interface(steel, steel), population, separations=[1.0])
/// >>> curve["area_ratio"].shape, curve.units["area_ratio"]
/// ((1,), '1')
#[pyclass(module = "asperity", frozen, mapping)]
pub struct Table {
    content: Content,
    /// Those that were asked for.
    arrays: Py<PyDict>,
}

impl Table {
    /// The points of curves.
    pub fn of_curves(py: Python, rows: Vec<CurveRow>) -> Self {
        Self { content: Content::Curves(rows), arrays: PyDict::new(py).unbind() }
    }

    /// A table of a run.
    pub fn of_cells(py: Python, table: Arc<Cells>) -> Self {
        Self { content: Content::Cells(table), arrays: PyDict::new(py).unbind() }
    }

    fn names(&self) -> Vec<String> {
        self.content.headings().into_iter().map(|heading| heading.name).collect()
    }

    fn dict_of<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for name in self.names() {
            dict.set_item(&name, self.__getitem__(py, &name)?)?;
        }
        Ok(dict)
    }
}

/// Counts as integers and flags as bool where there is no empty cell; numbers with NaN for empty cells; texts.
fn array<'py>(py: Python<'py>, unit: &str, values: &[Value]) -> PyResult<Bound<'py, PyAny>> {
    if unit == "text" {
        let text = |value: &Value| match value {
            Value::Text(text) => text.clone(),
            Value::List(names) => names.join("; "),
            _ => String::new(),
        };
        let texts = PyList::new(py, values.iter().map(text))?;
        let dtype = if values.is_empty() { "str" } else { "U" };
        return py.import("numpy")?.call_method1("array", (texts, dtype));
    }
    let whole: Option<Vec<i64>> = values
        .iter()
        .map(|value| match value {
            Value::Count(count) => i64::try_from(*count).ok(),
            _ => None,
        })
        .collect();
    if let Some(whole) = whole.filter(|_| unit == "count") {
        return Ok(PyArray1::from_vec(py, whole).into_any());
    }
    let flags: Option<Vec<bool>> = values
        .iter()
        .map(|value| match value {
            Value::Flag(flag) => Some(*flag),
            _ => None,
        })
        .collect();
    if let Some(flags) = flags.filter(|_| unit == "true/false") {
        return Ok(PyArray1::from_vec(py, flags).into_any());
    }
    let number = |value: &Value| match value {
        Value::Number(number) => *number,
        Value::Count(count) => *count as f64,
        Value::Flag(flag) => f64::from(u8::from(*flag)),
        Value::Text(_) | Value::List(_) | Value::Empty => f64::NAN,
    };
    Ok(PyArray1::from_vec(py, values.iter().map(number).collect()).into_any())
}

#[pymethods]
impl Table {
    fn __len__(&self) -> usize {
        self.content.headings().len()
    }

    fn __contains__(&self, name: &str) -> bool {
        self.content.headings().iter().any(|heading| heading.name == name)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        PyList::new(py, self.names())?.call_method0("__iter__")
    }

    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let arrays = self.arrays.bind(py);
        if let Some(made) = arrays.get_item(name)? {
            return Ok(made);
        }
        let Some((unit, values)) = self.content.column(name) else {
            return Err(PyKeyError::new_err(format!("{name}; the columns are {}", self.names().join(", "))));
        };
        let made = array(py, unit, &values)?;
        arrays.set_item(name, &made)?;
        Ok(made)
    }

    /// A column, or a default where there is none.
    #[pyo3(signature = (name, default=None))]
    fn get<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        default: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        if self.__contains__(name) { self.__getitem__(py, name).map(Some) } else { Ok(default) }
    }

    /// Names of the columns.
    fn keys(&self) -> Vec<String> {
        self.names()
    }

    /// The columns.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        self.names().iter().map(|name| self.__getitem__(py, name)).collect()
    }

    /// Names and columns.
    fn items<'py>(&self, py: Python<'py>) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
        self.names().into_iter().map(|name| Ok((name.clone(), self.__getitem__(py, &name)?))).collect()
    }

    /// Number of rows.
    #[getter]
    fn rows(&self) -> usize {
        self.content.rows()
    }

    /// SI unit of each column; ``1`` of a ratio.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        self.content.headings().iter().try_for_each(|heading| dict.set_item(&heading.name, heading.unit))?;
        Ok(dict)
    }

    /// Meaning of each column, in one sentence.
    #[getter]
    fn meanings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        self.content
            .headings()
            .iter()
            .try_for_each(|heading| dict.set_item(&heading.name, &heading.meaning))?;
        Ok(dict)
    }

    /// A pandas DataFrame.
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("pandas")?.call_method1("DataFrame", (self.dict_of(py)?,))
    }

    /// An xarray Dataset over the rows, with units and meanings as attributes.
    fn to_xarray<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let variables = PyDict::new(py);
        for heading in self.content.headings() {
            let attributes = PyDict::new(py);
            attributes.set_item("units", heading.unit)?;
            attributes.set_item("long_name", &heading.meaning)?;
            variables.set_item(&heading.name, ("row", self.__getitem__(py, &heading.name)?, attributes))?;
        }
        py.import("xarray")?.call_method1("Dataset", (variables,))
    }

    fn __repr__(&self) -> String {
        format!("<Table: {} rows; {}>", self.rows(), self.names().join(", "))
    }
}
