//! Presses and strokes without a window.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::{DVec2, DVec3};

use super::{Deed, Hand, Mark, Role, Scope};
use crate::app::action::Tool;
use crate::app::opening;
use crate::app::player::{Shown, Stage};
use crate::history::Do;
use crate::render::Camera;
use crate::scene::{Scene, gallery};
use crate::sim::{MouseChange, PointId, Reach};

pub(super) const SIZE: [u32; 2] = [1000, 700];

/// A scene as it opens.
pub(super) fn opened(name: &str) -> (Shown, Camera, Scene) {
    let entry = gallery().iter().find(|entry| entry.name == name).unwrap();
    let scene = entry.scene().unwrap();
    shown(scene)
}

pub(super) fn shown(scene: Scene) -> (Shown, Camera, Scene) {
    let mut shown = Shown::default();
    Stage::new(scene.clone().into()).unwrap().show(&mut shown);
    let camera = opening::camera(&scene, &shown.view(), SIZE);
    (shown, camera, scene)
}

pub(super) fn scope((shown, camera, _): &(Shown, Camera, Scene)) -> Scope<'_> {
    Scope { shown, camera, scale: 1.0, free: Scope::ANYWHERE }
}

pub(super) fn pixel(of: &(Shown, Camera, Scene), point: usize) -> DVec2 {
    of.1.screen_from_world(DVec3::from(of.0.place(point))).unwrap().into()
}

/// The points that a deed grabs.
pub(super) fn grabbed(deed: &Deed) -> Vec<PointId> {
    let points = deed.commands.iter().find_map(|command| match command {
        Do::Grab(Reach::Points(points) | Reach::Patch { points, .. }) => Some(points.clone()),
        _ => None,
    });
    points.unwrap_or_default()
}

#[test]
fn a_press_on_a_body_grabs_it_on_all_kinds_of_scenes() {
    for (name, point) in [("rim", 3), ("rope", 900), ("ring", 40), ("net", 5050)] {
        let opened = opened(name);
        let mut hand = Hand::default();
        let at = pixel(&opened, point);
        let deed = hand.press(scope(&opened), at + DVec2::new(4.0, -3.0));
        let points = grabbed(&deed);
        assert!(!points.is_empty() && hand.is_grabbing(), "{name}");
        let near = |point: &PointId| pixel(&opened, point.index()).distance(at) < 90.0;
        assert!(points.iter().all(near), "{name}: {points:?}");
        assert_eq!(deed.edit, None, "a grab is no edit");
        assert_eq!(hand.release(scope(&opened), at).commands, [Do::Release], "{name}");
    }
}

#[test]
fn a_press_beside_all_bodies_pushes() {
    let opened = opened("rim");
    let mut hand = Hand::default();
    hand.set_strength(Some(3000.0));
    let deed = hand.press(scope(&opened), DVec2::new(30.0, 30.0));
    assert!(deed.is_empty() && hand.is_busy() && !hand.is_grabbing());
    assert!(!hand.is_calm(), "the hover force is what pushes");
    assert!(hand.release(scope(&opened), DVec2::new(400.0, 300.0)).is_empty());
}

#[test]
fn the_hover_force_is_away_while_something_is_led_and_a_little_longer() {
    let opened = opened("rim");
    let mut hand = Hand::default();
    hand.set_strength(Some(3000.0));
    let mouse = |strength| Do::Mouse(MouseChange { strength: Some(strength), ..MouseChange::default() });
    let at = pixel(&opened, 0);
    assert_eq!(hand.press(scope(&opened), at).commands[0], mouse(0.0), "within the frame of the press");
    assert!(hand.pass(10.0).is_empty(), "as long as the button is down");
    hand.release(scope(&opened), at);
    assert!(hand.pass(0.15).is_empty() && hand.is_calm());
    assert_eq!(hand.pass(0.06).commands, [mouse(3000.0)], "0.2 s later it is back");
    assert!(!hand.is_calm() && hand.pass(1.0).is_empty());
}

