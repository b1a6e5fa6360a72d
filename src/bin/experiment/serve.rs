//! `experiment serve`: the workbench.

use std::path::Path;
use std::sync::Arc;

use asperity_experiment::workbench::Workbench;
use asperity_workbench::server::PORT;
use asperity_workbench::{Options, ServeError, Server};

use super::{Failure, interrupt, print, print_error};

impl From<ServeError> for Failure {
    fn from(error: ServeError) -> Self {
        match error {
            ServeError::Folder { .. } | ServeError::Port { .. } => Self::Input(error.to_string()),
            ServeError::Token { .. } | ServeError::System(_) => Self::Run(error.to_string()),
        }
    }
}

/// Serves the workbench of a folder until Ctrl-C.
pub fn serve(folder: &Path, port: Option<u16>, no_open: bool) -> Result<(), Failure> {
    // Reports name files as `experiment run` in that folder does.
    std::env::set_current_dir(folder).map_err(|error| {
        Failure::Input(format!("{}: {error}; allowed: a folder that is there", folder.display()))
    })?;
    let options = Options { folder: ".".into(), port, token: None };
    let mut server = Server::new(&options, Arc::new(Workbench::default()))?;
    interrupt::of_workbench();
    print(format_args!("{}", server.address()));
    if port.is_none() && !server.address().contains(&format!(":{PORT}/")) {
        print_error(format_args!("port {PORT} is taken, perhaps by another workbench; bookmarks lead there"));
    }
    if !no_open && let Err(error) = server.open() {
        print_error(format_args!("no browser could be opened ({error}); open the address above by hand"));
    }
    server.run().map_err(|error| Failure::Run(error.to_string()))
}
