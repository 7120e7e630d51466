//! Buffers that are on the device already.

use super::resident::upload_texels;
use crate::Result;
use crate::gpu::{Buffer, Gpu};
use crate::prepare::Atlas;
use crate::scene::{Handle, Image, Store};
use std::collections::HashMap;
use std::sync::{Arc, Weak};

/// The buffers of the scenes before, as long as anything holds them, so that an edit sends only what it touches.
#[derive(Default)]
pub struct Uploads {
    /// None: nothing is looked for.
    known: Option<HashMap<(&'static str, blake3::Hash), Weak<Buffer>>>,
    texels: Option<Texels>,
    bytes: u64,
}

/// The texels of some pictures.
struct Texels {
    atlas: Atlas,
    /// Dead when the picture is no more.
    images: Vec<Weak<Image>>,
    buffer: Weak<Buffer>,
}

impl Uploads {
    /// Buffers that are looked for by what is in them.
    pub fn kept() -> Self {
        Self { known: Some(HashMap::new()), ..Self::default() }
    }

    /// Begins a scene.
    pub(super) fn begin(&mut self) {
        self.bytes = 0;
        if let Some(known) = &mut self.known {
            known.retain(|_, buffer| buffer.strong_count() > 0);
        }
    }

    /// Bytes that the last scene sent to the device.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// A buffer that holds `bytes`.
    pub(super) fn put(&mut self, gpu: &Gpu, name: &'static str, bytes: &[u8]) -> Result<Arc<Buffer>> {
        let Some(known) = &mut self.known else { return gpu.upload(name, bytes) };
        let key = (name, blake3::hash(bytes));
        if let Some(buffer) = known.get(&key).and_then(Weak::upgrade) {
            return Ok(buffer);
        }
        let buffer = gpu.upload(name, bytes)?;
        known.insert(key, Arc::downgrade(&buffer));
        self.bytes += bytes.len() as u64;
        Ok(buffer)
    }

    /// The texels of an atlas. Each picture is dropped when it has been drawn.
    pub(super) fn put_texels(
        &mut self,
        gpu: &Gpu,
        atlas: Atlas,
        images: Store<Image>,
    ) -> Result<Arc<Buffer>> {
        let mut images: Vec<_> = images.into_items().collect();
        if let Some(buffer) = self.texels.as_ref().and_then(|texels| texels.of(&atlas, &images)) {
            return Ok(buffer);
        }
        let weak = images.iter().map(Arc::downgrade).collect();
        let empty = Arc::new(Image::EMPTY);
        let take = |image: Handle<Image>| std::mem::replace(&mut images[image.index()], empty.clone());
        let buffer = upload_texels(gpu, &atlas, take)?;
        self.bytes += buffer.bytes();
        if self.known.is_some() {
            self.texels = Some(Texels { atlas, images: weak, buffer: Arc::downgrade(&buffer) });
        }
        Ok(buffer)
    }
}

impl Texels {
    /// The buffer, if it holds just these.
    fn of(&self, atlas: &Atlas, images: &[Arc<Image>]) -> Option<Arc<Buffer>> {
        let same = |(old, new): (&Weak<Image>, &Arc<Image>)| std::ptr::eq(old.as_ptr(), Arc::as_ptr(new));
        let equal = self.atlas == *atlas
            && self.images.len() == images.len()
            && self.images.iter().zip(images).all(same);
        if equal { self.buffer.upgrade() } else { None }
    }
}
