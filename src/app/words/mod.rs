//! Words over the world: where labels of a scene are seen, and how they and what tools say are painted.

mod labels;

pub use labels::Labels;

use std::sync::Arc;

use egui::epaint::Shape;
use egui::{Context, FontId, Galley, Pos2, Rect, Vec2};
use glam::{DVec2, DVec3};

use super::panels::{clear_about, kept_in, theme};
use crate::render::{Camera, View};
use crate::scene::LabelKeys;

/// Size of words over the world `[points]`.
pub(super) const SIZE: f32 = 13.0;
/// Room between them and an edge `[points]`.
pub(super) const APART: f32 = 4.0;
/// From a label to one above it `[points]`.
const BETWEEN: f32 = 2.0;
/// From words to the rim of their ground `[points]`.
const MARGIN: Vec2 = Vec2::new(6.0, 3.0);

/// How words lie about where they stand; they have several lines where there is no room for one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    /// That is their lower left corner.
    Corner,
    /// That is the middle of their lower edge.
    Middle,
}

/// Words on a ground of their own, kept in a room and off the pointer.
pub(super) fn written(
    context: &Context,
    (at, anchor): (Pos2, Anchor),
    words: &str,
    (room, pointer): (Rect, Option<Pos2>),
) -> Shape {
    let (galley, ground) = laid(context, (at, anchor), words, room);
    painted(context, galley, kept_in(ground, pointer, room))
}

/// The same of one of several labels: beside the panels that are `taken` there, above or below those labels that lie in its place; its own place
/// is one of them then.
pub(super) fn written_apart(
    context: &Context,
    (at, anchor): (Pos2, Anchor),
    words: &str,
    ((room, pointer), taken): ((Rect, Option<Pos2>), &[Rect]),
    others: &mut Vec<Rect>,
) -> Shape {
    let (galley, ground) = laid(context, (at, anchor), words, room);
    let ground = off_panels(taken, kept_in(ground, pointer, room), room);
    let ground = apart_from(others, ground, room);
    others.push(ground);
    painted(context, galley, ground)
}

/// The place in a room nearest to one that lies below a panel where it lies below none; the same place where there is no such near it.
fn off_panels(taken: &[Rect], place: Rect, room: Rect) -> Rect {
    let ways = |panel: &Rect| {
        [
            Vec2::new(panel.right() + APART - place.left(), 0.0),
            Vec2::new(panel.left() - APART - place.right(), 0.0),
            Vec2::new(0.0, panel.bottom() + APART - place.top()),
            Vec2::new(0.0, panel.top() - APART - place.bottom()),
        ]
    };
    let is_below = |place: Rect| taken.iter().any(|panel| panel.intersects(place));
    if !is_below(place) {
        return place;
    }
    let all = taken.iter().filter(|panel| panel.intersects(place)).flat_map(ways);
    let free = all.filter(|way| room.contains_rect(place.translate(*way)) && !is_below(place.translate(*way)));
    free.min_by(|a, b| a.length().total_cmp(&b.length())).map_or(place, |way| place.translate(way))
}

/// A place in a room, as near above others as there is room, else below them.
fn apart_from(others: &[Rect], place: Rect, room: Rect) -> Rect {
    let lies_on = |place: Rect| others.iter().copied().find(|other| other.intersects(place));
    let put = |top: f32| Rect::from_min_size(Pos2::new(place.left(), top), place.size());
    let (mut up, mut down) = (place, place);
    for _ in 0..others.len() {
        up = lies_on(up).map_or(up, |other| put(other.top() - BETWEEN - place.height()));
        down = lies_on(down).map_or(down, |other| put(other.bottom() + BETWEEN));
    }
    let fits = |place: &Rect| room.contains_rect(*place) && lies_on(*place).is_none();
    [up, down].into_iter().find(fits).unwrap_or(place)
}

/// Words on their ground.
fn painted(context: &Context, galley: Arc<Galley>, ground: Rect) -> Shape {
    let colors = theme::colors(context);
    let place = ground.min + MARGIN;
    let ground = Shape::rect_filled(ground, 5.0, colors.panel.gamma_multiply(0.92));
    Shape::Vec(vec![ground, Shape::galley(place, galley, colors.text)])
}

