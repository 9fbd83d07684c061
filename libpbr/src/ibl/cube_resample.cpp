#include <algorithm>
#include <cmath>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"

namespace pbr {
namespace {

/// The texels of a grid of `source` cells that cell `index` of `size` overlaps: [first, last].
struct Overlap {
    int first, last;
};
Overlap overlap(int index, int size, int source) {
    const auto exact = [&](int i) { return static_cast<long>(i) * source; };
    return {static_cast<int>(exact(index) / size), static_cast<int>((exact(index + 1) - 1) / size)};
}

double edge(int index, int size) { return 2.0 * index / size - 1; }

}  // namespace

void resample_area(const CubeView& source, int size, int face, int y, std::span<float> rgb_out) {
    const Overlap rows = overlap(y, size, source.size);
    for (int x = 0; x < size; ++x) {
        const Overlap columns = overlap(x, size, source.size);
        float* out = &rgb_out[static_cast<std::size_t>(x) * 3];
        if (rows.first == rows.last &&
            columns.first == columns.last) {  // within one texel: its value, bit for bit
            std::copy_n(source.texel(face, columns.first, rows.first), 3, out);
            continue;
        }
        double sum[3] = {0, 0, 0}, solid_angle = 0;
        for (int j = rows.first; j <= rows.last; ++j)
            for (int i = columns.first; i <= columns.last; ++i) {
                const double piece =
                    cube_rectangle_solid_angle(std::max(edge(x, size), edge(i, source.size)),
                                               std::min(edge(x + 1, size), edge(i + 1, source.size)),
                                               std::max(edge(y, size), edge(j, source.size)),
                                               std::min(edge(y + 1, size), edge(j + 1, source.size)));
                const float* texel = source.texel(face, i, j);
                for (int c = 0; c < 3; ++c) sum[c] += piece * static_cast<double>(texel[c]);
                solid_angle += piece;
            }
        for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(sum[c] / solid_angle);
    }
}

void resample_bilinear(const CubeView& source, int size, int face, int y, std::span<float> rgb_out) {
    // Across a corner of the cube there is no texel; the one across the nearer edge stands in.
    const auto fetch = [&](int i, int j) {
        const bool outside_i = i < 0 || i >= source.size, outside_j = j < 0 || j >= source.size;
        if (outside_i && outside_j) j = std::clamp(j, 0, source.size - 1);
        const CubeTexel texel = cubemap_neighbour(face, i, j, source.size);
        return source.texel(texel.face, texel.x, texel.y);
    };
    const auto position = [&](int index) {
        return (cube_coordinate(index, size) + 1) / 2 * source.size - 0.5;
    };
    const double py = position(y);
    const int j = static_cast<int>(std::floor(py));
    const double fy = py - j;
    for (int x = 0; x < size; ++x) {
        const double px = position(x);
        const int i = static_cast<int>(std::floor(px));
        const double fx = px - i;
        const float *a = fetch(i, j), *b = fetch(i + 1, j), *c = fetch(i, j + 1), *d = fetch(i + 1, j + 1);
        for (int k = 0; k < 3; ++k) {
            const double top = a[k] + fx * (static_cast<double>(b[k]) - a[k]);
            const double bottom = c[k] + fx * (static_cast<double>(d[k]) - c[k]);
            rgb_out[static_cast<std::size_t>(x) * 3 + k] = static_cast<float>(top + fy * (bottom - top));
        }
    }
}

}  // namespace pbr
