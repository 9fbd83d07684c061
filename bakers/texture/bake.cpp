#include <algorithm>
#include <cmath>

#include "bakers/formats.hpp"
#include "bakers/texture/chain.hpp"
#include "bakers/texture/convert.hpp"
#include "bakers/texture/difference.hpp"
#include "bakers/texture/gltf_document.hpp"
#include "bakers/texture/material.hpp"
#include "bakers/texture/pack.hpp"
#include "bakers/texture/source_material.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::texture {
namespace {

using Materials = std::vector<pbr::MetallicMaterial<float>>;

Materials materials_of(const TextureParams& params, const Layout& layout, const MapLevel& level,
                       const std::vector<Colour>& tolerance, Context& context) {
    Materials materials(level.texels());
    context.parallel_for(level.height, 16, [&](std::int64_t begin, std::int64_t end) {
        const std::size_t last = static_cast<std::size_t>(end) * level.width;
        for (std::size_t i = static_cast<std::size_t>(begin) * level.width; i < last; ++i)
            materials[i] =
                material_of(params, layout, level, i, tolerance.empty() ? Colour(1e-6f) : tolerance[i]);
    });
    return materials;
}

/// The largest dielectric f0 that matters, at least the usual one: what a code of 1 stands for. Texels that
/// are nearly all metal don't show theirs.
float specular_unit(const TextureParams& params, const Materials& materials) {
    auto largest = static_cast<float>(params.dielectric_f0);
    for (const auto& material : materials)
        if (material.metallic < .99f) largest = std::max(largest, pbr::max_channel(material.dielectric_f0));
    return largest;
}

Image named_image(const PackedImage& packed) {
    static const std::array<const char*, 4> kNames{"R", "G", "B", "A"};
    Image image;
    image.name = packed.name;
    for (std::size_t c = 0; c < packed.channels.size(); ++c) image.channels.emplace_back(kNames[c]);
    image.transfer = packed.is_colour ? Transfer::srgb : Transfer::linear;
    return image;
}

Image confidence_image(const Converted& set) {
    Image image{
        "confidence", {"R"}, 1, {{set.level.width, set.level.height, set.confidence}}, Transfer::linear};
    return image;
}

/// Black to white over a colour difference of 0 to 10, before codes.
Image difference_image(const Sources& sources, const Layout& layout, const Converted& set,
                       const Materials& materials, Context& context) {
    constexpr float kFullScale = 10;
    const MapLevel& level = set.level;
    Level heat{level.width, level.height, std::vector<float>(level.texels())};
    const auto scattering =
        sources.params().multiscatter ? pbr::Scattering::multiple : pbr::Scattering::single;
    context.parallel_for(level.height, 16, [&](std::int64_t begin, std::int64_t end) {
        const std::size_t last = static_cast<std::size_t>(end) * level.width;
        for (std::size_t i = static_cast<std::size_t>(begin) * level.width; i < last; ++i) {
            const float p = level.perceptual_roughness[i];
            const Colour before = pbr_albedo({level.diffuse[i], level.f0[i]}, p, scattering).total();
            const Colour after =
                pbr_albedo(pbr::reflected_from_metallic(materials[i], layout.coupling), p, scattering)
                    .total();
            heat.texels[i] = std::min(1.f, static_cast<float>(delta_e(before, after)) / kFullScale);
        }
    });
    return {"difference", {"R"}, 1, {std::move(heat)}, Transfer::linear};
}

/// Adds what triangular noise of one code's width takes from banding, where codes are 8 bits.
void dither(const TextureParams& params, std::vector<Image>& images) {
    constexpr float kCode = 1.f / 255;
    for (std::size_t m = 0; m < images.size(); ++m)
        for (Level& level : images[m].levels)
            for (std::size_t i = 0; i < level.texels.size(); ++i) {
                const auto seed = static_cast<std::uint64_t>(params.seed);
                const double noise =
                    pbr::random_unit(seed + m, 2 * i) - pbr::random_unit(seed + m, 2 * i + 1);
                float& value = level.texels[i];
                // In sRGB's scale a code is narrower in the dark: half_step knows its width.
                const float code = images[m].transfer == Transfer::srgb && i % images[m].channels.size() < 3
                                       ? 2 * half_step(value, 8, true)
                                       : kCode;
                if (value > 0 && value < 1) value += static_cast<float>(noise) * code / 2;
            }
}

void warn(const Sources& sources, const Findings& found, Product& product) {
    for (const std::string& warning : sources.warnings()) product.warnings.push_back(warning);
    const auto percent = [](double share) {
        return std::to_string(static_cast<int>(share * 100 + .5)) + " %";
    };
    if (found.f0_clamped > 0)
        product.warnings.push_back(
            percent(found.f0_clamped) +
            " of texels had specular lobes that reflect more than a PBR lobe can; f0 is 1 there");
    if (found.over_unity > .01)
        product.warnings.push_back(percent(found.over_unity) + " of texels return more light than arrives");
    if (found.low_confidence > .5)
        product.warnings.push_back("the data don't tell metal from dielectric in " +
                                   percent(found.low_confidence) + " of texels; state surface, or calibrate");
    if (found.calibration == "statistics")
        product.warnings.push_back(
            "specular was scaled so that its median dielectric reflects the usual f0; state "
            "surface or calibrate none if it is f0 already");
}

void add_documents(const TextureParams& params, const Layout& layout, float unit, const Inputs& inputs,
                   const std::string& first_file, Product& product) {
    const Json json = material_json(params, layout, unit);
    product.documents.push_back({"material.json", json, ""});
    if (params.packing != Packing::gltf || !first_file.ends_with(".png")) return;
    const auto material = source_material(params, inputs);
    product.documents.push_back(
        {"material.gltf", gltf_document(json["gltf"], first_file, material ? &*material : nullptr), ""});
}

}  // namespace

