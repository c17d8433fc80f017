//! How a scene opens: its camera.

mod beside;
#[cfg(test)]
mod gallery_tests;
mod roaming;

use glam::{DVec2, DVec3};

use crate::render::{Camera, Pose, Tiles, View};
use crate::scene::{Scene, Vector, ViewKeys};

pub use beside::{Over, beside_all, beside_panels};
pub use roaming::{Followed, followed};

/// Width of the pictures that views are made for, in heights: what is seen to both sides there is seen in narrower ones too.
const MADE_FOR: f64 = 16.0 / 9.0;
/// A picture of that shape `[px]`.
const USUAL: [u32; 2] = [1600, 900];
/// Room beside what a narrower picture would cut off `[1]`: beside walls, and beside points, which pins and springs are wider than.
const ROOM: f64 = 1.03;
const OUTER: f64 = 1.09;
/// The same in a picture of space, beside all of it, as a share of its lesser side `[1]`.
const BORDER: f64 = 0.03;

/// Room between points and what lies over the picture, as a share of its lesser side `[1]`: pins are as wide.
const BESIDE: f64 = 0.02;

/// Least width of what is seen of a scene, in its heights `[1]`.
const SLIMMEST: f64 = 0.75;

/// The camera of a scene's `view`; what that leaves out fits the scene.
pub fn camera(scene: &Scene, seen: &View<'_>, size: [u32; 2]) -> Camera {
    let [width, tall] = size.map(f64::from);
    let height = |height: f64, center: DVec2| height.max(across(scene, height, center.x, seen) * tall / width);
    if roaming::roams(scene, seen, size) {
        return roaming::camera(scene, seen, size);
    }
    let camera = look(scene.view.as_ref(), height, seen, size);
    let Pose::Orbit { .. } = camera.pose else { return camera };
    // In space what a narrower picture cuts off is seen from further away.
    let border = BORDER * width.min(tall);
    match width < MADE_FOR * tall {
        true => whole(camera, seen, [[border; 2], [width - border, tall - border]]),
        false => camera,
    }
}

/// The same, drawn back and moved so that what it shows lies where nothing lies over it: in the free part of its picture, and below what lies in
/// its upper right corner. In space there is as much room on the other side of what the view looks at as bodies take on theirs: they may begin
/// above it and end below.
pub fn opened(scene: &Scene, seen: &View<'_>, size: [u32; 2], (free, over): (Free, Over)) -> Camera {
    let opened = camera(scene, seen, size);
    match opened.pose {
        Pose::Plane { .. } => beside_all(|free| clear(opened, seen, free), seen, (free, over)),
        Pose::Orbit { .. } => {
            let target = look(scene.view.as_ref(), |height, _| height, seen, size).focus();
            let about = |camera: &Camera| mirrored(on_screen(camera, seen), camera.screen_from_world(target));
            beside_all(|free| drawn_back(opened, free, about), seen, (free, over))
        }
    }
}

/// The same in the first of the panes of a window, of which panels leave `area` `[px]`: only one that is alone makes way for what lies in the
/// upper right corner, for others have titles there.
pub fn opened_in(scene: &Scene, seen: &View<'_>, tiles: &Tiles, (area, free, over): ([u32; 2], Free, Over)) -> Camera {
    let pane = tiles.pane(area);
    let over = if tiles.count() == 1 { over } else { Over::default() };
    opened(scene, seen, pane, (free_of_pane(pane, (area, free)), over))
}

/// The camera of a scene in a picture of usual shape: what is measured by it does not depend on the window.
pub fn alone(scene: &Scene, seen: &View<'_>) -> Camera {
    camera(scene, seen, USUAL)
}

/// The camera as it stood when something was saved.
pub fn saved(view: &ViewKeys, seen: &View<'_>, size: [u32; 2]) -> Camera {
    look(Some(view), |height, _| height, seen, size)
}

