//! Pictures: from a file to a body, a scene, a skin.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod common;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use wobble::picture::{Picture, Settings, Size, encode};
use wobble::render::{Camera, Capture, Look, View};
use wobble::scene::{BodyKeys, Matter, Scene, gallery};
use wobble::sim::Bond;

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
        let settled = scene.settle(1.0).unwrap();
        let sag = start - lowest(&settled.sample.position);
        assert!(settled.is_settled && (sag - truth).abs() < 0.3 * truth, "{sag} m at {spacing} px for {truth} m");
    }
}

/// Without a damping of its own the slowest wobble is damped alike, in meshes that are not so fine that the fastest one sets the bound.
#[test]
fn a_picture_is_damped_alike_at_any_spacing() {
    let folder = tempfile::tempdir().unwrap();
    let left = [9.0, 13.0].map(|spacing| {
        let scene = bar(folder.path(), spacing);
        let mut world = scene.world(None).unwrap();
        let rest = scene.settle(1.0).unwrap().sample.energy;
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
        assert_eq!(skins.len(), scene.bodies.len(), "{}", entry.name);
        for skin in &skins {
            let last = skin.first + skin.texture.len() as u32;
            assert!(skin.triangles.iter().flatten().all(|&k| (skin.first..last).contains(&k)), "{}", entry.name);
            assert!(skin.texture.iter().flatten().all(|at| (0.0..=1.0).contains(at)), "{}", entry.name);
        }
        seen += 1;
    }
    assert_eq!(seen, 7);
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
    let look = Look { has_mesh: false, ..Look::default() };
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
