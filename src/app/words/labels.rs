//! Labels of a scene in pictures of it off-screen, painted as the window paints them.

use std::sync::Arc;

use egui::epaint::ClippedShape;
use egui::{Context, Pos2, RawInput, emath::TSTransform};
use egui_wgpu::ScreenDescriptor;
use image::RgbaImage;

use super::{APART, Anchor, points, seen, written_apart};
use crate::app::painter::{Painter, over};
use crate::app::panels::theme;
use crate::render::{Capture, Gpu, Palette, Pane, RenderError};
use crate::scene::LabelKeys;

/// The labels of a scene, and what they are painted with.
pub struct Labels {
    labels: Arc<Vec<LabelKeys>>,
    scale: f32,
    context: Context,
    /// Made for the first picture with a label.
    painter: Option<Painter>,
}

impl Labels {
    /// Labels in one palette; `scale` is pixels of a picture in a logical one.
    pub fn new(labels: &[LabelKeys], (palette, scale): (Palette, f32)) -> Self {
        let context = Context::default();
        theme::apply(&context, palette);
        context.set_pixels_per_point(scale);
        Labels { labels: Arc::new(labels.to_vec()), scale, context, painter: None }
    }

    /// Others are painted from now on.
    pub fn say(&mut self, labels: &Arc<Vec<LabelKeys>>) {
        self.labels = Arc::clone(labels);
    }

