//! Where panels lie, so that none lies over another, and what they leave to bodies and to numbers of the grid.

use egui::{Context, LayerId, Order, Rect, pos2};

use super::material::WHOLE;
use super::{GAP, TOOLS};

/// Along the lower edge lie the numbers of the grid `[points]`.
const NUMBERS: f32 = 26.0;
/// Room between what floats, and at the edges `[points]`.
pub(super) const APART: f32 = 6.0;
const EDGE: f32 = 10.0;
/// Below the buttons so much is for what is said: two lines, or three where they are short `[points]`.
const SAID: f32 = 58.0;
const SAID_NARROW: f32 = 78.0;
/// The caption of a scene is no higher than this `[points]`.
const MOST_SAID: f32 = 112.0;
/// From the tools to the numbers beside them `[points]`.
const BESIDE_TOOLS: f32 = TOOLS + 44.0;
/// Widest line of what is said, and the narrowest gap that it stands in `[points]`.
const WIDEST: f32 = 760.0;
const LEAST_SAID: f32 = 170.0;
/// The same beside a panel in a small window `[points]`.
const LEAST_CROWDED: f32 = 104.0;
/// From this width on what is said has two lines at most `[points]`.
const WORDS: f32 = 420.0;
/// Width of the usual picture in its heights `[1]`.
const USUAL: f32 = 1.3;
/// Narrower rooms have no place for panels on both sides `[points]`.
const NARROW: f32 = 900.0;
/// Lower ones keep none free beside a panel for what is said `[points]`.
const LOW: f32 = 520.0;
/// Nor do they begin lower than this share of the height `[1]`.
const LOWEST: f32 = 0.65;
/// From this height on, in its widths, bodies in a part of a window may fill its width `[1]`.
const HIGH: f32 = 0.4;
/// Bodies are not shown in less than this share of the width `[1]`.
const LEAST: f32 = 0.4;
/// The same beside a panel in a small window `[1]`.
const LEAST_BESIDE: f32 = 0.2;

/// What belongs to a tool has a room so high at least `[points]`.
const LEAST_HIGH: f32 = 110.0;

/// What the panels leave.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::app) struct Laid {
    /// Width and height of the world, above the bar below `[points]`: worlds side by side end where a panel at the edge begins.
    pub(in crate::app) size: [f32; 2],
    /// What lies in the upper right corner, its left lower corner `[points]`.
    pub(in crate::app) corner: Option<egui::Pos2>,
    /// Where what belongs to a tool begins and ends, beside the tools or at the right edge `[points]`.
    pub(in crate::app) column: Option<[f32; 2]>,
    /// How low that reaches at most, in windows higher than wide; `None`: as low as there is room `[points]`.
    pub(in crate::app) column_low: Option<f32>,
    /// Plots lie at an edge, or above a lesson: they do not float where there is room.
    pub(in crate::app) has_plots_at_edge: bool,
    /// Height of what stands above each of several worlds `[points]`.
    pub(in crate::app) titles: f32,
    /// Where nothing lies over it for long `[points]`; `None`: a sheet lies over all of it for now.
    pub(in crate::app) free: Option<Rect>,
}

/// The places that are taken, as panels are shown one after another `[points]`.
pub(super) struct Places {
    pub(super) room: Rect,
    /// The buttons at the top.
    pub(super) bar: Option<Rect>,
    /// Where the next thing at the right edge begins.
    pub(super) right: f32,
    /// Room above what is selected for a row of the figures that comes and goes with its bonds.
    pub(super) kept: f32,
    /// Where what lies at the lower edge begins.
    pub(super) below: f32,
    /// A sheet lies over all of it.
    pub(super) is_covered: bool,
    /// Numbers of the grid stand beside the tools.
    pub(super) has_numbers: bool,
    /// A panel lies beside the world where there is room for one alone.
    pub(super) is_crowded: bool,
}

impl Places {
    pub(super) fn new(room: Rect, is_covered: bool) -> Self {
        Places {
            room,
            bar: None,
            right: room.top() + EDGE,
            kept: 0.0,
            below: room.bottom() - NUMBERS,
            is_covered,
            has_numbers: false,
            is_crowded: false,
        }
    }

