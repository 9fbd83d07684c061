#include "bakers/parse/materials.hpp"

#include <algorithm>
#include <array>

#include "bakers/job/json_text.hpp"
#include "bakers/job/words.hpp"
#include "bakers/parse/json_fields.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr int kDeepest = 512;
constexpr std::array<std::string_view, 4> kExtensions{".mtl", ".gltf", ".dae", ".json"};

std::string extension_of(std::string_view file) {
    const std::size_t dot = file.find_last_of("./\\");
    if (dot == file.npos || file[dot] != '.') return {};
    std::string end(file.substr(dot));
    std::ranges::transform(end, end.begin(),
                           [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    return end;
}

Json json_of(std::string_view text, const std::string& file) {
    try {
        return job::parse_json(text, file, kDeepest);
    } catch (const Error& error) {
        throw Error(ExitCode::unreadable_input, error.where(), error.message());
    }
}

MaterialFile parse_json_materials(std::string_view text, const std::string& file) {
    const Json json = json_of(text, file);
    if (json.is_object() && json.contains("asset")) return parse_gltf_materials(json, file);
    if (json.is_object() && json.contains("materials")) return parse_plain_materials(json, file);
    throw malformed(file, 0, "is JSON without \"asset\" (glTF) or \"materials\" (plain materials)");
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

bool has_material_extension(std::string_view file) {
    return std::ranges::find(kExtensions, extension_of(file)) != kExtensions.end();
}

MaterialFile parse_materials(std::span<const std::byte> bytes, const std::string& file) {
    std::vector<Diagnostic> diagnostics;
    const std::string text = decode_text(bytes, file, diagnostics);
    const std::string extension = extension_of(file);
    MaterialFile materials = extension == ".mtl"   ? parse_mtl(text, file)
                             : extension == ".dae" ? parse_collada_materials(text, file)
                                                   : parse_json_materials(text, file);
    if (materials.materials.empty()) throw malformed(file, 0, "holds no materials");
    materials.diagnostics.insert(materials.diagnostics.begin(), diagnostics.begin(), diagnostics.end());
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

std::optional<std::string> path_refusal(const std::string& path) {
    if (path.starts_with("data:")) return "is embedded";
    if (path.empty() || std::ranges::any_of(path, [](char c) { return static_cast<unsigned char>(c) < 32; }))
        return "is no path";
    if (path.starts_with('/') || path.find(':') != path.npos) return "is no file beside this one";
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        if (path.substr(begin, end - begin) == "..") return "leads out of the folder";
        begin = end + 1;
    }
    return {};
}

std::string path_of_uri(std::string_view uri) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool is_code =
            uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
        path += is_code          ? static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]))
                : uri[i] == '\\' ? '/'
                                 : uri[i];
        if (is_code) i += 2;
    }
    return path;
}

/// {"materials": [{"name": "crate", "diffuse": "crate_d.png", …}]}: the fields of a texture bake.
MaterialFile parse_plain_materials(const Json& json, const std::string& file) {
    MaterialFile result;
    result.format = "plain JSON";
    const JsonFields root(json, file);
    const std::vector<JsonFields> list = root.objects("materials");
    if (list.size() > kMostMaterials) root.refuse("materials", "at most 100000 materials");
    for (const JsonFields& fields : list) {
        LegacyMaterial material;
        material.lobe = MaterialLobe::stated;
        material.name = fields.text({"name"}, "");
        if (material.name.empty()) fields.refuse("name", "a name, which each material has");
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
        result.materials.push_back(std::move(material));
    }
    return result;
}

}  // namespace pbrbake::parse
