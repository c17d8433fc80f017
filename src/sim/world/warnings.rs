//! What a world tells whoever made it or edited it: what of it cannot be as it was said. Numbers of points and bonds stand in brackets at
//! the end, for whoever writes scenes: a window leaves them out.

use std::collections::BTreeMap;
use std::ops::Range;

use super::World;
use crate::sim::bond::{Bond, BondKind, PointId};
use crate::sim::contact::surface::MOST_FRICTION;
use crate::sim::force::angle::Angle;
use crate::sim::force::area;
use crate::sim::force::mouse::Track;
use crate::sim::model::Model;
use crate::sim::plan::{Cleared, Fitted};
use crate::sim::plan_part::PlanPart;
use crate::sim::reach::{self, Reach};
use crate::sim::real::Real;
use crate::sim::solver::Solver;
use crate::sim::vector::{length, sub};

/// Ways that are shorter than this are not told of `[m]`.
const LEAST_TOLD: f64 = 5e-4;
/// Share of the shortest bond to which places may be rounded without a word `[1]`.
const ROUNDED: f64 = 1e-4;

impl<S: Real, const D: usize> World<S, D> {
    /// Tells of bonds, by their numbers, that were given other lengths.
    pub(crate) fn warn_of_lengths(&mut self, changed: &[usize]) {
        if !changed.is_empty() {
            self.warnings.push(format!(
                "rigid bonds contradict each other: they were given the lengths of the nearest shape: make them agree ({})",
                list(changed)
            ));
        }
    }

    /// Tells of bonds that were given the lengths of one shape, where they were off that by more than a body bears.
    pub(crate) fn warn_of_fit(&mut self, fitted: &Fitted) {
        if fitted.is_told() {
            self.warnings.push(format!(
                "rigid bonds contradict each other by up to {:.1e} of their length: they were given the lengths of the nearest shape: \
                 write them with more digits ({})",
                fitted.most,
                list(&fitted.bonds)
            ));
        }
    }

    /// Tells of rigid bonds, by their numbers, whose drives were left out.
    pub(crate) fn warn_of_idle_drives(&mut self, idle: &[usize]) {
        if !idle.is_empty() {
            let which = if idle.len() == 1 { "a muscle moves" } else { "muscles move" };
            self.warnings.push(format!(
                "{which} nothing, for other rigid bonds hold the ends: left out: make it a spring, or the body soft ({})",
                list(idle)
            ));
        }
    }

