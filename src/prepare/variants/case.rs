//! What a scene may have, thing by thing.

use super::super::{Features, Prepared};
use super::cameras::{cameras, filters, samplers};
use crate::layout::{
    INPUT_EMISSION, LIGHT_POINT, LIGHT_PROJECTION, LIGHT_PUNCTUAL, Light, MATERIAL_COATED_CONDUCTOR,
    MATERIAL_COATED_DIFFUSE, MATERIAL_CONDUCTOR, MATERIAL_DIELECTRIC, MATERIAL_PRINCIPLED, STACK_ENTRIES,
};
use crate::scene::Scene;
use bytemuck::Zeroable as _;

/// As much of a scene as the switches depend on.
#[derive(Clone, Default)]
pub struct Case {
    pub scene: Scene,
    pub features: Features,
    /// Whether coats have tables.
    pub tables: bool,
    /// Entries of the traversal stack.
    pub stack_entries: u32,
    /// Whether one back end will do.
    pub storage_alone: bool,
}

/// Puts a thing in, or takes it out.
type Part = Box<dyn Fn(&mut Case, bool)>;

/// Cases that together have every part alone, all but every part, and each choice of each menu.
pub fn cases() -> Vec<Case> {
    let parts = parts();
    let all = Case::all(true, true);
    let mut cases = vec![Case::default()];
    for part in &parts {
        let mut alone = Case::default();
        part(&mut alone, true);
        alone.add_ground();
        let mut without = all.clone();
        part(&mut without, false);
        without.leave_out_what_has_no_ground();
        // These take the longest
        without.storage_alone = true;
        cases.extend([alone, without]);
    }
    let of = |scene, moves| {
        let features = Features { moves, camera_moves: moves, ..Features::default() };
        Case { scene, features, ..Case::default() }
    };
    cases.extend(samplers().chain(filters()).map(|scene| of(scene, true)));
    cases.extend(cameras().into_iter().flat_map(|scene| [of(scene.clone(), false), of(scene, true)]));
    cases
}

impl Case {
    /// Everything at once, but for the two things that textures may look at.
    pub fn all(vertex_color: bool, uv1: bool) -> Self {
        let mut all = Self { stack_entries: STACK_ENTRIES, ..Self::default() };
        parts().iter().for_each(|part| part(&mut all, true));
        (all.features.vertex_color, all.features.uv1) = (vertex_color, uv1);
        all
    }

    pub fn prepared(&self) -> Prepared {
        Prepared {
            features: self.features,
            lights: vec![Light::zeroed(); usize::from(self.features.light_kinds != 0)],
            interfaces: vec![[0; 4]; usize::from(self.tables)],
            stack_entries: self.stack_entries,
            ..Prepared::default()
        }
    }

    /// Adds what the things that are there cannot be without.
    fn add_ground(&mut self) {
        let f = &mut self.features;
        f.environment_image |= f.environment_equal_area;
        f.environment |= f.environment_image || self.scene.film.transparent;
        f.textured_lights |= f.equal_area_lights;
        f.opacity |= f.filter;
        let ground = |wanted: bool, kinds: &mut u32, some: u32| {
            if wanted && *kinds & some == 0 {
                *kinds |= some;
            }
        };
        ground(f.textured_lights, &mut f.light_kinds, PUNCTUAL);
        ground(f.transmission || f.clearcoat || f.sheen, &mut f.material_kinds, PRINCIPLED);
        ground(f.metal_index, &mut f.material_kinds, METALS);
        ground((f.medium || f.dispersion) && !f.transmission, &mut f.material_kinds, GLASS);
        ground(self.tables, &mut f.material_kinds, COATED);
    }

    /// Takes out what cannot be without the things that are not there.
    fn leave_out_what_has_no_ground(&mut self) {
        let f = &mut self.features;
        let material = |kinds: u32| f.material_kinds & kinds != 0;
        f.environment_image &= f.environment;
        f.environment_equal_area &= f.environment_image;
        f.textured_lights &= f.light_kinds & PUNCTUAL != 0;
        f.equal_area_lights &= f.textured_lights;
        f.filter &= f.opacity;
        f.transmission &= material(PRINCIPLED);
        f.clearcoat &= material(PRINCIPLED);
        f.sheen &= material(PRINCIPLED);
        f.metal_index &= material(METALS);
        f.medium &= material(GLASS) || f.transmission;
        f.dispersion &= material(GLASS) || f.transmission;
        self.tables &= material(COATED);
        self.scene.film.transparent &= f.environment;
    }
}

const PUNCTUAL: u32 = 1 << LIGHT_POINT | 1 << LIGHT_PROJECTION | !0 << LIGHT_PUNCTUAL;
const PRINCIPLED: u32 = 1 << MATERIAL_PRINCIPLED;
const METALS: u32 = 1 << MATERIAL_CONDUCTOR | 1 << MATERIAL_COATED_CONDUCTOR;
const GLASS: u32 = 1 << MATERIAL_DIELECTRIC;
const COATED: u32 = 1 << MATERIAL_COATED_DIFFUSE | 1 << MATERIAL_COATED_CONDUCTOR;

/// All that a scene may have or not.
fn parts() -> Vec<Part> {
    let mut parts = of_features();
    parts.push(Box::new(|case, on| case.tables = on));
    parts.push(Box::new(|case, on| case.scene.render.russian_roulette = on));
    parts.push(Box::new(|case, on| case.scene.render.geometric_veto = on));
    parts.push(Box::new(|case, on| case.scene.film.transparent = on));
    parts
}

/// A part for each field of [`Features`], for each bit of those that are sets.
fn of_features() -> Vec<Part> {
    macro_rules! parts {
        (flags: $($flag:ident)*; sets: $($set:ident)*; numbers: $($number:ident = $value:literal)*) => {{
            // Every field is named: it does not compile when one is missing
            let Features { $($flag: _,)* $($set: _,)* $($number: _,)* textured_inputs: _ } = Features::default();
            let mut parts: Vec<Part> = vec![$(Box::new(|case, on| case.features.$flag = on)),*];
            $(parts.extend((0..u32::BITS).map(|bit| {
                Box::new(move |case: &mut Case, on| set_bits(&mut case.features.$set, 1 << bit, on)) as Part
            }));)*
            $(parts.push(Box::new(|case, on| case.features.$number = if on { $value } else { 0 }));)*
            parts
        }};
    }
    let mut parts = parts!(
        flags: instances spheres disks parts patches environment environment_image environment_equal_area
            textured_lights equal_area_lights anisotropic metal_index transmission clearcoat sheen opacity
            front_only filter bump normal_map medium dispersion footprint vertex_color uv1 timed_textures moves
            camera_moves;
        sets: material_kinds light_kinds;
        numbers: mix_depth = 2
    );
    // Of the inputs only emission has a switch: the others are a constant of the kernel
    for inputs in [3 << (2 * INPUT_EMISSION), !(3 << (2 * INPUT_EMISSION))] {
        parts.push(Box::new(move |case, on| set_bits(&mut case.features.textured_inputs, inputs, on)));
    }
    parts
}

fn set_bits(set: &mut u32, bits: u32, on: bool) {
    *set = if on { *set | bits } else { *set & !bits };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_on_its_ground_stays() {
        for case in cases() {
            let mut grounded = case.clone();
            grounded.add_ground();
            assert_eq!(grounded.features, case.features);
            grounded.leave_out_what_has_no_ground();
            assert_eq!(grounded.features, case.features);
            assert_eq!(grounded.tables, case.tables);
            assert_eq!(grounded.scene.film, case.scene.film);
        }
    }
}
