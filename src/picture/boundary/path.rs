//! A closed contour by its arc length.

use super::super::plane::{Point, between, distance};

/// A contour and how far along it each point is.
#[derive(Clone, Debug)]
pub(super) struct Path<'a> {
    pub(super) points: &'a [Point],
    /// Distance along the contour to each point, and, one more, its length `[px]`.
    pub(super) arc: Vec<f64>,
    /// How many points lie before each of as many equal parts of the contour as it has points, and, one more, all of them:
    /// a long contour is not searched from end to end for each place.
    before: Vec<u32>,
}

impl<'a> Path<'a> {
    pub(super) fn new(points: &'a [Point]) -> Self {
        let mut arc = Vec::with_capacity(points.len() + 1);
        let mut length = 0.0;
        for k in 0..points.len() {
            arc.push(length);
            length += distance(points[k], points[(k + 1) % points.len()]);
        }
        arc.push(length);
        let mut path = Path { points, arc, before: vec![0; points.len() + 1] };
        for k in 0..points.len() {
            let part = path.part(path.arc[k]);
            path.before[part + 1] += 1;
        }
        (0..points.len()).for_each(|part| path.before[part + 1] += path.before[part]);
        path
    }

    /// The part of the contour that a distance lies in, of as many as it has points.
    fn part(&self, along: f64) -> usize {
        let count = self.points.len();
        ((along / self.length() * count as f64) as usize).min(count - 1)
    }

    /// How many points are passed at a distance along the contour; `is_passed` says of the distance of one whether it is.
    fn passed(&self, along: f64, is_passed: impl Fn(f64) -> bool) -> usize {
        let part = self.part(along);
        let [from, to] = [self.before[part], self.before[part + 1]].map(|k| k as usize);
        from + self.arc[from..to].partition_point(|&arc| is_passed(arc))
    }

    /// Length around `[px]`.
    pub(super) fn length(&self) -> f64 {
        self.arc[self.points.len()]
    }

    /// The place at a distance along the contour, which may be a whole turn too far or too short.
    pub(super) fn at(&self, distance: f64) -> Point {
        let along = self.wrap(distance);
        let k = self.span(along);
        let (from, to) = (self.arc[k], self.arc[k + 1]);
        between(self.points[k], self.points[(k + 1) % self.points.len()], (along - from) / (to - from))
    }

    /// The places at a distance from each point, which is less than a turn: faster than asking for one after the other.
    pub(super) fn shifted(&self, by: f64) -> Vec<Point> {
        let count = self.points.len();
        let mut k = self.span(self.wrap(self.arc[0] + by));
        let mut places = Vec::with_capacity(count);
        for arc in &self.arc[..count] {
            let along = self.wrap(arc + by);
            while !(self.arc[k] <= along && along < self.arc[k + 1]) {
                k = (k + 1) % count;
            }
            let share = (along - self.arc[k]) / (self.arc[k + 1] - self.arc[k]);
            places.push(between(self.points[k], self.points[(k + 1) % count], share));
        }
        places
    }

    /// The mean of the contour from `reach` before a distance to as far after it, by arc length.
    pub(super) fn mean(&self, distance: f64, reach: f64) -> Point {
        let from = self.wrap(distance - reach);
        let to = from + 2.0 * reach;
        let (mut sum, mut total, mut before) = ([0.0; 2], 0.0, self.at(from));
        for next in self.inside(from, to).chain([self.at(to)]) {
            let step = super::super::plane::distance(before, next);
            (0..2).for_each(|k| sum[k] += 0.5 * step * (before[k] + next[k]));
            (total, before) = (total + step, next);
        }
        if total > 0.0 { [sum[0] / total, sum[1] / total] } else { before }
    }

    fn wrap(&self, distance: f64) -> f64 {
        let length = self.length();
        if distance < 0.0 {
            distance + length
        } else if distance >= length {
            distance - length
        } else {
            distance
        }
    }

    /// The segment in which a distance from 0 to the length lies.
    fn span(&self, along: f64) -> usize {
        self.passed(along, |arc| arc <= along).clamp(1, self.points.len()) - 1
    }

    /// The points strictly between two distances, less than a turn apart, that may be up to a turn beyond the length.
    pub(super) fn inside(&self, from: f64, to: f64) -> impl Iterator<Item = Point> + '_ {
        let length = self.length();
        let (from, to) = if from >= length { (from - length, to - length) } else { (from, to) };
        let first = self.passed(from, |arc| arc <= from);
        let last = if to > length {
            self.points.len() + self.passed(to - length, |arc| arc < to - length)
        } else {
            self.passed(to, |arc| arc < to)
        };
        (first..last.max(first)).map(|k| self.points[k % self.points.len()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_points_along_a_square() {
        let square = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        let path = Path::new(&square);
        assert_eq!(path.length(), 16.0);
        assert_eq!([path.at(2.0), path.at(-1.0), path.at(17.0)], [[2.0, 0.0], [0.0, 1.0], [1.0, 0.0]]);
        assert_eq!(path.shifted(-1.0), [[0.0, 1.0], [3.0, 0.0], [4.0, 3.0], [1.0, 4.0]]);
        assert_eq!(path.shifted(15.0), path.shifted(-1.0));
        assert_eq!(path.inside(3.0, 9.0).collect::<Vec<_>>(), [square[1], square[2]]);
        assert_eq!(path.inside(11.0, 21.0).collect::<Vec<_>>(), [square[3], square[0], square[1]]);
        assert_eq!(path.inside(19.0, 25.0).collect::<Vec<_>>(), [square[1], square[2]]);
        assert_eq!(path.inside(4.0, 8.0).count(), 0);
        assert_eq!(path.inside(5.0, 6.0).count(), 0);
    }
}
