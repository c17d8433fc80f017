//! Points are laid out one after the other, as rigid bonds hold them in space.
//!
//! ```text
//! triangle   three points with three bonds between them
//! next       a point that three bonds hold to points which are laid out, not in one plane with them
//! ```
//!
//! What is laid out so is rigid by its rank: each new point adds three unknowns and three bonds that are independent at the start's places.

use crate::sim::rigid::shape::LEAST_HEIGHT;
use crate::sim::vector::{add, cross3, dot, length, scale, sub};

/// Triangles that one point is tried with.
const MOST_SEEDS: usize = 8;
/// Rounds in which all that is left is tried once more.
const LAST_ROUNDS: u32 = 8;
/// Rounds in which a place is fitted to all bonds that it has.
const ROUNDS: u32 = 2;
/// Bonds of a point among which the three are looked for that hold it best.
const MOST_AMONG: usize = 12;

/// Points as a shape is found from them: where they are now `[m]`, masses `[kg]`, infinite where they are pinned, and the rigid bonds between them
/// with their lengths `[m]`.
pub(crate) struct Held {
    pub(crate) now: Vec<[f64; 3]>,
    pub(crate) masses: Vec<f64>,
    /// Points in the order of the lists above.
    pub(crate) bonds: Vec<([u32; 2], f64)>,
}

impl Held {
    /// Share of its length by which a bond is off at these places.
    pub(super) fn misfit(&self, places: &[[f64; 3]]) -> f64 {
        let off = |&([a, b], rest): &([u32; 2], f64)| {
            let far = length(sub(places[a as usize], places[b as usize]));
            (far - rest).abs() / rest
        };
        // NaN fits nowhere.
        self.bonds.iter().map(off).fold(0.0, |most: f64, off| if off <= most { most } else { off })
    }
}

/// Bonds by the points that they are at.
pub(super) struct Net<'a> {
    now: &'a [[f64; 3]],
    /// A point, another one and how far that is `[m]`.
    spokes: Vec<(u32, u32, f64)>,
    /// Where those of each point begin.
    starts: Vec<usize>,
}

impl<'a> Net<'a> {
    pub(super) fn new(held: &'a Held) -> Self {
        let both = |&([a, b], rest): &([u32; 2], f64)| [(a, b, rest), (b, a, rest)];
        let mut spokes: Vec<(u32, u32, f64)> = held.bonds.iter().flat_map(both).collect();
        spokes.sort_by_key(|spoke| (spoke.0, spoke.1));
        let starts = (0..=held.now.len() as u32).map(|point| spokes.partition_point(|spoke| spoke.0 < point)).collect();
        Net { now: &held.now, spokes, starts }
    }

    fn of(&self, point: u32) -> &[(u32, u32, f64)] {
        &self.spokes[self.starts[point as usize]..self.starts[point as usize + 1]]
    }

    /// Where all points are, each held by three others; `None`: some of them are not. Linear in the bonds.
    pub(super) fn laid_out(&self) -> Option<Vec<[f64; 3]>> {
        let seeds = self.of(0).iter().flat_map(|&(a, b, ab)| {
            let third = move |&(_, c, ac): &(u32, u32, f64)| {
                let bc = self.of(b).iter().find(|spoke| spoke.1 == c)?.2;
                (c > b).then_some(([a, b, c], [ab, ac, bc]))
            };
            self.of(a).iter().filter_map(third)
        });
        seeds.take(MOST_SEEDS).find_map(|(points, sides)| {
            let mut places = vec![None; self.now.len()];
            for (point, place) in points.into_iter().zip(triangle(sides)?) {
                places[point as usize] = Some(place);
            }
            self.grow(points.to_vec(), &mut places);
            places.into_iter().collect()
        })
    }

