//! What stands beside a world, as the window shows it, and how much of a frame's time it may take.

use std::sync::Arc;
use std::time::Instant;

use super::pace::Pace;
use super::rungs::Load;
use super::shown::{Places, Scenery};
use super::watch::Watch;
use crate::history::{Companion, History, distances, interpolate};
use crate::render::View;
use crate::scene::{BesideKeys, BudgetKeys, MethodKeys, PrecisionName, SolverName};
use crate::sim::Positions;

/// Wall time that companions may take of a frame while the world moves, and while it does not `[s]`.
const BUDGETS: [f64; 2] = [0.012, 0.030];
/// Times that differ by less than this share of a step are the same.
const SLACK: f64 = 1e-9;
/// Wall time for which companions may stay behind a moving world, and come no nearer, until they wait for it to pause `[s]`.
const PATIENCE: f64 = 3.0;
/// What will be there within this wall time, at the pace of late, catches up `[s]`.
const SOON: f64 = 60.0;
/// Wall time for which the world may be late until they wait `[s]`.
const OVERLOAD: f64 = 0.5;
/// Wall time that they may be behind without being late `[s]`.
const LAG: f64 = 0.1;

/// A companion of a world, as it is drawn.
#[derive(Clone, Debug, Default)]
pub struct Beside {
    /// What it is asked for by.
    pub entry: BesideKeys,
    /// What stands above it.
    pub title: String,
    /// Where its points are `[m]`.
    pub places: Places,
    /// Changes whenever its places did.
    pub motion: u64,
    /// Changes whenever its scenery did.
    pub topology: u64,
    /// What stands about its points.
    pub scenery: Arc<Scenery>,
    /// How far each point is from where the world has it `[m]`; NaN of points that one of them has not.
    pub distances: Vec<f32>,
    /// The largest of them `[m]`, where it is at the world's time.
    pub farthest: Option<f32>,
    /// What is to be said of it beside its title, in place of how far it is.
    pub words: String,
    /// What it kept of its own, to be said after how far it is; empty: nothing.
    pub kept: String,
    /// It came to rest.
    pub rests: bool,
}

impl Beside {
    /// As the renderer reads it.
    pub fn view(&self, dimensions: usize) -> View<'_> {
        View {
            previous: self.places.view(),
            current: self.places.view(),
            motion: self.motion,
            topology: self.topology,
            values: Some(&self.distances),
            ..self.scenery.view(dimensions)
        }
    }
}

/// Brings companions along, as far as there is time for them.
#[derive(Default)]
pub(super) struct Escort {
    /// What was looked at last of each: the topology as its world counts it, its number among all, and what stood there.
    known: Vec<(Option<u64>, u64, Arc<Scenery>)>,
    /// Where each has been since when `[s]`, as far as it stayed there.
    still: Vec<Still>,
    /// Where each was at the two states of the world between which the picture lies.
    ends: Vec<Ends>,
    /// Where the points of the first one were at the time that was told of last `[m]`.
    told: Vec<f64>,
    sceneries: u64,
    motion: u64,
    late: Late,
    /// Wall time for which the world itself has been late `[s]`.
    overload: f64,
    /// They wait until the world pauses: it was said that they are too dear.
    waits: bool,
    /// All of them are where the world is.
    is_there: bool,
}

impl Escort {
    /// Others stand there now.
    pub(super) fn begin(&mut self) {
        *self = Escort { motion: self.motion + 1, sceneries: self.sceneries, ..Escort::default() };
    }

    /// The history went elsewhere: of another past, a topology of the same number may be another.
    pub(super) fn have_gone(&mut self) {
        self.known.iter_mut().for_each(|(topology, ..)| *topology = None);
        self.ends.clear();
        self.motion += 1;
    }

    /// Whether some are on their way, which asks for further frames.
    pub(super) fn is_behind(&self, history: &History) -> bool {
        !history.companions().is_empty() && !self.is_there
    }

