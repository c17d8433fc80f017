//! The passes of a picture: the floor, guides, obstacles, balls and boxes, fills, skins, bonds, points, region, each a shader of its own over the same bindings.
//!
//! In the plane what is drawn later lies on top. In space the pixels that a shape fills are drawn first and write their
//! depth; those at its edges, which it shares with what lies behind, are drawn over them and only look at the depth.

use std::ops::Range;

use super::buffers::{BOUND, WorldBuffers};
use super::chunks::{CHUNK, Run};
use super::counters::RenderCounters;
use super::fills::{Fills, Kinds};
use super::gpu::Gpu;
use super::obstacles::{COVER, Obstacles, SHARES};
use super::quads::{QUAD, Quads};
use super::seen_forms::Forms;
use super::skin::Skins;

/// A shader with what all of them share in front.
macro_rules! shader {
    ($name:literal) => {
        concat!(
            include_str!("../../shaders/common.wgsl"),
            include_str!("../../shaders/shapes.wgsl"),
            include_str!("../../shaders/discs.wgsl"),
            include_str!(concat!("../../shaders/", $name, ".wgsl")),
        )
    };
}

/// The shaders as they are compiled: name, and source with what all of them share in front.
pub const SHADERS: [(&str, &str); 9] = [
    ("guides", shader!("guides")),
    ("bonds", shader!("bonds")),
    ("points", shader!("points")),
    ("region", shader!("region")),
    ("solids", shader!("solids")),
    ("floor", shader!("floor")),
    ("skin", shader!("skin")),
    ("obstacles", shader!("obstacles")),
    ("fill", shader!("fill")),
];

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pass {
    Guides,
    /// Dots that stand for bonds.
    Dots,
    /// Bonds as strokes.
    Strokes,
    /// The same by a triangle around each, in the plane, where they are short and none has a form.
    ShortStrokes,
    Points,
    Region,
    /// Balls and boxes, in space.
    Solids,
    /// The floor, in space, and the part of it that its shadow lies on.
    Floor,
    Shadow,
    /// What of pictures is beside triangles.
    SkinRind,
    /// Pictures on triangles.
    Skin,
    /// Their free sides.
    SkinEdges,
    /// What bodies without a picture cover.
    Fill,
    /// How much of each pixel obstacles cover.
    Cover,
    /// That alone, and their rims along edges, or everywhere.
    Plain,
    Edges,
    Rim,
    /// Obstacles, from that.
    Obstacles,
}

/// Vertices of a disc, and of a short stroke.
const TRIANGLE: u32 = 3;

impl Pass {
    /// Its shader, as an index of [`SHADERS`].
    fn shader(self) -> usize {
        match self {
            Pass::Guides => 0,
            Pass::Dots | Pass::Strokes | Pass::ShortStrokes => 1,
            Pass::Points => 2,
            Pass::Region => 3,
            Pass::Solids => 4,
            Pass::Floor | Pass::Shadow => 5,
            Pass::SkinRind | Pass::Skin | Pass::SkinEdges => 6,
            Pass::Cover | Pass::Plain | Pass::Edges | Pass::Rim | Pass::Obstacles => 7,
            Pass::Fill => 8,
        }
    }

    fn entry_points(self) -> [&'static str; 2] {
        match self {
            Pass::Dots => ["dot_vertex", "dot_fragment"],
            Pass::ShortStrokes => ["short_vertex", "fragment"],
            Pass::Shadow => ["vertex", "shadow_fragment"],
            Pass::SkinRind => ["rind_vertex", "fragment"],
            Pass::SkinEdges => ["edge_vertex", "edge_fragment"],
            Pass::Cover => ["cover_vertex", "cover_fragment"],
            Pass::Plain => ["vertex", "plain_fragment"],
            Pass::Edges => ["edge_vertex", "rim_fragment"],
            Pass::Rim => ["vertex", "rim_fragment"],
            _ => ["vertex", "fragment"],
        }
    }

    /// Whether it may show a map by colours: its shader is another then, for a driver without a GPU works out both sides of a branch.
    fn has_maps(self) -> bool {
        matches!(self, Pass::Dots | Pass::Strokes | Pass::ShortStrokes | Pass::Points | Pass::Fill)
    }

    /// What it shows of the forms of bonds where any of it is seen: likewise.
    fn forms(self) -> Forms {
        match self {
            Pass::Strokes => Forms::All,
            Pass::ShortStrokes => Forms::Stretched,
            _ => Forms::None,
        }
    }

