//! How many things there are, as one says it.

/// "no point", "1 point", "2 points".
pub(super) fn counted(count: usize, name: &str) -> String {
    match count {
        0 => format!("no {name}"),
        1 => format!("1 {name}"),
        _ => match name.strip_suffix("dy") {
            Some(stem) => format!("{count} {stem}dies"),
            None => format!("{count} {name}s"),
        },
    }
}

/// "950", "16,000".
pub(super) fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let parts: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().filter_map(|part| std::str::from_utf8(part).ok()).collect();
    parts.join(",")
}

#[cfg(test)]
mod tests {
    use super::{counted, grouped};

    #[test]
    fn thousands_are_parted() {
        assert_eq!([0, 950, 16_000, 1_234_567].map(grouped), ["0", "950", "16,000", "1,234,567"]);
    }

    #[test]
    fn one_is_no_plural() {
        assert_eq!([0, 1, 2].map(|count| counted(count, "bond")), ["no bond", "1 bond", "2 bonds"]);
        assert_eq!([1, 3].map(|count| counted(count, "body")), ["1 body", "3 bodies"]);
    }
}
