//! The finished mesh of a picture.

use super::mesh::Mesh;
use super::plane::{Point, turn};
use super::rope::Ropes;

/// Points, triangles and bonds made of a picture.
///
/// Shapes: points are those of the boundary, loop by loop, then those inside the mesh, then those of ropes. Whatever is
/// told of a point or a triangle is in the order of those.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PictureMesh {
    /// Width and height of the picture `[px]`.
    pub picture: [u32; 2],
    /// Places `[px]`: x to the right, y down, pixel centres at 1/2.
    pub points: Vec<Point>,
    /// How many of the points are of triangles; those of ropes follow.
    pub mesh_points: usize,
    /// Corners of triangles, anticlockwise as seen, that is with y up.
    pub triangles: Vec<[u32; 3]>,
    /// Bonds, the lower number first. The sides of triangles, each once, sorted; then those of ropes, rope by rope.
    pub bonds: Vec<[u32; 2]>,
    /// How many of the bonds are sides of triangles.
    pub mesh_bonds: usize,
    /// The points along each loop of the boundary, in order: the ink to the right, as seen.
    pub loops: Vec<Vec<u32>>,
    /// Which connected part each point belongs to, through bonds of any kind; from 0, by the lowest point.
    pub component: Vec<u32>,
    /// How many connected parts there are.
    pub components: usize,
    /// Texture coordinates of each point, 0 to 1: x / width and y / height.
    pub texture: Vec<[f32; 2]>,
    /// Area that each point stands for `[px^2]`: a third of the triangles around it, half of the strokes.
    pub areas: Vec<f64>,
}

/// Puts mesh and ropes together.
pub fn assemble(picture: [u32; 2], mesh: Mesh, ropes: Ropes) -> PictureMesh {
    let mesh_points = mesh.points.len();
    let mut points = mesh.points;
    points.extend(ropes.points);
    let mut areas = vec![0.0; points.len()];
    for &corners in &mesh.triangles {
        let [a, b, c] = corners.map(|k| points[k as usize]);
        corners.iter().for_each(|&k| areas[k as usize] += turn(a, b, c) / 6.0);
    }
    for (bond, area) in ropes.bonds.iter().zip(&ropes.areas) {
        bond.iter().for_each(|&k| areas[k as usize] += 0.5 * area);
    }
    let mut bonds = sides(&mesh.triangles, mesh_points);
    let mesh_bonds = bonds.len();
    bonds.extend(ropes.bonds);
    let (component, components) = components(points.len(), &bonds);
    let share = |at: f64, size: u32| (at / f64::from(size)).clamp(0.0, 1.0) as f32;
    let texture = points.iter().map(|&[x, y]| [share(x, picture[0]), share(y, picture[1])]).collect();
    let triangles = mesh.triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect();
    let loops = mesh.loops;
    PictureMesh {
        picture,
        points,
        mesh_points,
        triangles,
        bonds,
        mesh_bonds,
        loops,
        component,
        components,
        texture,
        areas,
    }
}

/// Sides of triangles that all turn the same way, each once, sorted.
fn sides(triangles: &[[u32; 3]], count: usize) -> Vec<[u32; 2]> {
    // Sorted by their lower end through counting, then each point's few by the other end.
    let all = || triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut starts = vec![0_u32; count + 1];
    all().for_each(|[a, b]| starts[a.min(b) as usize + 1] += 1);
    (0..count).for_each(|k| starts[k + 1] += starts[k]);
    let mut free = starts.clone();
    let mut others = vec![0; 3 * triangles.len()];
    for [a, b] in all() {
        let place = &mut free[a.min(b) as usize];
        others[*place as usize] = a.max(b);
        *place += 1;
    }
    let mut sides = Vec::with_capacity(2 * triangles.len());
    for k in 0..count {
        let mine = &mut others[starts[k] as usize..starts[k + 1] as usize];
        mine.sort_unstable();
        for (at, &other) in mine.iter().enumerate() {
            if at == 0 || mine[at - 1] != other {
                sides.push([k as u32, other]);
            }
        }
    }
    sides
}

/// Which connected part each point is in, and how many there are.
fn components(count: usize, bonds: &[[u32; 2]]) -> (Vec<u32>, usize) {
    let mut lowest: Vec<u32> = (0..count as u32).collect();
    fn root(lowest: &mut [u32], mut k: u32) -> u32 {
        while lowest[k as usize] != k {
            lowest[k as usize] = lowest[lowest[k as usize] as usize];
            k = lowest[k as usize];
        }
        k
    }
    for &[a, b] in bonds {
        let (a, b) = (root(&mut lowest, a), root(&mut lowest, b));
        lowest[a.max(b) as usize] = a.min(b);
    }
    let mut numbers = vec![u32::MAX; count];
    let mut found = 0;
    for k in 0..count {
        let root = root(&mut lowest, k as u32) as usize;
        if root == k {
            (numbers[k], found) = (found, found + 1);
        } else {
            numbers[k] = numbers[root];
        }
    }
    (numbers, found as usize)
}
