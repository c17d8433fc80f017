//! The mesh drawn over its picture.

use anyhow::Context;
use tiny_skia::{Color, Paint, PathBuilder, Pixmap, PremultipliedColorU8, Stroke, Transform};

use crate::picture::{Brace, Picture, PictureMesh};

/// Longest side of the drawing `[px]`: a small picture is enlarged to a quarter of that at least.
const LONGEST: f64 = 2400.0;
/// Share of its contrast that the picture keeps under the mesh.
const FAINT: f32 = 0.45;
/// What the lightest and the clear parts of the picture become.
const PAPER: f32 = 250.0;

/// The bonds in blue, braces in a lighter one, the boundary in green, ropes in red.
///
/// Errors: no memory for the drawing.
pub(super) fn draw(picture: &Picture, mesh: &PictureMesh, braces: &[Brace]) -> anyhow::Result<Picture> {
    let longer = f64::from(picture.width.max(picture.height));
    let scale = if longer > LONGEST { LONGEST / longer } else { (0.25 * LONGEST / longer).ceil() };
    let size = [picture.width, picture.height].map(|side| ((f64::from(side) * scale).round() as u32).max(1));
    let mut target = Pixmap::new(size[0], size[1]).context("no memory for the preview")?;
    lay(&mut target, picture, scale);
    let width = 1.0_f32;
    let (sides, ropes) = mesh.bonds.split_at(mesh.mesh_bonds);
    stroke(&mut target, mesh, scale, braces.iter().map(|brace| brace.ends), [150, 185, 235], 0.8 * width);
    stroke(&mut target, mesh, scale, sides.iter().copied(), [30, 80, 190], width);
    let along = |points: &Vec<u32>| {
        let next = points.iter().copied().skip(1).chain(points.first().copied());
        points.iter().copied().zip(next).map(|(a, b)| [a, b]).collect::<Vec<_>>()
    };
    stroke(&mut target, mesh, scale, mesh.loops.iter().flat_map(along), [0, 130, 60], 2.0 * width);
    stroke(&mut target, mesh, scale, ropes.iter().copied(), [215, 40, 40], 2.5 * width);
    // Opaque all over: nothing is multiplied by its opacity.
    Ok(Picture { width: size[0], height: size[1], rgba: target.take() })
}

/// The picture, faint, on light paper.
fn lay(target: &mut Pixmap, picture: &Picture, scale: f64) {
    let width = target.width() as usize;
    for (i, pixel) in target.pixels_mut().iter_mut().enumerate() {
        let [x, y] = [i % width, i / width].map(|at| ((at as f64 + 0.5) / scale) as usize);
        let [x, y] = [x.min(picture.width as usize - 1), y.min(picture.height as usize - 1)];
        let at = 4 * (y * picture.width as usize + x);
        let alpha = f32::from(picture.rgba[at + 3]) / 255.0;
        let faint = |k: usize| {
            let colour = f32::from(picture.rgba[at + k]) * alpha + 255.0 * (1.0 - alpha);
            (PAPER - FAINT * (255.0 - colour)) as u8
        };
        if let Some(opaque) = PremultipliedColorU8::from_rgba(faint(0), faint(1), faint(2), 255) {
            *pixel = opaque;
        }
    }
}

fn stroke(
    target: &mut Pixmap,
    mesh: &PictureMesh,
    scale: f64,
    bonds: impl Iterator<Item = [u32; 2]>,
    [r, g, b]: [u8; 3],
    width: f32,
) {
    let mut path = PathBuilder::new();
    for bond in bonds {
        let [from, to] = bond.map(|k| mesh.points[k as usize].map(|x| (x * scale) as f32));
        path.move_to(from[0], from[1]);
        path.line_to(to[0], to[1]);
    }
    let Some(path) = path.finish() else { return };
    let mut paint = Paint::default();
    paint.set_color(Color::from_rgba8(r, g, b, 255));
    paint.anti_alias = true;
    let stroke = Stroke { width, ..Stroke::default() };
    target.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
}
