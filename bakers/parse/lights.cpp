#include "bakers/parse/lights.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "bakers/parse/gltf_file.hpp"
#include "bakers/parse/json_fields.hpp"
#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

LightFile parse_json_lights(std::string_view text, const std::string& file,
                            const LightConventions& conventions) {
    const Json json = parse_json_source(text, file);
    if (!json.is_object())
        throw malformed(file, 0,
                        "is JSON, but no object; allowed: glTF, a three.js scene, or {\"lights\": […]}");
    if (json.contains("asset")) return parse_gltf_lights(json, file, conventions.gltf);
    if (json.contains("metadata") || json.contains("object"))
        return parse_three_lights(json, file, conventions.three);
    if (json.contains("lights")) return parse_plain_lights(json, file);
    throw malformed(file, 0,
                    "is JSON without \"asset\" (glTF), \"metadata\" (three.js) or \"lights\" (plain lights)");
}

bool has_extension(const std::string& file, std::string_view extension) {
    std::string end = file.substr(file.size() - std::min(file.size(), extension.size()));
    std::transform(end.begin(), end.end(), end.begin(),
                   [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    return end == extension;
}

LightFile parse_text_lights(std::string_view text, const std::string& file,
                            const LightConventions& conventions) {
    const std::size_t start = text.find_first_not_of(" \t\r\n\v\f");
    if (start == text.npos) throw malformed(file, 0, "holds nothing but blanks");
    const std::string_view head = text.substr(start);
    if (head.starts_with('<')) return parse_collada_lights(text, file);
    if (head.starts_with("AC3D")) return parse_ac3d_lights(text, file);
    if (has_extension(file, ".ogex")) return parse_opengex_lights(text, file);
    const bool is_map =
        has_extension(file, ".map") || has_extension(file, ".ent") || has_extension(file, ".vmf");
    if (has_extension(file, ".csv")) return parse_csv_lights(text, file);
    // A map's first brace opens an entity's "key" "value"; JSON has a colon there.
    if (head.starts_with('{') && !is_map) {
        const std::size_t key = head.find('"'), end = key == head.npos ? head.npos : head.find('"', key + 1);
        const std::size_t next = end == head.npos ? head.npos : head.find_first_not_of(" \t\r\n", end + 1);
        if (next == head.npos || head[next] != '"') return parse_json_lights(text, file, conventions);
    }
    if (head.starts_with('[')) return parse_json_lights(text, file, conventions);
    if (is_map || head.find("\"classname\"") != head.npos) return parse_entity_lights(text, file);
    if (head.find("LightObject") != head.npos || head.starts_with("Metric"))
        return parse_opengex_lights(text, file);
    const std::string_view line = head.substr(0, head.find_first_of("\r\n"));
    if (line.find(',') != line.npos) return parse_csv_lights(text, file);
    throw malformed(
        file, 1,
        "begins with " + parse::quoted(line) +
            ", as no format known does; allowed: COLLADA, glTF, three.js and plain JSON, Quake and "
            "Source maps, OpenGEX, AC3D, CSV");
}

/// A scene's format that isn't read, by how its files begin; "" for none.
std::string_view other_format(std::string_view raw) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kOthers{
        {{"Kaydara", "FBX"},
         {"; FBX", "FBX"},
         {"FORM", "a LightWave object"},
         {"LWSC", "a LightWave scene"},
         {"MM", "3D Studio's 3DS"}}};
    for (const auto& [magic, name] : kOthers)
        if (raw.starts_with(magic)) return name;
    return "";
}

}  // namespace

LightFile parse_lights(std::span<const std::byte> bytes, std::string_view file,
                       const LightConventions& conventions) {
    const std::string name(file);
    const std::string_view raw(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (is_binary_gltf(bytes)) return parse_gltf_lights(parse_gltf(bytes, name).json, name, conventions.gltf);
    if (const std::string_view other = other_format(raw); !other.empty())
        throw malformed(file, 0, "is " + std::string(other) + ", which isn't read; export glTF or COLLADA");
    std::vector<Diagnostic> diagnostics;
    const std::string text = decode_text(bytes, file, diagnostics);
    LightFile lights = parse_text_lights(text, name, conventions);
    constexpr double kLeast_m = 1e-6, kMost_m = 1e6;
    if (!(lights.unit_m >= kLeast_m && lights.unit_m <= kMost_m))
        throw malformed(file, 0,
                        "states a length of " + number_text(lights.unit_m) +
                            " m as its unit; allowed: from 0.000001 to 1000000");
    lights.diagnostics.insert(lights.diagnostics.begin(), diagnostics.begin(), diagnostics.end());
    return lights;
}

}  // namespace pbrbake::parse
