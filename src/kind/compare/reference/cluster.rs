//! The spots of the sum on a finite map as a cluster between half-spaces (Greenwood 1966).

use std::f64::consts::PI;

use asperity::Shape;
use asperity::bem::Boundary;
use asperity::compare::ReferencePoint;
use asperity::spot::cluster_conductance;
use asperity::study::{CaseResults, LawContact};

use super::ReferenceRun;
use super::view::SumAtLoad;

impl ReferenceRun<'_> {
    /// Conductance times mean resistivity per nominal area (1/m) of the spots of the sum of `case` as a cluster, at each of the points of the
    /// reference; `None` where the sum was not run at that load. Empty unless the map is finite and the conductance of its spots asked for without a layer.
    pub(super) fn clusters(
        &self,
        law: &LawContact,
        case: &CaseResults,
        boundary: Boundary,
        points: &[ReferencePoint],
    ) -> Vec<Option<f64>> {
        let asked = law.contact.spot_properties().into_iter();
        let mut conducting = asked.flat_map(|asked| asked.electrical.iter().chain(&asked.thermal));
        let conducts = conducting.any(|conduction| !conduction.is_layered());
        if boundary != Boundary::Finite || !conducts {
            return Vec::new();
        }
        let at = |point: &ReferencePoint| {
            let sum = SumAtLoad::new(case, point.pressure)?;
            let spots = self.spots(law, self.surface.plane.mean + sum.separation);
            Some(cluster_conductance(&spots) / self.surface.set.nominal_area())
        };
        points.iter().map(at).collect()
    }

    /// The asperities above `flat` (m): radii of the circular spots that conduct as much (m), and places (m).
    fn spots(&self, law: &LawContact, flat: f64) -> Vec<(f64, [f64; 2])> {
        let (map, set) = (&self.prepared.map, &self.surface.set);
        let ellipses = set.ellipses().filter(|_| law.spec.is_elliptic());
        let spot = |k: usize| {
            let shape =
                ellipses.map_or_else(|| Shape::sphere(set.radii()[k]), |ellipses| ellipses[k].shape());
            let area = law.contact.contact(set.heights()[k] - flat, shape).area;
            let (position, columns) = (self.prepared.positions[k], map.points()[1]);
            let place =
                [(position / columns) as f64 * map.pixel()[0], (position % columns) as f64 * map.pixel()[1]];
            ((area * shape.spheres / PI).sqrt(), place)
        };
        (0..set.count()).filter(|&k| set.heights()[k] > flat).map(spot).collect()
    }
}
