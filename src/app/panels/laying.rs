//! Lays the panels out, one after another: what comes later lies where the earlier ones left room.

use egui::{Context, Rect, pos2};

use super::places::{APART, Laid, Places};
use super::{
    Cover, Facts, GAP, PanelState, Room, Seen, Sheet, Wish, beside, gallery, held, help, hud, legend, lessons,
    open_from, palette, plots, save_to, settings, sheet, top, transport, waiting,
};
use crate::app::action::Tool;
use crate::render::Overlay;

/// Rooms so high have place for the figures above a lesson with its plots `[points]`.
const FIGURES: f32 = 800.0;
/// Narrower ones have none at all `[points]`.
const FIGURES_WIDE: f32 = 560.0;

/// Shows the panels; returns what was asked for, and what they leave to the world.
pub(in crate::app) fn show(ui: &mut egui::Ui, state: &mut PanelState, facts: &Facts) -> (Vec<Wish>, Laid) {
    let mut wishes = Vec::new();
    (state.has_selection, state.previews_stops) = (facts.matter.is_some(), false);
    if facts.tool != state.tool && palette::has_panel(facts.tool) {
        state.take(facts.tool);
    }
    state.keep_order();
    if !state.hides_panels {
        transport::show(ui, &mut state.lessons.left, facts, &mut wishes);
    }
    let room = ui.available_rect_before_wrap();
    let mut laying = Laying::begin((ui.ctx().clone(), room), state, facts, wishes);
    let shares = laying.share();
    laying.figures(&shares);
    laying.lessons(&shares);
    laying.settings(&shares);
    laying.plots(&shares);
    laying.tools(&shares);
    laying.keys(&shares);
    laying.words();
    laying.sheet();
    let laid = laying.laid(&shares);
    (laying.wishes, laid)
}

/// What panels have taken so far.
struct Laying<'a> {
    context: Context,
    room: Rect,
    state: &'a mut PanelState,
    facts: &'a Facts,
    wishes: Vec<Wish>,
    places: Places,
    /// A sheet lies over all of it.
    is_covered: bool,
    has_panels: bool,
    /// Where keys to be held lie in a small window: panels end above them.
    keys_low: Option<Rect>,
    /// Where plots lie that may lie over bodies, and where those begin that lie along the lower edge.
    plotted: Option<Rect>,
    strip: Option<f32>,
    /// What belongs to a tool: from where to where, and how low.
    column: Option<[f32; 2]>,
    column_low: Option<f32>,
    /// Where titles of worlds side by side end.
    titles_end: f32,
}

/// Which panels are seen, and what of the right edge each takes `[points]`.
struct Shares {
    seen: Seen,
    stands_upright: bool,
    /// The settings; the width of a lesson; both.
    edge: f32,
    column: f32,
    panels_edge: f32,
    /// All that lies there.
    all_edge: f32,
    plots: Plotted,
}

/// Where plots lie.
#[derive(Clone, Copy)]
struct Plotted {
    /// They and a lesson are one column.
    are_stacked: bool,
    /// They take room from worlds side by side: at the right edge, or along the lower one.
    are_docked: bool,
    is_low: bool,
    /// They have the place for panels in a small window.
    are_small: bool,
    width: f32,
}

impl<'a> Laying<'a> {
    /// The buttons at the top come first.
    fn begin((context, room): (Context, Rect), state: &'a mut PanelState, facts: &'a Facts, wishes: Vec<Wish>) -> Self {
        // What lies over the world has the room for itself.
        let is_covered = state.sheet.is_some() || (facts.waits && !facts.asks);
        let has_panels = !state.hides_panels && !is_covered;
        let mut laying = Laying {
            places: Places::new(room, is_covered),
            keys_low: None,
            plotted: None,
            strip: None,
            column: None,
            column_low: None,
            titles_end: 0.0,
            context,
            room,
            state,
            facts,
            wishes,
            is_covered,
            has_panels,
        };
        let places = &mut laying.places;
        places.has_numbers = facts.look.has_grid && facts.dimensions == 2;
        laying.state.room = Room::of(room, places.is_upright());
        // In a small window panels end above the keys that are to be held.
        if has_panels && laying.state.room == Room::One && !facts.keys.is_empty() {
            laying.keys_low = Some(room.with_max_y(places.below));
            places.below -= held::HEIGHT;
        }
        if has_panels {
            let recent = &laying.state.recent;
            places.bar = Some(top::show(&laying.context, (room, recent), facts, &mut laying.wishes));
        }
        laying
    }

