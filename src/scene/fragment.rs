//! A part of a scene as text: bodies and obstacles that go from one program to another by the clipboard.

use std::ops::Range;

use super::check::check_pin_motion;
use super::error::{Source, Within};
use super::keys::{AddKeys, ContactKeys, PointGroupKeys, Vector};
use super::pictures::is_inline;

/// What the text begins with, and the version of it.
const KEY: &str = "wobble_clip";
const VERSION: u64 = 1;
/// Longest text `[bytes]`: a million points in bonds are about as long.
const LONGEST: usize = 256 << 20;
/// Most points.
const MOST_POINTS: usize = 1_000_000;
/// How far from the origin points may be `[m]`: as places of a scene may.
const FARTHEST: f64 = 1e9;

/// Points, bonds, angles, triangles, skins, forces, pictures, groups and obstacles, counted from 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Fragment {
    /// What is in it.
    pub keys: AddKeys,
    /// How bodies met where it was copied; `None`: they did not.
    pub contact: Option<ContactKeys>,
    /// Points that are selected as one.
    pub groups: Vec<PointGroupKeys>,
    /// 2 or 3.
    pub dimensions: usize,
    /// The middle of all of it `[m]`.
    pub middle: [f64; 3],
}

impl Fragment {
    /// Whether a text says that it is one.
    pub fn is_one(text: &str) -> bool {
        let start = text.trim_start().strip_prefix('{').map(str::trim_start);
        start.and_then(|start| start.strip_prefix('"')).is_some_and(|start| start.starts_with(KEY))
    }

    /// As text: its first key says what it is. `None`: more than a text may have.
    pub fn to_text(&self) -> Option<String> {
        if self.point_count() > MOST_POINTS {
            return None;
        }
        let keys = serde_json::to_string(&self.keys).ok()?;
        let middle = serde_json::to_string(&self.middle[..self.dimensions]).ok()?;
        let rest = keys.strip_prefix('{')?;
        let contact = match &self.contact {
            Some(contact) => format!(",\"contact\":{}", serde_json::to_string(contact).ok()?),
            None => String::new(),
        };
        let groups = match &self.groups[..] {
            [] => String::new(),
            groups => format!(",\"groups\":{}", serde_json::to_string(groups).ok()?),
        };
        let comma = if rest == "}" { "" } else { "," };
        let text = format!(
            "{{\"{KEY}\":{VERSION},\"dimensions\":{},\"middle\":{middle}{contact}{groups}{comma}{rest}",
            self.dimensions
        );
        (text.len() <= LONGEST).then_some(text)
    }

    /// Reads a text.
    ///
    /// Errors: in words, why it is none: too long, no JSON, of a later version, a key that is none, numbers of points that are not in it.
    pub fn parse(text: &str) -> Result<Self, String> {
        let about = "the bodies on the clipboard cannot be read";
        if text.len() > LONGEST {
            return Err(format!("{about}: {} MiB of text, and {} is the most", text.len() >> 20, LONGEST >> 20));
        }
        let all: serde_json::Value = serde_json::from_str(text)
            .map_err(|error| format!("{about}: the text is broken ({error}): copy them again"))?;
        let serde_json::Value::Object(mut all) = all else { return Err(format!("{about}: the text is no object")) };
        match all.remove(KEY).and_then(|version| version.as_u64()) {
            Some(VERSION) => {}
            Some(other) => {
                return Err(format!("{about}: `{KEY}` is {other}, and this program reads {VERSION}: use a newer one"));
            }
            None => return Err(format!("{about}: `{KEY}` is missing, or no version")),
        }
        let dimensions = match all.remove("dimensions").and_then(|of| of.as_u64()) {
            Some(of @ 2..=3) => of as usize,
            _ => return Err(format!("{about}: `dimensions` is neither 2 nor 3")),
        };
        let middle: Vec<f64> = all.remove("middle").and_then(|of| serde_json::from_value(of).ok()).unwrap_or_default();
        if middle.len() != dimensions || !middle.iter().all(|x| x.abs() <= FARTHEST) {
            return Err(format!("{about}: `middle` is not {dimensions} numbers"));
        }
        let contact: Option<ContactKeys> = match all.remove("contact").map(serde_json::from_value) {
            Some(Err(error)) => return Err(format!("{about}: contact: {error}")),
            Some(Ok(contact)) => contact,
            None => None,
        };
        let groups: Vec<PointGroupKeys> = match all.remove("groups").map(serde_json::from_value) {
            Some(Err(error)) => return Err(format!("{about}: groups: {error}")),
            Some(Ok(groups)) => groups,
            None => Vec::new(),
        };
        let keys: AddKeys = serde_path_to_error::deserialize(serde_json::Value::Object(all))
            .map_err(|error| format!("{about}: {}: {}", error.path(), error.inner()))?;
        let mut place = [0.0; 3];
        place[..dimensions].copy_from_slice(&middle);
        let fragment = Fragment { keys, contact, groups, dimensions, middle: place };
        fragment.check().map_err(|why| format!("{about}: {why}"))?;
        Ok(fragment)
    }

