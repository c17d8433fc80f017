//! What is said above worlds that lie side by side, and the menu that puts them there.

use std::sync::Arc;

use egui::{Area, Color32, Id, LayerId, Order, Popup, Rect, RichText, Sense, Ui, pos2, vec2};

use super::icons::{self, Icon};
use super::theme::{colors, floating};
use super::{Facts, Wish, legend, ticks};
use crate::render::Color;
use crate::scene::{MOST_BESIDE, SolverName};

/// Room about a title `[points]`.
const ROOM: f32 = 8.0;
/// Where titles are at most, from above `[points]`: below the buttons, in windows where these take several rows too.
const LEAST: f32 = 60.0;

/// Titles are this wide, in the narrowest parts too `[points]`.
const LEAST_WIDE: f32 = 90.0;

/// Why methods cannot run a scene is said in lines so long at most `[points]`.
const WIDEST: f32 = 260.0;

/// What is left beside a tool's panel for a title that stays there instead of going below it, at least; and the margins of a title `[points]`.
const BESIDE: f32 = 150.0;
const MARGINS: f32 = 20.0;

/// Length and width of the stroke before a title `[points]`.
const STROKE: [f32; 2] = [14.0, 3.0];

/// Heights of titles, and of the legend that the last one has `[points]`.
const TITLE: f32 = 50.0;
const LEGEND: f32 = 52.0;

/// Whether the last title has the legend of distances: a small window has no room for it beside a panel.
fn has_legend(facts: &Facts, is_crowded: bool) -> bool {
    facts.tints_distance && !is_crowded
}

/// How much of each part of the window its title takes from above `[points]`, however they stand.
pub(super) fn height(facts: &Facts, is_crowded: bool) -> f32 {
    match (facts.neighbors.is_empty(), has_legend(facts, is_crowded)) {
        (true, _) => 0.0,
        (false, false) => TITLE,
        (false, true) => TITLE + LEGEND,
    }
}

/// How much of each row a title takes from its upper edge on `[points]`.
pub(super) fn row(facts: &Facts, is_crowded: bool) -> f32 {
    if facts.neighbors.is_empty() { 0.0 } else { ROOM + height(facts, is_crowded) }
}

/// Titles go below what ends above this share of the window's height `[1]`.
const LOWEST: f32 = 0.6;

/// A world beside others, as it is called.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::app) struct Neighbor {
    pub(in crate::app) title: String,
    /// How it does.
    pub(in crate::app) words: String,
    /// The left upper corner of its part of the window, beside the tools `[points]`.
    pub(in crate::app) at: [f32; 2],
    /// Width of that edge `[points]`.
    pub(in crate::app) width: f32,
    /// That of its trails, where it has some.
    pub(in crate::app) color: Option<Color>,
    /// How many stand in a row.
    pub(in crate::app) columns: usize,
}

