//! The fields of the settings, section by section.

use std::ops::RangeInclusive;

use egui::{ComboBox, DragValue, Response, Slider, SliderClamping, Ui};

use super::super::choosing::{begin_at, choice};
use super::super::theme::as_high_as_buttons;
use super::super::{Facts, Wish, dial, ranged, ticks};
use super::Sink;
use crate::app::player::MethodSetting;
use crate::history::{AreasOrNone, SetKeys, Walls, Weather};
use crate::scene::{AreaKeys, AreaKindName, BoundsKeys, Meeting, OrderName, PrecisionName, SolverName, WindKeys};
use crate::sim::{Areas, BoundsChange, Contact, Method, Order, Solver, Wind};

/// Gravity on the ground `[m/s^2]`.
const GRAVITY: f64 = 9.81;
/// Gravity at the rim of the dial `[m/s^2]`.
const FULL: f64 = 20.0;

/// A number with its name before it, by which what reads aloud calls it.
pub(super) fn number(ui: &mut Ui, name: &str, of: (&mut f64, f64, &str)) -> Response {
    number_within(ui, name, of, f64::NEG_INFINITY..=f64::INFINITY)
}

/// The same of a range.
pub(super) fn number_within(
    ui: &mut Ui,
    name: &str,
    (value, speed, unit): (&mut f64, f64, &str),
    range: RangeInclusive<f64>,
) -> Response {
    as_high_as_buttons(ui);
    let label = ui.label(name);
    let field = DragValue::new(value).speed(speed).max_decimals(2).suffix(unit).update_while_editing(false);
    ranged::field(ui, field, range, unit).labelled_by(label.id)
}

/// A slider from 0 to `most`, whose value may be beyond.
fn slider(ui: &mut Ui, name: &str, value: &mut f64, most: f64) -> Response {
    ui.spacing_mut().slider_width = 96.0;
    let slider = Slider::new(value, 0.0..=most).clamping(SliderClamping::Edits).max_decimals(2).text(name);
    ranged::slider(ui, slider.update_while_editing(false), 0.0..=most, "")
}

pub(super) fn of_gravity(ui: &mut Ui, gravity: [f64; 3], sink: &mut Sink<'_>) {
    let [x, y, z] = gravity;
    let set = |sink: &mut Sink<'_>, by: &Response, to: [f64; 3]| {
        let keys = SetKeys { gravity: Some(sink.vector(to)), ..SetKeys::default() };
        sink.scene(by, "gravity", keys);
    };
    ui.strong("Gravity");
    ui.horizontal(|ui| {
        let (response, to) = dial::show(ui, "gravity, as an arrow", [x, y], FULL);
        if let Some([x, y]) = to {
            set(sink, &response, [x, y, z]);
        }
        ui.vertical(|ui| {
            let mut to = gravity;
            for (axis, name) in ["x", "y", "z"].into_iter().take(sink.dimensions).enumerate() {
                let changed = ui.horizontal(|ui| number(ui, name, (&mut to[axis], 0.1, " m/s²"))).inner;
                if changed.changed() {
                    set(sink, &changed, to);
                }
            }
            ui.horizontal(|ui| {
                let none = ui.button("0").on_hover_text("no gravity");
                if none.clicked() {
                    set(sink, &none, [0.0; 3]);
                }
                let down = ui.button("down").on_hover_text("9.81 m/s² down");
                if down.clicked() {
                    set(sink, &down, [0.0, -GRAVITY, 0.0]);
                }
            });
        });
    });
}

