//! Pictures: from a file to a body, a scene, a skin.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod firm;

use crate::common;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Arc;

use wobble::picture::{Picture, Settings, Size, Tint, Watch, encode, mesh_picture};
use wobble::render::{Camera, Capture, Look, View};
use wobble::scene::{BodyKeys, BudgetKeys, Matter, Meeting, PatternName, Scene, Vector, gallery};
use wobble::sim::{Bond, Bonds, PointId};

fn wobble(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_wobble")).args(arguments).output().unwrap()
}

/// What the program says on its one line of error.
fn complaint(arguments: &[&str]) -> String {
    let done = wobble(arguments);
    let said = String::from_utf8(done.stderr).unwrap();
    assert_eq!((done.status.code(), said.lines().count()), (Some(1), 1), "{said}");
    said
}

/// A picture of ink where `is_ink` of the pixels' centres, in one colour.
fn picture([width, height]: [u32; 2], colour: [u8; 3], is_ink: impl Fn(f64, f64) -> bool) -> Picture {
    let mut picture = Picture::filled(width, height, [colour[0], colour[1], colour[2], 0]);
    for i in 0..(width * height) as usize {
        let [x, y] = [i as u32 % width, i as u32 / width].map(|at| f64::from(at) + 0.5);
        picture.rgba[4 * i + 3] = if is_ink(x, y) { 255 } else { 0 };
    }
    picture
}

fn saved(folder: &Path, name: &str, picture: &Picture) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, encode(picture).unwrap()).unwrap();
    path
}

/// A bar of 0.4 m by 1.6 m at this spacing, hung by its upper edge, of Young's modulus 1,000 N/m and 0.2 kg.
fn bar(folder: &Path, spacing: f64) -> Scene {
    let ink = picture([100, 200], [0; 3], |x, y| (x - 50.0).abs() < 20.0 && (y - 100.0).abs() < 80.0);
    let path = saved(folder, "bar.png", &ink);
    let mut material = Matter::Soft.material(Some(1e3));
    material.mass = Some(0.2);
    let settings = Settings { size: Size::Spacing(spacing), ..Settings::default() };
    let keys = BodyKeys { material: Some(material), ..BodyKeys::cut(&settings, 2.0, &ink) };
    let mut scene = Scene::of_picture(&path, keys, Matter::Soft).unwrap();
    (scene.bounds, scene.mouse) = (None, None);
    let start = scene.world(None).unwrap().sample(0.0);
    let upper = (0..start.position.len() as u32).filter(|&i| start.position[i as usize][1] > 0.8 - 1e-3);
    scene.bodies[0].pinned = upper.collect();
    scene
}

/// The closed form of a bar that hangs: it is longer by density g length^2/(2 E).
#[test]
fn a_picture_is_as_soft_at_any_spacing_and_as_youngs_modulus_says() {
    let folder = tempfile::tempdir().unwrap();
    let truth = 0.2 / (0.4 * 1.6) * 9.81 * 1.6 * 1.6 / 2e3;
    for spacing in [4.0, 7.0, 12.0] {
        let scene = bar(folder.path(), spacing);
        let lowest = |positions: &[[f64; 3]]| positions.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
        let start = lowest(&scene.world(None).unwrap().sample(0.0).position);
        let settled = wobble::study::settle(&scene, 1.0).unwrap();
        let sag = start - lowest(&settled.sample.position);
        assert!(settled.is_settled && (sag - truth).abs() < 0.3 * truth, "{sag} m at {spacing} px for {truth} m");
    }
}

/// Without a damping of its own the slowest wobble is damped alike, in meshes that are not so fine that the fastest one sets the bound.
#[test]
fn a_picture_is_damped_alike_at_any_spacing() {
    let folder = tempfile::tempdir().unwrap();
    let left = [13.0, 17.0].map(|spacing| {
        let scene = bar(folder.path(), spacing);
        let mut world = scene.world(None).unwrap();
        let rest = wobble::study::settle(&scene, 1.0).unwrap().sample.energy;
        let start = world.sample(0.0).energy - rest;
        while world.time() < 0.5 {
            world.step();
        }
        (world.sample(world.time()).energy - rest) / start
    });
    assert!(left[0] > 0.0 && left[0] < 0.6, "{left:?}");
    assert!((left[0] / left[1] - 1.0).abs() < 0.4, "{left:?}");
}

#[test]
fn a_scene_of_a_picture_runs_bit_for_bit_as_its_mesh_written_out() {
    let folder = tempfile::tempdir().unwrap();
    let gear = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/pictures/gear.png");
    for extra in [&["--link"][..], &[]] {
        let out = folder.path().join("gear.json");
        let arguments = ["mesh", gear.to_str().unwrap(), "--spacing", "24", "--out", out.to_str().unwrap()];
        let done = wobble(&[&arguments[..], extra].concat());
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        let scene = Scene::read(&out).unwrap();
        let (mut sides, triangles) = (std::collections::BTreeSet::new(), &scene.triangles);
        for corners in triangles {
            let [a, b, c] = corners.0;
            sides.extend([[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)]));
        }
        let bonds: Vec<[u32; 2]> = scene.world(None).unwrap().bonds().iter().map(|bond| [bond.a.0, bond.b.0]).collect();
        assert_eq!(bonds, sides.into_iter().collect::<Vec<_>>(), "bonds are the unique sides");
        let texture = scene.texture.as_ref().unwrap();
        assert_eq!(texture.image.starts_with("data:"), extra.is_empty());
        assert_eq!(texture.uv.len(), scene.points.as_ref().unwrap().position.len());
        let skins = scene.skins().unwrap();
        assert_eq!((skins.len(), skins[0].triangles.len()), (1, triangles.len()));

        let settings = Settings { size: Size::Spacing(24.0), ..Settings::default() };
        let keys = BodyKeys::cut(&settings, 2.0, &Scene::picture_file(&gear).unwrap());
        let own = Scene::of_picture(&gear, keys, Matter::Soft).unwrap();
        let run = |scene: &Scene| {
            let mut world = scene.world(None).unwrap();
            while world.time() < 0.4 {
                world.step();
            }
            world.sample(world.time())
        };
        assert!(run(&own) == run(&scene));
    }
}