    /// Whether the window is higher than wide: what needs room lies at the lower edge then.
    pub(super) fn is_upright(&self) -> bool {
        self.room.width() < NARROW && self.room.height() > self.room.width()
    }

    /// Where the buttons end.
    pub(super) fn bar_bottom(&self) -> f32 {
        self.bar.map_or(self.room.top(), |bar| bar.bottom()) + APART
    }

    /// Something so wide comes to the right edge: below the buttons, where those go so far.
    pub(super) fn make_way(&mut self, width: f32) {
        if self.bar.is_some_and(|bar| bar.right() + APART > self.room.right() - EDGE - width) {
            self.right = self.right.max(self.bar_bottom());
        }
    }

    /// For a panel so wide at the right edge: below all else there, above the numbers.
    pub(super) fn beside(&mut self, width: f32) -> Rect {
        self.make_way(width + GAP);
        Rect::from_min_max(pos2(self.room.left(), self.right), pos2(self.room.right(), self.below))
    }

    /// Whether a panel lies along the lower edge.
    fn has_dock(&self) -> bool {
        self.below < self.room.bottom() - NUMBERS
    }

    /// Where what lies along the lower edge begins, with some room.
    fn above_dock(&self) -> f32 {
        if self.has_dock() { self.below - APART } else { self.below }
    }

    /// For a panel along the lower edge, above those that are there.
    pub(super) fn below_buttons(&self) -> Rect {
        Rect::from_min_max(pos2(self.room.left(), self.bar_bottom()), pos2(self.room.right(), self.above_dock()))
    }

    /// The rooms for the tools and what belongs to them, beside what takes so much of the right edge. Plots that float go out of the way of
    /// all but the tools; those along the lower edge keep their `strip`.
    pub(super) fn of_tools(&self, (plots, strip): (Option<Rect>, Option<f32>), at_right: f32) -> ToolRooms {
        let high = self.bar_bottom();
        let low = if self.has_dock() { self.below - APART } else { self.room.bottom() };
        let end = strip.map_or(self.above_dock(), |top| top - APART);
        let left =
            Rect::from_min_max(pos2(self.room.left(), high), pos2(self.room.right(), end.max(high + LEAST_HIGH)));
        let end = self.room.right() - EDGE - at_right;
        // Where the buttons go as far as what is selected is shown, that begins below them.
        let is_below = self.bar.is_some_and(|bar| bar.right() + APART > end - WHOLE);
        let top = if is_below { self.right.max(high) } else { self.right } + self.kept;
        let right = left.with_max_x(end).with_min_y(top.min(left.bottom() - LEAST_HIGH));
        let lies_below = plots.filter(|plots| plots.left() < self.room.left() + TOOLS);
        let lowest = lies_below.map_or(low, |plots| low.min(plots.top() - APART));
        // Bodies have the lower half for themselves.
        let half = self.is_upright().then_some(self.room.center().y).filter(|half| right.top() + 160.0 < *half);
        let right = half.map_or(right, |half| right.with_max_y(right.bottom().min(half)));
        ToolRooms { tools: self.room.with_max_y(low), lowest, left, right, half }
    }

    /// The same, left of what takes so much of the right edge.
    pub(super) fn low_beside(&self, at_right: f32) -> Rect {
        let low = self.low();
        low.with_max_x((low.right() - at_right).max(low.left() + LEAST * low.width()))
    }

    /// Whether so many worlds side by side are larger above plots of a height than beside those of a width, left of what takes so much of
    /// the right edge.
    pub(super) fn are_larger_above(&self, count: usize, at_right: f32, [wide, high]: [f32; 2]) -> bool {
        let (width, height) = (self.room.width() - at_right, self.room.height());
        let side = |width: f32, height: f32| {
            let of = |columns: usize| (width / columns as f32).min(height / count.div_ceil(columns) as f32);
            (1..=count).map(of).fold(0.0, f32::max)
        };
        side(width, height - high - NUMBERS) > side(width - wide - GAP, height)
    }

    /// Along the lower edge, right of the tools and left of what takes so much of the right edge.
    pub(super) fn low_strip(&self, at_right: f32) -> Rect {
        self.low_beside(at_right).with_min_x(self.room.left() + TOOLS + EDGE)
    }

    /// The room above what lies at the lower edge.
    pub(super) fn low(&self) -> Rect {
        self.room.with_max_y(self.below)
    }

