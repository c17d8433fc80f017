//! The connected parts of a mesh, each by itself.

use super::{PictureMesh, Point};

impl PictureMesh {
    /// Number and area `[px^2]` of each connected part, the largest first.
    pub fn parts(&self) -> Vec<(u32, f64)> {
        let mut parts: Vec<(u32, f64)> = (0..self.components as u32).map(|number| (number, 0.0)).collect();
        for (&number, area) in self.component.iter().zip(&self.areas) {
            parts[number as usize].1 += area;
        }
        parts.sort_by(|a, b| b.1.total_cmp(&a.1));
        parts
    }

    /// One of the parts as a mesh of its own, that lies in the picture where it lay.
    ///
    /// Valid range: a number of [`PictureMesh::parts`]; the mesh of any other is empty.
    pub fn part(&self, number: u32) -> PictureMesh {
        let is_in = |point: u32| self.component[point as usize] == number;
        let kept: Vec<u32> = (0..self.points.len() as u32).filter(|&point| is_in(point)).collect();
        let mut place = vec![0; self.points.len()];
        (0..).zip(&kept).for_each(|(new, &old)| place[old as usize] = new);
        let move_to = |old: u32| place[old as usize];
        let of = |bonds: &[[u32; 2]]| {
            bonds.iter().filter(|bond| is_in(bond[0])).map(|bond| bond.map(move_to)).collect::<Vec<_>>()
        };
        let (sides, ropes) = self.bonds.split_at(self.mesh_bonds);
        let (mut bonds, ropes) = (of(sides), of(ropes));
        let mesh_bonds = bonds.len();
        bonds.extend(ropes);
        let triangles = self.triangles.iter().filter(|corners| is_in(corners[0]));
        let loops = self.loops.iter().filter(|points| points.first().is_some_and(|&point| is_in(point)));
        PictureMesh {
            picture: self.picture,
            points: kept.iter().map(|&old| self.points[old as usize]).collect::<Vec<Point>>(),
            mesh_points: kept.partition_point(|&old| (old as usize) < self.mesh_points),
            triangles: triangles.map(|corners| corners.map(move_to)).collect(),
            bonds,
            mesh_bonds,
            loops: loops.map(|points| points.iter().map(|&old| move_to(old)).collect()).collect(),
            component: vec![0; kept.len()],
            components: usize::from(!kept.is_empty()),
            texture: kept.iter().map(|&old| self.texture[old as usize]).collect(),
            areas: kept.iter().map(|&old| self.areas[old as usize]).collect(),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use crate::picture::{Picture, Settings, mesh_picture};

    /// A disc, a larger one, and a stroke that ends in neither.
    #[test]
    fn parts_are_the_mesh_again_the_largest_first() {
        let mut picture = Picture::filled(240, 120, [0; 4]);
        for i in 0..240 * 120 {
            let [x, y] = [i % 240, i / 240].map(|at| at as f64 + 0.5);
            let is_ink = (x - 40.0).hypot(y - 60.0) < 25.0
                || (x - 130.0).hypot(y - 60.0) < 45.0
                || ((x - 210.0).abs() < 1.5 && (y - 60.0).abs() < 40.0);
            picture.rgba[4 * i + 3] = if is_ink { 255 } else { 0 };
        }
        let whole = mesh_picture(&picture, &Settings::default()).unwrap().mesh;
        let parts = whole.parts();
        assert_eq!(parts.len(), 3);
        assert!(parts.is_sorted_by(|a, b| a.1 >= b.1));
        let made: Vec<_> = parts.iter().map(|part| whole.part(part.0)).collect();
        let middle = |k: usize| made[k].points.iter().map(|at| at[0]).sum::<f64>() / made[k].points.len() as f64;
        assert!((middle(0) - 130.0).abs() < 3.0 && (middle(1) - 40.0).abs() < 3.0 && (middle(2) - 210.0).abs() < 3.0);
        let sum = |count: fn(&crate::picture::PictureMesh) -> usize| made.iter().map(count).sum::<usize>();
        assert_eq!(sum(|mesh| mesh.points.len()), whole.points.len());
        assert_eq!(sum(|mesh| mesh.triangles.len()), whole.triangles.len());
        assert_eq!(sum(|mesh| mesh.loops.len()), whole.loops.len());
        assert_eq!(sum(|mesh| mesh.mesh_bonds), whole.mesh_bonds);
        assert_eq!(sum(|mesh| mesh.bonds.len()), whole.bonds.len());
        assert!(made[2].mesh_points == 0 && made[2].triangles.is_empty(), "a rope");
        for (mesh, part) in made.iter().zip(&parts) {
            assert!((mesh.areas.iter().sum::<f64>() - part.1).abs() < 1e-9 * part.1);
            let is_bonded = |[a, b]: [u32; 2]| mesh.bonds[..mesh.mesh_bonds].contains(&[a.min(b), a.max(b)]);
            assert!(mesh.triangles.iter().all(|&[a, b, c]| [[a, b], [b, c], [c, a]].into_iter().all(is_bonded)));
        }
        assert_eq!(whole.part(3).points.len(), 0);
    }
}
