#include "bakers/parse/materials.hpp"

#include <algorithm>
#include <array>

#include "bakers/job/words.hpp"
#include "bakers/parse/gltf_file.hpp"
#include "bakers/parse/json_fields.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr std::array<std::string_view, 5> kExtensions{".mtl", ".gltf", ".glb", ".dae", ".json"};

/// Of JSON, by what it holds.
MaterialFile parse_json_materials(std::span<const std::byte> bytes, const std::string& file) {
    GltfFile gltf = parse_gltf(bytes, file);
    const bool is_object = gltf.json.is_object();
    if (!is_object || !(gltf.json.contains("asset") || gltf.json.contains("materials")))
        throw malformed(file, 0, "is JSON without \"asset\" (glTF) or \"materials\" (plain materials)");
    MaterialFile materials = gltf.json.contains("asset") ? parse_gltf_materials(gltf.json, file)
                                                         : parse_plain_materials(gltf.json, file);
    materials.diagnostics = std::move(gltf.diagnostics);
    return materials;
}

/// The fields of a texture bake, by which plain JSON states a material.
void read_stated(const JsonFields& fields, LegacyMaterial& material) {
    material.lobe = MaterialLobe::stated;
    const std::string name = fields.text({"name"}, "");
    if (name.empty()) fields.refuse("name", "a name, which each material has");
    material.name = name;
    const std::array<std::pair<const char*, MaterialMap*>, 7> maps{{{"diffuse", &material.diffuse},
                                                                    {"specular", &material.specular},
                                                                    {"gloss", &material.gloss},
                                                                    {"normal", &material.normal},
                                                                    {"occlusion", &material.occlusion},
                                                                    {"opacity", &material.opacity},
                                                                    {"emissive", &material.emissive}}};
    material.fields = fields.json();
    material.fields.erase("name");
    for (const auto& [key, map] : maps) {
        map->said = fields.place() + "/" + key;
        map->path = fields.text({key}, "");
        std::ranges::replace(map->path, '\\', '/');
        material.fields.erase(key);
    }
}

std::string names_of(const MaterialFile& materials) {
    constexpr std::size_t kMost = 20;
    std::vector<std::string> names;
    for (const LegacyMaterial& material : materials.materials)
        if (names.size() < kMost) names.push_back('"' + material.name + '"');
    const std::size_t left = materials.materials.size() - names.size();
    return job::joined(names) + (left > 0 ? " and " + std::to_string(left) + " more" : "");
}

}  // namespace

std::string extension_of(std::string_view file) {
    const std::size_t dot = file.find_last_of("./\\");
    if (dot == file.npos || file[dot] != '.') return {};
    std::string end(file.substr(dot));
    std::ranges::transform(end, end.begin(),
                           [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    return end;
}

bool has_material_extension(std::string_view file) {
    return std::ranges::find(kExtensions, extension_of(file)) != kExtensions.end();
}

MaterialFile parse_materials(std::span<const std::byte> bytes, const std::string& file) {
    const std::string extension = extension_of(file);
    MaterialFile materials;
    if (extension == ".mtl" || extension == ".dae") {
        std::vector<Diagnostic> diagnostics;
        const std::string text = decode_text(bytes, file, diagnostics);
        materials = extension == ".mtl" ? parse_mtl(text, file) : parse_collada_materials(text, file);
        materials.diagnostics.insert(materials.diagnostics.begin(), diagnostics.begin(), diagnostics.end());
    } else {
        materials = parse_json_materials(bytes, file);
    }
    if (materials.materials.empty()) throw malformed(file, 0, "holds no materials");
    return materials;
}

const LegacyMaterial& find_material(const MaterialFile& materials, const std::string& name,
                                    const std::string& file) {
    for (const auto key : {&LegacyMaterial::name, &LegacyMaterial::id})
        for (const LegacyMaterial& material : materials.materials)
            if (material.*key == name) return material;
    std::vector<std::string> names;
    for (const LegacyMaterial& material : materials.materials) names.push_back(material.name);
    throw malformed(file, 0,
                    "found no material " + parse::quoted(name) + "; allowed: " + names_of(materials) +
                        job::did_you_mean(name, names));
}

/// {"materials": [{"name": "crate", "diffuse": "crate_d.png", …}]}: the fields of a texture bake.
MaterialFile parse_plain_materials(const Json& json, const std::string& file) {
    MaterialFile result;
    result.format = "plain JSON";
    const JsonFields root(json, file);
    const std::vector<JsonFields> list = root.objects("materials");
    if (list.size() > kMostMaterials) root.refuse("materials", "at most 100000 materials");
    for (const JsonFields& fields : list) {
        LegacyMaterial& material = result.materials.emplace_back();
        material.name = "material " + std::to_string(result.materials.size() - 1);
        read_alone(material, [&] { read_stated(fields, material); });
    }
    return result;
}

}  // namespace pbrbake::parse
