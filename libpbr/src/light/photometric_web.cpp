#include "pbr/light/photometric_web.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sum.hpp"

namespace pbr {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kAngleSlack_deg = 1e-9;  // covers the rounding of a direction's angles

SinCos sin_cos_deg(double deg) { return sin_cos_pi(deg / 180); }

double atan2_deg(double y, double x) { return atan2_exact(y, x) / kDegree; }

[[maybe_unused]] bool is_ascending(const std::vector<double>& angles) {
    return !angles.empty() &&
           std::adjacent_find(angles.begin(), angles.end(), std::greater_equal<>()) == angles.end();
}

/// deg modulo 360, not below `first`. Angles already there stay as they are, bit for bit.
double turned_into(double deg, double first) {
    if (deg >= first && deg < first + 360) return deg;
    const double turns = std::floor((deg - first) / 360);
    return std::max(deg - 360 * turns, first);
}

/// Place among ascending angles, zero outside.
GridPlace place_in(const std::vector<double>& angles, double deg) {
    const int last = static_cast<int>(angles.size()) - 1;
    if (deg < angles.front())
        return deg < angles.front() - kAngleSlack_deg ? GridPlace{} : GridPlace{0, 0, 0};
    if (deg >= angles.back())
        return deg > angles.back() + kAngleSlack_deg ? GridPlace{} : GridPlace{last, last, 0};
    const int upper = static_cast<int>(std::upper_bound(angles.begin(), angles.end(), deg) - angles.begin());
    const double low = angles[static_cast<std::size_t>(upper - 1)],
                 high = angles[static_cast<std::size_t>(upper)];
    return {upper - 1, upper, (deg - low) / (high - low)};
}

/// Place among angles that are an azimuth: the same angle comes again after every turn, and one that misses
/// the range by rounding alone still counts.
GridPlace azimuth_place(const std::vector<double>& angles, double deg) {
    const double turned = turned_into(deg, angles.front());
    const GridPlace place = place_in(angles, turned);
    return place.is_inside() ? place : place_in(angles, turned - 360);
}

/// Integrals over [a, b] (polar angles, degrees) of sin times the hat functions that fall to 0 at b and at a:
/// with m the middle and h half the width, sin(m) sin(h) -+ cos(m) (sin(h) - h cos(h)) / h.
std::pair<double, double> hat_integrals(double a_deg, double b_deg) {
    const SinCos middle = sin_cos_deg((a_deg + b_deg) / 2), half = sin_cos_deg((b_deg - a_deg) / 2);
    const double h = (b_deg - a_deg) / 2 * kDegree;
    // The difference cancels for small h; its series to h^6 is then exact to 1e-16 (h^8 / 45,360).
    const double skew =
        h < .05 ? h * h / 3 * (1 - h * h / 10 * (1 - h * h / 28)) : (half.sin - h * half.cos) / h;
    return {middle.sin * half.sin - middle.cos * skew, middle.sin * half.sin + middle.cos * skew};
}

}  // namespace

PhotometricAngles photometric_angles(Photometry type, const Vec3<double>& d) {
    switch (type) {
        case Photometry::type_a:
            return {atan2_deg(d.y, std::sqrt(d.x * d.x + d.z * d.z)), atan2_deg(d.x, -d.z)};
        case Photometry::type_b:
            return {atan2_deg(d.y, -d.z), atan2_deg(d.x, std::sqrt(d.y * d.y + d.z * d.z))};
        case Photometry::type_c:
            break;
    }
    const double azimuth = atan2_deg(d.y, d.x);
    return {atan2_deg(std::sqrt(d.x * d.x + d.y * d.y), -d.z), azimuth < 0 ? azimuth + 360 : azimuth};
}

Vec3<double> photometric_direction(Photometry type, const PhotometricAngles& angles) {
    const SinCos v = sin_cos_deg(angles.vertical_deg), h = sin_cos_deg(angles.horizontal_deg);
    switch (type) {
        case Photometry::type_a:
            return {v.cos * h.sin, v.sin, -v.cos * h.cos};
        case Photometry::type_b:
            return {h.sin, h.cos * v.sin, -h.cos * v.cos};
        case Photometry::type_c:
            break;
    }
    return {v.sin * h.cos, v.sin * h.sin, -v.cos};
}

