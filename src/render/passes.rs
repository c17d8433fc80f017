//! The passes of a picture: guides, bonds, points, region, each a shader of its own over the same bindings.
//!
//! In the plane what is drawn later lies on top. In space the pixels that a shape fills are drawn first and write their
//! depth; those at its edges, which it shares with what lies behind, are drawn over them and only look at the depth.

use super::buffers::WorldBuffers;
use super::gpu::Gpu;

/// A shader with what all of them share in front.
macro_rules! shader {
    ($name:literal) => {
        concat!(
            include_str!("../../shaders/common.wgsl"),
            include_str!("../../shaders/shapes.wgsl"),
            include_str!(concat!("../../shaders/", $name, ".wgsl")),
        )
    };
}

/// The shaders as they are compiled: name, and source with what all of them share in front.
pub const SHADERS: [(&str, &str); 4] = [
    ("guides", shader!("guides")),
    ("bonds", shader!("bonds")),
    ("points", shader!("points")),
    ("region", shader!("region")),
];

/// The passes, as indices of [`SHADERS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pass {
    Guides,
    Bonds,
    Points,
    Region,
}

impl Pass {
    pub(super) const ALL: [Pass; 4] = [Pass::Guides, Pass::Bonds, Pass::Points, Pass::Region];

    /// Vertices that the pass draws: six a quad, three a disc.
    pub(super) fn vertices(self, buffers: &WorldBuffers, has_region: bool) -> u32 {
        match self {
            Pass::Guides => 6 * buffers.guide_count,
            Pass::Bonds => 6 * buffers.bond_count,
            Pass::Points => 3 * buffers.point_count,
            Pass::Region => 6 * u32::from(has_region),
        }
    }
}

/// Which pixels of a shape a pipeline draws: `PART` in shapes.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    /// All of them, where depth is no matter.
    All,
    /// Those that it fills: they write their depth.
    Core,
    /// Those at its edges: they are hidden by others, but hide nothing.
    Fringe,
}

/// What is drawn, in order.
fn layers(dimensions: usize) -> Vec<(Pass, Part)> {
    let solid = [Pass::Guides, Pass::Bonds, Pass::Points];
    let parts: &[Part] = if dimensions == 3 { &[Part::Core, Part::Fringe] } else { &[Part::All] };
    let solid = parts.iter().flat_map(|&part| solid.map(|pass| (pass, part)));
    solid.chain([(Pass::Region, Part::All)]).collect()
}

/// Format of the depth of scenes in space.
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Pipelines and bindings of all passes.
pub(super) struct Passes {
    /// In the order that they are drawn in.
    pipelines: Vec<(Pass, wgpu::RenderPipeline)>,
    layout: wgpu::BindGroupLayout,
    bindings: Option<[wgpu::BindGroup; 4]>,
}

impl Passes {
    /// For worlds of `dimensions` drawn to a target of `format`.
    pub(super) fn new(gpu: &Gpu, format: wgpu::TextureFormat, dimensions: usize) -> Self {
        let layout = bindings_layout(&gpu.device);
        let modules = Pass::ALL.map(|pass| module(&gpu.device, pass));
        let layers = layers(dimensions).into_iter();
        let pipelines = layers.map(|(pass, part)| {
            (pass, pipeline(&gpu.device, &layout, &modules[pass as usize], (pass, part), format, dimensions))
        });
        let pipelines = pipelines.collect();
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
        for &(pass, ref pipeline) in &self.pipelines {
            let vertices = pass.vertices(buffers, has_region);
            if vertices > 0 {
                target.set_pipeline(pipeline);
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

fn module(device: &wgpu::Device, pass: Pass) -> wgpu::ShaderModule {
    let (name, source) = SHADERS[pass as usize];
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(name),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    module: &wgpu::ShaderModule,
    (pass, part): (Pass, Part),
    format: wgpu::TextureFormat,
    dimensions: usize,
) -> wgpu::RenderPipeline {
    let (name, _) = SHADERS[pass as usize];
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(name),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    let constants = [("DIMENSIONS", dimensions as f64), ("PART", f64::from(part as u32))];
    let options = || wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    // The region lies over everything; in the plane, what is drawn later does.
    let depth = (dimensions == 3).then(|| wgpu::DepthStencilState {
        format: DEPTH,
        depth_write_enabled: Some(part == Part::Core),
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
        vertex: wgpu::VertexState { module, entry_point: Some("vertex"), compilation_options: options(), buffers: &[] },
        fragment: Some(wgpu::FragmentState {
            module,
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
