//! Bodies and laws.

use std::collections::BTreeMap;
use std::sync::Arc;

use asperity::contact_law::{self, ContactLaw};
use asperity::law::Body;
use asperity::{Flat, MicroContact, ModulusModel, Shape, material_library};
use asperity_contact_framework::input::bare::{
    HardnessRange, ModulusRange, ResistivityRange, ThermalConductivityRange, ThicknessOrNone, YieldRange,
};
use asperity_contact_framework::input::quantity::{
    Finite, Length, Positive, Pressure, Resistivity, ThermalConductivity,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use crate::quantity::{list, si, si_or_none};
use crate::refuse;

/// An elastic body, which may yield.
///
/// Parameters
/// ----------
/// young : float or str
///     Young's modulus in Pa, or with its unit: ``"210 GPa"``. A number that is hardly meant in SI, here or below, is warned of.
/// poisson : float
///     Poisson's ratio.
/// hardness : float or str, optional
///     Indentation hardness in Pa; without it the body never yields.
/// yield_strength : float or str, optional
///     Yield strength in Pa, for the law ``jackson-green``.
/// resistivity : float or str, optional
///     Electrical resistivity in ohm m, for electrical conductances.
/// thermal_conductivity : float or str, optional
///     Thermal conductivity in W/(m K), for thermal conductances.
///
/// Raises
/// ------
/// ValueError
///     A value that no body has.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> asperity.Material(210e9, 0.3, hardness=7.6e9)
/// Material(young=2.1e11, poisson=0.3, hardness=7.6e9)
#[pyclass(module = "asperity", frozen, eq, from_py_object)]
#[derive(Clone, PartialEq)]
pub struct Material(pub asperity::Material);

#[pymethods]
impl Material {
    #[new]
    #[pyo3(signature = (young, poisson, *, hardness=None, yield_strength=None, resistivity=None, thermal_conductivity=None))]
    fn new(
        young: &Bound<PyAny>,
        poisson: f64,
        hardness: Option<&Bound<PyAny>>,
        yield_strength: Option<&Bound<PyAny>>,
        resistivity: Option<&Bound<PyAny>>,
        thermal_conductivity: Option<&Bound<PyAny>>,
    ) -> PyResult<Self> {
        let young = si::<Pressure, ModulusRange>(young, "young")?;
        let hardness = si_or_none::<Pressure, HardnessRange>(hardness, "hardness")?;
        let yield_strength = si_or_none::<Pressure, YieldRange>(yield_strength, "yield_strength")?;
        let resistivity = si_or_none::<Resistivity, ResistivityRange>(resistivity, "resistivity")?;
        let thermal_conductivity = si_or_none::<ThermalConductivity, ThermalConductivityRange>(
            thermal_conductivity,
            "thermal_conductivity",
        )?;
        asperity::Material::new(young, poisson, hardness, yield_strength)
            .and_then(|material| material.conducting(resistivity, thermal_conductivity))
            .map(Self)
            .map_err(refuse)
    }

    /// A material of the library, such as ``"steel-100Cr6"``; ``experiment materials`` lists them with their sources.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     A name that the library does not have, with similar ones.
    #[staticmethod]
    fn named(name: &str) -> PyResult<Self> {
        let found = material_library::find(name).ok_or_else(|| {
            let similar = material_library::similar(name).join(", ");
            refuse(format!(
                "found \"{name}\"; allowed: a material of the library{}",
                if similar.is_empty() { String::new() } else { format!(" (similar names: {similar})") }
            ))
        })?;
        found.material().map(Self).map_err(refuse)
    }

    /// The names of all materials of the library.
    #[staticmethod]
    fn names() -> Vec<&'static str> {
        material_library::all().map(|material| material.name).collect()
    }

    /// Young's modulus in Pa.
    #[getter]
    fn young(&self) -> f64 {
        self.0.young()
    }

    /// Poisson's ratio.
    #[getter]
    fn poisson(&self) -> f64 {
        self.0.poisson()
    }

    /// Indentation hardness in Pa, or None.
    #[getter]
    fn hardness(&self) -> Option<f64> {
        self.0.hardness()
    }

    /// Yield strength in Pa, or None.
    #[getter]
    fn yield_strength(&self) -> Option<f64> {
        self.0.yield_strength()
    }

    /// Electrical resistivity in ohm m, or None.
    #[getter]
    fn resistivity(&self) -> Option<f64> {
        self.0.resistivity()
    }

    /// Thermal conductivity in W/(m K), or None.
    #[getter]
    fn thermal_conductivity(&self) -> Option<f64> {
        self.0.thermal_conductivity()
    }

    fn __hash__(&self, py: Python) -> PyResult<isize> {
        PyString::new(py, &self.__repr__()).hash()
    }

    fn __repr__(&self) -> String {
        let mut text = format!("Material(young={:e}, poisson={}", self.0.young(), self.0.poisson());
        let others = [
            ("hardness", self.hardness()),
            ("yield_strength", self.yield_strength()),
            ("resistivity", self.resistivity()),
            ("thermal_conductivity", self.thermal_conductivity()),
        ];
        for (name, value) in others {
            if let Some(value) = value {
                text += &format!(", {name}={value:e}");
            }
        }
        text + ")"
    }
}