fn look(view: Option<&ViewKeys>, height_at: impl Fn(f64, DVec2) -> f64, seen: &View<'_>, size: [u32; 2]) -> Camera {
    let mut camera = fit(seen, true, size);
    let Some(view) = view else { return camera };
    match &mut camera.pose {
        Pose::Plane { center, height } => {
            *center = view.center.map_or(*center, |at| DVec3::from(at.embed()).truncate());
            *height = view.height.map_or(*height, |height| height_at(height, *center));
        }
        Pose::Orbit { target, distance, yaw, pitch } => {
            *target = view.target.map_or(*target, |at| DVec3::from(at.embed()));
            *distance = view.distance.unwrap_or(*distance);
            *yaw = view.yaw.unwrap_or(*yaw);
            *pitch = view.pitch.unwrap_or(*pitch);
        }
    }
    camera
}

/// How `count` worlds of a scene share a picture of `size` `[px]`; `alone` is its camera in a picture of usual shape. `taken` is what of each pane's
/// width and height is not for the world `[px]`, below what lies over the upper edge of the picture, so high.
pub fn tiles(
    (scene, alone): (&Scene, &Camera),
    seen: &View<'_>,
    (count, size): (usize, [u32; 2]),
    taken: ([f64; 2], f64),
) -> Tiles {
    if count < 2 {
        return Tiles::ALONE;
    }
    let (center, height) = (alone.focus(), alone.height());
    let width = match alone.pose {
        Pose::Plane { .. } => {
            let sides = [points(seen), surroundings(seen)].map(|extent| extent.map(|at| (at[0] - center.x).abs()));
            let shown = |side: &f64| *side <= 0.5 * MADE_FOR * height;
            let shown = sides.into_iter().flatten().filter(shown).fold(0.0, f64::max);
            said_width(scene).unwrap_or((2.0 * ROOM * shown).max(SLIMMEST * height))
        }
        Pose::Orbit { .. } => height,
    };
    Tiles::new(count, [width, height], size, taken)
}

/// How `count` worlds of a scene share what panels leave of the window, `area` `[px]`, of which nothing lies over the part `free`: above that
/// stand titles, so high, which each world has, and above these what all of them have once.
pub fn shared(scene: &Scene, seen: &View<'_>, count: usize, (area, free, titles): ([u32; 2], Free, f64)) -> Tiles {
    let [low, high] = free;
    let head = (low[1] - titles).max(0.0);
    let [across, down] = [0, 1].map(|axis| (f64::from(area[axis]) - (high[axis] - low[axis])).max(0.0));
    tiles((scene, &alone(scene, seen)), seen, (count, area), ([across, (down - head).max(0.0)], head))
}

/// The camera of a pane that a panel takes room from, or gives some back: as large as before, with the same place in the left upper corner, and
/// only where that would leave out what was seen, moved and drawn back by as little as it takes. `free` is what nothing lies over of the pane,
/// which is of `size` `[px]` now.
pub fn narrowed(mut own: Camera, seen: &View<'_>, size: [u32; 2], free: Free) -> Camera {
    let before = own.viewport();
    if (0..2).any(|axis| f64::from(size[axis]) < f64::from(before[axis])) {
        own = match own.pose {
            Pose::Plane { .. } => clear(own, seen, free),
            Pose::Orbit { .. } => whole(own, seen, free),
        };
    }
    own.resize_still(size);
    own
}

/// What nothing lies over of a pane of this size `[px]`: at each side as much is left out as what lies over the picture takes there.
pub fn free_of_pane(pane: [u32; 2], (area, free): ([u32; 2], Free)) -> Free {
    let [low, high] = free;
    let ends = [0, 1].map(|axis| high[axis] - f64::from(area[axis]) + f64::from(pane[axis]));
    let has_room = (0..2).all(|axis| ends[axis] > low[axis]);
    if has_room { [low, ends] } else { [[0.0; 2], pane.map(f64::from)] }
}

/// A camera as a file has it.
pub fn keys(camera: &Camera) -> ViewKeys {
    match camera.pose {
        Pose::Plane { center, height } => {
            ViewKeys { center: Some(Vector::Plane(center.to_array())), height: Some(height), ..ViewKeys::default() }
        }
        Pose::Orbit { target, distance, yaw, pitch } => ViewKeys {
            target: Some(Vector::Space(target.to_array())),
            distance: Some(distance),
            yaw: Some(yaw),
            pitch: Some(pitch),
            ..ViewKeys::default()
        },
    }
}

