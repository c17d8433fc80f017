//! Plots at the bottom left: the energies of the world over time, and what the probes measure.

use egui::collapsing_header::CollapsingState;
use egui::{
    Align, Align2, Area, AsIdSalt, Color32, Id, LayerId, Layout, Order, Pos2, Rect, RichText, Sense, Ui, pos2, vec2,
};
use egui_plot::{AxisHints, GridInput, GridMark, HoverPosition, Line, Plot, PlotPoints};

use super::choosing::choice;
use super::places::APART;
use super::plots_at::{LEAST, LEFT, PlotsAt, below_corner, make_way, quiet};
use super::theme::{Colors, colors, floating};
use super::{Wish, described};
use crate::app::action::Action;
use crate::app::player::{Measured, Probe};
use crate::app::plots::{Curve, Kind, Plots, Quantity, Series, Subject, svg};

/// Width and greatest height of a plot `[points]`.
const SIZE: [f32; 2] = [340.0, 180.0];
/// Width of its panel `[points]`.
pub(super) const WIDTH: f32 = SIZE[0] + 18.0;
/// Lines of the grid lie so far apart at least, as a share of the plot `[1]`, and so far that a number has room between them `[points]`.
const LINES: f64 = 1.0 / 5.0;
const NUMBER: [f32; 2] = [50.0, 16.0];
/// Along the lower edge a plot takes this share of the height `[1]`.
const LOW: f32 = 0.18;
/// Its frame, header, choices and names, above the plot `[points]`; those of one that has its choices in the header.
pub(super) const HEAD: f32 = 118.0;
const SHORT: f32 = 86.0;
/// In a small window: what half of its width has more than a plot, its least width and its least height `[points]`; and the greatest height, unless
/// three tenths of the room are more `[points]`.
const SMALL: [f32; 3] = [70.0, 200.0, 40.0];
const LOW_SMALL: f32 = 90.0;
/// Width of what was measured once alone `[points]`.
const DOT: f32 = 7.0;
/// So high a menu of quantities shows all of them `[points]`.
const MENU: f32 = 400.0;
/// Half of the room less this is free for the plot: the primitives beside the tools end there `[points]`.
const OTHERS: f32 = 165.0;

/// How wide curves are that may lie on each other, so that those below are seen beside those above `[points]`: of energies the last one, and how much
/// wider than the next each before it is, as far as the first is not too wide; and the two of probes.
const OF_ENERGIES: [f32; 3] = [1.2, 1.13, 5.6];
const OF_PROBES: [f32; 2] = [2.8, 1.4];

/// How wide the curve of a kind of energy is, in their order, of so many `[points]`.
fn of_energy(place: usize, count: usize) -> f32 {
    let [last, wider, widest] = OF_ENERGIES;
    let others = count.saturating_sub(1).max(1) as f32;
    last + wider.min((widest - last) / others) * count.saturating_sub(1 + place) as f32
}
/// How wide a curve is that is alone `[points]`.
const ALONE: f32 = 1.5;

/// How wide the curve of a probe is `[points]`.
fn of_probe(plots: &Plots, place: usize) -> f32 {
    if plots.probes().iter().all(Option::is_some) { OF_PROBES[place] } else { ALONE }
}

/// Kinds of energy with the colour and the width of the curve of each, in the order in which they are drawn.
pub(super) fn of_energies(plots: &Plots, colors: &Colors) -> Vec<(Kind, Color32, f32)> {
    let color = |kind: &Kind| kind.color.map_or(colors.text, |place| colors.energies[place]);
    in_their_widths(plots).map(|(kind, width)| (kind, color(&kind), width)).collect()
}

fn in_their_widths(plots: &Plots) -> impl Iterator<Item = (Kind, f32)> {
    let kinds = plots.kinds();
    let count = kinds.len();
    kinds.into_iter().enumerate().map(move |(place, kind)| (kind, of_energy(place, count)))
}

