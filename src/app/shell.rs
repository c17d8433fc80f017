//! The window and its events: hands them on, and decides when the next frame is.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::error::EventLoopError;
use winit::event::{ElementState, KeyEvent, StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::{Window, WindowId};

use super::AppError;
use super::action::{Action, Tool};
use super::gone::unless_gone;
use super::keys::{self, Held};
use super::leftovers::{state_folder, title};
use super::player::{Keeping, Player};
use super::session::Session;
use crate::history::Start;
use crate::render::RenderCounters;

/// What the program did when its window closes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Frames made.
    pub frames: u64,
    /// Frames' times that the worlds were asked to pass.
    pub advances: u64,
    /// Substeps taken.
    pub substeps: u64,
    /// What drawing took.
    pub drawing: RenderCounters,
}

/// Opens a window on a scene or a recording and runs until it is closed.
///
/// Errors: no display, a scene that cannot be run, no GPU, a GPU that is lost and does not come back, a window that is taken away.
pub(super) fn run(asked: Asked) -> Result<Statistics, AppError> {
    let event_loop = EventLoop::new().map_err(|error| no_display(&error))?;
    let mut shell = Shell::Waiting(Some(Box::new((asked, event_loop.create_proxy()))));
    let Some(done) = unless_gone(|| event_loop.run_app(&mut shell)) else {
        // What was done is kept as it is when the program is cut off.
        if let Shell::Open { session, .. } = shell {
            session.leave();
        }
        return Err(AppError::WindowGone);
    };
    done.map_err(|error| no_display(&error))?;
    match shell {
        Shell::Failed(error) => Err(error),
        Shell::Open { mut session, .. } => {
            session.end()?;
            let ([frames, advances, substeps], drawing) = session.statistics();
            Ok(Statistics { frames, advances, substeps, drawing })
        }
        Shell::Waiting(_) => Ok(Statistics::default()),
    }
}

/// What the system said, without the line of the library that heard it.
fn no_display(error: &EventLoopError) -> AppError {
    let said = error.to_string();
    let reason = said.split_once(".rs:").and_then(|(_, rest)| rest.split_once(": ")).map_or(&*said, |(_, why)| why);
    AppError::NoDisplay { reason: reason.trim_end_matches(['.', ')']).to_owned() }
}

/// What the program begins with.
pub(super) struct Asked {
    pub(super) start: Start,
    /// The file that it was read from.
    pub(super) file: Option<PathBuf>,
    /// A picture that opens as a scene when it is read.
    pub(super) picture: Option<PathBuf>,
    /// What the session is recorded to.
    pub(super) record: Option<PathBuf>,
}

/// The program's states.
enum Shell {
    /// Until the system says that windows may be made; with what wakes the loop.
    Waiting(Option<Box<(Asked, EventLoopProxy<()>)>>),
    Open {
        session: Box<Session>,
        /// When the next frame may begin.
        next_frame: Instant,
        /// Least time from frame to frame: a little less than the screen's, which paces by itself where it can.
        interval: Duration,
        /// Nothing of the window can be seen: it is minimised, not mapped, or lies behind others.
        is_hidden: bool,
    },
    Failed(AppError),
}

/// Frames a second where the screen does not tell its own.
const FRAME_RATE: f64 = 60.0;
/// Share of the screen's frame time that must pass: more would miss a frame now and then.
const PATIENCE: f64 = 0.9;
/// Size of a window where there is room `[logical px]`, its share of the screen where there is not, and the least that it can have.
const SIZE: [f64; 2] = [1180.0, 800.0];
const SHARE: [f64; 2] = [0.92, 0.84];
const LEAST: [f64; 2] = [480.0, 360.0];
/// A scene that is made sooner than this needs no window to wait in.
const QUICK: Duration = Duration::from_millis(300);
/// How often it is looked whether a hidden window can be seen again: not all systems tell.
const LOOK_AGAIN: Duration = Duration::from_millis(250);

