//! Where the panel of plots lies: off bodies, and off what belongs to a tool.

use egui::{Pos2, Rect, Vec2, pos2, vec2};

use super::places::APART;
use super::plots::HEAD;
use crate::render::Pose;

/// A room so high has place for the panel below the tools `[points]`.
const TALL: f32 = 850.0;
/// Where it begins beside the tools, and below them `[points]`.
pub(super) const LEFT: [f32; 2] = [76.0, 10.0];
/// Points so near to it are covered by what lies about them `[points]`.
const ROOM: f32 = 12.0;
/// Of the lower edge so many places are looked at beside its ends and its middle.
const PLACES: u8 = 8;
/// Width of what lies in the upper right corner, figures and legends, with some room `[points]`.
const CORNER: f32 = 296.0;
/// Beside a lesson a plot is no lower than this `[points]`.
pub(super) const LEAST: f32 = 70.0;

/// Where the panel lies: where few points are seen as it opens, then where it was dragged to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::app) struct PlotsAt {
    /// Its left lower corner `[points]`; `None`: it is to be found.
    pub(super) corner: Option<Pos2>,
    /// It was dragged, and stays there in other scenes too: whether worlds lay side by side then.
    dragged: Option<bool>,
    /// Its left lower corner while something else has its place `[points]`.
    aside: Option<Pos2>,
    /// It has to leave its place, and does not know yet where bodies are.
    leaves: bool,
    /// The view, and how much is probed and selected, when it was last looked whether it hides any of that.
    by: Option<(Pose, usize)>,
}

impl PlotsAt {
    /// Whether it was dragged to where it is, in a world that is alone or among worlds side by side.
    pub(in crate::app) fn is_dragged(self, is_beside: bool) -> bool {
        self.dragged == Some(is_beside)
    }

    /// It is dragged to a left lower corner `[points]`, there.
    pub(super) fn drag_to(&mut self, corner: Pos2, is_beside: bool) {
        (self.corner, self.dragged, self.aside) = (Some(corner), Some(is_beside), None);
    }

    /// Another scene, or the panel opens anew.
    pub(in crate::app) fn begin(&mut self) {
        self.aside = None;
        if self.dragged.is_none() {
            self.corner = None;
        }
    }

    /// Whether it looks for a place, and is to know where bodies are.
    pub(in crate::app) fn seeks(self) -> bool {
        self.corner.is_none() || self.leaves
    }

    /// Whether the view, or how much is probed and selected, is another one than it was.
    pub(in crate::app) fn is_of_another(&mut self, by: (Pose, usize)) -> bool {
        self.by.replace(by) != Some(by)
    }
}

/// The left lower corner, and how much lower it is, as of [`clear_of`]; while it has to lie elsewhere it stays where it went.
pub(super) fn make_way(
    (context, at): (&egui::Context, &mut PlotsAt),
    (corner, size): (Pos2, Vec2),
    (room, top): (Rect, f32),
    (taken, points): (&[Rect], &[Pos2]),
) -> Option<(Pos2, f32)> {
    if let Some(less) = lower_at(corner, size, taken) {
        (at.aside, at.leaves) = (None, false);
        return Some((corner, less));
    }
    let kept = at.aside.and_then(|aside| Some((aside, lower_at(aside, size, taken)?)));
    if let Some((aside, less)) = kept.filter(|(aside, _)| aside.x + size.x <= room.right() && aside.y <= room.bottom())
    {
        return Some((aside, less));
    }
    let went = clear_of(corner, size, (room, top), (taken, points));
    at.aside = went.map(|(aside, _)| aside).filter(|_| !points.is_empty());
    // Once more, with what is known of bodies.
    if points.is_empty() && !at.leaves {
        context.request_repaint();
    }
    at.leaves = points.is_empty();
    went
}

/// The same corner, further down where the panel would lie over what came to the right edge above `top` since; beside it where it is low.
pub(super) fn below_corner(corner: Pos2, size: Vec2, (room, top): (Rect, f32)) -> Pos2 {
    if corner.y - size.y >= top || corner.x + size.x < room.right() - CORNER {
        return corner;
    }
    match top + size.y <= room.bottom() {
        true => pos2(corner.x, top + size.y),
        false => pos2((room.right() - CORNER - size.x).max(room.left() + LEFT[0]), room.bottom()),
    }
}

