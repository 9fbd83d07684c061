#pragma once
// Reflected radiance of an environment that is a picture, texel by texel.

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <iterator>
#include <numbers>

#include "pbr/ibl/patches.hpp"
#include "pbr/numerics/adaptive_quadrature.hpp"
#include "pbr/numerics/sum.hpp"
#include "pbr/numerics/vector.hpp"
#include "pbr/reference/colour.hpp"

namespace pbr {

/// Reflected radiance of one channel and what is thought of its error, summed over a block's points.
struct BlockSum {
    glm::dvec3 value{0.0};
    double magnitude = 0;  ///< of the largest channel, radiance taken as its absolute value
};

/// The integral of brdf(wo, wi) L(wi) wi.z over the hemisphere, brdf a double or an RGB Vec3<double>, L a
/// picture constant over each texel. The sum over texels with their exact solid angles; within a texel
/// Gauss-Legendre points, block by block (up to 8x8 texels) of rising order until two orders agree within
/// `relative_tolerance` of the whole sum's scale. Blocks wholly below the surface cost nothing.
///
/// `world_to_surface` is a rotation that takes the picture's world to the frame of the surface, normal +z; wo
/// is in that frame, wo.z > 0. Limits: points are rounded to float, so a lobe of width alpha is off by about
/// 1e-7 / alpha, relatively; a texel cut by the horizon converges like 1/order², which the error estimate
/// includes.
template <class Brdf>
ColourEstimate reflected_radiance_from_texels(const Brdf& brdf, const Vec3<double>& wo,
                                              const PatchBlocks& source, const glm::dmat3& world_to_surface,
                                              double relative_tolerance = 1e-6) {
    constexpr int kOrderCount = static_cast<int>(std::size(PatchBlocks::kOrders));
    PatchPoints points;
    ColourEstimate estimate;
    const auto sum_block = [&](int block, int order) {
        source.points(block, order, points);
        BlockSum sum;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec3<double> wi = world_to_surface * Vec3<double>(points.x[i], points.y[i], points.z[i]);
            if (!(wi.z > 0)) continue;
            ++estimate.evaluations;
            const glm::dvec3 term = brdf(wo, wi) * wi.z * static_cast<double>(points.weight[i]) *
                                    glm::dvec3(points.r[i], points.g[i], points.b[i]);
            sum.value += term;
            sum.magnitude += std::max({std::abs(term.x), std::abs(term.y), std::abs(term.z)});
        }
        return sum;
    };
    const auto is_below = [&](int block) {
        const Cone& cone = source.cone(block);
        const double height = (world_to_surface * cone.axis).z;
        return std::acos(std::clamp(height, -1.0, 1.0)) > std::numbers::pi / 2 + cone.half_angle;
    };
    // The scale of the whole, from the coarsest order: what a block's error is weighed against.
    std::vector<BlockSum> coarse(source.count());
    double scale = 0;
    for (int block = 0; block < source.count(); ++block) {
        if (is_below(block)) continue;
        coarse[block] = sum_block(block, 0);
        scale += coarse[block].magnitude;
    }
    CompensatedSum total[3], error;
    const double share = relative_tolerance / std::max(1, source.count());
    for (int block = 0; block < source.count(); ++block) {
        if (is_below(block)) continue;
        BlockSum previous = coarse[block];
        double difference = 0;
        for (int order = 1; order < kOrderCount; ++order) {
            const BlockSum current = sum_block(block, order);
            const glm::dvec3 change = current.value - previous.value;
            difference = std::max({std::abs(change.x), std::abs(change.y), std::abs(change.z)});
            scale += current.magnitude - previous.magnitude;
            previous = current;
            if (difference <= share * scale || difference <= 1e-7 * current.magnitude) break;
        }
        error += difference;
        for (int channel = 0; channel < 3; ++channel) total[channel] += previous.value[channel];
    }
    for (int channel = 0; channel < 3; ++channel) estimate.value[channel] = total[channel].value();
    estimate.error = error.value();
    estimate.converged = estimate.error <= relative_tolerance * scale;
    return estimate;
}

}  // namespace pbr
