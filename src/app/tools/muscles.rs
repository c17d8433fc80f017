//! The tool for muscles: bonds that a click or a stroke goes over follow a wave, a key, or both.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::DVec2;

use super::Deed;
use super::build::short;
use super::drives::beside;
use super::marks::{Mark, Role};
use super::pick::Scope;
use super::segments::{self, distance_to_segment};
use super::selecting::is_drag;
use crate::app::count::counted;
use crate::history::{Do, DriveOrNone, OneOrEach, SetKeys};
use crate::scene::{DriveKeys, KeyName};
use crate::sim::drive::RATE;
use crate::sim::{Bond, BondKind, Drive, Driving, NoDrive, PointId, RigidPieces};

/// Said where nothing is clicked, or crossed by a stroke, that could be a muscle.
const NO_BOND: &str = "no bond lies here that could be a muscle";
/// Said of a rigid bond whose ends others hold.
const HELD: &str =
    "other rigid bonds hold its ends, so it would move nothing: make the body soft first, as jelly or rubber";
/// The stroke goes on when the pointer is so far from its end `[logical px]`.
const STEP: f64 = 4.0;
/// A stroke lies along a bond no further from it than this `[logical px]`, and within an angle of this cosine.
const ALONG: f64 = 6.0;
const PARALLEL: f64 = 0.94;
/// Bonds that are drawn at most.
const MOST: usize = 4_000;

/// What a muscle is to follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct MuscleChoice {
    /// Share that its length changes by `[1]`.
    pub(in crate::app) amplitude: f64,
    /// It follows a wave of this period `[s]` and phase `[rad]`.
    pub(in crate::app) has_wave: bool,
    pub(in crate::app) period: f64,
    pub(in crate::app) phase: f64,
    /// The wave runs along a stroke that it is drawn by, of this length in lengths of the stroke; else all of them move as one.
    pub(in crate::app) runs: bool,
    pub(in crate::app) length: f64,
    pub(in crate::app) key: Option<KeyName>,
    pub(in crate::app) back: Option<KeyName>,
    /// How quickly it comes and goes with its key `[1/s]`.
    pub(in crate::app) rate: f64,
}

/// Said of bonds that are muscles as of those that are none: over a body that moves the pointer is now on one, now on the other. The colour of the
/// mark says which it is.
const CLICK: &str = "a click makes it a muscle, or none again; a drag makes more of them";

impl Default for MuscleChoice {
    fn default() -> Self {
        let (has_wave, runs) = (true, true);
        MuscleChoice {
            amplitude: 0.3,
            has_wave,
            period: 1.0,
            phase: 0.0,
            runs,
            length: 0.7,
            key: None,
            back: None,
            rate: RATE,
        }
    }
}

/// A stroke `[px]`, and the bonds that it went over as they were then.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Swipe {
    corners: Vec<DVec2>,
    /// How long it is `[px]`.
    long: f64,
    /// By their numbers, how far along the stroke each was met `[px]`.
    bonds: Met,
}

/// Bonds by their numbers, with how far along a stroke they were met `[px]`.
type Met = BTreeMap<u32, f64>;

impl Swipe {
    /// Begins on the bond that lies under a pixel.
    pub(super) fn begin(scope: Scope<'_>, at: DVec2) -> Self {
        let under = scope.bond(at).map(|(place, _)| scope.shown.scenery.bond_number(place));
        Swipe { corners: vec![at], long: 0.0, bonds: under.into_iter().map(|number| (number, 0.0)).collect() }
    }

    /// The pointer is at a pixel.
    pub(super) fn trace(&mut self, scope: Scope<'_>, at: DVec2) {
        if self.end().distance(at) >= STEP * scope.scale {
            self.bonds = self.until(scope, at);
            self.long += self.end().distance(at);
            self.corners.push(at);
        }
    }

    fn end(&self) -> DVec2 {
        self.corners.last().copied().unwrap_or_default()
    }

    /// Those that it went over until a pixel.
    fn until(&self, scope: Scope<'_>, at: DVec2) -> Met {
        let mut bonds = self.bonds.clone();
        if self.end() != at {
            for (number, along) in met(scope, [self.end(), at]) {
                bonds.entry(number).or_insert(self.long + along);
            }
        }
        bonds
    }

    /// How long it is if it ends at a pixel `[px]`.
    fn length(&self, at: DVec2) -> f64 {
        self.long + self.end().distance(at)
    }

    /// Whether the pointer never left where it was pressed.
    fn is_click(&self, scope: Scope<'_>, at: DVec2) -> bool {
        self.corners.len() == 1 && !is_drag(scope, [self.corners[0], at])
    }
}

