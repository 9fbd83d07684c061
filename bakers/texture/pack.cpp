#include "bakers/texture/pack.hpp"

#include <algorithm>
#include <cmath>

#include "pbr/brdf/fresnel.hpp"

namespace pbrbake::texture {
namespace {

using enum Held;
constexpr float kUnrealF0 = .08f;

PackedImage base_image(bool has_opacity) {
    PackedImage image{"base_color", {base_r, base_g, base_b}, true};
    if (has_opacity) image.channels.push_back(opacity);
    return image;
}

float encoded(Held held, const MapLevel& level, const pbr::MetallicMaterial<float>& material, std::size_t i,
              float specular_unit) {
    const float f = material.dielectric_f0.x;
    switch (held) {
        case zero:
            return 0;
        case one:
            return 1;
        case base_r:
        case base_g:
        case base_b:
            return material.base_color[static_cast<int>(held) - static_cast<int>(base_r)];
        case opacity:
            return level.opacity.empty() ? 1 : level.opacity[i];
        case metallic:
            return material.metallic;
        case perceptual_roughness:
            return level.perceptual_roughness[i];
        case smoothness:
            return 1 - level.perceptual_roughness[i];
        case reflectance:
            return std::min(1.f, pbr::reflectance_from_f0(f));
        case specular:
            return std::min(1.f, f / kUnrealF0);
        case occlusion:
            return level.occlusion.empty() ? 1 : level.occlusion[i];
        case normal_x:
            return level.normal.empty() ? .5f : level.normal[i].x * .5f + .5f;
        case normal_y:
            return level.normal.empty() ? .5f : level.normal[i].y * .5f + .5f;
        case normal_y_down:
            return level.normal.empty() ? .5f : level.normal[i].y * -.5f + .5f;
        case normal_z:
            return level.normal.empty() ? 1 : level.normal[i].z * .5f + .5f;
        case dielectric_r:
        case dielectric_g:
        case dielectric_b:
            return std::min(1.f,
                            material.dielectric_f0[static_cast<int>(held) - static_cast<int>(dielectric_r)] /
                                specular_unit);
        case emissive_r:
        case emissive_g:
        case emissive_b:
            return level.emissive[i][static_cast<int>(held) - static_cast<int>(emissive_r)];
    }
    return 0;
}

void decode(Held held, float value, float specular_unit, Unpacked& result) {
    switch (held) {
        case base_r:
        case base_g:
        case base_b:
            result.material.base_color[static_cast<int>(held) - static_cast<int>(base_r)] = value;
            break;
        case metallic:
            result.material.metallic = value;
            break;
        case perceptual_roughness:
            result.perceptual_roughness = value;
            break;
        case smoothness:
            result.perceptual_roughness = 1 - value;
            break;
        case reflectance:
            result.material.dielectric_f0 = Colour(pbr::f0_from_reflectance(value));
            break;
        case specular:
            result.material.dielectric_f0 = Colour(value * kUnrealF0);
            break;
        case dielectric_r:
        case dielectric_g:
        case dielectric_b:
            result.material.dielectric_f0[static_cast<int>(held) - static_cast<int>(dielectric_r)] =
                value * specular_unit;
            break;
        default:
            break;
    }
}

Layout make_layout(const TextureParams& params, bool has_normal, bool has_opacity) {
    Layout layout;
    layout.images.push_back(base_image(has_opacity));
    const auto add = [&](std::string name, std::vector<Held> channels, bool is_colour = false) {
        layout.images.push_back({std::move(name), std::move(channels), is_colour});
    };
    const bool down = params.packing == Packing::unreal;
    switch (params.packing) {
        case Packing::gltf:
            layout.coupling = pbr::DiffuseCoupling::fresnel;
            add("orm", {occlusion, perceptual_roughness, metallic});
            break;
        case Packing::unity:
            add("mask", {metallic, occlusion, one, smoothness});
            break;
        case Packing::unreal:
            layout.largest_f0 = kUnrealF0;
            add("orm", {occlusion, perceptual_roughness, metallic});
            add("specular", {specular});
            break;
        case Packing::frostbite:
            layout.largest_f0 = pbr::f0_from_reflectance(1.f);
            add("mask", {smoothness, metallic, reflectance, occlusion});
            break;
        case Packing::separate:
            layout.largest_f0 = pbr::f0_from_reflectance(1.f);
            add("metallic", {metallic});
            add("roughness", {perceptual_roughness});
            add("reflectance", {reflectance});
            if (!params.occlusion.empty()) add("occlusion", {occlusion});
            break;
    }
    if (has_normal) add("normal", {normal_x, down ? normal_y_down : normal_y, normal_z});
    layout.has_residual = params.packing == Packing::gltf && params.residual;
    if (layout.has_residual) add("specular", {dielectric_r, dielectric_g, dielectric_b}, true);
    if (params.packing == Packing::gltf && !params.emissive.empty())
        add("emissive", {emissive_r, emissive_g, emissive_b}, true);
    return layout;
}

}  // namespace

Layout layout_of(const Sources& sources) {
    return make_layout(sources.params(), sources.has_normal(), sources.has_opacity());
}

std::vector<std::string> image_names(const TextureParams& params) {
    std::vector<std::string> names;
    for (const PackedImage& image : make_layout(params, !params.normal.empty(), false).images)
        names.push_back(image.name);
    return names;
}

pbr::MetallicMaterial<float> material_of(const TextureParams& params, const Layout& layout,
                                         const MapLevel& level, std::size_t texel, const Colour& tolerance) {
    const pbr::Reflected<float> reflected{level.diffuse[texel], level.f0[texel]};
    const auto f = static_cast<float>(params.dielectric_f0);
    return layout.has_residual
               ? pbr::material_with_residual(reflected, level.metallic[texel], f, tolerance, layout.coupling)
               : pbr::material_without_residual(reflected, level.metallic[texel], f, layout.largest_f0,
                                                layout.coupling);
}

void pack(const PackedImage& image, const MapLevel& level, std::size_t begin, std::size_t end,
          const pbr::MetallicMaterial<float>* materials, float specular_unit, std::size_t to,
          std::vector<float>& packed) {
    const std::size_t channels = image.channels.size();
    for (std::size_t c = 0; c < channels; ++c) {
        const Held held = image.channels[c];
        float* values = packed.data() + to * channels + c;
        for (std::size_t i = begin; i < end; ++i, values += channels)
            *values = encoded(held, level, materials[i - begin], i, specular_unit);
    }
}

Unpacked unpack(const TextureParams& params, const Layout& layout, const std::vector<Image>& images, int x,
                int y, float specular_unit, double scale) {
    Unpacked result{{Colour(0), 0, Colour(static_cast<float>(params.dielectric_f0))}, .5f};
    for (std::size_t i = 0; i < layout.images.size(); ++i) {
        const float* texel = images[i].texel(0, 0, y, x);
        for (std::size_t c = 0; c < layout.images[i].channels.size(); ++c)
            decode(layout.images[i].channels[c], static_cast<float>(texel[c] / scale), specular_unit, result);
    }
    return result;
}

}  // namespace pbrbake::texture
