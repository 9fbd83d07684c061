#include "bakers/texture/gltf_document.hpp"

namespace pbrbake::texture {
namespace {

/// A file's name as a URI reference (RFC 3986, section 3.3): other bytes than unreserved ones as %XX.
std::string uri_of(const std::string& file) {
    constexpr std::string_view kHex = "0123456789ABCDEF", kUnreserved = "-._~";
    std::string uri;
    for (const char c : file) {
        const auto byte = static_cast<unsigned char>(c);
        if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
            kUnreserved.find(c) != kUnreserved.npos)
            uri += c;
        else
            uri.append({'%', kHex[byte >> 4], kHex[byte & 15]});
    }
    return uri;
}

void add_source(const parse::LegacyMaterial& source, Json& material) {
    material["name"] = source.name;
    if (source.opacity_factor != 1)
        material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, source.opacity_factor};
    if (source.alpha == parse::AlphaMode::blend) material["alphaMode"] = "BLEND";
    if (source.alpha == parse::AlphaMode::mask) {
        material["alphaMode"] = "MASK";
        material["alphaCutoff"] = source.alpha_cutoff;
    }
    if (material.contains("normalTexture") && source.normal_scale != 1)
        material["normalTexture"]["scale"] = source.normal_scale;
    if (source.occlusion_strength != 1 && material.contains("occlusionTexture"))
        material["occlusionTexture"]["strength"] = source.occlusion_strength;
    if (source.emissive != glm::dvec3(0)) {
        const double largest = std::max({1., source.emissive.x, source.emissive.y, source.emissive.z});
        const glm::dvec3 factor = source.emissive / largest;
        material["emissiveFactor"] = {factor.x, factor.y, factor.z};
        if (largest > 1)
            material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", largest}};
    }
    if (source.double_sided) material["doubleSided"] = true;
}

}  // namespace

Json gltf_document(const Json& gltf, const std::string& first_file, const parse::LegacyMaterial* source) {
    Json material = gltf["material"];
    material["name"] = first_file.substr(0, first_file.find_last_of('.'));
    if (source) add_source(*source, material);

    Json images = Json::array(), textures = Json::array();
    for (std::size_t i = 0; i < gltf["images"].size(); ++i) {
        const std::string file =
            i == 0 ? first_file : image_file(first_file, gltf["images"][i].get<std::string>());
        images.push_back({{"uri", uri_of(file)}, {"mimeType", "image/png"}});
        textures.push_back({{"source", i}, {"sampler", 0}});
    }
    constexpr int kRepeat = 10497, kClampToEdge = 33071;  // OpenGL's, as glTF has them
    const int wrap = source && source->is_clamped ? kClampToEdge : kRepeat;
    Json document{{"asset", {{"version", "2.0"}, {"generator", "pbrbake"}}}};
    if (material.contains("extensions")) {
        document["extensionsUsed"] = Json::array();
        for (const auto& [name, value] : material["extensions"].items())
            document["extensionsUsed"].push_back(name);
    }
    document["images"] = std::move(images);
    document["samplers"] = {{{"wrapS", wrap}, {"wrapT", wrap}}};
    document["textures"] = std::move(textures);
    document["materials"] = Json::array({std::move(material)});
    return document;
}

}  // namespace pbrbake::texture
