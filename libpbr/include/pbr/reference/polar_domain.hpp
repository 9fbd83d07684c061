#pragma once
// Part of the upper hemisphere as polar coordinates about an axis: what reference integrals over directions
// run on.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// Where an integrand is peaked: quadrature that isn't told of a narrow peak can miss it altogether.
struct Peak {
    Vec3<double> direction;  ///< unit, frame of the surface
    double width_rad;        ///< the angle over which it changes by its own size, > 0
};

/// Break points of [low, high], ascending, its ends included, with more of them towards `centre`: centre ±
/// width 4^k.
inline void add_graded_breaks(double low, double high, double centre, double width,
                              std::vector<double>& breaks) {
    if (centre > low && centre < high) breaks.push_back(centre);
    for (double distance = width; distance < high - low; distance *= 4)
        for (const double at : {centre - distance, centre + distance})
            if (at > low && at < high) breaks.push_back(at);
}

/// Sorts break points and drops those that coincide.
inline void sort_breaks(std::vector<double>& breaks) {
    std::sort(breaks.begin(), breaks.end());
    breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
}

/// The directions within half_angle_rad (in [0, pi]) of a unit axis that lie above the surface with normal
/// +z, as (azimuth psi, angle gamma to the axis); psi = 0 points from the axis to the normal.
class PolarDomain {
  public:
    /// The whole hemisphere is PolarDomain({0, 0, 1}, pi/2): psi then counts from the x axis.
    PolarDomain(const Vec3<double>& axis, double half_angle_rad) : axis_(axis), half_angle_(half_angle_rad) {
        sine_ = std::hypot(axis.x, axis.y);
        up_ = sine_ > 0 ? Vec3<double>(-axis.z * axis.x / sine_, -axis.z * axis.y / sine_, sine_)
                        : Vec3<double>(1, 0, 0);
        side_ = glm::cross(axis_, up_);
    }

    /// The unit vector at (psi, gamma).
    Vec3<double> direction(double psi, double gamma) const {
        return std::cos(gamma) * axis_ + std::sin(gamma) * (std::cos(psi) * up_ + std::sin(psi) * side_);
    }

    /// (psi, gamma) of a unit vector.
    std::pair<double, double> coordinates(const Vec3<double>& w) const {
        const double x = glm::dot(w, up_), y = glm::dot(w, side_);
        return {std::atan2(y, x), std::atan2(std::hypot(x, y), glm::dot(w, axis_))};
    }

    /// The angles gamma at azimuth psi that belong to the domain; empty where first >= second. Along psi the
    /// height over the surface is proportional to cos(gamma - delta), tan(delta) = sine cos(psi) / axis.z:
    /// above it within pi/2 of delta.
    std::pair<double, double> gamma_range(double psi) const {
        double delta = std::atan2(sine_ * std::cos(psi), axis_.z);
        if (delta < -std::numbers::pi / 2)
            delta += 2 * std::numbers::pi;  // an axis below, seen past its far side
        return {std::max(0.0, delta - std::numbers::pi / 2),
                std::min(half_angle_, delta + std::numbers::pi / 2)};
    }

    /// Break points over psi in [-pi, pi]: quarter turns, and where the horizon meets the rim of the cap.
    std::vector<double> psi_breaks(std::span<const Peak> peaks) const {
        constexpr double kPi = std::numbers::pi;
        std::vector<double> breaks = {-kPi, -kPi / 2, 0, kPi / 2, kPi};
        const double crossing = -axis_.z * std::cos(half_angle_), reach = sine_ * std::sin(half_angle_);
        if (std::abs(crossing) < reach) {
            const double psi = std::acos(crossing / reach);
            breaks.insert(breaks.end(), {-psi, psi});
        }
        for (const Peak& peak : peaks) {
            const auto [psi, gamma] = coordinates(peak.direction);
            if (std::sin(gamma) > peak.width_rad)
                add_graded_breaks(-kPi, kPi, psi, peak.width_rad / std::sin(gamma), breaks);
        }
        sort_breaks(breaks);
        return breaks;
    }

    /// Break points over the share [0, 1] of gamma_range, for the ranges at the peaks' own azimuths.
    std::vector<double> share_breaks(std::span<const Peak> peaks) const {
        std::vector<double> breaks = {0, 1};
        for (const Peak& peak : peaks) {
            const auto [psi, gamma] = coordinates(peak.direction);
            const auto [low, high] = gamma_range(psi);
            if (high > low)
                add_graded_breaks(0, 1, (gamma - low) / (high - low), peak.width_rad / (high - low), breaks);
        }
        sort_breaks(breaks);
        return breaks;
    }

  private:
    Vec3<double> axis_, up_, side_;
    double half_angle_, sine_;
};

}  // namespace pbr
