//! How far a contact is from that of the same waves on a finer grid, estimated from the outline of the contact.
//!
//! The border lies somewhere between a point in contact and its neighbour, and only there a grid errs in first order. M sides of pixels
//! along the axis that has more of them, per point in contact, say how narrow the contacts are: 2/M points on average. The
//! errors follow a part that all sides share and one that averages over the P places of the border that are independent.
//! docs/theory.md, section 9, says on which surfaces the factors were measured.

use super::Contact;

/// Largest errors by the grid: each is exceeded by at most a twentieth of the contacts on such surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridError {
    /// Of the logarithm of the corrected area.
    pub area: f64,
    /// Of the logarithm of the load at a mean gap; times load over stiffness it is that of the mean gap at a load.
    pub load: f64,
    /// Of the logarithm of the stiffness.
    pub stiffness: f64,
}

impl GridError {
    /// Of `contact`, without any where it has no border.
    pub fn new(contact: &Contact) -> Self {
        let [x, y] = contact.outline().map(|sides| sides as f64);
        let most = x.max(y);
        if most == 0.0 {
            return Self { area: 0.0, load: 0.0, stiffness: 0.0 };
        }
        let (raw, all) = (contact.raw_area_ratio(), contact.pressures().len() as f64);
        let narrowness = most / (raw * all);
        let elongation = 1.0 - x.min(y) / most;
        // Sides and points in a row along the shorter side of a pixel are not independent.
        let [dx, dy] = contact.pixel;
        let (shorter, longer) = (dx.min(dy), dx.max(dy));
        let of_border = narrowness / ((x * dy + y * dx) / longer).sqrt();
        // Points at the cap stay at it; few others are left that respond, and each of them counts.
        let capped = contact.capped_area_ratio() / raw;
        let free = (raw - contact.capped_area_ratio()) * all * shorter / longer;
        let of_free = if capped > 0.0 { capped / free.max(1.0).sqrt() } else { 0.0 };
        // The correction is that of an elastic half-space, whose pressure falls to zero.
        let unsure = if contact.is_layered { 1.0 } else { capped };
        let correction = raw / contact.area_ratio() - 1.0;
        let part = 0.15 + 0.6 * elongation.powi(4) + 0.5 * unsure;
        Self {
            area: part * correction + of_border + 0.02 * narrowness.powi(4),
            load: 0.018 * narrowness.powi(4) + 0.2 * (narrowness * of_border + of_free),
            stiffness: 0.03 * correction + 0.9 * of_border + 0.005 * narrowness.powi(4) + 1.5 * of_free,
        }
    }
}
