//! Influence coefficients of a map that does not repeat: the displacement of one pixel under a pressure on another.

use std::f64::consts::PI;

use asperity_fft::{Complex64, FftDirection};
use rayon::prelude::*;

use super::compliance::{Layer, SurfaceResponse};
use crate::layer::exact_sphere::Influence;
use crate::memory::zeros;
use crate::numeric::quadrature::{Variable, panels};

/// Divisions of the table of the layer's influence per unit of asinh(distance/thickness).
const DIVISIONS: f64 = 64.0;

/// Pixels around the loaded one over which a thin layer's influence is averaged more finely.
const NEAR: usize = 4;

/// The most parts along each side of a pixel in that average.
const MOST_PARTS: usize = 32;

/// The response to the waves of a map of `points` at a distance of `pixel` (m) in a map of zeros twice as long along
/// both axes: for wave (i, j) at j (nx + 1) + i, over the numbers of the transform.
pub fn response(points: [usize; 2], pixel: [f64; 2], pair: &impl SurfaceResponse) -> Vec<f64> {
    let [nx, ny] = points;
    let [length, width] = [2 * nx, 2 * ny];
    let layer = pair.layer().map(|(layer, compliance)| {
        let reach = (points[0] as f64 * pixel[0]).hypot(points[1] as f64 * pixel[1]);
        (Excess::new(layer, reach), compliance)
    });
    let influence = |i: usize, j: usize| {
        let at = [i as f64 * pixel[0], j as f64 * pixel[1]];
        let bare = pair.outermost() * love(at, pixel);
        let is_near = i < NEAR && j < NEAR;
        bare + layer
            .as_ref()
            .map_or(0.0, |(excess, compliance)| compliance * excess.pixel(at, pixel, is_near))
    };
    // Along y: real and even, so that its transform is real.
    let forward = asperity_fft::real_to_complex(width);
    let mut rows = zeros((nx + 1) * (ny + 1));
    rows.par_chunks_mut(ny + 1).enumerate().for_each_init(
        || (forward.make_input_vec(), forward.make_output_vec(), forward.make_scratch_vec()),
        |(line, waves, scratch), (i, row)| {
            for j in 0..=ny {
                line[j] = influence(i, j);
                line[(width - j) % width] = line[j];
            }
            // Cannot fail: the lengths are those of the plan.
            let _ = forward.process_with_scratch(line, waves, scratch);
            row.iter_mut().zip(waves).for_each(|(value, wave)| *value = wave.re);
        },
    );
    let along = asperity_fft::complex(length, FftDirection::Forward);
    let norm = ((length * width) as f64).recip();
    let mut response = zeros((nx + 1) * (ny + 1));
    response.par_chunks_mut(nx + 1).enumerate().for_each_init(
        || (vec![Complex64::default(); length], vec![Complex64::default(); along.get_inplace_scratch_len()]),
        |(line, scratch), (j, column)| {
            for i in 0..=nx {
                line[i] = Complex64::new(rows[i * (ny + 1) + j], 0.0);
                line[(length - i) % length] = line[i];
            }
            along.process_with_scratch(line, scratch);
            column.iter_mut().zip(line).for_each(|(value, wave)| *value = norm * wave.re);
        },
    );
    response
}

/// M(y) = 2/pi int_0^(pi/2) m(y sin phi) dphi, on panels that grow with y sin phi: m changes over lengths of about 1, and
/// more slowly the farther away.
fn mean_over_angles(influence: &Influence, y: f64) -> f64 {
    let (mut sum, mut from, mut end) = (0.0, 0.0, 1.0);
    while from < 0.5 * PI {
        let to = if end < y { (end / y).asin() } else { 0.5 * PI };
        for panel in panels(from, to, Variable::Linear, 1) {
            let nodes = panel.points.into_iter().zip(panel.weights);
            sum += nodes.map(|(phi, weight)| weight * influence.at(y * phi.sin())).sum::<f64>();
        }
        (from, end) = (to, 1.5 * end);
    }
    2.0 / PI * sum
}

/// The displacement times E* at a distance `at` from the middle of a pixel under unit pressure on it, m (Love 1929).
pub fn love([x, y]: [f64; 2], pixel: [f64; 2]) -> f64 {
    let [a, b] = pixel.map(|side| 0.5 * side);
    let term = |u: f64, v: f64, w: f64| u * ((v + v.hypot(u)) / (w + w.hypot(u))).ln();
    let along_x = term(x + a, y + b, y - b) - term(x - a, y + b, y - b);
    let along_y = term(y + b, x + a, x - a) - term(y - b, x + a, x - a);
    (along_x + along_y) / PI
}

