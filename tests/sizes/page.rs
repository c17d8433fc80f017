//! The table of sizes on its page.

/// A row of it.
pub(crate) struct Row {
    pub(crate) name: String,
    pub(crate) value: f64,
    /// Of the coarser of both methods, where both can be used `[m]`.
    pub(crate) error: f64,
    /// Counted work just above, in that just below.
    pub(crate) work: f64,
}

fn text(path: &str) -> String {
    std::fs::read_to_string(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

/// The rows of the page.
pub(crate) fn rows() -> Vec<Row> {
    text("docs/sizes.md").lines().filter_map(read).collect()
}

/// The row of a size.
pub(crate) fn row(name: &str) -> Row {
    rows().into_iter().find(|row| row.name == name).unwrap_or_else(|| panic!("docs/sizes.md has no row of {name}"))
}

fn read(line: &str) -> Option<Row> {
    let cells: Vec<&str> = line.split('|').map(str::trim).collect();
    let [_, name, value, _, _, error, work, _, _] = cells[..] else { return None };
    let name = name.strip_prefix('`')?.strip_suffix('`')?.to_owned();
    let number = |text: &str| text.replace(',', "").parse().unwrap_or(0.0);
    Some(Row { name, value: number(value), error: number(error), work: number(work) })
}

/// The numbers that the code has.
fn constants() -> Vec<(String, f64)> {
    let of = |line: &str| {
        let (name, rest) = line.strip_prefix("pub const ")?.split_once(':')?;
        let value = rest.split_once('=')?.1.trim().trim_end_matches(';').replace('_', "");
        Some((name.to_owned(), value.parse().unwrap()))
    };
    text("src/sim/sizes.rs").lines().filter_map(of).collect()
}

#[test]
fn the_page_has_every_size_as_the_code_has_it() {
    let mut of_code = constants();
    let mut of_page: Vec<(String, f64)> = rows().into_iter().map(|row| (row.name, row.value)).collect();
    of_code.sort_by(|a, b| a.0.cmp(&b.0));
    of_page.sort_by(|a, b| a.0.cmp(&b.0));
    assert_eq!(of_code, of_page);
}
