//! Copies in worlds that run: where they come, and what they have.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::*;
use crate::app::player::{Note, Order, Stage};
use crate::picture::{Picture, Tint};
use crate::render::{Pose, palette_color};
use crate::scene::{Scene, picture_as_text};

fn stage(text: &str) -> Stage {
    Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap()
}

/// 12 m wide and 8 m high, all of it free of panels.
fn wish(by: [f64; 3], is_meant: bool) -> Wish {
    let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 8.0 }, [1200, 800]);
    Wish { name: "duplicate", by, is_meant, is_beside: !is_meant, camera, free: [[0.0; 2], [1200.0, 800.0]] }
}

/// A copy of points and obstacles comes. Returns what it is, and what is said of it.
fn put(stage: &mut Stage, chosen: &Chosen, wish: Wish) -> Result<(Chosen, Option<&'static str>), String> {
    let chosen = chosen.clone();
    match stage.obey(Order::Add(Box::new(move |history| Clip::of(history, &chosen).coming(history, &wish)))) {
        Some(Note::Came(came, said, _)) => Ok((Chosen { points: came.points, obstacles: came.obstacles }, said)),
        Some(Note::Refused(why)) => Err(why),
        other => panic!("{other:?}"),
    }
}

fn points(range: std::ops::Range<u32>) -> Chosen {
    Chosen { points: range.map(PointId).collect(), obstacles: Vec::new() }
}

fn around(stage: &Stage, chosen: &Chosen) -> [DVec2; 2] {
    let x = stage.history().world().positions();
    let at = |point: &PointId| DVec2::new(x.get(2 * point.index()), x.get(2 * point.index() + 1));
    let all: Vec<DVec2> = chosen.points.iter().map(at).collect();
    [all.iter().copied().reduce(DVec2::min).unwrap(), all.iter().copied().reduce(DVec2::max).unwrap()]
}

fn meet([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    a.cmplt(d).all() && c.cmplt(b).all()
}

const BOX: &str = r#"{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5, "origin": [-5, -3.5],
    "material": {"kind": "spring", "stiffness": 300, "mass": 4}}"#;

fn crowded(more: &str) -> String {
    format!(
        r#"{{"wobble": 1, "contact": true, "bounds": {{"min": [-5.5, -3.6], "max": [5.5, 3.6]}}, "bodies": [{BOX}]{more}}}"#
    )
}

#[test]
fn one_duplicate_after_another_finds_a_place_of_its_own_in_view() {
    let wall = r#", "obstacles": [{"box": {"min": [-0.5, -3.6], "max": [0.5, 0]}}]"#;
    let mut stage = stage(&crowded(wall));
    let mut last = points(0..9);
    let mut all = vec![around(&stage, &last)];
    for count in 0..24 {
        let (came, said) = put(&mut stage, &last, wish([1.1, 0.0, 0.0], false)).unwrap();
        assert_eq!(said, None, "{count}");
        let place = around(&stage, &came);
        assert!(!all.iter().any(|other| meet(place, *other)), "{count}: {place:?} in {all:?}");
        assert!(!meet(place, [DVec2::new(-0.5, -3.6), DVec2::new(0.5, 0.0)]), "{count}: {place:?}");
        assert!(place[0].cmpgt(DVec2::new(-5.5, -3.6)).all() && place[1].cmplt(DVec2::new(5.5, 3.6)).all());
        if count < 3 {
            assert!(place[0].distance(all[count][0]) < 1.5, "beside it: {place:?}");
        }
        all.push(place);
        last = came;
    }
    // Nothing moved any other aside, and each is one step of undo.
    assert_eq!(around(&stage, &points(0..9)), all[0]);
    for _ in 0..24 {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "duplicate"));
    }
    assert_eq!(stage.history().world().gone().len() + 9, stage.history().world().point_count());
}

