//! Files of instruments, cut to a part of their points: what other programs read of them.

use asperity::topography::RoughnessParameters;
use std::f64::consts::TAU;
use std::ops::Range;

use super::*;

/// A file, the channel of its heights, its points, its pixel (m), how many points are missing, and heights (m) at some places. They are those of
/// SurfaceTopography 1.27.1; of NID those of NSFopen 2.2.4, its lines in reverse order; of DATX those of h5py 3.16, times the factors that
/// the file states.
type Sample = (&'static str, &'static str, [usize; 2], [f64; 2], usize, [(usize, usize, f64); 5]);

#[rustfmt::skip]
const SAMPLES: &[Sample] = &[
    ("asylum.ibw", "HeightTrace", [32, 16], [7.843137254901961e-8, 7.843137254901961e-8], 0, [(0, 0, -3.760929416785075e-7), (31, 0, -4.10205842626965e-7), (0, 15, -3.3123345133390103e-7), (31, 15, -3.743787999610504e-7), (10, 8, -3.8863552731527307e-7)]),
    ("jpk-map.jpk", "Height", [10, 10], [6e-5, 6e-5], 0, [(0, 0, 6.638862237024043e-5), (9, 0, 7.22072069861659e-5), (0, 9, 3.1827157220887316e-5), (9, 9, 3.687123931572108e-5), (3, 5, 6.103663280514462e-5)]),
    ("nanosurf.gwy", "Topography", [100, 12], [1e-7, 1e-7], 0, [(0, 0, 7.707079372957411e-6), (99, 0, 7.718533725262557e-6), (0, 11, 7.696866704026902e-6), (99, 11, 7.718186160826164e-6), (33, 6, 7.732130729342e-6)]),
    ("park.tiff", "Topography", [128, 128], [1.5625e-8, 1.5625e-8], 0, [(0, 0, 1.4509294755407607e-7), (127, 0, 1.5023667766945436e-7), (0, 127, 8.831312478287145e-8), (127, 127, 8.562943950528278e-8), (42, 64, 1.1231719865463673e-7)]),
    ("st-di-3.spm", "Height Sensor", [64, 32], [3.90625e-8, 3.90625e-8], 0, [(0, 0, 6.668611037791673e-8), (63, 0, -1.1707117155234268e-7), (0, 31, -3.852975266279633e-8), (63, 31, -1.1084713458373712e-7), (21, 16, 1.778296276744446e-8)]),
    ("st-al3d-1.al3d", "Depth", [99, 100], [4.3802700000000004e-7, 4.38027e-7], 0, [(0, 0, 7.634811103343964e-2), (98, 0, 7.634153962135315e-2), (0, 99, 7.63401985168457e-2), (98, 99, 7.633336633443832e-2), (33, 50, 7.634107023477554e-2)]),
    ("st-bcrf-1.bcrf", "Heights", [120, 100], [1.8514625e-6, 1.851463333e-6], 0, [(0, 0, 5.063079071044922e-5), (119, 0, 5.0639728546142584e-5), (0, 99, 5.0636810302734376e-5), (119, 99, 5.064089584350586e-5), (40, 50, 5.0636890411376956e-5)]),
    ("st-metropro-1.dat", "Phase", [100, 90], [1.0982520279867458e-6, 1.0982520279867458e-6], 0, [(0, 0, 5.070258522008042e-5), (99, 0, 5.074397666886797e-5), (0, 89, 5.0706873092375496e-5), (99, 89, 5.0744750747233613e-5), (33, 45, 5.0716231612841015e-5)]),
    ("st-nid-1.nid", "Scan forward (Z-Axis)", [28, 26], [7.8125e-8, 7.8125e-8], 0, [(0, 0, -1.3065645013377072e-6), (27, 0, -1.3936726432219149e-6), (0, 25, -1.3306794077530506e-6), (27, 25, -1.4153901371732353e-6), (9, 13, -1.3491071370095015e-6)]),
    ("st-opd-1.opd", "Raw", [64, 56], [1.9673303177114576e-7, 1.9673303177114578e-7], 95, [(0, 0, -2.742933089446524e-7), (63, 0, -2.828755450058998e-7), (0, 55, -2.8051013533303194e-7), (63, 55, -2.8316546193124127e-7), (21, 28, -2.790974204452723e-7)]),
    ("st-plu-1.plu", "Layer 1", [120, 100], [1.6600000858306886e-6, 1.6600000858306886e-6], 0, [(0, 0, -1.0730859375e-4), (119, 0, -1.057890625e-4), (0, 99, -1.0727734374999999e-4), (119, 99, -1.0574609374999999e-4), (40, 50, -1.0677734374999999e-4)]),
    ("st-sur-2.sur", "Z", [110, 110], [3.4840002190321687e-6, 3.4840002190321687e-6], 51, [(0, 0, 1.0162600118761134e-5), (109, 0, 1.0155500118678162e-5), (0, 109, 1.0128200118359131e-5), (109, 109, f64::NAN), (36, 55, 1.014350011853793e-5)]),
    ("zygo_test.datx", "Surface", [33, 96], [1.0000000474974513e-3, 1.0000000474974513e-3], 288, [(0, 0, 1.2533055123082136e-7), (32, 0, f64::NAN), (0, 95, f64::NAN), (32, 95, f64::NAN), (11, 48, -2.4794186915328787e-8)]),
];

