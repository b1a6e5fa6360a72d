//! Errors in reading `.npy` files.

use std::io;

use crate::legible::legible;

/// An error in reading a `.npy` file. Texts are predicates without the file name: "is empty".
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum NpyError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
    /// The file has no bytes.
    #[error("is empty")]
    Empty,
    /// The file does not begin as a `.npy` does.
    #[error("is not a .npy file: it does not begin with \\x93NUMPY")]
    NotNpy,
    /// The file ends before its header does.
    #[error("is truncated: it ends within its header")]
    TruncatedHeader,
    /// The header is invalid.
    #[error("has an invalid .npy header: {0}")]
    Header(#[from] HeaderError),
    /// The type of the numbers is not supported.
    #[error("holds numbers of type {}; allowed: float32, float64 and integers", legible(.0, 40))]
    NumberType(String),
    /// The array is not two-dimensional.
    #[error("holds an array of shape ({}); allowed: two dimensions", shown(.0))]
    Dimensions(Vec<u64>),
    /// The size in the header exceeds any possible file.
    #[error("claims to hold more numbers than any file can")]
    TooLarge,
    /// The file ends before its last number.
    #[error(
        "is truncated: its header says {rows} x {columns} numbers in {bytes} bytes, {found} bytes are there"
    )]
    Truncated { rows: u64, columns: u64, bytes: u64, found: u64 },
    /// The file goes on after its last number.
    #[error("holds {extra} bytes after its {rows} x {columns} numbers; allowed: one array and nothing else")]
    Trailing { rows: u64, columns: u64, extra: u64 },
    /// The file was cut after its header had been checked.
    #[error("became shorter while it was read; run again once it is written")]
    Shortened,
    /// The array is in Fortran order, so that rows are not contiguous.
    #[error("is in Fortran order; allowed here: C order")]
    FortranOrder,
}

/// The lengths of an array, the first ones of very many.
fn shown(lengths: &[u64]) -> String {
    const MOST: usize = 8;
    let words = lengths.iter().take(MOST).map(u64::to_string);
    words.chain((lengths.len() > MOST).then(|| "...".to_owned())).collect::<Vec<_>>().join(", ")
}

/// A defect of a header.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum HeaderError {
    /// Another version of the format.
    #[error("found version {0}.{1}; allowed: 1.0, 2.0 and 3.0")]
    Version(u8, u8),
    /// The header is too long.
    #[error("it is {0} bytes long; allowed: at most {MAX_HEADER_BYTES}")]
    TooLong(u64),
    /// The bytes are not UTF-8.
    #[error("it is not UTF-8 text")]
    Encoding,
    /// The text is not a dictionary.
    #[error("it is not a Python dictionary")]
    Syntax,
    /// An entry of the dictionary is missing.
    #[error("it has no entry '{0}'")]
    Missing(&'static str),
    /// An entry has an invalid value.
    #[error("its entry '{entry}' is not {allowed}")]
    Entry {
        /// Name of the entry.
        entry: &'static str,
        /// The allowed values.
        allowed: &'static str,
    },
}

/// Bytes of the longest header that is read: NumPy's own are below 200 for numbers that are no records.
pub(super) const MAX_HEADER_BYTES: u64 = 1 << 20;
