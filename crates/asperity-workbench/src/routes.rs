//! What can be asked of the server.
//!
//! | request | answer |
//! |---|---|
//! | `GET /`, `/assets/NAME` | the page |
//! | `GET /api/vocabulary` | keys with their explanations, materials, laws, terms |
//! | `GET /api/files` | maps, specs and reports of the folder |
//! | `POST /api/upload/NAME` | keeps a dropped file |
//! | `POST /api/begin`, `/api/picture` | the first spec of a measured file; a small picture of it |
//! | `POST /api/example` | puts the example into the folder |
//! | `POST /api/open`, `/api/save`, `/api/text`, `/api/parse` | a spec on disk; the text of a spec, and back |
//! | `POST /api/surface`, `/api/analyse`, `/api/report` | events: one surface, the contact, a report |
//! | `POST /api/heights` | the heights of a map as numbers |
//! | `POST /api/close`, `/api/inputs` | forgets surfaces; the state of the files of a spec |
//! | `GET /KEY/PATH` | a file of a report, which has no rights |

use std::path::PathBuf;
use std::sync::{Arc, LazyLock};

use asperity_contact_framework::report::page::{chart_scripts, page_style};
use axum::body::Bytes;
use axum::extract::{DefaultBodyLimit, Path, Request, State};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Json, Router, middleware};
use futures_util::StreamExt;
use rayon::ThreadPool;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::analysis::{Budget, Watch, answer, value};
use crate::engine::{Engine, Heights, Refused, SpecText, Stage};
use crate::folder::{Folder, REPORTS, is_plain, too_large};
use crate::guard::Guard;
use crate::spec::{json_of, python_of, toml_of};
use crate::{guard, limits};

/// What all requests share. Nothing in it belongs to one page.
pub struct Shared {
    pub engine: Arc<dyn Engine>,
    pub folder: Folder,
    pub guard: Arc<Guard>,
    pub budget: Arc<Budget>,
    /// Where long work runs, so that what follows a slider does not wait for it.
    pub background: ThreadPool,
}

type App = Arc<Shared>;

pub fn router(app: App) -> Router {
    let guard = Arc::clone(&app.guard);
    Router::new()
        .route("/", get(|| async { page() }))
        .route("/assets/{name}", get(|Path(name): Path<String>| async move { asset(&name) }))
        .route("/api/vocabulary", get(vocabulary))
        .route("/api/files", get(files))
        .route("/api/upload/{name}", post(upload).layer(DefaultBodyLimit::disable()))
        .route("/api/begin", post(begin))
        .route("/api/picture", post(picture))
        .route("/api/example", post(example))
        .route("/api/open", post(open))
        .route("/api/save", post(save))
        .route("/api/text", post(text))
        .route("/api/parse", post(parse))
        .route("/api/surface", post(surface))
        .route("/api/heights", post(heights))
        .route("/api/analyse", post(analyse))
        .route("/api/report", post(report))
        .route("/api/close", post(close))
        .route("/api/inputs", post(inputs))
        .route("/{key}/{*path}", get(of_report))
        .layer(DefaultBodyLimit::max(limits::REQUEST))
        .layer(middleware::from_fn_with_state(guard, guard::check))
        .with_state(app)
}

impl IntoResponse for Refused {
    fn into_response(self) -> Response {
        (StatusCode::UNPROCESSABLE_ENTITY, Json(self)).into_response()
    }
}

/// The spec of a page, with the folder that its paths are relative to.
#[derive(Deserialize)]
struct PageSpec {
    spec: Value,
    #[serde(default)]
    folder: String,
}

impl PageSpec {
    fn text(&self, app: &Shared) -> Result<SpecText, Refused> {
        let folder = app.folder.folder(&self.folder)?;
        Ok(SpecText { root: app.folder.root().to_owned(), folder, text: toml_of(&self.spec)? })
    }
}

async fn vocabulary(State(app): State<App>) -> Json<Value> {
    let mut vocabulary = app.engine.vocabulary();
    vocabulary["terms"] = json!(asperity_contact_framework::report::meanings());
    vocabulary["reports"] = app.guard.reports().into();
    vocabulary["folder"] = app.folder.root().display().to_string().into();
    Json(vocabulary)
}

/// Work that touches the disk, apart from the threads that answer.
async fn on_disk<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, Refused> + Send + 'static,
) -> Result<T, Refused> {
    let done = tokio::task::spawn_blocking(work).await;
    done.unwrap_or_else(|error| Err(Refused::new(format!("internal error, please report it: {error}"))))
}

async fn files(State(app): State<App>) -> Result<Response, Refused> {
    on_disk(move || Ok(Json(app.folder.entries(&*app.engine)).into_response())).await
}

