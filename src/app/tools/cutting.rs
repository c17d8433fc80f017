//! Cuts along a stroke, which follows the pointer.

use glam::DVec2;

use super::Deed;
use super::marks::{Mark, Role};
use super::pick::Scope;
use super::segments::{self, distance_to_segment};
use super::slit::Slit;
use crate::history::Do;
use crate::sim::PointId;

/// Said where a stroke cuts nothing.
const NO_CUT: &str = "the stroke crosses no bond";
/// What a stroke is called when it is undone.
const CUT: &str = "cut";
/// The stroke goes on when the pointer is so far from its end `[logical px]`.
const STEP: f64 = 3.0;
/// Corners that are so near to a straight line are left out `[logical px]`: each cut costs the same, however short it is.
const STRAIGHT: f64 = 1.5;
/// Bonds that are shown at most.
const MOST: usize = 2_000;

/// A stroke `[px]`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Slash(Vec<DVec2>);

impl Slash {
    pub(super) fn new(at: DVec2) -> Self {
        Slash(vec![at])
    }

    /// The pointer is at a pixel.
    pub(super) fn trace(&mut self, scope: Scope<'_>, at: DVec2) {
        if self.0.last().is_none_or(|last| last.distance(at) >= STEP * scope.scale) {
            self.0.push(at);
        }
    }

    /// Its corners, to a pixel.
    fn corners(&self, scope: Scope<'_>, at: DVec2) -> Vec<DVec2> {
        let all: Vec<DVec2> = self.0.iter().copied().chain([at]).collect();
        let mut kept = vec![all[0]];
        straightened(&all, STRAIGHT * scope.scale, &mut kept);
        kept
    }

    /// The bonds that it crosses.
    fn crossed<'a>(scope: Scope<'a>, corners: &'a [DVec2]) -> impl Iterator<Item = [DVec2; 2]> + 'a {
        let ends = scope.shown.scenery.bonds.ends().iter();
        let seen = ends.filter_map(move |&[a, b]: &[PointId; 2]| Some([scope.pixel(a)?, scope.pixel(b)?]));
        seen.filter(move |&bond| corners.windows(2).any(|side| segments::cross([side[0], side[1]], bond)))
    }

    /// The bonds that it crosses go: in space all that are seen under it, also behind each other, and cloths are slit.
    pub(super) fn release(&self, scope: Scope<'_>, at: DVec2) -> Deed {
        let corners = self.corners(scope, at);
        if corners.windows(2).all(|side| side[0].distance(side[1]) <= 1.0) {
            return Deed::default();
        }
        if let Some(slit) = Slit::along(scope, &corners) {
            return Deed { commands: slit.commands(), edit: Some(CUT), ..Deed::default() };
        }
        let cuts: Vec<Do> = corners
            .windows(2)
            .filter(|side| Slash::crossed(scope, side).next().is_some())
            .map(|side| {
                let [from, to] = [side[0], side[1]].map(|at| scope.camera.cursor(at.to_array()));
                Do::Cut { from, to }
            })
            .collect();
        match cuts.is_empty() {
            true => Deed::words(NO_CUT.to_owned()),
            false => Deed { commands: cuts, edit: Some(CUT), ..Deed::default() },
        }
    }

    /// The stroke, and what goes.
    pub(super) fn marks(&self, scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
        let corners = self.corners(scope, at);
        let line = |[from, to]: [DVec2; 2], width: f64| Mark::Line(Role::Away, from, to, width * scope.scale);
        let stroke: Vec<Mark> = corners.windows(2).map(|side| line([side[0], side[1]], 2.0)).collect();
        let bonds = || Slash::crossed(scope, &corners).take(MOST).map(|bond| line(bond, 3.0)).collect::<Vec<_>>();
        let goes = Slit::along(scope, &corners).map_or_else(bonds, |slit| slit.marks(scope));
        goes.into_iter().chain(stroke).collect()
    }
}

/// Adds the corners that matter between the first, which is there already, and the last (Douglas and Peucker).
fn straightened(all: &[DVec2], off: f64, kept: &mut Vec<DVec2>) {
    let [first, between @ .., last] = all else { return };
    let far = between.iter().map(|at| distance_to_segment(*at, *first, *last)).enumerate();
    match far.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((place, far)) if far > off => {
            straightened(&all[..place + 2], off, kept);
            straightened(&all[place + 1..], off, kept);
        }
        _ => kept.push(*last),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stroke_keeps_the_corners_that_it_goes_around() {
        let line = |from: [f64; 2], to: [f64; 2]| {
            (1..=20).map(move |k| DVec2::from(from).lerp(DVec2::from(to), f64::from(k) / 20.0))
        };
        let all: Vec<DVec2> = [DVec2::ZERO]
            .into_iter()
            .chain(line([0.0, 0.0], [100.0, 0.0]))
            .chain(line([100.0, 0.0], [100.0, 80.0]))
            .chain(line([100.0, 80.0], [0.0, 80.5]))
            .collect();
        let mut kept = vec![all[0]];
        straightened(&all, 1.5, &mut kept);
        assert_eq!(kept, [[0.0, 0.0], [100.0, 0.0], [100.0, 80.0], [0.0, 80.5]].map(DVec2::from));
    }
}
