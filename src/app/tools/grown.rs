//! What is scaled keeps what it is made of: its mass goes with what it covers, and its springs with its mass, so that it wobbles as one that was
//! drawn in that size.

use std::collections::BTreeMap;

use glam::DVec3;

use super::chosen::Chosen;
use super::pick::Scope;
use crate::history::{Do, OneOrEach, SetKeys};
use crate::picture::Tint;
use crate::sim::{BondKind, PointId};

/// By how much each point of what is scaled weighs more, and each spring is stiffer `[1]`.
#[derive(Debug, Default)]
pub(super) struct Growth {
    /// By the numbers of points: what they weigh now and then `[kg]`.
    masses: BTreeMap<PointId, [f64; 2]>,
    /// By the numbers of springs: how stiff they are then `[N/m]`, and how damped `[N s/m]`.
    springs: Vec<(u32, [f64; 2])>,
}

/// What the points of a body fill.
#[derive(Clone, Copy, Default)]
struct Body {
    points: usize,
    chosen: usize,
    bonds: usize,
    covers: bool,
}

/// What a point is part of.
#[derive(Clone, Copy)]
enum Fills {
    /// A point without a size.
    Nothing,
    /// A rope, or what hangs on a body.
    Length,
    /// What covers something, or a net.
    Area,
    /// Bonds across all directions of space.
    Volume,
}

/// What each point of a world is part of, beside what is selected and scaled.
struct Parts {
    dimensions: usize,
    factors: DVec3,
    /// Which body each point is of.
    of: Vec<u32>,
    bodies: Vec<Body>,
    /// Triangles meet there.
    is_corner: Vec<bool>,
    /// How long the bonds of each point are together, now and then `[m]`.
    lengths: Vec<[f64; 2]>,
}

impl Parts {
    /// `factors` along x, y and z, above 0.
    fn of(scope: Scope<'_>, chosen: &Chosen, factors: DVec3) -> Self {
        let scenery = &scope.shown.scenery;
        let count = scope.shown.point_count().min(scenery.masses.len());
        let is_inside = |ends: &[PointId; 2]| ends.iter().all(|end| end.index() < count);
        let ends = || scenery.bonds.ends().iter().copied().filter(is_inside);
        let mut is_corner = vec![false; count];
        let corners = scenery.triangles.iter().filter(|corners| corners.iter().all(|point| scope.is_there(*point)));
        corners.flatten().filter(|corner| corner.index() < count).for_each(|corner| is_corner[corner.index()] = true);
        let of = Tint::hanging(count, ends().chain(scope.arms().filter(is_inside)).map(|ends| ends.map(|end| end.0)));
        let mut bodies = vec![Body::default(); of.iter().max().map_or(0, |last| *last as usize + 1)];
        for point in (0..count as u32).map(PointId).filter(|&point| scope.is_there(point)) {
            let body = &mut bodies[of[point.index()] as usize];
            body.points += 1;
            body.chosen += usize::from(chosen.points.binary_search(&point).is_ok());
            body.covers |= is_corner[point.index()];
        }
        let mut lengths = vec![[0.0; 2]; count];
        for [a, b] in ends() {
            bodies[of[a.index()] as usize].bonds += 1;
            let [from, to] = [a, b].map(|end| DVec3::from(scope.shown.place(end.index())));
            for (sum, along) in [to - from, factors * (to - from)].into_iter().map(DVec3::length).enumerate() {
                lengths[a.index()][sum] += along;
                lengths[b.index()][sum] += along;
            }
        }
        Parts { dimensions: scope.shown.dimensions, factors, of, bodies, is_corner, lengths }
    }

    /// What a point of a body fills.
    fn fills(&self, point: PointId, body: &Body) -> Fills {
        match body.bonds {
            0 => Fills::Nothing,
            _ if self.is_corner[point.index()] => Fills::Area,
            bonds if body.covers || bonds <= body.points => Fills::Length,
            _ if self.dimensions == 2 => Fills::Area,
            _ => Fills::Volume,
        }
    }

