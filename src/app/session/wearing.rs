//! A body that there is gets another picture.

use std::path::Path;

use super::Session;
use crate::app::matter::worn;
use crate::app::recent::Used;
use crate::app::tools::Chosen;
use crate::picture::decode;
use crate::sim::PointId;

impl Session {
    /// Asks for the file of the picture that what is selected is to wear.
    pub(super) fn choose_to_wear(&mut self) {
        let Some(Chosen { points, .. }) = self.selected() else { return };
        self.wearer = Some(points);
        self.choose_file();
    }

    /// Points wear the picture of a file: it covers what they cover now.
    pub(super) fn wear(&mut self, path: &Path, points: Vec<PointId>) {
        let picture = std::fs::read(path).map_err(|error| error.to_string());
        let picture = picture.and_then(|bytes| decode(&bytes).map_err(|error| error.to_string()));
        let shown = self.shown();
        let done = picture.and_then(|picture| worn(&picture, &points, |point| shown.place(point.index())));
        match done {
            Ok(act) => {
                self.remember(path, Used::Opened);
                self.player.give(vec![act], Some("picture"));
                self.dirty = true;
            }
            Err(why) => self.complain(&format!("{}: {why}", path.display())),
        }
        self.touch();
    }
}
