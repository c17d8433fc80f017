//! Off-screen pictures: goldens of scenes, and coverage of a disc and a line against their formulas.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

use crate::common;

use std::path::Path;
use std::process::Command;

use common::picture::{NO_BONDS, SIDE, assert_coverage, between, bond, drawn, pixels, plain, sampled, view};
use glam::{DVec2, DVec3};
use image::RgbaImage;
use wobble::app::opening;
use wobble::render::{Camera, Capture, Look, Overlay, Palette, Pane, Pose, Tiles, View};
use wobble::scene::gallery;
use wobble::sim::{Bond, Bonds, Cursor, MouseForce, PointId, Positions, Profile, Region, Track};

fn golden(name: &str, scene: &str, time: &str) {
    if let Some(gpu) = common::gpu() {
        common::golden::check(name, &common::rendered(scene, time, "320x240"), &gpu.info);
    }
}

#[test]
fn points_fall() {
    golden("points", "points", "1");
}

#[test]
fn a_random_graph_tumbles() {
    golden("random-graph", "random-graph", "1");
}

#[test]
fn the_rim_at_rest() {
    golden("rim", "rim", "0");
}

#[test]
fn the_rim_pushed_by_a_mouse() {
    golden("rim-pushed", common::file("rim-pushed.json").to_str().unwrap(), "0.45");
}

#[test]
fn a_cloth_in_space() {
    golden("cloth-space", common::file("cloth-space.json").to_str().unwrap(), "1.5");
}

#[test]
fn ragdolls_on_their_stairs() {
    golden("ragdoll", "ragdoll", "0.5");
}

#[test]
fn a_bridge_under_its_load() {
    golden("bridge", "bridge", "1.5");
}

#[test]
fn the_rim_as_printed_beside_the_same_rim_with_walls_after_the_sweep() {
    golden("rim-as-printed", "rim-as-printed", "3.9");
}

#[test]
fn every_scene_of_the_gallery_at_its_start() {
    let Some(gpu) = common::gpu() else { return };
    let info = gpu.info.clone();
    let size = [320, 180];
    let mut captures = [2, 3].map(|dimensions| Capture::on(gpu.clone(), size, dimensions).unwrap());
    for entry in gallery() {
        let scene = entry.scene().unwrap();
        let world = scene.world(scene.duration).unwrap();
        let skins = scene.skins().unwrap();
        let view = View { skins: &skins, ..View::of(&*world) };
        let capture = &mut captures[scene.dimensions() - 2];
        capture.forget_world();
        let camera = opening::camera(&scene, &view, size);
        let picture = capture.picture(&view, &camera, &Look::default()).unwrap();
        common::golden::check(&format!("gallery/{}", entry.name), &picture, &info);
    }
}

#[test]
fn scenes_on_a_light_ground() {
    let Some(gpu) = common::gpu() else { return };
    let info = gpu.info.clone();
    let size = [480, 270];
    for (name, overlay) in [("jelly", Overlay::None), ("bridge", Overlay::Strain), ("pegs", Overlay::None)] {
        let entry = gallery().iter().find(|entry| entry.name == name).unwrap();
        let scene = entry.scene().unwrap();
        let mut world = scene.world(scene.duration).unwrap();
        while world.time() < 0.5 {
            world.step();
        }
        let skins = scene.skins().unwrap();
        let view = View { skins: &skins, ..View::of(&*world) };
        let mut capture = Capture::on(gpu.clone(), size, scene.dimensions()).unwrap();
        let look = Look { overlay, ..Look::in_palette(Palette::Light) };
        let picture = capture.picture(&view, &opening::camera(&scene, &view, size), &look).unwrap();
        common::golden::check(&format!("light/{name}"), &picture, &info);
    }
}

