// `source`: materials of other formats, or the names of pictures, as fields of texture sets.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "bakers/parse/materials.hpp"
#include "bakers/parse/text.hpp"
#include "bakers/texture/scene.hpp"
#include "bakers/texture/texture.hpp"

namespace pbrbake::texture {
namespace {

using parse::LegacyMaterial;
using parse::MaterialLobe;
using parse::MaterialMap;

constexpr double kDielectricF0 = .04;  ///< of metallic-roughness materials (glTF 2.0, appendix B)

/// The folder of a path with its slash, or "".
std::string folder_of(const std::string& path) { return path.substr(0, path.find_last_of("/\\") + 1); }

/// "scene.mtl:12"; line 0 leaves the number out.
std::string place(const std::string& file, int line) {
    std::string text = file;
    if (line > 0) text.append(":").append(std::to_string(line));
    return text;
}

Json json_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Fills in the fields that a bake leaves out.
class Filling {
  public:
    Filling(Expansion& expansion, const FileQueries& files, const std::string& source)
        : bake_(expansion.bake), warnings_(expansion.warnings), files_(files), source_(source) {}

    bool states(const char* field) const { return bake_.contains(field); }

    void set(const char* field, Json value) {
        if (!states(field)) bake_[field] = std::move(value);
    }

    void set_vector(const char* field, const glm::dvec3& value) { set(field, json_of(value)); }

    void warn(const std::string& message, int line = 0) {
        warnings_.push_back(place(source_, line) + ": material \"" + material_ + "\": " + message);
    }

    /// Of messages: the source, its line and the material.
    void set_material(const std::string& name) { material_ = name; }

    /// A map that the material names must be there, in the tree of its file's folder.
    void map(const char* field, const MaterialMap& map) {
        if (map.path.empty() || states(field)) return;
        const std::string path = find(field, map);
        if (!path.ends_with(map.path.substr(map.path.starts_with("./") ? 2 : 0)))
            warn(map.said + ": took \"" + path + "\" for \"" + map.path + "\"", map.line);
        bake_[field] = path;
        transforms_[field] = map.transform;
    }

    /// A picture "base" + one of the endings, of any kind that is read.
    bool picture(const char* field, const std::string& base, std::initializer_list<const char*> endings) {
        if (states(field)) return true;
        constexpr std::array kExtensions{".png", ".tga", ".jpg", ".jpeg", ".tif", ".tiff", ".exr"};
        for (const char* ending : endings)
            for (const char* extension : kExtensions)
                if (const std::string path = files_.find(base + ending + extension); !path.empty()) {
                    set(field, path);
                    return true;
                }
        return false;
    }

    bool is_file(const std::string& path) const { return !files_.find(path).empty(); }

    /// What gloss is goes together: who states a part of it states all of it. But gloss_is alone says how the
    /// source's map is read, if it has one.
    bool states_gloss(bool has_map) const {
        return (states("gloss_is") && !has_map) ||
               std::ranges::any_of(std::array{"gloss", "gloss_in", "gloss_factor", "power"},
                                   [&](const char* field) { return states(field); });
    }

    /// What moves the pictures, if it moves all of them alike. A whole document that the material is a part
    /// of keeps where each of its textures is read; specular goes into pictures that are read where diffuse
    /// is.
    void finish_transform(bool is_part) {
        if (transforms_.empty()) return;
        const parse::UvTransform first = transforms_.begin()->second;
        bool is_moved_alike = true, has_sets = false;
        for (const auto& [field, transform] : transforms_) {
            is_moved_alike &= transform.is_moved_like(first);
            has_sets |= transform.set != 0;
        }
        if (is_part) {
            if (transforms_.contains("diffuse") && transforms_.contains("specular") &&
                transforms_["diffuse"] != transforms_["specular"])
                warn(
                    "its specular picture has other texture coordinates than its diffuse one; they are left "
                    "out");
        } else {
            if (has_sets) warn("its pictures have texture coordinates of their own; the first are taken");
            if (!is_moved_alike)
                warn("its pictures are moved or repeated differently; they are all left in place");
        }
        if (!is_moved_alike || first.is_moved_like({})) return;
        set("uv_offset", {first.offset.x, first.offset.y});
        set("uv_scale", {first.scale.x, first.scale.y});
        set("uv_rotation", first.rotation);
    }

