//! How wide a text will be, without any font: whoever shows the picture sets its text.

/// Fonts to ask for; their widths differ little.
pub(super) const FAMILY: &str = "Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif";

/// Room for the wider ones among those fonts.
const ROOM: f64 = 1.06;

/// Width of a text at a font size, in the unit of the size: advance widths of Helvetica in classes.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let ems: f64 = text.chars().map(advance).sum();
    ems * size * ROOM
}

fn advance(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | '\'' | '|' => 0.22,
        ' ' | '.' | ',' | ':' | ';' | '!' | 'f' | 't' | 'I' | '/' | '\\' | '[' | ']' => 0.28,
        '(' | ')' | '-' | 'r' | '`' | '"' | '·' => 0.33,
        '⁰'..='⁹' | '¹' | '²' | '³' | '⁻' | '₀'..='₉' => 0.37,
        'c' | 'k' | 's' | 'v' | 'x' | 'y' | 'z' => 0.50,
        '+' | '−' | '=' | '<' | '>' | '×' | '±' | '≤' | '≥' | '≈' => 0.59,
        'w' | 'C' | 'D' | 'H' | 'N' | 'R' | 'U' => 0.73,
        'G' | 'O' | 'Q' => 0.78,
        'm' | 'M' | '%' | '–' => 0.86,
        'W' | '@' | '—' | '…' => 1.0,
        'A'..='Z' | '&' => 0.67,
        _ if c.is_ascii() => 0.556,
        'À'..='ɏ' | 'Α'..='ӿ' => 0.60,
        _ => 1.0,
    }
}

/// The text, or its beginning and "…" where it is wider than `room`.
pub(super) fn fit(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut short = String::new();
    for c in text.chars() {
        short.push(c);
        if width(&short, size) + width("…", size) > room {
            short.pop();
            break;
        }
    }
    short.truncate(short.trim_end().len());
    short.push('…');
    short
}

/// Breaks a text between words into lines no wider than `room`, at most `most`; the last is cut.
pub(super) fn wrap(text: &str, size: f64, room: f64, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let full = lines.len() == most;
        match lines.last_mut() {
            Some(line) if full || width(line, size) + width(" ", size) + width(word, size) <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.iter().map(|line| fit(line, size, room)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fits_is_left_alone_and_the_rest_is_cut() {
        assert_eq!(fit("load", 12.0, 100.0), "load");
        let cut = fit(&"wide ".repeat(40), 12.0, 100.0);
        assert!(cut.ends_with('…') && width(&cut, 12.0) <= 100.0, "{cut}");
        assert_eq!(fit("wide", 12.0, 0.0), "…");
    }

    #[test]
    fn lines_break_between_words() {
        let lines = wrap("how far apart the two models are", 12.0, 90.0, 4);
        assert!(lines.len() > 1 && lines.iter().all(|line| width(line, 12.0) <= 90.0), "{lines:?}");
        assert_eq!(lines.join(" "), "how far apart the two models are");
        assert_eq!(wrap("one two three four five", 12.0, 40.0, 1).len(), 1);
        assert!(wrap("", 12.0, 40.0, 2).is_empty());
    }
}