/// The bonds that a piece of a stroke crosses or lies along, by their numbers, and where along it their middles are `[px]`.
fn met(scope: Scope<'_>, [from, to]: [DVec2; 2]) -> impl Iterator<Item = (u32, f64)> {
    let scenery = &scope.shown.scenery;
    let reach = ALONG * scope.scale;
    let [low, high] = [from.min(to) - reach, from.max(to) + reach];
    let way = (to - from).normalize_or_zero();
    let is_met = move |&(_, &[a, b]): &(usize, &[PointId; 2])| {
        let (Some(a), Some(b)) = (scope.pixel(a), scope.pixel(b)) else { return false };
        if a.max(b).cmplt(low).any() || a.min(b).cmpgt(high).any() {
            return false;
        }
        let lies = || [from, to].into_iter().all(|at| distance_to_segment(at, a, b) <= reach);
        segments::cross([from, to], [a, b]) || (way.dot((b - a).normalize_or_zero()).abs() >= PARALLEL && lies())
    };
    let bonds = scenery.bonds.ends().iter().enumerate();
    let along = move |[a, b]: [PointId; 2]| {
        let middle = scope.pixel(a).zip(scope.pixel(b)).map_or(from, |(a, b)| 0.5 * (a + b));
        (middle - from).dot(way).clamp(0.0, from.distance(to))
    };
    bonds.filter(is_met).map(move |(place, ends)| (scenery.bond_number(place), along(*ends)))
}

/// What becomes of bonds.
struct Plan {
    /// The places, numbers and phases `[rad]` of those that change.
    changes: Vec<(usize, u32, f64)>,
    takes_away: bool,
    /// How many cannot, and why the first of them cannot.
    left: usize,
    why: Option<String>,
}

impl MuscleChoice {
    /// Those of a muscle of it.
    pub(super) fn keys(&self) -> DriveKeys {
        // What follows nothing would be none.
        let has_wave = self.has_wave || self.key.is_none();
        DriveKeys {
            amplitude: Some(self.amplitude),
            period: has_wave.then_some(self.period),
            phase: has_wave.then_some(self.phase),
            key: self.key,
            back: self.key.and(self.back).filter(|back| Some(*back) != self.key),
            rate: self.key.map(|_| self.rate),
            ..DriveKeys::default()
        }
    }

    /// Whether a bond is just such a muscle, wherever its wave begins.
    fn takes_away(&self, bond: &Bond) -> bool {
        let is_same = |mut drive: Drive| {
            let Ok(mut own) = self.keys().told_bond() else { return false };
            for wave in [&mut drive, &mut own].into_iter().filter_map(|drive| drive.signal.wave.as_mut()) {
                wave.phase = if self.runs { 0.0 } else { wave.phase };
            }
            own == drive
        };
        bond.drive.is_some_and(is_same)
    }

    /// Where the wave begins so far along a stroke of this length `[px]`, from 0 to a whole turn `[rad]`.
    fn phase_at(&self, along: f64, length: f64) -> f64 {
        let turns = if self.runs && length > 0.0 { along / (self.length * length) } else { 0.0 };
        (self.phase - TAU * turns).rem_euclid(TAU)
    }

    /// Whether what a stroke makes follows a wave that runs along it.
    fn makes_a_wave(&self) -> bool {
        self.runs && (self.has_wave || self.key.is_none())
    }

    /// Bonds become muscles; where all of them are just such muscles, none any more.
    fn plan(&self, scope: Scope<'_>, met: &Met, length: f64) -> Plan {
        let scenery = &scope.shown.scenery;
        let all = scenery.bonds.iter().enumerate().map(|(place, bond)| (place, scenery.bond_number(place), bond));
        let mut plan = Plan { changes: Vec::new(), takes_away: true, left: 0, why: None };
        let (mut others, pieces) = (Vec::new(), OnceCell::new());
        for (place, number, bond) in all {
            let Some(&along) = met.get(&number) else { continue };
            let phase = self.phase_at(along, length);
            if let Some(why) = no_muscle(scope, &bond, &pieces) {
                plan.left += 1;
                plan.why.get_or_insert(why);
            } else if self.takes_away(&bond) {
                plan.changes.push((place, number, phase));
            } else {
                others.push((place, number, phase));
            }
        }
        if !others.is_empty() {
            (plan.changes, plan.takes_away) = (others, false);
        }
        plan
    }

    /// The stroke ends at a pixel.
    pub(super) fn release(&self, scope: Scope<'_>, swipe: Swipe, at: DVec2) -> Deed {
        let is_click = swipe.is_click(scope, at);
        let (met, length) = if is_click { (swipe.bonds, 0.0) } else { (swipe.until(scope, at), swipe.length(at)) };
        let Plan { changes, takes_away, left, why } = self.plan(scope, &met, length);
        if changes.is_empty() {
            return Deed::words(why.unwrap_or_else(|| NO_BOND.to_owned()));
        }
        let name = match (takes_away, changes.len()) {
            (true, 1) => "muscle away",
            (true, _) => "muscles away",
            (false, 1) => "muscle",
            (false, _) => "muscles",
        };
        let drive = Some(if takes_away { DriveOrNone::None(()) } else { DriveOrNone::This(self.keys()) });
        let runs = self.makes_a_wave() && !takes_away && changes.len() > 1;
        let phase = runs.then(|| OneOrEach::Each(changes.iter().map(|(_, _, phase)| *phase).collect()));
        let bonds = Some(changes.into_iter().map(|(_, number, _)| number).collect());
        let set = Do::Set(Box::new(SetKeys { bonds, drive, phase, ..SetKeys::default() }));
        let words = why.map(|why| format!("{} left out: {why}", counted(left, "bond")));
        Deed { words, ..Deed::edit(name, set) }
    }

