//! The outline of the ink, finer than a pixel: marching squares.

use super::Coverage;
use super::bits::{Bits, ones};
use super::plane::{Point, doubled_area};

/// A closed contour: the ink lies to the left in (x, y), that is to the right as seen, for y points down.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// Points in order, the last is followed by the first `[px]`.
    pub points: Vec<Point>,
    /// Area `[px^2]`: positive about ink, negative about a hole.
    pub area: f64,
}

impl Loop {
    /// A loop through these points.
    pub fn new(points: Vec<Point>) -> Self {
        let area = 0.5 * doubled_area(&points);
        Loop { points, area }
    }
}

/// Where contours cross the lines between pixel centres, and which crossing follows each.
#[derive(Default)]
struct Crossings {
    points: Vec<Point>,
    next: Vec<u32>,
}

/// The contours of a coverage, in the order of their topmost, leftmost points.
///
/// Model: the value runs linearly between neighbouring pixel centres, which lie at (x + 1/2, y + 1/2), and around the
/// picture it is 0. Where two opposite corners of a cell of four are ink, they are joined when the mean of the four is
/// at least at the level: of two values, then, ink touches ink across corners.
/// No value lies on the level, so contours neither touch nor cross.
pub fn contours(coverage: &Coverage) -> Vec<Loop> {
    trace(coverage, &Bits::ink(coverage)).loops()
}

/// Contours of a coverage whose bits are at hand.
pub(super) fn contours_of(coverage: &Coverage, ink: &Bits) -> Vec<Loop> {
    trace(coverage, ink).loops()
}

/// Sides of a cell.
const TOP: u8 = 0;
const RIGHT: u8 = 1;
const BOTTOM: u8 = 2;
const LEFT: u8 = 3;

/// From which side to which the contour runs, by the corners that are ink: 1 = top left, 2 = top right, 4 = bottom
/// left, 8 = bottom right. Along the cell's edge (top, right, bottom, left) it starts where ink ends.
const RUNS: [&[[u8; 2]]; 16] = [
    &[],
    &[[TOP, LEFT]],
    &[[RIGHT, TOP]],
    &[[RIGHT, LEFT]],
    &[[LEFT, BOTTOM]],
    &[[TOP, BOTTOM]],
    &[[RIGHT, TOP], [LEFT, BOTTOM]],
    &[[RIGHT, BOTTOM]],
    &[[BOTTOM, RIGHT]],
    &[[TOP, LEFT], [BOTTOM, RIGHT]],
    &[[BOTTOM, TOP]],
    &[[BOTTOM, LEFT]],
    &[[LEFT, RIGHT]],
    &[[TOP, RIGHT]],
    &[[LEFT, TOP]],
    &[],
];

/// The same for two opposite corners that are joined.
const JOINED_FALLING: &[[u8; 2]] = &[[TOP, RIGHT], [BOTTOM, LEFT]];
const JOINED_RISING: &[[u8; 2]] = &[[LEFT, TOP], [RIGHT, BOTTOM]];

fn trace(coverage: &Coverage, ink: &Bits) -> Crossings {
    let mut found = Crossings::default();
    // The crossing on the line below each column, of the row of cells before.
    let mut above = vec![0; ink.width];
    for y in 0..ink.height - 1 {
        let (upper, lower) = (ink.row(y), ink.row(y + 1));
        let mut left = 0;
        for k in 0..ink.stride {
            let (a, b) = (upper[k], lower[k]);
            let after = |row: &[u64]| row.get(k + 1).map_or(0, |word| word << 63);
            let (c, d) = (a >> 1 | after(upper), b >> 1 | after(lower));
            for bit in ones((a | b | c | d) & !(a & b & c & d)) {
                let at = |word: u64, place: u8| ((word >> bit & 1) as u8) << place;
                let corners = at(a, 0) | at(c, 1) | at(b, 2) | at(d, 3);
                let x = 64 * k + bit;
                left = found.cell(coverage, [x, y], corners, [&mut above[x], &mut left]);
            }
        }
    }
    found
}

