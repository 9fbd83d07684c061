#include "bakers/light/converted_file.hpp"

#include <algorithm>
#include <cstdint>

namespace pbrbake::light {
namespace {

double tolerance_stops(const Accuracy& accuracy) {
    if (accuracy.stated()) return accuracy.max_error;
    return accuracy.name == "draft" ? .25 : accuracy.name == "reference" ? .001 : .05;
}

}  // namespace

ConvertedFile convert_file(const LightParams& params, const SourceImage& source, Context& context,
                           Fits fits) {
    const parse::LightFile file = parse::parse_lights(source.bytes, source.name,
                                                      {static_cast<parse::ThreeLights>(params.three_lights),
                                                       static_cast<parse::GltfUnits>(params.gltf_units)});
    ConvertedFile converted;
    converted.source = source.name.substr(source.name.find_last_of("/\\") + 1);  // products hold no folders
    converted.format = file.format;
    converted.meaning = file.meaning;
    converted.diagnostics = file.diagnostics;
    converted.unit_is_stated = file.unit_is_stated || params.unit_m > 0;
    Anchor& anchor = converted.anchor;
    anchor.unit_m = params.unit_m > 0 ? params.unit_m : file.unit_m;
    anchor.efficacy_lm_per_w = params.efficacy_lm_per_w;
    anchor.tolerance_stops = tolerance_stops(context.accuracy());
    anchor.reference_lx = params.reference_illuminance_lx > 0 ? params.reference_illuminance_lx
                          : params.unit_cd > 0 ? params.unit_cd / (anchor.unit_m * anchor.unit_m)
                                               : reference_illuminance_lx(params.ev100);
    converted.ev100 = ev100_of_reference(anchor.reference_lx);
    converted.is_anchored = std::ranges::any_of(file.lights, [](const parse::LegacyLight& light) {
        return light.unit == parse::LightUnit::relative;
    });
    converted.lights.resize(file.lights.size());
    context.expect(static_cast<double>(file.lights.size()));
    context.parallel_for(static_cast<std::int64_t>(file.lights.size()), 8,
                         [&](std::int64_t begin, std::int64_t end) {
                             for (std::int64_t i = begin; i < end; ++i) {
                                 const auto k = static_cast<std::size_t>(i);
                                 converted.lights[k] = convert(file.lights[k], file.up, anchor, params, fits);
                             }
                             context.advance(static_cast<double>(end - begin));
                         });
    return converted;
}

}  // namespace pbrbake::light
