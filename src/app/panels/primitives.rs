//! What the tool for building makes, beside the tools.

use egui::epaint::PathShape;
use egui::{
    Area, ComboBox, DragValue, Id, Painter, Pos2, Rect, RectAlign, Response, RichText, Shape, Stroke, Tooltip, Ui,
};

use super::choosing;
use super::folded::untitled;
use super::icons::{self, Icon};
use super::material::swatch;
use super::theme::{colors, floating};
use super::{Facts, Wish, low, ranged, ticks};
use crate::app::action::Primitive;
use crate::app::matter::Preset;
use crate::app::tools::{Fibre, Grain, Link, REACHES, is_of_space};
use crate::render::Look;

/// What each makes, and how.
fn words(primitive: Primitive) -> &'static str {
    match primitive {
        Primitive::Box => "a box: drag from corner to corner (Alt: from its middle)",
        Primitive::Disc => "a disc: drag from corner to corner of the square around it (Alt: from its middle)",
        Primitive::Rope => {
            "a rope: drag from end to end; it hangs where it began (Shift: it does not), and on points that it ends on"
        }
        Primitive::Cloth => {
            "a cloth: drag from corner to corner (Alt: from its middle); it hangs by its upper corners (Shift: it does not)"
        }
        Primitive::Rim => "a rim: drag from corner to corner of the square around it (Alt: from its middle)",
        Primitive::Figure => "a figure with joints: drag from its head to its feet, or from its feet up",
        Primitive::Frame => {
            "a box of four corners with both diagonals, soft or rigid: drag from corner to corner (Alt: from its middle)"
        }
        Primitive::Bonds => {
            "points and bonds: click or drag from point to point, also to those that are there; Enter, Esc or a second click \
             ends the chain"
        }
        Primitive::SolidBox => "an obstacle, a box: drag from corner to corner (Alt: from its middle)",
        Primitive::SolidCircle => {
            "an obstacle, a circle: drag from corner to corner of the square around it (Alt: from its middle)"
        }
        Primitive::Slope => "an obstacle, a plank as floor, slope or wall: drag along its upper side, to the right",
        Primitive::Plane => {
            "an obstacle, a plane without an end: drag along its surface; it is solid at the right hand of that"
        }
        Primitive::Polygon => {
            "an obstacle: click corner by corner; the first one, Enter or a second click closes it. Or draw around it"
        }
    }
}

/// Height of a row, and of the frame `[points]`.
const ROW: f32 = 38.0;
const FRAME: f32 = 10.0;

/// From the edge of the panel to what is said of what stands in it `[points]`.
const TO_TOOLTIP: f32 = 6.0;

/// Height of all that may stand below them: what drawn bonds are, the matters, and how fine they are `[points]`.
const BELOW: f32 = 310.0;

/// How many stand in a row, where there is so much height for all `[points]`.
fn columns(height: f32) -> usize {
    let rows = |columns: &usize| Primitive::ALL.len().div_ceil(*columns) as f32;
    (2..=4).find(|columns| rows(columns) * ROW + FRAME <= height).unwrap_or(4)
}

/// Shows them at the right of the tools, above the lower edge of a room; they may be folded.
pub(super) fn show(
    context: &egui::Context,
    (tools, room, can_fold): (Rect, Rect, bool),
    facts: &Facts,
    wishes: &mut Vec<Wish>,
) {
    let corner = tools.right_top() + egui::vec2(8.0, 0.0);
    // As many stand in a row whatever is chosen: none moves away under the pointer.
    let below = if facts.dimensions == 3 { 0.0 } else { BELOW };
    let columns = columns(room.bottom() - corner.y - below);
    let id = Id::unique("primitives");
    let edge = context.memory(|memory| memory.area_rect(id)).map_or(corner.x, |panel| panel.right());
    Area::new(id).fixed_pos(corner).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            let part = room.with_min_y(corner.y);
            low::within(ui, part, |ui| {
                untitled(ui, ("Build", can_fold), |ui| {
                    ui.spacing_mut().item_spacing.y = 4.0;
                    choices(ui, (columns, edge), facts, wishes);
                    if facts.primitive == Primitive::Bonds {
                        links(ui, edge, facts, wishes);
                    }
                    // What else is built in space are obstacles.
                    if facts.dimensions != 3 || matches!(facts.primitive, Primitive::Rope | Primitive::Cloth) {
                        matters(ui, edge, facts, wishes);
                    }
                });
            });
        });
    });
}