    /// What lies at the right edge, from there on: the settings, then the lessons. What has no room waits.
    fn share(&mut self) -> Shares {
        let seen = self.state.seen(self.has_panels);
        let stands_upright = self.places.is_upright();
        let is_small = self.state.room == Room::One;
        let takes = |is_shown: bool, width: f32| if is_shown && !stands_upright { width + GAP } else { 0.0 };
        let edge = takes(seen.has_settings, settings::WIDTH);
        let column = lessons::width(self.room, edge);
        let panels_edge = edge + takes(seen.has_lessons, column);
        let plots = self.place_plots(&seen, panels_edge);
        let are_beside = !self.facts.neighbors.is_empty();
        let takes_edge = plots.are_docked && !plots.is_low || plots.are_small && are_beside;
        let all_edge = panels_edge + takes(takes_edge, plots.width);
        // A small window has no room for figures and legends beside a panel.
        let has_own = seen.has_tool && palette::has_panel(self.facts.tool);
        self.places.is_crowded = is_small && (seen.has_settings || seen.has_lessons || seen.has_plots || has_own);
        Shares { seen, stands_upright, edge, column, panels_edge, all_edge, plots }
    }

    /// Where the plots are to lie, beside panels that take so much of the right edge.
    fn place_plots(&self, seen: &Seen, panels_edge: f32) -> Plotted {
        let (room, stands_upright) = (self.room, self.places.is_upright());
        let is_small = self.state.room == Room::One;
        // Beside worlds that lie side by side plots take room, as panels do: there is no place that none of them is in.
        let worlds = self.facts.neighbors.len();
        let is_dragged = self.state.plots_at.is_dragged(worlds > 0);
        // A lesson and its plots are one column: what is read and what is seen leave the world alone, wherever plots were dragged to elsewhere.
        let is_read = seen.has_lessons && (!is_dragged || self.state.lessons.open_at().is_some());
        let are_stacked = seen.has_plots && !stands_upright && is_read;
        let stand_alone = seen.has_plots && !stands_upright && !are_stacked;
        let are_docked = stand_alone && !is_dragged && !is_small && worlds > 0;
        // In a small window they have a place of their own, whatever lies there.
        let are_small = stand_alone && is_small;
        // Along the lower edge, where that leaves more to each of them.
        let sizes = [plots::WIDTH, plots::low_height(room)];
        let is_low = are_docked && !self.places.are_larger_above(worlds, panels_edge, sizes);
        let width = if are_small { plots::small_width(room) } else { plots::WIDTH };
        Plotted { are_stacked, are_docked, is_low, are_small, width }
    }

    fn figures(&mut self, shares: &Shares) {
        let (room, places) = (self.room, &mut self.places);
        let is_high = !shares.plots.are_stacked || room.height() > FIGURES;
        let has_figures = room.width() > FIGURES_WIDE && is_high && !places.is_crowded;
        if !self.state.hides_hud && has_figures && !self.is_covered {
            hud::show(&self.context, places, self.facts);
        }
        if self.facts.look.overlay == Overlay::Strain && !self.is_covered && !places.is_crowded {
            legend::show(&self.context, places, &self.facts.look);
        }
    }

    fn lessons(&mut self, shares: &Shares) {
        let Laying { context, places, state, wishes, .. } = self;
        if !shares.seen.has_lessons {
            return;
        }
        if shares.stands_upright {
            places.below = lessons::show_below(context, places.below_buttons(), &mut state.lessons, wishes);
            return;
        }
        let mut at = places.beside(shares.column);
        let all = at;
        let mut stacked = state.plots.as_mut().filter(|_| shares.plots.are_stacked);
        if let Some(plots) = &stacked {
            at.min.y = (at.min.y + plots::least_above(shares.column, plots) + APART).min(at.max.y);
        }
        let top = lessons::show(context, (at, shares.edge), &mut state.lessons, wishes);
        if let Some(plots) = &mut stacked {
            let above = all.with_max_y((top - APART).max(all.top()));
            plots::show_above(context, (above, shares.edge, shares.column), plots, wishes);
        }
    }

    fn settings(&mut self, shares: &Shares) {
        let Laying { context, places, state, facts, wishes, .. } = self;
        if shares.seen.has_settings && shares.stands_upright {
            places.below = settings::show_below(context, places.below_buttons(), state, facts, wishes);
        } else if shares.seen.has_settings {
            settings::show(context, places.beside(settings::WIDTH), state, facts, wishes);
        }
    }

    /// Where the panel of the tool lies that others make way for: not one that was dragged over them.
    fn of_tool(&self) -> Option<Rect> {
        let is_dragged = self.facts.tool == Tool::Select && self.state.matter_at.is_dragged();
        palette::of_tool(&self.context, self.facts.tool).filter(|_| !is_dragged)
    }