    /// Where steps take more time than there is, companions wait for the world to pause before anything else gives way. Returns whether
    /// that is still to be seen.
    pub(super) fn gives_way(&mut self, history: &History, load: Load) -> bool {
        if history.companions().is_empty() || self.waits {
            return false;
        }
        self.overload = if load.is_late { self.overload + load.wall } else { 0.0 };
        self.waits = self.overload > OVERLOAD;
        load.is_late
    }

    /// A frame of `wall` `[s]` passed: companions come along. Returns the wall time that this took `[s]`.
    pub(super) fn come(&mut self, history: &mut History, pace: &mut Pace, wall: f64) -> f64 {
        if history.companions().is_empty() {
            pace.watch.forget_waiting();
            return 0.0;
        }
        let moves = pace.is_moving(history);
        self.waits &= moves;
        if self.waits {
            self.is_there = false;
            return 0.0;
        }
        let (start, states) = (Instant::now(), pace.states(history));
        let time = states[1];
        let before = self.place(history);
        let budget = BUDGETS[usize::from(!moves)];
        let was_there = self.is_there;
        self.is_there = self.bring(history, (states, &mut pace.watch), &mut || start.elapsed().as_secs_f64() < budget);
        self.motion += u64::from(self.place(history) != before || !was_there || moves);
        let behind = history.companions().iter().map(|companion| time - companion.world().time()).fold(0.0, f64::max);
        let is_late = !self.is_there && moves && behind > LAG * pace.rate;
        self.waits = self.late.is_hopeless(is_late.then_some(behind), wall);
        start.elapsed().as_secs_f64()
    }

    /// Companions go to both states of the world that the picture lies between, `[s]`, as far as `goes_on` lets them: points on straight lines between
    /// these are as far from the truth in all worlds, and what is left between them is what their methods differ by. Returns whether all are there.
    ///
    /// On the way it is told to those who look where the first of them has what is probed, at the times of measurements.
    fn bring(
        &mut self,
        history: &mut History,
        ([from, to], watch): ([f64; 2], &mut Watch),
        goes_on: &mut dyn FnMut() -> bool,
    ) -> bool {
        self.ends.resize_with(history.companions().len(), Ends::default);
        // Those whose last step begins after the first state would have to go back, and were there.
        let is_beyond = |companion: &Companion| companion.began() > from + slack(companion);
        if !self.tell(history, (from, watch), goes_on) {
            return false;
        }
        if from < to && !history.companions().iter().any(is_beyond) {
            if !history.bring_along(from, goes_on) {
                return false;
            }
            self.note_ends(history, from);
        }
        if !self.tell(history, (to, watch), goes_on) {
            return false;
        }
        let are_there = history.bring_along(to, goes_on);
        self.note_ends(history, to);
        are_there
    }

    /// Companions go to the times of measurements up to `end` `[s]`, as far as `goes_on` lets them. Returns whether they have been there.
    fn tell(
        &mut self,
        history: &mut History,
        (end, watch): (f64, &mut Watch),
        goes_on: &mut dyn FnMut() -> bool,
    ) -> bool {
        while let Some(time) = watch.awaited(end) {
            let is_beyond = |first: &Companion| first.began() > time + slack(first);
            let was_there = history.companions().first().is_none_or(is_beyond);
            if !was_there && !history.bring_along(time, goes_on) {
                return false;
            }
            let dimensions = history.world().dimensions();
            if let Some(first) = history.companions().first().filter(|_| !was_there) {
                first.places(time, &mut self.told);
            }
            watch.tell((!was_there).then_some(self.told.as_slice()), dimensions);
        }
        true
    }

    fn note_ends(&mut self, history: &History, time: f64) {
        let companions = history.companions().iter();
        self.ends.iter_mut().zip(companions).for_each(|(ends, companion)| ends.note(companion, time));
    }

    /// Changes when any of them moved on.
    fn place(&self, history: &History) -> f64 {
        history.companions().iter().map(|companion| companion.world().time()).sum()
    }

