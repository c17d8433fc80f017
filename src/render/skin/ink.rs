//! What a picture has at a place of it: how opaque and how light it is, and where it is seen through.

use crate::picture::Picture;

/// A place in a picture `[px]`.
pub(super) type Place = [f32; 2];

/// Between these opacities a pixel is seen through `[1]`: it is neither clear, as beside an edge, nor opaque.
const THROUGH: [f32; 2] = [0.1, 0.9];
/// Where a triangle is looked at, as shares of its corners: more places than an edge that crosses it has pixels on.
const LOOKS: [[f32; 3]; 7] = [
    [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
    [0.7, 0.15, 0.15],
    [0.15, 0.7, 0.15],
    [0.15, 0.15, 0.7],
    [0.45, 0.45, 0.1],
    [0.1, 0.45, 0.45],
    [0.45, 0.1, 0.45],
];
/// And along a strand.
const ALONG: [f32; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

/// The opacity of the pixel that a place lies in `[1]`: clear outside the picture.
pub(super) fn alpha(picture: &Picture, at: Place) -> f32 {
    pixel(picture, at).map_or(0.0, |rgba| f32::from(rgba[3]) / 255.0)
}

fn pixel(picture: &Picture, [x, y]: Place) -> Option<[u8; 4]> {
    let is_inside = x >= 0.0 && y >= 0.0 && x < picture.width as f32 && y < picture.height as f32;
    let first = 4 * (y as usize * picture.width as usize + x as usize);
    is_inside.then(|| picture.rgba[first..first + 4].try_into().ok()).flatten()
}

/// About the luminance of the ink at a place.
pub(super) fn luminance(picture: &Picture, at: Place) -> f32 {
    let [red, green, blue] = pixel(picture, at).map_or([255; 3], |[r, g, b, _]| [r, g, b]).map(|part| {
        let part = f32::from(part) / 255.0;
        part * part * (0.3 * part + 0.7)
    });
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// Whether most of a triangle is seen through.
pub(super) fn is_triangle_through(picture: &Picture, corners: [Place; 3]) -> bool {
    let place = |shares: [f32; 3]| [0, 1].map(|axis| (0..3).map(|k| shares[k] * corners[k][axis]).sum());
    is_through(picture, LOOKS.map(place))
}

/// Whether most of a strand is.
pub(super) fn is_strand_through(picture: &Picture, ends: [Place; 2]) -> bool {
    is_through(picture, along(ends))
}

/// Whether most of a strand lies where the picture is.
pub(super) fn is_strand_there(picture: &Picture, ends: [Place; 2]) -> bool {
    2 * along(ends).into_iter().filter(|at| alpha(picture, *at) >= 0.5).count() > ALONG.len()
}

fn along([a, b]: [Place; 2]) -> [Place; ALONG.len()] {
    ALONG.map(|share| [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis])))
}

fn is_through<const N: usize>(picture: &Picture, places: [Place; N]) -> bool {
    let is = |at: &Place| (THROUGH[0]..=THROUGH[1]).contains(&alpha(picture, *at));
    2 * places.iter().filter(|at| is(at)).count() > N
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_half_transparent_is_seen_through_and_an_edge_is_not() {
        let mut picture = Picture::filled(40, 40, [200, 100, 50, 128]);
        let corners = [[2.0, 2.0], [36.0, 4.0], [10.0, 36.0]];
        let strand = [[5.0, 5.0], [30.0, 20.0]];
        assert!(is_triangle_through(&picture, corners) && is_strand_through(&picture, strand));
        // An opaque half, a smooth edge of two pixels, and nothing.
        for (i, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
            pixel[3] = [255, 180, 70, 0][(i % 40).saturating_sub(17).min(3)];
        }
        assert!(!is_triangle_through(&picture, corners) && !is_strand_through(&picture, strand));
    }
}
