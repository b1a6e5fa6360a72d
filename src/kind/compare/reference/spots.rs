//! What the contact of the reference conducts, and how it resists sliding.

use std::cell::OnceCell;
use std::f64::consts::PI;

use asperity::Shape;
use asperity::bem::{Boundary, Conductor, Contact, Current, Solver, SolverError, Tangent};
use asperity::compare::ReferencePoint;
use asperity::progress::Progress;
use asperity::spot::{
    Conduction, GapMedium, ShearStrength, SpotProperties, SpotQuantity, SpotValues, cluster_conductance,
};
use asperity::study::{CaseResults, LawContact};
use asperity::topography::Blocks;

use super::ReferenceRun;
use super::view::SumAtLoad;

/// How far inside of the border of a patch that is given, not solved for, the current acts: in pixels (0.11 to 0.17 by the direction of the
/// border, measured on discs and straight edges).
const INSIDE: f64 = 0.17;

/// What is asked of the spots of one contact of the reference.
pub struct SpotSolver {
    electrical: Option<ConductingSpots>,
    thermal: Option<ConductingSpots>,
    medium: Option<GapMedium>,
    shear: Option<ShearStrength>,
}

struct ConductingSpots {
    conduction: Conduction,
    /// Made where the stiffness does not give the conductance.
    conductor: OnceCell<Conductor>,
}

#[derive(Default)]
pub struct SolvedSpots {
    /// Electrical and thermal.
    currents: [Option<Current>; 2],
    /// Thermal conductance of the gap per nominal area, W/(m^2 K).
    in_gap: f64,
    shear: Option<ShearStrength>,
    /// Whether the currents are those of a finite map as a whole.
    is_finite: bool,
}

impl SpotSolver {
    /// What `properties` asks for. A film that spots break through has no meaning without asperities; the influence of a layer on the current
    /// through a finite map is not known, and its gap does not conduct beside that of a surface without end.
    pub fn new(properties: Option<&SpotProperties>, boundary: Boundary) -> Self {
        let is_finite = boundary == Boundary::Finite;
        let conducting = |conduction: &Option<Conduction>| {
            let conduction = conduction.clone().filter(|asked| !is_finite || !asked.is_layered())?;
            Some(ConductingSpots { conduction, conductor: OnceCell::new() })
        };
        let none = SpotProperties::default();
        let SpotProperties { electrical, thermal, medium, shear, .. } = properties.unwrap_or(&none);
        let medium = medium.filter(|_| !is_finite);
        let shear = shear.filter(|shear| shear.broken.is_none()).map(|shear| shear.strength);
        Self { electrical: conducting(electrical), thermal: conducting(thermal), medium, shear }
    }

    /// The spots of `contact`, one of `solver`, solved to the relative `error`.
    pub fn solve(
        &self,
        solver: &Solver,
        contact: &Contact,
        tangent: Option<&Tangent>,
        error: f64,
        progress: &dyn Progress,
    ) -> Result<SolvedSpots, SolverError> {
        let current = |spots: &Option<ConductingSpots>| {
            spots.as_ref().map_or(Ok(None), |spots| spots.current(solver, contact, tangent, error, progress))
        };
        Ok(SolvedSpots {
            currents: [current(&self.electrical)?, current(&self.thermal)?],
            in_gap: self.medium.map_or(0.0, |medium| medium.conductance(contact.mean_gap())),
            shear: self.shear,
            is_finite: contact.boundary() == Boundary::Finite,
        })
    }
}

impl ConductingSpots {
    fn current(
        &self,
        solver: &Solver,
        contact: &Contact,
        tangent: Option<&Tangent>,
        error: f64,
        progress: &dyn Progress,
    ) -> Result<Option<Current>, SolverError> {
        let is_bare = self.conduction.film() == 0.0 && !self.conduction.is_layered();
        if is_bare
            && let Some(modulus) = solver.half_space_modulus()
            && contact.capped_area_ratio() == 0.0
        {
            let resistivity = self.conduction.resistivity();
            return Ok(tangent.map(|tangent| Current::of_elastic(tangent, modulus, resistivity)));
        }
        if self.conductor.get().is_none() {
            let (pair, film) = (self.conduction.pair(), self.conduction.film());
            let conductor =
                Conductor::new(contact.points(), contact.pixel(), contact.boundary(), &pair, film, error)?;
            // Nobody else has set it.
            let _ = self.conductor.set(conductor);
        }
        Ok(self.conductor.get().and_then(|conductor| conductor.current(contact, progress)))
    }
}

