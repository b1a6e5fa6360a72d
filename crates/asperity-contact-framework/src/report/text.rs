//! Comparison of pages and pictures: words exactly, numbers as far as they are shown.

/// The first line that differs in more than the last shown digit of its numbers; `None` where there is none.
pub fn first_difference(new: &str, old: &str) -> Option<String> {
    let (mut a, mut b) = (new.lines(), old.lines());
    for line in 1.. {
        match (a.next(), b.next()) {
            (None, None) => return None,
            (Some(new), Some(old)) if new == old || is_same(new, old) => {}
            (new, old) => {
                let [new, old] = [new, old].map(|line| excerpt(line.unwrap_or("nothing")));
                return Some(format!("line {line}: now {new}, committed {old}"));
            }
        }
    }
    None
}

fn excerpt(line: &str) -> String {
    const MOST: usize = 120;
    let text: String = line.chars().take(MOST).collect();
    if text.len() < line.len() { format!("{text}...") } else { text }
}

fn is_same(new: &str, old: &str) -> bool {
    let (mut a, mut b) = (Tokens(new), Tokens(old));
    loop {
        match (a.next(), b.next()) {
            (None, None) => return true,
            (Some(new), Some(old)) if new == old => {}
            (Some(new), Some(old)) if is_same_number(new, old) => {}
            _ => return false,
        }
    }
}

/// Whether two numbers differ by at most one in the last digit of that with more digits.
fn is_same_number(a: &str, b: &str) -> bool {
    let (Ok(x), Ok(y)) = (a.parse::<f64>(), b.parse::<f64>()) else { return false };
    // Counts are exact.
    let is_count = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let step = last_digit(a).min(last_digit(b));
    !(is_count(a) && is_count(b)) && (x - y).abs() <= 1.01 * step
}

fn last_digit(number: &str) -> f64 {
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    10f64.powi(exponent.parse::<i32>().unwrap_or(0) - decimals as i32)
}

/// Numbers, and the texts between them.
struct Tokens<'a>(&'a str);

impl<'a> Iterator for Tokens<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        if self.0.is_empty() {
            return None;
        }
        let length = match number_length(self.0) {
            0 => self
                .0
                .char_indices()
                .map(|(place, _)| place)
                .skip(1)
                .find(|&place| number_length(&self.0[place..]) > 0),
            length => Some(length),
        };
        let (token, rest) = self.0.split_at(length.unwrap_or(self.0.len()));
        self.0 = rest;
        Some(token)
    }
}

/// Length of the number that a text begins with; 0 of a text that begins otherwise.
fn number_length(text: &str) -> usize {
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let sign = usize::from(text.starts_with(['-', '+']));
    let whole = digits(sign);
    let mut length = sign + whole;
    if text[length..].starts_with('.') && digits(length + 1) > 0 {
        length += 1 + digits(length + 1);
    } else if whole == 0 {
        return 0;
    }
    if text[length..].starts_with(['e', 'E']) {
        let sign = usize::from(text[length + 1..].starts_with(['-', '+']));
        let exponent = digits(length + 1 + sign);
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    length
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_may_differ_in_the_last_shown_digit_and_words_may_not() {
        let is_same = |new: &str, old: &str| first_difference(new, old).is_none();
        for (new, old) in [
            ("area 12.3 % too large", "area 12.4 % too large"),
            ("M10.25,-3.5L4", "M10.24,-3.5L4"),
            ("1e-4 of it", "9.99e-5 of it"),
            ("12 m", "12.1 m"),
            ("+0.1", "+0.2"),
        ] {
            assert!(is_same(new, old), "{new}");
        }
        for (new, old) in [
            ("area 12.3 % too large", "area 12.5 % too large"),
            ("within 3 %", "beyond 3 %"),
            ("247 contacts", "248 contacts"),
            ("one line", "one line\nand another"),
            ("0.1 µm", "0.1 nm"),
        ] {
            assert!(!is_same(new, old), "{new}");
        }
        let line = first_difference("a\nb 1.0\nc", "a\nb 2.0\nc").unwrap();
        assert_eq!(line, "line 2: now b 1.0, committed b 2.0");
    }
}
