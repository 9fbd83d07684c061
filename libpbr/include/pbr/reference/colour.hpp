#pragma once
// Reflected radiance in colour: a Material, whose BRDF is a Vec3, through the reference's integrals of
// doubles.

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>

#include "pbr/numerics/adaptive_quadrature.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbr {

/// An RGB integral with the estimate of its largest channel's error.
struct ColourEstimate {
    glm::dvec3 value{0.0};
    double error = 0;
    std::int64_t evaluations = 0;
    bool converged = true;
};

/// One channel of a material as the reference takes BRDFs: material.f(wo, wi)[channel], 1/sr. Refers to the
/// material, which must outlive it.
template <class M>
auto brdf_of_channel(const M& material, int channel) {
    return [&material, channel](const Vec3<double>& wo, const Vec3<double>& wi) {
        return material.f(wo, wi)[channel];
    };
}

/// All channels of a material: integral(brdf) is called with the BRDF of each and gives its Estimate, as by
/// reflected_radiance_from_cap with all else captured. Three times the cost of one.
template <class M, class Integral>
ColourEstimate reflected_colour(const M& material, const Integral& integral) {
    ColourEstimate colour;
    for (int channel = 0; channel < 3; ++channel) {
        const Estimate e = integral(brdf_of_channel(material, channel));
        colour.value[channel] = e.value;
        colour.error = std::max(colour.error, e.error);
        colour.evaluations += e.evaluations;
        colour.converged = colour.converged && e.converged;
    }
    return colour;
}

}  // namespace pbr
