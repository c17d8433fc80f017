//! Bodies as they are filled: their triangles, and a colour each.

use super::MOST_INNER;
use super::cells::cells;
use crate::picture::{HUES, Picture, Skin, Tint, hue};
use crate::render::forms::{form, is_rope, ropes};
use crate::render::look::{Look, in_bytes};
use crate::render::notch::closing;
use crate::render::view::View;
use crate::sim::{Bond, Bonds, PointId};

/// What is filled in one colour, over what came before it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Filled {
    /// The number of the body.
    pub(super) body: u32,
    /// Its colour was given to it.
    pub(super) is_own: bool,
    /// Red, green, blue, as stored.
    pub(super) color: [u8; 3],
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Colours of bodies, those that follow each other well apart: they are told apart by eyes that see two colours only, and stand out
/// from the ground by 8 : 1 or more.
///
/// Source: P. Tol, Colour schemes (technical note SRON/EPS/TN/09-002, 3.2, 2021), the scheme `light`, without olive and grey.
pub(super) const PALETTE: [[u8; 3]; HUES as usize] = [
    [0x77, 0xAA, 0xDD],
    [0xEE, 0x88, 0x66],
    [0x44, 0xBB, 0x99],
    [0xEE, 0xDD, 0x88],
    [0xFF, 0xAA, 0xBB],
    [0x99, 0xDD, 0xFF],
    [0xBB, 0xCC, 0x33],
];
/// The colour of skin: half way between two of them.
pub(super) const SKIN_COLOR: [u8; 3] = [0xF6, 0xC3, 0x99];
/// The colour of a body by its number.
pub fn color_of(body: u32) -> [u8; 3] {
    PALETTE[hue(body) as usize]
}

/// Bodies in the order of their numbers: with the triangles that no skin is drawn on, then with those that one is, and last with the cells
/// of nets, which the plane alone has. Also the bonds that tore and left these open.
pub(super) fn bodies<'a>(view: &View<'a>) -> ([Vec<Filled>; 3], Vec<&'a Bond>) {
    let [bare, worn] = split(view);
    let has_cells = view.dimensions == 2 && view.bonds.len() <= MOST_INNER;
    let (cells, open) = match has_cells {
        true => cells((view.bonds, view.torn), &outside_of_triangles(view)),
        false => Default::default(),
    };
    let hangs_on = if view.tints.is_empty() { Some(hanging(view)) } else { None };
    let body_of = |corners: &[u32; 3]| match &hangs_on {
        Some(bodies) => (bodies[corners[0] as usize], None),
        None => Tint::of(view.tints, corners[0]).map_or((0, None), |tint| (tint.body, tint.color)),
    };
    let filled = |same: &[(Key, [u32; 3])]| Filled {
        body: same[0].0.0,
        is_own: same[0].0.1.is_some(),
        color: same[0].0.1.unwrap_or_else(|| color_of(same[0].0.0)),
        triangles: same.iter().map(|entry| entry.1).collect(),
    };
    let bodies = [bare, worn, cells].map(|triangles| {
        let mut listed: Vec<(Key, [u32; 3])> = triangles.iter().map(|corners| (body_of(corners), *corners)).collect();
        listed.sort_by_key(|entry| entry.0);
        listed.chunk_by(|p, q| p.0 == q.0).map(filled).collect()
    });
    (bodies, open)
}

/// The colour that the first of some points, ascending, is seen in: that of its fill, or the mean one of its picture; where no triangle meets
/// any, of their first bond. `None` where there is neither.
pub fn body_color(view: &View<'_>, look: &Look, points: &[PointId]) -> Option<[u8; 3]> {
    filled_color(view, points).or_else(|| bond_color(view, look, points))
}

/// The colour of the first bond between points, as it is drawn.
fn bond_color(view: &View<'_>, look: &Look, points: &[PointId]) -> Option<[u8; 3]> {
    let has = |point: &PointId| points.binary_search(point).is_ok();
    let own: Bonds = view.bonds.iter().filter(|bond| !points.is_empty() && has(&bond.a) && has(&bond.b)).collect();
    let first = own.iter().next()?;
    let is_rope = is_rope(form(&first)) || ropes(&own, points.last()?.index() + 1)[0];
    let tint = Tint::of(view.tints, first.a.0).and_then(|tint| tint.color);
    Some(tint.unwrap_or_else(|| in_bytes(if is_rope { look.rope } else { look.bond })))
}

fn filled_color(view: &View<'_>, points: &[PointId]) -> Option<[u8; 3]> {
    let is_theirs = |corners: &&[PointId; 3]| corners.iter().any(|corner| points.binary_search(corner).is_ok());
    let corner = view.triangles.iter().filter(|_| !points.is_empty()).find(is_theirs)?[0];
    let wears = |skin: &&Skin| {
        let range = skin.first..skin.first + skin.texture.len() as u32;
        range.contains(&corner.0) && skin.triangles.iter().flatten().any(|point| *point == corner.0)
    };
    if let Some(skin) = view.skins.iter().find(wears) {
        return mean_color(&skin.picture);
    }
    let tint = Tint::of(view.tints, corner.0);
    let own = tint.and_then(|tint| tint.color);
    let body = || match tint {
        Some(tint) => tint.body,
        None if view.tints.is_empty() => hanging(view)[corner.index()],
        None => 0,
    };
    Some(own.unwrap_or_else(|| color_of(body())))
}

