//! Each play for a minute: its caption's numbers and its picture at its end, then what else is done in it. From quarter to quarter of a second
//! while something is done, then from second to second, it is under its laws, and what it comes to is what a formula says.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use image::RgbaImage;
use serde::Deserialize;
use serde_json::{Value, json};
use wobble::app::opening;
use wobble::history::{Entry, Log, Recording, Replay};
use wobble::render::{Camera, Capture, Look, View};
use wobble::scene::Scene;
use wobble::sim::Sample;

use super::laws::{Law, Past};
use super::{Axis, Play, What, Which, begins, misprints, plays};
use crate::common;

/// How long a play is played [s].
const MINUTE: f64 = 60.0;
/// Width and height of its picture [px].
const SIZE: [u32; 2] = [320, 180];

/// What a number comes to at some times, in closed form.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Formula {
    what: What,
    #[serde(default)]
    axis: Axis,
    points: Option<Vec<usize>>,
    range: Option<[usize; 2]>,
    /// Less what it was then `[s]`.
    since: Option<f64>,
    /// Over what it was then `[s]`.
    over: Option<f64>,
    /// When it is looked at `[s]`.
    at: Vec<f64>,
    /// What it is by the formula: one number for all times, or one each.
    expected: Vec<f64>,
    within: f64,
    /// The formula.
    by: String,
}

impl Formula {
    fn of(&self, state: &State) -> f64 {
        self.what.of((self.axis, Which(self.points.as_deref(), self.range)), &state.sample, state.torn)
    }

    fn times(&self) -> impl Iterator<Item = f64> + '_ {
        self.at.iter().chain(&self.since).chain(&self.over).copied()
    }

    /// By how much it is missed, where it is missed most, up to a time [s].
    fn missed(&self, states: &[State], until: f64) -> f64 {
        let at = |time: f64| self.of(State::at(states, time));
        let off = |(k, &time): (usize, &f64)| {
            let value = (at(time) - self.since.map_or(0.0, at)) / self.over.map_or(1.0, at);
            (value - self.expected[k.min(self.expected.len() - 1)]).abs()
        };
        self.at.iter().enumerate().filter(|(_, time)| **time <= until).map(off).fold(0.0, larger)
    }
}

/// The larger one, and what is no number before all others.
fn larger(most: f64, other: f64) -> f64 {
    if other <= most { most } else { other }
}

/// A state that numbers are taken of.
struct State {
    time: f64,
    sample: Sample,
    torn: u64,
}

impl State {
    fn at(states: &[State], time: f64) -> &State {
        states.iter().find(|state| state.time == time).unwrap()
    }
}

/// When it is done [s].
fn by(command: &Value) -> f64 {
    command["by"].as_f64().unwrap_or(begins(command))
}

/// What came of a play.
struct Outcome {
    /// What is wrong with it.
    wrong: Vec<String>,
    picture: Option<RgbaImage>,
}

impl Play {
    pub(super) fn until(&self) -> f64 {
        self.until.unwrap_or(MINUTE)
    }

    /// What is done up to its end.
    fn done(&self) -> impl Iterator<Item = &Value> {
        self.commands.iter().chain(&self.then).filter(|command| begins(command) <= self.until())
    }

    /// When nobody leads anything any more [s].
    fn hands_off(&self) -> f64 {
        self.done().map(by).fold(0.0, f64::max)
    }

    /// Whether something is done, led, held or pushed between two times [s].
    fn is_led(&self, from: f64, to: f64) -> bool {
        let (mut holds, mut pushes, mut keys) = (false, false, 0);
        for command in self.done().filter(|command| begins(command) <= to) {
            if by(command) >= from {
                return true;
            }
            match command["do"].as_str() {
                Some("grab") => holds = true,
                Some("release") => holds = false,
                Some("cursor") => pushes = !command["to"].is_null(),
                Some("key") => keys += if command["down"] == true { 1 } else { -1 },
                _ => {}
            }
        }
        holds || pushes || keys > 0
    }

    fn recording(&self) -> (Recording, Vec<Entry>) {
        let commands: Vec<&Value> = self.done().collect();
        let file = json!({"wobble_recording": 1, "scene": self.scene, "commands": commands, "end": self.until()});
        let log = Log::of_text(&file.to_string(), &self.scene).unwrap();
        let (mut head, commands) = (log.recording().unwrap(), log.commands().unwrap());
        head.scene.method.ledger = Some(self.laws.iter().any(|law| matches!(law, Law::Books { .. })));
        (head, commands)
    }

    /// When numbers are taken [s].
    fn asked(&self) -> Vec<f64> {
        let since = self.measures.iter().filter_map(|measure| measure.since);
        let asked = since.chain(self.formulas.iter().flat_map(Formula::times)).chain([self.end]);
        asked.filter(|time| *time <= self.until()).collect()
    }

