//! What the meter says of the scenes that version 0.1.0 did not bear.

use std::path::Path;

use wobble::history::Start;
use wobble::study::stability::{Bounds, Ended, Fault, Subject, judge};

/// A scene of `tests/files/abuse`, as `tests/files/abuse/judged.json` has it.
#[derive(serde::Deserialize)]
struct Judged {
    file: String,
    /// What was wrong with it, in words.
    was: String,
    /// The names of its faults now.
    now: Vec<String>,
    /// It takes more than a few seconds.
    #[serde(default)]
    is_dear: bool,
}

fn check(dear: bool) {
    let list: Vec<Judged> = serde_json::from_str(include_str!("../files/abuse/judged.json")).unwrap();
    let mut wrong = Vec::new();
    for Judged { file, was, now, .. } in list.into_iter().filter(|judged| judged.is_dear == dear) {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/abuse").join(&file);
        let subject = Subject::of_start(&Start::load(path.to_str().unwrap()).unwrap());
        let found = judge(&subject, Bounds { work: 2.0, seconds: 300.0 }).found;
        assert!(matches!(found.ended, Ended::Done), "{file}: {:?}", found.ended);
        let names: Vec<&str> = found.faults.iter().map(|fault: &Fault| fault.name()).collect();
        if names != now {
            wrong.push(format!("{file} ({was}): {names:?}, not {now:?}"));
        }
    }
    assert!(wrong.is_empty(), "the list is of another version:\n{}", wrong.join("\n"));
}

#[test]
fn scenes_that_0_1_0_did_not_bear_have_the_faults_that_are_listed() {
    check(false);
}

#[test]
#[ignore = "takes a minute: large bodies at 200 m/s"]
fn those_of_them_that_are_dear_too() {
    check(true);
}
