//! Tools in space: what they do goes along the plane that faces who plays, and through all that is seen under a stroke.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::{DVec2, DVec3};

use super::{Deed, Hand, PushWay, Scope};
use crate::app::action::Tool;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::Do;
use crate::render::Camera;
use crate::scene::Scene;
use crate::sim::PointId;

const CLOTH: &str = r#"{"wobble": 1, "dimensions": 3, "gravity": [0, 0, 0], "obstacles": [{"circle": {"center": [3, 0, 0], "radius": 0.5}}],
    "bodies": [{"make": "cloth", "columns": 9, "rows": 9, "spacing": 0.25, "origin": [-1, 1, 0], "pinned": [0],
        "material": {"kind": "spring", "stiffness": 500, "mass": 1}}],
    "view": {"target": [0, 0, 0], "distance": 9, "yaw": 0.6, "pitch": 0.3}}"#;

pub(super) struct Room {
    pub(super) stage: Stage,
    pub(super) shown: Shown,
    pub(super) camera: Camera,
    pub(super) hand: Hand,
}

impl Room {
    pub(super) fn new(tool: Tool) -> Self {
        Room::of(CLOTH, tool)
    }

    pub(super) fn of(text: &str, tool: Tool) -> Self {
        let scene = Scene::parse(text, "x.json").unwrap();
        let mut stage = Stage::new(scene.clone().into()).unwrap();
        let (mut shown, mut hand) = (Shown::default(), Hand::default());
        stage.show(&mut shown);
        let camera = crate::app::opening::camera(&scene, &shown.view(), super::tests::SIZE);
        hand.take(tool);
        Room { stage, shown, camera, hand }
    }

