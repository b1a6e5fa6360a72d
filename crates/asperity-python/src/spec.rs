//! Specs from Python: paths, or dictionaries with surfaces in memory.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use asperity_contact_framework::input::{InMemory, InputError, Source};
use asperity_contact_framework::remedy::FrontEnd;
use asperity_contact_framework::report::store::Store;
use asperity_contact_framework::report::table::{Table as Cells, Tables};
use asperity_contact_framework::{Outcome, folder, summary_json};
use asperity_experiment::Experiment;
use asperity_experiment::export::{
    ExportedFile, Format, InterfaceOptions, InterfaceTable, TableModel, UnitSystem, interface_files,
    interface_tables,
};
use asperity_experiment::kind::REPORTED;
use asperity_experiment::sweep;
use indexmap::IndexMap;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};

use crate::asperities::Asperities;
use crate::refuse;
use crate::surface::Map;
use crate::table::Table;
use crate::watch::{Watch, interruptible};

/// A value of a spec; `key` is for messages.
pub fn toml_of(value: &Bound<PyAny>, key: &str) -> PyResult<toml::Value> {
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(toml::Value::Boolean(flag.is_true()));
    }
    if value.cast::<PyInt>().is_ok() {
        let number: Result<i64, _> = value.extract();
        return number
            .map(toml::Value::Integer)
            .map_err(|_| refuse(format!("{key}: found {value}; allowed: 64 bits")));
    }
    if value.cast::<PyFloat>().is_ok() {
        return Ok(toml::Value::Float(value.extract()?));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(toml::Value::String(text.to_str()?.to_owned()));
    }
    if let Ok(table) = value.cast::<PyDict>() {
        let mut made = toml::Table::new();
        for (name, value) in table {
            let name: String =
                name.extract().map_err(|_| refuse(format!("{key}: found the key {name}; allowed: texts")))?;
            let value = toml_of(
                &value,
                if key.is_empty() { name.clone() } else { format!("{key}.{name}") }.as_str(),
            )?;
            made.insert(name, value);
        }
        return Ok(toml::Value::Table(made));
    }
    if value.cast::<PyList>().is_ok() || value.cast::<PyTuple>().is_ok() {
        let items: PyResult<Vec<_>> = value.try_iter()?.map(|item| toml_of(&item?, key)).collect();
        return items.map(toml::Value::Array);
    }
    // Arrays and scalars of NumPy, then paths.
    if value.hasattr("tolist")? {
        return toml_of(&value.call_method0("tolist")?, key);
    }
    if let Ok(path) = value.extract::<PathBuf>() {
        return Ok(toml::Value::String(path.to_string_lossy().into_owned()));
    }
    let kind = value.get_type().name()?;
    Err(refuse(format!(
        "{key}: found a {kind}; allowed: texts, numbers, flags, lists, arrays, dictionaries and paths"
    )))
}

/// An error of a spec, with its key beside the message.
pub fn refuse_input(error: &InputError) -> PyErr {
    let refused = refuse(error.without_line());
    // Without its key it is what it was.
    let _ = Python::attach(|py| refused.value(py).setattr("key", error.key()));
    refused
}

/// The text of a spec that is a dictionary, whose paths are relative to `folder`.
pub fn source_of(spec: &Bound<PyDict>, folder: &Path) -> PyResult<Source> {
    let text = toml::to_string(&toml_of(spec.as_any(), "")?).map_err(refuse)?;
    Ok(Source::in_memory(folder, text))
}

/// A spec file as a dictionary, keys and values as they stand.
#[pyfunction]
pub fn read_spec<'py>(py: Python<'py>, path: PathBuf) -> PyResult<Bound<'py, PyAny>> {
    let refuse = |error: &dyn std::fmt::Display| refuse(format!("{}: {error}", path.display()));
    let text = std::fs::read_to_string(&path).map_err(|error| refuse(&error))?;
    let table: toml::Table = text.parse().map_err(|error: toml::de::Error| refuse(&error))?;
    python_of(py, toml::Value::Table(table))
}

