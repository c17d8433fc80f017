//! What bodies of relaxed bonds and those of springs are, where they stand beside each other: they look alike, and give way alike.

use std::collections::BTreeMap;

use glam::DVec2;

use super::build::short;
use super::marks::Mark;
use super::pick::Scope;
use crate::picture::Tint;
use crate::sim::BondKind;

/// Scenes of more bonds, or of more bodies of them, have no labels.
const MOST_BONDS: usize = 400;
const MOST_BODIES: usize = 8;
/// From the highest point of a body to its label, right and down `[logical px]`.
const BESIDE: [f64; 2] = [16.0, 8.0];

/// A body of bonds of one kind.
struct Kind {
    is_relaxed: bool,
    is_mixed: bool,
    /// The least and the greatest relaxation `[1]`, or stiffness `[N/m]`.
    numbers: [f64; 2],
    /// Where its highest point is seen `[px]`.
    highest: Option<DVec2>,
}

/// A label beside each body, where bodies of relaxed bonds that give way like springs of a stiffness `[N/m]` stand beside bodies of springs.
pub(in crate::app) fn marks(scope: Scope<'_>, relaxed: Option<f64>) -> Vec<Mark> {
    let bonds = &scope.shown.scenery.bonds;
    let Some(like) = relaxed.filter(|_| bonds.len() <= MOST_BONDS) else { return Vec::new() };
    let ends = bonds.ends().iter().map(|ends| ends.map(|end| end.0));
    let bodies = Tint::hanging(scope.shown.point_count(), ends);
    let mut kinds: BTreeMap<u32, Kind> = BTreeMap::new();
    for bond in bonds.iter() {
        let (is_relaxed, number) = match bond.kind {
            BondKind::Relaxed { relaxation, .. } => (true, relaxation),
            BondKind::Spring { stiffness, .. } => (false, stiffness),
            BondKind::Rigid => continue,
        };
        let own = Kind { is_relaxed, is_mixed: false, numbers: [number; 2], highest: None };
        let Some(body) = bodies.get(bond.a.index()) else { continue };
        let kind = kinds.entry(*body).or_insert(own);
        kind.is_mixed |= kind.is_relaxed != is_relaxed;
        kind.numbers = [kind.numbers[0].min(number), kind.numbers[1].max(number)];
        for at in [bond.a, bond.b].into_iter().filter_map(|end| scope.pixel(end)) {
            kind.highest = kind.highest.filter(|other| other.y <= at.y).or(Some(at));
        }
    }
    kinds.retain(|_, kind| !kind.is_mixed);
    let has = |is_relaxed: bool| kinds.values().any(|kind| kind.is_relaxed == is_relaxed);
    if kinds.len() > MOST_BODIES || !has(true) || !has(false) {
        return Vec::new();
    }
    let label = |kind: &Kind| Some(Mark::Words(kind.highest? + scope.scale * DVec2::from(BESIDE), kind.words(like)));
    kinds.values().filter_map(label).collect()
}

impl Kind {
    fn words(&self, like: f64) -> String {
        let written = |number: f64| if self.is_relaxed { number.to_string() } else { short(number) };
        let [least, most] = self.numbers.map(written);
        let numbers = if least == most { least } else { format!("{least} to {most}") };
        match self.is_relaxed {
            true => format!("relaxed, k = {numbers}: like {} N/m", short(like)),
            false => format!("springs, {numbers} N/m"),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::tests::{scope, shown};
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn chains_that_look_alike_are_labelled_where_both_kinds_are() {
        let words = |scene: Scene| -> Vec<String> {
            let seen = shown(scene);
            let marks = marks(scope(&seen), seen.0.figures.relaxed);
            let words = marks.into_iter().map(|mark| match mark {
                Mark::Words(at, words) => (at.x, words),
                other => panic!("{other:?}"),
            });
            let mut words: Vec<(f64, String)> = words.collect();
            words.sort_by(|a, b| a.0.total_cmp(&b.0));
            words.into_iter().map(|(_, words)| words).collect()
        };
        let scene = Scene::of_gallery("relaxation", "test").unwrap();
        let all = words(scene.clone());
        assert_eq!(all.len(), 2, "{all:?}");
        assert!(all[0].starts_with("relaxed, k = 0.05") && all[0].ends_with("like 152 N/m"), "{all:?}");
        assert_eq!(all[1], "springs, 152 to 303 N/m");
        let springs = scene.bonds.iter().filter(|bond| bond.stiffness.is_none()).collect::<Vec<_>>();
        assert!(
            words(Scene { bonds: springs.into(), parameters: Vec::new(), ..scene }).is_empty(),
            "nothing to tell apart"
        );
        assert!(words(Scene::of_gallery("spring-damper", "test").unwrap()).is_empty());
    }
}
