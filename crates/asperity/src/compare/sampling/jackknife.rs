//! Standard errors from estimates with each group left out, or from surfaces of a process that was fitted to the map.

use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::compare::{ComparedQuantity, Scatter, State};
use crate::topography::generate::Unfitted;

/// The standard error of an estimate `full` from the estimates without each group, `shares` of the area that the groups
/// hold: the jackknife for groups of unequal size (Busing, Meijer and van der Leeden 1999, Statistics and Computing 9, 3,
/// Eq. 6).
pub fn jackknife_error(full: f64, without: &[f64], shares: &[f64]) -> f64 {
    let pseudo = |(&estimate, share): (&f64, f64)| {
        let times = share.recip();
        (times * full - (times - 1.0) * estimate, times)
    };
    let pseudo: Vec<(f64, f64)> = without.iter().zip(shares.iter().copied()).map(pseudo).collect();
    // The mean of pseudovalues weighted by the groups' sizes.
    let mean: f64 = pseudo.iter().map(|(value, times)| value / times).sum();
    let variance: f64 = pseudo.iter().map(|(value, times)| (value - mean).powi(2) / (times - 1.0)).sum();
    (variance / pseudo.len() as f64).sqrt()
}

/// Student's quantile of the two-sided 95 % interval with `groups` - 1 degrees of freedom; infinite for fewer than two.
pub fn student_quantile(groups: usize) -> f64 {
    quantile(groups.saturating_sub(1) as f64)
}

/// The same for a standard error from [`jackknife_error`] of contacts: with two thirds of the degrees of freedom, because
/// the loads of groups that hold few contacts are not Gaussian. The experiment `coverage` shows that intervals then hold.
pub fn jackknife_quantile(groups: usize) -> f64 {
    const SHARE: f64 = 2.0 / 3.0;
    quantile(SHARE * groups.saturating_sub(1) as f64)
}

fn quantile(freedom: f64) -> f64 {
    let student = StudentsT::new(0.0, 1.0, freedom);
    student.map_or(f64::INFINITY, |student| student.inverse_cdf(0.975))
}

/// Why no model-based interval is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NotModelled {
    /// No process is fitted to the map.
    Unfitted(Unfitted),
    /// The roughness varies over the map more than over generated surfaces.
    Patchy,
    /// A generated surface on which the models cannot be run.
    Failed,
}

/// Both models at the same loads on surfaces of a process that was fitted to a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Generated {
    /// On each surface, at each load, the statistical and the deterministic model; `None` where one has no contact.
    pub states: Vec<Vec<Option<[State; 2]>>>,
    /// By how much the scatter of samples exceeds theirs: the long waves of the process are estimated from the map itself, and its amplitude
    /// does not vary from place to place.
    pub widening: f64,
}

/// Standard deviations of the generated surfaces by which the difference on the map may lie off their mean without being a misfit: of Gaussian
/// surfaces a quarter of the maps exceed them in the area, and hardly any in separation and stiffness.
const EXPECTED_GAP: f64 = 2.0;

impl Generated {
    /// The standard error of the `contrast` of the map at the load of index `load`, and the half-width of its 95 % interval in standard errors;
    /// `None` where a surface has no contact.
    ///
    /// A process that does not reproduce the contrast of its own map is not trusted with its scatter: what the contrast lies off the mean of the
    /// surfaces beyond two standard deviations is added (squares).
    pub fn error(&self, quantity: ComparedQuantity, contrast: f64, load: usize) -> Option<(f64, f64)> {
        let contrasts = self.contrasts(quantity, load)?;
        let Scatter { mean, deviation } = Scatter::new(&contrasts);
        let misfit = ((contrast - mean).powi(2) - (EXPECTED_GAP * deviation).powi(2)).max(0.0).sqrt();
        Some(((self.widening * deviation).hypot(misfit), student_quantile(contrasts.len())))
    }

    fn contrasts(&self, quantity: ComparedQuantity, load: usize) -> Option<Vec<f64>> {
        let of_surface = |states: &Vec<Option<[State; 2]>>| {
            states[load].map(|[integral, sum]| integral[quantity as usize] - sum[quantity as usize])
        };
        self.states.iter().map(of_surface).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For a mean, the jackknife is the textbook standard error.
    #[test]
    fn of_a_mean_of_equal_groups() {
        let values = [3.0, 5.0, 4.0, 8.0];
        let mean = 5.0;
        let without: Vec<f64> = values.iter().map(|value| (20.0 - value) / 3.0).collect();
        let exact = (values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / 12.0).sqrt();
        assert!((jackknife_error(mean, &without, &[0.25; 4]) - exact).abs() < 1e-14);
    }

    /// Groups of 1 and 3 draws of equal values within a group have the error that unequal weights give.
    #[test]
    fn unequal_groups_count_by_their_size() {
        let (sizes, values) = ([1.0, 3.0, 4.0, 8.0], [2.0, 4.0, 1.0, 3.0]);
        let total: f64 = sizes.iter().zip(values).map(|(n, value)| n * value).sum();
        let without: Vec<f64> =
            sizes.iter().zip(values).map(|(n, value)| (total - n * value) / (16.0 - n)).collect();
        let shares: Vec<f64> = sizes.iter().map(|n| n / 16.0).collect();
        let mean = total / 16.0;
        let exact: f64 = sizes.iter().zip(values).map(|(n, v)| (v - mean).powi(2) * n / (16.0 - n)).sum();
        assert!((jackknife_error(mean, &without, &shares) - (exact / 4.0).sqrt()).abs() < 1e-14);
    }

    #[test]
    fn quantiles_of_student() {
        for (groups, exact) in [(2, 12.706_204_736), (16, 2.131_449_546), (101, 1.983_971_519)] {
            assert!((student_quantile(groups) - exact).abs() < 1e-8, "{groups}");
        }
        assert_eq!([student_quantile(1), jackknife_quantile(1)], [f64::INFINITY; 2]);
        // 10 degrees of freedom.
        assert!((jackknife_quantile(16) - 2.228_138_852).abs() < 1e-8);
    }

    /// Of contrasts 1, 2, 3 the mean is 2, the standard deviation 1: at 2 there is no misfit, at 5 one of sqrt(9 - 4).
    #[test]
    fn the_error_is_the_widened_scatter_and_the_misfit() {
        let state = |separation: f64| [separation, 0.0, 0.0, 0.0, 0.0, 0.0];
        let states = |integral: f64| vec![Some([state(integral), state(1.0)]), None];
        let generated = Generated { states: [2.0, 3.0, 4.0].map(states).to_vec(), widening: 1.5 };
        let of = |contrast: f64| generated.error(ComparedQuantity::Separation, contrast, 0).unwrap();
        let (error, quantile) = of(2.0);
        assert!((error - 1.5).abs() < 1e-15 && (quantile - 4.302_652_7).abs() < 1e-6, "{error} {quantile}");
        assert!((of(5.0).0 - (2.25f64 + 5.0).sqrt()).abs() < 1e-14);
        assert_eq!(generated.error(ComparedQuantity::Area, 0.0, 0).unwrap().0, 0.0);
        assert_eq!(generated.error(ComparedQuantity::Separation, 2.0, 1), None, "a surface without contact");
    }
}
