#include "pbr/ibl/environment_sampler.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/matrix.hpp>
#include <span>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sum.hpp"

namespace pbr {
namespace {

/// Mean over channels; radiances near the largest float don't overflow.
double grey(const float* rgb) { return (static_cast<double>(rgb[0]) + rgb[1] + rgb[2]) / 3; }

/// The step of a running sum that u in [0, 1) falls into, and where in it, in [0, 1). Steps of no height are
/// never chosen. The sum ends above 0.
struct Step {
    int index;
    double within;
};
Step step_at(std::span<const double> sums, double u) {
    const double target = std::min(u * sums.back(), std::nextafter(sums.back(), 0.0));
    const auto above = std::upper_bound(sums.begin(), sums.end(), target);
    const double low = above[-1], height = *above - low;
    return {static_cast<int>(above - sums.begin()) - 1, std::min((target - low) / height, 1 - 0x1p-53)};
}

}  // namespace

EnvironmentSampler::EnvironmentSampler(const EquirectView& source)
    : EnvironmentSampler(source.rgb, false, source.width, source.height, source.world_to_source) {}

EnvironmentSampler::EnvironmentSampler(const CubeView& source)
    : EnvironmentSampler(source.rgb, true, source.size, 6 * source.size, glm::dmat3(1)) {}

EnvironmentSampler::EnvironmentSampler(const float* rgb, bool is_cube, int columns, int rows,
                                       const glm::dmat3& world_to_source)
    : is_cube_(is_cube),
      columns_(columns),
      rows_(rows),
      world_to_source_(world_to_source),
      texels_(static_cast<std::size_t>(columns) * rows * 4),
      conditional_(static_cast<std::size_t>(columns + 1) * rows),
      marginal_(static_cast<std::size_t>(rows) + 1) {
    CompensatedSum flux, sphere;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const double angle = solid_angle(y, x);
            flux += angle * grey(rgb + (static_cast<std::size_t>(y) * columns + x) * 3);
            sphere += angle;
        }
    // A rounding above the mean is not brighter than it: constant pictures are flat.
    const double mean = flux.value() / sphere.value() * (1 + 1e-12);
    for (int y = 0; y < rows; ++y) {
        double* sums = &conditional_[static_cast<std::size_t>(columns + 1) * y];
        for (int x = 0; x < columns; ++x) {
            const std::size_t texel = static_cast<std::size_t>(y) * columns + x;
            const double excess = std::max(0.0, grey(rgb + texel * 3) - mean);
            sums[x + 1] = sums[x] + excess * solid_angle(y, x);
        }
        marginal_[static_cast<std::size_t>(y) + 1] = marginal_[static_cast<std::size_t>(y)] + sums[columns];
    }
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const std::size_t texel = static_cast<std::size_t>(y) * columns + x;
            std::copy_n(rgb + texel * 3, 3, &texels_[texel * 4]);
            const double excess = std::max(0.0, grey(rgb + texel * 3) - mean);
            if (excess <= 0) continue;
            const double share_per_texel_angle = excess / marginal_.back();
            texels_[texel * 4 + 3] =
                static_cast<float>(is_cube ? share_per_texel_angle * solid_angle(y, x) * columns * columns / 4
                                           : share_per_texel_angle);
        }
}

double EnvironmentSampler::solid_angle(int row, int column) const {
    return is_cube_ ? cubemap_texel_solid_angle(columns_, column, row % columns_)
                    : equirect_texel_solid_angle(columns_, rows_, row);
}

glm::dvec3 EnvironmentSampler::direction_in(int row, int column, double v1, double v2) const {
    if (is_cube_) {
        const double s = 2 * (column + v2) / columns_ - 1, t = 2 * (row % columns_ + v1) / columns_ - 1;
        return cube_vector(row / columns_, s, t) / std::sqrt(1 + s * s + t * t);
    }
    // 1 - cos of the colatitude is even over the row; taken from the nearer pole it keeps its digits there.
    const bool lower_half = 2 * row >= rows_;
    const auto one_minus_cos = [&](int edge) {
        const double half_sine = sin_cos_pi(0.5 * (lower_half ? rows_ - edge : edge) / rows_).sin;
        return 2 * half_sine * half_sine;
    };
    const double above = one_minus_cos(row), below = one_minus_cos(row + 1);
    const double height = above + v1 * (below - above);
    const double sine = std::sqrt(height * (2 - height)), cosine = 1 - height;
    const SinCos longitude = sin_cos_pi(1 - 2 * (column + v2) / columns_);
    return glm::transpose(world_to_source_) *
           glm::dvec3(longitude.sin * sine, lower_half ? -cosine : cosine, longitude.cos * sine);
}

EnvironmentSampler::Draw EnvironmentSampler::sample(double u1, double u2) const {
    assert(!flat());
    const Step row = step_at(marginal_, u1);
    const std::size_t stride = static_cast<std::size_t>(columns_) + 1;
    const Step column = step_at({&conditional_[stride * row.index], stride}, u2);
    const glm::dvec3 direction = direction_in(row.index, column.index, row.within, column.within);
    const std::int64_t texel = static_cast<std::int64_t>(row.index) * columns_ + column.index;
    double pdf = static_cast<double>(texels_[static_cast<std::size_t>(texel) * 4 + 3]);
    if (is_cube_) {
        const CubePoint point = cube_point(direction);
        const double q = 1 + point.s * point.s + point.t * point.t;
        pdf *= q * std::sqrt(q);
    }
    return {direction, texel, pdf};
}

std::int64_t EnvironmentSampler::texel_at(const glm::dvec3& direction) const {
    const glm::dvec3 d = world_to_source_ * direction;
    if (is_cube_) {
        const CubeTexel texel = cubemap_texel(d, columns_);
        return (static_cast<std::int64_t>(texel.face) * columns_ + texel.y) * columns_ + texel.x;
    }
    const glm::dvec2 uv = equirect_point(d);
    const int x = std::clamp(static_cast<int>(uv.x * columns_), 0, columns_ - 1);
    const int y = std::clamp(static_cast<int>(uv.y * rows_), 0, rows_ - 1);
    return static_cast<std::int64_t>(y) * columns_ + x;
}

double EnvironmentSampler::pdf(const glm::dvec3& direction) const {
    const double density =
        static_cast<double>(texels_[static_cast<std::size_t>(texel_at(direction)) * 4 + 3]);
    if (!is_cube_) return density;
    const CubePoint point = cube_point(direction);
    const double q = 1 + point.s * point.s + point.t * point.t;
    return density * q * std::sqrt(q);
}

}  // namespace pbr
