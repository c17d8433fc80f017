//! Parameters: numbers of a scene that it names, with a range and a unit, to be set by sliders while it runs.

use std::ops::RangeInclusive;

use super::error::{Fault, Within};
use super::keys::{KindName, Meeting, ParameterKeys, Scene};

/// A number that sliders set.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// What it is called.
    pub label: String,
    /// Its unit; empty: none.
    pub unit: String,
    /// The ends of its range.
    pub range: RangeInclusive<f64>,
    /// What it is.
    pub target: Target,
}

/// What of a running world a parameter is.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A component of gravity `[m/s^2]`.
    Gravity(usize),
    /// Rate at which velocities decay `[1/s]`.
    DragRate,
    /// A component of the wind `[m/s]`.
    Wind(usize),
    /// Of the wind `[1]`.
    Turbulence,
    /// Of the walls `[1]`.
    WallFriction,
    /// Of the walls `[1]`.
    WallRestitution,
    /// Between bodies `[1]`.
    Friction,
    /// Between bodies `[1]`.
    Restitution,
    /// Of the push of the mouse `[1/s^2]`.
    MouseStrength,
    /// Of the push of the mouse `[m]`.
    MouseRadius,
    /// Of explicit springs, by their numbers `[N/m]`.
    Stiffness(RangeInclusive<u32>),
    /// Of explicit springs, by their numbers `[N s/m]`.
    Damping(RangeInclusive<u32>),
    /// Of explicit bonds, by their numbers `[m]`.
    Rest(RangeInclusive<u32>),
}

/// What a path can be, as it is said where it is none.
const PATHS: &str = "`gravity[0]`, `drag_rate`, `wind.velocity[0]`, `wind.turbulence`, `bounds.friction`, `bounds.restitution`, \
                     `contact.friction`, `contact.restitution`, `mouse.strength`, `mouse.radius`, or `stiffness`, `damping` or `rest` of \
                     explicit bonds, as `bonds[0].stiffness` or, of several, `bonds[0-3].stiffness`";

impl Target {
    /// What a path means; `None`: nothing.
    fn of(path: &str) -> Option<Target> {
        let axis = |rest: &str| rest.strip_suffix(']').and_then(|axis| axis.parse().ok());
        if let Some(rest) = path.strip_prefix("gravity[") {
            return axis(rest).map(Target::Gravity);
        }
        if let Some(rest) = path.strip_prefix("wind.velocity[") {
            return axis(rest).map(Target::Wind);
        }
        if let Some((numbers, key)) = path.strip_prefix("bonds[").and_then(|rest| rest.split_once("].")) {
            let (first, last) = numbers.split_once('-').unwrap_or((numbers, numbers));
            let numbers = first.parse().ok()?..=last.parse().ok()?;
            return match key {
                "stiffness" => Some(Target::Stiffness(numbers)),
                "damping" => Some(Target::Damping(numbers)),
                "rest" => Some(Target::Rest(numbers)),
                _ => None,
            };
        }
        Some(match path {
            "drag_rate" => Target::DragRate,
            "wind.turbulence" => Target::Turbulence,
            "bounds.friction" => Target::WallFriction,
            "bounds.restitution" => Target::WallRestitution,
            "contact.friction" => Target::Friction,
            "contact.restitution" => Target::Restitution,
            "mouse.strength" => Target::MouseStrength,
            "mouse.radius" => Target::MouseRadius,
            _ => return None,
        })
    }

    /// The least and the greatest number that it can be.
    fn bounds(&self) -> [f64; 2] {
        match self {
            Target::Gravity(_) | Target::Wind(_) | Target::MouseStrength => [f64::NEG_INFINITY, f64::INFINITY],
            Target::Restitution => [0.0, 1.0],
            Target::MouseRadius => [f64::MIN_POSITIVE, f64::INFINITY],
            _ => [0.0, f64::INFINITY],
        }
    }

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
            Target::Friction | Target::Restitution => {
                is_there(scene.contact.and_then(Meeting::resolve).is_some(), "`contact`")
            }
            Target::MouseStrength | Target::MouseRadius => is_there(scene.mouse.is_some(), "`mouse`"),
            Target::Rest(numbers) => of_bonds(scene, numbers, false),
            Target::Stiffness(numbers) | Target::Damping(numbers) => of_bonds(scene, numbers, true),
        }
    }
}

/// Errors: bonds that are not there, or no springs where springs are meant.
fn of_bonds(scene: &Scene, numbers: &RangeInclusive<u32>, are_springs: bool) -> Result<(), Fault> {
    let (first, last) = (*numbers.start(), *numbers.end());
    if first > last {
        return Err(Fault::invalid(format!("names bonds from {first} to {last}: give the lower number first")));
    }
    let count = scene.bonds.len();
    if last as usize >= count {
        return Err(Fault::invalid(format!("names bond {last}, and there are {count} explicit ones: count from 0")));
    }
    let is_spring =
        |number: u32| scene.bonds.iter().nth(number as usize).is_some_and(|bond| bond.kind == Some(KindName::Spring));
    if let Some(other) = numbers.clone().find(|&number| are_springs && !is_spring(number)) {
        return Err(Fault::invalid(format!("names bond {other}, which is no spring: give numbers of springs")));
    }
    Ok(())
}

/// Errors: the first parameter with a path that means nothing here, or a range that is none or goes beyond what its number can be.
pub(super) fn check(scene: &Scene, dimensions: usize) -> Result<(), Fault> {
    for (i, keys) in scene.parameters.iter().enumerate() {
        let in_list = |fault: Fault| fault.item(i).at("parameters");
        let target = Target::of(&keys.path)
            .ok_or_else(|| Fault::invalid(format!("`{}` is no number that sliders set: give {PATHS}", keys.path)))
            .at("path")
            .map_err(in_list)?;
        target.is_there(scene, dimensions).at("path").map_err(in_list)?;
        let ParameterKeys { min, max, .. } = *keys;
        if !(min.is_finite() && max.is_finite() && min < max) {
            let message = format!("is {max:?} beside a `min` of {min:?}: give finite numbers, the larger one here");
            return Err(in_list(Fault::invalid(message).at("max")));
        }
        let [least, most] = target.bounds();
        for (key, end) in [("min", min), ("max", max)] {
            if !(least..=most).contains(&end) {
                let message = format!("is {end:?}: `{}` goes from {least} to {most}", keys.path);
                return Err(in_list(Fault::invalid(message).at(key)));
            }
        }
        if keys.label.as_ref().is_some_and(|label| label.trim().is_empty()) {
            return Err(in_list(Fault::invalid("is empty: give a few words, or leave it out").at("label")));
        }
    }
    Ok(())
}

impl Scene {
    /// The numbers that it names for sliders, in its order.
    pub fn named_parameters(&self) -> Vec<Parameter> {
        let of = |keys: &ParameterKeys| {
            Some(Parameter {
                label: keys.label.clone().unwrap_or_else(|| keys.path.clone()),
                unit: keys.unit.clone().unwrap_or_default(),
                range: keys.min..=keys.max,
                target: Target::of(&keys.path)?,
            })
        };
        self.parameters.iter().filter_map(of).collect()
    }
}
