//! Where one more body finds room.

use super::keys::Scene;
use crate::sim::Polygon;
use crate::sim::vector::cross;

/// Lower and upper corner of what something takes up `[m]`.
pub(super) type Extent = [[f64; 2]; 2];

/// Distance that a body keeps from others, in shares of its own longer side.
const GAP: f64 = 0.05;

/// Most things that a body is put beside one by one; of more, it is put beside all of them.
const MOST_THINGS: usize = 256;

/// Places along a side of what is seen that are tried where polygons leave gaps.
const RASTER: i32 = 24;

/// Where the origin of the last thing goes, which now lies about (0, 0): where it covers none of the others nor any of the
/// scene's `polygons`, inside the walls, of what is `seen`, and as near to the middle of that as may be. Of these, what cannot be
/// had is given up from the last on.
pub(super) fn free_place(scene: &Scene, polygons: &[Polygon], things: &[Extent], seen: Extent) -> [f64; 2] {
    let middle = [0, 1].map(|axis| 0.5 * (seen[0][axis] + seen[1][axis]));
    let Some((body, others)) = things.split_last() else { return middle };
    let gap = GAP * (body[1][0] - body[0][0]).max(body[1][1] - body[0][1]);
    let room = scene.bounds.as_ref().map(|bounds| [bounds.min, bounds.max].map(plane));
    let taken: Vec<Extent> =
        if others.len() <= MOST_THINGS { others.to_vec() } else { hull(others).into_iter().collect() };
    let solids: Vec<Extent> = polygons.iter().filter_map(around).collect();
    let centre = |axis: usize| middle[axis] - 0.5 * (body[0][axis] + body[1][axis]);
    let mut places = vec![[centre(0), centre(1)]];
    for other in taken.iter().copied().chain(hull(others)).chain(solids.iter().copied()).chain(hull(&solids)) {
        let past = |axis: usize| other[1][axis] + gap - body[0][axis];
        let before = |axis: usize| other[0][axis] - gap - body[1][axis];
        let level = other[0][1] - body[0][1];
        let over = 0.5 * (other[0][0] + other[1][0] - body[0][0] - body[1][0]);
        for x in [past(0), before(0)] {
            places.extend([[x, level], [x, centre(1)]]);
        }
        for y in [past(1), before(1)] {
            places.extend([[over, y], [centre(0), y]]);
        }
    }
    if !polygons.is_empty() {
        let at = |axis: usize, k: i32| {
            seen[0][axis] + f64::from(k) / f64::from(RASTER) * (seen[1][axis] - seen[0][axis])
                - 0.5 * (body[0][axis] + body[1][axis])
        };
        places.extend((0..=RASTER).flat_map(|row| (0..=RASTER).map(move |column| [at(0, column), at(1, row)])));
    }
    if let Some(room) = room {
        let inside: Vec<[f64; 2]> = places.iter().filter_map(|&place| pushed_inside(place, body, room)).collect();
        places.extend(inside);
    }
    let at = |place: [f64; 2]| body.map(|corner| [corner[0] + place[0], corner[1] + place[1]]);
    let is_solid = |lies_at: Extent| {
        let near = polygons.iter().zip(&solids).filter(|(_, solid)| overlap(lies_at, **solid));
        near.into_iter().any(|(polygon, _)| covers(polygon, lies_at))
    };
    let is_free = |place: &&[f64; 2]| {
        let lies_at = at(**place);
        !taken.iter().any(|other| overlap(lies_at, *other)) && !is_solid(lies_at)
    };
    let rank = |place: &[f64; 2]| {
        let lies_at = at(*place);
        let is_out = room.is_some_and(|room| !contains(room, lies_at)) || is_behind_a_plane(scene, lies_at);
        let away = (place[0] - centre(0)).hypot(place[1] - centre(1));
        (is_out, !contains(seen, lies_at), away)
    };
    let order = |a: &&[f64; 2], b: &&[f64; 2]| {
        let (a, b) = (rank(a), rank(b));
        (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2))
    };
    places.iter().filter(is_free).min_by(order).copied().unwrap_or(middle)
}

fn plane(vector: super::keys::Vector) -> [f64; 2] {
    let [x, y, _] = vector.embed();
    [x, y]
}

/// The box around a polygon.
pub(super) fn around(polygon: &Polygon) -> Option<Extent> {
    let corners: Vec<Extent> = polygon.loops.iter().flatten().map(|&corner| [corner; 2]).collect();
    hull(&corners)
}

