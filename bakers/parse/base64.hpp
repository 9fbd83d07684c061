#pragma once
// Base64 as data URIs hold it.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pbrbake::parse {

/// The bytes of RFC 4648's base64, its padding left out or whole. Nothing else may be in it, line ends
/// neither: throws Error(unreadable_input) at `place`, with what was found and where.
std::vector<std::byte> decode_base64(std::string_view text, const std::string& place);

}  // namespace pbrbake::parse
