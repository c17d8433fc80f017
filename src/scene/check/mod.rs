//! Holds a scene to what the specification says of its keys: ranges, lengths, indices, and what excludes what.

mod beside;
mod body;
mod bond;
mod cutout;
mod labels;
mod number;
mod repeat;
mod surfaces;
mod surroundings;

use super::error::{Fault, Within};
use super::keys::{BodyKeys, BudgetKeys, MassKeys, MethodKeys, PointKeys, Scene, ViewKeys};
use crate::sim::{MOST_ITERATIONS, entries_for};
use number::Range;

pub(crate) use beside::MOST_BESIDE;
pub(super) use body::maker;
pub(super) use bond::Resistance;
pub(super) use bond::check_all as check_bonds;
pub(super) use cutout::{check_cut, cutout, skin, wanted};
pub(super) use repeat::{copies, offsets};
pub(super) use surfaces::{check_angles, check_image, check_looks, check_skins, check_triangles};
pub(super) use surroundings::{check_forces, check_pin_motion};

/// Refuses what the specification excludes, whether this version could run it or not.
///
/// Errors: the first fault, in the order of the specification.
pub(super) fn check(scene: &Scene) -> Result<(), Fault> {
    let dimensions = dimensions(scene)?;
    let explicit = match &scene.points {
        Some(points) => check_points(points, dimensions).at("points")?,
        None => 0,
    };
    let count = count_points(scene, explicit, dimensions)?;
    bond::check_all(&scene.bonds, count).at("bonds")?;
    surfaces::check(scene, count, dimensions)?;
    surroundings::check(scene, (count, dimensions), &|point| is_pinned(scene, explicit, point))?;
    check_method(&scene.method).at("method")?;
    beside::check(scene).at("beside")?;
    check_times(scene)?;
    super::parameter::check(scene, dimensions)?;
    labels::check(&scene.labels, count, dimensions).at("labels")?;
    match &scene.view {
        Some(view) => check_view(view, count, dimensions).at("view"),
        None => Ok(()),
    }
}

fn dimensions(scene: &Scene) -> Result<usize, Fault> {
    match scene.dimensions {
        None | Some(2) => Ok(2),
        Some(3) => Ok(3),
        Some(other) => Err(Fault::invalid(format!("is {other}: give 2 for the plane or 3 for space")).at("dimensions")),
    }
}

/// How many explicit points there are.
fn check_points(points: &PointKeys, dimensions: usize) -> Result<u32, Fault> {
    let count = u32::try_from(points.position.len())
        .map_err(|_| Fault::invalid("has more points than 32 bits can count").at("position"))?;
    for (i, position) in points.position.iter().enumerate() {
        number::vector(position, dimensions).item(i).at("position")?;
    }
    if let Some(velocities) = &points.velocity {
        one_a_point(velocities.len(), count).at("velocity")?;
        for (i, velocity) in velocities.iter().enumerate() {
            number::vector(velocity, dimensions).item(i).at("velocity")?;
        }
    }
    match &points.mass {
        None => {}
        Some(MassKeys::Same(mass)) => Range::Positive.check(*mass).at("mass")?,
        Some(MassKeys::Each(masses)) => {
            one_a_point(masses.len(), count).at("mass")?;
            for (i, mass) in masses.iter().enumerate() {
                Range::Positive.check(*mass).item(i).at("mass")?;
            }
        }
    }
    for (i, &point) in points.pinned.iter().enumerate() {
        number::index(point, count).item(i).at("pinned")?;
    }
    Ok(count)
}

/// Errors: a list that should have an entry a point has another length.
fn one_a_point(found: usize, count: u32) -> Result<(), Fault> {
    if found == count as usize {
        Ok(())
    } else {
        Err(Fault::invalid(format!("has {}: give one a point", entries_for(found, count as usize))))
    }
}

/// Checks the bodies; all points of the scene.
fn count_points(scene: &Scene, explicit: u32, dimensions: usize) -> Result<u32, Fault> {
    let mut total = explicit;
    for (i, keys) in scene.bodies.iter().enumerate() {
        let count = body::check(keys, dimensions, &scene.source).item(i).at("bodies")?;
        total = total
            .checked_add(count)
            .filter(|&total| u64::from(total.saturating_sub(explicit)) <= crate::body::MAX_POINTS)
            .ok_or_else(|| {
                let most = crate::body::MAX_POINTS;
                let message = format!("the bodies have more than {most} points: make less of them");
                Fault::invalid(message).item(i).at("bodies")
            })?;
    }
    Ok(total)
}

