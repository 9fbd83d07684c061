#include "src/ibl/pyramid_tables.hpp"

#include <cassert>
#include <cmath>
#include <numeric>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {
namespace {

/// A point of a face's axis, times the quadrature's weight: the bilinear weight of a texel, and of its
/// neighbour across the edge, whose face has the mirror image of the point under the texel's own weight.
struct HatNode {
    double s, own, across;
};

std::vector<HatNode> hat_nodes(int n, int index, const QuadratureRule& rule) {
    std::vector<HatNode> nodes;
    for (int half = std::max(0, 2 * index - 1); half <= std::min(2 * n - 1, 2 * index + 2); ++half)
        for (int i = 0; i < rule.size(); ++i) {
            const double at = (half + rule.nodes[i]) / 2, weight = rule.weights[i] / n;
            const double own = 1 - std::abs(at - index - 0.5);
            const bool outermost = half == 0 || half == 2 * n - 1;
            nodes.push_back({2 * at / n - 1, own * weight, outermost ? (1 - own) * weight : 0});
        }
    return nodes;
}

/// Integrals over one point and its mirror images on the faces beside and above.
void add_node(const HatNode& a, const HatNode& b, double& solid_angle, glm::dvec3& moment) {
    const double corner = a.across * b.across / 3;  // there the border is the mean of three
    const double own = a.own * b.own + corner, beside = a.across * b.own + corner,
                 above = a.own * b.across + corner;
    const double r2 = 1 + a.s * a.s + b.s * b.s, of_area = 1 / (r2 * std::sqrt(r2));
    const double side_a = a.s < 0 ? -1 : 1, side_b = b.s < 0 ? -1 : 1;
    solid_angle += (own + beside + above) * of_area;
    moment += (own * glm::dvec3(a.s, b.s, 1) + beside * glm::dvec3(side_a, b.s, side_a * a.s) +
               above * glm::dvec3(a.s, side_b, side_b * b.s)) *
              (of_area / std::sqrt(r2));
}

/// A hat's centroid at any texel of face and border.
glm::dvec3 centroid(const QuarterTable<Hat>& hats, int x, int y) {
    const int n = hats.size();
    glm::dvec3 own = hats(x, y).centroid;
    if (2 * x >= n) own.x = -own.x;
    if (2 * y >= n) own.y = -own.y;
    const bool is_beside = x < 0 || x >= n, is_above = y < 0 || y >= n;
    const double side_x = x < 0 ? -1 : 1, side_y = y < 0 ? -1 : 1;
    const glm::dvec3 beside(side_x * own.z, own.y, side_x * own.x),
        above(own.x, side_y * own.z, side_y * own.y);
    if (is_beside && is_above) return (own + beside + above) / 3.0;
    return is_beside ? beside : is_above ? above : own;
}

/// Half the variance that footprints lack at a place of a face, per step between levels and squared texel,
/// times solid angle over area.
///
/// A step adds 5/16 of a squared texel to a footprint's variance, along s and along t: bilinear shares 3/16,
/// the wider bilinear lookup 1/6 - 1/24. In the middle of a face that is round. There it stays, and elsewhere
/// the footprint becomes what the same circle on the sphere looks like in s and t: a variance of
/// r^2 (1 + s^2), r^2 s t, r^2 (1 + t^2), r^2 = 1 + s^2 + t^2, times that of the middle.
struct LackingVariance {
    double ss, st, tt;
};
LackingVariance lacking_variance(double s, double t) {
    constexpr double kOfStep = 5.0 / 16;
    const double r2 = 1 + s * s + t * t, half = kOfStep / 2 / (r2 * std::sqrt(r2));
    return {half * (r2 * (1 + s * s) - 1), half * r2 * s * t, half * (r2 * (1 + t * t) - 1)};
}

/// What of a fine texel goes to the farther of the two coarse texels around it, in x and in y.
struct FarShares {
    double x, y;
};

/// Finds the place among four coarse texels whose bilinear mean of their centroids points where the finer
/// centroid does.
FarShares far_shares(const QuarterTable<Hat>& finer, const QuarterTable<Hat>& rounded_hats, int x, int y) {
    const int left = (x + 1) / 2 - 1, top = (y + 1) / 2 - 1;
    const glm::dvec3 a = centroid(rounded_hats, left, top), b = centroid(rounded_hats, left + 1, top),
                     c = centroid(rounded_hats, left, top + 1), d = centroid(rounded_hats, left + 1, top + 1);
    const glm::dvec3 wanted = finer(x, y).centroid;
    double px = x / 2.0 - 0.25 - left, py = y / 2.0 - 0.25 - top;
    const double half_n = rounded_hats.size() / 2.0;
    constexpr int kMostSteps = 30;  // each divides the distance by 5 or more
    for (int i = 0; i < kMostSteps; ++i) {
        const glm::dvec3 found = (1 - py) * ((1 - px) * a + px * b) + py * ((1 - px) * c + px * d);
        const double dx = half_n * (wanted.x / wanted.z - found.x / found.z),
                     dy = half_n * (wanted.y / wanted.z - found.y / found.z);
        px += dx;
        py += dy;
        if (std::abs(dx) + std::abs(dy) < 1e-6) break;
    }
    assert(px >= 0 && px <= 1 && py >= 0 && py <= 1);
    return {x % 2 ? px : 1 - px, y % 2 ? py : 1 - py};
}

}  // namespace