    /// By how much a point weighs more `[1]`; `None` of one that has no size, or is of a body that is not scaled as a whole.
    fn factor(&self, point: PointId) -> Option<f64> {
        let body = self.bodies.get(*self.of.get(point.index())? as usize)?;
        if body.chosen < body.points {
            return None;
        }
        let [now, then] = self.lengths[point.index()];
        match self.fills(point, body) {
            Fills::Nothing => None,
            Fills::Length => Some(if now > 0.0 { then / now } else { self.factors.x }),
            Fills::Area if self.dimensions == 2 => Some(self.factors.x * self.factors.y),
            Fills::Area => Some(self.factors.x.powi(2)),
            Fills::Volume => Some(self.factors.element_product()),
        }
    }
}

impl Growth {
    /// Of what is selected, scaled by factors along x, y and z. Parts of bodies keep their mass, and so does what is no body.
    ///
    /// Model: mass by length, area or volume stays: m' = m s, with s the mean factor along the bonds of what is a line, the product of two factors
    /// where triangles or a net are filled, of three where bonds fill space. Stiffness and damping of a spring go with the geometric mean of
    /// the factors of its ends, so frequencies stay.
    pub(super) fn of(scope: Scope<'_>, chosen: &Chosen, factors: DVec3) -> Self {
        // What is mirrored is as large as before.
        let parts = Parts::of(scope, chosen, factors.abs());
        let scenery = &scope.shown.scenery;
        let masses = chosen.points.iter().filter_map(|&point| {
            let own = scenery.masses.get(point.index())?;
            let then = own * parts.factor(point)?;
            (then != *own).then_some((point, [*own, then]))
        });
        let springs = scenery.bonds.iter().enumerate().filter_map(|(place, bond)| {
            let BondKind::Spring { stiffness, damping } = bond.kind else { return None };
            let more = (parts.factor(bond.a)? * parts.factor(bond.b)?).sqrt();
            (more != 1.0).then_some((scenery.bond_number(place), [more * stiffness, more * damping]))
        });
        Growth { masses: masses.collect(), springs: springs.collect() }
    }

    /// What is to be done after it is scaled.
    pub(super) fn commands(&self) -> Vec<Do> {
        let masses = (!self.masses.is_empty()).then(|| SetKeys {
            points: Some(self.masses.keys().map(|point| point.0).collect()),
            mass: Some(each(self.masses.values().map(|[_, then]| *then))),
            ..SetKeys::default()
        });
        let springs = (!self.springs.is_empty()).then(|| SetKeys {
            bonds: Some(self.springs.iter().map(|(number, _)| *number).collect()),
            stiffness: Some(each(self.springs.iter().map(|(_, [stiffness, _])| *stiffness))),
            damping: Some(each(self.springs.iter().map(|(_, [_, damping])| *damping))),
            ..SetKeys::default()
        });
        masses.into_iter().chain(springs).map(|keys| Do::Set(Box::new(keys))).collect()
    }

    /// What it weighs then, as it ends a line; nothing of what keeps its mass.
    pub(super) fn words(&self, scope: Scope<'_>) -> String {
        let free = self.masses.iter().filter(|(point, _)| !scope.is_pinned(**point));
        let then: f64 = free.map(|(_, [_, then])| then).sum();
        if then > 0.0 { format!(", {} kg", figures(then)) } else { String::new() }
    }
}

/// A number to two or three figures.
fn figures(number: f64) -> String {
    match number {
        large if large >= 100.0 => format!("{large:.0}"),
        middle if middle >= 10.0 => format!("{middle:.1}"),
        small if small >= 0.1 => format!("{small:.2}"),
        least => format!("{least:.1e}"),
    }
}

