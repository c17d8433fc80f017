//! The panels in a harness that presses, types and reads by accessible names, and pictures of them where there is a GPU.

use std::cell::RefCell;
use std::rc::Rc;

use egui::{Rect, TexturesDelta, Vec2};
use egui_kittest::{Harness, TestRenderer};
use image::RgbaImage;
use wobble::app::rehearsal::Rehearsal;
use wobble::render::Gpu;

/// The format that panels are drawn in.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Panels beside a world in a window of this size `[points]`, with so many pixels a point.
pub fn harness(rehearsal: Rehearsal, size: [f32; 2], scale: f32) -> (Harness<'static, Rehearsal>, Textures) {
    let textures = Textures::default();
    let builder = Harness::builder().with_size(Vec2::from(size)).with_pixels_per_point(scale);
    // One test looks for names that are missing; the others go on without them.
    let builder = builder.with_accessibility_check(false).renderer(textures.clone());
    let show = |ui: &mut egui::Ui, rehearsal: &mut Rehearsal| rehearsal.show(ui);
    let mut harness = builder.build_ui_state(show, rehearsal);
    // Sizes are found, and panels fade in.
    harness.run_steps(6);
    (harness, textures)
}

/// What the panels want of textures, until they are drawn.
#[derive(Clone, Default)]
pub struct Textures(Rc<RefCell<TexturesDelta>>);

impl TestRenderer for Textures {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        self.0.borrow_mut().append(std::mem::take(delta));
    }
}

impl Drop for Textures {
    fn drop(&mut self) {
        // What was never drawn is no fault.
        if Rc::strong_count(&self.0) == 1 {
            self.0.borrow_mut().clear();
        }
    }
}

/// A picture of what a harness shows in a part of the window `[points]`.
pub fn picture(gpu: &Gpu, (harness, textures): (&Harness<'_, Rehearsal>, &Textures), part: Rect) -> RgbaImage {
    let (device, queue) = (&gpu.device, &gpu.queue);
    let scale = harness.ctx.pixels_per_point();
    let size = (harness.ctx.content_rect().size() * scale).round();
    let (width, height) = (size.x as u32, size.y as u32);
    let mut renderer = egui_wgpu::Renderer::new(device, FORMAT, egui_wgpu::RendererOptions::PREDICTABLE);
    let mut delta = std::mem::take(&mut *textures.0.borrow_mut());
    let mut set: Vec<_> = delta.set.drain().collect();
    set.sort_by_key(|(id, _)| format!("{id:?}"));
    for (id, images) in set {
        for image in images {
            renderer.update_texture(device, queue, id, &image);
        }
    }
    delta.clear();
    let jobs = harness.ctx.tessellate(harness.output().shapes.clone(), scale);
    let screen = egui_wgpu::ScreenDescriptor { size_in_pixels: [width, height], pixels_per_point: scale };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("panels"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut commands = renderer.update_buffers(device, queue, &mut encoder, &jobs, &screen);
    // As the world's ground lies behind them.
    let ground = if harness.state().palette() == wobble::render::Palette::Dark { 0.06 } else { 0.95 };
    let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("panels"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &texture.create_view(&Default::default()),
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color { r: ground, g: ground, b: ground, a: 1.0 }),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..Default::default()
    });
    renderer.render(&mut pass.forget_lifetime(), &jobs, &screen);
    // Rows of a copy begin at multiples of 256 bytes.
    let row = (4 * width).next_multiple_of(256);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("picture"),
        size: u64::from(row * height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
    let to = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), to, texture.size());
    commands.push(encoder.finish());
    queue.submit(commands);
    buffer.slice(..).map_async(wgpu::MapMode::Read, |mapped| mapped.unwrap());
    device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    let bytes = buffer.slice(..).get_mapped_range().unwrap();
    let part = part * scale;
    let [left, top] = [part.left(), part.top()].map(|x| x.floor().max(0.0) as u32);
    let [right, bottom] = [(part.right(), width), (part.bottom(), height)].map(|(x, most)| (x.ceil() as u32).min(most));
    RgbaImage::from_fn(right - left, bottom - top, |x, y| {
        let at = (row * (top + y) + 4 * (left + x)) as usize;
        image::Rgba([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
    })
}
