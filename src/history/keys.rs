//! Commands to and from the objects of a file.

use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Map, Value};

use super::command::{Do, Entry};
use crate::scene::{KeyName, LATER, ProfileName, RegionName, Row, object, one_line, translate};
use crate::sim::{BondId, Cursor, Key, MouseChange, PointId, Profile, Reach, Region};

/// Names of what is done, in the order of the table.
const NAMES: [&str; 15] = [
    "cursor", "mouse", "grab", "release", "key", "pin", "unpin", "cut", "split", "add", "delete", "clear", "move",
    "set", "group",
];

/// Largest number of an edit: those that follow have room above, and any reader of JSON knows it exactly.
const LARGEST_EDIT: u64 = 1 << 53;

object! {
    CursorKeys: "a cursor: an object with the key `to`" {
        required {
            to: Place,
        }
        optional {
            by: f64,
        }
    }
}

/// Where a cursor goes: a place of the plane, a ray of space, or nowhere.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "a place [x, y], a ray {\"origin\": […], \"direction\": […]}, or null")]
pub enum Place {
    Plane([f64; 2]),
    Ray(RayKeys),
    Gone(()),
}

/// Where a cut begins or ends: at a place of the plane, or along a ray of space.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "a place [x, y], or a ray {\"origin\": […], \"direction\": […]}")]
pub enum End {
    Plane([f64; 2]),
    Ray(RayKeys),
}

object! {
    RayKeys: "a ray: an object with the keys `origin` and `direction`" {
        required {
            origin: Row<f64, 3>,
            direction: Row<f64, 3>,
        }
    }
}

object! {
    #[derive(Default)]
    MouseKeys: "a mouse: an object with keys such as `strength`" {
        optional {
            strength: f64,
            radius: f64,
            region: RegionName,
            profile: ProfileName,
            track: (),
        }
    }
}

object! {
    #[derive(Default)]
    GrabKeys: "a grab: an object with one of the keys `points` and `within`, and with `torn_beyond`" {
        optional {
            points: Vec<u32>,
            within: f64,
            torn_beyond: f64,
        }
    }
}

object! {
    KeyKeys: "a key: an object with the keys `key` and `down`" {
        required {
            key: KeyName,
            down: bool,
        }
    }
}

object! {
    PointsKeys: "an object with the key `points`" {
        required {
            points: Vec<u32>,
        }
    }
}

object! {
    CutKeys: "a cut: an object with the keys `from` and `to`" {
        required {
            from: End,
            to: End,
        }
    }
}

object! {
    SplitKeys: "a split: an object with the keys `points` and `bonds`" {
        required {
            points: Vec<u32>,
            bonds: Vec<u32>,
        }
    }
}

object! {
    GroupKeys: "a group: an object with the keys `points` and `name`" {
        required {
            points: Vec<u32>,
            name: String,
        }
    }
}

object! {
    Nothing: "no keys" {
        optional {}
    }
}

impl Entry {
    /// The object of a file.
    pub(super) fn to_object(&self) -> Map<String, Value> {
        let (name, mut object) = keys_of(&self.act);
        let called = self.name.clone();
        // A group has a name of its own.
        if let Some(called) = called.filter(|_| name != "group") {
            object.insert("name".to_owned(), called.into());
        }
        object.insert("at".to_owned(), self.at.into());
        object.insert("do".to_owned(), name.into());
        if let Some(edit) = self.edit {
            object.insert("edit".to_owned(), edit.into());
        }
        object
    }

    /// The command of an object of a file.
    ///
    /// Errors: in words, what of it no command has.
    pub(super) fn from_value(value: Value) -> Result<Self, String> {
        let Value::Object(mut object) = value else {
            return Err("is no command: give an object with the keys `at` and `do`".to_owned());
        };
        let at = object.remove("at").ok_or("the key `at` is missing: add its time [s]")?;
        let at = at.as_f64().filter(|at| at.is_finite() && *at >= 0.0);
        let at = at.ok_or("at: give a time of 0 s or more")?;
        let name = object.remove("do").ok_or("the key `do` is missing: add what is done")?;
        let name = name.as_str().ok_or("do: give a name")?;
        let edit = match object.remove("edit") {
            None => None,
            Some(edit) => {
                let edit = edit.as_u64().filter(|&edit| edit <= LARGEST_EDIT);
                Some(edit.ok_or_else(|| format!("edit: give a whole number from 0 to {LARGEST_EDIT}"))?)
            }
        };
        let called = match object.get("name") {
            Some(Value::String(text)) => Some(one_line(text)),
            Some(_) => return Err("name: give words".to_owned()),
            None => None,
        };
        if name != "group" {
            object.remove("name");
        }
        if let Some(key) = object.keys().find(|key| LATER.contains(&key.as_str())) {
            return Err(format!("`{key}` is not in this version: leave it out"));
        }
        let act = act(name, object)?;
        if let Do::Cursor { by: Some(by), .. } = act
            && by < at
        {
            return Err(format!("by: {by:?} s is before its time: give one that comes after, or leave it out"));
        }
        Ok(Entry { at, act, edit, name: called })
    }
}

