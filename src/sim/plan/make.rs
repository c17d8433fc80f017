//! One group: its points, what acts on them, and what watches over them.

use super::gather::Gathered;
use super::island::{Island, Patched};
use super::lot::Lot;
use super::rigid::Pieces;
use crate::sim::account::Account;
use crate::sim::bond::{Bond, BondKind, Limit, PointId};
use crate::sim::bulk::control::FRAME;
use crate::sim::bulk::mover::Mover;
use crate::sim::constrain::direct::Direct;
use crate::sim::constrain::shape::{Leg, Row, Shape};
use crate::sim::contact::Contacts;
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::force::angle::Hinge;
use crate::sim::force::area::Patch;
use crate::sim::force::form::Form;
use crate::sim::force::spring::Springs;
use crate::sim::group::events::edge::Edges;
use crate::sim::group::guard::{Guard, Watched};
use crate::sim::group::sleep::Sleep;
use crate::sim::group::watch::Watch;
use crate::sim::group::{Breakable, Group, MOST_EFFORT, Plain, Work};
use crate::sim::live;
use crate::sim::model::Model;
use crate::sim::moved::Moved;
use crate::sim::points::{Points, State};
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::sizes::{MOST_AMONG_WALLS, MOST_HANDED_OVER_RIGID, MOST_HANDED_OVER_SOFT, MOST_LOCATED};
use crate::sim::solver::Solver;
use crate::sim::vector::zero;

/// Seconds of counted work for a second of the scene up to which steps are cut for their errors, where there is a budget.
const FINE_EFFORT: f64 = 0.1;

/// Makes one group.
pub(super) struct Maker<'a, S, const D: usize> {
    pub(super) gathered: &'a Gathered<S, D>,
    pub(super) model: &'a Model<D>,
    pub(super) obstacles: &'a Obstacles<S, D>,
    pub(super) lot: &'a Lot,
    /// Points of the model, in the order of the group.
    pub(super) points: &'a [u32],
    /// Place of every point of the model in the group.
    pub(super) place: &'a [u32],
}

