#include "bakers/texture/source_material.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pbrbake::texture {
namespace {

using parse::LegacyMaterial;
using parse::MaterialLobe;
using parse::MaterialMap;

/// The folder of a path with its slash, or "".
std::string folder_of(const std::string& path) { return path.substr(0, path.find_last_of("/\\") + 1); }

/// Fills in fields that the bake leaves out.
class Filling {
  public:
    Filling(Json& bake, const FileQueries& files, const std::string& source)
        : bake_(bake), files_(files), source_(source), folder_(folder_of(source)) {}

    void set(const char* field, Json value) {
        if (!bake_.contains(field)) bake_[field] = std::move(value);
    }

    /// A map that the material names must be there, in the tree of its file's folder.
    void map(const char* field, const MaterialMap& map) {
        if (map.path.empty() || bake_.contains(field)) return;
        const std::string path = folder_ + parse::inner_path(map, source_);
        if (!files_.exists(path))
            throw parse::malformed(source_, map.line,
                                   map.said + ": there is no file \"" + path + "\"; put it there, or state " +
                                       field + " in the job (\"\" for none)");
        bake_[field] = path;
    }

    /// A picture "base" + one of the endings, of any kind that is read.
    bool picture(const char* field, const std::string& base, std::initializer_list<const char*> endings) {
        constexpr std::array kExtensions{".png", ".tga", ".jpg", ".jpeg", ".tif", ".tiff", ".exr"};
        for (const char* ending : endings)
            for (const char* extension : kExtensions)
                if (files_.exists(base + ending + extension)) {
                    set(field, base + ending + extension);
                    return true;
                }
        return false;
    }

    /// What gloss is goes together: who states a part of it states all of it.
    bool states_gloss() const {
        return std::ranges::any_of(std::array{"gloss", "gloss_in", "gloss_is", "power"},
                                   [&](const char* field) { return bake_.contains(field); });
    }

  private:
    Json& bake_;
    const FileQueries& files_;
    const std::string& source_;
    std::string folder_;
};

/// An unmapped factor of 1 says nothing in a job, but a material that states it means it.
Json specular_json(glm::dvec3 factor, bool is_mapped) {
    constexpr double kNearlyOne = 1 - 1e-6;
    if (!is_mapped && factor == glm::dvec3(1)) factor = glm::dvec3(kNearlyOne);
    return {factor.x, factor.y, factor.z};
}

void fill_gloss(const LegacyMaterial& material, Filling& fill) {
    if (fill.states_gloss()) return;
    constexpr double kWidest = 1e-3;  // an exponent of 0 means no exponent in a job
    if (material.lobe == MaterialLobe::specular_gloss) {
        fill.set("gloss_in", material.specular.path.empty() ? "constant" : "specular_alpha");
        fill.set("gloss_factor", material.glossiness);
    } else if (!material.gloss.path.empty()) {
        fill.map("gloss", material.gloss);
        fill.set("gloss_is", "power");
        fill.set("power_scale", std::max(material.exponent.value_or(1), kWidest));
    } else if (material.exponent) {
        fill.set("gloss_in", "constant");
        fill.set("gloss_is", "power");
        fill.set("power_scale", std::max(*material.exponent, kWidest));
    }
}

void fill_from_material(const LegacyMaterial& material, Filling& fill) {
    fill.map("diffuse", material.diffuse);
    fill.map("specular", material.specular);
    fill.map("normal", material.normal);
    fill.map("occlusion", material.occlusion);
    fill.map("opacity", material.opacity);
    if (material.lobe == MaterialLobe::stated) {
        fill.map("gloss", material.gloss);
        for (const auto& [field, value] : material.fields.items()) fill.set(field.c_str(), value);
        return;
    }
    fill_gloss(material, fill);
    fill.set("diffuse_factor",
             {material.diffuse_factor.x, material.diffuse_factor.y, material.diffuse_factor.z});
    fill.set("alpha_is", material.alpha == parse::AlphaMode::opaque ? "nothing" : "opacity");
    if (material.is_clamped) fill.set("wrap", "clamp");
    if (material.lobe == MaterialLobe::none) {
        fill.set("model", "specular_gloss");
        fill.set("diffuse_coupling", "none");
        fill.set("specular_factor", {0, 0, 0});
        return;
    }
    if (material.specular_factor)
        fill.set("specular_factor",
                 specular_json(*material.specular_factor, !material.specular.path.empty()));
    if (material.lobe == MaterialLobe::specular_gloss) {
        fill.set("model", "specular_gloss");
        fill.set("normal_green", "up");  // glTF 2.0, "Material.normalTexture"
    } else {
        fill.set("model", material.lobe == MaterialLobe::phong ? "phong" : "blinn_phong");
        fill.set("norm", "over_pi");  // Kd and Ks are lit by one light, and Kd is an albedo
    }
}

/// id Tech 4's names: crate_d, crate_s, crate_n (or crate_local), crate_g. Its light is multiplied by the
/// cosine for both terms; where there is no gloss its table stands in for an exponent of 16 (Doom 3,
/// R_SpecularTableImage).
void fill_from_names(const std::string& base, Filling& fill) {
    constexpr double kExponent = 16;
    const bool has_diffuse = fill.picture("diffuse", base, {"_d", ""});
    const bool has_specular = fill.picture("specular", base, {"_s"});
    if (!has_diffuse && !has_specular)
        throw Error(
            ExitCode::unreadable_input, base,
            "is neither a material (.mtl, .gltf, .dae, .json) nor the base name of pictures: there is "
            "no " +
                base + "_d.png or _s.png; allowed: png, tga, jpg, tif, exr");
    fill.picture("normal", base, {"_n", "_local"});
    fill.set("model", "blinn_phong");
    fill.set("norm", "over_pi");
    if (fill.states_gloss()) return;
    if (fill.picture("gloss", base, {"_g"}))
        fill.set("gloss_is", "smoothness");
    else
        fill.set("power", kExponent);
}

/// Plain JSON says what a job may say, apart from what names and writes a bake.
void check_fields(const LegacyMaterial& material, const std::string& source) {
    if (material.lobe != MaterialLobe::stated) return;
    const std::vector<std::string> allowed = field_names<TextureParams>();
    for (const auto& [field, value] : material.fields.items())
        if (std::ranges::find(allowed, field) == allowed.end() || field == "source" || field == "material")
            throw parse::malformed(source, 0,
                                   "material \"" + material.name + "\": found \"" + field +
                                       "\", which is no field of a texture set");
}

bool is_grey(const Image& image) {
    const std::size_t channels = image.channels.size();
    const std::vector<float>& texels = image.levels.front().texels;
    if (channels < 3) return true;
    for (std::size_t i = 0; i + 2 < texels.size(); i += channels)
        if (texels[i] != texels[i + 1] || texels[i] != texels[i + 2]) return false;
    return true;
}

}  // namespace

