//! The gallery under a mouse that is somewhere else in every frame, and in the second half of the time grabs what it finds and flings it: a
//! frame has its bounds, most frames are cheap, nothing is left broken or inside out, no point is left deep in something, rods keep their
//! lengths, and energy does not come from nowhere.

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use wobble::scene::{Entry, Scene, SolverName, gallery};
use wobble::sim::{BondKind, Command, Counters, Cursor, Dynamics, Limit, PointId, Sample, frame_of};

use super::FRAME;
use super::run_to;
use crate::common::inside::{deepest, length, sub};
use crate::common::jumping::{JumpingMouse, extent};
use crate::common::{asked, is_asked};

/// What is too large for it: a frame takes a third of a second.
const LEFT_OUT: [&str; 1] = ["million-cloth"];
/// How long the mouse jumps [s], if `WOBBLE_SECONDS` does not say it.
const TIME: f64 = 10.0;
/// Counted work of half of the frames [ms].
const MEDIAN: f64 = 4.0;
/// A triangle is inside out for less than this [s].
const INVERTED: f64 = 1.0;
/// Every so many frames it is looked at how deep points are in what is solid, how long rods are and how much energy there is: in the last of them,
/// when no hand holds any. More often would be more chances, for which the bounds are not made.
const LOOKS: u64 = 60;
/// They are less deep in it than this share of the scene's size [1].
const DEPTH: f64 = 0.01;
/// Rods of scenes of so many points at most are strained by less than this [1]: seven times the 0.007 of one among the cut-out obstacles, elsewhere
/// none is by more than 0.0005. Rods that are not held are strained by tenths.
const RODS: (usize, f64) = (1000, 0.05);
/// A ledger is kept of so many points at most, and of these scenes: of others it takes long.
const BOOKED: usize = 200;
const BOOKED_TOO: [&str; 2] = ["gear", "tearable-net"];
/// What is more of energy than there was and was brought is at the end no more than this share of what was brought, or of the most that moved, and at
/// no look more than this share of the largest that either was at any look [1]: what was brought may be taken again.
const GAIN: f64 = 0.01;
/// Of so many scenes at least the energy is judged: of those of few points.
const JUDGED: u64 = 17;
/// The guard of the live step's energy acts in no more than this share of all substeps [1]: without the mouse it is 0.0004.
const GUARDED: f64 = 0.04;

/// What is counted over all scenes.
#[derive(Default)]
struct Sums {
    /// Scenes whose energy could be judged.
    judged: AtomicU64,
    /// Substeps, and those in which the guard of energy acted.
    substeps: AtomicU64,
    guarded: AtomicU64,
}

/// The size of a scene [m]: the lesser side of its walls, or the larger one of its points where it has none.
fn size(world: &dyn Dynamics) -> f64 {
    let [low, high] = extent(world);
    match world.bounds() {
        Some([low, high]) => (high[0] - low[0]).min(high[1] - low[1]),
        None => (high[0] - low[0]).max(high[1] - low[1]),
    }
}

/// Whether no point of a scene may get into what is solid: loops as they are printed let them, and a penalty is a force by depth.
fn keeps_out(scene: &Scene) -> bool {
    let is_printed = scene.method.solver == Some(SolverName::AsPrinted);
    !is_printed && scene.obstacles.iter().all(|obstacle| obstacle.penalty.is_none())
}

/// What came of energy [J].
struct Gained {
    /// How much more there is than there was and was brought.
    excess: f64,
    /// What the method made by the ledger's own count.
    made: f64,
    /// What both are measured by: what was brought, or the most that moved.
    most: f64,
    /// What rounding alone may make.
    rounding: f64,
}

/// What came of energy. Nothing where no ledger is kept, or it cannot tell, or bonds are relaxed: these correct places and know no energy.
fn gained(world: &dyn Dynamics, sample: &Sample) -> Option<Gained> {
    let ledger = sample.ledger.as_ref().filter(|ledger| ledger.book.untold == 0)?;
    if world.bonds().iter().any(|bond| matches!(bond.kind, BondKind::Relaxed { .. })) {
        return None;
    }
    let (excess, made, rounding) = (ledger.excess(), ledger.left_over(), ledger.rounding);
    Some(Gained { excess, made, rounding, most: ledger.most_kinetic.max(ledger.book.brought().abs()) })
}

/// The largest strain of rods, that act both ways and follow no drive [1].
fn strained(world: &dyn Dynamics, sample: &Sample) -> f64 {
    let is_rod = |bond: &wobble::sim::Bond| {
        bond.kind == BondKind::Rigid && bond.limit == Limit::Both && bond.drive.is_none() && bond.rest_length > 0.0
    };
    let strain = |bond: wobble::sim::Bond| {
        let off = sub(sample.position[bond.a.index()], sample.position[bond.b.index()]);
        (length(off) / bond.rest_length - 1.0).abs()
    };
    world.bonds().iter().filter(is_rod).map(strain).fold(0.0, f64::max)
}

