//! Which squares of the window panels cover, and which of them look otherwise than before.

use egui::ClippedPrimitive;
use egui::epaint::{Primitive, Vertex};
use egui_wgpu::ScreenDescriptor;

/// What is covered or changed is found in squares of this side `[px]`.
const SIDE: u32 = 32;

/// The squares of a window, some of them marked.
struct Squares {
    size: [u32; 2],
    counts: [usize; 2],
    scale: f32,
    is_marked: Vec<bool>,
}

impl Squares {
    fn new(screen: &ScreenDescriptor) -> Self {
        let size = screen.size_in_pixels;
        let counts = size.map(|side| side.div_ceil(SIDE) as usize);
        Squares { size, counts, scale: screen.pixels_per_point, is_marked: vec![false; counts[0] * counts[1]] }
    }

    /// Marks what a triangle covers that is clipped.
    fn mark(&mut self, corners: [Vertex; 3], clip: egui::Rect) {
        if corners.iter().all(|corner| corner.color == egui::Color32::TRANSPARENT) {
            return;
        }
        let [width, height] = self.size.map(|side| side as f32);
        let whole = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(width, height));
        let clip = (clip * self.scale).expand(1.0).intersect(whole);
        let places = corners.map(|corner| (corner.pos.to_vec2() * self.scale).to_pos2());
        let around = egui::Rect::from_points(&places).intersect(clip);
        if around.is_negative() {
            return;
        }
        let square = |at: f32, count: usize| ((at.max(0.0) as u32 / SIDE) as usize).min(count - 1);
        let [left, right] = [around.left(), around.right()].map(|x| square(x, self.counts[0]));
        for row in square(around.top(), self.counts[1])..=square(around.bottom(), self.counts[1]) {
            self.is_marked[row * self.counts[0] + left..=row * self.counts[0] + right].fill(true);
        }
    }

    /// Marks all that something covers; all there is where nobody knows what that is.
    fn mark_all(&mut self, job: &ClippedPrimitive) {
        match triangles(job) {
            Some(triangles) => triangles.for_each(|corners| self.mark(corners, job.clip_rect)),
            None => self.is_marked.fill(true),
        }
    }

    /// Marks where two look otherwise: from the first triangle that is another to the last one.
    fn mark_changes(&mut self, before: &ClippedPrimitive, after: &ClippedPrimitive) {
        let (Primitive::Mesh(a), Primitive::Mesh(b)) = (&before.primitive, &after.primitive) else {
            return self.is_marked.fill(true);
        };
        let lists = [before, after].map(|job| triangles(job).into_iter().flatten().collect::<Vec<_>>());
        let is_other = before.clip_rect != after.clip_rect || a.texture_id != b.texture_id;
        let [first, last] = if is_other { [0; 2] } else { same_ends(&lists[0], &lists[1]) };
        for (list, job) in lists.iter().zip([before, after]) {
            list[first..list.len() - last].iter().for_each(|corners| self.mark(*corners, job.clip_rect));
        }
    }

    /// Left, top, width and height of parts that do not overlap `[px]`, whole squares of them.
    fn parts(&self) -> Vec<[u32; 4]> {
        parts(&self.is_marked, self.counts[0]).into_iter().map(|part| in_pixels(part, self.size)).collect()
    }
}

/// The triangles of what is painted, if it is made of some.
fn triangles(job: &ClippedPrimitive) -> Option<impl Iterator<Item = [Vertex; 3]>> {
    let Primitive::Mesh(mesh) = &job.primitive else { return None };
    Some(mesh.indices.chunks_exact(3).map(|corners| [0, 1, 2].map(|k| mesh.vertices[corners[k] as usize])))
}

/// How many of two lists are the same from the start, and of the others from the end.
fn same_ends<T: PartialEq>(a: &[T], b: &[T]) -> [usize; 2] {
    let first = a.iter().zip(b).take_while(|(a, b)| a == b).count();
    let last = a[first..].iter().rev().zip(b[first..].iter().rev()).take_while(|(a, b)| a == b).count();
    [first, last]
}

/// Where anything is seen of panels: left, top, width and height of parts that do not overlap `[px]`.
pub(super) fn covered(jobs: &[ClippedPrimitive], screen: &ScreenDescriptor) -> Vec<[u32; 4]> {
    let mut squares = Squares::new(screen);
    jobs.iter().for_each(|job| squares.mark_all(job));
    squares.parts()
}

/// Where panels look otherwise than `before`, likewise.
pub(super) fn changed(
    before: &[ClippedPrimitive],
    jobs: &[ClippedPrimitive],
    screen: &ScreenDescriptor,
) -> Vec<[u32; 4]> {
    let is_same = |a: &ClippedPrimitive, b: &ClippedPrimitive| match (&a.primitive, &b.primitive) {
        (Primitive::Mesh(p), Primitive::Mesh(q)) => a.clip_rect == b.clip_rect && p == q,
        _ => false,
    };
    let first = before.iter().zip(jobs).take_while(|(a, b)| is_same(a, b)).count();
    let (before, jobs) = (&before[first..], &jobs[first..]);
    let last = before.iter().rev().zip(jobs.iter().rev()).take_while(|(a, b)| is_same(a, b)).count();
    let (before, jobs) = (&before[..before.len() - last], &jobs[..jobs.len() - last]);
    let mut squares = Squares::new(screen);
    match before.len() == jobs.len() {
        true => before.iter().zip(jobs).for_each(|(a, b)| squares.mark_changes(a, b)),
        false => before.iter().chain(jobs).for_each(|job| squares.mark_all(job)),
    }
    squares.parts()
}

