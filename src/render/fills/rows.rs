//! Which primitives of fills are drawn by a shader that knows them alone: a driver without a GPU works out what each kind would be for every
//! corner and every pixel. Of two triangles that share a side it works out four corners, not six, where it is told so.

use std::ops::Range;

use super::{CELL, FILL, PAINTED, Primitive, UNDER};

/// Which kinds a pipeline draws: `KINDS` in common.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::render) enum Kinds {
    /// All of them, in the order that they come in.
    Any,
    /// Triangles of bodies.
    Triangles,
    /// Cells of nets.
    Cells,
}

impl Kinds {
    /// All of them, in the order of their numbers in the shader.
    pub(in crate::render) const ALL: [Kinds; 3] = [Kinds::Any, Kinds::Triangles, Kinds::Cells];

    fn of(primitive: &Primitive) -> Self {
        match primitive.ink >> 24 & !PAINTED {
            FILL | UNDER => Kinds::Triangles,
            CELL => Kinds::Cells,
            _ => Kinds::Any,
        }
    }
}

/// Primitives in a row that are drawn in one go.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) kinds: Kinds,
    /// Each is two triangles that share a side, the first corner of both and the last of the first, and so has four corners.
    pub(super) are_quads: bool,
    /// Their places in the list.
    pub(super) range: Range<u32>,
}

/// Primitives from which on a row of their own costs less than it spares.
const LEAST: usize = 96;

/// The rows that a list is drawn in: what is alike lies in one where there is enough of it. In space triangles are always drawn by themselves:
/// they alone write their depth.
pub(super) fn rows(list: &[Primitive], dimensions: usize) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    let mut add = |row: Row| match rows.last_mut() {
        Some(last) if (last.kinds, last.are_quads) == (row.kinds, row.are_quads) => last.range.end = row.range.end,
        _ => rows.push(row),
    };
    let mut first = 0;
    for alike in list.chunk_by(|a, b| Kinds::of(a) == Kinds::of(b)) {
        let own = Kinds::of(&alike[0]);
        let kinds = if alike.len() < LEAST && dimensions == 2 { Kinds::Any } else { own };
        for part in alike.chunk_by(|a, b| is_quad(a) == is_quad(b)) {
            let are_quads = kinds != Kinds::Any && part.len() >= LEAST && is_quad(&part[0]);
            let range = first..first + part.len() as u32;
            first = range.end;
            add(Row { kinds, are_quads, range });
        }
    }
    rows
}

/// Whether two triangles are a quad around the side from the first corner to the third.
fn is_quad(&Primitive { points: [a, _, c, d, e, _], .. }: &Primitive) -> bool {
    [a, c] == [d, e]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::fills::{OUTLINE, ink};

    #[test]
    fn what_is_alike_is_a_row_of_its_own_where_there_is_enough_of_it() {
        let list = [of(CELL | PAINTED, 100), of(FILL, 3), of(OUTLINE, 200), of(FILL, 60), of(UNDER, 40)].concat();
        let expected = [(Kinds::Cells, 0..100), (Kinds::Any, 100..303), (Kinds::Triangles, 303..403)];
        assert_eq!(rows(&list, 2), expected.map(|(kinds, range)| row(kinds, range)));
        let list = [of(FILL, 2), of(OUTLINE, 3)].concat();
        assert_eq!(rows(&list, 2), [row(Kinds::Any, 0..5)]);
        assert_eq!(rows(&list, 3), [row(Kinds::Triangles, 0..2), row(Kinds::Any, 2..5)], "they write their depth");
        assert_eq!(rows(&[], 2), []);
    }

    #[test]
    fn triangles_that_share_a_side_have_four_corners_where_there_are_enough() {
        let quads = |count: usize| vec![Primitive { points: [4, 5, 6, 4, 6, 7], ink: ink(FILL, [9; 3]) }; count];
        let list = [quads(100), of(FILL, 1), quads(LEAST - 1)].concat();
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
