//! Which method an island gets: fixed rules on what it is made of, the same on every machine.

use super::island::Island;
use crate::sim::bulk::Way;
use crate::sim::bulk::control::FRAME;
use crate::sim::model::Method;
use crate::sim::sizes::{
    LARGE, MOST_COUPLINGS, MOST_DIRECT, MOST_FINE_RODS, MOST_IMPLICIT, MOST_LOCATED_RODS, MOST_STIFF_STRUCK,
    MOST_SUBSTEPS, MOST_SWEPT_TREE, MOST_TOUCHES, MOST_TOUCHING, STIFF, STIFF_OF_A_NET,
};
use crate::sim::solver::{Order, Solver};

/// Largest substep where nothing is fast `[s]`: what a thrown point or a swinging rope needs to look smooth.
const LONGEST: f64 = FRAME / 4.0;
/// Largest substep with rigid bonds `[s]`: a rope stays within 1e-3 of its path for a second or two.
const LONGEST_RIGID: f64 = FRAME / 16.0;
/// Angle in radians that the fastest oscillation may turn in a substep of Verlet's method. Its period is then off by
/// 0.25^2/24 = 0.26 %; 2 would be the edge of stability.
const PHASE: f64 = 0.25;
/// The same for methods of order 4: a period off by about 1e-5; 2.8 would be the edge.
const PHASE_4: f64 = 0.5;
/// The same for one of order 8, off by about 1e-5; 5 would be the edge. And its longest substep `[s]`: what turns faster is seen by its error.
const PHASE_8: f64 = 1.5;
pub(crate) const LONGEST_FINE: f64 = FRAME / 2.0;
/// Strain that rigid bonds of a large island may have where nothing is said `[1]`.
pub(crate) const LARGE_STRAIN: f64 = 0.02;
/// The same of an island of at most [`MOST_DIRECT`].
const SMALL_STRAIN: f64 = 1e-6;
/// Least strain that paths are meant for `[1]`: below, solving all bonds together is cheaper.
const LEAST_STRAIN: f64 = 1e-5;

/// Strain that the rigid bonds of a larger one may have where nothing is said `[1]`.
const TOUCHING_STRAIN: f64 = 1e-4;
/// The angle from which on a substep that is given is too long for explicit methods of order 4, let alone for Verlet's: what swings so fast
/// grows without bounds.
const EDGE: f64 = 2.8;
/// What [`PHASE`] is for large meshes of springs: their fastest oscillations are of single cells, which nobody follows.
const PHASE_MESH: f64 = 0.5;
/// Counted work of a spring in a substep of order 4, about.
const OF_A_SPRING: f64 = 160.0;
/// Share of a decay that a substep of Verlet's method may span where springs only push: 2 would be the edge of stability.
const DECAY_SHARE: f64 = 0.9;

/// What moves an island.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Choice {
    pub(crate) solver: Solver,
    /// Longest substep `[s]`.
    pub(crate) substep: f64,
    /// Rigid bonds are solved together, not swept.
    pub(crate) is_direct: bool,
    /// Steps whose error is seen to be large are cut, and what stays violent is RATTLE's, in substeps of at most this `[s]`.
    pub(crate) plain: Option<f64>,
    /// Moved as a large body.
    pub(crate) bulk: Option<Scheme>,
}

/// How a large body is moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scheme {
    pub(crate) way: Way,
    /// Largest strain that substeps follow `[1]`; `None`: the substep is given.
    pub(crate) target: Option<f64>,
    /// Longest substep where a step takes several `[s]`.
    pub(crate) longest: Option<f64>,
}

/// What the rules ask of the surroundings.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting {
    pub(crate) has_surfaces: bool,
    /// Strength of the mouse force `[1/s^2]`, if there is one.
    pub(crate) mouse: Option<f64>,
    pub(crate) drag_rate: f64,
    /// How fast gusts of wind change where a point is `[rad/s]`, if there are any.
    pub(crate) gusts: Option<f64>,
    /// Points of the scene.
    pub(crate) points: usize,
}

/// The method and the substep of an island.
pub(crate) fn choose(island: &Island, method: &Method, setting: Setting) -> Choice {
    if island.pieces.is_some() {
        let substep = method.substep.unwrap_or(FRAME);
        return Choice { solver: Solver::Rigid, substep, is_direct: false, plain: None, bulk: None };
    }
    if let Solver::AsPrinted(source) = method.solver {
        let substep = method.substep.unwrap_or(source.substep());
        return Choice { solver: method.solver, substep, is_direct: false, plain: None, bulk: None };
    }
    let is_direct = can_be_direct(island);
    let solver = match method.solver {
        Solver::Auto => pick(island, method.substep, setting, is_direct),
        given => given,
    };
    let mut bulk = scheme(island, method, setting, is_direct);
    let way = bulk.map(|scheme| scheme.way);
    let solver = if way == Some(Way::Paths) { Solver::Path } else { solver };
    let plain = (method.solver == Solver::Auto && solver == Solver::Rk8)
        .then(|| substep(island, Solver::VelocityVerlet, setting));
    let longest = || if plain.is_some() { fine_substep(island) } else { substep(island, solver, setting) };
    let substep = match (way, method.substep) {
        (_, Some(given)) => given,
        (Some(Way::Paths), None) => FRAME,
        // Between the substeps of a frame nobody looks.
        (Some(Way::Forces), None) => {
            bulk = bulk.map(|scheme| Scheme { longest: Some(longest()), ..scheme });
            FRAME
        }
        (_, None) => longest(),
    };
    // Areas are held by that alone.
    let solves = solver.solves_directly() || (solver == Solver::Verlet && island.holds_areas);
    Choice { solver, substep, is_direct: is_direct && solves && bulk.is_none(), plain, bulk }
}

