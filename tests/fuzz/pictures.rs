//! Damaged picture files of every format: decoded, and cut out as bodies where they are small.

use std::io::Cursor;

use image::{DynamicImage, ImageFormat, Rgba, RgbaImage};
use wobble::picture::{MAX_BYTES, Settings, Size, Strokes, Threshold, decode, mesh_picture};

use super::common::damage::bytes;
use super::common::session::Dice;
use super::driver::{Trial, run, shows};

/// What decoding may take, as the decoder says of itself, and something to work with.
const TRIAL: Trial = Trial { name: "pictures", few: 200, most_bytes: MAX_BYTES as usize + (64 << 20) };

/// Pixels up to which a body is made.
const LARGEST: u64 = 96 * 96;

const FORMATS: [ImageFormat; 10] = [
    ImageFormat::Png,
    ImageFormat::Jpeg,
    ImageFormat::Gif,
    ImageFormat::Bmp,
    ImageFormat::WebP,
    ImageFormat::Tiff,
    ImageFormat::Pnm,
    ImageFormat::Tga,
    ImageFormat::Ico,
    ImageFormat::Qoi,
];

/// A ring, a block and a stroke, with soft edges and some grain.
fn drawing(side: u32) -> DynamicImage {
    let mut dice = Dice::new(3);
    let half = f64::from(side) / 2.0;
    DynamicImage::ImageRgba8(RgbaImage::from_fn(side, side, |x, y| {
        let (u, v) = (f64::from(x) + 0.5 - half, f64::from(y) + 0.5 - half);
        let ring = (u.hypot(v) - 0.6 * half).abs() - 0.15 * half;
        let stroke = (u - v).abs() - 1.0;
        let cover = (0.5 - ring.min(stroke)).clamp(0.0, 1.0);
        let grain = dice.below(12) as u8;
        let value = (255.0 * (1.0 - cover)) as u8;
        Rgba([value.saturating_sub(grain), value, value, 255 - grain])
    }))
}

/// Files of all formats and of several kinds of pixels.
fn files() -> Vec<Vec<u8>> {
    let mut files = Vec::new();
    let mut write = |image: DynamicImage, format| {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).unwrap();
        files.push(bytes.into_inner());
    };
    for format in FORMATS {
        let image = drawing(24);
        let is_plain = format == ImageFormat::Jpeg;
        write(if is_plain { DynamicImage::ImageRgb8(image.to_rgb8()) } else { image }, format);
    }
    for format in [ImageFormat::Png, ImageFormat::Tiff] {
        let image = drawing(40);
        write(DynamicImage::ImageLuma8(image.to_luma8()), format);
        write(DynamicImage::ImageRgb16(image.to_rgb16()), format);
    }
    files
}

/// Writes the sums behind the chunks of a PNG again, so that what is damaged is looked at.
fn with_sums(mut png: Vec<u8>) -> Vec<u8> {
    let mut at = 8;
    while let Some(length) = png.get(at..at + 4).map(|four| u32::from_be_bytes([four[0], four[1], four[2], four[3]])) {
        let end = at.saturating_add(8).saturating_add(length as usize);
        if end.saturating_add(4) > png.len() {
            break;
        }
        let mut sum = flate2::Crc::new();
        sum.update(&png[at + 4..end]);
        png[end..end + 4].copy_from_slice(&sum.sum().to_be_bytes());
        at = end + 4;
    }
    png
}

/// Settings at random, all in their ranges but now and then.
fn settings(dice: &mut Dice) -> Settings {
    let spacing = if dice.below(20) == 0 { dice.within(-1.0, 1.0) } else { dice.within(2.0, 12.0) };
    Settings {
        threshold: match dice.below(8) {
            0 => Threshold::Whole,
            1..4 => Threshold::Otsu,
            _ => Threshold::At(dice.within(0.0, 1.0)),
        },
        invert: dice.below(3) == 0,
        blur: dice.below(3) as u32,
        fill_holes: dice.below(4) == 0,
        min_area: dice.within(0.0, 20.0),
        size: match dice.below(3) {
            0 => Size::Spacing(spacing),
            1 => Size::Graded { spacing, ratio: dice.within(0.9, 9.0) },
            _ => Size::MaxArea(spacing * spacing),
        },
        strokes: [Strokes::Ropes, Strokes::Widen, Strokes::Drop, Strokes::Mesh][dice.below(4) as usize],
        ..Settings::default()
    }
}

fn exercise(bytes: &[u8], dice: &mut Dice) -> &'static str {
    let is_line = |line: String| assert!(!line.contains('\n') && line.len() < 500, "{line:?}");
    let picture = match decode(bytes) {
        Ok(picture) => picture,
        Err(error) => {
            is_line(error.to_string());
            return "refused";
        }
    };
    let pixels = u64::from(picture.width) * u64::from(picture.height);
    assert_eq!(picture.rgba.len() as u64, 4 * pixels);
    if pixels > LARGEST {
        return "large";
    }
    match mesh_picture(&picture, &settings(dice)) {
        Ok(made) => {
            let points = made.mesh.points.len();
            assert!(points > 0 && made.mesh.bonds.iter().flatten().all(|&end| (end as usize) < points));
            assert!(made.mesh.points.iter().flatten().all(|x| x.is_finite()));
            "a body"
        }
        Err(error) => {
            is_line(error.to_string());
            "no body"
        }
    }
}

#[test]
fn damaged_pictures_end_in_a_body_or_a_line() {
    let files = files();
    let ended = run(&TRIAL, |number| {
        let mut dice = Dice::new(number);
        let whole = &files[dice.below(files.len() as u64) as usize];
        let mut damaged = bytes(whole, &mut dice);
        if damaged.starts_with(b"\x89PNG") && dice.below(4) > 0 {
            damaged = with_sums(damaged);
        }
        if shows() {
            eprintln!("{number}: {damaged:02x?}");
        }
        exercise(&damaged, &mut dice)
    });
    let all: u64 = ended.values().sum();
    let share = |how: &str| ended.get(how).copied().unwrap_or(0) as f64 / all as f64;
    assert!(all < 100 || (share("refused") > 0.1 && share("a body") > 0.1), "the damage is too much or too little");
}
