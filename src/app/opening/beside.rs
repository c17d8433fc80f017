//! How the camera makes way for what lies over bodies in their picture: panels, figures, what belongs to a tool.

use glam::DVec3;

use super::clearing::{BESIDE, Free, clear, moved, whole};
use crate::render::{Camera, Pose, View};
use crate::sim::vector::{span_in_box, sub};

/// What lies over the free part of a picture where it may: bodies make way for it if it hides them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Over {
    /// The left lower corner of what lies in the upper right one `[px]`.
    pub corner: Option<[f64; 2]>,
    /// Where what belongs to a tool begins and ends, beside the tools or at the right edge, however low it reaches `[px]`.
    pub column: Option<[f64; 2]>,
    /// How low that reaches, in windows higher than wide; `None`: all of its height is its own `[px]`.
    pub low: Option<f64>,
}

impl Over {
    /// Whether that is something else than before for a view: what grows once it is there, as figures do, moves nothing.
    pub(in crate::app) fn is_wider_than(&self, before: &Over) -> bool {
        self.corner.is_some() && before.corner.is_none() || self.column != before.column
    }
}

/// What a panel leaves below it is large enough from this share of the height on `[1]`.
const LEAST_BELOW: f64 = 0.4;

/// And what it leaves beside it from this share of the width on `[1]`.
const LEAST_BESIDE: f64 = 0.4;

/// A part of a picture: its left, upper, right and lower edge `[px]`.
type Part = [f64; 4];

/// What `look` makes of the free part of a picture: where bodies lie below what belongs to a tool, of the part beside that; where they lie
/// below what is in the upper right corner, of the part below that.
pub fn beside_all(look: impl Fn(Free) -> Camera, seen: &View<'_>, (free, over): (Free, Over)) -> Camera {
    let camera = beside_corner(&look, seen, free, over.corner);
    let Some((column, rest)) = over.column.and_then(|column| parted(free, column, over.low)) else { return camera };
    if !is_hidden(&camera, seen, &[column]) {
        return camera;
    }
    beside_corner(look, seen, rest, over.corner.filter(|corner| corner[0] < rest[1][0]))
}

/// The camera of a picture in which panels opened over what is `taken` of it `[px]`: as it is where they hide nothing of a body; else moved, at the
/// same scale, by as little as it takes that bodies lie in the `free` part; where they have no room there drawn back too, with the walls. What belongs to a tool takes all of its column, for it grows when
/// something is selected.
pub fn beside_panels(camera: Camera, seen: &View<'_>, (free, over): (Free, Over), taken: &[Part]) -> Camera {
    let column = over.column.and_then(|column| parted(free, column, over.low)).map(|(column, _)| column);
    let parts = [taken, column.as_slice()].concat();
    if !is_hidden(&camera, seen, &parts) {
        return camera;
    }
    let as_large = |free: Free| moved(camera, seen, free).filter(|own| !is_hidden(own, seen, &parts));
    let look = |free: Free| match camera.pose {
        Pose::Plane { .. } => as_large(free).unwrap_or_else(|| clear(camera, seen, free)),
        Pose::Orbit { .. } => whole(camera, seen, free),
    };
    // Springs are wider than their ends: what moved once does not end at the very edge of a panel.
    let apart = BESIDE * camera.viewport().map(f64::from).into_iter().fold(f64::INFINITY, f64::min);
    let column = over.column.map(|[from, to]| [from - apart, to + apart]);
    let narrower = [[free[0][0] + apart, free[0][1]], [free[1][0] - apart, free[1][1]]];
    let has_room = narrower[1][0] - narrower[0][0] > 4.0 * apart;
    beside_all(look, seen, (if has_room { narrower } else { free }, Over { column, ..over }))
}

/// The column of the free part that what belongs to a tool may take, `low` at most, and the larger part that it leaves; `None`: it leaves too
/// little.
fn parted(free: Free, [from, to]: [f64; 2], low: Option<f64>) -> Option<(Part, Free)> {
    let [[left, top], [right, bottom]] = free;
    if let Some(low) = low.filter(|low| (top..bottom - LEAST_BELOW * (bottom - top)).contains(low)) {
        return Some(([from, top, to, low], [[left, low], [right, bottom]]));
    }
    let is_enough = |width: f64| width >= LEAST_BESIDE * (right - left);
    match from + to > left + right {
        true if is_enough(from - left) => Some(([from, top, right, bottom], [[left, top], [from, bottom]])),
        false if is_enough(right - to) => Some(([left, top, to, bottom], [[to, top], [right, bottom]])),
        _ => None,
    }
}

