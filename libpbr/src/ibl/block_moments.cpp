#include "src/ibl/block_moments.hpp"

#include <algorithm>
#include <array>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "pbr/ibl/environment.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {
namespace {

constexpr std::size_t kCount = kMonomials.size();

constexpr std::size_t index_of(int a, int b, int c) {
    for (std::size_t k = 0; k < kCount; ++k)
        if (kMonomials[k].a == a && kMonomials[k].b == b && kMonomials[k].c == c) return k;
    return kCount;
}

/// One more factor of each coordinate: where there is none, kCount.
constexpr std::array<std::array<std::size_t, 3>, kCount> raised() {
    std::array<std::array<std::size_t, 3>, kCount> result{};
    for (std::size_t k = 0; k < kCount; ++k) {
        const auto [a, b, c] = kMonomials[k];
        result[k] = {index_of(a + 1, b, c), index_of(a, b + 1, c), index_of(a, b, c + 1)};
    }
    return result;
}
constexpr std::array<std::array<std::size_t, 3>, kCount> kRaised = raised();

/// Moment `to`, which has one more factor x of an axis than `from`, gets (x + shift) in place of one.
struct Step {
    std::size_t to, from;
    int axis;
};
constexpr std::size_t kSteps = 3 * 15;
constexpr std::array<Step, kSteps> steps_of_shift() {
    std::array<Step, kSteps> steps{};
    std::size_t count = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (int pass = 1; pass < 4; ++pass)
            for (std::size_t from = kCount; from-- > 0;) {  // those of high powers before they change
                const std::size_t to = kRaised[from][static_cast<std::size_t>(axis)];
                if (to == kCount) continue;
                const Monomial& m = kMonomials[to];
                if ((axis == 0 ? m.a : axis == 1 ? m.b : m.c) >= pass) steps[count++] = {to, from, axis};
            }
    return steps;
}
constexpr std::array<Step, kSteps> kShift = steps_of_shift();

/// Points a texel and axis: exact to rounding for pictures of more than a few texels.
constexpr int kPoints = 4;

/// Adds sin^i cos^j of a point times its weight, in the order of LatLongBlock: the first `count` of them.
void add_powers(const SinCos& at, double weight, std::size_t count, double* sums) {
    std::size_t k = 0;
    double of_sine = weight;
    for (int i = 0; i < 4 && k < count; ++i, of_sine *= at.sin) {
        double power = of_sine;
        for (int j = 0; i + j < 4 && k < count; ++j, power *= at.cos) sums[k++] += power;
    }
}

std::vector<double> row_integrals(const EquirectView& picture) {
    const QuadratureRule rule = gauss_legendre(kPoints);
    std::vector<double> integrals(static_cast<std::size_t>(picture.height) * kRowIntegrals);
    for (int y = 0; y < picture.height; ++y) {
        double* const sums = &integrals[static_cast<std::size_t>(y) * kRowIntegrals];
        for (int i = 0; i < kPoints; ++i) {
            const SinCos colatitude = sin_cos_pi((y + rule.nodes[i]) / picture.height);
            add_powers(colatitude, rule.weights[i] * colatitude.sin, kRowIntegrals, sums);
        }
        // A texel has its exact solid angle.
        const double to_exact = equirect_texel_solid_angle(picture.width, picture.height, y) / sums[0];
        for (std::size_t k = 0; k < kRowIntegrals; ++k) sums[k] *= to_exact;
    }
    return integrals;
}

std::vector<double> column_means(const EquirectView& picture) {
    const QuadratureRule rule = gauss_legendre(kPoints);
    std::vector<double> means(static_cast<std::size_t>(picture.width) * kColumnMeans);
    for (int x = 0; x < picture.width; ++x)
        for (int i = 0; i < kPoints; ++i)
            add_powers(sin_cos_pi(1 - 2 * (x + rule.nodes[i]) / picture.width), rule.weights[i], kColumnMeans,
                       &means[static_cast<std::size_t>(x) * kColumnMeans]);
    return means;
}

/// Moments of a block's texels about their middles, nearly the same all over it: the first and second of the
/// texel in its middle.
std::array<double, kCount> texel_spread(const PatchBlocks& blocks, int block, PatchPoints& points) {
    blocks.middle_points(block, 0, points);
    const glm::dvec3 middle(points.x[0], points.y[0], points.z[0]);
    blocks.middle_points(block, 1, points);
    std::array<double, kCount> spread{};
    double weight = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(points.x[i], points.y[i], points.z[i]) - middle;
        const double w = points.weight[i];
        const std::array<double, 9> powers{d.x,       d.y,       d.z,       d.x * d.x, d.y * d.y,
                                           d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z};
        for (std::size_t k = 0; k < powers.size(); ++k) spread[k + 1] += w * powers[k];
        weight += w;
    }
    for (double& moment : spread) moment /= weight;
    return spread;
}

}  // namespace

