//! Frames of 1/60 s of the scene: what the steps that end in each cost, by a clock and by counting.

use std::time::Instant;

use crate::sim::{Dynamics, frame_of};

/// Frames a second of the scene `[1/s]`.
const RATE: f64 = 60.0;
/// Time and counted work of the frames of a run: frame k is of the steps that end in (k/60, (k+1)/60] s.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    /// The frames in which steps ended, ascending.
    spent: Vec<Spent>,
    count: u64,
}

/// One frame, counted from 1.
#[derive(Clone, Copy, Debug)]
struct Spent {
    frame: u64,
    /// Wall time `[s]`.
    seconds: f64,
    /// Counted work `[ms]`.
    work: f64,
}

/// When the frame ends that `time` `[s]` lies in.
fn close_of(time: f64) -> f64 {
    frame_of(time) as f64 / RATE
}

/// The first end of a frame after `time` `[s]`.
pub fn next_close(time: f64) -> f64 {
    let close = close_of(time);
    if close > time { close } else { (frame_of(time) + 1) as f64 / RATE }
}

/// Whether the next step ends at `time` `[s]` or before, but for rounding.
fn ends_by(world: &dyn Dynamics, time: f64) -> bool {
    world.time() + world.substep() * (1.0 - 1e-9) <= time
}

impl Frames {
    /// Steps `world` on as long as steps end at or before `end` `[s]`, and reads the clock once a frame.
    pub fn of(world: &mut dyn Dynamics, end: f64) -> Self {
        let mut frames = Frames::between(world.time(), end);
        let mut clock = Instant::now();
        while ends_by(world, end) {
            let work = world.counters().work_ms();
            let close = close_of(world.time() + world.substep());
            // A step may be too short to be seen in the time.
            world.step();
            while ends_by(world, close.min(end)) {
                world.step();
            }
            let now = Instant::now();
            frames.add(close, (now - clock).as_secs_f64(), world.counters().work_ms() - work);
            clock = now;
        }
        frames
    }

    /// No step is known yet of a run from `start` to `end` `[s]`.
    pub fn between(start: f64, end: f64) -> Self {
        Frames { spent: Vec::new(), count: frame_of(end).saturating_sub(frame_of(start)) }
    }

    /// Steps that ended in the frame of `time` `[s]` took wall `seconds`, and `work` by counting `[ms]`.
    pub fn add(&mut self, time: f64, seconds: f64, work: f64) {
        let frame = frame_of(time);
        match self.spent.last_mut().filter(|last| last.frame == frame) {
            Some(last) => (last.seconds, last.work) = (last.seconds + seconds, last.work + work),
            None => self.spent.push(Spent { frame, seconds, work }),
        }
    }

    /// How many frames there are, those in which no step ended too.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Wall time of all `[s]`.
    pub fn seconds(&self) -> f64 {
        self.spent.iter().map(|spent| spent.seconds).sum()
    }

    /// Wall time that this share of the frames does not exceed `[ms]`: 1 is the slowest. 0 where there are none.
    pub fn quantile_ms(&self, share: f64) -> f64 {
        let mut times: Vec<f64> = self.spent.iter().map(|spent| 1e3 * spent.seconds).collect();
        times.sort_by(f64::total_cmp);
        // Frames without a step take no time, and come first.
        let empty = self.count.saturating_sub(times.len() as u64);
        let place = (share * self.count as f64).ceil().max(1.0) as u64;
        (place > empty).then(|| times.get((place - empty - 1) as usize)).flatten().copied().unwrap_or(0.0)
    }

    /// Counted work of the dearest frame `[ms]`.
    pub fn worst_work_ms(&self) -> f64 {
        self.spent.iter().map(|spent| spent.work).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{Method, Model, MouseForce, Profile, Region, Track, World};

    fn falling(substep: f64) -> World<f64, 2> {
        let model = Model::<2> {
            position: vec![[0.0, 0.0]],
            velocity: vec![[0.0, 0.0]],
            mass: vec![1.0],
            method: Method { substep: Some(substep), ..Method::default() },
            ..Model::default()
        };
        World::new(&model).unwrap()
    }

    #[test]
    fn steps_belong_to_the_frame_that_they_end_in() {
        let frames = Frames::of(&mut falling(1.0 / 240.0), 0.5);
        assert_eq!((frames.count(), frames.spent.len()), (30, 30));
        let work: Vec<u64> = frames.spent.iter().map(|spent| spent.work.to_bits()).collect();
        let mut world = falling(1.0 / 240.0);
        let own: Vec<f64> = (0..30)
            .map(|_| {
                let before = world.counters().work_ms();
                (0..4).for_each(|_| world.step());
                world.counters().work_ms() - before
            })
            .collect();
        assert!(own[0] > 0.0);
        assert_eq!(work, own.iter().map(|work| work.to_bits()).collect::<Vec<_>>(), "four steps each");
    }

    #[test]
    fn a_step_too_short_to_be_seen_in_the_time_ends_too() {
        let track = Track { knots: vec![(0.0, [-4.0, 0.5]), (2e-312, [-1.0, 0.5])] };
        let mouse = MouseForce { strength: 10.0, radius: 1.0, region: Region::Round, profile: Profile::Smooth, track };
        let mut world = World::<f64, 2>::new(&Model {
            position: vec![[0.0, 0.0]],
            velocity: vec![[0.0, 0.0]],
            mass: vec![1.0],
            mouse: Some(mouse),
            ..Model::default()
        })
        .unwrap();
        let frames = Frames::of(&mut world, 0.05);
        assert!(frames.count() == 3 && world.time() > 0.04, "{}", world.time());
    }

    #[test]
    fn frames_end_one_after_another() {
        let mut ends = vec![next_close(0.0)];
        (1..6000).for_each(|k| ends.push(next_close(ends[k - 1])));
        assert!(ends.iter().enumerate().all(|(k, end)| *end == (k + 1) as f64 / 60.0));
        assert_eq!(next_close(0.02), 2.0 / 60.0);
    }

    #[test]
    fn a_frame_in_which_no_step_ends_takes_no_time() {
        let mut frames = Frames::between(0.0, 4.0 / 60.0);
        for (t, time, work) in [(0.02, 0.001, 4.0), (0.03, 0.001, 3.0), (0.05, 0.004, 3.0)] {
            frames.add(t, time, work);
        }
        assert_eq!([0.25, 0.5, 0.75, 1.0].map(|share| frames.quantile_ms(share)), [0.0, 0.0, 2.0, 4.0]);
        assert_eq!(frames.worst_work_ms(), 7.0);
        assert_eq!(Frames::default().quantile_ms(0.5), 0.0);
        let frames = Frames::of(&mut falling(0.05), 0.1);
        assert_eq!((frames.count(), frames.spent.len()), (6, 2), "steps of three frames");
        let frames = Frames::of(&mut falling(0.05), 0.04);
        assert_eq!((frames.count(), frames.spent.len()), (3, 0));
    }
}
