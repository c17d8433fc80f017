//! Which cells of a part of the plane something covers, as bits: where a copy has room is looked for among whole cells.

use glam::DVec2;

/// Bits in a word.
const BITS: usize = 64;

/// Cells, row by row from below.
#[derive(Clone, Debug)]
pub(super) struct Raster {
    low: DVec2,
    /// Side of a cell `[m]`.
    cell: f64,
    pub(super) size: [usize; 2],
    words: usize,
    rows: Vec<u64>,
}

impl Raster {
    /// Empty cells of a side from a lower corner up to an upper one `[m]`.
    pub(super) fn new([low, high]: [DVec2; 2], cell: f64) -> Self {
        let count = |span: f64| (span / cell).ceil().max(1.0) as usize;
        let size = [count(high.x - low.x), count(high.y - low.y)];
        let words = size[0].div_ceil(BITS);
        Raster { low, cell, size, words, rows: vec![0; words * size[1]] }
    }

    fn set(&mut self, x: usize, y: usize) {
        self.rows[y * self.words + x / BITS] |= 1 << (x % BITS);
    }

    fn has(&self, x: usize, y: usize) -> bool {
        self.rows[y * self.words + x / BITS] >> (x % BITS) & 1 == 1
    }

    /// In cells from the lower corner.
    fn within(&self, at: DVec2) -> DVec2 {
        (at - self.low) / self.cell
    }

    /// A place is covered.
    pub(super) fn dot(&mut self, at: DVec2) {
        let at = self.within(at).floor();
        let [width, height] = self.size.map(|side| side as f64);
        if (0.0..width).contains(&at.x) && (0.0..height).contains(&at.y) {
            self.set(at.x as usize, at.y as usize);
        }
    }

    /// A straight line is: what of it lies within.
    pub(super) fn line(&mut self, [from, to]: [DVec2; 2]) {
        let (low, high) = (from.min(to), from.max(to));
        let far = self.low + self.cell * DVec2::new(self.size[0] as f64, self.size[1] as f64);
        if !(low.is_finite() && high.is_finite()) || low.cmpgt(far).any() || high.cmplt(self.low).any() {
            return;
        }
        // Of a line that goes far beyond, so many places at most.
        let most = 8.0 * (self.size[0] + self.size[1]) as f64;
        let steps = (2.0 * from.distance(to) / self.cell).ceil().clamp(1.0, most) as usize;
        (0..=steps).for_each(|k| self.dot(from.lerp(to, k as f64 / steps as f64)));
    }