#[test]
fn a_history_that_is_left_has_nothing_on_the_hand() {
    let opened = opened("rim");
    let mut hand = Hand::default();
    hand.set_strength(Some(3000.0));
    assert!(hand.leave().is_empty());
    let at = pixel(&opened, 0);
    hand.press(scope(&opened), at);
    let mouse = Do::Mouse(MouseChange { strength: Some(3000.0), ..MouseChange::default() });
    assert_eq!(hand.leave().commands, [Do::Release, mouse.clone()]);
    assert!(!hand.is_busy() && !hand.is_calm());
    hand.press(scope(&opened), at);
    hand.release(scope(&opened), at);
    assert_eq!(hand.leave().commands, [mouse], "within a moment after letting go too");
}

#[test]
fn a_second_press_while_it_is_calm_does_not_forget_the_strength() {
    let opened = opened("rim");
    let mut hand = Hand::default();
    hand.set_strength(Some(3000.0));
    let at = pixel(&opened, 0);
    for _ in 0..3 {
        hand.press(scope(&opened), at);
        hand.release(scope(&opened), at);
        assert!(hand.pass(0.1).is_empty());
    }
    assert_eq!(hand.pass(0.2).commands.len(), 1);
}

#[test]
fn the_tool_for_pins_holds_and_lets_go() {
    let opened = opened("rope");
    let mut hand = Hand::default();
    assert!(!hand.hold_pins(true));
    assert_eq!(hand.tool(), Tool::Pin);
    let deed = hand.press(scope(&opened), pixel(&opened, 0));
    assert_eq!((deed.commands, deed.edit), (vec![Do::Unpin(vec![PointId(0)])], Some("unpin")));
    assert!(deed.words.is_some_and(|words| words.starts_with("unpinned: ")));
    let deed = hand.press(scope(&opened), pixel(&opened, 999));
    assert_eq!((deed.commands, deed.edit), (vec![Do::Pin(vec![PointId(999)])], Some("pin")));
    assert_eq!(deed.words.as_deref(), Some("pinned"));
    assert!(hand.hold_pins(false), "there were clicks");
    assert_eq!(hand.tool(), Tool::Hand);
    hand.hold_pins(true);
    assert!(!hand.hold_pins(false), "the key alone was pressed");
    // Then it lets the pin under the pointer go, and pins nothing.
    let deed = super::unpin(scope(&opened), pixel(&opened, 0));
    assert_eq!((deed.commands, deed.edit), (vec![Do::Unpin(vec![PointId(0)])], Some("unpin")));
    let deed = super::unpin(scope(&opened), pixel(&opened, 999));
    assert!(deed.commands.is_empty() && deed.words.is_some_and(|words| words.contains("press T")));
}

#[test]
fn a_button_that_cuts_does_so_whatever_tool_is_taken_and_gives_that_back() {
    let opened = opened("tearable-net");
    let [from, to] = [DVec2::new(5.0, 300.0), DVec2::new(995.0, 330.0)];
    for tool in [Tool::Hand, Tool::Build, Tool::Motor] {
        let mut hand = Hand::default();
        hand.take(tool);
        hand.hold_cut(true);
        assert!(hand.press(scope(&opened), from).is_empty() && hand.is_busy());
        hand.trace(scope(&opened), to);
        assert!(!hand.marks(scope(&opened), Some(to)).is_empty(), "the stroke is drawn");
        let deed = hand.release(scope(&opened), to);
        hand.hold_cut(false);
        assert!(matches!(deed.commands[..], [Do::Cut { .. }, ..]), "{tool:?}: {deed:?}");
        assert_eq!(hand.tool(), tool);
    }
}

#[test]
fn a_drag_through_bodies_says_where_nothing_pushes_how_to_get_a_push() {
    let mut net = opened("tearable-net");
    let [from, to] = [DVec2::new(3.0, 350.0), DVec2::new(500.0, 350.0)];
    let dragged = |net: &(Shown, Camera, Scene), to: DVec2| {
        let mut hand = Hand::default();
        assert!(hand.press(scope(net), from).is_empty() && hand.is_pushing());
        hand.trace(scope(net), to);
        hand.release(scope(net), to).words
    };
    assert!(dragged(&net, to).is_some_and(|words| words.contains("settings (G)")));
    assert_eq!([from, from + DVec2::new(0.0, 300.0)].map(|to| dragged(&net, to)), [None, None], "beside all bodies");
    net.0.mouse = opened("net").0.mouse;
    assert!(net.0.mouse.is_some());
    assert_eq!(dragged(&net, to), None);
}

