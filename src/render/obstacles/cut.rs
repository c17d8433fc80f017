//! What of the obstacles lies near the camera, relative to a point near it: there `f32` has its digits.

use std::ops::Range;

use glam::DVec2;

use super::edges::{Room, join, line, within};
use crate::picture::Filling;
use crate::render::camera::Camera;
use crate::render::sight::{Extent, Sight};
use crate::sim::triangles::outer_sides;

/// What a plane or a polygon has among the corners of all triangles, and among the ends of all edges.
struct Piece {
    corners: Range<u32>,
    edges: Range<u32>,
    extent: Extent,
    /// A plane's normal, and how far it lies along it `[m]`.
    plane: Option<(DVec2, f64)>,
}

/// Obstacles cut to a square around an origin.
pub(super) struct Cut {
    pub(super) origin: DVec2,
    /// Half the square's side `[m]`.
    reach: f64,
    /// Whether something of them lies beyond the square.
    is_cut: bool,
    /// Largest coordinate, relative to the origin `[m]`.
    extent: f64,
    /// Corners of triangles, three by three, relative to the origin `[m]`.
    triangles: Vec<[f32; 2]>,
    /// Ends of edges, two by two, likewise: where what is filled ends.
    edges: Vec<[f32; 2]>,
    pieces: Vec<Piece>,
}

/// Half the square's side, in heights of the picture: so far the camera may move until it is cut anew, and coordinates
/// in `f32` are still right to a twentieth of a pixel in a picture of a thousand.
const REACH: f64 = 256.0;
/// How many heights of the picture away the farthest corner may be: beyond, it is off by more than a fifth of a pixel.
const FARTHEST: f64 = 4.0 * REACH;

impl Cut {
    /// The obstacles around what `camera` looks at.
    pub(super) fn new(fillings: &[Filling], planes: &[[DVec2; 2]], camera: &Camera) -> Self {
        let [width, height] = camera.viewport().map(f64::from);
        let reach = REACH * camera.height() * (width / height).max(1.0);
        let mut cut = Cut {
            origin: camera.focus().truncate(),
            reach,
            is_cut: !planes.is_empty(),
            extent: 0.0,
            triangles: Vec::new(),
            edges: Vec::new(),
            pieces: Vec::new(),
        };
        planes.iter().for_each(|&plane| cut.add_plane(plane));
        fillings.iter().for_each(|filling| cut.piece(None, |cut| cut.add_filling(filling)));
        cut
    }

    /// Triangles and edges as the shader reads them: `corners` in obstacles.wgsl.
    pub(super) fn corners(&self) -> Vec<[f32; 2]> {
        let mut corners = self.triangles.clone();
        corners.resize(self.first_edge() as usize, [0.0; 2]);
        corners.extend(&self.edges);
        corners
    }

    /// Where the edges begin in that list: triangles have three corners, edges two ends.
    fn first_edge(&self) -> u32 {
        (self.triangles.len() as u32).next_multiple_of(6)
    }

    /// Whether it holds all that `camera` sees, in numbers that are exact enough.
    pub(super) fn serves(&self, camera: &Camera) -> bool {
        let [width, height] = camera.viewport().map(f64::from);
        let half = 0.5 * camera.height() * (width / height).max(1.0);
        let away = (camera.focus().truncate() - self.origin).abs().max_element();
        (!self.is_cut || away + half < self.reach) && self.extent <= FARTHEST * camera.height()
    }