    pub(super) fn with<T>(&mut self, call: impl FnOnce(&mut Hand, Scope<'_>) -> T) -> T {
        call(&mut self.hand, Scope { shown: &self.shown, camera: &self.camera, scale: 1.0, free: Scope::ANYWHERE })
    }

    pub(super) fn pixel(&mut self, point: u32) -> DVec2 {
        self.with(|_, scope| scope.pixel(PointId(point)).unwrap())
    }

    pub(super) fn drag(&mut self, [from, to]: [DVec2; 2]) -> Deed {
        let deed = self.with(|hand, scope| hand.press(scope, from));
        if !deed.is_empty() || deed.words.is_some() {
            return deed;
        }
        self.with(|hand, scope| hand.trace(scope, to));
        self.with(|hand, scope| hand.release(scope, to))
    }

    pub(super) fn give(&mut self, deed: &Deed) {
        assert_eq!(self.stage.obey(Order::Give(deed.commands.clone(), deed.edit)), None, "{deed:?}");
        self.stage.show(&mut self.shown);
    }

    pub(super) fn place(&self, point: usize) -> DVec3 {
        self.shown.place(point).into()
    }

    pub(super) fn places(&self) -> Vec<DVec3> {
        (0..self.shown.point_count()).map(|point| DVec3::from(self.shown.place(point))).collect()
    }

    /// The place of the plane through the target that a pixel shows `[m]`.
    pub(super) fn facing_place(&self, at: DVec2) -> DVec3 {
        self.camera.world_from_screen(at.to_array())
    }

    pub(super) fn undo(&mut self) {
        assert!(matches!(self.stage.obey(Order::Undo(None)), Some(Note::Undone(..))));
        self.stage.show(&mut self.shown);
    }
}

#[test]
fn a_stroke_over_a_cloth_is_a_slit_that_loses_nothing_of_it() {
    let mut room = Room::new(Tool::Cut);
    let (bonds, triangles) = (room.shown.scenery.bonds.len(), room.shown.scenery.triangles.len());
    // Just below the fifth row, from within the first cell to within the last.
    let across = room.pixel(44) - room.pixel(36);
    let [from, to] =
        [room.pixel(36) + 0.06 * across, room.pixel(44) - 0.06 * across].map(|at| at + DVec2::new(0.0, 6.0));
    room.with(|hand, scope| hand.press(scope, from));
    let marks = room.with(|hand, scope| hand.marks(scope, Some(to)));
    let is_line = |mark: &&super::Mark| matches!(mark, super::Mark::Line(super::Role::Away, ..));
    assert!(marks.iter().filter(is_line).count() > 6, "where it opens, and the stroke: {marks:?}");
    let deed = room.with(|hand, scope| hand.release(scope, to));
    let [Do::Split { points, bonds: moved }] = &deed.commands[..] else { panic!("{deed:?}") };
    let (points, moved) = (points.clone(), moved.clone());
    assert!(points.len() >= 5 && points.iter().all(|point| (37..44).contains(&point.0)), "{points:?}");
    assert!(moved.len() > 2 * points.len() && deed.edit == Some("cut"), "{moved:?}");
    room.give(&deed);
    let scenery = &room.shown.scenery;
    assert_eq!(scenery.triangles.len(), triangles, "nothing of it is lost");
    assert_eq!((room.shown.point_count(), scenery.bonds.len()), (81 + points.len(), bonds + points.len() + 1));
    let beside = |point: u32| {
        let of = scenery.bonds.ends().iter().filter(move |ends| ends.contains(&PointId(point)));
        of.flatten().map(|end| end.0).filter(move |&end| end != point).collect::<Vec<u32>>()
    };
    for (copy, point) in (81..).zip(&points) {
        assert!(beside(copy).iter().all(|&end| end >= 36), "the lower lip: {:?}", beside(copy));
        assert!(beside(point.0).iter().all(|&end| end < 45), "the upper lip: {:?}", beside(point.0));
        assert_eq!(room.place(copy as usize), room.place(point.index()));
    }
    room.undo();
    assert_eq!((room.shown.scenery.bonds.len(), room.shown.point_count()), (bonds, 81));
}

#[test]
fn while_time_stands_still_the_hand_moves_a_body_and_a_pin_as_far_as_the_pointer_goes_and_as_deep_as_they_were() {
    for (tool, point) in [(Tool::Hand, 40), (Tool::Select, 40), (Tool::Hand, 0)] {
        let mut room = Room::new(tool);
        room.hand.stand_still(true);
        let from = room.pixel(point);
        let before = room.place(point as usize);
        if tool == Tool::Hand {
            // What goes along is seen before, and as it goes: of the cloth its pin, of the pin itself nothing.
            let pin = room.pixel(0);
            let said = |marks: &[super::Mark], name: &str| {
                marks.iter().any(|mark| matches!(mark, super::Mark::Words(_, words) if words.contains(name)))
            };
            let ringed = |marks: &[super::Mark], at: DVec2| {
                let is_it = |mark: &super::Mark| matches!(mark, super::Mark::Ring(super::Role::Hold, middle, _) if middle.distance(at) < 1.0);
                marks.iter().any(is_it)
            };
            let marks = room.with(|hand, scope| hand.marks(scope, Some(from)));
            assert!(ringed(&marks, pin) && said(&marks, if point == 0 { "its body stays" } else { "with its pins" }));
            let by = DVec2::new(70.0, -50.0);
            room.with(|hand, scope| hand.press(scope, from));
            let marks = room.with(|hand, scope| hand.marks(scope, Some(from + by)));
            let there = room.with(|_, scope| {
                let way = scope.facing(before, from + by) - before;
                DVec2::from(scope.camera.screen_from_world(DVec3::from(scope.shown.place(0)) + way).unwrap())
            });
            assert!(ringed(&marks, there), "{marks:?}");
            room.hand.cancel();
        }
        let deed = room.drag([from, from + DVec2::new(70.0, -50.0)]);
        assert!(matches!(deed.commands[..], [Do::Move(_)]) && deed.edit == Some("move"), "{deed:?}");
        room.give(&deed);
        assert!(room.pixel(point).distance(from + DVec2::new(70.0, -50.0)) < 0.1, "{tool:?} {point}");
        let deep = [before, room.place(point as usize)].map(|place| room.camera.depth(place));
        assert!((deep[0] - deep[1]).abs() < 1e-6, "{deep:?}");
        room.undo();
        assert_eq!(room.place(point as usize), before);
    }
}

#[test]
fn a_ball_is_dragged_by_the_hand_while_time_runs() {
    let mut room = Room::new(Tool::Hand);
    let center = |room: &Room| DVec3::from(room.shown.scenery.convex[0].figure.center());
    let [before, from] = [center(&room); 2];
    let from = DVec2::from(room.camera.screen_from_world(from).unwrap());
    let to = from + DVec2::new(0.0, -80.0);
    // It is said and outlined before, as in the plane.
    let marks = room.with(|hand, scope| hand.marks(scope, Some(from)));
    let says = |mark: &super::Mark| matches!(mark, super::Mark::Words(_, words) if words.starts_with("drag: it moves"));
    assert!(marks.len() > 1 && marks.iter().filter(|mark| says(mark)).count() == 1, "{marks:?}");
    assert_eq!(room.with(|hand, scope| hand.hint(scope, from)), Some("press and drag: move it"));
    assert!(room.with(|hand, scope| hand.press(scope, from)).words.is_none());
    for k in 1..=20 {
        let at = from.lerp(to, f64::from(k) / 20.0);
        if let Some(way) = room.with(|hand, scope| hand.haul(scope, at, 1.0 / 20.0)) {
            assert_eq!(room.stage.obey(Order::Haul(way)), None);
        }
        drop(room.stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
        room.stage.show(&mut room.shown);
    }
    let after = center(&room);
    let seen = DVec2::from(room.camera.screen_from_world(after).unwrap());
    assert!(seen.distance(to) < 8.0, "it goes along: {seen}, the pointer is at {to}");
    assert!((room.camera.depth(after) - room.camera.depth(before)).abs() < 1e-6);
    room.undo();
    assert_eq!(center(&room), before, "all of it is one step");
}

#[test]
fn a_force_goes_along_the_arrow_that_is_drawn_in_the_plane_of_the_screen() {
    let mut room = Room::new(Tool::Push);
    room.hand.set_push_way(PushWay::Body);
    let from = room.pixel(40);
    let deed = room.drag([from, from + DVec2::new(100.0, 0.0)]);
    room.give(&deed);
    let force = DVec3::from(room.shown.scenery.forces[0].force);
    assert!((force.length() - 10.0).abs() < 0.1 && force.y.abs() < 1e-9, "{force}");
    assert!(
        (force.normalize() - DVec3::new(0.6_f64.cos(), 0.0, -0.6_f64.sin())).length() < 1e-6,
        "to the right: {force}"
    );
    room.hand.set_push_way(PushWay::Turn);
    let deed = room.drag([from + DVec2::new(40.0, 60.0), from]);
    assert!(deed.commands.is_empty() && deed.words.is_some_and(|words| words.contains("plane")));
}

/// A floor, the back of a wall before all else, a ball on the floor, one under it, and a loose point.
const FLOOR: &str = r#"{"wobble": 1, "dimensions": 3, "gravity": [0, 0, 0], "points": {"position": [[0, 1, 0]]}, "obstacles": [
    {"plane": {"point": [0, -1, 0], "normal": [0, 1, 0]}}, {"plane": {"point": [0, 0, 2.5], "normal": [0, 0, -1]}},
    {"circle": {"center": [1.5, -0.5, 0], "radius": 0.5}}, {"circle": {"center": [-1, -1.8, 0], "radius": 0.5}}],
    "view": {"target": [0, 0, 0], "distance": 9, "yaw": 0, "pitch": 0.5}}"#;

