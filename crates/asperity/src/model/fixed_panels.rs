//! Panels of the statistical integral that are the same at all separations, with the contacts at their nodes.

use super::weight::Weight;
use crate::contact::ContactColumns;
use crate::interface::MicroContact;
use crate::numeric::quadrature::{Variable, panels};
use crate::shape::Shape;

/// Breakpoints below this fraction of the window are omitted.
pub(super) const NEGLIGIBLE: f64 = 1e-40;

/// The largest ratio of a panel's ends at which it resolves a logarithm in w to full accuracy.
const RATIO_PER_PANEL: f64 = 56.0;

/// One panel after the other from an indentation of 0 to the last breakpoint. Indentations are in units of sigma.
#[derive(Debug, Clone, Default)]
pub(super) struct FixedPanels {
    /// The upper end of each panel.
    ends: Vec<f64>,
    /// Nodes of all panels.
    pub(super) points: Vec<f64>,
    pub(super) weights: Vec<f64>,
    /// The contacts at the nodes.
    pub(super) contacts: ContactColumns,
}

impl FixedPanels {
    /// Panels between `breakpoints` up to `most`.
    pub(super) fn new(
        contact: &dyn MicroContact,
        shape: Shape,
        sigma: f64,
        breakpoints: &[f64],
        most: f64,
    ) -> Self {
        let mut fixed = Self::default();
        let is_used = |to: &f64| NEGLIGIBLE * most < *to && *to < most;
        for to in breakpoints.iter().copied().filter(is_used) {
            let from = fixed.end(fixed.ends.len());
            if to <= from {
                continue;
            }
            for [low, high] in spans(from, to, from > 0.0) {
                for panel in panels(low, high, Variable::SquareRoot, 1) {
                    fixed.points.extend(panel.points);
                    fixed.weights.extend(panel.weights);
                }
                fixed.ends.push(high);
            }
        }
        let indentations: Vec<f64> = fixed.points.iter().map(|x| x * sigma).collect();
        fixed.contacts = contact.contacts(&indentations, shape);
        fixed
    }

    /// The end of the first `count` panels.
    pub(super) fn end(&self, count: usize) -> f64 {
        if count == 0 { 0.0 } else { self.ends[count - 1] }
    }

    /// How many panels, from the first on, are within the window of `weight` at the separation `h` and resolve it.
    pub(super) fn resolved(&self, weight: &dyn Weight, h: f64) -> usize {
        let [start, end] = weight.window(h);
        let resolves = |k: usize| self.ends[k] <= end && weight.panels(h, self.end(k), self.ends[k]) == 1;
        if start > 0.0 { 0 } else { (0..self.ends.len()).take_while(|&k| resolves(k)).count() }
    }
}

/// Divides [from, to] into pieces, of a bounded ratio of their ends if the integrand contains a logarithm of w.
pub(super) fn spans(from: f64, to: f64, logarithmic: bool) -> impl Iterator<Item = [f64; 2]> {
    let ratio = to / from;
    let count = if logarithmic { (ratio.ln() / RATIO_PER_PANEL.ln()).ceil().max(1.0) as i32 } else { 1 };
    let end = move |k: i32| match k {
        0 => from,
        k if k == count => to,
        k => from * ratio.powf(f64::from(k) / f64::from(count)),
    };
    (0..count).map(move |k| [end(k), end(k + 1)])
}