/// Whether the rigid bonds of an island are few enough to be solved together. Those of a tree always are, since eliminating
/// them from the leaves on leaves nothing behind; a long path is better off by itself.
pub(crate) fn can_be_direct(island: &Island) -> bool {
    let has_room = island.rigid <= MOST_DIRECT || (island.is_tree && !is_path(island));
    let couplings = MOST_COUPLINGS.max(MOST_COUPLINGS / MOST_DIRECT * island.rigid);
    has_room && island.couplings <= if island.is_tree { couplings } else { MOST_COUPLINGS }
}

/// Whether the rigid bonds of a tree make a path.
fn is_path(island: &Island) -> bool {
    island.fullest <= 2
}

/// Whether and how an island is moved as a large body.
fn scheme(island: &Island, method: &Method, setting: Setting, is_direct: bool) -> Option<Scheme> {
    let has_order = matches!(method.order, Order::Auto | Order::Coloured);
    let is_large = island.bonds.len() > MOST_DIRECT && has_order;
    let is_large_tree = island.is_tree && is_direct && !is_path(island) && island.rigid > MOST_SWEPT_TREE;
    let is_loose = method.max_strain.is_some_and(|strain| strain >= LEAST_STRAIN) && !is_large_tree;
    let sweeps = Way::Sweeps(method.iterations.unwrap_or(1));
    let touches = setting.has_surfaces && island.rigid > MOST_LOCATED_RODS;
    let follows = |way| {
        let default = match island.rigid {
            rigid if rigid > MOST_DIRECT => LARGE_STRAIN,
            _ if touches => TOUCHING_STRAIN,
            _ => SMALL_STRAIN,
        };
        let target = method.max_strain.unwrap_or(default);
        Some(Scheme { way, target: method.substep.is_none().then_some(target), longest: None })
    };
    let given = |way| Some(Scheme { way, target: None, longest: None });
    let are_springs = island.springs == island.bonds.len() && !island.has_limits && !island.has_round_dampers;
    match method.solver {
        // Large bodies know neither angles nor areas, nor drives, nor surfaces that push by depth.
        _ if island.bonds.is_empty() || island.has_form() || island.has_drives || island.is_pressed => None,
        Solver::Auto if are_springs && pick(island, method.substep, setting, is_direct) == Solver::VelocityVerlet => {
            given(Way::Forces)
        }
        Solver::Verlet | Solver::VelocityVerlet if are_springs => {
            (is_large || (has_order && setting.points > LARGE)).then(|| given(Way::Forces))?
        }
        Solver::Path if !island.has_limits => follows(Way::Paths),
        Solver::Auto if island.relaxed > 0 => {
            (is_large && island.relaxed == island.bonds.len()).then(|| given(sweeps))?
        }
        Solver::Verlet if island.relaxed == island.bonds.len() => is_large.then(|| given(sweeps))?,
        Solver::Relaxation => is_large.then(|| given(sweeps))?,
        Solver::Auto if island.rigid > 0 && !island.has_limits && (!is_direct || is_loose || touches) => {
            follows(Way::Paths)
        }
        Solver::Xpbd if island.relaxed == 0 && !island.has_limits => {
            let is_single = sweeps == Way::Sweeps(1) || island.springs == 0;
            (is_large && is_single).then(|| given(sweeps))?
        }
        _ => None,
    }
}

