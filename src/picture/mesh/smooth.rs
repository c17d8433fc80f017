//! Guarded smoothing: points move to where their triangles are best.

use super::super::plane::{Point, between, dot, minus, turn};
use super::delaunay::Filled;

/// One sweep over the free points.
///
/// Model: a point moves to the mean of the circumcentres of the triangles around it, weighted by their areas, which
/// lowers the error with which the mesh interpolates a parabola (optimal Delaunay triangulation); if that makes no
/// worst angle better, half as far; else it stays. No triangle ever turns over, and none grows above `max_area` `[px^2]`.
/// Source: L. Chen, J. Xu, "Optimal Delaunay triangulations" (2004), with P. Alliez et al. (2005), eq. 5.
pub(super) fn smooth(filled: &mut Filled, max_area: Option<f64>) {
    let triangles = &filled.triangles[..filled.new_triangles];
    let (starts, members) = triangles_around(triangles, filled.points.len());
    let limit = 2.0 * max_area.unwrap_or(f64::INFINITY);
    let mut star: Vec<[Point; 2]> = Vec::new();
    for k in 0..filled.points.len() {
        let around = &members[starts[k] as usize..starts[k + 1] as usize];
        if !filled.is_free[k] || around.is_empty() {
            continue;
        }
        star.clear();
        star.extend(around.iter().map(|&t| opposite(&triangles[t as usize], k as u32, &filled.points)));
        let here = filled.points[k];
        let before = worst(here, &star, f64::INFINITY);
        let Some(target) = centre(here, &star) else { continue };
        for share in [1.0, 0.5] {
            let place = between(here, target, share);
            if worst(place, &star, limit) < before {
                filled.points[k] = place;
                break;
            }
        }
    }
}

/// Where the triangles of each point begin, and, one more, where those of the last end; and the triangles.
fn triangles_around(triangles: &[[u32; 3]], count: usize) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0; count + 1];
    triangles.iter().flatten().for_each(|&k| starts[k as usize + 1] += 1);
    (0..count).for_each(|k| starts[k + 1] += starts[k]);
    let mut free = starts.clone();
    let mut members = vec![0; 3 * triangles.len()];
    for (t, corners) in triangles.iter().enumerate() {
        for &k in corners {
            members[free[k as usize] as usize] = t as u32;
            free[k as usize] += 1;
        }
    }
    (starts, members)
}

/// The side of a triangle that faces a corner of it, turning left seen from there.
fn opposite(corners: &[u32; 3], k: u32, points: &[Point]) -> [Point; 2] {
    let at = (0..3).find(|&at| corners[at] == k).unwrap_or(0);
    [1, 2].map(|step| points[corners[(at + step) % 3] as usize])
}

/// The worst of the triangles around a point: the squared cosine of the smallest angle, which is below 60 degrees;
/// infinite if one is turned over, or larger than half of `limit`.
fn worst(point: Point, star: &[[Point; 2]], limit: f64) -> f64 {
    let mut worst = 0.0;
    for &[a, b] in star {
        let doubled = turn(point, a, b);
        if doubled <= 0.0 || doubled > limit {
            return f64::INFINITY;
        }
        let sides = [minus(b, a), minus(a, point), minus(point, b)].map(|side| dot(side, side));
        let shortest = sides[0].min(sides[1]).min(sides[2]);
        let longest = sides[0].max(sides[1]).max(sides[2]);
        let middle = sides[0] + sides[1] + sides[2] - shortest - longest;
        let other = middle + longest - shortest;
        worst = f64::max(worst, other * other / (4.0 * middle * longest));
    }
    worst
}

/// Mean of the circumcentres, weighted by areas; none if that is no number.
fn centre(point: Point, star: &[[Point; 2]]) -> Option<Point> {
    let (mut sum, mut total) = ([0.0; 2], 0.0);
    for &[a, b] in star {
        let (u, v) = (minus(a, point), minus(b, point));
        // The circumcentre from the corner, times four times the area.
        let (uu, vv) = (dot(u, u), dot(v, v));
        sum[0] += uu * v[1] - vv * u[1];
        sum[1] += vv * u[0] - uu * v[0];
        total += u[0] * v[1] - u[1] * v[0];
    }
    let place = [point[0] + 0.5 * sum[0] / total, point[1] + 0.5 * sum[1] / total];
    (total > 0.0 && place.iter().all(|x| x.is_finite())).then_some(place)
}
