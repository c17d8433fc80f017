//! One large body: its points among those of the group, its structure, its state.

use super::Way;
use super::chain::Chain;
use super::crowd::Crowd;
use super::form::Form;
use super::impact::Piece;
use super::mesh::Mesh;
use super::outside::{Going, Outside, Toll};
use super::sheet::Sheet;
use super::spec::{Start, Substep};
use crate::sim::force::mouse::Push;
use crate::sim::kernels::store::{Drift, Store};
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, widen};
use std::collections::BTreeMap;

/// Impacts that a piece may have in one substep: of corners, one after the other.
const MOST_BLOWS: u32 = 8;

/// Places and velocities of the points of a group in the middle of a substep `[m, m/s]`.
pub(crate) type Middle<S, const D: usize> = (Vec<[S; D]>, Vec<[S; D]>);

/// A large body of any form.
#[derive(Clone, Debug)]
pub(crate) enum AnyBody<S: Real, const D: usize> {
    Sheet(Box<Body<S, D, Sheet<S, D>>>),
    Chain(Box<Body<S, D, Chain<S>>>),
    Crowd(Box<Body<S, D, Crowd>>),
    Mesh(Box<Body<S, D, Mesh<S, D>>>),
}

/// Does the same with a body of whatever form.
macro_rules! of_any {
    ($any:expr, $body:ident => $call:expr) => {
        match $any {
            AnyBody::Sheet($body) => $call,
            AnyBody::Chain($body) => $call,
            AnyBody::Crowd($body) => $call,
            AnyBody::Mesh($body) => $call,
        }
    };
}

impl<S: Real, const D: usize> AnyBody<S, D> {
    /// Puts the state of the points into the store: motions of a substep of `h` `[s]`.
    pub(crate) fn load(&mut self, points: &Points<S, D>, h: S) {
        of_any!(self, body => body.load(points, h));
    }

    /// The first substep of a step begins.
    pub(crate) fn set_out(&mut self, drift: &Drift<S, D>) {
        of_any!(self, body => body.store.set_out(drift));
    }

    /// From one substep to the next.
    pub(crate) fn go_on(&mut self, drift: &Drift<S, D>) {
        of_any!(self, body => body.store.go_on(drift));
    }

    /// The places in the store of free points that the mouse may push in a step.
    pub(crate) fn near(&mut self, outside: &Outside<S, D>) -> Vec<usize> {
        of_any!(self, body => body.near(outside))
    }

    /// The mouse pushes these points: `share` is what an acceleration adds to a displacement `[s^2]`.
    pub(crate) fn push(&mut self, push: &Push<S, D>, share: S, near: &[usize]) {
        of_any!(self, body => body.push(push, share, near));
    }

    /// Where points are at the start of the substep, in the order of the group.
    pub(crate) fn read_places(&mut self, places: &mut [[S; D]]) {
        of_any!(self, body => body.read_places(places));
    }

    /// Adds `share` of accelerations, in the order of the group, to the motions of points that are free.
    pub(crate) fn give(&mut self, accelerations: &[[S; D]], share: S) {
        of_any!(self, body => body.give(accelerations, share));
    }

    /// Surfaces turn points back; `fall` is what gravity adds to a motion `[m]`. Returns how many, and adds what that took to
    /// `toll`, of masses in those of the reference.
    pub(crate) fn meet(&mut self, outside: &Outside<S, D>, fall: [S; D], toll: Option<&mut Toll>) -> u64 {
        of_any!(self, body => body.meet(outside, fall, toll))
    }

    /// Where points are in the middle of the substep and how fast, in the order of the group; `rate` is one over the substep `[1/s]`.
    pub(crate) fn read_middle(&mut self, rate: S, middle: &mut Middle<S, D>) {
        of_any!(self, body => body.read_middle(rate, middle));
    }

    /// The work at pins of a body whose points had the velocities `before` when its bonds began to pull; `None`: its pins go
    /// different ways.
    pub(crate) fn work_at_pins(&mut self, rate: S, before: &[[S; D]]) -> Option<f64> {
        of_any!(self, body => body.work_at_pins(rate, before))
    }

