//! What is to be reached: how many times cheaper than the baseline the best method is, at equal error.

/// A ratio baseline/best at each of [`LEVELS`]; infinite where the baseline never gets there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// The problem.
    pub problem: &'static str,
    /// Ratio at each error `[1]`.
    pub ratios: [f64; 2],
}

/// The errors that methods are compared at `[m]`.
pub const LEVELS: [f64; 2] = [1e-3, 1e-6];

/// The share of a target at which it counts as reached: machines are noisy.
pub const REACHED: f64 = 0.8;

/// Ratios that prototypes of the methods reached; problems that are not here are reported without a target.
pub const TARGETS: [Target; 19] = [
    target("A2_drag", 35.0, 15_000.0),
    target("B1_osc", 14.0, 3_900.0),
    target("B2_osc_damped", 1.5, 700.0),
    target("B5_elastic_pendulum", 46.0, 17_000.0),
    target("B7_stiff_pendulum_1e6", 0.8, 740.0),
    target("C1_circle", 2.3, 61.0),
    target("D1_pendulum90", 2_300.0, 620_000.0),
    target("E1_double", 670.0, 190_000.0),
    target("F1_chain10", 83.0, 78_000.0),
    target("G1_lattice_small", 2.9, 510.0),
    target("G2_lattice_moderate", 28.0, 7_300.0),
    target("H1_catenary_rigid", 3.5, 119.0),
    target("I1_rim_free", 9.6, 2_500.0),
    target("I3_rim_floor", 7.3, 180.0),
    target("I5_rim_rigid", 50.0, 11_000.0),
    target("J1_heavy_1000", 260.0, 200_000.0),
    target("K3_rim_mouse", 4.7, 950.0),
    target("M1_bounce", f64::INFINITY, f64::INFINITY),
    target("N6_cloth5", 2.9, 1_100.0),
];

const fn target(problem: &'static str, coarse: f64, fine: f64) -> Target {
    Target { problem, ratios: [coarse, fine] }
}

/// The ratios to reach on a problem, if it has any.
pub fn target_of(problem: &str) -> Option<&'static Target> {
    TARGETS.iter().find(|target| target.problem == problem)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::problems;

    #[test]
    fn every_target_is_of_a_problem() {
        for target in TARGETS {
            assert!(problems::find(target.problem).is_ok(), "{}", target.problem);
        }
        assert_eq!(target_of("A1_freefall"), None);
    }
}
