//! Which bonds and points of a large scene a picture takes: only those in view, and where bonds are too short to be told
//! apart only as many as it takes to cover what they cover.
//!
//! Bonds lie in chunks of neighbours, points in groups of them. When something moved, a box is put around each group,
//! and a chunk's box is that of the groups that its bonds end in. Small scenes have none of this and are drawn whole.

use std::ops::Range;

use super::counters::RenderCounters;
use super::detail::{Detail, is_surface};
use super::gpu_bond::GpuBond;
use super::sight::{Extent, Sight};

/// Bonds of a chunk: `CHUNK` in bonds.wgsl. As many as a patch of 16 x 16 points has in a cloth with both diagonals:
/// larger ones reach further out of the picture, smaller ones make more draw calls.
pub(super) const CHUNK: usize = 1024;
/// Points of a group.
const GROUP: usize = 64;
/// Bonds or points from which on a scene is large: below, it takes longer to ask than to draw.
pub(super) const LARGE: usize = 32 * CHUNK;
/// Bonds of a chunk whose length is measured when they moved.
const SAMPLES: usize = 4;
/// Groups out of view between two in view that are drawn with them, which is cheaper than another draw call.
const BRIDGE: usize = 2;

/// Bonds to draw: the first `count` of each of `chunks` chunks in a row, or `count` in one go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Run {
    /// The first bond.
    pub(super) first: u32,
    pub(super) count: u32,
    pub(super) chunks: u32,
}

/// What a picture takes of bonds and points.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Selection {
    pub(super) strokes: Vec<Run>,
    pub(super) dots: Vec<Run>,
    pub(super) points: Vec<Range<u32>>,
}

impl Selection {
    /// All bonds as strokes, and these points.
    pub(super) fn whole(bond_count: u32, points: Range<u32>) -> Self {
        let mut all = Selection::default();
        add(&mut all.strokes, 0, bond_count, bond_count);
        all.add_points(points);
        all
    }

    fn add_points(&mut self, range: Range<u32>) {
        let bridge = (BRIDGE * GROUP) as u32;
        match self.points.last_mut() {
            Some(last) if range.start <= last.end + bridge => last.end = range.end,
            _ if !range.is_empty() => self.points.push(range),
            _ => {}
        }
    }
}

/// Adds the first `count` of the `len` bonds from `first` on: to the run before them if that can go on.
fn add(runs: &mut Vec<Run>, first: u32, count: u32, len: u32) {
    if count == 0 {
        return;
    }
    let is_whole = count == len;
    match runs.last_mut() {
        Some(last) if is_whole && last.chunks == 1 && last.first + last.count == first => last.count += count,
        // A few more than asked for do no harm.
        Some(last) if !is_whole && is_close(last.count, count) && last.first + last.chunks * CHUNK as u32 == first => {
            last.chunks += 1;
        }
        _ => runs.push(Run { first, count, chunks: 1 }),
    }
}

/// Whether `more`, below a whole chunk, will do for `count` too.
fn is_close(more: u32, count: u32) -> bool {
    more < CHUNK as u32 && (count..=count + count / 4 + 1).contains(&more)
}

/// Bonds that are drawn together.
#[derive(Clone, Debug)]
struct Chunk {
    len: u32,
    /// Mean rest length `[m]`.
    rest: f64,
    /// Bonds for each point that they end at.
    per_point: f64,
    /// Some bonds, to see how long they are now.
    samples: [[u32; 2]; SAMPLES],
    /// Sum of the samples' rest lengths `[m]`.
    samples_rest: f64,
    /// The groups that the bonds end in, as a range of [`Chunks::touched`].
    groups: Range<usize>,
}

/// What a large scene's parts are, and where they are now.
pub(super) struct Chunks {
    /// The points as they are drawn.
    order: Vec<u32>,
    /// How many of them come before those that are always shown.
    common: u32,
    chunks: Vec<Chunk>,
    touched: Vec<u32>,
    /// Whether every chunk is a piece of a surface.
    is_surface: bool,
    /// Around all points, since they moved.
    whole: Option<Extent>,
    /// Around each group, since the points moved.
    groups: Option<Vec<Extent>>,
    /// Mean length of each chunk's bonds `[m]`, since they moved.
    lengths: Option<Vec<f64>>,
}

/// What a picture wants of the bonds and points in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wanted {
    pub(super) sight: Sight,
    /// Width of strokes, and radius of dots `[px]`.
    pub(super) width: f64,
    pub(super) radius: f64,
    /// Points that are not pinned are too faint to be seen.
    pub(super) points_faded: bool,
    /// Bonds and points are shown that skins cover.
    pub(super) has_mesh: bool,
}

