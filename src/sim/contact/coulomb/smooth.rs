//! Contacts without friction that answer to each other, as strings do that are taut at once: which of them press, and with what, together.
//!
//! ```text
//! P >= 0,   W P >= lacks,   P (W P - lacks) = 0        W: what impulses of 1 change of all velocities, symmetric
//! ```
//!
//! The contact that lacks most joins those that press, which are solved for exactly; those that would have to pull leave them. One that
//! repeats others takes the place of one of them, or, where it contradicts them, is left out.
//! Source: C. L. Lawson and R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23.

/// Share of what a contact gives by itself below which it repeats those that press.
const REPEATS: f64 = 1e-10;

/// The impulses `[kg m/s]` of contacts that lack these velocities `[m/s]`; what lacks no more than `nothing` lacks none.
pub(super) fn pressed(gives: &[Vec<f64>], lacks: &[f64], nothing: f64) -> Vec<f64> {
    let mut set = Pressing { gives, lacks, list: Vec::new(), lower: Vec::new(), impulses: vec![0.0; lacks.len()] };
    let mut is_left_out = vec![false; lacks.len()];
    for _ in 0..4 * lacks.len() + 4 {
        let most = (0..lacks.len())
            .filter(|k| !is_left_out[*k] && !set.list.contains(k))
            .map(|k| (k, lacks[k] - product(&gives[k], &set.impulses)))
            .filter(|(_, lack)| *lack > nothing)
            .max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((next, _)) = most else { break };
        if set.joins(next) {
            set.settle();
        } else {
            is_left_out[next] = true;
        }
    }
    set.impulses
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Contacts that press.
struct Pressing<'a> {
    gives: &'a [Vec<f64>],
    lacks: &'a [f64],
    /// In the order in which they joined, and the rows of Cholesky's factor of what they give each other.
    list: Vec<usize>,
    lower: Vec<Vec<f64>>,
    impulses: Vec<f64>,
}

impl Pressing<'_> {
    /// Whether another one is of them now: in the place of one that it repeats, where that has to be.
    fn joins(&mut self, next: usize) -> bool {
        if self.factor(next) {
            return true;
        }
        // What it does the others do by these shares.
        let couples: Vec<f64> = self.list.iter().map(|&of| self.gives[next][of]).collect();
        let shares = self.solve(couples);
        let ways = self.list.iter().zip(&shares).filter(|(_, share)| **share > REPEATS);
        let least = ways.map(|(&of, share)| (of, self.impulses[of] / share)).min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((gone, way)) = least else { return false };
        self.list.iter().zip(&shares).for_each(|(&of, share)| self.impulses[of] -= way * share);
        self.impulses[next] = way;
        self.leave(|of| of == gone);
        self.factor(next)
    }

    /// They press as they have to; those that would pull leave, one after the other as they come to that.
    fn settle(&mut self) {
        while !self.list.is_empty() {
            let aims = self.solve(self.list.iter().map(|&of| self.lacks[of]).collect());
            let turns = self.list.iter().zip(&aims).filter(|(_, aim)| **aim < 0.0);
            let share = |(&of, aim): (&usize, &f64)| self.impulses[of] / (self.impulses[of] - aim);
            let first = turns.map(|turn| (*turn.0, share(turn))).min_by(|a, b| a.1.total_cmp(&b.1));
            let share = first.map_or(1.0, |(_, share)| share);
            for (&of, aim) in self.list.iter().zip(&aims) {
                self.impulses[of] =
                    if share < 1.0 { self.impulses[of] + share * (aim - self.impulses[of]) } else { *aim };
            }
            let Some((gone, _)) = first else { return };
            self.leave(|of| of == gone);
        }
    }

    /// A row for another one; false: it repeats those that there are.
    fn factor(&mut self, next: usize) -> bool {
        let mut row: Vec<f64> = Vec::with_capacity(self.list.len() + 1);
        for (&of, lower) in self.list.iter().zip(&self.lower) {
            let left = self.gives[next][of] - product(&row, lower);
            row.push(left / lower[row.len()]);
        }
        let own = self.gives[next][next];
        let left = own - product(&row, &row);
        if left <= REPEATS * own {
            return false;
        }
        row.push(left.sqrt());
        self.lower.push(row);
        self.list.push(next);
        true
    }

    fn leave(&mut self, is_gone: impl Fn(usize) -> bool) {
        for of in std::mem::take(&mut self.list) {
            if is_gone(of) {
                self.impulses[of] = 0.0;
            } else {
                self.list.push(of);
            }
        }
        self.lower.clear();
        for of in std::mem::take(&mut self.list) {
            if !self.factor(of) {
                self.impulses[of] = 0.0;
            }
        }
    }

    /// The impulses of all of them that change their velocities by so much.
    fn solve(&self, mut of: Vec<f64>) -> Vec<f64> {
        for (k, row) in self.lower.iter().enumerate() {
            of[k] = (of[k] - product(&row[..k], &of)) / row[k];
        }
        for k in (0..of.len()).rev() {
            let known: f64 = (k + 1..of.len()).map(|l| self.lower[l][k] * of[l]).sum();
            of[k] = (of[k] - known) / self.lower[k][k];
        }
        of
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_pulled_apart_by_the_others_presses_alone() {
        let gives = vec![vec![1.0, 0.9], vec![0.9, 1.0]];
        assert_eq!(pressed(&gives, &[1.0, 0.5], 0.0), vec![1.0, 0.0]);
        let both = pressed(&gives, &[1.0, 1.0], 0.0);
        assert!(both.iter().all(|push| (push - 1.0 / 1.9).abs() < 1e-12), "{both:?}");
    }

    #[test]
    fn one_that_repeats_others_takes_the_place_of_one_and_one_that_contradicts_them_is_left_out() {
        // Rows 1, 2 and (1 + 2)/2 of a plane.
        let gives = vec![vec![1.0, 0.0, 0.5], vec![0.0, 1.0, 0.5], vec![0.5, 0.5, 0.5]];
        let three = pressed(&gives, &[1.0, 0.2, 0.8], 0.0);
        let after: Vec<f64> = gives.iter().map(|row| product(row, &three)).collect();
        let lacks = [1.0, 0.2, 0.8];
        for k in 0..3 {
            assert!(three[k] >= 0.0 && after[k] >= lacks[k] - 1e-12, "{three:?} {after:?}");
            assert!(three[k] * (after[k] - lacks[k]) < 1e-12, "{three:?} {after:?}");
        }
        let against = vec![vec![1.0, -1.0], vec![-1.0, 1.0]];
        let pushes = pressed(&against, &[1.0, 1.0], 0.0);
        assert!(pushes.iter().all(|push| push.is_finite() && *push <= 1.0), "{pushes:?}");
    }
}
