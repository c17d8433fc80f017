//! What a selection is made of, in figures.

use super::bending;
use super::called::name_of;
use super::extent::{areas, place};
use super::former::Former;
use super::joints::{Joint, coming, held, swings};
use super::motors::{self, Motors};
use super::preset::Preset;
use super::{Among, AngleAs, Common};
use crate::picture::Tint;
use crate::scene::DriveKeys;
use crate::sim::vector::sub;
use crate::sim::{Bond, BondKind, Contact, Dynamics, Knots, Limit, Obstacle, PointId};

/// A strain at which bonds break that none comes to `[1]`: files have no word for never.
pub(in crate::app) const NEVER: f64 = 1e9;

/// Numbers that differ by a smaller share are the same in a world of 32 bits, sums of some hundred of them too `[1]`.
const ALIKE: f64 = 1e-4;

/// Pins whose ways are told at most.
const MOST_PINS: usize = 6;

/// The least and the greatest of some numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct Span {
    pub(in crate::app) least: f64,
    pub(in crate::app) most: f64,
}

impl Span {
    /// Of some numbers; `None` of none.
    pub(super) fn of(numbers: impl Iterator<Item = f64>) -> Option<Self> {
        numbers.fold(None, |span: Option<Span>, x| {
            Some(
                span.map_or(Span { least: x, most: x }, |span| Span {
                    least: span.least.min(x),
                    most: span.most.max(x),
                }),
            )
        })
    }

    /// Whether all of them are this number, as far as 32 bits tell.
    fn is_all(self, x: f64) -> bool {
        [self.least, self.most].into_iter().all(|own| (own - x).abs() <= ALIKE * x.abs())
    }

    /// The same, where they are one number as far as 32 bits tell.
    pub(super) fn evened(self) -> Self {
        if self.is_all(self.most) { Span { least: self.most, ..self } } else { self }
    }

    /// The one number that they all are.
    pub(in crate::app) fn same(self) -> Option<f64> {
        (self.least == self.most).then_some(self.least)
    }
}

/// A pin, where it is `[m]`, and the way that it is led along: of what stands that has no knots. With it go the props of what turns about it, each
/// so far from it `[m]`.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::app) struct Pin {
    pub(in crate::app) point: PointId,
    pub(in crate::app) at: [f64; 3],
    pub(in crate::app) knots: Knots,
    pub(in crate::app) props: Vec<(PointId, [f64; 3])>,
}

