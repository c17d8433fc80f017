//! What actions do.

use std::time::{Duration, Instant};

use winit::window::Fullscreen;

use super::asking::points_of;
use super::{Framing, Session};
use crate::app::action::{Action, Primitive, Tool};
use crate::app::count::counted;
use crate::app::panels::{Cover, Opened, Setting, Sheet, Wish, at_end, is_said, search_id};
use crate::app::player::{Order, Player};
use crate::app::thumbnails::Thumbnails;
use crate::app::tools::{Deed, PushWay, is_of_space, lack_of, strength, unpin};
use crate::history::Do;
use crate::scene::{EMPTY, Entry, gallery};
use crate::sim::{MouseChange, PointId};

/// The least and the greatest pace, in seconds of the scene itself.
const PACES: [f64; 2] = [0.125, 4.0];
/// A key that is let go so soon was pressed for a moment.
const TAP: Duration = Duration::from_millis(400);
/// Said as the panels go.
const HIDDEN: &str = "the panels are hidden: Tab brings them back";
/// Said of what cannot be done yet.
const OPENING: &str = "it is still opening";
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

    /// Hides the panels and says how they come back, or brings them back.
    fn toggle_panels(&mut self) {
        self.panels.hides_panels = !self.panels.hides_panels;
        match self.panels.hides_panels {
            true => self.say(HIDDEN.to_owned()),
            false => self.panels.notes.take_back(|line| line == HIDDEN),
        }
    }

    /// The key that takes the tool for pins was let go: pressed for a moment without a click it lets the pin under the pointer go.
    fn end_pins(&mut self) {
        let is_tap = self.pins_since.take().is_some_and(|since| since.elapsed() < TAP);
        let is_used = self.hand.hold_pins(false);
        if let Some(at) = self.pixel().filter(|_| is_tap && !is_used && !self.is_over_panels()) {
            let deed = self.with_scope(|_, scope| unpin(scope, at));
            self.do_deed(deed);
        }
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

    /// The key of the tool that builds, while that is taken: it makes the next thing.
    pub(in crate::app) fn build_next(&mut self) {
        self.leave_drawing();
        let mut next = self.hand.primitive().next();
        while self.scene.dimensions() == 3 && !is_of_space(next) {
            next = next.next();
        }
        self.hand.choose(next);
        self.panels.bring(Opened::Tool);
        self.say(format!("build: {}", next.name().to_lowercase()));
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
            Wish::Brush(brush) => self.hand.set_brush(brush),
            Wish::Bear => self.bear(),
            Wish::Wear => self.choose_to_wear(),
            Wish::Lasso(is_lasso) => self.hand.draw_lasso(is_lasso),
            Wish::Beside(entry) => self.put_beside(entry),
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
            Wish::Stay => self.player.stay(),
            Wish::Exact => self.player.ask(Order::Exact),
            Wish::TakeBack => self.player.ask(Order::TakeBack),
            Wish::WriteTable => self.write_table(),
            Wish::WriteFigure => self.write_figure(),
            Wish::SaveTo(path) => {
                // The sheet stays until it is written.
                self.panels.save_to.begin_to_write(&path);
                match self.panels.save_to.is_all {
                    true => self.save_to(path),
                    false => self.save_moment(path),
                }
            }
            Wish::StopOpening => {
                self.stop_opening();
            }
            Wish::BrowseToSave => self.browse_to_save(),
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

    /// Ends what is under way; else closes the topmost of what lies over the world; it never leaves.
    fn cancel(&mut self) {
        // A sheet lies over all else.
        if self.panels.sheet.is_some() {
            return self.close_sheet();
        }
        if self.asked.is_some() {
            return self.answer_by(Action::Cancel);
        }
        if self.player.going().is_some_and(|going| is_said(&going)) {
            return self.player.stay();
        }
        if self.hand.is_drawing() {
            return self.leave_drawing();
        }
        let (was_busy, deed) = self.hand.cancel();
        self.do_deed(deed);
        if was_busy {
            return;
        }
        let is_closed = self.panels.notes.close() || self.loading.take().is_some() || self.stop_opening();
        if is_closed {
            return;
        }
        if self.import.is_some() {
            return self.put_away();
        }
        // In a field of a panel Esc gives up what is written: at once, so that the next one closes whatever came between.
        match self.is_writing() && !self.is_searching_settings() {
            true => self.leave_field(),
            false => self.close_panel(),
        }
    }

    /// Closes the panel that was opened last.
    fn close_panel(&mut self) {
        self.panels.has_selection = self.with_scope(|hand, scope| hand.chosen(scope)).is_some();
        match self.panels.opened_last() {
            Some(Opened::Settings) => self.close_settings(),
            Some(Opened::Selection) => self.hand.deselect(),
            Some(Opened::Plots) => self.toggle_plots(),
            Some(Opened::Lessons) => self.toggle_lessons(),
            Some(Opened::Tool) | None => {}
        }
    }

    /// Leaves what is drawn click by click: bonds that were drawn come into the world.
    pub(super) fn leave_drawing(&mut self) {
        if self.hand.is_drawing() {
            let deed = self.with_scope(|hand, scope| hand.leave_drawing(scope));
            self.do_deed(deed);
        }
    }

    /// Takes a tool; one that has no panel which says what to do says so.
    fn take(&mut self, tool: Tool) {
        if let Some(why) = lack_of(tool, self.shown().driving) {
            return self.refuse(&why);
        }
        self.leave_drawing();
        self.hand.take(tool);
        self.panels.take(tool);
        // It is of the hand.
        self.place_hint();
        self.find_hinge();
        if tool == Tool::Build && self.scene.dimensions() == 3 && !is_of_space(self.hand.primitive()) {
            self.hand.choose(Primitive::SolidCircle);
        }
        if tool == Tool::Push {
            // Wind has a button of its own, and torques are of the plane.
            match self.hand.push_way() {
                PushWay::Turn if self.scene.dimensions() != 2 => self.hand.set_push_way(PushWay::default()),
                PushWay::Wind => self.hand.set_push_way(PushWay::default()),
                _ => {}
            }
        }
        let words = match tool {
            Tool::Pin => "pin: click a point to hold it where it is, or a pin to let it go",
            Tool::Cut => "cut: drag across bonds",
            Tool::Erase => "erase: click bodies, bonds and obstacles, or drag over them; Ctrl+Z brings them back",
            _ => return,
        };
        self.say(words.to_owned());
    }

    /// A search that is filled is not there when they open again: it would hide the most.
    fn close_settings(&mut self) {
        self.panels.has_settings = false;
        self.panels.settings_search.clear();
        self.leave_field();
    }

    fn toggle_sheet(&mut self, sheet: Sheet) {
        self.panels.sheet = (self.panels.sheet != Some(sheet)).then_some(sheet);
        self.panels.is_fresh = true;
        self.panels.keys_search.clear();
        if self.panels.sheet == Some(Sheet::Gallery) {
            // What is typed from now on is looked for, and what lay over the world is put away with it.
            self.panels.search.clear();
            self.egui.egui_ctx().memory_mut(|memory| memory.request_focus(search_id()));
            self.put_away();
        }
        self.panels.chosen = if self.panels.search.is_empty() { self.place.unwrap_or(0) } else { 0 };
        if self.panels.sheet == Some(Sheet::Gallery) {
            self.draw_leftovers();
        }
        if self.panels.sheet == Some(Sheet::Gallery) && self.thumbnails.is_none() {
            let folder = self.state_folder.as_ref().map(|folder| folder.join("thumbnails"));
            self.thumbnails = Some(Thumbnails::new(self.canvas.gpu().clone(), self.palette, folder, self.wake_up()));
        }
    }

    /// Back to the start. While a step takes long it is left to itself, and the start is played anew at once.
    fn reset(&mut self) {
        if !self.player.is_open() {
            return self.say(OPENING.to_owned());
        }
        // What was built would not be in what is played anew.
        if self.player.is_busy() && !self.player.is_used() {
            let start = self.player.start().clone();
            let playing = self.player.is_playing();
            let camera = self.camera;
            let keeping = self.keeping();
            self.teaches = self.taught;
            self.put_on(Player::open(start, keeping, self.wake_up()));
            self.player.play(playing);
            self.camera = camera;
        } else {
            let held = std::mem::take(&mut self.driving);
            self.go(Order::Reset);
            // Keys that are held down drive on.
            for (key, drives) in held {
                self.driving.push((key, drives));
                self.give_key(drives, true);
            }
        }
    }

    fn delete(&mut self) {
        let at = self.pixel();
        let deed = self.with_scope(|hand, scope| hand.delete(scope, at));
        self.do_deed(deed);
    }

    /// Gives commands to the world, if there are any.
    pub(super) fn do_deed(&mut self, deed: Deed) {
        if let Some(words) = deed.words.clone() {
            let over = self.lies_over();
            self.panels.notes.say_of_tool(words, over);
            self.touch();
        }
        if deed.edit.is_some() {
            self.panels.notes.offer_motor(deed.motor_for);
        }
        if let Some(among) = deed.painted.clone() {
            let brush = self.hand.brush();
            let change = brush.change();
            let bonds = among.bonds.as_ref().map_or(0, Vec::len);
            self.say(format!(
                "{}: {} and {}; Ctrl+Z takes it back",
                brush.name(),
                counted(among.points.len(), "point"),
                counted(bonds, "bond")
            ));
            self.painted.extend(&among.points);
            self.player.ask(Order::Change { among, change, goes_on: false });
            self.dirty = true;
        }
        if !deed.is_empty() {
            let coming = points_of(&deed.commands, &self.scene);
            self.ask_if_full(coming, move |session| session.player.give(deed.commands, deed.edit));
        }
    }

    /// Time stands still or goes on: not past the end, unless what was done there already is followed.
    fn toggle_play(&mut self) {
        let figures = &self.shown().figures;
        let end = at_end(figures).filter(|_| !figures.follows && !self.player.is_playing());
        match end {
            Some(words) => self.say(format!("{words}; without \"ends\" in the settings it goes on")),
            None => self.player.play(!self.player.is_playing()),
        }
    }

    /// Something is set of the scene. The strength of the hover force is the hand's to give, which may hold it away now.
    fn set(&mut self, Setting { act, name, goes_on }: Setting) {
        if let Do::Mouse(MouseChange { strength: Some(strength), radius, .. }) = act {
            self.hand.set_strength(Some(strength));
            // One that is only just to be is there at once.
            if self.hand.is_calm() && radius.is_none() {
                return;
            }
        }
        self.player.set(self.of_what_is_left(act), name, goes_on);
        self.dirty = true;
    }

    /// The same without bonds and points that were cut or taken away since: numbers that a scene names are of those that are left.
    fn of_what_is_left(&self, act: Do) -> Do {
        let Do::Set(mut keys) = act else { return act };
        let scenery = &self.shown().scenery;
        if let Some(bonds) = &keys.bonds {
            let mut there: Vec<u32> = (0..scenery.bonds.len()).map(|place| scenery.bond_number(place)).collect();
            there.sort_unstable();
            let stays: Vec<bool> = bonds.iter().map(|bond| there.binary_search(bond).is_ok()).collect();
            *keys = keys.among(&stays);
        } else if let Some(points) = &keys.points {
            let stays: Vec<bool> = points.iter().map(|i| scenery.gone.binary_search(&PointId(*i)).is_err()).collect();
            *keys = keys.among(&stays);
        }
        Do::Set(keys)
    }

    /// The hover force gets stronger and larger by these factors.
    fn change_force(&mut self, stronger: f64, larger: f64) {
        let Some(force) = self.live_force() else {
            return self.say("this scene has no push of the mouse".to_owned());
        };
        let radius = force.radius * larger;
        let base = self.hand.strength().unwrap_or(force.strength) * stronger;
        self.hand.set_strength(Some(base));
        let is_calm = self.hand.is_calm();
        let mut commands = vec![Do::Mouse(MouseChange { radius: Some(radius), ..MouseChange::default() })];
        if !is_calm {
            commands.push(strength(base));
        }
        self.player.give(commands, None);
        self.say(format!("push: {base:.0} /s² within {radius:.2} m"));
    }

    /// Seconds of the scene a second of wall time, in those of the scene itself.
    pub(super) fn pace(&self) -> f64 {
        let figures = &self.shown().figures;
        figures.rate / figures.clock.rate
    }

    fn set_pace(&mut self, pace: f64) {
        let pace = pace.clamp(PACES[0], PACES[1]);
        let own = if self.player.is_open() { self.shown().figures.clock.rate } else { self.scene.rate() };
        self.player.ask(Order::Rate(pace * own));
        self.say(format!("pace: {pace} x"));
    }

    /// What the gallery says of the scene.
    pub(super) fn entry(&self) -> Option<&'static Entry> {
        self.place.map(|place| &gallery()[place])
    }

    fn open_beside(&mut self, by: isize) {
        // A canvas that lies over this one is put away with it.
        self.put_away();
        let count = gallery().len() as isize;
        let place = self.place.map_or(0, |place| (place as isize + by).rem_euclid(count));
        self.open_named(gallery()[place as usize].name);
    }

    fn open_named(&mut self, name: &str) {
        if name == EMPTY.name {
            return self.open_empty();
        }
        let Some(entry) = gallery().iter().find(|entry| entry.name == name) else { return };
        match entry.scene() {
            Ok(scene) => self.open(scene.into()),
            Err(error) => self.complain(&error.to_string()),
        }
    }

    fn toggle_full_screen(&mut self) {
        let is_full = self.window.fullscreen().is_some();
        self.window.set_fullscreen((!is_full).then_some(Fullscreen::Borderless(None)));
    }

    /// Says what was just done.
    pub(super) fn say(&mut self, line: String) {
        let over = self.lies_over();
        self.panels.notes.say(line, over);
        self.touch();
    }

    /// Says why something was not done, until something else is tried.
    pub(super) fn refuse(&mut self, line: &str) {
        self.panels.notes.refuse(line.to_owned(), self.lies_over());
        self.touch();
    }

    /// Says what went wrong, until it is read.
    pub(super) fn complain(&mut self, line: &str) {
        self.panels.notes.complain(line.to_owned(), self.lies_over());
        self.touch();
    }

    /// What lies over the world: what is said now is of that.
    fn lies_over(&self) -> Cover {
        Cover::of(self.panels.sheet, self.import.is_some())
    }
}