/// One number for all where they are the same.
fn each(list: impl Iterator<Item = f64>) -> OneOrEach {
    let list: Vec<f64> = list.collect();
    match list[..] {
        [first, ..] if list.iter().all(|number| *number == first) => OneOrEach::One(first),
        _ => OneOrEach::Each(list),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use glam::DVec2;

    use super::super::handles::Change;
    use super::super::rings::Turned;
    use super::super::tests::{scope, shown};
    use super::*;
    use crate::app::player::{Note, Order, Stage};
    use crate::scene::Scene;

    /// A soft box with a rope on it, a rope of rods and a steel box; a loose point.
    const PLANE: &str = r#"{"wobble": 1, "gravity": [0, 0], "view": {"center": [0, 0], "height": 20},
        "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5, "material": {"kind": "spring", "stiffness": 300, "damping": 2, "mass": 1}},
          {"make": "rope", "count": 5, "origin": [3, 0], "to": [2, 0], "material": {"kind": "rigid", "mass": 0.4}},
          {"make": "lattice", "columns": 2, "rows": 2, "spacing": 1, "origin": [-4, 0], "material": {"kind": "rigid", "mass": 2}}],
        "points": {"position": [[0, 5]], "mass": 3}}"#;

    /// Sums of masses and the first stiffness of each body, by its points.
    fn weights(stage: &Stage, bodies: &[std::ops::Range<usize>]) -> Vec<f64> {
        let masses = stage.history().world().masses();
        bodies.iter().map(|body| masses[body.clone()].iter().sum()).collect()
    }

    #[test]
    fn what_is_scaled_keeps_its_density_and_undo_brings_all_back() {
        let mut seen = shown(Scene::parse(PLANE, "x.json").unwrap());
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        let bodies = [1..10, 10..15, 15..19, 0..1];
        let springs = |stage: &Stage| -> Vec<[f64; 2]> {
            let kinds = stage.history().world().bonds().iter().map(|bond| bond.kind).collect::<Vec<_>>();
            let of = |kind| match kind {
                BondKind::Spring { stiffness, damping } => Some([stiffness, damping]),
                _ => None,
            };
            kinds.into_iter().filter_map(of).collect()
        };
        let (before, stiff) = (weights(&stage, &bodies), springs(&stage));
        let all = Chosen { points: (0..19).map(PointId).collect(), ..Chosen::default() };
        for (factors, grown) in [([2.0, 2.0], [4.0, 2.0, 4.0, 1.0]), ([2.0, 0.5], [1.0, 2.0, 1.0, 1.0])] {
            let change = Change::Scale(factors);
            assert!(change.words(scope(&seen), &all).contains(" kg"));
            let deed = change.fitted(scope(&seen), &all, DVec2::ZERO);
            assert_eq!(deed.edit, Some("scale"));
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
            for ((now, then), grown) in before.iter().zip(weights(&stage, &bodies)).zip(grown) {
                assert!((then / now - grown).abs() < 1e-9, "{factors:?}: {now} kg, then {then} kg");
            }
            for (now, then) in stiff.iter().zip(springs(&stage)) {
                assert!((0..2).all(|k| (then[k] / now[k] - grown[0]).abs() < 1e-9), "{factors:?}: {now:?}, {then:?}");
            }
            assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "scale"));
            assert_eq!((weights(&stage, &bodies), springs(&stage)), (before.clone(), stiff.clone()));
            stage.show(&mut seen.0);
        }
        let part = Chosen { points: (1..5).map(PointId).collect(), ..Chosen::default() };
        assert!(Growth::of(scope(&seen), &part, DVec3::splat(2.0)).commands().is_empty(), "a part keeps its mass");
    }

    #[test]
    fn in_space_a_cloth_grows_by_its_area_a_block_by_its_volume_and_a_rope_by_its_length() {
        let corner = |k: usize| format!("[{}, {}, {}]", 9 + k % 2, k / 2 % 2, k / 4);
        let corners: Vec<String> = (0..8).map(corner).collect();
        let pairs = (0..8).flat_map(|a| (a + 1..8).map(move |b| format!(r#"{{"a": {a}, "b": {b}}}"#)));
        let text = format!(
            r#"{{"wobble": 1, "dimensions": 3, "points": {{"position": [{}], "mass": 0.125}}, "bonds": [{}], "bodies": [
            {{"make": "cloth", "columns": 4, "rows": 4, "spacing": 0.5, "origin": [0, 0, 0], "material": {{"kind": "spring", "stiffness": 300, "mass": 1}}}},
            {{"make": "rope", "count": 5, "origin": [0, 5, 0], "to": [2, 0, 0], "material": {{"kind": "rigid", "mass": 1}}}}]}}"#,
            corners.join(", "),
            pairs.collect::<Vec<_>>().join(", ")
        );
        let seen = shown(Scene::parse(&text, "x.json").unwrap());
        let all = Chosen { points: (0..seen.0.point_count() as u32).map(PointId).collect(), ..Chosen::default() };
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        let deed = Turned::By(2.0).deed(scope(&seen), &all);
        assert!(Turned::By(2.0).said(scope(&seen), &all).contains("14.0 kg"));
        assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
        let grown = weights(&stage, &[0..8, 8..24, 24..29]);
        for (grown, factor) in grown.iter().zip([8.0, 4.0, 2.0]) {
            assert!((grown - factor).abs() < 1e-9, "{grown} kg of {factor}");
        }
    }
}
