//! Nanosurf files.

use super::damage::assert_no_panic;
use super::instrument::{Number, assert_heights, filled, read, stored, upwards};
use super::{NX, NY, PIXEL, assert_truncated};
use asperity::topography::read::ReadOptions;

/// A section of the text and the numbers of a channel.
pub(super) struct Set {
    pub(super) frame: &'static str,
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    size: [u64; 2],
    /// Entries that the section has besides, or instead.
    entries: Vec<(&'static str, String)>,
    numbers: Vec<u8>,
}

impl Set {
    /// Heights in quarters over the range of a type, `higher` than those of the map.
    fn of<T: Number>(is_signed: bool, big_endian: bool, higher: f64) -> Self {
        let bits = 8 * size_of::<T>() as u32;
        let steps = 2f64.powi(bits as i32);
        // The least number of an unsigned type stands for the least height.
        let least = if is_signed { -0.125 * steps } else { -13.5 };
        let raised = if is_signed { 0.0 } else { 13.5 };
        let heights = upwards().map(|[ix, iy]| 4.0 * (filled(ix, iy) + raised));
        let sign = if is_signed { "Signed" } else { "Unsigned" };
        Self {
            frame: "Scan forward",
            name: "Z-Axis",
            unit: "nm",
            size: [NX as u64, NY as u64],
            entries: vec![
                ("SaveBits", bits.to_string()),
                ("SaveSign", sign.to_owned()),
                ("SaveOrder", if big_endian { "Motorola" } else { "Intel" }.to_owned()),
                ("Dim2Range", (0.25 * steps).to_string()),
                ("Dim2Min", (least + higher).to_string()),
            ],
            numbers: stored::<T>(heights, big_endian),
        }
    }

    /// A channel of this name, `higher` than the map.
    pub(super) fn named(frame: &'static str, name: &'static str, unit: &'static str, higher: f64) -> Self {
        Self { frame, name, unit, ..Self::of::<i16>(true, false, higher) }
    }

    fn with(mut self, key: &'static str, value: &str) -> Self {
        self.entries.retain(|entry| entry.0 != key);
        self.entries.push((key, value.to_owned()));
        self
    }

    fn section(&self) -> String {
        let [nx, ny] = self.size;
        let mut text = format!(
            "Version=2\r\nPoints={nx}\r\nLines={ny}\r\nFrame={}\r\nDim0Unit=m\r\nDim0Range={:e}\r\nDim1Unit=\u{b5}m\r\n\
             Dim1Range={}\r\nDim2Name={}\r\nDim2Unit={}\r\n",
            self.frame,
            PIXEL[0] * NX as f64,
            PIXEL[1] * 1e6 * NY as f64,
            self.name,
            self.unit
        );
        for (key, value) in &self.entries {
            text = text
                .lines()
                .filter(|line| !line.starts_with(&format!("{key}=")))
                .fold(String::new(), |all, line| all + line + "\r\n");
            text += &format!("{key}={value}\r\n");
        }
        if self.entries.iter().all(|entry| entry.0 != "SaveMode") {
            text + "SaveMode=Binary\r\n"
        } else {
            text
        }
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

fn good() -> Set {
    Set::named("Scan forward", "Z-Axis", "nm", 0.0)
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
    let latin: Vec<u8> = one(good()).into_iter().filter(|&byte| byte != 0xc2).collect();
    assert_heights(latin, None, PIXEL, |ix, iy| 1e-9 * filled(ix, iy));
}

#[test]
fn nid_channels_that_are_images() {
    let spectrum = || Set { size: [NX as u64, 1], numbers: vec![0; 2 * NX], ..good() };
    let groups = [
        vec![Set::named("Scan forward", "Phase", "\u{b0}", 1.0), spectrum(), good()],
        vec![Set::named("Scan backward", "Z-Axis", "nm", 2.0), good().with("Dim1Unit", "s")],
    ];
    let bytes = nid(&groups);
    let (head, _) = read(&bytes, None, ReadOptions::default());
    let channel = head.channel.unwrap();
    assert_eq!(channel.name, "Scan forward (Z-Axis)");
    assert_eq!(super::others(&channel), ["\"Scan forward (Phase)\" (\u{b0})", "\"Scan backward (Z-Axis)\""]);
    assert_heights(&bytes, None, PIXEL, |ix, iy| 1e-9 * filled(ix, iy));
    assert_heights(&bytes, Some("Scan backward (Z-Axis)"), PIXEL, |ix, iy| 1e-9 * (filled(ix, iy) + 2.0));
    assert_no_panic(&bytes);
    assert_refused!(Unsupported, one(spectrum()));
    let (head, map) =
        read(one(good().with("Dim0Unit", "s")), None, ReadOptions { pixel: Some(PIXEL), unit: None });
    assert_eq!((head.pixel, map.pixel()), (None, PIXEL));
}

#[test]
fn bad_nid_is_refused() {
    for key in ["Points", "Lines", "Dim0Range", "Dim1Range", "Dim2Range", "Dim2Min"] {
        assert_refused!(Corrupt, one(good().with(key, "many")), key);
    }
    let text = String::from_utf8_lossy(&one(good())).into_owned();
    for key in
        ["Points", "Lines", "Dim0Range", "Dim2Range", "Dim2Unit", "Dim2Name", "Frame", "SaveBits", "SaveSign"]
    {
        assert_refused!(Corrupt, text.replace(&format!("\n{key}="), "\nNone="), key);
    }
    assert_refused!(Corrupt, text.replace("GroupCount", "Groups"));
    assert_refused!(Corrupt, text.replace("GroupCount=1", "GroupCount=256"));
    assert_refused!(Unsupported, text.replace("GroupCount=1", "GroupCount=0"));
    assert_refused!(Corrupt, text.replace("#!", "##"));
    assert_refused!(Unsupported, one(good().with("SaveBits", "64")));
    assert_refused!(Unsupported, one(good().with("SaveMode", "Text")));
    let huge = u64::MAX.to_string();
    assert_refused!(Corrupt, one(good().with("Points", &huge)));
    assert_refused!(Corrupt, one(good().with("Points", "1000000")));
    assert_refused!(Corrupt, one(good().with("Points", "0")));
    assert_refused!(Corrupt, one(good().with("Dim0Range", "0")));
    assert_refused!(Corrupt, one(good().with("Dim2Range", "inf")));
    assert_refused!(Corrupt, one(good().with("Dim2Min", "nan")));
    let whole = one(good());
    assert_truncated(&whole, 9..whole.len());
}
