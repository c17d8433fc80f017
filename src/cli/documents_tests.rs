//! Calls that README and docs print are calls that the program takes.

use std::path::{Path, PathBuf};

use clap::CommandFactory;
use clap::error::ErrorKind;

use super::Call;
use crate::scene::gallery;

/// The pages whose calls are tried.
fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let docs = std::fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let mut pages: Vec<PathBuf> = docs.chain(["README.md", "CONTRIBUTING.md"].map(|name| root.join(name))).collect();
    pages.sort();
    pages
}

/// The words of a call, after its program; a comment stands two spaces away.
fn words_of(line: &str) -> Option<Vec<&str>> {
    let rest = ["wobble", "scripts/run"].into_iter().find_map(|program| line.strip_prefix(program))?;
    let is_word = rest.is_empty() || rest.starts_with(' ');
    let call = if rest.starts_with("  ") { "" } else { rest.split("  ").next().unwrap_or_default() };
    is_word.then(|| call.split_whitespace().collect())
}

/// Errors: what is wrong with a call; whether it is a whole one, with all that it needs.
fn check(words: &[&str], is_whole: bool) -> Result<(), String> {
    let found = match Call::command().try_get_matches_from([&["wobble"][..], words].concat()) {
        Ok(found) => found,
        Err(error) => match error.kind() {
            ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => return Ok(()),
            ErrorKind::MissingRequiredArgument | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand if !is_whole => {
                return Ok(());
            }
            _ => return Err(error.to_string()),
        },
    };
    let of = found.subcommand().map_or(&found, |(_, inner)| inner);
    // A file has an ending; what has none is of the gallery.
    let scene = of.try_get_one::<String>("scene").ok().flatten();
    match scene.filter(|scene| !scene.contains('.') && !gallery().iter().any(|entry| entry.name == **scene)) {
        Some(scene) => Err(format!("{scene} is not in the gallery")),
        None => Ok(()),
    }
}

#[test]
fn calls_are_told_from_comments() {
    assert_eq!(words_of("wobble           the jelly"), Some(vec![]));
    assert_eq!(words_of("wobble scenes    the gallery"), Some(vec!["scenes"]));
    assert_eq!(words_of("scripts/run mesh x.png --stats"), Some(vec!["mesh", "x.png", "--stats"]));
    assert_eq!(words_of("wobbles"), None);
    assert!(check(&["render", "rim", "--out", "x.png"], true).is_ok());
    assert!(check(&["render", "rim"], true).is_err() && check(&["render", "rim"], false).is_ok());
    assert!(check(&["render", "rimm", "--out", "x.png"], true).unwrap_err().contains("rimm"));
    assert!(check(&["render", "rim", "--outt", "x.png"], false).is_err());
}

#[test]
fn calls_of_the_docs_are_calls() {
    let mut found = 0;
    for page in pages() {
        let text = std::fs::read_to_string(&page).unwrap();
        for (index, part) in text.split("```").enumerate() {
            let is_block = index % 2 == 1;
            let calls: Vec<&str> =
                if is_block { part.lines().collect() } else { part.split('`').skip(1).step_by(2).collect() };
            for words in calls.into_iter().filter_map(words_of) {
                // In a sentence FILE, N and … stand for what the reader fills in.
                let is_open = |word: &&str| word.chars().all(|c| c.is_uppercase()) || word.contains('…');
                if is_block || !words.iter().any(is_open) {
                    check(&words, is_block).unwrap_or_else(|error| panic!("{}: {words:?}: {error}", page.display()));
                    found += 1;
                }
            }
        }
    }
    assert!(found > 60, "{found} calls");
}
