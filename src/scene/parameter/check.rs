//! Whether parameters are of what their scene has, and their ranges of what numbers can be.

use std::ops::RangeInclusive;

use super::{OfBody, Target, penalty};
use crate::scene::error::{Fault, Within};
use crate::scene::keys::{DiagonalsName, KindName, MakerName, Material, Meeting, ParameterKeys, Scene, SolverName};

/// What paths begin with, and what they can go on with: said of those that go on otherwise.
const PATHS: [(&str, &str); 8] = [
    ("gravity", "`gravity[0]` or another axis"),
    ("wind", "`wind.velocity[0]` or another axis, or `wind.turbulence`"),
    ("bounds", "`bounds.friction` or `bounds.restitution`"),
    ("contact", "`contact` (0 or 1), `contact.friction`, `contact.restitution` or `contact.radius`"),
    ("mouse", "`mouse.strength` or `mouse.radius`"),
    ("bonds", "`stiffness`, `damping` or `rest`, as `bonds[0].stiffness` or, of several, `bonds[0-3].stiffness`"),
    ("obstacles", "`friction`, `restitution`, `penalty.stiffness` or `penalty.damping`, as `obstacles[0].friction`"),
    (
        "bodies",
        "`stiffness`, `damping`, `mass`, `friction` or `restitution`, as `bodies[0].material.mass`, or `bodies[0].diagonals`",
    ),
];

/// Errors: the first parameter with a path that means nothing here or what another one means, or a range that is none, goes beyond what its
/// number can be or leaves out the one that the scene begins with.
pub(in crate::scene) fn check(scene: &Scene, dimensions: usize) -> Result<(), Fault> {
    for (i, keys) in scene.parameters.iter().enumerate() {
        let in_list = |fault: Fault| fault.item(i).at("parameters");
        let target = Target::of(&keys.path).ok_or_else(|| no_target(&keys.path)).at("path").map_err(in_list)?;
        target.is_there(scene, dimensions).at("path").map_err(in_list)?;
        let is_same = |keys: &ParameterKeys| Target::of(&keys.path).is_some_and(|other| other.meets(&target));
        if let Some(first) = scene.parameters[..i].iter().position(is_same) {
            let message = format!("sets what `parameters[{first}]` does: leave one of them out");
            return Err(in_list(Fault::invalid(message).at("path")));
        }
        let ParameterKeys { min, max, .. } = *keys;
        if !(min.is_finite() && max.is_finite() && min < max) {
            let message = format!("is {max:?} beside a `min` of {min:?}: give finite numbers, the larger one here");
            return Err(in_list(Fault::invalid(message).at("max")));
        }
        let [least, most] = target.bounds();
        for (key, end) in [("min", min), ("max", max)] {
            if !(least..=most).contains(&end) {
                let range = match [least, most] {
                    [f64::MIN_POSITIVE, f64::INFINITY] => "is above 0".to_owned(),
                    [least, f64::INFINITY] => format!("is at least {least}"),
                    [least, most] => format!("goes from {least} to {most}"),
                };
                let message = format!("is {end:?}: `{}` {range}", keys.path);
                return Err(in_list(Fault::invalid(message).at(key)));
            }
        }
        if target.is_switch() && [min, max] != [0.0, 1.0] {
            let message = format!("`{}` is on or off: give a `min` of 0 and a `max` of 1", keys.path);
            return Err(in_list(Fault::invalid(message)));
        }
        if let Some(start) = target.start(scene).filter(|start| !(min..=max).contains(start)) {
            let key = if start < min { "min" } else { "max" };
            let message = format!("leaves out {start:?}, with which the scene begins: let the slider reach it");
            return Err(in_list(Fault::invalid(message).at(key)));
        }
        if keys.label.as_ref().is_some_and(|label| label.trim().is_empty()) {
            return Err(in_list(Fault::invalid("is empty: give a few words, or leave it out").at("label")));
        }
    }
    Ok(())
}

/// What is said of a path that means nothing: what others can be that begin so.
fn no_target(path: &str) -> Fault {
    let begins = |(name, _): &&(&str, &str)| path.split(['.', '[']).next().is_some_and(|first| first == *name);
    let message = match (path, PATHS.iter().find(begins)) {
        ("method.tolerance" | "method.precision", _) => {
            format!("`{path}` cannot change while a scene runs: leave it out")
        }
        (_, Some((name, can_be))) => format!("`{path}` is no number that sliders set: of `{name}` give {can_be}"),
        _ => format!(
            "`{path}` is no number that sliders set: give one as `gravity[1]`, `drag_rate`, `bonds[0].stiffness` or \
             `bodies[0].material.mass` (docs/scenes.md lists all)"
        ),
    };
    Fault::invalid(message)
}