impl Chunks {
    /// The parts of a scene whose points and bonds lie in this order; the points from `common` on are always shown.
    pub(super) fn new(order: Vec<u32>, rank: &[u32], common: u32, bonds: &[GpuBond]) -> Self {
        let mut touched = Vec::new();
        // The last chunk that has a bond at a group and at a point, counted from 1.
        let mut group_seen = vec![0; order.len().div_ceil(GROUP)];
        let mut point_seen = vec![0; order.len()];
        let mut chunk_of = |(index, bonds): (usize, &[GpuBond])| {
            let start = touched.len();
            let mut points = 0;
            for bond in bonds {
                let ends = [bond.a, bond.b].map(|point| rank[point as usize] as usize);
                for place in ends {
                    points += usize::from(std::mem::replace(&mut point_seen[place], index + 1) != index + 1);
                    if std::mem::replace(&mut group_seen[place / GROUP], index + 1) != index + 1 {
                        touched.push((place / GROUP) as u32);
                    }
                }
            }
            let samples = std::array::from_fn(|i| bonds[i * bonds.len() / SAMPLES]);
            Chunk {
                len: bonds.len() as u32,
                rest: bonds.iter().map(|bond| f64::from(bond.rest_length)).sum::<f64>() / bonds.len() as f64,
                per_point: bonds.len() as f64 / points as f64,
                samples: samples.map(|bond| [bond.a, bond.b]),
                samples_rest: samples.iter().map(|bond| f64::from(bond.rest_length)).sum(),
                groups: start..touched.len(),
            }
        };
        let chunks: Vec<Chunk> = bonds.chunks(CHUNK).enumerate().map(&mut chunk_of).collect();
        let mut whole_ones = chunks.iter().filter(|chunk| chunk.len as usize == CHUNK);
        let is_surface = whole_ones.all(|chunk| is_surface(chunk.per_point));
        Chunks { order, common, chunks, touched, is_surface, whole: None, groups: None, lengths: None }
    }

    /// Whether every chunk is a piece of a surface.
    pub(super) fn is_surface(&self) -> bool {
        self.is_surface
    }

    /// The points as they are drawn.
    pub(super) fn order(&self) -> &[u32] {
        &self.order
    }

    /// The points moved.
    pub(super) fn forget_motion(&mut self) {
        (self.whole, self.groups, self.lengths) = (None, None, None);
    }

    /// What a picture takes, between two states of the positions (`dimensions` numbers a point).
    pub(super) fn select(
        &mut self,
        states: [&[f32]; 2],
        dimensions: usize,
        wanted: &Wanted,
        counters: &mut RenderCounters,
    ) -> Selection {
        if dimensions == 2 {
            self.select_in::<2>(states, wanted, counters)
        } else {
            self.select_in::<3>(states, wanted, counters)
        }
    }

    fn select_in<const D: usize>(
        &mut self,
        states: [&[f32]; 2],
        wanted: &Wanted,
        counters: &mut RenderCounters,
    ) -> Selection {
        let states = states.map(|flat| flat.as_chunks::<D>().0);
        let states = if std::ptr::eq(states[0], states[1]) { &states[1..] } else { &states[..] };
        let lengths = match self.lengths.take() {
            Some(lengths) => lengths,
            None => self.chunks.iter().map(|chunk| chunk.length(states[states.len() - 1])).collect(),
        };
        let whole = *self.whole.get_or_insert_with(|| {
            counters.points_bounded += (states.len() * self.order.len()) as u64;
            extent(states.iter().flat_map(|points| points.iter()))
        });
        // In the plane all is equally near, and what is all in view needs no closer look.
        let groups = match self.groups.take() {
            None if D == 2 && wanted.sight.holds(&whole) => None,
            None => {
                counters.points_bounded += (states.len() * self.order.len()) as u64;
                Some(self.bound_groups(states))
            }
            groups => groups,
        };
        let selection = self.pick(groups.as_deref(), &lengths, &whole, wanted);
        (self.groups, self.lengths) = (groups, Some(lengths));
        selection
    }

    fn bound_groups<const D: usize>(&self, states: &[&[[f32; D]]]) -> Vec<Extent> {
        let of_group = |group: &[u32]| {
            extent(group.iter().flat_map(|&point| states.iter().filter_map(move |points| points.get(point as usize))))
        };
        self.order.chunks(GROUP).map(of_group).collect()
    }

    /// The pinned points: they are shown where nothing else is.
    pub(super) fn pins(&self) -> Range<u32> {
        self.common..self.order.len() as u32
    }

