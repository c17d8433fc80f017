//! The GPU: instance, adapter, device, and what became of it.

use std::sync::{Arc, Mutex, PoisonError};

use super::error::RenderError;

/// An open GPU, real or in software. Copies are of the same one.
#[derive(Clone)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// What it is called, and by which driver it runs.
    pub info: wgpu::AdapterInfo,
    adapter: wgpu::Adapter,
    failure: Arc<Mutex<Option<String>>>,
}

/// The backends to look for a GPU with: Vulkan, Metal and Direct3D 12, unless WGPU_BACKEND names others.
pub fn backends() -> wgpu::Backends {
    wgpu::Backends::from_env().unwrap_or(wgpu::Backends::PRIMARY)
}

impl Gpu {
    /// A texture of `size` `[px]` that is drawn to, and used for what else is said.
    pub(crate) fn target(
        &self,
        (label, size): (&str, [u32; 2]),
        format: wgpu::TextureFormat,
        others: wgpu::TextureUsages,
    ) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | others,
            view_formats: &[],
        })
    }

    /// The GPU of a test of parts, if there is one: none is a failure where one is required.
    #[cfg(test)]
    #[allow(clippy::panic, reason = "a test that cannot go on stops")]
    pub(crate) fn of_test() -> Option<Self> {
        match Gpu::headless() {
            Ok(gpu) => Some(gpu),
            Err(error) if std::env::var("WOBBLE_REQUIRE").is_ok_and(|all| all.contains("gpu")) => panic!("{error}"),
            Err(_) => None,
        }
    }

    /// Opens a GPU for off-screen work.
    ///
    /// Errors: no driver, or one that fails.
    pub fn headless() -> Result<Self, RenderError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        descriptor.backends = backends();
        let instance = wgpu::Instance::new(descriptor);
        Gpu::open(&instance, None)
    }

    /// Opens a GPU that can draw to `surface`, the fastest there is.
    ///
    /// Errors: no driver, or one that fails.
    pub fn open(instance: &wgpu::Instance, surface: Option<&wgpu::Surface<'_>>) -> Result<Self, RenderError> {
        let wanted = wgpu::RequestAdapterOptions {
            // A GPU goes before a driver in software; WGPU_POWER_PREF says otherwise.
            power_preference: wgpu::PowerPreference::from_env().unwrap_or(wgpu::PowerPreference::HighPerformance),
            compatible_surface: surface,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&wanted))
            .map_err(|error| RenderError::NoAdapter { reason: one_line(&error) })?;
        let info = adapter.get_info();
        if info.device_type == wgpu::DeviceType::Cpu {
            keep_freed_memory();
        }
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("wobble"),
            // Points and bonds are read from storage buffers as large as the adapter has them.
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| RenderError::NoDevice { adapter: info.name.clone(), reason: one_line(&error) })?;
        let failure = Arc::new(Mutex::new(None));
        let note = |failure: &Arc<Mutex<Option<String>>>, what: String| {
            failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(what);
        };
        let seen = Arc::clone(&failure);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| note(&seen, one_line(&error))));
        let seen = Arc::clone(&failure);
        device.set_device_lost_callback(move |reason, message| {
            // Giving the device back at the end is no failure.
            if reason != wgpu::DeviceLostReason::Destroyed {
                note(&seen, message);
            }
        });
        Ok(Gpu { device, queue, info, adapter, failure })
    }

    /// Takes note of a failure that the driver reported since the last call.
    ///
    /// Errors: that failure.
    pub fn check(&self) -> Result<(), RenderError> {
        match self.failure.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(reason) => Err(RenderError::Lost { reason }),
            None => Ok(()),
        }
    }

    /// Largest side of a picture `[px]`.
    pub fn largest_side(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }

    /// Largest storage buffer that a shader can read `[bytes]`.
    pub fn largest_buffer(&self) -> u64 {
        let limits = self.device.limits();
        limits.max_buffer_size.min(limits.max_storage_buffer_binding_size)
    }

    /// What a surface can do with this GPU.
    pub fn surface_capabilities(&self, surface: &wgpu::Surface<'_>) -> wgpu::SurfaceCapabilities {
        surface.get_capabilities(&self.adapter)
    }

    /// A configuration that the surface takes, if it takes any.
    pub fn surface_config(
        &self,
        surface: &wgpu::Surface<'_>,
        [width, height]: [u32; 2],
    ) -> Option<wgpu::SurfaceConfiguration> {
        surface.get_default_config(&self.adapter, width, height)
    }
}

/// Largest block after which the allocator of Linux (glibc) raises its thresholds `[bytes]`: 32 MiB on machines of 64 bits, less what goes with a block.
const LARGEST_RAISED: usize = (32 << 20) - (64 << 10);

/// Makes the allocator keep what a picture frees for the next one. A driver in software allocates some ten megabytes for each; by itself glibc
/// gives them back to the system after it, and a tenth of a picture's time goes for pages that come anew. A block that is freed raises what is kept
/// to twice its size. Other allocators take no notice, and memory that is never written to costs nothing.
fn keep_freed_memory() {
    drop(std::hint::black_box(Vec::<u8>::with_capacity(LARGEST_RAISED)));
}

fn one_line(error: &dyn std::fmt::Display) -> String {
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}
