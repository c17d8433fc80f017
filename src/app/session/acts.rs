//! What actions do.

use std::path::PathBuf;
use std::time::Instant;

use winit::window::Fullscreen;

use super::{Framing, Session};
use crate::app::action::{Action, Tool};
use crate::app::panels::{Opened, Saved, Sheet, Wish};
use crate::app::player::Order;
use crate::app::tools::PushWay;

/// Said of what cannot be done yet.
pub(super) const OPENING: &str = "it is still opening";
/// What one press of a key makes the hover force larger by.
const LARGER: f64 = 1.15;

impl Session {
    /// Does what the user asks; leaving is the window's affair.
    pub(in crate::app) fn act(&mut self, action: Action) {
        // Esc closes what is said itself.
        if action != Action::Cancel {
            self.panels.notes.go_on();
        }
        match action {
            Action::TogglePlay => self.toggle_play(),
            Action::Step => self.player.ask(Order::Step(self.told)),
            Action::Rewind => {
                self.leave_drawing();
                self.hand.let_go();
                self.rewinds = true;
            }
            Action::Reset => self.reset(),
            Action::Slower => self.set_pace(0.5 * self.pace()),
            Action::Faster => self.set_pace(2.0 * self.pace()),
            Action::PreviousScene => self.open_beside(-1),
            Action::NextScene => self.open_beside(1),
            Action::Gallery => {
                self.tell_leftovers();
                self.toggle_sheet(Sheet::Gallery);
            }
            Action::Help => self.toggle_sheet(Sheet::Help),
            // What is drawn click by click is not done yet.
            Action::Undo if self.hand.is_drawing() => self.hand.step_back(),
            Action::StepBack => self.hand.step_back(),
            Action::Finish if self.asked.is_some() => self.answer_by(action),
            Action::Finish if self.import.is_some() => {
                if let Some(import) = &mut self.import {
                    import.enter();
                }
                self.touch();
            }
            Action::Finish => {
                let deed = self.with_scope(|hand, scope| hand.finish(scope));
                self.do_deed(deed);
            }
            // What is on its way is not there to be changed: that it was opened is undone.
            Action::Undo | Action::Redo if !self.player.is_open() => {
                if action == Action::Redo || !self.stop_opening() {
                    self.say(OPENING.to_owned());
                }
            }
            Action::Undo => self.player.ask(Order::Undo(self.told)),
            Action::Redo => self.player.ask(Order::Redo(self.told)),
            Action::Take(tool) => self.take(tool),
            Action::Wind => {
                self.take(Tool::Push);
                self.hand.set_push_way(PushWay::Wind);
            }
            Action::PinWhileHeld => {
                self.hand.hold_pins(true);
                self.pins_since = Some(Instant::now());
            }
            Action::Delete => self.delete(),
            Action::Duplicate => self.duplicate(),
            Action::Copy => self.copy(),
            Action::FlipAcross => self.flip(0),
            Action::FlipOver => self.flip(1),
            Action::SelectAll => self.select_all(),
            Action::Group => self.group(),
            Action::Ungroup => self.ungroup(),
            Action::Hide => self.hide(),
            Action::ShowHidden => self.show_hidden(),
            Action::New => self.open_empty(),
            Action::Clear => {
                self.leave_drawing();
                self.clear();
            }
            Action::Dice => self.roll(),
            Action::SmallerRegion => self.change_force(1.0, 1.0 / LARGER),
            Action::LargerRegion => self.change_force(1.0, LARGER),
            Action::Weaker => self.change_force(1.0 / LARGER, 1.0),
            Action::Stronger => self.change_force(LARGER, 1.0),
            Action::Fit => self.frame_as(Framing::Fit),
            Action::Home => self.frame_as(Framing::Opening),
            Action::ToggleMesh => self.look.has_mesh = !self.look.has_mesh,
            Action::Show(showing) => self.show_as(showing),
            Action::NextShowing => self.show_as(self.showing().next()),
            Action::Palette => self.recolor(),
            Action::ToggleGrid => self.look.has_grid = !self.look.has_grid,
            Action::ToggleTrails => self.toggle_trails(),
            Action::Paint => self.paint(),
            Action::Import => self.cut_anew(),
            Action::Open => {
                self.wearer = None;
                self.choose_file();
            }
            Action::Paste => self.paste(),
            Action::Save => self.save(),
            Action::Screenshot => self.take_screenshot(),
            Action::Clip => self.save_clip(self.free_path("gif")),
            Action::Settings if self.panels.is_seen(Opened::Settings) => self.close_settings(),
            Action::Settings => self.panels.toggle_settings(),
            Action::FindSetting => {
                (self.panels.has_settings, self.panels.finds_setting) = (true, true);
                self.panels.bring(Opened::Settings);
            }
            Action::Plots => self.toggle_plots(),
            Action::Lessons => self.toggle_lessons(),
            Action::TogglePanels => self.toggle_panels(),
            Action::ToggleHud => self.panels.hides_hud = !self.panels.hides_hud,
            Action::FullScreen => self.toggle_full_screen(),
            Action::Cancel => self.cancel(),
            Action::Quit => return,
        }
        self.touch();
    }