#[test]
fn samples_hold_what_other_programs_read() {
    for &(name, channel, points, pixel, missing, heights) in SAMPLES {
        let path = sample("samples").join(name);
        let head = metadata(&path).unwrap();
        let map = height_map(&path, AS_IT_IS).unwrap();
        assert_eq!((head.points, map.points(), head.has_unit), (points, points, true), "{name}");
        assert_eq!(head.channel.unwrap().name, channel, "{name}");
        assert_eq!(RoughnessParameters::new(&map).missing, missing, "{name}");
        let close = |a: f64, b: f64, scale: f64| (a - b).abs() <= 1e-9 * scale;
        let size = head.pixel.unwrap();
        assert!((0..2).all(|axis| close(size[axis], pixel[axis], pixel[axis])), "{name}: {size:?}");
        let [low, high] = [f64::INFINITY, f64::NEG_INFINITY];
        let (low, high) = map.heights().iter().fold((low, high), |(low, high), &z| (low.min(z), high.max(z)));
        for (ix, iy, wanted) in heights {
            let found = map.heights()[ix * points[1] + iy] + map.offset();
            let same = close(found, wanted, high - low) || found.is_nan() && wanted.is_nan();
            assert!(same, "{name}, x {ix}, y {iy}: {found:e} for {wanted:e}");
        }
    }
}

/// Files of 1 um x (cos x cos y + 0.3 sin x) with a hole; the wavelengths are those of SDF or of X3P.
#[test]
fn samples_hold_the_heights_they_were_made_of() {
    let sdf = |name: &str, step: f64| {
        (format!("{name}.sdf"), [48, 32], (20..30, 10..14), [2e-6, 3e-6], [40e-6, 36e-6, 14e-6], 0.51 * step)
    };
    let x3p = |name: &str, points: [usize; 2], hole: [Range<usize>; 2], tolerance: f64| {
        let [x, y] = hole;
        (format!("{name}.x3p"), points, (x, y), [1e-6; 2], [24e-6, 16e-6, 9e-6], tolerance)
    };
    for (name, points, hole, pixel, waves, tolerance) in [
        sdf("iso1_surface_ascii", 1e-10),
        sdf("iso1_surface_binary", 1e-10),
        sdf("iso1_surface_int32_ascii", 1e-13),
        sdf("iso1_surface_int32_binary", 1e-13),
        sdf("iso1_surface_binary64_binary", 1e-21),
        sdf("iso2_surface_binary32_ascii", 2e-12),
        sdf("iso2_surface_binary32_binary", 2e-13),
        sdf("iso2_surface_int8_ascii", 2e-8),
        sdf("iso2_surface_int8_binary", 2e-8),
        sdf("bcr1_surface_ascii", 1e-10),
        sdf("bcr1_surface_binary", 1e-10),
        sdf("bcr1_surface_int32_binary", 1e-13),
        sdf("bcr1_surface_uint16_ascii", 1e-10),
        sdf("bcr1_surface_uint16_binary", 1e-10),
        x3p("surface_binary", [200, 150], [70..85, 40..52], 2e-11),
        x3p("surface_binary_2017", [200, 150], [70..85, 40..52], 2e-11),
        x3p("surface_xml", [200, 150], [70..85, 40..52], 2e-11),
        x3p("surface_int32_binary", [120, 90], [40..50, 30..36], 3e-16),
        x3p("surface_int32_xml", [120, 90], [40..50, 30..36], 3e-16),
        x3p("surface_placed_binary", [120, 90], [0..0, 0..0], 1e-20),
        x3p("surface_extensions_binary", [100, 80], [0..0, 0..0], 1e-13),
    ] {
        let path = sample(&name);
        let map = height_map(&path, AS_IT_IS).unwrap();
        assert_eq!(metadata(&path).unwrap().points, points, "{name}");
        assert_eq!((map.points(), map.pixel()), (points, pixel), "{name}");
        assert_eq!(map.offset(), if name.contains("placed") { 1.0 } else { 0.0 }, "{name}");
        // The first profile of the BCR files is that of the greatest y.
        let row = |iy: usize| if name.starts_with("bcr1") { points[1] - 1 - iy } else { iy };
        let place = |k: usize| [k / points[1], row(k % points[1])];
        let wave = |k: usize| {
            let [ix, iy] = place(k);
            let [x, y] = [ix as f64 * pixel[0], iy as f64 * pixel[1]];
            let of = |length: f64, wave: f64| TAU * length / wave;
            1e-6 * (of(x, waves[0]).cos() * of(y, waves[1]).cos() + 0.3 * of(x, waves[2]).sin())
        };
        let exact: Vec<f64> = (0..points[0] * points[1]).map(wave).collect();
        // The unsigned surface lies above zero.
        let raised = if name.contains("uint16") { -exact.iter().copied().fold(0.0, f64::min) } else { 0.0 };
        for (k, (found, exact)) in map.heights().iter().zip(exact).enumerate() {
            let [ix, iy] = place(k);
            let missing = hole.0.contains(&ix) && hole.1.contains(&iy);
            assert_eq!(found.is_nan(), missing, "{name} {ix} {iy}");
            let near = (found - exact - raised).abs() <= tolerance;
            assert!(missing || near, "{name} {ix} {iy}: {found} {exact}");
        }
    }
}

#[test]
fn samples_of_no_surface_are_refused() {
    for (name, words) in [
        ("iso1_profile_binary.sdf", "single profile"),
        ("profile_int16_binary.x3p", "FeatureType = PRF"),
        ("point_cloud_int16_binary.x3p", "PCL"),
    ] {
        let error = metadata(&sample(name)).unwrap_err();
        assert!(matches!(&error, ReadError::Unsupported(text) if text.contains(words)), "{error}");
    }
}

#[test]
fn every_sample_is_compared() {
    for file in std::fs::read_dir(sample("samples")).unwrap() {
        let name = file.unwrap().file_name();
        assert!(name == "README.md" || SAMPLES.iter().any(|sample| name == sample.0), "{name:?}");
    }
}
