//! Specs that are refused: `bad.txt` holds each of them with the message that it gets.

/// Tables that many of them have, by the line that stands for them.
const SHARED: [(&str, &str); 5] = [
    ("@steel\n", "[material.steel]\nyoung = \"210 GPa\"\npoisson = 0.3\nhardness = \"7.6 GPa\"\n"),
    ("@lead\n", "[material.lead]\nyoung = \"18 GPa\"\npoisson = 0.35\nhardness = \"0.17 GPa\"\n"),
    ("@compare\n", "[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"zmc\"\n"),
    (
        "@population\n",
        "[surface.a.population]\nradius = \"20 um\"\nsigma = \"48 nm\"\ndensity = \"6e10 /m^2\"\ncount = 1000\n",
    ),
    (
        "@generate\n",
        "[surface.a.generate]\npoints = 64\npixel = \"1 um\"\nsigma = \"100 nm\"\n\
         spectrum.self-affine = { hurst = 0.8, roll-off = \"40 um\", cut-off = \"8 um\" }\n",
    ),
];

pub struct BadSpec<'a> {
    /// Name of its file, without the ending.
    pub name: &'a str,
    /// As it is written in `bad.txt`.
    pub written: &'a str,
    /// Its message, each line after `> `.
    #[allow(dead_code, reason = "of the test programs only one reads it")]
    pub message: &'a str,
}

impl<'a> BadSpec<'a> {
    /// Those that `bad.txt` holds.
    pub fn all(text: &'a str) -> impl Iterator<Item = Self> {
        text.split("=== ").skip(1).map(|case| {
            let (name, rest) = case.split_once('\n').expect("a name in a line");
            let (written, message) = rest.split_at(rest.find("> ").expect("a message"));
            Self { name, written, message: message.trim_end() }
        })
    }

    /// The spec.
    pub fn spec(&self) -> String {
        SHARED.iter().fold(self.written.to_owned(), |spec, (line, table)| spec.replace(line, table))
    }
}