    /// How what it draws is put on what is there: cover is added up, rims take their place, all else lies on top.
    fn blend(self) -> wgpu::BlendState {
        let one = wgpu::BlendFactor::One;
        let sum = wgpu::BlendComponent { src_factor: one, dst_factor: one, operation: wgpu::BlendOperation::Add };
        match self {
            Pass::Cover => wgpu::BlendState { color: sum, alpha: sum },
            Pass::Plain | Pass::Edges | Pass::Rim => wgpu::BlendState::REPLACE,
            _ => wgpu::BlendState::ALPHA_BLENDING,
        }
    }

    /// Its draw calls: vertices and instances of each.
    fn calls(self, buffers: &WorldBuffers, has_region: bool) -> Vec<[Range<u32>; 2]> {
        let selection = &buffers.selection;
        let mut calls = match self {
            Pass::Guides => vec![[0..QUAD * buffers.guide_counts[0], 0..1]],
            Pass::Dots => selection.dots.iter().map(|run| call(run, TRIANGLE)).collect(),
            Pass::Strokes if !buffers.are_short => selection.strokes.iter().map(|run| call(run, QUAD)).collect(),
            Pass::ShortStrokes if buffers.are_short => {
                selection.strokes.iter().map(|run| call(run, TRIANGLE)).collect()
            }
            Pass::Points => {
                selection.points.iter().map(|range| [TRIANGLE * range.start..TRIANGLE * range.end, 0..1]).collect()
            }
            Pass::Region => vec![[0..QUAD * u32::from(has_region), 0..1]],
            Pass::Solids => vec![[0..QUAD * buffers.solid_count, 0..1]],
            _ => Vec::new(),
        };
        calls.retain(|[vertices, _]| !vertices.is_empty());
        calls
    }
}

/// The draw call of some bonds: instances are chunks, of which each draws its first few.
fn call(run: &Run, vertices: u32) -> [Range<u32>; 2] {
    if run.chunks == 1 {
        return [vertices * run.first..vertices * (run.first + run.count), 0..1];
    }
    let chunk = run.first / CHUNK as u32;
    [0..vertices * run.count, chunk..chunk + run.chunks]
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

/// Outlines lie on the edges of their fills: a little nearer, they are not cut by them.
const OVER_FILLS: wgpu::DepthBiasState = wgpu::DepthBiasState { constant: -64, slope_scale: -2.0, clamp: 0.0 };

/// What is drawn, in order.
fn layers(dimensions: usize) -> Vec<(Pass, Part)> {
    let solid: &[Pass] = match dimensions {
        3 => &[Pass::Guides, Pass::Solids, Pass::Dots, Pass::Strokes, Pass::Points],
        _ => &[Pass::Guides, Pass::Dots, Pass::Strokes, Pass::ShortStrokes, Pass::Points],
    };
    let parts: &[Part] = if dimensions == 3 { &[Part::Core, Part::Fringe] } else { &[Part::All] };
    let solid = parts.iter().flat_map(|&part| solid.iter().map(move |&pass| (pass, part)));
    solid.chain([(Pass::Region, Part::All)]).collect()
}

/// Format of the depth of scenes in space.
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// What of a picture is shown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown {
    /// The region of the mouse force.
    pub(super) region: bool,
    /// Fills and skins.
    pub(super) fills: bool,
    /// A map by colours, in place of skins.
    pub(super) map: bool,
    /// What is seen of the forms of bonds.
    pub(super) forms: Forms,
}

/// Pipelines and bindings of all passes. Copies share the pipelines.
#[derive(Clone)]
pub(super) struct Passes {
    /// In the order that they are drawn in, each without forms of bonds and with them, both without a map by colours and with one.
    pipelines: Vec<(Pass, [[wgpu::RenderPipeline; 2]; 2])>,
    /// Of the floor and its shadow, below all else. In space alone.
    floor: Option<[wgpu::RenderPipeline; 2]>,
    /// Of fills, by what is drawn of them, likewise: below the skins.
    fill: [[wgpu::RenderPipeline; Kinds::ALL.len()]; 2],
    /// Of what of skins is beside triangles, of these, and of their edges: over the first guides.
    skin: [wgpu::RenderPipeline; 3],
    /// What obstacles cover, that alone, their rims along edges and everywhere, and all as it is shown: below the skins. In the plane alone.
    obstacles: Option<[wgpu::RenderPipeline; 5]>,
    quads: Quads,
    layout: wgpu::BindGroupLayout,
    bindings: Option<[wgpu::BindGroup; 6]>,
}

