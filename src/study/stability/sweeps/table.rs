//! The sweeps: what is swept, over which values, and how each is run.

use serde_json::{Value, json};

use super::Sweep;
use super::scenes::{
    bouncing, chain, complete, folded, heap, hung, lattice, moved, noisy, pushed, repeated, rests, squeezed, thrown,
};
use crate::scene::PrecisionName;
use crate::study::stability::subject::Rest;

/// A scene of a sweep and how it is run.
pub(super) struct Setup {
    pub(super) scene: Value,
    /// What a hand does meanwhile, as recordings have it.
    pub(super) commands: Vec<Value>,
    /// `[s]`
    pub(super) substep: f64,
    /// `auto` is held to the substep too.
    pub(super) is_forced: bool,
    /// `[s]`
    pub(super) seconds: f64,
    pub(super) precision: Option<PrecisionName>,
    pub(super) rest: Rest,
    /// It starts in its equilibrium.
    pub(super) is_laid: bool,
}

impl Setup {
    fn new(scene: Value, substep: f64) -> Self {
        Setup {
            scene,
            commands: Vec::new(),
            substep,
            is_forced: false,
            seconds: 2.0,
            precision: None,
            rest: Rest::Free,
            is_laid: false,
        }
    }
}

pub(super) const FRAME: f64 = 1.0 / 60.0;

/// All sweeps.
pub fn sweeps() -> &'static [Sweep] {
    &SWEEPS
}