    /// All that lies within loops by the even-odd rule is, with their sides.
    pub(super) fn fill(&mut self, loops: &[&[DVec2]]) {
        let sides = || {
            let sides = |corners: &&[DVec2]| {
                let corners = corners.to_vec();
                (0..corners.len()).map(move |k| [corners[k], corners[(k + 1) % corners.len()]]).collect::<Vec<_>>()
            };
            loops.iter().flat_map(sides)
        };
        let all: Vec<[DVec2; 2]> = sides().collect();
        let [low, high] = all
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [from, _]| [low.min(from.y), high.max(from.y)]);
        let row = |y: f64| ((y - self.low.y) / self.cell).floor().clamp(0.0, self.size[1] as f64) as usize;
        let rows = if low <= high { row(low)..(row(high) + 1).min(self.size[1]) } else { 0..0 };
        for y in rows {
            let level = self.low.y + (y as f64 + 0.5) * self.cell;
            let crossing = |[from, to]: &[DVec2; 2]| {
                let is_crossed = (from.y > level) != (to.y > level);
                is_crossed.then(|| from.x + (level - from.y) / (to.y - from.y) * (to.x - from.x))
            };
            let mut ends: Vec<f64> = all.iter().filter_map(crossing).collect();
            ends.sort_by(f64::total_cmp);
            for pair in ends.chunks_exact(2) {
                let cell = |x: f64| ((x - self.low.x) / self.cell).clamp(0.0, self.size[0] as f64) as usize;
                (cell(pair[0])..cell(pair[1])).for_each(|x| self.set(x, y));
            }
        }
        all.into_iter().for_each(|side| self.line(side));
    }

    /// The cells whose middle is no good are covered.
    pub(super) fn cover(&mut self, is_covered: impl Fn(DVec2) -> bool) {
        for y in 0..self.size[1] {
            for x in 0..self.size[0] {
                if is_covered(self.low + self.cell * DVec2::new(x as f64 + 0.5, y as f64 + 0.5)) {
                    self.set(x, y);
                }
            }
        }
    }

    /// With so many more cells on each side of what is covered.
    pub(super) fn grown(&self, by: usize) -> Self {
        let mut grown = self.clone();
        for y in 0..self.size[1] {
            for x in (0..self.size[0]).filter(|&x| self.has(x, y)) {
                for y in y.saturating_sub(by)..(y + by + 1).min(self.size[1]) {
                    (x.saturating_sub(by)..(x + by + 1).min(self.size[0])).for_each(|x| grown.set(x, y));
                }
            }
        }
        grown
    }

    /// With what another one of the same cells covers.
    pub(super) fn with(mut self, other: &Raster) -> Self {
        self.rows.iter_mut().zip(&other.rows).for_each(|(own, its)| *own |= its);
        self
    }

    /// With the hollows of what is covered: all that cannot be got to from the border, nor from a part between two corners `[m]`.
    pub(super) fn filled(&self, open: Option<[DVec2; 2]>) -> Self {
        let [width, height] = self.size;
        let mut reached = Raster { rows: vec![0; self.rows.len()], ..self.clone() };
        let cell = |at: DVec2| self.within(at).floor().to_array().map(|x| x.max(0.0) as usize);
        let open = open.map(|corners| corners.map(cell));
        let is_open = |[x, y]: [usize; 2]| {
            let is_in =
                open.is_some_and(|[low, high]| (low[0]..=high[0]).contains(&x) && (low[1]..=high[1]).contains(&y));
            is_in || x == 0 || y == 0 || x + 1 == width || y + 1 == height
        };
        let all = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        let mut next: Vec<[usize; 2]> = all.filter(|&at| is_open(at)).collect();
        while let Some([x, y]) = next.pop() {
            if self.has(x, y) || reached.has(x, y) {
                continue;
            }
            reached.set(x, y);
            let along = [x.checked_sub(1), (x + 1 < width).then_some(x + 1)].into_iter().flatten().map(|x| [x, y]);
            let across = [y.checked_sub(1), (y + 1 < height).then_some(y + 1)].into_iter().flatten().map(|y| [x, y]);
            next.extend(along.chain(across));
        }
        reached.rows.iter_mut().for_each(|word| *word = !*word);
        reached
    }

    /// How many cells the lower corner of another one is from that of this.
    pub(super) fn offset(&self, other: &Raster) -> [i64; 2] {
        self.within(other.low).round().to_array().map(|x| x as i64)
    }

    /// Whether nothing that another one covers is covered or beyond here, where its lower corner is so many cells from that of this.
    pub(super) fn has_room(&self, other: &Raster, [left, below]: [i64; 2]) -> bool {
        let is_inside = left >= 0
            && below >= 0
            && left as usize + other.size[0] <= self.size[0]
            && below as usize + other.size[1] <= self.size[1];
        if !is_inside {
            return false;
        }
        let (first, shift) = (left as usize / BITS, left as usize % BITS);
        (0..other.size[1]).all(|y| {
            let own = &self.rows[(below as usize + y) * self.words..][..self.words];
            let its = &other.rows[y * other.words..][..other.words];
            its.iter().enumerate().all(|(k, &word)| {
                let low = own.get(first + k).copied().unwrap_or(0) & (word << shift);
                let high = if shift == 0 { 0 } else { word >> (BITS - shift) };
                low == 0 && own.get(first + k + 1).copied().unwrap_or(0) & high == 0
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: [f64; 2], side: f64) -> [DVec2; 4] {
        let low = DVec2::from(low);
        [low, low + DVec2::new(side, 0.0), low + DVec2::splat(side), low + DVec2::new(0.0, side)]
    }

    #[test]
    fn what_lies_in_each_other_has_no_room_at_any_offset_of_words() {
        let mut world = Raster::new([DVec2::ZERO, DVec2::new(300.0, 40.0)], 1.0);
        world.fill(&[&square([100.5, 10.5], 20.0)]);
        let mut thing = Raster::new([DVec2::ZERO, DVec2::new(70.0, 6.0)], 1.0);
        thing.line([DVec2::new(0.5, 2.5), DVec2::new(69.5, 2.5)]);
        for left in 0..=230 {
            for below in [0, 5, 15, 30] {
                let meets = left <= 120 && left + 69 >= 100 && (10..=30).contains(&(below + 2));
                assert_eq!(world.has_room(&thing, [left, below]), !meets, "{left} {below}");
            }
        }
        assert!(!world.has_room(&thing, [-1, 0]) && !world.has_room(&thing, [231, 0]));
    }

    #[test]
    fn hollows_are_filled_but_for_the_one_that_is_open() {
        let mut world = Raster::new([DVec2::ZERO, DVec2::splat(100.0)], 1.0);
        let ring = |world: &mut Raster, low: [f64; 2], side: f64| {
            let corners = square(low, side);
            (0..4).for_each(|k| world.line([corners[k], corners[(k + 1) % 4]]));
        };
        ring(&mut world, [10.5, 10.5], 30.0);
        ring(&mut world, [60.5, 60.5], 30.0);
        // A corner is no hollow.
        world.line([DVec2::new(60.5, 10.5), DVec2::new(90.5, 10.5)]);
        world.line([DVec2::new(60.5, 10.5), DVec2::new(60.5, 40.5)]);
        let all = world.filled(None);
        assert!(all.has(25, 25) && all.has(75, 75) && !all.has(75, 25) && !all.has(99, 99));
        let one = world.filled(Some([DVec2::splat(20.0), DVec2::splat(24.0)]));
        assert!(!one.has(35, 35) && one.has(40, 25) && one.has(75, 75));
    }

    #[test]
    fn holes_are_free_and_what_is_grown_is_larger_on_all_sides() {
        let mut world = Raster::new([DVec2::ZERO, DVec2::splat(64.0)], 1.0);
        world.fill(&[&square([10.5, 10.5], 30.0), &square([20.5, 20.5], 10.0)]);
        assert!(world.has(15, 15) && !world.has(25, 25) && !world.has(50, 50));
        let grown = world.grown(2);
        assert!(grown.has(8, 8) && !grown.has(7, 8) && grown.has(22, 25) && !grown.has(23, 25));
    }
}
