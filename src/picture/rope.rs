//! Thin strokes as chains of points, tied to the mesh.

use std::collections::BTreeSet;

use super::boundary::Bins;
use super::mesh::Mesh;
use super::plane::{Point, between, distance, dot, minus, to_segment};
use super::strand::{Line, Strands};

/// Points and bonds of ropes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ropes {
    /// Points, numbered on from those of the mesh `[px]`.
    pub points: Vec<Point>,
    /// Bonds, the lower number first: in order along each rope.
    pub bonds: Vec<[u32; 2]>,
    /// Area of stroke that each bond stands for `[px^2]`.
    pub areas: Vec<f64>,
}

/// Shortest line that is worth a bond where it closes a ring with the mesh, in spacings.
const SHORTEST: f64 = 0.75;

/// Divides lines into bonds of about the spacing `[px]`; roots become the nearest points of the mesh's boundary.
///
/// A ring has three bonds at least, and two lines between the same points are not the same bond, so that holes stay.
pub fn ropes(strands: &Strands, mesh: &Mesh, spacing: f64) -> Ropes {
    let mut ropes = Ropes::default();
    let first = mesh.points.len() as u32;
    let roots = roots(strands, mesh, spacing);
    let mut numbers = vec![u32::MAX; strands.nodes.len()];
    // Most pictures have no strokes.
    let sides = if strands.lines.is_empty() { Sides(Vec::new()) } else { Sides::new(mesh) };
    let mut places = Places::default();
    mesh.loops.iter().flatten().for_each(|&k| places.take(mesh.points[k as usize]));
    for (k, node) in strands.nodes.iter().enumerate() {
        numbers[k] = roots[k].unwrap_or_else(|| {
            ropes.points.push(places.apart(node.place, node.place));
            first + ropes.points.len() as u32 - 1
        });
    }
    let mut taken: BTreeSet<[u32; 2]> = BTreeSet::new();
    for line in &strands.lines {
        let ends = line.ends.map(|end| numbers[end as usize]);
        let mut inner = divided(&line.points, spacing);
        let pair = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let is_in_mesh = ends.iter().all(|&end| end < first);
        // What is this short and ends where the mesh connects anyway would be a bond of next to no length.
        let is_short = is_in_mesh && line.length() < SHORTEST * spacing;
        if is_short && (ends[0] == ends[1] || sides.has(pair)) {
            continue;
        }
        if ends[0] == ends[1] && inner.len() < 2 {
            inner = evenly(&line.points, 3);
        } else if inner.is_empty() && (is_in_mesh && sides.has(pair) || !taken.insert(pair)) {
            inner = evenly(&line.points, 2);
        }
        let middle = middle(&line.points);
        inner.iter_mut().for_each(|point| *point = places.apart(*point, middle));
        ropes.add(line, ends, &inner, first);
    }
    ropes
}

impl Ropes {
    fn add(&mut self, line: &Line, ends: [u32; 2], inner: &[Point], first: u32) {
        let mut before = ends[0];
        let area = line.width * line.length() / (inner.len() + 1) as f64;
        for k in 0..=inner.len() {
            let next = match inner.get(k) {
                Some(&point) => {
                    self.points.push(point);
                    first + self.points.len() as u32 - 1
                }
                None => ends[1],
            };
            self.bonds.push([before.min(next), before.max(next)]);
            self.areas.push(area);
            before = next;
        }
    }
}

/// Where points are, so that no two are in one place: strokes that join share pixels, and so may their points.
#[derive(Default)]
struct Places(BTreeSet<[i64; 2]>);

/// Steps by which points in one place are told from those that are apart `[1/px]`.
const STEPS: f64 = 256.0;

/// How far a point gives way at a time `[px]`.
const GIVES_WAY: f64 = 0.125;

/// How often it does at most: where so many points are in one place, a few more do no harm.
const MOST_STEPS: usize = 64;

impl Places {
    fn take(&mut self, point: Point) {
        self.0.insert(point.map(|x| (x * STEPS).round() as i64));
    }

    /// A place for a point that no other has: its own, or the nearest that is free towards another.
    fn apart(&mut self, point: Point, towards: Point) -> Point {
        let way = minus(towards, point);
        let length = dot(way, way).sqrt();
        let step = if length > GIVES_WAY { way.map(|x| GIVES_WAY * x / length) } else { [GIVES_WAY, 0.0] };
        let mut place = point;
        for _ in 0..MOST_STEPS {
            if !self.0.contains(&place.map(|x| (x * STEPS).round() as i64)) {
                break;
            }
            place = [place[0] + step[0], place[1] + step[1]];
        }
        self.take(place);
        place
    }
}

