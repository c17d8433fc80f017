//! The live step: bodies that meet, moved with a bounded amount of work.
//!
//! ```text
//! gather      bodies whose ways may meet make a cluster, with a copy of their state (`gather.rs`)
//! substeps    as many as the fastest needs; each (`substep.rs`): forces, prediction, bonds, then in turn areas and contacts, sides
//! guard       a cluster has no more energy than before and what was done to it (`guard.rs`)
//! tangle      what is inside out is led back to its shape, bodies in each other are parted (`tangle.rs`)
//! rest        what touches and is slow settles; clusters that stay where they are fall asleep (`rest.rs`)
//! ```
//!
//! Everything is solved on the ways of the points within the substep. Multipliers begin at 0 in each: nothing is kept from one
//! substep to the next but on which side of an edge a point belongs, and what contacts of rigid bodies bore (`loads.rs`). These are solved
//! on the motions of the bodies (`touches.rs`), and only points of them that may touch something are in a cluster.
//! Sources: M. Macklin and others, Small Steps in Physics Simulation, 2019 (one sweep in many substeps); M. Müller and others,
//! Detailed Rigid Body Simulation with Extended Position Based Dynamics, 2020 (friction on the ways of a substep, restitution).

mod areas;
mod bear;
mod bend;
mod body;
mod bonds;
mod booking;
mod build;
mod calm;
mod cells;
mod circle;
mod cluster;
mod contact;
mod cross;
mod detect;
mod drives;
mod fields;
mod flats;
mod frame;
mod gather;
mod given;
mod ground;
mod guard;
mod heir;
mod impaled;
mod layout;
mod loads;
mod mend;
mod nailed;
mod pace;
mod pair;
mod part;
mod planes;
mod props;
mod rest;
mod rig;
mod rigid;
mod scout;
mod shape;
mod skins;
mod space;
mod strap;
mod substep;
mod tangle;
mod tether;
mod touches;
mod tree;
mod truncate;
mod walls;
mod within;

use std::any::Any;
use std::sync::Arc;

use super::account::Account;
use super::bond::Bond;
use super::bulk::kernel::Kernel;
use super::bulk::mover::{Mover, Part};
use super::contact::skin::{Contact, SkinMaterial};
use super::counters::Counters;
use super::environment::Environment;
use super::force::angle::Hinge;
use super::force::area::Areas;
use super::measure;
use super::points::Points;
use super::pull::Pull;
use super::real::Real;
use super::swept::{Span, Swept};
use super::vector::length;
use booking::Tally;
use build::Bodies;
use cluster::{Cluster, Common};
use drives::Source;
use fields::Field;
use loads::Loads;
use pace::Pace;
use pair::Sides;
use rest::Rest;
use substep::Outside;
use tangle::Tangle;
use walls::Walls;

/// Frames of which substeps are whole parts `[1/s]`.
const FRAMES: f64 = 60.0;

/// Edges that a point may be led by in a second: one in each of the longest substeps.
const LEAD: f64 = 960.0;

/// What live bodies are made of. Points are numbered as in their group.
pub(crate) struct Draft<S> {
    /// The bonds, rest lengths and stiffness included.
    pub(crate) bonds: Vec<Bond>,
    /// The body of every point: both ends of a bond are of one.
    pub(crate) body_of: Vec<u32>,
    /// What bodies cover, and the areas at rest `[m^2]` of triangles, where they are known.
    pub(crate) triangles: Vec<([u32; 3], Option<f64>)>,
    /// Angles that resist.
    pub(crate) hinges: Vec<Hinge<S>>,
    /// How triangles resist.
    pub(crate) areas: Areas,
    /// How they meet; `None`: they do not.
    pub(crate) contact: Option<Contact>,
    /// What touches something and is slow is slowed down.
    pub(crate) settles: bool,
    /// What stays where it is falls asleep.
    pub(crate) sleeps: bool,
    /// What skins are made of, one entry a point; empty where no body has its own.
    pub(crate) skins: Vec<SkinMaterial>,
    /// The substep in which relaxed bonds are swept by their own method `[s]`, and how often.
    pub(crate) sweeps: (f64, u32),
    /// Pins that are led, ascending, and the knots of the track of each `[m]`.
    pub(crate) led: Vec<u32>,
    pub(crate) knots: Vec<Vec<[f64; 3]>>,
}

