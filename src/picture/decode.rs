//! Bytes of a picture file to pixels.

use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};

use image::{DynamicImage, ImageDecoder, ImageEncoder, ImageError, ImageFormat, ImageReader, Limits};

use super::{PictureError, jpeg, png};

/// Longest side that is taken `[px]`.
pub const MAX_SIDE: u32 = 16_384;

/// Most pixels that are taken: 64 times 2^20. With 4 bytes each they are a quarter of a GiB, and a mesh of so large a
/// picture shows nothing that a smaller one would not.
pub const MAX_PIXELS: u64 = 64 << 20;

/// Most memory that decoding may take `[bytes]`: what the file holds, unpacked, and the pixels made of it.
/// With the program itself, and what it makes of the pixels, this stays within 512 MiB.
pub const MAX_BYTES: u64 = 480 << 20;

/// Pixels of 8 bits a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width `[px]`, at least 1.
    pub width: u32,
    /// Height `[px]`, at least 1.
    pub height: u32,
    /// Red, green, blue, alpha of each pixel, row by row from the top; alpha is not multiplied in.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// A picture of one colour.
    ///
    /// Valid range: sides from 1 to [`MAX_SIDE`] px.
    pub fn filled(width: u32, height: u32, colour: [u8; 4]) -> Self {
        Picture { width, height, rgba: colour.repeat(width as usize * height as usize) }
    }

    /// A picture of these pixels.
    ///
    /// Shapes: `rgba` has four bytes a pixel, row by row from the top.
    /// Errors: no pixels; above [`MAX_SIDE`] or [`MAX_PIXELS`]; a list of another length.
    pub fn new(width: u32, height: u32, rgba: Vec<u8>) -> Result<Self, PictureError> {
        let bytes = 4 * u64::from(width) * u64::from(height);
        check_size((width, height), bytes, true)?;
        if rgba.len() as u64 != bytes {
            let reason = format!("it has {} bytes where {width} x {height} pixels are {bytes}", rgba.len());
            return Err(PictureError::Damaged { format: "RGBA".to_owned(), reason });
        }
        Ok(Picture { width, height, rgba })
    }
}

impl Picture {
    /// The same picture with its longer side at most `side` `[px]`, for a screen.
    pub fn shrunk(&self, side: u32) -> Picture {
        let longer = self.width.max(self.height);
        let whole: Option<image::ImageBuffer<image::Rgba<u8>, &[u8]>> =
            image::ImageBuffer::from_raw(self.width, self.height, &self.rgba[..]);
        let Some(whole) = whole.filter(|_| longer > side) else { return self.clone() };
        let share = |length: u32| (u64::from(length) * u64::from(side) / u64::from(longer)).max(1) as u32;
        let (width, height) = (share(self.width), share(self.height));
        Picture { width, height, rgba: image::imageops::thumbnail(&whole, width, height).into_raw() }
    }
}

/// Reads a picture file; the format is told by its content.
///
/// A colour profile is not applied, nor read.
/// The first frame of an animation is taken, 16 bits a channel are rounded to 8, and a picture that is stored turned
/// (EXIF) is turned upright.
///
/// Errors: an unknown format; a damaged or truncated file; no pixels; above [`MAX_SIDE`], [`MAX_PIXELS`] or
/// [`MAX_BYTES`], which is known before the pixels are decoded.
pub fn decode(bytes: &[u8]) -> Result<Picture, PictureError> {
    let format = image::guess_format(bytes).ok().or_else(|| is_targa(bytes).then_some(ImageFormat::Tga));
    let format = format.ok_or(if is_svg(bytes) { PictureError::Drawing } else { PictureError::Unknown })?;
    let damaged = |reason: &str| PictureError::Damaged {
        format: format!("{format:?}").to_uppercase(),
        reason: reason.split_whitespace().collect::<Vec<_>>().join(" "),
    };
    // Decoders are fuzzed, yet each release of them mends a file on which one panicked: such a file is a damaged one.
    let read = catch_unwind(AssertUnwindSafe(|| read(bytes, format, damaged)));
    read.unwrap_or_else(|_| Err(damaged("its decoder gave up")))
}

/// Whether a file with these bytes, of which the first few are enough, is a picture of a known format.
pub fn is_picture(bytes: &[u8]) -> bool {
    image::guess_format(bytes).is_ok()
}

/// Whether a file with these bytes, of which the first few are enough, is an SVG: lines and areas instead of pixels.
pub fn is_svg(bytes: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(SVG_START)]);
    let start = start.trim_start_matches('\u{feff}').trim_start();
    let is_markup = ["<svg", "<?xml", "<!--", "<!DOCTYPE"].iter().any(|tag| start.starts_with(tag));
    is_markup && start.contains("<svg")
}

/// Bytes within which an SVG says that it is one: comments and the document's type may stand before `[bytes]`.
const SVG_START: usize = 4096;

