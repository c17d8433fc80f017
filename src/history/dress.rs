//! What belongs to a world and no step knows of: skins, how bodies are drawn, points that are named together, and labels.

use std::sync::Arc;

use super::pack::Packed;
use crate::picture::{self, Coat, HUES, Picture, Skin, Tint};
use crate::scene::{Known, LabelKeys, Scene, SceneError, one_line};
use crate::sim::{Dynamics, PointId};

/// Points that are selected and deleted as one.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// What they are called.
    pub name: String,
    /// Those that are left.
    pub points: Vec<PointId>,
}

/// The groups that a scene has at its start: those without a title are counted.
fn groups(scene: &Scene) -> Vec<Group> {
    let mut list: Vec<Group> = Vec::new();
    for keys in &scene.groups {
        let is_free = |name: &String| {
            let is_said = scene.groups.iter().any(|group| group.title.as_ref() == Some(name));
            !is_said && list.iter().all(|group| group.name != *name)
        };
        let counted = || (1..).map(|k| format!("group {k}")).find(is_free);
        let Some(name) = keys.title.clone().or_else(counted) else { continue };
        let mut points: Vec<PointId> = keys.points.iter().copied().map(PointId).collect();
        points.sort_unstable();
        points.dedup();
        list.push(Group { name, points });
    }
    list
}

/// The numbers that bodies get from the next one on: where one is to have a hue, the first that has it.
fn numbers(mut next: u32, known: &[Known]) -> Vec<u32> {
    let number = |body: &Known| {
        let has_it = |number: &u32| body.hue.is_none_or(|hue| picture::hue(*number) == hue);
        let number = (next..next.saturating_add(2 * HUES)).find(has_it).unwrap_or(next);
        next = number + 1;
        number
    };
    known.iter().map(number).collect()
}

/// How a body without a colour of its own is written.
const NO_COLOR: u32 = u32::MAX;

/// Skins, colours, groups and labels of a world. Copies share what they have.
#[derive(Clone, Debug, Default)]
pub(super) struct Dress {
    worn: Arc<Vec<Skin>>,
    /// So many of them are the scene's own.
    of_scene: usize,
    /// Which body points are of, and what colour it has.
    tints: Arc<[Tint]>,
    /// What bodies are called, by their numbers, of those of which it is known.
    names: Arc<Vec<Option<String>>>,
    /// Bodies or colours came after the start.
    is_tinted: bool,
    /// Numbers of points and names, newest last.
    groups: Arc<Vec<Group>>,
    /// Words that stand in the world.
    labels: Arc<Vec<LabelKeys>>,
}

impl Dress {
    /// That of a scene at its start.
    ///
    /// Errors: a picture that is not there or is none.
    pub(super) fn new(scene: &Scene) -> Result<Self, SceneError> {
        let mut dress = Dress::default();
        dress.wear(scene.skins()?);
        dress.of_scene = dress.worn.len();
        dress.tints = scene.tints()?.into();
        dress.names = Arc::new(scene.body_names()?);
        dress.groups = Arc::new(groups(scene));
        dress.labels = Arc::new(scene.labels.clone());
        Ok(dress)
    }

    /// Skins come.
    pub(super) fn wear(&mut self, skins: Vec<Skin>) {
        if !skins.is_empty() {
            Arc::make_mut(&mut self.worn).extend(skins);
        }
    }

    /// Bodies come, counted from 0, with what they are called and the hues that they have; points get coats.
    pub(super) fn tint(&mut self, (mut tints, known): (Vec<Tint>, Vec<Known>), coats: &[(Vec<u32>, Coat)]) {
        if tints.is_empty() && coats.is_empty() {
            return;
        }
        let next = self.tints.iter().map(|tint| tint.body + 1).max().unwrap_or(0);
        if !tints.is_empty() {
            let numbers = numbers(next, &known);
            let names = Arc::make_mut(&mut self.names);
            names.resize(next as usize, None);
            for (number, Known { name, .. }) in numbers.iter().zip(known) {
                names.resize(*number as usize, None);
                names.push(name);
            }
            let number = |body: u32| numbers.get(body as usize).copied().unwrap_or(next + body);
            tints.iter_mut().for_each(|tint| tint.body = number(tint.body));
        }
        let mut all = self.tints.to_vec();
        // What was painted up to the last point ends where new ones begin.
        if let Some(first) = tints.first() {
            all.retain(|tint| tint.first < first.first);
        }
        all.extend(tints);
        coats.iter().for_each(|(points, coat)| Tint::paint(&mut all, points, *coat));
        (self.tints, self.is_tinted) = (all.into(), true);
    }

