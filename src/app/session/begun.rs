//! How a session begins, before there is anything to see.

use std::sync::Arc;

use winit::event_loop::{EventLoopProxy, OwnedDisplayHandle};
use winit::window::{CursorIcon, Window};

use super::{Framing, LEAST_PIN, Leaving, Lost, Session, Shelf};
use crate::app::aside::Unwanted;
use crate::app::canvas::{Canvas, Paint};
use crate::app::keys::{Down, Held};
use crate::app::meter::Meter;
use crate::app::opening::{Followed, Over};
use crate::app::panels::{PanelState, listen, theme};
use crate::app::player::{Figures, Player};
use crate::app::pointer::Pointer;
use crate::app::recent::Recent;
use crate::app::tools::{Chosen, Hand, Stalls};
use crate::app::trailing::{TrailSettings, Trailing};
use crate::app::whereabouts::Whereabouts;
use crate::render::{Camera, Look, Palette, RenderError, Tiles, Trails};
use crate::scene::Scene;
use crate::sim::SceneChange;

impl Session {
    /// Shows what `player` plays, in `window`.
    ///
    /// Errors: no GPU that can draw to the window.
    pub(in crate::app) fn new(
        window: Arc<Window>,
        (display, waker): (OwnedDisplayHandle, EventLoopProxy<()>),
        (player, scene): (Player, Arc<Scene>),
    ) -> Result<Self, RenderError> {
        let canvas = Canvas::new(Arc::clone(&window), display.clone(), scene.dimensions())?;
        let size = canvas.size();
        let egui = panels_for(&window, &canvas, Palette::default());
        let mut session = Session {
            // Until the scene is there.
            camera: Camera::fit([[-1.0; 3], [1.0; 3]], scene.dimensions(), size),
            framing: Framing::Opening,
            framed: Default::default(),
            tiles: Tiles::ALONE,
            cell: 0,
            tints_distance: false,
            beside_trails: Vec::new(),
            misfits: Default::default(),
            most_apart: 0.0,
            difference_most: 1.0,
            area: size,
            free: [[0.0; 2], size.map(f64::from)],
            titles: 0.0,
            undocked: None,
            ways: Default::default(),
            over: Over::default(),
            covered: Vec::new(),
            laid_anew: 0,
            trails: Trails::new(TrailSettings::default().length),
            trailing: Trailing::default(),
            whereabouts: Whereabouts::default(),
            look: Look { scale_factor: window.scale_factor() as f32, least_pin: LEAST_PIN, ..Look::default() },
            palette: Palette::default(),
            has_picture: false,
            window,
            egui,
            display,
            canvas,
            player,
            shelf: Shelf::default(),
            scene,
            place: None,
            named: Vec::new(),
            pointer: Pointer::default(),
            hand: Hand::default(),
            held: Held::default(),
            down: Down::default(),
            driving: Vec::new(),
            stalls: Stalls::default(),
            pins_since: None,
            follows: false,
            followed: Followed::default(),
            rewinds: false,
            gone_by: None,
            pushes: false,
            inspected: Chosen::default(),
            is_put: false,
            copied: None,
            duplicated: None,
            cursor_icon: CursorIcon::Default,
            base: None,
            panels: PanelState::default(),
            paint: Paint::default(),
            marked_words: String::new(),
            labels_at: Vec::new(),
            lost: Lost::default(),
            dirty: true,
            panels_dirty: true,
            panels_due: None,
            panels_at: None,
            was_over_panels: false,
            was_near_panels: false,
            wants_hint: true,
            is_occluded: false,
            failure: None,
            import: None,
            kept: None,
            loading: None,
            adding: None,
            asked: None,
            leaving: Leaving::Not,
            told_of: Vec::new(),
            dialog: None,
            wearer: None,
            pasted: None,
            saving: None,
            filming: None,
            recent: Recent::default(),
            state_folder: None,
            record: None,
            search: None,
            unread: Vec::new(),
            leftovers: Vec::new(),
            thumbnails: None,
            cut_off: None,
            unwanted: Unwanted::default(),
            waker,
            last_frame: None,
            told: None,
            resting: Default::default(),
            pressed_at: None,
            frame_meter: Meter::default(),
            frames: 0,
            looks_again: None,
            came: None,
            stands_in: false,
            opening_since: None,
            teaches: None,
            taught: None,
            figures: Figures::default(),
            settings: SceneChange::default(),
            matter: None,
            turned: Default::default(),
            bearings: Default::default(),
            overload: None,
            painted: Default::default(),
            tints: Arc::default(),
        };
        match session.player.is_open() {
            true => session.arrive(Arc::clone(&session.scene)),
            false => session.await_it(),
        }
        Ok(session)
    }
}

/// A context for the panels of a window.
pub(super) fn panels_for(window: &Arc<Window>, canvas: &Canvas, palette: Palette) -> egui_winit::State {
    let context = egui::Context::default();
    theme::apply(&context, palette);
    listen(&context);
    let scale = Some(window.scale_factor() as f32);
    let side = Some(canvas.largest_side() as usize);
    egui_winit::State::new(context, egui::ViewportId::ROOT, &**window, scale, None, side)
}
