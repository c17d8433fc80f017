//! The panels beside a world without a window, a thread or a GPU: whoever shows them by another harness presses and types as in the program.

use std::sync::Arc;

use egui::{Context, Ui};

use super::action::{Action, Tool};
use super::matter::{Among, Fit, MatterChange, Overload, overload};
use super::panels::{self, Facts, Met, PanelState, Pushing, Setting, Settings, Sheet, Wish, parameters, theme};
use super::player::{Note, Order, Shown, Stage};
use super::tools::{PushWay, lack_of, no_motors, no_muscles};
use crate::history::{History, HistoryError};
use crate::lessons::lessons;
use crate::render::{Look, Palette};
use crate::scene::{Parameter, PrecisionName, Scene, gallery};
use crate::sim::PointId;

/// Panels and a world. What only a window can do, files and the clipboard, is not done.
pub struct Rehearsal {
    stage: Stage,
    shown: Shown,
    named: Vec<Parameter>,
    state: PanelState,
    tool: Tool,
    push: PushWay,
    palette: Palette,
    selected: Among,
    said: Vec<String>,
}

impl Rehearsal {
    /// Of a scene at its start.
    ///
    /// Errors: as of [`History::new`].
    pub fn new(scene: Scene) -> Result<Self, HistoryError> {
        let named = scene.named_parameters();
        let mut rehearsal = Rehearsal {
            stage: Stage::new(scene.into())?,
            shown: Shown::default(),
            named,
            state: PanelState::default(),
            tool: Tool::default(),
            push: PushWay::default(),
            palette: Palette::default(),
            selected: Among::default(),
            said: Vec::new(),
        };
        rehearsal.look();
        Ok(rehearsal)
    }

    /// Gives a context the program's look, in the colours of the present palette.
    pub fn dress(&self, context: &Context) {
        theme::apply(context, self.palette);
        panels::listen(context);
    }

    /// Shows the panels, and does what is asked for.
    pub fn show(&mut self, ui: &mut Ui) {
        self.dress(ui.ctx());
        let facts = self.facts();
        for wish in panels::show(ui, &mut self.state, &facts).0 {
            self.grant(wish);
        }
    }

    /// Does what a key would.
    pub fn act(&mut self, action: Action) {
        match action {
            Action::Take(tool) if lack_of(tool, self.shown.driving).is_some() => {}
            Action::Take(tool) => {
                (self.tool, self.push) = (tool, PushWay::default());
                self.state.take(tool);
            }
            Action::Wind => {
                (self.tool, self.push) = (Tool::Push, PushWay::Wind);
                self.state.take(Tool::Push);
            }
            Action::Undo => self.obey(Order::Undo(None)),
            Action::Redo => self.obey(Order::Redo(None)),
            Action::Gallery => self.toggle(Sheet::Gallery),
            Action::Help => self.toggle(Sheet::Help),
            Action::Settings => self.state.toggle_settings(),
            Action::FindSetting => (self.state.has_settings, self.state.finds_setting) = (true, true),
            Action::Lessons => self.state.toggle_lessons(),
            Action::Plots => {
                let rate = self.history().scene().rate();
                self.state.toggle_plots(rate);
            }
            Action::Palette => self.palette = self.palette.other(),
            _ => {}
        }
    }

    /// These points are selected from now on.
    pub fn select(&mut self, points: Vec<PointId>) {
        self.selected = Among { points, ..Among::default() };
        self.obey(Order::Inspect(self.selected.clone()));
    }

    /// These obstacles are selected from now on, by their numbers, and no points.
    pub fn select_obstacles(&mut self, obstacles: Vec<u32>) {
        self.selected = Among { obstacles, ..Among::default() };
        self.obey(Order::Inspect(self.selected.clone()));
    }

    /// The tool that is taken.
    pub fn tool(&self) -> Tool {
        self.tool
    }

    /// The world and all that was done.
    pub fn history(&self) -> &History {
        self.stage.history()
    }

    /// The colours that there are.
    pub fn palette(&self) -> Palette {
        self.palette
    }

    /// Whether lessons are open.
    pub fn has_lessons(&self) -> bool {
        self.state.lessons.is_open
    }

    /// What could not be done, and why.
    pub fn refusals(&self) -> &[String] {
        &self.said
    }

    fn toggle(&mut self, sheet: Sheet) {
        self.state.sheet = (self.state.sheet != Some(sheet)).then_some(sheet);
        self.state.is_fresh = true;
        self.state.search.clear();
    }

