//! Number types of files.

/// The type of stored numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NumberType {
    U8,
    U16,
    U32,
    U64,
    I8,
    I16,
    I32,
    I64,
    F32,
    F64,
}

/// Evaluates an expression with the Rust type of the numbers bound to a name.
macro_rules! with_type {
    ($stored:expr, $kind:ident => $value:expr) => {{
        macro_rules! of {
            ($type:ty) => {{
                type $kind = $type;
                $value
            }};
        }
        match $stored {
            NumberType::U8 => of!(u8),
            NumberType::U16 => of!(u16),
            NumberType::U32 => of!(u32),
            NumberType::U64 => of!(u64),
            NumberType::I8 => of!(i8),
            NumberType::I16 => of!(i16),
            NumberType::I32 => of!(i32),
            NumberType::I64 => of!(i64),
            NumberType::F32 => of!(f32),
            NumberType::F64 => of!(f64),
        }
    }};
}
impl NumberType {
    /// Bytes of a number.
    pub(crate) const fn bytes(self) -> u64 {
        with_type!(self, T => size_of::<T>() as u64)
    }

    /// The smallest and largest number of the type.
    pub(crate) const fn range(self) -> [f64; 2] {
        with_type!(self, T => [T::MIN as f64, T::MAX as f64])
    }

    pub(crate) const fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }

    /// Relative precision of the stored numbers; 0 for integers.
    pub(crate) const fn precision(self) -> f64 {
        if self.is_integer() { 0.0 } else { self.scaled_precision() }
    }

    /// Relative precision of the numbers after scaling, which rounds.
    pub(crate) const fn scaled_precision(self) -> f64 {
        if matches!(self, Self::F32) { f32::EPSILON as f64 } else { f64::EPSILON }
    }

    /// Decodes as many numbers as `out` holds.
    pub(crate) fn decode(self, bytes: &[u8], big_endian: bool, out: &mut [f64]) {
        with_type!(self, T => {
            let numbers = bytes.as_chunks().0.iter().zip(out);
            if big_endian {
                numbers.for_each(|(&number, value)| *value = T::from_be_bytes(number) as f64);
            } else {
                numbers.for_each(|(&number, value)| *value = T::from_le_bytes(number) as f64);
            }
        });
    }
}