/// What its place depends on.
pub(super) struct Seat<'a> {
    /// Where bodies are, while it looks for a place `[points]`.
    pub(super) points: &'a [Pos2],
    pub(super) at: &'a mut PlotsAt,
    /// It takes room from worlds that lie side by side.
    pub(super) is_docked: bool,
    /// Worlds lie side by side.
    pub(super) is_beside: bool,
}

/// Shows it in a room whose right edge is free from `top` on `[points]`: where few points are, or, if it is docked, at the right edge; off what is taken, by what
/// belongs to a tool and by keys that are to be held; not at all where that leaves no room for it. Returns where it lies `[points]`.
pub(super) fn show(
    context: &egui::Context,
    (room, top): (Rect, f32),
    (plots, seat, taken): (&mut Plots, Seat<'_>, Vec<Rect>),
    wishes: &mut Vec<Wish>,
) -> Option<Rect> {
    let Seat { points, at, is_docked, is_beside } = seat;
    let id = area_id();
    let high = if is_docked { SIZE[1] } else { (0.5 * room.height() - OTHERS).clamp(70.0, SIZE[1]) };
    let lay = context.memory(|memory| memory.area_rect(id));
    let size = lay.map_or(vec2(WIDTH, high + HEAD), |rect| rect.size());
    // In the frame in which it opens it is not known yet where bodies are.
    let found = || quiet((room, top), size, points);
    let corner = match is_docked {
        true => pos2(room.right() - size.x - LEFT[1], room.bottom()),
        false => at.corner.unwrap_or_else(found),
    };
    at.corner = at.corner.or_else(|| (!points.is_empty() && !is_docked).then(found));
    // What belongs to a tool has the place that it takes; a folded panel is as low as it is. Where it lies does not depend on how low it was made.
    let is_folded = size.y < HEAD;
    let whole = vec2(size.x, if is_folded { size.y } else { size.y.max(high + HEAD) });
    let corner =
        pos2(corner.x.min(room.right() - size.x - APART), corner.y.max(room.top() + whole.y).min(room.bottom()));
    let corner = if at.is_dragged(is_beside) { corner } else { below_corner(corner, whole, (room, top)) };
    let (corner, less) = make_way((context, at), (corner, whole), (room, top), (&taken, points))?;
    let high = (high - less).max(LEAST);
    // A click inside it is no drag.
    let area = Area::new(id).pivot(Align2::LEFT_BOTTOM).current_pos(corner).movable(true);
    let shown =
        area.sense(Sense::CLICK | Sense::DRAG).show(context, |ui| panel(ui, ([SIZE[0], high], false), plots, wishes));
    if shown.response.dragged() {
        at.drag_to(shown.response.rect.left_bottom(), is_beside);
    }
    // It was laid by how high it was before.
    if (shown.response.rect.height() - size.y).abs() > SAME {
        context.request_repaint();
    }
    Some(shown.response.rect)
}

/// Heights that differ by less are the same `[points]`.
const SAME: f32 = 0.5;

fn area_id() -> Id {
    Id::unique("plots")
}

/// Where the panel that floats lies, if it is shown `[points]`.
pub(in crate::app) fn lie(context: &egui::Context) -> Option<Rect> {
    let layer = LayerId::new(Order::Middle, area_id());
    context.memory(|memory| memory.area_rect(area_id()).filter(|_| memory.areas().is_visible(&layer)))
}

/// Shows it at the lower right corner of a room, as wide and as high as that, beside what takes so much of the right edge `[points]`.
pub(super) fn show_above(
    context: &egui::Context,
    (room, at_edge, width): (Rect, f32, f32),
    plots: &mut Plots,
    wishes: &mut Vec<Wish>,
) {
    let is_short = is_short(width, plots);
    let high = (room.height() - head(is_short)).clamp(LEAST, SIZE[1]);
    let corner = room.right_bottom() - vec2(10.0 + at_edge, 0.0);
    let area = Area::new(Id::unique("plots above")).pivot(Align2::RIGHT_BOTTOM).fixed_pos(corner);
    area.show(context, |ui| panel(ui, ([width, high], is_short), plots, wishes));
}

/// Width of a plot in a room that is small `[points]`: the world keeps half of it.
pub(super) fn small_width(room: Rect) -> f32 {
    (0.5 * room.width() - SMALL[0]).clamp(SMALL[1], SIZE[0])
}

/// Shows it at the lower right corner of a room that is small. Returns where it lies `[points]`.
pub(super) fn show_small(context: &egui::Context, room: Rect, plots: &mut Plots, wishes: &mut Vec<Wish>) -> Rect {
    let width = small_width(room);
    let is_short = is_short(width, plots);
    let high = (room.height() - head(is_short)).clamp(SMALL[2], LOW_SMALL.max(0.3 * room.height()));
    let area = Area::new(Id::unique("plots below")).pivot(Align2::RIGHT_BOTTOM);
    let area = area.fixed_pos(room.right_bottom() - vec2(LEFT[1], 0.0));
    area.show(context, |ui| panel(ui, ([width, high], is_short), plots, wishes)).response.rect
}

/// Whether a panel with a plot so wide `[points]` has its choices in its header: a narrow one has no room for them there, nor for those of two probes,
/// which are against each other too. They have a row of their own then.
fn is_short(width: f32, plots: &Plots) -> bool {
    width - ARROW >= WITH_CHOICES && plots.probes().iter().flatten().count() < 2
}

/// What is above the plot `[points]`.
fn head(is_short: bool) -> f32 {
    if is_short { SHORT } else { HEAD }
}

/// About how high the panel is beside a lesson at least, with a plot so wide `[points]`.
pub(super) fn least_above(width: f32, plots: &Plots) -> f32 {
    LEAST + head(is_short(width, plots))
}

/// Shows it along the lower edge of a room. Returns where it lies `[points]`.
pub(super) fn show_below(context: &egui::Context, room: Rect, plots: &mut Plots, wishes: &mut Vec<Wish>) -> Rect {
    let size = [(room.width() - 36.0).max(180.0), low(room)];
    let area = Area::new(Id::unique("plots below")).pivot(Align2::CENTER_BOTTOM).fixed_pos(room.center_bottom());
    area.show(context, |ui| panel(ui, (size, false), plots, wishes)).response.rect
}

/// Height of a plot there `[points]`.
fn low(room: Rect) -> f32 {
    (LOW * room.height()).clamp(70.0, SIZE[1])
}

/// About how high the panel is there `[points]`.
pub(super) fn low_height(room: Rect) -> f32 {
    low(room) + HEAD
}

/// The panel with a plot of this size: a short one has its choices in the header.
fn panel(ui: &mut Ui, (size, is_short): ([f32; 2], bool), plots: &mut Plots, wishes: &mut Vec<Wish>) {
    floating(ui).show(ui, |ui| {
        ui.set_width(size[0]);
        let fold = CollapsingState::load_with_default_open(ui.ctx(), Id::unique("plots are open"), true);
        let header = fold.show_header(ui, |ui| header(ui, plots, is_short, wishes));
        header.body_unindented(|ui| {
            if !is_short {
                ui.horizontal(|ui| choices(ui, plots));
            }
            legend(ui, plots);
            plot(ui, size, plots);
        });
    });
}

/// From this width on there is room for a word beside the buttons above the plots, and from the second one for what is looked at in place of it; and
/// what the arrow takes before them, which folds the panel `[points]`.
const WORDED: f32 = 205.0;
const WITH_CHOICES: f32 = 325.0;
const ARROW: f32 = 18.0;

fn header(ui: &mut Ui, plots: &mut Plots, is_short: bool, wishes: &mut Vec<Wish>) {
    let is_probed = plots.probes().iter().any(Option::is_some);
    if is_short && is_probed {
        choices(ui, plots);
    } else if is_short {
        of_world(ui, plots);
    } else if ui.available_width() >= WORDED {
        // Of a narrower one the buttons would lie over the word.
        ui.label(RichText::new("Plots").color(colors(ui).text).strong());
    }
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if ui.button("Close").on_hover_text(described("close the plots", Action::Plots)).clicked() {
            wishes.push(Wish::Act(Action::Plots));
        }
        if ui.button("CSV").on_hover_text("all of it as a table, in a file that is asked for").clicked() {
            wishes.push(Wish::WriteTable);
        }
        if ui.button("SVG").on_hover_text("this plot as a figure, in a file that is asked for").clicked() {
            wishes.push(Wish::WriteFigure);
        }
    });
}

