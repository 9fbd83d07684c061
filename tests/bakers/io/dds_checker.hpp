#pragma once
// Holds a DDS file against Microsoft's "Programming Guide for DDS", for the formats that pbrbake writes.
// Written from that text and sharing nothing with the writer.

#include <cstddef>
#include <string>
#include <vector>

namespace pbrbake::io::test {

/// Every breach found, in words; none for a valid file.
std::vector<std::string> check_dds(const std::vector<std::byte>& file);

}  // namespace pbrbake::io::test
