//! What acts on the points from outside: gravity, wind, mouse, moving pins, walls, obstacles.

use super::number::{self, Range};
use crate::scene::error::{Fault, Source, Within};
use crate::scene::keys::{
    BoxKeys, ForceKeys, MouseKeys, ObstacleKeys, PictureKeys, PinMotionKeys, RegionName, Scene, Vector, WindKeys,
};
use crate::scene::{nearest, obstacle};
use crate::sim::MOST_GRAVITY;
use crate::sim::vector::{cross, sub, truncate};

/// Errors: it is stronger than is moved.
fn check_gravity(gravity: &Vector) -> Result<(), Fault> {
    let is_beyond = |g: &f64| g.abs() > MOST_GRAVITY;
    match gravity.components().iter().enumerate().find(|(_, g)| is_beyond(g)) {
        Some((k, g)) => {
            Err(Fault::invalid(format!("is {g:?}: give a number from -{MOST_GRAVITY:e} to {MOST_GRAVITY:e} m/s^2")))
                .item(k)
        }
        None => Ok(()),
    }
}

/// Errors: the first fault. `is_pinned` says whether a point of the scene is pinned.
pub(super) fn check(
    scene: &Scene,
    (count, dimensions): (u32, usize),
    is_pinned: &dyn Fn(u32) -> bool,
) -> Result<(), Fault> {
    check_forces(&scene.forces, count, dimensions)?;
    if let Some(gravity) = &scene.gravity {
        number::vector(gravity, dimensions).and_then(|()| check_gravity(gravity)).at("gravity")?;
    }
    Range::NotNegative.maybe(scene.drag_rate).at("drag_rate")?;
    if let Some(wind) = &scene.wind {
        check_wind(wind, dimensions).at("wind")?;
    }
    if let Some(mouse) = &scene.mouse {
        check_mouse(mouse, dimensions).at("mouse")?;
    }
    for (i, motion) in scene.pin_motion.iter().enumerate() {
        check_pin_motion(motion, dimensions, is_pinned).item(i).at("pin_motion")?;
    }
    if let Some(pin) = scene.cursor_pin
        && !is_pinned(pin)
    {
        let message = format!("point {pin} is not pinned: add it to `pinned`, or give a pinned one");
        return Err(Fault::invalid(message).at("cursor_pin"));
    }
    if let Some(point) = scene.click_start {
        check_start(scene, point, (dimensions, is_pinned)).at("click_start")?;
    }
    if let Some(bounds) = &scene.bounds {
        number::corners(&bounds.min, &bounds.max, dimensions).at("bounds")?;
        check_surface(bounds.restitution, bounds.friction).at("bounds")?;
    }
    for (i, obstacle) in scene.obstacles.iter().enumerate() {
        check_obstacle(obstacle, dimensions, &scene.source).item(i).at("obstacles")?;
    }
    Ok(())
}

/// Errors: a point that is none of `points`, is pinned, or lies at the origin; in space.
fn check_start(scene: &Scene, point: u32, (dimensions, is_pinned): (usize, &dyn Fn(u32) -> bool)) -> Result<(), Fault> {
    if dimensions == 3 {
        return Err(Fault::invalid("is for the plane: leave it out in space"));
    }
    let place = scene.points.as_ref().and_then(|points| points.position.get(point as usize));
    let Some(place) = place else {
        return Err(Fault::invalid(format!("there is no point {point} in `points`: name one of them")));
    };
    if is_pinned(point) {
        return Err(Fault::invalid(format!("point {point} is pinned: name a free one")));
    }
    match place.embed().iter().all(|x| *x == 0.0) {
        true => Err(Fault::invalid(format!("point {point} lies at the origin: its velocity turns about that"))),
        false => Ok(()),
    }
}

/// Errors: a velocity or a turbulence outside its range.
fn check_wind(wind: &WindKeys, dimensions: usize) -> Result<(), Fault> {
    number::vector(&wind.velocity, dimensions).at("velocity")?;
    Range::NotNegative.maybe(wind.turbulence).at("turbulence")
}

