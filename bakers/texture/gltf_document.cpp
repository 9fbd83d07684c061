// glTF 2.0 ("Material"), KHR_materials_ior, KHR_materials_specular, KHR_materials_emissive_strength and
// KHR_texture_transform. glTF's dielectric f0 is .04 unless an extension says otherwise.

#include "bakers/texture/gltf_document.hpp"

#include <algorithm>
#include <cmath>

namespace pbrbake::texture {
namespace {

constexpr double kGltfF0 = .04;

Json json_of(const Colour& colour) { return {colour.x, colour.y, colour.z}; }

class Material {
  public:
    Material(const TextureParams& params, const Layout& layout) : params_(params), layout_(layout) {}

    Json build(float specular_unit, const std::optional<Unpacked>& factors) {
        if (factors)
            add_factors(*factors);
        else if (layout_.is_specular_gloss)
            add_specular_gloss();
        else
            add_metallic(specular_unit);
        if (!factors) add_relief();
        add_opacity();
        add_emission(!factors);
        if (params_.double_sided) material_["doubleSided"] = true;
        return std::move(material_);
    }

  private:
    bool has(const char* name) const {
        return std::ranges::find(layout_.images, name, &PackedImage::name) != layout_.images.end();
    }

    Json texture(const char* name) const {
        const auto image = std::ranges::find(layout_.images, name, &PackedImage::name);
        Json info{{"index", image - layout_.images.begin()}}, transform;
        if (params_.uv_offset != std::vector<double>{0, 0}) transform["offset"] = params_.uv_offset;
        if (params_.uv_rotation != 0) transform["rotation"] = params_.uv_rotation;
        if (params_.uv_scale != std::vector<double>{1, 1}) transform["scale"] = params_.uv_scale;
        if (!transform.is_null()) info["extensions"]["KHR_texture_transform"] = std::move(transform);
        return info;
    }

    /// Occlusion and normals.
    void add_relief() {
        if (!params_.occlusion.empty()) {
            material_["occlusionTexture"] = texture(layout_.is_specular_gloss ? "occlusion" : "orm");
            if (params_.occlusion_strength != 1)
                material_["occlusionTexture"]["strength"] = params_.occlusion_strength;
        }
        if (has("normal")) {
            material_["normalTexture"] = texture("normal");
            if (params_.normal_scale != 1) material_["normalTexture"]["scale"] = params_.normal_scale;
        }
    }

    void add_specular_gloss() {
        material_["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
            {"diffuseTexture", texture("diffuse")}, {"specularGlossinessTexture", texture("specular_gloss")}};
    }

    void add_metallic(float specular_unit) {
        material_["pbrMetallicRoughness"] = {{"baseColorTexture", texture("base_color")},
                                             {"metallicRoughnessTexture", texture("orm")}};
        if (layout_.has_residual) {
            const double factor = static_cast<double>(specular_unit) / kGltfF0;
            material_["extensions"]["KHR_materials_specular"] = {
                {"specularColorFactor", {factor, factor, factor}},
                {"specularColorTexture", texture("specular")}};
            if (layout_.has_specular_factor())  // the same picture's alpha
                material_["extensions"]["KHR_materials_specular"]["specularTexture"] = texture("specular");
        } else {
            add_dielectric_f0(Colour(layout_.dielectric_f0), 1);
        }
    }

    void add_factors(const Unpacked& factors) {
        const auto& [base_color, metallic, dielectric_f0] = factors.material;
        material_["pbrMetallicRoughness"] = {
            {"baseColorFactor", {base_color.x, base_color.y, base_color.z, 1}},
            {"metallicFactor", metallic},
            {"roughnessFactor", factors.perceptual_roughness}};
        add_dielectric_f0(dielectric_f0, factors.specular_factor);
    }

