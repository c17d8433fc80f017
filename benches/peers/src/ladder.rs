//! Climbs the settings of an engine, from cheap to dear, until a scene meets its bounds.

use std::marker::PhantomData;

use crate::peer::{Peer, Setting};
use crate::report::Record;
use crate::run::{FRAMES, Limits, Outcome, run};
use crate::scenes::{Measure, Scene};

/// Substeps a frame, each rung 1.3 to 2 times as dear as the last.
const RUNGS: [usize; 21] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024, 1536];
/// A way that has brought nothing better for so many rungs is left.
const PATIENCE: usize = 4;
/// Points beyond which only the first way of an engine is climbed, and only from [`LARGE_START`] on.
const LARGE: usize = 50_000;
/// Substeps of the first rung of a large scene.
const LARGE_START: usize = 4;
/// A run shorter than this is repeated, and the quickest counts [s].
const SHORT: f64 = 1.0;

/// How long a climb may take.
#[derive(Clone, Copy)]
pub(crate) struct Budget {
    /// One run [s].
    pub(crate) run: f64,
    /// All ways of one engine on one scene [s]; the run that passes it is the last.
    pub(crate) climb: f64,
}

/// Runs the default setting, then every way rung by rung; the records are in the order of the runs.
pub(crate) fn climb<P: Peer>(scene: &Scene, budget: Budget) -> Vec<Record> {
    let mut climb = Climb::<P> { scene, budget, spent: 0.0, records: Vec::new(), peer: PhantomData };
    climb.try_setting(P::DEFAULT, f64::INFINITY, true);
    let is_large = scene.positions.len() > LARGE;
    let (ways, start) = if is_large { (&P::WAYS[..1], LARGE_START) } else { (P::WAYS, 1) };
    for &way in ways {
        climb.climb_way(way, start);
    }
    climb.mark_cheapest();
    climb.records
}

struct Climb<'a, P> {
    scene: &'a Scene,
    budget: Budget,
    /// Time of all runs so far, without repetitions [s].
    spent: f64,
    records: Vec<Record>,
    peer: PhantomData<P>,
}

impl<P: Peer> Climb<'_, P> {
    /// Climbs one way while a dearer setting can still be the cheapest that meets some bound.
    fn climb_way(&mut self, way: P::Way, start: usize) {
        let mut best = f64::INFINITY;
        let mut rungs_since_best = 0;
        let mut ms_a_substep = 0.0;
        for substeps in RUNGS.into_iter().filter(|&substeps| substeps >= start) {
            let expected_ms = ms_a_substep * substeps as f64;
            let is_too_long = 1e-3 * expected_ms * FRAMES as f64 > self.budget.run;
            let Some(bound) = self.loosest_open(expected_ms) else { return };
            if is_too_long || rungs_since_best >= PATIENCE || self.spent > self.budget.climb {
                return;
            }
            let outcome = self.try_setting(Setting { substeps, way }, bound, false);
            ms_a_substep = outcome.median_ms / substeps as f64;
            let value = self.judged(&outcome);
            rungs_since_best += 1;
            if value < best {
                (best, rungs_since_best) = (value, 0);
            }
        }
    }

    /// The loosest bound that no setting as cheap as `ms` a frame has met.
    fn loosest_open(&self, ms: f64) -> Option<f64> {
        let is_open = |bound: f64| !self.records.iter().any(|record| record.meets(bound) && record.ms_per_frame <= ms);
        self.scene.measure().bounds().iter().copied().find(|&bound| is_open(bound))
    }

    /// Runs one setting, again if it is short, and keeps the quickest run; gives it up past a strain of `bound`.
    fn try_setting(&mut self, setting: Setting<P::Way>, bound: f64, is_default: bool) -> Outcome {
        let strain = if self.scene.measure() == Measure::Strain { bound } else { f64::INFINITY };
        let limits = Limits { strain, seconds: self.budget.run };
        let once = || run(self.scene, P::world(self.scene, setting), limits);
        let mut outcome = once();
        self.spent += outcome.seconds;
        if outcome.is_finished && outcome.seconds < SHORT {
            for again in [once(), once()] {
                if again.median_ms < outcome.median_ms {
                    outcome = again;
                }
            }
        }
        let record = Record::new::<P>(self.scene, setting, &outcome, is_default);
        eprintln!("{}", record.progress());
        self.records.push(record);
        outcome
    }

    /// Notes at each bound's cheapest setting that it is.
    fn mark_cheapest(&mut self) {
        for &bound in self.scene.measure().bounds() {
            let meeting = self.records.iter_mut().filter(|record| record.meets(bound));
            if let Some(cheapest) = meeting.min_by(|a, b| a.ms_per_frame.total_cmp(&b.ms_per_frame)) {
                cheapest.targets.push(bound);
            }
        }
    }

    /// What the scene is judged by.
    fn judged(&self, outcome: &Outcome) -> f64 {
        match self.scene.measure() {
            Measure::Strain => outcome.strain.max,
            Measure::Error => outcome.error.map_or(f64::INFINITY, |error| error.max),
        }
    }
}
