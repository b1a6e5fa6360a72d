//! Zygo DATX files: units of heights, pixels, number types, refusals, a file written by the C library of HDF5.

use super::damage::{cut, damage};
use super::{IN_NM, NX, NY, PIXEL, assert_map, in_lines, sample};
use asperity::topography::read::ReadOptions;
use hdf5_pure::{AttrValue, FileBuilder, MaxExtent};

/// What marks a missing point.
const NO_DATA: f64 = 1e38;

/// The bytes of a file whose surface is made by `write`, with the lateral resolution of `pixel` in micrometres.
fn datx(pixel: Option<f64>, write: impl FnOnce(&mut hdf5_pure::DatasetBuilder)) -> Vec<u8> {
    let mut builder = FileBuilder::new();
    let mut attributes = builder.create_group("Attributes");
    for (name, group, pixel) in [("{1}", 2, Some(7.0)), ("{2}", 1, pixel)] {
        let mut measured = attributes.create_group(name);
        measured.set_attr("Group Number", AttrValue::I32Array(vec![group]));
        if let Some(pixel) = pixel {
            measured.set_attr("Data Context.Lateral Resolution:Value", AttrValue::F64Array(vec![pixel]));
            let unit = AttrValue::VarLenStringArray(vec!["MicroMeters".to_owned()]);
            measured.set_attr("Data Context.Lateral Resolution:Unit", unit);
        }
        attributes.add_group(measured.finish());
    }
    builder.add_group(attributes.finish());
    let mut data = builder.create_group("Data");
    let mut surfaces = data.create_group("Surface");
    let surface = surfaces.create_dataset("{3}");
    surface.with_f64_data(&heights(1.0)).with_shape(&[NY as u64, NX as u64]);
    surface.set_attr("Group Number", AttrValue::I32Array(vec![1]));
    surface.set_attr("No Data", AttrValue::F64Array(vec![NO_DATA]));
    write(surface);
    data.add_group(surfaces.finish());
    let mut intensities = data.create_group("Intensity");
    intensities.create_dataset("{4}").with_u16_data(&[9; NX * NY]).with_shape(&[NY as u64, NX as u64]);
    data.add_group(intensities.finish());
    builder.add_group(data.finish());
    builder.finish().unwrap()
}

fn heights(factor: f64) -> Vec<f64> {
    in_lines().map(|z| if z.is_nan() { NO_DATA } else { z * factor }).collect()
}

fn unit(name: &str) -> AttrValue {
    AttrValue::VarLenStringArray(vec![name.to_owned()])
}

fn in_nm(surface: &mut hdf5_pure::DatasetBuilder) {
    surface.set_attr("Unit", unit("NanoMeters"));
}

const SQUARE: [f64; 2] = [2e-6; 2];
const AS_IT_IS: ReadOptions = ReadOptions { pixel: None, unit: None };

#[test]
fn units_and_number_types() {
    let head = assert_map(datx(Some(2.0), in_nm), AS_IT_IS, 1e-9, SQUARE);
    let channel = head.channel.unwrap();
    assert_eq!(
        (channel.name.as_str(), super::others(&channel).join("")),
        ("Surface", "\"Intensity\" (grey)".to_owned())
    );
    for (name, metres) in
        [("meters", 1e-9), ("Millimeters", 1e-3), ("MicroMeters", 1e-6), ("Angstroms", 1e-10), ("um", 1e-6)]
    {
        let factor = if metres == 1e-9 { 1e-9 } else { 1.0 };
        let bytes = datx(Some(2.0), |surface| {
            surface.with_f64_data(&heights(factor)).set_attr("Unit", unit(name));
        });
        assert_map(bytes, AS_IT_IS, if factor == 1.0 { metres } else { 1e-9 }, SQUARE);
    }
    // Wavelength x scale x obliquity.
    let fringes = datx(Some(2.0), |surface| {
        surface.set_attr("Unit", unit("Fringes")).set_attr("Wavelength", AttrValue::F64Array(vec![5e-7]));
        surface.set_attr("Interferometric Scale Factor", AttrValue::F64Array(vec![0.5]));
        surface.set_attr("Obliquity Factor", AttrValue::F64Array(vec![2.0]));
    });
    assert_map(fringes, AS_IT_IS, 5e-7, SQUARE);
    let short = datx(Some(2.0), |surface| {
        let heights: Vec<f32> = heights(1.0).iter().map(|&z| z as f32).collect();
        surface.with_f32_data(&heights).set_attr("No Data", AttrValue::F32Array(vec![NO_DATA as f32]));
        in_nm(surface);
    });
    assert_map(short, AS_IT_IS, 1e-9, SQUARE);
    let packed = datx(Some(2.0), |surface| {
        in_nm(surface);
        surface.with_chunks(&[3, 2]).with_shuffle().with_deflate(6);
    });
    assert_map(packed, AS_IT_IS, 1e-9, SQUARE);
    let integers = datx(Some(2.0), |surface| {
        let heights: Vec<i32> = heights(4.0).iter().map(|&z| z.min(1e6) as i32).collect();
        surface.with_i32_data(&heights).set_attr("No Data", AttrValue::I32Array(vec![1_000_000]));
        in_nm(surface);
    });
    assert_map(integers, AS_IT_IS, 4e-9, SQUARE);
}

