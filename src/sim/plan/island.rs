//! Islands: points that bonds hold together, and what each island is made of.

use super::rigid::Pieces;
use crate::sim::bond::{Bond, BondKind, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::drive::Signal;
use crate::sim::force::angle::Angle;
use crate::sim::sets::Sets;

/// Angles and areas between points.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Ties {
    pub(crate) angles: Vec<Angle>,
    /// Triangles that resist.
    pub(crate) patches: Vec<Patched>,
    /// How much they do `[N/m]`; infinite: they are held.
    pub(crate) stiffness: f64,
}

/// A triangle that resists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Patched {
    pub(crate) corners: [PointId; 3],
    /// Its area at rest `[m^2]`.
    pub(crate) rest: f64,
    /// Its longest side, times the way around it, over four times its area `[1]`: how stiff it is at a corner, over its stiffness.
    pub(crate) slender: f64,
}

impl Ties {
    fn triples(&self) -> impl Iterator<Item = [PointId; 3]> {
        self.angles.iter().map(|angle| angle.points).chain(self.patches.iter().map(|patch| patch.corners))
    }

    /// Whether areas are held, not forces.
    pub(crate) fn holds_areas(&self) -> bool {
        self.stiffness.is_infinite()
    }
}

/// Points that hang together by bonds; pinned points belong to every island that is fastened to them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Island {
    /// The free points, ascending.
    pub(crate) points: Vec<u32>,
    /// Indices of the bonds with a free end here, ascending.
    pub(crate) bonds: Vec<u32>,
    /// Indices of the angles and of the triangles that resist, ascending.
    pub(crate) angles: Vec<u32>,
    pub(crate) patches: Vec<u32>,
    pub(crate) springs: usize,
    /// Bonds and areas that are held.
    pub(crate) rigid: usize,
    pub(crate) relaxed: usize,
    pub(crate) is_damped: bool,
    /// Some damper has a spring without a length: it acts in all directions.
    pub(crate) has_round_dampers: bool,
    /// Some bond acts on one side of its rest length only.
    pub(crate) has_limits: bool,
    /// Bound on the fastest oscillation of the springs `[rad/s]`.
    pub(crate) frequency: f64,
    /// Bound on the fastest decay by their dampers `[1/s]`.
    pub(crate) decay: f64,
    /// Pairs of rigid bonds that share a point: what a direct solve has to couple.
    pub(crate) couplings: usize,
    /// Most rigid bonds at a free point.
    pub(crate) fullest: usize,
    /// No way along bonds leads from a free point back to it but the way it went, and at most one bond ends at a pin: between two it may get taut.
    pub(crate) is_tree: bool,
    /// A constant force or torque acts on some of its points.
    pub(crate) is_driven: bool,
    /// Surfaces push it by depth.
    pub(crate) is_pressed: bool,
    /// Some bond or angle of it has a drive; a motor; a rigid bond with one; and how fast these change at the most `[rad/s]`.
    pub(crate) has_drives: bool,
    pub(crate) has_motors: bool,
    pub(crate) drives_rigid: bool,
    pub(crate) drive_rate: f64,
    /// Areas are held.
    pub(crate) holds_areas: bool,
    /// Where it moves as rigid bodies: what those are.
    pub(crate) pieces: Option<Pieces>,
}

/// Splits points into islands, in the order of their lowest points: bonds hold them together, angles and triangles that resist.
///
/// Bounds on oscillation and decay are Gershgorin's: omega^2 <= max over points of 2 w_i sum of stiffness, decay
/// likewise with damping.
pub(crate) fn islands(bonds: &Bonds, ties: &Ties, w: &[f64]) -> Vec<Island> {
    islands_joined(bonds, ties, w, &[])
}