impl Passes {
    /// For worlds of `dimensions` drawn to a target of `format`.
    ///
    /// `own` are the layouts of what skins, obstacles and fills bind beside the world's buffers.
    pub(super) fn new(
        gpu: &Gpu,
        format: wgpu::TextureFormat,
        dimensions: usize,
        own: [&wgpu::BindGroupLayout; 3],
    ) -> Self {
        let layout = bindings_layout(&gpu.device);
        let modules = SHADERS.map(|shader| module(&gpu.device, shader));
        let layers = layers(dimensions).into_iter();
        let own_to_world = [&layout];
        let pipelines = layers.map(|(pass, part)| {
            let made = |forms: Forms, maps: bool| {
                let what = (pass, part, maps, forms, Kinds::Any);
                pipeline(&gpu.device, &own_to_world, &modules[pass.shader()], what, format, dimensions)
            };
            let both = |forms: Forms| {
                let plain = made(forms, false);
                let mapped = if pass.has_maps() { made(forms, true) } else { plain.clone() };
                [plain, mapped]
            };
            let bare = both(Forms::None);
            let formed = if pass.forms() == Forms::None { bare.clone() } else { both(pass.forms()) };
            (pass, [bare, formed])
        });
        let pipelines = pipelines.collect();
        let floor = (dimensions == 3).then(|| {
            [Pass::Floor, Pass::Shadow].map(|pass| {
                let what = (pass, Part::All, false, Forms::None, Kinds::Any);
                pipeline(&gpu.device, &own_to_world, &modules[pass.shader()], what, format, dimensions)
            })
        });
        // In space triangles hide what lies behind them.
        let solid = if dimensions == 3 { Part::Core } else { Part::All };
        let [worn, covered, filled] = own.map(|own| [&layout, own]);
        let parts = [(Pass::SkinRind, Part::All), (Pass::Skin, solid), (Pass::SkinEdges, Part::All)];
        let skin = parts.map(|(pass, part)| {
            pipeline(
                &gpu.device,
                &worn,
                &modules[pass.shader()],
                (pass, part, false, Forms::None, Kinds::Any),
                format,
                dimensions,
            )
        });
        let fill = [false, true].map(|maps| {
            Kinds::ALL.map(|kinds| {
                let part = if kinds == Kinds::Any { Part::All } else { solid };
                let what = (Pass::Fill, part, maps, Forms::None, kinds);
                pipeline(&gpu.device, &filled, &modules[Pass::Fill.shader()], what, format, dimensions)
            })
        });
        let obstacles = (dimensions == 2).then(|| {
            let [plain, edges, rim] = [Pass::Plain, Pass::Edges, Pass::Rim].map(|pass| (pass, SHARES, 2));
            let passes = [(Pass::Cover, COVER, 1), plain, edges, rim, (Pass::Obstacles, format, 2)];
            passes.map(|(pass, format, groups)| {
                let layouts = &covered[..groups];
                let what = (pass, Part::All, false, Forms::None, Kinds::Any);
                pipeline(&gpu.device, layouts, &modules[pass.shader()], what, format, dimensions)
            })
        });
        Passes { pipelines, floor, fill, skin, obstacles, quads: Quads::new(gpu), layout, bindings: None }
    }

    /// How the world's buffers are bound.
    pub(super) fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// Binds the buffers anew: one of them is another than before.
    pub(super) fn rebind(&mut self, gpu: &Gpu, buffers: &WorldBuffers) {
        // The region reads no list.
        let WorldBuffers { guides, bonds, points, solids, floor, .. } = buffers;
        let lists = [&guides.buffer, bonds, points, &guides.buffer, &solids.buffer, &floor.buffer];
        self.bindings = Some(std::array::from_fn(|shader| {
            buffers.bind(gpu, (SHADERS[shader].0, &self.layout), [&buffers.frame.buffer, lists[shader]])
        }));
    }

    /// Finds out what obstacles cover of a picture of `size` `[px]`, before it is drawn.
    pub(super) fn cover(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        obstacles: &mut Obstacles,
        size: [u32; 2],
        counters: &mut RenderCounters,
    ) {
        if let Some(pipelines) = &self.obstacles {
            obstacles.cover(gpu, encoder, pipelines, size, counters);
        }
    }

