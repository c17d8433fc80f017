//! Wind by an arrow in the air: which way it blows, and how fast.

use glam::{DVec2, DVec3};

use super::Deed;
use super::marks::{Mark, Role};
use super::pick::Scope;
use super::push::head;
use super::segments::distance_to_segment;
use super::selecting::is_drag;
use crate::history::{Do, SetKeys, Weather};
use crate::scene::{Vector, WindKeys};
use crate::sim::Wind;

/// An arrow of 5 m/s is so long `[logical px]`, one of another speed in proportion.
const USUAL: f64 = 5.0;
const LONG: f64 = 100.0;
/// A press this near to the end of the arrow is on it `[logical px]`.
const NEAR: f64 = 14.0;
/// Where the arrow begins that nobody has drawn: as shares of the picture.
const BEGINS: [f64; 2] = [0.5, 0.2];
/// What the air gets where it drags nothing, so that wind is felt `[1/s]`.
const DRAG: f64 = 1.0;
/// Gusts of a wind that is new `[1]`.
const TURBULENCE: f64 = 0.2;

const CLICKED: &str = "wind: drag an arrow through the air; its length is the speed, a click on its end takes it away";
const FELT: &str = "the air drags at 1 /s from now on, or no wind would be felt: settings (G) say how much";

/// An arrow that is being drawn or changed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Blow {
    pressed: DVec2,
    /// Where it begins `[m]`.
    from: DVec3,
    /// It is the one that was there.
    is_old: bool,
}

/// How far an arrow of 1 m/s goes `[m]`.
fn per_speed(scope: Scope<'_>) -> f64 {
    LONG * scope.scale / USUAL / scope.camera.pixels_per_metre()
}

fn wind(scope: Scope<'_>) -> Option<Wind<3>> {
    scope.shown.settings.wind.flatten().filter(|wind| wind.velocity != [0.0; 3])
}

/// Where the arrow begins `[m]`: where it was drawn, if that is seen.
fn begins(scope: Scope<'_>, drawn: Option<DVec3>) -> DVec3 {
    let [width, height] = scope.camera.viewport().map(f64::from);
    let is_seen = |place: &DVec3| {
        let seen = scope.camera.screen_from_world(*place);
        seen.is_some_and(|[x, y]| (0.0..=width).contains(&x) && (0.0..=height).contains(&y))
    };
    drawn.filter(is_seen).unwrap_or_else(|| scope.camera.world_from_screen([BEGINS[0] * width, BEGINS[1] * height]))
}

/// Where an arrow begins and ends on the screen `[px]`.
fn ends(scope: Scope<'_>, from: DVec3, velocity: DVec3) -> Option<[DVec2; 2]> {
    let pixel = |place: DVec3| scope.camera.screen_from_world(place).map(DVec2::from);
    Some([pixel(from)?, pixel(from + per_speed(scope) * velocity)?])
}

/// The velocity of an arrow whose end is at a pixel, rounded to two digits behind the point `[m/s]`.
fn velocity(scope: Scope<'_>, from: DVec3, at: DVec2) -> DVec3 {
    let to = scope.camera.world_from_screen(at.to_array());
    let start = scope.camera.screen_from_world(from).map_or(from, |pixel| scope.camera.world_from_screen(pixel));
    (100.0 * (to - start) / per_speed(scope)).round() / 100.0
}

fn words(velocity: DVec3, dimensions: usize) -> String {
    let all = velocity.to_array();
    let parts: Vec<String> = all.iter().take(dimensions).map(|part| format!("{part:.1}")).collect();
    format!("wind {:.1} m/s ({})", velocity.length(), parts.join(", "))
}

