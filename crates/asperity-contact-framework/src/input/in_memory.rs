//! Surfaces in memory, which a spec names as if they were files.

use std::fmt;
use std::sync::Arc;

use asperity::AsperityList;
use asperity::topography::Rows;
use sha2::{Digest, Sha256};

/// What lies in memory instead of a file.
#[derive(Clone)]
pub enum InMemory {
    /// A height map.
    Map {
        /// Its heights.
        rows: Arc<dyn Rows>,
        /// What a reader should know of how it was read, in words of a spec.
        caveats: Vec<String>,
    },
    /// A list of asperities.
    List(Arc<AsperityList>),
}

impl InMemory {
    /// SHA-256 of its numbers.
    pub fn sha256(&self) -> [u8; 32] {
        let mut hash = Sha256::new();
        let mut add = |values: &[f64]| values.iter().for_each(|value| hash.update(value.to_le_bytes()));
        match self {
            Self::Map { rows: map, .. } => {
                let [nx, ny] = map.points();
                add(&[nx as f64, ny as f64]);
                add(&map.pixel());
                let mut row = vec![0.0; ny];
                for ix in 0..nx {
                    map.read(ix, &mut row);
                    add(&row);
                }
            }
            Self::List(list) => list.columns().for_each(add),
        }
        hash.finalize().into()
    }
}

impl fmt::Debug for InMemory {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Map { rows, .. } => write!(f, "map of {:?} points", rows.points()),
            Self::List(list) => write!(f, "list of {} asperities", list.count()),
        }
    }
}