static SWEEPS: [Sweep; 34] = [
    Sweep {
        name: "substep of springs",
        quantity: "substep [s]",
        values: &STEPS,
        home: 4,
        setup: |h| stepped(lattice(1e3), h),
    },
    Sweep {
        name: "substep of rigid bonds",
        quantity: "substep [s]",
        values: &STEPS,
        home: 4,
        setup: |h| stepped(chain(10, 1.0, None), h),
    },
    Sweep {
        name: "stiffness",
        quantity: "stiffness [N/m], 0.1 kg a point, substep 1/60 s",
        home: 3,
        values: &[1e-2, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e8, 1e10, 1e12],
        setup: |k| Setup::new(lattice(k), FRAME),
    },
    Sweep {
        name: "mass ratio of springs",
        quantity: "mass of the end over the others",
        values: &RATIOS,
        home: 0,
        // omega h = 0.33: the ratio alone is what may be too much.
        setup: |ratio| Setup::new(chain(6, ratio, Some(1e4)), FRAME / 32.0),
    },
    Sweep {
        name: "mass ratio of rigid bonds",
        quantity: "mass of the end over the others",
        values: &RATIOS,
        home: 0,
        setup: |ratio| Setup::new(chain(10, ratio, None), FRAME / 10.0),
    },
    Sweep {
        name: "coincident points, springs",
        quantity: "points at one place",
        values: &COUNTS,
        home: 0,
        setup: |n| Setup::new(heap(n as usize, Some(1e3)), FRAME / 8.0),
    },
    Sweep {
        name: "coincident points, rigid",
        quantity: "points at one place",
        values: &COUNTS,
        home: 0,
        setup: |n| Setup::new(heap(n as usize, None), FRAME / 8.0),
    },
    Sweep {
        name: "rest length",
        quantity: "rest length over distance",
        home: 4,
        values: &[0.0, 1e-9, 1e-3, 0.1, 1.0, 10.0, 1e2, 1e3, 1e6],
        setup: |f| Setup::new(rests(f, Some(1e3)), FRAME / 16.0),
    },
    Sweep {
        name: "rest length, rigid",
        quantity: "length over distance at the start",
        home: 4,
        values: &[0.0, 1e-9, 1e-3, 0.1, 1.0, 10.0, 1e2, 1e3, 1e6],
        setup: |f| Setup::new(rests(f, None), FRAME / 16.0),
    },
    Sweep {
        name: "repeated springs",
        quantity: "times that each bond is listed",
        values: &TIMES,
        home: 0,
        setup: |n| Setup::new(repeated(n as usize, Some(1e3)), FRAME / 16.0),
    },
    Sweep {
        name: "repeated rigid bonds",
        quantity: "times that each bond is listed",
        values: &TIMES,
        home: 0,
        setup: |n| Setup::new(repeated(n as usize, None), FRAME / 16.0),
    },
    Sweep {
        name: "complete graph, springs",
        quantity: "points",
        values: &GRAPHS,
        home: 0,
        setup: |n| Setup::new(complete(n as usize, 0.0, Some(1e3)), FRAME / 16.0),
    },
    Sweep {
        name: "complete graph, rigid",
        quantity: "points",
        values: &GRAPHS,
        home: 0,
        setup: |n| Setup::new(complete(n as usize, 0.0, None), FRAME / 16.0),
    },
    Sweep {
        name: "contradictory lengths",
        quantity: "share that lengths are off by",
        home: 0,
        values: &[0.0, 1e-9, 1e-6, 1e-3, 0.01, 0.1, 0.5],
        setup: |off| Setup::new(complete(8, off, None), FRAME / 16.0),
    },
    Sweep {
        name: "collapse to a point",
        quantity: "share of its size that is left",
        values: &SIZES,
        home: 6,
        setup: |s| Setup::new(squeezed(s, s), FRAME / 16.0),
    },
    Sweep {
        name: "collapse to a line",
        quantity: "share of its height that is left",
        values: &SIZES,
        home: 6,
        setup: |s| Setup::new(squeezed(1.0, s), FRAME / 16.0),
    },
    Sweep {
        name: "inside out",
        quantity: "way of a corner across its body [edges]",
        home: 0,
        values: &[0.0, 0.5, 1.0, 2.0, 5.0, 10.0],
        setup: |way| Setup::new(folded(way, Some(1e3)), FRAME / 16.0),
    },
    Sweep {
        name: "inside out, rigid",
        quantity: "way of a corner across its body [edges]",
        home: 0,
        values: &[0.0, 0.5, 1.0, 2.0, 5.0, 10.0],
        setup: |way| Setup::new(folded(way, None), FRAME / 16.0),
    },
    Sweep {
        name: "mouse that jumps",
        quantity: "strength [1/s^2]",
        home: 0,
        values: &[1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6],
        setup: |s| Setup::new(pushed(s, false), FRAME / 8.0),
    },
    Sweep {
        name: "mouse that jumps, rigid",
        quantity: "strength [1/s^2]",
        home: 0,
        values: &[1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6],
        setup: |s| Setup::new(pushed(s, true), FRAME / 8.0),
    },
    Sweep {
        name: "long frames, springs",
        quantity: "frame [s]: a hand is heard once in each",
        home: 0,
        values: &FRAMES,
        setup: |frame| led_by_hand(frame, Some(1e3)),
    },
    Sweep {
        name: "long frames, rigid",
        quantity: "frame [s]: a hand is heard once in each",
        home: 0,
        values: &FRAMES,
        setup: |frame| led_by_hand(frame, None),
    },
    Sweep {
        name: "thrown pin, springs",
        quantity: "jump a frame [m]",
        values: &JUMPS,
        home: 0,
        setup: |way| Setup::new(thrown(way, Some(1e3)), FRAME / 16.0),
    },
    Sweep {
        name: "thrown pin, rigid",
        quantity: "jump a frame [m]",
        values: &JUMPS,
        home: 0,
        setup: |way| Setup::new(thrown(way, None), FRAME / 16.0),
    },
    Sweep {
        name: "offset, 64 bits",
        quantity: "distance from the origin [m]",
        values: &OFFSETS,
        home: 0,
        setup: |x| Setup::new(moved(x), FRAME / 16.0),
    },
    Sweep {
        name: "offset, 32 bits",
        quantity: "distance from the origin [m]",
        values: &OFFSETS,
        home: 0,
        setup: |x| Setup { precision: Some(PrecisionName::F32), ..Setup::new(moved(x), FRAME / 16.0) },
    },
    Sweep {
        name: "minutes of springs",
        quantity: "simulated time [s]",
        values: &MINUTES,
        home: 0,
        setup: |t| Setup { seconds: t, ..Setup::new(chain(2, 1.0, Some(1e2)), FRAME / 4.0) },
    },
    Sweep {
        name: "minutes of rigid bonds",
        quantity: "simulated time [s]",
        values: &MINUTES,
        home: 0,
        setup: |t| Setup { seconds: t, ..Setup::new(chain(2, 1.0, None), FRAME / 4.0) },
    },
    Sweep {
        name: "noise on a hard mesh",
        quantity: "speed of the noise [m/s]",
        home: 0,
        values: &[1e-6, 1e-3, 1e-2, 0.1, 1.0, 10.0],
        setup: |v| Setup { seconds: 10.0, ..Setup::new(noisy(v), FRAME / 4.0) },
    },
    Sweep {
        name: "thrown at walls, rigid",
        quantity: "speed [m/s], restitution 1",
        home: 0,
        values: &[1.0, 10.0, 50.0, 200.0, 1e3],
        setup: |v| Setup::new(bouncing(v), FRAME / 16.0),
    },
    Sweep {
        name: "rest",
        quantity: "stiffness [N/m] of what starts in its equilibrium",
        home: 1,
        values: &[1e2, 1e3, 1e4, 1e6, 1e8],
        setup: |k| Setup { rest: Rest::Stays, is_laid: true, ..Setup::new(lattice(k), FRAME / 16.0) },
    },
    Sweep {
        name: "rest, rigid",
        quantity: "links of a rope that hangs in its equilibrium",
        home: 0,
        values: &[1.0, 2.0, 5.0, 10.0, 20.0, 50.0],
        setup: |links| Setup { rest: Rest::Stays, ..Setup::new(hung(links as usize), FRAME / 16.0) },
    },
    Sweep {
        name: "coming to rest, springs",
        quantity: "drag rate [1/s]",
        home: 1,
        values: &[1.0, 3.0, 10.0, 30.0, 100.0],
        setup: |rate| damped(lattice(1e2), rate),
    },
    Sweep {
        name: "coming to rest, rigid",
        quantity: "drag rate [1/s]",
        home: 1,
        values: &[1.0, 3.0, 10.0, 30.0],
        setup: |rate| damped(chain(5, 1.0, None), rate),
    },
];