fn numbers(points: &[PointId]) -> Vec<u32> {
    points.iter().map(|point| point.0).collect()
}

fn points(numbers: Vec<u32>) -> Vec<PointId> {
    numbers.into_iter().map(PointId).collect()
}

/// The name and the keys of what is done.
fn keys_of(act: &Do) -> (&'static str, Map<String, Value>) {
    match act {
        Do::Cursor { to, by } => ("cursor", object(&CursorKeys { to: place(*to), by: *by })),
        Do::Mouse(change) => ("mouse", object(&mouse_keys(change))),
        Do::Grab(reach) => ("grab", object(&grab_keys(reach))),
        Do::Release => ("release", Map::new()),
        Do::Key { key, down } => {
            ("key", Map::from_iter([("key".to_owned(), key.name().into()), ("down".to_owned(), (*down).into())]))
        }
        Do::Pin(list) => ("pin", object(&PointsKeys { points: numbers(list) })),
        Do::Unpin(list) => ("unpin", object(&PointsKeys { points: numbers(list) })),
        Do::Cut { from, to } => ("cut", object(&CutKeys { from: end(*from), to: end(*to) })),
        Do::Split { points, bonds } => {
            let bonds = bonds.iter().map(|bond| bond.0).collect();
            ("split", object(&SplitKeys { points: numbers(points), bonds }))
        }
        Do::Add(keys) => ("add", object(&**keys)),
        Do::Delete(keys) => ("delete", object(keys)),
        Do::Clear => ("clear", Map::new()),
        Do::Move(keys) => ("move", object(&**keys)),
        Do::Set(keys) => ("set", object(&**keys)),
        Do::Group { points, name } => ("group", object(&GroupKeys { points: numbers(points), name: name.clone() })),
    }
}

fn object(keys: &impl Serialize) -> Map<String, Value> {
    match serde_json::to_value(keys) {
        Ok(Value::Object(object)) => object,
        // Keys are objects of finite numbers, which can always be said.
        _ => Map::new(),
    }
}

/// What is done, by its name and its keys.
fn act(name: &str, object: Map<String, Value>) -> Result<Do, String> {
    Ok(match name {
        "cursor" => {
            let CursorKeys { to, by } = read(object)?;
            Do::Cursor { to: cursor(to)?, by }
        }
        "mouse" => Do::Mouse(mouse_change(read(object)?)),
        "grab" => Do::Grab(reach(read(object)?)?),
        "release" => read::<Nothing>(object).map(|_| Do::Release)?,
        "key" => {
            let KeyKeys { key, down } = read(object)?;
            let key = Key::of(key.name()).ok_or("key: is none")?;
            Do::Key { key, down }
        }
        "pin" => Do::Pin(points(read::<PointsKeys>(object)?.points)),
        "unpin" => Do::Unpin(points(read::<PointsKeys>(object)?.points)),
        "cut" => {
            let CutKeys { from, to } = read(object)?;
            Do::Cut { from: from.cursor("from")?, to: to.cursor("to")? }
        }
        "split" => {
            let SplitKeys { points: doubled, bonds } = read(object)?;
            Do::Split { points: points(doubled), bonds: bonds.into_iter().map(BondId).collect() }
        }
        "add" => Do::Add(Box::new(read(object)?)),
        "delete" => Do::Delete(read(object)?),
        "clear" => read::<Nothing>(object).map(|_| Do::Clear)?,
        "move" => Do::Move(Box::new(read(object)?)),
        "set" => Do::Set(Box::new(read(object)?)),
        "group" => {
            let GroupKeys { points: list, name } = read(object)?;
            Do::Group { points: points(list), name: one_line(&name) }
        }
        _ => return Err(format!("do: `{name}` is nothing that is done here: give one of {}", NAMES.join(", "))),
    })
}

