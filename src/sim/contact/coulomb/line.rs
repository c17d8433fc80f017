//! Friction in the plane, where it acts along one line.

use super::{Friction, Impulse, REPEATED, Rub};

/// Friction along a line.
pub(crate) struct Line;

impl Friction<2> for Line {
    const MOST_PASSES: u32 = 100;
    const OF_A_CONTACT: u64 = 40;

    #[inline]
    fn solve(gives: &[Impulse; 2], rub: &Rub, old: Impulse, [normal, speed]: [f64; 2]) -> Impulse {
        let [[across, _], [both, along]] = *gives;
        if across <= 0.0 {
            return old;
        }
        let [target, hold] = rub.target;
        let rubbed = rub.slides[1] * rub.friction;
        // Where friction that goes along with what presses lifts the point more than that does, it is held instead (Painlevé).
        let eased = across - rubbed * both;
        if rub.is_sliding() && eased > 0.0 {
            let push = (old[0] + (target - normal) / eased).max(0.0);
            return [push, -rubbed * push];
        }
        // What it lacks without an impulse of its own.
        let lacks = [target - normal + across * old[0] + both * old[1], hold - speed + both * old[0] + along * old[1]];
        if lacks[0] <= 0.0 {
            return [0.0; 2];
        }
        let held = across * along - both * both;
        if held > REPEATED * across * along {
            let stuck = [along * lacks[0] - both * lacks[1], across * lacks[1] - both * lacks[0]].map(|x| x / held);
            if stuck[0] >= 0.0 && stuck[1].abs() <= rub.friction * stuck[0] {
                return stuck;
            }
            for side in [stuck[1].signum(), -stuck[1].signum()] {
                let push = lacks[0] / (across + side * rub.friction * both);
                let slip = (both + side * rub.friction * along) * push - lacks[1];
                if push >= 0.0 && push.is_finite() && slip * side <= 0.0 {
                    return [push, side * rub.friction * push];
                }
            }
        }
        let push = (old[0] + (target - normal) / across).max(0.0);
        let after = speed + both * (push - old[0]);
        let most = rub.friction * push;
        let wanted = if along > 0.0 { old[1] + (hold - after) / along } else { 0.0 };
        // What is no number stays none, and is seen as that.
        [push, wanted.max(-most).min(most)]
    }
}
