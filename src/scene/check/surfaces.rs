//! Triangles, and what hangs on them: areas, contact and a texture.

use std::path::Path;

use super::number::{self, Range};
use super::one_a_point;
use crate::picture::HUES;
use crate::scene::error::{Fault, Source, Within};
use crate::scene::keys::{
    AngleKeys, AreaKeys, AreaKindName, ContactKeys, LookKeys, Meeting, PointGroupKeys, Row, Scene, SkinKeys,
    TextureKeys,
};
use crate::sim::AngleDrive;
use crate::sim::Areas;

/// Errors: the first fault; `count` is how many points there are.
pub(super) fn check(scene: &Scene, count: u32, dimensions: usize) -> Result<(), Fault> {
    check_triangles(&scene.triangles, count)?;
    check_skins(&scene.skins, count)?;
    if let Some(areas) = &scene.areas {
        let meets = scene.contact.and_then(Meeting::resolve).is_some();
        check_areas(areas, dimensions, meets).at("areas")?;
    }
    check_angles(&scene.angles, count, dimensions)?;
    check_groups(&scene.groups, count)?;
    if let Some(Meeting::As(contact)) = &scene.contact {
        check_contact(contact).at("contact")?;
    }
    match &scene.texture {
        Some(texture) => check_texture(texture, count).at("texture"),
        None => Ok(()),
    }
}

/// Errors: the first triangle with a corner that is not there, or one that stands there twice.
pub(in crate::scene) fn check_triangles(triangles: &[Row<u32, 3>], count: u32) -> Result<(), Fault> {
    for (i, triangle) in triangles.iter().enumerate() {
        check_triangle(triangle.0, count).item(i).at("triangles")?;
    }
    Ok(())
}

fn check_triangle(corners: [u32; 3], count: u32) -> Result<(), Fault> {
    for (k, &point) in corners.iter().enumerate() {
        number::index(point, count).item(k)?;
    }
    let [a, b, c] = corners;
    if a == b || b == c || c == a {
        return Err(Fault::invalid("names a point twice: give three points"));
    }
    Ok(())
}

fn check_contact(contact: &ContactKeys) -> Result<(), Fault> {
    check_skin([contact.friction, contact.restitution, contact.radius])
}

/// Errors: friction, restitution or radius outside its range.
pub(super) fn check_skin([friction, restitution, radius]: [Option<f64>; 3]) -> Result<(), Fault> {
    Range::NotNegative.maybe(friction).at("friction")?;
    Range::Fraction.maybe(restitution).at("restitution")?;
    Range::NotNegative.maybe(radius).at("radius")
}

/// Errors: the first skin with a point that is not there, or a number outside its range.
pub(in crate::scene) fn check_skins(skins: &[SkinKeys], count: u32) -> Result<(), Fault> {
    for (i, skin) in skins.iter().enumerate() {
        let SkinKeys { points, friction, restitution, radius, layered: _, color: _, width, visible: _ } = skin;
        number::indices(points, count).at("points").item(i).at("skins")?;
        check_skin([*friction, *restitution, *radius]).item(i).at("skins")?;
        Range::NotNegative.maybe(*width).at("width").item(i).at("skins")?;
    }
    Ok(())
}

/// Errors: the first look with a point that is none of the new ones, or a hue that is none.
pub(in crate::scene) fn check_looks(looks: &[LookKeys], new: std::ops::Range<u32>) -> Result<(), Fault> {
    for (i, LookKeys { points, title: _, hue }) in looks.iter().enumerate() {
        if let Some(other) = points.iter().find(|point| !new.contains(point)) {
            let message = format!("names point {other}, which does not come with it: name new points");
            return Err(Fault::invalid(message).at("points").item(i).at("looks"));
        }
        if let Some(other) = hue.filter(|hue| *hue >= HUES) {
            let message = format!("is {other}, and there are {HUES}: give one from 0 to {}", HUES - 1);
            return Err(Fault::invalid(message).at("hue").item(i).at("looks"));
        }
    }
    Ok(())
}

/// Errors: the first group of less than two points, with one that is not there, or with a title that is empty or another's.
fn check_groups(groups: &[PointGroupKeys], count: u32) -> Result<(), Fault> {
    for (i, PointGroupKeys { points, title }) in groups.iter().enumerate() {
        number::indices(points, count).at("points").item(i).at("groups")?;
        if points.iter().all(|point| *point == points[0]) {
            let message = "names less than two points: a group is made of two or more, or leave it out";
            return Err(Fault::invalid(message).at("points").item(i).at("groups"));
        }
        let Some(title) = title else { continue };
        if title.trim().is_empty() {
            return Err(Fault::invalid("is empty: give a few words, or leave it out").at("title").item(i).at("groups"));
        }
        if groups[..i].iter().any(|other| other.title.as_ref() == Some(title)) {
            let message = format!("is `{title}`, as another group's: give each a title of its own");
            return Err(Fault::invalid(message).at("title").item(i).at("groups"));
        }
    }
    Ok(())
}

