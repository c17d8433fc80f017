//! Strokes as lines: the graph of their medial pixels without spurs, its chains smoothed.

use super::bits::Bits;
use super::plane::{Point, between, distance, doubled_area};
use super::skeleton::{self, Chain, Graph, graph, peel};
use super::thin::Pixel;

/// The medial lines of thin strokes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Strands {
    /// Ends and junctions.
    pub nodes: Vec<Node>,
    /// Lines between them.
    pub lines: Vec<Line>,
}

/// Where a line ends, or lines meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Where it is `[px]`.
    pub place: Point,
    /// A place in the thick ink that it touches, to whose mesh it is to be tied `[px]`.
    pub root: Option<Point>,
}

/// A smooth line from node to node.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Its nodes: the same one twice for a ring.
    pub ends: [u32; 2],
    /// Places along it, one a pixel, from end to end `[px]`.
    pub points: Vec<Point>,
    /// Mean width of the stroke `[px]`: its pixels over its length.
    pub width: f64,
}

impl Line {
    /// Length `[px]`.
    pub fn length(&self) -> f64 {
        self.points.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
    }
}

/// Spurs and links between junctions shorter than this share of the spacing are taken for noise of the stroke's edge.
const SPUR: f64 = 0.4;

/// The lines of strokes, which are taken off the ink.
pub(super) fn strands(ink: &mut Bits, strokes: &[Vec<Pixel>], spacing: f64) -> Strands {
    let mut core = ink.clone();
    strokes.iter().flatten().for_each(|&[x, y]| core.set(x, y, false));
    let mut strands = Strands::default();
    let mut lines = Bits::empty(ink.width, ink.height);
    for stroke in strokes {
        let mut pixels = peel(ink, stroke);
        pixels.iter().for_each(|&[x, y]| lines.set(x, y, true));
        let mut found = graph(&lines, &pixels, &core);
        for _ in 0..3 {
            if !prune(&mut lines, &mut pixels, &found, SPUR * spacing) {
                break;
            }
            found = graph(&lines, &pixels, &core);
        }
        strands.add(&found, stroke.len(), SPUR * spacing);
    }
    strokes.iter().flatten().for_each(|&[x, y]| ink.set(x, y, false));
    strands
}

/// Takes away short chains that lead from a junction to nowhere; whether there were any.
fn prune(lines: &mut Bits, pixels: &mut Vec<Pixel>, graph: &Graph, limit: f64) -> bool {
    let before = pixels.len();
    for chain in &graph.chains {
        let [a, b] = chain.ends.map(|end| &graph.nodes[end]);
        let is_free = |node: &skeleton::Node| node.degree == 1 && node.roots.is_empty();
        let is_spur = is_free(a) != is_free(b) && (is_free(a) || is_free(b)) && chain.length() < limit;
        if is_spur {
            let junction = if is_free(a) { b.pixel } else { a.pixel };
            chain.pixels.iter().filter(|pixel| **pixel != junction).for_each(|&[x, y]| lines.set(x, y, false));
        }
    }
    pixels.retain(|&[x, y]| lines.get(x, y));
    pixels.len() < before
}

impl Strands {
    /// Adds the graph of one stroke. Junctions with next to no length between them become one, as long as that lies near all of
    /// them: in grain nearly every pixel is a junction.
    fn add(&mut self, graph: &Graph, area: usize, limit: f64) {
        let mut joined: Vec<usize> = (0..graph.nodes.len()).collect();
        let roots: Vec<Vec<Pixel>> = graph.nodes.iter().map(|node| node.roots.clone()).collect();
        let mut is_gone = vec![false; graph.chains.len()];
        // The chains that join each node to others.
        let mut links: Vec<Vec<usize>> = vec![Vec::new(); graph.nodes.len()];
        for (k, chain) in graph.chains.iter().enumerate() {
            let [a, b] = chain.ends.map(|end| first(&joined, end));
            let is_link =
                chain.ends.iter().all(|&end| graph.nodes[end].degree > 1 || !graph.nodes[end].roots.is_empty());
            let is_near = || {
                let [a, b] = [a, b].map(|node| place(graph.nodes[node].pixel));
                chain.length() < limit && distance(a, b) < limit
            };
            if a != b && is_link && is_near() && (roots[a].is_empty() || roots[b].is_empty()) {
                let (to, from) = if roots[a].is_empty() { (b, a) } else { (a, b) };
                joined[from] = to;
                is_gone[k] = true;
                chain.ends.iter().for_each(|&end| links[end].push(k));
            }
        }
        let mut numbers = vec![u32::MAX; graph.nodes.len()];
        for k in 0..graph.nodes.len() {
            if first(&joined, k) == k {
                numbers[k] = self.nodes.len() as u32;
                self.nodes
                    .push(Node { place: place(graph.nodes[k].pixel), root: roots[k].first().copied().map(place) });
                self.tie(numbers[k], &roots[k]);
            }
        }
        let length: f64 = graph.chains.iter().map(Chain::length).sum::<f64>().max(1.0);
        for (chain, _) in graph.chains.iter().zip(is_gone).filter(|(_, is_gone)| !is_gone) {
            let joints = chain.ends.map(|end| first(&joined, end));
            // To the joint along what was joined, not straight: a ring would run out and back.
            let mut pixels = way(graph, &links, joints[0], chain.ends[0]);
            pixels.extend(&chain.pixels[1..]);
            pixels.extend(&way(graph, &links, chain.ends[1], joints[1])[1..]);
            if joints[0] == joints[1] && enclosed(&pixels) < LEAST_RING {
                continue;
            }
            let points = smooth(pixels.into_iter().map(place).collect());
            let ends = joints.map(|joint| numbers[joint]);
            self.lines.push(Line { ends, points, width: area as f64 / length });
        }
    }
}