impl Crossings {
    /// Adds the crossings on the right and lower side of a cell and the runs through it; returns the one on the right.
    fn cell(&mut self, coverage: &Coverage, [x, y]: [usize; 2], corners: u8, known: [&mut u32; 2]) -> u32 {
        let value = |dx: usize, dy: usize| {
            let (x, y) = ((x + dx).wrapping_sub(1), (y + dy).wrapping_sub(1));
            let inside = x < coverage.width && y < coverage.height;
            if inside { f64::from(coverage.values[y * coverage.width + x]) } else { 0.0 }
        };
        let [above, left] = known;
        let mut sides = [*above, 0, 0, *left];
        let (iso, [x, y]) = (coverage.iso(), [x as f64 - 0.5, y as f64 - 0.5]);
        let ink = |corner: u8| corners >> corner & 1;
        if ink(1) != ink(3) {
            let (from, to) = (value(1, 0), value(1, 1));
            sides[usize::from(RIGHT)] = self.add([x + 1.0, y + (iso - from) / (to - from)]);
        }
        if ink(2) != ink(3) {
            let (from, to) = (value(0, 1), value(1, 1));
            sides[usize::from(BOTTOM)] = self.add([x + (iso - from) / (to - from), y + 1.0]);
            *above = sides[usize::from(BOTTOM)];
        }
        let runs = match corners {
            6 | 9 if value(0, 0) + value(1, 0) + value(0, 1) + value(1, 1) >= 4.0 * iso => {
                if corners == 9 {
                    JOINED_FALLING
                } else {
                    JOINED_RISING
                }
            }
            _ => RUNS[usize::from(corners)],
        };
        for [from, to] in runs {
            self.next[sides[usize::from(*from)] as usize] = sides[usize::from(*to)];
        }
        sides[usize::from(RIGHT)]
    }

    fn add(&mut self, point: Point) -> u32 {
        self.points.push(point);
        self.next.push(0);
        self.points.len() as u32 - 1
    }

    fn loops(mut self) -> Vec<Loop> {
        const DONE: u32 = u32::MAX;
        let mut loops = Vec::new();
        for start in 0..self.points.len() {
            let mut points = Vec::new();
            let mut at = start;
            while self.next[at] != DONE {
                points.push(self.points[at]);
                at = std::mem::replace(&mut self.next[at], DONE) as usize;
            }
            if !points.is_empty() {
                loops.push(Loop::new(points));
            }
        }
        loops
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn coverage(width: usize, height: usize, value: impl Fn(f64, f64) -> f64) -> Coverage {
        let at = |k: usize| value((k % width) as f64 + 0.5, (k / width) as f64 + 0.5);
        let values = (0..width * height).map(|k| (255.0 * at(k)).round() as u8).collect();
        Coverage { width, height, values, level: 127 }
    }

    #[test]
    fn one_pixel_is_a_diamond() {
        let loops = contours(&Coverage { width: 1, height: 1, values: vec![255], level: 127 });
        assert_eq!(loops.len(), 1);
        assert_eq!(loops[0].points, [[0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]]);
        assert_eq!(loops[0].area, 0.5);
    }

    #[test]
    fn a_smooth_ring_has_its_area_and_its_radii() {
        let ring = |x: f64, y: f64| {
            let r = (x - 64.3).hypot(y - 63.8);
            (50.0 - r + 0.5).clamp(0.0, 1.0) * (r - 20.0 + 0.5).clamp(0.0, 1.0)
        };
        let loops = contours(&coverage(128, 128, ring));
        assert_eq!(loops.len(), 2);
        for (one, (radius, sign)) in loops.iter().zip([(50.0, 1.0), (20.0, -1.0)]) {
            let area = sign * PI * radius * radius;
            assert!((one.area - area).abs() < 1e-3 * area.abs(), "{} for {area}", one.area);
            for [x, y] in &one.points {
                // Coverage is linear across the edge only where that runs along the pixels.
                assert!(((x - 64.3).hypot(y - 63.8) - radius).abs() < 0.1);
            }
        }
    }

    #[test]
    fn corners_join_when_the_mean_is_at_the_level() {
        let check =
            |low: u8, high: u8| Coverage { width: 2, height: 2, values: vec![high, low, low, high], level: 127 };
        assert_eq!(contours(&check(0, 255)).len(), 1);
        assert_eq!(contours(&check(0, 254)).len(), 2);
        assert_eq!(contours(&check(100, 128)).len(), 2);
        assert_eq!(contours(&check(127, 128)).len(), 1);
    }

    #[test]
    fn a_full_picture_is_outlined_at_its_edge() {
        for width in [62, 63, 64, 128] {
            let loops = contours(&coverage(width, 20, |_, _| 1.0));
            assert_eq!(loops.len(), 1);
            // Only the four corners are cut, by a triangle with two sides of half a pixel.
            assert_eq!(loops[0].area, width as f64 * 20.0 - 4.0 * 0.125);
        }
    }
}
