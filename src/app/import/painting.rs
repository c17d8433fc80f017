//! The brush canvas: a mask that is painted by hand, and its tools.

use egui::{Color32, ColorImage, Event, Key, Modifiers, PointerButton, Pos2, Rect, Response, Slider, Stroke};
use egui::{TextureHandle, TextureId, TextureOptions};

use crate::app::panels::{color, ranged};
use crate::picture::{Brush, Mask, Mirror, Picture, PictureError};

/// Side of an empty canvas `[px]`.
const SIDE: u32 = 512;
/// Colour of the ink where no matter by name says another: that of the drawn body.
pub(super) const INK: [u8; 3] = [242, 150, 84];

/// Coverage of a pixel from which on it is painted.
const HALF: u8 = 127;

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
    /// What it was at first: the picture that is painted over, with the coverage of its pixels.
    under: Option<(Picture, Vec<u8>)>,
    tool: Tool,
    /// Radius of the brush `[px]`.
    radius: f64,
    /// The colour that is painted with; `None`: that of the body's matter.
    color: Option<[u8; 3]>,
    /// What the numbers of inks stand for, the colour of the matter first.
    inks: Vec<[u8; 3]>,
    /// That one is another since the picture was handed out.
    is_recolored: bool,
    /// A stroke is being drawn.
    is_down: bool,
    /// The version of the mask that was last handed out.
    seen: u64,
    /// Where it was on the screen when it was shown last.
    place: Rect,
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
        Ok(Painting {
            under: on.map(|picture| (picture.clone(), mask.coverage().to_vec())),
            mask,
            tool: Tool::Paint,
            radius: 16.0,
            color: None,
            inks: vec![INK],
            is_recolored: false,
            is_down: false,
            seen,
            place: Rect::NOTHING,
            texture: None,
        })
    }

    /// What is painted, on clear ground: what was there before in its own colours.
    pub(super) fn picture(&self) -> Picture {
        let [width, height] = self.mask.size();
        let rgba = (0..self.mask.coverage().len()).flat_map(|pixel| self.rgba(pixel)).collect();
        Picture { width, height, rgba }
    }

    /// Another matter has another colour, and so has what is painted in that.
    pub(super) fn set_own(&mut self, color: [u8; 3]) {
        if std::mem::replace(&mut self.inks[0], color) != color {
            (self.is_recolored, self.texture) = (true, None);
        }
    }

    /// The number of the ink that is painted with; where there are no more, it is of the colour that is nearest.
    fn ink(&mut self) -> u8 {
        let Some(color) = self.color else { return 0 };
        if let Some(known) = self.inks[1..].iter().position(|ink| *ink == color) {
            return known as u8 + 1;
        }
        if self.inks.len() <= usize::from(u8::MAX) {
            self.inks.push(color);
            return (self.inks.len() - 1) as u8;
        }
        let off = |ink: &[u8; 3]| (0..3).map(|k| u32::from(ink[k].abs_diff(color[k]))).sum::<u32>();
        (1..=u8::MAX).min_by_key(|number| off(&self.inks[usize::from(*number)])).unwrap_or(0)
    }

    /// The colour of a pixel, with its coverage as opacity: that of its ink; of the first one as far as there is more of it than there was.
    fn rgba(&self, pixel: usize) -> [u8; 4] {
        let alpha = self.mask.coverage()[pixel];
        let number = self.mask.inks().get(pixel).copied().unwrap_or(0);
        let ink = self.inks[usize::from(number)];
        if number > 0 {
            return [ink[0], ink[1], ink[2], alpha];
        }
        let own = self.under.as_ref().map(|(picture, covered)| (&picture.rgba[4 * pixel..], covered[pixel].min(alpha)));
        let Some((color, covered)) = own.filter(|(_, covered)| *covered > 0) else {
            return [ink[0], ink[1], ink[2], alpha];
        };
        let [all, old] = [alpha, covered].map(u32::from);
        let mixed = |k: usize| ((old * u32::from(color[k]) + (all - old) * u32::from(ink[k]) + all / 2) / all) as u8;
        [mixed(0), mixed(1), mixed(2), alpha]
    }

    /// Where on the screen the middle of what is painted was seen last `[points]`; `None` where there is nothing, or it was not seen.
    pub(super) fn middle(&self) -> Option<Pos2> {
        let [width, _] = self.mask.size().map(|side| side as usize);
        let inked = self.mask.coverage().iter().enumerate().filter(|(_, ink)| **ink > HALF).map(|(pixel, _)| pixel);
        let places = inked.map(|pixel| Pos2::new((pixel % width) as f32 + 0.5, (pixel / width) as f32 + 0.5));
        let ink = places.fold(Rect::NOTHING, |rect, place| rect.union(Rect::from_pos(place)));
        let scale = self.place.width() / width as f32;
        (ink.min.x <= ink.max.x && self.place.is_positive()).then(|| self.place.min + scale * ink.center().to_vec2())
    }

    /// The same, if it has changed since the last call.
    pub(super) fn take_changed(&mut self) -> Option<Picture> {
        let is_recolored = std::mem::take(&mut self.is_recolored);
        (is_recolored || self.mask.version() != self.seen).then(|| {
            self.seen = self.mask.version();
            self.picture()
        })
    }

    /// The canvas as it is to be shown: what changed of it since the last call is uploaded, and no more.
    pub(super) fn texture(&mut self, context: &egui::Context) -> TextureId {
        let changed = self.mask.changed();
        let whole = self.mask.size();
        let part = if self.texture.is_some() { changed } else { Some([0, 0, whole[0], whole[1]]) };
        let image = part.map(|part| self.image(part));
        match (&mut self.texture, part.zip(image)) {
            (Some(texture), Some(([left, top, ..], image))) => {
                texture.set_partial([left as usize, top as usize], image, TextureOptions::LINEAR);
                texture.id()
            }
            (Some(texture), None) => texture.id(),
            (empty, image) => {
                let image = image.map(|(_, image)| image).unwrap_or_default();
                empty.insert(context.load_texture("canvas", image, TextureOptions::LINEAR)).id()
            }
        }
    }

    /// A rectangle of the canvas `[px]`: left, top, width, height.
    fn image(&self, [left, top, width, height]: [u32; 4]) -> ColorImage {
        let [left, top, width, height] = [left, top, width, height].map(|length| length as usize);
        let across = self.mask.size()[0] as usize;
        let pixels = (top..top + height).flat_map(|row| (left..left + width).map(move |column| row * across + column));
        let colors = pixels.map(|pixel| {
            let [red, green, blue, alpha] = self.rgba(pixel);
            Color32::from_rgba_unmultiplied(red, green, blue, alpha)
        });
        ColorImage::new([width, height], colors.collect())
    }

    /// The tools, in three rows.
    pub(super) fn tools(&mut self, ui: &mut egui::Ui) {
        ui.horizontal_wrapped(|ui| {
            for (tool, label) in [(Tool::Paint, "Paint"), (Tool::Erase, "Erase"), (Tool::Fill, "Fill")] {
                ui.selectable_value(&mut self.tool, tool, label);
            }
            ui.separator();
            if ui.add_enabled(self.mask.can_undo(), egui::Button::new("Undo")).on_hover_text("Ctrl+Z").clicked() {
                self.undo();
            }
            if ui.add_enabled(self.mask.can_redo(), egui::Button::new("Redo")).on_hover_text("Ctrl+Y").clicked() {
                self.redo();
            }
            if ui.button("Clear").clicked() {
                self.mask.clear();
            }
            if ui.button("Invert").clicked() {
                self.mask.invert();
            }
        });
        ui.horizontal_wrapped(|ui| {
            let brush = Slider::new(&mut self.radius, 1.0..=128.0).logarithmic(true).suffix(" px").text("brush");
            ranged::slider(ui, brush, 1.0..=128.0, " px");
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
        ui.horizontal_wrapped(|ui| {
            let label = ui.label("colour").id;
            let own = ui.selectable_label(self.color.is_none(), "of the matter");
            if own.on_hover_text("the colour of what the body is made of").clicked() {
                self.color = None;
            }
            let said = "a colour of its own, for eyes, fins, stripes";
            if let Some((_, chosen)) = color::button(ui, self.color.unwrap_or(self.inks[0]), label, said) {
                self.color = Some(chosen);
            }
        });
    }

    /// What the pointer did to the canvas, which lies at `place` on the screen now: each of its events since the last frame counts,
    /// however many there were. `is_here` tells whether a press is one on the canvas.
    pub(super) fn paint(&mut self, events: &[Event], place: Rect, is_here: impl Fn(Pos2) -> bool) {
        // What was pressed is what was seen: the canvas may lie elsewhere now.
        let seen = std::mem::replace(&mut self.place, place);
        let place = if seen.is_positive() { seen } else { place };
        let scale = f64::from(place.width()) / f64::from(self.mask.size()[0]);
        let at = |screen: Pos2| [screen.x - place.min.x, screen.y - place.min.y].map(|x| f64::from(x) / scale);
        let brush = Brush { radius: self.radius, erases: self.tool == Tool::Erase };
        for event in events {
            match *event {
                Event::PointerButton { pos, button: PointerButton::Primary, pressed: true, .. } if is_here(pos) => {
                    let ink = self.ink();
                    self.mask.set_ink(ink);
                    if self.tool == Tool::Fill {
                        self.mask.fill(brush, at(pos));
                    } else {
                        self.mask.begin(brush, at(pos));
                        self.is_down = true;
                    }
                }
                Event::PointerMoved(pos) if self.is_down => self.mask.drag_to(at(pos)),
                Event::PointerButton { pos, button: PointerButton::Primary, pressed: false, .. } if self.is_down => {
                    self.mask.drag_to(at(pos));
                    self.lift();
                }
                Event::WindowFocused(false) => self.lift(),
                _ => {}
            }
        }
    }

    /// Takes steps back and does them again by their usual keys, unless a number is being typed.
    pub(super) fn keys(&mut self, context: &egui::Context) {
        if context.text_edit_focused() {
            return;
        }
        let (redone, undone) = context.input_mut(|input| {
            // With Shift first: without it the key would match both.
            let redone = input.count_and_consume_key(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z)
                + input.count_and_consume_key(Modifiers::COMMAND, Key::Y);
            (redone, input.count_and_consume_key(Modifiers::COMMAND, Key::Z))
        });
        (0..undone).for_each(|_| self.undo());
        (0..redone).for_each(|_| self.redo());
    }

    /// Whether anything was painted, or taken back.
    pub(super) fn has_work(&self) -> bool {
        self.is_down || self.mask.can_undo() || self.mask.can_redo()
    }

    /// Whether there is no ink on it.
    pub(super) fn is_empty(&self) -> bool {
        self.mask.coverage().iter().all(|&ink| ink == 0)
    }

    fn undo(&mut self) {
        self.is_down = false;
        self.mask.undo();
    }

    fn redo(&mut self) {
        self.is_down = false;
        self.mask.redo();
    }

    /// Ends the stroke, if there is one.
    pub(super) fn lift(&mut self) {
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::{Answer, Import};
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
        let shown = painting.image([100, 195, 3, 2]);
        assert_eq!((shown.size, shown.pixels[0]), ([3, 2], Color32::from_rgb(INK[0], INK[1], INK[2])));
        assert_eq!(painting.image([0, 0, 2, 2]).pixels, [Color32::TRANSPARENT; 4]);
    }

    #[test]
    fn what_is_painted_over_keeps_its_colours_and_strokes_have_their_own() {
        let mut under = Picture::filled(40, 20, [0; 4]);
        for pixel in (0..800).filter(|pixel| pixel % 40 < 20) {
            under.rgba[4 * pixel..4 * pixel + 4].copy_from_slice(&[10, 20, 200, 255]);
        }
        under.rgba[4 * 20..4 * 20 + 4].copy_from_slice(&[10, 20, 200, 51]);
        let mut painting = Painting::new(Some(&under)).unwrap();
        painting.mask.begin(Brush { radius: 6.0, erases: false }, [20.0, 3.0]);
        painting.mask.end();
        let picture = painting.take_changed().unwrap();
        let at = |x: usize| &picture.rgba[4 * x..4 * x + 4];
        assert_eq!(at(18), [10, 20, 200, 255], "the picture's own");
        assert_eq!(at(22), [INK[0], INK[1], INK[2], 255]);
        assert_eq!(at(20), [196, 124, 107, 255], "a fifth of its rim is the picture's");
        painting.mask.begin(Brush { radius: 4.0, erases: true }, [18.0, 10.0]);
        painting.mask.end();
        let erased = painting.take_changed().unwrap();
        assert_eq!(erased.rgba[4 * (10 * 40 + 18) + 3], 0);
        assert_eq!(erased.rgba[..80], picture.rgba[..80], "elsewhere it stays");
    }

    #[test]
    fn strokes_have_the_colour_that_is_chosen_and_the_first_ink_that_of_the_matter() {
        let mut painting = Painting::new(None).unwrap();
        let place = Rect::from_min_size(Pos2::ZERO, egui::vec2(512.0, 512.0));
        let dab = |painting: &mut Painting, color: Option<[u8; 3]>, x: f32| {
            painting.color = color;
            let at = Pos2::new(x, 100.0);
            painting.paint(&[button(at, true), button(at, false)], place, |_| true);
            painting.take_changed().unwrap()
        };
        dab(&mut painting, None, 100.0);
        let blue = [0x2f, 0x7a, 0xd9];
        let picture = dab(&mut painting, Some(blue), 106.0);
        let at = |picture: &Picture, x: usize| [0, 1, 2].map(|k| picture.rgba[4 * (100 * 512 + x) + k]);
        assert_eq!([at(&picture, 86), at(&picture, 106)], [INK, blue], "over what is there already, too");
        painting.set_own([1, 2, 3]);
        let picture = painting.take_changed().unwrap();
        assert_eq!([at(&picture, 86), at(&picture, 106)], [[1, 2, 3], blue]);
        painting.set_own([1, 2, 3]);
        assert!(painting.take_changed().is_none());
        painting.undo();
        assert_eq!(at(&painting.take_changed().unwrap(), 106), [1, 2, 3]);
        for k in 0..300_u32 {
            painting.color = Some([k as u8, (k / 200) as u8, 7]);
            painting.ink();
        }
        assert_eq!(painting.inks.len(), 256, "no more numbers than there are");
    }

    #[test]
    fn a_drawing_is_where_it_was_seen() {
        let mut led = Led::new([900.0, 700.0]);
        assert_eq!(led.painting().middle(), None, "nothing is drawn");
        let ends = [[100.0, 300.0], [140.0, 340.0]].map(|place| led.screen(place));
        let [from, to] = ends;
        for event in [Event::PointerMoved(from), button(from, true), Event::PointerMoved(to), button(to, false)] {
            led.frame(vec![event]);
        }
        let middle = led.painting().middle().unwrap();
        assert!(middle.distance(from.lerp(to, 0.5)) < 1.0, "{middle:?} between {from:?} and {to:?}");
    }

    /// An import's panel on a screen of this size, led by events.
    struct Led {
        context: egui::Context,
        import: Import,
        size: egui::Vec2,
    }

    impl Led {
        fn new(size: [f32; 2]) -> Self {
            let import = Import::of_canvas(|| ()).unwrap();
            let mut led = Led { context: egui::Context::default(), import, size: size.into() };
            // A window is measured first, then placed.
            (0..3).for_each(|_| assert_eq!(led.frame(Vec::new()), None));
            led
        }

        fn frame(&mut self, events: Vec<Event>) -> Option<Answer> {
            let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, self.size));
            let input = egui::RawInput { screen_rect, events, ..Default::default() };
            let mut answer = None;
            let mut output = self.context.run_ui(input, |ui| answer = self.import.show(ui.ctx(), true));
            output.textures_delta.clear();
            answer
        }

        fn painting(&mut self) -> &mut Painting {
            self.import.painting.as_mut().unwrap()
        }

        /// Where a place of the canvas `[px]` is on the screen.
        fn screen(&mut self, [x, y]: [f64; 2]) -> Pos2 {
            let painting = self.painting();
            let scale = f64::from(painting.place.width()) / f64::from(SIDE);
            painting.place.min + egui::vec2((x * scale) as f32, (y * scale) as f32)
        }

        fn key(&mut self, key: Key, modifiers: Modifiers) -> Option<Answer> {
            let event = |pressed| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
            self.frame(vec![event(true), event(false)])
        }
    }

    fn button(pos: Pos2, pressed: bool) -> Event {
        Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
    }

    /// A star of 130 places, two of them at each of its tips and notches.
    fn star() -> Vec<[f64; 2]> {
        let corner = |k: usize| {
            let (angle, radius) = (std::f64::consts::PI * k as f64 / 5.0, [200.0, 80.0][k % 2]);
            [256.0 + radius * angle.sin(), 256.0 - radius * angle.cos()]
        };
        let between = |k: usize, share: f64| {
            let (a, b) = (corner(k), corner(k + 1));
            [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]))
        };
        (0..10).flat_map(|k| (0..13).map(move |j| between(k, f64::from(j) / 12.0))).collect()
    }

    #[test]
    fn every_event_of_the_pointer_counts_however_many_a_frame_has() {
        let star = star();
        let mut alone = Mask::new(SIDE, SIDE).unwrap();
        alone.begin(Brush { radius: 16.0, erases: false }, star[0]);
        star[1..].iter().for_each(|&place| alone.drag_to(place));
        alone.end();
        for each in [131, 10] {
            let mut led = Led::new([1100.0, 760.0]);
            let places: Vec<Pos2> = star.iter().map(|&place| led.screen(place)).collect();
            let mut events = vec![Event::PointerMoved(places[0]), button(places[0], true)];
            events.extend(places[1..].iter().map(|&place| Event::PointerMoved(place)));
            events.push(button(places[129], false));
            // A pointer that has left the canvas draws no more.
            events.push(Event::PointerMoved(Pos2::new(3.0, 3.0)));
            for some in events.chunks(each) {
                led.frame(some.to_vec());
            }
            let painted = led.painting();
            let differing = painted.mask.coverage().iter().zip(alone.coverage()).filter(|(a, b)| a.abs_diff(**b) > 2);
            assert_eq!(differing.count(), 0, "{each} events a frame");
            assert!(painted.mask.can_undo(), "a step");
        }
    }

    #[test]
    fn what_is_drawn_meets_what_is_there() {
        let mut led = Led::new([1100.0, 760.0]);
        let places: Vec<Pos2> = star().into_iter().map(|place| led.screen(place)).collect();
        let mut events = vec![button(places[0], true)];
        events.extend(places[1..].iter().map(|&place| Event::PointerMoved(place)));
        events.push(button(places[0], false));
        led.frame(events);
        let behind = super::super::meeting_tests::thrown_at_the_disc(&led.import, Vec::new());
        assert!(behind < -0.5, "it pushes the disc before it: {behind}");
    }

    #[test]
    fn a_press_beside_the_canvas_paints_nothing() {
        let mut led = Led::new([1100.0, 760.0]);
        let [outside, inside] = [[-60.0, 256.0], [256.0, 256.0]].map(|place| led.screen(place));
        led.frame(vec![button(outside, true), Event::PointerMoved(inside), button(inside, false)]);
        assert!(!led.import.has_work());
        led.frame(vec![button(inside, true), Event::WindowFocused(false), Event::PointerMoved(outside)]);
        assert_eq!(led.painting().mask.coverage()[256 * 512 + 100], 0, "a window that lost the focus ends the stroke");
        assert!(led.import.has_work());
    }

    #[test]
    fn steps_are_taken_back_and_done_again_by_keys() {
        let mut led = Led::new([1100.0, 760.0]);
        let mut ink = Vec::new();
        for x in [100.0, 250.0, 400.0] {
            let place = led.screen([x, 256.0]);
            led.frame(vec![button(place, true), button(place, false)]);
            ink.push(led.painting().mask.coverage().to_vec());
        }
        let both = Modifiers::COMMAND | Modifiers::SHIFT;
        let ctrl = Modifiers::COMMAND;
        let steps = [(Key::Z, ctrl, 1), (Key::Z, ctrl, 0), (Key::Z, both, 1), (Key::Y, ctrl, 2), (Key::Y, ctrl, 2)];
        for (key, held, shown) in steps {
            led.key(key, held);
            assert!(led.painting().mask.coverage() == ink[shown], "{key:?} {held:?}");
        }
    }

    #[test]
    fn a_drawing_that_is_put_away_comes_back_with_its_steps() {
        let mut led = Led::new([1100.0, 760.0]);
        let [a, b] = [[100.0, 256.0], [300.0, 256.0]].map(|place| led.screen(place));
        led.frame(vec![button(a, true), Event::PointerMoved(b)]);
        led.import.put_away();
        led.frame(vec![Event::PointerMoved(Pos2::new(3.0, 3.0)), button(Pos2::new(3.0, 3.0), false)]);
        assert_eq!(led.painting().mask.coverage()[100 * 512 + 100], 0, "the stroke under way has ended");
        assert!(led.painting().mask.can_undo());
    }

    #[test]
    fn every_button_is_reached_on_a_small_screen() {
        for size in [[400.0, 300.0], [320.0, 240.0], [600.0, 900.0], [1280.0, 640.0]] {
            let mut led = Led::new(size);
            let panel = led.context.memory(|memory| memory.area_rect(egui::Id::unique("import")));
            let panel = panel.unwrap();
            let screen = Rect::from_min_size(Pos2::ZERO, led.size);
            assert!(screen.expand(1.0).contains_rect(panel), "{size:?}: {panel:?}");
            // Along the lower edge of the panel lies the button that closes it.
            let y = panel.max.y - 20.0;
            let mut places = (panel.min.x as i32..panel.max.x as i32).step_by(16);
            let answer = places.find_map(|x| {
                let at = Pos2::new(x as f32, y);
                led.frame(vec![Event::PointerMoved(at)]);
                led.frame(vec![button(at, true)]);
                led.frame(vec![button(at, false)])
            });
            assert_eq!(answer, Some(Answer::Cancel), "{size:?}");
        }
    }
}