#[test]
fn what_is_pasted_goes_to_the_pointer_or_as_near_as_there_is_room() {
    let mut stage = stage(&crowded(""));
    let own = points(0..9);
    // Where it is free it is there to the bit.
    let (came, said) = put(&mut stage, &own, wish([6.25, 4.5, 0.0], true)).unwrap();
    assert_eq!((around(&stage, &came)[0], said), (DVec2::new(1.25, 1.0), None));
    // Onto that: beside it.
    let (beside, said) = put(&mut stage, &own, wish([6.3, 4.5, 0.0], true)).unwrap();
    let [low, high] = around(&stage, &beside);
    assert!(!meet([low, high], around(&stage, &came)) && said.is_none());
    assert!(low.distance(DVec2::new(1.25, 1.0)) < 1.3, "{low}");
    // Beyond the walls: within them.
    let (inside, _) = put(&mut stage, &own, wish([10.4, 0.0, 0.0], true)).unwrap();
    let [low, high] = around(&stage, &inside);
    assert!(high.x <= 5.5 && low.x > 4.0, "{low} {high}");
}

#[test]
fn where_nothing_is_free_it_says_that_it_lies_in_another_and_in_solid_ground_nothing_comes() {
    let large =
        BOX.replace("\"columns\": 3, \"rows\": 3, \"spacing\": 0.5", "\"columns\": 12, \"rows\": 8, \"spacing\": 0.98");
    let large = large.replace("-5, -3.5", "-5.4, -3.5");
    let text = crowded("").replacen(BOX, &format!("{large}, {}", BOX.replace("-5, -3.5", "-3, 0")), 1);
    let mut full = stage(&text);
    let (_, said) = put(&mut full, &points(96..105), wish([1.1, 0.0, 0.0], false)).unwrap();
    assert_eq!(said, Some("no free space in view: it overlaps another body"));
    let ground = r#", "obstacles": [{"box": {"min": [-4.2, -3.6], "max": [5.5, 3.6]}}, {"box": {"min": [-5.5, -2], "max": [-4, 3.6]}}]"#;
    let mut solid = stage(&crowded(ground));
    let count = solid.history().world().point_count();
    // What lies there now is in its way: it would lie in that, but in nothing solid.
    assert!(put(&mut solid, &points(0..9), wish([3.0, 2.0, 0.0], true)).unwrap().1.is_some());
    let wide = BOX.replace("\"columns\": 3", "\"columns\": 9");
    let mut other = stage(&crowded("").replacen(BOX, &wide, 1));
    let clip = Clip::of(other.history(), &points(0..27));
    let why = solid.obey(Order::Add(Box::new(move |history| clip.coming(history, &wish([3.0, 2.0, 0.0], true)))));
    assert!(matches!(why, Some(Note::Refused(why)) if why.contains("no space")));
    assert_eq!(solid.history().world().point_count(), count + 9, "nothing of it came");
    assert!(put(&mut other, &points(0..27), wish([0.0, 2.0, 0.0], true)).is_ok());
}

