//! The camera, fitted to what panels leave of the window.

use std::time::Instant;

use super::Session;
use crate::app::action::Tool;
use crate::app::framing::{Beside, Framing, Left, Open, Turn, Undocked};
use crate::app::opening::{self, Followed, Over};
use crate::app::panels::{Laid, Opened, matter_lies};
use crate::render::Overlay;

impl Session {
    /// The camera as the scene opens, or on all points, also when the window gets another size.
    pub(super) fn frame_as(&mut self, framing: Framing) {
        self.framing = framing;
        self.framed.begin();
        self.frame_now();
    }

    fn frame_now(&mut self) {
        if !self.player.is_open() {
            return;
        }
        let (before, seen) = (self.tiles, self.camera.viewport().map(|side| side as u32));
        self.line_up();
        let view = self.player.shown().view();
        let pane = self.tiles.pane(self.area);
        let free = self.free_of_pane(pane);
        let over = if self.tiles.count() == 1 { self.over } else { Over::default() };
        let own = match self.framing {
            Framing::Opening => match &self.player.start().recording().view {
                Some(saved) => opening::saved(saved, &view, pane),
                None => opening::opened_in(&self.scene, &view, &self.tiles, (self.area, self.free, self.over)),
            },
            Framing::Fit => opening::beside_all(|free| opening::fit_in(&view, free, pane), &view, (free, over)),
            Framing::Free => {
                let mut own = before.own(&self.camera, seen);
                own.resize(pane);
                own
            }
        };
        if self.framing == Framing::Opening {
            let is_saved = self.player.start().recording().view.is_some();
            let followed = opening::followed(&self.scene, &view, pane);
            self.followed = if is_saved && !followed.is_said() { Followed::default() } else { followed };
            self.follows = !self.followed.points.is_empty() || !self.driving.is_empty();
        }
        self.camera = self.tiles.whole(&own, self.area);
    }

    /// The world is drawn above the bar below, and bodies are shown where no panel is.
    pub(super) fn give_world(&mut self, laid: &Laid, scale: f32, read: Vec<[f64; 4]>) {
        let whole = self.canvas.size();
        let Left { area, free, over, titles } = Left::of(laid, scale, whole);
        let free = free.unwrap_or(self.free);
        let is_wider = over.is_wider_than(&self.over);
        (self.over, self.titles) = (over, titles);
        let (before, is_resized) = (self.area, area != self.area);
        let is_other = free != self.free || is_wider;
        (self.area, self.free) = (area, free);
        let shares = self.tiles.count() > 1;
        match self.framed.turn((whole, self.open_panels()), (is_other, is_resized)) {
            // What a sheet lies over is not seen now.
            Turn::Stay if laid.free.is_none() => return,
            Turn::Stay if !shares => return self.make_way(read, laid.has_plots_at_edge),
            Turn::Stay => {}
            Turn::Keep if shares => self.share_anew(before),
            Turn::Keep => self.camera.resize_still(area),
            Turn::Fit => self.frame_now(),
        }
        (self.ways.taken, self.ways.beside) = (read, None);
    }

    /// Whether what is selected came to lie below the panel of the tool that selects, which was not dragged there, and nobody drags anything.
    fn lies_below(&mut self) -> bool {
        let context = self.egui.egui_ctx();
        if context.input(|input| input.pointer.any_down()) || self.panels.matter_at.is_dragged() {
            return false;
        }
        let panel = matter_lies(context).filter(|_| self.hand.tool() == Tool::Select);
        let places = (self.selection_seen(), panel);
        let stands = !self.moves();
        self.ways.lying.is_due(Instant::now(), places, stands)
    }

    /// Where panels open over points the view makes way for them, while they find their sizes, and comes back when they close; so it does
    /// where what is selected comes to lie below its own panel. Not one that somebody moved, nor while something is under way in it, nor below
    /// the pointer of somebody who selects. What the panel of a tool moves, what gets larger later, and plots that float where there is room
    /// move nothing.
    fn make_way(&mut self, taken: Vec<[f64; 4]>, has_plots: bool) {
        if self.framing == Framing::Free || self.hand.is_busy() {
            return;
        }
        // Whoever selects in the world goes on pointing at it: it makes way once the pointer is on a panel.
        if self.hand.tool() == Tool::Select && !self.is_over_panels() {
            return;
        }
        let panels = &self.panels;
        let tool = self.hand.tool();
        let selects = tool == Tool::Select;
        let seen = [Opened::Settings, Opened::Lessons].map(|panel| panels.is_seen(panel));
        let open = [seen[0], seen[1], has_plots, panels.hides_panels, selects];
        let finds_size = self.ways.wait_for(open, tool) && taken != self.ways.taken;
        if !(self.lies_below() || finds_size) {
            return;
        }
        let (view, free) = (self.player.shown().view(), (self.free, self.over));
        let look = |before| opening::beside_panels(before, &view, free, &taken);
        let (beside, camera) = Beside::of(self.ways.beside, self.camera, look);
        (self.ways.beside, self.ways.taken, self.camera) = (Some(beside), taken, camera);
    }

    /// Worlds side by side share another part of the window than `before` `[px]`.
    fn share_anew(&mut self, before: [u32; 2]) {
        let mut undocked = Undocked::of(self.undocked, self.camera, before);
        let (tiles, area) = (self.tiles, self.area);
        let (view, pane) = (self.player.shown().view(), tiles.pane(area));
        let free = self.free_of_pane(pane);
        let is_led = self.framing == Framing::Free;
        let camera = undocked.lead(area, |camera, before| {
            let mut own = tiles.own(camera, before);
            match is_led {
                true => own.resize_still(pane),
                false => own = opening::narrowed(own, &view, pane, free),
            }
            tiles.whole(&own, area)
        });
        (self.camera, self.undocked) = (camera, Some(undocked));
    }

    /// What is open, by which panels leave more room or less.
    fn open_panels(&self) -> Open {
        let panels = &self.panels;
        let has_legend = self.look.overlay == Overlay::Strain;
        let panels = [
            panels.is_seen(Opened::Settings),
            panels.is_seen(Opened::Lessons),
            panels.is_seen(Opened::Plots),
            !panels.hides_hud,
            has_legend,
            panels.hides_panels,
            panels.sheet.is_some(),
        ];
        Open { tool: self.hand.tool(), panels }
    }
}
