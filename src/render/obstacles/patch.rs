//! A plane in space: it has no end, so a patch of it about the scene is drawn, as a faint grid that lies still in the world.

use glam::DVec3;

use crate::render::view::View;

/// A patch: ends of its lines `[m]`, those of its rim first.
pub(crate) struct Patch {
    pub(crate) lines: Vec<[DVec3; 2]>,
    /// What it was made about.
    about: About,
}

/// The middle of the scene, and how wide a patch below it is to be `[m]`.
#[derive(Clone, Copy)]
struct About {
    middle: DVec3,
    size: f64,
}

impl About {
    /// Whether a patch about another scene serves this one too: its bodies have moved or spread little.
    fn is_served(self, by: About) -> bool {
        let is_near = self.middle.distance(by.middle) < NEAR * by.size;
        is_near && (LESS * by.size..=by.size / LESS).contains(&self.size)
    }
}

/// How many of a patch's lines are its rim.
pub(crate) const RIM: usize = 4;
/// How many cells a patch is wide, about: their width is round, and their lines lie at multiples of it.
const CELLS: f64 = 10.0;
/// Its width in diagonals of the box about the scene: what falls and spreads stays above it.
const ROOM: f64 = 1.3;
/// A patch stays as it is while the scene's middle goes no further, in its width, and its own width would be no less and no more `[1]`.
const NEAR: f64 = 0.25;
const LESS: f64 = 0.6;

/// A patch for each plane, about the points as they are now, or those that were drawn of the same planes where these serve.
///
/// Valid range: a plane without a normal has none; where no point is, the scene is taken as 2 m wide.
pub(super) fn patches(view: &View<'_>, before: Vec<Patch>) -> Vec<Patch> {
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
    let about = About { middle: 0.5 * (low + high), size: ROOM * (high - low).length().max(1e-3) };
    if !before.is_empty() && before.iter().all(|patch| about.is_served(patch.about)) {
        return before;
    }
    view.planes.iter().filter_map(|&plane| patch(plane.map(DVec3::from), about)).collect()
}

fn patch([point, normal]: [DVec3; 2], about: About) -> Option<Patch> {
    let normal = normal.try_normalize()?;
    // What lies nearest to the origin of the world: from there lines are counted.
    let foot = normal * point.dot(normal);
    // Along the axes of the world where the plane is level.
    let across = if normal.x.abs() < 0.9 { DVec3::X } else { DVec3::Z };
    let u = (across - normal * across.dot(normal)).normalize();
    let v = normal.cross(u);
    let step = round(about.size / CELLS);
    let ends = [u, v].map(|side| {
        let middle = (about.middle - foot).dot(side);
        [((middle - 0.5 * about.size) / step).floor(), ((middle + 0.5 * about.size) / step).ceil()]
    });
    let at = |a: f64, b: f64| foot + step * (u * a + v * b);
    let [[left, right], [low, high]] = ends;
    let along = |a: f64| [at(a, low), at(a, high)];
    let across = |b: f64| [at(left, b), at(right, b)];
    let inner = |[from, to]: [f64; 2]| (1..(to - from) as u32).map(move |k| from + f64::from(k));
    let rim = [along(left), across(low), along(right), across(high)];
    let lines = rim.into_iter().chain(inner(ends[0]).map(along)).chain(inner(ends[1]).map(across)).collect();
    Some(Patch { lines, about })
}

/// The number of the series 1, 2, 5, 10, … that is nearest to one above 0.
fn round(number: f64) -> f64 {
    let decade = 10_f64.powf(number.log10().floor());
    let all = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * decade);
    all.into_iter().min_by(|a, b| (a - number).abs().total_cmp(&(b - number).abs())).unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_patch_lies_in_its_plane_below_the_scene() {
        let (point, normal) = (DVec3::new(7.0, -2.0, 1.0), DVec3::new(0.3, 2.0, -0.4));
        let middle = DVec3::new(1.0, 3.0, 2.0);
        let about = About { middle, size: 6.0 };
        let patch = patch([point, normal], about).unwrap();
        assert!((RIM + 2 * 9..RIM + 2 * 15).contains(&patch.lines.len()));
        let ends: Vec<DVec3> = patch.lines.iter().flatten().copied().collect();
        assert!(ends.iter().all(|&end| (end - point).dot(normal).abs() < 1e-12));
        let mean = patch.lines[..RIM].iter().flatten().sum::<DVec3>() / (2 * RIM) as f64;
        assert!((mean - middle).cross(normal.normalize()).length() < 0.5, "below, by whole cells");
        assert!(super::patch([point, DVec3::ZERO], about).is_none());
    }

    #[test]
    fn its_lines_lie_still_in_the_world_while_bodies_move() {
        let bonds = crate::sim::Bonds::default();
        let planes = vec![[[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]]];
        let lines = |by: f64, before: Vec<Patch>| {
            let places = [-1.0 + by, 0.0, -1.0, 1.0 + by, 1.0, 1.0];
            let current = crate::sim::Positions::F64(&places);
            patches(&View { planes: planes.clone(), current, ..View::empty(&bonds, 3) }, before)
        };
        let at = |patch: &Patch| patch.lines.clone();
        let first = lines(0.0, Vec::new()).remove(0);
        let kept = lines(0.3, vec![Patch { lines: at(&first), ..first }]).remove(0);
        assert_eq!(at(&kept), at(&first), "nothing of it moves");
        // About what is far off there is another patch, of the same lattice.
        let other = lines(7.37, vec![kept]).remove(0);
        let step = 0.5;
        for [x, y, z] in at(&other).into_iter().flatten().map(|end| end.to_array()) {
            assert_eq!(y, -1.0);
            assert!([x, z].into_iter().all(|x| (x / step - (x / step).round()).abs() < 1e-9), "{x} {z}");
        }
        assert!(at(&other).iter().flatten().any(|end| end.x > 8.0));
    }
}
