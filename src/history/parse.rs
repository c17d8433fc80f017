//! The text of a recording, piece by piece: one object, a list of commands, or lines (a header, then a command a line).

use std::fmt;
use std::io::Read;

use serde::de::{DeserializeSeed, Deserializer as _, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;
use serde_json::{Deserializer, Map, Value};

use super::command::Entry;
use super::mark::Mark;
use crate::scene::ViewKeys;

/// The keys of a recording.
const OF_RECORDINGS: [&str; 9] =
    ["wobble_recording", "scene", "state", "commands", "end", "view", "paused", "marks", "about"];

/// The keys of a recording but for its commands.
#[derive(Debug, Default)]
pub(super) struct Head {
    /// The text of a scene, or the name of one in quotes.
    pub(super) scene: Option<Box<RawValue>>,
    pub(super) state: Option<Value>,
    pub(super) end: Option<f64>,
    /// The end stands on a line of its own, as far as was known then: commands may follow it.
    pub(super) is_end_open: bool,
    pub(super) view: Option<ViewKeys>,
    pub(super) paused: bool,
    pub(super) marks: Vec<Mark>,
    pub(super) about: Option<Value>,
    pub(super) is_recording: bool,
}

/// Why reading ended early.
#[derive(Debug)]
pub(super) enum Stop {
    /// Whoever was given the commands wants no more.
    Enough,
    /// The text ends in the middle, or in something that is no JSON, after lines that are; in words.
    Cut(String),
    /// In words.
    Wrong(String),
}

/// Who is given the commands, with their numbers from 0.
pub(super) type Taker<'a> = &'a mut dyn FnMut(usize, Entry) -> Result<(), Stop>;

/// A text that is being read.
struct Reading<'a> {
    head: &'a mut Head,
    taker: Taker<'a>,
    count: usize,
    last: f64,
    stop: Option<Stop>,
    /// Objects of the text that are whole.
    whole: usize,
}

/// Reads a text; returns how many commands are whole, and why it ended before the end of the text, if so.
///
/// Nothing but the header and one command is in memory at a time.
pub(super) fn parse(from: impl Read, head: &mut Head, taker: Taker<'_>) -> (usize, Option<Stop>) {
    let mut reading = Reading { head, taker, count: 0, last: 0.0, stop: None, whole: 0 };
    let mut text = Deserializer::from_reader(from);
    let mut done = text.deserialize_any(Top(&mut reading));
    // What follows the first object are lines.
    while done.is_ok() && reading.stop.is_none() && text.end().is_err() {
        reading.whole += 1;
        done = text.deserialize_any(Top(&mut reading));
    }
    let stop = match (reading.stop.take(), done) {
        (Some(stop), _) => Some(stop),
        (None, Ok(())) => None,
        (None, Err(error)) if error.is_eof() => Some(Stop::Cut("the text ends in the middle".to_owned())),
        // A machine that lost its power may leave anything behind what was written.
        (None, Err(error)) if error.is_syntax() && reading.whole > 0 => Some(Stop::Cut(worded(&error))),
        (None, Err(error)) => Some(Stop::Wrong(worded(&error))),
    };
    (reading.count, stop)
}

/// Whether an object has the key of recordings: nothing of it is kept.
pub(super) fn is_recording(from: impl Read) -> bool {
    struct Keys<'a>(&'a mut bool);

    impl<'de> Visitor<'de> for Keys<'_> {
        type Value = ();

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("an object")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
            while let Some(key) = map.next_key::<String>()? {
                match key.as_str() {
                    "wobble_recording" => {
                        *self.0 = true;
                        return Err(A::Error::custom("found"));
                    }
                    "wobble" => return Err(A::Error::custom("a scene")),
                    _ => map.next_value::<IgnoredAny>()?,
                };
            }
            Ok(())
        }
    }

    let mut found = false;
    let _ = Deserializer::from_reader(from).deserialize_any(Keys(&mut found));
    found
}

/// What is wrong with a text, with its line.
fn worded(error: &serde_json::Error) -> String {
    let (line, message) = (error.line(), error.to_string());
    let message = message.split(" at line ").next().unwrap_or(&message);
    match error.classify() {
        serde_json::error::Category::Data => format!("line {line}: {message}"),
        serde_json::error::Category::Io => format!("cannot be read: {message}"),
        _ => format!("line {line}: is not JSON, which knows no NaN and no infinity: {message}"),
    }
}

