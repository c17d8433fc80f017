//! Figures of limbs, such as ragdolls: what their pieces look like. Each piece that bonds hold in its shape is drawn as round strokes
//! that follow its points and meet in its joints, so that limbs bend without corners.
//!
//! ```text
//! behind   the first limb at each joint of the torso, darker
//! head     a disc on a neck, which goes down to its joint
//! torso    a round stroke from its upper points to its lower ones
//! front    the other limbs, brighter
//! ```

use super::outline::{Side, outline};
use super::pieces::pieces;

/// A stroke with round ends, each at a share of the way between two points, with radii `[m]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cone {
    pub(super) ends: [[u32; 2]; 2],
    pub(super) shares: [f32; 2],
    pub(super) radii: [f32; 2],
}

impl Cone {
    /// Along a side, equally wide.
    fn side(side: &Side, radius: f32) -> Self {
        Cone { ends: [[side.a; 2], [side.b; 2]], shares: [0.0; 2], radii: [radius; 2] }
    }
}

/// What a part of a figure is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// All of it: nothing tells one part from another, and what is covered is drawn too.
    Whole,
    /// A limb behind the torso.
    Behind,
    Head,
    Torso,
    /// A limb in front of it.
    Front,
    /// The end of a limb in front or behind, such as a hand.
    End(bool),
}

/// Strokes with one rim around all of them, over the parts before it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    pub(super) role: Role,
    pub(super) cones: Vec<Cone>,
    /// A triangle that it is of, for its colour.
    pub(super) of: [u32; 3],
}

/// Flesh beyond the sides of pieces that no figure is recognised in, as a share of twice the area of the slenderest one by its
/// circumference `[1]`: so they have round corners that meet in their joints.
const FLESH_SHARE: f64 = 0.65;
/// Widest angle of a limb at the joint that it hangs from `[rad]`: corners of boxes are no limbs.
const WIDEST: f64 = 1.3;
/// Radii of a limb where it hangs and at its other joint, and of the last one at its end, in half its greatest width `[1]`.
const UPPER: [f64; 2] = [0.95, 0.7];
const END: f64 = 0.6;
/// Radius of what a limb ends in, likewise `[1]`.
const HAND: f64 = 0.9;
/// Of a neck, in that of the head `[1]`.
const NECK: f64 = 0.42;

/// A piece with the points that it shares with others.
struct Piece {
    points: Vec<u32>,
    joints: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    area: f64,
}

/// What a figure with joints looks like, its parts from behind to the front; `None`: it is one piece.
pub(super) fn figure(triangles: &[[u32; 3]], at: &dyn Fn(u32) -> [f64; 2]) -> Option<Vec<Part>> {
    let pieces = pieces(triangles);
    if pieces.len() < 2 {
        return None;
    }
    Figure { pieces: found(pieces, at), at }.parts().or_else(|| plain(triangles, at).map(|part| vec![part]))
}

/// Pieces with their joints.
fn found(pieces: Vec<Vec<[u32; 3]>>, at: &dyn Fn(u32) -> [f64; 2]) -> Vec<Piece> {
    let points_of = |triangles: &[[u32; 3]]| {
        let mut points: Vec<u32> = triangles.iter().flatten().copied().collect();
        points.sort_unstable();
        points.dedup();
        points
    };
    let mut all: Vec<u32> = pieces.iter().flat_map(|triangles| points_of(triangles)).collect();
    all.sort_unstable();
    let is_shared = |point: &u32| {
        let place = all.partition_point(|other| other < point);
        all.get(place + 1) == Some(point)
    };
    let piece = |triangles: Vec<[u32; 3]>| {
        let points = points_of(&triangles);
        let joints = points.iter().copied().filter(is_shared).collect();
        let area = triangles.iter().map(|corners| area(corners.map(at))).sum();
        Piece { points, joints, triangles, area }
    };
    pieces.into_iter().map(piece).collect()
}

fn area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    0.5 * cross(sub(b, a), sub(c, a)).abs()
}

fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn long(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}

