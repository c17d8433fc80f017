//! The keys of a scene beside its points and bonds: ranges, and what this version does not have.

use super::content::exists;
use super::error::Problem;
use super::file::{MouseFile, ObstacleFile, RegionFile, SceneFile, ViewFile};
use super::material::{above_zero, at_least_zero};
use super::method;
use super::numbers::Vector;

/// Checks every key that [`super::content::Content::of`] does not. `points` is the number of points.
pub(crate) fn check(file: &SceneFile, points: usize) -> Result<(), Problem> {
    forces(file)?;
    walls(file)?;
    pins(file, points)?;
    surfaces(file, points)?;
    times(file)?;
    method::check(&file.method).map_err(|problem| problem.within("method"))?;
    view(file).map_err(|problem| problem.within("view"))?;
    refuse_what_is_missing(file)
}

fn dimensions(file: &SceneFile) -> usize {
    file.dimensions as usize
}

fn forces(file: &SceneFile) -> Result<(), Problem> {
    vector(file, "gravity", file.gravity.as_ref())?;
    at_least_zero("drag_rate", file.drag_rate)?;
    if let Some(wind) = &file.wind {
        vector(file, "wind.velocity", Some(&wind.velocity))?;
        at_least_zero("wind.turbulence", wind.turbulence)?;
    }
    match &file.mouse {
        Some(mouse) => self::mouse(mouse, dimensions(file)).map_err(|problem| problem.within("mouse")),
        None => Ok(()),
    }
}

fn mouse(mouse: &MouseFile, dimensions: usize) -> Result<(), Problem> {
    if !mouse.strength.is_finite() {
        return Err(Problem::new("strength", "is not finite"));
    }
    above_zero("radius", mouse.radius)?;
    if dimensions == 3 && mouse.region == RegionFile::Square {
        return Err(Problem::new("region", "a scene in space has no square region: use \"round\""));
    }
    let knots = mouse.track.iter().map(|knot| &knot[..]);
    track("track", knots, 3)
}

/// A track: finite numbers, times that ascend.
fn track<'a>(key: &str, knots: impl Iterator<Item = &'a [f64]>, width: usize) -> Result<(), Problem> {
    let mut last = f64::NEG_INFINITY;
    for (i, knot) in knots.enumerate() {
        let at = format!("{key}[{i}]");
        if knot.len() != width {
            return Err(Problem::new(at, format!("has {} numbers: a knot has {width}, the time first", knot.len())));
        }
        if !knot.iter().all(|value| value.is_finite()) {
            return Err(Problem::new(at, "has a number that is not finite"));
        }
        if knot[0] <= last {
            return Err(Problem::new(at, format!("time {} is not after {last}: list knots in order", knot[0])));
        }
        last = knot[0];
    }
    Ok(())
}

fn walls(file: &SceneFile) -> Result<(), Problem> {
    if let Some(bounds) = &file.bounds {
        corners(file, "bounds", &bounds.min, &bounds.max)?;
        at_least_zero("bounds.restitution", bounds.restitution)?;
        at_least_zero("bounds.friction", bounds.friction)?;
    }
    for (i, obstacle) in file.obstacles.iter().enumerate() {
        shape(file, obstacle).map_err(|problem| problem.within(format_args!("obstacles[{i}]")))?;
    }
    Ok(())
}

/// Two corners of a box, `min` below `max` on every axis.
fn corners(file: &SceneFile, key: &str, min: &Vector, max: &Vector) -> Result<(), Problem> {
    let low = vector(file, &format!("{key}.min"), Some(min))?;
    let high = vector(file, &format!("{key}.max"), Some(max))?;
    match (0..dimensions(file)).find(|&k| low[k] >= high[k]) {
        Some(k) => {
            let axis = ["x", "y", "z"][k];
            let problem = format!("{axis} is {}, not below max's {}: give the lower corner", low[k], high[k]);
            Err(Problem::new(format!("{key}.min"), problem))
        }
        None => Ok(()),
    }
}

fn shape(file: &SceneFile, obstacle: &ObstacleFile) -> Result<(), Problem> {
    at_least_zero("restitution", obstacle.restitution)?;
    at_least_zero("friction", obstacle.friction)?;
    let ObstacleFile { plane, block, circle, polygon, .. } = obstacle;
    match (plane, block, circle, polygon) {
        (Some(plane), None, None, None) => {
            vector(file, "plane.point", Some(&plane.point))?;
            if vector(file, "plane.normal", Some(&plane.normal))? == [0.0; 3] {
                return Err(Problem::new("plane.normal", "has no direction: give a vector that is not zero"));
            }
            Ok(())
        }
        (None, Some(block), None, None) => {
            corners(file, "box", &block.min, &block.max)?;
            match (block.angle.is_some(), block.rotation.is_some(), dimensions(file)) {
                (true, _, 3) => Err(Problem::new("box.angle", "belongs to the plane: use `rotation`")),
                (_, true, 2) => Err(Problem::new("box.rotation", "belongs to space: use `angle`")),
                _ => Ok(()),
            }
        }
        (None, None, Some(circle), None) => {
            vector(file, "circle.center", Some(&circle.center))?;
            above_zero("circle.radius", circle.radius)
        }
        (None, None, None, Some(polygon)) => {
            if dimensions(file) == 3 {
                return Err(Problem::new(
                    "polygon",
                    "belongs to the plane: a scene in space has plane, box and circle",
                ));
            }
            match polygon.iter().position(|ring| ring.len() < 3) {
                Some(ring) => Err(Problem::new(format!("polygon[{ring}]"), "is no ring: give three corners or more")),
                None => Ok(()),
            }
        }
        _ => Err(Problem::new("", "an obstacle is exactly one of plane, box, circle and polygon")),
    }
}

