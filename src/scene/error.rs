//! What is wrong with a scene: file, line, key, and the cure, in one line.

use std::fmt;

use jsonc_parser::ast::Value;

/// A scene that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// The file, or the name of a gallery scene.
    pub label: String,
    /// Line in the file, from 1, where it is known.
    pub line: Option<usize>,
    /// The key, such as `bonds[3].a`; empty: the scene as a whole.
    pub path: String,
    /// What is wrong and what to do.
    pub problem: String,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.label)?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        write!(f, ": ")?;
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        write!(f, "{}", self.problem)
    }
}

impl std::error::Error for SceneError {}

/// Something wrong at a key, before it is known in which file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Problem {
    pub(crate) path: String,
    pub(crate) problem: String,
}

impl Problem {
    pub(crate) fn new(path: impl Into<String>, problem: impl Into<String>) -> Self {
        Problem { path: path.into(), problem: problem.into() }
    }

    /// The same problem seen from outside: `prefix` comes before its key.
    pub(crate) fn within(self, prefix: impl fmt::Display) -> Self {
        let path = match self.path.as_str() {
            "" => prefix.to_string(),
            path if path.starts_with('[') => format!("{prefix}{path}"),
            path => format!("{prefix}.{path}"),
        };
        Problem { path, ..self }
    }

    /// The error, with the line of the key looked up in the file's text.
    pub(crate) fn at(self, label: &str, text: Option<&str>) -> SceneError {
        let line = text.and_then(|text| line_of(text, &self.path));
        SceneError { label: label.to_owned(), line, path: self.path, problem: self.problem }
    }
}

/// Line, from 1, of the value at `path` in a JSON text: of the nearest enclosing value where the key is missing.
fn line_of(text: &str, path: &str) -> Option<usize> {
    let parsed = jsonc_parser::parse_to_ast(text, &Default::default(), &Default::default()).ok()?;
    let mut value = parsed.value.as_ref()?;
    let mut offset = start(value);
    for step in path.split(['.', '[']).filter(|step| !step.is_empty()) {
        let next = match (step.strip_suffix(']'), value) {
            (Some(index), Value::Array(array)) => array.elements.get(index.parse::<usize>().ok()?),
            (None, Value::Object(object)) => object.get(step).map(|property| &property.value),
            _ => None,
        };
        let Some(found) = next else { break };
        value = found;
        offset = start(value);
    }
    Some(1 + text.as_bytes()[..offset].iter().filter(|&&byte| byte == b'\n').count())
}

fn start(value: &Value<'_>) -> usize {
    jsonc_parser::common::Ranged::range(value).start
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "{\n \"a\": 1,\n \"b\": [\n  {\"c\": 2},\n  {\"c\":\n   3}\n ]\n}";

    #[test]
    fn keys_have_lines() {
        assert_eq!(line_of(TEXT, "a"), Some(2));
        assert_eq!(line_of(TEXT, "b[0].c"), Some(4));
        assert_eq!(line_of(TEXT, "b[1].c"), Some(6));
        assert_eq!(line_of(TEXT, "b[1].missing"), Some(5));
        assert_eq!(line_of(TEXT, ""), Some(1));
        assert_eq!(line_of("{", "a"), None);
    }

    #[test]
    fn an_error_is_one_line() {
        let problem = Problem::new("a", "is odd").within("bonds[3]");
        assert_eq!(problem.at("x.json", None).to_string(), "x.json: bonds[3].a: is odd");
        assert_eq!(Problem::new("[1]", "is odd").within("samples").path, "samples[1]");
    }
}
