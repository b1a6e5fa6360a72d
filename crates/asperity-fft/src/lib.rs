//! Plans of Fourier transforms in `f64` and `f32`.
//!
//! rustfft and realfft are generic over the number type; their code would be more than a third of the code of the crate that plans
//! transforms. It is compiled in this crate, so that changes of the library do not recompile it.
#![deny(unsafe_code)]
#![warn(missing_docs)]

use std::ops::AddAssign;
use std::sync::Arc;

use realfft::RealFftPlanner;
use rustfft::{FftNum, FftPlanner};

pub use realfft::{ComplexToReal, RealToComplex};
pub use rustfft::num_complex::{Complex, Complex64};
pub use rustfft::{Fft, FftDirection};

/// Numbers that are transformed.
pub trait Number: FftNum + Default + AddAssign {
    /// The nearest number.
    fn of(value: f64) -> Self;

    /// See [`complex`].
    fn complex(length: usize, direction: FftDirection) -> Arc<dyn Fft<Self>>;

    /// See [`real_to_complex`].
    fn real_to_complex(length: usize) -> Arc<dyn RealToComplex<Self>>;

    /// See [`complex_to_real`].
    fn complex_to_real(length: usize) -> Arc<dyn ComplexToReal<Self>>;
}

macro_rules! number {
    ($number:ty) => {
        impl Number for $number {
            #[inline(always)]
            fn of(value: f64) -> Self {
                value as $number
            }

            fn complex(length: usize, direction: FftDirection) -> Arc<dyn Fft<Self>> {
                FftPlanner::new().plan_fft(length, direction)
            }

            fn real_to_complex(length: usize) -> Arc<dyn RealToComplex<Self>> {
                RealFftPlanner::new().plan_fft_forward(length)
            }

            fn complex_to_real(length: usize) -> Arc<dyn ComplexToReal<Self>> {
                RealFftPlanner::new().plan_fft_inverse(length)
            }
        }
    };
}

number!(f64);
number!(f32);

/// An in-place transform of `length` complex numbers, not normalised.
pub fn complex<T: Number>(length: usize, direction: FftDirection) -> Arc<dyn Fft<T>> {
    T::complex(length, direction)
}

/// The transform of `length` real numbers to the first half of their spectrum, `length / 2 + 1` numbers, not normalised.
pub fn real_to_complex<T: Number>(length: usize) -> Arc<dyn RealToComplex<T>> {
    T::real_to_complex(length)
}

/// The transform of half a spectrum to `length` real numbers, not normalised.
pub fn complex_to_real<T: Number>(length: usize) -> Arc<dyn ComplexToReal<T>> {
    T::complex_to_real(length)
}
