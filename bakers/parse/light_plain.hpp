#pragma once
// Words that the plain JSON and CSV formats share.

#include <string>

#include "bakers/parse/lights.hpp"

namespace pbrbake::parse {

/// A light's falloff by the name of its law, with the numbers that the law takes; README.md of bakers/light
/// has the table. Throws std::string, the names allowed, for another name.
struct PlainFalloff {
    std::string kind;
    double constant = 0, linear = 0, quadratic = 0;
    double exponent = 0;  ///< of "power" and "ramp"; 0: the law's usual one
    double range = 0;     ///< 0: not stated
    bool range_is_stated = false;
    std::string window;  ///< "" : the law's usual one
};

/// Names of laws: "constant", "linear", …
extern const char* const kFalloffNames;

/// Whether `plain` named laws that there are; fills `law`.
bool make_falloff(const PlainFalloff& plain, pbr::Falloff& law);

/// "point", "spot", …; false for another word.
bool read_light_type(std::string_view word, LightType& type);

extern const char* const kLightTypeNames;
extern const char* const kLightUnitNames;

/// The unit of a light that states none beside its file: a physical one that its type can have.
LightUnit unit_for(LightType type, LightUnit unit);

}  // namespace pbrbake::parse
