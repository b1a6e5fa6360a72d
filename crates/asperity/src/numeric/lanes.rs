//! Vector registers: a formula is written once, for one number or for all lanes of a register.
//!
//! [`run`] selects the widest registers of the machine at run time. Every function called within it must be
//! `#[inline(always)]`, since only inlined code is compiled for those registers. Closures cannot be forced inline, so
//! none may take or return lanes; `select_f64s` of pulp is not forced either.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
use std::sync::LazyLock;

use pulp::{Arch, Simd, WithSimd};

use super::INTEGER_BIAS;

/// The largest number of lanes of any supported register.
pub const MOST: usize = 8;

/// One boolean per lane.
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// Whether at least one lane is true.
    fn any(self) -> bool;

    /// Whether all lanes are true.
    #[inline(always)]
    fn all(self) -> bool {
        !(!self).any()
    }
}

/// One real number, or one per lane of a register.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// A mask of the lanes.
    type Mask: Mask;

    /// Number of lanes, at most [`MOST`].
    const LANES: usize;

    /// `value` in every lane; `self` gives the type of register.
    fn splat(self, value: f64) -> Self;

    /// Loads the first numbers of `values`, which must have at least [`Self::LANES`].
    fn load(self, values: &[f64]) -> Self;

    /// A mask of the lanes from `lane` on, which must exist.
    fn lanes_from(self, lane: usize) -> Self::Mask;

    /// Stores all lanes to the beginning of `values`.
    fn store(self, values: &mut [f64]);

    /// The square root.
    fn sqrt(self) -> Self;

    /// The natural logarithm of a positive, normal number, within 1 ulp.
    fn ln(self) -> Self;

    /// exp(x) for x from -700 to 700, within 1 ulp; below that a number near 0.
    #[inline(always)]
    fn exp(self) -> Self {
        self.exp_and_exp_m1().0
    }

    /// exp(x), and exp(x) - 1 within 2 ulp.
    fn exp_and_exp_m1(self) -> (Self, Self);

    /// self * factor + term, with a single rounding if the machine supports it.
    fn mul_add(self, factor: Self, term: Self) -> Self;

    /// Lanes where `self` < `other`.
    fn lt(self, other: Self) -> Self::Mask;

    /// Lanes where `self` <= `other`.
    fn le(self, other: Self) -> Self::Mask;

    /// `yes` in the lanes of `mask`, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// The mask of all lanes.
    #[inline(always)]
    fn all_true(self) -> Self::Mask {
        let zero = self.splat(0.0);
        zero.le(zero)
    }

    /// Applies the scalar function `of` to each lane.
    #[inline(always)]
    fn each<const K: usize>(self, mut of: impl FnMut(f64) -> [f64; K]) -> [Self; K] {
        let mut lanes = [0.0; MOST];
        self.store(&mut lanes);
        let mut rows = [[0.0; K]; MOST];
        for (row, &x) in rows.iter_mut().zip(&lanes[..Self::LANES]) {
            *row = of(x);
        }
        let [a, b, c, d, e, f, g, h] = &rows;
        assembled(self, [a, b, c, d, e, f, g, h])
    }

    /// The columns of as many rows of four numbers as there are lanes.
    #[inline(always)]
    fn columns(self, rows: [&[f64; 4]; MOST]) -> [Self; 4] {
        assembled(self, rows)
    }

    /// The mantissa m of a positive, normal number, 1 <= m < 2, and the middle of that of 2^`BITS` equal intervals between 1 and 2
    /// in which it lies.
    fn mantissa_and_middle<const BITS: u32>(self) -> (Self, Self);

    /// The first lane.
    #[inline(always)]
    fn first(self) -> f64 {
        let mut lanes = [0.0; MOST];
        self.store(&mut lanes);
        lanes[0]
    }

    /// The lane-wise minimum.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(other.lt(self), other, self)
    }

    /// A polynomial with coefficients from the highest power down.
    #[inline(always)]
    fn polynomial(self, coefficients: &[f64]) -> Self {
        let mut sum = self.splat(coefficients[0]);
        for &coefficient in &coefficients[1..] {
            sum = sum.mul_add(self, self.splat(coefficient));
        }
        sum
    }
}

/// The columns of as many rows as there are lanes, number by number.
#[inline(always)]
fn assembled<N: Real, const K: usize>(of: N, [a, b, c, d, e, f, g, h]: [&[f64; K]; MOST]) -> [N; K] {
    let mut columns = [of; K];
    for (k, column) in columns.iter_mut().enumerate() {
        // Written out, so that compilers assemble each column in a register.
        *column = of.load(&[a[k], b[k], c[k], d[k], e[k], f[k], g[k], h[k]]);
    }
    columns
}

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
}

