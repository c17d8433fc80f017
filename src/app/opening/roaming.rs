//! What a view goes along with, and pictures higher than wide: there a wide room would be a strip in the middle, so where what is in it
//! takes less than nine twentieths of its width, the view shows that, as large as the height lets it, and goes along with it from wall to wall.

use glam::{DVec2, DVec3};

use super::extent::{points, surroundings};
use super::{OUTER, SLIMMEST, fit, look};
use crate::render::{Camera, Pose, View};
use crate::scene::Scene;
use crate::sim::PointId;

/// Width of all points from which on the whole room is shown, as a share of the room's `[1]`: below it they are seen a quarter larger at least,
/// with so much [`ABOUT`] them.
const ROAMING: f64 = 0.45;
/// How much wider than all points a picture is at least that goes along with them `[1]`: room to move before the view does.
const ABOUT: f64 = 1.6;
/// Points from which on none is followed but those that a scene names: their middle is worked out in every frame.
const MOST: usize = 10_000;

/// What the view of a scene goes along with from when it opens.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Followed {
    /// Points, with whose middle.
    pub points: Vec<u32>,
    /// From the first of these to the second, and not up and down `[m]`; `None`: everywhere.
    walls: Option<[f64; 2]>,
}

impl Followed {
    /// Whether the scene names them.
    pub fn is_said(&self) -> bool {
        self.walls.is_none() && !self.points.is_empty()
    }

    /// The points that the view goes along with: those of the scene, else what its keys drive.
    pub fn or_driven(&self, driven: impl FnOnce() -> Vec<PointId>) -> Vec<PointId> {
        if self.points.is_empty() { driven() } else { self.points.iter().copied().map(PointId).collect() }
    }

    /// The camera goes along with the places of the points. Returns whether it moved.
    pub fn lead(&self, camera: &mut Camera, places: impl Iterator<Item = DVec3>) -> bool {
        let Pose::Plane { center: before, .. } = camera.pose else { return false };
        let has_moved = follow(camera, places);
        let (Some(walls), [width, tall]) = (self.walls, camera.viewport().map(f64::from)) else { return has_moved };
        let Pose::Plane { center, height } = &mut camera.pose else { return has_moved };
        let [first, last] = between(walls, *height * width / tall);
        *center = DVec2::new(center.x.clamp(first.min(before.x), last.max(before.x)), before.y);
        *center != before
    }
}

/// The points that the view of a scene goes along with: those that it names, else all that may move in a picture higher than wide where they
/// are shown rather than the room.
pub fn followed(scene: &Scene, seen: &View<'_>, size: [u32; 2]) -> Followed {
    if let Some(follow) = scene.view.as_ref().and_then(|view| view.follow.as_ref()) {
        return Followed { points: follow.clone(), walls: None };
    }
    let count = seen.current.len() / seen.dimensions.max(1);
    if count > MOST || !roams(scene, seen, size) {
        return Followed::default();
    }
    let mut is_pinned = vec![false; count];
    for pin in seen.pinned {
        is_pinned.get_mut(pin.index()).into_iter().for_each(|is| *is = true);
    }
    let points = (0..).zip(is_pinned).filter(|(_, is)| !is).map(|(point, _)| point).collect();
    Followed { points, walls: Some(surroundings(seen).map(|corner| corner[0])) }
}

/// Where the middle of a picture so wide may be between walls: where it is wider than the room, in the middle of that.
fn between([low, high]: [f64; 2], width: f64) -> [f64; 2] {
    let half = (0.5 * width).min(0.5 * (high - low));
    [low + half, high - half]
}

/// Whether a picture shows what moves in a room rather than all of the room.
pub(super) fn roams(scene: &Scene, seen: &View<'_>, [width, tall]: [u32; 2]) -> bool {
    let wide = |[low, high]: [[f64; 3]; 2]| high[0] - low[0];
    let (of_points, of_room) = (wide(points(seen)), wide(surroundings(seen)));
    let has_view = scene.view.as_ref().is_some_and(|view| view.height.is_some());
    let is_one = seen.dimensions == 2 && has_view && scene.beside.is_empty();
    is_one && tall > width && of_room.is_finite() && (0.0..=ROAMING * of_room).contains(&of_points)
}

/// The camera of a picture that shows what moves in a room: as high as its view is made for, or as slim pictures need, and not beyond walls.
pub(super) fn camera(scene: &Scene, seen: &View<'_>, size: [u32; 2]) -> Camera {
    let [width, tall] = size.map(f64::from);
    let [low, high] = points(seen).map(|corner| corner[0]);
    let wide = |height: f64| (SLIMMEST * height).max(ABOUT * OUTER * (high - low)).max(height * width / tall);
    let mut camera = look(scene.view.as_ref(), |height, _: DVec2| wide(height) * tall / width, fit(seen, true, size));
    if let Pose::Plane { center, height } = &mut camera.pose {
        let [first, last] = between(surroundings(seen).map(|corner| corner[0]), *height * width / tall);
        center.x = (0.5 * (low + high)).clamp(first, last.max(first));
    }
    camera
}

/// Share of the view about its middle in which the middle of what is driven stays, and in which all of it does where it can.
const STAY: f64 = 0.4;
const SEEN: f64 = 0.9;