/// The same of what stands beside the pointer: where the panels that are taken there do not lie over it.
pub(super) fn written_beside(
    context: &Context,
    from: (Pos2, Anchor),
    words: &str,
    ((room, pointer), taken): ((Rect, Option<Pos2>), &[Rect]),
) -> Shape {
    let (_, ground) = laid(context, from, words, room);
    let own = clear_about(ground, pointer, (room, taken)).unwrap_or(room);
    written(context, from, words, (own, pointer))
}

/// Words as they are set in a room, and their ground where nothing is in the way.
fn laid(context: &Context, (at, anchor): (Pos2, Anchor), words: &str, room: Rect) -> (Arc<Galley>, Rect) {
    let width = (room.width() - 2.0 * MARGIN.x).max(SIZE);
    let (font, color) = (FontId::proportional(SIZE), theme::colors(context).text);
    let galley = context.fonts_mut(|fonts| fonts.layout(words.to_owned(), font, color, width));
    let size = galley.size();
    let left = if anchor == Anchor::Middle { 0.5 * size.x } else { 0.0 };
    let ground = Rect::from_min_size(at - egui::vec2(left, size.y), size).expand2(MARGIN);
    (galley, ground)
}

/// Labels of a scene by their numbers, and the pixels that they stand at: those whose point is gone, behind the camera or beside the picture are left out.
pub(super) fn seen<'a>(
    labels: &'a [LabelKeys],
    view: &View<'_>,
    camera: &Camera,
    [left, top, width, height]: [u32; 4],
) -> Vec<(usize, DVec2, &'a str)> {
    let within = |at: &DVec2| {
        (f64::from(left)..=f64::from(left + width)).contains(&at.x)
            && (f64::from(top)..=f64::from(top + height)).contains(&at.y)
    };
    let pixel = |label: &LabelKeys| {
        let place =
            DVec3::from(label.at.embed()) + label.point.map_or(Some(DVec3::ZERO), |point| place(view, point))?;
        camera.screen_from_world(place).map(DVec2::from).filter(within)
    };
    let seen = |(number, label): (usize, &'a LabelKeys)| Some((number, pixel(label)?, label.text.as_str()));
    labels.iter().enumerate().filter_map(seen).collect()
}

/// Where a point is drawn `[m]`; `None` of one that is not there.
fn place(view: &View<'_>, point: u32) -> Option<DVec3> {
    let first = view.dimensions * point as usize;
    if first + view.dimensions > view.current.len().min(view.previous.len()) {
        return None;
    }
    let at = |axis: usize| {
        let [from, to] = [&view.previous, &view.current].map(|places| places.get(first + axis));
        from + f64::from(view.mix) * (to - from)
    };
    let at: [f64; 3] = std::array::from_fn(|axis| if axis < view.dimensions { at(axis) } else { 0.0 });
    Some(DVec3::from(at)).filter(|at| at.is_finite())
}

/// A part of a picture in points.
pub(super) fn points([left, top, width, height]: [u32; 4], scale: f32) -> Rect {
    let corner = |x: u32, y: u32| Pos2::new(x as f32 / scale, y as f32 / scale);
    Rect::from_min_max(corner(left, top), corner(left + width, top + height))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::opening;
    use crate::scene::{Scene, gallery};

    /// Where labels of a scene lie at its start `[px]`, and the points of each of its worlds.
    fn laid(scene: &Scene, size: [u32; 2]) -> Vec<(Rect, Vec<Rect>, Vec<Pos2>)> {
        let world = scene.world(None).unwrap();
        let view = View::of(&*world);
        let alone = opening::alone(scene, &view);
        let tiles = opening::tiles((scene, &alone), &view, (1 + scene.beside.len(), size), ([0.0; 2], 0.0));
        let whole = tiles.whole(&opening::camera(scene, &view, tiles.pane(size)), size);
        let context = Context::default();
        let mut list = Vec::new();
        let mut output = context.run_ui(egui::RawInput::default(), |_| {
            list.clear();
            for pane in 0..tiles.count() {
                let (camera, clip) = (tiles.camera(pane, &whole, size), tiles.clip(pane, size));
                let room = points(clip, 1.0);
                let of = |(_, at, words): (usize, DVec2, &str)| {
                    let at = (Pos2::new(at.x as f32, at.y as f32), Anchor::Middle);
                    written(&context, at, words, (room.shrink(APART), None)).visual_bounding_rect()
                };
                let labels = seen(&scene.labels, &view, &camera, clip).into_iter().map(of).collect();
                let count = (view.current.len() / view.dimensions) as u32;
                let pixels = (0..count).filter_map(|point| camera.screen_from_world(place(&view, point)?));
                list.push((room, labels, pixels.map(|[x, y]| Pos2::new(x as f32, y as f32)).collect()));
            }
        });
        output.textures_delta.clear();
        list
    }

    #[test]
    fn labels_in_one_place_lie_above_or_below_each_other() {
        let room = Rect::from_min_max(Pos2::ZERO, Pos2::new(200.0, 100.0));
        let at = |y: f32| Rect::from_min_size(Pos2::new(10.0, y), Vec2::new(80.0, 20.0));
        assert_eq!(apart_from(&[], at(40.0), room), at(40.0));
        assert_eq!(apart_from(&[at(45.0)], at(40.0), room), at(23.0));
        assert_eq!(apart_from(&[at(45.0), at(24.0)], at(40.0), room), at(2.0));
        assert_eq!(apart_from(&[at(15.0)], at(10.0), room), at(37.0), "above it there is no room");
    }

    #[test]
    fn labels_lie_beside_panels_where_there_is_room() {
        let room = Rect::from_min_max(Pos2::ZERO, Pos2::new(200.0, 100.0));
        let at = |x: f32, y: f32| Rect::from_min_size(Pos2::new(x, y), Vec2::new(80.0, 20.0));
        let tools = Rect::from_min_max(Pos2::new(0.0, 10.0), Pos2::new(40.0, 100.0));
        assert_eq!(off_panels(&[tools], at(50.0, 40.0), room), at(50.0, 40.0), "it lies below none");
        assert_eq!(off_panels(&[tools], at(20.0, 40.0), room), at(44.0, 40.0), "beside the tools");
        let beside = Rect::from_min_max(Pos2::new(41.0, 30.0), Pos2::new(60.0, 100.0));
        assert_eq!(off_panels(&[tools, beside], at(50.0, 40.0), room), at(64.0, 40.0));
        let wide = Rect::from_min_max(Pos2::ZERO, Pos2::new(190.0, 70.0));
        assert_eq!(off_panels(&[wide], at(20.0, 40.0), room), at(20.0, 74.0), "below it");
        assert_eq!(off_panels(&[room], at(20.0, 40.0), room), at(20.0, 40.0), "there is no such place");
    }

    #[test]
    fn labels_of_the_gallery_lie_beside_bodies_and_each_other_and_are_whole() {
        let scenes = gallery().iter().map(|entry| entry.scene().unwrap());
        let labelled: Vec<Scene> = scenes.filter(|scene| !scene.labels.is_empty()).collect();
        assert!(labelled.len() >= 4);
        let sizes = [[1280, 720], [720, 1280], [640, 360], [360, 640]];
        for (scene, size) in labelled.iter().flat_map(|scene| sizes.map(|size| (scene, size))) {
            let about = format!("{} at {size:?}", scene.name());
            for (room, labels, points) in laid(scene, size) {
                assert_eq!(labels.len(), scene.labels.len(), "{about}: all are in view");
                for (k, label) in labels.iter().enumerate() {
                    assert!(room.contains_rect(*label), "{about}: label {k} at {label:?} is cut off");
                    let over = |other: &&Rect| other.intersects(*label);
                    assert_eq!(labels[k + 1..].iter().find(over), None, "{about}: on label {k}");
                    // A pin is so large.
                    let near = label.expand(5.0);
                    assert_eq!(
                        points.iter().find(|at| near.contains(**at)),
                        None,
                        "{about}: under label {k} at {label:?}"
                    );
                }
            }
        }
    }
}
