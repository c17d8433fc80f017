//! The import panel: sliders on one side, the picture with its mesh on the other.

use std::time::Duration;

use super::worker::Forecast;
use super::{Answer, Import, preview, wishes};
use crate::app::count::counted;
use crate::app::loading;
use crate::app::panels::{said_below, sheet, theme};
use crate::picture::{PictureError, Settings, Threshold};
use crate::scene::Matter;

/// What takes less time than this is not worth a bar; and the time between two looks at it.
const PATIENCE: Duration = Duration::from_millis(400);
const LOOK: Duration = Duration::from_millis(100);
/// Width of the screen from which on the sliders stand beside the picture `[points]`.
const WIDE: f32 = 840.0;
/// Width of the sliders at least: the longest name of one has room `[points]`.
const COLUMN: f32 = 336.0;
/// Height of what stands over and under the part that scrolls: title, buttons, margins, the bar below `[points]`.
const BESIDE: f32 = 174.0;
/// Height of a line of words below the buttons `[points]`.
const LINE: f32 = 24.0;
/// Height of that part at least `[points]`.
const LEAST_TALL: f32 = 60.0;
/// Height of a canvas's tools `[points]`.
const TOOLS: f32 = 94.0;
/// Width of margins and of the bar that scrolls `[points]`.
const MARGINS: f32 = 48.0;

/// Shows the panel. What is changed in it is changed in the import's wish.
pub(super) fn show(import: &mut Import, context: &egui::Context, can_add: bool) -> Option<Answer> {
    let mut answer = None;
    let title = match (&import.painting, import.body) {
        (Some(_), _) => "Draw a body".to_owned(),
        (None, Some(_)) => format!("The picture in {}", import.name),
        (None, None) => format!("Import {}", import.name),
    };
    let room = context.content_rect().size() - egui::vec2(0.0, said_below(context));
    let stays = sheet(context, "import", title, |ui| {
        if let Some(painting) = &mut import.painting {
            painting.keys(ui.ctx());
        }
        // Whether it says why there is nothing or not, the picture stays as large as it is.
        let below = LINE * f32::from(!can_add) + LINE * f32::from(import.painting.is_none());
        let tall = (room.y - BESIDE - below).max(LEAST_TALL);
        let broad = room.x - MARGINS;
        // Where another one was scrolled to says nothing of this one.
        let is_fresh = std::mem::take(&mut import.is_fresh);
        let from_top = |area: egui::ScrollArea| if is_fresh { area.scroll_offset(egui::Vec2::ZERO) } else { area };
        if room.x >= WIDE && tall >= preview::LEAST + TOOLS {
            // The picture stays, whatever is looked for beside it.
            ui.horizontal_top(|ui| {
                ui.vertical(|ui| picture(ui, import, preview::LARGEST.min(tall - TOOLS)));
                // All that is left beside it is theirs: the bar that scrolls them stands at the edge of the dialog.
                let beside = egui::ScrollArea::vertical().max_height(tall).min_scrolled_height(tall);
                let beside = beside.auto_shrink([false, true]);
                from_top(beside).show(ui, |ui| ui.vertical(|ui| sliders(ui, import)));
            });
        } else {
            let all = egui::ScrollArea::both().max_height(tall).max_width(broad);
            from_top(all.min_scrolled_height(tall).min_scrolled_width(broad)).show(ui, |ui| {
                ui.set_max_width(broad);
                picture(ui, import, preview::LARGEST.min(broad));
                sliders(ui, import);
            });
        }
        ui.separator();
        answer = buttons(ui, import, can_add);
    });
    if stays { answer } else { Some(Answer::Cancel) }
}

/// The picture with its mesh, at most so large `[points]`; the tools over it, if it is painted.
fn picture(ui: &mut egui::Ui, import: &mut Import, side: f32) {
    if let Some(painting) = &mut import.painting {
        painting.tools(ui);
    }
    preview::show(ui, import, side.max(preview::LEAST));
    if import.painting.is_none() {
        ui.weak("what lies within the green line becomes the body");
    }
}

