//! Scenes of a few lines for tests of pictures.

use std::cell::RefCell;

use glam::DVec2;
use image::RgbaImage;
use wobble::render::{Camera, Capture, Look, Overlay, Pose, View};
use wobble::sim::{Bond, Bonds, PointId, Positions};

/// White on black, nothing but points and bonds.
pub fn plain() -> Look {
    let white = [1.0; 4];
    let clear = [0.0; 4];
    Look {
        ground: [0.0, 0.0, 0.0, 1.0],
        grid: clear,
        axis: clear,
        number: clear,
        wall: clear,
        obstacle: white,
        bond: white,
        point: white,
        pin: white,
        overlay: Overlay::None,
        has_mesh: true,
        has_forms: false,
        has_grid: true,
        fog: 0.0,
        bond_width: 3.0,
        point_radius: 6.3,
        ..Look::default()
    }
}

/// For scenes of points alone.
pub const NO_BONDS: &Bonds = &Bonds::new();

/// A world that rests.
pub fn view<'a>(positions: &'a [f32], bonds: &'a Bonds, dimensions: usize) -> View<'a> {
    View {
        skins: &[],
        triangles: &[],
        tints: &[],
        values: None,
        trails: Vec::new(),
        dimensions,
        previous: Positions::F32(positions),
        current: Positions::F32(positions),
        mix: 1.0,
        motion: 0,
        topology: 0,
        bonds,
        torn: &[],
        masses: &[],
        pinned: &[],
        bounds: None,
        planes: Vec::new(),
        polygons: &[],
        convex: &[],
        mouse: None,
        hinges: Vec::new(),
        joints: Vec::new(),
        covered: &[],
    }
}

/// A bond of a metre.
pub fn bond(a: u32, b: u32) -> Bond {
    Bond::new(PointId(a), PointId(b), 1.0)
}

/// Width and height of the pictures that are held against formulas.
pub const SIDE: u32 = 64;

/// A camera under which a metre is a pixel and the origin is the middle of the picture.
pub fn pixels() -> Camera {
    Camera::new(Pose::Plane { center: DVec2::ZERO, height: f64::from(SIDE) }, [SIDE, SIDE])
}

/// A picture of the camera's size, of a world that nothing is known of. What draws is set up once a test for each size and dimension: that takes
/// longer than a picture.
pub fn drawn(view: &View<'_>, camera: &Camera, look: &Look) -> RgbaImage {
    thread_local! {
        static CAPTURES: RefCell<Vec<([u32; 2], usize, Capture)>> = const { RefCell::new(Vec::new()) };
    }
    let (size, dimensions) = (camera.viewport().map(|side| side as u32), view.dimensions);
    CAPTURES.with_borrow_mut(|captures| {
        let known = captures.iter().position(|(of, space, _)| (*of, *space) == (size, dimensions));
        let place = known.unwrap_or_else(|| {
            captures.push((size, dimensions, Capture::new(size, dimensions).unwrap()));
            captures.len() - 1
        });
        let capture = &mut captures[place].2;
        capture.forget_world();
        capture.picture(view, camera, look).unwrap()
    })
}

/// The share of a pixel, by its lower left corner [m], that lies within a shape, by 16 x 16 samples.
pub fn sampled(inside: impl Fn(DVec2) -> bool) -> impl Fn(DVec2) -> f64 {
    const FINE: u32 = 16;
    move |corner| {
        let offset = |k: u32| (f64::from(k) + 0.5) / f64::from(FINE);
        let sample = |i: u32| inside(corner + DVec2::new(offset(i % FINE), offset(i / FINE)));
        (0..FINE * FINE).filter(|&i| sample(i)).count() as f64 / f64::from(FINE * FINE)
    }
}

/// Holds the picture against the share of each pixel, by its lower left corner [m], that is covered in truth.
pub fn assert_coverage(picture: &RgbaImage, truth: impl Fn(DVec2) -> f64) {
    let (mut worst, mut sum, mut edge) = ((0.0_f64, 0, 0), 0.0, 0);
    for (x, y, pixel) in picture.enumerate_pixels() {
        let half = 0.5 * f64::from(SIDE);
        let truth = truth(DVec2::new(f64::from(x) - half, half - 1.0 - f64::from(y)));
        let error = (f64::from(pixel[0]) / 255.0 - truth).abs();
        worst = if error > worst.0 { (error, x, y) } else { worst };
        sum += error;
        edge += u32::from(truth > 0.0);
    }
    assert!(edge > 50, "the shape is in the picture");
    let mean = sum / f64::from(edge);
    assert!(mean <= 0.01, "mean error {mean} over the {edge} pixels that it touches");
    let (worst, x, y) = worst;
    assert!(worst <= 0.1, "largest error {worst} at {x} {y}");
}

/// Colours of strains from one colour over another to a third, in even steps.
pub fn between(squeezed: [f32; 4], rest: [f32; 4], stretched: [f32; 4]) -> [[f32; 4]; 9] {
    std::array::from_fn(|step| {
        let (from, to, share) =
            if step < 4 { (squeezed, rest, step as f32) } else { (rest, stretched, step as f32 - 4.0) };
        std::array::from_fn(|part| from[part] + (to[part] - from[part]) * 0.25 * share)
    })
}