/// Titles of worlds, each in the corner of its part of the window; below what lies there already. The last has the legend. Returns where those
/// of the first row end `[points]`.
pub(super) fn titles(context: &egui::Context, facts: &Facts, (has_caption, is_crowded): (bool, bool)) -> f32 {
    let mut end = 0.0_f32;
    let lies = |name: &str| context.memory(|memory| memory.area_rect(Id::unique(name))).map_or(0.0, |at| at.bottom());
    let below = lies("scene").max(if has_caption { lies("caption") } else { 0.0 }).max(LEAST) + ROOM;
    let lies = |name: &str| {
        let id = Id::unique(name);
        let is_shown = |memory: &egui::Memory| memory.areas().is_visible(&LayerId::new(Order::Middle, id));
        context.memory(|memory| memory.area_rect(id).filter(|_| is_shown(memory)))
    };
    // What reaches far down leaves no room below it.
    let lowest = LOWEST * context.content_rect().height();
    let corner: Vec<Rect> = ["figures", "legend"].into_iter().filter_map(lies).collect();
    // What belongs to a tool moves no body.
    let of_tool: Option<Rect> = lies("matter").filter(|at| at.bottom() < lowest);
    let last = facts.neighbors.len().saturating_sub(1);
    let mut shown: Vec<Rect> = Vec::new();
    for (place, neighbor) in facts.neighbors.iter().enumerate() {
        let [x, y] = neighbor.at;
        let top = if place >= neighbor.columns { (y + ROOM).max(below) } else { below };
        let x = x + ROOM;
        // In narrow parts of a window, and in low ones below a caption, titles would lie on those before them.
        let wide = legend::WIDTH.min(neighbor.width - 3.0 * ROOM).max(LEAST_WIDE) + MARGINS;
        let top = shown.iter().fold(top, |top, at| {
            let lies_on = at.left() < x + wide && at.right() > x && at.top() < top + TITLE && at.bottom() > top;
            if lies_on { at.bottom() + ROOM } else { top }
        });
        // What lies in the corner is not covered.
        let reach = x + legend::WIDTH.min(neighbor.width);
        let below_it = |high: f32| {
            move |top: f32, at: &Rect| {
                let is_there = at.left() < reach && at.top() < top + high && at.bottom() > top;
                if is_there { at.bottom() + ROOM } else { top }
            }
        };
        let base = corner.iter().fold(top, below_it(TITLE));
        // The last one is as high as its legend makes it.
        let high = if place == last { height(facts, is_crowded) } else { TITLE };
        let is_lower = of_tool.iter().fold(base, below_it(high)) > base;
        // A narrower one has its place beside it.
        let room = of_tool.filter(|_| is_lower).map(|at| at.left() - ROOM - x);
        let beside = room.filter(|room| *room >= BESIDE);
        let top = if beside.is_some() { base } else { of_tool.iter().fold(base, below_it(high)) };
        let most =
            legend::WIDTH.min(neighbor.width - 3.0 * ROOM).min(beside.map_or(f32::INFINITY, |room| room - MARGINS));
        let area = Area::new(Id::unique(("beside", place))).fixed_pos(pos2(x, top));
        let title = area.interactable(false).show(context, |ui| {
            floating(ui).show(ui, |ui| {
                ui.set_max_width(most.max(LEAST_WIDE));
                ui.vertical(|ui| {
                    title(ui, neighbor);
                    if !neighbor.words.is_empty() {
                        ui.weak(&neighbor.words);
                    }
                    if has_legend(facts, is_crowded) && place == last {
                        legend::of_distance(ui, &facts.look);
                    }
                });
            });
        });
        if place < neighbor.columns {
            end = end.max(base + title.response.rect.height());
        }
        shown.push(title.response.rect);
    }
    end
}

/// Where the titles of the first row end, as they were shown last `[points]`; 0 where there are none.
pub(super) fn titles_end(context: &egui::Context, facts: &Facts) -> f32 {
    let first_row = facts.neighbors.iter().enumerate().filter(|(place, neighbor)| *place < neighbor.columns);
    let end = |(place, _)| {
        let id = Id::unique(("beside", place));
        let is_shown = context.memory(|memory| memory.areas().is_visible(&LayerId::new(Order::Middle, id)));
        context.memory(|memory| memory.area_rect(id)).filter(|_| is_shown).map_or(0.0, |at| at.bottom())
    };
    first_row.map(end).fold(0.0, f32::max)
}

/// What a world is called, behind a stroke in the colour of its trails.
fn title(ui: &mut Ui, neighbor: &Neighbor) {
    let words = RichText::new(&neighbor.title).color(colors(ui).text).strong();
    let Some(color) = neighbor.color else {
        ui.label(words);
        return;
    };
    let [red, green, blue, _] = color.map(|part| (255.0 * part).round() as u8);
    ui.horizontal(|ui| {
        let (at, _) =
            ui.allocate_exact_size(vec2(STROKE[0], ui.text_style_height(&egui::TextStyle::Body)), Sense::hover());
        let ends = [at.left_center(), at.right_center()];
        ui.painter().line_segment(ends, (STROKE[1], Color32::from_rgb(red, green, blue)));
        ui.add(egui::Label::new(words).wrap());
    });
}

/// Whether an area is such a title.
pub(super) fn is_title(id: Id) -> bool {
    (0..=MOST_BESIDE).any(|place| Id::unique(("beside", place)) == id)
}

/// Solvers, each with why the scene cannot be run by it, if it cannot.
pub(in crate::app) type Misfits = Arc<[(SolverName, Option<String>)]>;

/// The solvers that can be asked for: whose loop one `as printed` would be nothing says but a scene.
pub(in crate::app) fn solvers() -> impl Iterator<Item = SolverName> {
    let all = SolverName::NAMES.iter().filter_map(|name| name.parse().ok());
    all.filter(|solver| *solver != SolverName::AsPrinted)
}

/// Why the scene cannot be run by a solver, if it cannot.
pub(super) fn why_not(facts: &Facts, solver: SolverName) -> Option<&str> {
    facts.misfits.iter().find(|(other, _)| *other == solver).and_then(|(_, why)| why.as_deref())
}