    /// Puts the present moment of all into `shown`, whose memory is used again.
    pub(super) fn show(&mut self, history: &History, pace: &Pace, mix: f32, shown: &mut Vec<Beside>) {
        let companions = history.companions();
        shown.truncate(companions.len());
        shown.resize_with(companions.len(), Beside::default);
        if companions.is_empty() {
            return;
        }
        self.known.resize_with(companions.len(), Default::default);
        self.still.resize_with(companions.len(), Default::default);
        let (states, shown_time, dimensions) =
            (pace.states(history), pace.shown_time(history), history.world().dimensions());
        let time = states[1];
        let mut main = Vec::new();
        interpolate(pace.previous.view(), history.world().positions(), f64::from(mix), &mut main);
        for (place, (companion, to)) in companions.iter().zip(shown).enumerate() {
            let reached = companion.world().time();
            let is_there = reached >= time - slack(companion);
            let mut places = match std::mem::take(&mut to.places) {
                Places::F64(list) => list,
                Places::F32(_) => Vec::new(),
            };
            let known = self.ends.get(place).filter(|ends| ends.know(states));
            match known {
                Some(ends) => ends.mix(f64::from(mix), &mut places),
                None => companion.places(shown_time, &mut places),
            }
            to.distances = distances(&main, &places, dimensions);
            let most = to.distances.iter().copied().filter(|distance| !distance.is_nan()).fold(0.0, f32::max);
            // What is behind by less than is seen says what it said before, and so does what came there just now, on another line.
            if (is_there && known.is_some()) || reached < time - LAG * pace.rate || self.waits {
                to.farthest = is_there.then_some(most);
                to.words = self.words(companion, is_there, time);
            }
            to.rests = is_there && (companion.world().is_asleep() || self.still[place].look(&places, shown_time));
            to.kept = companion.kept_own().unwrap_or_default().to_owned();
            to.places = Places::F64(places);
            to.motion = self.motion;
            to.title = companion.words();
            to.entry.clone_from(companion.entry());
            (to.topology, to.scenery) = self.look(place, companion, history);
        }
    }

    /// What stands about the points of a companion, looked at again if it changed.
    fn look(&mut self, place: usize, companion: &Companion, history: &History) -> (u64, Arc<Scenery>) {
        let topology = companion.world().topology();
        let (known, number, scenery) = &mut self.known[place];
        if *known != Some(topology) {
            let skins = companion.skins();
            let dress = (&Arc::from(companion.tints()), history.named());
            *scenery = Arc::new(Scenery::of(companion.world(), &skins, dress));
            self.sceneries += 1;
            (*known, *number) = (Some(topology), self.sceneries);
        }
        (*number, Arc::clone(scenery))
    }

    fn words(&self, companion: &Companion, is_there: bool, time: f64) -> String {
        let at = companion.world().time();
        match companion.refused() {
            Some(why) => why.to_owned(),
            None if self.waits => format!("too slow to go along: it stands at {at:.1} s, and catches up in a pause"),
            None if !is_there => format!("catches up: {at:.1} of {time:.1} s"),
            None => String::new(),
        }
    }
}

/// Times of a companion that differ by less are the same `[s]`.
fn slack(companion: &Companion) -> f64 {
    SLACK * companion.world().substep()
}

/// Where a companion was at two times.
#[derive(Default)]
struct Ends {
    /// `[s]`.
    times: [f64; 2],
    /// `[m]`; empty: not known.
    places: [Vec<f64>; 2],
}

impl Ends {
    /// Where it is at a time that comes after the second one, or is that, if it has come there `[s]`.
    fn note(&mut self, companion: &Companion, time: f64) {
        if companion.world().time() < time - slack(companion) {
            return *self = Ends::default();
        }
        if self.times[1] != time {
            self.times = [self.times[1], time];
            self.places.swap(0, 1);
        }
        companion.places(time, &mut self.places[1]);
    }

    /// Whether it is known where it was at both states of the world, or at the one that there is `[s]`.
    fn know(&self, [from, to]: [f64; 2]) -> bool {
        let knows = |end: usize, time: f64| self.times[end] == time && !self.places[end].is_empty();
        knows(1, to) && (from == to || knows(0, from))
    }

    /// Where it is between the two, 0 to 1 `[m]`.
    fn mix(&self, mix: f64, to: &mut Vec<f64>) {
        let [before, now] = self.places.each_ref().map(|places| Positions::F64(places));
        interpolate(before, now, mix, to);
    }
}

