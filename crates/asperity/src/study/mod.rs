//! A study: both models on a surface under laws and layers, with all that follows from them: differences with their sampling errors,
//! causes, verdicts, other statistical models, other treatments of a map.
//!
//! | module | what lives there |
//! |---|---|
//! | `setup` | what the models are run with |
//! | `models` | the statistical model, and both models on a surface |
//! | `run` | both models on one realisation |
//! | `results` | a realisation, and a case over all realisations |
//! | `at_load` | what the models say at one load |
//! | `sampling` | sampling errors, from groups of asperities left out or from surfaces of a fitted process |
//! | `attribution` | the differences divided among their causes |
//! | `verdicts` | whether the integral may replace the sum; which model is nearer to the reference |
//! | `ranking`, `held_out` | the other statistical models; fitted ones on asperities that they were not taken from |
//! | `treatment`, `dependence` | other treatments of a measured map, both models under them, and the verdicts that depend on them |
//! | `layer` | what a layer changes; the friction of a film by its thickness |

mod at_load;
mod attribution;
mod dependence;
mod held_out;
mod layer;
mod models;
mod ranking;
mod results;
mod run;
mod sampling;
mod setup;
mod treatment;
mod two_bodies;
mod verdicts;

pub use at_load::{LoadResults, ModelResult, PointResult};
pub use attribution::{LeadingCause, StatedCause, attribute};
pub use dependence::{Dependence, Treated};
pub use held_out::HeldOut;
pub use layer::{
    DecreaseResults, Film, FilmFriction, LawFindings, LayerFindings, LayerQuestion, Threshold, film_friction,
    thresholds,
};
pub use models::{JointModel, StatisticalModel, SurfaceModels};
pub use ranking::{Against, Largest, LargestErrors, Ranked, Ranking, Standing, is_within, rank};
pub use results::{CaseResults, CaseStudy, RealisationFacts, RealisationResults, ReferenceVerdicts};
pub use run::{StudyError, decreases, differ, models_of, run_surface, study, verdicts};
pub use sampling::{GENERATED_SURFACES, sampling};
pub use setup::{LawContact, Setup};
pub use treatment::{Choice, TreatedCases, Treatment, under_treatments};
pub use two_bodies::{GreenwoodTrippPoint, Shortcut, ShortcutResult, greenwood_tripp_curves, shortcuts};
pub use verdicts::{Basis, Verdicts};
