//! Texts from files in messages.

use std::borrow::Cow;

/// A text as a message shows it: of more than `most` characters the beginning and the end, and control characters other than tabs and ends
/// of lines, which a terminal would obey, as escapes.
pub fn legible(text: &str, most: usize) -> Cow<'_, str> {
    let is_obeyed = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    // A character has at most four bytes, so that most texts need not be counted.
    let is_long = text.len() > most && text.chars().nth(most).is_some();
    if !is_long && !text.contains(is_obeyed) {
        return text.into();
    }
    let place =
        |characters: usize| text.char_indices().nth(characters).map_or(text.len(), |(place, _)| place);
    let end = |characters: usize| text.char_indices().nth_back(characters).map_or(0, |(place, _)| place);
    let parts = if is_long {
        let last = most / 3;
        [&text[..place(most - last)], " ... ", &text[end(last.saturating_sub(1))..]]
    } else {
        [text, "", ""]
    };
    let mut shown = String::new();
    for c in parts.into_iter().flat_map(str::chars) {
        if is_obeyed(c) { shown.extend(c.escape_default()) } else { shown.push(c) }
    }
    shown.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_keep_beginning_and_end() {
        assert_eq!(legible("µ as it is\n\t", 12), "µ as it is\n\t");
        assert_eq!(legible("0123456789abc", 12), "01234567 ... 9abc");
        assert_eq!(legible(&"µ".repeat(1_000_000), 6), "µµµµ ... µµ");
        assert_eq!(legible("red \u{1b}[31m\u{7}", 100), "red \\u{1b}[31m\\u{7}");
    }
}
