//! What stands beside the world: where it lies in the window, which of them the pointer is on, and how it is drawn.

use glam::DVec2;

use super::Session;
use super::trails::AllTrails;
use crate::app::lengths::LengthUnit;
use crate::app::panels::{Neighbor, TOOLS, solvers};
use crate::app::player::{Beside, Companions, Order};
use crate::app::tools::{Mark, Role};
use crate::app::whereabouts::places_of;
use crate::app::{distances, opening};
use crate::render::{Camera, Look, Overlay, Pane, View};
use crate::scene::{BesideKeys, Meeting, Scene, SolverName};
use crate::sim::{Cursor, MouseForce};

/// Opacity of the mouse's region where the pointer is not.
const GHOST: f32 = 0.35;
/// Radius of the pointer's ring there `[points]`.
const GHOST_RADIUS: f64 = 5.0;

/// What is further from the world than this is nowhere any more `[m]`.
const BLOWN_UP: f32 = 1e6;

/// Worlds that are no further apart than so much of the largest coordinate are the same but for rounding `[1]`.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// So many points are looked at for the largest coordinate.
const MOST_SEEN: usize = 2_000;

/// How far a world is from the first one at most `[m]`, in words; of worlds whose largest coordinate is this `[m]`.
fn apart(unit: LengthUnit, most: f32, largest: f64) -> String {
    if f64::from(most) <= ROUNDING * largest {
        return "the same to rounding".to_owned();
    }
    // Not a number is no less.
    if most <= BLOWN_UP { format!("up to {} apart", unit.words(f64::from(most))) } else { "it has blown up".to_owned() }
}

fn rests(rests: bool) -> &'static str {
    if rests { "at rest" } else { "" }
}

/// What is said of a world beside its title: how far it is from the first one, in words, whether it rests, and what it kept of its own; or why nothing is known of
/// that.
fn said(world: &Beside, apart: Option<&str>) -> String {
    if !world.words.is_empty() {
        return world.words.clone();
    }
    let all = apart.into_iter().chain([rests(world.rests), &world.kept]);
    all.filter(|words| !words.is_empty()).collect::<Vec<_>>().join(", ")
}

impl Session {
    /// How many worlds there are side by side.
    pub(super) fn worlds(&self) -> usize {
        1 + self.shown().beside.len()
    }

    /// The window is shared by as many worlds as there are.
    pub(super) fn line_up(&mut self) {
        let view = self.shown().view();
        let alone = opening::alone(&self.scene, &view);
        self.tiles = opening::shared(&self.scene, &view, self.worlds(), (self.area, self.free, self.titles));
        self.difference_most = distances::full_distance(&alone) as f32;
        self.fit_distances();
        self.cell = self.cell.min(self.tiles.count() - 1);
    }

    /// Colours of distances go up to the largest that there was, in round numbers.
    fn fit_distances(&mut self) {
        let apart = self.shown().beside.iter().filter_map(|world| world.farthest).filter(|most| *most <= BLOWN_UP);
        self.most_apart = apart.fold(self.most_apart, f32::max);
        self.look.difference_full = distances::round_distance(self.most_apart, self.difference_most);
    }

    /// Which solvers cannot run the scene: found anew where bodies meet since, or do not meet any more.
    pub(super) fn find_misfits(&mut self) {
        let meets = self.shown().settings.contact.flatten().is_some();
        if self.misfits.0 == Some(meets) {
            return;
        }
        let solvers: Vec<SolverName> = solvers().collect();
        let why = match self.scene.contact {
            None if meets => Scene { contact: Some(Meeting::Is(true)), ..(*self.scene).clone() }.misfits(&solvers),
            _ => self.scene.misfits(&solvers),
        };
        self.misfits = (Some(meets), solvers.into_iter().zip(why).collect());
    }

    /// The camera as it shows the world alone in its part of the window.
    pub(super) fn own_camera(&self) -> Camera {
        self.tiles.own(&self.camera, self.area)
    }

