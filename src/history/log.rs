//! Recordings in files: read through once, then command by command as often as is wanted.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use super::command::Entry;
use super::error::HistoryError;
use super::last;
use super::parse::{self, Head, Stop};
use super::replay::Replay;
use super::start::{About, Recording};
use crate::scene::Scene;

/// Where the text is.
enum Text {
    File(PathBuf),
    Bytes(Vec<u8>),
}

/// A recording, or commands alone, that were read through once: all of it is in order but for what the world may refuse.
pub struct Log {
    label: String,
    text: Text,
    /// All but the commands.
    head: Option<Recording>,
    count: usize,
    last: f64,
    /// How it ends, where that is in the middle of something.
    cut: Option<String>,
}

impl Log {
    /// Reads a file through, without keeping its commands.
    ///
    /// Errors: it cannot be read, or is no recording and no list of commands; a command that no command can be; times that do not
    /// ascend; `end` before the last command or mark. One that was cut off is no error: see [`Log::is_cut`].
    pub fn open(path: &Path) -> Result<Log, HistoryError> {
        Log::new(Text::File(path.to_owned()), &path.display().to_string())
    }

    /// The same of a text; `label` stands for the file in messages.
    ///
    /// Errors: those of [`Log::open`].
    pub fn of_text(text: &str, label: &str) -> Result<Log, HistoryError> {
        Log::new(Text::Bytes(text.as_bytes().to_vec()), label)
    }

    fn new(text: Text, label: &str) -> Result<Log, HistoryError> {
        let mut head = Head::default();
        let mut last = 0.0;
        let read = text.reader().map_err(|error| HistoryError::file(label, format!("cannot be read: {error}")))?;
        let (count, stop) = parse::parse(read, &mut head, &mut |_, entry| {
            last = entry.at;
            Ok(())
        });
        let cut = match stop {
            None | Some(Stop::Enough) => None,
            Some(Stop::Cut(how)) => Some(how),
            Some(Stop::Wrong(message)) => return Err(HistoryError::file(label, message)),
        };
        let mut log = Log { label: label.to_owned(), text, head: None, count, last, cut };
        log.check(&head)?;
        log.head = log.recording_of(head)?;
        Ok(log)
    }

    /// Errors: an end before the last command or mark, marks out of order.
    fn check(&self, head: &Head) -> Result<(), HistoryError> {
        let wrong = |message: String| Err(HistoryError::file(&self.label, message));
        let is_time = |t: f64| t >= 0.0 && t.is_finite();
        if let Some(k) = head.marks.windows(2).position(|pair| pair[1].at < pair[0].at) {
            return wrong(format!("marks[{}]: times do not ascend: sort them", k + 1));
        }
        let last_mark = head.marks.last().map_or(0.0, |mark| mark.at);
        let last = if head.is_end_open { last_mark } else { self.last.max(last_mark) };
        match head.end {
            Some(end) if !is_time(end) => wrong(format!("end: is {end:?}: give a time of 0 s or more")),
            Some(end) if end < last && !self.is_cut() => {
                wrong(format!("end: {end:?} s is before the last command or mark at {last:?} s: give a later one"))
            }
            _ => Ok(()),
        }
    }

    /// Errors: a scene that is none; a version that is not there.
    fn recording_of(&self, head: Head) -> Result<Option<Recording>, HistoryError> {
        let at_once = |how: &String| HistoryError::CutAtOnce { label: self.label.clone(), how: how.clone() };
        if !head.is_recording {
            let nothing = self.cut.as_ref().filter(|_| self.count == 0);
            return nothing.map_or(Ok(None), |how| Err(at_once(how)));
        }
        let Some(scene) = head.scene else {
            if let Some(how) = &self.cut {
                return Err(at_once(how));
            }
            return Err(HistoryError::file(&self.label, "the key `scene` is missing: add a scene or the name of one"));
        };
        let text = scene.get();
        let scene = match serde_json::from_str::<String>(text) {
            Ok(name) => Scene::of_gallery(&name, &self.label)?,
            Err(_) => Scene::parse_within(text, &self.label)?,
        };
        // Of what was cut off only lines know how far it went.
        let end = head.end.filter(|_| !self.is_cut() || head.is_end_open);
        let marks = if self.is_cut() { Vec::new() } else { head.marks };
        Ok(Some(Recording {
            scene: Scene { view: head.view.clone().or(scene.view), ..scene },
            view: head.view,
            paused: head.paused,
            state: head.state,
            commands: Vec::new(),
            end: end.or_else(|| marks.last().map(|mark| mark.at.max(self.last))),
            marks,
            about: About::read(head.about.as_ref()),
        }))
    }