/// How many points a body that was checked has, with all its copies.
///
/// Errors: those of its maker.
pub(super) fn count(keys: &BodyKeys, scene: &Scene) -> Result<u32, Fault> {
    Ok(body::point_count(keys, scene.dimensions(), &scene.source)? * copies(keys))
}

/// How many points a body has that was not checked, with all its copies.
///
/// Errors: those of a scene with it.
pub(super) fn count_checked(keys: &BodyKeys, scene: &Scene) -> Result<u32, Fault> {
    body::check(keys, scene.dimensions(), &scene.source)
}

/// Whether a point of the scene is pinned, by its own list or by that of its body. The scene is checked that far.
fn is_pinned(scene: &Scene, explicit: u32, point: u32) -> bool {
    if point < explicit {
        let pinned = scene.points.as_ref().map(|points| &points.pinned);
        return pinned.is_some_and(|pinned| pinned.contains(&point));
    }
    let mut first = explicit;
    for keys in &scene.bodies {
        let each = body::point_count(keys, scene.dimensions(), &scene.source).unwrap_or(0);
        let count = each * copies(keys);
        if point - first < count {
            return keys.pinned.contains(&((point - first) % each));
        }
        first += count;
    }
    false
}

fn check_method(method: &MethodKeys) -> Result<(), Fault> {
    Range::Positive.maybe(method.substep).at("substep")?;
    match method.iterations {
        Some(0) => return Err(Fault::invalid("is 0: give 1 or more").at("iterations")),
        Some(many) if many > MOST_ITERATIONS => {
            return Err(Fault::invalid(format!("is {many}: give {MOST_ITERATIONS} or less")).at("iterations"));
        }
        _ => {}
    }
    Range::Positive.maybe(method.tolerance).at("tolerance")?;
    Range::Positive.maybe(method.max_strain).at("max_strain")?;
    Range::Positive.maybe(method.budget.and_then(BudgetKeys::ms)).at("budget")
}

fn check_times(scene: &Scene) -> Result<(), Fault> {
    Range::Positive.maybe(scene.rate).at("rate")?;
    Range::NotNegative.maybe(scene.duration).at("duration")?;
    let mut last = 0.0;
    for (i, &time) in scene.samples.iter().enumerate() {
        Range::NotNegative.check(time).item(i).at("samples")?;
        if time < last {
            let message = format!("{time:?} comes after {last:?}: sort the times upwards");
            return Err(Fault::invalid(message).item(i).at("samples"));
        }
        last = time;
    }
    Ok(())
}

fn check_view(view: &ViewKeys, count: u32, dimensions: usize) -> Result<(), Fault> {
    let (plane, space) = (["center", "height", "width", "follow"], ["target", "distance", "yaw", "pitch"]);
    let (what, allowed): (_, &[&str]) = if dimensions == 2 { ("the plane", &plane) } else { ("space", &space) };
    if let Some(key) = view.given().find(|key| !allowed.contains(key)) {
        let keys = super::nearest::list(allowed);
        let message = format!("is no key of a view in {what}: its keys are {keys}");
        return Err(Fault::invalid(message).at(key));
    }
    let needed = &allowed[..2];
    let lacks: Vec<&str> = needed.iter().copied().filter(|key| !view.given().any(|k| k == *key)).collect();
    match lacks[..] {
        [] => {}
        [key] => return Err(Fault::invalid(format!("a view in {what} needs `{key}`: add it"))),
        _ => return Err(Fault::invalid(format!("a view in {what} needs `{}`: add them", lacks.join("` and `")))),
    }
    if view.follow.as_ref().is_some_and(Vec::is_empty) {
        return Err(Fault::invalid("has no point: name one, or leave it out").at("follow"));
    }
    for (i, &point) in view.follow.iter().flatten().enumerate() {
        number::index(point, count).item(i).at("follow")?;
    }
    for (key, vector) in [("center", &view.center), ("target", &view.target)] {
        if let Some(vector) = vector {
            number::vector(vector, dimensions).at(key)?;
        }
    }
    Range::Positive.maybe(view.height).at("height")?;
    Range::Positive.maybe(view.width).at("width")?;
    Range::Positive.maybe(view.distance).at("distance")?;
    Range::Finite.maybe(view.yaw).at("yaw")?;
    Range::Finite.maybe(view.pitch).at("pitch")
}
