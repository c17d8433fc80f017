//! The medial line of strokes, one pixel wide, as a graph.

use super::bits::Bits;
use super::thin::{Pixel, neighbours};

/// Whether a pixel may go without changing how its neighbours are connected, by which of them are set.
///
/// Model: as many runs of set pixels around it as it connects; one. A diagonal neighbour connects by itself.
/// Source: S. Yokoi, J. Toriwaki, T. Fukumura (1975), the connectivity number for 8-connected sets.
const fn is_simple(around: u8) -> bool {
    let (mut k, mut runs) = (0, 0);
    while k < 8 {
        let (here, next, after) =
            (around.rotate_right(k) & 1, around.rotate_right(k + 1) & 1, around.rotate_right(k + 2) & 1);
        runs += (1 - here) & (next | after);
        k += 2;
    }
    runs == 1
}

/// Places in [`Bits::around`] of the four sides that are peeled in turn: north, south, east, west.
const SIDES: [u8; 4] = [2, 6, 0, 4];

/// Peels the pixels of a stroke off the ink until only a line is left; what is no stroke stays, and holds the ends.
///
/// Model: pixels on one side at a time, those that connect nothing and end no line.
pub(super) fn peel(ink: &mut Bits, stroke: &[Pixel]) -> Vec<Pixel> {
    let mut line = stroke.to_vec();
    loop {
        let before = line.len();
        for side in SIDES {
            let may_go = |ink: &Bits, [x, y]: Pixel| {
                let around = ink.around(x, y);
                is_simple(around) && around.count_ones() > 1
            };
            let edge: Vec<Pixel> = line
                .iter()
                .copied()
                .filter(|&[x, y]| ink.around(x, y) >> side & 1 == 0 && may_go(ink, [x, y]))
                .collect();
            for [x, y] in edge {
                if may_go(ink, [x, y]) {
                    ink.set(x, y, false);
                }
            }
            line.retain(|&[x, y]| ink.get(x, y));
        }
        if line.len() == before {
            return line;
        }
    }
}

/// A graph of pixels: chains between ends, junctions, and roots, where a line meets thick ink.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Graph {
    pub(super) nodes: Vec<Node>,
    /// From node to node, with all pixels from the first to the last.
    pub(super) chains: Vec<Chain>,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) pixel: Pixel,
    /// A pixel of each thick part that it touches, and that no better placed pixel beside it ties.
    pub(super) roots: Vec<Pixel>,
    /// Chains that begin or end here.
    pub(super) degree: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chain {
    pub(super) ends: [usize; 2],
    pub(super) pixels: Vec<Pixel>,
}

impl Chain {
    /// Length along the pixels `[px]`.
    pub(super) fn length(&self) -> f64 {
        let step = |pair: &[Pixel]| {
            let is_diagonal = pair[0][0] != pair[1][0] && pair[0][1] != pair[1][1];
            if is_diagonal { std::f64::consts::SQRT_2 } else { 1.0 }
        };
        self.pixels.windows(2).map(step).sum()
    }
}

/// The graph of the lines in a bitmap that holds nothing else; `core` is the thick ink that they may touch.
pub(super) fn graph(lines: &Bits, pixels: &[Pixel], core: &Bits) -> Graph {
    let mut sorted: Vec<Pixel> = pixels.to_vec();
    sorted.sort_unstable_by_key(|&[x, y]| [y, x]);
    let mut graph = Graph::default();
    for &pixel in &sorted {
        let roots = roots(lines, core, pixel);
        if !roots.is_empty() || steps(lines, pixel).count() != 2 {
            graph.nodes.push(Node { pixel, roots, degree: 0 });
        }
    }
    let mut open = lines.clone();
    for k in 0..graph.nodes.len() {
        graph.follow(lines, &mut open, k);
    }
    // What is left are rings without a node.
    for &[x, y] in &sorted {
        if open.get(x, y) {
            graph.nodes.push(Node { pixel: [x, y], roots: Vec::new(), degree: 0 });
            let k = graph.nodes.len() - 1;
            graph.follow(lines, &mut open, k);
        }
    }
    for k in 0..graph.chains.len() {
        graph.chains[k].ends.iter().for_each(|&end| graph.nodes[end].degree += 1);
    }
    graph
}