/// A contact law of one asperity, with its options.
///
/// Parameters
/// ----------
/// name : str
///     One of ``Law.names()``.
/// **options : float
///     Options of the law, with ``_`` for ``-``; ``options`` lists them.
///
/// Raises
/// ------
/// ValueError
///     An unknown law or option, or a value out of range.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> asperity.Law("zmc", transition_ratio=110)
/// Law("zmc", transition_ratio=110)
/// >>> asperity.Law.names()[:2]
/// ['hertz', 'zmc']
#[pyclass(module = "asperity", frozen, eq, from_py_object)]
#[derive(Clone, PartialEq)]
pub struct Law(pub ContactLaw);

#[pymethods]
impl Law {
    #[new]
    #[pyo3(signature = (name, **options))]
    fn new(name: &str, options: Option<BTreeMap<String, f64>>) -> PyResult<Self> {
        let law = contact_law::named(name).ok_or_else(|| {
            refuse(format!("found the law \"{name}\"; allowed: {}", Self::names().join(", ")))
        })?;
        let options: Vec<(String, f64)> = options
            .unwrap_or_default()
            .into_iter()
            .map(|(name, value)| (name.replace('_', "-"), value))
            .collect();
        let options: Vec<(&str, f64)> = options.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        law.with_options(&options).map(Self).map_err(|error| refuse(format!("law {name}: {error}")))
    }

    /// The names of all laws.
    #[staticmethod]
    fn names() -> Vec<String> {
        contact_law::registry().iter().map(ContactLaw::name).collect()
    }

    /// The name of the law.
    #[getter]
    fn name(&self) -> String {
        self.0.name()
    }

    /// Description and range of validity.
    #[getter]
    fn about(&self) -> &'static str {
        self.0.about()
    }

    /// All options and their values.
    #[getter]
    fn options<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let options = PyDict::new(py);
        for (option, value) in self.0.law().options().iter().zip(self.0.law().option_values()) {
            options.set_item(option.name.replace('-', "_"), value)?;
        }
        Ok(options)
    }

    /// The options that were given or differ from their defaults.
    #[getter]
    fn given(&self) -> BTreeMap<String, f64> {
        self.0.options_given().map(|(name, value)| (name.replace('-', "_"), value)).collect()
    }

    /// The sources of the law.
    #[getter]
    fn papers(&self) -> Vec<String> {
        self.0.papers().iter().map(|paper| paper.full.to_owned()).collect()
    }

    fn __repr__(&self) -> String {
        let options: String = self
            .0
            .options_given()
            .map(|(name, value)| format!(", {}={value}", name.replace('-', "_")))
            .collect();
        format!("Law(\"{}\"{options})", self.0.name())
    }
}

