//! What is selected, through all that is done to it: copies come in its place, and what undo takes away or brings back keeps its place in it.

use super::chosen::Chosen;
use super::pick::Scope;

/// So many copies are known with what was selected before them.
const MOST: usize = 32;

/// What is selected, and what will be where it comes back.
#[derive(Clone, Debug, Default)]
pub(super) struct Selection {
    /// What is, or will be as soon as it is there.
    chosen: Chosen,
    /// What was before copies came in its place, the last at the end: it is again where those are not there.
    before: Vec<Chosen>,
    /// What is being taken away, and what was: it is selected again where it comes back.
    leaving: Chosen,
    away: Chosen,
    /// The topology of the world in which that was looked for last.
    looked: Option<u64>,
}

impl Selection {
    /// What is selected and there.
    pub(super) fn now(&self, scope: Scope<'_>) -> Chosen {
        let all = std::iter::once(&self.chosen).chain(self.before.iter().rev());
        let mut there = all.filter(|chosen| !chosen.is_empty()).map(|chosen| chosen.left(scope));
        there.find(|chosen| !chosen.is_empty()).unwrap_or_default()
    }

    /// The hand chooses this.
    pub(super) fn set(&mut self, chosen: Chosen) {
        (self.chosen, self.before) = (chosen, Vec::new());
    }

    /// Copies come in its place.
    pub(super) fn come(&mut self, copies: Chosen) {
        self.before.push(std::mem::replace(&mut self.chosen, copies));
        if self.before.len() > MOST {
            self.before.remove(0);
        }
    }

    /// The hand begins to choose: returns what is selected now. What is not there comes back by undo alone.
    pub(super) fn begin(&mut self, scope: Scope<'_>) -> Chosen {
        let now = self.now(scope);
        let lost = self.chosen.joined(&self.chosen.left(scope), true);
        self.away = self.away.joined(&lost, false);
        self.chosen.clone_from(&now);
        now
    }

    /// It is being taken away: nothing is selected until undo brings it back.
    pub(super) fn take_away(&mut self, scope: Scope<'_>) {
        self.leaving = self.now(scope);
        self.set(Chosen::default());
    }

    /// What was taken away is selected again where it has come back.
    pub(super) fn settle(&mut self, scope: Scope<'_>) {
        if !self.leaving.is_empty() && self.leaving.left(scope).is_empty() {
            self.away = self.away.joined(&std::mem::take(&mut self.leaving), false);
        }
        let here = scope.shown.topology;
        if self.away.is_empty() || self.looked.replace(here) == Some(here) {
            return;
        }
        let back = self.away.left(scope);
        if !back.is_empty() {
            self.away = self.away.joined(&back, true);
            self.set(self.now(scope).joined(&back, false));
        }
    }

