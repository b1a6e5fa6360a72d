//! The page: its files, in the program.

use std::sync::LazyLock;

use asperity_contact_framework::report::page::{chart_scripts, page_style};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};

const PAGE: &str = include_str!("../assets/index.html");

/// The files that the page loads. `preact.js` is the standalone module of htm 3.1.1 with its Preact (licences beside it).
const ASSETS: [(&str, &str); 10] = [
    ("app.js", include_str!("../assets/app.js")),
    ("state.js", include_str!("../assets/state.js")),
    ("server.js", include_str!("../assets/server.js")),
    ("quantity.js", include_str!("../assets/quantity.js")),
    ("kept.js", include_str!("../assets/kept.js")),
    ("controls.js", include_str!("../assets/controls.js")),
    ("results.js", include_str!("../assets/results.js")),
    ("surface.js", include_str!("../assets/surface.js")),
    ("start.js", include_str!("../assets/start.js")),
    ("preact.js", include_str!("../assets/vendor/preact.js")),
];

/// Styles of reports, then those of the page.
static STYLE: LazyLock<String> =
    LazyLock::new(|| format!("{}\n{}", page_style(), include_str!("../assets/workbench.css")));

/// The library for charts, and what makes charts of the figures of reports.
static CHARTS: LazyLock<String> = LazyLock::new(|| chart_scripts().concat());

pub fn page() -> Response {
    ([(header::CONTENT_TYPE, "text/html; charset=utf-8")], PAGE).into_response()
}

pub fn asset(name: &str) -> Response {
    let script = "text/javascript; charset=utf-8";
    let (content, media) = match name {
        "style.css" => (STYLE.as_str(), "text/css; charset=utf-8"),
        "charts.js" => (CHARTS.as_str(), script),
        _ => match ASSETS.iter().find(|(one, _)| *one == name) {
            Some((_, content)) => (*content, script),
            None => return (StatusCode::NOT_FOUND, "found nothing here").into_response(),
        },
    };
    ([(header::CONTENT_TYPE, media)], content).into_response()
}
