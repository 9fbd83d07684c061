#include "pbr/legacy/light_fit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "pbr/numerics/elementary.hpp"

namespace pbr {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

double window_at(LightWindow window, double distance, double radius) {
    if (radius == kInfinity) return 1;
    if (!(distance < radius)) return 0;
    const double ratio = distance / radius, left = 1 - ratio * ratio * ratio * ratio;
    return window == LightWindow::quartic ? left : left * left;
}

/// For 1 cd.
double emitter_at(EmitterShape shape, double distance, double radius) {
    const double square = distance * distance;
    switch (shape) {
        case EmitterShape::point:
            break;
        case EmitterShape::sphere:
            return 1 / std::max(square, radius * radius);
        case EmitterShape::disk:
            return 1 / (square + radius * radius);
        case EmitterShape::rectangle: {
            if (radius == 0) break;
            const double s = radius / std::sqrt(square + radius * radius);
            return s * atan2_exact(s, 1) / (radius * radius);
        }
    }
    return 1 / square;
}

double middle(const DistanceSpan& span, int i, int count) {
    return span.near + (span.far - span.near) * ((i + .5) / count);
}

/// A law that is some shape's own: 1 / (c + q d^2), with or without a window of the model's form.
bool is_model(const Falloff& law, EmitterShape shape, LightWindow window) {
    const LightWindow own =
        law.window == FalloffWindow::quartic ? LightWindow::quartic : LightWindow::quartic_squared;
    const bool is_windowed =
        law.window == FalloffWindow::quartic || law.window == FalloffWindow::quartic_squared;
    if (has_range(law) && !(is_windowed && own == window)) return false;
    if (law.power > 0) return law.power == 2 && law.floor == 0;
    if (law.floor > law.constant) return false;
    if (law.linear != 0 || !(law.quadratic > 0)) return false;
    return shape == EmitterShape::disk || law.constant == 0;
}

LightFit exact_fit(const Falloff& law, double intensity, EmitterShape shape, LightWindow window,
                   const DistanceSpan& span) {
    PhysicalLight light{shape, window, intensity, 0, has_range(law) ? law.range : kInfinity};
    if (law.power == 0) {
        light.intensity = intensity / law.quadratic;
        light.radius = std::sqrt(law.constant / law.quadratic);
    }
    return {light, stops_between(light, law, intensity, span, 256), true};
}

/// The best of a grid of two parameters, again and again over a smaller one about it. What a parameter's
/// value stands for is worked out once a row or column: `first` and `second` make it, `cost` takes both.
template <class First, class Second, class Cost>
std::array<double, 2> zoom(std::array<double, 2> low, std::array<double, 2> high, const First& first,
                           const Second& second, const Cost& cost) {
    constexpr int kSteps = 24, kRounds = 12;
    const std::array<double, 2> lowest = low, highest = high;
    const std::array<int, 2> steps{low[0] < high[0] ? kSteps : 0, low[1] < high[1] ? kSteps : 0};
    std::array<double, 2> best{low};
    double least = kInfinity;
    for (int round = 0; round < kRounds; ++round) {
        const std::array<double, 2> step{(high[0] - low[0]) / kSteps, (high[1] - low[1]) / kSteps};
        std::vector<decltype(second(0.))> columns;
        for (int j = 0; j <= steps[1]; ++j) columns.push_back(second(low[1] + step[1] * j));
        for (int i = 0; i <= steps[0]; ++i) {
            const auto row = first(low[0] + step[0] * i);
            for (int j = 0; j <= steps[1]; ++j) {
                const double found = cost(row, columns[static_cast<std::size_t>(j)]);
                if (found < least) least = found, best = {low[0] + step[0] * i, low[1] + step[1] * j};
            }
        }
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::max(lowest[k], best[k] - 3 * step[k]);
            high[k] = std::min(highest[k], best[k] + 3 * step[k]);
        }
    }
    return best;
}

/// A curve over the span, in stops: a law's, an emitter's, a window's. Products are sums here.
constexpr int kFitted = 48;
using Curve = std::array<double, kFitted>;

template <class Function>
Curve curve_of(const DistanceSpan& span, const Function& share_at) {
    Curve curve;
    for (int i = 0; i < kFitted; ++i)
        curve[static_cast<std::size_t>(i)] = log2_exact(std::max(share_at(middle(span, i, kFitted)), 1e-300));
    return curve;
}

