//! Animated pictures, as files.

use std::io::{self, Write};
use std::time::Duration;

use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame, RgbaImage};

/// How hard the palette of an animation is searched for: 1 is slow and best, 30 fast.
const PALETTE_SPEED: i32 = 10;
/// The shortest and the longest time that a picture stands `[s]`.
const STANDS: [f64; 2] = [0.01, 600.0];

/// An animated picture that is being written, for ever round. It is whole once this is dropped.
pub struct Gif<W: Write> {
    encoder: GifEncoder<W>,
    delay: Delay,
}

impl<W: Write> Gif<W> {
    /// One of so many pictures a second.
    ///
    /// Errors: those of `to`.
    pub fn begin(to: W, fps: f64) -> io::Result<Self> {
        let mut encoder = GifEncoder::new_with_speed(to, PALETTE_SPEED);
        encoder.set_repeat(Repeat::Infinite).map_err(io::Error::other)?;
        let stands = Duration::from_secs_f64((1.0 / fps).clamp(STANDS[0], STANDS[1]));
        Ok(Gif { encoder, delay: Delay::from_saturating_duration(stands) })
    }

    /// The next picture.
    ///
    /// Errors: those of what it is written to; a picture of another size than can be.
    pub fn add(&mut self, picture: RgbaImage) -> io::Result<()> {
        let frame = Frame::from_parts(picture, 0, 0, self.delay);
        self.encoder.encode_frame(frame).map_err(io::Error::other)
    }
}
