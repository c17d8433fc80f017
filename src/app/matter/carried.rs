//! What the springs of bodies carry as they stand now: whether a body stands on anything, and whether it bears itself already.

use glam::DVec2;

use crate::app::player::Shown;
use crate::app::tools::{distance_to_segment, gap_in, touch};
use crate::sim::vector::{dot, length, sub};
use crate::sim::{BondKind, PointId};

/// A body stands on what is no farther below its foot than this share of its height `[1]`.
const NEAR: f64 = 0.05;
/// Springs that carry so much of what a body weighs say by themselves how far it sinks `[1]`.
const MOST_OF_IT: f64 = 0.5;
/// A body bears itself that sinks under its whole weight by no more than this share of the height that it has now `[1]`: by a third of that
/// which it has at rest.
const BEARS: f64 = 0.5;

/// Of each body what its springs carry.
///
/// Model: on the ground Σ f Δh = Σ w h where nothing moves: f what a spring presses with, Δh how far its upper end is above the lower one, w
/// and h weight and height of points above the foot. What linear springs store is half of that times the share s by which they let it sink,
/// so under all of its weight s = 2 E Σ w h / (Σ f Δh)^2.
/// Valid range: small strains; of what is folded up E, and so s, is large.
#[derive(Debug, Default)]
pub(super) struct Carried {
    /// Σ w h and Σ f Δh `[N m]`, and what springs store `[J]`.
    weight: Vec<f64>,
    carries: Vec<f64>,
    stored: Vec<f64>,
}

impl Carried {
    /// Of `bodies` bodies, `body` of each point, with this acceleration against `up` `[m/s^2]`.
    pub(super) fn of(shown: &Shown, (body, bodies): (&[u32], usize), (g, up): (f64, [f64; 3])) -> Self {
        let scenery = &shown.scenery;
        let height: Vec<f64> = (0..body.len()).map(|point| dot(shown.place(point), up)).collect();
        let mut foot = vec![f64::INFINITY; bodies];
        body.iter().zip(&height).for_each(|(&own, &h)| foot[own as usize] = foot[own as usize].min(h));
        let [mut weight, mut carries, mut stored] = [0; 3].map(|_| vec![0.0; bodies]);
        for ((&own, h), mass) in body.iter().zip(&height).zip(&scenery.masses) {
            let own = own as usize;
            weight[own] += if h.is_finite() { g * mass * (h - foot[own]) } else { 0.0 };
        }
        for bond in scenery.bonds.iter() {
            let BondKind::Spring { stiffness, .. } = bond.kind else { continue };
            let long = length(sub(shown.place(bond.a.index()), shown.place(bond.b.index())));
            let short = bond.rest_length - long;
            if !bond.limit.acts(-short, 0.0) || long.is_nan() || long <= 0.0 {
                continue;
            }
            let own = body[bond.a.index()] as usize;
            let rise = height[bond.a.index()] - height[bond.b.index()];
            carries[own] += stiffness * short * rise * rise / long;
            stored[own] += 0.5 * stiffness * short * short;
        }
        Carried { weight, carries, stored }
    }

    /// Σ w h of a body `[N m]`: what lifts it by its height, about.
    pub(super) fn weight(&self, body: usize) -> f64 {
        self.weight[body]
    }

    /// Whether the springs of a body carry what it weighs, and little of its height is lost.
    pub(super) fn bears_itself(&self, body: usize) -> bool {
        let (weight, carries) = (self.weight[body], self.carries[body]);
        carries > MOST_OF_IT * weight && 2.0 * self.stored[body] * weight <= BEARS * carries * carries
    }
}

/// Where the bodies of a world are, to find what a body stands on.
#[derive(Debug, Default)]
pub(super) struct Grounds {
    /// The bonds of each body, one body's after another's, and where each body's begin.
    bonds: Vec<[PointId; 2]>,
    begins: Vec<usize>,
    /// The box around the bonds of each body, lower and upper corner `[m]`.
    boxes: Vec<[DVec2; 2]>,
}

impl Grounds {
    /// Of `bodies` bodies, `body` of each point.
    pub(super) fn of(shown: &Shown, (body, bodies): (&[u32], usize)) -> Self {
        let own = |ends: &[PointId; 2]| body[ends[0].index()] as usize;
        let mut bonds = shown.scenery.bonds.ends().to_vec();
        bonds.sort_by_key(own);
        let begins = (0..=bodies).map(|first| bonds.partition_point(|ends| own(ends) < first)).collect();
        let mut boxes = vec![NOWHERE; bodies];
        for ends in &bonds {
            let around = &mut boxes[own(ends)];
            *around = ends.iter().fold(*around, |around, &end| with(around, place(shown, end)));
        }
        Grounds { bonds, begins, boxes }
    }

