//! What is selected, through all that is done to it: copies come in its place, and what undo takes away or brings back keeps its place in it.

use super::chosen::Chosen;
use super::hub::with_props;
use super::pick::Scope;
use crate::app::player::Latest;

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
    /// Copies are told of that are not there yet.
    is_coming: bool,
    /// How often numbers were given anew, as far as that was seen.
    latest: u64,
    /// The topology of the world in which that was looked for last.
    looked: Option<u64>,
}

impl Selection {
    /// What is selected and there, with the props of its joints, which may have come since.
    pub(super) fn now(&self, scope: Scope<'_>) -> Chosen {
        let all = std::iter::once(&self.chosen).chain(self.before.iter().rev());
        let mut there = all.filter(|chosen| !chosen.is_empty()).map(|chosen| chosen.left(scope));
        let Chosen { points, obstacles } = there.find(|chosen| !chosen.is_empty()).unwrap_or_default();
        Chosen { points: with_props(scope, points), obstacles }
    }

    /// The hand chooses this.
    pub(super) fn set(&mut self, chosen: Chosen) {
        (self.chosen, self.before, self.is_coming) = (chosen, Vec::new(), false);
    }

    /// Copies come in its place.
    pub(super) fn come(&mut self, copies: Chosen) {
        self.before.push(std::mem::replace(&mut self.chosen, copies));
        self.is_coming = true;
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

    /// What was taken away is selected again where it has come back; what was built since with its numbers is not.
    pub(super) fn settle(&mut self, scope: Scope<'_>) {
        let latest = scope.shown.latest;
        if std::mem::replace(&mut self.latest, latest.times) != latest.times {
            self.forget_numbers(latest);
        }
        self.is_coming &= self.chosen.left(scope) != self.chosen;
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

    /// What has numbers anew is not what was selected by them: that cannot come back.
    fn forget_numbers(&mut self, latest: Latest) {
        let [points, obstacles] = latest.from;
        let keep = |chosen: &mut Chosen| {
            chosen.points.retain(|point| point.0 < points);
            chosen.obstacles.retain(|number| *number < obstacles);
        };
        self.before.iter_mut().chain([&mut self.leaving, &mut self.away]).for_each(keep);
        if !self.is_coming {
            keep(&mut self.chosen);
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

    /// Three points in a row at a place, which become a body of their own.
    fn built(first: u32, x: f64) -> Vec<Do> {
        let keys = format!(
            r#"{{"points": {{"position": [[{x}, 3], [{x}, 4], [{x}, 5]]}}, "bonds": [{{"a": {first}, "b": {}}}, {{"a": {}, "b": {}}}]}}"#,
            first + 1,
            first + 1,
            first + 2
        );
        vec![Do::Add(Box::new(serde_json::from_str(&keys).unwrap()))]
    }

    #[test]
    fn what_has_the_numbers_of_a_copy_that_undo_took_away_is_not_selected() {
        let mut room = Room::new();
        room.click(0);
        room.copy();
        room.undo();
        room.obey(Order::Give(built(7, 3.0), Some("build")));
        assert_eq!((room.seen.0.point_count(), room.selected()), (10, vec![0, 1, 2]));
    }

    #[test]
    fn what_is_built_after_undo_is_not_selected_by_the_numbers_of_what_was() {
        let comes = |commands: Vec<Do>| {
            let coming = crate::app::player::Coming { commands, name: "import", came: None };
            Order::Add(Box::new(move |_| Ok(coming)))
        };
        for is_import in [false, true] {
            let mut room = Room::new();
            room.obey(Order::Give(built(7, 3.0), Some("build")));
            room.click(7);
            assert_eq!(room.selected(), [7, 8, 9]);
            room.undo();
            room.redo();
            assert_eq!(room.selected(), [7, 8, 9], "undone and done again it is");
            room.undo();
            assert!(room.selected().is_empty());
            let next = built(7, 4.0);
            room.obey(if is_import { comes(next) } else { Order::Give(next, Some("build")) });
            assert_eq!(room.seen.0.point_count(), 10);
            assert!(room.selected().is_empty(), "another body has the numbers: {:?}", room.selected());
            room.click(0);
            room.undo();
            room.redo();
            assert_eq!(room.selected(), [0, 1, 2]);
        }
    }

    #[test]
    fn what_is_built_before_the_next_frame_is_not_selected_either() {
        let mut room = Room::new();
        room.obey(Order::Give(built(7, 3.0), Some("build")));
        room.click(7);
        // Both are done before anything is seen of them.
        room.stage.obey(Order::Undo(None));
        room.stage.obey(Order::Give(built(7, 4.0), Some("build")));
        room.obey(Order::Give(built(10, 5.0), Some("build")));
        assert_eq!((room.seen.0.point_count(), room.selected()), (13, Vec::new()));
    }

    #[test]
    fn bodies_of_another_branch_are_not_selected_by_the_numbers_of_this_one() {
        let mut room = Room::new();
        room.obey(Order::Give(built(7, 3.0), Some("build")));
        room.undo();
        room.obey(Order::Give(built(7, 4.0), Some("build")));
        room.click(7);
        assert_eq!(room.selected(), [7, 8, 9]);
        room.obey(Order::ToBranch(0, None));
        assert_eq!((room.seen.0.point_count(), room.selected()), (10, Vec::new()));
    }
}
