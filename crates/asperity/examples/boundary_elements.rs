//! The contact of a height map by boundary elements, load by load.
//!
//! `cargo run --release -p asperity --example boundary_elements -- MAP.npy ERROR PRESSURE... [--mirrored | --finite]
//! [--cap H]`, for a map on a unit square, pressures over E*: prints area, gap and work of each load, and the time.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use asperity::bem::{Boundary, ElasticPair, Options, Solver};
use asperity::progress::Silent;
use asperity::topography::read::{ReadOptions, height_map};
use asperity::{HeightMap, Material};

fn main() -> Result<(), Box<dyn Error>> {
    let mut numbers = Vec::new();
    let (mut path, mut boundary, mut cap) = (None, Boundary::Periodic, None);
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match &*argument {
            "--mirrored" => boundary = Boundary::Mirrored,
            "--finite" => boundary = Boundary::Finite,
            "--cap" => cap = arguments.next().map(|h| h.parse()).transpose()?,
            _ if path.is_none() => path = Some(argument),
            number => numbers.push(number.parse::<f64>()?),
        }
    }
    // Without a file, waves of two lengths.
    let map = match path {
        Some(path) => {
            let map = height_map(Path::new(&path), ReadOptions { pixel: Some([1.0; 2]), unit: None })?;
            let points = map.points();
            HeightMap::new(points, points.map(|count| (count as f64).recip()), map.into_heights(), 0.0)?
        }
        None => {
            let wave = |k: usize, waves: f64| (std::f64::consts::TAU * waves * k as f64 / 256.0).cos();
            let height = |k: usize| {
                0.01 * wave(k / 256, 5.0) * wave(k % 256, 7.0)
                    + 0.01 * wave(k / 256, 1.0) * wave(k % 256, 2.0)
            };
            HeightMap::new([256; 2], [1.0 / 256.0; 2], (0..256 * 256).map(height).collect(), 0.0)?
        }
    };
    let (error, pressures) = match numbers.split_first() {
        Some((&error, pressures)) => (error, pressures.to_vec()),
        None => (1e-8, vec![1e-4, 1e-3, 1e-2, 1e-1]),
    };
    // Two bodies of E = 2 Pa and no lateral expansion: E* = 1 Pa.
    let body = Material::new(2.0, 0.0, None, None)?;
    let start = Instant::now();
    let solver = Solver::new(&map, &ElasticPair::new(&body, &body, None), &Options { boundary, error, cap })?;
    println!("made in {:.3} s", start.elapsed().as_secs_f64());
    for pressure in pressures {
        let begin = Instant::now();
        let contact = solver.at_pressure(pressure, &Silent)?;
        println!(
            "p/E* {pressure:.3e}: area {:.9} (corrected {:.6}, capped {:.6}), mean gap {:.9e}, load error {:.1e}, error {:.2e}, \
             {} steps, {} convolutions, {:.3} s",
            contact.raw_area_ratio(),
            contact.area_ratio(),
            contact.capped_area_ratio(),
            contact.mean_gap(),
            contact.pressure() / pressure - 1.0,
            contact.error,
            contact.steps,
            contact.convolutions,
            begin.elapsed().as_secs_f64(),
        );
    }
    println!("in all {:.3} s", start.elapsed().as_secs_f64());
    Ok(())
}
