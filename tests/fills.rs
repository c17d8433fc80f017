//! Fills of bodies: colours, what lies on what, what is torn, strain; and that colours stay with their bodies.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod worn;

use crate::common;

use common::picture::{SIDE, between, bond, pixels, plain, view};
use glam::DVec2;
use image::RgbaImage;
use wobble::history::{Replay, Start};
use wobble::picture::Tint;
use wobble::render::{Camera, Capture, Look, Overlay, Pose, RenderCounters, View};
use wobble::scene::Scene;
use wobble::sim::{Bond, BondKind, Bonds, PointId};

/// Two squares of 20 px that overlap, of two triangles each.
const PLACES: [f32; 16] = [-20., -10., 0., -10., 0., 10., -20., 10., -5., -10., 15., -10., 15., 10., -5., 10.];

fn triangles() -> Vec<[PointId; 3]> {
    [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]].map(|corners: [u32; 3]| corners.map(PointId)).to_vec()
}

fn sides() -> Bonds {
    let square = |first: u32| (0..4).map(move |k| [first + k, first + (k + 1) % 4]).chain([[first, first + 2]]);
    let length = |[a, b]: [u32; 2]| {
        let at = |point: u32| DVec2::new(PLACES[2 * point as usize].into(), PLACES[2 * point as usize + 1].into());
        at(a).distance(at(b))
    };
    [0, 4]
        .into_iter()
        .flat_map(square)
        .map(|ends| Bond { rest_length: length(ends), ..bond(ends[0], ends[1]) })
        .collect()
}

fn look() -> Look {
    Look { has_mesh: false, ..plain() }
}

/// The pixel at a place counted from the middle of the picture [px, y up].
fn at(picture: &RgbaImage, x: f64, y: f64) -> [u8; 3] {
    let middle = 0.5 * f64::from(SIDE);
    let [r, g, b, _] = picture.get_pixel((middle + x) as u32, (middle - y) as u32).0;
    [r, g, b]
}

#[test]
fn bodies_have_colours_of_their_own_and_lie_over_those_before_them_until_they_are_torn() {
    if common::gpu().is_none() {
        return;
    }
    let (bonds, triangles) = (sides(), triangles());
    let tints = [[200, 0, 0], [0, 200, 0]]
        .map(|color| Tint { color: Some(color.map(|c| c as u8)), ..Tint::new(color[1] / 50, color[1] / 200) });
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let seen = View { triangles: &triangles, tints: &tints, ..view(&PLACES, &bonds, 2) };
    let picture = capture.picture(&seen, &pixels(), &look()).unwrap();
    let is_near = |seen: [u8; 3], expected: [u8; 3]| seen.iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 26);
    assert!(is_near(at(&picture, -14.0, 4.0), [200, 0, 0]), "{:?}", at(&picture, -14.0, 4.0));
    assert!(is_near(at(&picture, 10.0, -5.0), [0, 200, 0]), "{:?}", at(&picture, 10.0, -5.0));
    assert!(is_near(at(&picture, -3.0, 2.0), [0, 200, 0]), "the later one lies on top: {:?}", at(&picture, -3.0, 2.0));
    let [red, ..] = at(&picture, -7.0, 2.0);
    assert!((25..165).contains(&red), "with its shadow on the one below: {red}");
    assert_eq!(at(&picture, -28.0, 24.0), [0; 3], "and nothing elsewhere");
    assert!(is_near(at(&picture, 4.0, 5.0), [0, 200, 0]), "{:?}", at(&picture, 4.0, 5.0));
    let torn = View { triangles: &triangles[..3], topology: 1, ..seen.clone() };
    let picture = capture.picture(&torn, &pixels(), &look()).unwrap();
    assert_eq!(at(&picture, 4.0, 5.0), [0; 3], "what is torn has no fill");
    assert!(is_near(at(&picture, 10.0, -5.0), [0, 200, 0]), "and the rest has");
    let bonds_alone = Look { has_fills: false, ..look() };
    let picture = capture.picture(&torn, &pixels(), &bonds_alone).unwrap();
    assert_eq!((at(&picture, -14.0, 4.0), at(&picture, -10.0, 10.0)), ([0; 3], [200, 0, 0]), "bonds alone");
}

