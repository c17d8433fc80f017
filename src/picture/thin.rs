//! Which parts of the ink are too thin for triangles: what its opening loses, unless that is a mere corner.

use super::bits::Bits;

/// A pixel of a bitmap, margin included.
pub(super) type Pixel = [usize; 2];

/// The thin parts of the ink.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Thin {
    /// Strokes, each with its pixels: connected, and not to each other.
    pub(super) strokes: Vec<Vec<Pixel>>,
    /// Pixels of hairs: too thin for triangles and too short for a rope.
    pub(super) hairs: Vec<Pixel>,
}

/// A thin part, measured.
struct Part {
    pixels: Vec<Pixel>,
    /// Places at which it meets thick ink.
    contacts: usize,
    /// How many of its pixels do.
    mouth: usize,
    /// Steps from there to the end, or from end to end if it meets none.
    depth: usize,
}

/// What becomes of a thin part.
enum Fate {
    Stays,
    Stroke,
    Hair,
}

/// Thick spots on strokes with fewer pixels than this many squares of the width are part of the stroke: such a spot
/// would be two triangles. Crossings of strokes make them.
const SPOT: usize = 3;

/// Finds what is thinner than `width` pixels, for points that will be `spacing` px apart.
///
/// Valid range: a width of 1 and less finds nothing.
pub(super) fn thin_parts(ink: &Bits, width: usize, spacing: f64) -> Thin {
    let mut thin = Thin::default();
    if width < 2 {
        return thin;
    }
    let mut core = ink.opened(width);
    let mut rest = ink.without(&core);
    absorb(&mut core, &mut rest, width);
    let starts: Vec<Pixel> = rest.pixels().collect();
    let mut left = rest;
    for start in starts {
        if !left.get(start[0], start[1]) {
            continue;
        }
        let part = measure(&mut left, &core, start);
        match fate(&part, width as f64, spacing) {
            Fate::Stays => {}
            Fate::Stroke => thin.strokes.push(part.pixels),
            Fate::Hair => thin.hairs.extend(part.pixels),
        }
    }
    thin
}

/// Makes thick spots on strokes part of them.
fn absorb(core: &mut Bits, rest: &mut Bits, width: usize) {
    let limit = SPOT * width * width;
    let beside: Vec<Pixel> = rest.pixels().filter(|&[x, y]| core.around(x, y) != 0).collect();
    for [x, y] in beside {
        let touched: Vec<Pixel> = neighbours(core, [x, y]).collect();
        for start in touched {
            if !core.get(start[0], start[1]) {
                continue;
            }
            let (spot, _) = flood(core, vec![start], limit);
            let is_spot = spot.len() < limit && is_long(rest, [x, y], 2 * width);
            let to = if is_spot { &mut *rest } else { &mut *core };
            spot.iter().for_each(|&[x, y]| to.set(x, y, true));
            if !is_spot {
                break;
            }
        }
    }
}

/// Whether a thin part has this many pixels at least: a spot with mere corners is no stroke.
fn is_long(rest: &mut Bits, start: Pixel, limit: usize) -> bool {
    let (part, _) = flood(rest, vec![start], limit);
    part.iter().for_each(|&[x, y]| rest.set(x, y, true));
    part.len() >= limit
}

/// Takes a part out of what is left, and measures it.
fn measure(left: &mut Bits, core: &Bits, start: Pixel) -> Part {
    let (pixels, _) = flood(left, vec![start], usize::MAX);
    let touching: Vec<Pixel> = pixels.iter().copied().filter(|&[x, y]| core.around(x, y) != 0).collect();
    touching.iter().for_each(|&[x, y]| left.set(x, y, true));
    let mut contacts = 0;
    for &[x, y] in &touching {
        if left.get(x, y) {
            contacts += 1;
            flood(left, vec![[x, y]], usize::MAX);
        }
    }
    let mut spread = |from: Vec<Pixel>| {
        pixels.iter().for_each(|&[x, y]| left.set(x, y, true));
        flood(left, from, usize::MAX)
    };
    let depth = if touching.is_empty() {
        let (order, _) = spread(vec![start]);
        spread(order.last().map_or(vec![start], |&end| vec![end])).1
    } else {
        spread(touching.clone()).1
    };
    Part { pixels, contacts, mouth: touching.len(), depth }
}