/// The size of a window on a screen of this size `[logical px]`.
fn size_on(screen: Option<[f64; 2]>) -> [f64; 2] {
    let Some(screen) = screen else { return SIZE };
    std::array::from_fn(|k| SIZE[k].min(SHARE[k] * screen[k]).max(LEAST[k].min(screen[k])))
}

impl Shell {
    fn open(event_loop: &ActiveEventLoop, (asked, waker): (Asked, EventLoopProxy<()>)) -> Result<Self, AppError> {
        let Asked { start, file, picture, record } = asked;
        let scene = Arc::new(start.scene().clone());
        let proxy = waker.clone();
        // A window that has been closed is woken no more.
        let state_folder = state_folder();
        // What a picture is made into is what is recorded.
        let (now, later) = if picture.is_some() { (None, record) } else { (record, None) };
        let keeping = Keeping { folder: state_folder.clone(), record: now, heir_of: None };
        let mut player = Player::open(start, keeping, move || proxy.send_event(()).unwrap_or_default());
        let news = player.wait_until_open(QUICK);
        if let Some(failure) = news.failure {
            return Err(failure.into());
        }
        let monitor = event_loop.primary_monitor().or_else(|| event_loop.available_monitors().next());
        let screen = monitor.map(|monitor| monitor.size().to_logical::<f64>(monitor.scale_factor()));
        let [width, height] = size_on(screen.map(|size| [size.width, size.height]));
        let attributes = Window::default_attributes()
            .with_title(format!("wobble · {}", title(player.start())))
            .with_min_inner_size(LogicalSize::new(LEAST[0].min(width), LEAST[1].min(height)))
            .with_inner_size(LogicalSize::new(width, height));
        let window =
            event_loop.create_window(attributes).map_err(|error| AppError::NoWindow { reason: error.to_string() })?;
        let window = Arc::new(window);
        let display = event_loop.owned_display_handle();
        let mut session = Session::new(Arc::clone(&window), (display, waker), (player, scene))?;
        session.keep_in(state_folder, later);
        if let Some(path) = file {
            session.have_come_from(&path);
        }
        if let Some(path) = picture {
            session.load(&path);
        }
        let rate = window.current_monitor().and_then(|monitor| monitor.refresh_rate_millihertz());
        let rate = rate.map_or(FRAME_RATE, |millihertz| f64::from(millihertz) / 1000.0).clamp(24.0, 1000.0);
        let interval = Duration::from_secs_f64(PATIENCE / rate);
        Ok(Shell::Open { session: Box::new(session), next_frame: Instant::now(), interval, is_hidden: false })
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, error: AppError) {
        if let Shell::Open { session, .. } = self {
            session.leave();
        }
        *self = Shell::Failed(error);
        event_loop.exit();
    }

    /// Draws a frame now, if anything of it can be seen.
    fn redraw(&mut self, event_loop: &ActiveEventLoop) {
        let Shell::Open { session, next_frame, interval, is_hidden } = self else { return };
        *next_frame = Instant::now() + *interval;
        *is_hidden = is_out_of_sight(session);
        if *is_hidden {
            return session.rest();
        }
        if let Err(error) = session.frame() {
            return self.fail(event_loop, error.into());
        }
        if let Some(failure) = session.take_failure() {
            self.fail(event_loop, failure.into());
        }
    }
}

/// Whether nothing of the window can be seen.
fn is_out_of_sight(session: &Session) -> bool {
    let window = &session.window;
    session.is_occluded
        || session.has_no_size()
        || window.is_minimized() == Some(true)
        || window.is_visible() == Some(false)
}

