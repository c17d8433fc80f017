//! Strokes of a drawing as they were drawn: in the colour and as wide as their ink.

use super::plane::distance;
use super::{Picture, PictureMesh, Tint};

/// Strokes that are alike in colour and width.
#[derive(Clone, Debug, PartialEq)]
pub struct Pen {
    /// The points of their ropes, ascending.
    pub points: Vec<u32>,
    /// The mean colour of their ink, red, green, blue as stored, as light as is read on a dark ground and on a light one.
    pub color: [u8; 3],
    /// Mean width `[px]`.
    pub width: f64,
}

/// Parts of colours that differ by no more are those of one pen, and widths of no larger ratio: ink is uneven, and edges are smooth.
const ALIKE: f64 = 24.0;
const AS_WIDE: f64 = 1.25;

/// Least and largest luminance that stands out by 3 to 1 from the ground of either palette `[1]`.
///
/// Source: W3C, Web Content Accessibility Guidelines 2.2 (2023), contrast ratio.
const READ: [f64; 2] = [0.15, 0.26];

impl PictureMesh {
    /// The pens that the strokes of a picture were drawn with: each line between two points that others meet in is of one. None without strokes.
    ///
    /// Shapes: `picture` is the one that the mesh was made of.
    pub fn pens(&self, picture: &Picture) -> Vec<Pen> {
        let ropes = &self.bonds[self.mesh_bonds..];
        if ropes.is_empty() {
            return Vec::new();
        }
        let count = self.points.len();
        let mut lengths = vec![0.0; count];
        for &[a, b] in ropes {
            let length = distance(self.points[a as usize], self.points[b as usize]);
            [a, b].into_iter().for_each(|end| lengths[end as usize] += 0.5 * length);
        }
        let line_of = lines(self, count);
        let mut of_lines: Vec<(u32, u32)> =
            (self.mesh_points as u32..count as u32).map(|k| (line_of[k as usize], k)).collect();
        of_lines.sort_unstable();
        let mut found: Vec<Ink> = Vec::new();
        for line in of_lines.chunk_by(|a, b| a.0 == b.0) {
            let mut ink = Ink::default();
            line.iter().for_each(|&(_, point)| ink.add(self, picture, (point, lengths[point as usize])));
            match found.iter_mut().find(|other| other.is_like(&ink)) {
                Some(other) => other.join(ink),
                None => found.push(ink),
            }
        }
        found.into_iter().map(Ink::pen).collect()
    }
}

/// The line of each point of a rope: those along it, and a point that several meet in is of the first.
fn lines(mesh: &PictureMesh, count: usize) -> Vec<u32> {
    let ropes = &mesh.bonds[mesh.mesh_bonds..];
    let mut ends = vec![0_u32; count];
    ropes.iter().flatten().for_each(|&end| ends[end as usize] += 1);
    let mut is_joined = vec![false; count];
    let is_of_rope = |point: u32| point as usize >= mesh.mesh_points;
    let along = ropes.iter().copied().filter(|pair| {
        let mut may = pair.iter().all(|&end| is_of_rope(end));
        for &end in pair {
            let is_node = ends[end as usize] > 2;
            may &= !(is_node && is_joined[end as usize]);
        }
        if may {
            pair.iter().for_each(|&end| is_joined[end as usize] = true);
        }
        may
    });
    Tint::hanging(count, along)
}

/// What was seen of some ink.
#[derive(Default)]
struct Ink {
    points: Vec<u32>,
    /// Colours, by opacity, and that.
    sum: [f64; 3],
    opacity: f64,
    /// `[px^2]`
    area: f64,
    /// `[px]`
    length: f64,
}

impl Ink {
    /// A point of a rope, which so much of it belongs to: it lies on the middle line of a stroke.
    fn add(&mut self, mesh: &PictureMesh, picture: &Picture, (point, length): (u32, f64)) {
        let [x, y] = mesh.points[point as usize].map(|x| x.max(0.0) as usize);
        let [x, y] = [x.min(picture.width as usize - 1), y.min(picture.height as usize - 1)];
        let first = 4 * (y * picture.width as usize + x);
        let opacity = f64::from(picture.rgba[first + 3]);
        for (sum, part) in self.sum.iter_mut().zip(&picture.rgba[first..]) {
            *sum += opacity * f64::from(*part);
        }
        self.opacity += opacity;
        self.points.push(point);
        self.area += mesh.areas[point as usize];
        self.length += length;
    }

    fn join(&mut self, other: Ink) {
        self.points.extend(other.points);
        (0..3).for_each(|k| self.sum[k] += other.sum[k]);
        self.opacity += other.opacity;
        self.area += other.area;
        self.length += other.length;
    }

    /// Of what is clear everywhere black.
    fn color(&self) -> [f64; 3] {
        self.sum.map(|sum| if self.opacity > 0.0 { sum / self.opacity } else { 0.0 })
    }

