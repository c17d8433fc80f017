//! The ink of a drawing without its paper: what triangles wear that end a little beyond it.

use super::bits::Bits;
use super::contour::contours_of;
use super::coverage::cover;
use super::nest::keep;
use super::{Picture, Settings, Threshold};

/// Opacity of ink beside paper, of 255: there pixels are mixed of both, so what lies further inside speaks for them. The
/// darker of them speak louder, for of a line as thin as a pixel there is nothing else.
const EDGE: [f32; 2] = [1.0, 40.0];

/// An opaque picture with its paper clear, and next to clear where it shows through at edges.
///
/// `None` of a picture that is not opaque, for that says itself what its body is, of one that is taken whole, and of one without ink.
pub fn without_paper(picture: &Picture, settings: &Settings) -> Option<Picture> {
    let (pixels, _) = picture.rgba.as_chunks::<4>();
    if settings.threshold == Threshold::Whole || pixels.iter().any(|pixel| pixel[3] != 255) {
        return None;
    }
    let mut coverage = cover(picture, settings).ok()?;
    let loops = contours_of(&coverage, &Bits::ink(&coverage));
    // Holes that are filled are a part of the body, paper or not.
    keep(&mut coverage, loops, settings.min_area, settings.fill_holes);
    let (width, height, level) = (coverage.width, coverage.height, coverage.level);
    let most = f32::from(coverage.values.iter().copied().max()?.max(level + 1));
    let opacity = |k: usize| {
        let (x, y, value) = (k % width, k / width, coverage.values[k]);
        let mut rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
        let is_ink = |v: usize| {
            let row = &coverage.values[v * width..][x.saturating_sub(1)..=(x + 1).min(width - 1)];
            row.iter().all(|&value| value > level)
        };
        if value <= level {
            0
        } else if rows.all(is_ink) {
            255
        } else {
            let share = f32::from(value - level) / (most - f32::from(level));
            (EDGE[0] + (EDGE[1] - EDGE[0]) * share * share) as u8
        }
    };
    let rgba = pixels.iter().enumerate().flat_map(|(k, &[r, g, b, _])| [r, g, b, opacity(k)]).collect();
    Some(Picture { rgba, ..*picture })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Blue ink on white paper: a bar with grey edges, and a line as thin as a pixel.
    fn drawing() -> Picture {
        let mut picture = Picture::filled(12, 9, [255; 4]);
        let mut paint = |x: usize, y: usize, rgb: [u8; 3]| picture.rgba[4 * (12 * y + x)..][..3].copy_from_slice(&rgb);
        for y in 0..9 {
            (2..6).for_each(|x| paint(x, y, [0, 0, 200]));
            [1, 6].into_iter().for_each(|x| paint(x, y, [110, 110, 220]));
            paint(9, y, [40, 40, 210]);
        }
        picture
    }

    #[test]
    fn paper_is_clear_and_edges_nearly_so() {
        let settings = Settings { min_area: 0.0, ..Settings::default() };
        let inked = without_paper(&drawing(), &settings).unwrap();
        let row: Vec<u8> = inked.rgba.chunks_exact(4).skip(12 * 4).take(12).map(|pixel| pixel[3]).collect();
        assert_eq!([0, 7, 8, 10, 11].map(|x| row[x]), [0; 5], "paper: {row:?}");
        assert_eq!([3, 4].map(|x| row[x]), [255; 2], "deep ink: {row:?}");
        assert!([1, 6, 9].iter().all(|&x| (1..=40).contains(&row[x])), "edges and hairs: {row:?}");
        assert!(inked.rgba.chunks_exact(4).zip(drawing().rgba.chunks_exact(4)).all(|(a, b)| a[..3] == b[..3]));
    }

    #[test]
    fn what_is_not_opaque_says_itself_what_is_ink() {
        let mut picture = drawing();
        picture.rgba[3] = 254;
        assert_eq!(without_paper(&picture, &Settings::default()), None);
    }
}