PhotometricWeb::PhotometricWeb(Photometry type, HorizontalCover cover, std::vector<double> vertical_deg,
                               std::vector<double> horizontal_deg, std::vector<double> candela_cd)
    : type_(type),
      cover_(cover),
      vertical_(std::move(vertical_deg)),
      horizontal_(std::move(horizontal_deg)),
      candela_(std::move(candela_cd)) {
    assert(is_ascending(vertical_) && is_ascending(horizontal_));
    assert(candela_.size() == vertical_.size() * horizontal_.size());
    assert(vertical_.back() - vertical_.front() <= 360 && horizontal_.back() - horizontal_.front() <= 360);
    assert(type_ != Photometry::type_c || (vertical_.front() >= 0 && vertical_.back() <= 180));
    assert(type_ == Photometry::type_c || cover_ == HorizontalCover::mirrored ||
           cover_ == HorizontalCover::range);
    assert(cover_ != HorizontalCover::axial || horizontal_.size() == 1);
    assert(cover_ != HorizontalCover::mirrored || type_ == Photometry::type_c || horizontal_.front() == 0);
}

GridPlace PhotometricWeb::vertical_place(double vertical_deg) const {
    return type_ == Photometry::type_b ? azimuth_place(vertical_, vertical_deg)
                                       : place_in(vertical_, vertical_deg);
}

GridPlace PhotometricWeb::horizontal_place(double horizontal_deg) const {
    const double first = horizontal_.front(), span = horizontal_.back() - first;
    switch (cover_) {
        case HorizontalCover::axial:
            return {0, 0, 0};
        case HorizontalCover::mirrored: {
            if (type_ == Photometry::type_b) return place_in(horizontal_, std::abs(horizontal_deg));
            if (type_ == Photometry::type_a)
                return place_in(horizontal_, std::abs(turned_into(horizontal_deg, -180)));
            const double along = turned_into(horizontal_deg, first) - first;
            const double period = 2 * span, folded = along - period * std::floor(along / period);
            return place_in(horizontal_, first + std::min(folded, period - folded));
        }
        case HorizontalCover::ring: {
            const double turned = turned_into(horizontal_deg, first);
            if (turned <= horizontal_.back()) return place_in(horizontal_, turned);
            const int last = static_cast<int>(horizontal_.size()) - 1;
            return {last, 0, (turned - horizontal_.back()) / (360 - span)};
        }
        case HorizontalCover::range:
            break;
    }
    return type_ == Photometry::type_b ? place_in(horizontal_, horizontal_deg)
                                       : azimuth_place(horizontal_, horizontal_deg);
}

double PhotometricWeb::blend_cd(const GridPlace& v, const GridPlace& h) const {
    if (!v.is_inside() || !h.is_inside()) return 0;
    const auto mix = [](double a, double b, double t) { return a + (b - a) * t; };
    return mix(mix(grid_cd(v.lower, h.lower), grid_cd(v.upper, h.lower), v.fraction),
               mix(grid_cd(v.lower, h.upper), grid_cd(v.upper, h.upper), v.fraction), h.fraction);
}

std::vector<double> PhotometricWeb::elevation_weights(FluxRule rule) const {
    const bool is_b = type_ == Photometry::type_b;
    const std::vector<double>& angles = is_b ? horizontal_ : vertical_;
    const double pole = type_ == Photometry::type_c ? 0 : 90;  // from an elevation to the angle from a pole
    const double copies = is_b && cover_ == HorizontalCover::mirrored ? 2 : 1;
    std::vector<double> weights(angles.size());
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
        auto [low, high] = hat_integrals(angles[i] + pole, angles[i + 1] + pole);
        if (rule == FluxRule::zonal) low = high = (low + high) / 2;
        weights[i] += copies * low;
        weights[i + 1] += copies * high;
    }
    return weights;
}

std::vector<double> PhotometricWeb::azimuth_weights() const {
    if (cover_ == HorizontalCover::axial) return {2 * std::numbers::pi};
    const std::vector<double>& angles = type_ == Photometry::type_b ? vertical_ : horizontal_;
    const double span = angles.back() - angles.front();
    double copies = 1;
    if (cover_ == HorizontalCover::mirrored && type_ != Photometry::type_b)
        copies = type_ == Photometry::type_c ? 360 / span : 2;
    std::vector<double> weights(angles.size());
    const auto add_cell = [&](std::size_t i, std::size_t j, double width_deg) {
        weights[i] += copies * width_deg * kDegree / 2;
        weights[j] += copies * width_deg * kDegree / 2;
    };
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) add_cell(i, i + 1, angles[i + 1] - angles[i]);
    if (cover_ == HorizontalCover::ring) add_cell(angles.size() - 1, 0, 360 - span);
    return weights;
}

double PhotometricWeb::flux_lm(FluxRule rule) const {
    const std::vector<double> elevation = elevation_weights(rule), azimuth = azimuth_weights();
    const bool is_b = type_ == Photometry::type_b;
    const std::vector<double>&vertical = is_b ? azimuth : elevation, &horizontal = is_b ? elevation : azimuth;
    CompensatedSum flux;
    for (std::size_t h = 0; h < horizontal.size(); ++h)
        for (std::size_t v = 0; v < vertical.size(); ++v)
            flux += candela_[h * vertical.size() + v] * vertical[v] * horizontal[h];
    return flux.value();
}