#[test]
fn a_plane_is_outlined_selected_moved_and_deleted_by_its_front_and_a_drag_over_it_selects_what_lies_before_it() {
    let mut room = Room::of(FLOOR, Tool::Select);
    let numbers = |room: &Room| room.shown.scenery.plane_numbers.clone();
    let [floor, wall] = numbers(&room)[..] else { panic!("{:?}", numbers(&room)) };
    let seen = |room: &Room, at: [f64; 3]| DVec2::from(room.camera.screen_from_world(at.into()).unwrap());
    let [on_floor, on_ball, under, up] =
        [[0.0, -1.0, 0.5], [1.5, -0.5, 0.0], [-1.0, -1.8, 0.0], [0.0, 3.5, 2.5]].map(|at| seen(&room, at));
    let picked = |room: &mut Room, at: DVec2| room.with(|_, scope| scope.obstacle(at)).unwrap();
    assert_eq!([picked(&mut room, on_floor), picked(&mut room, under)], [floor; 2], "it lies before the ball under it");
    let ball = picked(&mut room, on_ball);
    assert!(ball != floor && ball != wall, "before the floor, and through the back of the wall");
    assert_eq!(picked(&mut room, up), wall, "where nothing else lies");
    // The hand presses on through it.
    assert!(room.with(|_, scope| scope.solid(on_floor)).is_none());
    // A drag over it is for what lies before it; a click selects it.
    let [low, high] = [on_floor + DVec2::new(-300.0, 60.0), on_floor + DVec2::new(300.0, -500.0)];
    room.drag([low, high]);
    let chosen = room.with(|hand, scope| hand.chosen(scope)).unwrap();
    assert!(chosen.points == [PointId(0)] && !chosen.obstacles.contains(&floor), "{chosen:?}");
    // Beside the rings of what is selected.
    let beside = seen(&room, [-2.4, -1.0, 0.8]);
    room.drag([beside; 2]);
    let chosen = room.with(|hand, scope| hand.chosen(scope)).unwrap();
    assert!(chosen.points.is_empty() && chosen.obstacles == [floor]);
    let marks = room.with(|hand, scope| hand.marks(scope, None));
    let rim = marks.iter().filter(|mark| matches!(mark, super::Mark::Line(super::Role::Hold, ..))).count();
    let knobs = marks.iter().filter(|mark| matches!(mark, super::Mark::Square(..))).count();
    assert_eq!((rim, knobs), (4, 0), "its rim, and rings that turn it: what has no end has no size");
    // Once it is selected a drag moves it, as far as the pointer goes.
    let height = |room: &Room| room.shown.scenery.planes[0][0][1];
    let deed = room.drag([beside, beside + DVec2::new(0.0, -40.0)]);
    assert!(matches!(deed.commands[..], [Do::Move(_)]), "{deed:?}");
    room.give(&deed);
    assert!((-0.9..-0.3).contains(&height(&room)), "{}", height(&room));
    room.undo();
    assert_eq!(height(&room), -1.0);
    room.hand.take(Tool::Erase);
    let deed = room.drag([beside; 2]);
    room.give(&deed);
    assert_eq!(numbers(&room), [wall]);
    room.undo();
    assert_eq!(numbers(&room), [floor, wall]);
    // Paused, the hand leaves it alone.
    room.hand.take(Tool::Hand);
    room.hand.stand_still(true);
    assert!(room.drag([beside, beside + DVec2::new(0.0, -40.0)]).is_empty());
}

