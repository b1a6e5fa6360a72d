//! The measured surfaces of `experiments/surfaces/` against their documented properties (README there).

use std::path::Path;

use asperity::HeightMap;
use asperity::topography::summits::{Summits, five_point};
use asperity::topography::{Level, Moments, Quantisation, RoughnessParameters, read};

struct Known {
    name: &'static str,
    points: [usize; 2],
    /// In nm, to a tenth.
    pixel: [f64; 2],
    missing: usize,
    /// Sq in nm, Ssk, Sku after the least-squares plane, to the digits given.
    moments: [(f64, f64); 3],
    summits: usize,
}

const SURFACES: [Known; 4] = [
    Known {
        name: "opd-1.npy",
        points: [640, 480],
        pixel: [196.73303177114576; 2],
        missing: 116,
        moments: [(6.711, 5e-4), (-0.367, 5e-4), (4.538, 5e-4)],
        summits: 24714,
    },
    Known {
        name: "plu-1.npy",
        points: [768, 576],
        pixel: [1660.0000858306884; 2],
        missing: 0,
        moments: [(18.28, 5e-3), (-0.443, 5e-4), (9.245, 5e-4)],
        summits: 32958,
    },
    Known {
        name: "al3d-1.npy",
        points: [200, 296],
        pixel: [438.027; 2],
        missing: 0,
        moments: [(289.8, 5e-2), (-0.005, 5e-4), (3.071, 5e-4)],
        summits: 489,
    },
    Known {
        name: "x3p-2.x3p",
        points: [650, 650],
        pixel: [127.7, 314.6],
        missing: 0,
        moments: [(77.19, 5e-3), (-0.379, 5e-4), (2.985, 5e-4)],
        summits: 2916,
    },
];

fn read_and_level(known: &Known) -> (HeightMap, HeightMap, Summits) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../experiments/surfaces").join(known.name);
    let pixel = known.pixel.map(|size| 1e-9 * size);
    // An array states none.
    let given = read::ReadOptions { pixel: Some(pixel).filter(|_| known.name.ends_with("npy")), unit: None };
    let raw = read::height_map(&path, given).unwrap();
    assert!(raw.pixel().iter().zip(pixel).all(|(found, known)| (found - known).abs() <= 5e-11));
    let levelled = Level::Plane.apply(&raw).unwrap();
    let summits = five_point(&levelled);
    (raw, levelled, summits)
}

#[test]
fn statistics_to_every_digit_known() {
    for known in &SURFACES {
        let (raw, levelled, summits) = read_and_level(known);
        assert_eq!(
            (raw.points(), RoughnessParameters::new(&raw).missing),
            (known.points, known.missing),
            "{}",
            known.name
        );
        let moments = Moments::from_rows(&levelled);
        let found = [moments.sq * 1e9, moments.ssk.unwrap(), moments.sku.unwrap()];
        for (found, (exact, digit)) in found.into_iter().zip(known.moments) {
            assert!((found - exact).abs() <= digit, "{}: {found} for {exact}", known.name);
        }
        assert_eq!(summits.heights.len(), known.summits, "{}", known.name);
        assert!(summits.curvatures.iter().all(|&curvature| curvature > 0.0));
    }
}

#[test]
fn the_maps_on_steps_are_found_and_the_sound_one_is_not() {
    let look = |known: &Known| {
        let (raw, _, summits) = read_and_level(known);
        Quantisation::new(&raw, &summits, false)
    };
    let [opd, plu, al3d] = [&SURFACES[0], &SURFACES[1], &SURFACES[2]].map(look);
    println!("{opd:?}\n{plu:?}\n{al3d:?}");
    assert!(opd.step.is_none());
    assert_eq!(opd.levels, 275_628);
    assert!(opd.distinct_curvatures > 10_000);
    for (found, step) in [(plu, 3.906e-9), (al3d, 7.45e-9)] {
        assert!((found.step.unwrap() / step - 1.0).abs() < 5e-4);
        assert!(found.step.unwrap() > found.median_drop / 3.0);
    }
    // Curvatures are whole multiples of half a step over a squared pixel; so many values occur.
    assert_eq!((plu.distinct_curvatures, al3d.distinct_curvatures), (20, 14));
}

#[test]
fn plateaus_of_the_raw_map() {
    let (raw, ..) = read_and_level(&SURFACES[1]);
    let summits = five_point(&raw);
    assert_eq!(summits.heights.len() - (summits.plateaus - summits.dropped), 888);
    assert_eq!(summits.plateaus, 238);
}
