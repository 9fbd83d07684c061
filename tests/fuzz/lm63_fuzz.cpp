// Any bytes as a photometric file, LM-63 unless it begins as EULUMDAT does.

#include <span>

#include "tests/fuzz/photometry_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return pbrbake::test::fuzz_photometry(data, size, [](std::span<const std::byte> bytes) {
        return pbrbake::parse::parse_photometry(bytes, "fuzz.ies");
    });
}
