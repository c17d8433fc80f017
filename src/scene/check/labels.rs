//! Labels: how many there are, where they stand, and how long they are.

use super::number;
use crate::scene::error::{Fault, Source, Within};
use crate::scene::keys::LabelKeys;

impl LabelKeys {
    /// Most labels of a scene: more would cover what they are about.
    pub(crate) const MOST: usize = 100;
    /// Most characters of one: a picture of usual width has room for about as many.
    pub(crate) const LONGEST: usize = 200;

    /// Whether a command can set these labels in a world of so many points.
    ///
    /// Errors: as of a scene with them.
    pub(crate) fn told(labels: &[LabelKeys], count: u32, dimensions: usize) -> Result<(), String> {
        let checked = check(labels, count, dimensions).at("labels");
        checked.map_err(|fault| Source::default().error(fault).to_string())
    }
}

/// Errors: the first fault.
pub(super) fn check(labels: &[LabelKeys], count: u32, dimensions: usize) -> Result<(), Fault> {
    let most = LabelKeys::MOST;
    if labels.len() > most {
        return Err(Fault::invalid(format!("has {} entries: give {most} at most", labels.len())));
    }
    labels.iter().enumerate().try_for_each(|(i, label)| check_one(label, count, dimensions).item(i))
}

fn check_one(label: &LabelKeys, count: u32, dimensions: usize) -> Result<(), Fault> {
    number::vector(&label.at, dimensions).at("at")?;
    if label.text.trim().is_empty() {
        return Err(Fault::invalid("is empty: give a few words, or leave the label out").at("text"));
    }
    let (long, longest) = (label.text.chars().count(), LabelKeys::LONGEST);
    if long > longest {
        return Err(Fault::invalid(format!("has {long} characters: give {longest} at most")).at("text"));
    }
    label.point.map_or(Ok(()), |point| number::index(point, count).at("point"))
}
