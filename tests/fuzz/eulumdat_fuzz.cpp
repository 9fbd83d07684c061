// Any bytes as EULUMDAT.

#include <span>

#include "tests/fuzz/photometry_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return pbrbake::test::fuzz_photometry(data, size, [](std::span<const std::byte> bytes) {
        return pbrbake::parse::parse_eulumdat(bytes, "fuzz.ldt");
    });
}