impl Real for f64 {
    type Mask = bool;

    const LANES: usize = 1;

    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn load(self, values: &[f64]) -> Self {
        values[0]
    }

    #[inline(always)]
    fn lanes_from(self, _: usize) -> bool {
        true
    }

    #[inline(always)]
    fn store(self, values: &mut [f64]) {
        values[0] = self;
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn ln(self) -> Self {
        self.ln()
    }

    #[inline(always)]
    fn exp_and_exp_m1(self) -> (Self, Self) {
        (self.exp(), self.exp_m1())
    }

    #[inline(always)]
    fn mantissa_and_middle<const BITS: u32>(self) -> (Self, Self) {
        let mantissa = (self.to_bits() & !EXPONENT) | 1f64.to_bits();
        (Self::from_bits(mantissa), Self::from_bits((mantissa & leading(BITS)) | half(BITS)))
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

/// A vector register.
#[derive(Clone, Copy)]
pub struct Register<S: Simd> {
    simd: S,
    lanes: S::f64s,
}

/// A mask of a vector register.
#[derive(Clone, Copy)]
pub struct RegisterMask<S: Simd> {
    simd: S,
    lanes: S::m64s,
}

impl<S: Simd> Mask for RegisterMask<S> {
    #[inline(always)]
    fn any(self) -> bool {
        self.simd.first_true_m64s(self.lanes) < S::F64_LANES
    }
}

impl<S: Simd> BitAnd for RegisterMask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self { lanes: self.simd.and_m64s(self.lanes, other.lanes), ..self }
    }
}

impl<S: Simd> BitOr for RegisterMask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self { lanes: self.simd.or_m64s(self.lanes, other.lanes), ..self }
    }
}

impl<S: Simd> Not for RegisterMask<S> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self { lanes: self.simd.not_m64s(self.lanes), ..self }
    }
}

/// Implements an operation on two registers, and on a register and a scalar.
macro_rules! operation {
    ($trait:ident, $method:ident, $on_lanes:ident) => {
        impl<S: Simd> $trait for Register<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self { lanes: self.simd.$on_lanes(self.lanes, other.lanes), ..self }
            }
        }

        impl<S: Simd> $trait<f64> for Register<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self.$method(self.splat(other))
            }
        }
    };
}

operation!(Add, add, add_f64s);
operation!(Sub, sub, sub_f64s);
operation!(Mul, mul, mul_f64s);
operation!(Div, div, div_f64s);

impl<S: Simd> Neg for Register<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { lanes: self.simd.neg_f64s(self.lanes), ..self }
    }
}

impl<S: Simd> Register<S> {
    #[inline(always)]
    fn bits(self) -> S::u64s {
        self.simd.transmute_u64s_f64s(self.lanes)
    }

    #[inline(always)]
    fn of_bits(self, bits: S::u64s) -> Self {
        Self { lanes: self.simd.transmute_f64s_u64s(bits), ..self }
    }

    /// The upper halves of all lanes shifted by `SHIFT` bits to the left, or to the right where that is negative.
    #[inline(always)]
    fn shift_upper<const SHIFT: i32>(self, bits: S::u64s) -> S::u64s {
        let halves: S::u32s = bytemuck::cast(bits);
        let amount = self.simd.splat_u32s(SHIFT.unsigned_abs());
        bytemuck::cast(if SHIFT > 0 {
            self.simd.wrapping_dyn_shl_u32s(halves, amount)
        } else {
            self.simd.wrapping_dyn_shr_u32s(halves, amount)
        })
    }
}

/// ln 2 in two parts, the first of few digits, so that integer multiples of it are exact.
const LN_2: [f64; 2] = [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10];

/// Bits of the exponent of a number.
const EXPONENT: u64 = 0x7ff0_0000_0000_0000;

/// Bits of the mantissa.
const MANTISSA: u32 = f64::MANTISSA_DIGITS - 1;

/// The exponent and the first `count` bits of the mantissa.
const fn leading(count: u32) -> u64 {
    !(u64::MAX >> (u64::BITS - MANTISSA + count))
}

/// The bit of the mantissa that follows the first `count`.
const fn half(count: u32) -> u64 {
    1 << (MANTISSA - 1 - count)
}

/// Bits of the exponent in the upper half of a number start at this bit.
const UPPER_MANTISSA: i32 = 20;

/// [`INTEGER_BIAS`] with a margin for negative integers.
const SIGNED_INTEGER_BIAS: f64 = 1.5 * INTEGER_BIAS;