fn python_of(py: Python<'_>, value: toml::Value) -> PyResult<Bound<'_, PyAny>> {
    match value {
        toml::Value::String(text) => text.into_bound_py_any(py),
        toml::Value::Integer(number) => number.into_bound_py_any(py),
        toml::Value::Float(number) => number.into_bound_py_any(py),
        toml::Value::Boolean(flag) => flag.into_bound_py_any(py),
        // A spec has none; its reader says so.
        toml::Value::Datetime(time) => time.to_string().into_bound_py_any(py),
        toml::Value::Array(items) => {
            let list = PyList::empty(py);
            items.into_iter().try_for_each(|item| list.append(python_of(py, item)?))?;
            Ok(list.into_any())
        }
        toml::Value::Table(table) => {
            let dict = PyDict::new(py);
            table.into_iter().try_for_each(|(key, item)| dict.set_item(key, python_of(py, item)?))?;
            Ok(dict.into_any())
        }
    }
}

/// Checks a dictionary as [`run`] does, without running it, and returns what its results depend on, as a hexadecimal SHA-256:
/// the spec, its input files, the program and its name.
#[pyfunction]
#[pyo3(signature = (spec, *, name="asperity", folder=PathBuf::new()))]
pub fn key(py: Python, spec: &Bound<PyDict>, name: &str, folder: PathBuf) -> PyResult<String> {
    let (source, name) = (source_of(spec, &folder)?, name.to_owned());
    let work = move |watch: &Watch| Experiment::watched_parse(source, &name, watch)?.watched_key(watch);
    interruptible(py, work)?.map_err(|error| refuse_input(&error))
}

/// The variations of a dictionary with ``sweep``: for each the values of its keys, and its spec.
#[pyfunction]
#[pyo3(signature = (spec, *, folder=PathBuf::new()))]
pub fn variations<'py>(
    py: Python<'py>,
    spec: &Bound<PyDict>,
    folder: PathBuf,
) -> PyResult<Vec<(Bound<'py, PyAny>, Bound<'py, PyAny>)>> {
    let source = source_of(spec, &folder)?;
    let found = py.detach(|| sweep::variations(source)).map_err(|error| refuse_input(&error))?;
    let both = |[values, table]: [toml::Table; 2]| {
        Ok((python_of(py, toml::Value::Table(values))?, python_of(py, toml::Value::Table(table))?))
    };
    found.into_iter().map(both).collect()
}

/// The number of tasks that a run of a dictionary with ``sweep`` or ``tiled`` is divided into, and of passes over them.
#[pyfunction]
#[pyo3(signature = (spec, *, name, folder))]
pub fn tasks(py: Python, spec: &Bound<PyDict>, name: &str, folder: PathBuf) -> PyResult<[usize; 2]> {
    let (source, name) = (source_of(spec, &folder)?, name.to_owned());
    let work = move |watch: &Watch| Experiment::watched_parse(source, &name, watch)?.tasks();
    interruptible(py, work)?.map_err(|error| refuse_input(&error))
}

/// What one task finds in the pass after those of ``earlier``, as JSON.
#[pyfunction]
#[pyo3(signature = (spec, task, earlier, *, name, folder))]
pub fn run_task(
    py: Python,
    spec: &Bound<PyDict>,
    task: usize,
    earlier: Vec<Vec<String>>,
    name: &str,
    folder: PathBuf,
) -> PyResult<String> {
    let (source, name) = (source_of(spec, &folder)?, name.to_owned());
    let work =
        move |watch: &Watch| Experiment::watched_parse(source, &name, watch)?.run_task(task, &earlier, watch);
    interruptible(py, work)?.map_err(|error| refuse_input(&error))
}

/// The results of a run, from what all tasks have found in all passes; written below ``report``. ``key`` is that of before.
#[pyfunction]
#[pyo3(signature = (spec, passes, *, key, name, report, folder))]
pub fn results_of_tasks(
    py: Python,
    spec: &Bound<PyDict>,
    passes: Vec<Vec<String>>,
    key: String,
    name: &str,
    report: Option<PathBuf>,
    folder: PathBuf,
) -> PyResult<Run> {
    let (source, name) = (source_of(spec, &folder)?, name.to_owned());
    let work = move |watch: &Watch| {
        let experiment = Experiment::watched_parse(source, &name, watch);
        finish(experiment, report, |experiment| experiment.results_of_tasks(&passes, &key, watch))
    };
    interruptible(py, work)?
}

/// A message with arguments of this package for the keys of a spec that it advises.
#[pyfunction]
pub fn in_arguments(message: &str) -> String {
    FrontEnd::Python.text(message)
}

/// Bits of the vector registers that sums run in.
#[pyfunction]
pub fn register_bits() -> usize {
    asperity::numeric::lanes::register_bits()
}