/// So much room is left beside the menu of the world for how to put a probe `[points]`.
const HINTED: f32 = 190.0;

/// What is looked at; without a probe how to put one.
fn choices(ui: &mut Ui, plots: &mut Plots) {
    let count = plots.probes().iter().flatten().count();
    ui.spacing_mut().item_spacing.x = 4.0;
    of_world(ui, plots);
    if count == 0 {
        // A narrow panel gets no wider for it.
        if ui.available_width() >= HINTED {
            ui.weak("tool 6 probes points and bonds");
        }
        return;
    }
    // An orbit is of the probes as well.
    let is_of_probes = matches!(plots.subject, Subject::Probes | Subject::Orbit);
    if ui.selectable_label(is_of_probes, if count == 1 { "probe" } else { "probes" }).clicked() && !is_of_probes {
        plots.subject = Subject::Probes;
    }
    if count == 2 && ui.selectable_label(plots.subject == Subject::Phase, Subject::Phase.words()).clicked() {
        plots.oppose();
    }
}

/// What is looked at of the whole world: a menu, of what a ledger has only where one is kept.
fn of_world(ui: &mut Ui, plots: &mut Plots) {
    let shown = if plots.subject.is_of_world() { plots.subject } else { Subject::default() };
    let words = RichText::new(shown.words());
    let words = if plots.subject.is_of_world() { words.color(colors(ui).accent) } else { words };
    let menu = egui::ComboBox::from_id_salt("of the world").width(NARROW_MENU).selected_text(words).show_ui(ui, |ui| {
        let has_ledger = plots.has_ledger();
        for subject in Subject::OF_WORLD.into_iter().filter(|one| has_ledger || !one.is_of_ledger()) {
            if choice(ui, plots.subject == subject, subject.words()).clicked() {
                plots.subject = subject;
            }
        }
    });
    menu.response.on_hover_text("what is plotted of the world: its energies by kind, its largest strain; with \"ledger\": true in the scene's method what brought energy and what took it");
}