impl<S: Real, const D: usize> Maker<'_, S, D> {
    pub(super) fn make(&self) -> Group<S, D> {
        let choice = self.lot.choice;
        let batched = match choice.solver {
            Solver::Live => self.make_live(),
            Solver::Rigid => self.make_rigid(),
            Solver::AsPrinted(source) => Some(self.make_printed(source)),
            _ => choice.bulk.and_then(|scheme| self.make_bulk(scheme)),
        };
        if let Some(group) = batched {
            return group;
        }
        let w: Vec<f64> = self.points.iter().map(|&i| self.gathered.w[i as usize]).collect();
        let bonds: Vec<(u32, Bond)> = self.bonds().collect();
        let mut points = self.state(&w);
        let rigid = (choice.is_direct && (choice.solver.solves_directly() || self.holds_areas()))
            .then(|| self.with_areas(rows(&bonds, &points.inverse_mass), &points.inverse_mass))
            .filter(|(rows, _)| !rows.is_empty())
            .map(|(rows, legs)| Direct::new(Shape::new(rows, legs, self.points.len())));
        let springs = match choice.solver {
            Solver::Xpbd | Solver::Path | Solver::Live => Springs::none(),
            _ => Springs::new(bonds.iter().map(|(_, bond)| bond), self.points.len()),
        };
        let pull = Pull {
            springs,
            form: self.form(),
            contacts: Contacts::new(self.obstacles, self.points.len()),
            rigid,
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
        };
        self.allocate(&mut points, &pull);
        let engine = self.engine(choice.solver, &bonds, &points, &pull);
        let plain = choice.plain.map(|substep| Plain {
            engine: Box::new(self.engine(Solver::VelocityVerlet, &bonds, &points, &pull)),
            effort: if self.model.method.budget.is_some() { FINE_EFFORT } else { MOST_EFFORT },
            substep,
            has_yielded: false,
        });
        let robust = self.robust(&bonds, &points, &pull).map(Box::new);
        let is_soft = self.lot.islands.iter().all(|island| island.rigid == 0);
        let most = if is_soft && self.obstacles.has_walls() { MOST_AMONG_WALLS } else { MOST_LOCATED };
        let locates = choice.solver.locates_events() && self.lot.points <= most;
        Group {
            guard: self.guard(&bonds),
            breakable: breakable(bonds.iter().copied(), |_| true),
            edges: if locates {
                Edges::of(&pull, &breakable(bonds.iter().copied(), is_elastic))
            } else {
                Edges::none()
            },
            tracks: self.tracks(),
            substep: choice.substep,
            locates,
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
            points,
            pull,
            engine,
            plain,
            robust,
        }
    }

    /// The bonds of the lot as listed, between points of the group, with their names.
    pub(super) fn bonds(&self) -> impl Iterator<Item = (u32, Bond)> {
        let mut list: Vec<u32> = self.lot.islands.iter().flat_map(|island| island.bonds.iter().copied()).collect();
        list.sort_unstable();
        let moved = move |k: u32| {
            let bond = self.gathered.bonds.get(k as usize);
            let [a, b] = [bond.a, bond.b].map(|end| PointId(self.place[end.index()]));
            (self.gathered.names[k as usize], Bond { a, b, ..bond })
        };
        list.into_iter().map(moved)
    }

    /// The angles of the lot between points of the group, and the areas that are forces.
    pub(super) fn form<T: Real>(&self) -> Form<T> {
        let ties = &self.gathered.ties;
        let placed = |points: [PointId; 3]| points.map(|point| self.place[point.index()]);
        let islands = &self.lot.islands;
        let mut angles: Vec<u32> = islands.iter().flat_map(|island| island.angles.iter().copied()).collect();
        angles.sort_unstable();
        let hinge = |k: u32| {
            let angle = &ties.angles[k as usize];
            Hinge::new(angle, placed(angle.points))
        };
        let patch = |(corners, rest): ([u32; 3], f64)| Patch {
            corners,
            rest: T::from_f64(rest),
            stiffness: T::from_f64(ties.stiffness),
        };
        let areas = if ties.holds_areas() { Vec::new() } else { self.patches() };
        Form { hinges: angles.into_iter().map(hinge).collect(), patches: areas.into_iter().map(patch).collect() }
    }

    /// The triangles of the lot that resist, with their areas at rest `[m^2]`.
    pub(super) fn patches(&self) -> Vec<([u32; 3], f64)> {
        let mut list: Vec<u32> = self.lot.islands.iter().flat_map(|island| island.patches.iter().copied()).collect();
        list.sort_unstable();
        let of = |k: u32| {
            let Patched { corners, rest, .. } = self.gathered.ties.patches[k as usize];
            (corners.map(|corner| self.place[corner.index()]), rest)
        };
        list.into_iter().map(of).collect()
    }

    /// Whether some area is held.
    pub(super) fn holds_areas(&self) -> bool {
        self.gathered.ties.holds_areas() && self.lot.islands.iter().any(|island| !island.patches.is_empty())
    }

    /// Rows for areas that are held, behind those of bonds.
    fn with_areas(&self, mut rows: Vec<Row<S>>, w: &[S]) -> (Vec<Row<S>>, Vec<Leg<S>>) {
        let mut legs = Vec::new();
        let held = if self.gathered.ties.holds_areas() { self.patches() } else { Vec::new() };
        for ([p, q, r], area) in held {
            let [w_p, w_q, w_r] = [p, q, r].map(|corner| w[corner as usize]);
            legs.push(Leg { row: rows.len() as u32, c: r, w_c: w_r, area: S::from_f64(area) });
            rows.push(Row {
                a: q,
                b: p,
                w_a: w_q,
                w_b: w_p,
                rest_length: S::ZERO,
                // Its error is that of its area alone.
                inverse_square: S::ZERO,
                limit: Limit::Both,
                is_taut: true,
            });
        }
        (rows, legs)
    }

    /// An empty account, where a ledger is kept.
    pub(super) fn account(&self) -> Option<Box<Account>> {
        let bonds: Vec<Bond> = self.model.method.ledger.then(|| self.bonds().map(|(_, bond)| bond).collect())?;
        let tracks = self.tracks();
        let mut account = Account::new(bonds.iter(), self.form(), &tracks);
        let is_led = |corner: &u32| tracks.iter().any(|(led, _)| led == corner);
        account.pulls_rigid |=
            self.holds_areas() && self.patches().iter().any(|(corners, _)| corners.iter().any(is_led));
        Some(Box::new(account))
    }

    /// What is watched of the group, where it may be handed over to the live step or stand still.
    pub(super) fn watch(&self) -> Option<Box<Watch<S, D>>> {
        self.model.freezes().then_some(())?;
        // Of a step of hours the live step would take frame after frame.
        self.model.method.substep.is_none_or(|h| h <= FRAME).then_some(())?;
        if self.model.budget().is_none() {
            return Some(Box::new(Watch::new(0, (&[], &[]), false, (false, false))));
        }
        let bonds: Vec<Bond> = self.bonds().map(|(_, bond)| bond).collect();
        let islands = &self.lot.islands;
        let count = |of: fn(&Island) -> usize| islands.iter().map(of).sum::<usize>();
        let (points, rigid) = (count(|island| island.points.len()), count(|island| island.rigid));
        // What is swept is defined by its sweeps, and nothing is so large that a frame of the live step would be long.
        let most = if rigid > 0 { MOST_HANDED_OVER_RIGID } else { MOST_HANDED_OVER_SOFT };
        let are_alone =
            !islands.is_empty() && islands.iter().all(|island| island.pieces.as_ref().is_some_and(Pieces::is_one));
        let is_few = are_alone || bonds.len() <= most;
        // The live step in space knows no drives, and stretches nets of rigid bonds by some percent.
        let stays = D == 3 && (rigid > 0 || islands.iter().any(|island| island.has_drives));
        let may_go = count(|island| island.relaxed) == 0 && is_few && points > 0 && !stays;
        let surfaces = &self.obstacles.surfaces;
        let tracks = self.tracks();
        let can_fail = rigid > 0 || !surfaces.is_empty() || self.model.mouse.is_some() || !tracks.is_empty();
        // A rigid body alone has no strain, and makes no energy.
        let has_eyes = can_fail && !are_alone;
        // What forces and wind bring is known to a ledger alone.
        let gives = islands.iter().any(|island| island.has_drives)
            || surfaces.iter().any(|surface| surface.restitution > S::ONE)
            || self.model.has_fields()
            || self.model.wind.is_some();
        // In space nothing is inside out.
        let triangles = if may_go && D == 2 { self.triangles() } else { Vec::new() };
        let corners: Vec<[u32; 3]> = triangles.iter().map(|(corners, _)| *corners).collect();
        let watch = Watch::new(points, (&bonds, &corners), may_go, (has_eyes && may_go, !gives));
        Some(Box::new(watch.with_scout(self.scout(&bonds))))
    }

    /// What looks whether a body that its own method moves comes near itself or is pressed flat, where bodies meet.
    fn scout(&self, bonds: &[Bond]) -> Option<Box<dyn Mover<S, D>>> {
        if !self.model.meets_on_demand() || bonds.is_empty() || self.lot.choice.solver == Solver::Live {
            return None;
        }
        let w: Vec<f64> = self.points.iter().map(|&i| self.gathered.w[i as usize]).collect();
        live::mover(self.live_draft(), &self.state(&w), &self.batched_pull())
    }

    pub(super) fn state(&self, w: &[f64]) -> Points<S, D> {
        let state = &self.gathered.state;
        let pick = |list: &[[S; D]]| -> Vec<[S; D]> { self.points.iter().map(|&i| list[i as usize]).collect() };
        let picked = State {
            position: pick(&state.position),
            velocity: pick(&state.velocity),
            position_lost: pick(&state.position_lost),
            velocity_lost: pick(&state.velocity_lost),
        };
        Points::new(picked, w.iter().map(|&w| S::from_f64(w)).collect())
    }

    pub(super) fn tracks(&self) -> Vec<(u32, crate::sim::force::mouse::Track<D>)> {
        let of = |(point, track): &(PointId, _)| {
            let stand_in = self.gathered.stand_ins[point.index()] as usize;
            let slot = self.place[stand_in];
            (slot != u32::MAX).then(|| (slot, Clone::clone(track)))
        };
        self.model.pin_motion.iter().filter_map(of).collect()
    }

    /// Gives the group the lists that its phases need, and no others.
    fn allocate(&self, points: &mut Points<S, D>, pull: &Pull<S, D>) {
        let count = points.len();
        let is_pushed = self.model.mouse.is_some() || pull.has_fields();
        let has_forces = !pull.springs.is_empty() || !pull.form.is_empty() || is_pushed || pull.contacts.has_surfaces();
        if has_forces {
            points.acceleration = vec![zero(); count];
        }
        if pull.is_damped() {
            points.velocity_ahead = vec![zero(); count];
        }
        points.displacement = vec![zero(); count];
    }

    /// Bonds whose turns and moves are watched: those of methods that a large substep can break.
    fn guard(&self, bonds: &[(u32, Bond)]) -> Guard<S> {
        let follows_turns = self.lot.choice.solver.order() > 2;
        if matches!(self.lot.choice.solver, Solver::Relaxation | Solver::Xpbd | Solver::Path | Solver::Live) {
            return Guard { bonds: Vec::new(), follows_turns };
        }
        let is_watched = |bond: &Bond| !matches!(bond.kind, BondKind::Relaxed { .. }) && bond.rest_length > 0.0;
        let of = |bond: &Bond| Watched {
            a: bond.a.0,
            b: bond.b.0,
            rest_square: S::from_f64(bond.rest_length * bond.rest_length),
        };
        let bonds = bonds.iter().map(|(_, bond)| bond).filter(|bond| is_watched(bond)).map(of).collect();
        Guard { bonds, follows_turns }
    }
}

