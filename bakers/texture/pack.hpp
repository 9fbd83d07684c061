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
    dielectric_r,  ///< dielectric f0 over specular_factor and the set's unit, in the end
    dielectric_g,
    dielectric_b,
    specular_factor,  ///< glTF's: what the dielectric reflects at grazing incidence
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

/// What a target's shader reflects at grazing incidence.
enum class GrazingRule {
    one,              ///< KHR_materials_pbrSpecularGlossiness
    specular_factor,  ///< glTF 2.0: 1 of metals, and of dielectrics KHR_materials_specular's factor
    frostbite,        ///< f90_from_f0 of what metal and dielectric reflect; Unity's HDRP too
    unreal,           ///< the same of green alone: min(1, 50 f0.g)
};

/// A target's images, the first the base colour's.
struct Layout {
    bool is_specular_gloss = false;  ///< holds no metallic material
    std::vector<PackedImage> images;
    pbr::DiffuseCoupling coupling = pbr::DiffuseCoupling::none;  ///< of the target's shader
    GrazingRule grazing = GrazingRule::frostbite;                ///< of the target's shader
    bool has_residual = false;                                   ///< a dielectric f0 of any colour
    float dielectric_f0 = 0;  ///< the usual one, and what the target has where no image holds it
    float largest_f0 = 0;     ///< of its grey dielectric f0; 0: fixed at dielectric_f0
    /// Whether a residual says what it reflects at grazing incidence, as dim lobes need.
    bool has_specular_factor() const;
    /// For a set that has no dim lobes.
    void drop_specular_factor();
};

/// The layout of a set.
Layout layout_of(const Sources& sources);
/// Whether a set is more than factors, its only texel.
bool has_pictures(const TextureParams& params);
/// Names of the images that a set may have, before its pictures are known.
std::vector<std::string> image_names(const TextureParams& params);

/// Some texels of a level, and the materials that they become in a layout.
struct Texels {
    const MapLevel& level;
    std::size_t begin, count;
    /// Whether 8-bit codes are what is stored: then metallic, specular_factor and the f0 of specular-gloss
    /// are numbers that codes stand for, and what else there is makes up for their rounding.
    bool is_coded;
    Planes base_color, dielectric_f0{};  ///< of `begin` first; of specular-gloss, the diffuse colour and f0
    std::vector<float> metallic{}, specular_factor{};  ///< the latter empty where it is 1
};

/// Makes the materials, with diffuse light moved by up to `largest_error` where metal needs it. Of
/// specular-gloss there is no metallic, and base_color is the diffuse colour.
void make_materials(const Layout& layout, float largest_error, Texels& texels);

/// What a channel holds of texels: `count` of `values`. dielectric_f0 is packed as it is: its unit is known
/// at the end.
void pack(Held held, const Texels& texels, float* values);

/// What a packed texel holds, and what the target's shader makes of it.
struct Unpacked {
    pbr::MetallicMaterial<float> material;  ///< of a specular-gloss layout, its diffuse colour and f0
    float specular_factor, perceptual_roughness;
    pbr::Reflected<float> reflected;
    float f90;
};
Unpacked shaded(const Layout& layout, const pbr::MetallicMaterial<float>& material, float specular_factor,
                float perceptual_roughness);

/// Of a texel that is packed, before codes of colours.
Unpacked packed(const Layout& layout, const Texels& texels, std::size_t i);
/// Of a texel of stored images.
Unpacked unpack(const Layout& layout, const std::vector<Image>& images, int x, int y, float specular_unit,
                double scale);

}  // namespace pbrbake::texture