/// What the frames of a run were like.
#[derive(Default)]
struct Frames {
    /// The dearest one without a hand-over in it [ms of counted work].
    dearest: f64,
    /// What it did, in words.
    did: String,
    /// Each of them.
    works: Vec<f64>,
    /// How long the triangle was inside out that was so longest [s].
    inverted: f64,
    /// How deep the deepest point was in what is solid, and when [m, s].
    depth: [f64; 2],
    /// How much the most strained rod was, and when [1, s].
    strain: [f64; 2],
    /// How much more of energy there was than there had been and was brought, rounding apart, where it was most, and when [J, s].
    gain: [f64; 2],
    /// The most that it is measured by [J].
    measure: f64,
}

impl Frames {
    fn median(mut self) -> f64 {
        self.works.sort_by(f64::total_cmp);
        self.works[self.works.len() / 2]
    }
}

/// The signed areas of the triangles, by their numbers; none in space [m^2].
fn areas(world: &dyn Dynamics) -> Vec<f64> {
    if world.dimensions() != 2 {
        return Vec::new();
    }
    let x = world.positions();
    let at = |point: PointId| [x.get(2 * point.index()), x.get(2 * point.index() + 1)];
    let area = |corners: &[PointId; 3]| {
        let [a, b, c] = corners.map(at);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    };
    world.triangles().iter().map(area).collect()
}

/// What was done between two moments, in the order of a substep.
fn did(before: &Counters, after: &Counters, time: f64) -> String {
    let counts = [
        ("substeps", after.substeps - before.substeps),
        ("splits", after.guard_splits - before.guard_splits),
        ("sweeps and rounds", after.iterations - before.iterations),
        ("bonds", after.bonds_solved - before.bonds_solved),
        ("points", after.points_moved - before.points_moved),
        ("events", after.events - before.events),
        ("searches", after.detections - before.detections),
        ("contacts", after.contacts - before.contacts),
        ("cut motions", after.truncations - before.truncations),
        ("looks", after.looks - before.looks),
    ];
    let words = counts.map(|(word, count)| format!("{count} {word}"));
    format!("at {time:.2} s {}", words.join(", "))
}

/// The frames of a run.
fn run(world: &mut dyn Dynamics) -> Frames {
    let (mut frame, mut before) = (0, *world.counters());
    let mut frames = Frames::default();
    let (mut start, mut torn) = (areas(world), world.counters().bonds_torn);
    let mut since = vec![f64::INFINITY; start.len()];
    let end = asked("WOBBLE_SECONDS", TIME);
    let mut mouse = JumpingMouse::new(world, end);
    while world.time() < end - 1e-9 {
        if frame_of(world.time()) != frame || frame == 0 {
            frame = frame_of(world.time());
            mouse.jump(world, frame);
        }
        world.step();
        if frame_of(world.time() + world.substep()) != frame_of(world.time()) {
            let counters = *world.counters();
            let own = counters.work_ms() - before.work_ms();
            if counters.hand_overs == before.hand_overs && own > frames.dearest {
                (frames.dearest, frames.did) = (own, did(&before, &counters, world.time()));
            }
            frames.works.push(own);
            before = counters;
            if frame % LOOKS == LOOKS - 1 {
                let sample = world.sample(world.time());
                let rods = if world.point_count() <= RODS.0 { strained(&*world, &sample) } else { 0.0 };
                let gained = gained(&*world, &sample);
                let gain = gained.as_ref().map_or(0.0, |gained| gained.excess - gained.rounding);
                frames.measure = gained.map_or(frames.measure, |gained| gained.most.max(frames.measure));
                let Frames { depth, strain, gain: most, .. } = &mut frames;
                for (value, most) in [(deepest(&*world, &sample), depth), (rods, strain), (gain, most)] {
                    if value > most[0] {
                        *most = [value, world.time()];
                    }
                }
            }
            let now = areas(world);
            if counters.bonds_torn != torn || now.len() != start.len() {
                // Triangles went with bonds that broke: which is which is not known any more.
                (start, torn) = (now.clone(), counters.bonds_torn);
                since = vec![f64::INFINITY; start.len()];
            }
            for ((since, before), now) in since.iter_mut().zip(&start).zip(&now) {
                *since = if before * now < 0.0 { since.min(world.time()) } else { f64::INFINITY };
                frames.inverted = frames.inverted.max(world.time() - *since);
            }
        }
    }
    frames
}