/// The bits of 2^-.5: subtracting them gives the exponent of the nearest power of two.
const ROOT_HALF: u64 = std::f64::consts::FRAC_1_SQRT_2.to_bits();

const TWO_TO_32: f64 = 4_294_967_296.0;

/// Coefficients of (ln((1 + s)/(1 - s)) - 2s)/s in s^2, the highest power first, for |s| < 0.1716 (minimax, of
/// the freely distributable fdlibm, Sun Microsystems 1993).
const LOGARITHM: [f64; 7] = [
    0.147_981_986_051_165_86,
    0.153_138_376_992_093_73,
    0.181_835_721_616_180_5,
    0.222_221_984_321_497_84,
    0.285_714_287_436_623_9,
    0.399_999_999_994_094_2,
    0.666_666_666_666_673_5,
];

/// Coefficients of (exp(r) - 1)/r, the highest power first: the series ends below rounding for |r| < 0.35.
const EXPONENTIAL: [f64; 13] = [
    1.0 / 6_227_020_800.0,
    1.0 / 479_001_600.0,
    1.0 / 39_916_800.0,
    1.0 / 3_628_800.0,
    1.0 / 362_880.0,
    1.0 / 40_320.0,
    1.0 / 5_040.0,
    1.0 / 720.0,
    1.0 / 120.0,
    1.0 / 24.0,
    1.0 / 6.0,
    0.5,
    1.0,
];

impl<S: Simd> Real for Register<S> {
    type Mask = RegisterMask<S>;

    const LANES: usize = S::F64_LANES;

    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        Self { lanes: self.simd.splat_f64s(value), ..self }
    }

    #[inline(always)]
    fn load(self, values: &[f64]) -> Self {
        let (whole, _) = S::as_simd_f64s(values);
        Self { lanes: whole[0], ..self }
    }

    #[inline(always)]
    fn lanes_from(self, lane: usize) -> RegisterMask<S> {
        let lanes = self.simd.mask_between_m64s(lane as u64, Self::LANES as u64).mask();
        RegisterMask { simd: self.simd, lanes }
    }

    #[inline(always)]
    fn store(self, values: &mut [f64]) {
        let (whole, _) = S::as_mut_simd_f64s(values);
        whole[0] = self.lanes;
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self { lanes: self.simd.sqrt_f64s(self.lanes), ..self }
    }

    /// x = 2^k (1 + f) with 1 + f from 2^-.5 to 2^.5, s = f/(2 + f), ln(1 + f) = f - s (f - R(s^2)).
    #[inline(always)]
    fn ln(self) -> Self {
        let simd = self.simd;
        let bits = simd.add_u64s(self.bits(), simd.splat_u64s(1f64.to_bits() - ROOT_HALF));
        let exponents =
            self.shift_upper::<{ -UPPER_MANTISSA }>(simd.and_u64s(bits, simd.splat_u64s(EXPONENT)));
        let exponents = self.of_bits(simd.or_u64s(exponents, simd.splat_u64s(INTEGER_BIAS.to_bits())));
        // k 2^32, exactly.
        let k = exponents - (INTEGER_BIAS + 1023.0 * TWO_TO_32);
        let mantissas = simd.and_u64s(bits, simd.splat_u64s(!EXPONENT));
        let f = self.of_bits(simd.add_u64s(mantissas, simd.splat_u64s(ROOT_HALF))) - 1.0;
        let s = f / (f + 2.0);
        let square = s * s;
        let rest = (-square).mul_add(square.polynomial(&LOGARITHM), f);
        k.mul_add(self.splat(std::f64::consts::LN_2 / TWO_TO_32), (-s).mul_add(rest, f))
    }

    /// 2^k exp(r), k the integer nearest to x/ln 2.
    #[inline(always)]
    fn exp_and_exp_m1(self) -> (Self, Self) {
        let simd = self.simd;
        let magic = self.splat(SIGNED_INTEGER_BIAS);
        let nearest = self * std::f64::consts::LOG2_E + SIGNED_INTEGER_BIAS;
        let k = nearest - magic;
        let r = (-k).mul_add(self.splat(LN_2[0]), self);
        let r = (-k).mul_add(self.splat(LN_2[1]), r);
        let wholes = (k * TWO_TO_32 + magic).bits();
        let wholes = simd.sub_u64s(wholes, simd.splat_u64s(SIGNED_INTEGER_BIAS.to_bits()));
        let power =
            simd.add_u64s(self.shift_upper::<UPPER_MANTISSA>(wholes), simd.splat_u64s(1f64.to_bits()));
        let power = self.of_bits(power);
        let rest = r * r.polynomial(&EXPONENTIAL);
        let (one, is_gone) = (self.splat(1.0), self.lt(self.splat(-700.0)));
        let exp = Self::select(is_gone, self.splat(0.0), power.mul_add(rest, power));
        (exp, Self::select(is_gone, -one, power.mul_add(rest, power - one)))
    }

    /// Transposes: the rows are in the order in which [`Simd::deinterleave_shfl_f64s`] takes them from its lanes.
    #[inline(always)]
    fn columns(self, rows: [&[f64; 4]; MOST]) -> [Self; 4] {
        let [a, b, c, d, e, f, g, h] = rows;
        let rows: [S::f64s; 4] = match S::F64_LANES {
            8 => bytemuck::cast([[*a, *c], [*b, *d], [*e, *g], [*f, *h]]),
            4 => bytemuck::cast([*a, *b, *c, *d]),
            _ => return assembled(self, rows),
        };
        let [first, second, third, fourth] = self.simd.deinterleave_shfl_f64s(rows);
        [
            Self { lanes: first, ..self },
            Self { lanes: second, ..self },
            Self { lanes: third, ..self },
            Self { lanes: fourth, ..self },
        ]
    }

    #[inline(always)]
    fn mantissa_and_middle<const BITS: u32>(self) -> (Self, Self) {
        let simd = self.simd;
        let fraction = simd.and_u64s(self.bits(), simd.splat_u64s(!EXPONENT));
        let mantissa = simd.or_u64s(fraction, simd.splat_u64s(1f64.to_bits()));
        let start = simd.and_u64s(mantissa, simd.splat_u64s(leading(BITS)));
        let middle = simd.or_u64s(start, simd.splat_u64s(half(BITS)));
        (self.of_bits(mantissa), self.of_bits(middle))
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        Self { lanes: self.simd.mul_add_e_f64s(self.lanes, factor.lanes, term.lanes), ..self }
    }

    #[inline(always)]
    fn lt(self, other: Self) -> RegisterMask<S> {
        RegisterMask { simd: self.simd, lanes: self.simd.less_than_f64s(self.lanes, other.lanes) }
    }

    #[inline(always)]
    fn le(self, other: Self) -> RegisterMask<S> {
        RegisterMask { simd: self.simd, lanes: self.simd.less_than_or_equal_f64s(self.lanes, other.lanes) }
    }

    #[inline(always)]
    fn select(mask: RegisterMask<S>, yes: Self, no: Self) -> Self {
        no.of_bits(no.simd.select_u64s(mask.lanes, yes.bits(), no.bits()))
    }
}

