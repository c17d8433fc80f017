//! Cells of nets: what bonds enclose where no triangles are, by the bonds alone, so that a net that is crumpled has the cells that it
//! has when it is spread, and what is torn is open.
//!
//! ```text
//! triangle   three points, each bonded to both others; of those that cover each other by their lengths at rest the smallest count
//! quad       four points in a ring without a diagonal, none of whose sides is one of a triangle: beside triangles it is a hole
//! torn quad  four points in a ring whose diagonal tore: what tears first is a brace, and the mesh about it is whole
//! tangle     a net with a bond that would have three cells is no surface, and has none
//! ```

use crate::picture::Tint;
use crate::sim::bond::lower_first;
use crate::sim::{Bond, Bonds, Limit};

/// Bonds of a point from which on it is a corner of no quad: those of nets have few.
const MOST_AT_A_POINT: usize = 16;
/// Sides of a quad are shorter at rest than this share of its diagonal: those of a square are 0.71 of it.
const SHORTER: f64 = 0.95;
/// Area of a triangle by the square of its longest side, below which it is three points in a row with a brace rather than a cell `[1]`:
/// an equilateral one has 0.43, one of a wheel of 16 spokes 0.19, three neighbours on its rim 0.05.
const SLIMMEST: f64 = 0.08;

/// The cells of a net of bonds: triangles, and quads as two of them each, by their points; and which of the bonds that tore left it open.
///
/// Shapes: `is_bare` says of each point whether it may be a corner.
pub(super) fn cells<'a>((bonds, torn): (&Bonds, &'a [Bond]), is_bare: &[bool]) -> (Vec<[u32; 3]>, Vec<&'a Bond>) {
    let mut net = Net::new(bonds, is_bare);
    if net.sides.len() < 3 {
        return Default::default();
    }
    net.take_triangles();
    net.take_quads();
    let may_be = |end: u32| is_bare.get(end as usize) == Some(&true);
    let torn = torn.iter().filter(|bond| may_be(bond.a.0) && may_be(bond.b.0));
    let open = torn.filter(|bond| !net.take_torn(bond)).collect();
    let hangs_on = Tint::hanging(is_bare.len(), net.sides.iter().map(|side| side.ends));
    let mut tangled: Vec<u32> = net.crowded.iter().map(|point| hangs_on[*point as usize]).collect();
    tangled.sort_unstable();
    let is_surface = |corners: &[u32; 3]| tangled.binary_search(&hangs_on[corners[0] as usize]).is_err();
    net.cells.retain(is_surface);
    (net.cells, open)
}

/// A bond that may be the side of a cell.
struct Side {
    ends: [u32; 2],
    /// Its length at rest `[m]`.
    rest: f64,
    /// The third corners of the cells that it has.
    beside: Vec<u32>,
}

/// A net, with the cells that were found in it.
struct Net {
    /// Sides in the order of their ends, the lower of which comes first.
    sides: Vec<Side>,
    /// Where the neighbours of each point begin, and those, ascending, each with the place of the side to it.
    starts: Vec<usize>,
    neighbors: Vec<(u32, u32)>,
    cells: Vec<[u32; 3]>,
    /// Points at bonds that would have three cells.
    crowded: Vec<u32>,
}

