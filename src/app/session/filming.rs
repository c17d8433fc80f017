//! Clips of the last seconds: how they are looked at, and what becomes of them.

use std::path::PathBuf;
use std::sync::mpsc::channel;

use super::Session;
use crate::app::film::{Filmed, Filming, Followers, Shot, look_of_clip};
use crate::app::player::Order;
use crate::render::{Overlay, Trails};

impl Session {
    /// Draws the last seconds as they are seen, without panels, while the window goes on, and writes them there.
    pub(super) fn save_clip(&mut self, path: PathBuf) {
        if !self.player.is_open() || self.area.contains(&0) {
            return;
        }
        if self.filming.is_some() {
            return self
                .say("one clip after another: wait for the one that is being written, or give it up (Esc)".to_owned());
        }
        let settings = self.panels.save_to.clip;
        let shot = self.shot(settings.size(self.area));
        let (seconds, trail) = (settings.seconds, shot.trail);
        let (sender, reel) = channel();
        self.player.ask(Order::Copy(Box::new(move |history| {
            // One that was given up is not waited for.
            let _ = sender.send(history.reel(seconds * history.clock().rate + trail));
        })));
        let gpu = self.canvas.gpu().clone();
        self.filming = Some(Filming::new((gpu, shot), reel, settings, path, self.wake_up()));
        self.touch();
    }

    /// The world as it is looked at now, in pictures of another size `[px]`.
    fn shot(&self, size: [u32; 2]) -> Shot {
        let tiles = self.tiles.at_scale(f64::from(size[1]) / f64::from(self.area[1]));
        let mut camera = self.own_camera();
        camera.resize(tiles.pane(size));
        let look = look_of_clip(self.look, size, self.live_force().is_some());
        Shot {
            tiles,
            camera,
            followed: self.follows.then(|| self.followed.clone()),
            look,
            beside: if self.tints_distance { Overlay::Difference } else { look.overlay },
            palette: self.palette,
            has_labels: !self.panels.hides_hud,
            followers: self.followers(),
            trail: self.trailing.settings.length * self.scene.rate(),
            size,
        }
    }

    /// Which points have trails, as it is now.
    fn followers(&self) -> Followers {
        if !self.trailing.is_on() {
            return Box::new(|_| Vec::new());
        }
        let (probed, selected) = (self.probed_points(), self.inspected.points.clone());
        let most = self.trailing.settings.most;
        Box::new(move |view| Trails::choose(view, &[&probed, &selected], most))
    }

    /// The clip that is being drawn is not wanted: another one may begin at once. Returns whether there was one.
    pub(super) fn give_up_clip(&mut self) -> bool {
        // One that goes to its file is heard of.
        let Some(filming) = self.filming.take_if(|filming| filming.give_up()) else { return false };
        // It may be at a picture, or wait for what it is of: the window goes on.
        self.unwanted.take(filming.into_aside());
        self.say("given up: no clip was written".to_owned());
        self.have_filmed(false);
        self.touch();
        true
    }

    /// Looks how far the clip is, and says what became of it.
    pub(super) fn hear_of_clip(&mut self) {
        let Some(filming) = &self.filming else { return };
        let (path, filmed) = (filming.path().to_owned(), filming.take());
        let is_written = filmed == Some(Filmed::Written);
        match filmed {
            None => {
                self.panels_dirty = true;
                return;
            }
            Some(Filmed::Written) => self.say(format!("written: {}", path.display())),
            // That was said then.
            Some(Filmed::GivenUp) => {}
            Some(Filmed::Failed(why)) => self.complain(&why),
        }
        self.filming = None;
        self.have_filmed(is_written);
        self.touch();
    }
}
