//! Young's modulus of a sheet of springs, as the key `young` has it.

/// Stiffness of the springs of a triangular lattice over its Young's modulus in the plane: sqrt(3)/2, at any spacing.
///
/// Source: a lattice of springs k has the Lame constants lambda = mu = sqrt(3)/4 k, and E = 4 mu (lambda + mu)/(lambda + 2 mu).
const STIFFNESS_OF_YOUNG: f64 = 0.866_025_403_784_438_6;

/// The stiffness of each spring `[N/m]` of a net of even triangles with a Young's modulus in the plane, which is that of the matter times its
/// thickness `[N/m]`.
pub(crate) fn stiffness_of_young(young: f64) -> f64 {
    STIFFNESS_OF_YOUNG * young
}

/// Young's modulus in the plane of a net of even triangles of springs of a stiffness `[N/m]`.
pub(crate) fn young_of_stiffness(stiffness: f64) -> f64 {
    stiffness / STIFFNESS_OF_YOUNG
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_net_of_springs_has_the_modulus_of_its_lame_constants() {
        for stiffness in [0.0, 3.0, 4e5] {
            let lame = 0.25 * 3.0_f64.sqrt() * stiffness;
            let young = if lame > 0.0 { 4.0 * lame * (lame + lame) / (lame + 2.0 * lame) } else { 0.0 };
            assert!((young_of_stiffness(stiffness) - young).abs() <= 1e-12 * young);
            assert!((stiffness_of_young(young) - stiffness).abs() <= 1e-12 * stiffness);
        }
    }
}