    /// Bonds of one substep. Returns the largest pull.
    pub(crate) fn project(&mut self, way: Way, step: &Substep) -> S {
        of_any!(self, body => body.form.project(&mut body.store, way, step))
    }

    /// Substeps without anything from outside. Returns the largest pull.
    pub(crate) fn run(&mut self, way: Way, starts: (&Start<S, D>, &Start<S, D>), count: u32) -> S {
        of_any!(self, body => body.form.run(&mut body.store, way, starts, count))
    }

    /// The largest |e.e/rest^2 - 1| of any rigid bond.
    pub(crate) fn stretch(&mut self) -> S {
        of_any!(self, body => body.form.stretch(&mut body.store))
    }

    /// Ends the last substep and gives positions and velocities back; `rate` is one over the substep `[1/s]`.
    pub(crate) fn arrive(&mut self, points: &mut Points<S, D>, rate: S) {
        of_any!(self, body => body.arrive(points, rate));
    }

    /// The bond between two points of the group goes. Returns whether that was so: see [`Form::lose`].
    pub(crate) fn lose(&mut self, ends: [u32; 2], rest: f64) -> bool {
        of_any!(self, body => {
            let own = ends.map(|end| body.members.own(end));
            // What surfaces strike as one piece may be one no more.
            let ([Some(a), Some(b)], None) = (own, body.piece) else { return false };
            let mut count = 0;
            Form::<S, D>::runs(&body.form, |run| count += run.count);
            (a.max(b) as usize) < count && Form::<S, D>::lose(&mut body.form, [a, b], rest)
        })
    }

    /// Its form: a sheet, a chain, a crowd or a mesh.
    pub(crate) fn place(&self) -> usize {
        match self {
            AnyBody::Sheet(_) => 0,
            AnyBody::Chain(_) => 1,
            AnyBody::Crowd(_) => 2,
            AnyBody::Mesh(_) => 3,
        }
    }

    /// Bytes that it takes.
    pub(crate) fn heap_bytes(&self) -> usize {
        of_any!(self, body => {
            let members = if let Members::List(list) = &body.members { 4 * list.capacity() } else { 0 };
            members + Form::<S, D>::heap_bytes(&body.form) + body.store.heap_bytes()
        })
    }

    /// What bonds at pins bear of the weight: mass over rest length times the reference `[1/m]`.
    pub(crate) fn bears(&mut self) -> f64 {
        of_any!(self, body => Form::<S, D>::bears(&body.form, &mut body.store))
    }

    /// The mass of all that is free `[kg]`.
    pub(crate) fn mass(&mut self) -> f64 {
        of_any!(self, body => body.mass())
    }

    pub(crate) fn bonds(&self) -> usize {
        of_any!(self, body => Form::<S, D>::bonds(&body.form))
    }

    /// The inverse mass that weights are relative to `[1/kg]`.
    pub(crate) fn reference(&self) -> f64 {
        of_any!(self, body => body.reference)
    }
}

/// Which points of the group are those of a body, in the body's numbering.
#[derive(Clone, Debug)]
pub(crate) enum Members {
    /// One after another from this one on.
    From(u32),
    /// These.
    List(Vec<u32>),
}

impl Members {
    /// The number within the body of a point of the group.
    fn own(&self, point: u32) -> Option<u32> {
        match self {
            Members::From(first) => point.checked_sub(*first),
            Members::List(list) => list.iter().position(|&member| member == point).map(|place| place as u32),
        }
    }

    #[inline(always)]
    fn point(&self, i: usize) -> usize {
        match self {
            Members::From(first) => *first as usize + i,
            Members::List(list) => list[i] as usize,
        }
    }
}

/// A large body.
#[derive(Clone, Debug)]
pub(crate) struct Body<S: Real, const D: usize, F: Form<S, D>> {
    form: F,
    store: F::Store,
    /// The inverse mass that weights are relative to `[1/kg]`.
    reference: f64,
    members: Members,
    /// How many points make one piece each: impacts strike it as a whole.
    piece: Option<usize>,
}

