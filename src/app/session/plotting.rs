//! Plots of the running world, while their panel is open.

use std::path::PathBuf;

use glam::DVec2;

use super::Session;
use crate::app::panels::{self, Saved, figure};
use crate::app::player::{Measured, Note, Order, Probe};
use crate::app::plots::Plots;
use crate::app::tools::{Hand, Scope};
use crate::lessons::Plot;
use crate::sim::BondKind;

impl Session {
    /// Opens the panel, or closes it: then nothing is measured any more; what is probed is known when it is opened again.
    pub(super) fn toggle_plots(&mut self) {
        self.panels.plots_at.begin();
        self.panels.toggle_plots(self.scene.rate());
        // What somebody opens or closes is no lesson's.
        self.panels.lessons.plots = false;
        self.watch();
    }

    /// Closes the panel for good: what it was of is of another scene, or of another step of a lesson.
    pub(super) fn forget_plots(&mut self) {
        self.panels.plots_at.begin();
        (self.panels.plots, self.panels.plots_left) = (None, None);
        self.watch();
    }

    /// Opens the panel on what a lesson asks for.
    pub(super) fn plot_as(&mut self, plot: &Plot) {
        self.panels.plots_at.begin();
        (self.panels.plots, self.panels.plots_left) = (Some(Plots::of(self.scene.rate(), plot)), None);
        self.watch();
    }

    /// Another world is shown: what was plotted is of the last one, and what was plotted of its probes goes with it.
    pub(super) fn plot_anew(&mut self) {
        self.panels.plots_at.begin();
        self.panels.plots_left = None;
        self.panels.plots.take_if(|plots| plots.probes().iter().any(Option::is_some));
        if let Some(plots) = &mut self.panels.plots {
            plots.begin(self.scene.rate());
        }
        self.watch();
    }

    /// The stepping thread is told what to measure.
    fn watch(&mut self) {
        let probes = self.panels.plots.as_ref().map(Plots::probes);
        self.player.ask(Order::Watch(probes));
    }

    /// Once the view or what is looked at is another one, the panel leaves what it lies over, unless it was dragged there.
    pub(super) fn move_plots(&mut self) {
        if self.panels.plots.is_none() {
            return;
        }
        let looked_at = self.probes().count() + self.inspected.points.len();
        if !self.panels.plots_at.is_of_another((self.camera.pose, looked_at)) {
            return;
        }
        let lies = panels::plots_lie(self.egui.egui_ctx());
        if lies.is_some_and(|rect| self.marked_points().iter().any(|at| rect.contains(*at))) {
            self.panels.plots_at.begin();
        }
    }

    /// Takes what the last state brings for the plots.
    pub(super) fn plot(&mut self) {
        let Some(plots) = &mut self.panels.plots else { return };
        let [is_new, has_lost] = plots.take(self.player.shown());
        if has_lost {
            self.watch();
        }
        // While time goes on, panels are shown often enough.
        self.panels_dirty |= has_lost || is_new && !self.moves();
    }

    /// Takes what was before the plots were opened.
    pub(super) fn plot_before(&mut self, list: Vec<Measured>) {
        if let Some(plots) = &mut self.panels.plots {
            plots.take_before(list);
        }
    }

    /// A click with the tool for selecting puts a probe on a point or a bond, or takes it off.
    pub(super) fn probe(&mut self, at: DVec2) {
        let Some(mut plots) = self.panels.plots.take() else { return };
        let is_changed = self.with_scope(|hand, scope| probe_at(&mut plots, hand, (scope, at)));
        self.panels.plots = Some(plots);
        if is_changed {
            self.watch();
        }
    }

    /// The points and bonds that are probed, each with its number.
    pub(super) fn probes(&self) -> impl Iterator<Item = (usize, Probe)> {
        let probes = self.panels.plots.as_ref().map_or([None; 2], Plots::probes);
        probes.into_iter().enumerate().filter_map(|(place, probe)| Some((place, probe?)))
    }

    /// Asks for the name of a file for what is plotted, or for the plot that is looked at.
    pub(super) fn ask_where_to_plot(&mut self, kind: Saved) {
        if self.panels.plots.is_some() {
            self.ask_where_to_save(kind);
        }
    }

    /// Writes what is plotted there as a table.
    pub(super) fn write_table(&mut self, path: PathBuf) {
        let Some(plots) = &self.panels.plots else { return self.note(Note::NotWritten(NO_PLOT.to_owned())) };
        let mut bytes = Vec::new();
        match plots.series().write_csv(plots.dimensions(), &mut bytes) {
            Ok(()) => self.player.ask(Order::Table(path, bytes)),
            Err(error) => self.note(Note::NotWritten(error.to_string())),
        }
    }

    /// Writes the plot that is looked at there as a figure.
    pub(super) fn write_figure(&mut self, path: PathBuf) {
        let Some(plots) = &self.panels.plots else { return self.note(Note::NotWritten(NO_PLOT.to_owned())) };
        let bytes = figure(plots).into_bytes();
        self.player.ask(Order::Table(path, bytes));
    }
}

