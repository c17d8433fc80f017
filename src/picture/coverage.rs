//! Pixels to ink: how much of each is covered, and from which share on it counts.

use rayon::prelude::*;

use super::{Picture, PictureError, Settings, Threshold};

/// How much of each pixel is covered, 0 to 255.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coverage {
    /// Width `[px]`.
    pub width: usize,
    /// Height `[px]`.
    pub height: usize,
    /// Coverage of each pixel, row by row from the top.
    pub values: Vec<u8>,
    /// A pixel is ink when its value is above this one. The contour is drawn half a step above it, so that no value
    /// lies on it.
    pub level: u8,
}

impl Coverage {
    /// The value on which the contour lies.
    pub fn iso(&self) -> f64 {
        f64::from(self.level) + 0.5
    }

    /// The threshold as a share of full coverage.
    pub fn threshold(&self) -> f64 {
        self.iso() / 255.0
    }
}

/// Pixels that a thread takes at a time.
pub(super) const PART: usize = 1 << 16;
/// Alpha below which a pixel is clear: half.
pub(super) const CLEAR: u8 = 128;

/// Coverage of a picture: alpha where any pixel is clear by half or more, else darkness on white paper; averaged, if asked
/// for; then the threshold.
///
/// Model: darkness = alpha (1 - (54 red + 183 green + 19 blue) / 256), the weights of Rec. 709 on the stored values. Pixels
/// that are nearly opaque tell nothing of a shape: programs leave some behind.
/// A picture of one value is all ink when that is above 1/2 (or the given threshold), else it is empty. Of the whole picture all is ink,
/// whatever its pixels are.
///
/// Errors: nothing is above the threshold.
pub fn cover(picture: &Picture, settings: &Settings) -> Result<Coverage, PictureError> {
    let (width, height) = (picture.width as usize, picture.height as usize);
    if settings.threshold == Threshold::Whole {
        return Ok(Coverage { width, height, values: vec![255; width * height], level: 127 });
    }
    let flip = if settings.invert { 255 } else { 0 };
    let (pixels, _) = picture.rgba.as_chunks::<4>();
    let least = pixels.par_chunks(PART).map(|part| part.iter().fold(255, |least, pixel| pixel[3].min(least)));
    let least = least.min().unwrap_or(255);
    let dark = |[red, green, blue, _]: [u8; 4]| {
        let light = 54 * u16::from(red) + 183 * u16::from(green) + 19 * u16::from(blue);
        255 - (light >> 8) as u8
    };
    let value = |pixel: [u8; 4]| {
        let over_white = |pixel: [u8; 4]| ((u16::from(dark(pixel)) * u16::from(pixel[3]) + 127) / 255) as u8;
        flip ^ match least {
            255 => dark(pixel),
            CLEAR.. => over_white(pixel),
            _ => pixel[3],
        }
    };
    let mut values = vec![0; pixels.len()];
    let parts = values.par_chunks_mut(PART).zip(pixels.par_chunks(PART));
    let counts = parts.map(|(values, pixels)| {
        values.iter_mut().zip(pixels).for_each(|(value_at, &pixel)| *value_at = value(pixel));
        histogram(values)
    });
    let counts = counts.reduce(|| [0; 256], |a, b| std::array::from_fn(|k| a[k] + b[k]));
    let counts = if settings.blur == 0 {
        counts
    } else {
        blur(&mut values, width, settings.blur as usize);
        histogram(&values)
    };
    let level = match settings.threshold {
        Threshold::Otsu | Threshold::Whole => otsu(&counts),
        Threshold::At(share) => (share * 255.0).clamp(0.0, 254.0) as u8,
    };
    if counts[usize::from(level) + 1..].iter().all(|&count| count == 0) {
        return Err(PictureError::Empty { threshold: (f64::from(level) + 0.5) / 255.0 });
    }
    Ok(Coverage { width, height, values, level })
}

/// Averages over a box of `reach` px to all sides, twice; beyond the picture its outermost pixels go on.
fn blur(values: &mut [u8], width: usize, reach: usize) {
    let (height, full) = (values.len() / width, 2 * reach as u32 + 1);
    for _ in 0..2 {
        let mut column = vec![0; width];
        for row in values.chunks_exact_mut(width) {
            column.copy_from_slice(row);
            let at = |x: usize| u32::from(column[x.saturating_sub(reach).min(width - 1)]);
            let mut sum: u32 = (0..2 * reach + 1).map(at).sum();
            for x in 0..width {
                row[x] = ((sum + full / 2) / full) as u8;
                sum = sum + at(x + 2 * reach + 1) - at(x);
            }
        }
        let old = values.to_vec();
        let row = |y: usize| &old[y.saturating_sub(reach).min(height - 1) * width..][..width];
        let mut sums = vec![0_u32; width];
        (0..2 * reach + 1).for_each(|y| sums.iter_mut().zip(row(y)).for_each(|(sum, &v)| *sum += u32::from(v)));
        for (y, to) in values.chunks_exact_mut(width).enumerate() {
            let (enters, leaves) = (row(y + 2 * reach + 1), row(y));
            for x in 0..width {
                to[x] = ((sums[x] + full / 2) / full) as u8;
                sums[x] = sums[x] + u32::from(enters[x]) - u32::from(leaves[x]);
            }
        }
    }
}

/// How often each value occurs. Eight equal values in a row count at once: most pictures are mostly flat.
fn histogram(values: &[u8]) -> [u64; 256] {
    let mut counts = [0; 256];
    let (eights, rest) = values.as_chunks::<8>();
    for eight in eights {
        if *eight == [eight[0]; 8] {
            counts[usize::from(eight[0])] += 8;
        } else {
            eight.iter().for_each(|&value| counts[usize::from(value)] += 1);
        }
    }
    rest.iter().for_each(|&value| counts[usize::from(value)] += 1);
    counts
}

