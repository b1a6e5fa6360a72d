//! The current through given spots, and through those of a contact.

use std::f64::consts::PI;

use asperity::Material;
use asperity::bem::{Boundary, ConductingPair, Conductor, ElasticPair, Solver};
use asperity::progress::Silent;
use asperity::spot::LayerFactor;
use asperity::topography::Blocks;

use super::{bare, options, rough, unit_body};

const ERROR: f64 = 1e-10;

/// s = 1 ohm m.
fn unit_pair() -> ConductingPair {
    ConductingPair::new(0.5, 1.5, None)
}

/// The conductance times s of the points of a finite map at which `is_spot` holds of the place (m), off the symmetry of the grid.
fn of_spot(points: [usize; 2], pixel: f64, film: f64, is_spot: impl Fn([f64; 2]) -> bool + Sync) -> f64 {
    let [nx, ny] = points;
    let conductor = Conductor::new(points, [pixel; 2], Boundary::Finite, &unit_pair(), film, ERROR).unwrap();
    let place = |k: usize| {
        [(k / ny) as f64 - 0.5 * nx as f64 - 0.317, (k % ny) as f64 - 0.5 * ny as f64 + 0.171]
            .map(|x| x * pixel)
    };
    let current = conductor.through(&|k| is_spot(place(k)), &Silent).unwrap();
    assert!(current.densities().iter().all(|&density| density >= 0.0), "no current flows back");
    current.conductance() * (nx * ny) as f64 * pixel * pixel
}