impl<S: Real, const D: usize, F: Form<S, D>> Body<S, D, F> {
    /// A body of these points of the group, whose inverse masses are `w` `[1/kg]`.
    ///
    /// Each `piece` points, where it is given, are held in shape by bonds.
    pub(crate) fn new(mut form: F, (members, piece): (Members, Option<usize>), w: &[S]) -> Self {
        let mut least = f64::INFINITY;
        form.each(|i, _| {
            let w = w[members.point(i)].to_f64();
            if w > 0.0 && w < least {
                least = w;
            }
        });
        let reference = if least.is_finite() { least } else { 1.0 };
        let mut store = F::Store::new(form.cells());
        form.each(|i, cell| *store.weight(cell) = S::from_f64(w[members.point(i)].to_f64() / reference));
        form.weigh(&mut store);
        Body { form, store, reference, members, piece }
    }

    fn mass(&mut self) -> f64 {
        let Body { form, store, reference, .. } = self;
        let mut mass = 0.0;
        form.each(|_, cell| {
            let w = store.weight(cell).to_f64();
            mass += if w > 0.0 { 1.0 / (w * *reference) } else { 0.0 };
        });
        mass
    }

    fn load(&mut self, points: &Points<S, D>, h: S) {
        let Body { form, store, members, .. } = self;
        form.each(|i, cell| {
            let point = members.point(i);
            store.put(cell, points.position[point], scale(points.velocity[point], h));
        });
    }

    fn near(&mut self, outside: &Outside<S, D>) -> Vec<usize> {
        let Body { form, store, .. } = self;
        let mut near = Vec::new();
        form.each(|_, cell| {
            if *store.weight(cell) > S::ZERO && outside.may_push(store.get(cell).0) {
                near.push(cell);
            }
        });
        near
    }

    fn push(&mut self, push: &Push<S, D>, share: S, near: &[usize]) {
        let Body { store, .. } = self;
        for &cell in near {
            let (x, _) = store.get(cell);
            if let Some(acceleration) = push.acceleration(x) {
                let motion = add(store.motion(cell), scale(acceleration, share));
                store.put(cell, x, motion);
            }
        }
    }

    fn read_places(&mut self, places: &mut [[S; D]]) {
        let Body { form, store, members, .. } = self;
        form.each(|i, cell| places[members.point(i)] = store.get(cell).0);
    }

    fn give(&mut self, accelerations: &[[S; D]], share: S) {
        let Body { form, store, members, .. } = self;
        form.each(|i, cell| {
            if *store.weight(cell) > S::ZERO {
                let (x, _) = store.get(cell);
                let motion = add(store.motion(cell), scale(accelerations[members.point(i)], share));
                store.put(cell, x, motion);
            }
        });
    }

    fn meet(&mut self, outside: &Outside<S, D>, fall: [S; D], mut toll: Option<&mut Toll>) -> u64 {
        let mut struck = BTreeMap::new();
        let mut below = self.below(outside, &struck);
        if let Some(size) = self.piece {
            for _ in 0..MOST_BLOWS {
                if below.is_empty() || !self.strike(&below, (outside, fall), size, (&mut struck, toll.as_deref_mut())) {
                    break;
                }
                below = self.below(outside, &struck);
            }
        }
        let Body { store, .. } = self;
        for &(_, cell, going) in &below {
            let mut own = toll.is_some().then(Toll::default);
            if let Some((end, motion)) = outside.meet(going, fall, own.as_mut()) {
                store.set(cell, sub(end, motion), motion);
            }
            if let (Some(toll), Some(own)) = (&mut toll, own) {
                toll.add(own, 1.0 / store.weight(cell).to_f64());
            }
        }
        below.len() as u64
    }

    /// Points that are about to end behind a surface, counted within the body, their places in the store, and how they go.
    /// Pieces that were `struck` come from where they were then, the given share of the substep before its end.
    fn below(&mut self, outside: &Outside<S, D>, struck: &BTreeMap<usize, S>) -> Vec<(usize, usize, Going<S, D>)> {
        let size = self.piece.unwrap_or(usize::MAX);
        let Body { form, store, .. } = self;
        let mut below = Vec::new();
        form.each(|i, cell| {
            let (x, d) = store.get(cell);
            let (to, left) = (add(x, d), struck.get(&(i / size)));
            let from = left.map_or(x, |&left| sub(to, scale(store.motion(cell), left)));
            if outside.behind(from, to).next().is_some() && *store.weight(cell) != S::ZERO {
                below.push((i, cell, Going { from, to, motion: store.motion(cell) }));
            }
        });
        below
    }

