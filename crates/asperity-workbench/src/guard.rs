//! Who may ask: a request must be for this host, of no other origin, and have the token as its cookie.
//!
//! A page of another site can send requests to this machine, also under a name of its own that it lets point here (DNS rebinding). The
//! host of such a request is that name, and its origin that site; and it has no cookie, which is `SameSite=Strict`.

use std::io::Write;
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::{fs, io};

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{Html, IntoResponse, Response};
use etcetera::base_strategy::{BaseStrategy, choose_native_strategy};

const COOKIE: &str = "asperity-workbench";

/// A year, s: as long as a bookmark is used.
const COOKIE_AGE: u32 = 365 * 24 * 3600;

/// What the page may load: its own scripts and styles. Styles in attributes are those of pictures that the program draws.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; \
     connect-src 'self'; font-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// What a request is checked against.
#[derive(Debug)]
pub struct Guard {
    /// Hosts with the port, as browsers send them.
    hosts: Vec<String>,
    token: String,
    /// The first part of the addresses of reports, which need no cookie: they are shown without the rights of the page.
    reports: String,
}

impl Guard {
    /// For a server at these addresses.
    pub fn new(addresses: &[SocketAddr], token: String, reports: String) -> Self {
        let mut hosts: Vec<String> = addresses.iter().map(SocketAddr::to_string).collect();
        let ports = addresses.iter().map(|address| format!("localhost:{}", address.port()));
        hosts.extend(ports);
        hosts.dedup();
        Self { hosts, token, reports }
    }

    /// The first part of the addresses of reports.
    pub fn reports(&self) -> &str {
        &self.reports
    }

    fn is_own_host(&self, headers: &HeaderMap) -> bool {
        let mut hosts = headers.get_all(header::HOST).iter();
        let host = hosts.next().and_then(|host| host.to_str().ok());
        hosts.next().is_none()
            && host.is_some_and(|host| self.hosts.iter().any(|own| own.eq_ignore_ascii_case(host)))
    }

    /// Whether the request is of this page: what changes something says so, and what does not at least not the contrary.
    fn is_own_origin(&self, method: &Method, headers: &HeaderMap) -> bool {
        if headers.get("sec-fetch-site").is_some_and(|site| site != "same-origin" && site != "none") {
            return false;
        }
        match headers.get(header::ORIGIN).map(HeaderValue::to_str) {
            None => method == Method::GET || method == Method::HEAD,
            Some(Ok(origin)) => {
                origin.strip_prefix("http://").is_some_and(|host| self.hosts.iter().any(|own| own == host))
            }
            Some(Err(_)) => false,
        }
    }

    fn has_cookie(&self, headers: &HeaderMap) -> bool {
        let cookies = headers.get_all(header::COOKIE).iter().filter_map(|cookies| cookies.to_str().ok());
        let mut each =
            cookies.flat_map(|cookies| cookies.split(';')).filter_map(|one| one.trim().split_once('='));
        each.any(|(name, value)| name == COOKIE && is_same(value, &self.token))
    }

    /// A page that leads on, with the cookie, for whoever has the token in the first address. Where that was opened from another site, as from a file,
    /// a browser sends the cookie only to what this page leads to, not to what it is redirected to.
    fn admitted(&self, query: &str) -> Option<Response> {
        let given = query.split('&').find_map(|pair| pair.strip_prefix("token="))?;
        if !is_same(given, &self.token) {
            return None;
        }
        let cookie = format!("{COOKIE}={given}; HttpOnly; SameSite=Strict; Path=/; Max-Age={COOKIE_AGE}");
        let page = "<!DOCTYPE html><html lang=\"en\"><title>Asperity workbench</title><link rel=\"icon\" href=\"data:,\"><meta http-equiv=\"refresh\" content=\"0;url=/\">";
        Some(([(header::SET_COOKIE, cookie)], Html(page)).into_response())
    }
}

