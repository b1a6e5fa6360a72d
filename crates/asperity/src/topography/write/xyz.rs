//! Columns x y z as text, in metres, x fastest. Points that are missing are left out; the line of the grid says where they are.

use std::io;

use super::{MapFormat, Note, Out, each_line, one_line};
use crate::topography::Rows;

pub(super) const FORMAT: MapFormat = MapFormat { ending: "xyz", holds_notes: true, write };

fn write(out: &mut dyn Out, map: &dyn Rows, notes: &[Note]) -> io::Result<()> {
    let ([nx, ny], [dx, dy]) = (map.points(), map.pixel());
    for (name, text) in notes {
        writeln!(out, "# {name}: {}", one_line(text))?;
    }
    // The reader takes the grid from this line: coordinates are multiples of the pixel, rounded.
    writeln!(out, "# Grid: {nx} x {ny} points, {dx:e} x {dy:e}")?;
    writeln!(out, "# x [m] y [m] z [m]")?;
    let mut iy = 0;
    each_line(map, |line| {
        let y = iy as f64 * dy;
        iy += 1;
        let mut present = line.iter().enumerate().filter(|(_, z)| !z.is_nan());
        present.try_for_each(|(ix, z)| writeln!(out, "{:e} {y:e} {z:e}", ix as f64 * dx))
    })
}
