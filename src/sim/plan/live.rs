//! A group of bodies that may meet.

use super::choice;
use super::make::{Maker, breakable};
use crate::sim::bond::PointId;
use crate::sim::contact::skin::{Contact, SkinMaterial};
use crate::sim::force::mouse::Track;
use crate::sim::group::Group;
use crate::sim::live::{Draft, mover};
use crate::sim::real::Real;
use crate::sim::sets::Sets;

impl<S: Real, const D: usize> Maker<'_, S, D> {
    /// `None` in a dimension that the live step is not made for.
    pub(super) fn make_live(&self) -> Option<Group<S, D>> {
        let w: Vec<f64> = self.points.iter().map(|&i| self.gathered.w[i as usize]).collect();
        let (points, pull) = (self.state(&w), self.batched_pull());
        let mover = mover(self.live_draft(), &points, &pull)?;
        Some(self.batched(points, pull, mover, breakable(self.bonds(), |_| true)))
    }

    pub(super) fn live_draft(&self) -> Draft<S> {
        let (led, knots) = self.led().into_iter().unzip();
        Draft {
            bonds: self.bonds().map(|(_, bond)| bond).collect(),
            body_of: self.body_of(),
            triangles: self.triangles(),
            hinges: self.form::<S>().hinges,
            areas: self.model.areas.unwrap_or_default(),
            contact: self.model.contact.map(Contact::borne),
            settles: self.model.method.settles,
            sleeps: self.model.method.sleeps,
            skins: self.skins(),
            sweeps: choice::sweeps(&self.model.method),
            led,
            knots,
        }
    }

    /// Pins of the group that are led, ascending, and the knots of their tracks `[m]`.
    fn led(&self) -> Vec<(u32, Vec<[f64; 3]>)> {
        let place = |x: &[f64; D]| std::array::from_fn(|k| x.get(k).copied().unwrap_or_default());
        let of = |(slot, track): (u32, Track<D>)| (slot, track.knots.iter().map(|(_, x)| place(x)).collect());
        let mut list: Vec<(u32, Vec<[f64; 3]>)> = self.tracks().into_iter().map(of).collect();
        list.sort_unstable_by_key(|entry| entry.0);
        list
    }

    /// What the skins of the points of the group are made of; none where no body has its own.
    fn skins(&self) -> Vec<SkinMaterial> {
        let skins = &self.model.skins;
        let points = if skins.is_empty() { &[] } else { self.points };
        points.iter().map(|&point| skins.of(PointId(point)).borne()).collect()
    }

    /// Which points of the group hang together, pins included: a number each.
    fn body_of(&self) -> Vec<u32> {
        let mut sets = Sets::new(self.points.len());
        for (_, bond) in self.bonds() {
            sets.join(bond.a.0, bond.b.0);
        }
        // Bonds between pins are in no island: what is pinned all over has a skin by its triangles.
        let is_pinned = |slot: &u32| self.gathered.w[self.points[*slot as usize] as usize] == 0.0;
        let covered = self.triangles().into_iter().map(|(corners, _)| corners);
        let pinned = covered.filter(|corners| corners.iter().all(is_pinned));
        let hinges = self.form::<S>().hinges.into_iter().map(|hinge| hinge.points);
        for [a, b, c] in pinned.chain(hinges).chain(self.patches().into_iter().map(|patch| patch.0)) {
            sets.join(a, b);
            sets.join(b, c);
        }
        let mut bodies = 0;
        let mut body_of: Vec<u32> = Vec::with_capacity(self.points.len());
        for i in 0..self.points.len() as u32 {
            // The lowest of a body comes first.
            let lowest = sets.find(i);
            body_of.push(if lowest == i { bodies } else { body_of[lowest as usize] });
            bodies += u32::from(lowest == i);
        }
        body_of
    }

    /// The triangles of the group, without those that welds leave no area, with their areas at rest `[m^2]` where these are known.
    pub(super) fn triangles(&self) -> Vec<([u32; 3], Option<f64>)> {
        let slot = |corner: u32| self.place[self.gathered.stand_ins[corner as usize] as usize];
        let mut own: Vec<u32> =
            self.points.iter().flat_map(|&point| self.gathered.triangles_at(point)).copied().collect();
        own.sort_unstable();
        let rest = |k: u32| self.model.rest_areas.get(k as usize).copied();
        let slots = own.into_iter().map(|k| (self.model.triangles[k as usize].map(|corner| slot(corner.0)), rest(k)));
        slots.filter(|(corners, _)| !corners.contains(&u32::MAX)).collect()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use crate::sim::bond::{Bond, BondId, PointId};
    use crate::sim::command::{Addition, Command, Selection};
    use crate::sim::contact::obstacles::Obstacles;
    use crate::sim::contact::skin::Contact;
    use crate::sim::dynamics::Dynamics;
    use crate::sim::model::Model;
    use crate::sim::plan::gather::Gathered;
    use crate::sim::plan::make::Maker;
    use crate::sim::plan::{inverse_masses, island, lot, weld};
    use crate::sim::points::State;
    use crate::sim::world::World;

    /// Two triangles that hang from one pin, a pin beside them, a loose point, and a pair of points that is welded to a triangle.
    fn model() -> Model<2> {
        let position = [
            [0.0, 0.0],
            [-1.0, -1.0],
            [-1.0, 0.0],
            [1.0, -1.0],
            [1.0, 0.0],
            [5.0, 5.0],
            [9.0, 9.0],
            [1.0, 0.0],
            [2.0, 0.0],
        ];
        let bonds = [(0, 1), (1, 2), (2, 0), (0, 3), (3, 4), (4, 0), (7, 8)];
        let weld = Bond::new(PointId(7), PointId(4), 0.0);
        Model {
            position: position.to_vec(),
            velocity: vec![[0.0; 2]; position.len()],
            mass: vec![1.0; position.len()],
            pinned: vec![PointId(0), PointId(5)],
            bonds: bonds.into_iter().map(|(a, b)| Bond::new(PointId(a), PointId(b), 1.0)).chain([weld]).collect(),
            triangles: [[0, 2, 1], [0, 3, 4], [3, 8, 7], [4, 7, 8]].map(|corners| corners.map(PointId)).to_vec(),
            contact: Some(Contact { friction: 0.1, ..Contact::default() }),
            ..Model::default()
        }
    }

    #[test]
    fn what_hangs_together_is_a_body_pins_included_and_what_hangs_on_nothing_is_one_each() {
        let model = model();
        let w = inverse_masses(&model);
        let obstacles = Obstacles::<f64, 2>::of(&model).unwrap();
        let state = State {
            position: model.position.clone(),
            velocity: model.velocity.clone(),
            position_lost: vec![[0.0; 2]; w.len()],
            velocity_lost: vec![[0.0; 2]; w.len()],
        };
        let gathered = Gathered::new(&model, (&model.bonds, None), &w, &weld::merge(&model.bonds, &w), &state);
        let lots =
            lot::lots(&model, (false, w.len()), island::islands(&gathered.bonds, &gathered.ties, &gathered.w), &[]);
        let [lot] = &lots[..] else { unreachable!("all islands go together") };
        // As the plan has them: the one of two that are welded whose number is higher is no point of its own.
        let points = [0, 1, 2, 3, 4, 5, 6, 8];
        let mut place = vec![u32::MAX; w.len()];
        points.iter().zip(0..).for_each(|(&point, slot)| place[point as usize] = slot);
        let maker =
            Maker { gathered: &gathered, model: &model, obstacles: &obstacles, lot, points: &points, place: &place };
        let draft = maker.live_draft();
        assert_eq!(draft.body_of, [0, 0, 0, 0, 0, 1, 2, 0]);
        // The last one is flat where points are welded.
        assert_eq!(draft.triangles, [[0, 2, 1], [0, 3, 4], [3, 7, 4]].map(|corners| (corners, None)));
        assert_eq!((draft.bonds.len(), draft.bonds[6].a, draft.bonds[6].b), (7, PointId(4), PointId(7)));
        assert_eq!(draft.contact, model.contact);
    }

    #[test]
    fn what_meets_stays_in_one_group_whatever_is_edited() {
        let mut world = World::<f64, 2>::new(&model()).unwrap();
        let addition = Addition {
            position: vec![[3.0, 3.0, 0.0], [4.0, 3.0, 0.0]],
            velocity: vec![[0.0; 3]; 2],
            mass: vec![1.0; 2],
            ..Addition::default()
        };
        let bonds = Selection { bonds: vec![BondId(3), BondId(5)], ..Selection::default() };
        let commands = [
            Command::Add(Box::new(addition)),
            Command::Pin(vec![PointId(6)]),
            Command::Delete(bonds),
            Command::Unpin(vec![PointId(0)]),
        ];
        for command in commands {
            world.apply(&command).unwrap();
            let full = world.plan.groups.iter().filter(|group| group.points.len() > 0);
            let points: Vec<usize> = full.map(|group| group.points.len()).collect();
            let merged = 1;
            assert_eq!(points, [world.count() - merged], "{command:?}");
            world.step();
        }
    }
}