/// Bodies in the live step.
#[derive(Clone, Debug)]
struct Live<S: Real> {
    bodies: Arc<Bodies<S>>,
    contact: Option<Contact>,
    settles: bool,
    sleeps: bool,
    resist: Areas,
    walls: Walls<S>,
    /// Which side of an edge every point near one belongs to.
    sides: Sides,
    /// What contacts of rigid bodies bore in the last substep.
    loads: Loads<S>,
    /// What is inside out or crosses.
    tangle: Tangle<S>,
    /// Of every body.
    rests: Vec<Rest>,
    /// Where bodies were when they were last seen to move, in the order of the bodies.
    anchor: Vec<[S; 2]>,
    /// How much what settles is slowed down `[1/s]`, one a body.
    settling: Vec<S>,
    bond_count: usize,
    fields: Vec<Field<S>>,
    /// What moves bodies by itself.
    sources: Vec<Source>,
    /// How much nearer a body that somebody else moves may come to itself until it is looked at again `[m]`.
    room: S,
    /// Slots of what left the finite numbers.
    lost: Vec<u32>,
}

/// The live step of these bodies; `None` of a dimension that there is not.
pub(crate) fn mover<S: Real, const D: usize>(
    draft: Draft<S>,
    points: &Points<S, D>,
    pull: &Pull<S, D>,
) -> Option<Box<dyn Mover<S, D>>> {
    let (points, pull): (&dyn Any, &dyn Any) = (points, pull);
    let live: Box<dyn Any> = if D == 3 {
        let (points, pull) = (points.downcast_ref::<Points<S, 3>>()?, pull.downcast_ref::<Pull<S, 3>>()?);
        let live: Box<dyn Mover<S, 3>> = Box::new(space::Space::new(&draft, points, pull));
        Box::new(live)
    } else {
        let (points, pull) = (points.downcast_ref::<Points<S, 2>>()?, pull.downcast_ref::<Pull<S, 2>>()?);
        let mut live = Live::new(&draft, points, Walls::of(&pull.contacts.obstacles));
        live.fields = Field::list(&pull.thrusts, &live.bodies);
        let live: Box<dyn Mover<S, 2>> = Box::new(live);
        Box::new(live)
    };
    live.downcast::<Box<dyn Mover<S, D>>>().ok().map(|live| *live)
}

/// Counted work of a substep for each bond, point and triangle, about.
const OF_A_SUBSTEP: [f64; 3] = [30.0, 30.0, 8.0];

/// Counted work, about, of a frame of bodies of so many points, bonds and triangles that do not meet, at this speed `[m/s]`, with bonds of
/// this mean length `[m]`.
pub(crate) fn work_of_a_frame([points, bonds, triangles]: [usize; 3], speed: f64, edge: f64) -> f64 {
    f64::from(gather::substeps_at(speed, edge)) * work_of_a_substep([points, bonds, triangles])
}

/// The same of a substep.
fn work_of_a_substep([points, bonds, triangles]: [usize; 3]) -> f64 {
    let [of_bond, of_point, of_triangle] = OF_A_SUBSTEP;
    of_bond * bonds as f64 + of_point * points as f64 + of_triangle * triangles as f64
}

impl<S: Real> Live<S> {
    fn new(draft: &Draft<S>, points: &Points<S, 2>, walls: Walls<S>) -> Self {
        let bodies = Arc::new(Bodies::new(draft, points));
        let count = bodies.list.len();
        Live {
            contact: draft.contact,
            settles: draft.settles,
            sleeps: draft.sleeps,
            resist: draft.areas,
            walls,
            sides: Vec::new(),
            loads: Vec::new(),
            tangle: Tangle::new(count),
            rests: vec![Rest::fresh(); count],
            anchor: Vec::new(),
            settling: vec![S::ZERO; count],
            bond_count: draft.bonds.len(),
            fields: Vec::new(),
            sources: Source::list(&bodies),
            room: S::ZERO,
            lost: Vec::new(),
            bodies,
        }
    }

    /// What all clusters share.
    fn common<'a>(&'a self, pull: &'a Pull<S, 2>, (sides, loads): (&'a Sides, &'a Loads<S>)) -> Common<'a, S> {
        let obstacles = &pull.contacts.obstacles;
        Common {
            bodies: &self.bodies,
            walls: &self.walls,
            contact: self.contact.as_ref(),
            resist: self.resist,
            surfaces: &obstacles.surfaces,
            planes: obstacles.planes(),
            sides,
            loads,
            most_push: length(pull.gravity) + pull.most_push(),
        }
    }