/// The left lower corner of a panel of this size in a room, whose right edge is free from `top` on: of its places there, at the lower edge and
/// at the right one above, the first of those that the fewest points are in, where bodies are or have been.
pub(super) fn quiet((room, top): (Rect, f32), size: Vec2, points: &[Pos2]) -> Pos2 {
    let left = LEFT[usize::from(room.height() >= TALL)];
    let across = [room.left() + left, room.right() - size.x - LEFT[1], room.center().x - 0.5 * size.x];
    let [at_left, at_right, in_middle] = across.map(|x| pos2(x, room.bottom()));
    let above = pos2(at_right.x, (top + size.y).min(room.bottom()));
    let between = (1..PLACES).map(|k| at_left.lerp(at_right, f32::from(k) / f32::from(PLACES)));
    let places = [at_left, at_right, in_middle, above].into_iter().chain(between);
    places.min_by_key(|corner| covered(lying(*corner, size.x, size.y), points)).unwrap_or(at_left)
}

/// How much lower panels may be so that there is room for them: of what they have more than their least, these shares `[1]`.
const LOWER: [f32; 4] = [0.0, 0.25, 0.5, 1.0];

/// By how much a panel of this size with this left lower corner is to be lower, so that it lies over nothing that is `taken`; `None`: it lies over
/// it anyway `[points]`.
fn lower_at(corner: Pos2, size: Vec2, taken: &[Rect]) -> Option<f32> {
    let all = LOWER.map(|share| share * (size.y - HEAD - LEAST).max(0.0));
    all.into_iter().find(|less| is_free(&lying(corner, size.x, size.y - less), taken))
}

/// A panel with this left lower corner, so wide and high `[points]`.
fn lying(corner: Pos2, wide: f32, high: f32) -> Rect {
    Rect::from_min_size(corner - vec2(0.0, high), vec2(wide, high))
}

fn is_free(rect: &Rect, taken: &[Rect]) -> bool {
    !taken.iter().any(|other| other.expand(0.5 * APART).intersects(*rect))
}

/// How many points lie in it or close to it.
fn covered(rect: Rect, points: &[Pos2]) -> usize {
    let rect = rect.expand(ROOM);
    points.iter().filter(|point| rect.contains(**point)).count()
}

