//! Ranges of numbers, vectors, indices and tracks.

use crate::scene::error::{Fault, Within};
use crate::scene::keys::Vector;

/// What a number may be; finite in any case, which a scene made in code might not be.
#[derive(Clone, Copy, Debug)]
pub(super) enum Range {
    /// Any.
    Finite,
    /// >= 0.
    NotNegative,
    /// > 0.
    Positive,
    /// In (0, 1].
    Share,
    /// In [0, 1].
    Fraction,
    /// Young's modulus in the plane `[N/m]`: softer than a soap film, stiffer than a plate of steel, no body is.
    Young,
}

impl Range {
    /// Errors: the number is not in the range.
    pub(super) fn check(self, value: f64) -> Result<(), Fault> {
        let (inside, range) = match self {
            Range::Finite => (true, "a finite number"),
            Range::NotNegative => (value >= 0.0, "a number of 0 or more"),
            Range::Positive => (value > 0.0, "a number above 0"),
            Range::Fraction => ((0.0..=1.0).contains(&value), "a number from 0 to 1"),
            Range::Young => ((1e-3..=1e9).contains(&value), "a number from 1e-3 to 1e9 N/m"),
            Range::Share => (value > 0.0 && value <= 1.0, "a number above 0, at most 1"),
        };
        if inside && value.is_finite() { Ok(()) } else { Err(Fault::invalid(format!("is {value:?}: give {range}"))) }
    }

    /// The same for a key that may be missing.
    pub(super) fn maybe(self, value: Option<f64>) -> Result<(), Fault> {
        value.map_or(Ok(()), |value| self.check(value))
    }
}

/// Errors: the vector is not of the scene's dimensions, or not finite.
pub(super) fn vector(vector: &Vector, dimensions: usize) -> Result<(), Fault> {
    let components = vector.components();
    if components.len() != dimensions {
        return Err(Fault::invalid(if dimensions == 2 {
            "has 3 numbers: a vector in the plane has 2 (for space set \"dimensions\": 3)"
        } else {
            "has 2 numbers: a vector in space has 3"
        }));
    }
    for (k, &x) in components.iter().enumerate() {
        Range::Finite.check(x).item(k)?;
    }
    Ok(())
}

/// Errors: the vector is not of the scene's dimensions, not finite, or zero.
pub(super) fn direction(keys: &Vector, dimensions: usize) -> Result<(), Fault> {
    vector(keys, dimensions)?;
    if keys.components().iter().all(|&x| x == 0.0) {
        return Err(Fault::invalid("is zero: give a direction"));
    }
    Ok(())
}

/// Errors: there is no such point.
pub(super) fn index(point: u32, count: u32) -> Result<(), Fault> {
    if point < count {
        return Ok(());
    }
    Err(Fault::invalid(match count {
        0 => format!("point {point} does not exist: there are no points"),
        1 => format!("point {point} does not exist: there is 1 point, so use 0"),
        _ => {
            let last = count - 1;
            format!("point {point} does not exist: there are {count} points, so use 0 to {last}")
        }
    }))
}

/// Errors: the first of some points that is not there.
pub(super) fn indices(points: &[u32], count: u32) -> Result<(), Fault> {
    points.iter().enumerate().try_for_each(|(i, &point)| index(point, count).item(i))
}

/// Errors: a corner is no vector of the scene, or `min` is not below `max` on every axis.
pub(super) fn corners(min: &Vector, max: &Vector, dimensions: usize) -> Result<(), Fault> {
    vector(min, dimensions).at("min")?;
    vector(max, dimensions).at("max")?;
    for (k, (low, high)) in min.components().iter().zip(max.components()).enumerate() {
        if low >= high {
            let message = format!("{low:?} is not below {high:?} of `max`: give min < max");
            return Err(Fault::invalid(message).item(k).at("min"));
        }
    }
    Ok(())
}

/// Errors: a knot that is not finite, or not later than the one before it.
pub(super) fn track<'a>(knots: impl Iterator<Item = &'a [f64]>) -> Result<(), Fault> {
    let mut last = f64::NEG_INFINITY;
    for (i, knot) in knots.enumerate() {
        for (k, &x) in knot.iter().enumerate() {
            Range::Finite.check(x).item(k).item(i)?;
        }
        if knot[0] <= last {
            let message =
                format!("time {:?} does not come after {last:?}: sort the knots upwards, one a time", knot[0]);
            return Err(Fault::invalid(message).item(i));
        }
        last = knot[0];
    }
    Ok(())
}
