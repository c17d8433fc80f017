//! Numbers of bodies and obstacles that a scene names for sliders, as they are in a world.

use std::ops::RangeInclusive;

use crate::scene::{BodyPart, OfBody, Target};
use crate::sim::{BondKind, Dynamics, Obstacle, PointId};

/// The number that a parameter of bodies or obstacles is now in a world; `None` of others, and where what it is of has gone.
pub(super) fn in_world(target: &Target, world: &dyn Dynamics) -> Option<f64> {
    let surface = |numbers: &RangeInclusive<u32>| {
        let obstacles = world.obstacles();
        let (_, first) = obstacles.iter().find(|(number, _)| numbers.contains(number))?;
        Some(match first {
            Obstacle::Plane { friction, restitution, .. } => [*friction, *restitution],
            Obstacle::Polygon(polygon) => [polygon.friction, polygon.restitution],
            Obstacle::Convex(convex) => [convex.friction, convex.restitution],
        })
    };
    match target {
        Target::ObstacleFriction(numbers) => surface(numbers).map(|[friction, _]| friction),
        Target::ObstacleRestitution(numbers) => surface(numbers).map(|[_, restitution]| restitution),
        Target::Body(_, of, part) => of_body(world, *of, part),
        _ => None,
    }
}

/// A number of a body: of its first bond or point that is left.
fn of_body(world: &dyn Dynamics, of: OfBody, part: &BodyPart) -> Option<f64> {
    let point = || part.points.clone().map(PointId).find(|point| world.gone().binary_search(point).is_err());
    let skin = || point().map(|point| world.skin_of(point));
    let of_springs = |which: fn([f64; 2]) -> f64| {
        let number = |place: usize| world.bond_numbers().map_or(place as u32, |numbers| numbers[place]);
        let own = world.bonds().iter().enumerate().map(|(place, bond)| (number(place), bond));
        own.filter(|(number, _)| part.bonds.contains(number)).find_map(|(number, bond)| match bond.kind {
            BondKind::Spring { stiffness, damping } => {
                let share = part.shares[(number - part.bonds.start) as usize];
                (share > 0.0).then(|| which([stiffness, damping]) / share)
            }
            _ => None,
        })
    };
    match of {
        OfBody::Stiffness => of_springs(|[stiffness, _]| stiffness),
        OfBody::Damping => of_springs(|[_, damping]| damping),
        OfBody::Diagonals => {
            let numbers = world.bond_numbers();
            let number = |place: usize| numbers.map_or(place as u32, |numbers| numbers[place]);
            let mut own = world.bonds().iter().enumerate().map(|(place, bond)| (number(place), bond));
            own.find_map(|(number, bond)| match bond.kind {
                BondKind::Spring { stiffness, .. } if part.diagonals.binary_search(&number).is_ok() => {
                    Some(f64::from(u8::from(stiffness > 0.0)))
                }
                _ => None,
            })
        }
        OfBody::Mass => {
            let point = point()?;
            let share = part.masses[(point.0 - part.points.start) as usize];
            (share > 0.0).then(|| world.masses()[point.index()] / share)
        }
        OfBody::Friction => skin()?.friction,
        OfBody::Restitution => skin()?.restitution,
    }
}
