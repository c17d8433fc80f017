//! From commands as files have them to those of the engine.

use super::clock;
use super::command::{
    AreasOrNone, DeleteKeys, Do, DriveOrNone, Factors, MoveKeys, OneOrEach, PenaltyOrNone, RangeOrNone, SetKeys,
    VectorOrEach, Walls, Weather,
};
use crate::scene::{DriveKeys, KindName, LabelKeys, LimitName, Made, Meeting, MethodKeys, Scene, Vector};
use crate::sim::{
    AngleChange, BondChange, BondId, BoundsChange, Change, Command, Dynamics, Kind, Limit, Motion, PointId,
    SceneChange, Selection, SkinMaterial, Values, Wind,
};

/// What a command comes to in a world as it is now.
pub(super) enum Resolved {
    /// It is the engine's.
    Engine(Command),
    /// Something comes, with what is drawn on it.
    Made(Box<Made>),
    /// It is the history's own.
    Group,
}

/// A command in the engine's words.
///
/// Errors: in words, what of it cannot be meant.
pub(super) fn resolve(act: &Do, scene: &Scene, world: &dyn Dynamics) -> Result<Resolved, String> {
    let command = match act {
        Do::Cursor { to, by } => Command::Cursor { to: *to, by: until(*by, world.time())? },
        Do::Mouse(change) => Command::Mouse(*change),
        Do::Grab(reach) => Command::Grab(reach.clone()),
        Do::Release => Command::Release,
        Do::Key { key, down } => Command::Key { key: *key, down: *down },
        Do::Pin(points) => Command::Pin(points.clone()),
        Do::Unpin(points) => Command::Unpin(points.clone()),
        Do::Cut { from, to } => Command::Cut { from: *from, to: *to },
        Do::Split { points, bonds } => Command::Split { points: points.clone(), bonds: bonds.clone() },
        Do::Add(keys) => {
            let made = keys.make(scene, world).map_err(|error| error.to_string())?;
            return Ok(Resolved::Made(Box::new(made)));
        }
        Do::Delete(keys) => Command::Delete(selection(keys)),
        Do::Clear => Command::Clear,
        Do::Move(keys) => Command::Move(motion(keys, scene)?),
        Do::Set(keys) => {
            if let Some(labels) = &keys.labels {
                LabelKeys::told(labels, point_numbers(world), scene.dimensions())?;
            }
            Command::Set(change(keys, scene)?)
        }
        Do::Group { points, .. } => {
            let most = point_numbers(world);
            let is_there = |point: &&PointId| point.0 < most && world.gone().binary_search(point).is_err();
            if let Some(point) = points.iter().find(|point| !is_there(point)) {
                return Err(format!("there is no point {}: name points that are there", point.0));
            }
            return Ok(Resolved::Group);
        }
    };
    Ok(Resolved::Engine(command))
}

/// How many numbers points of a world have had so far.
fn point_numbers(world: &dyn Dynamics) -> u32 {
    world.next_numbers()[0].max(world.point_count() as u32)
}

/// When a cursor arrives `[s]`: now if not said.
fn until(by: Option<f64>, now: f64) -> Result<f64, String> {
    match by {
        None => Ok(now),
        Some(by) if by >= now && by.is_finite() => Ok(by),
        // Times of commands are those of steps, but for rounding.
        Some(by) if (now - by).abs() <= 1e-12 * now.abs() => Ok(now),
        Some(by) => Err(format!("by: {by:?} s is before its own time: give one that comes after, or leave it out")),
    }
}

fn selection(keys: &DeleteKeys) -> Selection {
    Selection {
        points: points(&keys.points),
        bonds: bonds(&keys.bonds),
        obstacles: keys.obstacles.clone(),
        forces: keys.forces.clone(),
        angles: keys.angles.clone(),
    }
}

/// Errors: a vector of another dimension.
fn motion(keys: &MoveKeys, scene: &Scene) -> Result<Motion, String> {
    let MoveKeys { by, turn, axis, scale, about, over, points: list, obstacles } = keys;
    Ok(Motion {
        points: points(list),
        obstacles: obstacles.clone(),
        by: by.map_or(Ok([0.0; 3]), |by| vector("by", &by, scene))?,
        turn: turn.unwrap_or(0.0),
        axis: match axis {
            None => Motion::UPRIGHT,
            Some(_) if scene.dimensions() == 2 => {
                return Err("axis: in the plane all turns are about z: leave it out".to_owned());
            }
            Some(axis) => vector("axis", axis, scene)?,
        },
        scale: match scale {
            None => [1.0; 3],
            Some(Factors::One(factor)) => [*factor; 3],
            Some(Factors::Each(_)) if scene.dimensions() != 2 => {
                return Err("scale: has two factors: give one in space".to_owned());
            }
            Some(Factors::Each([x, y])) => [*x, *y, 1.0],
        },
        about: about.map(|about| vector("about", &about, scene)).transpose()?,
        over: *over,
    })
}

