//! Finds the line of a place in a scene's text. Runs only once something is wrong, keeps nothing, and takes texts of
//! any length: a syntax tree of a large scene would be many times its size.

use super::error::Step;

/// The line, from 1, of the place that `path` leads to, or of the last step on the way that is there.
///
/// `None` where not even the first step is found. The text need not be JSON: what cannot be followed ends the way.
pub(super) fn line_of(text: &str, path: &[Step]) -> Option<usize> {
    let mut scan = Scan { text: text.as_bytes(), at: 0 };
    let mut found = None;
    for step in path {
        let place = match step {
            Step::Key(key) => scan.enter_key(key),
            Step::Index(index) => scan.enter_item(*index),
        };
        match place {
            Some(place) => found = Some(place),
            None => break,
        }
    }
    found.map(|place| 1 + text.as_bytes()[..place].iter().filter(|&&c| c == b'\n').count())
}

/// A place in a text that is taken for JSON.
struct Scan<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Scan<'a> {
    /// The next byte that is no white space; not passed.
    fn peek(&mut self) -> Option<u8> {
        while self.text.get(self.at)?.is_ascii_whitespace() {
            self.at += 1;
        }
        self.text.get(self.at).copied()
    }

    /// Passes this byte, or finds another.
    fn expect(&mut self, byte: u8) -> Option<()> {
        (self.peek()? == byte).then(|| self.at += 1)
    }

    /// Moves from an object to the value of its key; the place of the key itself.
    fn enter_key(&mut self, key: &str) -> Option<usize> {
        self.expect(b'{')?;
        loop {
            self.peek()?;
            let place = self.at;
            let found = self.string()?;
            self.expect(b':')?;
            if found == key.as_bytes() {
                return Some(place);
            }
            self.skip_value()?;
            self.expect(b',')?;
        }
    }

    /// Moves from a list to its item; the place of the item.
    fn enter_item(&mut self, index: usize) -> Option<usize> {
        self.expect(b'[')?;
        for _ in 0..index {
            self.skip_value()?;
            self.expect(b',')?;
        }
        self.peek()?;
        Some(self.at)
    }

    /// Passes a string; what stands between the quotes, escapes as they are.
    fn string(&mut self) -> Option<&'a [u8]> {
        self.expect(b'"')?;
        let start = self.at;
        loop {
            match self.text.get(self.at)? {
                b'"' => break,
                b'\\' => self.at += 2,
                _ => self.at += 1,
            }
        }
        self.at += 1;
        Some(&self.text[start..self.at - 1])
    }

    /// Passes a value, whatever it is.
    fn skip_value(&mut self) -> Option<()> {
        let mut depth = 0_usize;
        loop {
            match self.peek()? {
                b'"' => {
                    self.string()?;
                }
                b'{' | b'[' => {
                    depth += 1;
                    self.at += 1;
                }
                b'}' | b']' => {
                    depth = depth.checked_sub(1)?;
                    self.at += 1;
                }
                b',' | b':' if depth > 0 => {
                    self.at += 1;
                    continue;
                }
                _ => self.word()?,
            }
            if depth == 0 {
                return Some(());
            }
        }
    }

    /// Passes a number, `true`, `false` or `null`: at least one byte.
    fn word(&mut self) -> Option<()> {
        let start = self.at;
        while let Some(c) = self.text.get(self.at) {
            if b"{}[],:\"".contains(c) || c.is_ascii_whitespace() {
                break;
            }
            self.at += 1;
        }
        (self.at > start).then_some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(name: &str) -> Step {
        Step::Key(name.to_owned())
    }

    #[test]
    fn places_are_found_through_strings_lists_and_objects() {
        let text = "{ \"a\": \"}\\\"]\",\n\"b\": [ [1, 2],\n {\"c\": -1e5, \"d\": {\n\"e\": null}}\n, 7 ] }";
        let line = |path: &[Step]| line_of(text, path);
        assert_eq!(line(&[key("a")]), Some(1));
        assert_eq!(line(&[key("b"), Step::Index(0), Step::Index(1)]), Some(2));
        assert_eq!(line(&[key("b"), Step::Index(1), key("c")]), Some(3));
        assert_eq!(line(&[key("b"), Step::Index(1), key("d"), key("e")]), Some(4));
        assert_eq!(line(&[key("b"), Step::Index(2)]), Some(5));
    }

    #[test]
    fn a_missing_step_leaves_the_last_one_found() {
        let text = "{\n\"a\": {\n\"b\": 1 } }";
        assert_eq!(line_of(text, &[key("a"), key("x")]), Some(2));
        assert_eq!(line_of(text, &[key("x")]), None);
        assert_eq!(line_of(text, &[key("a"), Step::Index(4)]), Some(2));
        assert_eq!(line_of(text, &[]), None);
    }

    #[test]
    fn broken_texts_end_the_way() {
        for text in ["", "{", "{\"", "{\"a\\", "{\"a\":", "{\"b\":]", "[[[[", "{\"b\":}"] {
            assert_eq!(line_of(text, &[key("a"), key("b")]).unwrap_or(1), 1);
        }
    }
}
