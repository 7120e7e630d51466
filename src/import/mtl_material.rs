//! Materials of MTL files as the principled material. `scenes/obj.md` has the table.

use super::file::{inside, shown};
use super::image::read_image;
use super::mtl::{Map, Mtl};
use crate::scene::{
    Bump, Channel, ColorSpace, Derivative, Detail, Dielectric, Emission, Handle, Image, ImageTexture,
    Material, NormalMap, Opacity, Principled, Roughness, Scene, Surface, Tangents, TexelFilter, Texels,
    Texture, UvTransform, Value, Wrap,
};
use crate::{Error, Result};
use glam::Vec3;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Reflectance of what has no Kd.
const GREY: f32 = 0.8;
/// Height of a bump of 1 where `-bm` is 1, in parts of the longest side of the box around the model.
const BUMP_HEIGHT: f32 = 0.01;

/// Makes materials of the materials of one model.
pub(super) struct Maker<'a> {
    pub scene: &'a mut Scene,
    /// The folder of the model.
    pub folder: &'a Path,
    /// The material file.
    pub path: PathBuf,
    /// Longest side of the box around the model.
    pub size: f32,
    /// Whether the vertices have colours.
    pub colored: bool,
    /// Pictures that are read already.
    pub images: HashMap<PathBuf, Handle<Image>>,
}

impl Maker<'_> {
    pub fn material(&mut self, mtl: &Mtl) -> Result<Handle<Material>> {
        let mut principled = Principled {
            ior: Value::Constant(mtl.ior.unwrap_or(1.5).clamp(1.0, Dielectric::MOST_INDEX)),
            metallic: self.number(mtl.metallic.unwrap_or(0.0), mtl.metallic, &mtl.metallic_map)?,
            roughness: self.roughness(mtl)?,
            ..Principled::default()
        };
        principled.specular_color = Value::Constant(specular(mtl));
        let (clear, thin) = goes_through(mtl);
        if clear {
            principled.base_color = Value::Constant(mtl.transmission.unwrap_or(Vec3::ONE).min(Vec3::ONE));
            principled.transmission = Value::Constant(1.0);
            principled.thin = thin;
        } else {
            principled.base_color = self.base_color(mtl)?;
        }
        let detail = Detail {
            opacity: if clear { Opacity::default() } else { self.opacity(mtl)? },
            ..self.relief(mtl)?
        };
        let emission = self.emission(mtl)?;
        let material = Material { surface: Surface::Principled(Box::new(principled)), emission, detail };
        Ok(self.scene.materials.add(mtl.name.as_str(), material))
    }

    fn base_color(&mut self, mtl: &Mtl) -> Result<Value<Vec3>> {
        let factor = mtl.diffuse.unwrap_or(Vec3::splat(if mtl.diffuse_map.is_some() { 1.0 } else { GREY }));
        let color = self.color(factor.min(Vec3::ONE), &mtl.diffuse_map)?;
        if !self.colored {
            return Ok(color);
        }
        let dye = self.scene.textures.add("colours of vertices", Texture::VertexColor(Channel::Rgb));
        let product = Texture::Multiply { a: color, b: Value::Texture(dye) };
        Ok(Value::Texture(self.scene.textures.add("dyed", product)))
    }

    /// `Pr` is a roughness; an exponent n is a GGX width of √(2 / (n + 2)), which has the same curvature at the highlight.
    fn roughness(&mut self, mtl: &Mtl) -> Result<Roughness> {
        if mtl.roughness.is_some() || mtl.roughness_map.is_some() {
            let value = self.number(1.0, mtl.roughness, &mtl.roughness_map)?;
            return Ok(Roughness { u: value, v: value, squared: true });
        }
        let smooth = if goes_through(mtl).0 { f32::INFINITY } else { 0.0 };
        let exponent = mtl.exponent.unwrap_or(smooth);
        Ok(Roughness::alpha((2.0 / (exponent + 2.0)).sqrt()))
    }

    fn opacity(&mut self, mtl: &Mtl) -> Result<Opacity> {
        let value = self.number(1.0, mtl.dissolve, &mtl.dissolve_map)?;
        Ok(Opacity { value, ..Opacity::default() })
    }

    fn emission(&mut self, mtl: &Mtl) -> Result<Option<Emission>> {
        let none = if mtl.emission_map.is_some() { Vec3::ONE } else { Vec3::ZERO };
        let factor = mtl.emission.unwrap_or(none);
        if factor == Vec3::ZERO {
            return Ok(None);
        }
        Ok(Some(Emission { radiance: self.color(factor, &mtl.emission_map)?, two_sided: true }))
    }

    /// A normal map, or bumps. Blender writes its normal maps as bumps: what is not grey is no height.
    fn relief(&mut self, mtl: &Mtl) -> Result<Detail> {
        let mut detail = Detail::default();
        if let Some(map) = &mtl.normal_map {
            detail.normal_map = Some(self.normals(map)?);
        }
        let Some(map) = &mtl.bump_map else { return Ok(detail) };
        let image = self.image(map)?;
        if is_grey(&self.scene.images[image]) {
            let texture = self.texture(map, ColorSpace::Linear, Channel::Rgb, 1.0)?;
            let height = map.multiplier * BUMP_HEIGHT * self.size;
            detail.bump = Some(Bump { texture, height, derivative: Derivative::Kernel, curvature: true });
        } else if detail.normal_map.is_none() {
            detail.normal_map = Some(self.normals(map)?);
        }
        Ok(detail)
    }

    fn normals(&mut self, map: &Map) -> Result<NormalMap> {
        let texture = self.texture(map, ColorSpace::Linear, Channel::Rgb, 1.0)?;
        let strength = map.multiplier.clamp(-NormalMap::MOST_STRENGTH, NormalMap::MOST_STRENGTH);
        Ok(NormalMap { texture, green_down: false, strength, tangents: Tangents::MikkTSpace })
    }

    /// A number, times a picture when there is one; without a number 1 beside a picture.
    fn number(&mut self, default: f32, factor: Option<f32>, map: &Option<Map>) -> Result<Value<f32>> {
        let Some(map) = map else { return Ok(Value::Constant(factor.unwrap_or(default))) };
        let image = self.image(map)?;
        // A picture with alpha is meant to be cut out by it
        let channel = if self.scene.images[image].is_opaque() { Channel::Rgb } else { Channel::A };
        let texture = self.texture(map, ColorSpace::Linear, channel, factor.unwrap_or(1.0))?;
        Ok(Value::Texture(texture))
    }

    fn color(&mut self, factor: Vec3, map: &Option<Map>) -> Result<Value<Vec3>> {
        let Some(map) = map.as_ref().filter(|_| factor != Vec3::ZERO) else {
            return Ok(Value::Constant(factor));
        };
        let image = self.image(map)?;
        let space = match self.scene.images[image].texels {
            Texels::RgbaF32(_) => ColorSpace::Linear,
            _ => ColorSpace::Srgb,
        };
        let picture = Value::Texture(self.texture(map, space, Channel::Rgb, 1.0)?);
        if factor == Vec3::ONE {
            return Ok(picture);
        }
        let product = Texture::Multiply { a: picture, b: Value::Constant(factor) };
        Ok(Value::Texture(self.scene.textures.add(map.file.as_str(), product)))
    }

    fn texture(
        &mut self,
        map: &Map,
        color_space: ColorSpace,
        channel: Channel,
        scale: f32,
    ) -> Result<Handle<Texture>> {
        let texture = ImageTexture {
            image: self.image(map)?,
            filter: TexelFilter::Trilinear,
            wrap: [if map.clamp { Wrap::Clamp } else { Wrap::Repeat }; 2],
            uv: UvTransform { scale: map.scale, rotate: 0.0, offset: map.offset },
            color_space,
            channel,
            scale,
            invert: false,
        };
        Ok(self.scene.textures.add(map.file.as_str(), Texture::Image(texture)))
    }

    /// A picture in the folder of the model or below it, read once.
    fn image(&mut self, map: &Map) -> Result<Handle<Image>> {
        let [line, column] = map.at;
        let name = shown(map.file.as_bytes());
        let refuse = |message: String| Error::scene(message).at(&self.path, line, column);
        let Some(file) = inside(&map.file) else {
            let message = format!("\"{name}\" is not in the folder of the model or below it");
            return Err(refuse(message).help("other files are not read: copy it there"));
        };
        let file = self.folder.join(file);
        if let Some(known) = self.images.get(&file) {
            return Ok(*known);
        }
        let image = read_image(&file).map_err(|error| refuse(format!("{name}: {}", error.message)))?;
        let handle = self.scene.images.add(map.file.as_str(), image);
        self.images.insert(file, handle);
        Ok(handle)
    }
}

