//! The gallery under a mouse that is somewhere else in every frame: a frame has its bounds, and nothing is left broken.

use wobble::scene::gallery;
use wobble::sim::{Command, Cursor, Dynamics, frame_of};

use super::FRAME;

/// Scenes that are too large for it, or made to show what sweeps do.
const LEFT_OUT: [&str; 1] = ["million-cloth"];
/// How long the mouse jumps [s].
const TIME: f64 = 2.0;

/// Numbers in [0, 1) that are the same every time.
fn draw(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

fn extent(world: &dyn Dynamics) -> [[f64; 2]; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 2], [-f64::INFINITY; 2]);
    for x in world.sample(world.time()).position {
        for k in 0..2 {
            (low[k], high[k]) = (low[k].min(x[k]), high[k].max(x[k]));
        }
    }
    [low, high]
}

/// The dearest frame without a hand-over in it [ms of counted work].
fn dearest(world: &mut dyn Dynamics) -> f64 {
    let ([low, high], mut state) = (extent(world), 5);
    let (mut most, mut frame, mut work, mut hand_overs) = (0.0_f64, 0, world.counters().work_ms(), 0);
    while world.time() < TIME - 1e-9 {
        if frame_of(world.time()) != frame || frame == 0 {
            frame = frame_of(world.time());
            let at = [0, 1].map(|k| low[k] + draw(&mut state) * (high[k] - low[k]));
            let by = world.time() + 1.0 / 60.0;
            world.apply(&Command::Cursor { to: Some(Cursor::at(at)), by }).unwrap();
        }
        world.step();
        if frame_of(world.time() + world.substep()) != frame_of(world.time()) {
            let counters = *world.counters();
            if counters.hand_overs == hand_overs {
                most = most.max(counters.work_ms() - work);
            }
            (work, hand_overs) = (counters.work_ms(), counters.hand_overs);
        }
    }
    most
}

#[test]
fn the_gallery_bears_a_mouse_that_jumps() {
    let mut wrong = Vec::new();
    for entry in gallery().iter().filter(|entry| !LEFT_OUT.contains(&entry.name)) {
        let mut world = entry.scene().unwrap().world(None).unwrap();
        let most = dearest(&mut *world);
        if most > FRAME || !world.is_finite() || world.counters().mouse_points == 0 && entry.json.contains("\"mouse\"")
        {
            wrong.push(format!("{}: {most:.2} ms, {:?}", entry.name, world.counters()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
