//! Zygo DATX files: units of heights, pixels, number types.

use super::refused::Good;
use super::{AS_IT_IS, IN_NM, NX, NY, PIXEL, assert_map, channels, in_lines};
use asperity::topography::read::ReadOptions;
use hdf5_pure::{AttrValue, DatasetBuilder, FileBuilder, MaxExtent};

/// What marks a missing point.
const NO_DATA: f64 = 1e38;

/// The bytes of a file whose surface is made by `write`, with the lateral resolution of `pixel` in micrometres.
fn datx(pixel: Option<f64>, write: impl FnOnce(&mut DatasetBuilder)) -> Vec<u8> {
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

fn in_nm(surface: &mut DatasetBuilder) {
    surface.set_attr("Unit", unit("NanoMeters"));
}

const SQUARE: [f64; 2] = [2e-6; 2];

pub fn good() -> Vec<Good> {
    type Change = fn(&mut DatasetBuilder);
    let changes: [(&str, Change); 6] = [
        ("datx in waves", |surface| _ = surface.set_attr("Unit", unit("Waves"))),
        ("datx in fringes", |surface| _ = surface.set_attr("Unit", unit("Fringes"))),
        ("datx of one dimension", |surface| _ = surface.with_f64_data(&[1.0, 2.0]).with_shape(&[2])),
        ("datx of 64 bits", |surface| _ = surface.with_i64_data(&[1, 2]).with_shape(&[2, 1])),
        ("datx a thousand times smaller than its numbers", |surface| {
            surface.with_f64_data(&vec![0.0; 1_000_000]).with_shape(&[1, 1_000_000]);
            surface.with_chunks(&[1, 1_000_000]).with_deflate(9);
        }),
        ("datx of chunks larger than the map", |surface| {
            surface.with_chunks(&[1, 1_000_000]).with_maxshape(&[MaxExtent::Fixed(4), MaxExtent::Unlimited]);
            surface.with_deflate(9);
        }),
    ];
    let mut many = FileBuilder::new();
    let mut data = many.create_group("Data");
    let mut surfaces = data.create_group("Surface");
    for k in 0..257 {
        surfaces.create_dataset(&format!("{k}")).with_f64_data(&[0.0]).with_shape(&[1, 1]);
    }
    data.add_group(surfaces.finish());
    many.add_group(data.finish());
    let others = [("datx of many surfaces", many), ("datx without a group", FileBuilder::new())];
    let others = others.map(|(name, file)| Good::whole(name, file.finish().unwrap()));
    changes
        .map(|(name, change)| Good::whole(name, datx(Some(2.0), change)))
        .into_iter()
        .chain(others)
        .collect()
}

#[test]
fn units_and_number_types() {
    assert_map(datx(Some(2.0), in_nm), AS_IT_IS, 1e-9, SQUARE);
    assert_eq!(channels(datx(Some(2.0), in_nm)), ["Surface", "\"Intensity\" (grey)"]);
    for (name, factor, unit_of_map) in [
        ("meters", 1e-9, 1e-9),
        ("Millimeters", 1.0, 1e-3),
        ("MicroMeters", 1.0, 1e-6),
        ("Angstroms", 1.0, 1e-10),
        ("um", 1.0, 1e-6),
    ] {
        let bytes = datx(Some(2.0), |surface| {
            surface.with_f64_data(&heights(factor)).set_attr("Unit", unit(name));
        });
        assert_map(bytes, AS_IT_IS, unit_of_map, SQUARE);
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
fn pixels_of_cameras() {
    // Not calibrated.
    let pixel = ReadOptions { pixel: Some(PIXEL), unit: None };
    assert_map(datx(Some(0.0), in_nm), pixel, 1e-9, PIXEL);
    // Without a unit both are given.
    assert_map(datx(Some(0.0), |_| ()), IN_NM, 1e-9, PIXEL);
    // That of another group where its own has none.
    assert_map(datx(None, in_nm), AS_IT_IS, 1e-9, [7e-6; 2]);
}
