//! Points that rigid bonds hold where they are: those of straight rows between points that stand still.
//!
//! A row of rigid bonds as long as the distance of its ends can go nowhere: a point off the line would be further from both. Its equations
//! say so in second order only, their rank is one too small, and a solver finds the right push by no number of rounds. So it stands, as pins
//! do, and what it holds in turn: rows between rows. In space as in the plane.

use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::bonds::Bonds;
use crate::sim::vector::{length, sub};

/// By how much a row may be longer than the distance of its ends, as a share: it would sag by 2 micrometres a metre.
const LONGER: f64 = 1e-11;
/// Bonds that are looked at, in all bonds: pins in a row would make it their square.
const MOST_LOOKS: usize = 16;

/// How a point stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stand {
    Free,
    /// A pin goes along a track.
    Led,
    Still,
}

/// Which points are held by such rows, beside those that stand still by themselves; places `[m]` with a rounding, as a share.
pub(super) fn held<const D: usize>(
    bonds: &Bonds,
    position: impl Fn(u32) -> [f64; D],
    stands: Vec<Stand>,
    rounding: f64,
) -> Vec<u32> {
    let is_near = |bond: &Bond| {
        let kinds = [bond.a, bond.b].map(|end| stands[end.index()]);
        kinds.contains(&Stand::Free) && kinds.contains(&Stand::Still) && holds(bond)
    };
    if !bonds.iter().any(|bond| is_near(&bond)) {
        return Vec::new();
    }
    let mut from: Vec<u32> = (0..stands.len() as u32).filter(|&i| stands[i as usize] == Stand::Still).collect();
    let mut search = Search::new(bonds, position, stands, LONGER.max(8.0 * rounding));
    let mut all = Vec::new();
    while !from.is_empty() {
        let mut found = Vec::new();
        from.iter().for_each(|&point| search.look(point, &mut found));
        all.extend_from_slice(&found);
        from = found;
    }
    all
}

/// Whether a bond keeps its ends no further apart than its length, for ever.
fn holds(bond: &Bond) -> bool {
    let is_kept = bond.break_strain == f64::INFINITY && bond.drive.is_none();
    bond.kind == BondKind::Rigid && bond.limit != Limit::Min && is_kept
}

struct Search<F> {
    position: F,
    stands: Vec<Stand>,
    /// Of every point the ends and lengths `[m]` of its bonds: where each begins, and the list.
    starts: Vec<u32>,
    bonds: Vec<(u32, f64)>,
    longer: f64,
    looks: usize,
}

impl<F: Fn(u32) -> [f64; D], const D: usize> Search<F> {
    fn new(bonds: &Bonds, position: F, stands: Vec<Stand>, longer: f64) -> Self {
        let mut list: Vec<(u32, (u32, f64))> = Vec::new();
        for bond in bonds.iter().filter(holds) {
            list.extend([(bond.a.0, (bond.b.0, bond.rest_length)), (bond.b.0, (bond.a.0, bond.rest_length))]);
        }
        list.sort_by_key(|entry| entry.0);
        let starts = (0..=stands.len() as u32).map(|point| list.partition_point(|entry| entry.0 < point) as u32);
        let starts = starts.collect();
        let bonds: Vec<(u32, f64)> = list.into_iter().map(|entry| entry.1).collect();
        let looks = MOST_LOOKS * bonds.len();
        Search { position, stands, starts, bonds, longer, looks }
    }

    /// Follows straight rows from a point that stands to others that do; what lies between stands from then on, and is `found`.
    fn look(&mut self, from: u32, found: &mut Vec<u32>) {
        let origin = (self.position)(from);
        // Each with the one before it in the row, and the way to it.
        let mut row: Vec<(u32, usize, f64)> = vec![(from, 0, 0.0)];
        let mut next = 0;
        while next < row.len() && self.looks > 0 {
            let (at, _, way) = row[next];
            for k in self.starts[at as usize]..self.starts[at as usize + 1] {
                self.looks = self.looks.saturating_sub(1);
                let (other, rest) = self.bonds[k as usize];
                let far = length(sub((self.position)(other), origin));
                let is_straight = (way + rest - far).abs() <= self.longer * far;
                // On a straight row each is further than the one before.
                if rest == 0.0 || !is_straight || other == from {
                    continue;
                }
                match self.stands[other as usize] {
                    Stand::Led => continue,
                    Stand::Free => {
                        row.push((other, next, way + rest));
                        continue;
                    }
                    Stand::Still => {}
                }
                let mut back = next;
                while back > 0 {
                    let (point, before, _) = row[back];
                    if std::mem::replace(&mut self.stands[point as usize], Stand::Still) == Stand::Free {
                        found.push(point);
                    }
                    back = before;
                }
            }
            next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bond::PointId;

    fn held_of(places: &[[f64; 2]], pins: &[u32], list: &[[u32; 2]]) -> Vec<u32> {
        let mut bonds = Bonds::with_capacity(list.len());
        for &[a, b] in list {
            let rest = length(sub(places[a as usize], places[b as usize]));
            bonds.push(Bond::new(PointId(a), PointId(b), rest));
        }
        let stands = (0..places.len() as u32).map(|i| if pins.contains(&i) { Stand::Still } else { Stand::Free });
        let mut found = held(&bonds, |i| places[i as usize], stands.collect(), 0.0);
        found.sort_unstable();
        found
    }

    #[test]
    fn rows_between_pins_stand_and_rows_between_rows_and_nothing_else() {
        // A row of five, aslant, one that hangs on its middle, and a bent one beside it.
        let mut places: Vec<[f64; 2]> = (0..5).map(|k| [0.3 * f64::from(k), 0.1 * f64::from(k)]).collect();
        places.extend([[0.7, -1.0], [0.6, -2.0], [2.0, 0.0], [3.0, -1e-3], [4.0, 0.0]]);
        let row = [[0, 1], [1, 2], [2, 3], [3, 4]];
        let all = [&row[..], &[[2, 5], [5, 6], [7, 8], [8, 9]]].concat();
        assert_eq!(held_of(&places, &[0, 4, 7, 9], &all), [1, 2, 3]);
        assert_eq!(held_of(&places, &[0, 4, 6], &all), [1, 2, 3], "what hangs at 2 is not straight below it");
        places[5] = [0.6, -0.9];
        places[6] = [0.6, -2.0];
        assert_eq!(held_of(&places, &[0, 4, 6], &all), [1, 2, 3, 5], "now it is, and 2 stands");
        assert_eq!(held_of(&places, &[0], &all), [0; 0], "one pin holds no row");
    }
}
