//! The spots of the sum on a finite map as a cluster between half-spaces (Greenwood 1966).

use std::f64::consts::PI;

use asperity::Shape;
use asperity::bem::Boundary;
use asperity::compare::ReferencePoint;
use asperity::spot::{Conduction, cluster_conductance};
use asperity::study::{CaseResults, LawContact};

use super::ReferenceRun;
use super::view::SumAtLoad;

impl ReferenceRun<'_> {
    /// The conductances per nominal area, electrical (S/m^2) and thermal (W/(m^2 K)), of the spots of the sum of `case` as a cluster, at each of the
    /// points of the reference; 0 under a layer, with a film, and where the sum was not run at that load. Empty unless the map is finite and conducts.
    pub(super) fn clusters(
        &self,
        law: &LawContact,
        case: &CaseResults,
        boundary: Boundary,
        points: &[ReferencePoint],
    ) -> Vec<[f64; 2]> {
        let asked = law.contact.spot_properties().filter(|asked| asked.conducts());
        let Some(asked) = asked.filter(|_| boundary == Boundary::Finite) else { return Vec::new() };
        let is_bare = |conduction: &&Conduction| !conduction.is_layered() && conduction.film() == 0.0;
        let bare = [&asked.electrical, &asked.thermal].map(|asked| asked.as_ref().filter(is_bare));
        let at = |point: &ReferencePoint| {
            let sum = SumAtLoad::new(case, point.pressure)?;
            bare.iter().any(Option::is_some).then(|| {
                let spots = self.spots(law, self.surface.plane.mean + sum.separation);
                let cluster = cluster_conductance(&spots) / self.surface.set.nominal_area();
                bare.map(|bare| bare.map_or(0.0, |bare| cluster / bare.resistivity()))
            })
        };
        points.iter().map(|point| at(point).unwrap_or_default()).collect()
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