    /// Lays points out from these on, as far as three bonds each hold them. Those with many bonds are tried again when twice as many of the others
    /// are laid out, and at last.
    fn grow(&self, mut list: Vec<u32>, places: &mut [Option<[f64; 3]>]) {
        let (mut seen, mut due) = (vec![0; places.len()], vec![3; places.len()]);
        let mut next = 0;
        for _ in 0..LAST_ROUNDS {
            while let Some(&point) = list.get(next) {
                next += 1;
                for &(_, q, _) in self.of(point) {
                    let at = q as usize;
                    seen[at] += 1;
                    if places[at].is_some() || seen[at] < due[at] {
                        continue;
                    }
                    places[at] = self.place(q, places);
                    list.extend(places[at].map(|_| q));
                    due[at] = if seen[at] < MOST_AMONG { seen[at] + 1 } else { 2 * seen[at] };
                }
            }
            let laid = list.len();
            for q in 0..places.len() as u32 {
                if places[q as usize].is_none() && seen[q as usize] > 2 {
                    places[q as usize] = self.place(q, places);
                    list.extend(places[q as usize].map(|_| q));
                }
            }
            if list.len() == laid {
                break;
            }
        }
    }

    /// The place of a point by the three bonds that hold it best, then by all: of three alone rounding piles up from point to point.
    fn place(&self, q: u32, places: &[Option<[f64; 3]>]) -> Option<[f64; 3]> {
        let laid = self.of(q).iter().filter_map(|&(_, other, rest)| Some((other, places[other as usize]?, rest)));
        let all: Vec<(u32, [f64; 3], f64)> = laid.collect();
        // Of many those that follow on each other are likely to lie in one plane.
        let count = all.len().min(MOST_AMONG);
        let laid: Vec<(u32, [f64; 3], f64)> = (0..count).map(|k| all[k * all.len() / count]).collect();
        let now = |i: u32| self.now[i as usize];
        let mut best: Option<(f64, [f64; 3])> = None;
        for (k, &a) in laid.iter().enumerate() {
            for (l, &b) in laid.iter().enumerate().skip(k + 1) {
                for &c in &laid[l + 1..] {
                    let across = cross3(sub(now(b.0), now(a.0)), sub(now(c.0), now(a.0)));
                    let side = dot(across, sub(now(q), now(a.0)));
                    let found = fourth([(a.1, a.2), (b.1, b.2), (c.1, c.2)], side);
                    best = match (best, found) {
                        (Some(best), Some(found)) if found.0 > best.0 => Some(found),
                        (None, found) => found,
                        (best, _) => best,
                    };
                }
            }
        }
        best.map(|(_, place)| nearest(place, &laid))
    }
}

/// The place with the least sum of (|d| - rest)^2 to others, from one beside it on (Gauss and Newton's method).
fn nearest(mut x: [f64; 3], laid: &[(u32, [f64; 3], f64)]) -> [f64; 3] {
    for _ in 0..ROUNDS {
        let (mut normal, mut pull) = ([[0.0; 3]; 3], [0.0; 3]);
        for &(_, place, rest) in laid {
            let d = sub(x, place);
            let far = length(d);
            let way = scale(d, 1.0 / far);
            (0..3).for_each(|k| normal[k] = add(normal[k], scale(way, way[k])));
            pull = add(pull, scale(way, rest - far));
        }
        let [p, q, r] = normal;
        let solved = [cross3(q, r), cross3(r, p), cross3(p, q)].map(|row| dot(row, pull));
        x = add(x, scale(solved, 1.0 / dot(p, cross3(q, r))));
    }
    x
}

/// The corners of a triangle with sides from the first to the second, to the third, and between those; `None`: it is hardly one.
fn triangle([ab, ac, bc]: [f64; 3]) -> Option<[[f64; 3]; 3]> {
    let along = (ab * ab + ac * ac - bc * bc) / (2.0 * ab);
    let height = ac * ac - along * along;
    let least = LEAST_HEIGHT * ac;
    // NaN is none.
    (height > least * least).then(|| [[0.0; 3], [ab, 0.0, 0.0], [along, height.sqrt(), 0.0]])
}

