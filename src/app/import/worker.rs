//! Meshes a picture beside the window: the newest wish wins, what was asked before and not begun is skipped.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Instant;

use super::Wish;
use crate::picture::{Picture, PictureMesh, Watch};
use crate::scene::{Matter, Scene, SceneError, Vector};
use crate::sim::Dynamics;

/// What a wish comes to.
pub(super) struct Forecast {
    /// What was wished for, and of which picture.
    pub(super) wish: Wish,
    pub(super) picture: Arc<Picture>,
    pub(super) mesh: Arc<PictureMesh>,
    /// Bonds of the body.
    pub(super) bonds: usize,
    /// The scene that the body falls into by itself: its mesh is made.
    pub(super) scene: Scene,
    /// Outlines and corners of the obstacle that it becomes; none of a body.
    pub(super) outlines: usize,
    pub(super) corners: usize,
    /// Time that a frame of the body takes by counted work, falling freely, and as it lands `[s]`.
    pub(super) frames: [f64; 2],
}

/// A thread that meshes pictures.
pub(super) struct Worker {
    wishes: Sender<(Arc<Picture>, Wish, Watch)>,
    forecasts: Receiver<Result<Forecast, String>>,
    /// Of the newest wish, until it is answered: how far it is, and when it was asked for.
    pub(super) at_work: Option<(Watch, Instant)>,
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.at_work.iter().for_each(|(watch, _)| watch.stop());
    }
}

/// Most points of a body that is made in a window: more would stand still there.
const MOST_POINTS: u64 = 100_000;

/// A frame `[s]`, and how many are tried.
const FRAME: f64 = 1.0 / 60.0;
const FRAMES: u32 = 3;

impl Worker {
    /// One for a picture of this name; it calls `wake` when it has an answer.
    pub(super) fn new(name: String, wake: impl Fn() + Send + 'static) -> Self {
        let (wishes, asked) = channel();
        let (answers, forecasts) = channel();
        std::thread::spawn(move || {
            while let Ok(first) = asked.recv() {
                let (picture, wish, watch) = asked.try_iter().last().unwrap_or(first);
                let made = forecast(&name, &picture, wish, &watch);
                if watch.is_stopped() {
                    continue;
                }
                if answers.send(made).is_err() {
                    return;
                }
                wake();
            }
        });
        Worker { wishes, forecasts, at_work: None }
    }

    /// Asks for a mesh; one that is under way is given up. A worker that has gone answers no more.
    pub(super) fn ask(&mut self, picture: &Arc<Picture>, wish: Wish) {
        let watch = Watch::default().with_most_points(MOST_POINTS);
        let _ = self.wishes.send((Arc::clone(picture), wish, watch.clone()));
        if let Some((old, _)) = self.at_work.replace((watch, Instant::now())) {
            old.stop();
        }
    }

    /// The newest answer since the last call.
    pub(super) fn take(&mut self) -> Option<Result<Forecast, String>> {
        let made = self.forecasts.try_iter().last()?;
        self.at_work = None;
        Some(made)
    }
}