    /// The state that a session left beside its file, and after how many commands; `None` where there is none, or it is damaged.
    pub fn last(&self) -> Option<(Replay, usize)> {
        let Text::File(path) = &self.text else { return None };
        let last::Kept { place, state } = last::read(path)?;
        let head = Recording { state: Some(state), ..self.head.clone()? };
        Some((Replay::new(&head, &self.label).ok()?, place))
    }

    /// How many commands are whole.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether the text ends in the middle, or in something that is no JSON, after lines that are.
    pub fn is_cut(&self) -> bool {
        self.cut.is_some()
    }

    /// Errors: the text ends in the middle.
    pub fn whole(self) -> Result<Log, HistoryError> {
        match self.cut {
            Some(how) => Err(HistoryError::Cut { label: self.label, how, whole: self.count }),
            None => Ok(self),
        }
    }

    /// What stands for the file in messages.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// How far it goes `[s]`.
    pub fn end(&self) -> f64 {
        let said = self.head.as_ref().and_then(|head| head.end);
        said.unwrap_or(self.last).max(self.last)
    }

    /// The recording without its commands.
    ///
    /// Errors: it is a list of commands alone.
    pub fn head(&self) -> Result<&Recording, HistoryError> {
        let message = "is a list of commands without a scene: give it with `wobble simulate SCENE --commands`";
        self.head.as_ref().ok_or_else(|| HistoryError::file(&self.label, message))
    }

    /// All of it.
    ///
    /// Errors: those of [`Log::head`]; the file is another by now.
    pub fn recording(&self) -> Result<Recording, HistoryError> {
        let head = self.head()?.clone();
        Ok(Recording { commands: self.commands()?, end: Some(self.end()), ..head })
    }

    /// The commands, all at once.
    ///
    /// Errors: the file is another by now.
    pub fn commands(&self) -> Result<Vec<Entry>, HistoryError> {
        let mut commands = Vec::new();
        self.each(&mut |_, entry| {
            commands.push(entry);
            Ok(true)
        })?;
        Ok(commands)
    }

    /// Gives every whole command with its number, one at a time, as long as the taker says true.
    ///
    /// Errors: the taker's; the file is another by now.
    pub fn each(&self, taker: &mut dyn FnMut(usize, Entry) -> Result<bool, HistoryError>) -> Result<(), HistoryError> {
        let read = self.text.reader();
        let read = read.map_err(|error| HistoryError::file(&self.label, format!("cannot be read: {error}")))?;
        let mut failed = None;
        let (_, stop) = parse::parse(read, &mut Head::default(), &mut |number, entry| match taker(number, entry) {
            Ok(true) if number + 1 < self.count => Ok(()),
            Ok(_) => Err(Stop::Enough),
            Err(error) => {
                failed = Some(error);
                Err(Stop::Enough)
            }
        });
        match (failed, stop) {
            (Some(error), _) => Err(error),
            (None, Some(Stop::Wrong(message))) => Err(HistoryError::file(&self.label, message)),
            _ => Ok(()),
        }
    }
}

impl Text {
    fn reader(&self) -> std::io::Result<Box<dyn Read + '_>> {
        Ok(match self {
            Text::File(path) => Box::new(BufReader::with_capacity(1 << 16, File::open(path)?)),
            Text::Bytes(bytes) => Box::new(&bytes[..]),
        })
    }
}

/// Whether a file is a recording: an object that has its key.
pub(super) fn is_recording(path: &Path) -> bool {
    File::open(path).is_ok_and(|file| parse::is_recording(BufReader::with_capacity(1 << 16, file)))
}
