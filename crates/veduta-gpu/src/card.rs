//! A graphics card: buffers, kernels, and whether it is still there.

use std::sync::{Arc, Mutex, PoisonError};

use wgpu::util::{BufferInitDescriptor, DeviceExt};

use crate::error::GpuError;

/// Workgroups along one dimension at most.
const MOST_GROUPS: u32 = 65_535;

/// An open graphics card.
pub struct Card {
    device: wgpu::Device,
    queue: wgpu::Queue,
    name: String,
    /// Why it cannot be used any more.
    fault: Arc<Mutex<Option<String>>>,
}

/// A compiled entry point.
pub struct Kernel(wgpu::ComputePipeline);

impl Card {
    /// The fastest one. software: adapters that compute on the processor are good enough, which tests
    /// want and nobody else.
    pub fn open(software: bool) -> Result<Self, GpuError> {
        let instance = wgpu::Instance::new(&wgpu::InstanceDescriptor {
            backends: wgpu::Backends::PRIMARY,
            ..Default::default()
        });
        let mut adapters = instance.enumerate_adapters(wgpu::Backends::PRIMARY);
        let rank = |adapter: &wgpu::Adapter| match adapter.get_info().device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Other => 3,
            wgpu::DeviceType::Cpu => 4,
        };
        adapters.sort_by_key(rank);
        let Some(adapter) = adapters.first() else {
            return Err(GpuError::None);
        };
        let name = adapter.get_info().name;
        if rank(adapter) == 4 && !software {
            return Err(GpuError::Software(name));
        }
        Self::opened(adapter, name)
    }

    fn opened(adapter: &wgpu::Adapter, name: String) -> Result<Self, GpuError> {
        let given = adapter.limits();
        let limits = wgpu::Limits {
            max_storage_buffer_binding_size: given.max_storage_buffer_binding_size,
            max_buffer_size: given.max_buffer_size,
            ..wgpu::Limits::default()
        };
        let wanted = wgpu::DeviceDescriptor {
            required_limits: limits,
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&wanted)).map_err(|why| {
                GpuError::Closed {
                    name: name.clone(),
                    why: why.to_string(),
                }
            })?;
        let fault = Arc::new(Mutex::new(None));
        let told = Arc::clone(&fault);
        device.on_uncaptured_error(Box::new(move |why| tell(&told, &why.to_string())));
        let told = Arc::clone(&fault);
        device.set_device_lost_callback(move |_, why| tell(&told, &why));
        Ok(Self {
            device,
            queue,
            name,
            fault,
        })
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// Bytes of one buffer at most.
    pub fn most_bytes(&self) -> u64 {
        let limits = self.device.limits();
        u64::from(limits.max_storage_buffer_binding_size).min(limits.max_buffer_size)
    }

    /// Gives the card back: whoever still uses it finds that it vanished.
    pub fn destroy(&self) {
        self.device.destroy();
        tell(&self.fault, "it was given back");
    }

    /// Why the card cannot be used any more, if so.
    pub fn check(&self) -> Result<(), GpuError> {
        let fault = self.fault.lock().unwrap_or_else(PoisonError::into_inner);
        match fault.as_ref() {
            Some(why) => Err(GpuError::Lost(why.clone())),
            None => Ok(()),
        }
    }

    pub fn kernel(&self, source: &str, entry: &str) -> Kernel {
        let module = self
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(entry),
                source: wgpu::ShaderSource::Wgsl(source.into()),
            });
        Kernel(
            self.device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(entry),
                    layout: None,
                    module: &module,
                    entry_point: Some(entry),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    cache: None,
                }),
        )
    }

    fn require(&self, needed: u64) -> Result<(), GpuError> {
        let most = self.most_bytes();
        self.check()?;
        if needed > most {
            return Err(GpuError::TooLarge { needed, most });
        }
        Ok(())
    }

    /// A buffer with values, at least 16 bytes long.
    pub fn given<T: bytemuck::NoUninit>(&self, values: &[T]) -> Result<wgpu::Buffer, GpuError> {
        let mut bytes = bytemuck::cast_slice(values).to_vec();
        self.require(bytes.len() as u64)?;
        bytes.resize(bytes.len().next_multiple_of(4).max(16), 0);
        Ok(self.device.create_buffer_init(&BufferInitDescriptor {
            label: None,
            contents: &bytes,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        }))
    }

    /// A buffer for so many values of four bytes.
    pub fn empty(&self, values: usize) -> Result<wgpu::Buffer, GpuError> {
        let size = 4 * values.max(4) as u64;
        self.require(size)?;
        Ok(self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        }))
    }

    /// Runs a kernel on so many workgroups; buffers are its bindings in order. Beyond what one
    /// dimension takes, workgroups go on along y.
    pub fn run(&self, kernel: &Kernel, buffers: &[&wgpu::Buffer], groups: usize) {
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let bound = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &kernel.0.get_bind_group_layout(0),
            entries: &entries,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&kernel.0);
            pass.set_bind_group(0, &bound, &[]);
            let groups = groups.max(1) as u32;
            let across = groups.min(MOST_GROUPS);
            pass.dispatch_workgroups(across, groups.div_ceil(across), 1);
        }
        self.queue.submit([encoder.finish()]);
    }

    /// The first values of a buffer, once all that was asked for is done.
    pub fn read<T: bytemuck::AnyBitPattern>(
        &self,
        buffer: &wgpu::Buffer,
        values: usize,
    ) -> Result<Vec<T>, GpuError> {
        self.check()?;
        if values == 0 {
            return Ok(Vec::new());
        }
        let bytes = values * size_of::<T>();
        let size = (bytes as u64).next_multiple_of(4);
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, size);
        self.queue.submit([encoder.finish()]);
        let (send, receive) = std::sync::mpsc::channel();
        let slice = staging.slice(..);
        slice.map_async(wgpu::MapMode::Read, move |done| {
            // Nobody listens any more where the wait below failed.
            let _ = send.send(done);
        });
        self.device
            .poll(wgpu::PollType::Wait)
            .map_err(|why| self.lost(&why.to_string()))?;
        match receive.recv() {
            Ok(Ok(())) => {}
            Ok(Err(why)) => return Err(self.lost(&why.to_string())),
            Err(why) => return Err(self.lost(&why.to_string())),
        }
        self.check()?;
        let mapped = slice.get_mapped_range();
        // Bytes of a mapping need not begin where a value may.
        Ok(mapped[..bytes]
            .chunks_exact(size_of::<T>())
            .map(bytemuck::pod_read_unaligned)
            .collect())
    }

    fn lost(&self, why: &str) -> GpuError {
        tell(&self.fault, why);
        GpuError::Lost(why.to_owned())
    }
}

fn tell(fault: &Mutex<Option<String>>, why: &str) {
    let mut told = fault.lock().unwrap_or_else(PoisonError::into_inner);
    told.get_or_insert_with(|| why.to_owned());
}