fn pins(file: &SceneFile, points: usize) -> Result<(), Problem> {
    for (i, motion) in file.pin_motion.iter().enumerate() {
        let check = || {
            exists("point", motion.point, points)?;
            track("track", motion.track.iter().map(Vec::as_slice), dimensions(file) + 1)
        };
        check().map_err(|problem: Problem| problem.within(format_args!("pin_motion[{i}]")))?;
    }
    Ok(())
}

fn surfaces(file: &SceneFile, points: usize) -> Result<(), Problem> {
    for (i, triangle) in file.triangles.iter().enumerate() {
        for (k, &corner) in triangle.iter().enumerate() {
            exists(&format!("triangles[{i}][{k}]"), corner, points)?;
        }
    }
    if let Some(texture) = &file.texture
        && texture.uv.len() != points
    {
        let problem = format!("has {} entries for {points} points: give one a point", texture.uv.len());
        return Err(Problem::new("texture.uv", problem));
    }
    Ok(())
}

fn times(file: &SceneFile) -> Result<(), Problem> {
    above_zero("rate", file.rate)?;
    if let Some(duration) = file.duration {
        at_least_zero("duration", duration)?;
    }
    let mut last = 0.0;
    for (i, &time) in file.samples.iter().flatten().enumerate() {
        let at = format!("samples[{i}]");
        at_least_zero(&at, time)?;
        if time < last {
            return Err(Problem::new(at, format!("{time} comes before {last}: list times in order")));
        }
        if let Some(duration) = file.duration.filter(|&duration| time > duration) {
            return Err(Problem::new(at, format!("{time} is after the duration, {duration}: sample earlier")));
        }
        last = time;
    }
    Ok(())
}

fn view(file: &SceneFile) -> Result<(), Problem> {
    let Some(ViewFile { center, height, target, distance, yaw, pitch }) = &file.view else { return Ok(()) };
    let plane = [("center", center.is_some()), ("height", height.is_some())];
    let space = [
        ("target", target.is_some()),
        ("distance", distance.is_some()),
        ("yaw", yaw.is_some()),
        ("pitch", pitch.is_some()),
    ];
    let foreign = if dimensions(file) == 2 { &space[..] } else { &plane[..] };
    if let Some((key, _)) = foreign.iter().find(|(_, given)| *given) {
        let home = if dimensions(file) == 2 {
            "space: use center and height"
        } else {
            "the plane: use target, distance, yaw and pitch"
        };
        return Err(Problem::new(*key, format!("belongs to {home}")));
    }
    for (key, value) in [("height", height), ("distance", distance)] {
        if let Some(value) = value {
            above_zero(key, *value)?;
        }
    }
    let angles = [yaw, pitch].into_iter().flatten();
    let finite = center.iter().flatten().chain(target.iter().flatten()).chain(angles).all(|value| value.is_finite());
    if finite { Ok(()) } else { Err(Problem::new("", "has a number that is not finite")) }
}

fn vector(file: &SceneFile, key: &str, vector: Option<&Vector>) -> Result<[f64; 3], Problem> {
    match vector {
        Some(vector) => vector.components(dimensions(file)).map_err(|problem| problem.within(key)),
        None => Ok([0.0; 3]),
    }
}

/// What the format has and the engine hasn't: refused by name, never ignored.
fn refuse_what_is_missing(file: &SceneFile) -> Result<(), Problem> {
    let missing = [
        ("obstacles", !file.obstacles.is_empty()),
        ("wind", file.wind.is_some()),
        ("areas", file.areas.is_some()),
        ("triangles", !file.triangles.is_empty()),
        ("texture", file.texture.is_some()),
        ("pin_motion", !file.pin_motion.is_empty()),
        ("method.tolerance", file.method.tolerance.is_some()),
        ("method.max_strain", file.method.max_strain.is_some()),
    ];
    match missing.into_iter().find(|(_, given)| *given) {
        Some((key, _)) => Err(Problem::new(key, "is not in this version: leave it out")),
        None => Ok(()),
    }
}