    /// What a body may lie inside of.
    fn solid(&self) -> &'static str {
        let has_obstacles = !self.model.polygons.is_empty() || !self.model.convex.is_empty();
        match (has_obstacles, self.model.bounds.is_some() || !self.model.planes.is_empty()) {
            (true, true) => "an obstacle or a wall",
            (true, false) => "an obstacle",
            (false, _) => "a wall",
        }
    }

    /// What was put out of obstacles and walls, of points that are counted from `first` on.
    pub(crate) fn warn_of_overlap(&mut self, cleared: &Cleared<D>, first: u32) {
        let what = self.solid();
        let far = cleared.furthest();
        if let Some((points, _)) = cleared.moves.first().filter(|_| far >= LEAST_TOLD) {
            let point = first + points.first().copied().unwrap_or_default();
            let which = match cleared.moves.len() {
                1 if points.len() == 1 => "a point".to_owned(),
                count => bodies(count),
            };
            self.warnings
                .push(format!("{which} lay inside {what}: moved out as a whole, by up to {far:.3} m (point {point})"));
        }
        if let Some(caught) = cleared.caught.first() {
            let point = first + caught;
            self.warnings.push(format!(
                "{} lay inside {what} without a way out, or pinned: only points are put out, one by one, as far as \
                 bonds let them (point {point})",
                bodies(cleared.caught.len())
            ));
        }
    }

    pub(super) fn warn_of_pins(&mut self, position: &[[f64; D]]) {
        let w = &self.inverse_mass;
        let tracks: BTreeMap<PointId, &Track<D>> =
            self.model.pin_motion.iter().map(|(led, track)| (*led, track)).collect();
        let place = |point: PointId, t: f64| {
            tracks.get(&point).and_then(|track| track.at(t)).unwrap_or(position[point.index()])
        };
        // Between knots both go straight on: where the distance is right at three times, it always is.
        let times = |ends: [PointId; 2]| {
            let knots = ends.iter().filter_map(|end| tracks.get(end)).flat_map(|track| &track.knots);
            let mut times: Vec<f64> = knots.map(|knot| knot.0).collect();
            times.sort_by(f64::total_cmp);
            let between: Vec<f64> = times.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
            times.into_iter().chain(between).chain([0.0])
        };
        let apart = |ends: [PointId; 2], t: f64| {
            let [a, b] = ends.map(|end| place(end, t));
            length(sub(a, b))
        };
        let stands = |bond: &(usize, Bond)| {
            let ends = [bond.1.a, bond.1.b];
            if bond.1.kind != BondKind::Rigid || ends.iter().any(|end| w[end.index()] != 0.0) {
                return false;
            }
            let is_off = |t: f64| (apart(ends, t) - bond.1.rest_length).abs() > 1e-8 * bond.1.rest_length.max(1.0);
            times(ends).any(is_off)
        };
        let between: Vec<usize> = self.bonds.iter().enumerate().filter(stands).map(|(k, _)| k).collect();
        if !between.is_empty() {
            let which = if between.len() == 1 { "a rigid bond" } else { "rigid bonds" };
            self.warnings.push(format!(
                "{which} cannot hold: both ends are pinned, and not at that length ({})",
                list(&between)
            ));
        }
        let led: Vec<PointId> = tracks.keys().copied().collect();
        let held: Vec<PointId> = (0..w.len()).filter(|&i| w[i] == 0.0).map(|i| PointId(i as u32)).collect();
        let beyond = |reach: &Reach| {
            let apart = times(reach.pins).map(|t| apart(reach.pins, t)).fold(0.0, f64::max);
            (apart > reach.most * (1.0 + 1e-8)).then_some((apart - reach.most, reach.pins))
        };
        let reaches = reach::reaches(self.bonds.iter(), &led, &held);
        if let Some((way, [a, b])) = reaches.iter().filter_map(beyond).max_by(|a, b| a.0.total_cmp(&b.0)) {
            self.warnings.push(format!(
                "pins are led up to {way:.3} m further apart than the bonds between them reach: these are strained (points {} and {})",
                a.0, b.0
            ));
        }
    }

    /// Tells of pinned points that are given a velocity at the start `[m/s]`, which they cannot have.
    pub(super) fn warn_of_held(&mut self, velocity: &[[f64; D]]) {
        let is_dropped = |point: &usize| self.inverse_mass[*point] == 0.0 && velocity[*point] != [0.0; D];
        let dropped: Vec<usize> = (0..velocity.len()).filter(is_dropped).collect();
        if !dropped.is_empty() {
            let who = if dropped.len() == 1 { "a point is" } else { "points are" };
            self.warnings.push(format!(
                "{who} pinned: the velocity at the start is left out: unpin, or lead by `pin_motion` ({})",
                named("point", &dropped)
            ));
        }
    }

    /// Tells of torques on points that lie in one place at the start, or of which all but one are pinned: they turn nothing there.
    pub(super) fn warn_of_torques(&mut self, position: &[[f64; D]]) {
        let is_idle = |points: Vec<PointId>| {
            let mut free = points.iter().map(|point| point.index()).filter(|&point| self.inverse_mass[point] != 0.0);
            let Some(first) = free.next() else { return true };
            free.all(|point| position[point] == position[first])
        };
        let turning = self.model.forces.iter().enumerate().filter(|(_, force)| force.torque != 0.0);
        let idle: Vec<usize> = turning.filter(|(_, force)| is_idle(force.members())).map(|(k, _)| k).collect();
        if !idle.is_empty() {
            let which = if idle.len() == 1 { "a torque turns" } else { "torques turn" };
            self.warnings.push(format!(
                "{which} nothing: of its points those that are free lie in one place: give two that are apart ({})",
                named("force", &idle)
            ));
        }
    }

    /// Tells of places so far from the origin `[m]` that the scalar of the world rounds them by more than bonds bear.
    pub(super) fn warn_of_rounding(&mut self, position: &[[f64; D]]) {
        let far = position.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        let lengths = self.bonds.iter().map(|bond| bond.rest_length).filter(|rest| *rest > 0.0);
        let (shortest, rounded) = (lengths.fold(f64::INFINITY, f64::min), far * S::EPSILON.to_f64());
        if rounded > ROUNDED * shortest {
            let share = 100.0 * rounded / shortest;
            self.warnings.push(format!(
                "so far from the origin places are rounded to {rounded:.1e} m, {share:.2} % of the shortest bond: move the scene nearer"
            ));
        }
    }

    /// Tells of a wind that pushes nothing.
    pub(crate) fn warn_of_wind(&mut self) {
        if self.model.has_idle_wind() {
            self.warnings
                .push("the wind pushes nothing, for the air has no drag: give it some (`drag_rate`)".to_owned());
        }
    }

    /// Tells of triangles from the `first` on that resist no change of their area, as they have none.
    pub(crate) fn warn_of_areas(&mut self, first: usize) {
        let resist = self.model.areas.is_some_and(|areas| areas.stiffness > 0.0);
        let flat: Vec<usize> =
            (first..self.model.rest_areas.len()).filter(|&k| self.model.rest_areas[k] == 0.0).collect();
        if resist && !flat.is_empty() {
            let numbers = named("triangle", &flat);
            self.warnings.push(format!("{} of area 0 at the start: left out of `areas` ({numbers})", triangles(&flat)));
        }
    }

    /// Tells of triangles in scenes with contact that have no inside at these places `[m]`, which nothing can keep open.
    pub(super) fn warn_of_flat(&mut self, position: &[[f64; D]]) {
        let told = self.model.areas.is_some_and(|areas| areas.stiffness > 0.0);
        if D != 2 || told || self.model.contact.is_none() {
            return;
        }
        let is_flat = |corners: &[PointId; 3]| area::size(corners.map(|corner| position[corner.index()])) == 0.0;
        let corners = self.model.triangles.iter().enumerate();
        let flat: Vec<usize> = corners.filter(|(_, corners)| is_flat(corners)).map(|(k, _)| k).collect();
        if !flat.is_empty() {
            let numbers = named("triangle", &flat);
            self.warnings.push(format!("{} of area 0 at the start: not kept open ({numbers})", triangles(&flat)));
        }
    }

    /// Tells of triangles that were left out, as others have their corners.
    pub(crate) fn warn_of_repeats(&mut self, repeated: &[usize]) {
        if !repeated.is_empty() {
            let numbers = named("triangle", repeated);
            let text = format!("{} repeated: left out, as others have these corners ({numbers})", triangles(repeated));
            self.warnings.push(text);
        }
    }

    /// Tells of joints of these numbers that are outside their stops where their points are at the start `[m]`: the stops push them in as
    /// stiff springs do.
    pub(super) fn warn_of_stops(&mut self, numbers: Range<u32>, place: impl Fn(PointId) -> [f64; D]) {
        let words = self.outside_stops(numbers, place);
        self.warnings.extend(words);
    }

    /// The same, where the points are now.
    pub(crate) fn warn_of_stops_now(&mut self, numbers: Range<u32>) {
        let words = self.outside_stops(numbers, |point| self.place(point.index()));
        self.warnings.extend(words);
    }

    fn outside_stops(&self, numbers: Range<u32>, place: impl Fn(PointId) -> [f64; D]) -> Option<String> {
        let outside = |angle: &Angle| {
            let energy = angle.pushed_in(angle.points.map(&place));
            (energy > 0.0).then_some((angle.number as usize, energy))
        };
        let asked = self.model.angles.list.iter().filter(|angle| numbers.contains(&angle.number));
        let (found, energies): (Vec<usize>, Vec<f64>) = asked.filter_map(outside).unzip();
        (!found.is_empty()).then(|| {
            let (which, them) = match found.len() {
                1 => ("a joint is outside its stops".to_owned(), "it"),
                many => (format!("{many} joints are outside their stops"), "them"),
            };
            format!(
                "{which}, which push {them} back in with an energy of {}: let {them} start between `min` and `max` ({})",
                in_words(energies.iter().sum()),
                named("angle", &found)
            )
        })
    }

    /// Tells of friction that is more than surfaces and skins can have.
    pub(super) fn warn_of_friction(&mut self) {
        let Model { bounds, planes, polygons, contact, skins, .. } = &*self.model;
        let of_walls = bounds.iter().map(|bounds| bounds.friction);
        let of_skins = skins.lists().into_iter().filter_map(|(material, _)| material.friction);
        let all = of_walls
            .chain(planes.iter().map(|plane| plane.friction))
            .chain(polygons.iter().map(|polygon| polygon.friction))
            .chain(contact.iter().map(|contact| contact.friction))
            .chain(of_skins.filter(|_| contact.is_some()));
        let most = all.fold(0.0, f64::max);
        if most > MOST_FRICTION {
            self.warnings
                .push(format!("friction {most} is taken as {MOST_FRICTION}: it holds on a slope of 88 degrees"));
        }
    }

    /// Tells of rigid bodies among obstacles in a world of 32 bits, which is so only where that is asked for.
    pub(super) fn warn_of_single(&mut self) {
        let is_single = size_of::<S>() < size_of::<f64>();
        let is_rigid = |part: &PlanPart| part.solver == Solver::Rigid;
        if is_single && !self.model.polygons.is_empty() && self.plan.parts.iter().any(is_rigid) {
            let text = "32 bits do not tell on which side of an obstacle rigid bodies are: they may stick and gain energy: leave out `precision`";
            self.warnings.push(text.to_owned());
        }
    }

    pub(super) fn warn_of_limits(&mut self) {
        let is_swept = |part: &&PlanPart| part.solver == Solver::Path && part.kernel.is_empty() && part.bonds > 0;
        let swept: usize = self.plan.parts.iter().filter(is_swept).map(|part| part.bonds).sum();
        if swept > 0 {
            let text = format!("bonds with a limit make no paths: {swept} bonds beside them are swept as xpbd does");
            self.warnings.push(text);
        }
    }
}