/// What is wrong with a scene under the mouse; what all scenes have together is counted.
fn fault(entry: &Entry, sums: &Sums) -> Option<String> {
    let clock = std::time::Instant::now();
    let mut scene = entry.scene().unwrap();
    // What is asked for by name may make energy.
    let is_booked = entry.point_count <= BOOKED || BOOKED_TOO.contains(&entry.name);
    scene.method.ledger = Some(scene.method.solver.is_none() && is_booked);
    let mut world = scene.world(None).unwrap();
    let size = size(&*world);
    let frames = run(&mut *world);
    let Frames {
        dearest,
        inverted,
        depth: [depth, when],
        strain: [strain, strained_at],
        gain: [gain, gained_at],
        measure,
        ref did,
        ..
    } = frames;
    let did = did.clone();
    let median = frames.median();
    let is_untouched = world.counters().mouse_points == 0 && entry.json.contains("\"mouse\"");
    let gained = gained(&*world, &world.sample(world.time()));
    let Counters { substeps, guarded, .. } = *world.counters();
    let counts = [(&sums.judged, u64::from(gained.is_some())), (&sums.substeps, substeps), (&sums.guarded, guarded)];
    counts.into_iter().for_each(|(sum, count)| _ = sum.fetch_add(count, Ordering::Relaxed));
    let is_in = keeps_out(&scene) && depth > DEPTH * size;
    // What the ledger can tell to the end it could tell before.
    let is_made =
        gained.as_ref().is_some_and(|last| gain > GAIN * measure.max(last.most) || last.excess > GAIN * last.most);
    let is_long = keeps_out(&scene) && strain > RODS.1;
    let is_beyond = dearest > FRAME || median > MEDIAN || inverted > INVERTED || is_in || is_made || is_long;
    let energies = gained.map_or_else(String::new, |Gained { excess, made, most, .. }| {
        format!(", {excess:.3e} J more than was brought, {made:.3e} J made, of {most:.3e} J")
    });
    let figures = format!(
        "at most {dearest:.2} ms, half below {median:.2} ms, guarded {guarded} of {substeps}, inside out for {inverted:.2} s, {depth:.2e} m of {size:.2} m deep at {when:.1} s, rods strained by {strain:.1e} at {strained_at:.1} s, {gain:.1e} J more at {gained_at:.1} s{energies}"
    );
    eprintln!("{}: {figures}, {:.1} s; the dearest: {did}", entry.name, clock.elapsed().as_secs_f64());
    (is_beyond || !world.is_finite() || is_untouched)
        .then(|| format!("{}: {figures}, {:?}", entry.name, world.counters()))
}

/// With `--nocapture` it prints the figures of each scene. `WOBBLE_SCENE=NAME` plays one.
#[test]
fn the_gallery_bears_a_mouse_that_jumps() {
    let is_played = |entry: &&Entry| !LEFT_OUT.contains(&entry.name) && is_asked("WOBBLE_SCENE", entry.name);
    let entries: Vec<&Entry> = gallery().iter().filter(is_played).collect();
    let (next, sums, wrong) = (AtomicUsize::new(0), Sums::default(), Mutex::new(Vec::new()));
    let workers = std::thread::available_parallelism().map_or(1, usize::from).min(4);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                while let Some(entry) = entries.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let found = fault(entry, &sums);
                    wrong.lock().unwrap().extend(found);
                }
            });
        }
    });
    let mut wrong = wrong.into_inner().unwrap();
    wrong.sort();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let Sums { judged, substeps, guarded } = sums;
    let [judged, substeps, guarded] = [judged, substeps, guarded].map(AtomicU64::into_inner);
    let is_part = entries.len() < gallery().len() - LEFT_OUT.len();
    assert!(is_part || judged >= JUDGED, "the energy of {judged} scenes");
    assert!(
        is_part || guarded as f64 <= GUARDED * substeps as f64,
        "the guard acted in {guarded} of {substeps} substeps"
    );
}

/// The smallest area within the outer ring of any rim, as a share of that at the start.
fn least_ring(world: &dyn Dynamics, start: &mut Vec<f64>) -> f64 {
    const POINTS: usize = 24;
    let x = world.positions();
    let at = |i: usize| [x.get(2 * i), x.get(2 * i + 1)];
    let area = |rim: usize| {
        let ring = (0..12).map(|k| [at(POINTS * rim + k), at(POINTS * rim + (k + 1) % 12)]);
        0.5 * ring.map(|[a, b]| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
    };
    let areas: Vec<f64> = (0..world.point_count() / POINTS).map(area).collect();
    if start.is_empty() {
        start.clone_from(&areas);
    }
    areas.iter().zip(&*start).map(|(now, start)| now / start).fold(f64::INFINITY, f64::min)
}

#[test]
fn a_thousand_rims_come_back_when_the_mouse_has_swept_through_them() {
    let entry = gallery().iter().find(|entry| entry.name == "thousand-rims").unwrap();
    let mut world = entry.scene().unwrap().world(None).unwrap();
    let mut start = Vec::new();
    assert!((least_ring(&*world, &mut start) - 1.0).abs() < 1e-12 && start.len() == 1000);
    let mut swept = f64::INFINITY;
    for frame in 0..72_u32 {
        let [from, to] = [frame, frame + 1].map(|frame| f64::from(frame) / 60.0);
        let at = Cursor::at([-10.0 + 20.0 * (from / 1.2), 0.0]);
        world.apply(&Command::Cursor { to: Some(at), by: to }).unwrap();
        run_to(&mut *world, to);
        swept = swept.min(least_ring(&*world, &mut start));
    }
    world.apply(&Command::Cursor { to: None, by: world.time() }).unwrap();
    // They swing on, and give a little as they do.
    run_to(&mut *world, 3.2);
    let after = least_ring(&*world, &mut start);
    assert!(swept < 0.9 && after > 0.9, "{swept:.3} while it sweeps, {after:.3} two seconds later");
}
