//! Whether a JPEG file has an end.

const END: u8 = 0xD9;
const SCAN: u8 = 0xDA;

/// Whether a JPEG goes on to the mark of its end: the decoder fills in what is missing, and takes it for a picture.
///
/// Model: segments with a length are skipped whole, for thumbnails in them have ends of their own; after the head of a scan
/// come coded pixels, up to a mark that neither stands for a byte of 255 nor restarts the coding. What follows the end is
/// not looked at: some programs append a little of their own.
/// Source: ITU-T T.81 (1992), B.1.1 and B.2.
pub(super) fn is_whole(bytes: &[u8]) -> bool {
    let mut at = 2;
    while let Some((mark, after)) = next_mark(bytes, at) {
        at = match mark {
            END => return true,
            0x01 | 0xD0..=0xD8 => after,
            _ => match bytes.get(after..after + 2) {
                Some(&[high, low]) => after + usize::from(u16::from_be_bytes([high, low])).max(2),
                _ => return false,
            },
        };
        if mark == SCAN {
            at = end_of_scan(bytes, at);
        }
    }
    false
}

/// The next mark, and the place behind it.
fn next_mark(bytes: &[u8], from: usize) -> Option<(u8, usize)> {
    let start = from + bytes.get(from..)?.iter().position(|&byte| byte == 0xFF)?;
    let fill = bytes[start..].iter().position(|&byte| byte != 0xFF)?;
    Some((bytes[start + fill], start + fill + 1))
}

/// Where the mark begins that ends the coded pixels.
fn end_of_scan(bytes: &[u8], from: usize) -> usize {
    let coded = bytes.get(from..).unwrap_or_default();
    let is_end = |pair: &[u8]| pair[0] == 0xFF && !matches!(pair[1], 0x00 | 0xFF | 0xD0..=0xD7);
    coded.windows(2).position(is_end).map_or(bytes.len(), |end| from + end)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of a segment with a thumbnail's end in it, a scan and what comes then.
    fn file(rest: &[u8]) -> Vec<u8> {
        let head = [0xFF, 0xD8, 0xFF, 0xE1, 0, 6, 0xFF, 0xD9, 1, 2, 0xFF, 0xDA, 0, 3, 7];
        [&head[..], rest].concat()
    }

    #[test]
    fn the_end_is_that_of_the_picture_itself() {
        let pixels = [5, 0xFF, 0x00, 0xD9, 0xFF, 0xD3, 9];
        assert!(!is_whole(&file(&pixels)), "the thumbnail's end does not count");
        assert!(is_whole(&file(&[&pixels[..], &[0xFF, 0xD9]].concat())));
        assert!(is_whole(&file(&[&pixels[..], &[0xFF, 0xFF, 0xD9]].concat())), "filled up");
        let two_scans = [&pixels[..], &[0xFF, 0xDA, 0, 2, 8, 0xFF, 0xD9], &[1; 200_000]].concat();
        assert!(is_whole(&file(&two_scans)), "with much behind it");
        assert!(!is_whole(&file(&[0xFF, 0xFE, 0xFF, 0xFF, 0xFF, 0xD9])), "a segment beyond the end of the file");
        for length in 0..15 {
            assert!(!is_whole(&file(&[])[..length]));
        }
    }
}
