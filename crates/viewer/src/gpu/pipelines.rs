//! The pipelines: shaders with their state.

use eframe::wgpu;

use super::geometry::{LineInstance, PatchVertex};
use super::target::{DEPTH, FORMAT, SAMPLES};

pub(super) struct Pipelines {
    pub(super) globals_layout: wgpu::BindGroupLayout,
    pub(super) object_layout: wgpu::BindGroupLayout,
    pub(super) chunk_layout: wgpu::BindGroupLayout,
    pub(super) background: wgpu::RenderPipeline,
    pub(super) surface: wgpu::RenderPipeline,
    /// Draws only the lines of surfaces.
    pub(super) wire: wgpu::RenderPipeline,
    pub(super) line: wgpu::RenderPipeline,
    /// Draws the parts of lines that surfaces hide.
    pub(super) hidden: wgpu::RenderPipeline,
    /// Draws colored triangles on surfaces.
    pub(super) patch: wgpu::RenderPipeline,
}

/// The settings in which the pipelines differ.
struct Kind<'a> {
    name: &'a str,
    vertex: &'a str,
    fragment: &'a str,
    buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    is_strip: bool,
    blends: bool,
    writes_depth: bool,
    compare: wgpu::CompareFunction,
}

impl Pipelines {
    #[expect(clippy::too_many_lines, reason = "a list of pipelines")]
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let module = device.create_shader_module(wgpu::include_wgsl!("shader.wgsl"));
        let both = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries,
            })
        };
        let uniform = |has_dynamic_offset| wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: both,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset,
                min_binding_size: None,
            },
            count: None,
        };
        let storage = |binding| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: true },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let globals_layout = layout("globals", &[uniform(false)]);
        let object_layout = layout("object", &[uniform(true)]);
        let of_fragments = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        let texture = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: true },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let buffers = (0..5).map(storage);
        let chunk_entries: Vec<_> = buffers
            .chain([of_fragments(5, texture), of_fragments(6, sampler)])
            .collect();
        let chunk_layout = layout("chunk", &chunk_entries);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[
                Some(&globals_layout),
                Some(&object_layout),
                Some(&chunk_layout),
            ],
            immediate_size: 0,
        });
        let lines_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&globals_layout), Some(&object_layout)],
            immediate_size: 0,
        });
        let background_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&globals_layout)],
            immediate_size: 0,
        });
        let create = |kind: &Kind| create(device, &module, &pipeline_layout, kind);
        let create_line = |kind: &Kind| self::create(device, &module, &lines_layout, kind);
        let surface = Kind {
            name: "surface",
            vertex: "surface_vertex",
            fragment: "surface_fragment",
            buffers: &[],
            is_strip: false,
            blends: false,
            writes_depth: true,
            compare: wgpu::CompareFunction::Less,
        };
        let lines = [Some(wgpu::VertexBufferLayout {
            array_stride: size_of::<LineInstance>() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x4, 3 => Unorm8x4],
        })];
        let line = Kind {
            name: "line",
            vertex: "line_vertex",
            fragment: "line_fragment",
            buffers: &lines,
            is_strip: true,
            blends: true,
            writes_depth: false,
            compare: wgpu::CompareFunction::LessEqual,
        };
        let corners = [Some(wgpu::VertexBufferLayout {
            array_stride: size_of::<PatchVertex>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Unorm8x4],
        })];
        Self {
            background: self::create(
                device,
                &module,
                &background_layout,
                &Kind {
                    name: "background",
                    vertex: "background_vertex",
                    fragment: "background_fragment",
                    writes_depth: false,
                    compare: wgpu::CompareFunction::Always,
                    ..surface
                },
            ),
            surface: create(&surface),
            wire: create(&Kind {
                name: "wire",
                blends: true,
                writes_depth: false,
                compare: wgpu::CompareFunction::Always,
                ..surface
            }),
            line: create_line(&line),
            hidden: create_line(&Kind {
                name: "hidden",
                fragment: "hidden_fragment",
                compare: wgpu::CompareFunction::Greater,
                ..line
            }),
            patch: create_line(&Kind {
                name: "patch",
                vertex: "patch_vertex",
                fragment: "patch_fragment",
                buffers: &corners,
                is_strip: false,
                compare: wgpu::CompareFunction::LessEqual,
                ..line
            }),
            globals_layout,
            object_layout,
            chunk_layout,
        }
    }
}

fn create(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    kind: &Kind,
) -> wgpu::RenderPipeline {
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(kind.name),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(kind.vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: kind.buffers,
        },
        primitive: wgpu::PrimitiveState {
            topology: if kind.is_strip {
                wgpu::PrimitiveTopology::TriangleStrip
            } else {
                wgpu::PrimitiveTopology::TriangleList
            },
            ..wgpu::PrimitiveState::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(kind.writes_depth),
            depth_compare: Some(kind.compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState {
            count: SAMPLES,
            // Alpha-to-coverage has no effect on an opaque surface, whose alpha is 1.
            alpha_to_coverage_enabled: !kind.blends,
            ..wgpu::MultisampleState::default()
        },
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(kind.fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: FORMAT,
                blend: kind.blends.then_some(wgpu::BlendState::ALPHA_BLENDING),
                // The alpha of the picture is not written, so the picture stays opaque where a surface is transparent.
                write_mask: wgpu::ColorWrites::COLOR,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
