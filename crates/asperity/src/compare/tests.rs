//! The responses, pairs and differences that tests of comparisons are made of.

use super::{Difference, Estimate, Pair, Pairing, Support};
use crate::contact::ByRegime;
use crate::model::{LoadSharing, Response};

pub fn sharing(effective_contacts: f64) -> LoadSharing {
    LoadSharing { effective_contacts, largest_share: 0.01, large_strain_share: 0.0 }
}

/// Elastic contacts under 100 Pa at h sigma of 1e-8 m.
pub fn response(h: f64, area_ratio: f64, contacts: Option<f64>) -> Response {
    Response {
        separation_over_sigma: h,
        separation: h * 1e-8,
        contact_density: 100.0,
        area_ratio: ByRegime([area_ratio, 0.0, 0.0]),
        pressure: ByRegime([100.0, 0.0, 0.0]),
        stiffness: 1e14,
        spots: Default::default(),
        sampling: None,
        sharing: contacts.map(sharing),
    }
}

/// At equal load.
pub fn pair(target: f64, statistical: Response, deterministic: Response) -> Pair {
    Pair { pairing: Pairing::Load, target, statistical, deterministic }
}

pub fn estimate(contrast: f64, error: Option<f64>) -> Estimate {
    Estimate {
        contrast,
        error,
        quantile: 2.0,
        bound: 0.0,
        independent_error: None,
        support: Support::Sampled,
    }
}

/// One load with the same contrast and error of separation and area.
pub fn at(load: f64, contacts: f64, contrast: f64, error: Option<f64>) -> Difference {
    let estimate = Some(estimate(contrast, error));
    Difference {
        load,
        sharing: Some(sharing(contacts)),
        area_ratio: 0.01,
        estimates: [estimate, estimate, None, None, None, None],
        of_models: [None; 2],
        area_needed: error.is_none().then_some(3.0),
    }
}