/// Said where the plots were closed before a file was named for them.
const NO_PLOT: &str = "nothing is plotted any more: L opens the plots";

/// What the button, which is about to be let go at a pixel, clicked on is probed, or no more. Returns whether it clicked on anything.
fn probe_at(plots: &mut Plots, hand: &Hand, (scope, at): (Scope<'_>, DVec2)) -> bool {
    let Some(probe) = hand.clicked(scope, at) else { return false };
    let kind = |number: u32| scope.shown.scenery.bond(number).map(|bond| bond.kind);
    plots.toggle(probe, |number| kind(number) == Some(BondKind::Rigid));
    true
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::action::Tool;
    use crate::app::player::{Shown, Stage};
    use crate::app::plots::{Quantity, Subject};
    use crate::render::{Camera, Pose};
    use crate::scene::Scene;
    use crate::sim::PointId;

    /// A spring at the left and a rigid bond at the right, two metres long each: 200 px.
    const SCENE: &str = r#"{"wobble": 1, "gravity": [0, 0], "points": {"position": [[-3, 0], [-1, 0], [1, 0], [3, 0]]},
        "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 90}, {"a": 2, "b": 3, "kind": "rigid"}]}"#;
    const POINTS: [[f64; 2]; 4] = [[200.0, 500.0], [400.0, 500.0], [600.0, 500.0], [800.0, 500.0]];
    const SPRING: [f64; 2] = [300.0, 500.0];
    const ROD: [f64; 2] = [700.0, 500.0];

    /// A world with a hand over it and plots beside it.
    struct Room {
        shown: Shown,
        hand: Hand,
        plots: Plots,
    }

    impl Room {
        fn new() -> Self {
            let mut shown = Shown::default();
            Stage::new(Scene::parse(SCENE, "x.json").unwrap().into()).unwrap().show(&mut shown);
            let mut hand = Hand::default();
            hand.take(Tool::Select);
            Room { shown, hand, plots: Plots::new(1.0) }
        }

        /// The button goes down and up as in the window. Returns whether the click probed anything, and what is probed.
        fn drag(&mut self, from: [f64; 2], to: [f64; 2]) -> (bool, [Option<Probe>; 2]) {
            let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 10.0 }, [1000, 1000]);
            let scope = Scope { shown: &self.shown, camera: &camera, scale: 1.0, free: Scope::ANYWHERE };
            let [from, to] = [from, to].map(DVec2::from);
            self.hand.press(scope, from);
            let is_changed = probe_at(&mut self.plots, &self.hand, (scope, to));
            self.hand.release(scope, to);
            (is_changed, self.plots.probes())
        }

        fn click(&mut self, at: [f64; 2]) -> (bool, [Option<Probe>; 2]) {
            self.drag(at, at)
        }
    }

    #[test]
    fn clicks_put_probes_on_points_and_bonds_and_take_them_off() {
        let mut room = Room::new();
        let [first, last] = [0, 3].map(|point| Some(Probe::Point(PointId(point))));
        let [spring, rod] = [0, 1].map(|number| Some(Probe::Bond(number)));
        let rows = [
            (POINTS[0], [first, None], Quantity::Speed, "a point"),
            (SPRING, [first, spring], Quantity::Strain, "a spring beside it: how far it is stretched"),
            (SPRING, [first, None], Quantity::Speed, "the same again takes it off"),
            (ROD, [first, rod], Quantity::Force, "what keeps its length: its force"),
            (POINTS[3], [first, last], Quantity::Speed, "of two the second makes way"),
            (POINTS[0], [None, last], Quantity::Speed, "the other one keeps its place"),
            (ROD, [rod, last], Quantity::Force, "the free place is taken"),
        ];
        for (at, probes, quantity, why) in rows {
            assert_eq!(room.click(at), (true, probes), "{why}");
            assert_eq!((room.plots.quantity, room.plots.subject), (quantity, Subject::Probes), "{why}");
        }
        room.click(ROD);
        assert_eq!(room.click(POINTS[3]), (true, [None; 2]));
        assert_eq!(room.plots.subject, Subject::Energies, "with the last one all is as it was");
    }

    #[test]
    fn what_is_no_click_of_the_selecting_tool_on_a_body_probes_nothing() {
        let nothing = (false, [None; 2]);
        let mut room = Room::new();
        assert_eq!(room.click([500.0, 200.0]), nothing, "beside all bodies");
        assert_eq!(room.drag(POINTS[0], POINTS[1]), nothing, "a drag that ends on a point");
        room.hand.hold_command(true);
        assert_eq!(room.click(POINTS[0]), nothing, "Ctrl selects one point");
        room.hand.hold_command(false);
        for tool in Tool::ALL.into_iter().filter(|tool| *tool != Tool::Select) {
            room.hand.take(tool);
            assert_eq!(room.click(POINTS[0]), nothing, "{tool:?}");
        }
    }
}
