//! The panels as a picture of their own: painted when they change, which is seldom, and laid over the world in every frame.
//!
//! A driver without a GPU takes as long for a pixel of a panel as for many of the world, and what panels cover changes ten times a second
//! at most. Painted are those squares of them alone that look otherwise than before.

mod squares;

use super::painter::{Painter, over};
use crate::render::Gpu;

/// Lays the picture over what is there: premultiplied, pixel by pixel.
const SHADER: &str = "
@group(0) @binding(0) var panels: texture_2d<f32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    // One triangle around the whole picture.
    return vec4(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(panels, vec2<i32>(position.xy), 0);
}

@fragment
fn clear() -> @location(0) vec4<f32> {
    return vec4(0.0);
}
";

/// A picture of the panels.
pub(super) struct Overlay {
    pipeline: wgpu::RenderPipeline,
    /// Takes away what was in a part of the picture.
    clear: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    format: wgpu::TextureFormat,
    /// The picture, how it is bound, and its size `[px]`.
    picture: Option<(wgpu::TextureView, wgpu::BindGroup, [u32; 2])>,
    /// Where anything is in it: left, top, width and height of parts that do not overlap `[px]`.
    covered: Vec<[u32; 4]>,
    /// What is in it; `None`: it is to be painted anew, all of it.
    painted: Option<Vec<egui::ClippedPrimitive>>,
    /// Pixels painted since the last time that anyone asked.
    #[cfg(test)]
    pixels: u64,
}

impl Overlay {
    /// For targets of a format, which the picture has too.
    pub(super) fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let device = &gpu.device;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("overlay"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                count: None,
            }],
        });
        let over = (format, Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING));
        let clear = pipeline(device, None, "clear", (format, None));
        let pipeline = pipeline(device, Some(&layout), "fragment", over);
        Overlay {
            pipeline,
            clear,
            layout,
            format,
            picture: None,
            covered: Vec::new(),
            painted: None,
            #[cfg(test)]
            pixels: 0,
        }
    }

    /// Whether there is a picture of this size `[px]`.
    pub(super) fn fits(&self, size: [u32; 2]) -> bool {
        self.picture.as_ref().is_some_and(|(_, _, of)| *of == size)
    }

    /// What panels are painted with is other than it was: the next picture is painted anew, all of it.
    pub(super) fn spoil(&mut self) {
        self.painted = None;
    }

    /// Paints what changed of the picture, in a submission of its own.
    pub(super) fn paint(
        &mut self,
        gpu: &Gpu,
        painter: &mut Painter,
        (jobs, screen): (&[egui::ClippedPrimitive], &egui_wgpu::ScreenDescriptor),
    ) {
        let size = screen.size_in_pixels;
        if !self.fits(size) {
            self.picture = Some(self.picture_of(gpu, size));
            self.painted = None;
        }
        let Some((view, ..)) = &self.picture else { return };
        self.covered = squares::covered(jobs, screen);
        let parts = match self.painted.replace(jobs.to_vec()) {
            Some(before) => squares::changed(&before, jobs, screen),
            None => vec![[0, 0, size[0], size[1]]],
        };
        #[cfg(test)]
        {
            self.pixels += parts.iter().map(|&[_, _, width, height]| u64::from(width) * u64::from(height)).sum::<u64>();
        }
        if parts.is_empty() {
            return;
        }
        let jobs = squares::cut(jobs, &parts, screen);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut commands = painter.upload(gpu, &mut encoder, (&jobs, screen));
        let mut pass = over(&mut encoder, view);
        pass.set_pipeline(&self.clear);
        for &[left, top, width, height] in &parts {
            pass.set_scissor_rect(left, top, width, height);
            pass.draw(0..3, 0..1);
        }
        painter.paint(&mut pass, (&jobs, screen));
        drop(pass);
        commands.push(encoder.finish());
        gpu.queue.submit(commands);
    }

    /// Lays the picture over what is there.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some((_, binding, _)) = &self.picture else { return };
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, binding, &[]);
        for &[left, top, width, height] in &self.covered {
            pass.set_scissor_rect(left, top, width, height);
            pass.draw(0..3, 0..1);
        }
    }

    fn picture_of(&self, gpu: &Gpu, size: [u32; 2]) -> (wgpu::TextureView, wgpu::BindGroup, [u32; 2]) {
        let texture = gpu.target(("panels", size), self.format, wgpu::TextureUsages::TEXTURE_BINDING);
        let view = texture.create_view(&Default::default());
        let binding = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("overlay"),
            layout: &self.layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) }],
        });
        (view, binding, size)
    }
}

