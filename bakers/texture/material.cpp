#include "bakers/texture/material.hpp"

#include <array>

namespace pbrbake::texture {
namespace {

constexpr std::array<std::string_view, 25> kHeldNames{"0",
                                                      "1",
                                                      "base_color.r",
                                                      "base_color.g",
                                                      "base_color.b",
                                                      "opacity",
                                                      "metallic",
                                                      "perceptual_roughness",
                                                      "smoothness",
                                                      "reflectance",
                                                      "specular",
                                                      "occlusion",
                                                      "normal.x",
                                                      "normal.y",
                                                      "-normal.y",
                                                      "normal.z",
                                                      "dielectric_f0.r",
                                                      "dielectric_f0.g",
                                                      "dielectric_f0.b",
                                                      "diffuse.r",
                                                      "diffuse.g",
                                                      "diffuse.b",
                                                      "f0.r",
                                                      "f0.g",
                                                      "f0.b"};

Json channels_json(const Layout& layout) {
    Json images = Json::object();
    for (const PackedImage& image : layout.images) {
        Json channels = Json::array();
        for (const Held held : image.channels) channels.push_back(kHeldNames[static_cast<std::size_t>(held)]);
        images[image.name] = std::move(channels);
    }
    return images;
}

/// Names of the layout's images, and where each is among them as a glTF textureInfo; null where it has none.
Json image_names(const Layout& layout) {
    Json images = Json::array();
    for (const PackedImage& image : layout.images) images.push_back(image.name);
    return images;
}

Json texture_info(const Layout& layout, std::string_view name) {
    Json info;
    for (std::size_t i = 0; i < layout.images.size(); ++i)
        if (layout.images[i].name == name) info["index"] = i;
    return info;
}

/// KHR_materials_pbrSpecularGlossiness, whose factors are 1.
Json specular_gloss_material(const Layout& layout) {
    Json material;
    material["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
        {"diffuseTexture", texture_info(layout, "diffuse")},
        {"specularGlossinessTexture", texture_info(layout, "specular_gloss")}};
    for (const auto& [name, field] :
         {std::pair("normal", "normalTexture"), {"occlusion", "occlusionTexture"}})
        if (const Json info = texture_info(layout, name); !info.is_null()) material[field] = info;
    if (layout.images.front().channels.size() == 4) material["alphaMode"] = "BLEND";
    return {{"images", image_names(layout)}, {"material", std::move(material)}};
}

/// glTF 2.0, "Material"; KHR_materials_specular, whose f0 is (ior's .04) specularColorFactor
/// specularColorTexture.
Json gltf_material(const Layout& layout, float specular_unit) {
    Json material;
    const auto texture = [&](const char* name) { return texture_info(layout, name); };
    material["pbrMetallicRoughness"] = {{"baseColorTexture", texture("base_color")},
                                        {"metallicRoughnessTexture", texture("orm")}};
    material["occlusionTexture"] = texture("orm");
    if (const Json normal = texture("normal"); !normal.is_null()) material["normalTexture"] = normal;
    if (layout.images.front().channels.size() == 4) material["alphaMode"] = "BLEND";
    if (layout.has_residual) {
        constexpr double kGltfF0 = .04;
        const double factor = static_cast<double>(specular_unit) / kGltfF0;
        material["extensions"]["KHR_materials_specular"] = {{"specularColorFactor", {factor, factor, factor}},
                                                            {"specularColorTexture", texture("specular")}};
    }
    return {{"images", image_names(layout)}, {"material", std::move(material)}};
}

/// What was read as gloss, as what, and why.
Json gloss_json(const GlossReading& gloss) {
    if (gloss.field.empty()) return {{"in", "none"}, {"reason", gloss.reason}};
    constexpr std::array kChannels{"r", "g", "b", "a"};
    return {{"in", gloss.field + "." + kChannels[static_cast<std::size_t>(gloss.channel)]},
            {"is", enum_name(gloss.is)},
            {"reason", gloss.reason}};
}

}  // namespace

Json properties_json(const TextureParams& params, const Layout& layout, const Survey& survey,
                     const Findings& findings, const Sources& sources, float specular_unit) {
    Json json{{"size", {sources.width(), sources.height()}},
              {"packing", enum_name(params.packing)},
              {"images", channels_json(layout)}};
    if (layout.has_residual) json["dielectric_f0_unit"] = specular_unit;
    const Calibration& calibration = survey.calibration;
    json["surface"] = calibration.surface;
    if (!calibration.word.empty()) json["surface_word"] = calibration.word;
    json["calibration"] = kind_name(calibration.kind);
    json["specular_scale"] = calibration.scale;
    if (!sources.rules().matched.empty()) json["rules"] = sources.rules().matched;
    json["gloss"] = gloss_json(sources.gloss());
    json["diffuse_alpha"] = sources.has_opacity() && params.opacity.empty() ? "opacity" : "nothing";
    if (sources.has_normal()) {
        json["normal_green"] = survey.green_down ? "down" : "up";
        json["green_correlation"] = survey.green_correlation;
    }
    const auto add = [&](const char* name, const std::optional<double>& value) {
        if (value) json[name] = *value;
    };
    add("gloss_correlation", survey.doubts.gloss_correlation);
    add("occlusion_correlation", survey.doubts.occlusion_correlation);
    add("exponent_median", survey.doubts.exponent_median);
    add("exponent_max", survey.doubts.exponent_max);
    json["mean_metallic"] = findings.metallic;
    json["mean_confidence"] = findings.confidence;
    json["low_confidence"] = findings.low_confidence;
    json["f0_clamped"] = findings.f0_clamped;
    json["over_unity"] = findings.over_unity;
    return json;
}

Json material_json(const TextureParams& params, const Layout& layout, float specular_unit) {
    Json json{{"packing", enum_name(params.packing)}, {"channels", channels_json(layout)}};
    if (layout.is_specular_gloss) json["gltf"] = specular_gloss_material(layout);
    if (params.packing == Packing::gltf) json["gltf"] = gltf_material(layout, specular_unit);
    if (layout.has_residual) json["dielectric_f0_unit"] = specular_unit;
    return json;
}

}  // namespace pbrbake::texture