    /// Where bodies are shown, below the ends of the caption and of titles, beside panels that take so much of the right edge, below titles so high, and where plots do not lie.
    pub(super) fn free(&self, (at_right, titles): (f32, f32), (ends, plots): ([f32; 2], Option<Rect>)) -> Rect {
        let (left, right) = (self.room.left() + TOOLS + EDGE, self.room.right() - EDGE);
        let at_right = if at_right > 0.0 { at_right + EDGE } else { 0.0 };
        let least = if self.is_crowded { LEAST_BESIDE } else { LEAST };
        let right = (right - at_right).max(left + least * (right - left));
        let said = match self.room.width() < NARROW {
            _ if self.is_crowded && self.room.height() < LOW => EDGE,
            true => SAID_NARROW,
            false => SAID,
        };
        let [caption, above] = ends;
        // What a tool's panel pushed down moves no body.
        let caption = caption.min(self.bar_bottom() + MOST_SAID);
        let lowest = self.room.top() + LOWEST * self.room.height();
        let top = (caption.max(self.bar_bottom() + said) + titles).max(above).min(lowest);
        let bottom = self.above_dock().max(top + 40.0);
        // In a part that is high bodies may be as wide as it: beside the numbers, not below them.
        let is_high = at_right == 0.0 && bottom - top > HIGH * (right - left);
        let left = if is_high && self.has_numbers { left + BESIDE_TOOLS - TOOLS } else { left };
        let all = Rect::from_min_max(pos2(left, top), pos2(right, bottom));
        plots.map_or(all, |plots| largest_beside(all, plots.expand(APART)))
    }

    /// The size of the world: of several side by side, beside what takes so much of the right edge, above what lies at the lower one, and
    /// above plots that begin there.
    pub(super) fn size(&self, at_right: f32, is_shared: bool, plots: Option<f32>) -> [f32; 2] {
        let [width, height] = [self.room.width(), self.room.height()];
        if !is_shared {
            return [width, height];
        }
        let high = if self.has_dock() { self.below - APART - self.room.top() } else { height };
        let high = plots.map_or(high, |top| high.min(top - APART - self.room.top()));
        [(width - at_right).max(LEAST * width), high.max(LEAST * height)]
    }

    /// The left lower corner of figures and legends.
    pub(super) fn corner(&self, context: &Context) -> Option<egui::Pos2> {
        let lie = ["figures", "legend"].into_iter().filter_map(|name| {
            let id = egui::Id::unique(name);
            let is_shown = |id| context.memory(|memory| memory.areas().is_visible(&LayerId::new(Order::Middle, id)));
            context.memory(|memory| memory.area_rect(id)).filter(|_| is_shown(id))
        });
        lie.map(|rect| rect.left_bottom()).reduce(|a, b| pos2(a.x.min(b.x), a.y.max(b.y)))
    }

    /// Where something is said, so high or lower: below the buttons, between what lies there. Returns the middle of its upper edge, and how
    /// wide it may be.
    pub(super) fn said(&self, context: &Context, top: f32) -> (egui::Pos2, f32) {
        let lie: Vec<Rect> =
            areas(context).into_iter().filter(|(layer, _)| is_in_the_way(*layer)).map(|(_, at)| at).collect();
        let room = self.room.with_max_x(self.room.right() - EDGE);
        let (left, least) = if self.is_crowded { (TOOLS + APART, LEAST_CROWDED) } else { (BESIDE_TOOLS, LEAST_SAID) };
        let room = room.with_min_x(self.room.left() + left);
        between((room, self.room.center().x), (&lie, least), top)
    }

    /// Where something is said of a sheet, down to a height: the middle of its lower edge, and how wide it may be.
    pub(super) fn said_below(&self, bottom: f32) -> (egui::Pos2, f32) {
        (pos2(self.room.center().x, bottom), WIDEST.min(self.room.width() - 2.0 * APART))
    }
}

/// Whether what is said goes aside for an area: not for its own lines, for titles, which go below them, nor for menus and tooltips.
fn is_in_the_way(layer: LayerId) -> bool {
    layer.order == Order::Middle && !super::notes::is_own(layer.id) && !super::beside::is_title(layer.id)
}

