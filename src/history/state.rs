//! Running states in files: compressed little-endian numbers in base64.
//!
//! Every type says its fields once, in order; a field that comes or goes breaks the build here and needs another layout. Every
//! layout begins with the same core, positions, velocities, bonds and time, which a version that knows no more goes on from.

use std::io::{Read, Write};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use serde_json::{Value, json};

use super::dress::Dress;
use super::eased::Eased;
use super::frame::Frame;
use super::pack::{AnyCore, Core, FIRST_WITH_HAND_OVERS, FIRST_WITH_TRIANGLES, Packed, put_world, take_world};
use crate::sim::bond::lower_first;
use crate::sim::{Bonds, Dynamics, PointId, Saved, SavedWorld, borne, resume};

/// How the numbers are laid out.
pub(super) const LAYOUT: u64 = 13;

/// The first layout that says which body added points are of.
const FIRST_WITH_TINTS: u64 = 8;

/// The first layout that says how wide bodies are drawn, and which are hidden.
const FIRST_WITH_COATS: u64 = 9;

/// The first layout that says which numbers are on their way.
const FIRST_WITH_EASED: u64 = 10;

/// The first layout that says what bodies are called.
const FIRST_WITH_NAMES: u64 = 11;

/// The first layout that begins with the core.
const FIRST_WITH_CORE: u64 = 2;

/// Largest state that is unpacked `[bytes]`: some bytes may unpack to any size.
const LARGEST: u64 = 4 << 30;

/// A frame as bytes.
///
/// Errors: in words, why it cannot be kept.
pub(super) fn pack(frame: &Frame, compression: Compression) -> Result<Vec<u8>, String> {
    let saved = frame.world.save().ok_or("a world of these dimensions cannot be kept")?;
    let mut bytes = Vec::new();
    put_world(&saved, &mut bytes);
    frame.dress.put_added(&mut bytes)?;
    serde_json::to_vec(&frame.eased).map_err(|error| error.to_string())?.put(&mut bytes);
    let mut packed = ZlibEncoder::new(Vec::new(), compression);
    packed.write_all(&bytes).and_then(|()| packed.finish()).map_err(|error| error.to_string())
}

/// The state of a frame as a file has it; `scene` is what its scene is called, if it has a name.
///
/// Errors: in words, why it cannot be kept.
pub(super) fn keep(frame: &Frame, scene: Option<&str>) -> Result<Value, String> {
    let data = text(&pack(frame, Compression::default())?);
    let mut state = json!({ "wobble": env!("CARGO_PKG_VERSION"), "layout": LAYOUT, "data": data });
    if let Some(scene) = scene {
        state["scene"] = scene.into();
    }
    Ok(state)
}

/// Packed bytes as a text has them.
pub(super) fn text(packed: &[u8]) -> String {
    BASE64_STANDARD.encode(packed)
}

/// The version that wrote a state, if it says so.
pub(super) fn version(state: &Value) -> Option<&str> {
    state.get("wobble").and_then(Value::as_str)
}

/// What the scene is called that a state is of, if it says so.
pub(super) fn scene(state: &Value) -> Option<&str> {
    state.get("scene").and_then(Value::as_str)
}

/// How a state is laid out.
pub(super) fn layout(state: &Value) -> Option<u64> {
    state.get("layout").and_then(Value::as_u64)
}