    /// Draws worlds side by side, each with its labels: see [`Capture::pictures`].
    ///
    /// Errors: as there.
    pub fn picture(&mut self, capture: &mut Capture, panes: &[Pane<'_>]) -> Result<RgbaImage, RenderError> {
        capture.pictures_below(panes, |gpu, encoder, target| self.paint(gpu, encoder, target, panes))
    }

    fn paint(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        panes: &[Pane<'_>],
    ) -> Vec<wgpu::CommandBuffer> {
        if self.labels.is_empty() {
            return Vec::new();
        }
        let texture = target.texture();
        let size = [texture.width(), texture.height()];
        let screen_rect = Some(points([0, 0, size[0], size[1]], self.scale));
        let mut shapes = Vec::new();
        let input = RawInput { screen_rect, ..RawInput::default() };
        let mut output = self.context.run_ui(input, |_| shapes = self.shapes(panes));
        let jobs = self.context.tessellate(shapes, self.scale);
        let screen = ScreenDescriptor { size_in_pixels: size, pixels_per_point: self.scale };
        let painter = self.painter.get_or_insert_with(|| Painter::new(gpu, texture.format()));
        painter.take_textures(gpu, &mut output.textures_delta);
        let commands = painter.upload(gpu, encoder, (&jobs, &screen));
        painter.paint(&mut over(encoder, target), (&jobs, &screen));
        painter.free_textures(&mut output.textures_delta);
        commands
    }

    /// The labels that are seen, where they are.
    fn shapes(&self, panes: &[Pane<'_>]) -> Vec<ClippedShape> {
        let of_pane = |pane: &Pane<'_>| {
            let clip_rect = points(pane.clip, self.scale);
            let room = ((clip_rect.shrink(APART), None), &[][..]);
            let mut others = Vec::new();
            let shape = |(_, at, words): (usize, glam::DVec2, &str)| {
                let at = Pos2::new(at.x as f32 / self.scale, at.y as f32 / self.scale);
                let shape = written_apart(&self.context, (at, Anchor::Middle), words, room, &mut others);
                ClippedShape { clip_rect, shape, transform_after_tessellation: TSTransform::IDENTITY }
            };
            let seen = seen(&self.labels, &pane.view, &pane.camera, pane.clip);
            seen.into_iter().map(shape).collect::<Vec<_>>()
        };
        panes.iter().flat_map(of_pane).collect()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui::Rect;
    use glam::DVec2;

    use super::*;
    use crate::app::words::MARGIN;
    use crate::render::{Camera, Look, Pose, View};
    use crate::scene::Scene;
    use crate::sim::{Bonds, Positions};

    const SIZES: [[u32; 2]; 2] = [[320, 200], [120, 200]];

    fn labels(text: &str) -> Vec<LabelKeys> {
        let scene = format!(r#"{{"wobble": 1, "points": {{"position": [[0, 0], [1, 0]]}}, "labels": {text}}}"#);
        Scene::parse(&scene, "test").unwrap().labels
    }

    /// Does something with a view two metres high of two points at these places, without their bond.
    fn with_pane<T>(size: [u32; 2], places: &[f64], act: impl FnOnce(Pane<'_>) -> T) -> T {
        let bonds = Bonds::default();
        let current = Positions::F64(places);
        let view = View { previous: current, current, ..View::empty(&bonds, 2) };
        let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 2.0 }, size);
        act(Pane::whole(view, camera, Look::default(), size))
    }

    /// Where labels lie in it `[px]`, with their grounds.
    fn laid(labels: &[LabelKeys], size: [u32; 2], places: &[f64]) -> Vec<Rect> {
        let of = Labels::new(labels, (Palette::Dark, 1.0));
        let mut laid = Vec::new();
        let mut output = of.context.run_ui(RawInput::default(), |_| {
            let shapes = with_pane(size, places, |pane| of.shapes(&[pane]));
            laid = shapes.iter().map(|shape| shape.shape.visual_bounding_rect()).collect();
        });
        output.textures_delta.clear();
        laid
    }

    #[test]
    fn labels_stand_with_the_middle_of_their_lower_edge_where_the_scene_says() {
        let at = laid(&labels(r#"[{"at": [0.5, 0], "text": "one"}]"#), SIZES[0], &[0.0; 4])[0];
        assert!((at.center().x - 210.0).abs() <= 1.0, "{at:?}");
        assert!((at.bottom() - 100.0 - MARGIN.y).abs() <= 1.0 && at.top() > 70.0, "{at:?}");
    }

    #[test]
    fn a_label_goes_along_with_its_point_and_goes_with_it() {
        let of = labels(r#"[{"at": [0, 0.1], "text": "one", "point": 1}]"#);
        let at = |places: &[f64]| laid(&of, SIZES[0], places);
        let way = at(&[0.0, 0.0, 0.3, -0.2])[0].min - at(&[0.0; 4])[0].min;
        assert!((way - egui::vec2(30.0, 20.0)).length() < 0.1, "{way:?}");
        assert_eq!([at(&[0.0, 0.0, f64::NAN, f64::NAN]), at(&[0.0; 2])], [[], []]);
    }

    #[test]
    fn labels_are_whole_at_the_edge_and_have_lines_where_there_is_no_room_for_one() {
        let of = labels(r#"[{"at": [-0.55, 0.99], "text": "a few words, more than a line has"}]"#);
        for [width, height] in SIZES {
            let at = laid(&of, [width, height], &[0.0; 4])[0];
            assert!(at.min.x >= APART && at.min.y >= APART, "{at:?}");
            assert!(at.max.x <= width as f32 - APART && at.max.y <= height as f32 - APART, "{at:?}");
            assert_eq!(at.height() > 40.0, width < 200, "{at:?}");
        }
        let beside = labels(r#"[{"at": [9, 0], "text": "one"}]"#);
        assert_eq!(laid(&beside, SIZES[0], &[0.0; 4]), [], "out of the picture");
    }

    #[test]
    fn pictures_have_labels_where_they_are_laid_and_nothing_else_is_other() {
        let of = labels(r#"[{"at": [0.5, 0], "text": "one"}]"#);
        let Some(gpu) = Gpu::of_test() else { return };
        let mut capture = Capture::on(gpu, SIZES[0], 2).unwrap();
        let mut both = [of.as_slice(), &[]].map(|labels: &[LabelKeys]| Labels::new(labels, (Palette::Dark, 1.0)));
        let mut taken = |which: usize, places: &[f64]| {
            capture.forget_world();
            with_pane(SIZES[0], places, |pane| both[which].picture(&mut capture, &[pane]).unwrap())
        };
        // Letters are given to the GPU with the first picture alone.
        for places in [[0.0; 4], [0.1; 4]] {
            let [with, without] = [0, 1].map(|which| taken(which, &places));
            let place = laid(&of, SIZES[0], &places)[0];
            let other = |x: u32, y: u32| with.get_pixel(x, y) != without.get_pixel(x, y);
            for (x, y, pixel) in with.enumerate_pixels() {
                let at = Pos2::new(x as f32 + 0.5, y as f32 + 0.5);
                assert!(!other(x, y) || place.expand(1.0).contains(at), "{x} {y}: {pixel:?}");
            }
            let is_letter = |pixel: &&image::Rgba<u8>| pixel.0[..3].iter().all(|&channel| channel > 180);
            let letters =
                with.pixels().filter(is_letter).count() as i64 - without.pixels().filter(is_letter).count() as i64;
            assert!(letters > 20, "{letters} bright pixels");
        }
    }
}