/// The middle of the upper edge of a line in a room from `top` on, and how wide it may be: in the widest gap between what lies there, as
/// near to `middle` as may be; below what leaves no gap that is `least` wide.
fn between((room, middle): (Rect, f32), (lie, least): (&[Rect], f32), top: f32) -> (egui::Pos2, f32) {
    let highest = top;
    let mut top = top;
    // Each time it goes below one of them at least.
    for _ in 0..=lie.len() {
        let beside =
            |high: f32| lie.iter().filter(|at| at.top() < top + high && at.bottom() > top).collect::<Vec<&Rect>>();
        let (left, right) = widest_gap(room, &beside(SAID));
        // In a narrow gap the same words take more lines.
        let beside = beside(if right - left < WORDS { MOST_SAID } else { SAID });
        let (left, right) = widest_gap(room, &beside);
        if right - left >= least {
            let width = (right - left).min(WIDEST);
            return (pos2(middle.clamp(left + 0.5 * width, right - 0.5 * width), top), width);
        }
        let Some(low) = beside.iter().map(|at| at.bottom()).min_by(f32::total_cmp) else { break };
        if low + APART > room.center().y {
            break;
        }
        top = low + APART;
    }
    // Where there is no room at all it lies over them.
    (pos2(middle, highest), WIDEST.min(room.width()))
}

/// The widest part of a room's width that nothing lies in.
fn widest_gap(room: Rect, lie: &[&Rect]) -> (f32, f32) {
    let mut taken: Vec<[f32; 2]> = lie.iter().map(|at| [at.left() - APART, at.right() + APART]).collect();
    taken.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut from, mut best) = (room.left(), (room.left(), room.left()));
    for [left, right] in taken.into_iter().chain([[room.right(); 2]]) {
        let end = left.min(room.right());
        if end - from > best.1 - best.0 {
            best = (from, end);
        }
        from = from.max(right);
    }
    best
}

/// The rooms for the tools, and for what belongs to the one that is taken: beside them, or at the right edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ToolRooms {
    pub(super) tools: Rect,
    /// How low the tools may reach.
    pub(super) lowest: f32,
    pub(super) left: Rect,
    pub(super) right: Rect,
    /// Where that at the right ends in windows higher than wide, if there is room in the upper half.
    pub(super) half: Option<f32>,
}

/// The part of a room above, below or beside what lies in it that a picture of usual shape is largest in.
fn largest_beside(room: Rect, taken: Rect) -> Rect {
    if !room.intersects(taken) {
        return room;
    }
    let size = |part: &Rect| (part.width() / USUAL).min(part.height());
    let parts = [
        room.with_max_y(taken.top()),
        room.with_min_y(taken.bottom()),
        room.with_min_x(taken.right()),
        room.with_max_x(taken.left()),
    ];
    parts.into_iter().max_by(|a, b| size(a).total_cmp(&size(b))).filter(|part| size(part) > 0.0).unwrap_or(room)
}

/// What is written beside something, as it lies in a room: on the other side of the pointer, if it stands near that, where it would run
/// out of the room; else as near as may be. What is out of it altogether stays there.
pub(in crate::app) fn kept_in(rect: Rect, pointer: Option<egui::Pos2>, room: Rect) -> Rect {
    if !rect.intersects(room) && pointer.is_none_or(|at| !rect.expand(NEAR_POINTER).contains(at)) {
        return rect;
    }
    let at = pointer.filter(|at| rect.expand(NEAR_POINTER).contains(*at));
    let along = |[from, to]: [f32; 2], at: Option<f32>, [least, most]: [f32; 2]| {
        let mirrored = at.map(|at| 2.0 * at - to).filter(|_| to > most || from < least);
        let size = to - from;
        let other = mirrored.filter(|start| *start >= least && start + size <= most);
        other.unwrap_or(from.min(most - size).max(least))
    };
    let x = along([rect.left(), rect.right()], at.map(|at| at.x), [room.left(), room.right()]);
    let y = along([rect.top(), rect.bottom()], at.map(|at| at.y), [room.top(), room.bottom()]);
    Rect::from_min_size(pos2(x, y), rect.size())
}

