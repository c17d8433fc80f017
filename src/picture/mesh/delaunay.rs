//! The constrained Delaunay triangulation of the points, refined.

use std::panic::{AssertUnwindSafe, catch_unwind};

use spade::handles::FixedVertexHandle;
use spade::{AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation};

use super::super::PictureError;
use super::super::plane::{Point, doubled_area};
use super::super::settings::UNIT_TRIANGLE;
use super::lattice::Lattice;

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The least angle that is refined for `[degrees]`. At 33 refining still ends, mostly; at 35 it does not.
const ANGLE: f64 = 30.0;

/// Triangles smaller than this share of an equilateral one are not refined: their sides would fall under 0.2 spacings.
const SMALLEST: f64 = 0.05;

/// Points, in the order of loops, front and lattice, and what is known of them before they are triangulated.
#[derive(Debug)]
pub(super) struct Load {
    pub(super) points: Vec<Point>,
    /// Edges that bound what is to be triangulated.
    edges: Vec<[u32; 2]>,
    /// How many points lie on the loops.
    on_boundary: usize,
    /// Triangles that are known.
    known: Vec<[u32; 3]>,
    /// Points of known triangles only.
    is_deep: Vec<bool>,
    /// Where the edges between known triangles and others begin in `edges`.
    first_inner_edge: usize,
}

/// A filled boundary.
#[derive(Debug)]
pub(super) struct Filled {
    pub(super) points: Vec<Point>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// How many of the triangles were not known beforehand: they come first.
    pub(super) new_triangles: usize,
    /// Points that may move.
    pub(super) is_free: Vec<bool>,
    /// Edges of the boundary, the ink to their left in (x, y); loop by loop at first, though not along each.
    pub(super) rim: Vec<[u32; 2]>,
}

impl Load {
    pub(super) fn new(loops: &[Vec<Point>], front: Vec<(Point, f64)>) -> Self {
        let mut points = loops.concat();
        let on_boundary = points.len();
        let mut edges = Vec::with_capacity(on_boundary);
        let mut first = 0;
        for one in loops {
            let count = one.len() as u32;
            edges.extend((0..count).map(|k| [first + k, first + (k + 1) % count]));
            first += count;
        }
        points.extend(front.into_iter().map(|(point, _)| point));
        let first_inner_edge = edges.len();
        Load { points, edges, on_boundary, known: Vec::new(), is_deep: Vec::new(), first_inner_edge }
    }

    /// Adds all points of the lattice; returns their numbers.
    pub(super) fn add_lattice(&mut self, lattice: &Lattice) -> Vec<u32> {
        let mut numbers = vec![u32::MAX; lattice.state.len()];
        for at in 0..lattice.state.len() {
            if lattice.state[at] != 0 {
                numbers[at] = self.points.len() as u32;
                self.points.push(lattice.place(at % lattice.columns, at / lattice.columns));
            }
        }
        numbers
    }

    /// The same, and takes the triangles for known that lie this many rows from the lattice's end.
    pub(super) fn add_lattice_but_known(&mut self, lattice: &mut Lattice, rows: u8) {
        lattice.count_steps(rows);
        let numbers = self.add_lattice(lattice);
        self.is_deep = vec![false; self.points.len()];
        let is_known = |at: usize| lattice.state[at] >= rows;
        for at in (0..lattice.state.len()).filter(|&at| is_known(at)) {
            let around = lattice.around(at);
            let near = around.map(is_known);
            self.is_deep[numbers[at] as usize] = near == [true; 6];
            for k in 0..6 {
                let (here, next) = (around[k], around[(k + 1) % 6]);
                // Each triangle is told by its first corner: the two that have it to the right and below.
                if k < 2 && near[k] && near[k + 1] {
                    self.known.push([at, here, next].map(|at| numbers[at]));
                }
                // An edge with a known triangle on one side only, told by the end that has the triangle to the left.
                if near[k] && near[(k + 1) % 6] && !near[(k + 5) % 6] {
                    self.edges.push([numbers[at], numbers[here]]);
                }
            }
        }
    }
}

/// Triangulates and refines.
///
/// Errors: edges that cross, loops that lie in each other in the wrong way, or a panic within spade.
pub(super) fn fill(load: Load, spacing: f64, max_area: Option<f64>) -> Result<Filled, PictureError> {
    // Loops are checked for crossings, and spade is told to skip what crosses all the same. Yet its refinement asserts
    // what rounding may break on points that are next to each other: a coarser or stricter outline is tried then.
    let run = catch_unwind(AssertUnwindSafe(|| triangulate(load, spacing, max_area)));
    run.unwrap_or_else(|_| Err(PictureError::Mesh("refining gave up".into())))
}

