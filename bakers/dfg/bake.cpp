#include <algorithm>
#include <vector>

#include "bakers/dfg/choose.hpp"
#include "bakers/dfg/dfg.hpp"
#include "bakers/dfg/layout.hpp"
#include "bakers/dfg/terms.hpp"
#include "bakers/formats.hpp"

namespace pbrbake::dfg {
namespace {

constexpr std::size_t kMostChannels = 4;  // what a texture holds

/// What only tables with a depth can be wrong in.
void check_volume(const DfgParams& params, const std::string& format, std::vector<Mistake>& mistakes) {
    constexpr double kMostTexels = 1 << 26;
    if (params.terms.size() > 1)
        mistakes.push_back({"/terms", "ggx_anisotropic has a third axis; bake it as a table of its own"});
    if (params.integrator != Integrator::quadrature)
        mistakes.push_back({"/integrator", "ggx_anisotropic is had by \"quadrature\" alone"});
    const double texels = static_cast<double>(params.width()) * params.height() * params.depth();
    if (texels > kMostTexels)
        mistakes.push_back({"/size", "found " + std::to_string(static_cast<long long>(texels)) +
                                         " texels; a volume has up to 67108864"});
    if (const Format* container = find_format(format); container && !container->is_volume)
        mistakes.push_back({"/format", "found \"" + format +
                                           "\", which holds no volumes; ggx_anisotropic needs \"ktx2\", "
                                           "\"dds\" or \"h\""});
}

}  // namespace

pbr::DfgMethod method_of(const DfgParams& params, const Accuracy& accuracy) {
    return params.integrator == Integrator::quadrature
               ? pbr::DfgMethod::quadrature(quadrature_error(accuracy))
               : pbr::DfgMethod::importance_sampling(params.samples, params.seed);
}

std::vector<Mistake> check(const DfgParams& asked, const std::string& format) {
    const DfgParams params = settled(asked);
    std::vector<Mistake> mistakes;
    const std::size_t channels = channel_names(params).size();
    if (channels > kMostChannels)
        mistakes.push_back({"/terms", "found terms of " + std::to_string(channels) +
                                          " channels; a table has up to 4: bake several"});
    if (std::ranges::any_of(params.terms, [](Term term) { return is_volume(term); }))
        check_volume(params, format, mistakes);
    else if (asked.size.size() > 2)
        mistakes.push_back({"/size", "found three sides; only a table of ggx_anisotropic has a depth"});
    if (params.terms.size() > 1 && std::any_of(params.terms.begin(), params.terms.end(), is_over_curvature))
        mistakes.push_back({"/terms",
                            "subsurface has axes of its own (NoL and curvature); bake it as a table of its "
                            "own"});
    return mistakes;
}

std::vector<Read> reads(const DfgParams&) { return {}; }

Product bake(const DfgParams& asked, const Inputs&, Context& context) {
    Product product;
    DfgParams params = settled(asked);
    if (context.accuracy().as_sampled) {
        const Choice choice = choose(asked, context);
        params = choice.params;
        if (context.may_store(choice.pixel)) product.pixel = choice.pixel;
    }
    const int width = params.width(), height = params.height(), depth = params.depth();
    const std::vector<std::string> names = channel_names(params);
    const pbr::DfgMethod method = method_of(params, context.accuracy());
    std::vector<double> across;
    for (int x = 0; x < width; ++x) across.push_back(value_of_column(params, x));

    Image image;
    for (std::size_t c = 0; c < names.size(); ++c) image.channels.emplace_back(1, "RGBA"[c]);
    image.levels.push_back(
        {width, height, std::vector<float>(static_cast<std::size_t>(width) * height * depth * names.size())});
    image.is_volume = is_volume(params);
    image.faces = depth;
    context.expect(height * depth);
    context.parallel_for(height * depth, 4, [&](std::int64_t begin, std::int64_t end) {
        for (int row = static_cast<int>(begin); row < end; ++row) {
            const int z = row / height, y = row % height;
            const Place place{value_of_row(params, y), value_of_slice(params, z)};
            const Columns columns = Row(params, method, place, across, context).evaluate();
            for (int x = 0; x < width; ++x)
                for (std::size_t c = 0; c < columns.size(); ++c)
                    image.texel(0, z, y, x)[c] = static_cast<float>(columns[c][x]);
            context.advance(1);
        }
    });
    product.images.push_back(std::move(image));
    product.units = "albedo";
    product.properties["columns"] = names;
    product.properties["layout"] = layout_json(params);
    return product;
}

}  // namespace pbrbake::dfg