    /// Takes what is in view by the boxes of the groups; without them, everything.
    fn pick(&self, groups: Option<&[Extent]>, lengths: &[f64], whole: &Extent, wanted: &Wanted) -> Selection {
        let mut selection = Selection::default();
        for (index, (chunk, &length)) in self.chunks.iter().zip(lengths).enumerate() {
            let extent = groups.map_or(*whole, |groups| self.bound_chunk(chunk, groups));
            if groups.is_some() && !wanted.sight.meets(&extent) {
                continue;
            }
            let pixels = length * wanted.sight.pixels_per_metre(&extent);
            let (strokes, dots) = chunk.counts(&Detail::new(pixels, wanted.width, chunk.per_point, wanted.radius));
            let first = (index * CHUNK) as u32;
            add(&mut selection.strokes, first, strokes, chunk.len);
            add(&mut selection.dots, first, dots, chunk.len);
        }
        let (common, count) = (self.common, self.order.len() as u32);
        if wanted.points_faded {
            selection.add_points(common..count);
        } else if let Some(groups) = groups {
            for (index, _) in groups.iter().enumerate().filter(|(_, extent)| wanted.sight.meets(extent)) {
                let first = (index * GROUP) as u32;
                selection.add_points(first..(first + GROUP as u32).min(count));
            }
        } else {
            selection.add_points(0..count);
        }
        selection
    }

    fn bound_chunk(&self, chunk: &Chunk, groups: &[Extent]) -> Extent {
        self.touched[chunk.groups.clone()].iter().fold(Extent::NONE, |mut all, &group| {
            all.unite(&groups[group as usize]);
            all
        })
    }
}

impl Chunk {
    /// Mean length of the bonds now `[m]`, from what became of a few.
    fn length<const D: usize>(&self, points: &[[f32; D]]) -> f64 {
        let length = |[a, b]: [u32; 2]| {
            let (Some(a), Some(b)) = (points.get(a as usize), points.get(b as usize)) else { return f64::NAN };
            (0..D).map(|axis| f64::from(a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
        };
        let now: f64 = self.samples.map(length).iter().sum();
        if self.samples_rest > 0.0 { self.rest * now / self.samples_rest } else { now / SAMPLES as f64 }
    }

    /// How many strokes and dots these shares are. A chunk that is not a whole one is not in an order that its first few
    /// bonds could stand for: it is drawn whole.
    fn counts(&self, detail: &Detail) -> (u32, u32) {
        if *detail == Detail::ALL || (self.len as usize) < CHUNK {
            return (self.len, 0);
        }
        let strokes = rounded(detail.strokes * f64::from(self.len));
        // However small it is, something of it is seen.
        (strokes, rounded(detail.dots * f64::from(self.len)).max(1))
    }
}

/// A count, up to the next of eight steps from each power of two to the next: chunks of about the same count share a
/// draw call.
fn rounded(count: f64) -> u32 {
    let count = (count.ceil() as u32).min(CHUNK as u32);
    count.next_multiple_of((count.next_power_of_two() / 16).max(1))
}

fn extent<'a, const D: usize>(points: impl Iterator<Item = &'a [f32; D]>) -> Extent {
    points.fold(Extent::NONE, |mut all, point| {
        all.include(point);
        all
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_go_on_where_they_can() {
        let chunk = CHUNK as u32;
        let mut runs = Vec::new();
        for (index, count) in [chunk, chunk, 64, 64, 64, 32, 0, 32, chunk, 10].into_iter().enumerate() {
            add(&mut runs, index as u32 * chunk, count, if count == 10 { 10 } else { chunk });
        }
        let run = |first: u32, count, chunks| Run { first: first * chunk, count, chunks };
        assert_eq!(runs, [run(0, 2 * chunk, 1), run(2, 64, 3), run(5, 32, 1), run(7, 32, 1), run(8, chunk + 10, 1)]);
    }

    #[test]
    fn counts_come_in_steps_of_an_eighth_at_most() {
        assert_eq!([0.0, 0.2, 1.0, 16.5, 17.0, 100.0, 1023.5].map(rounded), [0, 1, 1, 18, 18, 104, 1024]);
        for count in 1..=CHUNK as u32 {
            let up = rounded(f64::from(count));
            assert!(up >= count && up <= count + count / 8 + 1 && up <= CHUNK as u32, "{count}: {up}");
        }
    }

    #[test]
    fn a_chunk_is_never_gone_and_a_part_of_one_is_drawn_whole() {
        let bonds: Vec<GpuBond> = (0..CHUNK as u32 + 9).map(|a| GpuBond::new(a, a + 1, 1.0)).collect();
        let order: Vec<u32> = (0..=bonds.len() as u32).collect();
        let chunks = Chunks::new(order.clone(), &order, order.len() as u32, &bonds);
        let nothing = Detail { strokes: 0.0, dots: 0.0 };
        assert_eq!(chunks.chunks[0].counts(&nothing), (0, 1));
        assert_eq!(chunks.chunks[1].counts(&nothing), (9, 0));
        assert_eq!(chunks.chunks[0].counts(&Detail::ALL), (CHUNK as u32, 0));
        assert!(!chunks.is_surface(), "a string");
    }

    #[test]
    fn close_ranges_of_points_are_one() {
        let mut selection = Selection::default();
        for range in [0..64, 64..128, 256..320, 512..576, 576..576, 1000..1000] {
            selection.add_points(range);
        }
        assert_eq!(selection.points, [0..320, 512..576]);
    }
}