#[test]
fn worlds_side_by_side_are_each_drawn_as_they_are_alone() {
    if common::gpu().is_none() {
        return;
    }
    let places: [[f32; 4]; 2] = [[-9.0, 3.0, 8.0, -7.0], [-4.0, 9.0, 5.0, 6.0]];
    let bonds: Bonds = [bond(0, 1)].into();
    let look = Look { wall: [0.0; 4], ..plain() };
    let size = [2 * SIDE, SIDE];
    let tiles = Tiles::new(2, [1.0; 2], size, ([0.0; 2], 0.0));
    let camera = tiles.whole(&pixels(), size);
    let mut capture = Capture::new(size, 2).unwrap();
    let mut draw = |values: Option<&[f32]>, overlay| {
        let views = places.each_ref().map(|places| View { values, ..view(places, &bonds, 2) });
        let look = Look { overlay, difference_full: 1.0, ..look };
        let panes = [0, 1].map(|k| Pane::of(&tiles, k, views[k].clone(), &camera, look, size));
        capture.pictures(&panes).unwrap()
    };
    let both = draw(None, Overlay::None);
    for (k, places) in places.iter().enumerate() {
        let alone = drawn(&view(places, &bonds, 2), &pixels(), &look);
        let part = image::imageops::crop_imm(&both, k as u32 * SIDE, 0, SIDE, SIDE).to_image();
        let off = part.iter().zip(alone.iter()).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(off <= Some(2), "world {k}: {off:?}");
    }
    // The last colour is violet, which no strain has, and that of no difference is grey.
    let middle = |picture: &RgbaImage| picture.get_pixel(SIDE / 2 - 1, SIDE / 2 + 1).0;
    let far = draw(Some(&[1.0, 1.0]), Overlay::Difference);
    let near = draw(Some(&[0.0, 0.0]), Overlay::Difference);
    let [red, green, blue, _] = middle(&far);
    assert!(red > 2 * green && blue > 2 * green, "{:?}", middle(&far));
    let [red, _, blue, _] = middle(&near);
    assert!(red.abs_diff(blue) < 30, "{:?}", middle(&near));
}

#[test]
fn a_disc_covers_what_its_formula_says() {
    if common::gpu().is_none() {
        return;
    }
    let center = DVec2::new(3.3, -7.8);
    let positions = [center.x as f32, center.y as f32];
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let picture = capture.picture(&view(&positions, NO_BONDS, 2), &pixels(), &plain()).unwrap();
    assert_coverage(&picture, sampled(|at| at.distance(center) <= f64::from(plain().point_radius)));
}