/// Flesh about all sides of pieces, equally wide.
fn plain(triangles: &[[u32; 3]], at: &dyn Fn(u32) -> [f64; 2]) -> Option<Part> {
    let length = |side: &Side| long(sub(at(side.b), at(side.a)));
    let thin = pieces(triangles).into_iter().map(|triangles| {
        let area: f64 = triangles.iter().map(|corners| area(corners.map(at))).sum();
        2.0 * area / outline(&triangles).iter().map(length).sum::<f64>()
    });
    let least = thin.filter(|thin| thin.is_finite()).fold(f64::INFINITY, f64::min);
    let radius = Some((FLESH_SHARE * least) as f32).filter(|radius| radius.is_finite())?;
    let cones = outline(triangles).iter().map(|side| Cone::side(side, radius)).collect();
    Some(Part { role: Role::Whole, cones, of: *triangles.first()? })
}

/// Pieces that may be a torso with a head and limbs.
struct Figure<'a> {
    pieces: Vec<Piece>,
    at: &'a dyn Fn(u32) -> [f64; 2],
}

/// Limbs that hang one from another, with the joint that each hangs from.
type Chain = Vec<(usize, u32)>;

impl Figure<'_> {
    /// From behind to the front; `None`: this is no such figure.
    fn parts(&self) -> Option<Vec<Part>> {
        let torso = (0..self.pieces.len()).max_by(|&a, &b| {
            let of = |piece: usize| self.neighbors(piece).count();
            of(a).cmp(&of(b)).then(self.pieces[a].area.total_cmp(&self.pieces[b].area))
        })?;
        let [top, bottom] = <[u32; 2]>::try_from(self.pieces[torso].joints.clone()).ok()?;
        let mut heads = Vec::new();
        let [mut behind, mut front] = [Vec::new(), Vec::new()];
        for joint in [top, bottom] {
            let mut limbs = Vec::new();
            for (piece, _) in self.neighbors(torso).filter(|(_, at)| *at == joint) {
                match self.chain(torso, (piece, joint))? {
                    chain if chain.len() == 1 => heads.push(chain[0]),
                    chain => limbs.push(chain),
                }
            }
            limbs.sort_by_key(|chain| {
                chain.iter().flat_map(|(piece, _)| self.pieces[*piece].points.last()).min().copied()
            });
            let (back, rest) = limbs.split_at(limbs.len() / 2);
            behind.extend(back.to_vec());
            front.extend(rest.to_vec());
        }
        if heads.len() > 1 || front.len() < 2 {
            return None;
        }
        let mut parts = Vec::new();
        for chain in &behind {
            parts.extend(self.limb(chain, false)?);
        }
        for &(piece, joint) in &heads {
            parts.push(self.head(piece, joint)?);
        }
        parts.push(self.torso(torso)?);
        for chain in &front {
            parts.extend(self.limb(chain, true)?);
        }
        Some(parts)
    }

    /// Pieces that share a point with a piece, each with that.
    fn neighbors(&self, piece: usize) -> impl Iterator<Item = (usize, u32)> {
        let joints = &self.pieces[piece].joints;
        (0..self.pieces.len()).filter(move |other| *other != piece).filter_map(move |other| {
            let shared = self.pieces[other].joints.iter().find(|joint| joints.contains(joint))?;
            Some((other, *shared))
        })
    }

    /// What hangs from a piece in one line; `None` where it branches, or has no end.
    fn chain(&self, from: usize, first: (usize, u32)) -> Option<Chain> {
        let (mut before, mut chain) = (from, vec![first]);
        while chain.len() <= self.pieces.len() {
            let (piece, joint) = *chain.last()?;
            let mut next = self.neighbors(piece).filter(|(other, at)| *other != before && *at != joint);
            let Some(one) = next.next() else { return Some(chain) };
            if next.next().is_some() {
                return None;
            }
            (before, _) = (piece, chain.push(one));
        }
        None
    }

    /// A limb with what it ends in, which is a part of its own where it is a hand.
    fn limb(&self, chain: &[(usize, u32)], is_front: bool) -> Option<Vec<Part>> {
        let role = if is_front { Role::Front } else { Role::Behind };
        let (mut cones, mut ends) = (Vec::new(), Vec::new());
        let mut above = None;
        for (place, &(number, joint)) in chain.iter().enumerate() {
            let piece = &self.pieces[number];
            if piece.points.len() > 5 || self.angle(piece, joint) > WIDEST {
                return None;
            }
            let next = chain.get(place + 1).map(|(_, joint)| *joint);
            let end = match next {
                Some(next) => next,
                None => self.end(piece, joint)?,
            };
            let sole = next.is_none().then(|| self.sole(piece, (joint, end))).flatten();
            let wide = self.half_width(piece, (joint, end), sole);
            let first = above.unwrap_or(UPPER[0] * wide);
            let last = if next.is_some() { UPPER[1] * wide } else { END * wide };
            above = Some(last);
            let long = long(sub((self.at)(end), (self.at)(joint)));
            // A foot stands on its sole, and a hand ends where its piece does.
            let share = if next.is_some() { 1.0 } else { 1.0 - last / long };
            cones.push(cone([[joint; 2], [joint, end]], [0.0, share], [first, last]));
            match (next, sole) {
                (Some(_), _) => {}
                (None, Some((toe, beside))) => {
                    let toes = 0.8 * last;
                    let along = toes / self.distance(beside, toe);
                    cones.push(cone([[joint, end], [beside, toe]], [share, 1.0 - along], [last, toes]));
                }
                (None, None) => {
                    let radius = HAND * wide;
                    let share = 1.0 - 0.6 * radius / long;
                    ends.push(cone([[joint, end]; 2], [share; 2], [radius; 2]));
                }
            }
        }
        let of = *self.pieces[chain[0].0].triangles.first()?;
        let last = *self.pieces[chain.last()?.0].triangles.first()?;
        let hand = (!ends.is_empty()).then_some(Part { role: Role::End(is_front), cones: ends, of: last });
        let limb = Part { role, cones, of };
        // A hand lies below its sleeve.
        Some(hand.into_iter().chain([limb]).collect())
    }

    fn distance(&self, a: u32, b: u32) -> f64 {
        long(sub((self.at)(b), (self.at)(a))).max(f64::MIN_POSITIVE)
    }

    /// The angle of a piece at one of its points `[rad]`.
    fn angle(&self, piece: &Piece, point: u32) -> f64 {
        let of = |corners: &&[u32; 3]| corners.contains(&point);
        let angle = |corners: &[u32; 3]| {
            let others: Vec<u32> = corners.iter().copied().filter(|corner| *corner != point).collect();
            let [a, b] = [others[0], others[1]].map(|other| sub((self.at)(other), (self.at)(point)));
            cross(a, b).abs().atan2(a[0] * b[0] + a[1] * b[1])
        };
        piece.triangles.iter().filter(of).map(angle).sum()
    }

    /// The end of a limb that hangs from a joint: of a foot its heel, which is nearer than its toe.
    fn end(&self, piece: &Piece, joint: u32) -> Option<u32> {
        let mut far: Vec<u32> = piece.points.iter().copied().filter(|point| *point != joint).collect();
        far.sort_by(|a, b| self.distance(joint, *b).total_cmp(&self.distance(joint, *a)));
        if piece.points.len() > 4 { far.get(1).copied() } else { far.first().copied() }
    }

    /// Of a piece that ends in a side its other end, and the point that comes before that.
    fn sole(&self, piece: &Piece, (joint, heel): (u32, u32)) -> Option<(u32, u32)> {
        if piece.points.len() <= 4 {
            return None;
        }
        let toe = piece
            .points
            .iter()
            .copied()
            .max_by(|a, b| self.distance(joint, *a).total_cmp(&self.distance(joint, *b)))?;
        let sides = outline(&piece.triangles);
        let beside = sides.iter().flat_map(|side| [[side.a, side.b], [side.b, side.a]]);
        let beside = beside.filter(|[from, to]| *to == toe && *from != heel).map(|[from, _]| from).next()?;
        Some((toe, beside))
    }

    /// Half the greatest width of a limb across the line between its ends `[m]`.
    fn half_width(&self, piece: &Piece, (joint, end): (u32, u32), sole: Option<(u32, u32)>) -> f64 {
        let axis = sub((self.at)(end), (self.at)(joint));
        let across = |point: &u32| cross(axis, sub((self.at)(*point), (self.at)(joint))).abs() / long(axis).max(1e-12);
        let is_sole = |point: &&u32| sole.is_some_and(|(toe, _)| toe == **point);
        piece.points.iter().filter(|point| !is_sole(point)).map(across).fold(0.0, f64::max)
    }

    /// A disc on a neck.
    fn head(&self, number: usize, joint: u32) -> Option<Part> {
        let piece = &self.pieces[number];
        let rest: Vec<u32> = piece.points.iter().copied().filter(|point| *point != joint).collect();
        let middle =
            [0, 1].map(|axis| rest.iter().map(|point| (self.at)(*point)[axis]).sum::<f64>() / rest.len() as f64);
        // The place between two of its points that is nearest to their middle.
        let between = |a: u32, b: u32| {
            let (from, way) = ((self.at)(a), sub((self.at)(b), (self.at)(a)));
            let to = sub(middle, from);
            let share = ((to[0] * way[0] + to[1] * way[1]) / long(way).powi(2).max(1e-12)).clamp(0.0, 1.0);
            let place = [from[0] + share * way[0], from[1] + share * way[1]];
            (long(sub(place, middle)), [a, b], share, place)
        };
        let pairs = rest.iter().enumerate().flat_map(|(k, &a)| rest[k + 1..].iter().map(move |&b| (a, b)));
        let (_, ends, share, place) = pairs.map(|(a, b)| between(a, b)).min_by(|a, b| a.0.total_cmp(&b.0))?;
        let radius = rest.iter().map(|point| long(sub((self.at)(*point), place))).sum::<f64>() / rest.len() as f64;
        let neck = cone([[joint; 2], ends], [0.0, share], [NECK * radius; 2]);
        let disc = cone([ends; 2], [share; 2], [radius; 2]);
        Some(Part { role: Role::Head, cones: vec![neck, disc], of: *piece.triangles.first()? })
    }

    /// From the two points about one of its joints to those about the other one.
    fn torso(&self, number: usize) -> Option<Part> {
        let piece = &self.pieces[number];
        let joints = <[u32; 2]>::try_from(piece.joints.clone()).ok()?;
        let girdle = |place: usize| {
            let is_near = |point: &u32| {
                !joints.contains(point)
                    && self.distance(*point, joints[place]) < self.distance(*point, joints[1 - place])
            };
            let near: Vec<u32> = piece.points.iter().copied().filter(is_near).collect();
            <[u32; 2]>::try_from(near).ok()
        };
        let ends = [girdle(0)?, girdle(1)?];
        let radii = ends.map(|[a, b]| 0.5 * self.distance(a, b));
        Some(Part { role: Role::Torso, cones: vec![cone(ends, [0.5; 2], radii)], of: *piece.triangles.first()? })
    }
}

