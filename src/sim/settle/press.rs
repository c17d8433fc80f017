//! Which surfaces press and which one-way bonds are taut.

use super::descent::Descent;
use super::hold::Hold;
use crate::sim::bond::Limit;

impl<const D: usize> Descent<D> {
    /// Points that went into a surface are held to it; those that it would have to pull are let go.
    pub(super) fn revise(&mut self, lambda: &[f64]) {
        if self.surfaces.is_empty() && self.limited.is_empty() {
            return;
        }
        let before = self.pressed.len();
        let first = self.rigid.len();
        let mut kept = Vec::new();
        for (k, &hold) in self.pressed.iter().enumerate() {
            // lambda balances the force along the normal or the bond: a surface can only push, a string only pull.
            let limit = self.limited.iter().find(|limited| limited.0 == hold).map(|limited| limited.1);
            let is_right = if limit == Some(Limit::Max) { lambda[first + k] >= 0.0 } else { lambda[first + k] <= 0.0 };
            if is_right {
                kept.push(hold);
            }
        }
        let mut changed = kept.len() != before;
        for (surface, plane) in self.surfaces.iter().enumerate() {
            for point in (0..self.x.len()).filter(|&i| self.is_free[i]) {
                let holds = |hold: &Hold| matches!(hold, Hold::Surface { point: p, surface: s } if *p == point && *s == surface);
                if plane.gap(self.x[point]) < -plane.slack() && !kept.iter().any(holds) {
                    kept.push(Hold::Surface { point, surface });
                    changed = true;
                }
            }
        }
        for &(hold, limit) in &self.limited {
            let off = self.off(hold, &self.x).0;
            let is_over = if limit == Limit::Max { off > 1e-14 } else { off < -1e-14 };
            if is_over && !kept.contains(&hold) {
                kept.push(hold);
                changed = true;
            }
        }
        if changed {
            self.pressed = kept;
            self.lambda.truncate(first);
            self.arrange();
            self.is_done = false;
        }
    }
}
