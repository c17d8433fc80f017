//! Histories that were left for another scene: undo goes back to them, redo forth again.

use super::{Framing, Session};
use crate::app::panels::At;
use crate::app::player::{Order, Player};
use crate::render::Camera;

/// So many on each side are kept with their worlds; of those further away start and log are, from which they are worked out anew.
const MOST: usize = 3;
/// Bytes that the copies of all worlds may take together, and of each that was left.
const BYTES: usize = 512 << 20;
const BYTES_LEFT: usize = 32 << 20;

/// A history that was left, where it was looked at from, and whether it played.
pub(super) struct Left {
    pub(super) player: Player,
    pub(super) camera: Camera,
    played: bool,
    /// The step of a lesson that lay beside it, and what it was called.
    lesson: Option<At>,
    title: String,
}

impl Left {
    /// It is left now: it stands still until it is gone back to.
    pub(super) fn now(mut player: Player, camera: Camera) -> Self {
        let played = player.is_playing();
        player.stand_still();
        Left { player, camera, played, lesson: None, title: String::new() }
    }

    /// It is there again, after a history that plays or does not: what was paused when it was left stays so, and so does whoever looked at
    /// what stood still.
    fn again(self, present_plays: bool) -> (Player, Camera) {
        let Left { mut player, camera, played, .. } = self;
        player.play(played && present_plays);
        (player, camera)
    }
}

/// Histories before the present one and after it, the nearest last.
#[derive(Default)]
pub(super) struct Shelf {
    before: Vec<Left>,
    after: Vec<Left>,
}

impl Shelf {
    /// The present history was left for a new one.
    pub(super) fn keep(&mut self, left: Left) {
        self.after.clear();
        self.before.push(left);
    }

    /// Those that are far away are folded. Returns the bytes that copies of the present world may take.
    fn settle(&mut self) -> usize {
        let mut bytes = BYTES;
        for list in [&mut self.before, &mut self.after] {
            for (place, Left { player, .. }) in list.iter_mut().rev().enumerate() {
                if place < MOST {
                    bytes -= BYTES_LEFT;
                    player.ask(Order::Bound(BYTES_LEFT));
                } else {
                    player.fold();
                }
            }
        }
        bytes
    }

    /// The history before.
    pub(super) fn back(&mut self) -> Option<Left> {
        self.before.pop()
    }

    /// Whether there is one before.
    pub(super) fn has_before(&self) -> bool {
        !self.before.is_empty()
    }

    /// Takes the history that lies so far along a way, 1 for the nearest, and those between it and the present one, the nearest first; `None`:
    /// the way is not that long.
    fn take(&mut self, way: Way, far: usize) -> Option<(Left, Vec<Left>)> {
        let list = if way == Way::Back { &mut self.before } else { &mut self.after };
        let at = list.len().checked_sub(far.max(1))?;
        let mut between = list.split_off(at + 1);
        between.reverse();
        Some((list.pop()?, between))
    }

    /// The present history and those between it and the one that is gone to, which way.
    fn pass(&mut self, way: Way, present: Left, between: Vec<Left>) {
        let list = if way == Way::Back { &mut self.after } else { &mut self.before };
        list.push(present);
        list.extend(between);
    }

    /// Which way the next history with work lies that was not saved, and how far: the nearest one after the present one, else the first of all,
    /// so that whoever goes on comes to each of them.
    fn next_unsaved(&self) -> Option<(Way, usize)> {
        let is_unsaved = |left: &Left| left.player.is_unsaved();
        let on = self.after.iter().rev().position(is_unsaved).map(|place| (Way::On, place + 1));
        on.or_else(|| self.before.iter().position(is_unsaved).map(|place| (Way::Back, self.before.len() - place)))
    }

    /// All that are kept.
    pub(super) fn players(&self) -> impl Iterator<Item = &Player> {
        self.before.iter().chain(&self.after).map(|left| &left.player)
    }

    /// What those are called in which something was done that was not saved, in the order in which they were left.
    pub(super) fn unsaved(&self) -> Vec<&str> {
        let all = self.before.iter().chain(self.after.iter().rev());
        all.filter(|left| left.player.is_unsaved()).map(|left| &*left.title).collect()
    }

    /// The same, to be ended.
    pub(super) fn players_mut(&mut self) -> impl Iterator<Item = &mut Player> {
        self.before.iter_mut().chain(&mut self.after).map(|left| &mut left.player)
    }
}

/// Which way along the shelf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// To what was left before.
    Back,
    /// To what was opened after.
    On,
}

