//! The camera as it is drawn back and moved for what it shows to lie where nothing lies over the picture.

use glam::{DVec2, DVec3};

use super::extent::{include, points, surroundings};
use crate::render::{Camera, Pose, View};

/// Room between points and what lies over the picture, as a share of its lesser side `[1]`: pins are as wide.
pub(super) const BESIDE: f64 = 0.02;

/// What of a picture nothing lies over `[px]`: its left upper and its right lower corner.
pub type Free = [[f64; 2]; 2];

/// The camera drawn back and moved as little as it takes that all sides of points and walls which it shows lie in the free part of its
/// picture, in one higher than wide in the middle of its height; in space as it is.
pub fn clear(camera: Camera, seen: &View<'_>, free: Free) -> Camera {
    clear_with(camera, seen, None, free)
}

/// The same of one more box, if there is one `[m]`.
pub(super) fn clear_with(camera: Camera, seen: &View<'_>, more: Option<[[f64; 3]; 2]>, free: Free) -> Camera {
    let mut own = points(seen);
    more.iter().flatten().for_each(|corner| include(&mut own, corner));
    clear_of(camera, &[own, surroundings(seen)], free)
}

/// The camera moved as little as it takes that all sides of points which it shows lie in the free part of its picture, whatever becomes of walls;
/// `None`: they have no room there as large as they are, or the picture is higher than wide.
pub(super) fn moved(camera: Camera, seen: &View<'_>, free: Free) -> Option<Camera> {
    let [width, height] = camera.viewport();
    let own = clear_of(camera, &[points(seen)], free);
    (width >= height && own.pixels_per_metre() == camera.pixels_per_metre()).then_some(own)
}

/// The camera drawn back and moved as little as it takes for what lies in some boxes `[m]`: that of points, and that of walls, if they count.
fn clear_of(mut camera: Camera, boxes: &[[[f64; 3]; 2]], free: Free) -> Camera {
    let Pose::Plane { .. } = camera.pose else { return camera };
    let viewport = DVec2::from(camera.viewport().map(f64::from));
    let (middle, is_upright) = (0.5 * viewport, viewport.y > viewport.x);
    let on_screen = |extent: [[f64; 3]; 2]| {
        let seen = extent.into_iter().filter(|corner| corner[..2].iter().all(|x| x.is_finite()));
        seen.filter_map(|[x, y, _]| camera.screen_from_world(DVec3::new(x, y, 0.0))).collect::<Vec<_>>()
    };
    let all: Vec<Vec<[f64; 2]>> = boxes.iter().copied().map(on_screen).collect();
    // Points are drawn wider than they are, whatever the scale is.
    let wider = [BESIDE * viewport.min_element(), 0.0];
    let (mut back, mut sides) = (1.0_f64, [[None; 2]; 2]);
    for axis in 0..2 {
        for ((corners, wider), side) in all.iter().zip(wider).zip(&mut sides[axis]) {
            let shown = corners.iter().map(|corner| corner[axis]).filter(|x| (0.0..=viewport[axis]).contains(x));
            let [low, high] = shown.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
            if low <= high {
                *side = Some([low, high, wider]);
            }
        }
        let room = free[1][axis] - free[0][axis];
        for [_, high, above] in sides[axis].iter().flatten() {
            for [low, _, below] in sides[axis].iter().flatten().filter(|side| above + side[2] < room) {
                back = back.max((high - low) / (room - above - below));
            }
        }
    }
    if !back.is_finite() {
        return camera;
    }
    camera.zoom_at(middle.to_array(), 1.0 / back);
    let by = [0, 1].map(|axis| {
        let ends = sides[axis].iter().flatten().map(|[low, high, wider]| {
            let [low, high] = [low, high].map(|x| middle[axis] + (x - middle[axis]) / back);
            [low - wider, high + wider]
        });
        let Some([low, high]) = ends.reduce(|[a, b], [low, high]| [a.min(low), b.max(high)]) else { return 0.0 };
        match axis == 1 && is_upright {
            true => 0.5 * (free[0][axis] + free[1][axis] - low - high),
            false => (free[0][axis] - low).max(0.0) + (free[1][axis] - high).min(0.0),
        }
    });
    camera.pan(by);
    camera
}