    /// Pieces of so many points with some `below` a surface go on from there by the motion that the impact gives them.
    /// Returns whether there were any, and adds them to those that were `struck`.
    fn strike(
        &mut self,
        below: &[(usize, usize, Going<S, D>)],
        (outside, fall): (&Outside<S, D>, [S; D]),
        size: usize,
        (struck, toll): (&mut BTreeMap<usize, S>, Option<&mut Toll>),
    ) -> bool {
        let Body { form, store, .. } = self;
        let mut pieces: BTreeMap<usize, Piece<D>> = BTreeMap::new();
        for &(i, _, Going { from, to, motion }) in below {
            let piece = pieces.entry(i / size).or_insert_with(Piece::new);
            outside.behind(from, to).for_each(|surface| piece.touch((to, motion), surface, fall));
        }
        pieces.retain(|_, piece| !piece.is_clear());
        if pieces.is_empty() {
            return false;
        }
        form.each(|i, cell| {
            if let Some(piece) = pieces.get_mut(&(i / size)) {
                let (x, d) = store.get(cell);
                piece.weigh(add(x, d), *store.weight(cell));
            }
        });
        pieces.values_mut().for_each(|piece| piece.strike(fall));
        if let Some(toll) = toll {
            pieces.values().for_each(|piece| toll.add(piece.toll(), 1.0));
        }
        struck.extend(pieces.iter().map(|(&place, piece)| (place, S::from_f64(piece.left()))));
        form.each(|i, cell| {
            let Some(piece) = pieces.get(&(i / size)).filter(|_| *store.weight(cell) > S::ZERO) else { return };
            let (x, d) = store.get(cell);
            let (faster, further) = piece.change(add(x, d));
            let motion = add(store.motion(cell), faster);
            store.set(cell, sub(add(add(x, d), further), motion), motion);
        });
        true
    }

    fn read_middle(&mut self, rate: S, (position, velocity): &mut Middle<S, D>) {
        let Body { form, store, members, .. } = self;
        form.each(|i, cell| {
            let (point, (x, d)) = (members.point(i), store.get(cell));
            position[point] = add(x, scale(d, S::HALF));
            velocity[point] = scale(store.motion(cell), rate);
        });
    }

    fn work_at_pins(&mut self, rate: S, before: &[[S; D]]) -> Option<f64> {
        let Body { form, store, members, reference, .. } = self;
        let (mut impulse, mut pin, mut is_one) = ([0.0; D], None, true);
        form.each(|i, cell| {
            let (v, w) = (scale(store.motion(cell), rate), store.weight(cell).to_f64() * *reference);
            if w > 0.0 {
                impulse = add(impulse, scale(widen(sub(v, before[members.point(i)])), 1.0 / w));
            } else {
                is_one &= *pin.get_or_insert(v) == v;
            }
        });
        is_one.then(|| pin.map_or(0.0, |v| dot(impulse, widen(v))))
    }

    fn arrive(&mut self, points: &mut Points<S, D>, rate: S) {
        self.store.arrive();
        let Body { form, store, members, .. } = self;
        let Points { position, velocity, inverse_mass, .. } = points;
        form.runs(|run| match members {
            Members::From(first) => {
                let first = *first as usize + run.point;
                let end = first + (run.count - 1) * run.point_step + 1;
                let (position, velocity) = (&mut position[first..end], &mut velocity[first..end]);
                let w = &inverse_mass[first..end];
                store.read(&run, |i, x, motion| {
                    let point = i * run.point_step;
                    position[point] = x;
                    if w[point] != S::ZERO {
                        velocity[point] = scale(motion, rate);
                    }
                });
            }
            Members::List(list) => store.read(&run, |i, x, motion| {
                let point = list[run.point + i * run.point_step] as usize;
                position[point] = x;
                if inverse_mass[point] != S::ZERO {
                    velocity[point] = scale(motion, rate);
                }
            }),
        });
    }
}