/// What of panels lies in parts of the window, each cut to its part.
pub(super) fn cut(jobs: &[ClippedPrimitive], parts: &[[u32; 4]], screen: &ScreenDescriptor) -> Vec<ClippedPrimitive> {
    let mut list = Vec::new();
    for part in parts {
        let [left, top, width, height] = part.map(|x| x as f32 / screen.pixels_per_point);
        let part = egui::Rect::from_min_size(egui::pos2(left, top), egui::vec2(width, height));
        for job in jobs.iter().filter(|job| job.clip_rect.intersects(part)) {
            list.push(ClippedPrimitive { clip_rect: job.clip_rect.intersect(part), primitive: job.primitive.clone() });
        }
    }
    list
}

/// Runs of squares that are covered, each with the same run of rows below it: columns and rows, ends excluded.
fn parts(is_covered: &[bool], columns: usize) -> Vec<[[usize; 2]; 2]> {
    let mut parts: Vec<[[usize; 2]; 2]> = Vec::new();
    for (row, squares) in is_covered.chunks(columns).enumerate() {
        let mut from = 0;
        for run in squares.chunk_by(|a, b| a == b) {
            let across = [from, from + run.len()];
            from += run.len();
            if !run[0] {
                continue;
            }
            match parts.iter_mut().find(|[other, rows]| *other == across && rows[1] == row) {
                Some([_, rows]) => rows[1] += 1,
                None => parts.push([across, [row, row + 1]]),
            }
        }
    }
    parts
}

fn in_pixels([across, down]: [[usize; 2]; 2], [width, height]: [u32; 2]) -> [u32; 4] {
    let pixels = |[from, to]: [usize; 2], most: u32| {
        let from = from as u32 * SIDE;
        [from, (to as u32 * SIDE).min(most) - from]
    };
    let ([left, width], [top, height]) = (pixels(across, width), pixels(down, height));
    [left, top, width, height]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_panels_cover_is_found_in_parts_that_do_not_overlap() {
        let rect = |min: [f32; 2], max: [f32; 2], color| {
            let mut mesh = egui::Mesh::default();
            mesh.add_colored_rect(egui::Rect::from_min_max(min.into(), max.into()), color);
            let primitive = Primitive::Mesh(mesh);
            ClippedPrimitive { clip_rect: egui::Rect::from_min_max([0.0; 2].into(), [90.0, 50.0].into()), primitive }
        };
        let screen = ScreenDescriptor { size_in_pixels: [200, 100], pixels_per_point: 2.0 };
        let seen = egui::Color32::from_white_alpha(3);
        let jobs = [
            rect([0.0, 0.0], [100.0, 50.0], egui::Color32::TRANSPARENT),
            rect([1.0, 1.0], [15.0, 30.0], seen),
            rect([4.0, 4.0], [40.0, 10.0], seen),
            rect([70.0, 40.0], [100.0, 90.0], seen),
        ];
        let parts = covered(&jobs, &screen);
        assert_eq!(
            parts,
            [[0, 0, 96, 32], [0, 32, 32, 32], [128, 64, 64, 36]],
            "the last is cut at its clip and at the edge"
        );
    }

    #[test]
    fn where_panels_changed_is_found_from_the_first_triangle_that_is_another_to_the_last() {
        let screen = ScreenDescriptor { size_in_pixels: [320, 128], pixels_per_point: 1.0 };
        let clip_rect = egui::Rect::from_min_max([0.0; 2].into(), [320.0, 128.0].into());
        let panel = |places: &[[f32; 2]]| {
            let mut mesh = egui::Mesh::default();
            for &[x, y] in places {
                let rect = egui::Rect::from_min_size([x, y].into(), egui::vec2(10.0, 10.0));
                mesh.add_colored_rect(rect, egui::Color32::WHITE);
            }
            ClippedPrimitive { clip_rect, primitive: Primitive::Mesh(mesh) }
        };
        let tools = || panel(&[[1.0, 1.0], [1.0, 40.0]]);
        let figures = |x: f32| panel(&[[200.0, 1.0], [x, 40.0], [300.0, 100.0]]);
        let before = [tools(), figures(200.0)];
        assert!(changed(&before, &[tools(), figures(200.0)], &screen).is_empty(), "nothing did");
        let parts = changed(&before, &[tools(), figures(130.0)], &screen);
        assert_eq!(parts, [[128, 32, 32, 32], [192, 32, 32, 32]], "where it was and where it is");
        assert_eq!(changed(&before, &[tools()], &screen).len(), 2, "it is gone");
        // What lies in a part is cut to it.
        let cut = cut(&before, &parts, &screen);
        let places: Vec<[f32; 4]> =
            cut.iter().map(|job| [job.clip_rect.min, job.clip_rect.max]).map(|[a, b]| [a.x, a.y, b.x, b.y]).collect();
        assert_eq!(
            places,
            [
                [128.0, 32.0, 160.0, 64.0],
                [128.0, 32.0, 160.0, 64.0],
                [192.0, 32.0, 224.0, 64.0],
                [192.0, 32.0, 224.0, 64.0]
            ]
        );
    }
}