#[test]
fn only_the_hand_pushes() {
    let mut hand = Hand::default();
    hand.set_strength(Some(3000.0));
    let mouse = |strength| Do::Mouse(MouseChange { strength: Some(strength), ..MouseChange::default() });
    assert!(hand.pass(0.1).is_empty() && !hand.is_fading());
    hand.take(Tool::Erase);
    assert!(hand.is_fading());
    assert_eq!(hand.pass(0.1).commands, [mouse(0.0)], "what is to be erased stays where it is");
    assert!(hand.pass(9.0).is_empty() && hand.is_calm() && !hand.is_fading(), "at rest");
    hand.take(Tool::Hand);
    assert!(hand.is_fading() && hand.pass(0.15).is_empty());
    assert_eq!(hand.pass(0.06).commands, [mouse(3000.0)]);
    assert!(!hand.is_calm());
}

#[test]
fn a_stroke_cuts_from_where_it_began_and_a_click_does_not() {
    let opened = opened("rim");
    let mut hand = Hand::default();
    hand.take(Tool::Cut);
    let [from, to] = [DVec2::new(200.0, 350.0), DVec2::new(800.0, 360.0)];
    assert!(hand.press(scope(&opened), from).is_empty());
    assert!(hand.marks(scope(&opened), Some(to)).len() > 1, "the stroke is seen, and the bonds that go");
    let deed = hand.release(scope(&opened), to);
    let [Do::Cut { from: start, to: end }] = deed.commands[..] else { panic!("{deed:?}") };
    assert!(start.origin[0] < -1.0 && end.origin[0] > 1.0 && deed.edit == Some("cut"));
    hand.press(scope(&opened), from);
    assert!(hand.release(scope(&opened), from).is_empty());
    hand.press(scope(&opened), from);
    assert!(hand.cancel().0 && !hand.is_busy(), "Esc leaves it uncut");
}

#[test]
fn a_stroke_in_line_with_a_bond_marks_and_cuts_it_where_it_lies_on_it_and_not_beside_it() {
    let text = r#"{"wobble": 1, "gravity": [0, 0], "points": {"position": [[0, 0], [1, 0]]}, "bonds": [{"a": 0, "b": 1}],
        "view": {"center": [0, 0], "height": 8}}"#;
    let rope = shown(Scene::parse(text, "x.json").unwrap());
    let [start, end] = [pixel(&rope, 0), pixel(&rope, 1)];
    let mut hand = Hand::default();
    hand.take(Tool::Cut);
    for (from, to, is_cut) in [(end + DVec2::X * 30.0, end + DVec2::X * 120.0, false), (start, end * 2.0 - start, true)]
    {
        hand.press(scope(&rope), from);
        let marks = hand.marks(scope(&rope), Some(to)).len();
        let deed = hand.release(scope(&rope), to);
        assert_eq!((marks, deed.commands.len()), if is_cut { (2, 1) } else { (1, 0) }, "{deed:?}");
    }
}

/// What a click comes to.
fn clicked(hand: &mut Hand, scope: Scope<'_>, at: DVec2) -> Deed {
    assert!(hand.press(scope, at).is_empty(), "what is pressed on is shown, and goes as the button goes up");
    hand.release(scope, at)
}

