#pragma once
// What a product holds.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/baker.hpp"
#include "bakers/verify/plausible.hpp"

namespace pbrbake::verify {

/// One channel of one level. NaN and infinite texels are counted and left out of the rest.
struct ChannelSummary {
    double lowest = 0;
    double highest = 0;
    double mean =
        0;  ///< over the sphere for a cube map (each texel weighs its solid angle), else over texels
    double energy = 0;  ///< integral over the sphere, value x sr; 0 for a picture
    std::uint64_t non_finite = 0;
};

struct LevelSummary {
    int width = 0, height = 0;
    std::vector<ChannelSummary> channels;
};

struct Inspection {
    std::string format, pixel;
    int faces = 1;  ///< of a volume: its slices
    bool is_volume = false;
    std::vector<std::string> channels;
    double scale = 1;  ///< of the file; the summaries are divided by it
    std::string units;
    std::vector<LevelSummary> levels;
    std::vector<RangeCheck> ranges;  ///< of a texture set, else none
    Json record;  ///< the product's entry in X.ext.json or manifest.json beside it; null if neither lists it
};

/// Reads a product and its record, or a JPEG, TGA or TIFF as a bake reads it. `set` says what belongs to the
/// picture where that isn't recorded, or isn't to count. Throws Error(unreadable_input).
Inspection inspect(const std::filesystem::path& file, const SetFiles& set = {});

/// The same as a document of schemas/inspection.schema.json.
Json inspection_json(const Inspection& inspection);

}  // namespace pbrbake::verify