/// Surfaces in memory by the path that the spec has for them.
pub fn in_memory_of(in_memory: &Bound<PyDict>) -> PyResult<IndexMap<PathBuf, InMemory>> {
    let one = |(name, value): (Bound<PyAny>, Bound<PyAny>)| {
        let name: PathBuf = name.extract()?;
        let found = match (value.cast::<Map>(), value.cast::<Asperities>()) {
            (Ok(map), _) => map.get().in_memory(),
            (_, Ok(list)) => list.get().in_memory(),
            _ => return Err(refuse(format!("{}: allowed: a Map or Asperities", name.display()))),
        };
        Ok((name, found))
    };
    in_memory.iter().map(one).collect()
}

/// What an experiment gives.
#[pyclass(module = "asperity._asperity", frozen)]
pub struct Run {
    #[pyo3(get)]
    kind: &'static str,
    tables: Vec<Arc<Cells>>,
    #[pyo3(get)]
    summary: String,
    #[pyo3(get)]
    warnings: Vec<String>,
    #[pyo3(get)]
    report: Option<PathBuf>,
    /// Joints for other programs; those of parts have none.
    interfaces: Option<Interfaces>,
}

/// Name of a report and its joints by model, with and without loads that are not admissible.
struct Interfaces {
    stem: String,
    tables: Vec<(InterfaceOptions, Result<Vec<InterfaceTable>, String>)>,
}

impl Interfaces {
    fn new(stem: &str, outcome: &dyn Outcome) -> Self {
        let all = TableModel::ALL.into_iter().flat_map(|model| [false, true].map(|beyond| (model, beyond)));
        let table = |(model, beyond)| {
            let options = InterfaceOptions { model, beyond };
            (options, interface_tables(outcome, options).map(|found| found.tables))
        };
        Self { stem: stem.to_owned(), tables: all.map(table).collect() }
    }

    fn files(
        &self,
        options: InterfaceOptions,
        format: Format,
        units: UnitSystem,
    ) -> PyResult<Vec<ExportedFile>> {
        let found = self.tables.iter().find(|(those, _)| *those == options).map(|(_, tables)| tables);
        let tables = found.ok_or_else(|| refuse("found no such table"))?.as_ref();
        Ok(interface_files(tables.map_err(refuse)?, &self.stem, format, units))
    }
}

/// The one of `all` with a name.
fn named<T: Copy>(key: &str, all: &[T], name: impl Fn(T) -> &'static str, wanted: &str) -> PyResult<T> {
    all.iter().copied().find(|one| name(*one) == wanted).ok_or_else(|| {
        let allowed: Vec<&str> = all.iter().copied().map(&name).collect();
        refuse(format!("{key}: found \"{wanted}\"; allowed: {}", allowed.join(", ")))
    })
}

/// What [`Run`] is made of: kind, files by name, summary, warnings, report.
type Parts<'py> = (String, Bound<'py, PyDict>, String, Vec<String>, Option<PathBuf>);

#[pymethods]
impl Run {
    /// A run from its parts, as [`Self::__reduce__`] gives them: from another process or a file.
    #[staticmethod]
    fn from_parts(
        kind: &str,
        csv: &Bound<PyDict>,
        summary: String,
        warnings: Vec<String>,
        report: Option<PathBuf>,
    ) -> PyResult<Self> {
        let found = REPORTED.iter().find(|known| known.name == kind);
        let found =
            found.ok_or_else(|| refuse(format!("found results of {kind}, which this version has not")))?;
        let schemas = (found.tables)();
        let table = |(name, content): (Bound<PyAny>, Bound<PyAny>)| {
            let name: String = name.extract()?;
            let schema = schemas.iter().find(|schema| schema.file == name);
            let schema = schema.ok_or_else(|| refuse(format!("the table {name} is not described")))?;
            let content: Vec<u8> = content.extract()?;
            Ok(Arc::new(Cells::read(schema, &content).map_err(refuse)?))
        };
        let tables: PyResult<Vec<_>> = csv.iter().map(table).collect();
        Ok(Self { kind: found.name, tables: tables?, summary, warnings, report, interfaces: None })
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Parts<'py>)> {
        let from_parts = py.get_type::<Self>().getattr("from_parts")?;
        let Self { kind, summary, warnings, report, .. } = self;
        Ok((
            from_parts,
            ((*kind).to_owned(), self.csv(py)?, summary.clone(), warnings.clone(), report.clone()),
        ))
    }

