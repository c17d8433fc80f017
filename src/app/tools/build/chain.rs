//! Points and bonds, drawn one after the other: the chain comes into the world as a whole when it ends.

use std::collections::BTreeSet;

use glam::DVec2;

use super::corners::{area, crossing};
use super::fill::filled;
use super::grain::Grain;
use super::links::Links;
use super::neighbours::about;
use super::outline::{label, line, pixel};
use super::tie::{is_walled_off, nearest_of_skin};
use super::{CLICK, LEAST, SNAP, Step};
use crate::app::action::Primitive;
use crate::app::count::counted;
use crate::app::matter::Preset;
use crate::app::tools::marks::{Mark, Role};
use crate::app::tools::pick::Scope;
use crate::app::tools::segments::distance_to_segment;
use crate::app::tools::{Deed, knot};
use crate::history::Do;
use crate::scene::{AddKeys, BondKeys, PointKeys, Vector};
use crate::sim::PointId;
use crate::sim::bond::lower_first;

/// Said where a chain ends with nothing to bond.
const ALONE: &str = "a bond needs two points";
/// Said where its bonds are there already.
const BONDED: &str = "they are bonded already";
/// Said where they are of one rigid body.
const FIRM: &str = "both points are of one rigid body: a bond between them does nothing";
/// Said where a loop goes around next to nothing.
const FLAT: &str = "the loop goes around nothing: it has its sides, and is not filled";
const SMALL: &str = "the loop is too small to be filled: it has its sides";
/// A loop that is less wide than this share of its length goes around nothing `[1]`.
const THIN: f64 = 1e-3;
/// Width of the lines to what a point is bonded to beside the chain `[logical px]`.
const THIN_LINE: f64 = 1.0;
/// Said where a point of the world that it was drawn to is gone.
const GONE: &str = "a point that it was drawn to is gone: draw it again";
/// Said where a point would lie beyond the walls.
const OUTSIDE: &str = "beyond the walls: bonds are drawn within them";
/// Said where a loop cannot be filled.
const CROSSES: &str = "the loop crosses itself: it has its sides, and is not filled";

/// What a chain goes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Node {
    /// A point of its own, counted from 0.
    Own(usize),
    /// A point of the world.
    World(PointId),
}

/// What a chain comes to.
#[derive(Clone, Copy)]
pub(in crate::app::tools) struct How {
    pub(super) links: Links,
    /// What a loop is filled with, and how finely; `None`: it is not.
    pub(super) fills: Option<(Preset, Grain)>,
}

/// Points and bonds that are being drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::app::tools) struct Chain {
    /// Its own points `[m]`.
    own: Vec<DVec2>,
    nodes: Vec<Node>,
    /// What points of its own were bonded to as they came, beside the node before them.
    ties: Vec<(usize, Node)>,
    /// While the button is down: where it was pressed `[px]`, and whether that is where the chain had come to.
    pressed: Option<(DVec2, bool)>,
}

/// A line of what a point is bonded to beside the chain.
fn thin(scope: Scope<'_>, ends: [DVec2; 2]) -> Mark {
    Mark::Line(Role::Come, ends[0], ends[1], THIN_LINE * scope.scale)
}

/// What a point is bonded to beside the chain, in words.
fn bonded(ties: &[Node]) -> String {
    format!("bonded to {} in reach", counted(ties.len(), "point"))
}

fn flat(at: &Vector) -> DVec2 {
    let [x, y, _] = at.embed();
    DVec2::new(x, y)
}

/// Whether corners lie on one line, but for less than a hand can draw.
fn is_flat(corners: &[DVec2]) -> bool {
    let next = corners.iter().cycle().skip(1);
    let long: f64 = corners.iter().zip(next).map(|(a, b)| a.distance(*b)).sum();
    let off = |corner: &DVec2| {
        let far = corners.iter().max_by(|a, b| a.distance(corners[0]).total_cmp(&b.distance(corners[0])));
        far.map_or(0.0, |far| distance_to_segment(*corner, corners[0], *far))
    };
    corners.iter().map(off).fold(0.0, f64::max) <= THIN * long
}

impl Chain {
    /// The button goes down: the chain goes on to what lies there.
    pub(in crate::app::tools) fn press(&mut self, scope: Scope<'_>, at: DVec2, links: Links) -> Step {
        if self.is_outside(scope, at) {
            self.pressed = None;
            let words = OUTSIDE.to_owned();
            return if self.nodes.is_empty() { Step::Done(Deed::words(words)) } else { Step::GoesOn(Some(words)) };
        }
        let is_last = self.node(scope, at).is_some_and(|node| self.nodes.last() == Some(&node));
        self.pressed = Some((at, is_last));
        self.reach(scope, at, links);
        Step::GoesOn(None)
    }

