//! Box2D 3: a body without shapes for each point, a rigid distance joint for each bond.
#![allow(
    unsafe_code,
    reason = "Box2D is a C library; this file and box2d.rs of heaps and rigid have all that is unsafe"
)]

use std::ffi::c_void;
use std::fmt;

use boxdd_sys::ffi;

use crate::peer::{FRAME, Peer, Setting, World};
use crate::scenes::{Bond, Scene};

/// Joints that Box2D can hand to one worker: four blocks, whose sizes are 16 bits wide.
///
/// Past it the sizes wrap, and without assertions most joints then do nothing: points fall freely.
const MOST_JOINTS_A_WORKER: usize = 4 * u16::MAX as usize;
/// More than Box2D lets pass at any number of substeps used here [Hz].
const STIFFEST: f32 = 1e6;

/// Box2D 3 with its distance joints.
pub(crate) struct Box2d;

/// How its joints pull a wrong length right.
#[derive(Clone, Copy)]
pub(crate) struct Stiffness {
    /// Frequency of the correction [Hz]; Box2D takes at most a quarter of the substeps a second.
    hertz: f32,
    /// Damping ratio of the correction.
    damping: f32,
}

impl fmt::Display for Stiffness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.hertz < STIFFEST {
            write!(f, "{} Hz, damping {}", self.hertz, self.damping)
        } else {
            write!(f, "stiffest, damping {}", self.damping)
        }
    }
}

impl Peer for Box2d {
    type Way = Stiffness;

    const NAME: &'static str = "box2d";
    const WAYS: &'static [Stiffness] =
        &[Stiffness { hertz: STIFFEST, damping: 0.0 }, Stiffness { hertz: STIFFEST, damping: 1.0 }];
    const DEFAULT: Setting<Stiffness> = Setting { substeps: 4, way: Stiffness { hertz: 60.0, damping: 2.0 } };

    fn version() -> String {
        // SAFETY: takes and touches nothing.
        let version = unsafe { ffi::b2GetVersion() };
        format!("{}.{}.{}", version.major, version.minor, version.revision)
    }

    fn world(scene: &Scene, setting: Setting<Stiffness>) -> Box<dyn World> {
        let world = create_world(scene.gravity, scene.bonds.len(), |definition| {
            definition.enableSleep = false;
            definition.enableContinuous = false;
        });
        let bodies: Vec<_> = (0..scene.positions.len()).map(|i| create_body(world, scene, i)).collect();
        for bond in &scene.bonds {
            create_joint(world, &bodies, bond, setting.way);
        }
        Box::new(Box2dWorld { world, bodies, substeps: setting.substeps as i32 })
    }
}

/// Owner of one Box2D world.
struct Box2dWorld {
    world: ffi::b2WorldId,
    bodies: Vec<ffi::b2BodyId>,
    substeps: i32,
}

impl World for Box2dWorld {
    fn step(&mut self) {
        // SAFETY: the world lives until this value is dropped, and nothing else steps it meanwhile.
        unsafe { ffi::b2World_Step(self.world, FRAME, self.substeps) }
    }

    fn positions(&self) -> Vec<[f64; 2]> {
        // SAFETY: the bodies live as long as their world, which lives until this value is dropped.
        let position = |&body| unsafe { ffi::b2Body_GetPosition(body) };
        self.bodies.iter().map(position).map(|p| [f64::from(p.x), f64::from(p.y)]).collect()
    }
}

impl Drop for Box2dWorld {
    fn drop(&mut self) {
        // SAFETY: made by `create_world`, destroyed once; its bodies and joints go with it and are not used again.
        unsafe { ffi::b2DestroyWorld(self.world) }
    }
}

/// A world that does all its work on the thread that steps it; `adapt` changes what else Box2D would do by itself.
///
/// Where one worker can't hold the joints it has several, whose tasks are run one after another as they are handed out:
/// Box2D allows that, and lets the first of them do all the work.
pub(crate) fn create_world(gravity: f64, joints: usize, adapt: impl FnOnce(&mut ffi::b2WorldDef)) -> ffi::b2WorldId {
    let workers = joints.div_ceil(MOST_JOINTS_A_WORKER).max(1);
    // SAFETY: the definition comes from Box2D itself; the callbacks keep the contract stated at their definitions.
    unsafe {
        let mut world = ffi::b2DefaultWorldDef();
        world.gravity = ffi::b2Vec2 { x: 0.0, y: -gravity as f32 };
        world.workerCount = workers as i32;
        world.enqueueTask = Some(run_task);
        world.finishTask = Some(finish_task);
        adapt(&mut world);
        ffi::b2CreateWorld(&world)
    }
}

/// Runs a task at once; null says that it is finished.
///
/// # Safety
/// Box2D gives a task together with its context, which lives until the task returns.
unsafe extern "C" fn run_task(task: ffi::b2TaskCallback, context: *mut c_void, _user: *mut c_void) -> *mut c_void {
    if let Some(task) = task {
        // SAFETY: Box2D asks for the task to be called once with this context.
        unsafe { task(context) }
    }
    std::ptr::null_mut()
}

/// Never called: no task outlives [`run_task`]. Box2D takes a task system only whole.
unsafe extern "C" fn finish_task(_task: *mut c_void, _user: *mut c_void) {}

/// The point `i`: no shape, so no collision; mass without inertia, so it never turns; static if pinned.
fn create_body(world: ffi::b2WorldId, scene: &Scene, i: usize) -> ffi::b2BodyId {
    let [x, y] = scene.positions[i].map(|coordinate| coordinate as f32);
    let is_pinned = scene.is_pinned(i);
    let centre = ffi::b2Vec2 { x: 0.0, y: 0.0 };
    let mass = ffi::b2MassData { mass: scene.mass as f32, center: centre, rotationalInertia: 0.0 };
    // SAFETY: the world is alive, the definition comes from Box2D itself and is only read during the call.
    unsafe {
        let mut body = ffi::b2DefaultBodyDef();
        body.type_ = if is_pinned { ffi::b2BodyType_b2_staticBody } else { ffi::b2BodyType_b2_dynamicBody };
        body.position = ffi::b2Pos { x, y };
        body.enableSleep = false;
        let body = ffi::b2CreateBody(world, &body);
        if !is_pinned {
            ffi::b2Body_SetMassData(body, mass);
        }
        body
    }
}

/// A distance joint between the centres of two bodies.
fn create_joint(world: ffi::b2WorldId, bodies: &[ffi::b2BodyId], bond: &Bond, way: Stiffness) {
    // SAFETY: world and bodies are alive, the definition comes from Box2D itself and is only read during the call.
    unsafe {
        let mut joint = ffi::b2DefaultDistanceJointDef();
        joint.base.bodyIdA = bodies[bond.ends[0]];
        joint.base.bodyIdB = bodies[bond.ends[1]];
        joint.length = bond.rest as f32;
        joint.base.constraintHertz = way.hertz;
        joint.base.constraintDampingRatio = way.damping;
        ffi::b2CreateDistanceJoint(world, &joint);
    }
}