    /// What a pixel is in the part of the window that the world itself has.
    pub(super) fn in_first(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [dx, dy] = self.tiles.shift(self.tiles.pane_at([x, y], self.area), self.area);
        [x - dx, y - dy]
    }

    /// Others stand there now, or none.
    pub(super) fn meet_neighbors(&mut self) {
        if self.tints_distance && !self.shown().beside.is_empty() {
            self.fit_distances();
        }
        if self.tiles.count() == self.worlds() {
            return;
        }
        self.beside_trails.clear();
        self.most_apart = 0.0;
        self.frame_as(super::Framing::Opening);
        self.touch();
    }

    /// The camera of the world that the pointer is on: all worlds have the same places.
    pub(super) fn camera_here(&self) -> Camera {
        self.tiles.camera(self.cell, &self.camera, self.area)
    }

    /// The pointer moved: it stays with the world in which it pressed.
    pub(super) fn find_cell(&mut self) {
        if let Some(at) = self.pointer.at.filter(|_| !self.hand.is_busy() && !self.pointer.is_dragging()) {
            self.cell = self.tiles.pane_at(at, self.area);
        }
    }

    /// The colours of world `place`: the mouse's region is faint where the pointer is not.
    fn look_of(&self, place: usize, look: Look) -> Look {
        let [red, green, blue, opacity] = look.region;
        let region = [red, green, blue, if place == self.cell { opacity } else { GHOST * opacity }];
        let is_tinted = place > 0 && self.tints_distance;
        // The tools stand at the left edge.
        let inset = if place.is_multiple_of(self.tiles.columns()) { look.inset } else { 0.0 };
        Look { region, inset, overlay: if is_tinted { Overlay::Difference } else { look.overlay }, ..look }
    }

    /// The worlds as they are drawn in a picture of `size` `[px]`: `first`, with the trails of all, then what stands `beside` it, each with
    /// its own.
    pub(super) fn panes<'a>(
        &self,
        first: View<'a>,
        (beside, trails): (&'a [Beside], AllTrails<'a>),
        (force, camera, look): (Option<(&'a MouseForce, Cursor)>, &Camera, Look),
        size: [u32; 2],
    ) -> Vec<Pane<'a>> {
        // Those that came just now have a place from the next frame on.
        let others = beside.iter().enumerate().take(self.tiles.count() - 1);
        let others = others.map(|(k, world)| View {
            mouse: force,
            trails: trails.of(k + 1),
            covered: first.covered,
            ..world.view(self.scene.dimensions())
        });
        let first = View { trails: (0..self.tiles.count()).flat_map(|place| trails.of(place)).collect(), ..first };
        let views = std::iter::once(first).chain(others).enumerate();
        views.map(|(place, view)| Pane::of(&self.tiles, place, view, camera, self.look_of(place, look), size)).collect()
    }

    /// The pointer in the worlds that it is not over.
    pub(super) fn ghosts(&self) -> Vec<Mark> {
        let is_away = self.tiles.count() == 1 || self.is_covered() || self.is_over_panels();
        let Some(at) = self.pixel().filter(|_| !is_away) else { return Vec::new() };
        let shift = |place: usize| DVec2::from(self.tiles.shift(place, self.area));
        let others = (0..self.tiles.count()).filter(|place| *place != self.cell);
        let radius = GHOST_RADIUS * f64::from(self.look.scale_factor);
        others.map(|place| Mark::Ring(Role::Ghost, at - shift(self.cell) + shift(place), radius)).collect()
    }

