//! What relaxed bonds amount to as the world is: worked out when a scene opens, and whenever its method, its bonds, its masses or its pins change.

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use crate::equilibrium::{MOST_SOFT, Softness, softness};
use crate::history::History;
use crate::scene::MethodKeys;
use crate::sim::{Bond, BondKind, Dynamics, Model, PointId, Saved, SavedWorld, Solver};

/// Of more bonds than this it is worked out once a change is over, not while a slider is dragged: that takes long.
const AT_ONCE: usize = 300;
/// A change is over where nothing else was seen for so long, and nobody looked.
const SOON: Duration = Duration::from_millis(300);

/// What it depends on.
#[derive(Clone, Debug, PartialEq)]
struct Of {
    method: MethodKeys,
    /// The substep of relaxed bonds now `[s]`.
    substep: f64,
    bonds: Vec<Bond>,
    masses: Vec<f64>,
    pinned: Vec<PointId>,
}

/// Of what it was worked out for last.
#[derive(Clone, Debug, Default)]
pub(super) struct Relaxed {
    of: Option<Of>,
    /// What was seen since and is not worked out yet, and when.
    seen: Option<(Of, Instant)>,
    softness: Option<Softness>,
}

impl Relaxed {
    /// Works it out, if it may be another. Where there is nothing to be measured no model is made.
    pub(super) fn look(&mut self, history: &History) {
        let world = history.world();
        if !is_soft(world) {
            *self = Relaxed::default();
            return;
        }
        let now = Of {
            method: history.method(),
            substep: substep(world),
            bonds: world.bonds().iter().collect(),
            masses: world.masses().to_vec(),
            pinned: world.pinned().to_vec(),
        };
        if self.of.as_ref() == Some(&now) {
            self.seen = None;
            return;
        }
        let is_over =
            self.of.is_none() || now.bonds.len() <= AT_ONCE || self.seen.as_ref().is_some_and(|(seen, _)| *seen == now);
        if is_over {
            self.softness = of(history, now.substep);
            (self.of, self.seen) = (Some(now), None);
        } else {
            self.seen = Some((now, Instant::now()));
        }
    }

    /// When it is to be looked again, though nothing is asked for until then: what was seen is not worked out yet.
    pub(super) fn due(&self) -> Option<Instant> {
        self.seen.as_ref().map(|(_, at)| *at + SOON)
    }

    /// The stiffness of springs that would give way as much `[N/m]`; `None` where no bond takes a share of its error.
    pub(super) fn stiffness(&self) -> Option<f64> {
        self.softness.map(|softness| softness.stiffness)
    }
}

/// Whether bonds take a share of their error, in a world of so few points that it is measured.
fn is_soft(world: &dyn Dynamics) -> bool {
    let takes_a_share = |kind: BondKind| matches!(kind, BondKind::Relaxed { relaxation, .. } if relaxation < 1.0);
    world.point_count() <= MOST_SOFT && world.bonds().iter().any(|bond| takes_a_share(bond.kind))
}

/// The substep of what sweeps relaxed bonds `[s]`, said by the scene or not.
fn substep(world: &dyn Dynamics) -> f64 {
    let swept = world.parts().iter().find(|part| part.solver == Solver::Relaxation);
    swept.map_or(world.substep(), |part| part.substep)
}

fn of(history: &History, substep: f64) -> Option<Softness> {
    match history.world().save()? {
        SavedWorld::Plane(saved) => softness(&as_it_is(saved, history.scene().model::<2>().ok(), substep)),
        SavedWorld::Space(saved) => softness(&as_it_is(saved, history.scene().model::<3>().ok(), substep)),
    }
}

