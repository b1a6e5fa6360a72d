//! Tables: columns as NumPy arrays, which are made when they are asked for, and rows as dictionaries.

use asperity_contact_framework::report::table::{Column, Heading, Row, Table as Cells, Value};
use asperity_experiment::model_tables::CurveRow;
use numpy::PyArray1;
use pyo3::exceptions::{PyIndexError, PyKeyError};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict, PyList};
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
    /// All columns are arrays already.
    Arrays,
}

/// A table with the columns, units and order of the program's CSV files: ``table["area_ratio"]`` is a column as an array, ``table[0]`` a
/// row as a dictionary, and its length and iteration are those of its rows, so that ``pandas.DataFrame(table)`` is the table.
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
    /// Name, unit and meaning of each column.
    headings: Vec<[String; 3]>,
    /// Number of rows.
    #[pyo3(get)]
    rows: usize,
    content: Content,
    /// The columns that were asked for.
    arrays: Py<PyDict>,
}

impl Table {
    fn new<'a>(
        py: Python,
        headings: impl Iterator<Item = &'a Heading>,
        rows: usize,
        content: Content,
    ) -> Self {
        let texts = |heading: &Heading| [&heading.name, heading.unit, &heading.meaning].map(str::to_owned);
        Self { headings: headings.map(texts).collect(), rows, content, arrays: PyDict::new(py).unbind() }
    }

    /// The points of curves.
    pub fn of_curves(py: Python, rows: Vec<CurveRow>) -> Self {
        CURVES.with(|all| {
            Self::new(py, all.iter().map(|column| &column.heading), rows.len(), Content::Curves(rows))
        })
    }

    /// A table of a run.
    pub fn of_cells(py: Python, table: Arc<Cells>) -> Self {
        Self::new(py, table.schema.columns.iter(), table.rows(), Content::Cells(Arc::clone(&table)))
    }

    /// Unit and values of a column that is no array yet.
    fn cells(&self, name: &str) -> Option<(&'static str, Vec<Value>)> {
        match &self.content {
            Content::Curves(rows) => CURVES.with(|all| {
                let column = all.iter().find(|column| column.heading.name == name)?;
                Some((column.heading.unit, rows.iter().map(|row| column.value(row)).collect()))
            }),
            Content::Cells(table) => {
                let (heading, cells) = table.column(name)?;
                Some((heading.unit, cells.to_vec()))
            }
            Content::Arrays => None,
        }
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        self.headings.iter().map(|[name, ..]| name.as_str())
    }

    fn column<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let arrays = self.arrays.bind(py);
        if let Some(made) = arrays.get_item(name)? {
            return Ok(made);
        }
        let Some((unit, values)) = self.cells(name) else {
            let names = self.keys().join(", ");
            return Err(PyKeyError::new_err(format!("{name}; the columns are {names}")));
        };
        let made = array(py, unit, &values)?;
        arrays.set_item(name, &made)?;
        Ok(made)
    }

    fn dict_of<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.items(py)?.into_py_dict(py)
    }

    /// A column of texts beside the names.
    fn texts_of<'py>(&self, py: Python<'py>, of: usize) -> PyResult<Bound<'py, PyDict>> {
        self.headings.iter().map(|heading| (&heading[0], &heading[of])).into_py_dict(py)
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

/// What another process needs of a table: headings, number of rows, columns.
type Parts<'py> = (Vec<[String; 3]>, usize, Bound<'py, PyDict>);

#[pymethods]
impl Table {
    #[staticmethod]
    fn _from_parts(headings: Vec<[String; 3]>, rows: usize, columns: Bound<PyDict>) -> Self {
        Self { headings, rows, content: Content::Arrays, arrays: columns.unbind() }
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Parts<'py>)> {
        let from_parts = py.get_type::<Self>().getattr("_from_parts")?;
        Ok((from_parts, (self.headings.clone(), self.rows, self.dict_of(py)?)))
    }

    fn __len__(&self) -> usize {
        self.rows
    }

    fn __contains__(&self, name: &str) -> bool {
        self.names().any(|known| known == name)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let columns = self.values(py)?.into_iter().map(|column| column.call_method0("tolist")?.extract());
        let columns: Vec<Vec<Bound<PyAny>>> = columns.collect::<PyResult<_>>()?;
        let row = |k: usize| self.names().zip(columns.iter().map(|column| &column[k])).into_py_dict(py);
        PyList::new(py, (0..self.rows).map(row).collect::<PyResult<Vec<_>>>()?)?.call_method0("__iter__")
    }

    fn __getitem__<'py>(&self, py: Python<'py>, at: NameOrRow) -> PyResult<Bound<'py, PyAny>> {
        let row = match at {
            NameOrRow::Name(name) => return self.column(py, &name),
            NameOrRow::Row(row) => {
                if row < 0 {
                    row + self.rows as isize
                } else {
                    row
                }
            }
        };
        if row < 0 || row >= self.rows as isize {
            return Err(PyIndexError::new_err(format!("found row {row}; the table has {} rows", self.rows)));
        }
        let cell = |(name, column): (String, Bound<'py, PyAny>)| {
            Ok((name, column.get_item(row)?.call_method0("item")?))
        };
        let cells: PyResult<Vec<_>> = self.items(py)?.into_iter().map(cell).collect();
        Ok(cells?.into_py_dict(py)?.into_any())
    }

    /// A column, or a default where there is none.
    #[pyo3(signature = (name, default=None))]
    fn get<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        default: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        if self.__contains__(name) { self.column(py, name).map(Some) } else { Ok(default) }
    }

    /// Names of the columns.
    fn keys(&self) -> Vec<&str> {
        self.names().collect()
    }

    /// The columns.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        self.names().map(|name| self.column(py, name)).collect()
    }

    /// Names and columns.
    fn items<'py>(&self, py: Python<'py>) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
        self.names().map(|name| Ok((name.to_owned(), self.column(py, name)?))).collect()
    }

    /// SI unit of each column; ``1`` of a ratio.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.texts_of(py, 1)
    }

    /// Meaning of each column, in one sentence.
    #[getter]
    fn meanings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.texts_of(py, 2)
    }

    /// A pandas DataFrame.
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("pandas")?.call_method1("DataFrame", (self.dict_of(py)?,))
    }

    /// An xarray Dataset over the rows, with units and meanings as attributes.
    fn to_xarray<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let variables = PyDict::new(py);
        for [name, unit, meaning] in &self.headings {
            let attributes = [("units", unit), ("long_name", meaning)].into_py_dict(py)?;
            variables.set_item(name, ("row", self.column(py, name)?, attributes))?;
        }
        py.import("xarray")?.call_method1("Dataset", (variables,))
    }

    fn __repr__(&self) -> String {
        format!("<Table: {} rows; {}>", self.rows, self.keys().join(", "))
    }
}

/// A column by its name, or a row by its number.
#[derive(FromPyObject)]
enum NameOrRow {
    Name(String),
    Row(isize),
}