/// The same where these pairs of points hang together too, as by a torque.
pub(crate) fn islands_joined(bonds: &Bonds, ties: &Ties, w: &[f64], pairs: &[[u32; 2]]) -> Vec<Island> {
    let mut sets = Sets::new(w.len());
    for &[a, b] in pairs {
        if w[a as usize] > 0.0 && w[b as usize] > 0.0 {
            sets.join(a, b);
        }
    }
    for [a, b] in bonds.ends() {
        if w[a.index()] > 0.0 && w[b.index()] > 0.0 {
            sets.join(a.0, b.0);
        }
    }
    for points in ties.triples() {
        let mut free = points.into_iter().filter(|point| w[point.index()] > 0.0);
        if let Some(first) = free.next() {
            free.for_each(|other| sets.join(first.0, other.0));
        }
    }
    let mut place = vec![u32::MAX; w.len()];
    let mut list: Vec<Island> = Vec::new();
    for i in (0..w.len() as u32).filter(|&i| w[i as usize] > 0.0) {
        let root = sets.find(i) as usize;
        if place[root] == u32::MAX {
            place[root] = list.len() as u32;
            list.push(Island::default());
        }
        list[place[root] as usize].points.push(i);
    }
    let mut sums = vec![(0.0, 0.0, 0_usize); w.len()];
    let mut inner = vec![0_usize; list.len()];
    for (k, bond) in bonds.iter().enumerate() {
        let free = [bond.a, bond.b].into_iter().find(|end| w[end.index()] > 0.0);
        let Some(free) = free else { continue };
        let place = place[sets.find(free.0) as usize] as usize;
        inner[place] += usize::from(w[bond.a.index()] > 0.0 && w[bond.b.index()] > 0.0);
        let island = &mut list[place];
        island.bonds.push(k as u32);
        island.add(&bond, &mut sums);
    }
    let mut of = |points: [PointId; 3]| {
        let free = points.into_iter().find(|point| w[point.index()] > 0.0)?;
        Some(place[sets.find(free.0) as usize] as usize)
    };
    for (k, angle) in ties.angles.iter().enumerate() {
        if let Some(at) = of(angle.points) {
            list[at].angles.push(k as u32);
            list[at].add_angle(angle, &mut sums);
        }
    }
    for (k, patch) in ties.patches.iter().enumerate() {
        if let Some(at) = of(patch.corners) {
            list[at].patches.push(k as u32);
            list[at].add_patch(patch, ties.stiffness, &mut sums);
        }
    }
    for (island, inner) in list.iter_mut().zip(inner) {
        island.holds_areas = ties.holds_areas() && !island.patches.is_empty();
        island.is_tree = !island.holds_areas && inner + 1 == island.points.len() && island.bonds.len() <= inner + 1;
        island.bound(&sums, w);
    }
    list
}

impl Island {
    fn add(&mut self, bond: &Bond, sums: &mut [(f64, f64, usize)]) {
        if let Some(drive) = bond.drive {
            self.follow(&drive.signal);
            self.drives_rigid |= bond.kind == BondKind::Rigid;
        }
        self.has_limits |= bond.limit != crate::sim::bond::Limit::Both;
        match bond.kind {
            BondKind::Spring { stiffness, damping } => {
                self.springs += 1;
                self.is_damped |= damping > 0.0;
                self.has_round_dampers |= damping > 0.0 && bond.rest_length == 0.0;
                for end in [bond.a, bond.b] {
                    sums[end.index()].0 += stiffness;
                    sums[end.index()].1 += damping;
                }
            }
            BondKind::Rigid => {
                self.rigid += 1;
                for end in [bond.a, bond.b] {
                    self.couplings += sums[end.index()].2;
                    sums[end.index()].2 += 1;
                }
            }
            BondKind::Relaxed { .. } => self.relaxed += 1,
        }
    }

    fn follow(&mut self, signal: &Signal) {
        self.has_drives = true;
        self.drive_rate = self.drive_rate.max(signal.fastest());
    }

    /// Whether the live step alone moves it as it is meant: where the rules choose. Rigid bodies know drives between them, but where they
    /// may meet something many of them are gaits, which the live step moves at a fixed cost.
    pub(crate) fn needs_live(&self, has_surfaces: bool) -> bool {
        (self.drives_rigid && self.pieces.is_none()) || (self.has_drives && self.rigid > 0 && has_surfaces)
    }

