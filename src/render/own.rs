//! What bonds have of their bodies' own: colours and widths, a row for each point, so that there are as many as there are bodies.

use super::gpu_bond::{COVERED, GpuBond, OF_COLOR, OF_WIDTH};
use super::view::View;
use crate::picture::Tint;

/// Of all points: empty where no body has anything of its own.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Owns {
    /// Of each point red, green and blue from the lowest byte on, then whether it has a colour, 0 or 255, and the width `[m]` as its bits: `own` in
    /// bonds.wgsl and fill.wgsl.
    pub(super) rows: Vec<[u32; 2]>,
    /// The largest of the widths `[m]`.
    pub(super) widest: f64,
}

/// Gives bonds the widths and colours that their bodies have of their own.
pub(super) fn paint(view: &View<'_>, cover: &[u32], bonds: &mut [GpuBond]) -> Owns {
    let mut owns = Owns::default();
    if view.tints.iter().all(|tint| tint.color.is_none() && tint.width == 0.0) {
        return owns;
    }
    owns.rows.resize(cover.len(), [0; 2]);
    let ends = view.tints.iter().skip(1).map(|tint| tint.first as usize).chain([cover.len()]);
    for (tint, end) in view.tints.iter().zip(ends) {
        let [red, green, blue] = tint.color.unwrap_or_default();
        let is_there = if tint.color.is_some() { 255 } else { 0 };
        let row = [u32::from_le_bytes([red, green, blue, is_there]), (tint.width as f32).to_bits()];
        owns.rows.get_mut(tint.first as usize..end).into_iter().flatten().for_each(|to| *to = row);
        owns.widest = owns.widest.max(tint.width);
    }
    for bond in bonds {
        let is_worn = [bond.a, bond.b].map(|end| cover[end as usize] != 0);
        let widths = [bond.a, bond.b].map(|end| Tint::of(view.tints, end).map_or(0.0, |tint| tint.width));
        // A stroke that begins at a body is drawn as the stroke is: what a bond has of its own is told by its first end.
        if is_worn == [true, false] && widths[1] > 0.0 {
            std::mem::swap(&mut bond.a, &mut bond.b);
        }
        let Some(tint) = Tint::of(view.tints, bond.a) else { continue };
        let is_stroke = is_worn[0] != is_worn[1] && cover[bond.a as usize] == 0 && tint.width > 0.0;
        let is_covered = is_worn.contains(&true) && !is_stroke;
        let has = |is: bool, flag: u32| if is { flag } else { 0 };
        let colored = has(tint.color.is_some(), OF_COLOR | has(is_covered, COVERED));
        bond.own = colored | has(tint.width > 0.0, OF_WIDTH);
    }
    owns
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{Bond, Bonds, PointId};

    fn tint(first: u32, color: Option<[u8; 3]>, width: f64) -> Tint {
        Tint { color, width, ..Tint::new(first, first) }
    }

    #[test]
    fn bonds_have_what_is_of_their_bodies_and_covered_ones_say_so() {
        let bonds: Bonds =
            [[0, 1], [1, 2], [3, 4], [5, 6]].map(|[a, b]| Bond::new(PointId(a), PointId(b), 1.0)).into_iter().collect();
        let tints = [tint(0, Some([255, 0, 1]), 0.0), tint(3, None, 0.0), tint(5, Some([0, 255, 0]), 0.25)];
        let view = View { tints: &tints, ..View::empty(&bonds, 2) };
        let mut list: Vec<GpuBond> = bonds.iter().map(GpuBond::from).collect();
        let owns = paint(&view, &[0, 0, 0, 0, 0, 7, 7], &mut list);
        assert_eq!(
            list.iter().map(|bond| bond.own).collect::<Vec<_>>(),
            [OF_COLOR, OF_COLOR, 0, OF_COLOR | COVERED | OF_WIDTH]
        );
        assert_eq!(owns.rows[2], [0xff01_00ff, 0]);
        assert_eq!((owns.rows[6], owns.widest), ([0xff00_ff00, 0.25_f32.to_bits()], 0.25));
        let plain = [tint(0, None, 0.0)];
        assert_eq!(paint(&View { tints: &plain, ..view }, &[0; 7], &mut list), Owns::default(), "nothing to upload");
    }

    #[test]
    fn a_stroke_that_begins_at_a_body_has_its_own_colour_and_width_from_there_on() {
        let bonds: Bonds =
            [[0, 1], [2, 1], [0, 2]].map(|[a, b]| Bond::new(PointId(a), PointId(b), 1.0)).into_iter().collect();
        let tints = [tint(0, None, 0.0), tint(1, Some([9, 8, 7]), 0.1), tint(2, None, 0.0)];
        let mut list: Vec<GpuBond> = bonds.iter().map(GpuBond::from).collect();
        paint(&View { tints: &tints, ..View::empty(&bonds, 2) }, &[5, 0, 5], &mut list);
        assert_eq!(
            list.iter().map(|bond| (bond.a, bond.own)).collect::<Vec<_>>(),
            [(1, OF_COLOR | OF_WIDTH), (1, OF_COLOR | OF_WIDTH), (0, 0)]
        );
    }

    #[test]
    fn as_many_bodies_as_there_are_have_colours_and_widths_of_their_own() {
        let bonds: Bonds = (0..900).map(|k| Bond::new(PointId(2 * k), PointId(2 * k + 1), 1.0)).collect();
        let of = |k: u32| [(k % 251) as u8, (k / 251) as u8, 9];
        let tints: Vec<Tint> = (0..900).map(|k| tint(2 * k, Some(of(k)), 0.001 * f64::from(k + 1))).collect();
        let mut list: Vec<GpuBond> = bonds.iter().map(GpuBond::from).collect();
        let owns = paint(&View { tints: &tints, ..View::empty(&bonds, 2) }, &[0; 1800], &mut list);
        assert!(list.iter().all(|bond| bond.own == OF_COLOR | OF_WIDTH));
        let mut rows: Vec<[u32; 2]> = list.iter().map(|bond| owns.rows[bond.a as usize]).collect();
        rows.sort_unstable();
        rows.dedup();
        assert_eq!(rows.len(), 900, "each of them has its own");
    }
}
