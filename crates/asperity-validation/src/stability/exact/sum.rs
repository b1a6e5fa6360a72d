//! Sums over asperities, each contact and the adding in about 32 digits.

use rayon::prelude::*;

use super::{Exact, Shape};
use crate::stability::wide::Wide;

/// What asperities add up to.
#[derive(Debug, Clone, Copy)]
pub struct Total {
    /// Number of contacts.
    pub contacts: Wide,
    /// Area by regime, m^2.
    pub area: [Wide; 3],
    /// Load by regime, N.
    pub load: [Wide; 3],
    /// N/m.
    pub stiffness: Wide,
    /// Sums of the squares of areas and of loads.
    pub squares: [Wide; 2],
}

impl Total {
    pub(super) const NONE: Self = Self {
        contacts: Wide::ZERO,
        area: [Wide::ZERO; 3],
        load: [Wide::ZERO; 3],
        stiffness: Wide::ZERO,
        squares: [Wide::ZERO; 2],
    };

    /// Over all regimes.
    pub fn total_area(&self) -> Wide {
        self.area[0] + self.area[1] + self.area[2]
    }

    /// Over all regimes.
    pub fn total_load(&self) -> Wide {
        self.load[0] + self.load[1] + self.load[2]
    }

    /// The same, each part times a factor.
    pub fn times(self, factor: Wide) -> Self {
        Self {
            contacts: self.contacts * factor,
            area: self.area.map(|area| area * factor),
            load: self.load.map(|load| load * factor),
            stiffness: self.stiffness * factor,
            squares: self.squares,
        }
    }

    pub(super) fn plus(mut self, other: &Self) -> Self {
        for regime in 0..3 {
            self.area[regime] += other.area[regime];
            self.load[regime] += other.load[regime];
        }
        for k in 0..2 {
            self.squares[k] += other.squares[k];
        }
        Self { contacts: self.contacts + other.contacts, stiffness: self.stiffness + other.stiffness, ..self }
    }
}

impl Exact {
    /// The asperities (height and radius, m) that stand above the flat at `separation` (m). The stiffness takes four
    /// more contacts per asperity; it is zero unless `stiff`.
    pub fn total(&self, asperities: &[(f64, f64)], separation: Wide, stiff: bool) -> Total {
        const CHUNK: usize = 4096;
        let parts: Vec<Total> = asperities
            .par_chunks(CHUNK)
            .map(|chunk| {
                let mut total = Total::NONE;
                for &(height, radius) in chunk {
                    let (w, shape) = (Wide::new(height) - separation, Shape::sphere(radius));
                    if w <= Wide::ZERO {
                        continue;
                    }
                    let branch = self.branch(w, &shape);
                    let (area, load, regime) = self.answer(w, &shape, branch);
                    let regime = regime as usize;
                    total.contacts += 1.0;
                    total.area[regime] += area;
                    total.load[regime] += load;
                    total.squares = [total.squares[0] + area * area, total.squares[1] + load * load];
                    if stiff {
                        total.stiffness += self.stiffness_by(w, &shape, branch);
                    }
                }
                total
            })
            .collect();
        parts.iter().fold(Total::NONE, Total::plus)
    }
}
