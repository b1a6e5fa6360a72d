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
