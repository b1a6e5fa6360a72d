//! Standard errors from estimates with each group left out.

use statrs::distribution::{ContinuousCDF, StudentsT};

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
}