fn sliders(ui: &mut egui::Ui, import: &mut Import) {
    ui.set_width(ui.available_width().max(COLUMN));
    let is_painted = import.painting.is_some();
    wishes::show(ui, &mut import.wish, (&import.picture, import.ground), is_painted);
    ui.separator();
    words(ui, import.forecast.as_ref());
    // Always there, so that nothing moves under the pointer.
    let at_work = import.worker.at_work.as_ref().map(|(watch, since)| (watch.stage(), since.elapsed()));
    let bar = match at_work.filter(|(_, since)| *since > PATIENCE) {
        Some((stage, since)) => egui::ProgressBar::new(stage.share()).text(loading::words(stage, since)),
        None => egui::ProgressBar::new(0.0),
    };
    ui.add_visible(at_work.is_some_and(|(_, since)| since > PATIENCE), bar);
    if at_work.is_some() {
        ui.ctx().request_repaint_after(LOOK);
    }
}

/// Why there is nothing to bring, and whether something is wrong: on a canvas there is nothing at first.
fn refusal(import: &Import) -> Option<(String, bool)> {
    match &import.forecast {
        Some(Err(error)) if import.is_canvas() && error.starts_with("there is nothing in the picture") => {
            Some(("draw something on the canvas".to_owned(), false))
        }
        Some(Err(error)) => Some((worded(error.clone(), &import.wish.settings), true)),
        _ => None,
    }
}

/// What is wrong with a picture in the words of the panel: in those of a scene file its least area is a key, and where all of a picture is taken
/// the panel has none.
pub(super) fn worded(fault: String, settings: &Settings) -> String {
    let dropped = PictureError::Dropped { min_area: settings.min_area }.to_string();
    if !fault.contains(&dropped) {
        return fault;
    }
    let least = settings.min_area;
    let words = match settings.threshold {
        Threshold::Whole => format!("the picture is too small: {least} px² are the least"),
        _ => format!("nothing in the picture is as large as {least} px²: lower the least area"),
    };
    fault.replace(&dropped, &words)
}

fn words(ui: &mut egui::Ui, forecast: Option<&Result<Forecast, String>>) {
    match forecast {
        None => {
            ui.weak("cutting it out …");
        }
        // Said beside the buttons.
        Some(Err(_)) => {}
        Some(Ok(Forecast { outlines, corners, .. })) if *corners > 0 => {
            let outlines = if *outlines == 1 { "one outline".to_owned() } else { format!("{outlines} outlines") };
            ui.label(format!("{corners} corners in {outlines}"));
            ui.weak("points meet its ink and its holes");
        }
        Some(Ok(Forecast { mesh, bonds, frames: [falling, landing], scene, .. })) => {
            let parts = match (mesh.components, scene.bodies.len()) {
                (1, _) => "in one part".to_owned(),
                (count, 1) => format!("in {count} parts"),
                (_, count) => format!("in {count} bodies"),
            };
            let counts = [(mesh.points.len(), "point"), (*bonds, "bond"), (mesh.triangles.len(), "triangle")];
            let counts: Vec<String> = counts.iter().map(|&(count, what)| counted(count, what)).collect();
            ui.label(format!("{} {parts}", counts.join(", ")));
            ui.weak(format!(
                "about {} a frame in the air, {} where it lands",
                time(1e3 * falling),
                time(1e3 * landing)
            ));
        }
    }
}

/// A time `[ms]` in words.
fn time(ms: f64) -> String {
    match ms {
        ms if ms < 0.1 => "0.1 ms".to_owned(),
        ms if ms < 10.0 => format!("{ms:.1} ms"),
        ms => format!("{ms:.0} ms"),
    }
}

