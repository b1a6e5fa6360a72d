//! NumPy's `.npy`: float64, the first index is x.

use std::io;

use super::{MapFormat, Note, Out};
use crate::memory::zeros;
use crate::npy;
use crate::topography::Rows;

pub(super) const FORMAT: MapFormat = MapFormat { ending: "npy", holds_notes: false, write };

fn write(out: &mut dyn Out, map: &dyn Rows, _: &[Note]) -> io::Result<()> {
    let [nx, ny] = map.points();
    let row = |ix| {
        let mut row = zeros(ny);
        map.read(ix, &mut row);
        map.progress().advance((nx as f64).recip());
        row
    };
    npy::write(out, [nx, ny], (0..nx).flat_map(row))
}