    /// How many points it has.
    pub fn point_count(&self) -> usize {
        self.keys.points.as_ref().map_or(0, |points| points.position.len())
    }

    /// Errors: what names points that are not in it, lies too far off, or comes by other keys than what is copied.
    fn check(&self) -> Result<(), String> {
        let AddKeys { points, bonds, bodies, triangles, skins, forces, angles, obstacles, pin_motion, textures, looks } =
            &self.keys;
        if !bodies.is_empty() {
            return Err("`bodies` are not copied: give their points and bonds".to_owned());
        }
        if textures.iter().any(|texture| !is_inline(&texture.image)) {
            return Err("`textures` names a file: give its picture itself, as data:image/png;base64,…".to_owned());
        }
        let count = self.point_count();
        if count > MOST_POINTS {
            return Err(format!("it has {count} points, and {MOST_POINTS} are the most"));
        }
        let places = points.iter().flat_map(|points| &points.position);
        let is_near = |x: &Vector| x.embed().iter().all(|part| part.abs() <= FARTHEST);
        let fits = |x: &Vector| matches!((x, self.dimensions), (Vector::Plane(_), 2) | (Vector::Space(_), 3));
        if let Some(far) = places.clone().position(|x| !fits(x) || !is_near(x)) {
            let dimensions = self.dimensions;
            return Err(format!("points.position[{far}] is not {dimensions} numbers of at most {FARTHEST:e} m"));
        }
        let velocities = points.iter().flat_map(|points| points.velocity.iter().flatten());
        if let Some(wild) = velocities.into_iter().position(|v| !is_near(v)) {
            return Err(format!("points.velocity[{wild}] is more than {FARTHEST:e} m/s"));
        }
        let pins: Vec<u32> = points.iter().flat_map(|points| points.pinned.iter().copied()).collect();
        for (i, motion) in pin_motion.iter().enumerate() {
            check_pin_motion(motion, self.dimensions, &|point| pins.contains(&point))
                .item(i)
                .at("pin_motion")
                .map_err(|fault| Source::default().error(fault).to_string())?;
            if motion.track.iter().flatten().any(|x| x.abs() > FARTHEST) {
                return Err(format!("pin_motion[{i}].track has a number of more than {FARTHEST:e}"));
            }
        }
        if count == 0 && obstacles.is_empty() {
            return Err("there is nothing in it".to_owned());
        }
        let known: Range<u32> = 0..count as u32;
        let named: [(&str, Vec<u32>); 9] = [
            ("points.pinned", pins),
            ("bonds", bonds.iter().flat_map(|bond| [bond.a, bond.b]).collect()),
            ("triangles", triangles.iter().flat_map(|corners| corners.0).collect()),
            ("angles", angles.iter().flat_map(|angle| angle.points.0).collect()),
            ("skins", skins.iter().flat_map(|skin| skin.points.iter().copied()).collect()),
            ("forces", forces.iter().flat_map(|force| force.points.iter().copied()).collect()),
            ("textures", textures.iter().flat_map(|texture| texture.points.iter().copied()).collect()),
            ("looks", looks.iter().flat_map(|look| look.points.iter().copied()).collect()),
            ("groups", self.groups.iter().flat_map(|group| group.points.iter().copied()).collect()),
        ];
        for (key, list) in named {
            if let Some(other) = list.into_iter().find(|point| !known.contains(point)) {
                return Err(format!("`{key}` names point {other}, and there are {count}"));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    const TEXT: &str = r#"{"wobble_clip":1,"dimensions":2,"middle":[0.1,-0.0],"contact":{"friction":0.3},"groups":[{"points":[0,1],"title":"pair"}],
        "points":{"position":[[0.1,0.30000000000000004],[1e-320,2]],"pinned":[1]},"bonds":[{"a":0,"b":1,"rest":0.7}],
        "textures":[{"image":"data:image/png;base64,AA==","points":[0,1],"uv":[[0,0.5],[1,1]]}],
        "looks":[{"points":[1,0],"title":"doll","hue":2}]}"#;

    #[test]
    fn a_text_is_read_as_it_was_written_to_the_bit() {
        let fragment = Fragment::parse(TEXT).unwrap();
        let text = fragment.to_text().unwrap();
        assert!(Fragment::is_one(&text) && text.starts_with("{\"wobble_clip\":1,"), "{text}");
        let again = Fragment::parse(&text).unwrap();
        assert_eq!(again, fragment);
        assert_eq!(again.to_text().unwrap(), text);
        let bits = |fragment: &Fragment| {
            let points = fragment.keys.points.as_ref().unwrap();
            points.position.iter().flat_map(Vector::embed).chain(fragment.middle).map(f64::to_bits).collect::<Vec<_>>()
        };
        assert_eq!(bits(&again), bits(&fragment));
        assert_eq!(bits(&again)[3], 1e-320_f64.to_bits());
    }

    #[test]
    fn what_is_broken_says_where() {
        let changed = |from: &str, to: &str| Fragment::parse(&TEXT.replace(from, to)).unwrap_err();
        for (from, to, said) in [
            ("\"bonds\"", "bonds", "broken"),
            ("clip\":1", "clip\":2", "use a newer one"),
            ("dimensions\":2", "dimensions\":4", "neither 2 nor 3"),
            ("\"b\":1", "\"b\":2", "`bonds` names point 2, and there are 2"),
            ("\"b\":1", "\"b\":-1", "bonds[0].b"),
            ("\"a\":0", "\"q\":0", "bonds[0]"),
            ("\"friction\":0.3", "\"fiction\":0.3", "contact: "),
            ("[0,1],\"title", "[0,2],\"title", "`groups` names point 2"),
            ("[0,1],\"uv", "[0,9],\"uv", "`textures` names point 9"),
            ("[1,0]", "[1,3]", "`looks` names point 3"),
            ("data:image/png;base64,AA==", "secret.png", "names a file"),
            ("[1]", "[4294967295]", "`points.pinned` names point 4294967295"),
            ("1e-320,2", "1e300,2", "points.position[1]"),
            ("1e-320,2", "1,2,3", "points.position[1]"),
            ("\"pinned\"", "\"velocity\":[[0,0],[0,1e308]],\"pinned\"", "points.velocity[1]"),
            ("\"bonds\"", "\"pin_motion\":[{\"point\":0,\"track\":[[0,0,0]]}],\"bonds\"", "point 0 is not pinned"),
            ("\"bonds\"", "\"pin_motion\":[{\"point\":1,\"track\":[[0,0]]}],\"bonds\"", "pin_motion[0].track[0]"),
            ("\"bonds\"", "\"pin_motion\":[{\"point\":1,\"track\":[[0,0,2e9]]}],\"bonds\"", "more than 1e9"),
            ("[0.1,-0.0]", "[0.1]", "`middle` is not 2 numbers"),
        ] {
            let line = changed(from, to);
            assert!(line.contains(said), "{to}: {line}");
        }
        assert!(Fragment::parse("[1]").is_err() && Fragment::parse("").is_err());
        assert!(!Fragment::is_one("{\"wobble\": 1}") && Fragment::is_one(" {\n \"wobble_clip\": 1}"));
    }
}