#[test]
fn a_line_covers_what_its_formula_says() {
    if common::gpu().is_none() {
        return;
    }
    let (a, b) = (DVec2::new(-20.4, -13.7), DVec2::new(17.1, 9.2));
    let positions = [a.x as f32, a.y as f32, b.x as f32, b.y as f32];
    let look = Look { point: [0.0; 4], ..plain() };
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let picture = capture.picture(&view(&positions, &[bond(0, 1)].into(), 2), &pixels(), &look).unwrap();
    let near = |at: DVec2| {
        let t = ((at - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        at.distance(a + (b - a) * t) <= 0.5 * f64::from(look.bond_width)
    };
    assert_coverage(&picture, sampled(near));
}

#[test]
fn pictures_have_the_size_asked_for_and_others_are_refused() {
    if common::gpu().is_none() {
        return;
    }
    for size in [[1, 1], [333, 77], [64, 1]] {
        let picture = Capture::new(size, 2).unwrap().picture(&view(&[0.0, 0.0], NO_BONDS, 2), &pixels(), &plain());
        assert_eq!(picture.unwrap().dimensions(), (size[0], size[1]));
    }
    for size in [[0, 10], [10, 0], [1_000_000, 10]] {
        assert!(Capture::new(size, 2).err().unwrap().to_string().contains("cannot be drawn"));
    }
}

#[test]
fn a_still_world_uploads_nothing() {
    if common::gpu().is_none() {
        return;
    }
    let positions = [0.0_f32, 0.0, 5.0, 5.0];
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let seen = view(&positions, NO_BONDS, 2);
    capture.picture(&seen, &pixels(), &plain()).unwrap();
    let first = *capture.renderer().counters();
    capture.picture(&seen, &pixels(), &plain()).unwrap();
    let second = *capture.renderer().counters();
    assert_eq!((first.uploads, first.bytes_uploaded), (second.uploads, second.bytes_uploaded));
    assert_eq!((first.draws, first.frames_drawn, first.submits), (2, 1, 1), "the grid and the points");
    assert_eq!(second, first, "an unchanged picture is not drawn again");
    let moved = View { motion: 1, ..seen };
    capture.picture(&moved, &pixels(), &plain()).unwrap();
    let third = *capture.renderer().counters();
    assert_eq!(third.bytes_uploaded - second.bytes_uploaded, 16, "two points, nothing else");
    assert_eq!((third.draws, third.frames_drawn, third.submits), (4, 2, 2));
    let before = capture.picture(&moved, &pixels(), &plain()).unwrap();
    let after = capture.picture(&moved, &pixels(), &Look { ground: [0.5; 4], ..plain() }).unwrap();
    assert!(before != after, "the ground is not uploaded, but drawn");
}

#[test]
fn far_from_the_origin_a_world_looks_the_same() {
    if common::gpu().is_none() {
        return;
    }
    let picture = |offset: f64| {
        let positions: Vec<f64> = [-10.0, 3.0, 12.0, -7.0].iter().map(|x| x + offset).collect();
        let seen = View {
            previous: Positions::F64(&positions),
            current: Positions::F64(&positions),
            ..view(&[], NO_BONDS, 2)
        };
        let pose = Pose::Plane { center: DVec2::splat(offset), height: f64::from(SIDE) };
        drawn(&seen, &Camera::new(pose, [SIDE, SIDE]), &plain())
    };
    assert!(picture(0.0) == picture(1e6));
}

#[test]
fn an_animation_is_written_whole() {
    if common::gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("x.gif");
    let done = Command::new(env!("CARGO_BIN_EXE_wobble"))
        .args(["render", "points", "--frames", "3", "--size", "40x30", "--out"])
        .arg(&out)
        .status()
        .unwrap();
    assert!(done.success());
    let read = |path: &Path| {
        use image::AnimationDecoder;
        let bytes = std::io::BufReader::new(std::fs::File::open(path).unwrap());
        image::codecs::gif::GifDecoder::new(bytes).unwrap().into_frames().collect_frames().unwrap()
    };
    let frames = read(&out);
    assert_eq!((frames.len(), frames[0].buffer().dimensions()), (3, (40, 30)));
}

/// A mouse region of 20 px around a cursor that is not in the middle of a pixel.
fn region_picture(region: Region, radius: f64, at: DVec2) -> RgbaImage {
    let force = MouseForce { strength: 1.0, radius, region, profile: Profile::Smooth, track: Track::default() };
    let seen = View { mouse: Some((&force, Cursor::at([at.x, at.y]))), ..view(&[], NO_BONDS, 2) };
    let look = Look { region: [1.0; 4], outline_width: 2.0, ..plain() };
    drawn(&seen, &pixels(), &look)
}

#[test]
fn the_region_is_as_large_as_its_radius_and_filled_to_its_edge() {
    if common::gpu().is_none() {
        return;
    }
    let (radius, center) = (20.0, DVec2::new(1.25, -2.6));
    for region in [Region::Round, Region::Square] {
        let picture = region_picture(region, radius, center);
        for (x, y, pixel) in picture.enumerate_pixels() {
            let middle = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) - 0.5 * f64::from(SIDE);
            let offset = (DVec2::new(middle.x, -middle.y) - center).abs();
            let from_center = if region == Region::Round { offset.length() } else { offset.max_element() };
            // The outline is 2 px wide, and a pixel reaches 0.71 px from its middle.
            match from_center - radius {
                beyond if beyond > 1.71 => assert_eq!(pixel[0], 0, "{region:?}: {x} {y} is outside"),
                beyond if beyond < -1.71 => assert_eq!(pixel[0], 18, "{region:?}: {x} {y} is inside, 0.07 of 255"),
                beyond if beyond.abs() < 0.29 => assert_eq!(pixel[0], 255, "{region:?}: {x} {y} is the outline"),
                _ => {}
            }
        }
    }
}

/// A camera in space that looks at the origin from `distance` [m].
fn from_afar(distance: f64) -> Camera {
    Camera::new(Pose::Orbit { target: DVec3::ZERO, distance, yaw: 0.0, pitch: 0.0 }, [SIDE, SIDE])
}

#[test]
fn in_space_small_things_look_as_large_ones_do() {
    if common::gpu().is_none() {
        return;
    }
    let picture = |size: f32| {
        let positions = [-1.0, -0.2, 0.3, 1.0, 0.4, -0.5].map(|x| x * size);
        // The second bond goes past the camera.
        let past = [[-0.4, -0.4, 0.0], [0.6, 0.3, 8.0]].as_flattened().iter().map(|x| x * size);
        let positions: Vec<f32> = positions.into_iter().chain(past).collect();
        let bonds = [bond(0, 1), bond(2, 3)].map(|bond| Bond { rest_length: f64::from(size), ..bond }).into();
        let camera = from_afar(4.0 * f64::from(size));
        drawn(&view(&positions, &bonds, 3), &camera, &plain())
    };
    let large = picture(1.0);
    assert!(large.pixels().filter(|pixel| pixel[0] > 128).count() > 100, "it is in the picture");
    for size in [2.0_f32.powi(-13), 2.0_f32.powi(-17)] {
        assert!(picture(size) == large, "{size} m");
    }
}

/// A zigzag of `count` bonds, and its positions in the plane [px].
fn zigzag(count: u32) -> (Vec<f32>, Bonds) {
    let step = 50.0 / count as f32;
    let flat = (0..=count).flat_map(|i| [i as f32 * step - 25.0, if i % 2 == 0 { -12.0 } else { 9.0 }]);
    (flat.collect(), (0..count).map(|i| bond(i, i + 1)).collect())
}

#[test]
fn buffers_grow_with_the_world() {
    if common::gpu().is_none() {
        return;
    }
    let mut grown = Capture::new([SIDE, SIDE], 2).unwrap();
    for (topology, count) in [2, 40, 9, 700].into_iter().enumerate() {
        let (flat, bonds) = zigzag(count);
        let seen = View { topology: topology as u64, ..view(&flat, &bonds, 2) };
        let fresh = Capture::new([SIDE, SIDE], 2).unwrap().picture(&seen, &pixels(), &plain()).unwrap();
        assert!(grown.picture(&seen, &pixels(), &plain()).unwrap() == fresh, "{count} bonds");
    }
}

#[test]
fn a_world_too_large_for_the_gpu_is_refused_and_the_next_is_drawn() {
    if common::gpu().is_none() {
        return;
    }
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let picture = |capture: &mut Capture, flat: &[f32], bonds: &Bonds, topology| {
        capture.picture(&View { topology, ..view(flat, bonds, 2) }, &pixels(), &plain())
    };
    let (flat, bonds) = zigzag(40);
    picture(&mut capture, &flat, &bonds.iter().take(3).collect(), 0).unwrap();
    // The bonds get a larger buffer before the positions turn out to be too many. Nothing writes to this memory.
    let many = vec![0.0_f32; capture.gpu().largest_buffer() as usize / 4 + 2];
    let refused = picture(&mut capture, &many, &bonds, 1).unwrap_err();
    assert!(refused.to_string().contains("bytes of positions are more than this GPU's buffers hold"), "{refused}");
    let next = picture(&mut capture, &flat, &bonds, 1).unwrap();
    let fresh = picture(&mut Capture::new([SIDE, SIDE], 2).unwrap(), &flat, &bonds, 0).unwrap();
    assert!(next == fresh, "with all bonds, from the larger buffer");
}

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];
const BLUE: [f32; 4] = [0.0, 0.0, 1.0, 1.0];

