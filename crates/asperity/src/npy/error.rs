//! Why a file gives no array.

use std::io;

/// Why a file gives no array. The caller says which file.
#[derive(Debug, thiserror::Error)]
pub enum NpyError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
    /// The file has no bytes.
    #[error("is empty")]
    Empty,
    /// The file does not begin as a `.npy` does.
    #[error("is no .npy file: it does not begin with \\x93NUMPY")]
    NotNpy,
    /// The file ends before its header does.
    #[error("is truncated: it ends within its head")]
    TruncatedHeader,
    /// The header does not say what is in the file.
    #[error("has a head that is no .npy head: {0}")]
    Header(#[from] HeaderFault),
    /// The numbers are of no supported type.
    #[error("holds numbers of type {0}; allowed: float32, float64 and integers")]
    NumberType(String),
    /// The array is no table.
    #[error("holds an array of shape ({}); allowed: two dimensions", .0.iter().map(u64::to_string).collect::<Vec<_>>().join(", "))]
    Dimensions(Vec<u64>),
    /// No file has so many bytes.
    #[error("claims to hold more numbers than any file can")]
    TooLarge,
    /// The file ends before its last number.
    #[error(
        "is truncated: its head says {rows} x {columns} numbers in {bytes} bytes, {found} bytes are there"
    )]
    Truncated {
        /// Length along the first index, as the header says.
        rows: u64,
        /// Length along the second index, as the header says.
        columns: u64,
        /// Bytes that these numbers take.
        bytes: u64,
        /// Bytes that are behind the header.
        found: u64,
    },
    /// The file was cut after its header had been checked.
    #[error("is truncated: it became shorter while it was opened")]
    Shortened,
    /// Rows are scattered over the file.
    #[error("is in Fortran order; allowed here: C order")]
    FortranOrder,
}

/// Why a header says nothing of an array.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum HeaderFault {
    /// Another version of the format.
    #[error("found version {0}.{1}; allowed: 1.0, 2.0 and 3.0")]
    Version(u8, u8),
    /// The header is longer than any of an array of numbers.
    #[error("it is {0} bytes long; allowed: at most {LONGEST_HEADER}")]
    TooLong(u64),
    /// The bytes are no text.
    #[error("it is no text in UTF-8")]
    Encoding,
    /// The text is no dictionary.
    #[error("it is no dictionary as Python writes it, from its byte {0} on")]
    Syntax(usize),
    /// The dictionary lacks an entry.
    #[error("it has no entry '{0}'")]
    Missing(&'static str),
    /// An entry has no value that makes sense.
    #[error("its entry '{entry}' is not {allowed}")]
    Entry {
        /// The entry.
        entry: &'static str,
        /// What it should be.
        allowed: &'static str,
    },
}

/// Bytes of the longest header that is read: NumPy's own are below 200 for numbers that are no records.
pub(super) const LONGEST_HEADER: u64 = 1 << 20;