#[test]
fn the_pointer_says_what_a_drag_moves_and_a_copy_of_a_plane_is_off_it_on_its_free_side() {
    let text = r#"{"wobble": 1, "dimensions": 3, "gravity": [0, 0, 0],
        "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 2, 0]}}, {"circle": {"center": [0, 1, 0], "radius": 0.4}}],
        "view": {"target": [0, 0, 0], "distance": 9, "yaw": 0, "pitch": 0.5}}"#;
    let mut room = Room::of(text, Tool::Select);
    let pixel = |room: &Room, place: DVec3| DVec2::from(room.camera.screen_from_world(place).unwrap());
    let (on_floor, on_ball) = (pixel(&room, DVec3::new(2.0, 0.0, 1.0)), pixel(&room, DVec3::new(0.0, 1.0, 0.0)));
    let would = |room: &mut Room, at: DVec2| room.with(|hand, scope| hand.would_move(scope, at));
    assert!(would(&mut room, on_ball) && !would(&mut room, on_floor), "a drag over the floor draws a region");
    let floor = super::Chosen { obstacles: vec![0], ..super::Chosen::default() };
    let both = super::Chosen { obstacles: vec![0, 1], ..super::Chosen::default() };
    let by = room.with(|_, scope| [floor.beside(scope), both.beside(scope)].map(DVec3::from));
    assert!(by[0].y > 0.05 && by[0].x == 0.0 && by[0].z == 0.0, "{by:?}");
    assert!(by[1].x > 0.8 && by[1].y == 0.0, "beside the ball: {by:?}");
    room.hand.select(floor);
    assert!(would(&mut room, on_floor), "what is selected is moved");
}