impl Target {
    /// Errors: in words, what the scene has not that this is of.
    fn is_there(&self, scene: &Scene, dimensions: usize) -> Result<(), Fault> {
        let is_there = |is_there: bool, what: &str| match is_there {
            true => Ok(()),
            false => Err(Fault::invalid(format!("is of {what}, which this scene has not: add that, or name another"))),
        };
        match self {
            Target::Gravity(axis) | Target::Wind(axis) if *axis >= dimensions => {
                Err(Fault::invalid(format!("names axis {axis}: give one below {dimensions}")))
            }
            Target::Gravity(_) | Target::DragRate => Ok(()),
            Target::Wind(_) | Target::Turbulence => is_there(scene.wind.is_some(), "`wind`"),
            Target::WallFriction | Target::WallRestitution => is_there(scene.bounds.is_some(), "`bounds`"),
            Target::Meets => can_meet(scene),
            Target::ObstacleFriction(numbers) | Target::ObstacleRestitution(numbers) => {
                counted(scene.obstacles.len(), numbers, "obstacle")
            }
            Target::Penalty(numbers, ..) => of_soft_planes(scene, numbers),
            Target::Body(body, of, _) => of_body(scene, (*body, *of), dimensions),
            Target::Friction | Target::Restitution | Target::ContactRadius => {
                is_there(scene.contact.and_then(Meeting::resolve).is_some(), "`contact`")
            }
            Target::MouseStrength | Target::MouseRadius => is_there(scene.mouse.is_some(), "`mouse`"),
            Target::Rest(numbers) => of_bonds(scene, numbers, false),
            Target::Stiffness(numbers) | Target::Damping(numbers) => of_bonds(scene, numbers, true),
        }
    }
}

/// Errors: bodies of this scene can never meet.
fn can_meet(scene: &Scene) -> Result<(), Fault> {
    let method = &scene.method;
    match method.solver {
        None | Some(SolverName::Auto | SolverName::Live) if method.tolerance.is_some() => {
            Err(Fault::invalid("is of contact, where no tolerance is held to: leave this slider or `tolerance` out"))
        }
        None | Some(SolverName::Auto | SolverName::Live) => Ok(()),
        Some(solver) => Err(Fault::invalid(format!(
            "is of contact, which solver `{solver}` does not know: leave this slider or `solver` out"
        ))),
    }
}

/// Errors: bonds that are not there, or no springs where springs are meant.
fn of_bonds(scene: &Scene, numbers: &RangeInclusive<u32>, are_springs: bool) -> Result<(), Fault> {
    counted(scene.bonds.len(), numbers, "bond")?;
    let is_spring =
        |number: u32| scene.bonds.iter().nth(number as usize).is_some_and(|bond| bond.kind == Some(KindName::Spring));
    if let Some(other) = numbers.clone().find(|&number| are_springs && !is_spring(number)) {
        return Err(Fault::invalid(format!("names bond {other}, which is no spring: give numbers of springs")));
    }
    Ok(())
}

/// Errors: obstacles that are not there, or are no planes that push out what gets into them.
fn of_soft_planes(scene: &Scene, numbers: &RangeInclusive<u32>) -> Result<(), Fault> {
    counted(scene.obstacles.len(), numbers, "obstacle")?;
    match numbers.clone().find(|&number| penalty(scene, number).is_none()) {
        Some(other) => Err(Fault::invalid(format!("is of obstacle {other}, which has no `penalty`: add it"))),
        None => Ok(()),
    }
}

/// Errors: numbers of a list of so many things that are not there.
fn counted(count: usize, numbers: &RangeInclusive<u32>, what: &str) -> Result<(), Fault> {
    let (first, last) = (*numbers.start(), *numbers.end());
    if first > last {
        return Err(Fault::invalid(format!("names {what}s from {first} to {last}: give the lower number first")));
    }
    if last as usize >= count {
        let message = format!("names {what} {last}, and {}: count from 0", there_are(count, what));
        return Err(Fault::invalid(message));
    }
    Ok(())
}

/// How many explicit things there are, as one says it.
fn there_are(count: usize, what: &str) -> String {
    match (count, what.strip_suffix('y')) {
        (0, _) => "there is none".to_owned(),
        (1, _) => format!("there is 1 explicit {what}"),
        (_, Some(stem)) => format!("there are {count} explicit {stem}ies"),
        (_, None) => format!("there are {count} explicit {what}s"),
    }
}

/// Errors: a body that is not there, or has no number of its own that could be set.
fn of_body(scene: &Scene, (body, of): (usize, OfBody), dimensions: usize) -> Result<(), Fault> {
    let count = scene.bodies.len();
    let Some(keys) = scene.bodies.get(body) else {
        return Err(Fault::invalid(format!("names body {body}, and {}: count from 0", there_are(count, "body"))));
    };
    let material = keys.material.as_ref();
    let says = |said: fn(&Material) -> bool| material.is_some_and(said);
    let (is_said, what) = match of {
        OfBody::Stiffness => (says(|material| material.stiffness.is_some()), "`stiffness`"),
        OfBody::Damping => (says(|material| material.stiffness.is_some()), "`stiffness` to be damped"),
        OfBody::Mass => (says(|material| material.mass.is_some()), "`mass`"),
        OfBody::Friction => (says(|material| material.friction.is_some()), "`friction`"),
        OfBody::Restitution => (says(|material| material.restitution.is_some()), "`restitution`"),
        OfBody::Diagonals => {
            let has_cells = match keys.make {
                MakerName::Cloth => keys.diagonals.is_some_and(|diagonals| diagonals != DiagonalsName::None),
                MakerName::Lattice => true,
                _ => false,
            };
            if !has_cells {
                let message =
                    format!("is of body {body}, which has no diagonals: give a `cloth` some, or name a `lattice`");
                return Err(Fault::invalid(message));
            }
            (says(|material| material.stiffness.is_some()), "`stiffness`")
        }
    };
    let is_of_skin = matches!(of, OfBody::Friction | OfBody::Restitution);
    match () {
        () if is_of_skin && dimensions != 2 => {
            Err(Fault::invalid("is of a skin, which bodies have in the plane alone"))
        }
        () if !is_said => Err(Fault::invalid(format!("is of body {body}, whose material gives no {what}: add it"))),
        () => Ok(()),
    }
}
