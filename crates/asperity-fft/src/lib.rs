//! Plans of Fourier transforms in `f64`.
//!
//! rustfft and realfft are generic over the number type; their code for `f64` would be more than a third of the code of
//! the crate that plans transforms. It is compiled in this crate, so that changes of the library do not recompile it.
#![deny(unsafe_code)]
#![warn(missing_docs)]

use std::sync::Arc;

use realfft::RealFftPlanner;
use rustfft::FftPlanner;

pub use realfft::{ComplexToReal, RealToComplex};
pub use rustfft::num_complex::{Complex, Complex64};
pub use rustfft::{Fft, FftDirection};

/// An in-place transform of `length` complex numbers, not normalised.
pub fn complex(length: usize, direction: FftDirection) -> Arc<dyn Fft<f64>> {
    FftPlanner::new().plan_fft(length, direction)
}

/// The transform of `length` real numbers to the first half of their spectrum, `length / 2 + 1` numbers, not normalised.
pub fn real_to_complex(length: usize) -> Arc<dyn RealToComplex<f64>> {
    RealFftPlanner::new().plan_fft_forward(length)
}

/// The transform of half a spectrum to `length` real numbers, not normalised.
pub fn complex_to_real(length: usize) -> Arc<dyn ComplexToReal<f64>> {
    RealFftPlanner::new().plan_fft_inverse(length)
}
