#include "bakers/parse/light_plain.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "bakers/parse/light_formats.hpp"

namespace pbrbake::parse {
namespace {

using pbr::FalloffWindow;

constexpr std::string_view kFalloffNames =
    "constant, linear, ramp, smoothstep, inverse, inverse_square, polynomial, power";
constexpr std::array<std::pair<std::string_view, FalloffWindow>, 7> kWindows{
    {{"none", FalloffWindow::none},
     {"cut", FalloffWindow::cut},
     {"ramp", FalloffWindow::ramp},
     {"smoothstep", FalloffWindow::smoothstep},
     {"smootherstep", FalloffWindow::smootherstep},
     {"quartic", FalloffWindow::quartic},
     {"quartic_squared", FalloffWindow::quartic_squared}}};

/// The law of a name, and the window that it has where a range is stated. False for no name.
bool read_kind(const PlainFalloff& plain, pbr::Falloff& law, FalloffWindow& usual) {
    usual = FalloffWindow::cut;
    if (plain.kind == "constant") return true;
    if (plain.kind == "linear" || plain.kind == "ramp") {
        usual = FalloffWindow::ramp;
        law.exponent = plain.exponent.value_or(1);
    } else if (plain.kind == "smoothstep") {
        usual = FalloffWindow::smoothstep;
    } else if (plain.kind == "inverse") {
        law.constant = 0, law.linear = 1;
    } else if (plain.kind == "inverse_square") {
        law.constant = 0, law.quadratic = 1;
        usual = FalloffWindow::quartic_squared;
    } else if (plain.kind == "polynomial") {
        law.constant = plain.constant, law.linear = plain.linear, law.quadratic = plain.quadratic;
    } else if (plain.kind == "power") {
        law.power = plain.exponent.value_or(2);
        usual = FalloffWindow::quartic_squared;
    } else {
        return false;
    }
    return true;
}

/// Numbers that the law lacks, or has no use for unless they are 0, as tables fill their cells.
std::optional<PlainMistake> mistake_of(const PlainFalloff& plain) {
    const bool is_ramp = plain.kind == "linear" || plain.kind == "ramp";
    if (is_ramp || plain.kind == "power") {
        if (plain.exponent && !(*plain.exponent > 0)) return PlainMistake{"exponent", "a number above 0"};
    } else if (plain.exponent.value_or(0) != 0) {
        return PlainMistake{"exponent", "none with this falloff; power, linear and ramp have one"};
    }
    const bool has_coefficients = plain.constant != 0 || plain.linear != 0 || plain.quadratic != 0;
    if (plain.kind == "polynomial" ? !plain.states_coefficients : has_coefficients)
        return PlainMistake{"falloff", "polynomial where its coefficients are stated, and only there"};
    if ((is_ramp || plain.kind == "smoothstep" || !plain.window.empty()) && plain.window != "none" &&
        !plain.range)
        return PlainMistake{"range", "the distance at which the light is dark, which its falloff needs"};
    return {};
}

}  // namespace

const char* const kLightTypeNames = "point, spot, directional, ambient, sphere, rectangle";
const char* const kLightUnitNames = "relative, cd, lm, lm_over_pi, lm_over_4pi, lx, nit, W, W/sr, W/m2";

std::optional<PlainMistake> make_falloff(PlainFalloff plain, LightUnit unit, pbr::Falloff& law) {
    if (plain.kind.empty())
        plain.kind = plain.states_coefficients                    ? "polynomial"
                     : plain.range && unit == LightUnit::relative ? "linear"
                                                                  : "inverse_square";
    law = pbr::Falloff{};
    FalloffWindow window;
    if (!read_kind(plain, law, window)) return PlainMistake{"falloff", kFalloffNames};
    if (!plain.window.empty()) {
        const auto named =
            std::ranges::find(kWindows, plain.window, [](const auto& pair) { return pair.first; });
        if (named == kWindows.end())
            return PlainMistake{"window",
                                "none, cut, ramp, smoothstep, smootherstep, quartic, quartic_squared"};
        window = named->second;
    }
    if (const auto mistake = mistake_of(plain)) return mistake;
    if (plain.range) law.range = *plain.range, law.window = window;
    return {};
}

bool read_light_type(std::string_view word, LightType& type) {
    constexpr std::array<std::pair<std::string_view, LightType>, 10> kNames{
        {{"point", LightType::point},
         {"omni", LightType::point},
         {"spot", LightType::spot},
         {"directional", LightType::directional},
         {"sun", LightType::directional},
         {"ambient", LightType::ambient},
         {"sphere", LightType::sphere},
         {"rectangle", LightType::rectangle},
         {"area", LightType::rectangle},
         {"hemisphere", LightType::ambient}}};
    for (const auto& [name, value] : kNames)
        if (name == word) {
            type = value;
            return true;
        }
    return false;
}

std::optional<double> finite_number(std::string_view word) {
    // number_of stops at 1e10, a bound for lamps; FLT_MAX stands for no range in many a file.
    if (word.starts_with('+') && word.size() > 1 && word[1] != '-') word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || end != word.data() + word.size()) return {};
    if (error == std::errc::result_out_of_range) {  // too small is 0
        const bool small = word.find("e-") != word.npos || word.find("E-") != word.npos;
        return small ? std::optional(0.) : std::nullopt;
    }
    constexpr double kLargest = 3.5e38;
    if (error != std::errc{} || !(std::abs(value) <= kLargest)) return {};
    return value;
}

std::optional<LightUnit> light_unit(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, LightUnit>, 10> kNames{
        {{"relative", LightUnit::relative},
         {"cd", LightUnit::candela},
         {"lm", LightUnit::lumen},
         {"lm_over_pi", LightUnit::lumen_over_pi},
         {"lm_over_4pi", LightUnit::lumen_over_4_pi},
         {"lx", LightUnit::lux},
         {"nit", LightUnit::nit},
         {"W", LightUnit::watt},
         {"W/sr", LightUnit::watt_per_sr},
         {"W/m2", LightUnit::watt_per_m2}}};
    for (const auto& [word, unit] : kNames)
        if (word == name) return unit;
    return {};
}

std::optional<PlainMistake> mistake_of_sizes(const LegacyLight& light) {
    constexpr std::string_view kAllowed = "a number from 0 on";
    if (light.radius < 0) return PlainMistake{"radius", kAllowed};
    if (light.width < 0) return PlainMistake{"width", kAllowed};
    if (light.height < 0) return PlainMistake{"height", kAllowed};
    if (light.spot && light.spot->outer_rad < 0) return PlainMistake{"outer_deg", kAllowed};
    if (light.spot && light.spot->inner_rad < 0) return PlainMistake{"inner_deg", kAllowed};
    return {};
}

LightUnit unit_for(LightType type, LightUnit unit) {
    const bool is_far = type == LightType::directional || type == LightType::ambient;
    if (unit == LightUnit::relative) return unit;
    if (is_far)
        return unit == LightUnit::watt || unit == LightUnit::watt_per_sr || unit == LightUnit::watt_per_m2
                   ? LightUnit::watt_per_m2
                   : LightUnit::lux;
    if (unit == LightUnit::watt_per_m2) return LightUnit::watt;
    if (unit == LightUnit::lux) return LightUnit::candela;
    if (unit == LightUnit::nit && type != LightType::sphere && type != LightType::rectangle)
        return LightUnit::candela;
    return unit;
}

}  // namespace pbrbake::parse