#[test]
fn a_copy_of_what_fills_the_view_lies_beside_it_and_that_is_said() {
    let wide =
        BOX.replace("\"columns\": 3, \"rows\": 3", "\"columns\": 30, \"rows\": 20").replace("-5, -3.5", "-7, -5");
    let mut stage = stage(&format!(r#"{{"wobble": 1, "contact": true, "bodies": [{wide}]}}"#));
    let (came, said) = put(&mut stage, &points(0..600), wish([16.0, 0.0, 0.0], false)).unwrap();
    assert!(said.is_some_and(|said| said.contains("beside it, partly out of view")), "{said:?}");
    assert_eq!(around(&stage, &came)[0], DVec2::new(9.0, -5.0));
}

#[test]
fn a_copy_in_space_stands_beside_all_others() {
    let text = r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]},
        "bonds": [{"a":0,"b":1},{"a":1,"b":2},{"a":2,"b":3},{"a":3,"b":0}]}"#;
    let mut stage = stage(text);
    let camera =
        Camera::new(Pose::Orbit { target: glam::DVec3::ZERO, distance: 12.0, yaw: 0.3, pitch: 0.3 }, [1200, 800]);
    let wish = || Wish { camera, ..wish([0.0; 3], true) };
    let bonds = [[0, 1], [1, 2], [2, 3], [3, 0]];
    let places = |stage: &Stage, first: u32| -> Vec<glam::DVec3> {
        let x = stage.history().world().positions();
        let at = |k: u32| glam::DVec3::from([0, 1, 2].map(|axis| x.get(3 * (first + k) as usize + axis)));
        bonds.iter().flat_map(|&[a, b]| (0..20).map(move |k| at(a).lerp(at(b), f64::from(k) / 20.0))).collect()
    };
    let mut all = places(&stage, 0);
    for _ in 0..6 {
        let (came, said) = put(&mut stage, &points(0..4), wish()).unwrap();
        assert_eq!(said, None);
        let own = places(&stage, came.points[0].0);
        let apart = own.iter().flat_map(|a| all.iter().map(move |b| a.distance(*b))).fold(f64::INFINITY, f64::min);
        assert!(apart > 0.04, "{apart} m from the others");
        all.extend(own);
    }
}

#[test]
fn in_space_room_is_judged_by_shapes_and_not_by_the_boxes_around_them() {
    // A sheet aslant across its box, a ball in a corner of that, and a small body.
    let text = r#"{"wobble": 1, "dimensions": 3, "bodies": [{"make": "cloth", "columns": 11, "rows": 11, "spacing": 0.2,
        "u": [0.7071067811865476, 0.7071067811865476, 0], "v": [0, 0, 1], "origin": [-0.7, -0.7, -1]}],
        "points": {"position": [[3,0,0],[3.2,0,0],[3,0.2,0]]}, "bonds": [{"a":0,"b":1},{"a":1,"b":2},{"a":2,"b":0}],
        "obstacles": [{"circle": {"center": [0.5, -0.5, 0], "radius": 0.15}}]}"#;
    let camera =
        Camera::new(Pose::Orbit { target: glam::DVec3::ZERO, distance: 12.0, yaw: 0.3, pitch: 0.3 }, [1200, 800]);
    let mut stage = stage(text);
    let place = |stage: &Stage, point: u32| {
        let x = stage.history().world().positions();
        glam::DVec3::from([0, 1, 2].map(|axis| x.get(3 * point as usize + axis)))
    };
    for (to, is_free, why) in [
        ([-0.4, 0.4, 0.0], true, "in the box around the sheet, beside it"),
        ([-0.1, -0.1, 0.05], false, "across the sheet"),
        ([0.45, -0.5, 0.0], false, "in the ball"),
        ([0.5, -0.1, 0.5], true, "in the box, over the ball"),
    ] {
        let by = (glam::DVec3::from(to) - glam::DVec3::new(3.0, 0.0, 0.0)).to_array();
        let (came, said) = put(&mut stage, &points(0..3), Wish { camera, ..wish(by, true) }).unwrap();
        assert_eq!(said, None, "{why}");
        let off = place(&stage, came.points[0].0).distance(glam::DVec3::from(to));
        assert_eq!(off < 1e-9, is_free, "{why}: {off} m off");
        assert!(off < 1.0, "{why}: the nearest room is near");
        stage.obey(Order::Undo(None));
    }
}

