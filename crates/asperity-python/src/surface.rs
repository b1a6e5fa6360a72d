//! Height maps, and surfaces made by the program's own preparation and search.

use std::ops::Range;
use std::sync::Arc;

use asperity::HeightMap;
use asperity::topography::read::{Crop, LengthUnits, MapFile, Marks, ReadError, ReadOptions};
use asperity::topography::write::{FORMATS, MapFormat, Note};
use asperity::topography::{Boundary, Rows, Watched, Window};
use asperity::units::Dimension;
use asperity_contact_framework::input::InMemory;
use asperity_contact_framework::remedy::FrontEnd;
use asperity_experiment::surface::fit_records;
use asperity_experiment::surface::reading;
use asperity_experiment::surface::reading::spec_message;
use asperity_experiment::surface::rows::{fitness_records, map_record};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::array::Array;
use crate::asperities::Asperities;
use crate::refuse;
use crate::spec::{in_memory_of, refuse_input, source_of};
use crate::watch::{Watch, interruptible};

/// The heights of an array where they lie.
struct Lent {
    heights: Array,
    pixel: [f64; 2],
    precision: f64,
    offset: f64,
}

impl Rows for Lent {
    fn points(&self) -> [usize; 2] {
        [self.heights.shape()[0], self.heights.shape()[1]]
    }

    fn pixel(&self) -> [f64; 2] {
        self.pixel
    }

    fn precision(&self) -> f64 {
        self.precision
    }

    fn offset(&self) -> f64 {
        self.offset
    }

    fn boundary(&self) -> Boundary {
        Boundary::Open
    }

    fn read(&self, ix: usize, row: &mut [f64]) {
        row.copy_from_slice(&self.heights.values()[ix * row.len()..][..row.len()]);
    }

    fn block(&self, rows: Range<usize>) -> Option<&[f64]> {
        let columns = self.heights.shape()[1];
        Some(&self.heights.values()[rows.start * columns..rows.end * columns])
    }
}

/// A height map in memory or on disk: what a :class:`Topography` prepares.
#[pyclass(module = "asperity._asperity", frozen)]
pub struct Map {
    rows: Arc<dyn Rows>,
    /// What a reader should know of how it was read, in words of a spec.
    caveats: Vec<String>,
}

impl Map {
    fn of(rows: impl Rows + 'static) -> Self {
        Self { rows: Arc::new(rows), caveats: Vec::new() }
    }

    /// As a surface of a spec.
    pub fn in_memory(&self) -> InMemory {
        InMemory::Map { rows: Arc::clone(&self.rows), caveats: self.caveats.clone() }
    }
}

/// Why a map is not read, with the arguments that correct it.
fn refuse_map(map: &str, error: &ReadError) -> PyErr {
    refuse(format!("{map} {}", FrontEnd::Python.text(&spec_message(error))))
}

/// Heights, pixel, precision, offset and caveats.
type MapArguments<'py> = (Bound<'py, PyArray2<f64>>, [f64; 2], f64, f64, Vec<String>);

#[pymethods]
impl Map {
    /// Heights are relative to ``offset``, and stored with a relative ``precision``.
    #[new]
    #[pyo3(signature = (heights, pixel, precision=f64::EPSILON, offset=0.0, caveats=Vec::new()))]
    fn new(
        heights: &Bound<PyAny>,
        pixel: [f64; 2],
        precision: f64,
        offset: f64,
        caveats: Vec<String>,
    ) -> PyResult<Self> {
        /// Heights beyond this, infinite ones and NaN mark missing points, of which only NaN is kept as such.
        const LARGEST: f64 = 1e30;
        let heights = Array::new(heights, 2, "heights")?;
        let points = [heights.shape()[0], heights.shape()[1]];
        HeightMap::check_grid(points, pixel).map_err(refuse)?;
        let (is_lent, is_empty) = heights.values().iter().fold((true, true), |(is_lent, is_empty), z| {
            let is_present = z.abs() <= LARGEST;
            (is_lent & (is_present | z.is_nan()), is_empty & !is_present)
        });
        if is_empty || !is_lent {
            let map =
                HeightMap::new(points, pixel, heights.values().to_vec(), f64::EPSILON).map_err(refuse)?;
            return Ok(Self { caveats, ..Self::of(map) });
        }
        Ok(Self { caveats, ..Self::of(Lent { heights, pixel, precision, offset }) })
    }

