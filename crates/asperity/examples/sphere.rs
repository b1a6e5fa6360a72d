//! A steel sphere pressed into a steel flat: area, load and regime against indentation, by the elastic-plastic law of
//! Zhao, Maietta and Chang.
//!
//! `cargo run --release -p asperity --example sphere`

use std::error::Error;

use asperity::{Interface, Material, MicroContact, Shape, Zmc};

fn main() -> Result<(), Box<dyn Error>> {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None)?;
    let contact = Interface::bare(Zmc::default(), &steel, &steel)?;
    let sphere = Shape::sphere(20e-6);

    // The changes of regime: the onset of yield w1, and full plasticity from w2 on.
    let critical = contact.regime_changes(sphere);
    let [onset, .., fully_plastic] = &critical[..] else { return Err("the law has one regime only".into()) };
    println!("onset of yield at {:.3} nm, fully plastic from {:.1} nm\n", 1e9 * onset, 1e9 * fully_plastic);

    println!("{:>9} {:>11} {:>9} {:>14}  regime", "w [nm]", "area [um^2]", "load [mN]", "pressure [GPa]");
    for part in [0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 54.0, 70.0] {
        let w = part * onset;
        let at = contact.contact(w, sphere);
        println!(
            "{:9.2} {:11.4} {:9.4} {:14.3}  {}",
            1e9 * w,
            1e12 * at.area,
            1e3 * at.load,
            1e-9 * at.load / at.area,
            at.regime.name(),
        );
    }
    Ok(())
}
