//! Where in a text a field is, so that what is wrong with its value can be shown there.

use super::parse::{Format, line_and_column};
use super::toml;

/// Line and column, from 1, of the value at a path such as `bodies[3].cloth.mass` in a text that has been parsed; of
/// the innermost value on the way to it that is there. Of a table of TOML that has a header, it is that of its name there.
pub fn locate(text: &str, format: Format, path: &str) -> (usize, usize) {
    match format {
        Format::Json | Format::Json5 => locate_in_json(text, path),
        Format::Toml => line_and_column(text, toml::offset_of(text, path)),
    }
}

/// As [`locate`], in JSON or JSON5: a program that reads nothing else need not carry what reads TOML.
pub fn locate_in_json(text: &str, path: &str) -> (usize, usize) {
    let mut scanner = Scanner { text, at: 0 };
    scanner.skip_space();
    let mut place = scanner.at;
    for step in path.split(['.', '[']).filter(|step| !step.is_empty()) {
        let found = match step.strip_suffix(']').and_then(|index| index.parse().ok()) {
            Some(index) => scanner.enter_list(index),
            None => scanner.enter_object(step),
        };
        if found.is_none() {
            break;
        }
        place = scanner.at;
    }
    line_and_column(text, place)
}

/// Reads JSON or JSON5 that is known to be sound: it looks for places and judges nothing.
struct Scanner<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Scanner<'a> {
    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn next(&mut self) -> Option<char> {
        let c = self.rest().chars().next()?;
        self.at += c.len_utf8();
        Some(c)
    }

    /// Moves past white space and comments.
    fn skip_space(&mut self) {
        loop {
            let rest = self.rest();
            let length = match rest {
                _ if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
                _ if rest.starts_with("/*") => rest.find("*/").map_or(rest.len(), |end| end + 2),
                _ => {
                    rest.len() - rest.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}').len()
                }
            };
            if length == 0 {
                return;
            }
            self.at += length;
        }
    }

    /// Moves past a string, number or word; returns it without quotes.
    fn skip_word(&mut self) -> &'a str {
        let start = self.at;
        match self.next() {
            Some(quote @ ('"' | '\'')) => {
                while let Some(c) = self.next() {
                    match c {
                        '\\' => _ = self.next(),
                        _ if c == quote => break,
                        _ => {}
                    }
                }
                self.text.get(start + 1..self.at.saturating_sub(1)).unwrap_or_default()
            }
            _ => {
                let ends = |c: char| c.is_whitespace() || "{}[],:/".contains(c);
                self.at += self.rest().find(ends).unwrap_or(self.rest().len());
                self.text.get(start..self.at).unwrap_or_default()
            }
        }
    }

    /// Moves past a value, without recursion.
    fn skip_value(&mut self) {
        let mut depth = 0;
        loop {
            self.skip_space();
            match self.rest().chars().next() {
                None => return,
                Some('{' | '[') => {
                    depth += 1;
                    self.at += 1;
                }
                Some('}' | ']') => {
                    depth -= 1;
                    self.at += 1;
                }
                Some(',' | ':') => self.at += 1,
                Some(_) => _ = self.skip_word(),
            }
            if depth <= 0 {
                return;
            }
        }
    }

    /// Moves to the item of a list.
    fn enter_list(&mut self, index: usize) -> Option<()> {
        let start = self.at;
        self.enter('[')?;
        for _ in 0..index {
            self.skip_value();
            self.skip_space();
            if !self.rest().starts_with(',') {
                self.at = start;
                return None;
            }
            self.at += 1;
            self.skip_space();
        }
        if self.rest().starts_with(']') {
            self.at = start;
            return None;
        }
        Some(())
    }

    /// Moves to the value of a key.
    fn enter_object(&mut self, key: &str) -> Option<()> {
        let start = self.at;
        self.enter('{')?;
        while !self.rest().is_empty() && !self.rest().starts_with('}') {
            let is_it = self.skip_word() == key;
            self.skip_space();
            self.at += usize::from(self.rest().starts_with(':'));
            self.skip_space();
            if is_it {
                return Some(());
            }
            self.skip_value();
            self.skip_space();
            self.at += usize::from(self.rest().starts_with(','));
            self.skip_space();
        }
        self.at = start;
        None
    }

    fn enter(&mut self, bracket: char) -> Option<()> {
        if !self.rest().starts_with(bracket) {
            return None;
        }
        self.at += 1;
        self.skip_space();
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str, path: &str) -> String {
        let (line, column) = locate(text, Format::Json5, path);
        let line = text.lines().nth(line - 1).expect("the line is there");
        line.chars().skip(column - 1).collect()
    }

    #[test]
    fn values_are_found_by_their_paths() {
        let text = "// {\"bodies\": 1}\n{ \"name\": \"a, \\\"b\\\": {[\",\n bodies: [ {rigid: {mass: 1,},},\n {'cloth': /* [ */ {size: [1, -2, 3e5], \"mass\": -1}}]}";
        assert_eq!(found(text, "bodies[1].cloth.mass"), "-1}}]}");
        assert_eq!(found(text, "bodies[0].rigid.mass"), "1,},},");
        assert_eq!(found(text, "bodies[1].cloth.size[2]"), "3e5], \"mass\": -1}}]}");
        assert_eq!(found(text, "name"), "\"a, \\\"b\\\": {[\",");
    }

    #[test]
    fn what_is_not_there_is_found_as_far_as_it_goes() {
        let text = "{\"bodies\": [{\"rigid\": {\"shape\": {}}}]}";
        assert_eq!(found(text, "bodies[0].rigid.mass"), "{\"shape\": {}}}]}");
        assert_eq!(found(text, "bodies[7].rigid"), "[{\"rigid\": {\"shape\": {}}}]}");
        assert_eq!(found(text, ""), text);
        assert_eq!(found("{\"a\": [1, 2", "a[5]"), "[1, 2");
    }

    #[test]
    fn texts_cut_off_anywhere_end_the_search() {
        let text = "{ bodies: [ {rigid: {mass: '\\'', }, }, /* */ // \n {a: \"\\\\\"} ] }";
        for end in 0..=text.len() {
            for path in ["bodies[1].a", "bodies[0].rigid.mass[3]", "x"] {
                locate(&text[..end], Format::Json5, path);
            }
        }
    }
}