    /// Whether a body so high `[m]` stands on a wall, an obstacle or another body: `feet` are its lowest points.
    pub(super) fn bear(&self, shown: &Shown, own: u32, (feet, high): (&[PointId], f64)) -> bool {
        let near = NEAR * high;
        if feet.iter().any(|&point| gap_in(&shown.scenery, place(shown, point)) <= near) {
            return true;
        }
        let [low, high] = feet.iter().fold(NOWHERE, |around, &foot| with(around, place(shown, foot)));
        let around = [low - near, high + near];
        let others = (0..self.boxes.len()).filter(|&other| other != own as usize && touch(around, self.boxes[other]));
        others.flat_map(|other| &self.bonds[self.begins[other]..self.begins[other + 1]]).any(|&ends| {
            let [from, to] = ends.map(|end| place(shown, end));
            let is_at = |&foot: &PointId| distance_to_segment(place(shown, foot), from, to) <= near;
            touch(around, with(with(NOWHERE, from), to)) && feet.iter().any(is_at)
        })
    }
}

/// A box around nothing.
const NOWHERE: [DVec2; 2] = [DVec2::INFINITY, DVec2::NEG_INFINITY];

fn place(shown: &Shown, point: PointId) -> DVec2 {
    DVec2::from_slice(&shown.place(point.index())[..2])
}

/// A box that has a place in it too, where that is one.
fn with([low, high]: [DVec2; 2], at: DVec2) -> [DVec2; 2] {
    if at.is_finite() { [low.min(at), high.max(at)] } else { [low, high] }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::player::{Order, Stage};
    use crate::scene::Scene;

    /// A block, 1.2 m wide and 1 m high, of so much mass `[kg]`, after so many frames on the ground.
    fn carried(mass: f64, frames: u32) -> Carried {
        let text = format!(
            r#"{{"wobble": 1, "gravity": [0, -9.81], "contact": true, "bounds": {{"min": [-9, 0], "max": [9, 9]}}, "drag_rate": 1,
            "bodies": [{{"make": "lattice", "columns": 13, "rows": 11, "spacing": 0.1, "origin": [0, 0.01],
            "material": {{"kind": "spring", "stiffness": 60, "damping": 0.5, "mass": {mass}}}}}]}}"#
        );
        let mut stage = Stage::new(Scene::parse(&text, "x.json").unwrap().into()).unwrap();
        (0..frames).for_each(|_| _ = stage.obey(Order::Step(None)));
        let mut shown = Shown::default();
        stage.show(&mut shown);
        let body = vec![0; shown.point_count()];
        Carried::of(&shown, (&body, 1), (9.81, [0.0, 1.0, 0.0]))
    }

    #[test]
    fn springs_carry_what_stands_on_them_once_it_rests() {
        let light = carried(1.2, 300);
        let share = light.carries[0] / light.weight[0];
        assert!((0.8..1.2).contains(&share), "{share} of its weight");
        assert!(light.bears_itself(0), "it stands");
        assert!(!carried(1.2, 0).bears_itself(0), "nothing is known of it yet");
        assert!(!carried(48.0, 300).bears_itself(0), "it is pressed flat");
    }

    #[test]
    fn a_body_stands_on_what_is_below_its_feet_of_others_alone() {
        let text = r#"{"wobble": 1, "gravity": [0, 0], "points": {"position": [[0, 0], [4, 0], [1, 0.01], [1, 1], [9, 0.01], [9, 1]]},
            "bonds": [{"a": 0, "b": 1}, {"a": 2, "b": 3}, {"a": 4, "b": 5}]}"#;
        let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        let mut shown = Shown::default();
        stage.show(&mut shown);
        let grounds = Grounds::of(&shown, (&[0, 0, 1, 1, 2, 2], 3));
        let bears = |own: u32, foot: u32, high: f64| grounds.bear(&shown, own, (&[PointId(foot)], high));
        assert!(bears(1, 2, 1.0), "above the middle of a bond");
        assert!(!bears(1, 2, 0.1), "it is too far above that");
        assert!(!bears(2, 4, 1.0), "nothing is there but its own bond");
    }
}
