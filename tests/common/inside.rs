//! How deep points are in what is solid, worked out from their places alone.

use wobble::sim::{Dynamics, Figure, Sample};

/// A vector less another.
pub fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The length of a vector.
pub fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// How deep the deepest point that is not pinned is in walls, planes, polygons, balls or boxes `[m]`.
pub fn deepest(world: &dyn Dynamics, sample: &Sample) -> f64 {
    let dimensions = world.dimensions();
    let mut is_free = vec![true; sample.position.len()];
    world.pinned().iter().for_each(|pin| is_free[pin.index()] = false);
    let planes = world.planes();
    let mut most = 0.0_f64;
    for (&x, _) in sample.position.iter().zip(&is_free).filter(|(_, is_free)| **is_free) {
        if let Some([low, high]) = world.bounds() {
            most = (0..dimensions).map(|k| (low[k] - x[k]).max(x[k] - high[k])).fold(most, f64::max);
        }
        most = planes.iter().map(|[at, normal]| dot(sub(*at, x), *normal)).fold(most, f64::max);
        most = world.polygons().iter().map(|polygon| within_loops(&polygon.loops, [x[0], x[1]])).fold(most, f64::max);
        most = world.convex().iter().map(|convex| within_figure(&convex.figure, x)).fold(most, f64::max);
    }
    most
}

/// How far inside of loops, even-odd, a place is `[m]`; 0 outside.
fn within_loops(loops: &[Vec<[f64; 2]>], x: [f64; 2]) -> f64 {
    let (mut is_inside, mut nearest) = (false, f64::INFINITY);
    for corners in loops {
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            if (a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
                is_inside = !is_inside;
            }
            let [along, off] = [[b[0] - a[0], b[1] - a[1]], [x[0] - a[0], x[1] - a[1]]];
            let share =
                ((off[0] * along[0] + off[1] * along[1]) / (along[0].powi(2) + along[1].powi(2))).clamp(0.0, 1.0);
            nearest = nearest.min((off[0] - share * along[0]).hypot(off[1] - share * along[1]));
        }
    }
    if is_inside { nearest } else { 0.0 }
}

/// How far inside of a ball or a box a place is `[m]`; below 0 outside.
fn within_figure(figure: &Figure, x: [f64; 3]) -> f64 {
    match figure {
        Figure::Ball { center, radius } => radius - length(sub(x, *center)),
        Figure::Box { .. } => figure.frame().map_or(f64::NEG_INFINITY, |frame| {
            let off = sub(x, frame.center);
            (0..3).map(|k| frame.half[k] - dot(off, frame.axes[k]).abs()).fold(f64::INFINITY, f64::min)
        }),
    }
}
