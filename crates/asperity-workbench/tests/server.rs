//! The server with a program that does what a test asks of it: it goes on where an analysis fails, and keeps its limits.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::sync::Arc;

use asperity_contact_framework::progress::Progress;
use asperity_workbench::engine::Heights;
use asperity_workbench::{Engine, Example, Options, Prepared, Refused, Server, SpecText, Stage};
use serde_json::{Value, json};

/// What the title of a spec asks for.
struct Asked(String);

impl Prepared for Asked {
    fn memory(&self) -> u128 {
        if self.0 == "huge" { u128::MAX } else { 1 }
    }

    fn inputs(&self) -> Value {
        json!([])
    }

    fn stages(&self) -> &'static [Stage] {
        &[Stage::Models, Stage::Intervals, Stage::Everything]
    }

    fn run(&self, stage: Stage, _: &dyn Progress) -> Result<Value, Refused> {
        match self.0.as_str() {
            "panics" => panic!("as asked"),
            "refuses" => {
                Err(Refused { key: Some("a.b".to_owned()), message: "found c; allowed: d".to_owned() })
            }
            _ => Ok(json!({ "stage": stage })),
        }
    }
}

struct Program;

impl Engine for Program {
    fn vocabulary(&self) -> Value {
        json!({})
    }

    fn is_surface(&self, path: &Path) -> bool {
        path.extension().is_some_and(|ending| ending == "npy")
    }

    fn kind(&self, _: &str) -> Option<(String, String)> {
        None
    }

    fn begin(&self, _: &Path, _: &str) -> Result<(String, Vec<String>), Refused> {
        Err(Refused::new("none"))
    }

    fn picture(&self, _: &Path, _: usize) -> Result<Heights, Refused> {
        Err(Refused::new("none"))
    }

    fn prepare(&self, spec: &SpecText) -> Result<Box<dyn Prepared>, Refused> {
        let title = spec.text.trim().trim_start_matches("title = ").trim_matches('"').to_owned();
        Ok(Box::new(Asked(title)))
    }

    fn surface(&self, _: &SpecText, _: &str, _: &dyn Progress) -> Result<Value, Refused> {
        Ok(json!({}))
    }

    fn heights(&self, _: &SpecText, _: &str, _: usize, _: &dyn Progress) -> Result<Heights, Refused> {
        Ok(Heights { points: [1, 2], pixel: [1e-6, 2e-6], every: 1, heights: vec![0.5, f32::NAN] })
    }

    fn report(&self, _: &Path, _: &Path, _: &Path, _: &dyn Progress) -> Result<String, Refused> {
        Err(Refused::new("none"))
    }

    fn forget(&self) {}

    fn example(&self) -> Example {
        Example { files: &[] }
    }
}

struct Served {
    address: String,
    token: String,
    _folder: tempfile::TempDir,
}

/// A server of an empty folder, until the tests end.
fn served() -> Served {
    let folder = tempfile::tempdir().unwrap();
    let token = Some(folder.path().join("config/token"));
    let options = Options { folder: folder.path().to_owned(), port: Some(0), token };
    let server = Server::new(&options, Arc::new(Program)).unwrap();
    let (address, token) = server.address().trim_start_matches("http://").split_once("/?token=").unwrap();
    let (address, token) = (address.to_owned(), token.to_owned());
    std::thread::spawn(move || server.run());
    Served { address, token, _folder: folder }
}

impl Served {
    /// A connection on which a spec with this title was sent.
    fn sent(&self, path: &str, title: &str, more: &str) -> TcpStream {
        let Self { address, token, .. } = self;
        let body = format!("{{\"spec\":{{\"title\":\"{title}\"}}{more}}}");
        let mut stream = TcpStream::connect(address).unwrap();
        write!(
            stream,
            "POST {path} HTTP/1.1\r\nHost: {address}\r\nOrigin: http://{address}\r\nCookie: asperity-workbench={token}\r\n\
             Content-Type: application/json\r\nContent-Length: {}\r\nConnection: close\r\n\r\n{body}",
            body.len()
        )
        .unwrap();
        stream
    }

    /// The whole answer.
    fn answer(&self, path: &str, title: &str, more: &str) -> String {
        let mut text = Vec::new();
        self.sent(path, title, more).read_to_end(&mut text).unwrap();
        String::from_utf8_lossy(&text).into_owned()
    }
}

#[test]
fn stages_are_told_in_their_order_and_no_more_than_is_wanted() {
    let served = served();
    let all = served.answer("/api/analyse", "all", "");
    let places: Vec<usize> = ["\"models\"", "\"intervals\"", "\"everything\"", "event: done"]
        .map(|text| all.find(text).unwrap())
        .to_vec();
    assert!(places.is_sorted(), "{all}");
    let short = served.answer("/api/analyse", "all", ",\"last\":\"models\"");
    assert!(
        short.contains("\"models\"") && !short.contains("\"intervals\"") && short.contains("event: done"),
        "{short}"
    );
}

/// Of the page that asked, while the server goes on.
#[test]
fn failures_are_errors_of_an_analysis() {
    let served = served();
    for (title, words) in [
        ("panics", "internal error, please report it with the spec: as asked"),
        ("refuses", "{\"key\":\"a.b\",\"message\":\"found c; allowed: d\"}"),
        ("huge", "GB of memory; the workbench uses at most"),
    ] {
        let failed = served.answer("/api/analyse", title, "");
        assert!(failed.contains("event: error") && failed.contains(words), "{failed}");
    }
    assert!(served.answer("/api/analyse", "all", "").contains("event: done"));
}

#[test]
fn heights_are_numbers_with_their_head() {
    let served = served();
    let mut answer = Vec::new();
    served.sent("/api/heights", "all", ",\"surface\":\"a\",\"most\":9").read_to_end(&mut answer).unwrap();
    let body = &answer[answer.windows(4).position(|part| part == b"\r\n\r\n").unwrap() + 4..];
    let mut expected = Vec::new();
    [1_u32, 2, 1, 0].iter().for_each(|count| expected.extend(count.to_le_bytes()));
    [1e-6_f64, 2e-6].iter().for_each(|size| expected.extend(size.to_le_bytes()));
    expected.extend(0.5_f32.to_le_bytes());
    assert_eq!((&body[..36], body.len()), (&expected[..], 40));
}