/// A law by its name or as an object.
#[derive(FromPyObject)]
enum LawOrName {
    Law(Law),
    Name(String),
}

/// Two bodies under a law: a rough one and a flat, one of which may have a layer.
///
/// Parameters
/// ----------
/// rough, flat : Material
///     The bodies; the one that has the layer is its substrate.
/// law : str or Law
///     The contact law.
/// layer : Material, optional
///     The material of the layer.
/// thickness : float or str, optional
///     Its thickness in m, or with its unit: 0 for the bare body, ``math.inf`` for the bulk of the layer.
/// rule : {"gao", "series"}
///     How the moduli of layer and substrate combine (Gao, Chiu and Lee 1992; Song and Pharr 1999).
/// on : {"flat", "rough"}
///     The body that has the layer. On the rough body each coated asperity is taken as a layered half-space: its radius must be
///     large against the thickness, and heights and radii are those of the coated surface.
///
/// Raises
/// ------
/// ValueError
///     Bodies that the law or the layer does not apply to.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> steel = asperity.Material(210e9, 0.3, hardness=7.6e9)
/// >>> f"{asperity.Interface(steel, steel).reduced_modulus:.4g}"
/// '1.154e+11'
#[pyclass(module = "asperity", frozen)]
pub struct Interface {
    pub contact: Arc<dyn MicroContact>,
    /// The rough body.
    #[pyo3(get)]
    rough: Material,
    /// The flat.
    #[pyo3(get)]
    flat: Material,
    /// The contact law.
    #[pyo3(get)]
    pub law: Law,
    /// The material of the layer, or None.
    #[pyo3(get)]
    layer: Option<Material>,
    /// The thickness of the layer in m, or None.
    #[pyo3(get)]
    thickness: Option<f64>,
    /// How the moduli of layer and substrate combine.
    #[pyo3(get)]
    rule: &'static str,
    on: Body,
}

#[pymethods]
impl Interface {
    #[new]
    #[pyo3(signature = (rough, flat, law=LawOrName::Name("zmc".to_owned()), *, layer=None, thickness=None, rule="gao", on="flat"))]
    fn new(
        rough: Material,
        flat: Material,
        law: LawOrName,
        layer: Option<Material>,
        thickness: Option<&Bound<PyAny>>,
        rule: &str,
        on: &str,
    ) -> PyResult<Self> {
        let thickness = si_or_none::<Length, ThicknessOrNone>(thickness, "thickness")?;
        let law = match law {
            LawOrName::Law(law) => law,
            LawOrName::Name(name) => Law::new(&name, None)?,
        };
        let model = ModulusModel::ALL.into_iter().find(|model| model.name() == rule).ok_or_else(|| {
            let allowed: Vec<&str> = ModulusModel::ALL.iter().map(|model| model.name()).collect();
            refuse(format!("rule: found \"{rule}\"; allowed: {}", allowed.join(", ")))
        })?;
        let on = Body::ALL.into_iter().find(|body| body.name() == on).ok_or_else(|| {
            let allowed = Body::ALL.map(Body::name).join(", ");
            refuse(format!("on: found \"{on}\"; allowed: {allowed}"))
        })?;
        let (bare, substrate) = match on {
            Body::Rough => (&flat, &rough),
            Body::Flat => (&rough, &flat),
        };
        let layered = match (&layer, thickness) {
            (Some(layer), Some(thickness)) => {
                Flat::with_layer(&layer.0, &substrate.0, thickness, model).map_err(refuse)?
            }
            (None, None) => Flat::Bare(substrate.0),
            _ => return Err(refuse("found only one of layer and thickness; allowed: both or none")),
        };
        let contact = law.0.interface_of(&layered, on, &bare.0).map_err(refuse)?;
        Ok(Self { contact: Arc::from(contact), rough, flat, law, layer, thickness, rule: model.name(), on })
    }