impl Net {
    fn new(bonds: &Bonds, is_bare: &[bool]) -> Self {
        let may_be = |point: u32| is_bare.get(point as usize) == Some(&true);
        // What only pushes lies between points that nothing holds together.
        let held = bonds.iter().filter(|bond| bond.limit != Limit::Min && bond.rest_length > 0.0 && bond.a != bond.b);
        let side = |a: u32, b: u32, rest| Side { ends: lower_first([a, b]), rest, beside: Vec::new() };
        let mut sides: Vec<Side> = held
            .filter(|bond| may_be(bond.a.0) && may_be(bond.b.0))
            .map(|bond| side(bond.a.0, bond.b.0, bond.rest_length))
            .collect();
        sides.sort_by_key(|side| side.ends);
        sides.dedup_by_key(|side| side.ends);
        let mut ways: Vec<(u32, u32, u32)> = (0..)
            .zip(&sides)
            .flat_map(|(place, Side { ends: [a, b], .. })| [(*a, *b, place), (*b, *a, place)])
            .collect();
        ways.sort_unstable();
        let mut starts = vec![0; is_bare.len() + 1];
        ways.iter().for_each(|(from, ..)| starts[*from as usize + 1] += 1);
        (1..starts.len()).for_each(|point| starts[point] += starts[point - 1]);
        let neighbors = ways.iter().map(|(_, to, place)| (*to, *place)).collect();
        Net { sides, starts, neighbors, cells: Vec::new(), crowded: Vec::new() }
    }

    fn neighbors(&self, point: u32) -> &[(u32, u32)] {
        &self.neighbors[self.starts[point as usize]..self.starts[point as usize + 1]]
    }

    /// The place of the bond between two points.
    fn side(&self, a: u32, b: u32) -> Option<usize> {
        let [(few, to), (many, from)] = [(self.neighbors(a), b), (self.neighbors(b), a)];
        let (list, wanted) = if few.len() < many.len() { (few, to) } else { (many, from) };
        list.binary_search_by_key(&wanted, |(to, _)| *to).ok().map(|at| list[at].1 as usize)
    }

    /// Takes the triangles of bonds, smaller ones first.
    fn take_triangles(&mut self) {
        let mut found: Vec<(f64, [u32; 3])> = Vec::new();
        for (place, side) in self.sides.iter().enumerate() {
            let [a, b] = side.ends;
            let [one, other] = side.ends.map(|end| self.neighbors(end));
            let few = if one.len() < other.len() { one } else { other };
            // Each triangle is met at its first side, whose third corner comes last.
            let third = few.iter().map(|(corner, _)| *corner).filter(|corner| *corner > b);
            found.extend(third.filter_map(|corner| Some((self.area(place, corner)?, [a, b, corner]))));
        }
        found.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
        for (_, corners) in found {
            self.take(corners);
        }
    }

    /// Lengths at rest between the ends of a side and a point `[m]`; `None`: it is not bonded to both.
    fn rests(&self, place: usize, corner: u32) -> Option<[f64; 2]> {
        let [a, b] = self.sides[place].ends;
        Some([self.sides[self.side(a, corner)?].rest, self.sides[self.side(b, corner)?].rest])
    }

    /// The area of a triangle at rest `[m²]`; `None`: it is none, or too slim for a cell.
    fn area(&self, place: usize, corner: u32) -> Option<f64> {
        let (base, [from_a, from_b]) = (self.sides[place].rest, self.rests(place, corner)?);
        let area = 0.5 * base * apex(base, [from_a, from_b])[1];
        let longest = base.max(from_a).max(from_b);
        (area > SLIMMEST * longest * longest).then_some(area)
    }

    /// Takes a triangle, unless one that is there covers some of it, or a bond has two cells without it.
    fn take(&mut self, [a, b, c]: [u32; 3]) {
        let sides = [([a, b], c), ([b, c], a), ([c, a], b)];
        let sides = sides.map(|([from, to], third)| self.side(from, to).map(|place| (place, third)));
        let [Some(first), Some(second), Some(last)] = sides else { return };
        let sides = [first, second, last];
        let covers = |(place, third): &(usize, u32)| {
            self.sides[*place].beside.iter().any(|&other| self.is_on_one_side(*place, [other, *third]))
        };
        if !sides.iter().any(covers) && self.take_sides(&sides, a) {
            self.cells.push([a, b, c]);
        }
    }

    /// Gives sides a cell more, with these third corners; where one has two, `corner` is at a bond that would have three.
    fn take_sides(&mut self, sides: &[(usize, u32)], corner: u32) -> bool {
        let has_room = sides.iter().all(|(place, _)| self.sides[*place].beside.len() < 2);
        match has_room {
            true => sides.iter().for_each(|(place, third)| self.sides[*place].beside.push(*third)),
            false => self.crowded.push(corner),
        }
        has_room
    }