#[test]
fn the_end_of_a_rope_is_tied_to_what_is_as_deep_as_it_is_and_not_to_what_is_seen_behind_it() {
    let tied = |depth: f64| {
        let text = format!(
            r#"{{"wobble": 1, "dimensions": 3, "gravity": [0, 0, 0],
            "points": {{"position": [[0, 2, 0], [0, 0, 0]]}}, "bonds": [{{"a": 0, "b": 1, "kind": "spring", "stiffness": 9}}],
            "bodies": [{{"make": "cloth", "columns": 5, "rows": 5, "spacing": 0.25, "origin": [-0.5, 0.5, {depth}],
                "material": {{"kind": "spring", "stiffness": 500, "mass": 1}}}}],
            "view": {{"target": [0, 0, 0], "distance": 9, "yaw": 0, "pitch": 0}}}}"#
        );
        let mut room = Room::of(&text, Tool::Hand);
        // The rope's end is seen on a corner of the skin, whichever way the cloth lies.
        let corner = (2..27).map(|point| room.pixel(point)).min_by(|a, b| a.x.total_cmp(&b.x)).unwrap();
        let inside = corner.lerp(room.pixel(14), 0.1);
        let end = room.facing_place(corner);
        let keys = crate::history::MoveKeys {
            points: vec![1],
            by: Some(crate::scene::Vector::Space(end.to_array())),
            ..crate::history::MoveKeys::default()
        };
        assert_eq!(room.stage.obey(Order::Give(vec![Do::Move(Box::new(keys))], None)), None);
        room.stage.show(&mut room.shown);
        room.with(|_, scope| super::knot::let_go(scope, &[PointId(1)], inside)).is_some()
    };
    assert!(tied(0.0) && tied(-0.2), "beside it");
    assert!(!tied(-4.0), "four metres behind it");
}

/// A ball on a floor, and a loose point behind it.
const BALL: &str = r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[0, 0, -1.5]]},
    "obstacles": [{"circle": {"center": [0, 0, 0], "radius": 1}}, {"plane": {"point": [0, -1, 0], "normal": [0, 1, 0]}}],
    "view": {"target": [0, 0, 0], "distance": 9, "yaw": 0, "pitch": 0.4}}"#;