QuarterTable<Hat> make_hats(int n) {
    const QuadratureRule rule = gauss_legendre(n >= 64 ? 1 : n >= 16 ? 2 : 5);
    std::vector<std::vector<HatNode>> nodes;
    for (int i = 0; i < n; ++i) nodes.push_back(hat_nodes(n, i, rule));
    return {n, [&](int x, int y) {
                double solid_angle = 0;
                glm::dvec3 moment(0);
                for (const HatNode& a : nodes[static_cast<std::size_t>(x)])
                    for (const HatNode& b : nodes[static_cast<std::size_t>(y)])
                        add_node(a, b, solid_angle, moment);
                return Hat{solid_angle, moment / solid_angle};
            }};
}

QuarterTable<RoundingWeights> make_rounding_weights(const QuarterTable<Hat>& hats) {
    const int n = hats.size();
    // Along the axes between texels' middles, the rest across their corners: from the middle of the face
    // outwards. At an edge, where that is inwards on the other face, by halves both ways; at the cube's
    // corners not at all.
    const auto line = [n](int i) { return 2.0 * i / n - 1; };
    const auto across_corner = [&](int i, int j) {
        const double st = lacking_variance(line(i), line(j)).st;
        return i == 0 && j == 0 ? 0 : i == 0 || j == 0 ? st / 2 : st;
    };
    return {n, [&](int x, int y) {
                RoundingWeights w{};
                if (n == 1) {
                    w[4] = 1;
                    return w;
                }
                for (const int side : {0, 1}) {
                    const LackingVariance in_x = lacking_variance(line(x + side), cube_coordinate(y, n)),
                                          in_y = lacking_variance(cube_coordinate(x, n), line(y + side));
                    w[static_cast<std::size_t>(3 + 2 * side)] = in_x.ss - std::abs(in_x.st);
                    w[static_cast<std::size_t>(1 + 6 * side)] = in_y.tt - std::abs(in_y.st);
                }
                w[0] = across_corner(x, y);
                w[8] = across_corner(x + 1, y + 1);
                w[2] = y == 0 ? across_corner(x + 1, 0) : 0;
                w[6] = x == 0 ? across_corner(0, y + 1) : 0;
                const double area = 4.0 / (static_cast<double>(n) * n);
                for (double& weight : w) weight *= area / (kRoundingPasses * hats(x, y).solid_angle);
                w[4] = 1 - std::accumulate(w.begin(), w.end(), 0.0);
                return w;
            }};
}

QuarterTable<Hat> rounded(const QuarterTable<Hat>& hats, const QuarterTable<RoundingWeights>& weights) {
    QuarterTable<Hat> result = hats;
    for (int pass = 0; pass < kRoundingPasses; ++pass)
        result = {hats.size(), [&, before = result](int x, int y) {
                      glm::dvec3 mean(0);
                      for (int k = 0; k < 9; ++k)
                          mean += weights(x, y)[static_cast<std::size_t>(k)] *
                                  centroid(before, x - 1 + k % 3, y - 1 + k / 3);
                      return Hat{hats(x, y).solid_angle, mean};
                  }};
    return result;
}

QuarterTable<SharingWeights> make_sharing_weights(const QuarterTable<Hat>& finer,
                                                  const QuarterTable<Hat>& hats,
                                                  const QuarterTable<Hat>& rounded_hats) {
    const QuarterTable<FarShares> far(finer.size(),
                                      [&](int x, int y) { return far_shares(finer, rounded_hats, x, y); });
    return {hats.size(), [&](int x, int y) {
                SharingWeights w;
                for (int k = 0; k < 16; ++k) {
                    const int column = k % 4, row = k / 4, fx = 2 * x - 1 + column, fy = 2 * y - 1 + row;
                    const FarShares& share = far(fx, fy);
                    w[static_cast<std::size_t>(k)] = (column == 0 || column == 3 ? share.x : 1 - share.x) *
                                                     (row == 0 || row == 3 ? share.y : 1 - share.y) *
                                                     finer(fx, fy).solid_angle / hats(x, y).solid_angle;
                }
                return w;
            }};
}

}  // namespace pbr