/// The first choice stands out: what leaves the scene as it is, and gives it the body.
fn buttons(ui: &mut egui::Ui, import: &mut Import, can_add: bool) -> Option<Answer> {
    let is_ready = matches!(import.forecast, Some(Ok(_)));
    let is_obstacle = import.wish.matter == Matter::Fixed;
    let add = ("Add to this scene", "it goes where there is room", Answer::Add, can_add);
    let place = ("Put in its place", "the body of the scene is cut out like this", Answer::Replace, true);
    let alone = ("Open by itself", "a scene of its own, in place of this one", Answer::Open, true);
    let choices = match import.body {
        // An obstacle is no body.
        Some(_) if !is_obstacle => [place, add, alone],
        _ if can_add => [add, alone, place],
        _ => [alone, add, place],
    };
    let count = if import.body.is_some() && !is_obstacle { 3 } else { 2 };
    let mut answer = None;
    let enters = std::mem::take(&mut import.is_entered);
    let fault = refusal(import);
    ui.horizontal_wrapped(|ui| {
        for (k, &(label, hint, choice, is_enabled)) in choices[..count].iter().enumerate() {
            let button = egui::Button::new(label);
            let button = if k == 0 { button.fill(ui.visuals().selection.bg_fill) } else { button };
            let is_clicked = ui.add_enabled(is_ready && is_enabled, button).on_hover_text(hint).clicked();
            let is_entered = k == 0 && is_ready && is_enabled && enters;
            if is_clicked || is_entered {
                answer = Some(choice);
            }
        }
        let close = if import.has_work() { ("Close", "Esc; N brings the drawing back") } else { ("Cancel", "Esc") };
        if ui.button(close.0).on_hover_text(close.1).clicked() {
            answer = Some(Answer::Cancel);
        }
        // Beside the buttons that are off for it: the words of what is found may be scrolled out of view.
        if let Some((fault, is_wrong)) = fault {
            let color = if is_wrong { theme::colors(ui).away } else { ui.visuals().weak_text_color() };
            ui.add(egui::Label::new(egui::RichText::new(fault).color(color)).wrap());
        }
    });
    if !can_add {
        ui.weak("Bodies of pictures lie in the plane: beside a scene in space it opens by itself.");
    }
    answer
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;

    /// The last of what is scrolled.
    const LAST: &str = "parts as bodies of their own";

    #[test]
    fn the_settings_take_all_that_the_picture_leaves_and_grow_no_wider() {
        for size in [[900.0, 500.0], [1280.0, 720.0]] {
            let import = Import::of_canvas(|| ()).unwrap();
            let shown = |ui: &mut egui::Ui, import: &mut Import| _ = import.show(ui.ctx(), true);
            let mut panel = Harness::builder().with_size(size).build_ui_state(shown, import);
            panel.run_steps(6);
            let dialog = |panel: &Harness<'_, Import>| {
                panel.ctx.memory(|memory| memory.area_rect(egui::Id::unique("import"))).unwrap()
            };
            let before = dialog(&panel);
            assert!(before.width() < size[0], "{size:?}: {before}");
            panel.run_steps(30);
            assert_eq!(dialog(&panel).width(), before.width(), "{size:?}");
            // A line across the settings ends where the dialog does, but for margins and the bar.
            let name = panel.get_by_label(LAST).rect();
            assert!(name.left() > before.left() + preview::LEAST && name.right() < before.right(), "{size:?}: {name}");
            assert!(
                before.right() - name.left() < COLUMN + MARGINS,
                "{size:?}: no strip beside them: {name}, {before}"
            );
        }
    }

    #[test]
    fn what_is_too_small_is_said_in_the_words_of_the_panel() {
        let cut = Settings { min_area: 12.0, threshold: Threshold::Otsu, ..Settings::default() };
        let fault = || PictureError::Dropped { min_area: 12.0 }.to_string();
        assert_eq!(worded(fault(), &cut), "nothing in the picture is as large as 12 px²: lower the least area");
        let whole = Settings { threshold: Threshold::Whole, ..cut };
        assert_eq!(worded(fault(), &whole), "the picture is too small: 12 px² are the least", "its slider is off");
        assert_eq!(worded("another".to_owned(), &cut), "another");
    }

    #[test]
    fn a_canvas_that_is_opened_again_is_at_its_top() {
        for size in [[500.0, 400.0], [900.0, 400.0]] {
            let import = Import::of_canvas(|| ()).unwrap();
            let shown = |ui: &mut egui::Ui, import: &mut Import| _ = import.show(ui.ctx(), true);
            let mut panel = Harness::builder().with_size(size).build_ui_state(shown, import);
            panel.run_steps(6);
            let at = |panel: &Harness<'_, Import>| panel.get_by_label(LAST).rect().top();
            let top = at(&panel);
            assert!(top > size[1], "all of it has no room: {top}");
            panel.get_by_label(LAST).scroll_to_me();
            panel.run_steps(30);
            assert!(at(&panel) < size[1], "scrolled to: {}", at(&panel));
            panel.state_mut().put_away();
            panel.run_steps(30);
            assert!((at(&panel) - top).abs() < 1.0, "{size:?}: {} in place of {top}", at(&panel));
        }
    }
}