fn pipeline(
    device: &wgpu::Device,
    layout: Option<&wgpu::BindGroupLayout>,
    fragment: &str,
    (format, blend): (wgpu::TextureFormat, Option<wgpu::BlendState>),
) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("overlay"),
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    let both = [layout];
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("overlay"),
        bind_group_layouts: if layout.is_some() { &both } else { &[] },
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("overlay"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: Default::default(),
            targets: &[Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL })],
        }),
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        multiview_mask: None,
        cache: None,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    /// Panels as they look with a word in one of them.
    fn jobs(
        context: &egui::Context,
        word: &str,
        places: [f32; 2],
    ) -> (Vec<egui::ClippedPrimitive>, egui::TexturesDelta) {
        let input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(320.0, 200.0))),
            ..egui::RawInput::default()
        };
        let output = context.run_ui(input, |ui| {
            for (name, x) in ["left", "right"].into_iter().zip(places) {
                egui::Area::new(egui::Id::unique(name)).fixed_pos([x, 20.0]).show(ui.ctx(), |ui| {
                    egui::Frame::popup(ui.style())
                        .show(ui, |ui| ui.label(if name == "left" { "a panel" } else { word }));
                });
            }
        });
        (context.tessellate(output.shapes, output.pixels_per_point), output.textures_delta)
    }

    /// What an overlay shows over nothing, a row of 320 pixels after another.
    fn shown(gpu: &Gpu, overlay: &Overlay, format: wgpu::TextureFormat) -> Vec<u8> {
        let target = gpu.target(("test", [320, 200]), format, wgpu::TextureUsages::COPY_SRC);
        let view = target.create_view(&Default::default());
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 4 * 320 * 200,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        overlay.draw(&mut pass.forget_lifetime());
        encoder.copy_texture_to_buffer(
            target.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * 320), rows_per_image: None },
            },
            wgpu::Extent3d { width: 320, height: 200, depth_or_array_layers: 1 },
        );
        gpu.queue.submit([encoder.finish()]);
        buffer.slice(..).map_async(wgpu::MapMode::Read, |_| {});
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
        buffer.slice(..).get_mapped_range().unwrap().to_vec()
    }

    #[test]
    fn what_changed_is_painted_and_the_picture_is_the_same_as_one_that_is_painted_anew() {
        let Some(gpu) = Gpu::of_test() else { return };
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let mut painter = Painter::new(&gpu, format);
        let context = egui::Context::default();
        let screen = egui_wgpu::ScreenDescriptor { size_in_pixels: [320, 200], pixels_per_point: 1.0 };
        let mut overlay = Overlay::new(&gpu, format);
        let words =
            [("12.5 ms", [10.0, 160.0]), ("9.75 ms", [10.0, 160.0]), ("9.75 ms", [10.0, 120.0]), ("", [10.0, 120.0])];
        // The first frames fade in, and all signs are known after them.
        let apply = |painter: &mut Painter, mut delta: egui::TexturesDelta| {
            painter.take_textures(&gpu, &mut delta);
            painter.free_textures(&mut delta);
        };
        for k in 0..40 {
            let (_, delta) = jobs(&context, words[k % 2].0, words[0].1);
            apply(&mut painter, delta);
        }
        for (step, (word, places)) in words.into_iter().enumerate() {
            let (list, delta) = jobs(&context, word, places);
            apply(&mut painter, delta);
            overlay.pixels = 0;
            overlay.paint(&gpu, &mut painter, (&list, &screen));
            let painted = overlay.pixels;
            assert!(if step == 0 { painted == 64_000 } else { painted > 0 && painted < 20_000 }, "{step}: {painted}");
            let mut anew = Overlay::new(&gpu, format);
            anew.paint(&gpu, &mut painter, (&list, &screen));
            let [a, b] = [&overlay, &anew].map(|overlay| shown(&gpu, overlay, format));
            assert!(a.chunks(4).any(|pixel| pixel[3] > 0) && a == b, "{step}: {word}");
            overlay.pixels = 0;
            overlay.paint(&gpu, &mut painter, (&list, &screen));
            assert_eq!(overlay.pixels, 0, "nothing changed");
        }
    }
}
