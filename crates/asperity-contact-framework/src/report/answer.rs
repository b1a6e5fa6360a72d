//! What a page says first: a sentence, or a card of labelled lines.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The words that a sentence, or a text of a card, may have at most.
pub const MOST_WORDS: usize = 25;

#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Answer {
    /// In one or two sentences.
    #[serde(default)]
    pub sentence: String,
    /// The card of one case; empty of several, and of an experiment that has no cases.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<CardLine>,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CardLine {
    /// Its name for machines.
    pub key: String,
    pub label: String,
    /// What it says, in one text or several, with code between backticks.
    pub texts: Vec<String>,
}

impl CardLine {
    /// The key of the line that answers the question of the experiment.
    pub const ANSWER: &str = "answer";

    pub fn new(key: &str, label: &str, text: impl Into<String>) -> Self {
        Self { key: key.to_owned(), label: label.to_owned(), texts: vec![text.into()] }
    }

    pub fn text(&self) -> String {
        self.texts.join(" ")
    }
}

/// The first of some texts, from the fullest to the shortest, that has at most [`MOST_WORDS`] words; the last where none has.
pub fn fitting(texts: impl IntoIterator<Item = String>) -> String {
    let mut last = String::new();
    for text in texts {
        last = text;
        if words(&last) <= MOST_WORDS {
            break;
        }
    }
    last
}

/// The number of words of a text, as `tests/prose.py` counts them.
pub fn words(text: &str) -> usize {
    text.split_whitespace().count()
}

/// The lines with their labels in a column of their own, or the sentence.
impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.lines.is_empty() {
            return f.write_str(&self.sentence);
        }
        let width = self.lines.iter().map(|line| line.label.chars().count()).max().unwrap_or(0);
        for (index, line) in self.lines.iter().enumerate() {
            for (place, text) in line.texts.iter().enumerate() {
                if index + place > 0 {
                    f.write_str("\n")?;
                }
                write!(f, "{:width$}  {text}", if place == 0 { line.label.as_str() } else { "" })?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fullest_text_that_fits_is_taken() {
        let of = |count: usize| "word ".repeat(count);
        assert_eq!(words(&fitting([of(26), of(25), of(3)])), 25);
        assert_eq!(words(&fitting([of(30), of(28)])), 28);
    }

    #[test]
    fn labels_stand_in_a_column() {
        let mut line = CardLine::new("b", "Longer", "two");
        line.texts.push("three".to_owned());
        let answer = Answer { sentence: String::new(), lines: vec![CardLine::new("a", "One", "1"), line] };
        assert_eq!(answer.to_string(), "One     1\nLonger  two\n        three");
        let sentence = Answer { sentence: "Yes.".to_owned(), lines: Vec::new() };
        assert_eq!(sentence.to_string(), "Yes.");
    }
}
