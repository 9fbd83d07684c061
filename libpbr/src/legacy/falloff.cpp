#include "pbr/legacy/falloff.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "pbr/numerics/elementary.hpp"

namespace pbr {
namespace {

constexpr double kFloatMax = std::numeric_limits<float>::max();

double smoothstep(double t) { return t * t * (3 - 2 * t); }

double window_at(const Falloff& law, double distance) {
    if (law.window == FalloffWindow::none || law.range >= kFloatMax) return 1;
    if (!(distance < law.range)) return 0;
    const double ratio = distance / law.range, ratio4 = ratio * ratio * ratio * ratio;
    const double ramp = std::clamp((law.range - distance) / (law.range - law.begin), 0., 1.);
    switch (law.window) {
        case FalloffWindow::none:
        case FalloffWindow::cut:
            return 1;
        case FalloffWindow::ramp:
            return power_exact(ramp, law.exponent);
        case FalloffWindow::smoothstep:
            return smoothstep(ramp);
        case FalloffWindow::smootherstep:
            return ramp * ramp * ramp * (ramp * (6 * ramp - 15) + 10);
        case FalloffWindow::quartic:
            return 1 - ratio4;
        case FalloffWindow::quartic_squared:
            return (1 - ratio4) * (1 - ratio4);
    }
    return 1;
}

double base_at(const Falloff& law, double distance) {
    if (law.power > 0) return 1 / std::max(power_exact(distance, law.power), law.floor);
    if (law.constant == 0 && law.linear == 0 && law.quadratic == 0) return 1;
    return 1 / std::max(law.constant + distance * (law.linear + distance * law.quadratic), law.floor);
}

}  // namespace

double power_exact(double x, double p) {
    assert(x >= 0 && p >= 0);
    if (p == 0) return 1;
    if (p == 1) return x;
    if (p == 2) return x * x;
    if (!(x > 0) || !std::isfinite(x)) return x;
    const double exponent = p * log_exact(std::max(x, std::numeric_limits<double>::min()));
    return exponent < -690 ? 0 : exp_exact(std::min(exponent, 700.));
}

double falloff_at(const Falloff& law, double distance) {
    assert(distance >= 0);
    const double window = window_at(law, distance);
    return window == 0 ? 0 : base_at(law, distance) * window;  // not 0 times the pole's infinity
}

bool has_range(const Falloff& law) { return law.window != FalloffWindow::none && law.range < kFloatMax; }

bool is_constant_fill(const Falloff& law) {
    return !has_range(law) && law.power == 0 && law.linear == 0 && law.quadratic == 0;
}

double falloff_reach(const Falloff& law, double share) {
    assert(share > 0);
    const auto is_above = [&](double distance) { return falloff_at(law, distance) > share; };
    if (!is_above(0)) return 0;
    if (is_constant_fill(law)) return std::numeric_limits<double>::infinity();
    // Laws decline, so that the last distance above the share can be bracketed by doubling.
    double high = 1;
    while (high < 1e150 && is_above(high)) high *= 2;
    if (high >= 1e150) return std::numeric_limits<double>::infinity();
    double low = 0;
    for (int i = 0; i < 200 && high - low > 1e-12 * high; ++i) {
        const double middle = (low + high) / 2;
        (is_above(middle) ? low : high) = middle;
    }
    return high;
}

namespace {

/// The law without the cosine that weighs it.
double cone_at(const SpotFalloff& law, double cosine) {
    const double outer = sin_cos_pi(law.outer_rad / std::numbers::pi).cos,
                 inner = sin_cos_pi(law.inner_rad / std::numbers::pi).cos;
    if (cosine < outer) return 0;
    const double step = inner - outer;
    const double ramp = step > 0 ? std::clamp((cosine - outer) / step, 0., 1.) : 1;
    switch (law.law) {
        case SpotLaw::hard:
            return 1;
        case SpotLaw::cosine_power:
            return cosine > 0 || law.exponent == 0 ? power_exact(std::max(cosine, 0.), law.exponent) : 0;
        case SpotLaw::cosine_ramp:
            return power_exact(ramp, law.exponent);
        case SpotLaw::smoothstep:
            return power_exact(smoothstep(ramp), law.exponent);
    }
    return 1;
}

}  // namespace

double spot_falloff_at(const SpotFalloff& law, double cosine) {
    const double weight = law.axis_power > 0 ? power_exact(std::max(cosine, 0.), law.axis_power) : 1;
    return weight * cone_at(law, cosine);
}

}  // namespace pbr