#[test]
fn a_stroke_of_the_eraser_takes_all_that_it_goes_over_but_the_ground_as_one_step() {
    let text = r#"{"wobble": 1, "obstacles": [{"plane": {"point": [0, -3], "normal": [0, 1]}},
        {"box": {"min": [3, -0.5], "max": [4, 0.5]}}], "view": {"center": [0, 0], "height": 12}, "bodies": [
        {"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.3, "origin": [-4, -0.3], "material": {"kind": "spring", "stiffness": 300}},
        {"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.3, "origin": [-2, -0.3], "material": {"kind": "spring", "stiffness": 300}},
        {"make": "rope", "count": 5, "to": [0, -2], "origin": [0, 1]},
        {"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.3, "origin": [1.5, 2], "material": {"kind": "spring", "stiffness": 300}}]}"#;
    let seen = shown(Scene::parse(text, "x.json").unwrap());
    let at = |x: f64, y: f64| DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap());
    let mut hand = Hand::default();
    hand.take(Tool::Erase);
    assert!(hand.press(scope(&seen), at(-5.0, 0.0)).is_empty() && hand.is_busy());
    for k in 1..=8 {
        hand.trace(scope(&seen), at(-5.0 + f64::from(k), -0.1));
    }
    let marks = hand.marks(scope(&seen), Some(at(3.0, -0.1)));
    assert!(marks.len() > 16, "what goes is shown before: {}", marks.len());
    // Along the floor, which stays, to the air.
    hand.trace(scope(&seen), at(3.5, -0.1));
    hand.trace(scope(&seen), at(3.0, -3.2));
    let deed = hand.release(scope(&seen), at(5.0, -2.0));
    let [Do::Delete(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert_eq!(keys.points, (0..18).collect::<Vec<u32>>(), "two of three boxes");
    assert_eq!((keys.bonds.len(), keys.obstacles.as_slice()), (1, &[1][..]), "a bond of the rope, and the box");
    assert_eq!(deed.edit, Some("erase"), "undo calls it by its tool");
    let said = deed.words.as_deref();
    assert_eq!(said, Some("erased 2 bodies, 1 bond and 1 obstacle: Ctrl+Z brings them back"));
    // Esc leaves all of it.
    hand.press(scope(&seen), at(-5.0, 0.0));
    hand.trace(scope(&seen), at(3.0, 0.0));
    assert!(hand.cancel().0 && hand.release(scope(&seen), at(3.0, 0.0)).is_empty());
    // What was pressed on goes, wherever it is by the time that the press is a stroke.
    hand.press(scope(&seen), at(-3.7, 0.0));
    hand.trace(scope(&seen), at(-3.7, 3.0));
    let deed = hand.release(scope(&seen), at(-3.7, 3.0));
    let [Do::Delete(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert_eq!((keys.points.len(), keys.bonds.len()), (9, 0));
    // A stroke that begins on the ground means that.
    hand.press(scope(&seen), at(-5.0, -3.1));
    let deed = hand.release(scope(&seen), at(-4.0, -3.1));
    let [Do::Delete(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert_eq!((keys.points.len(), keys.obstacles.as_slice()), (0, &[0][..]));
    assert_eq!(deed.edit, Some("erase an obstacle"));
}

#[test]
fn of_a_rope_that_a_body_hangs_on_and_of_a_fine_net_a_stroke_takes_the_bonds_that_it_goes_over() {
    let text = r#"{"wobble": 1, "view": {"center": [0, 0], "height": 12}, "bonds": [{"a": 4, "b": 13}], "bodies": [
        {"make": "rope", "count": 5, "to": [0, -2], "origin": [0, 3], "pinned": [0]},
        {"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.3, "origin": [-0.6, -0.5], "material": {"kind": "spring", "stiffness": 300}},
        {"make": "cloth", "columns": 30, "rows": 30, "spacing": 0.05, "origin": [2, 3]}]}"#;
    let seen = shown(Scene::parse(text, "x.json").unwrap());
    let at = |x: f64, y: f64| DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap());
    let mut hand = Hand::default();
    hand.take(Tool::Erase);
    let mut stroke = |from: DVec2, to: DVec2| {
        hand.press(scope(&seen), from);
        hand.trace(scope(&seen), from.lerp(to, 0.4));
        let deed = hand.release(scope(&seen), to);
        let [Do::Delete(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
        keys.clone()
    };
    let keys = stroke(at(-0.6, 2.24), at(0.6, 2.26));
    assert_eq!((keys.points.len(), keys.bonds.len()), (0, 1), "{keys:?}");
    // Pressed on a point of it, too; what is filled goes with what hangs on it.
    let keys = stroke(at(0.0, 2.5), at(0.9, 2.5));
    assert!(keys.points.is_empty() && (1..=2).contains(&keys.bonds.len()), "{keys:?}");
    let keys = stroke(at(-1.2, -0.35), at(0.6, -0.35));
    assert_eq!(keys.points.len(), 5 + 9);
    // Threads of 3 pixels: none is left along the stroke.
    let keys = stroke(at(1.8, 2.325), at(3.7, 2.325));
    let cut: Vec<u32> = keys.bonds.clone();
    let lies_across = |[a, b]: [PointId; 2]| {
        let [p, q] = [a, b].map(|point| seen.0.place(point.index()));
        p[0] > 1.9 && (p[1] - 2.325) * (q[1] - 2.325) < 0.0
    };
    let across = seen.0.scenery.bonds.ends().iter().enumerate().filter(|(_, ends)| lies_across(**ends));
    let across: Vec<u32> = across.map(|(place, _)| seen.0.scenery.bond_number(place)).collect();
    assert!(
        across.len() >= 30 && across.iter().all(|number| cut.contains(number)),
        "{} and {}",
        across.len(),
        cut.len()
    );
}

#[test]
fn what_is_erased_is_a_body_a_bond_or_an_obstacle() {
    let opened_rims = opened("pebble");
    let mut hand = Hand::default();
    hand.take(Tool::Erase);
    let deed = clicked(&mut hand, scope(&opened_rims), pixel(&opened_rims, 0));
    let [Do::Delete(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    let count = opened_rims.0.point_count();
    assert!(keys.points.len() > 50 && keys.points.len() < count, "one of two stones: {} of {count}", keys.points.len());
    assert_eq!(deed.words.as_deref(), Some("erased 1 body: Ctrl+Z brings it back"));
    let springs = opened("spring-damper");
    let middle = 0.5 * (pixel(&springs, 0) + pixel(&springs, 1));
    let deed = clicked(&mut hand, scope(&springs), middle);
    let [Do::Delete(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert_eq!((keys.bonds.as_slice(), keys.points.len()), (&[0][..], 0));
    let text = r#"{"wobble": 1, "points": {"position": [[5, 5]]},
        "obstacles": [{"box": {"min": [-1, -1], "max": [1, 1]}}], "view": {"center": [0, 0], "height": 12}}"#;
    let solid = shown(Scene::parse(text, "x.json").unwrap());
    let deed = clicked(&mut hand, scope(&solid), DVec2::new(500.0, 350.0));
    let [Do::Delete(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert_eq!(keys.obstacles, [0]);
    assert_eq!(deed.words.as_deref(), Some("erased 1 obstacle: Ctrl+Z brings it back"));
    assert!(clicked(&mut hand, scope(&solid), DVec2::new(20.0, 600.0)).is_empty(), "nothing is there");
}

#[test]
fn of_a_small_box_the_body_is_erased_wherever_it_is_clicked_and_of_a_large_one_a_bond_that_is_pointed_at() {
    for (spacing, is_small) in [(0.3, true), (2.0, false)] {
        let text = format!(
            r#"{{"wobble": 1, "view": {{"center": [0, 0], "height": 12}}, "bodies": [{{"make": "lattice", "columns": 3, "rows": 3,
                "spacing": {spacing}, "origin": [{0}, {0}], "material": {{"kind": "spring", "stiffness": 300, "mass": 1}}}}]}}"#,
            -spacing
        );
        let seen = shown(Scene::parse(&text, "x.json").unwrap());
        let [from, to] = [pixel(&seen, 0), pixel(&seen, 1)];
        let mut hand = Hand::default();
        hand.take(Tool::Erase);
        for off in [0.0, 5.0] {
            let at = from.lerp(to, 0.5) - DVec2::new(0.0, off);
            let marks = hand.marks(scope(&seen), Some(at));
            let is_said =
                marks.iter().any(|mark| matches!(mark, Mark::Words(_, words) if words.contains("this bond alone")));
            let deed = clicked(&mut hand, scope(&seen), at);
            let [Do::Delete(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
            let is_bond = !is_small && off == 0.0;
            assert_eq!((keys.bonds.len(), keys.points.len()), if is_bond { (1, 0) } else { (0, 9) }, "{spacing} {off}");
            assert_eq!(is_said, is_bond, "it is seen before: {marks:?}");
        }
    }
}

#[test]
fn where_a_click_starts_a_motion_pins_are_not_grabbed_and_what_moves_is() {
    let portrait = opened("phase-portrait");
    let count = portrait.0.point_count();
    let pins: Vec<usize> = (0..count).filter(|&point| scope(&portrait).is_pinned(PointId(point as u32))).collect();
    assert!(pins.len() > 200);
    for is_still in [false, true] {
        let begun = || {
            let mut hand = Hand::default();
            hand.stand_still(is_still);
            hand
        };
        // Beside an arrow too, and where nothing is.
        for at in pins.iter().step_by(7).map(|&pin| pixel(&portrait, pin)).chain([DVec2::new(20.0, 20.0)]) {
            if !scope(&portrait).nearest(at).is_none_or(|hit| scope(&portrait).is_pinned(hit.point)) {
                continue;
            }
            let mut hand = begun();
            let marks = hand.marks(scope(&portrait), Some(at));
            assert!(matches!(marks[..], [Mark::Ring(Role::Come, ..)]), "{at}: {marks:?}");
            assert_eq!(hand.press(scope(&portrait), at), Deed::default(), "{at}");
            assert!(hand.is_pushing() && !hand.has_clicked(scope(&portrait), at), "{at}: the press has started it");
            assert!(hand.release(scope(&portrait), at).is_empty());
        }
        let mut hand = begun();
        let at = pixel(&portrait, 0);
        let deed = hand.press(scope(&portrait), at);
        assert_eq!(grabbed(&deed).is_empty(), is_still, "it is led, or moved");
        assert!(hand.has_clicked(scope(&portrait), at) && !hand.has_clicked(scope(&portrait), at + 50.0));
    }
    // Elsewhere pins are led.
    let swing = opened("spring-damper");
    assert!(!scope(&swing).starts_at(DVec2::new(20.0, 20.0)));
}

#[test]
fn in_space_the_foremost_of_balls_and_boxes_is_erased_and_marked_before() {
    let text = r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[9, 9, 9]]}, "obstacles": [
        {"box": {"min": [-1, -1, -4], "max": [1, 1, -3]}}, {"circle": {"center": [0, 0, 0], "radius": 0.5}}],
        "view": {"target": [0, 0, 0], "distance": 12, "yaw": 0, "pitch": 0}}"#;
    let space = shown(Scene::parse(text, "x.json").unwrap());
    let mut hand = Hand::default();
    hand.take(Tool::Erase);
    let beside = DVec2::new(500.0, 350.0) + DVec2::new(0.8 * space.1.pixels_per_metre() * 12.0 / 15.0, 0.0);
    for (at, number, marks) in [(DVec2::new(500.0, 350.0), 1, 1), (beside, 0, 12)] {
        assert_eq!(hand.marks(scope(&space), Some(at)).len(), marks);
        let deed = clicked(&mut hand, scope(&space), at);
        let [Do::Delete(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
        assert_eq!(keys.obstacles, [number]);
    }
    assert!(clicked(&mut hand, scope(&space), DVec2::new(20.0, 600.0)).is_empty(), "nothing is there");
}

#[test]
fn in_space_the_foremost_is_picked_by_the_ray() {
    let text = r#"{"wobble": 1, "dimensions": 3, "gravity": [0, 0, 0],
        "points": {"position": [[0, 0, -3], [0, 0, 3], [2, 0, 0]]},
        "view": {"target": [0, 0, 0], "distance": 12, "yaw": 0, "pitch": 0}}"#;
    let space = shown(Scene::parse(text, "x.json").unwrap());
    let mut hand = Hand::default();
    let deed = hand.press(scope(&space), DVec2::new(502.0, 351.0));
    assert_eq!(grabbed(&deed), [PointId(1)], "the nearer of two in a line");
    hand.release(scope(&space), DVec2::ZERO);
    hand.take(Tool::Cut);
    hand.press(scope(&space), DVec2::new(100.0, 100.0));
    assert!(hand.release(scope(&space), DVec2::new(900.0, 600.0)).is_empty(), "nothing lies there");
}

#[test]
fn a_press_between_the_points_of_a_skin_takes_a_handful_of_it() {
    let opened = opened("ring");
    let corners = opened.0.scenery.skins[0].triangles[100];
    let middle = corners.iter().map(|&corner| pixel(&opened, corner as usize)).sum::<DVec2>() / 3.0;
    // From near by the points are far apart on the screen.
    let mut near = opened.1;
    near.zoom_at(middle.to_array(), 30.0);
    let opened = (opened.0, near, opened.2);
    let deed = Hand::default().press(scope(&opened), middle);
    let mut points = grabbed(&deed);
    points.sort_unstable();
    // A handful about it, which is enough to lift the ring by.
    assert!(corners.iter().all(|&corner| points.contains(&PointId(corner))), "{points:?}");
    assert_eq!(points.len(), opened.0.point_count() / 12);
}
