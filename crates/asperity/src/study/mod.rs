//! A study: both models on a surface under laws and layers, with all that follows from them: differences with their sampling errors,
//! causes, verdicts, other statistical models, other treatments of a map.
//!
//! | module | what lives there |
//! |---|---|
//! | `setup` | what the models are run with |
//! | `statistical`, `models` | the statistical model, and both models on a surface |
//! | `law` | a law on two bodies |
//! | `run` | both models on one realisation |
//! | `results` | a realisation, and a case on it |
//! | `at_load` | what the models say at one load |
//! | `case` | a case over all realisations: verdicts, ranking, treatments |
//! | `sampling` | sampling errors, from groups of asperities left out |
//! | `generated` | both models on surfaces of a process that was fitted to a small map, and on its halves |
//! | `attribution`, `causes` | the differences divided among their causes |
//! | `verdicts`, `reference` | whether the integral may replace the sum; which model is nearer to the reference |
//! | `ranking`, `held_out` | the other statistical models; fitted ones on asperities that they were not taken from |
//! | `treatment`, `robustness`, `dependence` | other treatments of a measured map, both models under them, and the verdicts that depend on them |
//! | `layer`, `threshold`, `film` | what a layer changes; the friction of a film by its thickness |

mod at_load;
mod attribution;
mod case;
mod causes;
mod dependence;
mod film;
mod generated;
mod held_out;
mod law;
mod layer;
mod models;
mod ranking;
mod reference;
mod results;
mod robustness;
mod run;
mod sampling;
mod setup;
mod statistical;
mod threshold;
mod treatment;
mod two_bodies;
mod verdicts;

pub use at_load::{LoadResults, ModelResult, PointResult};
pub use attribution::attribute;
pub use case::CaseStudy;
pub use causes::{LeadingCause, StatedCause};
pub use dependence::{Dependence, Treated};
pub use film::{Film, FilmFriction, film_friction};
pub use generated::GENERATED_SURFACES;
pub use held_out::HeldOut;
pub use law::LawContact;
pub use layer::{DecreaseResults, LawFindings, LayerFindings, Threshold};
pub use models::SurfaceModels;
pub use ranking::{Against, Largest, LargestErrors, Ranked, Ranking, Standing, is_within, rank};
pub use reference::ReferenceVerdicts;
pub use results::{CaseResults, RealisationFacts, RealisationResults};
pub use robustness::{TreatedCases, under_treatments};
pub use run::{StudyError, decreases, differ, models_of, run_surface, study, verdicts};
pub use sampling::sampling;
pub use setup::Setup;
pub use statistical::{JointModel, StatisticalModel};
pub use threshold::{LayerQuestion, thresholds};
pub use treatment::{Choice, Treatment};
pub use two_bodies::{GreenwoodTrippPoint, Shortcut, ShortcutResult, greenwood_tripp_curves, shortcuts};
pub use verdicts::{Basis, Verdicts};
