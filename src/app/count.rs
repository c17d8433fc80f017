//! How many things there are, as one says it.

/// "no point", "1 point", "2 points".
pub(super) fn counted(count: usize, name: &str) -> String {
    match count {
        0 => format!("no {name}"),
        1 => format!("1 {name}"),
        _ => format!("{count} {name}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::counted;

    #[test]
    fn one_is_no_plural() {
        assert_eq!([0, 1, 2].map(|count| counted(count, "bond")), ["no bond", "1 bond", "2 bonds"]);
    }
}