/// The world of a file goes on, in the `dress` of its start with the skins that came after it. `start`: the world at the start of its scene, from
/// which a state of another layout takes all but positions, velocities, bonds and time.
///
/// Errors: in words, what of it is damaged or unknown, or has other dimensions or points than the start.
pub(super) fn go_on(state: &Value, start: &dyn Dynamics, dress: Dress) -> Result<Frame, String> {
    let mut frame = Frame::new(start.boxed_clone(), dress);
    let dress = &mut frame.dress;
    let layout = layout(state).ok_or("state: the key `layout` is missing")?;
    if layout < FIRST_WITH_CORE {
        return Err(format!("state: has layout {layout}, which no release of wobble wrote: get the file anew"));
    }
    let damaged = || "state: is damaged: get the file anew".to_owned();
    let bytes = unpack(state)?;
    let mut rest = &bytes[..];
    let saved = if layout <= LAYOUT {
        let mut saved = take_world(&mut rest, layout).ok_or_else(damaged)?;
        let (points, of_scene) = match &saved {
            SavedWorld::Plane(saved) => (saved.model.position.len(), saved.scene_points),
            SavedWorld::Space(saved) => (saved.model.position.len(), saved.scene_points),
        };
        let here = start.point_count();
        if of_scene != here {
            let message =
                format!("state: is of a scene of {of_scene} points, and this has {here}: name the one it is of");
            return Err(message);
        }
        let has_triangles = layout >= FIRST_WITH_TRIANGLES;
        let has = [!has_triangles, layout >= FIRST_WITH_TINTS, layout >= FIRST_WITH_COATS];
        dress.take_added(&mut rest, points, has).ok_or_else(damaged)?;
        if layout >= FIRST_WITH_NAMES {
            dress.take_names(&mut rest).ok_or_else(damaged)?;
        }
        if layout >= FIRST_WITH_EASED {
            frame.eased = take_eased(&mut rest).ok_or_else(damaged)?;
        }
        if !rest.is_empty() {
            return Err(damaged());
        }
        if !has_triangles {
            match &mut saved {
                SavedWorld::Plane(saved) => cover(saved, start, dress),
                SavedWorld::Space(saved) => cover(saved, start, dress),
            }
        }
        if layout < FIRST_WITH_HAND_OVERS {
            match (&mut saved, start.save()) {
                (SavedWorld::Plane(saved), Some(SavedWorld::Plane(start))) => budget_of(saved, &start),
                (SavedWorld::Space(saved), Some(SavedWorld::Space(start))) => budget_of(saved, &start),
                _ => {}
            }
        }
        saved
    } else {
        let core = AnyCore::take(&mut rest).ok_or_else(damaged)?;
        at_start(core, start)?
    };
    frame.world = resume(&saved).map_err(|error| format!("state: {error}"))?;
    if frame.world.dimensions() == start.dimensions() { Ok(frame) } else { Err(OTHER_DIMENSIONS.to_owned()) }
}

/// Numbers on their way, from the front of the bytes.
fn take_eased(from: &mut &[u8]) -> Option<Vec<Eased>> {
    let eased: Vec<Eased> = serde_json::from_slice(&Vec::<u8>::take(from)?).ok()?;
    eased.iter().all(Eased::is_fine).then_some(eased)
}

const OTHER_DIMENSIONS: &str = "state: has other dimensions than the scene: get the file anew";

/// Errors: in words, what is damaged.
fn unpack(state: &Value) -> Result<Vec<u8>, String> {
    let data = state.get("data").and_then(Value::as_str).ok_or("state: the key `data` is missing")?;
    let damaged = |_| "state: is damaged: get the file anew".to_owned();
    let packed = BASE64_STANDARD.decode(data).map_err(|error| damaged(error.to_string()))?;
    let mut bytes = Vec::new();
    let unpacked = ZlibDecoder::new(&packed[..]).take(LARGEST).read_to_end(&mut bytes);
    unpacked.map_err(|error| damaged(error.to_string()))?;
    Ok(bytes)
}

/// A core in the world of a start: what it does not say is as it was there.
///
/// Errors: in words: other dimensions.
fn at_start(core: AnyCore, start: &dyn Dynamics) -> Result<SavedWorld, String> {
    match (core, start.save()) {
        (AnyCore::Plane(core), Some(SavedWorld::Plane(saved))) => Ok(SavedWorld::Plane(replaced(core, saved))),
        (AnyCore::Space(core), Some(SavedWorld::Space(saved))) => Ok(SavedWorld::Space(replaced(core, saved))),
        _ => Err(OTHER_DIMENSIONS.to_owned()),
    }
}

