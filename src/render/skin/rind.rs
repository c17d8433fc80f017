//! Beside a mesh the picture that it was cut out of goes on: outside its straight sides lies what they cut off, inside them what they add. Along the
//! sides where the picture ends near by, it is drawn on as far as that, so that a body has the outline of its picture.
//!
//! A strip outside each such side moves with the triangle inside it. The shader shows of both only what the picture covers.

use bytemuck::{Pod, Zeroable};

use super::ink::{Place, alpha, luminance};
use crate::picture::{Picture, Skin};

/// A corner of a strip as the shader reads it: `Rind` in skin.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Corner {
    /// The triangle that it moves with, and its shares of these corners: below 0 where it lies beyond them.
    points: [u32; 3],
    shares: [f32; 3],
    at: [f32; 2],
    /// What the picture is multiplied by there, as in a corner of a triangle.
    tint: u32,
}

const _: () = assert!(size_of::<Corner>() == 36);

/// How wide a strip is, as a share of its side, and at least and at most `[px of the picture]`.
const WIDTH: f32 = 0.25;
const WIDTHS: [f32; 2] = [3.0, 24.0];
/// Places along a side at which it is looked where the picture ends, and from one look to the next across it `[px]`.
const LOOKS: u32 = 5;
const STEP: f32 = 0.5;
/// So far inside a side the picture is there, as a share of the triangle's height `[1]`.
const INSIDE: f32 = 0.3;
/// A pixel is covered from this opacity on, as in skin.wgsl; where the picture is seen through, from this share of the opacity inside on `[1]`.
const COVERED: f32 = 0.5;
/// Ink darker than this has a light rim along its mesh, which is seen on a dark ground: the second luminance of `DARK` in skin.wgsl.
const DARK: f32 = 0.17;
/// A pixel fainter than this is clear `[1]`.
const FAINTEST: f32 = 0.02;
/// Strips meet in a corner at most so many of their widths away from it `[1]`.
const SHARPEST: f32 = 2.0;

/// What is drawn on beside the free sides of a skin.
#[derive(Debug, Default)]
pub(super) struct Rind {
    /// Strips, two triangles each.
    pub(super) corners: Vec<Corner>,
    /// The triangles within them, ascending by their places: of these too only what the picture covers is shown.
    pub(super) clipped: Vec<usize>,
    /// The free sides that have a strip, ascending: they are not drawn as strokes.
    pub(super) sides: Vec<[u32; 2]>,
}

fn sub(a: Place, b: Place) -> Place {
    [a[0] - b[0], a[1] - b[1]]
}

fn beyond(from: Place, way: Place, by: f32) -> Place {
    [from[0] + by * way[0], from[1] + by * way[1]]
}

/// A free side: its ends, where the triangle that it is of has them first, with the outward normal and the width of its strip `[px]`.
struct Side {
    triangle: usize,
    points: [u32; 3],
    places: [Place; 3],
    normal: Place,
    width: f32,
}

impl Rind {
    /// Of the whole `triangles` of a skin, each with whether it is seen through, of which these sides are free, both ends ascending and all of them
    /// too; `tint`: what the picture is multiplied by at a point, of a triangle that is seen through or not.
    pub(super) fn of(
        skin: &Skin,
        (triangles, through): (&[[u32; 3]], &[bool]),
        free: &[[u32; 2]],
        tint: impl Fn(u32, bool) -> u32,
    ) -> Rind {
        let size = [skin.picture.width as f32, skin.picture.height as f32];
        let place = |point: u32| {
            let at = skin.texture.get(point.checked_sub(skin.first)? as usize)?;
            Some([at[0] * size[0], at[1] * size[1]])
        };
        let mut sides: Vec<Side> = Vec::new();
        for (triangle, &[a, b, c]) in triangles.iter().enumerate() {
            for points in [[a, b, c], [b, c, a], [c, a, b]] {
                let ends = [points[0].min(points[1]), points[0].max(points[1])];
                let [Some(p), Some(q), Some(r)] = points.map(place) else { continue };
                if free.binary_search(&ends).is_ok() {
                    sides.extend(side(&skin.picture, (triangle, points, [p, q, r]), through[triangle]));
                }
            }
        }
        let mut rind = Rind::default();
        let mut of_points: Vec<(u32, usize)> =
            sides.iter().enumerate().flat_map(|(k, side)| [(side.points[0], k), (side.points[1], k)]).collect();
        of_points.sort_unstable();
        for side in &sides {
            let tints = [0, 1].map(|end| tint(side.points[end], through[side.triangle]));
            rind.strip((side, tints), (&sides, &of_points), size);
            rind.clipped.push(side.triangle);
            rind.sides.push([side.points[0].min(side.points[1]), side.points[0].max(side.points[1])]);
        }
        rind.clipped.dedup();
        rind.sides.sort_unstable();
        rind
    }

