#pragma once
// Converted lights as documents: JSON with units, and glTF.

#include <string>
#include <vector>

#include "bakers/light/convert.hpp"

namespace pbrbake::light {

/// A file's lights, converted, and what was taken for what.
struct ConvertedFile {
    std::string source;  ///< name without folder
    std::string format, meaning;
    Anchor anchor{};
    double ev100 = 0;
    bool is_anchored = false;  ///< whether any light's unit is relative
    bool unit_is_stated = false;
    std::vector<ConvertedLight> lights;
    std::vector<parse::Diagnostic> diagnostics;
};

/// schemas/lights.schema.json describes it.
Json lights_json(const ConvertedFile& file);

/// A glTF document with a node a light (KHR_lights_punctual). What the extension can't say is in `extras`:
/// source radius, temperature, and how far its own falloff is off. Fills and dark lights are left out and
/// named in the scene's extras.
Json gltf_json(const ConvertedFile& file);

/// A table of a light's law and of a light that stands for it, over the distances that matter in equal steps
/// of their logarithm: distance_m, legacy_lx, fitted_lx (by the name given), stops (null where one is dark).
Json curve_json(const ConvertedLight& light, const pbr::PhysicalLight& other, const char* name);

/// A law in words and numbers: "1 / (1 + 0.04 d^2)", lengths in metres.
std::string law_text(const pbr::Falloff& law);

/// What a law is of, for tables and certificates: "constant", "linear ramp", "inverse square", …
std::string law_kind(const pbr::Falloff& law);

/// Nine significant digits: all that is meant, and the same on every machine.
double rounded(double value);

}  // namespace pbrbake::light