#[test]
fn measures_are_all_that_is_printed_and_are_right() {
    let folder = tempfile::tempdir().unwrap();
    let ink = picture([300, 200], [0; 3], |x, y| {
        let ring = (x - 100.0).hypot(y - 100.0);
        (40.0..80.0).contains(&ring) || (x - 240.0).hypot(y - 100.0) < 40.0
    });
    let path = saved(folder.path(), "two.png", &ink);
    let preview = folder.path().join("preview.png");
    let preview = preview.to_str().unwrap();
    let done = wobble(&["mesh", path.to_str().unwrap(), "--spacing", "10", "--stats", "--preview", preview]);
    let stats: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    let number = |key: &str| stats[key].as_f64().unwrap_or_else(|| panic!("{key} in {stats}"));
    assert_eq!((number("components"), number("holes")), (2.0, 1.0));
    let area = std::f64::consts::PI * (80.0_f64.powi(2) - 40.0_f64.powi(2) + 40.0_f64.powi(2));
    assert!((number("area_px") / area - 1.0).abs() < 5e-3 && number("area_error") < 1e-3, "{stats}");
    assert!(number("min_angle_deg") > 30.0 && number("p1_angle_deg") > 40.0, "{stats}");
    assert!(number("edge_cv") < 0.15 && number("boundary_deviation_px") < 1.5, "{stats}");
    assert!(number("points") > 100.0 && number("triangles") > 100.0 && number("bonds") > number("points"));
    assert!(number("ink_px") > 0.0 && stats["ms"]["total"].as_f64().unwrap() > 0.0);
    assert!(image::open(preview).unwrap().width() >= 600);
}

#[test]
fn what_is_no_picture_is_refused_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let whole = encode(&picture([64, 64], [0; 3], |x, _| x < 30.0)).unwrap();
    let clear = encode(&picture([64, 64], [0; 3], |_, _| false)).unwrap();
    let mut wide = whole.clone();
    wide[16..20].copy_from_slice(&30_000_u32.to_be_bytes());
    for (name, bytes, said) in [
        ("text.png", &b"hello"[..], "not a picture of a known format"),
        ("empty.png", &b""[..], "not a picture of a known format"),
        ("cut.png", &whole[..60], "cannot be read"),
        ("clear.png", &clear[..], "there is nothing in the picture"),
        ("wide.png", &wide[..], ""),
    ] {
        let error = complaint(&["mesh", &at(name, bytes), "--stats"]);
        assert!(error.contains(said) && error.contains(name), "{error}");
    }
    let whole = at("whole.jpg", &whole);
    assert!(wobble(&["mesh", &whole, "--stats"]).status.success(), "told by its content");
    assert!(complaint(&["mesh", &whole, "--spacing", "0.01"]).contains("it must be from 1 to 4096 px"));
    assert!(complaint(&["mesh", &whole, "--min-area", "99999"]).contains("lower min_area"));
    let error = complaint(&["mesh", &whole, "--height", "1e300", "--out", &at("x.json", b"")]);
    assert!(error.contains("too large for a number") && !error.contains("bodies"), "{error}");
    assert!(
        complaint(&["render", &at("text.png", b"hello"), "--out", "x.png"]).contains("not a picture of a known format")
    );
    assert!(
        complaint(&["simulate", &at("t.png", b"GIF89a"), "--samples", "1", "--out", "x.json"])
            .contains("cannot be read")
    );
}

#[test]
fn the_pictures_of_the_gallery_have_skins_of_all_their_triangles() {
    let mut seen = 0;
    for entry in gallery().iter().filter(|entry| entry.json.contains("\"picture\"")) {
        let scene = entry.scene().unwrap();
        let skins = scene.skins().unwrap();
        let pictures = scene.bodies.iter().filter(|body| body.file.is_some());
        assert_eq!(skins.len(), pictures.count(), "{}", entry.name);
        for skin in &skins {
            let last = skin.first + skin.texture.len() as u32;
            assert!(skin.triangles.iter().flatten().all(|&k| (skin.first..last).contains(&k)), "{}", entry.name);
            assert!(skin.texture.iter().flatten().all(|at| (0.0..=1.0).contains(at)), "{}", entry.name);
        }
        seen += 1;
    }
    assert_eq!(seen, 11);
}