/// The value that splits a histogram best: those above it are ink.
///
/// Model: the variance between the two classes, w0 w1 (m0 - m1)^2 with their shares w and means m, is largest. Between
/// two separate peaks it is the same all along the gap, and the middle of the gap is taken: there the edges of shapes
/// that are smoothed by half a pixel lie where they were drawn. One value alone is split at 127.
///
/// Source: N. Otsu, "A threshold selection method from gray-level histograms" (1979), eq. 18.
pub fn otsu(counts: &[u64; 256]) -> u8 {
    let total: u64 = counts.iter().sum();
    let sum: f64 = counts.iter().enumerate().map(|(value, &count)| value as f64 * count as f64).sum();
    let (mut below, mut sum_below) = (0, 0.0);
    let (mut best, mut first, mut last) = (0.0, 127, 127);
    for level in 0..255 {
        below += counts[level];
        sum_below += level as f64 * counts[level] as f64;
        let above = total - below;
        if below == 0 || above == 0 {
            continue;
        }
        let gap = sum_below / below as f64 - (sum - sum_below) / above as f64;
        let between = below as f64 * above as f64 * gap * gap;
        if between > best {
            (best, first, last) = (between, level, level);
        } else if between == best && last + 1 == level {
            last = level;
        }
    }
    ((first + last) / 2) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(threshold: Threshold, invert: bool) -> Settings {
        Settings { threshold, invert, ..Settings::default() }
    }

    #[test]
    fn blurring_averages_over_the_box_twice_and_leaves_flat_pictures_alone() {
        let mut values = vec![0; 81];
        values[40] = 243;
        blur(&mut values, 9, 1);
        // Twice a box of three is 1 2 3 2 1 in ninths, both ways.
        assert_eq!(values[4 * 9..5 * 9], [0, 0, 9, 18, 27, 18, 9, 0, 0]);
        assert_eq!([2, 3, 4, 5, 6].map(|y| values[9 * y + 4]), [9, 18, 27, 18, 9]);
        for (width, height, reach) in [(1, 1, 3), (2, 7, 1), (5, 3, 20)] {
            let mut flat = vec![93; width * height];
            blur(&mut flat, width, reach);
            assert_eq!(flat, vec![93; width * height]);
        }
    }

    #[test]
    fn otsu_takes_the_middle_of_the_gap_between_two_peaks() {
        for (low, high) in [(0, 255), (0, 89), (100, 110), (7, 8)] {
            let mut counts = [0; 256];
            (counts[low], counts[high]) = (900, 35);
            assert_eq!(usize::from(otsu(&counts)), (low + high - 1) / 2);
        }
    }

    #[test]
    fn otsu_agrees_with_the_variance_within_the_classes() {
        let counts: [u64; 256] = std::array::from_fn(|v| {
            let peak = |m: f64, s: f64| 1e5 * libm::exp(-(v as f64 - m) * (v as f64 - m) / (2.0 * s * s));
            (peak(70.0, 20.0) + 0.4 * peak(180.0, 12.0)) as u64
        });
        let within = |level: usize| {
            let spread = |values: std::ops::Range<usize>| {
                let n: f64 = values.clone().map(|v| counts[v] as f64).sum::<f64>().max(1.0);
                let mean = values.clone().map(|v| v as f64 * counts[v] as f64).sum::<f64>() / n;
                values.map(|v| counts[v] as f64 * (v as f64 - mean) * (v as f64 - mean)).sum::<f64>()
            };
            spread(0..level + 1) + spread(level + 1..256)
        };
        let best = (1..254).min_by(|&a, &b| within(a).total_cmp(&within(b))).unwrap();
        assert_eq!(usize::from(otsu(&counts)), best);
    }

    #[test]
    fn alpha_counts_when_any_pixel_is_clear() {
        let mut picture = Picture::filled(3, 1, [0, 0, 0, 255]);
        picture.rgba[4..8].copy_from_slice(&[255, 255, 255, 255]);
        let ink = cover(&picture, &settings(Threshold::Otsu, false)).unwrap();
        assert_eq!((ink.values, ink.level), (vec![255, 0, 255], 127));
        for (alpha, dark) in [(254, 254), (128, 128)] {
            picture.rgba[11] = alpha;
            assert_eq!(cover(&picture, &settings(Threshold::Otsu, false)).unwrap().values, [255, 0, dark]);
        }
        picture.rgba[11] = 10;
        assert_eq!(cover(&picture, &settings(Threshold::Otsu, false)).unwrap().values, [255, 255, 10]);
        assert_eq!(cover(&picture, &settings(Threshold::Otsu, true)).unwrap().values, [0, 0, 245]);
    }

    #[test]
    fn a_flat_picture_is_full_or_empty() {
        let flat = |value: u8, threshold| {
            cover(&Picture::filled(2, 2, [value, value, value, 255]), &settings(threshold, false))
        };
        assert_eq!(flat(0, Threshold::Otsu).unwrap().level, 127);
        assert!(flat(127, Threshold::Otsu).is_ok());
        for value in [128, 255] {
            assert_eq!(flat(value, Threshold::Otsu), Err(PictureError::Empty { threshold: 127.5 / 255.0 }));
        }
        assert!(flat(200, Threshold::At(0.1)).is_ok());
        assert!(flat(0, Threshold::At(1.0)).is_ok());
        assert!(flat(255, Threshold::At(0.0)).is_err());
    }
}
