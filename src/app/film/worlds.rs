//! The worlds of a picture: one, and the same start by other methods beside it.

use super::Followers;
use crate::history::{Companion, Entry, HistoryError, Recording, distances};
use crate::picture::{Skin, Tint};
use crate::render::{Trails, View};
use crate::scene::BesideKeys;
use crate::sim::{Cursor, Dynamics, MouseForce, Positions};

/// A world at a time that lies in its next substep.
pub(super) struct Moment<'a> {
    world: &'a dyn Dynamics,
    skins: &'a [Skin],
    tints: &'a [Tint],
    time: f64,
    /// Where its points are `[m]`.
    places: Vec<f64>,
    /// How far they are from where the first world has them `[m]`.
    distances: Option<Vec<f32>>,
    pub(super) trails: &'a Trails,
}

impl<'a> Moment<'a> {
    /// A world at `time` `[s]`, whose trails go on to there.
    pub(super) fn of(
        world: &'a dyn Dynamics,
        (skins, tints): (&'a [Skin], &'a [Tint]),
        time: f64,
        (trails, followers): (&'a mut Trails, &Followers),
    ) -> Self {
        let dimensions = world.dimensions();
        let sample = world.sample(time.max(world.time()));
        let places: Vec<f64> = sample.position.iter().flat_map(|x| &x[..dimensions]).copied().collect();
        let places_now = Positions::F64(&places);
        let view = View { previous: places_now, current: places_now, ..View::of(world) };
        trails.note(time, &view, &followers(&view));
        Moment { world, skins, tints, time, places, distances: None, trails }
    }

    /// As the renderer reads it; `motion` is the number of the picture.
    pub(super) fn view(&self, motion: u64) -> View<'_> {
        let Moment { world, skins, tints, time, ref places, ref distances, .. } = *self;
        let on_track = |(force, cursor): (_, Cursor)| {
            let force: &MouseForce = force;
            (force, force.track.at(time).map_or(cursor, Cursor::at))
        };
        View {
            previous: Positions::F64(places),
            current: Positions::F64(places),
            motion,
            mouse: world.mouse().map(on_track),
            skins,
            tints,
            values: distances.as_deref(),
            ..View::of(world)
        }
    }
}

/// The same start by other methods, with skins and trails of their own.
pub(super) struct Neighbors {
    companions: Vec<(Companion, Vec<Skin>, Trails)>,
}

impl Neighbors {
    /// Errors: a method that cannot run the scene.
    pub(super) fn new(start: &Recording, beside: &[BesideKeys], length: f64) -> Result<Self, HistoryError> {
        let of = |entry| Ok((Companion::new(start, entry)?, Vec::new(), Trails::new(length)));
        Ok(Neighbors { companions: beside.iter().map(of).collect::<Result<_, HistoryError>>()? })
    }

    /// What stands above each.
    pub(super) fn titles(&self) -> Vec<&str> {
        self.companions.iter().map(|(companion, ..)| companion.title()).collect()
    }

    /// When the one that is behind all others is, if there are any `[s]`.
    pub(super) fn time(&self) -> Option<f64> {
        self.companions.iter().map(|(companion, ..)| companion.world().time()).min_by(f64::total_cmp)
    }

    pub(super) fn reach(&mut self, commands: &[Entry], time: f64) {
        for (companion, skins, _) in &mut self.companions {
            companion.reach(commands, time);
            *skins = companion.skins();
        }
    }

    pub(super) fn note(&mut self, followers: &Followers) {
        for (companion, _, trails) in &mut self.companions {
            let view = View::of(companion.world());
            trails.note(companion.world().time(), &view, &followers(&view));
        }
    }

    /// All of them at `time` `[s]`, and how far from the first.
    pub(super) fn moments<'a>(&'a mut self, time: f64, main: &Moment<'_>, followers: &Followers) -> Vec<Moment<'a>> {
        let of = |(companion, skins, trails): &'a mut (Companion, Vec<Skin>, Trails)| {
            let companion: &'a Companion = companion;
            let moment = Moment::of(companion.world(), (skins, companion.tints()), time, (trails, followers));
            let apart = distances(&main.places, &moment.places, companion.world().dimensions());
            Moment { distances: Some(apart), ..moment }
        };
        self.companions.iter_mut().map(of).collect()
    }
}
