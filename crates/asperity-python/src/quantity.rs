//! Quantities of arguments: numbers in SI, or texts with a unit.

use asperity_contact_framework::input::bare::{
    NominalAreaRange, NominalPressureRange, PixelRange, SigmaRange,
};
use asperity_contact_framework::input::quantity::{
    Area, ArealNumberDensity, Dimension, Force, Length, NotNegative, Positive, Pressure, Quantity, Range,
};
use pyo3::prelude::*;

use crate::refuse;

/// A value in SI, and why it is hardly meant.
type Read = (f64, Option<String>);

/// A number that a spec would refuse without its unit is doubted. Its range is its user's to check.
fn bare<R: Range>(number: f64, name: &str) -> Read {
    let bare = R::BARE.filter(|_| R::holds(number));
    let doubt = bare.and_then(|bare| bare.check(number, &number.to_string()).err());
    (number, doubt.map(|doubt| format!("{name}: {doubt}")))
}

fn read<D: Dimension, R: Range>(value: &Bound<PyAny>, name: &str) -> PyResult<Read> {
    if let Ok(text) = value.extract::<String>() {
        let read = Quantity::<D, R>::parse(&text).map_err(|error| refuse(format!("{name}: {error}")))?;
        return Ok((read.value(), None));
    }
    let Ok(number) = value.extract::<f64>() else {
        let (kind, allowed) = (value.get_type().name()?, D::allowed());
        return Err(refuse(format!("{name}: found a {kind}; allowed: a number, or a text with a {allowed}")));
    };
    Ok(bare::<R>(number, name))
}

/// Warns at the line that has called this package.
fn warn(py: Python, doubt: Option<String>) -> PyResult<()> {
    let Some(doubt) = doubt else { return Ok(()) };
    py.import("asperity.arguments")?.call_method1("warn", ([doubt],)).map(drop)
}

/// An argument in SI.
pub fn si<D: Dimension, R: Range>(value: &Bound<PyAny>, name: &str) -> PyResult<f64> {
    let (number, doubt) = read::<D, R>(value, name)?;
    warn(value.py(), doubt)?;
    Ok(number)
}

/// The same of one that may be left out.
pub fn si_or_none<D: Dimension, R: Range>(value: Option<&Bound<PyAny>>, name: &str) -> PyResult<Option<f64>> {
    value.map(|value| si::<D, R>(value, name)).transpose()
}

/// The same of a list, of which one value is one.
pub fn list<D: Dimension, R: Range>(values: &Bound<PyAny>, name: &str) -> PyResult<Vec<f64>> {
    let dimensions: usize = values.py().import("numpy")?.call_method1("ndim", (values,))?.extract()?;
    if dimensions == 0 {
        return Ok(vec![si::<D, R>(values, name)?]);
    }
    let read: PyResult<Vec<Read>> = values.try_iter()?.map(|item| read::<D, R>(&item?, name)).collect();
    let (numbers, doubts): (Vec<f64>, Vec<Option<String>>) = read?.into_iter().unzip();
    warn(values.py(), doubts.into_iter().flatten().next())?;
    Ok(numbers)
}

/// An argument of a function in Python, and why it is hardly meant.
#[pyfunction]
#[pyo3(name = "si")]
pub fn si_of_kind(value: &Bound<PyAny>, name: &str, kind: &str) -> PyResult<Read> {
    let read = match kind {
        "pixel" => read::<Length, PixelRange>,
        "sigma" => read::<Length, SigmaRange>,
        "distance" => read::<Length, NotNegative>,
        "area" => read::<Area, NominalAreaRange>,
        "density" => read::<ArealNumberDensity, Positive>,
        "pressure" => read::<Pressure, NominalPressureRange>,
        "stress" => read::<Pressure, Positive>,
        "force" => read::<Force, Positive>,
        _ => read::<Length, Positive>,
    };
    read(value, name)
}
