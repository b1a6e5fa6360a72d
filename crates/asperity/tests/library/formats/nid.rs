//! Nanosurf files.

use super::instrument::{Number, assert_heights, filled, read, stored, upwards};
use super::refused::Good;
use super::{NX, NY, PIXEL, channels};
use asperity::topography::read::ReadOptions;

/// A section of the text and the numbers of a channel.
pub(super) struct Set {
    pub(super) frame: &'static str,
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    lines: usize,
    /// Units of the sizes along x and y.
    lateral: [&'static str; 2],
    /// How numbers are stored.
    storage: String,
    numbers: Vec<u8>,
}

impl Set {
    /// Heights in quarters over the range of a type, `higher` than those of the map.
    fn of<T: Number>(is_signed: bool, big_endian: bool, higher: f64) -> Self {
        let bits = 8 * size_of::<T>() as u32;
        let steps = 2f64.powi(bits as i32);
        // The least number of an unsigned type stands for the least height.
        let (least, raised) = if is_signed { (-0.125 * steps, 0.0) } else { (-13.5, 13.5) };
        let heights = upwards().map(|[ix, iy]| 4.0 * (filled(ix, iy) + raised));
        let sign = if is_signed { "Signed" } else { "Unsigned" };
        let order = if big_endian { "Motorola" } else { "Intel" };
        Self {
            frame: "Scan forward",
            name: "Z-Axis",
            unit: "nm",
            lines: NY,
            lateral: ["m", "\u{b5}m"],
            storage: format!(
                "SaveBits={bits}\r\nSaveSign={sign}\r\nSaveOrder={order}\r\nDim2Range={}\r\nDim2Min={}\r\n",
                0.25 * steps,
                least + higher
            ),
            numbers: stored::<T>(heights, big_endian),
        }
    }

    /// A channel of this name, `higher` than the map.
    pub(super) fn named(frame: &'static str, name: &'static str, unit: &'static str, higher: f64) -> Self {
        Self { frame, name, unit, ..Self::of::<i16>(true, false, higher) }
    }

    fn section(&self) -> String {
        let [x, y] = [PIXEL[0] * NX as f64, PIXEL[1] * 1e6 * NY as f64];
        format!(
            "Version=2\r\nPoints={NX}\r\nLines={}\r\nFrame={}\r\nDim0Unit={}\r\nDim0Range={x:e}\r\nDim1Unit={}\r\n\
             Dim1Range={y}\r\nDim2Name={}\r\nDim2Unit={}\r\n{}SaveMode=Binary\r\n",
            self.lines, self.frame, self.lateral[0], self.lateral[1], self.name, self.unit, self.storage
        )
    }
}

/// A file of two groups with these channels each; the second of the eight channels of a group was not saved.
pub(super) fn nid(groups: &[Vec<Set>]) -> Vec<u8> {
    let mut text = format!("[DataSet]\r\nVersion=2\r\nGroupCount={}\r\n", groups.len());
    let (mut sections, mut numbers) = (String::new(), Vec::new());
    for (group, sets) in groups.iter().enumerate() {
        text += &format!("Gr{group}-Count=8\r\n");
        for (k, set) in sets.iter().enumerate() {
            let channel = if k == 0 { 0 } else { k + 1 };
            text += &format!("Gr{group}-Ch{channel}=DataSet-{group}:{channel}\r\n");
            sections += &format!("\r\n[DataSet-{group}:{channel}]\r\n{}", set.section());
            numbers.extend(&set.numbers);
        }
    }
    [(text + &sections).as_bytes(), b"\r\n#!", &numbers].concat()
}

fn one(set: Set) -> Vec<u8> {
    nid(&[vec![set]])
}

fn forward() -> Set {
    Set::named("Scan forward", "Z-Axis", "nm", 0.0)
}

pub fn good() -> Vec<Good> {
    let whole = one(forward());
    vec![Good { truncated: 9..whole.len(), ..Good::whole("nid", whole) }]
}

#[test]
fn nid_heights_of_every_type() {
    for big_endian in [false, true] {
        for set in [
            Set::of::<i8>(true, big_endian, 3.0),
            Set::of::<i16>(true, big_endian, 3.0),
            Set::of::<i32>(true, big_endian, 3.0),
            Set::of::<u8>(false, big_endian, 3.0),
            Set::of::<u16>(false, big_endian, 3.0),
            Set::of::<u32>(false, big_endian, 3.0),
        ] {
            // A number of zero is the middle of the range, here the height of zero; unsigned, the least height.
            let head = assert_heights(one(set), None, PIXEL, |ix, iy| 1e-9 * (filled(ix, iy) + 3.0));
            assert_eq!(
                (head.has_unit, head.channel.unwrap().name),
                (true, "Scan forward (Z-Axis)".to_owned())
            );
        }
    }
    // Some programs write Latin-1.
    let latin: Vec<u8> = one(forward()).into_iter().filter(|&byte| byte != 0xc2).collect();
    assert_heights(latin, None, PIXEL, |ix, iy| 1e-9 * filled(ix, iy));
}

#[test]
fn nid_channels_that_are_images() {
    let spectrum = Set { lines: 1, numbers: vec![0; 2 * NX], ..forward() };
    let in_time = |lateral| Set { lateral, ..forward() };
    let groups = [
        vec![Set::named("Scan forward", "Phase", "\u{b0}", 1.0), spectrum, forward()],
        vec![Set::named("Scan backward", "Z-Axis", "nm", 2.0), in_time(["m", "s"])],
    ];
    let bytes = nid(&groups);
    let names = ["Scan forward (Z-Axis)", "\"Scan forward (Phase)\" (\u{b0})", "\"Scan backward (Z-Axis)\""];
    assert_eq!(channels(&bytes), names);
    assert_heights(&bytes, None, PIXEL, |ix, iy| 1e-9 * filled(ix, iy));
    assert_heights(&bytes, Some("Scan backward (Z-Axis)"), PIXEL, |ix, iy| 1e-9 * (filled(ix, iy) + 2.0));
    let given = ReadOptions { pixel: Some(PIXEL), unit: None };
    let (head, map) = read(one(in_time(["s", "\u{b5}m"])), None, given);
    assert_eq!((head.pixel, map.pixel()), (None, PIXEL));
}