/// All that the scene has room for, in so many columns.
fn choices(ui: &mut Ui, (columns, edge): (usize, f32), facts: &Facts, wishes: &mut Vec<Wish>) {
    let is_there = |primitive: &Primitive| facts.dimensions != 3 || is_of_space(*primitive);
    let all: Vec<Primitive> = Primitive::ALL.into_iter().filter(is_there).collect();
    for row in all.chunks(columns) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            row.iter().for_each(|&primitive| choice(ui, (primitive, edge), facts, wishes));
        });
    }
}

/// What drawn bonds are made of.
fn links(ui: &mut Ui, edge: f32, facts: &Facts, wishes: &mut Vec<Wish>) {
    let mut links = facts.links;
    ui.separator();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        for link in Link::ALL {
            let words = match link {
                Link::Rod => "keeps its length",
                Link::Spring => "as soft as a soft box",
                Link::String => "gets no longer, and goes slack",
            };
            say(&ticks::one_of(ui, &mut links.link, link, link.name()), edge, words);
        }
    });
    let said =
        "a loop that is closed becomes a body between its sides (Shift does the same); off, it has its sides alone";
    say(&ticks::check(ui, &mut links.fills, "fill loops"), edge, said);
    let said = "a new point is bonded to the points within reach too, of the drawing and of others that no body covers: thin lines show it";
    say(&ticks::check(ui, &mut links.connects, "connect to neighbours"), edge, said);
    let [least, most] = REACHES;
    let field = |ui: &mut Ui| {
        let name = ui.label("reach");
        let field = DragValue::new(&mut links.reach).speed(1.0).suffix(" px").update_while_editing(false);
        ranged::field(ui, field, f64::from(least)..=f64::from(most), " px").labelled_by(name.id)
    };
    let field = ui.add_enabled_ui(links.connects, |ui| ui.horizontal(field).inner).inner;
    say(&field, edge, "how far away these may be, as it is seen");
    if links != facts.links {
        wishes.push(Wish::Links(links));
    }
}

/// Said of fineness, and where what is built has none.
const HOW_FINE: &str = "how many points it is made of, whatever its size; it is as stiff, and takes more time";
const NOT_FINE: &str = "of boxes, discs, rims and filled loops";

/// How finely what is filled is built.
fn fineness(ui: &mut Ui, (edge, width): (f32, f32), of: Primitive, grain: &mut Grain) {
    let name = ui.label(RichText::new("fineness").color(colors(ui).weak)).id;
    let list = |ui: &mut Ui| {
        let menu = ComboBox::from_id_salt("fineness").width(width).selected_text(grain.name()).show_ui(ui, |ui| {
            for other in Grain::ALL {
                if choosing::choice(ui, *grain == other, other.name()).clicked() {
                    *grain = other;
                }
            }
        });
        menu.response.labelled_by(name)
    };
    let menu = ui.add_enabled_ui(is_filled(of) && of != Primitive::Frame, list).inner;
    say(&menu, edge, HOW_FINE);
    beside(Tooltip::for_disabled(&menu), (menu.rect, edge), NOT_FINE);
}

/// Whether it is made of a matter; a loop of bonds is filled with Shift too.
fn is_filled(of: Primitive) -> bool {
    matches!(of, Primitive::Box | Primitive::Frame | Primitive::Disc | Primitive::Rim | Primitive::Bonds)
}

/// Said of matters where what is built is of none of them: of figures, and of all else.
const OF_FIGURES: &str = "a figure has rigid limbs: soft ones would not hold its joints";
const OF_ITS_OWN: &str = "for boxes, discs, rims and filled loops; ropes and cloths have others";