    /// Two triangles outside a side; where that of another begins, both end in the same place of the picture.
    fn strip(
        &mut self,
        (side, tints): (&Side, [u32; 2]),
        (sides, of_points): (&[Side], &[(u32, usize)]),
        size: [f32; 2],
    ) {
        let outer = [0, 1].map(|end| {
            let point = side.points[end];
            let first = of_points.partition_point(|(other, _)| *other < point);
            let there: Vec<&Side> =
                of_points[first..].iter().take_while(|(other, _)| *other == point).map(|(_, k)| &sides[*k]).collect();
            let width = there.iter().map(|side| side.width).fold(side.width, f32::min);
            let way = match there[..] {
                [one, other] => between(one.normal, other.normal),
                _ => side.normal,
            };
            beyond(side.places[end], way, width)
        });
        let corner = |end: usize| {
            let at = outer[end];
            let shares = shares(side.places, at)?;
            Some(Corner { points: side.points, shares, at: [at[0] / size[0], at[1] / size[1]], tint: tints[end] })
        };
        let own = |k: usize| {
            let mut shares = [0.0; 3];
            shares[k] = 1.0;
            let at = side.places[k];
            Corner { points: side.points, shares, at: [at[0] / size[0], at[1] / size[1]], tint: tints[k] }
        };
        if let [Some(a), Some(b)] = [0, 1].map(corner) {
            self.corners.extend([own(0), own(1), b, own(0), b, a]);
        }
    }
}

/// A side beyond which the picture ends: how far it is drawn on. `None`: it goes on, or is not there inside either, or is dark, which what is
/// seen through may be.
fn side(
    picture: &Picture,
    (triangle, points, places): (usize, [u32; 3], [Place; 3]),
    is_through: bool,
) -> Option<Side> {
    let [a, b, c] = places;
    let along = sub(b, a);
    let length = along[0].hypot(along[1]);
    let normal = [along[1] / length, -along[0] / length];
    let off = sub(c, a);
    let high = off[0] * normal[0] + off[1] * normal[1];
    let (normal, high) = if high > 0.0 { (normal.map(|x| -x), high) } else { (normal, -high) };
    if !(length > 0.0 && high > 0.0) {
        return None;
    }
    // What fades out ends further away than what is cut off.
    let most = if is_through { WIDTHS[1] } else { (WIDTH * length).clamp(WIDTHS[0], WIDTHS[1]) };
    let mut width = most;
    for k in 0..LOOKS {
        let from = beyond(a, along, (k as f32 + 0.5) / LOOKS as f32);
        let inside = beyond(from, normal, -INSIDE * high);
        let least = COVERED * if is_through { alpha(picture, inside) } else { 1.0 };
        let is_covered = |at: Place| alpha(picture, at) >= least.max(FAINTEST);
        if !is_covered(inside) || (!is_through && luminance(picture, inside) < DARK) {
            return None;
        }
        // Where it ends; what comes after a gap is another part of it.
        let mut far = 0.0;
        let mut has_ended = false;
        while far <= most {
            let is_there = is_covered(beyond(from, normal, far));
            if has_ended && is_there {
                width = width.min(far - STEP);
                break;
            }
            has_ended |= !is_there;
            far += STEP;
        }
        if !has_ended {
            return None;
        }
    }
    (width >= STEP).then_some(Side { triangle, points, places, normal, width })
}

/// The way in which two strips of the same width meet, in that width.
fn between(a: Place, b: Place) -> Place {
    let dot = a[0] * b[0] + a[1] * b[1];
    let by = (1.0 / (1.0 + dot).max(1e-3)).min(SHARPEST / (2.0 + 2.0 * dot).max(1e-6).sqrt());
    [by * (a[0] + b[0]), by * (a[1] + b[1])]
}

