//! Trails of points, of the world and of what stands beside it.

use super::Session;
use crate::app::player::Probe;
use crate::app::trailing::TrailSettings;
use crate::render::Trails;
use crate::sim::PointId;

/// The trails of the world, and of what stands beside it.
#[derive(Clone, Copy)]
pub(super) struct AllTrails<'a>(pub(super) &'a Trails, pub(super) &'a [Trails]);

impl<'a> AllTrails<'a> {
    /// Those of a world, with the place of their colour: the world itself is the first.
    pub(super) fn of(self, place: usize) -> Vec<(&'a Trails, usize)> {
        let trails = if place == 0 { Some(self.0) } else { self.1.get(place - 1) };
        trails.map(|trails| (trails, place)).into_iter().collect()
    }
}

impl Session {
    /// Points have trails from now on, or have none.
    pub(super) fn toggle_trails(&mut self) {
        self.trailing.toggle();
    }

    /// As many points have trails as this says, so long, at the next start too.
    pub(super) fn set_trails(&mut self, settings: TrailSettings) {
        self.trailing.settings = settings.kept();
        self.keep_preferences();
    }

    /// Notes where the followed points of all worlds are.
    pub(super) fn note_trails(&mut self) {
        if !self.player.is_open() {
            return;
        }
        let length = self.trailing.settings.length * self.scene.rate();
        let probed = self.probed_points();
        let shown = self.player.shown();
        let (view, time) = (shown.view(), shown.figures.time);
        let followed = self.trailing.follow(&view, probed, &self.inspected.points);
        self.trails.set_length(length);
        self.trails.note(time, &view, followed);
        self.beside_trails.resize_with(shown.beside.len(), || Trails::new(length));
        for (trails, world) in self.beside_trails.iter_mut().zip(&shown.beside) {
            trails.set_length(length);
            // One that is behind is not where its points are at this time.
            if world.farthest.is_some() || followed.is_empty() {
                trails.note(time, &world.view(shown.dimensions), followed);
            }
        }
    }

    /// The points that are probed, with the ends of probed bonds.
    pub(super) fn probed_points(&self) -> Vec<PointId> {
        let scenery = &self.player.shown().scenery;
        let points = |(_, probe)| match probe {
            Probe::Point(point) => vec![point],
            Probe::Bond(number) => scenery.bond_ends(number).map(Vec::from).unwrap_or_default(),
            Probe::Corner(points) => points.to_vec(),
        };
        self.probes().flat_map(points).collect()
    }
}