/// Least area inside a ring of pixel centres `[px^2]`: four pixels about a hole of one have 2, four in a square 1.
const LEAST_RING: f64 = 1.5;

/// Area inside a closed line of pixels `[px^2]`.
fn enclosed(pixels: &[Pixel]) -> f64 {
    let points: Vec<Point> = pixels.iter().copied().map(place).collect();
    0.5 * doubled_area(&points).abs()
}

/// Most joined nodes that are searched for a way: in noise nearly all are joined, and the ways between them long.
const FARTHEST: usize = 16;

/// The pixels from one node to another that it is joined with, along the chains that join them; both ends among them.
/// Where more than [`FARTHEST`] are joined, the ends alone.
fn way(graph: &Graph, links: &[Vec<usize>], from: usize, to: usize) -> Vec<Pixel> {
    // Joined nodes are a tree: the way back from each node leads over the one that it was found from.
    let mut found = vec![(to, usize::MAX, usize::MAX)];
    let mut at = 0;
    while at < found.len() && found[at].0 != from {
        if found.len() > FARTHEST {
            return vec![graph.nodes[from].pixel, graph.nodes[to].pixel];
        }
        let (node, _, through) = found[at];
        for &k in links[node].iter().filter(|&&k| k != through) {
            let [a, b] = graph.chains[k].ends;
            found.push((if a == node { b } else { a }, at, k));
        }
        at += 1;
    }
    let mut pixels = vec![graph.nodes[from].pixel];
    while let Some(&(node, before, k)) = found.get(at).filter(|(node, ..)| *node != to) {
        let chain = &graph.chains[k];
        if chain.ends[0] == node {
            pixels.extend(&chain.pixels[1..]);
        } else {
            pixels.extend(chain.pixels.iter().rev().skip(1));
        }
        at = before;
    }
    pixels
}

impl Strands {
    /// A node between several thick parts is tied to the second and on by lines of a pixel.
    fn tie(&mut self, node: u32, roots: &[Pixel]) {
        let from = self.nodes[node as usize].place;
        for &root in roots.iter().skip(1) {
            let to = self.nodes.len() as u32;
            self.nodes.push(Node { place: place(root), root: Some(place(root)) });
            self.lines.push(Line { ends: [node, to], points: vec![from, place(root)], width: 0.0 });
        }
    }
}

fn first(joined: &[usize], mut k: usize) -> usize {
    while joined[k] != k {
        k = joined[k];
    }
    k
}

/// The middle of a pixel `[px]`.
fn place([x, y]: Pixel) -> Point {
    [x as f64 - 0.5, y as f64 - 0.5]
}

/// Fewest pixels of a line that is smoothed.
const FEW: usize = 8;

/// Levels the steps of a line of pixels: each point to the mean of its neighbours, four times.
///
/// A line of a few pixels stays: smoothed, two of them about a hole of one pixel would fall onto each other.
fn smooth(mut points: Vec<Point>) -> Vec<Point> {
    if points.len() < FEW {
        return points;
    }
    for _ in 0..4 {
        let old = points.clone();
        for k in 1..old.len() - 1 {
            points[k] = between(old[k], between(old[k - 1], old[k + 1], 0.5), 0.5);
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::super::Coverage;
    use super::super::thin::thin_parts;
    use super::*;

    fn strands_of(ink: impl Fn(f64, f64) -> bool) -> Strands {
        let values = (0..200 * 200).map(|k| 255 * u8::from(ink((k % 200) as f64, (k / 200) as f64))).collect();
        let mut bits = Bits::ink(&Coverage { width: 200, height: 200, values, level: 127 });
        let thin = thin_parts(&bits, 8, 16.0);
        strands(&mut bits, &thin.strokes, 16.0)
    }

    #[test]
    fn a_line_has_two_ends_its_length_and_its_width() {
        for width in [1.0, 3.0, 6.0] {
            let line = strands_of(|x, y| (20.0..180.0).contains(&x) && (100.0..100.0 + width).contains(&y));
            assert_eq!((line.nodes.len(), line.lines.len()), (2, 1));
            assert!((line.lines[0].length() - 160.0).abs() <= width + 1.0);
            assert!((line.lines[0].width - width).abs() <= 0.1 * width);
        }
    }

    #[test]
    fn a_cross_has_one_junction_and_a_ring_one_node() {
        let cross = strands_of(|x, y| {
            ((20.0..180.0).contains(&x) && (y - 100.0).abs() < 3.0)
                || ((20.0..180.0).contains(&y) && (x - 90.0).abs() < 3.0)
        });
        assert_eq!((cross.nodes.len(), cross.lines.len()), (5, 4));
        for width in [1.0, 3.0, 6.0] {
            let ring = strands_of(|x, y| ((x - 100.0).hypot(y - 100.0) - 60.0).abs() < 0.5 * width);
            assert_eq!((ring.nodes.len(), ring.lines.len()), (1, 1), "width {width}");
            let length = std::f64::consts::TAU * 60.0;
            assert!((ring.lines[0].length() - length).abs() < 0.05 * length, "{}", ring.lines[0].length());
        }
    }

    #[test]
    fn a_line_on_a_disc_has_a_root() {
        let one =
            strands_of(|x, y| (x - 60.0).hypot(y - 100.0) < 40.0 || x < 190.0 && x > 60.0 && (y - 100.0).abs() < 2.0);
        assert_eq!((one.nodes.len(), one.lines.len()), (2, 1));
        assert_eq!(one.nodes.iter().filter(|node| node.root.is_some()).count(), 1);
    }
}
