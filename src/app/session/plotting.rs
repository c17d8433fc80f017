//! Plots of the running world, while their panel is open.

use glam::DVec2;

use super::Session;
use crate::app::panels::{self, figure};
use crate::app::player::{Measured, Order, Probe};
use crate::app::plots::Plots;
use crate::lessons::Plot;
use crate::sim::BondKind;

impl Session {
    /// Opens the panel, or closes it: then nothing is measured any more; what is probed is known when it is opened again.
    pub(super) fn toggle_plots(&mut self) {
        self.panels.plots_at.begin();
        self.panels.toggle_plots(self.scene.rate());
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
        if self.panels.plots.is_none() {
            return;
        }
        let Some(probe) = self.with_scope(|hand, scope| hand.clicked(scope, at)) else { return };
        if let Some(plots) = &mut self.panels.plots {
            let scenery = &self.player.shown().scenery;
            let kind = |number| scenery.bond(number).map(|bond| bond.kind);
            plots.toggle(probe, |number| kind(number) == Some(BondKind::Rigid));
        }
        self.watch();
    }

    /// The points and bonds that are probed, each with its number.
    pub(super) fn probes(&self) -> impl Iterator<Item = (usize, Probe)> {
        let probes = self.panels.plots.as_ref().map_or([None; 2], Plots::probes);
        probes.into_iter().enumerate().filter_map(|(place, probe)| Some((place, probe?)))
    }

    /// Writes what is plotted as a table, beside the last file that was saved, or among the documents.
    pub(super) fn write_table(&mut self) {
        let Some(plots) = &self.panels.plots else { return };
        let mut bytes = Vec::new();
        match plots.series().write_csv(&mut bytes) {
            Ok(()) => {
                let path = self.free_path("csv");
                self.player.ask(Order::Table(path, bytes));
            }
            Err(error) => self.complain(&error.to_string()),
        }
    }

    /// Writes the plot that is looked at as a figure into the same folder.
    pub(super) fn write_figure(&mut self) {
        let Some(plots) = &self.panels.plots else { return };
        let bytes = figure(plots).into_bytes();
        let path = self.free_path("svg");
        self.player.ask(Order::Table(path, bytes));
    }
}
