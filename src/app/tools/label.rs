//! Labels of the scene are moved by their words, with the tool that selects.

use glam::{DVec2, DVec3};

use super::facing::Hold;
use super::pick::Scope;
use super::selecting::is_drag;
use super::{Deed, Doing, Hand};
use crate::app::action::Tool;
use crate::history::{Do, SetKeys};
use crate::scene::{LabelKeys, Vector};

/// What its drag is called when it is undone.
const NAME: &str = "move a label";

impl Hand {
    /// Whether a press at a pixel where a label lies takes that: no handle of what is selected lies there, and no key means something else.
    pub(in crate::app) fn takes_labels(&self, scope: Scope<'_>, at: DVec2) -> bool {
        let is_free = self.doing == Doing::Nothing && self.tool() == Tool::Select;
        let is_plain = !(self.shift || self.alt || self.command);
        is_free && is_plain && self.handle(scope, at).is_none() && self.ring(scope, at).is_none()
    }

    /// The left button went down at a pixel, on the label with this number.
    pub(in crate::app) fn press_label(&mut self, scope: Scope<'_>, number: usize, at: DVec2) -> Deed {
        match scope.shown.labels.get(number).and_then(|label| place(scope, label)) {
            None => self.press(scope, at),
            Some(through) => {
                (self.pressed, self.is_dragged, self.is_quick, self.beside) = (at, false, false, DVec3::ZERO);
                self.doing = Doing::Labelling(number, Hold { at, place: scope.facing(through, at) });
                Deed::default()
            }
        }
    }

    /// The label that is dragged, and how far it goes with the pointer at a pixel `[m]`.
    pub(in crate::app) fn led_label(&self, scope: Scope<'_>, at: DVec2) -> Option<(usize, DVec3)> {
        let Doing::Labelling(number, hold) = self.doing else { return None };
        is_drag(scope, [hold.at, at]).then(|| (number, scope.way(hold, at)))
    }

    /// The button goes up: the label stays where it was dragged to. A click means what lies below it.
    pub(super) fn end_label(&mut self, scope: Scope<'_>, (number, hold): (usize, Hold), at: DVec2) -> Deed {
        if !is_drag(scope, [hold.at, at]) {
            self.press(scope, at);
            return self.release(scope, at);
        }
        let labels = moved(&scope.shown.labels, (number, scope.way(hold, at)), scope.shown.dimensions);
        Deed::edit(NAME, Do::Set(Box::new(SetKeys { labels: Some(labels), ..SetKeys::default() })))
    }
}

/// Labels, of which one stands so far off `[m]`; one that goes along with a point does so from there.
pub(in crate::app) fn moved(labels: &[LabelKeys], (number, by): (usize, DVec3), dimensions: usize) -> Vec<LabelKeys> {
    let mut labels = labels.to_vec();
    if let Some(label) = labels.get_mut(number) {
        label.at = Vector::new((DVec3::from(label.at.embed()) + by).to_array(), dimensions);
    }
    labels
}

/// Where a label stands `[m]`; `None`: its point is gone.
fn place(scope: Scope<'_>, label: &LabelKeys) -> Option<DVec3> {
    let from = match label.point {
        None => DVec3::ZERO,
        Some(point) if (point as usize) < scope.shown.point_count() => DVec3::from(scope.shown.place(point as usize)),
        Some(_) => return None,
    };
    Some(from + DVec3::from(label.at.embed())).filter(|at| at.is_finite())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::tests::{scope, shown};
    use super::*;
    use crate::app::player::{Note, Order, Shown, Stage};
    use crate::scene::Scene;

    const TWO: &str = r#"{"wobble": 1, "gravity": [0, 0], "view": {"center": [0, 0], "height": 10},
        "points": {"position": [[1, 1]]}, "obstacles": [{"box": {"min": [-3, -1], "max": [-1, 1]}}],
        "labels": [{"at": [-2, 0], "text": "a box"}, {"at": [0, 0.5], "text": "a point", "point": 0}]}"#;

    #[test]
    fn a_label_is_dragged_by_its_words_as_one_step_of_undo_and_a_click_means_what_lies_below_it() {
        let mut seen = shown(Scene::parse(TWO, "x.json").unwrap());
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        let pixel = |x: f64, y: f64, camera: &crate::render::Camera| {
            DVec2::from(camera.screen_from_world([x, y, 0.0].into()).unwrap())
        };
        let mut hand = Hand::default();
        assert!(!hand.takes_labels(scope(&seen), DVec2::ZERO), "the hand is another tool");
        hand.take(Tool::Select);
        let at = |shown: &Shown| -> Vec<Vector> { shown.labels.iter().map(|label| label.at).collect() };
        let before = at(&seen.0);
        for (number, from) in [(0, [-2.0, 0.1]), (1, [1.0, 1.6])] {
            let ends = [0.0, 1.0].map(|by| pixel(from[0] + by, from[1] + 2.0 * by, &seen.1));
            assert!(hand.takes_labels(scope(&seen), ends[0]));
            assert!(hand.press_label(scope(&seen), number, ends[0]).is_empty() && hand.is_busy());
            assert_eq!(hand.led_label(scope(&seen), ends[0]), None, "it is no drag yet");
            hand.trace(scope(&seen), ends[1]);
            let (led, by) = hand.led_label(scope(&seen), ends[1]).unwrap();
            assert!(led == number && (by - DVec3::new(1.0, 2.0, 0.0)).length() < 1e-6, "{by}");
            let deed = hand.release(scope(&seen), ends[1]);
            assert_eq!(deed.edit, Some(NAME));
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
            stage.show(&mut seen.0);
            let [x, y, _] = at(&seen.0)[number].embed();
            let [first, high, _] = before[number].embed();
            assert!((x - first - 1.0).abs() < 1e-6 && (y - high - 2.0).abs() < 1e-6, "{x} {y}");
            assert_eq!(at(&seen.0)[1 - number], before[1 - number], "the other one stays");
            assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == NAME));
            stage.show(&mut seen.0);
            assert_eq!(at(&seen.0), before);
        }
        let on_box = pixel(-2.0, 0.1, &seen.1);
        hand.press_label(scope(&seen), 0, on_box);
        assert!(hand.release(scope(&seen), on_box).is_empty());
        assert_eq!(hand.chosen(scope(&seen)).unwrap().obstacles, [0]);
        // Esc lets it be.
        hand.press_label(scope(&seen), 0, on_box);
        assert!(hand.cancel().0 && hand.release(scope(&seen), DVec2::ZERO).is_empty());
    }
}
