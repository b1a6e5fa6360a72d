//! `experiment surface FILE`: options of the command line as a spec.

use std::path::Path;

/// Options for a measured file, besides its path; each as in a spec.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FileOptions {
    /// A length, or two with a comma between them.
    pub pixel: Option<String>,
    /// Unit of the lengths in the file.
    pub unit: Option<String>,
    /// Form that is removed.
    pub level: Option<String>,
    /// S nesting index.
    pub s: Option<String>,
    /// L nesting index.
    pub l: Option<String>,
    /// Which neighbours a summit is higher than.
    pub neighbours: Option<String>,
}

impl FileOptions {
    /// The spec that describes the file at `path`.
    pub fn spec(&self, path: &Path) -> String {
        let quoted = |text: &str| toml::Value::from(text).to_string();
        // A bare number is in metres, as in a spec.
        let length = |text: &str| match text.parse::<f64>() {
            Ok(number) if number.is_finite() => format!("{number:e}"),
            _ => quoted(text),
        };
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or("surface");
        let is_plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
        let name: String = stem.chars().map(|c| if is_plain(c) { c } else { '-' }).collect();
        let mut lines = vec![
            format!("title = {}", quoted(&format!("The surface {stem}"))),
            format!("[surface.{}.file]", quoted(&name)),
            format!("path = {}", quoted(&path.to_string_lossy())),
        ];
        if let Some(pixel) = &self.pixel {
            let sizes: Vec<String> = pixel.split(',').map(|size| length(size.trim())).collect();
            lines.push(match &sizes[..] {
                [one] => format!("pixel = {one}"),
                several => format!("pixel = [{}]", several.join(", ")),
            });
        }
        for (key, value) in [("unit", &self.unit), ("level", &self.level), ("neighbours", &self.neighbours)] {
            lines.extend(value.as_ref().map(|value| format!("{key} = {}", quoted(value))));
        }
        for (key, value) in [("filter.s", &self.s), ("filter.l", &self.l)] {
            lines.extend(value.as_ref().map(|value| format!("{key} = {}", length(value))));
        }
        lines.join("\n") + "\n"
    }
}
