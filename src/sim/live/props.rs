//! What bodies are pressed by from behind: obstacles and pins, and what is itself pressed so.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use super::cluster::{Cluster, Common, OBSTACLE};
use super::pair::Beside;
use crate::sim::real::Real;
use crate::sim::vector::scale;

/// Least cosine between what presses a light body on one side and on the other.
const OPPOSITE: f64 = 0.85;
/// Pushes on a body that are told apart: those of as many directions.
const DIRECTIONS: u32 = 64;

/// For each direction those that are about the same: a bit for each.
static ABOUT: LazyLock<[u64; DIRECTIONS as usize]> = LazyLock::new(|| {
    let is_about = |between: u32| libm::cos(TAU * f64::from(between) / f64::from(DIRECTIONS)) > OPPOSITE;
    let about =
        |way: u32| (0..DIRECTIONS).filter(|&other| is_about(way.abs_diff(other))).fold(0, |set, k| set | 1_u64 << k);
    std::array::from_fn(|way| about(way as u32))
});

/// The direction nearest to a vector.
fn direction<S: Real>(way: [S; 2]) -> u32 {
    let turns = libm::atan2(way[1].to_f64(), way[0].to_f64()) / TAU + 1.0;
    (turns * f64::from(DIRECTIONS) + 0.5) as u32 % DIRECTIONS
}

/// Two that press each other, and how they lie.
#[derive(Clone, Copy)]
pub(super) struct Met<S> {
    pub(super) pair: u32,
    pub(super) found: Beside<S>,
}

/// What stands behind each body of a cluster: what does not move, or what is itself pressed by such.
pub(super) struct Props<S> {
    /// From which directions each is pressed by it: a bit for each.
    ways: Vec<u64>,
    /// The largest friction that holds it there.
    grips: Vec<S>,
}

impl<S: Real> Props<S> {
    pub(super) fn of(state: &Cluster<S>, common: &Common<S>, met: &[Met<S>]) -> Self {
        let count = state.bodies.len();
        let mut props = Props { ways: vec![0; count], grips: vec![S::ZERO; count] };
        for on in state.on_planes.iter().filter(|on| on.contact.pressed > S::ZERO) {
            let [friction, _] = on.surface(common);
            props.add(state.body_of[on.p as usize], on.normal, friction);
        }
        let pushes: Vec<Push<S>> = met.iter().flat_map(|met| pushes(state, met)).collect();
        let mut changes = true;
        while changes {
            changes = false;
            for &Push { by, on, way, friction } in &pushes {
                if by == OBSTACLE {
                    changes |= props.add(on, way, friction);
                } else if props.has(by, way) {
                    changes |= props.add(on, way, friction.min(props.grip(by)));
                }
            }
        }
        props
    }

    /// A body is pressed this way, with this friction. Returns whether that is new.
    fn add(&mut self, body: u32, way: [S; 2], friction: S) -> bool {
        let bit = 1_u64 << direction(way);
        let (ways, grip) = (&mut self.ways[body as usize], &mut self.grips[body as usize]);
        let is_new = *ways & bit == 0 || *grip < friction;
        *ways |= bit;
        *grip = grip.max(friction);
        is_new
    }

    /// The largest friction that holds a body there.
    pub(super) fn grip(&self, body: u32) -> S {
        self.grips[body as usize]
    }

    /// Whether a body is pressed about this way.
    pub(super) fn has(&self, body: u32, way: [S; 2]) -> bool {
        self.ways[body as usize] & ABOUT[direction(way) as usize] != 0
    }
}

/// A body, or an obstacle, pushes another.
#[derive(Clone, Copy)]
struct Push<S> {
    by: u32,
    on: u32,
    way: [S; 2],
    friction: S,
}

/// How the two of a pair push each other; obstacles are pushed by nothing.
fn pushes<S: Real>(state: &Cluster<S>, &Met { pair, found }: &Met<S>) -> impl Iterator<Item = Push<S>> + use<S> {
    let pair = &state.pairs[pair as usize];
    let [p, a, b] = pair.places();
    // What is pinned there is as good as an obstacle.
    let by = |i: usize, is_fixed: bool| if is_fixed { OBSTACLE } else { state.body_of[i] };
    let of_point = by(p, state.w[p] == S::ZERO);
    let of_edge = by(a, state.w[a] == S::ZERO && state.w[b] == S::ZERO);
    let friction = pair.friction;
    let both = [
        Push { by: of_edge, on: of_point, way: found.normal, friction },
        Push { by: of_point, on: of_edge, way: scale(found.normal, -S::ONE), friction },
    ];
    both.into_iter().filter(|push| push.on != OBSTACLE)
}
