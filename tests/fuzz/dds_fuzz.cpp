// Any bytes as a DDS file: a picture, or an error.

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "bakers/io/codec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace pbrbake;
    try {
        const io::ReadBack back =
            io::read_dds_product({reinterpret_cast<const std::byte*>(data), size}, "fuzz.dds");
        if (back.image.levels.empty() || back.image.levels[0].texels.empty()) std::abort();
    } catch (const Error&) {
    }
    return 0;
}