std::vector<Mistake> check(const TextureParams& params, const std::string& format) {
    std::vector<Mistake> mistakes;
    if (params.source.empty() && params.diffuse.empty() && params.specular.empty())
        mistakes.push_back(
            {"/diffuse", "missing, and specular too; a set has one of them at least, or a source"});
    if (!params.material.empty() && !parse::has_material_extension(params.source))
        mistakes.push_back({"/material", "found one, but source is no file of materials"});
    const Format* container = find_format(format);
    if (container && !container->is_chain && params.levels != 1)
        mistakes.push_back({"/levels", "found " + std::to_string(params.levels) + ", but " + format +
                                           " holds one level; allowed: 1, or format exr, ktx2, dds"});
    if (container && container->max_channels < 4)
        mistakes.push_back(
            {"/format", "found \"" + format + "\"; allowed for texture sets: exr, ktx2, dds, png"});
    if (params.gloss_is == GlossIs::automatic && !params.gloss.empty() &&
        params.model != Model::specular_gloss)
        mistakes.push_back(
            {"/gloss_is", "missing; an exponent map of a " + std::string(enum_name(params.model)) +
                              " lobe needs its scale: power or power_log2 with power_scale, or smoothness"});
    return mistakes;
}

std::vector<Read> reads(const TextureParams& params) {
    std::vector<Read> list;
    const auto add = [&](const char* field, const std::string& path, const std::string& space) {
        if (!path.empty()) list.push_back({field, path, space, Read::As::picture, true});
    };
    if (parse::has_material_extension(params.source))
        list.push_back({"source", params.source, "", Read::As::text});
    add("diffuse", params.diffuse, params.colour_space);
    add("specular", params.specular, params.colour_space);
    add("gloss", params.gloss, "raw");
    add("normal", params.normal, "raw");
    add("occlusion", params.occlusion, "raw");
    add("opacity", params.opacity, "raw");
    return list;
}

std::vector<std::string> images(const TextureParams& params) {
    std::vector<std::string> names;
    for (const PackedImage& image : layout_of(params, false).images) names.push_back(image.name);
    names.erase(names.begin());
    for (const ExtraMap map : params.maps) names.emplace_back(enum_name(map));
    return names;
}

/// glTF takes PNG (and JPEG) pictures.
std::vector<std::string> documents(const TextureParams& params, const std::string& format) {
    if (params.packing == Packing::gltf && format == "png") return {"material.json", "material.gltf"};
    return {"material.json"};
}

Product bake(const TextureParams& given, const Inputs& inputs, Context& context) {
    const TextureParams params = settled(given, inputs);
    const Sources sources(params, inputs);
    Converted set = convert(sources, context);
    const Layout layout = layout_of(params, sources.has_opacity());
    Materials materials = materials_of(params, layout, set.level, set.tolerance, context);
    const float unit = layout.has_residual ? specular_unit(params, materials) : 1;

    Product product;
    for (const PackedImage& image : layout.images) product.images.push_back(named_image(image));
    const auto add_levels = [&](const MapLevel& level, const Materials& of) {
        std::vector<Level> packed = pack(params, layout, level, of, unit, context);
        for (std::size_t i = 0; i < packed.size(); ++i)
            product.images[i].levels.push_back(std::move(packed[i]));
    };
    add_levels(set.level, materials);
    std::vector<Image> extras;
    for (const ExtraMap map : params.maps)
        extras.push_back(map == ExtraMap::confidence
                             ? confidence_image(set)
                             : difference_image(sources, layout, set, materials, context));
    MapLevel level = std::move(set.level);
    while (static_cast<int>(product.images.front().levels.size()) != params.levels &&
           std::max(level.width, level.height) > 1) {
        context.check_cancelled();
        level = next_level(level, context);
        add_levels(level, materials_of(params, layout, level, {}, context));
    }
    for (Image& image : extras) product.images.push_back(std::move(image));
    if (params.dither) dither(params, product.images);
    product.pixel = PixelType::unorm8;
    product.properties["set"] = properties_json(params, layout, set.findings, sources, unit);
    add_documents(params, layout, unit, inputs, context.product_file(), product);
    product.warnings = source_warnings(params, inputs);
    warn(sources, set.findings, product);
    return product;
}

}  // namespace pbrbake::texture
