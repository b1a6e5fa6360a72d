//! Streams of random numbers.

use sha2::{Digest, Sha256};

/// The seed of one stream of random numbers: it depends on a seed and on what is drawn, not on what else is drawn.
pub fn stream_seed(seed: u64, what: &str) -> [u8; 32] {
    let mut hash = Sha256::new();
    hash.update(seed.to_le_bytes());
    hash.update(what);
    hash.finalize().into()
}
