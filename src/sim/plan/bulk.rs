//! A group of large bodies.

use super::choice::Scheme;
use super::gather::Gathered;
use super::make::{Maker, breakable};
use super::structure::piece::is_one_piece;
use super::structure::{self, Structure, steady};
use crate::sim::bond::BondKind;
use crate::sim::bulk::body::Members;
use crate::sim::bulk::control::Control;
use crate::sim::bulk::draft::{Draft, Order, Shape};
use crate::sim::bulk::kernel::OF_A_BOND;
use crate::sim::bulk::mover::{Mover, mover};
use crate::sim::bulk::spec::Spec;
use crate::sim::bulk::trails::Segment;
use crate::sim::colour::by_colour;
use crate::sim::contact::Contacts;
use crate::sim::counters::{of_a_batch, operations};
use crate::sim::force::form::Form;
use crate::sim::force::spring::Springs;
use crate::sim::group::engine::Engine;
use crate::sim::group::events::edge::Edges;
use crate::sim::group::guard::Guard;
use crate::sim::group::sleep::Sleep;
use crate::sim::group::{Breakable, Group, Work};
use crate::sim::kernels::rows::Kinds;
use crate::sim::moved::Moved;
use crate::sim::plan::island::Island;
use crate::sim::points::{Points, State};
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::solver::Solver;
use crate::sim::vector::{length, widen, zero};

/// Share of the strain asked for that chains are held to: they are cheap, and at their free ends, which whip, what is left
/// comes back as energy.
const CHAIN_SHARE: f64 = 0.1;