fn triangulate(load: Load, spacing: f64, max_area: Option<f64>) -> Result<Filled, PictureError> {
    let wrong = |reason: &str| PictureError::Mesh(reason.into());
    let is_deep = |k: usize| load.is_deep.get(k).copied().unwrap_or(false);
    let mut numbers: Vec<u32> = (0..load.points.len() as u32).filter(|&k| !is_deep(k as usize)).collect();
    let mut loaded = vec![usize::MAX; load.points.len()];
    numbers.iter().enumerate().for_each(|(at, &k)| loaded[k as usize] = at);
    let places = numbers.iter().map(|&k| load.points[k as usize]).map(|[x, y]| Point2::new(x, y)).collect();
    let edges = load.edges.iter().map(|edge| edge.map(|k| loaded[k as usize])).collect();
    let mut conflicts = 0;
    let mut cdt =
        Cdt::try_bulk_load_cdt(places, edges, |_| conflicts += 1).map_err(|_| wrong("a point is no number"))?;
    if conflicts > 0 || cdt.num_vertices() != numbers.len() {
        return Err(wrong("its edges cross"));
    }
    let refined = cdt.refine(parameters(&load, &cdt, spacing, max_area));
    let inner_edges = &load.edges[load.first_inner_edge..];
    let vertex = |k: u32| FixedVertexHandle::from_index(loaded[k as usize]);
    if inner_edges.iter().any(|&[a, b]| !cdt.exists_constraint(vertex(a), vertex(b))) {
        return Err(wrong("refining went too deep"));
    }
    let mut is_outside = vec![false; cdt.num_all_faces()];
    refined.excluded_faces.iter().for_each(|face| is_outside[face.index()] = true);
    is_outside[0] = true;
    // Loops of ink have it to their left, and so must the mesh: else a hole has slipped out of its ink.
    let is_right = |&[a, b]: &[u32; 2]| {
        let edge = cdt.get_edge_from_neighbors(vertex(a), vertex(b));
        edge.is_none_or(|edge| !is_outside[edge.face().index()] && is_outside[edge.rev().face().index()])
    };
    if !load.edges[..load.first_inner_edge].iter().all(is_right) {
        return Err(wrong("its loops lie in each other in the wrong way"));
    }
    numbers.extend((0..).map(|k| load.points.len() as u32 + k).take(cdt.num_vertices() - numbers.len()));
    collect(load, &cdt, &numbers, &is_outside)
}

fn parameters(load: &Load, cdt: &Cdt, spacing: f64, max_area: Option<f64>) -> RefinementParameters<f64> {
    let triangle = UNIT_TRIANGLE * spacing * spacing;
    let area: f64 = load.edges[..load.first_inner_edge]
        .iter()
        .map(|&[a, b]| doubled_area(&[[0.0, 0.0], load.points[a as usize], load.points[b as usize]]))
        .sum::<f64>()
        * 0.5;
    // Refining adds a few points for each of the boundary and, where there is a largest area, of the inside.
    let inside = max_area.map_or(0.0, |max_area| 6.0 * area / max_area);
    let budget = inside as usize + 10 * load.on_boundary + cdt.num_vertices() / 4 + 1000;
    let parameters = RefinementParameters::new()
        .exclude_outer_faces(true)
        .with_angle_limit(AngleLimit::from_deg(ANGLE))
        .with_min_required_area(SMALLEST * triangle)
        .with_max_additional_vertices(budget);
    max_area.map_or(parameters.clone(), |max_area| parameters.with_max_allowed_area(max_area))
}

/// Takes the triangles inside, adds the known ones.
fn collect(load: Load, cdt: &Cdt, numbers: &[u32], is_outside: &[bool]) -> Result<Filled, PictureError> {
    let first_new = load.points.len();
    let mut points = load.points;
    points.extend(cdt.vertices().skip(numbers.iter().take_while(|&&k| (k as usize) < first_new).count()).map(
        |vertex| {
            let place = vertex.position();
            [place.x, place.y]
        },
    ));
    let inside = cdt.inner_faces().filter(|face| !is_outside[face.index()]);
    let mut triangles: Vec<[u32; 3]> =
        inside.map(|face| face.vertices().map(|corner| numbers[corner.index()])).collect();
    let mut is_free = vec![true; points.len()];
    load.is_deep.iter().enumerate().filter(|(_, is_deep)| **is_deep).for_each(|(k, _)| is_free[k] = false);
    load.edges.iter().flatten().for_each(|&k| is_free[k as usize] = false);
    let inner_rim = |k: u32| (k as usize) >= load.on_boundary && (k as usize) < first_new;
    let mut rim = Vec::with_capacity(load.on_boundary);
    for edge in cdt.directed_edges().filter(|edge| edge.is_constraint_edge()) {
        let (left, right) = (!is_outside[edge.face().index()], !is_outside[edge.rev().face().index()]);
        if left == right {
            return Err(PictureError::Mesh("an edge has ink on both sides".into()));
        }
        let [from, to] = edge.vertices().map(|vertex| numbers[vertex.index()]);
        if left && !(inner_rim(from) && inner_rim(to)) {
            rim.push([from, to]);
            (is_free[from as usize], is_free[to as usize]) = (false, false);
        }
    }
    let new_triangles = triangles.len();
    triangles.extend(&load.known);
    Ok(Filled { points, triangles, new_triangles, is_free, rim })
}
