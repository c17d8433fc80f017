//! What a history begins with: a scene, or a recording.

use std::ffi::OsStr;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::chunk;
use super::clock::Said;
use super::command::{Do, Entry, SetKeys};
use super::dress::{Dress, Group};
use super::error::HistoryError;
use super::frame::Frame;
use super::log::{self, Log};
use super::mark::Mark;
use super::redo_file::Undone;
use super::state;
use crate::picture::PNG_MARK;
use crate::scene::{Scene, ViewKeys};

/// Times that are added up reach an end no better than to this share of it `[1]`.
const ROUNDING: f64 = 1e-9;

/// A start scene and the commands that were given, with their times.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// The start.
    pub scene: Scene,
    /// A running state of it that it begins from, as a file has it: then it is a snapshot.
    pub state: Option<Value>,
    /// The commands, times ascending.
    pub commands: Vec<Entry>,
    /// How far it goes `[s]`: to the last command if not said.
    pub end: Option<f64>,
    /// What a picture of it shows at first, if not what one of the scene does.
    pub view: Option<ViewKeys>,
    /// It was paused when it was saved, and is so when it is opened in a window.
    pub paused: bool,
    /// What the motion came to, to be compared with.
    pub marks: Vec<Mark>,
    /// What made it.
    pub about: About,
}

/// What made a recording.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct About {
    /// The version of this program.
    pub wobble: String,
    /// When or by whom, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub made: Option<String>,
}

impl Default for About {
    /// This version.
    fn default() -> Self {
        About { wobble: env!("CARGO_PKG_VERSION").to_owned(), made: None }
    }
}

impl About {
    /// Whether this version made it, which comes to the same bits.
    pub fn is_ours(&self) -> bool {
        self.wobble == env!("CARGO_PKG_VERSION")
    }

    /// What a file says; nothing said is ours.
    pub(super) fn read(value: Option<&Value>) -> Self {
        let word = |key: &str| value.and_then(|about| about.get(key)).and_then(Value::as_str).map(str::to_owned);
        let ours = About::default();
        About { wobble: word("wobble").unwrap_or(ours.wobble), made: word("made") }
    }
}

impl Recording {
    /// The world that it begins with, and what belongs to it.
    ///
    /// Errors: a scene that cannot be run; a state that is damaged or of a layout that is not known.
    pub(super) fn begin(&self, label: &str) -> Result<Frame, HistoryError> {
        let first = self.scene.world(self.scene.duration)?;
        let dress = Dress::new(&self.scene)?;
        let Some(state) = &self.state else {
            return Ok(Frame::new(first, dress));
        };
        state::go_on(state, &*first, dress).map_err(|message| HistoryError::file(label, message))
    }

    /// What is to be known of a recording that another version made: that its motion is worked out anew, and what of its state is
    /// taken; that its state is of another scene. Empty: it is ours, and comes to the same bits.
    pub fn notes(&self) -> Vec<String> {
        let ours = env!("CARGO_PKG_VERSION");
        let mut notes = Vec::new();
        let by_state = self.state.as_ref().and_then(state::version);
        if let Some(made) = [Some(&*self.about.wobble), by_state].into_iter().flatten().find(|made| *made != ours) {
            notes.push(format!("was made by wobble {made}: {ours} replays the motion anew, which may differ"));
        }
        let other = |layout: &u64| *layout > state::LAYOUT;
        if let Some(layout) = self.state.as_ref().and_then(state::layout).filter(other) {
            let taken = "positions, velocities, bonds and time are taken, all else is as at the start of the scene";
            notes.push(format!("its state has layout {layout}, which this version does not know: {taken}"));
        }
        let of = self.state.as_ref().and_then(state::scene);
        if let Some((of, here)) = of.zip(self.scene.name.as_deref()).filter(|(of, here)| of != here) {
            notes.push(format!("its state is of the scene `{of}` and goes on under `{here}`"));
        }
        notes
    }

    /// A recording that begins at the state of a frame and ends there.
    ///
    /// Errors: in words, why the state cannot be kept.
    pub(super) fn snapshot(scene: &Scene, frame: &Frame) -> Result<Recording, String> {
        let at = frame.world.time();
        let group = |group: Group| {
            let Group { name, points } = group;
            Entry { at, act: Do::Group { points, name }, edit: None, name: None }
        };
        let groups = frame.dress.groups(&*frame.world);
        // Those of the scene that are none any more would come again with it.
        let is_left = |name: &String| groups.iter().any(|group| group.name == *name);
        let named = frame.dress.named().iter().map(|group| group.name.clone());
        let ended = named.filter(|name| !is_left(name)).map(|name| Group { name, points: Vec::new() });
        // Labels may go along with points that came later: no scene could name those.
        let labels = frame.dress.labels();
        let said = (**labels != scene.labels).then(|| {
            let act = Do::Set(Box::new(SetKeys { labels: Some(labels.to_vec()), ..SetKeys::default() }));
            Entry { at, act, edit: None, name: None }
        });
        let commands = groups.iter().cloned().chain(ended).map(group).chain(said).collect();
        let state = Some(state::keep(frame, scene.name.as_deref())?);
        Ok(Recording { state, commands, end: Some(at), ..frame.said.put(scene).into() })
    }

