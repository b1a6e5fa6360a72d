//! Text as Markdown: nothing in a user's text is markup.

use super::Cell;
use crate::report::answer::CardLine;

/// Plain text as Markdown that shows exactly that text: nothing in it is markup. Line breaks and other
/// control characters become blanks.
pub fn escape(text: &str) -> String {
    let text = one_line(text);
    let mut escaped = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '\\' | '`' | '*' | '_' | '{' | '}' | '[' | ']' | '|' | '~' | '#' | '$' => {
                escaped.extend(['\\', c])
            }
            // At the start of a line these would make a list, a rule or a heading, unless a number
            // or a word goes on.
            '-' | '+' | '=' | '.' | ')'
                if escaped.bytes().all(|b| b.is_ascii_digit())
                    && !rest.peek().is_some_and(|c| c.is_alphanumeric()) =>
            {
                escaped.extend(['\\', c]);
            }
            _ => escaped.push(c),
        }
    }
    escaped
}

/// The same, except that text between backticks is code.
pub fn escape_around_code(text: &str) -> String {
    let parts: Vec<&str> = text.split('`').collect();
    // Backticks that are not pairs are no markup.
    if parts.len().is_multiple_of(2) {
        return escape(text);
    }
    let part = |(index, part): (usize, &&str)| {
        if !index.is_multiple_of(2) {
            return format!("`{}`", one_line(part));
        }
        // Letters keep blanks at the ends; only the first part is at the start of a line.
        let before = if index == 0 { "" } else { "x" };
        let escaped = escape(&format!("{before}{part}x"));
        escaped[before.len()..escaped.len() - 1].to_owned()
    };
    parts.iter().enumerate().map(part).collect::<String>().trim().to_owned()
}

/// Control characters, line breaks among them, as blanks: a text cannot leave its block.
pub(super) fn one_line(text: &str) -> String {
    let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    text.trim().to_owned()
}

/// An address for a Markdown link: what could end the link is percent-encoded.
pub(super) fn address(to: &str) -> String {
    let mut address = String::new();
    for byte in to.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' => address.push(byte.into()),
            b'-' | b'.' | b'_' | b'~' | b'/' | b':' | b'#' | b'?' | b'=' | b'&' | b'%' | b'+' | b',' => {
                address.push(byte.into());
            }
            other => address.push_str(&format!("%{other:02X}")),
        }
    }
    address
}

pub(super) fn cell_markdown(cell: &Cell) -> String {
    match cell {
        Cell::Text(text) => escape(text),
        Cell::AroundCode(text) => escape_around_code(text),
        Cell::Link { text, to } => format!("[{}]({})", escape(text), address(to)),
    }
}

pub(super) fn line_of(cells: impl Iterator<Item = String>) -> String {
    format!("| {} |", cells.collect::<Vec<_>>().join(" | "))
}

/// A card as a table without a header.
pub(super) fn card(lines: &[CardLine]) -> String {
    let row = |line: &CardLine| {
        let texts: Vec<String> = line.texts.iter().map(|text| escape_around_code(text)).collect();
        line_of([format!("**{}**", escape(&line.label)), texts.join("<br>")].into_iter())
    };
    let rows = lines.iter().map(row);
    let header = ["|  |  |".to_owned(), "| --- | --- |".to_owned()];
    header.into_iter().chain(rows).collect::<Vec<_>>().join("\n")
}

/// Whether a column holds numbers, with or without a unit or a percent sign, and no text.
pub(super) fn is_numeric(rows: &[Vec<Cell>], column: usize) -> bool {
    let mut any = false;
    for row in rows {
        let text = match row.get(column) {
            Some(Cell::Text(text) | Cell::AroundCode(text)) => text.trim(),
            Some(Cell::Link { .. }) => return false,
            None => "",
        };
        if matches!(text, "" | "–" | "∞") {
            continue;
        }
        let mut words = text.strip_prefix("< ").unwrap_or(text).split_whitespace();
        let number = words.next().unwrap_or("").replace(',', "").replace('−', "-");
        let is_number =
            number.ends_with(|c: char| c.is_ascii_digit()) && number.parse::<f64>().is_ok() || number == "∞";
        if !is_number || words.count() > 1 {
            return false;
        }
        any = true;
    }
    any
}
