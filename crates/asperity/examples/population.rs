//! A population of asperities with Gaussian heights in both models: the integral over the density, and the sum over 10
//! 000 asperities drawn from it.
//!
//! `cargo run --release -p asperity --example population`

use std::error::Error;

use asperity::{
    Deterministic, Draw, Heights, Interface, Material, Model, Population, Statistical, Zmc, at_pressures,
};

fn main() -> Result<(), Box<dyn Error>> {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None)?;
    let contact = Interface::bare(Zmc::default(), &steel, &steel)?;

    // Table 1 of Pasaribu and Schipper (2005), case 1.
    let population = Population { radius: 20e-6, sigma: 48e-9, density: 6e10, heights: Heights::GAUSSIAN };
    let set = population.set(10_000, Draw::Random([5; 32]))?;
    let sum = Deterministic::new(&contact, set.spheres(), (&population).into());
    let integral = Statistical::new(&contact, population);

    println!("At equal separation: the pressure p, and the standard error of the sum.\n");
    println!("{:>9} {:>16} {:>10} {:>12}", "d [sigma]", "integral p [MPa]", "sum p", "error of sum");
    let separations = [3.0, 2.5, 2.0, 1.5, 1.0];
    for (a, b) in integral.respond_all(&separations).iter().zip(sum.respond_all(&separations)) {
        let error = b.sampling.map_or(0.0, |sampling| sampling.pressure);
        println!(
            "{:9.1} {:16.4} {:10.4} {:12.4}",
            a.separation_over_sigma,
            1e-6 * a.pressure.total(),
            1e-6 * b.pressure.total(),
            1e-6 * error,
        );
    }

    println!("\nAt equal load: the separation and the real area.\n");
    println!(
        "{:>7} {:>18} {:>6} {:>20} {:>8}",
        "p [MPa]", "integral d [sigma]", "sum d", "integral A/A_nom [%]", "sum"
    );
    let pressures = [1e5, 1e6, 1e7, 1e8];
    for (a, b) in at_pressures(&integral, &pressures).into_iter().zip(at_pressures(&sum, &pressures)) {
        // A pressure that is not reached is an error that states the largest one.
        let (a, b) = (a?.response, b?.response);
        println!(
            "{:7.1} {:18.3} {:6.3} {:20.4} {:8.4}",
            1e-6 * a.pressure.total(),
            a.separation_over_sigma,
            b.separation_over_sigma,
            1e2 * a.area_ratio.total(),
            1e2 * b.area_ratio.total(),
        );
    }
    Ok(())
}
