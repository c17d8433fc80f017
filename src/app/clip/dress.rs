//! What is seen of a copy and no step knows of: colours, pictures, groups.

use std::sync::{Arc, Mutex, PoisonError, Weak};

use crate::history::{Do, Group, History};
use crate::picture::{Coat, Picture, Skin, Tint};
use crate::render::palette_color;
use crate::scene::{DrawnKeys, PointGroupKeys, Row, SkinKeys, picture_as_text};
use crate::sim::{PointId, SkinMaterial};

/// Runs of points, counted in their order, that have the same.
fn runs<T: PartialEq>(points: &[PointId], of: impl Fn(&PointId) -> T) -> Vec<(T, Vec<u32>)> {
    let mut first = 0;
    let mut list = Vec::new();
    for same in points.chunk_by(|a, b| of(a) == of(b)) {
        let copies = first..first + same.len() as u32;
        first = copies.end;
        list.push((of(&same[0]), copies.collect()));
    }
    list
}

/// How points are drawn, and what their skins are made of. What is filled without a colour of its own has one by its number,
/// which is another's in a copy: so it is said.
pub(super) fn skins(history: &History, points: &[PointId]) -> Vec<SkinKeys> {
    let (world, tints) = (history.world(), history.tints());
    let mut drawn: Vec<[u32; 3]> = history.skins().iter().flat_map(|skin| skin.triangles.iter().copied()).collect();
    drawn.iter_mut().for_each(|corners| corners.sort_unstable());
    drawn.sort_unstable();
    let mut is_filled = vec![false; world.point_count()];
    for corners in world.triangles() {
        let mut sorted = corners.map(|corner| corner.0);
        sorted.sort_unstable();
        if drawn.binary_search(&sorted).is_err() {
            sorted.iter().for_each(|&corner| is_filled[corner as usize] = true);
        }
    }
    let look = |point: &PointId| {
        let tint = Tint::of(tints, point.0);
        let by_number = || tint.filter(|_| is_filled[point.index()]).map(|tint| palette_color(tint.body));
        let coat = Coat {
            color: tint.and_then(|tint| tint.color).or_else(by_number),
            width: tint.map(|tint| tint.width).filter(|width| *width > 0.0),
            visible: tint.filter(|tint| tint.is_hidden).map(|_| false),
        };
        (coat, world.skin_of(*point))
    };
    let keys = |((coat, material), points): ((Coat, SkinMaterial), Vec<u32>)| {
        let SkinMaterial { friction, restitution, radius } = material;
        let is_said = !coat.is_empty() || material != SkinMaterial::default();
        is_said.then(|| SkinKeys { friction, restitution, radius, ..SkinKeys::of_coat(points, coat) })
    };
    runs(points, look).into_iter().filter_map(keys).collect()
}

/// The pictures that are drawn on triangles among points, ascending, each with where the points lie in it.
pub(super) fn textures(skins: &[Skin], points: &[PointId]) -> Vec<DrawnKeys> {
    let place = |point: u32| points.binary_search(&PointId(point)).ok();
    let of = |skin: &Skin| {
        let whole = skin.triangles.iter().filter(|corners| corners.iter().all(|&corner| place(corner).is_some()));
        let mut corners: Vec<u32> = whole.flatten().copied().collect();
        corners.sort_unstable();
        corners.dedup();
        let uv =
            |corner: &u32| skin.texture.get((corner - skin.first) as usize).map_or([0.0; 2], |uv| uv.map(f64::from));
        let uv = corners.iter().map(|corner| Row(uv(corner))).collect();
        let image = (!corners.is_empty()).then(|| as_text(&skin.picture)).flatten()?;
        let points = corners.into_iter().filter_map(place).map(|place| place as u32).collect();
        Some(DrawnKeys { image, points, uv })
    };
    skins.iter().filter_map(of).collect()
}

/// So many pictures are known as texts, the last ones.
const MOST_KNOWN: usize = 4;
/// Pictures that were copied last, as texts: making one takes longer than a frame, and who copies once does so again.
static KNOWN: Mutex<Vec<(Weak<Picture>, Arc<str>)>> = Mutex::new(Vec::new());

/// A picture as text; `None` of one that cannot be written.
fn as_text(picture: &Arc<Picture>) -> Option<String> {
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let is_it = |(kept, _): &&(Weak<Picture>, Arc<str>)| kept.upgrade().is_some_and(|kept| Arc::ptr_eq(&kept, picture));
    if let Some((_, text)) = known().iter().find(is_it) {
        return Some(text.to_string());
    }
    let text = picture_as_text(picture).ok()?;
    let mut list = known();
    list.retain(|(kept, _)| kept.strong_count() > 0);
    if list.len() == MOST_KNOWN {
        list.remove(0);
    }
    list.push((Arc::downgrade(picture), text.as_str().into()));
    Some(text)
}

/// The groups of which two points or more are copied, counted in the copy.
pub(super) fn groups(groups: Vec<Group>, place: impl Fn(PointId) -> Option<u32>) -> Vec<PointGroupKeys> {
    let of = |group: Group| {
        let points: Vec<u32> = group.points.into_iter().filter_map(&place).collect();
        (points.len() > 1).then_some(PointGroupKeys { points, title: Some(group.name) })
    };
    groups.into_iter().filter_map(of).collect()
}

/// What names the groups of a copy whose first point gets the number `next`: as they were called, or with the next number that is free.
pub(super) fn named(groups: &[PointGroupKeys], there: &[Group], next: u32) -> Vec<Do> {
    let mut taken: Vec<String> =
        there.iter().filter(|group| !group.points.is_empty()).map(|group| group.name.clone()).collect();
    let mut list = Vec::new();
    for group in groups {
        let title = group.title.as_deref().unwrap_or("group");
        let stem = title.trim_end_matches(|sign: char| sign.is_ascii_digit()).trim_end();
        let stem = if stem.is_empty() { "group" } else { stem };
        let counted = (1..).map(|k| format!("{stem} {k}"));
        let is_free = |name: &String| !taken.contains(name);
        let Some(name) = std::iter::once(title.to_owned()).chain(counted).find(is_free) else { continue };
        taken.push(name.clone());
        list.push(Do::Group { points: group.points.iter().map(|point| PointId(point + next)).collect(), name });
    }
    list
}
