//! The brush that gives bodies another matter where it goes over them.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3};

use super::marks::{Mark, Role};
use super::pick::Scope;
use super::segments::distance_to_segment;
use crate::app::matter::{Among, MatterChange, NEVER, Painted, Preset, Switched};
use crate::picture::Tint;
use crate::sim::{BondKind, PointId};

/// Radii that the brush may have `[logical px]`.
pub(in crate::app) const RADII: [f64; 2] = [6.0, 120.0];
/// A stroke looks what is under it so often, in radii of the brush.
const STEP: f64 = 0.5;
/// What a stroke over no body is told.
pub(super) const NOTHING: &str = "the brush gives bodies another matter: drag it over one";
/// The same over an obstacle.
pub(super) const SOLID: &str = "an obstacle is of no matter: select it (6) to change its friction";
/// The brush itself, where it paints no colour.
const NO_COLOR: [u8; 3] = [200, 208, 220];
/// Bonds under the brush that are drawn at most.
const MOST: usize = 4000;

/// What the brush paints with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct Brush {
    pub(in crate::app) preset: Preset,
    /// In place of that, where any is switched on.
    pub(in crate::app) numbers: Painted,
    /// `[logical px]`
    pub(in crate::app) radius: f64,
}

impl Default for Brush {
    fn default() -> Self {
        Brush { preset: Preset::Rubber, numbers: Painted::default(), radius: 24.0 }
    }
}

/// What a stroke of the brush went over so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Stroke {
    points: BTreeSet<PointId>,
    bonds: BTreeSet<u32>,
    last: DVec2,
}

impl Brush {
    /// What becomes of what it goes over.
    pub(in crate::app) fn change(self) -> MatterChange {
        if self.numbers.is_any() { MatterChange::Painted(self.numbers) } else { MatterChange::Preset(self.preset) }
    }

    /// What that is called.
    pub(in crate::app) fn name(self) -> String {
        match self.numbers.changes() {
            changes if changes.is_empty() => self.preset.name().to_owned(),
            changes => changes.into_iter().map(MatterChange::name).collect::<Vec<_>>().join(", "),
        }
    }

    /// The colour of what it is about to paint: of numbers without one grey.
    pub(super) fn color(self) -> [u8; 3] {
        match self.change() {
            MatterChange::Painted(Painted { color, .. }) if color.is_on => color.value,
            MatterChange::Painted(_) => NO_COLOR,
            _ => self.preset.color(),
        }
    }

    /// A stroke begins at a pixel.
    pub(super) fn begin(self, scope: Scope<'_>, at: DVec2) -> Stroke {
        let mut stroke = Stroke { last: at, ..Stroke::default() };
        self.touch(scope, &mut stroke, at);
        stroke
    }

    /// It goes on to a pixel.
    pub(super) fn trace(self, scope: Scope<'_>, stroke: &mut Stroke, at: DVec2) {
        let from = stroke.last;
        let step = STEP * self.radius * scope.scale;
        if from.distance(at) < 0.5 * step {
            return;
        }
        let count = (from.distance(at) / step).ceil().clamp(1.0, 64.0);
        for k in 1..=count as u32 {
            self.touch(scope, stroke, from.lerp(at, f64::from(k) / count));
        }
        stroke.last = at;
    }

    fn touch(self, scope: Scope<'_>, stroke: &mut Stroke, at: DVec2) {
        let reach = self.radius * scope.scale;
        let points = (0..scope.shown.point_count() as u32).map(PointId).filter(|&point| scope.is_there(point));
        stroke.points.extend(points.filter(|&point| scope.pixel(point).is_some_and(|x| x.distance(at) <= reach)));
        let ends = scope.shown.scenery.bonds.ends().iter().enumerate();
        let under = |&(_, &[a, b]): &(usize, &[PointId; 2])| {
            let ends = scope.pixel(a).zip(scope.pixel(b));
            ends.is_some_and(|(a, b)| distance_to_segment(at, a, b) <= reach)
        };
        stroke.bonds.extend(ends.filter(under).map(|(place, _)| scope.shown.scenery.bond_number(place)));
    }

    /// The brush with the numbers of the springs under a pixel, and of their body, switched on, and what they are in words; `None` where
    /// there are none.
    pub(super) fn taking(self, scope: Scope<'_>, at: DVec2) -> Option<(Self, String)> {
        let (place, _) = scope.bond(at)?;
        let scenery = &scope.shown.scenery;
        let bond = scenery.bonds.get(place);
        let BondKind::Spring { stiffness, damping } = bond.kind else { return None };
        let body = scope.body(bond.a);
        let mass: f64 = body.iter().map(|point| scenery.masses[point.index()]).sum();
        let is_of_it = |corners: &&[PointId; 3]| body.binary_search(&corners[0]).is_ok();
        let area = |corners: &[PointId; 3]| {
            let [a, b, c] = corners.map(|corner| DVec3::from(scope.shown.place(corner.index())));
            0.5 * (b - a).cross(c - a).length()
        };
        let area: f64 = scenery.triangles.iter().filter(is_of_it).map(area).sum();
        let on = |value: f64| Switched { is_on: true, value };
        let mut numbers = Painted { stiffness: on(stiffness), damping: on(damping), ..self.numbers };
        let mut words = format!("the brush paints what lies here: {stiffness:.0} N/m, {damping:.2} N s/m");
        if area > 0.0 {
            numbers.density = on(mass / area);
            words.push_str(&format!(", {:.2} kg/m²", mass / area));
        }
        if bond.break_strain < NEVER {
            numbers.breaks = on(bond.break_strain);
        }
        if let Some(tint) = Tint::of(&scenery.tints, bond.a.0) {
            numbers.color.value = tint.color.unwrap_or(numbers.color.value);
            numbers.width.value = tint.width;
        }
        Some((Brush { numbers, ..self }, words))
    }

    /// The brush where it is.
    pub(super) fn marks(self, scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
        vec![Mark::Ring(Role::Paint(self.color()), at, self.radius * scope.scale)]
    }
}

impl Stroke {
    /// What it went over.
    pub(super) fn among(&self) -> Among {
        Among {
            points: self.points.iter().copied().collect(),
            bonds: Some(self.bonds.iter().copied().collect()),
            obstacles: Vec::new(),
        }
    }

    /// What it went over, in the colour that it will have.
    pub(super) fn marks(&self, scope: Scope<'_>, color: [u8; 3]) -> Vec<Mark> {
        let role = Role::Paint(color);
        let scenery = &scope.shown.scenery;
        let bonds = scenery.bonds.ends().iter().enumerate();
        let bonds = bonds.filter(|(place, _)| self.bonds.contains(&scenery.bond_number(*place))).take(MOST);
        let width = 2.5 * scope.scale;
        let lines = bonds.filter_map(|(_, &[a, b])| Some(Mark::Line(role, scope.pixel(a)?, scope.pixel(b)?, width)));
        let alone = self.points.iter().filter(|_| self.bonds.is_empty()).take(MOST);
        let rings = alone.filter_map(|&point| Some(Mark::Ring(role, scope.pixel(point)?, 5.0 * scope.scale)));
        lines.chain(rings).collect()
    }
}
