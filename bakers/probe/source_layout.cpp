#include "bakers/probe/source_layout.hpp"

#include <algorithm>
#include <array>

namespace pbrbake::probe {
namespace {

constexpr std::array<const char*, 6> kFaceNames{"px", "nx", "py", "ny", "pz", "nz"};

std::string path_of_face(const ProbeParams& params, std::size_t face) {
    std::string path = params.source;
    path.replace(path.find(kFacePattern), kFacePattern.size(), kFaceNames[face]);
    return path;
}

bool is_pattern(const ProbeParams& params) { return params.source.find(kFacePattern) != std::string::npos; }

std::string field_of_face(std::size_t face) { return std::string("source.") + kFaceNames[face]; }

Error misshapen(const std::string& path, int width, int height, const std::string& wanted) {
    return Error(ExitCode::unreadable_input, path,
                 "is " + std::to_string(width) + " x " + std::to_string(height) + " texels; " + wanted);
}

/// A face within a picture, in faces from its upper left, perhaps turned upside down.
struct FacePlace {
    int column, row;
    bool turned = false;
};
using Places = std::array<FacePlace, 6>;

constexpr Places kColumn{{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}};
constexpr Places kRow{{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}};
// +Y above, -X +Z +X beside each other, -Y below; -Z follows +X, or hangs below -Y, where it stands on its
// head.
constexpr Places kLyingCross{{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};
constexpr Places kStandingCross{{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3, true}}};

struct Arrangement {
    SourceLayout layout;
    int columns, rows;  ///< in faces
    const Places& places;
};
constexpr std::array<Arrangement, 4> kArrangements{{{SourceLayout::strip, 1, 6, kColumn},
                                                    {SourceLayout::strip, 6, 1, kRow},
                                                    {SourceLayout::cross, 4, 3, kLyingCross},
                                                    {SourceLayout::cross, 3, 4, kStandingCross}}};

/// Everything of a source but its image.
SourceImage without_image(const SourceImage& source, int size) {
    SourceImage result;
    result.colour_space = source.colour_space;
    result.colour_space_assumed = source.colour_space_assumed;
    result.units = source.units;
    result.image.channels = {"R", "G", "B"};
    result.image.faces = 6;
    result.image.levels.push_back(
        {size, size, std::vector<float>(static_cast<std::size_t>(size) * size * 18)});
    return result;
}

void unfold(const SourceImage& source, const Arrangement& arrangement, SourceImage& storage) {
    const int size = source.image.levels[0].width / arrangement.columns;
    storage = without_image(source, size);
    for (int face = 0; face < 6; ++face) {
        const FacePlace& place = arrangement.places[static_cast<std::size_t>(face)];
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const int from_x = place.turned ? size - 1 - x : x, from_y = place.turned ? size - 1 - y : y;
                std::copy_n(source.image.texel(0, 0, place.row * size + from_y, place.column * size + from_x),
                            3, storage.image.texel(0, face, y, x));
            }
    }
}

void join_faces(const ProbeParams& params, const Inputs& inputs, SourceImage& storage) {
    const SourceImage& first = inputs.at(field_of_face(0));
    const int size = first.image.levels[0].width;
    storage = without_image(first, size);
    for (std::size_t face = 0; face < 6; ++face) {
        const SourceImage& source = inputs.at(field_of_face(face));
        const Level& level = source.image.levels[0];
        const std::string path = path_of_face(params, face);
        if (source.image.faces != 1)
            throw Error(ExitCode::unreadable_input, path,
                        "is a cube map; allowed for a face: a square picture");
        if (level.width != level.height)
            throw misshapen(path, level.width, level.height, "allowed for a face: as many rows as columns");
        if (level.width != size)
            throw misshapen(path, level.width, level.height,
                            "allowed: the size of " + path_of_face(params, 0) + ", " + std::to_string(size) +
                                " x " + std::to_string(size));
        if (source.units != first.units)
            throw Error(ExitCode::unreadable_input, path,
                        "is in " + source.units + "; allowed: the units of " + path_of_face(params, 0) +
                            ", " + first.units);
        std::copy(level.texels.begin(), level.texels.end(),
                  storage.image.texel(0, static_cast<int>(face), 0, 0));
    }
}

}  // namespace

std::vector<Read> source_files(const ProbeParams& params) {
    if (!is_pattern(params)) return {{"source", params.source, params.colour_space}};
    std::vector<Read> files;
    for (std::size_t face = 0; face < 6; ++face)
        files.push_back({field_of_face(face), path_of_face(params, face), params.colour_space});
    return files;
}

const SourceImage& environment_source(const ProbeParams& params, const Inputs& inputs, SourceImage& storage) {
    const SourceLayout layout = params.source_layout;
    if (is_pattern(params)) {
        join_faces(params, inputs, storage);
        return storage;
    }
    const SourceImage& source = inputs.at("source");
    const Level& level = source.image.levels[0];
    const bool automatic = layout == SourceLayout::automatic;
    if (source.image.faces == 6) {
        if (automatic || layout == SourceLayout::cube) return source;
        throw Error(ExitCode::unreadable_input, params.source,
                    "says that it is a cube map; allowed for source_layout: auto, cube");
    }
    if (layout == SourceLayout::equirect || (automatic && level.width == 2 * level.height)) return source;
    for (const Arrangement& arrangement : kArrangements)
        if ((automatic || layout == arrangement.layout) && level.width % arrangement.columns == 0 &&
            level.height % arrangement.rows == 0 &&
            level.width / arrangement.columns == level.height / arrangement.rows) {
            unfold(source, arrangement, storage);
            return storage;
        }
    switch (layout) {
        case SourceLayout::cube:
            throw misshapen(
                params.source, level.width, level.height,
                "allowed for source_layout \"cube\": an EXR that says it is a cube map, or six files by "
                "{face} in the name");
        case SourceLayout::strip:
            throw misshapen(params.source, level.width, level.height,
                            "allowed for source_layout \"strip\": n x 6n or 6n x n");
        case SourceLayout::cross:
            throw misshapen(params.source, level.width, level.height,
                            "allowed for source_layout \"cross\": 3n x 4n or 4n x 3n");
        default:
            throw misshapen(
                params.source, level.width, level.height,
                "allowed: twice as wide as high (an equirect), n x 6n or 6n x n (a strip), 3n x 4n or 4n "
                "x 3n (a cross); or source_layout \"equirect\" for an equirect of any size");
    }
}

}  // namespace pbrbake::probe
