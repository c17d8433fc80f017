//! Contours to polygons: as few points as the spacing asks for, as close to the contour as the tolerance.

mod corners;
mod count;
mod crossing;
mod path;
mod sample;
mod settle;

pub(super) use count::about_points;
pub(super) use crossing::Bins;

use super::contour::Loop;
use super::plane::Point;
use crossing::crossing_loops;
use path::Path;
use sample::sampled;

/// The polygons that bound the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Boundary {
    /// Points of each loop, in the order of the contours: the ink lies to the left in (x, y).
    pub loops: Vec<Vec<Point>>,
    /// Largest distance between contour and polygon, measured both ways `[px]`.
    pub deviation: f64,
    /// Loops that had to follow their contour closer than the spacing asks for, as they would have crossed.
    pub tightened: usize,
}

/// How far the polygons may be from the contours `[px]`: a twelfth of the spacing, which the eye does not see on a mesh,
/// but no less than half a pixel, for a contour of two values is no truer, and no more than two.
pub fn tolerance(spacing: f64) -> f64 {
    (spacing / 12.0).clamp(0.5, 2.0)
}

/// How often the tolerance of a loop is halved before its contour is taken as it is.
const HALVINGS: u32 = 4;

/// Points on the contours, evenly between corners, with the area of the contours.
///
/// Model: see `sampled`. Loops that cross, or touch, any loop get half the tolerance and half the spacing, again and
/// again; at last they are their contour. Contours never cross.
/// Valid range: `strictness` 0 begins with the full tolerance, each one more with half of it; above 4 all contours are
/// taken as they are.
pub fn boundary(contours: &[Loop], spacing: f64, strictness: u32) -> Boundary {
    let paths: Vec<Path<'_>> = contours.iter().map(|one| Path::new(&one.points)).collect();
    let mut levels = vec![strictness; paths.len()];
    let sample = |k: usize, level: u32| {
        if level > HALVINGS {
            return (contours[k].points.clone(), 0.0);
        }
        let share = 0.5_f64.powi(level as i32);
        sampled(&paths[k], share * spacing, share * tolerance(spacing))
    };
    let (mut loops, mut deviations): (Vec<_>, Vec<_>) = (0..paths.len()).map(|k| sample(k, strictness)).unzip();
    loop {
        let crossing = crossing_loops(&loops);
        let mut changed = false;
        for k in crossing.into_iter().filter(|&k| levels[k] <= HALVINGS).collect::<Vec<_>>() {
            levels[k] += 1;
            (loops[k], deviations[k]) = sample(k, levels[k]);
            changed = true;
        }
        if !changed {
            break;
        }
    }
    let tightened = levels.iter().filter(|&&level| level > strictness).count();
    Boundary { loops, deviation: deviations.into_iter().fold(0.0, f64::max), tightened }
}