/// Gives a kept world that says nothing of triangles those of the start and of the skins that came later, as far as they are left.
fn cover<const D: usize>(saved: &mut Saved<D>, start: &dyn Dynamics, dress: &Dress) {
    let mut all = left_of(start.triangles(), start.bonds(), saved);
    // What came later is of pictures: every side is a bond.
    let mut bonded: Vec<[PointId; 2]> = saved.model.bonds.ends().iter().copied().map(lower_first).collect();
    bonded.sort_unstable();
    let is_left = |[a, b, c]: &[PointId; 3]| {
        [[*a, *b], [*b, *c], [*c, *a]].into_iter().all(|side| bonded.binary_search(&lower_first(side)).is_ok())
    };
    all.extend(dress.added_triangles().map(|corners| corners.map(PointId)).filter(is_left));
    saved.model.triangles = all;
}

/// Gives a kept world that says nothing of a budget that of the start.
fn budget_of<const D: usize>(saved: &mut Saved<D>, start: &Saved<D>) {
    saved.model.method.budget = start.model.method.budget;
}

/// The triangles of a start that are left in a kept world, which began with these bonds.
fn left_of<const D: usize>(triangles: &[[PointId; 3]], bonds: &Bonds, saved: &Saved<D>) -> Vec<[PointId; 3]> {
    let is_gone = |number: u32| saved.bond_numbers.as_ref().is_some_and(|left| left.binary_search(&number).is_err());
    let cut = bonds.ends().iter().zip(0..).filter(|(_, number)| is_gone(*number)).map(|(ends, _)| *ends);
    borne(triangles, &saved.gone, cut).unwrap_or_else(|| triangles.to_vec())
}

fn replaced<const D: usize>(core: Core<D>, start: Saved<D>) -> Saved<D> {
    let bonds_at_start = start.model.bonds.clone();
    let Core { time, position, velocity, mass, pinned, bonds, gone, bond_numbers, next_numbers } = core;
    let mut model = start.model;
    // Points that were let go or deleted are led no more.
    model.pin_motion.retain(|(point, _)| pinned.contains(point));
    let is_left = |point: &PointId| gone.binary_search(point).is_err();
    model.forces.iter_mut().for_each(|force| force.points.retain(is_left));
    let mut force_numbers = start.force_numbers;
    let mut forces = model.forces.iter();
    force_numbers.retain(|_| forces.next().is_none_or(|force| !force.points.is_empty()));
    model.forces.retain(|force| !force.points.is_empty());
    (model.position, model.velocity, model.mass) = (position, velocity, mass);
    (model.pinned, model.bonds) = (pinned, bonds);
    let next_obstacle = next_numbers[1].max(start.next_numbers[1]);
    let lost = [(); 2].map(|()| vec![[0.0; D]; model.position.len()]);
    let next_numbers = [next_numbers[0], next_obstacle];
    let (cursor, grabbed, torn_beyond, lead) = (None, Vec::new(), 0.0, None);
    let handed_over = Vec::new();
    let mut saved = Saved {
        model,
        time,
        gone,
        bond_numbers,
        next_numbers,
        force_numbers,
        lost,
        cursor,
        grabbed,
        torn_beyond,
        lead,
        handed_over,
        ..start
    };
    // What is left of angles and areas is not said: those of bonds and points that went go, as triangles do.
    let ends: Vec<[PointId; 2]> = saved.model.bonds.ends().iter().copied().map(lower_first).collect();
    let was_bond = |side: [PointId; 2]| bonds_at_start.ends().iter().any(|&ends| lower_first(ends) == side);
    let is_left = |a: PointId, b: PointId| ends.contains(&lower_first([a, b])) || !was_bond(lower_first([a, b]));
    let is_gone = |point: &PointId| saved.gone.binary_search(point).is_ok();
    saved.model.angles.list.retain(|angle| {
        let [i, j, k] = angle.points;
        !angle.points.iter().any(is_gone) && is_left(i, j) && is_left(j, k)
    });
    saved.model.triangles = left_of(&saved.model.triangles, &bonds_at_start, &saved);
    // Areas at rest are worked out anew, from where the points are.
    saved.model.rest_areas = saved.model.areas_at_rest();
    saved
}