/// The camera goes along with places, those that are none apart, as far as their middle leaves the middle of the view: the less it may the
/// more of the view they take, so that all are seen; in the plane. Returns whether it moved.
pub fn follow(camera: &mut Camera, places: impl Iterator<Item = DVec3>) -> bool {
    let Pose::Plane { .. } = camera.pose else { return false };
    let seen = places.filter_map(|place| camera.screen_from_world(place)).filter(|at| at.iter().all(|x| x.is_finite()));
    let (mut sum, mut count, mut low, mut high) = ([0.0; 2], 0.0, [f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for at in seen {
        count += 1.0;
        for axis in 0..2 {
            sum[axis] += at[axis];
            (low[axis], high[axis]) = (low[axis].min(at[axis]), high[axis].max(at[axis]));
        }
    }
    if count == 0.0 {
        return false;
    }
    let size = camera.viewport().map(f64::from);
    let beyond = |axis: usize| {
        let room = 0.5 * STAY * size[axis];
        let half = room.min((0.5 * (SEEN * size[axis] - (high[axis] - low[axis]))).max(0.0));
        let off = sum[axis] / count - 0.5 * size[axis];
        off - off.clamp(-half, half)
    };
    let by = [beyond(0), beyond(1)];
    if by == [0.0; 2] {
        return false;
    }
    camera.pan(by.map(|pixels| -pixels));
    true
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::camera;
    use super::*;

    fn scene(x: f64, view: &str) -> Scene {
        let text = format!(
            r#"{{"wobble": 1, "points": {{"position": [[{x}, 0], [-4, 1], [-3, 0]], "pinned": [2]}},
            "bounds": {{"min": [-5, -1], "max": [5, 4]}}, "view": {{"center": [0, 1.5], "height": 5.2{view}}}}}"#
        );
        Scene::parse(&text, "x.json").unwrap()
    }

    #[test]
    fn in_a_picture_higher_than_wide_what_moves_is_seen_large_and_all_of_the_height_is() {
        let of = |x: f64, size: [u32; 2]| {
            let scene = scene(x, "");
            let world = scene.world(None).unwrap();
            let view = View::of(&*world);
            (camera(&scene, &view, size), followed(&scene, &view, size))
        };
        let (mut own, followed) = of(-3.0, [720, 1280]);
        assert_eq!(followed.points, [0, 1], "pins move no view");
        let at = |x: f64, y: f64| own.screen_from_world(DVec3::new(x, y, 0.0)).unwrap();
        assert!(at(-5.0, -1.0)[0].abs() < 1e-6, "the wall beside them is the edge of the picture");
        assert!(at(-4.0, 0.0)[0] > 0.0 && at(-3.0, 0.0)[0] < 720.0 && at(5.0, 0.0)[0] > 720.0);
        assert!(at(0.0, -1.0)[1] < 1280.0 && at(0.0, 4.0)[1] > 0.0, "floor and ceiling are seen");
        assert!(at(1.0, 0.0)[0] - at(0.0, 0.0)[0] > 1.8 * 720.0 / 10.0, "the room would fill the width");
        // It goes along from wall to wall, and what jumps moves it neither up nor down.
        let mut goes = |x: f64| {
            let has_moved = followed.lead(&mut own, std::iter::once(DVec3::new(x, 3.9, 0.0)));
            let edge = |x: f64| own.screen_from_world(DVec3::new(x, -1.0, 0.0)).unwrap();
            (has_moved, edge(-5.0), edge(5.0))
        };
        let (has_moved, left, _) = goes(-4.5);
        assert!(!has_moved && left[0].abs() < 1e-6, "at the wall it stands");
        let (has_moved, ..) = goes(0.0);
        let (_, left_at_right, right) = goes(4.9);
        assert!(has_moved && (right[0] - 720.0).abs() < 1e-6 && left_at_right[1] == left[1], "{right:?}");
        // What is as wide as the room is seen with as much of it as the view shows elsewhere, and so is all in a wide picture.
        let (whole, followed) = of(4.0, [720, 1280]);
        let at = |x: f64| whole.screen_from_world(DVec3::new(x, 0.0, 0.0)).unwrap()[0];
        assert!(followed.points.is_empty() && at(-4.0) > 0.0 && at(4.0) < 720.0, "{followed:?}");
        assert_eq!(of(-3.0, [1280, 720]).1, Followed::default());
        // What takes two fifths of the room is seen larger by a fifth than what takes half of it.
        let scale = |x: f64| {
            let (own, followed) = of(x, [720, 1280]);
            let at = |x: f64| own.screen_from_world(DVec3::new(x, 0.0, 0.0)).unwrap()[0];
            (at(1.0) - at(0.0), !followed.points.is_empty())
        };
        let ([near, far], [roams, stays]) = ([0.0, 1.0].map(|x| scale(x).0), [0.0, 1.0].map(|x| scale(x).1));
        assert!(near > 1.2 * far && roams && !stays, "{near} {far}");
    }

    #[test]
    fn a_scene_says_what_its_view_follows() {
        let scene = scene(4.0, r#", "follow": [1]"#);
        let world = scene.world(None).unwrap();
        let view = View::of(&*world);
        let [followed, other] = [[720, 1280], [1280, 720]].map(|size| followed(&scene, &view, size));
        assert!(followed.points == [1] && followed.is_said() && other == followed);
        let mut own = camera(&scene, &view, [720, 720]);
        let place = |x: f64| std::iter::once(DVec3::new(x, 1.0, 0.0));
        assert!(!followed.lead(&mut own, place(0.0)) && followed.lead(&mut own, place(4.0)));
    }
}
