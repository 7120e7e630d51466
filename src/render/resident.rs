//! [`Prepared`] → [`Resident`]: the buffers of a scene on the device.

use crate::Result;
use crate::gpu::{Buffer, Gpu};
use crate::prepare::Prepared;
use std::sync::Arc;

/// The buffers that the kernels read of a scene, by the names of the table of bindings.
pub struct Resident {
    buffers: Vec<(&'static str, Arc<Buffer>)>,
}

impl Resident {
    /// Puts a prepared scene on the device. It is taken apart on the way, so that host and device do not both hold it.
    pub fn upload(gpu: &Gpu, prepared: &mut Prepared) -> Result<Self> {
        let mut buffers = Vec::new();
        let mut put = |name: &'static str, bytes: &[u8]| -> Result<()> {
            if !bytes.is_empty() {
                buffers.push((name, gpu.upload(name, bytes)?));
            }
            Ok(())
        };
        put("tree", bytemuck::cast_slice(&std::mem::take(&mut prepared.tree)))?;
        let (faces, corners) = (std::mem::take(&mut prepared.faces), std::mem::take(&mut prepared.corners));
        let faces: &[u8] = bytemuck::cast_slice(&faces);
        if corners.is_empty() {
            put("faces", faces)?;
        } else {
            put("faces", &[faces, bytemuck::cast_slice(&corners)].concat())?;
        }
        let instances: &[u8] = bytemuck::cast_slice(&prepared.instances);
        let motions: &[u8] = bytemuck::cast_slice(&prepared.motions);
        put("instances", &[instances, motions, bytemuck::cast_slice(&prepared.shapes)].concat())?;
        put("vertices", bytemuck::cast_slice(&std::mem::take(&mut prepared.vertices)))?;
        let materials: &[u8] = bytemuck::cast_slice(&prepared.materials);
        put("materials", &[materials, bytemuck::cast_slice(&prepared.interfaces)].concat())?;
        put("details", bytemuck::cast_slice(&prepared.details))?;
        put("textures", bytemuck::cast_slice(&prepared.textures))?;
        put("texels", bytemuck::cast_slice(&std::mem::take(&mut prepared.texels)))?;
        put("lights", bytemuck::cast_slice(&prepared.lights))?;
        put("environment", bytemuck::cast_slice(&std::mem::take(&mut prepared.environment)))?;
        put("lens", bytemuck::cast_slice(&std::mem::take(&mut prepared.lens.words)))?;
        Ok(Self { buffers })
    }

    /// The buffers with their names.
    pub fn buffers(&self) -> impl Iterator<Item = (&'static str, &Arc<Buffer>)> {
        self.buffers.iter().map(|(name, buffer)| (*name, buffer))
    }
}
