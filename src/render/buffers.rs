//! What lies on the GPU of a world: two states of the positions, the bonds, who is pinned.
//!
//! Positions lie as an `f32` world has them, D numbers a point, and are uploaded without a copy; those of an `f64`
//! world are taken relative to an origin near the camera, where `f32` has its digits. Bonds and pins are uploaded when
//! the topology changes, positions when they moved, and nothing otherwise.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use super::camera::Camera;
use super::error::RenderError;
use super::gpu::Gpu;
use super::view::View;
use crate::sim::{Bonds, PointId, Positions};

/// A bond as the shader reads it: `Bond` in bonds.wgsl.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct GpuBond {
    a: u32,
    b: u32,
    rest_length: f32,
}

const _: () = assert!(size_of::<GpuBond>() == 12);

/// A buffer that grows: contents that fit are written in place.
pub(super) struct GrowingBuffer {
    what: &'static str,
    usage: wgpu::BufferUsages,
    pub(super) buffer: wgpu::Buffer,
    /// No binding knows of this buffer yet. Kept here, so that it outlives a later write that fails.
    is_unbound: bool,
}

impl GrowingBuffer {
    pub(super) fn new(gpu: &Gpu, what: &'static str, usage: wgpu::BufferUsages) -> Self {
        let usage = usage | wgpu::BufferUsages::COPY_DST;
        GrowingBuffer { what, usage, buffer: make(gpu, what, usage, 64), is_unbound: true }
    }

    /// Writes `bytes`, to a larger buffer if this one is too small.
    ///
    /// Errors: more than the GPU's buffers hold; the contents stay as they were.
    fn write(&mut self, gpu: &Gpu, bytes: &[u8], counters: &mut RenderCounters) -> Result<(), RenderError> {
        if bytes.len() as u64 > self.buffer.size() {
            let most = gpu.largest_buffer();
            if bytes.len() as u64 > most {
                return Err(RenderError::TooLarge { what: self.what, bytes: bytes.len() as u64, most });
            }
            self.buffer = make(gpu, self.what, self.usage, bytes.len() as u64);
            self.is_unbound = true;
        }
        if !bytes.is_empty() {
            gpu.queue.write_buffer(&self.buffer, 0, bytes);
            counters.uploads += 1;
            counters.bytes_uploaded += bytes.len() as u64;
        }
        Ok(())
    }
}

fn make(gpu: &Gpu, label: &str, usage: wgpu::BufferUsages, size: u64) -> wgpu::Buffer {
    let size = size.next_multiple_of(16);
    gpu.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
}

/// Work that drawing did: a still scene adds nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderCounters {
    /// Buffers written.
    pub uploads: u64,
    /// Bytes written to them.
    pub bytes_uploaded: u64,
    /// Command buffers submitted.
    pub submits: u64,
    /// Pictures drawn.
    pub frames_drawn: u64,
    /// Draw calls in them.
    pub draws: u64,
}

/// The buffers of a world, and what of it they hold.
pub(super) struct WorldBuffers {
    pub(super) previous: GrowingBuffer,
    pub(super) current: GrowingBuffer,
    pub(super) bonds: GrowingBuffer,
    pub(super) pinned: GrowingBuffer,
    pub(super) guides: GrowingBuffer,
    pub(super) frame: GrowingBuffer,
    pub(super) point_count: u32,
    pub(super) bond_count: u32,
    pub(super) guide_count: u32,
    /// What positions are relative to [m].
    pub(super) origin: DVec3,
    /// Middle one of the rest lengths [m]; 0 without bonds.
    pub(super) typical_bond: f64,
    motion: Option<u64>,
    topology: Option<u64>,
    last_frame: Vec<u8>,
    last_guides: Vec<u8>,
    staging: Vec<f32>,
}

/// How many picture heights the camera may stray from the origin of the positions: at 1000, a pixel of a picture of
/// 1000 is a millionth of the offset, which is what `f32` resolves ten times over.
const STRAY: f64 = 1000.0;

