//! What is selected keeps clear of what stands there as it is moved, turned or scaled: by the law by which the world would put it out
//! afterwards, but all of it alike, and seen before. Other bodies stand there too, where bodies meet.

use glam::DVec3;

use super::Deed;
use super::chosen::Chosen;
use super::pick::Scope;
use super::room::Walls;
use super::standing::{Led, Standing};
use crate::history::Do;
use crate::scene::Vector;

/// Of more points none is looked at: looking at those takes longer than a frame.
const MOST: usize = 16_000;
/// Ways that are shorter are not told of, and what lies no deeper stood clear `[logical px]`.
const LEAST: f64 = 1.0;
/// Bodies are put out together in so many rounds.
const ROUNDS: usize = 8;
/// Said of what is lifted, of what finds no room, and of what is too large to be looked at.
const LIFTED: &str = "moved aside: something was in the way";
const NO_ROOM: &str = "no room here: it overlaps what is in the way";
const TOO_LARGE: &str = "too many points to look for room: it may overlap something here";

/// How far something is put aside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Lift {
    /// `[m]`
    pub(super) way: DVec3,
    /// What is said of it.
    pub(super) said: Option<&'static str>,
}

/// How what is selected is put so that it keeps clear once `place` has led it elsewhere: nowhere where it lay in something before, or finds no
/// way out. Bodies are put, and obstacles that are selected with them go along; those alone stay.
pub(super) fn lift(scope: Scope<'_>, chosen: &Chosen, place: impl Fn(DVec3) -> DVec3) -> Lift {
    let least = least(scope);
    scope.shown.scenery.about_led.with(scope, (chosen, least), |standing| match standing {
        Standing::Nothing => Lift::default(),
        Standing::Plane(plane) => {
            let lift = lifted(plane.as_mut(), least, &place, |plane| &plane.led, |plane, at| plane.around(scope, at));
            // What lies wholly within a rim touches nothing of it.
            let holds = plane.is_rim && plane.others.lie_within(scope, |x| place(x) + lift.way);
            if holds { Lift { said: Some(NO_ROOM), ..Lift::default() } } else { lift }
        }
        Standing::Space(led) => lifted(led.as_mut(), least, place, |led| led, |led, _| led.still.clone()),
    })
}

/// The same of what is led, `led`, by what `around` says stands about places that it is led to.
fn lifted<T, const D: usize>(
    standing: &mut T,
    least: f64,
    place: impl Fn(DVec3) -> DVec3,
    led: impl Fn(&T) -> &Led<D>,
    around: impl Fn(&mut T, (&[[f64; D]], bool)) -> Walls<D>,
) -> Lift {
    let count = led(standing).points.len();
    if count > MOST {
        let there = led(standing).led(&place);
        let touches = around(standing, (&there, false)).may_touch(&there);
        let touched = led(standing).still.may_touch(&led(standing).places);
        return Lift { said: (touches && !touched).then_some(TOO_LARGE), ..Lift::default() };
    }
    if led(standing).lies_in_something(least) {
        return Lift::default();
    }
    let mut way = DVec3::ZERO;
    for round in 0..ROUNDS {
        let there = led(standing).led(|x| place(x) + way);
        let cleared = around(standing, (&there, round > 0)).clear(&there, &led(standing).bonds, &[]);
        let ways = cleared.moves.iter().map(|(_, way)| {
            let mut all = [0.0; 3];
            all[..D].copy_from_slice(way);
            DVec3::from(all)
        });
        match ways.max_by(|a, b| a.length().total_cmp(&b.length())) {
            _ if !cleared.stuck.is_empty() => break,
            None => return Lift { way, said: (way.length() > least).then_some(LIFTED) },
            Some(more) => way += more,
        }
    }
    Lift { said: Some(NO_ROOM), ..Lift::default() }
}

/// The shortest way that is told of `[m]`.
fn least(scope: Scope<'_>) -> f64 {
    LEAST * scope.scale / scope.camera.pixels_per_metre()
}

/// A command that moves something, which lifts it so far too `[m]`.
pub(super) fn with(scope: Scope<'_>, lift: DVec3, mut deed: Deed) -> Deed {
    for command in &mut deed.commands {
        if let Do::Move(keys) = command
            && lift != DVec3::ZERO
        {
            let by = DVec3::from(keys.by.map_or([0.0; 3], |by| by.embed())) + lift;
            keys.by = Some(Vector::new(by.to_array(), scope.shown.dimensions));
        }
    }
    deed
}