/// A square of one colour fills the middle of the picture with it, opens where a bond is missing, and a still one costs nothing.
#[test]
fn a_skin_shows_its_picture_and_opens_where_it_is_torn() {
    if common::gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let colour = [200, 60, 30];
    let square = picture([64, 64], colour, |x, y| (x - 32.0).abs() < 24.0 && (y - 32.0).abs() < 24.0);
    let path = saved(folder.path(), "square.png", &square);
    let settings = Settings { size: Size::Spacing(8.0), ..Settings::default() };
    let keys = BodyKeys::cut(&settings, 2.0, &square);
    let scene = Scene::of_picture(&path, keys, Matter::Soft).unwrap();
    let (world, skins) = (scene.world(None).unwrap(), scene.skins().unwrap());
    let mut capture = Capture::new([200, 200], 2).unwrap();
    let camera = Camera::fit([[-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]], 2, [200, 200]);
    let look = Look::default();
    let view = View { skins: &skins, ..View::of(&*world) };
    let shown = capture.picture(&view, &camera, &look).unwrap();
    let near = |pixel: &image::Rgba<u8>| (0..3).all(|k| pixel.0[k].abs_diff(colour[k]) <= 2);
    let inside = shown.enumerate_pixels().filter(|(x, y, _)| x.abs_diff(100) < 60 && y.abs_diff(100) < 60);
    assert!(inside.clone().count() > 10_000 && inside.clone().all(|(.., pixel)| near(pixel)));
    assert!(!near(shown.get_pixel(5, 5)));
    let (drawn, all) = (capture.renderer().counters().triangles_drawn, skins[0].triangles.len() as u64);
    let before = *capture.renderer().counters();
    capture.picture(&view, &camera, &look).unwrap();
    assert_eq!((drawn, *capture.renderer().counters()), (all, before), "still");

    // A bond in the middle is gone, and with it the two triangles that it was a side of.
    let middle = |bond: &Bond| {
        let at = |k: usize, end: u32| world.positions().get(2 * end as usize + k);
        (0..2).map(|k| (0.5 * (at(k, bond.a.0) + at(k, bond.b.0))).powi(2)).sum::<f64>()
    };
    let torn = world.bonds().iter().min_by(|a, b| middle(a).total_cmp(&middle(b))).unwrap();
    let bonds = world.bonds().iter().filter(|bond| (bond.a, bond.b) != (torn.a, torn.b)).collect();
    let view = View { bonds: &bonds, topology: 1, ..view };
    let open = capture.picture(&view, &camera, &look).unwrap();
    assert_eq!(capture.renderer().counters().triangles_drawn - drawn, all - 2);
    let hole =
        open.enumerate_pixels().filter(|(x, y, pixel)| x.abs_diff(100) < 60 && y.abs_diff(100) < 60 && !near(pixel));
    assert!(hole.count() > 100);
}

/// Of a square that is cut upright through its middle each half ends in an edge as straight as its mesh: neither teeth are seen nor what is left of bonds
/// between them, whether its bonds that tore are known or, as of a copy, not.
#[test]
fn a_cut_through_a_picture_has_straight_edges() {
    if common::gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let colour = [200, 60, 30];
    let square = picture([128, 128], colour, |x, y| (x - 64.0).abs() < 48.0 && (y - 64.0).abs() < 48.0);
    let path = saved(folder.path(), "square.png", &square);
    let settings = Settings { size: Size::Spacing(12.0), ..Settings::default() };
    let keys = BodyKeys { pattern: Some(PatternName::Braced), ..BodyKeys::cut(&settings, 2.0, &square) };
    let scene = Scene::of_picture(&path, keys, Matter::Soft).unwrap();
    let (world, skins) = (scene.world(None).unwrap(), scene.skins().unwrap());
    let at = |end: PointId| [0, 1].map(|axis| world.positions().get(2 * end.index() + axis));
    // Rows of the mesh lie along x, so that an upright stroke leaves a tooth in each.
    let is_cut = |bond: &Bond| (at(bond.a)[0] < 0.02) != (at(bond.b)[0] < 0.02);
    let (torn, kept): (Vec<Bond>, Vec<Bond>) = world.bonds().iter().partition(is_cut);
    let bonds: Bonds = kept.into_iter().collect();
    let mut capture = Capture::new([400, 400], 2).unwrap();
    let camera = Camera::fit([[-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]], 2, [400, 400]);
    let look = Look { has_grid: false, ..Look::default() };
    for (topology, torn) in [(1, &torn[..]), (2, &[])] {
        let view = View { bonds: &bonds, torn, topology, skins: &skins, ..View::of(&*world) };
        let shown = capture.picture(&view, &camera, &look).unwrap();
        let is_ink = |x: u32, y: u32| (0..3).all(|k| shown.get_pixel(x, y).0[k].abs_diff(colour[k]) <= 20);
        // From deep inside each half to where it ends, in rows well within it.
        let left: Vec<u32> = (120..280).map(|y| (100..300).find(|x| !is_ink(*x, y)).unwrap()).collect();
        let right: Vec<u32> = (120..280).map(|y| (100..300).rev().find(|x| !is_ink(*x, y)).unwrap()).collect();
        for edge in [left, right] {
            let uneven = edge.iter().max().unwrap() - edge.iter().min().unwrap();
            // Points of the mesh are out of line by a fifth of that: its teeth would be 20 px.
            assert!(uneven <= 12, "{topology}: {uneven} px of cells of 37 px: {edge:?}");
        }
    }
}

