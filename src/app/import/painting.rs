//! The brush canvas: a mask that is painted by hand, and its tools.

use egui::{Color32, ColorImage, Pos2, Rect, Response, Slider, Stroke, TextureHandle, TextureId, TextureOptions};

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
    /// The canvas as it is shown.
    texture: Option<TextureHandle>,
}

impl Painting {
    /// An empty canvas, or one of a picture.
    ///
    /// Errors: a picture too large for it.
    pub(super) fn new(on: Option<&Picture>) -> Result<Self, PictureError> {
        let mask = on.map_or_else(|| Mask::new(SIDE, SIDE), Mask::from_picture)?;
        let seen = mask.version();
        Ok(Painting { mask, tool: Tool::Paint, radius: 16.0, is_down: false, seen, texture: None })
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

    /// The canvas as it is to be shown: what changed of it since the last call is uploaded, and no more.
    pub(super) fn texture(&mut self, context: &egui::Context) -> TextureId {
        let changed = self.mask.changed();
        let whole = self.mask.size();
        let texture = match &mut self.texture {
            Some(texture) => {
                if let Some([left, top, width, height]) = changed {
                    let place = [left as usize, top as usize];
                    texture.set_partial(place, image(&self.mask, [left, top, width, height]), TextureOptions::LINEAR);
                }
                texture
            }
            empty => empty.insert(context.load_texture(
                "canvas",
                image(&self.mask, [0, 0, whole[0], whole[1]]),
                TextureOptions::LINEAR,
            )),
        };
        texture.id()
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

/// A rectangle of the canvas [px]: left, top, width, height.
fn image(mask: &Mask, [left, top, width, height]: [u32; 4]) -> ColorImage {
    let [left, top, width, height] = [left, top, width, height].map(|length| length as usize);
    let shades: Vec<Color32> =
        (0..=255).map(|alpha| Color32::from_rgba_unmultiplied(INK[0], INK[1], INK[2], alpha)).collect();
    let rows = mask.coverage().chunks_exact(mask.size()[0] as usize).skip(top).take(height);
    let pixels = rows.flat_map(|row| &row[left..left + width]).map(|&alpha| shades[usize::from(alpha)]).collect();
    ColorImage::new([width, height], pixels)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    /// Left, top, width and height of each piece that is uploaded of the canvas.
    fn uploads(context: &egui::Context, painting: &mut Painting) -> Vec<[usize; 4]> {
        let mut canvas = None;
        let mut output = context.run_ui(egui::RawInput::default(), |ui| canvas = Some(painting.texture(ui.ctx())));
        let pieces = output.textures_delta.set.get(&canvas.unwrap()).into_iter().flatten();
        let uploads = pieces.map(|piece| {
            let [left, top] = piece.pos.unwrap_or([usize::MAX; 2]);
            let [width, height] = piece.image.size();
            [left, top, width, height]
        });
        let uploads = uploads.collect();
        // Pieces that nobody uploads must be given up in so many words.
        output.textures_delta.clear();
        uploads
    }

    #[test]
    fn a_stroke_uploads_what_it_changed_and_no_more() {
        let context = egui::Context::default();
        let mut painting = Painting::new(None).unwrap();
        assert_eq!(uploads(&context, &mut painting), [[usize::MAX, usize::MAX, 512, 512]], "all of it at first");
        assert!(uploads(&context, &mut painting).is_empty(), "nothing has changed");
        painting.mask.begin(Brush { radius: 10.0, erases: false }, [100.0, 200.0]);
        painting.mask.drag_to([150.0, 200.0]);
        let pieces = uploads(&context, &mut painting);
        let [left, top, width, height] = pieces[0];
        assert_eq!(pieces.len(), 1);
        assert!((88..=90).contains(&left) && (188..=190).contains(&top), "{pieces:?}");
        assert!((70..=74).contains(&width) && (20..=24).contains(&height), "{pieces:?}");
        let shown = image(&painting.mask, [100, 195, 3, 2]);
        assert_eq!((shown.size, shown.pixels[0]), ([3, 2], Color32::from_rgb(INK[0], INK[1], INK[2])));
        assert_eq!(image(&painting.mask, [0, 0, 2, 2]).pixels, [Color32::TRANSPARENT; 4]);
    }
}