    /// Draws the passes that have something to draw.
    pub(super) fn draw(
        &self,
        target: &mut wgpu::RenderPass<'_>,
        (buffers, skins, obstacles, fills): (&WorldBuffers, &Skins, &Obstacles, &Fills),
        shown: Shown,
        counters: &mut RenderCounters,
    ) {
        let Some(bindings) = &self.bindings else { return };
        let map = usize::from(shown.map);
        let [below, over, marks] = buffers.guide_counts;
        if let Some([floor, shadow]) = &self.floor {
            let [has_floor, has_shadow] = buffers.has_floor;
            let quads = [(floor, 0..QUAD, has_floor), (shadow, QUAD..2 * QUAD, has_shadow)];
            for (pipeline, vertices, _) in quads.into_iter().filter(|(.., is_there)| *is_there) {
                target.set_pipeline(pipeline);
                target.set_bind_group(0, &bindings[Pass::Floor.shader()], &[]);
                target.draw(vertices, 0..1);
                counters.draws += 1;
            }
        }
        for (place, &(pass, ref pipelines)) in self.pipelines.iter().enumerate() {
            if place == 1 {
                if let Some(pipelines) = &self.obstacles {
                    obstacles.draw(target, pipelines, counters);
                }
                // They are read on ground, and bodies pass in front of them.
                self.draw_guides(target, below..below + over, counters);
                if shown.fills {
                    fills.draw(shown.map, target, (&self.fill[map], &self.quads), counters);
                }
                if shown.fills && !shown.map {
                    skins.draw(target, &self.skin, counters);
                }
            }
            let calls = pass.calls(buffers, shown.region);
            if calls.is_empty() {
                continue;
            }
            target.set_pipeline(&pipelines[usize::from(shown.forms != Forms::None)][map]);
            target.set_bind_group(0, &bindings[pass.shader()], &[]);
            counters.draws += calls.len() as u64;
            for [vertices, instances] in calls {
                match pass {
                    Pass::Strokes => self.quads.draw(target, vertices, instances),
                    _ => target.draw(vertices, instances),
                }
            }
        }
        self.draw_guides(target, below + over..below + over + marks, counters);
        let count = |runs: &[Run]| runs.iter().map(|run| u64::from(run.count) * u64::from(run.chunks)).sum::<u64>();
        counters.bonds_drawn += count(&buffers.selection.strokes);
        counters.dots_drawn += count(&buffers.selection.dots);
        counters.points_drawn += buffers.selection.points.iter().map(|range| range.len() as u64).sum::<u64>();
    }
}

impl Passes {
    /// Draws further guides: the numbers of the grid, which lie over obstacles and below bodies, or the marks of motors, over all else.
    fn draw_guides(&self, target: &mut wgpu::RenderPass<'_>, range: Range<u32>, counters: &mut RenderCounters) {
        let pipeline = self.pipelines.iter().find(|(pass, _)| *pass == Pass::Guides);
        let (Some((_, [[pipeline, _], _])), Some(bindings)) = (pipeline.filter(|_| !range.is_empty()), &self.bindings)
        else {
            return;
        };
        target.set_pipeline(pipeline);
        target.set_bind_group(0, &bindings[Pass::Guides.shader()], &[]);
        target.draw(QUAD * range.start..QUAD * range.end, 0..1);
        counters.draws += 1;
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
        entries: &std::array::from_fn::<_, BOUND, _>(|binding| entry(binding as u32)),
    })
}

fn module(device: &wgpu::Device, (name, source): (&str, &str)) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(name),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

fn pipeline(
    device: &wgpu::Device,
    layouts: &[&wgpu::BindGroupLayout],
    module: &wgpu::ShaderModule,
    (pass, part, maps, forms, kinds): (Pass, Part, bool, Forms, Kinds),
    format: wgpu::TextureFormat,
    dimensions: usize,
) -> wgpu::RenderPipeline {
    let (name, _) = SHADERS[pass.shader()];
    let [vertex, fragment] = match kinds {
        Kinds::Cells if !maps => ["cell_vertex", "cell_fragment"],
        _ => pass.entry_points(),
    };
    let layouts: Vec<_> = layouts.iter().copied().map(Some).collect();
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(name),
        bind_group_layouts: &layouts,
        immediate_size: 0,
    });
    let constants = [
        ("DIMENSIONS", dimensions as f64),
        ("PART", f64::from(part as u32)),
        ("MAPS", f64::from(u8::from(maps))),
        ("FORMS", f64::from(forms as u32)),
        ("KINDS", f64::from(kinds as u32)),
    ];
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
        bias: if pass == Pass::Fill && part == Part::All { OVER_FILLS } else { wgpu::DepthBiasState::default() },
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(name),
        layout: Some(&layout),
        vertex: wgpu::VertexState { module, entry_point: Some(vertex), compilation_options: options(), buffers: &[] },
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
            compilation_options: options(),
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend: Some(pass.blend()),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::order::INVERSE;

    #[test]
    fn the_shader_knows_how_chunks_lie() {
        let source = SHADERS[Pass::Dots.shader()].1;
        for line in [format!("const CHUNK: u32 = {CHUNK}u;"), format!("const NEIGHBOR: u32 = {INVERSE}u;")] {
            assert!(source.contains(&line), "{line}");
        }
    }

    #[test]
    fn a_run_is_a_draw_call() {
        let [one, many] = [(1, 1024), (3, 64)].map(|(chunks, count)| Run { first: 2048, count, chunks });
        assert_eq!(call(&one, QUAD), [6 * 2048..6 * 3072, 0..1]);
        assert_eq!(call(&many, TRIANGLE), [0..3 * 64, 2..5]);
    }
}
