//! The terms of the program, explained where they first appear on a page.

use std::sync::LazyLock;

use indexmap::IndexMap;

use super::page::escape_html;

/// Lines of a term, the forms in which it appears in texts, and its meaning.
const LIST: &str = include_str!("terms.txt");
pub const STYLE: &str = include_str!("glossary.css");
const SCRIPT: &str = include_str!("glossary.js");

struct Term {
    name: &'static str,
    /// As texts have it, in small letters; the longest first.
    forms: Vec<String>,
    meaning: &'static str,
}

static TERMS: LazyLock<Vec<Term>> = LazyLock::new(|| LIST.lines().filter_map(Term::read).collect());

impl Term {
    fn read(line: &'static str) -> Option<Self> {
        let mut parts = line.split(" | ");
        let (name, forms, meaning) = (parts.next()?, parts.next()?, parts.next()?);
        let mut forms: Vec<String> = forms.split("; ").map(str::to_ascii_lowercase).collect();
        forms.sort_by_key(|form| std::cmp::Reverse(form.len()));
        Some(Self { name, forms, meaning })
    }

    fn id(&self) -> String {
        let words = self.name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
        words.collect::<Vec<_>>().join("-")
    }

    /// The first place in a text (small letters) at which it appears as a whole word.
    fn find(&self, text: &str) -> Option<(usize, usize)> {
        let is_letter = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || matches!(c, '-' | '_'));
        let of_form = |form: &String| {
            let is_word = |&(at, _): &(usize, &str)| {
                !is_letter(text[..at].chars().next_back())
                    && !is_letter(text[at + form.len()..].chars().next())
            };
            text.match_indices(form.as_str()).find(is_word).map(|(at, _)| (at, form.len()))
        };
        self.forms.iter().filter_map(of_form).min_by_key(|&(at, length)| (at, std::cmp::Reverse(length)))
    }
}

/// The meaning of each term by its id.
pub fn meanings() -> IndexMap<String, String> {
    TERMS.iter().map(|term| (term.id(), term.meaning.replace('`', ""))).collect()
}

/// Explains terms where they first appear on a page.
#[derive(Default)]
pub struct Explainer {
    /// Places in the list of the terms that are explained.
    explained: Vec<usize>,
}

impl Explainer {
    /// The HTML with the first occurrence of each term as a button that shows what it means; not in links.
    pub fn mark(&mut self, html: &str) -> String {
        let mut marked = String::with_capacity(html.len());
        let mut is_link = false;
        for part in html.split_inclusive('>') {
            let (text, tag) = part.split_at(part.find('<').unwrap_or(part.len()));
            if is_link {
                marked.push_str(text);
            } else {
                self.mark_text(text, &mut marked);
            }
            marked.push_str(tag);
            is_link = tag.starts_with("<a ") || is_link && !tag.starts_with("</a");
        }
        marked
    }

    fn mark_text(&mut self, text: &str, marked: &mut String) {
        // Most cells of tables hold a number.
        if !text.bytes().any(|byte| byte.is_ascii_alphabetic()) {
            return marked.push_str(text);
        }
        let mut rest = text;
        let mut small = text.to_ascii_lowercase();
        loop {
            let open = TERMS.iter().enumerate().filter(|(place, _)| !self.explained.contains(place));
            let found = open.filter_map(|(place, term)| Some((place, term.find(&small)?)));
            let first = found.min_by_key(|&(_, (at, length))| (at, std::cmp::Reverse(length)));
            let Some((place, (at, length))) = first else { break };
            let (word, id) = (&rest[at..at + length], TERMS[place].id());
            marked.push_str(&rest[..at]);
            marked.push_str(&format!(
                "<button type=\"button\" class=\"term\" popovertarget=\"term-{id}\" aria-describedby=\"term-{id}\">{word}</button>"
            ));
            self.explained.push(place);
            rest = &rest[at + length..];
            small.drain(..at + length);
        }
        marked.push_str(rest);
    }

    /// The meanings of the terms that were marked, for the end of the page; empty without any.
    pub fn meanings(&self) -> String {
        let meaning = |&place: &usize| {
            let term = &TERMS[place];
            let id = term.id();
            format!(
                "<div class=\"meaning\" popover id=\"term-{id}\">{}</div>\n",
                escape_html(&term.meaning.replace('`', ""))
            )
        };
        self.explained.iter().map(meaning).collect()
    }

    /// Style and script that a page with marked terms needs; both empty of a page without.
    pub fn assets(&self) -> (&'static str, String) {
        if self.explained.is_empty() {
            return ("", String::new());
        }
        (STYLE, format!("<script>\n{SCRIPT}</script>\n"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_term_has_a_short_meaning_and_a_name_of_its_own() {
        assert_eq!(TERMS.len(), LIST.lines().count());
        assert!(TERMS.len() >= 40);
        for (place, term) in TERMS.iter().enumerate() {
            let words = term.meaning.split_whitespace().count();
            assert!((3..=30).contains(&words), "{}: {words} words", term.name);
            assert!(TERMS[..place].iter().all(|other| other.id() != term.id()), "{}", term.name);
        }
    }

    #[test]
    fn a_term_is_explained_where_it_first_stands() {
        let mut explainer = Explainer::default();
        let marked =
            explainer.mark("<td>30 Effective contacts</td><td>effective contacts</td><td>S filter</td>");
        assert_eq!(marked.matches("class=\"term\"").count(), 2, "{marked}");
        assert!(marked.contains("aria-describedby=\"term-effective-contacts\">Effective contacts</button></td><td>effective contacts</td>"));
        assert!(!explainer.mark("<td>s filter</td>").contains("<button"));
        assert!(
            explainer.meanings().contains("squared load shares")
                && explainer.meanings().contains("term-S-filter")
        );
        assert!(!explainer.meanings().contains("dual"));
    }

    #[test]
    fn what_is_no_term_stays_as_it_is() {
        let mut explainer = Explainer::default();
        let html = "<td title=\"sum\">summary, assumed, without, un-sum, layer</td><a href=\"x\">the sum</a>";
        assert_eq!(explainer.mark(html), html);
        assert_eq!(explainer.meanings(), "");
        assert_eq!(explainer.assets(), ("", String::new()));
    }

    #[test]
    fn of_two_terms_at_one_place_the_longer_is_explained() {
        let marked = Explainer::default().mark("<p>own, in-contact: the very likely beyond</p>");
        assert!(marked.contains("\">own, in-contact</button>"), "{marked}");
        assert!(marked.contains("\">very likely beyond</button>"), "{marked}");
    }
}