#[test]
fn a_shadow_is_light_on_a_light_ground_and_fades_evenly_and_round_about_corners() {
    if common::gpu().is_none() {
        return;
    }
    let places = [-8., -8., 8., -8., 8., 8., -8., 8.];
    let (bonds, triangles) = (Bonds::default(), [[0, 1, 2], [0, 2, 3]].map(|corners: [u32; 3]| corners.map(PointId)));
    let tints = [Tint { color: Some([200, 0, 0]), ..Tint::new(0, 0) }];
    let seen = View { triangles: &triangles, tints: &tints, ..view(&places, &bonds, 2) };
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let picture = capture.picture(&seen, &pixels(), &Look { ground: [1.0; 4], ..look() }).unwrap();
    let below: Vec<u8> = (11..30).map(|y| at(&picture, 0.0, -f64::from(y))[1]).collect();
    assert!((200..246).contains(&below[0]) && below[18] == 255, "{below:?}");
    let steps = below.array_windows().map(|[near, far]| i32::from(*far) - i32::from(*near));
    assert!(steps.clone().all(|step| (0..7).contains(&step)), "without bands: {below:?}");
    // As far from the corner of what the shadow is of, which lies a little lower than the body, as from its lower side.
    let [straight, diagonal] = [[0.0, -16.25], [12.24, -14.49]].map(|[x, y]| at(&picture, x, y)[1]);
    assert!(straight.abs_diff(diagonal) <= 3, "{straight} {diagonal}");
}

#[test]
fn within_its_rim_a_body_is_of_its_colour_and_shows_no_bonds_however_large_it_is_until_strain_is_shown() {
    if common::gpu().is_none() {
        return;
    }
    let places = [-28., -28., 28., -28., 28., 28., -28., 28.];
    let ends = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]];
    let long = |[a, b]: [u32; 2]| if (a + b) % 2 == 0 { 56.0 * 2_f64.sqrt() } else { 56.0 };
    let bonds: Bonds = ends.iter().map(|&ends| Bond { rest_length: long(ends), ..bond(ends[0], ends[1]) }).collect();
    let triangles = [[0, 1, 2], [0, 2, 3]].map(|corners: [u32; 3]| corners.map(PointId));
    let tints = [Tint { color: Some([47, 158, 91]), ..Tint::new(0, 0) }];
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let seen = View { triangles: &triangles, tints: &tints, ..view(&places, &bonds, 2) };
    let mut inside = |look: &Look| {
        let picture = capture.picture(&seen, &pixels(), look).unwrap();
        let places = (-20..20).flat_map(|y| (-20..20).map(move |x| [f64::from(x), f64::from(y)]));
        let mut colors: Vec<[u8; 3]> = places.map(|[x, y]| at(&picture, x, y)).collect();
        colors.sort_unstable();
        colors.dedup();
        colors
    };
    let plain = inside(&look());
    assert!(plain.len() == 1 && plain[0].iter().zip([47, 158, 91]).all(|(a, b)| a.abs_diff(b) <= 1), "{plain:?}");
    let strain = inside(&Look { overlay: Overlay::Strain, ..look() });
    assert!(strain.len() > 1, "beside colours of strain the bonds are seen: {strain:?}");
}

#[test]
fn bodies_lie_over_the_numbers_of_the_grid() {
    if common::gpu().is_none() {
        return;
    }
    let (size, triangles) = ([320, 240], [[0, 1, 2], [0, 2, 3]].map(|corners: [u32; 3]| corners.map(PointId)));
    let places = [-150., -119., 150., -119., 150., -80., -150., -80.];
    let (bonds, tints) = (Bonds::default(), [Tint { color: Some([0, 200, 0]), ..Tint::new(0, 0) }]);
    let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 240.0 }, size);
    let mut capture = Capture::new(size, 2).unwrap();
    let mut picture = |triangles: &[[PointId; 3]], number: [f32; 4], topology: u64| {
        let seen = View { triangles, tints: &tints, topology, ..view(&places, &bonds, 2) };
        capture.picture(&seen, &camera, &Look { number, point: [0.0; 4], ..look() }).unwrap()
    };
    let (white, clear) = ([1.0; 4], [0.0; 4]);
    let [with, without] = [white, clear].map(|number| picture(&triangles, number, 0));
    let [bare, empty] = [white, clear].map(|number| picture(&[], number, 1));
    // Within the body, but for its rim.
    let differ = |a: &RgbaImage, b: &RgbaImage, is_within: bool| {
        let lies = |x: u32, y: u32| (15..305).contains(&x) && (205..235).contains(&y);
        a.enumerate_pixels().filter(|(x, y, pixel)| lies(*x, *y) == is_within && b.get_pixel(*x, *y) != *pixel).count()
    };
    assert!(differ(&bare, &empty, true) > 50, "numbers stand there");
    assert_eq!(differ(&with, &without, true), 0, "the body is over them");
    assert!(differ(&with, &without, false) > 50, "and beside it they are seen");
}

