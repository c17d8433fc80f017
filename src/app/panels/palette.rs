//! The tools, at the left edge.

use egui::{Align2, Area, Id, LayerId, Order, Rect, RectAlign, Tooltip, Vec2, vec2};

use super::icons::{self, Icon};
use super::places::ToolRooms;
use super::theme::floating;
use super::{Facts, PanelState, Room, Wish, brush, described, drives, low, material, primitives, push};
use crate::app::action::{Action, Tool};
use crate::app::tools::PushWay;

/// Their height before they were shown `[points]`.
const HEIGHT: f32 = 418.0;

/// Between two tools, and how high each is at least: in a lower window they are scrolled `[points]`.
const BETWEEN: f32 = 3.0;
const LEAST: f32 = 22.0;

/// Rooms from this height on have them named: all of them take three quarters of it `[points]`.
const NAMED: f32 = 740.0;

/// From a tool to what is said of it, beyond the edge of the panel `[points]`.
const TO_TOOLTIP: f32 = 14.0;

/// The sign of a tool and what it does.
fn words(tool: Tool) -> (Icon, &'static str) {
    match tool {
        Tool::Hand => (Icon::Hand, "grab and throw; beside bodies, push"),
        Tool::Pin => (Icon::Pin, "pin a point, or let it go"),
        Tool::Cut => (Icon::Cut, "cut the bonds that a stroke crosses"),
        Tool::Erase => (Icon::Erase, "take away bodies, bonds and obstacles: click, or drag over them"),
        Tool::Select => (Icon::Select, "select, move, turn and scale bodies and obstacles; what they are made of"),
        Tool::Build => (Icon::Build, "build: drag a body or an obstacle out"),
        Tool::Muscle => (Icon::Muscle, "make a bond a muscle: it gets longer and shorter"),
        Tool::Paint => (
            Icon::Brush,
            "a brush that makes bodies of jelly, rubber, cloth, wood or steel, or gives them single numbers",
        ),
        Tool::Push => (Icon::Push, "a force that stays: drag an arrow from a body"),
        Tool::Motor => (Icon::Motor, "hinge a body to another or to the ground, with a motor"),
    }
}

/// What a tool is called below its sign.
fn short(tool: Tool) -> &'static str {
    match tool {
        Tool::Hand => "Hand",
        Tool::Pin => "Pin",
        Tool::Cut => "Cut",
        Tool::Erase => "Erase",
        Tool::Build => "Build",
        Tool::Select => "Select",
        Tool::Muscle => "Muscle",
        Tool::Motor => "Motor",
        Tool::Paint => "Brush",
        Tool::Push => "Force",
    }
}

/// The last of them: the tool for forces, set to wind.
const WIND: &str = "wind: drag an arrow through the air";

/// How large each is, so that all are seen in a room that is so high.
fn size(high: f32) -> Vec2 {
    let count = Tool::ALL.len() as f32 + 1.0;
    let each = ((high - low::FRAME + BETWEEN) / count - BETWEEN).floor();
    vec2(icons::TOOL.x, if has_names(high) { icons::TOOL.y + icons::CAPTION } else { each.clamp(LEAST, icons::TOOL.y) })
}

/// Whether they are named below their signs in a room that is so high: lower ones are for bodies.
fn has_names(high: f32) -> bool {
    high >= NAMED
}

/// A button with what is said of it beside it: below it lies the next one. What the scene lacks for it is said in place of that.
fn choice(
    ui: &mut egui::Ui,
    (sign, name, short): (Icon, &str, Option<&str>),
    action: Action,
    (lack, is_on, size): (Option<&str>, bool, Vec2),
    wishes: &mut Vec<Wish>,
) {
    let said = described(name, action);
    let add = |ui: &mut egui::Ui| icons::captioned(ui, sign, (name, short), size, is_on);
    let button = ui.add_enabled_ui(lack.is_none(), add).inner;
    let why = lack.unwrap_or_default();
    for (mut tooltip, words) in [(Tooltip::for_enabled(&button), &*said), (Tooltip::for_disabled(&button), why)] {
        tooltip.popup = tooltip.popup.align(RectAlign::RIGHT).gap(TO_TOOLTIP);
        tooltip.show(|ui| ui.label(words));
    }
    if button.clicked() {
        wishes.push(Wish::Act(action));
    }
}

/// The name of the panel that belongs to a tool, if it has one.
fn name_of(tool: Tool) -> Option<&'static str> {
    match tool {
        Tool::Build => Some("primitives"),
        Tool::Muscle | Tool::Motor => Some("drives"),
        Tool::Select => Some("matter"),
        Tool::Push => Some("push"),
        Tool::Paint => Some("brush"),
        Tool::Hand | Tool::Pin | Tool::Cut | Tool::Erase => None,
    }
}

/// Whether a panel belongs to a tool.
pub(super) fn has_panel(tool: Tool) -> bool {
    name_of(tool).is_some()
}

/// Where what belongs to a tool lies, if it is shown `[points]`.
pub(super) fn of_tool(context: &egui::Context, tool: Tool) -> Option<Rect> {
    let id = Id::unique(name_of(tool)?);
    let layer = LayerId::new(Order::Middle, id);
    context.memory(|memory| memory.area_rect(id).filter(|_| memory.areas().is_visible(&layer)))
}