impl SolvedSpots {
    /// Conductances per nominal area and shear stress, of an area ratio at a nominal pressure (Pa); 0 of what is not asked for, and of the
    /// conductances of a finite map.
    pub fn values(&self, area_ratio: f64, pressure: f64) -> SpotValues {
        SpotQuantity::ALL.map(|quantity| match self.comparable_current(quantity) {
            Some(current) => current.conductance() + self.in_gap(quantity),
            None if quantity == SpotQuantity::ShearForce => self.shear_stress(area_ratio, pressure),
            None => 0.0,
        })
    }

    fn in_gap(&self, quantity: SpotQuantity) -> f64 {
        if quantity == SpotQuantity::ThermalConductance { self.in_gap } else { 0.0 }
    }

    /// What each block of a division of the points contributes, from its parts of area ratio and pressure (Pa).
    pub fn of_blocks(&self, blocks: &Blocks, sums: &[[f64; 2]]) -> Vec<SpotValues> {
        let shares = SpotQuantity::ALL.map(|quantity| {
            let current = self.comparable_current(quantity);
            current.map(|current| (current.conductance(), current.block_shares(blocks)))
        });
        let mut area_shares = vec![0.0; blocks.count()];
        let points = blocks.points[0] * blocks.points[1];
        (0..points).for_each(|k| area_shares[blocks.of_point(k)] += 1.0 / points as f64);
        let of_block = |(block, &[pressure, area_ratio]): (usize, &[f64; 2])| {
            SpotQuantity::ALL.map(|quantity| match &shares[quantity as usize] {
                // The gap is that of the mean everywhere.
                Some((whole, shares)) => whole * shares[block] + self.in_gap(quantity) * area_shares[block],
                None if quantity == SpotQuantity::ShearForce => self.shear_stress(area_ratio, pressure),
                None => 0.0,
            })
        };
        sums.iter().enumerate().map(of_block).collect()
    }

    /// Bound of the error of ln(conductance) that the patch of `contact` adds to that of its stiffness: where it is at the cap its border is
    /// given by the points.
    pub fn border_error(contact: &Contact) -> f64 {
        let count = contact.raw_area_ratio() * contact.pressures().len() as f64;
        let [x, y] = contact.outline();
        // Sides of pixels are longer than the border that they follow.
        let given = std::f64::consts::FRAC_PI_4 * (x + y).saturating_sub(contact.border()) as f64;
        if count > 0.0 { 0.5 * INSIDE * given / count } else { 0.0 }
    }

    /// A conductance per nominal area, also of a finite map as a whole; `None` of what is not asked for.
    pub fn conductance(&self, quantity: SpotQuantity) -> Option<f64> {
        self.current(quantity).map(|current| current.conductance() + self.in_gap(quantity))
    }

    /// The conductances per nominal area of a finite map as a cluster of spots, electrical and thermal; 0 where there is none.
    pub fn of_cluster(&self) -> [f64; 2] {
        let conductances = [SpotQuantity::ElectricalConductance, SpotQuantity::ThermalConductance];
        conductances.map(|quantity| self.conductance(quantity).filter(|_| self.is_finite).unwrap_or_default())
    }

    /// The error that the iteration leaves in a conductance.
    pub fn error(&self, quantity: SpotQuantity) -> f64 {
        self.current(quantity).map_or(0.0, |current| current.error)
    }

    /// What compares with the spots of the models, which belong to a surface without end.
    fn comparable_current(&self, quantity: SpotQuantity) -> Option<&Current> {
        self.current(quantity).filter(|_| !self.is_finite)
    }

    fn current(&self, quantity: SpotQuantity) -> Option<&Current> {
        match quantity {
            SpotQuantity::ElectricalConductance => self.currents[0].as_ref(),
            SpotQuantity::ThermalConductance => self.currents[1].as_ref(),
            SpotQuantity::ShearForce | SpotQuantity::TangentialStiffness => None,
        }
    }

    fn shear_stress(&self, area_ratio: f64, pressure: f64) -> f64 {
        self.shear.map_or(0.0, |ShearStrength { tau0, alpha }| tau0 * area_ratio + alpha * pressure)
    }
}

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
