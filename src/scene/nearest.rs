//! The name that was probably meant.

/// The candidate that `text` is a slip of, if one is near enough: a third of its letters at most are wrong.
pub(crate) fn nearest<'a>(text: &str, candidates: &[&'a str]) -> Option<&'a str> {
    // Longer words are no slip of a name here, and the distance grows with the square of the length.
    const LONGEST: usize = 64;
    if text.len() > LONGEST {
        return None;
    }
    candidates
        .iter()
        .map(|candidate| (distance(text, candidate), *candidate))
        .filter(|(distance, candidate)| 3 * distance <= candidate.len().max(3) && *distance < candidate.len())
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// One line that says that `text` is not one of the names of `what`, and what to write.
pub(super) fn unknown(what: &str, text: &str, names: &[&str]) -> String {
    match nearest(text, names) {
        Some(name) => format!("`{text}` is not {what}: did you mean `{name}`?"),
        None => format!("`{text}` is not {what}: use {}", list(names)),
    }
}

/// "`a`, `b` or `c`".
pub(super) fn list(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => quoted.concat(),
    }
}

/// Letters to add, remove, replace or swap with their neighbour to get from one word to the other.
///
/// Source: optimal string alignment, after F. J. Damerau, "A technique for computer detection and correction of
/// spelling errors", CACM 7 (1964).
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let same = a[i - 1] == b[j - 1];
            let mut least = (above[j] + 1).min(row[j - 1] + 1).min(above[j - 1] + usize::from(!same));
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                let swapped: &[usize] = &before;
                least = least.min(swapped[j - 2] + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognised_and_strangers_are_not() {
        let names = ["points", "random-graph", "rim", "rim-relaxed"];
        for (slip, meant) in [
            ("rimm", "rim"),
            ("rmi", "rim"),
            ("point", "points"),
            ("random_graph", "random-graph"),
            ("rim-relxaed", "rim-relaxed"),
        ] {
            assert_eq!(nearest(slip, &names), Some(meant), "{slip}");
        }
        assert_eq!(nearest("spaghetti", &names), None);
        assert_eq!(nearest("", &names), None);
        assert_eq!(nearest("c", &["a", "b"]), None);
        assert_eq!(nearest(&"x".repeat(100_000), &names), None);
    }

    #[test]
    fn lists_read_as_a_sentence() {
        assert_eq!(list(&["a"]), "`a`");
        assert_eq!(list(&["a", "b", "c"]), "`a`, `b` or `c`");
        assert_eq!(unknown("a kind", "zzz", &["x", "y"]), "`zzz` is not a kind: use `x` or `y`");
    }
}