impl WorldBuffers {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let storage = |what| GrowingBuffer::new(gpu, what, wgpu::BufferUsages::STORAGE);
        let mut frame = GrowingBuffer::new(gpu, "frame", wgpu::BufferUsages::UNIFORM);
        frame.buffer = make(gpu, "frame", frame.usage, 512);
        WorldBuffers {
            previous: storage("positions"),
            current: storage("positions"),
            bonds: storage("bonds"),
            pinned: storage("pins"),
            guides: storage("guides"),
            frame,
            point_count: 0,
            bond_count: 0,
            guide_count: 0,
            origin: DVec3::ZERO,
            typical_bond: 0.0,
            motion: None,
            topology: None,
            last_frame: Vec::new(),
            last_guides: Vec::new(),
            staging: Vec::new(),
        }
    }

    /// Whether a buffer is another one since the last call, so that bindings to it are stale.
    pub(super) fn take_unbound(&mut self) -> bool {
        let all = [&mut self.previous, &mut self.current, &mut self.bonds, &mut self.pinned];
        let all = all.into_iter().chain([&mut self.guides, &mut self.frame]);
        all.fold(false, |any, buffer| any | std::mem::take(&mut buffer.is_unbound))
    }

    /// Uploads what changed of the world.
    ///
    /// Errors: a world too large for the GPU; nothing of it is drawn, and the next call uploads all of it.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        view: &View<'_>,
        camera: &Camera,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        if self.topology != Some(view.topology) {
            (self.topology, self.motion) = (None, None);
            self.upload_topology(gpu, view, counters)?;
        }
        let double = matches!(view.current, Positions::F64(_));
        let origin = if double { self.origin_near(camera) } else { DVec3::ZERO };
        if self.motion != Some(view.motion) || self.origin != origin {
            (self.origin, self.motion) = (origin, None);
            self.upload_positions(gpu, view, counters)?;
            self.motion = Some(view.motion);
        }
        self.topology = Some(view.topology);
        Ok(())
    }

    /// The present origin as long as it will do, else the camera's focus.
    fn origin_near(&self, camera: &Camera) -> DVec3 {
        let strayed = (camera.focus() - self.origin).length() > STRAY * camera.height();
        if strayed || self.motion.is_none() { camera.focus() } else { self.origin }
    }

    fn upload_topology(
        &mut self,
        gpu: &Gpu,
        view: &View<'_>,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        (self.point_count, self.bond_count) = (0, 0);
        self.typical_bond = median_rest_length(view.bonds);
        let gpu_bond =
            |(ends, rest): (&[PointId; 2], &f64)| GpuBond { a: ends[0].0, b: ends[1].0, rest_length: *rest as f32 };
        let bonds: Vec<GpuBond> = view.bonds.ends().iter().zip(view.bonds.rest_lengths()).map(gpu_bond).collect();
        self.bonds.write(gpu, bytemuck::cast_slice(&bonds), counters)?;
        let point_count = (view.current.len() / view.dimensions) as u32;
        let pins = pin_bits(view.pinned, point_count);
        self.pinned.write(gpu, bytemuck::cast_slice(&pins), counters)?;
        (self.point_count, self.bond_count) = (point_count, bonds.len() as u32);
        Ok(())
    }

    fn upload_positions(
        &mut self,
        gpu: &Gpu,
        view: &View<'_>,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        for (buffer, positions) in [(&mut self.previous, view.previous), (&mut self.current, view.current)] {
            let flat = match positions {
                Positions::F32(x) => x,
                Positions::F64(x) => {
                    let origin = self.origin.to_array();
                    let relative = |(i, x): (usize, &f64)| (x - origin[i % view.dimensions]) as f32;
                    self.staging.clear();
                    self.staging.extend(x.iter().enumerate().map(relative));
                    &self.staging
                }
            };
            buffer.write(gpu, bytemuck::cast_slice(flat), counters)?;
        }
        Ok(())
    }

    /// Uploads the uniforms of a picture, unless they are those of the last one.
    pub(super) fn set_frame(
        &mut self,
        gpu: &Gpu,
        bytes: &[u8],
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        if self.last_frame != bytes {
            self.frame.write(gpu, bytes, counters)?;
            self.last_frame = bytes.to_vec();
        }
        Ok(())
    }

    /// Uploads `count` guides, unless they are those of the last picture.
    pub(super) fn set_guides(
        &mut self,
        gpu: &Gpu,
        bytes: &[u8],
        count: usize,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        if self.last_guides != bytes {
            self.guides.write(gpu, bytes, counters)?;
            self.last_guides = bytes.to_vec();
        }
        self.guide_count = count as u32;
        Ok(())
    }
}

/// A bit a point: 1 = pinned. Pins of points that there are not are left out.
fn pin_bits(pinned: &[PointId], point_count: u32) -> Vec<u32> {
    let mut bits = vec![0_u32; (point_count as usize).div_ceil(32)];
    for pin in pinned {
        if let Some(word) = bits.get_mut(pin.index() / 32) {
            *word |= 1 << (pin.0 % 32);
        }
    }
    bits
}

fn median_rest_length(bonds: &Bonds) -> f64 {
    // A sample is enough to size points by.
    let step = (bonds.len() / 1000).max(1);
    let mut lengths: Vec<f64> = bonds.rest_lengths().iter().copied().step_by(step).collect();
    lengths.sort_by(f64::total_cmp);
    lengths.get(lengths.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pins_are_bits() {
        assert_eq!(pin_bits(&[PointId(0), PointId(33)], 40), [1, 2]);
        assert!(pin_bits(&[], 0).is_empty());
        assert_eq!(pin_bits(&[PointId(64), PointId(u32::MAX), PointId(1)], 40), [2, 0]);
        assert!(pin_bits(&[PointId(0)], 0).is_empty());
    }
}
