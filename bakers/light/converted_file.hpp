#pragma once
// A whole file of lights, converted.

#include "bakers/light/document.hpp"

namespace pbrbake::light {

/// Parses and converts a source, light by light on the context's threads.
ConvertedFile convert_file(const LightParams& params, const SourceImage& source, Context& context, Fits fits);

}  // namespace pbrbake::light
