//! What the shapes of a picture stand out from, if there is anything that they do.

use super::coverage::{CLEAR, cover};
use super::{Picture, Settings};

/// What the shapes of a picture stand out from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// Pixels that are clear.
    Clear,
    /// Even light paper: what is dark is the body.
    Light,
    /// An even dark ground: what is light is the body.
    Dark,
    /// Nothing: a photograph that fills its frame.
    Nothing,
}

/// Side to which a picture is shrunk before it is looked at `[px]`: grain is none of its ground.
const SIDE: u32 = 256;
/// How far in from the sides of a picture a ground must be seen, of its shorter side `[1]`: further than a frame is thick.
const RIM: f64 = 0.05;
/// Share of that rim that is of the ground at least `[1]`: what is cut off at a side still has ground at the others.
const SEEN: f64 = 0.75;
/// Spread of a ground's darkness at most, over the distance of its mean from that of the shapes `[1]`. Paper under a lamp has
/// 0.1 and less; shades that are all equally frequent, which nothing stands out of, have 0.29.
const UNEVEN: f64 = 0.2;

/// What the shapes of a picture stand out from.
///
/// Model: where no pixel is clear, the darkness of pixels is split in two as [`cover()`] does. The class that most of the rim is of, and
/// that is even beside its distance from the other, is the ground.
/// A picture of one shade has light paper or nothing, as it is told from ink.
pub fn ground(picture: &Picture) -> Ground {
    if picture.rgba.chunks_exact(4).any(|pixel| pixel[3] < CLEAR) {
        return Ground::Clear;
    }
    let Ok(coverage) = cover(&picture.shrunk(SIDE), &Settings::default()) else { return Ground::Light };
    let (width, height, level) = (coverage.width, coverage.height, coverage.level);
    let broad = ((RIM * width.min(height) as f64) as usize).max(1);
    let (mut seen, mut all) = (0_usize, 0_usize);
    for (y, row) in coverage.values.chunks_exact(width).enumerate() {
        for (x, value) in row.iter().enumerate() {
            if x.min(width - 1 - x).min(y).min(height - 1 - y) < broad {
                all += 1;
                seen += usize::from(*value <= level);
            }
        }
    }
    let share = seen as f64 / all as f64;
    let class = |is_ink: bool| coverage.values.iter().filter(move |&&value| (value > level) == is_ink);
    let (Some(light), Some(dark)) = (spread(class(false)), spread(class(true))) else { return Ground::Nothing };
    let is_even = |[_, spread]: [f64; 2]| spread <= UNEVEN * (dark[0] - light[0]);
    if share >= SEEN && is_even(light) {
        Ground::Light
    } else if share <= 1.0 - SEEN && is_even(dark) {
        Ground::Dark
    } else {
        Ground::Nothing
    }
}

/// Mean and standard deviation of values; `None` of none.
fn spread<'a>(values: impl Iterator<Item = &'a u8> + Clone) -> Option<[f64; 2]> {
    let count = values.clone().count() as f64;
    let mean = values.clone().map(|&value| f64::from(value)).sum::<f64>() / count;
    let square = values.map(|&value| (f64::from(value) - mean) * (f64::from(value) - mean)).sum::<f64>() / count;
    (count > 0.0).then(|| [mean, square.sqrt()])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An opaque grey picture, whose lightness is told by where its pixels are, from -1 to 1 along both sides.
    fn grey(light: impl Fn(f64, f64) -> f64) -> Picture {
        let side = 120_u32;
        let at = |k: u32| (f64::from(k) + 0.5) / f64::from(side) * 2.0 - 1.0;
        let pixels = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
        let rgba = pixels.flat_map(|(x, y)| {
            let value = (255.0 * light(at(x), at(y)).clamp(0.0, 1.0)) as u8;
            [value, value, value, 255]
        });
        Picture { width: side, height: side, rgba: rgba.collect() }
    }

    /// Grain of a photograph, from -1 to 1.
    fn grain(x: f64, y: f64) -> f64 {
        let hash = libm::sin(x * 1234.5 + y * 6789.1) * 43_758.5;
        2.0 * (hash - hash.floor()) - 1.0
    }

    #[test]
    fn drawings_have_a_ground_and_photographs_that_fill_their_frame_have_none() {
        let disc = |x: f64, y: f64| x.hypot(y) < 0.6;
        let ink = |x: f64, y: f64| if disc(x, y) { 0.1 } else { 0.95 };
        let lit = |x: f64, y: f64| ink(x, y) + 0.1 * x + 0.03 * grain(x, y);
        let framed = |x: f64, y: f64| if x.abs().max(y.abs()) > 0.98 { 0.0 } else { ink(x, y) };
        let cut_off = |x: f64, y: f64| ink(x - 0.7, y);
        let inks: [(&str, Ground, Picture); 9] = [
            ("ink on paper", Ground::Light, grey(ink)),
            ("under a lamp", Ground::Light, grey(lit)),
            ("in a thin frame", Ground::Light, grey(framed)),
            ("cut off at a side", Ground::Light, grey(cut_off)),
            ("chalk on a board", Ground::Dark, grey(|x, y| 1.0 - ink(x, y))),
            ("sky over land", Ground::Nothing, grey(|x, y| 0.3 + if y < 0.1 { 0.5 } else { 0.1 * grain(x, y) })),
            ("a glow", Ground::Nothing, grey(|x, y| 1.0 - 0.7 * x.hypot(y))),
            ("a shade", Ground::Nothing, grey(|x, y| 0.5 + 0.4 * x + 0.05 * y)),
            ("grain", Ground::Nothing, grey(|x, y| 0.5 + 0.4 * grain(x, y))),
        ];
        for (name, ground_of_it, picture) in inks {
            assert_eq!(ground(&picture), ground_of_it, "{name}");
        }
    }

    #[test]
    fn clear_pixels_are_the_ground_and_one_shade_is_paper_or_nothing() {
        let mut picture = grey(|x, _| 0.5 + 0.4 * x);
        picture.rgba[3] = 100;
        assert_eq!(ground(&picture), Ground::Clear);
        assert_eq!(ground(&grey(|_, _| 1.0)), Ground::Light);
        assert_eq!(ground(&grey(|_, _| 0.0)), Ground::Nothing);
        assert_eq!(ground(&Picture::filled(1, 1, [0, 0, 0, 255])), Ground::Nothing);
    }
}
