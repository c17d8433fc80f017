//! Rigid bodies that come with rest lengths of few digits get those of one shape, as they do at the start of a scene.

use std::borrow::Cow;

use crate::sim::bond::{Bond, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::command::Addition;
use crate::sim::model::Model;
use crate::sim::plan::{Fitted, fit_rest_lengths};
use crate::sim::real::Real;
use crate::sim::vector::truncate;
use crate::sim::world::World;

impl<S: Real, const D: usize> World<S, D> {
    /// An addition whose bodies of new points have places and rest lengths that agree, and what was fitted, by the numbers that its bonds get.
    pub(super) fn fitted<'a>(&self, addition: &'a Addition) -> (Cow<'a, Addition>, Fitted) {
        let first = self.count() as u32;
        let (mut bonds, mut listed) = (Bonds::new(), Vec::new());
        for (k, bond) in addition.bonds.iter().enumerate() {
            if let [Some(a), Some(b)] = [bond.a, bond.b].map(|end| end.0.checked_sub(first)) {
                bonds.push(Bond { a: PointId(a), b: PointId(b), ..*bond });
                listed.push(k);
            }
        }
        let model = Model {
            mass: addition.mass.clone(),
            pinned: addition.pinned.iter().filter_map(|point| point.0.checked_sub(first)).map(PointId).collect(),
            planes: self.model.planes.clone(),
            method: self.model.method,
            ..Model::default()
        };
        let mut position: Vec<[f64; D]> = addition.position.iter().map(|&x| truncate(x)).collect();
        let mut fitted = fit_rest_lengths(&model, &mut bonds, &mut position);
        if fitted.bonds.is_empty() {
            return (Cow::Borrowed(addition), fitted);
        }
        let mut fit = addition.clone();
        for (place, x) in fit.position.iter_mut().zip(position) {
            place[..D].copy_from_slice(&x);
        }
        for &k in &fitted.bonds {
            fit.bonds[listed[k]].rest_length = bonds.rest_lengths()[k];
        }
        for k in &mut fitted.bonds {
            *k = listed[*k] + self.numbers.next_bond as usize;
        }
        (Cow::Owned(fit), fitted)
    }
}
