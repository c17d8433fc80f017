//! The outline of what a drag would make, and its size beside the cursor.

use glam::DVec2;

use super::fibre::BuiltOf;
use super::form::{End, Form, Hold, Round, chain};
use super::hatched;
use super::matter::INNER;
use crate::app::tools::knot;
use crate::app::tools::marks::{Mark, Role};
use crate::app::tools::pick::Scope;
use crate::app::tools::room::coming;
use crate::app::tools::segments;
use crate::sim::PointId;

/// Width of outlines `[logical px]`.
const WIDTH: f64 = 1.5;
/// The size stands so far from the cursor `[logical px]`.
const BESIDE: DVec2 = DVec2::new(16.0, -14.0);
/// So far from the outline where it has no place there; and a letter of it with what lies about it, about `[logical px]`.
const APART: f64 = 10.0;
const LETTER: DVec2 = DVec2::new(7.5, 22.0);

/// The outline where it will be, what it puts beside itself, the ropes and the points that it is tied to, those that it is drawn from and to being
/// `held`, and its size; `None`: it is tied to nothing.
pub(super) fn of(
    (form, built_of): (&Form, BuiltOf),
    scope: Scope<'_>,
    at: DVec2,
    held: Option<Vec<PointId>>,
) -> Vec<Mark> {
    let keys = form.keys(scope.shown.point_count() as u32, built_of);
    let outcome = coming(scope, &keys);
    let held = held.filter(|_| outcome.refused.is_none());
    let knots = held.map_or_else(Vec::new, |held| knot::knots(scope, &keys, (outcome.way, Some(&held[..]))));
    let mut marks: Vec<Mark> = lines(form, scope).into_iter().map(|mark| outcome.lines(scope, mark)).collect();
    marks.extend(outcome.others(scope));
    marks.extend(knot::marks(scope, &knots));
    let tied = knot::words(scope, &knots).map(|words| format!("{words} (not with Shift)"));
    let words: Vec<String> = outcome.words().into_iter().chain(tied).collect();
    let more = if words.is_empty() { String::new() } else { format!("; {}", words.join("; ")) };
    let words = off(&marks, scope, at, format!("{}{more}", form.said(&keys)));
    marks.push(words);
    marks
}

/// Words about an outline, in what of the view is free: on a side of the cursor where they do not lie across it; else over it, under it or at a
/// side of it, as near to the cursor as may be; where it is all over the view, beside the cursor.
pub(super) fn off(outline: &[Mark], scope: Scope<'_>, at: DVec2, words: String) -> Mark {
    let size = LETTER * DVec2::new(words.chars().count() as f64, 1.0) * scope.scale;
    let ends = outline.iter().flat_map(|mark| match mark {
        Mark::Line(_, from, to, _) => [*from, *to],
        Mark::Ring(_, middle, radius) => [*middle - *radius, *middle + *radius],
        _ => [at; 2],
    });
    let [low, high] = ends.fold([at; 2], |[low, high], end| [low.min(end), high.max(end)]);
    let (beside, apart) = (at + scope.scale * BESIDE, APART * scope.scale);
    let [left, below] = [2.0 * at.x - beside.x - size.x, 2.0 * at.y - beside.y + size.y];
    let about = [beside, DVec2::new(beside.x, below), DVec2::new(left, beside.y), DVec2::new(left, below)];
    let [least, most] = scope.seen();
    // Along the outline they may go as far as keeps them in view.
    let x = beside.x.min(most.x - size.x).max(least.x);
    let y = beside.y.clamp(least.y + size.y, most.y.max(least.y + size.y));
    let mut sides = [
        DVec2::new(x, low.y - apart),
        DVec2::new(x, high.y + apart + size.y),
        DVec2::new(high.x + apart, y),
        DVec2::new(low.x - apart - size.x, y),
    ];
    let far =
        |corner: &DVec2| at.distance(at.clamp(*corner - DVec2::new(0.0, size.y), *corner + DVec2::new(size.x, 0.0)));
    sides.sort_by(|a, b| far(a).total_cmp(&far(b)));
    let ground = |corner: &DVec2| [*corner - DVec2::new(0.0, size.y), *corner + DVec2::new(size.x, 0.0)];
    let is_seen = |corner: &&DVec2| ground(corner)[0].cmpge(least).all() && ground(corner)[1].cmple(most).all();
    let is_free = |corner: &&DVec2| is_seen(corner) && !outline.iter().any(|mark| lies_across(mark, ground(corner)));
    let free = about.iter().chain(&sides).find(is_free);
    // Long words go along the cursor as far as keeps them in view.
    let along = [beside.y, below].map(|y| DVec2::new(x, y));
    let seen = || about.iter().chain(&along).find(is_seen);
    Mark::Words(free.or_else(seen).copied().unwrap_or(DVec2::new(x, y)), words)
}