/// The tools, as what belongs to one of them stands beside them: as high as they, or so much higher that all of it is above the lower edge
/// of a room.
fn beside(context: &egui::Context, tools: Rect, room: Rect, tool: Tool) -> Rect {
    let high = of_tool(context, tool).map_or(0.0, |rect| rect.height());
    tools.with_min_y(tools.top().min(room.bottom() - high).max(room.top().min(tools.top())))
}

/// Shows them, and what belongs to the one that is taken, if that `has_panel`. Returns where that begins and ends, of what grows with what is
/// selected `[points]`.
pub(super) fn show(
    context: &egui::Context,
    rooms: &ToolRooms,
    (state, has_panel): (&mut PanelState, bool),
    facts: &Facts,
    wishes: &mut Vec<Wish>,
) -> Option<[f32; 2]> {
    let id = Id::unique("tools");
    let part = rooms.left.with_max_y(rooms.lowest);
    let height = context.memory(|memory| memory.area_rect(id)).map_or(HEIGHT, |rect| rect.height());
    // In the middle, but above plots that lie there and below the buttons.
    let middle = rooms.tools.center().y.min(rooms.lowest - 0.5 * height).max(rooms.left.top() + 0.5 * height);
    let place = Area::new(id).anchor(Align2::LEFT_CENTER, [10.0, middle - context.content_rect().center().y]);
    let shown = place.show(context, |ui| {
        floating(ui).show(ui, |ui| {
            low::within(ui, part, |ui| {
                ui.spacing_mut().item_spacing.y = BETWEEN;
                let (size, has_names) = (size(part.height()), has_names(part.height()));
                let blows = facts.tool == Tool::Push && facts.push == PushWay::Wind;
                for tool in Tool::ALL {
                    let (sign, name) = words(tool);
                    let lack = match tool {
                        Tool::Muscle => facts.no_muscles.as_deref(),
                        Tool::Motor => facts.no_motors.as_deref(),
                        _ => None,
                    };
                    let is_on = tool == facts.tool && !blows;
                    let short = has_names.then(|| short(tool));
                    choice(ui, (sign, name, short), Action::Take(tool), (lack, is_on, size), wishes);
                }
                let short = has_names.then_some("Wind");
                choice(ui, (Icon::Wind, WIND, short), Action::Wind, (None, blows, size), wishes);
            })
        });
    });
    if !has_panel {
        return None;
    }
    let can_fold = state.room == Room::One;
    if facts.tool == Tool::Build {
        primitives::show(context, (shown.response.rect, rooms.left, can_fold), facts, wishes);
    }
    let tools = beside(context, shown.response.rect, rooms.left, facts.tool);
    let part = rooms.left.with_max_y(rooms.left.bottom().min(rooms.tools.bottom()));
    if matches!(facts.tool, Tool::Muscle | Tool::Motor) {
        drives::show(context, (tools, part, can_fold), facts, wishes);
    }
    match facts.tool {
        Tool::Select => {
            let beside_tools = egui::pos2(shown.response.rect.right() + 8.0, rooms.right.top());
            let place = (rooms.right, beside_tools, rooms.half.is_some());
            return material::show(context, place, state, facts, wishes);
        }
        Tool::Push => push::show(context, (tools, part, can_fold), facts, wishes),
        Tool::Paint => brush::show(context, (tools, part, can_fold), facts, wishes),
        _ => {}
    }
    None
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;

    /// What is written on the tools in a window so high, and how high all of them are.
    fn tools(high: f32) -> (Vec<String>, f32) {
        let room = Rect::from_min_size(egui::Pos2::ZERO, vec2(1280.0, high));
        let rooms = ToolRooms { left: room, tools: room, right: room, lowest: high, half: None };
        let mut harness = Harness::builder().with_size(room.size()).build_ui(move |ui| {
            let facts = Facts { dimensions: 2, ..Facts::default() };
            show(ui.ctx(), &rooms, (&mut PanelState::default(), false), &facts, &mut Vec::new());
        });
        harness.run_steps(4);
        assert_eq!(harness.get_all_by_role(egui::Role::Button).count(), 11);
        let texts = harness.output().shapes.iter().filter_map(|clipped| match &clipped.shape {
            egui::Shape::Text(text) => Some(text.galley.text().to_owned()),
            _ => None,
        });
        let texts = texts.collect();
        let high = harness.ctx.memory(|memory| memory.area_rect(Id::unique("tools"))).unwrap().height();
        (texts, high)
    }

    #[test]
    fn tools_are_named_where_the_window_is_high_and_smaller_ones_keep_their_room() {
        let (named, high) = tools(1000.0);
        let all = ["Hand", "Pin", "Cut", "Erase", "Build", "Select", "Muscle", "Motor", "Brush", "Force", "Wind"];
        assert_eq!(named, all);
        assert!(high < 0.76 * NAMED, "{high}");
        assert!(tools(720.0).0.is_empty() && tools(720.0).1 < 430.0, "{:?}", tools(720.0));
        assert!(tools(360.0).0.is_empty() && tools(360.0).1 <= 360.0);
    }
}