/// Mean and variance of law - emitter - window: what the intensity makes up for, and what it can't.
std::array<double, 2> moments(const Curve& law, const Curve& emitter, const Curve& window) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < kFitted; ++i) {
        const double difference = law[i] - emitter[i] - window[i];
        sum += difference;
        squares += difference * difference;
    }
    return {sum / kFitted, squares / kFitted - sum / kFitted * (sum / kFitted)};
}

}  // namespace

double illuminance_at(const PhysicalLight& light, double distance) {
    assert(distance > 0);
    return light.intensity * emitter_at(light.shape, distance, light.radius) *
           window_at(light.window, distance, light.attenuation_radius);
}

namespace {

/// Magnitude of the difference at a distance.
double stops_at_distance(const PhysicalLight& light, const Falloff& law, double intensity, double distance) {
    const double found = illuminance_at(light, distance), wanted = intensity * falloff_at(law, distance);
    const bool dark = !(found > 0), should_be_dark = !(wanted > 0);
    if (dark || should_be_dark) return dark == should_be_dark ? 0 : kDarkStops;
    return std::abs(log2_exact(found / wanted));
}

/// Raises `error` to the largest of all peaks: those of a grid that is as fine near the light as far from it,
/// each climbed by thirds, which kinks don't disturb. A light's largest error is often at an end of the span.
template <class Stops>
void take_peaks(const Stops& stops_at, const DistanceSpan& span, StopsError& error) {
    constexpr double kNothing = 1e-9;  // what arithmetic leaves has many peaks
    constexpr int kParts = 256, kThirds = 40;
    const auto take = [&](double distance) {
        const double stops = stops_at(distance);
        if (stops > error.max) error.max = stops, error.max_at = distance;
        return stops;
    };
    const double step = exp_exact(log_exact(span.far / span.near) / kParts);
    std::array<double, 3> at{span.near, span.near, span.near};
    std::array<double, 3> stops{};
    stops.fill(take(span.near));
    for (int i = 1; i <= kParts + 1; ++i) {
        const bool is_last = i >= kParts;
        at = {at[1], at[2], is_last ? span.far : at[2] * step};
        stops = {stops[1], stops[2], i > kParts ? stops[2] : take(at[2])};
        const bool is_peak = stops[1] >= stops[2] && (i == 1 || stops[1] > stops[0]);
        if (!is_peak || stops[1] < kNothing) continue;
        double low = at[0], high = at[2];
        for (int j = 0; j < kThirds; ++j) {
            const double first = low + (high - low) / 3, second = high - (high - low) / 3;
            if (take(first) < take(second))
                low = first;
            else
                high = second;
        }
    }
}

}  // namespace

StopsError stops_between(const PhysicalLight& light, const Falloff& law, double intensity,
                         const DistanceSpan& span, int count) {
    const auto stops_at = [&](double distance) { return stops_at_distance(light, law, intensity, distance); };
    StopsError error{0, 0, span.near};
    double squares = 0;
    for (int i = 0; i < count; ++i) {
        const double distance = middle(span, i, count), stops = stops_at(distance);
        squares += stops * stops;
        if (stops > error.max) error.max = stops, error.max_at = distance;
    }
    error.rms = std::sqrt(squares / count);
    take_peaks(stops_at, span, error);
    return error;
}

DistanceSpan distances_that_matter(const Falloff& law, double intensity, double threshold) {
    if (!(intensity > 0)) return {0, 0};
    const double faded = falloff_reach(law, threshold / intensity);
    const double reach = has_range(law) ? std::min(faded, law.range) : faded;
    if (!(reach > 0) || reach == kInfinity) return {0, 0};
    return {.05 * reach, .9 * reach};
}

LightFit fit_light(const Falloff& law, double intensity, EmitterShape shape, LightWindow window,
                   const DistanceSpan& span) {
    assert(intensity > 0 && span.near > 0 && span.near < span.far && !is_constant_fill(law));
    if (is_model(law, shape, window)) return exact_fit(law, intensity, shape, window, span);

    // Radii as logarithms of their share of the span; a window's as the share of it that the span fills.
    const bool has_size = shape == EmitterShape::disk || shape == EmitterShape::rectangle;
    const bool has_end = has_range(law);
    const auto radius_of = [&](double log) { return has_size ? span.far * exp_exact(log) : 0; };
    const auto end_of = [&](double share) { return has_end ? span.far / share : kInfinity; };
    const auto emitter = [&](double log) {
        return curve_of(span, [&](double d) { return emitter_at(shape, d, radius_of(log)); });
    };
    const auto ending = [&](double share) {
        return curve_of(span, [&](double d) { return window_at(window, d, end_of(share)); });
    };
    const Curve wanted = curve_of(span, [&](double d) { return falloff_at(law, d); });
    const auto best =
        zoom({has_size ? -7. : 0., has_end ? .25 : 1.}, {has_size ? 3. : 0., has_end ? .9995 : 1.}, emitter,
             ending, [&](const Curve& row, const Curve& column) { return moments(wanted, row, column)[1]; });
    const double offset = moments(wanted, emitter(best[0]), ending(best[1]))[0];
    const PhysicalLight light{shape, window, intensity * exp_exact(offset * std::numbers::ln2),
                              radius_of(best[0]), end_of(best[1])};
    return {light, stops_between(light, law, intensity, span, 256), false};
}

