#include "pbr/ibl/moment_tree.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "pbr/ibl/spherical_harmonics.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "src/simd/patch_kernel.hpp"

namespace pbr {
namespace {

constexpr std::size_t kCount = kMonomials.size();

constexpr std::size_t index_of(int a, int b, int c) {
    for (std::size_t k = 0; k < kCount; ++k)
        if (kMonomials[k].a == a && kMonomials[k].b == b && kMonomials[k].c == c) return k;
    return kCount;
}

constexpr int binomial(int n, int k) {
    return k == 0 || k == n ? 1 : binomial(n - 1, k - 1) + binomial(n - 1, k);
}
constexpr int factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

/// (x + s)^a and so on expanded: moment `to` takes `factor` times moment `from` times monomial `shift` of the
/// shift.
struct Term {
    std::size_t to, from, shift;
    double factor;
};
constexpr std::size_t kTerms = 1 + 6 + 21 + 56;
constexpr std::array<Term, kTerms> terms_of_shift() {
    std::array<Term, kTerms> terms{};
    std::size_t count = 0;
    for (std::size_t to = 0; to < kCount; ++to)
        for (std::size_t from = 0; from < kCount; ++from) {
            const Monomial t = kMonomials[to], f = kMonomials[from];
            if (f.a > t.a || f.b > t.b || f.c > t.c) continue;
            terms[count++] = {to, from, index_of(t.a - f.a, t.b - f.b, t.c - f.c),
                              1.0 * binomial(t.a, f.a) * binomial(t.b, f.b) * binomial(t.c, f.c)};
        }
    return terms;
}
constexpr std::array<Term, kTerms> kShift = terms_of_shift();

/// a! b! c!, by which nodes divide their moments.
constexpr std::array<double, kCount> factorials() {
    std::array<double, kCount> result{};
    for (std::size_t k = 0; k < kCount; ++k)
        result[k] =
            1.0 * factorial(kMonomials[k].a) * factorial(kMonomials[k].b) * factorial(kMonomials[k].c);
    return result;
}
constexpr std::array<double, kCount> kFactorials = factorials();

std::array<double, kCount> powers_of(const glm::dvec3& v) {
    std::array<double, kCount> powers{};
    std::array<std::array<double, 4>, 3> along{};
    for (int i = 0; i < 3; ++i)
        along[static_cast<std::size_t>(i)] = {1, v[i], v[i] * v[i], v[i] * v[i] * v[i]};
    for (std::size_t k = 0; k < kCount; ++k)
        powers[k] = along[0][static_cast<std::size_t>(kMonomials[k].a)] *
                    along[1][static_cast<std::size_t>(kMonomials[k].b)] *
                    along[2][static_cast<std::size_t>(kMonomials[k].c)];
    return powers;
}

/// Adds moments about a point to moments about another, `shift` being the first point seen from the second.
void add_shifted(const PatchMoments& from, const glm::dvec3& shift, double factor, PatchMoments& to) {
    const std::array<double, kCount> powers = powers_of(shift);
    for (const Term& term : kShift) {
        const double weight = factor * term.factor * powers[term.shift];
        for (std::size_t c = 0; c < 4; ++c) to[term.to][c] += weight * from[term.from][c];
    }
}

PatchMoments whole_moments(const Moments& node) {
    PatchMoments moments;
    for (std::size_t k = 0; k < kCount; ++k)
        for (std::size_t c = 0; c < 4; ++c)
            moments[k][c] = static_cast<double>(node.mean[k][c]) * kFactorials[k];
    return moments;
}

Moments stored(const PatchMoments& moments) {
    Moments node;
    for (std::size_t k = 0; k < kCount; ++k)
        for (std::size_t c = 0; c < 4; ++c)
            node.mean[k][c] = static_cast<float>(moments[k][c] / kFactorials[k]);
    return node;
}

}  // namespace

MomentTree::MomentTree(const PatchBlocks& blocks, const ForEach& each) : blocks_(&blocks) {
    const PatchBlocks::Grid& grid = blocks.grid();
    assert(grid.faces > 0);
    const auto add_level = [&](int columns, int rows) {
        const std::size_t count = static_cast<std::size_t>(grid.faces) * columns * rows;
        levels_.push_back({columns, rows, std::vector<MomentCone>(count), std::vector<Moments>(count)});
    };
    add_level(grid.columns, grid.rows);
    each(grid.faces * grid.rows, [&](int row) {
        PatchPoints points;
        for (int x = 0; x < grid.columns; ++x)
            fill_leaf(row * grid.columns + x, {row / grid.rows, x, row % grid.rows}, points);
    });
    while (levels_.back().columns > 1 || levels_.back().rows > 1) {
        const int rows = (levels_.back().rows + 1) / 2;
        add_level((levels_.back().columns + 1) / 2, rows);
        each(grid.faces * rows, [&](int row) {
            for (int x = 0; x < levels_.back().columns; ++x) merge(levels() - 1, {row / rows, x, row % rows});
        });
    }
    set_brightness();
}

void MomentTree::set_brightness() {
    glm::dvec3 sum(0);
    double weight = 0;
    const Level& roots = levels_.back();
    for (std::size_t i = 0; i < roots.cones.size(); ++i) {
        const double share = roots.cones[i].solid_angle;
        for (int c = 0; c < 3; ++c) sum[c] += share * static_cast<double>(roots.moments[i].mean[0][c]);
        weight += share;
    }
    mean_ = sum / weight;
    for (Level& level : levels_)
        for (std::size_t i = 0; i < level.cones.size(); ++i) {
            double brightness = 1;
            for (int c = 0; c < 3; ++c)
                if (mean_[c] > 0)
                    brightness =
                        std::max(brightness, static_cast<double>(level.moments[i].mean[0][c]) / mean_[c]);
            level.cones[i].brightness = static_cast<float>(brightness);
        }
}

/// Texels have a spread of their own about their middles, nearly the same all over a block: the first and
/// second moments of the block's middle texel about its middle point.
std::array<double, kMonomials.size()> MomentTree::texel_spread(int block, PatchPoints& points) const {
    blocks_->middle_points(block, 0, points);
    const glm::dvec3 middle(points.x[0], points.y[0], points.z[0]);
    blocks_->middle_points(block, 1, points);
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

void MomentTree::fill_leaf(int block, const Place& place, PatchPoints& points) {
    const glm::dvec3 middle(glm::vec3(blocks_->cone(block).axis));  // as moments_of_points rounds it
    const std::array<double, kCount> spread = texel_spread(block, points);
    blocks_->points(block, 0, points);
    PatchMoments about_middle = moments_of_points(points, middle);
    for (std::size_t k = 1; k < 10; ++k)
        for (std::size_t c = 0; c < 4; ++c) about_middle[k][c] += about_middle[0][c] * spread[k];
    const double solid_angle = about_middle[0][3];
    const glm::dvec3 offset =
        glm::dvec3(about_middle[1][3], about_middle[2][3], about_middle[3][3]) / solid_angle;
    PatchMoments moments{};
    add_shifted(about_middle, -offset, 1 / solid_angle, moments);
    levels_[0].moments[static_cast<std::size_t>(block)] = stored(moments);
    levels_[0].cones[static_cast<std::size_t>(block)] = cone(middle + offset, solid_angle, 0, place);
}

void MomentTree::merge(int level, const Place& place) {
    const Level& below = levels_[static_cast<std::size_t>(level) - 1];
    std::array<std::size_t, 4> children{};
    std::size_t count = 0;
    double solid_angle = 0;
    glm::dvec3 centre(0);
    for (int k = 0; k < 4; ++k) {
        const int column = 2 * place.x + k % 2, row = 2 * place.y + k / 2;
        if (column >= below.columns || row >= below.rows) continue;
        const std::size_t child =
            (static_cast<std::size_t>(place.face) * below.rows + row) * below.columns + column;
        children[count++] = child;
        solid_angle += static_cast<double>(below.cones[child].solid_angle);
        centre += static_cast<double>(below.cones[child].solid_angle) * below.cones[child].centre();
    }
    const MomentCone of_all = cone(centre / solid_angle, solid_angle, level, place);
    PatchMoments moments{};
    for (std::size_t i = 0; i < count; ++i) {
        const MomentCone& child = below.cones[children[i]];
        add_shifted(whole_moments(below.moments[children[i]]), child.centre() - of_all.centre(),
                    static_cast<double>(child.solid_angle) / solid_angle, moments);
    }
    Level& own = levels_[static_cast<std::size_t>(level)];
    const std::size_t index =
        (static_cast<std::size_t>(place.face) * own.rows + place.y) * own.columns + place.x;
    own.cones[index] = of_all;
    own.moments[index] = stored(moments);
}

MomentCone MomentTree::cone(const glm::dvec3& centre, double solid_angle, int level,
                            const Place& place) const {
    const PatchBlocks::Grid& grid = blocks_->grid();
    const double length = glm::length(centre);
    const int side = 1 << level;
    const PatchBlocks::Cells cells{place.face, place.x * side, place.y * side,
                                   std::min(grid.columns, (place.x + 1) * side),
                                   std::min(grid.rows, (place.y + 1) * side)};
    const bool is_round = length < 1e-3;  // the whole sphere: any axis will do
    const glm::dvec3 axis = is_round ? glm::dvec3(0, 0, 1) : centre / length;
    const double reach = is_round ? 2 : blocks_->reach(cells, axis);
    return {{static_cast<float>(axis.x), static_cast<float>(axis.y), static_cast<float>(axis.z)},
            static_cast<float>(length),
            static_cast<float>(reach),
            static_cast<float>(solid_angle),
            1};
}

std::vector<glm::dvec3> sh_project(const MomentTree& source, int bands) {
    assert(bands >= 1 && bands <= kMomentBands);
    const MomentTree::Level& roots = source.level(source.levels() - 1);
    PatchMoments moments{};  // about the sphere's centre
    for (std::size_t i = 0; i < roots.cones.size(); ++i)
        add_shifted(whole_moments(roots.moments[i]), roots.cones[i].centre(),
                    static_cast<double>(roots.cones[i].solid_angle), moments);
    // The picture's bands at n are its sum with (2 l + 1) P_l(n.d) / (4 pi), a polynomial of n.d; the rule's
    // points are exact for it times Y, of degree 6 together.
    constexpr int kRows = 4, kColumns = 8;
    const QuadratureRule rule = gauss_legendre(kRows);
    std::vector<glm::dvec3> coefficients(static_cast<std::size_t>(sh_count(bands)), glm::dvec3(0));
    std::vector<double> basis(coefficients.size());
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            const double z = 2 * rule.nodes[row] - 1, sine = std::sqrt((1 - z) * (1 + z));
            const SinCos turn = sin_cos_pi(2.0 * column / kColumns);
            const glm::dvec3 n(sine * turn.cos, sine * turn.sin, z);
            std::array<glm::dvec3, kMomentBands> sums{};  // of radiance times (n.d)^j
            const std::array<double, kCount> powers = powers_of(n);
            for (std::size_t k = 0; k < kCount; ++k) {
                const int degree = kMonomials[k].a + kMonomials[k].b + kMonomials[k].c;
                sums[static_cast<std::size_t>(degree)] +=
                    factorial(degree) / kFactorials[k] * powers[k] *
                    glm::dvec3(moments[k][0], moments[k][1], moments[k][2]);
            }
            const std::array<glm::dvec3, kMomentBands> of_band{sums[0], 3.0 * sums[1],
                                                               2.5 * (3.0 * sums[2] - sums[0]),
                                                               3.5 * (5.0 * sums[3] - 3.0 * sums[1])};
            // The rule's weights sum to 1 over z: 4 pi of solid angle and 1 / (4 pi) of the kernel cancel.
            const double weight = rule.weights[row] / kColumns;
            sh_evaluate<double>(bands, n, basis);
            for (int l = 0; l < bands; ++l)
                for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                    coefficients[static_cast<std::size_t>(i)] +=
                        weight * basis[static_cast<std::size_t>(i)] * of_band[static_cast<std::size_t>(l)];
        }
    return coefficients;
}

}  // namespace pbr
