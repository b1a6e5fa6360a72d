//! Lanes against scalars and wide numbers.

use super::*;
use xprec::Df64 as Wide;

/// Applies a function to each number.
struct Each<'a, F>(&'a [f64], F);

trait Function {
    fn of<N: Real>(&self, x: N) -> N;
}

impl<F: Function> Work for Each<'_, F> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with<N: Real>(self, zero: N) -> Vec<f64> {
        let mut answers = vec![0.0; self.0.len()];
        for (values, answers) in self.0.chunks_exact(N::LANES).zip(answers.chunks_exact_mut(N::LANES)) {
            self.1.of(zero.load(values)).store(answers);
        }
        answers
    }
}

struct Ln;
impl Function for Ln {
    #[inline(always)]
    fn of<N: Real>(&self, x: N) -> N {
        x.ln()
    }
}

struct Exp;
impl Function for Exp {
    #[inline(always)]
    fn of<N: Real>(&self, x: N) -> N {
        x.exp()
    }
}

struct ExpM1;
impl Function for ExpM1 {
    #[inline(always)]
    fn of<N: Real>(&self, x: N) -> N {
        x.exp_and_exp_m1().1
    }
}

/// The relative rounding error: half an ulp is at most 2^-53.
const HALF_ULP: f64 = 0.5 * f64::EPSILON;

fn worst(found: &[f64], exact: impl Iterator<Item = Wide>) -> f64 {
    let error = |(&found, exact): (&f64, Wide)| ((exact - found) / exact).abs().hi();
    found.iter().zip(exact).map(error).fold(0.0, f64::max)
}

#[test]
fn logarithms() {
    let x: Vec<f64> = (0..80_000).map(|k| 1.000_9f64.powi(k - 40_000) * 1.000_1).collect();
    let found = run(Each(&x, Ln));
    let worst = worst(&found, x.iter().map(|&x| Wide::new(x).ln()));
    assert!(worst <= 2.0 * HALF_ULP, "{} half ulp", worst / HALF_ULP);
}

#[test]
fn exponentials() {
    // Within the range of 32 digits.
    let x: Vec<f64> = (0..80_000).map(|k| f64::from(k - 40_000) * 0.0155).collect();
    let found = run(Each(&x, Exp));
    let worst = worst(&found, x.iter().map(|&x| Wide::new(x).exp()));
    assert!(worst <= 2.0 * HALF_ULP, "{} half ulp", worst / HALF_ULP);
    let all: Vec<f64> = (0..80_000).map(|k| f64::from(k - 40_000) * 0.017_499).collect();
    for (x, found) in all.iter().zip(run(Each(&all, Exp))) {
        assert!((found / x.exp() - 1.0).abs() <= 4.0 * HALF_ULP, "exp {x} = {found}");
    }
    // Below the range results are negligible.
    let far = run(Each(&[-701.0, -1e5, -1e300, 0.0, 0.0, 0.0, 0.0, 0.0], Exp));
    assert!(far[..3].iter().all(|value| (0.0..1e-304).contains(value)) && far[3] == 1.0);
}

#[test]
fn exponentials_less_one() {
    let mut x: Vec<f64> = (0..80_000).map(|k| f64::from(k - 60_000) * 1.13e-3).collect();
    x.extend((0..8000).flat_map(|k| [1.0, -1.0].map(|sign| sign * 0.99f64.powi(k))));
    for (x, found) in x.iter().zip(run(Each(&x, ExpM1))) {
        let exact = x.exp_m1();
        assert!((found - exact).abs() <= 4.0 * HALF_ULP * exact.abs(), "exp({x}) - 1 = {found}");
    }
    assert_eq!(
        run(Each(&[0.0, -800.0, -1e300, f64::NEG_INFINITY, 0.0, 0.0, 0.0, 0.0], ExpM1))[..4],
        [0.0, -1.0, -1.0, -1.0]
    );
}