/// Spots whose conductance is known, with 8, 16, 32 and 64 pixels to their smallest radius. The border of a patch that is given
/// acts a tenth of a pixel inside of it.
#[test]
fn discs_ellipses_and_squares() {
    type Shape = (&'static str, [f64; 2], fn([f64; 2]) -> bool, f64);
    // Of an ellipse pi a/K(m), m = 1 - 1/9: K = 2.5286 by tables of complete elliptic integrals, here by 2 a AGM(1, b/a).
    let mean = (0..6).fold([1.0, 1.0 / 3.0], |[a, g]: [f64; 2], _| [0.5 * (a + g), (a * g).sqrt()])[0];
    let shapes: [Shape; 3] = [
        ("disc", [2.2, 2.2], |[x, y]| x.hypot(y) <= 1.0, 2.0),
        ("ellipse", [6.2, 2.2], |[x, y]| (x / 3.0).hypot(y) <= 1.0, 6.0 * mean),
        // The capacity of a square of unit side is 0.366788 x 4 pi epsilon.
        ("square", [2.2, 2.2], |[x, y]| x.abs() <= 1.0 && y.abs() <= 1.0, 2.0 * PI * 0.366_788),
    ];
    for (name, sides, is_spot, exact) in shapes {
        for (pixels, most) in [(8, 2.5e-2), (16, 1.2e-2), (32, 6e-3), (64, 3e-3)] {
            let pixel = 1.0 / f64::from(pixels);
            let points = sides.map(|side: f64| (side / pixel).ceil() as usize);
            let error = of_spot(points, pixel, 0.0, is_spot) / exact - 1.0;
            assert!(error.abs() < most, "{name}, {pixels} pixels: {error:e}");
        }
    }
}

/// Two equal discs at the distance d: 1/(4 a) + 1/(2 pi d) (Greenwood 1966), to the order of (a/d)^3. The radius is that of one of them on
/// the same grid, so that its discretisation does not count.
#[test]
fn neighbours_in_a_cluster_raise_the_resistance() {
    let pixel = 1.0 / 8.0;
    let disc = |at: f64, [x, y]: [f64; 2]| (x - at).hypot(y) <= 1.0;
    let alone = of_spot([20, 20], pixel, 0.0, |place| disc(0.0, place)) / 2.0;
    for distance in [10.0, 16.0] {
        // Even, so that each disc covers the grid as the one alone does.
        let points = [2 * ((0.5 * distance + 1.2) / pixel) as usize, 20];
        let both =
            of_spot(points, pixel, 0.0, |place| disc(-0.5 * distance, place) || disc(0.5 * distance, place));
        let expected = (4.0 * alone).recip() + (2.0 * PI * distance).recip();
        assert!(
            (both * expected - 1.0).abs() < 2.0 * distance.powi(-3),
            "{distance}: {}",
            both * expected - 1.0
        );
        assert!(both < 4.0 * alone);
    }
}

/// On an interface without end the same neighbours lower the resistance: of discs on a square lattice of pitch L by 3.9003/(pi L) s, to the
/// order of (a/L)^3, 3.9003 being Wigner's constant of the lattice. Between two pitches the discretisation cancels.
#[test]
fn neighbours_of_an_interface_share_the_flow() {
    let resistance = |count: usize| {
        let conductor =
            Conductor::new([count; 2], [1.0; 2], Boundary::Periodic, &unit_pair(), 0.0, ERROR).unwrap();
        let middle = 0.5 * count as f64;
        let is_spot = |k: usize| {
            ((k / count) as f64 - middle - 0.317).hypot((k % count) as f64 - middle + 0.171) <= 8.0
        };
        (conductor.through(&is_spot, &Silent).unwrap().conductance() * (count * count) as f64).recip()
    };
    let [near, far] = [160, 320].map(resistance);
    let expected = 3.900_265 / PI * (1.0 / 160.0 - 1.0 / 320.0);
    assert!(((far - near) / expected - 1.0).abs() < 5e-3, "{}", (far - near) / expected);
}

/// A film on a disc: more than with the equilibrium current of a bare spot, less than with a uniform one, in which both resistances add.
#[test]
fn a_film_on_a_disc() {
    for beta in [0.1_f64, 0.3, 1.0, 10.0] {
        let disc = |[x, y]: [f64; 2]| x.hypot(y) <= 1.0;
        let resistance = of_spot([40, 40], 1.0 / 16.0, beta, disc).recip();
        let [series, uniform] = [0.5, 16.0 / (3.0 * PI * PI)].map(|bare| bare + beta / PI);
        let place = (resistance - series) / (uniform - series);
        assert!((0.0..1.0).contains(&place), "{beta}: {place}");
    }
}

/// A thick layer is a half-space of its material, a thin one none; a film is a thin layer of great resistivity.
#[test]
fn layers_between_their_limits() {
    let of = |layer: Option<(f64, f64)>, film: f64| {
        let pair = ConductingPair::new(0.3, 1.0, layer);
        let conductor = Conductor::new([96, 96], [1.0; 2], Boundary::Mirrored, &pair, film, ERROR).unwrap();
        let is_spot = |k: usize| ((k / 96) as f64 - 40.3).hypot((k % 96) as f64 - 50.1) <= 8.0;
        conductor.through(&is_spot, &Silent).unwrap().conductance().recip()
    };
    let bare = of(None, 0.0);
    assert!((of(Some((1.0, 5.0)), 0.0) / bare - 1.0).abs() < 1e-12);
    assert!((of(Some((20.0, 1e-4)), 0.0) / bare - 1.0).abs() < 1e-3);
    assert_eq!(of(Some((20.0, f64::INFINITY)), 0.0), of(Some((20.0, 1e4)), 0.0));
    let each = [0.0, 1.0, 4.0, 16.0, 64.0].map(|thickness| of(Some((4.0, thickness)), 0.0));
    assert!(each.is_sorted() && each[1] > 1.2 * each[0]);
    // The layer also lies under the uniform flow, beyond which the potential is.
    let [thin, film] = [of(Some((1e6, 1e-4)), 0.0) + 1e2, of(None, 1e2)];
    assert!((thin / film - 1.0).abs() < 1e-6, "{thin} {film}");
    let layered = ConductingPair::new(1.0, 1.0, Some((2.0, 1.0)));
    assert!(Conductor::new([8, 8], [1.0; 2], Boundary::Finite, &layered, 0.0, ERROR).is_err());
}

/// A spot on a layer: the factor of a single spot, less what the other spots of the lattice and the uniform flow through the layer
/// change. The patch is the same without the layer.
#[test]
fn a_layer_under_a_spot() {
    const COUNT: usize = 256;
    const RADIUS: f64 = 8.0;
    let middle = 0.5 * COUNT as f64;
    let is_spot =
        |k: usize| ((k / COUNT) as f64 - middle - 0.317).hypot((k % COUNT) as f64 - middle + 0.171) <= RADIUS;
    let area = (COUNT * COUNT) as f64;
    let lattice = 3.900_265 / (2.0 * PI * COUNT as f64);
    let resistance = |layer: Option<(f64, f64)>| {
        let pair = ConductingPair::new(1e-9, 1.0, layer);
        let conductor = Conductor::new([COUNT; 2], [1.0; 2], Boundary::Periodic, &pair, 0.0, ERROR).unwrap();
        let of_lattice = (conductor.through(&is_spot, &Silent).unwrap().conductance() * area).recip();
        // The layer lies under the uniform flow, too.
        of_lattice
            + lattice
            + layer.map_or(0.0, |(ratio, thickness)| (ratio - ratio.recip()) * thickness / area)
    };
    let bare = resistance(None);
    for ratio in [0.5, 5.0, 50.0] {
        let factor = LayerFactor::new(ratio).unwrap();
        for thickness in [0.25, 1.0] {
            let found = resistance(Some((ratio, thickness * RADIUS))) / bare;
            let error = found / factor.at(thickness) - 1.0;
            assert!(error.abs() < 2e-2, "{ratio}, {thickness}: {found} {}", factor.at(thickness));
        }
    }
}

/// Without yielding the conductance is the stiffness over E* s, for any contact and boundary (Barber 2003).
#[test]
fn conductance_is_the_stiffness_of_an_elastic_contact() {
    let body = Material::new(2.0, 0.3, None, None).unwrap();
    let pair = ElasticPair::new(&body, &unit_body(), None);
    let map = rough([96, 80], 0.8, 0.25, 8.0 / 96.0, 5);
    for boundary in Boundary::ALL {
        let solver = Solver::new(&map, &pair, &options(boundary, 1e-11, None)).unwrap();
        let conducting = ConductingPair::new(3.0, 1.0, None);
        let conductor = Conductor::new(map.points(), map.pixel(), boundary, &conducting, 0.0, 1e-11).unwrap();
        for load in [0.01, 0.1] {
            let contact = solver.at_pressure(load, &Silent).unwrap();
            let stiffness = solver.tangent(&contact, &Silent).unwrap().stiffness_of_approach();
            let current = conductor.current(&contact, &Silent).unwrap();
            let ratio = current.conductance() * pair.reduced_modulus() * 2.0 / stiffness;
            assert!((ratio - 1.0).abs() < 1e-8, "{}: {ratio}", boundary.name());
            let shares = current.block_shares(&Blocks { points: map.points(), counts: [4, 4] });
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }
}

/// Points at the cap conduct, too, while their pressure cannot grow: the conductance is then above what the stiffness would say.
#[test]
fn spots_that_yield_conduct() {
    let map = rough([96, 80], 0.8, 0.25, 8.0 / 96.0, 5);
    let pair = bare();
    let solver = Solver::new(&map, &pair, &options(Boundary::Periodic, 1e-9, Some(0.3))).unwrap();
    let contact = solver.at_pressure(0.02, &Silent).unwrap();
    assert!(contact.capped_area_ratio() > 0.0);
    let conducting = ConductingPair::new(1.0, 1.0, None);
    let conductor =
        Conductor::new(map.points(), map.pixel(), Boundary::Periodic, &conducting, 0.0, 1e-9).unwrap();
    let conductance = conductor.current(&contact, &Silent).unwrap().conductance();
    assert!(conductance > 1.2 * solver.tangent(&contact, &Silent).unwrap().stiffness());
}

/// Full contact conducts without a constriction; no contact does not conduct.
#[test]
fn full_contact_and_none() {
    let of = |is_spot: bool| {
        let conductor =
            Conductor::new([16, 16], [1.0; 2], Boundary::Periodic, &unit_pair(), 0.0, ERROR).unwrap();
        conductor.through(&move |_| is_spot, &Silent).map(|current| current.conductance())
    };
    assert_eq!((of(true), of(false)), (None, None));
}