/// Least width of a menu that stands in a row with others `[points]`.
const NARROW_MENU: f32 = 60.0;

/// The names of the curves in their colours, and which quantity of the probes they show.
fn legend(ui: &mut Ui, plots: &mut Plots) {
    let name = |ui: &mut Ui, name: &str, color| ui.label(RichText::new(name).color(color).size(12.0));
    let is_of_energies = matches!(plots.subject, Subject::Energies | Subject::Brought | Subject::Taken);
    let all = |ui: &mut Ui| {
        ui.set_min_height(ui.spacing().interact_size.y + 4.0);
        match plots.subject {
            Subject::Energies | Subject::Brought | Subject::Taken => {
                ui.spacing_mut().item_spacing.x = 6.0;
                of_energies(plots, colors(ui)).into_iter().for_each(|(kind, color, _)| _ = name(ui, kind.name, color));
            }
            Subject::Strain => _ = name(ui, "the largest strain of a bond", colors(ui).text),
            Subject::Probes | Subject::Orbit => {
                for (place, (point, color)) in plots.probes().into_iter().zip(colors(ui).probes).enumerate() {
                    let words = point.map(|probe| format!("{}: {}", place + 1, named(probe)));
                    words.iter().for_each(|words| _ = name(ui, words, color));
                }
            }
            Subject::Phase => _ = name(ui, "2 upwards, 1 across", colors(ui).text),
        }
        if !plots.subject.is_of_world() {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.spacing_mut().item_spacing.x = 4.0;
                quantities(ui, plots);
            });
        }
    };
    // A narrow plot has room for many names in two rows.
    if is_of_energies {
        ui.horizontal_wrapped(all);
    } else {
        ui.horizontal(all);
    }
}

