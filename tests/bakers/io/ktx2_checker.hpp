#pragma once
// Holds a KTX2 file against the specification (KTX File Format 2.0, Khronos Data Format 1.3), for the formats
// that pbrbake writes. Written from the specification and sharing nothing with the writer.

#include <cstddef>
#include <string>
#include <vector>

namespace pbrbake::io::test {

/// Every breach found, in words; none for a valid file.
std::vector<std::string> check_ktx2(const std::vector<std::byte>& file);

}  // namespace pbrbake::io::test
