//! Where one more body finds room.

use super::keys::Scene;

/// Lower and upper corner of what something takes up [m].
pub(super) type Extent = [[f64; 2]; 2];

/// Distance that a body keeps from others, in shares of its own longer side.
const GAP: f64 = 0.05;

/// Most things that a body is put beside one by one; of more, it is put beside all of them.
const MOST_THINGS: usize = 256;

/// Where the origin of the last thing goes, which now lies about (0, 0): where it covers none of the others, inside the walls, of
/// what is `seen`, and as near to the middle of that as may be. Of these, what cannot be had is given up from the last on.
pub(super) fn free_place(scene: &Scene, things: &[Extent], seen: Extent) -> [f64; 2] {
    let middle = [0, 1].map(|axis| 0.5 * (seen[0][axis] + seen[1][axis]));
    let Some((body, others)) = things.split_last() else { return middle };
    let gap = GAP * (body[1][0] - body[0][0]).max(body[1][1] - body[0][1]);
    let room = scene.bounds.as_ref().map(|bounds| [bounds.min, bounds.max].map(plane));
    let taken: Vec<Extent> =
        if others.len() <= MOST_THINGS { others.to_vec() } else { hull(others).into_iter().collect() };
    let centre = |axis: usize| middle[axis] - 0.5 * (body[0][axis] + body[1][axis]);
    let mut places = vec![[centre(0), centre(1)]];
    for other in taken.iter().copied().chain(hull(others)) {
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
    if let Some(room) = room {
        let inside: Vec<[f64; 2]> = places.iter().filter_map(|&place| pushed_inside(place, body, room)).collect();
        places.extend(inside);
    }
    let at = |place: [f64; 2]| body.map(|corner| [corner[0] + place[0], corner[1] + place[1]]);
    let is_free = |place: &&[f64; 2]| !taken.iter().any(|other| overlap(at(**place), *other));
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
        assert_eq!(free_place(&scene(""), &[BODY], [[0.0, 0.0], [8.0, 4.0]]), [4.0, 2.0]);
    }

    #[test]
    fn bodies_come_to_lie_beside_each_other_and_in_view_as_long_as_they_fit() {
        let mut things = vec![BODY];
        let scene = scene("");
        for count in 1..=9 {
            things.push(BODY);
            let place = lies(free_place(&scene, &things, SEEN));
            *things.last_mut().unwrap() = place;
            assert!(!things[..count].iter().any(|other| overlap(place, *other)), "{things:?}");
            assert!(count > 8 || contains(SEEN, place), "{things:?}");
        }
    }

    #[test]
    fn walls_and_planes_are_kept_even_where_that_is_out_of_view() {
        let walls = scene(", \"bounds\": { \"min\": [-9, -1.5], \"max\": [2.5, 1.5] }");
        let place = lies(free_place(&walls, &[BODY, BODY], [[-1.5, -9.0], [9.0, 9.0]]));
        assert!(contains([[-9.0, -1.5], [2.5, 1.5]], place) && !overlap(place, BODY), "{place:?}");
        let floor = scene(", \"obstacles\": [ { \"plane\": { \"point\": [0, -1], \"normal\": [0, 1] } } ]");
        let wide = [[-9.0, -1.0], [9.0, 1.0]];
        let place = lies(free_place(&floor, &[wide, BODY], [[-9.0, -9.0], [9.0, 2.0]]));
        assert!(place[0][1] > 1.0, "above, for below is the floor: {place:?}");
    }

    #[test]
    fn what_is_too_large_for_the_walls_still_lies_beside_the_others() {
        let small = scene(", \"bounds\": { \"min\": [-1.2, -1.2], \"max\": [1.2, 1.2] }");
        let place = lies(free_place(&small, &[BODY, BODY], SEEN));
        assert!(!overlap(place, BODY));
        let many: Vec<Extent> = (0..400).map(|k| BODY.map(|[x, y]| [x + 3.0 * f64::from(k), y])).collect();
        let place = lies(free_place(&small, &[&many[..], &[BODY]].concat(), SEEN));
        assert!(!many.iter().any(|other| overlap(place, *other)));
    }
}