    fn width(&self) -> f64 {
        if self.length > 0.0 { self.area / self.length } else { 0.0 }
    }

    fn is_like(&self, other: &Ink) -> bool {
        let ([a, b], [u, v]) = ([self.color(), other.color()], [self.width(), other.width()]);
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= ALIKE) && u <= AS_WIDE * v && v <= AS_WIDE * u
    }

    fn pen(mut self) -> Pen {
        self.points.sort_unstable();
        Pen { color: legible(self.color()), width: self.width(), points: self.points }
    }
}

/// A colour as light as it takes to be read on either ground: mixed with white, or darker in the same hue.
fn legible(color: [f64; 3]) -> [u8; 3] {
    let mut linear = color.map(|part| {
        let part = part / 255.0;
        if part <= 0.04045 { part / 12.92 } else { libm::pow((part + 0.055) / 1.055, 2.4) }
    });
    let [red, green, blue] = linear;
    let luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    if luminance < READ[0] {
        let share = (READ[0] - luminance) / (1.0 - luminance);
        linear = linear.map(|part| part + share * (1.0 - part));
    } else if luminance > READ[1] {
        linear = linear.map(|part| part * READ[1] / luminance);
    }
    linear.map(|part| {
        let stored = if part <= 0.003_130_8 { 12.92 * part } else { 1.055 * libm::pow(part, 1.0 / 2.4) - 0.055 };
        (255.0 * stored).round() as u8
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::picture::{Settings, Size, mesh_picture};

    /// Strokes 6 px wide on white: a black ring, and a bar of a colour.
    fn drawing(color: [u8; 3]) -> Picture {
        let mut picture = Picture::filled(300, 200, [255; 4]);
        for (i, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
            let [x, y] = [i % 300, i / 300].map(|k| k as f64 + 0.5);
            if ((x - 90.0).hypot(y - 100.0) - 60.0).abs() < 3.0 {
                pixel[..3].copy_from_slice(&[0; 3]);
            }
            if (x - 230.0).abs() < 3.0 && (y - 100.0).abs() < 80.0 {
                pixel[..3].copy_from_slice(&color);
            }
        }
        picture
    }

    #[test]
    fn strokes_have_the_colour_and_the_width_of_their_ink() {
        let settings = Settings { size: Size::Spacing(16.0), ..Settings::default() };
        let picture = drawing([200, 40, 40]);
        let mesh = mesh_picture(&picture, &settings).unwrap().mesh;
        let pens = mesh.pens(&picture);
        assert_eq!((pens.len(), mesh.mesh_points), (2, 0), "{pens:?}");
        let mut all: Vec<u32> = pens.iter().flat_map(|pen| pen.points.iter().copied()).collect();
        all.sort_unstable();
        assert!(all.iter().copied().eq(0..mesh.points.len() as u32), "each point is of one");
        assert!(pens.iter().all(|pen| (pen.width - 6.0).abs() < 0.6), "{pens:?}");
        let is_bar = |pen: &&Pen| pen.points.iter().all(|&point| mesh.points[point as usize][0] > 200.0);
        let bar = pens.iter().find(is_bar).unwrap();
        assert!(bar.color[0] > bar.color[1] + 100, "red: {:?}", bar.color);
        let ring = pens.iter().find(|pen| !is_bar(pen)).unwrap();
        assert!(ring.color.iter().all(|part| *part == ring.color[0] && (90..130).contains(part)), "{:?}", ring.color);
        let one = mesh_picture(&drawing([10; 3]), &settings).unwrap().mesh;
        assert_eq!(one.pens(&drawing([10; 3])).len(), 1, "both are black");
    }

    #[test]
    fn what_has_no_strokes_has_no_pens() {
        let picture = Picture::filled(64, 64, [0, 0, 0, 255]);
        let settings = Settings { threshold: crate::picture::Threshold::Whole, ..Settings::default() };
        assert!(mesh_picture(&picture, &settings).unwrap().mesh.pens(&picture).is_empty());
    }

    #[test]
    fn ink_of_any_colour_is_read_on_both_grounds() {
        let luminance = |color: [u8; 3]| {
            let linear = color.map(|part| {
                let part = f64::from(part) / 255.0;
                if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
            });
            0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
        };
        for color in [[0.0; 3], [255.0; 3], [0.0, 0.0, 200.0], [255.0, 240.0, 0.0], [200.0, 40.0, 40.0]] {
            let seen = legible(color);
            assert!((READ[0] - 0.01..READ[1] + 0.01).contains(&luminance(seen)), "{color:?}: {seen:?}");
        }
        assert_eq!(legible([180.0, 80.0, 90.0]), [180, 80, 90], "what is read already stays");
    }
}
