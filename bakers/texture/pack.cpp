#include "bakers/texture/pack.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/unorm8.hpp"
#include "pbr/brdf/fresnel.hpp"

namespace pbrbake::texture {
namespace {

using enum Held;
constexpr float kUnrealF0 = .08f;
constexpr auto kSpecularGloss = pbr::DiffuseCoupling::fresnel;  // KHR_materials_pbrSpecularGlossiness

PackedImage base_image(bool has_opacity) {
    PackedImage image{"base_color", {base_r, base_g, base_b}, true};
    if (has_opacity) image.channels.push_back(opacity);
    return image;
}

PackedImage diffuse_image(bool has_opacity) {
    PackedImage image{"diffuse", {diffuse_r, diffuse_g, diffuse_b}, true};
    if (has_opacity) image.channels.push_back(opacity);
    return image;
}

/// A texel's numbers as its images hold them.
struct Decoded {
    pbr::MetallicMaterial<float> material;
    pbr::Reflected<float> specular_gloss{Colour(0), Colour(0)};
    float perceptual_roughness = .5f;
};

void decode(Held held, float value, float specular_unit, Decoded& result) {
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
        case diffuse_r:
        case diffuse_g:
        case diffuse_b:
            result.specular_gloss.diffuse[static_cast<int>(held) - static_cast<int>(diffuse_r)] = value;
            break;
        case f0_r:
        case f0_g:
        case f0_b:
            result.specular_gloss.f0[static_cast<int>(held) - static_cast<int>(f0_r)] = value;
            break;
        default:
            break;
    }
}

Layout make_layout(const TextureParams& params, bool has_normal, bool has_opacity) {
    Layout layout;
    layout.is_specular_gloss = params.packing == Packing::specular_gloss;
    layout.images.push_back(layout.is_specular_gloss ? diffuse_image(has_opacity) : base_image(has_opacity));
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
        case Packing::specular_gloss:
            add("specular_gloss", {f0_r, f0_g, f0_b, smoothness}, true);
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

void make_materials(const TextureParams& params, const Layout& layout, const pbr::ColourPlanes& tolerance,
                    float largest_error, Texels& texels) {
    texels.base_color.resize(texels.count);
    texels.dielectric_f0.resize(texels.count);
    const MapLevel& level = texels.level;
    if (layout.is_specular_gloss) {
        for (std::size_t i = 0; i < texels.count; ++i) {
            const std::size_t at = texels.begin + i;
            texels.base_color.set(
                i, pbr::diffuse_colour<float>({level.diffuse[at], level.f0[at]}, kSpecularGloss));
        }
        return;
    }
    const auto f = static_cast<float>(params.dielectric_f0);
    const pbr::ReflectedPlanes reflected{level.diffuse.from(texels.begin), level.f0.from(texels.begin)};
    const pbr::MaterialPlanes materials{texels.base_color.from(0), texels.dielectric_f0.from(0)};
    const float* metallic = level.metallic.data() + texels.begin;
    if (layout.has_residual)
        pbr::material_with_residual(reflected, metallic, f, tolerance, layout.coupling, largest_error,
                                    texels.count, materials);
    else
        pbr::material_without_residual(reflected, metallic, f, layout.largest_f0, layout.coupling,
                                       texels.count, materials);
}

void pack(Held held, const Texels& texels, float* values) {
    const MapLevel& level = texels.level;
    const int first = static_cast<int>(held);
    const auto fill = [&](const auto& value) {
        for (std::size_t i = 0; i < texels.count; ++i) values[i] = value(texels.begin + i);
    };
    const auto fill_from = [&](const auto& map, float absent, const auto& value) {
        if (map.empty()) return fill([&](std::size_t) { return absent; });
        fill([&](std::size_t i) { return value(map[i]); });
    };
    const auto copy = [&](const std::vector<float>& plane, std::size_t from) {
        std::copy_n(plane.begin() + static_cast<std::ptrdiff_t>(from), texels.count, values);
    };
    const std::vector<float>& grey_f0 = texels.dielectric_f0.channels[0];
    const auto same = [](float value) { return value; };
    switch (held) {
        case zero:
            return fill([](std::size_t) { return 0.f; });
        case one:
            return fill([](std::size_t) { return 1.f; });
        case base_r:
        case base_g:
        case base_b: {
            return copy(
                texels.base_color.channels[static_cast<std::size_t>(first - static_cast<int>(base_r))], 0);
        }
        case opacity:
            return fill_from(level.opacity, 1, same);
        case metallic:
            return copy(level.metallic, texels.begin);
        case perceptual_roughness:
            return fill_from(level.perceptual_roughness, 1, same);
        case smoothness:
            return fill_from(level.perceptual_roughness, 0, [](float p) { return 1 - p; });
        case reflectance:
            return fill([&](std::size_t i) {
                return std::min(1.f, pbr::reflectance_from_f0(grey_f0[i - texels.begin]));
            });
        case specular:
            return fill([&](std::size_t i) { return std::min(1.f, grey_f0[i - texels.begin] / kUnrealF0); });
        case occlusion:
            return fill_from(level.occlusion, 1, same);
        case normal_x:
            return fill_from(level.normal, .5f, [](const Colour& n) { return n.x * .5f + .5f; });
        case normal_y:
            return fill_from(level.normal, .5f, [](const Colour& n) { return n.y * .5f + .5f; });
        case normal_y_down:
            return fill_from(level.normal, .5f, [](const Colour& n) { return n.y * -.5f + .5f; });
        case normal_z:
            return fill_from(level.normal, 1, [](const Colour& n) { return n.z * .5f + .5f; });
        case dielectric_r:
        case dielectric_g:
        case dielectric_b: {
            return copy(texels.dielectric_f0
                            .channels[static_cast<std::size_t>(first - static_cast<int>(dielectric_r))],
                        0);
        }
        case emissive_r:
        case emissive_g:
        case emissive_b: {
            const int c = first - static_cast<int>(emissive_r);
            return fill_from(level.emissive, 0, [c](const Colour& light) { return light[c]; });
        }
        case diffuse_r:
        case diffuse_g:
        case diffuse_b: {
            return copy(
                texels.base_color.channels[static_cast<std::size_t>(first - static_cast<int>(diffuse_r))], 0);
        }
        case f0_r:
        case f0_g:
        case f0_b: {
            const int c = first - static_cast<int>(f0_r);
            return fill_from(level.f0, 0, [c](const Colour& f0) { return f0[c]; });
        }
    }
}

pbr::Reflected<float> packed_reflection(const Layout& layout, const MapLevel& level, std::size_t texel,
                                        const pbr::MetallicMaterial<float>& material) {
    return layout.is_specular_gloss ? pbr::Reflected<float>{level.diffuse[texel], level.f0[texel]}
                                    : pbr::reflected_from_metallic(material, layout.coupling);
}

Unpacked unpack(const TextureParams& params, const Layout& layout, const std::vector<Image>& images, int x,
                int y, float specular_unit, double scale) {
    Decoded found{{Colour(0), 0, Colour(static_cast<float>(params.dielectric_f0))}};
    for (std::size_t i = 0; i < layout.images.size(); ++i) {
        const Image& image = images[i];
        const Level& level = image.levels.front();
        const std::size_t channels = image.channels.size(),
                          at = (static_cast<std::size_t>(y) * level.width + x) * channels;
        for (std::size_t c = 0; c < channels; ++c) {
            const float stored = level.codes.empty()
                                     ? static_cast<float>(level.texels[at + c] / scale)
                                     : from_unorm8(level.codes[at + c], channel_transfer(image, c));
            decode(layout.images[i].channels[c], stored, specular_unit, found);
        }
    }
    const pbr::Reflected<float> reflected =
        layout.is_specular_gloss ? pbr::reflected_from_specular(found.specular_gloss.diffuse,
                                                                found.specular_gloss.f0, kSpecularGloss)
                                 : pbr::reflected_from_metallic(found.material, layout.coupling);
    return {found.material, reflected, found.perceptual_roughness};
}

}  // namespace pbrbake::texture