    fn plots(&mut self, shares: &Shares) {
        let of_tool = self.of_tool();
        let Laying { context, places, state, facts, wishes, .. } = self;
        let Plotted { are_stacked, are_docked, is_low, are_small, width } = shares.plots;
        let Some(plots) = state.plots.as_mut().filter(|_| shares.seen.has_plots && !are_stacked) else { return };
        if shares.stands_upright {
            places.below = plots::show_below(context, places.below_buttons(), plots, wishes).top();
        } else if are_small {
            let rect = plots::show_small(context, places.beside(width), plots, wishes);
            self.plotted = Some(rect).filter(|_| facts.neighbors.is_empty());
        } else if is_low {
            let rect = plots::show_below(context, places.low_strip(shares.panels_edge), plots, wishes);
            (self.plotted, self.strip) = (Some(rect), Some(rect.top()));
        } else {
            let (at, is_beside) = (&mut state.plots_at, !facts.neighbors.is_empty());
            let seat = plots::Seat { points: &facts.points, at, is_docked: are_docked, is_beside };
            let high = places.right.max(places.bar_bottom());
            let room = (places.low_beside(shares.panels_edge), high);
            let bar = Rect::from_min_max(places.room.min, pos2(places.room.right(), places.bar_bottom() - APART));
            let taken = of_tool.into_iter().chain(held::lie(context)).chain([bar]);
            let taken = taken.collect();
            let rect = plots::show(context, room, (plots, seat, taken), wishes);
            self.plotted = rect.filter(|_| !are_docked);
        }
    }

    fn tools(&mut self, shares: &Shares) {
        if !self.has_panels {
            return;
        }
        let (context, tool) = (&self.context, self.facts.tool);
        let plotted = self.plotted.filter(|_| self.strip.is_none() && !shares.plots.are_small);
        let rooms = self.places.of_tools((plotted, self.strip), shares.all_edge);
        let state = (&mut *self.state, shares.seen.has_tool);
        let column = palette::show(context, &rooms, state, self.facts, &mut self.wishes);
        self.column_low = rooms.half.filter(|_| column.is_some());
        // The others have a place beside the tools, which they keep while they are there.
        let of_tool = || palette::of_tool(context, tool).filter(|_| tool != Tool::Select);
        self.column = column.or_else(|| of_tool().map(|at| [at.left(), at.right()]));
    }

    /// The keys that are to be held.
    fn keys(&mut self, shares: &Shares) {
        let mut strip = self.keys_low.unwrap_or_else(|| self.places.low_strip(shares.all_edge));
        // What belongs to a tool may reach down to them.
        let of_tool = self
            .of_tool()
            .filter(|at| at.bottom() > strip.bottom() - held::HEIGHT && at.left() < self.places.room.center().x);
        if let Some(at) = of_tool {
            strip.min.x = strip.left().max(at.right());
        }
        held::show(&self.context, (strip, &mut self.state.held_at), self.facts, &mut self.wishes);
    }

    /// What is said, and the titles of worlds side by side.
    fn words(&mut self) {
        let Laying { context, places, state, facts, wishes, .. } = self;
        state.notes.lie_under(Cover::of(state.sheet, facts.waits && !facts.asks));
        state.notes.show(context, places, facts, wishes);
        if !state.hides_hud && !self.is_covered {
            let has_caption = state.notes.has_caption && facts.caption.is_some();
            self.titles_end = beside::titles(context, facts, (has_caption, places.is_crowded));
        }
        if let Some(opening) = facts.opening.filter(|_| state.sheet.is_none()) {
            waiting::show(context, opening, &facts.title, wishes);
        } else if let Some(going) = facts.going.as_ref().filter(|_| state.sheet.is_none()) {
            waiting::going(context, going, wishes);
        }
        if let Some(share) = facts.filming.filter(|_| state.sheet.is_none()) {
            waiting::filming(context, share, wishes);
        }
    }

    fn sheet(&mut self) {
        let Laying { context, room, state, facts, wishes, .. } = self;
        let room = room.with_max_y(room.bottom() - sheet::said_below(context));
        match state.sheet {
            Some(Sheet::Gallery) => gallery::show(context, room, state, facts, wishes),
            Some(Sheet::Help) => help::show(context, room, state),
            Some(Sheet::SaveTo) => save_to::show(context, state, wishes),
            Some(Sheet::OpenFrom) => open_from::show(context, state, wishes),
            None => {}
        }
    }

    /// What is left.
    fn laid(&self, shares: &Shares) -> Laid {
        let Laying { context, places, state, facts, has_panels, .. } = self;
        let Plotted { are_stacked, are_docked, are_small, .. } = shares.plots;
        // Where plots were dragged to on purpose they may lie over bodies.
        let plotted = self.plotted.filter(|_| are_small || !state.plots_at.is_dragged(!facts.neighbors.is_empty()));
        let caption_end = state.notes.caption_end(places.room).unwrap_or(0.0);
        let edges = (shares.all_edge, beside::height(facts, places.is_crowded));
        let free = (!self.is_covered).then(|| match has_panels {
            true => places.free(edges, ([caption_end, self.titles_end], plotted)),
            false => self.room,
        });
        let is_shared = !facts.neighbors.is_empty() && *has_panels;
        Laid {
            size: places.size(shares.all_edge, is_shared, self.strip),
            corner: places.corner(context),
            column: self.column,
            column_low: self.column_low,
            has_plots_at_edge: shares.seen.has_plots
                && (shares.stands_upright || are_stacked || are_docked || are_small),
            titles: beside::row(facts, places.is_crowded),
            free,
        }
    }
}