/// The left lower corner of a panel of this size in a room, where it lies over nothing that is `taken`: where it is, if it has a place there when
/// it is lower, else where the fewest points are, as high and as near to that as may be; and how much lower it is to be for that; `None`: there
/// is no place at all.
fn clear_of(
    corner: Pos2,
    size: Vec2,
    (room, top): (Rect, f32),
    (taken, points): (&[Rect], &[Pos2]),
) -> Option<(Pos2, f32)> {
    if let Some(less) = lower_at(corner, size, taken) {
        return Some((corner, less));
    }
    let at_right = room.right() - size.x - LEFT[1];
    let place = |less: f32| {
        let high = size.y - less;
        let beside = taken.iter().flat_map(|other| [other.right() + APART, other.left() - APART - size.x]);
        let across: Vec<f32> = beside.chain([corner.x, at_right]).collect();
        let over = taken.iter().flat_map(|other| [other.top() - APART, other.bottom() + APART + high]);
        let up: Vec<f32> = over.chain([corner.y, room.bottom(), top + high]).collect();
        let places = across.iter().flat_map(|x| up.iter().map(|y| pos2(*x, *y)));
        let has_room = |place: &Pos2| {
            let rect = lying(*place, size.x, high);
            // What was dragged over an edge may be over it still.
            let is_inside = room.left() <= rect.left() && rect.right() <= room.right() && room.top() <= rect.top();
            let is_inside = is_inside && (rect.top() >= top || rect.right() < room.right() - CORNER);
            is_inside && is_free(&rect, taken)
        };
        let places = places.filter(|place| place.y <= room.bottom().max(corner.y) && has_room(place));
        let ranked = places.map(|place| (covered(lying(place, size.x, high), points), place));
        let nearer = |a: &Pos2, b: &Pos2| a.distance(corner).total_cmp(&b.distance(corner));
        ranked.min_by(|(a, here), (b, there)| a.cmp(b).then_with(|| nearer(here, there)))
    };
    let all = LOWER.map(|share| share * (size.y - HEAD - LEAST).max(0.0));
    let found = all.into_iter().filter_map(|less| place(less).map(|(covered, place)| (covered, place, less)));
    found.min_by_key(|(covered, ..)| *covered).map(|(_, place, less)| (place, less))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_panel_opens_where_no_body_is() {
        let room = (Rect::from_min_size(pos2(0.0, 0.0), vec2(1280.0, 640.0)), 170.0);
        let size = vec2(358.0, 260.0);
        let heap = |x: f32| [pos2(x, 600.0), pos2(x + 20.0, 560.0), pos2(640.0, 100.0)];
        assert_eq!(quiet(room, size, &heap(640.0)).x, LEFT[0], "beside the tools, if nothing is there");
        assert_eq!(quiet(room, size, &heap(200.0)).x, 1280.0 - 358.0 - LEFT[1]);
        let both: Vec<Pos2> = heap(200.0).into_iter().chain(heap(1100.0)).collect();
        assert_eq!(quiet(room, size, &both).x, 640.0 - 179.0);
        let floor: Vec<Pos2> = (0..64).map(|k| pos2(20.0 * k as f32, 600.0)).collect();
        assert_eq!(quiet(room, size, &floor), pos2(1280.0 - 358.0 - LEFT[1], 170.0 + 260.0), "above, at the right");
    }

    #[test]
    fn where_there_is_no_room_beside_bodies_it_lies_over_what_moves_least() {
        let room = (Rect::from_min_size(pos2(0.0, 0.0), vec2(1280.0, 640.0)), 170.0);
        let size = vec2(358.0, 260.0);
        // Of four weights on springs the third stands still; a way is as many places as it is long.
        let way = |x: f32, count: u8| (0..count).map(move |k| pos2(x, 420.0 + 8.0 * f32::from(k)));
        let chain = (0..30).map(|k| pos2(1090.0, 60.0 + 18.0 * k as f32));
        let points: Vec<Pos2> = way(190.0, 9).chain(way(490.0, 6)).chain(way(790.0, 1)).chain(chain).collect();
        let at = quiet(room, size, &points);
        let rect = Rect::from_min_size(at - vec2(0.0, size.y), size);
        assert_eq!(points.iter().filter(|point| rect.contains(**point)).count(), 1, "{rect:?}");
        // Between two of them, where the room is wide enough.
        let apart: Vec<Pos2> = way(150.0, 9).chain(way(690.0, 6)).chain(way(1200.0, 6)).collect();
        let rect = Rect::from_min_size(quiet(room, size, &apart) - vec2(0.0, size.y), size);
        assert!(!apart.iter().any(|point| rect.contains(*point)), "{rect:?}");
    }

    #[test]
    fn the_panel_leaves_the_place_that_a_tool_takes_and_gets_lower_where_it_must() {
        let room = Rect::from_min_size(pos2(0.0, 0.0), vec2(1280.0, 640.0));
        let (size, corner) = (vec2(358.0, 298.0), pos2(LEFT[0], 640.0));
        let brush = Rect::from_min_size(pos2(70.0, 90.0), vec2(270.0, 400.0));
        assert_eq!(clear_of(corner, size, (room, 0.0), (&[], &[])), Some((corner, 0.0)));
        assert_eq!(
            clear_of(corner, size, (room, 0.0), (&[brush], &[])),
            Some((pos2(340.0 + APART, 640.0), 0.0)),
            "right of it"
        );
        let wide = brush.with_max_x(1270.0);
        assert_eq!(clear_of(corner, size, (room, 0.0), (&[wide], &[])), None, "there is no place below it");
        let above = wide.with_max_y(440.0);
        assert_eq!(
            clear_of(corner, size, (room, 0.0), (&[above], &[])),
            Some((corner, size.y - HEAD - LEAST)),
            "lower below it"
        );
    }

    #[test]
    fn what_makes_way_for_a_tool_goes_off_bodies_and_stays_there() {
        let context = egui::Context::default();
        let room = Rect::from_min_size(pos2(0.0, 0.0), vec2(1280.0, 640.0));
        let (size, corner) = (vec2(358.0, 298.0), pos2(LEFT[0], 640.0));
        let tool = Rect::from_min_size(pos2(70.0, 90.0), vec2(270.0, 540.0));
        let mut at = PlotsAt { corner: Some(corner), ..PlotsAt::default() };
        // A rod hangs beside the panel of the tool.
        let rod: Vec<Pos2> = (0..8).map(|k| pos2(500.0, 360.0 + 30.0 * k as f32)).collect();
        let mut go = |taken: &[Rect], points: &[Pos2]| {
            let place = make_way((&context, &mut at), (corner, size), (room, 0.0), (taken, points));
            (place, at.seeks())
        };
        assert!(go(&[tool], &[]).1, "where bodies are is to be known first");
        let (went, seeks) = go(&[tool], &rod);
        let (place, less) = went.unwrap_or_default();
        assert!(!seeks && covered(lying(place, size.x, size.y - less), &rod) == 0, "{place:?}");
        let other: Vec<Pos2> = rod.iter().map(|point| *point + (place.x + 100.0 - 500.0) * Vec2::X).collect();
        assert_eq!(go(&[tool], &other).0, went, "what comes below it moves it no more");
        assert_eq!(go(&[], &rod), (Some((corner, 0.0)), false), "back, once there is room");
    }
}