/// The arrow, with its number.
fn arrow(scope: Scope<'_>, (from, velocity): (DVec3, DVec3), role: Role) -> Vec<Mark> {
    let Some([from, to]) = ends(scope, from, velocity) else { return Vec::new() };
    let width = 4.0 * scope.scale;
    let mut marks = vec![Mark::Line(role, from, to, width)];
    marks.extend(head(scope, [from, to]).map(|side| Mark::Line(role, to, side, width)));
    // Two lines beside it: it blows everywhere.
    let across = 9.0 * scope.scale * (to - from).normalize_or_zero().perp();
    for side in [across, -across] {
        let [a, b] = [from.lerp(to, 0.1) + side, from.lerp(to, 0.6) + side];
        marks.push(Mark::Line(role, a, b, 0.5 * width));
    }
    marks.push(Mark::Knob(role, from, 4.0 * scope.scale));
    let beside = to + DVec2::new(16.0, -14.0) * scope.scale;
    marks.push(Mark::Words(beside, words(velocity, scope.shown.dimensions)));
    marks
}

/// Whether a pixel is at the end of the arrow that is there.
fn is_at_end(scope: Scope<'_>, drawn: Option<DVec3>, at: DVec2) -> bool {
    let end = wind(scope).and_then(|wind| ends(scope, begins(scope, drawn), DVec3::from(wind.velocity)));
    end.is_some_and(|[from, to]| {
        let back = to + (from - to).clamp_length_max(NEAR * scope.scale);
        distance_to_segment(at, to, back) <= NEAR * scope.scale
    })
}

impl Blow {
    /// The arrow is taken by its end, or a new one begins.
    pub(super) fn press(scope: Scope<'_>, drawn: Option<DVec3>, at: DVec2) -> Self {
        let is_old = is_at_end(scope, drawn, at);
        let from = if is_old { begins(scope, drawn) } else { scope.camera.world_from_screen(at.to_array()) };
        Blow { pressed: at, from, is_old }
    }

    /// Where it begins `[m]`.
    pub(super) fn from(&self) -> DVec3 {
        self.from
    }

    /// What a release at a pixel does.
    pub(super) fn release(&self, scope: Scope<'_>, at: DVec2) -> Deed {
        let set = |name: &'static str, keys: SetKeys| Deed::edit(name, Do::Set(Box::new(keys)));
        if !is_drag(scope, [self.pressed, at]) {
            return match self.is_old {
                true => set("still air", SetKeys { wind: Some(Weather::None(())), ..SetKeys::default() }),
                false => Deed::words(CLICKED.to_owned()),
            };
        }
        let to = velocity(scope, self.from, at).to_array();
        let before = wind(scope);
        let turbulence = before.map_or(TURBULENCE, |wind| wind.turbulence);
        let keys = WindKeys {
            velocity: Vector::new(to, scope.shown.dimensions),
            turbulence: (turbulence > 0.0).then_some(turbulence),
            seed: before.map(|wind| wind.seed),
        };
        let is_felt = scope.shown.settings.drag_rate.is_none_or(|rate| rate > 0.0);
        let drag_rate = (!is_felt).then_some(DRAG);
        let deed = set("wind", SetKeys { wind: Some(Weather::This(keys)), drag_rate, ..SetKeys::default() });
        Deed { words: (!is_felt).then(|| FELT.to_owned()), ..deed }
    }

    /// What it looks like now.
    pub(super) fn marks(&self, scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
        match is_drag(scope, [self.pressed, at]) {
            true => arrow(scope, (self.from, velocity(scope, self.from, at)), Role::Come),
            false => Vec::new(),
        }
    }
}

/// The wind as an arrow, and what a press at the pixel would do.
pub(super) fn marks(scope: Scope<'_>, drawn: Option<DVec3>, at: Option<DVec2>) -> Vec<Mark> {
    let said = |at: DVec2, words: &str| Mark::Words(at + DVec2::new(16.0, 22.0) * scope.scale, words.to_owned());
    let near = at.filter(|at| is_at_end(scope, drawn, *at));
    let role = if near.is_some() { Role::Away } else { Role::Push };
    let mut marks = wind(scope)
        .map_or_else(Vec::new, |wind| arrow(scope, (begins(scope, drawn), DVec3::from(wind.velocity)), role));
    marks.extend(near.map(|at| said(at, "a click takes it away, a drag changes it")));
    let is_still = wind(scope).is_none();
    marks.extend(at.filter(|_| is_still).map(|at| said(at, "drag: wind through all of the scene")));
    marks
}