impl Reading<'_> {
    /// One more command.
    fn take(&mut self, value: Value) -> Result<(), Stop> {
        let number = self.count;
        let wrong = |reason: String| Stop::Wrong(format!("commands[{number}]: {reason}"));
        let entry = Entry::from_value(value).map_err(wrong)?;
        if entry.at < self.last {
            let (at, last) = (entry.at, self.last);
            return Err(wrong(format!("at: {at:?} s comes after {last:?} s: sort commands by their times, upwards")));
        }
        self.last = entry.at;
        (self.taker)(number, entry)?;
        self.count += 1;
        Ok(())
    }

    fn stop<E: serde::de::Error>(&mut self, stop: Stop) -> E {
        self.stop = Some(stop);
        E::custom("stopped")
    }
}

/// Something at the top of a text.
struct Top<'a, 'b>(&'a mut Reading<'b>);

impl<'de> Visitor<'de> for Top<'_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a recording: an object with the key `wobble_recording`, or a list of commands")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<(), A::Error> {
        each(self.0, list)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let reading = self.0;
        let mut command = Map::new();
        let mut end = None;
        let mut is_header = false;
        let mut about: Option<Value> = None;
        let mut of_recording: Option<String> = None;
        while let Some(key) = map.next_key::<String>()? {
            let is_twice = match key.as_str() {
                "scene" => reading.head.scene.is_some(),
                "state" => reading.head.state.is_some(),
                _ => false,
            };
            if is_twice {
                return Err(reading.stop(Stop::Wrong(format!("{key}: stands twice: leave one of them out"))));
            }
            // The place that things are moved about is another `about`.
            if OF_RECORDINGS.contains(&key.as_str()) && key != "about" {
                of_recording = Some(key.clone());
            }
            match key.as_str() {
                "wobble_recording" => {
                    (reading.head.is_recording, is_header) = (true, true);
                    let version: Value = map.next_value()?;
                    if version.as_u64() != Some(1) {
                        let message = format!(
                            "wobble_recording: is version {version}: this program reads version 1, so get a newer wobble"
                        );
                        return Err(reading.stop(Stop::Wrong(message)));
                    }
                }
                "scene" => reading.head.scene = Some(map.next_value()?),
                "state" => reading.head.state = Some(map.next_value()?),
                "end" => end = Some(map.next_value::<f64>()?),
                "view" => reading.head.view = Some(map.next_value()?),
                "paused" => reading.head.paused = map.next_value()?,
                "marks" => reading.head.marks.append(&mut map.next_value()?),
                "about" => about = Some(map.next_value()?),
                "commands" => map.next_value_seed(Commands(reading))?,
                _ => {
                    let value = map.next_value()?;
                    command.insert(key, value);
                }
            }
        }
        if let Some(end) = end {
            (reading.head.end, reading.head.is_end_open) = (Some(end), !is_header);
            if !is_header && end < reading.last {
                let message =
                    format!("end: {end:?} s is before the last command at {:?} s: give a later one", reading.last);
                return Err(reading.stop(Stop::Wrong(message)));
            }
        }
        if command.contains_key("do") {
            if let Some(key) = of_recording {
                let message = format!(
                    "commands[{}]: `{key}` is a key of a recording and not of a command: leave it out",
                    reading.count
                );
                return Err(reading.stop(Stop::Wrong(message)));
            }
            command.extend(about.map(|about| ("about".to_owned(), about)));
            reading.take(Value::Object(command)).map_err(|stop| reading.stop(stop))?;
        } else if let Some(key) = command.keys().next() {
            let message = format!("unknown key `{key}`: a recording has {}", OF_RECORDINGS.join(", "));
            return Err(reading.stop(Stop::Wrong(message)));
        } else if about.is_some() {
            reading.head.about = about;
        }
        Ok(())
    }
}

/// The list of commands.
struct Commands<'a, 'b>(&'a mut Reading<'b>);

impl<'de> DeserializeSeed<'de> for Commands<'_, '_> {
    type Value = ();

    fn deserialize<D: serde::Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        from.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Commands<'_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of commands")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<(), A::Error> {
        each(self.0, list)
    }
}

fn each<'de, A: SeqAccess<'de>>(reading: &mut Reading<'_>, mut list: A) -> Result<(), A::Error> {
    while let Some(value) = list.next_element::<Value>()? {
        reading.take(value).map_err(|stop| reading.stop(stop))?;
    }
    Ok(())
}
