//! A rope that hangs on other bodies: a click on it selects it by itself, not all that hangs together with it.

use glam::DVec2;

use super::chosen::Chosen;
use super::pick::Scope;
use crate::picture::Tint;
use crate::sim::PointId;

impl Chosen {
    /// What a click at a pixel selects: all that hangs together there, or of that the rope alone.
    pub(super) fn clicked(&self, scope: Scope<'_>, at: DVec2) -> Self {
        let point = scope.nearest(at).map(|hit| hit.point).filter(|point| self.points.binary_search(point).is_ok());
        let is_grouped = |point: &PointId| scope.shown.scenery.groups.iter().any(|group| group.points.contains(point));
        let strand = point.filter(|point| !is_grouped(point)).map(|point| strand(scope, &self.points, point));
        match strand {
            Some(points) if !points.is_empty() => Chosen { points, ..Chosen::default() },
            _ => self.clone(),
        }
    }
}

/// Of points that hang together those of the body that one of them is of, where that is a rope among others: bonds in a row, which are sides of no
/// triangle. Empty where it is none.
fn strand(scope: Scope<'_>, all: &[PointId], point: PointId) -> Vec<PointId> {
    let scenery = &scope.shown.scenery;
    let body = |point: PointId| Tint::of(&scenery.tints, point.0).map(|tint| tint.body);
    let own: Vec<PointId> = all.iter().copied().filter(|&other| body(other) == body(point)).collect();
    let place = |point: &PointId| own.binary_search(point).ok();
    if own.len() == all.len() || scenery.triangles.iter().flatten().any(|corner| place(corner).is_some()) {
        return Vec::new();
    }
    let (mut ends, mut count) = (vec![0_u8; own.len()], 0);
    for [a, b] in scenery.bonds.ends().iter().filter_map(|[a, b]| Some([place(a)?, place(b)?])) {
        count += 1;
        ends[a] = ends[a].saturating_add(1);
        ends[b] = ends[b].saturating_add(1);
    }
    let is_row = count > 0 && count + 1 == own.len() && ends.iter().all(|ends| *ends <= 2);
    if is_row { own } else { Vec::new() }
}
