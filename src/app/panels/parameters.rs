//! Sliders of the numbers that a scene names, above all that can be set.

use std::ops::RangeInclusive;

use egui::{Response, RichText, Slider, SliderClamping, Ui};

use super::settings::Sink;
use super::theme::colors;
use super::{ranged, ticks};
use crate::app::alike::alike;
use crate::app::player::{Scenery, Shown};
use crate::history::{Do, OneOrEach, PenaltyOrNone, SetKeys, Walls, Weather};
use crate::scene::{
    BodyPart, BoundsKeys, ContactKeys, Meeting, OfBody, OfPenalty, Parameter, PenaltyKeys, Target, Vector, WindKeys,
};
use crate::sim::{BondKind, Contact, MouseChange, SceneChange};

/// A range whose ends are so far apart is gone through by factors `[1]`.
const WIDE: f64 = 50.0;

/// Said of bonds across the cells of a cloth, which lie below what is filled.
const BRACED: &str = "they keep its cells square; B shows them";
const UNBRACED: &str = "its cells give way to a pull across; B shows its threads";

/// The numbers that a scene names, each as it is now.
pub(in crate::app) fn all(named: &[Parameter], shown: &Shown, push: Option<[f64; 2]>) -> Vec<(Parameter, Option<f64>)> {
    let in_world = |place: usize| shown.scenery.named.get(place).copied().flatten();
    // A push on a track of its own is no live one.
    let push = push.or_else(|| shown.mouse.as_ref().map(|force| [force.strength, force.radius]));
    let of = |(place, parameter): (usize, &Parameter)| {
        let value = value(&parameter.target, &shown.settings, push, &shown.scenery);
        (as_now(parameter, &shown.scenery), value.or_else(|| in_world(place)))
    };
    named.iter().enumerate().map(of).collect()
}

/// A parameter with what stands beside its number as that is now.
fn as_now(parameter: &Parameter, scenery: &Scenery) -> Parameter {
    let mut parameter = parameter.clone();
    if let Target::Penalty(numbers, _, both) = &mut parameter.target {
        *both = penalties(numbers, scenery).collect();
    }
    parameter
}

/// By how much those that are left of some planes push out what gets into them, each with its number `[N/m]`, `[N s/m]`.
fn penalties(numbers: &RangeInclusive<u32>, scenery: &Scenery) -> impl Iterator<Item = (u32, [f64; 2])> {
    scenery.penalties.iter().copied().filter(|(number, _)| numbers.contains(number))
}

/// The number that a parameter is now; `None` where what it is of has gone, and of bodies and obstacles, which the world itself is asked for.
pub(super) fn value(target: &Target, scene: &SceneChange, push: Option<[f64; 2]>, scenery: &Scenery) -> Option<f64> {
    let bond = |number: u32| scenery.bond(number);
    let spring = |number: u32| match bond(number)?.kind {
        BondKind::Spring { stiffness, damping } => Some([stiffness, damping]),
        _ => None,
    };
    match target {
        Target::Gravity(axis) => scene.gravity?.get(*axis).copied(),
        Target::DragRate => scene.drag_rate,
        // Still air has been taken away.
        Target::Wind(axis) => Some(scene.wind?.map_or(0.0, |wind| wind.velocity[*axis])),
        Target::Turbulence => Some(scene.wind?.map_or(0.0, |wind| wind.turbulence)),
        Target::WallFriction => Some(scene.bounds.as_ref()?.as_ref()?.friction),
        Target::WallRestitution => Some(scene.bounds.as_ref()?.as_ref()?.restitution),
        Target::Friction => Some(scene.contact??.friction),
        Target::Restitution => Some(scene.contact??.restitution),
        Target::MouseStrength => push.map(|[strength, _]| strength),
        Target::MouseRadius => push.map(|[_, radius]| radius),
        // Of several the first that is left.
        Target::Stiffness(numbers) => numbers.clone().find_map(spring).map(|[stiffness, _]| stiffness),
        Target::Damping(numbers) => numbers.clone().find_map(spring).map(|[_, damping]| damping),
        Target::Rest(numbers) => numbers.clone().find_map(bond).map(|bond| bond.rest_length),
        Target::Meets => scene.contact.map(|contact| f64::from(u8::from(contact.is_some()))),
        Target::ContactRadius => scene.contact??.radius,
        Target::Penalty(numbers, of, _) => penalties(numbers, scenery).next().map(|(_, both)| of.of(both)),
        Target::ObstacleFriction(_) | Target::ObstacleRestitution(_) | Target::Body(..) => None,
    }
}