    /// What is in view: runs of corners of triangles, and left, top, right, bottom of them `[px]`.
    pub(super) fn in_view(&self, camera: &Camera) -> (Vec<Range<u32>>, [f32; 4]) {
        let sight = Sight::new(camera, self.origin.extend(0.0), MARGIN);
        let viewport = DVec2::from_array(camera.viewport().map(f64::from));
        let from_focus = self.origin - camera.focus().truncate();
        let pixel = |[x, y, _]: [f32; 3]| self.pixel(camera, [x, y]);
        let half = 0.5 * viewport / camera.pixels_per_metre();
        let seen = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|at| half * DVec2::from(at) - from_focus);
        let mut runs: Vec<Range<u32>> = Vec::new();
        let (mut low, mut high) = (viewport, DVec2::ZERO);
        for piece in self.pieces.iter().filter(|piece| sight.meets(&piece.extent)) {
            let [from, to] = [piece.extent.low, piece.extent.high].map(pixel);
            let (mut top, mut bottom) = (from.min(to), from.max(to));
            if let Some((normal, depth)) = piece.plane {
                let part = below(&seen, normal, depth + MARGIN / camera.pixels_per_metre());
                if part.is_empty() {
                    continue;
                }
                let part = part.into_iter().map(|at| pixel(at.extend(0.0).as_vec3().to_array()));
                (top, bottom) = part.fold((viewport, DVec2::ZERO), |(low, high), at| (low.min(at), high.max(at)));
            }
            (low, high) = (low.min(top), high.max(bottom));
            join(&mut runs, piece.corners.clone());
        }
        let [low, high] = [low.floor() - MARGIN, high.ceil() + MARGIN].map(|at| at.clamp(DVec2::ZERO, viewport));
        (runs, [low.x, low.y, high.x, high.y].map(|x| x as f32))
    }

    /// The edges in view, as runs of their ends in the list that the shader reads, where few of the pixels in `bounds` are near one:
    /// left, top, right, bottom of what obstacles may cover, whose rims have a width. Both `[px]`.
    pub(super) fn edges_in_view(&self, camera: &Camera, bounds: [f32; 4], outline: f32) -> Option<Vec<Range<u32>>> {
        let sight = Sight::new(camera, self.origin.extend(0.0), MARGIN);
        let first = self.first_edge();
        let (mut runs, mut room) = (Vec::new(), Room::new(bounds, outline));
        for piece in self.pieces.iter().filter(|piece| sight.meets(&piece.extent) && !piece.edges.is_empty()) {
            let ends = self.edges[piece.edges.start as usize..piece.edges.end as usize].as_chunks::<2>().0;
            ends.iter().for_each(|edge| room.count(edge.map(|end| self.pixel(camera, end))));
            join(&mut runs, first + piece.edges.start..first + piece.edges.end);
        }
        room.is_small().then_some(runs)
    }

    /// Where a corner is seen `[px]`.
    fn pixel(&self, camera: &Camera, [x, y]: [f32; 2]) -> DVec2 {
        let from_focus = self.origin - camera.focus().truncate();
        let at = (DVec2::new(f64::from(x), f64::from(y)) + from_focus) * camera.pixels_per_metre();
        0.5 * DVec2::from_array(camera.viewport().map(f64::from)) + at * DVec2::new(1.0, -1.0)
    }

    /// Takes what `add` adds for a piece, if it is anything.
    fn piece(&mut self, plane: Option<(DVec2, f64)>, add: impl FnOnce(&mut Self)) {
        let [start, first_edge] = [&self.triangles, &self.edges].map(Vec::len);
        add(self);
        if start == self.triangles.len() {
            return;
        }
        let mut extent = Extent::NONE;
        self.triangles[start..].iter().for_each(|corner| extent.include(corner));
        let numbers = extent.low.iter().chain(&extent.high).filter(|x| x.is_finite());
        self.extent = self.extent.max(f64::from(numbers.fold(0.0_f32, |most, x| most.max(x.abs()))));
        let corners = start as u32..self.triangles.len() as u32;
        let edges = first_edge as u32..self.edges.len() as u32;
        self.pieces.push(Piece { corners, edges, extent, plane });
    }

    fn add_plane(&mut self, [point, normal]: [DVec2; 2]) {
        let Some(normal) = normal.try_normalize() else { return };
        let depth = (point - self.origin).dot(normal);
        self.piece(Some((normal, depth)), |cut| {
            cut.add_convex(&below(&cut.square(), normal, depth));
            cut.add_edge(line(normal, depth, cut.reach));
        });
    }

    fn add_filling(&mut self, filling: &Filling) {
        let origin = self.origin;
        let relative = |k: u32| DVec2::from(filling.points[k as usize]) - origin;
        let ears: Vec<[DVec2; 3]> = filling.triangles.iter().map(|ear| ear.map(relative)).collect();
        for ear in ears {
            if ear.iter().all(|corner| corner.abs().max_element() <= self.reach) {
                self.add_convex(&ear);
            } else {
                self.is_cut = true;
                self.add_convex(&self.within(ear.to_vec()));
            }
        }
        for side in outer_sides(filling.triangles.iter().copied()) {
            self.add_edge(within(side.ends.map(relative), self.reach));
        }
    }

    fn add_edge(&mut self, edge: Option<[DVec2; 2]>) {
        self.edges.extend(edge.into_iter().flatten().map(|end| end.as_vec2().to_array()));
    }

    /// Corners of the square, about the origin.
    fn square(&self) -> [DVec2; 4] {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|corner| self.reach * DVec2::from(corner))
    }

    /// The part of a convex polygon in the square.
    fn within(&self, corners: Vec<DVec2>) -> Vec<DVec2> {
        let sides = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
        sides.into_iter().fold(corners, |left, side| below(&left, side, self.reach))
    }

    fn add_convex(&mut self, corners: &[DVec2]) {
        for pair in corners.get(1..).unwrap_or_default().windows(2) {
            let ear = [corners[0], pair[0], pair[1]];
            self.triangles.extend(ear.map(|corner| corner.as_vec2().to_array()));
        }
    }
}

