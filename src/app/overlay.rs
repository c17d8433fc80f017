//! The panels as a picture of their own: painted when they change, which is seldom, and laid over the world in every frame.
//!
//! A driver without a GPU takes as long for a pixel of a panel as for many of the world, and what panels cover changes ten times a second
//! at most.

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
";

/// What is covered is found in squares of this side `[px]`.
const SIDE: u32 = 32;

/// A picture of the panels.
pub(super) struct Overlay {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    format: wgpu::TextureFormat,
    /// The picture, how it is bound, and its size `[px]`.
    picture: Option<(wgpu::TextureView, wgpu::BindGroup, [u32; 2])>,
    /// Where anything is in it: left, top, width and height of parts that do not overlap `[px]`.
    covered: Vec<[u32; 4]>,
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
        let pipeline = pipeline(device, &layout, format);
        Overlay { pipeline, layout, format, picture: None, covered: Vec::new() }
    }

    /// Whether there is a picture of this size `[px]`.
    pub(super) fn fits(&self, size: [u32; 2]) -> bool {
        self.picture.as_ref().is_some_and(|(_, _, of)| *of == size)
    }

    /// Paints the picture anew by the panels' own renderer, in a submission of its own.
    pub(super) fn paint(
        &mut self,
        gpu: &Gpu,
        renderer: &mut egui_wgpu::Renderer,
        (jobs, screen): (&[egui::ClippedPrimitive], &egui_wgpu::ScreenDescriptor),
    ) {
        let size = screen.size_in_pixels;
        if !self.fits(size) {
            self.picture = Some(self.picture_of(gpu, size));
        }
        let Some((view, ..)) = &self.picture else { return };
        self.covered = covered(jobs, screen);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut commands = renderer.update_buffers(&gpu.device, &gpu.queue, &mut encoder, jobs, screen);
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("panels"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        renderer.render(&mut pass.forget_lifetime(), jobs, screen);
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
    layout: &wgpu::BindGroupLayout,
    format: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("overlay"),
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("overlay"),
        bind_group_layouts: &[Some(layout)],
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
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        multiview_mask: None,
        cache: None,
    })
}

/// Where triangles lie that are seen: left, top, width and height of parts that do not overlap `[px]`, whole squares of them.
fn covered(jobs: &[egui::ClippedPrimitive], screen: &egui_wgpu::ScreenDescriptor) -> Vec<[u32; 4]> {
    let [width, height] = screen.size_in_pixels;
    let counts = [width, height].map(|side| side.div_ceil(SIDE) as usize);
    let mut is_covered = vec![false; counts[0] * counts[1]];
    let whole = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(width as f32, height as f32));
    for job in jobs {
        let egui::epaint::Primitive::Mesh(mesh) = &job.primitive else {
            is_covered.fill(true);
            break;
        };
        let clip = (job.clip_rect * screen.pixels_per_point).expand(1.0).intersect(whole);
        for corners in mesh.indices.chunks_exact(3) {
            let corners = [0, 1, 2].map(|k| mesh.vertices[corners[k] as usize]);
            if corners.iter().all(|corner| corner.color == egui::Color32::TRANSPARENT) {
                continue;
            }
            let places = corners.map(|corner| (corner.pos.to_vec2() * screen.pixels_per_point).to_pos2());
            let around = egui::Rect::from_points(&places).intersect(clip);
            if around.is_negative() {
                continue;
            }
            let square = |at: f32, count: usize| ((at.max(0.0) as u32 / SIDE) as usize).min(count - 1);
            let [left, right] = [around.left(), around.right()].map(|x| square(x, counts[0]));
            for row in square(around.top(), counts[1])..=square(around.bottom(), counts[1]) {
                is_covered[row * counts[0] + left..=row * counts[0] + right].fill(true);
            }
        }
    }
    parts(&is_covered, counts[0]).into_iter().map(|part| in_pixels(part, [width, height])).collect()
}

/// Runs of squares that are covered, each with the same run of rows below it: columns and rows, ends excluded.
fn parts(is_covered: &[bool], columns: usize) -> Vec<[[usize; 2]; 2]> {
    let mut parts: Vec<[[usize; 2]; 2]> = Vec::new();
    for (row, squares) in is_covered.chunks(columns).enumerate() {
        let mut from = 0;
        for run in squares.chunk_by(|a, b| a == b) {
            let across = [from, from + run.len()];
            from += run.len();
            if !run[0] {
                continue;
            }
            match parts.iter_mut().find(|[other, rows]| *other == across && rows[1] == row) {
                Some([_, rows]) => rows[1] += 1,
                None => parts.push([across, [row, row + 1]]),
            }
        }
    }
    parts
}

fn in_pixels([across, down]: [[usize; 2]; 2], [width, height]: [u32; 2]) -> [u32; 4] {
    let pixels = |[from, to]: [usize; 2], most: u32| {
        let from = from as u32 * SIDE;
        [from, (to as u32 * SIDE).min(most) - from]
    };
    let ([left, width], [top, height]) = (pixels(across, width), pixels(down, height));
    [left, top, width, height]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_panels_cover_is_found_in_parts_that_do_not_overlap() {
        let rect = |min: [f32; 2], max: [f32; 2], color| {
            let mut mesh = egui::Mesh::default();
            mesh.add_colored_rect(egui::Rect::from_min_max(min.into(), max.into()), color);
            let primitive = egui::epaint::Primitive::Mesh(mesh);
            egui::ClippedPrimitive {
                clip_rect: egui::Rect::from_min_max([0.0; 2].into(), [90.0, 50.0].into()),
                primitive,
            }
        };
        let screen = egui_wgpu::ScreenDescriptor { size_in_pixels: [200, 100], pixels_per_point: 2.0 };
        let seen = egui::Color32::from_white_alpha(3);
        let jobs = [
            rect([0.0, 0.0], [100.0, 50.0], egui::Color32::TRANSPARENT),
            rect([1.0, 1.0], [15.0, 30.0], seen),
            rect([4.0, 4.0], [40.0, 10.0], seen),
            rect([70.0, 40.0], [100.0, 90.0], seen),
        ];
        let parts = covered(&jobs, &screen);
        assert_eq!(
            parts,
            [[0, 0, 96, 32], [0, 32, 32, 32], [128, 64, 64, 36]],
            "the last is cut at its clip and at the edge"
        );
    }
}