pub(super) fn of_air(ui: &mut Ui, mut drag_rate: f64, wind: Option<Wind<3>>, sink: &mut Sink<'_>) {
    ui.strong("Air");
    let by = slider(ui, "drag /s", &mut drag_rate, 5.0);
    if by.changed() {
        sink.scene(&by, "drag", SetKeys { drag_rate: Some(drag_rate), ..SetKeys::default() });
    }
    let before = wind.unwrap_or(Wind { velocity: [0.0; 3], turbulence: 0.0, seed: 0 });
    let mut to = before;
    let mut changed = None;
    ui.horizontal(|ui| {
        for (axis, name) in ["wind x", "y", "z"].into_iter().take(sink.dimensions).enumerate() {
            let by = number(ui, name, (&mut to.velocity[axis], 0.1, ""));
            changed = changed.take().or(by.changed().then_some(by));
        }
        ui.weak("m/s");
    });
    let blows = to.velocity != [0.0; 3];
    let gusts = ui.add_enabled_ui(blows, |ui| slider(ui, "turbulence", &mut to.turbulence, 1.0)).inner;
    changed = changed.or(gusts.changed().then_some(gusts));
    let by = ui.add_enabled_ui(blows && to.turbulence > 0.0, |ui| {
        ui.horizontal(|ui| {
            let label = ui.label("seed");
            ui.add(DragValue::new(&mut to.seed).speed(0.05)).labelled_by(label.id)
        })
        .inner
    });
    let by = by.inner.on_hover_text("of the gusts: with another one they come at other times, as strong");
    changed = changed.or(by.changed().then_some(by));
    if blows && drag_rate == 0.0 {
        ui.weak("without drag no wind is felt");
    }
    if let Some(by) = changed {
        let keys = WindKeys {
            velocity: sink.vector(to.velocity),
            turbulence: (to.turbulence > 0.0).then_some(to.turbulence),
            seed: Some(to.seed),
        };
        let wind = if blows { Weather::This(keys) } else { Weather::None(()) };
        sink.scene(&by, "wind", SetKeys { wind: Some(wind), ..SetKeys::default() });
    }
}

/// Rows of what is switched off stay, so that nothing moves under the pointer.
pub(super) fn of_walls(ui: &mut Ui, bounds: Option<&BoundsChange>, new: [[f64; 3]; 2], sink: &mut Sink<'_>) {
    let [min, max] = new;
    let can_stand = (0..sink.dimensions).all(|axis| min[axis] < max[axis]);
    ui.horizontal(|ui| {
        ui.strong("Walls");
        let mut stand = bounds.is_some();
        let by = ticks::check_if(ui, stand || can_stand, &mut stand, "stand");
        let around = if sink.dimensions == 2 { "what is seen" } else { "all that is there" };
        let by = by.on_hover_text(format!("new ones stand around {around}"));
        if by.changed() {
            let these = BoundsKeys {
                min: sink.vector(min),
                max: sink.vector(max),
                restitution: Some(NEW_WALLS[0]),
                friction: Some(NEW_WALLS[1]),
            };
            let walls = if stand { Walls::These(these) } else { Walls::None(()) };
            sink.scene(&by, "walls", SetKeys { bounds: Some(walls), ..SetKeys::default() });
        }
    });
    if bounds.is_none() && !can_stand {
        return;
    }
    let [restitution, friction] = NEW_WALLS;
    let mut to = bounds.copied().unwrap_or(BoundsChange { min, max, restitution, friction });
    if bounds.is_none() {
        ui.disable();
    }
    let mut all = Vec::new();
    for (axis, [least, most]) in WALLS.into_iter().enumerate().take(sink.dimensions) {
        let speed = 0.005 * (to.max[axis] - to.min[axis]);
        ui.horizontal(|ui| {
            // Walls do not stand in each other.
            let (low, high) = (to.min[axis] + LEAST_WIDE, to.max[axis] - LEAST_WIDE);
            all.push(number_within(ui, least, (&mut to.min[axis], speed, " m"), f64::NEG_INFINITY..=high));
            all.push(number_within(ui, most, (&mut to.max[axis], speed, " m"), low..=f64::INFINITY));
        });
    }
    all.push(slider(ui, "friction", &mut to.friction, 1.0));
    all.push(slider(ui, "restitution", &mut to.restitution, 1.0));
    let is_fine = (0..sink.dimensions).all(|axis| to.min[axis] < to.max[axis]);
    if let Some(by) = all.into_iter().find(Response::changed).filter(|_| is_fine) {
        let keys = BoundsKeys {
            min: sink.vector(to.min),
            max: sink.vector(to.max),
            restitution: Some(to.restitution),
            friction: Some(to.friction),
        };
        sink.scene(&by, "walls", SetKeys { bounds: Some(Walls::These(keys)), ..SetKeys::default() });
    }
}