impl Way {
    fn other(self) -> Way {
        if self == Way::Back { Way::On } else { Way::Back }
    }
}

/// What undo does where nothing is left to undo in a history.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Leaving {
    /// There is none before it.
    Stays,
    /// It says where the next one leads.
    Asks,
    /// That it was opened is undone.
    Goes,
}

/// What was done last is undone: whoever has just opened a history is back at once; whoever did something in it, or came here by undo, is told
/// before.
fn leaving(has_before: bool, is_used: bool) -> Leaving {
    match (has_before, is_used) {
        (false, _) => Leaving::Stays,
        (true, true) => Leaving::Asks,
        (true, false) => Leaving::Goes,
    }
}

impl Session {
    /// What undo would take back, in words; `None`: nothing.
    pub(super) fn undoes(&self) -> Option<String> {
        if self.hand.is_drawing() {
            return Some("the last corner".to_owned());
        }
        let before = self.shelf.before.last().map(|left| format!("back to {}", left.title));
        self.shown().figures.undoes.clone().or(before)
    }

    /// What redo would bring again, likewise.
    pub(super) fn redoes(&self) -> Option<String> {
        let after = self.shelf.after.last().map(|left| format!("on to {}", left.title));
        self.shown().figures.redoes.clone().or(after)
    }

    /// There is nothing to undo in this history: it was opened, so that is undone.
    pub(super) fn go_back(&mut self) {
        match leaving(self.shelf.has_before(), self.player.is_used()) {
            Leaving::Stays => self.say("there is nothing to undo".to_owned()),
            Leaving::Asks => {
                self.player.say_used(false);
                let before = self.shelf.before.last().map_or("", |left| &left.title);
                let words =
                    format!("nothing is left to undo in {}: undo once more goes back to {before}", self.title());
                self.say(words);
            }
            Leaving::Goes => self.leave_back(),
        }
    }

    /// The history before is there again. It is left only by whoever asks for that.
    fn leave_back(&mut self) {
        self.go_along(Way::Back, 1);
    }

    /// There is nothing to redo in this history: another was opened from it.
    pub(super) fn go_on(&mut self) {
        if !self.go_along(Way::On, 1) {
            self.say("there is nothing to redo".to_owned());
        }
    }

    /// The next history with work that was not saved is there again.
    pub(super) fn go_to_unsaved(&mut self) {
        if let Some((way, far)) = self.shelf.next_unsaved() {
            self.go_along(way, far);
        }
    }

    /// The history that lies so far along a way is there again; those between stay as they are. Returns whether there is one.
    fn go_along(&mut self, way: Way, far: usize) -> bool {
        let Some((left, between)) = self.shelf.take(way, far) else { return false };
        let (from, to) = (self.title(), left.title.clone());
        let left = self.bring_back(left);
        self.shelf.pass(way, left, between);
        self.came = Some((way, far)).filter(|_| self.player.is_unfolding());
        self.player.say_used(way == Way::Back);
        self.settle();
        self.say(match way {
            Way::Back => format!("Back to {to}: redo opens {from} again"),
            Way::On => format!("{to} is open again"),
        });
        true
    }

    /// What is worked out anew is not waited for: it stays folded, and where one came from is there again. Returns whether one came from
    /// anywhere.
    pub(super) fn stay_where_one_was(&mut self) -> bool {
        let Some((way, far)) = self.came.take() else { return false };
        // Nothing is asked of it after that.
        self.take_leave();
        self.player.stay_folded();
        self.go_along(way.other(), far)
    }

    /// The present history is left for this player's: it stands still, with the step of a lesson that lies beside it.
    pub(super) fn exchange(&mut self, player: Player) -> Left {
        let title = self.title_of(self.taught);
        let lesson = self.taught.filter(|_| self.panels.lessons.is_open);
        Left { lesson, title, ..Left::now(std::mem::replace(&mut self.player, player), self.camera) }
    }

    /// Memory is shared out among the histories.
    pub(super) fn settle(&mut self) {
        let bytes = self.shelf.settle();
        self.player.ask(Order::Bound(bytes));
    }

