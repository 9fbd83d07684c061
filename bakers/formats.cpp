#include "bakers/formats.hpp"

#include <algorithm>
#include <array>

#include "bakers/error.hpp"

namespace pbrbake {

std::span<const Format> formats() {
    using enum PixelType;
    static const std::array<Format, 8> table{{{"exr", {half, float32}, 1024, true, false},
                                              {"ktx2", {half, float32, unorm16, unorm8}, 4, true, true},
                                              {"dds", {half, float32, unorm16, unorm8}, 4, true, true},
                                              {"png", {unorm16, unorm8}, 4, false, false},
                                              {"hdr", {rgbe}, 3, false, false},
                                              {"h", {half, float32, unorm16}, 4, false, true},
                                              {"json", {}, 0, false, false},
                                              {"gltf", {}, 0, false, false}}};
    return table;
}

const Format* find_format(std::string_view name) {
    const auto found = std::ranges::find(formats(), name, &Format::name);
    return found == formats().end() ? nullptr : &*found;
}

const Format& picture_format(std::string_view name) {
    const Format& format = *find_format(name);
    return format.is_document() ? *find_format("png") : format;
}

std::string_view pixel_name(PixelType pixel) {
    constexpr std::array<std::string_view, 5> kNames{"half", "float", "unorm16", "unorm8", "rgbe"};
    return kNames[static_cast<std::size_t>(pixel)];
}

PixelType settle_pixel(std::string_view format, std::string_view pixel) {
    const Format* container = find_format(format);
    if (!container) throw Error(ExitCode::invalid_job, "", "unknown format '" + std::string(format) + "'");
    if (pixel == "auto") return container->is_document() ? PixelType::float32 : container->pixels.front();
    std::string allowed = "\"auto\"";
    for (const PixelType type : container->pixels) {
        if (pixel == pixel_name(type)) return type;
        allowed.append(", \"").append(pixel_name(type)).append("\"");
    }
    throw Error(ExitCode::invalid_job, "",
                "found \"" + std::string(pixel) + "\", which the format " + std::string(format) +
                    " doesn't hold; allowed: " + allowed);
}

}  // namespace pbrbake