    /// What is said above each world, and where `[points]`. Nothing where the world is alone.
    pub(super) fn neighbors(&self) -> Vec<Neighbor> {
        let shown = self.shown();
        if shown.beside.is_empty() || self.tiles.count() != self.worlds() {
            return Vec::new();
        }
        let scale = self.egui.egui_ctx().pixels_per_point();
        let columns = self.tiles.columns();
        let of = |place: usize, title: &str, words: String| {
            let [left, top, width, _] = self.tiles.clip(place, self.area).map(|pixels| pixels as f32 / scale);
            // The tools stand at the left edge.
            let inset = if place.is_multiple_of(columns) { TOOLS } else { 0.0 };
            let (left, width) = (left + inset, width - inset);
            let color = self.trailing.is_on().then(|| self.look.trails[place % self.look.trails.len()]);
            Neighbor { title: title.to_owned(), words, at: [left, top], width, columns, color }
        };
        // One unit for all of them, that of the legend where there is one.
        let known = shown.beside.iter().filter_map(|world| world.farthest).filter(|most| *most <= BLOWN_UP);
        let farthest = known.fold(0.0, f32::max);
        let largest = if self.tints_distance { self.look.difference_full } else { farthest };
        let unit = LengthUnit::of(f64::from(largest));
        let coordinates = places_of(shown, MOST_SEEN).flatten().map(f64::abs).filter(|far| far.is_finite());
        let size = coordinates.fold(0.0, f64::max);
        let first = of(0, &format!("this scene: {}", shown.title), rests(shown.rests).to_owned());
        let others = shown.beside.iter().zip(1..).map(|(world, place)| {
            let apart = world.farthest.map(|most| apart(unit, most, size));
            of(place, &world.title, said(world, apart.as_deref()))
        });
        std::iter::once(first).chain(others).collect()
    }

    /// One more world by another solver.
    pub(super) fn put_beside(&mut self, solver: Option<SolverName>) {
        let order = match solver {
            None => Companions::Reference,
            Some(solver) => {
                let entry = BesideKeys::by(solver);
                let entries = self.shown().beside.iter().map(|world| world.entry.clone()).chain([entry]);
                Companions::These(entries.collect())
            }
        };
        self.player.ask(Order::Beside(order));
    }

    /// A world beside this one is taken away.
    pub(super) fn take_away(&mut self, place: usize) {
        let entries = self.shown().beside.iter().enumerate().filter(|(other, _)| *other != place);
        let entries = entries.map(|(_, world)| world.entry.clone()).collect();
        self.player.ask(Order::Beside(Companions::These(entries)));
    }
}

#[cfg(test)]
mod tests {
    use super::{Beside, LengthUnit, apart, said};

    #[test]
    fn a_world_that_has_no_numbers_left_is_said_to_have_blown_up() {
        let unit = LengthUnit::of(2.0);
        assert_eq!(apart(unit, 1.5, 3.0), "up to 1.50 m apart");
        for most in [f32::INFINITY, f32::NAN, 1e30] {
            assert_eq!(apart(unit, most, 3.0), "it has blown up");
        }
    }

    #[test]
    fn what_rounding_alone_parts_is_said_to_be_the_same() {
        let said = |most: f32, largest: f64| apart(LengthUnit::of(f64::from(most)), most, largest);
        assert_eq!(said(8e-16, 3.0), "the same to rounding");
        assert_eq!(said(0.0, 3.0), "the same to rounding");
        assert_ne!(said(8e-16, 0.1), "the same to rounding", "of a scene as small as that it is more");
        assert_ne!(said(1e-9, 3.0), "the same to rounding");
    }

    #[test]
    fn what_a_world_kept_of_its_own_is_said_after_how_far_it_is() {
        let kept = "at 0.20 s it kept its own drag".to_owned();
        let mut world = Beside { rests: true, kept, ..Beside::default() };
        assert_eq!(
            said(&world, Some("up to 1.50 m apart")),
            "up to 1.50 m apart, at rest, at 0.20 s it kept its own drag"
        );
        world.kept.clear();
        assert_eq!(said(&world, None), "at rest");
        world.words = "catches up: 1.0 of 2.0 s".to_owned();
        assert_eq!(said(&world, Some("up to 1.50 m apart")), world.words);
    }
}
