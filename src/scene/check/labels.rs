//! Labels: how many there are, where they stand, and how long they are.

use super::number;
use crate::scene::error::{Fault, Within};
use crate::scene::keys::LabelKeys;

/// Most labels of a scene: more would cover what they are about.
const MOST: usize = 100;
/// Most characters of one: a picture of usual width has room for about as many.
const LONGEST: usize = 200;

/// Errors: the first fault.
pub(super) fn check(labels: &[LabelKeys], count: u32, dimensions: usize) -> Result<(), Fault> {
    if labels.len() > MOST {
        return Err(Fault::invalid(format!("has {} entries: give {MOST} at most", labels.len())));
    }
    labels.iter().enumerate().try_for_each(|(i, label)| check_one(label, count, dimensions).item(i))
}

fn check_one(label: &LabelKeys, count: u32, dimensions: usize) -> Result<(), Fault> {
    number::vector(&label.at, dimensions).at("at")?;
    if label.text.trim().is_empty() {
        return Err(Fault::invalid("is empty: give a few words, or leave the label out").at("text"));
    }
    let long = label.text.chars().count();
    if long > LONGEST {
        return Err(Fault::invalid(format!("has {long} characters: give {LONGEST} at most")).at("text"));
    }
    label.point.map_or(Ok(()), |point| number::index(point, count).at("point"))
}
