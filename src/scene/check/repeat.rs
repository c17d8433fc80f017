//! Copies of a body side by side: how many there are, and where each is.

use super::number::{self, Range};
use crate::body::MAX_POINTS;
use crate::scene::error::{Fault, Within};
use crate::scene::keys::{BodyKeys, RepeatKeys};

/// How many copies a body has: 1 where it is not repeated.
///
/// Errors: a list that is not of the scene's dimensions; a count of 0; a step that is not finite; more points in all
/// copies of `each` than a body may have.
pub(super) fn check(body: &BodyKeys, each: u32, dimensions: usize) -> Result<u32, Fault> {
    match &body.repeat {
        None => Ok(1),
        Some(repeat) => check_keys(repeat, each, dimensions).at("repeat"),
    }
}

fn check_keys(repeat: &RepeatKeys, each: u32, dimensions: usize) -> Result<u32, Fault> {
    if repeat.count.len() != dimensions {
        let form = ["[columns, rows]", "[columns, rows, layers]"][dimensions - 2];
        let message = format!("has {} numbers: it is {form}", repeat.count.len());
        return Err(Fault::invalid(message).at("count"));
    }
    if let Some(axis) = repeat.count.iter().position(|&count| count == 0) {
        return Err(Fault::invalid("is 0: give 1 or more").item(axis).at("count"));
    }
    number::vector(&repeat.step, dimensions).at("step")?;
    for (axis, (&count, step)) in repeat.count.iter().zip(repeat.step.components()).enumerate() {
        // The farthest copy must still be somewhere.
        Range::Finite.check(step * count as f64).item(axis).at("step")?;
    }
    let copies = repeat.count.iter().fold(1_u64, |product, &count| product.saturating_mul(count));
    let points = copies.saturating_mul(u64::from(each));
    if points > MAX_POINTS {
        let message = format!("makes {copies} copies of {each} points: {MAX_POINTS} points are the most");
        return Err(Fault::invalid(message).at("count"));
    }
    Ok(copies as u32)
}

/// How many copies a body that was checked has.
pub(in crate::scene) fn copies(body: &BodyKeys) -> u32 {
    body.repeat.as_ref().map_or(1, |repeat| repeat.count.iter().product::<u64>() as u32)
}

/// How far each copy of a body that was checked is moved `[m]`: along x first, then y, then z.
pub(in crate::scene) fn offsets(body: &BodyKeys) -> impl Iterator<Item = [f64; 3]> {
    let count = body.repeat.as_ref().map_or(&[][..], |repeat| &repeat.count);
    let [columns, rows] = [0, 1].map(|axis| count.get(axis).copied().unwrap_or(1));
    let step = body.repeat.as_ref().map_or([0.0; 3], |repeat| repeat.step.embed());
    (0..u64::from(copies(body))).map(move |k| {
        let place = [k % columns, k / columns % rows, k / columns / rows];
        std::array::from_fn(|axis| place[axis] as f64 * step[axis])
    })
}