#[test]
fn a_percent_of_strain_is_seen_on_fills_and_a_still_body_uploads_nothing() {
    if common::gpu().is_none() {
        return;
    }
    let triangles = triangles();
    let colors = between([0.0, 0.0, 1.0, 1.0], [0.0, 1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]);
    let look = Look { overlay: Overlay::Strain, strain: colors, ..look() };
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let shown = |capture: &mut Capture, bonds: &Bonds, change: u64| -> ([u8; 3], RenderCounters) {
        let seen = View { triangles: &triangles, motion: change, topology: change, ..view(&PLACES, bonds, 2) };
        let picture = capture.picture(&seen, &pixels(), &look).unwrap();
        (at(&picture, 10.0, -5.0), *capture.renderer().counters())
    };
    for (change, strain) in [0.01, -0.01, 0.1, -0.3].into_iter().enumerate() {
        let bonds: Bonds =
            sides().iter().map(|bond| Bond { rest_length: bond.rest_length / (1.0 + strain), ..bond }).collect();
        let (seen, first) = shown(&mut capture, &bonds, change as u64);
        let share = ((strain.abs() / 0.005).asinh() / 60_f64.asinh()).min(1.0);
        let expected = if strain > 0.0 { [share, 1.0 - share, 0.0] } else { [0.0, 1.0 - share, share] };
        // Sides of triangles darken by a sixth at most.
        for (seen, expected) in seen.iter().zip(expected) {
            let expected = 255.0 * expected;
            assert!(
                (0.83 * expected - 2.0..=expected + 2.0).contains(&f64::from(*seen)),
                "{strain}: {seen} {expected}"
            );
        }
        assert!(share > 0.29, "a percent is no less than that");
        let (_, second) = shown(&mut capture, &bonds, change as u64);
        assert_eq!(second, first, "a still body is not drawn again");
    }
}

#[test]
fn what_is_hidden_is_not_drawn_until_it_is_shown_again() {
    if common::gpu().is_none() {
        return;
    }
    let (bonds, triangles) = (sides(), triangles());
    let pinned = [PointId(0), PointId(6)];
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    // Of the same topology: what changes is how bodies are drawn.
    let mut shown = |hides: [bool; 2], look: &Look| {
        let tints = [0, 1].map(|k| Tint {
            color: Some([200 - 200 * k as u8, 200 * k as u8, 0]),
            is_hidden: hides[k as usize],
            ..Tint::new(4 * k, k)
        });
        let seen = View { triangles: &triangles, tints: &tints, pinned: &pinned, ..view(&PLACES, &bonds, 2) };
        let picture = capture.picture(&seen, &pixels(), look).unwrap();
        let count = |channel: usize| picture.pixels().filter(|pixel| pixel[channel] > 60).count();
        (count(0), count(1), picture)
    };
    for look in [look(), plain()] {
        let (red, green, before) = shown([false, false], &look);
        let (_, _, none) = shown([true, true], &look);
        assert!(none.pixels().all(|pixel| pixel == none.get_pixel(0, 0)), "nothing is left of either");
        let (left, _, second) = shown([true, false], &look);
        assert!(left < red && second != before && second != none);
        let (_, right, first) = shown([false, true], &look);
        assert!(right < green && first != before && first != second);
        assert!(shown([false, false], &look).2 == before, "to the pixel");
    }
}

