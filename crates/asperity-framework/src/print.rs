//! Figures of a report for print, where this build writes them.

#[cfg(feature = "print")]
pub use asperity_print::PrintError;
#[cfg(feature = "print")]
pub use written::printed;

#[cfg(not(feature = "print"))]
pub use absent::{PrintError, printed};

/// A figure's file: name and content.
type File = (String, Vec<u8>);

#[cfg(feature = "print")]
mod written {
    use rayon::prelude::*;

    use super::{File, PrintError};

    /// Each figure (name and SVG) as PDF and as PNG.
    pub fn printed(figures: &[(String, String)]) -> Result<Vec<File>, PrintError> {
        /// Pixels per inch, as journals ask for.
        const DPI: f32 = 300.0;
        let both = |(name, svg): &(String, String)| {
            let stem = name.strip_suffix(".svg").unwrap_or(name);
            Ok([
                (format!("{stem}.pdf"), asperity_print::pdf(svg)?),
                (format!("{stem}.png"), asperity_print::png(svg, DPI)?),
            ])
        };
        let files: Result<Vec<_>, PrintError> = figures.par_iter().map(both).collect();
        Ok(files?.into_iter().flatten().collect())
    }
}

#[cfg(not(feature = "print"))]
mod absent {
    use super::File;

    /// Figures that this build cannot write.
    #[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
    #[error(
        "cannot be written as PDF and PNG by this build; allowed: no `figure` in the spec, or the program `experiment`"
    )]
    pub struct PrintError;

    /// Nothing is printed.
    pub fn printed(_: &[(String, String)]) -> Result<Vec<File>, PrintError> {
        Err(PrintError)
    }
}
