//! Cameras of scenes without a window.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use super::*;

#[test]
fn a_width_is_shown_where_there_is_less_room_and_walls_beyond_it_are_cut_off() {
    let of = |view: &str| {
        let text = r#"{"wobble": 1, "points": {"position": [[-1, 0], [1, 0]]}, "bounds": {"min": [-5, -5], "max": [5, 1]},
            "beside": [{"method": {"solver": "verlet"}}], "view": {"center": [1, -2], "height": 6.4VIEW}}"#;
        Scene::parse(&text.replace("VIEW", view), "x.json").unwrap()
    };
    let heights = |scene: &Scene| {
        let world = scene.world(None).unwrap();
        let seen = View::of(&*world);
        [[1280, 720], [720, 1280]].map(|size| {
            let tiles = tiles((scene, &alone(scene, &seen)), &seen, (2, size), ([0.0; 2], 0.0));
            camera(scene, &seen, tiles.pane(size)).height()
        })
    };
    let (usual, close) = (heights(&of("")), heights(&of(r#", "width": 4"#)));
    assert!(usual[0] > 9.0 && close == [6.4; 2], "{usual:?} {close:?}");
    let narrow = heights(&of(r#", "width": 8"#));
    assert!((narrow[0] - 9.0).abs() < 1e-9, "eight metres in 640 pixels: {narrow:?}");
}

#[test]
fn what_a_view_shows_whole_lies_beside_what_covers_it() {
    let text = r#"{"wobble": 1, "points": {"position": [[-4, -3], [4, 3]]}, "bounds": {"min": [-20, -4], "max": [20, 4]},
        "view": {"center": [0, 0], "height": 8.4}}"#;
    let scene = Scene::parse(text, "x.json").unwrap();
    let world = scene.world(None).unwrap();
    let (view, size) = (View::of(&*world), [1000, 600]);
    let free = [[80.0, 120.0], [990.0, 570.0]];
    let places = |camera: &Camera| {
        [[-4.0, -4.0], [4.0, 4.0]].map(|[x, y]| camera.screen_from_world(DVec3::new(x, y, 0.0)).unwrap())
    };
    let before = places(&camera(&scene, &view, size));
    assert!(before[1][1] < 50.0, "the upper wall lay below the buttons: {before:?}");
    let cleared = clear(camera(&scene, &view, size), &view, free);
    let [low, high] = places(&cleared);
    assert!(low[1] < 570.1 && high[1] > 119.9 && low[0] > 80.0, "{low:?} {high:?}");
    assert!((low[1] - high[1] - 450.0).abs() < 1.0, "no further away than it takes");
    let roomy = [[0.0, 0.0], [1000.0, 600.0]];
    assert_eq!(clear(camera(&scene, &view, size), &view, roomy).pose, camera(&scene, &view, size).pose);
    let fitted = fit_in(&view, free, size);
    let middle = fitted.screen_from_world(DVec3::ZERO).unwrap();
    assert!((middle[0] - 535.0).abs() < 1e-6 && (middle[1] - 345.0).abs() < 1e-6, "{middle:?}");
}

#[test]
fn a_pane_that_gets_lower_shows_what_it_did_as_large_as_there_is_room() {
    let text = r#"{"wobble": 1, "points": {"position": [[-4, -1], [4, 1]]}, "view": {"center": [0, 0], "height": 8}}"#;
    let scene = Scene::parse(text, "x.json").unwrap();
    let world = scene.world(None).unwrap();
    let view = View::of(&*world);
    let own = camera(&scene, &view, [800, 600]);
    let places = |camera: &Camera| {
        [[-4.0, -1.0], [4.0, 1.0]].map(|[x, y]| camera.screen_from_world(DVec3::new(x, y, 0.0)).unwrap())
    };
    let wide = |camera: &Camera| places(camera)[1][0] - places(camera)[0][0];
    let at = |size: [u32; 2], top: f64| narrowed(own, &view, size, [[0.0, top], size.map(f64::from)]);
    let enough = at([800, 400], 60.0);
    assert!((wide(&enough) - wide(&own)).abs() < 1e-6, "there is room for all of it: {:?}", places(&enough));
    assert!(places(&enough)[0][1] <= 400.0 && places(&enough)[1][1] >= 60.0, "{:?}", places(&enough));
    let little = at([800, 200], 80.0);
    assert!(wide(&little) < wide(&own) && places(&little)[0][1] <= 200.0, "{:?}", places(&little));
    let more = at([900, 700], 100.0);
    assert_eq!(
        places(&more).map(|at| at.map(f64::round)),
        places(&own).map(|at| at.map(f64::round)),
        "room moves nothing"
    );
}

#[test]
fn in_a_picture_higher_than_wide_a_scene_is_as_large_as_its_width_lets_it_and_in_the_middle() {
    let at = |width: f64| {
        let text = format!(
            r#"{{"wobble": 1, "points": {{"position": [[-{width}, 1], [{width}, 3]]}},
            "view": {{"center": [0, 0], "height": 8}}}}"#
        );
        let scene = Scene::parse(&text, "x.json").unwrap();
        let world = scene.world(None).unwrap();
        let view = View::of(&*world);
        let camera = clear(camera(&scene, &view, [600, 1000]), &view, [[60.0, 100.0], [590.0, 980.0]]);
        [[-width, 1.0], [width, 3.0]].map(|[x, y]| camera.screen_from_world(DVec3::new(x, y, 0.0)).unwrap())
    };
    let [low, high] = at(4.0);
    assert!(high[0] - low[0] > 500.0, "{low:?} {high:?}");
    assert!((low[1] + high[1] - 1080.0).abs() < 1e-6, "{low:?} {high:?}");
    let [low, high] = at(0.5);
    assert!((high[0] - low[0] - 100.0).abs() < 1.0, "as large as its view makes it: {low:?} {high:?}");
}

#[test]
fn a_thumbnail_has_all_points_however_narrow_its_view_is() {
    let plane = r#"{"wobble": 1, "points": {"position": [[-4, -3], [4, 9]]}, "view": {"center": [0, 0], "height": 4}}"#;
    let space = r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[-3, 0, 0], [3, 1, 2], [0, 4, 0]]},
        "view": {"target": [0, 0, 0], "distance": 3}}"#;
    let (size, free) = ([432, 270], [[13.0, 13.0], [419.0, 257.0]]);
    for text in [plane, space] {
        let scene = Scene::parse(text, "x.json").unwrap();
        let world = scene.world(None).unwrap();
        let view = View::of(&*world);
        let [low, high] = on_screen(&whole(camera(&scene, &view, size), &view, free), &view);
        for axis in 0..2 {
            assert!(low[axis] > free[0][axis] - 1.0 && high[axis] < free[1][axis] + 1.0, "{low:?} {high:?}");
        }
    }
    let scene = Scene::parse(&plane.replace("4}", "40}"), "x.json").unwrap();
    let world = scene.world(None).unwrap();
    let view = View::of(&*world);
    let opened = camera(&scene, &view, size);
    assert_eq!(whole(opened, &view, free).pose, opened.pose, "what shows all of it stays");
}

