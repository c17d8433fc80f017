//! A group of large bodies.

use super::choice::Scheme;
use super::make::{Maker, breakable};
use super::structure::Structure;
use crate::sim::bulk::Bulk;
use crate::sim::bulk::body::{AnyBody, Body, Members};
use crate::sim::bulk::chain::Chain;
use crate::sim::bulk::control::Control;
use crate::sim::bulk::mesh::Mesh;
use crate::sim::bulk::sheet::Sheet;
use crate::sim::bulk::spec::Spec;
use crate::sim::bulk::trails::Segment;
use crate::sim::contact::Contacts;
use crate::sim::contact::surface::surfaces;
use crate::sim::force::spring::Springs;
use crate::sim::group::Group;
use crate::sim::group::engine::Engine;
use crate::sim::group::events::edge::Edges;
use crate::sim::group::guard::Guard;
use crate::sim::plan::island::Island;
use crate::sim::points::{Points, State};
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::widen;

/// Mean number of bonds of a mesh's paths below which sweeps reach a strain as cheaply.
const SHORTEST_TRAILS: f64 = 8.0;

impl<S: Real, const D: usize> Maker<'_, S, D> {
    pub(super) fn make_bulk(&self, scheme: Scheme) -> Group<S, D> {
        let choice = self.lot.choice;
        let w: Vec<f64> = self.points.iter().map(|&i| self.gathered.w[i as usize]).collect();
        let mut points = self.state(&w);
        points.position_lost = Vec::new();
        points.velocity_lost = Vec::new();
        let bodies = self.lot.islands.iter().map(|island| self.body(island, &points)).collect();
        let control = match scheme.target {
            Some(target) => Control::following(target),
            None => Control::fixed(choice.substep),
        };
        let bulk = Bulk { bodies, way: scheme.way, control, nominal: choice.substep, lag: 0.0 };
        let bonds = self.bonds();
        Group {
            guard: Guard { bonds: Vec::new(), follows_turns: false },
            breakable: breakable(&bonds, |_| true),
            edges: Edges::none(),
            tracks: self.tracks(),
            substep: choice.substep,
            locates: false,
            before: State::default(),
            acceleration: Vec::new(),
            pull: Pull {
                springs: Springs::none(),
                contacts: Contacts::new(surfaces(self.model), self.points.len()),
                rigid: None,
                inside: None,
                gravity: self.model.gravity,
                drag_rate: self.model.drag_rate,
            },
            engine: Engine::Bulk(Box::new(bulk)),
            robust: None,
            points,
        }
    }

    fn body(&self, island: &Island, points: &Points<S, D>) -> AnyBody<S, D> {
        match Structure::of(island, &self.gathered.bonds, &self.gathered.w) {
            Structure::Sheet { first, columns, rows, specs } => {
                let sheet = Sheet::new(columns, rows, specs, self.rows_last(first, columns));
                let members = Members::From(self.place[first as usize]);
                AnyBody::Sheet(Box::new(Body::new(sheet, members, points)))
            }
            Structure::Chain { points: along, spec, rests } => {
                let members = Members::List(along.iter().map(|&point| self.place[point as usize]).collect());
                AnyBody::Chain(Box::new(Body::new(Chain::new(spec, &rests), members, points)))
            }
            Structure::Mesh => self.mesh(island, points),
        }
    }

    fn mesh(&self, island: &Island, points: &Points<S, D>) -> AnyBody<S, D> {
        let bonds = &self.gathered.bonds;
        let mut members: Vec<u32> =
            island.bonds.iter().flat_map(|&k| bonds.ends()[k as usize].map(|end| end.0)).collect();
        members.sort_unstable();
        members.dedup();
        let mut name = vec![0; self.place.len()];
        for (i, &member) in members.iter().enumerate() {
            name[member as usize] = i as u32;
        }
        let segment = |&k: &u32| Segment {
            ends: bonds.ends()[k as usize].map(|end| name[end.index()]),
            spec: Spec::of(&bonds.get(k as usize)),
        };
        let mut mesh = Mesh::new(members.len(), island.bonds.iter().map(segment).collect());
        let position: Vec<[f64; D]> =
            members.iter().map(|&i| widen(self.gathered.state.position[i as usize])).collect();
        if mesh.lay_trails(&position, self.model.gravity) < SHORTEST_TRAILS {
            mesh.forget_trails();
        }
        let members = Members::List(members.iter().map(|&member| self.place[member as usize]).collect());
        AnyBody::Mesh(Box::new(Body::new(mesh, members, points)))
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