/// Whether a line or a ring goes through a box, given by its left upper and its right lower corner `[px]`.
fn lies_across(mark: &Mark, [low, high]: [DVec2; 2]) -> bool {
    let is_in = |at: DVec2| at.cmpge(low).all() && at.cmple(high).all();
    match *mark {
        Mark::Line(_, from, to, _) => {
            let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
            let crosses = |k: usize| segments::cross([from, to], [corners[k], corners[(k + 1) % 4]]);
            is_in(from) || is_in(to) || (0..4).any(crosses)
        }
        Mark::Ring(_, middle, radius) => {
            let nearest = middle.clamp(low, high).distance(middle);
            let farthest = (middle - low).abs().max((high - middle).abs()).length();
            (nearest..=farthest).contains(&radius)
        }
        _ => false,
    }
}

/// What is drawn of it.
fn lines(form: &Form, scope: Scope<'_>) -> Vec<Mark> {
    let round = |&Round { center, radius }: &Round| ring(scope, center, radius);
    match form {
        Form::Box(grid) => rectangle(scope, [grid.low, grid.low + grid.size()]),
        Form::Disc(disc) => round(disc),
        Form::Rim(rim) => {
            [rim.radius, INNER * rim.radius].into_iter().flat_map(|radius| ring(scope, rim.center, radius)).collect()
        }
        Form::Figure(figure) => {
            let side = |[from, to]: [DVec2; 2]| Some(line(scope, Role::Come, [pixel(scope, from)?, pixel(scope, to)?]));
            figure.sides().into_iter().filter_map(side).collect()
        }
        Form::Rope { ends, pieces, slack } => rope(scope, ends, &chain(ends.map(|end| end.at), *pieces, *slack)),
        Form::Cloth { grid, hangs } => {
            let high = grid.low + grid.size();
            let corners = [DVec2::new(grid.low.x, high.y), high];
            let pins = corners.iter().filter(|_| *hangs).filter_map(|&corner| held(scope, corner));
            rectangle(scope, [grid.low, high]).into_iter().chain(pins).collect()
        }
        Form::SolidBox(corners) => rectangle(scope, *corners),
        Form::Frame(corners) => frame(scope, *corners),
        Form::SolidCircle(circle) => round(circle),
        Form::Slope(plank) => around(scope, plank.corners()),
        Form::Plane(plane) => hatched::marks(scope, *plane),
    }
}

/// Words beside the cursor, of no outline.
pub(super) fn label(scope: Scope<'_>, at: DVec2, words: String) -> Mark {
    off(&[], scope, at, words)
}

/// Where a place is seen `[px]`.
pub(super) fn pixel(scope: Scope<'_>, at: DVec2) -> Option<DVec2> {
    scope.camera.screen_from_world(at.extend(0.0)).map(DVec2::from)
}

/// A line of an outline.
pub(super) fn line(scope: Scope<'_>, role: Role, [from, to]: [DVec2; 2]) -> Mark {
    Mark::Line(role, from, to, WIDTH * scope.scale)
}

fn rectangle(scope: Scope<'_>, [low, high]: [DVec2; 2]) -> Vec<Mark> {
    around(scope, [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)])
}

/// A rectangle with both diagonals.
fn frame(scope: Scope<'_>, [low, high]: [DVec2; 2]) -> Vec<Mark> {
    let diagonals = [[low, high], [DVec2::new(low.x, high.y), DVec2::new(high.x, low.y)]];
    let seen = |[from, to]: [DVec2; 2]| Some(line(scope, Role::Come, [pixel(scope, from)?, pixel(scope, to)?]));
    rectangle(scope, [low, high]).into_iter().chain(diagonals.into_iter().filter_map(seen)).collect()
}

fn around(scope: Scope<'_>, corners: [DVec2; 4]) -> Vec<Mark> {
    let corners = corners.map(|corner| pixel(scope, corner));
    let side = |k: usize| Some(line(scope, Role::Come, [corners[k]?, corners[(k + 1) % 4]?]));
    (0..4).filter_map(side).collect()
}

fn ring(scope: Scope<'_>, center: DVec2, radius: f64) -> Vec<Mark> {
    let wide = radius * scope.camera.pixels_per_metre();
    pixel(scope, center).map(|center| Mark::Ring(Role::Come, center, wide)).into_iter().collect()
}

/// A ring about what hangs on something.
fn held(scope: Scope<'_>, at: DVec2) -> Option<Mark> {
    Some(Mark::Ring(Role::Hold, pixel(scope, at)?, 5.0 * scope.scale))
}

/// A line; what it will be tied to is ringed and dotted, a pin of its own is ringed alone.
fn rope(scope: Scope<'_>, ends: &[End; 2], corners: &[DVec2]) -> Vec<Mark> {
    let corners: Vec<Option<DVec2>> = corners.iter().map(|corner| pixel(scope, *corner)).collect();
    let pieces = corners.windows(2).filter_map(|pair| Some(line(scope, Role::Come, [pair[0]?, pair[1]?])));
    let holds = ends.iter().flat_map(|end| {
        let at = pixel(scope, end.at);
        let ring = |radius: f64| at.map(|at| Mark::Ring(Role::Hold, at, radius * scope.scale));
        match end.hold {
            Hold::None => [None, None],
            Hold::Pin => [ring(5.0), None],
            Hold::Point(_) => [ring(9.0), at.map(|at| Mark::Knob(Role::Hold, at, 4.0 * scope.scale))],
        }
    });
    pieces.chain(holds.flatten()).collect()
}
