#pragma once
// Which channel of which image holds what, a target: packing, and reading back what was packed.

#include "bakers/texture/maps.hpp"

namespace pbrbake::texture {

/// What a channel holds.
enum class Held {
    zero,
    one,
    base_r,
    base_g,
    base_b,
    opacity,
    metallic,
    perceptual_roughness,
    smoothness,
    reflectance,  ///< Frostbite's: f0 = .16 reflectance^2
    specular,     ///< Unreal's: f0 = .08 specular
    occlusion,
    normal_x,
    normal_y,       ///< up
    normal_y_down,  ///< DirectX
    normal_z,
    dielectric_r,  ///< dielectric f0 over Layout::specular_unit
    dielectric_g,
    dielectric_b,
    emissive_r,
    emissive_g,
    emissive_b,
};

struct PackedImage {
    std::string name;
    std::vector<Held> channels;
    bool is_colour = false;  ///< stored as sRGB where codes are 8 bits
};

/// A target's images, the first the base colour's.
struct Layout {
    std::vector<PackedImage> images;
    pbr::DiffuseCoupling coupling = pbr::DiffuseCoupling::none;  ///< of the target's shader
    bool has_residual = false;                                   ///< a dielectric f0 of any colour
    float largest_f0 = 0;  ///< of its grey dielectric f0; 0: fixed at the job's dielectric_f0
};

/// The layout of a set.
Layout layout_of(const Sources& sources);
/// Names of the images that a set may have, before its pictures are known.
std::vector<std::string> image_names(const TextureParams& params);

/// The material that a texel of a level becomes in the layout.
pbr::MetallicMaterial<float> material_of(const TextureParams& params, const Layout& layout,
                                         const MapLevel& level, std::size_t texel, const Colour& tolerance);

/// Packs texels [begin, end) of a level into an image of the layout, from texel `to` of `packed` on.
/// materials[i - begin] is that of texel i; `specular_unit` divides dielectric_f0.
void pack(const PackedImage& image, const MapLevel& level, std::size_t begin, std::size_t end,
          const pbr::MetallicMaterial<float>* materials, float specular_unit, std::size_t to,
          std::vector<float>& packed);

/// The material and perceptual roughness of a texel of stored images.
struct Unpacked {
    pbr::MetallicMaterial<float> material;
    float perceptual_roughness;
};
Unpacked unpack(const TextureParams& params, const Layout& layout, const std::vector<Image>& images, int x,
                int y, float specular_unit, double scale);

}  // namespace pbrbake::texture
