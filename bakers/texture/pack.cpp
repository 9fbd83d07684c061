#include "bakers/texture/pack.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/unorm8.hpp"
#include "pbr/brdf/fresnel.hpp"

namespace pbrbake::texture {
namespace {

using enum Held;
constexpr float kUnrealF0 = .08f;
constexpr float kUnityF0 = .04f;  // HDRP's DEFAULT_SPECULAR_VALUE, URP's kDieletricSpec: no map sets it
constexpr float kDiffuseTolerance = 1e-6f;  // a float's rounding; that of files is kept as it is
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
    float specular_factor = 1, perceptual_roughness = .5f;
};

void decode(Held held, float value, float specular_unit, Decoded& result) {
    const auto number = static_cast<int>(held);
    switch (held) {
        case base_r:
        case base_g:
        case base_b:
            result.material.base_color[number - static_cast<int>(base_r)] = value;
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
            result.material.dielectric_f0[number - static_cast<int>(dielectric_r)] = value * specular_unit;
            break;
        case specular_factor:
            result.specular_factor = value;
            break;
        case diffuse_r:
        case diffuse_g:
        case diffuse_b:
            result.material.base_color[number - static_cast<int>(diffuse_r)] = value;
            break;
        case f0_r:
        case f0_g:
        case f0_b:
            result.material.dielectric_f0[number - static_cast<int>(f0_r)] = value;
            break;
        default:
            break;
    }
}

Layout make_layout(const TextureParams& params, bool has_normal, bool has_opacity, bool may_be_dim) {
    Layout layout;
    layout.dielectric_f0 = static_cast<float>(params.dielectric_f0);
    layout.is_specular_gloss = params.packing == Packing::specular_gloss;
    layout.images.push_back(layout.is_specular_gloss ? diffuse_image(has_opacity) : base_image(has_opacity));
    const auto add = [&](std::string name, std::vector<Held> channels, bool is_colour = false) {
        layout.images.push_back({std::move(name), std::move(channels), is_colour});
    };
    const bool down = params.packing == Packing::unreal;
    switch (params.packing) {
        case Packing::gltf:
            layout.coupling = pbr::DiffuseCoupling::fresnel;
            layout.grazing = GrazingRule::specular_factor;
            add("orm", {occlusion, perceptual_roughness, metallic});
            break;
        case Packing::unity:
            layout.dielectric_f0 = kUnityF0;
            add("mask", {metallic, occlusion, one, smoothness});
            break;
        case Packing::unreal:
            layout.largest_f0 = kUnrealF0;
            layout.grazing = GrazingRule::unreal;
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
            layout.grazing = GrazingRule::one;
            add("specular_gloss", {f0_r, f0_g, f0_b, smoothness}, true);
            if (!params.occlusion.empty()) add("occlusion", {occlusion});
            break;
    }
    if (has_normal) add("normal", {normal_x, down ? normal_y_down : normal_y, normal_z});
    layout.has_residual = params.packing == Packing::gltf && params.residual;
    if (layout.has_residual) {
        add("specular", {dielectric_r, dielectric_g, dielectric_b}, true);
        if (may_be_dim) layout.images.back().channels.push_back(specular_factor);
    }
    if (params.packing == Packing::gltf && !params.emissive.empty())
        add("emissive", {emissive_r, emissive_g, emissive_b}, true);
    return layout;
}

float grazing_reflectance(GrazingRule rule, float metallic, float factor, const Colour& f0) {
    switch (rule) {
        case GrazingRule::one:
            return 1;
        case GrazingRule::specular_factor:
            return metallic + (1 - metallic) * factor;
        case GrazingRule::frostbite:
            return pbr::f90_from_f0(f0);
        case GrazingRule::unreal:
            return std::min(1.f, 50 * f0.y);
    }
    return 1;
}

/// The factor of a texel that reflects f90 at grazing incidence, of which metal takes its share. The f0 that
/// goes with it, dielectric_f0 over the factor, is at most 1.
float factor_for(float f90, float metallic, const Colour& dielectric_f0) {
    if (f90 >= 1 || metallic >= 1) return 1;
    const float rest = std::max(0.f, (f90 - metallic) / (1 - metallic));
    return std::min(1.f, std::max(rest, pbr::max_channel(dielectric_f0)));
}

void round_to_codes(std::vector<float>& values, Transfer transfer) {
    for (float& value : values) value = from_unorm8(unorm8_of(value, transfer), transfer);
}

/// To the nearest codes, but not up where the material would then reflect less diffuse light than the set: to
/// the code below.
void round_metallic(const pbr::ReflectedPlanes& reflected, std::vector<float>& metallic) {
    constexpr float kNoError = 1e-6f;
    std::vector<float> largest(metallic.size());
    pbr::largest_metallic(reflected, kNoError, metallic.size(), largest.data());
    for (std::size_t i = 0; i < metallic.size(); ++i) {
        const std::uint8_t code = unorm8_of(metallic[i], Transfer::linear);
        const float nearest = from_unorm8(code, Transfer::linear);
        const bool is_too_much = nearest > metallic[i] && nearest > largest[i];
        metallic[i] =
            is_too_much ? from_unorm8(static_cast<std::uint8_t>(code - 1), Transfer::linear) : nearest;
    }
}

/// Diffuse colours for the f0 that is stored.
void make_specular_gloss(Texels& texels) {
    const MapLevel& level = texels.level;
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float>& f0 = texels.dielectric_f0.channels[c];
        std::copy_n(level.f0.from(texels.begin)[c], texels.count, f0.begin());
        if (texels.is_coded) round_to_codes(f0, Transfer::srgb);
    }
    for (std::size_t i = 0; i < texels.count; ++i)
        texels.base_color.set(
            i, pbr::diffuse_colour<float>({level.diffuse[texels.begin + i], texels.dielectric_f0[i]},
                                          kSpecularGloss));
}

}  // namespace

