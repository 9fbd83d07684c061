// glTF 2.0: 3.6.1 "Buffers and Buffer Views", 3.6.2.4 "Data Alignment".

#include "bakers/texture/gltf_buffers.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "bakers/parse/gltf_file.hpp"
#include "bakers/texture/gltf_document.hpp"

namespace pbrbake::texture {
namespace {

void find_users(Json& json, std::vector<Json*>& users) {
    if (!json.is_structured()) return;
    for (auto& [key, value] : json.items()) {
        if (key == "extras") continue;
        if (key == "bufferView")
            users.push_back(&value);
        else
            find_users(value, users);
    }
}

std::uint64_t end_of(const Stretch& stretch) { return stretch.to + stretch.size; }

}  // namespace

std::vector<Json*> view_users(Json& document) {
    std::vector<Json*> users;
    find_users(document, users);
    return users;
}

bool names_views_plainly(const Json& document) {
    static const std::set<std::string> kKnown{"EXT_mesh_gpu_instancing",    "KHR_animation_pointer",
                                              "KHR_draco_mesh_compression", "KHR_lights_punctual",
                                              "KHR_mesh_quantization",      "MSFT_texture_dds"};
    constexpr std::array<std::string_view, 3> kFamilies{"KHR_materials_", "KHR_texture_", "EXT_texture_"};
    std::set<std::string> names;
    find_extensions(document, names);
    return std::ranges::all_of(names, [&](const std::string& name) {
        return kKnown.contains(name) || std::ranges::any_of(kFamilies, [&](std::string_view family) {
                   return name.starts_with(family);
               });
    });
}

std::vector<Stretch> covered_stretches(const Json& document, std::size_t buffer, const std::string& file) {
    constexpr std::uint64_t kStep = 8;
    const parse::JsonFields root(document, file);
    const std::vector<parse::JsonFields> buffers = root.objects("buffers");
    std::vector<Stretch> found;
    for (const parse::JsonFields& fields : root.objects("bufferViews")) {
        const parse::GltfView view = parse::gltf_view(fields, buffers);
        if (view.buffer == buffer) found.push_back({view.offset, 0, view.size});
    }
    std::ranges::sort(found, {}, &Stretch::from);
    std::vector<Stretch> stretches;
    for (Stretch next : found) {
        Stretch* last = stretches.empty() ? nullptr : &stretches.back();
        if (last && next.from < last->from + last->size) {
            last->size = std::max(last->size, next.from + next.size - last->from);
            continue;
        }
        const std::uint64_t end = last ? end_of(*last) : 0;
        next.to = next.from - (next.from - end) / kStep * kStep;
        stretches.push_back(next);
    }
    return stretches;
}

void describe_stretches(const std::vector<Stretch>& stretches, std::size_t buffer, Json& document) {
    for (Json& view : document["bufferViews"]) {
        if (view["buffer"] != buffer) continue;
        const std::uint64_t offset = view.value("byteOffset", std::uint64_t{0});
        const Stretch& stretch = *(std::ranges::upper_bound(stretches, offset, {}, &Stretch::from) - 1);
        const std::uint64_t moved = offset - stretch.from + stretch.to;
        view.erase("byteOffset");
        if (moved > 0) view["byteOffset"] = moved;
    }
    document["buffers"][buffer]["byteLength"] = end_of(stretches.back());
}

std::string stretch_bytes(const std::vector<Stretch>& stretches, std::span<const std::byte> bytes) {
    std::string packed(end_of(stretches.back()), '\0');
    for (const Stretch& stretch : stretches)
        std::ranges::copy(bytes.subspan(stretch.from, stretch.size),
                          reinterpret_cast<std::byte*>(packed.data()) + stretch.to);
    return packed;
}

}  // namespace pbrbake::texture