    /// Copies of points come, from this number on, in the order of these: they look as those do, and are of the same bodies.
    pub(super) fn double(&mut self, points: &[PointId], first: u32) {
        let mut points = points.to_vec();
        points.sort_unstable();
        points.dedup();
        let own =
            |(point, number): (PointId, u32)| Tint::of(&self.tints, point.0).map(|run| Tint { first: number, ..*run });
        let copies: Vec<Tint> = points.into_iter().zip(first..).filter_map(own).collect();
        let Some(begin) = copies.first().map(|run| run.first) else { return };
        let mut all = self.tints.to_vec();
        all.retain(|tint| tint.first < begin);
        all.extend(copies);
        (self.tints, self.is_tinted) = (all.into(), true);
    }

    /// Which body points are of, those that were added too.
    pub(super) fn tints(&self) -> &Arc<[Tint]> {
        &self.tints
    }

    /// What bodies are called, by their numbers.
    pub(super) fn names(&self) -> &[Option<String>] {
        &self.names
    }

    /// How many pictures were put on triangles, one on another too.
    pub(super) fn worn(&self) -> usize {
        self.worn.len()
    }

    /// Whether anything is drawn on triangles.
    pub(super) fn has_skins(&self) -> bool {
        !self.worn.is_empty()
    }

    /// The skins as they are now, on the triangles that the world has left.
    pub(super) fn skins(&self, world: &dyn Dynamics) -> Vec<Skin> {
        if !self.has_skins() {
            return Vec::new();
        }
        // Whichever corner is named first, and whichever way round.
        let key = |mut corners: [u32; 3]| {
            corners.sort_unstable();
            corners
        };
        let mut left: Vec<[u32; 3]> =
            world.triangles().iter().map(|corners| key(corners.map(|corner| corner.0))).collect();
        left.sort_unstable();
        // What came later is drawn in place of what was there.
        let mut is_drawn = vec![false; left.len()];
        let mut of = |skin: &Skin| {
            let mut is_left = |corners: &[u32; 3]| {
                let place = left.binary_search(&key(*corners));
                place.is_ok_and(|place| !std::mem::replace(&mut is_drawn[place], true))
            };
            let triangles: Vec<[u32; 3]> = skin.triangles.iter().copied().filter(|corners| is_left(corners)).collect();
            (!triangles.is_empty()).then(|| Skin { triangles, ..skin.clone() })
        };
        let mut skins: Vec<Skin> = self.worn.iter().rev().filter_map(&mut of).collect();
        skins.reverse();
        skins
    }

