//! What is covered of a world: by skins, by fills, by a rope that goes through it; and what bonds between pins are.

use super::forms::{BAR, MUSCLE, is_rope};
use super::gpu_bond::GpuBond;
use super::view::View;
use crate::picture::{Skin, Tint};
use crate::sim::PointId;

/// What each point lies under: 0 nothing, else the number of what one skin or triangles side by side cover.
pub(super) fn covered(view: &View<'_>, filled: &[[u32; 3]]) -> Vec<u32> {
    let count = view.current.len() / view.dimensions;
    let mut cover = vec![0; count];
    let sides = filled.iter().flat_map(|&[a, b, c]| [[a, b], [b, c]]);
    let pieces = Tint::hanging(if filled.is_empty() { 0 } else { count }, sides);
    filled.iter().flatten().for_each(|&corner| cover[corner as usize] = 1 + pieces[corner as usize]);
    for (number, skin) in (0..).zip(view.skins) {
        let range = skin.first as usize..(skin.first as usize + skin.texture.len()).min(count);
        let strands = Strands::of(skin, view.tints);
        let points = cover.get_mut(range).into_iter().flatten().zip(skin.first..);
        let worn = points.filter(|(cover, point)| **cover == 0 && !strands.have(*point));
        worn.for_each(|(cover, _)| *cover = u32::MAX - number);
    }
    cover
}

/// Strokes of a skin that are as wide as their ink was: they are drawn as bonds, whatever their picture has there.
pub(super) struct Strands<'a> {
    tints: &'a [Tint],
    /// Corners of triangles, ascending.
    corners: Vec<u32>,
}

impl<'a> Strands<'a> {
    /// Those of a skin; nothing is looked for where no bond has a width of its own.
    pub(super) fn of(skin: &Skin, tints: &'a [Tint]) -> Self {
        if tints.iter().all(|tint| tint.width == 0.0) {
            return Strands { tints: &[], corners: Vec::new() };
        }
        let mut corners: Vec<u32> = skin.triangles.iter().flatten().copied().collect();
        corners.sort_unstable();
        corners.dedup();
        Strands { tints, corners }
    }

    /// Whether a point is of one: its bonds have a width of their own, and it is no corner of a triangle.
    pub(super) fn have(&self, point: u32) -> bool {
        Tint::of(self.tints, point).is_some_and(|tint| tint.width > 0.0) && self.corners.binary_search(&point).is_err()
    }
}

/// Puts bonds and points that are not covered first, and returns how many there are of each. Pins are seen on skins too, and points
/// within a rope are not.
pub(super) fn bare_first(view: &View<'_>, cover: &[u32], bonds: &mut [GpuBond], points: &mut [u32]) -> [u32; 2] {
    // Between two pieces a bond is seen, and a muscle is everywhere, and a bar.
    let is_hidden = |bond: &GpuBond| {
        !matches!(bond.form, MUSCLE | BAR)
            && cover[bond.a as usize] != 0
            && cover[bond.a as usize] == cover[bond.b as usize]
    };
    bonds.sort_by_key(is_hidden);
    // How many bonds of a rope and others end in a point.
    let mut ends = vec![[0_u32; 2]; cover.len()];
    for bond in &*bonds {
        let of = usize::from(!is_rope(bond.form));
        [bond.a, bond.b].into_iter().for_each(|end| ends[end as usize][of] += 1);
    }
    let is_pinned = pins(view.pinned, cover.len() as u32);
    let is_under = |point: &u32| {
        let at = *point as usize;
        (cover[at] != 0 || ends[at] == [2, 0]) && !is_pinned[at]
    };
    points.sort_by_key(is_under);
    let count = |shown: usize| shown as u32;
    [count(bonds.partition_point(|bond| !is_hidden(bond))), count(points.partition_point(|point| !is_under(point)))]
}

/// Which pins bear something: bonds lead from them, over pins alone, to what is no pin.
pub(super) fn bearing(bonds: &[GpuBond], is_pinned: &[bool]) -> Vec<bool> {
    let holds = |point: u32| is_pinned[point as usize];
    let between = bonds.iter().filter(|bond| holds(bond.a) && holds(bond.b));
    let frames = Tint::hanging(is_pinned.len(), between.map(|bond| [bond.a, bond.b]));
    let mut bears = vec![false; is_pinned.len()];
    for bond in bonds {
        for [end, other] in [[bond.a, bond.b], [bond.b, bond.a]] {
            bears[frames[end as usize] as usize] |= holds(end) && !holds(other);
        }
    }
    frames.iter().zip(is_pinned).map(|(frame, is_pinned)| *is_pinned && bears[*frame as usize]).collect()
}

/// Bonds between pins that bear something are one bar, whatever they are made of.
pub(super) fn bars(bonds: &mut [GpuBond], bears: &[bool]) {
    for bond in bonds.iter_mut().filter(|bond| bears[bond.a as usize] && bears[bond.b as usize]) {
        bond.form = BAR;
    }
}