/// A world as a model by its present method. Its points are where they are at the start, where bonds have their lengths, if no bond joins others than there:
/// then they are where they are now.
fn as_it_is<const D: usize>(saved: Saved<D>, start: Option<Model<D>>, substep: f64) -> Model<D> {
    let Saved { mut model, gone, .. } = saved;
    // Nothing holds what is gone; its mass is no matter.
    for point in gone {
        if let Some(mass) = model.mass.get_mut(point.index()) {
            *mass = 1.0;
        }
    }
    let joined = |bond: Bond| (bond.a.min(bond.b), bond.a.max(bond.b));
    if let Some(start) = start {
        let known: BTreeSet<(PointId, PointId)> = start.bonds.iter().map(joined).collect();
        if model.bonds.iter().all(|bond| known.contains(&joined(bond))) {
            model.position.iter_mut().zip(start.position).for_each(|(place, at_start)| *place = at_start);
        }
    }
    model.method.substep = model.method.substep.or(Some(substep));
    model.method.iterations = model.method.iterations.or(Some(1));
    model
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::player::movers::with;
    use crate::app::player::{Order, Shown, Stage};
    use crate::history::{Do, OneOrEach, SetKeys, Start};
    use crate::scene::Scene;
    use crate::sim::Cursor;

    #[test]
    fn more_sweeps_make_relaxed_bonds_stiffer_by_the_formula() {
        let start: Start = Scene::of_gallery("relaxation", "test").unwrap().into();
        let mut history = History::new(start).unwrap();
        let mut relaxed = Relaxed::default();
        // K = mu/h^2 (1 - q)/q, q = (1 - k)^n, of ends of 0.1 kg each.
        let stiffness = |q: f64| 0.05 * 240.0_f64.powi(2) * (1.0 - q) / q;
        relaxed.look(&history);
        let once = relaxed.stiffness().unwrap();
        assert!((once / stiffness(0.95) - 1.0).abs() < 1e-3, "{once}");
        history.give(vec![with(MethodKeys { iterations: Some(3), ..history.method() })], None).unwrap();
        relaxed.look(&history);
        let thrice = relaxed.stiffness().unwrap();
        assert!((thrice / stiffness(0.95_f64.powi(3)) - 1.0).abs() < 0.02, "{thrice}");
        let rigid: Start = Scene::of_gallery("rim", "test").unwrap().into();
        let mut none = Relaxed::default();
        none.look(&History::new(rigid).unwrap());
        assert_eq!(none.stiffness(), None);
    }

    #[test]
    fn of_many_bonds_it_is_worked_out_once_a_change_is_over_in_a_pause_too() {
        let text = r#"{"wobble": 1, "gravity": [0, 0], "method": {"substep": 0.005, "iterations": 1}, "bodies": [{"make": "lattice",
            "columns": 10, "rows": 10, "spacing": 0.1, "material": {"kind": "relaxed", "relaxation": 0.1, "mass": 1}}]}"#;
        let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        assert!(stage.history().world().bonds().len() > AT_ONCE);
        let shown = |stage: &mut Stage| {
            let mut shown = Shown::default();
            stage.show(&mut shown);
            shown.figures.relaxed.unwrap()
        };
        stage.obey(Order::Play(false));
        let before = shown(&mut stage);
        assert_eq!(stage.patience(), None);
        let heavier = stage.history().world().masses().iter().map(|mass| 4.0 * mass).collect();
        let keys =
            SetKeys { points: Some((0..100).collect()), mass: Some(OneOrEach::Each(heavier)), ..SetKeys::default() };
        assert_eq!(stage.obey(Order::Give(vec![Do::Set(Box::new(keys))], Some("mass"))), None);
        assert_eq!(shown(&mut stage), before, "it may be dragged on");
        assert!(stage.patience().is_some_and(|left| left <= SOON) && !stage.idle(Instant::now() - SOON));
        assert!(stage.idle(Instant::now() + SOON), "there is something to be shown");
        let after = shown(&mut stage);
        assert!((after / before - 4.0).abs() < 0.1, "four times the mass: {before}, {after}");
        assert_eq!(stage.patience(), None);
    }

    #[test]
    fn what_is_done_to_bonds_and_masses_is_seen_at_once_and_what_moves_changes_nothing() {
        let text = r#"{"wobble": 1, "gravity": [0, -9.81], "points": {"position": [[0, 0], [0.5, 0], [1, 0]], "mass": 0.2, "pinned": [0]},
            "bonds": [{"a": 0, "b": 1, "kind": "relaxed", "relaxation": 0.1}, {"a": 1, "b": 2, "kind": "relaxed", "relaxation": 0.1}],
            "method": {"substep": 0.005, "iterations": 1}}"#;
        let mut history = History::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        let mut relaxed = Relaxed::default();
        let mut look = |history: &History| {
            relaxed.look(history);
            relaxed.stiffness().unwrap()
        };
        let first = look(&history);
        (0..20).for_each(|_| history.step());
        assert_eq!(look(&history), first);
        // Of the bond between two free ends of m/2, K = mu/h^2 (1 - q)/q.
        let stiffness = |mass: f64, share: f64| 0.5 * mass / 0.005_f64.powi(2) * share / (1.0 - share);
        assert!((first / stiffness(0.2, 0.1) - 1.0).abs() < 0.2, "{first}");
        let set = |keys: SetKeys| Do::Set(Box::new(keys));
        history
            .give(
                vec![set(SetKeys { points: Some(vec![1, 2]), mass: Some(OneOrEach::One(0.4)), ..SetKeys::default() })],
                Some("mass"),
            )
            .unwrap();
        let heavy = look(&history);
        assert!((heavy / first - 2.0).abs() < 0.05, "twice the mass: {first}, {heavy}");
        history
            .give(
                vec![set(SetKeys {
                    bonds: Some(vec![0, 1]),
                    relaxation: Some(OneOrEach::One(0.4)),
                    ..SetKeys::default()
                })],
                Some("k"),
            )
            .unwrap();
        let stiff = look(&history);
        assert!(stiff > 4.0 * heavy, "{heavy}, {stiff}");
        history
            .give(vec![Do::Cut { from: Cursor::at([0.25, -9.0]), to: Cursor::at([0.25, 9.0]) }], Some("cut"))
            .unwrap();
        assert_ne!(look(&history), stiff, "what is left is another bond");
    }
}