/// Sliders with names and units; those whose things have gone are left out, and those of what a switch beside them took away wait for it.
pub(super) fn show(ui: &mut Ui, list: &[(Parameter, Option<f64>)], scene: &SceneChange, sink: &mut Sink<'_>) {
    ui.strong("Of this scene");
    for (parameter, value) in list {
        let [least, most] = [*parameter.range.start(), *parameter.range.end()];
        let waits = value.is_none() && parameter.target.is_of_switch();
        let Some(mut to) = value.or(waits.then_some(least)) else { continue };
        if parameter.target.is_switch() {
            let mut meets = to > 0.0;
            let by = ticks::check(ui, &mut meets, &parameter.label);
            if matches!(parameter.target, Target::Body(_, OfBody::Diagonals, _)) {
                ui.label(RichText::new(if meets { BRACED } else { UNBRACED }).color(colors(ui).weak));
            }
            if by.changed() {
                set(&by, &parameter.target, f64::from(u8::from(meets)), scene, sink);
            }
            continue;
        }
        let label = ui.label(&parameter.label);
        ui.spacing_mut().slider_width = 130.0;
        let unit = if parameter.unit.is_empty() { String::new() } else { format!(" {}", parameter.unit) };
        let slider = Slider::new(&mut to, parameter.range.clone()).clamping(SliderClamping::Edits).suffix(&unit);
        let slider = slider.logarithmic(least > 0.0 && most > WIDE * least).max_decimals(3);
        let slider = slider.update_while_editing(false);
        let add = |ui: &mut Ui| ranged::slider(ui, slider, parameter.range.clone(), &unit);
        let by = ui.add_enabled_ui(!waits, add).inner.labelled_by(label.id);
        if by.changed() {
            set(&by, &parameter.target, to, scene, sink);
        }
    }
}

fn set(by: &Response, target: &Target, to: f64, scene: &SceneChange, sink: &mut Sink<'_>) {
    let acts = commands(target, to, scene, |v| sink.vector(v)).unwrap_or_default();
    sink.set_all(by, name(target), acts);
}

/// What the change of a parameter is called when it is undone.
fn name(target: &Target) -> &'static str {
    match target {
        Target::Gravity(_) => "gravity",
        Target::DragRate => "drag",
        Target::Wind(_) | Target::Turbulence => "wind",
        Target::WallFriction | Target::ObstacleFriction(_) | Target::Friction => "friction",
        Target::WallRestitution | Target::ObstacleRestitution(_) | Target::Restitution => "restitution",
        Target::MouseStrength | Target::MouseRadius => "push",
        Target::Stiffness(_) | Target::Penalty(_, OfPenalty::Stiffness, _) => "stiffness",
        Target::Damping(_) | Target::Penalty(_, OfPenalty::Damping, _) => "damping",
        Target::Rest(_) => "length",
        Target::Meets | Target::ContactRadius => "contact",
        Target::Body(_, of, _) => match of {
            OfBody::Stiffness => "stiffness",
            OfBody::Damping => "damping",
            OfBody::Mass => "mass",
            OfBody::Friction => "friction",
            OfBody::Restitution => "restitution",
            OfBody::Diagonals => "diagonals",
        },
    }
}