bool Layout::has_specular_factor() const {
    return has_residual && std::ranges::any_of(images, [](const PackedImage& image) {
               return image.channels.back() == specular_factor;
           });
}

void Layout::drop_specular_factor() {
    for (PackedImage& image : images)
        if (image.channels.back() == specular_factor) image.channels.pop_back();
}

Layout layout_of(const Sources& sources) {
    return make_layout(sources.params(), sources.has_normal(), sources.has_opacity(), sources.may_be_dim());
}

bool has_pictures(const TextureParams& params) {
    const std::array pictures{&params.diffuse,  &params.specular,   &params.gloss,
                              &params.normal,   &params.occlusion,  &params.opacity,
                              &params.emissive, &params.base_color, &params.metallic_roughness,
                              &params.metallic};
    return std::ranges::any_of(pictures, [](const std::string* path) { return !path->empty(); });
}

std::vector<std::string> image_names(const TextureParams& params) {
    std::vector<std::string> names;
    for (const PackedImage& image : make_layout(params, !params.normal.empty(), false, false).images)
        names.push_back(image.name);
    return names;
}

void make_materials(const Layout& layout, float largest_error, Texels& texels) {
    const MapLevel& level = texels.level;
    texels.base_color.resize(texels.count);
    texels.dielectric_f0.resize(texels.count);
    if (layout.is_specular_gloss) return make_specular_gloss(texels);
    const float* metallic = level.metallic.data() + texels.begin;
    texels.metallic.assign(metallic, metallic + texels.count);
    const pbr::ReflectedPlanes reflected{level.diffuse.from(texels.begin), level.f0.from(texels.begin)};
    if (texels.is_coded)
        layout.has_residual ? round_metallic(reflected, texels.metallic)
                            : round_to_codes(texels.metallic, Transfer::linear);
    const pbr::MaterialPlanes materials{texels.base_color.from(0), texels.dielectric_f0.from(0)};
    if (layout.has_residual) {
        const std::vector<float> exact(texels.count, kDiffuseTolerance);
        pbr::material_with_residual(reflected, texels.metallic.data(), layout.dielectric_f0,
                                    {exact.data(), exact.data(), exact.data()}, layout.coupling,
                                    largest_error, texels.count, materials);
    } else {
        pbr::material_without_residual(reflected, texels.metallic.data(), layout.dielectric_f0,
                                       layout.largest_f0, layout.coupling, texels.count, materials);
    }
    if (!layout.has_specular_factor()) return;
    texels.specular_factor.resize(texels.count);
    for (std::size_t i = 0; i < texels.count; ++i)
        texels.specular_factor[i] =
            factor_for(level.f90[texels.begin + i], texels.metallic[i], texels.dielectric_f0[i]);
    if (texels.is_coded) round_to_codes(texels.specular_factor, Transfer::linear);
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
    const auto copy = [&](const std::vector<float>& plane) { std::ranges::copy(plane, values); };
    const auto plane_of = [&](const Planes& planes, Held red) -> const std::vector<float>& {
        return planes.channels[static_cast<std::size_t>(first - static_cast<int>(red))];
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
        case base_b:
            return copy(plane_of(texels.base_color, base_r));
        case opacity:
            return fill_from(level.opacity, 1, same);
        case metallic:
            return copy(texels.metallic);
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
        case dielectric_b:
            copy(plane_of(texels.dielectric_f0, dielectric_r));
            for (std::size_t i = 0; i < texels.specular_factor.size(); ++i)
                if (texels.specular_factor[i] > 0) values[i] /= texels.specular_factor[i];
            return;
        case specular_factor:
            return copy(texels.specular_factor);
        case emissive_r:
        case emissive_g:
        case emissive_b: {
            const int c = first - static_cast<int>(emissive_r);
            return fill_from(level.emissive, 0, [c](const Colour& light) { return light[c]; });
        }
        case diffuse_r:
        case diffuse_g:
        case diffuse_b:
            return copy(plane_of(texels.base_color, diffuse_r));
        case f0_r:
        case f0_g:
        case f0_b:
            return copy(plane_of(texels.dielectric_f0, f0_r));
    }
}

Unpacked shaded(const Layout& layout, const pbr::MetallicMaterial<float>& material, float specular_factor,
                float perceptual_roughness) {
    const pbr::Reflected<float> reflected =
        layout.is_specular_gloss
            ? pbr::reflected_from_specular(material.base_color, material.dielectric_f0, kSpecularGloss)
            : pbr::reflected_from_metallic(material, layout.coupling);
    return {material, specular_factor, perceptual_roughness, reflected,
            grazing_reflectance(layout.grazing, material.metallic, specular_factor, reflected.f0)};
}

Unpacked packed(const Layout& layout, const Texels& texels, std::size_t i) {
    return shaded(
        layout,
        {texels.base_color[i], texels.metallic.empty() ? 0 : texels.metallic[i], texels.dielectric_f0[i]},
        texels.specular_factor.empty() ? 1 : texels.specular_factor[i],
        texels.level.perceptual_roughness[texels.begin + i]);
}

Unpacked unpack(const Layout& layout, const std::vector<Image>& images, int x, int y, float specular_unit,
                double scale) {
    Decoded found{{Colour(0), 0, Colour(layout.dielectric_f0)}};
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
    found.material.dielectric_f0 *= found.specular_factor;
    return shaded(layout, found.material, found.specular_factor, found.perceptual_roughness);
}

}  // namespace pbrbake::texture
