//! How wide a text will be, without any font: whoever shows the picture sets its text.

/// Fonts to ask for. DejaVu Sans, which Linux shows where it has none of the others, is the widest.
pub(super) const FAMILY: &str = "Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif";

/// Size of a subscript over that of its text.
pub(super) const SMALL: f64 = 0.74;

/// The parts of a text, each with whether it is a subscript: what follows "_" after a symbol of one letter, as in "A_nom".
/// Longer words keep their "_".
pub(super) fn parts(text: &str) -> Vec<(&str, bool)> {
    let mut parts = Vec::new();
    let mut rest = text;
    let mut from = 0;
    while let Some(at) = rest[from..].find('_').map(|at| from + at) {
        let mut before = rest[..at].chars().rev();
        let is_symbol = before.next().is_some_and(char::is_alphabetic)
            && !before.next().is_some_and(|c| c.is_alphanumeric() || c == '_');
        let after = &rest[at + 1..];
        let length = after.find(|c: char| !c.is_alphanumeric()).unwrap_or(after.len());
        if is_symbol && length > 0 {
            parts.extend([(&rest[..at], false), (&after[..length], true)]);
            rest = &after[length..];
            from = 0;
        } else {
            from = at + 1;
        }
    }
    if !rest.is_empty() {
        parts.push((rest, false));
    }
    parts
}

/// Width of a text at a font size, in the unit of the size: advance widths of DejaVu Sans in classes, so that no other
/// of those fonts needs more.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let of_part = |(part, is_subscript): (&str, bool)| {
        part.chars().map(advance).sum::<f64>() * if is_subscript { SMALL } else { 1.0 }
    };
    size * parts(text).into_iter().map(of_part).sum::<f64>()
}

fn advance(c: char) -> f64 {
    match c {
        '\'' | 'i' | 'j' | 'l' | 'I' | 'J' => 0.29,
        ' ' | '.' | ',' | '·' => 0.32,
        ':' | ';' | '/' | '|' | '\\' => 0.34,
        '-' | 'f' => 0.36,
        '(' | ')' | '[' | ']' | 't' => 0.39,
        '!' | 'r' | '⁰'..='⁹' | '¹' | '²' | '³' | '₀'..='₉' => 0.41,
        '"' | '*' | '_' | '`' | '–' => 0.50,
        '?' | 's' | 'z' | '⁻' => 0.53,
        'c' | 'F' | 'L' => 0.57,
        'k' | 'v' | 'x' | 'y' | 'P' => 0.60,
        'a' | 'e' | 'o' | 'T' | 'Y' => 0.615,
        'A' | 'B' | 'C' | 'K' | 'R' | 'V' | 'X' | 'Z' => 0.69,
        'H' | 'N' | 'U' => 0.75,
        'D' | 'G' | 'O' | 'Q' | '&' => 0.79,
        'w' | '#' | '^' | '~' | '+' | '−' | '=' | '<' | '>' | '×' | '±' | '≤' | '≥' | '≈' => 0.84,
        'M' => 0.87,
        'm' | '%' => 0.98,
        'W' | '@' | '—' | '…' => 1.0,
        'ω' | 'Ω' => 0.84,
        _ if c.is_ascii() => 0.636,
        'À'..='ɏ' | 'Α'..='ӿ' => 0.68,
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

/// The text and the size at which it takes no more than `room`: as small as the smallest of a figure, then cut.
pub(super) fn shrunk(text: &str, size: f64, room: f64) -> (String, f64) {
    /// Of the size that it would have.
    const SMALLEST: f64 = 0.72;
    // Where one of both is no number the text keeps its size.
    let share = room / width(text, size);
    let fitting = if share.is_nan() { size } else { size * share.clamp(SMALLEST, 1.0) };
    // A text that just fits is not cut for the rounding of its width.
    (fit(text, fitting, room * (1.0 + 1e-9)), fitting)
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
    fn a_text_is_set_smaller_before_it_is_cut() {
        assert_eq!(shrunk("load", 12.0, 100.0), ("load".to_owned(), 12.0));
        let room = 0.8 * width("mean contact pressure", 12.0);
        let (text, size) = shrunk("mean contact pressure", 12.0, room);
        assert!(text == "mean contact pressure" && (size - 9.6).abs() < 1e-9, "{text} {size}");
        let (text, size) = shrunk("mean contact pressure", 12.0, 0.5 * room);
        assert!(
            text.ends_with('…') && (size - 8.64).abs() < 1e-9 && width(&text, size) <= 0.5 * room,
            "{text} {size}"
        );
    }

    #[test]
    fn widths_are_those_of_the_widest_font() {
        // Measured with DejaVu Sans 2.37, in ems.
        let measured = [
            ("statistical − deterministic at equal load", 19.73),
            ("asperities interact: A/A nom > 0.05", 17.68),
            ("the one radius of the statistical model", 19.05),
            ("zmc(transition-ratio=110)", 13.01),
            ("5×10⁻²⁹", 4.08),
            ("relative error (the larger of area and load)", 21.00),
        ];
        for (text, ems) in measured {
            let stated = width(text, 1.0);
            assert!((0.99..1.03).contains(&(stated / ems)), "{text}: {stated} for {ems}");
        }
    }

    #[test]
    fn subscripts_follow_symbols_of_one_letter() {
        assert_eq!(parts("P/(A_nom E*)"), [("P/(A", false), ("nom", true), (" E*)", false)]);
        assert_eq!(parts("β_avg"), [("β", false), ("avg", true)]);
        assert_eq!(parts("my_file_2, a_ b"), [("my_file_2, a_ b", false)]);
        assert_eq!(parts("2024_Z_C"), [("2024_Z_C", false)]);
        assert_eq!(parts("x_1y z_2"), [("x", false), ("1y", true), (" z", false), ("2", true)]);
        assert!(parts("").is_empty());
        assert!(width("A_nom", 1.0) < width("Anom", 1.0));
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
