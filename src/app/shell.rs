//! The window and its events: hands them on, and decides when the next frame is.

use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::error::EventLoopError;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::{Window, WindowId};

use super::AppError;
use super::input::{Action, action, is_command};
use super::session::{Opened, Session};
use crate::render::RenderCounters;

/// What the program did when its window closes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Frames made.
    pub frames: u64,
    /// Substeps taken.
    pub substeps: u64,
    /// What drawing took.
    pub drawing: RenderCounters,
}

/// Opens a window on `scene` and runs until it is closed.
///
/// Errors: no display, no GPU, a GPU that is lost and does not come back.
pub(super) fn run(opened: Opened) -> Result<Statistics, AppError> {
    let event_loop = EventLoop::new().map_err(|error| no_display(&error))?;
    let mut shell = Shell::Waiting(Some(Box::new((opened, event_loop.create_proxy()))));
    event_loop.run_app(&mut shell).map_err(|error| no_display(&error))?;
    match shell {
        Shell::Failed(error) => Err(error),
        Shell::Open { session, .. } => {
            let (frames, substeps, drawing) = session.statistics();
            Ok(Statistics { frames, substeps, drawing })
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

/// The program's states.
enum Shell {
    /// Until the system says that windows may be made.
    Waiting(Option<Box<(Opened, EventLoopProxy<()>)>>),
    Open {
        session: Box<Session>,
        /// When the next frame may begin.
        next_frame: Instant,
        /// Least time from frame to frame: a little less than the screen's, which paces by itself where it can.
        interval: Duration,
    },
    Failed(AppError),
}

/// Frames a second where the screen does not tell its own.
const FRAME_RATE: f64 = 60.0;
/// Share of the screen's frame time that must pass: more would miss a frame now and then.
const PATIENCE: f64 = 0.9;

impl Shell {
    fn open(event_loop: &ActiveEventLoop, opened: Opened, waker: EventLoopProxy<()>) -> Result<Self, AppError> {
        let attributes = Window::default_attributes()
            .with_title(format!("wobble · {}", opened.scene.name()))
            .with_inner_size(LogicalSize::new(1100.0, 760.0));
        let window =
            event_loop.create_window(attributes).map_err(|error| AppError::NoWindow { reason: error.to_string() })?;
        let window = Arc::new(window);
        let session = Session::new(Arc::clone(&window), (event_loop.owned_display_handle(), waker), opened)?;
        let rate = window.current_monitor().and_then(|monitor| monitor.refresh_rate_millihertz());
        let rate = rate.map_or(FRAME_RATE, |millihertz| f64::from(millihertz) / 1000.0).clamp(24.0, 1000.0);
        let interval = Duration::from_secs_f64(PATIENCE / rate);
        Ok(Shell::Open { session: Box::new(session), next_frame: Instant::now(), interval })
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, error: AppError) {
        *self = Shell::Failed(error);
        event_loop.exit();
    }

    /// Draws a frame now.
    fn redraw(&mut self, event_loop: &ActiveEventLoop) {
        let Shell::Open { session, next_frame, interval } = self else { return };
        *next_frame = Instant::now() + *interval;
        if let Err(error) = session.frame() {
            self.fail(event_loop, error.into());
        }
    }
}

impl ApplicationHandler for Shell {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let Shell::Waiting(start) = self else { return };
        let Some(opened) = start.take() else { return };
        let (opened, waker) = *opened;
        match Shell::open(event_loop, opened, waker) {
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
        let response = session.panels.on_window_event(&session.window, &event);
        if response.repaint {
            session.touch();
        }
        match event {
            WindowEvent::CloseRequested | WindowEvent::Destroyed => event_loop.exit(),
            WindowEvent::DroppedFile(path) => session.take_file(&path),
            WindowEvent::Resized(size) => session.resize([size.width, size.height]),
            WindowEvent::ScaleFactorChanged { scale_factor, .. } => session.rescale(scale_factor),
            WindowEvent::KeyboardInput { event, .. } if event.state.is_pressed() && !response.consumed => {
                match action(&event.logical_key, session.holds_command) {
                    Some(Action::Quit) if session.dismiss() => {}
                    Some(Action::Quit) => event_loop.exit(),
                    // A key held down steps on and on, but does not flicker between play and pause.
                    Some(action) if !event.repeat || action == Action::Step => session.act(action),
                    _ => {}
                }
            }
            WindowEvent::ModifiersChanged(held) => session.holds_command = is_command(held.state()),
            WindowEvent::CursorMoved { position, .. } => {
                if session.pointer.move_to([position.x, position.y], &mut session.camera) {
                    session.touch();
                }
                session.move_cursor();
            }
            WindowEvent::CursorLeft { .. } => {
                session.pointer.leave();
                session.move_cursor();
            }
            WindowEvent::MouseInput { state, button, .. } if !response.consumed || !state.is_pressed() => {
                session.pointer.press(button, state);
                session.move_cursor();
            }
            WindowEvent::MouseWheel { delta, .. } if !response.consumed => {
                session.pointer.scroll(delta, &mut session.camera);
                session.touch();
                session.move_cursor();
            }
            _ => {}
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let Shell::Open { session, next_frame, .. } = self else { return };
        let now = Instant::now();
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
