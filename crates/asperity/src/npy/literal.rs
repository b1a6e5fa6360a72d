//! A parser for the Python literals of a header: a dictionary of strings, booleans, integers, tuples and lists.

/// A literal.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Literal {
    Text(String),
    Bool(bool),
    /// `None` if it is negative or beyond 64 bits.
    Integer(Option<u64>),
    /// A tuple or a list.
    Sequence(Vec<Literal>),
    Dictionary(Vec<(String, Literal)>),
}

/// The deepest nesting: that of record types.
const MAX_DEPTH: usize = 32;

impl Literal {
    /// Parses a text that is one dictionary.
    ///
    /// # Errors
    /// The byte at which parsing failed.
    pub(super) fn dictionary(text: &str) -> Result<Vec<(String, Self)>, usize> {
        let mut parser = Parser { text, place: 0 };
        match parser.literal(0) {
            Some(Self::Dictionary(entries)) if parser.peek().is_none() => Ok(entries),
            _ => Err(parser.place),
        }
    }
}

struct Parser<'a> {
    text: &'a str,
    place: usize,
}

impl Parser<'_> {
    /// The next character that is not a space.
    fn peek(&mut self) -> Option<char> {
        let rest = self.rest();
        self.place += rest.len() - rest.trim_start().len();
        self.rest().chars().next()
    }

    fn rest(&self) -> &str {
        &self.text[self.place..]
    }

    /// Consumes `wanted` if it comes next.
    fn takes(&mut self, wanted: char) -> bool {
        let is_next = self.peek() == Some(wanted);
        if is_next {
            self.place += wanted.len_utf8();
        }
        is_next
    }

    fn literal(&mut self, depth: usize) -> Option<Literal> {
        if depth > MAX_DEPTH {
            return None;
        }
        match self.peek()? {
            '\'' | '"' => self.text().map(Literal::Text),
            '(' => self.tuple(depth),
            '[' => {
                self.elements(']', |parser| parser.literal(depth + 1)).map(|(all, _)| Literal::Sequence(all))
            }
            '{' => {
                self.elements('}', |parser| parser.entry(depth + 1)).map(|(all, _)| Literal::Dictionary(all))
            }
            'T' => self.word("True").then_some(Literal::Bool(true)),
            'F' => self.word("False").then_some(Literal::Bool(false)),
            _ => self.integer(),
        }
    }

    fn word(&mut self, word: &str) -> bool {
        let is_next = self.rest().starts_with(word);
        if is_next {
            self.place += word.len();
        }
        is_next
    }

    /// A quoted string. Escapes occur only in field names of records, which are not supported.
    fn text(&mut self) -> Option<String> {
        let quote = self.peek()?;
        let begin = self.place + quote.len_utf8();
        let mut is_escaped = false;
        for (length, roughness) in self.text[begin..].char_indices() {
            if roughness == quote && !is_escaped {
                self.place = begin + length + quote.len_utf8();
                return Some(self.text[begin..begin + length].to_owned());
            }
            is_escaped = roughness == '\\' && !is_escaped;
        }
        None
    }

    fn integer(&mut self) -> Option<Literal> {
        let is_negative = self.takes('-');
        let digits = self.rest().len() - self.rest().trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let (begin, end) = (self.place, self.place + digits);
        self.place = end;
        let number = self.text[begin..end].parse().ok().filter(|&number: &u64| number == 0 || !is_negative);
        (digits > 0).then_some(Literal::Integer(number))
    }

    /// A tuple, or a literal in parentheses.
    fn tuple(&mut self, depth: usize) -> Option<Literal> {
        let (mut all, has_comma) = self.elements(')', |parser| parser.literal(depth + 1))?;
        if all.len() == 1 && !has_comma { all.pop() } else { Some(Literal::Sequence(all)) }
    }

    fn entry(&mut self, depth: usize) -> Option<(String, Literal)> {
        self.peek().filter(|quote| ['\'', '"'].contains(quote))?;
        let key = self.text()?;
        self.takes(':').then(|| self.literal(depth))?.map(|value| (key, value))
    }

    /// The comma-separated elements up to the closing bracket, and whether there was a comma.
    fn elements<T>(&mut self, close: char, one: impl Fn(&mut Self) -> Option<T>) -> Option<(Vec<T>, bool)> {
        self.place += 1;
        let (mut all, mut has_comma) = (Vec::new(), false);
        while !self.takes(close) {
            all.push(one(self)?);
            if !self.takes(',') {
                return self.takes(close).then_some((all, has_comma));
            }
            has_comma = true;
        }
        Some((all, has_comma))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_as_numpy_writes_it() {
        let text = " {'descr': '<f8', \"fortran_order\": False , 'shape': (3, 4), }   \n";
        let shape = Literal::Sequence(vec![Literal::Integer(Some(3)), Literal::Integer(Some(4))]);
        let entries = Literal::dictionary(text).unwrap();
        assert_eq!(entries[0], ("descr".to_owned(), Literal::Text("<f8".to_owned())));
        assert_eq!(entries[1], ("fortran_order".to_owned(), Literal::Bool(false)));
        assert_eq!(entries[2], ("shape".to_owned(), shape));
    }

    #[test]
    fn sequences_and_what_is_in_them() {
        let of =
            |value: &str| Literal::dictionary(&format!("{{'a': {value}}}")).map(|mut all| all.remove(0).1);
        assert_eq!(of("()"), Ok(Literal::Sequence(vec![])));
        assert_eq!(of("(7)"), Ok(Literal::Integer(Some(7))));
        assert_eq!(of("(7,)"), Ok(Literal::Sequence(vec![Literal::Integer(Some(7))])));
        assert_eq!(of("-7"), Ok(Literal::Integer(None)));
        assert_eq!(of("99999999999999999999"), Ok(Literal::Integer(None)));
        let field = |name: &str| {
            Literal::Sequence(["<f4", name].iter().rev().map(|t| Literal::Text((*t).into())).collect())
        };
        assert_eq!(
            of("[('x', '<f4'), ('é\\'', '<f4')]"),
            Ok(Literal::Sequence(vec![field("x"), field("é\\'")]))
        );
    }

    #[test]
    fn what_is_no_dictionary() {
        for text in [
            "",
            "{",
            "{'a'",
            "{'a': }",
            "{'a': 1} x",
            "{a: 1}",
            "'a'",
            "{'a': 1 2}",
            "{'a': (1, 2}",
            "{'a': T}",
            "{'a\\': 1}",
        ] {
            assert!(Literal::dictionary(text).is_err(), "{text}");
        }
        let deep = format!("{{'a': {}", "(".repeat(1_000_000));
        assert!(Literal::dictionary(&deep).is_err());
    }
}