/// A strip of 0.2 m by 1.6 m that is pulled at one end: the force over what it makes longer is E width/length.
#[test]
fn a_braced_strip_is_as_stiff_as_one_of_edges_alone_and_as_youngs_modulus_says() {
    let folder = tempfile::tempdir().unwrap();
    let ink = picture([240, 60], [0; 3], |x, y| (x - 120.0).abs() < 100.0 && (y - 30.0).abs() < 15.0);
    let path = saved(folder.path(), "strip.png", &ink);
    let young = 1e3;
    for (pattern, spacing, share) in [
        (PatternName::Edges, 3.0, 0.05),
        (PatternName::Braced, 3.0, 0.05),
        (PatternName::Braced, 5.0, 0.08),
        (PatternName::Braced, 8.0, 0.15),
    ] {
        let settings = Settings { size: Size::Spacing(spacing), ..Settings::default() };
        let material = Some(Matter::Soft.material(Some(young)));
        let keys = BodyKeys { material, pattern: Some(pattern), ..BodyKeys::cut(&settings, 0.48, &ink) };
        let mut scene = Scene::of_picture(&path, keys, Matter::Soft).unwrap();
        (scene.bounds, scene.mouse, scene.gravity) = (None, None, None);
        let start = scene.world(None).unwrap().sample(0.0).position;
        let end = |side: f64| {
            let is_at = |i: &u32| side * start[*i as usize][0] > 0.8 - 2e-3;
            (0..start.len() as u32).filter(is_at).collect::<Vec<_>>()
        };
        // Both ends are held, and one of them is pulled out by a hundredth: the energy is E width strain^2 length/2.
        let (fixed, pulled) = (end(-1.0), end(1.0));
        assert!(fixed.len() > 2 && pulled.len() > 2);
        scene.bodies[0].pinned = [&fixed[..], &pulled[..]].concat();
        let mut scene = scene.expanded().unwrap();
        let points = scene.points.as_mut().unwrap();
        for &point in &pulled {
            let [x, y, _] = points.position[point as usize].embed();
            points.position[point as usize] = Vector::Plane([x + 0.016, y]);
        }
        let settled = wobble::study::settle(&scene, 1.0).unwrap();
        assert!(settled.is_settled);
        let stiffness = 2.0 * settled.sample.energy / (0.016 * 0.016);
        let truth = young * 0.24 / 1.6;
        assert!((stiffness / truth - 1.0).abs() < share, "{stiffness} N/m of {truth} N/m, {pattern} at {spacing} px");
    }
}

/// Triangles that are turned over, of a bar thrown down so hard that it folds.
#[test]
fn braces_keep_a_body_from_folding() {
    let folder = tempfile::tempdir().unwrap();
    let turned = |pattern| {
        let ink = picture([100, 100], [0; 3], |x, y| (x - 50.0).abs() < 40.0 && (y - 50.0).abs() < 40.0);
        let path = saved(folder.path(), "square.png", &ink);
        let settings = Settings { size: Size::Spacing(8.0), ..Settings::default() };
        let material = Some(Matter::Soft.material(Some(400.0)));
        let velocity = Some(Vector::Plane([0.0, -6.0]));
        let keys = BodyKeys { material, pattern: Some(pattern), velocity, ..BodyKeys::cut(&settings, 2.0, &ink) };
        let mut scene = Scene::of_picture(&path, keys, Matter::Soft).unwrap();
        scene.mouse = None;
        // The live step, to which it would go, opens what is folded.
        scene.method.budget = Some(BudgetKeys::None);
        let triangles = scene.skins().unwrap()[0].triangles.clone();
        let mut world = scene.world(None).unwrap();
        while world.time() < 2.5 {
            world.step();
        }
        let at = world.sample(world.time()).position;
        let is_turned = |corners: &&[u32; 3]| {
            let [a, b, c] = corners.map(|k| at[k as usize]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0.0
        };
        (triangles.iter().filter(is_turned).count(), triangles.len())
    };
    let ((edges, all), (braced, _)) = (turned(PatternName::Edges), turned(PatternName::Braced));
    assert!(edges > all / 20 && braced == 0, "{edges} and {braced} of {all}");
}

#[test]
fn braces_come_between_sides_and_strokes_in_the_scene_and_on_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    // A disc on a string.
    let ink = picture([120, 200], [0; 3], |x, y| (x - 60.0).hypot(y - 140.0) < 45.0 || (x - 60.0).abs() < 1.5);
    let path = saved(folder.path(), "pendant.png", &ink);
    let out = folder.path().join("pendant.json");
    let (path, out) = (path.to_str().unwrap(), out.to_str().unwrap());
    let done = wobble(&["mesh", path, "--spacing", "12", "--pattern", "braced", "--out", out, "--stats"]);
    let stats: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    let settings = Settings { size: Size::Spacing(12.0), ..Settings::default() };
    let mesh = mesh_picture(&Scene::picture_file(Path::new(path)).unwrap(), &settings).unwrap().mesh;
    let (sides, ropes) = mesh.bonds.split_at(mesh.mesh_bonds);
    let braces: Vec<[u32; 2]> = mesh.braces().iter().map(|brace| brace.ends).collect();
    assert!(!ropes.is_empty() && braces.len() > 20);
    let world = Scene::read(Path::new(out)).unwrap().world(None).unwrap();
    let bonds: Vec<[u32; 2]> = world.bonds().iter().map(|bond| [bond.a.0, bond.b.0]).collect();
    assert_eq!(bonds, [sides, &braces, ropes].concat());
    assert_eq!(stats["bonds"], bonds.len());
}

/// The parts of a picture: each lies where it does in the whole, and all together are the whole.
#[test]
fn parts_lie_where_they_lie_in_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let ink =
        picture([200, 100], [0; 3], |x, y| (x - 50.0).hypot(y - 50.0) < 20.0 || (x - 140.0).hypot(y - 40.0) < 30.0);
    let path = saved(folder.path(), "two.png", &ink);
    let settings = Settings { size: Size::Spacing(8.0), ..Settings::default() };
    let whole = Scene::of_picture(&path, BodyKeys::cut(&settings, 2.0, &ink), Matter::Soft).unwrap();
    let apart = whole.clone().in_parts(0).unwrap();
    let parts: Vec<Option<u32>> = apart.bodies.iter().map(|body| body.part).collect();
    assert_eq!(parts, [Some(0), Some(1)]);
    assert!(apart.bodies[1].part.is_some() && apart.skins().unwrap().len() == 2);
    let points = |scene: &Scene| {
        let mut points = scene.world(None).unwrap().sample(0.0).position;
        points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        points
    };
    assert_eq!(points(&apart), points(&whole));
    let mass =
        |scene: &Scene| scene.bodies.iter().map(|body| body.material.as_ref().unwrap().mass.unwrap()).sum::<f64>();
    assert!((mass(&apart) - mass(&whole)).abs() < 1e-12);
    let text = apart.with_pictures_inside().unwrap();
    let text = text.to_json().unwrap();
    assert_eq!(points(&Scene::parse(&text, "apart.json").unwrap()), points(&whole), "a file of it is the same");

    let specks = picture([400, 400], [0; 3], |x, y| (x % 40.0 - 20.0).hypot(y % 40.0 - 20.0) < 8.0);
    let path = saved(folder.path(), "specks.png", &specks);
    let scene = Scene::of_picture(&path, BodyKeys::cut(&settings, 2.0, &specks), Matter::Soft).unwrap();
    let error = scene.in_parts(0).unwrap_err().to_string();
    assert!(error.contains("100 parts: 64 are the most"), "{error}");
}

