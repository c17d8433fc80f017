//! A plane in space: it has no end, so a patch of it about the scene is drawn, as a faint grid.

use glam::DVec3;

use crate::render::view::View;

/// A patch: ends of its lines `[m]`, those of its rim first.
pub(crate) struct Patch {
    pub(crate) lines: Vec<[DVec3; 2]>,
}

/// How many of a patch's lines are its rim.
pub(crate) const RIM: usize = 4;
/// How many cells a patch is wide.
const CELLS: u32 = 10;
/// Its width in diagonals of the box about the scene: what falls and spreads stays above it.
const ROOM: f64 = 1.3;

/// A patch for each plane, about the points as they are now.
///
/// Valid range: a plane without a normal has none; where no point is, the scene is taken as 2 m wide.
pub(super) fn patches(view: &View<'_>) -> Vec<Patch> {
    if view.planes.is_empty() {
        return Vec::new();
    }
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for first in (0..view.current.len()).step_by(3) {
        let at = DVec3::from_array(std::array::from_fn(|axis| view.current.get(first + axis)));
        (low, high) = if at.is_finite() { (low.min(at), high.max(at)) } else { (low, high) };
    }
    if !low.is_finite() {
        (low, high) = (DVec3::NEG_ONE, DVec3::ONE);
    }
    let (middle, size) = (0.5 * (low + high), ROOM * (high - low).length().max(1e-3));
    view.planes.iter().filter_map(|&plane| patch(plane.map(DVec3::from), middle, size)).collect()
}

fn patch([point, normal]: [DVec3; 2], middle: DVec3, size: f64) -> Option<Patch> {
    let normal = normal.try_normalize()?;
    let foot = middle - normal * (middle - point).dot(normal);
    // Along the axes of the world where the plane is level.
    let across = if normal.x.abs() < 0.9 { DVec3::X } else { DVec3::Z };
    let u = (across - normal * across.dot(normal)).normalize();
    let v = normal.cross(u);
    let at = |a: f64, b: f64| foot + 0.5 * size * (u * a + v * b);
    let line = |k: u32| {
        let share = 2.0 * f64::from(k) / f64::from(CELLS) - 1.0;
        [[at(share, -1.0), at(share, 1.0)], [at(-1.0, share), at(1.0, share)]]
    };
    let rim = [0, CELLS].into_iter().flat_map(line);
    Some(Patch { lines: rim.chain((1..CELLS).flat_map(line)).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_patch_lies_in_its_plane_below_the_scene() {
        let (point, normal) = (DVec3::new(7.0, -2.0, 1.0), DVec3::new(0.3, 2.0, -0.4));
        let middle = DVec3::new(1.0, 3.0, 2.0);
        let patch = patch([point, normal], middle, 6.0).unwrap();
        assert_eq!(patch.lines.len(), RIM + 2 * 9);
        let ends: Vec<DVec3> = patch.lines.iter().flatten().copied().collect();
        assert!(ends.iter().all(|&end| (end - point).dot(normal).abs() < 1e-12));
        let mean = ends.iter().sum::<DVec3>() / ends.len() as f64;
        assert!((mean - middle).cross(normal).length() < 1e-12, "straight below");
        assert!(super::patch([point, DVec3::ZERO], middle, 6.0).is_none());
    }
}
