//! The folder in which sessions outlive a killed program, and what is found there at the next start.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use etcetera::BaseStrategy;

use crate::history::{Autosave, Called, Left, Start};
use crate::lessons::heading_of;
use crate::scene::gallery;

/// Names the folder in place of the user's own.
const VARIABLE: &str = "WOBBLE_STATE_DIR";
/// In the folder: the names of sessions that were offered already, and of those that cannot be read and were told of, a line each.
const OFFERED: &str = "offered.txt";
const TOLD: &str = "told.txt";

/// The folder for what is kept between two starts: `wobble` in XDG_STATE_HOME (~/.local/state), or where the system keeps such things.
/// `None` where the user has no home.
pub(super) fn state_folder() -> Option<PathBuf> {
    if let Some(named) = std::env::var_os(VARIABLE).filter(|named| !named.is_empty()) {
        return Some(named.into());
    }
    let user = etcetera::choose_base_strategy().ok()?;
    Some(user.state_dir().unwrap_or_else(|| user.data_dir()).join("wobble"))
}

/// A session that was cut off, read as far as it is whole.
pub(super) struct Leftover {
    pub(super) left: Left,
    pub(super) start: Start,
    /// What it was called.
    pub(super) called: Called,
    /// It was not offered at a start yet.
    pub(super) is_new: bool,
}

impl Leftover {
    /// What is said of it, as long ago as it is now.
    pub(super) fn line(&self) -> String {
        line((&self.start, &self.called), age(self.left.path()))
    }
}

/// What a start finds.
#[derive(Default)]
pub(super) struct Found {
    /// The newest last.
    pub(super) leftovers: Vec<Leftover>,
    /// Files of sessions that cannot be read, and that no start told of yet: what was done stays there.
    pub(super) unread: Vec<PathBuf>,
}

impl Found {
    fn is_empty(&self) -> bool {
        self.leftovers.is_empty() && self.unread.is_empty()
    }
}

/// What is said of files that cannot be read; `None` of none.
pub(super) fn unread_line(files: &[PathBuf]) -> Option<String> {
    let folder = files.first()?.parent().unwrap_or(Path::new(""));
    Some(match files {
        [file] => format!("a session that was cut off cannot be read; its file stays: {}", file.display()),
        _ => format!(
            "{} sessions that were cut off cannot be read; their files stay in {}",
            files.len(),
            folder.display()
        ),
    })
}

/// Notes that these were told of: no start tells of them again.
pub(super) fn note_told(folder: &Path, files: &[PathBuf]) {
    let known = std::fs::read_to_string(folder.join(TOLD)).unwrap_or_default();
    let names = files.iter().filter_map(|file| file.file_name()?.to_str());
    // Those that are gone need no word: names come again.
    let names: Vec<&str> = known.lines().filter(|name| folder.join(name).exists()).chain(names).collect();
    // Where it cannot be written they are told of once more.
    let _ = std::fs::write(folder.join(TOLD), names.join("\n"));
}

/// Looks for sessions that were cut off, on another thread, which calls `wake` when it is done.
pub(super) fn look(folder: PathBuf, wake: impl Fn() + Send + 'static) -> Receiver<Found> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        let found = found(&folder);
        if !found.is_empty() {
            // A window that has been closed wants none of it.
            let _ = sender.send(found);
            wake();
        }
    });
    receiver
}

fn found(folder: &Path) -> Found {
    let [known, told] = [OFFERED, TOLD].map(|file| std::fs::read_to_string(folder.join(file)).unwrap_or_default());
    let Found { leftovers: mut found, mut unread } = Found::default();
    for left in Autosave::left(folder) {
        match left.start() {
            Ok(start) => {
                let is_new = !known.lines().any(|name| Some(name) == name_of(&left));
                let called = left.called();
                found.push(Leftover { left, start, called, is_new });
            }
            // What was done stays in its file, though it is not offered.
            Err(_) if left.is_begun() => {
                let is_told = told.lines().any(|name| Some(name) == name_of(&left));
                unread.extend((!is_told).then(|| left.path().to_owned()));
            }
            // Not even its beginning is whole: nobody can go on with it.
            Err(_) => left.discard().unwrap_or_default(),
        }
    }
    found.reverse();
    if found.is_empty() {
        // Names come again.
        note_offered(folder, &[]);
    }
    Found { leftovers: found, unread }
}

/// The file's own name.
fn name_of(left: &Left) -> Option<&str> {
    left.path().file_name()?.to_str()
}

/// Notes that these, and no others, were offered: the next start offers them no more. Where that cannot be written it does.
pub(super) fn note_offered(folder: &Path, leftovers: &[Leftover]) {
    let names: Vec<&str> = leftovers.iter().filter_map(|leftover| name_of(&leftover.left)).collect();
    let file = folder.join(OFFERED);
    let _ = if names.is_empty() { std::fs::remove_file(file) } else { std::fs::write(file, names.join("\n")) };
}