    /// An angle of slopes g is as stiff at a point as k |g| times the sum of all |g|, and so is its damper.
    fn add_angle(&mut self, angle: &Angle, sums: &mut [(f64, f64, usize)]) {
        let [p, q] = angle.arms.map(|arm| 1.0 / arm);
        let (slopes, all) = ([p, p + q, q], 2.0 * (p + q));
        let drag = angle.drive.map_or(0.0, |drive| drive.slope());
        if let Some(drive) = angle.drive {
            self.follow(&drive.signal());
            self.has_motors |= drag > 0.0;
        }
        self.is_damped |= angle.damping + drag > 0.0;
        for (point, slope) in angle.points.into_iter().zip(slopes) {
            sums[point.index()].0 += 0.5 * (angle.stiffness + angle.stop) * slope * all;
            sums[point.index()].1 += 0.5 * (angle.damping + drag) * slope * all;
        }
    }

    /// The same of an area, whose slopes are half the sides opposite.
    fn add_patch(&mut self, patch: &Patched, stiffness: f64, sums: &mut [(f64, f64, usize)]) {
        let corners = patch.corners;
        if stiffness.is_finite() {
            corners.iter().for_each(|corner| sums[corner.index()].0 += 0.5 * stiffness * patch.slender);
            return;
        }
        self.rigid += 1;
        for corner in corners {
            self.couplings += sums[corner.index()].2;
            sums[corner.index()].2 += 1;
        }
    }

    /// Whether anything is asked of it that large bodies do not know.
    pub(crate) fn has_form(&self) -> bool {
        !(self.angles.is_empty() && self.patches.is_empty())
    }

    fn bound(&mut self, sums: &[(f64, f64, usize)], w: &[f64]) {
        for &i in &self.points {
            let (stiffness, damping, rigid) = sums[i as usize];
            self.fullest = self.fullest.max(rigid);
            self.frequency = self.frequency.max(2.0 * w[i as usize] * stiffness);
            self.decay = self.decay.max(2.0 * w[i as usize] * damping);
        }
        self.frequency = self.frequency.sqrt();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bond::{Limit, PointId};

    fn bond(a: u32, b: u32, kind: BondKind) -> Bond {
        Bond { kind, ..Bond::new(PointId(a), PointId(b), 1.0) }
    }

    #[test]
    fn a_pin_does_not_join_islands() {
        let spring = BondKind::Spring { stiffness: 8.0, damping: 1.0 };
        let bonds = Bonds::from([bond(1, 0, spring), bond(2, 0, BondKind::Rigid), bond(2, 3, BondKind::Rigid)]);
        let found = islands(&bonds, &Ties::default(), &[0.0, 0.25, 1.0, 1.0, 1.0]);
        let points: Vec<&[u32]> = found.iter().map(|island| &island.points[..]).collect();
        assert_eq!(points, [&[1][..], &[2, 3], &[4]]);
        assert_eq!((found[0].springs, found[0].frequency, found[0].decay), (1, 2.0, 0.5));
        assert_eq!((found[1].rigid, found[1].couplings, &found[1].bonds[..]), (2, 1, &[1, 2][..]));
        assert_eq!(bonds.get(0).limit, Limit::Both);
        assert!(found.iter().all(|island| island.is_tree));
    }

    #[test]
    fn a_ring_is_no_tree_and_a_row_between_two_pins_is_none() {
        let ring = Bonds::from([(0, 1), (1, 2), (2, 0)].map(|(a, b)| bond(a, b, BondKind::Rigid)));
        assert!(!islands(&ring, &Ties::default(), &[1.0; 3])[0].is_tree);
        assert!(
            !islands(&ring, &Ties::default(), &[0.0, 1.0, 1.0])[0].is_tree,
            "the ring is cut by the pin, and may be taut"
        );
        let row = Bonds::from([(0, 1), (1, 2)].map(|(a, b)| bond(a, b, BondKind::Rigid)));
        assert!(islands(&row, &Ties::default(), &[0.0, 1.0, 1.0])[0].is_tree);
        let comb = Bonds::from([(0, 3), (3, 4), (4, 5), (1, 4), (2, 5)].map(|(a, b)| bond(a, b, BondKind::Rigid)));
        assert!(!islands(&comb, &Ties::default(), &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0])[0].is_tree, "held at every point");
    }
}