/// The part of a room about the pointer that no panel lies over, for what is written there; `None`: as it lies in the room no panel lies
/// over it, or it does not stand near the pointer. A panel that the pointer is over takes nothing away.
pub(in crate::app) fn clear_about(
    rect: Rect,
    pointer: Option<egui::Pos2>,
    (room, taken): (Rect, &[Rect]),
) -> Option<Rect> {
    let at = pointer.filter(|at| rect.expand(NEAR_POINTER).contains(*at))?;
    let lies = kept_in(rect, pointer, room);
    if !taken.iter().any(|panel| panel.intersects(lies)) {
        return None;
    }
    let without = |room: Rect, panel: &Rect| {
        if !room.intersects(*panel) {
            return room;
        }
        let parts = [
            room.with_min_x(panel.right() + APART),
            room.with_max_x(panel.left() - APART),
            room.with_min_y(panel.bottom() + APART),
            room.with_max_y(panel.top() - APART),
        ];
        let beside = parts.into_iter().filter(|part| part.expand(APART).contains(at));
        beside.max_by(|a, b| a.area().total_cmp(&b.area())).unwrap_or(room)
    };
    Some(taken.iter().fold(room, without))
}

/// What stands so near to the pointer goes with it `[points]`.
const NEAR_POINTER: f32 = 60.0;

/// All that floats, from below.
fn areas(context: &Context) -> Vec<(LayerId, Rect)> {
    context.memory(|memory| {
        let shown = memory.areas().visible_layer_ids();
        let floats = memory.layer_ids().filter(|layer| layer.order != Order::Background && shown.contains(layer));
        floats.filter_map(|layer| Some((layer, memory.area_rect(layer.id)?))).collect()
    })
}

/// What is read while one looks at the world, and lies over it: settings, lessons, plots at an edge, what is selected. Plots that float find a
/// place beside bodies by themselves.
const READ: [&str; 5] = ["settings", "lessons", "plots above", "plots below", "matter"];

/// Where what is read lies over the world: left, top, right and bottom of each `[px]`. `but`: not that one, which was dragged to where it lies.
pub(in crate::app) fn read(context: &Context, scale: f32, but: Option<&str>) -> Vec<[f64; 4]> {
    let rect = |name: &str| {
        let id = egui::Id::unique(name);
        let is_shown = context.memory(|memory| memory.areas().is_visible(&LayerId::new(Order::Middle, id)));
        context.memory(|memory| memory.area_rect(id)).filter(|_| is_shown)
    };
    let corners = |rect: Rect| [rect.left(), rect.top(), rect.right(), rect.bottom()];
    let all = READ.into_iter().filter(|name| Some(*name) != but).filter_map(rect).map(corners);
    all.map(|rect| rect.map(|side| f64::from((side * scale).round()))).collect()
}