/// Pins that have bonds and bear nothing: they are ends of lines that are a drawing.
pub(super) fn scenery(bonds: &[GpuBond], is_pinned: &[bool], bears: &[bool]) -> Vec<bool> {
    let mut has_bonds = vec![false; is_pinned.len()];
    bonds.iter().flat_map(|bond| [bond.a, bond.b]).for_each(|end| has_bonds[end as usize] = true);
    (0..is_pinned.len()).map(|point| is_pinned[point] && has_bonds[point] && !bears[point]).collect()
}

/// Which points are pinned. Pins of points that there are not are left out.
pub(super) fn pins(pinned: &[PointId], point_count: u32) -> Vec<bool> {
    let mut is_pinned = vec![false; point_count as usize];
    for pin in pinned {
        if let Some(point) = is_pinned.get_mut(pin.index()) {
            *point = true;
        }
    }
    is_pinned
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Picture;
    use crate::sim::{Bonds, Positions};
    use std::sync::Arc;

    #[test]
    fn pins_of_points_that_there_are_not_are_left_out() {
        assert_eq!(pins(&[PointId(0), PointId(2)], 3), [true, false, true]);
        assert_eq!(pins(&[PointId(3), PointId(u32::MAX), PointId(1)], 3), [false, true, false]);
        assert!(pins(&[PointId(0)], 0).is_empty());
    }

    #[test]
    fn the_corner_of_a_frame_bears_with_it_and_lines_between_pins_alone_are_a_drawing() {
        let is_pinned = [true, true, true, false, true, true, true];
        let mut bonds = [[0, 1], [1, 2], [2, 3], [4, 5]].map(|[a, b]| GpuBond::new(a, b, 1.0));
        let bears = bearing(&bonds, &is_pinned);
        assert_eq!(bears, [true, true, true, false, false, false, false]);
        assert_eq!(scenery(&bonds, &is_pinned, &bears), [false, false, false, false, true, true, false]);
        bars(&mut bonds, &bears);
        assert_eq!(bonds.map(|bond| bond.form == BAR), [true, true, false, false]);
    }

    #[test]
    fn muscles_are_seen_on_what_covers_other_bonds() {
        let mut bonds = [GpuBond::new(0, 1, 1.0), GpuBond { form: MUSCLE, ..GpuBond::new(1, 2, 1.0) }];
        let nothing = Bonds::default();
        let [shown, _] = bare_first(&View::empty(&nothing, 2), &[1; 3], &mut bonds, &mut [0, 1, 2]);
        assert_eq!((shown, bonds[0].form), (1, MUSCLE));
    }

    #[test]
    fn pins_are_seen_on_skins_and_other_points_are_not() {
        let skin = Skin {
            picture: Arc::new(Picture::filled(2, 2, [255; 4])),
            first: 0,
            triangles: vec![[0, 1, 2]],
            texture: vec![[0.0; 2]; 3],
        };
        let bonds = Bonds::default();
        let places = [0.0; 10];
        let view = View {
            previous: Positions::F64(&places),
            current: Positions::F64(&places),
            skins: &[skin],
            pinned: &[PointId(1), PointId(4)],
            ..View::empty(&bonds, 2)
        };
        let mut points: Vec<u32> = (0..5).collect();
        let cover = covered(&view, &[]);
        assert_eq!(bare_first(&view, &cover, &mut [], &mut points), [0, 3]);
        assert_eq!(points, [1, 3, 4, 0, 2]);
        let cover = covered(&view, &[[1, 2, 3]]);
        assert_eq!(bare_first(&view, &cover, &mut [], &mut points), [0, 2], "the last is a pin, the first too");
    }

    #[test]
    fn strokes_of_a_skin_that_have_a_width_are_drawn_as_bonds() {
        let picture = Arc::new(Picture::filled(2, 2, [255; 4]));
        let skin = Skin { picture, first: 0, triangles: vec![[0, 1, 2]], texture: vec![[0.0; 2]; 5] };
        let (world, places) = (Bonds::default(), [0.0; 10]);
        let at = Positions::F64(&places);
        let tints = [Tint::new(0, 0), Tint { width: 0.1, ..Tint::new(2, 0) }, Tint::new(4, 0)];
        let view = View { previous: at, current: at, skins: &[skin], ..View::empty(&world, 2) };
        assert_eq!(covered(&view, &[]), [u32::MAX; 5]);
        let cover = covered(&View { tints: &tints, ..view }, &[]);
        assert_eq!(cover, [u32::MAX, u32::MAX, u32::MAX, 0, u32::MAX], "a corner of a triangle is covered");
    }

    #[test]
    fn a_bond_between_two_pieces_is_seen_and_one_within_a_piece_is_not() {
        let cover = [1, 1, 1, 5, 5, 0];
        let mut bonds = [[0, 1], [1, 3], [3, 4], [4, 5]].map(|[a, b]| GpuBond::new(a, b, 1.0));
        let world = Bonds::default();
        let places = [0.0; 12];
        let view =
            View { previous: Positions::F64(&places), current: Positions::F64(&places), ..View::empty(&world, 2) };
        let mut points: Vec<u32> = (0..6).collect();
        assert_eq!(bare_first(&view, &cover, &mut bonds, &mut points), [2, 1]);
        assert_eq!(bonds.map(|bond| [bond.a, bond.b]), [[1, 3], [4, 5], [0, 1], [3, 4]]);
    }
}