/// Whether the scene is run by a solver now: beside itself it would show nothing.
fn runs_by(facts: &Facts, solver: SolverName) -> bool {
    facts.settings.scene.method.as_ref().is_some_and(|method| method.solver.name().parse() == Ok(solver))
}

fn is_open(facts: &Facts, solver: SolverName) -> bool {
    why_not(facts, solver).is_none()
}

/// A button for a solver, which says why where it can do nothing. Returns whether it was pressed.
fn choice(ui: &mut Ui, facts: &Facts, solver: SolverName, words: &str) -> bool {
    let button = ui.add_enabled(is_open(facts, solver), egui::Button::new(words));
    let pressed = button.clicked();
    if let Some(why) = why_not(facts, solver) {
        button.on_disabled_hover_text(format!("not for this scene: {why}"));
    }
    pressed
}

/// The solvers that cannot run the scene, folded away behind a line: those that lack the same thing are named together.
fn others(ui: &mut Ui, facts: &Facts) {
    let others: Vec<(SolverName, String)> =
        solvers().filter_map(|solver| Some((solver, reason(why_not(facts, solver)?)))).collect();
    if others.is_empty() {
        return;
    }
    ui.separator();
    ui.menu_button(RichText::new(format!("Not for this scene ({})", others.len())).color(colors(ui).weak), |ui| {
        ui.set_max_width(WIDEST);
        for (why, solvers) in by_reason(&others) {
            let why = if solvers.len() > 1 { format!("each {why}") } else { why.to_owned() };
            ui.label(RichText::new(solvers.join(", ")).color(colors(ui).text));
            ui.label(RichText::new(why).color(colors(ui).weak).size(12.0));
        }
    });
}

/// Solvers in words by why they cannot run the scene, the most common reason first.
fn by_reason(others: &[(SolverName, String)]) -> Vec<(&str, Vec<&'static str>)> {
    let mut groups: Vec<(&str, Vec<&'static str>)> = Vec::new();
    for (solver, why) in others {
        match groups.iter_mut().find(|(other, _)| other == why) {
            Some((_, solvers)) => solvers.push(solver.words()),
            None => groups.push((why, vec![solver.words()])),
        }
    }
    groups.sort_by_key(|(_, solvers)| std::cmp::Reverse(solvers.len()));
    groups
}

/// Of why a solver cannot run the scene what is no advice for its file, without its name: "knows no contact".
pub(super) fn reason(why: &str) -> String {
    let why = why.split(": ").next().unwrap_or(why);
    let named = why.split_once("solver ").and_then(|(before, rest)| Some((before, rest.split_once(' ')?.1)));
    match named {
        Some(("", reason)) => reason.to_owned(),
        Some((before, after)) => format!("{before}it {after}"),
        None => why.to_owned(),
    }
}

/// What the menu is called.
pub(super) const COMPARE: &str = "Compare…";

/// The menu of what is put beside the scene, and taken away; its name stands beside its sign where it has room.
pub(super) fn menu(ui: &mut Ui, has_name: bool, facts: &Facts, wishes: &mut Vec<Wish>) {
    let said = "the same start by another method beside this one, under the same mouse";
    let button = icons::worded(ui, Icon::Beside, COMPARE, (has_name, false));
    Popup::menu(&button).show(|ui| {
        ui.set_min_width(210.0);
        for (place, neighbor) in facts.neighbors.iter().skip(1).enumerate() {
            if ui.button(format!("Take away: {}", neighbor.title)).clicked() {
                wishes.push(Wish::TakeAway(place));
            }
        }
        if !facts.neighbors.is_empty() {
            let mut tints = facts.tints_distance;
            if ticks::check(ui, &mut tints, "colour by the distance").changed() {
                wishes.push(Wish::TintDistance(tints));
            }
            ui.separator();
        }
        if facts.neighbors.len() > MOST_BESIDE {
            ui.weak("there is no room for more");
            return;
        }
        ui.weak("put the same start beside it, by");
        let reference = if is_open(facts, SolverName::Rk8) { SolverName::Rk8 } else { SolverName::Auto };
        if choice(ui, facts, reference, "a reference: fine steps, 64 bits") {
            wishes.push(Wish::Beside(None));
        }
        for solver in solvers().filter(|solver| is_open(facts, *solver) && !runs_by(facts, *solver)) {
            if choice(ui, facts, solver, solver.words()) {
                wishes.push(Wish::Beside(Some(solver)));
            }
        }
        others(ui, facts);
    });
    button.on_hover_text(said);
}