/// What a layer adds to the displacement of a half-space of its material: per unit force, (1 - nu^2)/(pi E t) M(r/t)
/// with M(y) = int_0^inf (kappa(x) - 1) J0(x y) dx.
///
/// J0 is the mean of cosines, hence M(y) the mean of m(y cos phi) over phi, m being the influence function of the exact
/// sphere. M is tabulated over asinh y.
struct Excess {
    thickness: f64,
    table: Vec<f64>,
}

impl Excess {
    /// The table up to distances of `reach`, m.
    fn new(layer: &Layer, reach: f64) -> Self {
        let count = (DIVISIONS * (1.5 * reach / layer.thickness + 1.0).asinh()).ceil() as usize + 3;
        let end = (count as f64 / DIVISIONS).sinh();
        let influence = Influence::new(layer.kernel, end);
        let value = |k: usize| mean_over_angles(&influence, (k as f64 / DIVISIONS).sinh());
        Self { thickness: layer.thickness, table: (0..count).into_par_iter().map(value).collect() }
    }

    /// M(y), by a cubic through four points.
    fn at(&self, y: f64) -> f64 {
        let s = DIVISIONS * y.asinh();
        let k = (s as usize).min(self.table.len() - 3);
        let f = s - k as f64;
        // M is even.
        let [a, b, c, d] = [k.abs_diff(1), k, k + 1, k + 2].map(|k| self.table[k]);
        -f * (f - 1.0) * (f - 2.0) / 6.0 * a + (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0 * b
            - (f + 1.0) * f * (f - 2.0) / 2.0 * c
            + (f + 1.0) * f * (f - 1.0) / 6.0 * d
    }

    /// The displacement over (1 - nu^2)/E at a distance `at` from the middle of a pixel under unit pressure, m: its mean
    /// over 2 x 2 Gauss points of each part of the pixel.
    fn pixel(&self, at: [f64; 2], pixel: [f64; 2], is_near: bool) -> f64 {
        let parts = if is_near {
            pixel.map(|side| ((2.0 * side / self.thickness).ceil() as usize).clamp(1, MOST_PARTS))
        } else {
            [1, 1]
        };
        let nodes = |axis: usize| {
            let size = pixel[axis] / parts[axis] as f64;
            (0..2 * parts[axis]).map(move |n| {
                let side = if n % 2 == 0 { -1.0 } else { 1.0 };
                at[axis] - 0.5 * pixel[axis] + size * ((n / 2) as f64 + 0.5 + side / 12f64.sqrt())
            })
        };
        let mut sum = 0.0;
        for x in nodes(0) {
            for y in nodes(1) {
                sum += self.at(x.hypot(y) / self.thickness);
            }
        }
        let mean = sum / (4 * parts[0] * parts[1]) as f64;
        mean * pixel[0] * pixel[1] / (PI * self.thickness)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bem::ElasticPair;
    use crate::material::Material;

    #[test]
    fn love_in_the_middle_and_far_away() {
        // A square of side s: 4 s ln(1 + 2^.5)/pi; far away the force over pi r.
        let side = 0.3;
        let middle = 4.0 * side * (1.0 + 2f64.sqrt()).ln() / PI;
        assert!((love([0.0; 2], [side; 2]) / middle - 1.0).abs() < 1e-14);
        let far = love([40.0, 30.0], [0.3, 0.2]);
        assert!((far / (0.06 / (50.0 * PI)) - 1.0).abs() < 1e-5);
        assert!((love([0.1, 0.5], [0.3, 0.2]) / love([0.5, 0.1], [0.2, 0.3]) - 1.0).abs() < 1e-14);
    }

    /// M(y) at y = 0 is the integral of kappa - 1, far away it decays as (kappa(0) - 1)/y.
    #[test]
    fn the_layer_near_and_far() {
        let body = |young, poisson| Material::new(young, poisson, None, None).unwrap();
        for ratio in [0.05, 8.0] {
            let pair = ElasticPair::new(&body(1.0, 0.3), &body(1.0, 0.3), Some((&body(ratio, 0.35), 0.5)));
            let (layer, _) = pair.layer().unwrap();
            let excess = Excess::new(layer, 5e3);
            let influence = Influence::new(layer.kernel, 10.0);
            assert!((excess.at(0.0) / influence.at(0.0) - 1.0).abs() < 1e-12);
            let far = 1e4;
            let limit = (layer.kernel.kappa(0.0) - 1.0) / far;
            assert!((excess.at(far) / limit - 1.0).abs() < 2e-3, "{}", excess.at(far) / limit);
            // The table against the mean itself, between its points.
            for y in [0.013, 0.4, 2.3, 17.0, 300.0] {
                let exact = mean_over_angles(&Influence::new(layer.kernel, 2.0 * y), y);
                assert!((excess.at(y) - exact).abs() < 1e-7 * influence.at(0.0).abs(), "{y}");
            }
        }
    }
}