impl Graph {
    /// Adds the chains that begin at a node, but for those found from their other end.
    fn follow(&mut self, lines: &Bits, open: &mut Bits, node: usize) {
        let start = self.nodes[node].pixel;
        open.set(start[0], start[1], false);
        let firsts: Vec<Pixel> = steps(lines, start).collect();
        for first in firsts {
            let mut pixels = vec![start, first];
            let end = loop {
                let [.., before, at] = pixels[..] else { break node };
                if let Some(k) = self.nodes.iter().position_of(at) {
                    break k;
                }
                open.set(at[0], at[1], false);
                let Some(next) = steps(lines, at).find(|&next| next != before) else { break node };
                pixels.push(next);
            };
            let last = pixels[pixels.len() - 2];
            if (start, first) <= (self.nodes[end].pixel, last) {
                self.chains.push(Chain { ends: [node, end], pixels });
            }
        }
    }
}

/// Finding the node at a pixel: nodes are sorted row by row, but for the last few.
trait PositionOf {
    fn position_of(self, pixel: Pixel) -> Option<usize>;
}

impl PositionOf for std::slice::Iter<'_, Node> {
    fn position_of(self, pixel: Pixel) -> Option<usize> {
        let nodes = self.as_slice();
        let key = |[x, y]: Pixel| [y, x];
        let found = nodes.binary_search_by_key(&key(pixel), |node| key(node.pixel)).ok();
        found.or_else(|| nodes.last().filter(|node| node.pixel == pixel).map(|_| nodes.len() - 1))
    }
}

/// A pixel of each run of thick ink around a pixel of a line, but for runs that a pixel beside it touches too and that
/// is nearer to the end of its line.
fn roots(lines: &Bits, core: &Bits, pixel: Pixel) -> Vec<Pixel> {
    let touched: Vec<Pixel> = neighbours(core, pixel).collect();
    if touched.is_empty() {
        return Vec::new();
    }
    let rank = |[x, y]: Pixel| (steps(lines, [x, y]).count(), y, x);
    let better = neighbours(lines, pixel).filter(|&other| rank(other) < rank(pixel));
    let tied: Vec<Pixel> = better.flat_map(|other| neighbours(core, other)).collect();
    let is_near = |a: &Pixel, b: &Pixel| a[0].abs_diff(b[0]) <= 1 && a[1].abs_diff(b[1]) <= 1;
    let mut runs: Vec<Vec<Pixel>> = Vec::new();
    for one in touched {
        let (near, mut far): (Vec<_>, Vec<_>) =
            runs.into_iter().partition(|run: &Vec<Pixel>| run.iter().any(|other| is_near(&one, other)));
        far.push(near.into_iter().flatten().chain([one]).collect());
        runs = far;
    }
    // Rather the pixel beside it than one across a corner.
    let across = |[x, y]: &Pixel| *x != pixel[0] && *y != pixel[1];
    let is_free = |run: &&Vec<Pixel>| !run.iter().any(|one| tied.iter().any(|other| is_near(one, other)));
    runs.iter().filter(is_free).filter_map(|run| run.iter().min_by_key(|one| across(one)).copied()).collect()
}

/// Pixels that follow one on a line: its four neighbours, and a diagonal one where no other leads there.
fn steps(lines: &Bits, [x, y]: Pixel) -> impl Iterator<Item = Pixel> {
    let around = lines.around(x, y);
    neighbours(lines, [x, y]).filter(move |&[u, v]| {
        let is_diagonal = u != x && v != y;
        let east = if u > x { 0 } else { 4 };
        let north = if v > y { 6 } else { 2 };
        !is_diagonal || (around >> east | around >> north) & 1 == 0
    })
}
