//! The band along the rim of a disc, where its lattice ends: a Delaunay triangulation without gaps.
//!
//! A triangle whose circumcircle is larger than [`WIDEST`] gets a point at the circle's centre, until there is none.
//! No two points are then nearer to each other than [`WIDEST`], for each point that came had an empty circle about it;
//! so the sine of an angle, which is its opposite side over twice the circle's radius, is 1/2 at least: 30 degrees.
//! No such centre lies outside: a circle about it would hold an end of the rim's side that it looks through, as sides
//! are no longer than sqrt(3) times [`WIDEST`].
//!
//! Source: L. P. Chew, "Guaranteed-quality triangular meshes", Cornell TR 89-983 (1989).

use spade::{DelaunayTriangulation, HierarchyHintGenerator, InsertionError, Point2, Triangulation};

use super::rows::{ROW_HEIGHT, Rows, position};

/// Largest radius of a triangle's circumcircle, and least distance of two points `[spacings]`. The rim's sides are 0.89 to
/// 1.05 long, the lattice's 1 with circles of 0.58: well above that, gaps are filled evenly; 1/sqrt(3) would fill the
/// lattice itself, and 0.89 is the most that the shortest of the rim's sides allow.
pub(super) const WIDEST: f64 = 0.8;

/// Depth from which on the lattice is as if there was no rim `[spacings]`: its points are farther than two sides from the
/// lattice's own end.
const DEEP: f64 = 3.5;

/// Depth down to which points are triangulated `[spacings]`: two more, so that triangles at [`DEEP`] are right.
const LOADED: f64 = 6.0;

type Mesh = DelaunayTriangulation<Point2<f64>, (), (), (), HierarchyHintGenerator<f64>>;

/// What a disc of triangles is made of, in spacings.
#[derive(Clone, Debug)]
pub(super) struct Band {
    /// Points that fill gaps, from below, and from left to right.
    pub(super) added: Vec<[f64; 2]>,
    /// Sides of triangles with an end that is not deep, by the numbers of points: the rim, the lattice, those added.
    pub(super) sides: Vec<[u32; 2]>,
    /// Triangles with a corner that is not deep, anticlockwise.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Number of each point that is not deep, with a third of the area of the triangles around it.
    pub(super) shares: Vec<(u32, f64)>,
}

/// Whether a point of the lattice has the six neighbours of the lattice, and all the triangles between them.
pub(super) fn is_deep([x, y]: [f64; 2], radius: f64) -> bool {
    let depth = radius - DEEP;
    depth > 0.0 && x * x + y * y <= depth * depth
}

impl Band {
    /// Triangulates the band between the points of the `rim`, all `radius` from the centre, and the lattice.
    ///
    /// Errors: the triangulation's, on coordinates that are no numbers.
    pub(super) fn new(radius: f64, rim: &[[f64; 2]], rows: &Rows) -> Result<Self, InsertionError> {
        let mut numbers: Vec<u32> = (0..rim.len() as u32).collect();
        let mut points: Vec<[f64; 2]> = rim.to_vec();
        for (number, cell) in (rim.len() as u32..).zip(rows.cells()) {
            let [x, y] = position(cell);
            if radius < LOADED || x * x + y * y > (radius - LOADED) * (radius - LOADED) {
                numbers.push(number);
                points.push([x, y]);
            }
        }
        let is_lattice_deep: Vec<bool> =
            (0..points.len()).map(|k| k >= rim.len() && is_deep(points[k], radius)).collect();
        let is_deep = |k: usize| is_lattice_deep.get(k).copied().unwrap_or(false);
        let mut mesh = Mesh::bulk_load_stable(points.iter().map(|&[x, y]| Point2::new(x, y)).collect())?;
        fill(&mut mesh, is_deep)?;
        let added = number_added(&mesh, points.len(), rim.len() as u32 + rows.len(), &mut numbers);
        let sides = mesh.undirected_edges().map(|side| side.vertices().map(|end| end.index()));
        let sides = sides.filter(|side| !side.iter().all(|&k| is_deep(k)));
        let sides = sides.map(|side| side.map(|k| numbers[k])).collect();
        let triangles = mesh.inner_faces().map(|face| face.vertices().map(|corner| corner.index()));
        let triangles = triangles.filter(|corners| !corners.iter().all(|&k| is_deep(k)));
        let triangles = triangles.map(|corners| corners.map(|k| numbers[k])).collect();
        let mut area = vec![0.0; mesh.num_vertices()];
        for face in mesh.inner_faces() {
            let third = face.area() / 3.0;
            face.vertices().iter().for_each(|corner| area[corner.index()] += third);
        }
        let shares = (0..area.len()).filter(|&k| !is_deep(k)).map(|k| (numbers[k], area[k])).collect();
        Ok(Band { added, sides, triangles, shares })
    }
}

/// A deep point's third of the area of the six triangles around it.
pub(super) const DEEP_SHARE: f64 = ROW_HEIGHT;

/// Adds points in the middle of gaps, the widest first, until none is left.
fn fill(mesh: &mut Mesh, is_deep: impl Fn(usize) -> bool) -> Result<(), InsertionError> {
    loop {
        let at_rim = mesh.inner_faces().filter(|face| face.vertices().iter().any(|corner| !is_deep(corner.index())));
        let mut gaps: Vec<(Point2<f64>, f64)> =
            at_rim.map(|face| face.circumcircle()).filter(|(_, square)| *square > WIDEST * WIDEST).collect();
        if gaps.is_empty() {
            return Ok(());
        }
        gaps.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut is_first = true;
        for (centre, _) in gaps {
            // The first is always far enough from all, whatever rounding makes of it: every round adds a point.
            let nearest =
                mesh.nearest_neighbor(centre).map_or(f64::INFINITY, |near| near.position().distance_2(centre));
            if is_first || nearest > WIDEST * WIDEST {
                mesh.insert(centre)?;
            }
            is_first = false;
        }
    }
}

/// The points after the first `loaded`, sorted; `numbers` is told theirs, from `first` on.
fn number_added(mesh: &Mesh, loaded: usize, first: u32, numbers: &mut Vec<u32>) -> Vec<[f64; 2]> {
    let place = |vertex: spade::handles::VertexHandle<'_, Point2<f64>, (), (), ()>| vertex.position();
    let added: Vec<Point2<f64>> = mesh.vertices().skip(loaded).map(place).collect();
    let mut order: Vec<usize> = (0..added.len()).collect();
    order.sort_by(|&i, &j| added[i].y.total_cmp(&added[j].y).then(added[i].x.total_cmp(&added[j].x)));
    numbers.resize(loaded + added.len(), 0);
    for (number, &k) in (first..).zip(&order) {
        numbers[loaded + k] = number;
    }
    order.into_iter().map(|k| [added[k].x, added[k].y]).collect()
}
