//! What relaxed bonds amount to at the method under way: worked out when a scene opens and whenever its method changes.

use crate::equilibrium::{Softness, softness};
use crate::history::History;
use crate::scene::{MethodKeys, Scene};

/// Of the method that it was worked out for last.
#[derive(Clone, Debug, Default)]
pub(super) struct Relaxed {
    method: Option<MethodKeys>,
    softness: Option<Softness>,
}

impl Relaxed {
    /// The stiffness of springs that would give way as much `[N/m]`; `None` where no bond takes a share of its error.
    pub(super) fn look(&mut self, history: &History) -> Option<f64> {
        let method = history.method();
        if self.method.as_ref() != Some(&method) {
            self.softness = of(&Scene { method: method.clone(), ..history.scene().clone() });
            self.method = Some(method);
        }
        self.softness.map(|softness| softness.stiffness)
    }
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
        let once = relaxed.look(&history).unwrap();
        assert!((once / stiffness(0.95) - 1.0).abs() < 1e-3, "{once}");
        history.give(vec![with(MethodKeys { iterations: Some(3), ..history.method() })], None).unwrap();
        let thrice = relaxed.look(&history).unwrap();
        assert!((thrice / stiffness(0.95_f64.powi(3)) - 1.0).abs() < 0.02, "{thrice}");
        let rigid: Start = Scene::of_gallery("rim", "test").unwrap().into();
        assert_eq!(Relaxed::default().look(&History::new(rigid).unwrap()), None);
    }
}
