#include "pbr/ibl/cube_pyramid.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/vec4.hpp>
#include <limits>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {
namespace {

/// Values of a face's texels that are the same on every face and in each of its eighths.
class FaceTable {
  public:
    template <class F>
    FaceTable(int n, const F& value) : n_(n), values_(static_cast<std::size_t>(n) * n) {
        for (int y = 0; 2 * y < n; ++y)
            for (int x = 0; x <= y; ++x) {
                const double of_texel = value(x, y);
                for (const auto& [i, j] : {std::pair{x, y}, {y, x}})
                    for (const int column : {i, n - 1 - i})
                        for (const int row : {j, n - 1 - j}) at(column, row) = of_texel;
            }
    }
    /// Indices outside mean the neighbour across the edge, which has the value of the texel at it.
    double operator()(int x, int y) const {
        return values_[static_cast<std::size_t>(std::clamp(y, 0, n_ - 1)) * n_ + std::clamp(x, 0, n_ - 1)];
    }

  private:
    double& at(int x, int y) { return values_[static_cast<std::size_t>(y) * n_ + x]; }
    int n_;
    std::vector<double> values_;
};

/// A point of a face's axis with the bilinear weight of a texel there, times the quadrature's.
struct HatNode {
    double s, weight;
};

/// Nodes on the half texels around a texel. Beyond the outermost middles the weight is 1: there the border
/// has a share, but as much comes back from the neighbour's border.
std::vector<HatNode> hat_nodes(int n, int index, const QuadratureRule& rule) {
    std::vector<HatNode> nodes;
    for (int half = std::max(0, 2 * index - 1); half <= std::min(2 * n - 1, 2 * index + 2); ++half)
        for (int i = 0; i < rule.size(); ++i) {
            const double at = (half + rule.nodes[i]) / 2;
            const bool outermost = half == 0 || half == 2 * n - 1;
            const double weight = outermost ? 1 : 1 - std::abs(at - index - 0.5);
            nodes.push_back({2 * at / n - 1, weight * rule.weights[i] / n});
        }
    return nodes;
}

/// H: the integral of each texel's bilinear weight over solid angle. Relative error below 1e-4.
FaceTable hat_solid_angles(int n) {
    const QuadratureRule rule = gauss_legendre(n >= 64 ? 1 : n >= 16 ? 2 : 5);
    std::vector<std::vector<HatNode>> nodes;
    for (int i = 0; i < n; ++i) nodes.push_back(hat_nodes(n, i, rule));
    return {n, [&](int x, int y) {
                double sum = 0;
                for (const HatNode& a : nodes[static_cast<std::size_t>(x)])
                    for (const HatNode& b : nodes[static_cast<std::size_t>(y)]) {
                        const double q = 1 + a.s * a.s + b.s * b.s;
                        sum += a.weight * b.weight / (q * std::sqrt(q));
                    }
                return sum;
            }};
}

/// Flux over H: no more than the largest float, where H is smaller than the texel.
float stored(double value) {
    return static_cast<float>(std::min(value, static_cast<double>(std::numeric_limits<float>::max())));
}

}  // namespace

CubePyramid::CubePyramid(std::span<const float> rgb, int size)
    : size_(size), levels_(std::bit_width(static_cast<unsigned>(size))) {
    assert(size > 0 && size <= 4096 && (size & (size - 1)) == 0 &&
           rgb.size() == static_cast<std::size_t>(size) * size * 18);
    texels_.resize(static_cast<std::size_t>(offset(-1)));  // where a finer level would begin
    FaceTable finer_hats = hat_solid_angles(size);
    const FaceTable per_hat(
        size, [&](int x, int y) { return cubemap_texel_solid_angle(size, x, y) / finer_hats(x, y); });
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
        constexpr double kShares[] = {1. / 4, 3. / 4, 3. / 4,
                                      1. / 4};  // of finer texels around a coarser one
        const int n = size_of(level);
        FaceTable hats = hat_solid_angles(n);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                double weights[16];
                for (int k = 0; k < 16; ++k)
                    weights[k] = kShares[k % 4] * kShares[k / 4] *
                                 finer_hats(2 * x - 1 + k % 4, 2 * y - 1 + k / 4) / hats(x, y);
                for (int f = 0; f < 6; ++f) {
                    double sum[4] = {0, 0, 0, 0};
                    for (int k = 0; k < 16; ++k) {
                        const float* from = texel(level - 1, f, 2 * x - 1 + k % 4, 2 * y - 1 + k / 4);
                        for (int c = 0; c < 4; ++c) sum[c] += weights[k] * static_cast<double>(from[c]);
                    }
                    std::transform(sum, sum + 4, texel(level, f, x, y), stored);
                }
            }
        fill_border(level);
        finer_hats = std::move(hats);
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