/// Errors: in words, with the key.
fn read<T: DeserializeOwned>(object: Map<String, Value>) -> Result<T, String> {
    serde_path_to_error::deserialize(Value::Object(object)).map_err(|error| {
        let (path, message) = (error.path().to_string(), translate(error.inner()));
        if path == "." { message } else { format!("{path}: {message}") }
    })
}

fn place(to: Option<Cursor>) -> Place {
    match to {
        None => Place::Gone(()),
        Some(Cursor { origin: [x, y, _], .. }) if to == Some(Cursor::at([x, y])) => Place::Plane([x, y]),
        Some(Cursor { origin, direction }) => Place::Ray(RayKeys { origin: Row(origin), direction: Row(direction) }),
    }
}

/// How far from 1 the length of a direction may be.
const UNIT: f64 = 1e-6;

fn cursor(to: Place) -> Result<Option<Cursor>, String> {
    Ok(match to {
        Place::Gone(()) => None,
        Place::Plane(at) => Some(Cursor::at(at)),
        Place::Ray(ray) => Some(ray.cursor("to")?),
    })
}

impl RayKeys {
    /// Errors: a direction that is no unit vector, by the name of the ray.
    fn cursor(self, name: &str) -> Result<Cursor, String> {
        let RayKeys { origin: Row(origin), direction: Row(direction) } = self;
        let length = direction.iter().map(|d| d * d).sum::<f64>().sqrt();
        if (length - 1.0).abs() > UNIT {
            return Err(format!("{name}.direction: has length {length:?}: give a unit vector"));
        }
        Ok(Cursor { origin, direction })
    }
}

impl End {
    /// Errors: as of a ray.
    fn cursor(self, name: &str) -> Result<Cursor, String> {
        match self {
            End::Plane(at) => Ok(Cursor::at(at)),
            End::Ray(ray) => ray.cursor(name),
        }
    }
}

fn end(at: Cursor) -> End {
    match at {
        Cursor { origin: [x, y, _], .. } if at == Cursor::at([x, y]) => End::Plane([x, y]),
        Cursor { origin, direction } => End::Ray(RayKeys { origin: Row(origin), direction: Row(direction) }),
    }
}

fn mouse_keys(change: &MouseChange) -> MouseKeys {
    MouseKeys {
        strength: change.strength,
        radius: change.radius,
        region: change.region.map(|region| match region {
            Region::Round => RegionName::Round,
            Region::Square => RegionName::Square,
        }),
        profile: change.profile.map(|profile| match profile {
            Profile::Smooth => ProfileName::Smooth,
            Profile::Linear => ProfileName::Linear,
        }),
        track: change.ends_track.then_some(()),
    }
}

fn mouse_change(keys: MouseKeys) -> MouseChange {
    MouseChange {
        strength: keys.strength,
        radius: keys.radius,
        region: keys.region.map(|region| match region {
            RegionName::Round => Region::Round,
            RegionName::Square => Region::Square,
        }),
        profile: keys.profile.map(|profile| match profile {
            ProfileName::Smooth => Profile::Smooth,
            ProfileName::Linear => Profile::Linear,
        }),
        ends_track: keys.track.is_some(),
    }
}

fn grab_keys(reach: &Reach) -> GrabKeys {
    match reach {
        Reach::Points(list) => GrabKeys { points: Some(numbers(list)), ..GrabKeys::default() },
        Reach::Within(within) => GrabKeys { within: Some(*within), ..GrabKeys::default() },
        Reach::Patch { points, torn_beyond } => {
            GrabKeys { points: Some(numbers(points)), torn_beyond: Some(*torn_beyond), ..GrabKeys::default() }
        }
    }
}

fn reach(keys: GrabKeys) -> Result<Reach, String> {
    match (keys.points, keys.within) {
        (Some(list), None) => Ok(match keys.torn_beyond {
            Some(torn_beyond) => Reach::Patch { points: points(list), torn_beyond },
            None => Reach::Points(points(list)),
        }),
        (None, Some(_)) if keys.torn_beyond.is_some() => {
            Err("torn_beyond: is of a grab of `points`: leave it out".to_owned())
        }
        (None, Some(within)) => Ok(Reach::Within(within)),
        (None, None) => Err("takes nothing: give `points` or `within`".to_owned()),
        (Some(_), Some(_)) => Err("within: stands beside `points`: leave one of them out".to_owned()),
    }
}