/// What `look` makes of the free part of a picture: where bodies lie in its upper right corner, whose left lower corner `[px]` is `corner`,
/// of the part below that.
fn beside_corner(look: impl Fn(Free) -> Camera, seen: &View<'_>, free: Free, corner: Option<[f64; 2]>) -> Camera {
    let camera = look(free);
    let Some([left, below]) = corner.filter(|corner| corner[1] > free[0][1]) else { return camera };
    let has_room = below < 0.5 * (free[0][1] + free[1][1]);
    match has_room && is_hidden(&camera, seen, &[[left, 0.0, free[1][0], below]]) {
        true => look([[free[0][0], below], free[1]]),
        false => camera,
    }
}

/// Whether a point or a piece of a bond is seen in one of these parts of the picture.
fn is_hidden(camera: &Camera, seen: &View<'_>, parts: &[Part]) -> bool {
    let (x, dimensions) = (seen.current, seen.dimensions.max(1));
    let place = |first: usize| {
        let place = [0, 1, 2].map(|axis| if axis < dimensions { x.get(first + axis) } else { 0.0 });
        camera.screen_from_world(DVec3::from_array(place))
    };
    let places: Vec<Option<[f64; 2]>> = (0..x.len()).step_by(dimensions).map(place).collect();
    let crosses_one = |ends: [[f64; 2]; 2]| parts.iter().any(|part| crosses(part, ends));
    if places.iter().flatten().any(|at| crosses_one([*at; 2])) {
        return true;
    }
    let ends = |at: usize| places.get(at).copied().flatten();
    let mut bonds = seen.bonds.iter().filter_map(|bond| Some([ends(bond.a.index())?, ends(bond.b.index())?]));
    bonds.any(crosses_one)
}