#[test]
fn what_is_drawn_onto_a_ball_lies_before_it_and_says_so() {
    use crate::app::action::Primitive;
    use crate::sim::Figure;
    let mut room = Room::of(BALL, Tool::Build);
    let pixel = |room: &Room, at: [f64; 3]| DVec2::from(room.camera.screen_from_world(at.into()).unwrap());
    let (middle, behind) = (pixel(&room, [0.0; 3]), room.pixel(0));
    let beside = middle - DVec2::new(140.0, 0.0);
    let ball = room.shown.scenery.convex[0].figure;
    let cases = [
        // Across it, onto it from beside it, down from it, and along its foot through the floor.
        (Primitive::Rope, middle - DVec2::new(60.0, 30.0), DVec2::new(130.0, 20.0)),
        (Primitive::Rope, beside, DVec2::new(150.0, 10.0)),
        (Primitive::Rope, middle - DVec2::new(0.0, 50.0), DVec2::ZERO),
        (Primitive::Rope, behind - DVec2::new(90.0, 0.0), DVec2::new(90.0, 0.0)),
        (Primitive::Cloth, middle - DVec2::new(50.0, 50.0), DVec2::new(100.0, 80.0)),
        (Primitive::SolidCircle, middle - DVec2::new(20.0, 20.0), DVec2::new(50.0, 50.0)),
        (Primitive::SolidBox, beside, DVec2::new(200.0, 40.0)),
    ];
    for (primitive, from, by) in cases {
        room.hand.choose(primitive);
        room.with(|hand, scope| hand.press(scope, from));
        let would = room.with(|hand, scope| hand.marks(scope, Some(from + by)));
        let says =
            |mark: &super::Mark| matches!(mark, super::Mark::Words(_, words) if words.contains("in front of what"));
        assert!(would.iter().any(says), "{primitive:?} from {from}: {would:?}");
        let deed = room.with(|hand, scope| hand.release(scope, from + by));
        room.give(&deed);
        let places = room.places();
        let bonds = room.shown.scenery.bonds.ends().to_vec();
        assert!(bonds.iter().flatten().all(|end| end.0 != 0), "{primitive:?} is not tied to what the ball hides");
        let pinned = room.stage.history().world().pinned().to_vec();
        assert!(pinned.iter().all(|pin| pin.0 != 0), "{primitive:?} pins nothing else");
        assert!(primitive != Primitive::Rope || !pinned.is_empty(), "it hangs from where it was pressed");
        let middles = bonds.iter().map(|ends| places[ends[0].index()].midpoint(places[ends[1].index()]));
        for place in places.iter().copied().chain(middles).skip(1) {
            assert!(place.length() > 1.0 - 1e-4 && place.y > -1.0 - 1e-4, "{primitive:?}: {place}");
        }
        for convex in &room.shown.scenery.convex[1..] {
            assert!(convex.figure.extent()[0][1] > -1.0 - 1e-4, "{:?} is above the floor", convex.figure);
            match convex.figure {
                Figure::Ball { center, radius } => assert!(DVec3::from(center).length() > 1.0 + radius - 1e-4),
                Figure::Box { .. } => assert!(!convex.figure.holds(ball.center(), 1.0 - 1e-3)),
            }
        }
        assert!(places.len() > 1 || room.shown.scenery.convex.len() > 1);
        room.undo();
    }
}

/// A ball far before what the camera looks at.
const NEAR_BALL: &str = r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[0, 9, 0]]},
    "obstacles": [{"circle": {"center": [0, 0, 4], "radius": 0.6}}],
    "view": {"target": [0, 0, 0], "distance": 9, "yaw": 0, "pitch": 0}}"#;

#[test]
fn a_cloth_that_is_drawn_over_a_ball_is_never_behind_it() {
    use crate::app::action::Primitive;
    let mut room = Room::of(NEAR_BALL, Tool::Build);
    let middle = DVec2::from(room.camera.screen_from_world([0.0, 0.0, 4.0].into()).unwrap());
    room.hand.choose(Primitive::Cloth);
    // It begins beside the ball, where nothing is seen.
    let [from, to] = [middle - DVec2::new(170.0, 40.0), middle + DVec2::new(150.0, 60.0)];
    room.with(|hand, scope| hand.press(scope, from));
    let would = room.with(|hand, scope| hand.marks(scope, Some(to)));
    let says = |mark: &super::Mark| matches!(mark, super::Mark::Words(_, words) if words.contains("in front of"));
    assert!(would.iter().any(says), "{would:?}");
    let deed = room.with(|hand, scope| hand.release(scope, to));
    room.give(&deed);
    let places = room.places();
    assert!(places.len() > 20);
    assert!(places.iter().skip(1).all(|place| place.z > 4.0), "{places:?}");
}