    /// Plays a history that was left, as it was left, at once or as soon as it is worked out anew; returns the one before it.
    pub(super) fn bring_back(&mut self, left: Left) -> Left {
        let lesson = left.lesson;
        let (player, camera) = left.again(self.player.is_playing());
        self.take_leave();
        let last = self.exchange(player);
        (self.teaches, self.taught, self.came) = (lesson, None, None);
        self.looks_again = Some(camera);
        match self.player.is_open() {
            true => {
                let scene = self.player.start().scene().clone();
                self.begin();
                self.arrive(std::sync::Arc::new(scene));
            }
            false => {
                self.await_it();
                self.begin();
                (self.camera, self.framing, self.follows) = (camera, Framing::Free, false);
                self.camera.resize(self.area);
            }
        }
        self.import = None;
        last
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use std::time::{Duration, Instant};

    use super::super::fresh::rolled;
    use super::*;
    use crate::app::player::{Keeping, Note};
    use crate::app::tools::{SCENES, scene_of, strength};
    use crate::history::Do;
    use crate::scene::{EMPTY, Scene};
    use crate::sim::{Cursor, PointId};

    const SCENE: &str = r#"{"wobble": 1, "points": {"position": [[0, 1], [0.5, 2]], "velocity": [[1, 0], [0, 3]]},
        "gravity": [0, -9.81], "method": {"substep": 0.001}}"#;