/// Lets a request pass, or answers it.
pub async fn check(State(guard): State<Arc<Guard>>, request: Request, next: Next) -> Response {
    let (headers, method, uri) = (request.headers(), request.method(), request.uri());
    let refuse = |status: StatusCode, text: &'static str| (status, Html(text)).into_response();
    let is_report = uri.path().strip_prefix('/').and_then(|path| path.split_once('/'));
    let is_report = is_report.is_some_and(|(first, _)| is_same(first, &guard.reports));
    let response = if !guard.is_own_host(headers) {
        refuse(StatusCode::MISDIRECTED_REQUEST, "Not found: this host name is not the workbench's.")
    } else if is_report && (method == Method::GET || method == Method::HEAD) {
        // A report is of no origin, which its own links say.
        next.run(request).await
    } else if !guard.is_own_origin(method, headers) && !is_first(method, uri.path()) {
        refuse(StatusCode::FORBIDDEN, "Refused: the request is of another page.")
    } else if let Some(admitted) =
        uri.query().filter(|_| is_first(method, uri.path())).and_then(|query| guard.admitted(query))
    {
        admitted
    } else if guard.has_cookie(headers) {
        next.run(request).await
    } else {
        refuse(
            StatusCode::UNAUTHORIZED,
            "<!DOCTYPE html><html lang=\"en\"><title>Asperity workbench</title><p>Open the address that <code>experiment serve</code> prints: it holds the key of this page.",
        )
    };
    with_headers(response, is_report)
}

/// Whether it is the address that the program prints, which is opened from anywhere.
fn is_first(method: &Method, path: &str) -> bool {
    method == Method::GET && path == "/"
}

fn with_headers(mut response: Response, is_report: bool) -> Response {
    let headers = response.headers_mut();
    if !is_report {
        headers.insert(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(POLICY));
        headers.insert(header::X_FRAME_OPTIONS, HeaderValue::from_static("DENY"));
        headers.insert("cross-origin-opener-policy", HeaderValue::from_static("same-origin"));
        // A report is of no origin, and its pictures neither.
        headers.insert("cross-origin-resource-policy", HeaderValue::from_static("same-origin"));
    }
    headers.insert(header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
    headers.insert(header::REFERRER_POLICY, HeaderValue::from_static("no-referrer"));
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    response
}

const DIGITS: usize = 64;

/// Where the token is kept: `asperity/workbench-token` in the configuration folder.
pub fn path() -> Option<PathBuf> {
    Some(choose_native_strategy().ok()?.config_dir().join("asperity").join("workbench-token"))
}

/// The token in the file at `path`, which is made where there is none or it holds something else; only its owner can read it.
pub fn kept(path: &Path) -> io::Result<String> {
    match fs::read_to_string(path) {
        // One that others could read is theirs, too.
        Ok(text) if is_token(text.trim_end()) && is_private(path)? => return Ok(text.trim_end().to_owned()),
        Ok(_) => {}
        Err(error) if matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::InvalidData) => {}
        Err(error) => return Err(error),
    }
    let token = random()?;
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    // It is private from its first byte on, and whole.
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    writeln!(file, "{token}")?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(token)
}

pub fn random() -> io::Result<String> {
    let mut bytes = [0; DIGITS / 2];
    getrandom::fill(&mut bytes).map_err(io::Error::other)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

fn is_token(text: &str) -> bool {
    text.len() == DIGITS && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// Whether two texts are the same, in a time that does not tell where they differ.
pub fn is_same(one: &str, other: &str) -> bool {
    let difference = one.bytes().zip(other.bytes()).fold(0, |sum, (a, b)| sum | (a ^ b));
    one.len() == other.len() && std::hint::black_box(difference) == 0
}

/// Whether its owner alone may read a file.
#[cfg(unix)]
fn is_private(path: &Path) -> io::Result<bool> {
    use std::os::unix::fs::PermissionsExt;
    Ok(fs::metadata(path)?.permissions().mode() & 0o077 == 0)
}

#[cfg(not(unix))]
fn is_private(_: &Path) -> io::Result<bool> {
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_token_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/token");
        let first = kept(&path).unwrap();
        fs::write(&path, "short").unwrap();
        let second = kept(&path).unwrap();
        assert!(is_token(&first) && is_token(&second) && first != second);
    }
}