  private:
    /// As the material has it, else a file of that name beside the material: paths of other machines.
    std::string find(const char* field, const MaterialMap& map) const {
        if (map.is_embedded) return source_ + map.path;
        const std::optional<std::string> refusal = parse::path_refusal(map.path);
        const std::string folder = folder_of(source_),
                          inner = map.path.starts_with("./") ? map.path.substr(2) : map.path,
                          name = map.path.substr(folder_of(map.path).size());
        if (!refusal)
            if (std::string path = files_.find(folder + inner); !path.empty()) return path;
        const bool is_file = !name.empty() && name != ".." && name != ".";
        if (is_file)
            if (std::string path = files_.find(folder + name); !path.empty()) return path;
        throw parse::malformed(source_, map.line,
                               map.said + ": " +
                                   (refusal ? parse::quoted(map.path) + " " + *refusal
                                            : "there is no file \"" + folder + inner + "\"") +
                                   "; put the picture beside " + source_ + ", or state " + field +
                                   " (\"\" for none)");
    }

    Json& bake_;
    std::vector<std::string>& warnings_;
    const FileQueries& files_;
    const std::string& source_;
    std::string material_;
    std::map<std::string, parse::UvTransform> transforms_;  ///< by field
};

/// An unmapped factor of 1 says nothing in a job, but a material that states it means it.
Json specular_json(glm::dvec3 factor, bool is_mapped) {
    constexpr double kNearlyOne = 1 - 1e-6;
    return json_of(!is_mapped && factor == glm::dvec3(1) ? glm::dvec3(kNearlyOne) : factor);
}

void fill_constant_gloss(double smoothness, Filling& fill) {
    fill.set("gloss_in", "constant");
    fill.set("gloss_is", "smoothness");
    fill.set("gloss_factor", smoothness);
}

void fill_phong_gloss(const LegacyMaterial& material, Filling& fill) {
    constexpr double kWidest = 1e-3;  // an exponent of 0 means no exponent in a job
    if (fill.states_gloss(!material.gloss.path.empty())) return;
    if (material.gloss.path.empty()) {
        if (material.exponent) fill.set("power", std::max(*material.exponent, kWidest));
        return;
    }
    fill.map("gloss", material.gloss);
    fill.set("gloss_is", "power");
    if (material.exponent)
        fill.set("power_scale", std::max(*material.exponent, kWidest));
    else
        fill.warn(material.gloss.said + ": has no exponent to multiply; 1 is taken for 255",
                  material.gloss.line);
}

void fill_phong(const LegacyMaterial& material, Filling& fill) {
    fill.set("model", material.lobe == MaterialLobe::phong ? "phong" : "blinn_phong");
    fill.set("norm", "over_pi");  // Kd and Ks are lit by one light, and Kd is an albedo
    fill.map("specular", material.specular);
    if (material.specular_factor)
        fill.set("specular_factor",
                 specular_json(*material.specular_factor, !material.specular.path.empty()));
    fill_phong_gloss(material, fill);
}

/// One grey f0 below all metals' beside a diffuse colour: a high dielectric f0, which a mask would take for
/// some metal.
bool is_high_dielectric(const LegacyMaterial& material) {
    constexpr double kLeastMetal = .25;
    if (!material.specular.path.empty() || !material.specular_factor) return false;
    const glm::dvec3 f0 = *material.specular_factor;
    return f0 == glm::dvec3(f0.x) && f0.x < kLeastMetal && material.diffuse_factor != glm::dvec3(0);
}

void fill_specular_gloss(const LegacyMaterial& material, Filling& fill) {
    fill.set("model", "specular_gloss");
    fill.map("specular", material.specular);
    if (material.specular_factor)
        fill.set("specular_factor",
                 specular_json(*material.specular_factor, !material.specular.path.empty()));
    fill.set("normal_green", "up");    // glTF 2.0, "Material.normalTexture"
    fill.set("colour_space", "srgb");  // the extension's word for both pictures
    if (is_high_dielectric(material)) fill.set("surface", "dielectric");
    if (fill.states_gloss(!material.specular.path.empty())) return;
    if (material.specular.path.empty()) return fill_constant_gloss(material.glossiness, fill);
    fill.set("gloss_in", "specular_alpha");
    fill.set("gloss_factor", material.glossiness);
}

void fill_roughness(const LegacyMaterial& material, Filling& fill) {
    if (fill.states_gloss(!material.roughness_map.path.empty())) return;
    if (material.roughness_map.path.empty())
        return fill_constant_gloss(1 - material.perceptual_roughness, fill);
    fill.map("gloss", material.roughness_map);
    fill.set("gloss_is", "perceptual_roughness");
}

/// Without a metallic map, as the specular-gloss material that looks the same. Of a picture, all or nothing
/// is metal.
void fill_metallic(const LegacyMaterial& material, Filling& fill) {
    fill_roughness(material, fill);
    if (!material.metallic_map.path.empty()) {
        fill.set("model", "metallic_roughness");
        fill.map("base_color", material.diffuse);
        fill.map("metallic", material.metallic_map);
        return fill.set_vector("diffuse_factor", material.diffuse_factor);
    }
    const bool has_map = !material.diffuse.path.empty();
    double metallic = material.metallic;
    if (has_map && metallic > 0 && metallic < 1) {
        metallic = std::round(metallic);
        fill.warn("is metal in part, which isn't read beside a picture; taken as " +
                  std::string(metallic == 1 ? "metal" : "no metal"));
    }
    const glm::dvec3 base = material.diffuse_factor;
    const glm::dvec3 f0 = glm::dvec3(kDielectricF0 * (1 - metallic)) + base * metallic;
    fill.set("model", "specular_gloss");
    fill.set("f0_tolerance", 0);
    if (has_map && metallic == 1) fill.map("specular", material.diffuse);
    fill.set("specular_factor", specular_json(f0, has_map && metallic == 1));
    fill.set_vector("diffuse_factor", base * (1 - metallic));
    if (metallic < 1) fill.map("diffuse", material.diffuse);
}

void fill_diffuse(const LegacyMaterial& material, Filling& fill) {
    fill.map("diffuse", material.diffuse);
    fill.set_vector("diffuse_factor", material.diffuse_factor);
    if (!material.diffuse.path.empty() && material.diffuse_factor == glm::dvec3(0))
        fill.warn("multiplies its diffuse map by 0; state diffuse_factor if that isn't meant");
}

void fill_alpha(const LegacyMaterial& material, Filling& fill) {
    const bool is_opaque = material.alpha == parse::AlphaMode::opaque;
    constexpr std::array kModes{"opaque", "mask", "blend"};
    fill.map("opacity", material.opacity);
    fill.set("alpha_is", is_opaque ? "nothing" : "opacity");
    fill.set("alpha_mode", kModes[static_cast<std::size_t>(material.alpha)]);
    if (material.alpha == parse::AlphaMode::mask) fill.set("alpha_cutoff", material.alpha_cutoff);
    if (!is_opaque) fill.set("opacity_factor", material.opacity_factor);
}

void fill_emission(const LegacyMaterial& material, const Json& bake, Filling& fill) {
    if (bake.value("packing", Json("gltf")) != "gltf") return;
    fill.map("emissive", material.emissive);
    if (material.emissive_factor) fill.set_vector("emissive_factor", *material.emissive_factor);
}

void fill_from_material(const LegacyMaterial& material, bool is_part, Expansion& expansion, Filling& fill) {
    fill.set_material(material.name);
    for (const parse::Diagnostic& found : material.diagnostics) fill.warn(found.message, found.line);
    if (material.lobe == MaterialLobe::stated) {
        fill.map("diffuse", material.diffuse);
        fill.map("specular", material.specular);
        fill.map("gloss", material.gloss);
        fill.map("opacity", material.opacity);
        for (const auto& [field, value] : material.fields.items()) fill.set(field.c_str(), value);
    } else if (material.lobe == MaterialLobe::metallic) {
        fill_metallic(material, fill);
    } else {
        fill_diffuse(material, fill);
        if (material.lobe == MaterialLobe::specular_gloss) {
            fill_specular_gloss(material, fill);
        } else if (material.lobe == MaterialLobe::none) {
            fill.set("model", "specular_gloss");
            fill.set("diffuse_coupling", "none");
            fill.set_vector("specular_factor", glm::dvec3(0));
            if (!fill.states_gloss(false)) fill_constant_gloss(0, fill);
        } else {
            fill_phong(material, fill);
        }
    }
    if (material.lobe != MaterialLobe::stated) {
        fill_alpha(material, fill);
        if (material.is_clamped) fill.set("wrap", "clamp");
        if (material.normal_scale != 1) fill.set("normal_scale", material.normal_scale);
        if (material.occlusion_strength != 1) fill.set("occlusion_strength", material.occlusion_strength);
        if (material.double_sided) fill.set("double_sided", true);
    }
    fill.map("normal", material.normal);
    fill.map("occlusion", material.occlusion);
    fill_emission(material, expansion.bake, fill);
    fill.finish_transform(is_part);
}

/// Plain JSON says what a job may say, apart from what names and writes a bake.
void check_fields(const LegacyMaterial& material, const std::string& source) {
    if (material.lobe != MaterialLobe::stated) return;
    const std::vector<std::string> allowed = field_names<TextureParams>();
    for (const auto& [field, value] : material.fields.items())
        if (std::ranges::find(allowed, field) == allowed.end() || field == "source" || field == "material")
            throw parse::malformed(source, 0, "found \"" + field + "\", which is no field of a texture set");
}

/// Names as id Tech 4 and its kin have them: crate_d, crate_s, crate_n or crate_local. Their light is
/// multiplied by the cosine for both terms. Exponent: 16, times the alpha of _s where it varies (Daemon
/// engine, r_specularExponentMax). Doom 3's R_SpecularTableImage has pow(NoH, 16) beside what it really
/// stores, (4 NoH - 3)^2 above .75: of the same energy as an exponent of 9.8, of the same variance as 13.5.
void fill_from_names(const std::string& base, Filling& fill) {
    constexpr double kExponent = 16;
    const bool has_diffuse = fill.picture("diffuse", base, {"_d", "_diffuse", ""});
    const bool has_specular = fill.picture("specular", base, {"_s", "_specular"});
    if (!has_diffuse && !has_specular) {
        const std::string allowed =
            "; allowed: materials (.mtl, .gltf, .glb, .dae, .json), or the base name of pictures";
        if (fill.is_file(base))
            throw Error(ExitCode::unreadable_input, base, "is a file of a kind that isn't read" + allowed);
        throw Error(ExitCode::unreadable_input, base,
                    "is neither materials nor the base name of pictures: there is no " + base +
                        "_d.png or _s.png" + allowed + " (png, tga, jpg, tif, exr)");
    }
    fill.picture("normal", base, {"_n", "_normal", "_local"});
    fill.picture("occlusion", base, {"_o", "_ao"});
    fill.picture("emissive", base, {"_e", "_glow"});
    fill.set("model", "blinn_phong");
    fill.set("norm", "over_pi");
    if (fill.states_gloss(true)) return;
    if (fill.picture("gloss", base, {"_g", "_gloss"})) return fill.set("gloss_is", "smoothness");
    if (fill.states_gloss(false)) return;
    fill.set("gloss_is", "power");
    fill.set("power_scale", kExponent);
    fill.set("power", kExponent);
}

/// Materials' names as ends of bakes' names: in letters that these may hold, and each once.
class Suffixes {
  public:
    std::string of(const std::string& material) {
        constexpr std::size_t kLongest = 60;
        std::string plain("_");
        plain.append(material, 0, kLongest);
        for (char& letter : plain) {
            const bool is_plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                                  (letter >= '0' && letter <= '9') || letter == '.' || letter == '-';
            if (!is_plain) letter = '_';
        }
        std::string unique = plain;
        for (int i = 2; !taken_.insert(unique).second; ++i) unique = plain + "_" + std::to_string(i);
        return unique;
    }