/// Which quantity of the probes is plotted, and of a coordinate whether against how fast it changes.
fn quantities(ui: &mut Ui, plots: &mut Plots) {
    let orbit = |quantity: Quantity| format!("phase portrait of {}", quantity.words()[0]);
    let axes = |quantity: Quantity| format!("{} across, its velocity up", quantity.words()[0]);
    let is_orbit = plots.subject == Subject::Orbit;
    let shown = if is_orbit { orbit(plots.quantity) } else { plots.quantity.words()[0].to_owned() };
    let all: Vec<Quantity> = plots.quantities().collect();
    let menu = egui::ComboBox::from_id_salt("quantity").height(MENU).selected_text(shown).show_ui(ui, |ui| {
        for &quantity in &all {
            let is_chosen = !is_orbit && plots.quantity == quantity;
            let label = choice(ui, is_chosen, quantity.words()[0]);
            let label = match quantity.explained() {
                Some(words) => label.on_hover_text(words),
                None => label,
            };
            if label.clicked() {
                plots.choose(quantity);
            }
        }
        for &quantity in all.iter().filter(|quantity| quantity.rate().is_some()) {
            let label = choice(ui, is_orbit && plots.quantity == quantity, orbit(quantity));
            if label.on_hover_text(axes(quantity)).clicked() {
                plots.choose_orbit(quantity);
            }
        }
    });
    menu.response.on_hover_text("what is plotted of the probes");
}

/// What is probed.
fn named(probe: Probe) -> String {
    match probe {
        Probe::Point(point) => format!("point {}", point.0),
        Probe::Bond(number) => format!("bond {number}"),
        Probe::Corner([_, point, _]) => format!("at point {}", point.0),
    }
}

/// Strains up to this are those of rounding `[%]`.
const ROUNDING: f64 = 1e-6;

fn plot(ui: &mut Ui, [width, height]: [f32; 2], plots: &Plots) {
    let [name, unit] = plots.quantity.words();
    let frame = match plots.subject {
        Subject::Energies | Subject::Brought | Subject::Taken => {
            frame(plots.subject.words(), ["s", "J"], width, colors(ui))
        }
        // What is less is rounding, and looks like nothing.
        Subject::Strain => frame("strain", ["s", "%"], width, colors(ui)).include_y(0.0).include_y(ROUNDING),
        Subject::Probes => frame(("probes", name), ["s", unit], width, colors(ui)),
        Subject::Phase => frame(("phase", name), [unit, unit], width, colors(ui)),
        Subject::Orbit => frame(("orbit", name), [unit, "m/s"], width, colors(ui)),
    };
    let colors = colors(ui);
    // In a low plot fewer lines have numbers, but each line has one.
    let least = |size: f32, number: f32| LINES.max(f64::from(number / size.max(1.0)));
    let [across, up] = [least(width, NUMBER[0]), least(height, NUMBER[1])];
    let frame = frame.x_grid_spacer(move |input| grid(input, across)).y_grid_spacer(move |input| grid(input, up));
    let shown = frame.width(width).height(height).show(ui, |ui| {
        // One measurement alone is a dot, as wide as a line.
        let is_dot = plots.series().iter().nth(1).is_none();
        for line in lines(plots, colors) {
            // As a band what is steep would get thin.
            let line = line.allow_band(false);
            ui.line(if is_dot { line.width(DOT) } else { line });
        }
    });
    if let Some(why) = plots.why_empty() {
        let place = shown.response.rect;
        let font = egui::FontId::proportional(12.0);
        let weak = colors.weak;
        let galley = ui.fonts_mut(|fonts| fonts.layout(why.to_owned(), font, weak, place.width() - 70.0));
        ui.painter().galley(place.center() - 0.5 * galley.size() + vec2(24.0, 0.0), galley, weak);
    }
}

