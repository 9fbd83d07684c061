// A whole cube map of an equirect's means. Where the picture's axis is one of the cube's, eight images of one
// pattern (src/ibl/cube_images.hpp) share what is found for each of its texels.

#include <algorithm>
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
};

/// Half a face beside the axis; its lowest row straddles the equator if the size is odd.
Pattern beside_pattern(const CubeFaces& faces, int size) {
    return {{{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, size, -size, -(size % 2), size, (size + 1) / 2},
            faces.beside,
            faces.phase};
}

/// A quadrant of a face that the axis pierces, for even sizes.
Pattern pierced_pattern(const CubeFaces& faces, int size) {
    return {{{0, 1, 0}, {0, 0, -1}, {1, 0, 0}, size, 0, 0, size / 2, size / 2}, faces.pierced, faces.phase};
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
        patterns.push_back(pierced_pattern(*faces, size));
    } else {  // the axis pierces the middle of a texel
        for (const CubeImage& image : {faces->pierced.front(), faces->pierced.back()})
            patterns.push_back(face_pattern(source, size, static_cast<int>(image.origin / size / size)));
    }
    return patterns;
}

/// Rows [first, last) of a pattern.
void fill_rows(const EquirectView& source, const Graticule& graticule, const Pattern& pattern, int first,
               int last, std::span<float> rgb_out) {
    GridShares shares(graticule, pattern.grid, first, last);
    for (int j = first; j < last; ++j) mean_images(source, pattern.images, shares.of_row(j), j, rgb_out);
}

}  // namespace

void resample_area(const EquirectView& source, int size, const ForEach& each, std::span<float> rgb_out) {
    if (source.width < Graticule::kFewestColumns)
        return each(6 * size, [&](int row) {
            const std::size_t stride = static_cast<std::size_t>(size) * 3;
            resample_area(source, size, row / size, row % size,
                          rgb_out.subspan(static_cast<std::size_t>(row) * stride, stride));
        });
    constexpr int kStrip = 8;  // rows; a line between strips is traced for both
    for (const Pattern& pattern : patterns_of(source, size)) {
        const Graticule graticule(source.width, source.height, pattern.phase);
        const int rows = pattern.grid.rows;
        each((rows + kStrip - 1) / kStrip, [&](int strip) {
            fill_rows(source, graticule, pattern, strip * kStrip, std::min(rows, (strip + 1) * kStrip),
                      rgb_out);
        });
    }
}

}  // namespace pbr