#[test]
fn a_copy_keeps_its_picture_its_colours_and_its_groups_here_and_as_text() {
    let mut picture = Picture::filled(3, 2, [200, 30, 40, 255]);
    picture.rgba[..4].copy_from_slice(&[1, 2, 3, 255]);
    let image = picture_as_text(&picture).unwrap();
    let text = format!(
        r##"{{"wobble": 1, "points": {{"position": [[0,0],[1,0],[0,1],[3,0],[4,0],[3,1],[5,0],[6,0],[5,1]]}},
        "bonds": [{{"a":0,"b":1}},{{"a":1,"b":2}},{{"a":2,"b":0}},{{"a":3,"b":4}},{{"a":4,"b":5}},{{"a":5,"b":3}},{{"a":6,"b":7}}],
        "triangles": [[0,1,2],[3,4,5],[6,7,8]], "skins": [{{"points":[6,7,8],"color":"#010203"}}],
        "groups": [{{"points":[0,1,2,3,4,5],"title":"pair"}}, {{"points":[3,6]}}],
        "texture": {{"image": "{image}", "uv": [[0,0],[1,0],[0,1],[-1,-1],[-1,-1],[-1,-1],[-1,-1],[-1,-1],[-1,-1]]}}}}"##
    );
    let mut own = stage(&text);
    let clip = Clip::of(own.history(), &points(0..9));
    let read = Fragment::parse(&clip.fragment().to_text().unwrap()).unwrap();
    assert_eq!(Clip::of_fragment(read), clip);
    let mut other = stage(r#"{"wobble": 1, "points": {"position": [[0,-9]]}}"#);
    for (place, stage) in [&mut own, &mut other].into_iter().enumerate() {
        let first = stage.history().world().point_count() as u32;
        let clip = clip.clone();
        let note = stage.obey(Order::Add(Box::new(move |history| clip.coming(history, &wish([-3.0, 2.0, 0.0], true)))));
        assert!(matches!(note, Some(Note::Came(..))), "{note:?}");
        let history = stage.history();
        let skin = history.skins().last().unwrap();
        assert_eq!((skin.first, &skin.triangles[..]), (first, &[[first, first + 1, first + 2]][..]));
        assert_eq!(skin.texture[..3], [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!((skin.picture.width, skin.picture.height, &skin.picture.rgba), (3, 2, &picture.rgba));
        let tint = |point: u32| *Tint::of(history.tints(), first + point).unwrap();
        let second = Tint::of(&Scene::parse(&text, "x.json").unwrap().tints().unwrap(), 3).unwrap().body;
        assert_eq!(palette_color(tint(3).body), palette_color(second));
        assert_eq!((tint(3).color, tint(6).color), (None, Some([1, 2, 3])));
        let groups = history.groups();
        let copied: Vec<(&str, usize)> = groups
            .iter()
            .filter(|group| group.points[0].0 >= first)
            .map(|group| (group.name.as_str(), group.points.len()))
            .collect();
        let names = [["pair 1", "group 2"], ["pair", "group 1"]][place];
        assert_eq!(copied, [(names[0], 6), (names[1], 2)]);
        // All of it goes with one step of undo, and is the same when it is read from a file.
        let recording = history.recording();
        let mut bytes = Vec::new();
        recording.write_json(&mut bytes).unwrap();
        let again = crate::history::Log::of_text(&String::from_utf8(bytes).unwrap(), "x.json").unwrap();
        assert_eq!(again.commands().unwrap(), recording.commands);
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "duplicate"));
        assert!(stage.history().groups().iter().all(|group| group.points[0].0 < first));
        stage.obey(Order::Redo(None));
        assert!(stage.history().skins().iter().any(|skin| skin.first == first));
    }
}

