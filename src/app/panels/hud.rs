//! Figures in the upper right corner.

use egui::{Align, Align2, Area, Id, LayerId, Layout, Order, PopupAnchor, Rect, RichText, Tooltip, vec2};

use super::Facts;
use super::places::{APART, Places};
use super::theme::{colors, floating};

/// Their width before they were shown `[points]`.
const WIDTH: f32 = 146.0;

/// The row of what stepping takes, and what is said of it.
const STEPPING: &str = "stepping";
const OF_STEPPING: &str =
    "what stepping 1/60 s at its pace takes, by the clock: where that is more than a frame has, time goes slower";
/// The row of the energy, and what is said of it.
const ENERGY: &str = "energy";
/// That of how far what keeps its length is stretched, which is marked from this strain on `[1]`.
const STRETCH: &str = "stretch";
pub(super) const STRETCHED: f64 = 0.01;
const OF_STRETCH: &str =
    "how far the rigid bond is stretched that is most; springs, which are made to stretch, are not among them";
const OF_ENERGY: &str = "energy of motion, springs and gravity (0 at y = 0)";
/// That of how stiff relaxed bonds are.
const RELAXED: &str = "relaxed";
const OF_RELAXED: &str = "relaxed bonds give way like springs of this stiffness, by the substep and the sweeps of now: measured whenever bonds, masses or the method change";

/// Shows them at the right edge, below the buttons where those leave no place for them.
pub(super) fn show(context: &egui::Context, places: &mut Places, facts: &Facts) {
    let id = Id::unique("figures");
    let width = context.memory(|memory| memory.area_rect(id)).map_or(WIDTH, |rect| rect.width().max(WIDTH));
    places.make_way(width);
    let place = Area::new(id).anchor(Align2::RIGHT_TOP, [-10.0, places.right]).interactable(false);
    let shown = place.show(context, |ui| {
        let (mut said, mut tops): (Vec<(Rect, &str)>, Vec<f32>) = (Vec::new(), Vec::new());
        floating(ui).show(ui, |ui| {
            egui::Grid::new("figures").num_columns(2).spacing([14.0, 1.0]).show(ui, |ui| {
                for (name, value) in rows(facts) {
                    let label = ui.weak(name);
                    tops.push(label.rect.top());
                    match name {
                        STEPPING => said.push((label.rect, OF_STEPPING)),
                        ENERGY => said.push((label.rect, OF_ENERGY)),
                        STRETCH => said.push((label.rect, OF_STRETCH)),
                        RELAXED => said.push((label.rect, OF_RELAXED)),
                        _ => {}
                    }
                    let is_marked = name == STRETCH && facts.stretch.is_some_and(|stretch| stretch >= STRETCHED);
                    let value = RichText::new(value).monospace();
                    let value = if is_marked { value.color(colors(ui).away) } else { value };
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(value));
                    ui.end_row();
                }
            });
        });
        (said, tops.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f32::max))
    });
    let (all, (said, row)) = (shown.response.rect, shown.inner);
    // Presses go through the figures, so that what is said of them is shown by hand.
    let is_under = |row: &Rect, at| Rect::from_x_y_ranges(all.x_range(), row.y_range()).contains(at);
    let at = context.pointer_hover_pos();
    let under = at.and_then(|at| said.into_iter().find(|(row, _)| is_under(row, at)).map(|(_, words)| (at, words)));
    if let Some((at, words)) = under {
        let layer = LayerId::new(Order::Tooltip, id);
        let anchor = PopupAnchor::Position(at + vec2(0.0, 16.0));
        Tooltip::always_open(context.clone(), layer, id.with("said"), anchor).show(|ui| ui.label(words));
    }
    places.right = all.bottom() + APART;
    // The row of what is stretched comes and goes with the bonds that are rigid: whoever sets those is not to be moved by it.
    places.kept = if facts.stretch.is_none() { row } else { 0.0 };
}

fn rows(facts: &Facts) -> Vec<(&'static str, String)> {
    let figures = &facts.figures;
    // Where nothing moves no frames are made, and what the last ones took says nothing.
    let is_idle = !figures.playing || figures.asleep || facts.waits;
    let time = |words: String| if is_idle { "idle".to_owned() } else { words };
    let rows = [
        ("frame", time(format!("{:.1} ms", 1e3 * facts.frame))),
        (STEPPING, time(format!("{:.2} ms", 1e3 * figures.work))),
        ("points", figures.points.to_string()),
        ("bonds", figures.bonds.to_string()),
        (ENERGY, energy(figures.energy)),
    ];
    let stretch = facts.stretch.map(|stretch| (STRETCH, percent(stretch)));
    let relaxed = figures.relaxed.map(|stiffness| (RELAXED, of_stiffness(stiffness)));
    rows.into_iter().chain(stretch).chain(relaxed).collect()
}

