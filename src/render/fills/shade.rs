//! What fills are shaded by, a row a point: its normal in space, and the mean strain of its bonds.

use crate::render::forms::acting;
use crate::render::gpu_bond::GpuBond;

/// A row as the shader reads it: a unit normal (0 in the plane) and a strain `[1]`.
pub(super) type Shade = [f32; 4];

/// The rows of all points at some places, `D` numbers a point.
///
/// Shapes: `triangles` by points; their normals weigh by their areas. `bonds`: empty where no strain is shown.
pub(super) fn shades<const D: usize>(
    places: &[[f32; D]],
    triangles: [&[[u32; 3]]; 2],
    bonds: &[GpuBond],
    to: &mut Vec<Shade>,
) {
    to.clear();
    to.resize(places.len(), [0.0; 4]);
    if D == 3 {
        normals(places, triangles, to);
    }
    strains(places, bonds, to);
}

fn normals<const D: usize>(places: &[[f32; D]], triangles: [&[[u32; 3]]; 2], to: &mut [Shade]) {
    let at = |point: u32| glam::Vec3::from_array(std::array::from_fn(|axis| places[point as usize][axis.min(D - 1)]));
    for corners in triangles.into_iter().flatten() {
        let [a, b, c] = corners.map(at);
        let normal = (b - a).cross(c - a);
        for &corner in corners {
            (0..3).for_each(|axis| to[corner as usize][axis] += normal[axis]);
        }
    }
    for row in to {
        let normal = glam::Vec3::new(row[0], row[1], row[2]).normalize_or_zero();
        row[..3].copy_from_slice(&normal.to_array());
    }
}

/// Adds the mean strain of each point's bonds; those without a rest length have none.
fn strains<const D: usize>(places: &[[f32; D]], bonds: &[GpuBond], to: &mut [Shade]) {
    if bonds.is_empty() {
        return;
    }
    let mut counts = vec![0_u16; places.len()];
    for bond in bonds.iter().filter(|bond| bond.rest_length > 0.0) {
        let [a, b] = [bond.a as usize, bond.b as usize];
        let length = (0..D).map(|axis| (places[a][axis] - places[b][axis]).powi(2)).sum::<f32>().sqrt();
        for end in [a, b] {
            to[end][3] += acting(bond.form, length / bond.rest_length - 1.0);
            counts[end] = counts[end].saturating_add(1);
        }
    }
    for (row, count) in to.iter_mut().zip(counts) {
        row[3] /= f32::from(count.max(1));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_have_the_normal_of_their_surface_and_the_strain_of_their_bonds() {
        let places = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [9.0, 9.0, 9.0]];
        let bonds = [GpuBond::new(0, 1, 1.0), GpuBond::new(0, 2, 4.0), GpuBond::new(0, 3, 0.0)];
        let mut to = vec![[7.0; 4]];
        shades(&places, [&[[0, 1, 2]], &[]], &bonds, &mut to);
        assert_eq!(to, [[0.0, 0.0, 1.0, 0.25], [0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0, -0.5], [0.0; 4]]);
        shades(&[[0.0, 0.0], [0.5, 0.0]], [&[], &[]], &[GpuBond::new(0, 1, 1.0)], &mut to);
        assert_eq!(to, [[0.0, 0.0, 0.0, -0.5]; 2]);
    }
}
