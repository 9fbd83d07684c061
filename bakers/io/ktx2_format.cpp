#include "bakers/io/ktx2_format.hpp"

namespace pbrbake::io::ktx2 {

std::optional<Format> format_for(int channels, PixelType pixel, Transfer transfer) {
    if (pixel != PixelType::unorm8) transfer = Transfer::linear;
    for (const Format& format : kFormats)
        if (format.pixel == pixel && format.transfer == transfer && format.channels >= channels)
            return format;
    return {};
}

std::optional<Format> format_of(std::uint32_t vk_format) {
    for (const Format& format : kFormats)
        if (format.vk_format == vk_format) return format;
    return {};
}

}  // namespace pbrbake::io::ktx2
