//! A random rough surface of a given spectrum, its summits, and its output to a `.npy` file.
//!
//! `cargo run --release -p asperity --example generated_surface [FILE]`

use std::error::Error;
use std::fs::File;
use std::path::PathBuf;

use asperity::topography::generate::{Process, Seeds, SpectrumOf, SurfaceGenerator};
use asperity::topography::read::{ReadOptions, height_map};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumShape};
use asperity::topography::summits::five_point;
use asperity::{AsperitySet, Heights, Statistics, npy};

fn main() -> Result<(), Box<dyn Error>> {
    let temporary = || std::env::temp_dir().join("generated-surface.npy");
    let path = std::env::args().nth(1).map_or_else(temporary, PathBuf::from);

    // Self-affine between two wavelengths, isotropic; the seeds determine all heights.
    let (points, pixel) = ([512; 2], [0.5e-6; 2]);
    let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off: 20e-6, cut_off: 4e-6 };
    let process = Process {
        spectrum: Spectrum::new(shape, Lay::default())?,
        of: SpectrumOf::Heights,
        sigma: 100e-9,
        heights: Heights::GAUSSIAN,
    };
    let generator = SurfaceGenerator { points, pixel, process, plateau: None };
    generator.check()?;
    let (map, _) = generator.surface(Seeds { process: [1; 32], plateau: [2; 32] })?;

    // A .npy file stores heights only: the pixel is given again on reading. The first index is x.
    npy::write(File::create(&path)?, points, map.heights().iter().copied())?;
    let read = height_map(&path, ReadOptions { pixel: Some(pixel), unit: None })?;
    println!(
        "{}: {} x {} heights in m, pixel {:.1} um\n",
        path.display(),
        points[0],
        points[1],
        1e6 * pixel[0]
    );

    println!(
        "{:>9} {:>8} {:>11} {:>17} {:>14}",
        "borders", "summits", "sigma [nm]", "mean radius [um]", "density [/m^2]"
    );
    // The file does not record that the map is periodic: summits on the border are lost.
    for (borders, map) in [("periodic", &map), ("open", &read)] {
        let summits = five_point(map);
        let radii = summits.curvatures.iter().map(|curvature| curvature.recip()).collect();
        let set = AsperitySet::new(summits.heights, radii, pixel[0] * pixel[1] * summits.tested as f64)?;
        let statistics = Statistics::new(&set);
        println!(
            "{borders:>9} {:8} {:11.2} {:17.3} {:14.3e}",
            set.count(),
            1e9 * statistics.sigma,
            1e6 * statistics.mean_radius,
            set.density(),
        );
    }
    Ok(())
}