#[test]
fn one_more_picture_lies_beside_what_is_there_and_one_cut_anew_in_its_place() {
    let ink = Arc::new(picture([100, 100], [0; 3], |x, y| (x - 50.0).hypot(y - 50.0) < 40.0));
    let keys = |spacing, height| {
        BodyKeys::cut(&Settings { size: Size::Spacing(spacing), ..Settings::default() }, height, &ink)
    };
    let mut scene =
        Scene::of_drawing("disc", Arc::clone(&ink), keys(10.0, 1.0), Matter::Soft, &Watch::default()).unwrap();
    let seen = [[-1.4, -0.8], [1.4, 1.0]];
    let middle = |scene: &Scene, body: usize| scene.bodies[body].origin.unwrap().embed();
    for count in 1..=2 {
        let start = scene.world(None).unwrap();
        let added = scene.body_to_add(&*start, (&ink, keys(10.0, 1.0)), seen, false).unwrap();
        scene = scene.with(added).unwrap();
        let [x, y, _] = middle(&scene, count);
        // By its shape, as near to the middle of what is seen as may be.
        assert!((0.8..1.05).contains(&x.hypot(y)), "{x} {y}");
    }
    assert!(middle(&scene, 1)[0] * middle(&scene, 2)[0] < 0.0, "one to each side");
    assert_eq!(scene.picture_body(), Some(0));
    let cut = scene.cut(0).unwrap();
    assert!(cut.height == 1.0 && (cut.settings.spacing() - 10.0).abs() < 1e-9 && *cut.picture == *ink);

    let before = scene.world(None).unwrap().point_count();
    let finer = scene.with_picture_anew(1, Arc::clone(&ink), keys(5.0, 1.0)).unwrap();
    assert!(finer.world(None).unwrap().point_count() > before + 50);
    assert_eq!(middle(&finer, 1), middle(&scene, 1));
    assert_eq!(finer.bodies[1].material, scene.bodies[1].material);
    scene.bodies[2].pinned = vec![0];
    assert!(scene.with_picture_anew(1, Arc::clone(&ink), keys(5.0, 1.0)).is_ok(), "no number in it changes");
    let error = scene.with_picture_anew(2, ink.clone(), keys(5.0, 1.0)).unwrap_err().to_string();
    assert!(error.contains("bodies[2]: pins, bonds, triangles"), "{error}");
}

/// Only skins, on black.
fn skins_alone() -> Look {
    let clear = [0.0; 4];
    Look { has_grid: false, ground: [0.0, 0.0, 0.0, 1.0], wall: clear, ..Look::default() }
}

fn shown(scene: &Scene) -> image::RgbaImage {
    let (world, skins) = (scene.world(None).unwrap(), scene.skins().unwrap());
    let camera = Camera::fit([[-1.2, -1.0, 0.0], [1.2, 1.0, 0.0]], 2, [240, 200]);
    let view = View { skins: &skins, mouse: None, ..View::of(&*world) };
    common::picture::drawn(&view, &camera, &skins_alone())
}

/// Relative luminance of a colour in sRGB [1].
fn luminance(pixel: &image::Rgba<u8>) -> f64 {
    let linear = |k: usize| {
        let c = f64::from(pixel[k]) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2)
}

#[test]
fn dark_ink_is_seen_on_the_dark_ground_and_light_ink_has_no_rim() {
    if common::gpu().is_none() {
        return;
    }
    let shown = |ink: [u8; 3]| {
        let disc = Arc::new(picture([120, 120], ink, |x, y| (x - 60.0).hypot(y - 60.0) < 50.0));
        let keys = BodyKeys::cut(&Settings::default(), 2.0, &disc);
        let scene = Scene::of_drawing("disc", disc, keys, Matter::Soft, &Watch::default()).unwrap();
        let (world, skins) = (scene.world(None).unwrap(), scene.skins().unwrap());
        let camera = Camera::fit([[-1.2, -1.0, 0.0], [1.2, 1.0, 0.0]], 2, [240, 200]);
        let view = View { skins: &skins, mouse: None, ..View::of(&*world) };
        let look = Look { has_grid: false, wall: [0.0; 4], ..Look::default() };
        common::picture::drawn(&view, &camera, &look)
    };
    // From the middle outwards the lightest pixel, all around.
    let edges = |drawn: &image::RgbaImage| -> Vec<f64> {
        let along = |degrees: u32| {
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            let at = |r: u32| drawn.get_pixel((120.0 + f64::from(r) * cos) as u32, (100.0 + f64::from(r) * sin) as u32);
            (20..99).map(|r| luminance(at(r))).fold(0.0, f64::max)
        };
        (0..360).step_by(5).map(along).collect()
    };
    let ground = luminance(shown([0; 3]).get_pixel(1, 1));
    for ink in [[0; 3], [28, 30, 34], [70, 0, 0], [0, 40, 90], [20, 60, 20], [96, 96, 96]] {
        let least = edges(&shown(ink)).into_iter().fold(f64::INFINITY, f64::min);
        let contrast = (least + 0.05) / (ground + 0.05);
        assert!(contrast >= 3.0, "{ink:?}: {contrast} : 1");
    }
    let light = shown([240, 150, 80]);
    let own = luminance(light.get_pixel(120, 100));
    assert!(edges(&light).iter().all(|&edge| (edge - own).abs() < 0.02), "nothing lighter than the ink itself");
}