    fn grant(&mut self, wish: Wish) {
        match wish {
            Wish::Act(action) => self.act(action),
            Wish::OpenScene(name) => {
                if let Some(Ok(scene)) = gallery().iter().find(|entry| entry.name == name).map(|entry| entry.scene()) {
                    self.open(scene);
                    if let Met::Left { had_plots: true } = self.state.lessons.meet(self.stage.history().scene()) {
                        self.state.plots = None;
                    }
                }
            }
            Wish::Learn(at) => {
                if let Some(Ok(scene)) = lessons().get(at.lesson).and_then(|lesson| lesson.scene(at.step)) {
                    self.state.lessons.enter(at);
                    self.open(scene);
                }
            }
            Wish::Set(Setting { act, name, goes_on: true }) => self.obey(Order::GiveOn(act, name)),
            Wish::Set(Setting { act, name, .. }) => self.obey(Order::Give(vec![act], Some(name))),
            Wish::Matter(change, goes_on) => {
                self.obey(Order::Change { among: self.selected.clone(), change, goes_on });
            }
            Wish::Place(placing, goes_on) => {
                self.obey(Order::Place { among: self.selected.clone(), fit: Fit::default(), placing, goes_on });
            }
            Wish::Solver(solver) => self.obey(Order::Solver(solver)),
            Wish::Method(setting, goes_on) => self.obey(Order::Method(setting, goes_on)),
            Wish::Give(acts, name) => self.obey(Order::Give(acts, Some(name))),
            Wish::ToBranch(number) => self.obey(Order::ToBranch(number, None)),
            Wish::CallBranch(number, title) => self.obey(Order::CallBranch(number, title)),
            Wish::DiscardBranch(number) => self.obey(Order::DiscardBranch(number)),
            Wish::Begin(precision, tolerance) => self.obey(Order::Begin(precision, tolerance)),
            Wish::Bear => {
                if let Some(Overload { bonds, stiffness, .. }) = self.overload() {
                    let among = Among { bonds: Some(bonds), ..Among::default() };
                    self.obey(Order::Change { among, change: MatterChange::Bears(stiffness), goes_on: false });
                }
            }
            _ => {}
        }
    }

    fn open(&mut self, scene: Scene) {
        let named = scene.named_parameters();
        match Stage::new(scene.into()) {
            Ok(stage) => {
                (self.stage, self.named, self.state.sheet) = (stage, named, None);
                self.selected = Among::default();
                self.look();
            }
            Err(error) => self.said.push(error.to_string()),
        }
    }

    fn obey(&mut self, order: Order) {
        match self.stage.obey(order) {
            Some(Note::Refused(why)) => self.said.push(why),
            Some(Note::Begins(start)) => match Stage::new(*start) {
                Ok(stage) => self.stage = stage,
                Err(error) => self.said.push(error.to_string()),
            },
            _ => {}
        }
        self.look();
    }

    /// What of what is selected gives way.
    fn overload(&self) -> Option<Overload> {
        if self.selected.points.is_empty() { None } else { overload(&self.shown, &self.selected.points) }
    }

    fn look(&mut self) {
        self.stage.show(&mut self.shown);
    }

    fn facts(&self) -> Facts {
        let scene = self.stage.history().scene();
        let entry = gallery().iter().find(|entry| entry.name == scene.name());
        let push = self.shown.mouse.as_ref().map(|force| [force.strength, force.radius]);
        Facts {
            title: entry.map_or_else(|| scene.name().to_owned(), |entry| entry.title.to_owned()),
            caption: entry.map(|entry| [entry.description, entry.to_try]),
            figures: self.shown.figures.clone(),
            undoes: self.shown.figures.undoes.clone(),
            redoes: self.shown.figures.redoes.clone(),
            pace: 1.0,
            tool: self.tool,
            push: self.push,
            no_muscles: no_muscles(self.shown.driving),
            no_motors: no_motors(self.shown.driving),
            matter: self.shown.matter.clone().filter(|_| !self.selected.is_empty()),
            look: Look::in_palette(self.palette),
            palette: self.palette,
            dimensions: scene.dimensions(),
            overload: self.overload().map(Arc::new),
            settings: Settings {
                fixed: Some((scene.method.precision.unwrap_or(PrecisionName::Auto), scene.method.tolerance)),
                parameters: parameters(&self.named, &self.shown, push),
                scene: self.shown.settings.clone(),
                clock: Some(self.shown.figures.clock),
                pushing: self.shown.mouse.as_ref().map(Pushing::of),
                push,
                labels: Arc::clone(&self.shown.labels),
                points: self.shown.point_count(),
                ..Settings::default()
            },
            ..Facts::default()
        }
    }
}