async fn upload(
    State(app): State<App>,
    Path(name): Path<String>,
    request: Request,
) -> Result<Json<Value>, Refused> {
    let length =
        request.headers().get(header::CONTENT_LENGTH).and_then(|length| length.to_str().ok()?.parse().ok());
    if let Some(length) = length.filter(|&length: &u64| length > limits::UPLOAD) {
        return Err(too_large(length));
    }
    let mut file = app.folder.upload(&name)?;
    let mut body = request.into_body().into_data_stream();
    while let Some(bytes) = body.next().await {
        // A page that goes away leaves no part of a file.
        let bytes: Bytes =
            bytes.map_err(|error| Refused::new(format!("{name}: the upload ended early: {error}")))?;
        file.add(&bytes)?;
    }
    let path = on_disk(move || {
        let name = file.name().to_owned();
        file.finish(|part| accepted(&*app.engine, part, &name))
    })
    .await?;
    Ok(Json(json!({ "path": path })))
}

/// Refuses a dropped file that the program does not read: it would only be in the way.
fn accepted(engine: &dyn Engine, file: &std::path::Path, name: &str) -> Result<(), Refused> {
    if !name.ends_with(".toml") {
        return engine.begin(file, name).map(drop);
    }
    let is_small = std::fs::metadata(file).is_ok_and(|metadata| metadata.len() <= limits::REQUEST as u64);
    let text = is_small.then(|| std::fs::read_to_string(file).ok()).flatten();
    match text.and_then(|text| engine.kind(&text)) {
        Some(_) => Ok(()),
        None => Err(Refused::new(format!(
            "{name}: found no experiment; allowed: a spec with a title and one kind, such as [compare]"
        ))),
    }
}

#[derive(Deserialize)]
struct OnePath {
    path: String,
}

async fn begin(
    State(app): State<App>,
    Json(OnePath { path }): Json<OnePath>,
) -> Result<Json<Value>, Refused> {
    on_disk(move || {
        let file = app.folder.file(&path)?;
        let (text, open) = app.engine.begin(&file, &path)?;
        Ok(Json(json!({ "spec": json_of(&text)?, "folder": "", "open": open })))
    })
    .await
}

async fn picture(State(app): State<App>, Json(OnePath { path }): Json<OnePath>) -> Result<Response, Refused> {
    on_disk(move || {
        let file = app.folder.file(&path)?;
        let is_small = std::fs::metadata(&file).is_ok_and(|metadata| metadata.len() <= limits::PICTURED);
        // What has no picture is no error of the list.
        let picture = is_small.then(|| app.engine.picture(&file, limits::PICTURE).ok()).flatten();
        Ok(picture.map_or_else(|| StatusCode::NO_CONTENT.into_response(), |heights| as_bytes(&heights)))
    })
    .await
}

fn as_bytes(heights: &Heights) -> Response {
    ([(header::CONTENT_TYPE, "application/octet-stream")], heights.bytes()).into_response()
}

async fn example(State(app): State<App>) -> Result<Json<Value>, Refused> {
    on_disk(move || {
        let files = app.engine.example().files.iter();
        let paths: Result<Vec<String>, Refused> =
            files.map(|(name, content)| app.folder.add(name, content)).collect();
        Ok(Json(json!({ "path": paths?.first() })))
    })
    .await
}

async fn open(State(app): State<App>, Json(OnePath { path }): Json<OnePath>) -> Result<Json<Value>, Refused> {
    on_disk(move || {
        let found = app.folder.spec(&path)?;
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        Ok(Json(json!({ "spec": json_of(&found.text)?, "folder": folder, "state": found.state })))
    })
    .await
}

#[derive(Deserialize)]
struct Saved {
    #[serde(flatten)]
    spec: PageSpec,
    /// Name of the spec without its ending.
    name: String,
    /// State of the file that may be replaced.
    state: Option<String>,
}

impl Saved {
    fn path(&self) -> String {
        let Self { spec: PageSpec { folder, .. }, name, .. } = self;
        if folder.is_empty() { format!("{name}.toml") } else { format!("{folder}/{name}.toml") }
    }

    fn save(&self, app: &Shared) -> Result<(PathBuf, String), Refused> {
        if !is_plain(&self.name) {
            let message = format!(
                "found the name \"{}\"; allowed: a name such as my-surface, without any of /\\:*?\"<>| and no point at its beginning",
                self.name
            );
            return Err(Refused::new(message));
        }
        let (path, text) = (self.path(), self.spec.text(app)?);
        app.engine.prepare(&text)?;
        let state = app.folder.save(&path, &text.text, self.state.as_deref())?;
        Ok((app.folder.existing(&path)?, state))
    }
}

async fn save(State(app): State<App>, Json(saved): Json<Saved>) -> Result<Json<Value>, Refused> {
    on_disk(move || {
        let (_, state) = saved.save(&app)?;
        Ok(Json(json!({ "path": saved.path(), "state": state })))
    })
    .await
}

async fn text(State(app): State<App>, Json(page): Json<PageSpec>) -> Result<Json<Value>, Refused> {
    let text = page.text(&app)?;
    let python = python_of(&page.spec, &text.folder.display().to_string());
    Ok(Json(json!({ "toml": text.text, "python": python })))
}

