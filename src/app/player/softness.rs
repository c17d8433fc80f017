//! What relaxed bonds amount to at the method under way: worked out when a scene opens and whenever its method changes.

use crate::equilibrium::{MOST_SOFT, Softness, softness};
use crate::history::History;
use crate::scene::{MethodKeys, Scene};
use crate::sim::{BondKind, Dynamics};

/// Of the method that it was worked out for last.
#[derive(Clone, Debug, Default)]
pub(super) struct Relaxed {
    method: Option<MethodKeys>,
    softness: Option<Softness>,
}

impl Relaxed {
    /// Works it out, if the method is another. Where there is nothing to be measured no model is made, which of large scenes takes long.
    pub(super) fn look(&mut self, history: &History) {
        let method = history.method();
        if self.method.as_ref() != Some(&method) {
            let scene = || Scene { method: method.clone(), ..history.scene().clone() };
            self.softness = if is_soft(history.world()) { of(&scene()) } else { None };
            self.method = Some(method);
        }
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

fn of(scene: &Scene) -> Option<Softness> {
    match scene.dimensions() {
        2 => softness(&scene.model::<2>().ok()?),
        _ => softness(&scene.model::<3>().ok()?),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::player::movers::with;
    use crate::history::Start;

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
}
