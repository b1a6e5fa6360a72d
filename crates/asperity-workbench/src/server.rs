//! Addresses, and the life of the server.

use std::io;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use tempfile::NamedTempFile;
use tokio::net::TcpListener;

use crate::analysis::Budget;
use crate::engine::Engine;
use crate::folder::Folder;
use crate::guard::Guard;
use crate::routes::{Shared, router};
use crate::{allocator, guard, limits};

#[derive(Debug, Clone)]
pub struct Options {
    /// The folder of maps, specs and reports.
    pub folder: PathBuf,
    /// The port; `None` for the usual one, or another where that is taken.
    pub port: Option<u16>,
    /// Where the token is kept; `None` for the user's configuration folder.
    pub token: Option<PathBuf>,
}

/// The port of bookmarks.
pub const PORT: u16 = 8642;

/// Why the page cannot be served.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// The folder cannot be used.
    #[error("{}: {error}; allowed: a folder that is there", folder.display())]
    Folder { folder: PathBuf, error: io::Error },
    /// The port cannot be used.
    #[error("--port {port}: {error}; allowed: a free port, or no --port")]
    Port { port: u16, error: io::Error },
    /// The token cannot be kept.
    #[error("{}: {error}; it holds the key of the page, and must be a file that can be read and written", path.display())]
    Token { path: PathBuf, error: io::Error },
    /// The system refuses something else.
    #[error("the page cannot be served: {0}")]
    System(#[from] io::Error),
}

pub struct Server {
    runtime: tokio::runtime::Runtime,
    listeners: Vec<TcpListener>,
    address: String,
    app: Arc<Shared>,
    /// The file that the browser is given, until it has read it.
    opened: Option<NamedTempFile>,
}

/// How long a browser may take to start.
const START: Duration = Duration::from_secs(60);

impl Server {
    /// Listens on this machine alone, 127.0.0.1 and, where there is such a thing, ::1.
    pub fn new(options: &Options, engine: Arc<dyn Engine>) -> Result<Self, ServeError> {
        allocator::keep_large_apart();
        let folder = Folder::new(&options.folder)
            .map_err(|error| ServeError::Folder { folder: options.folder.clone(), error })?;
        let path = options.token.clone().or_else(guard::path);
        let token = match &path {
            Some(path) => {
                guard::kept(path).map_err(|error| ServeError::Token { path: path.clone(), error })?
            }
            // Without such a folder it lasts as long as the server.
            None => guard::random()?,
        };
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build()?;
        let listeners = runtime.block_on(listeners(options.port))?;
        let addresses: Vec<SocketAddr> =
            listeners.iter().map(TcpListener::local_addr).collect::<Result<_, _>>()?;
        let port = addresses.first().map_or(0, SocketAddr::port);
        let address = format!("http://127.0.0.1:{port}/?token={token}");
        let background = rayon::ThreadPoolBuilder::new()
            .start_handler(|_| yield_to_others())
            .build()
            .map_err(io::Error::other)?;
        let app = Arc::new(Shared {
            engine,
            folder,
            guard: Arc::new(Guard::new(&addresses, token, guard::random()?)),
            budget: Arc::new(Budget::new(limits::memory())),
            background,
        });
        Ok(Self { runtime, listeners, address, app, opened: None })
    }

    /// The address that opens the page.
    pub fn address(&self) -> &str {
        &self.address
    }

    /// Opens the page in the user's browser, by a file that only its user can read.
    pub fn open(&mut self) -> io::Result<()> {
        let file = self.app.folder.page_that_leads_to(&self.address)?;
        open::that_detached(file.path())?;
        self.opened = Some(file);
        Ok(())
    }

    pub fn run(self) -> io::Result<()> {
        let Self { runtime, listeners, app, opened, .. } = self;
        runtime.block_on(async {
            tokio::spawn(async move {
                tokio::time::sleep(START).await;
                drop(opened);
            });
            let serve = |listener| axum::serve(listener, router(Arc::clone(&app))).into_future();
            let all: Vec<_> = listeners.into_iter().map(|listener| tokio::spawn(serve(listener))).collect();
            for one in all {
                one.await.map_err(io::Error::other)??;
            }
            Ok(())
        })
    }
}

/// Gives a thread a low priority: while a slider moves, what it shows comes first.
#[cfg(target_os = "linux")]
fn yield_to_others() {
    const NICE: i32 = 15;
    // It is of the calling thread alone; without it all still works.
    let _ = rustix::process::setpriority_process(None, NICE);
}

#[cfg(not(target_os = "linux"))]
fn yield_to_others() {}

/// Listeners on both addresses of this machine, with the same port.
async fn listeners(port: Option<u16>) -> Result<Vec<TcpListener>, ServeError> {
    let at = |ip: IpAddr, port| TcpListener::bind(SocketAddr::new(ip, port));
    let v4 = IpAddr::from(Ipv4Addr::LOCALHOST);
    let first = match port {
        Some(port) => at(v4, port).await.map_err(|error| ServeError::Port { port, error })?,
        None => match at(v4, PORT).await {
            Ok(listener) => listener,
            Err(_) => at(v4, 0).await?,
        },
    };
    let port = first.local_addr()?.port();
    let mut all = vec![first];
    // Not every system has it, and another program may use its port.
    all.extend(at(IpAddr::from(Ipv6Addr::LOCALHOST), port).await);
    Ok(all)
}
