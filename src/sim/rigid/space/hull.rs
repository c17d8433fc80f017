//! The corners of what points span in space (quickhull).
//!
//! ```text
//! start      four points that are far from one line and from one plane
//! next       the farthest point that is off some face: it takes the place of all faces that it is off, by new ones to the rim of those
//! corner     a point around which faces look in three directions, not in one or along an edge
//! ```
//!
//! Source: C. B. Barber, D. P. Dobkin and H. Huhdanpaa, ACM Trans. Math. Softw. 22, 469 (1996). Faces in one plane stay triangles.

use super::place::unit;
use crate::sim::vector::{cross3, dot, length, sub};

/// Distance off a face, as a share of the size of all, that is rounding.
const FLAT: f64 = 1e-10;
/// Least part of unit normals around a point across those of two others `[1]`, as the sine of an angle: of less they are in one plane.
const SHARP: f64 = 1e-5;

/// A triangle whose points are anticlockwise from without.
struct Face {
    points: [u32; 3],
    /// The faces beyond its sides: from the first to the second point, and so on.
    beyond: [usize; 3],
    normal: [f64; 3],
    /// Points that are off it, none of which is in the list of another one.
    off: Vec<u32>,
    is_gone: bool,
}

/// The points, ascending, off whose hull no other one is by more than rounding; all of them, where they span no volume.
pub(crate) fn corners_of(places: &[[f64; 3]]) -> Vec<u32> {
    let size = places.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    let Some(start) = start(places, FLAT * size) else { return (0..places.len() as u32).collect() };
    let mut growing = Growing { places, flat: FLAT * size, faces: Vec::new() };
    growing.begin(start);
    growing.grow();
    corners(places.len(), &growing.faces)
}

/// Four points far from each other, the first three anticlockwise as the fourth does not see them; `None`: they are all in one plane.
fn start(places: &[[f64; 3]], flat: f64) -> Option<[u32; 4]> {
    let farthest = |far: &dyn Fn([f64; 3]) -> f64| {
        let all = (0..).zip(places).map(|(k, &x)| (k as u32, far(x)));
        all.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, far)| *far > flat).map(|(k, _)| k)
    };
    let at = |k: u32| places[k as usize];
    let a = farthest(&|x| length(sub(x, *places.first().unwrap_or(&x))))?;
    let b = farthest(&|x| length(sub(x, at(a))))?;
    let along = unit(sub(at(b), at(a)))?;
    let c = farthest(&|x| length(cross3(along, sub(x, at(a)))))?;
    let normal = unit(cross3(along, sub(at(c), at(a))))?;
    let d = farthest(&|x| dot(normal, sub(x, at(a))).abs())?;
    Some(if dot(normal, sub(at(d), at(a))) < 0.0 { [a, b, c, d] } else { [a, c, b, d] })
}

/// A hull of some of the points.
struct Growing<'a> {
    places: &'a [[f64; 3]],
    /// A distance off a face that is none `[m]`.
    flat: f64,
    faces: Vec<Face>,
}

impl Growing<'_> {
    fn at(&self, point: u32) -> [f64; 3] {
        self.places[point as usize]
    }

    /// How far a point is off a face `[m]`; below 0 within.
    fn height(&self, face: &Face, point: u32) -> f64 {
        dot(face.normal, sub(self.at(point), self.at(face.points[0])))
    }

    fn face(&self, points: [u32; 3], beyond: [usize; 3]) -> Face {
        let [a, b, c] = points.map(|point| self.at(point));
        let normal = unit(cross3(sub(b, a), sub(c, a))).unwrap_or([0.0; 3]);
        Face { points, beyond, normal, off: Vec::new(), is_gone: false }
    }

    fn begin(&mut self, [a, b, c, d]: [u32; 4]) {
        let four = [([a, b, c], [1, 2, 3]), ([b, a, d], [0, 3, 2]), ([c, b, d], [0, 1, 3]), ([a, c, d], [0, 2, 1])];
        for (points, beyond) in four {
            let face = self.face(points, beyond);
            self.faces.push(face);
        }
        self.share((0..self.places.len() as u32).filter(|k| ![a, b, c, d].contains(k)).collect(), 0);
    }

    /// Points are noted at the first face, from one on, that they are off.
    fn share(&mut self, points: Vec<u32>, from: usize) {
        for point in points {
            let is_off = |face: &usize| self.height(&self.faces[*face], point) > self.flat;
            if let Some(face) = (from..self.faces.len()).find(is_off) {
                self.faces[face].off.push(point);
            }
        }
    }

    fn grow(&mut self) {
        let mut next = 0;
        while next < self.faces.len() {
            let face = &self.faces[next];
            let by = |a: &&u32, b: &&u32| self.height(face, **a).total_cmp(&self.height(face, **b));
            match face.off.iter().max_by(by).copied() {
                Some(point) if !face.is_gone => self.add(point, next),
                _ => next += 1,
            }
        }
    }

    /// A point that is off a face becomes one of the hull.
    fn add(&mut self, point: u32, from: usize) {
        let mut seen = vec![from];
        self.faces[from].is_gone = true;
        // Sides of faces that are gone, beyond which others stay: their ends, and the face beyond.
        let mut rim: Vec<([u32; 2], usize)> = Vec::new();
        let mut looked = 0;
        while looked < seen.len() {
            let Face { points, beyond, .. } = self.faces[seen[looked]];
            looked += 1;
            for k in 0..3 {
                let other = beyond[k];
                if self.faces[other].is_gone {
                    continue;
                }
                if self.height(&self.faces[other], point) > self.flat {
                    self.faces[other].is_gone = true;
                    seen.push(other);
                } else {
                    rim.push(([points[k], points[(k + 1) % 3]], other));
                }
            }
        }
        let first = self.faces.len();
        let starting: Vec<(u32, usize)> = (first..).zip(&rim).map(|(face, ([a, _], _))| (*a, face)).collect();
        let at = |corner: u32| starting.iter().find(|(a, _)| *a == corner).map_or(first, |(_, face)| *face);
        for (k, &([a, b], other)) in rim.iter().enumerate() {
            let before = rim.iter().position(|([_, end], _)| *end == a).map_or(first, |k| first + k);
            let face = self.face([a, b, point], [other, at(b), before]);
            let side = (0..3).find(|&k| self.faces[other].points[k] == b).unwrap_or(0);
            self.faces[other].beyond[side] = first + k;
            self.faces.push(face);
        }
        let mut loose: Vec<u32> = seen.iter().flat_map(|&face| std::mem::take(&mut self.faces[face].off)).collect();
        loose.retain(|&other| other != point);
        self.share(loose, first);
    }
}