/// The place at these distances from three others, on the side of their triangle from which they go round anticlockwise where `side` > 0, and how
/// well they hold it `[1]`; `None`: there is none, or hardly beside their plane.
fn fourth([(a, to_a), (b, to_b), (c, to_c)]: [([f64; 3], f64); 3], side: f64) -> Option<(f64, [f64; 3])> {
    let (u, v) = (sub(b, a), sub(c, a));
    let d = length(u);
    let x_way = scale(u, 1.0 / d);
    let i = dot(x_way, v);
    let w = sub(v, scale(x_way, i));
    let j = length(w);
    let y_way = scale(w, 1.0 / j);
    let x = (to_a * to_a - to_b * to_b + d * d) / (2.0 * d);
    let y = (to_a * to_a - to_c * to_c + i * i + j * j - 2.0 * i * x) / (2.0 * j);
    let square = to_a * to_a - x * x - y * y;
    let least = LEAST_HEIGHT * to_a;
    let is_beside = square > least * least && j > LEAST_HEIGHT * length(v);
    if !is_beside || side == 0.0 {
        return None;
    }
    let height = square.sqrt();
    let out = scale(cross3(x_way, y_way), side.signum() * height);
    let place = add(a, add(add(scale(x_way, x), scale(y_way, y)), out));
    Some(((height / to_a).min(j / length(v)), place))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Points of 1 kg with the bonds between these ends, as long as they are apart.
    pub(in crate::sim::rigid::space) fn held(now: &[[f64; 3]], ends: &[[u32; 2]]) -> Held {
        let bond = |&[a, b]: &[u32; 2]| ([a, b], length(sub(now[a as usize], now[b as usize])));
        Held { now: now.to_vec(), masses: vec![1.0; now.len()], bonds: ends.iter().map(bond).collect() }
    }

    pub(in crate::sim::rigid::space) const TETRAHEDRON: [[f64; 3]; 4] =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 1.1, 0.0], [0.4, 0.3, 0.9]];
    pub(in crate::sim::rigid::space) const SIX: [[u32; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

    fn is_whole(now: &[[f64; 3]], ends: &[[u32; 2]]) -> bool {
        let held = held(now, ends);
        let laid = Net::new(&held).laid_out();
        laid.is_some_and(|places| held.misfit(&places) < 1e-12)
    }

    #[test]
    fn tetrahedra_that_share_a_face_are_one_and_triangles_on_a_side_are_a_hinge() {
        assert!(is_whole(&TETRAHEDRON, &SIX));
        assert!(!is_whole(&TETRAHEDRON, &SIX[..5]), "two triangles on a side");
        let five = [&TETRAHEDRON[..], &[[0.5, 0.4, -1.0]]].concat();
        assert!(is_whole(&five, &[&SIX[..], &[[0, 4], [1, 4], [2, 4]]].concat()));
        assert!(!is_whole(&five, &[&SIX[..], &[[0, 4], [1, 4]]].concat()), "a triangle hangs on a side");
    }

    #[test]
    fn a_hull_with_many_bonds_at_each_point_is_whole() {
        let ring = |z: f64| {
            (0..40).map(move |k| {
                let turn = 0.05 * std::f64::consts::PI * f64::from(k);
                [libm::cos(turn), libm::sin(turn), z]
            })
        };
        let now: Vec<[f64; 3]> = ring(0.0).chain(ring(0.5)).collect();
        let ends: Vec<[u32; 2]> = (0..80).flat_map(|a| (a + 1..80).map(move |b| [a, b])).collect();
        assert!(is_whole(&now, &ends));
    }

    #[test]
    fn rounding_does_not_pile_up_in_a_large_lattice() {
        let count = 14_i32;
        let all = || (0..count).flat_map(|i| (0..count).flat_map(move |j| (0..count).map(move |k| [i, j, k])));
        let at = |[i, j, k]: [i32; 3]| ((i * count + j) * count + k) as u32;
        let ways =
            [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, 0, 1], [0, 1, 1], [1, -1, 0], [1, 0, -1], [0, 1, -1]];
        let ends = all().flat_map(|from| ways.map(|way| [from, std::array::from_fn(|k| from[k] + way[k])]));
        let is_within = |ends: &[[i32; 3]; 2]| ends[1].iter().all(|k| (0..count).contains(k));
        let ends: Vec<[u32; 2]> = ends.filter(is_within).map(|ends| ends.map(at)).collect();
        let now: Vec<[f64; 3]> = all().map(|place| place.map(|k| 0.1 * f64::from(k))).collect();
        let held = held(&now, &ends);
        let off = Net::new(&held).laid_out().map(|places| held.misfit(&places));
        assert!(off.is_some_and(|off| off < 1e-13), "{off:?}");
    }

    #[test]
    fn what_lies_in_one_plane_is_not_held_in_it() {
        let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 1.1, 0.0], [0.5, 0.4, 0.0]];
        assert!(!is_whole(&flat, &SIX));
    }
}
