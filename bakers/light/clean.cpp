#include "bakers/light/clean.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "bakers/parse/text.hpp"

namespace pbrbake::light {

using parse::Diagnostic;
using parse::Severity;

void flag(std::vector<Diagnostic>& flags, Severity severity, std::string code, int line,
          std::string message) {
    flags.push_back({severity, std::move(code), line, std::move(message)});
}

void clean_falloff(pbr::Falloff& law, int line, std::vector<Diagnostic>& flags) {
    for (double* coefficient : {&law.constant, &law.linear, &law.quadratic})
        if (*coefficient < 0) {
            *coefficient = 0;
            flag(flags, Severity::warning, "attenuation_negative", line,
                 "has a negative attenuation; it became 0");
        }
    constexpr double kVanishing = 1e-30;  // 1 / it would be no light's
    for (double* coefficient : {&law.constant, &law.linear, &law.quadratic})
        if (*coefficient < kVanishing) *coefficient = 0;
    law.power = std::clamp(law.power, 0., 64.);
    if (law.power == 0 && law.constant == 0 && law.linear == 0 && law.quadratic == 0)
        flag(flags, Severity::warning, "attenuations_zero", line,
             "has attenuations of 0 alone, which would be 1 / 0; read as the constant 1");
    if (law.window == pbr::FalloffWindow::none) return;
    if (law.range <= 0) {
        law.range = 0;
        law.begin = 0;
        flag(flags, Severity::warning, "range_zero", line, "has a range of 0 or less: it lights nothing");
    } else if (law.range >= std::numeric_limits<float>::max()) {
        flag(flags, Severity::note, "range_unlimited", line,
             "has a range of FLT_MAX or more: nothing ends it");
    }
    law.begin = std::clamp(law.begin, 0., law.range);
    law.exponent = std::clamp(law.exponent, 0., 64.);
}

bool clean_spot(pbr::SpotFalloff& spot, int line, std::vector<Diagnostic>& flags) {
    constexpr double kPi = std::numbers::pi, kNoLess = 1 - 1e-9;
    spot.exponent = std::clamp(spot.exponent, 0., 1e4);
    spot.outer_rad = std::clamp(spot.outer_rad, 0., kPi);
    spot.inner_rad = std::clamp(spot.inner_rad, 0., kPi);
    if (spot.outer_rad == 0) {
        spot.inner_rad = 0;
        flag(flags, Severity::warning, "cone_zero", line, "has a cone of 0 degrees: it lights nothing");
        return true;
    }
    if (spot.inner_rad > spot.outer_rad) {
        spot.inner_rad = spot.outer_rad;
        flag(flags, Severity::warning, "inner_beyond_outer", line,
             "has an inner cone wider than its outer one; the outer one is taken, with a hard edge");
    }
    const bool fades = spot.law == pbr::SpotLaw::cosine_power && spot.exponent > 0;
    if (spot.outer_rad >= kPi * kNoLess && !fades &&
        (spot.law != pbr::SpotLaw::cosine_ramp || spot.inner_rad >= kPi * kNoLess)) {
        flag(flags, Severity::note, "cone_open", line,
             "has a cone open to all directions: it is a point light");
        return false;
    }
    if (spot.outer_rad > kPi / 2 * (1 + 1e-9))
        flag(flags, Severity::warning, "cone_wide", line,
             "has a cone beyond 90 degrees off its axis, which no photometric spot has; it ends there");
    constexpr double kNarrowest_deg = 2.56;  // below it Frostbite's least step of the cosine dims the axis
    if (spot.outer_rad * 180 / kPi < kNarrowest_deg)
        flag(flags, Severity::warning, "cone_narrow", line,
             "has a cone of less than 2.56 degrees off its axis, which renderers dim that limit the step of "
             "the "
             "cosine to 0.001");
    return true;
}

}  // namespace pbrbake::light
