#include "bakers/parse/light_plain.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "bakers/parse/light_formats.hpp"

namespace pbrbake::parse {
namespace {

using pbr::FalloffWindow;

bool read_window(const std::string& name, FalloffWindow& window) {
    constexpr std::array<std::pair<std::string_view, FalloffWindow>, 7> kNames{
        {{"none", FalloffWindow::none},
         {"cut", FalloffWindow::cut},
         {"ramp", FalloffWindow::ramp},
         {"smoothstep", FalloffWindow::smoothstep},
         {"smootherstep", FalloffWindow::smootherstep},
         {"quartic", FalloffWindow::quartic},
         {"quartic_squared", FalloffWindow::quartic_squared}}};
    for (const auto& [word, value] : kNames)
        if (word == name) {
            window = value;
            return true;
        }
    return false;
}

}  // namespace

const char* const kFalloffNames =
    "constant, linear, inverse, inverse_square, polynomial, power, ramp, smoothstep; window: none, cut, "
    "ramp, "
    "smoothstep, smootherstep, quartic, quartic_squared";
const char* const kLightTypeNames = "point, spot, directional, ambient, sphere, rectangle";
const char* const kLightUnitNames = "relative, cd, lm, lm_over_pi, lm_over_4pi, lx, nit, W, W/sr, W/m2";

bool make_falloff(const PlainFalloff& plain, pbr::Falloff& law) {
    law = pbr::Falloff{};
    if (plain.range_is_stated) law.range = plain.range;
    const auto ends_by = [&](FalloffWindow window) {
        if (plain.range_is_stated) law.window = window;
    };
    if (plain.kind == "constant") {
        ends_by(FalloffWindow::cut);
    } else if (plain.kind == "linear" || plain.kind == "ramp") {
        law.window = FalloffWindow::ramp;
        if (plain.exponent > 0) law.exponent = plain.exponent;
    } else if (plain.kind == "smoothstep") {
        law.window = FalloffWindow::smoothstep;
    } else if (plain.kind == "inverse") {
        law.constant = 0, law.linear = 1;
        ends_by(FalloffWindow::cut);
    } else if (plain.kind == "inverse_square") {
        law.constant = 0, law.quadratic = 1;
        ends_by(FalloffWindow::quartic_squared);
    } else if (plain.kind == "polynomial") {
        law.constant = plain.constant, law.linear = plain.linear, law.quadratic = plain.quadratic;
        ends_by(FalloffWindow::cut);
    } else if (plain.kind == "power") {
        law.power = plain.exponent > 0 ? plain.exponent : 2;
        ends_by(FalloffWindow::quartic_squared);
    } else {
        return false;
    }
    return plain.window.empty() || read_window(plain.window, law.window);
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
