//! From a scene's keys to the baseline's program.

use super::program::{Bounds, Mouse, Plane, Point, Program, Rod, Spring};
use crate::scene::{
    BondKeys, BoundsKeys, KindName, MassKeys, MouseKeys, ObstacleKeys, ProfileName, RegionName, Scene, Vector,
};

/// Seed of the shuffles; xorshift takes any but 0.
const SEED: u64 = 0x9E37_79B9_7F4A_7C15;

/// The program of a scene in `D` dimensions.
///
/// Errors: what the sources' method does not have, in words.
pub(super) fn program<const D: usize>(scene: &Scene) -> Result<Program<D>, String> {
    let scene = &scene.expanded().map_err(|error| error.to_string())?;
    refuse(scene)?;
    let points = points::<D>(scene);
    let mut program = Program {
        velocity: velocities(scene, points.len()),
        points,
        springs: Vec::new(),
        rods: Vec::new(),
        gravity: scene.gravity.as_ref().map_or([0.0; D], vector),
        drag_rate: scene.drag_rate.unwrap_or(0.0),
        mouse: scene.mouse.as_ref().and_then(mouse),
        bounds: scene.bounds.as_ref().map(bounds),
        planes: scene.obstacles.iter().filter_map(plane).collect(),
        hh: 0.0,
        per_h: 0.0,
        sweeps: 0,
        is_shuffled: false,
        random: SEED,
    };
    for bond in scene.bonds.iter() {
        add(&mut program, &bond);
    }
    Ok(program)
}

/// Errors: the first key that the sources' method has no answer to.
fn refuse(scene: &Scene) -> Result<(), String> {
    let mouse_moves = scene.mouse.as_ref().is_some_and(|mouse| mouse.track.len() > 1);
    let shapes = scene.obstacles.iter().any(|obstacle| obstacle.plane.is_none());
    let has_friction = scene.obstacles.iter().any(|obstacle| obstacle.friction.unwrap_or(0.0) > 0.0)
        || scene.bounds.as_ref().is_some_and(|bounds| bounds.friction.unwrap_or(0.0) > 0.0);
    for (what, is_there) in [
        ("areas", scene.areas.is_some()),
        ("wind", scene.wind.is_some()),
        ("moving pins", !scene.pin_motion.is_empty()),
        ("a mouse that moves", mouse_moves),
        ("obstacles other than planes", shapes),
        ("friction", has_friction),
        ("bonds with a limit", scene.bonds.iter().any(|bond| bond.limit.is_some())),
        ("bonds that break", scene.bonds.iter().any(|bond| bond.break_strain.is_some())),
        ("relaxed bonds", scene.bonds.iter().any(|bond| bond.kind == Some(KindName::Relaxed))),
    ] {
        if is_there {
            return Err(format!("the sources' method, as it is run here, has no {what}"));
        }
    }
    Ok(())
}

fn vector<const D: usize>(keys: &Vector) -> [f64; D] {
    let mut v = [0.0; D];
    v.copy_from_slice(&keys.embed()[..D]);
    v
}

fn points<const D: usize>(scene: &Scene) -> Vec<Point<D>> {
    let Some(keys) = &scene.points else { return Vec::new() };
    let inverse_mass = |i: usize| match &keys.mass {
        None => 1.0,
        Some(MassKeys::Same(mass)) => 1.0 / mass,
        Some(MassKeys::Each(masses)) => 1.0 / masses[i],
    };
    let point = |(i, x): (usize, &Vector)| Point {
        x: vector(x),
        previous: vector(x),
        force: [0.0; D],
        inverse_mass: inverse_mass(i),
    };
    let mut points: Vec<Point<D>> = keys.position.iter().enumerate().map(point).collect();
    for &pin in &keys.pinned {
        points[pin as usize].inverse_mass = 0.0;
    }
    points
}

fn velocities<const D: usize>(scene: &Scene, count: usize) -> Vec<[f64; D]> {
    let keys = scene.points.as_ref();
    let mut velocity: Vec<[f64; D]> = vec![[0.0; D]; count];
    if let Some(keys) = keys {
        for (v, said) in velocity.iter_mut().zip(keys.velocity.iter().flatten()) {
            *v = vector(said);
        }
        for &pin in &keys.pinned {
            velocity[pin as usize] = [0.0; D];
        }
    }
    velocity
}

fn mouse(keys: &MouseKeys) -> Option<Mouse> {
    // Without a track there is no cursor, and no force.
    let knot = keys.track.first()?;
    let [_, x, y] = knot.0;
    Some(Mouse {
        at: [x, y],
        strength: keys.strength,
        radius: keys.radius,
        is_square: keys.region == Some(RegionName::Square),
        is_linear: keys.profile == Some(ProfileName::Linear),
    })
}

fn bounds<const D: usize>(keys: &BoundsKeys) -> Bounds<D> {
    Bounds { min: vector(&keys.min), max: vector(&keys.max), restitution: keys.restitution.unwrap_or(0.0) }
}

/// A plane, its normal made 1 long.
fn plane<const D: usize>(keys: &ObstacleKeys) -> Option<Plane<D>> {
    let plane = keys.plane.as_ref()?;
    let (point, normal): ([f64; D], [f64; D]) = (vector(&plane.point), vector(&plane.normal));
    let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
    let normal = normal.map(|c| c / length);
    let offset = normal.iter().zip(&point).map(|(n, p)| n * p).sum();
    Some(Plane { normal, offset, restitution: keys.restitution.unwrap_or(0.0) })
}

/// Adds a bond as a spring or a rod; one between two pinned points does nothing and is left out.
fn add<const D: usize>(program: &mut Program<D>, keys: &BondKeys) {
    let (a, b) = (keys.a as usize, keys.b as usize);
    let (wa, wb) = (program.points[a].inverse_mass, program.points[b].inverse_mass);
    if wa + wb == 0.0 {
        return;
    }
    let apart = || {
        let square = |k: usize| (program.points[a].x[k] - program.points[b].x[k]).powi(2);
        (0..D).map(square).sum::<f64>().sqrt()
    };
    let rest = keys.rest.unwrap_or_else(apart);
    let stiffness = keys.stiffness.or(keys.compliance.filter(|&c| c > 0.0).map(|c| 1.0 / c));
    match stiffness {
        Some(stiffness) => {
            program.springs.push(Spring { a, b, rest, stiffness, damping: keys.damping.unwrap_or(0.0) });
        }
        None => program.rods.push(Rod { a, b, rest, share_a: wa / (wa + wb), share_b: wb / (wa + wb) }),
    }
}