/// The camera drawn back and moved as little as it takes that all points lie in the free part of its picture, and what it shows of walls and
/// solid obstacles too; a few times its distance at most, for what flies away.
pub fn whole(camera: Camera, seen: &View<'_>, free: Free) -> Camera {
    drawn_back(clear(camera, seen, free), free, |camera| on_screen(camera, seen))
}

/// The camera drawn back and moved as little as it takes that what is `shown` in its picture, as two corners `[px]`, lies in the free part.
pub(super) fn drawn_back(mut camera: Camera, free: Free, shown: impl Fn(&Camera) -> [[f64; 2]; 2]) -> Camera {
    let middle = [0, 1].map(|axis| 0.5 * (free[0][axis] + free[1][axis]));
    let room = [0, 1].map(|axis| free[1][axis] - free[0][axis]);
    let mut further = 1.0;
    // In space the way back changes what is seen of the depth: a few rounds are enough.
    for _ in 0..ROUNDS {
        let [low, high] = shown(&camera);
        if !(0..2).all(|axis| (high[axis] - low[axis]).is_finite()) {
            break;
        }
        // What is too large is brought to the middle; what is not stays as near to where it was as may be.
        let back = [0, 1].map(|axis| (high[axis] - low[axis]) / room[axis]).into_iter().fold(1.0, f64::max);
        let back = back.min(FURTHEST / further);
        further *= back;
        camera.zoom_at(middle, 1.0 / back);
        let [low, high] = shown(&camera);
        let off = [0, 1].map(|axis| match high[axis] - low[axis] > room[axis] {
            true => middle[axis] - 0.5 * (low[axis] + high[axis]),
            false => (free[0][axis] - low[axis]).max(0.0) + (free[1][axis] - high[axis]).min(0.0),
        });
        camera.pan(off);
        if back == 1.0 && off == [0.0; 2] {
            break;
        }
    }
    camera
}

/// A box in a picture, and as much on the other side of a place that is seen there `[px]`.
pub(super) fn mirrored([low, high]: [[f64; 2]; 2], about: Option<[f64; 2]>) -> [[f64; 2]; 2] {
    let Some(about) = about else { return [low, high] };
    let other = |end: f64, axis: usize| 2.0 * about[axis] - end;
    [
        [0, 1].map(|axis| low[axis].min(other(high[axis], axis))),
        [0, 1].map(|axis| high[axis].max(other(low[axis], axis))),
    ]
}

/// Rounds of drawing back, and how much further away that leads at most.
const ROUNDS: usize = 6;
const FURTHEST: f64 = 4.0;

/// The box about all points, and in space about what is solid, in a picture `[px]`.
pub(super) fn on_screen(camera: &Camera, seen: &View<'_>) -> [[f64; 2]; 2] {
    let (positions, dimensions) = (seen.current, seen.dimensions);
    let place = |first: usize| {
        let place = std::array::from_fn(|axis| if axis < dimensions { positions.get(first + axis) } else { 0.0 });
        camera.screen_from_world(DVec3::from_array(place)).filter(|at| at.iter().all(|x| x.is_finite()))
    };
    let solids = seen.convex.iter().flat_map(|convex| {
        let ends = convex.figure.extent();
        (0..8).map(move |corner| DVec3::from_array(std::array::from_fn(|axis| ends[corner >> axis & 1][axis])))
    });
    let on_screen = |place: DVec3| camera.screen_from_world(place).filter(|at| at.iter().all(|x| x.is_finite()));
    let all = (0..positions.len()).step_by(dimensions.max(1)).filter_map(place);
    let all = all.chain(solids.filter_map(on_screen));
    all.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], at| {
        [[0, 1].map(|axis| low[axis].min(at[axis])), [0, 1].map(|axis| high[axis].max(at[axis]))]
    })
}
