//! Where panels lie, so that none lies over another, and what they leave to bodies and to numbers of the grid.

use egui::{Context, LayerId, Order, Rect, pos2};

use super::{GAP, TOOLS};

/// Along the lower edge lie the numbers of the grid `[points]`.
const NUMBERS: f32 = 26.0;
/// Room between what floats, and at the edges `[points]`.
pub(super) const APART: f32 = 6.0;
const EDGE: f32 = 10.0;
/// Below the buttons so much is for what is said: two lines `[points]`.
const SAID: f32 = 58.0;
/// From the tools to the numbers beside them `[points]`.
const BESIDE_TOOLS: f32 = TOOLS + 44.0;
/// What begins nearer than this to the left edge lies below what stands beside the tools `[points]`.
const NEAR: f32 = 320.0;
/// Widest line of what is said `[points]`.
const WIDEST: f32 = 640.0;
/// Bodies are not shown in less than this share of the width `[1]`.
const LEAST: f32 = 0.4;

/// What the panels leave.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::app) struct Laid {
    /// Width and height of the world, above the bar below `[points]`: worlds side by side end where a panel at the edge begins.
    pub(in crate::app) size: [f32; 2],
    /// What lies in the upper right corner, its left lower corner `[points]`.
    pub(in crate::app) corner: Option<egui::Pos2>,
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
    /// Where what lies at the lower edge begins.
    pub(super) below: f32,
    /// A sheet lies over all of it.
    pub(super) is_covered: bool,
}

impl Places {
    pub(super) fn new(room: Rect, is_covered: bool) -> Self {
        Places { room, bar: None, right: room.top() + EDGE, below: room.bottom() - NUMBERS, is_covered }
    }

    /// Whether the window is higher than wide: what needs room lies at the lower edge then.
    pub(super) fn is_upright(&self) -> bool {
        self.room.width() < 900.0 && self.room.height() > self.room.width()
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

    /// For a panel at the right edge: below all else there, above the numbers.
    pub(super) fn beside(&mut self) -> Rect {
        self.make_way(super::lessons::WIDTH + GAP);
        Rect::from_min_max(pos2(self.room.left(), self.right), pos2(self.room.right(), self.below))
    }

    /// For a panel along the lower edge.
    pub(super) fn below_buttons(&self) -> Rect {
        Rect::from_min_max(pos2(self.room.left(), self.bar_bottom()), pos2(self.room.right(), self.below))
    }

    /// The room for the tools: above a panel along the lower edge, if there is one.
    pub(super) fn above(&self, has_panel: bool) -> Rect {
        let taken = if has_panel { super::lessons::LOW * self.room.height() + NUMBERS } else { 0.0 };
        self.room.with_max_y(self.room.bottom() - taken)
    }

    /// The room beside the tools: between the buttons and plots, if some lie there.
    pub(super) fn beside_tools(&self, plots: Option<Rect>) -> Rect {
        let low = plots
            .filter(|plots| plots.left() < self.room.left() + NEAR)
            .map_or(self.below, |plots| plots.top() - APART);
        let high = self.bar_bottom();
        Rect::from_min_max(pos2(self.room.left(), high), pos2(self.room.right(), low.max(high + 160.0)))
    }

    /// The same, left of what takes so much of the right edge.
    pub(super) fn low_beside(&self, at_right: f32) -> Rect {
        let low = self.low();
        low.with_max_x((low.right() - at_right).max(low.left() + LEAST * low.width()))
    }

    /// The room above what lies at the lower edge.
    pub(super) fn low(&self) -> Rect {
        self.room.with_max_y(self.below)
    }

    /// Where bodies are shown, beside panels that take so much of the right edge, and below titles so high.
    pub(super) fn free(&self, at_right: f32, titles: f32) -> Rect {
        let (left, right) = (self.room.left() + TOOLS + EDGE, self.room.right() - EDGE);
        let at_right = if at_right > 0.0 { at_right + EDGE } else { 0.0 };
        let right = (right - at_right).max(left + LEAST * (right - left));
        let top = (self.bar_bottom() + SAID + titles).min(self.room.center().y);
        let below = if self.below < self.room.bottom() - NUMBERS { self.below - APART } else { self.below };
        Rect::from_min_max(pos2(left, top), pos2(right, below.max(top + 40.0)))
    }

    /// The size of the world: of several side by side, beside what takes so much of the right edge, above what lies at the lower one.
    pub(super) fn size(&self, at_right: f32, is_shared: bool) -> [f32; 2] {
        let [width, height] = [self.room.width(), self.room.height()];
        if !is_shared {
            return [width, height];
        }
        let has_panel = self.below < self.room.bottom() - NUMBERS;
        let high = if has_panel { self.below - APART - self.room.top() } else { height };
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

    /// Where something is said, so high: below the buttons, between what lies at both sides there. Returns the middle of its upper edge,
    /// and how wide it may be.
    pub(super) fn said(&self, context: &Context, top: f32) -> (egui::Pos2, f32) {
        let (mut left, mut right) = (self.room.left() + BESIDE_TOOLS, self.room.right() - EDGE);
        let middle = self.room.center().x;
        for (id, rect) in areas(context) {
            let is_beside = rect.top() < top + SAID && rect.bottom() > top && !super::notes::is_own(id);
            if is_beside && rect.center().x < middle && rect.right() < middle {
                left = left.max(rect.right() + APART);
            } else if is_beside && rect.left() > middle {
                right = right.min(rect.left() - APART);
            }
        }
        // Where there is hardly any room between them it lies over them.
        let (left, right) = if right - left < 200.0 { (middle - 100.0, middle + 100.0) } else { (left, right) };
        let width = (right - left).min(WIDEST);
        (pos2(middle.clamp(left + 0.5 * width, right - 0.5 * width), top), width)
    }
}

/// All that floats, from below.
fn areas(context: &Context) -> Vec<(egui::Id, Rect)> {
    context.memory(|memory| {
        let shown = memory.areas().visible_layer_ids();
        let floats = memory.layer_ids().filter(|layer| layer.order != Order::Background && shown.contains(layer));
        floats.filter_map(|layer| Some((layer.id, memory.area_rect(layer.id)?))).collect()
    })
}

/// What floats over the world: left, top, right and bottom of each `[px]`.
pub(in crate::app) fn covered(context: &Context, scale: f32) -> Vec<[f32; 4]> {
    let corners = |rect: Rect| [rect.left(), rect.top(), rect.right(), rect.bottom()].map(|x| x * scale);
    areas(context).into_iter().map(|(_, rect)| corners(rect)).collect()
}
