//! Published real contact areas of an ensemble of self-affine surfaces.
//!
//! From `Data/Area_GFMD_Zhou.mat` and `Fig_2_program.m` of the repository that the authors put beside their
//! paper (Xu, Zhu, Xiao, Zhou 2024), github.com/xylcsi/PerssonModelFudgeFactor: calculations by Green's function molecular
//! dynamics. Grid, domain and number of surfaces are not stated there.

use std::f64::consts::TAU;

use super::SelfAffine;

/// Real contact area of the ensemble at one pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PublishedArea {
    /// p/E*.
    pub pressure: f64,
    /// Mean area ratio.
    pub area: f64,
    /// Its standard deviation over the surfaces.
    pub deviation: f64,
    /// The area of an earlier file of the repository (`GFMD_final_results_*_from_Zhou.mat`), which does not say whether its
    /// surfaces are the same.
    pub earlier: Option<f64>,
}

const fn row(pressure: f64, area: f64, deviation: f64, earlier: Option<f64>) -> PublishedArea {
    PublishedArea { pressure, area, deviation, earlier }
}

/// By pressure.
pub const PUBLISHED: [PublishedArea; 17] = [
    row(1e-4, 0.000_860_929_4, 4.3e-5, Some(0.000_825_673)),
    row(1e-3, 0.008_272_076, 1.0e-4, Some(0.007_821_9)),
    row(5e-3, 0.039_934_80, 2.9e-4, Some(0.037_911)),
    row(0.01, 0.077_926_64, 4.7e-4, Some(0.074_426_4)),
    row(0.015, 0.114_685_4, 5.5e-4, Some(0.109_755)),
    row(0.025, 0.185_244_2, 7.4e-4, Some(0.177_695)),
    row(0.04, 0.284_594_8, 7.0e-4, Some(0.273_956)),
    row(0.065, 0.432_594_8, 6.0e-4, Some(0.419_292)),
    row(0.086, 0.540_295_8, 5.7e-4, Some(0.526_122)),
    row(0.113, 0.657_142_2, 4.8e-4, Some(0.643)),
    row(0.147, 0.771_872_0, 3.2e-4, Some(0.759_368)),
    row(0.191, 0.873_915_2, 3.1e-4, Some(0.864_486)),
    row(0.24, 0.940_583_2, 2.6e-4, None),
    row(0.3, 0.979_394_2, 1.7e-4, None),
    row(0.37, 0.995_132_2, 1.0e-4, None),
    row(0.43, 0.998_825_4, 5.0e-5, None),
    row(0.5, 0.999_814_8, 2.0e-5, None),
];

/// Wave numbers of the ensemble, rad/m: the smallest, which is that of the roll-off, and the largest.
const WAVE_NUMBERS: [f64; 2] = [1e4, 1e6];

/// Standard deviation of the heights, m.
pub const RMS_HEIGHT: f64 = 6e-6;

/// The ensemble on the smallest square that holds its longest wave.
pub const ENSEMBLE: SelfAffine = SelfAffine {
    side: TAU / WAVE_NUMBERS[0],
    hurst: 0.8,
    roll_off: TAU / WAVE_NUMBERS[0],
    cut_off: TAU / WAVE_NUMBERS[1],
    gradient: 0.2766,
    elongation: 1.0,
};

/// The published area at a pressure, if there is one.
pub fn published(pressure: f64) -> Option<&'static PublishedArea> {
    PUBLISHED.iter().find(|row| (row.pressure / pressure - 1.0).abs() < 1e-9)
}