    /// Reads a measured map; ``unit`` is that of x and y and that of heights in m.
    #[staticmethod]
    #[pyo3(signature = (path, *, pixel=None, unit=None, missing=None, channel=None, transpose=false, crop=[None; 2]))]
    #[expect(clippy::too_many_arguments, reason = "those of Python")]
    fn read(
        py: Python,
        path: std::path::PathBuf,
        pixel: Option<[f64; 2]>,
        unit: Option<[f64; 2]>,
        missing: Option<(Vec<f64>, Vec<String>)>,
        channel: Option<String>,
        transpose: bool,
        crop: [Option<[f64; 2]>; 2],
    ) -> PyResult<Self> {
        let unit = unit.map(|[xy, z]| LengthUnits { xy, z });
        let missing = missing.map(|(heights, words)| Marks { heights, words });
        let file = MapFile {
            path,
            options: ReadOptions { pixel, unit },
            missing,
            transpose,
            crop: Crop { x: crop[0], y: crop[1] },
            channel,
        };
        let shown = file.path.display().to_string();
        let rows = move |watch: &Watch| -> Result<_, ReadError> {
            let (metadata, rows) = (file.watched_metadata(watch)?, file.rows(watch)?);
            let caveats = reading::caveats(&metadata, rows.pixel(), &file);
            Ok(Self { rows: Arc::from(rows), caveats })
        };
        interruptible(py, rows)?.map_err(|error| refuse_map(&shown, &error))
    }

    /// Writes the map in the format of the file's ending.
    fn write(&self, py: Python, path: std::path::PathBuf) -> PyResult<()> {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        let format = MapFormat::of_ending(&ending).ok_or_else(|| {
            let endings = FORMATS.map(|format| format!(".{}", format.ending)).join(", ");
            refuse(format!("{} ends in \".{ending}\"; allowed: {endings}", path.display()))
        })?;
        let program: Note = ("Program", format!("asperity {}", env!("CARGO_PKG_VERSION")));
        let map = Arc::clone(&self.rows);
        let write = move |watch: &Watch| {
            format.write_file(&path, &Watched { map: &*map, progress: watch }, &[program])
        };
        Ok(interruptible(py, write)??)
    }

    /// Points along x and y.
    #[getter]
    fn points(&self) -> [usize; 2] {
        self.rows.points()
    }

    /// Distance of neighbouring points in m.
    #[getter]
    fn pixel(&self) -> [f64; 2] {
        self.rows.pixel()
    }

    fn __getnewargs__<'py>(&self, py: Python<'py>) -> PyResult<MapArguments<'py>> {
        Ok((self.heights(py)?, self.pixel(), self.rows.precision(), self.rows.offset(), self.caveats.clone()))
    }

    /// What a reader should know of how it was read.
    #[getter]
    fn caveats(&self) -> Vec<String> {
        self.caveats.iter().map(|caveat| FrontEnd::Python.text(caveat)).collect()
    }

    /// A part of the map: from and to in m along each axis that is cut.
    fn part(&self, x: Option<[f64; 2]>, y: Option<[f64; 2]>) -> PyResult<Self> {
        let crop = Crop { x, y };
        let ranges = crop.ranges(self.points(), self.pixel());
        let [x, y] = ranges.map_err(|error| refuse_map("the map", &error))?;
        let rows = Window { map: &*self.rows, first: [x.start, y.start], points: [x.len(), y.len()] };
        let mut part = Self { caveats: self.caveats.clone(), ..Self::of(HeightMap::from_rows(&rows)) };
        if !crop.is_whole() {
            part.caveats.push(format!("only a part of the map is used{}.", reading::part(&crop)));
        }
        Ok(part)
    }

    /// A copy of the heights in m.
    fn heights<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let [nx, ny] = self.rows.points();
        let mut heights = vec![0.0; nx * ny];
        heights.chunks_mut(ny).enumerate().for_each(|(ix, row)| self.rows.read(ix, row));
        heights.into_pyarray(py).reshape([nx, ny])
    }
}

/// A unit of length in m.
#[pyfunction]
pub fn length_unit(name: &str) -> PyResult<f64> {
    Dimension::Length.documented_factor(name).ok_or_else(|| {
        refuse(format!("unit: found \"{name}\"; allowed: {}", Dimension::Length.documented().join(", ")))
    })
}

/// A prepared surface: its asperities, map and facts.
#[pyclass(module = "asperity", frozen)]
pub struct Surface {
    #[pyo3(get)]
    asperities: Py<Asperities>,
    #[pyo3(get)]
    positions: Py<PyAny>,
    #[pyo3(get)]
    map: Option<Py<Map>>,
    #[pyo3(get)]
    roughness: String,
    #[pyo3(get)]
    fitness: String,
    #[pyo3(get)]
    fit_steps: String,
    #[pyo3(get)]
    warnings: Vec<String>,
}