  private:
    std::set<std::string> taken_;
};

Expansion expansion_of(const LegacyMaterial& material, const Json& bake, std::string suffix,
                       const FileQueries& files) {
    const std::string source = bake["source"];
    Expansion expansion{bake, std::move(suffix), {}, {}};
    expansion.bake["material"] = material.name;
    try {
        if (material.error) throw Error(*material.error);
        check_fields(material, source);
        Filling fill(expansion, files, source);
        fill_from_material(material, is_scene(bake), expansion, fill);
    } catch (const Error& error) {
        expansion.error =
            Error(error.code(), error.where(), "material \"" + material.name + "\": " + error.message());
    }
    return expansion;
}

}  // namespace

std::vector<Expansion> expand(const Json& bake, const FileQueries& files) {
    const std::string source = bake.value("source", ""), wanted = bake.value("material", "");
    if (source.empty()) return {{bake, "", {}, {}}};
    std::vector<Expansion> expansions;
    if (!parse::has_material_extension(source)) {
        expansions.push_back({bake, "", {}, {}});
        Filling fill(expansions.front(), files, source);
        fill_from_names(source, fill);
        return expansions;
    }
    const std::string text = files.text(source);
    const parse::MaterialFile file = parse::parse_materials(std::as_bytes(std::span(text)), source);
    if (!wanted.empty()) {
        expansions.push_back(expansion_of(find_material(file, wanted, source), bake, "", files));
    } else {
        const bool has_suffixes = file.materials.size() > 1 || is_scene(bake);
        Suffixes suffixes;
        for (const LegacyMaterial& material : file.materials)
            expansions.push_back(
                expansion_of(material, bake, has_suffixes ? suffixes.of(material.name) : "", files));
    }
    for (const parse::Diagnostic& found : file.diagnostics)
        expansions.front().warnings.push_back(place(source, found.line) + ": " + found.message);
    return expansions;
}

}  // namespace pbrbake::texture
