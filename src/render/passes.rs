//! The passes of a picture: guides, bonds, points, region, each a shader of its own over the same bindings.

use super::buffers::WorldBuffers;
use super::gpu::Gpu;

/// The shaders as they are compiled: name, and source with what all of them share in front.
pub const SHADERS: [(&str, &str); 4] = [
    ("guides", concat!(include_str!("../../shaders/common.wgsl"), include_str!("../../shaders/guides.wgsl"))),
    ("bonds", concat!(include_str!("../../shaders/common.wgsl"), include_str!("../../shaders/bonds.wgsl"))),
    ("points", concat!(include_str!("../../shaders/common.wgsl"), include_str!("../../shaders/points.wgsl"))),
    ("region", concat!(include_str!("../../shaders/common.wgsl"), include_str!("../../shaders/region.wgsl"))),
];

/// The passes in the order that they are drawn in, as indices of [`SHADERS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pass {
    Guides,
    Bonds,
    Points,
    Region,
}

impl Pass {
    pub(super) const ALL: [Pass; 4] = [Pass::Guides, Pass::Bonds, Pass::Points, Pass::Region];

    /// Vertices that the pass draws: six a quad.
    pub(super) fn vertices(self, buffers: &WorldBuffers, has_region: bool) -> u32 {
        6 * match self {
            Pass::Guides => buffers.guide_count,
            Pass::Bonds => buffers.bond_count,
            Pass::Points => buffers.point_count,
            Pass::Region => u32::from(has_region),
        }
    }
}

/// Format of the depth of scenes in space.
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Pipelines and bindings of all passes.
pub(super) struct Passes {
    pipelines: [wgpu::RenderPipeline; 4],
    layout: wgpu::BindGroupLayout,
    bindings: Option<[wgpu::BindGroup; 4]>,
}

impl Passes {
    /// For worlds of `dimensions` drawn to a target of `format`.
    pub(super) fn new(gpu: &Gpu, format: wgpu::TextureFormat, dimensions: usize) -> Self {
        let layout = bindings_layout(&gpu.device);
        let pipelines = Pass::ALL.map(|pass| pipeline(&gpu.device, &layout, pass, format, dimensions));
        Passes { pipelines, layout, bindings: None }
    }

    /// Binds the buffers anew: one of them is another than before.
    pub(super) fn rebind(&mut self, gpu: &Gpu, buffers: &WorldBuffers) {
        self.bindings = Some(Pass::ALL.map(|pass| {
            let list = match pass {
                Pass::Guides | Pass::Region => &buffers.guides,
                Pass::Bonds => &buffers.bonds,
                Pass::Points => &buffers.pinned,
            };
            let entries = [&buffers.frame, &buffers.previous, &buffers.current, list];
            let entry =
                |i: usize| wgpu::BindGroupEntry { binding: i as u32, resource: entries[i].buffer.as_entire_binding() };
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(SHADERS[pass as usize].0),
                layout: &self.layout,
                entries: &[entry(0), entry(1), entry(2), entry(3)],
            })
        }));
    }

    /// Draws the passes that have something to draw; returns how many draw calls that took.
    pub(super) fn draw(&self, target: &mut wgpu::RenderPass<'_>, buffers: &WorldBuffers, has_region: bool) -> u64 {
        let Some(bindings) = &self.bindings else { return 0 };
        let mut draws = 0;
        for pass in Pass::ALL {
            let vertices = pass.vertices(buffers, has_region);
            if vertices > 0 {
                target.set_pipeline(&self.pipelines[pass as usize]);
                target.set_bind_group(0, &bindings[pass as usize], &[]);
                target.draw(0..vertices, 0..1);
                draws += 1;
            }
        }
        draws
    }
}

fn bindings_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entry = |binding: u32| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: match binding {
                0 => wgpu::BufferBindingType::Uniform,
                _ => wgpu::BufferBindingType::Storage { read_only: true },
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("world"),
        entries: &[entry(0), entry(1), entry(2), entry(3)],
    })
}

fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    pass: Pass,
    format: wgpu::TextureFormat,
    dimensions: usize,
) -> wgpu::RenderPipeline {
    let (name, source) = SHADERS[pass as usize];
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(name),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(name),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    let constants = [("DIMENSIONS", dimensions as f64)];
    let options = || wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    // The region lies over everything; in the plane, what is drawn later does.
    let depth = (dimensions == 3).then(|| wgpu::DepthStencilState {
        format: DEPTH,
        depth_write_enabled: Some(pass != Pass::Region),
        depth_compare: Some(if pass == Pass::Region {
            wgpu::CompareFunction::Always
        } else {
            wgpu::CompareFunction::LessEqual
        }),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(name),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: options(),
            buffers: &[],
        },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: options(),
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend: Some(wgpu::BlendState::ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: depth,
        multisample: wgpu::MultisampleState::default(),
        multiview_mask: None,
        cache: None,
    })
}