    /// `factor` is what the dielectric reflects at grazing incidence; it multiplies f0 too.
    void add_dielectric_f0(const Colour& dielectric_f0, float factor) {
        constexpr float kSame = 1e-6f;
        Json& extensions = material_["extensions"];
        if (factor < 1) extensions["KHR_materials_specular"]["specularFactor"] = factor;
        const Colour f0 = factor > 0 ? dielectric_f0 / factor : Colour(static_cast<float>(kGltfF0));
        if (pbr::max_channel(glm::abs(f0 - Colour(f0.x))) >= kSame) {
            extensions["KHR_materials_specular"]["specularColorFactor"] =
                json_of(f0 / static_cast<float>(kGltfF0));
        } else if (std::abs(f0.x - static_cast<float>(kGltfF0)) >= kSame) {
            const double root = std::sqrt(static_cast<double>(f0.x));
            extensions["KHR_materials_ior"]["ior"] = (1 + root) / (1 - std::min(root, .999));
        }
        if (extensions.is_null()) material_.erase("extensions");
    }

    void add_opacity() {
        const bool has_opacity = params_.opacity_factor < 1 || layout_.images.front().channels.size() == 4;
        if (params_.opacity_factor < 1) {
            Json& factor =
                layout_.is_specular_gloss
                    ? material_["extensions"]["KHR_materials_pbrSpecularGlossiness"]["diffuseFactor"]
                    : material_["pbrMetallicRoughness"]["baseColorFactor"];
            if (factor.is_null()) factor = {1, 1, 1, 1};
            factor[3] = params_.opacity_factor;
        }
        if (params_.alpha_mode == AlphaMode::mask) {
            material_["alphaMode"] = "MASK";
            material_["alphaCutoff"] = params_.alpha_cutoff;
        } else if (params_.alpha_mode == AlphaMode::blend ||
                   (params_.alpha_mode == AlphaMode::automatic && has_opacity)) {
            material_["alphaMode"] = "BLEND";
        }
    }

    void add_emission(bool with_texture) {
        std::vector<double> factor = params_.emissive_factor;
        const bool has_map = with_texture && has("emissive");
        if (has_map) material_["emissiveTexture"] = texture("emissive");
        if (*std::ranges::max_element(factor) == 0) {
            if (!has_map) return;
            factor = {1, 1, 1};
        }
        const double strength = std::max(1., *std::ranges::max_element(factor));
        for (double& channel : factor) channel /= strength;
        material_["emissiveFactor"] = factor;
        if (strength > 1)
            material_["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    }

    const TextureParams& params_;
    const Layout& layout_;
    Json material_ = Json::object();
};

}  // namespace

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

void find_extensions(const Json& json, std::set<std::string>& names) {
    if (!json.is_structured()) return;
    for (const auto& [key, value] : json.items()) {
        if (key == "extensions" && value.is_object())
            for (const auto& [name, extension] : value.items()) names.insert(name);
        find_extensions(value, names);
    }
}

Json gltf_material(const TextureParams& params, const Layout& layout, float specular_unit,
                   const std::optional<Unpacked>& factors) {
    Json images = Json::array();
    if (!factors)
        for (const PackedImage& image : layout.images) images.push_back(image.name);
    Json material = Material(params, layout).build(specular_unit, factors);
    return {{"images", std::move(images)}, {"material", std::move(material)}};
}

Json gltf_document(const TextureParams& params, const Json& gltf, const std::string& file) {
    const std::string stem = file.substr(0, file.find_last_of('.'));
    Json material{{"name", params.material.empty() ? stem : params.material}};
    material.update(gltf["material"]);
    Json document{{"asset", {{"version", "2.0"}, {"generator", "pbrbake"}}}};
    std::set<std::string> extensions;
    find_extensions(material, extensions);
    if (!extensions.empty()) document["extensionsUsed"] = extensions;
    document["materials"] = Json::array({std::move(material)});
    if (gltf["images"].empty()) return document;

    for (std::size_t i = 0; i < gltf["images"].size(); ++i) {
        const std::string name = stem + "_" + gltf["images"][i].get<std::string>() + ".png";
        document["images"].push_back({{"uri", uri_of(name)}, {"mimeType", "image/png"}});
        document["textures"].push_back({{"source", i}, {"sampler", 0}});
    }
    constexpr int kRepeat = 10497, kClampToEdge = 33071;  // OpenGL's, as glTF has them
    const int wrap = params.wrap == Wrap::clamp ? kClampToEdge : kRepeat;
    document["samplers"] = Json::array({{{"wrapS", wrap}, {"wrapT", wrap}}});
    return document;
}

}  // namespace pbrbake::texture
