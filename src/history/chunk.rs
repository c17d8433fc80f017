//! A recording inside a PNG: a compressed iTXt chunk with the keyword `wobble`.
//!
//! Source: the PNG specification, third edition, 11.3.3.4 (iTXt).

use std::io::{Read, Write};

use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use flate2::{Compression, Crc};

use crate::picture::{PNG_MARK, png_parts};

/// Keyword, compressed by deflate, no language, no translated keyword.
const HEAD: &[u8] = b"wobble\0\x01\0\0\0";

/// Largest text that is unpacked `[bytes]`: some bytes may unpack to any size.
const LARGEST: u64 = 1 << 30;

/// A PNG with a text in it, in place of one that it had; what is no PNG stays as it is.
///
/// Errors: a text too long for a chunk.
pub fn insert(png: &[u8], text: &str) -> std::io::Result<Vec<u8>> {
    let mut packed = ZlibEncoder::new(HEAD.to_vec(), Compression::default());
    packed.write_all(text.as_bytes())?;
    let content = packed.finish()?;
    let length = u32::try_from(content.len()).ok().filter(|&length| length <= i32::MAX as u32);
    let length = length.ok_or_else(|| std::io::Error::other("the scene is too large to stand in a picture"))?;
    let mut sum = Crc::new();
    sum.update(b"iTXt");
    sum.update(&content);
    let mut out = PNG_MARK.to_vec();
    let mut end = PNG_MARK.len();
    for (at, (name, part)) in png_parts(png).enumerate() {
        end += part.len();
        if !is_ours(name, part) {
            out.extend(part);
        }
        // The first chunk is the head, after which texts may stand.
        if at == 0 {
            out.extend(length.to_be_bytes());
            out.extend(b"iTXt");
            out.extend(&content);
            out.extend(sum.sum().to_be_bytes());
        }
    }
    if end == PNG_MARK.len() {
        return Ok(png.to_vec());
    }
    out.extend(&png[end..]);
    Ok(out)
}

/// The text in a PNG; `None` where there is none, or it is damaged.
pub fn find(png: &[u8]) -> Option<String> {
    let (_, part) = png_parts(png).find(|(name, part)| is_ours(name, part))?;
    let packed = &part[8 + HEAD.len()..part.len() - 4];
    let mut text = Vec::new();
    ZlibDecoder::new(packed).take(LARGEST + 1).read_to_end(&mut text).ok()?;
    if text.len() as u64 > LARGEST { None } else { String::from_utf8(text).ok() }
}

fn is_ours(name: &[u8], part: &[u8]) -> bool {
    name == b"iTXt" && part[8..part.len() - 4].starts_with(HEAD)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::picture::{self, Picture};

    #[test]
    fn a_text_goes_into_a_picture_and_comes_out_and_the_picture_stays() {
        let picture = Picture::new(3, 2, (0..24).map(|k| k * 10).collect()).unwrap();
        let png = picture::encode(&picture).unwrap();
        assert_eq!(find(&png), None);
        let with = insert(&insert(&png, "old").unwrap(), "{\"wobble_recording\": 1} ü").unwrap();
        assert_eq!(find(&with).unwrap(), "{\"wobble_recording\": 1} ü");
        assert_eq!(picture::decode(&with).unwrap(), picture);
        for length in 0..with.len() {
            find(&with[..length]);
            insert(&with[..length], "x").unwrap();
        }
        assert_eq!(find(b"no picture"), None);
        assert_eq!(insert(b"no picture", "x").unwrap(), b"no picture");
    }
}
