//! A world as the rest of the program sees it.

use super::World;
use super::saved::of_any;
use crate::sim::bond::{Bond, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::command::{Applied, Command, CommandError, Knots, Obstacle, SceneChange};
use crate::sim::contact::convex::Convex;
use crate::sim::contact::polygon::Polygon;
use crate::sim::contact::skin::{Contact, SkinMaterial};
use crate::sim::counters::Counters;
use crate::sim::drive::Key;
use crate::sim::dynamics::{Dynamics, ForceView, GrabView, Sample};
use crate::sim::force::angle::Angle;
use crate::sim::force::mouse::{self, Cursor, MouseForce, Track};
use crate::sim::force::steady::Force;
use crate::sim::group::Group;
use crate::sim::ledger::{Book, Energies};
use crate::sim::measure;
use crate::sim::model::{Driving, Method, Model};
use crate::sim::moved::MovedBy;
use crate::sim::plan_part::PlanPart;
use crate::sim::points::Points;
use crate::sim::real::{Positions, Precision, Real};
use crate::sim::saved::SavedWorld;
use crate::sim::vector::{embed, widen};

impl<S: Real, const D: usize> World<S, D> {
    /// Whether the mouse is still to be moved by its track, or the cursor along its line.
    fn mouse_moves(&self) -> bool {
        let t = self.timeline.time();
        self.around.mouse.as_ref().is_some_and(|mouse| match mouse.track.knots.is_empty() {
            true => self.around.cursor.is_some_and(|path| path.moves_after(t)),
            false => mouse.track.moves_after(t),
        })
    }
}

impl<S: Real, const D: usize> Dynamics for World<S, D> {
    fn dimensions(&self) -> usize {
        D
    }

    fn point_count(&self) -> usize {
        self.count()
    }

    fn precision(&self) -> Precision {
        S::PRECISION
    }

    fn time(&self) -> f64 {
        self.timeline.time()
    }

    fn substep(&self) -> f64 {
        self.timeline.substep()
    }

    fn step(&mut self) {
        self.finish_step();
        self.rest();
        self.watch_over();
    }

    fn step_until(&mut self, time: f64) {
        let (t, h) = (self.timeline.time(), self.timeline.substep());
        if t + h <= time + 1e-9 * h {
            self.step();
        } else if time > t {
            self.cut_step(time);
        }
    }

    fn apply(&mut self, command: &Command) -> Result<Applied, CommandError> {
        self.edit_booked(command)
    }

    fn topology(&self) -> u64 {
        self.topology
    }

    fn gone(&self) -> &[PointId] {
        &self.numbers.gone
    }

    fn torn(&self) -> &[Bond] {
        &self.numbers.torn
    }

    fn bond_numbers(&self) -> Option<&[u32]> {
        self.numbers.bonds.as_ref().map(|numbers| &numbers[..])
    }

    fn obstacle_numbers(&self) -> [&[u32]; 2] {
        self.numbers.obstacles.each_ref().map(|list| &list[..])
    }

    fn next_numbers(&self) -> [u32; 3] {
        [self.count() as u32, self.numbers.next_bond, self.numbers.next_obstacle]
    }

    fn pin_tracks(&self) -> Vec<(PointId, Knots)> {
        let knots = |track: &Track<D>| track.knots.iter().map(|&(t, x)| (t, embed(x))).collect();
        self.model.pin_motion.iter().map(|(pin, track)| (*pin, knots(track))).collect()
    }

    fn forces(&self) -> Vec<ForceView> {
        let numbered = self.model.forces.iter().zip(&self.numbers.forces);
        let view = |(force, &number): (&Force<D>, &u32)| ForceView {
            number,
            points: force.points.clone(),
            force: embed(force.force),
            torque: force.torque,
        };
        numbered.map(view).collect()
    }

    fn angles(&self) -> &[Angle] {
        &self.model.angles.list
    }

    fn drive_keys(&self) -> Vec<Key> {
        self.keys_of_drives()
    }

    fn held_keys(&self) -> &[Key] {
        &self.around.keys.held
    }

    fn cursor(&self) -> Option<Cursor> {
        self.around.cursor.map(|path| path.at(self.timeline.time()))
    }

    fn grab(&self) -> Option<GrabView> {
        self.grab_view()
    }

    fn sample(&self, time: f64) -> Sample {
        let rest = time - self.timeline.time();
        let mut copy = self.clone();
        if rest > self.timeline.substep() * 1e-9 {
            copy.look_ahead(time);
        }
        for group in &mut copy.plan.groups {
            group.hold_velocity();
            group.centre_velocity(&copy.around, time);
        }
        copy.present()
    }

    fn positions(&self) -> Positions<'_> {
        let own = || self.plan.groups.first().map_or(&[][..], |group| &group.points.position);
        let positions: &[[S; D]] = if self.plan.is_plain { own() } else { &self.gathered };
        S::flat(positions.as_flattened())
    }

    fn bonds(&self) -> &Bonds {
        &self.bonds
    }

    fn triangles(&self) -> &[[PointId; 3]] {
        &self.model.triangles
    }

    fn settings(&self) -> SceneChange {
        self.scene_now()
    }

    fn contact(&self) -> Option<Contact> {
        self.model.contact
    }

    fn pinned(&self) -> &[PointId] {
        &self.model.pinned
    }

    fn masses(&self) -> &[f64] {
        &self.model.mass
    }

    fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        self.model.bounds.map(|bounds| [embed(bounds.min), embed(bounds.max)])
    }

    fn planes(&self) -> Vec<[[f64; 3]; 2]> {
        self.model.planes.iter().map(|plane| [embed(plane.point), embed(plane.normal)]).collect()
    }

    fn polygons(&self) -> &[Polygon] {
        &self.model.polygons
    }

    fn convex(&self) -> &[Convex] {
        &self.model.convex
    }

    fn obstacles(&self) -> Vec<(u32, Obstacle)> {
        let planes = self.model.planes.iter().map(|plane| Obstacle::Plane {
            point: embed(plane.point),
            normal: embed(plane.normal),
            restitution: plane.restitution,
            friction: plane.friction,
            penalty: plane.penalty,
        });
        let polygons = self.model.polygons.iter().cloned().map(Obstacle::Polygon);
        let convex = self.model.convex.iter().copied().map(Obstacle::Convex);
        let [of_planes, of_others] = &self.numbers.obstacles;
        let planes = of_planes.iter().copied().zip(planes);
        planes.chain(of_others.iter().copied().zip(polygons.chain(convex))).collect()
    }

    fn skin_of(&self, point: PointId) -> SkinMaterial {
        self.model.skins.of(point)
    }

    fn mouse(&self) -> Option<(&MouseForce, Cursor)> {
        self.around.mouse_at(self.timeline.time())
    }

    fn mouse_force(&self) -> Option<&MouseForce> {
        self.around.mouse.as_ref()
    }

    fn energies(&self) -> Energies {
        let of = |list: fn(&Points<S, D>) -> &[[S; D]]| {
            move |i: usize| {
                self.slot(i).map_or([0.0; D], |[group, slot]| widen(list(&self.plan.groups[group].points)[slot]))
            }
        };
        let (position, velocity) = (of(|points| &points.position), of(|points| &points.velocity));
        self.energies_of(position, velocity)
    }

    fn book(&self) -> Option<Book> {
        self.ledger.is_some().then(|| World::book(self))
    }

    fn max_strain(&self) -> f64 {
        measure::max_strain(|i| self.place(i), &self.bonds, (self.timeline.time(), &self.around.keys))
    }

    fn tension(&self, place: usize) -> Option<f64> {
        World::tension(self, place)
    }

    fn velocity(&self, point: PointId) -> [f64; 3] {
        let of = |[group, slot]: [usize; 2]| embed(widen(self.plan.groups[group].points.velocity[slot]));
        self.slot(point.index()).map_or([0.0; 3], of)
    }

    fn counters(&self) -> &Counters {
        &self.counters
    }

    fn heap_bytes(&self) -> usize {
        let kept = self.kept.iter().map(|kept| &kept.group);
        let groups: usize = self.plan.groups.iter().chain(kept).map(|group| group.heap_bytes()).sum();
        let own = self.plan.slots.capacity() * 8 + self.gathered.capacity() * size_of::<[S; D]>();
        let Model { mass, pinned, triangles, .. } = &*self.model;
        let model = 16 * mass.capacity() + 4 * pinned.capacity() + 12 * triangles.capacity();
        groups + own + model + self.bonds.heap_bytes()
    }

    fn parts(&self) -> &[PlanPart] {
        &self.plan.parts
    }

    fn moved_by(&self) -> Vec<MovedBy> {
        self.movers()
    }

    fn method(&self) -> Method {
        self.model.method
    }

    fn driving(&self) -> Driving {
        self.model.driving()
    }

    fn is_cheaper_live(&self) -> bool {
        self.has_cheaper()
    }

    fn mover_of(&self, point: PointId) -> Option<&PlanPart> {
        self.slot(point.index()).and_then(|[place, _]| self.plan.own.get(place))
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }

    fn is_asleep(&self) -> bool {
        !self.mouse_moves() && self.plan.groups.iter().all(Group::is_asleep)
    }

    fn wake(&mut self) {
        let kept = self.kept.iter_mut().map(|kept| &mut kept.group);
        self.plan.groups.iter_mut().chain(kept).for_each(Group::wake);
    }

    fn is_still(&self, speed: f64) -> bool {
        let t = self.timeline.time();
        let track_moves = self.mouse_moves() || self.model.pin_motion.iter().any(|(_, track)| track.moves_after(t));
        let groups = &self.plan.groups;
        let reached = |(force, cursor)| groups.iter().any(|group| mouse::reaches(&group.points, force, cursor));
        !track_moves
            && groups.iter().all(|group| measure::is_slower(&group.points, speed))
            && !self.mouse().is_some_and(reached)
    }

    fn is_finite(&self) -> bool {
        let is_fine = |points: &[[S; D]]| points.as_flattened().iter().all(|x| x.is_finite());
        self.plan.groups.iter().all(|group| is_fine(&group.points.position))
    }

    fn save(&self) -> Option<SavedWorld> {
        of_any(self.saved())
    }

    fn boxed_clone(&self) -> Box<dyn Dynamics> {
        Box::new(self.clone())
    }
}
