//! A contact at one load in the terms of the models, with bounds of its errors.

use asperity::bem::{Boundary, Contact, GridError, Solver, SolverError, Tangent};
use asperity::compare::{BlockShare, ByQuantity, ComparedQuantity, Control, ReferencePoint};
use asperity::progress::Progress;
use asperity::spot::{SpotQuantity, SpotValues};
use asperity::surface::Surface;
use asperity::topography::Blocks;

use super::spots::{SolvedSpots, SpotSolver};

/// A contact, how it changes with the load, and what its spots conduct.
pub struct SolvedContact {
    pub contact: Contact,
    /// `None` where no point may change its pressure.
    pub tangent: Option<Tangent>,
    spots: SolvedSpots,
}

impl SolvedContact {
    /// At a nominal pressure (Pa), with its spots to the relative `error`.
    pub fn new(
        solver: &Solver,
        spots: &SpotSolver,
        pressure: f64,
        error: f64,
        progress: &dyn Progress,
    ) -> Result<Self, SolverError> {
        let contact = solver.at_pressure(pressure, progress)?;
        let tangent = solver.tangent(&contact, progress);
        let spots = spots.solve(solver, &contact, tangent.as_ref(), error, progress)?;
        Ok(Self { contact, tangent, spots })
    }

    pub fn block_shares(&self, blocks: &Blocks) -> Vec<BlockShare> {
        let sums = self.contact.block_sums(blocks);
        let shares = self.tangent.as_ref().map(|tangent| tangent.block_shares(blocks));
        let spots = self.spots.of_blocks(blocks, &sums);
        let of_block =
            |(block, ([pressure, area_ratio], spots)): (usize, ([f64; 2], SpotValues))| BlockShare {
                pressure,
                area_ratio,
                stiffness_share: shares.as_ref().map_or(0.0, |shares| shares[block]),
                spots,
            };
        sums.into_iter().zip(spots).enumerate().map(of_block).collect()
    }

    /// In the terms of the models, with the same load on `other` points.
    pub fn point(&self, pressure: f64, other: Option<&Self>, surface: &Surface) -> ReferencePoint {
        let contact = &self.contact;
        let (mean_gap, sigma) = (contact.mean_gap(), surface.plane.sigma);
        let area_ratio = self.area_ratio(surface);
        let is_comparable = contact.boundary() != Boundary::Finite;
        let offset = surface.plane_above_mean_plane().filter(|_| is_comparable);
        let separation = offset.map(|offset| mean_gap - offset);
        let stiffness = self.stiffness().filter(|_| separation.is_some());
        let point = ReferencePoint {
            control: Control::Pressure,
            target: pressure,
            pressure,
            mean_gap,
            undeformed_gap: contact.undeformed_gap(),
            separation,
            separation_over_sigma: separation.map(|d| d / sigma).filter(|h| !h.is_nan()),
            area_ratio,
            raw_area_ratio: contact.raw_area_ratio(),
            capped_area_ratio: contact.capped_area_ratio(),
            stiffness,
            spots: self.spots.values(area_ratio, pressure),
            of_cluster: self.spots.of_cluster(),
            bounds: ByQuantity::default(),
            error: contact.error,
            steps: contact.steps,
            convolutions: contact.convolutions,
        };
        ReferencePoint { bounds: self.bounds(&point, other, surface), ..point }
    }

    /// Bounds of the errors of solver and grid, of d/sigma and the logarithms of the others: where `other` points were solved too, no
    /// less than the differences between both.
    fn bounds(&self, point: &ReferencePoint, other: Option<&Self>, surface: &Surface) -> ByQuantity<f64> {
        let (contact, sigma, pressure) = (&self.contact, surface.plane.sigma, point.pressure);
        let grid = GridError::new(contact);
        // How far the flat moves while the load grows by its logarithm; without a stiffness less than down to the mean plane.
        let reach = self.stiffness().map_or(contact.mean_gap(), |stiffness| pressure / stiffness);
        let apart = |of: &dyn Fn(&Self) -> Option<f64>| -> f64 {
            let [own, other] = [Some(self), other].map(|solved| solved.and_then(of));
            own.zip(other).map_or(0.0, |(own, other)| (own - other).abs())
        };
        let gap = apart(&|solved| Some(solved.contact.mean_gap())).max(grid.load * reach);
        let area = apart(&|solved| Some(solved.area_ratio(surface).ln())).max(grid.area);
        let stiffness = apart(&|solved| solved.stiffness().map(f64::ln)).max(grid.stiffness);
        // The dual gap is relative to the standard deviation of the heights.
        let roughness = surface.map.as_ref().map_or(sigma, |map| map.roughness.moments.sq);
        let of_tangent = self.tangent.as_ref().map_or(0.0, |tangent| tangent.error);
        let conductance = |quantity: SpotQuantity| {
            let value = |solved: &Self| solved.spots.conductance(quantity).map(f64::ln);
            let of_grid = grid.stiffness + SolvedSpots::border_error(contact);
            apart(&value).max(of_grid) + contact.error + self.spots.error(quantity)
        };
        ComparedQuantity::ALL.map(|quantity| match quantity {
            ComparedQuantity::Separation => (gap + contact.error * roughness) / sigma,
            ComparedQuantity::Area => area + contact.error,
            ComparedQuantity::Stiffness => stiffness + contact.error + of_tangent,
            ComparedQuantity::ElectricalConductance => conductance(SpotQuantity::ElectricalConductance),
            ComparedQuantity::ThermalConductance => conductance(SpotQuantity::ThermalConductance),
            // Its part that grows with the area is all of it, or less.
            ComparedQuantity::Friction => area + contact.error,
        })
    }

    /// Real over nominal contact area: corrected for the perimeter of the contacts, as measured on rough surfaces; raw where no summits scatter.
    fn area_ratio(&self, surface: &Surface) -> f64 {
        if surface.unscattered.is_some() { self.contact.raw_area_ratio() } else { self.contact.area_ratio() }
    }

    /// -dp/dd, Pa/m.
    fn stiffness(&self) -> Option<f64> {
        self.tangent.as_ref().map(Tangent::stiffness).filter(|stiffness| *stiffness > 0.0)
    }
}
