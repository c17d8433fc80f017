//! The paths that a source text names, each resolved to the module or the crate that it means.

/// A path from the root: `["crate", "sim", "real", "Real"]`, or one that starts with the name of another crate.
pub(crate) type Path = Vec<String>;

/// All paths that the code of `text` names, tests apart; `module` is the file's own, without `crate`.
///
/// `use` trees are taken apart, `self` and `super` are resolved, in modules within the file too. Comments, literals and items
/// under `#[cfg(test)]` are skipped, and so are the modules that `pub(in …)` shows an item to.
pub(crate) fn named(text: &str, module: &[&str]) -> Vec<Path> {
    let code = without_tests(&bare(text));
    let tokens = tokens(&code);
    let mut reader = Reader { tokens: &tokens, at: 0, found: Vec::new() };
    reader.block(&module.iter().map(|&name| name.to_owned()).collect::<Vec<_>>());
    reader.found
}

/// The text with blanks in the place of comments and literals.
pub(crate) fn bare(text: &str) -> String {
    let list: Vec<char> = text.chars().collect();
    let mut kept = String::with_capacity(text.len());
    let mut at = 0;
    while at < list.len() {
        let end = end_of_bare(&list, at);
        let skipped = &list[at..end];
        if skipped.is_empty() {
            kept.push(list[at]);
            at += 1;
        } else {
            kept.extend(skipped.iter().map(|&c| if c == '\n' { '\n' } else { ' ' }));
            at = end;
        }
    }
    kept
}

/// Where a comment or a literal that starts at `at` ends; `at` if none starts there.
fn end_of_bare(list: &[char], at: usize) -> usize {
    let starts = |word: &str, from: usize| word.chars().enumerate().all(|(k, c)| list.get(from + k) == Some(&c));
    let find = |word: &str, from: usize| (from..list.len()).find(|&k| starts(word, k));
    let after_name = at > 0 && is_name(list[at - 1]);
    match list[at] {
        '/' if starts("//", at) => find("\n", at).unwrap_or(list.len()),
        '/' if starts("/*", at) => {
            let (mut depth, mut end) = (1, at + 2);
            while depth > 0 && end < list.len() {
                let step = if starts("/*", end) {
                    (1, 2)
                } else if starts("*/", end) {
                    (-1, 2)
                } else {
                    (0, 1)
                };
                (depth, end) = (depth + step.0, end + step.1);
            }
            end
        }
        'r' if !after_name || list[at - 1] == 'b' && (at < 2 || !is_name(list[at - 2])) => {
            let marks = list[at + 1..].iter().take_while(|&&c| c == '#').count();
            if list.get(at + 1 + marks) != Some(&'"') {
                return at;
            }
            let close = format!("\"{}", "#".repeat(marks));
            find(&close, at + 2 + marks).map_or(list.len(), |end| end + 1 + marks)
        }
        '"' => end_of_quoted(list, at, '"'),
        // A lifetime has no second quote right after its first letter.
        '\'' if list.get(at + 1) == Some(&'\\') || list.get(at + 2) == Some(&'\'') => end_of_quoted(list, at, '\''),
        _ => at,
    }
}

fn end_of_quoted(list: &[char], at: usize, quote: char) -> usize {
    let mut end = at + 1;
    while end < list.len() && list[end] != quote {
        end += if list[end] == '\\' { 2 } else { 1 };
    }
    (end + 1).min(list.len())
}

/// Bare code without the items that `#[cfg(test)]` stands before: up to the end of their braces, or their semicolon.
pub(crate) fn without_tests(code: &str) -> String {
    const MARK: &str = "#[cfg(test)]";
    let (mut kept, mut rest) = (String::with_capacity(code.len()), code);
    while let Some(at) = rest.find(MARK) {
        kept.push_str(&rest[..at]);
        rest = &rest[at + MARK.len()..];
        let mut depth = 0;
        let end = rest.char_indices().find(|&(_, c)| {
            depth += i32::from(c == '{') - i32::from(c == '}');
            depth == 0 && matches!(c, ';' | '}')
        });
        rest = end.map_or("", |(end, _)| &rest[end + 1..]);
    }
    kept + rest
}

