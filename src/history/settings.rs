//! Which edits of a log are settings: numbers of bodies and of the scene, which hold from the start when that is gone to.

use super::command::{Do, Entry, SetKeys};
use crate::scene::AddKeys;

impl Entry {
    /// Whether it sets numbers or looks, and no more. An edit is a setting where all of its commands are: bodies that come make others meet.
    pub(super) fn is_setting(&self) -> bool {
        match &self.act {
            Do::Mouse(_) => true,
            Do::Add(keys) => is_look(keys),
            Do::Set(keys) => sets_something(&SetKeys { velocity: None, ..(**keys).clone() }),
            _ => false,
        }
    }

    /// Whether something comes by it, or is put or held somewhere from then on.
    pub(super) fn builds(&self) -> bool {
        match &self.act {
            Do::Add(_) => !self.is_setting(),
            Do::Pin(_) => true,
            Do::Move(keys) => keys.over.is_none(),
            _ => false,
        }
    }

    /// The same at the start, where a world has the numbers below these of points, bonds and obstacles; `None`: it is no setting, or of
    /// nothing that is there.
    pub(super) fn at_start(&self, start: f64, next: [u32; 3]) -> Option<Entry> {
        let act = match &self.act {
            _ if !self.is_setting() => return None,
            Do::Set(keys) => Do::Set(Box::new(numbers_at_start(keys, next)?)),
            act => act.clone(),
        };
        self.edit.map(|edit| Entry { at: start, act, edit: Some(edit), name: self.name.clone() })
    }

    /// Whether another of the same drag sets the same numbers of the same things.
    pub(super) fn is_superseded_by(&self, later: &Entry) -> bool {
        let (Do::Set(own), Do::Set(other)) = (&self.act, &later.act) else { return false };
        self.edit == later.edit && numbers_aside(own) == numbers_aside(other)
    }
}

/// Whether keys bring nothing but looks.
fn is_look(keys: &AddKeys) -> bool {
    *keys == AddKeys { skins: keys.skins.clone(), ..AddKeys::default() }
}

/// What is set, of what a world has at its start, and there at once. How fast points are is no setting.
fn numbers_at_start(keys: &SetKeys, [points, bonds, _]: [u32; 3]) -> Option<SetKeys> {
    let mut keys = SetKeys { over: None, velocity: None, ..keys.clone() };
    // Those that go along with what is not there would have all of them refused.
    keys.labels.iter_mut().for_each(|labels| labels.retain(|label| label.point.is_none_or(|point| point < points)));
    let (named, next) = match (&keys.points, &keys.bonds) {
        (Some(named), _) => (named, points),
        (None, Some(named)) => (named, bonds),
        (None, None) => return sets_something(&keys).then_some(keys),
    };
    let stays: Vec<bool> = named.iter().map(|number| *number < next).collect();
    let keys = keys.among(&stays);
    (stays.contains(&true) && sets_something(&keys)).then_some(keys)
}

/// Whether keys name more than what they are of.
fn sets_something(keys: &SetKeys) -> bool {
    let SetKeys { points, bonds, obstacles, forces, angles, .. } = keys.clone();
    *keys != SetKeys { points, bonds, obstacles, forces, angles, ..SetKeys::default() }
}

/// The names of the keys, and what they are of: all but the numbers themselves.
fn numbers_aside(keys: &SetKeys) -> (Vec<String>, [Option<&Vec<u32>>; 5]) {
    let names = match serde_json::to_value(keys) {
        Ok(serde_json::Value::Object(object)) => object.into_iter().map(|(name, _)| name).collect(),
        // Keys are objects of finite numbers, which can always be said.
        _ => Vec::new(),
    };
    let SetKeys { points, bonds, obstacles, forces, angles, .. } = keys;
    (names, [points, bonds, obstacles, forces, angles].map(Option::as_ref))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::command::{OneOrEach, VectorOrEach};
    use super::*;
    use crate::scene::Vector;
    use crate::sim::PointId;

    fn entry(act: Do) -> Entry {
        Entry { at: 3.0, act, edit: Some(1), name: Some("x".to_owned()) }
    }

    fn set(keys: SetKeys) -> Entry {
        entry(Do::Set(Box::new(keys)))
    }

    #[test]
    fn numbers_of_what_is_there_at_the_start_are_settings_and_all_else_is_none() {
        let mass = Some(OneOrEach::Each(vec![1.0, 2.0, 3.0]));
        let of_points = set(SetKeys { points: Some(vec![0, 4, 9]), mass, over: Some(0.1), ..SetKeys::default() });
        let kept = of_points.at_start(0.0, [5, 0, 0]).unwrap();
        let mass = Some(OneOrEach::Each(vec![1.0, 2.0]));
        let there = SetKeys { points: Some(vec![0, 4]), mass, ..SetKeys::default() };
        assert_eq!(kept, Entry { at: 0.0, ..set(there) }, "the body that came later is not");
        assert_eq!(of_points.at_start(0.0, [0, 99, 0]), None);
        let fast = Some(VectorOrEach::One(Vector::Plane([1.0, 0.0])));
        let moves = set(SetKeys { points: Some(vec![0]), velocity: fast, ..SetKeys::default() });
        assert_eq!((moves.at_start(0.0, [5, 0, 0]), moves.is_setting()), (None, false), "a state");
        assert!(set(SetKeys { drag_rate: Some(1.0), ..SetKeys::default() }).at_start(0.0, [0; 3]).is_some());
        assert_eq!(entry(Do::Pin(vec![PointId(0)])).at_start(0.0, [5, 5, 5]), None);
        let aside = Entry { edit: None, ..of_points };
        assert_eq!(aside.at_start(0.0, [9; 3]), None, "what gave way is not what a player set");
    }

    #[test]
    fn of_a_drag_the_last_number_counts() {
        let soft = |bonds: Vec<u32>, stiffness: f64| {
            let stiffness = Some(OneOrEach::One(stiffness));
            set(SetKeys { bonds: Some(bonds), stiffness, ..SetKeys::default() })
        };
        assert!(soft(vec![1, 2], 5.0).is_superseded_by(&soft(vec![1, 2], 7.0)));
        assert!(!soft(vec![1, 2], 5.0).is_superseded_by(&soft(vec![1], 7.0)), "of other bonds");
        let damped = SetKeys { bonds: Some(vec![1, 2]), damping: Some(OneOrEach::One(1.0)), ..SetKeys::default() };
        assert!(!soft(vec![1, 2], 5.0).is_superseded_by(&set(damped)));
        let other = Entry { edit: Some(2), ..soft(vec![1, 2], 7.0) };
        assert!(!soft(vec![1, 2], 5.0).is_superseded_by(&other));
    }
}
