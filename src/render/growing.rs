//! A buffer on the GPU that grows with its contents.

use super::counters::RenderCounters;
use super::error::RenderError;
use super::gpu::Gpu;

/// A buffer that grows: contents that fit are written in place.
pub(super) struct GrowingBuffer {
    what: &'static str,
    usage: wgpu::BufferUsages,
    pub(super) buffer: wgpu::Buffer,
    /// No binding knows of this buffer yet. Kept here, so that it outlives a later write that fails.
    is_unbound: bool,
}

impl GrowingBuffer {
    /// An empty one with room for `room` bytes.
    pub(super) fn new(gpu: &Gpu, what: &'static str, usage: wgpu::BufferUsages, room: u64) -> Self {
        let usage = usage | wgpu::BufferUsages::COPY_DST;
        GrowingBuffer { what, usage, buffer: make(gpu, what, usage, room), is_unbound: true }
    }

    /// Writes `bytes`, to a larger buffer if this one is too small.
    ///
    /// Errors: more than the GPU's buffers hold; the contents stay as they were.
    pub(super) fn write(&mut self, gpu: &Gpu, bytes: &[u8], counters: &mut RenderCounters) -> Result<(), RenderError> {
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

    /// Whether this is another buffer since the last call, so that bindings to it are stale.
    pub(super) fn take_unbound(&mut self) -> bool {
        std::mem::take(&mut self.is_unbound)
    }
}

fn make(gpu: &Gpu, label: &str, usage: wgpu::BufferUsages, size: u64) -> wgpu::Buffer {
    let size = size.next_multiple_of(16);
    gpu.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
}
