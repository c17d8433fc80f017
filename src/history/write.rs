//! Recordings as texts and files.

use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;
use serde_json::{Map, Value};

use super::command::{Do, Entry};
use super::start::Recording;
use crate::output::{self, OutputError};
use crate::scene::{AddKeys, Scene};

impl Recording {
    /// Writes it to a file: whole or not at all, in place of what was there. One that ends in .jsonl gets lines.
    ///
    /// Errors: the file cannot be written; a picture that cannot be read.
    pub fn save(&self, path: &Path) -> Result<(), OutputError> {
        let has_lines = path.extension().is_some_and(|ending| ending == "jsonl");
        output::replace(path, |to| if has_lines { self.write_lines(to) } else { self.write_json(to) })
    }

    /// As one object, a command a line.
    ///
    /// Errors: the writer's; a picture that cannot be read.
    pub fn write_json(&self, mut to: impl Write) -> io::Result<()> {
        to.write_all(b"{\n\"wobble_recording\": 1,\n\"scene\": ")?;
        let scene = self.whole_scene()?;
        serde_json::to_writer(&mut to, &scene)?;
        if let Some(state) = &self.state {
            to.write_all(b",\n\"state\": ")?;
            serde_json::to_writer(&mut to, state)?;
        }
        to.write_all(b",\n\"commands\": [")?;
        for (number, entry) in self.commands.iter().enumerate() {
            to.write_all(if number == 0 { b"\n" } else { b",\n" })?;
            write_entry(&mut to, entry, &self.scene)?;
        }
        to.write_all(b"\n]")?;
        for (key, value) in self.tail() {
            write!(to, ",\n\"{key}\": {value}")?;
        }
        to.write_all(b"\n}\n")
    }

    /// As lines: the header, a command each, and what only the end knows.
    ///
    /// Errors: the writer's; a picture that cannot be read.
    pub fn write_lines(&self, mut to: impl Write) -> io::Result<()> {
        self.write_header(&mut to)?;
        for entry in &self.commands {
            write_entry(&mut to, entry, &self.scene)?;
            to.write_all(b"\n")?;
        }
        // What made it stands in the header, which is there when the rest is cut off.
        let tail = self.tail().into_iter().filter(|(key, _)| *key != "about");
        let tail: Map<String, Value> = tail.map(|(key, value)| (key.to_owned(), value)).collect();
        serde_json::to_writer(&mut to, &tail)?;
        to.write_all(b"\n")
    }

    /// The first of the lines.
    pub(super) fn write_header(&self, mut to: impl Write) -> io::Result<()> {
        to.write_all(b"{\"wobble_recording\":1,\"scene\":")?;
        serde_json::to_writer(&mut to, &self.whole_scene()?)?;
        if let Some(state) = &self.state {
            to.write_all(b",\"state\":")?;
            serde_json::to_writer(&mut to, state)?;
        }
        writeln!(to, ",\"about\":{}}}", said(&self.about))
    }

    /// The scene with its pictures, so that the file is all that is needed.
    fn whole_scene(&self) -> io::Result<Scene> {
        self.scene.clone().with_pictures_inside().map_err(io::Error::other)
    }

    /// What stands after the commands.
    fn tail(&self) -> Vec<(&'static str, Value)> {
        let mut tail = vec![("end", self.end().into())];
        if let Some(view) = &self.view {
            tail.push(("view", said(view)));
        }
        if self.paused {
            tail.push(("paused", true.into()));
        }
        if !self.marks.is_empty() {
            tail.push(("marks", said(&self.marks)));
        }
        tail.push(("about", said(&self.about)));
        tail
    }
}

fn said(value: &impl Serialize) -> Value {
    // Words and finite numbers, which can always be said.
    serde_json::to_value(value).unwrap_or_default()
}

/// A command on a line of its own, with the pictures that it names.
pub(super) fn write_entry(to: impl Write, entry: &Entry, scene: &Scene) -> io::Result<()> {
    let has_pictures =
        |keys: &AddKeys| !(keys.bodies.is_empty() && keys.obstacles.is_empty() && keys.textures.is_empty());
    let names_picture = |act: &Do| matches!(act, Do::Add(keys) if has_pictures(keys));
    let object = match &entry.act {
        Do::Add(keys) if names_picture(&entry.act) => {
            let keys = scene.addition_with_pictures_inside(keys).map_err(io::Error::other)?;
            Entry { act: Do::Add(Box::new(keys)), ..entry.clone() }.to_object()
        }
        _ => entry.to_object(),
    };
    Ok(serde_json::to_writer(to, &object)?)
}
