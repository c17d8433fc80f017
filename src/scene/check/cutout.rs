//! Bodies of pictures: the settings of their mesh, in pixels, from the keys, in metres.

use std::sync::Arc;

use super::body::need;
use super::number::Range;
use super::surfaces::check_image;
use crate::body::{Cutout, Pattern};
use crate::picture::{LEAST_SPACING, Picture, PictureError, Settings, Size, Strokes, Threshold, WIDEST_SPACING};
use crate::scene::error::{Fault, Source, Within};
use crate::scene::keys::{BodyKeys, PatternName, StrokesName};

/// Height of a picture if not said `[m]`.
const HEIGHT: f64 = 2.0;

/// The maker that a body of kind `picture` amounts to.
///
/// Errors: in space; no file, or none that is a picture; a number out of its range; no ink; a part that is not there.
pub(super) fn maker(body: &BodyKeys, dimensions: usize, source: &Source) -> Result<Cutout, Fault> {
    check_cut(body)?;
    if dimensions == 3 {
        return Err(Fault::invalid("`picture` makes a body in the plane: leave it out in space").at("make"));
    }
    cutout(body, source)
}

/// The same of a body whose keys have been checked, in the plane.
///
/// Errors: no file, or none that is a picture; no ink; a part that is not there.
pub(in crate::scene) fn cutout(body: &BodyKeys, source: &Source) -> Result<Cutout, Fault> {
    let file = need(body, "file", body.file.as_deref())?;
    let (height, settings) = wanted(body, &*source.picture(file).at("file")?)?;
    let mesh = match body.part {
        None => source.mesh(file, &settings).at("file")?,
        Some(part) => source.part(file, &settings, part)?,
    };
    let pattern = match body.pattern.unwrap_or(PatternName::Edges) {
        PatternName::Edges => Pattern::Edges,
        PatternName::Braced => Pattern::Braced,
    };
    Ok(Cutout { mesh, height, pattern })
}

/// Errors: a number out of its range; a file that cannot be an image.
pub(in crate::scene) fn check_cut(body: &BodyKeys) -> Result<(), Fault> {
    for (key, value) in [("height", body.height), ("spacing", body.spacing), ("max_area", body.max_area)] {
        Range::Positive.maybe(value).at(key)?;
    }
    Range::Fraction.maybe(body.threshold).at("threshold")?;
    Range::NotNegative.maybe(body.min_area).at("min_area")?;
    body.file.as_deref().map_or(Ok(()), check_image).at("file")
}

/// The height of the picture `[m]` and the settings of its mesh that the keys amount to.
///
/// Errors: keys that exclude each other, or are out of their ranges.
pub(in crate::scene) fn wanted(body: &BodyKeys, picture: &Picture) -> Result<(f64, Settings), Fault> {
    let height = body.height.unwrap_or(HEIGHT);
    let spacing = match body.spacing {
        Some(spacing) => in_pixels(spacing, f64::from(picture.height) / height),
        None => Settings::first_spacing(picture, Threshold::Otsu),
    };
    let settings = settings(body, spacing)?;
    settings.check().map_err(|error| out_of_range(&error, height / f64::from(picture.height)))?;
    Ok((height, settings))
}

/// What is wrong with a setting, at its key and in its unit; a pixel is so long `[m]`.
fn out_of_range(error: &PictureError, pixel: f64) -> Fault {
    match *error {
        PictureError::Setting { name: name @ "spacing", value, .. } => {
            let [spacing, least, most] =
                [value, LEAST_SPACING, WIDEST_SPACING].map(|length| (1e7 * length * pixel).round() / 1e7);
            let message = format!(
                "a spacing of {spacing} m is {value:.4} px of the picture: give one from {least} to {most} m \
                 ({LEAST_SPACING} to {WIDEST_SPACING} px)"
            );
            Fault::invalid(message).at(name)
        }
        PictureError::Setting { name, value, range } => Fault::invalid(format!("is {value}: {range}")).at(name),
        _ => Fault::invalid(error.to_string()),
    }
}

/// What is drawn on the triangles of a body of kind `picture`.
///
/// Errors: no file, or none that is a picture; settings that stand against each other.
pub(in crate::scene) fn skin(body: &BodyKeys, source: &Source) -> Result<Arc<Picture>, Fault> {
    let file = need(body, "file", body.file.as_deref())?;
    let (_, settings) = wanted(body, &*source.picture(file).at("file")?)?;
    source.ink(file, &settings).at("file")
}

/// A spacing `[m]` in pixels. What is beyond the ends of its range by rounding alone lies at them: a spacing that was pixels
/// before it was metres is not refused.
fn in_pixels(spacing: f64, pixels: f64) -> f64 {
    let spacing = spacing * pixels;
    let inside = spacing.clamp(LEAST_SPACING, WIDEST_SPACING);
    if (spacing - inside).abs() <= 1e-12 * inside { inside } else { spacing }
}

/// The settings of the mesh at this spacing `[px]`, if nothing else says how large triangles are.
fn settings(body: &BodyKeys, spacing: f64) -> Result<Settings, Fault> {
    let size = match (body.max_area, body.grading) {
        (Some(_), Some(_)) => {
            let message = "stands beside `max_area`: give one of them";
            return Err(Fault::invalid(message).at("grading"));
        }
        (Some(_), None) if body.spacing.is_some() => {
            let message = "stands beside `spacing`: give one of them";
            return Err(Fault::invalid(message).at("max_area"));
        }
        (Some(area), None) => Size::MaxArea(area),
        (None, Some(ratio)) => Size::Graded { spacing, ratio },
        (None, None) => Size::Spacing(spacing),
    };
    let is_whole = body.whole.unwrap_or(false);
    for (key, is_there) in [("threshold", body.threshold.is_some()), ("invert", body.invert == Some(true))] {
        if is_whole && is_there {
            return Err(Fault::invalid("stands beside `whole`: give one of them").at(key));
        }
    }
    let standard = Settings::default();
    Ok(Settings {
        threshold: if is_whole { Threshold::Whole } else { body.threshold.map_or(Threshold::Otsu, Threshold::At) },
        invert: body.invert.unwrap_or(false),
        blur: body.blur.unwrap_or(0),
        fill_holes: !body.holes.unwrap_or(true),
        min_area: body.min_area.unwrap_or(standard.min_area),
        size,
        strokes: match body.strokes.unwrap_or(StrokesName::Ropes) {
            StrokesName::Ropes => Strokes::Ropes,
            StrokesName::Widen => Strokes::Widen,
            StrokesName::Drop => Strokes::Drop,
            StrokesName::Mesh => Strokes::Mesh,
        },
        ..standard
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_the_range_survive_the_way_to_metres_and_back() {
        for rows in 1..3000 {
            let pixels = f64::from(rows) / 2.0;
            for end in [LEAST_SPACING, WIDEST_SPACING] {
                let back = in_pixels(end * 2.0 / f64::from(rows), pixels);
                assert!((LEAST_SPACING..=WIDEST_SPACING).contains(&back) && (back - end).abs() < 1e-9, "{back}");
            }
        }
        assert!(in_pixels(0.999, 1.0) < LEAST_SPACING && in_pixels(4097.0, 1.0) > WIDEST_SPACING);
    }
}
