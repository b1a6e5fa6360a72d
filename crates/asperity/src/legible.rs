//! Texts from files in messages.

use std::borrow::Cow;

/// A text as a message shows it, in at most `most` characters and a mark between: of a longer one the beginning and the end, and control
/// characters other than tabs and ends of lines, which a terminal would obey, as escapes.
pub fn legible(text: &str, most: usize) -> Cow<'_, str> {
    let is_obeyed = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    let text = shortened(text, most);
    if !text.contains(is_obeyed) {
        return text;
    }
    let mut shown = String::new();
    for c in text.chars() {
        if is_obeyed(c) { shown.extend(c.escape_default()) } else { shown.push(c) }
    }
    // Escapes are longer than what they stand for.
    shortened(&shown, most).into_owned().into()
}

/// The beginning and the end of a text of more than `most` characters.
fn shortened(text: &str, most: usize) -> Cow<'_, str> {
    // A character has at most four bytes, so that most texts need not be counted.
    if text.len() <= most || text.chars().nth(most).is_none() {
        return text.into();
    }
    let last = most / 3;
    let place = |count: usize| text.char_indices().nth(count).map_or(text.len(), |(place, _)| place);
    let end = text.char_indices().rev().take(last).last().map_or(text.len(), |(place, _)| place);
    [&text[..place(most - last)], " ... ", &text[end..]].concat().into()
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
        assert_eq!(legible(&"\0".repeat(1_000_000), 12), "\\u{0}\\u{ ... u{0}");
    }
}
