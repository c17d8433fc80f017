//! What can be wrong with a scene, and how it is said: one line with file, line, key, fault and cure.

use std::fmt;
use std::sync::Arc;

use super::locate;
use super::pictures::Pictures;
use crate::picture::Watch;

/// Largest text that a scene keeps to say lines by after it was read `[bytes]`: 16 MiB. A larger one is reported by its
/// keys alone once it has been read; kept, it would cost its length in memory for a message that may never come.
const KEPT_TEXT: usize = 16 << 20;

/// Longest message `[bytes]`: a wrong word of the file is quoted, and may be as long as the file.
const LONGEST_MESSAGE: usize = 400;

/// Where a scene came from. Two scenes that differ in nothing else are equal.
#[derive(Clone, Debug, Default)]
pub struct Source {
    /// The file, or what stands for it in messages.
    pub(super) label: String,
    pub(super) text: Option<Arc<str>>,
    /// What was read of the pictures that it names.
    pub(super) pictures: Pictures,
    /// Whoever waits for its meshes.
    pub(super) watch: Watch,
}

impl PartialEq for Source {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Source {
    /// A source that keeps the text, if it is not too long.
    pub(super) fn new(label: &str, text: &str) -> Self {
        let text = (text.len() <= KEPT_TEXT).then(|| text.into());
        Source { label: label.to_owned(), text, pictures: Pictures::default(), watch: Watch::default() }
    }

    /// The error that a fault in this scene is.
    pub(super) fn error(&self, fault: Fault) -> SceneError {
        let text = self.text.as_deref();
        fault.into_error(&self.label, text)
    }
}

/// What sort of thing went wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneErrorKind {
    /// There is no such file, and no scene of that name in the gallery.
    NotFound,
    /// The file could not be read or written.
    File,
    /// The text is not JSON.
    Syntax,
    /// A key, a type or a value that a scene cannot have.
    Invalid,
    /// A scene in order that this version cannot run.
    Unsupported,
}

/// One line that says where a scene is wrong, what is wrong there and what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct SceneError {
    /// What sort of thing went wrong.
    pub kind: SceneErrorKind,
    /// The file, or what stands for it.
    pub label: String,
    /// The line in it, from 1, where it is known.
    pub line: Option<usize>,
    /// The path of keys to the place, such as `bonds[3].a`; empty for the whole.
    pub key: String,
    /// What is wrong and what to do.
    pub message: String,
}

impl SceneError {
    /// An error about the whole file.
    pub(super) fn whole(kind: SceneErrorKind, label: &str, message: impl Into<String>) -> Self {
        SceneError { kind, label: label.to_owned(), line: None, key: String::new(), message: message.into() }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut line = String::new();
        if !self.label.is_empty() {
            line.push_str(&self.label);
            if let Some(number) = self.line {
                line.push_str(&format!(":{number}"));
            }
            line.push_str(": ");
        }
        if !self.key.is_empty() {
            line.push_str(&self.key);
            line.push_str(": ");
        }
        line.push_str(&self.message);
        f.write_str(&printable(&line))
    }
}

/// The text on one line: control characters are spelled out, and it is cut where it gets too long.
fn printable(text: &str) -> String {
    let mut line = String::new();
    for c in text.chars() {
        if line.len() > LONGEST_MESSAGE {
            line.push('…');
            break;
        }
        if c.is_control() {
            line.extend(c.escape_default());
        } else {
            line.push(c);
        }
    }
    line
}

/// One step of the path to a place in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// Into an object.
    Key(String),
    /// Into a list.
    Index(usize),
}

/// "bonds\[3\].a".
pub(super) fn path_name(path: &[Step]) -> String {
    let mut name = String::new();
    for step in path {
        match step {
            Step::Key(key) if name.is_empty() => name.push_str(key),
            Step::Key(key) => {
                name.push('.');
                name.push_str(key);
            }
            Step::Index(index) => name.push_str(&format!("[{index}]")),
        }
    }
    name
}

/// Something wrong at a place of a scene; the file is not known yet.
#[derive(Debug)]
pub(super) struct Fault {
    kind: SceneErrorKind,
    /// From the place outwards: every caller adds its own step.
    outwards: Vec<Step>,
    message: String,
}

impl Fault {
    /// A value that a scene cannot have.
    pub(super) fn invalid(message: impl Into<String>) -> Self {
        Fault { kind: SceneErrorKind::Invalid, outwards: Vec::new(), message: message.into() }
    }

    /// Something that this version cannot run.
    pub(super) fn unsupported(message: impl Into<String>) -> Self {
        Fault { kind: SceneErrorKind::Unsupported, ..Fault::invalid(message) }
    }

    /// The same fault, seen from the object that holds the key.
    pub(super) fn at(mut self, key: &str) -> Self {
        self.outwards.push(Step::Key(key.to_owned()));
        self
    }

    /// The same fault, seen from the list that holds the item.
    pub(super) fn item(mut self, index: usize) -> Self {
        self.outwards.push(Step::Index(index));
        self
    }

    /// The same fault of something that has a name.
    pub(super) fn of(self, name: &str) -> Self {
        Fault { message: format!("`{name}`: {}", self.message), ..self }
    }

    /// The same fault, whose place is in what this scene stands for.
    pub(super) fn elsewhere(self) -> Self {
        let path: Vec<Step> = self.outwards.into_iter().rev().collect();
        let message = if path.is_empty() { self.message } else { format!("{}: {}", path_name(&path), self.message) };
        Fault { kind: self.kind, outwards: Vec::new(), message }
    }

    /// What is wrong.
    pub(super) fn message(&self) -> &str {
        &self.message
    }

    /// Whether it is in an item of this list.
    pub(super) fn is_in(&self, list: &str) -> bool {
        matches!(self.outwards.last(), Some(Step::Key(key)) if key == list)
    }

    /// The error with file and, where the text is there, line.
    pub(super) fn into_error(self, label: &str, text: Option<&str>) -> SceneError {
        let path: Vec<Step> = self.outwards.into_iter().rev().collect();
        SceneError {
            kind: self.kind,
            label: label.to_owned(),
            line: text.and_then(|text| locate::line_of(text, &path)),
            key: path_name(&path),
            message: self.message,
        }
    }
}

/// Says where a result comes from.
pub(super) trait Within {
    /// From this key.
    fn at(self, key: &str) -> Self;
    /// From this item of a list.
    fn item(self, index: usize) -> Self;
}

impl<T> Within for Result<T, Fault> {
    fn at(self, key: &str) -> Self {
        self.map_err(|fault| fault.at(key))
    }

    fn item(self, index: usize) -> Self {
        self.map_err(|fault| fault.item(index))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_becomes_one_line_with_its_place() {
        let fault = Fault::invalid("is 5: use 4").at("a").item(1).at("bonds");
        let text = "{\n\"bonds\": [ {},\n {\n \"a\": 5 } ] }";
        let error = fault.into_error("x.json", Some(text));
        assert_eq!(error.to_string(), "x.json:4: bonds[1].a: is 5: use 4");
    }

    #[test]
    fn a_message_stays_one_short_line() {
        let nasty = SceneError::whole(SceneErrorKind::Invalid, "x.json", format!("a\nb\u{1b}[31m{}", "é".repeat(5000)));
        let line = nasty.to_string();
        assert!(line.starts_with("x.json: a\\nb\\u{1b}[31mé"));
        assert!(line.len() < 500 && !line.chars().any(char::is_control));
    }
}
