#include "pbr/ibl/cube_pyramid.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/vec4.hpp>
#include <limits>

#include "pbr/ibl/cubemap.hpp"
#include "src/ibl/pyramid_tables.hpp"

namespace pbr {
namespace {

/// Flux over H: no more than the largest float, where H is smaller than the texel.
float stored(double value) {
    return static_cast<float>(std::min(value, static_cast<double>(std::numeric_limits<float>::max())));
}

/// A level's padded faces: six times (n + 2)^2 texels of four floats.
struct PaddedLevel {
    int n;
    float* texels;
    std::size_t row() const { return 4 * (static_cast<std::size_t>(n) + 2); }
    std::size_t face() const { return row() * (static_cast<std::size_t>(n) + 2); }
};

/// Sets each texel of a level to a weighted sum of K x K texels of another, whose first lie at (x, y) times
/// `step` of the padded face.
template <int K>
void weighted_sums(const PaddedLevel& from, int step, const QuarterTable<std::array<double, K * K>>& weights,
                   const PaddedLevel& to) {
    const int side = (to.n + 1) / 2;
    for (int quarter = 0; quarter < 24; ++quarter) {  // of the six faces
        const bool right = quarter % 2 != 0, lower = quarter / 2 % 2 != 0;
        const std::ptrdiff_t next_x = right ? -4 : 4, of_row = static_cast<std::ptrdiff_t>(from.row()),
                             next_y = lower ? -of_row : of_row;
        const float* first = from.texels + static_cast<std::size_t>(quarter / 4) * from.face() +
                             (lower ? from.face() - from.row() : 0) + (right ? from.row() - 4 : 0);
        float* face = to.texels + static_cast<std::size_t>(quarter / 4) * to.face();
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const std::array<double, K* K>& w = weights(x, y);
                const float* at = first + step * (x * next_x + y * next_y);
                double sum[4] = {0, 0, 0, 0};
                for (int k = 0; k < K * K; ++k)
                    for (int c = 0; c < 4; ++c)
                        sum[c] += w[static_cast<std::size_t>(k)] *
                                  static_cast<double>(at[k % K * next_x + k / K * next_y + c]);
                const int column = right ? to.n - x : x + 1, row = lower ? to.n - y : y + 1;
                std::transform(sum, sum + 4, face + static_cast<std::size_t>(row) * to.row() + 4 * column,
                               stored);
            }
    }
}

}  // namespace

CubePyramid::CubePyramid(std::span<const float> rgb, int size)
    : size_(size), levels_(std::bit_width(static_cast<unsigned>(size))) {
    assert(size > 0 && size <= 4096 && (size & (size - 1)) == 0 &&
           rgb.size() == static_cast<std::size_t>(size) * size * 18);
    texels_.resize(static_cast<std::size_t>(offset(-1)));  // where a finer level would begin
    QuarterTable<Hat> hats = make_hats(size);
    const QuarterTable<double> per_hat(
        size, [&](int x, int y) { return cubemap_texel_solid_angle(size, x, y) / hats(x, y).solid_angle; });
    for (int f = 0; f < 6; ++f)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const float* from = &rgb[((static_cast<std::size_t>(f) * size + y) * size + x) * 3];
                float* to = texel(0, f, x, y);
                for (int c = 0; c < 3; ++c) to[c] = stored(per_hat(x, y) * static_cast<double>(from[c]));
                to[3] = stored(per_hat(x, y));
            }
    fill_border(0);
    for (int level = 1; level < levels(); ++level) {
        QuarterTable<Hat> coarser = make_hats(size_of(level));
        const QuarterTable<RoundingWeights> rounding = make_rounding_weights(coarser);
        const QuarterTable<SharingWeights> sharing =
            make_sharing_weights(hats, coarser, rounded(coarser, rounding));
        const PaddedLevel to{size_of(level), texel(level, 0, -1, -1)};
        weighted_sums<4>({size_of(level - 1), texel(level - 1, 0, -1, -1)}, 2, sharing, to);
        fill_border(level);
        for (int pass = 0; pass < kRoundingPasses; ++pass) {
            std::vector<float> before(to.texels, to.texels + 6 * to.face());
            weighted_sums<3>({to.n, before.data()}, 1, rounding, to);
            fill_border(level);
        }
        hats = std::move(coarser);
    }
}

const float* CubePyramid::face(int level, int face) const {
    const std::size_t side = static_cast<std::size_t>(size_of(level)) + 2;
    return texels_.data() + static_cast<std::size_t>(offset(level)) + face * side * side * 4;
}

float* CubePyramid::texel(int level, int face, int x, int y) {
    const std::size_t side = static_cast<std::size_t>(size_of(level)) + 2;
    return texels_.data() + static_cast<std::size_t>(offset(level)) +
           ((face * side + static_cast<std::size_t>(y + 1)) * side + static_cast<std::size_t>(x + 1)) * 4;
}

void CubePyramid::fill_border(int level) {
    const int n = size_of(level);
    for (int f = 0; f < 6; ++f) {
        for (int i = 0; i < n; ++i)
            for (const auto& [x, y] : {std::pair{i, -1}, {i, n}, {-1, i}, {n, i}}) {
                const CubeTexel from = cubemap_neighbour(f, x, y, n);
                std::copy_n(texel(level, from.face, from.x, from.y), 4, texel(level, f, x, y));
            }
        for (const int y : {-1, n})
            for (const int x : {-1, n}) {  // the three texels that meet at this corner of the cube
                const int ix = std::clamp(x, 0, n - 1), iy = std::clamp(y, 0, n - 1);
                const float *own = texel(level, f, ix, iy), *beside = texel(level, f, x, iy),
                            *above = texel(level, f, ix, y);
                for (int c = 0; c < 4; ++c)
                    texel(level, f, x, y)[c] =
                        static_cast<float>((static_cast<double>(own[c]) + beside[c] + above[c]) / 3);
            }
    }
}

glm::vec3 CubePyramid::sample(const glm::vec3& direction, float lod) const {
    const CubePoint point = cube_point(glm::dvec3(direction));
    const double clamped = std::clamp(static_cast<double>(lod), 0.0, levels() - 1.0);
    const int first = static_cast<int>(clamped);
    glm::dvec4 result(0);
    for (const int level : {first, std::min(first + 1, levels() - 1)}) {
        const int n = size_of(level);
        const double px = (point.s + 1) / 2 * n + 0.5, py = (point.t + 1) / 2 * n + 0.5;
        const int ix = std::clamp(static_cast<int>(px), 0, n), iy = std::clamp(static_cast<int>(py), 0, n);
        const double fx = px - ix, fy = py - iy;
        const float* p = face(level, point.face) + (static_cast<std::size_t>(iy) * (n + 2) + ix) * 4;
        const float* q = p + (n + 2) * 4;
        const double weight = level == first && first + 1 < levels() ? 1 - (clamped - first)
                              : level == first                       ? 1
                                                                     : clamped - first;
        for (int c = 0; c < 4; ++c) {
            const double top = p[c] + fx * (static_cast<double>(p[c + 4]) - p[c]);
            const double bottom = q[c] + fx * (static_cast<double>(q[c + 4]) - q[c]);
            result[c] += weight * (top + fy * (bottom - top));
        }
        if (first + 1 >= levels()) break;
    }
    return glm::vec3(glm::dvec3(result) / result.w);
}

}  // namespace pbr
