//! Scenes and recordings that come, and those that are left for them.

use std::sync::Arc;
use std::time::Instant;

use super::fresh::seeded_as;
use super::{Framing, Session};
use crate::app::action::Tool;
use crate::app::leftovers::title;
use crate::app::panels::{At, HeldAt, Opening};
use crate::app::player::{Player, too_many_to_meet};
use crate::app::tools::Chosen;
use crate::app::warnings::seen;
use crate::history::Start;
use crate::render::Trails;
use crate::scene::{MOST_MEETING, Scene, SolverName, gallery};

impl Session {
    /// Opens another scene, or a recording, in place of this one, which can be gone back to.
    pub(super) fn open(&mut self, start: Start) {
        self.open_for(start, None);
    }

    /// The same, for a step of a lesson.
    pub(super) fn open_for(&mut self, start: Start, step: Option<At>) {
        self.teaches = step;
        let keeping = self.keeping();
        let is_another = start.scene().name() != self.scene.name();
        let player = Player::open(start, keeping, self.wake_up());
        self.put_on(player);
        if is_another {
            // What was held for the scene before would surprise in this one.
            self.hand.take(Tool::Hand);
        }
    }

    /// Plays another history; the present one goes onto the shelf.
    pub(super) fn put_on(&mut self, player: Player) {
        self.leave_drawing();
        // Whoever opens something else wants that.
        self.panels.notes.offer = None;
        self.take_leave();
        let mut last = self.exchange(player);
        (self.taught, self.came, self.looks_again) = (None, None, None);
        let recorded = last.player.record().map(|path| path.display().to_string());
        let is_unfolding = last.player.is_unfolding();
        if is_unfolding {
            last.player.stay_folded();
        }
        let stands_in = std::mem::take(&mut self.stands_in);
        if is_gone_back_to(&last.player, (self.opening_since.is_some(), stands_in)) || is_unfolding {
            self.shelf.keep(last);
        }
        self.await_it();
        self.begin();
        self.settle();
        if let Some(path) = recorded {
            self.say(format!("{path} has all that was done so far; another scene is not recorded there"));
        }
    }

    /// A history is being made: it is called by its name from now on.
    pub(super) fn await_it(&mut self) {
        self.opening_since = Some(Instant::now());
        let scene = self.player.start().scene().clone();
        self.place = place_of(&scene);
        self.scene = Arc::new(scene);
        self.call_window();
        (self.named, self.has_picture) = (Vec::new(), false);
        self.panels.notes.has_caption = false;
        self.panels.notes.close();
        self.panels.notes.begin();
    }

    /// The window is called by what is open in it, or will be.
    pub(super) fn call_window(&self) {
        let coming = if self.opening_since.is_some() { " …" } else { "" };
        self.window.set_title(&format!("wobble · {}{coming}", title(self.player.start())));
    }

    /// A history that is being made is not waited for: the one before it is there again. Returns whether there is one.
    pub(in crate::app) fn stop_opening(&mut self) -> bool {
        if self.opening_since.is_some() && self.stay_where_one_was() {
            return true;
        }
        if self.opening_since.is_none() || self.player.record().is_some() {
            return false;
        }
        let Some(left) = self.shelf.back() else { return false };
        self.teaches = None;
        drop(self.bring_back(left));
        self.settle();
        true
    }

    /// For how long a history is being made, how much of it is there, and whether it can be given up for another.
    pub(super) fn opening(&self) -> Option<Opening> {
        let can_stop = self.came.is_some() || self.shelf.has_before() && self.player.record().is_none();
        let share = self.player.is_unfolding().then(|| self.player.worked_out());
        self.opening_since.map(|since| Opening { since: since.elapsed().as_secs_f64(), share, can_stop })
    }

    /// The present history is left for another: nothing hangs on the hand in it.
    pub(in crate::app) fn take_leave(&mut self) {
        self.stop_driving();
        let deed = self.hand.leave();
        self.do_deed(deed);
        self.tell_press();
    }

    /// Another history is shown: nothing of the last one is under way any more.
    pub(super) fn begin(&mut self) {
        self.hand.let_go();
        self.hand.renew_brush();
        self.whereabouts.begin();
        self.painted.clear();
        self.wearer = None;
        (self.asked, self.duplicated) = (None, None);
        self.inspected = Chosen::default();
        self.driving.clear();
        self.close_sheet();
        (self.rewinds, self.last_frame, self.told, self.gone_by) = (false, None, None, None);
        self.plot_anew();
        self.touch();
        let news = self.player.poll();
        self.hear(news);
    }