impl<S: Real, const D: usize> Maker<'_, S, D> {
    /// `None` in a dimension that large bodies are not made for.
    pub(super) fn make_bulk(&self, scheme: Scheme) -> Option<Group<S, D>> {
        let choice = self.lot.choice;
        let points = self.batched_state();
        let breakable = breakable(self.bonds(), |_| true);
        let mut bodies = self.drafts();
        if !breakable.is_empty() {
            // What breaks has to be strained first.
            bodies.iter_mut().for_each(|draft| draft.piece = None);
        }
        let are_chains = bodies.iter().all(|draft| matches!(draft.shape, Shape::Chain { .. }));
        let control = match scheme.target {
            Some(target) => Control::following(if are_chains { CHAIN_SHARE * target } else { target }),
            None => Control::fixed(scheme.longest.unwrap_or(choice.substep)),
        };
        let order = Order {
            control: self.within_budget(control),
            bodies,
            inverse_mass: points.inverse_mass.clone(),
            way: scheme.way,
            gravity: length(self.model.field()),
            nominal: choice.substep,
        };
        let bulk = mover(order)?;
        let work = Work { batch: self.work_of_a_step(scheme, &*bulk), ..Work::default() };
        Some(Group { work, ..self.batched(points, self.batched_pull(), bulk, breakable) })
    }

    /// Counted work of a step, where its substeps are known beforehand: those by forces.
    fn work_of_a_step(&self, scheme: Scheme, bulk: &dyn Mover<S, D>) -> u64 {
        let (None, Some(longest)) = (scheme.target, scheme.longest) else { return 0 };
        let substeps = (self.lot.choice.substep / longest).ceil().max(1.0);
        substeps as u64 * of_a_batch((self.bond_count(), bulk.kernel().work_of_a_bond()), self.points.len(), D)
    }

    fn bond_count(&self) -> usize {
        self.lot.islands.iter().map(|island| island.bonds.len()).sum()
    }

    /// As many substeps as the work of a frame may be, where there is a bound on it and no strain is asked for.
    fn within_budget(&self, control: Control) -> Control {
        let Some(budget) = self.model.budget().filter(|_| self.model.method.max_strain.is_none()) else {
            return control;
        };
        let batch = of_a_batch((self.bond_count(), OF_A_BOND), self.points.len(), D);
        control.within(operations(budget) as f64 / batch.max(1) as f64)
    }

    /// The points of a group whose engine keeps what rounding takes by itself.
    pub(super) fn batched_state(&self) -> Points<S, D> {
        let w: Vec<f64> = self.points.iter().map(|&i| self.gathered.w[i as usize]).collect();
        let mut points = self.state(&w);
        points.position_lost = Vec::new();
        points.velocity_lost = Vec::new();
        points
    }

    /// What acts on such points but for bonds.
    pub(super) fn batched_pull(&self) -> Pull<S, D> {
        Pull {
            springs: Springs::none(),
            form: Form::none(),
            contacts: Contacts::new(self.obstacles, self.points.len()),
            rigid: None,
            inside: None,
            led: Vec::new(),
            is_grabbed: false,
            lead: zero(),
            thrusts: self.thrusts(),
            driven: self.driven(),
            gravity: self.model.field(),
            drag_rate: self.model.drag_rate,
            air: self.gathered.drives.air.clone(),
            cushions: self.cushions(),
        }
    }

    /// The group of such points.
    pub(super) fn batched(
        &self,
        points: Points<S, D>,
        pull: Pull<S, D>,
        mover: Box<dyn Mover<S, D>>,
        breakable: Vec<Breakable<S>>,
    ) -> Group<S, D> {
        Group {
            guard: Guard { bonds: Vec::new(), follows_turns: false },
            breakable,
            edges: Edges::none(),
            tracks: self.tracks(),
            substep: self.lot.choice.substep,
            locates: false,
            before: State::default(),
            acceleration: Vec::new(),
            sleep: Sleep::default(),
            grabbed: None,
            work: Work::default(),
            patience: [0; 2],
            has_yielded: false,
            limit: u64::MAX,
            gave_up: None,
            moved: Moved::default(),
            watch: self.watch(),
            account: self.account(),
            pull,
            engine: Engine::Bulk(mover),
            plain: None,
            robust: None,
            points,
        }
    }

    /// Every island as the form that it is made in; equal small ones go together.
    fn drafts(&self) -> Vec<Draft<D>> {
        let Gathered { bonds, w, .. } = self.gathered;
        let islands = &self.lot.islands;
        let structures: Vec<Structure> = islands.iter().map(|island| Structure::of(island, bonds, w)).collect();
        let is_mesh = |place: usize| structures[place] == Structure::Mesh;
        let (crowds, others) = structure::crowds(islands, bonds, is_mesh);
        let crowds = crowds.into_iter().map(|crowd| {
            let ends: Vec<[u32; 2]> = crowd.bonds.iter().map(|bond| bond.0).collect();
            let points = crowd.points.len() / crowd.bodies;
            let links = by_colour(&ends, points).into_iter().map(|k| crowd.bonds[k as usize]);
            let links: Vec<([u32; 2], Spec)> = links.map(|(ends, spec)| (ends, self.meant(spec))).collect();
            let is_steady = self.lot.choice.solver == Solver::Path && self.is_steady(&crowd.points[..points], &links);
            let piece = self.piece(points, &links);
            let shape = Shape::Crowd { bodies: crowd.bodies, points, links, is_steady };
            Draft { shape, members: self.members(&crowd.points), piece }
        });
        let mut drafts: Vec<Draft<D>> = crowds.collect();
        drafts.extend(others.into_iter().map(|place| self.draft(&islands[place], &structures[place])));
        drafts
    }

    /// Whether rigid bonds of a body with these points may be swept in this order in every substep.
    fn is_steady(&self, points: &[u32], links: &[([u32; 2], Spec)]) -> bool {
        let ends: Vec<[u32; 2]> =
            links.iter().filter(|(_, spec)| spec.kind == BondKind::Rigid).map(|(ends, _)| *ends).collect();
        let x: Vec<[f64; D]> = points.iter().map(|&i| widen(self.gathered.state.position[i as usize])).collect();
        let w: Vec<f64> = points.iter().map(|&i| self.gathered.w[i as usize]).collect();
        // What can be tried is the start: a body with fewer bonds than hold its shape gets into others.
        let keeps_shape = ends.len() + D * (D + 1) / 2 >= D * x.len();
        keeps_shape && steady::is_steady(&x, &w, &ends)
    }

    /// The number of points again where rigid bonds hold all of them in shape, and surfaces may strike.
    fn piece(&self, points: usize, links: &[([u32; 2], Spec)]) -> Option<usize> {
        if !self.strikes_pieces() {
            return None;
        }
        let ends: Vec<[u32; 2]> = links.iter().filter(|(_, spec)| spec.is_rod()).map(|(ends, _)| *ends).collect();
        is_one_piece(points, &ends).then_some(points)
    }

    /// The same of a sheet: its cells are triangles where there is a diagonal.
    fn piece_of_sheet(&self, points: usize, specs: &Kinds<Spec>) -> Option<usize> {
        let is_braced = [specs.falling, specs.rising].iter().flatten().any(Spec::is_rod);
        (self.strikes_pieces() && specs.along.is_rod() && specs.down.is_rod() && is_braced).then_some(points)
    }

    /// Whether there are surfaces, in the plane.
    fn strikes_pieces(&self) -> bool {
        D == 2 && !self.obstacles.is_empty()
    }

    fn members(&self, points: &[u32]) -> Members {
        let places: Vec<u32> = points.iter().map(|&point| self.place[point as usize]).collect();
        let is_row = places.windows(2).all(|pair| pair[1] == pair[0] + 1);
        if is_row { Members::From(places[0]) } else { Members::List(places) }
    }

    /// Under the sources' method a rigid bond is a relaxed one.
    fn meant(&self, spec: Spec) -> Spec {
        match (self.model.method.solver, spec.kind) {
            (Solver::Relaxation, BondKind::Rigid) => {
                Spec { kind: BondKind::Relaxed { relaxation: 1.0, max_correction: f64::INFINITY }, ..spec }
            }
            _ => spec,
        }
    }

    fn draft(&self, island: &Island, structure: &Structure) -> Draft<D> {
        match structure {
            &Structure::Sheet { first, columns, rows, specs } => {
                let all: Vec<u32> = (first..first + (columns * rows) as u32).collect();
                match self.members(&all) {
                    // A pin of the sheet that holds nothing is in no group.
                    Members::List(_) => self.mesh(island),
                    members => {
                        let (specs, rows_last) = (specs.map(|&spec| self.meant(spec)), self.rows_last(first, columns));
                        let piece = self.piece_of_sheet(columns * rows, &specs);
                        Draft { shape: Shape::Sheet { columns, rows, specs, rows_last }, members, piece }
                    }
                }
            }
            Structure::Chain { points, spec, rests } if self.lot.choice.solver == Solver::Path => {
                let shape = Shape::Chain { spec: *spec, rests: rests.clone() };
                Draft { shape, members: self.members(points), piece: None }
            }
            _ => self.mesh(island),
        }
    }

    fn mesh(&self, island: &Island) -> Draft<D> {
        let bonds = &self.gathered.bonds;
        let members = structure::members(island, bonds);
        let mut name = vec![0; self.place.len()];
        for (i, &member) in members.iter().enumerate() {
            name[member as usize] = i as u32;
        }
        let segment = |&k: &u32| Segment {
            ends: bonds.ends()[k as usize].map(|end| name[end.index()]),
            spec: self.meant(Spec::of(&bonds.get(k as usize))),
        };
        let position = |&i: &u32| widen(self.gathered.state.position[i as usize]);
        let has_trails = self.lot.choice.solver == Solver::Path;
        let segments: Vec<Segment> = island.bonds.iter().map(segment).collect();
        let links: Vec<([u32; 2], Spec)> = segments.iter().map(|segment| (segment.ends, segment.spec)).collect();
        let piece = self.piece(members.len(), &links);
        let shape = Shape::Mesh {
            points: members.len(),
            segments,
            trails: has_trails.then(|| (members.iter().map(position).collect(), self.model.field())),
        };
        Draft { shape, members: self.members(&members), piece }
    }

    /// Whether gravity pulls along the rows of a sheet rather than along its columns.
    fn rows_last(&self, first: u32, columns: usize) -> bool {
        let at = |i: usize| self.gathered.state.position[first as usize + i];
        let along = |i: usize| -> f64 {
            let way = (0..D).map(|k| (at(i)[k].to_f64() - at(0)[k].to_f64()) * self.model.gravity[k]);
            way.sum::<f64>().abs()
        };
        along(1) > along(columns)
    }
}
