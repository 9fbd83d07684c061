// What is known of a bake before it runs: what is wrong with it, what it reads, and what it will write.

#include <algorithm>

#include "bakers/formats.hpp"
#include "bakers/parse/materials.hpp"
#include "bakers/texture/pack.hpp"
#include "bakers/texture/texture.hpp"

namespace pbrbake::texture {
namespace {

/// Which maps a model has.
std::vector<Mistake> check_maps(const TextureParams& params) {
    std::vector<Mistake> mistakes;
    const bool is_metallic = params.model == Model::metallic_roughness;
    const auto refuse = [&](const char* field, const std::string& path, const char* allowed) {
        if (!path.empty())
            mistakes.push_back({field, "found one beside model " + std::string(enum_name(params.model)) +
                                           "; allowed: " + allowed});
    };
    if (is_metallic) {
        constexpr const char* kAllowed = "base_color, metallic_roughness or metallic and gloss";
        refuse("/diffuse", params.diffuse, kAllowed);
        refuse("/specular", params.specular, kAllowed);
        if (!params.metallic.empty())
            refuse("/metallic_roughness", params.metallic_roughness, "it or metallic");
        const bool has_any =
            !params.base_color.empty() || !params.metallic_roughness.empty() || !params.metallic.empty();
        if (!has_any && params.source.empty())
            mistakes.push_back({"/base_color",
                                "missing, and metallic_roughness too; a set has one of them at least, or a "
                                "source"});
        if (params.calibrate == Calibrate::library)
            mistakes.push_back({"/calibrate",
                                "found \"library\", but a metallic_roughness set has no specular; "
                                "allowed: auto, none"});
        const bool is_told = params.surface == SurfaceIs::dielectric || params.surface == SurfaceIs::metal;
        if (is_told && params.source.empty())  // of a source, one material of several may have a mask
            mistakes.push_back(
                {"/surface", "found \"" + std::string(enum_name(params.surface)) +
                                 "\", but the mask of a metallic_roughness set says what it is; "
                                 "allowed: auto, any"});
        return mistakes;
    }
    for (const auto& [field, path] : {std::pair("/base_color", &params.base_color),
                                      {"/metallic_roughness", &params.metallic_roughness},
                                      {"/metallic", &params.metallic}})
        refuse(field, *path, "model metallic_roughness");
    if (params.source.empty() && params.diffuse.empty() && params.specular.empty())
        mistakes.push_back(
            {"/diffuse", "missing, and specular too; a set has one of them at least, or a source"});
    const bool has_unknown_gloss = params.gloss_is == GlossIs::automatic && !params.gloss.empty() &&
                                   gloss_named(params.gloss) == GlossIs::automatic;
    if (has_unknown_gloss && params.model != Model::specular_gloss && params.rules.empty())
        mistakes.push_back(
            {"/gloss_is", "missing; an exponent map of a " + std::string(enum_name(params.model)) +
                              " lobe needs its scale: power or power_log2 with power_scale, or smoothness"});
    return mistakes;
}

}  // namespace

std::vector<Mistake> check(const TextureParams& params, const std::string& format) {
    std::vector<Mistake> mistakes = check_maps(params);
    if (params.source.empty() && !params.material.empty())
        mistakes.push_back({"/material", "needs the source that it is in"});
    if (format == "gltf" && params.packing != Packing::gltf)
        mistakes.push_back({"/packing", "found \"" + std::string(enum_name(params.packing)) +
                                            "\"; allowed with format gltf: \"gltf\""});
    const bool is_gloss_in_alpha = params.gloss_in != GlossIn::automatic && params.gloss_in != GlossIn::gloss;
    if (is_gloss_in_alpha && params.gloss_channel != Channel::automatic)
        mistakes.push_back({"/gloss_channel", "found \"" + std::string(enum_name(params.gloss_channel)) +
                                                  "\" beside gloss_in " +
                                                  std::string(enum_name(params.gloss_in)) +
                                                  "; allowed: auto, or gloss_in auto or gloss"});
    if (params.gloss_in == GlossIn::normal_alpha && params.normal_in == NormalIn::ag)
        mistakes.push_back({"/gloss_in", "found \"normal_alpha\", but normal_in ag has x in that alpha"});
    if (params.packing != Packing::gltf && !params.emissive.empty())
        mistakes.push_back({"/emissive", "is written with packing gltf alone; allowed: \"\""});
    const Format* container = find_format(format);
    if (container && !container->is_chain && params.levels != 1)
        mistakes.push_back({"/levels", "found " + std::to_string(params.levels) + ", but " + format +
                                           " holds one level; allowed: 1, or format exr, ktx2, dds"});
    return mistakes;
}

std::vector<Read> reads(const TextureParams& params) {
    std::vector<Read> list;
    const auto add = [&](const char* field, const std::string& path, const std::string& space,
                         Infinity infinity = Infinity::peak) {
        if (!path.empty()) list.push_back({field, path, space, Read::As::picture, true, true, infinity});
    };
    add("diffuse", params.diffuse, params.colour_space);
    add("specular", params.specular, params.colour_space);
    add("base_color", params.base_color, params.colour_space);
    add("gloss", params.gloss, "raw", Infinity::largest_float);  // a mirror's exponent
    add("metallic_roughness", params.metallic_roughness, "raw");
    add("metallic", params.metallic, "raw");
    add("normal", params.normal, "raw");
    add("occlusion", params.occlusion, "raw");
    add("opacity", params.opacity, "raw");
    add("emissive", params.emissive, params.colour_space);
    if (!params.rules.empty()) list.push_back({"rules", params.rules, "", Read::As::text});
    if (parse::has_material_extension(params.source))
        list.push_back({"source", params.source, "", Read::As::text});
    return list;
}

std::vector<std::string> images(const TextureParams& params, const std::string& format) {
    std::vector<std::string> names;
    if (format == "gltf" && !has_pictures(params)) return names;
    names = image_names(params);
    if (format != "gltf") names.erase(names.begin());
    for (const ExtraMap map : params.maps) names.emplace_back(enum_name(map));
    return names;
}

std::vector<std::string> documents(const std::string& format) {
    if (format == "gltf") return {"gltf", "material.json"};
    return {"material.json"};
}

}  // namespace pbrbake::texture
