#pragma once
// A whole file of lights, converted.

#include "bakers/light/document.hpp"

namespace pbrbake::light {

/// Parses and converts a source. The same for the same bytes, parameters and accuracy.
ConvertedFile convert_file(const LightParams& params, const SourceImage& source, const Accuracy& accuracy);

}  // namespace pbrbake::light