    /// A step of a cluster, in equal substeps.
    fn run(
        &self,
        cluster: &mut Cluster<S>,
        common: &Common<S>,
        (pull, around): (&Pull<S, 2>, &Environment<2>),
        (t, h): (f64, f64),
    ) {
        let count = (h * FRAMES * f64::from(cluster.substeps(common, around, t))).ceil().max(1.0);
        let moving = cluster.now.iter().copied().zip(cluster.velocity.iter().copied()).take(cluster.own());
        let least = around.parts_near(moving, (t, h));
        let mut pace = Pace::new((t, h), count.max(f64::from(least)) as u32, least);
        let outside = Outside { pull, around, settling: &self.settling };
        let moving = guard::energy(cluster, pull.gravity);
        calm::look(cluster, common);
        tangle::look(cluster, common, h);
        cluster.span = S::from_f64(pace.length);
        cluster.look_for_nails(common);
        detect::look(cluster, common);
        cluster.is_violent = cluster.is_struck();
        cluster.see_within(common);
        cluster.tether(common);
        prepare(cluster, common, (t, around), pace.length);
        let before = moving + guard::elastic(cluster, common);
        let held = cluster.tally.is_some().then(|| guard::all(cluster, common, pull.gravity));
        let mut next = pace.next();
        while let Some(start) = next {
            let done = cluster.counts.work;
            substep::advance(cluster, common, outside, (start, pace.length));
            let is_longer = pace.note(cluster.counts.work - done);
            next = pace.next();
            if let Some(start) = next.filter(|_| is_longer) {
                prepare(cluster, common, (start, around), pace.length);
            }
        }
        // What is no number any more is not to be shared out.
        if cluster.is_finite() {
            guard::hold(cluster, common, (before, pull.gravity, h));
            cluster.note_couples();
            if let Some(held) = held.filter(|_| cluster.sunk.contains(&true) || cluster.counts.opened > 0) {
                let made = guard::all(cluster, common, pull.gravity) - held;
                cluster.book_parting(made);
            }
        }
    }
}

/// What substeps of `h` from `t` on `[s]` go by.
fn prepare<S: Real>(cluster: &mut Cluster<S>, common: &Common<S>, (t, around): (f64, &Environment<2>), h: f64) {
    cluster.span = S::from_f64(h);
    bonds::prepare(cluster, common, cluster.span);
    bend::prepare(cluster, common, cluster.span);
    drives::prepare(cluster, common, (t, around), cluster.span);
}

impl<S: Real> Mover<S, 2> for Live<S> {
    fn begin(&mut self, _points: &mut Points<S, 2>, _around: &Environment<2>, _t: f64) {}

    fn step(
        &mut self,
        points: &mut Points<S, 2>,
        pull: &Pull<S, 2>,
        around: &Environment<2>,
        (t, h): (f64, f64),
        counters: &mut Counters,
        account: Option<&mut Account>,
    ) {
        let (sides, loads) = (std::mem::take(&mut self.sides), std::mem::take(&mut self.loads));
        self.wake(points, around, (t, h));
        self.wake_driven(around, t);
        let mut clusters = {
            let common = self.common(pull, (&sides, &loads));
            let mut clusters = self.gather(points, &common, ((pull, around), account.is_some()), (t, h));
            let mut account = account;
            for cluster in &mut clusters {
                cluster.tally = account.as_ref().map(|_| Box::new(Tally::new(cluster.own())));
                self.run(cluster, &common, (pull, around), (t, h));
                if let Some(account) = account.as_mut().filter(|_| cluster.is_finite()) {
                    booking::book(cluster, &mut account.book);
                }
            }
            clusters
        };
        // What left the numbers stays where the step began, with all that went with it.
        for cluster in clusters.extract_if(.., |cluster| !cluster.is_finite()) {
            cluster.count(counters);
            let bodies = cluster.lost().map(|body| self.bodies.list[body].points.range());
            self.lost.extend(bodies.flat_map(|points| &self.bodies.order[points]));
        }
        self.sides = kept(sides, &clusters, |cluster| detect::known(cluster));
        let has_rigid = clusters.iter().any(|cluster| !cluster.is_one.is_empty());
        self.loads = if has_rigid { kept(loads, &clusters, |cluster| cluster.loads(&self.bodies)) } else { loads };
        self.tangle.note(&mut clusters, h);
        for cluster in &mut clusters {
            self.scatter(cluster, points);
            let count = cluster.counts.substeps.max(1) as f64;
            for (&body, swing) in cluster.bodies.iter().zip(&cluster.swings) {
                let rest = &mut self.rests[body];
                (rest.is_asleep, rest.swing) = (false, swing.seen / count);
            }
            self.settle(cluster, (around, t + h), h);
            cluster.count(counters);
            counters.settled += cluster.bodies.iter().filter(|&&body| self.settling[body] > S::ZERO).count() as u64;
        }
        // A gust may come at any time.
        if self.sleeps && pull.gusts().is_none() {
            self.doze(&clusters, points, (around, t + h));
        }
    }