#[test]
fn ropes_cloths_balls_and_boxes_are_built_as_deep_as_what_was_pressed_on_each_as_one_edit() {
    use crate::app::action::Primitive;
    let text = FLOOR.replace("[[0, 1, 0]]", "[[0, 1, 0], [1, 1, -2]]");
    let mut room = Room::of(&text, Tool::Build);
    let seen = |room: &Room, at: [f64; 3]| DVec2::from(room.camera.screen_from_world(at.into()).unwrap());
    let built = |room: &mut Room, primitive: Primitive, ends: [DVec2; 2]| {
        room.hand.choose(primitive);
        let would = room.with(|hand, scope| hand.marks(scope, Some(ends[0])));
        assert!(would.iter().any(|mark| matches!(mark, super::Mark::Words(..))), "{primitive:?}: its size is said");
        let deed = room.drag(ends);
        assert_eq!(deed.edit, Some(primitive.name()), "{deed:?}");
        room.give(&deed);
    };
    let floor = seen(&room, [-0.5, -1.0, 1.0]);
    for primitive in [Primitive::SolidCircle, Primitive::SolidBox] {
        built(&mut room, primitive, [floor; 2]);
        let [low, high] = room.shown.scenery.convex.last().unwrap().figure.extent();
        assert!((low[1] + 1.0).abs() < 1e-6, "{primitive:?} stands on the floor: {low:?}");
        assert!((0.5 * (low[0] + high[0]) + 0.5).abs() < 1e-6 && (0.5 * (low[2] + high[2]) - 1.0).abs() < 1e-6);
        room.undo();
        assert_eq!(room.shown.scenery.convex.len(), 2);
    }
    // A ball between the corners of its square, before all else.
    let [from, to] = [seen(&room, [-2.0, 1.5, 0.0]), seen(&room, [-1.0, 1.5, 0.0])];
    built(&mut room, Primitive::SolidCircle, [from, to]);
    let crate::sim::Figure::Ball { center, radius } = room.shown.scenery.convex.last().unwrap().figure else {
        panic!("a ball")
    };
    let wide = seen(&room, [center[0] + radius, center[1], center[2]]).distance(seen(&room, center));
    assert!((2.0 * wide - from.distance(to)).abs() < 2.0, "as wide as it was drawn: {wide} px");
    room.undo();
    // A rope from one point to the other, which lie at other depths.
    let ends = [room.pixel(0), room.pixel(1)];
    built(&mut room, Primitive::Rope, ends);
    let bonds = room.shown.scenery.bonds.ends().to_vec();
    assert!(room.shown.scenery.pinned.is_empty() && bonds.len() > 3, "{bonds:?}");
    for point in [0, 1] {
        assert_eq!(bonds.iter().flatten().filter(|end| end.0 == point).count(), 1, "tied to {point}");
    }
    room.undo();
    // From nothing: it hangs there.
    built(&mut room, Primitive::Rope, [from; 2]);
    let pin = room.shown.scenery.pinned[0];
    let at = room.pixel(pin.0);
    assert!(at.distance(from) < 1.0 && room.shown.scenery.pinned.len() == 1);
    room.undo();
    let far = from + DVec2::new(160.0, 110.0);
    built(&mut room, Primitive::Cloth, [from, far]);
    assert_eq!(room.shown.scenery.pinned.len(), 2, "it hangs by its upper corners");
    let heights = room.shown.scenery.pinned.iter().map(|pin| room.place(pin.index()).y);
    let highest = (2..room.shown.point_count()).map(|point| room.place(point).y).fold(f64::NEG_INFINITY, f64::max);
    assert!(heights.into_iter().all(|y| (y - highest).abs() < 1e-6));
    room.undo();
    // What is of the plane alone says so.
    room.hand.choose(Primitive::Rim);
    assert!(room.drag([from, far]).words.is_some_and(|words| words.contains("of the plane")));
}