/// What sets a parameter, where the scene is so now; `None`: what it is of has gone. `vector`: as the scene writes them.
pub(super) fn commands(
    target: &Target,
    to: f64,
    scene: &SceneChange,
    vector: impl Fn([f64; 3]) -> Vector,
) -> Option<Vec<Do>> {
    let bonds = |numbers: &RangeInclusive<u32>, keys: SetKeys| {
        Do::Set(Box::new(SetKeys { bonds: Some(numbers.clone().collect()), ..keys }))
    };
    let one = Some(OneOrEach::One(to));
    let nothing = SetKeys::default;
    Some(vec![match target {
        Target::Gravity(axis) => {
            let mut gravity = scene.gravity.unwrap_or_default();
            gravity[*axis] = to;
            Do::Set(Box::new(SetKeys { gravity: Some(vector(gravity)), ..nothing() }))
        }
        Target::DragRate => Do::Set(Box::new(SetKeys { drag_rate: Some(to), ..nothing() })),
        Target::Wind(_) | Target::Turbulence => {
            let wind = scene.wind.flatten();
            let mut velocity = wind.map_or([0.0; 3], |wind| wind.velocity);
            let mut turbulence = wind.map_or(0.0, |wind| wind.turbulence);
            match target {
                Target::Wind(axis) => velocity[*axis] = to,
                _ => turbulence = to,
            }
            let velocity: Vector = vector(velocity);
            let turbulence = (turbulence > 0.0).then_some(turbulence);
            let keys = WindKeys { velocity, turbulence, seed: wind.map(|wind| wind.seed) };
            Do::Set(Box::new(SetKeys { wind: Some(Weather::This(keys)), ..nothing() }))
        }
        Target::WallFriction | Target::WallRestitution => {
            let mut walls = scene.bounds??;
            match target {
                Target::WallFriction => walls.friction = to,
                _ => walls.restitution = to,
            }
            let keys = BoundsKeys {
                min: vector(walls.min),
                max: vector(walls.max),
                restitution: Some(walls.restitution),
                friction: Some(walls.friction),
            };
            Do::Set(Box::new(SetKeys { bounds: Some(Walls::These(keys)), ..nothing() }))
        }
        Target::Meets => {
            let keys = SetKeys { contact: Some(Meeting::Is(to > 0.0)), ..nothing() };
            Do::Set(Box::new(keys))
        }
        Target::ObstacleFriction(numbers) => {
            let obstacles = Some(numbers.clone().collect());
            Do::Set(Box::new(SetKeys { obstacles, friction: Some(to), ..nothing() }))
        }
        Target::ObstacleRestitution(numbers) => {
            let obstacles = Some(numbers.clone().collect());
            Do::Set(Box::new(SetKeys { obstacles, restitution: Some(to), ..nothing() }))
        }
        Target::Penalty(_, of, each) => return Some(set_penalties(*of, each, to)),
        Target::Body(_, of, part) => Do::Set(Box::new(set_body(*of, part, to))),
        Target::Friction | Target::Restitution | Target::ContactRadius => {
            let before = scene.contact??;
            let contact = match target {
                Target::Friction => Contact { friction: to, ..before },
                Target::Restitution => Contact { restitution: to, ..before },
                _ => Contact { radius: Some(to), ..before },
            };
            let keys = ContactKeys {
                friction: Some(contact.friction),
                restitution: Some(contact.restitution),
                radius: contact.radius,
                with_itself: Some(contact.with_itself),
                bodies: Some(contact.with_others),
            };
            Do::Set(Box::new(SetKeys { contact: Some(Meeting::As(keys)), ..nothing() }))
        }
        Target::MouseStrength => Do::Mouse(MouseChange { strength: Some(to), ..MouseChange::default() }),
        Target::MouseRadius => Do::Mouse(MouseChange { radius: Some(to), ..MouseChange::default() }),
        Target::Stiffness(numbers) => bonds(numbers, SetKeys { stiffness: one, ..nothing() }),
        Target::Damping(numbers) => bonds(numbers, SetKeys { damping: one, ..nothing() }),
        Target::Rest(numbers) => bonds(numbers, SetKeys { rest: one, ..nothing() }),
    }])
}

/// One number of planes, each of which keeps its other one: a command gives all planes that it names both.
fn set_penalties(of: OfPenalty, each: &[(u32, [f64; 2])], to: f64) -> Vec<Do> {
    let set = |([stiffness, damping], numbers): ([f64; 2], Vec<u32>)| {
        let penalty = Some(PenaltyOrNone::This(PenaltyKeys { stiffness, damping: Some(damping) }));
        Do::Set(Box::new(SetKeys { obstacles: Some(numbers), penalty, ..SetKeys::default() }))
    };
    alike(each.iter().map(|&(number, both)| (of.put(both, to), number))).into_iter().map(set).collect()
}

/// The keys that set a number of a body.
fn set_body(of: OfBody, part: &BodyPart, to: f64) -> SetKeys {
    let points = Some(part.points.clone().collect());
    let bonds = Some(part.bonds.clone().collect());
    let each = |shares: &[f64]| Some(OneOrEach::Each(shares.iter().map(|share| share * to).collect()));
    let nothing = SetKeys::default();
    match of {
        OfBody::Diagonals => {
            let share = |number: &u32| part.shares[(number - part.bonds.start) as usize];
            let each = |whole: f64| {
                Some(OneOrEach::Each(part.diagonals.iter().map(|number| to * whole * share(number)).collect()))
            };
            let [stiffness, damping] = part.braced.map(each);
            SetKeys { bonds: Some(part.diagonals.clone()), stiffness, damping, ..nothing }
        }
        OfBody::Stiffness => SetKeys { bonds, stiffness: each(&part.shares), ..nothing },
        OfBody::Damping => SetKeys { bonds, damping: each(&part.shares), ..nothing },
        OfBody::Mass => SetKeys { points, mass: each(&part.masses), ..nothing },
        OfBody::Friction => SetKeys { points, friction: Some(to), ..nothing },
        OfBody::Restitution => SetKeys { points, restitution: Some(to), ..nothing },
    }
}