/// Makes or reads the one surface of a spec without an experiment; ``in_memory`` are maps and asperities in memory by path.
#[pyfunction]
#[pyo3(signature = (spec, in_memory, *, realisation=1))]
pub fn make_surface(
    py: Python,
    spec: &Bound<PyDict>,
    in_memory: &Bound<PyDict>,
    realisation: usize,
) -> PyResult<Surface> {
    if realisation == 0 {
        return Err(refuse("realisation: found 0; allowed: from 1"));
    }
    let source = source_of(spec, std::path::Path::new(""))?.read_in(FrontEnd::Python);
    let source = source.with_in_memory(in_memory_of(in_memory)?);
    // Ellipses are known on maps without further input.
    let as_ellipses = in_memory.is_empty() && spec_has_map(spec)? || holds_map(in_memory)?;
    let surface = interruptible(py, move |watch| {
        asperity_experiment::make_surface(source, realisation, as_ellipses, watch)
    })?
    .map_err(|error| refuse_input(&error))?;
    let (roughness, fitness) = (map_record(&surface).to_string(), fitness_records(&surface).to_string());
    let fit_steps = fit_records(&surface).to_string();
    let origin = surface.origin;
    let set = surface.set;
    // In the frame of the map: zero where that is the frame of the set already.
    let heights: Vec<f64> = set.heights().iter().map(|z| z + origin).collect();
    let curvatures = set.ellipses().map(|ellipses| {
        let both = ellipses.iter().map(|ellipse| ellipse.principal()[0]);
        let both = both.chain(ellipses.iter().map(|ellipse| ellipse.principal()[1]));
        both.collect::<Vec<f64>>()
    });
    let count = set.count();
    let array = |values: Vec<f64>, name: &str| Array::new(PyArray1::from_vec(py, values).as_any(), 1, name);
    let curvatures = match curvatures {
        Some(both) => {
            let both = both.into_pyarray(py).reshape([2, count])?;
            Some(Array::new(both.as_any(), 2, "curvatures")?)
        }
        None => None,
    };
    let places = surface.prepared.as_ref().map(|prepared| {
        let ([_, ny], pixel) = (prepared.map.points(), prepared.map.pixel());
        let place = |axis: usize, at: usize| (at as f64 + 0.5) * pixel[axis];
        let x = prepared.positions.iter().map(|&point| place(0, point / ny));
        x.chain(prepared.positions.iter().map(|&point| place(1, point % ny))).collect::<Vec<f64>>()
    });
    let places = match places {
        Some(both) => {
            let both = both.into_pyarray(py).reshape([2, count])?;
            Some(Array::new(both.as_any(), 2, "places")?)
        }
        None => None,
    };
    let asperities = Asperities {
        heights: array(heights, "heights")?,
        radii: array(set.radii().to_vec(), "radii")?,
        curvatures,
        places,
        // Drawn from a population.
        independent: surface.nominal.is_some(),
        nominal_area: set.nominal_area(),
    };
    let (map, positions) = match surface.prepared {
        Some(prepared) => {
            let positions = prepared.positions.iter().map(|&place| place as i64).collect();
            let positions = PyArray1::<i64>::from_vec(py, positions).into_any().unbind();
            (Some(Py::new(py, Map { rows: prepared.map, caveats: Vec::new() })?), positions)
        }
        None => (None, py.None()),
    };
    Ok(Surface {
        asperities: Py::new(py, asperities)?,
        positions,
        map,
        roughness,
        fitness,
        fit_steps,
        warnings: surface.warnings.iter().map(|warning| FrontEnd::Python.text(warning)).collect(),
    })
}

fn holds_map(in_memory: &Bound<PyDict>) -> PyResult<bool> {
    Ok(in_memory.iter().any(|(_, value)| value.cast::<Map>().is_ok()))
}

fn spec_has_map(spec: &Bound<PyDict>) -> PyResult<bool> {
    let Some(surfaces) = spec.get_item("surface")? else { return Ok(false) };
    let surfaces = surfaces.cast_into::<PyDict>().map_err(|error| refuse(error.to_string()))?;
    let is_map = |kind: &Bound<PyAny>| {
        kind.contains("generate").unwrap_or(false) || kind.contains("file").unwrap_or(false)
    };
    Ok(surfaces.iter().all(|(_, kind)| is_map(&kind)))
}