/// Whether a piece of a straight line lies in a part of a picture, its edges apart.
fn crosses(&[left, top, right, bottom]: &Part, [a, b]: [[f64; 2]; 2]) -> bool {
    span_in_box([a, sub(b, a)], [[left, top], [right, bottom]], 1.0).is_some()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use glam::DVec2;

    use super::super::camera;
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn points_do_not_lie_below_what_is_in_the_corner() {
        let text = |x: f64| format!(r#"{{"wobble": 1, "points": {{"position": [[-4, -3], [{x}, 3]]}}}}"#);
        let (size, free, corner) = ([1000, 600], [[80.0, 60.0], [990.0, 570.0]], [840.0, 140.0]);
        for (x, is_hidden) in [(6.0, true), (0.0, false)] {
            let scene = Scene::parse(&text(x), "x.json").unwrap();
            let world = scene.world(None).unwrap();
            let view = View::of(&*world);
            // As it would be drawn, far to the right.
            let opened = Camera::new(Pose::Plane { center: DVec2::new(1.0, 0.3), height: 7.6 }, size);
            let look = |free: Free| clear(opened, &view, free);
            let at = |camera: Camera| camera.screen_from_world(DVec3::new(x, 3.0, 0.0)).unwrap();
            let before = at(look(free));
            assert_eq!(before[0] > corner[0] && before[1] < corner[1], is_hidden, "{before:?}");
            let after = at(beside_corner(look, &view, free, Some(corner)));
            assert_eq!(after[1] >= corner[1] - 0.1, is_hidden, "{after:?}");
        }
    }

    #[test]
    fn a_panel_that_opens_over_points_takes_room_from_the_view_and_one_that_hides_none_does_not() {
        let scene = Scene::parse(
            r#"{"wobble": 1, "points": {"position": [[-3, 0], [0, 1], [3, 0]]}, "view": {"center": [0, 0], "height": 4}}"#,
            "x.json",
        )
        .unwrap();
        let world = scene.world(None).unwrap();
        let view = View::of(&*world);
        let size = [1280, 720];
        let before = camera(&scene, &view, size);
        let seen = |camera: &Camera| {
            [[-3.0, 0.0], [0.0, 1.0], [3.0, 0.0]].map(|[x, y]| camera.screen_from_world(DVec3::new(x, y, 0.0)).unwrap())
        };
        let all = [[0.0; 2], [1280.0, 720.0]];
        let corner = [0.0, 500.0, 300.0, 720.0];
        assert_eq!(
            beside_panels(before, &view, ([[300.0, 0.0], all[1]], Over::default()), &[corner]).pose,
            before.pose
        );
        let left = [0.0, 200.0, 300.0, 720.0];
        let after = beside_panels(before, &view, ([[300.0, 0.0], all[1]], Over::default()), &[left]);
        assert!(seen(&after).iter().all(|at| (300.0..1280.0).contains(&at[0])), "{:?}", seen(&after));
        let column = Over { column: Some([1000.0, 1280.0]), ..Over::default() };
        let after = beside_panels(before, &view, (all, column), &[[1000.0, 0.0, 1280.0, 720.0]]);
        assert!(seen(&after).iter().all(|at| (0.0..1000.0).contains(&at[0])), "{:?}", seen(&after));
    }

    #[test]
    fn a_room_with_bodies_below_a_panel_stays_as_large_as_it_is_where_they_have_room_beside_it() {
        let panel = [980.0, 0.0, 1280.0, 720.0];
        let free = [[84.0, 60.0], [980.0, 700.0]];
        let at = |camera: &Camera, x: f64| camera.screen_from_world(DVec3::new(x, -1.5, 0.0)).unwrap()[0];
        for (left, has_room) in [(1.0, true), (-3.5, false)] {
            let text = format!(
                r#"{{"wobble": 1, "bounds": {{"min": [-4, -2], "max": [4, 2]}}, "points": {{"position": [[{left}, -1.5], [3.5, -1.5]]}},
                    "view": {{"center": [0, 0], "height": 4.5}}}}"#
            );
            let scene = Scene::parse(&text, "x.json").unwrap();
            let world = scene.world(None).unwrap();
            let view = View::of(&*world);
            let before = camera(&scene, &view, [1280, 720]);
            assert!(at(&before, 3.5) > panel[0]);
            let after = beside_panels(before, &view, (free, Over::default()), &[panel]);
            assert!(at(&after, left) > free[0][0] && at(&after, 3.5) < panel[0], "both are seen");
            assert_eq!(after.pixels_per_metre() == before.pixels_per_metre(), has_room, "from {left} m on");
            // By no more than it takes.
            assert!(!has_room || at(&after, 3.5) > panel[0] - 80.0, "{}", at(&after, 3.5));
        }
    }

    #[test]
    fn what_makes_way_for_a_panel_does_not_go_below_what_is_in_the_corner() {
        let text = r#"{"wobble": 1, "points": {"position": [[-3, 0], [-3, 3], [3, 0], [3, 3]]},
            "view": {"center": [0, 1.2], "height": 4.8}}"#;
        let scene = Scene::parse(text, "x.json").unwrap();
        let world = scene.world(None).unwrap();
        let view = View::of(&*world);
        let (before, free) = (camera(&scene, &view, [640, 720]), [[70.0, 90.0], [630.0, 440.0]]);
        let plots = [0.0, 440.0, 640.0, 720.0];
        for (corner, is_clear) in [(None, false), (Some([490.0, 210.0]), true)] {
            let after = beside_panels(before, &view, (free, Over { corner, ..Over::default() }), &[plots]);
            let at = [3.0, 0.0].map(|y| after.screen_from_world(DVec3::new(3.0, y, 0.0)).unwrap());
            assert_eq!(at[0][1] > 210.0, is_clear, "{at:?}");
            assert!(at[0][0] > 490.0 && at[0][0] < 630.0 && at[1][1] < 440.0, "{at:?}");
        }
    }

    #[test]
    fn points_do_not_lie_below_what_belongs_to_a_tool_nor_at_an_edge() {
        let text = |x: f64| format!(r#"{{"wobble": 1, "points": {{"position": [[-4, -3], [{x}, -3]]}}}}"#);
        let (size, free) = ([1000, 600], [[80.0, 60.0], [990.0, 570.0]]);
        let over = Over { column: Some([740.0, 990.0]), ..Over::default() };
        for (x, is_hidden) in [(5.0, true), (-1.0, false)] {
            let scene = Scene::parse(&text(x), "x.json").unwrap();
            let world = scene.world(None).unwrap();
            let view = View::of(&*world);
            let opened = Camera::new(Pose::Plane { center: DVec2::new(1.0, 0.3), height: 7.6 }, size);
            let look = |free: Free| clear(opened, &view, free);
            let at = |camera: &Camera, x: f64| camera.screen_from_world(DVec3::new(x, -3.0, 0.0)).unwrap();
            let (before, after) = (look(free), beside_all(look, &view, (free, over)));
            assert_eq!(at(&before, x)[0] > 740.0, is_hidden);
            assert!(at(&after, x)[0] < 740.0 - 11.0 && at(&after, -4.0)[0] > 80.0 + 11.0);
            assert!(at(&after, x)[1] < 570.0 - 11.0, "a pin at the lower edge is seen whole");
            assert_eq!(after.pose != before.pose, is_hidden, "nothing moves where nothing is hidden");
        }
    }

    #[test]
    fn a_bond_is_hidden_where_both_of_its_ends_are_seen() {
        let part = [100.0, 100.0, 200.0, 300.0];
        for (ends, is_in) in [
            ([[150.0, 50.0], [150.0, 400.0]], true),
            ([[50.0, 200.0], [250.0, 210.0]], true),
            ([[90.0, 90.0], [210.0, 310.0]], true),
            ([[150.0, 150.0], [150.0, 150.0]], true),
            ([[50.0, 250.0], [150.0, 380.0]], false),
            ([[150.0, 310.0], [150.0, 400.0]], false),
            ([[250.0, 150.0], [250.0, 250.0]], false),
            ([[200.0, 150.0], [200.0, 150.0]], false),
            ([[100.0, 150.0], [100.0, 150.0]], false),
            ([[100.0, 50.0], [100.0, 400.0]], false),
        ] {
            assert_eq!(crosses(&part, ends), is_in, "{ends:?}");
            assert_eq!(crosses(&part, [ends[1], ends[0]]), is_in, "{ends:?} the other way");
        }
    }

    #[test]
    fn a_spring_makes_way_for_a_tools_panel_on_either_side_and_for_what_that_grows_to() {
        let text = r#"{"wobble": 1, "points": {"position": [[-3, 2], [-3, -2], [3, 2], [3, -2]]},
            "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 9}, {"a": 2, "b": 3, "kind": "spring", "stiffness": 9}],
            "view": {"center": [0, 0], "height": 5}}"#;
        let scene = Scene::parse(text, "x.json").unwrap();
        let world = scene.world(None).unwrap();
        let view = View::of(&*world);
        let before = camera(&scene, &view, [1280, 720]);
        let free = [[84.0, 60.0], [1270.0, 700.0]];
        let across = |camera: &Camera| {
            [-3.0, 3.0].map(|x| [-2.0, 2.0].map(|y| camera.screen_from_world(DVec3::new(x, y, 0.0)).unwrap()[0])[0])
        };
        assert!(across(&before)[0] < 300.0 && across(&before)[1] > 1000.0, "{:?}", across(&before));
        // It lies over the middle of a spring alone, or over nothing yet: so much of the column is its own all the same.
        let small = [990.0, 200.0, 1270.0, 260.0];
        for taken in [&[small][..], &[]] {
            let over = Over { column: Some([990.0, 1270.0]), ..Over::default() };
            let [left, right] = across(&beside_panels(before, &view, (free, over), taken));
            assert!(left > 84.0 + 28.0 && right < 990.0 - 28.0, "{left} {right}");
        }
        let over = Over { column: Some([84.0, 364.0]), ..Over::default() };
        let [left, right] = across(&beside_panels(before, &view, (free, over), &[]));
        assert!(left > 364.0 + 28.0 && right < 1270.0 - 28.0, "{left} {right}");
        let over = Over { column: Some([500.0, 800.0]), ..Over::default() };
        assert_eq!(beside_panels(before, &view, (free, over), &[]).pose, before.pose, "what it leaves is no room");
    }

    #[test]
    fn in_a_picture_higher_than_wide_bodies_go_below_a_panel_as_large_as_they_were() {
        let text = r#"{"wobble": 1, "points": {"position": [[-3, -1], [3, 2]]}}"#;
        let scene = Scene::parse(text, "x.json").unwrap();
        let world = scene.world(None).unwrap();
        let view = View::of(&*world);
        let free = [[76.0, 190.0], [710.0, 1210.0]];
        let before = clear(camera(&scene, &view, [720, 1280]), &view, free);
        let over = Over { column: Some([430.0, 710.0]), low: Some(618.0), ..Over::default() };
        let after = beside_panels(before, &view, (free, over), &[]);
        let [_, at] = [0, 1].map(|point| {
            after.screen_from_world(DVec3::from_array([[-3.0, -1.0, 0.0], [3.0, 2.0, 0.0]][point])).unwrap()
        });
        assert!(at[1] > 618.0, "below it: {at:?}");
        let ratio = after.pixels_per_metre() / before.pixels_per_metre();
        assert!(ratio > 0.9, "{ratio}");
    }
}
