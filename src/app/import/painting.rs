//! The brush canvas: a mask that is painted by hand, and its tools.

use egui::{Color32, Pos2, Rect, Response, Slider, Stroke};

use crate::picture::{Brush, Mask, Mirror, Picture, PictureError};

/// Side of an empty canvas [px].
const SIDE: u32 = 512;
/// Colour of the ink: that of the drawn body.
const INK: [u8; 3] = [242, 150, 84];

/// What the pointer does to the canvas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tool {
    Paint,
    Erase,
    Fill,
}

/// A canvas that is being painted on.
pub(super) struct Painting {
    mask: Mask,
    tool: Tool,
    /// Radius of the brush [px].
    radius: f64,
    /// A stroke is being drawn.
    is_down: bool,
    /// The version of the mask that was last handed out.
    seen: u64,
}

impl Painting {
    /// An empty canvas, or one of a picture.
    ///
    /// Errors: a picture too large for it.
    pub(super) fn new(on: Option<&Picture>) -> Result<Self, PictureError> {
        let mask = on.map_or_else(|| Mask::new(SIDE, SIDE), Mask::from_picture)?;
        let seen = mask.version();
        Ok(Painting { mask, tool: Tool::Paint, radius: 16.0, is_down: false, seen })
    }

    /// What is painted, on clear ground.
    pub(super) fn picture(&self) -> Picture {
        self.mask.to_picture(INK)
    }

    /// The same, if it has changed since the last call.
    pub(super) fn take_changed(&mut self) -> Option<Picture> {
        (self.mask.version() != self.seen).then(|| {
            self.seen = self.mask.version();
            self.picture()
        })
    }

    /// The tools, in two rows.
    pub(super) fn tools(&mut self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            for (tool, label) in [(Tool::Paint, "Paint"), (Tool::Erase, "Erase"), (Tool::Fill, "Fill")] {
                ui.selectable_value(&mut self.tool, tool, label);
            }
            ui.separator();
            if ui.add_enabled(self.mask.can_undo(), egui::Button::new("Undo")).clicked() {
                self.mask.undo();
            }
            if ui.add_enabled(self.mask.can_redo(), egui::Button::new("Redo")).clicked() {
                self.mask.redo();
            }
            if ui.button("Clear").clicked() {
                self.mask.clear();
            }
            if ui.button("Invert").clicked() {
                self.mask.invert();
            }
        });
        ui.horizontal(|ui| {
            ui.add(Slider::new(&mut self.radius, 1.0..=128.0).logarithmic(true).suffix(" px").text("brush"));
            ui.separator();
            ui.label("mirror");
            let mirrors = [
                (Mirror::None, "no"),
                (Mirror::Vertical, "across"),
                (Mirror::Horizontal, "down"),
                (Mirror::Both, "both"),
            ];
            for (mirror, label) in mirrors {
                ui.selectable_value(&mut self.mask.mirror, mirror, label);
            }
        });
    }

    /// The pointer on the canvas, which lies at `place` on the screen.
    pub(super) fn paint(&mut self, response: &Response, place: Rect) {
        let scale = f64::from(place.width()) / f64::from(self.mask.size()[0]);
        let at = |screen: Pos2| [screen.x - place.min.x, screen.y - place.min.y].map(|x| f64::from(x) / scale);
        let brush = Brush { radius: self.radius, erases: self.tool == Tool::Erase };
        let Some(at) = response.interact_pointer_pos().map(at) else { return self.lift() };
        if self.tool == Tool::Fill {
            if response.clicked() {
                self.mask.fill(brush, at);
            }
            return;
        }
        match (response.is_pointer_button_down_on(), self.is_down) {
            (true, false) => self.mask.begin(brush, at),
            (true, true) => self.mask.drag_to(at),
            (false, _) => return self.lift(),
        }
        self.is_down = true;
    }

    /// Ends the stroke, if there is one.
    fn lift(&mut self) {
        if std::mem::take(&mut self.is_down) {
            self.mask.end();
        }
    }

    /// The brush's outline at the pointer.
    pub(super) fn outline(&self, painter: &egui::Painter, response: &Response, place: Rect) {
        let scale = place.width() / self.mask.size()[0] as f32;
        if let Some(at) = response.hover_pos().filter(|_| self.tool != Tool::Fill) {
            painter.circle_stroke(at, self.radius as f32 * scale, Stroke::new(1.2, Color32::WHITE));
        }
    }
}