    fn lose(&mut self, _ends: [u32; 2], _rest: f64) -> bool {
        false
    }

    fn reload(&mut self) {}

    fn lag(&self) -> f64 {
        0.0
    }

    fn most_lead(&self, slot: u32) -> Option<f64> {
        let place = self.bodies.order.iter().position(|&own| own == slot)? as u32;
        let body = self.bodies.list.iter().find(|body| (body.points.first..body.points.end).contains(&place))?;
        (body.edge_length > S::ZERO).then(|| body.edge_length.to_f64() * LEAD)
    }

    fn reaches(&self, points: &Points<S, 2>, span: Span) -> Vec<Swept<S, 2>> {
        self.all_reaches(points, span)
    }

    fn parts(&self, points: &Points<S, 2>, pull: &Pull<S, 2>, around: &Environment<2>, h: f64) -> Vec<Part> {
        self.all_parts(points, (pull, around), h)
    }

    fn leads_out(&self) -> bool {
        self.rests.iter().any(|rest| rest.is_tethered)
    }

    fn take_lost(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.lost)
    }

    fn may_meet_itself(&mut self, points: &Points<S, 2>, h: f64) -> bool {
        self.scout(points, h)
    }

    fn inherit(&mut self, other: &dyn Mover<S, 2>, slots: &[(u32, u32)]) {
        if let Some(other) = other.any().and_then(|any| any.downcast_ref::<Live<S>>()) {
            self.take_over(other, slots);
        }
    }

    fn any(&self) -> Option<&dyn Any> {
        Some(self)
    }

    fn kernel(&self) -> Kernel {
        Kernel::Live
    }

    fn heap_bytes(&self) -> usize {
        let bodies = &self.bodies;
        let links = (bodies.springs.capacity() + bodies.holds.capacity()) * size_of::<body::Link<S>>();
        let skins =
            bodies.edges.capacity() * size_of::<body::Edge>() + bodies.areas.capacity() * size_of::<body::Area<S>>();
        links
            + skins
            + 12 * bodies.order.capacity()
            + self.anchor.capacity() * size_of::<[S; 2]>()
            + 16 * self.sides.capacity()
    }

    fn bonds(&self) -> usize {
        self.bond_count
    }

    fn boxed_clone(&self) -> Box<dyn Mover<S, 2>> {
        Box::new(self.clone())
    }
}

/// Those of some bodies that left the finite numbers; the points of each begin where `bases` says.
fn lost<S: Real, const D: usize>(
    (bodies, bases): (&[usize], &[u32]),
    (x, v): (&[[S; D]], &[[S; D]]),
) -> impl Iterator<Item = usize> {
    let is_fine = |i: usize| measure::is_among_numbers(x[i], v[i]);
    let ends = bases.windows(2).map(|ends| ends[0] as usize..ends[1] as usize);
    bodies.iter().zip(ends).filter(move |(_, points)| !points.clone().all(is_fine)).map(|(&body, _)| body)
}

/// What is known of contacts by their numbers: of what moved as it is now, of what sleeps as it was.
fn kept<S: Real, T>(
    known: Vec<(u64, T)>,
    clusters: &[Cluster<S>],
    now: impl Fn(&Cluster<S>) -> Vec<(u64, T)>,
) -> Vec<(u64, T)> {
    if clusters.is_empty() {
        return known;
    }
    let mut awake: Vec<(u32, u32)> = Vec::new();
    for cluster in clusters {
        awake.extend(cluster.corners.iter().chain(&cluster.circles).map(|&(place, number)| (number, place)));
    }
    awake.sort_unstable();
    let is_awake = |key: u64| awake.binary_search_by_key(&((key >> 32) as u32), |entry| entry.0).is_ok();
    let mut list: Vec<(u64, T)> = known.into_iter().filter(|side| !is_awake(side.0)).collect();
    clusters.iter().for_each(|cluster| list.extend(now(cluster)));
    list.sort_by_key(|entry| entry.0);
    list.dedup_by_key(|entry| entry.0);
    list
}