BlockMoments::BlockMoments(const PatchBlocks& blocks) : blocks_(blocks) {
    const EquirectView& picture = blocks.equirect();
    if (!picture.rgb) return;
    rows_ = row_integrals(picture);
    columns_ = column_means(picture);
    if (picture.world_to_source == glm::dmat3(1)) return;
    // world_to_source is orthogonal: coordinate i in the world is that of its column i along the picture's.
    const glm::dmat3& axes = picture.world_to_source;
    for (std::size_t to = 0; to < kCount; ++to) {
        std::array<double, kCount> product{1};
        const std::array<int, 3> powers{kMonomials[to].a, kMonomials[to].b, kMonomials[to].c};
        for (int i = 0; i < 3; ++i)
            for (int p = 0; p < powers[static_cast<std::size_t>(i)]; ++p) {
                std::array<double, kCount> next{};
                for (std::size_t k = 0; k < kCount; ++k)
                    for (std::size_t j = 0; j < 3; ++j)
                        if (kRaised[k][j] < kCount)
                            next[kRaised[k][j]] += axes[i][static_cast<int>(j)] * product[k];
                product = next;
            }
        for (std::size_t from = 0; from < kCount; ++from)
            if (product[from] != 0) turn_.push_back({to, from, product[from]});
    }
}

PatchMoments BlockMoments::operator()(int block, PatchPoints& scratch) const {
    return columns_.empty() ? of_cube(block, scratch) : of_equirect(block);
}

PatchMoments BlockMoments::of_equirect(int block) const {
    const EquirectView& picture = blocks_.equirect();
    const PatchBlocks::Grid& grid = blocks_.grid();
    const int x = block % grid.columns * grid.side, y = block / grid.columns * grid.side;
    const PatchMoments in_picture =
        moments_of_block({picture.texel(x, y), static_cast<std::size_t>(picture.width) * 3,
                          std::min(grid.side, picture.width - x), std::min(grid.side, picture.height - y),
                          &rows_[static_cast<std::size_t>(y) * kRowIntegrals],
                          &columns_[static_cast<std::size_t>(x) * kColumnMeans]});
    if (turn_.empty()) return in_picture;
    PatchMoments moments{};
    for (const Term& term : turn_)
        for (std::size_t c = 0; c < 4; ++c) moments[term.to][c] += term.factor * in_picture[term.from][c];
    return moments;
}

PatchMoments BlockMoments::of_cube(int block, PatchPoints& scratch) const {
    const glm::dvec3 middle(glm::vec3(blocks_.cone(block).axis));  // as moments_of_points rounds it
    const std::array<double, kCount> spread = texel_spread(blocks_, block, scratch);
    blocks_.points(block, 0, scratch);
    PatchMoments moments = moments_of_points(scratch, middle);
    for (std::size_t k = 1; k < 10; ++k)
        for (std::size_t c = 0; c < 4; ++c) moments[k][c] += moments[0][c] * spread[k];
    shift_moments(middle, moments);
    return moments;
}

void shift_moments(const glm::dvec3& shift, PatchMoments& moments) {
    for (const Step& step : kShift)
        for (std::size_t c = 0; c < 4; ++c) moments[step.to][c] += shift[step.axis] * moments[step.from][c];
}

}  // namespace pbr