double PhotometricWeb::max_cd() const { return *std::max_element(candela_.begin(), candela_.end()); }

PhotometricAngles PhotometricWeb::max_angles() const {
    const auto at =
        static_cast<std::size_t>(std::max_element(candela_.begin(), candela_.end()) - candela_.begin());
    return {vertical_[at % vertical_.size()], horizontal_[at / vertical_.size()]};
}

double PhotometricWeb::mean_cd() const { return flux_lm() / (4 * std::numbers::pi); }

PhotometricWeb PhotometricWeb::unfolded() const {
    std::vector<double> angles;
    std::vector<int> source;  // the plane of this web that each angle shows
    const int count = static_cast<int>(horizontal_.size());
    const double first = horizontal_.front(), span = horizontal_.back() - first;
    const auto add = [&](double deg, int plane) {
        angles.push_back(deg);
        source.push_back(plane);
    };
    if (type_ != Photometry::type_c && cover_ == HorizontalCover::mirrored)
        for (int i = count - 1; i > 0; --i) add(-horizontal_[static_cast<std::size_t>(i)], i);
    for (int i = 0; i < count; ++i) add(horizontal_[static_cast<std::size_t>(i)], i);
    if (type_ == Photometry::type_c && cover_ == HorizontalCover::mirrored)
        for (double from = span; from < 360; from += 2 * span) {  // there and back, until the turn is full
            for (int i = count - 2; i >= 0; --i)
                add(first + from + (horizontal_.back() - horizontal_[static_cast<std::size_t>(i)]), i);
            for (int i = 1; i < count && from + span < 360; ++i)
                add(first + from + span + (horizontal_[static_cast<std::size_t>(i)] - first), i);
        }
    if (cover_ == HorizontalCover::axial || (cover_ == HorizontalCover::ring && span < 360))
        add(first + 360, 0);

    std::vector<double> candela;
    candela.reserve(angles.size() * vertical_.size());
    for (const int plane : source)
        for (int v = 0; v < static_cast<int>(vertical_.size()); ++v) candela.push_back(grid_cd(v, plane));
    const bool is_ring = type_ == Photometry::type_c && cover_ != HorizontalCover::range;
    return {type_, is_ring ? HorizontalCover::ring : HorizontalCover::range, vertical_, std::move(angles),
            std::move(candela)};
}

PhotometricWeb PhotometricWeb::turned(double deg) const {
    if (type_ == Photometry::type_a && cover_ == HorizontalCover::mirrored) return unfolded().turned(deg);
    PhotometricWeb web = *this;
    for (double& angle : type_ == Photometry::type_b ? web.vertical_ : web.horizontal_) angle += deg;
    return web;
}

double in_plane_cd(const PhotometricWeb& web, AxialPlane plane, double deg) {
    const SinCos at = sin_cos_deg(deg);
    return web.evaluate_cd(plane == AxialPlane::c0 ? Vec3<double>(at.sin, 0, -at.cos)
                                                   : Vec3<double>(0, at.sin, -at.cos));
}

double beam_angle_deg(const PhotometricWeb& web, AxialPlane plane, double fraction) {
    // In these planes intensity is linear between the grid's angles, so crossings are found exactly.
    std::vector<double> stops{0, 90, 180};
    for (const std::vector<double>* angles : {&web.vertical_deg(), &web.horizontal_deg()})
        for (const double angle : *angles)
            if (std::abs(angle) < 180) stops.push_back(std::abs(angle));
    double peak = 0, axis = 0;
    for (const double stop : stops)
        for (const double side : {1, -1})
            if (const double cd = in_plane_cd(web, plane, side * stop); cd > peak) {
                peak = cd;
                axis = stop <= 90 ? 0 : 180;
            }
    if (peak <= 0) return 0;

    for (double& stop : stops) stop = std::abs(axis - stop);  // from now on angles from the axis
    std::erase_if(stops, [](double stop) { return stop > 90; });
    std::sort(stops.begin(), stops.end(), std::greater<>());
    const auto outermost = [&](double side) {
        const auto at = [&](double from_axis) {
            return in_plane_cd(web, plane, side * std::abs(axis - from_axis));
        };
        for (std::size_t i = 0; i < stops.size(); ++i) {
            const double inner = stops[i], inner_cd = at(inner), excess = inner_cd - fraction * peak;
            if (excess < 0) continue;
            if (i == 0) return inner;
            const double reach = (stops[i - 1] - inner) / 2, middle_cd = at(inner + reach);
            // Dark at once beside a lit stop: the measured range ends here.
            return middle_cd <= 0 ? inner : inner + reach * excess / (inner_cd - middle_cd);
        }
        return 0.;
    };
    return outermost(1) + outermost(-1);
}

}  // namespace pbr
