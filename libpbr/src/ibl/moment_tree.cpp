#include "pbr/ibl/moment_tree.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "pbr/ibl/spherical_harmonics.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "src/ibl/block_moments.hpp"

namespace pbr {
namespace {

constexpr std::size_t kCount = kMonomials.size();

constexpr int factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

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

/// Makes the nodes of all levels from those below. On the way up moments are about the sphere's centre, where
/// those of a node are the sum of its children's.
class Builder {
  public:
    explicit Builder(const PatchBlocks& blocks) : blocks_(blocks), of_block_(blocks) {
        int columns = blocks.grid().columns, rows = blocks.grid().rows;
        add_level(columns, rows);
        while (columns > 1 || rows > 1) add_level(columns = (columns + 1) / 2, rows = (rows + 1) / 2);
    }

    std::vector<MomentTree::Level> operator()(const ForEach& each) && {
        // Subtrees side by side, then what is above them.
        const int top = std::min(kSubtree, static_cast<int>(levels_.size()) - 1);
        std::vector<PatchMoments> below(of(top).cones.size());
        each(static_cast<int>(below.size()), [&](int i) {
            PatchPoints scratch;
            below[static_cast<std::size_t>(i)] = fill(place(top, i), scratch);
        });
        for (int level = top + 1; level < static_cast<int>(levels_.size()); ++level) {
            std::vector<PatchMoments> own;
            for (int i = 0; i < static_cast<int>(of(level).cones.size()); ++i)
                own.push_back(
                    merge(place(level, i), [&](const Place& child) { return below[index(child)]; }));
            below = std::move(own);
        }
        return std::move(levels_);
    }

  private:
    static constexpr int kSubtree = 3;  ///< levels below the root of one

    struct Place {
        int level, face, x, y;
    };
    MomentTree::Level& of(int level) { return levels_[static_cast<std::size_t>(level)]; }
    Place place(int level, int index) {
        const auto [columns, rows] = std::pair{of(level).columns, of(level).rows};
        return {level, index / (columns * rows), index % columns, index / columns % rows};
    }
    std::size_t index(const Place& place) {
        const MomentTree::Level& level = of(place.level);
        return (static_cast<std::size_t>(place.face) * level.rows + place.y) * level.columns + place.x;
    }

    void add_level(int columns, int rows) {
        const std::size_t count = static_cast<std::size_t>(blocks_.grid().faces) * columns * rows;
        levels_.push_back({columns, rows, std::vector<MomentCone>(count), std::vector<Moments>(count)});
    }

    /// A node and all below it. Returns its moments about the sphere's centre, as merge() does.
    PatchMoments fill(const Place& place, PatchPoints& scratch) {
        if (place.level > 0) return merge(place, [&](const Place& child) { return fill(child, scratch); });
        const PatchMoments moments = of_block_(static_cast<int>(index(place)), scratch);
        store(place, moments);
        return moments;
    }

    /// `of_child` gives the moments of a child.
    template <class OfChild>
    PatchMoments merge(const Place& place, const OfChild& of_child) {
        const MomentTree::Level& below = of(place.level - 1);
        PatchMoments moments{};
        for (int k = 0; k < 4; ++k) {
            const Place child{place.level - 1, place.face, 2 * place.x + k % 2, 2 * place.y + k / 2};
            if (child.x >= below.columns || child.y >= below.rows) continue;
            const PatchMoments part = of_child(child);
            for (std::size_t m = 0; m < kCount; ++m)
                for (std::size_t c = 0; c < 4; ++c) moments[m][c] += part[m][c];
        }
        store(place, moments);
        return moments;
    }

    /// Writes a node whose `moments` are about the sphere's centre.
    void store(const Place& place, PatchMoments moments) {
        const double solid_angle = moments[0][3];
        const MomentCone of_node =
            cone(glm::dvec3(moments[1][3], moments[2][3], moments[3][3]) / solid_angle, solid_angle, place);
        shift_moments(-of_node.centre(), moments);
        const std::size_t own = index(place);
        of(place.level).cones[own] = of_node;
        Moments& stored = of(place.level).moments[own];
        for (std::size_t k = 0; k < kCount; ++k) {
            const double share = 1 / (solid_angle * kFactorials[k]);
            for (std::size_t c = 0; c < 4; ++c) stored.mean[k][c] = static_cast<float>(moments[k][c] * share);
        }
    }

    MomentCone cone(const glm::dvec3& centre, double solid_angle, const Place& place) const {
        const PatchBlocks::Grid& grid = blocks_.grid();
        const double length = glm::length(centre);
        const int side = 1 << place.level;
        const PatchBlocks::Cells cells{place.face, place.x * side, place.y * side,
                                       std::min(grid.columns, (place.x + 1) * side),
                                       std::min(grid.rows, (place.y + 1) * side)};
        const bool is_round = length < 1e-3;  // the whole sphere: any axis will do
        const glm::dvec3 axis = is_round ? glm::dvec3(0, 0, 1) : centre / length;
        const double reach = is_round ? 2 : blocks_.reach(cells, axis);
        return {{static_cast<float>(axis.x), static_cast<float>(axis.y), static_cast<float>(axis.z)},
                static_cast<float>(length),
                static_cast<float>(reach),
                static_cast<float>(solid_angle),
                1};
    }

    const PatchBlocks& blocks_;
    BlockMoments of_block_;
    std::vector<MomentTree::Level> levels_;
};

}  // namespace

MomentTree::MomentTree(const PatchBlocks& blocks, const ForEach& each) : blocks_(&blocks) {
    assert(blocks.grid().faces > 0);
    levels_ = Builder(blocks)(each);
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

SphereMoments sphere_moments(const MomentTree& source) {
    const MomentTree::Level& roots = source.level(source.levels() - 1);
    PatchMoments moments{};
    for (std::size_t i = 0; i < roots.cones.size(); ++i) {
        PatchMoments part{};
        for (std::size_t k = 0; k < kCount; ++k)
            for (std::size_t c = 0; c < 4; ++c)
                part[k][c] = static_cast<double>(roots.moments[i].mean[k][c]) * kFactorials[k] *
                             static_cast<double>(roots.cones[i].solid_angle);
        shift_moments(roots.cones[i].centre(), part);
        for (std::size_t k = 0; k < kCount; ++k)
            for (std::size_t c = 0; c < 4; ++c) moments[k][c] += part[k][c];
    }
    SphereMoments rgb{};
    for (std::size_t k = 0; k < kCount; ++k) rgb[k] = {moments[k][0], moments[k][1], moments[k][2]};
    return rgb;
}

std::vector<glm::dvec3> sh_project(const SphereMoments& moments, int bands) {
    assert(bands >= 1 && bands <= kMomentBands);
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
                    factorial(degree) / kFactorials[k] * powers[k] * moments[k];
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