    /// The button goes up: a drag goes on to what lies there, a second click ends the chain, and so does its first point.
    pub(in crate::app::tools) fn release(&mut self, scope: Scope<'_>, at: DVec2, how: How) -> Step {
        let Some((pressed, was_last)) = self.pressed.take() else { return Step::GoesOn(None) };
        let is_click = pressed.distance(at) < CLICK * scope.scale;
        if !is_click && self.is_outside(scope, at) {
            return Step::GoesOn(Some(OUTSIDE.to_owned()));
        }
        if !is_click {
            self.reach(scope, at, how.links);
        }
        if (is_click && was_last) || self.is_loop() {
            return Step::Done(self.end(scope, how));
        }
        Step::GoesOn(None)
    }

    /// Whether a point of its own at a pixel would lie beyond the walls.
    fn is_outside(&self, scope: Scope<'_>, at: DVec2) -> bool {
        self.node(scope, at).is_none() && is_walled_off(scope, scope.in_plane(at))
    }

    /// It goes on to what lies at a pixel, which may be where it is.
    fn reach(&mut self, scope: Scope<'_>, at: DVec2, links: Links) {
        let node = self.node(scope, at).unwrap_or_else(|| {
            let (own, ties) = (self.own.len(), self.neighbours(scope, at, links));
            self.ties.extend(ties.into_iter().map(|node| (own, node)));
            self.own.push(scope.in_plane(at));
            Node::Own(self.own.len() - 1)
        });
        if self.nodes.last() != Some(&node) {
            self.nodes.push(node);
        }
    }

