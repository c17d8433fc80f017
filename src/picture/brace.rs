//! Which triangles lie side by side, and bonds across such pairs, which keep them from folding.

use super::PictureMesh;

/// A bond between the far corners of two triangles that share a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Brace {
    /// Its points, the lower number first.
    pub ends: [u32; 2],
    /// The triangles.
    pub triangles: [u32; 2],
}

impl PictureMesh {
    /// For each side of a triangle, in the order of the bonds, the triangles that it belongs to: two, or one at the boundary.
    pub fn beside(&self) -> Vec<[Option<u32>; 2]> {
        let sides = &self.bonds[..self.mesh_bonds];
        let mut beside = vec![[None; 2]; sides.len()];
        for (number, &[a, b, c]) in (0..).zip(&self.triangles) {
            for [p, q] in [[a, b], [b, c], [c, a]] {
                if let Ok(side) = sides.binary_search(&[p.min(q), p.max(q)]) {
                    let pair: &mut [Option<u32>; 2] = &mut beside[side];
                    pair[usize::from(pair[0].is_some())] = Some(number);
                }
            }
        }
        beside
    }

    /// A brace for every pair of triangles that share a side, sorted by their ends; none where the far corners are bonded already.
    pub fn braces(&self) -> Vec<Brace> {
        let sides = &self.bonds[..self.mesh_bonds];
        let far = |triangle: u32, side: &[u32; 2]| {
            self.triangles[triangle as usize].into_iter().find(|corner| !side.contains(corner))
        };
        let mut braces = Vec::with_capacity(sides.len());
        for (side, beside) in sides.iter().zip(self.beside()) {
            let [Some(s), Some(t)] = beside else { continue };
            let (Some(p), Some(q)) = (far(s, side), far(t, side)) else { continue };
            let ends = [p.min(q), p.max(q)];
            if p != q && sides.binary_search(&ends).is_err() {
                braces.push(Brace { ends, triangles: [s, t] });
            }
        }
        braces.sort_unstable_by_key(|brace| (brace.ends, brace.triangles));
        braces.dedup_by_key(|brace| brace.ends);
        braces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wheel: `count` points around one.
    fn wheel(count: u32) -> PictureMesh {
        let triangles = (1..=count).map(|k| [0, k, 1 + k % count]).collect();
        let mut bonds: Vec<[u32; 2]> = (1..=count).map(|k| [0, k]).collect();
        bonds.extend((1..=count).map(|k| [k.min(1 + k % count), k.max(1 + k % count)]));
        bonds.sort_unstable();
        PictureMesh { mesh_bonds: bonds.len(), triangles, bonds, ..PictureMesh::default() }
    }

    #[test]
    fn a_brace_joins_far_corners_that_nothing_joins() {
        let ends = |count| wheel(count).braces().iter().map(|brace| brace.ends).collect::<Vec<_>>();
        assert_eq!(ends(6), [[1, 3], [1, 5], [2, 4], [2, 6], [3, 5], [4, 6]]);
        assert_eq!(ends(4), [[1, 3], [2, 4]], "two pairs have the same far corners");
        assert_eq!(ends(3), [[0; 2]; 0], "the far corners of each pair are neighbours");
        let wheel = wheel(6);
        let braces = wheel.braces();
        assert!(braces.iter().all(|brace| {
            let [p, q] = brace.triangles.map(|k| wheel.triangles[k as usize]);
            p.contains(&brace.ends[0]) != q.contains(&brace.ends[0])
        }));
        assert_eq!(wheel.beside().iter().filter(|pair| pair[1].is_none()).count(), 6, "the boundary");
    }
}
