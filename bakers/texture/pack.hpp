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
    dielectric_r,  ///< dielectric f0 over the set's unit, in the end
    dielectric_g,
    dielectric_b,
    emissive_r,
    emissive_g,
    emissive_b,
    diffuse_r,  ///< the diffuse colour of specular-gloss: dimmed by 1 - max f0 when it is read
    diffuse_g,
    diffuse_b,
    f0_r,
    f0_g,
    f0_b,
};

struct PackedImage {
    std::string name;
    std::vector<Held> channels;
    bool is_colour = false;  ///< stored as sRGB where codes are 8 bits
};

/// A target's images, the first the base colour's.
struct Layout {
    bool is_specular_gloss = false;  ///< holds no metallic material
    std::vector<PackedImage> images;
    pbr::DiffuseCoupling coupling = pbr::DiffuseCoupling::none;  ///< of the target's shader
    bool has_residual = false;                                   ///< a dielectric f0 of any colour
    float largest_f0 = 0;  ///< of its grey dielectric f0; 0: fixed at the job's dielectric_f0
};

/// The layout of a set.
Layout layout_of(const Sources& sources);
/// Names of the images that a set may have, before its pictures are known.
std::vector<std::string> image_names(const TextureParams& params);

/// Some texels of a level, and the materials that they become in a layout.
struct Texels {
    const MapLevel& level;
    std::size_t begin, count;
    Planes base_color, dielectric_f0;  ///< of `begin` first; metallic is the level's

    pbr::MetallicMaterial<float> material(std::size_t i) const {
        return {base_color[i], level.metallic[begin + i], dielectric_f0[i]};
    }
};

/// Makes the materials, with diffuse light moved by up to its tolerance, or `largest_error` where metal needs
/// it. A specular-gloss layout holds the level as it is: there base_color is the diffuse colour, and
/// dielectric_f0 nothing in particular.
void make_materials(const TextureParams& params, const Layout& layout, const pbr::ColourPlanes& tolerance,
                    float largest_error, Texels& texels);

/// What a channel holds of texels: `count` of `values`. dielectric_f0 is packed as it is: its unit is known
/// at the end.
void pack(Held held, const Texels& texels, float* values);

/// What a texel of a level reflects once it is packed, before codes.
pbr::Reflected<float> packed_reflection(const Layout& layout, const MapLevel& level, std::size_t texel,
                                        const pbr::MetallicMaterial<float>& material);

/// What a texel of stored images holds and reflects.
struct Unpacked {
    pbr::MetallicMaterial<float> material;  ///< nothing in particular of a specular-gloss layout
    pbr::Reflected<float> reflected;
    float perceptual_roughness;
};
Unpacked unpack(const TextureParams& params, const Layout& layout, const std::vector<Image>& images, int x,
                int y, float specular_unit, double scale);

}  // namespace pbrbake::texture