    /// The history is there: its scene is shown as it opens.
    pub(super) fn arrive(&mut self, scene: Arc<Scene>) {
        (self.opening_since, self.came) = (None, None);
        self.follows = false;
        self.canvas.forget_world(scene.dimensions());
        self.has_picture = scene.picture_body().is_some();
        self.look.has_mesh = false;
        self.trails = Trails::new(self.trailing.settings.length * scene.rate());
        self.trailing.enter(scene.name());
        self.beside_trails.clear();
        (self.cell, self.misfits.0, self.most_apart) = (0, None, 0.0);
        self.tints_distance = scene.method.solver == Some(SolverName::AsPrinted);
        self.named = scene.named_parameters();
        self.place = place_of(&scene);
        self.scene = scene;
        self.call_window();
        self.plot_anew();
        self.panels.held_at = HeldAt::default();
        self.frame_as(Framing::Opening);
        // Of what was done all is seen.
        if self.player.is_resumed() && !self.sees_all() {
            self.frame_as(Framing::Fit);
        }
        if let Some(camera) = self.looks_again.take() {
            (self.camera, self.framing, self.follows) = (camera, Framing::Free, false);
            self.camera.resize(self.area);
        }
        self.take_base();
        let passes =
            self.has_picture && self.scene.contact.is_none() && self.shown().scenery.bonds.len() > MOST_MEETING;
        let through = passes.then(|| format!("its bodies pass through each other: {}", too_many_to_meet()));
        let warnings: Vec<&str> = self.shown().scenery.warnings.iter().map(|line| seen(line)).collect();
        let warning = (!warnings.is_empty()).then(|| listed(&warnings));
        let said: Vec<String> = [warning, through, self.taken_keys()].into_iter().flatten().collect();
        match said.is_empty() {
            true => _ = self.panels.notes.close(),
            false => self.panels.notes.tell(said.join("\n")),
        }
        self.panels.notes.begin();
        if self.player.is_resumed() {
            self.say(RESUMED.to_owned());
        } else if self.player.start().is_replayed() {
            self.panels.notes.warn(REPLAYED.to_owned());
        }
        self.panels.notes.has_caption = true;
        self.wants_hint &= self.place == Some(0);
        self.place_hint();
        match self.teaches.take() {
            Some(at) => {
                self.panels.lessons.enter(at);
                self.taught = Some(at);
                self.lay_out(at);
            }
            None => self.leave_lesson(),
        }
        self.touch();
    }
}

/// Whether undo goes back to a history that is left: not to one that nobody has seen yet, or that only stood there until a picture came, unless
/// something is to be kept of it.
fn is_gone_back_to(player: &Player, (is_unseen, stands_in): (bool, bool)) -> bool {
    player.record().is_some() || !is_unseen && (!stands_in || player.is_unsaved())
}

/// The place in the gallery of a scene that is in it: not of another one that is called so.
fn place_of(scene: &Scene) -> Option<usize> {
    let place = gallery().iter().position(|entry| entry.name == scene.name())?;
    let own = gallery()[place].scene().ok()?;
    // What stands beside it may have been changed, and what it draws by lot drawn anew.
    let mut alone = Scene { name: own.name.clone(), beside: own.beside.clone(), ..scene.clone() };
    seeded_as(&mut alone, &own);
    (alone == own).then_some(place)
}

/// Said of a session that was cut off as it is there again.
const RESUMED: &str = "as it was when it was cut off: play goes on from there";
/// Said of a recording as it opens.
const REPLAYED: &str = "a recording: it is replayed as it was done. A press on the world takes over from there; the list beside the \
                        timeline leads back to what was recorded";

/// So many warnings are shown at once, a line each.
const MOST_WARNINGS: usize = 3;

/// Warnings below each other, the first few of many.
fn listed(warnings: &[&str]) -> String {
    let shown = warnings.iter().take(MOST_WARNINGS).map(|line| (*line).to_owned());
    let more = warnings.len().saturating_sub(MOST_WARNINGS);
    let rest = (more > 0).then(|| format!("and {more} more: `wobble simulate` lists all"));
    shown.chain(rest).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::super::fresh::rolled;
    use super::{gallery, is_gone_back_to, listed, place_of};
    use crate::app::player::{Keeping, Player};
    use crate::history::Do;
    use crate::scene::Scene;
    use crate::sim::PointId;

    #[test]
    fn undo_goes_back_to_no_history_that_only_stood_there_until_a_picture_came() {
        let text = r#"{"wobble": 1, "points": {"position": [[0, 0]]}}"#;
        let Ok(scene) = Scene::parse(text, "x.json") else { return };
        let mut player = Player::open(scene.into(), Keeping::default(), || {});
        let [seen, unseen] = [false, true];
        assert!(is_gone_back_to(&player, (seen, false)) && !is_gone_back_to(&player, (unseen, false)));
        assert!(!is_gone_back_to(&player, (seen, true)), "nothing was done there");
        player.give(vec![Do::Pin(vec![PointId(0)])], Some("pin"));
        assert!(is_gone_back_to(&player, (seen, true)), "what was built there is not lost");
    }

    #[test]
    fn a_scene_that_is_called_as_one_of_the_gallery_is_none_of_it() {
        let own = gallery()[1].scene();
        assert_eq!(own.ok().and_then(|scene| place_of(&scene)), Some(1));
        let text = r#"{"wobble": 1, "name": "rope", "points": {"position": [[0, 0]]}}"#;
        assert_eq!(Scene::parse(text, "x.json").ok().and_then(|scene| place_of(&scene)), None);
    }

    #[test]
    fn a_scene_whose_lot_was_drawn_anew_is_of_the_gallery_still() {
        let place = gallery().iter().position(|entry| entry.name == "random-graph");
        let own = place.and_then(|place| gallery()[place].scene().ok());
        let anew = own.as_ref().and_then(|own| rolled(own, 40).ok());
        assert!(place.is_some() && anew != own);
        assert_eq!(anew.as_ref().and_then(place_of), place);
        let other = anew.map(|anew| Scene { gravity: Some(crate::scene::Vector::Plane([0.0, 1.0])), ..anew });
        assert_eq!(other.as_ref().and_then(place_of), None, "that is another one");
    }

    #[test]
    fn of_many_warnings_the_first_are_listed() {
        let all = ["a", "b", "c", "d", "e"];
        assert_eq!(listed(&all[..2]), "a\nb");
        assert_eq!(listed(&all), "a\nb\nc\nand 2 more: `wobble simulate` lists all");
    }
}