/// How much a picture narrower than views are made for shows across `[m]`, of a view so high: what the scene says, else so much that nothing of
/// points and walls is cut off to the sides which one of usual width shows.
fn across(scene: &Scene, height: f64, center: f64, view: &View<'_>) -> f64 {
    let shown = |extent: [[f64; 3]; 2]| {
        let sides = extent.map(|corner| (corner[0] - center).abs());
        sides.into_iter().filter(|&side| side <= 0.5 * MADE_FOR * height).fold(0.0, f64::max)
    };
    let wide = (2.0 * OUTER * shown(points(view))).max(2.0 * ROOM * shown(surroundings(view)));
    // In a picture higher than wide there is room beside what is slim, too.
    said_width(scene).unwrap_or(wide.max(SLIMMEST * height))
}

fn said_width(scene: &Scene) -> Option<f64> {
    scene.view.as_ref().and_then(|view| view.width)
}

/// A camera that shows all points, with walls and polygons too or without. Where there are no points it shows those anyway.
pub fn fit(view: &View<'_>, with_walls: bool, size: [u32; 2]) -> Camera {
    let dimensions = view.dimensions;
    let mut corners = points(view);
    if with_walls || view.current.is_empty() {
        surroundings(view).iter().for_each(|corner| include(&mut corners, corner));
    }
    let seen = (0..dimensions).all(|axis| corners[0][axis].is_finite() && corners[1][axis].is_finite());
    let corners = if seen { corners } else { [[-1.0; 3], [1.0; 3]] };
    let flat = |corner: [f64; 3]| corner.map(|c| if c.is_finite() { c } else { 0.0 });
    Camera::fit(corners.map(flat), dimensions, size)
}

/// What of a picture nothing lies over `[px]`: its left upper and its right lower corner.
pub type Free = [[f64; 2]; 2];

/// The camera drawn back and moved as little as it takes that all sides of points and walls which it shows lie in the free part of its
/// picture, in one higher than wide in the middle of its height; in space as it is.
pub fn clear(camera: Camera, seen: &View<'_>, free: Free) -> Camera {
    clear_of(camera, &[points(seen), surroundings(seen)], free)
}

/// The camera moved as little as it takes that all sides of points which it shows lie in the free part of its picture, whatever becomes of walls;
/// `None`: they have no room there as large as they are, or the picture is higher than wide.
fn moved(camera: Camera, seen: &View<'_>, free: Free) -> Option<Camera> {
    let [width, height] = camera.viewport();
    let own = clear_of(camera, &[points(seen)], free);
    (width >= height && own.pixels_per_metre() == camera.pixels_per_metre()).then_some(own)
}