    /// The body that has the layer: ``"flat"`` or ``"rough"``; ``"flat"`` without one.
    #[getter]
    fn on(&self) -> &'static str {
        self.on.name()
    }

    /// Reduced modulus E* of the pair without a layer in Pa.
    #[getter]
    fn reduced_modulus(&self) -> f64 {
        self.contact.reference_modulus()
    }

    /// The contact of one asperity.
    ///
    /// Parameters
    /// ----------
    /// indentation : float, str or array_like
    ///     Indentations in m; there is no contact at 0 and below.
    /// radius : float or str
    ///     1/(mean curvature) of the asperity in m.
    /// curvature_ratio : float
    ///     The larger principal curvature over the smaller one, for laws for ellipses.
    ///
    /// Returns
    /// -------
    /// dict of str to ndarray
    ///     ``area_m2``, ``load_n``, ``stiffness_n_per_m`` and ``regime``.
    ///
    /// Examples
    /// --------
    /// >>> import asperity
    /// >>> steel = asperity.Material(210e9, 0.3)
    /// >>> contact = asperity.Interface(steel, steel, "hertz")
    /// >>> contact.contact(1e-9, 20e-6)["load_n"].round(8)
    /// array([2.176e-05])
    #[pyo3(signature = (indentation, radius, *, curvature_ratio=1.0))]
    fn contact<'py>(
        &self,
        indentation: &Bound<'py, PyAny>,
        radius: &Bound<PyAny>,
        curvature_ratio: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let py = indentation.py();
        let indentation = list::<Length, Finite>(indentation, "indentation")?;
        let radius = si::<Length, Positive>(radius, "radius")?;
        let is_admissible = |value: f64| value > 0.0 && value.is_finite();
        if !is_admissible(radius) {
            return Err(refuse(format!("radius: found {radius}; allowed: positive and finite, m")));
        }
        if !(1.0..=1e6).contains(&curvature_ratio) {
            return Err(refuse(format!("curvature_ratio: found {curvature_ratio}; allowed: 1 to 1e6")));
        }
        if let Some(w) = indentation.iter().find(|w| !w.is_finite()) {
            return Err(refuse(format!("indentation: found {w}; allowed: finite numbers, m")));
        }
        let shape: Shape = self.law.0.shape(radius, curvature_ratio);
        let contacts: Vec<_> =
            indentation.iter().map(|&w| (w > 0.0).then(|| self.contact.contact(w, shape))).collect();
        let dict = PyDict::new(py);
        let column = |of: fn(&asperity::Contact) -> f64| {
            let values = contacts.iter().map(|contact| contact.as_ref().map_or(0.0, of)).collect();
            PyArray1::from_vec(py, values)
        };
        dict.set_item("area_m2", column(|contact| contact.area))?;
        dict.set_item("load_n", column(|contact| contact.load))?;
        dict.set_item("stiffness_n_per_m", column(|contact| contact.stiffness))?;
        let regimes: Vec<&str> = contacts
            .iter()
            .map(|contact| contact.as_ref().map_or("none", |contact| contact.regime.name()))
            .collect();
        dict.set_item("regime", py.import("numpy")?.call_method1("array", (regimes,))?)?;
        Ok(dict)
    }

    fn __repr__(&self) -> String {
        let [rough, flat] = [&self.rough, &self.flat].map(Material::__repr__);
        let mut text = format!("Interface(rough={rough}, flat={flat}, law={}", self.law.__repr__());
        if let (Some(layer), Some(thickness)) = (&self.layer, self.thickness) {
            let (layer, rule, on) = (layer.__repr__(), self.rule, self.on());
            text += &format!(", layer={layer}, thickness={thickness:e}, rule=\"{rule}\", on=\"{on}\"");
        }
        text + ")"
    }
}