fn points(numbers: &[u32]) -> Vec<PointId> {
    numbers.iter().map(|&number| PointId(number)).collect()
}

fn bonds(numbers: &[u32]) -> Vec<BondId> {
    numbers.iter().map(|&number| BondId(number)).collect()
}

/// The keys that go with each thing that is set.
const OF_POINTS: [&str; 6] = ["mass", "velocity", "friction", "restitution", "radius", "layered"];
const OF_BONDS: [&str; 11] = [
    "kind",
    "rest",
    "stiffness",
    "compliance",
    "damping",
    "relaxation",
    "max_correction",
    "break_strain",
    "limit",
    "drive",
    "phase",
];
const OF_ANGLES: [&str; 5] = ["rest", "stiffness", "damping", "range", "drive"];
const OF_OBSTACLES: [&str; 3] = ["restitution", "friction", "penalty"];
const OF_FORCES: [&str; 2] = ["force", "torque"];
const OF_SCENE: [&str; 10] =
    ["gravity", "drag_rate", "wind", "bounds", "contact", "areas", "method", "rate", "duration", "labels"];

/// Keys of a method that a running world cannot get otherwise.
const FIXED: [&str; 2] = ["precision", "tolerance"];

fn change(keys: &SetKeys, scene: &Scene) -> Result<Change, String> {
    let lists = ["points", "bonds", "obstacles", "forces", "angles"];
    let named: Vec<&str> = keys.given().filter(|key| lists.contains(key)).collect();
    let (what, allowed): (&str, &[&str]) = match named[..] {
        [] => ("the scene", &OF_SCENE),
        ["points"] => ("points", &OF_POINTS),
        ["bonds"] => ("bonds", &OF_BONDS),
        ["obstacles"] => ("obstacles", &OF_OBSTACLES),
        ["forces"] => ("forces", &OF_FORCES),
        ["angles"] => ("angles", &OF_ANGLES),
        [first, second, ..] => return Err(format!("{second}: stands beside `{first}`: make it two commands")),
        [other] => return Err(format!("{other}: is not set by number")),
    };
    if let Some(key) = keys.given().find(|key| !lists.contains(key) && !allowed.contains(key)) {
        return Err(format!("{key}: is no key of {what}, which have {}: leave it out", allowed.join(", ")));
    }
    Ok(match what {
        "points" => Change::Points {
            points: points(keys.points.as_deref().unwrap_or_default()),
            mass: keys.mass.as_ref().map(values),
            velocity: keys.velocity.as_ref().map(|list| velocities(list, scene)).transpose()?,
            skin: SkinMaterial {
                friction: keys.friction,
                restitution: keys.restitution,
                radius: keys.radius,
                layered: keys.layered,
            },
        },
        "bonds" => {
            Change::Bonds { bonds: bonds(keys.bonds.as_deref().unwrap_or_default()), to: Box::new(bond_change(keys)?) }
        }
        "angles" => Change::Angles {
            angles: keys.angles.clone().unwrap_or_default(),
            to: Box::new(AngleChange {
                rest: keys.rest.as_ref().map(values),
                stiffness: keys.stiffness.as_ref().map(values),
                damping: keys.damping.as_ref().map(values),
                range: keys.range.as_ref().map(|range| match range {
                    RangeOrNone::These(range) => Some(*range),
                    RangeOrNone::None(()) => None,
                }),
                drive: drive(keys, DriveKeys::told_angle)?,
            }),
        },
        "obstacles" => Change::Obstacles {
            obstacles: keys.obstacles.clone().unwrap_or_default(),
            restitution: keys.restitution,
            friction: keys.friction,
            penalty: keys.penalty.as_ref().map(|penalty| match penalty {
                PenaltyOrNone::This(keys) => Some((*keys).into()),
                PenaltyOrNone::None(()) => None,
            }),
        },
        "forces" => Change::Forces {
            forces: keys.forces.clone().unwrap_or_default(),
            force: keys.force.as_ref().map(|force| vector("force", force, scene)).transpose()?,
            torque: keys.torque,
        },
        _ => Change::Scene(Box::new(scene_change(keys, scene)?)),
    })
}

fn values(numbers: &OneOrEach) -> Values {
    match numbers {
        OneOrEach::One(one) => Values::Same(*one),
        OneOrEach::Each(list) => Values::Each(list.clone()),
    }
}

fn velocities(list: &VectorOrEach, scene: &Scene) -> Result<Vec<[f64; 3]>, String> {
    let of = |v: &Vector| vector("velocity", v, scene);
    match list {
        VectorOrEach::One(one) => Ok(vec![of(one)?]),
        VectorOrEach::Each(list) => list.iter().map(of).collect(),
    }
}