fn is_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Names, `::` and single other characters.
fn tokens(code: &str) -> Vec<&str> {
    let (mut list, mut rest) = (Vec::new(), code.trim_start());
    while let Some(first) = rest.chars().next() {
        let name = rest.find(|c| !is_name(c)).unwrap_or(rest.len());
        let length = if name > 0 {
            name
        } else if rest.starts_with("::") {
            2
        } else {
            first.len_utf8()
        };
        list.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    list
}

struct Reader<'a> {
    tokens: &'a [&'a str],
    at: usize,
    found: Vec<Path>,
}

impl Reader<'_> {
    fn peek(&self, ahead: usize) -> &str {
        self.tokens.get(self.at + ahead).copied().unwrap_or("")
    }

    fn is_name(&self, ahead: usize) -> bool {
        self.peek(ahead).starts_with(is_name)
    }

    /// Reads what is between two braces, or the whole text.
    fn block(&mut self, module: &[String]) {
        while self.at < self.tokens.len() {
            match self.peek(0) {
                "}" => return self.at += 1,
                "{" => {
                    self.at += 1;
                    self.block(module);
                }
                "mod" if self.is_name(1) && self.peek(2) == "{" => {
                    let inner = [module, &[self.peek(1).to_owned()]].concat();
                    self.at += 3;
                    self.block(&inner);
                }
                "in" if self.at > 1 && self.tokens[self.at - 2..self.at] == ["pub", "("] => {
                    while !matches!(self.peek(0), ")" | "") {
                        self.at += 1;
                    }
                }
                "use" => {
                    self.at += 1;
                    self.tree(&[], module, true);
                }
                "::" if self.at > 0 && ends_a_path(self.tokens[self.at - 1]) => self.at += 2,
                _ if self.is_name(0) && self.peek(1) == "::" || self.peek(0) == "::" => self.tree(&[], module, false),
                _ => self.at += 1,
            }
        }
    }

    /// Reads one path, with all that a group in braces adds to it; in a `use`, with the name that it is given.
    fn tree(&mut self, before: &[String], module: &[String], is_use: bool) {
        let mut path = before.to_vec();
        self.at += usize::from(self.peek(0) == "::");
        while self.is_name(0) || self.peek(0) == "*" && !path.is_empty() {
            path.push(self.peek(0).to_owned());
            self.at += 1;
            if self.peek(0) != "::" {
                break;
            }
            self.at += 1;
        }
        if self.peek(0) == "{" && is_use {
            return self.group(&path, module);
        }
        if path.len() == before.len() {
            // Nothing that a path is made of.
            self.at += 1;
            return;
        }
        if self.peek(0) == "as" && is_use {
            self.at += 2;
        }
        self.found.push(resolved(&path, module));
    }

    /// Reads the group of a `use` tree, from its first brace to its last.
    fn group(&mut self, before: &[String], module: &[String]) {
        self.at += 1;
        while !matches!(self.peek(0), "}" | "") {
            match self.peek(0) {
                "," => self.at += 1,
                _ => self.tree(before, module, true),
            }
        }
        self.at += 1;
    }
}

fn ends_a_path(token: &str) -> bool {
    token == ">" || token.starts_with(is_name)
}

/// The path from the root. One that begins with another name is left as it is: a crate, or what is named in the file itself.
fn resolved(path: &[String], module: &[String]) -> Path {
    let mut place = vec!["crate".to_owned()];
    let rest = match path[0].as_str() {
        "crate" => &path[1..],
        "self" | "super" => {
            place.extend_from_slice(module);
            let up = path.iter().take_while(|name| matches!(name.as_str(), "self" | "super")).count();
            let supers = path[..up].iter().filter(|name| *name == "super").count();
            place.truncate(place.len().saturating_sub(supers).max(1));
            &path[up..]
        }
        _ => return path.to_vec(),
    };
    place.extend(rest.iter().filter(|name| *name != "self").cloned());
    place
}
