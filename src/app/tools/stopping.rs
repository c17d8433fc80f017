//! The stops of a joint are dragged along its arc, with the tool that selects.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::marks::{Mark, Role};
use super::pick::Scope;
use super::segments::distance_to_segment;
use super::selecting::is_drag;
use super::stops::{ACROSS, Dial, MOST, all, joints, within};
use super::{Deed, Doing, Hand};
use crate::app::matter::Joint;
use crate::history::{Do, RangeOrNone, SetKeys};
use crate::sim::{Angle, PointId};

/// What lies so near to a stop's line means that `[logical px]`.
const NEAR: f64 = 5.0;
/// Stops of one joint stay so far apart, and less than a full turn by as much `[rad]`.
const APART: f64 = PI / 180.0;
/// With Shift a stop goes in steps of this `[rad]`.
const STEP: f64 = PI / 12.0;
/// What it is called when it is undone, as in the panel.
const NAME: &str = "stops";

/// A stop that is dragged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stop {
    /// The number of its angle.
    number: u32,
    /// 0: the least angle, 1: the largest.
    side: usize,
    /// The pixel that was pressed on `[px]`.
    from: DVec2,
}

impl Stop {
    /// The one at a pixel, of the joints among points that are selected, ascending.
    pub(super) fn at(scope: Scope<'_>, points: &[PointId], at: DVec2) -> Option<Self> {
        if scope.shown.dimensions != 2 {
            return None;
        }
        let far = |angle: &Angle, stop: f64| {
            let dial = Dial::of(scope, angle.points)?;
            let [from, to] = ACROSS.map(|share| dial.at(scope, stop, share));
            Some(distance_to_segment(at, from?, to?))
        };
        let ends = joints(scope, points).take(MOST).filter_map(|angle| Some((angle, angle.range?)));
        let ends = ends.flat_map(|(angle, range)| [0, 1].map(|side| (angle, side, range[side])));
        let near = ends.filter_map(|(angle, side, stop)| Some((far(angle, stop)?, angle.number, side)));
        let near = near.filter(|(far, ..)| *far <= NEAR * scope.scale).min_by(|a, b| a.0.total_cmp(&b.0));
        near.map(|(_, number, side)| Stop { number, side, from: at })
    }

    /// The number of its angle and where its stops are with the pointer at a pixel `[rad]`; `None`: it is gone, or not dragged.
    fn range(self, scope: Scope<'_>, at: DVec2, in_steps: bool) -> Option<(u32, [f64; 2])> {
        let angle = scope.shown.scenery.angles.iter().find(|angle| angle.number == self.number)?;
        let (mut range, dial) = (angle.range?, Dial::of(scope, angle.points)?);
        if !is_drag(scope, [self.from, at]) {
            return None;
        }
        let (own, other) = (range[self.side], range[1 - self.side]);
        let to = within((scope.in_plane(at) - dial.middle).to_angle() - dial.from, own);
        let to = if in_steps { STEP * (to / STEP).round() } else { to };
        range[self.side] = match self.side {
            0 => to.clamp(other - TAU + APART, other - APART),
            _ => to.clamp(other + APART, other + TAU - APART),
        };
        Some((self.number, range))
    }

    /// The arcs of what is selected, as they would be, and the angle beside the pointer.
    pub(super) fn marks(self, scope: Scope<'_>, points: &[PointId], (at, in_steps): (DVec2, bool)) -> Vec<Mark> {
        let led = self.range(scope, at, in_steps);
        let range = |angle: &Angle| led.filter(|(number, _)| *number == angle.number).map(|(_, range)| range);
        let arc =
            |angle: &Angle| Some(Joint { points: angle.points, range: range(angle).or(angle.range)?, prop: None });
        let arcs = joints(scope, points).filter_map(arc);
        let mut marks = all(scope, Role::Lead, &arcs.take(MOST).collect::<Vec<_>>());
        marks.extend(led.map(|(_, range)| {
            let words = format!("{:.0}°", range[self.side].to_degrees());
            Mark::Words(at + DVec2::new(16.0, -10.0) * scope.scale, words)
        }));
        marks
    }

