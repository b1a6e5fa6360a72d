//! `[laws]`: several laws on one asperity and on given surfaces.

mod outline;
mod rows;

use std::fmt;
use std::path::PathBuf;

use asperity::compare::Controls;
use asperity::surface::AnalysisDepth;
use asperity::{ContactLaw, Hertz, Law, Pair, Shape, Zmc};
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::bare::NominalPressureRange;
use asperity_contact_framework::input::quantity::{Length, Pressure, Pure, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile, law, materials};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Kind, Memory, Outcome, Plan, RunContext};
use schemars::JsonSchema;
use serde::Deserialize;

use super::compare::spec::ComparePlan;
use crate::study_plan::{RoughBody, SpotKeys, StatisticalSpec, StudyKeys, StudyPlan};
use crate::surface::{curvature_ratio, inputs, memory};

pub struct Laws;

impl Kind for Laws {
    const NAME: &'static str = "laws";
    type Spec = LawsSpec;
    type Plan = LawsPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<LawsPlan, InputError> {
        let (raw, span) = (table.get_ref(), table.span());
        let laws = &raw.law.get_ref().0;
        if let [only] = &laws[..] {
            let message = format!(
                "found only \"{}\"; allowed: a list of at least two laws, the first of which is the reference",
                only.label()
            );
            return Err(file.source.error_at(raw.law.span(), message));
        }
        let study = StudyPlan::new(
            file,
            StudyKeys {
                table: span,
                rough: &raw.rough,
                flat: &raw.flat,
                law: &raw.law,
                layer: None,
                spots: SpotKeys::default(),
                statistical: raw.statistical.as_ref(),
                accept: raw.accept,
                surfaces: raw.surfaces.as_deref(),
                controls: Controls::at_pressures(raw.pressure.get_ref().values.clone()),
                nominal_area: None,
                load_keys: [Some(raw.pressure.span()), None],
            },
        )?;
        study.check_summed(file, None)?;
        let [rough, flat] = &study.pair;
        let zmc = Zmc::default();
        let pair = Pair::between(&zmc, rough, flat).ok().filter(|pair| pair.yield_limits.onset.is_finite());
        let Some(pair) = pair else {
            let message = format!(
                "found no `hardness` in {}, which [laws] needs for at least one body to normalise indentations by the onset of \
                 yield; allowed: hardness = \"...\" with a unit of pressure",
                materials(&study.bodies.rough, &study.bodies.flat)
            );
            let at = file.material_at(&study.bodies.rough).unwrap_or_else(|| raw.rough.span());
            return Err(file.source.error_at(at, message));
        };
        let asperity = raw.asperity.get_ref();
        let is_elliptic = laws.iter().any(ContactLaw::is_elliptic);
        let given = asperity.curvature_ratio.as_ref();
        let ratio = curvature_ratio(&file.source, &raw.asperity.span(), given, is_elliptic)?;
        let radius = asperity.radius.value();
        Ok(LawsPlan {
            critical: Critical::new(&pair, radius),
            radius,
            curvature_ratio: ratio.filter(|_| is_elliptic).unwrap_or(1.0),
            ratios: file.growing(&raw.indentation)?,
            compare: ComparePlan::of_models(study),
        })
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}

impl Plan for LawsPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.compare.study.surfaces)
    }

    fn memory(&self) -> Memory {
        memory(&self.compare.study.surfaces, AnalysisDepth::Comparison, self.compare.is_robustness_examined)
    }

    fn work(&self) -> u128 {
        self.compare.study.work() + (self.ratios.len() * self.compare.study.laws.len()) as u128
    }

    fn check(&self, context: &RunContext) -> Result<(), InputError> {
        self.compare.check(context)
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(rows::run(context, self)?))
    }
}