/// Errors: the first force on no point, on one that is not there, that pushes nothing, or with a torque that has nothing to turn.
pub(in crate::scene) fn check_forces(forces: &[ForceKeys], count: u32, dimensions: usize) -> Result<(), Fault> {
    for (i, force) in forces.iter().enumerate() {
        check_force(force, count, dimensions).item(i).at("forces")?;
    }
    Ok(())
}

fn check_force(keys: &ForceKeys, count: u32, dimensions: usize) -> Result<(), Fault> {
    number::indices(&keys.points, count).at("points")?;
    let Some(first) = keys.points.first() else {
        return Err(Fault::invalid("names no point: give one or more").at("points"));
    };
    if let Some(force) = &keys.force {
        number::vector(force, dimensions).at("force")?;
    }
    let Some(torque) = keys.torque else {
        let is_said = keys.force.is_some();
        return if is_said { Ok(()) } else { Err(Fault::invalid("pushes nothing: give `force` or `torque`")) };
    };
    Range::Finite.check(torque).at("torque")?;
    if dimensions == 3 {
        return Err(Fault::invalid("turns in the plane: leave it out in space").at("torque"));
    }
    if torque != 0.0 && keys.points.iter().all(|point| point == first) {
        return Err(Fault::invalid("turns nothing, for there is one point: give two or more").at("torque"));
    }
    Ok(())
}

fn check_mouse(mouse: &MouseKeys, dimensions: usize) -> Result<(), Fault> {
    Range::Finite.check(mouse.strength).at("strength")?;
    Range::Positive.check(mouse.radius).at("radius")?;
    if dimensions == 3 && mouse.region == Some(RegionName::Square) {
        let message = "\"square\" is for the plane: in space use \"round\"";
        return Err(Fault::invalid(message).at("region"));
    }
    number::track(mouse.track.iter().map(|knot| &knot.0[..])).at("track")
}

pub(in crate::scene) fn check_pin_motion(
    motion: &PinMotionKeys,
    dimensions: usize,
    is_pinned: &dyn Fn(u32) -> bool,
) -> Result<(), Fault> {
    if !is_pinned(motion.point) {
        let message = format!("point {} is not pinned: add it to `pinned`, or give a pinned one", motion.point);
        return Err(Fault::invalid(message).at("point"));
    }
    if motion.track.is_empty() {
        return Err(Fault::invalid("has no knots: give at least one").at("track"));
    }
    for (i, knot) in motion.track.iter().enumerate() {
        if knot.len() != dimensions + 1 {
            let form = ["[t, x, y]", "[t, x, y, z]"][dimensions - 2];
            let message = format!("has {} numbers: a knot is {form}", knot.len());
            return Err(Fault::invalid(message).item(i).at("track"));
        }
    }
    number::track(motion.track.iter().map(|knot| &knot[..])).at("track")
}

fn check_surface(restitution: Option<f64>, friction: Option<f64>) -> Result<(), Fault> {
    Range::NotNegative.maybe(restitution).at("restitution")?;
    Range::NotNegative.maybe(friction).at("friction")
}

fn check_obstacle(obstacle: &ObstacleKeys, dimensions: usize, source: &Source) -> Result<(), Fault> {
    const SHAPES: [&str; 5] = ["plane", "box", "circle", "polygon", "picture"];
    let shapes: Vec<&str> = obstacle.given().filter(|key| SHAPES.contains(key)).collect();
    match shapes[..] {
        [_] => {}
        [] => {
            let list = nearest::list(if dimensions == 3 { &SHAPES[..3] } else { &SHAPES });
            return Err(Fault::invalid(format!("has no shape: give {list}")));
        }
        [first, second, ..] => {
            let message = format!("stands beside `{first}`: an obstacle has one shape, so make it two");
            return Err(Fault::invalid(message).at(second));
        }
    }
    check_surface(obstacle.restitution, obstacle.friction)?;
    check_penalty(obstacle)?;
    if let Some(plane) = &obstacle.plane {
        number::vector(&plane.point, dimensions).at("point").at("plane")?;
        number::direction(&plane.normal, dimensions).at("normal").at("plane")?;
    }
    if let Some(keys) = &obstacle.r#box {
        check_box(keys, dimensions).at("box")?;
    }
    if let Some(circle) = &obstacle.circle {
        number::vector(&circle.center, dimensions).at("center").at("circle")?;
        Range::Positive.check(circle.radius).at("radius").at("circle")?;
    }
    if let Some(loops) = &obstacle.polygon {
        check_polygon(loops, dimensions).at("polygon")?;
    }
    match &obstacle.picture {
        Some(_) if dimensions == 3 => {
            Err(Fault::invalid("lies in the plane: in space use `plane`, `box` or `circle`").at("picture"))
        }
        Some(keys) => check_picture(keys, source).at("picture"),
        None => Ok(()),
    }
}