/// The rigid bonds of a group, for the direct solver.
fn rows<S: Real>(bonds: &[(u32, Bond)], w: &[S]) -> Vec<Row<S>> {
    let of = |(_, bond): &(u32, Bond)| {
        let (w_a, w_b) = (w[bond.a.index()], w[bond.b.index()]);
        let rest = S::from_f64(bond.rest_length);
        (bond.kind == BondKind::Rigid && w_a + w_b > S::ZERO).then(|| Row {
            a: bond.a.0,
            b: bond.b.0,
            w_a,
            w_b,
            rest_length: rest,
            inverse_square: if rest > S::ZERO { S::ONE / (rest * rest) } else { S::ONE },
            limit: bond.limit,
            is_taut: true,
        })
    };
    bonds.iter().filter_map(of).collect()
}

fn is_elastic(bond: &Bond) -> bool {
    matches!(bond.kind, BondKind::Spring { .. })
}

pub(super) fn breakable<S: Real>(
    bonds: impl Iterator<Item = (u32, Bond)>,
    is_meant: impl Fn(&Bond) -> bool,
) -> Vec<Breakable<S>> {
    let of = |(name, bond): (u32, Bond)| {
        let scale = if bond.rest_length > 0.0 { bond.rest_length } else { 1.0 };
        let most = if bond.rest_length > 0.0 { scale * (1.0 + bond.break_strain) } else { bond.break_strain };
        (bond.break_strain.is_finite() && is_meant(&bond)).then(|| Breakable {
            a: bond.a.0,
            b: bond.b.0,
            most_square: S::from_f64(most * most),
            bond: name,
        })
    };
    bonds.filter_map(of).collect()
}