/// Several laws on one asperity and on given surfaces.
pub struct LawsPlan {
    /// Both models on the surfaces under every law.
    pub compare: ComparePlan,
    /// 1/(mean curvature) of the asperity, m.
    pub radius: f64,
    /// Its larger principal curvature over the smaller one; 1 without elliptic laws.
    pub curvature_ratio: f64,
    /// The unit of indentation.
    pub critical: Critical,
    /// w/wc, ascending, at least two.
    pub ratios: Vec<f64>,
}

/// Where the asperity, taken as a sphere, begins to yield by Zhao, Maietta and Chang: the unit for all laws, also for
/// those with an onset of their own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Critical {
    /// wc = (0.3 pi)^2 R (H/E*)^2, m.
    pub indentation: f64,
    /// The Hertz load there, N.
    pub load: f64,
    /// The Hertz area there, m^2.
    pub area: f64,
}

impl Critical {
    /// That of a pair with a hardness and a sphere of radius `radius` (m).
    fn new(pair: &Pair, radius: f64) -> Self {
        let indentation = pair.ratio(Zmc::ONSET) * radius;
        let contact = Hertz.contact(indentation, radius, pair);
        Self { indentation, load: contact.load, area: contact.area }
    }
}

impl LawsPlan {
    /// The asperity as a sphere or an ellipse, as the law requires.
    pub fn shape(&self, law: &ContactLaw) -> Shape {
        law.shape(self.radius, self.curvature_ratio)
    }
}

impl fmt::Display for LawsPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.compare)?;
        writeln!(
            f,
            "  one asperity of radius {:e} m at {} indentations of {:e} to {:e} wc, wc = {:.2e} m",
            self.radius,
            self.ratios.len(),
            self.ratios[0],
            self.ratios[self.ratios.len() - 1],
            self.critical.indentation
        )
    }
}

/// Several laws on one asperity, and on surfaces under both models: does the law matter more than the summation?
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LawsSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<RoughBody>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact laws, at least two; the others are compared with the first.
    #[schemars(extend("examples" = [["zmc", "hertz", "jackson-green"]]))]
    pub law: Spanned<law::Laws>,
    /// The asperity on which the laws are shown by themselves.
    #[schemars(extend("examples" = [{ "radius": "20 um" }]))]
    pub asperity: Spanned<AsperitySpec>,
    /// How far it is pressed, over the indentation at which it begins to yield by Zhao, Maietta and Chang.
    #[schemars(extend("examples" = [{ "from": 0.1, "to": 1000, "points": 200 }]))]
    pub indentation: Spanned<LogSweep<Pure>>,
    /// Nominal pressures at which the laws are compared on surfaces.
    #[schemars(extend("examples" = [{ "from": "0.1 MPa", "to": "100 MPa", "points": 31 }]))]
    pub pressure: Spanned<LogSweep<Pressure, NominalPressureRange>>,
    /// Which statistical model runs.
    #[schemars(extend("x-default" = "Gaussian heights, arithmetic mean radius", "examples" = [{ "heights": "own" }]))]
    pub statistical: Option<Spanned<StatisticalSpec>>,
    /// The largest differences between the models that do not matter to you; verdicts refer to them.
    #[serde(default)]
    #[schemars(extend("examples" = [{ "area": "10 %", "separation": 0.1, "stiffness": "20 %" }]))]
    pub accept: AcceptSpec,
    /// The surfaces to run on, by name.
    #[schemars(extend("x-default" = "all of the file", "examples" = [["ground"]]))]
    pub surfaces: Option<Vec<Spanned<String>>>,
}

/// One asperity.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table such as { radius = \"20 um\" }, and curvature-ratio for elliptic laws"
)]
pub struct AsperitySpec {
    /// Its radius, 1/(mean curvature).
    #[schemars(extend("examples" = ["20 um"]))]
    pub radius: Quantity<Length>,
    /// The larger principal curvature over the smaller one; needed by elliptic laws.
    #[schemars(extend("x-range" = "1 to 1e6", "examples" = [2]))]
    pub curvature_ratio: Option<Spanned<Quantity<Pure>>>,
}