/// How long ago a file was written.
fn age(path: &Path) -> Option<Duration> {
    std::fs::metadata(path).and_then(|about| about.modified()).ok()?.elapsed().ok()
}

fn line((start, called): (&Start, &Called), age: Option<Duration>) -> String {
    let file = called.file.as_deref().and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
    let (scene, end) = (title(start), start.recording().end());
    // By the file that it was saved to or opened from, and what it is a scene of.
    let name = match file.or_else(|| called.name.clone()) {
        Some(name) if Path::new(&name).file_stem().is_none_or(|stem| stem != scene) => format!("{name} ({scene})"),
        Some(name) => name,
        None => scene.to_owned(),
    };
    let ago = age.map_or_else(String::new, |age| format!(", {} ago", words(age)));
    format!("{name}, {end:.0} s long{ago}")
}

/// What a start is called in lists of sessions and of windows: by its file, else as the step of a lesson or the gallery calls its scene.
pub(super) fn title(start: &Start) -> &str {
    let name = start.scene().name();
    let entry = gallery().iter().find(|entry| entry.name == name);
    let listed = heading_of(name).or(entry.map(|entry| entry.title));
    start.name().or(listed).unwrap_or(name)
}

/// A span of time, as one says it.
fn words(age: Duration) -> String {
    let counted = |count: u64, unit: &str| format!("{count} {unit}{}", if count == 1 { "" } else { "s" });
    match age.as_secs() / 60 {
        0 => "less than a minute".to_owned(),
        minutes @ 1..=119 => counted(minutes, "minute"),
        minutes @ 120..=2879 => counted(minutes / 60, "hour"),
        minutes => counted(minutes / 1440, "day"),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::history::History;
    use crate::scene::Scene;

    #[test]
    fn spans_are_said_in_words() {
        let said = [5, 60, 119 * 60, 3 * 3600, 50 * 3600].map(|seconds| words(Duration::from_secs(seconds)));
        assert_eq!(said, ["less than a minute", "1 minute", "119 minutes", "3 hours", "2 days"]);
    }

    #[test]
    fn a_session_of_the_gallery_is_called_as_it_is_there() {
        let entry = &gallery()[0];
        let start = entry.scene().unwrap().into();
        let said = |called: Called| line((&start, &called), None);
        assert_eq!(said(Called::default()), format!("{}, 0 s long", entry.title));
        let called = Called { name: Some("swing".to_owned()), file: None };
        assert_eq!(said(called.clone()), format!("swing ({}), 0 s long", entry.title));
        let file = Some("/home/toys/my swing.json".into());
        assert_eq!(said(Called { file, ..called }), format!("my swing.json ({}), 0 s long", entry.title));
    }

    #[test]
    fn what_cannot_be_read_though_its_header_is_whole_stays_in_its_file() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("session-1-0.jsonl");
        let scene = r#"{"wobble": 1, "points": {"position": [[0, 0]]}}"#;
        let log = format!(
            "{{\"wobble_recording\": 1, \"scene\": {scene}}}\n{{\"at\": 2, \"do\": \"clear\"}}\n{{\"at\": 1, \"do\": \"clear\"}}\n"
        );
        std::fs::write(&file, &log).unwrap();
        let now = found(folder.path());
        assert!(now.leftovers.is_empty() && file.exists());
        assert_eq!(now.unread, std::slice::from_ref(&file));
        assert!(unread_line(&now.unread).is_some_and(|line| line.contains(&file.display().to_string())));
        // It is told of once, and again where another one has its name.
        note_told(folder.path(), &now.unread);
        assert!(found(folder.path()).is_empty() && file.exists());
        std::fs::remove_file(&file).unwrap();
        note_told(folder.path(), &[]);
        std::fs::write(&file, log).unwrap();
        assert_eq!(found(folder.path()).unread.len(), 1);
    }

    #[test]
    fn what_is_not_whole_is_not_offered_and_goes() {
        let folder = tempfile::tempdir().unwrap();
        let scene =
            Scene::parse(r#"{"wobble": 1, "name": "two", "points": {"position": [[0, 0]]}}"#, "two.json").unwrap();
        let history = History::new(scene.into()).unwrap();
        let mut autosave = Autosave::begin(folder.path()).unwrap();
        autosave.write(&history).unwrap();
        drop(autosave);
        std::fs::write(folder.path().join("session-1-0.jsonl"), "{\"wobble_rec").unwrap();
        let list = found(folder.path()).leftovers;
        assert_eq!(list.len(), 1);
        assert_eq!(list[0].line(), "two, 0 s long, less than a minute ago");
        assert!(list[0].is_new);
        note_offered(folder.path(), &list);
        drop(list);
        assert!(!found(folder.path()).leftovers[0].is_new, "it was offered");
        assert!(!folder.path().join("session-1-0.jsonl").exists());
    }
}