/// The pixel that a place in the picture lies in, counted from its middle [px, y up].
fn pixel_at(picture: &RgbaImage, at: DVec2) -> [u8; 3] {
    let middle = 0.5 * f64::from(SIDE);
    let [r, g, b, _] = picture.get_pixel((middle + at.x) as u32, (middle - at.y) as u32).0;
    [r, g, b]
}

#[test]
fn what_is_drawn_lies_between_two_states() {
    if common::gpu().is_none() {
        return;
    }
    let (before, now) = ([-12.0_f32, 4.0, 8.0, -16.0], [4.0, -12.0, 16.0, 24.0]);
    for dimensions in [2, 3] {
        let picture = |previous: &[f32], current: &[f32], mix| {
            let lift = |flat: &[f32]| -> Vec<f32> {
                flat.chunks(2).flat_map(|x| [x[0], x[1], 0.0].into_iter().take(dimensions)).collect()
            };
            let (previous, current) = (lift(previous), lift(current));
            let bonds = [bond(0, 1)].into();
            let seen = View { previous: Positions::F32(&previous), mix, ..view(&current, &bonds, dimensions) };
            let camera = if dimensions == 2 { pixels() } else { from_afar(80.0) };
            drawn(&seen, &camera, &plain())
        };
        for mix in [0.0, 0.25, 1.0] {
            let between: Vec<f32> = before.iter().zip(now).map(|(a, b)| a + mix * (b - a)).collect();
            let seen = picture(&before, &now, mix);
            assert!(seen == picture(&between, &between, 1.0), "{mix} in {dimensions} dimensions");
            assert!(mix == 0.25 || seen != picture(&before, &now, 0.25), "{mix} is another picture");
        }
    }
}