/// Walls are so far apart at least `[m]`.
const LEAST_WIDE: f64 = 0.01;

/// Restitution and friction of walls that are new `[1]`.
const NEW_WALLS: [f64; 2] = [0.2, 0.5];

/// Names of the walls along each axis.
const WALLS: [[&str; 2]; 3] = [["left", "right"], ["floor", "top"], ["back", "front"]];

pub(super) fn of_contact(ui: &mut Ui, contact: Option<Contact>, sink: &mut Sink<'_>) {
    let mut meets = contact.is_some();
    ui.strong("Bodies");
    let by = ticks::check(ui, &mut meets, "collide");
    if by.changed() {
        let keys = SetKeys { contact: Some(Meeting::Is(meets)), ..SetKeys::default() };
        sink.scene(&by, "contact", keys);
    }
    ui.add_enabled_ui(meets, |ui| of_meeting(ui, contact.unwrap_or_default(), sink));
}

/// How bodies meet.
fn of_meeting(ui: &mut Ui, contact: Contact, sink: &mut Sink<'_>) {
    let mut to = contact;
    let all = [
        ticks::check(ui, &mut to.with_others, "with one another")
            .on_hover_text("off: each collides with itself alone, and with obstacles"),
        ticks::check(ui, &mut to.with_itself, "with themselves"),
        slider(ui, "friction", &mut to.friction, 2.0),
        slider(ui, "restitution", &mut to.restitution, 1.0),
    ];
    let radius = chosen(ui, ("skin", " m"), (contact.radius, 0.01, 0.0..=1e3), |x| format!("{} m", shown(x, 4)));
    if let Some((by, radius)) = radius {
        let thick = Contact { radius, ..contact };
        sink.scene(&by, "contact", SetKeys { contact: Some(Meeting::As(thick.into())), ..SetKeys::default() });
    }
    if let Some(by) = all.into_iter().find(Response::changed) {
        sink.scene(&by, "contact", SetKeys { contact: Some(Meeting::As(to.into())), ..SetKeys::default() });
    }
}

/// How hard bodies are to squeeze, beside what their bonds do.
pub(super) fn of_areas(ui: &mut Ui, (areas, meets): (Option<Areas>, bool), sink: &mut Sink<'_>) {
    let before = areas.unwrap_or_default();
    let set = |sink: &mut Sink<'_>, by: &Response, to: Option<AreaKeys>| {
        let areas = to.map_or(AreasOrNone::None(()), AreasOrNone::These);
        sink.scene(by, "areas", SetKeys { areas: Some(areas), ..SetKeys::default() });
    };
    let springs = |stiffness: f64, least: f64| AreaKeys {
        kind: Some(AreaKindName::Spring),
        stiffness: Some(stiffness),
        least: Some(least),
    };
    let mut are_kept = before.stiffness.is_infinite();
    let by = ticks::check(ui, &mut are_kept, "areas are kept").on_hover_text("whatever presses on bodies");
    if by.changed() {
        let kept = AreaKeys { kind: Some(AreaKindName::Rigid), stiffness: None, least: Some(before.least) };
        set(sink, &by, are_kept.then_some(kept));
    }
    let resists = !before.stiffness.is_infinite();
    let mut stiffness = if resists { before.stiffness } else { 0.0 };
    let speed = 0.02 * stiffness.max(10.0);
    let resist = |ui: &mut Ui| {
        ui.horizontal(|ui| number_within(ui, "areas resist", (&mut stiffness, speed, " N/m"), 0.0..=1e9)).inner
    };
    let by = ui.add_enabled_ui(resists, resist).inner;
    let by = by.on_hover_text("against being squeezed or blown up, beside what bonds do");
    if by.changed() {
        set(sink, &by, (stiffness > 0.0).then(|| springs(stiffness, before.least)));
    }
    let mut least = before.least;
    let by = ui.add_enabled_ui(resists && meets, |ui| slider(ui, "least area", &mut least, 0.9)).inner;
    let by =
        by.on_hover_text("down to this share of its area a triangle may be pressed, and no further, where bodies meet");
    if by.changed() {
        set(sink, &by, Some(springs(before.stiffness, least.clamp(0.0, 0.9))));
    }
}