namespace {

/// Middles of equal parts of the cosine, from `lowest` to the axis, are equal parts of the solid angle.
double cosine_of_part(double lowest, int i, int count) { return lowest + (1 - lowest) * ((i + .5) / count); }

/// glTF's and Frostbite's spot, whose angles are given by their cosines.
double square_ramp(double inner, double outer, double cosine) {
    const double ramp = std::clamp((cosine - outer) / std::max(inner - outer, 1e-9), 0., 1.);
    return ramp * ramp;
}

}  // namespace

SpotError spot_difference(const SpotFalloff& law, double inner_rad, double outer_rad, int count) {
    if (law.outer_rad <= 0) return {0, 0, 0};
    const double lowest = sin_cos_pi(std::max(law.outer_rad, outer_rad) / kPi).cos;
    const double inner = sin_cos_pi(inner_rad / kPi).cos, outer = sin_cos_pi(outer_rad / kPi).cos;
    double squares = 0, largest = 0, flux = 0, legacy_flux = 0;
    for (int i = 0; i < count; ++i) {
        const double cosine = cosine_of_part(lowest, i, count);
        const double wanted = spot_falloff_at(law, cosine), found = square_ramp(inner, outer, cosine);
        squares += (found - wanted) * (found - wanted);
        largest = std::max(largest, std::abs(found - wanted));
        flux += found;
        legacy_flux += wanted;
    }
    return {std::sqrt(squares / count), largest,
            legacy_flux > 0 && flux > 0 ? log2_exact(flux / legacy_flux) : 0};
}

SpotFit fit_spot(const SpotFalloff& law) {
    constexpr double kWidest = kPi / 2;
    constexpr int kCount = 256;
    if (law.outer_rad <= 0) return {0, 0, {0, 0, 0}, true};
    const double widest = std::min(law.outer_rad, kWidest);
    const bool is_square = law.law == SpotLaw::cosine_ramp && law.exponent == 2;
    const bool is_edge = law.law == SpotLaw::hard || law.inner_rad >= law.outer_rad;
    if (law.outer_rad <= kWidest && law.axis_power == 0 &&
        (is_square || (is_edge && law.law != SpotLaw::cosine_power)))
        return {is_edge ? widest : law.inner_rad, widest, {0, 0, 0}, true};

    const double lowest = sin_cos_pi(law.outer_rad / kPi).cos;
    std::array<double, kCount> cosines, wanted;
    for (std::size_t i = 0; i < kCount; ++i) {
        cosines[i] = cosine_of_part(lowest, static_cast<int>(i), kCount);
        wanted[i] = spot_falloff_at(law, cosines[i]);
    }
    const auto difference = [&](double inner, double outer) {
        double squares = 0;
        for (std::size_t i = 0; i < kCount; ++i) {
            const double value = square_ramp(inner, outer, cosines[i]) - wanted[i];
            squares += value * value;
        }
        return squares;
    };
    // Parameters: the outer cosine, and where between it and the axis the inner one lies.
    const double first = std::max(lowest, 0.);
    const auto same = [](double value) { return value; };
    const auto best =
        zoom({first, 0}, {1 - 1e-6 * (1 - first), 1}, same, same,
             [&](double outer, double share) { return difference(outer + (1 - outer) * share, outer); });
    const auto angle_of = [](double cosine) {
        return atan2_exact(std::sqrt(std::max((1 - cosine) * (1 + cosine), 0.)), cosine);
    };
    const double inner_rad = angle_of(best[0] + (1 - best[0]) * best[1]), outer_rad = angle_of(best[0]);
    return {inner_rad, outer_rad, spot_difference(law, inner_rad, outer_rad, kCount), false};
}

}  // namespace pbr