/// Pixels that are looked at for the mean of a picture, about.
const SAMPLED: usize = 4096;

/// The mean colour of what of a picture is opaque; `None` where nothing is.
fn mean_color(picture: &Picture) -> Option<[u8; 3]> {
    let pixels = picture.rgba.as_chunks::<4>().0;
    let step = (pixels.len() / SAMPLED).max(1);
    let opaque = pixels.iter().step_by(step).filter(|pixel| pixel[3] > 127);
    let (sum, count) = opaque.fold(([0_u64; 3], 0), |(sum, count), pixel| {
        (std::array::from_fn(|part| sum[part] + u64::from(pixel[part])), count + 1)
    });
    (count > 0).then(|| sum.map(|sum| (sum / count) as u8))
}

/// The number of a body, and the colour that it says it has.
type Key = (u32, Option<[u8; 3]>);

/// The triangles that no skin is drawn on, and those that one is, each with what closes the notches between them.
fn split(view: &View<'_>) -> [Vec<[u32; 3]>; 2] {
    let key = |mut corners: [u32; 3]| {
        corners.sort_unstable();
        corners
    };
    let mut worn: Vec<[u32; 3]> = view.skins.iter().flat_map(|skin| &skin.triangles).map(|&c| key(c)).collect();
    worn.sort_unstable();
    let count = (view.current.len() / view.dimensions.max(1)) as u32;
    let is_there = |corners: &[u32; 3]| corners.iter().all(|&corner| corner < count);
    let all = view.triangles.iter().map(|corners| corners.map(|corner: PointId| corner.0));
    let (bare, worn): (Vec<_>, Vec<_>) = all.filter(is_there).partition(|&c| worn.binary_search(&key(c)).is_err());
    [bare, worn].map(|mut triangles| {
        triangles.extend(closing(view, &triangles));
        triangles
    })
}

/// Which points are of no triangle and of no skin, whole or torn.
fn outside_of_triangles(view: &View<'_>) -> Vec<bool> {
    let mut is_outside = vec![true; view.current.len() / view.dimensions.max(1)];
    let corners = view.triangles.iter().flatten().map(|corner| corner.index());
    let worn = view.skins.iter().flat_map(|skin| skin.first as usize..skin.first as usize + skin.texture.len());
    for point in corners.chain(worn) {
        is_outside.get_mut(point).into_iter().for_each(|is| *is = false);
    }
    is_outside
}

/// The number of the body of each point, where what bonds and triangles hold together is one.
fn hanging(view: &View<'_>) -> Vec<u32> {
    let bonds = view.bonds.iter().map(|bond| [bond.a.0, bond.b.0]);
    let sides = view.triangles.iter().flat_map(|&[a, b, c]| [[a.0, b.0], [b.0, c.0]]);
    Tint::hanging(view.current.len() / view.dimensions.max(1), bonds.chain(sides))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// About the luminance of a colour in sRGB, by WCAG 2.
    fn luminance(color: [u8; 3]) -> f64 {
        let linear = |part: u8| {
            let c = f64::from(part) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2])
    }

    #[test]
    fn a_net_beside_a_body_has_cells_of_its_own_colour_and_the_body_has_none() {
        use crate::sim::{Bond, Positions};
        let ends = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]];
        let bonds: Bonds = ends.iter().map(|&[a, b]| Bond::new(PointId(a), PointId(b), 1.0)).collect();
        let places = [0.0; 21];
        let at = |count: usize| Positions::F64(&places[..count]);
        let triangles = [[4, 5, 6].map(PointId)];
        let view = View { previous: at(14), current: at(14), triangles: &triangles, ..View::empty(&bonds, 2) };
        let ([bare, worn, cells], _) = bodies(&view);
        assert_eq!(
            bare.iter().map(|body| (body.body, body.triangles.clone())).collect::<Vec<_>>(),
            [(1, vec![[4, 5, 6]])]
        );
        let net = Filled { body: 0, is_own: false, color: color_of(0), triangles: vec![[0, 1, 2], [0, 2, 3]] };
        assert!(worn.is_empty() && cells == [net], "{cells:?}");
        let in_space = View { previous: at(21), current: at(21), ..View::empty(&bonds, 3) };
        assert!(bodies(&in_space).0.iter().all(Vec::is_empty), "of the plane alone");
    }

    #[test]
    fn bodies_beside_each_other_differ_and_stand_out_from_the_ground() {
        for body in 0..200 {
            assert_ne!(color_of(body), color_of(body + 1), "{body}");
            assert_ne!(color_of(body), color_of(body + 7), "{body}");
            assert!((luminance(color_of(body)) + 0.05) / (luminance([0x0f, 0x14, 0x1e]) + 0.05) > 6.5, "{body}");
        }
    }
}
