//! What fills are shaded by, a row a point: its normal in space, and the mean strain of its bonds. At an edge a normal is short: the shader
//! shades by the triangle there.

use crate::render::forms::acting;
use crate::render::gpu_bond::GpuBond;

/// A row as the shader reads it: a normal (0 in the plane) and a strain `[1]`.
pub(super) type Shade = [f32; 4];

/// Cosines of the angle between the normal of a point and that of a triangle there from which on it is an edge, and up to which the surface
/// is round: 45° are those at the edge of a box, 20° those of a ball of some thirty points.
const ROUND: [f32; 2] = [0.80, 0.94];

/// The rows of all points at some places, `D` numbers a point.
///
/// Model: the unit mean of a point's triangles, times 1 where it is near to all of them that enclose a volume, 0
/// where one is turned off it as at the edge of a box.
///
/// Shapes: `triangles` by points, of bodies without a picture and with one, then those of both that enclose a volume; their normals weigh by their
/// areas. `bonds`: empty where no strain is shown.
pub(super) fn shades<const D: usize>(
    places: &[[f32; D]],
    triangles: [&[[u32; 3]]; 3],
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

fn normals<const D: usize>(places: &[[f32; D]], [bare, worn, enclosing]: [&[[u32; 3]]; 3], to: &mut [Shade]) {
    let at = |point: u32| glam::Vec3::from_array(std::array::from_fn(|axis| places[point as usize][axis.min(D - 1)]));
    for corners in [bare, worn].into_iter().flatten() {
        let [a, b, c] = corners.map(at);
        let normal = (b - a).cross(c - a);
        for &corner in corners {
            (0..3).for_each(|axis| to[corner as usize][axis] += normal[axis]);
        }
    }
    let mean = |row: &Shade| glam::Vec3::new(row[0], row[1], row[2]).normalize_or_zero();
    for row in to.iter_mut() {
        let normal = mean(row);
        row[..3].copy_from_slice(&normal.to_array());
    }
    // The cosine of the largest angle between a point's normal and those of its triangles.
    let mut least = vec![1.0_f32; to.len()];
    for corners in enclosing {
        let [a, b, c] = corners.map(at);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for &corner in corners.iter().filter(|_| normal != glam::Vec3::ZERO) {
            let place = corner as usize;
            least[place] = least[place].min(normal.dot(mean(&to[place])));
        }
    }
    for (row, least) in to.iter_mut().zip(least) {
        let share = ((least - ROUND[0]) / (ROUND[1] - ROUND[0])).clamp(0.0, 1.0);
        (0..3).for_each(|axis| row[axis] *= share);
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
        shades(&places, [&[[0, 1, 2]], &[], &[]], &bonds, &mut to);
        assert_eq!(to, [[0.0, 0.0, 1.0, 0.25], [0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0, -0.5], [0.0; 4]]);
        shades(&[[0.0, 0.0], [0.5, 0.0]], [&[], &[], &[]], &[GpuBond::new(0, 1, 1.0)], &mut to);
        assert_eq!(to, [[0.0, 0.0, 0.0, -0.5]; 2]);
    }

    /// The lengths of the normals in a roof of two squares, whose halves lie so steep.
    fn of_roof(angle: f32, is_sheet: bool) -> Vec<f32> {
        let [across, low] = [angle.cos(), -angle.sin()];
        let places = [
            [-across, low, 0.0],
            [0.0, 0.0, 0.0],
            [across, low, 0.0],
            [-across, low, 1.0],
            [0.0, 0.0, 1.0],
            [across, low, 1.0],
        ];
        let mut to = Vec::new();
        let roof = [[0, 4, 1], [0, 3, 4], [1, 5, 2], [1, 4, 5]];
        shades(&places, [&roof, &[], if is_sheet { &[] } else { &roof }], &[], &mut to);
        to.iter().map(|row| glam::Vec3::new(row[0], row[1], row[2]).length()).collect()
    }

    #[test]
    fn sharp_edges_are_flat_and_round_surfaces_are_not() {
        let [flat, round, sharp] = [0.0, 0.25, std::f32::consts::FRAC_PI_4].map(|angle| of_roof(angle, false));
        assert!(
            of_roof(std::f32::consts::FRAC_PI_4, true).iter().all(|length| (length - 1.0).abs() < 1e-5),
            "a fold of a cloth"
        );
        assert!(flat.iter().chain(&round).all(|length| (length - 1.0).abs() < 1e-5), "{flat:?} {round:?}");
        assert!(sharp[1] == 0.0 && sharp[4] == 0.0, "the ridge: {sharp:?}");
        assert!([0, 2, 3, 5].iter().all(|&point| (sharp[point] - 1.0).abs() < 1e-5), "beside it: {sharp:?}");
    }
}
