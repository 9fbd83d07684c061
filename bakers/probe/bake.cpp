#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "bakers/formats.hpp"
#include "bakers/probe/chain.hpp"
#include "bakers/probe/environment.hpp"
#include "bakers/probe/levels.hpp"
#include "bakers/probe/probe.hpp"
#include "bakers/probe/source_layout.hpp"

namespace pbrbake::probe {
namespace {

/// `notes` has what the filter says of each level from 1 on.
Json level_properties(const ProbeParams& params, const Json& notes) {
    Json levels = Json::array();
    for (int l = 0; l < level_count(params); ++l) {
        const double perceptual_roughness = perceptual_roughness_of_level(params, l);
        Json level = {{"size", size_of_level(params, l)},
                      {"perceptual_roughness", perceptual_roughness},
                      {"alpha", alpha_of_level(params, l)}};
        if (l > 0) level.update(notes[static_cast<std::size_t>(l) - 1]);
        levels.push_back(std::move(level));
    }
    return levels;
}

/// The shortest text that reads back as the number.
std::string number(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// Mistakes in a list of roughness.
void check_roughness(const ProbeParams& params, std::vector<Mistake>& mistakes) {
    constexpr double kLowest = 0.01;  // alpha 1e-4: narrower lobes are mirrors
    const std::vector<double>& list = params.perceptual_roughness;
    const std::string pointer = "/perceptual_roughness";
    const int count = static_cast<int>(list.size()), full = full_chain(params.size);
    if (count > 0 && params.levels > 0 && params.levels != count)
        mistakes.push_back({"/levels", "found " + std::to_string(params.levels) +
                                           ", and perceptual_roughness lists " + std::to_string(count) +
                                           " levels; allowed: 0 or " + std::to_string(count)});
    if (count > full)
        mistakes.push_back({pointer, "found " + std::to_string(count) + " levels; allowed: at most " +
                                         std::to_string(full) + " for size " + std::to_string(params.size)});
    for (int l = 0; l < count; ++l) {
        const double value = list[static_cast<std::size_t>(l)];
        const double lowest = l == 0 ? 0 : std::max(kLowest, list[static_cast<std::size_t>(l) - 1]);
        if (l == 0 ? value != 0 : value < lowest)
            mistakes.push_back(
                {pointer + "/" + std::to_string(l),
                 "found " + number(value) + "; allowed: " +
                     (l == 0 ? "0, for level 0 is the mirror"
                             : number(lowest) + " to 1, no level smoother than the one before")});
    }
}

}  // namespace

std::vector<Mistake> check(const ProbeParams& params, const std::string& format) {
    std::vector<Mistake> mistakes;
    if (const Format* container = find_format(format); container && !container->is_chain)
        mistakes.push_back(
            {"/format", "found \"" + format + "\", which holds no cube map; allowed: exr, ktx2, dds"});
    const int full = full_chain(params.size);
    check_roughness(params, mistakes);
    if (params.levels > full)
        mistakes.push_back({"/levels", "found " + std::to_string(params.levels) + "; allowed: at most " +
                                           std::to_string(full) + " for size " +
                                           std::to_string(params.size)});
    const int levels = std::min(level_count(params), full);
    if (format == "exr" &&
        params.size % (1 << (levels - 1)) != 0)  // OpenEXR halves the six faces as one picture
        mistakes.push_back({"/size", "found " + std::to_string(params.size) + "; allowed: multiples of " +
                                         std::to_string(1 << (levels - 1)) + " for an EXR cube map of " +
                                         std::to_string(levels) + " levels; or take fewer levels, or ktx2"});
    if (params.samples.size() > 1 && params.samples.size() != static_cast<std::size_t>(levels))
        mistakes.push_back({"/samples", "found " + std::to_string(params.samples.size()) +
                                            " counts; allowed: one for all levels, or one a level (" +
                                            std::to_string(levels) + ")"});
    const bool samples =
        params.integrator != Integrator::harmonic && params.integrator != Integrator::reference;
    if (!samples && params.samples != std::vector<int>{0})
        mistakes.push_back({"/samples", "found with integrator " + std::string(enum_name(params.integrator)) +
                                            "; allowed: with is, mis, fis or auto"});
    return mistakes;
}

std::vector<Read> reads(const ProbeParams& params) { return source_files(params); }

Product bake(const ProbeParams& params, const Inputs& inputs, Context& context) {
    SourceImage unfolded;
    const SourceImage& source = environment_source(params, inputs, unfolded);
    if (source.image.faces == 6 && !permutes_cube(params.rotate_deg))
        throw Error(ExitCode::invalid_job, params.source,
                    "is a cube map, and rotate_deg is " + std::to_string(params.rotate_deg) +
                        "; allowed for cube maps: multiples of 90, or give the environment as an equirect");
    const Environment environment(params, source);
    Image image;
    image.channels = {"R", "G", "B"};
    image.faces = 6;
    image.levels.resize(static_cast<std::size_t>(level_count(params)));
    const Method method = method_of(params, context.accuracy());
    const Json notes = fill_levels(params, method, environment, context, image);

    Product product;
    product.images.push_back(std::move(image));
    product.units = params.units == Units::automatic ? source.units : std::string(enum_name(params.units));
    product.properties["level_mapping"] =
        params.perceptual_roughness.empty()
            ? "level = (levels - 1) * perceptual_roughness"
            : "piecewise linear through the perceptual_roughness of the levels";
    product.properties["integrator"] = enum_name(method.integrator);
    if (!method.reason.empty()) product.properties["chosen_because"] = method.reason;
    product.properties["levels"] = level_properties(params, notes);
    return product;
}

}  // namespace pbrbake::probe