/// A strain in percent, rounded as it is called stretched: from one on.
fn percent(strain: f64) -> String {
    match 100.0 * strain {
        percent if percent < 1.0 => "< 1 %".to_owned(),
        percent if percent < 9.95 => format!("{percent:.1} %"),
        percent if percent < 1e4 => format!("{percent:.0} %"),
        percent => format!("{percent:.1e} %"),
    }
}

/// A stiffness `[N/m]` with three digits.
fn of_stiffness(stiffness: f64) -> String {
    match stiffness {
        stiffness if stiffness < 99.95 => format!("{stiffness:.1} N/m"),
        stiffness if stiffness < 99_950.0 => format!("{stiffness:.0} N/m"),
        stiffness => format!("{stiffness:.1e} N/m"),
    }
}

/// An energy `[J]` in at most eleven characters: what is large has no millijoules, and what is nothing no sign.
fn energy(value: f64) -> String {
    match value.abs() {
        size if size < 5e-4 => "0.000 J".to_owned(),
        size if size < 1e4 => format!("{value:.3} J"),
        size if size < 1e7 => format!("{value:.0} J"),
        _ => format!("{value:.2e} J"),
    }
}

#[cfg(test)]
mod tests {
    use egui::{Id, Rect};

    use super::{Facts, Places, RELAXED, STEPPING, energy, percent, rows, show};
    use crate::app::player::Figures;

    #[test]
    fn what_is_selected_stays_where_it_is_as_rigid_bonds_come_and_go() {
        let low = |stretch: Option<f64>| {
            let facts = Facts { stretch, dimensions: 2, ..Facts::default() };
            let (context, mut low) = (egui::Context::default(), [0.0; 2]);
            let screen = Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1280.0, 720.0));
            for _ in 0..3 {
                let input = egui::RawInput { screen_rect: Some(screen), ..egui::RawInput::default() };
                let mut output = context.run_ui(input, |ui| {
                    let mut places = Places::new(screen, false);
                    show(ui.ctx(), &mut places, &facts);
                    let figures = ui.memory(|memory| memory.area_rect(Id::unique("figures")));
                    let selected = places.of_tools((None, None), 0.0).right;
                    low = [figures.map_or(0.0, |at| at.bottom()), selected.top()];
                });
                output.textures_delta.clear();
            }
            low
        };
        let [with, without] = [Some(0.0), None].map(low);
        assert!(with[0] > without[0] + 10.0, "they are a row higher: {with:?} {without:?}");
        assert!((with[1] - without[1]).abs() < 0.5, "{with:?} {without:?}");
    }

    #[test]
    fn stepping_takes_what_the_line_below_says_of_slow_motion() {
        let figures = Figures { playing: true, pace: 0.5, step: 0.002, work: 0.036, ..Figures::default() };
        let rows = rows(&Facts { figures, ..Facts::default() });
        assert!(rows.contains(&(STEPPING, "36.00 ms".to_owned())), "{rows:?}");
    }

    #[test]
    fn how_stiff_relaxed_bonds_are_is_seen_at_once() {
        let of = |relaxed: Option<f64>| {
            let figures = Figures { relaxed, ..Figures::default() };
            rows(&Facts { figures, ..Facts::default() }).into_iter().find(|(name, _)| *name == RELAXED)
        };
        assert_eq!(of(None), None);
        for (stiffness, words) in [(151.58, "152 N/m"), (7.04, "7.0 N/m"), (2.3e6, "2.3e6 N/m")] {
            assert_eq!(of(Some(stiffness)), Some((RELAXED, words.to_owned())));
        }
    }

    #[test]
    fn what_keeps_its_length_is_called_stretched_from_a_hundredth_on() {
        let all = [(-0.1, "< 1 %"), (0.0099, "< 1 %"), (0.0126, "1.3 %"), (0.98, "98 %"), (1e6, "1.0e8 %")];
        for (value, text) in all {
            assert_eq!(percent(value), text);
        }
    }

    #[test]
    fn energies_of_any_size_are_short() {
        let all = [(1.25, "1.250 J"), (-489_525.175, "-489525 J"), (-4.8e12, "-4.80e12 J"), (-1e-5, "0.000 J")];
        for (value, text) in all {
            assert_eq!(energy(value), text);
        }
    }
}
