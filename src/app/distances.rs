//! What colours of the distance between worlds side by side mean: from where on they are the last ones.

use crate::render::Camera;

/// The distance of the last colours beside the height of a scene `[1]`.
const FULL: f64 = 0.05;
/// The least distance of the last colours beside that `[1]`.
const LEAST_FULL: f64 = 1e-5;

/// The distance of the last colours, where the difference of two worlds is shown `[m]`: a round number near a twentieth of the scene's height.
pub fn full_distance(alone: &Camera) -> f64 {
    round_up(FULL * alone.height())
}

/// The same for distances that are `most` at most, where `usual` is that of the scene `[m]`: no more than it takes, from a hundred thousandth of
/// the usual one on, so that what rounding leaves stays grey.
pub fn round_distance(most: f32, usual: f32) -> f32 {
    let least = LEAST_FULL * f64::from(usual);
    round_up(f64::from(most).max(least)).min(f64::from(usual)) as f32
}

/// 1, 2 or 5 times a power of ten, not less than a number above 0.
fn round_up(wanted: f64) -> f64 {
    let decade = 10_f64.powf(wanted.log10().floor());
    let almost = wanted * (1.0 - 1e-6);
    [1.0, 2.0, 5.0].map(|step| step * decade).into_iter().find(|step| *step >= almost).unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::{round_distance, round_up};

    #[test]
    fn colours_of_distances_go_as_far_as_there_are_any() {
        let full = [0.0, 3e-6, 0.0012, 0.05, 0.3, 40.0].map(|most| round_distance(most, 0.5));
        assert_eq!(full.map(|full| format!("{full:e}")), ["5e-6", "5e-6", "2e-3", "5e-2", "5e-1", "5e-1"]);
        assert_eq!([0.05, 0.0007, 9.0].map(round_up), [0.05, 0.001, 10.0]);
    }
}