    /// The nearest of its points and those of the world in reach of a pixel.
    fn node(&self, scope: Scope<'_>, at: DVec2) -> Option<Node> {
        let far = |place: DVec2| pixel(scope, place).map(|there| there.distance(at));
        let own = self.own.iter().enumerate().filter_map(|(k, place)| Some((far(*place)?, Node::Own(k))));
        let world = scope.reached(at).into_iter().take(1);
        let world = world.filter_map(|point| Some((scope.pixel(point)?.distance(at), Node::World(point))));
        let near = own.chain(world).filter(|(far, _)| *far <= SNAP * scope.scale);
        let near = near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, node)| node);
        // What lies within a body would be pushed out of it for ever: on a body the bond goes to its skin.
        near.or_else(|| nearest_of_skin(scope, at).map(Node::World))
    }

    /// What a point of its own at a pixel would be bonded to, beside the node before it.
    fn neighbours(&self, scope: Scope<'_>, at: DVec2, links: Links) -> Vec<Node> {
        if !links.connects {
            return Vec::new();
        }
        let seen = |node: Node| Some((node, pixel(scope, self.place(scope, node)?)?));
        let mut all: Vec<Node> = Vec::new();
        for node in (0..self.own.len()).map(Node::Own).chain(self.nodes.iter().copied()) {
            if !all.contains(&node) {
                all.push(node);
            }
        }
        let of_chain: Vec<(Node, DVec2)> = all.into_iter().filter_map(seen).collect();
        let last = self.nodes.last().copied().and_then(seen);
        about(scope, (at, f64::from(links.reach) * scope.scale), &of_chain, last)
    }

    /// Whether it has come back to where it began.
    fn is_loop(&self) -> bool {
        self.nodes.len() > 3 && self.nodes.first() == self.nodes.last()
    }

    /// Takes the last point back. Returns whether there is one left.
    pub(in crate::app::tools) fn step_back(&mut self) -> bool {
        self.pressed = None;
        if let Some(Node::Own(k)) = self.nodes.pop()
            && k + 1 == self.own.len()
            && !self.nodes.contains(&Node::Own(k))
        {
            self.own.pop();
            self.ties.retain(|(own, _)| *own != k);
        }
        !self.nodes.is_empty()
    }

    /// Whether there is a bond in it.
    pub(in crate::app::tools) fn has_bonds(&self) -> bool {
        self.nodes.len() > 1 || !self.ties.is_empty()
    }

    /// Where a node is `[m]`; `None` of a point that is gone.
    fn place(&self, scope: Scope<'_>, node: Node) -> Option<DVec2> {
        match node {
            Node::Own(k) => self.own.get(k).copied(),
            Node::World(point) => scope.is_there(point).then(|| {
                let [x, y, _] = scope.shown.place(point.index());
                DVec2::new(x, y)
            }),
        }
    }

    /// How many points a loop with these corners brings where it is filled; `None` where it cannot be.
    fn count(&self, scope: Scope<'_>, corners: &[DVec2], of: (Preset, Grain)) -> Option<usize> {
        let size = area(corners).abs() * scope.camera.pixels_per_metre().powi(2);
        let is_covered = |point: u32| scope.is_a_corner(PointId(point));
        let is_large = size >= (LEAST * scope.scale).powi(2);
        let known = (scope.shown.point_count() as u32, is_covered);
        let keys = is_large.then(|| filled((corners, &self.nodes), of, known).ok()).flatten()?;
        Some(keys.points.map_or(0, |points| points.position.len()))
    }

    /// It is as it is: what comes into the world, filled where it is a loop and that is wished.
    pub(in crate::app::tools) fn end(&self, scope: Scope<'_>, How { links, fills }: How) -> Deed {
        let places: Option<Vec<DVec2>> = self.nodes.iter().map(|node| self.place(scope, *node)).collect();
        let Some(places) = places else { return Deed::words(GONE.to_owned()) };
        let is_covered = |point: u32| scope.is_a_corner(PointId(point));
        let give = |keys: AddKeys| Deed::edit(Primitive::Bonds.name(), Do::Add(Box::new(keys)));
        let mut words = None;
        if let Some(of) = fills.filter(|_| self.is_loop()) {
            let corners = &places[..places.len() - 1];
            let size = area(corners).abs() * scope.camera.pixels_per_metre().powi(2);
            match () {
                () if is_flat(corners) => words = Some(FLAT.to_owned()),
                () if crossing(corners, true).contains(&true) => words = Some(CROSSES.to_owned()),
                () if size < (LEAST * scope.scale).powi(2) => words = Some(SMALL.to_owned()),
                () => match filled((corners, &self.nodes), of, (scope.shown.point_count() as u32, is_covered)) {
                    Ok(mut keys) => {
                        keys.bonds.extend(self.moorings(scope, &keys, links));
                        let knots = knot::knots(scope, &keys, (DVec2::ZERO, None));
                        let commands = knot::tied(scope, keys, &knots);
                        return Deed { commands, words: knot::words(scope, &knots), ..give(AddKeys::default()) };
                    }
                    Err(why) => words = Some(why),
                },
            }
        }
        match self.sides(scope, links) {
            Ok(keys) => Deed { words, ..give(keys) },
            Err(why) => Deed::words(why.to_owned()),
        }
    }

    /// What of its points is bonded to points of the world, where a body fills it whose corners they are: bonds within it are of no use there.
    fn moorings(&self, scope: Scope<'_>, body: &AddKeys, links: Links) -> Vec<BondKeys> {
        let next = scope.shown.point_count() as u32;
        let places: Vec<DVec2> = body.points.iter().flat_map(|points| &points.position).map(flat).collect();
        let corner = |own: DVec2| {
            let far = |place: &DVec2| place.distance_squared(own);
            let nearest = places.iter().zip(next..).min_by(|a, b| far(a.0).total_cmp(&far(b.0)));
            nearest.map(|(_, number)| number)
        };
        let outside =
            self.ties.iter().filter(|(_, node)| !self.nodes.contains(node) && self.place(scope, *node).is_some());
        let bonds = outside.filter_map(|&(own, node)| match node {
            Node::World(point) => Some(links.bond(BondKeys::new(point.0, corner(self.own[own])?), self.own.len())),
            Node::Own(_) => None,
        });
        bonds.collect()
    }

    /// Its points and its bonds, each once.
    fn sides(&self, scope: Scope<'_>, links: Links) -> Result<AddKeys, &'static str> {
        let next = scope.shown.point_count() as u32;
        let number = |node: &Node| match node {
            Node::Own(k) => next + *k as u32,
            Node::World(point) => point.0,
        };
        let own_pairs = self.nodes.windows(2).map(|pair| lower_first([number(&pair[0]), number(&pair[1])]));
        let ties = self.ties.iter().filter(|(_, node)| self.place(scope, *node).is_some());
        let ties = ties.map(|(own, node)| lower_first([number(&Node::Own(*own)), number(node)]));
        let mut pairs: BTreeSet<[u32; 2]> = own_pairs.chain(ties).collect();
        let is_drawn = !pairs.is_empty();
        scope.shown.scenery.bonds.ends().iter().for_each(|[a, b]| {
            pairs.remove(&lower_first([a.0, b.0]));
        });
        let is_bonded = pairs.is_empty();
        let firm = scope.rigid_pieces();
        pairs.retain(|ends| ends[1] >= next || !firm.holds(ends.map(PointId)));
        if pairs.is_empty() && (is_drawn || self.own.is_empty()) {
            return Err(match is_drawn {
                true if is_bonded => BONDED,
                true => FIRM,
                false => ALONE,
            });
        }
        let points = PointKeys {
            position: self.own.iter().map(|at| Vector::Plane(at.to_array())).collect(),
            mass: None,
            velocity: None,
            pinned: Vec::new(),
        };
        let bonds = pairs.into_iter().map(|[a, b]| links.bond(BondKeys::new(a, b), self.own.len()));
        Ok(AddKeys {
            points: Some(points).filter(|_| !self.own.is_empty()),
            bonds: bonds.collect(),
            ..AddKeys::default()
        })
    }

    /// What it is so far, and what a press at the pixel would make of it.
    pub(in crate::app::tools) fn marks(&self, scope: Scope<'_>, at: Option<DVec2>, how: How) -> Vec<Mark> {
        let How { links, fills } = how;
        let seen = |node: Node| self.place(scope, node).and_then(|place| pixel(scope, place));
        let ends = self.nodes.windows(2).filter_map(|pair| Some([seen(pair[0])?, seen(pair[1])?]));
        let mut marks: Vec<Mark> = ends.map(|ends| line(scope, Role::Come, ends)).collect();
        let tied = self.ties.iter().filter_map(|(own, node)| Some([seen(Node::Own(*own))?, seen(*node)?]));
        marks.extend(tied.map(|ends| thin(scope, ends)));
        let knobs = self.own.iter().filter_map(|place| pixel(scope, *place));
        marks.extend(knobs.map(|at| Mark::Knob(Role::Come, at, 4.0 * scope.scale)));
        let Some(at) = at else { return marks };
        let node = self.node(scope, at);
        let there = node.and_then(seen).unwrap_or(at);
        let last = self.nodes.last().copied();
        if let Some(from) = last.and_then(seen) {
            marks.push(line(scope, Role::Come, [from, there]));
        }
        let is_outside = node.is_none() && is_walled_off(scope, scope.in_plane(at));
        let is_new = node.is_none() && !is_outside;
        let ties = if is_new { self.neighbours(scope, at, links) } else { Vec::new() };
        marks.extend(ties.iter().filter_map(|tie| seen(*tie)).map(|tie| thin(scope, [there, tie])));
        match node {
            Some(_) => marks.push(Mark::Ring(Role::Hold, there, 9.0 * scope.scale)),
            None => marks.push(Mark::Knob(Role::Come, there, 4.0 * scope.scale)),
        }
        let long = last.and_then(|last| self.place(scope, last)).map_or(0.0, |from| {
            let to = node.and_then(|node| self.place(scope, node)).unwrap_or_else(|| scope.in_plane(at));
            from.distance(to)
        });
        let closes = self.nodes.len() > 2 && node == self.nodes.first().copied();
        let corners: Option<Vec<DVec2>> = self.nodes.iter().map(|node| self.place(scope, *node)).collect();
        let corners = corners.filter(|_| closes && fills.is_some());
        let why_not = corners.as_ref().and_then(|corners| match () {
            () if is_flat(corners) => Some(FLAT),
            () if crossing(corners, true).contains(&true) => Some(CROSSES),
            () => None,
        });
        if why_not.is_some() {
            marks = marks.into_iter().map(|mark| mark.with(Role::Away)).collect();
        }
        let is_firm = match (last, node) {
            (Some(Node::World(a)), Some(Node::World(b))) if a != b => scope.rigid_pieces().holds([a, b]),
            _ => false,
        };
        if is_outside {
            marks = marks.into_iter().map(|mark| mark.with(Role::Away)).collect();
        }
        let words = match node {
            _ if is_outside => OUTSIDE.to_owned(),
            _ if is_firm => FIRM.to_owned(),
            _ if why_not.is_some() => why_not.unwrap_or_default().to_owned(),
            None if last.is_none() && ties.is_empty() => "a point: click on, or drag to the next one".to_owned(),
            None if last.is_none() => format!("a point, {}", bonded(&ties)),
            None if !ties.is_empty() => format!("{}, {long:.2} m, {}", links.name(), bonded(&ties)),
            Some(_) if last.is_none() => "from this point".to_owned(),
            _ if closes => match fills {
                Some(of) => {
                    let filled = format!("closes the loop and fills it: {}", of.0.name().to_lowercase());
                    match corners.and_then(|corners| self.count(scope, &corners, of)) {
                        Some(count) => format!("{filled}, {}", counted(count, "point")),
                        None => filled,
                    }
                }
                None => format!("closes the loop: {}", links.name()),
            },
            Some(_) if node == last && self.nodes.len() > 1 => "once more ends it".to_owned(),
            Some(_) if node == last => "the next point".to_owned(),
            _ => format!("{}, {long:.2} m", links.name()),
        };
        marks.push(label(scope, at, words));
        marks
    }
}
