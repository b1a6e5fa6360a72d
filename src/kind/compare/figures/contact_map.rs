//! The height map of a measured surface with what is in contact on it, load by load.

use asperity_contact_framework::report::format::{count, percent, quantity};
use asperity_contact_framework::report::page::Page;
use asperity_plot::{Axis, Colour, ColourMap, Figure, Frames, Layer, Patches, Plot, Raster};

use crate::kind::compare::contact_map::{ContactMap, MapPatches};
use crate::surface::section::{length_unit, nth};

/// Radius of the smallest circle over the side of the map: smaller ones would not be seen.
const LEAST: f64 = 0.003;

/// Adds the map of the surface `name`.
pub fn add(page: &mut Page, name: &str, map: &ContactMap) {
    let what = what(map);
    let slider = if map.loads.len() > 1 { "; in a browser a slider changes the load" } else { "" };
    let load = quantity(map.loads[map.reported].pressure, "Pa");
    page.figure(
        &format!("{name}-contact-map.svg"),
        figure(name, map),
        &format!("Height map of {name}, and what is {what} at {load}{slider}."),
    );
}

fn what(map: &ContactMap) -> &'static str {
    if map.is_of_sum { "in contact in the sum" } else { "in contact in the boundary elements" }
}

fn figure(name: &str, map: &ContactMap) -> Figure {
    let [nx, ny] = map.heights.points();
    let sides = [0, 1].map(|axis| [nx, ny][axis] as f64 * map.heights.pixel()[axis]);
    let (length, unit) = length_unit(sides[0].max(sides[1]));
    let ends = sides.map(|side| (0.0, side / length));
    // An image has x fastest, a map y.
    let heights: Vec<f64> = (0..ny)
        .flat_map(|iy| (0..nx).map(move |ix| ix * ny + iy))
        .map(|at| map.heights.heights()[at])
        .collect();
    let mut present: Vec<f64> = heights.iter().copied().filter(|z| !z.is_nan()).collect();
    // A few pits and peaks do not take all greys.
    let last = present.len().saturating_sub(1) as f64;
    let [low, high] = [0.005, 0.995].map(|share| nth(&mut present, (share * last) as usize).unwrap_or(0.0));
    let (height, height_unit) = length_unit(low.abs().max(high.abs()));
    let relief = Raster {
        x: ends[0],
        y: ends[1],
        columns: nx,
        rows: ny,
        values: heights.into_iter().map(|z| z / height).collect(),
        map: ColourMap::Relief,
        limits: Some((low / height, high / height)),
        label: format!("height ({height_unit})"),
    };
    let patches = match &map.patches {
        MapPatches::Circles { places, radii } => {
            let least = LEAST * sides[0].max(sides[1]);
            let shown = |radii: &Vec<f64>| radii.iter().map(|radius| radius.max(least) / length).collect();
            let centres = places.iter().map(|[x, y]| (x / length, y / length)).collect();
            Patches::Circles { centres, radii: radii.iter().map(shown).collect() }
        }
        MapPatches::Cells { cells: [columns, rows], covered } => {
            let turned = |one: &Vec<u8>| {
                (0..*rows)
                    .flat_map(|iy| (0..*columns).map(move |ix| ix * rows + iy))
                    .map(|at| one[at])
                    .collect()
            };
            let covered = covered.iter().map(turned).collect();
            Patches::Cells { x: ends[0], y: ends[1], cells: [*columns, *rows], covered }
        }
    };
    let names = map.loads.iter().map(|load| {
        let contacts =
            load.contacts.map_or_else(String::new, |contacts| format!("{} contacts, ", count(contacts)));
        format!("{}: {contacts}{} of the area", quantity(load.pressure, "Pa"), percent(load.area_ratio))
    });
    let frames = Frames { label: "load".to_owned(), names: names.collect(), shown: map.reported, patches };
    let axis = |name: &str, ends: (f64, f64)| Axis::linear(format!("{name} ({unit})")).range(ends.0, ends.1);
    Plot::new(format!("{name}: contacts on the height map"), axis("x", ends[0]), axis("y", ends[1]))
        .height(420.0)
        .equal_aspect()
        .with(Layer::raster(relief))
        .with(Layer::frames(frames).coloured(Colour::Deterministic).named(what(map)))
        .into()
}