    /// When it is looked at [s], ascending.
    fn times(&self) -> Vec<f64> {
        let quarters = (0..=(4.0 * self.hands_off()) as u32).map(|k| 0.25 * f64::from(k));
        let quarters = quarters.filter(|time| self.is_led(time - 0.25, time + 0.25));
        let seconds = (0..=self.until() as u32).map(f64::from);
        let mut times: Vec<f64> = quarters.chain(seconds).chain(self.asked()).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// Plays it; `draw` has what draws the plane and space.
    fn played(&self, draw: Option<&Mutex<[Capture; 2]>>) -> Outcome {
        let (head, commands) = self.recording();
        let mut run = Replay::new(&head, &self.scene).unwrap();
        let draw = draw.filter(|_| self.picture).map(|captures| (captures, self.camera(&run, &head)));
        let mut past = Past::of(run.world());
        let (asked, mut before) = (self.asked(), 0.0);
        let (mut most, mut states, mut picture) = (vec![(0.0, 0.0); self.laws.len()], Vec::new(), None);
        for time in self.times() {
            run.advance(&commands, time).unwrap_or_else(|error| panic!("{}: {error}", self.scene));
            let world = run.world();
            let sample = world.sample(time.max(world.time()));
            if self.is_led(before, time) {
                past.forget();
            } else {
                past.note(&sample);
            }
            before = time;
            for (law, most) in self.laws.iter().zip(&mut most) {
                let missed = law.missed(world, &sample, &past);
                if larger(most.0, missed).to_bits() != most.0.to_bits() {
                    *most = (missed, time);
                }
            }
            past.leave(&sample);
            if time == self.end {
                picture = draw.as_ref().map(|(captures, opened)| drawn(captures, &run, (*opened, &head.scene)));
            }
            if asked.contains(&time) {
                states.push(State { time, sample, torn: world.counters().bonds_torn });
            }
        }
        Outcome { wrong: self.faults(&most, &states), picture }
    }

    /// That of the scene as it opens, or of its picture's own.
    fn camera(&self, run: &Replay, head: &Recording) -> Camera {
        let (skins, mut scene) = (run.skins(), head.scene.clone());
        scene.view = self.view.clone().or(scene.view);
        opening::camera(&scene, &View { skins: &skins, ..View::of(run.world()) }, SIZE)
    }

    /// What of a caption, of laws and formulas was missed.
    fn faults(&self, laws: &[(f64, f64)], states: &[State]) -> Vec<String> {
        let value = |measure: &super::Measure| {
            let at = |time: f64| {
                let State { sample, torn, .. } = State::at(states, time);
                measure.of(sample, *torn)
            };
            at(self.end) - measure.since.map_or(0.0, at)
        };
        let values: Vec<f64> = self.measures.iter().map(value).collect();
        let mut wrong = misprints(self, &values);
        let mut hold = |what: String, missed: f64, within: f64| {
            let line = format!("{}: {what} is missed by {missed:.4e}", self.scene);
            eprintln!("{line}");
            if larger(within, missed).to_bits() != within.to_bits() {
                wrong.push(line);
            }
        };
        for (law, (missed, when)) in self.laws.iter().zip(laws) {
            hold(format!("{law:?}, at {when} s,"), *missed, law.within());
        }
        for formula in &self.formulas {
            hold(
                format!("{} = {:?}", formula.by, formula.expected),
                formula.missed(states, self.until()),
                formula.within,
            );
        }
        wrong
    }
}

/// A picture of a scene, whose camera went along with the points that it names.
fn drawn(captures: &Mutex<[Capture; 2]>, run: &Replay, (mut camera, scene): (Camera, &Scene)) -> RgbaImage {
    let followed = opening::followed(scene, &View::of(run.world()), SIZE);
    if followed.is_said() {
        let places = run.world().sample(run.world().time()).position;
        followed.lead(&mut camera, followed.points.iter().map(|point| places[*point as usize].into()));
    }
    let mut captures = captures.lock().unwrap();
    let capture = &mut captures[run.world().dimensions() - 2];
    capture.forget_world();
    let skins = run.skins();
    let view = View { skins: &skins, tints: run.tints(), ..View::of(run.world()) };
    capture.picture(&view, &camera, &Look::default()).unwrap()
}

/// What comes of plays, played side by side, and what is wrong with them.
fn wrong_with(plays: &[Play]) -> Vec<String> {
    let gpu = common::gpu();
    let captures =
        gpu.as_ref().map(|gpu| Mutex::new([2, 3].map(|space| Capture::on(gpu.clone(), SIZE, space).unwrap())));
    let (next, outcomes) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let workers = std::thread::available_parallelism().map_or(1, usize::from).min(4);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                while let Some(play) = plays.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let outcome = play.played(captures.as_ref());
                    outcomes.lock().unwrap().push((&play.scene, outcome));
                }
            });
        }
    });
    let mut wrong = Vec::new();
    for (scene, outcome) in outcomes.into_inner().unwrap() {
        if let (Some(gpu), Some(picture)) = (&gpu, outcome.picture) {
            common::golden::check(&format!("played/{scene}"), &picture, &gpu.info);
        }
        wrong.extend(outcome.wrong);
    }
    wrong.sort();
    wrong
}

/// With `--nocapture` it prints by how much each law and each formula is missed. `WOBBLE_SCENE=NAME` plays one scene.
#[test]
fn what_a_caption_tells_to_do_comes_out_as_it_says_and_goes_on_by_its_laws() {
    let plays: Vec<Play> = plays().into_iter().filter(|play| common::is_asked("WOBBLE_SCENE", &play.scene)).collect();
    let wrong = wrong_with(&plays);
    assert!(wrong.is_empty(), "{} are wrong:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
#[ignore = "takes three minutes of the processor: the test before plays the beginning"]
fn what_is_cut_short_goes_on_for_a_minute_by_its_laws() {
    let is_short = |play: &Play| play.until() < MINUTE && common::is_asked("WOBBLE_SCENE", &play.scene);
    let plays: Vec<Play> =
        plays().into_iter().filter(is_short).map(|play| Play { until: None, picture: false, ..play }).collect();
    let wrong = wrong_with(&plays);
    assert!(wrong.is_empty(), "{} are wrong:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn a_play_that_is_no_minute_says_why_and_each_is_held_to_something() {
    for play in plays() {
        assert_eq!(play.until() < MINUTE, play.why.is_some(), "{}", play.scene);
        // What goes to pieces as it is printed has no law.
        let is_held = !play.laws.is_empty() || !play.formulas.is_empty() || play.why.is_some();
        assert!(is_held, "{} is held to nothing", play.scene);
        assert!(play.until() >= play.end, "{}", play.scene);
    }
}
