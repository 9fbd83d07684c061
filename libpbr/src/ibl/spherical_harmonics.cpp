#include "pbr/ibl/spherical_harmonics.hpp"

#include <cassert>
#include <iterator>

#include "pbr/ibl/patches.hpp"

namespace pbr {
namespace {

/// The first of PatchBlocks::kOrders that integrates Y over a texel within 1e-9. Over a texel of angle h, Y
/// of band l is about a wave of phase l h; n points leave (l h)^(2n) (n!)^4 / ((2n+1) ((2n)!)^3) of it.
int order_for(double phase) {
    for (int i = 0; i < static_cast<int>(std::size(PatchBlocks::kOrders)); ++i) {
        const int n = PatchBlocks::kOrders[i];
        double error = 1.0 / (2 * n + 1);
        for (double k = 1; k <= n; ++k) {
            const double odd = 2 * k - 1;
            error *= phase * phase * k / (odd * odd * odd * 8);
        }
        if (error < 1e-9) return i;
    }
    return static_cast<int>(std::size(PatchBlocks::kOrders)) - 1;
}

}  // namespace

std::vector<glm::dvec3> sh_project(const PatchBlocks& source, int bands) {
    assert(bands >= 1);
    const int order = order_for(bands * source.texel_angle());
    std::vector<glm::dvec3> coefficients(sh_count(bands), glm::dvec3(0));
    std::vector<double> basis(sh_count(bands));
    PatchPoints points;
    for (int block = 0; block < source.count(); ++block) {
        source.points(block, order, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec3 flux =
                static_cast<double>(points.weight[i]) * glm::dvec3(points.r[i], points.g[i], points.b[i]);
            sh_evaluate<double>(bands, {points.x[i], points.y[i], points.z[i]}, basis);
            for (int j = 0; j < sh_count(bands); ++j) coefficients[j] += flux * basis[j];
        }
    }
    return coefficients;
}

}  // namespace pbr