/// For how long companions have been late.
#[derive(Debug, Default)]
struct Late {
    /// Wall time of this look at them `[s]`.
    wall: f64,
    /// By how much they were behind when it began `[s]`; `None`: they were not late.
    behind: Option<f64>,
}

impl Late {
    /// They are `behind` by so much, if they are late, after another `wall` `[s]`. Returns whether they will not be there soon: nothing that
    /// comes nearer fast enough is hopeless, however long it takes.
    fn is_hopeless(&mut self, behind: Option<f64>, wall: f64) -> bool {
        let Some((now, before)) = behind.map(|now| (now, self.behind.unwrap_or(now))) else {
            *self = Late::default();
            return false;
        };
        (self.wall, self.behind) = (self.wall + wall, Some(before));
        if self.wall <= PATIENCE {
            return false;
        }
        let comes = before - now >= now * self.wall / SOON;
        *self = Late { wall: 0.0, behind: Some(now) };
        !comes
    }
}

/// What stays as near as this to where it was for so long rests `[m]`, `[s]`: as what sleeps does, which a reference never does.
const REST: (f64, f64) = (5e-5, 0.5);

/// How long something has been where it is.
#[derive(Debug, Default)]
struct Still {
    places: Vec<f64>,
    since: f64,
}

impl Still {
    /// Looks at its places `[m]` at a time `[s]`. Returns whether it rests.
    fn look(&mut self, places: &[f64], time: f64) -> bool {
        let is_same = self.places.len() == places.len() && time >= self.since;
        let stays =
            is_same && self.places.iter().zip(places).all(|(was, is)| was.is_nan() || (was - is).abs() <= REST.0);
        if !stays {
            places.clone_into(&mut self.places);
            self.since = time;
        }
        time - self.since >= REST.1
    }
}

/// What is asked to stand beside a world.
#[derive(Clone, Debug, PartialEq)]
pub enum Companions {
    /// These and no others.
    These(Vec<BesideKeys>),
    /// One more: a method that is as exact as the scene allows.
    Reference,
}

/// Substeps of a reference in one of the world, by order 8 and by what rules choose.
const FINER: [f64; 2] = [4.0, 8.0];

/// Methods that are more exact than that of a world, the most exact first: not every scene can be run by each.
pub(super) fn reference(history: &History) -> [BesideKeys; 2] {
    let substep = history.world().substep();
    let by = |solver: SolverName, finer: f64| {
        let method = MethodKeys {
            solver: Some(solver),
            substep: Some(substep / finer),
            precision: Some(PrecisionName::F64),
            budget: Some(BudgetKeys::None),
            sleep: Some(false),
            ..MethodKeys::default()
        };
        let title = Some(format!("reference: {}", method.words()));
        BesideKeys { title, method, ..BesideKeys::default() }
    };
    [by(SolverName::Rk8, FINER[0]), by(SolverName::Auto, FINER[1])]
}

#[cfg(test)]
mod tests {
    use super::Late;

    /// Whether those that are 20 s behind at first, and come nearer at such a rate `[1]`, are given up within so many seconds.
    fn is_given_up(rate: f64, seconds: u32) -> bool {
        let mut late = Late::default();
        (0..10 * seconds).any(|frame| late.is_hopeless(Some(20.0 - 0.1 * rate * f64::from(frame)), 0.1))
    }

    #[test]
    fn what_catches_up_is_not_too_slow_however_long_that_takes() {
        assert!(!is_given_up(1.0, 20), "20 s behind: it is there in 20 s");
        assert!(is_given_up(0.0, 4) && is_given_up(-0.5, 4), "it never is");
        assert!(is_given_up(0.1, 4), "in 200 s");
        assert!(!is_given_up(0.0, 2), "for so long nobody knows");
        let mut late = Late::default();
        (0..25).for_each(|_| _ = late.is_hopeless(Some(1.0), 0.1));
        assert!(!late.is_hopeless(None, 0.1) && !(0..25).any(|_| late.is_hopeless(Some(1.0), 0.1)), "there between");
    }
}