fn cone(ends: [[u32; 2]; 2], shares: [f64; 2], radii: [f64; 2]) -> Cone {
    Cone { ends, shares: shares.map(|share| share as f32), radii: radii.map(|radius| radius as f32) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    /// A torso with a head, two limbs at its neck and two at its hip, each of two pieces; the lower ones of the latter have feet.
    fn doll() -> (Vec<[f64; 2]>, Vec<[u32; 3]>) {
        let mut places = vec![[0.0, 0.0], [0.11, 0.08], [0.13, 0.37], [0.0, 0.51], [-0.12, 0.36], [-0.12, 0.05]];
        let mut triangles = vec![[0, 1, 2], [0, 2, 4], [0, 4, 5], [2, 3, 4]];
        places.extend([[0.09, 0.58], [0.11, 0.7], [0.0, 0.8], [-0.1, 0.68]]);
        triangles.extend([[3, 6, 9], [6, 7, 9], [7, 8, 9]]);
        for (from, far, has_feet) in [(3_u32, 0.5, false), (3, 0.7, false), (0, 0.3, true), (0, -0.3, true)] {
            let [x, y] = places[from as usize];
            let first = places.len() as u32;
            places.extend([[x + far + 0.05, y - 0.09], [x + far - 0.05, y - 0.09], [x + 2.0 * far, y - 0.3]]);
            // Slender as those of a ragdoll: its sides begin in the joint.
            places[first as usize] = [x + 0.05, y - 0.09];
            places[first as usize + 1] = [x - 0.05, y - 0.09];
            places[first as usize + 2] = [x, y - 0.3];
            triangles.extend([[from, first + 1, first], [first + 1, first + 2, first]]);
            let (knee, lower) = (first + 2, first + 3);
            let [x, y] = places[knee as usize];
            if has_feet {
                places.extend([
                    [x - 0.06, y - 0.14],
                    [x + 0.045, y - 0.14],
                    [x - 0.05, y - 0.47],
                    [x + 0.17, y - 0.47],
                ]);
                triangles.extend([
                    [knee, lower, lower + 1],
                    [lower, lower + 2, lower + 1],
                    [lower + 2, lower + 3, lower + 1],
                ]);
            } else {
                places.extend([[x + 0.04, y - 0.09], [x - 0.04, y - 0.09], [x, y - 0.29]]);
                triangles.extend([[knee, lower + 1, lower], [lower + 1, lower + 2, lower]]);
            }
        }
        (places, triangles)
    }

    fn drawn(places: &[[f64; 2]], triangles: &[[u32; 3]]) -> Option<Vec<Part>> {
        figure(triangles, &|point| places[point as usize])
    }

    #[test]
    fn a_doll_has_a_torso_a_head_and_limbs_behind_and_in_front() {
        let (places, triangles) = doll();
        let parts = drawn(&places, &triangles).unwrap();
        let roles: Vec<Role> = parts.iter().map(|part| part.role).collect();
        use Role::{Behind, End, Front, Head, Torso};
        assert_eq!(roles, [Behind, End(false), Behind, Head, Torso, Front, End(true), Front]);
        let torso = &parts[4].cones[0];
        assert!((torso.radii[0] - 0.115).abs() < 0.01 && (torso.radii[1] - 0.125).abs() < 0.01, "{torso:?}");
        let head = parts[3].cones[1];
        assert!((0.09..0.13).contains(&head.radii[0]), "{head:?}");
        let leg = &parts[5].cones;
        assert_eq!(leg.len(), 3, "thigh, shank and foot");
        assert_eq!(leg[0].radii[1], leg[1].radii[0], "limbs are as wide as each other in their joint");
        let middle = |cone: &Cone, end: usize| {
            let [a, b] = cone.ends[end].map(|point| places[point as usize]);
            let share = f64::from(cone.shares[end]);
            [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]))
        };
        let sole = places.last().unwrap()[1];
        for (end, radius) in leg[2].radii.iter().enumerate() {
            let lowest = middle(&leg[2], end)[1] - f64::from(*radius);
            assert!((lowest - sole).abs() < 0.005, "the foot stands on its sole: {lowest} {sole}");
        }
    }

    #[test]
    fn pieces_that_are_no_figure_have_flesh_about_their_sides() {
        // Two squares that share a corner, the second one half as large.
        let places = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [3.0, 2.0], [3.0, 3.0], [2.0, 3.0]];
        let triangles = [[0, 1, 2], [0, 2, 3], [2, 4, 5], [2, 5, 6]];
        let parts = drawn(&places, &triangles).unwrap();
        let part = &parts[0];
        assert_eq!((parts.len(), part.role, part.cones.len()), (1, Role::Whole, 8));
        assert!(
            part.cones.iter().all(|cone| cone.radii == [(FLESH_SHARE * 0.5) as f32; 2]),
            "as the smaller one: 2 m^2 by 4 m"
        );
        assert_eq!(drawn(&places, &triangles[..2]), None, "one piece alone");
        let (places, mut triangles) = doll();
        triangles.truncate(12);
        assert_eq!(drawn(&places, &triangles).unwrap()[0].role, Role::Whole, "what is left of a doll without its legs");
    }
}