/// Work that is compiled for each register width.
pub trait Work {
    /// The result.
    type Output;

    /// Performs the work with numbers of the type of `zero`.
    fn with<N: Real>(self, zero: N) -> Self::Output;
}

struct OfWork<W>(W);

impl<W: Work> WithSimd for OfWork<W> {
    type Output = W::Output;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> W::Output {
        if S::F64_LANES == 1 {
            self.0.with(0.0)
        } else {
            self.0.with(Register { simd, lanes: simd.splat_f64s(0.0) })
        }
    }
}

/// The widest registers of this machine, or narrower ones if set by [`NARROWER`].
static REGISTERS: LazyLock<Arch> = LazyLock::new(|| match std::env::var(NARROWER).as_deref() {
    Ok("1") => Arch::Scalar,
    Ok("4") => four().unwrap_or_default(),
    _ => Arch::new(),
});

/// Bits of the vector registers that sums run in: the last digits of results depend on it.
pub fn register_bits() -> usize {
    struct Lanes;
    impl WithSimd for Lanes {
        type Output = usize;

        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) -> usize {
            S::F64_LANES
        }
    }
    8 * size_of::<f64>() * REGISTERS.dispatch(Lanes)
}

/// Environment variable that limits the number of lanes to 1 or 4, to measure their benefit or to reproduce the last
/// digits of another machine.
const NARROWER: &str = "ASPERITY_LANES";

#[cfg(target_arch = "x86_64")]
fn four() -> Option<Arch> {
    pulp::x86::V3::try_new().map(Arch::V3)
}

#[cfg(not(target_arch = "x86_64"))]
fn four() -> Option<Arch> {
    None
}

/// Performs `work` in the widest registers of this machine.
#[inline(always)]
pub fn run<W: Work>(work: W) -> W::Output {
    REGISTERS.dispatch(OfWork(work))
}

#[cfg(test)]
mod tests;