/// The points around which faces look in three directions.
fn corners(count: usize, faces: &[Face]) -> Vec<u32> {
    let mut normals: Vec<Vec<[f64; 3]>> = vec![Vec::new(); count];
    for face in faces.iter().filter(|face| !face.is_gone) {
        face.points.iter().for_each(|&point| normals[point as usize].push(face.normal));
    }
    let is_corner = |around: &[[f64; 3]]| {
        let Some(first) = around.first() else { return false };
        let across = around.iter().map(|&normal| cross3(*first, normal));
        let edge = across.max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b))).filter(|edge| length(*edge) > SHARP);
        edge.and_then(unit).is_some_and(|edge| around.iter().any(|&normal| dot(edge, normal).abs() > SHARP))
    };
    (0..).zip(&normals).filter(|(_, around)| is_corner(around)).map(|(point, _)| point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::vector::scale;

    /// Points of a lattice of so many by so many, all turned.
    fn lattice(sides: [i32; 3]) -> Vec<[f64; 3]> {
        let (c, s) = (libm::cos(0.7), libm::sin(0.7));
        let mut list = Vec::new();
        for x in 0..sides[0] {
            for y in 0..sides[1] {
                for z in 0..sides[2] {
                    let [x, y, z] = [x, y, z].map(|k| 0.1 * f64::from(k) - 0.2);
                    let [y, z] = [c * y - s * z, s * y + c * z];
                    list.push([c * x - s * y, s * x + c * y, z]);
                }
            }
        }
        list
    }

    #[test]
    fn a_lattice_has_the_eight_corners_of_its_box() {
        for sides in [[2, 2, 2], [5, 4, 3], [12, 12, 12], [2, 30, 2]] {
            let places = lattice(sides);
            let found = corners_of(&places);
            let number = |[x, y, z]: [i32; 3]| ((x * sides[1] + y) * sides[2] + z) as u32;
            let end = |k: i32, axis: usize, bit: i32| if k & bit == 0 { 0 } else { sides[axis] - 1 };
            let expected: Vec<u32> = (0..8).map(|k| number([end(k, 0, 4), end(k, 1, 2), end(k, 2, 1)])).collect();
            assert_eq!(found, expected, "{sides:?}");
        }
    }

    #[test]
    fn no_point_is_off_what_corners_span_and_each_corner_is_needed() {
        // Points of a ball by a sequence of Halton's, the first of them on it: those are the corners.
        let halton = |mut k: u32, base: u32| {
            let (mut share, mut sum) = (1.0, 0.0);
            while k > 0 {
                share /= f64::from(base);
                sum += share * f64::from(k % base);
                k /= base;
            }
            sum
        };
        let place = |k: u32| {
            let (height, angle) = (2.0 * halton(k, 2) - 1.0, 6.3 * halton(k, 3));
            let wide = (1.0 - height * height).sqrt();
            let on = [wide * libm::cos(angle), wide * libm::sin(angle), height];
            scale(on, if k <= 1000 { 1.0 } else { 0.9 * halton(k, 5) })
        };
        let places: Vec<[f64; 3]> = (1..=3000).map(place).collect();
        assert_eq!(corners_of(&places), (0..1000).collect::<Vec<u32>>());
    }

    #[test]
    fn of_what_spans_no_volume_all_points_are_corners() {
        let flat: Vec<[f64; 3]> = (0..9).map(|k| [f64::from(k % 3), f64::from(k / 3), 0.0]).collect();
        assert_eq!(corners_of(&flat).len(), 9);
        assert_eq!(corners_of(&flat[..1]), [0]);
        assert!(corners_of(&[]).is_empty());
    }
}
