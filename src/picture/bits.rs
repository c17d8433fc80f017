//! A bitmap of one bit a pixel: 64 pixels at once, for morphology.

use rayon::prelude::*;

use super::Coverage;

/// Pixels that are set, with an empty margin of one pixel around: pixel (x, y) of the picture is bit (x + 1, y + 1).
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Bits {
    /// Width with margins `[px]`.
    pub(super) width: usize,
    /// Height with margins `[px]`.
    pub(super) height: usize,
    /// Words a row.
    pub(super) stride: usize,
    words: Vec<u64>,
}

/// High bit of each byte of a word.
const HIGH: u64 = 0x8080_8080_8080_8080;

impl Bits {
    /// The pixels that are ink.
    pub(super) fn ink(coverage: &Coverage) -> Self {
        let mut bits = Bits::empty(coverage.width + 2, coverage.height + 2);
        let rows = bits.words.par_chunks_mut(bits.stride).skip(1).zip(coverage.values.par_chunks(coverage.width));
        rows.with_min_len(64).for_each(|(row, values)| pack(row, values, coverage.level));
        bits
    }

    /// No pixel set.
    pub(super) fn empty(width: usize, height: usize) -> Self {
        let stride = width.div_ceil(64);
        Bits { width, height, stride, words: vec![0; stride * height] }
    }

    pub(super) fn row(&self, y: usize) -> &[u64] {
        &self.words[y * self.stride..(y + 1) * self.stride]
    }

    pub(super) fn get(&self, x: usize, y: usize) -> bool {
        self.words[y * self.stride + x / 64] >> (x % 64) & 1 == 1
    }

    pub(super) fn set(&mut self, x: usize, y: usize, value: bool) {
        let word = &mut self.words[y * self.stride + x / 64];
        *word = *word & !(1 << (x % 64)) | u64::from(value) << (x % 64);
    }

    /// Which of the 8 neighbours of a pixel are set, as bits: east, north-east, and on anticlockwise as seen.
    ///
    /// Valid range: not on the margin.
    pub(super) fn around(&self, x: usize, y: usize) -> u8 {
        let at = |dx: usize, dy: usize| u8::from(self.get(x + dx - 1, y + dy - 1));
        at(2, 1)
            | at(2, 0) << 1
            | at(1, 0) << 2
            | at(0, 0) << 3
            | at(0, 1) << 4
            | at(0, 2) << 5
            | at(1, 2) << 6
            | at(2, 2) << 7
    }

    /// The pixels that are set, row by row.
    pub(super) fn pixels(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.words.iter().enumerate().filter(|(_, word)| **word != 0).flat_map(|(k, &word)| {
            let (x, y) = (k % self.stride * 64, k / self.stride);
            ones(word).map(move |bit| [x + bit, y])
        })
    }

    /// Set here and not there.
    pub(super) fn without(&self, other: &Bits) -> Bits {
        let words = self.words.iter().zip(&other.words).map(|(a, b)| a & !b).collect();
        Bits { words, ..*self }
    }

    /// The union of all octagons of this width `[px]` that fit in: what is thinner is lost.
    ///
    /// Model: the octagon is the Minkowski sum of a horizontal, a vertical and two diagonal segments, whose lengths are
    /// those of a regular one, rounded; eroded and dilated by each in turn, in steps that double.
    /// Valid range: 1, which changes nothing, and up.
    pub(super) fn opened(&self, width: usize) -> Bits {
        // Sides of a regular octagon: sqrt(2) - 1 of its width, and 1 - 1/sqrt(2) of it along each axis.
        let slant = ((width - 1) as f64 * 0.2929).round() as usize;
        let straight = width - 1 - 2 * slant;
        let sides = [([1, 0], straight), ([0, 1], straight), ([1, 1], slant), ([1, -1], slant)];
        let eroded = sides.iter().fold(self.clone(), |bits, &(side, length)| bits.swept(side, length, |a, b| a & b));
        let back = |[x, y]: [isize; 2]| [-x, -y];
        sides.iter().fold(eroded, |bits, &(side, length)| bits.swept(back(side), length, |a, b| a | b))
    }

    /// Each pixel combined with the `length` pixels that follow it in a direction.
    pub(super) fn swept(self, [x, y]: [isize; 2], length: usize, both: impl Fn(u64, u64) -> u64) -> Bits {
        let (mut bits, mut done) = (self, 1);
        while done < length + 1 {
            let step = done.min(length + 1 - done);
            bits = bits.combined([x * step as isize, y * step as isize], &both);
            done += step;
        }
        bits
    }