/// The camera drawn back and moved as little as it takes for what lies in some boxes `[m]`: that of points, and that of walls, if they count.
fn clear_of(mut camera: Camera, boxes: &[[[f64; 3]; 2]], free: Free) -> Camera {
    let Pose::Plane { .. } = camera.pose else { return camera };
    let viewport = DVec2::from(camera.viewport().map(f64::from));
    let (middle, is_upright) = (0.5 * viewport, viewport.y > viewport.x);
    let on_screen = |extent: [[f64; 3]; 2]| {
        let seen = extent.into_iter().filter(|corner| corner[..2].iter().all(|x| x.is_finite()));
        seen.filter_map(|[x, y, _]| camera.screen_from_world(DVec3::new(x, y, 0.0))).collect::<Vec<_>>()
    };
    let all: Vec<Vec<[f64; 2]>> = boxes.iter().copied().map(on_screen).collect();
    // Points are drawn wider than they are, whatever the scale is.
    let wider = [BESIDE * viewport.min_element(), 0.0];
    let (mut back, mut sides) = (1.0_f64, [[None; 2]; 2]);
    for axis in 0..2 {
        for ((corners, wider), side) in all.iter().zip(wider).zip(&mut sides[axis]) {
            let shown = corners.iter().map(|corner| corner[axis]).filter(|x| (0.0..=viewport[axis]).contains(x));
            let [low, high] = shown.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
            if low <= high {
                *side = Some([low, high, wider]);
            }
        }
        let room = free[1][axis] - free[0][axis];
        for [_, high, above] in sides[axis].iter().flatten() {
            for [low, _, below] in sides[axis].iter().flatten().filter(|side| above + side[2] < room) {
                back = back.max((high - low) / (room - above - below));
            }
        }
    }
    if !back.is_finite() {
        return camera;
    }
    camera.zoom_at(middle.to_array(), 1.0 / back);
    let by = [0, 1].map(|axis| {
        let ends = sides[axis].iter().flatten().map(|[low, high, wider]| {
            let [low, high] = [low, high].map(|x| middle[axis] + (x - middle[axis]) / back);
            [low - wider, high + wider]
        });
        let Some([low, high]) = ends.reduce(|[a, b], [low, high]| [a.min(low), b.max(high)]) else { return 0.0 };
        match axis == 1 && is_upright {
            true => 0.5 * (free[0][axis] + free[1][axis] - low - high),
            false => (free[0][axis] - low).max(0.0) + (free[1][axis] - high).min(0.0),
        }
    });
    camera.pan(by);
    camera
}

/// The camera drawn back and moved as little as it takes that all points lie in the free part of its picture, and what it shows of walls and
/// solid obstacles too; a few times its distance at most, for what flies away.
pub fn whole(camera: Camera, seen: &View<'_>, free: Free) -> Camera {
    drawn_back(clear(camera, seen, free), free, |camera| on_screen(camera, seen))
}

/// The camera drawn back and moved as little as it takes that what is `shown` in its picture, as two corners `[px]`, lies in the free part.
fn drawn_back(mut camera: Camera, free: Free, shown: impl Fn(&Camera) -> [[f64; 2]; 2]) -> Camera {
    let middle = [0, 1].map(|axis| 0.5 * (free[0][axis] + free[1][axis]));
    let room = [0, 1].map(|axis| free[1][axis] - free[0][axis]);
    let mut further = 1.0;
    // In space the way back changes what is seen of the depth: a few rounds are enough.
    for _ in 0..ROUNDS {
        let [low, high] = shown(&camera);
        if !(0..2).all(|axis| (high[axis] - low[axis]).is_finite()) {
            break;
        }
        // What is too large is brought to the middle; what is not stays as near to where it was as may be.
        let back = [0, 1].map(|axis| (high[axis] - low[axis]) / room[axis]).into_iter().fold(1.0, f64::max);
        let back = back.min(FURTHEST / further);
        further *= back;
        camera.zoom_at(middle, 1.0 / back);
        let [low, high] = shown(&camera);
        let off = [0, 1].map(|axis| match high[axis] - low[axis] > room[axis] {
            true => middle[axis] - 0.5 * (low[axis] + high[axis]),
            false => (free[0][axis] - low[axis]).max(0.0) + (free[1][axis] - high[axis]).min(0.0),
        });
        camera.pan(off);
        if back == 1.0 && off == [0.0; 2] {
            break;
        }
    }
    camera
}

/// A box in a picture, and as much on the other side of a place that is seen there `[px]`.
fn mirrored([low, high]: [[f64; 2]; 2], about: Option<[f64; 2]>) -> [[f64; 2]; 2] {
    let Some(about) = about else { return [low, high] };
    let other = |end: f64, axis: usize| 2.0 * about[axis] - end;
    [
        [0, 1].map(|axis| low[axis].min(other(high[axis], axis))),
        [0, 1].map(|axis| high[axis].max(other(low[axis], axis))),
    ]
}

/// Rounds of drawing back, and how much further away that leads at most.
const ROUNDS: usize = 6;
const FURTHEST: f64 = 4.0;