fn check_penalty(obstacle: &ObstacleKeys) -> Result<(), Fault> {
    let Some(penalty) = &obstacle.penalty else { return Ok(()) };
    if obstacle.plane.is_none() {
        return Err(Fault::unsupported("is of planes alone in this version: leave it out").at("penalty"));
    }
    if obstacle.restitution.is_some() || obstacle.friction.is_some() {
        let message = "takes the place of contact, restitution and friction: leave it or these out";
        return Err(Fault::invalid(message).at("penalty"));
    }
    Range::NotNegative.check(penalty.stiffness).at("stiffness").at("penalty")?;
    Range::NotNegative.maybe(penalty.damping).at("damping").at("penalty")
}

fn check_picture(keys: &PictureKeys, source: &Source) -> Result<(), Fault> {
    if let Some(origin) = &keys.origin {
        number::vector(origin, 2).at("origin")?;
    }
    Range::Finite.maybe(keys.angle).at("angle")?;
    obstacle::outlines(keys, source).map(|_| ())
}

fn check_box(keys: &BoxKeys, dimensions: usize) -> Result<(), Fault> {
    number::corners(&keys.min, &keys.max, dimensions)?;
    Range::Finite.maybe(keys.angle).at("angle")?;
    match (dimensions, keys.angle, &keys.rotation) {
        (3, Some(_), _) => Err(Fault::invalid("turns a box in the plane: in space give `rotation`").at("angle")),
        (2, _, Some(_)) => Err(Fault::invalid("turns a box in space: in the plane give `angle`").at("rotation")),
        (_, _, Some(rotation)) => {
            number::direction(&rotation.axis, dimensions).at("axis").at("rotation")?;
            Range::Finite.check(rotation.angle).at("angle").at("rotation")
        }
        _ => Ok(()),
    }
}

fn check_polygon(loops: &[Vec<Vector>], dimensions: usize) -> Result<(), Fault> {
    if dimensions == 3 {
        let message = "lies in the plane: in space use `plane`, `box` or `circle`";
        return Err(Fault::invalid(message));
    }
    if loops.is_empty() {
        return Err(Fault::invalid("has no outline: give a list of corners"));
    }
    for (i, corners) in loops.iter().enumerate() {
        if corners.len() < 3 {
            let message = format!("has {} corners: give 3 or more", corners.len());
            return Err(Fault::invalid(message).item(i));
        }
        for (k, corner) in corners.iter().enumerate() {
            number::vector(corner, dimensions).item(k).item(i)?;
        }
        if lies_on_a_line(corners) {
            return Err(Fault::invalid("encloses nothing, for its corners lie on a line: move one of them").item(i));
        }
    }
    Ok(())
}

/// Whether no corner lies further from the line through the first and the one furthest from it than rounding puts it.
fn lies_on_a_line(corners: &[Vector]) -> bool {
    let flat = |corner: &Vector| truncate::<2>(corner.embed());
    let from_first: Vec<[f64; 2]> = corners.iter().map(|corner| sub(flat(corner), flat(&corners[0]))).collect();
    let size = |x: [f64; 2]| x[0].hypot(x[1]);
    let Some(&way) = from_first.iter().max_by(|a, b| size(**a).total_cmp(&size(**b))) else { return true };
    let reach = corners.iter().map(|corner| size(flat(corner))).fold(size(way), f64::max);
    from_first.iter().all(|&x| cross(way, x).abs() <= 1e-15 * size(way) * reach)
}