    /// The stop stays where it was dragged to.
    pub(super) fn release(self, scope: Scope<'_>, (at, in_steps): (DVec2, bool)) -> Deed {
        let Some((number, range)) = self.range(scope, at, in_steps) else { return Deed::default() };
        let range = Some(RangeOrNone::These(range));
        let keys = SetKeys { angles: Some(vec![number]), range, ..SetKeys::default() };
        Deed::edit(NAME, Do::Set(Box::new(keys)))
    }
}

impl Hand {
    /// Whether a press at a pixel takes a stop of what is selected.
    pub(in crate::app) fn takes_stop(&self, scope: Scope<'_>, at: DVec2) -> bool {
        let is_free = self.doing == Doing::Nothing && !self.shift && !self.alt && !self.command;
        let chosen = self.chosen(scope).filter(|_| is_free);
        chosen.is_some_and(|chosen| Stop::at(scope, &chosen.points, at).is_some())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::tests::{pixel, scope, shown};
    use super::*;
    use crate::app::action::Tool;
    use crate::app::player::{Note, Order, Stage};
    use crate::scene::Scene;

    /// Two arms at a right angle with stops.
    const KNEE: &str = r#"{"wobble": 1, "gravity": [0, 0], "view": {"center": [0, 0], "height": 4},
        "points": {"position": [[1, 0], [0, 0], [0, 1]]}, "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}],
        "angles": [{"points": [0, 1, 2], "min": 0.5, "max": 2.5}]}"#;

    #[test]
    fn a_stop_is_dragged_along_its_arc_as_one_step_of_undo_and_no_further_than_the_other_one() {
        let mut seen = shown(Scene::parse(KNEE, "x.json").unwrap());
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        let mut hand = Hand::default();
        hand.take(Tool::Select);
        let on_arm = pixel(&seen, 2);
        hand.press(scope(&seen), on_arm);
        hand.release(scope(&seen), on_arm);
        let joint = pixel(&seen, 1);
        let radius = {
            let dial = Dial::of(scope(&seen), [0, 1, 2].map(PointId)).unwrap();
            dial.at(scope(&seen), 0.0, 1.0).unwrap().distance(joint)
        };
        // On the screen up is down.
        let at = |angle: f64| joint + radius * DVec2::new(angle.cos(), -angle.sin());
        for (from, to, shift, expected) in [
            (2.5, 2.0, false, [0.5, 2.0]),
            (0.5, 1.0, false, [1.0, 2.5]),
            (0.5, -0.5, false, [-0.5, 2.5]),
            (2.5, 2.05, true, [0.5, 8.0 * STEP]),
            (2.5, 0.3, false, [0.5, 0.5 + APART]),
        ] {
            assert!(hand.takes_stop(scope(&seen), at(from)) && !hand.takes_stop(scope(&seen), at(1.2)));
            assert!(hand.press(scope(&seen), at(from)).is_empty());
            hand.trace(scope(&seen), at(to));
            hand.hold([shift, false]);
            let said = format!("{:.0}°", if from > 2.0 { expected[1] } else { expected[0] }.to_degrees());
            let marks = hand.marks(scope(&seen), Some(at(to)));
            assert!(
                marks.iter().any(|mark| matches!(mark, Mark::Words(_, words) if *words == said)),
                "{said}: {marks:?}"
            );
            let deed = hand.release(scope(&seen), at(to));
            hand.hold([false, false]);
            assert_eq!(deed.edit, Some(NAME));
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
            let range = stage.history().world().angles()[0].range.unwrap();
            assert!((0..2).all(|side| (range[side] - expected[side]).abs() < 0.02), "{from} to {to}: {range:?}");
            assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == NAME));
            stage.show(&mut seen.0);
        }
        // A click does nothing, nor does a drag that Esc gives up.
        hand.press(scope(&seen), at(2.5));
        assert_eq!(hand.release(scope(&seen), at(2.5)), Deed::default());
        hand.press(scope(&seen), at(2.5));
        assert!(hand.cancel().0 && hand.release(scope(&seen), at(1.0)).is_empty());
    }
}
