//! What a world beside a history has of its own, as its entry says: it keeps that, whatever a state or a command says of it.

use super::command::SetKeys;
use crate::scene::BesideKeys;
use crate::sim::{Dynamics, Method, Saved, SavedWorld, resume};

/// What a world beside has of its own.
#[derive(Clone, Copy)]
pub(super) struct Own<'a> {
    pub(super) entry: &'a BesideKeys,
    /// The first so many bonds are those that the scene lists.
    pub(super) listed: usize,
}

impl Own<'_> {
    /// The world of a `state` goes on under what is its own, as `start` has that: the world of the entry at its start.
    ///
    /// Errors: in words, why it cannot.
    pub(super) fn go_on(&self, state: &dyn Dynamics, start: &dyn Dynamics) -> Result<Box<dyn Dynamics>, String> {
        let saved = match (state.save(), start.save()) {
            (Some(SavedWorld::Plane(state)), Some(SavedWorld::Plane(start))) => {
                SavedWorld::Plane(self.under(state, start))
            }
            (Some(SavedWorld::Space(state)), Some(SavedWorld::Space(start))) => {
                SavedWorld::Space(self.under(state, start))
            }
            _ => return Err("a state of other dimensions cannot be gone on from".to_owned()),
        };
        resume(&saved).map_err(|error| error.to_string())
    }

    fn under<const D: usize>(&self, state: Saved<D>, start: Saved<D>) -> Saved<D> {
        let (mut model, own) = (state.model, start.model);
        if self.entry.owns("bonds") {
            for place in 0..model.bonds.len() {
                let number = state.bond_numbers.as_ref().map_or(place, |numbers| numbers[place] as usize);
                if number < self.listed {
                    model.bonds.set(place, own.bonds.get(number));
                }
            }
        }
        if self.entry.owns("gravity") {
            model.gravity = own.gravity;
        }
        if self.entry.owns("drag_rate") {
            model.drag_rate = own.drag_rate;
        }
        if self.entry.owns("wind") {
            model.wind = own.wind;
        }
        if self.entry.owns("bounds") {
            model.bounds = own.bounds;
        }
        // The scalar is that of the state, and a tolerance is for runs from a start.
        model.method = Method { precision: model.method.precision, tolerance: None, ..own.method };
        Saved { model, substep: start.substep, handed_over: Vec::new(), ..state }
    }

    /// What a command that sets something sets here, if anything: nothing of the method, nothing that is its own. Then what of it is kept, in words.
    pub(super) fn left_of(&self, keys: &SetKeys) -> (Option<SetKeys>, Vec<&'static str>) {
        let mut left = SetKeys { method: None, ..keys.clone() };
        let mut kept = Vec::new();
        let bonds = left.bonds.as_ref().filter(|_| self.entry.owns("bonds"));
        let stays: Vec<bool> = bonds.into_iter().flatten().map(|bond| *bond as usize >= self.listed).collect();
        if stays.contains(&false) {
            kept.push(BesideKeys::in_words("bonds"));
            if !stays.contains(&true) {
                return (None, kept);
            }
            left = left.among(&stays);
        }
        let mut keep = |key: &'static str, is_set: bool| {
            let is_kept = is_set && self.entry.owns(key);
            if is_kept {
                kept.push(BesideKeys::in_words(key));
            }
            is_kept
        };
        if keep("gravity", left.gravity.is_some()) {
            left.gravity = None;
        }
        if keep("drag_rate", left.drag_rate.is_some()) {
            left.drag_rate = None;
        }
        if keep("wind", left.wind.is_some()) {
            left.wind = None;
        }
        if keep("bounds", left.bounds.is_some()) {
            left.bounds = None;
        }
        (Some(left).filter(|left| *left != SetKeys::default()), kept)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::OneOrEach;
    use crate::scene::BondList;

    #[test]
    fn of_bonds_that_are_set_those_that_the_scene_lists_keep_their_own_numbers() {
        let entry = BesideKeys { bonds: Some(BondList::default()), ..BesideKeys::default() };
        let own = Own { entry: &entry, listed: 2 };
        let set = |bonds: &[u32], stiffness: &[f64]| SetKeys {
            bonds: Some(bonds.to_vec()),
            stiffness: Some(OneOrEach::Each(stiffness.to_vec())),
            over: Some(0.5),
            ..SetKeys::default()
        };
        let of_some = own.left_of(&set(&[3, 0, 2, 1], &[30.0, 0.5, 20.0, 10.0]));
        assert_eq!(of_some, (Some(set(&[3, 2], &[30.0, 20.0])), vec!["bonds"]));
        assert_eq!(own.left_of(&set(&[0, 1], &[1.0, 2.0])), (None, vec!["bonds"]));
        let later = set(&[2, 3], &[1.0, 2.0]);
        assert_eq!(own.left_of(&later), (Some(later.clone()), Vec::new()));
    }
}