/// What a selection is made of. A span is `None` where nothing has such a number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Matter {
    pub(in crate::app) points: usize,
    pub(in crate::app) bonds: usize,
    pub(in crate::app) obstacles: usize,
    /// What bonds and angles hold together counts as one, a loose point too.
    pub(in crate::app) bodies: usize,
    /// What it is called, if bonds hold all of it together: all that it is made of.
    pub(in crate::app) name: Option<String>,
    /// Of its points `[kg]`.
    pub(in crate::app) mass: f64,
    /// What its triangles cover at rest `[m^2]`.
    pub(in crate::app) area: f64,
    /// Bonds that are rigid, springs, relaxed.
    pub(in crate::app) kinds: [usize; 3],
    /// Of its springs `[N/m]`, `[N s/m]`.
    pub(in crate::app) stiffness: Option<Span>,
    pub(in crate::app) damping: Option<Span>,
    /// Bonds that act on both sides of their lengths, against being longer, against being shorter.
    pub(in crate::app) limits: [usize; 3],
    /// Of relaxed bonds: the share of its error that each takes `[1]`.
    pub(in crate::app) relaxation: Option<Span>,
    /// The largest correction of each of them, as a ratio `[1]`; [`NEVER`] or more: any.
    pub(in crate::app) max_correction: Option<Span>,
    /// Strain at which bonds break `[1]`; [`NEVER`] or more: they do not.
    pub(in crate::app) breaks: Option<Span>,
    /// E I of chains and skins `[N m^2]`; 0 also where no angle bends yet and some could.
    pub(in crate::app) bending: Option<Span>,
    /// How long bonds are at rest `[m]`.
    pub(in crate::app) rest_length: Option<Span>,
    /// Where angles that resist are at rest `[rad]`.
    pub(in crate::app) rest_angle: Option<Span>,
    /// Of angles, but for motors `[N m s]`.
    pub(in crate::app) angle_damping: Option<Span>,
    /// What moves each of the angles that resist, if anything does; `None`: none resists.
    pub(in crate::app) swings: Option<Common<Option<DriveKeys>>>,
    /// Joints that have stops, and that may have some: what two bonds alone make is one, and so is a hinge between two bodies,
    /// and a pin that a body hangs on.
    pub(in crate::app) joints: [usize; 2],
    /// The least and the largest angles of those that have stops `[rad]`.
    pub(in crate::app) stops: Option<[Span; 2]>,
    /// Joints that may have stops and have none, the first few, and where they would be.
    pub(in crate::app) coming_stops: Vec<Joint>,
    /// What motors it has, if it has some.
    pub(in crate::app) motors: Option<Motors>,
    /// Of skins, where bodies meet, and of obstacles `[1]`.
    pub(in crate::app) friction: Option<Span>,
    pub(in crate::app) restitution: Option<Span>,
    /// How thick skins are, where bodies meet `[m]`; `Some(None)`: as the rules choose, of some of them.
    pub(in crate::app) radius: Option<Option<Span>>,
    /// How many of the points are of layers that pass the others of their bodies, where bodies meet themselves.
    pub(in crate::app) layered: Option<usize>,
    /// The first few of its pins.
    pub(in crate::app) pins: Vec<Pin>,
    /// Of nothing but planes: by how much a depth pushes out `[N/m]` and `[N s/m]` in place of contact, as of the first of them, or
    /// `Some(None)`: it is contact.
    pub(in crate::app) penalty: Option<Option<[f64; 2]>>,
    /// The colour that points have of their own, if they have one.
    pub(in crate::app) color: Common<Option<[u8; 3]>>,
    /// How wide its bonds are drawn `[m]`; 0: as is usual.
    pub(in crate::app) width: Option<Span>,
    /// How many of its points are hidden.
    pub(in crate::app) hidden: usize,
}

