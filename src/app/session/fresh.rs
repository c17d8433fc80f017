//! Scenes that begin anew: an empty one, the same without bodies, the same drawn by another lot.

use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use super::{Framing, Session};
use crate::app::tools::clear_bodies;
use crate::history::Start;
use crate::scene::{EMPTY, MakerName, Scene};

/// Seeds that the dice draw are below this: few digits, as one writes them.
const SEEDS: u64 = 1_000_000;

impl Session {
    /// Opens an empty scene, in which time runs if it did: what is built there falls. The present one is kept, and undo goes back to it.
    pub(super) fn open_empty(&mut self) {
        match EMPTY.scene() {
            Ok(scene) => {
                let plays = self.player.is_playing();
                self.open(scene.into());
                self.player.play(plays);
                self.say(empty_words(plays).to_owned());
            }
            Err(error) => self.complain(&error.to_string()),
        }
    }

    /// Takes away all bodies: obstacles stay.
    pub(super) fn clear(&mut self) {
        let deed = self.with_scope(|_, scope| clear_bodies(scope));
        self.do_deed(deed);
    }

    /// A history goes on from this moment with what is fixed when one begins: it is looked at as before, and undo goes back.
    pub(super) fn begin_from_here(&mut self, start: Start) {
        let (camera, plays) = (self.camera, self.player.is_playing());
        let file = self.player.file().map(Path::to_owned);
        self.open(start);
        file.iter().for_each(|file| self.player.lie_in(file));
        self.player.play(plays);
        self.looks_again = Some(camera);
        (self.camera, self.framing) = (camera, Framing::Free);
        self.say("it goes on from here, as a history of its own: Ctrl+Z goes back".to_owned());
    }

    /// Opens the scene with all that it draws by lot drawn anew.
    pub(super) fn roll(&mut self) {
        let seed = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |now| now.subsec_nanos().into());
        match rolled(&self.scene, seed % SEEDS) {
            Ok(scene) => {
                self.open(scene.into());
                self.say("drawn anew: Ctrl+Z goes back".to_owned());
            }
            Err(words) => self.say(words.to_owned()),
        }
    }
}

/// What is said of an empty scene in which time runs or stands still.
fn empty_words(plays: bool) -> &'static str {
    match plays {
        true => "an empty scene: build (5), draw (N), or open a picture; Ctrl+Z goes back",
        false => "an empty scene, paused: Space runs it; build (5), draw (N), or open a picture; Ctrl+Z goes back",
    }
}

/// A scene with all that it draws by lot drawn anew; else words that nothing is.
pub(super) fn rolled(scene: &Scene, seed: u64) -> Result<Scene, &'static str> {
    let mut scene = scene.clone();
    if reseeded(&mut scene, seed) { Ok(scene) } else { Err("nothing in this scene is random") }
}

/// Gives all that a scene draws by lot other seeds, from `seed` on. Returns whether there is anything.
pub(in crate::app) fn reseeded(scene: &mut Scene, seed: u64) -> bool {
    let mut next = seed;
    for own in seeds(scene) {
        *own = Some(next);
        next += 1;
    }
    next > seed
}

/// Gives what a scene draws by lot the seeds of another one, where that draws as much.
pub(super) fn seeded_as(scene: &mut Scene, other: &Scene) {
    let mut other = other.clone();
    let of_other: Vec<Option<u64>> = seeds(&mut other).map(|seed| *seed).collect();
    if seeds(scene).count() == of_other.len() {
        seeds(scene).zip(of_other).for_each(|(own, seed)| *own = seed);
    }
}

/// The seeds of all that a scene draws by lot.
fn seeds(scene: &mut Scene) -> impl Iterator<Item = &mut Option<u64>> {
    let is_drawn = |make: MakerName| matches!(make, MakerName::Points | MakerName::RandomGraph);
    let of_bodies = scene.bodies.iter_mut().filter(move |body| is_drawn(body.make)).map(|body| &mut body.seed);
    let of_wind = scene.wind.iter_mut().filter(|wind| wind.turbulence.is_some()).map(|wind| &mut wind.seed);
    of_bodies.chain(of_wind)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::scene::gallery;

    #[test]
    fn an_empty_scene_has_a_floor_walls_and_gravity_and_takes_bodies() {
        let scene = EMPTY.scene().unwrap();
        let world = scene.world(None).unwrap();
        assert_eq!((world.point_count(), world.dimensions()), (0, 2));
        assert!(world.contact().is_some() && world.bounds().is_some() && world.mouse_force().is_some());
        assert_eq!(world.settings().gravity, Some([0.0, -9.81, 0.0]));
    }

    #[test]
    fn an_empty_scene_after_a_pause_says_what_runs_it() {
        assert!(empty_words(false).contains("paused: Space runs it") && !empty_words(true).contains("Space"));
    }

    #[test]
    fn another_seed_makes_another_scene_and_what_has_none_stays() {
        let named = |name: &str| gallery().iter().find(|entry| entry.name == name).unwrap().scene().unwrap();
        let places = |scene: &Scene| {
            let sample = scene.world(None).unwrap().sample(0.0);
            sample.position
        };
        let mut scene = named("points");
        let before = places(&scene);
        assert!(reseeded(&mut scene, 5));
        let after = places(&scene);
        assert!(before.len() == after.len() && before != after);
        assert!(reseeded(&mut scene, 6) && places(&scene) != after);
        assert!(!reseeded(&mut named("rim"), 5));
    }
}
