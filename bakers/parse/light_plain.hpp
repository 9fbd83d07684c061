#pragma once
// Words that the plain JSON and CSV formats share.

#include <optional>
#include <string>
#include <string_view>

#include "bakers/parse/lights.hpp"

namespace pbrbake::parse {

/// A light's falloff by the name of its law, with the numbers that the law takes; README.md of bakers/light
/// has the table.
struct PlainFalloff {
    std::string kind;  ///< "": polynomial beside coefficients, linear beside a range, else inverse_square
    bool states_coefficients = false;
    double constant = 0, linear = 0, quadratic = 0;
    std::optional<double>
        exponent;  ///< of "power", "linear" and "ramp"; nothing: 2 of power, 1 of the others
    std::optional<double> range;
    std::string window;  ///< "": the law's usual one
};

/// What a file may not say: the field, "falloff" for the law's name, and what is allowed there.
struct PlainMistake {
    std::string_view field, allowed;
};

/// Fills `law`, or says why it can't: names that there aren't, numbers that the law lacks or has no use for.
/// A range beside no name is linear's where the unit is relative, and ends an inverse square elsewhere.
std::optional<PlainMistake> make_falloff(PlainFalloff plain, LightUnit unit, pbr::Falloff& law);

/// What is wrong with a light's sizes: none is below 0, nor is a cone's angle.
std::optional<PlainMistake> mistake_of_sizes(const LegacyLight& light);

/// "point", "spot", …; false for another word.
bool read_light_type(std::string_view word, LightType& type);

extern const char* const kLightTypeNames;
extern const char* const kLightUnitNames;

/// The unit of a light that states none beside its file: a physical one that its type can have.
LightUnit unit_for(LightType type, LightUnit unit);

}  // namespace pbrbake::parse