    /// Whether two points that are bonded to both ends of a side lie on one side of it, by the length of the bond between them.
    fn is_on_one_side(&self, place: usize, [p, q]: [u32; 2]) -> bool {
        let base = self.sides[place].rest;
        let (Some(between), Some(of_p), Some(of_q)) = (self.side(p, q), self.rests(place, p), self.rests(place, q))
        else {
            return false;
        };
        let ([x, y], [u, v]) = (apex(base, of_p), apex(base, of_q));
        let rest = self.sides[between].rest;
        ((x - u).hypot(y - v) - rest).abs() < ((x - u).hypot(y + v) - rest).abs()
    }

    /// Takes the rings of four bonds that have no diagonal and no triangle beside them.
    fn take_quads(&mut self) {
        let found = self.rings();
        for [a, b, c, d] in found {
            let sides = [([a, b], c), ([b, c], d), ([c, d], a), ([d, a], b)];
            let sides: Vec<(usize, u32)> =
                sides.iter().filter_map(|&([from, to], third)| Some((self.side(from, to)?, third))).collect();
            if self.take_sides(&sides, a) {
                self.cells.extend([[a, b, c], [a, c, d]]);
            }
        }
    }

    /// Takes the ring of four bonds whose diagonal tore, if there is one and only one: each of its sides is shorter at rest than that was, as those
    /// of two triangles of two quads are not.
    fn take_torn(&mut self, torn: &Bond) -> bool {
        let [a, c] = [torn.a.0, torn.b.0];
        let is_short = |&&(_, place): &&(u32, u32)| self.sides[place as usize].rest < SHORTER * torn.rest_length;
        let short = |from: u32| self.neighbors(from).iter().filter(is_short).map(|(to, _)| *to);
        let both: Vec<u32> = short(a).filter(|to| short(c).any(|other| other == *to)).take(3).collect();
        let &[b, d] = &both[..] else { return false };
        if self.side(a, c).is_some() || self.side(b, d).is_some() {
            return true;
        }
        let sides = [([a, b], c), ([b, c], d), ([c, d], a), ([d, a], b)];
        let sides: Vec<(usize, u32)> =
            sides.iter().filter_map(|&([from, to], third)| Some((self.side(from, to)?, third))).collect();
        let is_of_it = |third: &u32| [a, b, c, d].contains(third);
        if sides.iter().all(|(place, _)| self.sides[*place].beside.iter().any(is_of_it)) {
            return true;
        }
        // Of a net that is torn a side with two cells already is no fault.
        let has_room = sides.iter().all(|(place, _)| self.sides[*place].beside.len() < 2);
        if has_room && self.take_sides(&sides, a) {
            self.cells.extend([[a, b, c], [a, c, d]]);
        }
        has_room
    }

    /// Rings of four bonds without a diagonal and without triangles beside them, each once.
    fn rings(&self) -> Vec<[u32; 4]> {
        // Pairs of points with a neighbour that both have: two such neighbours close a ring.
        let mut wedges: Vec<([u32; 2], u32)> = Vec::new();
        let is_free = |(to, place): &(u32, u32)| self.sides[*place as usize].beside.is_empty().then_some(*to);
        for middle in 0..self.starts.len() as u32 - 1 {
            let around: Vec<u32> =
                self.neighbors(middle).iter().filter_map(is_free).take(MOST_AT_A_POINT + 1).collect();
            if around.len() > MOST_AT_A_POINT {
                continue;
            }
            for (place, &from) in around.iter().enumerate() {
                wedges.extend(around[place + 1..].iter().map(|&to| ([from, to], middle)));
            }
        }
        wedges.sort_unstable();
        let mut found = Vec::new();
        for same in wedges.chunk_by(|p, q| p.0 == q.0) {
            let [a, c] = same[0].0;
            for (place, &(_, b)) in same.iter().enumerate() {
                // Each ring is met at both of its diagonals.
                let rings = same[place + 1..].iter().map(|&(_, d)| [a, b, c, d]).filter(|[a, b, ..]| a < b);
                found.extend(rings.filter(|&[a, b, c, d]| self.side(a, c).is_none() && self.side(b, d).is_none()));
            }
        }
        found.sort_unstable();
        found
    }
}

