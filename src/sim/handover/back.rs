//! Islands that the live step moves go back to their own methods.

use crate::sim::environment::Environment;
use crate::sim::group::Group;
use crate::sim::group::engine::Engine;
use crate::sim::measure;
use crate::sim::plan::OWN;
use crate::sim::plan::choice::LARGE_STRAIN;
use crate::sim::real::Real;
use crate::sim::vector::{length, sub, widen};
use crate::sim::world::World;

/// Most islands that are tried in a frame: each is compiled.
const MOST_TRIED: usize = 16;
/// How far points may be put, as a share of the size of the island.
const MOST_WAY: f64 = 1e-3;
/// How far rigid bonds may put points, as a share of their mean length.
const MOST_SHIFT: f64 = 1e-3;
/// Share of the kinetic and elastic energy that may come with it.
const MOST_RAISE: f64 = 1e-3;

impl<S: Real, const D: usize> World<S, D> {
    /// Islands that were live for long enough by `t` `[s]` go back, if their own methods take them as they are.
    pub(super) fn hand_back(&mut self, t: f64) {
        let is_due = |group: &Group<S, D>| group.is_live() && !group.is_asleep() && group.moved.until <= t;
        let groups = self.plan.groups.iter().enumerate();
        let due: Vec<usize> =
            groups.filter(|(_, group)| is_due(group)).map(|(place, _)| place).take(MOST_TRIED).collect();
        for place in due {
            let around = self.around.clone();
            let leads_out = matches!(&self.plan.groups[place].engine, Engine::Bulk(mover) if mover.leads_out());
            let parts = if leads_out { None } else { self.parted(place) };
            let is_put = parts
                .as_ref()
                .is_some_and(|parts| self.put_back_exactly(place, parts, |old, new, way| fits(&around, old, new, way)));
            if !is_put {
                self.plan.groups[place].moved.put_off(t);
            } else if parts.is_some_and(|numbers| numbers.is_empty() || numbers.contains(&OWN)) {
                self.counters.returns += 1;
            }
        }
    }
}

/// Whether an island may go on as these groups, whose points would be put `way` `[m]` from where they are.
fn fits<S: Real, const D: usize>(around: &Environment<D>, old: &Group<S, D>, new: &[Group<S, D>], way: f64) -> bool {
    let Some([low, high]) = measure::extent(&old.points.position) else { return false };
    let size = length(widen(sub(high, low)));
    let edge = old.watch.as_ref().map_or(0.0, |watch| watch.edge);
    let are_large = new.iter().any(|group| matches!(group.engine, Engine::Bulk(_)));
    let before = old.energy_and_strain(around);
    let most = (MOST_WAY * size).min(if before.strain > 0.0 { MOST_SHIFT * edge } else { f64::INFINITY });
    // Joints that are beyond their ranges would be pushed back by springs.
    let stops: f64 = new.iter().map(|group| group.pull.form.stopped(&group.points.position).to_f64()).sum();
    let after: f64 = new.iter().map(|group| group.energy_and_strain(around).total()).sum::<f64>() + stops;
    let allowed = before.total() + MOST_RAISE * (before.kinetic + before.elastic) + before.rounding;
    // Large bodies mend the strain that they start with as they go.
    way <= most && after <= allowed && !(are_large && before.strain > LARGE_STRAIN)
}
