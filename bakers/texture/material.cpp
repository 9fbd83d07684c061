#include "bakers/texture/material.hpp"

#include <array>

#include "bakers/texture/gltf_document.hpp"

namespace pbrbake::texture {
namespace {

constexpr std::array<std::string_view, 29> kHeldNames{"0",
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
                                                      "specular_factor",
                                                      "emissive.r",
                                                      "emissive.g",
                                                      "emissive.b",
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

/// What the renderer applies, and no picture holds.
Json surface_json(const TextureParams& params) {
    return {{"alpha_mode", enum_name(params.alpha_mode)},
            {"alpha_cutoff", params.alpha_cutoff},
            {"opacity_factor", params.opacity_factor},
            {"emissive_factor", params.emissive_factor},
            {"normal_scale", params.normal_scale},
            {"occlusion_strength", params.occlusion_strength},
            {"double_sided", params.double_sided},
            {"wrap", enum_name(params.wrap)},
            {"uv_offset", params.uv_offset},
            {"uv_scale", params.uv_scale},
            {"uv_rotation", params.uv_rotation}};
}

/// What was read as gloss, as what, and why.
Json gloss_json(const GlossReading& gloss) {
    constexpr std::array kChannels{".r", ".g", ".b", ".a"};
    Json json{{"in", enum_name(gloss.in)}};
    if (!gloss.field.empty()) json["in"] = gloss.field + kChannels[static_cast<std::size_t>(gloss.channel)];
    if (gloss.in != GlossIn::none) json["is"] = enum_name(gloss.is);
    json["reason"] = gloss.reason;
    return json;
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
    json["above_one"] = findings.above_one;
    json["over_unity"] = findings.over_unity;
    return json;
}

Json factors_json(const Unpacked& factors) {
    const auto& [base, metallic, f0] = factors.material;
    Json json{{"base_color", {base.x, base.y, base.z}},
              {"metallic", metallic},
              {"perceptual_roughness", factors.perceptual_roughness},
              {"dielectric_f0", {f0.x, f0.y, f0.z}}};
    if (factors.specular_factor < 1) json["specular_factor"] = factors.specular_factor;
    return json;
}

Unpacked factors_from(const Json& json, const Layout& layout) {
    const auto colour = [](const Json& list) {
        return Colour(list[0].get<float>(), list[1].get<float>(), list[2].get<float>());
    };
    const pbr::MetallicMaterial<float> material{colour(json["base_color"]), json["metallic"].get<float>(),
                                                colour(json["dielectric_f0"])};
    return shaded(layout, material, json.value("specular_factor", 1.f),
                  json["perceptual_roughness"].get<float>());
}

Json material_json(const TextureParams& params, const Layout& layout, float specular_unit,
                   const std::optional<Unpacked>& factors) {
    Json json{{"version", 1}, {"packing", enum_name(params.packing)}};
    if (!params.material.empty()) json["name"] = params.material;
    json["channels"] = factors ? Json::object() : channels_json(layout);
    if (factors) json["factors"] = factors_json(*factors);
    json["surface"] = surface_json(params);
    if (params.packing == Packing::gltf || layout.is_specular_gloss)
        json["gltf"] = gltf_material(params, layout, specular_unit, factors);
    if (layout.has_residual && !factors) json["dielectric_f0_unit"] = specular_unit;
    return json;
}

}  // namespace pbrbake::texture
