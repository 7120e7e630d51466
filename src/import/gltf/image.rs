//! Pictures: from files, data URIs and views of buffers, each read once.

use super::document::index_into;
use super::json::Json;
use super::reader::Reader;
use super::uri;
use crate::Result;
use crate::import::image::decode;
use crate::scene::{Handle, Image};

impl Reader<'_> {
    /// The picture that a texture shows; none when it names none.
    pub fn image_of(&mut self, texture: &Json<'_>) -> Result<Option<Handle<Image>>> {
        let webp = texture.extension("EXT_texture_webp")?;
        let source = match webp.map(|webp| webp.get("source")).transpose()?.flatten() {
            Some(source) => Some(source),
            None => texture.get("source")?,
        };
        match source {
            Some(source) => {
                let count = self.document.root.list("images")?.len();
                self.image(index_into(&source, "images", count)?).map(Some)
            }
            None if texture.extension("KHR_texture_basisu")?.is_some() => Err(texture
                .error("the texture is in KTX2 alone (KHR_texture_basisu), which dapple does not read")
                .help("export the model with PNG, JPEG or WebP")),
            None => Ok(None),
        }
    }

    /// A picture of the document.
    pub fn image(&mut self, index: usize) -> Result<Handle<Image>> {
        let images = self.document.root.list("images")?;
        if let Some(known) = self.images.get(&index) {
            return Ok(*known);
        }
        let json = &images[index];
        let image = match (json.get("uri")?, json.get("bufferView")?) {
            (Some(uri), _) => decode(&uri::read(&uri, self.document.folder, &mut self.document.files)?),
            (None, Some(view)) => {
                let view = self.document.buffers.view(&view)?;
                decode(self.document.buffers.bytes(view))
            }
            (None, None) => return Err(json.error("the image has neither `uri` nor `bufferView`")),
        };
        let image = image.map_err(|mut error| {
            error.message = format!("{}: {}", json.pointer(), error.message);
            error
        })?;
        let handle = self.scene.images.add(json.name("image", index)?, image);
        self.images.insert(index, handle);
        Ok(handle)
    }
}