/// Whether a file of this name should be a picture.
pub fn is_picture_name(path: &std::path::Path) -> bool {
    ImageFormat::from_path(path).is_ok()
}

/// A picture as a PNG file.
///
/// Errors: more memory than there is.
pub fn encode(picture: &Picture) -> Result<Vec<u8>, PictureError> {
    let mut bytes = Vec::new();
    let colours = image::ExtendedColorType::Rgba8;
    let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    match encoder.write_image(&picture.rgba, picture.width, picture.height, colours) {
        Ok(()) => Ok(bytes),
        Err(error) => Err(PictureError::Damaged { format: "PNG".to_owned(), reason: error.to_string() }),
    }
}

fn read(bytes: &[u8], format: ImageFormat, damaged: impl Fn(&str) -> PictureError) -> Result<Picture, PictureError> {
    if format == ImageFormat::Jpeg && !jpeg::is_whole(bytes) {
        return Err(damaged("it ends in the middle"));
    }
    let bytes = if format == ImageFormat::Png { png::bare(bytes) } else { bytes.into() };
    let mut reader = ImageReader::with_format(Cursor::new(&*bytes), format);
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    let wrong = |error: ImageError| damaged(&error.to_string());
    let mut decoder = reader.into_decoder().map_err(wrong)?;
    let is_rgba = decoder.color_type() == image::ColorType::Rgba8;
    check_size(decoder.dimensions(), decoder.total_bytes(), is_rgba)?;
    let turned = decoder.orientation().map_err(wrong)?;
    let mut image = DynamicImage::from_decoder(decoder).map_err(wrong)?;
    image.apply_orientation(turned);
    let (width, height) = (image.width(), image.height());
    Ok(Picture { width, height, rgba: into_rgba(image) })
}

fn check_size((width, height): (u32, u32), bytes: u64, is_rgba: bool) -> Result<(), PictureError> {
    if width == 0 || height == 0 {
        return Err(PictureError::NoPixels { width, height });
    }
    let pixels = u64::from(width) * u64::from(height);
    if width > MAX_SIDE || height > MAX_SIDE || pixels > MAX_PIXELS {
        return Err(PictureError::TooLarge { width, height, side: MAX_SIDE, megapixels: MAX_PIXELS >> 20 });
    }
    // Pixels that are RGBA already are taken over, others stand beside what they are made of.
    let needed = if is_rgba { bytes } else { bytes.saturating_add(4 * pixels) };
    if needed > MAX_BYTES {
        return Err(PictureError::TooHeavy { needed: needed.div_ceil(1 << 20), limit: MAX_BYTES >> 20 });
    }
    Ok(())
}

/// The usual layouts by hand, for `image` converts pixel by pixel through a trait.
fn into_rgba(image: DynamicImage) -> Vec<u8> {
    match image {
        DynamicImage::ImageRgba8(image) => image.into_raw(),
        DynamicImage::ImageLuma8(image) => spread(image.as_raw(), |&[l]| [l, l, l, 255]),
        DynamicImage::ImageLumaA8(image) => spread(image.as_raw(), |&[l, a]| [l, l, l, a]),
        DynamicImage::ImageRgb8(image) => spread(image.as_raw(), |&[r, g, b]| [r, g, b, 255]),
        DynamicImage::ImageLuma16(image) => spread(image.as_raw(), |&[l]| [narrow(l), narrow(l), narrow(l), 255]),
        DynamicImage::ImageRgb16(image) => spread(image.as_raw(), |&[r, g, b]| [narrow(r), narrow(g), narrow(b), 255]),
        DynamicImage::ImageRgba16(image) => spread(image.as_raw(), |pixel: &[u16; 4]| pixel.map(narrow)),
        other => other.into_rgba8().into_raw(),
    }
}

fn spread<T, const N: usize>(raw: &[T], pixel: impl Fn(&[T; N]) -> [u8; 4]) -> Vec<u8> {
    let (pixels, _) = raw.as_chunks::<N>();
    let mut rgba: Vec<[u8; 4]> = Vec::with_capacity(pixels.len());
    rgba.extend(pixels.iter().map(pixel));
    rgba.into_flattened()
}

/// The nearest of 256 values.
fn narrow(value: u16) -> u8 {
    ((u32::from(value) + 128) / 257) as u8
}

/// A Targa file has no mark at its start: the newer kind has one at its end, the older a header that must make sense.
fn is_targa(bytes: &[u8]) -> bool {
    let plain = |header: &[u8]| {
        header[1] <= 1
            && matches!(header[2], 1 | 2 | 3 | 9 | 10 | 11)
            && matches!(header[16], 8 | 15 | 16 | 24 | 32)
            && (header[1] == 1) == matches!(header[2], 1 | 9)
            && header[17] & 0xC0 == 0
    };
    bytes.len() > 18 && (bytes.ends_with(b"TRUEVISION-XFILE.\0") || plain(&bytes[..18]))
}

#[cfg(test)]
#[path = "decode_tests.rs"]
mod tests;