/// A number with so many places at most, without zeros at its end.
fn shown(x: f64, places: usize) -> String {
    format!("{x:.places$}").trim_end_matches('0').trim_end_matches('.').to_owned()
}

pub(super) fn of_method(ui: &mut Ui, method: &Method, facts: &Facts, sink: &mut Sink<'_>) {
    ui.strong("Method");
    of_solver(ui, method.solver, facts, sink);
    let substep = chosen(ui, ("substep", " ms"), (method.substep.map(|h| 1e3 * h), 2.0, 1e-4..=100.0), |x| {
        format!("{} ms", shown(x, 4))
    });
    if let Some((by, to)) = substep {
        sink.method(&by, MethodSetting::Substep(to.map(|ms| 1e-3 * ms)));
    }
    let sweeps = (method.iterations.map(f64::from), 10.0, 1.0..=1000.0);
    if let Some((by, to)) = chosen(ui, ("sweeps", ""), sweeps, |x| format!("{x:.0}")) {
        sink.method(&by, MethodSetting::Iterations(to.map(|x| x.round() as u32)));
    }
    of_order(ui, method, sink);
    let strain = (method.max_strain.map(|strain| 100.0 * strain), 1.0, 1e-4..=50.0);
    if let Some((by, to)) = chosen(ui, ("stretch of rigid bonds", " %"), strain, |x| format!("{} %", shown(x, 4))) {
        sink.method(&by, MethodSetting::MaxStrain(to.map(|percent| 0.01 * percent)));
    }
    let budget = (method.budget.filter(|ms| *ms < NO_BOUND), 6.0, 0.1..=1000.0);
    if let Some((by, to)) = chosen(ui, ("work in a frame, at most", " ms"), budget, |x| format!("{} ms", shown(x, 1))) {
        sink.method(&by, MethodSetting::Budget(to));
    }
    let (mut sleeps, mut settles) = (method.sleeps, method.settles);
    let by = ticks::check(ui, &mut sleeps, "what rests falls asleep");
    if by.changed() {
        sink.method(&by, MethodSetting::Sleep(sleeps));
    }
    let by = ticks::check(ui, &mut settles, "what lies on others comes to rest");
    if by.changed() {
        sink.method(&by, MethodSetting::Settle(settles));
    }
    facts.settings.fixed.iter().for_each(|fixed| of_fixed(ui, *fixed, sink));
}

/// In which order a sweep takes the bonds.
fn of_order(ui: &mut Ui, method: &Method, sink: &mut Sink<'_>) {
    let words = |order: Order| match order {
        Order::Auto => "automatic",
        Order::Fixed => "as they are listed",
        Order::Symmetric => "forth, then back",
        Order::Coloured => "by colours",
        Order::Shuffled => "shuffled",
    };
    ComboBox::from_label("order").selected_text(words(method.order)).truncate().show_ui(ui, |ui| {
        for (order, name) in [
            (Order::Auto, OrderName::Auto),
            (Order::Fixed, OrderName::Fixed),
            (Order::Symmetric, OrderName::Symmetric),
            (Order::Coloured, OrderName::Coloured),
            (Order::Shuffled, OrderName::Shuffled),
        ] {
            let by = choice(ui, method.order == order, words(order));
            if by.clicked() && method.order != order {
                sink.method(&by, MethodSetting::Order(name));
            }
        }
    });
    if method.order == Order::Shuffled {
        let mut seed = method.seed;
        let by = ui.horizontal(|ui| {
            let label = ui.label("seed of the order");
            ui.add(DragValue::new(&mut seed).speed(0.05).update_while_editing(false)).labelled_by(label.id)
        });
        if by.inner.changed() {
            sink.method(&by.inner, MethodSetting::Seed(seed));
        }
    }
}