/// Width of what stands left of a plot, and of a sign of a number below it, about `[points]`.
const NUMBERS: f32 = 52.0;
const SIGN: f64 = 6.6;

/// A plot that is less wide has few numbers and needs each `[points]`.
const NARROW: f32 = 200.0;

/// The number at a line across a range, in a plot so wide `[points]`: none where half of it would lie beyond the right edge and there are others.
fn across_tick(mark: GridMark, range: &std::ops::RangeInclusive<f64>, (unit, width): (&str, f32)) -> String {
    let words = tick(mark, unit);
    let long = f64::from((width - NUMBERS).max(1.0));
    let left = (range.end() - mark.value) / (range.end() - range.start()) * long;
    let half = 0.5 * SIGN * words.chars().count() as f64;
    if width >= NARROW && left < half { String::new() } else { words }
}

/// A plot so wide `[points]` without curves, which is to show all of them and stays as it is under the pointer. Units: those of its axes.
fn frame(id: impl AsIdSalt, [across, up]: [&'static str; 2], width: f32, colors: &Colors) -> Plot<'static> {
    // Curves over time take all of the width.
    let margin = if across == "s" { 0.0 } else { 0.08 };
    let axis =
        |axis: AxisHints<'static>, room: f32| axis.label_spacing(room..=room + 1.0).tick_label_color(colors.weak);
    let below = AxisHints::new_x().formatter(move |mark, range| across_tick(mark, range, (across, width)));
    let beside = AxisHints::new_y().formatter(move |mark, _| tick(mark, up));
    Plot::new(id)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .set_margin_fraction(vec2(margin, 0.08))
        .custom_x_axes(vec![axis(below, 36.0)])
        .custom_y_axes(vec![axis(beside, 14.0).min_thickness(NUMBERS)])
        .grid_color(colors.line)
        .label_formatter(move |at| match at {
            HoverPosition::NearDataPoint { plot_name, position, .. } => {
                let [x, y] = [position.x, position.y].map(number);
                Some(format!("{plot_name}: {y} {up}\n{x} {across}"))
            }
            HoverPosition::Elsewhere { .. } => None,
        })
}

/// Lines at round numbers, in steps of 1, 2 or 5 times a power of ten: no less than a share of the plot.
fn grid(GridInput { bounds: (from, to), .. }: GridInput, least: f64) -> Vec<GridMark> {
    let least = least * (to - from);
    let power = 10_f64.powf(least.log10().floor());
    let step =
        [1.0, 2.0, 5.0].map(|digit| digit * power).into_iter().find(|step| *step >= least).unwrap_or(10.0 * power);
    if !(step.is_normal() && (from / step).is_finite() && (to / step).is_finite()) {
        return Vec::new();
    }
    let numbers = (from / step).ceil() as i64..=(to / step).floor() as i64;
    numbers.take(12).map(|k| GridMark { value: k as f64 * step, step_size: step }).collect()
}

/// The plot that is looked at, as a figure for a file.
pub(in crate::app) fn figure(plots: &Plots) -> String {
    let [name, unit] = plots.quantity.words();
    let over_time = |of: &dyn Fn(&Measured) -> f64| -> Vec<[f64; 2]> {
        plots.series().iter().map(|measured| [measured.time, of(measured)]).collect()
    };
    let curve = |name: String, (color, width): (Color32, f32), points: Vec<[f64; 2]>| Curve {
        name,
        color: color.to_array(),
        width,
        points,
    };
    match plots.subject {
        Subject::Energies | Subject::Brought | Subject::Taken => {
            let color = |kind: &Kind| kind.color.map_or(SUM_ON_WHITE, |place| ENERGIES_ON_WHITE[place]);
            let all = in_their_widths(plots)
                .map(|(kind, width)| curve(kind.name.to_owned(), (color(&kind), width), over_time(&kind.of)));
            let up = if plots.subject == Subject::Energies { "energy [J]" } else { "work [J]" };
            svg(["time [s]", up], &all.collect::<Vec<_>>())
        }
        Subject::Strain => {
            let points = over_time(&|measured| 100.0 * measured.strain);
            svg(["time [s]", "strain [%]"], &[curve("largest strain".to_owned(), (SUM_ON_WHITE, ALONE), points)])
        }
        Subject::Probes => {
            let places = plots.probes().into_iter().enumerate().filter(|(place, _)| plots.has_curve(*place));
            let places = places.filter_map(|(place, probe)| Some((place, probe?)));
            let all = places.map(|(place, probe)| {
                let look = if plots.quantity.is_of_both() {
                    (SUM_ON_WHITE, ALONE)
                } else {
                    (ON_WHITE[place], of_probe(plots, place))
                };
                let both = || plots.probes().into_iter().flatten().map(named).collect::<Vec<_>>().join(", ");
                let name = if plots.quantity.is_of_both() { both() } else { named(probe) };
                curve(name, look, plots.over_time(place))
            });
            svg(["time [s]", &format!("{name} [{unit}]")], &all.collect::<Vec<_>>())
        }
        Subject::Orbit => {
            let places = plots.probes().into_iter().enumerate().filter_map(|(place, probe)| Some((place, probe?)));
            let orbit =
                |place: usize| plots.series().iter().filter_map(|measured| orbit(plots, measured, place)).collect();
            let all = places
                .map(|(place, probe)| curve(named(probe), (ON_WHITE[place], of_probe(plots, place)), orbit(place)));
            svg([&format!("{name} [{unit}]"), &format!("velocity {name} [m/s]")], &all.collect::<Vec<_>>())
        }
        Subject::Phase => {
            let both = |measured: &Measured| Some([plots.value(measured, 0)?, plots.value(measured, 1)?]);
            let names = plots.probes().map(|probe| probe.map_or(String::new(), named));
            let points = plots.series().iter().filter_map(both).collect();
            let axis = |place: usize| format!("{name} of {} [{unit}]", names[place]);
            svg([&axis(0), &axis(1)], &[curve(String::new(), (ON_WHITE[0], ALONE), points)])
        }
    }
}

/// The energies' colours on white, which people who are blind to some tell apart, by Okabe and Ito, and that of the sum; and the probes'.
const ENERGIES_ON_WHITE: [Color32; 8] = [
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(0, 114, 178),
    Color32::from_rgb(160, 140, 40),
    Color32::from_rgb(130, 110, 220),
];
const SUM_ON_WHITE: Color32 = Color32::from_gray(40);
const ON_WHITE: [Color32; 2] = [Color32::from_rgb(0, 114, 178), Color32::from_rgb(213, 94, 0)];

/// The curves of what is looked at.
fn lines(plots: &Plots, colors: &Colors) -> Vec<Line<'static>> {
    let series = plots.series();
    match plots.subject {
        Subject::Energies | Subject::Brought | Subject::Taken => {
            let line = |(kind, color, width): (Kind, Color32, f32)| {
                let curve = Line::new(kind.name, points(series, |measured| Some([measured.time, (kind.of)(measured)])));
                curve.color(color).width(width)
            };
            of_energies(plots, colors).into_iter().map(line).collect()
        }
        Subject::Strain => {
            let at = |measured: &Measured| Some([measured.time, 100.0 * measured.strain]);
            vec![Line::new("largest strain", points(series, at)).color(colors.text).width(ALONE)]
        }
        Subject::Probes if plots.quantity.is_of_both() => {
            let curve = PlotPoints::from(plots.over_time(0));
            vec![Line::new("1 and 2", curve).color(colors.text).width(ALONE)]
        }
        Subject::Probes => {
            let line = |place: usize| {
                Line::new((place + 1).to_string(), PlotPoints::from(plots.over_time(place)))
                    .color(colors.probes[place])
                    .width(of_probe(plots, place))
            };
            let places = plots.probes().into_iter().enumerate().filter(|(_, probe)| probe.is_some());
            places.map(|(place, _)| line(place)).collect()
        }
        Subject::Orbit => {
            let line = |place: usize| {
                let at = |measured: &Measured| orbit(plots, measured, place);
                Line::new((place + 1).to_string(), points(series, at))
                    .color(colors.probes[place])
                    .width(of_probe(plots, place))
            };
            let places = plots.probes().into_iter().enumerate().filter(|(_, probe)| probe.is_some());
            places.map(|(place, _)| line(place)).collect()
        }
        Subject::Phase => {
            let at = |measured: &Measured| Some([plots.value(measured, 0)?, plots.value(measured, 1)?]);
            vec![Line::new("2 against 1", points(series, at)).color(colors.text).width(ALONE)]
        }
    }
}

/// A coordinate of a probe, and how fast it changes.
fn orbit(plots: &Plots, measured: &Measured, place: usize) -> Option<[f64; 2]> {
    let probed = measured.probes[place]?;
    Some([plots.quantity.of(&probed)?, plots.quantity.rate()?.of(&probed)?])
}

fn points(series: &Series, at: impl Fn(&Measured) -> Option<[f64; 2]>) -> PlotPoints<'static> {
    series.iter().filter_map(at).collect()
}