    /// The files of the tables by name.
    fn csv<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for table in &self.tables {
            dict.set_item(table.schema.file, PyBytes::new(py, &table.csv().map_err(refuse)?))?;
        }
        Ok(dict)
    }

    /// The joint for other programs: files by name.
    fn interface_files<'py>(
        &self,
        py: Python<'py>,
        format: &str,
        model: &str,
        units: &str,
        beyond: bool,
    ) -> PyResult<Bound<'py, PyDict>> {
        let format = named("format", &Format::ALL, Format::name, format)?;
        let model = named("model", &TableModel::ALL, TableModel::name, model)?;
        let units = named("units", &UnitSystem::ALL, UnitSystem::name, units)?;
        let interfaces = self.interfaces.as_ref().ok_or_else(|| {
            refuse("found results of another process or of a file; allowed: results of asperity.run or asperity.compare here")
        })?;
        let dict = PyDict::new(py);
        for file in interfaces.files(InterfaceOptions { model, beyond }, format, units)? {
            dict.set_item(file.name, file.text)?;
        }
        Ok(dict)
    }

    /// The tables by name.
    fn tables<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for table in &self.tables {
            let file = table.schema.file;
            let name = file.strip_suffix(".csv").unwrap_or(file);
            dict.set_item(name, Table::of_cells(py, table.clone()))?;
        }
        Ok(dict)
    }
}

/// Runs a spec; ``in_memory`` are maps and asperities in memory by path; paths in a dictionary are relative to ``folder``. Errors of
/// a dictionary made ``of_arguments`` advise arguments.
#[pyfunction]
#[pyo3(signature = (spec, in_memory, *, name="asperity", report=None, folder=PathBuf::new(), of_arguments=false))]
pub fn run(
    py: Python,
    spec: &Bound<PyAny>,
    in_memory: &Bound<PyDict>,
    name: &str,
    report: Option<PathBuf>,
    folder: PathBuf,
    of_arguments: bool,
) -> PyResult<Run> {
    if name.is_empty() || Path::new(name).file_name() != Some(name.as_ref()) {
        return Err(refuse(format!("name: found \"{name}\"; allowed: a name such as my-surface")));
    }
    let name = name.to_owned();
    let work: Work = match spec.cast::<PyDict>() {
        Ok(table) => {
            let front_end = if of_arguments { FrontEnd::Python } else { FrontEnd::Spec };
            let source = source_of(table, &folder)?.read_in(front_end);
            let source = source.with_in_memory(in_memory_of(in_memory)?);
            Box::new(move |watch| {
                let experiment = Experiment::watched_parse(source, &name, watch);
                finish(experiment, report, |experiment| experiment.run(watch))
            })
        }
        Err(_) => {
            let path: PathBuf = spec
                .extract()
                .map_err(|_| refuse("spec: allowed: the path of a spec file, or a dictionary"))?;
            Box::new(move |watch| {
                let experiment = Experiment::watched_read(&path, watch);
                finish(experiment, report, |experiment| experiment.run(watch))
            })
        }
    };
    interruptible(py, work)?
}

/// A run, yet to be done.
type Work = Box<dyn FnOnce(&Watch) -> PyResult<Run> + Send>;

fn finish(
    experiment: Result<Experiment, InputError>,
    report: Option<PathBuf>,
    run: impl FnOnce(&Experiment) -> Result<Box<dyn Outcome>, InputError>,
) -> PyResult<Run> {
    let file = |error: &dyn std::fmt::Display| PyOSError::new_err(error.to_string());
    let experiment = experiment.map_err(|error| refuse_input(&error))?;
    if let Some(directory) = &report {
        Store::new(directory).check(experiment.stem()).map_err(|error| file(&error))?;
    }
    let outcome = run(&experiment).map_err(|error| refuse_input(&error))?;
    let report = match report {
        None => None,
        Some(directory) => {
            let key = experiment.key().map_err(|error| refuse_input(&error))?;
            let made = folder(&*outcome, &key).map_err(refuse)?;
            let mut store = Store::new(&directory);
            store.recover().map_err(|error| file(&error))?;
            store.write(&made).map_err(|error| file(&error))?;
            Some(directory.join(experiment.stem()))
        }
    };
    let tables = Tables::new(outcome.tables());
    let summary = summary_json(&*outcome, &tables).map_err(refuse)?;
    Ok(Run {
        kind: outcome.metadata().kind,
        summary: String::from_utf8(summary).map_err(refuse)?,
        tables: tables.into_iter().map(Arc::new).collect(),
        warnings: outcome.warnings(),
        report,
        interfaces: Some(Interfaces::new(experiment.stem(), &*outcome)),
    })
}