/// Pixels that a shape may reach beyond its corners.
const MARGIN: f64 = 2.0;

/// The part of a convex polygon where `normal` . x <= `most`.
fn below(corners: &[DVec2], normal: DVec2, most: f64) -> Vec<DVec2> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    let before = corners.iter().cycle().skip(corners.len().saturating_sub(1));
    for (&a, &b) in before.zip(corners) {
        let [over_a, over_b] = [a, b].map(|x| normal.dot(x) - most);
        if (over_a <= 0.0) != (over_b <= 0.0) {
            kept.push(a + (b - a) * (over_a / (over_a - over_b)));
        }
        if over_b <= 0.0 {
            kept.push(b);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::fill_outline;
    use crate::render::Pose;

    fn camera(center: [f64; 2], height: f64) -> Camera {
        Camera::new(Pose::Plane { center: DVec2::from(center), height }, [200, 100])
    }

    fn square(from: f64, to: f64) -> Filling {
        fill_outline(&[vec![[from, from], [to, from], [to, to], [from, to]]])
    }

    fn one_run(run: Range<u32>) -> Vec<Range<u32>> {
        std::iter::once(run).collect()
    }

    fn area(cut: &Cut) -> f64 {
        let ears =
            cut.triangles.as_chunks::<3>().0.iter().map(|ear| ear.map(|[x, y]| glam::Vec2::new(x, y).as_dvec2()));
        ears.map(|[a, b, c]| 0.5 * (b - a).perp_dot(c - a).abs()).sum()
    }

    #[test]
    fn what_is_near_is_taken_whole_and_serves_until_numbers_end() {
        let cut = Cut::new(&[square(-1.0, 3.0)], &[], &camera([0.0, 0.0], 2.0));
        assert_eq!((area(&cut), cut.is_cut), (16.0, false));
        assert!(cut.serves(&camera([1e4, -1e4], 2.0)) && cut.serves(&camera([0.0, 0.0], 1e9)));
        assert!(!cut.serves(&camera([0.0, 0.0], 1e-3)), "a coordinate of 3 m has no digits for that");
    }

    #[test]
    fn what_is_large_is_cut_to_the_square() {
        let near = camera([0.0, 0.0], 1e-3);
        let cut = Cut::new(&[square(-1.0, 3.0)], &[], &near);
        let side = 2.0 * REACH * 2.0 * 1e-3;
        assert!((area(&cut) - side * side).abs() < 1e-6 && cut.is_cut);
        assert!(cut.serves(&near) && !cut.serves(&camera([1.0, 0.0], 1e-3)) && !cut.serves(&camera([0.0, 0.0], 9.0)));
        let corner = Cut::new(&[square(-1.0, 3.0)], &[], &camera([3.0, 3.0], 1e-3));
        assert!((area(&corner) - 0.25 * side * side).abs() < 1e-6);
    }

    #[test]
    fn a_plane_fills_the_side_that_its_normal_leads_away_from() {
        let here = camera([1e6, 0.0], 1.0);
        let [normal, point] = [DVec2::new(1.0, 1.0), DVec2::new(1e6, 0.0)];
        let cut = Cut::new(&[], &[[point, normal]], &here);
        let side = 2.0 * REACH * 2.0;
        assert!((area(&cut) - 0.5 * side * side).abs() < 1e-3);
        assert!(cut.triangles.iter().all(|&[x, y]| x + y <= 1e-3));
        let far = Cut::new(&[], &[[DVec2::ZERO, DVec2::X]], &here);
        assert!(far.triangles.is_empty(), "all that is near is free");
        assert_eq!(Cut::new(&[], &[[point, DVec2::ZERO]], &here).triangles.len(), 0, "no direction, no plane");
    }

    #[test]
    fn edges_follow_triangles_where_both_are_counted_in_whole_ones() {
        let here = camera([2.0, 2.0], 8.0);
        let hill = fill_outline(&[vec![[0.0, 0.0], [4.0, 0.0], [2.0, 3.0]]]);
        let cut = Cut::new(&[hill], &[[DVec2::new(0.0, -1.0), DVec2::Y]], &here);
        let (corners, first) = (cut.corners(), cut.first_edge() as usize);
        assert_eq!(
            (cut.triangles.len(), first, corners.len()),
            (9, 12, 12 + 2 + 6),
            "two of the plane, one of the hill"
        );
        let side = |k: usize| [corners[first + 2 * k], corners[first + 2 * k + 1]];
        let reach = 2.0 * REACH as f32 * 8.0;
        assert_eq!(
            side(0).map(|[x, y]| [x.abs(), y]),
            [[reach, -3.0]; 2],
            "the line of the plane, as far as the square"
        );
        assert_eq!([side(1), side(2), side(3)].concat().iter().filter(|end| **end == [-2.0, -2.0]).count(), 2);
        let (_, bounds) = cut.in_view(&here);
        assert_eq!(cut.edges_in_view(&here, bounds, 1.5), Some(one_run(12..20)));
        let (far, bounds) = (camera([2.0, 2.0], 400.0), [90.0, 40.0, 110.0, 60.0]);
        assert_eq!(cut.edges_in_view(&far, bounds, 1.5), None, "edges are all there is to be seen");
    }

    #[test]
    fn only_what_is_in_view_is_drawn() {
        let solids: Vec<Filling> = (0..5).map(|k| square(10.0 * f64::from(k), 10.0 * f64::from(k) + 1.0)).collect();
        let here = camera([10.0, 10.0], 4.0);
        let cut = Cut::new(&solids, &[], &here);
        let (runs, bounds) = cut.in_view(&here);
        assert_eq!(runs, one_run(6..12));
        assert_eq!(bounds, [98.0, 23.0, 127.0, 52.0], "25 px a metre, and two beside");
        assert_eq!(cut.in_view(&camera([0.0, 0.0], 1e3)).0, one_run(0..30), "all of them in one run");
        assert!(cut.in_view(&camera([5.0, 5.0], 2.0)).0.is_empty());
        let [point, normal] = [DVec2::ZERO, DVec2::new(0.1, 1.0)];
        let cut = Cut::new(&[], &[[point, normal]], &here);
        assert!(
            cut.in_view(&here).0.is_empty(),
            "the plane fills the square's lower half, all of it below the picture"
        );
        assert_eq!(cut.in_view(&camera([10.0, 1.0], 4.0)).1[0..3], [0.0, 85.0, 123.0]);
    }
}
