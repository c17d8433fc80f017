//! Quads of two triangles that share corners: a driver without a GPU works out four vertices of each, not six.

use std::ops::Range;

use super::chunks::LARGE;
use super::gpu::Gpu;

/// Vertices of a quad.
pub(super) const QUAD: u32 = 6;
/// Most quads of a draw call whose triangles share corners: as many as the bonds of a scene that is drawn whole.
const MOST: u32 = LARGE as u32;
/// The vertices of a quad, where those that lie in one place are one: `corner_of` in shapes.wgsl.
const CORNERS: [u32; 6] = [0, 1, 2, 0, 2, 5];

/// The corners of [`MOST`] quads.
#[derive(Clone)]
pub(super) struct Quads {
    corners: wgpu::Buffer,
}

impl Quads {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let corners: Vec<u32> = (0..MOST).flat_map(|quad| CORNERS.map(|corner| QUAD * quad + corner)).collect();
        let bytes: &[u8] = bytemuck::cast_slice(&corners);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("quads"),
            size: bytes.len() as u64,
            usage: wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        gpu.queue.write_buffer(&buffer, 0, bytes);
        Quads { corners: buffer }
    }

    /// Draws the quads of these vertices, six each: the shader is told the same numbers of vertices as without corners that are shared.
    pub(super) fn draw(&self, target: &mut wgpu::RenderPass<'_>, vertices: Range<u32>, instances: Range<u32>) {
        let Some(base) = base(&vertices) else { return target.draw(vertices, instances) };
        target.set_index_buffer(self.corners.slice(..), wgpu::IndexFormat::Uint32);
        target.draw_indexed(0..vertices.end - vertices.start, base, instances);
    }
}

/// Which vertex the first corner is; `None`: there are more quads than corners.
fn base(vertices: &Range<u32>) -> Option<i32> {
    i32::try_from(vertices.start).ok().filter(|_| vertices.end - vertices.start <= QUAD * MOST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_that_are_shared_lie_in_one_place() {
        let source = include_str!("../../shaders/shapes.wgsl");
        for line in [
            "let right = vertex == 1u || vertex == 2u || vertex == 4u;",
            "let upper = vertex == 2u || vertex == 4u || vertex == 5u;",
        ] {
            assert!(source.contains(line), "{line}");
        }
        let place = |vertex: u32| [[1, 2, 4], [2, 4, 5]].map(|side| side.contains(&vertex));
        assert!((0..QUAD).zip(CORNERS).all(|(vertex, corner)| place(vertex) == place(corner)));
    }

    #[test]
    fn more_quads_than_corners_are_drawn_without_them() {
        assert_eq!(base(&(60..120)), Some(60));
        assert_eq!(base(&(6..QUAD * MOST + 6)), Some(6));
        assert_eq!(base(&(0..QUAD * MOST + 6)), None);
        assert_eq!(base(&(u32::MAX - 6..u32::MAX)), None, "beyond what a draw call counts from");
    }
}
