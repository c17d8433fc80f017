//! Plots at the bottom left: the energies of the world over time, and what the probes measure.

use egui::collapsing_header::CollapsingState;
use egui::{Align, Align2, Area, AsIdSalt, Color32, Id, Layout, Rect, RichText, TextStyle, Ui, vec2};
use egui_plot::{Corner, GridMark, HoverPosition, Legend, Line, Plot, PlotPoints};

use super::theme::{PROBES, TEXT, floating};
use super::{Wish, described};
use crate::app::action::Action;
use crate::app::player::Measured;
use crate::app::plots::{Plots, Quantity, Series, Subject};

/// Width and greatest height of a plot [points].
const SIZE: [f32; 2] = [340.0, 180.0];
/// A room so high has place for the panel below the tools [points].
const TALL: f32 = 800.0;
/// Where it begins beside the tools, and below them [points].
const LEFT: [f32; 2] = [76.0, 10.0];
/// What is above the plot stays free [points].
const ABOVE: f32 = 250.0;

/// What is plotted of the energies [J].
type OfEnergies = fn(&Measured) -> f64;
/// The kinds of energy: colours that people who are blind to some tell apart, by Okabe and Ito.
pub(super) const ENERGIES: [(&str, Color32, OfEnergies); 4] = [
    ("kinetic", Color32::from_rgb(230, 159, 0), |measured| measured.energies.kinetic),
    ("elastic", Color32::from_rgb(86, 180, 233), |measured| measured.energies.springs),
    ("gravity", Color32::from_rgb(0, 158, 115), |measured| measured.energies.gravity),
    ("sum", TEXT, |measured| measured.energies.sum()),
];

pub(super) fn show(context: &egui::Context, room: Rect, plots: &mut Plots, wishes: &mut Vec<Wish>) {
    let up = room.height() - context.content_rect().height() - 10.0;
    let left = LEFT[usize::from(room.height() >= TALL)];
    Area::new(Id::unique("plots")).anchor(Align2::LEFT_BOTTOM, [left, up]).show(context, |ui| {
        floating().show(ui, |ui| {
            ui.set_width(SIZE[0]);
            let fold = CollapsingState::load_with_default_open(context, Id::unique("plots are open"), true);
            let header = fold.show_header(ui, |ui| header(ui, wishes));
            header.body_unindented(|ui| {
                choices(ui, plots);
                plot(ui, (room.height() - ABOVE).clamp(70.0, SIZE[1]), plots);
            });
        });
    });
}

fn header(ui: &mut Ui, wishes: &mut Vec<Wish>) {
    ui.label(RichText::new("Plots").color(TEXT).strong());
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if ui.button("Close").on_hover_text(described("close the plots", Action::Plots)).clicked() {
            wishes.push(Wish::Act(Action::Plots));
        }
        if ui.button("CSV").on_hover_text("a table, in the folder that wobble was started in").clicked() {
            wishes.push(Wish::WriteTable);
        }
    });
}

/// What is looked at; without a probe how to put one.
fn choices(ui: &mut Ui, plots: &mut Plots) {
    let count = plots.probes().iter().flatten().count();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.selectable_value(&mut plots.subject, Subject::Energies, "energies");
        if count == 0 {
            ui.weak("select (6) a point: a probe");
            return;
        }
        ui.selectable_value(&mut plots.subject, Subject::Probes, if count == 1 { "probe" } else { "probes" });
        if count == 2 {
            ui.selectable_value(&mut plots.subject, Subject::Phase, "against each other");
        }
        if plots.subject != Subject::Energies {
            ui.separator();
            for quantity in Quantity::ALL {
                ui.selectable_value(&mut plots.quantity, quantity, quantity.words()[0]);
            }
        }
    });
}

fn plot(ui: &mut Ui, height: f32, plots: &Plots) {
    let [name, unit] = plots.quantity.words();
    let across = match plots.subject {
        Subject::Energies => frame("energies", ["s", "J"]),
        Subject::Probes => frame(("probes", name), ["s", unit]),
        Subject::Phase => frame(("phase", name), [unit, unit]),
    };
    across.width(SIZE[0]).height(height).show(ui, |ui| {
        for line in lines(plots) {
            ui.line(line);
        }
    });
}

/// A plot without curves, which shows all that there is. Units: those of its axes.
fn frame(id: impl AsIdSalt, [across, up]: [&'static str; 2]) -> Plot<'static> {
    let is_time = across == "s";
    let legend = Legend::default().position(Corner::LeftTop).follow_insertion_order(true);
    Plot::new(id)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .set_margin_fraction(if is_time { vec2(0.0, 0.08) } else { vec2(0.08, 0.08) })
        .x_axis_label(across)
        .y_axis_label(up)
        .x_axis_formatter(|mark, _| tick(mark))
        .y_axis_formatter(|mark, _| tick(mark))
        .y_axis_min_width(44.0)
        .legend(legend.text_style(TextStyle::Small).background_alpha(0.5))
        .label_formatter(move |at| match at {
            HoverPosition::NearDataPoint { plot_name, position, .. } => {
                let [x, y] = [position.x, position.y].map(number);
                Some(format!("{plot_name}: {y} {up}\n{x} {across}"))
            }
            HoverPosition::Elsewhere { .. } => None,
        })
}

/// The curves of what is looked at.
fn lines(plots: &Plots) -> Vec<Line<'static>> {
    let (series, quantity) = (plots.series(), plots.quantity);
    let of = |place: usize| move |measured: &Measured| measured.probes[place].map(|probed| quantity.of(&probed));
    match plots.subject {
        Subject::Energies => {
            let line = |(name, color, of): (&'static str, Color32, OfEnergies)| {
                Line::new(name, points(series, |measured| Some([measured.time, of(measured)]))).color(color).width(1.5)
            };
            ENERGIES.into_iter().map(line).collect()
        }
        Subject::Probes => {
            let line = |place: usize| {
                let at = |measured: &Measured| Some([measured.time, of(place)(measured)?]);
                Line::new((place + 1).to_string(), points(series, at)).color(PROBES[place]).width(1.5)
            };
            let places = plots.probes().into_iter().enumerate().filter(|(_, probe)| probe.is_some());
            places.map(|(place, _)| line(place)).collect()
        }
        Subject::Phase => {
            let at = |measured: &Measured| Some([of(0)(measured)?, of(1)(measured)?]);
            vec![Line::new("2 over 1", points(series, at)).color(TEXT).width(1.5)]
        }
    }
}

fn points(series: &Series, at: impl Fn(&Measured) -> Option<[f64; 2]>) -> PlotPoints<'static> {
    series.iter().filter_map(at).collect()
}

/// What stands at a line of the grid: with as many digits as tell it from the next.
fn tick(mark: GridMark) -> String {
    let digits = (-mark.step_size.log10()).ceil().clamp(0.0, 9.0) as usize;
    match mark.value.abs() {
        0.0 => "0".to_owned(),
        size if size >= 1e5 || digits > 4 => format!("{:.1e}", mark.value),
        _ => format!("{:.digits$}", mark.value),
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