/// The middle one of a few frames, by counted work, which no other program on the machine is a part of `[s]`.
fn frame_time(mut world: Box<dyn Dynamics>) -> f64 {
    let frame = |_| {
        let (work, end) = (world.counters().work_ms(), world.time() + FRAME * (1.0 - 1e-9));
        while world.time() < end {
            world.step();
        }
        1e-3 * (world.counters().work_ms() - work)
    };
    let mut times: Vec<f64> = (0..FRAMES).map(frame).collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// The scene as its bodies land: on the floor, as fast as the fall to it makes them, or one from their own height. `None` where there is no floor.
fn landing(scene: &Scene, start: &dyn Dynamics) -> Option<Scene> {
    let floor = scene.bounds.as_ref()?.min.embed()[1];
    let positions = start.positions();
    let heights = || (0..start.point_count()).map(|i| positions.get(2 * i + 1));
    let (lowest, highest) = (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
    let drop = lowest - floor;
    let gravity = scene.gravity.map_or(0.0, |gravity| -gravity.embed()[1]);
    // It will be lifted and let go.
    let speed = (2.0 * gravity * drop.max(highest - lowest)).max(0.0).sqrt();
    let mut landing = scene.clone();
    for body in &mut landing.bodies {
        let [x, y, _] = body.origin.map_or([0.0; 3], |origin| origin.embed());
        body.origin = Some(Vector::Plane([x, y - drop]));
        body.velocity = Some(Vector::Plane([0.0, -speed]));
    }
    Some(landing)
}

/// Errors: the line that the panel shows.
fn forecast(name: &str, picture: &Arc<Picture>, wish: Wish, watch: &Watch) -> Result<Forecast, String> {
    let said = |error: SceneError| error.message;
    let scene = wish.scene(name, picture, watch).map_err(said)?;
    let mesh = match wish.matter {
        Matter::Fixed => Wish { matter: Matter::Soft, of: None, apart: false, ..wish }.scene(name, picture, watch),
        _ => Ok(scene.clone()),
    };
    let mesh = mesh.and_then(|scene| scene.picture_mesh(0)).map_err(said)?;
    let world = scene.world(None).map_err(said)?;
    let bonds = world.bonds().len();
    let loops = || world.polygons().iter().flat_map(|polygon| &polygon.loops);
    let (outlines, corners) = (loops().count(), loops().map(Vec::len).sum());
    let landed = landing(&scene, &*world).and_then(|landing| landing.world(None).ok()).map(frame_time);
    let falling = frame_time(world);
    let frames = [falling, landed.unwrap_or(falling)];
    Ok(Forecast { wish, picture: Arc::clone(picture), mesh, bonds, outlines, corners, scene, frames })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Settings, Size};
    use crate::scene::PatternName;
    use std::sync::atomic::{AtomicU32, Ordering};

    #[test]
    fn the_newest_wish_is_answered_last() {
        let mut picture = Picture::filled(64, 64, [0; 4]);
        for i in 0..64 * 64 {
            let [x, y] = [i % 64, i / 64].map(|at| at as f64 - 31.5);
            picture.rgba[4 * i + 3] = if x.hypot(y) < 28.0 { 255 } else { 0 };
        }
        static WOKEN: AtomicU32 = AtomicU32::new(0);
        let picture = Arc::new(picture);
        let mut worker = Worker::new("disc".to_owned(), || {
            WOKEN.fetch_add(1, Ordering::Relaxed);
        });
        let wish = |spacing| Wish {
            settings: Settings { size: Size::Spacing(spacing), ..Settings::default() },
            matter: Matter::Soft,
            of: None,
            young: 1e3,
            height: 1.0,
            pattern: PatternName::Edges,
            apart: false,
        };
        for spacing in [16.0, 12.0, 8.0, 4.0] {
            worker.ask(&picture, wish(spacing));
        }
        let mut last = None;
        for _ in 0..1_000 {
            std::thread::sleep(std::time::Duration::from_millis(5));
            last = worker.take().or(last);
            if last.as_ref().is_some_and(|made| made.as_ref().is_ok_and(|made| made.mesh.points.len() > 150)) {
                break;
            }
        }
        let Some(Ok(forecast)) = last else { panic!("no mesh") };
        assert!(forecast.mesh.points.len() > 150 && forecast.frames.iter().all(|&frame| frame > 0.0));
        let of_scene = forecast.scene.picture_mesh(0);
        assert!(of_scene.is_ok_and(|mesh| Arc::ptr_eq(&mesh, &forecast.mesh)), "what is shown was made once");
        assert!(WOKEN.load(Ordering::Relaxed) >= 1);
        let again = forecast.scene.world(None).map(frame_time);
        assert_eq!(again.ok(), Some(forecast.frames[0]), "however busy the machine is");
        let lands = forecast.scene.world(None).ok().and_then(|start| landing(&forecast.scene, &*start));
        let Some(landing) = lands.and_then(|scene| scene.world(None).ok()) else { panic!("no landing") };
        let floor = forecast.scene.bounds.as_ref().map_or(f64::NAN, |bounds| bounds.min.embed()[1]);
        let start = landing.sample(0.0);
        let lowest = start.position.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
        assert!((lowest - floor).abs() < 1e-9 && start.velocity[0][1] < -1.0, "{lowest}, {:?}", start.velocity[0]);
        worker.ask(&picture, wish(0.1));
        let refused = loop {
            if let Some(answer) = worker.take() {
                break answer;
            }
        };
        assert!(refused.is_err_and(|error| error.contains("spacing")));
    }
}
