//! What a substep of a group costs, by counting: settings are compared by it, never by a clock.

use crate::sim::force::wind::OF_A_GUST;
use crate::sim::group::engine::Engine;
use crate::sim::group::{Group, Work};
use crate::sim::integrate::implicit::USUAL_ROUNDS;
use crate::sim::integrate::splitting::Part;
use crate::sim::real::Real;

/// Multiplications, additions and the like of one substep, about.
///
/// Weights were fitted to measured times of small scenes: a spring costs as much as about 30 multiplications (a square
/// root and a division), a point that is moved about 8 for each dimension, a call about 20.
pub(crate) fn of<S: Real, const D: usize>(group: &Group<S, D>) -> f64 {
    of_engine(group, &group.engine)
}

/// The same of all that a group does.
pub(crate) fn work<S: Real, const D: usize>(group: &Group<S, D>) -> Work {
    let contacts = &group.pull.contacts;
    // To each surface a distance is looked at; walls are in a grid, and cost as much as one more.
    let surfaces = contacts.obstacles.planes().len() + usize::from(contacts.obstacles.has_walls());
    let looks = surfaces + usize::from(!group.edges.is_empty());
    Work {
        step: of(group) as u64,
        robust: of_engine(group, group.robust.as_deref().unwrap_or(&group.engine)) as u64,
        look: (20 + 4 * D * group.points.len() * looks) as u64,
        batch: group.work.batch,
    }
}

fn of_engine<S: Real, const D: usize>(group: &Group<S, D>, engine: &Engine<S, D>) -> f64 {
    let pull = &group.pull;
    let points = group.points.len() as f64 * D as f64;
    // An angle costs about four springs, most of it the arc tangent.
    let form = 120.0 * pull.form.hinges.len() as f64 + 30.0 * pull.form.patches.len() as f64;
    let gusts = if pull.gusts().is_some() { OF_A_GUST as f64 * group.points.len() as f64 } else { 0.0 };
    let force = 20.0 + 30.0 * pull.springs.len() as f64 + form + gusts + 4.0 * points;
    let hold = pull.rigid.as_ref().map_or(0.0, |rigid| 12.0 * rigid.work() as f64 + 40.0);
    match engine {
        Engine::Splitting(splitting) => splitting.parts().iter().fold(40.0, |sum, part| {
            sum + match part {
                Part::Kick(_) => force + 4.0 * points,
                Part::Flight(_) => 10.0 * points,
            }
        }),
        Engine::KickDrift(method, shares) => {
            let swept = method.swept.relaxed.len() * method.swept.iterations as usize + 50 * method.swept.rigid.len();
            shares.len() as f64 * (2.0 * force + 30.0 * points + 4.0 * hold + 20.0 * swept as f64)
        }
        Engine::RungeKutta(table, ..) => {
            let stages = table.stages.len() as f64;
            let terms: usize = table.stages.iter().map(|row| row.len()).sum();
            stages * (force + hold + 2.0 * points) + 2.0 * terms as f64 * points + 2.0 * hold
        }
        Engine::Projected => force + 20.0 * points + 4.0 * hold,
        Engine::Implicit(implicit) => USUAL_ROUNDS as f64 * (force + implicit.work() as f64 + 8.0 * points),
        Engine::Bulk(bulk) if bulk.kernel().is_of_rigid_bodies() => 100.0 + 30.0 * points,
        Engine::Bulk(bulk) => 40.0 * bulk.bonds() as f64 + 10.0 * points,
        Engine::Xpbd(bonds, sweeps, _) => force + 20.0 * points + 40.0 * bonds.len() as f64 * f64::from(*sweeps),
    }
}
