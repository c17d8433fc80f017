//! Which points of the world have trails, and for how long.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::render::{Trails, View};
use crate::sim::PointId;

/// How many points are followed at most, and for how long.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct TrailSettings {
    /// Points.
    pub(super) most: usize,
    /// How long a trail lasts `[s of wall time]` at the scene's own pace.
    pub(super) length: f64,
}

impl Default for TrailSettings {
    fn default() -> Self {
        TrailSettings { most: 8, length: 2.5 }
    }
}

impl TrailSettings {
    /// As many points as can be followed: lines of more are told apart by nobody.
    pub(super) const MOST: usize = 64;
    /// The shortest and the longest trails `[s]`.
    pub(super) const LENGTHS: [f64; 2] = [0.5, 30.0];

    /// The same within what can be set.
    pub(super) fn kept(self) -> Self {
        let [shortest, longest] = TrailSettings::LENGTHS;
        TrailSettings { most: self.most.clamp(1, TrailSettings::MOST), length: self.length.clamp(shortest, longest) }
    }
}

/// What is asked for of trails, and which points it leads to.
#[derive(Clone, Debug, Default)]
pub(super) struct Trailing {
    pub(super) settings: TrailSettings,
    /// The scene that is open, and whether there are any in scenes where somebody said so; in others there are where points are few.
    scene: String,
    wanted: BTreeMap<String, bool>,
    /// There are some now.
    is_on: bool,
    /// What the points were chosen by last, and the points.
    by: (u64, usize, Vec<PointId>, Vec<PointId>),
    followed: Vec<PointId>,
}

impl Trailing {
    /// Whether points have trails now.
    pub(super) fn is_on(&self) -> bool {
        self.is_on
    }

    /// On or off from now on in the scene that is open.
    pub(super) fn toggle(&mut self) {
        self.wanted.insert(self.scene.clone(), !self.is_on);
    }

    /// Another scene is open, of this name: it has trails if it had some.
    pub(super) fn enter(&mut self, scene: &str) {
        scene.clone_into(&mut self.scene);
    }

    /// The points to follow: those that are probed, then those that are selected, then what is looked at first, then others that are free.
    pub(super) fn follow(&mut self, view: &View<'_>, probed: Vec<PointId>, selected: &[PointId]) -> &[PointId] {
        self.is_on = self.wanted.get(&self.scene).copied().unwrap_or_else(|| Trails::suit(view));
        if !self.is_on {
            (self.by.1, self.followed) = (0, Vec::new());
            return &self.followed;
        }
        let (topology, most, probes, others) = &self.by;
        let is_same = (*topology, *most) == (view.topology, self.settings.most);
        if !is_same || *probes != probed || others[..] != *selected {
            self.followed = Trails::choose(view, &[&probed, selected], self.settings.most);
            self.by = (view.topology, self.settings.most, probed, selected.to_vec());
        }
        &self.followed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{Bonds, Positions};

    #[test]
    fn trails_are_where_points_are_few_until_somebody_says_otherwise() {
        let bonds = Bonds::default();
        let (few, many) = ([0.0; 8], [0.0; 400]);
        let of = |x: &[f64], trailing: &mut Trailing, probed: &[u32], selected: &[u32]| -> Vec<u32> {
            let world = View { current: Positions::F64(x), previous: Positions::F64(x), ..View::empty(&bonds, 2) };
            let [probed, selected] =
                [probed, selected].map(|list| list.iter().copied().map(PointId).collect::<Vec<_>>());
            trailing.follow(&world, probed, &selected).iter().map(|point| point.0).collect()
        };
        let mut trailing = Trailing::default();
        assert_eq!(of(&few, &mut trailing, &[], &[]), [0, 1, 2, 3]);
        assert!(of(&many, &mut trailing, &[], &[]).is_empty() && !trailing.is_on());
        trailing.toggle();
        assert_eq!(of(&many, &mut trailing, &[], &[]).len(), 8);
        assert_eq!(of(&many, &mut trailing, &[150], &[3, 4])[..3], [150, 3, 4]);
        trailing.settings.most = 2;
        assert_eq!(of(&many, &mut trailing, &[150], &[3, 4]), [150, 3], "at once");
        trailing.toggle();
        assert!(of(&few, &mut trailing, &[], &[]).is_empty(), "off where they would be on");
        trailing.enter("another scene");
        assert_eq!(of(&few, &mut trailing, &[], &[]).len(), 2, "of others nobody said anything");
        trailing.toggle();
        trailing.enter("");
        assert!(of(&few, &mut trailing, &[], &[]).is_empty(), "off here still");
        trailing.toggle();
        assert_eq!(of(&few, &mut trailing, &[], &[]).len(), 2);
        trailing.enter("another scene");
        assert!(of(&few, &mut trailing, &[], &[]).is_empty(), "as it was left");
    }
}