/// A key went down or up.
fn press_key(session: &mut Session, event: &KeyEvent, event_loop: &ActiveEventLoop) {
    if session.drive(event) {
        return;
    }
    if event.state == ElementState::Released {
        return session.down.release(event.physical_key).into_iter().for_each(|action| session.let_go_of(action));
    }
    let Some(action) = keys::action(&event.logical_key, session.held) else { return };
    // Keys with Ctrl are the field's own there.
    if !session.keyboard().lets(action) {
        return;
    }
    if session.closes_lines(action) {
        return;
    }
    if session.is_covered() && !session.lets_through(action) {
        return;
    }
    match action {
        // A key that is held does not answer what it is asked.
        Action::Quit if !event.repeat && session.may_leave(true) => event_loop.exit(),
        Action::Quit => {}
        Action::Take(Tool::Build) if session.builds() && event.repeat => {}
        Action::Take(Tool::Build) if session.builds() => session.build_next(),
        // A key held down steps on and on, but does not flicker between play and pause.
        action if !event.repeat || action.repeats() => {
            session.down.press(event.physical_key, action);
            session.act(action);
        }
        _ => {}
    }
}

impl ApplicationHandler for Shell {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let Shell::Waiting(start) = self else { return };
        let Some(start) = start.take() else { return };
        match Shell::open(event_loop, *start) {
            Ok(open) => *self = open,
            Err(error) => self.fail(event_loop, error),
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, _: StartCause) {}

    fn user_event(&mut self, _: &ActiveEventLoop, (): ()) {
        if let Shell::Open { session, .. } = self {
            session.wake();
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if matches!(event, WindowEvent::RedrawRequested) {
            return self.redraw(event_loop);
        }
        let Shell::Open { session, .. } = self else { return };
        session.tell_panels(&event);
        match event {
            WindowEvent::CloseRequested if !session.may_leave(false) => {}
            WindowEvent::CloseRequested | WindowEvent::Destroyed => event_loop.exit(),
            WindowEvent::DroppedFile(path) => session.take_file(&path),
            WindowEvent::Resized(size) => session.resize([size.width, size.height]),
            WindowEvent::ScaleFactorChanged { scale_factor, .. } => session.rescale(scale_factor),
            WindowEvent::Occluded(is_occluded) => {
                session.is_occluded = is_occluded;
                session.touch();
            }
            WindowEvent::Focused(false) => session.lose_focus(),
            WindowEvent::KeyboardInput { event, is_synthetic: false, .. } => press_key(session, &event, event_loop),
            WindowEvent::ModifiersChanged(held) => session.hold(Held::of(held.state())),
            WindowEvent::CursorMoved { position, .. } => session.point_at([position.x, position.y]),
            WindowEvent::CursorLeft { .. } => session.point_away(),
            WindowEvent::MouseInput { state, button, .. } => session.press(button, state),
            WindowEvent::MouseWheel { delta, .. } => session.scroll(delta),
            _ => {}
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let Shell::Open { session, next_frame, is_hidden, .. } = self else { return };
        if session.leaves() {
            return event_loop.exit();
        }
        let now = Instant::now();
        if *is_hidden {
            // Something may have happened that shows it.
            *is_hidden = is_out_of_sight(session);
        }
        if *is_hidden {
            return match session.wants_frame() {
                true => event_loop.set_control_flow(ControlFlow::WaitUntil(now + LOOK_AGAIN)),
                false => event_loop.set_control_flow(ControlFlow::Wait),
            };
        }
        let due = match (session.wants_frame(), session.panels_due()) {
            (true, _) => Some(*next_frame),
            (false, panels) => panels.map(|due| due.max(*next_frame)),
        };
        match due {
            Some(due) if due <= now => session.window.request_redraw(),
            Some(due) => return event_loop.set_control_flow(ControlFlow::WaitUntil(due)),
            None => {}
        }
        event_loop.set_control_flow(ControlFlow::Wait);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_fits_its_screen() {
        assert_eq!(size_on(None), SIZE);
        assert_eq!(size_on(Some([2560.0, 1440.0])), SIZE);
        let [width, height] = size_on(Some([1280.0, 720.0]));
        assert!(width <= 1280.0 && height <= 0.85 * 720.0, "room for a bar and a title");
        let [width, height] = size_on(Some([800.0, 500.0]));
        assert!(width <= 800.0 && height <= 500.0);
        assert_eq!(size_on(Some([320.0, 200.0])), [320.0, 200.0]);
    }
}