    /// What a click would do.
    pub(super) fn would_be(&self, scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
        let Some((place, [a, b])) = scope.bond(at) else { return Vec::new() };
        let bond = scope.shown.scenery.bonds.get(place);
        let said = |words: String| Mark::Words(beside(scope, at), words);
        let (role, words) = match no_muscle(scope, &bond, &OnceCell::new()) {
            // Nothing would become of it: nothing is marked.
            Some(why) => return vec![said(why)],
            None if self.takes_away(&bond) => (Role::Away, CLICK),
            None if bond.drive.is_some() => (Role::Come, "another muscle: a click makes it as in the panel"),
            None => (Role::Come, CLICK),
        };
        let line = scope.pixel(a).zip(scope.pixel(b)).map(|(a, b)| Mark::Line(role, a, b, 4.0 * scope.scale));
        line.into_iter().chain([said(words.to_owned())]).collect()
    }

    /// What a stroke does that goes on to a pixel.
    pub(super) fn marks(&self, scope: Scope<'_>, swipe: &Swipe, at: DVec2) -> Vec<Mark> {
        if swipe.is_click(scope, at) {
            return self.would_be(scope, swipe.corners[0]);
        }
        let length = swipe.length(at);
        let Plan { changes, takes_away, why, .. } = self.plan(scope, &swipe.until(scope, at), length);
        let role = if takes_away { Role::Away } else { Role::Come };
        let ends = scope.shown.scenery.bonds.ends();
        let runs = self.makes_a_wave() && !takes_away && changes.len() > 1;
        // Where the wave is long as the stroke is drawn, lines are thick.
        let wide = |phase: f64| if runs { 4.0 + 2.5 * phase.sin() } else { 4.0 };
        let lines = changes.iter().take(MOST).filter_map(|&(place, _, phase)| {
            let [a, b] = ends[place];
            Some(Mark::Line(role, scope.pixel(a)?, scope.pixel(b)?, wide(phase) * scope.scale))
        });
        let corners: Vec<DVec2> = swipe.corners.iter().copied().chain([at]).collect();
        let way = corners.windows(2).map(|side| Mark::Line(Role::Hold, side[0], side[1], 1.5 * scope.scale));
        let words = match (changes.len(), takes_away) {
            (0, _) => why.unwrap_or_else(|| "drag over bonds".to_owned()),
            (1, true) => "let go: the muscle goes".to_owned(),
            (count, true) => format!("let go: {} go", counted(count, "muscle")),
            (count, false) if runs => {
                let metres = self.length * length / scope.camera.pixels_per_metre();
                format!("{}: a wave of {} m runs along them", counted(count, "muscle"), short(metres))
            }
            (count, false) => counted(count, "muscle"),
        };
        lines.chain(way).chain([Mark::Words(beside(scope, at), words)]).collect()
    }
}

/// Why a bond cannot be a muscle in what is shown.
fn no_muscle(scope: Scope<'_>, bond: &Bond, pieces: &OnceCell<RigidPieces>) -> Option<String> {
    let is_new = bond.kind == BondKind::Rigid && bond.drive.is_none();
    let is_held = || is_new && pieces.get_or_init(|| scope.rigid_pieces()).holds_without_bond([bond.a, bond.b]);
    scope.shown.driving.of_bond(bond).map(words).or_else(|| is_held().then(|| HELD.to_owned()))
}

/// Why nothing can be a muscle in what is shown, if nothing can.
pub(in crate::app) fn no_muscles(driving: Driving) -> Option<String> {
    driving.of_any().map(words)
}

/// The same in the words of who plays.
fn words(why: NoDrive) -> String {
    match why {
        NoDrive::Relaxed => "a relaxed bond is no muscle".to_owned(),
        NoDrive::OneSided => "a bond that acts on one side is no muscle".to_owned(),
        NoDrive::Weld => "a weld is no muscle".to_owned(),
        NoDrive::RigidInSpace => "in space a rigid bond is no muscle: springs alone are".to_owned(),
        NoDrive::MeetsInSpace => "in space nothing is a muscle where bodies, balls or boxes meet".to_owned(),
        NoDrive::RigidToTolerance => "a rigid bond is no muscle where a tolerance is kept".to_owned(),
        NoDrive::RigidBy(solver) => format!("a rigid bond is no muscle by solver {solver}: by \"automatic\" it is"),
        NoDrive::By(solver) | NoDrive::MotorBy(solver) => {
            format!("solver {solver} knows no muscles: \"automatic\" does")
        }
    }
}