    /// A key that is held was let go.
    pub(in crate::app) fn let_go_of(&mut self, action: Action) {
        match action {
            Action::Rewind => (self.rewinds, self.gone_by) = (false, Some(self.player.serial())),
            Action::PinWhileHeld => self.end_pins(),
            _ => return,
        }
        self.touch();
    }

    /// Does what the panels ask for.
    pub(super) fn grant(&mut self, wish: Wish) {
        match wish {
            Wish::Act(action) => self.act(action),
            Wish::OpenScene(name) => self.open_named(name),
            Wish::Learn(at) => self.learn(at),
            Wish::Build(primitive) => {
                self.leave_drawing();
                self.hand.choose(primitive);
            }
            Wish::Push(way) => self.hand.set_push_way(way),
            Wish::Links(links) => self.hand.set_links(links),
            Wish::BuildOf(of) => self.hand.build_of(of),
            Wish::Hold(key) => self.hold_by_mouse(key),
            Wish::Drives(drives) => self.hand.set_drives(drives),
            Wish::GiveMotor(hub) => {
                let deed = self.with_scope(|hand, scope| hand.give_motor(scope, hub));
                self.do_deed(deed);
            }
            Wish::Set(setting) => self.set(setting),
            Wish::Matter(change, goes_on) => self.change_matter(change, goes_on),
            Wish::Place(placing, goes_on) => self.place(placing, goes_on),
            Wish::Brush(brush) => self.hand.set_brush(brush),
            Wish::Bear => self.bear(),
            Wish::Wear => self.choose_to_wear(),
            Wish::Lasso(is_lasso) => self.hand.draw_lasso(is_lasso),
            Wish::Beside(solver) => self.put_beside(solver),
            Wish::TakeAway(place) => self.take_away(place),
            Wish::TintDistance(tints) => self.tints_distance = tints,
            Wish::Solver(solver) => self.player.ask(Order::Solver(solver)),
            Wish::Method(setting, goes_on) => self.player.ask(Order::Method(setting, goes_on)),
            Wish::Begin(precision, tolerance) => self.player.ask(Order::Begin(precision, tolerance)),
            Wish::Give(acts, name) => self.player.give(acts, Some(name)),
            Wish::Trails(settings) => self.set_trails(settings),
            Wish::Pace(pace) => self.set_pace(pace),
            Wish::GoTo(time) => {
                self.go(Order::GoTo(time, self.told));
            }
            Wish::ToBranch(number) => {
                self.go(Order::ToBranch(number, self.told));
            }
            Wish::CallBranch(number, title) => self.player.ask(Order::CallBranch(number, title)),
            Wish::DiscardBranch(number) => self.player.ask(Order::DiscardBranch(number)),
            Wish::Stay => self.player.stay(),
            Wish::Exact => self.player.ask(Order::Exact),
            Wish::TakeBack => self.player.ask(Order::TakeBack),
            Wish::WriteTable => self.ask_where_to_plot(Saved::Table),
            Wish::WriteFigure => self.ask_where_to_plot(Saved::Figure),
            Wish::SaveTo(path) => self.save_as_asked(path),
            Wish::StopOpening => {
                self.stop_opening();
            }
            Wish::BrowseToSave => self.browse_to_save(),
            Wish::GiveUpClip => _ = self.give_up_clip(),
            Wish::GoOnWithLeftover(place) => self.go_on_with_leftover(place),
            Wish::DiscardLeftover(place) => self.discard_leftover(place),
            Wish::DiscardLeftovers => self.discard_leftovers(),
            Wish::PutOffLeftover => self.panels.notes.offer = None,
            Wish::OpenFile(name) => self.open_file(&name),
            Wish::OpenRecent(path) => {
                self.wearer = None;
                self.take_file(&path);
            }
        }
        self.touch();
    }

    /// Writes what a name was asked for to a file of that name.
    fn save_as_asked(&mut self, path: PathBuf) {
        let kind = self.panels.save_to.kind;
        if kind != Saved::Clip {
            // The sheet stays until it is written.
            self.panels.save_to.begin_to_write(&path);
        }
        match kind {
            Saved::All => self.save_to(path),
            Saved::Moment => self.save_moment(path),
            Saved::Table => self.write_table(path),
            Saved::Figure => self.write_figure(path),
            Saved::Clip => {
                self.panels.sheet.take_if(|sheet| *sheet == Sheet::SaveTo);
                self.save_clip(path);
            }
        }
    }

    fn toggle_full_screen(&mut self) {
        let is_full = self.window.fullscreen().is_some();
        self.window.set_fullscreen((!is_full).then_some(Fullscreen::Borderless(None)));
    }
}
