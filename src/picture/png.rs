//! The parts of a PNG file, and what is left out of it before it is decoded.
//!
//! Source: the PNG specification, third edition, 5.3 (chunks).

use std::borrow::Cow;

/// The parts that do not change a pixel here and are packed: some bytes of them may unpack to any size.
const PACKED: [&[u8]; 3] = [b"iCCP", b"zTXt", b"iTXt"];

/// What a PNG begins with.
pub(crate) const PNG_MARK: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// Bytes of the length, the name and the sum about a part.
const AROUND: usize = 12;

/// A PNG without its colour profile and its packed texts; the file as it is where there are none, or where it is cut off.
pub(super) fn bare(bytes: &[u8]) -> Cow<'_, [u8]> {
    let is_packed = |name: &[u8]| PACKED.contains(&name);
    if !png_parts(bytes).any(|(name, _)| is_packed(name)) {
        return Cow::Borrowed(bytes);
    }
    let mut kept = PNG_MARK.to_vec();
    let mut end = kept.len();
    for (name, part) in png_parts(bytes) {
        end += part.len();
        if !is_packed(name) {
            kept.extend(part);
        }
    }
    kept.extend(&bytes[end..]);
    Cow::Owned(kept)
}

/// The parts of a PNG that are whole, each with its name: length, name, content and sum, one behind the other. Of what is no PNG
/// there are none.
pub(crate) fn png_parts(bytes: &[u8]) -> impl Iterator<Item = (&[u8], &[u8])> {
    let mut rest = bytes.strip_prefix(&PNG_MARK).unwrap_or_default();
    std::iter::from_fn(move || {
        let length = u32::from_be_bytes(*rest.first_chunk::<4>()?) as usize;
        let (part, after) = rest.split_at_checked(length.checked_add(AROUND)?)?;
        rest = after;
        Some((&part[4..8], part))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(name: &[u8; 4], content: &[u8]) -> Vec<u8> {
        [&(content.len() as u32).to_be_bytes()[..], name, content, &[0; 4]].concat()
    }

    #[test]
    fn packed_parts_are_left_out_and_all_others_stay() {
        let (head, pixels, end) = (part(b"IHDR", &[1; 13]), part(b"IDAT", &[2; 40]), part(b"IEND", &[]));
        let (profile, text) = (part(b"iCCP", &[3; 30]), part(b"zTXt", &[4; 9]));
        let plain = [&PNG_MARK[..], &head, &pixels, &end].concat();
        assert!(matches!(bare(&plain), Cow::Borrowed(_)));
        let full = [&PNG_MARK[..], &head, &profile, &text, &pixels, &end, b"more"].concat();
        assert_eq!(*bare(&full), [&plain[..], b"more"].concat());
        for length in 0..full.len() {
            assert!(bare(&full[..length]).len() <= length);
        }
    }
}