impl AreaKeys {
    /// What a command that sets areas says, in the engine's words.
    ///
    /// Errors: as of a scene with these keys whose bodies may meet.
    pub(crate) fn told(self, dimensions: usize) -> Result<Areas, String> {
        let checked = check_areas(&self, dimensions, true).at("areas");
        checked.map_err(|fault| Source::default().error(fault).to_string()).map(|()| self.resolve())
    }
}

fn check_areas(areas: &AreaKeys, dimensions: usize, meets: bool) -> Result<(), Fault> {
    if dimensions == 3 {
        return Err(Fault::invalid("act in the plane only: leave them out in space"));
    }
    Range::NotNegative.maybe(areas.stiffness).at("stiffness")?;
    if let Some(least) = areas.least {
        if !(0.0..1.0).contains(&least) {
            return Err(Fault::invalid(format!("is {least:?}: give a number from 0 to below 1")).at("least"));
        }
        if !meets {
            let message = "is of bodies that meet, and these do not: leave it out or set \"contact\": true";
            return Err(Fault::invalid(message).at("least"));
        }
    }
    match (areas.kind, areas.stiffness) {
        (Some(AreaKindName::Spring), None) => Err(Fault::invalid("areas of kind spring need `stiffness`: add it")),
        (None, None) if areas.least.is_none() => {
            Err(Fault::invalid("say nothing: give `kind`, `stiffness` or, with `contact`, `least`"))
        }
        (Some(AreaKindName::Rigid), Some(_)) => {
            let message = "is a key of areas of kind spring, and these are rigid: leave it out";
            Err(Fault::invalid(message).at("stiffness"))
        }
        _ => Ok(()),
    }
}

/// Errors: the first angle that is none; `count` is how many points there are.
pub(in crate::scene) fn check_angles(angles: &[AngleKeys], count: u32, dimensions: usize) -> Result<(), Fault> {
    if dimensions == 3 && !angles.is_empty() {
        return Err(Fault::invalid("act in the plane only: leave them out in space").at("angles"));
    }
    for (i, angle) in angles.iter().enumerate() {
        check_angle(angle, count).item(i).at("angles")?;
    }
    Ok(())
}

fn check_angle(angle: &AngleKeys, count: u32) -> Result<(), Fault> {
    const TURN: f64 = 2.0 * std::f64::consts::PI;
    check_triangle(angle.points.0, count).at("points")?;
    if let Some(rest) = angle.rest
        && !(rest > 0.0 && rest < TURN)
    {
        return Err(Fault::invalid(format!("is {rest:?}: give an angle between 0 and 2 pi")).at("rest"));
    }
    Range::NotNegative.maybe(angle.stiffness).at("stiffness")?;
    Range::NotNegative.maybe(angle.damping).at("damping")?;
    Range::Finite.maybe(angle.min).at("min")?;
    Range::Finite.maybe(angle.max).at("max")?;
    if let Some(drive) = &angle.drive {
        let drive = drive.of_angle().at("drive")?;
        let is_servo = matches!(drive, AngleDrive::Servo { .. });
        if is_servo && angle.stiffness.unwrap_or(0.0) == 0.0 {
            let message = "nothing pulls the angle to it: give the angle a `stiffness` [N m] above 0";
            return Err(Fault::invalid(message).at("drive"));
        }
    }
    match (angle.min, angle.max) {
        (Some(min), Some(max)) if min >= max => {
            Err(Fault::invalid(format!("{min:?} is not below {max:?} of `max`: give min < max")).at("min"))
        }
        (Some(min), Some(max)) if max - min >= TURN => {
            let message = format!("{max:?} is a turn or more above {min:?} of `min`: give less, or leave both out");
            Err(Fault::invalid(message).at("max"))
        }
        (Some(_), None) => Err(Fault::invalid("stands without `max`: a joint has both: add it").at("min")),
        (None, Some(_)) => Err(Fault::invalid("stands without `min`: a joint has both: add it").at("max")),
        _ => Ok(()),
    }
}

fn check_texture(texture: &TextureKeys, count: u32) -> Result<(), Fault> {
    check_image(&texture.image).at("image")?;
    one_a_point(texture.uv.len(), count).at("uv")?;
    for (i, uv) in texture.uv.iter().enumerate() {
        for (k, &x) in uv.0.iter().enumerate() {
            Range::Finite.check(x).item(k).item(i).at("uv")?;
        }
    }
    Ok(())
}

/// Errors: what cannot be a picture's name.
pub(in crate::scene) fn check_image(image: &str) -> Result<(), Fault> {
    // A letter, a colon and a slash begin a path of Windows; without the slash it may be any file's name.
    let drive = matches!(image.as_bytes(), [letter, b':', b'/' | b'\\', ..] if letter.is_ascii_alphabetic());
    let absolute = drive || Path::new(image).has_root();
    let foreign = image.starts_with("data:image/") && !image.starts_with("data:image/png;base64,");
    if image.is_empty() || absolute || foreign {
        return Err(Fault::invalid("is no image: give a path relative to the scene, or data:image/png;base64,…"));
    }
    Ok(())
}