impl Matter {
    /// Of what is meant in a world, whose joints had these stops and whose bodies are called by `names`; `None` where nothing of it is there.
    pub(in crate::app) fn of(
        (world, former): (&dyn Dynamics, &Former),
        (tints, names): (&[Tint], &[Option<String>]),
        among: &Among,
    ) -> Option<Self> {
        let points = among.points_of(world);
        let bonds = among.bonds_of(world);
        let obstacles = world.obstacles();
        let meant = || obstacles.iter().filter(|(number, _)| among.obstacles.contains(number)).map(|(_, one)| one);
        let solids: Vec<[f64; 2]> = meant().map(surface).collect();
        let penalties: Option<Vec<Option<[f64; 2]>>> = meant().map(penalty).collect();
        if points.is_empty() && solids.is_empty() {
            return None;
        }
        let spring = |(_, bond): &(u32, Bond)| match bond.kind {
            BondKind::Spring { stiffness, damping } => Some([stiffness, damping]),
            _ => None,
        };
        let springs: Vec<[f64; 2]> = bonds.iter().filter_map(spring).collect();
        let count = |is: fn(&BondKind) -> bool| bonds.iter().filter(|(_, bond)| is(&bond.kind)).count();
        let acts = |limit: Limit| bonds.iter().filter(|(_, bond)| bond.limit == limit).count();
        let relaxed = bonds.iter().filter_map(|(_, bond)| match bond.kind {
            BondKind::Relaxed { relaxation, .. } => Some(relaxation),
            _ => None,
        });
        let corrected = bonds.iter().filter_map(|(_, bond)| match bond.kind {
            BondKind::Relaxed { max_correction, .. } => Some(max_correction.min(NEVER)),
            _ => None,
        });
        let skins: Vec<[f64; 2]> = match world.contact().filter(|_| world.dimensions() == 2) {
            None => Vec::new(),
            Some(contact) => points
                .iter()
                .map(|&point| world.skin_of(point))
                .map(|skin| {
                    [skin.friction.unwrap_or(contact.friction), skin.restitution.unwrap_or(contact.restitution)]
                })
                .collect(),
        };
        let thick = world.contact().filter(|_| world.dimensions() == 2 && !points.is_empty()).map(|contact| {
            let radii = || points.iter().map(|&point| world.skin_of(point).radius.or(contact.radius));
            if radii().all(|radius| radius.is_some()) { Span::of(radii().flatten()) } else { None }
        });
        let meets_itself = |contact: &Contact| contact.with_itself && world.dimensions() == 2 && !points.is_empty();
        let is_layered = |point: &PointId| world.skin_of(*point).is_layer();
        let layered =
            world.contact().filter(meets_itself).map(|_| points.iter().filter(|point| is_layered(point)).count());
        let angles = among.angles_of(world, AngleAs::Joint);
        let ranges = || angles.iter().filter_map(|angle| angle.range);
        let knees = among.knees_of(world);
        let [least, most] = [0, 1].map(|side| Span::of(ranges().map(|range| range[side])));
        let surfaces = || skins.iter().chain(&solids);
        let arms = world.angles().iter().flat_map(|angle| [[0, 1], [1, 2]].map(|ends| ends.map(|k| angle.points[k])));
        let joined = bonds.iter().map(|(_, bond)| [bond.a, bond.b]).chain(arms);
        let count_of_bodies = bodies(&points, joined);
        let area: f64 = areas(world, &points).iter().map(|(_, area)| area).sum();
        let is_one = count_of_bodies == 1;
        let name = is_one.then(|| name_of(world, (&points, &bonds), (tints, names)));
        let tint = |point: PointId| Tint::of(tints, point.0);
        Some(Matter {
            points: points.len(),
            bonds: bonds.len(),
            obstacles: solids.len(),
            bodies: count_of_bodies,
            name,
            mass: points.iter().map(|point| world.masses()[point.index()]).sum(),
            area,
            kinds: [
                count(|kind| matches!(kind, BondKind::Rigid)),
                springs.len(),
                count(|kind| matches!(kind, BondKind::Relaxed { .. })),
            ],
            limits: [Limit::Both, Limit::Max, Limit::Min].map(acts),
            relaxation: Span::of(relaxed),
            max_correction: Span::of(corrected),
            radius: thick,
            layered,
            pins: pins(world, &points),
            stiffness: Span::of(springs.iter().map(|spring| spring[0])),
            damping: Span::of(springs.iter().map(|spring| spring[1])),
            breaks: Span::of(bonds.iter().map(|(_, bond)| bond.break_strain.min(NEVER))),
            bending: bending::shown(world, among),
            rest_length: Span::of(bonds.iter().map(|(_, bond)| bond.rest_length)),
            rest_angle: Span::of(held(&angles).map(|angle| angle.rest)),
            angle_damping: Span::of(angles.iter().map(|angle| angle.damping)),
            swings: swings(&angles),
            joints: [ranges().count(), angles.len() + knees.len()],
            stops: least.zip(most).map(|(least, most)| [least, most]),
            coming_stops: coming((world, former), &angles, &knees),
            motors: motors::shown(world, among),
            friction: Span::of(surfaces().map(|surface| surface[0])),
            restitution: Span::of(surfaces().map(|surface| surface[1])),
            penalty: penalties.and_then(|list| list.first().copied()).filter(|_| points.is_empty()),
            color: coloring(tints, &points),
            width: Span::of(bonds.iter().map(|(_, bond)| tint(bond.a).map_or(0.0, |tint| tint.width))),
            hidden: points.iter().filter(|point| Tint::hides(tints, point.0)).count(),
        })
    }

    /// Mass by area `[kg/m^2]`; `None` where it covers nothing.
    pub(in crate::app) fn density(&self) -> Option<f64> {
        (self.area > 0.0).then(|| self.mass / self.area)
    }

