#include "bakers/io/component.hpp"

namespace pbrbake::io {

void store_texels(const Image& image, const Level& level, std::size_t first, std::size_t count,
                  std::size_t stored, PixelType pixel, std::byte* out) {
    constexpr std::byte kOne{255};
    const std::size_t channels = image.channels.size(), begin = first * channels;
    if (!level.codes.empty()) {
        const std::uint8_t* code = level.codes.data() + begin;
        for (std::size_t i = 0; i < count; ++i, code += channels)
            for (std::size_t c = 0; c < stored; ++c) *out++ = c < channels ? std::byte{code[c]} : kOne;
        return;
    }
    const float* texel = level.texels.data() + begin;
    for (std::size_t i = 0; i < count; ++i, texel += channels)
        for (std::size_t c = 0; c < stored; ++c, out += component_bytes(pixel))
            store_component(out, c < channels ? texel[c] : 1.f, pixel, channel_transfer(image, c));
}

}  // namespace pbrbake::io
