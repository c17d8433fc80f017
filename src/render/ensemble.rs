//! Worlds side by side in one picture: a renderer for each, with the same pipelines.

use glam::DVec3;

use super::camera::Camera;
use super::counters::RenderCounters;
use super::error::RenderError;
use super::gpu::Gpu;
use super::look::Look;
use super::renderer::Renderer;
use super::tiles::Tiles;
use super::view::View;

/// A world in its part of a picture.
#[derive(Clone)]
pub struct Pane<'a> {
    /// What is drawn.
    pub view: View<'a>,
    /// From where.
    pub camera: Camera,
    /// In which colours and sizes.
    pub look: Look,
    /// Left, top, width and height of what is drawn to `[px]`.
    pub clip: [u32; 4],
}

impl<'a> Pane<'a> {
    /// A world that has a picture of `size` `[px]` for itself.
    pub fn whole(view: View<'a>, camera: Camera, look: Look, [width, height]: [u32; 2]) -> Self {
        Pane { view, camera, look, clip: [0, 0, width, height] }
    }

    /// World `place` of several in a picture of `size` `[px]`; `camera` is that of the first.
    pub fn of(tiles: &Tiles, place: usize, view: View<'a>, camera: &Camera, look: Look, size: [u32; 2]) -> Self {
        Pane { view, camera: tiles.camera(place, camera, size), look, clip: tiles.clip(place, size) }
    }

    /// Ends of the line `[m]` that parts it from the one before it, if there is one.
    pub(super) fn border(&self) -> Option<[DVec3; 2]> {
        let [left, top, width, height] = self.clip.map(f64::from);
        let ends = match self.clip {
            [0, 0, ..] | [_, _, 0, _] | [_, _, _, 0] => return None,
            [0, ..] => [[left, top + 0.5], [left + width, top + 0.5]],
            _ => [[left + 0.5, top], [left + 0.5, top + height]],
        };
        Some(ends.map(|end| self.camera.world_from_screen(end)))
    }
}

/// Draws the worlds of a picture. What is beside the first costs nothing where there is nothing.
pub struct Ensemble {
    first: Renderer,
    others: Vec<Renderer>,
    /// Work for worlds that are beside it no more.
    past: RenderCounters,
}

impl Ensemble {
    /// For worlds of `dimensions` drawn to targets of `format`: see [`Renderer::new`].
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat, dimensions: usize) -> Self {
        Ensemble { first: Renderer::new(gpu, format, dimensions), others: Vec::new(), past: RenderCounters::default() }
    }

    /// Uploads what changed of each world since the last picture.
    ///
    /// Errors: a world larger than the GPU's buffers.
    pub fn prepare(&mut self, gpu: &Gpu, panes: &[Pane<'_>]) -> Result<(), RenderError> {
        let [first, others @ ..] = panes else { return Ok(()) };
        self.first.prepare(gpu, first)?;
        for gone in self.others.drain(others.len().min(self.others.len())..) {
            self.past = self.past.and(&RenderCounters { bytes_held: 0, ..*gone.counters() });
        }
        for (place, pane) in others.iter().enumerate() {
            if self.others.len() == place {
                self.others.push(self.first.another(gpu));
            }
            self.others[place].prepare(gpu, pane)?;
        }
        Ok(())
    }

    /// Draws what was prepared into the upper left `area` of `target`, which has `size` `[px]`, over the ground colour.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        (size, area): ([u32; 2], [u32; 2]),
        panes: &[Pane<'_>],
    ) {
        let [first, others @ ..] = panes else { return };
        self.first.draw(gpu, encoder, target, (size, area, first.clip), Some(first.look.ground));
        for (renderer, pane) in self.others.iter_mut().zip(others) {
            renderer.draw(gpu, encoder, target, (size, area, pane.clip), None);
        }
    }

    /// Submits a picture's commands.
    pub fn submit(&mut self, gpu: &Gpu, commands: impl IntoIterator<Item = wgpu::CommandBuffer>) {
        self.first.submit(gpu, commands);
    }

    /// The next picture is of other worlds: nothing that was uploaded is of them.
    pub fn forget_world(&mut self) {
        self.first.forget_world();
        self.others.iter_mut().for_each(Renderer::forget_world);
    }

    /// The renderer of the first world.
    pub fn first(&self) -> &Renderer {
        &self.first
    }

    /// Goes on counting from what another did before.
    pub fn count_from(&mut self, counters: RenderCounters) {
        self.first.count_from(counters);
    }

    /// Work done for all worlds since it was made.
    pub fn counters(&self) -> RenderCounters {
        let all = self.others.iter().map(Renderer::counters).chain([&self.past]);
        all.fold(*self.first.counters(), |sum, one| sum.and(one))
    }
}