    /// The matter by name that all of it is of, if it is of one, whatever its colour is: what has a picture keeps that. How stiff its springs are
    /// depends on its size; how fast they calm down does not.
    pub(in crate::app) fn preset(&self) -> Option<Preset> {
        Preset::ALL.into_iter().find(|preset| {
            let stuff = preset.stuff();
            let is = |span: Option<Span>, x: f64| span.is_none_or(|span| span.is_all(x));
            let [rigid, springs, relaxed] = self.kinds;
            let calm = self.damping.zip(self.stiffness).map(|(damping, stiffness)| Span {
                least: damping.least / stiffness.least,
                most: damping.most / stiffness.most,
            });
            // Strings keep what they are made of.
            let is_bonded = self.limits[0] < self.bonds
                || is(self.breaks, stuff.breaks.unwrap_or(NEVER))
                    && match stuff.springs {
                        Some([_, slow]) => rigid + relaxed == 0 && is(calm, slow),
                        None => springs + relaxed == 0,
                    };
            self.density().is_none_or(|density| Span { least: density, most: density }.is_all(stuff.density))
                && is(self.friction, stuff.friction)
                && is(self.restitution, stuff.restitution)
                && is_bonded
        })
    }
}

/// The first few pins among points, each with the way that it is led along. Props go with their pins.
fn pins(world: &dyn Dynamics, points: &[PointId]) -> Vec<Pin> {
    let props = world.props();
    let is_meant = |pin: &PointId| points.binary_search(pin).is_ok() && props.binary_search(pin).is_err();
    let mut pins: Vec<PointId> = world.pinned().iter().copied().filter(is_meant).collect();
    pins.sort_unstable();
    pins.truncate(MOST_PINS);
    let tracks = if pins.is_empty() { Vec::new() } else { world.pin_tracks() };
    let knots =
        |point: PointId| tracks.iter().find(|(led, _)| *led == point).map_or_else(Vec::new, |(_, knots)| knots.clone());
    let of = |point: PointId| {
        let at = place(world, point);
        let about = world.angles().iter().filter(|angle| angle.points[1] == point).map(|angle| angle.points[0]);
        let mut own: Vec<PointId> = about.filter(|first| props.binary_search(first).is_ok()).collect();
        own.sort_unstable();
        own.dedup();
        let props = own.into_iter().map(|prop| (prop, sub(place(world, prop), at))).collect();
        Pin { point, at, knots: knots(point), props }
    };
    pins.into_iter().map(of).collect()
}

/// How many parts points are in that bonds and the arms of angles hold together.
fn bodies(points: &[PointId], held: impl Iterator<Item = [PointId; 2]>) -> usize {
    let place = |point: PointId| points.binary_search(&point).ok();
    let mut parent: Vec<usize> = (0..points.len()).collect();
    let root = |parent: &mut Vec<usize>, mut at: usize| {
        while parent[at] != at {
            parent[at] = parent[parent[at]];
            at = parent[at];
        }
        at
    };
    let mut count = points.len();
    for (a, b) in held.filter_map(|[a, b]| Some((place(a)?, place(b)?))) {
        let (a, b) = (root(&mut parent, a), root(&mut parent, b));
        count -= usize::from(a != b);
        parent[a.max(b)] = a.min(b);
    }
    count
}

fn coloring(tints: &[Tint], points: &[PointId]) -> Common<Option<[u8; 3]>> {
    let colors = points.iter().map(|point| Tint::of(tints, point.0).and_then(|tint| tint.color));
    Common::of(colors).unwrap_or_default()
}

/// What a depth in a plane is pushed out by, if it is; `None` of what is no plane.
fn penalty(obstacle: &Obstacle) -> Option<Option<[f64; 2]>> {
    let Obstacle::Plane { penalty, .. } = obstacle else { return None };
    Some(penalty.map(|penalty| [penalty.stiffness, penalty.damping]))
}

/// Friction and restitution of an obstacle.
fn surface(obstacle: &Obstacle) -> [f64; 2] {
    match obstacle {
        Obstacle::Plane { friction, restitution, .. } => [*friction, *restitution],
        Obstacle::Polygon(polygon) => [polygon.friction, polygon.restitution],
        Obstacle::Convex(convex) => [convex.friction, convex.restitution],
    }
}