    /// Where the motion ends by itself, as the commands up to `time` `[s]` say, if that is before it: whoever goes on from there goes past it
    /// `[s]`.
    pub fn passed(&self, time: f64) -> Option<f64> {
        let mut said = Said::default();
        for entry in self.commands.iter().take_while(|entry| entry.at <= time) {
            if let Do::Set(keys) = &entry.act {
                said.hear(keys);
            }
        }
        said.of(&self.scene).duration.filter(|end| time > end + ROUNDING * end)
    }

    /// How far it goes `[s]`.
    pub fn end(&self) -> f64 {
        let last = self.commands.last().map_or(0.0, |entry| entry.at);
        self.end.unwrap_or(last)
    }
}

/// What a history begins with.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// What it is a recording of, with the commands that are followed until something new is given.
    pub(super) recording: Recording,
    /// The file that it was read from.
    file: Option<PathBuf>,
    /// What redo brings again of a session that was cut off.
    pub(super) undone: Option<Undone>,
}

impl Start {
    /// What a file or a name means: a recording, a scene, a PNG with a scene in it, a picture, a scene of the gallery.
    ///
    /// Errors: those of [`Scene::load`] and [`Log::open`]; a recording that was cut off.
    pub fn load(file_or_name: &str) -> Result<Start, HistoryError> {
        let path = Path::new(file_or_name);
        // A pipe is read once: it may hold a scene.
        if std::fs::metadata(path).is_ok_and(|about| about.is_file()) {
            if log::is_recording(path) {
                return Ok(Start::from(Log::open(path)?.whole()?.recording()?).of_file(path));
            }
            if let Some(text) = inside_picture(path) {
                return Ok(Start::from(Log::of_text(&text, file_or_name)?.whole()?.recording()?).of_file(path));
            }
        }
        Ok(Scene::load(file_or_name)?.into())
    }

    /// The same, of a session of which so much was undone.
    pub(super) fn with_undone(self, undone: Option<Undone>) -> Self {
        Start { undone, ..self }
    }

    fn of_file(self, path: &Path) -> Self {
        Start { file: Some(path.to_owned()), ..self }
    }

    /// What a recording, a snapshot or a picture with one is called: its file without the ending. `None`: it is called as its scene.
    pub fn name(&self) -> Option<&str> {
        self.file.as_deref().and_then(Path::file_stem).and_then(OsStr::to_str)
    }

    /// Whether something was done in it that is followed until something new is given. What a moment lets go of as it opens is not.
    pub fn is_replayed(&self) -> bool {
        let Recording { state, commands, end, .. } = &self.recording;
        let opens = |entry: &Entry| {
            let lets_go =
                matches!(entry.act, Do::Group { .. } | Do::Release | Do::Key { down: false, .. } | Do::Mouse(_));
            let is_as_kept = lets_go || matches!(&entry.act, Do::Set(keys) if keys.is_of_labels());
            state.is_some() && *end == Some(entry.at) && is_as_kept
        };
        !commands.iter().all(opens)
    }

    /// The recording that it is.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// Whether there is more than the start of a scene.
    pub fn is_recording(&self) -> bool {
        !self.recording.commands.is_empty() || self.recording.state.is_some() || self.recording.end.is_some()
    }

    /// The scene that it begins with.
    pub fn scene(&self) -> &Scene {
        &self.recording.scene
    }
}

/// The recording in a picture's file, if it is a PNG with one.
fn inside_picture(path: &Path) -> Option<String> {
    let mut start = [0; 8];
    File::open(path).ok()?.read_exact(&mut start).ok()?;
    if start != PNG_MARK {
        return None;
    }
    chunk::find(&std::fs::read(path).ok()?)
}

impl From<Scene> for Recording {
    /// The start alone.
    fn from(scene: Scene) -> Self {
        let (commands, marks, about) = (Vec::new(), Vec::new(), About::default());
        Recording { scene, state: None, commands, end: None, view: None, paused: false, marks, about }
    }
}

impl From<Scene> for Start {
    fn from(scene: Scene) -> Self {
        Start { recording: scene.into(), file: None, undone: None }
    }
}

impl From<Recording> for Start {
    fn from(recording: Recording) -> Self {
        Start { recording, file: None, undone: None }
    }
}
