//! [`Prepared`] → [`Resident`]: the buffers of a scene on the device.

use super::uploads::Uploads;
use crate::Result;
use crate::gpu::{Buffer, Gpu};
use crate::prepare::{Atlas, Prepared};
use crate::scene::{Handle, Image, Store};
use std::sync::Arc;

/// Puts the pictures of an atlas on the device, page by page.
pub(super) fn upload_texels(
    gpu: &Gpu,
    atlas: &Atlas,
    picture: impl FnMut(Handle<Image>) -> Arc<Image>,
) -> Result<Arc<Buffer>> {
    let word = size_of::<[u32; 4]>();
    gpu.upload_parts("texels", (atlas.words() * word) as u64, |write| {
        atlas.fill(picture, |first, words| write((first * word) as u64, bytemuck::cast_slice(words)))
    })
}

/// The buffers that the kernels read of a scene, by the names of the table of bindings.
pub struct Resident {
    buffers: Vec<(&'static str, Arc<Buffer>)>,
}

impl Resident {
    /// Puts a prepared scene and its pictures on the device, but for what is there already. Both are taken apart on the way, so that host and device do not both
    /// hold them.
    ///
    /// # Errors
    /// When it is larger than the memory or the buffers of the device.
    pub fn upload(
        gpu: &Gpu,
        prepared: Prepared,
        images: Store<Image>,
        uploads: &mut Uploads,
    ) -> Result<Self> {
        uploads.begin();
        let mut buffers = Vec::new();
        let mut put = |name: &'static str, bytes: &[u8]| -> Result<()> {
            if !bytes.is_empty() {
                buffers.push((name, uploads.put(gpu, name, bytes)?));
            }
            Ok(())
        };
        put("tree", bytemuck::cast_slice(&prepared.tree))?;
        let (faces, corners) = (prepared.faces, prepared.corners);
        let faces: &[u8] = bytemuck::cast_slice(&faces);
        if corners.is_empty() {
            put("faces", faces)?;
        } else {
            put("faces", &[faces, bytemuck::cast_slice(&corners)].concat())?;
        }
        let instances: &[u8] = bytemuck::cast_slice(&prepared.instances);
        let motions: &[u8] = bytemuck::cast_slice(&prepared.motions);
        put("instances", &[instances, motions, bytemuck::cast_slice(&prepared.shapes)].concat())?;
        put("vertices", bytemuck::cast_slice(&prepared.vertices))?;
        let materials: &[u8] = bytemuck::cast_slice(&prepared.materials);
        put("materials", &[materials, bytemuck::cast_slice(&prepared.interfaces)].concat())?;
        put("details", bytemuck::cast_slice(&prepared.details))?;
        put("textures", bytemuck::cast_slice(&prepared.textures))?;
        put("lights", bytemuck::cast_slice(&prepared.lights))?;
        put("environment", bytemuck::cast_slice(&prepared.environment))?;
        put("lens", bytemuck::cast_slice(&prepared.lens.words))?;
        let atlas = prepared.atlas;
        if atlas.words() > 0 {
            buffers.push(("texels", uploads.put_texels(gpu, atlas, images)?));
        }
        Ok(Self { buffers })
    }

    /// The buffers with their names.
    pub fn buffers(&self) -> impl Iterator<Item = (&'static str, &Arc<Buffer>)> {
        self.buffers.iter().map(|(name, buffer)| (*name, buffer))
    }
}