    /// Each pixel combined with the one that lies (dx, dy) from it; beyond the bitmap all are empty.
    fn combined(&self, [dx, dy]: [isize; 2], both: impl Fn(u64, u64) -> u64) -> Bits {
        let mut out = Bits::empty(self.width, self.height);
        let (skip, shift) = (dx.div_euclid(64), dx.rem_euclid(64) as u32);
        let last = if self.width.is_multiple_of(64) { u64::MAX } else { (1 << (self.width % 64)) - 1 };
        let none = vec![0; self.stride];
        for y in 0..self.height {
            let from = y as isize + dy;
            let other = if (0..self.height as isize).contains(&from) { self.row(from as usize) } else { &none };
            let word = |k: isize| usize::try_from(k).ok().and_then(|k| other.get(k)).copied().unwrap_or(0);
            for (k, to) in out.words[y * self.stride..(y + 1) * self.stride].iter_mut().enumerate() {
                let at = k as isize + skip;
                let high = if shift == 0 { 0 } else { word(at + 1) << (64 - shift) };
                *to = both(self.words[y * self.stride + k], word(at) >> shift | high);
            }
            out.words[(y + 1) * self.stride - 1] &= last;
        }
        out
    }
}

/// Places of the bits that are set, from the lowest.
pub(super) fn ones(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = word.trailing_zeros() as usize;
        (word != 0).then(|| {
            word &= word - 1;
            bit
        })
    })
}

/// Sets the bits of one row, from bit 1 on, where values are above the level: eight bytes at once.
fn pack(row: &mut [u64], values: &[u8], level: u8) {
    let least = u64::from_ne_bytes([level + 1; 8]);
    let (eights, rest) = values.as_chunks::<8>();
    let mut put = |at: usize, byte: u64| {
        row[at / 64] |= byte << (at % 64);
        if at % 64 > 56 && byte >> (64 - at % 64) != 0 {
            row[at / 64 + 1] |= byte >> (64 - at % 64);
        }
    };
    for (k, eight) in eights.iter().enumerate() {
        let value = u64::from_le_bytes(*eight);
        // Bytes compare by their low seven bits through a subtraction that cannot borrow, then by their high bit.
        let low = (value | HIGH) - (least & !HIGH);
        let above = if least & HIGH == 0 { value | low } else { value & low } & HIGH;
        put(8 * k + 1, (above >> 7).wrapping_mul(0x0102_0408_1020_4080) >> 56);
    }
    for (k, &value) in rest.iter().enumerate() {
        put(8 * eights.len() + k + 1, u64::from(value > level));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(width: usize, height: usize, seed: u64) -> Coverage {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 56) as u8
        };
        let level = next().min(254);
        Coverage { width, height, values: (0..width * height).map(|_| next()).collect(), level }
    }

    #[test]
    fn packing_is_the_comparison_of_each_pixel() {
        for (k, width) in [1, 7, 8, 62, 63, 64, 65, 200].into_iter().enumerate() {
            for seed in 0..20 {
                let coverage = noise(width, 3, seed + 100 * k as u64);
                let bits = Bits::ink(&coverage);
                for y in 0..5 {
                    for x in 0..width + 2 {
                        let inside = (1..=width).contains(&x) && (1..=3).contains(&y);
                        let want = inside && coverage.values[(y - 1) * width + x - 1] > coverage.level;
                        assert_eq!(bits.get(x, y), want, "width {width} seed {seed} at {x}, {y}");
                    }
                }
                assert_eq!(bits.pixels().count(), coverage.values.iter().filter(|&&v| v > coverage.level).count());
            }
        }
    }

    #[test]
    fn opening_keeps_what_the_octagon_fits_in() {
        for width in 1..20 {
            for bar in 1..20 {
                let mut values = vec![0; 100 * 40];
                values
                    .iter_mut()
                    .enumerate()
                    .for_each(|(k, v)| *v = 255 * u8::from((10..10 + bar).contains(&(k / 100))));
                let bits = Bits::ink(&Coverage { width: 100, height: 40, values, level: 127 });
                let opened = bits.opened(width);
                assert_eq!(opened.pixels().count() > 0, bar >= width, "bar {bar}, octagon {width}");
                assert_eq!(opened.without(&bits).pixels().count(), 0);
                assert_eq!(opened.opened(width), opened);
            }
        }
    }
}