/// The method of an island where none is asked for; `given`: the longest substep that is `[s]`.
fn pick(island: &Island, given: Option<f64>, setting: Setting, is_direct: bool) -> Solver {
    if island.relaxed > 0 {
        return Solver::Verlet;
    }
    // What is taut between pins or around a loop answers errors of accelerations with strain.
    if island.is_tree && (1..=MOST_FINE_RODS).contains(&island.rigid) && is_direct && is_smooth(island, setting) {
        return Solver::Rk8;
    }
    if island.rigid > 0 {
        return if is_direct { Solver::VelocityVerlet } else { Solver::Verlet };
    }
    let is_driven = island.is_driven || setting.gusts.is_some();
    if island.springs == 0 && !island.has_form() && setting.mouse.is_none() && !setting.has_surfaces && !is_driven {
        return Solver::Flight;
    }
    let is_beyond = given.is_some_and(|given| given * island.frequency.max(0.5 * island.decay) > EDGE);
    let substeps = FRAME / PHASE * island.frequency.max(island.decay * PHASE / DECAY_SHARE);
    if setting.has_surfaces && island.springs > MOST_TOUCHING && substeps <= MOST_TOUCHES && !is_beyond {
        return Solver::VelocityVerlet;
    }
    let is_implicit =
        (is_stiff(island) && !strikes_hard(island, setting) || is_beyond) && !island.is_pressed && !island.has_motors;
    if is_implicit && (island.points.len() <= MOST_IMPLICIT || (setting.points <= LARGE && factors_pay(island))) {
        return Solver::ImplicitMidpoint;
    }
    if setting.points > LARGE {
        return Solver::VelocityVerlet;
    }
    // A splitting has gravity and drag exactly and no drift, between surfaces too; dampers, and events of the mouse and of strings, need velocities
    // in every stage.
    if island.is_damped || setting.mouse.is_some() || island.has_limits { Solver::Rk4 } else { Solver::Pefrl }
}

/// Whether nothing stops, pushes or drives what rigid bonds hold but gravity, springs and pins, so that a method of high order pays.
fn is_smooth(island: &Island, setting: Setting) -> bool {
    let is_pushed = setting.has_surfaces || setting.mouse.is_some() || setting.gusts.is_some() || island.is_pressed;
    !is_pushed && !island.has_limits && !island.has_drives && !island.holds_areas
}

/// How relaxed bonds are swept where nothing is fast: in substeps of so long `[s]`, and so often in each.
pub(crate) fn sweeps(method: &Method) -> (f64, u32) {
    (method.substep.unwrap_or(LONGEST), method.iterations.unwrap_or(1))
}

/// The substep of order 8 whose errors are checked: a whole part of 1/60 s that resolves the fastest spring.
fn fine_substep(island: &Island) -> f64 {
    let rate = island.frequency.max(0.5 * island.decay);
    let wanted = if rate > 0.0 { LONGEST_FINE.min(PHASE_8 / rate) } else { LONGEST_FINE };
    FRAME / (FRAME / wanted).ceil().min(MOST_SUBSTEPS)
}

/// Whether stiff springs that swing may be struck by surfaces, and explicit steps are affordable: an implicit one rounds off what a blow makes of
/// them, and a body bounces too low.
fn strikes_hard(island: &Island, setting: Setting) -> bool {
    let share = setting.points as f64 / island.points.len().max(1) as f64;
    let work = FRAME / PHASE_4 * island.frequency * OF_A_SPRING * island.springs as f64 * share;
    let swings = island.springs > 0 && island.decay <= island.frequency && !island.holds_areas;
    setting.has_surfaces && swings && work <= MOST_STIFF_STRUCK
}

/// Whether springs are stiffer than explicit steps can serve at a bearable cost.
pub(super) fn is_stiff(island: &Island) -> bool {
    FRAME / PHASE_4 * island.frequency > STIFF || FRAME * island.decay > STIFF
}

/// Whether the factors of a large island's system cost less than the explicit steps that they stand in for: those of a tree grow with its
/// points, those of a net with their power 3/2, by nested dissection.
fn factors_pay(island: &Island) -> bool {
    let substeps = FRAME / PHASE_4 * island.frequency.max(0.5 * island.decay);
    island.is_tree || substeps > STIFF_OF_A_NET * (island.points.len() as f64).sqrt()
}

/// The substep that resolves the fastest motion of an island: a whole part of 1/60 s.
fn substep(island: &Island, solver: Solver, setting: Setting) -> f64 {
    let longest = if island.rigid > 0 { LONGEST_RIGID } else { LONGEST };
    let push = setting.mouse.map_or(0.0, |strength| strength.abs().sqrt()).max(setting.gusts.unwrap_or(0.0));
    let push = push.max(island.drive_rate);
    let (phase, rate) = match solver {
        Solver::ImplicitMidpoint | Solver::BackwardEuler => (PHASE, push),
        Solver::Flight => (PHASE, 0.0),
        Solver::Rk4 | Solver::Pefrl | Solver::BlanesMoan4 | Solver::BlanesMoan6 | Solver::Rk8 => {
            (PHASE_4, island.frequency.max(push).max(0.5 * island.decay).max(0.5 * setting.drag_rate))
        }
        Solver::VelocityVerlet if island.springs > MOST_TOUCHING => {
            (PHASE_MESH, island.frequency.max(push).max(island.decay * PHASE_MESH / DECAY_SHARE))
        }
        _ => (PHASE, island.frequency.max(push).max(island.decay)),
    };
    let wanted = if rate > 0.0 { longest.min(phase / rate) } else { longest };
    FRAME / (FRAME / wanted).ceil().min(MOST_SUBSTEPS)
}
