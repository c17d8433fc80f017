//! Obstacles that are polygons: given as such, boxes and circles in the plane, and the ink of pictures; balls and boxes in space.

use super::check;
use super::error::{Fault, Source, Within};
use super::keys::{BodyKeys, BoxKeys, CircleKeys, MakerName, ObstacleKeys, PictureKeys, Scene, StrokesName, Vector};
use super::pictures::Loops;
use crate::body::{in_metres, turned};
use crate::sim::vector::{add, scale, sub, truncate};
use crate::sim::{Convex, Figure, Polygon};

/// Corners of a circle in the plane: its sides lie within 2e-6 of its radius, and a bead that slides off its top leaves it where
/// it would leave a circle, to 1e-4 (with 512 of them to 4e-3).
const SIDES: u32 = 2048;

/// The polygons among a scene's obstacles.
///
/// Errors: those of [`outlines`].
pub(super) fn polygons(scene: &Scene) -> Result<Vec<Polygon>, Fault> {
    let mut list = Vec::new();
    if scene.dimensions() == 3 {
        return Ok(list);
    }
    for (i, keys) in scene.obstacles.iter().enumerate() {
        if let Some(loops) = loops(keys, &scene.source).item(i).at("obstacles")? {
            let (restitution, friction) = (keys.restitution.unwrap_or(0.0), keys.friction.unwrap_or(0.0));
            list.push(Polygon { loops, restitution, friction });
        }
    }
    Ok(list)
}

/// The balls and boxes among a scene's obstacles, in space.
pub(super) fn convex(scene: &Scene) -> Vec<Convex> {
    if scene.dimensions() != 3 {
        return Vec::new();
    }
    let of = |keys: &ObstacleKeys| {
        let (restitution, friction) = (keys.restitution.unwrap_or(0.0), keys.friction.unwrap_or(0.0));
        figure(keys).map(|figure| Convex { figure, restitution, friction })
    };
    scene.obstacles.iter().filter_map(of).collect()
}

fn figure(keys: &ObstacleKeys) -> Option<Figure> {
    if let Some(CircleKeys { center, radius }) = &keys.circle {
        return Some(Figure::Ball { center: center.embed(), radius: *radius });
    }
    let keys = keys.r#box.as_ref()?;
    let (axis, angle) = match &keys.rotation {
        Some(rotation) => (rotation.axis.embed(), rotation.angle),
        None => ([0.0, 0.0, 1.0], 0.0),
    };
    Some(Figure::Box { min: keys.min.embed(), max: keys.max.embed(), axis, angle })
}

/// The corners of an obstacle in the plane; `None` of planes.
fn loops(keys: &ObstacleKeys, source: &Source) -> Result<Option<Loops>, Fault> {
    let corners = |outline: &Vec<Vector>| outline.iter().map(|corner| truncate(corner.embed())).collect();
    if let Some(polygon) = &keys.polygon {
        return Ok(Some(polygon.iter().map(corners).collect()));
    }
    if let Some(keys) = &keys.picture {
        return outlines(keys, source).at("picture").map(Some);
    }
    if let Some(keys) = &keys.circle {
        return Ok(Some(vec![round(keys)]));
    }
    Ok(keys.r#box.as_ref().map(|keys| vec![rectangle(keys)]))
}

/// The corners of a circle in the plane, which all lie on it.
fn round(keys: &CircleKeys) -> Vec<[f64; 2]> {
    let center: [f64; 2] = truncate(keys.center.embed());
    let corner = |k: u32| {
        let angle = std::f64::consts::TAU / f64::from(SIDES) * f64::from(k);
        add(center, turned([keys.radius, 0.0], angle))
    };
    (0..SIDES).map(corner).collect()
}

/// The corners of a box in the plane, which is turned about its centre.
fn rectangle(keys: &BoxKeys) -> Vec<[f64; 2]> {
    let [low, high]: [[f64; 2]; 2] = [keys.min, keys.max].map(|corner| truncate(corner.embed()));
    let centre = scale(add(low, high), 0.5);
    let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
    let angle = keys.angle.unwrap_or(0.0);
    corners.map(|x| add(turned(sub(x, centre), angle), centre)).to_vec()
}

/// The outlines of a picture's ink, where they lie.
///
/// Errors: no such file, no picture; a number out of its range; no ink.
pub(super) fn outlines(keys: &PictureKeys, source: &Source) -> Result<Loops, Fault> {
    let as_body = BodyKeys {
        make: MakerName::Picture,
        file: Some(keys.file.clone()),
        height: keys.height,
        spacing: keys.spacing,
        threshold: keys.threshold,
        invert: keys.invert,
        whole: keys.whole,
        min_area: keys.min_area,
        blur: keys.blur,
        holes: keys.holes,
        strokes: Some(StrokesName::Mesh),
        ..BodyKeys::default()
    };
    check::check_cut(&as_body)?;
    let picture = source.picture(&keys.file).at("file")?;
    let (height, settings) = check::wanted(&as_body, &picture)?;
    let origin = keys.origin.map_or([0.0; 2], |origin| truncate(origin.embed()));
    let to_metres = in_metres([picture.width, picture.height], height);
    let angle = keys.angle.unwrap_or(0.0);
    let place = |&pixel: &[f64; 2]| add(turned(to_metres(pixel), angle), origin);
    let traced = source.traced(&keys.file, &settings).at("file")?;
    Ok(traced.iter().map(|corners| corners.iter().map(place).collect()).collect())
}

impl Scene {
    /// Obstacles that are boxes or pictures become polygons, corner by corner: in the plane. Circles stay what they are.
    ///
    /// Errors: those of [`outlines`].
    pub(super) fn with_polygons(&mut self) -> Result<(), Fault> {
        if self.dimensions() == 3 {
            return Ok(());
        }
        for i in 0..self.obstacles.len() {
            let keys = &self.obstacles[i];
            if keys.polygon.is_some() || keys.circle.is_some() {
                continue;
            }
            if let Some(loops) = loops(keys, &self.source).item(i).at("obstacles")? {
                let polygon = loops.into_iter().map(|corners| corners.into_iter().map(Vector::Plane).collect());
                self.obstacles[i] = ObstacleKeys {
                    polygon: Some(polygon.collect()),
                    restitution: keys.restitution,
                    friction: keys.friction,
                    ..ObstacleKeys::default()
                };
            }
        }
        Ok(())
    }
}

impl PictureKeys {
    /// The keys that trace a picture as a body of it would be cut out; its file is still to be said.
    pub fn of_body(keys: &BodyKeys) -> Self {
        PictureKeys {
            file: String::new(),
            origin: keys.origin,
            angle: keys.angle,
            height: keys.height,
            spacing: keys.spacing,
            threshold: keys.threshold,
            invert: keys.invert,
            whole: keys.whole,
            min_area: keys.min_area,
            blur: keys.blur,
            holes: keys.holes,
        }
    }
}