const STEPS: [f64; 10] = [1e-6, 1e-5, 1e-4, 2.5e-4, 1e-3, 4e-3, FRAME, 1.0 / 16.0, 0.25, 1.0];
const RATIOS: [f64; 7] = [1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6];
const COUNTS: [f64; 5] = [2.0, 3.0, 5.0, 10.0, 30.0];
const TIMES: [f64; 5] = [1.0, 2.0, 4.0, 16.0, 64.0];
const GRAPHS: [f64; 6] = [3.0, 4.0, 6.0, 10.0, 16.0, 32.0];
const SIZES: [f64; 7] = [0.0, 1e-8, 1e-4, 0.01, 0.1, 0.5, 1.0];
const JUMPS: [f64; 6] = [1e-3, 0.01, 0.1, 1.0, 10.0, 100.0];
const OFFSETS: [f64; 6] = [0.0, 1e2, 1e3, 1e4, 1e5, 1e6];
const FRAMES: [f64; 5] = [FRAME, 0.05, 0.1, 0.3, 1.0];
const MINUTES: [f64; 4] = [1.0, 10.0, 60.0, 600.0];

/// Substeps of a run with a substep of its own: at least so many, and at most as many as 2 s or this have.
const FEWEST_STEPS: f64 = 20.0;
const MOST_STEPS: f64 = 20_000.0;

fn stepped(scene: Value, h: f64) -> Setup {
    let seconds = (MOST_STEPS * h).min(2.0).max(FEWEST_STEPS * h);
    Setup { is_forced: true, seconds, ..Setup::new(scene, h) }
}

/// A scene with drag, for so long that any motion of it is over: a swing of the slowest dies out as exp(-rate t/2), and where drag is
/// so strong that it creeps, within 3 s.
fn damped(mut scene: Value, rate: f64) -> Setup {
    scene["drag_rate"] = json!(rate);
    Setup { rest: Rest::Comes, seconds: 20.0, ..Setup::new(scene, FRAME / 4.0) }
}

/// A rope that a hand leads by its end, as a window hears it that shows a frame in so long: the cursor goes straight on until the
/// next one. Substeps are as long as ever.
fn led_by_hand(frame: f64, stiffness: Option<f64>) -> Setup {
    let at = |time: f64| [1.0 + 0.5 * libm::sin(4.0 * time), 0.5 * libm::sin(7.0 * time)];
    let mut commands =
        vec![json!({ "at": 0.0, "do": "cursor", "to": at(0.0) }), json!({ "at": 0.0, "do": "grab", "within": 0.3 })];
    let seconds = 5.0;
    let count = libm::round(seconds / frame) as u32;
    for k in 1..count {
        let time = f64::from(k) * frame;
        commands.push(json!({ "at": time, "do": "cursor", "to": at(time), "by": time + frame }));
    }
    Setup { commands, seconds, ..Setup::new(chain(8, 1.0, stiffness), FRAME / 16.0) }
}