/// The box about all points, and in space about what is solid, in a picture `[px]`.
fn on_screen(camera: &Camera, seen: &View<'_>) -> [[f64; 2]; 2] {
    let (positions, dimensions) = (seen.current, seen.dimensions);
    let place = |first: usize| {
        let place = std::array::from_fn(|axis| if axis < dimensions { positions.get(first + axis) } else { 0.0 });
        camera.screen_from_world(DVec3::from_array(place)).filter(|at| at.iter().all(|x| x.is_finite()))
    };
    let solids = seen.convex.iter().flat_map(|convex| {
        let ends = convex.figure.extent();
        (0..8).map(move |corner| DVec3::from_array(std::array::from_fn(|axis| ends[corner >> axis & 1][axis])))
    });
    let on_screen = |place: DVec3| camera.screen_from_world(place).filter(|at| at.iter().all(|x| x.is_finite()));
    let all = (0..positions.len()).step_by(dimensions.max(1)).filter_map(place);
    let all = all.chain(solids.filter_map(on_screen));
    all.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], at| {
        [[0, 1].map(|axis| low[axis].min(at[axis])), [0, 1].map(|axis| high[axis].max(at[axis]))]
    })
}

/// A camera that shows all points in the free part of a picture.
pub fn fit_in(view: &View<'_>, free: Free, size: [u32; 2]) -> Camera {
    let [low, high] = free.map(DVec2::from);
    let room = (high - low).max(DVec2::ONE);
    let mut camera = fit(view, false, room.to_array().map(|side| side.round() as u32));
    let whole = DVec2::from(size.map(f64::from));
    match &mut camera.pose {
        Pose::Plane { height, .. } => *height *= whole.y / room.y,
        Pose::Orbit { distance, .. } => *distance *= whole.y / room.y,
    }
    camera.resize(size);
    camera.pan((0.5 * (low + high) - 0.5 * whole).to_array());
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

/// Corners of a box that nothing is in.
const EMPTY: [[f64; 3]; 2] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];

/// Takes in a place. What has no number along an axis has no place there.
fn include(corners: &mut [[f64; 3]; 2], place: &[f64]) {
    for (axis, &value) in place.iter().enumerate().filter(|(_, value)| value.is_finite()) {
        corners[0][axis] = corners[0][axis].min(value);
        corners[1][axis] = corners[1][axis].max(value);
    }
}

/// The box about all points `[m]`.
fn points(view: &View<'_>) -> [[f64; 3]; 2] {
    let (positions, dimensions) = (view.current, view.dimensions);
    let mut corners = EMPTY;
    for first in (0..positions.len()).step_by(dimensions.max(1)) {
        let place: [f64; 3] =
            std::array::from_fn(|axis| if axis < dimensions { positions.get(first + axis) } else { 0.0 });
        include(&mut corners, &place[..dimensions]);
    }
    corners
}

/// The box about walls and solid obstacles `[m]`.
fn surroundings(view: &View<'_>) -> [[f64; 3]; 2] {
    let mut corners = EMPTY;
    view.bounds.iter().flatten().for_each(|corner| include(&mut corners, &corner[..view.dimensions]));
    for corner in view.polygons.iter().flat_map(|polygon| &polygon.loops).flatten() {
        include(&mut corners, corner);
    }
    view.convex.iter().flat_map(|convex| convex.figure.extent()).for_each(|corner| include(&mut corners, &corner));
    corners
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
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
        let text =
            r#"{"wobble": 1, "points": {"position": [[-4, -1], [4, 1]]}, "view": {"center": [0, 0], "height": 8}}"#;
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
        let plane =
            r#"{"wobble": 1, "points": {"position": [[-4, -3], [4, 9]]}, "view": {"center": [0, 0], "height": 4}}"#;
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
        assert!(
            (0..2).all(|axis| low[axis] > free[0][axis] - 1.0 && high[axis] < free[1][axis] + 1.0),
            "{low:?} {high:?}"
        );
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
        assert!(
            at(&opened, 10.0) > 235.0 && at(&opened, -17.5) < 651.0,
            "{} {}",
            at(&opened, 10.0),
            at(&opened, -17.5)
        );
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
}