/// What is built is made of: of a rope or a cloth a fibre, of all else a matter. As many stand there whatever is built: nothing that was about
/// to be clicked goes away.
fn matters(ui: &mut Ui, edge: f32, facts: &Facts, wishes: &mut Vec<Wish>) {
    ui.separator();
    ui.label(RichText::new("made of").color(colors(ui).weak));
    let sides = (edge, ui.min_rect().width());
    let mut of = facts.built_of;
    match facts.primitive {
        Primitive::Rope => fibres(ui, sides, (Primitive::Rope, &facts.look), &mut of.rope),
        Primitive::Cloth => fibres(ui, sides, (Primitive::Cloth, &facts.look), &mut of.cloth),
        other => presets(ui, sides, other, &mut of.filled),
    }
    if facts.dimensions != 3 {
        fineness(ui, sides, facts.primitive, &mut of.grain);
    }
    if of != facts.built_of {
        wishes.push(Wish::BuildOf(of));
    }
}

/// What a rope or a cloth is made of.
fn fibres(ui: &mut Ui, (edge, width): (f32, f32), (of, look): (Primitive, &Look), chosen: &mut Fibre) {
    for fibre in Fibre::ALL {
        let button = swatch(ui, (fibre.name(of), fibre.color(of, look)), (*chosen == fibre, width));
        say(&button, edge, fibre.words());
        if button.clicked() {
            *chosen = fibre;
        }
    }
}

/// What is filled is made of.
fn presets(ui: &mut Ui, (edge, width): (f32, f32), of: Primitive, chosen: &mut Preset) {
    let is_of_any = is_filled(of);
    let why = if of == Primitive::Figure { OF_FIGURES } else { OF_ITS_OWN };
    // A cloth is something else that is built.
    for preset in Preset::ALL.into_iter().filter(|preset| *preset != Preset::Cloth) {
        let (kind, is_chosen) = ((preset.name(), preset.color()), is_of_any && *chosen == preset);
        let button = ui.add_enabled_ui(is_of_any, |ui| swatch(ui, kind, (is_chosen, width))).inner;
        say(&button, edge, preset.words());
        beside(Tooltip::for_disabled(&button), (button.rect, edge), why);
        if button.clicked() {
            *chosen = preset;
        }
    }
}

/// Says something of a button beside the panel, whose right edge is there: nothing that can be pressed lies below it.
fn say(button: &Response, edge: f32, words: &str) {
    beside(Tooltip::for_enabled(button), (button.rect, edge), words);
}

fn beside(mut tooltip: Tooltip<'_>, (button, edge): (Rect, f32), words: &str) {
    let anchor = button.with_max_x(edge.max(button.right()));
    tooltip.popup = tooltip.popup.anchor(anchor).align(RectAlign::RIGHT).gap(TO_TOOLTIP);
    tooltip.show(|ui| ui.label(words));
}

fn choice(ui: &mut Ui, (primitive, edge): (Primitive, f32), facts: &Facts, wishes: &mut Vec<Wish>) {
    let is_on = primitive == facts.primitive;
    let button = icons::button(ui, Icon::Primitive(primitive), primitive.name(), icons::TOOL, is_on);
    say(&button, edge, words(primitive));
    if button.clicked() {
        wishes.push(Wish::Build(primitive));
    }
}