/// Where a point lies that is so far from both ends of a base of this length: along it from its first end, and above it `[m]`.
fn apex(base: f64, [from_first, from_second]: [f64; 2]) -> [f64; 2] {
    let along = (from_first * from_first - from_second * from_second + base * base) / (2.0 * base);
    [along, (from_first * from_first - along * along).max(0.0).sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{Bond, PointId};

    /// Bonds between places, as long as these are apart.
    fn net(places: &[[f64; 2]], ends: &[[u32; 2]]) -> Bonds {
        let rest = |a: u32, b: u32| {
            let ([x, y], [u, v]) = (places[a as usize], places[b as usize]);
            (x - u).hypot(y - v)
        };
        ends.iter().map(|&[a, b]| Bond::new(PointId(a), PointId(b), rest(a, b))).collect()
    }

    fn found(places: &[[f64; 2]], ends: &[[u32; 2]]) -> Vec<[u32; 3]> {
        cells((&net(places, ends), &[]), &vec![true; places.len()]).0
    }

    /// Places of a grid so many points wide and high, 1 m apart, and the bonds between neighbours.
    fn grid(wide: u32, high: u32) -> (Vec<[f64; 2]>, Vec<[u32; 2]>) {
        let places = (0..wide * high).map(|k| [f64::from(k % wide), f64::from(k / wide)]).collect();
        let right = (0..wide * high).filter(|k| k % wide + 1 < wide).map(|k| [k, k + 1]);
        let up = (0..wide * (high - 1)).map(|k| [k, k + wide]);
        (places, right.chain(up).collect())
    }

    fn area(places: &[[f64; 2]], cells: &[[u32; 3]]) -> f64 {
        let of = |corners: &[u32; 3]| {
            let [[x, y], [u, v], [s, t]] = corners.map(|corner| places[corner as usize]);
            0.5 * ((u - x) * (t - y) - (s - x) * (v - y)).abs()
        };
        cells.iter().map(of).sum()
    }

    #[test]
    fn a_net_has_its_meshes_and_where_a_thread_tore_it_is_open() {
        let (places, mut ends) = grid(5, 4);
        assert_eq!(found(&places, &ends).len(), 2 * 12);
        assert!((area(&places, &found(&places, &ends)) - 12.0).abs() < 1e-12);
        // Between two meshes.
        ends.retain(|ends| *ends != [6, 7]);
        assert!((area(&places, &found(&places, &ends)) - 10.0).abs() < 1e-12, "both meshes beside it are one hole");
    }

    #[test]
    fn what_tore_between_triangles_is_open_although_four_bonds_are_around_it() {
        let (places, mut ends) = grid(4, 4);
        ends.extend((0..9).map(|k| [k / 3 * 4 + k % 3, k / 3 * 4 + k % 3 + 5]));
        assert_eq!(found(&places, &ends).len(), 18);
        for torn in [[5, 10], [5, 6]] {
            let left: Vec<[u32; 2]> = ends.iter().copied().filter(|ends| *ends != torn).collect();
            assert_eq!(found(&places, &left).len(), 16, "{torn:?}");
        }
    }

    #[test]
    fn a_mesh_whose_brace_tore_is_whole_and_one_that_lost_a_side_is_open() {
        let (places, mut ends) = grid(4, 4);
        ends.extend((0..9).map(|k| [k / 3 * 4 + k % 3, k / 3 * 4 + k % 3 + 5]));
        for (gone, count) in [([5, 10], 18), ([5, 6], 16)] {
            let (torn, left): (Vec<[u32; 2]>, Vec<[u32; 2]>) = ends.iter().copied().partition(|ends| *ends == gone);
            let torn: Vec<Bond> = net(&places, &torn).iter().collect();
            let (cells, open) = cells((&net(&places, &left), &torn), &[true; 16]);
            assert_eq!((cells.len(), open.len()), (count, usize::from(count < 18)), "{gone:?}");
        }
        let (places, ends) = grid(2, 2);
        let torn: Vec<Bond> = net(&places, &[[0, 3]]).iter().collect();
        let (alone, open) = cells((&net(&places, &ends), &torn), &[true; 4]);
        assert_eq!((alone.len(), open.len()), (2, 0), "a mesh alone is filled once");
    }

    #[test]
    fn of_triangles_that_cover_each_other_the_smallest_count() {
        // Squares with both diagonals: each is covered once.
        let (places, mut ends) = grid(3, 2);
        ends.extend([[0, 4], [1, 3], [1, 5], [2, 4]]);
        assert!((area(&places, &found(&places, &ends)) - 2.0).abs() < 1e-12);
        // A triangle about a point.
        let places = [[0.0, 0.0], [3.0, 0.0], [0.0, 3.0], [1.0, 1.0]];
        let cells = found(&places, &[[0, 1], [1, 2], [2, 0], [3, 0], [3, 1], [3, 2]]);
        assert!(cells.len() == 3 && (area(&places, &cells) - 4.5).abs() < 1e-12, "{cells:?}");
        // A wheel whose rim has braces, and four spokes in a square.
        let mut places: Vec<[f64; 2]> =
            (0..16).map(|k| (f64::from(k) * std::f64::consts::TAU / 16.0).sin_cos().into()).collect();
        places.push([0.0; 2]);
        let ends: Vec<[u32; 2]> = (0..16).flat_map(|k| [[k, (k + 1) % 16], [k, (k + 2) % 16], [k, 16]]).collect();
        let whole = 8.0 * (std::f64::consts::TAU / 16.0).sin();
        assert!((area(&places, &found(&places, &ends)) - whole).abs() < 1e-12);
        let places = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [0.0, 0.0]];
        let cells = found(&places, &[[0, 1], [1, 2], [2, 3], [3, 0], [4, 0], [4, 1], [4, 2], [4, 3]]);
        assert!((area(&places, &cells) - 2.0).abs() < 1e-12, "not the square about them too: {cells:?}");
    }

    #[test]
    fn ropes_rings_and_tangles_have_none() {
        let row: Vec<[f64; 2]> = (0..6).map(|k| [f64::from(k), 0.0]).collect();
        assert!(found(&row, &[[0, 1], [1, 2], [2, 3], [3, 4], [4, 5]]).is_empty());
        let ring: Vec<[f64; 2]> = (0..6).map(|k| f64::from(k).sin_cos().into()).collect();
        assert!(found(&ring, &[[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 0]]).is_empty());
        // Three pages at one bond, and a square beside it that is none of them.
        let book = [
            [0.0, 0.0],
            [0.0, 1.0],
            [1.0, 0.5],
            [1.2, 0.5],
            [-1.0, 0.5],
            [5.0, 0.0],
            [6.0, 0.0],
            [6.0, 1.0],
            [5.0, 1.0],
        ];
        let pages = [[0, 1], [0, 2], [1, 2], [0, 3], [1, 3], [0, 4], [1, 4]];
        let square = [[5, 6], [6, 7], [7, 8], [8, 5]];
        assert_eq!(found(&book, &[&pages[..], &square].concat()), [[5, 6, 7], [5, 7, 8]]);
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let bonds = net(&corners, &[[0, 1], [1, 2], [2, 0]]);
        assert_eq!(cells((&bonds, &[]), &[true; 3]).0, [[0, 1, 2]]);
        assert!(cells((&bonds, &[]), &[true, false, true]).0.is_empty(), "what is covered otherwise");
        assert!(cells((&Bonds::default(), &[]), &[]).0.is_empty());
    }
}
