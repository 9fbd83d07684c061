#pragma once
// The metadata that io itself writes into containers or reads from them.

#include <string>
#include <vector>

namespace pbrbake::io {

/// How many of a mip-mapped EXR's levels are the product's own; the others only fill up OpenEXR's chain.
inline constexpr const char* kLevelsKey = "pbrbake:levels";
/// Channel names in memory order, "R,G,B": EXR sorts its channels, KTX2 has no names.
inline constexpr const char* kChannelsKey = "pbrbake:channels";
inline constexpr const char* kWorkingSpaceKey = "pbrbake:working_space";
inline constexpr const char* kUnitsKey = "pbrbake:units";
inline constexpr const char* kScaleKey = "pbrbake:scale";

inline std::string join_channels(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    return text;
}

inline std::vector<std::string> split_channels(const std::string& text) {
    std::vector<std::string> names(1);
    for (const char c : text) {
        if (c == ',')
            names.emplace_back();
        else
            names.back() += c;
    }
    return names;
}

}  // namespace pbrbake::io