#[test]
fn in_space_what_a_narrower_picture_would_cut_off_is_seen_from_further_away() {
    let text = r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[-3, 0, 0], [3, 1, 2], [0, 4, 0]]},
        "obstacles": [{"circle": {"center": [-3, -1, 0], "radius": 1}}], "view": {"target": [0, 1, 0], "distance": 9}}"#;
    let scene = Scene::parse(text, "x.json").unwrap();
    let world = scene.world(None).unwrap();
    let view = View::of(&*world);
    let distance = |camera: Camera| match camera.pose {
        Pose::Orbit { distance, .. } => distance,
        Pose::Plane { .. } => 0.0,
    };
    assert_eq!(distance(camera(&scene, &view, [1600, 900])), 9.0, "as it is made for");
    for [width, height] in [[600, 1000], [700, 700]] {
        let narrow = camera(&scene, &view, [width, height]);
        let [low, high] = on_screen(&narrow, &view);
        assert!(
            distance(narrow) >= if width < 700 { 9.1 } else { 9.0 } && low[0] > 0.0 && high[0] < f64::from(width),
            "{low:?} {high:?}"
        );
    }
    let free = [[76.0, 60.0], [870.0, 650.0]];
    let [low, high] = on_screen(&opened(&scene, &view, [1280, 676], (free, Over::default())), &view);
    assert!((0..2).all(|axis| low[axis] > free[0][axis] - 1.0 && high[axis] < free[1][axis] + 1.0), "{low:?} {high:?}");
}