#[test]
fn a_camera_that_is_not_calibrated() {
    let pixel = ReadOptions { pixel: Some(PIXEL), unit: None };
    assert_map(datx(Some(0.0), in_nm), pixel, 1e-9, PIXEL);
    // Without a unit both are given.
    assert_map(datx(Some(0.0), |_| ()), IN_NM, 1e-9, PIXEL);
}

#[test]
fn the_pixel_of_another_group_where_its_own_has_none() {
    assert_map(datx(None, in_nm), AS_IT_IS, 1e-9, [7e-6; 2]);
}

#[test]
fn files_that_are_refused() {
    let surface = |write: fn(&mut hdf5_pure::DatasetBuilder)| datx(Some(2.0), write);
    type Change = fn(&mut hdf5_pure::DatasetBuilder);
    let changes: [(&str, Change); 4] = [
        ("waves", |surface| _ = surface.set_attr("Unit", unit("Waves"))),
        ("one dimension", |surface| _ = surface.with_f64_data(&[1.0, 2.0]).with_shape(&[2])),
        ("64 bits", |surface| _ = surface.with_i64_data(&[1, 2]).with_shape(&[2, 1])),
        ("fringes", |surface| _ = surface.set_attr("Unit", unit("Fringes"))),
    ];
    for (name, change) in &changes[..3] {
        assert_refused!(Unsupported, surface(*change), name);
    }
    assert_refused!(Corrupt, surface(changes[3].1));
    // A thousand times smaller than its numbers, and chunks that are larger than the map.
    let small: Change = |surface| {
        surface.with_f64_data(&vec![0.0; 1_000_000]).with_shape(&[1, 1_000_000]);
        surface.with_chunks(&[1, 1_000_000]).with_deflate(9);
    };
    let chunked: Change = |surface| {
        surface.with_chunks(&[1, 1_000_000]).with_maxshape(&[MaxExtent::Fixed(4), MaxExtent::Unlimited]);
        surface.with_deflate(9);
    };
    assert_refused!(Corrupt, surface(small));
    assert_refused!(Corrupt, surface(chunked));
    assert_refused!(Unsupported, FileBuilder::new().finish().unwrap());
    assert_refused!(Corrupt, b"\x89HDF\r\n\x1a\n\x09");
    let mut many = FileBuilder::new();
    let mut data = many.create_group("Data");
    let mut surfaces = data.create_group("Surface");
    for k in 0..257 {
        surfaces.create_dataset(&format!("{k}")).with_f64_data(&[0.0]).with_shape(&[1, 1]);
    }
    data.add_group(surfaces.finish());
    many.add_group(data.finish());
    assert_refused!(Corrupt, many.finish().unwrap());
}

#[test]
fn damage_is_no_panic() {
    let bytes = datx(Some(2.0), |surface| {
        in_nm(surface);
        surface.with_chunks(&[3, 2]).with_shuffle().with_deflate(6);
    });
    cut(&bytes, (0..bytes.len()).step_by(13));
    damage(&bytes);
    damage(&std::fs::read(sample("samples/zygo_test.datx")).unwrap());
}
