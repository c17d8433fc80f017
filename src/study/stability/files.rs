//! The scenes that a study writes out, and the names of their files.

use super::summary::worst;
use super::{Judged, battery};
use crate::history::Recording;

/// A scene that is written out.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// Its place in the folder of the study.
    pub place: String,
    /// Whose it is: its place among those that were judged.
    pub subject: usize,
    /// The scene, and the commands that lead it.
    pub recording: Recording,
}

/// Folder of the worst scenes, in that of the study.
pub(super) const WORST: &str = "worst";

/// Longest name of a file without its ending `[characters]`.
const LONGEST: usize = 80;

/// The scenes of cases that were asked for by number, and the `count` worst of all others; those that are among `known` are not made
/// again.
pub(super) fn scenes(judged: &[Judged], count: usize, known: &[SceneFile]) -> Vec<SceneFile> {
    let is_asked = |one: &Judged| one.case.is_some() && one.own.is_some();
    let mut list: Vec<SceneFile> = Vec::new();
    let mut add = |subject: usize, folder: &str| {
        let one = &judged[subject];
        let kept = known.iter().find(|kept| kept.subject == subject).map(|kept| kept.recording.clone());
        let drawn = || one.case.and_then(|case| battery::subject(case).ok()).map(|subject| subject.recording);
        if let Some(recording) = kept.or_else(|| one.own.clone()).or_else(drawn) {
            let place = free(&format!("{folder}{}", file_name(&one.name)), &list);
            list.push(SceneFile { place, subject, recording });
        }
    };
    (0..judged.len()).filter(|&subject| is_asked(&judged[subject])).for_each(|subject| add(subject, ""));
    let others = worst(judged, count).into_iter().filter(|&subject| !is_asked(&judged[subject]));
    others.for_each(|subject| add(subject, &format!("{WORST}/")));
    list
}

/// A name that is one file in the folder that it is written to, whatever it was: letters, digits, `-`, `_` and single dots stay.
fn file_name(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    let name: String = name.chars().map(plain).take(LONGEST).collect();
    let name = name.trim_matches('.').to_owned();
    if name.is_empty() { "scene".to_owned() } else { name }
}

/// The place, with a number behind it if others have it already: also where capitals are small letters.
fn free(place: &str, taken: &[SceneFile]) -> String {
    let is_taken = |place: &str| taken.iter().any(|other| other.place.to_lowercase() == place.to_lowercase());
    let numbered = (2_u64..).map(|number| format!("{place}-{number}.json"));
    let mut places = std::iter::once(format!("{place}.json")).chain(numbered);
    places.find(|place| !is_taken(place)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_one_file_in_its_folder() {
        let names = [
            ("rim", "rim"),
            ("a/b", "a_b"),
            ("../x", "_x"),
            ("..", "scene"),
            ("", "scene"),
            ("C:\\x", "C__x"),
            ("two words", "two_words"),
            ("über.json", "über.json"),
            ("a\u{0}\nb", "a__b"),
        ];
        for (name, file) in names {
            assert_eq!(file_name(name), file, "{name:?}");
        }
        assert_eq!(file_name(&"x".repeat(500)).len(), LONGEST);
    }

    #[test]
    fn equal_names_get_files_of_their_own() {
        let mut list: Vec<SceneFile> = Vec::new();
        for name in ["same", "Same", "same", "same-2"] {
            let place = free(name, &list);
            assert!(list.iter().all(|other| other.place.to_lowercase() != place.to_lowercase()), "{place}");
            list.push(SceneFile { place, subject: 0, recording: battery::subject(0).unwrap().recording });
        }
        assert_eq!(list[0].place, "same.json");
    }
}