/// Errors: a vector of another dimension.
fn vector(key: &str, vector: &Vector, scene: &Scene) -> Result<[f64; 3], String> {
    let (found, needed) = (vector.components().len(), scene.dimensions());
    if found == needed {
        return Ok(vector.embed());
    }
    Err(format!("{key}: has {found} numbers: a vector of this scene has {needed}"))
}

fn bond_change(keys: &SetKeys) -> Result<BondChange, String> {
    let compliance = keys.compliance.as_ref().map(reciprocal).transpose()?;
    if compliance.is_some() && keys.stiffness.is_some() {
        return Err("compliance: stands beside `stiffness`, its reciprocal: leave one of them out".to_owned());
    }
    Ok(BondChange {
        kind: keys.kind.map(|kind| match kind {
            KindName::Rigid => Kind::Rigid,
            KindName::Spring => Kind::Spring,
            KindName::Relaxed => Kind::Relaxed,
        }),
        rest_length: keys.rest.as_ref().map(values),
        stiffness: keys.stiffness.as_ref().map(values).or(compliance),
        damping: keys.damping.as_ref().map(values),
        relaxation: keys.relaxation.as_ref().map(values),
        max_correction: keys.max_correction.as_ref().map(values),
        break_strain: keys.break_strain.as_ref().map(values),
        limit: keys.limit.map(|limit| match limit {
            LimitName::Both => Limit::Both,
            LimitName::Max => Limit::Max,
            LimitName::Min => Limit::Min,
        }),
        drive: drive(keys, DriveKeys::told_bond)?,
        phase: keys.phase.as_ref().map(values),
    })
}

/// What moves what is named from now on; `Some(None)`: nothing any more.
///
/// Errors: no drive of such a thing.
fn drive<T>(keys: &SetKeys, read: impl Fn(&DriveKeys) -> Result<T, String>) -> Result<Option<Option<T>>, String> {
    match &keys.drive {
        None => Ok(None),
        Some(DriveOrNone::None(())) => Ok(Some(None)),
        Some(DriveOrNone::This(drive)) => read(drive).map(|drive| Some(Some(drive))),
    }
}

/// Errors: a compliance without a stiffness.
fn reciprocal(compliance: &OneOrEach) -> Result<Values, String> {
    let of = |c: f64| {
        let is_fine = c > 0.0 && (1.0 / c).is_finite();
        is_fine
            .then_some(1.0 / c)
            .ok_or_else(|| format!("compliance: is {c:?}: give a number above 0, or \"kind\": \"rigid\""))
    };
    Ok(match compliance {
        OneOrEach::One(one) => Values::Same(of(*one)?),
        OneOrEach::Each(list) => Values::Each(list.iter().map(|&c| of(c)).collect::<Result<_, _>>()?),
    })
}

fn scene_change(keys: &SetKeys, scene: &Scene) -> Result<SceneChange, String> {
    clock::check(keys)?;
    let bounds = match &keys.bounds {
        None => None,
        Some(Walls::None(())) => Some(None),
        Some(Walls::These(bounds)) => Some(Some(BoundsChange {
            min: vector("bounds.min", &bounds.min, scene)?,
            max: vector("bounds.max", &bounds.max, scene)?,
            restitution: bounds.restitution.unwrap_or(0.0),
            friction: bounds.friction.unwrap_or(0.0),
        })),
    };
    let fixed = keys.method.iter().flat_map(MethodKeys::given).find(|key| FIXED.contains(key));
    if let Some(key) = fixed {
        return Err(format!("method.{key}: is fixed when a history begins: leave it out, and say it in the scene"));
    }
    let method = keys.method.clone().map(|method| Scene { method, ..scene.clone() }.engine_method()).transpose();
    Ok(SceneChange {
        gravity: keys.gravity.as_ref().map(|g| vector("gravity", g, scene)).transpose()?,
        drag_rate: keys.drag_rate,
        wind: match &keys.wind {
            None => None,
            Some(Weather::None(())) => Some(None),
            Some(Weather::This(wind)) => Some(Some(Wind {
                velocity: vector("wind.velocity", &wind.velocity, scene)?,
                turbulence: wind.turbulence.unwrap_or(0.0),
                seed: wind.seed.unwrap_or(0),
            })),
        },
        bounds,
        contact: keys.contact.map(Meeting::resolve),
        areas: match &keys.areas {
            None => None,
            Some(AreasOrNone::None(())) => Some(None),
            Some(AreasOrNone::These(areas)) => Some(Some(areas.told(scene.dimensions())?)),
        },
        method: method.map_err(|error| error.to_string())?,
    })
}