void expand(Json& bake, const FileQueries& files) {
    const auto given = bake.find("source");
    if (given == bake.end() || !given->is_string() || given->get_ref<const std::string&>().empty()) return;
    const std::string source = *given;
    Filling fill(bake, files, source);
    if (!parse::has_material_extension(source)) return fill_from_names(source, fill);
    const auto name = bake.find("material");
    const std::string text = files.text(source);
    const parse::MaterialFile file = parse::parse_materials(std::as_bytes(std::span(text)), source);
    const LegacyMaterial& material = parse::find_material(
        file, name != bake.end() && name->is_string() ? name->get<std::string>() : "", source);
    check_fields(material, source);
    fill_from_material(material, fill);
}

std::optional<LegacyMaterial> source_material(const TextureParams& params, const Inputs& inputs) {
    const auto source = inputs.find("source");
    if (source == inputs.end()) return {};
    const parse::MaterialFile file = parse::parse_materials(source->second.bytes, source->second.name);
    return parse::find_material(file, params.material, source->second.name);
}

std::vector<std::string> source_warnings(const TextureParams& params, const Inputs& inputs) {
    const std::optional<LegacyMaterial> material = source_material(params, inputs);
    std::vector<std::string> warnings;
    if (!material) return warnings;
    for (const parse::Diagnostic& found : material->diagnostics) {
        std::string warning = params.source;
        if (found.line > 0) warning.append(":").append(std::to_string(found.line));
        warnings.push_back(
            warning.append(": \"").append(material->name).append("\": ").append(found.message));
    }
    if (params.diffuse_factor == std::vector<double>{0, 0, 0} && !params.diffuse.empty())
        warnings.push_back(params.source + ": \"" + material->name +
                           "\": multiplies its diffuse map by 0; state diffuse_factor if that isn't meant");
    return warnings;
}

TextureParams settled(const TextureParams& given, const Inputs& inputs) {
    TextureParams params = given;
    const auto normal = inputs.find("normal");
    if (normal != inputs.end() && is_grey(normal->second.image))
        throw Error(
            ExitCode::unreadable_input, params.normal,
            "normal: is grey, so it holds heights; allowed: tangent-space normals (state normal, \"\" "
            "for none)");
    const auto specular = inputs.find("specular");
    const bool from_file = inputs.contains("source");
    if (from_file && params.gloss_in == GlossIn::specular_alpha && specular != inputs.end() &&
        specular->second.image.channel_count() < 4)
        params.gloss_in = GlossIn::constant;
    return params;
}

}  // namespace pbrbake::texture