/// Tolerances to choose from `[m]`.
const TOLERANCES: [(f64, &str); 5] =
    [(1e-3, "1 mm"), (1e-4, "0.1 mm"), (1e-5, "0.01 mm"), (1e-6, "0.001 mm"), (1e-9, "0.000001 mm")];

/// What is fixed when a history begins: another one begins at this moment.
fn of_fixed(ui: &mut Ui, (precision, tolerance): (PrecisionName, Option<f64>), sink: &mut Sink<'_>) {
    let told = "Another choice begins a new scene at this moment; Ctrl+Z goes back to this one";
    let words = |name: PrecisionName| match name {
        PrecisionName::Auto => "automatic",
        PrecisionName::F32 => "32 bits",
        PrecisionName::F64 => "64 bits",
    };
    let shown = ComboBox::from_label("precision").selected_text(words(precision)).truncate().show_ui(ui, |ui| {
        for name in [PrecisionName::Auto, PrecisionName::F32, PrecisionName::F64] {
            if choice(ui, precision == name, words(name)).clicked() && precision != name {
                sink.wishes.push(Wish::Begin(name, tolerance));
            }
        }
    });
    shown.response.on_hover_text(told);
    let named = tolerance.map_or("none".to_owned(), |own| {
        let known = TOLERANCES.into_iter().find(|(other, _)| *other == own);
        known.map_or_else(|| format!("{own:e} m"), |(_, name)| name.to_owned())
    });
    let shown = ComboBox::from_label("tolerance").selected_text(named).truncate().show_ui(ui, |ui| {
        let choices = TOLERANCES.map(|(own, name)| (Some(own), name));
        for (other, name) in [(None, "none")].into_iter().chain(choices) {
            if choice(ui, tolerance == other, name).clicked() && tolerance != other {
                sink.wishes.push(Wish::Begin(precision, other));
            }
        }
    });
    let more = "the error that the motion may have. While one is chosen bodies never fall asleep, and each keeps its own method however long that takes; `wobble simulate` finds the cheapest method that keeps it";
    shown.response.on_hover_text(format!("{more}. {told}"));
}

/// Counted work of a frame from which on none is a bound `[ms]`.
const NO_BOUND: f64 = 1e6;

/// A number that the rules choose, or that is given: where it is first given, `first`. Returns what became of it.
fn chosen(
    ui: &mut Ui,
    (name, unit): (&str, &str),
    (value, first, range): (Option<f64>, f64, RangeInclusive<f64>),
    shown: impl Fn(f64) -> String,
) -> Option<(Response, Option<f64>)> {
    let mut is_given = value.is_some();
    ui.horizontal(|ui| {
        let switch = ticks::check(ui, &mut is_given, name).on_hover_text("off: it is chosen automatically");
        if switch.changed() {
            return Some((switch, is_given.then_some(first)));
        }
        let mut number = value?;
        let speed = 0.02 * number;
        let field = DragValue::new(&mut number).speed(speed).update_while_editing(false);
        let by = ranged::field(ui, field.custom_formatter(|x, _| shown(x)), range, unit).labelled_by(switch.id);
        by.changed().then_some((by, Some(number)))
    })
    .inner
}

fn of_solver(ui: &mut Ui, solver: Solver, facts: &Facts, sink: &mut Sink<'_>) {
    let now: Option<SolverName> = solver.name().parse().ok();
    let words = now.map_or(solver.name(), SolverName::words);
    ComboBox::from_label("solver").selected_text(words).truncate().show_ui(ui, |ui| {
        for choice in super::super::beside::solvers() {
            let why = super::super::beside::why_not(facts, choice);
            let label = egui::Button::selectable(now == Some(choice), choice.words());
            let by = ui.add_enabled(why.is_none(), label);
            begin_at(&by, now == Some(choice));
            if by.clicked() && now != Some(choice) {
                sink.wishes.push(Wish::Solver(choice));
            }
            if let Some(why) = why {
                by.on_disabled_hover_text(format!("not for this scene: {why}"));
            }
        }
    });
}