/// Draws the sign of a primitive: bodies as lines, obstacles filled.
pub(super) fn paint(painter: &Painter, primitive: Primitive, at: &impl Fn(f32, f32) -> Pos2, stroke: Stroke) {
    let unit = at(1.0, 0.0).x - at(0.0, 0.0).x;
    let line = |points: &[(f32, f32)]| {
        painter.add(Shape::line(points.iter().map(|&(x, y)| at(x, y)).collect(), stroke));
    };
    let filled = |points: &[(f32, f32)]| {
        let points: Vec<Pos2> = points.iter().map(|&(x, y)| at(x, y)).collect();
        painter.add(Shape::Path(PathShape::convex_polygon(points, stroke.color, Stroke::NONE)));
    };
    let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)];
    match primitive {
        Primitive::Box => {
            line(&square);
            for k in [-0.33, 0.33] {
                line(&[(k, -1.0), (k, 1.0)]);
                line(&[(-1.0, k), (1.0, k)]);
            }
        }
        Primitive::Frame => {
            line(&square);
            line(&[(-1.0, -1.0), (1.0, 1.0)]);
            line(&[(-1.0, 1.0), (1.0, -1.0)]);
            for (x, y) in &square[..4] {
                painter.circle_filled(at(*x, *y), 0.27 * unit, stroke.color);
            }
        }
        Primitive::Disc => {
            painter.circle_stroke(at(0.0, 0.0), 1.05 * unit, stroke);
            line(&[(0.0, -1.0), (0.0, 1.0)]);
            line(&[(-1.0, 0.0), (1.0, 0.0)]);
        }
        Primitive::Rope => {
            let wave = (0..=16).map(|k| k as f32 / 8.0 - 1.0).map(|y| (0.45 * (3.0 * y).sin(), y));
            line(&wave.collect::<Vec<_>>());
            painter.circle_filled(at(-0.06, -1.0), 0.25 * unit, stroke.color);
        }
        Primitive::Cloth => {
            for k in [-1.0, 0.0, 1.0] {
                line(&[(k, -1.0), (0.8 * k, 1.0)]);
                line(&[(-1.0 + 0.1 * (k + 1.0), k), (1.0 - 0.1 * (k + 1.0), k)]);
            }
        }
        Primitive::Rim => {
            painter.circle_stroke(at(0.0, 0.0), 1.05 * unit, stroke);
            painter.circle_stroke(at(0.0, 0.0), 0.6 * unit, stroke);
        }
        Primitive::Figure => {
            painter.circle_stroke(at(0.0, -0.9), 0.32 * unit, stroke);
            line(&[(0.0, -0.55), (0.0, 0.25)]);
            line(&[(-0.75, 0.05), (0.0, -0.35), (0.75, 0.05)]);
            line(&[(-0.55, 1.2), (0.0, 0.25), (0.55, 1.2)]);
        }
        Primitive::Bonds => {
            line(&[(-1.0, 0.9), (-0.5, -0.7), (0.45, 0.3), (1.0, -0.9)]);
            for (x, y) in [(-1.0, 0.9), (-0.5, -0.7), (0.45, 0.3), (1.0, -0.9)] {
                painter.circle_filled(at(x, y), 0.27 * unit, stroke.color);
            }
        }
        Primitive::SolidBox => filled(&square[..4]),
        Primitive::SolidCircle => {
            painter.circle_filled(at(0.0, 0.0), 1.05 * unit, stroke.color);
        }
        Primitive::Slope => filled(&[(-1.1, 1.0), (1.1, -0.9), (1.1, 1.0)]),
        Primitive::Plane => {
            line(&[(-1.2, -0.2), (1.2, -0.2)]);
            [-0.6, 0.0, 0.6, 1.2].into_iter().for_each(|x| line(&[(x, -0.2), (x - 0.6, 0.7)]));
        }
        Primitive::Polygon => filled(&[(-1.1, -0.3), (-0.1, -1.1), (1.1, -0.5), (0.75, 1.0), (-0.7, 0.9)]),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;
    use crate::app::tools::{BuiltOf, Links};

    /// What is said of each covers neither the others nor the panel that they stand in.
    #[test]
    fn what_is_said_of_a_button_lies_beside_the_panel() {
        let facts = Facts { dimensions: 2, ..Facts::default() };
        let tools = Rect::from_min_size(Pos2::new(10.0, 100.0), egui::vec2(50.0, 400.0));
        let room = Rect::from_min_size(Pos2::ZERO, egui::vec2(1280.0, 720.0));
        let mut harness = Harness::builder().with_size(room.size()).build_ui(move |ui| {
            show(ui.ctx(), (tools, room, false), &facts, &mut Vec::new());
        });
        harness.run_steps(6);
        for primitive in Primitive::ALL {
            harness.get_by_label(primitive.name()).hover();
            harness.run_steps(12);
            let said = harness.get_by_label(words(primitive)).rect();
            let panel = harness.ctx.memory(|memory| memory.area_rect(Id::unique("primitives"))).unwrap();
            assert!(!said.intersects(panel), "{}: {said} over {panel}", primitive.name());
        }
    }

    /// The panel while this is built, and what was asked of it.
    fn panel(primitive: Primitive, dimensions: usize) -> Harness<'static, Vec<Wish>> {
        let facts = Facts { dimensions, primitive, ..Facts::default() };
        let tools = Rect::from_min_size(Pos2::new(10.0, 100.0), egui::vec2(50.0, 400.0));
        let room = Rect::from_min_size(Pos2::ZERO, egui::vec2(1280.0, 720.0));
        let shown = move |ui: &mut Ui, wishes: &mut Vec<Wish>| show(ui.ctx(), (tools, room, false), &facts, wishes);
        let mut harness = Harness::builder().with_size(room.size()).build_ui_state(shown, Vec::new());
        harness.run_steps(6);
        harness
    }

    #[test]
    fn points_are_connected_to_neighbours_by_a_switch_that_stands_with_the_bonds_alone() {
        let mut panel = panel(Primitive::Bonds, 2);
        panel.get_by_label("connect to neighbours").click();
        panel.run_steps(3);
        assert_eq!(*panel.state(), [Wish::Links(Links { connects: true, ..Links::default() })]);
        assert!(self::panel(Primitive::Box, 2).query_by_label("connect to neighbours").is_none());
    }

    #[test]
    fn a_frame_is_of_a_matter_and_has_no_fineness() {
        let mut panel = panel(Primitive::Frame, 2);
        panel.get_by_label("Steel").click();
        panel.run_steps(3);
        assert_eq!(*panel.state(), [Wish::BuildOf(BuiltOf { filled: Preset::Steel, ..BuiltOf::default() })]);
        panel.get_by_value("medium").click();
        panel.run_steps(3);
        assert!(panel.query_by_label("very fine").is_none(), "it has four corners");
    }

    #[test]
    fn ropes_and_cloths_have_a_choice_of_their_own_where_matters_stand() {
        let rubber = |primitive: Primitive| match primitive {
            Primitive::Rope => BuiltOf { rope: Fibre::Rubber, ..BuiltOf::default() },
            Primitive::Cloth => BuiltOf { cloth: Fibre::Rubber, ..BuiltOf::default() },
            _ => BuiltOf { filled: Preset::Rubber, ..BuiltOf::default() },
        };
        for (primitive, dimensions, others) in [
            (Primitive::Box, 2, ["Jelly", "Wood"]),
            (Primitive::Rope, 2, ["Cord", "Thread"]),
            (Primitive::Rope, 3, ["Cord", "Thread"]),
            (Primitive::Cloth, 2, ["Linen", "Gauze"]),
            (Primitive::Cloth, 3, ["Linen", "Gauze"]),
        ] {
            let mut panel = panel(primitive, dimensions);
            others.into_iter().for_each(|name| _ = panel.get_by_label(name));
            panel.get_by_label("Rubber").click();
            panel.run_steps(3);
            assert_eq!(*panel.state(), [Wish::BuildOf(rubber(primitive))], "{primitive:?} in {dimensions}");
        }
        let mut fine = panel(Primitive::Disc, 2);
        fine.get_by_value("medium").click();
        fine.run_steps(3);
        fine.get_by_label("very fine").click();
        fine.run_steps(3);
        assert_eq!(*fine.state(), [Wish::BuildOf(BuiltOf { grain: Grain::VeryFine, ..BuiltOf::default() })]);
        let mut figure = panel(Primitive::Figure, 2);
        figure.get_by_label("Rubber").click();
        figure.run_steps(3);
        assert!(figure.state().is_empty(), "its limbs are rigid");
        assert!(panel(Primitive::SolidCircle, 3).query_by_label("Rubber").is_none(), "it is an obstacle");
    }
}
