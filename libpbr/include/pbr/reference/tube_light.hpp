#pragma once
// Reflected radiance of a tube light, integrated over the directions in which it is seen; conventions of
// reference/reflected_radiance.hpp.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "pbr/light/tube_light.hpp"
#include "pbr/reference/reflected_radiance.hpp"

namespace pbr {

/// The directions of a tube from the origin, outside of it and off the prolonged axis' cylinder: psi turns
/// about the line through the origin along the axis, gamma is the angle from the axis. The half-plane of a
/// psi cuts a stadium out of the tube, so that gamma has one range.
class TubeDomain {
  public:
    /// The tube stands in the frame of the surface.
    explicit TubeDomain(const TubeLight<double>& tube) {
        const Vec3<double> along = tube.end1 - tube.end0;
        const Vec3<double> axis = along / glm::length(along);
        const Vec3<double> foot = tube.end0 - glm::dot(tube.end0, axis) * axis;
        frame_ = frame_towards(axis, foot);
        distance_ = glm::length(foot);
        radius_ = tube.radius;
        end0_ = glm::dot(tube.end0, axis);
        end1_ = glm::dot(tube.end1, axis);
    }

    /// The direction at turn t in [-pi/2, pi/2], sin psi = radius / distance sin t, and angle gamma.
    Vec3<double> direction(double t, double gamma) const {
        const double s = sin_psi(t), c = std::sqrt(1 - s * s);
        return frame_.to_world({std::sin(gamma) * c, std::sin(gamma) * s, std::cos(gamma)});
    }

    /// Solid angle over dt dgamma.
    double density(double t, double gamma) const {
        const double s = sin_psi(t);
        return radius_ / distance_ * std::cos(t) / std::sqrt(1 - s * s) * std::sin(gamma);
    }

    /// The angles gamma at turn t under which the tube is seen above the surface; empty if the second is not
    /// larger.
    std::pair<double, double> gamma_range(double t) const {
        constexpr double kPi = std::numbers::pi;
        const double s = sin_psi(t), away = distance_ * std::sqrt(1 - s * s),
                     half_width = radius_ * std::cos(t);
        double low = kPi, high = 0;
        for (const double end : {end0_, end1_}) {
            const double middle = std::atan2(away, end), half = std::asin(half_width / std::hypot(away, end));
            low = std::min(low, middle - half);
            high = std::max(high, middle + half);
        }
        // Height cos(gamma) a + sin(gamma) b is positive within a quarter turn of its highest angle.
        double highest = std::atan2(direction(t, kPi / 2).z, frame_.z.z);
        if (highest < -kPi / 2) highest += 2 * kPi;
        return {std::max(low, highest - kPi / 2), std::min(high, highest + kPi / 2)};
    }

    /// Break points of the turns and of the share of gamma_range, graded towards peaks.
    std::pair<std::vector<double>, std::vector<double>> breaks(std::span<const Peak> peaks) const {
        constexpr double kQuarter = std::numbers::pi / 2;
        std::vector<double> turns = {-kQuarter, 0, kQuarter}, shares = {0, 1};
        for (const Peak& peak : peaks) {
            const Vec3<double> w = frame_.to_local(peak.direction);
            const double across = std::hypot(w.x, w.y);
            if (!(across > peak.width_rad)) continue;
            const double t = std::asin(std::clamp(w.y / across * distance_ / radius_, -1.0, 1.0));
            add_graded_breaks(-kQuarter, kQuarter, t, peak.width_rad * distance_ / radius_ / across, turns);
            const auto [low, high] = gamma_range(t);
            if (high > low)
                add_graded_breaks(0, 1, (std::atan2(across, w.z) - low) / (high - low),
                                  peak.width_rad / (high - low), shares);
        }
        sort_breaks(turns);
        sort_breaks(shares);
        return {turns, shares};
    }

  private:
    double sin_psi(double t) const { return radius_ / distance_ * std::sin(t); }

    AxisFrame<double> frame_{};
    double distance_ = 0, radius_ = 0;  ///< of the axis' line from the origin; of the tube
    double end0_ = 0, end1_ = 0;        ///< along the axis
};

/// From a tube with its caps, as far as it lies above the surface. From inside it is all directions; where
/// one end hides all else, and without length, a sphere's cap.
template <class Brdf, class Incident>
Estimate reflected_radiance_from_tube(const Brdf& brdf, const Vec3<double>& wo, const TubeLight<double>& tube,
                                      const Incident& incident, const QuadratureTolerance& tolerance = {},
                                      std::span<const Peak> peaks = {}) {
    const Vec3<double> nearest = closest_point_on_segment(tube.end0, tube.end1, Vec3<double>(0));
    const Vec3<double> along = tube.end1 - tube.end0;
    const double line_distance =
        glm::length(along) > 0 ? glm::length(glm::cross(tube.end0, glm::normalize(along))) : 0.0;
    if (!(glm::length(nearest) > tube.radius) || !(line_distance > tube.radius))
        return reflected_radiance_from_cap(brdf, wo, cap_of_sphere(nearest, tube.radius), incident, tolerance,
                                           peaks);
    const TubeDomain domain(tube);
    const auto integrand = [&](double t, double share) {
        const auto [low, high] = domain.gamma_range(t);
        if (!(high > low)) return 0.0;
        const double gamma = low + (high - low) * share;
        const Vec3<double> wi = domain.direction(t, gamma);
        if (!(wi.z > 0)) return 0.0;  // a rounding below the horizon
        return brdf(wo, wi) * incident(wi) * wi.z * domain.density(t, gamma) * (high - low);
    };
    const auto [turns, shares] = domain.breaks(peaks);
    return integrate_adaptive_2d(integrand, turns, shares, tolerance);
}

}  // namespace pbr
