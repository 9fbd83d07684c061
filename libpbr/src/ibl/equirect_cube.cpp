// A whole cube map of an equirect's means. Where the picture's axis is one of the cube's, eight images of one
// pattern (src/ibl/cube_images.hpp) share what is found for each of its texels, and eight mirror images where
// its columns lie alike about the middle of a face.

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "src/ibl/cube_images.hpp"
#include "src/ibl/texel_shares.hpp"
#include "src/simd/cube_images_kernel.hpp"

namespace pbr {
namespace {

/// Texels of the cube, and all places where they are used.
struct Pattern {
    TexelGrid grid;
    CubeImages images;
    double phase = 0;  ///< of the picture's columns against the grid
    /// Where their mirror images are used, in which column x is reflected - x.
    CubeImages mirror_images = {};
    int reflected = 0;
    bool below_diagonal = false;  ///< mirrored at its diagonal: texels with i <= j are all that is needed
};

/// Twice the phase, if mirror images of columns are columns.
std::optional<int> mirror_phase(const CubeFaces& faces) {
    const double twice = 2 * faces.phase;
    return std::abs(twice - std::round(twice)) < 1e-9 ? std::optional(static_cast<int>(std::lround(twice)))
                                                      : std::nullopt;
}

/// Half a face beside the axis; its lowest row straddles the equator if the size is odd.
Pattern beside_pattern(const CubeFaces& faces, int size) {
    Pattern pattern{{{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, size, -size, -(size % 2), size, (size + 1) / 2},
                    faces.beside,
                    faces.phase};
    if (const std::optional<int> twice = mirror_phase(faces)) {
        pattern.grid.columns = (size + 1) / 2;
        pattern.reflected = *twice - 1;
        for (const CubeImage& image : faces.beside)
            pattern.mirror_images.push_back({image.column, image.south,
                                             image.origin + (size - 1) * image.step_i, -image.step_i,
                                             image.step_j});
    }
    return pattern;
}

/// A quadrant of a face that the axis pierces, for even sizes.
Pattern pierced_pattern(const EquirectView& source, const CubeFaces& faces, int size) {
    Pattern pattern{
        {{0, 1, 0}, {0, 0, -1}, {1, 0, 0}, size, 0, 0, size / 2, size / 2}, faces.pierced, faces.phase};
    if (const std::optional<int> twice = mirror_phase(faces)) {
        pattern.below_diagonal = true;
        pattern.reflected = *twice - 1 + source.width / 4;
        for (const CubeImage& image : faces.pierced)
            pattern.mirror_images.push_back(
                {image.column, image.south, image.origin, image.step_j, image.step_i});
    }
    return pattern;
}

/// A face as it is.
Pattern face_pattern(const EquirectView& source, int size, int face) {
    const glm::dvec3 centre = source.world_to_source * cube_vector(face, 0, 0);
    return {{centre, source.world_to_source * cube_vector(face, 1, 0) - centre,
             source.world_to_source * cube_vector(face, 0, 1) - centre, size, -size, -size, size, size},
            {{0, false, static_cast<long>(face) * size * size, 1, size}}};
}

std::vector<Pattern> patterns_of(const EquirectView& source, int size) {
    std::vector<Pattern> patterns;
    const std::optional<CubeFaces> faces = CubeFaces::of(source, size);
    if (!faces) {
        for (int face = 0; face < 6; ++face) patterns.push_back(face_pattern(source, size, face));
        return patterns;
    }
    patterns.push_back(beside_pattern(*faces, size));
    if (size % 2 == 0) {
        patterns.push_back(pierced_pattern(source, *faces, size));
    } else {  // the axis pierces the middle of a texel
        for (const CubeImage& image : {faces->pierced.front(), faces->pierced.back()})
            patterns.push_back(face_pattern(source, size, static_cast<int>(image.origin / size / size)));
    }
    return patterns;
}

/// Rows [first, last) of a pattern.
void fill_rows(const EquirectView& source, const Graticule& graticule, const Pattern& pattern, int first,
               int last, std::span<float> rgb_out) {
    TexelGrid grid = pattern.grid;
    if (pattern.below_diagonal) grid.columns = last;
    GridShares shares(graticule, grid, first, last);
    for (int j = first; j < last; ++j) {
        const RowShares& row = shares.of_row(j);
        mean_images(source, pattern.images, row, j, rgb_out);
        if (!pattern.mirror_images.empty())
            mean_images(source, pattern.mirror_images, mirrored(row, pattern.reflected, source.width), j,
                        rgb_out);
    }
}

}  // namespace

void resample_area(const EquirectView& source, int size, const ForEach& each, std::span<float> rgb_out) {
    if (source.width < Graticule::kFewestColumns)
        return each(6 * size, [&](int row) {
            const std::size_t stride = static_cast<std::size_t>(size) * 3;
            resample_area(source, size, row / size, row % size,
                          rgb_out.subspan(static_cast<std::size_t>(row) * stride, stride));
        });
    constexpr int kStrip = 16;  // rows; a line between strips is traced for both
    struct Strip {
        const Pattern* pattern;
        int first;
    };
    const std::vector<Pattern> patterns = patterns_of(source, size);
    std::map<double, Graticule> graticules;  // by phase
    std::vector<Strip> strips;
    for (const Pattern& pattern : patterns) {
        graticules.try_emplace(pattern.phase, source.width, source.height, pattern.phase);
        for (int first = 0; first < pattern.grid.rows; first += kStrip) strips.push_back({&pattern, first});
    }
    each(static_cast<int>(strips.size()), [&](int i) {
        const auto [pattern, first] = strips[static_cast<std::size_t>(i)];
        fill_rows(source, graticules.at(pattern->phase), *pattern, first,
                  std::min(pattern->grid.rows, first + kStrip), rgb_out);
    });
}

}  // namespace pbr
