//! The materials of a file.

use super::stress::{self, Shown, Stresses};
use gltf_json::{Index, Material, Root};

/// The materials of rods, each made when first needed.
#[derive(Default)]
pub(super) struct Materials(Vec<(Shown, Index<Material>)>);

impl Materials {
    pub fn of(
        &mut self,
        root: &mut Root,
        shown: Shown,
        stresses: Option<&Stresses>,
    ) -> Index<Material> {
        if let Some((_, material)) = self.0.iter().find(|(known, _)| *known == shown) {
            return *material;
        }
        let (name, color) = match shown {
            Shown::Ends(look) => (look.name().to_owned(), look.color()),
            Shown::Used(step) => {
                (stresses.map(|s| s.name(step)).unwrap_or_default(), stress::color(step))
            }
        };
        let mut material = Material { name: Some(name), ..Material::default() };
        material.pbr_metallic_roughness.base_color_factor.0 = color;
        material.pbr_metallic_roughness.metallic_factor.0 = 0.0;
        material.pbr_metallic_roughness.roughness_factor.0 = 0.8;
        let material = root.push(material);
        self.0.push((shown, material));
        material
    }
}