/// A white disc and others: a colour that is one takes the place of the ink's hue, of which lightness is left, and white leaves all as they are.
#[test]
fn a_colour_tints_the_picture_of_its_body() {
    if common::gpu().is_none() {
        return;
    }
    let disc = |ink: [u8; 3]| {
        let disc = Arc::new(picture([120, 120], ink, |x, y| (x - 60.0).hypot(y - 60.0) < 50.0));
        let keys = BodyKeys::cut(&Settings::default(), 2.0, &disc);
        Scene::of_drawing("disc", disc, keys, Matter::Soft, &Watch::default()).unwrap()
    };
    let camera = Camera::fit([[-1.2, -1.0, 0.0], [1.2, 1.0, 0.0]], 2, [240, 200]);
    let mut capture = Capture::new([240, 200], 2).unwrap();
    for (ink, color, seen) in [
        ([255; 3], None, [255; 3]),
        ([255; 3], Some([200, 40, 90]), [200, 40, 90]),
        // As light as the root of 0.30 r + 0.59 g + 0.11 b, and a half of what that lacks of its strength.
        ([128, 255, 64], Some([255, 128, 0]), [225, 113, 0]),
        ([90, 120, 200], Some([255; 3]), [90, 120, 200]),
    ] {
        let scene = disc(ink);
        let (world, skins) = (scene.world(None).unwrap(), scene.skins().unwrap());
        let tints = [Tint { color, ..Tint::new(0, 0) }];
        let view = View { skins: &skins, tints: &tints, mouse: None, ..View::of(&*world) };
        let drawn = capture.picture(&view, &camera, &skins_alone()).unwrap();
        let inside =
            drawn.enumerate_pixels().filter(|(x, y, _)| x.abs_diff(120).pow(2) + y.abs_diff(100).pow(2) < 2500);
        let off = inside.map(|(.., pixel)| (0..3).map(|k| pixel[k].abs_diff(seen[k])).max().unwrap()).max().unwrap();
        assert!(off <= 2, "{ink:?} in {color:?}: off by {off}");
    }
}

/// Ink on white paper, with smooth edges as a pen leaves them: a blot, and a line that becomes a rope.
fn on_paper(colour: [u8; 3]) -> Picture {
    let mut picture = Picture::filled(160, 120, [255; 4]);
    for (i, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
        let [x, y] = [i % 160, i / 160].map(|at| at as f64 + 0.5);
        let (blot, line) = (22.0 - (x - 40.0).hypot(y - 60.0), 1.6 - (x - x.clamp(60.0, 140.0)).hypot(y - 61.3));
        let share = (blot.max(line) + 0.5).clamp(0.0, 1.0);
        (0..3).for_each(|k| pixel[k] = (255.0 + share * (f64::from(colour[k]) - 255.0)) as u8);
    }
    picture
}

#[test]
fn a_drawing_wears_nothing_of_its_paper() {
    if common::gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    // Light enough to be seen on the ground: darker ink has a light rim.
    let drawing = on_paper([225, 30, 40]);
    let path = saved(folder.path(), "drawing.png", &drawing);
    for (spacing, is_written_out) in [(10.0, false), (6.0, false), (10.0, true)] {
        let settings = Settings { size: Size::Spacing(spacing), ..Settings::default() };
        let scene = Scene::of_picture(&path, BodyKeys::cut(&settings, 2.0, &drawing), Matter::Soft).unwrap();
        let scene = if is_written_out { scene.expanded().unwrap() } else { scene };
        let picture = shown(&scene);
        let inked = picture.pixels().filter(|pixel| pixel[0] > 100).count();
        let palest = picture.pixels().map(|pixel| pixel[1].max(pixel[2])).max().unwrap();
        assert!(inked > 2000, "it is there: {inked}");
        assert!(palest < 75, "paper shines through at spacing {spacing}: {palest}");
    }
}