#[test]
fn pinned_points_are_larger_and_of_another_colour() {
    if common::gpu().is_none() {
        return;
    }
    // Forty points in five rows: the bits of the pins lie in two words.
    let at = |i: u32| DVec2::new(f64::from(i % 8) * 7.0 - 24.5, f64::from(i / 8) * 9.0 - 17.5);
    let flat: Vec<f32> = (0..40).flat_map(|i| at(i).as_vec2().to_array()).collect();
    let look = Look { point: BLUE, pin: RED, point_radius: 2.0, ..plain() };
    let pinned = [PointId(0), PointId(31), PointId(33)];
    let seen = View { pinned: &pinned, ..view(&flat, NO_BONDS, 2) };
    let picture = drawn(&seen, &pixels(), &look);
    for i in 0..40 {
        let is_pinned = pinned.contains(&PointId(i));
        let beside = pixel_at(&picture, at(i) + DVec2::new(2.0, 0.0));
        assert_eq!(pixel_at(&picture, at(i)), if is_pinned { [255, 0, 0] } else { [0, 0, 255] }, "point {i}");
        assert_eq!(beside[0] == 255, is_pinned, "point {i} has a radius of 2 px, or 2.7 if it is pinned: {beside:?}");
    }
}

#[test]
fn strain_is_shown_by_colour() {
    if common::gpu().is_none() {
        return;
    }
    let flat = [-20.0_f32, 0.0, 20.0, 0.0];
    let green = [0.0, 1.0, 0.0, 1.0];
    let look = Look { strain: between(BLUE, green, RED), bond: green, point: [0.0; 4], ..plain() };
    let color = |overlay, strain: f64| {
        let bonds = [Bond { rest_length: 40.0 / (1.0 + strain), ..bond(0, 1) }].into();
        let look = Look { overlay, strain_scale: 0.005, strain_full: 0.3, ..look };
        pixel_at(&drawn(&view(&flat, &bonds, 2), &pixels(), &look), DVec2::new(0.5, 0.5))
    };
    let close = |a: [u8; 3], b: [u8; 3]| a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 2);
    for strain in [0.0_f64, 0.002, 0.01, -0.01, 0.07, -0.2, 0.3, -0.5, 4.0] {
        let share = ((strain.abs() / 0.005).asinh() / (0.3_f64 / 0.005).asinh()).min(1.0);
        let [full, rest] = [share, 1.0 - share].map(|share| (255.0 * share).round() as u8);
        let expected = if strain > 0.0 { [full, rest, 0] } else { [0, rest, full] };
        let seen = color(Overlay::Strain, strain);
        assert!(close(seen, expected), "{strain}: {seen:?}, not {expected:?}");
        assert_eq!(color(Overlay::None, strain), [0, 255, 0], "without the overlay");
    }
    let unsized_bond = [Bond { rest_length: 0.0, ..bond(0, 1) }].into();
    let look = Look { overlay: Overlay::Strain, ..look };
    let picture = drawn(&view(&flat, &unsized_bond, 2), &pixels(), &look);
    assert_eq!(pixel_at(&picture, DVec2::new(0.5, 0.5)), [0, 255, 0], "a rest length of 0 has no strain");
}

