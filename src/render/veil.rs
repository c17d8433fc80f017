//! What is hidden is left out of the view of a world before anything is drawn of it.

use super::view::View;
use crate::picture::{Skin, Tint};
use crate::sim::{Bonds, PointId};

/// The lists of a world without what is hidden, as long as neither its topology nor what is hidden changes.
#[derive(Default)]
pub(super) struct Veil {
    topology: Option<u64>,
    bonds: Bonds,
    triangles: Vec<[PointId; 3]>,
    skins: Vec<Skin>,
    pinned: Vec<PointId>,
}

impl Veil {
    /// Other bodies are hidden, or it is another world.
    pub(super) fn forget(&mut self) {
        *self = Veil::default();
    }

    /// What of a view is drawn; `None`: all of it.
    pub(super) fn over<'a>(&'a mut self, view: &View<'a>) -> Option<View<'a>> {
        if !view.tints.iter().any(|tint| tint.is_hidden) {
            return None;
        }
        let is_shown = |point: u32| !Tint::hides(view.tints, point);
        let shows = |points: &[PointId]| points.iter().all(|point| is_shown(point.0));
        if self.topology != Some(view.topology) {
            self.topology = Some(view.topology);
            self.bonds = view.bonds.iter().filter(|bond| shows(&[bond.a, bond.b])).collect();
            self.triangles = view.triangles.iter().copied().filter(|corners| shows(corners)).collect();
            // One of which nothing is left stays: its picture is on the GPU for when it is shown again.
            let left = |skin: &Skin| Skin {
                triangles: skin
                    .triangles
                    .iter()
                    .copied()
                    .filter(|corners| corners.iter().all(|&c| is_shown(c)))
                    .collect(),
                ..skin.clone()
            };
            self.skins = view.skins.iter().map(left).collect();
            self.pinned = view.pinned.iter().copied().filter(|pin| is_shown(pin.0)).collect();
        }
        Some(View {
            bonds: &self.bonds,
            triangles: &self.triangles,
            skins: &self.skins,
            pinned: &self.pinned,
            hinges: view.hinges.iter().copied().filter(|hinge| shows(&hinge.points)).collect(),
            joints: view.joints.iter().copied().filter(|joint| is_shown(joint.0)).collect(),
            ..view.clone()
        })
    }
}