/// Whether some of a box is solid: a side of the polygon goes through it, or it lies inside.
fn covers(polygon: &Polygon, [low, high]: Extent) -> bool {
    let sides = || polygon.loops.iter().flat_map(|corners| corners.iter().zip(corners.iter().cycle().skip(1)));
    let goes_through = |(a, b): (&[f64; 2], &[f64; 2])| {
        let is_beside = (0..2).any(|k| a[k].max(b[k]) <= low[k] || a[k].min(b[k]) >= high[k]);
        let way = [b[0] - a[0], b[1] - a[1]];
        let of = |x: f64, y: f64| cross(way, [x - a[0], y - a[1]]);
        let corners = [of(low[0], low[1]), of(high[0], low[1]), of(high[0], high[1]), of(low[0], high[1])];
        !is_beside && corners.iter().any(|&c| c > 0.0) && corners.iter().any(|&c| c < 0.0)
    };
    let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
    let is_right_of = |(a, b): (&[f64; 2], &[f64; 2])| {
        let is_level = (a[1] > middle[1]) != (b[1] > middle[1]);
        is_level && middle[0] < a[0] + (middle[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
    };
    sides().any(goes_through) || sides().filter(|side| is_right_of(*side)).count() % 2 == 1
}

/// The extent of all; none of nothing.
fn hull(things: &[Extent]) -> Option<Extent> {
    things.iter().copied().reduce(|a, b| {
        let corner = |of: fn(f64, f64) -> f64, end: usize| [0, 1].map(|axis| of(a[end][axis], b[end][axis]));
        [corner(f64::min, 0), corner(f64::max, 1)]
    })
}

fn overlap(a: Extent, b: Extent) -> bool {
    (0..2).all(|axis| a[0][axis] < b[1][axis] && b[0][axis] < a[1][axis])
}

fn contains(outer: Extent, inner: Extent) -> bool {
    (0..2).all(|axis| outer[0][axis] <= inner[0][axis] && inner[1][axis] <= outer[1][axis])
}

/// The nearest place at which the body is inside of `room`, if it fits in.
fn pushed_inside(place: [f64; 2], body: &Extent, room: Extent) -> Option<[f64; 2]> {
    let range = [0, 1].map(|axis| [room[0][axis] - body[0][axis], room[1][axis] - body[1][axis]]);
    range
        .iter()
        .all(|[least, most]| least <= most)
        .then(|| [0, 1].map(|axis| place[axis].clamp(range[axis][0], range[axis][1])))
}

/// Whether a corner lies behind one of the planes among the obstacles.
fn is_behind_a_plane(scene: &Scene, [lower, upper]: Extent) -> bool {
    let corners = [lower, upper, [lower[0], upper[1]], [upper[0], lower[1]]];
    scene.obstacles.iter().filter_map(|obstacle| obstacle.plane.as_ref()).any(|keys| {
        let (point, normal) = (plane(keys.point), plane(keys.normal));
        corners.iter().any(|corner| (0..2).map(|axis| (corner[axis] - point[axis]) * normal[axis]).sum::<f64>() < 0.0)
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    const SEEN: Extent = [[-5.0, -5.0], [5.0, 5.0]];
    const BODY: Extent = [[-1.0, -1.0], [1.0, 1.0]];

    fn scene(keys: &str) -> Scene {
        Scene::parse(&format!("{{ \"wobble\": 1{keys} }}"), "x.json").unwrap()
    }

    fn lies(place: [f64; 2]) -> Extent {
        BODY.map(|corner| [corner[0] + place[0], corner[1] + place[1]])
    }

    #[test]
    fn an_empty_scene_has_room_in_the_middle_of_what_is_seen() {
        assert_eq!(free_place(&scene(""), &[], &[BODY], [[0.0, 0.0], [8.0, 4.0]]), [4.0, 2.0]);
    }

    #[test]
    fn bodies_come_to_lie_beside_each_other_and_in_view_as_long_as_they_fit() {
        let mut things = vec![BODY];
        let scene = scene("");
        for count in 1..=9 {
            things.push(BODY);
            let place = lies(free_place(&scene, &[], &things, SEEN));
            *things.last_mut().unwrap() = place;
            assert!(!things[..count].iter().any(|other| overlap(place, *other)), "{things:?}");
            assert!(count > 8 || contains(SEEN, place), "{things:?}");
        }
    }

    #[test]
    fn walls_and_planes_are_kept_even_where_that_is_out_of_view() {
        let walls = scene(", \"bounds\": { \"min\": [-9, -1.5], \"max\": [2.5, 1.5] }");
        let place = lies(free_place(&walls, &[], &[BODY, BODY], [[-1.5, -9.0], [9.0, 9.0]]));
        assert!(contains([[-9.0, -1.5], [2.5, 1.5]], place) && !overlap(place, BODY), "{place:?}");
        let floor = scene(", \"obstacles\": [ { \"plane\": { \"point\": [0, -1], \"normal\": [0, 1] } } ]");
        let wide = [[-9.0, -1.0], [9.0, 1.0]];
        let place = lies(free_place(&floor, &[], &[wide, BODY], [[-9.0, -9.0], [9.0, 2.0]]));
        assert!(place[0][1] > 1.0, "above, for below is the floor: {place:?}");
    }

    #[test]
    fn what_is_too_large_for_the_walls_still_lies_beside_the_others() {
        let small = scene(", \"bounds\": { \"min\": [-1.2, -1.2], \"max\": [1.2, 1.2] }");
        let place = lies(free_place(&small, &[], &[BODY, BODY], SEEN));
        assert!(!overlap(place, BODY));
        let many: Vec<Extent> = (0..400).map(|k| BODY.map(|[x, y]| [x + 3.0 * f64::from(k), y])).collect();
        let place = lies(free_place(&small, &[], &[&many[..], &[BODY]].concat(), SEEN));
        assert!(!many.iter().any(|other| overlap(place, *other)));
    }

    #[test]
    fn obstacles_are_kept_clear_of_and_their_holes_are_used() {
        let rectangle = |[left, low]: [f64; 2], [right, high]: [f64; 2]| {
            vec![[left, low], [right, low], [right, high], [left, high]]
        };
        let solid = |loops| Polygon { loops, restitution: 0.0, friction: 0.0 };
        let block = solid(vec![rectangle([-2.0, -2.0], [2.0, 2.0])]);
        let place = lies(free_place(&scene(""), &[block], &[BODY], SEEN));
        assert!(contains(SEEN, place) && !overlap(place, [[-2.0, -2.0], [2.0, 2.0]]), "{place:?}");
        let cave = [rectangle([-9.0, -9.0], [9.0, 9.0]), rectangle([1.0, -3.0], [4.0, 0.0])];
        let place = lies(free_place(&scene(""), &[solid(cave.to_vec())], &[BODY], SEEN));
        assert!(contains([[1.0, -3.0], [4.0, 0.0]], place), "{place:?}");
    }
}