/// Two bonds that cross in front of the middle, the second one nearer to the camera by `gap` [px].
fn crossing(gap: f32) -> Vec<f32> {
    let (far, near) = (-0.5 * gap, 0.5 * gap);
    [[-21.0, -6.0, far], [22.0, 7.0, far], [-5.0, -20.0, near], [8.0, 21.0, near]].concat()
}

fn in_space(flat: &[f32], bonds: &Bonds, look: &Look) -> RgbaImage {
    drawn(&view(flat, bonds, 3), &from_afar(75.0), look)
}

#[test]
fn in_space_what_is_nearer_lies_on_top_in_whatever_order_it_comes() {
    if common::gpu().is_none() {
        return;
    }
    let look = Look { strain: between(BLUE, BLUE, RED), point: [0.0; 4], overlay: Overlay::Strain, ..plain() };
    let flat = crossing(4.0);
    let far = Bond { rest_length: 1e3, ..bond(0, 1) };
    let near = Bond { rest_length: 1e-3, ..bond(2, 3) };
    for bonds in [[far, near], [near, far]].map(Bonds::from) {
        let [r, _, b] = pixel_at(&in_space(&flat, &bonds, &look), DVec2::new(1.4, 0.5));
        assert!(r > 225 && b < 30, "the stretched one is nearer: {r} {b}");
    }
    let camera = Camera::new(
        Pose::Orbit { target: DVec3::ZERO, distance: 75.0, yaw: std::f64::consts::PI, pitch: 0.0 },
        [SIDE, SIDE],
    );
    for bonds in [[far, near], [near, far]].map(Bonds::from) {
        let picture = drawn(&view(&flat, &bonds, 3), &camera, &look);
        let [r, _, b] = pixel_at(&picture, DVec2::new(-1.4, 0.5));
        assert!(b > r, "from behind, the squeezed one is: {r} {b}");
    }
}

#[test]
fn in_space_an_edge_keeps_nothing_out_that_lies_behind_it() {
    if common::gpu().is_none() {
        return;
    }
    let flat = crossing(4.0);
    for width in [1.5, 1.8, 3.0, 6.0] {
        let look = Look { point: [0.0; 4], bond_width: width, ..plain() };
        let alone = [bond(0, 1), bond(2, 3)].map(|bond| in_space(&flat, &[bond].into(), &look));
        for bonds in [[bond(0, 1), bond(2, 3)], [bond(2, 3), bond(0, 1)]].map(Bonds::from) {
            let both = in_space(&flat, &bonds, &look);
            for (x, y, pixel) in both.enumerate_pixels() {
                let least = alone.each_ref().map(|picture| picture.get_pixel(x, y)[0]).into_iter().max().unwrap();
                // As much of the ground as is left of a pixel that counts as filled.
                let left = (255.0 * (1.0 - 0.9_f32.min(0.5 * width))) as u8 + 2;
                assert!(
                    pixel[0].saturating_add(left) >= least,
                    "{width} px: a notch at {x} {y}: {} < {least}",
                    pixel[0]
                );
            }
        }
    }
}

#[test]
fn in_space_no_bond_cuts_the_disc_of_its_point() {
    if common::gpu().is_none() {
        return;
    }
    // Black bonds away from the camera and towards it, longer than a ball's side is steep.
    let mut flat = vec![0.3_f32, -0.4, 0.0];
    for i in 0..8 {
        let angle = i as f32 * 0.8;
        flat.extend([20.0 * angle.cos(), 20.0 * angle.sin(), if i % 2 == 0 { 12.0 } else { -12.0 }]);
    }
    let bonds: Bonds = (1..9).map(|i| Bond { rest_length: 1e3, ..bond(0, i) }).collect();
    let [unseen, black] = [0.0, 1.0]
        .map(|opacity| in_space(&flat, &bonds, &Look { point_radius: 5.0, bond: [0.0, 0.0, 0.0, opacity], ..plain() }));
    let mut filled = 0;
    for (x, y) in (24..40).flat_map(|x| (24..40).map(move |y| (x, y))) {
        let alone = unseen.get_pixel(x, y)[0];
        filled += u32::from(alone == 255);
        assert!(alone < 255 || black.get_pixel(x, y)[0] == 255, "{x} {y}");
    }
    assert!(filled > 50, "the disc is there: {filled}");
}