/// Whether light goes through, as the illumination model says, and then whether it is not bent.
fn goes_through(mtl: &Mtl) -> (bool, bool) {
    let model = mtl.illumination.unwrap_or(2);
    (matches!(model, 4 | 6 | 7 | 9), matches!(model, 4 | 9))
}

/// Factor on what the dielectric reflects head-on.
fn specular(mtl: &Mtl) -> Vec3 {
    let is_physical = mtl.roughness.is_some() || mtl.metallic.is_some() || mtl.roughness_map.is_some();
    let absent = if is_physical || goes_through(mtl).0 { Vec3::ONE } else { Vec3::ZERO };
    match mtl.illumination {
        Some(0 | 1) => Vec3::ZERO,
        _ => mtl.specular.unwrap_or(absent).min(Vec3::ONE),
    }
}

/// Whether red, green and blue are the same everywhere, but for the rounding of JPEG.
fn is_grey(image: &Image) -> bool {
    fn near<T: Copy + Into<f32>>(texels: &[[T; 4]], most: f32) -> bool {
        texels.iter().all(|[r, g, b, _]| {
            let [r, g, b] = [*r, *g, *b].map(Into::into);
            (r - g).abs() <= most && (g - b).abs() <= most
        })
    }
    match &image.texels {
        Texels::Rgba8(texels) => near(texels, 8.0),
        Texels::Rgba16(texels) => near(texels, 2048.0),
        Texels::RgbaF32(texels) => near(texels, 0.03),
    }
}