    /// Something else is done: what undo took away cannot come back, and what comes next has its numbers.
    pub(super) fn forget_undone(&mut self, scope: Scope<'_>) {
        let scenery = &scope.shown.scenery;
        let last = scenery.solid_numbers.iter().chain(&scenery.plane_numbers).max().copied();
        let known = |chosen: &mut Chosen| {
            chosen.points.retain(|point| point.index() < scope.shown.point_count());
            chosen.obstacles.retain(|number| Some(*number) <= last);
        };
        known(&mut self.away);
        if !self.before.is_empty() && self.chosen.left(scope).is_empty() {
            self.set(self.now(scope));
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::Hand;
    use super::super::tests::{pixel, scope, shown};
    use super::*;
    use crate::app::action::Tool;
    use crate::app::player::{Order, Shown, Stage};
    use crate::history::Do;
    use crate::render::Camera;
    use crate::scene::Scene;
    use crate::sim::PointId;

    const ROPES: &str = r#"{"wobble": 1, "gravity": [0, 0], "contact": true, "view": {"center": [0, 0], "height": 10},
        "bodies": [{"make": "rope", "count": 3, "to": [0, 1], "origin": [-2, 0], "material": {"kind": "rigid", "mass": 1}},
            {"make": "rope", "count": 4, "to": [0, 1], "origin": [2, 0], "material": {"kind": "rigid", "mass": 1}}]}"#;

    /// A world with a hand that selects in it.
    struct Room {
        stage: Stage,
        seen: (Shown, Camera, Scene),
        hand: Hand,
    }

    impl Room {
        fn new() -> Self {
            let seen = shown(Scene::parse(ROPES, "x.json").unwrap());
            let mut hand = Hand::default();
            hand.take(Tool::Select);
            Room { stage: Stage::new(seen.2.clone().into()).unwrap(), seen, hand }
        }

        /// Does something, and looks as a frame does.
        fn obey(&mut self, order: Order) {
            self.stage.obey(order);
            self.stage.show(&mut self.seen.0);
            self.hand.settle(scope(&self.seen));
        }

        fn undo(&mut self) {
            self.obey(Order::Undo(None));
        }

        fn redo(&mut self) {
            self.obey(Order::Redo(None));
        }

        fn click(&mut self, point: usize) {
            let at = pixel(&self.seen, point);
            self.hand.press(scope(&self.seen), at);
            self.hand.release(scope(&self.seen), at);
        }

        fn delete(&mut self) {
            let deed = self.hand.delete(scope(&self.seen), None);
            self.hand.forget_undone(scope(&self.seen));
            assert!(self.selected().is_empty(), "until it is gone it is not taken away twice");
            self.obey(Order::Give(deed.commands, deed.edit));
        }

        /// A copy of what is selected comes.
        fn copy(&mut self) {
            let own = self.hand.chosen(scope(&self.seen)).unwrap();
            let first = self.seen.0.point_count() as u32;
            let count = own.points.len() as u32;
            let clip = move |history: &crate::history::History| {
                let keys = crate::app::clip::Clip::of(history, &own).placed(history.world(), [0.5, 0.0, 0.0]);
                Ok(crate::app::player::Coming::of(keys))
            };
            // It may be told of before it is seen.
            self.hand
                .select_copy(Chosen { points: (first..first + count).map(PointId).collect(), obstacles: Vec::new() });
            self.obey(Order::Add(Box::new(clip)));
        }

        fn selected(&self) -> Vec<u32> {
            self.hand.chosen(scope(&self.seen)).map_or_else(Vec::new, |chosen| chosen.numbers())
        }
    }

    #[test]
    fn what_is_moved_stays_selected_through_undo_and_redo() {
        let mut room = Room::new();
        room.click(0);
        assert_eq!(room.selected(), [0, 1, 2]);
        room.obey(Order::Give(vec![Do::Pin(vec![PointId(0)])], Some("pin")));
        room.undo();
        assert_eq!(room.selected(), [0, 1, 2]);
        room.redo();
        assert_eq!(room.selected(), [0, 1, 2]);
    }

    #[test]
    fn what_was_deleted_comes_back_selected_as_often_as_it_does() {
        let mut room = Room::new();
        room.click(0);
        room.delete();
        assert!(room.selected().is_empty());
        for _ in 0..2 {
            room.undo();
            assert_eq!(room.selected(), [0, 1, 2]);
            room.redo();
            assert!(room.selected().is_empty());
        }
        // With what was selected since.
        room.click(4);
        assert_eq!(room.selected(), [3, 4, 5, 6]);
        room.undo();
        assert_eq!(room.selected(), [0, 1, 2, 3, 4, 5, 6]);
    }

    #[test]
    fn a_copy_that_undo_takes_away_leaves_its_original_selected_and_comes_back_so() {
        let mut room = Room::new();
        room.click(0);
        room.copy();
        assert_eq!(room.selected(), [7, 8, 9]);
        room.copy();
        assert_eq!(room.selected(), [10, 11, 12]);
        room.undo();
        assert_eq!(room.selected(), [7, 8, 9]);
        room.undo();
        assert_eq!(room.selected(), [0, 1, 2]);
        room.redo();
        assert_eq!(room.selected(), [7, 8, 9]);
        room.delete();
        assert!(room.selected().is_empty(), "not the original in its place");
    }

    #[test]
    fn what_has_the_numbers_of_what_undo_took_away_is_not_selected() {
        let mut room = Room::new();
        room.click(0);
        room.copy();
        room.undo();
        room.hand.forget_undone(scope(&room.seen));
        let keys: crate::scene::AddKeys = serde_json::from_str(
            r#"{"points": {"position": [[3, 3], [3, 4], [4, 4]]}, "bonds": [{"a": 7, "b": 8}, {"a": 8, "b": 9}]}"#,
        )
        .unwrap();
        room.obey(Order::Give(vec![Do::Add(Box::new(keys))], Some("build")));
        assert_eq!((room.seen.0.point_count(), room.selected()), (10, vec![0, 1, 2]));
    }
}
