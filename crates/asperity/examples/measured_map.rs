//! A measured surface: from its file through its summits to both models. Compares a Gaussian density with a mean radius
//! against the sum over the measured asperities.
//!
//! `cargo run --release -p asperity --example measured_map [FILE PIXEL_IN_UM]`

use std::error::Error;
use std::path::PathBuf;

use asperity::topography::Level;
use asperity::topography::read::{ReadOptions, height_map};
use asperity::topography::summits::five_point;
use asperity::{
    AsperitySet, Deterministic, Heights, Interface, Material, Population, Statistical, Statistics, Zmc,
    at_pressures,
};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (path, pixel) = match (arguments.next(), arguments.next()) {
        (Some(path), Some(pixel)) => (PathBuf::from(path), 1e-6 * pixel.parse::<f64>()?),
        // A finely finished surface; see experiments/surfaces/README.md for its source.
        _ => (
            concat!(env!("CARGO_MANIFEST_DIR"), "/../../experiments/surfaces/opd-1.npy").into(),
            1.9673303e-7,
        ),
    };

    // A .npy file stores neither pixel nor unit: both are options. Its heights are in m here.
    let map = height_map(&path, ReadOptions { pixel: Some([pixel; 2]), unit: None })?;
    let summits = five_point(&Level::Plane.apply(&map)?);
    let radii = summits.curvatures.iter().map(|curvature| curvature.recip()).collect();
    let set = AsperitySet::new(summits.heights, radii, pixel * pixel * summits.tested as f64)?;
    let statistics = Statistics::new(&set);
    println!(
        "{} summits: sigma {:.2} nm, mean radius {:.2} um, density {:.3e} /m^2, radii vary by {:.0} %\n",
        set.count(),
        1e9 * statistics.sigma,
        1e6 * statistics.mean_radius,
        set.density(),
        1e2 * statistics.radius_cv,
    );

    let steel = Material::new(210e9, 0.3, Some(7.6e9), None)?;
    let contact = Interface::bare(Zmc::default(), &steel, &steel)?;
    let population = Population {
        radius: statistics.mean_radius,
        sigma: statistics.sigma,
        density: set.density(),
        heights: Heights::GAUSSIAN,
    };
    let integral = Statistical::new(&contact, population);
    let sum = Deterministic::new(&contact, set.spheres(), (&statistics).into());

    println!("{:>7} {:>20} {:>9} {:>16}", "p [MPa]", "integral A/A_nom [%]", "sum", "d apart [sigma]");
    let pressures = [1e6, 1e7, 1e8, 2e8];
    for (a, b) in at_pressures(&integral, &pressures).into_iter().zip(at_pressures(&sum, &pressures)) {
        let (a, b) = (a?.response, b?.response);
        println!(
            "{:7.0} {:20.5} {:9.5} {:16.3}{}",
            1e-6 * a.pressure.total(),
            1e2 * a.area_ratio.total(),
            1e2 * b.area_ratio.total(),
            a.separation_over_sigma - b.separation_over_sigma,
            if b.is_beyond_model() { "   (asperities interact)" } else { "" },
        );
    }
    Ok(())
}