/// The mean of some places.
fn middle(points: &[Point]) -> Point {
    [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64)
}

/// The sides of a mesh's triangles.
struct Sides(Vec<[u32; 2]>);

impl Sides {
    fn new(mesh: &Mesh) -> Self {
        let of = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)]);
        let mut sides: Vec<[u32; 2]> = mesh.triangles.iter().flat_map(of).collect();
        sides.sort_unstable();
        Sides(sides)
    }

    fn has(&self, pair: [u32; 2]) -> bool {
        self.0.binary_search(&pair).is_ok()
    }
}

/// Least turn of a rope that gets a point: its cosine, of 45 degrees.
const STRAIGHT: f64 = 0.707;

/// How far to both sides a corner is looked for, in spacings.
const SUPPORT: f64 = 0.4;

/// The points that divide a line into pieces of about the spacing, its corners among them.
fn divided(points: &[Point], spacing: f64) -> Vec<Point> {
    let mut inner = Vec::new();
    let mut cuts = corners(points, spacing);
    cuts.push(points.len() - 1);
    let mut from = 0;
    for to in cuts {
        let piece = &points[from..=to];
        let count = ((length(piece) / spacing).round() as usize).max(1);
        inner.extend(evenly(piece, count));
        if to + 1 < points.len() {
            inner.push(points[to]);
        }
        from = to;
    }
    inner
}

/// Where a line of places a pixel apart has a corner: it turns most within a support.
fn corners(points: &[Point], spacing: f64) -> Vec<usize> {
    let support = ((SUPPORT * spacing) as usize).max(4);
    let cosine = |k: usize| {
        let (u, v) = (minus(points[k], points[k - support]), minus(points[k + support], points[k]));
        dot(u, v) / (dot(u, u) * dot(v, v)).sqrt().max(f64::MIN_POSITIVE)
    };
    let cosines: Vec<(usize, f64)> =
        (support..points.len().saturating_sub(support)).map(|k| (k, cosine(k))).filter(|c| c.1 < STRAIGHT).collect();
    let is_sharpest = |&&(k, cosine): &&(usize, f64)| {
        let near = cosines.iter().filter(|other| other.0.abs_diff(k) <= support);
        near.into_iter().all(|other| other.1 > cosine || other.1 == cosine && other.0 >= k)
    };
    cosines.iter().filter(is_sharpest).map(|c| c.0).collect()
}

fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
}

/// The `count - 1` points that divide a line evenly.
fn evenly(points: &[Point], count: usize) -> Vec<Point> {
    let length = length(points);
    let (mut inner, mut along) = (Vec::with_capacity(count), 0.0);
    for pair in points.windows(2) {
        let step = distance(pair[0], pair[1]);
        while inner.len() + 1 < count {
            let want = length * (inner.len() + 1) as f64 / count as f64;
            if want > along + step {
                break;
            }
            inner.push(between(pair[0], pair[1], if step > 0.0 { (want - along) / step } else { 0.0 }));
        }
        along += step;
    }
    inner
}

/// For each node that is a root, the point of the mesh it is tied to: an end of the edge of its boundary that is
/// nearest to the thick ink that the root touches. Between there and any other mesh lies the boundary of its own.
fn roots(strands: &Strands, mesh: &Mesh, spacing: f64) -> Vec<Option<u32>> {
    let edges: Vec<[u32; 2]> =
        mesh.loops.iter().flat_map(|one| (0..one.len()).map(|k| [one[k], one[(k + 1) % one.len()]])).collect();
    let segments: Vec<[Point; 2]> = edges.iter().map(|edge| edge.map(|k| mesh.points[k as usize])).collect();
    let bins = Bins::new(&segments, spacing);
    let nearest = |place: Point| {
        let within = |reach: f64| {
            let near = bins.near([place, place], reach).map(|k| (to_segment(place, segments[k]), k));
            near.filter(|((off, _), _)| *off <= reach).min_by(|a, b| a.0.0.total_cmp(&b.0.0).then(a.1.cmp(&b.1)))
        };
        let found = within(3.0).or_else(|| within(spacing)).or_else(|| within(f64::INFINITY));
        found.map(|((_, share), k)| edges[k][usize::from(share > 0.5)])
    };
    strands.nodes.iter().map(|node| node.root.and_then(nearest)).collect()
}