    /// What skins that came after the start of the scene are drawn on.
    pub(super) fn added_triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        self.worn[self.of_scene..].iter().flat_map(|skin| skin.triangles.iter().copied())
    }

    /// Points get a name; what was called so before is no more.
    pub(super) fn group(&mut self, name: &str, points: &[PointId]) {
        let groups = Arc::make_mut(&mut self.groups);
        groups.retain(|group| group.name != name);
        groups.push(Group { name: name.to_owned(), points: points.to_vec() });
    }

    /// Other words stand in the world, each on one line. Returns whether they differ from those before.
    pub(super) fn label(&mut self, labels: &[LabelKeys]) -> bool {
        let tidy = |label: &LabelKeys| LabelKeys { text: one_line(&label.text), ..label.clone() };
        let labels: Vec<LabelKeys> = labels.iter().map(tidy).collect();
        let differ = *self.labels != labels;
        if differ {
            self.labels = Arc::new(labels);
        }
        differ
    }

    /// The words that stand in the world, those of points that are gone too.
    pub(super) fn labels(&self) -> &Arc<Vec<LabelKeys>> {
        &self.labels
    }

    /// The groups as they were named, whatever is left of their points.
    pub(super) fn named(&self) -> &Arc<Vec<Group>> {
        &self.groups
    }

    /// The groups, of the points that are left; none without.
    pub(super) fn groups(&self, world: &dyn Dynamics) -> Vec<Group> {
        let is_left = |point: &PointId| world.gone().binary_search(point).is_err();
        let left = |group: &Group| Group {
            name: group.name.clone(),
            points: group.points.iter().copied().filter(is_left).collect(),
        };
        self.groups.iter().map(left).filter(|group| !group.points.is_empty()).collect()
    }

    /// Puts what came after the start of the scene behind the bytes: each picture once, then what is drawn of them.
    ///
    /// Errors: in words, a picture that cannot be written.
    pub(super) fn put_added(&self, to: &mut Vec<u8>) -> Result<(), String> {
        let added = &self.worn[self.of_scene..];
        let mut pictures: Vec<&Arc<Picture>> = Vec::new();
        for skin in added {
            if !pictures.iter().any(|other| Arc::ptr_eq(other, &skin.picture)) {
                pictures.push(&skin.picture);
            }
        }
        pictures.len().put(to);
        for one in &pictures {
            picture::encode(one).map_err(|error| error.to_string())?.put(to);
        }
        added.len().put(to);
        for Skin { picture, first, triangles, texture } in added {
            pictures.iter().position(|other| Arc::ptr_eq(other, picture)).unwrap_or_default().put(to);
            first.put(to);
            texture.put(to);
            triangles.put(to);
        }
        let added: &[Tint] = if self.is_tinted { &self.tints } else { &[] };
        added.len().put(to);
        for Tint { first, body, color, width, is_hidden } in added {
            first.put(to);
            body.put(to);
            color.map_or(NO_COLOR, |[red, green, blue]| u32::from_be_bytes([0, red, green, blue])).put(to);
            width.put(to);
            is_hidden.put(to);
        }
        let names: &[Option<String>] = if self.is_tinted { &self.names } else { &[] };
        serde_json::to_vec(names).map_err(|error| error.to_string())?.put(to);
        Ok(())
    }

    /// Takes what bodies are called from the front of the bytes, where anything is said; `None` where they are not enough, or none of it.
    pub(super) fn take_names(&mut self, from: &mut &[u8]) -> Option<()> {
        let names: Vec<Option<String>> = serde_json::from_slice(&Vec::<u8>::take(from)?).ok()?;
        if !names.is_empty() {
            self.names = Arc::new(names);
        }
        Some(())
    }

    /// Takes what came after the start of the scene from the front of the bytes, of a world of `points` points; `has_sides`: behind the
    /// triangles are the bonds along their sides, which are passed over; `has_tints`: bodies and colours come last; `has_coats`: each
    /// with its width and whether it is hidden. `None` where the bytes are not enough, or none of it.
    pub(super) fn take_added(
        &mut self,
        from: &mut &[u8],
        points: usize,
        [has_sides, has_tints, has_coats]: [bool; 3],
    ) -> Option<()> {
        let mut pictures = Vec::new();
        for _ in 0..usize::take(from)? {
            pictures.push(Arc::new(picture::decode(&Vec::take(from)?).ok()?));
        }
        for _ in 0..usize::take(from)? {
            let picture = Arc::clone(pictures.get(usize::take(from)?)?);
            let (first, texture) = (u32::take(from)?, Vec::<[f32; 2]>::take(from)?);
            let triangles = Vec::<[u32; 3]>::take(from)?;
            if has_sides && Vec::<[u32; 3]>::take(from)?.len() != triangles.len() {
                return None;
            }
            let end = (first as usize).checked_add(texture.len())?.min(points);
            let fits = |corner: &u32| (first as usize..end).contains(&(*corner as usize));
            if !triangles.iter().flatten().all(fits) {
                return None;
            }
            Arc::make_mut(&mut self.worn).push(Skin { picture, first, triangles, texture });
        }
        let count = if has_tints { usize::take(from)? } else { 0 };
        let mut tints: Vec<Tint> = Vec::new();
        for _ in 0..count {
            let (first, body, color) = (u32::take(from)?, u32::take(from)?, u32::take(from)?);
            let (width, is_hidden) = if has_coats { (f64::take(from)?, bool::take(from)?) } else { (0.0, false) };
            if tints.last().is_some_and(|last| last.first >= first) || !(width >= 0.0 && width.is_finite()) {
                return None;
            }
            let [_, red, green, blue] = color.to_be_bytes();
            let color = (color != NO_COLOR).then_some([red, green, blue]);
            tints.push(Tint { first, body, color, width, is_hidden });
        }
        if !tints.is_empty() {
            (self.tints, self.is_tinted) = (tints.into(), true);
        }
        Some(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::{Do, History, Log, Replay, SetKeys, Start};
    use super::*;
    use crate::scene::{AddKeys, PointKeys, Vector};

    const SCENE: &str =
        r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0]]}, "labels": [{"at": [0, 1], "text": "first"}]}"#;

    fn history() -> History {
        History::new(Scene::parse(SCENE, "x.json").unwrap().into()).unwrap()
    }

    fn label(text: &str, point: Option<u32>) -> LabelKeys {
        LabelKeys { at: Vector::Plane([0.5, 0.25]), text: text.to_owned(), point }
    }

    fn set(labels: Vec<LabelKeys>) -> Vec<Do> {
        vec![Do::Set(Box::new(SetKeys { labels: Some(labels), ..SetKeys::default() }))]
    }

    fn words(labels: &[LabelKeys]) -> Vec<&str> {
        labels.iter().map(|label| label.text.as_str()).collect()
    }

    #[test]
    fn labels_are_set_undone_done_again_and_recorded() {
        let mut history = history();
        assert_eq!(words(history.labels()), ["first"]);
        history.step();
        history.give(set(vec![label("other\nwords", None), label("third", Some(1))]), Some("labels")).unwrap();
        assert_eq!(words(history.labels()), ["other words", "third"]);
        history.step();
        let mut text = Vec::new();
        history.recording().write_json(&mut text).unwrap();
        let log = Log::of_text(&String::from_utf8(text).unwrap(), "x.json").unwrap();
        assert_eq!(log.commands().unwrap(), history.recording().commands);
        let mut replay = Replay::new(log.head().unwrap(), "x.json").unwrap();
        replay.advance(&log.commands().unwrap(), history.end()).unwrap();
        assert_eq!(replay.labels(), history.labels());
        assert_eq!(history.undo().unwrap().name, "labels");
        assert_eq!(words(history.labels()), ["first"]);
        history.redo().unwrap();
        assert_eq!(words(history.labels()), ["other words", "third"]);
        history.give(set(Vec::new()), Some("labels")).unwrap();
        assert!(history.labels().is_empty());
        history.give(set(Vec::new()), Some("labels")).unwrap();
        history.undo().unwrap();
        assert_eq!(history.labels().len(), 2, "what changes nothing is nothing to undo");
        history.reset();
        assert_eq!(
            (history.world().time(), history.labels().len()),
            (0.0, 2),
            "they are settings: they hold from the start"
        );
    }

    #[test]
    fn a_moment_has_the_labels_that_it_had_those_of_points_that_came_later_too() {
        let mut history = history();
        let as_it_was = Start::from(history.snapshot().unwrap());
        assert!(as_it_was.recording().commands.is_empty(), "what the scene says is not said again");
        history.step();
        let keys =
            PointKeys { position: vec![Vector::Plane([3.0, 0.0])], velocity: None, mass: None, pinned: Vec::new() };
        history
            .give(vec![Do::Add(Box::new(AddKeys { points: Some(keys), ..AddKeys::default() }))], Some("add"))
            .unwrap();
        history.give(set(vec![label("of the new one", Some(2))]), Some("labels")).unwrap();
        let moment = Start::from(history.snapshot().unwrap());
        assert!(!moment.is_replayed(), "nothing is done in it");
        let moment = History::new(moment).unwrap();
        assert_eq!(moment.labels(), history.labels());
    }

    #[test]
    fn labels_that_no_scene_could_have_are_refused_and_leave_those_before() {
        for (labels, about) in [
            (vec![label(" ", None)], "labels[0].text: is empty"),
            (vec![label("x", Some(2))], "labels[0].point: point 2 does not exist"),
            (vec![label("x", None); 101], "labels: has 101 entries"),
            (vec![LabelKeys { at: Vector::Space([0.0; 3]), ..label("x", None) }], "labels[0].at: has 3 numbers"),
        ] {
            let mut history = history();
            let refusal = history.give(set(labels), Some("labels")).unwrap_err();
            assert!(refusal.reason.to_string().starts_with(about), "{:?}", refusal.reason);
            assert_eq!(words(history.labels()), ["first"]);
        }
    }
}