#[derive(Deserialize)]
struct OneText {
    text: String,
}

async fn parse(Json(OneText { text }): Json<OneText>) -> Result<Json<Value>, Refused> {
    Ok(Json(json!({ "spec": json_of(&text)? })))
}

#[derive(Deserialize)]
struct OneSurface {
    #[serde(flatten)]
    page: PageSpec,
    surface: String,
}

async fn surface(State(app): State<App>, Json(one): Json<OneSurface>) -> Result<Response, Refused> {
    let text = one.page.text(&app)?;
    let prepared = checked(&app, &text).await?;
    let budget = Arc::clone(&app.budget);
    Ok(answer(budget, prepared.memory(), move |watch| {
        let view = app.engine.surface(&text, &one.surface, watch)?;
        watch.tell("surface", &view);
        Ok(())
    }))
}

#[derive(Deserialize)]
struct SomeHeights {
    #[serde(flatten)]
    one: OneSurface,
    most: usize,
}

async fn heights(
    State(app): State<App>,
    Json(SomeHeights { one, most }): Json<SomeHeights>,
) -> Result<Response, Refused> {
    let text = one.page.text(&app)?;
    let prepared = checked(&app, &text).await?;
    let most = most.clamp(2, limits::POINTS);
    let budget = Arc::clone(&app.budget);
    let work = move |watch: &Watch| app.engine.heights(&text, &one.surface, most, watch);
    let heights = value(budget, prepared.memory(), work).await?;
    Ok(as_bytes(&heights))
}

async fn checked(app: &App, text: &SpecText) -> Result<Box<dyn crate::engine::Prepared>, Refused> {
    let (app, text) = (Arc::clone(app), text.clone());
    on_disk(move || app.engine.prepare(&text)).await
}

/// A surface is closed: its memory returns.
async fn close(State(app): State<App>) -> Json<Value> {
    app.engine.forget();
    crate::allocator::trim();
    Json(json!({}))
}

async fn inputs(State(app): State<App>, Json(page): Json<PageSpec>) -> Result<Json<Value>, Refused> {
    let text = page.text(&app)?;
    let prepared = checked(&app, &text).await?;
    Ok(Json(json!({ "inputs": prepared.inputs() })))
}

#[derive(Deserialize)]
struct Wanted {
    #[serde(flatten)]
    page: PageSpec,
    /// The stage after which the page has enough.
    last: Option<Stage>,
}

async fn analyse(
    State(app): State<App>,
    Json(Wanted { page, last }): Json<Wanted>,
) -> Result<Response, Refused> {
    let text = page.text(&app)?;
    let prepared = checked(&app, &text).await?;
    let last = last.unwrap_or(Stage::Everything);
    Ok(answer(Arc::clone(&app.budget), prepared.memory(), move |watch| {
        for &stage in prepared.stages() {
            if stage > last {
                break;
            }
            let inputs = prepared.inputs();
            let run = || prepared.run(stage, watch);
            let found = if stage == Stage::Models { run() } else { app.background.install(run) }?;
            tell(watch, stage, found, inputs);
        }
        Ok(())
    }))
}

fn tell(watch: &Watch, stage: Stage, mut found: Value, inputs: Value) {
    let elapsed = watch.elapsed().as_secs_f64();
    found["inputs"] = inputs;
    watch.tell("results", &json!({ "stage": stage, "results": found, "elapsed_s": elapsed }));
}

async fn report(State(app): State<App>, Json(saved): Json<Saved>) -> Result<Response, Refused> {
    let text = saved.spec.text(&app)?;
    let prepared = checked(&app, &text).await?;
    Ok(answer(Arc::clone(&app.budget), prepared.memory(), move |watch| {
        let (path, state) = saved.save(&app)?;
        let (root, out) = (app.folder.root(), app.folder.reports()?);
        let stem = app.background.install(|| app.engine.report(&path, root, &out, watch))?;
        let page = format!("{REPORTS}/{stem}/report.html");
        watch.tell("report", &json!({ "path": saved.path(), "state": state, "page": page }));
        Ok(())
    }))
}

/// A file of a report. It may run its own scripts, but has no origin and fetches nothing: whoever wrote it cannot use the workbench.
async fn of_report(
    State(app): State<App>,
    Path((key, path)): Path<(String, String)>,
) -> Result<Response, Refused> {
    const POLICY: &str = "sandbox allow-scripts allow-popups allow-downloads allow-modals; default-src 'none'; script-src 'unsafe-inline'; \
         style-src 'unsafe-inline'; img-src 'self' data: blob:";
    if !crate::guard::is_same(&key, app.guard.reports()) {
        return Ok((StatusCode::NOT_FOUND, "found nothing here").into_response());
    }
    let (content, media) = on_disk(move || app.folder.of_report(&path)).await?;
    let mut response = content.into_response();
    response.headers_mut().insert(header::CONTENT_TYPE, HeaderValue::from_static(media));
    response.headers_mut().insert(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(POLICY));
    Ok(response)
}

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