#[test]
fn bodies_of_several_pictures_look_the_same_written_out() {
    if common::gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let blot = |size: [u32; 2], colour| {
        picture(size, colour, |x, y| {
            (2.2 * (x / f64::from(size[0]) - 0.5)).hypot(2.2 * (y / f64::from(size[1]) - 0.5)) < 1.0
        })
    };
    saved(folder.path(), "red.png", &blot([90, 60], [220, 40, 30]));
    saved(folder.path(), "green.png", &blot([40, 80], [30, 200, 60]));
    let body = |file: &str, [x, y]: [f64; 2]| {
        format!(
            r#"{{ "make": "picture", "file": "{file}", "height": 1, "spacing": 0.12, "origin": [{x}, {y}], "material": {{ "kind": "spring", "young": 1000 }} }}"#
        )
    };
    let bodies = [body("red.png", [-0.5, 0.0]), body("green.png", [0.5, 0.0]), body("red.png", [0.9, 1.2])].join(", ");
    let path = folder.path().join("three.json");
    std::fs::write(&path, format!(r#"{{ "wobble": 1, "bodies": [{bodies}] }}"#)).unwrap();
    let scene = Scene::read(&path).unwrap();
    let expanded = scene.expanded().unwrap();
    let [skins, one] = [&scene, &expanded].map(|scene| scene.skins().unwrap());
    assert_eq!((skins.len(), one.len()), (3, 1));
    assert_eq!(one[0].triangles.len(), skins.iter().map(|skin| skin.triangles.len()).sum::<usize>());
    let [before, after] = [&scene, &expanded].map(shown);
    for colour in [[220, 40, 30], [30, 200, 60]] {
        let near = |pixel: &image::Rgba<u8>| (0..3).all(|k| pixel.0[k].abs_diff(colour[k]) <= 3);
        assert!(before.pixels().filter(|pixel| near(pixel)).count() > 1000, "{colour:?} is in the picture");
    }
    let differ = |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| (0..3).any(|k| a.0[k].abs_diff(b.0[k]) > 8);
    let others = before.pixels().zip(after.pixels()).filter(differ).count();
    // Edges between pixels of a picture fall elsewhere between those of a larger one.
    assert!(others < 300, "the same colours in the same places, but for {others} pixels");
}

/// Where bodies meet, what they cover is written out too, and is not drawn on if it was not before.
#[test]
fn what_is_drawn_on_stays_so_where_bodies_that_meet_are_written_out() {
    let with_box = |place: usize| {
        let mut scene = Scene::load("gear").unwrap();
        let frame = r#"{"make": "box", "width": 1, "height": 1, "origin": [9, 9], "repeat": {"count": [2, 1], "step": [2, 0]}}"#;
        scene.bodies.insert(place, serde_json::from_str(frame).unwrap());
        scene
    };
    for scene in [with_box(0), with_box(1), Scene::load("rim").unwrap()] {
        let mut meeting = scene.clone();
        meeting.contact = Some(Meeting::Is(true));
        let [alone, together] = [&scene, &meeting].map(|scene| scene.expanded().unwrap());
        let drawn = |scene: &Scene| {
            let corners = scene.skins().unwrap().into_iter().flat_map(|skin| skin.triangles);
            corners.collect::<Vec<[u32; 3]>>()
        };
        assert!(!drawn(&scene).is_empty() && drawn(&meeting) == drawn(&scene));
        assert!(drawn(&alone) == drawn(&scene) && drawn(&together) == drawn(&scene));
        let covered = |scene: &Scene| scene.model::<2>().unwrap().triangles;
        assert_eq!(covered(&together), covered(&meeting));
        assert_eq!(covered(&meeting), covered(&scene));
        let is_all_drawn = covered(&scene).len() == drawn(&scene).len();
        assert_eq!(is_all_drawn, scene.bodies.len() == 1);
    }
}

/// Noise is told by the length of its outline, before minutes are spent on it.
#[test]
fn an_outline_that_is_mere_grain_is_refused() {
    let mut state = 1_u64;
    let mut noise = Picture::filled(1500, 1500, [0, 0, 0, 255]);
    for pixel in noise.rgba.chunks_exact_mut(4) {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        pixel[..3].fill((state >> 56) as u8);
    }
    let folder = tempfile::tempdir().unwrap();
    let path = saved(folder.path(), "noise.png", &noise);
    let error = complaint(&["mesh", path.to_str().unwrap(), "--strokes", "mesh"]);
    assert!(error.contains("blur it, give a wider spacing or a larger least area"), "{error}");
}

#[test]
fn the_ends_of_ranges_are_taken_on_the_command_line_and_in_scenes() {
    let folder = tempfile::tempdir().unwrap();
    let path = saved(folder.path(), "dot.png", &picture([37, 53], [0; 3], |x, y| (x - 18.0).hypot(y - 26.0) < 15.0));
    let out = folder.path().join("dot.json");
    let (path, out) = (path.to_str().unwrap(), out.to_str().unwrap());
    for extra in [["--threshold", "0"], ["--threshold", "0.9"], ["--spacing", "1"], ["--young", "1e-3"]] {
        let done = wobble(&[&["mesh", path, "--out", out][..], &extra].concat());
        assert!(done.status.success(), "{extra:?}: {}", String::from_utf8_lossy(&done.stderr));
    }
    for young in ["1e-4", "1e10", "nan"] {
        assert_eq!(wobble(&["mesh", path, "--young", young]).status.code(), Some(2));
    }
}

#[test]
fn nothing_is_written_when_the_scene_fails() {
    let folder = tempfile::tempdir().unwrap();
    let path = saved(folder.path(), "dot.png", &picture([64, 64], [0; 3], |x, _| x < 30.0));
    let preview = folder.path().join("preview.png");
    let arguments = ["mesh", path.to_str().unwrap(), "--link", "--preview", preview.to_str().unwrap(), "--out"];
    complaint(&[&arguments[..], &["/nowhere/at/all/x.json"]].concat());
    assert!(!preview.exists());
}

#[test]
fn what_is_no_regular_file_is_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path().to_str().unwrap();
    assert!(complaint(&["mesh", here]).contains("is a directory"));
    if cfg!(unix) {
        let scene = folder.path().join("scene.json");
        let text = r#"{"wobble": 1, "bodies": [{"make": "picture", "file": "pipe.png"}]}"#;
        std::fs::write(&scene, text).unwrap();
        let pipe = folder.path().join("pipe.png");
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        for arguments in [
            &["mesh", "/dev/zero"][..],
            &["mesh", pipe.to_str().unwrap()],
            &["render", pipe.to_str().unwrap(), "--out", "x.png"],
            &["render", "/dev/zero", "--out", "x.png"],
            &["render", scene.to_str().unwrap(), "--out", "x.png"],
        ] {
            let error = complaint(arguments);
            assert!(error.contains("is no regular file but a pipe or a device"), "{error}");
        }
    }
}

#[test]
fn names_with_colons_and_a_targa_are_taken() {
    let folder = tempfile::tempdir().unwrap();
    let ink = picture([64, 64], [0; 3], |x, _| x < 30.0);
    let out = folder.path().join("out.json");
    let names = if cfg!(unix) { &["a:b.png", "data:x.png", "\\d.png"][..] } else { &["plain.png"] };
    for name in names {
        let path = saved(folder.path(), name, &ink);
        for extra in [&["--link"][..], &[]] {
            let arguments = ["mesh", path.to_str().unwrap(), "--out", out.to_str().unwrap()];
            let done = wobble(&[&arguments[..], extra].concat());
            assert!(done.status.success(), "{name}: {}", String::from_utf8_lossy(&done.stderr));
            assert!(Scene::read(&out).unwrap().skins().unwrap().len() == 1);
        }
    }
    let targa = folder.path().join("x.tga");
    image::RgbaImage::from_raw(64, 64, ink.rgba).unwrap().save(&targa).unwrap();
    assert_eq!(Scene::load(targa.to_str().unwrap()).unwrap().skins().unwrap().len(), 1);
}

/// Strokes count by their area, so that what is all of them is damped by Young's modulus as others are.
#[test]
fn a_picture_of_ropes_alone_is_damped_by_youngs_modulus() {
    let folder = tempfile::tempdir().unwrap();
    let line = picture([200, 40], [0; 3], |x, y| (10.0..190.0).contains(&x) && (y - 20.0).abs() < 2.0);
    let path = saved(folder.path(), "line.png", &line);
    let damping = [1e2, 1e4].map(|young| {
        let keys = BodyKeys {
            material: Some(Matter::Soft.material(Some(young))),
            ..BodyKeys::cut(&Settings::default(), 2.0, &line)
        };
        let world = Scene::of_picture(&path, keys, Matter::Soft).unwrap().world(None).unwrap();
        let kind = world.bonds().iter().next().unwrap().kind;
        assert!(scene_is_of_ropes(&path));
        match kind {
            wobble::sim::BondKind::Spring { damping, .. } => damping,
            other => panic!("{other:?}"),
        }
    });
    // c = k 2 ratio/omega, and omega grows as the root of k.
    assert!((damping[1] / damping[0] - 10.0).abs() < 0.01, "{damping:?}");
}

fn scene_is_of_ropes(path: &Path) -> bool {
    let done = wobble(&["mesh", path.to_str().unwrap(), "--stats"]);
    let stats: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    stats["triangles"] == 0
}

#[test]
fn a_picture_opens_as_what_stands_out_from_its_ground_or_whole_where_it_has_none() {
    let folder = tempfile::tempdir().unwrap();
    let opaque = |name: &str, light: &dyn Fn(f64, f64) -> f64| {
        let mut grey = Picture::filled(90, 60, [255; 4]);
        for i in 0..90 * 60 {
            let value = (255.0 * light((i % 90) as f64 / 90.0, (i / 90) as f64 / 60.0)) as u8;
            grey.rgba[4 * i..4 * i + 3].fill(value);
        }
        Scene::open_picture(&saved(folder.path(), name, &grey), &Watch::default()).unwrap()
    };
    let disc = |x: f64, y: f64| (1.5 * (x - 0.5)).hypot(y - 0.5) < 0.3;
    let area = |scene: &Scene| {
        let mesh = scene.picture_mesh(0).unwrap();
        mesh.areas.iter().sum::<f64>() / (90.0 * 60.0)
    };
    let share = std::f64::consts::PI * 0.3 * 0.3 / 1.5;
    let ink = opaque("ink.png", &|x, y| if disc(x, y) { 0.1 } else { 1.0 });
    let chalk = opaque("chalk.png", &|x, y| if disc(x, y) { 0.9 } else { 0.05 });
    let photograph = opaque("photograph.png", &|x, y| 0.2 + 0.6 * x * y);
    for (scene, keys, share) in
        [(ink, [None, None], share), (chalk, [Some(true), None], share), (photograph.clone(), [None, Some(true)], 1.0)]
    {
        let body = &scene.bodies[0];
        assert_eq!([body.invert, body.whole], keys, "{}", scene.name());
        assert!((area(&scene) - share).abs() < 0.01, "{}: {}", scene.name(), area(&scene));
    }
    let whole = photograph.with_pictures_inside().unwrap();
    let again = Scene::parse(&whole.to_json().unwrap(), "again.json").unwrap();
    assert_eq!(again.world(None).unwrap().sample(0.0).position, whole.world(None).unwrap().sample(0.0).position);
    let path = folder.path().join("photograph.png");
    let out = wobble(&["mesh", path.to_str().unwrap(), "--whole", "--spacing", "6", "--stats"]);
    assert!(out.status.success() && String::from_utf8(out.stdout).unwrap().contains("\"components\": 1"));
}

/// What is opened stands as it was drawn: dropped from above, this one ended on its head.
#[test]
fn a_picture_that_is_opened_stands_on_the_floor_and_does_not_topple() {
    for name in ["jellyfish", "jelly", "gear"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/pictures/{name}.png"));
        let scene = Scene::open_picture(&path, &Watch::default()).unwrap();
        let floor = scene.bounds.as_ref().unwrap().min.embed()[1];
        let mut world = scene.world(None).unwrap();
        let now = |world: &dyn wobble::sim::Dynamics| world.sample(world.time()).position;
        let start = now(&*world);
        let end = |best: fn(f64, f64) -> f64| {
            let place = |k: usize| start[k][1];
            (1..start.len()).fold(0, |a, b| if best(place(a), place(b)) == place(b) { b } else { a })
        };
        let (top, foot) = (end(f64::max), end(f64::min));
        assert!((0.0..0.06).contains(&(start[foot][1] - floor)), "{name}: {} over {floor}", start[foot][1]);
        (0..240).for_each(|_| world.step());
        let after = now(&*world);
        let up = [0, 1].map(|axis| after[top][axis] - after[foot][axis]);
        assert!(up[1] > up[0].abs(), "{name}: its top lies {up:?} m from its foot");
    }
}