/// What floats over the world: left, top, right and bottom of each `[px]`.
pub(in crate::app) fn covered(context: &Context, scale: f32) -> Vec<[f32; 4]> {
    let corners = |rect: Rect| [rect.left(), rect.top(), rect.right(), rect.bottom()].map(|x| x * scale);
    areas(context).into_iter().map(|(_, rect)| corners(rect)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_beside_the_pointer_goes_to_its_other_side_at_an_edge() {
        let room = Rect::from_min_max(pos2(0.0, 0.0), pos2(800.0, 600.0));
        let beside = |at: egui::Pos2| Rect::from_min_size(at + egui::vec2(18.0, 12.0), egui::vec2(200.0, 20.0));
        let kept = |at: egui::Pos2| kept_in(beside(at), Some(at), room);
        let middle = pos2(400.0, 300.0);
        assert_eq!(kept(middle), beside(middle));
        let at_right = kept(pos2(700.0, 300.0));
        assert_eq!([at_right.left(), at_right.right(), at_right.top()], [482.0, 682.0, 312.0], "at its left");
        let in_corner = kept(pos2(790.0, 590.0));
        assert_eq!([in_corner.right(), in_corner.bottom()], [772.0, 578.0]);
        let wide = Rect::from_min_size(pos2(420.0, 300.0), egui::vec2(700.0, 20.0));
        assert_eq!(kept_in(wide, Some(middle), room).right(), 800.0, "no side has room for it");
        let away = beside(pos2(900.0, 300.0));
        assert_eq!(kept_in(away, Some(middle), room), away, "it belongs to something out of view");
    }

    #[test]
    fn what_stands_beside_the_pointer_lies_off_panels() {
        let room = Rect::from_min_max(pos2(0.0, 0.0), pos2(640.0, 360.0));
        let bar = Rect::from_min_max(pos2(0.0, 0.0), pos2(640.0, 40.0));
        let panel = Rect::from_min_max(pos2(60.0, 46.0), pos2(330.0, 354.0));
        let at = pos2(400.0, 250.0);
        let beside = |width: f32| Rect::from_min_size(at + egui::vec2(16.0, -30.0), egui::vec2(width, 20.0));
        let clear = |rect: Rect| clear_about(rect, Some(at), (room, &[bar, panel]));
        assert_eq!(clear(beside(200.0)), None, "it has room where it is");
        let own = Rect::from_min_max(pos2(330.0 + APART, 40.0 + APART), room.max);
        assert_eq!(clear(beside(290.0)), Some(own));
        let lies = kept_in(beside(290.0), Some(at), own);
        assert!(own.contains_rect(lies) && !lies.intersects(panel), "{lies:?}");
        let away = Rect::from_min_size(pos2(100.0, 100.0), egui::vec2(50.0, 20.0));
        assert_eq!(clear(away), None, "it belongs to something below the panel");
    }

    #[test]
    fn what_is_said_stands_in_the_widest_gap_or_below_what_leaves_none() {
        let room = Rect::from_min_max(pos2(110.0, 0.0), pos2(1270.0, 650.0));
        let at = |left: f32, right: f32, bottom: f32| Rect::from_min_max(pos2(left, 60.0), pos2(right, bottom));
        let said = |lie: &[Rect]| between((room, 640.0), (lie, LEAST_SAID), 60.0);
        let (middle, width) = said(&[]);
        assert_eq!((middle, width), (pos2(640.0, 60.0), WIDEST));
        let (middle, width) = said(&[at(450.0, 694.0, 100.0)]);
        assert_eq!((middle.y, width), (60.0, 1270.0 - 700.0), "right of it");
        assert!(middle.x - 0.5 * width >= 700.0);
        let (middle, _) = said(&[at(110.0, 640.0, 100.0), at(660.0, 1200.0, 140.0)]);
        assert_eq!(middle.y, 106.0, "below the first, beside the second");
        let (middle, _) = said(&[at(110.0, 1200.0, 600.0)]);
        assert_eq!(middle.y, 60.0, "over what leaves no room at all");
    }

    #[test]
    fn bodies_are_shown_in_the_largest_part_beside_the_plots() {
        let room = Rect::from_min_max(pos2(76.0, 100.0), pos2(1270.0, 650.0));
        let at_left = Rect::from_min_max(pos2(76.0, 380.0), pos2(434.0, 650.0));
        assert_eq!(largest_beside(room, at_left), room.with_min_x(434.0));
        let along = Rect::from_min_max(pos2(10.0, 480.0), pos2(1200.0, 650.0));
        assert_eq!(largest_beside(room, along), room.with_max_y(480.0));
        assert_eq!(largest_beside(room, Rect::from_min_max(pos2(0.0, 0.0), pos2(60.0, 90.0))), room);
        assert_eq!(largest_beside(room, room.expand(9.0)), room, "there is no place beside it");
    }

    #[test]
    fn what_lies_along_the_lower_edge_takes_its_room_from_tools_and_bodies() {
        let mut places = Places::new(Rect::from_min_max(pos2(0.0, 0.0), pos2(720.0, 1236.0)), false);
        assert!(places.is_upright());
        assert_eq!(places.of_tools((None, None), 0.0).tools.bottom(), 1236.0);
        places.below = 700.0;
        let rooms = places.of_tools((None, None), 0.0);
        for bottom in [rooms.tools.bottom(), rooms.left.bottom(), places.free((0.0, 0.0), ([0.0; 2], None)).bottom()] {
            assert_eq!(bottom, 700.0 - APART);
        }
        assert_eq!(rooms.right.bottom(), 618.0, "the lower half is left to bodies");
        assert_eq!(places.below_buttons().bottom(), 700.0 - APART, "the next one lies above it");
        places.below = 1200.0;
        let left = |places: &Places| places.free((0.0, 0.0), ([0.0; 2], None)).left();
        let without = left(&places);
        places.has_numbers = true;
        assert!(left(&places) >= without + 40.0, "bodies do not lie on numbers of the grid");
    }
}
