//! Which primitives of fills are drawn by a shader that knows them alone: a driver without a GPU works out what each kind would be for every
//! corner and every pixel. Of two triangles that share a side it works out four corners, not six, where it is told so.

use std::ops::Range;

use super::{CELL, FILL, OUTLINE, PAINTED, Primitive, UNDER};

/// Which kinds a pipeline draws: `KINDS` in common.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::render) enum Kinds {
    /// All of them, in the order that they come in.
    Any,
    /// Triangles of bodies.
    Triangles,
    /// Cells of nets.
    Cells,
    /// Triangles of bodies and outlines, in the plane.
    Outlined,
}

impl Kinds {
    /// All of them, in the order of their numbers in the shader.
    pub(in crate::render) const ALL: [Kinds; 4] = [Kinds::Any, Kinds::Triangles, Kinds::Cells, Kinds::Outlined];

    fn of(primitive: &Primitive, dimensions: usize) -> Self {
        match kind(primitive) {
            FILL | UNDER => Kinds::Triangles,
            CELL => Kinds::Cells,
            OUTLINE if dimensions == 2 => Kinds::Outlined,
            _ => Kinds::Any,
        }
    }
}

/// Primitives in a row that are drawn in one go.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) kinds: Kinds,
    /// Each has four corners: it is a stroke, or two triangles that share a side, the first corner of both and the last of the first.
    pub(super) are_quads: bool,
    /// Their places in the list.
    pub(super) range: Range<u32>,
}

/// Primitives from which on a row of their own costs less than it spares.
const LEAST: usize = 96;

/// The rows that a list is drawn in: what is alike lies in one where there is enough of it. In space triangles are always drawn by themselves:
/// they alone write their depth.
pub(super) fn rows(list: &[Primitive], dimensions: usize) -> Vec<Row> {
    let of = |primitive: &Primitive| Kinds::of(primitive, dimensions);
    let alike = list.chunk_by(|a, b| of(a) == of(b)).map(|part| (of(&part[0]), part.len()));
    // A body's triangles are few beside its outline: they go with it.
    let mixed = joined(alike.map(|(own, count)| match own {
        Kinds::Triangles if count < LEAST && dimensions == 2 => (Kinds::Outlined, false, count),
        Kinds::Cells if count < LEAST => (Kinds::Any, false, count),
        own => (own, false, count),
    }));
    let long = joined(mixed.into_iter().map(|Row { kinds, range, .. }| match kinds {
        Kinds::Outlined if range.len() < LEAST => (Kinds::Any, false, range.len()),
        kinds => (kinds, false, range.len()),
    }));
    joined(long.iter().flat_map(|Row { kinds, range, .. }| {
        let parts = list[range.start as usize..range.end as usize].chunk_by(|a, b| is_quad(a) == is_quad(b));
        parts.map(|part| (*kinds, part.len() >= LEAST && is_quad(&part[0]), part.len()))
    }))
}

/// Rows of kinds, whether they are quads, and how many of each: those that are alike are one.
fn joined(parts: impl Iterator<Item = (Kinds, bool, usize)>) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    let mut first = 0;
    for (kinds, are_quads, count) in parts {
        let range = first..first + count as u32;
        first = range.end;
        match rows.last_mut() {
            Some(last) if (last.kinds, last.are_quads) == (kinds, are_quads) => last.range.end = range.end,
            _ => rows.push(Row { kinds, are_quads, range }),
        }
    }
    rows
}

fn kind(primitive: &Primitive) -> u32 {
    primitive.ink >> 24 & !PAINTED
}

/// Whether a primitive has four corners: two triangles around the side from the first corner to the third, one alone, or a stroke.
fn is_quad(primitive: &Primitive) -> bool {
    let [a, _, c, d, e, f] = primitive.points;
    !matches!(kind(primitive), FILL | UNDER | CELL) || [a, c] == [d, e] || [a; 3] == [d, e, f]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::fills::{SHADOW, ink};

    #[test]
    fn what_is_alike_is_a_row_of_its_own_where_there_is_enough_of_it() {
        let list = [of(CELL | PAINTED, 100), of(FILL, 3), of(OUTLINE, 200), of(FILL, 60), of(UNDER, 40)].concat();
        let outlines = Row { are_quads: true, ..row(Kinds::Outlined, 103..303) };
        let expected = [row(Kinds::Cells, 0..100), row(Kinds::Outlined, 100..103), outlines];
        assert_eq!(rows(&list, 2), [expected.as_slice(), &[row(Kinds::Triangles, 303..403)]].concat());
        let bodies = [of(FILL, 20), of(OUTLINE, 30)].concat().repeat(2);
        assert_eq!(rows(&bodies, 2), [row(Kinds::Outlined, 0..100)], "triangles go with their outlines");
        assert_eq!(rows(&[of(SHADOW, 3), bodies].concat(), 2)[0], row(Kinds::Any, 0..3));
        let list = [of(FILL, 2), of(OUTLINE, 3)].concat();
        assert_eq!(rows(&list, 2), [row(Kinds::Any, 0..5)]);
        assert_eq!(rows(&list, 3), [row(Kinds::Triangles, 0..2), row(Kinds::Any, 2..5)], "they write their depth");
        assert_eq!(rows(&[], 2), []);
    }

    #[test]
    fn triangles_that_share_a_side_have_four_corners_where_there_are_enough() {
        let quads = |count: usize| vec![Primitive { points: [4, 5, 6, 4, 6, 7], ink: ink(FILL, [9; 3]) }; count];
        let alone = Primitive { points: [4, 5, 6, 4, 4, 4], ink: ink(FILL, [9; 3]) };
        let list = [quads(99), vec![alone], of(FILL, 1), quads(LEAST - 1)].concat();
        let expected = [Row { are_quads: true, ..row(Kinds::Triangles, 0..100) }, row(Kinds::Triangles, 100..196)];
        assert_eq!(rows(&list, 2), expected);
        assert_eq!(rows(&quads(3), 2), [row(Kinds::Any, 0..3)]);
    }

    fn of(kind: u32, count: usize) -> Vec<Primitive> {
        vec![Primitive { points: [0, 1, 2, 3, 4, 5], ink: ink(kind, [9; 3]) }; count]
    }

    fn row(kinds: Kinds, range: Range<u32>) -> Row {
        Row { kinds, are_quads: false, range }
    }
}