/// The shares of a place of the corners of a triangle; `None`: it has no area.
fn shares([a, b, c]: [Place; 3], at: Place) -> Option<[f32; 3]> {
    let cross = |p: Place, q: Place| p[0] * q[1] - p[1] * q[0];
    let whole = cross(sub(b, a), sub(c, a));
    let [of_b, of_c] = [cross(sub(at, a), sub(c, a)), cross(sub(b, a), sub(at, a))].map(|part| part / whole);
    (of_b.is_finite() && of_c.is_finite()).then_some([1.0 - of_b - of_c, of_b, of_c])
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    const CLEAR: u32 = 0xff_ff_ff;

    /// Triangles about the middle of a disc, whose corners lie on its edge.
    fn disc(color: [u8; 4]) -> (Skin, Vec<[u32; 3]>, Vec<[u32; 2]>) {
        let mut picture = Picture::filled(64, 64, [0; 4]);
        for (i, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
            let [x, y] = [i % 64, i / 64].map(|k| k as f32 + 0.5 - 32.0);
            if x.hypot(y) < 24.0 {
                pixel.copy_from_slice(&color);
            }
        }
        let corner = |k: u32| {
            let angle = std::f32::consts::TAU * k as f32 / 6.0;
            [(32.0 + 24.0 * angle.cos()) / 64.0, (32.0 + 24.0 * angle.sin()) / 64.0]
        };
        let texture = [[0.5, 0.5]].into_iter().chain((0..6).map(corner)).collect();
        let triangles: Vec<[u32; 3]> = (0..6).map(|k| [10, 11 + k, 11 + (k + 1) % 6]).collect();
        let mut free: Vec<[u32; 2]> = (0..6).map(|k| [11 + k, 11 + (k + 1) % 6]).collect();
        free.iter_mut().for_each(|side| side.sort_unstable());
        free.sort_unstable();
        let skin = Skin { picture: Arc::new(picture), first: 10, triangles: triangles.clone(), texture };
        (skin, triangles, free)
    }

    #[test]
    fn a_strip_reaches_the_edge_of_the_picture_that_a_side_cuts_off() {
        let (skin, triangles, free) = disc([255, 200, 80, 255]);
        let rind = Rind::of(&skin, (&triangles, &[false; 6]), &free, |_, _| CLEAR);
        assert_eq!((rind.corners.len(), rind.clipped.len(), &rind.sides), (36, 6, &free));
        let far = |corner: &Corner| {
            let [x, y] = corner.at.map(|x| 64.0 * x - 32.0);
            x.hypot(y)
        };
        for strip in rind.corners.chunks(6) {
            // The middle of the arc is 24 px from the middle, that of the side 20.8.
            let middle = [2, 5].map(|k| strip[k].at.map(|x| 64.0 * x - 32.0));
            let middle = [0, 1].map(|axis| 0.5 * (middle[0][axis] + middle[1][axis]));
            assert!(middle[0].hypot(middle[1]) > 24.0, "{middle:?}");
            for corner in strip {
                assert!(far(corner) < 24.0 + SHARPEST * WIDTHS[1]);
                assert!((corner.shares.iter().sum::<f32>() - 1.0).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn what_goes_on_was_torn_and_what_is_dark_or_has_no_edge_stays_as_it_is() {
        let (skin, triangles, free) = disc([255, 200, 80, 255]);
        // Half of it is gone: the sides in the middle are free, and the picture goes on beyond them.
        let torn = Rind::of(
            &skin,
            (&triangles[..3], &[false; 3]),
            &{
                let mut free = free.clone();
                free.extend([[10, 11], [10, 14]]);
                free.sort_unstable();
                free
            },
            |_, _| CLEAR,
        );
        assert_eq!(torn.sides.len(), 3, "{:?}", torn.sides);
        let (dark, ..) = disc([20, 20, 30, 255]);
        assert!(Rind::of(&dark, (&triangles, &[false; 6]), &free, |_, _| CLEAR).sides.is_empty());
        let opaque = Skin { picture: Arc::new(Picture::filled(64, 64, [255; 4])), ..skin.clone() };
        assert!(Rind::of(&opaque, (&triangles, &[false; 6]), &free, |_, _| CLEAR).sides.is_empty());
        let clear = Skin { picture: Arc::new(Picture::filled(64, 64, [0; 4])), ..skin };
        assert!(Rind::of(&clear, (&triangles, &[false; 6]), &free, |_, _| CLEAR).corners.is_empty());
    }

    #[test]
    fn what_is_seen_through_ends_where_it_is_half_as_opaque() {
        let (faint, triangles, free) = disc([255, 200, 80, 70]);
        let drawn_on = |through: bool| {
            Rind::of(&faint, (&triangles, &[through; 6]), &free, |_, through| CLEAR | u32::from(through) << 24)
        };
        assert!(drawn_on(false).sides.is_empty(), "it would be clear by the usual law");
        let rind = drawn_on(true);
        assert_eq!(rind.sides, free);
        assert!(rind.corners.iter().all(|corner| corner.tint >> 24 == 1));
    }
}