/// Bodies by their count.
fn bodies(count: usize) -> String {
    if count == 1 { "a body".to_owned() } else { format!("{count} bodies") }
}

/// Triangles by theirs.
fn triangles(numbers: &[usize]) -> String {
    if numbers.len() == 1 { "a triangle".to_owned() } else { format!("{} triangles", numbers.len()) }
}

/// "bond 3", "bonds 1, 2 and 4", the first few of many.
fn list(bonds: &[usize]) -> String {
    named("bond", bonds)
}

fn named(what: &str, numbers: &[usize]) -> String {
    const MOST: usize = 8;
    let shown: Vec<String> = numbers.iter().take(MOST).map(usize::to_string).collect();
    match (&shown[..], numbers.len()) {
        ([one], _) => format!("{what} {one}"),
        (some, count) if count > MOST => format!("{what}s {} and {} more", some.join(", "), count - MOST),
        (some, _) => format!("{what}s {} and {}", some[..some.len() - 1].join(", "), some[some.len() - 1]),
    }
}

/// An energy `[J]` in few digits.
fn in_words(energy: f64) -> String {
    match energy {
        little if little < 1.0 => "less than 1 J".to_owned(),
        joules if joules < 1e3 => format!("{joules:.0} J"),
        joules if joules < 1e6 => format!("{:.1} kJ", 1e-3 * joules),
        joules if joules < 1e9 => format!("{:.1} MJ", 1e-6 * joules),
        joules => format!("{joules:.1e} J"),
    }
}