/// What stands at a line of the grid: with as many digits as tell it from the next, and its unit.
fn tick(GridMark { value, step_size }: GridMark, unit: &str) -> String {
    let order = |number: f64| (number.abs().log10() + 1e-9).floor();
    let digits = (-order(step_size)).clamp(0.0, 9.0) as usize;
    match value.abs() {
        0.0 => format!("0 {unit}"),
        size if size < 1e5 && digits <= 6 => format!("{value:.digits$} {unit}"),
        _ => {
            let digits = (order(value) - order(step_size)).clamp(0.0, 9.0) as usize;
            format!("{value:.digits$e} {unit}")
        }
    }
}

/// Three digits after the point, or as a power of ten what is large or small.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if (1e-2..1e5).contains(&size) => format!("{value:.3}"),
        _ => format!("{value:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_have_round_numbers_with_the_digits_that_tell_them_apart() {
        let ticks = |from: f64, to: f64| -> Vec<String> {
            let input = GridInput { bounds: (from, to), base_step_size: 1.0 };
            grid(input, LINES).into_iter().map(|mark| tick(mark, "J")).collect()
        };
        assert_eq!(ticks(-12.0, 21.0), ["-10 J", "0 J", "10 J", "20 J"]);
        assert_eq!(ticks(0.922_01, 0.922_19), ["0.92205 J", "0.92210 J", "0.92215 J"]);
        assert_eq!(ticks(3.01, 3.42), ["3.1 J", "3.2 J", "3.3 J", "3.4 J"]);
        assert_eq!(ticks(1.0e6, 1.7e6), ["1.0e6 J", "1.2e6 J", "1.4e6 J", "1.6e6 J"]);
        assert!(ticks(1.0, 1.0).is_empty() && ticks(f64::NAN, 1.0).is_empty());
    }

    #[test]
    fn a_number_that_would_lie_over_the_right_edge_is_left_out() {
        let at = |value: f64| across_tick(GridMark { value, step_size: 0.5 }, &(0.0..=2.0), ("s", 252.0));
        // The plot is 200 points wide, and half of a number 16.
        assert_eq!([0.0, 1.5, 1.8, 1.9, 2.0].map(at), ["0 s", "1.5 s", "1.8 s", "", ""]);
        assert_eq!(across_tick(GridMark { value: 2.0, step_size: 0.5 }, &(0.0..=2.0), ("s", 180.0)), "2.0 s");
    }
}