#[test]
fn copies_of_figures_are_figures_in_the_same_colours_here_in_other_scenes_and_in_what_is_saved() {
    let text = r#"{"wobble": 1, "bodies": [{"make": "rope", "count": 3, "spacing": 0.2}, {"make": "ragdoll", "origin": [0, 1]},
        {"make": "ragdoll", "origin": [2, 1]}], "bonds": [], "contact": true}"#;
    let mut own = stage(text);
    let count = own.history().world().point_count() as u32;
    let body = |stage: &Stage, point: u32| Tint::of(stage.history().tints(), point).unwrap().body;
    let known = |history: &History, point: u32| {
        let tint = Tint::of(history.tints(), point).unwrap();
        (history.body_names()[tint.body as usize].clone(), palette_color(tint.body), tint.color)
    };
    let was: Vec<_> = (0..count).map(|point| known(own.history(), point)).collect();
    assert_eq!([0, 3, count - 1].map(|point| was[point as usize].0.as_deref()), ["rope", "figure", "figure"].map(Some));
    let clip = Clip::of(own.history(), &points(0..count));
    let read = Fragment::parse(&clip.fragment().to_text().unwrap()).unwrap();
    assert_eq!(Clip::of_fragment(read), clip);
    let mut other = stage(r#"{"wobble": 1, "points": {"position": [[0,-9]]}}"#);
    for stage in [&mut own, &mut other] {
        for again in 0..3 {
            let first = stage.history().world().point_count() as u32;
            let clip = clip.clone();
            let wish = wish([-3.0, 2.0 * f64::from(again), 0.0], true);
            let note = stage.obey(Order::Add(Box::new(move |history| clip.coming(history, &wish))));
            assert!(matches!(note, Some(Note::Came(..))), "{note:?}");
            let is: Vec<_> = (first..first + count).map(|point| known(stage.history(), point)).collect();
            assert_eq!(is, was, "copy {again}");
            // All points of one are one body, and two figures are two.
            let bodies = [3, 38, 39].map(|point| body(stage, first + point));
            assert!(bodies[0] == bodies[1] && bodies[1] != bodies[2], "{bodies:?}");
        }
    }
    // Something is painted between two copies, too; what is saved has all of it.
    let history = own.history();
    let opened = History::new(history.snapshot().unwrap().into()).unwrap();
    let end = history.world().point_count() as u32;
    let all = |history: &History| (0..end).map(|point| known(history, point)).collect::<Vec<_>>();
    assert_eq!(all(&opened), all(history));
}

#[test]
fn led_pins_of_a_copy_go_the_same_way_from_when_it_comes() {
    let text = r#"{"wobble": 1, "gravity": [0, -9.81], "points": {"position": [[0,0],[0,-1],[1,0]], "pinned": [0,2]},
        "bonds": [{"a":0,"b":1}], "pin_motion": [{"point": 0, "track": [[0,0,0],[1,2,0],[2,2,1]]}, {"point": 2, "track": [[0,1,0]]}]}"#;
    let mut stage = stage(text);
    let run = |stage: &mut Stage, seconds: f64| {
        let end = stage.history().world().time() + seconds;
        while stage.history().world().time() < end - 1e-9 {
            stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
        }
        let now = stage.history().world().time();
        stage.history().world().sample(now)
    };
    run(&mut stage, 0.5);
    let clip = Clip::of(stage.history(), &points(0..3));
    let read = Fragment::parse(&clip.fragment().to_text().unwrap()).unwrap();
    assert_eq!(Clip::of_fragment(read), clip);
    // What its track has done stands.
    assert_eq!(clip.keys.pin_motion.iter().map(|way| way.point).collect::<Vec<_>>(), [0]);
    let (came, _) = put(&mut stage, &points(0..3), wish([0.0, 2.0, 0.0], true)).unwrap();
    let first = came.points[0].index();
    for _ in 0..4 {
        let now = run(&mut stage, 0.4);
        for k in 0..3 {
            let apart = glam::DVec3::from(now.position[first + k]) - glam::DVec3::from(now.position[k]);
            assert!(apart.distance(glam::DVec3::new(0.0, 2.0, 0.0)) < 1e-9, "point {k}: {apart}");
        }
    }
    // Later it goes what was left when it was copied: 1 m to the right, then up.
    stage.obey(Order::Add(Box::new(move |history| clip.coming(history, &wish([0.0, -2.5, 0.0], true)))));
    let now = run(&mut stage, 0.25);
    let led = now.position[first + 3];
    assert!((led[0] - 1.5).abs() < 0.02 && (led[1] + 2.5).abs() < 1e-9, "{led:?}");
    let now = run(&mut stage, 1.5);
    let led = now.position[first + 3];
    assert!((led[0] - 2.0).abs() < 1e-9 && (led[1] + 1.5).abs() < 1e-9, "{led:?}");
}