#[test]
fn bonds_are_as_wide_as_their_body_says_at_any_height_of_the_picture() {
    if common::gpu().is_none() {
        return;
    }
    let places: [f32; 4] = [0.0, -30.0, 0.0, 30.0];
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    for kind in [BondKind::Rigid, BondKind::Spring { stiffness: 1.0, damping: 0.0 }] {
        let bonds: Bonds = [Bond { kind, rest_length: 60.0, ..bond(0, 1) }].into_iter().collect();
        let mut across = |width: f64, zoom: f64| {
            let tints = [Tint { width, ..Tint::new(0, 0) }];
            let seen = View { tints: &tints, ..view(&places, &bonds, 2) };
            let height = f64::from(SIDE) / zoom;
            let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height }, [SIDE, SIDE]);
            let picture = capture.picture(&seen, &camera, &Look { has_forms: false, ..plain() }).unwrap();
            let row = (0..SIDE).map(|x| f64::from(picture.get_pixel(x, SIDE / 2)[0]));
            row.sum::<f64>() / f64::from(picture.get_pixel(SIDE / 2, SIDE / 2)[0])
        };
        let usual = across(0.0, 1.0);
        assert!(usual < 4.0, "{usual}");
        for (width, zoom) in [(10.0, 1.0), (10.0, 2.0), (6.5, 1.0)] {
            let seen = across(width, zoom);
            assert!((seen - width * zoom).abs() < 0.3, "{width} m at {zoom} px/m: {seen} px");
        }
    }
}

/// Two boxes in a column each, a disc with a colour of its own, a triangle of points.
const COLORED: &str = r##"{"wobble": 1, "points": {"position": [[0, 5], [1, 5], [0, 6]]},
  "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 0}], "triangles": [[0, 1, 2]],
  "bodies": [{"make": "box", "width": 1, "height": 1, "repeat": {"count": [1, 2], "step": [0, 3]}},
             {"make": "disc", "radius": 1, "spacing": 0.5, "origin": [4, 0], "material": {"color": "#FF8800"}}],
  "skins": [{"points": [0, 1, 2], "color": "#102030"}]}"##;

#[test]
fn colours_stay_with_their_bodies_in_files_states_and_edits() {
    let scene = Scene::parse(COLORED, "x.json").unwrap();
    let tints = scene.tints().unwrap();
    let all = |tints: &[Tint]| -> Vec<(u32, Option<[u8; 3]>)> {
        (0..14).map(|point| Tint::of(tints, point).map(|tint| (tint.body, tint.color)).unwrap()).collect()
    };
    let expected = all(&tints);
    assert_eq!(expected[0], (0, Some([0x10, 0x20, 0x30])));
    assert_eq!([expected[3], expected[7]], [(1, None), (2, None)]);
    assert_eq!(expected[12], (3, Some([0xff, 0x88, 0])));
    let again = Scene::parse(&scene.to_json().unwrap(), "y.json").unwrap();
    assert_eq!(again.tints().unwrap(), tints, "written and read");
    assert_eq!(all(&scene.expanded().unwrap().tints().unwrap()), expected, "as points and bonds");

    let added = r##"{"wobble_recording": 1, "scene": SCENE, "commands": [
      {"at": 0, "do": "add", "bodies": [{"make": "box", "width": 1, "height": 1, "origin": [9, 0], "material": {"color": "#00ff00"}}],
       "skins": [{"points": [3, 4, 5, 6], "color": "#0000ff"}]}]}"##;
    let folder = tempfile::tempdir().unwrap();
    let load = |text: &str| {
        let path = folder.path().join("x.json");
        std::fs::write(&path, text).unwrap();
        Start::load(path.to_str().unwrap()).unwrap().recording().clone()
    };
    let recording = load(&added.replace("SCENE", COLORED));
    let mut replay = Replay::new(&recording, "r.json").unwrap();
    replay.advance(&recording.commands, 0.01).unwrap();
    let now = replay.tints().to_vec();
    let last = Tint::of(&now, replay.world().point_count() as u32 - 1).unwrap();
    assert_eq!((last.body, last.color), (4, Some([0, 255, 0])));
    assert_eq!(all(&now)[3], (1, Some([0, 0, 255])), "what was there can be painted");
    let mut text = Vec::new();
    replay.snapshot().unwrap().write_json(&mut text).unwrap();
    let kept = load(&String::from_utf8(text).unwrap());
    assert_eq!(Replay::new(&kept, "s.json").unwrap().tints(), now, "kept and gone on from");
}

#[test]
fn a_colour_that_is_none_is_refused_by_its_place() {
    for wrong in ["orange", "#12345", "#1234567", "123456"] {
        let text = COLORED.replace("#FF8800", wrong);
        let error = Scene::parse(&text, "x.json").unwrap_err().to_string();
        assert!(error.contains("x.json") && error.contains("six hexadecimal digits"), "{error}");
    }
}