    fn wait_for(player: &mut Player, mut is_so: impl FnMut(&Player, &[Note]) -> bool) {
        let (start, mut notes) = (Instant::now(), Vec::new());
        while !is_so(player, &notes) {
            notes.extend(player.poll().notes);
            assert!(start.elapsed() < Duration::from_secs(20), "it never comes");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    fn place(player: &Player) -> [f64; 2] {
        let [x, y, _] = player.shown().place(1);
        [x, y]
    }

    #[test]
    fn however_many_scenes_were_opened_since_what_was_done_is_gone_back_to() {
        let mut shelf = Shelf::default();
        let camera = Camera::fit([[-1.0; 3], [1.0; 3]], 2, [100, 100]);
        let open = || {
            let scene = Scene::parse(SCENE, "x.json").unwrap();
            let mut player = Player::open(scene.into(), Keeping::default(), || {});
            wait_for(&mut player, |player, _| player.is_open());
            player
        };
        let mut first = open();
        first.advance(0.1, Some(Cursor::at([3.0, 3.0])), false);
        first.give(vec![Do::Pin(vec![PointId(0)])], Some("pin"));
        first.advance(0.1, None, false);
        first.play(false);
        let last = first.serial();
        wait_for(&mut first, |player, _| player.shown().serial == last);
        let (time, seen) = (first.shown().figures.time, place(&first));
        shelf.keep(Left::now(first, camera));
        for _ in 0..7 {
            shelf.keep(Left::now(open(), camera));
            assert!(shelf.settle() >= BYTES / 2);
        }
        let folded = shelf.players().filter(|player| !player.is_open()).count();
        assert_eq!(folded, 5, "their worlds are gone");
        assert_eq!(shelf.next_unsaved(), Some((Way::Back, 8)));
        let (left, between) = shelf.take(Way::Back, 8).unwrap();
        assert!(between.len() == 7 && !shelf.has_before() && shelf.take(Way::Back, 1).is_none());
        shelf.pass(Way::Back, Left::now(open(), camera), between);
        let (mut player, _) = left.again(false);
        // Who does not wait for it has it folded as before.
        assert!(player.is_unfolding());
        player.stay_folded();
        assert!(!player.is_unfolding() && !player.is_open());
        let left = Left::now(player, camera);
        let (present, between) = shelf.take(Way::On, 8).unwrap();
        assert!(between.len() == 7 && present.player.is_open() && between.iter().all(|left| !left.player.is_unsaved()));
        shelf.pass(Way::On, left, between);
        assert_eq!(shelf.next_unsaved(), Some((Way::Back, 8)), "all of it lies as before");
        let (mut player, _) = shelf.take(Way::Back, 8).unwrap().0.again(false);
        wait_for(&mut player, |player, _| player.is_open());
        assert_eq!((player.shown().figures.time, place(&player)), (time, seen));
        assert_eq!(player.worked_out(), 1.0);
        player.ask(Order::Undo(None));
        wait_for(&mut player, |_, notes| matches!(notes, [Note::Undone(name, _)] if name == "pin"));
    }

    #[test]
    fn a_scene_is_left_by_undo_at_once_only_where_opening_it_was_the_last_that_was_done() {
        assert_eq!(leaving(false, false), Leaving::Stays);
        assert_eq!([false, true].map(|is_used| leaving(true, is_used)), [Leaving::Goes, Leaving::Asks]);
        let mut player = Player::open(Scene::parse(SCENE, "x.json").unwrap().into(), Keeping::default(), || {});
        wait_for(&mut player, |player, _| player.is_open());
        player.advance(0.1, Some(Cursor::at([3.0, 3.0])), false);
        player.play(false);
        player.ask(Order::Bound(BYTES));
        assert!(!player.is_used(), "looking on is nothing done");
        player.give(vec![strength(0.0)], None);
        player.give(vec![strength(60.0)], None);
        assert!(!player.is_used(), "nor is the hover force that another tool takes away");
        let pin = |point| vec![Do::Pin(vec![PointId(point)])];
        player.give(pin(0), None);
        assert!(player.is_used(), "a hand that only grabs has done something");
        player.say_used(false);
        player.ask(Order::Undo(None));
        wait_for(&mut player, |_, notes| notes.contains(&Note::NothingToUndo));
        assert!(!player.is_used());
        player.give(pin(1), Some("pin"));
        player.say_used(false);
        player.ask(Order::Undo(None));
        wait_for(&mut player, |_, notes| !notes.is_empty());
        assert!(player.is_used(), "what was undone is done in this scene");
    }

    #[test]
    fn what_was_paused_when_it_was_left_stays_so_and_so_does_whoever_looked_at_what_stood_still() {
        let camera = Camera::fit([[-1.0; 3], [1.0; 3]], 2, [100, 100]);
        for (played, present, plays) in
            [(true, true, true), (false, true, false), (true, false, false), (false, false, false)]
        {
            let scene = Scene::parse(SCENE, "x.json").unwrap();
            let mut player = Player::open(scene.into(), Keeping::default(), || {});
            wait_for(&mut player, |player, _| player.is_open());
            player.play(played);
            let left = Left::now(player, camera);
            assert!(!left.player.is_playing(), "it stands still while it is left");
            assert_eq!(left.again(present).0.is_playing(), plays, "{played} {present}");
        }
    }

    fn opened(scene: Scene, plays: bool) -> Player {
        let mut player = Player::open(scene.into(), Keeping::default(), || {});
        wait_for(&mut player, |player, _| player.is_open());
        player.play(plays);
        player
    }

    /// Some frames pass, if it plays; its time then, and its places.
    fn passed(player: &mut Player, frames: u32) -> (f64, Vec<[f64; 3]>) {
        (0..frames).for_each(|_| player.advance(1.0 / 60.0, None, false));
        player.ask(Order::Bound(BYTES));
        let last = player.serial();
        wait_for(player, |player, _| player.shown().serial == last);
        let shown = player.shown();
        (shown.figures.time, (0..shown.point_count()).map(|point| shown.place(point)).collect())
    }

    /// An empty scene and the same one drawn anew, from each kind of scene, paused and running: it is come back to as it was.
    #[test]
    fn a_new_scene_and_the_dice_leave_what_was_there_as_it_was_or_say_that_nothing_is_drawn() {
        let camera = Camera::fit([[-1.0; 3], [1.0; 3]], 2, [100, 100]);
        // A cloth in gusts.
        let drawn = |name: &str| name == "space";
        for (name, keys, _) in SCENES {
            let scene = scene_of(name, keys);
            for plays in [false, true] {
                for dice in [false, true] {
                    let another = match dice {
                        false => EMPTY.scene().unwrap(),
                        true => match rolled(&scene, 7) {
                            Ok(scene) => scene,
                            Err(words) => {
                                assert!(!words.is_empty() && !drawn(name), "{name}");
                                continue;
                            }
                        },
                    };
                    assert!(!dice || drawn(name), "{name}");
                    let mut shelf = Shelf::default();
                    let mut first = opened(scene.clone(), plays);
                    passed(&mut first, 4);
                    let mut left = Left::now(first, camera);
                    let (time, places) = passed(&mut left.player, 0);
                    // Obstacles alone stand still.
                    assert_eq!(time > 0.0, plays && !places.is_empty(), "{name}");
                    shelf.keep(left);
                    let mut second = opened(another, plays);
                    let (_, others) = passed(&mut second, 4);
                    assert_eq!(others.is_empty(), !dice, "{name}");
                    assert!(!dice || !plays || others != places, "{name} is the same as before");
                    assert!(leaving(shelf.has_before(), second.is_used()) == Leaving::Goes, "undo goes back at once");
                    let (mut back, _) = shelf.back().unwrap().again(second.is_playing());
                    assert_eq!(back.is_playing(), plays, "{name}");
                    back.play(false);
                    assert_eq!(passed(&mut back, 0), (time, places), "{name}");
                }
            }
        }
    }
}
