//! How much of a patch of bonds is drawn that are too short on the screen to be told apart.
//!
//! Strokes that are shorter than they are wide are dots that lie on each other in heaps. From [`FULL`] widths on they
//! are left out one by one as the camera goes away, and dots that each stand for many take their place, until at
//! [`DOTS`] widths there are dots alone: as many as cover what the bonds covered.

/// Length of a bond, in widths of a stroke, from which on every bond is drawn.
const FULL: f64 = 1.8;
/// Length below which dots alone are drawn. Between the two strokes and dots are mixed, so that nothing pops.
const DOTS: f64 = 0.9;
/// How many dots of a surface lie over each other on average: evenly spread as they are, fewer would leave holes.
const LAYERS: f64 = 3.0;
/// The same for strings, in which a gap is seen sooner.
const STRING_LAYERS: f64 = 4.0;
/// Bonds for each point that they end at from which on a patch is a surface, not a heap of strings: strings have 1, a
/// square grid 2, less what its edge takes.
const SURFACE: f64 = 1.6;

/// Shares of a patch's bonds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Detail {
    /// Drawn as strokes `[1]`.
    pub(super) strokes: f64,
    /// Drawn as dots `[1]`.
    pub(super) dots: f64,
}

impl Detail {
    /// Every bond a stroke.
    pub(super) const ALL: Detail = Detail { strokes: 1.0, dots: 0.0 };

    /// For bonds `length` long and `width` wide on the screen `[px]`, so many to a point, with dots of `radius` `[px]`.
    ///
    /// Valid range: a length that is not a number gets every bond drawn.
    pub(super) fn new(length: f64, width: f64, per_point: f64, radius: f64) -> Self {
        let widths = length / width;
        if !(0.0..FULL).contains(&widths) {
            return Detail::ALL;
        }
        let strokes = ((widths - DOTS) / (FULL - DOTS)).max(0.0);
        let along = length * width;
        let covered =
            if is_surface(per_point) { LAYERS * along.min(length * length / per_point) } else { STRING_LAYERS * along };
        let dots = covered / (std::f64::consts::PI * radius * radius);
        Detail { strokes, dots: (1.0 - strokes) * dots.min(1.0) }
    }
}

/// Whether bonds, so many to a point, span a surface.
pub(super) fn is_surface(per_point: f64) -> bool {
    per_point >= SURFACE
}

/// Radius of dots `[px]` for strokes of a width: a dot of a string is as wide as it; in a surface larger ones are fewer,
/// and its edge moves by half a width, which is less than a pixel or two.
pub(super) fn dot_radius(width: f32, is_surface: bool) -> f32 {
    if is_surface { width } else { 0.5 * width }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_bonds_are_all_drawn_and_short_ones_become_dots() {
        assert_eq!(Detail::new(3.3, 1.8, 4.0, 1.8), Detail::ALL);
        assert_eq!(Detail::new(f64::NAN, 1.8, 4.0, 1.8), Detail::ALL);
        let short = Detail::new(0.7, 1.8, 4.0, 1.8);
        assert_eq!(short.strokes, 0.0);
        assert!(short.dots > 0.0 && short.dots < 0.06, "{short:?}");
        assert_eq!(Detail::new(0.0, 1.8, 4.0, 1.8), Detail { strokes: 0.0, dots: 0.0 }, "nothing to see");
    }

    #[test]
    fn a_string_keeps_enough_dots_to_hang_together() {
        for length in [0.05, 0.2, 0.6, 1.0] {
            let string = Detail::new(length, 1.8, 1.0, 0.9);
            let apart = length / (string.strokes + string.dots);
            assert!(apart <= 1.8, "{length} px long, {apart} px apart");
        }
    }

    #[test]
    fn shares_change_without_a_jump() {
        let mut last = Detail::new(0.0, 1.8, 4.0, 1.8);
        for step in 1..4000 {
            let next = Detail::new(f64::from(step) * 1e-3, 1.8, 4.0, 1.8);
            assert!((next.strokes - last.strokes).abs() < 2e-3 && (next.dots - last.dots).abs() < 2e-3, "{step}");
            last = next;
        }
    }
}
