//! A buffer on the GPU with what it holds: written only where that is something else.

use bytemuck::Pod;

use super::counters::RenderCounters;
use super::error::RenderError;
use super::gpu::Gpu;
use super::growing::GrowingBuffer;

/// A list on the GPU, with what was uploaded last.
pub(super) struct KeptBuffer<T> {
    pub(super) buffer: GrowingBuffer,
    last: Vec<T>,
}

impl<T: Pod + PartialEq> KeptBuffer<T> {
    /// One that holds nothing.
    pub(super) fn new(buffer: GrowingBuffer) -> Self {
        KeptBuffer { buffer, last: Vec::new() }
    }

    /// Uploads rows, unless they are those that it holds.
    ///
    /// Errors: more than the GPU's buffers hold.
    pub(super) fn set(&mut self, gpu: &Gpu, rows: Vec<T>, counters: &mut RenderCounters) -> Result<(), RenderError> {
        if self.last != rows {
            self.buffer.write(gpu, bytemuck::cast_slice(&rows), counters)?;
            self.last = rows;
        }
        Ok(())
    }

    /// How many rows it holds.
    pub(super) fn len(&self) -> usize {
        self.last.len()
    }
}