#[test]
fn in_space_what_drops_from_above_the_target_to_as_far_below_it_stays_in_the_picture() {
    let text = r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[-5, 0, 0], [5, 0, 0], [-5, 10, 0], [5, 10, 0]]},
        "view": {"target": [0, -4, 0], "distance": 44, "yaw": 0.5, "pitch": 0.15}}"#;
    let scene = Scene::parse(text, "x.json").unwrap();
    let world = scene.world(None).unwrap();
    let (view, size, free) = (View::of(&*world), [640, 676], [[76.0, 236.0], [630.0, 650.0]]);
    let at = |camera: &Camera, y: f64| camera.screen_from_world(DVec3::new(0.0, y, 0.0)).unwrap()[1];
    let start = whole(camera(&scene, &view, size), &view, free);
    assert!(at(&start, -18.0) > 650.0, "led by its start alone it drops out of the picture: {}", at(&start, -18.0));
    let opened = opened(&scene, &view, size, (free, Over::default()));
    assert!(at(&opened, 10.0) > 235.0 && at(&opened, -17.5) < 651.0, "{} {}", at(&opened, 10.0), at(&opened, -17.5));
    let distance = opened.distance();
    assert!((44.0..80.0).contains(&distance), "no further away than that takes: {distance} m");
}

#[test]
fn what_is_driven_stays_in_the_middle_of_the_view() {
    let mut camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 10.0 }, [1000, 500]);
    let at = |x: f64| [DVec3::new(x, 0.0, 0.0)].into_iter();
    assert!(!follow(&mut camera, at(3.9)), "two fifths of 20 m are 4 m to both sides");
    assert!(follow(&mut camera, at(6.0)));
    let [x, y] = camera.screen_from_world(DVec3::new(6.0, 0.0, 0.0)).unwrap();
    assert!((x - 700.0).abs() < 1e-9 && (y - 250.0).abs() < 1e-9, "{x} {y} px");
    assert!(!follow(&mut camera, [].into_iter()) && !follow(&mut camera, at(f64::NAN)));
    let of_two = [f64::NAN, 7.0].map(|x| DVec3::new(x, 0.0, 0.0));
    assert!(follow(&mut camera, of_two.into_iter()), "one of them is gone");
}

#[test]
fn what_crawls_stays_in_a_view_that_follows_it() {
    let scene = crate::scene::gallery().iter().find(|entry| entry.name == "snake").unwrap().scene().unwrap();
    let mut world = scene.world(None).unwrap();
    let mut own = camera(&scene, &View::of(&*world), USUAL);
    let opened = own;
    let is_whole = |camera: &Camera, world: &dyn crate::sim::Dynamics| {
        let [low, high] = on_screen(camera, &View::of(world));
        (0..2).all(|axis| low[axis] > 0.0 && high[axis] < f64::from(USUAL[axis]))
    };
    while world.time() < 16.0 {
        let place = |point: &u32| [0, 1].map(|axis| world.positions().get(2 * *point as usize + axis));
        let places = followed(&scene, &View::of(&*world), USUAL);
        let places = places.points.iter().map(place).map(|[x, y]| DVec3::new(x, y, 0.0));
        let has_moved = follow(&mut own, places);
        assert!(!has_moved || world.time() > 2.0, "what the view shows at first stays a while");
        assert!(is_whole(&own, &*world), "after {} s", world.time());
        world.step();
    }
    assert!(!is_whole(&opened, &*world), "it is far from where it began");
    assert_eq!(own.height(), opened.height());
}

#[test]
fn a_camera_that_was_saved_is_the_same_again() {
    let plane = r#"{"wobble": 1, "points": {"position": [[-9, 0], [9, 0]]}}"#;
    let space = r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[0, 0, 0], [1, 0, 2]]}}"#;
    for (text, size) in [(plane, [700, 900]), (plane, [1000, 400]), (space, [800, 600])] {
        let world = Scene::parse(text, "x.json").unwrap().world(None).unwrap();
        let mut camera = fit(&View::of(&*world), true, size);
        camera.pan([33.0, -20.0]);
        camera.zoom_at([200.0, 100.0], 1.7);
        assert_eq!(saved(&keys(&camera), &View::of(&*world), size).pose, camera.pose, "{size:?}");
    }
}