/// Decides by how long a part is, against the spacing and against its own width.
///
/// A corner of 30 degrees is a spacing deep where it is half a spacing wide; what is deeper than 1.5 is a needle. What
/// is long and as wide at its root as elsewhere is no corner. A bridge shorter than a spacing is a neck of the mesh: as
/// a rope it would be one short bond.
fn fate(part: &Part, width: f64, spacing: f64) -> Fate {
    let depth = part.depth as f64 + 1.0;
    let length = if part.contacts > 1 { 2.0 * depth } else { depth };
    let breadth = part.pixels.len() as f64 / length;
    let is_even = part.mouth as f64 <= 1.5 * breadth + 1.0;
    match part.contacts {
        0 if length >= spacing.max(2.0 * width) => Fate::Stroke,
        0 => Fate::Stays,
        1 if length > 1.5 * spacing || length > 0.5 * spacing && length > 5.0 * breadth && is_even => Fate::Stroke,
        1 if length > 3.0 * breadth && breadth < 0.2 * spacing && is_even => Fate::Hair,
        1 => Fate::Stays,
        _ if length >= spacing && breadth < 0.85 * width * part.contacts as f64 => Fate::Stroke,
        _ => Fate::Stays,
    }
}

/// Pixels that are set beside one.
pub(super) fn neighbours(bits: &Bits, [x, y]: Pixel) -> impl Iterator<Item = Pixel> + use<> {
    let around = bits.around(x, y);
    AROUND
        .iter()
        .enumerate()
        .filter(move |(k, _)| around >> k & 1 == 1)
        .map(move |(_, [dx, dy])| [x + dx - 1, y + dy - 1])
}

/// Neighbours in the order of [`Bits::around`], by their steps plus one.
const AROUND: [Pixel; 8] = [[2, 1], [2, 0], [1, 0], [0, 0], [0, 1], [0, 2], [1, 2], [2, 2]];

/// Takes out the pixels that are connected with the given ones, nearest first, up to `limit` of them, and counts the
/// steps to the farthest.
fn flood(bits: &mut Bits, start: Vec<Pixel>, limit: usize) -> (Vec<Pixel>, usize) {
    let mut found = start;
    found.iter().for_each(|&[x, y]| bits.set(x, y, false));
    let (mut at, mut layer_end, mut steps) = (0, found.len(), 0);
    while at < found.len() && found.len() < limit {
        if at == layer_end {
            (layer_end, steps) = (found.len(), steps + 1);
        }
        for [x, y] in neighbours(bits, found[at]) {
            bits.set(x, y, false);
            found.push([x, y]);
        }
        at += 1;
    }
    (found, steps)
}

#[cfg(test)]
mod tests {
    use super::super::Coverage;
    use super::*;

    fn drawn(ink: impl Fn(i32, i32) -> bool) -> Bits {
        let values = (0..100 * 100).map(|k| 255 * u8::from(ink(k % 100, k / 100))).collect();
        Bits::ink(&Coverage { width: 100, height: 100, values, level: 127 })
    }

    #[test]
    fn a_line_is_a_stroke_and_a_square_is_not() {
        let line = thin_parts(&drawn(|x, y| y == 50 && (10..90).contains(&x)), 8, 16.0);
        assert_eq!(line.strokes.iter().map(Vec::len).collect::<Vec<_>>(), [80]);
        let square = thin_parts(&drawn(|x, y| (20..50).contains(&x) && (20..50).contains(&y)), 8, 16.0);
        assert_eq!(square, Thin::default());
        let wedge = thin_parts(&drawn(|x, y| (10..50).contains(&x) && (y - 50).abs() * 2 < x - 10), 8, 16.0);
        assert_eq!(wedge, Thin::default());
    }

    #[test]
    fn a_handle_is_a_stroke_and_a_hair_is_dropped() {
        let disc = |x: i32, y: i32| (x - 30).pow(2) + (y - 50).pow(2) < 400;
        let handle = thin_parts(&drawn(|x, y| disc(x, y) || (49..52).contains(&y) && (30..90).contains(&x)), 8, 16.0);
        assert_eq!((handle.strokes.len(), handle.hairs.len()), (1, 0));
        assert!((110..130).contains(&handle.strokes[0].len()));
        let hair = thin_parts(&drawn(|x, y| disc(x, y) || y == 50 && (30..56).contains(&x)), 8, 16.0);
        assert_eq!((hair.strokes.len(), hair.hairs.len()), (0, 6));
    }

    #[test]
    fn a_spot_on_a_line_is_part_of_it() {
        let spot = |x: i32, y: i32| (x - 50).pow(2) + (y - 50).pow(2) < 25;
        let thin = thin_parts(&drawn(|x, y| spot(x, y) || y == 50 && (5..95).contains(&x)), 8, 16.0);
        assert_eq!(thin.strokes.len(), 1);
        let alone = thin_parts(&drawn(spot), 8, 16.0);
        assert_eq!(alone, Thin::default());
    }
}
